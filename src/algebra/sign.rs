//! Signs on the domain: proved by coefficients, or merely seen at sample points.
//!
//! A proof writes every variable as a positive one — an interval through x = (lo + hi·u)/(1 + u), an angle through the
//! tangent of its half — and finds all coefficients of one sign, on the whole domain or on each of its parts. Ends that are
//! no fractions are enclosed from outside.

use num_traits::{Signed, Zero};

use super::Sign;
use super::element::Element;
use super::factor::factor;
use super::field::{AngleOf, Field, Kind};
use super::mono::{exponent, mono_variables};
use super::poly::Poly;
use super::range::{End, Found, Interval};
use crate::domain::Limit;
use crate::expr::{Function, Int, Rational, Symbol, effort, ratio};

/// Most terms of a quadratic whose discriminant, with as many terms squared, is looked at.
const MOST_QUADRATIC: usize = 40;

/// What is known of a variable's sign without work.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Known {
    Positive,
    NotNegative,
    Unknown,
}

impl Field {
    /// The sign at all points of the domain at which there is a value, where it is proved. It says nothing of where there
    /// is one: 1/e is positive on the closed interval from 0 to 1.
    pub fn sign(&self, x: &Element) -> Option<Sign> {
        self.fuel.refill();
        self.sign_of(x)
    }

    pub(crate) fn sign_of(&self, x: &Element) -> Option<Sign> {
        let mut sign = self.sign_poly(&x.num)?;
        for v in mono_variables(&x.den.mono) {
            if exponent(&x.den.mono, v) % 2 == 1 {
                sign = sign.times(nonzero(self.sign_poly(&Poly::var(v))?));
            }
        }
        for (f, k) in &x.den.factors {
            if k % 2 == 1 {
                sign = sign.times(nonzero(self.sign_poly(f)?));
            }
        }
        Some(sign)
    }

    pub(crate) fn sign_poly(&self, p: &Poly) -> Option<Sign> {
        if p.is_zero() {
            return Some(Sign::Zero);
        }
        let told = self.by_coefficients(p, &[]);
        let is_final = |sign: Sign| sign.is_strict() || !self.is_parted_from_zero(p);
        if told.is_some_and(is_final) {
            return told;
        }
        if p.len() > super::substitution::MOST_TERMS || effort::spent() {
            return told;
        }
        let by_factors = self.sign_of_factors(p, 3);
        by_factors
            .filter(|sign| sign.is_strict())
            .or(told)
            .or(by_factors)
    }

    /// Whether a strict relation speaks of what a polynomial is made of: with e < 1 granted 1 − e² is positive, which on the
    /// closed interval of e is not negative.
    fn is_parted_from_zero(&self, p: &Poly) -> bool {
        let mut strict = self.supposed.iter().filter(|(_, closed)| !closed);
        let own = p.variables();
        strict.any(|(q, _)| q.variables().iter().all(|v| own.contains(v)))
    }

    /// The sign of a logarithm: on which side of 1 its argument lies.
    fn by_logarithm(&self, p: &Poly) -> Option<Sign> {
        let v = self.as_generator(&Element::from_poly(p.clone()))?;
        let Kind::Call(Function::Ln, x) = &self.gens[v].kind else {
            return None;
        };
        let beyond = self.sub(x, &self.integer(1)).ok()?;
        self.sign_of(&beyond)
    }

    /// The sign of a polynomial by those of its factors.
    fn sign_of_factors(&self, p: &Poly, depth: u32) -> Option<Sign> {
        let parts = factor(p, &self.fuel);
        let mut sign = Sign::made(!parts.content.is_negative(), true);
        for (f, k) in parts.factors {
            sign = sign.times(match (self.sign_irreducible(&f, depth), k % 2) {
                (Some(Sign::Positive | Sign::Negative), 0) => Sign::Positive,
                (_, 0) => Sign::NotNegative,
                (sign, _) => sign?,
            });
        }
        Some(sign)
    }

    fn sign_irreducible(&self, p: &Poly, depth: u32) -> Option<Sign> {
        let told = self.by_coefficients(p, &[]);
        if told.is_some() || effort::spent() {
            let stated = self.strictly_stated(p);
            return stated.filter(|_| told.is_some()).or(told);
        }
        let told = self
            .by_logarithm(p)
            .or_else(|| self.by_relations_and_more(p, depth))
            .or_else(|| self.by_ends(p, depth));
        if told.is_some() {
            return told;
        }
        // Where doubles see both signs, no proof of one is worth trying.
        if self.seen_signs(p) == (true, true) {
            return None;
        }
        let found = self.by_substitution(p);
        if found == Found::Mixed {
            return None;
        }
        if depth == 0 {
            return proved(found);
        }
        proved(found)
            .or_else(|| self.by_conjugate(p, depth))
            .or_else(|| self.by_discriminant(p, depth))
            .or_else(|| self.by_bounds(p, depth))
    }

