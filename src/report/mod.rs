//! Measures error against run time for every way to the same number. All of it comes out as data; `render` prints it.

pub mod batch;
pub mod growth;
pub mod stiff;
