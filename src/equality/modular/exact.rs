//! Proves two plain formulas equal as quotients of polynomials with whole coefficients.
//!
//! In: two expressions, piece by piece. Out: a proof or none; none says nothing. Nothing is cancelled on the way, and what
//! grows long is left to the normal form of `algebra`, which takes ten times as long. The generators of the polynomials
//! are symbols, a cosine and a sine for each angle with c² + s² = 1, and square roots, which are not negative and of which
//! the square is known: two roots with equal squares are one generator.
//! A proof stands for all points at which both formulas have a value; it is given only if they have values at the same
//! points: every divisor is positive on the domain, or a power of one on the other side, and both take the same roots
//! of what may be negative.

use std::borrow::Cow;

use num_integer::Integer;
use num_traits::{One, Signed};

use super::Place;
use super::value::Sign;
use super::walk::{self, Builder, Turn};
use crate::algebra::mono::{Mono, mono_add, mono_div, mono_max, powers};
use crate::algebra::poly::Poly;
use crate::expr::{Expr, Function, Int};

/// Most generators.
pub(super) const GENERATORS: usize = 16;
/// Most terms of a polynomial.
const TERMS: usize = 4096;

/// Largest multiple of the unit of an angle.
const MOST_TURNS: i64 = 8;

/// A quotient: above over `number`·`monomial`·factors.
#[derive(Clone, Debug)]
pub(super) struct Quotient {
    pub above: Poly,
    /// Positive.
    pub number: Int,
    pub monomial: Mono,
    pub factors: Vec<(Poly, u32)>,
}

impl Quotient {
    fn whole(above: Poly) -> Quotient {
        Quotient {
            above,
            number: Int::one(),
            monomial: Mono::new(),
            factors: Vec::new(),
        }
    }
}

/// What the exponents of a monomial count.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum Generator {
    /// The value of a name.
    Symbol(usize),
    /// Cosine and sine of the unit of an angle.
    Cosine(usize),
    /// See there.
    Sine(usize),
    /// A root that is not negative.
    Root {
        /// Its square, in generators from before it.
        square: Poly,
        /// Sign of that square on the domain.
        sign: Sign,
        /// The roots of what may be negative, as bits, that it takes to have a value; itself is one of them then.
        needs: u32,
    },
}

/// A formula as a quotient, and the roots of what may be negative that it takes, as bits.
#[derive(Clone, Debug)]
pub(super) struct Read {
    pub value: Quotient,
    pub used: u32,
}

/// Builds quotients, and keeps what the generators stand for.
#[derive(Clone, Debug)]
pub(super) struct Exact<'a> {
    places: &'a [Place<'a>],
    pub generators: Vec<Generator>,
    /// The roots of what may be negative that were taken since this was cleared, as bits.
    pub used: u32,
}

/// Whether two formulas are proved to be equal and to have values at the same points.
pub(super) fn proves(a: &Expr, b: &Expr, places: &[Place]) -> bool {
    let mut exact = Exact {
        places,
        generators: Vec::new(),
        used: 0,
    };
    let left = exact.read(a);
    let both = left.and_then(|left| Some((left, exact.read(b)?)));
    both.is_some_and(|(left, right)| exact.proves(&left, &right))
}

