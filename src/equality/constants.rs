//! Numbers that are equal although no normal form says so: cos 20° cos 40° cos 80° = 1/8, ∛(2 + √5) + ∛(2 − √5) = 1.
//!
//! A number made of fractions, roots and sines of fractions of π is a quotient of algebraic integers. Unless it is zero, the
//! product of the numerator's conjugates is a whole number other than zero, so the numerator is not below one over the
//! product of the others (the bound of Burnikel, Funke, Mehlhorn, Schirra and Schmitt, 2001). An enclosure within that
//! bound proves that the number is zero.

use std::collections::BTreeSet;

use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive};

use super::proof::{Proof, seen};
use super::{Ground, measure};
use crate::algebra::Field;
use crate::domain::Domains;
use crate::expr::angle::angle;
use crate::expr::{Expr, Function, Int, Node, Point, Rational, ratio};
use crate::interval::dyadic::Dyadic;
use crate::interval::{Big, Outcome, evaluate};

/// Most bits of a bound that an enclosure is made for.
const MOST_BITS: f64 = 3_900.0;

/// Proves equality by the coefficients of the difference; nothing where one of them is not shown to be zero.
pub(super) fn prove(a: &Expr, b: &Expr, domains: &Domains) -> Option<Proof> {
    if a.is_constant() && b.is_constant() {
        return vanishes(&(a - b)).then(|| Proof::Equal(Vec::new(), Ground::Bound));
    }
    let (field, x, y) = Field::pair(domains, a, b).ok()?;
    let difference = field.sub(&x, &y).ok()?;
    let coefficients = field.constants(&difference)?;
    let equal = coefficients.iter().all(vanishes);
    equal.then(|| Proof::Equal(seen(&field), Ground::Bound))
}

/// Whether a number is zero for certain.
fn vanishes(e: &Expr) -> bool {
    if e.is_zero() {
        return true;
    }
    let mut extent = Extent {
        roots: BTreeSet::new(),
        degree: 1.0,
        turns: 1,
    };
    let Some(size) = extent.size(e) else {
        return false;
    };
    let degree = extent.degree * f64::from(totient(extent.turns).div_ceil(2));
    // The slack covers the rounding of the logarithms.
    let bits = (degree - 1.0) * size.above + size.below + 32.0;
    if bits > MOST_BITS {
        return false;
    }
    let within = match bits {
        ..150.0 => inside::<192>(e, bits),
        ..600.0 => inside::<640>(e, bits),
        _ => inside::<4096>(e, bits),
    };
    within.unwrap_or(false)
}

/// Whether the value lies within 2^−bits of zero.
fn inside<const BITS: u32>(e: &Expr, bits: f64) -> Option<bool> {
    let size = measure::of(&[e])?;
    if size.evaluations(BITS) == 0 {
        return None;
    }
    let Outcome::Value(Big(value)) = evaluate::<Big<BITS>>(e, &Point::default()) else {
        return None;
    };
    let bound = Dyadic::new(1, -(bits.ceil() as i64));
    Some(value.high < bound && bound.neg() < value.low)
}

/// Binary logarithms of what bounds all conjugates of numerator and denominator.
#[derive(Clone, Copy)]
struct Bounds {
    above: f64,
    below: f64,
}

impl Bounds {
    fn new(above: f64, below: f64) -> Bounds {
        Bounds { above, below }
    }
}

/// The field a number lives in: its roots, their degrees together, and the common denominator of its turns.
struct Extent {
    roots: BTreeSet<Expr>,
    degree: f64,
    turns: u32,
}

