//! From an expression to its normal form.

use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::Stop;
use super::element::{Den, Element};
use super::field::{AngleOf, Field, Generator, Kind};
use super::mono::{exponent, mono_of, mono_variables};
use super::poly::Poly;
use crate::expr::angle::angle;
use crate::expr::{Expr, Function, Int, Node, Rational, Symbol, ratio};

/// Deepest nesting of an expression.
const MOST_DEPTH: u32 = 120;
/// Largest multiple of a base angle.
const MOST_TURNS: i64 = 100;
/// Largest power of a sum that is written out.
const MOST_POWER: i64 = 127;
/// Most different angles in one argument.
pub(super) const MOST_ANGLES: usize = 24;

/// Cosine and sine.
type Direction = [Element; 2];

/// Most normal forms that are remembered.
const MOST_KNOWN: usize = 4096;

impl Field {
    /// The normal form.
    pub fn element(&mut self, e: &Expr) -> Result<Element, Stop> {
        self.fuel.refill();
        if matches!(e.node(), Node::Number(_) | Node::Symbol(_)) {
            return self.read(e, MOST_DEPTH);
        }
        if let Some(known) = self.read.get(e) {
            return Ok(known.clone());
        }
        let element = self.read(e, MOST_DEPTH)?;
        // Memory stays bounded for whoever reads without end.
        if self.read.len() < MOST_KNOWN {
            self.read.insert(e.clone(), element.clone());
        }
        Ok(element)
    }

    fn read(&mut self, e: &Expr, depth: u32) -> Result<Element, Stop> {
        let depth = depth.checked_sub(1).ok_or(Stop::TooLarge("depth"))?;
        match e.node() {
            Node::Number(value) => Ok(self.number(value)),
            Node::Symbol(name) => {
                let v = self.symbol(name);
                Ok(Element::var(v))
            }
            Node::Sum(terms) => {
                let mut total = self.read(&terms[0], depth)?;
                for term in &terms[1..] {
                    let term = self.read(term, depth)?;
                    total = self.add(&total, &term)?;
                }
                Ok(total)
            }
            Node::Product(factors) if factors.iter().any(is_high_power) => {
                self.read_high_powers(factors, depth)
            }
            Node::Product(factors) => {
                let mut total = self.read(&factors[0], depth)?;
                for factor in &factors[1..] {
                    // A quotient is read as one, so that b/b never passes through 1/b.
                    if let Node::Power(base, exponent) = factor.node()
                        && let Some(k) = whole(exponent).filter(|k| *k < 0)
                    {
                        let base = self.read(base, depth)?;
                        let power = self.pow(&base, -k)?;
                        total = self.div(&total, &power)?;
                        continue;
                    }
                    let factor = self.read(factor, depth)?;
                    total = self.mul(&total, &factor)?;
                }
                Ok(total)
            }
            Node::Power(base, exponent) => self.read_power(base, exponent, depth),
            Node::Call(function, argument) => {
                if let Some(known) = self.read.get(e) {
                    return Ok(known.clone());
                }
                let element = self.read_call(*function, argument, depth)?;
                if self.read.len() < MOST_KNOWN {
                    self.read.insert(e.clone(), element.clone());
                }
                Ok(element)
            }
        }
    }

    /// A product with high powers: those of the same base are joined first.
    fn read_high_powers(&mut self, factors: &[Expr], depth: u32) -> Result<Element, Stop> {
        let mut powers: Vec<(Expr, Rational)> = Vec::new();
        let mut total = self.integer(1);
        for factor in factors {
            let (base, k) = match factor.node() {
                Node::Power(base, k) if k.as_number().is_some() => (
                    base.clone(),
                    k.as_number().cloned().unwrap_or_else(Rational::one),
                ),
                Node::Number(_) => {
                    let number = self.read(factor, depth)?;
                    total = self.mul(&total, &number)?;
                    continue;
                }
                _ => (factor.clone(), Rational::one()),
            };
            match powers.iter_mut().find(|(b, _)| *b == base) {
                Some((_, sum)) => *sum += k,
                None => powers.push((base, k)),
            }
        }
        for (base, k) in powers.into_iter().filter(|(_, k)| !k.is_zero()) {
            let power = self.read_power(&base, &Expr::from(k), depth)?;
            total = self.mul(&total, &power)?;
        }
        Ok(total)
    }

