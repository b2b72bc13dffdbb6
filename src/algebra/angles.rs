//! Cosine and sine of combinations of base angles and of π, exactly where square roots give them.

use num_integer::Integer;
use num_traits::{One, Zero};

use super::Stop;
use super::element::Element;
use super::field::{AngleOf, Base, Field, Kind, MOST_ANGLES, handy};
use super::mono::{mono_of, mono_variables};
use super::poly::Poly;
use crate::expr::angle::angle;
use crate::expr::{Expr, Function, Int, Rational, Symbol, ratio};

/// Largest multiple of a base angle.
const MOST_TURNS: i64 = 100;

/// Most of them whose sum is written out: each one doubles the terms.
const MOST_DOUBLED: usize = 12;

/// Cosine and sine.
type Direction = [Element; 2];

impl Field {
    /// Cosine and sine of an argument, when it is a combination of known base angles and of π.
    pub(super) fn direction(
        &mut self,
        argument: &Expr,
        depth: u32,
    ) -> Result<Option<Direction>, Stop> {
        let mut parts: Vec<(usize, i64)> = Vec::new();
        let mut units: Vec<(Direction, i64)> = Vec::new();
        let pi;
        match angle(argument) {
            Some(read) => {
                pi = read.pi;
                for (name, factor) in read.symbols {
                    let known = self.base_of(&name);
                    let Some(part) = self.turns(known, AngleOf::Symbol(name), &factor)? else {
                        return Ok(None);
                    };
                    parts.push(part);
                }
            }
            None => {
                let argument = self.read(argument, depth)?;
                let mut turns = Rational::zero();
                let terms = self.angle_terms(&argument);
                if terms.len() > MOST_ANGLES {
                    return Err(Stop::TooLarge("angles in one argument"));
                }
                for (term, factor) in terms {
                    if self.is_pi(&term) {
                        turns = factor;
                        continue;
                    }
                    let whole = factor.is_integer();
                    let half = *factor.denom() == Int::from(2);
                    if (whole || half)
                        && let Some(unit) = self.inverse_direction(&term, half)?
                        && let Some(k) = factor.numer().as_i64()
                        && k.abs() <= MOST_TURNS
                    {
                        units.push((unit, k));
                        continue;
                    }
                    // Sums of fractions with different denominators may depend on each other.
                    if !term.den.factors.is_empty() {
                        self.complete = false;
                    }
                    let of = match self.as_symbol(&term) {
                        Some(name) => AngleOf::Symbol(name),
                        None => AngleOf::Term(term.clone()),
                    };
                    let same = |b: &AngleOf| match b {
                        AngleOf::Term(t) => self.equal(t, &term),
                        AngleOf::Symbol(name) => self.is_symbol(&term, name),
                    };
                    let known = self.bases.iter().position(|b| same(&b.of));
                    let Some(part) = self.turns(known, of, &factor)? else {
                        return Ok(None);
                    };
                    parts.push(part);
                }
                pi = turns;
            }
        }
        let Some(mut total) = self.of_pi(&pi)? else {
            return Ok(None);
        };
        for (base, k) in parts {
            let base = &self.bases[base];
            units.push(([Element::var(base.cos), Element::var(base.sin)], k));
        }
        if units.len() > MOST_DOUBLED {
            return self.undivided(argument, depth).map(Some);
        }
        // Each turn of each angle may double the terms.
        if units.len() > 1 && units.iter().map(|(_, k)| k.abs()).sum::<i64>() > MOST_TURNS {
            return Err(Stop::TooLarge("angle multiple"));
        }
        for (unit, k) in units {
            let part = self.multiple(&unit, k)?;
            total = self.turn(&total, &part)?;
        }
        Ok(Some(total))
    }

    /// Cosine and sine of a sum too long to be written out: it is an angle of its own, known by its normal form.
    fn undivided(&mut self, argument: &Expr, depth: u32) -> Result<Direction, Stop> {
        self.complete = false;
        let argument = self.read(argument, depth)?;
        let flip = argument.num.leading_is_negative();
        let term = if flip { self.neg(&argument) } else { argument };
        let same = |b: &Base| match &b.of {
            AngleOf::Term(t) => b.part.is_one() && self.equal(t, &term),
            AngleOf::Symbol(_) => false,
        };
        let known = self.bases.iter().position(same);
        let base = known.unwrap_or_else(|| self.add_base(AngleOf::Term(term), &Rational::one()));
        let base = &self.bases[base];
        let (cos, sin) = (Element::var(base.cos), Element::var(base.sin));
        Ok([cos, if flip { self.neg(&sin) } else { sin }])
    }

