//! Greatest common divisors of polynomials, and what follows from them: contents, squarefree parts, splitting.
//!
//! These only shorten what is printed and what roots are taken of. Whether an expression is zero never depends on them,
//! so a limit met here may safely be read as "no common divisor found".

use num_integer::Integer;
use num_traits::{One, Zero};

use super::Stop;
use super::poly::{Mono, Poly, exponent, mono_is_one, mono_min, mono_variables};
use crate::expr::Int;

/// Most terms of a polynomial inside a remainder sequence.
const MOST_TERMS: usize = 4_000;
/// 2⁶¹ − 1.
const PRIME: u64 = (1 << 61) - 1;

/// Greatest common divisor, with positive leading coefficient.
pub(crate) fn gcd(a: &Poly, b: &Poly) -> Result<Poly, Stop> {
    if a.is_zero() || b.is_zero() {
        let other = if a.is_zero() { b } else { a };
        return Ok(if other.leading_is_negative() {
            other.neg()
        } else {
            other.clone()
        });
    }
    let ((ca, ma, pa), (cb, mb, pb)) = (a.split(), b.split());
    let common = Poly::term(&mono_min(&ma, &mb), ca.gcd(&cb));
    primitive_gcd(pa, pb)?.mul(&common)
}

/// Of two polynomials without numeric or monomial content.
fn primitive_gcd(mut a: Poly, mut b: Poly) -> Result<Poly, Stop> {
    loop {
        if a.is_constant() || b.is_constant() {
            return Ok(Poly::one());
        }
        if a == b {
            return Ok(a);
        }
        // A variable that only one of them has cannot occur in the divisor.
        let (va, vb) = (a.variables(), b.variables());
        if let Some(v) = va.iter().find(|v| !vb.contains(v)) {
            a = fold_coefficients(&a, *v, b.clone())?;
            if a.is_constant() {
                return Ok(Poly::one());
            }
            continue;
        }
        if let Some(v) = vb.iter().find(|v| !va.contains(v)) {
            b = fold_coefficients(&b, *v, a.clone())?;
            if b.is_constant() {
                return Ok(Poly::one());
            }
            continue;
        }
        let (small, large) = if a.len() <= b.len() {
            (&a, &b)
        } else {
            (&b, &a)
        };
        if large.try_div(small).is_some() {
            return Ok(small.clone());
        }
        // Images modulo a prime bound the degree of the divisor in each variable.
        let bounds: Vec<(usize, Option<u32>)> =
            va.iter().map(|v| (*v, image_degree(&a, &b, *v))).collect();
        if bounds.iter().all(|(_, d)| *d == Some(0)) {
            return Ok(Poly::one());
        }
        if let Some((v, _)) = bounds.iter().find(|(_, d)| *d == Some(0)) {
            let g = fold_coefficients(&a, *v, b.clone())?;
            return Ok(g);
        }
        let Some(v) = va
            .iter()
            .copied()
            .min_by_key(|v| a.degree(*v).max(b.degree(*v)))
        else {
            return Ok(Poly::one());
        };
        return remainder_sequence(&a, &b, v);
    }
}

/// gcd of `seed` and all coefficients of p in v, without numeric content.
fn fold_coefficients(p: &Poly, v: usize, seed: Poly) -> Result<Poly, Stop> {
    let mut g = seed;
    let mut parts = p.by_power(v);
    parts.sort();
    for part in parts.iter().filter(|p| !p.is_zero()) {
        g = gcd(&g, part)?;
        if g.is_constant() {
            return Ok(Poly::one());
        }
    }
    let (_, mono, rest) = g.split();
    rest.mul_term(&mono, &Int::one())
}

/// Content with respect to v: the greatest common divisor of the coefficients, numbers included.
pub(crate) fn content_in(p: &Poly, v: usize) -> Result<Poly, Stop> {
    let mut parts = p.by_power(v);
    parts.sort();
    let mut g = Poly::zero();
    for part in parts.iter().filter(|p| !p.is_zero()) {
        g = gcd(&g, part)?;
        if g.is_one() {
            break;
        }
    }
    Ok(g)
}

fn remainder_sequence(a: &Poly, b: &Poly, v: usize) -> Result<Poly, Stop> {
    let (ca, cb) = (content_in(a, v)?, content_in(b, v)?);
    let content = gcd(&ca, &cb)?;
    let divide = |p: &Poly, c: &Poly| p.try_div(c).ok_or(Stop::TooLarge("terms"));
    let (mut x, mut y) = (divide(a, &ca)?, divide(b, &cb)?);
    if x.degree(v) < y.degree(v) {
        std::mem::swap(&mut x, &mut y);
    }
    loop {
        let r = pseudo_remainder(&x, &y, v)?;
        if r.is_zero() {
            let (_, _, primitive) = y.split();
            return primitive.mul(&content);
        }
        if r.degree(v) == 0 {
            return Ok(content);
        }
        let c = content_in(&r, v)?;
        (x, y) = (y, divide(&r, &c)?);
    }
}

