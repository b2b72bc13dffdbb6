//! From a normal form to the expression a person would write: lowest terms, factored, the shorter trigonometric form.

use num_integer::Integer;
use num_traits::{One, Signed};

use super::element::{Den, Element};
use super::factor::Parts;
use super::factor::factor;
use super::field::{AngleOf, Field, Kind};
use super::joined::{Term, trimmed};
use super::mono::{Mono, exponent, mono_add, mono_div, mono_divides, mono_of, powers};
use super::parts::{letters, strike};
use super::poly::Poly;
use super::product::{MOST_SIGNED, turned_inside};
use crate::expr::{Expr, Function, Int, Node, Rational, ratio};

/// Longest sum above or below a line that is looked at for a term that stands better beside it.
const MOST_PARTED: usize = 24;
/// A quotient of this many nodes is long.
const LONG: usize = 40;
/// Longest sum whose terms are grouped.
const MOST_GROUPED: usize = 300;
/// Most values whose written form is remembered; they are searched one by one.
const MOST_REMEMBERED: usize = 64;

/// A written part of a sum behind its place in it.
type Placed = ((u32, usize), Expr);

impl Field {
    /// The element as a person would write it. Read again, it gives the same element.
    pub fn expr(&self, x: &Element) -> Expr {
        self.fuel.refill();
        self.kept(x)
    }

    /// The same within an operation, remembered for a while: a root stands in many terms.
    pub(super) fn kept(&self, x: &Element) -> Expr {
        if let Some(known) = self.remembered(x) {
            return known;
        }
        let e = self.written(x);
        let mut wrote = self.wrote.borrow_mut();
        if wrote.len() == MOST_REMEMBERED {
            wrote.pop_front();
        }
        wrote.push_back((x.clone(), e.clone()));
        e
    }

    /// The element as it is stored, a sum of products over a denominator, for what nobody reads; as a person would write it
    /// where that has just been done.
    pub fn stored(&self, x: &Element) -> Expr {
        if let Some(known) = self.remembered(x) {
            return known;
        }
        let product = |coeff: Expr, mono: &[u64]| {
            let factors = powers(mono).map(|(v, k)| {
                let (base, own) = self.generator(v);
                base.power(Expr::from(own * ratio(i64::from(k), 1)))
            });
            Expr::product(std::iter::once(coeff).chain(factors))
        };
        let sum = |p: &Poly| {
            let terms = p.terms();
            Expr::sum(terms.map(|(m, c)| product(Expr::from(Rational::from(c.clone())), m)))
        };
        let below = product(Expr::from(Rational::from(x.den.int.clone())), &x.den.mono);
        let factors = x.den.factors.iter();
        let below = factors.fold(below, |below, (f, k)| below * sum(f).powi(i64::from(*k)));
        sum(&x.num) / below
    }

    fn remembered(&self, x: &Element) -> Option<Expr> {
        let known =
            |(y, e): &(Element, Expr)| (y.num == x.num && y.den == x.den).then(|| e.clone());
        self.wrote.borrow().iter().find_map(known)
    }

    fn written(&self, x: &Element) -> Expr {
        if x.num.is_zero() {
            return Expr::zero();
        }
        if x.is_monomial() {
            // Nothing to factor and, in lowest terms, nothing to strike.
            let above = Parts::monomial(x.num.coeff(0).clone(), x.num.mono(0));
            return self.assemble(&above, &Parts::below(&x.den));
        }
        if let Some(shorter) = self.divided(x) {
            return self.written(&shorter);
        }
        let struck = self.struck(x);
        let (num, factors) = struck
            .as_ref()
            .map_or((&x.num, &x.den.factors), |(num, den)| (num, den));
        let mut above = self.taken_apart(num);
        let mut below = Parts::monomial(x.den.int.clone(), &x.den.mono);
        for (f, k) in factors {
            below.take(self.taken_apart(f), *k);
        }
        strike(&mut above, &mut below, &self.fuel);
        self.take_roots(&mut above, &mut below);
        let quotient = self.assemble(&above, &below);
        let others = [self.parted(x), self.with_rebound(x, quotient.size())];
        let all = std::iter::once(quotient).chain(others.into_iter().flatten());
        all.min_by_key(Expr::size).unwrap_or_else(Expr::zero)
    }

