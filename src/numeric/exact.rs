//! Exact solution: elimination over fractions, and what the equations leave open or how they contradict each other.

use super::field::eliminate;
use super::solution::{Contradiction, Solution};
use super::system::System;
use crate::expr::Rational;
use crate::expr::rows::Echelon;

/// Solves a system exactly, also where it determines only some unknowns.
pub fn solve_exact(system: &System<Rational>) -> Result<Solution<Rational>, Contradiction> {
    match eliminate(system) {
        Some(values) => Ok(Solution::determined(values)),
        None => reduced(system).map(|(solution, _)| solution),
    }
}

/// Gauss–Jordan over fractions, for systems that leave something open or contradict themselves; with row and column of each
/// pivot.
pub(super) fn reduced(
    system: &System<Rational>,
) -> Result<(Solution<Rational>, Vec<[usize; 2]>), Contradiction> {
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
