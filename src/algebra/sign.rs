//! Signs on the domain: proved by coefficients, or merely seen at sample points.
//!
//! A proof writes every variable as a positive one — an interval through x = (lo + hi·u)/(1 + u), an angle through the
//! tangent of its half — and finds all coefficients of one sign. Ends that are no fractions are enclosed from outside.

use num_traits::{Signed, Zero};

use super::Sign;
use super::element::Element;
use super::factor::factor;
use super::field::{AngleOf, Field, Kind};
use super::mono::{exponent, mono_variables, powers};
use super::poly::Poly;
use crate::domain::Limit;
use crate::expr::{Function, Int, Rational, Symbol, ratio};

/// Most terms of a quadratic whose discriminant, with as many terms squared, is looked at.
const MOST_QUADRATIC: usize = 40;

/// Ends of an interval; `None` is infinite.
#[derive(Clone, Debug)]
pub(crate) struct Interval {
    pub low: Option<(Rational, bool)>,
    pub high: Option<(Rational, bool)>,
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
        if p.len() > super::substitution::MOST_TERMS {
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
        let (decides, strict) = match sn {
            Sign::Positive => (sa, true),
            Sign::NotNegative => (sa, false),
            Sign::Negative => (sb, true),
            Sign::NotPositive => (sb, false),
            Sign::Zero => return Some(Sign::Zero),
        };
        Some(match (decides.is_not_negative(), strict) {
            (true, true) => Sign::Positive,
            (true, false) => Sign::NotNegative,
            (false, true) => Sign::Negative,
            (false, false) => Sign::NotPositive,
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
        if p.len() > MOST_QUADRATIC {
            return None;
        }
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
    pub(crate) fn by_coefficients(
        &self,
        p: &Poly,
        weak: &[(usize, bool)],
        closed: &[usize],
    ) -> Option<Sign> {
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
            Kind::Call(Function::Cos | Function::Sin, x) => match self.as_turns(x) {
                Some(q) if q.is_positive() && q < ratio(1, 2) => Known::Positive,
                _ => Known::Unknown,
            },
            Kind::Call(..) | Kind::Power(..) => Known::Unknown,
        }
    }

    /// The interval of a symbol; multiples of π that are not 0 are enclosed from outside.
    pub(crate) fn interval(&self, name: &Symbol) -> Interval {
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
    pub(crate) fn in_turns(&self, base: usize) -> Option<Interval> {
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