    /// `x/√x` is `√x`, which has a value where x is zero too.
    fn take_roots(&self, above: &mut Parts, below: &mut Parts) {
        let roots = below.factors.clone().into_iter().filter_map(|(f, k)| {
            let root = f
                .variables()
                .first()
                .copied()
                .filter(|_| k == 1 && f.len() == 1)?;
            match (&self.gens[root].kind, &self.gens[root].relation) {
                (Kind::Root, Some((2, value))) => Some((f, value.clone())),
                _ => None,
            }
        });
        for (root, value) in roots.collect::<Vec<_>>() {
            if let Some(at) = above.factors.iter().position(|(f, _)| *f == value) {
                above.factors[at].1 -= 1;
                above.factors.retain(|(_, k)| *k > 0);
                above.note(root.clone(), 1);
                below.factors.retain(|(f, _)| *f != root);
            }
        }
    }

    /// A quotient with what stands above with the whole denominator taken out: `(g (M + m) − F)/(M + m)` is `g − F/(M + m)`.
    fn parted(&self, x: &Element) -> Option<Expr> {
        let den = &x.den.factors;
        if den.is_empty() || !(3..=MOST_PARTED).contains(&x.num.len()) {
            return None;
        }
        let whole = multiplied(Poly::one(), den)?;
        let (lead, first) = (whole.mono(0), whole.coeff(0));
        let (mut taken, mut rest) = (Poly::zero(), x.num.clone());
        for (mono, coeff) in x.num.terms() {
            if !mono_divides(lead, mono) || !coeff.is_multiple_of(first) {
                continue;
            }
            let term = Poly::term(&mono_div(mono, lead), coeff / first);
            let less = rest.sub(&whole.mul(&term).ok()?);
            // Every term of the product stands above: no other is made by taking it away.
            if less.len() + whole.len() == rest.len() {
                (taken, rest) = (taken.add(&term), less);
            }
        }
        if taken.is_zero() || rest.is_zero() {
            return None;
        }
        let over = |num: Poly, factors: Vec<(Poly, u32)>| {
            let (int, mono) = (x.den.int.clone(), x.den.mono.clone());
            self.written(&Element::new(num, Den { int, mono, factors }))
        };
        let mut both = [over(taken, Vec::new()), over(rest, den.clone())];
        both.sort_by_key(Expr::is_negative);
        Some(Expr::sum(both))
    }

    /// A long quotient with a coefficient of restitution e to the first power, as what holds for e = −1, where nothing
    /// happens and no denominator is left, and what 1 + e brings: `u − (1 + e) w`.
    fn with_rebound(&self, x: &Element, size: usize) -> Option<Expr> {
        if size < LONG || x.num.len() > MOST_GROUPED || x.den.factors.is_empty() {
            return None;
        }
        let is_bare = |v: &usize| {
            let bare = matches!(self.gens[*v].kind, Kind::Symbol(_)) && x.num.degree(*v) == 1;
            bare && !x.den.factors.iter().any(|(f, _)| f.has(*v)) && exponent(&x.den.mono, *v) == 0
        };
        let of = x.num.variables().into_iter().filter(is_bare);
        let all = of.filter_map(|v| {
            let [none, once] = <[Poly; 2]>::try_from(x.num.by_power(v)).ok()?;
            let mut factors = x.den.factors.iter();
            let still = factors.try_fold(none.sub(&once), |p, (f, k)| {
                (0..*k).try_fold(p, |p, _| p.try_div(f))
            })?;
            let (int, mono) = (x.den.int.clone(), x.den.mono.clone());
            let factors = Vec::new();
            let still = self.written(&Element::new(still, Den { int, mono, factors }));
            let rebound = self.written(&Element::from_poly(Poly::var(v).add(&Poly::one())));
            Some(still + rebound * self.written(&Element::new(once, x.den.clone())))
        });
        all.min_by_key(Expr::size)
    }

