//! From an expression to its normal form.

use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use smallvec::SmallVec;

use super::element::{Den, Element};
use super::field::{Field, Kind};
use super::mono::{Mono, cmp_mono, exponent, mono_add, mono_is_one, mono_of, powers};
use super::poly::Poly;
use super::{Sign, Stop};
use crate::expr::number::product;
use crate::expr::{Expr, Function, Int, Node, Rational, Symbol};

/// Deepest nesting of an expression.
const MOST_DEPTH: u32 = 120;
/// Largest power of a sum that is written out.
const MOST_POWER: i64 = 127;
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

    pub(super) fn read(&mut self, e: &Expr, depth: u32) -> Result<Element, Stop> {
        let depth = depth.checked_sub(1).ok_or(Stop::TooLarge("depth"))?;
        match e.node() {
            Node::Number(value) => Ok(self.number(value)),
            Node::Symbol(name) => {
                let v = self.symbol(name);
                Ok(Element::var(v))
            }
            Node::Sum(terms) => {
                let mut plain = Vec::new();
                let mut others = Vec::new();
                for term in terms.iter() {
                    match self.term(term) {
                        Some(term) if term.below.is_empty() => plain.push(term),
                        _ => others.push(term),
                    }
                }
                let mut total = sum(plain);
                for term in others {
                    let term = self.read(term, depth)?;
                    total = self.add(&total, &term)?;
                }
                Ok(total)
            }
            Node::Product(factors) => {
                if let Some(term) = self.term(e) {
                    return Ok(term.element());
                }
                if factors.iter().any(is_high_power) {
                    return self.read_high_powers(factors, depth);
                }
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

    /// What is a product of numbers and whole powers of generators, read at once; `None` where it is anything else.
    fn term(&self, e: &Expr) -> Option<Term> {
        let mut coeff = Rational::one();
        let mut powers: SmallVec<[(usize, i64); 8]> = SmallVec::new();
        for factor in e.factors() {
            let (base, k) = match factor.node() {
                Node::Number(value) => {
                    coeff = product(&coeff, value);
                    continue;
                }
                Node::Power(base, k) => (base, whole(k)?),
                _ => (factor, 1),
            };
            let v = match base.node() {
                Node::Symbol(name) => *self.names.get(name)?,
                Node::Call(..) => self.as_generator(self.read.get(base)?)?,
                _ => return None,
            };
            match powers.iter_mut().find(|(other, _)| *other == v) {
                Some((_, sum)) => *sum += k,
                None => powers.push((v, k)),
            }
        }
        let (mut above, mut below) = (Mono::new(), Mono::new());
        for (v, k) in powers.into_iter().filter(|(_, k)| *k != 0) {
            let size = u32::try_from(k.abs()).ok().filter(|k| *k < 128)?;
            let side = match k > 0 {
                true => &mut above,
                // Roots are kept out of denominators.
                false if self.gens[v].relation.is_some() => return None,
                false => &mut below,
            };
            *side = mono_add(side, &mono_of(v, size)).ok()?;
        }
        let plain = !coeff.is_zero() && self.is_reduced(&above);
        plain.then_some(Term {
            coeff,
            above,
            below,
        })
    }

    /// A product with high powers: those of the same base are joined first.
    fn read_high_powers(&mut self, factors: &[Expr], depth: u32) -> Result<Element, Stop> {
        let mut powers: Vec<(Expr, Rational)> = Vec::new();
        let mut total = self.integer(1);
        for factor in factors {
            if factor.as_number().is_some() {
                let number = self.read(factor, depth)?;
                total = self.mul(&total, &number)?;
                continue;
            }
            let power = match factor.node() {
                Node::Power(base, k) => k.as_number().map(|k| (base.clone(), k.clone())),
                _ => None,
            };
            let (base, k) = power.unwrap_or_else(|| (factor.clone(), Rational::one()));
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
                    None => return self.power_of_symbols(base, exponent),
                }
            }
        };
        self.rational_power(base, &exponent)
    }

    fn rational_power(&mut self, base: Element, exponent: &Rational) -> Result<Element, Stop> {
        let k = exponent.numer().as_i64().ok_or(Stop::TooLarge("degree"))?;
        let n = exponent.denom().as_i64().filter(|n| *n <= 1_000);
        let n = n.ok_or(Stop::TooLarge("degree"))?;
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
        let mut root = base.clone();
        for _ in 0..even.ilog2() {
            root = self.sqrt(&root)?;
        }
        let root = self.power(&root, over_even)?;
        if odd == 1 {
            return Ok(root);
        }
        let other = self.odd_root(&base, odd as u32)?;
        let other = self.power(&other, over_odd)?;
        self.mul(&root, &other)
    }

    /// A power, written out or not: what cannot be may still be the same power of the same.
    fn power(&mut self, base: &Element, k: i64) -> Result<Element, Stop> {
        if k.abs() > MOST_POWER
            && let Some(power) = self.high_power(base, k)?
        {
            return Ok(power);
        }
        self.pow(base, k)
    }

    /// A power too high to be written out, factor by factor: (2 x)^9999 is 2^9999 x^9999, and (√2 x)^9998 is 2^4999 x^9998.
    /// Nothing where a factor is related to symbols, such as a root of one.
    fn high_power(&mut self, base: &Element, k: i64) -> Result<Option<Element>, Stop> {
        let shared = base.num.mono_content();
        let content = base.num.content();
        let turned = base.num.leading_is_negative();
        let content = if turned { -content } else { content };
        let rest = base.num.div_mono(&shared).div_int(&content);
        let above = powers(&shared).map(|(v, e)| (Poly::var(v), i64::from(e)));
        let below = powers(&base.den.mono).map(|(v, e)| (Poly::var(v), -i64::from(e)));
        let factors = base.den.factors.iter();
        let factors = factors.map(|(factor, e)| (factor.clone(), -i64::from(*e)));
        let mut parts: Vec<(Poly, i64)> = above.chain(below).chain(factors).collect();
        parts.extend((!rest.is_constant()).then_some((rest, 1)));
        let number = Rational::new(content, base.den.int.clone());
        let mut total = self.pow(&self.number(&number), k)?;
        for (part, e) in parts {
            let relation = match part.variables().as_slice() {
                [v] if part.len() == 1 => self.gens[*v].relation.clone(),
                _ => None,
            };
            if let Some((degree, value)) = relation {
                let Some(value) = value.as_constant().cloned() else {
                    return Ok(None);
                };
                let (whole, left) = (e * k).div_mod_floor(&i64::from(degree));
                let whole = self.pow(&self.number(&value.into()), whole)?;
                let left = self.pow(&Element::from_poly(part), left)?;
                total = self.mul(&total, &self.mul(&whole, &left)?)?;
                continue;
            }
            let exponent = self.integer((e * k).abs());
            let power = self.opaque_power(Element::from_poly(part), exponent);
            total = match e * k > 0 {
                true => self.mul(&total, &power)?,
                false => self.div(&total, &power)?,
            };
        }
        Ok(Some(total))
    }

    /// A power with symbols above. Of something positive, what is a number in the exponent comes apart: b b^(n − 1) is bⁿ,
    /// b^(2 n) the square of bⁿ and, where b^(n/2) occurs too, bⁿ the square of that.
    fn power_of_symbols(&mut self, base: Element, exponent: Element) -> Result<Element, Stop> {
        if base.num.is_zero() && self.sign_of(&exponent) == Some(Sign::Positive) {
            return Ok(base);
        }
        let parts = self.integer(self.exponent_parts);
        let multiple = self.mul(&exponent, &parts)?;
        if !multiple.den.is_one() || self.sign_of(&base) != Some(Sign::Positive) {
            // A negative exponent stands below, of whatever is a power.
            if exponent.num.leading_is_negative() {
                let turned = self.neg(&exponent);
                let below = self.opaque_power(base, turned);
                return self.div(&self.integer(1), &below);
            }
            return Ok(self.opaque_power(base, exponent));
        }
        let constant = multiple.num.terms().find(|(mono, _)| mono_is_one(mono));
        let constant = constant.map_or_else(Int::zero, |(_, value)| value.clone());
        let rest = multiple.num.sub(&Poly::constant(constant.clone()));
        let content = match rest.leading_is_negative() {
            true => -rest.content(),
            false => rest.content(),
        };
        let small = |k: &Int| k.as_i64().filter(|k| k.abs() <= MOST_POWER);
        let (Some(_), Some(times)) = (small(&constant), small(&content)) else {
            return Ok(self.opaque_power(base, exponent));
        };
        let rest = self.div(&Element::from_poly(rest.div_int(&content)), &parts)?;
        let power = match base.as_number().map(root_of_number) {
            Some((root, k)) => {
                let power = self.opaque_power(self.number(&root), rest);
                self.pow(&power, times * k)?
            }
            None => {
                let power = self.opaque_power(base.clone(), rest);
                self.pow(&power, times)?
            }
        };
        let constant = Rational::new(constant, Int::from(self.exponent_parts));
        let apart = self.rational_power(base, &constant)?;
        self.mul(&power, &apart)
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
                    let sin = self.call(Function::Sin, argument.clone())?;
                    let cos = self.call(Function::Cos, argument)?;
                    return self.div(&sin, &cos);
                }
                self.call(function, argument)
            }
            Function::Abs => {
                let x = self.read(argument, depth)?;
                match argument.node() {
                    // |f g| = |f| |g|: factors that are written need not be found again.
                    Node::Product(factors) if self.sign_of(&x).is_none() => {
                        let mut total = self.integer(1);
                        for factor in factors {
                            let size = self.read_call(function, factor, depth)?;
                            total = self.mul(&total, &size)?;
                        }
                        Ok(total)
                    }
                    _ => self.abs(&x),
                }
            }
            _ => {
                let argument = self.read(argument, depth)?;
                self.call(function, argument)
            }
        }
    }

    /// The name, when the element is a bare symbol.
    pub(crate) fn as_symbol(&self, x: &Element) -> Option<Symbol> {
        match &self.gens[self.as_generator(x)?].kind {
            Kind::Symbol(name) => Some(name.clone()),
            _ => None,
        }
    }

    /// The variable, when the element is a bare generator.
    pub(super) fn as_generator(&self, x: &Element) -> Option<usize> {
        if !x.den.is_one() || x.num.len() != 1 || !x.num.coeff(0).is_one() {
            return None;
        }
        match x.num.variables().as_slice() {
            [v] if exponent(x.num.mono(0), *v) == 1 => Some(*v),
            _ => None,
        }
    }

    pub(super) fn is_symbol(&self, x: &Element, name: &Symbol) -> bool {
        self.as_symbol(x).is_some_and(|s| s == *name)
    }
}

