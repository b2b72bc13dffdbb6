//! Images of polynomials in one variable modulo 2⁶¹ − 1, all others at one fixed point.
//!
//! In: polynomials. Out: what they refuse, which is certain: that one divides another, that some have a common divisor.
//! What they allow has to be shown by other means.

use num_integer::Integer;

use super::mono::{exponent, powers};
use super::poly::Poly;
use super::prime::{self, PLAIN, add, negative, one, power, random, times};
use crate::expr::Int;

/// A polynomial with the values of its terms at the point.
struct At<'a> {
    poly: &'a Poly,
    terms: Vec<u64>,
}

impl<'a> At<'a> {
    fn of(poly: &'a Poly) -> At<'a> {
        let value = |(mono, coeff): (&[u64], &Int)| {
            powers(mono).fold(residue(coeff), |value, (v, k)| {
                let x = random::<PLAIN>(v as u64, 0);
                times::<PLAIN>(
                    value,
                    if k == 1 {
                        x
                    } else {
                        power::<PLAIN>(x, k.into())
                    },
                )
            })
        };
        At {
            poly,
            terms: poly.terms().map(value).collect(),
        }
    }

    /// Coefficients of the image in one variable, in units of its own value at the point, by ascending powers.
    fn along(&self, v: usize) -> Vec<u64> {
        let mut out = Vec::with_capacity(4);
        for ((mono, _), value) in self.poly.terms().zip(&self.terms) {
            let k = exponent(mono, v) as usize;
            if k >= out.len() {
                out.resize(k + 1, 0);
            }
            out[k] = add::<PLAIN>(out[k], *value);
        }
        out
    }
}

fn residue(value: &Int) -> u64 {
    let prime = prime::prime::<PLAIN>() as i64;
    match value.as_i64() {
        Some(v) => v.rem_euclid(prime) as u64,
        None => value.mod_floor(&Int::from(prime)).as_i64().unwrap_or(0) as u64,
    }
}

/// Whether a polynomial cannot divide another: where it vanishes, the other does not.
pub(super) fn refuses(divisor: &Poly, dividend: &Poly) -> bool {
    let degrees = divisor.degrees();
    let Some((v, _)) = powers(&degrees).find(|(_, k)| *k == 1) else {
        return false;
    };
    let zero = At::of(divisor).along(v);
    let [b, a] = zero[..] else { return false };
    // The image at −b/a, times a to its degree: nothing is divided.
    let image = At::of(dividend).along(v);
    let minus = negative::<PLAIN>(b);
    let mut scale = one::<PLAIN>();
    let value = image.iter().rev().fold(0, |total, k| {
        let next = add::<PLAIN>(times::<PLAIN>(total, minus), times::<PLAIN>(*k, scale));
        scale = times::<PLAIN>(scale, a);
        next
    });
    a != 0 && value != 0
}

/// The variables that a common divisor of polynomials may have, ascending; no other can occur in it.
pub(super) fn shared(parts: &[Poly]) -> Vec<usize> {
    let Some(least) = parts.iter().min_by_key(|p| p.len()) else {
        return Vec::new();
    };
    let parts: Vec<At> = parts.iter().map(At::of).collect();
    let mut variables = least.variables();
    variables.retain(|v| !is_free(&parts, *v));
    variables
}

/// Whether a common divisor is free of a variable, for certain.
fn is_free(parts: &[At], v: usize) -> bool {
    let mut told = false;
    let mut total = Vec::new();
    for part in parts {
        let image = part.along(v);
        // The leading coefficient of a divisor divides that of each.
        told |= image.last().is_some_and(|k| *k != 0);
        total = divisor(total, image);
        if told && total.len() == 1 {
            return true;
        }
    }
    false
}

/// The common divisor of two images, up to a factor.
fn divisor(mut x: Vec<u64>, mut y: Vec<u64>) -> Vec<u64> {
    let trim = |x: &mut Vec<u64>| {
        while x.last() == Some(&0) {
            x.pop();
        }
    };
    trim(&mut x);
    trim(&mut y);
    while let Some(&lead) = y.last() {
        while x.len() >= y.len() {
            let Some(top) = x.pop().map(negative::<PLAIN>) else {
                break;
            };
            let shift = x.len() + 1 - y.len();
            for k in &mut x {
                *k = times::<PLAIN>(*k, lead);
            }
            for (k, b) in x[shift..].iter_mut().zip(&y) {
                *k = add::<PLAIN>(*k, times::<PLAIN>(top, *b));
            }
        }
        trim(&mut x);
        std::mem::swap(&mut x, &mut y);
    }
    x
}
