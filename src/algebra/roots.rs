//! Square roots as a tower of fields, absolute values, and roots of odd degree.
//!
//! Before √e becomes a generator, e is tested for being a square already: z = a + b√d is one exactly when a² − b²d is a
//! square n² and (a ± n)/2 is; an element free of √d also when e·d is. Sines of base angles and second components of unit
//! vectors take part as the quadratic extensions they are, so that √(1 − cos²θ) is found to be |sin θ|.

use std::collections::BTreeSet;

use num_traits::{One, Signed};

use super::element::Element;
use super::factor::Parts;
use super::factor::{factor, primes_with_powers, square_part};
use super::field::{Field, Generator, Kind};
use super::image;
use super::poly::{MOST_UNDER_ROOT, Poly};
use super::range::Found;
use super::{Sign, Stop};
use crate::expr::Int;

/// Most square tests in one search for a hidden square.
const FUEL: u32 = 300;

impl Field {
    /// The non-negative square root.
    pub fn sqrt(&mut self, x: &Element) -> Result<Element, Stop> {
        if x.num.is_zero() {
            return Ok(Element::zero());
        }
        // √(n/d) = √(n·d)/|d|, part by part of d, where even powers come out whole.
        let mut radicand = x.num.scale(&x.den.int);
        let mut outside = Element::from_poly(Poly::constant(x.den.int.clone()));
        for (f, k) in Parts::below(&x.den).factors {
            if k % 2 == 1 {
                radicand = self.mul_poly(&radicand, &f)?;
            }
            let half = match k.div_ceil(2) {
                // As it comes out where it is written out.
                1 => self.abs_of(factor(&f, &self.fuel))?,
                half => self.abs_power(&f, half)?,
            };
            outside = self.mul(&outside, &half)?;
        }
        let root = self.sqrt_poly(&radicand)?;
        self.div(&root, &outside)
    }

    /// |f|ᵏ.
    fn abs_power(&mut self, f: &Poly, k: u32) -> Result<Element, Stop> {
        let base = match k.is_multiple_of(2) {
            true => Element::from_poly(f.clone()),
            false => self.abs_poly(f)?,
        };
        self.pow(&base, i64::from(k))
    }

    fn sqrt_poly(&mut self, p: &Poly) -> Result<Element, Stop> {
        let parts = factor(p, &self.fuel);
        let (root, mut rest) = square_part(&parts.content);
        let mut outside = Element::from_poly(Poly::constant(root));
        let mut odd = Vec::new();
        for (f, k) in parts.factors {
            if k >= 2 {
                let half = self.abs_power(&f, k / 2)?;
                outside = self.mul(&outside, &half)?;
            }
            if k % 2 == 1 {
                odd.push(f);
            }
        }
        let mut product = Poly::constant(rest.clone());
        for f in &odd {
            product = self.mul_poly(&product, f)?;
        }
        if product.is_one() {
            return Ok(outside);
        }
        // √(ab) = √a √b for factors known not to be negative; the others stay under one root.
        let several = odd.len() != 1 || !rest.is_one();
        let mut together = Poly::one();
        // Each with whether it may be zero.
        let mut signed = Vec::new();
        for f in odd {
            match self.sign_poly(&f) {
                Some(Sign::Positive) => signed.push((f, false)),
                Some(sign) if sign.is_not_negative() => signed.push((f, true)),
                Some(Sign::Negative) => {
                    rest = -rest;
                    signed.push((f.neg(), false));
                }
                // What may be zero at an end has a root there.
                _ => together = self.mul_poly(&together, &f)?,
            }
        }
        if rest.is_negative() {
            if together.is_one() {
                // Negative everywhere, but where one of these is zero.
                for (f, _) in signed.extract_if(.., |(_, zero)| *zero) {
                    together = self.mul_poly(&together, &f)?;
                }
            }
            if together.is_one() {
                return Err(Stop::NotReal);
            }
            rest = -rest;
            together = together.neg();
        }
        let mut atoms: Vec<Poly> = signed.into_iter().map(|(f, _)| f).collect();
        atoms.extend(primes(&rest).into_iter().map(Poly::constant));
        if !together.is_one() {
            atoms.push(together);
        }
        // A search for a hidden square would find a product of roots already there as well, but not its sign.
        if several
            && !atoms.iter().all(|a| self.known_root(a, 2).is_some())
            && let Some(hidden) = self.hidden_square(&product)
        {
            let hidden = self.abs(&hidden)?;
            return self.mul(&outside, &hidden);
        }
        for atom in atoms {
            let root = self.root_of(&atom)?;
            outside = self.mul(&outside, &root)?;
        }
        Ok(outside)
    }

