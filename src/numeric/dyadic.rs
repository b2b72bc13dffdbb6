//! Exact solution from doubles: every double is an integer times a power of two, so no denominator ever appears.
//!
//! In: a scene's numbers as doubles, taken as exact. Out: the double nearest to each exact value, by the impulses alone
//! where the scene allows, by fraction-free elimination as in `exact` otherwise. The integers have a fixed width on the
//! stack; where they do not fit, `None`, and the caller takes the way over fractions.

use super::contact_space;
use super::exact::{Cramer, Whole, cramer};
use super::given::Given;
use super::number::Number;
use super::system::assemble;
use super::wide::Wide;
use crate::expr::{Function, Rational, Scalar};

/// An integer times 2^exponent, or a number that did not fit.
#[derive(Clone, Copy, Debug)]
pub struct Dyadic<const N: usize> {
    value: Wide<N>,
    exponent: i64,
    fits: bool,
}

impl<const N: usize> Dyadic<N> {
    const ZERO: Dyadic<N> = Dyadic {
        value: Wide::ZERO,
        exponent: 0,
        fits: true,
    };

    /// A double, exactly; nothing for infinities and NaN.
    pub fn exact(value: f64) -> Dyadic<N> {
        let mut out = Dyadic::ZERO;
        if value == 0.0 {
            return out;
        }
        let bits = value.to_bits();
        let (raw, fraction) = ((bits >> 52 & 0x7ff) as i64, bits & ((1 << 52) - 1));
        let (size, exponent) = if raw == 0 {
            (fraction, -1074)
        } else {
            (fraction | 1 << 52, raw - 1075)
        };
        let twos = size.trailing_zeros();
        out.value = Wide::small(value < 0.0, size >> twos);
        out.exponent = exponent + i64::from(twos);
        out.fits = value.is_finite();
        out
    }

    /// The double nearest to self/other; `None` where a number is missing or the double would not be a normal one.
    pub fn over(&self, other: &Dyadic<N>) -> Option<f64> {
        let usable = self.fits && other.fits && !other.value.is_zero();
        usable.then(|| {
            self.value
                .ratio(&other.value, self.exponent - other.exponent)
        })?
    }

    /// The quotient where the divisor is known to divide the number; powers of two always do.
    fn divided_exactly(&self, divisor: &Dyadic<N>) -> Option<Dyadic<N>> {
        if !self.fits || !divisor.fits {
            return None;
        }
        // The quotient of odd parts is short; what is left in powers of two goes to the exponent.
        let (up, down) = (self.value.twos(), divisor.value.twos());
        Some(Dyadic {
            value: self
                .value
                .shifted_down(up)
                .divided_exactly(&divisor.value.shifted_down(down)),
            exponent: self.exponent - divisor.exponent + up as i64 - down as i64,
            fits: true,
        })
    }
}

/// Words that suffice for two smooth bodies with doubles of one size; for two that stick, or doubles of very different
/// sizes; and for nearly everything.
const NARROW: usize = 12;
const MIDDLE: usize = 28;
const BROAD: usize = 64;

/// Correctly rounded values of a determined scene; `None` where the system is not determined, its rows contradict each
/// other, a number is not finite, or the integers outgrow their width.
pub fn solve_dyadic(given: &Given<f64>) -> Option<Vec<f64>> {
    contact_space::nearest_doubles::<NARROW>(given)
        .or_else(|| contact_space::nearest_doubles::<MIDDLE>(given))
        .or_else(|| contact_space::nearest_doubles::<BROAD>(given))
        .or_else(|| full_system::<BROAD>(given))
}

/// The same by every equation of the scene.
fn full_system<const N: usize>(given: &Given<f64>) -> Option<Vec<f64>> {
    let system = assemble(&given.map(|v| Dyadic::<N>::exact(*v)));
    let (m, n) = (system.laws.len(), system.unknowns.len());
    let rows = system.matrix.chunks(n.max(1)).zip(&system.right);
    let cells = rows
        .flat_map(|(row, right)| row.iter().chain([right]))
        .copied();
    let Cramer::Solved {
        numerators,
        determinant,
    } = cramer(cells.collect(), m, n)?
    else {
        return None;
    };
    numerators.iter().map(|x| x.over(&determinant)).collect()
}

