//! From a closed form to code: arranged for accuracy, with an error bound it can state, in three languages.
//!
//! `arrange` turns an expression into a straight-line program, `program` runs it and bounds its error. Knows nothing of
//! how the closed form was found.

pub mod arrange;
pub mod program;

pub use arrange::{Atoms, Signs, arranged, as_derived, signs, without_angles};
pub use program::{Bound, Program, Step};
