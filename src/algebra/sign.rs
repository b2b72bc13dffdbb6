//! Signs on the domain: proved by coefficients, or merely seen at sample points.
//!
//! A proof writes every variable as a positive one — an interval through x = (lo + hi·u)/(1 + u), an angle through the
//! tangent of its half — and finds all coefficients of one sign. Ends that are no fractions are enclosed from outside.

use num_traits::{One, Signed, Zero};

use super::element::Element;
use super::factor::factor;
use super::field::{AngleOf, Field, Kind};
use super::poly::{Poly, exponent, mono_of, mono_variables, powers};
use super::{Sign, Stop};
use crate::domain::Limit;
use crate::expr::number::{self, to_f64};
use crate::expr::{Function, Int, Rational, Symbol, ratio};

/// Points at which an unproved sign is looked at. Enough that a sign change over a tenth of the domain is hardly missed;
/// what is missed still stands in the list of assumptions.
const SAMPLES: usize = 48;
/// Largest polynomial whose variables are replaced by positive ones.
const MOST_TERMS: usize = 400;

/// Ends of an interval; `None` is infinite.
#[derive(Clone, Debug)]
struct Interval {
    low: Option<(Rational, bool)>,
    high: Option<(Rational, bool)>,
}

/// What is known of a variable's sign without work.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Known {
    Positive,
    NotNegative,
    Unknown,
}

impl Field {
    /// The sign, where it is proved for the whole domain.
    pub fn sign(&self, x: &Element) -> Option<Sign> {
        self.fuel.refill();
        self.sign_of(x)
    }

    pub(crate) fn sign_of(&self, x: &Element) -> Option<Sign> {
        let mut sign = self.sign_poly(&x.num)?;
        for v in mono_variables(&x.den.mono) {
            if exponent(&x.den.mono, v) % 2 == 1 {
                sign = sign.times(nonzero(self.sign_poly(&Poly::var(v))?));
            }
        }
        for (f, k) in &x.den.factors {
            if k % 2 == 1 {
                sign = sign.times(nonzero(self.sign_poly(f)?));
            }
        }
        Some(sign)
    }

    pub(crate) fn sign_poly(&self, p: &Poly) -> Option<Sign> {
        if p.is_zero() {
            return Some(Sign::Zero);
        }
        if let Some(sign) = self.by_coefficients(p, &[], &[]) {
            return Some(sign);
        }
        if p.len() > MOST_TERMS {
            return None;
        }
        let parts = factor(p, &self.fuel);
        let mut sign = if parts.content.is_negative() {
            Sign::Negative
        } else {
            Sign::Positive
        };
        for v in mono_variables(&parts.mono) {
            sign = sign.times(self.power_sign(&Poly::var(v), exponent(&parts.mono, v))?);
        }
        for (f, k) in &parts.factors {
            sign = sign.times(self.power_sign(f, *k)?);
        }
        Some(sign)
    }

    fn power_sign(&self, p: &Poly, k: u32) -> Option<Sign> {
        match (self.sign_irreducible(p, 3), k % 2) {
            (Some(Sign::Positive | Sign::Negative), 0) => Some(Sign::Positive),
            (_, 0) => Some(Sign::NotNegative),
            (sign, _) => sign,
        }
    }

    fn sign_irreducible(&self, p: &Poly, depth: u32) -> Option<Sign> {
        if let Some(sign) = self.by_coefficients(p, &[], &[]) {
            return Some(sign);
        }
        self.by_substitution(p)
            .or_else(|| {
                if depth == 0 {
                    None
                } else {
                    self.by_conjugate(p, depth)
                }
            })
            .or_else(|| {
                if depth == 0 {
                    None
                } else {
                    self.by_discriminant(p, depth)
                }
            })
    }

