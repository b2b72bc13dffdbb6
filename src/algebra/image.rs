//! Images of polynomials in one variable modulo 2⁶¹ − 1, all others at one fixed point.
//!
//! In: polynomials. Out: what they refuse, which is certain: that one divides another, that some have a common
//! divisor, that one depends on differences of angles alone, that one is a square.
//! What they allow has to be shown by other means.

use num_integer::Integer;

use std::collections::BTreeSet;

use super::field::Generator;
use super::mono::{exponent, powers};
use super::poly::Poly;
use super::prime::{self, PLAIN, ROOTS, add, negative, one, power, random, times};
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
    modulo::<PLAIN>(value)
}

/// A number modulo the prime.
fn modulo<const C: u64>(value: &Int) -> u64 {
    let prime = prime::prime::<C>() as i64;
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

/// Points at which a polynomial has to be a square before it may be one.
const SQUARES: u64 = 8;
/// Points looked at; each root has a value at half of them.
const LOOKED_AT: u64 = 64 * SQUARES;

/// Whether a polynomial is the square of nothing that is made of its variables and of these roots: at a point where all of them
/// have values, its value has no root.
pub(super) fn is_no_square(p: &Poly, roots: &[usize], gens: &[Generator]) -> bool {
    let mut open: Vec<usize> = p.variables().into_iter().chain(roots.to_vec()).collect();
    let mut needed = BTreeSet::new();
    while let Some(v) = open.pop() {
        if !needed.insert(v) {
            continue;
        }
        match &gens[v].relation {
            Some((2, value)) => open.extend(value.variables()),
            Some(_) => return false,
            None => {}
        }
    }
    let mut seen = 0;
    for round in 0..LOOKED_AT {
        let mut at = vec![0; gens.len()];
        let exists = needed.iter().all(|v| {
            let drawn = random::<ROOTS>(*v as u64, round);
            let value = match &gens[*v].relation {
                Some((_, value)) => root(value_at(value, &at)).map(|root| match drawn % 2 {
                    0 => root,
                    _ => negative::<ROOTS>(root),
                }),
                None => Some(drawn),
            };
            at[*v] = value.unwrap_or(0);
            value.is_some()
        });
        if exists && root(value_at(p, &at)).is_none() {
            return true;
        }
        seen += u64::from(exists);
        if seen == SQUARES {
            break;
        }
    }
    false
}

fn value_at(p: &Poly, at: &[u64]) -> u64 {
    let terms = p.terms().map(|(mono, coeff)| {
        let factor = prime::residue::<ROOTS>(modulo::<ROOTS>(coeff));
        powers(mono).fold(factor, |value, (v, k)| {
            times::<ROOTS>(value, power::<ROOTS>(at[v], k.into()))
        })
    });
    terms.fold(0, add::<ROOTS>)
}

/// The root of a residue, if it has one; the prime is 3 modulo 4.
fn root(x: u64) -> Option<u64> {
    let root = power::<ROOTS>(x, prime::prime::<ROOTS>().div_ceil(4));
    (times::<ROOTS>(root, root) == x).then_some(root)
}

/// Whether a polynomial changes when angles, given by the variables of their cosines and sines, are turned together, each in
/// whatever sense: at one point it does, which is certain.
pub(super) fn changes_by_turning(p: &Poly, angles: &[(usize, usize)]) -> bool {
    let points = circle_points(angles.len());
    // Each angle's share in the change, as it is turned by itself.
    let mut rates = vec![0; angles.len()];
    for (mono, coeff) in p.terms() {
        let mut rest = residue(coeff);
        for (v, k) in powers(mono) {
            if angles.iter().all(|(c, s)| v != *c && v != *s) {
                let x = random::<PLAIN>(v as u64, 0);
                rest = times::<PLAIN>(rest, power::<PLAIN>(x, k.into()));
            }
        }
        let of = |k: usize| {
            let ((c, s), (x, y)) = (angles[k], points[k]);
            let (a, b) = (exponent(mono, c), exponent(mono, s));
            let at = |a: u32, b: u32| {
                times::<PLAIN>(power::<PLAIN>(x, a.into()), power::<PLAIN>(y, b.into()))
            };
            // cᵃ sᵇ and its derivative b cᵃ⁺¹ sᵇ⁻¹ − a cᵃ⁻¹ sᵇ⁺¹.
            let up = match b {
                0 => 0,
                _ => times::<PLAIN>(b.into(), at(a + 1, b - 1)),
            };
            let down = match a {
                0 => 0,
                _ => times::<PLAIN>(a.into(), at(a - 1, b + 1)),
            };
            (at(a, b), add::<PLAIN>(up, negative::<PLAIN>(down)))
        };
        let parts: Vec<(u64, u64)> = (0..angles.len()).map(of).collect();
        for (k, rate) in rates.iter_mut().enumerate() {
            let mut change = times::<PLAIN>(rest, parts[k].1);
            for (_, (value, _)) in parts.iter().enumerate().filter(|(j, _)| *j != k) {
                change = times::<PLAIN>(change, *value);
            }
            *rate = add::<PLAIN>(*rate, change);
        }
    }
    let Some((last, others)) = rates.split_last() else {
        return false;
    };
    (0..1_u32 << others.len()).all(|senses| {
        let signed = others
            .iter()
            .enumerate()
            .map(|(k, rate)| match senses >> k & 1 {
                1 => negative::<PLAIN>(*rate),
                _ => *rate,
            });
        signed.fold(*last, add::<PLAIN>) != 0
    })
}

/// Points of the unit circle: multiples of the angle with cosine 3/5 that are far apart.
fn circle_points(n: usize) -> Vec<(u64, u64)> {
    let fifth = ((4 * u128::from(prime::prime::<PLAIN>()) + 1) / 5) as u64;
    let first = (times::<PLAIN>(3, fifth), times::<PLAIN>(4, fifth));
    let turned = |(a, b): (u64, u64), (c, d): (u64, u64)| {
        let minus = negative::<PLAIN>(times::<PLAIN>(b, d));
        (
            add::<PLAIN>(times::<PLAIN>(a, c), minus),
            add::<PLAIN>(times::<PLAIN>(a, d), times::<PLAIN>(b, c)),
        )
    };
    let mut at = first;
    let next = |_| {
        // Eight times the angle before, and one more.
        (0..3).for_each(|_| at = turned(at, at));
        at = turned(at, first);
        at
    };
    (0..n).map(next).collect()
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
