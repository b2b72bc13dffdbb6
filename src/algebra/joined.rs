//! Terms of a sum joined where a person would: by cos² + sin² = 1, by the functions of a sum of angles, logarithms and arcs.

use num_traits::Signed;
use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use super::element::Element;
use super::field::{Field, Kind};
use super::mono::{Mono, mono_add, mono_div, mono_divides, mono_is_one, mono_of, powers};
use super::poly::Poly;
use crate::expr::{Expr, Function, Int, Rational};

/// Longest sum whose terms are joined.
const MOST_JOINED: usize = 2_000;

/// A term of a sum, with a factor cos(α ± β) or sin(α ± β) gathered from two terms.
#[derive(Clone)]
pub(super) struct Term {
    pub mono: Mono,
    pub coeff: Int,
    pub gathered: Option<Expr>,
}

impl Field {
    /// Terms a X − a X c² joined to a X s², logarithms and arcs joined, and cos α cos β ± sin α sin β and the like to one
    /// function of α ± β.
    pub(super) fn shortened(&self, p: &Poly) -> Vec<Term> {
        let mut terms: Vec<Term> = p
            .terms()
            .map(|(m, c)| Term {
                mono: Mono::from_slice(m),
                coeff: c.clone(),
                gathered: None,
            })
            .collect();
        if terms.len() > MOST_JOINED {
            return terms;
        }
        for (c, s) in self.circles() {
            if !p.has(c) && !p.has(s) {
                continue;
            }
            for (c, s) in [(c, s), (s, c)] {
                join(&mut terms, &mono_of(c, 0), &mono_of(c, 2), |same| {
                    (!same).then(|| (mono_of(s, 2), None))
                });
            }
        }
        self.join_logarithms(p, &mut terms);
        self.join_arcs(p, &mut terms);
        let present: Vec<usize> = (0..self.bases.len())
            .filter(|i| p.has(self.bases[*i].cos) || p.has(self.bases[*i].sin))
            .collect();
        for (k, &i) in present.iter().enumerate() {
            for &j in &present[k + 1..] {
                let (a, b) = (&self.bases[i], &self.bases[j]);
                let pair = |x: usize, y: usize| {
                    mono_add(&mono_of(x, 1), &mono_of(y, 1)).unwrap_or_default()
                };
                let plus = || self.angle(i) + self.angle(j);
                let minus = || self.angle(i) - self.angle(j);
                let gathered = |e: Expr| Some((Mono::new(), Some(e)));
                let [cosines, sines] = [pair(a.cos, b.cos), pair(a.sin, b.sin)];
                join(&mut terms, &cosines, &sines, |same| {
                    gathered(if same { minus() } else { plus() }.cos())
                });
                let [first, second] = [pair(a.sin, b.cos), pair(a.cos, b.sin)];
                join(&mut terms, &first, &second, |same| {
                    gathered(if same { plus() } else { minus() }.sin())
                });
            }
        }
        terms
    }

    /// ln 2 + ln 5 joined to ln 10.
    fn join_logarithms(&self, p: &Poly, terms: &mut Vec<Term>) {
        let logarithms: Vec<(usize, Rational)> = self
            .calls(p, Function::Ln)
            .filter_map(|(v, x)| Some((v, x.as_number()?)))
            .collect();
        for (k, (u, x)) in logarithms.iter().enumerate() {
            for (v, y) in &logarithms[k + 1..] {
                join(terms, &mono_of(*u, 1), &mono_of(*v, 1), |same| {
                    let whole = if same { x * y } else { x / y };
                    let ln = Expr::call(Function::Ln, Expr::from(whole));
                    Some((Mono::new(), Some(ln)))
                });
            }
        }
    }

