//! The law of rigid motion over any number, and enclosures of any precision as numbers, for values that are no fractions.

use num_traits::{One, Zero};

use crate::expr::Scalar;
use crate::expr::arithmetic::Number;
use crate::interval::dyadic::Round;
use crate::interval::{Big, Enclosure, Outcome};

/// Velocity at a point whose position relative to the reference point is `arm`: v + ω × r.
pub fn velocity_at<T: Number>(velocity: &[T; 2], spin: &T, arm: &[T; 2]) -> [T; 2] {
    [
        velocity[0].minus(&spin.times(&arm[1])),
        velocity[1].plus(&spin.times(&arm[0])),
    ]
}

/// An enclosure of `BITS` bits; what it cannot decide, a reciprocal around zero say, stays unknown to the end.
impl<const BITS: u32> Number for Outcome<Big<BITS>> {
    fn zero() -> Self {
        Scalar::from_rational(&Zero::zero())
    }
    fn one() -> Self {
        Scalar::from_rational(&One::one())
    }
    fn is_zero(&self) -> bool {
        matches!(self, Outcome::Value(v) if v.0.is_exact() && v.0.low.sign() == 0)
    }
    fn minus(&self, other: &Self) -> Self {
        self.plus(&other.negated())
    }
    fn negated(&self) -> Self {
        each(self, Enclosure::neg)
    }
    fn halved(&self) -> Self {
        each(self, |v| v.scale(-1))
    }
    fn size(&self) -> f64 {
        match self {
            Outcome::Value(v) if !v.0.has_zero() => v.0.abs().high.to_f64(Round::Up),
            _ => 0.0,
        }
    }
}

fn each<const BITS: u32>(
    of: &Outcome<Big<BITS>>,
    f: impl Fn(&Enclosure) -> Enclosure,
) -> Outcome<Big<BITS>> {
    match of {
        Outcome::Value(v) => Outcome::Value(Big(f(&v.0))),
        other => other.clone(),
    }
}
