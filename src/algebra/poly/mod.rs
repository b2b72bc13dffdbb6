//! Sparse polynomials over the integers in any number of variables.
//!
//! Monomials are stored flat; terms are kept in descending lexicographic order. Nothing here knows what a variable stands
//! for; relations between variables are the business of [`super::field`].

mod divide;
mod powers;

use std::borrow::Cow;
use std::cmp::Ordering;

use num_traits::{One, Signed, Zero};
use smallvec::{SmallVec, smallvec};

use crate::algebra::Stop;
use crate::algebra::mono::{GUARD, Mono, cmp_mono, mono_of};
use crate::expr::{Int, effort};

/// Most term products formed by one multiplication.
const MOST_PRODUCTS: usize = 400_000;
/// Most terms kept.
const MOST_TERMS: usize = 40_000;
/// Most products of terms in one division; what needs more counts as not divisible.
const MOST_TAKEN: usize = 1_000_000;
/// Most terms of a polynomial whose square root is looked for.
pub(crate) const MOST_UNDER_ROOT: usize = 2_000;
/// Most bits of a coefficient.
const MOST_BITS: u64 = 20_000;

/// A polynomial with integer coefficients. Invariant: terms strictly descending, no zero coefficient.
#[derive(Debug, Default)]
pub(crate) struct Poly {
    stride: usize,
    exps: Mono,
    coeffs: Coeffs,
}

/// Most polynomials are a single term, which costs no allocation.
type Coeffs = SmallVec<[Int; 1]>;

impl Clone for Poly {
    /// Words are copied at once; a derived clone takes them one by one.
    fn clone(&self) -> Poly {
        Poly {
            stride: self.stride,
            exps: Mono::from_slice(&self.exps),
            coeffs: match self.coeffs.as_slice() {
                [one] => smallvec![one.clone()],
                all => all.into(),
            },
        }
    }
}

impl Poly {
    pub fn zero() -> Poly {
        Poly::default()
    }

