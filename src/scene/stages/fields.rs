//! Fields that several kinds of motion have: their dimensions, what they leave open, and how many of them are given.

use crate::expr::Expr;
use crate::scene::claim::Claim;
use crate::scene::fault::Span;
use crate::scene::formulas::Quantity;
use crate::scene::record::{Formula, Text};
use crate::scene::resolver::Resolver;

const ACCELERATION: Quantity = Quantity::other([0, 1, -2], "gravity is a length per time squared");

pub(super) const FORCE: Quantity =
    Quantity::other([1, 1, -2], "a force is a mass times an acceleration");

/// Refuses a motion without an end, or with several: those given, and that of the motion `during` which it happens.
pub(super) fn one_end(
    r: &mut Resolver<'_>,
    ends: &[(&str, bool)],
    lasts: Option<&Expr>,
    (span, message): (Span, &str),
) -> Option<()> {
    let given = ends.iter().filter(|(_, given)| *given);
    let given: Vec<String> = given.map(|(name, _)| format!("`{name}`")).collect();
    let during = "the motion ends with the one `during` which it happens";
    match (given.as_slice(), lasts) {
        ([_], None) | ([], Some(_)) => Some(()),
        ([], None) => r.refuse(span, message, "give one of them"),
        (all, None) => {
            let message = format!("{message}; {} stand here", all.join(" and "));
            r.refuse(span, message, "leave out all but one")
        }
        (all, Some(_)) => {
            let hint = format!("leave out {}: {during}", all.join(" and "));
            r.refuse(span, message, hint)
        }
    }
}

/// An optional formula; the outer `None` means that it was given and could not be read.
pub(super) fn optional(
    r: &mut Resolver<'_>,
    formula: Option<&Formula>,
    quantity: Quantity,
) -> Option<Option<Expr>> {
    match formula {
        None => Some(None),
        Some(f) => r.read(f, quantity).map(Some),
    }
}

/// A body and those that move along with it, each of them once.
pub(super) fn company(
    r: &mut Resolver<'_>,
    body: &Text,
    with: Option<&[Text]>,
) -> Option<(usize, Vec<usize>)> {
    let names: Vec<&Text> = std::iter::once(body)
        .chain(with.into_iter().flatten())
        .collect();
    let all: Vec<Option<usize>> = names.iter().map(|name| r.moving(name)).collect();
    let mut all = all.into_iter().collect::<Option<Vec<usize>>>()?;
    for (i, name) in names.iter().enumerate() {
        if all[..i].contains(&all[i]) {
            let message = format!("`{}` moves along with itself", name.text);
            return r.refuse(name.span, message, "name each body once");
        }
    }
    let with = all.split_off(1);
    Some((all[0], with))
}

/// A coefficient of friction, which is not negative.
pub(super) fn coefficient(r: &mut Resolver<'_>, formula: Option<&Formula>) -> Option<Option<Expr>> {
    bounded(r, formula, Quantity::NUMBER, Claim::Friction)
}

/// Gravity, told by its size.
pub(super) fn weight(r: &mut Resolver<'_>, formula: Option<&Formula>) -> Option<Option<Expr>> {
    bounded(r, formula, ACCELERATION, Claim::Gravity)
}

/// A quantity that may be missing, with what is claimed of it.
fn bounded(
    r: &mut Resolver<'_>,
    formula: Option<&Formula>,
    quantity: Quantity,
    claim: fn(Expr) -> Claim,
) -> Option<Option<Expr>> {
    let read = optional(r, formula, quantity)?;
    if let (Some(e), Some(f)) = (&read, formula) {
        r.claim(f.span, claim(e.clone()));
    }
    Some(read)
}
