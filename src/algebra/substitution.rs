//! Signs of polynomials by writing every variable as a positive one in the place of its interval.
//!
//! In one variable, halving the interval until the coefficients tell isolates the zeros (Vincent, Collins and Akritas):
//! where the steps suffice, a sign is proved or a change of sign found. In several variables the same halving encloses.

use super::field::Field;
use super::field::Kind;
use super::mono::{exponent, mono_of};
use super::poly::Poly;
use super::range::{End, Found, Interval};
use super::{Sign, Stop};
use crate::expr::number::{self, to_f64};
use crate::expr::{Int, Rational, ratio};
use num_traits::{One, Signed, Zero};

/// Largest polynomial whose variables are replaced by positive ones.
pub(crate) const MOST_TERMS: usize = 400;

/// A variable with the interval it ranges over.
#[derive(Clone, Debug)]
struct Axis {
    v: usize,
    low: Option<(Rational, bool)>,
    high: Option<(Rational, bool)>,
    /// Where an infinite end belongs to the interval: the degree of the terms that count there.
    at_infinity: Option<u32>,
}

/// Work for one sign: parts of the domain, times terms, times degrees.
const WORK: usize = 30_000;
/// Most parts of a domain, for one variable, two, or more.
const MOST_PARTS: [usize; 3] = [160, 48, 24];

impl Field {
    /// Writes variables of unknown sign as positive ones, then looks at the coefficients; where they are of both signs, the
    /// domain is halved as far as a count of parts allows.
    pub(crate) fn by_substitution(&self, p: &Poly) -> Found {
        if let Some(found) = self.halved.borrow().get(p) {
            return *found;
        }
        let found = self.on_domain(p);
        self.halved.borrow_mut().insert(p.clone(), found);
        found
    }

    fn on_domain(&self, p: &Poly) -> Found {
        let Some((p, axes)) = self.axes(p, &[]) else {
            return Found::Unknown;
        };
        let all = p.variables();
        let are_bounded = all.iter().all(|v| axes.iter().any(|a| a.v == *v));
        // In one variable a change of sign is proved rather than seen.
        if are_bounded && all.len() > 1 && changes_sign(&p, &axes) {
            return Found::Unknown;
        }
        let first = self.on_box(&p, &axes);
        // Halving helps only where every variable ranges over an interval.
        if first != Found::Unknown || !are_bounded || changes_sign(&p, &axes) {
            return first;
        }
        let degree: u32 = all.iter().map(|v| p.degree(*v)).sum();
        let most = MOST_PARTS[all.len().saturating_sub(1).min(2)];
        let mut left = (WORK / (p.len() * (1 + degree as usize))).clamp(2, most);
        let mut total: Option<Sign> = None;
        let mut open = vec![(axes, 0)];
        while let Some((part, depth)) = open.pop() {
            let sign = match self.on_box(&p, &part) {
                Found::Proved(sign) => sign,
                Found::Mixed => return Found::Mixed,
                Found::Unknown => {
                    let Some(rest) = left.checked_sub(1) else {
                        return Found::Unknown;
                    };
                    left = rest;
                    let at = depth % part.len();
                    open.extend(part[at].halves().map(|half| {
                        let mut part = part.clone();
                        part[at] = half;
                        (part, depth + 1)
                    }));
                    continue;
                }
            };
            total = Some(match total {
                None => sign,
                Some(known) if known == sign => sign,
                Some(known) if known.is_not_negative() != sign.is_not_negative() => {
                    return Found::Mixed;
                }
                Some(known) => Sign::made(known.is_not_negative(), false),
            });
        }
        total.map_or(Found::Unknown, Found::Proved)
    }

    /// The polynomial with half tangents for angles, up to a positive factor, and the intervals of its variables. Those of
    /// `excesses` stand for something positive, or not negative where the flag tells.
    fn axes(&self, p: &Poly, excesses: &[(usize, bool)]) -> Option<(Poly, Vec<Axis>)> {
        let mut p = p.clone();
        let mut axes = Vec::new();
        for (index, base) in self.bases.iter().enumerate() {
            if !p.has(base.cos) && !p.has(base.sin) {
                continue;
            }
            let Some(mut range) = self.in_turns(index) else {
                continue;
            };
            // Even in the base angle together: go to the double angle, where more ends are fractions of π with rational tangents.
            while let Some(doubled) = self.double_angle(&p, base.cos, base.sin) {
                let twice = |end: &(Rational, bool)| (&end.0 * ratio(2, 1), end.1);
                let [low, high] = [&range.low, &range.high].map(|end| end.as_ref().map(twice));
                let fits = |end: &&Option<(Rational, bool)>| {
                    end.as_ref().is_some_and(|(v, _)| v.abs() <= ratio(1, 1))
                };
                if ![&low, &high].iter().all(fits) {
                    break;
                }
                p = doubled;
                range = Interval { low, high };
                if !p.has(base.cos) && !p.has(base.sin) {
                    break;
                }
            }
            if !p.has(base.cos) && !p.has(base.sin) {
                continue;
            }
            let (low, high) = (range.low.as_ref()?, range.high.as_ref()?);
            let (from, to) = (half_tangent(low, false)?, half_tangent(high, true)?);
            let closed = (from.is_none() && !low.1) || (to.is_none() && !high.1);
            let (tangents, degree) = half_angle(&p, base.cos, base.sin).ok()?;
            p = tangents;
            axes.push(Axis {
                v: base.cos,
                low: from,
                high: to,
                at_infinity: closed.then_some(2 * degree),
            });
        }
        for v in p.variables() {
            if let Kind::Symbol(name) = &self.gens[v].kind {
                let excess = excesses.iter().find(|(e, _)| *e == v);
                let range = match excess {
                    Some((_, closed)) => Interval::above_zero(!closed),
                    None => self.interval(name),
                };
                axes.push(Axis {
                    v,
                    low: range.low,
                    high: range.high,
                    at_infinity: None,
                });
            }
        }
        (p.len() <= MOST_TERMS).then_some((p, axes))
    }