    /// The quotient after a division by a factor a + b √r of the denominator that leaves nothing, if there is one: with its
    /// conjugate above and a² − b² r below, the division shows among polynomials.
    fn divided(&self, x: &Element) -> Option<Element> {
        if x.num.len() > MOST_GROUPED {
            return None;
        }
        let roots = self.algebraic.iter().copied();
        let roots = roots.filter(|v| matches!(self.gens[*v].kind, Kind::Root) && x.num.has(*v));
        for v in roots {
            for (i, (f, k)) in x.den.factors.iter().enumerate() {
                let Ok([a, b]) = <[Poly; 2]>::try_from(f.by_power(v)) else {
                    continue;
                };
                let conjugate = a.sub(&b.mul(&Poly::var(v)).ok()?);
                let (content, mono, norm) = self.mul_poly(f, &conjugate).ok()?.split();
                let above = self.mul_poly(&x.num, &conjugate).ok()?;
                let Some(num) = above.try_div(&norm).filter(|_| !norm.has(v)) else {
                    continue;
                };
                let mut den = x.den.clone();
                match k {
                    1 => drop(den.factors.remove(i)),
                    _ => den.factors[i].1 -= 1,
                }
                let divided = self.div(
                    &Element::new(num, den),
                    &Element::from_poly(Poly::term(&mono, content)),
                );
                return divided.ok();
            }
        }
        None
    }

    /// Numerator and factors of the denominator without what they have in common, where both hold a cosine: each of them may
    /// be written shorter in sines, and then nothing in common would be seen.
    fn struck(&self, x: &Element) -> Option<(Poly, Vec<(Poly, u32)>)> {
        let den = &x.den.factors;
        let both = |c: usize| x.num.has(c) && den.iter().any(|(f, _)| f.has(c));
        if x.num.len() > MOST_GROUPED || !self.circles().into_iter().any(|(c, _)| both(c)) {
            return None;
        }
        let as_it_is = self.struck_as(x, Poly::clone);
        as_it_is.or_else(|| self.struck_as(x, |p| self.of_one_degree(p)))
    }

    /// The same of the forms that `shown` gives.
    fn struck_as(
        &self,
        x: &Element,
        shown: impl Fn(&Poly) -> Poly,
    ) -> Option<(Poly, Vec<(Poly, u32)>)> {
        let mut above = factor(&shown(&x.num), &self.fuel);
        let mut below = Parts::one();
        for (f, k) in &x.den.factors {
            let parts = factor(&shown(f), &self.fuel);
            // A factor of the denominator has no number in front.
            if !parts.content.is_one() {
                return None;
            }
            below.take(parts, *k);
        }
        let degree = |parts: &Parts| -> u32 {
            let own = |(m, _): (&[u64], &Int)| powers(m).map(|(_, e)| e).sum::<u32>();
            let each = parts.factors.iter();
            each.map(|(f, k)| f.terms().map(own).max().unwrap_or(0) * k)
                .sum()
        };
        let before = degree(&below);
        strike(&mut above, &mut below, &self.fuel);
        if degree(&below) == before {
            return None;
        }
        for (f, _) in above.factors.iter_mut().chain(&mut below.factors) {
            *f = self.reduce(f.clone()).ok()?;
        }
        let num = multiplied(Poly::constant(above.content), &above.factors)?;
        Some((num, below.factors))
    }

    /// With the terms of even degree in a cosine and its sine brought to one degree by cos² + sin² = 1, and those of odd degree
    /// too: for 1 − (1 + μ²) cos² stands sin² − μ² cos², whose factors show.
    pub(super) fn of_one_degree(&self, p: &Poly) -> Poly {
        let mut out = p.clone();
        for (c, s) in self.circles() {
            let degree = |m: &[u64]| exponent(m, c) + exponent(m, s);
            let of = |odd: u32| {
                out.terms()
                    .map(|(m, _)| degree(m))
                    .filter(move |d| d % 2 == odd)
            };
            let most = [0, 1].map(|odd| of(odd).max().unwrap_or(0));
            let square = |v| Poly::term(&mono_of(v, 2), Int::one());
            let circle = square(c).add(&square(s));
            let raised = out.terms().try_fold(Poly::zero(), |total, (m, k)| {
                let own = degree(m);
                let by = circle.pow((most[own as usize % 2] - own) / 2).ok()?;
                Some(total.add(&Poly::term(m, k.clone()).mul(&by).ok()?))
            });
            out = raised.unwrap_or(out);
        }
        out
    }

    /// A generator as base and exponent.
    pub(super) fn generator(&self, v: usize) -> (Expr, Rational) {
        let one = Rational::one();
        match &self.gens[v].kind {
            Kind::Symbol(name) => (Expr::from(name.clone()), one),
            Kind::Cos(base) => (self.angle(*base).cos(), one),
            Kind::Sin(base) => (self.angle(*base).sin(), one),
            Kind::Root => match &self.gens[v].relation {
                Some((n, value)) => {
                    let value = self.kept(&Element::from_poly(value.clone()));
                    (value, ratio(1, i64::from(*n)))
                }
                None => (Expr::zero(), one),
            },
            Kind::Abs(p) => {
                let inside = self.written(&Element::from_poly(p.clone()));
                (Expr::call(Function::Abs, inside), one)
            }
            Kind::Call(function, x) => {
                let x = self.kept(x);
                let flip = function.is_odd() && x.is_negative();
                let value = Expr::call(*function, if flip { -&x } else { x });
                (if flip { -value } else { value }, one)
            }
            Kind::Power(base, exponent) => (self.written(base).power(self.written(exponent)), one),
        }
    }