    fn read_power(&mut self, base: &Expr, exponent: &Expr, depth: u32) -> Result<Element, Stop> {
        let base = self.read(base, depth)?;
        let exponent = match exponent.as_number() {
            Some(value) => value.clone(),
            None => {
                let exponent = self.read(exponent, depth)?;
                match exponent.as_number() {
                    Some(value) => value,
                    None => return Ok(self.opaque_power(base, exponent)),
                }
            }
        };
        let k = exponent.numer().as_i64().ok_or(Stop::TooLarge("degree"))?;
        let n = exponent
            .denom()
            .as_i64()
            .filter(|n| *n <= 1_000)
            .ok_or(Stop::TooLarge("degree"))?;
        if base.num.is_zero() {
            return match k > 0 {
                true => Ok(base),
                false => Err(Stop::DivisionByZero),
            };
        }
        // k/n as a part over a power of two and a part over an odd number: 2^(5/6) is √2 times the cube root of 2.
        let even = 1 << n.trailing_zeros();
        let odd = n / even;
        // 1 = even·x + odd·y.
        let gcd = even.extended_gcd(&odd);
        let over_odd = (i128::from(k) * i128::from(gcd.x)).rem_euclid(i128::from(odd)) as i64;
        let over_even = (k - over_odd * even) / odd;
        // What cannot be written out may still be the same power of the same.
        if odd == 1 && even == 1 && k.abs() > MOST_POWER && base.num.len() > 1 {
            let exponent = self.integer(k);
            return Ok(self.opaque_power(base, exponent));
        }
        let mut root = base.clone();
        for _ in 0..even.ilog2() {
            root = self.sqrt(&root)?;
        }
        let root = self.pow(&root, over_even)?;
        if odd == 1 {
            return Ok(root);
        }
        let other = self.odd_root(&base, odd as u32)?;
        let other = self.pow(&other, over_odd)?;
        self.mul(&root, &other)
    }

    fn read_call(
        &mut self,
        function: Function,
        argument: &Expr,
        depth: u32,
    ) -> Result<Element, Stop> {
        match function {
            Function::Sin | Function::Cos | Function::Tan => {
                if let Some([cos, sin]) = self.direction(argument, depth)? {
                    return match function {
                        Function::Sin => Ok(sin),
                        Function::Cos => Ok(cos),
                        _ => self.div(&sin, &cos),
                    };
                }
                let argument = self.read(argument, depth)?;
                if function == Function::Tan {
                    let (sin, cos) = (
                        self.call(Function::Sin, argument.clone())?,
                        self.call(Function::Cos, argument)?,
                    );
                    return self.div(&sin, &cos);
                }
                self.call(function, argument)
            }
            Function::Abs => {
                let x = self.read(argument, depth)?;
                self.abs(&x)
            }
            _ => {
                let argument = self.read(argument, depth)?;
                self.call(function, argument)
            }
        }
    }

    /// An opaque function: equal arguments give the same generator, and odd and even ones pull the sign out.
    fn call(&mut self, function: Function, argument: Element) -> Result<Element, Stop> {
        use Function::{Acos, Asin, Atan, Cos, Cosh, Exp, Ln, Sin, Sinh, Tan, Tanh};
        if argument.num.is_zero() {
            match function {
                Sin | Tan | Asin | Atan | Sinh | Tanh => return Ok(Element::zero()),
                Cos | Cosh | Exp => return Ok(self.integer(1)),
                Ln => return Err(Stop::NotReal),
                _ => {}
            }
        }
        if function == Ln && argument.as_number().is_some_and(|v| v.is_one()) {
            return Ok(Element::zero());
        }
        self.complete = false;
        match function {
            Ln => {
                if let Some(sum) = self.logarithm(&argument)? {
                    return Ok(sum);
                }
            }
            Exp => return self.exponential(&argument),
            Acos => {
                // acos x = π/2 − asin x would be a relation between two generators: keep only asin.
                let asin = self.call(Asin, argument)?;
                let pi = self.symbol(&Symbol::from("pi"));
                let half = self.mul(&Element::var(pi), &self.number(&ratio(1, 2)))?;
                return self.sub(&half, &asin);
            }
            _ => {}
        }
        let odd = matches!(function, Sin | Tan | Asin | Atan | Sinh | Tanh);
        let even = matches!(function, Cos | Cosh);
        let flip = (odd || even) && argument.num.leading_is_negative();
        let argument = if flip { self.neg(&argument) } else { argument };
        let exact = if matches!(function, Asin | Atan) {
            self.exact_angle(function, &argument)?
        } else {
            None
        };
        let value = match exact {
            Some(value) => value,
            None => self.opaque(function, argument),
        };
        Ok(if flip && odd { self.neg(&value) } else { value })
    }