    /// √p as an element, by a new generator if need be.
    fn root_of(&mut self, p: &Poly) -> Result<Element, Stop> {
        if let Some(v) = self.known_root(p, 2) {
            return Ok(Element::var(v));
        }
        if let Some((n, value)) = self.as_root(p).filter(|(n, _)| n % 2 == 1) {
            return self.nested_root(&value, n);
        }
        if let Some(hidden) = self.hidden_square(p) {
            return self.abs(&hidden);
        }
        if let Some(parts) = self.denested(p)? {
            return Ok(parts);
        }
        let v = self.adjoin(Kind::Root);
        self.relate(v, 2, p.clone());
        Ok(Element::var(v))
    }

    /// Degree and radicand, when a polynomial is a root by itself.
    pub(super) fn as_root(&self, p: &Poly) -> Option<(u32, Poly)> {
        let g = &self.gens[self.as_generator(&Element::from_poly(p.clone()))?];
        match g.kind {
            Kind::Root => g.relation.clone(),
            _ => None,
        }
    }

    /// The root of degree 2n for odd n, of a root within a root: √p (ⁿ√p)^((1 − n)/2), since 1/(2n) = 1/2 + (1 − n)/(2n).
    fn nested_root(&mut self, p: &Poly, n: u32) -> Result<Element, Stop> {
        let p = Element::from_poly(p.clone());
        let root = self.sqrt(&p)?;
        let odd = self.odd_root(&p, n)?;
        let power = self.pow(&odd, (1 - i64::from(n)) / 2)?;
        self.mul(&root, &power)
    }

    /// The generator that is the n-th root of p, if there is one.
    fn known_root(&self, p: &Poly, n: u32) -> Option<usize> {
        let is_it = |g: &Generator| match (&g.kind, &g.relation) {
            (Kind::Root, Some((m, value))) => *m == n && value == p,
            _ => false,
        };
        self.gens.iter().position(is_it)
    }

    /// The last root in a polynomial.
    pub(super) fn last_root(&self, p: &Poly) -> Option<usize> {
        let mut variables = p.variables().into_iter().rev();
        variables.find(|v| matches!(self.gens[*v].kind, Kind::Root))
    }

    /// a² − b²d, the norm of a + b√d.
    pub(super) fn norm(&self, a: &Poly, b: &Poly, d: &Poly) -> Result<Poly, Stop> {
        let square = self.mul_poly(&self.mul_poly(b, b)?, d)?;
        Ok(self.mul_poly(a, a)?.sub(&square))
    }

    /// (a + n)/2.
    fn half_sum(&self, a: &Poly, n: &Element) -> Result<Element, Stop> {
        let sum = self.add(&Element::from_poly(a.clone()), n)?;
        self.div(&sum, &self.integer(2))
    }

    /// g + b√d/(2g), given the variable that is √d.
    fn with_root(&self, g: &Element, b: &Poly, root: usize) -> Result<Element, Stop> {
        let rest = self.mul(&Element::from_poly(b.clone()), &Element::var(root))?;
        self.add(g, &self.div(&rest, &self.mul(&self.integer(2), g)?)?)
    }