impl Exact<'_> {
    /// What comes out of reading a formula.
    fn read(&mut self, e: &Expr) -> Option<Read> {
        self.used = 0;
        let value = walk::value(e, self.places, self)?;
        Some(Read {
            value,
            used: self.used,
        })
    }

    fn generator(&mut self, generator: Generator) -> Option<Poly> {
        let known = self.generators.iter().position(|g| *g == generator);
        let at = known.unwrap_or(self.generators.len());
        if at >= GENERATORS {
            return None;
        }
        if known.is_none() {
            self.generators.push(generator);
        }
        Some(Poly::var(at))
    }

    /// What is known of the sign of a generator on the domain, wherever it has a value.
    fn sign(&self, at: usize) -> Sign {
        let (index, turned) = match self.generators.get(at) {
            None => return Sign::Positive,
            Some(Generator::Root { sign, .. }) => return (*sign).max(Sign::NotNegative),
            Some(Generator::Symbol(index)) => (index, false),
            Some(Generator::Cosine(index) | Generator::Sine(index)) => (index, true),
        };
        match self.places.get(*index) {
            // π.
            None => Sign::Positive,
            Some(place) if turned && place.acute => Sign::Positive,
            Some(place) if turned || place.unit.is_some() => Sign::Unknown,
            Some(place) => place.sign,
        }
    }

    fn sign_of_monomial(&self, monomial: &[u64]) -> Sign {
        let factor = |(at, k): (usize, u32)| match k % 2 {
            0 => self.sign(at).max(Sign::NotNegative),
            _ => self.sign(at),
        };
        powers(monomial).map(factor).min().unwrap_or(Sign::Positive)
    }

    /// What is known of the sign of a polynomial: something where no term is negative.
    pub fn sign_of(&self, poly: &Poly) -> Sign {
        let mut sign = Sign::NotNegative;
        for (monomial, k) in poly.terms() {
            match self.sign_of_monomial(monomial) {
                known if known > Sign::Unknown && k.is_positive() => sign = sign.max(known),
                _ => return Sign::Unknown,
            }
        }
        sign
    }

    pub fn is_positive(&self, monomial: &[u64]) -> bool {
        self.sign_of_monomial(monomial) == Sign::Positive
    }

    /// The square of a generator by others, where it has one.
    fn square(&self, at: usize) -> Option<Cow<'_, Poly>> {
        match self.generators.get(at)? {
            Generator::Root { square, .. } => Some(Cow::Borrowed(square)),
            Generator::Sine(index) => {
                let cosine = Generator::Cosine(*index);
                let cosine = self.generators.iter().position(|g| *g == cosine)?;
                Some(Cow::Owned(Poly::rest_of_square(cosine)))
            }
            _ => None,
        }
    }

    /// The normal form: squares of sines and of roots replaced.
    pub fn reduced<'p>(&self, poly: &'p Poly) -> Option<Cow<'p, Poly>> {
        let mut poly = Cow::Borrowed(poly);
        // The square of a root has generators from before it, that of a sine has the cosine.
        for at in (0..self.generators.len().min(GENERATORS)).rev() {
            if poly.degree(at) < 2 {
                continue;
            }
            if let Some(square) = self.square(at) {
                poly = Cow::Owned(replaced(&poly, at, &square)?);
            }
        }
        Some(poly)
    }

    /// The same with cosines replaced by sines wherever that takes fewer terms.
    pub fn lighter(&self, mut poly: Poly) -> Option<Poly> {
        for (at, generator) in self.generators.iter().enumerate().take(GENERATORS) {
            if let Generator::Cosine(index) = generator
                && poly.degree(at) > 1
            {
                let sine = Generator::Sine(*index);
                let sine = self.generators.iter().position(|g| *g == sine)?;
                let other = replaced(&poly, at, &Poly::rest_of_square(sine))?;
                if other.len() < poly.len() {
                    poly = other;
                }
            }
        }
        Some(poly)
    }

    /// Whether two formulas are equal, and have values at the same points of the domain.
    pub fn proves(&self, a: &Read, b: &Read) -> bool {
        a.used == b.used && self.equal(&a.value, &b.value).is_some()
    }

    /// Whether two quotients are equal, and their divisors are 0 at the same points of the domain.
    fn equal(&self, a: &Quotient, b: &Quotient) -> Option<()> {
        // With equal factors left out on both sides.
        let common = a.number.gcd(&b.number);
        let over = |mine: &Quotient, other: &Quotient| {
            let number = &other.number / &common;
            let mut above = mine.above.mul_term(&other.monomial, &number).ok()?;
            for (factor, power) in &other.factors {
                let own = mine.factors.iter().find(|(f, _)| f == factor);
                let extra = power.saturating_sub(own.map_or(0, |m| m.1));
                if extra > 0 {
                    above = times(&above, &raised(factor, extra)?)?;
                }
            }
            Some(above)
        };
        let difference = over(a, b)?.sub(&over(b, a)?);
        if !difference.is_zero() && !self.reduced(&difference)?.is_zero() {
            return None;
        }
        let same = self.divides(a, b)? && self.divides(b, a)?;
        same.then_some(())
    }

    /// Whether every divisor of the one is positive or among those of the other, up to a power.
    fn divides(&self, a: &Quotient, b: &Quotient) -> Option<bool> {
        let bare = powers(&a.monomial).all(|(at, _)| {
            let theirs = powers(&b.monomial).any(|(other, _)| other == at);
            theirs || self.sign(at) == Sign::Positive
        });
        let mut all = bare;
        for (factor, _) in &a.factors {
            let positive = self.sign_of(factor) == Sign::Positive;
            if positive || b.factors.iter().any(|(f, _)| f == factor) {
                continue;
            }
            // Up to a number and a monomial, which are looked at by themselves.
            let (_, own, plain) = self.reduced(factor)?.split();
            all &= self.is_positive(&own);
            let mut found = false;
            for (other, _) in &b.factors {
                for power in 1..=2 {
                    let raised = raised(other, power)?;
                    found |= self.reduced(&raised)?.split().2 == plain;
                }
            }
            all &= found;
        }
        Some(all)
    }

    fn inverse(&self, a: &Quotient) -> Option<Quotient> {
        // What stands below and comes up could be 0, and that would be forgotten.
        let below = a.factors.iter().map(|(factor, _)| self.sign_of(factor));
        let lost = below.chain([self.sign_of_monomial(&a.monomial)]);
        if a.above.is_zero() || lost.min() != Some(Sign::Positive) {
            return None;
        }
        let (number, monomial, rest) = a.above.split();
        let mut above = Poly::term(&a.monomial, &a.number * &number.signum());
        for (factor, power) in &a.factors {
            above = times(&above, &raised(factor, *power)?)?;
        }
        let number = number.abs();
        let factors = (rest.len() > 1).then_some((rest, 1)).into_iter().collect();
        Some(Quotient {
            above,
            number,
            monomial,
            factors,
        })
    }
}

