//! The numbers in an element: its coefficients, when everything that varies is put aside.
//!
//! Roots and sines of plain numbers may depend on each other in ways no normal form here knows: cos 20° cos 40° cos 80° is
//! 1/8. An element is zero when each of its coefficients is, and whether a number is zero can be decided by other means.

use std::collections::BTreeMap;

use super::element::Element;
use super::field::{Field, Kind};
use super::mono::{Mono, mono_add, mono_of, powers};
use super::poly::Poly;
use crate::expr::{Expr, Function};

/// Most coefficients that are written out.
const MOST: usize = 40;

impl Field {
    /// The coefficients of the numerator, as a polynomial in all that is no algebraic number; `None` where there are many.
    pub fn constants(&self, x: &Element) -> Option<Vec<Expr>> {
        let mut coefficients: BTreeMap<Mono, Poly> = BTreeMap::new();
        for (mono, coeff) in x.num.terms() {
            let (mut varying, mut constant) = (Mono::new(), Mono::new());
            for (v, power) in powers(mono) {
                let part = match self.is_algebraic_number(v) {
                    true => &mut constant,
                    false => &mut varying,
                };
                *part = mono_add(part, &mono_of(v, power)).ok()?;
            }
            let sum = coefficients.entry(varying).or_insert_with(Poly::zero);
            *sum = sum.add(&Poly::term(&constant, coeff.clone()));
            if coefficients.len() > MOST {
                return None;
            }
        }
        let written = |p: Poly| self.expr(&Element::from_poly(p));
        Some(coefficients.into_values().map(written).collect())
    }

    /// Whether a generator is a number and algebraic: a root of such, or the sine of a fraction of π.
    fn is_algebraic_number(&self, v: usize) -> bool {
        let all = |p: &Poly| {
            p.variables()
                .into_iter()
                .all(|w| self.is_algebraic_number(w))
        };
        let element = |x: &Element| {
            let parts = x.den.factors.iter().all(|(f, _)| all(f));
            all(&x.num) && parts && powers(&x.den.mono).all(|(w, _)| self.is_algebraic_number(w))
        };
        match (&self.gens[v].kind, &self.gens[v].relation) {
            (Kind::Root, Some((_, value))) => all(value),
            (Kind::Abs(p), _) => all(p),
            (Kind::Call(Function::Cos | Function::Sin, x), _) => self.as_turns(x).is_some(),
            (Kind::Power(base, exponent), _) => element(base) && exponent.as_number().is_some(),
            _ => false,
        }
    }
}
