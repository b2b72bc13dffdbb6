//! Exact solution: fraction-free elimination over integers, with no greatest common divisor until the very end.
//!
//! Rows are scaled to integers and eliminated after Bareiss (1968), sparse: a row without an entry in the pivot column is
//! left as it is and remembers up to which pivot it has come (Lee & Saunders 1995), so the zeros that collisions are
//! full of cost nothing. The pivot with the fewest fill-ins goes first (Markowitz). Unknowns come out by Cramer's rule as
//! integer numerators over one common determinant.

use num_bigint::BigInt;
use num_integer::Integer as _;
use num_traits::{One, Zero};

use super::solution::{Contradiction, Solution};
use super::system::System;
use crate::expr::{Int, Rational};

/// Solves a system exactly, also where it determines only some unknowns.
pub fn solve_exact(system: &System<Rational>) -> Result<Solution<Rational>, Contradiction> {
    let (rows, n) = (system.laws.len(), system.unknowns.len());
    let whole = integer_rows(system);
    let small: Option<Vec<i128>> = whole.iter().map(|v| v.as_i64().map(i128::from)).collect();
    let outcome = small.and_then(|cells| Some(cramer(cells, rows, n)?.values()));
    let outcome = outcome.or_else(|| {
        let cells: Vec<BigInt> = whole.iter().map(Int::to_bigint).collect();
        Some(cramer(cells, rows, n)?.values())
    });
    match outcome.flatten() {
        Some(values) => Ok(Solution::determined(values)),
        None => reduced(system).map(|(solution, _)| solution),
    }
}

/// The fraction in lowest terms; a machine word's greatest common divisor where both fit one.
fn fraction(numerator: i128, denominator: i128) -> Rational {
    let divisor = match (i64::try_from(numerator), i64::try_from(denominator)) {
        (Ok(a), Ok(b)) => i128::from(a.unsigned_abs().gcd(&b.unsigned_abs())),
        _ => numerator.gcd(&denominator),
    };
    let signed = if denominator < 0 { -divisor } else { divisor };
    Rational::new_raw(
        Int::from(numerator / signed),
        Int::from(denominator / signed),
    )
}

/// Every row times the least common multiple of its denominators, right-hand side last.
fn integer_rows(system: &System<Rational>) -> Vec<Int> {
    let n = system.unknowns.len();
    let mut whole = Vec::with_capacity(system.laws.len() * (n + 1));
    for (i, right) in system.right.iter().enumerate() {
        let row = || system.row(i).iter().chain(std::iter::once(right));
        let mut multiple = Int::one();
        for value in row() {
            if !value.denom().is_one() && !multiple.is_multiple_of(value.denom()) {
                multiple = multiple.lcm(value.denom());
            }
        }
        for value in row() {
            whole.push(match (value.numer().is_zero(), multiple.is_one()) {
                (true, _) => Int::zero(),
                (_, true) => value.numer().clone(),
                _ => value.numer() * &(&multiple / value.denom()),
            });
        }
    }
    whole
}

/// An integer type the elimination runs in; `None` where a result does not fit it.
trait Whole: Clone {
    fn one() -> Self;
    fn is_zero(&self) -> bool;
    /// (p·a − q·b) / d, the division being exact.
    fn eliminate(p: &Self, a: &Self, q: &Self, b: &Self, d: &Self) -> Option<Self>;
    /// a·p / d, the division being exact.
    fn raise(a: &Self, p: &Self, d: &Self) -> Option<Self>;
    /// The fraction a / d.
    fn over(self, d: &Self) -> Rational;
}

impl Whole for i128 {
    fn one() -> i128 {
        1
    }
    fn is_zero(&self) -> bool {
        *self == 0
    }
    fn eliminate(p: &i128, a: &i128, q: &i128, b: &i128, d: &i128) -> Option<i128> {
        let difference = p.checked_mul(*a)?.checked_sub(q.checked_mul(*b)?)?;
        quotient(difference, *d)
    }
    fn raise(a: &i128, p: &i128, d: &i128) -> Option<i128> {
        quotient(a.checked_mul(*p)?, *d)
    }
    fn over(self, d: &i128) -> Rational {
        fraction(self, *d)
    }
}

