//! Intervals with dyadic ends at a chosen precision, and the same with the precision in the type.

use num_traits::{Signed, Zero};

use super::dyadic::{Dyadic, Round};
use super::{Certified, Outcome, series};
use crate::expr::number::to_f64;
use crate::expr::{Function, Int, Rational};

/// Numbers beyond 2^±`RANGE` are not followed: their exponents alone would fill memory.
const RANGE: i64 = 1 << 40;
/// Exponents of two beyond which no double is near.
const FAR: i64 = 1200;

/// A closed interval that contains the value meant.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Enclosure {
    /// Lower end.
    pub low: Dyadic,
    /// Upper end.
    pub high: Dyadic,
}

impl Enclosure {
    /// The interval between two numbers.
    pub fn new(low: Dyadic, high: Dyadic) -> Enclosure {
        Enclosure { low, high }
    }

    /// The interval of one number.
    pub fn point(x: Dyadic) -> Enclosure {
        Enclosure::new(x.clone(), x)
    }

    /// The interval between two numbers, rounded outwards.
    fn outwards(low: Dyadic, high: Dyadic, bits: u32) -> Enclosure {
        Enclosure::new(low.round(bits, Round::Down), high.round(bits, Round::Up))
    }

    /// The interval with ends of fewer bits.
    pub(super) fn rounded(&self, bits: u32) -> Enclosure {
        Enclosure::outwards(self.low.clone(), self.high.clone(), bits)
    }

    /// How wide it is at most.
    pub(super) fn width(&self, bits: u32) -> Dyadic {
        self.high.add(&self.low.neg(), bits, Round::Up)
    }

    /// Above which power of two no number of it lies.
    pub(super) fn top(&self) -> i64 {
        self.low.top().max(self.high.top())
    }

    /// The tightest interval of the precision around a fraction.
    pub fn of(value: &Rational, bits: u32) -> Enclosure {
        let end = |to| Dyadic::from_rational(value, bits, to);
        Enclosure::new(end(Round::Down), end(Round::Up))
    }

    /// Whether the interval is one number.
    pub fn is_exact(&self) -> bool {
        self.low == self.high
    }

    /// Whether zero lies inside.
    pub fn has_zero(&self) -> bool {
        self.low.sign() <= 0 && self.high.sign() >= 0
    }

    /// Whether the intervals have no number in common.
    pub fn is_disjoint(&self, other: &Enclosure) -> bool {
        self.high < other.low || other.high < self.low
    }

    /// Whether a fraction lies inside.
    pub fn contains(&self, value: &Rational) -> bool {
        let bits = 64 + (self.low.mantissa.bits().max(self.high.mantissa.bits())) as u32;
        let tight = Enclosure::of(value, bits.max(value.numer().bits() as u32 + 64));
        self.low <= tight.low && tight.high <= self.high
    }

    /// −x.
    pub fn neg(&self) -> Enclosure {
        Enclosure::new(self.high.neg(), self.low.neg())
    }

    /// x·2^k.
    pub fn scale(&self, k: i64) -> Enclosure {
        Enclosure::new(self.low.scale(k), self.high.scale(k))
    }

    /// Sum.
    pub fn add(&self, other: &Enclosure, bits: u32) -> Enclosure {
        let low = self.low.add(&other.low, bits, Round::Down);
        Enclosure::new(low, self.high.add(&other.high, bits, Round::Up))
    }

    /// Difference.
    pub fn sub(&self, other: &Enclosure, bits: u32) -> Enclosure {
        self.add(&other.neg(), bits)
    }

    /// Product.
    pub fn mul(&self, other: &Enclosure, bits: u32) -> Enclosure {
        let (low, high) = match (self.sides(), other.sides()) {
            (1, 1) => (self.low.mul(&other.low), self.high.mul(&other.high)),
            (-1, -1) => (self.high.mul(&other.high), self.low.mul(&other.low)),
            (1, -1) => (self.high.mul(&other.low), self.low.mul(&other.high)),
            (-1, 1) => (self.low.mul(&other.high), self.high.mul(&other.low)),
            _ => {
                let (a, b) = (self.low.mul(&other.high), self.high.mul(&other.low));
                let (c, d) = (self.low.mul(&other.low), self.high.mul(&other.high));
                (a.min(b), c.max(d))
            }
        };
        Enclosure::outwards(low, high, bits)
    }

