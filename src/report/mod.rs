//! Measures error against run time for every way to the same number. All of it comes out as data; `render` prints it.

pub mod errors;
pub mod measure;
pub mod reduced;
pub mod routes;
pub mod sample;
pub mod verdict;

pub use errors::{BINS, Errors};
pub use measure::{Effort, Machine, NoReport, Report, RouteSummary, Row, measure};
pub use routes::{Prepared, Route};
