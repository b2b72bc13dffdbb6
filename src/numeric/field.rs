//! Sparse elimination over fractions and enclosures.
//!
//! The pivot with the fewest fill-ins goes first (Markowitz), among equals the largest; what is exactly zero is never touched,
//! and what may be zero is no pivot. Over enclosures the outcome encloses the true solution, whatever the pivots.

use super::system::System;
use crate::expr::arithmetic::Number;

/// The solution of a system with as many independent rows as unknowns; `None` where a pivot may be zero, where rows are
/// left over, or beyond 128 unknowns or rows.
pub fn eliminate<T: Number>(system: &System<T>) -> Option<Vec<T>> {
    let (m, n) = (system.laws.len(), system.unknowns.len());
    if m != n || n > 128 {
        return None;
    }
    let mut cells = system.matrix.clone();
    let mut right = system.right.clone();
    // Bit c of pattern[r] tells whether row r has an entry in column c; open columns only.
    let mut pattern = vec![0u128; n];
    let mut in_column = [0u32; 128];
    for (r, bits) in pattern.iter_mut().enumerate() {
        for (c, cell) in cells[r * n..(r + 1) * n].iter().enumerate() {
            if !cell.is_zero() {
                *bits |= 1 << c;
                in_column[c] += 1;
            }
        }
    }
    let mut open: Vec<usize> = (0..n).collect();
    let mut steps = Vec::with_capacity(n);
    for _ in 0..n {
        let (place, column) = pivot(&cells, n, &open, &pattern, &in_column)?;
        let row = open.swap_remove(place);
        let reciprocal = cells[row * n + column].recip()?;
        let rest = pattern[row] & !(1 << column);
        each(rest, |c| in_column[c] -= 1);
        for &r in &open {
            if pattern[r] >> column & 1 == 0 {
                continue;
            }
            pattern[r] &= !(1 << column);
            let factor = cells[r * n + column].times(&reciprocal).negated();
            each(rest, |c| {
                let (i, j) = (r * n + c, row * n + c);
                let change = factor.times(&cells[j]);
                if pattern[r] >> c & 1 == 0 {
                    cells[i] = change;
                    pattern[r] |= 1 << c;
                    in_column[c] += 1;
                } else {
                    cells[i] = cells[i].plus(&change);
                    if cells[i].is_zero() {
                        pattern[r] &= !(1 << c);
                        in_column[c] -= 1;
                    }
                }
            });
            if !right[row].is_zero() {
                right[r] = right[r].plus(&factor.times(&right[row]));
            }
        }
        steps.push((row, column, rest, reciprocal));
    }
    let mut values = vec![T::zero(); n];
    for (row, column, rest, reciprocal) in steps.into_iter().rev() {
        let mut sum = right[row].clone();
        each(rest, |c| {
            if !values[c].is_zero() {
                sum = sum.minus(&cells[row * n + c].times(&values[c]));
            }
        });
        values[column] = if sum.is_zero() {
            sum
        } else {
            sum.times(&reciprocal)
        };
    }
    Some(values)
}

/// Calls `f` for every bit that is set, lowest first.
#[inline]
fn each(mut bits: u128, mut f: impl FnMut(usize)) {
    while bits != 0 {
        f(bits.trailing_zeros() as usize);
        bits &= bits - 1;
    }
}

/// Place in `open` and column of the best pivot.
fn pivot<T: Number>(
    cells: &[T],
    n: usize,
    open: &[usize],
    pattern: &[u128],
    in_column: &[u32; 128],
) -> Option<(usize, usize)> {
    let mut best = None;
    let mut least = (u32::MAX, 0.0);
    for (place, &r) in open.iter().enumerate() {
        let others = pattern[r].count_ones().checked_sub(1)?;
        each(pattern[r], |c| {
            let fill = others * (in_column[c] - 1);
            if fill > least.0 {
                return;
            }
            let size = cells[r * n + c].size();
            if size > 0.0 && (fill < least.0 || size > least.1) {
                (least, best) = ((fill, size), Some((place, c)));
            }
        });
        // One fill-in at most is as good as any that could follow.
        if least.0 <= 1 {
            break;
        }
    }
    best
}
