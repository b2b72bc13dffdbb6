//! Double-double numbers: the unevaluated sum of two doubles, about 32 digits.
//!
//! Sums after Knuth, products after Dekker and Veltkamp (by fused multiply-add only where the compiler may use the
//! processor's own; the library's is slow), with the error bounds of Joldes, Muller & Popescu (2017): at most 2⁻¹⁰³ relative for sums and
//! products, 2⁻¹⁰⁰ for quotients and roots, as long as nothing under- or overflows.

use std::ops::{Add, Mul, Neg};

use crate::expr::Rational;
use crate::expr::number::{from_f64, to_f64};

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

    /// A fraction.
    pub fn from_rational(value: &Rational) -> Dd {
        let high = to_f64(value);
        let low = from_f64(high).map_or(0.0, |h| to_f64(&(value - &h)));
        Dd { high, low }
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

/// π.
pub const PI: Dd = Dd {
    high: std::f64::consts::PI,
    low: 1.224_646_799_147_353_2e-16,
};

#[cfg(test)]
mod tests {
    use num_traits::Signed;
    use proptest::prelude::*;

    use super::*;

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
    }
}