    /// π − 2 asin x joined to 2 acos x.
    fn join_arcs(&self, p: &Poly, terms: &mut Vec<Term>) {
        let is_pi = |v: &usize| matches!(&self.gens[*v].kind, Kind::Symbol(s) if &**s == "pi");
        let Some(pi) = (0..self.gens.len()).find(is_pi).filter(|v| p.has(*v)) else {
            return;
        };
        for (v, x) in self.calls(p, Function::Asin) {
            let found = terms.iter().enumerate().find_map(|(i, term)| {
                let rest = mono_divides(&mono_of(pi, 1), &term.mono)
                    .then(|| mono_div(&term.mono, &mono_of(pi, 1)))?;
                let other = mono_add(&rest, &mono_of(v, 1)).ok()?;
                let coeff = -(term.coeff.clone() * Int::from(2));
                let is_other = |t: &Term| {
                    t.gathered.is_none() && t.coeff == coeff && trimmed(&t.mono) == trimmed(&other)
                };
                let j = terms.iter().position(is_other)?;
                Some((i, j, rest))
            });
            if let Some((i, j, rest)) = found {
                terms[j] = Term {
                    mono: rest,
                    coeff: -terms[j].coeff.clone(),
                    gathered: Some(Expr::call(Function::Acos, self.kept(&x))),
                };
                terms.remove(i);
            }
        }
    }

    /// The variables of a polynomial that stand for a function, each with its argument.
    fn calls(&self, p: &Poly, function: Function) -> impl Iterator<Item = (usize, Element)> {
        let present = (0..self.gens.len()).filter(|v| p.has(*v));
        present.filter_map(move |v| match &self.gens[v].kind {
            Kind::Call(f, x) if *f == function => Some((v, x.clone())),
            _ => None,
        })
    }
}

/// Joins k·X·first and ±k·X·second to k·X·(what `joined` gives for equal or opposite coefficients).
fn join(
    terms: &mut Vec<Term>,
    first: &[u64],
    second: &[u64],
    joined: impl Fn(bool) -> Option<(Mono, Option<Expr>)>,
) {
    let holds = |mono: &[u64]| terms.iter().any(|t| mono_divides(mono, &t.mono));
    if !holds(first) || !holds(second) {
        return;
    }
    while let Some((i, j, term)) = joinable(terms, first, second, &joined) {
        terms[i] = term;
        terms.remove(j);
    }
}

/// The first term that can be joined to another, that other one, and what they become.
fn joinable(
    terms: &[Term],
    first: &[u64],
    second: &[u64],
    joined: &impl Fn(bool) -> Option<(Mono, Option<Expr>)>,
) -> Option<(usize, usize, Term)> {
    let plain = || {
        let all = terms.iter().enumerate();
        all.filter(|(_, t)| t.gathered.is_none())
    };
    let mut places: FxHashMap<&[u64], SmallVec<[usize; 1]>> = FxHashMap::default();
    for (j, term) in plain().filter(|(_, t)| mono_divides(second, &t.mono)) {
        places.entry(trimmed(&term.mono)).or_default().push(j);
    }
    plain().find_map(|(i, term)| {
        if !mono_divides(first, &term.mono) {
            return None;
        }
        let common = mono_div(&term.mono, first);
        let target = mono_add(&common, second).ok()?;
        let here = places.get(trimmed(&target))?;
        let j = *here
            .iter()
            .find(|j| terms[**j].coeff.abs() == term.coeff.abs())?;
        let (extra, gathered) = joined(terms[j].coeff == term.coeff)?;
        let mono = mono_add(&common, &extra).ok()?;
        let coeff = term.coeff.clone();
        let term = Term {
            mono,
            coeff,
            gathered,
        };
        Some((i, j, term))
    })
}

/// A monomial without the variables after its last one.
pub(super) fn trimmed(mono: &[u64]) -> &[u64] {
    let len = mono.iter().rposition(|w| *w != 0).map_or(0, |k| k + 1);
    &mono[..len]
}

impl Term {
    pub(super) fn is_number(&self) -> bool {
        self.gathered.is_none() && mono_is_one(&self.mono)
    }

    pub(super) fn degree(&self) -> u32 {
        let own: u32 = powers(&self.mono).map(|(_, k)| k).sum();
        own + u32::from(self.gathered.is_some())
    }
}
