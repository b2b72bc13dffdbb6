//! Enclosures of several hundred bits as numbers of the equations, for values that double-doubles cannot tell apart.
//!
//! What an enclosure cannot decide, a reciprocal around zero say, ends in an interval without ends: the answer is then
//! "not decided", never a wrong number.

use crate::expr::number::to_f64;
use crate::expr::{Function, Rational, Scalar};
use crate::interval::dyadic::Round;
use crate::interval::{Big, Certified, Outcome};

use super::number::Number;

/// A number known to about `BITS` bits, or not at all.
#[derive(Clone, Debug)]
pub struct Deep<const BITS: u32>(Option<Big<BITS>>);

impl<const BITS: u32> Deep<BITS> {
    /// The double nearest to every number inside; `None` where the interval is too wide to tell.
    pub fn rounded(&self) -> Option<f64> {
        let interval = &self.0.as_ref()?.0;
        let far = |x: i64| x.abs() > 1200;
        if interval.is_exact() && interval.low.sign() == 0 {
            return Some(0.0);
        }
        if far(interval.low.top()) || far(interval.high.top()) {
            return None;
        }
        let [low, high] = [&interval.low, &interval.high].map(|end| to_f64(&end.to_rational()));
        (low == high && low.is_finite()).then_some(low)
    }

    /// A double inside or near: the middle, zero where zero is inside; NaN where nothing is known.
    pub fn near(&self) -> f64 {
        let Some(Big(interval)) = &self.0 else {
            return f64::NAN;
        };
        if interval.has_zero() {
            return 0.0;
        }
        let [low, high] = [
            interval.low.to_f64(Round::Down),
            interval.high.to_f64(Round::Up),
        ];
        0.5 * low + 0.5 * high
    }

    fn known(outcome: Outcome<Big<BITS>>) -> Option<Deep<BITS>> {
        outcome.value().map(|v| Deep(Some(v)))
    }

    fn with(&self, other: &Self, f: impl Fn(&Big<BITS>, &Big<BITS>) -> Outcome<Big<BITS>>) -> Self {
        let (Some(a), Some(b)) = (&self.0, &other.0) else {
            return Deep(None);
        };
        Deep(f(a, b).value())
    }
}

impl<const BITS: u32> Scalar for Deep<BITS> {
    fn from_rational(value: &Rational) -> Self {
        Deep(Some(Big::from_rational(value)))
    }
    fn pi() -> Option<Self> {
        Self::known(Big::pi())
    }
    fn plus(&self, other: &Self) -> Self {
        self.with(other, Big::plus)
    }
    fn times(&self, other: &Self) -> Self {
        self.with(other, Big::times)
    }
    fn recip(&self) -> Option<Self> {
        Self::known(self.0.as_ref()?.recip())
    }
    fn sqrt(&self) -> Option<Self> {
        Self::known(self.0.as_ref()?.sqrt())
    }
    fn pow(&self, exponent: &Self) -> Option<Self> {
        Self::known(self.0.as_ref()?.pow(exponent.0.as_ref()?))
    }
    fn call(&self, function: Function) -> Option<Self> {
        Self::known(self.0.as_ref()?.call(function))
    }
}

impl<const BITS: u32> Number for Deep<BITS> {
    fn zero() -> Self {
        Self::from_rational(&Rational::from(crate::expr::Int::from(0)))
    }
    fn one() -> Self {
        Self::from_rational(&Rational::from(crate::expr::Int::from(1)))
    }
    fn is_zero(&self) -> bool {
        let exact = |v: &Big<BITS>| v.0.is_exact() && v.0.low.sign() == 0;
        self.0.as_ref().is_some_and(exact)
    }
    fn minus(&self, other: &Self) -> Self {
        self.plus(&other.negated())
    }
    fn negated(&self) -> Self {
        Deep(self.0.as_ref().map(|v| Big(v.0.neg())))
    }
    fn halved(&self) -> Self {
        Deep(self.0.as_ref().map(|v| Big(v.0.scale(-1))))
    }
    fn size(&self) -> f64 {
        // An interval around zero is no pivot.
        self.0.as_ref().map_or(0.0, |v| match v.0.has_zero() {
            true => 0.0,
            false => v.0.abs().high.to_f64(Round::Up),
        })
    }
}
