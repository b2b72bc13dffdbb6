//! Linear forms in the unknowns, over any number.

use super::Unknown;
use crate::expr::arithmetic::Number;

/// Σ coefficient × unknown + constant. Invariant: unknowns ascend, none twice, no coefficient that plainly vanishes.
#[derive(Clone, Debug)]
pub struct Affine<T> {
    /// Coefficients.
    pub terms: Vec<(Unknown, T)>,
    /// The part without unknowns.
    pub constant: T,
}

impl<T: Number> Affine<T> {
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
        self.joined(other, T::plus, T::clone)
    }

    /// Difference of two forms.
    pub fn minus(&self, other: &Affine<T>) -> Affine<T> {
        self.joined(other, T::minus, T::negated)
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
                Some((_, b)) => Some(both(a, b)).filter(|sum| !sum.is_zero()),
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
        if factor.is_zero() {
            return;
        }
        let mut at = 0;
        for (unknown, k) in &other.terms {
            let k = k.times(factor);
            while self.terms.get(at).is_some_and(|(u, _)| u < unknown) {
                at += 1;
            }
            match self.terms.get_mut(at) {
                Some((u, sum)) if u == unknown => {
                    *sum = sum.plus(&k);
                    if sum.is_zero() {
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
        if !value.is_zero() && !factor.is_zero() {
            self.constant = self.constant.plus(&value.times(factor));
        }
    }

    /// The opposite form.
    pub fn negated(&self) -> Affine<T> {
        Affine {
            terms: self.terms.iter().map(|(u, c)| (*u, c.negated())).collect(),
            constant: self.constant.negated(),
        }
    }

    /// The form times a known factor.
    pub fn times(&self, factor: &T) -> Affine<T> {
        if factor.is_zero() {
            return Affine::constant(T::zero());
        }
        Affine {
            terms: self
                .terms
                .iter()
                .map(|(u, c)| (*u, c.times(factor)))
                .collect(),
            constant: self.constant.times(factor),
        }
    }

    /// The equation `self = 0`, with the constant brought to the right side.
    pub fn equals_zero(self) -> Linear<T> {
        Linear {
            terms: self.terms,
            known: self.constant.negated(),
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