/// Exact quotient, by machine words where they do: a 128-bit division is a slow library call.
fn quotient(n: i128, d: i128) -> Option<i128> {
    match (d, i64::try_from(n), i64::try_from(d)) {
        (1, _, _) => Some(n),
        (_, Ok(a), Ok(b)) => a.checked_div(b).map(i128::from),
        _ => n.checked_div(d),
    }
}

impl Whole for BigInt {
    fn one() -> BigInt {
        One::one()
    }
    fn is_zero(&self) -> bool {
        Zero::is_zero(self)
    }
    fn eliminate(p: &BigInt, a: &BigInt, q: &BigInt, b: &BigInt, d: &BigInt) -> Option<BigInt> {
        Some((p * a - q * b) / d)
    }
    fn raise(a: &BigInt, p: &BigInt, d: &BigInt) -> Option<BigInt> {
        Some(a * p / d)
    }
    fn over(self, d: &BigInt) -> Rational {
        Rational::new(self.into(), d.clone().into())
    }
}

/// How the elimination ended.
enum Cramer<I> {
    /// Every unknown is numerator / determinant, and all rows agree.
    Solved { numerators: Vec<I>, determinant: I },
    /// The unknowns are not all determined, or rows contradict each other.
    Singular,
}

impl<I: Whole> Cramer<I> {
    /// The unknowns, where all are determined.
    fn values(self) -> Option<Vec<Rational>> {
        match self {
            Cramer::Solved {
                numerators,
                determinant,
            } => Some(
                numerators
                    .into_iter()
                    .map(|x| x.over(&determinant))
                    .collect(),
            ),
            Cramer::Singular => None,
        }
    }
}

/// Eliminates `rows` × (`n` + 1) integers; `None` where the integer type is too narrow.
fn cramer<I: Whole>(mut cells: Vec<I>, rows: usize, n: usize) -> Option<Cramer<I>> {
    let width = n + 1;
    if rows < n {
        return Some(Cramer::Singular);
    }
    // pivots[k] is the k-th pivot, a minor of the matrix; a row at level k holds minors that share the first k pivots.
    let mut pivots = vec![I::one()];
    let mut levels = vec![0; rows];
    let mut open_rows: Vec<usize> = (0..rows).collect();
    let mut open_columns: Vec<usize> = (0..n).collect();
    let mut steps = Vec::with_capacity(n);
    for level in 0..n {
        let Some((row, column)) = cheapest_pivot(&cells, width, &open_rows, &open_columns) else {
            return Some(Cramer::Singular);
        };
        open_rows.retain(|r| *r != row);
        open_columns.retain(|c| *c != column);
        if levels[row] < level {
            let (to, from) = (&pivots[level], &pivots[levels[row]]);
            for cell in &mut cells[row * width..(row + 1) * width] {
                if !cell.is_zero() {
                    *cell = I::raise(cell, to, from)?;
                }
            }
        }
        let pivot = cells[row * width + column].clone();
        // The finished row is lifted out, so that the others can change beside it.
        let line = cells[row * width..(row + 1) * width].to_vec();
        for &r in &open_rows {
            let factor = cells[r * width + column].clone();
            if factor.is_zero() {
                continue;
            }
            let shared = &pivots[levels[r]];
            for &c in open_columns.iter().chain(std::iter::once(&n)) {
                let cell = &mut cells[r * width + c];
                if !(cell.is_zero() && line[c].is_zero()) {
                    *cell = I::eliminate(&pivot, cell, &factor, &line[c], shared)?;
                }
            }
            levels[r] = level + 1;
        }
        pivots.push(pivot);
        steps.push((row, column));
    }
    if open_rows.iter().any(|r| !cells[r * width + n].is_zero()) {
        return Some(Cramer::Singular);
    }
    let determinant = pivots[n].clone();
    let mut numerators = vec![None; n];
    let mut solved: Vec<usize> = Vec::with_capacity(n);
    for (level, &(row, column)) in steps.iter().enumerate().rev() {
        let line = &cells[row * width..(row + 1) * width];
        numerators[column] = Some(substitute(
            line,
            &determinant,
            &pivots[level + 1],
            &solved,
            &numerators,
            n,
        )?);
        solved.push(column);
    }
    let numerators = numerators.into_iter().collect::<Option<Vec<I>>>()?;
    Some(Cramer::Solved {
        numerators,
        determinant,
    })
}