    /// The base angle and how many of it the coefficient makes; `None` where the base is too coarse.
    fn turns(
        &mut self,
        known: Option<usize>,
        of: AngleOf,
        factor: &Rational,
    ) -> Result<Option<(usize, i64)>, Stop> {
        let base = match known {
            Some(base) => base,
            None => {
                if *factor.denom() >= Int::from(1_000_000) {
                    return Err(Stop::TooLarge("angle fraction"));
                }
                self.add_base(of, &handy(factor))
            }
        };
        let turns = factor / &self.bases[base].part;
        if !turns.is_integer() {
            return Ok(None);
        }
        let k = turns.numer().as_i64().filter(|k| k.abs() <= MOST_TURNS);
        Ok(Some((base, k.ok_or(Stop::TooLarge("angle multiple"))?)))
    }

    /// Cosine and sine of asin x or atan x, or of half of it.
    fn inverse_direction(&mut self, term: &Element, half: bool) -> Result<Option<Direction>, Stop> {
        let Some(v) = self.as_generator(term) else {
            return Ok(None);
        };
        let Kind::Call(function @ (Function::Asin | Function::Atan), x) = self.gens[v].kind.clone()
        else {
            return Ok(None);
        };
        let square = self.mul(&x, &x)?;
        let one = self.integer(1);
        if function == Function::Asin && half {
            // Half of it lies within a quarter turn of 0: (√(1 + x) ± √(1 − x))/2.
            let roots = [self.add(&one, &x)?, self.sub(&one, &x)?];
            let [above, below] = [self.sqrt(&roots[0])?, self.sqrt(&roots[1])?];
            let halved = self.number(&ratio(1, 2));
            let both = [self.add(&above, &below)?, self.sub(&above, &below)?];
            return Ok(Some([
                self.mul(&both[0], &halved)?,
                self.mul(&both[1], &halved)?,
            ]));
        }
        if function == Function::Asin {
            let rest = self.sub(&one, &square)?;
            return Ok(Some([self.sqrt(&rest)?, x]));
        }
        let rest = self.add(&one, &square)?;
        let root = self.sqrt(&rest)?;
        if half {
            // cos² of half an angle is (1 + cos)/2, and its sine is sin/(2 cos).
            let twice = self.mul(&root, &self.integer(2))?;
            let cos = self.sqrt(&self.div(&self.add(&root, &one)?, &twice)?)?;
            let sin = self.div(&x, &self.mul(&twice, &cos)?)?;
            return Ok(Some([cos, sin]));
        }
        Ok(Some([self.div(&one, &root)?, self.div(&x, &root)?]))
    }

    /// asin and atan of the exact values of sine and tangent at multiples of π/6, π/4 and π/5.
    pub(super) fn exact_angle(
        &mut self,
        function: Function,
        x: &Element,
    ) -> Result<Option<Element>, Stop> {
        if let Some(own) = self.own_angle(function, x)? {
            return Ok(Some(own));
        }
        let below = mono_variables(&x.den.mono);
        let mut all = x.num.variables().into_iter().chain(below);
        let constant = all.all(|v| matches!(self.gens[v].kind, Kind::Root));
        if !constant || !x.den.factors.is_empty() || x.num.len() > 2 {
            return Ok(None);
        }
        let above = [1, 1, 1, 1, 1, 2, 1, 3, 1, 3, 1, 5];
        let below = [6, 4, 3, 2, 5, 5, 10, 10, 8, 8, 12, 12];
        for (p, q) in above.into_iter().zip(below) {
            let no_tangent = function == Function::Atan && matches!(q, 2 | 5 | 10);
            if no_tangent || (q >= 8 && x.num.len() < 2) {
                continue;
            }
            let Some([cos, sin]) = self.of_pi(&ratio(p, q))? else {
                continue;
            };
            let value = match function {
                Function::Asin => sin,
                _ => self.div(&sin, &cos)?,
            };
            if self.equal(&value, x) {
                let pi = Element::var(self.symbol(&Symbol::from("pi")));
                return self.mul(&pi, &self.number(&ratio(p, q))).map(Some);
            }
        }
        Ok(None)
    }