    pub fn constant(value: Int) -> Poly {
        Poly::term(&[], value)
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
            exps: Mono::from_slice(mono),
            coeffs: smallvec![coeff],
        }
    }

    /// The polynomial of terms that descend, of which none is zero.
    pub fn from_terms(terms: Vec<(Mono, Int)>) -> Poly {
        let stride = terms.iter().map(|(mono, _)| mono.len()).max().unwrap_or(0);
        let mut exps: Mono = smallvec![0; stride * terms.len()];
        for (i, (mono, _)) in terms.iter().enumerate() {
            exps[i * stride..i * stride + mono.len()].copy_from_slice(mono);
        }
        Poly {
            stride,
            exps,
            coeffs: terms.into_iter().map(|(_, coeff)| coeff).collect(),
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
        let all = self.coeffs.iter().enumerate();
        all.map(|(i, c)| (self.mono(i), c))
    }

    pub fn leading_is_negative(&self) -> bool {
        self.coeffs.first().is_some_and(Signed::is_negative)
    }

    fn widened(&self, stride: usize) -> Cow<'_, Poly> {
        if self.stride == stride {
            return Cow::Borrowed(self);
        }
        let mut exps: Mono = smallvec![0; stride * self.len()];
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
        self.each(|c| -c)
    }

    /// 1 − v².
    pub fn rest_of_square(v: usize) -> Poly {
        Poly::one().sub(&Poly::term(&mono_of(v, 2), Int::one()))
    }

    /// Without terms, whose monomials will have so many words.
    fn blank(stride: usize) -> Poly {
        Poly {
            stride,
            ..Poly::default()
        }
    }

    /// With changed coefficients, none of them zero.
    fn each(&self, f: impl Fn(&Int) -> Int) -> Poly {
        Poly {
            stride: self.stride,
            exps: self.exps.clone(),
            coeffs: self.coeffs.iter().map(f).collect(),
        }
    }

    pub fn add(&self, other: &Poly) -> Poly {
        self.combine(other, false)
    }

    pub fn sub(&self, other: &Poly) -> Poly {
        self.combine(other, true)
    }

    /// The sum, in place where all terms of the other one come behind.
    pub fn plus(mut self, other: Poly) -> Poly {
        let last = self.len().checked_sub(1);
        let behind = last.is_some_and(|last| {
            self.stride == other.stride && !other.is_zero() && self.mono(last) > other.mono(0)
        });
        if !behind {
            return self.add(&other);
        }
        self.exps.extend_from_slice(&other.exps);
        self.coeffs.extend(other.coeffs);
        self
    }

    fn combine(&self, other: &Poly, minus: bool) -> Poly {
        if other.is_zero() {
            return self.clone();
        }
        if self.is_zero() {
            return if minus { other.neg() } else { other.clone() };
        }
        // A sum is always given; what comes after it may find no steps left.
        effort::take(2 * (self.len() + other.len()) as u64);
        let (stride, a, b) = Poly::aligned(self, other);
        let mut out = Poly {
            stride,
            exps: Mono::with_capacity((a.len() + b.len()) * stride),
            coeffs: Coeffs::with_capacity(a.len() + b.len()),
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
                Ordering::Less if minus => (b.mono(j), -&b.coeffs[j]),
                Ordering::Less => (b.mono(j), b.coeffs[j].clone()),
                Ordering::Equal if minus => (a.mono(i), &a.coeffs[i] - &b.coeffs[j]),
                Ordering::Equal => (a.mono(i), &a.coeffs[i] + &b.coeffs[j]),
            };
            if !coeff.is_zero() {
                put(&mut out.exps, mono);
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
        self.each(|c| c * factor)
    }

    /// Division by an integer known to divide every coefficient.
    pub fn div_int(&self, divisor: &Int) -> Poly {
        if divisor.is_one() {
            return self.clone();
        }
        self.each(|c| c / divisor)
    }

    /// The polynomial with changed coefficients; terms that become zero vanish.
    pub fn map_coefficients(&self, f: impl Fn(&Int) -> Int) -> Poly {
        let mut out = Poly::blank(self.stride);
        for (mono, coeff) in self.terms() {
            let value = f(coeff);
            if !value.is_zero() {
                put(&mut out.exps, mono);
                out.coeffs.push(value);
            }
        }
        out
    }

    pub fn mul_term(&self, mono: &[u64], coeff: &Int) -> Result<Poly, Stop> {
        if self.is_zero() || coeff.is_zero() {
            return Ok(Poly::zero());
        }
        self.take_products(self.len(), coeff.bits())?;
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

    /// Bits of the largest coefficient.
    fn widest(&self) -> u64 {
        self.coeffs.iter().map(Int::bits).max().unwrap_or(0)
    }

    /// Takes the steps of that many products of a coefficient with a number of so many bits.
    fn take_products(&self, count: usize, bits: u64) -> Result<(), Stop> {
        let (mine, other) = (self.widest() / 64, bits / 64);
        let each = 4 + 2 * (mine + other) + mine * other / 100;
        match effort::take(count as u64 * each) {
            true => Ok(()),
            false => Err(Stop::TooLarge("steps")),
        }
    }

    pub fn mul(&self, other: &Poly) -> Result<Poly, Stop> {
        let (small, large) = match self.len() <= other.len() {
            true => (self, other),
            false => (other, self),
        };
        match small.len() {
            0 => return Ok(Poly::zero()),
            1 => return large.mul_term(small.mono(0), &small.coeffs[0]),
            2..=3 => {
                let mut total = large.mul_term(small.mono(0), &small.coeffs[0])?;
                for i in 1..small.len() {
                    total = total.plus(large.mul_term(small.mono(i), &small.coeffs[i])?);
                }
                return total.checked();
            }
            _ => {}
        }
        if small.len().saturating_mul(large.len()) > MOST_PRODUCTS {
            return Err(Stop::TooLarge("terms"));
        }
        large.take_products(small.len() * large.len(), small.widest())?;
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
                let sum = |rows: &[Poly]| match rows {
                    [x, y] => x.add(y),
                    rows => rows[0].clone(),
                };
                while rows.len() > 1 {
                    rows = rows.chunks(2).map(sum).collect();
                }
                rows.remove(0).checked()
            }
        }
    }

    fn checked(self) -> Result<Poly, Stop> {
        if self.len() > MOST_TERMS {
            return Err(Stop::TooLarge("terms"));
        }
        let long = |c: &Int| c.as_i64().is_none() && c.bits() > MOST_BITS;
        if self.coeffs.iter().any(long) {
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
        if self.widest().saturating_mul(u64::from(exponent)) > MOST_BITS {
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

/// Appends the words of a monomial, one or two of them mostly.
#[inline]
fn put(exps: &mut Mono, mono: &[u64]) {
    mono.iter().for_each(|word| exps.push(*word));
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
    let mut out = Poly::blank(S);
    let mut at = 0;
    while at < products.len() {
        let mono = products[at].0;
        let mut total = Int::zero();
        while at < products.len() && products[at].0 == mono {
            total += &a.coeffs[products[at].1 as usize] * &b.coeffs[products[at].2 as usize];
            at += 1;
        }
        if !total.is_zero() {
            put(&mut out.exps, &mono);
            out.coeffs.push(total);
        }
    }
    out.checked()
}