    /// Square; never negative.
    pub fn square(&self, bits: u32) -> Enclosure {
        let a = self.abs();
        Enclosure::outwards(a.low.mul(&a.low), a.high.mul(&a.high), bits)
    }

    /// Reciprocal; `None` around zero.
    pub fn recip(&self, bits: u32) -> Option<Enclosure> {
        (!self.has_zero()).then(|| {
            let low = self.high.recip(bits, Round::Down);
            Enclosure::new(low, self.low.recip(bits, Round::Up))
        })
    }

    /// Square root; `None` where the interval reaches below zero.
    pub fn sqrt(&self, bits: u32) -> Option<Enclosure> {
        (self.low.sign() >= 0).then(|| {
            let low = self.low.sqrt(bits, Round::Down);
            Enclosure::new(low, self.high.sqrt(bits, Round::Up))
        })
    }

    /// Absolute value.
    pub fn abs(&self) -> Enclosure {
        match self.sides() {
            1 => self.clone(),
            -1 => self.neg(),
            _ => Enclosure::new(Dyadic::zero(), self.low.neg().max(self.high.clone())),
        }
    }

    /// The interval that ends so much higher.
    pub(super) fn reaching(&self, above: &Dyadic, bits: u32) -> Enclosure {
        let high = self.high.add(above, bits, Round::Up);
        Enclosure::new(self.low.clone(), high)
    }

    /// The interval widened by ±`by`.
    pub fn widen(&self, by: &Dyadic, bits: u32) -> Enclosure {
        let low = self.low.add(&by.neg(), bits, Round::Down);
        Enclosure::new(low, self.high.add(by, bits, Round::Up))
    }

    /// The double nearest to every number inside; `None` where the ends round apart or beyond the range of doubles.
    pub fn nearest(&self) -> Option<f64> {
        if self.is_exact() && self.low.sign() == 0 {
            return Some(0.0);
        }
        // All that lies well below the smallest double rounds to zero.
        let is_tiny = |x: &Dyadic| x.top() < -FAR;
        if !self.has_zero() && is_tiny(&self.low) && is_tiny(&self.high) {
            return Some(0.0);
        }
        // Exponents far outside that range would make fractions too long to hold.
        if [&self.low, &self.high].iter().any(|x| x.top().abs() > FAR) {
            return None;
        }
        let [low, high] = [&self.low, &self.high]
            .map(|end| end.nearest().unwrap_or_else(|| to_f64(&end.to_rational())));
        (low == high && low.is_finite()).then_some(low)
    }

    /// A double near the middle; zero where zero is inside.
    pub fn middle(&self) -> f64 {
        if self.has_zero() {
            return 0.0;
        }
        let near = |end: &Dyadic, to| match end.top() {
            top if top < -FAR => 0.0,
            top if top > FAR => end.to_f64(to),
            _ => end.nearest().unwrap_or_else(|| to_f64(&end.to_rational())),
        };
        0.5 * near(&self.low, Round::Down) + 0.5 * near(&self.high, Round::Up)
    }

    /// Number of decimal digits in which the two ends agree, roughly; large for an exact value.
    pub fn digits(&self) -> u32 {
        let width = self.width(32);
        if width.sign() == 0 {
            return u32::MAX;
        }
        let bits = self.top().saturating_sub(width.top()).max(0) as u64;
        // log10 2 = 0.30103
        (bits * 30_103 / 100_000).min(1_000_000) as u32
    }

    /// A decimal number within half a unit of its last digit of the middle, with the given number of significant digits.
    pub fn decimal(&self, digits: u32) -> String {
        let sum = self.low.add(&self.high, 4 * digits + 64, Round::Down);
        let middle = sum.scale(-1);
        if middle.mantissa.is_zero() {
            return "0".into();
        }
        if middle.top().abs() > 20_000 {
            // The power of ten to six digits; more would need numbers as long as the exponent.
            let log = middle.top() as f64 * std::f64::consts::LOG10_2;
            return format!("{}10^{:.0}", if middle.sign() < 0 { "-" } else { "" }, log);
        }
        decimal(&middle.to_rational(), digits)
    }

    /// 1 where all is ≥ 0, −1 where all is ≤ 0, 0 where both signs occur.
    fn sides(&self) -> i32 {
        match (self.low.sign() >= 0, self.high.sign() <= 0) {
            (true, _) => 1,
            (_, true) => -1,
            _ => 0,
        }
    }

