//! The independent check: from a scene and values of its symbols straight to numbers, by all equations at once.
//!
//! `given` puts numbers for formulas, `assemble` writes every equation of the scene from its geometry, `solve_exact` and
//! `solve_f64` solve them. Imports `expr` for evaluation, `interval`, `domain` and `scene`; never `algebra`, `laws` or `derive`, which
//! is why agreement with a derived formula means something.

pub mod answer;
pub mod correct;
pub mod doubles;
pub mod energy;
pub mod exact;
pub mod field;
pub mod float;
pub mod follow;
pub mod friction;
pub mod given;
pub mod invariants;
mod jet;
mod least;
pub mod no_answer;
mod number;
pub mod path;
pub mod points;
pub mod random;
pub mod redundant;
pub mod several;
pub mod solution;
pub mod system;
pub mod values;

#[cfg(test)]
mod tests;

pub use crate::expr::arithmetic::Number;
pub use answer::{Answer, Answered, Solved, answer, answers, solved};
pub use correct::{Correct, CorrectAnswers, How, correct};
pub use doubles::doubles;
pub use energy::{energy_after, energy_before, energy_lost};
pub use exact::solve_exact;
pub use field::eliminate;
pub use float::{lu_scaled, solve_f64, solve_roughly};
pub use follow::{Followed, Lost, follow};
pub use friction::settle;
pub use given::{Given, Reason, Undefined, given};
pub use invariants::{ContactReport, Identity, Invariant, contact_reports, identities};
pub use no_answer::NoAnswer;
pub use points::{Needed, needed, point_of_any_size, random_point, rounded};
pub use solution::{Contradiction, Motion, Solution, motion};
pub use system::{Law, System, Unknown, assemble, motion_of};
pub use values::{NoPoint, exact_values, values};
