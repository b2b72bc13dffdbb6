//! What an answer rests on beyond what the whole solution does: its conditions in one sentence, none of them said twice.

use super::Solution;
use super::sentence::sentence;
use super::words::say;
use crate::algebra::{Sign, sign};
use crate::answer::Answer;
use crate::expr::Expr;
use crate::formula::{Piece, Sentence};
use crate::scene::{Ask, Scene};

/// What an answer rests on beyond what the whole solution does, which is told at its end; what is to be shown needs it all.
pub(super) fn given_that(solution: &mut Solution, scene: &Scene, ask: &Ask, answer: &Answer) {
    let is_shown = matches!(ask, Ask::Show { .. });
    let given = answer.assumptions.iter();
    let given = given.filter(|a| {
        let words = a.to_string();
        // Where contacts are is no matter of one answer.
        let is_apart = scene.has_stages() && !words.contains("` lies on `");
        is_shown || is_apart || !solution.assumptions.contains(&words)
    });
    let given = needed(scene, given.cloned().collect());
    if !given.is_empty() {
        let mut text = vec![say("Given that ")];
        text.extend(sentence(scene, &Sentence::join(by_reason(given), "; ")));
        text.push(say(","));
        solution.text(text);
    }
}

/// Conditions without those that follow from another one. Those that say which case it is stay.
fn needed(scene: &Scene, mut all: Vec<Sentence>) -> Vec<Sentence> {
    let mut k = 0;
    while k < all.len() {
        let others = all.iter().enumerate().filter(|(j, _)| *j != k);
        let others = others.flat_map(|(_, other)| other.conditions());
        let others: Vec<(Expr, bool)> = others.collect();
        let follows = |(e, is_open): (Expr, bool)| {
            others.iter().any(|(given, open)| {
                // Long products are not taken apart for their signs.
                if *given == e {
                    return *open || !is_open;
                }
                let domains = scene.domains.given(given, !open);
                match sign(&e, &domains) {
                    Some(Sign::Positive) => true,
                    Some(told) => told.is_not_negative() && !is_open,
                    None => false,
                }
            })
        };
        let is_needed = all[k].condition().is_some() && !is_case(&all[k]);
        match is_needed && all[k].conditions().all(follows) {
            true => drop(all.remove(k)),
            false => k += 1,
        }
    }
    all
}

/// Whether a condition is that of a case, which stands behind it in brackets.
fn is_case(condition: &Sentence) -> bool {
    let opens = |p: &Piece| matches!(p, Piece::Words(words) if words.starts_with(" ("));
    condition.0.iter().any(opens)
}

/// Conditions one after the other; those with the same reason in brackets behind them share it.
fn by_reason(all: Vec<Sentence>) -> Vec<Sentence> {
    let mut out: Vec<Sentence> = Vec::new();
    for one in all {
        let opens = |p: &Piece| matches!(p, Piece::Words(words) if words.starts_with(" ("));
        let reason = one.0.iter().rposition(opens).map(|at| &one.0[at..]);
        match (out.last_mut(), reason) {
            (Some(before), Some(reason)) if before.0.ends_with(reason) => {
                let (own, reason) = (before.0.len() - reason.len(), reason.to_vec());
                before.0.truncate(own);
                match between(&before.0, &one.0) {
                    Some(chain) => before.0 = [chain, reason].concat(),
                    None => {
                        before.0.push(Piece::Words(String::from(" and ")));
                        before.0.extend(one.0);
                    }
                }
            }
            _ => out.push(one),
        }
    }
    out
}

/// Two lower or upper limits of one quantity as a chain, a ≤ x ≤ b.
fn between(one: &[Piece], two: &[Piece]) -> Option<Vec<Piece>> {
    let sides = |all: &[Piece]| match all {
        [
            Piece::Formula(large),
            Piece::Words(sign),
            Piece::Formula(small),
            ..,
        ] => (sign == " ≥ ").then(|| (large.clone(), small.clone())),
        _ => None,
    };
    let ((a, b), (c, d)) = (sides(one)?, sides(two)?);
    let [low, middle, high] = match (a == d, b == c) {
        (true, _) => [b, a, c],
        (_, true) => [d, b, a],
        _ => return None,
    };
    let at_most = || Piece::Words(String::from(" ≤ "));
    let formula = Piece::Formula;
    Some(vec![
        formula(low),
        at_most(),
        formula(middle),
        at_most(),
        formula(high),
    ])
}
