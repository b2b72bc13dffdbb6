//! From a normal form to the expression a person would write: lowest terms, factored, the shorter trigonometric form.

use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use super::element::Element;
use super::factor::factor;
use super::field::{AngleOf, Field, Kind};
use super::gcd::{Fuel, gcd};
use super::poly::{Mono, Poly, exponent, mono_of, mono_variables};
use crate::expr::{Expr, Function, Int, Node, Rational, ratio};

impl Field {
    /// The element as a person would write it. Read again, it gives the same element.
    pub fn expr(&self, x: &Element) -> Expr {
        self.fuel.refill();
        self.written(x)
    }

    fn written(&self, x: &Element) -> Expr {
        if x.num.is_zero() {
            return Expr::zero();
        }
        let mut above = self.taken_apart(&x.num);
        let mut below = Parts {
            content: x.den.int.clone(),
            factors: Vec::new(),
        };
        for v in mono_variables(&x.den.mono) {
            below.note(Poly::var(v), exponent(&x.den.mono, v));
        }
        for (f, k) in &x.den.factors {
            let parts = self.taken_apart(f);
            below.content *= parts.content.pow(*k);
            for (g, e) in parts.factors {
                below.note(g, e * k);
            }
        }
        self.gather_squares(&mut above);
        self.gather_squares(&mut below);
        strike(&mut above, &mut below, &self.fuel);
        self.assemble(&above, &below)
    }

    /// Factors of the shorter of the forms without sin² and without cos².
    fn taken_apart(&self, p: &Poly) -> Parts {
        let mut best = Parts::of(p, &self.fuel);
        for (c, s) in self.circles() {
            if !p.has(c) || p.degree(c) < 2 {
                continue;
            }
            if let Some(other) = exchange(p, c, s) {
                let candidate = Parts::of(&other, &self.fuel);
                if self.length(&candidate) < self.length(&best) {
                    best = candidate;
                }
            }
        }
        best
    }

    /// Pairs of generators with a² + b² = 1.
    pub(crate) fn circles(&self) -> Vec<(usize, usize)> {
        let mut out: Vec<(usize, usize)> = self.bases.iter().map(|b| (b.cos, b.sin)).collect();
        for &g in &self.algebraic {
            if let (Kind::Symbol(_), Some((2, value))) =
                (&self.gens[g].kind, &self.gens[g].relation)
            {
                if let Some(a) = value.variables().first() {
                    out.push((*a, g));
                }
            }
        }
        out
    }

    /// Printed length, roughly.
    fn length(&self, parts: &Parts) -> usize {
        let mut total = 0;
        for (f, k) in &parts.factors {
            let own: usize = f
                .terms()
                .map(|(m, c)| {
                    let letters: u32 = mono_variables(m)
                        .iter()
                        .map(|v| if exponent(m, *v) > 1 { 3 } else { 2 })
                        .sum();
                    letters as usize
                        + usize::from(!c.abs().is_one()) * 2
                        + 2
                        + usize::from(c.is_negative())
                })
                .sum();
            total += own + usize::from(f.len() > 1) * 2 + usize::from(*k > 1);
        }
        total
    }