impl Extent {
    fn size(&mut self, e: &Expr) -> Option<Bounds> {
        match e.node() {
            Node::Number(value) => {
                let below = (value.denom() - &Int::one()).bits();
                Some(Bounds::new(value.numer().bits() as f64, below as f64))
            }
            Node::Symbol(_) => None,
            Node::Sum(terms) => {
                let mut total = self.size(&terms[0])?;
                for term in &terms[1..] {
                    let term = self.size(term)?;
                    let (x, y) = (total.above + term.below, term.above + total.below);
                    let more = (-(x - y).abs()).exp2().ln_1p() / std::f64::consts::LN_2;
                    total = Bounds::new(x.max(y) + more, total.below + term.below);
                }
                Some(total)
            }
            Node::Product(factors) => {
                let mut total = self.size(&factors[0])?;
                for factor in &factors[1..] {
                    let factor = self.size(factor)?;
                    total = Bounds::new(total.above + factor.above, total.below + factor.below);
                }
                Some(total)
            }
            Node::Power(base, exponent) => self.power(base, exponent.as_number()?),
            Node::Call(function, argument) => self.call(*function, argument),
        }
    }

    fn power(&mut self, base: &Expr, exponent: &Rational) -> Option<Bounds> {
        let mut size = self.size(base)?;
        let degree = exponent.denom().to_u32().filter(|n| *n <= 1_000)?;
        if degree > 1 {
            let n = f64::from(degree);
            let root = base.power(Expr::from(ratio(1, i64::from(degree))));
            if self.roots.insert(root) {
                self.degree *= n;
            }
            // The root of a/b is that of a·bⁿ⁻¹ over b.
            size.above = (size.above + (n - 1.0) * size.below) / n;
        }
        let times = exponent.numer().abs().to_f64().filter(|k| *k < 1e6)?;
        let (above, below) = (size.above * times, size.below * times);
        Some(match exponent.is_negative() {
            true => Bounds::new(below, above),
            false => Bounds::new(above, below),
        })
    }

    /// Twice the sine or cosine of a fraction of π is a sum of two roots of unity.
    fn call(&mut self, function: Function, argument: &Expr) -> Option<Bounds> {
        if function == Function::Abs {
            return self.size(argument);
        }
        let angle = angle(argument).filter(|a| a.symbols.is_empty())?;
        let half = ratio(1, 2);
        let mut turn = |q: Rational| {
            let n = (q * &half).denom().to_u32()?;
            self.turns = Some(self.turns.lcm(&n)).filter(|n| *n <= 100_000)?;
            Some(())
        };
        if matches!(function, Function::Cos | Function::Tan) {
            turn(angle.pi.clone())?;
        }
        match function {
            Function::Cos => {}
            Function::Sin | Function::Tan => turn(&half - &angle.pi)?,
            _ => return None,
        }
        Some(Bounds::new(1.0, 1.0))
    }
}

/// How many numbers below n have no factor in common with it.
fn totient(n: u32) -> u32 {
    let (mut left, mut count, mut p) = (n, n, 2);
    while p * p <= left {
        if left.is_multiple_of(p) {
            count -= count / p;
            while left.is_multiple_of(p) {
                left /= p;
            }
        }
        p += 1;
    }
    if left > 1 {
        count -= count / left;
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cos(p: i64, q: i64) -> Expr {
        (Expr::pi() * Expr::ratio(p, q)).cos()
    }

    #[test]
    fn products_of_cosines_and_nested_cube_roots_are_known() {
        let product = Expr::product([cos(1, 9), cos(2, 9), cos(4, 9)]);
        assert!(vanishes(&(product - Expr::ratio(1, 8))));
        let five = Expr::from(5).sqrt();
        let cube = |e: Expr| e.power(Expr::ratio(1, 3));
        let sum = cube(Expr::from(2) + &five) + cube(Expr::from(2) - &five);
        assert!(vanishes(&(&sum - &Expr::one())));
        assert!(!vanishes(&(sum - Expr::ratio(1_000_001, 1_000_000))));
    }

    #[test]
    fn what_is_small_is_not_zero() {
        // √2 to forty digits is not √2.
        let near = Expr::from(Rational::new(
            Int::from(1_414_213_562_373_095_048i64),
            Int::from(1_000_000_000_000_000_000i64),
        ));
        assert!(!vanishes(&(Expr::from(2).sqrt() - near)));
        assert!(!vanishes(&(Expr::pi() - Expr::ratio(355, 113))));
    }
}
