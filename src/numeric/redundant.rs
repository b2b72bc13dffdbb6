//! Which equations of a scene follow from the others, whatever the values of its parameters.
//!
//! At irrational values enclosures never tell that an equation follows from others: what is left of it is an interval
//! around zero. At exact points fractions tell. In: a scene. Out: rows and columns that make a regular system, the same at
//! several random exact points, and which unknowns they determine. That the rows left out agree is then seen at those
//! points, not proved, and whoever uses it has to say so.

use super::exact::reduced;
use super::field::eliminate;
use super::given::given;
use super::points::{needed, random_point};
use super::solution::Solution;
use super::system::{Law, System, assemble};
use crate::expr::Rational;
use crate::expr::arithmetic::Number;
use crate::scene::Scene;

/// How many random exact points have to agree.
pub const POINTS: u64 = 3;

/// A regular part of a system that says as much as all of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    rows: Vec<usize>,
    columns: Vec<usize>,
    /// Whether each unknown is determined.
    unique: Vec<bool>,
    /// The laws left out.
    pub left_out: Vec<Law>,
}

impl Part {
    /// Whether it is all of the system and determines everything.
    pub fn is_whole(&self) -> bool {
        self.left_out.is_empty() && self.unique.iter().all(|u| *u)
    }
}

/// The part that is regular at random points; `None` where the scene has no exact points, its laws contradict each other
/// there, or the points differ.
pub fn regular_part(scene: &Scene) -> Option<Part> {
    let needed = needed(scene);
    let mut parts = (0..POINTS).map(|seed| {
        let point = random_point(&needed, &scene.domains, seed);
        part(&assemble(&given(scene, &point).ok()?))
    });
    let first = parts.next()??;
    let agree = parts.all(|part| part.as_ref() == Some(&first));
    agree.then_some(first)
}

fn part(system: &System<Rational>) -> Option<Part> {
    // Unknowns that are determined are all among the pivots, so those set to zero are none of them.
    let (solution, pivots) = reduced(system).ok()?;
    let mut rows: Vec<usize> = pivots.iter().map(|[row, _]| *row).collect();
    rows.sort_unstable();
    let left_out = (0..system.laws.len()).filter(|r| !rows.contains(r));
    Some(Part {
        left_out: left_out.map(|r| system.laws[r]).collect(),
        rows,
        columns: pivots.iter().map(|[_, column]| *column).collect(),
        unique: solution.unique,
    })
}

/// The solution of the regular part, unknowns that nothing determines set to zero; `None` where a pivot may be zero.
pub fn solve_part<T: Number>(system: &System<T>, part: &Part) -> Option<Solution<T>> {
    let picked = System {
        unknowns: part.columns.iter().map(|c| system.unknowns[*c]).collect(),
        laws: part.rows.iter().map(|r| system.laws[*r]).collect(),
        matrix: part
            .rows
            .iter()
            .flat_map(|r| part.columns.iter().map(|c| system.row(*r)[*c].clone()))
            .collect(),
        right: part.rows.iter().map(|r| system.right[*r].clone()).collect(),
    };
    let found = eliminate(&picked)?;
    let mut values = vec![T::zero(); system.unknowns.len()];
    for (column, value) in part.columns.iter().zip(found) {
        values[*column] = value;
    }
    Some(Solution {
        values,
        unique: part.unique.clone(),
        rank: part.columns.len(),
    })
}
