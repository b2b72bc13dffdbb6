//! Functions of normal forms: logarithms and exponentials by their laws, the others as generators.

use num_traits::One;

use super::Stop;
use super::element::Element;
use super::field::{Field, Generator, Kind};
use super::poly::Poly;
use crate::expr::{Function, Int, Rational, Symbol, ratio};

impl Field {
    /// An opaque function: equal arguments give the same generator, and odd and even ones pull the sign out.
    pub(super) fn call(&mut self, function: Function, argument: Element) -> Result<Element, Stop> {
        use Function::{Acos, Asin, Atan, Cos, Cosh, Exp, Ln};
        if argument.num.is_zero() {
            match function {
                odd if odd.is_odd() => return Ok(Element::zero()),
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
        let odd = function.is_odd();
        let even = matches!(function, Cos | Cosh);
        let flip = (odd || even) && argument.num.leading_is_negative();
        let argument = if flip { self.neg(&argument) } else { argument };
        let exact = match function {
            Asin | Atan => self.exact_angle(function, &argument)?,
            _ => None,
        };
        let value = match exact {
            Some(value) => value,
            None => self.opaque(function, argument),
        };
        Ok(if flip && odd { self.neg(&value) } else { value })
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
            let (ln, k) = match self.as_generator(&f).map(|v| self.gens[v].clone()) {
                // ln √p is half of ln p.
                Some(Generator {
                    kind: Kind::Root,
                    relation: Some((n, value)),
                }) => {
                    let ln = self.opaque(Function::Ln, Element::from_poly(value));
                    (ln, ratio(k, i64::from(n)))
                }
                // ln eˣ is x.
                Some(Generator {
                    kind: Kind::Call(Function::Exp, x),
                    ..
                }) => (x, ratio(k, 1)),
                _ => (self.opaque(Function::Ln, f), ratio(k, 1)),
            };
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
            let times = |kind: &Kind| {
                let Kind::Call(Function::Exp, y) = kind else {
                    return None;
                };
                let times = self.div(&term, y).ok()?.as_number()? * &factor;
                times.numer().as_i64().filter(|_| times.is_integer())
            };
            let mut all = self.gens.iter().enumerate();
            let known = all.find_map(|(v, g)| Some((v, times(&g.kind)?)));
            let (v, k) = match known {
                Some(found) => found,
                None => {
                    let part = Rational::new(Int::one(), factor.denom().clone());
                    let own = self.mul(&term, &self.number(&part))?;
                    let v = self.adjoin(Kind::Call(Function::Exp, own));
                    let k = factor.numer().as_i64();
                    (v, k.ok_or(Stop::TooLarge("degree"))?)
                }
            };
            total = self.mul(&total, &self.pow(&Element::var(v), k)?)?;
        }
        Ok(total)
    }

    pub(super) fn opaque(&mut self, function: Function, argument: Element) -> Element {
        let known = self.generator_that(|kind| match kind {
            Kind::Call(f, x) => *f == function && self.equal(x, &argument),
            _ => false,
        });
        Element::var(known.unwrap_or_else(|| self.adjoin(Kind::Call(function, argument))))
    }
}
