//! Solution in doubles by nalgebra, and the honest answer where the system leaves something open.
//!
//! Rows and columns are first scaled by powers of two, which is exact and takes the units out. A square system whose
//! triangular factor shows no vanishing pivot is regular. Where one seems to vanish, a mass of 1e−15 beside one of 1 may be
//! the reason: enclosures then tell whether any matrix within a few roundings of this one, entry by entry, is singular. The
//! values are the nearest doubles, by enclosures or fractions, and by LU with refinement only beyond 128 unknowns: a light
//! body loses no digits to a heavy one, and a contact at rest is at rest. All else goes to `least`, which tells which
//! unknowns are unique. Rank in doubles is a judgement; rank in fractions, from `exact`, is a fact.

use nalgebra::{DMatrix, DVector};

use super::exact::solve_exact;
use super::field::eliminate;
use super::least::{NoSolution, solve};
use super::solution::{Contradiction, Solution};
use super::system::System;
use crate::expr::number::{from_f64, to_f64};
use crate::interval::dyadic::Dyadic;
use crate::interval::{Big, Enclosure, Outcome};

/// Solves a system in doubles.
pub fn solve_f64(system: &System<f64>) -> Result<Solution<f64>, Contradiction> {
    let n = system.unknowns.len();
    if system.laws.len() == n && n > 0 {
        let scaled = Scaled::of(system);
        let near = lu(&scaled, 2, threshold(n));
        let values =
            nearest(system).filter(|_| near.is_some() || is_regular(system, &scaled.columns));
        if let Some(values) = values.or(near) {
            return Ok(Solution::determined(values));
        }
    }
    of_any_shape(system)
}

/// The same where the last digits do not matter: LU with refinement, and what equations of any shape get where a pivot seems
/// to vanish. A singular system costs no more than a regular one.
pub fn solve_roughly(system: &System<f64>) -> Result<Solution<f64>, Contradiction> {
    match lu_scaled(system, 2) {
        Some(values) => Ok(Solution::determined(values)),
        None => of_any_shape(system),
    }
}

/// A solution that tells which unknowns are unique.
fn of_any_shape(system: &System<f64>) -> Result<Solution<f64>, Contradiction> {
    let (m, n) = (system.laws.len(), system.unknowns.len());
    let matrix = DMatrix::from_row_slice(m, n, &system.matrix);
    let found = match solve(&matrix, &DVector::from_row_slice(&system.right)) {
        Ok(found) => found,
        Err(NoSolution::Contradiction(rows)) => return Err(Contradiction { rows }),
        Err(NoSolution::OutOfRange) => return Err(Contradiction { rows: Vec::new() }),
    };
    Ok(Solution {
        unique: (0..n).map(|i| found.is_unique(i)).collect(),
        rank: found.rank(),
        values: found.values,
    })
}

/// What counts as zero in a scaled matrix of n unknowns.
fn threshold(n: usize) -> f64 {
    64.0 * n as f64 * f64::EPSILON
}

/// LU of the scaled system with steps of refinement; `None` where it is not square or a pivot seems to vanish.
pub fn lu_scaled(system: &System<f64>, steps: usize) -> Option<Vec<f64>> {
    let n = system.unknowns.len();
    let square = system.laws.len() == n && n > 0;
    square.then(|| lu(&Scaled::of(system), steps, threshold(n)))?
}

/// LU with steps of refinement, after which small unknowns are as good as large ones (Skeel 1980).
fn lu(scaled: &Scaled, steps: usize, least: f64) -> Option<Vec<f64>> {
    let n = scaled.columns.len();
    let matrix = DMatrix::from_row_slice(n, n, &scaled.matrix);
    let right = DVector::from_row_slice(&scaled.right);
    let lu = matrix.clone().lu();
    let diagonal = (0..n).map(|i| lu.lu_internal()[(i, i)].abs());
    if diagonal.fold(f64::INFINITY, f64::min) <= least {
        return None;
    }
    let mut x = lu.solve(&right)?;
    for _ in 0..steps {
        let change = lu.solve(&(&right - &matrix * &x))?;
        x += change;
    }
    let values: Vec<f64> = x.iter().zip(&scaled.columns).map(|(x, s)| x * s).collect();
    values.iter().all(|v| v.is_finite()).then_some(values)
}