    /// √(a + b√d) = g + b√d/(2g) with g = √((a + n)/2), when a² − b²d is a square n²: two plain roots for a nested one.
    fn denested(&mut self, p: &Poly) -> Result<Option<Element>, Stop> {
        let Some(root) = self.last_root(p) else {
            return Ok(None);
        };
        let Some((2, radicand)) = self.gens[root].relation.clone() else {
            return Ok(None);
        };
        let parts = p.by_power(root);
        let [a, b] = parts.as_slice() else {
            return Ok(None);
        };
        let norm = self.norm(a, b, &radicand)?;
        if norm.is_zero() || matches!(self.sign_poly(&norm), Some(Sign::Negative)) {
            return Ok(None);
        }
        let Some(n) = self.hidden_square(&norm) else {
            return Ok(None);
        };
        for n in [n.clone(), self.neg(&n)] {
            let half = self.half_sum(a, &n)?;
            // Simpler than p, so this ends; positive, so that the new root is real.
            let deeper = self.last_root(&half.num).is_some_and(|v| v >= root);
            if deeper || self.sign_of(&half) != Some(Sign::Positive) {
                continue;
            }
            let g = self.sqrt(&half)?;
            let sum = self.with_root(&g, b, root)?;
            return self.abs(&sum).map(Some);
        }
        Ok(None)
    }

    /// An element whose square is p, if the field has one.
    fn hidden_square(&mut self, p: &Poly) -> Option<Element> {
        let square = |v: &usize| {
            let Generator { kind, relation } = &self.gens[*v];
            matches!(relation, Some((2, _))) && !matches!(kind, Kind::Abs(_))
        };
        let tower: Vec<usize> = self.algebraic.iter().copied().filter(square).collect();
        let relation = |v: &usize| self.gens[*v].relation.as_ref();
        let near = tower.iter().filter(|v| {
            relation(v).is_some_and(|(_, radicand)| self.connected(p, radicand, &tower))
        });
        if image::is_no_square(p, &near.copied().collect::<Vec<_>>(), &self.gens) {
            return None;
        }
        let mut fuel = FUEL;
        let found = self.square_in(p, &tower, &mut fuel);
        if fuel == 0 && found.is_none() {
            self.complete = false;
        }
        found.filter(|r| {
            self.mul(r, r)
                .is_ok_and(|s| self.equal(&s, &Element::from_poly(p.clone())))
        })
    }

    fn square_in(&self, p: &Poly, tower: &[usize], fuel: &mut u32) -> Option<Element> {
        if p.is_zero() {
            return Some(Element::zero());
        }
        *fuel = match p.len() > MOST_UNDER_ROOT {
            true => 0,
            false => fuel.checked_sub(1)?,
        };
        let Some((&g, below)) = tower.split_last() else {
            return p.sqrt().map(Element::from_poly);
        };
        let (_, radicand) = self.gens[g].relation.as_ref()?;
        if p.has(g) {
            let parts = p.by_power(g);
            let [a, b] = parts.as_slice() else {
                return None;
            };
            let norm = self.norm(a, b, radicand).ok()?;
            let n = self.square_in(&norm, below, fuel)?;
            for n in [n.clone(), self.neg(&n)] {
                let half = self.half_sum(a, &n).ok()?;
                if half.num.is_zero() {
                    continue;
                }
                if let Some(x) = self.square_of_element(&half, below, fuel) {
                    return self.with_root(&x, b, g).ok();
                }
            }
            return None;
        }
        if let Some(x) = self.square_in(p, below, fuel) {
            return Some(x);
        }
        if !self.connected(p, radicand, tower) {
            return None;
        }
        let with = self.mul_poly(p, radicand).ok()?;
        let x = self.square_in(&with, below, fuel)?;
        // x/g as x g/g², which is plain where g² divides: sin(α + β) and not a quotient by sin α.
        let above = self.mul(&x, &Element::var(g)).ok()?;
        self.div(&above, &Element::from_poly(radicand.clone())).ok()
    }

    fn square_of_element(&self, x: &Element, tower: &[usize], fuel: &mut u32) -> Option<Element> {
        let den = x.den.expand(self).ok()?;
        let p = self.mul_poly(&x.num, &den).ok()?;
        let root = self.square_in(&p, tower, fuel)?;
        self.div(&root, &Element::from_poly(den)).ok()
    }

