//! Least and largest values under names of their own: `h_min = B` for `h ≥ B`, and `μ ≥ B` for μ_min.

use super::super::Grade;
use super::super::context::Context;
use crate::expr::Symbol;
use crate::formula::{Content, Relation};

/// The name of which this is the least or largest value, and how that name stands to it: `h_min` for h ≥ ….
pub(crate) fn of_which(name: &str) -> Option<(Symbol, Relation)> {
    const ENDS: [(&str, Relation); 6] = [
        ("_min", Relation::GreaterEqual),
        ("_least", Relation::GreaterEqual),
        ("_minimum", Relation::GreaterEqual),
        ("_max", Relation::LessEqual),
        ("_most", Relation::LessEqual),
        ("_maximum", Relation::LessEqual),
    ];
    let found = |(end, relation): &(&str, Relation)| {
        let base = name.strip_suffix(end).filter(|base| !base.is_empty())?;
        Some((Symbol::from(base), *relation))
    };
    ENDS.iter().find_map(found)
}

/// Compares `h_min = B` as the bound that `h ≥ B`, or `h > B`, sets; `None` where this is not what is told.
pub(super) fn compare(
    ctx: &Context,
    (sides, signs): (&[Content], &[Relation]),
    (mine, my_signs): (&[Content], &[Relation]),
) -> Option<Grade> {
    let ([left, right], [sign], [name, value], [Relation::Equal]) = (sides, signs, mine, my_signs)
    else {
        return None;
    };
    let (of, relation) = of_which(name.name()?)?;
    let is_of = |side: &Content| side.name() == Some(&of);
    let (of, sign) = match (is_of(left), is_of(right)) {
        (true, false) => (left, *sign),
        (false, true) => (right, sign.turned()),
        _ => return None,
    };
    if !sign.is_order() || sign.is_below() != relation.is_below() {
        return None;
    }
    let bound = [of.clone(), value.clone()];
    let mut found = super::compare(ctx, (sides, signs), (&bound, &[sign]));
    if found.is_equivalent() {
        let words =
            "the bound is told as the least or largest value; whether it counts itself is not";
        found.assume(vec![words.into()]);
    }
    Some(found)
}
