//! Values at fixed points of the domain: what signs are seen there. Nothing is proved by them.

use super::element::Element;
use super::field::Field;
use super::field::{AngleOf, Kind};
use super::mono::powers;
use super::points::{Held, Points, RELATED, SAMPLES};
use super::poly::Poly;
use super::prime::{PLAIN, prime, random, seed};
use crate::expr::number::to_f64;
use crate::expr::{Int, Rational, Symbol, effort};
use smallvec::SmallVec;

/// How many of them are near a corner of the domain: what is linear in each symbol changes sign there if anywhere.
const CORNERS: usize = 32;

/// The variables of a monomial, with their exponents.
type Powers = SmallVec<[(usize, i32); 4]>;

/// Coefficients in doubles, with their monomials.
fn in_doubles(p: &Poly) -> Vec<(f64, Powers)> {
    let coefficient = |k: &Int| to_f64(&Rational::from(k.clone()));
    let own = |mono| powers(mono).map(|(v, k)| (v, k as i32)).collect();
    p.terms()
        .map(|(mono, k)| (coefficient(k), own(mono)))
        .collect()
}

/// A sum with terms of that size in all; 0 where rounding leaves its sign open, `None` where it has no value.
fn known(total: f64, size: f64) -> Option<f64> {
    let is_known = total.abs() > 1e-9 * size;
    size.is_finite()
        .then_some(if is_known { total } else { 0.0 })
}

