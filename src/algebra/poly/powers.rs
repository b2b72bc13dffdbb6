//! Polynomials by powers of one variable.

use num_traits::One;
use rustc_hash::FxHashMap;
use smallvec::smallvec;

use super::{Coeffs, Poly, put};
use crate::algebra::Stop;
use crate::algebra::mono::{Mono, exponent, mono_of, mono_variables, place, word_max};
use crate::expr::Int;

impl Poly {
    pub fn degree(&self, v: usize) -> u32 {
        let all = (0..self.len()).map(|i| exponent(self.mono(i), v));
        all.max().unwrap_or(0)
    }

    /// Highest exponent of every variable, packed.
    pub fn degrees(&self) -> Mono {
        let mut most: Mono = smallvec![0; self.stride];
        for i in 0..self.len() {
            for (a, b) in most.iter_mut().zip(self.mono(i)) {
                *a = word_max(*a, *b);
            }
        }
        most
    }

    /// The variables that occur, ascending.
    pub fn variables(&self) -> Vec<usize> {
        mono_variables(&self.degrees())
    }

    pub fn has(&self, v: usize) -> bool {
        (0..self.len()).any(|i| exponent(self.mono(i), v) > 0)
    }

    /// Coefficients of the powers of a variable, ascending, zeros included.
    pub fn by_power(&self, v: usize) -> Vec<Poly> {
        let mut out = vec![Poly::blank(self.stride); self.degree(v) as usize + 1];
        let (word, shift) = place(v);
        for (mono, coeff) in self.terms() {
            let target = &mut out[exponent(mono, v) as usize];
            let start = target.exps.len();
            put(&mut target.exps, mono);
            if word < mono.len() {
                target.exps[start + word] &= !(0x7f << shift);
            }
            target.coeffs.push(coeff.clone());
        }
        // Clearing one field of terms that agree in it keeps their order.
        out
    }

    /// The coefficients of the polynomial in all variables but some, as polynomials in these.
    pub fn coefficients(&self, some: &[usize]) -> Vec<Poly> {
        let mut mask: Mono = smallvec![0; self.stride];
        for v in some {
            let (word, shift) = place(*v);
            if let Some(mask) = mask.get_mut(word) {
                *mask |= 0xff << shift;
            }
        }
        let mut places: FxHashMap<Mono, usize> = FxHashMap::default();
        let mut out: Vec<Poly> = Vec::new();
        for (mono, coeff) in self.terms() {
            let outside = mono.iter().zip(&mask).map(|(w, m)| w & !m).collect();
            let at = *places.entry(outside).or_insert(out.len());
            if at == out.len() {
                out.push(Poly::blank(self.stride));
            }
            // Terms that agree in the others keep their order without them.
            let own = mono.iter().zip(&mask).map(|(w, m)| w & m);
            out[at].exps.extend(own);
            out[at].coeffs.push(coeff.clone());
        }
        out
    }

    /// The polynomial Σ parts\[k\]·vᵏ.
    pub fn from_powers(parts: &[Poly], v: usize) -> Result<Poly, Stop> {
        let mut total = Poly::zero();
        for (k, part) in parts.iter().enumerate() {
            if !part.is_zero() {
                if k > 127 {
                    return Err(Stop::TooLarge("degree"));
                }
                total = total.add(&part.mul_term(&mono_of(v, k as u32), &Int::one())?);
            }
        }
        Ok(total)
    }

    /// p = low + high·vⁿ where low has degree below n; `None` when high is zero.
    pub fn divide_by_power(&self, v: usize, n: u32) -> Option<(Poly, Poly)> {
        let is_high = |mono: &[u64]| exponent(mono, v) >= n;
        let count = self.terms().filter(|(m, _)| is_high(m)).count();
        if count == 0 {
            return None;
        }
        let (word, shift) = place(v);
        let part = |n: usize| Poly {
            stride: self.stride,
            exps: Mono::with_capacity(n * self.stride),
            coeffs: Coeffs::with_capacity(n),
        };
        let (mut low, mut high) = (part(self.len() - count), part(count));
        for (mono, coeff) in self.terms() {
            let target = if is_high(mono) { &mut high } else { &mut low };
            let start = target.exps.len();
            put(&mut target.exps, mono);
            if is_high(mono) {
                target.exps[start + word] -= u64::from(n) << shift;
            }
            target.coeffs.push(coeff.clone());
        }
        Some((low, high))
    }

    pub fn derivative(&self, v: usize) -> Poly {
        let (word, shift) = place(v);
        let mut out = Poly::blank(self.stride);
        for (mono, coeff) in self.terms() {
            let k = exponent(mono, v);
            if k > 0 {
                let start = out.exps.len();
                put(&mut out.exps, mono);
                out.exps[start + word] -= 1 << shift;
                out.coeffs.push(coeff * &Int::from(i64::from(k)));
            }
        }
        out
    }
}
