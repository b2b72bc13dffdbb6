//! Products taken apart for writing: factors and their powers, the shorter of the trigonometric forms, lowest terms.

use num_traits::{One, Signed};

use super::factor::{Parts, factor};
use super::field::{Field, Kind};
use super::fuel::Fuel;
use super::gcd::gcd;
use super::mono::powers;
use super::poly::Poly;
use crate::expr::Int;

/// Terms of a polynomial that is not factored without a prospect.
const LONG: usize = 16;

impl Field {
    /// Factors of the shorter of the forms without sin² and without cos².
    pub(crate) fn taken_apart(&self, p: &Poly) -> Parts {
        let mut best = factor(p, &self.fuel);
        let mut least = None;
        let mut form = p.clone();
        for (c, s) in self.circles() {
            if form.degree(c) < 2 {
                continue;
            }
            let Some(other) = exchange(&form, c, s) else {
                continue;
            };
            // Of long forms, one that grows is hardly ever the shorter one in factors.
            if other.len() > LONG && 2 * other.len() > 3 * form.len() {
                continue;
            }
            let candidate = factor(&other, &self.fuel);
            let length = self.length(&candidate);
            if length < *least.get_or_insert_with(|| self.length(&best)) {
                least = Some(length);
                best = candidate;
                form = other;
            }
        }
        self.gather_squares(&mut best);
        let split = self.split_circles(&best);
        let mut joined = split.clone();
        joined.join_conjugates();
        match joined.factors.len() > best.factors.len() {
            true => split,
            false => best,
        }
    }

    /// Factors split further in the form in which all their terms are of one degree in cosine and sine: 1 − (1 + μ²) cos² is
    /// (sin − μ cos) (sin + μ cos).
    pub(super) fn split_circles(&self, parts: &Parts) -> Parts {
        let mut out = parts.clone();
        for (f, k) in parts
            .factors
            .iter()
            .filter(|(f, _)| (2..=LONG).contains(&f.len()))
        {
            let form = self.of_one_degree(f);
            if form == *f {
                continue;
            }
            let found = factor(&form, &self.fuel);
            if found.factors.len() > 1 && found.content.is_one() {
                out.factors.retain(|(g, _)| g != f);
                found
                    .factors
                    .into_iter()
                    .for_each(|(g, l)| out.note(g, k * l));
            }
        }
        out
    }

    /// Pairs of generators with a² + b² = 1.
    pub(crate) fn circles(&self) -> Vec<(usize, usize)> {
        let mut out: Vec<(usize, usize)> = self.bases.iter().map(|b| (b.cos, b.sin)).collect();
        for &g in &self.algebraic {
            if let (Kind::Symbol(_), Some((2, value))) =
                (&self.gens[g].kind, &self.gens[g].relation)
                && let Some(a) = value.variables().first()
            {
                out.push((*a, g));
            }
        }
        out
    }

    /// Printed length, roughly.
    fn length(&self, parts: &Parts) -> usize {
        let mut total = 0;
        for (f, k) in &parts.factors {
            let fewer = self.in_differences(f);
            let own = |(m, c): (&[u64], &Int)| {
                let number = usize::from(!c.abs().is_one()) * 2;
                letters(m) + number + 2 + usize::from(c.is_negative())
            };
            let written = fewer.as_ref().map_or(f, |(f, _)| f);
            let own: usize = written.terms().map(own).sum();
            total += own + usize::from(f.len() > 1) * 2 + usize::from(*k > 1);
        }
        total
    }

    /// Turns (1−c)(1+c) into s².
    fn gather_squares(&self, parts: &mut Parts) {
        if parts.factors.len() < 2 {
            return;
        }
        for (c, s) in self.circles() {
            for (c, s) in [(c, s), (s, c)] {
                let (one, x) = (Poly::one(), Poly::var(c));
                let (minus, plus) = (x.sub(&one), x.add(&one));
                let times = |p: &Poly| {
                    let found = parts.factors.iter().find(|(f, _)| f == p);
                    found.map_or(0, |(_, k)| *k)
                };
                let both = times(&minus).min(times(&plus));
                if both == 0 {
                    continue;
                }
                for (f, k) in &mut parts.factors {
                    if *f == minus || *f == plus {
                        *k -= both;
                    }
                }
                parts.factors.retain(|(_, k)| *k > 0);
                parts.note(Poly::var(s), 2 * both);
                if both % 2 == 1 {
                    parts.content = -parts.content.clone();
                }
            }
        }
    }
}

/// Length of a written monomial, roughly: three characters a factor, two more for an exponent.
pub(crate) fn letters(mono: &[u64]) -> usize {
    powers(mono).map(|(_, k)| if k > 1 { 5 } else { 3 }).sum()
}

/// c² → 1 − s² throughout; s may then occur squared.
fn exchange(p: &Poly, c: usize, s: usize) -> Option<Poly> {
    let value = Poly::rest_of_square(s);
    let mut total = Poly::zero();
    for (q, chunk) in p.by_power(c).chunks(2).enumerate() {
        let block = Poly::from_powers(chunk, c).ok()?;
        total = total.add(&block.mul(&value.pow(q as u32).ok()?).ok()?);
    }
    Some(total)
}

/// Removes what both have in common.
pub(crate) fn strike(above: &mut Parts, below: &mut Parts, fuel: &Fuel) {
    fuel.portion(|fuel| strike_within(above, below, fuel));
}

fn strike_within(above: &mut Parts, below: &mut Parts, fuel: &Fuel) {
    let mut i = 0;
    while i < above.factors.len() {
        let mut j = 0;
        while i < above.factors.len() && j < below.factors.len() {
            let ((a, k), (b, l)) = (above.factors[i].clone(), below.factors[j].clone());
            let g = if a == b {
                a.clone()
            } else if a.len() == 1 || b.len() == 1 {
                Poly::one()
            } else {
                gcd(&a, &b, fuel).unwrap_or_else(|_| Poly::one())
            };
            let quotients = if g.is_constant() {
                None
            } else {
                a.try_div(&g).zip(b.try_div(&g))
            };
            let Some((qa, qb)) = quotients else {
                j += 1;
                continue;
            };
            let both = k.min(l);
            let split = |parts: &mut Parts, at: usize, q: Poly, k: u32| {
                parts.factors.remove(at);
                if !q.is_constant() {
                    parts.note(q, k);
                }
                if k > both {
                    parts.note(g.clone(), k - both);
                }
            };
            split(above, i, qa, k);
            split(below, j, qb, l);
            (i, j) = (0, 0);
        }
        i += 1;
    }
}
