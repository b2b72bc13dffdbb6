//! Elimination in rows of exact numbers.

use super::arithmetic::Number;

/// Brings rows to their reduced echelon form in the first `n` columns (Gauss and Jordan), whatever stands behind these
/// included. Gives, for each row from the first on, where it stood before and the column of its pivot; the other rows are left
/// without an entry there.
pub fn reduce<T: Number>(rows: &mut [Vec<T>], n: usize) -> Vec<[usize; 2]> {
    let mut order: Vec<usize> = (0..rows.len()).collect();
    let mut pivots: Vec<[usize; 2]> = Vec::new();
    for column in 0..n {
        let top = pivots.len();
        let mut below = (top..rows.len()).filter_map(|r| Some((r, rows[r][column].recip()?)));
        let Some((found, scale)) = below.next() else {
            continue;
        };
        rows.swap(top, found);
        order.swap(top, found);
        let entries = rows[top].iter().enumerate().filter(|(_, k)| !k.is_zero());
        let pivot_row: Vec<(usize, T)> = entries.map(|(j, k)| (j, k.times(&scale))).collect();
        for (r, row) in rows.iter_mut().enumerate() {
            if r != top && !row[column].is_zero() {
                let factor = row[column].clone();
                for (j, k) in &pivot_row {
                    row[*j] = row[*j].minus(&factor.times(k));
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

/// What equations say of their unknowns.
pub struct Echelon<T> {
    /// For each independent row where it stood before, and the column of its pivot.
    pub pivots: Vec<[usize; 2]>,
    /// A value of each unknown, zero where it is open.
    pub values: Vec<T>,
    /// Whether each unknown has no other value.
    pub unique: Vec<bool>,
    /// Rows of which a combination reads 0 = 1, if there is one.
    pub conflict: Option<Vec<usize>>,
}

impl<T: Number> Echelon<T> {
    /// Of rows with `n` coefficients and their right side.
    pub fn of(rows: &[Vec<T>], n: usize) -> Echelon<T> {
        let mut reduced = rows.to_vec();
        let pivots = reduce(&mut reduced, n);
        let rank = pivots.len();
        let clash = |row: &&Vec<T>| !row[n].is_zero();
        // Which rows were combined is asked only where they clash: then each carries along what it is made of.
        let conflict = reduced[rank..].iter().find(clash).map(|_| {
            let entry = |is_own| if is_own { T::one() } else { T::zero() };
            let made = |i| (0..rows.len()).map(move |j| entry(i == j));
            let marked = rows.iter().enumerate();
            let marked = marked.map(|(i, row)| row.iter().cloned().chain(made(i)).collect());
            let mut marked: Vec<Vec<T>> = marked.collect();
            reduce(&mut marked, n);
            let clash = marked[rank..].iter().find(clash);
            let of = |row: &Vec<T>| {
                (0..rows.len())
                    .filter(|j| !row[n + 1 + j].is_zero())
                    .collect()
            };
            clash.map(of).unwrap_or_default()
        });
        let mut values = vec![T::zero(); n];
        let mut unique = vec![false; n];
        for (row, &[_, column]) in reduced.iter().zip(&pivots) {
            values[column] = row[n].clone();
            unique[column] = (0..n).all(|c| c == column || row[c].is_zero());
        }
        Echelon {
            pivots,
            values,
            unique,
            conflict,
        }
    }
}
