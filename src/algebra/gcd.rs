//! Greatest common divisors of polynomials.
//!
//! These only shorten what is printed and what roots are taken of. Whether an expression is zero never depends on them,
//! so a limit met here may safely be read as "no common divisor found".

use num_integer::Integer;
use num_traits::One;

use super::fuel::Fuel;
use super::mono::{exponent, mono_div, mono_min, mono_of};
use super::poly::Poly;
use super::{Stop, image};
use crate::expr::Int;

/// Most terms of a polynomial inside a remainder sequence.
const MOST_TERMS: usize = 4_000;

/// Greatest common divisor, with positive leading coefficient.
pub(crate) fn gcd(a: &Poly, b: &Poly, fuel: &Fuel) -> Result<Poly, Stop> {
    if a.is_zero() || b.is_zero() {
        let other = if a.is_zero() { b } else { a };
        return Ok(match other.leading_is_negative() {
            true => other.neg(),
            false => other.clone(),
        });
    }
    let ((ca, ma, pa), (cb, mb, pb)) = (a.split(), b.split());
    let common = Poly::term(&mono_min(&ma, &mb), ca.gcd(&cb));
    primitive_gcd(pa, pb, fuel)?.mul(&common)
}

/// Of two polynomials without numeric or monomial content.
fn primitive_gcd(a: Poly, b: Poly, fuel: &Fuel) -> Result<Poly, Stop> {
    if a.is_constant() || b.is_constant() {
        return Ok(Poly::one());
    }
    if a == b {
        return Ok(a);
    }
    fuel.burn((a.len() + b.len()) * 4)?;
    let parts = [a, b];
    let shared = image::shared(&parts);
    let [a, b] = &parts;
    if [a, b].iter().any(|p| p.variables() != shared) {
        return common(&parts, &shared, fuel);
    }
    let (small, large) = if a.len() <= b.len() { (a, b) } else { (b, a) };
    if large.try_div(small).is_some() {
        return Ok(small.clone());
    }
    if let Some(g) = by_values(a, b, fuel) {
        return Ok(g);
    }
    let v = shared
        .into_iter()
        .min_by_key(|v| a.degree(*v).max(b.degree(*v)));
    v.map_or(Ok(Poly::one()), |v| remainder_sequence(a, b, v, fuel))
}

/// The common divisor of polynomials, numbers aside, of which only some variables can occur in it: it divides each of their
/// coefficients with respect to the others, which are short.
fn common(parts: &[Poly], shared: &[usize], fuel: &Fuel) -> Result<Poly, Stop> {
    if shared.is_empty() {
        return Ok(Poly::one());
    }
    let mut coefficients: Vec<Poly> = parts.iter().flat_map(|p| p.coefficients(shared)).collect();
    coefficients.sort();
    coefficients.dedup();
    let mut g = Poly::zero();
    for part in &coefficients {
        g = gcd(&g, part, fuel)?;
        if g.is_constant() {
            return Ok(Poly::one());
        }
    }
    Ok(g)
}

/// Content with respect to v: the greatest common divisor of the coefficients, numbers included.
pub(crate) fn content_in(p: &Poly, v: usize, fuel: &Fuel) -> Result<Poly, Stop> {
    let (number, mono, p) = p.split();
    let mut parts = p.by_power(v);
    parts.retain(|part| !part.is_zero());
    let g = match parts.as_slice() {
        [only] => only.clone(),
        // What divides a single term is one, and p is rid of those that all its terms share.
        _ if parts.iter().any(|part| part.len() == 1) => Poly::one(),
        _ => common(&parts, &image::shared(&parts), fuel)?,
    };
    let outside = mono_div(&mono, &mono_of(v, exponent(&mono, v)));
    g.split()
        .2
        .mul_term(&outside, &num_traits::Signed::abs(&number))
}

fn remainder_sequence(a: &Poly, b: &Poly, v: usize, fuel: &Fuel) -> Result<Poly, Stop> {
    let (ca, cb) = (content_in(a, v, fuel)?, content_in(b, v, fuel)?);
    let content = gcd(&ca, &cb, fuel)?;
    let divide = |p: &Poly, c: &Poly| p.try_div(c).ok_or(Stop::TooLarge("terms"));
    let (mut x, mut y) = (divide(a, &ca)?, divide(b, &cb)?);
    if x.degree(v) < y.degree(v) {
        std::mem::swap(&mut x, &mut y);
    }
    loop {
        let r = pseudo_remainder(&x, &y, v, fuel)?;
        if r.is_zero() {
            let (_, _, primitive) = y.split();
            return primitive.mul(&content);
        }
        if r.degree(v) == 0 {
            return Ok(content);
        }
        let c = content_in(&r, v, fuel)?;
        (x, y) = (y, divide(&r, &c)?);
    }
}

