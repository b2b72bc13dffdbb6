//! Binary floating-point numbers of any precision with directed rounding: m·2^e with integers m and e.

use std::cmp::Ordering;

use num_bigint::{BigInt, Sign};
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use crate::expr::{Int, Rational};

/// The number `mantissa`·2^`exponent`. Several pairs denote the same number; compare with [`Dyadic::cmp`].
#[derive(Clone, Debug)]
pub struct Dyadic {
    /// Integer m.
    pub mantissa: BigInt,
    /// Exponent e.
    pub exponent: i64,
}

/// Direction of rounding.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Round {
    /// Towards −∞.
    Down,
    /// Towards +∞.
    Up,
}

impl Dyadic {
    /// `mantissa`·2^`exponent`.
    pub fn new(mantissa: impl Into<BigInt>, exponent: i64) -> Dyadic {
        Dyadic {
            mantissa: mantissa.into(),
            exponent,
        }
    }

    /// Zero.
    pub fn zero() -> Dyadic {
        Dyadic::new(0, 0)
    }

    /// An integer.
    pub fn from_int(value: i64) -> Dyadic {
        Dyadic::new(value, 0)
    }

    /// The exact value of a finite double.
    pub fn from_f64(value: f64) -> Option<Dyadic> {
        if !value.is_finite() {
            return None;
        }
        let bits = value.to_bits();
        let raw = ((bits >> 52) & 0x7ff) as i64;
        let fraction = (bits & ((1 << 52) - 1)) as i64;
        let (m, e) = match raw {
            0 => (fraction, -1074),
            _ => (fraction | 1 << 52, raw - 1075),
        };
        Some(Dyadic::new(if value < 0.0 { -m } else { m }, e))
    }

    /// Sign: −1, 0 or 1.
    pub fn sign(&self) -> i32 {
        match self.mantissa.sign() {
            Sign::Minus => -1,
            Sign::NoSign => 0,
            Sign::Plus => 1,
        }
    }

    /// The t with 2^(t−1) ≤ |x| < 2^t; `i64::MIN` for zero.
    pub fn top(&self) -> i64 {
        if self.mantissa.is_zero() {
            i64::MIN
        } else {
            self.exponent.saturating_add(self.mantissa.bits() as i64)
        }
    }

    /// x·2^k, exactly.
    pub fn scale(&self, k: i64) -> Dyadic {
        Dyadic::new(self.mantissa.clone(), self.exponent.saturating_add(k))
    }

    /// −x.
    pub fn neg(&self) -> Dyadic {
        Dyadic::new(-&self.mantissa, self.exponent)
    }

    /// Rounded to at most `bits` bits of mantissa.
    pub fn round(self, bits: u32, to: Round) -> Dyadic {
        let have = self.mantissa.bits();
        if have <= u64::from(bits) {
            return self;
        }
        let drop = have - u64::from(bits);
        let mantissa = match to {
            Round::Down => &self.mantissa >> drop,
            Round::Up => -((-&self.mantissa) >> drop),
        };
        Dyadic::new(mantissa, self.exponent + drop as i64)
    }

    /// The largest integer up to x·2^w.
    pub fn floor_of(&self, w: u32) -> BigInt {
        let up = self.exponent.saturating_add(i64::from(w));
        if up >= 0 {
            &self.mantissa << up as u64
        } else {
            &self.mantissa >> up.unsigned_abs()
        }
    }

    /// x + y, rounded.
    pub fn add(&self, other: &Dyadic, bits: u32, to: Round) -> Dyadic {
        if self.mantissa.is_zero() {
            return other.clone().round(bits, to);
        }
        if other.mantissa.is_zero() {
            return self.clone().round(bits, to);
        }
        let (large, small) = match self.top() >= other.top() {
            true => (self, other),
            false => (other, self),
        };
        let reach = (2 * i64::from(bits) + 8).max(large.mantissa.bits() as i64 + 8);
        if large.top() - small.top() > reach {
            // |small| < 2^(top − reach): replaced by 0 or by that bound, whichever lies on the safe side.
            let sign = match (small.sign(), to) {
                (-1, Round::Down) => -1,
                (1, Round::Up) => 1,
                _ => return large.clone().round(bits, to),
            };
            let bound = Dyadic::new(sign, large.top() - reach);
            return aligned_sum(large, &bound).round(bits, to);
        }
        aligned_sum(large, small).round(bits, to)
    }

    /// x·y, exactly.
    pub fn mul(&self, other: &Dyadic) -> Dyadic {
        let exponent = self.exponent.saturating_add(other.exponent);
        Dyadic::new(&self.mantissa * &other.mantissa, exponent)
    }

    /// 1/x for x ≠ 0, rounded.
    pub fn recip(&self, bits: u32, to: Round) -> Dyadic {
        let shift = u64::from(bits) + 1 + self.mantissa.bits();
        let mantissa = div_round(&(BigInt::one() << shift), &self.mantissa, to);
        Dyadic::new(mantissa, -self.exponent - shift as i64).round(bits, to)
    }

