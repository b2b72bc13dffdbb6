//! Exact solution: elimination over fractions, and what the equations leave open or how they contradict each other.

use num_traits::Zero;

use super::field::eliminate;
use super::solution::{Contradiction, Solution};
use super::system::System;
use crate::expr::rows::reduce;
use crate::expr::{Int, Rational};

/// Solves a system exactly, also where it determines only some unknowns.
pub fn solve_exact(system: &System<Rational>) -> Result<Solution<Rational>, Contradiction> {
    match eliminate(system) {
        Some(values) => Ok(Solution::determined(values)),
        None => reduced(system).map(|(solution, _)| solution),
    }
}

/// Gauss–Jordan over fractions, for systems that leave something open or contradict themselves; with row and column of each
/// pivot. Every row carries along which of the original rows it is made of.
pub(super) fn reduced(
    system: &System<Rational>,
) -> Result<(Solution<Rational>, Vec<[usize; 2]>), Contradiction> {
    let (n, m) = (system.unknowns.len(), system.laws.len());
    let row = |i: usize| {
        let origin = (0..m).map(|j| Rational::from(Int::from(i64::from(i == j))));
        let left = system.row(i).iter().chain([&system.right[i]]).cloned();
        left.chain(origin).collect()
    };
    let mut rows: Vec<Vec<Rational>> = (0..m).map(row).collect();
    let pivots = reduce(&mut rows, n);
    let rank = pivots.len();
    if let Some(row) = rows[rank..].iter().find(|row| !row[n].is_zero()) {
        let rows = (0..m).filter(|j| !row[n + 1 + j].is_zero()).collect();
        return Err(Contradiction { rows });
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
