//! Signs of polynomials by writing every variable as a positive one in the place of its interval.

use super::field::Field;
use super::field::Kind;
use super::mono::{exponent, mono_of};
use super::poly::Poly;
use super::sign::Interval;
use super::{Sign, Stop};
use crate::expr::number::{self, to_f64};
use crate::expr::{Int, Rational, ratio};
use num_traits::{One, Signed, Zero};

/// Largest polynomial whose variables are replaced by positive ones.
pub(crate) const MOST_TERMS: usize = 400;

impl Field {
    /// Writes variables of unknown sign as positive ones, then looks at the coefficients.
    pub(crate) fn by_substitution(&self, p: &Poly) -> Option<Sign> {
        let mut p = p.clone();
        let (mut weak, mut closed) = (Vec::new(), Vec::new());
        for (index, base) in self.bases.iter().enumerate() {
            if !p.has(base.cos) && !p.has(base.sin) {
                continue;
            }
            let Some(mut range) = self.in_turns(index) else {
                continue;
            };
            // Even in the base angle together: go to the double angle, where more ends are fractions of π with rational tangents.
            while let Some(doubled) = self.double_angle(&p, base.cos, base.sin) {
                let two = ratio(2, 1);
                let next = Interval {
                    low: range.low.as_ref().map(|(v, o)| (v * &two, *o)),
                    high: range.high.as_ref().map(|(v, o)| (v * &two, *o)),
                };
                if ![&next.low, &next.high]
                    .iter()
                    .all(|e| e.as_ref().is_some_and(|(v, _)| v.abs() <= ratio(1, 1)))
                {
                    break;
                }
                p = doubled;
                range = next;
                if !p.has(base.cos) && !p.has(base.sin) {
                    break;
                }
            }
            let tangent = Interval {
                low: half_tangent(range.low.as_ref()?, false)?,
                high: half_tangent(range.high.as_ref()?, true)?,
            };
            let t = base.cos;
            p = half_angle(&p, base.cos, base.sin).ok()?;
            p = replace(&p, t, &tangent, &mut weak, &mut closed)?;
        }
        for v in p.variables() {
            if let Kind::Symbol(name) = &self.gens[v].kind {
                let range = self.interval(name);
                let plain =
                    range.high.is_none() && range.low.as_ref().is_some_and(|(l, _)| l.is_zero());
                if plain || (range.low.is_none() && range.high.is_none()) {
                    continue;
                }
                p = replace(&p, v, &range, &mut weak, &mut closed)?;
            }
            if p.len() > MOST_TERMS {
                return None;
            }
        }
        self.by_coefficients(&p, &weak, &closed)
    }

    /// Rewrites a polynomial of even degree in (cos β, sin β), s reduced, through C = cos 2β and S = sin 2β in the same
    /// variables, up to a positive factor.
    pub(crate) fn double_angle(&self, p: &Poly, c: usize, s: usize) -> Option<Poly> {
        if p.degree(s) > 1
            || p.terms()
                .any(|(m, _)| (exponent(m, c) + exponent(m, s)) % 2 == 1)
        {
            return None;
        }
        let one_plus = Poly::one().add(&Poly::var(c));
        let highest = p
            .terms()
            .map(|(m, _)| (exponent(m, c) + exponent(m, s)) / 2)
            .max()?;
        let by_sine = p.by_power(s);
        let mut total = Poly::zero();
        for (j, part) in by_sine.iter().enumerate() {
            for (i, q) in part
                .by_power(c)
                .iter()
                .enumerate()
                .filter(|(_, q)| !q.is_zero())
            {
                // c^(2k) = ((1+C)/2)^k and s c^(2k+1) = (S/2)((1+C)/2)^k.
                let k = (i - j) as u32 / 2;
                let mut term = q.mul(&one_plus.pow(k).ok()?).ok()?;
                if j == 1 {
                    term = term.mul(&Poly::var(s)).ok()?;
                }
                total = total.add(&term.scale(&Int::from(2).pow(highest - k - j as u32)));
            }
        }
        Some(total)
    }
}

