//! Contents, exact quotients and square roots of polynomials.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use num_integer::Integer;
use num_traits::{One, Zero};

use super::{MOST_TAKEN, MOST_TERMS, MOST_UNDER_ROOT, Poly, put};
use crate::algebra::image;
use crate::algebra::mono::{
    Mono, cmp_mono, mono_add, mono_div, mono_divides, mono_is_one, word_min,
};
use crate::expr::{Int, effort};

impl Poly {
    /// Greatest common divisor of the coefficients, non-negative.
    pub fn content(&self) -> Int {
        let mut g = Int::zero();
        for c in &self.coeffs {
            g = g.gcd(c);
            if g.is_one() {
                break;
            }
        }
        g
    }

    /// Greatest monomial that divides every term.
    pub fn mono_content(&self) -> Mono {
        if self.is_zero() {
            return Mono::new();
        }
        let mut least = Mono::from_slice(self.mono(0));
        for i in 1..self.len() {
            for (a, b) in least.iter_mut().zip(self.mono(i)) {
                *a = word_min(*a, *b);
            }
        }
        least
    }

    /// Division by a monomial known to divide every term.
    pub fn div_mono(&self, mono: &[u64]) -> Poly {
        let mut out = self.clone();
        for i in 0..out.len() {
            for (k, word) in mono.iter().enumerate().take(self.stride) {
                out.exps[i * self.stride + k] -= word;
            }
        }
        out
    }

    /// The quotient, when `divisor` (not zero) divides exactly.
    pub fn try_div(&self, divisor: &Poly) -> Option<Poly> {
        if self.is_zero() {
            return Some(Poly::zero());
        }
        let last = divisor.len() - 1;
        // Cheap refusals first: nearly all trials fail.
        if !mono_divides(divisor.mono(0), self.mono(0))
            || !mono_divides(divisor.mono(last), self.mono(self.len() - 1))
            || !self.coeffs[0].is_multiple_of(&divisor.coeffs[0])
            || !self.coeffs[self.len() - 1].is_multiple_of(&divisor.coeffs[last])
        {
            return None;
        }
        if last == 0 {
            let (mono, coeff) = (divisor.mono(0), &divisor.coeffs[0]);
            let divides = |(m, c): (&[u64], &Int)| c.is_multiple_of(coeff) && mono_divides(mono, m);
            let all = self.terms().all(divides);
            return all.then(|| self.div_mono(mono).div_int(coeff));
        }
        if !mono_divides(&divisor.degrees(), &self.degrees()) || image::refuses(divisor, self) {
            return None;
        }
        let stride = self.stride.max(divisor.stride);
        let (dividend, divisor) = (self.widened(stride), divisor.widened(stride));
        let smallest = dividend.mono(self.len() - 1);
        let mut out = Poly::blank(stride);
        // For each term of the divisor its next product with a term of the quotient, the highest on top (Johnson 1974);
        // `waiting` has come to the end of what is known of the quotient.
        let mut products: BinaryHeap<(Mono, usize, usize)> = BinaryHeap::with_capacity(last);
        let mut waiting: Vec<usize> = (1..divisor.len()).collect();
        let (mut taken, mut at) = (0, 0);
        loop {
            let top = products.peek().map(|(mono, ..)| mono.as_slice());
            let own = (at < dividend.len()).then(|| dividend.mono(at));
            let Some(mono) = top.max(own).map(Mono::from_slice) else {
                return Some(out);
            };
            let mut coeff = Int::zero();
            if own == Some(mono.as_slice()) {
                coeff = dividend.coeffs[at].clone();
                at += 1;
            }
            while let Some((_, j, k)) = products.peek().filter(|(m, ..)| *m == mono) {
                let (j, k) = (*j, *k);
                products.pop();
                coeff -= &out.coeffs[k] * &divisor.coeffs[j];
                match k + 1 < out.len() {
                    true => {
                        let next = mono_add(out.mono(k + 1), divisor.mono(j)).ok()?;
                        products.push((next, j, k + 1));
                    }
                    false => waiting.push(j),
                }
                taken += 1;
            }
            if coeff.is_zero() {
                continue;
            }
            let (quotient, remainder) = coeff.div_rem(&divisor.coeffs[0]);
            if !remainder.is_zero()
                || !mono_divides(divisor.mono(0), &mono)
                || out.len() > MOST_TERMS
                || taken > MOST_TAKEN
                || !effort::take(10 * divisor.len() as u64)
            {
                return None;
            }
            let mono = mono_div(&mono, divisor.mono(0));
            // The quotient's terms times the divisor's last term stay above the dividend's last term.
            if cmp_mono(&mono_add(&mono, divisor.mono(last)).ok()?, smallest) == Ordering::Less {
                return None;
            }
            for j in waiting.drain(..) {
                let next = mono_add(&mono, divisor.mono(j)).ok()?;
                products.push((next, j, out.len()));
            }
            out.push(&mono, quotient);
        }
    }

    /// Appends a term below the last one.
    fn push(&mut self, mono: &[u64], coeff: Int) {
        put(&mut self.exps, mono);
        self.coeffs.push(coeff);
    }

    /// The square root with positive leading coefficient, when the polynomial is a square.
    pub fn sqrt(&self) -> Option<Poly> {
        if self.len() > MOST_UNDER_ROOT {
            return None;
        }
        if self.is_zero() {
            return Some(Poly::zero());
        }
        let half = |m: &[u64]| {
            m.iter()
                .all(|w| w & 0x0101_0101_0101_0101 == 0)
                .then(|| m.iter().map(|w| w >> 1).collect::<Mono>())
        };
        half(self.mono(self.len() - 1))?;
        self.coeffs[self.len() - 1].square_root()?;
        let lead = (half(self.mono(0))?, self.coeffs[0].square_root()?);
        let twice = &lead.1 * &Int::from(2);
        let mut out = Poly::term(&lead.0, lead.1.clone());
        let mut rest = self.sub(&out.mul(&out).ok()?);
        while !rest.is_zero() {
            let (quotient, remainder) = rest.coeffs[0].div_rem(&twice);
            if !remainder.is_zero() || !mono_divides(&lead.0, rest.mono(0)) || out.len() > 2_000 {
                return None;
            }
            let mono = mono_div(rest.mono(0), &lead.0);
            if cmp_mono(&mono, out.mono(out.len() - 1)) != Ordering::Less {
                return None;
            }
            let next = Poly::term(&mono, quotient);
            let cross = out.add(&out).add(&next);
            rest = rest.sub(&cross.mul(&next).ok()?);
            out = out.add(&next);
        }
        Some(out)
    }

    /// Splits off content, sign and monomial: self = content · mono · rest, `rest` primitive with positive leading coefficient.
    pub fn split(&self) -> (Int, Mono, Poly) {
        let mut content = self.content();
        if self.leading_is_negative() {
            content = -content;
        }
        let mono = self.mono_content();
        if content.is_one() && mono_is_one(&mono) {
            return (content, mono, self.clone());
        }
        let rest = self.div_mono(&mono).div_int(&content);
        (content, mono, rest)
    }
}