fn pseudo_remainder(x: &Poly, y: &Poly, v: usize, fuel: &Fuel) -> Result<Poly, Stop> {
    let (mut rest, by) = (x.by_power(v), y.by_power(v));
    let Some(lead) = by.last() else {
        return Err(Stop::DivisionByZero);
    };
    while rest.len() >= by.len() {
        let Some(top) = rest.pop() else { break };
        if top.is_zero() {
            continue;
        }
        // Only the quotient lead/top in lowest terms is needed: keeps coefficients short.
        let g = gcd(&top, lead, fuel)?;
        let (p, q) = match (top.try_div(&g), lead.try_div(&g)) {
            (Some(p), Some(q)) => (p, q),
            _ => (top, lead.clone()),
        };
        let shift = rest.len() + 1 - by.len();
        for (k, part) in rest.iter_mut().enumerate() {
            fuel.burn(part.len() * q.len() + by.len() * p.len() * 4)?;
            let mut next = part.mul(&q)?;
            if k >= shift && k - shift < by.len() - 1 {
                next = next.sub(&by[k - shift].mul(&p)?);
            }
            if next.len() > MOST_TERMS {
                return Err(Stop::TooLarge("terms"));
            }
            *part = next;
        }
    }
    Poly::from_powers(&rest, v)
}

/// The divisor read off its value at a large integer: gcd of the values, expanded in powers of that integer. A candidate
/// that divides both is the greatest common divisor (Char, Geddes, Gonnet 1989); without one, `None`.
fn by_values(a: &Poly, b: &Poly, fuel: &Fuel) -> Option<Poly> {
    let size = |p: &Poly| -> usize {
        let variables = p.variables().into_iter();
        variables.map(|v| p.degree(v) as usize + 1).product()
    };
    let bits = |p: &Poly| p.terms().map(|(_, c)| c.bits()).max().unwrap_or(0) as usize;
    let each = bits(a).min(bits(b)) + 3;
    if size(a).max(size(b)).saturating_mul(each) > 12_000 {
        return None;
    }
    let (_, _, g) = values_gcd(a, b, fuel)?.split();
    Some(g)
}

/// Full divisor, numbers included.
fn values_gcd(a: &Poly, b: &Poly, fuel: &Fuel) -> Option<Poly> {
    if let (Some(x), Some(y)) = (a.as_constant(), b.as_constant()) {
        return Some(Poly::constant(x.gcd(y)));
    }
    if a.is_constant() || b.is_constant() {
        return Some(Poly::constant(a.content().gcd(&b.content())));
    }
    let v = a.variables().into_iter().chain(b.variables()).min()?;
    let (ca, cb) = (a.content(), b.content());
    let (a, b) = (a.div_int(&ca), b.div_int(&cb));
    let largest = |p: &Poly| {
        let sizes = p.terms().map(|(_, c)| num_traits::Signed::abs(c));
        sizes.max().unwrap_or_else(Int::one)
    };
    let mut x = largest(&a).min(largest(&b)) * Int::from(2) + Int::from(29);
    for _ in 0..3 {
        fuel.burn((a.len() + b.len()) * (1 + x.bits() as usize / 8))
            .ok()?;
        let (p, q) = (value_at(&a, v, &x), value_at(&b, v, &x));
        if !p.is_zero() && !q.is_zero() {
            let mut rest = values_gcd(&p, &q, fuel)?;
            let mut parts = Vec::new();
            while !rest.is_zero() && parts.len() < 128 {
                let digit = symmetric_residue(&rest, &x);
                rest = rest.sub(&digit).div_int(&x);
                parts.push(digit);
            }
            let (_, mono, candidate) = Poly::from_powers(&parts, v).ok()?.split();
            let candidate = candidate.mul_term(&mono, &Int::one()).ok()?;
            if a.try_div(&candidate).is_some() && b.try_div(&candidate).is_some() {
                return Some(candidate.scale(&ca.gcd(&cb)));
            }
        }
        x = &x * &Int::from(73_794) / Int::from(27_011) + Int::from(1);
    }
    None
}

fn value_at(p: &Poly, v: usize, x: &Int) -> Poly {
    p.by_power(v)
        .iter()
        .rev()
        .fold(Poly::zero(), |total, part| total.scale(x).add(part))
}

/// Coefficients reduced to (−x/2, x/2].
fn symmetric_residue(p: &Poly, x: &Int) -> Poly {
    p.map_coefficients(|c| {
        let r = c.mod_floor(x);
        if &r + &r > *x { r - x } else { r }
    })
}
