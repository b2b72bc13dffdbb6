//! Linear equations of any shape: do they contradict each other, and what do they determine?
//!
//! In: a matrix and right-hand sides. Out: one solution with the null space of the matrix, by QR with
//! column pivoting after rows and columns are scaled by powers of two; or the rows that contradict the others. Knows no
//! mechanics. (Golub & Van Loan, Matrix Computations, 5.4 and 5.5; scaling after Ruiz 2001.)

use nalgebra::{DMatrix, DVector};

/// Diagonal entries of the triangle below this share of the first count as zero.
const ZERO: f64 = 1e-12;
/// What is left of a row may be this share of its terms.
const LEFT: f64 = 1e-9;
/// A direction in the null space that moves an unknown by less than this leaves it determined.
const STILL: f64 = 1e-8;

/// One solution and all that may be added to it.
#[derive(Clone, Debug)]
pub(super) struct Found {
    /// One value of each unknown.
    pub values: Vec<f64>,
    /// Size that each unknown has in the scaled equations.
    pub unit: Vec<f64>,
    /// Independent directions of length 1 in the scaled unknowns along which the equations say nothing, as columns.
    null: DMatrix<f64>,
}

/// Why there is no solution.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum NoSolution {
    /// These rows cannot hold together with the others.
    Contradiction(Vec<usize>),
    /// A number is beyond the doubles.
    OutOfRange,
}

impl Found {
    /// Whether every solution has the same value of Σ coefficient × unknown.
    pub fn determines(&self, terms: &[(usize, f64)]) -> bool {
        let size: f64 = terms.iter().map(|(i, k)| (k * self.unit[*i]).abs()).sum();
        self.null.column_iter().all(|direction| {
            let moved: f64 = terms
                .iter()
                .map(|(i, k)| k * self.unit[*i] * direction[*i])
                .sum();
            moved.abs() <= STILL * size
        })
    }

    /// How many of the equations are independent.
    pub fn rank(&self) -> usize {
        self.values.len() - self.null.ncols()
    }

    /// Whether the value of an unknown is the only one.
    pub fn is_unique(&self, unknown: usize) -> bool {
        self.determines(&[(unknown, 1.0)])
    }
}

/// Solves matrix × unknowns = right.
pub(super) fn solve(matrix: &DMatrix<f64>, right: &DVector<f64>) -> Result<Found, NoSolution> {
    let (m, n) = matrix.shape();
    // At least as many rows as columns, so that the triangle has all columns.
    let mut scaled = DMatrix::zeros(m.max(n), n);
    scaled.rows_mut(0, m).copy_from(matrix);
    let mut b = DVector::zeros(m.max(n));
    b.rows_mut(0, m).copy_from(right);
    if scaled.iter().chain(b.iter()).any(|v| !v.is_finite()) {
        return Err(NoSolution::OutOfRange);
    }
    let unit = balance(&mut scaled, &mut b);
    if n == 0 {
        return match rows_left(&scaled, &b, &DVector::zeros(0), m) {
            rows if rows.is_empty() => Ok(Found {
                values: Vec::new(),
                unit,
                null: DMatrix::zeros(0, 0),
            }),
            rows => Err(NoSolution::Contradiction(rows)),
        };
    }
    let qr = scaled.clone().col_piv_qr();
    let (q, r) = (qr.q(), qr.r());
    let mut order = DMatrix::from_fn(1, n, |_, j| j);
    qr.p().permute_columns(&mut order);
    let least = ZERO * r[(0, 0)].abs();
    let rank = (0..n).take_while(|i| r[(*i, *i)].abs() > least).count();
    let triangle = r.view((0, 0), (rank, rank));
    let apply = |b: &DVector<f64>| -> Option<DVector<f64>> {
        let turned = q.tr_mul(b);
        let found = triangle.solve_upper_triangular(&turned.rows(0, rank))?;
        let mut x = DVector::zeros(n);
        (0..rank).for_each(|i| x[order[i]] = found[i]);
        Some(x)
    };
    let mut x = apply(&b).ok_or(NoSolution::OutOfRange)?;
    for _ in 0..2 {
        x += apply(&(&b - &scaled * &x)).ok_or(NoSolution::OutOfRange)?;
    }
    let rows = rows_left(&scaled, &b, &x, m);
    if !rows.is_empty() {
        return Err(NoSolution::Contradiction(rows));
    }
    let mut null = DMatrix::zeros(n, n - rank);
    let rest = r.view((0, rank), (rank, n - rank)).clone_owned();
    let rest = triangle
        .solve_upper_triangular(&rest)
        .ok_or(NoSolution::OutOfRange)?;
    for j in 0..n - rank {
        (0..rank).for_each(|i| null[(order[i], j)] = -rest[(i, j)]);
        null[(order[rank + j], j)] = 1.0;
        let length = null.column(j).norm();
        null.column_mut(j).unscale_mut(length);
    }
    let values: Vec<f64> = x.iter().zip(&unit).map(|(x, s)| x * s).collect();
    match values.iter().all(|v| v.is_finite()) {
        true => Ok(Found { values, unit, null }),
        false => Err(NoSolution::OutOfRange),
    }
}

/// Rows that do not hold, among the first m.
fn rows_left(a: &DMatrix<f64>, b: &DVector<f64>, x: &DVector<f64>, m: usize) -> Vec<usize> {
    let left = b - a * x;
    let size = (a.abs() * x.abs() + b.abs()).amax();
    (0..m)
        .filter(|i| left[*i].is_nan() || left[*i].abs() > LEFT * size)
        .collect()
}

/// Scales rows and columns towards largest entries of one; gives what each column was multiplied by.
fn balance(a: &mut DMatrix<f64>, b: &mut DVector<f64>) -> Vec<f64> {
    let mut unit = vec![1.0; a.ncols()];
    let power = |size: f64| match size > 0.0 {
        true => (-size.log2() / 2.0).round().clamp(-500.0, 500.0).exp2(),
        false => 1.0,
    };
    for _ in 0..12 {
        let mut changes = false;
        for (i, right) in b.iter_mut().enumerate() {
            let factor = power(a.row(i).amax());
            a.row_mut(i).scale_mut(factor);
            *right *= factor;
            changes |= factor != 1.0;
        }
        for (j, unit) in unit.iter_mut().enumerate() {
            let factor = power(a.column(j).amax());
            a.column_mut(j).scale_mut(factor);
            *unit *= factor;
            changes |= factor != 1.0;
        }
        // After a round that changes nothing none does.
        if !changes {
            break;
        }
    }
    unit
}