    /// The sign where the variables of `excesses` are positive (or not negative) and the others lie in their intervals, as far
    /// as the coefficients tell.
    pub(crate) fn with_excesses(&self, p: &Poly, excesses: &[(usize, bool)]) -> Option<Sign> {
        let (p, axes) = self.axes(p, excesses)?;
        match self.on_box(&p, &axes) {
            Found::Proved(sign) => Some(sign),
            _ => None,
        }
    }

    /// The sign on one part of the domain, from the coefficients alone.
    fn on_box(&self, p: &Poly, axes: &[Axis]) -> Found {
        let mut ends = Vec::with_capacity(axes.len());
        let mut p = std::borrow::Cow::Borrowed(p);
        for axis in axes {
            if axis.low.is_none() && axis.high.is_none() {
                match self.gens[axis.v].kind {
                    Kind::Symbol(_) => continue,
                    // Half tangents are of both signs, whatever the cosine in whose place they stand.
                    _ => return Found::Unknown,
                }
            }
            let Some((replaced, end)) = axis.replaced(&p) else {
                return Found::Unknown;
            };
            p = std::borrow::Cow::Owned(replaced);
            ends.push(end);
            if p.len() > MOST_TERMS {
                return Found::Unknown;
            }
        }
        if let Some(sign) = self.by_coefficients(&p, &ends) {
            return Found::Proved(sign);
        }
        // One change of sign among the coefficients is one simple zero (Descartes).
        match (p.variables().as_slice(), ends.as_slice()) {
            ([v], [end]) if *v == end.v => {
                let signs = p.terms().map(|(_, k)| k.is_negative());
                let signs: Vec<bool> = signs.collect();
                match signs.windows(2).filter(|w| w[0] != w[1]).count() {
                    1 => Found::Mixed,
                    _ => Found::Unknown,
                }
            }
            _ => Found::Unknown,
        }
    }

