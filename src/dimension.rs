//! Physical dimensions and units of mechanics.

use crate::expr::Rational;

/// A product of powers of mass, length and time. A plane angle has no dimension.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Dimension {
    /// Exponent of mass.
    pub mass: Rational,
    /// Exponent of length.
    pub length: Rational,
    /// Exponent of time.
    pub time: Rational,
}
