//! Sparse polynomials over the integers in any number of variables.
//!
//! Monomials are stored flat; terms are kept in descending lexicographic order. Nothing here knows what a variable stands
//! for; relations between variables are the business of [`super::field`].

use std::borrow::Cow;
use std::cmp::Ordering;

use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use super::Stop;
use super::mono::{
    GUARD, Mono, cmp_mono, exponent, mono_add, mono_div, mono_divides, mono_is_one, mono_of,
    mono_variables, place, word_max, word_min,
};
use crate::expr::Int;

/// Most term products formed by one multiplication.
const MOST_PRODUCTS: usize = 400_000;
/// Most terms kept.
const MOST_TERMS: usize = 40_000;
/// Most terms moved by one division; what needs more counts as not divisible.
const MOST_COPIED: usize = 1_000_000;
/// Most terms of a polynomial whose square root is looked for.
pub(crate) const MOST_UNDER_ROOT: usize = 2_000;
/// Most bits of a coefficient.
const MOST_BITS: u64 = 20_000;

/// A polynomial with integer coefficients. Invariant: terms strictly descending, no zero coefficient.
#[derive(Clone, Debug, Default)]
pub(crate) struct Poly {
    stride: usize,
    exps: Vec<u64>,
    coeffs: Vec<Int>,
}

impl Poly {
    pub fn zero() -> Poly {
        Poly::default()
    }

    pub fn constant(value: Int) -> Poly {
        if value.is_zero() {
            Poly::zero()
        } else {
            Poly {
                stride: 0,
                exps: Vec::new(),
                coeffs: vec![value],
            }
        }
    }

    pub fn one() -> Poly {
        Poly::constant(Int::one())
    }

    pub fn var(v: usize) -> Poly {
        Poly::term(&mono_of(v, 1), Int::one())
    }

    pub fn term(mono: &[u64], coeff: Int) -> Poly {
        if coeff.is_zero() {
            return Poly::zero();
        }
        Poly {
            stride: mono.len(),
            exps: mono.to_vec(),
            coeffs: vec![coeff],
        }
    }

    pub fn len(&self) -> usize {
        self.coeffs.len()
    }

    pub fn is_zero(&self) -> bool {
        self.coeffs.is_empty()
    }

    pub fn is_one(&self) -> bool {
        self.as_constant().is_some_and(One::is_one)
    }

    /// The value of a nonzero constant.
    pub fn as_constant(&self) -> Option<&Int> {
        (self.len() == 1 && self.exps.iter().all(|w| *w == 0)).then(|| &self.coeffs[0])
    }

    pub fn is_constant(&self) -> bool {
        self.is_zero() || self.as_constant().is_some()
    }

    pub fn mono(&self, i: usize) -> &[u64] {
        &self.exps[i * self.stride..(i + 1) * self.stride]
    }

    pub fn coeff(&self, i: usize) -> &Int {
        &self.coeffs[i]
    }

    pub fn terms(&self) -> impl Iterator<Item = (&[u64], &Int)> {
        self.coeffs
            .iter()
            .enumerate()
            .map(|(i, c)| (self.mono(i), c))
    }

    pub fn leading_is_negative(&self) -> bool {
        self.coeffs.first().is_some_and(Signed::is_negative)
    }

