//! Proves two plain formulas equal as quotients of polynomials with whole coefficients.
//!
//! In: what the reader in one pass reports, through [`Builder`]. Out: a proof or none; none says nothing. An exponent takes
//! one byte of a word, so there are at most 16 generators: symbols, and a cosine and a sine for each angle with c² + s² = 1.
//! A proof stands for all points at which both formulas have a value; it is given only if they have values at the same
//! points: every divisor is positive on the domain, or a power of one on the other side.

use std::borrow::Cow;

use super::value::{Place, Sign};
use crate::expr::Function;
use crate::formula::stream::{Angle, Builder, Ratio};

/// Exponents of the generators, one byte each.
type Monomial = u128;

/// Most generators.
const GENERATORS: usize = 16;
/// Most terms of a polynomial.
const TERMS: usize = 4096;
/// The highest bit of each exponent; set where one is too large.
const OVERFLOW: Monomial = Monomial::from_ne_bytes([0x80; 16]);

/// Terms in falling order of their monomials, no coefficient 0.
#[derive(Clone, PartialEq, Eq, Debug)]
struct Poly(Vec<(Monomial, i64)>);

impl Poly {
    fn constant(k: i64) -> Poly {
        Poly(if k == 0 { Vec::new() } else { vec![(0, k)] })
    }

    /// Sorts and gathers terms.
    fn gather(mut terms: Vec<(Monomial, i64)>) -> Option<Poly> {
        terms.sort_unstable_by_key(|term| std::cmp::Reverse(term.0));
        let mut out: Vec<(Monomial, i64)> = Vec::with_capacity(terms.len());
        for (monomial, k) in terms {
            match out.last_mut() {
                Some((last, sum)) if *last == monomial => *sum = sum.checked_add(k)?,
                _ => out.push((monomial, k)),
            }
        }
        out.retain(|(_, k)| *k != 0);
        (out.len() <= TERMS).then_some(Poly(out))
    }

    fn scaled(&self, monomial: Monomial, k: i64) -> Option<Poly> {
        let terms = self.0.iter().map(|(m, c)| {
            let sum = m.checked_add(monomial).filter(|s| s & OVERFLOW == 0)?;
            Some((sum, c.checked_mul(k)?))
        });
        terms.collect::<Option<Vec<_>>>().map(Poly)
    }

    fn times(&self, other: &Poly) -> Option<Poly> {
        let (short, long) = match self.0.len() <= other.0.len() {
            true => (self, other),
            false => (other, self),
        };
        match short.0.as_slice() {
            [] => return Some(Poly(Vec::new())),
            // Order is kept by a common factor.
            [(monomial, k)] => return long.scaled(*monomial, *k),
            _ => {}
        }
        if short.0.len() * long.0.len() > TERMS {
            return None;
        }
        let mut terms = Vec::with_capacity(short.0.len() * long.0.len());
        for (monomial, k) in &short.0 {
            terms.extend(long.scaled(*monomial, *k)?.0);
        }
        Poly::gather(terms)
    }

    fn plus(&self, other: &Poly) -> Option<Poly> {
        let mut terms = Vec::with_capacity(self.0.len() + other.0.len());
        terms.extend_from_slice(&self.0);
        terms.extend_from_slice(&other.0);
        Poly::gather(terms)
    }

    fn power(&self, k: u32) -> Option<Poly> {
        let mut out = Poly::constant(1);
        for _ in 0..k {
            out = out.times(self)?;
        }
        Some(out)
    }

    /// Splits off the largest number and monomial that divide all terms; the sign of the first term goes with them.
    fn split(&self) -> (i64, Monomial, Poly) {
        let content = self.0.iter().fold(0, |g, (_, k)| num_integer::gcd(g, *k));
        let sign = self.0.first().map_or(1, |(_, k)| k.signum());
        let content = content.max(1) * sign;
        let least = |a: Monomial, b: Monomial| {
            let (a, b) = (a.to_ne_bytes(), b.to_ne_bytes());
            Monomial::from_ne_bytes(std::array::from_fn(|i| a[i].min(b[i])))
        };
        let common = self.0.iter().map(|(m, _)| *m).reduce(least).unwrap_or(0);
        let rest = self.0.iter().map(|(m, k)| (m - common, k / content));
        (content, common, Poly(rest.collect()))
    }
}

/// A quotient: above over `number`·`monomial`·factors.
#[derive(Clone, Debug)]
pub(super) struct Quotient {
    above: Poly,
    number: i64,
    monomial: Monomial,
    factors: Vec<(Poly, u32)>,
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

/// Builds quotients, and keeps what the generators stand for.
#[derive(Clone, Debug)]
pub(super) struct Exact<'a> {
    places: &'a [Option<Place>],
    divisor: i32,
    pub generators: Generators,
}

/// The name of each generator, and whether it is a value (0), a cosine (1) or a sine (2).
pub(super) type Generators = Vec<(usize, u8)>;