    /// The arc sine of the sine or cosine of a base angle, or the arc tangent of its tangent or cotangent, that stays where these
    /// take each value once.
    fn own_angle(&mut self, function: Function, x: &Element) -> Result<Option<Element>, Stop> {
        let of = |base: &Base| {
            let quotient = |above, below| {
                let parts =
                    x.num == Poly::var(above) && x.den.factors.is_empty() && x.den.int.is_one();
                parts && x.den.mono == mono_of(below, 1)
            };
            match function {
                Function::Asin if self.as_generator(x) == Some(base.sin) => Some(ratio(-1, 2)),
                Function::Asin if self.as_generator(x) == Some(base.cos) => Some(ratio(0, 1)),
                Function::Atan if quotient(base.sin, base.cos) => Some(ratio(-1, 2)),
                Function::Atan if quotient(base.cos, base.sin) => Some(ratio(0, 1)),
                _ => None,
            }
        };
        let found = self.bases.iter().enumerate();
        let Some((base, low)) = found
            .map(|(i, b)| (i, of(b)))
            .find_map(|(i, low)| Some((i, low?)))
        else {
            return Ok(None);
        };
        let stays = self
            .in_turns(base)
            .is_some_and(|i| i.is_within(&low, &(&low + ratio(1, 1))));
        let AngleOf::Symbol(name) = self.bases[base].of.clone() else {
            return Ok(None);
        };
        if !stays {
            return Ok(None);
        }
        let part = self.bases[base].part.clone();
        let [own, pi] = [name, Symbol::from("pi")].map(|s| Element::var(self.symbol(&s)));
        let own = self.mul(&own, &self.number(&part))?;
        if low.is_zero() {
            let right = self.mul(&pi, &self.number(&ratio(1, 2)))?;
            return self.sub(&right, &own).map(Some);
        }
        Ok(Some(own))
    }

    /// The number q, when the element is q·π.
    pub(crate) fn as_turns(&self, x: &Element) -> Option<Rational> {
        match self.angle_terms(x).as_slice() {
            [(term, q)] if self.is_pi(term) => Some(q.clone()),
            _ => None,
        }
    }

    fn is_pi(&self, x: &Element) -> bool {
        self.is_symbol(x, &Symbol::from("pi"))
    }

    /// The terms of an argument, each with its rational coefficient split off.
    pub(crate) fn angle_terms(&self, x: &Element) -> Vec<(Element, Rational)> {
        let split = |(mono, coeff): (&[u64], &Int)| {
            let mut den = x.den.clone();
            let int = std::mem::replace(&mut den.int, Int::one());
            let num = den.cancel_into(Poly::term(mono, Int::one()));
            (Element::new(num, den), Rational::new(coeff.clone(), int))
        };
        x.num.terms().map(split).collect()
    }

    fn turn(&self, a: &Direction, b: &Direction) -> Result<Direction, Stop> {
        Ok([
            self.sub(&self.mul(&a[0], &b[0])?, &self.mul(&a[1], &b[1])?)?,
            self.add(&self.mul(&a[1], &b[0])?, &self.mul(&a[0], &b[1])?)?,
        ])
    }

    fn multiple(&self, unit: &Direction, k: i64) -> Result<Direction, Stop> {
        let unit = match k < 0 {
            true => [unit[0].clone(), self.neg(&unit[1])],
            false => unit.clone(),
        };
        let mut total = [self.integer(1), Element::zero()];
        if k == 0 {
            return Ok(total);
        }
        for bit in (0..=k.unsigned_abs().ilog2()).rev() {
            if bit < k.unsigned_abs().ilog2() {
                total = self.turn(&total, &total)?;
            }
            if k.unsigned_abs() >> bit & 1 == 1 {
                total = self.turn(&total, &unit)?;
            }
        }
        Ok(total)
    }