    pub(super) fn angle(&self, base: usize) -> Expr {
        let base = &self.bases[base];
        let whole = match &base.of {
            AngleOf::Symbol(name) => Expr::from(name.clone()),
            AngleOf::Term(term) => self.kept(term),
        };
        whole * Expr::from(base.part.clone())
    }

    /// A sum with a positive term in front, if it has one; whether its sign was turned; whether a minus can be put into it.
    pub(super) fn sum(&self, p: &Poly) -> (Expr, bool, bool) {
        if let Some((fewer, angles)) = self.in_differences(p) {
            let e = self.written(&Element::from_poly(fewer)).substitute(&angles);
            return if e.is_negative() {
                (-e, true, false)
            } else {
                (e, false, false)
            };
        }
        let mut terms = self.shortened(p);
        let minus = terms.iter().filter(|t| t.coeff.is_negative()).count();
        // What is known to be positive is written so; else, with more minus than plus, or as many and a number that
        // is negative, the other way round reads better.
        let number_negative = terms.iter().any(|t| t.coeff.is_negative() && t.is_number());
        let flip = self.shown_sign(p).map_or_else(
            || 2 * minus > terms.len() || (2 * minus == terms.len() && number_negative),
            |positive| !positive,
        );
        if flip {
            terms.iter_mut().for_each(|t| t.coeff = -t.coeff.clone());
        }
        let mut written = self.grouped(terms);
        written.sort_by_key(|(first, e)| (e.is_negative(), *first));
        let can_take = |e: &Expr| e.is_negative() || !turned_inside(e).is_negative();
        let mixed = written.iter().any(|(_, e)| can_take(e));
        (Expr::sum(written.into_iter().map(|(_, e)| e)), flip, mixed)
    }

    /// Whether a sum is positive, where a relation says so or a short one shows it.
    fn shown_sign(&self, p: &Poly) -> Option<bool> {
        self.stated_sign(p).or_else(|| {
            let mixed = p
                .terms()
                .any(|(_, c)| c.is_negative() != p.coeff(0).is_negative());
            let sign = (mixed && p.len() <= MOST_SIGNED).then(|| self.sign_poly(p))??;
            Some(sign.is_not_negative())
        })
    }

    /// Writes the terms, those with a common factor under one bracket where that is shorter, a square among them as one where
    /// that is shorter still. Each comes with its place in the natural order: numbers first, then by degree.
    fn grouped(&self, mut terms: Vec<Term>) -> Vec<Placed> {
        terms.sort_by_key(Term::degree);
        let square = square_group(&terms).map(|group| self.bracketed(terms.clone(), Some(group)));
        let plain = self.bracketed(terms, None);
        let size = |all: &Vec<Placed>| all.iter().map(|(_, e)| e.size()).sum::<usize>();
        let all = std::iter::once(plain).chain(square);
        all.min_by_key(size).unwrap_or_default()
    }

    /// The same, beginning with a given group.
    fn bracketed(&self, mut terms: Vec<Term>, mut first_group: Option<Vec<usize>>) -> Vec<Placed> {
        let mut out: Vec<Placed> = Vec::new();
        let mut totals: Vec<Poly> = Vec::new();
        let (mut at, whole) = (0, terms.len());
        while terms.len() > usize::from(out.is_empty()) + 1 && terms.len() <= MOST_GROUPED {
            let group = first_group
                .take()
                .or_else(|| best_group(&terms, out.is_empty()));
            let Some(group) = group else {
                break;
            };
            let mut total = Poly::zero();
            let mut first = u32::MAX;
            for i in group.into_iter().rev() {
                let term = terms.remove(i);
                first = first.min(term.degree());
                total = total.add(&Poly::term(&term.mono, term.coeff));
            }
            let group = self.written(&Element::from_poly(total.clone()));
            match out.iter_mut().zip(&mut totals).find(|((_, had), other)| {
                // All terms together are what is being written.
                other.len() + total.len() < whole && share_bracket(had, &group)
            }) {
                Some(((_, had), other)) => {
                    *other = other.add(&total);
                    *had = self.written(&Element::from_poly(other.clone()));
                }
                None => {
                    out.push(((first, at), group));
                    totals.push(total);
                }
            }
            at += 1;
        }
        for term in terms {
            let parts = Parts::monomial(term.coeff.clone(), &term.mono);
            let plain = self.assemble(&parts, &Parts::one());
            let degree = term.degree();
            let written = match term.gathered {
                Some(e) => plain * e,
                None => plain,
            };
            out.push(((degree, at), written));
            at += 1;
        }
        out
    }
}

