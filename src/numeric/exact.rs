//! Exact solution: elimination over fractions, and what the equations leave open or how they contradict each other.

use num_traits::{One, Zero};

use super::field::eliminate;
use super::solution::{Contradiction, Solution};
use super::system::System;
use crate::expr::Rational;

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