/// The nearest doubles to the solution, the coefficients taken as exact: by enclosures, and by fractions where those are too
/// wide to tell.
fn nearest(system: &System<f64>) -> Option<Vec<f64>> {
    let point = |v: &f64| match Dyadic::from_f64(*v) {
        Some(v) => Outcome::Value(Big::<128>(Enclosure::point(v))),
        None => Outcome::Unknown,
    };
    let enclosed = eliminate(&system.map(point));
    let rounded = |v: Outcome<Big<128>>| v.value()?.0.nearest();
    let found = enclosed.and_then(|x| x.into_iter().map(rounded).collect());
    found.or_else(|| {
        let cells = system.matrix.iter().chain(&system.right);
        let finite = cells.copied().all(f64::is_finite);
        let exact = finite.then(|| system.map(|v| from_f64(*v).unwrap_or_default()))?;
        let exact = solve_exact(&exact).ok().filter(Solution::is_determined)?;
        Some(exact.values.iter().map(to_f64).collect())
    })
}

/// Whether every matrix whose entries differ from these by 64·2⁻⁵² of themselves is regular too, which no choice of units
/// changes: the spectral radius of |A⁻¹||A| is below 2⁵²/64 (Oettli & Prager 1964; Bauer 1966).
fn is_regular(system: &System<f64>, units: &[f64]) -> bool {
    let n = system.unknowns.len();
    let mut unit = system.clone();
    let columns = (0..n).map(|column| {
        unit.right.fill(0.0);
        unit.right[column] = 1.0;
        nearest(&unit)
    });
    let Some(inverse) = columns.collect::<Option<Vec<Vec<f64>>>>() else {
        return false;
    };
    // Powers bring the start near the vector of Perron, for which the bound is sharp; with any positive one it is a bound.
    let mut vector = units.to_vec();
    let mut radius = f64::INFINITY;
    for _ in 0..4 {
        let sizes: Vec<f64> = (0..n)
            .map(|r| {
                system
                    .row(r)
                    .iter()
                    .zip(&vector)
                    .map(|(a, d)| a.abs() * d)
                    .sum()
            })
            .collect();
        let next: Vec<f64> = (0..n)
            .map(|i| (0..n).map(|j| inverse[j][i].abs() * sizes[j]).sum())
            .collect();
        let growth = next.iter().zip(&vector).map(|(b, d)| b / d);
        radius = radius.min(growth.fold(0.0, |a, b| if b > a || b.is_nan() { b } else { a }));
        vector = next;
    }
    radius < 1.0 / (64.0 * f64::EPSILON)
}

/// A system whose largest entries per row and column lie near one.
pub(super) struct Scaled {
    /// Coefficients, row after row.
    pub matrix: Vec<f64>,
    /// Right-hand sides.
    pub right: Vec<f64>,
    /// The factor by which each unknown of the scaled system is multiplied to get the true one.
    pub columns: Vec<f64>,
}

impl Scaled {
    pub(super) fn of(system: &System<f64>) -> Scaled {
        let n = system.unknowns.len();
        let mut scaled = Scaled {
            matrix: system.matrix.clone(),
            right: system.right.clone(),
            columns: vec![1.0; n],
        };
        // Middles of rows and columns in turn find the units that meet in one system (Hamming's scaling); the last pass brings
        // the largest entry of each row near one.
        for pass in 0..9 {
            if pass % 2 == 1 {
                for c in 0..n {
                    let factor = 2f64.powi(-middle(scaled.matrix.iter().skip(c).step_by(n)));
                    let column = scaled.matrix.iter_mut().skip(c).step_by(n);
                    column.for_each(|v| *v *= factor);
                    scaled.columns[c] *= factor;
                }
            } else {
                for (row, right) in scaled.matrix.chunks_mut(n).zip(&mut scaled.right) {
                    let factor = match pass {
                        8 => reciprocal_power_of_two(
                            row.iter().fold(0.0, |a: f64, v| a.max(v.abs())),
                        ),
                        _ => 2f64.powi(-middle(row.iter())),
                    };
                    row.iter_mut().for_each(|v| *v *= factor);
                    *right *= factor;
                }
            }
        }
        scaled
    }
}

/// The middle between the powers of two of the smallest and the largest entry, zeros aside; 0 where there are none.
fn middle<'a>(entries: impl Iterator<Item = &'a f64>) -> i32 {
    let power = |v: &f64| ((v.to_bits() >> 52) & 0x7ff) as i32 - 1023;
    let powers = entries.filter(|v| **v != 0.0 && v.is_finite()).map(power);
    let ends = powers.fold(None, |ends: Option<(i32, i32)>, p| {
        Some(ends.map_or((p, p), |(low, high)| (low.min(p), high.max(p))))
    });
    ends.map_or(0, |(low, high)| (low + high) / 2)
}

/// 2^−k for a number of size 2^k; 1 for zero, and kept where the factor itself is a normal number.
fn reciprocal_power_of_two(size: f64) -> f64 {
    if size == 0.0 || !size.is_finite() {
        return 1.0;
    }
    let exponent = (size.to_bits() >> 52) as i64 & 0x7ff;
    f64::from_bits(((2046 - exponent).clamp(1, 2046) as u64) << 52)
}