/// A product of numbers and powers of generators, `coeff · above / below`, in lowest terms.
struct Term {
    coeff: Rational,
    above: Mono,
    below: Mono,
}

impl Term {
    fn element(self) -> Element {
        let (numer, int) = self.coeff.into_raw();
        let mono = self.below;
        let den = Den {
            mono,
            ..Den::of(int)
        };
        Element::new(Poly::term(&self.above, numer), den)
    }
}

/// The sum of terms without denominators but numbers.
fn sum(mut terms: Vec<Term>) -> Element {
    terms.sort_unstable_by(|a, b| cmp_mono(&b.above, &a.above));
    terms.dedup_by(|next, kept| {
        let same = cmp_mono(&next.above, &kept.above).is_eq();
        if same {
            kept.coeff += &next.coeff;
        }
        same
    });
    terms.retain(|term| !term.coeff.is_zero());
    let denominators = terms.iter().map(|term| term.coeff.denom());
    let int = denominators.fold(Int::one(), |all, d| all.lcm(d));
    let whole = |term: Term| {
        let coeff = term.coeff.numer() * &(&int / term.coeff.denom());
        (term.above, coeff)
    };
    let num = Poly::from_terms(terms.into_iter().map(whole).collect());
    Element::new(num, Den::of(int))
}

fn is_high_power(e: &Expr) -> bool {
    match e.node() {
        Node::Power(_, k) => whole(k).is_some_and(|k| k.abs() > MOST_POWER),
        _ => false,
    }
}

fn whole(exponent: &Expr) -> Option<i64> {
    let k = exponent.as_number().filter(|k| k.is_integer())?;
    k.numer().as_i64().filter(|k| k.abs() < 1 << 40)
}

/// A positive number as a power of one that is at least 1 and no power itself: 1/4 is 2⁻².
fn root_of_number(value: Rational) -> (Rational, i64) {
    let (mut root, mut times) = match value < Rational::one() {
        true => (value.recip(), -1),
        false => (value, 1),
    };
    for k in [2, 3, 5, 7] {
        while let Some(next) = exact_root(&root, k).filter(|next| *next != root) {
            root = next;
            times *= i64::from(k);
        }
    }
    (root, times)
}

/// The k-th root, where it is a fraction.
fn exact_root(value: &Rational, k: u32) -> Option<Rational> {
    let of = |n: &Int| {
        let root = Int::from(n.to_bigint().nth_root(k));
        (root.pow(k) == *n).then_some(root)
    };
    Some(Rational::new_raw(of(value.numer())?, of(value.denom())?))
}
