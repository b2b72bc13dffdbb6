//! Monomials: exponents packed eight to a machine word, seven bits and a guard bit each.
//!
//! An exponent that would leave its field is an error, never a wrong monomial. What a variable stands for is the business of
//! [`super::field`].

use std::cmp::Ordering;

use smallvec::{SmallVec, smallvec};

use super::Stop;

/// The guard bit of every exponent field.
pub(crate) const GUARD: u64 = 0x8080_8080_8080_8080;
/// Variables per word.
pub(crate) const FIELDS: usize = 8;

/// A packed monomial; missing words at the end count as zero exponents. Two words cost no allocation.
pub(crate) type Mono = SmallVec<[u64; 2]>;

pub(crate) fn place(v: usize) -> (usize, u32) {
    (v / FIELDS, 56 - 8 * (v % FIELDS) as u32)
}

/// v raised to k < 128.
pub(crate) fn mono_of(v: usize, k: u32) -> Mono {
    let (word, shift) = place(v);
    let mut mono: Mono = smallvec![0; word + 1];
    mono[word] = u64::from(k) << shift;
    mono
}

pub(crate) fn exponent(mono: &[u64], v: usize) -> u32 {
    let (word, shift) = place(v);
    mono.get(word).map_or(0, |w| (w >> shift & 0x7f) as u32)
}

pub(crate) fn mono_is_one(mono: &[u64]) -> bool {
    mono.iter().all(|w| *w == 0)
}

/// The variables of a monomial, ascending.
pub(crate) fn mono_variables(mono: &[u64]) -> Vec<usize> {
    powers(mono).map(|(v, _)| v).collect()
}

/// The variables of a monomial with their exponents, ascending.
pub(crate) fn powers(mono: &[u64]) -> impl Iterator<Item = (usize, u32)> + '_ {
    mono.iter()
        .enumerate()
        .filter(|(_, word)| **word != 0)
        .flat_map(|(i, word)| {
            let mut left = *word;
            std::iter::from_fn(move || {
                (left != 0).then(|| {
                    let field = left.leading_zeros() as usize / 8;
                    let shift = 56 - 8 * field;
                    let k = (left >> shift & 0x7f) as u32;
                    left &= !(0xff << shift);
                    (i * FIELDS + field, k)
                })
            })
        })
}

/// Compares monomials of any lengths.
pub(crate) fn cmp_mono(a: &[u64], b: &[u64]) -> Ordering {
    let n = a.len().min(b.len());
    a[..n]
        .cmp(&b[..n])
        .then_with(|| match (mono_is_one(&a[n..]), mono_is_one(&b[n..])) {
            (false, true) => Ordering::Greater,
            (true, false) => Ordering::Less,
            _ => Ordering::Equal,
        })
}

pub(crate) fn mono_divides(a: &[u64], b: &[u64]) -> bool {
    a.iter()
        .enumerate()
        .all(|(i, w)| ((b.get(i).copied().unwrap_or(0) | GUARD) - w) & GUARD == GUARD)
}

/// a / b for a monomial b that divides a.
pub(crate) fn mono_div(a: &[u64], b: &[u64]) -> Mono {
    a.iter()
        .enumerate()
        .map(|(i, w)| w - b.get(i).copied().unwrap_or(0))
        .collect()
}

pub(crate) fn mono_add(a: &[u64], b: &[u64]) -> Result<Mono, Stop> {
    let word = |m: &[u64], i: usize| m.get(i).copied().unwrap_or(0);
    let sum: Mono = (0..a.len().max(b.len()))
        .map(|i| word(a, i) + word(b, i))
        .collect();
    if sum.iter().any(|w| w & GUARD != 0) {
        Err(Stop::TooLarge("degree"))
    } else {
        Ok(sum)
    }
}

pub(crate) fn mono_max(a: &[u64], b: &[u64]) -> Mono {
    let word = |m: &[u64], i: usize| m.get(i).copied().unwrap_or(0);
    (0..a.len().max(b.len()))
        .map(|i| word_max(word(a, i), word(b, i)))
        .collect()
}

pub(crate) fn mono_min(a: &[u64], b: &[u64]) -> Mono {
    a.iter().zip(b).map(|(x, y)| word_min(*x, *y)).collect()
}

/// Field-wise mask of the places where a ≥ b.
pub(crate) fn at_least(a: u64, b: u64) -> u64 {
    let guards = ((a | GUARD) - b) & GUARD;
    guards - (guards >> 7)
}

pub(crate) fn word_max(a: u64, b: u64) -> u64 {
    let mask = at_least(a, b);
    (a & mask) | (b & !mask & !GUARD)
}

pub(crate) fn word_min(a: u64, b: u64) -> u64 {
    let mask = at_least(a, b);
    (b & mask) | (a & !mask & !GUARD)
}
