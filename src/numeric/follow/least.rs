//! Linear equations of any shape: do they contradict each other, and what do they determine?
//!
//! In: a matrix and right-hand sides. Out: one solution with the null space of the matrix, by singular values after rows and
//! columns are scaled by powers of two; or the rows that contradict the others. Knows no mechanics. (Golub & Van Loan,
//! Matrix Computations, 5.5; scaling after Ruiz 2001.)

use nalgebra::{DMatrix, DVector, SVD};

/// Singular values below this share of the largest count as zero.
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
    /// Orthonormal directions in the scaled unknowns along which the equations say nothing, as columns.
    null: DMatrix<f64>,
}

/// Why there is no solution.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum NoSolution {
    /// These rows cannot hold together with the others.
    Contradiction(Vec<usize>),
    /// A number is beyond the doubles, or the singular values did not converge.
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

    /// Whether the value of an unknown is the only one.
    pub fn is_unique(&self, unknown: usize) -> bool {
        self.determines(&[(unknown, 1.0)])
    }
}

/// Solves matrix × unknowns = right.
pub(super) fn solve(matrix: &DMatrix<f64>, right: &DVector<f64>) -> Result<Found, NoSolution> {
    let (m, n) = matrix.shape();
    // The decomposition gives the whole null space only where there are at least as many rows as columns.
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
    let svd = SVD::try_new(scaled.clone(), true, true, f64::EPSILON, 10_000)
        .ok_or(NoSolution::OutOfRange)?;
    let (Some(u), Some(v)) = (&svd.u, &svd.v_t) else {
        return Err(NoSolution::OutOfRange);
    };
    let least = ZERO * svd.singular_values.max();
    let inverse = svd
        .singular_values
        .map(|s| if s > least { s.recip() } else { 0.0 });
    let apply = |b: &DVector<f64>| v.tr_mul(&u.tr_mul(b).component_mul(&inverse));
    let mut x = apply(&b);
    for _ in 0..2 {
        let change = apply(&(&b - &scaled * &x));
        x += change;
    }
    let rows = rows_left(&scaled, &b, &x, m);
    if !rows.is_empty() {
        return Err(NoSolution::Contradiction(rows));
    }
    let idle: Vec<usize> = (0..n).filter(|i| inverse[*i] == 0.0).collect();
    let null = DMatrix::from_fn(n, idle.len(), |i, j| v[(idle[j], i)]);
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
        for (i, right) in b.iter_mut().enumerate() {
            let factor = power(a.row(i).amax());
            a.row_mut(i).scale_mut(factor);
            *right *= factor;
        }
        for (j, unit) in unit.iter_mut().enumerate() {
            let factor = power(a.column(j).amax());
            a.column_mut(j).scale_mut(factor);
            *unit *= factor;
        }
    }
    unit
}