fn pseudo_remainder(x: &Poly, y: &Poly, v: usize) -> Result<Poly, Stop> {
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
        let g = gcd(&top, lead)?;
        let (p, q) = match (top.try_div(&g), lead.try_div(&g)) {
            (Some(p), Some(q)) => (p, q),
            _ => (top, lead.clone()),
        };
        let shift = rest.len() + 1 - by.len();
        for (k, part) in rest.iter_mut().enumerate() {
            let mut next = if q.is_one() {
                part.clone()
            } else {
                part.mul(&q)?
            };
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

fn mul_mod(a: u64, b: u64) -> u64 {
    (u128::from(a) * u128::from(b) % u128::from(PRIME)) as u64
}

fn pow_mod(base: u64, mut exponent: u64) -> u64 {
    let (mut result, mut square) = (1, base);
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = mul_mod(result, square);
        }
        square = mul_mod(square, square);
        exponent >>= 1;
    }
    result
}

fn residue(value: &Int) -> u64 {
    match value.as_i64() {
        Some(v) => v.rem_euclid(PRIME as i64) as u64,
        None => value
            .mod_floor(&Int::from(PRIME as i64))
            .as_i64()
            .unwrap_or(0) as u64,
    }
}

/// A fixed residue for each variable; any choice that keeps the leading coefficients is valid.
fn value_of(v: usize) -> u64 {
    let mut z = (v as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    (z ^ (z >> 27)) % (PRIME - 2) + 1
}

/// Image in one variable modulo the prime, ascending.
fn image(p: &Poly, v: usize) -> Vec<u64> {
    let mut out = vec![0; p.degree(v) as usize + 1];
    let others: Vec<usize> = p.variables().into_iter().filter(|w| *w != v).collect();
    for (mono, coeff) in p.terms() {
        let mut value = residue(coeff);
        for w in &others {
            let k = exponent(mono, *w);
            if k > 0 {
                value = mul_mod(
                    value,
                    if k == 1 {
                        value_of(*w)
                    } else {
                        pow_mod(value_of(*w), u64::from(k))
                    },
                );
            }
        }
        let place = &mut out[exponent(mono, v) as usize];
        *place = (*place + value) % PRIME;
    }
    out
}

/// Bound for the degree in v of the common divisor; `None` when the image tells nothing.
fn image_degree(a: &Poly, b: &Poly, v: usize) -> Option<u32> {
    let (mut x, mut y) = (image(a, v), image(b, v));
    if x.last() == Some(&0) || y.last() == Some(&0) {
        return None;
    }
    if x.len() < y.len() {
        std::mem::swap(&mut x, &mut y);
    }
    while !y.is_empty() {
        let inverse = pow_mod(*y.last()?, PRIME - 2);
        while x.len() >= y.len() {
            let top = x.pop()?;
            let factor = mul_mod(top, inverse);
            let shift = x.len() + 1 - y.len();
            for k in 0..y.len() - 1 {
                x[shift + k] = (x[shift + k] + PRIME - mul_mod(factor, y[k])) % PRIME;
            }
        }
        while x.last() == Some(&0) {
            x.pop();
        }
        std::mem::swap(&mut x, &mut y);
    }
    u32::try_from(x.len() - 1).ok()
}

/// A polynomial taken apart: content · mono · ∏ factorᵏ.
#[derive(Clone, Debug)]
pub(crate) struct Factored {
    pub content: Int,
    pub mono: Mono,
    /// Pairwise different, primitive, positive leading coefficients, sorted.
    pub factors: Vec<(Poly, u32)>,
}

/// Contents with respect to every variable, squarefree parts, and quadratics split by their discriminant.
/// Where a limit is met, a factor stays whole.
pub(crate) fn factor(p: &Poly) -> Factored {
    let (content, mono, rest) = p.split();
    let mut factors = Vec::new();
    if !rest.is_constant() {
        split_into(rest, 1, &mut factors);
    }
    factors.sort();
    Factored {
        content,
        mono,
        factors,
    }
}

fn note(p: Poly, times: u32, out: &mut Vec<(Poly, u32)>) {
    match out.iter_mut().find(|(f, _)| *f == p) {
        Some((_, k)) => *k += times,
        None => out.push((p, times)),
    }
}

fn split_into(p: Poly, times: u32, out: &mut Vec<(Poly, u32)>) {
    let (_, mono, p) = p.split();
    for v in mono_variables(&mono) {
        note(Poly::var(v), times * exponent(&mono, v), out);
    }
    if p.is_constant() {
        return;
    }
    match divisor(&p) {
        Some((d, q)) => {
            split_into(d, times, out);
            split_into(q, times, out);
        }
        None => note(p, times, out),
    }
}

/// A proper divisor and its cofactor, when one is found.
fn divisor(p: &Poly) -> Option<(Poly, Poly)> {
    let degrees = p.degrees();
    let mut variables = mono_variables(&degrees);
    variables.sort_by_key(|v| exponent(&degrees, *v));
    // Primitive and linear in a variable means irreducible.
    for v in &variables {
        if let Some(c) = content_in(p, *v).ok().filter(|c| !c.is_constant()) {
            return p.try_div(&c).map(|q| (c, q));
        }
        if exponent(&degrees, *v) == 1 {
            return None;
        }
    }
    for v in &variables {
        if let Some(g) = gcd(p, &p.derivative(*v)).ok().filter(|g| !g.is_constant()) {
            return p.try_div(&g).map(|q| (g, q));
        }
    }
    for v in &variables {
        let found = match exponent(&degrees, *v) {
            2 => split_quadratic(p, *v, 1),
            4 => split_quadratic(p, *v, 2),
            _ => None,
        };
        if found.is_some() {
            return found;
        }
    }
    difference_of_powers(p, &variables)
}

/// Splits a x²ᵏ + b xᵏ + c whose discriminant is a square.
fn split_quadratic(p: &Poly, v: usize, k: usize) -> Option<(Poly, Poly)> {
    let parts = p.by_power(v);
    if k == 2 && (!parts[1].is_zero() || !parts[3].is_zero()) {
        return None;
    }
    let (a, b, c) = (&parts[2 * k], &parts[k], &parts[0]);
    let discriminant = b.mul(b).ok()?.sub(&a.mul(c).ok()?.scale(&Int::from(4)));
    let root = discriminant.sqrt()?;
    let x = Poly::from_powers(&[vec![Poly::zero(); k], vec![Poly::one()]].concat(), v).ok()?;
    let linear = a.scale(&Int::from(2)).mul(&x).ok()?.add(&b.sub(&root));
    let g = gcd(p, &linear).ok()?;
    let (_, _, g) = g.split();
    if g.is_constant() || !mono_is_one(&g.mono_content()) {
        return None;
    }
    let q = p.try_div(&g)?;
    (!q.is_constant()).then_some((g, q))
}

/// Tries the rational roots x = ± (coefficient of the last over the first term): enough for xⁿ − aⁿ and its like.
fn difference_of_powers(p: &Poly, variables: &[usize]) -> Option<(Poly, Poly)> {
    if p.len() != 2 {
        return None;
    }
    let v = variables.first().copied()?;
    for k in [3, 5, 7, 2] {
        let root = |i: usize| -> Option<Poly> {
            let magnitude = num_traits::Signed::abs(p.coeff(i));
            let r = Int::from(magnitude.to_bigint().nth_root(k));
            let exponents: Option<Vec<(usize, u32)>> = variables
                .iter()
                .map(|w| {
                    let e = exponent(p.mono(i), *w);
                    (e % k == 0).then_some((*w, e / k))
                })
                .collect();
            (r.pow(k) == magnitude).then_some(())?;
            let mut out = Poly::constant(r);
            for (w, e) in exponents? {
                out = out.mul(&Poly::var(w).pow(e).ok()?).ok()?;
            }
            Some(out)
        };
        if let (Some(a), Some(b)) = (root(0), root(1)) {
            for candidate in [a.sub(&b), a.add(&b)] {
                if candidate.has(v) || !candidate.is_constant() {
                    let (_, _, candidate) = candidate.split();
                    if let Some(q) = p.try_div(&candidate).filter(|q| !q.is_constant()) {
                        return Some((candidate, q));
                    }
                }
            }
        }
    }
    None
}

/// The largest integer whose square divides the value (by small primes), and the cofactor.
pub(crate) fn square_part(value: &Int) -> (Int, Int) {
    let (mut root, mut rest) = (Int::one(), value.clone());
    let mut p = 2i64;
    while p < 2_000 {
        let (prime, square) = (Int::from(p), Int::from(p * p));
        if square > num_traits::Signed::abs(&rest) {
            break;
        }
        while (&rest % &square).is_zero() {
            rest /= &square;
            root *= &prime;
        }
        p += if p == 2 { 1 } else { 2 };
    }
    if !num_traits::Signed::is_negative(&rest) {
        let r = rest.sqrt();
        if &r * &r == rest {
            return (root * r, Int::one());
        }
    }
    (root, rest)
}