    /// √x for x ≥ 0, rounded.
    pub fn sqrt(&self, bits: u32, to: Round) -> Dyadic {
        let mut shift = (2 * u64::from(bits) + 2).saturating_sub(self.mantissa.bits()) as i64;
        if (self.exponent - shift) % 2 != 0 {
            shift += 1;
        }
        let wide = &self.mantissa << shift as u64;
        let mut root = wide.sqrt();
        if to == Round::Up && &root * &root != wide {
            root += 1;
        }
        Dyadic::new(root, (self.exponent - shift) / 2).round(bits, to)
    }

    /// A fraction, rounded.
    pub fn from_rational(value: &Rational, bits: u32, to: Round) -> Dyadic {
        if let (Some(n), true) = (value.numer().as_i64(), value.denom().is_one()) {
            return Dyadic::from_int(n).round(bits, to);
        }
        let (n, d) = (value.numer().to_bigint(), value.denom().to_bigint());
        let shift = (u64::from(bits) + 1 + d.bits()).saturating_sub(n.bits());
        Dyadic::new(div_round(&(n << shift), &d, to), -(shift as i64)).round(bits, to)
    }

    /// The exact fraction; the caller bounds the exponent.
    pub fn to_rational(&self) -> Rational {
        let power = BigInt::one() << self.exponent.unsigned_abs();
        match self.exponent >= 0 {
            true => Rational::from(Int::from(&self.mantissa * power)),
            false => Rational::new(Int::from(self.mantissa.clone()), Int::from(power)),
        }
    }

    /// The nearest double, ties to even, where its exponent is well inside the range of doubles.
    pub fn nearest(&self) -> Option<f64> {
        if self.mantissa.is_zero() {
            return Some(0.0);
        }
        if self.top().abs() > 960 {
            return None;
        }
        // 64 bits, the last of them set where anything is cut off: it never makes a tie and never hides one.
        let cut = self.mantissa.bits().saturating_sub(64);
        let size = self.mantissa.magnitude();
        let mut high = u64::try_from(size >> cut).ok()?;
        high |= u64::from(size.trailing_zeros().is_some_and(|zeros| zeros < cut));
        let (m, e) = (high as f64, self.exponent + cut as i64);
        // The product is exact; the power alone may leave the range of doubles.
        let half = e / 2;
        let value = m * 2f64.powi(half as i32) * 2f64.powi((e - half) as i32);
        Some(if self.sign() < 0 { -value } else { value })
    }

    /// A double on the given side.
    pub fn to_f64(&self, to: Round) -> f64 {
        let x = self.clone().round(53, to);
        let top = x.top();
        if x.mantissa.is_zero() {
            return 0.0;
        }
        let negative = x.sign() < 0;
        // From 2^1024 on there are no doubles; everything below has its 53 bits.
        if top > 1024 {
            return match (negative, to) {
                (false, Round::Up) => f64::INFINITY,
                (false, Round::Down) => f64::MAX,
                (true, Round::Up) => f64::MIN,
                (true, Round::Down) => f64::NEG_INFINITY,
            };
        }
        if top < -960 {
            return match (negative, to) {
                (false, Round::Up) => 1e-280,
                (true, Round::Down) => -1e-280,
                _ => 0.0,
            };
        }
        // 53 bits and an exponent well inside the range of doubles: both factors and the product are exact.
        let m = i64::try_from(&x.mantissa).unwrap_or(0) as f64;
        let half = x.exponent / 2;
        m * 2f64.powi(half as i32) * 2f64.powi((x.exponent - half) as i32)
    }
}

impl PartialEq for Dyadic {
    fn eq(&self, other: &Dyadic) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Dyadic {}

impl PartialOrd for Dyadic {
    fn partial_cmp(&self, other: &Dyadic) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Dyadic {
    fn cmp(&self, other: &Dyadic) -> Ordering {
        let sign = self.sign().cmp(&other.sign());
        if sign != Ordering::Equal || self.mantissa.is_zero() {
            return sign;
        }
        let size = self.top().cmp(&other.top()).then_with(|| {
            // Equal tops: the exponents differ by no more than the longer mantissa.
            let low = self.exponent.min(other.exponent);
            let [a, b] = [self, other].map(|x| x.mantissa.abs() << (x.exponent - low) as u64);
            a.cmp(&b)
        });
        match self.sign() < 0 {
            true => size.reverse(),
            false => size,
        }
    }
}

fn aligned_sum(a: &Dyadic, b: &Dyadic) -> Dyadic {
    let low = a.exponent.min(b.exponent);
    let m = (&a.mantissa << (a.exponent - low) as u64) + (&b.mantissa << (b.exponent - low) as u64);
    Dyadic::new(m, low)
}

fn div_round(n: &BigInt, d: &BigInt, to: Round) -> BigInt {
    match to {
        Round::Down => n.div_floor(d),
        Round::Up => -(-n).div_floor(d),
    }
}
