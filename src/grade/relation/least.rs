//! Least and largest values under names of their own: `h_min = B` for `h ≥ B`, and `μ ≥ B` for μ_min.

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

/// `h_min = B` as the bound that `h ≥ B`, or `h > B`, sets.
pub(super) fn as_bound(
    (sides, signs): (&[Content], &[Relation]),
    (mine, my_signs): (&[Content], &[Relation]),
) -> Option<[Content; 2]> {
    let ([left, right], [sign], [name, value], [Relation::Equal]) = (sides, signs, mine, my_signs)
    else {
        return None;
    };
    let (of, relation) = of_which(name.name()?)?;
    let is_of = |side: &Content| side.name() == Some(&of);
    let sign = match (is_of(left), is_of(right)) {
        (true, false) => *sign,
        (false, true) => sign.turned(),
        _ => return None,
    };
    let along = sign.is_order() && sign.is_below() == relation.is_below();
    let of = if is_of(left) { left } else { right };
    along.then(|| [of.clone(), value.clone()])
}