    /// A + B√P with A and B of opposite signs has the sign of A² − B²P on A's side.
    fn by_conjugate(&self, p: &Poly, depth: u32) -> Option<Sign> {
        let root = p
            .variables()
            .into_iter()
            .rev()
            .find(|v| matches!(self.gens[*v].kind, Kind::Root))?;
        let (2, radicand) = self.gens[root].relation.as_ref()? else {
            return None;
        };
        let parts = p.by_power(root);
        let [a, b] = parts.as_slice() else {
            return None;
        };
        let (sa, sb) = (self.sign_sub(a, depth)?, self.sign_sub(b, depth)?);
        let definite = |s| matches!(s, Sign::Positive | Sign::Negative);
        if sa.is_not_negative() == sb.is_not_negative() {
            return Some(if definite(sa) {
                sa
            } else if sa.is_not_negative() {
                Sign::NotNegative
            } else {
                Sign::NotPositive
            });
        }
        let norm = self
            .mul_poly(a, a)
            .ok()?
            .sub(&self.mul_poly(&self.mul_poly(b, b).ok()?, radicand).ok()?);
        let sn = self.sign_sub(&norm, depth)?;
        // |A| > |B|√P: A decides; otherwise B does.
        Some(match sn {
            Sign::Positive => {
                if sa.is_not_negative() {
                    Sign::Positive
                } else {
                    Sign::Negative
                }
            }
            Sign::Negative => {
                if sb.is_not_negative() {
                    Sign::Positive
                } else {
                    Sign::Negative
                }
            }
            Sign::NotNegative => {
                if sa.is_not_negative() {
                    Sign::NotNegative
                } else {
                    Sign::NotPositive
                }
            }
            Sign::NotPositive => {
                if sb.is_not_negative() {
                    Sign::NotNegative
                } else {
                    Sign::NotPositive
                }
            }
            Sign::Zero => Sign::Zero,
        })
    }

    fn sign_sub(&self, p: &Poly, depth: u32) -> Option<Sign> {
        if p.is_zero() {
            return Some(Sign::Zero);
        }
        let parts = factor(p, &self.fuel);
        let mut sign = if parts.content.is_negative() {
            Sign::Negative
        } else {
            Sign::Positive
        };
        for v in mono_variables(&parts.mono) {
            sign = sign.times(self.power_sign(&Poly::var(v), exponent(&parts.mono, v))?);
        }
        for (f, k) in &parts.factors {
            sign = sign.times(match (self.sign_irreducible(f, depth - 1), k % 2) {
                (Some(Sign::Positive | Sign::Negative), 0) => Sign::Positive,
                (_, 0) => Sign::NotNegative,
                (sign, _) => sign?,
            });
        }
        Some(sign)
    }

    /// A quadratic without real zeros has the sign of its leading coefficient.
    fn by_discriminant(&self, p: &Poly, depth: u32) -> Option<Sign> {
        let plain = |v: &usize| p.degree(*v) == 2 && self.gens[*v].relation.is_none();
        // Three tries: each may look at discriminants of its own.
        for v in p.variables().into_iter().filter(plain).take(3) {
            let parts = p.by_power(v);
            let [c, b, a] = parts.as_slice() else {
                continue;
            };
            let (Ok(bb), Ok(ac)) = (self.mul_poly(b, b), self.mul_poly(a, c)) else {
                continue;
            };
            let discriminant = bb.sub(&ac.scale(&Int::from(4)));
            if self.sign_sub(&discriminant, depth) == Some(Sign::Negative)
                && let Some(sign @ (Sign::Positive | Sign::Negative)) = self.sign_sub(a, depth)
            {
                return Some(sign);
            }
        }
        None
    }

    /// All terms of one sign. Variables in `weak` may be zero, those in `closed` may be infinite; all other replaced ones
    /// are positive.
    fn by_coefficients(&self, p: &Poly, weak: &[(usize, bool)], closed: &[usize]) -> Option<Sign> {
        let negative = p.leading_is_negative();
        let mut definite = false;
        let degrees = p.degrees();
        let mut at_infinity = closed.is_empty();
        for (mono, coeff) in p.terms() {
            if coeff.is_negative() != negative {
                return None;
            }
            let (mut strict, mut top) = (true, closed.len() == 1);
            for (v, power) in powers(mono) {
                let known = match weak.iter().find(|(w, _)| *w == v) {
                    Some((_, true)) => Known::NotNegative,
                    Some((_, false)) => Known::Positive,
                    None => self.known(v),
                };
                match known {
                    Known::Positive => {}
                    Known::NotNegative => {
                        strict = false;
                        top &= closed.contains(&v);
                    }
                    Known::Unknown if power % 2 == 0 => {
                        strict = false;
                        top = false;
                    }
                    Known::Unknown => return None,
                }
            }
            definite |= strict;
            at_infinity |= top
                && closed
                    .iter()
                    .all(|v| exponent(mono, *v) == exponent(&degrees, *v));
        }
        let sign = if definite && at_infinity {
            Sign::Positive
        } else {
            Sign::NotNegative
        };
        Some(if negative { sign.flip() } else { sign })
    }