impl Field {
    /// Signs seen at the sample points: (somewhere positive, somewhere negative).
    pub(crate) fn seen_signs(&self, p: &Poly) -> (bool, bool) {
        self.ensure_samples();
        let (mut plus, mut minus) = (false, false);
        let terms = in_doubles(p);
        let points = &self.held().points;
        let samples = self.samples.borrow();
        for k in points {
            let (mut total, mut size) = (0.0, 0.0);
            for (coeff, powers) in &terms {
                let factors = powers.iter().map(|(v, e)| samples[*v][*k].powi(*e));
                let value = factors.fold(*coeff, |product, factor| product * factor);
                total += value;
                size += value.abs();
            }
            if let Some(value) = known(total, size) {
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
            _ => RELATED * SAMPLES,
        }
    }

    /// The sample points at which what is supposed holds.
    pub(super) fn held(&self) -> &Held {
        self.held.get_or_init(|| {
            self.ensure_samples();
            let supposed = self.supposed.iter();
            let values: Vec<Vec<Option<f64>>> = supposed.map(|(p, _)| self.values(p)).collect();
            let keeps = |k: &usize| {
                let mut values = values.iter().map(|of| of[*k]);
                values.all(|value| value.is_none_or(|value| value >= 0.0))
            };
            Held {
                points: (0..self.sample_count()).filter(keeps).collect(),
                each: values
                    .iter()
                    .map(|of| Points::that(of, |v| v > 0.0))
                    .collect(),
            }
        })
    }

    /// The sample points at which a polynomial is positive, and those at which it is negative.
    pub(super) fn signs_at_points(&self, p: &Poly) -> [Points; 2] {
        self.ensure_samples();
        let values = self.values(p);
        let [above, below] = [|v: f64| v > 0.0, |v: f64| v < 0.0];
        [Points::that(&values, above), Points::that(&values, below)]
    }

    /// Values at all sample points.
    fn values(&self, p: &Poly) -> Vec<Option<f64>> {
        let count = self.sample_count();
        let samples = self.samples.borrow();
        let (mut totals, mut sizes) = (vec![0.0; count], vec![0.0; count]);
        let mut product = vec![0.0; count];
        effort::take((p.len() * count) as u64);
        for (coeff, powers) in in_doubles(p) {
            product.fill(coeff);
            for (v, k) in powers {
                let factors = product.iter_mut().zip(&samples[v]);
                match k {
                    1 => factors.for_each(|(value, x)| *value *= x),
                    _ => factors.for_each(|(value, x)| *value *= x.powi(k)),
                }
            }
            for ((value, total), size) in product.iter().zip(&mut totals).zip(&mut sizes) {
                *total += value;
                *size += value.abs();
            }
        }
        let sums = totals.into_iter().zip(sizes);
        sums.map(|(total, size)| known(total, size)).collect()
    }

    /// Values of an element at all sample points.
    fn element_values(&self, x: &Element) -> Vec<Option<f64>> {
        let mut values = self.values(&x.num);
        let mono = Poly::term(&x.den.mono, x.den.int.clone());
        let factors = x.den.factors.iter().map(|(f, e)| (f, *e as i32));
        for (below, power) in [(&mono, 1)].into_iter().chain(factors) {
            for (value, below) in values.iter_mut().zip(self.values(below)) {
                *value = value.zip(below).map(|(v, below)| v / below.powi(power));
            }
        }
        values
    }

    fn ensure_samples(&self) {
        let known = self.samples.borrow().len();
        for v in known..self.gens.len() {
            let column = self.generator_values(v).into_iter();
            let column = column.map(|value| value.unwrap_or(f64::NAN)).collect();
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

    /// Values of a generator at all sample points, by those of what it is made of.
    fn generator_values(&self, v: usize) -> Vec<Option<f64>> {
        let all = 0..self.sample_count();
        let each = |values: Vec<Option<f64>>, f: &dyn Fn(f64) -> f64| {
            let values = values.into_iter();
            values.map(|value| value.map(f)).collect()
        };
        let drawn = |name: &Symbol, ends: [Option<f64>; 2]| {
            let (all, seed) = (all.clone(), seed(name));
            all.map(|k| Some(pick(ends, fraction(seed, k)))).collect()
        };
        let relation = self.gens[v].relation.as_ref();
        match &self.gens[v].kind {
            Kind::Symbol(name) if &**name == "pi" => {
                vec![Some(std::f64::consts::PI); all.len()]
            }
            Kind::Symbol(name) => match relation {
                None => drawn(name, self.ends(name)),
                Some((_, value)) => {
                    let [low, high] = self.ends(name);
                    let positive = low.is_some_and(|l| l >= 0.0);
                    let negative = high.is_some_and(|h| h <= 0.0);
                    let values = self.values(value).into_iter().enumerate();
                    let signed = values.map(|(k, value)| {
                        let size = value?.max(0.0).sqrt();
                        let is_above = positive || (!negative && k.is_multiple_of(2));
                        Some(if is_above { size } else { -size })
                    });
                    signed.collect()
                }
            },
            Kind::Cos(base) | Kind::Sin(base) => {
                let base = &self.bases[*base];
                let angles = match &base.of {
                    AngleOf::Symbol(name) if self.domains.symbols.contains_key(name) => {
                        drawn(name, self.ends(name))
                    }
                    AngleOf::Symbol(name) => {
                        drawn(name, [Some(0.0), Some(std::f64::consts::FRAC_PI_2)])
                    }
                    AngleOf::Term(term) => self.element_values(term),
                };
                let part = to_f64(&base.part);
                match self.gens[v].kind {
                    Kind::Cos(_) => each(angles, &|angle| (angle * part).cos()),
                    _ => each(angles, &|angle| (angle * part).sin()),
                }
            }
            Kind::Root => match relation {
                None => vec![None; all.len()],
                Some((2, value)) => each(self.values(value), &f64::sqrt),
                Some((n, value)) => {
                    let n = 1.0 / f64::from(*n);
                    each(self.values(value), &|x| x.signum() * x.abs().powf(n))
                }
            },
            Kind::Abs(p) => each(self.values(p), &f64::abs),
            Kind::Call(function, x) => {
                let values = self.element_values(x).into_iter();
                let call = |x: f64| crate::expr::Scalar::call(&x, *function);
                values.map(|x| x.and_then(call)).collect()
            }
            Kind::Power(base, exponent) => {
                let bases = self.element_values(base).into_iter();
                let both = bases.zip(self.element_values(exponent));
                both.map(|(a, b)| Some(a?.powf(b?))).collect()
            }
        }
    }
}

/// A number in (0, 1), fixed by the seed of a name and by index: near the ends first, then well spread.
fn fraction(seed: u64, k: usize) -> f64 {
    const NEAR: f64 = 1e-6;
    let z = random::<PLAIN>(seed, k as u64);
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
