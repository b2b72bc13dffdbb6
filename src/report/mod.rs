//! Measures error against run time for every way to the same number. All of it comes out as data; `render` prints it.

pub mod measure;
pub mod reduced;
pub mod routes;
pub mod sample;
pub mod verdict;

pub use measure::{BINS, Effort, Machine, NoReport, Report, Row, measure};
pub use routes::{Prepared, Route};