    /// The sign by relations; where they let it be zero, a quadratic without zeros may still be known to have none.
    fn by_relations_and_more(&self, p: &Poly, depth: u32) -> Option<Sign> {
        let told = self.by_relations(p)?;
        if told.is_strict() || told == Sign::Zero || depth == 0 {
            return Some(told);
        }
        let strict = self
            .by_discriminant(p, depth)
            .filter(|sign| sign.is_strict());
        strict.or(Some(told))
    }

    /// What is of the first degree in a sine or cosine lies between its values at −1 and 1, whatever the angle: 1 − cos x ≥ 0;
    /// in the square of one between those at 0 and 1: 2 − cos² x > 0.
    /// Of a power of what is at most 1 it lies between those at 0 and at the highest that the exponent lets it be.
    fn by_bounds(&self, p: &Poly, depth: u32) -> Option<Sign> {
        let mut variables = p.variables().into_iter();
        let (v, [low, high], open) = variables.find_map(|v| match &self.gens[v].kind {
            Kind::Cos(_) | Kind::Sin(_) => {
                Some((v, [Poly::constant(Int::from(-1)), Poly::one()], false))
            }
            Kind::Power(base, exponent) => {
                Some((v, [Poly::zero(), self.highest(base, exponent)?], true))
            }
            _ => None,
        })?;
        let parts = p.by_power(v);
        let (rest, slope, low) = match (parts.as_slice(), open) {
            ([rest, slope], _) => (rest, slope, low),
            ([rest, none, slope], false) if none.is_zero() => (rest, slope, Poly::zero()),
            _ => return None,
        };
        let at = |end: &Poly| Some(rest.add(&self.mul_poly(slope, end).ok()?));
        let low = self.sign_sub(&at(&low)?, depth)?;
        let high = self.sign_sub(&at(&high)?, depth)?;
        between([(low, open), (high, false)])
    }

    /// What a power of something between 0 and 1 is at most: 1 where its exponent is not negative, the base from 1 on.
    fn highest(&self, base: &Element, exponent: &Element) -> Option<Poly> {
        let one = Element::from_poly(Poly::one());
        let below = |x: &Element| self.add(x, &Element::from_poly(Poly::constant(Int::from(-1))));
        let is_not_negative = |x: &Element| self.sign_of(x).is_some_and(Sign::is_not_negative);
        let above = self.sub(&one, base).ok()?;
        let lies_within = self.sign_of(base) == Some(Sign::Positive) && is_not_negative(&above);
        if !lies_within || !base.den.is_one() {
            return None;
        }
        match below(exponent).is_ok_and(|rest| is_not_negative(&rest)) {
            true => Some(base.num.clone()),
            false => is_not_negative(exponent).then(Poly::one),
        }
    }

    /// What is of the first degree in an angle lies between its values at the ends of the angle's interval, which are
    /// multiples of π and taken as they stand; so does what holds an arc.
    fn by_ends(&self, p: &Poly, depth: u32) -> Option<Sign> {
        let is_pi = |v: &usize| matches!(&self.gens[*v].kind, Kind::Symbol(n) if &**n == "pi");
        let variables = p.variables();
        let pi = variables.iter().copied().find(is_pi)?;
        if depth == 0 {
            return None;
        }
        let mut angles = variables
            .into_iter()
            .filter(|v| *v != pi && p.degree(*v) == 1);
        angles.find_map(|v| {
            let ends = self.ends_of_angle(v)?;
            let parts = p.by_power(v);
            let [rest, slope] = parts.as_slice() else {
                return None;
            };
            let turned = self.mul_poly(slope, &Poly::var(pi)).ok()?;
            let at = |end: &Limit| {
                let slope = if end.of_pi { &turned } else { slope };
                let part = slope.scale(end.value.numer());
                rest.scale(end.value.denom()).add(&part)
            };
            let [low, high] = ends.each_ref().map(at);
            let [low, high] = [self.sign_sub(&low, depth)?, self.sign_sub(&high, depth)?];
            between([(low, ends[0].open), (high, ends[1].open)])
        })
    }

