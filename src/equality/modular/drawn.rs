//! The numbers by which the points of a pair are drawn: a strong hash of both formulas, in no order, and of what is declared of
//! their symbols.
//!
//! Whoever writes a formula fixes the points by it, and cannot aim at them; every machine and either order reach the same.

use sha2::{Digest, Sha256};

use super::Place;
use crate::expr::{Expr, Node};

/// The hash of two formulas and the places of their symbols, in four numbers.
pub(super) struct Drawn([u64; 4]);

impl Drawn {
    pub fn of([a, b]: [&Expr; 2], places: &[Place]) -> Drawn {
        let [mut first, mut second] = [a, b].map(|e| {
            let mut bytes = Vec::with_capacity(512);
            spell(e, &mut bytes);
            bytes
        });
        if second < first {
            std::mem::swap(&mut first, &mut second);
        }
        let mut hash = Sha256::new();
        hash.update(&first);
        hash.update(&second);
        let mut declared = Vec::with_capacity(32 * places.len());
        places
            .iter()
            .for_each(|place| declare(place, &mut declared));
        hash.update(&declared);
        let digest = hash.finalize();
        let mut words = [0; 4];
        for (word, bytes) in words.iter_mut().zip(digest.chunks_exact(8)) {
            *word = bytes.iter().fold(0, |w, b| w << 8 | u64::from(*b));
        }
        Drawn(words)
    }

    /// One number for each lane.
    pub fn rounds<const L: usize>(&self) -> [u64; L] {
        // Lanes beyond the fourth are far from the others in the same sequences.
        std::array::from_fn(|lane| {
            self.0[lane % 4].wrapping_add((lane / 4) as u64 * 0x5851_f42d_4c95_7f2d)
        })
    }
}

/// A formula in bytes from which it could be read again: no two are spelt alike, and none is the start of another.
fn spell(e: &Expr, out: &mut Vec<u8>) {
    let mut parts = |kind: u8, parts: &[Expr]| {
        out.push(kind);
        count(parts.len() as u64, out);
        parts.iter().for_each(|part| spell(part, out));
    };
    match e.node() {
        Node::Sum(terms) => parts(b'+', terms),
        Node::Product(factors) => parts(b'*', factors),
        Node::Number(value) => match (value.numer().as_i64(), value.denom().as_i64()) {
            (Some(above), Some(below)) => {
                out.push(if above < 0 { b'-' } else { b'n' });
                count(above.unsigned_abs(), out);
                count(below.unsigned_abs(), out);
            }
            _ => named(b'N', &value.to_string(), out),
        },
        Node::Symbol(name) => named(b's', name, out),
        Node::Power(base, exponent) => {
            out.push(b'^');
            spell(base, out);
            spell(exponent, out);
        }
        Node::Call(function, argument) => {
            named(b'f', function.name(), out);
            spell(argument, out);
        }
    }
}

/// Where a symbol lives, in bytes.
fn declare(place: &Place, out: &mut Vec<u8>) {
    named(b's', place.name, out);
    out.extend([place.sign as u8, u8::from(place.acute)]);
    for end in place.range {
        out.extend(end.to_bits().to_le_bytes());
    }
    count(u64::from(place.divisor), out);
    if let Some((first, second)) = place.unit {
        named(b'1' + u8::from(second), first, out);
    }
}

fn named(kind: u8, name: &str, out: &mut Vec<u8>) {
    out.push(kind);
    count(name.len() as u64, out);
    out.extend(name.as_bytes());
}

/// A number in groups of seven bits, the last one marked: small ones, which nearly all are, take one byte.
fn count(mut n: u64, out: &mut Vec<u8>) {
    while n >= 0x80 {
        out.push((n & 0x7f) as u8);
        n >>= 7;
    }
    out.push(n as u8 | 0x80);
}

#[cfg(test)]
mod tests {
    use super::super::Pair;
    use super::*;
    use crate::domain::{Domain, Domains, roles};
    use crate::expr::ratio;

    #[test]
    fn points_hang_on_both_formulas_in_no_order_and_on_what_is_declared() {
        let [x, y, z] = ["x", "y", "z"].map(Expr::symbol);
        let drawn = |a: &Expr, b: &Expr| Drawn::of([a, b], &[]).rounds::<8>();
        assert_eq!(drawn(&x, &y), drawn(&y, &x));
        assert_ne!(drawn(&x, &y), drawn(&x, &(&y + &Expr::one())));
        assert_ne!(drawn(&(&x * &y), &z), drawn(&x, &(&y * &z)));
        let mut lanes = drawn(&x, &y).to_vec();
        lanes.sort_unstable();
        lanes.dedup();
        assert_eq!(lanes.len(), 8);

        let on = |domain: Domain| {
            let name = "x".into();
            let mut domains = Domains::default();
            domains.symbols.insert(name, domain);
            let roles = roles(&[&x]);
            let pair = Pair::of(&x, &x, &domains, &roles).expect("a symbol with its domain");
            Drawn::of([&x, &x], &pair.places).rounds::<1>()
        };
        assert_ne!(on(Domain::real()), on(Domain::positive()));
        let unit = |to: i64| on(Domain::between(ratio(0, 1), ratio(to, 1)));
        assert_ne!(unit(1), unit(2));
    }
}
