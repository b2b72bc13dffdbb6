//! Balls: a double-double and a bound of its error. The true value is never outside.
//!
//! The two doubles of a middle are left as they come (pair arithmetic, Lange & Rump 2020): the leading ones are what plain
//! doubles would give, the rests run behind, and only reading brings both into order. Every bound is rounded up by a
//! factor that covers its own few roundings, and every product adds a floor that covers underflow. Zeros of the geometry
//! stay exact zeros, so elimination sees the sparsity.

use std::cmp::Ordering;
use std::ops::Neg;

use super::dd::{Dd, turned, two_product, two_sum};
use super::number::Number;
use crate::expr::number::from_f64;
use crate::expr::{Function, Rational, Scalar};

/// All numbers within `error` of `middle`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ball {
    /// Middle; its low double may be larger than a rounding of the high one.
    pub middle: Dd,
    /// Radius, rounded up; infinite or NaN where nothing is known.
    pub error: f64,
}

/// Relative error of one rounding.
const ROUNDING: f64 = 1.0 / (1u64 << 53) as f64;
/// Relative error of a number as a double-double, rounded up.
const STEP: f64 = 1.0 / (1u128 << 102) as f64;
/// Relative error of a root, absolute error of a sine, rounded up.
const LONG_STEP: f64 = 1.0 / (1u128 << 98) as f64;
/// Covers the few roundings inside a bound.
const UP: f64 = 1.0 + 1e-14;
/// Covers what a product loses to underflow.
const FLOOR: f64 = 1e-290;
/// A product of doubles above this is the sum of two doubles exactly.
const SAFE: f64 = 1e-280;

impl Ball {
    /// A double, exactly.
    #[inline]
    pub fn exact(value: f64) -> Ball {
        Ball {
            middle: Dd::exact(value),
            error: 0.0,
        }
    }

    /// The sum of two doubles, exactly.
    #[inline]
    pub fn sum(a: f64, b: f64) -> Ball {
        Ball {
            middle: two_sum(a, b),
            error: 0.0,
        }
    }

    /// The product of two doubles, exactly but for underflow.
    #[inline]
    pub fn product(a: f64, b: f64) -> Ball {
        let middle = two_product(a, b);
        let exact = middle.high.abs() > SAFE || a == 0.0 || b == 0.0;
        Ball {
            middle,
            error: if exact { 0.0 } else { FLOOR },
        }
    }

    /// The sum with a double.
    #[inline]
    pub fn plus_double(self, other: f64) -> Ball {
        let lead = two_sum(self.middle.high, other);
        let low = lead.low + self.middle.low;
        // A sum errs by no more than a rounding, and by no more than its smaller part.
        let slip = (ROUNDING * low.abs()).min(self.middle.low.abs());
        Ball {
            middle: Dd {
                high: lead.high,
                low,
            },
            error: (self.error + slip) * UP,
        }
    }

    /// The product with a double.
    #[inline]
    pub fn times_double(self, other: f64) -> Ball {
        let Dd { high, low } = self.middle;
        if low == 0.0 && self.error == 0.0 {
            return Ball::product(high, other);
        }
        if other == 0.0 {
            return Ball::default();
        }
        let lead = two_product(high, other);
        let mixed = low * other;
        let rest = lead.low + mixed;
        let slips = ROUNDING * (mixed.abs() + rest.abs());
        Ball {
            middle: Dd {
                high: lead.high,
                low: rest,
            },
            error: (other.abs() * self.error + (slips + FLOOR)) * UP,
        }
    }

