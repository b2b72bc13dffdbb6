//! Intervals with doubles as ends: fast, and right because every operation rounds outwards.
//!
//! IEEE 754 rounds +, −, ×, ÷ and √ to nearest, so one step outwards (`next_down`, `next_up`) encloses the exact result,
//! overflow and underflow included. The other functions are taken from the dyadic series.

use num_traits::Zero;

use super::dyadic::{Dyadic, Round};
use super::{Certified, Enclosure, Outcome, series};
use crate::expr::number::to_f64;
use crate::expr::{Function, Rational};
use Outcome::{Undefined, Unknown, Value};

/// A closed interval of reals; ends may be infinite, never NaN.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Interval {
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

impl Interval {
    /// Whether the intervals have no number in common.
    pub fn is_disjoint(&self, other: &Interval) -> bool {
        self.high < other.low || other.high < self.low
    }

    fn of(low: f64, high: f64) -> Outcome<Interval> {
        if low.is_nan() || high.is_nan() || low == f64::INFINITY || high == f64::NEG_INFINITY {
            Unknown
        } else {
            Value(Interval { low, high })
        }
    }

    fn dyadic(&self) -> Option<Enclosure> {
        Some(Enclosure {
            low: Dyadic::from_f64(self.low)?,
            high: Dyadic::from_f64(self.high)?,
        })
    }
}

/// Bits for functions: enough that the double ends lose nothing to the series.
const BITS: u32 = 80;

fn back(e: &Enclosure) -> Outcome<Interval> {
    Interval::of(e.low.to_f64(Round::Down), e.high.to_f64(Round::Up))
}

/// The product of two ends, where 0·∞ is the product of a zero and something finite but large.
fn end(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 { 0.0 } else { a * b }
}

impl Certified for Interval {
    fn from_rational(value: &Rational) -> Self {
        let near = to_f64(value);
        // Only a fraction with a power of two below and a numerator of 53 bits is a double.
        let exact = match (value.numer().as_i64(), value.denom().as_i64()) {
            (Some(n), Some(d)) => n.unsigned_abs() <= 1 << 53 && d > 0 && d & (d - 1) == 0,
            _ => false,
        };
        if exact || value.is_zero() {
            Interval {
                low: near,
                high: near,
            }
        } else if near.is_nan() {
            Interval {
                low: f64::NEG_INFINITY,
                high: f64::INFINITY,
            }
        } else {
            Interval {
                low: near.next_down(),
                high: near.next_up(),
            }
        }
    }
    fn pi() -> Outcome<Self> {
        // The double nearest to π is 884279719003555/2⁴⁸, about 1.2·10⁻¹⁶ below it.
        Value(Interval {
            low: std::f64::consts::PI,
            high: std::f64::consts::PI.next_up(),
        })
    }
    fn plus(&self, other: &Self) -> Outcome<Self> {
        // Adding an exact zero keeps the ends.
        if other.low == 0.0 && other.high == 0.0 {
            return Value(*self);
        }
        if self.low == 0.0 && self.high == 0.0 {
            return Value(*other);
        }
        Interval::of(
            (self.low + other.low).next_down(),
            (self.high + other.high).next_up(),
        )
    }
    fn times(&self, other: &Self) -> Outcome<Self> {
        let ends = [
            end(self.low, other.low),
            end(self.low, other.high),
            end(self.high, other.low),
            end(self.high, other.high),
        ];
        let low = ends.iter().copied().fold(f64::INFINITY, f64::min);
        let high = ends.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        // A zero end is exact only if a factor is exactly zero there; a product that underflowed is not, so step anyway.
        if (self.low == 0.0 && self.high == 0.0) || (other.low == 0.0 && other.high == 0.0) {
            return Value(Interval {
                low: 0.0,
                high: 0.0,
            });
        }
        let low = if low == 0.0 && self.low >= 0.0 && other.low >= 0.0 {
            0.0
        } else {
            low.next_down()
        };
        Interval::of(low, high.next_up())
    }
    fn recip(&self) -> Outcome<Self> {
        if self.low > 0.0 || self.high < 0.0 {
            Interval::of((1.0 / self.high).next_down(), (1.0 / self.low).next_up())
        } else if self.low == 0.0 && self.high == 0.0 {
            Undefined
        } else {
            Unknown
        }
    }
    fn sqrt(&self) -> Outcome<Self> {
        if self.high < 0.0 {
            Undefined
        } else if self.low >= 0.0 {
            let low = self.low.sqrt();
            Interval::of(
                if low == 0.0 { 0.0 } else { low.next_down() },
                self.high.sqrt().next_up(),
            )
        } else {
            Unknown
        }
    }
    fn pow(&self, exponent: &Self) -> Outcome<Self> {
        if self.high < 0.0 {
            return Undefined;
        }
        match (self.dyadic(), exponent.dyadic()) {
            (Some(x), Some(y)) if self.low > 0.0 => series::ln(&x, BITS)
                .then(|l| series::exp(&l.mul(&y, BITS), BITS))
                .then(back),
            _ => Unknown,
        }
    }
    fn below_zero(&self) -> bool {
        self.high < 0.0
    }
    fn call(&self, function: Function) -> Outcome<Self> {
        match self.dyadic() {
            Some(x) => series::call(&x, function, BITS).then(back),
            None => Unknown,
        }
    }
}
