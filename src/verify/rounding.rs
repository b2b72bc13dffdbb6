//! Decimal rounding of exact values: bounds of constants, significant digits, half units of the last place.

use num_traits::{Signed, Zero};

pub use crate::expr::number::ten_to;

use crate::expr::{Expr, Point, Rational, ratio};
use crate::interval::{Big, Outcome, evaluate};

/// The exact value of a constant, where it is a fraction that is no tower of powers.
pub fn fraction(e: &Expr) -> Option<Rational> {
    if let Some(value) = e.as_number() {
        return Some(value.clone());
    }
    if !e.has_high_power() && e.size() <= 200 {
        e.evaluate(&Point::default())
    } else {
        None
    }
}

/// Fractions around the value of a constant expression, far closer than any tolerance in use; equal where it is a fraction.
pub fn bounds(e: &Expr) -> Option<[Rational; 2]> {
    if let Some(exact) = fraction(e) {
        return Some([exact.clone(), exact]);
    }
    let point = Point::<Outcome<Big<200>>>::default();
    match evaluate(e, &point) {
        // Beyond these sizes a decimal tolerance has no meaning, and the fraction would be long.
        Outcome::Value(Big(e)) if [&e.low, &e.high].iter().all(|d| d.exponent.abs() < 20_000) => {
            Some([e.low.to_rational(), e.high.to_rational()])
        }
        _ => None,
    }
}

/// Half a unit of the last of `digits` significant digits of a number.
pub fn half_unit(value: &Rational, digits: u32) -> Rational {
    if value.is_zero() {
        return Rational::zero();
    }
    ten_to(magnitude(value) - digits as i32 + 1) * ratio(1, 2)
}

/// The power of ten of the first digit: 0 for 2.08, −2 for 0.03. The value must not be zero.
pub fn magnitude(value: &Rational) -> i32 {
    let size = value.abs();
    let bits = size.numer().bits() as f64 - size.denom().bits() as f64;
    let mut k = (bits * std::f64::consts::LOG10_2).floor() as i32 - 1;
    while ten_to(k) > size {
        k -= 1;
    }
    while ten_to(k + 1) <= size {
        k += 1;
    }
    k
}

/// The power of ten of the first digit; 0 for zero.
pub fn magnitude_or_zero(value: &Rational) -> i32 {
    if value.is_zero() { 0 } else { magnitude(value) }
}
