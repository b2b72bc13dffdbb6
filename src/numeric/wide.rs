//! Integers of a fixed greatest width on the stack, for exact elimination without allocation.
//!
//! Sign and magnitude in words of 64 bits, lowest first. What does not fit gives `None`, and the caller turns to integers
//! without limit.

use std::cmp::Ordering;

use num_bigint::{BigInt, Sign};

/// An integer of at most 64·N bits. Words from `len` on are zero, the word before is not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wide<const N: usize> {
    negative: bool,
    len: usize,
    words: [u64; N],
}

impl<const N: usize> Wide<N> {
    /// Zero.
    pub const ZERO: Wide<N> = Wide {
        negative: false,
        len: 0,
        words: [0; N],
    };

    /// ± a machine word.
    pub fn small(negative: bool, size: u64) -> Wide<N> {
        let mut words = [0; N];
        words[0] = size;
        Wide {
            negative: negative && size != 0,
            len: usize::from(size != 0),
            words,
        }
    }

    /// Whether it is zero.
    pub fn is_zero(&self) -> bool {
        self.len == 0
    }

    /// Whether it is below zero.
    pub fn is_negative(&self) -> bool {
        self.negative
    }

    /// The integer with the other sign.
    pub fn negated(mut self) -> Wide<N> {
        self.negative = !self.negative && self.len != 0;
        self
    }

    /// Bits of the absolute value.
    pub fn bits(&self) -> usize {
        match self.len {
            0 => 0,
            len => 64 * len - self.words[len - 1].leading_zeros() as usize,
        }
    }

    /// How often 2 divides it; 0 for zero.
    pub fn twos(&self) -> usize {
        match self.words[..self.len].iter().position(|w| *w != 0) {
            Some(i) => 64 * i + self.words[i].trailing_zeros() as usize,
            None => 0,
        }
    }

    /// The same integer in another width.
    pub fn resized<const M: usize>(&self) -> Option<Wide<M>> {
        if self.len > M {
            return None;
        }
        let mut words = [0; M];
        words[..self.len].copy_from_slice(&self.words[..self.len]);
        Some(Wide {
            negative: self.negative,
            len: self.len,
            words,
        })
    }

    /// The integer without limit of size.
    pub fn to_bigint(&self) -> BigInt {
        let halves = self.words[..self.len]
            .iter()
            .flat_map(|w| [*w as u32, (w >> 32) as u32]);
        let sign = if self.negative {
            Sign::Minus
        } else {
            Sign::Plus
        };
        BigInt::new(sign, halves.collect())
    }

    fn trim(mut self) -> Wide<N> {
        self.trim_in_place();
        self
    }

    fn trim_in_place(&mut self) {
        while self.len > 0 && self.words[self.len - 1] == 0 {
            self.len -= 1;
        }
        self.negative &= self.len != 0;
    }

    fn compare_sizes(&self, other: &Wide<N>) -> Ordering {
        let words = || {
            self.words[..self.len]
                .iter()
                .rev()
                .cmp(other.words[..other.len].iter().rev())
        };
        self.len.cmp(&other.len).then_with(words)
    }

    /// Sum.
    pub fn add(&self, other: &Wide<N>) -> Option<Wide<N>> {
        let mut sum = *self;
        sum.add_assign(other).then_some(sum)
    }

    /// Adds in place; false where the sum does not fit.
    pub fn add_assign(&mut self, other: &Wide<N>) -> bool {
        if self.negative == other.negative {
            return self.grow(other);
        }
        match self.compare_sizes(other) {
            Ordering::Less => {
                let words = self.words.iter_mut().zip(&other.words);
                subtract(words.take(other.len).map(|(cell, &b)| {
                    let a = *cell;
                    (cell, b, a)
                }));
                (self.negative, self.len) = (other.negative, other.len);
            }
            _ => {
                let words = self.words[..self.len].iter_mut().zip(&other.words);
                subtract(words.map(|(cell, &b)| {
                    let a = *cell;
                    (cell, a, b)
                }));
            }
        }
        self.trim_in_place();
        true
    }

    /// Adds the size of another number.
    fn grow(&mut self, other: &Wide<N>) -> bool {
        let mut carry = false;
        let (long, short) = (self.len.max(other.len), other.len);
        for i in 0..long {
            if i >= short && !carry {
                break;
            }
            let (a, c) = self.words[i].overflowing_add(other.words[i]);
            let (b, d) = a.overflowing_add(u64::from(carry));
            self.words[i] = b;
            carry = c | d;
        }
        self.len = long;
        if !carry {
            return true;
        }
        match self.words.get_mut(long) {
            Some(cell) => *cell = 1,
            None => return false,
        }
        self.len += 1;
        true
    }

