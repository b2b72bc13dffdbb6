//! Double-double numbers: the unevaluated sum of two doubles, about 32 digits.
//!
//! Sums after Knuth, products after Dekker and Veltkamp (by fused multiply-add only where the compiler may use the
//! processor's own; the library's is slow), with the error bounds of Joldes, Muller & Popescu (2017): at most 2⁻¹⁰³ relative for sums and
//! products, 2⁻¹⁰⁰ for quotients and roots, as long as nothing under- or overflows.

use std::ops::{Add, Mul, Neg};

use super::number::Number;
use crate::expr::number::{from_f64, to_f64};
use crate::expr::{Function, Rational, Scalar};

/// The number high + low, with high the double nearest to it.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct Dd {
    /// Leading double.
    pub high: f64,
    /// What is missing, at most half a unit in the last place of `high`.
    pub low: f64,
}

/// a + b as nearest double and exact rest (Knuth).
#[inline(always)]
pub fn two_sum(a: f64, b: f64) -> Dd {
    let high = a + b;
    let b_part = high - a;
    Dd {
        high,
        low: (a - (high - b_part)) + (b - b_part),
    }
}

/// The same where |a| ≥ |b| (Dekker).
#[inline(always)]
fn quick_two_sum(a: f64, b: f64) -> Dd {
    let high = a + b;
    Dd {
        high,
        low: b - (high - a),
    }
}

/// a · b as nearest double and exact rest (Dekker); exact where neither overflows nor falls below 2⁻⁹⁶⁸.
#[inline(always)]
pub fn two_product(a: f64, b: f64) -> Dd {
    let high = a * b;
    if cfg!(target_feature = "fma") {
        return Dd {
            high,
            low: a.mul_add(b, -high),
        };
    }
    let (a1, a2) = split(a);
    let (b1, b2) = split(b);
    Dd {
        high,
        low: ((a1 * b1 - high) + a1 * b2 + a2 * b1) + a2 * b2,
    }
}

/// Halves of 26 bits each (Veltkamp).
#[inline(always)]
fn split(a: f64) -> (f64, f64) {
    let c = 134_217_729.0 * a;
    let high = c - (c - a);
    (high, a - high)
}

impl Dd {
    /// A double, exactly.
    #[inline(always)]
    pub fn exact(value: f64) -> Dd {
        Dd {
            high: value,
            low: 0.0,
        }
    }

    /// Reciprocal by one Newton step from the double; infinite or not a number for zero.
    #[inline(always)]
    pub fn inverse(self) -> Dd {
        let first = 1.0 / self.high;
        let rest = Dd::exact(1.0).add(self.mul(Dd::exact(first)).neg());
        quick_two_sum(first, rest.high * first)
    }

    /// Square root of a non-negative number.
    pub fn root(self) -> Dd {
        if self.high <= 0.0 {
            return Dd::default();
        }
        let first = self.high.sqrt();
        let rest = self.add(two_product(first, first).neg());
        quick_two_sum(first, rest.high / (2.0 * first))
    }
}

impl Add for Dd {
    type Output = Dd;
    #[inline(always)]
    fn add(self, other: Dd) -> Dd {
        let s = two_sum(self.high, other.high);
        let t = two_sum(self.low, other.low);
        let v = quick_two_sum(s.high, s.low + t.high);
        quick_two_sum(v.high, t.low + v.low)
    }
}

impl Mul for Dd {
    type Output = Dd;
    #[inline(always)]
    fn mul(self, other: Dd) -> Dd {
        let p = two_product(self.high, other.high);
        let mixed = self.high * other.low + self.low * other.high;
        quick_two_sum(p.high, p.low + mixed)
    }
}

impl Neg for Dd {
    type Output = Dd;
    #[inline(always)]
    fn neg(self) -> Dd {
        Dd {
            high: -self.high,
            low: -self.low,
        }
    }
}

impl Scalar for Dd {
    fn from_rational(value: &Rational) -> Dd {
        let high = to_f64(value);
        let low = from_f64(high).map_or(0.0, |h| to_f64(&(value - &h)));
        Dd { high, low }
    }
    fn pi() -> Option<Dd> {
        Some(PI)
    }
    fn plus(&self, other: &Dd) -> Dd {
        self.add(*other)
    }
    fn times(&self, other: &Dd) -> Dd {
        self.mul(*other)
    }
    fn recip(&self) -> Option<Dd> {
        (self.high != 0.0).then(|| self.inverse())
    }
    fn sqrt(&self) -> Option<Dd> {
        (self.high >= 0.0).then(|| self.root())
    }
    fn pow(&self, _: &Dd) -> Option<Dd> {
        None
    }
    fn call(&self, function: Function) -> Option<Dd> {
        match function {
            Function::Abs => Some(if self.high < 0.0 { self.neg() } else { *self }),
            Function::Sin => turned(*self).map(|[_, s]| s),
            Function::Cos => turned(*self).map(|[c, _]| c),
            Function::Tan => turned(*self).and_then(|[c, s]| Some(s.mul(c.recip()?))),
            _ => None,
        }
    }
}

