//! Elimination in rows of fractions.

use num_traits::Zero;

use super::Rational;
use super::number::{product, sum};

/// Brings rows to their reduced echelon form in the first `n` columns (Gauss and Jordan), whatever stands behind these
/// included. Gives, for each row from the first on, where it stood before and the column of its pivot; the other rows are left
/// without an entry there.
pub fn reduce(rows: &mut [Vec<Rational>], n: usize) -> Vec<[usize; 2]> {
    let mut order: Vec<usize> = (0..rows.len()).collect();
    let mut pivots: Vec<[usize; 2]> = Vec::new();
    for column in 0..n {
        let top = pivots.len();
        let Some(found) = (top..rows.len()).find(|&r| !rows[r][column].is_zero()) else {
            continue;
        };
        rows.swap(top, found);
        order.swap(top, found);
        let scale = rows[top][column].recip();
        let entries = rows[top].iter().enumerate().filter(|(_, k)| !k.is_zero());
        let pivot_row: Vec<(usize, Rational)> =
            entries.map(|(j, k)| (j, product(k, &scale))).collect();
        for (r, row) in rows.iter_mut().enumerate() {
            if r != top && !row[column].is_zero() {
                let factor = row[column].clone();
                for (j, k) in &pivot_row {
                    row[*j] = sum(&row[*j], &product(&factor, k), true);
                }
            }
        }
        for (j, k) in pivot_row {
            rows[top][j] = k;
        }
        pivots.push([order[top], column]);
    }
    pivots
}