    /// Between what an angle lies: a symbol in its domain, an arc in its range.
    fn ends_of_angle(&self, v: usize) -> Option<[Limit; 2]> {
        let quarters = |open: bool| {
            [-1, 1].map(|sign| Limit {
                value: ratio(sign, 2),
                of_pi: true,
                open,
            })
        };
        match &self.gens[v].kind {
            Kind::Symbol(name) => {
                let domain = self.domains.symbols.get(name)?;
                Some([domain.low.clone()?, domain.high.clone()?])
            }
            Kind::Call(Function::Asin, _) => Some(quarters(false)),
            Kind::Call(Function::Atan, _) => Some(quarters(true)),
            _ => None,
        }
    }

    /// A + B√P with A and B of opposite signs has the sign of A² − B²P on A's side.
    fn by_conjugate(&self, p: &Poly, depth: u32) -> Option<Sign> {
        let root = self.last_root(p)?;
        let (2, radicand) = self.gens[root].relation.as_ref()? else {
            return None;
        };
        let parts = p.by_power(root);
        let [a, b] = parts.as_slice() else {
            return None;
        };
        let sb = self.sign_sub(b, depth)?;
        let Some(sa) = self.sign_sub(a, depth) else {
            return self.by_part(p, a, sb, depth);
        };
        if sa.is_not_negative() == sb.is_not_negative() {
            return Some(Sign::made(sa.is_not_negative(), sa.is_strict()));
        }
        let norm = self.norm(a, b, radicand).ok()?;
        let sn = self.sign_sub(&norm, depth)?;
        // |A| > |B|√P: A decides; otherwise B does.
        let decides = match sn {
            Sign::Zero => return Some(Sign::Zero),
            _ if sn.is_not_negative() => sa,
            _ => sb,
        };
        Some(Sign::made(decides.is_not_negative(), sn.is_strict()))
    }

    /// Terms of A with the sign of B√P can be left out of A + B√P where what remains has that sign.
    fn by_part(&self, p: &Poly, a: &Poly, sign: Sign, depth: u32) -> Option<Sign> {
        let adds = |term: &Poly| {
            let own = self.by_coefficients(term, &[]);
            own.is_some_and(|own| own.is_not_negative() == sign.is_not_negative())
        };
        let terms = a.terms().map(|(mono, k)| Poly::term(mono, k.clone()));
        let adding = terms
            .filter(adds)
            .fold(Poly::zero(), |sum, term| sum.add(&term));
        if adding.is_zero() {
            return None;
        }
        let rest = self.sign_sub(&p.sub(&adding), depth)?;
        let is_strict = rest.is_strict() || self.by_coefficients(&adding, &[])?.is_strict();
        let agrees = rest.is_not_negative() == sign.is_not_negative();
        agrees.then(|| Sign::made(rest.is_not_negative(), is_strict))
    }

    fn sign_sub(&self, p: &Poly, depth: u32) -> Option<Sign> {
        match p.is_zero() {
            true => Some(Sign::Zero),
            false => self.sign_of_factors(p, depth - 1),
        }
    }

    /// A quadratic without two real zeros has the sign of its leading coefficient, or is zero.
    fn by_discriminant(&self, p: &Poly, depth: u32) -> Option<Sign> {
        if p.len() > MOST_QUADRATIC {
            return None;
        }
        let plain = |v: &usize| p.degree(*v) == 2 && self.gens[*v].relation.is_none();
        let mut found = None;
        // Three tries: each may look at discriminants of its own. In x² + l x + l² it is x that tells that l > 0 keeps it from 0.
        for v in p.variables().into_iter().filter(plain).take(3) {
            let parts = p.by_power(v);
            let [c, b, a] = parts.as_slice() else {
                continue;
            };
            let (Ok(bb), Ok(ac)) = (self.mul_poly(b, b), self.mul_poly(a, c)) else {
                continue;
            };
            let discriminant = bb.sub(&ac.scale(&Int::from(4)));
            let below = self.sign_sub(&discriminant, depth);
            if let Some(below @ (Sign::Negative | Sign::NotPositive)) = below
                && let Some(sign @ (Sign::Positive | Sign::Negative)) = self.sign_sub(a, depth)
            {
                found = Some(Sign::made(sign.is_not_negative(), below.is_strict()));
                if below.is_strict() {
                    break;
                }
            }
        }
        found
    }