    /// The same with the middle in order: the low double at most a rounding of the high one.
    #[inline]
    fn in_order(self) -> Ball {
        let Dd { high, low } = self.middle;
        Ball {
            middle: two_sum(high, low),
            error: self.error,
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
        let ball = self.in_order();
        let Dd { high, low } = ball.middle;
        if ball.error == 0.0 && low == 0.0 {
            return high.is_finite().then_some(high);
        }
        let (up, down) = ((low + ball.error).next_up(), (low - ball.error).next_down());
        // Rounding is monotone: where both ends round to one double, so does all between.
        let normal = high.abs() >= 2.0 * f64::MIN_POSITIVE && high.abs() < f64::MAX;
        (normal && high + up == high && high + down == high).then_some(high)
    }

    /// The double that is the only number inside: no rounding took place on the way to it.
    #[inline]
    pub fn as_double(&self) -> Option<f64> {
        let exact = self.error == 0.0 && self.middle.low == 0.0 && self.middle.high.is_finite();
        exact.then_some(self.middle.high)
    }

    /// The sign of the numbers inside, where they share one.
    pub fn sign(&self) -> Option<Ordering> {
        let ball = self.in_order();
        if ball.is_zero() {
            return Some(Ordering::Equal);
        }
        (ball.least() > 0.0).then(|| ball.middle.high.total_cmp(&0.0))
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
        let lead = two_sum(self.middle.high, other.middle.high);
        let lows = self.middle.low + other.middle.low;
        let low = lead.low + lows;
        let slips = ROUNDING * lows.abs() + (ROUNDING * low.abs()).min(lows.abs());
        Ball {
            middle: Dd {
                high: lead.high,
                low,
            },
            error: ((self.error + other.error) + slips) * UP,
        }
    }
    #[inline]
    fn times(&self, other: &Ball) -> Ball {
        let (a, b) = (self.middle, other.middle);
        let (spread_a, spread_b) = (a.low.abs() + self.error, b.low.abs() + other.error);
        if spread_a == 0.0 && spread_b == 0.0 {
            return Ball::product(a.high, b.high);
        }
        if self.is_zero() || other.is_zero() {
            return Ball::default();
        }
        let lead = two_product(a.high, b.high);
        let (p, q) = (a.high * b.low, a.low * b.high);
        let mixed = p + q;
        let low = lead.low + mixed;
        // Four roundings, the product of the lows that is left out, and the errors that came in.
        let slips = ROUNDING * ((p.abs() + q.abs()) + (mixed.abs() + low.abs()));
        let spread = (a.high.abs() + a.low.abs()) * other.error
            + (b.high.abs() + spread_b) * self.error
            + (a.low * b.low).abs();
        Ball {
            middle: Dd {
                high: lead.high,
                low,
            },
            error: (spread + (slips + FLOOR)) * UP,
        }
    }
    #[inline]
    fn recip(&self) -> Option<Ball> {
        let Ball { middle, error } = self.in_order();
        let size = middle.high.abs();
        if !(size > 1e-290 && size < 1e290) {
            return None;
        }
        // 1/x = q + q(1 − qx) + …, the rest of the series below the square of what 1 − qx may be.
        let q = 1.0 / middle.high;
        let back = two_product(q, middle.high);
        let (gap, part) = ((1.0 - back.high) - back.low, q * middle.low);
        let change = gap - part;
        let spread = q.abs() * error;
        let far = change.abs() + spread + 4.0 * ROUNDING * (gap.abs() + part.abs()) + FLOOR;
        if far.is_nan() || far > 0.5 {
            return None;
        }
        let slips = 4.0 * ROUNDING * (gap.abs() + part.abs() + change.abs());
        Some(Ball {
            middle: Dd {
                high: q,
                low: change * q,
            },
            error: (q.abs() * (2.0 * far * far + slips + spread + FLOOR) + FLOOR) * UP,
        })
    }
    fn sqrt(&self) -> Option<Ball> {
        if self.is_zero() {
            return Some(*self);
        }
        let ball = self.in_order();
        let least = ball.least();
        if least <= SAFE || ball.middle.high < 0.0 {
            return None;
        }
        let middle = ball.middle.root();
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
        let ordered = self.in_order().middle;
        match function {
            Function::Sin => turned(ordered).map(|[_, s]| wave(s)),
            Function::Cos => turned(ordered).map(|[c, _]| wave(c)),
            Function::Tan => {
                let [c, s] = turned(ordered)?.map(wave);
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
        self.middle.high == 0.0 && self.middle.low == 0.0 && self.error == 0.0
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
        let kept = |half: f64| half == 0.0 || half.abs() > SAFE;
        let exact = kept(self.middle.high) && kept(self.middle.low);
        Ball {
            middle,
            error: 0.5 * self.error + if exact { 0.0 } else { FLOOR },
        }
    }
    fn size(&self) -> f64 {
        self.reach()
    }
}