    /// Cosine and sine of an argument, when it is a combination of known base angles and of π.
    fn direction(&mut self, argument: &Expr, depth: u32) -> Result<Option<Direction>, Stop> {
        let mut parts: Vec<(usize, i64)> = Vec::new();
        let mut units: Vec<(Direction, i64)> = Vec::new();
        let pi;
        match angle(argument) {
            Some(read) => {
                pi = read.pi;
                for (name, factor) in read.symbols {
                    let known = self
                        .bases
                        .iter()
                        .position(|b| matches!(&b.of, AngleOf::Symbol(s) if *s == name));
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
                    if let Some(unit) = self.inverse_direction(&term)?
                        && factor.is_integer()
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
                let divisor = factor
                    .denom()
                    .to_u32()
                    .filter(|d| *d < 1_000_000)
                    .ok_or(Stop::TooLarge("angle fraction"))?;
                self.add_base(of, divisor)
            }
        };
        let turns = factor * Rational::from(Int::from(i64::from(self.bases[base].divisor)));
        if !turns.is_integer() {
            return Ok(None);
        }
        let k = turns
            .numer()
            .as_i64()
            .filter(|k| k.abs() <= MOST_TURNS)
            .ok_or(Stop::TooLarge("angle multiple"))?;
        Ok(Some((base, k)))
    }

    /// The name, when the element is a bare symbol.
    pub(crate) fn as_symbol(&self, x: &Element) -> Option<Symbol> {
        match &self.gens[self.as_generator(x)?].kind {
            Kind::Symbol(name) => Some(name.clone()),
            _ => None,
        }
    }

    /// The variable, when the element is a bare generator.
    fn as_generator(&self, x: &Element) -> Option<usize> {
        if !x.den.is_one() || x.num.len() != 1 || !x.num.coeff(0).is_one() {
            return None;
        }
        match x.num.variables().as_slice() {
            [v] if exponent(x.num.mono(0), *v) == 1 => Some(*v),
            _ => None,
        }
    }

    fn is_symbol(&self, x: &Element, name: &Symbol) -> bool {
        self.as_symbol(x).is_some_and(|s| s == *name)
    }

    /// Cosine and sine of asin x or atan x.
    fn inverse_direction(&mut self, term: &Element) -> Result<Option<Direction>, Stop> {
        let Some(v) = self.as_generator(term) else {
            return Ok(None);
        };
        let Kind::Call(function @ (Function::Asin | Function::Atan), x) = self.gens[v].kind.clone()
        else {
            return Ok(None);
        };
        let square = self.mul(&x, &x)?;
        Ok(Some(if function == Function::Asin {
            let rest = self.sub(&self.integer(1), &square)?;
            [self.sqrt(&rest)?, x]
        } else {
            let rest = self.add(&self.integer(1), &square)?;
            let root = self.sqrt(&rest)?;
            [self.div(&self.integer(1), &root)?, self.div(&x, &root)?]
        }))
    }

    /// asin and atan of the exact values of sine and tangent at multiples of π/6, π/4 and π/5.
    fn exact_angle(&mut self, function: Function, x: &Element) -> Result<Option<Element>, Stop> {
        let constant = x
            .num
            .variables()
            .into_iter()
            .chain(mono_variables(&x.den.mono))
            .all(|v| matches!(self.gens[v].kind, Kind::Root));
        if !constant || !x.den.factors.is_empty() || x.num.len() > 2 {
            return Ok(None);
        }
        for (p, q) in [
            (1, 6),
            (1, 4),
            (1, 3),
            (1, 2),
            (1, 5),
            (2, 5),
            (1, 10),
            (3, 10),
            (1, 8),
            (3, 8),
            (1, 12),
            (5, 12),
        ] {
            let no_tangent = function == Function::Atan && matches!(q, 2 | 5 | 10);
            if no_tangent || (q >= 8 && x.num.len() < 2) {
                continue;
            }
            let Some([cos, sin]) = self.of_pi(&ratio(p, q))? else {
                continue;
            };
            let value = if function == Function::Asin {
                sin
            } else {
                self.div(&sin, &cos)?
            };
            if self.equal(&value, x) {
                let pi = Element::var(self.symbol(&Symbol::from("pi")));
                return self.mul(&pi, &self.number(&ratio(p, q))).map(Some);
            }
        }
        Ok(None)
    }

    /// ln of a product as a sum over its factors, wherever the product is positive: those that are not negative stand for
    /// themselves, even powers for those of the absolute value, and one factor of unknown sign has the sign of the rest.
    /// Several of unknown sign stay together.
    fn logarithm(&mut self, x: &Element) -> Result<Option<Element>, Stop> {
        let (mut negative, parts) = self.powers_of_parts(x);
        let mut known: Vec<(Element, i64)> = Vec::new();
        let mut unknown: Vec<(Poly, i64)> = Vec::new();
        for (f, k) in parts {
            match self.sign_poly(&f) {
                Some(sign) if sign.is_not_negative() => known.push((Element::from_poly(f), k)),
                Some(_) => {
                    negative ^= k % 2 != 0;
                    known.push((Element::from_poly(f.neg()), k));
                }
                None if k % 2 == 0 => known.push((self.abs_poly(&f)?, k)),
                None => unknown.push((f, k)),
            }
        }
        match unknown.as_slice() {
            [] if negative => return Ok(None),
            [] => {}
            [(f, k)] => {
                let f = if negative { f.neg() } else { f.clone() };
                known.push((Element::from_poly(f), *k));
            }
            several => {
                if known.is_empty() {
                    return Ok(None);
                }
                let mut rest = self.integer(if negative { -1 } else { 1 });
                for (f, k) in several {
                    let power = self.pow(&Element::from_poly(f.clone()), *k)?;
                    rest = self.mul(&rest, &power)?;
                }
                known.push((rest, 1));
            }
        }
        let mut total = Element::zero();
        for (f, k) in known {
            // ln √p is half of ln p.
            let (f, k) = match self.as_generator(&f).map(|v| self.gens[v].clone()) {
                Some(Generator {
                    kind: Kind::Root,
                    relation: Some((n, value)),
                }) => (Element::from_poly(value), ratio(k, i64::from(n))),
                _ => (f, ratio(k, 1)),
            };
            let ln = self.opaque(Function::Ln, f);
            total = self.add(&total, &self.mul(&ln, &self.number(&k))?)?;
        }
        Ok(Some(total))
    }

    /// e raised to a sum as a product over its terms.
    pub(super) fn exponential(&mut self, x: &Element) -> Result<Element, Stop> {
        let mut total = self.integer(1);
        for (term, factor) in self.angle_terms(x) {
            // e to the logarithm of something is that.
            let inside = self.as_generator(&term).map(|v| self.gens[v].kind.clone());
            if let Some(Kind::Call(Function::Ln, inner)) = inside
                && let (Some(k), Some(n @ (1 | 2))) =
                    (factor.numer().as_i64(), factor.denom().as_i64())
            {
                let base = if n == 2 { self.sqrt(&inner)? } else { inner };
                total = self.mul(&total, &self.pow(&base, k)?)?;
                continue;
            }
            let known = self
                .gens
                .iter()
                .enumerate()
                .find_map(|(v, g)| match &g.kind {
                    Kind::Call(Function::Exp, y) => {
                        let ratio = self.div(&term, y).ok()?.as_number()? * &factor;
                        ratio
                            .is_integer()
                            .then(|| ratio.numer().as_i64())
                            .flatten()
                            .map(|k| (v, k))
                    }
                    _ => None,
                });
            let (v, k) = match known {
                Some(found) => found,
                None => {
                    let part = Rational::new(Int::one(), factor.denom().clone());
                    let own = self.mul(&term, &self.number(&part))?;
                    (
                        self.adjoin(Kind::Call(Function::Exp, own)),
                        factor.numer().as_i64().ok_or(Stop::TooLarge("degree"))?,
                    )
                }
            };
            total = self.mul(&total, &self.pow(&Element::var(v), k)?)?;
        }
        Ok(total)
    }

    fn opaque(&mut self, function: Function, argument: Element) -> Element {
        let known = self.gens.iter().position(|g| match &g.kind {
            Kind::Call(f, x) => *f == function && self.equal(x, &argument),
            _ => false,
        });
        Element::var(known.unwrap_or_else(|| self.adjoin(Kind::Call(function, argument))))
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
        let den = Den {
            int: Int::one(),
            ..x.den.clone()
        };
        x.num
            .terms()
            .map(|(mono, coeff)| {
                let mut den = den.clone();
                let num = den.cancel_into(Poly::term(mono, Int::one()));
                (
                    Element { num, den },
                    Rational::new(coeff.clone(), x.den.int.clone()),
                )
            })
            .collect()
    }

    fn turn(&self, a: &Direction, b: &Direction) -> Result<Direction, Stop> {
        Ok([
            self.sub(&self.mul(&a[0], &b[0])?, &self.mul(&a[1], &b[1])?)?,
            self.add(&self.mul(&a[1], &b[0])?, &self.mul(&a[0], &b[1])?)?,
        ])
    }

    fn multiple(&self, unit: &Direction, k: i64) -> Result<Direction, Stop> {
        let unit = if k < 0 {
            [unit[0].clone(), self.neg(&unit[1])]
        } else {
            unit.clone()
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
    fn of_pi(&mut self, q: &Rational) -> Result<Option<Direction>, Stop> {
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
        let number = |field: &Field, n: i64, d: i64| field.number(&ratio(n, d));
        if p == 0 {
            return Ok(Some([self.integer(1), Element::zero()]));
        }
        let pair = match (p, d) {
            (1, 3 | 6) => {
                let long = {
                    let three = self.integer(3);
                    let root = self.sqrt(&three)?;
                    self.mul(&root, &number(self, 1, 2))?
                };
                let short = number(self, 1, 2);
                if d == 3 { [short, long] } else { [long, short] }
            }
            (1, 4) => {
                let two = self.integer(2);
                let root = self.sqrt(&two)?;
                let half = self.mul(&root, &number(self, 1, 2))?;
                [half.clone(), half]
            }
            (1 | 2, 5) => {
                let five = self.integer(5);
                let root = self.sqrt(&five)?;
                let quarter = number(self, 1, 4);
                let cos = self.mul(&self.add(&root, &self.integer(1))?, &quarter)?;
                let square = self.sub(&self.integer(1), &self.mul(&cos, &cos)?)?;
                let sin = self.sqrt(&square)?;
                let unit = [cos, sin];
                if p == 1 {
                    unit
                } else {
                    self.multiple(&unit, 2)?
                }
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
                let square = self.mul(&self.add(&cos, &self.integer(1))?, &number(self, 1, 2))?;
                let half_cos = self.sqrt(&square)?;
                let half_sin = self.div(&self.mul(&sin, &number(self, 1, 2))?, &half_cos)?;
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
            let square = Poly::term(&mono_of(c, 2), Int::one());
            self.relate(s, 2, Poly::one().sub(&square));
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

fn is_high_power(e: &Expr) -> bool {
    match e.node() {
        Node::Power(_, k) => whole(k).is_some_and(|k| k.abs() > MOST_POWER),
        _ => false,
    }
}

fn whole(exponent: &Expr) -> Option<i64> {
    let k = exponent.as_number()?;
    if k.is_integer() && k.abs() < ratio(1 << 40, 1) {
        k.numer().as_i64()
    } else {
        None
    }
}