    /// Cosine and sine of q·π for denominators whose values need square roots only.
    pub(super) fn of_pi(&mut self, q: &Rational) -> Result<Option<Direction>, Stop> {
        let two = ratio(2, 1);
        let half = ratio(1, 2);
        let q = q - (q / &two).floor() * &two;
        let quarter = (&q * &two).floor();
        let rest = &q - &(&quarter * &half);
        let Some([cos, sin]) = self.acute(&rest)? else {
            return Ok(None);
        };
        Ok(Some(match quarter.numer().as_i64() {
            Some(0) => [cos, sin],
            Some(1) => [self.neg(&sin), cos],
            Some(2) => [self.neg(&cos), self.neg(&sin)],
            _ => [sin, self.neg(&cos)],
        }))
    }

    /// The same for 0 ≤ q < 1/2, where both values are positive or q is 0.
    fn acute(&mut self, q: &Rational) -> Result<Option<Direction>, Stop> {
        let (Some(p), Some(d)) = (q.numer().as_i64(), q.denom().as_i64()) else {
            return Ok(None);
        };
        if p == 0 {
            return Ok(Some([self.integer(1), Element::zero()]));
        }
        let (one, half) = (self.integer(1), self.number(&ratio(1, 2)));
        let pair = match (p, d) {
            (1, 3 | 6) => {
                let long = self.sqrt(&self.integer(3))?;
                let long = self.mul(&long, &half)?;
                if d == 3 { [half, long] } else { [long, half] }
            }
            (1, 4) => {
                let root = self.sqrt(&self.integer(2))?;
                let both = self.mul(&root, &half)?;
                [both.clone(), both]
            }
            (1 | 2, 5) => {
                let root = self.sqrt(&self.integer(5))?;
                let cos = self.mul(&self.add(&root, &one)?, &self.number(&ratio(1, 4)))?;
                let square = self.sub(&one, &self.mul(&cos, &cos)?)?;
                let sin = self.sqrt(&square)?;
                self.multiple(&[cos, sin], p)?
            }
            (_, 15) => {
                // p/15 = a/3 + b/5.
                let b = (2 * p).mod_floor(&5);
                let a = (p - 3 * b) / 5;
                match (self.of_pi(&ratio(a, 3))?, self.of_pi(&ratio(b, 5))?) {
                    (Some(x), Some(y)) => self.turn(&x, &y)?,
                    _ => return Ok(None),
                }
            }
            (_, d) if d % 2 == 0 && d <= 240 && constructible(d) => {
                let Some([cos, sin]) = self.of_pi(&(q * ratio(2, 1)))? else {
                    return Ok(None);
                };
                let square = self.mul(&self.add(&cos, &one)?, &half)?;
                let half_cos = self.sqrt(&square)?;
                let half_sin = self.div(&self.mul(&sin, &half)?, &half_cos)?;
                [half_cos, half_sin]
            }
            _ => self.opaque_acute(q)?,
        };
        Ok(Some(pair))
    }

    /// Cosine and sine of an angle that square roots do not give, as generators: those of 70° are those of 20° exchanged.
    fn opaque_acute(&mut self, q: &Rational) -> Result<Direction, Stop> {
        if *q > ratio(1, 4) {
            let [cos, sin] = self.opaque_acute(&(ratio(1, 2) - q))?;
            return Ok([sin, cos]);
        }
        self.complete = false;
        let pi = Element::var(self.symbol(&Symbol::from("pi")));
        let angle = self.mul(&pi, &self.number(q))?;
        let cos = self.opaque(Function::Cos, angle.clone());
        let sin = self.opaque(Function::Sin, angle);
        if let (Some(c), Some(s)) = (self.as_generator(&cos), self.as_generator(&sin))
            && self.gens[s].relation.is_none()
        {
            self.relate(s, 2, Poly::rest_of_square(c));
        }
        Ok([cos, sin])
    }
}

/// Whether a regular polygon with 2d corners can be drawn with primes 2, 3 and 5 only.
fn constructible(mut d: i64) -> bool {
    while d % 2 == 0 {
        d /= 2;
    }
    matches!(d, 1 | 3 | 5 | 15)
}
