//! From a closed form to code: arranged for accuracy, with an error bound it can state, as Rust, C or Python.
//!
//! `arrange` turns an expression into a straight-line program, `program` runs it and bounds its error, `range` tells where it
//! over- or underflows, `units` keep it from that, `function` gathers what a reader has to know, `write` writes it out as a `dialect` has it. Knows nothing of how the
//! closed form was found.

pub mod arrange;
mod comment;
mod dd;
mod dialect;
pub mod function;
mod helpers;
mod names;
pub mod program;
mod range;
mod record;
pub mod units;
pub mod write;

pub use arrange::{Atoms, Signs, arranged, as_derived, signs, without_angles};
pub use comment::Heading;
pub use dialect::Language;
pub use dialect::Style;
pub use function::{Function, functions};
pub use program::{Bound, Op, Program, Step};
pub use write::file;