    /// All terms of one sign. Variables that stand for others are positive, up to what `ends` adds; strict is a sign only if
    /// at every corner of the closed domain some term is left that does not vanish there.
    pub(crate) fn by_coefficients(&self, p: &Poly, ends: &[End]) -> Option<Sign> {
        let negative = p.leading_is_negative();
        if p.terms().any(|(_, coeff)| coeff.is_negative() != negative) {
            return None;
        }
        let mut corners: Vec<(usize, Vec<u32>)> = Vec::new();
        for end in ends {
            let zero = end.zero.then_some(0);
            corners.push((end.v, zero.into_iter().chain(end.infinite).collect()));
        }
        for v in p.variables() {
            if ends.iter().any(|end| end.v == v) {
                continue;
            }
            match self.known(v) {
                Known::Positive => {}
                Known::NotNegative => corners.push((v, vec![0])),
                Known::Unknown if p.terms().all(|(m, _)| exponent(m, v).is_multiple_of(2)) => {
                    corners.push((v, vec![0]));
                }
                Known::Unknown => return None,
            }
        }
        corners.retain(|(_, left)| !left.is_empty());
        let terms: Vec<&[u64]> = p.terms().map(|(mono, _)| mono).collect();
        Some(Sign::made(!negative, left_at_corners(&terms, &corners)))
    }

    /// Whether a root vanishes, by the sign of its radicand. A relation that tells that sign may hold the root itself: then
    /// it is no more than not negative.
    fn radicand_sign(&self, v: usize) -> Known {
        let relation = self.gens[v].relation.as_ref();
        let Some((_, radicand)) = relation.filter(|_| !self.asked.borrow().contains(&v)) else {
            return Known::NotNegative;
        };
        let known = self.roots.borrow().get(&v).copied();
        let is_positive = known.unwrap_or_else(|| {
            self.asked.borrow_mut().push(v);
            let is_positive = self.sign_poly(radicand) == Some(Sign::Positive);
            self.asked.borrow_mut().pop();
            // What was not proved for want of work, or because another root was being looked at, is looked for again.
            if is_positive
                || self.asked.borrow().is_empty() && !self.fuel.is_spent() && !effort::spent()
            {
                self.roots.borrow_mut().insert(v, is_positive);
            }
            is_positive
        });
        match is_positive {
            true => Known::Positive,
            false => Known::NotNegative,
        }
    }

    /// Whether a function or a power is that of something positive. A relation that tells that sign may hold the function itself,
    /// as x asin(x) ≥ −1 does for x: then nothing is known.
    fn is_of_positive(&self, v: usize, of: &Element) -> bool {
        if self.asked.borrow().contains(&v) {
            return false;
        }
        self.asked.borrow_mut().push(v);
        let sign = self.sign_of(of);
        self.asked.borrow_mut().pop();
        sign == Some(Sign::Positive)
    }

    fn known(&self, v: usize) -> Known {
        match &self.gens[v].kind {
            Kind::Symbol(name) => match self.interval(name).low {
                Some((low, true)) if !low.is_negative() => Known::Positive,
                Some((low, false)) if low.is_positive() => Known::Positive,
                Some((low, false)) if low.is_zero() => Known::NotNegative,
                _ => Known::Unknown,
            },
            Kind::Cos(base) => self
                .in_turns(*base)
                .map_or(Known::Unknown, |i| within(&i, ratio(-1, 2), ratio(1, 2))),
            Kind::Sin(base) => self
                .in_turns(*base)
                .map_or(Known::Unknown, |i| within(&i, ratio(0, 1), ratio(1, 1))),
            Kind::Root => self.radicand_sign(v),
            Kind::Abs(_) => Known::NotNegative,
            Kind::Call(Function::Exp | Function::Cosh, _) => Known::Positive,
            Kind::Call(Function::Asin | Function::Atan, x) if self.is_of_positive(v, x) => {
                Known::Positive
            }
            Kind::Call(Function::Ln, x) if x.as_number().is_some_and(|x| x > ratio(1, 1)) => {
                Known::Positive
            }
            Kind::Call(Function::Cos | Function::Sin, x) => match self.as_turns(x) {
                Some(q) if q.is_positive() && q < ratio(1, 2) => Known::Positive,
                _ => Known::Unknown,
            },
            // Whatever the exponent.
            Kind::Power(base, _) if self.is_of_positive(v, base) => Known::Positive,
            Kind::Call(..) | Kind::Power(..) => Known::Unknown,
        }
    }