    fn known(&self, v: usize) -> Known {
        match &self.gens[v].kind {
            Kind::Symbol(name) => match self.interval(name).low {
                Some((low, true)) if !low.is_negative() => Known::Positive,
                Some((low, false)) if low.is_positive() => Known::Positive,
                Some((low, false)) if low.is_zero() => Known::NotNegative,
                _ => Known::Unknown,
            },
            Kind::Cos(base) => self
                .in_turns(*base)
                .map_or(Known::Unknown, |i| within(&i, ratio(-1, 2), ratio(1, 2))),
            Kind::Sin(base) => self
                .in_turns(*base)
                .map_or(Known::Unknown, |i| within(&i, ratio(0, 1), ratio(1, 1))),
            Kind::Root => match self.gens[v]
                .relation
                .as_ref()
                .and_then(|(_, p)| self.sign_poly(p))
            {
                Some(Sign::Positive) => Known::Positive,
                _ => Known::NotNegative,
            },
            Kind::Abs(_) => Known::NotNegative,
            Kind::Call(Function::Exp | Function::Cosh, _) => Known::Positive,
            Kind::Call(..) | Kind::Power(..) => Known::Unknown,
        }
    }

    /// The interval of a symbol; multiples of π that are not 0 are enclosed from outside.
    fn interval(&self, name: &Symbol) -> Interval {
        if &**name == "pi" {
            return Interval {
                low: Some((ratio(333, 106), true)),
                high: Some((ratio(355, 113), true)),
            };
        }
        if let Some(domain) = self.domains.symbols.get(name) {
            let end = |limit: &Option<Limit>, outward: i64| {
                limit.as_ref().map(|l| {
                    if l.of_pi && !l.value.is_zero() {
                        let away = if outward * if l.value.is_negative() { -1 } else { 1 } > 0 {
                            ratio(355, 113)
                        } else {
                            ratio(333, 106)
                        };
                        (&l.value * away, true)
                    } else {
                        (l.value.clone(), l.open)
                    }
                })
            };
            return Interval {
                low: end(&domain.low, -1),
                high: end(&domain.high, 1),
            };
        }
        if self
            .domains
            .unit_vectors
            .iter()
            .any(|pair| pair.contains(name))
        {
            return Interval {
                low: Some((ratio(-1, 1), false)),
                high: Some((ratio(1, 1), false)),
            };
        }
        if self
            .bases
            .iter()
            .any(|b| matches!(&b.of, AngleOf::Symbol(s) if s == name))
        {
            return Interval {
                low: Some((ratio(0, 1), true)),
                high: Some((ratio(355, 226), true)),
            };
        }
        Interval {
            low: Some((ratio(0, 1), true)),
            high: None,
        }
    }

    /// The interval of a base angle in units of π, enclosed from outside; `None` when unbounded.
    fn in_turns(&self, base: usize) -> Option<Interval> {
        let base = &self.bases[base];
        let AngleOf::Symbol(name) = &base.of else {
            return None;
        };
        let divisor = ratio(1, i64::from(base.divisor));
        let Some(domain) = self.domains.symbols.get(name) else {
            return Some(Interval {
                low: Some((ratio(0, 1), true)),
                high: Some((ratio(1, 2) * divisor, true)),
            });
        };
        let end = |limit: &Option<Limit>, up: bool| {
            limit.as_ref().map(|l| {
                if l.of_pi || l.value.is_zero() {
                    return (&l.value * &divisor, l.open);
                }
                let over = if up ^ l.value.is_negative() {
                    ratio(106, 333)
                } else {
                    ratio(113, 355)
                };
                (&l.value * over * &divisor, true)
            })
        };
        let (low, high) = (end(&domain.low, false), end(&domain.high, true));
        (low.is_some() && high.is_some()).then_some(Interval { low, high })
    }