/// A polynomial times powers of others.
fn multiplied(first: Poly, factors: &[(Poly, u32)]) -> Option<Poly> {
    let mut all = factors.iter();
    all.try_fold(first, |total, (f, k)| total.mul(&f.pow(*k).ok()?).ok())
}

/// Whether both are products with the same bracket: `I (M + m) + J (M + m)` is `(I + J) (M + m)`.
fn share_bracket(a: &Expr, b: &Expr) -> bool {
    let (Node::Product(first), Node::Product(second)) = (a.node(), b.node()) else {
        return false;
    };
    let is_bracket = |e: &Expr| matches!(e.node(), Node::Sum(_));
    first.iter().any(|e| is_bracket(e) && second.contains(e))
}

/// Three of more terms that are a square, as a² + 2 a b + b², ascending.
fn square_group(terms: &[Term]) -> Option<Vec<usize>> {
    if !(4..=MOST_PARTED).contains(&terms.len()) {
        return None;
    }
    let plain = |i: &usize| terms[*i].gathered.is_none();
    let squares = terms.iter().map(|t| mono_add(&t.mono, &t.mono).ok());
    let squares: Vec<Option<Mono>> = squares.collect();
    (0..terms.len()).filter(plain).find_map(|i| {
        (i + 1..terms.len()).filter(plain).find_map(|j| {
            let (one, other) = (&terms[i], &terms[j]);
            if one.coeff.is_negative() != other.coeff.is_negative() {
                return None;
            }
            let mono = mono_add(&one.mono, &other.mono).ok()?;
            let has_mono = |k: &usize| {
                let square = squares[*k].as_ref();
                square.is_some_and(|square| trimmed(square) == trimmed(&mono))
            };
            let is_four = |k: &usize| {
                let middle = &terms[*k].coeff;
                middle * middle == &(&one.coeff * &other.coeff) * &Int::from(4)
            };
            let mut all = (0..terms.len()).filter(plain);
            let middle = all.find(|k| has_mono(k) && is_four(k))?;
            let mut group = vec![i, middle, j];
            group.sort_unstable();
            group.dedup();
            (group.len() == 3).then_some(group)
        })
    })
}

/// The terms that are best written under one bracket, ascending, not all of them if `proper`; `None` where that saves nothing.
fn best_group(terms: &[Term], proper: bool) -> Option<Vec<usize>> {
    let mut best: Option<(usize, usize, Vec<usize>)> = None;
    let mut variables: Vec<usize> = terms
        .iter()
        .flat_map(|t| powers(&t.mono).map(|(v, _)| v))
        .collect();
    variables.sort_unstable();
    variables.dedup();
    for v in variables {
        let group: Vec<usize> = (0..terms.len())
            .filter(|i| terms[*i].gathered.is_none() && exponent(&terms[*i].mono, v) > 0)
            .collect();
        if group.len() < 2 || (proper && group.len() == terms.len()) {
            continue;
        }
        let mut common = terms[group[0]].mono.clone();
        for i in &group {
            common = super::mono::mono_min(&common, &terms[*i].mono);
        }
        let own = |i: &usize| letters(&mono_div(&terms[*i].mono, &common)).max(2);
        let inside: usize = group.iter().map(own).sum();
        let outside = letters(&common) + 2;
        let before: usize = group.iter().map(|i| letters(&terms[*i].mono)).sum();
        if let Some(saving) = before.checked_sub(inside + outside).filter(|s| *s > 0) {
            let weight = letters(&common);
            let known = best.as_ref().map(|(saving, weight, _)| (*saving, *weight));
            if known.is_none_or(|known| (saving, weight) > known) {
                best = Some((saving, weight, group));
            }
        }
    }
    best.map(|(_, _, group)| group)
}