    /// Product.
    #[inline]
    pub fn mul(&self, other: &Wide<N>) -> Option<Wide<N>> {
        let mut product = Wide::ZERO;
        self.mul_into(other, &mut product).then_some(product)
    }

    /// The product into a number that is zero; false where it does not fit.
    #[inline]
    pub fn mul_into(&self, other: &Wide<N>, product: &mut Wide<N>) -> bool {
        // Two numbers of k and l bits make one of k + l − 1 bits at least.
        if self.len + other.len > N && self.bits() + other.bits() > 64 * N {
            return false;
        }
        // Numbers of far apart sizes, once added, are mostly zeros.
        let (outer, inner) = match self.len >= other.len {
            true => (self, other),
            false => (other, self),
        };
        for (i, &a) in outer.words[..outer.len].iter().enumerate() {
            if a == 0 {
                continue;
            }
            let mut carry = 0u64;
            let end = (i + inner.len).min(N);
            for (cell, &b) in product.words[i..end].iter_mut().zip(&inner.words) {
                let wide = u128::from(a) * u128::from(b) + u128::from(*cell) + u128::from(carry);
                *cell = wide as u64;
                carry = (wide >> 64) as u64;
            }
            match product.words.get_mut(i + inner.len) {
                Some(cell) => *cell = carry,
                None if carry == 0 => {}
                None => return false,
            }
        }
        product.len = (self.len + other.len).min(N);
        product.negative = self.negative != other.negative;
        product.trim_in_place();
        true
    }

    /// 2^by times the integer.
    pub fn shifted_up(&self, by: usize) -> Option<Wide<N>> {
        let mut up = Wide::ZERO;
        self.shift_into(by, &mut up).then_some(up)
    }

    /// 2^by times the integer into a number that is zero; false where it does not fit.
    #[inline]
    pub fn shift_into(&self, by: usize, up: &mut Wide<N>) -> bool {
        if self.len == 0 || self.bits() + by > 64 * N {
            return self.len == 0;
        }
        let (words, bits) = (by / 64, by % 64);
        up.negative = self.negative;
        up.len = (self.len + words + 1).min(N);
        if bits == 0 {
            up.words[words..words + self.len].copy_from_slice(&self.words[..self.len]);
        } else {
            let mut spill = 0;
            for (cell, &word) in up.words[words..].iter_mut().zip(&self.words[..self.len]) {
                *cell = word << bits | spill;
                spill = word >> (64 - bits);
            }
            if let Some(cell) = up.words.get_mut(words + self.len) {
                *cell = spill;
            }
        }
        up.trim_in_place();
        true
    }

    /// The integer divided by 2^by, towards zero.
    pub fn shifted_down(&self, by: usize) -> Wide<N> {
        if by == 0 {
            return *self;
        }
        let (words, bits) = (by / 64, by % 64);
        let mut down = Wide {
            negative: self.negative,
            ..Wide::ZERO
        };
        for i in words..self.len {
            let above = if bits == 0 || i + 1 >= self.len {
                0
            } else {
                self.words[i + 1] << (64 - bits)
            };
            down.words[i - words] = self.words[i] >> bits | above;
        }
        down.len = self.len.saturating_sub(words);
        down.trim()
    }

    /// a·b ± c·d on one accumulator, `None` where a product or the outcome does not fit.
    pub fn products(
        a: &Wide<N>,
        b: &Wide<N>,
        subtract: bool,
        c: &Wide<N>,
        d: &Wide<N>,
    ) -> Option<Wide<N>> {
        let mut sum = a.mul(b)?;
        if c.len == 0 || d.len == 0 {
            return Some(sum);
        }
        // One word is kept for the carry, or the borrow that tells the sign.
        if c.len + d.len >= N || sum.len >= N {
            let product = c.mul(d)?;
            return sum.add(&if subtract { product.negated() } else { product });
        }
        let top = sum.len.max(c.len + d.len);
        let sign = (c.negative != d.negative) != subtract;
        if sum.len == 0 {
            sum.negative = sign;
        }
        let alike = sign == sum.negative;
        for (i, &x) in c.words[..c.len].iter().enumerate() {
            let mut carry = 0u64;
            for (cell, &y) in sum.words[i..].iter_mut().zip(&d.words[..d.len]) {
                let wide = u128::from(x) * u128::from(y) + u128::from(carry);
                let (word, over) = match alike {
                    true => cell.overflowing_add(wide as u64),
                    false => cell.overflowing_sub(wide as u64),
                };
                *cell = word;
                carry = (wide >> 64) as u64 + u64::from(over);
            }
            for cell in &mut sum.words[i + d.len..=top] {
                if carry == 0 {
                    break;
                }
                let (word, over) = match alike {
                    true => cell.overflowing_add(carry),
                    false => cell.overflowing_sub(carry),
                };
                *cell = word;
                carry = u64::from(over);
            }
        }
        if !alike && sum.words[top] != 0 {
            // Below zero: the complement is the size.
            let mut carry = true;
            for word in &mut sum.words[..=top] {
                let (flipped, over) = (!*word).overflowing_add(u64::from(carry));
                *word = flipped;
                carry = over;
            }
            sum.negative = !sum.negative;
        }
        sum.len = top + 1;
        Some(sum.trim())
    }

