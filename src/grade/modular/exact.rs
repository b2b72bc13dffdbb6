//! Proves two plain formulas equal as quotients of polynomials with whole coefficients.
//!
//! In: what the reader in one pass reports, through [`Builder`]. Out: a proof or none; none says nothing. The generators of
//! the polynomials are symbols, a cosine and a sine for each angle with c² + s² = 1, and square roots, which are not
//! negative and of which the square is known: two roots with equal squares are one generator.
//! A proof stands for all points at which both formulas have a value; it is given only if they have values at the same
//! points: every divisor is positive on the domain, or a power of one on the other side, and both take the same roots
//! of what may be negative.

use std::borrow::Cow;

use super::poly::{GENERATORS, Monomial, OVERFLOW, Poly, exponent};
use super::value::{Place, Sign};
use crate::expr::Function;
use crate::formula::stream::{Angle, Builder, Ratio};

/// A quotient: above over `number`·`monomial`·factors.
#[derive(Clone, Debug)]
pub(super) struct Quotient {
    pub above: Poly,
    /// Positive.
    pub number: i64,
    pub monomial: Monomial,
    pub factors: Vec<(Poly, u32)>,
}

impl Quotient {
    fn whole(above: Poly) -> Quotient {
        Quotient {
            above,
            number: 1,
            monomial: 0,
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
    places: &'a [Option<Place>],
    divisor: i32,
    pub generators: Vec<Generator>,
    /// The roots of what may be negative that were taken since this was cleared, as bits.
    pub used: u32,
}

impl<'a> Exact<'a> {
    pub fn new(places: &'a [Option<Place>], divisor: i32, generators: Vec<Generator>) -> Exact<'a> {
        Exact {
            places,
            divisor,
            generators,
            used: 0,
        }
    }

    /// What comes out of reading a formula.
    pub fn read(&mut self, read: impl FnOnce(&mut Self) -> Option<Quotient>) -> Option<Read> {
        self.used = 0;
        let value = read(self)?;
        Some(Read {
            value,
            used: self.used,
        })
    }

    pub fn generator(&mut self, generator: Generator) -> Option<Monomial> {
        let known = self.generators.iter().position(|g| *g == generator);
        let at = known.unwrap_or(self.generators.len());
        if at >= GENERATORS {
            return None;
        }
        if known.is_none() {
            self.generators.push(generator);
        }
        Some(1 << (8 * at))
    }

    /// What is known of the sign of a generator on the domain, wherever it has a value.
    fn sign(&self, at: usize) -> Sign {
        let (index, turned) = match self.generators.get(at) {
            None => return Sign::Positive,
            Some(Generator::Root { sign, .. }) => return (*sign).max(Sign::NotNegative),
            Some(Generator::Symbol(index)) => (index, false),
            Some(Generator::Cosine(index) | Generator::Sine(index)) => (index, true),
        };
        match self.places.get(*index).and_then(Option::as_ref) {
            // By the default a positive number, or an angle in the first quadrant.
            None => Sign::Positive,
            Some(place) if turned || place.unit.is_some() => Sign::Unknown,
            Some(place) => place.sign,
        }
    }

    fn sign_of_monomial(&self, monomial: Monomial) -> Sign {
        let factor = |at| match exponent(monomial, at) {
            0 => Sign::Positive,
            even if even % 2 == 0 => self.sign(at).max(Sign::NotNegative),
            _ => self.sign(at),
        };
        (0..GENERATORS).map(factor).min().unwrap_or(Sign::Positive)
    }

    /// What is known of the sign of a polynomial: something where no term is negative.
    pub fn sign_of(&self, poly: &Poly) -> Sign {
        let mut sign = Sign::NotNegative;
        for (monomial, k) in &poly.0 {
            match self.sign_of_monomial(*monomial) {
                known if known > Sign::Unknown && *k > 0 => sign = sign.max(known),
                _ => return Sign::Unknown,
            }
        }
        sign
    }

    pub fn is_positive(&self, monomial: Monomial) -> bool {
        self.sign_of_monomial(monomial) == Sign::Positive
    }

    /// The square of a generator by others, where it has one.
    fn square(&self, at: usize) -> Option<Cow<'_, Poly>> {
        match self.generators.get(at)? {
            Generator::Root { square, .. } => Some(Cow::Borrowed(square)),
            Generator::Sine(index) => {
                let cosine = Generator::Cosine(*index);
                let cosine = self.generators.iter().position(|g| *g == cosine)?;
                Some(Cow::Owned(Poly(vec![(2 << (8 * cosine), -1), (0, 1)])))
            }
            _ => None,
        }
    }

    /// The normal form: squares of sines and of roots replaced.
    pub fn reduced<'p>(&self, poly: &'p Poly) -> Option<Cow<'p, Poly>> {
        let mut poly = Cow::Borrowed(poly);
        // The square of a root has generators from before it, that of a sine has the cosine.
        for at in (0..self.generators.len().min(GENERATORS)).rev() {
            if poly.0.iter().all(|(m, _)| exponent(*m, at) < 2) {
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
                && poly.0.iter().any(|(m, _)| exponent(*m, at) > 1)
            {
                let sine = Generator::Sine(*index);
                let sine = self.generators.iter().position(|g| *g == sine)?;
                let square = Poly::gather(vec![(2 << (8 * sine), -1), (0, 1)])?;
                let other = replaced(&poly, at, &square)?;
                if other.0.len() < poly.0.len() {
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
        let (mut left, mut right) = (a.above.clone(), b.above.clone());
        for (factor, power) in &b.factors {
            let mine = a.factors.iter().find(|(f, _)| f == factor);
            let extra = power.saturating_sub(mine.map_or(0, |m| m.1));
            left = left.times(&factor.power(extra)?)?;
        }
        for (factor, power) in &a.factors {
            let theirs = b.factors.iter().find(|(f, _)| f == factor);
            let extra = power.saturating_sub(theirs.map_or(0, |t| t.1));
            right = right.times(&factor.power(extra)?)?;
        }
        let common = num_integer::gcd(a.number, b.number);
        left = left.scaled(b.monomial, b.number / common)?;
        right = right.scaled(a.monomial, a.number / common)?;
        let difference = left.minus(&right)?;
        if !self.reduced(&difference)?.0.is_empty() {
            return None;
        }
        let same = self.divides(a, b)? && self.divides(b, a)?;
        same.then_some(())
    }

    /// Whether every divisor of the one is positive or among those of the other, up to a power.
    fn divides(&self, a: &Quotient, b: &Quotient) -> Option<bool> {
        let bare = (0..GENERATORS).all(|at| {
            let occurs = |m| exponent(m, at) > 0;
            !occurs(a.monomial) || occurs(b.monomial) || self.sign(at) == Sign::Positive
        });
        let mut all = bare;
        for (factor, _) in &a.factors {
            let positive = self.sign_of(factor) == Sign::Positive;
            if positive || b.factors.iter().any(|(f, _)| f == factor) {
                continue;
            }
            // Up to a number and a monomial, which are looked at by themselves.
            let (_, own, plain) = self.reduced(factor)?.split();
            all &= self.is_positive(own);
            let mut found = false;
            for (other, _) in &b.factors {
                for power in 1..=2 {
                    let raised = other.power(power)?;
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
        let lost = below.chain([self.sign_of_monomial(a.monomial)]);
        if a.above.0.is_empty() || lost.min() != Some(Sign::Positive) {
            return None;
        }
        let (number, monomial, rest) = a.above.split();
        let mut above = Poly(vec![(a.monomial, a.number.checked_mul(number.signum())?)]);
        for (factor, power) in &a.factors {
            above = above.times(&factor.power(*power)?)?;
        }
        let mut out = Quotient {
            above,
            number: number.checked_abs()?,
            monomial,
            factors: Vec::new(),
        };
        if rest.0.len() > 1 {
            out.factors.push((rest, 1));
        }
        Some(out)
    }
}

/// A polynomial with the square of a generator replaced until it stands in no square.
fn replaced(poly: &Poly, at: usize, square: &Poly) -> Option<Poly> {
    let mut terms = Vec::with_capacity(poly.0.len() * 2);
    for (monomial, k) in &poly.0 {
        let twice = exponent(*monomial, at) / 2;
        let less = monomial - (Monomial::from(2 * twice) << (8 * at));
        if twice == 0 {
            terms.push((*monomial, *k));
        } else {
            let power = square.power(u32::from(twice))?;
            terms.extend(power.scaled(less, *k)?.0);
        }
    }
    Poly::gather(terms)
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

    fn number(&mut self, digits: u64, tens: u32) -> Option<Quotient> {
        let mut out = Quotient::whole(Poly::constant(i64::try_from(digits).ok()?));
        out.number = 10i64.checked_pow(tens)?;
        Some(out)
    }

    fn symbol(&mut self, index: usize, _: &[u8]) -> Option<Quotient> {
        let place = self.places.get(index).and_then(Option::as_ref);
        if place.is_some_and(|p| p.unit.is_some()) {
            return None;
        }
        let generator = self.generator(Generator::Symbol(index))?;
        Some(Quotient::whole(Poly(vec![(generator, 1)])))
    }

    fn pi(&mut self) -> Option<Quotient> {
        let generator = self.generator(Generator::Symbol(usize::MAX))?;
        Some(Quotient::whole(Poly(vec![(generator, 1)])))
    }

    fn negative(&mut self, mut a: Quotient) -> Option<Quotient> {
        for (_, k) in &mut a.above.0 {
            *k = k.checked_neg()?;
        }
        Some(a)
    }

    fn sum(&mut self, a: Quotient, b: Quotient) -> Option<Quotient> {
        let level = a.number == b.number && a.monomial == b.monomial && a.factors == b.factors;
        if level {
            return Some(Quotient {
                above: a.above.plus(&b.above)?,
                ..a
            });
        }
        let number = num_integer::lcm(a.number, b.number);
        let (x, y) = (a.monomial.to_ne_bytes(), b.monomial.to_ne_bytes());
        let monomial = Monomial::from_ne_bytes(std::array::from_fn(|i| x[i].max(y[i])));
        let mut factors = a.factors.clone();
        for (factor, power) in &b.factors {
            match factors.iter_mut().find(|(f, _)| f == factor) {
                Some((_, known)) => *known = (*known).max(*power),
                None => factors.push((factor.clone(), *power)),
            }
        }
        let raised = |q: &Quotient| {
            let mut above = q.above.scaled(monomial - q.monomial, number / q.number)?;
            for (factor, power) in &factors {
                let mine = q.factors.iter().find(|(f, _)| f == factor);
                let missing = power - mine.map_or(0, |m| m.1);
                above = above.times(&factor.power(missing)?)?;
            }
            Some(above)
        };
        Some(Quotient {
            above: raised(&a)?.plus(&raised(&b)?)?,
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
        let monomial = a.monomial.checked_add(b.monomial)?;
        (monomial & OVERFLOW == 0).then_some(())?;
        Some(Quotient {
            above: a.above.times(&b.above)?,
            number: a.number.checked_mul(b.number)?,
            monomial,
            factors,
        })
    }

    fn quotient(&mut self, a: Quotient, b: Quotient) -> Option<Quotient> {
        let inverse = self.inverse(&b)?;
        self.product(a, inverse)
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
        let base = if halves < 0 {
            self.inverse(&base)?
        } else {
            base
        };
        let mut out = base.clone();
        for _ in 1..k {
            out = self.product(out, base.clone())?;
        }
        Some(out)
    }

    fn turn(&mut self, ratio: Ratio, angle: &Angle, _: &[&[u8]]) -> Option<Quotient> {
        let mut total = [Poly::constant(1), Poly::constant(0)];
        let turned = |a: &[Poly; 2], b: &[Poly; 2]| -> Option<[Poly; 2]> {
            let cos = a[0].times(&b[0])?.minus(&a[1].times(&b[1])?)?;
            Some([cos, a[1].times(&b[0])?.plus(&a[0].times(&b[1])?)?])
        };
        for (index, share) in angle.parts() {
            if self.divisor % share.below != 0 {
                return None;
            }
            let k = share.above * (self.divisor / share.below);
            if k.abs() > 8 {
                return None;
            }
            let cos = self.generator(Generator::Cosine(index))?;
            let sin = self.generator(Generator::Sine(index))?;
            let cos = Poly(vec![(cos, 1)]);
            let sin = Poly(vec![(sin, i64::from(k.signum()))]);
            let unit = [cos, sin];
            for _ in 0..k.abs() {
                total = turned(&total, &unit)?;
            }
        }
        for _ in 0..angle.quarters.rem_euclid(4) {
            let [cos, sin] = total;
            total = [sin.scaled(0, -1)?, cos];
        }
        let [cos, sin] = total.map(Quotient::whole);
        let value = match ratio.function {
            Function::Sin => sin,
            Function::Cos => cos,
            _ => self.quotient(sin, cos)?,
        };
        match ratio.reciprocal {
            true => self.inverse(&value),
            false => Some(value),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expr::Symbol;
    use crate::formula::stream::{Names, Seen, Table, stream};

    fn proved_with(places: &[Option<Place>], a: &str, b: &str) -> bool {
        let halved = [a, b].iter().any(|text| text.contains("theta/2"));
        let mut names = Names::declared(["x", "y"].map(|name| (name, None)), true);
        let names = names.as_mut().expect("simple names");
        let mut exact = Exact::new(places, 1 + i32::from(halved), Vec::new());
        let mut read = |text: &str| {
            exact.read(|exact| stream(text, Table::Collect(names), exact, &mut Seen::default()))
        };
        let (left, right) = (read(a), read(b));
        let both = left.zip(right);
        both.is_some_and(|(left, right)| exact.proves(&left, &right))
    }

    fn proved(a: &str, b: &str) -> bool {
        proved_with(&[], a, b)
    }

    #[test]
    fn identities_of_polynomials_and_angles_are_proved() {
        for (a, b) in [
            ("(a+b)^2", "a^2 + 2*a*b + b^2"),
            ("1/a + 1/b", "(a+b)/(a*b)"),
            ("sin(2*theta)", "2*sin(theta)*cos(theta)"),
            ("cos(alpha - beta)^2", "1 - sin(alpha-beta)^2"),
            ("tan(theta)*cos(theta)", "sin(theta)"),
            ("0.5*m*v^2", "m*v^2/2"),
            ("sin(pi/2 - theta)", "cos(theta)"),
            ("v/cos(alpha-beta)^2", "v/(1 - sin(alpha-beta)^2)"),
        ] {
            assert!(proved(a, b), "{a} = {b}");
        }
    }

    #[test]
    fn what_is_different_or_lacks_values_elsewhere_is_not() {
        for (a, b) in [
            ("(a+b)^2", "a^2 + b^2"),
            ("sin(theta)", "cos(theta)"),
            // Equal where a is not b.
            ("(a^2-b^2)/(a-b)", "a+b"),
            ("1/(1/(a-b))", "a-b"),
        ] {
            assert!(!proved(a, b), "{a} against {b}");
        }
    }

    #[test]
    fn roots_taken_apart_and_nested_are_proved() {
        for (a, b) in [
            ("sqrt(2*g*h)", "sqrt(2)*sqrt(g)*sqrt(h)"),
            ("sqrt(12*a^2*b)/6", "a*sqrt(b/3)"),
            ("sqrt(g/l)", "sqrt(g*l)/l"),
            ("1/sqrt(2*a)", "sqrt(2*a)/(2*a)"),
            ("a*sqrt(1/2)", "a/sqrt(2)"),
            ("a^(3/2)", "a*sqrt(a)"),
            ("sqrt(sqrt(a))*sqrt(sqrt(a))", "sqrt(a)"),
            ("sqrt(2*g*l*(1-cos(theta)))", "2*sqrt(g*l)*sin(theta/2)"),
            ("sqrt(a^2 - a^2*cos(theta)^2)", "a*sin(theta)"),
            ("sqrt(a^2+2*a*b+b^2)", "a+b"),
            ("v*sqrt(1+3*cos(theta)^2)/2", "v*sqrt(1 - 3*sin(theta)^2/4)"),
            ("(a-b)^(3/2)", "(a-b)*sqrt(a-b)"),
            (
                "sqrt(a^2+b^2)*sqrt(a^2+b^2-c)",
                "sqrt((a^2+b^2)*(a^2+b^2-c))",
            ),
            (
                "sqrt(2*g*(a^2+b^2)^(3/2)*(1-b/sqrt(a^2+b^2))/3)",
                "sqrt(2*g*(a^2+b^2)*(sqrt(a^2+b^2)-b)/3)",
            ),
        ] {
            assert!(proved(a, b), "{a} = {b}");
        }
    }

    #[test]
    fn roots_of_other_numbers_or_with_values_elsewhere_are_not() {
        for (a, b) in [
            ("sqrt(a+b)", "sqrt(a)+sqrt(b)"),
            ("sqrt(a^2-2*a*b+b^2)", "a-b"),
            // Equal where a is above b.
            ("sqrt(a-b)^2", "a-b"),
            ("a + sqrt(a-b) - sqrt(a-b)", "a"),
            ("sqrt(a-b)/sqrt(a-c)", "sqrt((a-b)/(a-c))"),
            ("sqrt(a-b)*sqrt(a-c)", "sqrt((a-b)*(a-c))"),
            ("1/(sqrt(a)-sqrt(b))", "(sqrt(a)+sqrt(b))/(a-b)"),
            ("sqrt(a-b)*(sqrt(a-b))", "sqrt((b-a)^2)"),
        ] {
            assert!(!proved(a, b), "{a} against {b}");
        }
    }

    #[test]
    fn the_root_of_a_square_keeps_its_sign_where_that_is_unknown() {
        let place = |sign| {
            Some(Place {
                sign,
                range: [-2.0, 2.0],
                unit: None::<(Symbol, bool)>,
            })
        };
        let positive = [place(Sign::Positive), place(Sign::Positive)];
        let real = [place(Sign::Unknown), place(Sign::Unknown)];
        for (a, b) in [
            ("sqrt(x^2)", "x"),
            ("sqrt(x^2*y)", "x*sqrt(y)"),
            ("sqrt(x*y)", "sqrt(x)*sqrt(y)"),
            ("sqrt(y/x)", "sqrt(x*y)/x"),
            ("sqrt(x^2+2*x*y+y^2)", "x+y"),
        ] {
            assert!(proved_with(&positive, a, b), "{a} = {b}");
            assert!(!proved_with(&real, a, b), "{a} against {b}");
        }
        assert!(proved_with(&real, "sqrt(x-y)*2", "sqrt(4*x-4*y)"));
    }
}