    fn in_range(self) -> Outcome<Enclosure> {
        let fits = |x: &Dyadic| x.mantissa.is_zero() || x.top().abs() <= RANGE;
        match fits(&self.low) && fits(&self.high) {
            true => Outcome::Value(self),
            false => Outcome::Unknown,
        }
    }
}

/// A fraction as a decimal number with the given number of significant digits, half a unit off at most.
pub fn decimal(value: &Rational, digits: u32) -> String {
    if value.is_zero() {
        return "0".into();
    }
    let size = value.numer().bits() as i64 - value.denom().bits() as i64;
    // First guess of the decimal exponent, then at most two corrections.
    let mut exponent = (size * 30_103).div_euclid(100_000) as i32;
    let shown = |exponent: i32| {
        let shift = digits as i32 - 1 - exponent;
        let factor = Rational::from(Int::from(10).pow(shift.unsigned_abs()));
        let scaled = value.abs() * if shift >= 0 { factor } else { factor.recip() };
        scaled.round().to_integer().to_string()
    };
    let mut text = shown(exponent);
    for _ in 0..3 {
        if text.len() as u32 > digits {
            exponent += 1;
        } else if (text.len() as u32) < digits {
            exponent -= 1;
        } else {
            break;
        }
        text = shown(exponent);
    }
    let sign = if value.is_negative() { "-" } else { "" };
    let pointed = |whole: &str, part: &str| match part {
        "" => whole.to_string(),
        _ => format!("{whole}.{part}"),
    };
    let body = match exponent {
        -5..0 => format!("0.{}{text}", "0".repeat((-exponent - 1) as usize)),
        0.. if exponent < digits as i32 => {
            let (whole, part) = text.split_at((exponent as usize + 1).min(text.len()));
            pointed(whole, part)
        }
        _ => format!("{}e{exponent}", pointed(&text[..1], &text[1..])),
    };
    format!("{sign}{body}")
}

/// An enclosure computed with `BITS` bits.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Big<const BITS: u32>(pub Enclosure);

fn known<const BITS: u32>(e: Enclosure) -> Outcome<Big<BITS>> {
    e.in_range().then(|e| Outcome::Value(Big(e.clone())))
}

impl<const BITS: u32> Certified for Big<BITS> {
    const STEPS: u64 = BITS as u64 / 8;

    fn from_rational(value: &Rational) -> Self {
        Big(Enclosure::of(value, BITS))
    }
    fn pi() -> Outcome<Self> {
        Outcome::Value(Big(series::pi(BITS)))
    }
    fn plus(&self, other: &Self) -> Outcome<Self> {
        known(self.0.add(&other.0, BITS))
    }
    fn times(&self, other: &Self) -> Outcome<Self> {
        // The same number twice is a square: tighter around zero.
        if std::ptr::eq(self, other) {
            return known(self.0.square(BITS));
        }
        known(self.0.mul(&other.0, BITS))
    }
    fn recip(&self) -> Outcome<Self> {
        match self.0.recip(BITS) {
            Some(e) => known(e),
            None if self.0.is_exact() => Outcome::Undefined,
            None => Outcome::Unknown,
        }
    }
    fn sqrt(&self) -> Outcome<Self> {
        match self.0.sqrt(BITS) {
            Some(e) => known(e),
            None if self.0.high.sign() < 0 => Outcome::Undefined,
            None => Outcome::Unknown,
        }
    }
    fn pow(&self, exponent: &Self) -> Outcome<Self> {
        if self.0.high.sign() < 0 {
            return Outcome::Undefined;
        }
        if self.0.low.sign() <= 0 {
            let zero = self.0.is_exact();
            return match (zero, exponent.0.low.sign(), exponent.0.high.sign()) {
                (true, 1, _) => Outcome::Value(self.clone()),
                (true, _, -1) => Outcome::Undefined,
                _ => Outcome::Unknown,
            };
        }
        series::ln(&self.0, BITS)
            .then(|l| series::exp(&l.mul(&exponent.0, BITS + 64), BITS))
            .then(|e| known(e.clone()))
    }
    fn below_zero(&self) -> bool {
        self.0.high.sign() < 0
    }
    fn call(&self, function: Function) -> Outcome<Self> {
        series::call(&self.0, function, BITS).then(|e| known(e.clone()))
    }
}
