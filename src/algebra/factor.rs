//! Taking polynomials apart: contents, squarefree parts, quadratics split by their discriminant.
//!
//! Enough to write results as a person would and to find squares under a root; a factor that is not found stays whole.

use num_traits::{One, Zero};

use super::element::Den;
use super::fuel::Fuel;
use super::gcd::{content_in, gcd};
use super::mono::{exponent, mono_is_one, mono_variables, powers};
use super::poly::Poly;
use crate::expr::Int;

/// content · ∏ factorᵏ; single generators are factors of one term.
#[derive(Clone, Debug)]
pub(crate) struct Parts {
    pub content: Int,
    pub factors: Vec<(Poly, u32)>,
}

impl Parts {
    pub fn one() -> Parts {
        Parts::monomial(Int::one(), &[])
    }

    pub fn monomial(content: Int, mono: &[u64]) -> Parts {
        Parts {
            content,
            factors: powers(mono).map(|(v, k)| (Poly::var(v), k)).collect(),
        }
    }

    /// Of a denominator.
    pub fn below(den: &Den) -> Parts {
        let mut out = Parts::monomial(den.int.clone(), &den.mono);
        out.factors.extend(den.factors.iter().cloned());
        out
    }

    pub fn note(&mut self, p: Poly, times: u32) {
        match self.factors.iter_mut().find(|(f, _)| *f == p) {
            Some((_, k)) => *k += times,
            None => self.factors.push((p, times)),
        }
    }

    /// Multiplies by a power of another product.
    pub fn take(&mut self, other: Parts, k: u32) {
        self.content *= other.content.pow(k);
        for (f, e) in other.factors {
            self.note(f, e * k);
        }
    }

    /// Joins (x − y)(x + y) to x² − y², which is shorter.
    pub fn join_conjugates(&mut self) {
        let mut i = 0;
        while i < self.factors.len() {
            let (f, k) = self.factors[i].clone();
            let partner = (i + 1..self.factors.len()).find_map(|j| {
                let (g, l) = &self.factors[j];
                Some((j, conjugates(&f, g).filter(|_| k == *l)?))
            });
            match partner {
                Some((j, product)) => {
                    self.factors.remove(j);
                    self.factors[i].0 = product;
                }
                None => i += 1,
            }
        }
    }
}

/// Contents with respect to every variable, squarefree parts, and quadratics split by their discriminant: the variables of a
/// common monomial first, then pairwise different, primitive factors with positive leading coefficients, sorted.
/// Where a limit is met, a factor stays whole.
pub(crate) fn factor(p: &Poly, fuel: &Fuel) -> Parts {
    let (content, mono, rest) = p.split();
    let mut found = Parts::one();
    fuel.portion(|fuel| split_into(rest, 1, &mut found, fuel));
    found.factors.sort();
    let mut parts = Parts::monomial(content, &mono);
    let factors = found.factors.into_iter();
    factors.for_each(|(f, k)| parts.note(f, k));
    parts
}

fn split_into(p: Poly, times: u32, out: &mut Parts, fuel: &Fuel) {
    let (_, mono, p) = p.split();
    for v in mono_variables(&mono) {
        out.note(Poly::var(v), times * exponent(&mono, v));
    }
    if p.is_constant() {
        return;
    }
    match divisor(&p, fuel) {
        Some((d, mut q)) => {
            let mut found = Parts::one();
            split_into(d, times, &mut found, fuel);
            for (f, k) in found.factors {
                // What is found once is sought in the cofactor too: a factor of higher degree is not found there by itself.
                while let Some(rest) = q.try_div(&f) {
                    out.note(f.clone(), times);
                    q = rest;
                }
                out.note(f, k);
            }
            split_into(q, times, out, fuel);
        }
        None => out.note(p, times),
    }
}

