//! Polynomials that depend on differences or sums of angles alone.
//!
//! In: a polynomial in cosines and sines. Out: the same with one angle fewer and what the others stand for. The effective
//! mass of linked bodies does not change when all of them are turned together, but multiplied out it hides that:
//! cos²α + cos²β − 2 cos α cos β cos(α − β) is sin²(α − β).

use std::collections::BTreeMap;

use super::field::{AngleOf, Field, Kind};
use super::image;
use super::poly::Poly;
use crate::expr::{Expr, Rational, Symbol};

/// Most angles whose common turn is looked for; the senses to try double with each.
const MOST_ANGLES: usize = 4;

impl Field {
    /// A polynomial in which the last angle is 0, and the formula every other angle stands for there.
    pub(crate) fn in_differences(&self, p: &Poly) -> Option<(Poly, BTreeMap<Symbol, Expr>)> {
        let angles: Vec<(&Symbol, &Rational, usize, usize)> = self
            .bases
            .iter()
            .filter(|b| p.has(b.cos) || p.has(b.sin))
            .map(|b| match &b.of {
                AngleOf::Symbol(name) => Some((name, &b.part, b.cos, b.sin)),
                AngleOf::Term(_) => None,
            })
            .collect::<Option<_>>()?;
        let (&(last, part, ..), others) = angles.split_last()?;
        if others.is_empty() || angles.len() > MOST_ANGLES {
            return None;
        }
        let own = |v: usize| angles.iter().any(|(_, _, c, s)| v == *c || v == *s);
        let independent = p.variables().into_iter().all(|v| {
            own(v)
                || match (&self.gens[v].kind, &self.gens[v].relation) {
                    (Kind::Symbol(name), None) => angles.iter().all(|(angle, ..)| name != *angle),
                    (Kind::Root, Some((_, under))) => under.is_constant(),
                    _ => false,
                }
        });
        if !independent || angles.iter().any(|(_, d, ..)| *d != part) {
            return None;
        }
        let turning: Vec<(usize, usize)> = angles.iter().map(|(_, _, c, s)| (*c, *s)).collect();
        if image::changes_by_turning(p, &turning) {
            return None;
        }
        // How the polynomial changes as each angle is turned by itself.
        let rate = |&(_, _, c, s): &(&Symbol, &Rational, usize, usize)| {
            let by_cos = self.mul_poly(&p.derivative(c), &Poly::var(s)).ok()?;
            let by_sin = self.mul_poly(&p.derivative(s), &Poly::var(c)).ok()?;
            Some(by_sin.sub(&by_cos))
        };
        let rates: Vec<Poly> = angles.iter().map(rate).collect::<Option<_>>()?;
        // Senses of turning, the last angle's being positive.
        let senses = (0..1_u32 << others.len()).find(|senses| {
            let all = rates.iter().enumerate();
            let turned = all.fold(Poly::zero(), |total, (k, rate)| match senses >> k & 1 {
                1 => total.sub(rate),
                _ => total.add(rate),
            });
            turned.is_zero()
        })?;
        let &(_, _, c, s) = angles.last()?;
        let without_sine = p.by_power(s).into_iter().next()?;
        let parts = without_sine.by_power(c).into_iter();
        let fewer = parts.fold(Poly::zero(), |total, part| total.add(&part));
        let names = others.iter().enumerate().map(|(k, (name, ..))| {
            let (angle, last) = (Expr::symbol(name), Expr::symbol(last));
            let stands_for = match senses >> k & 1 {
                1 => angle + last,
                _ => angle - last,
            };
            ((*name).clone(), stands_for)
        });
        Some((fewer, names.collect()))
    }
}
