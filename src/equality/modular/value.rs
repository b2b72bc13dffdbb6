//! What is known of a formula at several points: residues, real numbers, its sign, and bounds on the polynomials behind it.

use super::real::Real;
use crate::algebra::prime::{self, SMOOTH, add, each, negative, random, times};

/// Bounds on a polynomial.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bound {
    pub degree: f32,
    /// Sum of the absolute values of the coefficients.
    pub norm: f32,
}

impl Bound {
    pub(super) const ONE: Bound = Bound {
        degree: 0.0,
        norm: 1.0,
    };
    pub(super) fn times(self, other: Bound) -> Bound {
        Bound {
            degree: self.degree + other.degree,
            norm: self.norm * other.norm,
        }
    }
    pub(super) fn plus(self, other: Bound) -> Bound {
        Bound {
            degree: self.degree.max(other.degree),
            norm: self.norm + other.norm,
        }
    }
    pub(super) fn power(self, k: u32) -> Bound {
        Bound {
            degree: self.degree * k as f32,
            norm: match k {
                2 => self.norm * self.norm,
                _ => self.norm.powi(k.min(10_000) as i32),
            },
        }
    }
    pub(super) fn root(self) -> Bound {
        Bound {
            degree: self.degree / 2.0,
            norm: self.norm.sqrt(),
        }
    }
}

/// What is known of the sign of a value on the whole domain.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) enum Sign {
    Unknown,
    NotNegative,
    Positive,
}

/// A value in all lanes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Value<const L: usize, const R: usize> {
    pub above: [u64; L],
    pub below: [u64; L],
    /// Whether `below` is 1 everywhere.
    pub whole: bool,
    pub bounds: [Bound; 2],
    /// At real points.
    pub real: [Real; R],
    pub sign: Sign,
    /// Whether it is a product of positive symbols and a constant made of small primes.
    pub monomial: bool,
    /// The primes that divide that constant an odd number of times, as bits.
    pub odd: u32,
}

impl<const L: usize, const R: usize> Value<L, R> {
    #[inline]
    pub(super) fn add<const C: u64>(&mut self, b: &Self) {
        self.monomial = false;
        self.sign = match (self.sign, b.sign) {
            (Sign::Unknown, _) | (_, Sign::Unknown) => Sign::Unknown,
            (x, y) => x.max(y),
        };
        for (x, y) in self.real.iter_mut().zip(b.real) {
            *x = x.plus(y);
        }
        let mut other = (b.above, b.bounds[0]);
        if !(self.whole && b.whole) && self.below != b.below {
            if !self.whole {
                other.0 = each(other.0, self.below, times::<C>);
                other.1 = other.1.times(self.bounds[1]);
            }
            if !b.whole {
                self.above = each(self.above, b.below, times::<C>);
                self.bounds[0] = self.bounds[0].times(b.bounds[1]);
            }
            self.put_below::<C>(b);
        }
        self.above = each(self.above, other.0, add::<C>);
        self.bounds[0] = self.bounds[0].plus(other.1);
    }

    #[inline]
    pub(super) fn multiply<const C: u64>(&mut self, b: &Self) {
        self.above = each(self.above, b.above, times::<C>);
        self.bounds[0] = self.bounds[0].times(b.bounds[0]);
        self.put_below::<C>(b);
        for (x, y) in self.real.iter_mut().zip(b.real) {
            *x = x.times(y);
        }
        self.sign = self.sign.min(b.sign);
        self.monomial &= b.monomial;
        self.odd ^= b.odd;
    }

    /// Puts below what is below another value, as a factor.
    #[inline]
    fn put_below<const C: u64>(&mut self, b: &Self) {
        if self.whole {
            (self.below, self.bounds[1]) = (b.below, b.bounds[1]);
        } else if !b.whole {
            self.below = each(self.below, b.below, times::<C>);
            self.bounds[1] = self.bounds[1].times(b.bounds[1]);
        }
        self.whole &= b.whole;
    }

    pub(super) fn raised<const C: u64>(&self, k: u32) -> Self {
        let a = *self;
        if k == 1 {
            return a;
        }
        let lanes = |x: [u64; L]| match k {
            2 => each(x, x, times::<C>),
            3 => each(each(x, x, times::<C>), x, times::<C>),
            _ => prime::powers::<C, L>(x, u64::from(k)),
        };
        Value {
            above: lanes(a.above),
            below: if a.whole { a.below } else { lanes(a.below) },
            bounds: a.bounds.map(|b| b.power(k)),
            real: a.real.map(|x| x.power(k)),
            sign: if k.is_multiple_of(2) {
                a.sign.max(Sign::NotNegative)
            } else {
                a.sign
            },
            odd: if k.is_multiple_of(2) { 0 } else { a.odd },
            ..a
        }
    }
}

/// Cosine and sine of an angle, both over the same.
#[derive(Clone, Copy, Debug)]
pub(super) struct Circle<const L: usize, const R: usize> {
    pub cos: [u64; L],
    pub sin: [u64; L],
    pub below: [u64; L],
    pub real: [[Real; 2]; R],
    pub degree: f32,
    /// Bound on the coefficients below; above it is half the square of it.
    pub norm: f32,
}

impl<const L: usize, const R: usize> Circle<L, R> {
    /// The sum of two angles.
    #[inline]
    pub(super) fn turned<const C: u64>(&self, other: &Circle<L, R>) -> Circle<L, R> {
        let mut out = *self;
        for lane in 0..L {
            let (c, s) = (self.cos[lane], self.sin[lane]);
            let (d, t) = (other.cos[lane], other.sin[lane]);
            let minus = negative::<C>(times::<C>(s, t));
            out.cos[lane] = add::<C>(times::<C>(c, d), minus);
            out.sin[lane] = add::<C>(times::<C>(s, d), times::<C>(c, t));
            out.below[lane] = times::<C>(self.below[lane], other.below[lane]);
        }
        for lane in 0..R {
            let ([c, s], [d, t]) = (self.real[lane], other.real[lane]);
            out.real[lane] = [
                c.times(d).plus(s.times(t).negative()),
                s.times(d).plus(c.times(t)),
            ];
        }
        out.degree += other.degree;
        // (1 + i t)^(2 k) has 2^(2 k) as the sum of its coefficients, half of it in each part.
        out.norm *= other.norm;
        out
    }
}

/// The primes that divide a number an odd number of times, as bits by their size; `None` where a large one occurs.
pub(super) fn odd_primes(n: u64) -> Option<u32> {
    const PRIMES: [u64; 23] = [
        2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59, 61, 67, 71, 73, 79, SMOOTH,
    ];
    let mut left = n.max(1);
    let mut odd = 0;
    for (bit, q) in PRIMES.iter().enumerate() {
        if left == 1 {
            break;
        }
        while left.is_multiple_of(*q) {
            left /= q;
            odd ^= 1 << bit;
        }
    }
    (left == 1).then_some(odd)
}

/// Numbers inside a range, drawn for a seed.
pub(super) fn real<const R: usize>(seed: u64, [low, high]: [f64; 2]) -> [Real; R] {
    std::array::from_fn(|lane| {
        let share = random::<1>(seed, 1000 + lane as u64) as f64 / prime::prime::<1>() as f64;
        Real::exact(low + (high - low) * (0.05 + 0.9 * share))
    })
}
