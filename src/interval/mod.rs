//! Certified enclosures of real numbers: doubles with outward rounding, and dyadic intervals of any precision.
//!
//! In: exact fractions. Out: intervals that contain the exact value of an expression for certain, or the statement that it
//! has none. Every bound follows from directed rounding and series with explicit remainders; the floating-point library
//! functions of the platform, which promise no accuracy, are never called.

pub mod double;
pub mod dyadic;
pub mod enclosure;
mod series;

use crate::expr::{Expr, Function, Point, Rational, Scalar, Symbol};

pub use double::Interval;
pub use enclosure::{Big, Enclosure};

/// What is known about the value of an expression at a point.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Outcome<T> {
    /// The value exists and is this, or lies in this.
    Value(T),
    /// The expression has no real value here: a division by zero, the root of a negative number, and the like.
    Undefined,
    /// This number type cannot tell: √2 as a fraction, the reciprocal of an interval around 0, a limit met.
    Unknown,
}

/// A number type with three-valued operations; [`Outcome`] of it can evaluate expressions.
pub trait Certified: Clone {
    /// Steps that an operation takes, about ten nanoseconds each.
    const STEPS: u64 = 4;
    /// The value, or an enclosure.
    fn from_rational(value: &Rational) -> Self;
    /// The circle constant.
    fn pi() -> Outcome<Self>;
    /// Sum.
    fn plus(&self, other: &Self) -> Outcome<Self>;
    /// Product.
    fn times(&self, other: &Self) -> Outcome<Self>;
    /// Reciprocal.
    fn recip(&self) -> Outcome<Self>;
    /// Non-negative square root.
    fn sqrt(&self) -> Outcome<Self>;
    /// Power with an exponent that is neither an integer nor a half-integer; real for bases ≥ 0 only.
    fn pow(&self, exponent: &Self) -> Outcome<Self>;
    /// A function.
    fn call(&self, function: Function) -> Outcome<Self>;
    /// Whether the value is below zero for certain.
    fn below_zero(&self) -> bool;
}

impl<T> Outcome<T> {
    /// The value, if there is one for sure.
    pub fn value(self) -> Option<T> {
        match self {
            Outcome::Value(value) => Some(value),
            _ => None,
        }
    }

    fn then<U>(&self, f: impl FnOnce(&T) -> Outcome<U>) -> Outcome<U> {
        match self {
            Outcome::Value(value) => f(value),
            Outcome::Undefined => Outcome::Undefined,
            Outcome::Unknown => Outcome::Unknown,
        }
    }

    fn with<U>(&self, other: &Outcome<T>, f: impl FnOnce(&T, &T) -> Outcome<U>) -> Outcome<U> {
        match (self, other) {
            (Outcome::Value(a), Outcome::Value(b)) => f(a, b),
            (Outcome::Undefined, _) | (_, Outcome::Undefined) => Outcome::Undefined,
            _ => Outcome::Unknown,
        }
    }
}

/// Operations that answer "undefined" or "unknown" inside the type, so that `Expr::evaluate` carries the difference out.
impl<T: Certified> Scalar for Outcome<T> {
    const STEPS: u64 = T::STEPS;

    fn from_rational(value: &Rational) -> Self {
        Outcome::Value(T::from_rational(value))
    }
    fn pi() -> Option<Self> {
        Some(T::pi())
    }
    fn plus(&self, other: &Self) -> Self {
        self.with(other, T::plus)
    }
    fn times(&self, other: &Self) -> Self {
        self.with(other, T::times)
    }
    fn recip(&self) -> Option<Self> {
        Some(self.then(T::recip))
    }
    fn sqrt(&self) -> Option<Self> {
        Some(self.then(T::sqrt))
    }
    fn pow(&self, exponent: &Self) -> Option<Self> {
        Some(self.with(exponent, T::pow))
    }
    fn call(&self, function: Function) -> Option<Self> {
        Some(self.then(|x| x.call(function)))
    }
    fn below_zero(&self) -> bool {
        matches!(self, Outcome::Value(x) if x.below_zero())
    }
}

/// What is known about an expression at a point, in the number type `T`.
pub fn evaluate<T: Certified>(e: &Expr, at: &Point<Outcome<T>>) -> Outcome<T> {
    e.evaluate(at).unwrap_or(Outcome::Unknown)
}

/// What rounding may make of the value of a formula.
pub fn rounding(e: &Expr, point: &Point<f64>) -> f64 {
    let as_it_is = |(name, value): (&Symbol, &f64)| {
        let [low, high] = [*value; 2];
        (name.clone(), Outcome::Value(Interval { low, high }))
    };
    let exact = Point {
        values: point.values.iter().map(as_it_is).collect(),
        ..Point::default()
    };
    match evaluate(e, &exact) {
        Outcome::Value(enclosed) => enclosed.high - enclosed.low,
        Outcome::Undefined | Outcome::Unknown => 0.0,
    }
}

#[cfg(test)]
mod tests;
