//! Where symbols live: the connected set of values a formula is claimed for.

use std::collections::BTreeMap;

use crate::expr::{Rational, Symbol};

/// One end of an interval: `value`, or `value`·π.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Limit {
    /// The number, or the coefficient of π.
    pub value: Rational,
    /// Whether `value` counts in units of π.
    pub of_pi: bool,
    /// Whether the end itself is excluded.
    pub open: bool,
}

/// The interval a symbol ranges over; a missing end is infinite.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Domain {
    /// Lower end.
    pub low: Option<Limit>,
    /// Upper end.
    pub high: Option<Limit>,
}

/// The domain of a formula: a product of intervals, restricted to unit circles for declared unit vectors.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Domains {
    /// Interval of each declared symbol. An undeclared symbol is taken as positive, an undeclared symbol that occurs under
    /// sin, cos or tan as an angle in the first quadrant; whoever relies on that prints it as an assumption.
    pub symbols: BTreeMap<Symbol, Domain>,
    /// Pairs (a, b) of symbols with a² + b² = 1: components of unit vectors. Each lies in [−1, 1].
    pub unit_vectors: Vec<[Symbol; 2]>,
}
