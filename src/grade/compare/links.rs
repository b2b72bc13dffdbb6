//! Chains of equations within an answer: in several results, between vectors, matrices and lists.

use super::{broken, named};
use crate::equality;
use crate::expr::{Expr, ratio};
use crate::formula::Content;
use crate::grade::context::Context;
use crate::grade::{Tolerance, number};

/// Two sides that are not equal although a chain behind a name says so, in any of the relations of an answer. Where relations are
/// expected a chain of formulas may be a system of its own, and only numbers are held against each other.
pub(super) fn broken_within(ctx: &Context, content: &Content) -> Option<[Content; 2]> {
    let (sides, signs) = match content {
        Content::Joined(_, parts) => {
            return parts.iter().find_map(|part| broken_within(ctx, part));
        }
        Content::Relations(sides, signs) => (sides, signs),
        _ => return None,
    };
    let is_named = sides.len() > 2 && sides[0].name().is_some();
    let related = !ctx.key.reading.content.chains().is_empty();
    let constant = |side: &Content| side.exprs().iter().all(|e| e.is_constant());
    let pair = is_named.then(|| broken(ctx, &sides[1..], &signs[1..]))??;
    (!related || pair.iter().all(constant)).then_some(pair)
}

/// Whether two values are not equal; where one may be rounded, not even near. Nothing but zero is near zero by its share.
pub(super) fn differ(ctx: &Context, one: &Expr, two: &Expr, rounded: bool) -> bool {
    if !rounded {
        let decision = equality::decide(one, two, ctx.domains());
        return decision.equality.is_different();
    }
    let least = Tolerance::Absolute(ratio(1, 1000));
    match named::is_close(ctx, one, two) {
        Some(close) => !close,
        None => one.is_zero() != two.is_zero() && number::within(one, two, &least) == Some(false),
    }
}

/// Whether two vectors, matrices or lists are not equal although a chain says so: an entry of the first two, or a value of
/// either list that is none of the other.
pub(super) fn lists_apart(
    ctx: &Context,
    pair: [&Content; 2],
    known: &dyn Fn(&Expr) -> bool,
) -> bool {
    let [one, two] = pair.map(Content::exprs);
    let apart = |a: &Expr, b: &Expr| {
        known(a) && known(b) && differ(ctx, a, b, a.is_constant() && b.is_constant())
    };
    let lone = |a: &Expr, others: &[&Expr]| others.iter().all(|b| apart(a, b));
    match pair {
        [Content::Vector(_), Content::Vector(_)] | [Content::Matrix(_), Content::Matrix(_)] => {
            one.len() == two.len() && one.iter().zip(&two).any(|(a, b)| apart(a, b))
        }
        [Content::Either(_), Content::Either(_)] => {
            one.iter().any(|a| lone(a, &two)) || two.iter().any(|b| lone(b, &one))
        }
        _ => false,
    }
}
