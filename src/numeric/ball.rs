//! Balls: a double-double and a bound of its error. The true value is never outside.
//!
//! Zeros of the geometry stay exact zeros, so elimination sees the sparsity. Every bound is rounded up by a factor that
//! covers its own few roundings, and every product adds a floor that covers underflow.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg};

use super::dd::{Dd, turned, two_product, two_sum};
use super::number::Number;
use crate::expr::number::from_f64;
use crate::expr::{Function, Rational, Scalar};

/// All numbers within `error` of `middle`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ball {
    /// Middle.
    pub middle: Dd,
    /// Radius, rounded up; infinite where nothing is known.
    pub error: f64,
}

/// Relative error of one double-double sum or product, rounded up.
const STEP: f64 = 1.0 / (1u128 << 102) as f64;
/// Relative error of a reciprocal or root, rounded up.
const LONG_STEP: f64 = 1.0 / (1u128 << 98) as f64;
/// Covers the few roundings inside a bound.
const UP: f64 = 1.0 + 1e-14;
/// Covers what a product loses to underflow.
const FLOOR: f64 = 1e-290;

impl Ball {
    /// A double, exactly.
    #[inline]
    pub fn exact(value: f64) -> Ball {
        Ball {
            middle: Dd::exact(value),
            error: 0.0,
        }
    }

    /// Largest absolute value inside.
    #[inline]
    fn reach(&self) -> f64 {
        (self.middle.high.abs() + self.middle.low.abs() + self.error) * UP
    }

    /// A lower bound of the absolute value; 0 where zero may be inside.
    #[inline]
    pub fn least(&self) -> f64 {
        ((self.middle.high.abs() - self.middle.low.abs() - self.error) * (1.0 - 1e-14)).max(0.0)
    }

    /// The double nearest to every number inside; `None` where the ball is too wide to tell, or the double would be
    /// subnormal or infinite.
    #[inline]
    pub fn rounded(&self) -> Option<f64> {
        let Dd { high, low } = self.middle;
        if self.error == 0.0 && low == 0.0 {
            return high.is_finite().then_some(high);
        }
        let (up, down) = ((low + self.error).next_up(), (low - self.error).next_down());
        // Rounding is monotone: where both ends round to one double, so does all between.
        let normal = high.abs() >= 2.0 * f64::MIN_POSITIVE && high.abs() < f64::MAX;
        (normal && high + up == high && high + down == high).then_some(high)
    }

    /// The sign of the numbers inside, where they share one.
    pub fn sign(&self) -> Option<Ordering> {
        if self.error == 0.0 && self.middle.high == 0.0 {
            return Some(Ordering::Equal);
        }
        (self.least() > 0.0).then(|| self.middle.high.total_cmp(&0.0))
    }
}

impl Scalar for Ball {
    fn from_rational(value: &Rational) -> Ball {
        let middle = Dd::from_rational(value);
        let stored = from_f64(middle.high)
            .zip(from_f64(middle.low))
            .map(|(h, l)| h + l);
        let exact = stored.as_ref() == Some(value);
        let error = match (exact, middle.high.is_finite()) {
            (true, _) => 0.0,
            (false, true) => middle.high.abs() * STEP + FLOOR,
            _ => f64::INFINITY,
        };
        Ball { middle, error }
    }
    fn pi() -> Option<Ball> {
        Some(Ball {
            middle: super::dd::PI,
            error: 4.0 * STEP,
        })
    }
    #[inline]
    fn plus(&self, other: &Ball) -> Ball {
        if self.middle.low == 0.0 && other.middle.low == 0.0 {
            let middle = two_sum(self.middle.high, other.middle.high);
            return Ball {
                middle,
                error: (self.error + other.error) * UP,
            };
        }
        let middle = self.middle.add(other.middle);
        Ball {
            middle,
            error: (self.error + other.error + STEP * middle.high.abs()) * UP,
        }
    }
    #[inline]
    fn times(&self, other: &Ball) -> Ball {
        if self.is_zero() || other.is_zero() {
            return Ball::default();
        }
        let (a, b) = (self.middle, other.middle);
        if a.low == 0.0 && b.low == 0.0 && self.error == 0.0 && other.error == 0.0 {
            let middle = two_product(a.high, b.high);
            let exact = middle.high.abs() > 1e-280;
            return Ball {
                middle,
                error: if exact { 0.0 } else { FLOOR },
            };
        }
        let middle = a.mul(b);
        let spread =
            a.high.abs() * other.error + b.high.abs() * self.error + self.error * other.error;
        // The middles may exceed their leading doubles by one unit in the last place, which UP covers.
        Ball {
            middle,
            error: (spread + STEP * middle.high.abs() + FLOOR) * UP,
        }
    }
    #[inline]
    fn recip(&self) -> Option<Ball> {
        let least = self.least();
        if least <= 1e-290 || self.reach() >= 1e290 {
            return None;
        }
        let middle = self.middle.inverse();
        let value = middle.high.abs();
        Some(Ball {
            middle,
            error: (self.error * value / least + LONG_STEP * value + FLOOR) * UP,
        })
    }
    fn sqrt(&self) -> Option<Ball> {
        if self.error == 0.0 && self.middle.high == 0.0 {
            return Some(*self);
        }
        let least = self.least();
        if least <= 1e-280 || self.middle.high < 0.0 {
            return None;
        }
        let middle = self.middle.root();
        let error = (self.error / least.sqrt() + LONG_STEP * middle.high + FLOOR) * UP;
        Some(Ball { middle, error })
    }
    fn pow(&self, _: &Ball) -> Option<Ball> {
        None
    }
    fn call(&self, function: Function) -> Option<Ball> {
        // Slope at most 1, absolute error of the series below 2⁻⁹⁸.
        let wave = |middle: Dd| Ball {
            middle,
            error: (self.error + LONG_STEP) * UP,
        };
        if self.is_zero() && matches!(function, Function::Sin | Function::Tan) {
            return Some(*self);
        }
        match function {
            Function::Sin => turned(self.middle).map(|[_, s]| wave(s)),
            Function::Cos => turned(self.middle).map(|[c, _]| wave(c)),
            Function::Tan => {
                let [c, s] = turned(self.middle)?.map(wave);
                Some(s.times(&c.recip()?))
            }
            Function::Abs => match self.sign()? {
                Ordering::Less => Some(self.negated()),
                _ => Some(*self),
            },
            _ => None,
        }
    }
}

impl Number for Ball {
    fn zero() -> Ball {
        Ball::default()
    }
    fn one() -> Ball {
        Ball::exact(1.0)
    }
    #[inline]
    fn is_zero(&self) -> bool {
        self.middle.high == 0.0 && self.error == 0.0
    }
    #[inline]
    fn minus(&self, other: &Ball) -> Ball {
        self.plus(&other.negated())
    }
    #[inline]
    fn negated(&self) -> Ball {
        Ball {
            middle: self.middle.neg(),
            error: self.error,
        }
    }
    fn halved(&self) -> Ball {
        let middle = self.middle.halved();
        let exact = middle.high.abs() > 1e-280 || middle.high == 0.0;
        Ball {
            middle,
            error: 0.5 * self.error + if exact { 0.0 } else { FLOOR },
        }
    }
    fn size(&self) -> f64 {
        self.reach()
    }
}