    fn widened(&self, stride: usize) -> Cow<'_, Poly> {
        if self.stride == stride {
            return Cow::Borrowed(self);
        }
        let mut exps = vec![0; stride * self.len()];
        for i in 0..self.len() {
            exps[i * stride..i * stride + self.stride].copy_from_slice(self.mono(i));
        }
        Cow::Owned(Poly {
            stride,
            exps,
            coeffs: self.coeffs.clone(),
        })
    }

    fn aligned<'a>(a: &'a Poly, b: &'a Poly) -> (usize, Cow<'a, Poly>, Cow<'a, Poly>) {
        let stride = a.stride.max(b.stride);
        (stride, a.widened(stride), b.widened(stride))
    }

    pub fn neg(&self) -> Poly {
        Poly {
            stride: self.stride,
            exps: self.exps.clone(),
            coeffs: self.coeffs.iter().map(|c| -c).collect(),
        }
    }

    pub fn add(&self, other: &Poly) -> Poly {
        self.combine(other, false)
    }

    pub fn sub(&self, other: &Poly) -> Poly {
        self.combine(other, true)
    }

    fn combine(&self, other: &Poly, minus: bool) -> Poly {
        if other.is_zero() {
            return self.clone();
        }
        if self.is_zero() {
            return if minus { other.neg() } else { other.clone() };
        }
        let (stride, a, b) = Poly::aligned(self, other);
        let mut out = Poly {
            stride,
            exps: Vec::with_capacity((a.len() + b.len()) * stride),
            coeffs: Vec::with_capacity(a.len() + b.len()),
        };
        let (mut i, mut j) = (0, 0);
        while i < a.len() || j < b.len() {
            let order = match (i < a.len(), j < b.len()) {
                (true, true) => a.mono(i).cmp(b.mono(j)),
                (true, false) => Ordering::Greater,
                _ => Ordering::Less,
            };
            let (mono, coeff) = match order {
                Ordering::Greater => (a.mono(i), a.coeffs[i].clone()),
                Ordering::Less => (
                    b.mono(j),
                    if minus {
                        -&b.coeffs[j]
                    } else {
                        b.coeffs[j].clone()
                    },
                ),
                Ordering::Equal if minus => (a.mono(i), &a.coeffs[i] - &b.coeffs[j]),
                Ordering::Equal => (a.mono(i), &a.coeffs[i] + &b.coeffs[j]),
            };
            if !coeff.is_zero() {
                out.exps.extend_from_slice(mono);
                out.coeffs.push(coeff);
            }
            i += usize::from(order != Ordering::Less);
            j += usize::from(order != Ordering::Greater);
        }
        out
    }

    pub fn scale(&self, factor: &Int) -> Poly {
        if factor.is_zero() {
            return Poly::zero();
        }
        if factor.is_one() {
            return self.clone();
        }
        Poly {
            stride: self.stride,
            exps: self.exps.clone(),
            coeffs: self.coeffs.iter().map(|c| c * factor).collect(),
        }
    }

    /// Division by an integer known to divide every coefficient.
    pub fn div_int(&self, divisor: &Int) -> Poly {
        if divisor.is_one() {
            return self.clone();
        }
        Poly {
            stride: self.stride,
            exps: self.exps.clone(),
            coeffs: self.coeffs.iter().map(|c| c / divisor).collect(),
        }
    }

    /// The polynomial with changed coefficients; terms that become zero vanish.
    pub fn map_coefficients(&self, f: impl Fn(&Int) -> Int) -> Poly {
        let mut out = Poly {
            stride: self.stride,
            ..Poly::default()
        };
        for (mono, coeff) in self.terms() {
            let value = f(coeff);
            if !value.is_zero() {
                out.exps.extend_from_slice(mono);
                out.coeffs.push(value);
            }
        }
        out
    }

    pub fn mul_term(&self, mono: &[u64], coeff: &Int) -> Result<Poly, Stop> {
        if self.is_zero() || coeff.is_zero() {
            return Ok(Poly::zero());
        }
        let stride = self.stride.max(mono.len());
        let mut out = self.widened(stride).into_owned();
        for i in 0..out.len() {
            for (k, word) in mono.iter().enumerate() {
                let place = &mut out.exps[i * stride + k];
                *place += word;
                if *place & GUARD != 0 {
                    return Err(Stop::TooLarge("degree"));
                }
            }
        }
        if !coeff.is_one() {
            out.coeffs.iter_mut().for_each(|c| *c *= coeff);
        }
        Ok(out)
    }

    pub fn mul(&self, other: &Poly) -> Result<Poly, Stop> {
        let (small, large) = if self.len() <= other.len() {
            (self, other)
        } else {
            (other, self)
        };
        match small.len() {
            0 => return Ok(Poly::zero()),
            1 => return large.mul_term(small.mono(0), &small.coeffs[0]),
            2..=3 => {
                let mut total = large.mul_term(small.mono(0), &small.coeffs[0])?;
                for i in 1..small.len() {
                    total = total.add(&large.mul_term(small.mono(i), &small.coeffs[i])?);
                }
                return total.checked();
            }
            _ => {}
        }
        if small.len().saturating_mul(large.len()) > MOST_PRODUCTS {
            return Err(Stop::TooLarge("terms"));
        }
        let (stride, a, b) = Poly::aligned(small, large);
        match stride {
            0 | 1 => mul_sorting::<1>(&a, &b),
            2 => mul_sorting::<2>(&a, &b),
            3 => mul_sorting::<3>(&a, &b),
            4 => mul_sorting::<4>(&a, &b),
            _ => {
                // Rare: more than 32 variables. Rows are summed pairwise.
                let mut rows = (0..a.len())
                    .map(|i| b.mul_term(a.mono(i), &a.coeffs[i]))
                    .collect::<Result<Vec<_>, _>>()?;
                while rows.len() > 1 {
                    rows = rows
                        .chunks(2)
                        .map(|c| {
                            if let [x, y] = c {
                                x.add(y)
                            } else {
                                c[0].clone()
                            }
                        })
                        .collect();
                }
                rows.remove(0).checked()
            }
        }
    }

    fn checked(self) -> Result<Poly, Stop> {
        if self.len() > MOST_TERMS {
            return Err(Stop::TooLarge("terms"));
        }
        if self
            .coeffs
            .iter()
            .any(|c| c.as_i64().is_none() && c.bits() > MOST_BITS)
        {
            return Err(Stop::TooLarge("digits"));
        }
        Ok(self)
    }

    pub fn pow(&self, exponent: u32) -> Result<Poly, Stop> {
        if exponent == 0 {
            return Ok(Poly::one());
        }
        if self.len() > 1 && exponent > 127 {
            return Err(Stop::TooLarge("degree"));
        }
        if self
            .coeffs
            .iter()
            .map(Int::bits)
            .max()
            .unwrap_or(0)
            .saturating_mul(u64::from(exponent))
            > MOST_BITS
        {
            return Err(Stop::TooLarge("digits"));
        }
        let mut result = self.clone();
        for bit in (0..exponent.ilog2()).rev() {
            result = result.mul(&result)?;
            if exponent >> bit & 1 == 1 {
                result = result.mul(self)?;
            }
        }
        result.checked()
    }

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
        let mut least = self.mono(0).to_vec();
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
        if !mono_divides(&divisor.degrees(), &self.degrees()) {
            return None;
        }
        let stride = self.stride.max(divisor.stride);
        let (dividend, divisor) = (self.widened(stride), divisor.widened(stride));
        let smallest = dividend.mono(self.len() - 1);
        let (mut exps, mut coeffs) = (Vec::new(), Vec::new());
        // The remainder without its leading term is merged with the next multiple of the divisor, back and forth between
        // two buffers.
        let mut rest = dividend.clone().into_owned();
        let mut next = Poly {
            stride,
            exps: Vec::with_capacity(rest.exps.len()),
            coeffs: Vec::with_capacity(rest.len()),
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
            exps.extend_from_slice(&mono);
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
            self.exps.extend_from_slice(mono);
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

    pub fn degree(&self, v: usize) -> u32 {
        (0..self.len())
            .map(|i| exponent(self.mono(i), v))
            .max()
            .unwrap_or(0)
    }

    /// Highest exponent of every variable, packed.
    pub fn degrees(&self) -> Mono {
        let mut most = vec![0; self.stride];
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
        let mut out = vec![
            Poly {
                stride: self.stride,
                ..Poly::default()
            };
            self.degree(v) as usize + 1
        ];
        let (word, shift) = place(v);
        for (mono, coeff) in self.terms() {
            let target = &mut out[exponent(mono, v) as usize];
            let start = target.exps.len();
            target.exps.extend_from_slice(mono);
            if word < mono.len() {
                target.exps[start + word] &= !(0x7f << shift);
            }
            target.coeffs.push(coeff.clone());
        }
        // Clearing one field of terms that agree in it keeps their order.
        out
    }

    /// The polynomial Σ parts\[k\]·vᵏ.
    pub fn from_powers(parts: &[Poly], v: usize) -> Result<Poly, Stop> {
        let mut total = Poly::zero();
        for (k, part) in parts.iter().enumerate() {
            if !part.is_zero() {
                let k = u32::try_from(k)
                    .ok()
                    .filter(|k| *k < 128)
                    .ok_or(Stop::TooLarge("degree"))?;
                total = total.add(&part.mul_term(&mono_of(v, k), &Int::one())?);
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
            exps: Vec::with_capacity(n * self.stride),
            coeffs: Vec::with_capacity(n),
        };
        let (mut low, mut high) = (part(self.len() - count), part(count));
        for (mono, coeff) in self.terms() {
            let target = if is_high(mono) { &mut high } else { &mut low };
            let start = target.exps.len();
            target.exps.extend_from_slice(mono);
            if is_high(mono) {
                target.exps[start + word] -= u64::from(n) << shift;
            }
            target.coeffs.push(coeff.clone());
        }
        Some((low, high))
    }

    pub fn derivative(&self, v: usize) -> Poly {
        let (word, shift) = place(v);
        let mut out = Poly {
            stride: self.stride,
            ..Poly::default()
        };
        for (mono, coeff) in self.terms() {
            let k = exponent(mono, v);
            if k > 0 {
                let start = out.exps.len();
                out.exps.extend_from_slice(mono);
                out.exps[start + word] -= 1 << shift;
                out.coeffs.push(coeff * &Int::from(i64::from(k)));
            }
        }
        out
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

impl PartialEq for Poly {
    fn eq(&self, other: &Poly) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Poly {}

impl PartialOrd for Poly {
    fn partial_cmp(&self, other: &Poly) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Fewer terms first, then by monomials and coefficients from the leading term on.
impl Ord for Poly {
    fn cmp(&self, other: &Poly) -> Ordering {
        self.len().cmp(&other.len()).then_with(|| {
            for i in 0..self.len() {
                let order = cmp_mono(self.mono(i), other.mono(i))
                    .then_with(|| self.coeffs[i].cmp(&other.coeffs[i]));
                if order != Ordering::Equal {
                    return order;
                }
            }
            Ordering::Equal
        })
    }
}

fn mul_sorting<const S: usize>(a: &Poly, b: &Poly) -> Result<Poly, Stop> {
    let mut products: Vec<([u64; S], u32, u32)> = Vec::with_capacity(a.len() * b.len());
    for i in 0..a.len() {
        let mut left = [0; S];
        left[..a.stride].copy_from_slice(a.mono(i));
        for j in 0..b.len() {
            let mut mono = left;
            for (place, word) in mono.iter_mut().zip(b.mono(j)) {
                *place += word;
                if *place & GUARD != 0 {
                    return Err(Stop::TooLarge("degree"));
                }
            }
            products.push((mono, i as u32, j as u32));
        }
    }
    products.sort_unstable_by_key(|product| std::cmp::Reverse(product.0));
    let mut out = Poly {
        stride: S,
        exps: Vec::new(),
        coeffs: Vec::new(),
    };
    let mut at = 0;
    while at < products.len() {
        let mono = products[at].0;
        let mut total = Int::zero();
        while at < products.len() && products[at].0 == mono {
            total += &a.coeffs[products[at].1 as usize] * &b.coeffs[products[at].2 as usize];
            at += 1;
        }
        if !total.is_zero() {
            out.exps.extend_from_slice(&mono);
            out.coeffs.push(total);
        }
    }
    out.checked()
}
