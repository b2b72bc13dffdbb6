//! The equalities of a line, and what is found of them.

use std::collections::{BTreeMap, BTreeSet};

use crate::expr::{Expr, Symbol};
use crate::formula::{self, Content, Relation};

/// Names with what they stand for.
pub(super) type Values = BTreeMap<Symbol, Expr>;

/// One equality of a line.
pub(super) struct Link {
    /// Its two sides.
    pub sides: [Content; 2],
    /// Left minus right, components of vectors one by one.
    pub differences: Vec<Expr>,
}

impl Link {
    /// Left minus right, where it is no equality of vectors.
    pub fn gap(&self) -> Option<&Expr> {
        match self.differences.as_slice() {
            [one] => Some(one),
            _ => None,
        }
    }
}

/// All that vanishes where links hold.
pub(super) fn gaps(links: &[Link]) -> Vec<Expr> {
    let all = links.iter().flat_map(|link| &link.differences);
    all.cloned().collect()
}

/// The names in links.
pub(super) fn names_in(links: &[Link]) -> BTreeSet<Symbol> {
    let sides = links.iter().flat_map(|link| &link.sides);
    sides.flat_map(Content::symbols).collect()
}

/// What is found of the links of a line.
pub(super) enum Weighed {
    /// All hold.
    Holds,
    /// All hold, some of them with rounded numbers.
    Rounded,
    /// One could not be decided, and none is wrong.
    Open,
    /// What does not hold follows from the wrong line of this number.
    Carried(usize),
    /// The link of this index is the first that does not hold and follows from nothing.
    Slip(usize),
}

pub(super) fn equal(sign: Relation) -> bool {
    matches!(sign, Relation::Equal | Relation::Approximately)
}

/// Whether vectors with an arrow stand in a line.
pub(super) fn in_vectors(links: &[Link]) -> bool {
    links.iter().any(|link| mentions_vectors(&link.sides))
}

/// Whether vectors with an arrow stand in it, whole or by their components.
pub(super) fn mentions_vectors(sides: &[Content]) -> bool {
    let is_one = |name: &Symbol| formula::has_arrow(name) || formula::is_component(name);
    sides.iter().any(|side| side.symbols().iter().any(is_one))
}