    /// Writes variables of unknown sign as positive ones, then looks at the coefficients.
    fn by_substitution(&self, p: &Poly) -> Option<Sign> {
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

    // ---- samples ----

    /// Signs seen at the sample points: (somewhere positive, somewhere negative).
    pub(crate) fn seen_signs(&mut self, p: &Poly) -> (bool, bool) {
        self.ensure_samples();
        let (mut plus, mut minus) = (false, false);
        for k in 0..SAMPLES {
            if let Some(value) = self.sample(p, k) {
                plus |= value > 0.0;
                minus |= value < 0.0;
            }
        }
        (plus, minus)
    }

    /// Value at a sample point; 0 where rounding leaves the sign open, `None` where a generator has no value.
    fn sample(&self, p: &Poly, k: usize) -> Option<f64> {
        let (mut total, mut size) = (0.0, 0.0);
        for (mono, coeff) in p.terms() {
            let mut value = to_f64(&Rational::from(coeff.clone()));
            for (v, power) in powers(mono) {
                value *= self.samples[v][k].powi(power as i32);
            }
            total += value;
            size += f64::abs(value);
        }
        if !size.is_finite() {
            return None;
        }
        Some(if f64::abs(total) <= 1e-9 * size {
            0.0
        } else {
            total
        })
    }

    fn sample_element(&self, x: &Element, k: usize) -> Option<f64> {
        let mut value = self.sample(&x.num, k)? / to_f64(&Rational::from(x.den.int.clone()));
        value /= self.sample(&Poly::term(&x.den.mono, Int::one()), k)?;
        for (f, e) in &x.den.factors {
            value /= self.sample(f, k)?.powi(*e as i32);
        }
        Some(value)
    }

    fn ensure_samples(&mut self) {
        for v in self.samples.len()..self.gens.len() {
            let column: Vec<f64> = (0..SAMPLES)
                .map(|k| self.sample_generator(v, k).unwrap_or(f64::NAN))
                .collect();
            self.samples.push(column);
        }
    }

    fn sample_generator(&self, v: usize, k: usize) -> Option<f64> {
        let value = match &self.gens[v].kind {
            Kind::Symbol(name) if &**name == "pi" => std::f64::consts::PI,
            Kind::Symbol(name) => match &self.gens[v].relation {
                Some((_, value)) => {
                    let size = self.sample(value, k)?.max(0.0).sqrt();
                    let range = self.interval(name);
                    let positive = range.low.is_some_and(|(l, _)| !l.is_negative());
                    let negative = range.high.is_some_and(|(h, _)| !h.is_positive());
                    if positive || (!negative && k.is_multiple_of(2)) {
                        size
                    } else {
                        -size
                    }
                }
                None => pick(&self.interval(name), fraction(name, k)),
            },
            Kind::Cos(base) | Kind::Sin(base) => {
                let base = &self.bases[*base];
                let angle = match &base.of {
                    AngleOf::Symbol(name) => match self.domains.symbols.get(name) {
                        None => fraction(name, k) * std::f64::consts::FRAC_PI_2,
                        Some(_) => pick(&self.interval(name), fraction(name, k)),
                    },
                    AngleOf::Term(term) => self.sample_element(term, k)?,
                } / f64::from(base.divisor);
                if matches!(self.gens[v].kind, Kind::Cos(_)) {
                    angle.cos()
                } else {
                    angle.sin()
                }
            }
            Kind::Root => {
                let (degree, value) = self.gens[v].relation.as_ref()?;
                let value = self.sample(value, k)?;
                if *degree == 2 {
                    value.sqrt()
                } else {
                    value.signum() * value.abs().powf(1.0 / f64::from(*degree))
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

/// A divisor has a value, so it is not zero.
fn nonzero(sign: Sign) -> Sign {
    match sign {
        Sign::NotNegative => Sign::Positive,
        Sign::NotPositive => Sign::Negative,
        other => other,
    }
}

fn within(i: &Interval, low: Rational, high: Rational) -> Known {
    let (Some((a, open_a)), Some((b, open_b))) = (&i.low, &i.high) else {
        return Known::Unknown;
    };
    if *a < low || *b > high {
        return Known::Unknown;
    }
    let touches = (*a == low && !open_a) || (*b == high && !open_b);
    if touches {
        Known::NotNegative
    } else {
        Known::Positive
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

/// A well spread number in (0, 1), fixed by name and index.
fn fraction(name: &str, k: usize) -> f64 {
    let mut hash = 0xcbf2_9ce4_8422_2325u64;
    for byte in name.bytes() {
        hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    }
    let mut z = hash.wrapping_add((k as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15));
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((z ^ (z >> 31)) >> 12) as f64 / (1u64 << 52) as f64 * 0.998 + 0.001
}

fn pick(range: &Interval, u: f64) -> f64 {
    let wide = (6.0 * u - 3.0).exp();
    match (&range.low, &range.high) {
        (Some((low, _)), Some((high, _))) => to_f64(low) + (to_f64(high) - to_f64(low)) * u,
        (Some((low, _)), None) => to_f64(low) + wide,
        (None, Some((high, _))) => to_f64(high) - wide,
        (None, None) => {
            let x = 2.0 * u - 1.0;
            4.0 * x / (1.02 - x.abs())
        }
    }
}
