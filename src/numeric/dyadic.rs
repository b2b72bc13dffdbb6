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

/// An integer times 2^exponent; `None` where it did not fit.
#[derive(Clone, Copy, Debug)]
pub struct Dyadic<const N: usize>(Option<(Wide<N>, i64)>);

impl<const N: usize> Dyadic<N> {
    /// A double, exactly; nothing for infinities and NaN.
    pub fn exact(value: f64) -> Dyadic<N> {
        if value == 0.0 {
            return Dyadic(Some((Wide::ZERO, 0)));
        }
        if !value.is_finite() {
            return Dyadic(None);
        }
        let bits = value.to_bits();
        let (raw, fraction) = ((bits >> 52 & 0x7ff) as i64, bits & ((1 << 52) - 1));
        let (size, exponent) = if raw == 0 {
            (fraction, -1074)
        } else {
            (fraction | 1 << 52, raw - 1075)
        };
        let twos = size.trailing_zeros();
        Dyadic(Some((
            Wide::small(value < 0.0, size >> twos),
            exponent + i64::from(twos),
        )))
    }

    /// The double nearest to self/other; `None` where a number is missing or the double would not be a normal one.
    pub fn over(&self, other: &Dyadic<N>) -> Option<f64> {
        let ((above, i), (below, j)) = (self.0?, other.0?);
        (!below.is_zero()).then(|| above.ratio(&below, i - j))?
    }

    /// The quotient where the divisor is known to divide the number; powers of two always do.
    fn divided_exactly(&self, divisor: &Dyadic<N>) -> Option<Dyadic<N>> {
        let ((above, i), (below, j)) = (self.0?, divisor.0?);
        if above.is_zero() {
            return Some(*self);
        }
        // The quotient of odd parts is short; what is left in powers of two goes to the exponent.
        let (up, down) = (above.twos(), below.twos());
        let quotient = above
            .shifted_down(up)
            .divided_exactly(&below.shifted_down(down));
        Some(Dyadic(Some((quotient, i - j + up as i64 - down as i64))))
    }
}

/// Words that suffice for two bodies with doubles of one size, and for nearly everything.
const NARROW: usize = 12;
const BROAD: usize = 48;

/// Correctly rounded values of a determined scene; `None` where the system is not determined, its rows contradict each
/// other, a number is not finite, or the integers outgrow their width.
pub fn solve_dyadic(given: &Given<f64>) -> Option<Vec<f64>> {
    contact_space::nearest_doubles::<NARROW>(given)
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
        // Assembly asks for nothing but small integers.
        match value.denom().as_i64().zip(value.numer().as_i64()) {
            Some((1, v)) => Dyadic(Some((Wide::small(v < 0, v.unsigned_abs()), 0))),
            _ => Dyadic(None),
        }
    }
    fn pi() -> Option<Dyadic<N>> {
        None
    }
    fn plus(&self, other: &Dyadic<N>) -> Dyadic<N> {
        let (Some((a, i)), Some((b, j))) = (self.0, other.0) else {
            return Dyadic(None);
        };
        if a.is_zero() {
            return *other;
        }
        if b.is_zero() {
            return *self;
        }
        let low = i.min(j);
        let up = |v: Wide<N>, e: i64| v.shifted_up(usize::try_from(e - low).ok()?);
        Dyadic(
            up(a, i)
                .zip(up(b, j))
                .and_then(|(a, b)| a.add(&b))
                .map(|sum| (sum, low)),
        )
    }
    fn times(&self, other: &Dyadic<N>) -> Dyadic<N> {
        let (Some((a, i)), Some((b, j))) = (self.0, other.0) else {
            return Dyadic(None);
        };
        Dyadic(a.mul(&b).map(|product| (product, i + j)))
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
        Dyadic(Some((Wide::ZERO, 0)))
    }
    fn one() -> Dyadic<N> {
        Dyadic(Some((Wide::small(false, 1), 0)))
    }
    fn is_zero(&self) -> bool {
        self.0.is_some_and(|(value, _)| value.is_zero())
    }
    fn minus(&self, other: &Dyadic<N>) -> Dyadic<N> {
        self.plus(&other.negated())
    }
    fn negated(&self) -> Dyadic<N> {
        Dyadic(self.0.map(|(value, exponent)| (value.negated(), exponent)))
    }
    fn halved(&self) -> Dyadic<N> {
        Dyadic(self.0.map(|(value, exponent)| (value, exponent - 1)))
    }
    fn size(&self) -> f64 {
        self.0.map_or(f64::NAN, |(value, exponent)| {
            2f64.powi((value.bits() as i64 + exponent) as i32)
        })
    }
}
