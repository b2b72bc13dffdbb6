//! Proves two quotients of polynomials equal by their values at the points of a lattice, whatever their powers.
//!
//! A polynomial of degree at most d, and of at most dᵢ in each symbol, is zero if it is zero wherever the coordinates, each
//! counted from some number, are whole numbers kᵢ ≤ dᵢ with a sum of at most d: these points are as many as its monomials,
//! and fix their coefficients. Nothing is multiplied out, and values are exact.

use super::Ground;
use super::proof::Proof;
use crate::expr::{Expr, Node, Point, Rational, Symbol, effort, ratio};

/// Most points, each counted as often as the degree tells, for which values are taken: some ten milliseconds.
const MOST: u64 = 1_500_000;
/// Where the coordinates of the first symbol are counted from, and how far from it those of the next: far from poles.
const START: [i64; 2] = [1009, 10_007];

/// The degree in each symbol, and the total one behind them.
type Degrees = Vec<u64>;

/// Proves two quotients of polynomials equal; nothing where they are not of that kind, differ or have too many points.
pub(super) fn prove(a: &Expr, b: &Expr) -> Option<Proof> {
    let mut names = a.symbols();
    names.extend(b.symbols());
    let mut names: Vec<_> = names.into_iter().collect();
    let [[above, below], [other, under]] = [degrees(a, &names)?, degrees(b, &names)?];
    let mut most = larger(sum(&above, &under), sum(&other, &below));
    let total = most.pop()?;
    let mut point = Point::<Rational>::default();
    // Terms of one degree are told apart by all symbols but one.
    let alike = a.is_zero() || b.is_zero() || order(a) == order(b);
    if alike && [a, b].iter().all(|e| e.is_zero() || order(e).is_some()) {
        most.pop();
        point.values.insert(names.pop()?, ratio(1, 1));
    }
    let size = total.max(1);
    let mut count = 0;
    let mut at = vec![0; most.len()];
    loop {
        count += size;
        if count > MOST {
            return None;
        }
        if !next(&mut at, &most, total) {
            break;
        }
    }
    if !effort::take(count) {
        return None;
    }
    loop {
        for (i, (name, k)) in names.iter().zip(&at).enumerate() {
            let from = START[0] + START[1] * i as i64;
            point
                .values
                .insert(name.clone(), ratio(from + *k as i64, 1));
        }
        if a.evaluate(&point)? != b.evaluate(&point)? {
            return None;
        }
        if !next(&mut at, &most, total) {
            return Some(Proof::Equal(Vec::new(), Ground::Lattice));
        }
    }
}

/// Goes on to the next point; false behind the last one, which is followed by the first.
fn next(at: &mut [u64], most: &[u64], total: u64) -> bool {
    for i in 0..at.len() {
        at[i] += 1;
        if at[i] <= most[i] && at.iter().sum::<u64>() <= total {
            return true;
        }
        at[i] = 0;
    }
    false
}

/// The degrees of a quotient of polynomials above and below its line.
fn degrees(e: &Expr, names: &[Symbol]) -> Option<[Degrees; 2]> {
    let none = || vec![0; names.len() + 1];
    let parts = |parts: &[Expr]| -> Option<Vec<_>> {
        parts.iter().map(|part| degrees(part, names)).collect()
    };
    Some(match e.node() {
        Node::Number(_) => [none(), none()],
        Node::Symbol(name) => {
            let at = names.iter().position(|n| n == name && &**n != "pi")?;
            let mut one = none();
            one[at] = 1;
            one[names.len()] = 1;
            [one, none()]
        }
        Node::Sum(terms) => (parts(terms)?.into_iter())
            .reduce(|[a, b], [c, d]| [larger(sum(&a, &d), sum(&c, &b)), sum(&b, &d)])?,
        Node::Product(factors) => {
            (parts(factors)?.into_iter()).reduce(|[a, b], [c, d]| [sum(&a, &c), sum(&b, &d)])?
        }
        Node::Power(base, k) => {
            let k = k.as_number().filter(|k| k.is_integer())?;
            let k = k.numer().as_i64().filter(|k| k.unsigned_abs() <= MOST)?;
            let raised = degrees(base, names)?.map(|d| {
                d.iter()
                    .map(|d| d.saturating_mul(k.unsigned_abs()))
                    .collect()
            });
            match (k < 0, raised) {
                (true, [above, below]) => [below, above],
                (false, raised) => raised,
            }
        }
        Node::Call(..) => return None,
    })
}

fn sum(a: &[u64], b: &[u64]) -> Degrees {
    a.iter().zip(b).map(|(a, b)| a.saturating_add(*b)).collect()
}

fn larger(a: Degrees, b: Degrees) -> Degrees {
    a.into_iter().zip(b).map(|(a, b)| a.max(b)).collect()
}

/// The degree that all terms of a formula have.
fn order(e: &Expr) -> Option<i64> {
    let parts = |parts: &[Expr]| parts.iter().map(order).collect::<Option<Vec<i64>>>();
    match e.node() {
        Node::Number(_) => Some(0),
        Node::Symbol(_) => Some(1),
        Node::Sum(terms) => {
            let orders = parts(terms)?;
            let first = *orders.first()?;
            orders.iter().all(|k| *k == first).then_some(first)
        }
        Node::Product(factors) => Some(parts(factors)?.iter().sum()),
        Node::Power(base, k) => order(base)?.checked_mul(k.as_number()?.numer().as_i64()?),
        Node::Call(..) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A product that is zero at all points of the lattice but the last one along the first symbol.
    fn nearly(name: &str, degree: i64) -> Expr {
        let from = |k: i64| Expr::symbol(name) - Expr::from(START[0] + k);
        Expr::product((0..degree).map(from))
    }

    #[test]
    fn one_point_less_would_prove_what_is_false() {
        let y = Expr::symbol("y");
        for degree in 1..6 {
            let e = nearly("x", degree);
            assert_eq!(prove(&e, &Expr::zero()), None);
            assert_eq!(prove(&(&e + &y), &y), None);
            assert_eq!(prove(&(&y / &(&e + &y)), &Expr::one()), None);
            let same = prove(&(&e * &y + &y), &(&y * &(&e + &Expr::one())));
            assert!(same.is_some());
        }
        let squares = (Expr::symbol("x") - &y) * (Expr::symbol("x") + &y);
        assert!(prove(&squares, &(Expr::symbol("x").powi(2) - y.powi(2))).is_some());
        assert_eq!(prove(&squares, &Expr::symbol("x").powi(2)), None);
    }
}
