//! What equations ask of a number beyond evaluation: differences, neutral elements, and a few plane vectors.
//!
//! For doubles, exact fractions, and expressions.

use num_integer::Integer;
use num_traits::{One, ToPrimitive, Zero};

use super::{Expr, Function, Int, Rational, Scalar, number};

/// A number type in which equations can be assembled.
pub trait Number: Scalar {
    /// The neutral element of addition.
    fn zero() -> Self;
    /// The neutral element of multiplication.
    fn one() -> Self;
    /// Whether the number is exactly zero, for sure.
    fn is_zero(&self) -> bool;
    /// Difference.
    fn minus(&self, other: &Self) -> Self;
    /// The number with the other sign.
    fn negated(&self) -> Self;
    /// Half of the number.
    fn halved(&self) -> Self;
    /// The absolute value, roughly: for judging sizes, not for results.
    fn size(&self) -> f64;
    /// Share of two products below which their difference is rounding; 0 where numbers are exact.
    fn rounding() -> f64 {
        0.0
    }
}

impl Number for f64 {
    fn zero() -> f64 {
        0.0
    }
    fn one() -> f64 {
        1.0
    }
    fn is_zero(&self) -> bool {
        *self == 0.0
    }
    fn minus(&self, other: &f64) -> f64 {
        self - other
    }
    fn negated(&self) -> f64 {
        -self
    }
    fn halved(&self) -> f64 {
        self * 0.5
    }
    fn size(&self) -> f64 {
        self.abs()
    }
    // Some thousand units in the last place: coefficients of a contact come from a solved system.
    fn rounding() -> f64 {
        1e-12
    }
}

impl Number for Rational {
    fn zero() -> Rational {
        Zero::zero()
    }
    fn one() -> Rational {
        One::one()
    }
    fn is_zero(&self) -> bool {
        Zero::is_zero(self)
    }
    fn minus(&self, other: &Rational) -> Rational {
        number::sum(self, other, true)
    }
    fn negated(&self) -> Rational {
        -self
    }
    fn halved(&self) -> Rational {
        // Where the numerator is even, the denominator is odd: lowest terms either way.
        let two = Int::from(2);
        match self.numer().is_even() {
            true => Rational::new_raw(self.numer() / &two, self.denom().clone()),
            false => Rational::new_raw(self.numer().clone(), self.denom() * &two),
        }
    }
    fn size(&self) -> f64 {
        let rough = self.numer().to_f64().zip(self.denom().to_f64());
        let rough = rough.map_or(f64::NAN, |(n, d)| (n / d).abs());
        match rough.is_finite() {
            true => rough,
            false => number::to_f64(self).abs(),
        }
    }
}

/// An expression as a number, for equations that are written with symbols.
impl Scalar for Expr {
    fn from_rational(value: &Rational) -> Expr {
        Expr::from(value.clone())
    }
    fn pi() -> Option<Expr> {
        Some(Expr::pi())
    }
    fn plus(&self, other: &Expr) -> Expr {
        self + other
    }
    // What is zero is no term of an equation, whatever stands beside it.
    fn times(&self, other: &Expr) -> Expr {
        match self.is_zero() || other.is_zero() {
            true => Expr::zero(),
            false => self * other,
        }
    }
    fn recip(&self) -> Option<Expr> {
        (!self.is_zero()).then(|| self.powi(-1))
    }
    fn sqrt(&self) -> Option<Expr> {
        Some(Expr::sqrt(self))
    }
    fn pow(&self, exponent: &Expr) -> Option<Expr> {
        Some(self.power(exponent.clone()))
    }
    fn call(&self, function: Function) -> Option<Expr> {
        Some(Expr::call(function, self.clone()))
    }
}

impl Number for Expr {
    fn zero() -> Expr {
        Expr::zero()
    }
    fn one() -> Expr {
        Expr::one()
    }
    fn is_zero(&self) -> bool {
        Expr::is_zero(self)
    }
    fn minus(&self, other: &Expr) -> Expr {
        self - other
    }
    fn negated(&self) -> Expr {
        -self
    }
    fn halved(&self) -> Expr {
        self * &Expr::ratio(1, 2)
    }
    fn size(&self) -> f64 {
        1.0
    }
}

/// The difference a − b of two vectors.
pub fn difference<T: Number>(a: &[T; 2], b: &[T; 2]) -> [T; 2] {
    [a[0].minus(&b[0]), a[1].minus(&b[1])]
}

/// The sum a + b of two vectors.
pub fn total<T: Number>(a: &[T; 2], b: &[T; 2]) -> [T; 2] {
    [a[0].plus(&b[0]), a[1].plus(&b[1])]
}

/// Scalar product a · b.
pub fn dot<T: Number>(a: &[T; 2], b: &[T; 2]) -> T {
    a[0].times(&b[0]).plus(&a[1].times(&b[1]))
}

/// z-component of the cross product a × b.
pub fn cross<T: Number>(a: &[T; 2], b: &[T; 2]) -> T {
    a[0].times(&b[1]).minus(&a[1].times(&b[0]))
}

/// The vector a times the number k.
pub fn stretched<T: Number>(a: &[T; 2], k: &T) -> [T; 2] {
    [a[0].times(k), a[1].times(k)]
}
