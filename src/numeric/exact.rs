//! Exact solution: elimination over exact numbers, and what the equations leave open or how they contradict each other.

use super::field::eliminate;
use super::solution::{Contradiction, Solution};
use super::system::System;
use crate::expr::arithmetic::Number;
use crate::expr::rows::Echelon;

/// Solves a system of fractions, or of numbers with roots, exactly, also where it determines only some unknowns.
pub fn solve_exact<T: Number>(system: &System<T>) -> Result<Solution<T>, Contradiction> {
    match eliminate(system) {
        Some(values) => Ok(Solution::determined(values)),
        None => reduced(system).map(|(solution, _)| solution),
    }
}

/// Gauss–Jordan, for systems that leave something open or contradict themselves; with row and column of each
/// pivot.
pub(super) fn reduced<T: Number>(
    system: &System<T>,
) -> Result<(Solution<T>, Vec<[usize; 2]>), Contradiction> {
    let right = system.right.iter().enumerate();
    let rows = right.map(|(i, right)| [system.row(i), std::slice::from_ref(right)].concat());
    let echelon = Echelon::of(&rows.collect::<Vec<_>>(), system.unknowns.len());
    if let Some(rows) = echelon.conflict {
        return Err(Contradiction { rows });
    }
    let solution = Solution {
        values: echelon.values,
        unique: echelon.unique,
        rank: echelon.pivots.len(),
    };
    Ok((solution, echelon.pivots))
}