    /// The quotient where `divisor` is known to divide the integer: from the lowest word up (Jebelean 1993).
    pub fn divided_exactly(mut self, divisor: &Wide<N>) -> Wide<N> {
        if self.len == 0 || divisor.len == 0 {
            return Wide::ZERO;
        }
        let negative = self.negative != divisor.negative;
        if divisor.len == 1 && divisor.words[0] == 1 {
            self.negative = negative;
            return self;
        }
        let twos = divisor.twos();
        if twos != 0 {
            return self
                .shifted_down(twos)
                .divided_by_odd(&divisor.shifted_down(twos), negative);
        }
        self.divided_by_odd(divisor, negative)
    }

    /// The quotient where `divisor` divides the integer, `None` where it does not.
    pub fn divided_if_exact(&self, divisor: &Wide<N>) -> Option<Wide<N>> {
        if self.bits() < divisor.bits() || self.twos() < divisor.twos() {
            return self.is_zero().then_some(Wide::ZERO);
        }
        let quotient = self.divided_exactly(divisor);
        // A quotient modulo 2⁶⁴ᵏ that is none is nearly always too long.
        let bits = quotient.bits() + divisor.bits();
        if bits != self.bits() && bits != self.bits() + 1 {
            return None;
        }
        (quotient.mul(divisor)? == *self).then_some(quotient)
    }

    fn divided_by_odd(mut self, odd: &Wide<N>, negative: bool) -> Wide<N> {
        let count = (self.len + 1).saturating_sub(odd.len);
        let inverse = inverse_word(odd.words[0]);
        for i in 0..count {
            let q = self.words[i].wrapping_mul(inverse);
            // Only the words that later quotient words depend on; word i itself makes room for the quotient.
            let mut borrow = 0u64;
            let (low, high) = self.words[i..count].split_at_mut(odd.len.min(count - i));
            for (cell, &y) in low.iter_mut().zip(&odd.words) {
                let wide = u128::from(q) * u128::from(y) + u128::from(borrow);
                let (word, under) = cell.overflowing_sub(wide as u64);
                *cell = word;
                borrow = (wide >> 64) as u64 + u64::from(under);
            }
            for cell in high {
                if borrow == 0 {
                    break;
                }
                let (word, under) = cell.overflowing_sub(borrow);
                *cell = word;
                borrow = u64::from(under);
            }
            self.words[i] = q;
        }
        self.words[count..self.len].fill(0);
        (self.len, self.negative) = (count, negative);
        self.trim()
    }

    /// The double nearest to self/divisor·2^scale, ties to even; `None` where it would leave the normal doubles.
    pub fn ratio(&self, divisor: &Wide<N>, scale: i64) -> Option<f64> {
        if self.len == 0 {
            return Some(0.0);
        }
        // Shifted so that the quotient has 64 or 65 bits and the divisor a whole leading word.
        let mut below = *divisor;
        let power = 64 + below.bits() as i64 - self.bits() as i64;
        let mut shift = power;
        let mut above = *self;
        if below.bits() < 64 {
            let up = 64 - below.bits();
            below = below.shifted_up(up)?;
            shift += up as i64;
        }
        if shift >= 0 {
            above = above.shifted_up(shift as usize)?;
        } else {
            below = below.shifted_up(shift.unsigned_abs() as usize)?;
        }
        (above.negative, below.negative) = (false, false);
        let drop = below.bits() - 64;
        let lead = above.shifted_down(drop);
        let lead = u128::from(lead.words[0]) | u128::from(*lead.words.get(1)?) << 64;
        let mut quotient = lead / u128::from(below.shifted_down(drop).words[0]);
        let exponent = scale - power;
        if !(-1080..=950).contains(&exponent) {
            return None;
        }
        let sign = match self.negative != divisor.negative {
            true => -1.0,
            false => 1.0,
        };
        let finish = |rounded: f64| {
            let half = exponent / 2;
            let value = rounded * 2f64.powi(half as i32) * 2f64.powi((exponent - half) as i32);
            let normal = (4.0 * f64::MIN_POSITIVE..=f64::MAX).contains(&value);
            normal.then_some(sign * value)
        };
        // The cut dividend makes the quotient too small by less than one, the cut divisor too large by less than four.
        let (least, most) = (quotient.saturating_sub(4) as f64, (quotient + 1) as f64);
        if least == most {
            return finish(least);
        }
        let mut whole = Wide::small(false, quotient as u64);
        whole.words[1] = (quotient >> 64) as u64;
        whole.len = 2;
        let mut rest = above.add(&whole.trim().mul(&below)?.negated())?;
        while rest.negative {
            rest = rest.add(&below)?;
            quotient -= 1;
        }
        let sticky = u128::from(!rest.is_zero());
        finish((quotient | sticky) as f64)
    }
}