    /// Rewrites a polynomial of even degree in (cos β, sin β), s reduced, through C = cos 2β and S = sin 2β in the same
    /// variables, up to a positive factor.
    pub(crate) fn double_angle(&self, p: &Poly, c: usize, s: usize) -> Option<Poly> {
        let degrees = || p.terms().map(|(m, _)| exponent(m, c) + exponent(m, s));
        if p.degree(s) > 1 || degrees().any(|d| d % 2 == 1) {
            return None;
        }
        let one_plus = Poly::one().add(&Poly::var(c));
        let highest = degrees().max()? / 2;
        let by_sine = p.by_power(s);
        let mut total = Poly::zero();
        for (j, part) in by_sine.iter().enumerate() {
            let parts = part.by_power(c);
            for (i, q) in parts.iter().enumerate().filter(|(_, q)| !q.is_zero()) {
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
    let margin = 1e-9 * (1.0 + value.abs());
    let size = f64::from(1u32 << 24);
    let scaled = match up {
        true => ((value + margin) * size).ceil(),
        false => ((value - margin) * size).floor(),
    };
    let numerator = number::from_f64(scaled)?;
    Some(Some((numerator / ratio(1 << 24, 1), true)))
}

/// cos β = (1−t²)/(1+t²), sin β = 2t/(1+t²), times the power of 1+t² that is told; t takes the place of the cosine.
fn half_angle(p: &Poly, c: usize, s: usize) -> Result<(Poly, u32), Stop> {
    let degrees = p.terms().map(|(m, _)| exponent(m, c) + exponent(m, s));
    let d = degrees.max().unwrap_or(0);
    let square = Poly::term(&mono_of(c, 2), Int::one());
    let (plus, minus) = (Poly::one().add(&square), Poly::one().sub(&square));
    let twice = Poly::var(c).scale(&Int::from(2));
    let mut total = Poly::zero();
    for (j, part) in p.by_power(s).iter().enumerate() {
        let parts = part.by_power(c);
        for (i, q) in parts.iter().enumerate().filter(|(_, q)| !q.is_zero()) {
            let (i, j) = (i as u32, j as u32);
            let shape = minus.pow(i)?.mul(&twice.pow(j)?)?;
            let shape = shape.mul(&plus.pow(d - i - j)?)?;
            total = total.add(&q.mul(&shape)?);
        }
    }
    Ok((total, d))
}

/// The polynomial with above/below in the place of v, times the power of `below` that clears it; `None` where it grows too long.
pub(crate) fn replaced(p: &Poly, v: usize, above: &Poly, below: &Poly) -> Option<Poly> {
    let degree = p.degree(v);
    let mut total = Poly::zero();
    for (k, part) in p.by_power(v).iter().enumerate() {
        if !part.is_zero() {
            // What stands for the power is short, and multiplied out first.
            let k = k as u32;
            let power = above.pow(k).ok()?.mul(&below.pow(degree - k).ok()?);
            total = total.add(&part.mul(&power.ok()?).ok()?);
        }
        if total.len() > MOST_TERMS {
            return None;
        }
    }
    Some(total)
}

impl Axis {
    /// The polynomial with the variable written as a positive one in the same place, up to a positive factor, and what that
    /// one may also be.
    fn replaced(&self, p: &Poly) -> Option<(Poly, End)> {
        let v = self.v;
        let degree = p.degree(v);
        let scale = |value: &Rational, d: &Int| value.numer() * &(d / value.denom());
        let linear = |a: Int, b: Int| Poly::constant(a).add(&Poly::var(v).scale(&b));
        let (above, below, open, infinite) = match (&self.low, &self.high) {
            (Some((low, open)), None) if low.is_zero() => {
                let end = End {
                    v,
                    zero: !open,
                    infinite: self.at_infinity,
                };
                return Some((p.clone(), end));
            }
            (Some((low, open)), Some((high, high_open))) => {
                let d = num_integer::Integer::lcm(low.denom(), high.denom());
                let above = linear(scale(low, &d), scale(high, &d));
                let infinite = (!high_open).then_some(degree);
                (above, linear(d.clone(), d), open, infinite)
            }
            (Some((low, open)), None) => {
                let d = low.denom().clone();
                let above = linear(scale(low, &d), d.clone());
                (above, Poly::constant(d), open, self.at_infinity)
            }
            (None, Some((high, open))) => {
                let d = high.denom().clone();
                let above = linear(scale(high, &d), -d.clone());
                (above, Poly::constant(d), open, self.at_infinity)
            }
            (None, None) => return None,
        };
        let total = replaced(p, v, &above, &below)?;
        let end = End {
            v,
            zero: !open,
            infinite,
        };
        Some((total, end))
    }

    /// The interval in two; where they meet belongs to both.
    fn halves(&self) -> [Axis; 2] {
        let one = Rational::one();
        let middle = match (&self.low, &self.high) {
            (Some((low, _)), Some((high, _))) => (low + high) * ratio(1, 2),
            (Some((low, _)), None) => low + low.abs().max(one),
            (None, Some((high, _))) => high - high.abs().max(one),
            (None, None) => Rational::zero(),
        };
        let end = Some((middle, false));
        let lower = Axis {
            high: end.clone(),
            at_infinity: self.at_infinity.filter(|_| self.low.is_none()),
            ..self.clone()
        };
        let upper = Axis {
            low: end,
            at_infinity: self.at_infinity.filter(|_| self.high.is_none()),
            ..self.clone()
        };
        [lower, upper]
    }

    /// A number inside, for a share of the whole.
    fn at(&self, share: f64) -> f64 {
        let far = (1.0 / (1.0 - share) - 1.0).powi(2);
        match (&self.low, &self.high) {
            (Some((low, _)), Some((high, _))) => to_f64(low) + (to_f64(high) - to_f64(low)) * share,
            (Some((low, _)), None) => to_f64(low) + far,
            (None, Some((high, _))) => to_f64(high) - far,
            (None, None) => far - 1.0 / (far + 1e-9).sqrt(),
        }
    }
}

/// Points at which a change of sign is looked for before a proof of none.
const LOOKS: usize = 12;

/// Whether doubles see both signs, so that no proof of one is worth trying.
fn changes_sign(p: &Poly, axes: &[Axis]) -> bool {
    let (mut plus, mut minus) = (false, false);
    let coefficient = |k: &Int| to_f64(&Rational::from(k.clone()));
    let terms: Vec<_> = p.terms().map(|(mono, k)| (mono, coefficient(k))).collect();
    for k in 0..LOOKS {
        let (mut total, mut size) = (0.0, 0.0);
        let at: Vec<f64> = (axes.iter().enumerate())
            .map(|(i, axis)| {
                // Multiples of the golden ratio's powers spread well, and differ between the axes.
                let share = 0.618_033_988_749_895_f64.powi(1 + i as i32) * (1 + k) as f64;
                axis.at(0.001 + 0.998 * share.fract())
            })
            .collect();
        for (mono, coefficient) in &terms {
            let mut value = *coefficient;
            for (axis, at) in axes.iter().zip(&at) {
                value *= at.powi(exponent(mono, axis.v) as i32);
            }
            total += value;
            size += value.abs();
        }
        if size.is_finite() && total.abs() > 1e-9 * size {
            plus |= total > 0.0;
            minus |= total < 0.0;
        }
    }
    plus && minus
}