/// A proper divisor and its cofactor, when one is found.
fn divisor(p: &Poly, fuel: &Fuel) -> Option<(Poly, Poly)> {
    if let Some(root) = p.sqrt() {
        return Some((root.clone(), root));
    }
    let degrees = p.degrees();
    let mut variables = mono_variables(&degrees);
    variables.sort_by_key(|v| exponent(&degrees, *v));
    // Primitive and linear in a variable means irreducible.
    for v in &variables {
        if let Some(c) = content_in(p, *v, fuel).ok().filter(|c| !c.is_constant()) {
            return p.try_div(&c).map(|q| (c, q));
        }
        if exponent(&degrees, *v) == 1 {
            return None;
        }
    }
    for v in &variables {
        if let Some(g) = gcd(p, &p.derivative(*v), fuel)
            .ok()
            .filter(|g| !g.is_constant())
        {
            return p.try_div(&g).map(|q| (g, q));
        }
    }
    for v in &variables {
        let found = match exponent(&degrees, *v) {
            2 => split_quadratic(p, *v, 1, fuel),
            4 => split_quadratic(p, *v, 2, fuel),
            _ => None,
        };
        if found.is_some() {
            return found;
        }
    }
    linear(p, &variables).or_else(|| difference_of_powers(p, &variables))
}

/// Splits a x²ᵏ + b xᵏ + c whose discriminant is a square.
fn split_quadratic(p: &Poly, v: usize, k: usize, fuel: &Fuel) -> Option<(Poly, Poly)> {
    let parts = p.by_power(v);
    if k == 2 && (!parts[1].is_zero() || !parts[3].is_zero()) {
        return None;
    }
    let (a, b, c) = (&parts[2 * k], &parts[k], &parts[0]);
    let discriminant = b.mul(b).ok()?.sub(&a.mul(c).ok()?.scale(&Int::from(4)));
    let root = discriminant.sqrt()?;
    let x = Poly::from_powers(&[vec![Poly::zero(); k], vec![Poly::one()]].concat(), v).ok()?;
    let linear = a.scale(&Int::from(2)).mul(&x).ok()?.add(&b.sub(&root));
    let g = gcd(p, &linear, fuel).ok()?;
    let (_, _, g) = g.split();
    if g.is_constant() || !mono_is_one(&g.mono_content()) {
        return None;
    }
    let q = p.try_div(&g)?;
    (!q.is_constant()).then_some((g, q))
}

/// A factor a x − b y of a polynomial in x and y whose terms are all of one degree, or a x − b of one in x alone: a divides the
/// first coefficient and b the last one.
fn linear(p: &Poly, variables: &[usize]) -> Option<(Poly, Poly)> {
    let (v, other) = match variables {
        [v] => (*v, Poly::one()),
        [v, w] => (*v, Poly::var(*w)),
        _ => return None,
    };
    let degree = p.degree(v);
    let is_of_one_degree = |i| match variables {
        [v, w] => exponent(p.mono(i), *v) + exponent(p.mono(i), *w) == degree,
        _ => true,
    };
    if degree < 3 || !(0..p.len()).all(is_of_one_degree) {
        return None;
    }
    let parts = p.by_power(v).into_iter();
    let coefficients: Vec<Int> = parts
        .map(|part| {
            if part.is_zero() {
                Int::zero()
            } else {
                part.coeff(0).clone()
            }
        })
        .collect();
    let first = divisors(coefficients.last()?)?;
    let last = divisors(coefficients.first()?)?;
    for a in &first {
        for b in last.iter().flat_map(|b| [b.clone(), -b.clone()]) {
            let (mut value, mut power) = (Int::zero(), Int::one());
            // Σ cₖ bᵏ aⁿ⁻ᵏ, from the highest power of b down.
            for c in coefficients.iter().rev() {
                value = &(&value * &b) + &(c * &power);
                power = &power * a;
            }
            if value.is_zero() {
                let factor = Poly::var(v).scale(a).sub(&other.scale(&b));
                let (_, _, factor) = factor.split();
                return p.try_div(&factor).map(|q| (factor, q));
            }
        }
    }
    None
}

/// Most that a coefficient may be whose divisors are tried.
const MOST_DIVIDED: i64 = 1_000;

