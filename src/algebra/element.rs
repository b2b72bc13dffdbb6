//! An element of a field: a reduced numerator over a denominator kept in factors.

use num_traits::One;

use super::poly::{Mono, Poly, mono_is_one};
use crate::expr::Int;

/// A quotient in normal form; arithmetic is the [`super::Field`]'s. Zero exactly when the numerator is zero.
#[derive(Clone, Debug)]
pub struct Element {
    pub(crate) num: Poly,
    pub(crate) den: Den,
}

/// A denominator: int · mono · ∏ factorᵏ. Kept apart so that sums seldom need a common divisor.
#[derive(Clone, Debug)]
pub(crate) struct Den {
    /// Positive.
    pub int: Int,
    pub mono: Mono,
    /// Sorted, primitive, positive leading coefficients.
    pub factors: Vec<(Poly, u32)>,
}

impl Element {
    pub(crate) fn zero() -> Element {
        Element::from_poly(Poly::zero())
    }

    pub(crate) fn from_poly(num: Poly) -> Element {
        Element {
            num,
            den: Den::one(),
        }
    }

    pub(crate) fn var(v: usize) -> Element {
        Element::from_poly(Poly::var(v))
    }

    /// Length of the stored form, in terms; a measure for choosing the simpler of two.
    pub fn size(&self) -> usize {
        self.num.len()
            + self
                .den
                .factors
                .iter()
                .map(|(f, k)| f.len() * *k as usize)
                .sum::<usize>()
    }

    /// Whether the element is stored as a single product of generators.
    pub fn is_monomial(&self) -> bool {
        self.num.len() == 1 && self.den.factors.is_empty()
    }

    /// The fraction, when the element is one.
    pub fn as_number(&self) -> Option<crate::expr::Rational> {
        if !mono_is_one(&self.den.mono) || !self.den.factors.is_empty() {
            return None;
        }
        if self.num.is_zero() {
            return Some(crate::expr::ratio(0, 1));
        }
        self.num
            .as_constant()
            .map(|c| crate::expr::Rational::new(c.clone(), self.den.int.clone()))
    }
}

impl Den {
    pub fn one() -> Den {
        Den {
            int: Int::one(),
            mono: Mono::new(),
            factors: Vec::new(),
        }
    }

    pub fn is_one(&self) -> bool {
        self.int.is_one() && mono_is_one(&self.mono) && self.factors.is_empty()
    }
}

impl PartialEq for Den {
    fn eq(&self, other: &Den) -> bool {
        self.int == other.int
            && super::poly::cmp_mono(&self.mono, &other.mono).is_eq()
            && self.factors == other.factors
    }
}