    /// The interval of a symbol; multiples of π that are not 0 are enclosed from outside.
    pub(crate) fn interval(&self, name: &Symbol) -> Interval {
        if &**name == "pi" {
            return Interval::open(ratio(333, 106), ratio(355, 113));
        }
        if let Some(domain) = self.domains.symbols.get(name) {
            let end = |limit: &Option<Limit>, upward: bool| {
                limit.as_ref().map(|l| {
                    if !l.of_pi || l.value.is_zero() {
                        return (l.value.clone(), l.open);
                    }
                    match upward != l.value.is_negative() {
                        true => (&l.value * ratio(355, 113), true),
                        false => (&l.value * ratio(333, 106), true),
                    }
                })
            };
            let (low, high) = (end(&domain.low, false), end(&domain.high, true));
            return Interval { low, high };
        }
        if self.domains.is_component(name) {
            let [low, high] = [-1, 1].map(|end| Some((ratio(end, 1), false)));
            return Interval { low, high };
        }
        match self.base_of(name).is_some() {
            true => Interval::open(ratio(0, 1), ratio(355, 226)),
            false => Interval::above_zero(true),
        }
    }

    /// The interval of a base angle in units of π, enclosed from outside; `None` when unbounded.
    pub(crate) fn in_turns(&self, base: usize) -> Option<Interval> {
        let base = &self.bases[base];
        let AngleOf::Symbol(name) = &base.of else {
            return None;
        };
        let part = &base.part;
        let Some(domain) = self.domains.symbols.get(name) else {
            return Some(Interval::open(ratio(0, 1), ratio(1, 2) * part));
        };
        let end = |limit: &Option<Limit>, up: bool| {
            limit.as_ref().map(|l| {
                if l.of_pi || l.value.is_zero() {
                    return (&l.value * part, l.open);
                }
                let over = match up != l.value.is_negative() {
                    true => ratio(106, 333),
                    false => ratio(113, 355),
                };
                (&l.value * over * part, true)
            })
        };
        let (low, high) = (end(&domain.low, false), end(&domain.high, true));
        (low.is_some() && high.is_some()).then_some(Interval { low, high })
    }
}

/// The sign of what lies between two values, each excluded or not.
fn between(ends: [(Sign, bool); 2]) -> Option<Sign> {
    let all = |f: fn(&Sign) -> bool| ends.iter().all(|(sign, _)| f(sign));
    let any = |of: Sign| ends.iter().any(|(sign, _)| *sign == of);
    // Strictly between a value of zero and one that is not, none is zero.
    let no_zero = ends.iter().all(|(sign, open)| *sign != Sign::Zero || *open);
    let weak = any(Sign::NotNegative) || any(Sign::NotPositive);
    match () {
        () if all(|s| *s == Sign::Zero) => Some(Sign::Zero),
        () if all(|s| s.is_not_negative()) && !weak && no_zero => Some(Sign::Positive),
        () if all(|s| s.is_not_negative()) => Some(Sign::NotNegative),
        () if all(|s| s.flip().is_not_negative()) && !weak && no_zero => Some(Sign::Negative),
        () if all(|s| s.flip().is_not_negative()) => Some(Sign::NotPositive),
        () => None,
    }
}

fn proved(found: Found) -> Option<Sign> {
    match found {
        Found::Proved(sign) => Some(sign),
        _ => None,
    }
}

/// Whether some term is left at every corner: where a variable is 0 or infinite, only those of one degree in it.
fn left_at_corners(terms: &[&[u64]], corners: &[(usize, Vec<u32>)]) -> bool {
    let Some(((v, degrees), others)) = corners.split_first() else {
        return !terms.is_empty();
    };
    degrees.iter().all(|degree| {
        let left = terms.iter().filter(|m| exponent(m, *v) == *degree);
        left_at_corners(&left.copied().collect::<Vec<_>>(), others)
    })
}

/// A divisor has a value, so it is not zero.
fn nonzero(sign: Sign) -> Sign {
    match sign {
        Sign::NotNegative => Sign::Positive,
        Sign::NotPositive => Sign::Negative,
        other => other,
    }
}

fn within(i: &Interval, low: Rational, high: Rational) -> Known {
    let (Some((a, open_a)), Some((b, open_b))) = (&i.low, &i.high) else {
        return Known::Unknown;
    };
    if !i.is_within(&low, &high) {
        return Known::Unknown;
    }
    let touches = (*a == low && !open_a) || (*b == high && !open_b);
    if touches {
        Known::NotNegative
    } else {
        Known::Positive
    }
}
