//! Exact solution from doubles: every double is an integer times a power of two, so no denominator ever appears.
//!
//! In: a scene's numbers as doubles, taken as exact. Out: the double nearest to each exact value. Fraction-free
//! elimination as in `exact`, on integers of fixed width on the stack; where they do not fit, `None`, and the caller
//! takes the way over fractions.

use super::exact::{Cramer, Whole, cheapest_pivot, cramer};
use super::given::Given;
use super::number::Number;
use super::system::{System, assemble};
use super::wide::Wide;
use crate::expr::{Function, Rational, Scalar};

/// Words of the numbers the equations are assembled in.
const ENTRY: usize = 6;
/// Words of the numbers elimination runs in: first narrow ones, which are quicker to carry about, then wide ones.
const NARROW: usize = 12;
const BROAD: usize = 40;

/// An integer times 2^exponent; `None` where it did not fit.
#[derive(Clone, Copy, Debug)]
pub struct Dyadic(Option<(Wide<ENTRY>, i64)>);

impl Dyadic {
    /// A double, exactly; nothing for infinities and NaN.
    pub fn exact(value: f64) -> Dyadic {
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
}

/// Correctly rounded values of a determined scene; `None` where the system is not determined, its rows contradict each
/// other, a number is not finite, or the integers outgrow their width.
pub fn solve_dyadic(given: &Given<f64>) -> Option<Vec<f64>> {
    let system = assemble(&given.map(|v| Dyadic::exact(*v)));
    solve_narrow(&system).or_else(|| solve_broad(&system))
}

/// By crosswise multiplication: shortest where few rows depend on each other, and numbers double in length with every
/// further one.
fn solve_narrow(system: &System<Dyadic>) -> Option<Vec<f64>> {
    let (mut cells, powers) = integers::<NARROW>(system)?;
    let n = system.unknowns.len();
    let (numerators, denominator) = cross_multiply(&mut cells, system.laws.len(), n)?;
    let values = numerators.iter().zip(powers);
    values
        .map(|(x, power)| x.ratio(&denominator, power))
        .collect()
}

/// Numerators over one denominator; `None` where the system is not square and regular, or the integers outgrow.
fn cross_multiply<const N: usize>(
    cells: &mut [Wide<N>],
    rows: usize,
    n: usize,
) -> Option<(Vec<Wide<N>>, Wide<N>)> {
    if rows != n {
        return None;
    }
    let (width, one) = (n + 1, Wide::small(false, 1));
    let mut open_rows: Vec<usize> = (0..n).collect();
    let mut open_columns = open_rows.clone();
    let mut steps = Vec::with_capacity(n);
    let mut line = vec![Wide::ZERO; width];
    for _ in 0..n {
        let (row, column) = cheapest_pivot(cells, width, &open_rows, &open_columns)?;
        open_rows.retain(|r| *r != row);
        open_columns.retain(|c| *c != column);
        line.copy_from_slice(&cells[row * width..(row + 1) * width]);
        let pivot = line[column];
        for &r in &open_rows {
            let factor = cells[r * width + column];
            if factor.is_zero() {
                continue;
            }
            let whole = factor.divided_if_exact(&pivot);
            let (keep, take) = match &whole {
                Some(times) => (&one, times),
                None => (&pivot, &factor),
            };
            for &c in open_columns.iter().chain([&n]) {
                let cell = &mut cells[r * width + c];
                if !(line[c].is_zero() && (whole.is_some() || cell.is_zero())) {
                    *cell = Wide::products(keep, cell, true, take, &line[c])?;
                }
            }
        }
        steps.push((row, column));
    }
    let mut denominator = one;
    let mut numerators = vec![Wide::ZERO; n];
    for (row, column) in steps.into_iter().rev() {
        let line = &cells[row * width..(row + 1) * width];
        let mut sum = line[n].mul(&denominator)?;
        for &c in &open_columns {
            if !line[c].is_zero() && !numerators[c].is_zero() {
                sum = Wide::products(&sum, &one, true, &line[c], &numerators[c])?;
            }
        }
        numerators[column] = match sum.divided_if_exact(&line[column]) {
            Some(quotient) => quotient,
            None => {
                for &c in &open_columns {
                    numerators[c] = numerators[c].mul(&line[column])?;
                }
                denominator = denominator.mul(&line[column])?;
                sum
            }
        };
        open_columns.push(column);
    }
    Some((numerators, denominator))
}

/// By Bareiss' scheme, whose numbers grow by one entry's length per row only.
fn solve_broad(system: &System<Dyadic>) -> Option<Vec<f64>> {
    let (m, n) = (system.laws.len(), system.unknowns.len());
    let (rows, columns) = integers::<BROAD>(system)?;
    let Cramer::Solved {
        numerators,
        determinant,
    } = cramer(rows, m, n)?
    else {
        return None;
    };
    let values = numerators.iter().zip(columns);
    values
        .map(|(x, scale)| x.ratio(&determinant, scale))
        .collect()
}

/// Rows scaled to integers by powers of two, right-hand side last; and the exponent by which each unknown is to be
/// raised, for the columns and above all the right-hand side, made of products, have powers of their own.
fn integers<const N: usize>(system: &System<Dyadic>) -> Option<(Vec<Wide<N>>, Vec<i64>)> {
    let (m, n) = (system.laws.len(), system.unknowns.len());
    let exponent = |cell: &Dyadic| {
        cell.0
            .filter(|(value, _)| !value.is_zero())
            .map(|(_, exponent)| exponent)
    };
    let mut row_powers = Vec::with_capacity(m);
    let mut column_powers = vec![i64::MAX; n + 1];
    for i in 0..m {
        let lowest = system.row(i).iter().filter_map(exponent).min().unwrap_or(0);
        for (cell, power) in system
            .row(i)
            .iter()
            .chain([&system.right[i]])
            .zip(&mut column_powers)
        {
            if let Some(exponent) = exponent(cell) {
                *power = (*power).min(exponent - lowest);
            }
        }
        row_powers.push(lowest);
    }
    column_powers
        .iter_mut()
        .filter(|p| **p == i64::MAX)
        .for_each(|p| *p = 0);
    let mut cells = Vec::with_capacity(m * (n + 1));
    for (i, row_power) in row_powers.into_iter().enumerate() {
        for (cell, column_power) in system
            .row(i)
            .iter()
            .chain([&system.right[i]])
            .zip(&column_powers)
        {
            let (value, exponent) = cell.0?;
            cells.push(match value.is_zero() {
                true => Wide::ZERO,
                false => {
                    let up = usize::try_from(exponent - row_power - column_power).ok()?;
                    value.resized::<N>()?.shifted_up(up)?
                }
            });
        }
    }
    let right = column_powers.pop()?;
    Some((
        cells,
        column_powers
            .into_iter()
            .map(|power| right - power)
            .collect(),
    ))
}

impl<const N: usize> Whole for Wide<N> {
    fn one() -> Wide<N> {
        Wide::small(false, 1)
    }
    fn is_zero(&self) -> bool {
        Wide::is_zero(self)
    }
    fn eliminate(
        p: &Wide<N>,
        a: &Wide<N>,
        q: &Wide<N>,
        b: &Wide<N>,
        d: &Wide<N>,
    ) -> Option<Wide<N>> {
        Some(Wide::products(p, a, true, q, b)?.divided_exactly(d))
    }
    fn raise(a: &Wide<N>, p: &Wide<N>, d: &Wide<N>) -> Option<Wide<N>> {
        Some(a.mul(p)?.divided_exactly(d))
    }
}

impl Scalar for Dyadic {
    fn from_rational(value: &Rational) -> Dyadic {
        // Assembly asks for nothing but small integers.
        match value.denom().as_i64().zip(value.numer().as_i64()) {
            Some((1, v)) => Dyadic(Some((Wide::small(v < 0, v.unsigned_abs()), 0))),
            _ => Dyadic(None),
        }
    }
    fn pi() -> Option<Dyadic> {
        None
    }
    fn plus(&self, other: &Dyadic) -> Dyadic {
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
        let up = |v: Wide<ENTRY>, e: i64| v.shifted_up(usize::try_from(e - low).ok()?);
        Dyadic(
            up(a, i)
                .zip(up(b, j))
                .and_then(|(a, b)| a.add(&b))
                .map(|sum| (sum, low)),
        )
    }
    fn times(&self, other: &Dyadic) -> Dyadic {
        let (Some((a, i)), Some((b, j))) = (self.0, other.0) else {
            return Dyadic(None);
        };
        Dyadic(a.mul(&b).map(|product| (product, i + j)))
    }
    fn recip(&self) -> Option<Dyadic> {
        None
    }
    fn sqrt(&self) -> Option<Dyadic> {
        None
    }
    fn pow(&self, _: &Dyadic) -> Option<Dyadic> {
        None
    }
    fn call(&self, _: Function) -> Option<Dyadic> {
        None
    }
}

impl Number for Dyadic {
    fn zero() -> Dyadic {
        Dyadic(Some((Wide::ZERO, 0)))
    }
    fn one() -> Dyadic {
        Dyadic(Some((Wide::small(false, 1), 0)))
    }
    fn is_zero(&self) -> bool {
        self.0.is_some_and(|(value, _)| value.is_zero())
    }
    fn minus(&self, other: &Dyadic) -> Dyadic {
        self.plus(&other.negated())
    }
    fn negated(&self) -> Dyadic {
        Dyadic(self.0.map(|(value, exponent)| (value.negated(), exponent)))
    }
    fn halved(&self) -> Dyadic {
        Dyadic(self.0.map(|(value, exponent)| (value, exponent - 1)))
    }
    fn size(&self) -> f64 {
        self.0.map_or(f64::NAN, |(value, exponent)| {
            2f64.powi((value.bits() as i64 + exponent) as i32)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::given::{Freedom, GivenBody, GivenContact, GivenLaw, Joint};

    #[test]
    fn two_bodies_with_ragged_doubles_need_narrow_integers_only() {
        let body = |mass, inertia, center, velocity, spin| GivenBody {
            freedom: Freedom::Rigid,
            mass,
            inertia,
            center,
            velocity,
            spin,
        };
        let bodies = vec![
            body(1.3, 0.07, [-0.31, 0.02], [1.1, -0.2], -5.3),
            body(2.1, 0.83, [0.49, -0.81], [-10.7, 0.3], 0.9),
        ];
        let joint = Joint {
            bodies: [0, 1],
            at: [0.03, 0.01],
        };
        let contact = GivenContact {
            joint,
            normal: Some([0.8, 0.6]),
            law: GivenLaw::Frictionless(0.9),
        };
        let given = Given {
            bodies,
            hinges: vec![],
            contacts: vec![contact],
            blows: vec![],
            known: vec![],
        };
        let system = assemble(&given.map(|v| Dyadic::exact(*v)));
        assert!(solve_narrow(&system).is_some());
    }
}