    /// Turns (1−c)(1+c) into s².
    fn gather_squares(&self, parts: &mut Parts) {
        for (c, s) in self.circles() {
            for (c, s) in [(c, s), (s, c)] {
                let (one, x) = (Poly::one(), Poly::var(c));
                let (minus, plus) = (x.sub(&one), x.add(&one));
                let times = |p: &Poly| {
                    parts
                        .factors
                        .iter()
                        .find(|(f, _)| f == p)
                        .map_or(0, |(_, k)| *k)
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

    fn assemble(&self, above: &Parts, below: &Parts) -> Expr {
        let mut number = Rational::new(above.content.clone(), below.content.clone());
        let mut factors: Vec<(bool, Expr, Rational)> = Vec::new();
        // Sums of mixed signs may be turned round to carry a minus sign.
        let mut turnable: Option<Expr> = None;
        for (parts, sign) in [(above, 1i64), (below, -1)] {
            for (f, k) in &parts.factors {
                let mut power = ratio(i64::from(*k) * sign, 1);
                let (sum, expr) = if f.len() == 1 {
                    let v = f.variables()[0];
                    let (expr, own) = self.generator(v);
                    power *= own;
                    (false, expr)
                } else {
                    let (expr, flipped, mixed) = self.sum(f);
                    if flipped && k % 2 == 1 {
                        number = -number;
                    }
                    if mixed && k % 2 == 1 && turnable.is_none() {
                        turnable = Some(expr.clone());
                    }
                    (true, expr)
                };
                match factors.iter_mut().find(|(_, e, _)| *e == expr) {
                    Some((_, _, total)) => *total += power,
                    None => factors.push((sum, expr, power)),
                }
            }
        }
        if let (true, Some(sum)) = (number.is_negative(), turnable) {
            if let Some(place) = factors
                .iter_mut()
                .find(|(_, e, k)| *e == sum && k.is_integer() && k.numer().is_odd())
            {
                place.1 = turned(&sum);
                number = -number;
            }
        }
        factors.retain(|(_, _, k)| !k.is_zero());
        factors.sort_by(|a, b| (self.rank(&a.1, a.0), &a.1).cmp(&(self.rank(&b.1, b.0), &b.1)));
        // A lone sum with a whole number in front stays bracketed; √a·√b is written √(ab).
        let mut rooted: Vec<Expr> = Vec::new();
        let mut below_root: Vec<Expr> = Vec::new();
        let mut out = vec![Expr::from(number)];
        for (_, e, k) in factors {
            if *k.denom() == Int::from(2) && !k.is_integer() {
                let whole = if k.is_negative() {
                    (&k + ratio(1, 2)).to_integer()
                } else {
                    (&k - ratio(1, 2)).to_integer()
                };
                if !whole.is_zero() {
                    out.push(e.power(Expr::from(Rational::from(whole))));
                }
                if k.is_negative() {
                    below_root.push(e)
                } else {
                    rooted.push(e)
                }
            } else {
                out.push(e.power(Expr::from(k)));
            }
        }
        if !rooted.is_empty() {
            out.push(Expr::product(rooted).power(Expr::ratio(1, 2)));
        }
        if !below_root.is_empty() {
            out.push(Expr::product(below_root).power(Expr::ratio(-1, 2)));
        }
        Expr::product(out)
    }

    /// Order of factors: symbols, then roots and calls, then sums.
    fn rank(&self, e: &Expr, sum: bool) -> u8 {
        match e.node() {
            _ if sum => 3,
            Node::Number(_) => 0,
            Node::Symbol(_) => 1,
            _ => 2,
        }
    }

    /// A generator as base and exponent.
    fn generator(&self, v: usize) -> (Expr, Rational) {
        let one = Rational::one();
        match &self.gens[v].kind {
            Kind::Symbol(name) => (Expr::symbol(name), one),
            Kind::Cos(base) => (self.angle(*base).cos(), one),
            Kind::Sin(base) => (self.angle(*base).sin(), one),
            Kind::Root => match &self.gens[v].relation {
                Some((n, value)) => (
                    self.written(&Element::from_poly(value.clone())),
                    ratio(1, i64::from(*n)),
                ),
                None => (Expr::zero(), one),
            },
            Kind::Abs(p) => (
                Expr::call(Function::Abs, self.written(&Element::from_poly(p.clone()))),
                one,
            ),
            Kind::Call(function, x) => (Expr::call(*function, self.written(x)), one),
            Kind::Power(base, exponent) => (self.written(base).power(self.written(exponent)), one),
        }
    }

    fn angle(&self, base: usize) -> Expr {
        let base = &self.bases[base];
        let whole = match &base.of {
            AngleOf::Symbol(name) => Expr::symbol(name),
            AngleOf::Term(term) => self.written(term),
        };
        whole * Expr::ratio(1, i64::from(base.divisor))
    }

    /// A sum with a positive term in front, if it has one; whether its sign was turned; whether it has both signs.
    fn sum(&self, p: &Poly) -> (Expr, bool, bool) {
        let mut terms: Vec<(Mono, Int)> = self.shortened(p);
        let minus = terms.iter().filter(|(_, c)| c.is_negative()).count();
        let mixed = minus > 0 && minus < terms.len();
        // More minus than plus, or as many and a number that is negative: the other way round reads better.
        let number_negative = terms
            .iter()
            .any(|(m, c)| c.is_negative() && mono_variables(m).is_empty());
        let flip = 2 * minus > terms.len() || (2 * minus == terms.len() && number_negative);
        if flip {
            terms.iter_mut().for_each(|(_, c)| *c = -c.clone());
        }
        terms.sort_by_key(|(m, c)| (c.is_negative(), !mono_variables(m).is_empty()));
        let exprs = terms.iter().map(|(m, c)| self.term(m, c));
        (Expr::sum(exprs), flip, mixed)
    }

    fn term(&self, mono: &[u64], coeff: &Int) -> Expr {
        let parts = Parts {
            content: coeff.clone(),
            factors: mono_variables(mono)
                .into_iter()
                .map(|v| (Poly::var(v), exponent(mono, v)))
                .collect(),
        };
        self.assemble(
            &parts,
            &Parts {
                content: Int::one(),
                factors: Vec::new(),
            },
        )
    }

    /// Terms with a X − a X c² joined to a X s².
    fn shortened(&self, p: &Poly) -> Vec<(Mono, Int)> {
        let mut terms: Vec<(Mono, Int)> = p.terms().map(|(m, c)| (m.to_vec(), c.clone())).collect();
        for (c, s) in self.circles() {
            for (c, s) in [(c, s), (s, c)] {
                let mut i = 0;
                while i < terms.len() {
                    let (mono, coeff) = terms[i].clone();
                    let partner =
                        super::poly::mono_add(&mono, &mono_of(c, 2))
                            .ok()
                            .and_then(|target| {
                                terms.iter().position(|(m, k)| {
                                    super::poly::cmp_mono(m, &target).is_eq() && *k == -&coeff
                                })
                            });
                    if let (Some(j), Ok(joined)) =
                        (partner, super::poly::mono_add(&mono, &mono_of(s, 2)))
                    {
                        terms[i] = (joined, coeff);
                        terms.remove(j);
                        i = 0;
                        continue;
                    }
                    i += 1;
                }
            }
        }
        terms
    }
}

/// The negative of a sum, its positive terms in front again.
fn turned(sum: &Expr) -> Expr {
    let Node::Sum(terms) = sum.node() else {
        return -sum;
    };
    let mut terms: Vec<Expr> = terms.iter().map(|t| -t).collect();
    terms.sort_by_key(is_negative);
    Expr::sum(terms)
}

fn is_negative(term: &Expr) -> bool {
    match term.node() {
        Node::Number(value) => value.is_negative(),
        Node::Product(factors) => factors[0].as_number().is_some_and(Signed::is_negative),
        _ => false,
    }
}

/// c² → 1 − s² throughout; s may then occur squared.
fn exchange(p: &Poly, c: usize, s: usize) -> Option<Poly> {
    let value = Poly::one().sub(&Poly::var(s).mul(&Poly::var(s)).ok()?);
    let mut total = Poly::zero();
    for (q, chunk) in p.by_power(c).chunks(2).enumerate() {
        let block = Poly::from_powers(chunk, c).ok()?;
        total = total.add(&block.mul(&value.pow(q as u32).ok()?).ok()?);
    }
    Some(total)
}

/// content · ∏ factorᵏ; single generators are factors of one term.
#[derive(Clone, Debug)]
struct Parts {
    content: Int,
    factors: Vec<(Poly, u32)>,
}

impl Parts {
    fn of(p: &Poly, fuel: &Fuel) -> Parts {
        let found = factor(p, fuel);
        let mut out = Parts {
            content: found.content,
            factors: Vec::new(),
        };
        for v in mono_variables(&found.mono) {
            out.note(Poly::var(v), exponent(&found.mono, v));
        }
        for (f, k) in found.factors {
            out.note(f, k);
        }
        out
    }

    fn note(&mut self, p: Poly, times: u32) {
        match self.factors.iter_mut().find(|(f, _)| *f == p) {
            Some((_, k)) => *k += times,
            None => self.factors.push((p, times)),
        }
    }
}

/// Removes what both have in common.
fn strike(above: &mut Parts, below: &mut Parts, fuel: &Fuel) {
    let fuel = &fuel.portion();
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
            if g.is_constant() {
                j += 1;
                continue;
            }
            let (Some(qa), Some(qb)) = (a.try_div(&g), b.try_div(&g)) else {
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