/// Sets each cell to the first number minus the second, lowest word first, where the whole outcome is not below zero.
fn subtract<'a>(words: impl Iterator<Item = (&'a mut u64, u64, u64)>) {
    let mut borrow = false;
    for (cell, a, b) in words {
        let (a, c) = a.overflowing_sub(b);
        let (a, d) = a.overflowing_sub(u64::from(borrow));
        *cell = a;
        borrow = c | d;
    }
}

/// The inverse of an odd word modulo 2⁶⁴, by Newton's iteration.
fn inverse_word(odd: u64) -> u64 {
    let mut inverse = odd.wrapping_mul(3) ^ 2;
    for _ in 0..4 {
        inverse = inverse.wrapping_mul(2u64.wrapping_sub(odd.wrapping_mul(inverse)));
    }
    inverse
}

#[cfg(test)]
mod tests {
    use num_traits::Zero;
    use proptest::prelude::*;

    use super::*;
    use crate::expr::Rational;
    use crate::expr::number::to_f64;

    type W = Wide<12>;

    fn any_wide() -> impl Strategy<Value = W> {
        let word = prop_oneof![4 => any::<u64>(), 1 => Just(0), 1 => Just(u64::MAX), 1 => 0u64..4];
        (any::<bool>(), prop::collection::vec(word, 0..6)).prop_map(|(negative, list)| {
            let mut words = [0; 12];
            words[..list.len()].copy_from_slice(&list);
            Wide {
                negative,
                len: list.len(),
                words,
            }
            .trim()
        })
    }

    proptest! {
        #[test]
        fn arithmetic_is_that_of_integers(a in any_wide(), b in any_wide(), c in any_wide(), by in 0usize..300) {
            let (x, y, z) = (a.to_bigint(), b.to_bigint(), c.to_bigint());
            prop_assert_eq!(a.add(&b).map(|v| v.to_bigint()), Some(&x + &y));
            let product = a.mul(&b);
            prop_assert_eq!(product.map(|v| v.to_bigint()), Some(&x * &y));
            for subtract in [false, true] {
                let right = &x * &y + if subtract { -1 } else { 1 } * &y * &z;
                let found = W::products(&a, &b, subtract, &b, &c);
                prop_assert_eq!(found.map(|v| v.to_bigint()), Some(right));
            }
            prop_assert_eq!(a.shifted_up(by).map(|v| v.to_bigint()), Some(&x << by));
            prop_assert_eq!(a.shifted_down(by).to_bigint(), &x / (BigInt::from(1) << by));
            if !b.is_zero() {
                let whole = (&x % &y).is_zero().then(|| &x / &y);
                prop_assert_eq!(a.divided_if_exact(&b).map(|v| v.to_bigint()), whole);
                prop_assert_eq!(product.and_then(|p| p.divided_if_exact(&b)), Some(a));
                prop_assert_eq!(product.map(|p| p.divided_exactly(&b).to_bigint()), Some(x.clone()));
                let exact = Rational::new(x.clone().into(), y.clone().into());
                if let Some(near) = a.ratio(&b, 0) {
                    prop_assert_eq!(near, to_f64(&exact));
                } else {
                    prop_assert!(!x.is_zero());
                }
            }
        }

        #[test]
        fn what_does_not_fit_is_refused(a in any::<[u64; 3]>(), b in any::<[u64; 3]>()) {
            let wide = |w: [u64; 3]| Wide::<3> { negative: false, len: 3, words: w }.trim();
            let (a, b) = (wide(a), wide(b));
            let (x, y) = (a.to_bigint(), b.to_bigint());
            let one = Wide::small(false, 1);
            let rows = [
                (a.mul(&b), &x * &y),
                (a.add(&b), &x + &y),
                (Wide::products(&a, &one, false, &b, &one), &x + &y),
                (Wide::products(&a, &one, true, &b, &one), &x - &y),
            ];
            for (found, right) in rows {
                match found {
                    Some(v) => prop_assert_eq!(v.to_bigint(), right),
                    // Refused too where only a part of the result, or a carry that does not come, would not fit.
                    None => prop_assert!(x.bits().max(y.bits()) >= 191 || right.bits() >= 192),
                }
            }
        }
    }
}
