//! Contents, exact quotients and square roots of polynomials.

use std::cmp::Ordering;

use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use super::{Coeffs, MOST_COPIED, MOST_TERMS, MOST_UNDER_ROOT, Poly, put};
use crate::algebra::image;
use crate::algebra::mono::{
    Mono, cmp_mono, mono_add, mono_div, mono_divides, mono_is_one, word_min,
};
use crate::expr::Int;

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
            if !self
                .coeffs
                .iter()
                .all(|c| c.is_multiple_of(&divisor.coeffs[0]))
                || !(0..self.len()).all(|i| mono_divides(divisor.mono(0), self.mono(i)))
            {
                return None;
            }
            return Some(self.div_mono(divisor.mono(0)).div_int(&divisor.coeffs[0]));
        }
        if !mono_divides(&divisor.degrees(), &self.degrees()) || image::refuses(divisor, self) {
            return None;
        }
        let stride = self.stride.max(divisor.stride);
        let (dividend, divisor) = (self.widened(stride), divisor.widened(stride));
        let smallest = dividend.mono(self.len() - 1);
        let (mut exps, mut coeffs) = (Mono::new(), Coeffs::new());
        // The remainder without its leading term is merged with the next multiple of the divisor, back and forth between
        // two buffers.
        let mut rest = dividend.clone().into_owned();
        let mut next = Poly {
            stride,
            exps: Mono::with_capacity(rest.exps.len()),
            coeffs: Coeffs::with_capacity(rest.len()),
        };
        let mut copied = 0;
        while !rest.is_zero() {
            copied += rest.len();
            if copied > MOST_COPIED {
                return None;
            }
            let (quotient, remainder) = rest.coeffs[0].div_rem(&divisor.coeffs[0]);
            if !remainder.is_zero()
                || !mono_divides(divisor.mono(0), rest.mono(0))
                || coeffs.len() > MOST_TERMS
            {
                return None;
            }
            let mono = mono_div(rest.mono(0), divisor.mono(0));
            // The quotient's terms times the divisor's last term stay above the dividend's last term.
            if cmp_mono(&mono_add(&mono, divisor.mono(last)).ok()?, smallest) == Ordering::Less {
                return None;
            }
            next.exps.clear();
            next.coeffs.clear();
            let mut i = 1;
            for j in 1..divisor.len() {
                let shifted = mono_add(&mono, divisor.mono(j)).ok()?;
                let taken = &quotient * &divisor.coeffs[j];
                while i < rest.len() && rest.mono(i) > shifted.as_slice() {
                    next.push(rest.mono(i), rest.coeffs[i].clone());
                    i += 1;
                }
                if i < rest.len() && rest.mono(i) == shifted.as_slice() {
                    next.push(&shifted, &rest.coeffs[i] - &taken);
                    i += 1;
                } else {
                    next.push(&shifted, -taken);
                }
            }
            for k in i..rest.len() {
                next.push(rest.mono(k), rest.coeffs[k].clone());
            }
            std::mem::swap(&mut rest, &mut next);
            put(&mut exps, &mono);
            coeffs.push(quotient);
        }
        Some(Poly {
            stride,
            exps,
            coeffs,
        })
    }

    /// Appends a term below the last one, unless its coefficient is zero.
    fn push(&mut self, mono: &[u64], coeff: Int) {
        if !coeff.is_zero() {
            put(&mut self.exps, mono);
            self.coeffs.push(coeff);
        }
    }

    /// The square root with positive leading coefficient, when the polynomial is a square.
    pub fn sqrt(&self) -> Option<Poly> {
        if self.len() > MOST_UNDER_ROOT {
            return None;
        }
        if self.is_zero() {
            return Some(Poly::zero());
        }
        let root = |c: &Int| -> Option<Int> {
            let r = if c.is_negative() {
                return None;
            } else {
                c.sqrt()
            };
            (&r * &r == *c).then_some(r)
        };
        let half = |m: &[u64]| {
            m.iter()
                .all(|w| w & 0x0101_0101_0101_0101 == 0)
                .then(|| m.iter().map(|w| w >> 1).collect::<Mono>())
        };
        half(self.mono(self.len() - 1))?;
        root(&self.coeffs[self.len() - 1])?;
        let lead = (half(self.mono(0))?, root(&self.coeffs[0])?);
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