impl Number for Dd {
    fn zero() -> Dd {
        Dd::default()
    }
    fn one() -> Dd {
        Dd::exact(1.0)
    }
    fn is_zero(&self) -> bool {
        self.high == 0.0
    }
    fn minus(&self, other: &Dd) -> Dd {
        self.add(other.neg())
    }
    fn negated(&self) -> Dd {
        self.neg()
    }
    fn halved(&self) -> Dd {
        Dd {
            high: 0.5 * self.high,
            low: 0.5 * self.low,
        }
    }
    fn size(&self) -> f64 {
        self.high.abs()
    }
}

/// π.
pub const PI: Dd = Dd {
    high: std::f64::consts::PI,
    low: 1.224_646_799_147_353_2e-16,
};

/// π/2 in three doubles; what is missing is below 2⁻¹⁶⁰.
const QUARTER: [f64; 3] = [
    std::f64::consts::FRAC_PI_2,
    6.123_233_995_736_766e-17,
    -1.497_384_904_859_169_8e-33,
];

/// (cos, sin) of an angle of at most 2²⁰ \[rad\], absolute error below 2⁻⁹⁸; `None` beyond.
pub fn turned(angle: Dd) -> Option<[Dd; 2]> {
    let quarters = (angle.high / QUARTER[0]).round();
    if quarters.is_nan() || quarters.abs() > 1_048_576.0 {
        return None;
    }
    let mut rest = angle;
    for part in QUARTER {
        rest = rest.add(two_product(quarters, part).neg());
    }
    let square = rest.mul(rest).neg();
    let series = |mut term: Dd, mut k: f64| {
        let mut sum = term;
        while term.high.abs() > 1e-36 {
            term = term.mul(square).mul(Dd::exact(k * (k + 1.0)).inverse());
            sum = sum.add(term);
            k += 2.0;
        }
        sum
    };
    let (s, c) = (series(rest, 2.0), series(Dd::exact(1.0), 1.0));
    Some(match (quarters as i64).rem_euclid(4) {
        0 => [c, s],
        1 => [s.neg(), c],
        2 => [c.neg(), s.neg()],
        _ => [s, c.neg()],
    })
}

#[cfg(test)]
mod tests {
    use num_traits::Signed;
    use proptest::prelude::*;

    use super::*;
    use crate::expr::ratio;

    fn exactly(v: Dd) -> Rational {
        from_f64(v.high).expect("finite") + from_f64(v.low).expect("finite")
    }

    /// |a − b| ≤ 2^−bits · |b|.
    fn near(a: &Rational, b: &Rational, bits: u32) -> bool {
        (a - b).abs() * Rational::from(crate::expr::Int::from(2).pow(bits)) <= b.abs()
    }

    fn any_dd() -> impl Strategy<Value = Dd> {
        let part = || (-1.0f64..1.0, -40i32..40).prop_map(|(m, e)| m * 2f64.powi(e));
        (part(), -1.0f64..1.0).prop_map(|(h, l)| two_sum(h, l * h * 1e-16))
    }

    proptest! {
        #[test]
        fn operations_keep_their_bounds(a in any_dd(), b in any_dd()) {
            prop_assume!(b.high != 0.0 && a.high != 0.0);
            let (x, y) = (exactly(a), exactly(b));
            prop_assert!(near(&exactly(a.add(b)), &(&x + &y), 103));
            prop_assert!(near(&exactly(a.mul(b)), &(&x * &y), 103));
            prop_assert!(near(&exactly(b.inverse()), &y.recip(), 100));
            let root = exactly(if b.high < 0.0 { b.neg() } else { b }.root());
            prop_assert!(near(&(&root * &root), &y.abs(), 99));
        }

        #[test]
        fn sine_and_cosine_lie_on_the_circle_and_double(x in -1e4f64..1e4) {
            let [c, s] = turned(Dd::exact(x)).expect("small").map(exactly);
            let [c2, s2] = turned(Dd::exact(2.0 * x)).expect("small").map(exactly);
            let tiny = Rational::from(crate::expr::Int::from(2).pow(97)).recip();
            prop_assert!((&c * &c + &s * &s - ratio(1, 1)).abs() < tiny);
            prop_assert!((c2 - (&c * &c - &s * &s)).abs() < tiny);
            prop_assert!((s2 - &c * &s * ratio(2, 1)).abs() < tiny);
            prop_assert!((to_f64(&s) - x.sin()).abs() < 3e-16);
        }
    }
}