impl<'a> Exact<'a> {
    pub fn new(places: &'a [Option<Place>], divisor: i32, generators: Generators) -> Exact<'a> {
        Exact {
            places,
            divisor,
            generators,
        }
    }

    fn generator(&mut self, index: usize, kind: u8) -> Option<Monomial> {
        let known = self.generators.iter().position(|g| *g == (index, kind));
        let at = match known {
            Some(at) => at,
            None => {
                self.generators.push((index, kind));
                self.generators.len() - 1
            }
        };
        (at < GENERATORS).then(|| 1 << (8 * at))
    }

    /// Whether a generator is positive on the domain.
    fn is_positive(&self, at: usize) -> bool {
        let Some((index, kind)) = self.generators.get(at) else {
            return true;
        };
        match self.places.get(*index).and_then(Option::as_ref) {
            // By the default a positive number, or an angle in the first quadrant.
            None => true,
            Some(place) => *kind == 0 && place.sign == Sign::Positive && place.unit.is_none(),
        }
    }

    fn all_positive(&self, monomial: Monomial) -> bool {
        let exponents = monomial.to_le_bytes();
        (0..GENERATORS).all(|at| exponents[at] == 0 || self.is_positive(at))
    }

    /// Replaces s² by 1 − c² until no sine stands in a square.
    fn reduced<'p>(&self, poly: &'p Poly) -> Option<Cow<'p, Poly>> {
        let mut poly = Cow::Borrowed(poly);
        for (at, (index, kind)) in self.generators.iter().enumerate() {
            if *kind != 2 {
                continue;
            }
            let cosine = self.generators.iter().position(|g| *g == (*index, 1))?;
            let (c, s) = (8 * cosine, 8 * at);
            while poly.0.iter().any(|(m, _)| (m >> s) as u8 >= 2) {
                let mut terms = Vec::with_capacity(poly.0.len() * 2);
                for (m, k) in &poly.0 {
                    if ((m >> s) as u8) < 2 {
                        terms.push((*m, *k));
                        continue;
                    }
                    let less = m - (2 << s);
                    let more = less + (2 << c);
                    if more & OVERFLOW != 0 {
                        return None;
                    }
                    terms.push((less, *k));
                    terms.push((more, k.checked_neg()?));
                }
                poly = Cow::Owned(Poly::gather(terms)?);
            }
        }
        Some(poly)
    }

    /// Whether two quotients are equal, and have values at the same points of the domain.
    pub fn proves(&self, a: &Quotient, b: &Quotient) -> Option<()> {
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
        right = right.scaled(a.monomial, -(a.number / common))?;
        let difference = left.plus(&right)?;
        if !self.reduced(&difference)?.0.is_empty() {
            return None;
        }
        let same = self.divides(a, b)? && self.divides(b, a)?;
        same.then_some(())
    }

    /// Whether every divisor of the one is positive or among those of the other, up to a power.
    fn divides(&self, a: &Quotient, b: &Quotient) -> Option<bool> {
        let exponents = |m: Monomial| m.to_le_bytes().map(|e| e > 0);
        let (mine, theirs) = (exponents(a.monomial), exponents(b.monomial));
        let bare = (0..GENERATORS).all(|at| !mine[at] || theirs[at] || self.is_positive(at));
        let mut all = bare;
        for (factor, _) in &a.factors {
            let positive = factor
                .0
                .iter()
                .all(|(m, k)| *k > 0 && self.all_positive(*m));
            if positive || b.factors.iter().any(|(f, _)| f == factor) {
                continue;
            }
            // Up to a number and a monomial, which are looked at by themselves.
            let (_, own, plain) = self.reduced(factor)?.split();
            all &= self.all_positive(own);
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
        if a.above.0.is_empty() {
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
        let generator = self.generator(index, 0)?;
        Some(Quotient::whole(Poly(vec![(generator, 1)])))
    }

    fn pi(&mut self) -> Option<Quotient> {
        let generator = self.generator(usize::MAX, 0)?;
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
        if !size.is_multiple_of(2) || size > 64 {
            return None;
        }
        let base = if halves < 0 { self.inverse(&a)? } else { a };
        let mut out = base.clone();
        for _ in 1..size / 2 {
            out = self.product(out, base.clone())?;
        }
        Some(out)
    }

    fn turn(&mut self, ratio: Ratio, angle: &Angle, _: &[&[u8]]) -> Option<Quotient> {
        let mut total = [Poly::constant(1), Poly::constant(0)];
        let minus = |p: &Poly| p.scaled(0, -1);
        let turned = |a: &[Poly; 2], b: &[Poly; 2]| -> Option<[Poly; 2]> {
            let cos = a[0].times(&b[0])?.plus(&minus(&a[1].times(&b[1])?)?)?;
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
            let cos = Poly(vec![(self.generator(index, 1)?, 1)]);
            let sin = Poly(vec![(self.generator(index, 2)?, i64::from(k.signum()))]);
            let unit = [cos, sin];
            for _ in 0..k.abs() {
                total = turned(&total, &unit)?;
            }
        }
        for _ in 0..angle.quarters.rem_euclid(4) {
            let [cos, sin] = total;
            total = [minus(&sin)?, cos];
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
    use crate::formula::stream::{Names, Seen, Table, stream};

    fn proved(a: &str, b: &str) -> bool {
        let mut names = Names::collecting();
        let mut exact = Exact::new(&[], 1, Generators::new());
        let mut seen = Seen::default();
        let mut read = |text: &str| {
            stream(text, Table::Collect(&mut names), &mut exact, &mut seen)
                .expect("a plain formula")
        };
        let (left, right) = (read(a), read(b));
        exact.proves(&left, &right).is_some()
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
        ] {
            assert!(!proved(a, b), "{a} against {b}");
        }
    }
}
