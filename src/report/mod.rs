//! Measures error against run time for every way to the same number. All of it comes out as data; `render` prints it.

pub mod errors;
pub mod measure;
pub mod reduced;
pub mod routes;
pub mod sample;
pub mod verdict;

pub use errors::{BINS, Errors};
pub use measure::{Effort, Machine, NoReport, Report, RouteSummary, Row};
pub use routes::{Prepared, Route};

use crate::derive::Derivation;
use crate::scene::Scene;

/// Measures every route of a scene, and judges them. A row of figures that is done is handed on with its number and how many there
/// are; `false` stops the measuring there.
pub fn measure(
    scene: &Scene,
    derivation: Option<&Derivation>,
    effort: Effort,
    row: impl FnMut(&Row, usize, usize) -> bool,
) -> Result<Report, NoReport> {
    let mut report = measure::measured(scene, derivation, effort, row)?;
    verdict::judge(&mut report);
    Ok(report)
}
