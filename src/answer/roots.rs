//! Real roots of polynomials with rational coefficients, isolated exactly by Sturm's theorem.
//!
//! In: coefficients by ascending powers. Out: disjoint intervals with fractions as ends, each with exactly one root inside.

use num_traits::{Signed, Zero};

use crate::expr::{Rational, ratio};

/// Highest degree that is isolated.
const DEGREE: usize = 40;
/// Halvings of an interval: its width shrinks by this many bits.
const BITS: usize = 40;

/// Isolating intervals of the real roots, ascending.
pub(super) fn isolate(coefficients: &[Rational]) -> Vec<[Rational; 2]> {
    let p = trimmed(coefficients.to_vec());
    if p.len() < 2 || p.len() > DEGREE + 1 {
        return Vec::new();
    }
    let chain = sturm(&p);
    // Cauchy's bound: all roots are smaller in size than 1 + max |aₖ/aₙ|.
    let lead = p[p.len() - 1].abs();
    let largest = p
        .iter()
        .map(|c| c.abs() / &lead)
        .fold(ratio(0, 1), |a, b| if a < b { b } else { a });
    let bound = largest + ratio(1, 1);
    let mut out = Vec::new();
    split(&chain, [-bound.clone(), bound], BITS, &mut out);
    out
}

/// Halves intervals (low, high] until each holds one root and is narrow.
fn split(
    chain: &[Vec<Rational>],
    [low, high]: [Rational; 2],
    bits: usize,
    out: &mut Vec<[Rational; 2]>,
) {
    let count = changes(chain, &low).saturating_sub(changes(chain, &high));
    if count == 0 {
        return;
    }
    if bits == 0 {
        out.push([low, high]);
        return;
    }
    let middle = (&low + &high) / ratio(2, 1);
    split(chain, [low, middle.clone()], bits - 1, out);
    split(chain, [middle, high], bits - 1, out);
}

fn sturm(p: &[Rational]) -> Vec<Vec<Rational>> {
    let derivative: Vec<Rational> = p
        .iter()
        .enumerate()
        .skip(1)
        .map(|(k, c)| c * ratio(k as i64, 1))
        .collect();
    let mut chain = vec![p.to_vec(), trimmed(derivative)];
    while chain[chain.len() - 1].len() > 1 {
        let rest = remainder(&chain[chain.len() - 2], &chain[chain.len() - 1]);
        if rest.is_empty() {
            break;
        }
        chain.push(rest.into_iter().map(|c| -c).collect());
    }
    chain
}

/// The remainder of a division; empty for zero.
fn remainder(a: &[Rational], b: &[Rational]) -> Vec<Rational> {
    let mut rest = a.to_vec();
    while rest.len() >= b.len() {
        let factor = &rest[rest.len() - 1] / &b[b.len() - 1];
        let shift = rest.len() - b.len();
        for (k, c) in b.iter().enumerate() {
            rest[shift + k] = &rest[shift + k] - &factor * c;
        }
        rest.pop();
        rest = trimmed(rest);
    }
    rest
}

fn trimmed(mut p: Vec<Rational>) -> Vec<Rational> {
    while p.last().is_some_and(Zero::is_zero) {
        p.pop();
    }
    p
}

/// Changes of sign in the chain at a point.
fn changes(chain: &[Vec<Rational>], x: &Rational) -> usize {
    let mut last = 0;
    let mut count = 0;
    for p in chain {
        let value = p.iter().rev().fold(ratio(0, 1), |sum, c| sum * x + c);
        let sign = if value.is_zero() {
            0
        } else if value.is_positive() {
            1
        } else {
            -1
        };
        if sign != 0 {
            count += usize::from(last != 0 && sign != last);
            last = sign;
        }
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_real_root_gets_an_interval_of_its_own() {
        // (x² − 2)(x − 1)(x² + 1) = x⁵ − x⁴ − x³ + x² − 2x + 2
        let p: Vec<Rational> = [2, -2, 1, -1, -1, 1].iter().map(|k| ratio(*k, 1)).collect();
        let found = isolate(&p);
        assert_eq!(found.len(), 3);
        assert!(found[1][0] < ratio(1, 1) && ratio(1, 1) <= found[1][1]);
        assert!(
            &found[2][0] * &found[2][0] < ratio(2, 1) && ratio(2, 1) < &found[2][1] * &found[2][1]
        );
    }

    #[test]
    fn a_polynomial_without_real_roots_gets_none() {
        assert!(isolate(&[ratio(1, 1), ratio(0, 1), ratio(1, 1)]).is_empty());
    }
}