/// The positive divisors of a number that is not zero and not too large.
fn divisors(value: &Int) -> Option<Vec<Int>> {
    let size = value.as_i64().filter(|n| *n != i64::MIN)?.abs();
    let is_small = (1..=MOST_DIVIDED).contains(&size);
    let all = (1..=size).filter(|d| size % d == 0);
    is_small.then(|| all.map(Int::from).collect())
}

/// Tries the rational roots x = ± (coefficient of the last over the first term): enough for xⁿ − aⁿ and its like.
fn difference_of_powers(p: &Poly, variables: &[usize]) -> Option<(Poly, Poly)> {
    if p.len() != 2 {
        return None;
    }
    let v = variables.first().copied()?;
    for k in [3, 5, 7, 2] {
        let root = |i: usize| -> Option<Poly> {
            let magnitude = num_traits::Signed::abs(p.coeff(i));
            let r = Int::from(magnitude.to_bigint().nth_root(k));
            let exponents: Option<Vec<(usize, u32)>> = variables
                .iter()
                .map(|w| {
                    let e = exponent(p.mono(i), *w);
                    e.is_multiple_of(k).then_some((*w, e / k))
                })
                .collect();
            (r.pow(k) == magnitude).then_some(())?;
            let mut out = Poly::constant(r);
            for (w, e) in exponents? {
                out = out.mul(&Poly::var(w).pow(e).ok()?).ok()?;
            }
            Some(out)
        };
        if let (Some(a), Some(b)) = (root(0), root(1)) {
            for candidate in [a.sub(&b), a.add(&b)] {
                if candidate.has(v) || !candidate.is_constant() {
                    let (_, _, candidate) = candidate.split();
                    if let Some(q) = p.try_div(&candidate).filter(|q| !q.is_constant()) {
                        return Some((candidate, q));
                    }
                }
            }
        }
    }
    None
}

/// The largest integer whose square divides the value (by small primes), and the cofactor.
pub(crate) fn square_part(value: &Int) -> (Int, Int) {
    let (mut root, mut rest) = (Int::one(), value.clone());
    let mut p = 2i64;
    while p < 2_000 {
        let (prime, square) = (Int::from(p), Int::from(p * p));
        if square > num_traits::Signed::abs(&rest) {
            break;
        }
        root *= prime.pow(take_out(&mut rest, &square));
        p += if p == 2 { 1 } else { 2 };
    }
    match rest.square_root() {
        Some(r) => (root * r, Int::one()),
        None => (root, rest),
    }
}

/// Prime factors as far as small primes reach; what is left counts as one.
pub(crate) fn primes_with_powers(value: &Int) -> Vec<(Int, u32)> {
    let mut rest = value.clone();
    let mut out = Vec::new();
    let mut p = 2i64;
    while p < 2_000 && !rest.is_one() && !rest.is_zero() {
        let prime = Int::from(p);
        if &prime * &prime > rest {
            break;
        }
        let k = take_out(&mut rest, &prime);
        if k > 0 {
            out.push((prime, k));
        }
        p += if p == 2 { 1 } else { 2 };
    }
    if !rest.is_one() {
        out.push((rest, 1));
    }
    out
}

/// Divides by a factor as often as it goes, by its powers where it goes often; tells how often.
fn take_out(rest: &mut Int, factor: &Int) -> u32 {
    if rest.is_zero() || !(&*rest % factor).is_zero() {
        return 0;
    }
    *rest /= factor;
    let pairs = take_out(rest, &(factor * factor));
    let odd = (&*rest % factor).is_zero();
    if odd {
        *rest /= factor;
    }
    1 + 2 * pairs + u32::from(odd)
}

/// The product x² − y² of x − y and x + y, which is shorter.
pub(super) fn conjugates(f: &Poly, g: &Poly) -> Option<Poly> {
    let product = (f.len() == 2 && g.len() == 2).then(|| f.mul(g).ok())??;
    (product.len() == 2).then_some(product)
}
