//! Intervals with doubles as ends: fast, and right because every operation rounds outwards.
//!
//! IEEE 754 rounds +, −, ×, ÷ and √ to nearest, so one step outwards (`next_down`, `next_up`) encloses the exact result,
//! overflow and underflow included; a sum or product known to be exact stays where it is. The other functions are taken from the dyadic series.

use std::cell::RefCell;

use num_traits::Zero;
use rustc_hash::FxHashMap;

use super::dyadic::{Dyadic, Round};
use super::{Certified, Enclosure, Outcome, series};
use crate::expr::number::to_f64;
use crate::expr::{Function, Rational, effort};
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
    /// The interval between two doubles.
    pub fn new(low: f64, high: f64) -> Interval {
        Interval { low, high }
    }

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
        let end = Dyadic::from_f64;
        Some(Enclosure::new(end(self.low)?, end(self.high)?))
    }
}

/// Bits for functions: enough that the double ends lose nothing to the series.
const BITS: u32 = 80;

fn back(e: &Enclosure) -> Outcome<Interval> {
    Interval::of(e.low.to_f64(Round::Down), e.high.to_f64(Round::Up))
}

/// Bounds of a + b. The rounding error of a sum is a double, which Knuth's two-sum finds: a sum without one is kept, so that
/// roots and arcs of what vanishes at the end of a domain have values there.
fn sum(a: f64, b: f64) -> (f64, f64) {
    let near = a + b;
    let of_b = near - a;
    let error = (a - (near - of_b)) + (b - of_b);
    // Not a number where a sum overflows: then both ends step.
    let low = if error >= 0.0 { near } else { near.next_down() };
    let high = if error <= 0.0 { near } else { near.next_up() };
    (low, high)
}

/// Bounds of a·b, where 0·∞ is the product of a zero and something finite but large. Factors that have 53 digits between
/// them have an exact product.
fn product(a: f64, b: f64) -> (f64, f64) {
    let near = a * b;
    let zeros_below = |x: f64| x.to_bits().trailing_zeros().min(52);
    if a == 0.0 || b == 0.0 {
        (0.0, 0.0)
    } else if near.is_normal() && zeros_below(a) + zeros_below(b) >= 53 {
        (near, near)
    } else if near == 0.0 && (a > 0.0) == (b > 0.0) {
        (0.0, 0f64.next_up())
    } else {
        (near.next_down(), near.next_up())
    }
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
            Interval::new(near, near)
        } else if near.is_nan() {
            Interval::new(f64::NEG_INFINITY, f64::INFINITY)
        } else {
            Interval::new(near.next_down(), near.next_up())
        }
    }
    fn pi() -> Outcome<Self> {
        // The double nearest to π is 884279719003555/2⁴⁸, about 1.2·10⁻¹⁶ below it.
        let near = std::f64::consts::PI;
        Value(Interval::new(near, near.next_up()))
    }
    fn plus(&self, other: &Self) -> Outcome<Self> {
        Interval::of(sum(self.low, other.low).0, sum(self.high, other.high).1)
    }
    fn times(&self, other: &Self) -> Outcome<Self> {
        let (Interval { low: a, high: b }, Interval { low: c, high: d }) = (*self, *other);
        // Which ends make the least and the greatest product is told by the signs, unless both intervals hold 0.
        let [least, greatest] = match (a >= 0.0, b <= 0.0, c >= 0.0, d <= 0.0) {
            (true, _, true, _) => [(a, c), (b, d)],
            (true, _, _, true) => [(b, c), (a, d)],
            (true, ..) => [(b, c), (b, d)],
            (_, true, true, _) => [(a, d), (b, c)],
            (_, true, _, true) => [(b, d), (a, c)],
            (_, true, ..) => [(a, d), (a, c)],
            (_, _, true, _) => [(a, d), (b, d)],
            (.., true) => [(b, c), (a, c)],
            _ => {
                let low = product(a, d).0.min(product(b, c).0);
                let high = product(a, c).1.max(product(b, d).1);
                return Interval::of(low, high);
            }
        };
        Interval::of(
            product(least.0, least.1).0,
            product(greatest.0, greatest.1).1,
        )
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
            let (low, high) = (self.low.sqrt(), self.high.sqrt());
            Interval::of(
                if low == 0.0 { 0.0 } else { low.next_down() },
                if high == 0.0 { 0.0 } else { high.next_up() },
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
        remembered(function, [self.low, self.high], || match self.dyadic() {
            Some(x) => series::call(&x, function, BITS).then(back),
            None => Unknown,
        })
    }
}

/// Values that are remembered at a time.
const REMEMBERED: usize = 1 << 10;

type Remembered = FxHashMap<(Function, [u64; 2]), Outcome<Interval>>;

/// A value that was found before within the same limit of work: constants and angles of sample points come again and again, and
/// a series takes thousands of times as long as a double.
fn remembered(
    function: Function,
    of: [f64; 2],
    value: impl FnOnce() -> Outcome<Interval>,
) -> Outcome<Interval> {
    thread_local! {
        static KNOWN: RefCell<(u64, Remembered)> = RefCell::default();
    }
    let key = (function, of.map(f64::to_bits));
    let known = KNOWN.with_borrow_mut(|(scope, known)| {
        if *scope != effort::scope() || known.len() >= REMEMBERED {
            known.clear();
            *scope = effort::scope();
        }
        known.get(&key).cloned()
    });
    if let Some(known) = known {
        return known;
    }
    let value = value();
    // What is unknown for want of work may be known with more.
    if !matches!(value, Unknown) {
        KNOWN.with_borrow_mut(|(_, known)| known.insert(key, value.clone()));
    }
    value
}
