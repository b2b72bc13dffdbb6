//! Balls: a double-double and a bound of its error. The true value is never outside.
//!
//! The two doubles of a middle are left as they come (pair arithmetic, Lange & Rump 2020): the leading ones are what plain
//! doubles would give, the rests run behind, and only reading brings both into order. Reading also widens the bound by a
//! factor that covers the roundings inside it, and every product adds a floor that covers underflow. Zeros of the
//! geometry stay exact zeros, so elimination sees the sparsity.

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
    /// Radius before [`Ball::radius`] rounds it up; infinite or NaN where nothing is known.
    error: f64,
}

/// Relative error of one rounding.
const ROUNDING: f64 = 1.0 / (1u64 << 53) as f64;
/// The same four times over.
const FOUR: f64 = 4.0 * ROUNDING;
/// The same of a rounding's own rounding, twice over.
const FINEST: f64 = 2.0 * ROUNDING * ROUNDING;
/// Relative error of a number as a double-double, rounded up.
const STEP: f64 = 1.0 / (1u128 << 102) as f64;
/// Relative error of a root, absolute error of a sine, rounded up.
const LONG_STEP: f64 = 1.0 / (1u128 << 98) as f64;
/// Covers the roundings inside a bound, some ten in each of up to 10⁵ operations one after another.
const UP: f64 = 1.0 + 1e-9;
/// Covers what a product loses to underflow.
const FLOOR: f64 = 1e-290;
/// Far enough above the smallest doubles that halves and roots lose nothing.
const SAFE: f64 = 1e-280;

impl Ball {
    /// A double, exactly.
    #[inline(always)]
    pub fn exact(value: f64) -> Ball {
        Ball {
            middle: Dd::exact(value),
            error: 0.0,
        }
    }

    /// The sum of two doubles, exactly.
    #[inline(always)]
    pub fn sum(a: f64, b: f64) -> Ball {
        Ball {
            middle: two_sum(a, b),
            error: 0.0,
        }
    }

    /// The product of two doubles that are not zero.
    #[inline(always)]
    pub fn product(a: f64, b: f64) -> Ball {
        Ball {
            middle: two_product(a, b),
            error: FLOOR,
        }
    }

    /// The product of two numbers of which none is exactly zero; where one is, the outcome is no exact zero.
    #[inline(always)]
    pub fn by(&self, other: &Ball) -> Ball {
        let (a, b) = (self.middle, other.middle);
        let lead = two_product(a.high, b.high);
        let (p, q) = (a.high * b.low, a.low * b.high);
        let mixed = p + q;
        let low = lead.low + mixed;
        // The roundings of p, q and both sums are at most 2⁻⁵³ of 3|p| + 3|q| + |lead.low|. What is left out, and what the
        // errors that came in bring, are the products below.
        let (rest_a, rest_b) = (a.low.abs(), b.low.abs());
        let spread = a.high.abs() * (other.error + FOUR * rest_b)
            + b.high.abs() * (self.error + FOUR * rest_a)
            + (rest_a + self.error) * (rest_b + other.error);
        Ball {
            middle: Dd {
                high: lead.high,
                low,
            },
            error: spread + (lead.high.abs() * FINEST + FLOOR),
        }
    }

    /// 1 over a double that is not zero; infinitely wide for zero.
    #[inline(always)]
    pub fn inverse(of: f64) -> Ball {
        // As `recip` below with nothing to spread.
        let q = 1.0 / of;
        let back = two_product(q, of);
        let gap = (1.0 - back.high) - back.low;
        let slips = 2.0 * gap * gap + (8.0 * ROUNDING * gap.abs() + FLOOR);
        Ball {
            middle: Dd {
                high: q,
                low: gap * q,
            },
            error: q.abs() * slips + FLOOR,
        }
    }

    /// The sum with a double.
    #[inline(always)]
    pub fn plus_double(self, other: f64) -> Ball {
        let lead = two_sum(self.middle.high, other);
        let low = lead.low + self.middle.low;
        let slip = ROUNDING * low.abs();
        Ball {
            middle: Dd {
                high: lead.high,
                low,
            },
            error: self.error + slip,
        }
    }

    /// The product with a double, neither being exactly zero.
    #[inline(always)]
    pub fn times_double(self, other: f64) -> Ball {
        let Dd { high, low } = self.middle;
        let lead = two_product(high, other);
        let mixed = low * other;
        let rest = lead.low + mixed;
        let slips = ROUNDING * (mixed.abs() + rest.abs());
        Ball {
            middle: Dd {
                high: lead.high,
                low: rest,
            },
            error: other.abs() * self.error + (slips + FLOOR),
        }
    }