impl<const N: usize> Whole for Dyadic<N> {
    fn one() -> Dyadic<N> {
        Number::one()
    }
    fn is_zero(&self) -> bool {
        Number::is_zero(self)
    }
    fn eliminate(
        p: &Dyadic<N>,
        a: &Dyadic<N>,
        q: &Dyadic<N>,
        b: &Dyadic<N>,
        d: &Dyadic<N>,
    ) -> Option<Dyadic<N>> {
        p.times(a).minus(&q.times(b)).divided_exactly(d)
    }
    fn raise(a: &Dyadic<N>, p: &Dyadic<N>, d: &Dyadic<N>) -> Option<Dyadic<N>> {
        a.times(p).divided_exactly(d)
    }
}

impl<const N: usize> Scalar for Dyadic<N> {
    fn from_rational(value: &Rational) -> Dyadic<N> {
        let mut out = Dyadic::ZERO;
        // Assembly asks for nothing but small integers.
        match value.denom().as_i64().zip(value.numer().as_i64()) {
            Some((1, v)) => out.value = Wide::small(v < 0, v.unsigned_abs()),
            _ => out.fits = false,
        }
        out
    }
    fn pi() -> Option<Dyadic<N>> {
        None
    }
    #[inline]
    fn plus(&self, other: &Dyadic<N>) -> Dyadic<N> {
        if other.value.is_zero() || !self.fits {
            let fits = self.fits && other.fits;
            return Dyadic { fits, ..*self };
        }
        if self.value.is_zero() || !other.fits {
            return *other;
        }
        let (low, high) = match self.exponent <= other.exponent {
            true => (self, other),
            false => (other, self),
        };
        let mut sum = Dyadic::ZERO;
        let by = usize::try_from(high.exponent - low.exponent);
        sum.exponent = low.exponent;
        sum.fits = by.is_ok_and(|by| high.value.shift_into(by, &mut sum.value))
            && sum.value.add_assign(&low.value);
        sum
    }
    #[inline]
    fn times(&self, other: &Dyadic<N>) -> Dyadic<N> {
        let mut product = Dyadic::ZERO;
        product.exponent = self.exponent + other.exponent;
        product.fits =
            self.fits && other.fits && self.value.mul_into(&other.value, &mut product.value);
        product
    }
    fn recip(&self) -> Option<Dyadic<N>> {
        None
    }
    fn sqrt(&self) -> Option<Dyadic<N>> {
        None
    }
    fn pow(&self, _: &Dyadic<N>) -> Option<Dyadic<N>> {
        None
    }
    fn call(&self, _: Function) -> Option<Dyadic<N>> {
        None
    }
}

impl<const N: usize> Number for Dyadic<N> {
    fn zero() -> Dyadic<N> {
        Dyadic::ZERO
    }
    fn one() -> Dyadic<N> {
        let mut one = Dyadic::ZERO;
        one.value = Wide::small(false, 1);
        one
    }
    fn is_zero(&self) -> bool {
        self.fits && self.value.is_zero()
    }
    fn minus(&self, other: &Dyadic<N>) -> Dyadic<N> {
        self.plus(&other.negated())
    }
    fn negated(&self) -> Dyadic<N> {
        Dyadic {
            value: self.value.negated(),
            ..*self
        }
    }
    fn halved(&self) -> Dyadic<N> {
        Dyadic {
            exponent: self.exponent - 1,
            ..*self
        }
    }
    fn size(&self) -> f64 {
        match self.fits {
            true => 2f64.powi((self.value.bits() as i64 + self.exponent) as i32),
            false => f64::NAN,
        }
    }
}
