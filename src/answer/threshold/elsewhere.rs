//! What is so of a threshold where its value does not lie within the range of the parameter, or is not real.
//!
//! In: the value, what it needs, and the difference of the sides. Out: words for the other part of the domain, where it is proved
//! that the relation always holds there, or never does.

use super::Wanted;
use crate::answer::Answer;
use crate::answer::calc::keeps_to;
use crate::answer::solve::{Root, placing};
use crate::domain::{Domains, Origin};
use crate::expr::{Expr, Symbol};
use crate::formula::{Relation, Sentence, sentence};

/// Tells what is so where the one value does not lie within the range of the parameter: always or never, where that is proved.
/// With the value at the very end of the range there may be nothing beyond it.
pub(super) fn otherwise(
    out: &mut Answer,
    parameter: &Symbol,
    gap: &Expr,
    relation: Relation,
    root: &Root,
    domains: &Domains,
) {
    let [(need, closed)] = root.needs.as_slice() else {
        return;
    };
    let strict = matches!(relation, Relation::Less | Relation::Greater);
    let holds = |at_end: bool| holds_there(gap, relation, &domains.given(&-need, at_end));
    let at_end = !closed || strict && holds(true) == Some(false);
    let Some(holds) = holds(at_end) else {
        return;
    };
    if at_end && *closed {
        let [told, sharper] =
            [true, false].map(|closed| placing(parameter, &[(need.clone(), closed)]));
        let mut same = out
            .assumptions
            .iter_mut()
            .filter(|one| told.as_ref() == Some(*one));
        if let (Some(one), Some(sharper)) = (same.next(), sharper) {
            *one = sharper;
        }
    }
    out.text.push(instead(parameter, (&-need, at_end), holds));
}

/// Tells what is so where what stands under the roots of the values is negative, or zero: always or never, where that is proved.
pub(super) fn unreal(
    out: &mut Answer,
    parameter: &Symbol,
    gap: &Expr,
    relation: Relation,
    real: &Wanted,
    domains: &Domains,
) {
    let [core] = real.cores.as_slice() else {
        return;
    };
    let beyond = -core;
    for at_end in [true, false] {
        if let Some(holds) = holds_there(gap, relation, &domains.given(&beyond, at_end)) {
            out.text.push(instead(parameter, (&beyond, at_end), holds));
            return;
        }
    }
}

/// Whether a relation is proved to hold on a whole domain, or nowhere on it. A motion may as well not come to its end there; on a
/// domain that is empty everything would be proved.
fn holds_there(gap: &Expr, relation: Relation, domains: &Domains) -> Option<bool> {
    let mut domains = domains.clone();
    let is_ending = |origin: &Origin| matches!(origin, Origin::Ending(_));
    domains.relations.retain(|r| !is_ending(&r.origin));
    let turned = match relation.is_below() {
        true => -gap,
        false => gap.clone(),
    };
    let strict = matches!(relation, Relation::Less | Relation::Greater);
    let holds = keeps_to(&turned, !strict, &domains)?;
    let fails = keeps_to(&-turned, strict, &domains) == Some(true);
    (!(holds && fails)).then_some(holds)
}

/// That a relation holds for every value of a parameter or for none, where something is positive, or not negative.
fn instead(parameter: &Symbol, (there, at_end): (&Expr, bool), holds: bool) -> Sentence {
    let instead = match at_end {
        true => Sentence::not_negative(there),
        false => Sentence::positive(there),
    };
    let how = if holds { "every" } else { "no" };
    sentence!(
        "where {} instead, it holds for {} {}",
        instead,
        how,
        parameter
    )
}