    /// The same with the middle in order: the low double at most a rounding of the high one.
    #[inline(always)]
    fn in_order(self) -> Ball {
        let Dd { high, low } = self.middle;
        Ball {
            middle: two_sum(high, low),
            error: self.error,
        }
    }

    /// A bound of the distance of the true value from the middle.
    #[inline(always)]
    pub fn radius(&self) -> f64 {
        self.error * UP
    }

    /// Largest absolute value inside.
    #[inline(always)]
    fn reach(&self) -> f64 {
        (self.middle.high.abs() + self.middle.low.abs() + self.error) * UP
    }

    /// A lower bound of the absolute value; 0 where zero may be inside.
    #[inline(always)]
    pub fn least(&self) -> f64 {
        ((self.middle.high.abs() - self.middle.low.abs() - self.radius()) * (1.0 - 1e-14)).max(0.0)
    }

    /// The double nearest to every number inside; `None` where the ball is too wide to tell, or the double would be
    /// subnormal or infinite.
    #[inline(always)]
    pub fn rounded(&self) -> Option<f64> {
        let Dd { high, low } = self.in_order().middle;
        // More than the roundings of the two sums below; nothing where the ball is a double.
        let reach = self.radius() + low.abs() * (4.0 * ROUNDING);
        let normal = high.abs() >= 2.0 * f64::MIN_POSITIVE && high.abs() < f64::MAX;
        // Rounding is monotone: where both ends round to one double, so does all between.
        let told = high + (low + reach) == high && high + (low - reach) == high;
        (told && (normal || reach == 0.0)).then_some(high)
    }

    /// The double that is the only number inside: no rounding took place on the way to it.
    #[inline(always)]
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
    #[inline(always)]
    fn plus(&self, other: &Ball) -> Ball {
        let lead = two_sum(self.middle.high, other.middle.high);
        let lows = self.middle.low + other.middle.low;
        let low = lead.low + lows;
        let slips = ROUNDING * (lows.abs() + low.abs());
        Ball {
            middle: Dd {
                high: lead.high,
                low,
            },
            error: (self.error + other.error) + slips,
        }
    }
    #[inline(always)]
    fn times(&self, other: &Ball) -> Ball {
        if self.is_zero() || other.is_zero() {
            return Ball::default();
        }
        self.by(other)
    }
    #[inline(always)]
    fn recip(&self) -> Option<Ball> {
        // 1/x = q + q(1 − qx) + …, the rest of the series below the square of what 1 − qx may be.
        let q = 1.0 / self.middle.high;
        let back = two_product(q, self.middle.high);
        let (gap, part) = ((1.0 - back.high) - back.low, q * self.middle.low);
        let change = gap - part;
        let spread = q.abs() * self.error;
        let roundings = 4.0 * ROUNDING * (gap.abs() + part.abs());
        let far = (change.abs() + spread) + (roundings + FLOOR);
        if far < 0.4 {
            let slips = roundings + (4.0 * ROUNDING * change.abs() + FLOOR);
            return Some(Ball {
                middle: Dd {
                    high: q,
                    low: change * q,
                },
                error: q.abs() * (2.0 * far * far + (slips + spread)) + FLOOR,
            });
        }
        // Zero, beyond the range, or a middle out of order.
        let ball = self.in_order();
        let [old, new] = [self.middle.high, ball.middle.high];
        (new.is_finite() && new != old).then(|| ball.recip())?
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
        let error = self.error / least.sqrt() + LONG_STEP * middle.high + FLOOR;
        Some(Ball { middle, error })
    }
    fn pow(&self, _: &Ball) -> Option<Ball> {
        None
    }
    fn call(&self, function: Function) -> Option<Ball> {
        // Slope at most 1, absolute error of the series below 2⁻⁹⁸.
        let wave = |middle: Dd| Ball {
            middle,
            error: self.error + LONG_STEP,
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
    #[inline(always)]
    fn is_zero(&self) -> bool {
        self.middle.high == 0.0 && self.middle.low == 0.0 && self.error == 0.0
    }
    #[inline(always)]
    fn minus(&self, other: &Ball) -> Ball {
        self.plus(&other.negated())
    }
    #[inline(always)]
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
