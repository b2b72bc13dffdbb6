//! Solution in doubles by nalgebra, and the honest answer where the system leaves something open.
//!
//! Rows and columns are first scaled by powers of two, which is exact and takes the units out. A square system whose
//! triangular factor shows no vanishing pivot is solved by LU; everything else by elimination with complete pivoting, which
//! tells which unknowns are unique. Rank in doubles is a judgement (threshold 64·n·2⁻⁵² on the scaled matrix); rank in
//! fractions, from `exact`, is a fact.

use nalgebra::{DMatrix, DVector};

use super::solution::{Contradiction, Solution};
use super::system::System;

/// Solves a system in doubles.
pub fn solve_f64(system: &System<f64>) -> Result<Solution<f64>, Contradiction> {
    let (m, n) = (system.laws.len(), system.unknowns.len());
    if n == 0 {
        let rows: Vec<usize> = (0..m).filter(|i| system.right[*i] != 0.0).collect();
        return if rows.is_empty() {
            Ok(Solution {
                values: Vec::new(),
                unique: Vec::new(),
                rank: 0,
            })
        } else {
            Err(Contradiction { rows, rank: 0 })
        };
    }
    let scaled = Scaled::of(system);
    let matrix = DMatrix::from_row_slice(m, n, &scaled.matrix);
    let right = DVector::from_row_slice(&scaled.right);
    let threshold = 64.0 * n as f64 * f64::EPSILON;
    if m == n {
        let lu = matrix.clone().lu();
        let diagonal = (0..n).map(|i| lu.lu_internal()[(i, i)].abs());
        let regular = diagonal.fold(f64::INFINITY, f64::min) > threshold;
        if let (true, Some(x)) = (regular, lu.solve(&right)) {
            let values: Vec<f64> = x.iter().zip(&scaled.columns).map(|(x, s)| x * s).collect();
            if values.iter().all(|v| v.is_finite()) {
                return Ok(Solution {
                    values,
                    unique: vec![true; n],
                    rank: n,
                });
            }
        }
    }
    by_complete_pivoting(&scaled, threshold)
}

/// Gauss–Jordan with complete pivoting. What remains below the threshold counts as zero, on the left and on the right.
fn by_complete_pivoting(scaled: &Scaled, threshold: f64) -> Result<Solution<f64>, Contradiction> {
    let (m, n) = (scaled.right.len(), scaled.columns.len());
    let mut rows: Vec<Vec<f64>> = (0..m)
        .map(|i| {
            scaled.matrix[i * n..(i + 1) * n]
                .iter()
                .copied()
                .chain([scaled.right[i]])
                .collect()
        })
        .collect();
    let mut origin: Vec<usize> = (0..m).collect();
    let mut pivots: Vec<usize> = Vec::new();
    while pivots.len() < m.min(n) {
        let rank = pivots.len();
        let open = (rank..m)
            .flat_map(|r| (0..n).map(move |c| (r, c)))
            .filter(|(_, c)| !pivots.contains(c));
        let largest = open
            .map(|(r, c)| (rows[r][c].abs(), r, c))
            .fold((0.0, 0, 0), |a, b| if b.0 > a.0 { b } else { a });
        let (size, row, column) = largest;
        // Nothing can be said past an overflow.
        if size <= threshold || !size.is_finite() {
            break;
        }
        rows.swap(rank, row);
        origin.swap(rank, row);
        let pivot = rows[rank][column];
        rows[rank].iter_mut().for_each(|v| *v /= pivot);
        let line = rows[rank].clone();
        for (r, other) in rows.iter_mut().enumerate() {
            let factor = other[column];
            if r != rank && factor != 0.0 {
                other
                    .iter_mut()
                    .zip(&line)
                    .for_each(|(v, p)| *v -= factor * p);
                other[column] = 0.0;
            }
        }
        pivots.push(column);
    }
    let rank = pivots.len();
    let size = scaled
        .right
        .iter()
        .chain(rows[..rank].iter().map(|r| &r[n]))
        .fold(0.0, |a: f64, v| a.max(v.abs()));
    let doubtful = |r: &usize| rows[*r][n].is_nan() || rows[*r][n].abs() > 1e3 * threshold * size;
    let mut contradicting: Vec<usize> = (rank..m).filter(doubtful).map(|r| origin[r]).collect();
    if !contradicting.is_empty() {
        contradicting.sort_unstable();
        return Err(Contradiction {
            rows: contradicting,
            rank,
        });
    }
    let mut values = vec![0.0; n];
    let mut unique = vec![false; n];
    for (row, &column) in rows.iter().zip(&pivots) {
        values[column] = row[n] * scaled.columns[column];
        unique[column] = (0..n).all(|c| pivots.contains(&c) || row[c].abs() <= 1e3 * threshold);
    }
    Ok(Solution {
        values,
        unique,
        rank,
    })
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
        // Rows, columns, rows: enough for the few units that meet in one system.
        for pass in 0..3 {
            if pass == 1 {
                for c in 0..n {
                    let largest = scaled
                        .matrix
                        .iter()
                        .skip(c)
                        .step_by(n)
                        .fold(0.0, |a: f64, v| a.max(v.abs()));
                    let factor = reciprocal_power_of_two(largest);
                    scaled
                        .matrix
                        .iter_mut()
                        .skip(c)
                        .step_by(n)
                        .for_each(|v| *v *= factor);
                    scaled.columns[c] *= factor;
                }
            } else {
                for (row, right) in scaled.matrix.chunks_mut(n).zip(&mut scaled.right) {
                    let factor =
                        reciprocal_power_of_two(row.iter().fold(0.0, |a: f64, v| a.max(v.abs())));
                    row.iter_mut().for_each(|v| *v *= factor);
                    *right *= factor;
                }
            }
        }
        scaled
    }
}

/// 2^−k for a number of size 2^k; 1 for zero, and kept where the factor itself is a normal number.
fn reciprocal_power_of_two(size: f64) -> f64 {
    if size == 0.0 || !size.is_finite() {
        return 1.0;
    }
    let exponent = (size.to_bits() >> 52) as i64 & 0x7ff;
    f64::from_bits(((2046 - exponent).clamp(1, 2046) as u64) << 52)
}
