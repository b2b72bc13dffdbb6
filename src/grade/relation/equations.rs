//! Two equations, by the parts that only one of them has: a root lost, a root gained, or the same solutions.

use super::factor::{turned_term, unrooted};
use super::locus::{self, Compared, Extent, Part};
use super::solved::{same_angle, solve_for, solved_in, unknowns};
use super::told::{GAINED, LOST, OTHER, told};
use super::{
    APART, Normal, REALS, are_equations, given_not_zero, listed, not_zero, over_reals,
    same_solutions, says_nothing, sign_of, sought_of, undecided,
};
use crate::algebra::Sign;
use crate::domain::Domains;
use crate::equality;
use crate::expr::{Expr, Symbol};
use crate::grade::context::Context;
use crate::grade::{Apart, Diagnosis, Grade};
use std::collections::BTreeSet;

/// Two equations.
pub(super) fn equations(ctx: &Context, expected: &Normal, answer: &Normal) -> Grade {
    let mut finding = solutions(ctx, expected, answer);
    if finding.is_equivalent() {
        let domains = ctx
            .domains()
            .of(&[&expected.difference, &answer.difference]);
        let (f, g) = (&expected.difference, &answer.difference);
        // In one symbol it is looked at what holds where something is divided by zero.
        if unknowns(f, g).len() > 1 {
            finding.assume(poles(f, g, &domains).iter().map(not_zero).collect());
        }
    }
    finding
}

/// What one equation divides by and the other does not, where it may be zero with the other fulfilled.
fn poles(f: &Expr, g: &Expr, domains: &Domains) -> Vec<Expr> {
    let matters = |pole: &Expr| {
        let excluded = |name: &Symbol| {
            let Some(root) = solve_for(pole, name, domains) else {
                return false;
            };
            [f, g]
                .iter()
                .any(|e| sign_of(&e.put(name, &root), domains).is_some_and(Sign::is_strict))
        };
        !pole.symbols().iter().any(excluded)
    };
    equality::poles(f, g, domains)
        .into_iter()
        .filter(matters)
        .collect()
}

/// What is sought among the symbols that two equations share.
type Sought<'a> = &'a dyn Fn(BTreeSet<Symbol>) -> BTreeSet<Symbol>;

/// Equations of which one holds, as their products: what a factor fulfils counts, whatever is sought.
pub(super) fn alternatives(ctx: &Context, f: &Expr, g: &Expr) -> Grade {
    let found = by_parts(ctx, f, g, &|_| BTreeSet::new());
    found.unwrap_or_else(|| undecided("the cases could not be solved to compare their solutions"))
}

/// Two equations by their extents and the parts that only one of them has, where these tell.
fn by_parts(ctx: &Context, f: &Expr, g: &Expr, sought: Sought) -> Option<Grade> {
    let compared = locus::compare(f, g, ctx.domains())?;
    match compared.extents {
        [Extent::All, Extent::All] | [Extent::None, Extent::None] => {
            Some(vacuous(ctx, f, g, sought))
        }
        [Extent::All, _] => {
            let words = "the expected equation holds everywhere, and the answer does not";
            Some(Grade::different("DIFF_EQUATION", "solutions", words))
        }
        [_, Extent::All] => {
            let words = "the answer holds everywhere: it says nothing";
            Some(Grade::different("DIFF_EQUATION", "solutions", words))
        }
        [Extent::None, _] | [_, Extent::None] => {
            let beyond = vacuous(ctx, f, g, sought);
            match beyond.is_equivalent() {
                true => Some(beyond),
                false => from_parts(ctx, f, g, compared, sought),
            }
        }
        _ => from_parts(ctx, f, g, compared, sought),
    }
}

/// Two equations by their solutions, wherever both have values.
fn solutions(ctx: &Context, expected: &Normal, answer: &Normal) -> Grade {
    let domains = ctx.domains();
    let (f, g) = (&expected.difference, &answer.difference);
    let sought: Sought = &|shared| sought_of(ctx, shared);
    if let Some(finding) = by_parts(ctx, f, g, sought) {
        return finding;
    }
    let same_angle = same_angle(f, g, domains);
    if same_angle == Some(true) {
        return same_solutions("each equation fixes the angle, and at the same value");
    }
    if same_angle == Some(false) {
        let words = "the two equations fix the angle at different values";
        return told([OTHER[0], words, OTHER[2]]);
    }
    if solved_in(f, g, domains) && solved_in(g, f, domains) {
        let found = same_solutions("each equation, solved, fulfils the other");
        return found.given("what was divided by is not zero");
    }
    // Without roots of sums, as in c = √(a² + b²).
    let plain = [expected, answer].map(|n| unrooted(n, domains));
    if plain.iter().any(Option::is_some) {
        let [p, q] = plain.map(|n| n.map(|n| n.difference));
        let (a, b) = (p.unwrap_or(f.clone()), q.unwrap_or(g.clone()));
        let found =
            locus::compare(&a, &b, domains).and_then(|c| from_parts(ctx, &a, &b, c, sought));
        if let Some(found) = found.filter(Grade::is_equivalent) {
            return found;
        }
    }
    listed::values(expected, answer, domains).unwrap_or_else(|| {
        undecided("the equations could not be solved to compare their solutions")
    })
}