/// (right·determinant − Σ coefficient·numerator) / pivot, by steps of which each but the last divides by one.
fn substitute<I: Whole>(
    line: &[I],
    det: &I,
    pivot: &I,
    solved: &[usize],
    x: &[Option<I>],
    n: usize,
) -> Option<I> {
    let one = I::one();
    let mut rest: Option<I> = None;
    for &c in solved {
        let (false, Some(value)) = (line[c].is_zero(), &x[c]) else {
            continue;
        };
        let (p, a) = match &rest {
            None => (det, &line[n]),
            Some(rest) => (&one, rest),
        };
        rest = Some(I::eliminate(p, a, &line[c], value, &one)?);
    }
    match rest {
        None => I::raise(&line[n], det, pivot),
        Some(rest) => I::raise(&rest, &one, pivot),
    }
}

/// The entry with the fewest fill-ins among the open rows and columns; the first of equals.
fn cheapest_pivot<I: Whole>(
    cells: &[I],
    width: usize,
    rows: &[usize],
    columns: &[usize],
) -> Option<(usize, usize)> {
    let mut in_column = vec![0usize; width];
    let mut in_row = Vec::with_capacity(rows.len());
    for &r in rows {
        let mut count = 0;
        for &c in columns {
            if !cells[r * width + c].is_zero() {
                in_column[c] += 1;
                count += 1;
            }
        }
        in_row.push(count);
    }
    let mut best = None;
    let mut least = usize::MAX;
    for (i, &r) in rows.iter().enumerate() {
        if in_row[i] == 0 {
            continue;
        }
        for &c in columns {
            if !cells[r * width + c].is_zero() {
                let fill: usize = (in_row[i] - 1) * (in_column[c] - 1);
                if fill < least {
                    (least, best) = (fill, Some((r, c)));
                }
            }
        }
        if least == 0 {
            break;
        }
    }
    best
}

/// Gauss–Jordan over fractions, for systems that leave something open or contradict themselves; with row and column of each
/// pivot. Every row carries along which of the original rows it is made of.
pub(super) fn reduced(
    system: &System<Rational>,
) -> Result<(Solution<Rational>, Vec<[usize; 2]>), Contradiction> {
    let (n, m) = (system.unknowns.len(), system.laws.len());
    let mut rows: Vec<Vec<Rational>> = (0..m)
        .map(|i| {
            let origin = (0..m).map(|j| {
                if i == j {
                    Rational::one()
                } else {
                    Rational::zero()
                }
            });
            system
                .row(i)
                .iter()
                .cloned()
                .chain([system.right[i].clone()])
                .chain(origin)
                .collect()
        })
        .collect();
    let mut order: Vec<usize> = (0..m).collect();
    let mut pivots: Vec<[usize; 2]> = Vec::new();
    for column in 0..n {
        let rank = pivots.len();
        let Some(found) = (rank..m).find(|r| !rows[*r][column].is_zero()) else {
            continue;
        };
        rows.swap(rank, found);
        order.swap(rank, found);
        let scale = rows[rank][column].recip();
        for value in &mut rows[rank] {
            *value *= &scale;
        }
        let line = rows[rank].clone();
        for (r, row) in rows.iter_mut().enumerate() {
            if r == rank || row[column].is_zero() {
                continue;
            }
            let factor = row[column].clone();
            for (cell, entry) in row.iter_mut().zip(&line) {
                if !entry.is_zero() {
                    *cell -= &factor * entry;
                }
            }
        }
        pivots.push([order[rank], column]);
    }
    let rank = pivots.len();
    if let Some(row) = rows[rank..].iter().find(|row| !row[n].is_zero()) {
        let rows = (0..m).filter(|j| !row[n + 1 + j].is_zero()).collect();
        return Err(Contradiction { rows, rank });
    }
    let mut values = vec![Rational::zero(); n];
    let mut unique = vec![false; n];
    for (row, &[_, column]) in rows.iter().zip(&pivots) {
        values[column] = row[n].clone();
        unique[column] = (0..n).all(|c| c == column || row[c].is_zero());
    }
    let solution = Solution {
        values,
        unique,
        rank,
    };
    Ok((solution, pivots))
}