    /// Whether a radicand can take part in a square together with p: numbers always can; otherwise they share a
    /// variable, possibly through other radicands of the tower.
    fn connected(&self, p: &Poly, radicand: &Poly, tower: &[usize]) -> bool {
        let letters = |p: &Poly| -> BTreeSet<usize> {
            let all = p.variables().into_iter();
            all.filter(|v| !self.is_numeric(*v)).collect()
        };
        let (mut reached, goal) = (letters(p), letters(radicand));
        if reached.is_empty() || goal.is_empty() {
            return true;
        }
        loop {
            if !goal.is_disjoint(&reached) {
                return true;
            }
            let before = reached.len();
            for g in tower {
                let value = self.gens[*g].relation.as_ref().map(|(_, value)| value);
                let variables = value.map(letters).unwrap_or_default();
                if !variables.is_disjoint(&reached) {
                    reached.extend(variables);
                }
            }
            if reached.len() == before {
                return false;
            }
        }
    }

    /// Whether a generator is a root of numbers only.
    fn is_numeric(&self, v: usize) -> bool {
        let Generator {
            kind: Kind::Root,
            relation: Some((_, value)),
        } = &self.gens[v]
        else {
            return false;
        };
        value.variables().iter().all(|w| self.is_numeric(*w))
    }

    /// |x|.
    pub fn abs(&mut self, x: &Element) -> Result<Element, Stop> {
        if let Some(sign) = self.sign_of(x) {
            return Ok(match sign.is_not_negative() {
                true => x.clone(),
                false => self.neg(x),
            });
        }
        let (above, below) = (factor(&x.num, &self.fuel), Parts::below(&x.den));
        let (above, below) = (self.abs_of(above)?, self.abs_of(below)?);
        self.div(&above, &below)
    }

    fn abs_of(&mut self, parts: Parts) -> Result<Element, Stop> {
        let mut total = Element::from_poly(Poly::constant(parts.content.abs()));
        for (f, k) in parts.factors {
            let part = self.abs_power(&f, k)?;
            total = self.mul(&total, &part)?;
        }
        Ok(total)
    }

    pub(super) fn abs_poly(&mut self, f: &Poly) -> Result<Element, Stop> {
        let turned = |positive| if positive { f.clone() } else { f.neg() };
        if let Some(sign) = self.sign_poly(f) {
            return Ok(Element::from_poly(turned(sign.is_not_negative())));
        }
        let seen = match self.seen_signs(f) {
            (true, true) => (true, true),
            seen if self.by_substitution(f) != Found::Mixed => seen,
            _ => (true, true),
        };
        if seen.0 != seen.1 {
            let f = turned(seen.0);
            self.assume(f.clone());
            return Ok(Element::from_poly(f));
        }
        // Seen with both signs: |f| is a generator of its own. Seen nowhere: likewise, but nothing is known of it.
        if !seen.0 {
            self.complete = false;
        }
        let f = turned(!f.leading_is_negative());
        if let Some(v) = self.generator_that(|kind| matches!(kind, Kind::Abs(p) if *p == f)) {
            return Ok(Element::var(v));
        }
        let square = self.mul_poly(&f, &f)?;
        let v = self.adjoin(Kind::Abs(f));
        self.relate(v, 2, square);
        Ok(Element::var(v))
    }

    /// What absolute values are taken of, hidden in roots of squares or written out.
    pub fn absolute(&self) -> Vec<crate::expr::Expr> {
        let kinds = self.gens.iter().map(|g| &g.kind);
        let inside = kinds.filter_map(|kind| match kind {
            Kind::Abs(p) => Some(self.expr(&Element::from_poly(p.clone()))),
            _ => None,
        });
        inside.collect()
    }

    fn assume(&mut self, f: Poly) {
        let x = Element::from_poly(f);
        if !self.assumed.iter().any(|known| known.num == x.num) {
            self.assumed.push(x);
        }
    }

