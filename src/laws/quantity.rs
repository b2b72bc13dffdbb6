//! The arithmetic an equation needs, and linear forms in the unknowns over it.

use super::Unknown;
use crate::expr::Expr;

/// A number type in which the laws can be written.
pub trait Quantity: Clone {
    /// Zero.
    fn zero() -> Self;
    /// One.
    fn one() -> Self;
    /// Sum.
    fn add(&self, other: &Self) -> Self;
    /// Product.
    fn mul(&self, other: &Self) -> Self;
    /// The opposite.
    fn neg(&self) -> Self;
    /// Difference.
    fn sub(&self, other: &Self) -> Self {
        self.add(&other.neg())
    }
    /// Whether it is so plainly zero that a term with it need not be kept.
    fn vanishes(&self) -> bool;
}

impl Quantity for f64 {
    fn zero() -> f64 {
        0.0
    }
    fn one() -> f64 {
        1.0
    }
    fn add(&self, other: &f64) -> f64 {
        self + other
    }
    fn mul(&self, other: &f64) -> f64 {
        self * other
    }
    fn neg(&self) -> f64 {
        -self
    }
    fn vanishes(&self) -> bool {
        *self == 0.0
    }
}

impl Quantity for Expr {
    fn zero() -> Expr {
        Expr::zero()
    }
    fn one() -> Expr {
        Expr::one()
    }
    fn add(&self, other: &Expr) -> Expr {
        self + other
    }
    fn mul(&self, other: &Expr) -> Expr {
        if self.is_zero() || other.is_zero() {
            Expr::zero()
        } else {
            self * other
        }
    }
    fn neg(&self) -> Expr {
        -self
    }
    fn vanishes(&self) -> bool {
        self.is_zero()
    }
}

/// Σ coefficient × unknown + constant. Invariant: unknowns ascend, none twice, no coefficient that plainly vanishes.
#[derive(Clone, Debug)]
pub struct Affine<T> {
    /// Coefficients.
    pub terms: Vec<(Unknown, T)>,
    /// The part without unknowns.
    pub constant: T,
}

impl<T: Quantity> Affine<T> {
    /// A known value.
    pub fn constant(value: T) -> Affine<T> {
        Affine {
            terms: Vec::new(),
            constant: value,
        }
    }

    /// One unknown.
    pub fn unknown(name: Unknown) -> Affine<T> {
        Affine {
            terms: vec![(name, T::one())],
            constant: T::zero(),
        }
    }

    /// Sum of two forms.
    pub fn plus(&self, other: &Affine<T>) -> Affine<T> {
        let mut terms = Vec::with_capacity(self.terms.len() + other.terms.len());
        let (mut left, mut right) = (self.terms.iter().peekable(), other.terms.iter().peekable());
        while let (Some(a), Some(b)) = (left.peek(), right.peek()) {
            match a.0.cmp(&b.0) {
                std::cmp::Ordering::Less => terms.extend(left.next().cloned()),
                std::cmp::Ordering::Greater => terms.extend(right.next().cloned()),
                std::cmp::Ordering::Equal => {
                    let sum = a.1.add(&b.1);
                    if !sum.vanishes() {
                        terms.push((a.0, sum));
                    }
                    left.next();
                    right.next();
                }
            }
        }
        terms.extend(left.cloned());
        terms.extend(right.cloned());
        Affine {
            terms,
            constant: self.constant.add(&other.constant),
        }
    }

    /// The form times a known factor.
    pub fn times(&self, factor: &T) -> Affine<T> {
        if factor.vanishes() {
            return Affine::constant(T::zero());
        }
        Affine {
            terms: self
                .terms
                .iter()
                .map(|(u, c)| (*u, c.mul(factor)))
                .collect(),
            constant: self.constant.mul(factor),
        }
    }

    /// The equation `self = 0`, with the constant brought to the right side.
    pub fn equals_zero(self) -> Linear<T> {
        Linear {
            terms: self.terms,
            known: self.constant.neg(),
        }
    }
}

/// A linear equation: Σ coefficient × unknown = known.
#[derive(Clone, Debug)]
pub struct Linear<T> {
    /// Coefficients, unknowns ascending.
    pub terms: Vec<(Unknown, T)>,
    /// Right side.
    pub known: T,
}
