//! Values at fixed points of the domain: what signs are seen there. Nothing is proved by them.

use super::element::Element;
use super::field::Field;
use super::field::{AngleOf, Kind};
use super::mono::powers;
use super::poly::Poly;
use super::prime::{PLAIN, prime, random, seed};
use crate::expr::number::to_f64;
use crate::expr::{Int, Rational, Symbol};
use num_traits::One;

/// Points at which an unproved sign is looked at. Enough that a sign change over a tenth of the domain is hardly missed;
/// what is missed still stands in the list of assumptions.
const SAMPLES: usize = 80;
/// How many of them are near a corner of the domain: what is linear in each symbol changes sign there if anywhere.
const CORNERS: usize = 32;

/// Coefficients in doubles, with their monomials.
fn in_doubles(p: &Poly) -> Vec<(f64, &[u64])> {
    let coefficient = |k: &Int| to_f64(&Rational::from(k.clone()));
    p.terms().map(|(mono, k)| (coefficient(k), mono)).collect()
}

impl Field {
    /// Signs seen at the sample points: (somewhere positive, somewhere negative).
    pub(crate) fn seen_signs(&self, p: &Poly) -> (bool, bool) {
        self.ensure_samples();
        let (mut plus, mut minus) = (false, false);
        let terms = in_doubles(p);
        for k in (0..self.sample_count()).filter(|k| self.keeps_what_is_supposed(*k)) {
            if let Some(value) = self.sample_terms(&terms, k) {
                plus |= value > 0.0;
                minus |= value < 0.0;
            }
            if plus && minus {
                break;
            }
        }
        (plus, minus)
    }

    /// More points are drawn where what is supposed leaves only some.
    fn sample_count(&self) -> usize {
        match self.supposed.len() {
            0 => SAMPLES,
            _ => 8 * SAMPLES,
        }
    }

    fn keeps_what_is_supposed(&self, k: usize) -> bool {
        let mut supposed = self.supposed.iter();
        supposed.all(|(p, _)| self.sample(p, k).is_none_or(|value| value >= 0.0))
    }

    /// Value at a sample point; 0 where rounding leaves the sign open, `None` where a generator has no value.
    fn sample(&self, p: &Poly, k: usize) -> Option<f64> {
        self.sample_terms(&in_doubles(p), k)
    }

    fn sample_terms(&self, terms: &[(f64, &[u64])], k: usize) -> Option<f64> {
        let samples = self.samples.borrow();
        let (mut total, mut size) = (0.0, 0.0);
        for (coeff, mono) in terms {
            let mut value = *coeff;
            for (v, power) in powers(mono) {
                value *= samples[v][k].powi(power as i32);
            }
            total += value;
            size += f64::abs(value);
        }
        if !size.is_finite() {
            return None;
        }
        let known = f64::abs(total) > 1e-9 * size;
        Some(if known { total } else { 0.0 })
    }

    fn sample_element(&self, x: &Element, k: usize) -> Option<f64> {
        let mut value = self.sample(&x.num, k)? / to_f64(&Rational::from(x.den.int.clone()));
        value /= self.sample(&Poly::term(&x.den.mono, Int::one()), k)?;
        for (f, e) in &x.den.factors {
            value /= self.sample(f, k)?.powi(*e as i32);
        }
        Some(value)
    }

    fn ensure_samples(&self) {
        let known = self.samples.borrow().len();
        for v in known..self.gens.len() {
            let column: Vec<f64> = (0..self.sample_count())
                .map(|k| self.sample_generator(v, k).unwrap_or(f64::NAN))
                .collect();
            self.samples.borrow_mut().push(column);
        }
    }

    /// The ends of a symbol's domain in doubles: an enclosure of π would lead out of it.
    fn ends(&self, name: &Symbol) -> [Option<f64>; 2] {
        if let Some(domain) = self.domains.symbols.get(name) {
            return domain.bounds();
        }
        let range = self.interval(name);
        [range.low, range.high].map(|end| end.map(|(value, _)| to_f64(&value)))
    }

    fn sample_generator(&self, v: usize, k: usize) -> Option<f64> {
        let value = match &self.gens[v].kind {
            Kind::Symbol(name) if &**name == "pi" => std::f64::consts::PI,
            Kind::Symbol(name) => match &self.gens[v].relation {
                Some((_, value)) => {
                    let size = self.sample(value, k)?.max(0.0).sqrt();
                    let [low, high] = self.ends(name);
                    let positive = low.is_some_and(|l| l >= 0.0);
                    let negative = high.is_some_and(|h| h <= 0.0);
                    match positive || (!negative && k.is_multiple_of(2)) {
                        true => size,
                        false => -size,
                    }
                }
                None => pick(self.ends(name), fraction(name, k)),
            },
            Kind::Cos(base) | Kind::Sin(base) => {
                let base = &self.bases[*base];
                let angle = match &base.of {
                    AngleOf::Symbol(name) => match self.domains.symbols.get(name) {
                        None => fraction(name, k) * std::f64::consts::FRAC_PI_2,
                        Some(_) => pick(self.ends(name), fraction(name, k)),
                    },
                    AngleOf::Term(term) => self.sample_element(term, k)?,
                } * to_f64(&base.part);
                match self.gens[v].kind {
                    Kind::Cos(_) => angle.cos(),
                    _ => angle.sin(),
                }
            }
            Kind::Root => {
                let (degree, value) = self.gens[v].relation.as_ref()?;
                let value = self.sample(value, k)?;
                match degree {
                    2 => value.sqrt(),
                    n => value.signum() * value.abs().powf(1.0 / f64::from(*n)),
                }
            }
            Kind::Abs(p) => self.sample(p, k)?.abs(),
            Kind::Call(function, x) => {
                crate::expr::Scalar::call(&self.sample_element(x, k)?, *function)?
            }
            Kind::Power(base, exponent) => self
                .sample_element(base, k)?
                .powf(self.sample_element(exponent, k)?),
        };
        Some(value)
    }
}

/// A number in (0, 1), fixed by name and index: near the ends first, then well spread.
fn fraction(name: &str, k: usize) -> f64 {
    const NEAR: f64 = 1e-6;
    let z = random::<PLAIN>(seed(name), k as u64);
    match (k, z & 1) {
        (0, _) => NEAR,
        (1, _) => 1.0 - NEAR,
        (2..CORNERS, 0) => NEAR,
        (2..CORNERS, _) => 1.0 - NEAR,
        _ => z as f64 / prime::<PLAIN>() as f64 * 0.998 + 0.001,
    }
}

fn pick(ends: [Option<f64>; 2], u: f64) -> f64 {
    let wide = (14.0 * u - 7.0).exp();
    match ends {
        [Some(low), Some(high)] => low + (high - low) * u,
        [Some(low), None] => low + wide,
        [None, Some(high)] => high - wide,
        [None, None] => {
            let x = 2.0 * u - 1.0;
            4.0 * x / (1.02 - x.abs())
        }
    }
}