/// The product, within the limit.
pub(super) fn times(a: &Poly, b: &Poly) -> Option<Poly> {
    (a.len() * b.len() <= TERMS).then_some(())?;
    a.mul(b).ok()
}

fn raised(p: &Poly, k: u32) -> Option<Poly> {
    match k {
        0 => Some(Poly::one()),
        _ => (1..k).try_fold(p.clone(), |power, _| times(&power, p)),
    }
}

/// A polynomial with the square of a generator replaced until it stands in no square.
fn replaced(poly: &Poly, at: usize, square: &Poly) -> Option<Poly> {
    let mut poly = Cow::Borrowed(poly);
    while let Some((low, high)) = poly.divide_by_power(at, 2) {
        poly = Cow::Owned(low.add(&times(&high, square)?));
    }
    Some(poly.into_owned())
}

/// Enters a factor among others.
fn enter(factors: &mut Vec<(Poly, u32)>, factor: Poly, power: u32) {
    match factors.iter_mut().find(|(f, _)| *f == factor) {
        Some((_, known)) => *known += power,
        None => factors.push((factor, power)),
    }
}

impl Builder for Exact<'_> {
    type Value = Quotient;

    fn number(&mut self, above: i64, below: i64) -> Option<Quotient> {
        let mut out = Quotient::whole(Poly::constant(Int::from(above)));
        out.number = Int::from(below);
        Some(out)
    }

    fn symbol(&mut self, index: usize) -> Option<Quotient> {
        if self.places[index].unit.is_some() {
            return None;
        }
        let generator = self.generator(Generator::Symbol(index))?;
        Some(Quotient::whole(generator))
    }

    fn pi(&mut self) -> Option<Quotient> {
        self.generator(Generator::Symbol(usize::MAX))
            .map(Quotient::whole)
    }

    fn sum(&mut self, a: Quotient, b: Quotient) -> Option<Quotient> {
        let level = a.number == b.number && a.monomial == b.monomial && a.factors == b.factors;
        if level {
            return Some(Quotient {
                above: a.above.plus(b.above),
                ..a
            });
        }
        let number = a.number.lcm(&b.number);
        let monomial = mono_max(&a.monomial, &b.monomial);
        let mut factors = a.factors.clone();
        for (factor, power) in &b.factors {
            match factors.iter_mut().find(|(f, _)| f == factor) {
                Some((_, known)) => *known = (*known).max(*power),
                None => factors.push((factor.clone(), *power)),
            }
        }
        let over = |q: &Quotient| {
            let missing = mono_div(&monomial, &q.monomial);
            let mut above = q.above.mul_term(&missing, &(&number / &q.number)).ok()?;
            for (factor, power) in &factors {
                let mine = q.factors.iter().find(|(f, _)| f == factor);
                let missing = power - mine.map_or(0, |m| m.1);
                if missing > 0 {
                    above = times(&above, &raised(factor, missing)?)?;
                }
            }
            Some(above)
        };
        Some(Quotient {
            above: over(&a)?.plus(over(&b)?),
            number,
            monomial,
            factors,
        })
    }

    fn product(&mut self, a: Quotient, b: Quotient) -> Option<Quotient> {
        let mut factors = a.factors;
        for (factor, power) in b.factors {
            enter(&mut factors, factor, power);
        }
        Some(Quotient {
            above: times(&a.above, &b.above)?,
            number: a.number * b.number,
            monomial: mono_add(&a.monomial, &b.monomial).ok()?,
            factors,
        })
    }

    fn power(&mut self, a: Quotient, halves: i32) -> Option<Quotient> {
        let size = halves.unsigned_abs();
        if size > 64 {
            return None;
        }
        let (base, k) = match size.is_multiple_of(2) {
            true => (a, size / 2),
            false => (self.root(&a)?, size),
        };
        let base = match halves < 0 {
            true => self.inverse(&base)?,
            false => base,
        };
        // The last factor is moved, the others are copies.
        let mut factors = std::iter::repeat_n(base, k as usize);
        let first = factors.next()?;
        factors.try_fold(first, |out, factor| self.product(out, factor))
    }

    fn turn(&mut self, function: Function, turn: &Turn) -> Option<Quotient> {
        let mut total = [Poly::one(), Poly::zero()];
        let turned = |a: &[Poly; 2], b: &[Poly; 2]| -> Option<[Poly; 2]> {
            let cos = times(&a[0], &b[0])?.sub(&times(&a[1], &b[1])?);
            Some([cos, times(&a[1], &b[0])?.add(&times(&a[0], &b[1])?)])
        };
        for (index, k) in &turn.parts {
            if k.abs() > MOST_TURNS {
                return None;
            }
            let cos = self.generator(Generator::Cosine(*index))?;
            let sin = self.generator(Generator::Sine(*index))?;
            let unit = [cos, if *k < 0 { sin.neg() } else { sin }];
            for _ in 0..k.abs() {
                total = turned(&total, &unit)?;
            }
        }
        for _ in 0..turn.quarters {
            let [cos, sin] = total;
            total = [sin.neg(), cos];
        }
        let [cos, sin] = total.map(Quotient::whole);
        match function {
            Function::Sin => Some(sin),
            Function::Cos => Some(cos),
            _ => {
                let inverse = self.inverse(&cos)?;
                self.product(sin, inverse)
            }
        }
    }
}