    /// The real root of odd degree n ≥ 3, factor by factor: it is real for every value, and minus one comes out.
    pub(crate) fn odd_root(&mut self, x: &Element, n: u32) -> Result<Element, Stop> {
        // The ninth root is the cube root of the cube root, so that both may stand in one formula.
        if let Some(least) = (3..n).step_by(2).find(|d| n.is_multiple_of(*d)) {
            let root = self.odd_root(x, least)?;
            return self.odd_root(&root, n / least);
        }
        if x.num.is_zero() {
            return Ok(Element::zero());
        }
        let (mut negative, parts) = self.powers_of_parts(x);
        let mut total = self.integer(1);
        for (f, k) in parts {
            let sign = self.sign_poly(&f);
            let turned = match sign {
                Some(sign) => !sign.is_not_negative(),
                None => f.leading_is_negative(),
            };
            negative ^= turned && k % 2 != 0;
            let f = if turned { f.neg() } else { f };
            let (whole, left) = (k.div_euclid(i64::from(n)), k.rem_euclid(i64::from(n)));
            let power = self.pow(&Element::from_poly(f.clone()), whole)?;
            total = self.mul(&total, &power)?;
            if left > 0 {
                let root = match (sign, self.as_root(&f)) {
                    (_, Some((2, value))) => self.nested_root(&value, n)?,
                    (Some(_), _) => self.odd_root_generator(&f, n),
                    // Generators that are roots are not negative.
                    (None, _) => {
                        let part = self.number(&crate::expr::ratio(1, i64::from(n)));
                        let root = self.opaque_power(Element::from_poly(f.clone()), part);
                        if let Some(v) = self.as_generator(&root)
                            && self.gens[v].relation.is_none()
                        {
                            self.relate(v, n, f);
                        }
                        root
                    }
                };
                let power = self.pow(&root, left)?;
                total = self.mul(&total, &power)?;
            }
        }
        Ok(if negative { self.neg(&total) } else { total })
    }

    /// An element as a sign and a product of irreducible parts with their powers, primes and variables among them.
    pub(super) fn powers_of_parts(&self, x: &Element) -> (bool, Vec<(Poly, i64)>) {
        let num = factor(&x.num, &self.fuel);
        let negative = num.content.is_negative();
        let mut all: Vec<(Poly, i64)> = Vec::new();
        for (parts, sign) in [(num, 1), (Parts::below(&x.den), -1)] {
            let primes = primes_with_powers(&parts.content.abs());
            let primes = primes.into_iter().map(|(p, k)| (Poly::constant(p), k));
            let parts = primes.chain(parts.factors);
            all.extend(parts.map(|(f, k)| (f, i64::from(k) * sign)));
        }
        (negative, all)
    }

    fn odd_root_generator(&mut self, f: &Poly, n: u32) -> Element {
        if let Some(v) = self.known_root(f, n) {
            return Element::var(v);
        }
        // Two odd roots may depend on each other in ways not searched for, unless all radicands are single variables or primes.
        let simple = f.is_constant()
            || (f.len() == 1
                && f.degree(f.variables()[0]) == 1
                && self.algebraic.iter().all(|a| !f.has(*a)));
        let coprime = self.gens.iter().all(|g| match (&g.kind, &g.relation) {
            (Kind::Root, Some((m, value))) => *m == n || *m == 2 || value != f,
            _ => true,
        });
        if !simple || !coprime || n > 60 {
            self.complete = false;
        }
        let v = self.adjoin(Kind::Root);
        self.relate(v, n, f.clone());
        Element::var(v)
    }

    /// base^exponent as an opaque generator; equal bases and exponents give the same one.
    pub(crate) fn opaque_power(&mut self, base: Element, exponent: Element) -> Element {
        self.complete = false;
        let known = self.generator_that(|kind| match kind {
            Kind::Power(b, e) => self.equal(b, &base) && self.equal(e, &exponent),
            _ => false,
        });
        let v = known.unwrap_or_else(|| self.adjoin(Kind::Power(base, exponent)));
        Element::var(v)
    }
}

/// Prime factors of a squarefree value as far as small primes reach; what is left counts as one.
fn primes(value: &Int) -> Vec<Int> {
    primes_with_powers(value)
        .into_iter()
        .flat_map(|(p, k)| std::iter::repeat_n(p, k as usize))
        .collect()
}