/// tan of half the end (given in units of π), from outside; `Some(None)` is infinite.
#[allow(clippy::type_complexity)]
fn half_tangent(end: &(Rational, bool), up: bool) -> Option<Option<(Rational, bool)>> {
    let (turns, open) = end;
    let one = Rational::one();
    if turns.abs() > one {
        return None;
    }
    if turns.abs() == one {
        // π at the upper end, −π at the lower: the tangent covers everything on that side.
        return (turns.is_positive() == up).then_some(None);
    }
    if turns.is_zero() {
        return Some(Some((Rational::zero(), *open)));
    }
    if turns.abs() == ratio(1, 2) {
        return Some(Some((turns.signum(), *open)));
    }
    let value = (to_f64(turns) * std::f64::consts::FRAC_PI_2).tan();
    let outside = if up {
        value + 1e-9 * (1.0 + value.abs())
    } else {
        value - 1e-9 * (1.0 + value.abs())
    };
    let scaled = outside * f64::from(1u32 << 24);
    let scaled = if up { scaled.ceil() } else { scaled.floor() };
    let numerator = number::from_f64(scaled)?;
    Some(Some((numerator / ratio(1 << 24, 1), true)))
}

/// cos β = (1−t²)/(1+t²), sin β = 2t/(1+t²), times the positive power of 1+t²; t takes the place of the cosine.
fn half_angle(p: &Poly, c: usize, s: usize) -> Result<Poly, Stop> {
    let d = p
        .terms()
        .map(|(m, _)| exponent(m, c) + exponent(m, s))
        .max()
        .unwrap_or(0);
    let square = Poly::term(&mono_of(c, 2), Int::one());
    let (plus, minus) = (Poly::one().add(&square), Poly::one().sub(&square));
    let twice = Poly::var(c).scale(&Int::from(2));
    let mut total = Poly::zero();
    for (j, part) in p.by_power(s).iter().enumerate() {
        for (i, q) in part
            .by_power(c)
            .iter()
            .enumerate()
            .filter(|(_, q)| !q.is_zero())
        {
            let (i, j) = (i as u32, j as u32);
            let shape = minus
                .pow(i)?
                .mul(&twice.pow(j)?)?
                .mul(&plus.pow(d - i - j)?)?;
            total = total.add(&q.mul(&shape)?);
        }
    }
    Ok(total)
}

/// Writes v, which ranges over an interval, as a positive variable in the same place, up to a positive factor.
fn replace(
    p: &Poly,
    v: usize,
    range: &Interval,
    weak: &mut Vec<(usize, bool)>,
    closed: &mut Vec<usize>,
) -> Option<Poly> {
    let scale = |value: &Rational, d: &Int| value.numer() * &(d / value.denom());
    let linear = |a: Int, b: Int| Poly::constant(a).add(&Poly::var(v).scale(&b));
    let (above, below) = match (&range.low, &range.high) {
        (Some((low, open)), Some((high, high_open))) => {
            let d = num_integer::Integer::lcm(low.denom(), high.denom());
            weak.push((v, !open));
            if !high_open {
                closed.push(v);
            }
            (
                linear(scale(low, &d), scale(high, &d)),
                linear(d.clone(), d),
            )
        }
        (Some((low, open)), None) => {
            let d = low.denom().clone();
            weak.push((v, !open));
            (linear(scale(low, &d), d.clone()), Poly::constant(d))
        }
        (None, Some((high, open))) => {
            let d = high.denom().clone();
            weak.push((v, !open));
            (linear(scale(high, &d), -d.clone()), Poly::constant(d))
        }
        (None, None) => return Some(p.clone()),
    };
    let parts = p.by_power(v);
    let d = parts.len() as u32 - 1;
    let mut total = Poly::zero();
    for (k, part) in parts.iter().enumerate().filter(|(_, q)| !q.is_zero()) {
        let k = k as u32;
        total = total.add(
            &part
                .mul(&above.pow(k).ok()?)
                .ok()?
                .mul(&below.pow(d - k).ok()?)
                .ok()?,
        );
    }
    Some(total)
}
