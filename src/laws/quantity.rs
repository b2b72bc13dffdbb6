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
        self.joined(other, T::add, T::clone)
    }

    /// Difference of two forms.
    pub fn minus(&self, other: &Affine<T>) -> Affine<T> {
        self.joined(other, T::sub, T::neg)
    }

    /// Two forms joined: `both` for coefficients that both have, `alone` for those that only the other one has.
    fn joined(
        &self,
        other: &Affine<T>,
        both: impl Fn(&T, &T) -> T,
        alone: impl Fn(&T) -> T,
    ) -> Affine<T> {
        let mut terms = Vec::with_capacity(self.terms.len() + other.terms.len());
        let mut right = other.terms.iter().peekable();
        for (unknown, a) in &self.terms {
            while let Some((before, b)) = right.next_if(|(u, _)| u < unknown) {
                terms.push((*before, alone(b)));
            }
            let value = match right.next_if(|(u, _)| u == unknown) {
                Some((_, b)) => Some(both(a, b)).filter(|sum| !sum.vanishes()),
                None => Some(a.clone()),
            };
            terms.extend(value.map(|value| (*unknown, value)));
        }
        terms.extend(right.map(|(unknown, b)| (*unknown, alone(b))));
        Affine {
            terms,
            constant: both(&self.constant, &other.constant),
        }
    }

    /// Adds another form times a known factor, in place.
    pub fn add_times(&mut self, other: &Affine<T>, factor: &T) {
        if factor.vanishes() {
            return;
        }
        let mut at = 0;
        for (unknown, k) in &other.terms {
            let k = k.mul(factor);
            while self.terms.get(at).is_some_and(|(u, _)| u < unknown) {
                at += 1;
            }
            match self.terms.get_mut(at) {
                Some((u, sum)) if u == unknown => {
                    *sum = sum.add(&k);
                    if sum.vanishes() {
                        self.terms.remove(at);
                    }
                }
                _ => self.terms.insert(at, (*unknown, k)),
            }
        }
        self.add_known(&other.constant, factor);
    }

    /// Adds a known value times a known factor, in place.
    pub fn add_known(&mut self, value: &T, factor: &T) {
        if !value.vanishes() && !factor.vanishes() {
            self.constant = self.constant.add(&value.mul(factor));
        }
    }

    /// The opposite form.
    pub fn negated(&self) -> Affine<T> {
        Affine {
            terms: self.terms.iter().map(|(u, c)| (*u, c.neg())).collect(),
            constant: self.constant.neg(),
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