/// Two equations of which one holds nowhere on the domain, or both everywhere.
fn vacuous(ctx: &Context, f: &Expr, g: &Expr, sought: Sought) -> Grade {
    let reals = over_reals(ctx.domains(), &[f, g]);
    let Some(mut compared) = locus::compare(f, g, &reals) else {
        return undecided("neither equation has a solution on the domain");
    };
    // A factor without the sought quantity is nowhere zero by what is known of it, not by what is supposed.
    let names = sought(compared.shared.clone());
    let factor = |e: &Expr| !names.is_empty() && e.symbols().is_disjoint(&names);
    for parts in [&mut compared.lost, &mut compared.gained] {
        parts.retain(|part| {
            let sign = sign_of(&part.expr, ctx.domains());
            !(factor(&part.expr) && sign.is_some_and(Sign::is_strict))
        });
    }
    match compared.extents {
        [Extent::All, Extent::All] => return says_nothing("holds everywhere"),
        [Extent::None, Extent::None] => return says_nothing("has no solution"),
        [Extent::Unknown, _] | [_, Extent::Unknown] => {
            return undecided("no solution of the equations was found, on the domain or beyond it");
        }
        _ => {}
    }
    match from_parts(ctx, f, g, compared, sought) {
        Some(mut finding) => {
            let words = "not both equations have solutions on the domain: ";
            finding.proof.words = format!("{words}{REALS}, {}", finding.proof.words);
            finding.given(REALS)
        }
        None => undecided("neither equation has a solution on the domain"),
    }
}

/// The verdict from the parts that only one of two equations has, where they tell.
fn from_parts(
    ctx: &Context,
    f: &Expr,
    g: &Expr,
    compared: Compared,
    sought: Sought,
) -> Option<Grade> {
    let Compared {
        lost,
        gained,
        shared,
        extents,
    } = compared;
    if lost.is_empty() && gained.is_empty() {
        let mut finding =
            same_solutions("whatever sets the two apart is nowhere zero where it matters");
        if extents.contains(&Extent::Unknown) {
            finding.assumed.push("the equation has a solution".into());
        }
        return Some(finding);
    }
    let sought = sought(shared);
    let free = |part: &Part| part.expr.symbols().is_disjoint(&sought);
    let own = [&lost, &gained].map(|parts| parts.iter().map(|p| &p.expr));
    let equations = are_equations(own, [f, g]);
    if !sought.is_empty() && !equations && lost.iter().chain(&gained).all(free) {
        let factors = lost.iter().chain(&gained);
        let given = factors.map(|part| not_zero(&part.expr)).collect();
        return Some(given_not_zero(APART, given));
    }
    let found = |parts: &[Part]| parts.iter().find(|p| p.at.is_some()).cloned();
    let open = |parts: &[Part]| parts.iter().any(|p| p.at.is_none());
    match (found(&lost), found(&gained)) {
        (Some(at), Some(_)) => {
            let mut finding = parted(ctx, OTHER, &at, false);
            if let Some(term) = turned_term(f, g, ctx.domains()) {
                let message = format!("right with the sign of {} turned", ctx.say(&term));
                finding.note = "DIFF_TERM_SIGN";
                let hint = "one term of your equation has the wrong sign";
                finding.diagnosis = vec![Diagnosis::new("TERM_SIGN", message, hint)];
            }
            Some(finding)
        }
        (Some(at), None) => Some(parted(ctx, LOST, &at, false)),
        (None, Some(at)) => Some(parted(ctx, GAINED, &at, true)),
        (None, None) => {
            debug_assert!(open(&lost) || open(&gained));
            None
        }
    }
}

fn parted(ctx: &Context, words: [&'static str; 3], part: &Part, gained: bool) -> Grade {
    let mut finding = told(words);
    if let Some((at, value)) = &part.at {
        let (zero, other) = (
            "left minus right is 0".to_string(),
            format!("left minus right is {}", ctx.say(value)),
        );
        let (yours, expected) = if gained { (zero, other) } else { (other, zero) };
        finding.counterexample = Some(Apart::new(at, yours, expected));
    }
    finding
}
