//! An element of a field: a reduced numerator over a denominator kept in factors.

use num_traits::{One, Zero};

use super::mono::{Mono, cmp_mono, mono_is_one};
use super::poly::Poly;
use crate::expr::Int;
use crate::expr::number::gcd;

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
    pub(crate) fn new(num: Poly, den: Den) -> Element {
        Element { num, den }
    }

    pub(crate) fn zero() -> Element {
        Element::from_poly(Poly::zero())
    }

    pub(crate) fn from_poly(num: Poly) -> Element {
        Element::new(num, Den::one())
    }

    pub(crate) fn var(v: usize) -> Element {
        Element::from_poly(Poly::var(v))
    }

    /// a ± b for multiples of the same monomial with small numbers: most coefficients of a chain of bodies are such.
    pub(crate) fn plus_like_monomial(&self, other: &Element, minus: bool) -> Option<Element> {
        if self.num.len() != 1
            || other.num.len() != 1
            || !self.den.factors.is_empty()
            || !other.den.factors.is_empty()
        {
            return None;
        }
        let same = |a: &[u64], b: &[u64]| cmp_mono(a, b).is_eq();
        if !same(self.num.mono(0), other.num.mono(0)) || !same(&self.den.mono, &other.den.mono) {
            return None;
        }
        let word = |x: &Int| x.as_i64().map(i128::from);
        let (na, da) = (word(self.num.coeff(0))?, word(&self.den.int)?);
        let (nb, db) = (word(other.num.coeff(0))?, word(&other.den.int)?);
        // Denominators p·g and q·g: only g can cancel. A sum of two products of 64-bit words fits 128 bits, but for one case.
        let g = gcd(da, db);
        let (left, right) = (na * (db / g), nb * (da / g));
        let n = match minus {
            true => left.checked_sub(right)?,
            false => left.checked_add(right)?,
        };
        if n == 0 {
            return Some(Element::zero());
        }
        let shared = gcd(n, g);
        let int = Int::from((da / g).checked_mul(db / shared)?);
        let num = Poly::term(self.num.mono(0), Int::from(n / shared));
        let mono = self.den.mono.clone();
        Some(Element::new(
            num,
            Den {
                mono,
                ..Den::of(int)
            },
        ))
    }

    /// Length of the stored form, in terms; a measure for choosing the simpler of two.
    pub fn size(&self) -> usize {
        let below = self.den.factors.iter();
        let below = below.map(|(f, k)| f.len() * *k as usize);
        self.num.len() + below.sum::<usize>()
    }

    /// Terms of numerator and denominator: how much there is to write.
    pub fn terms(&self) -> usize {
        let below = self.den.factors.iter().map(|(f, _)| f.len());
        self.num.len() + below.sum::<usize>()
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
        let (zero, int) = (Int::zero(), self.den.int.clone());
        let num = self.num.as_constant();
        let num = num.or(self.num.is_zero().then_some(&zero))?;
        Some(crate::expr::Rational::new(num.clone(), int))
    }
}

impl Den {
    pub fn one() -> Den {
        Den::of(Int::one())
    }

    /// A number alone.
    pub fn of(int: Int) -> Den {
        Den {
            int,
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
            && super::mono::cmp_mono(&self.mono, &other.mono).is_eq()
            && self.factors == other.factors
    }
}
