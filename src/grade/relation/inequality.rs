//! Inequalities: where each holds, part by part.

use super::super::context::Context;
use super::super::scalar::scalars;
use super::super::{Apart, Grade, Verdict};
use super::factor::unrooted;
use super::factor::{Factor, factor};
use super::locus::{self, Extent, by_sign};
use super::solved::lies_inside;
use super::told::holding;
use super::{
    Normal, REALS, apart_at_points, given_not_zero, not_zero, over_reals, same_solutions,
    says_nothing, solve_for, sought_in, undecided, unknowns,
};
use crate::domain::{Domains, Sample};
use crate::equality::{self, poles};
use crate::expr::Expr;
use crate::formula::Relation;
use crate::interval::{Big, Outcome, evaluate};
use num_traits::{Signed, Zero};

/// Two inequalities.
pub(super) fn inequalities(ctx: &Context, expected: &Normal, answer: &Normal) -> Grade {
    let domains = ctx.domains();
    let (f, g) = (&expected.difference, &answer.difference);
    if let Some(finding) = by_extent(ctx, expected, answer) {
        return finding;
    }
    let common = factor(f, g, domains);
    if common.is_none() {
        let [a, b] = [expected, answer].map(|n| unrooted(n, domains).unwrap_or_else(|| n.clone()));
        if factor(&a.difference, &b.difference, domains).is_some() {
            return inequalities(ctx, &a, &b);
        }
    }
    let alike = || same_bound(f, g, domains).then(Factor::positive);
    let by_factor = common
        .or_else(alike)
        .and_then(|common| by_factor(ctx, expected, answer, &common));
    if let Some(finding) = by_factor {
        return finding;
    }
    let [e, a] = [expected, answer].map(std::slice::from_ref);
    let found = apart_at_points(ctx, e, a).or_else(|| other_bound(ctx, f, g));
    found.unwrap_or_else(|| {
        undecided("the inequalities agree at every point tried, and no proof was found")
    })
}

/// Two inequalities of which one holds everywhere or nowhere on the domain, as far as their signs tell.
fn by_extent(ctx: &Context, expected: &Normal, answer: &Normal) -> Option<Grade> {
    let domains = ctx.domains();
    let (f, g) = (&expected.difference, &answer.difference);
    match [expected, answer].map(|n| by_sign(n, domains)) {
        [Extent::All, Extent::All] | [Extent::None, Extent::None] => {
            if let Some(mut found) = beyond_granted(ctx, expected, answer)
                && found.is_equivalent()
            {
                let given = "compared beyond what is granted of the parameters";
                found.assume(vec![given.into()]);
                return Some(found);
            }
            let reals = over_reals(domains, &[f, g]);
            let extents = [expected, answer].map(|n| by_sign(n, &reals));
            match extents {
                [Extent::All, Extent::All] => return Some(says_nothing("holds everywhere")),
                [Extent::None, Extent::None] => return Some(says_nothing("has no solution")),
                _ => {}
            }
            let same = expected.relation == answer.relation
                && factor(f, g, &reals).is_some_and(|q| q.positive && q.weak.is_empty());
            if same && !extents.contains(&Extent::None) && !extents.contains(&Extent::All) {
                let found = same_solutions("the two differ by a factor that is positive");
                return Some(found.given(REALS));
            }
            Some(undecided("on the domain neither inequality says anything"))
        }
        [
            a @ (Extent::All | Extent::None),
            b @ (Extent::All | Extent::None),
        ] if a != b => {
            let words = "one holds everywhere on the domain and the other nowhere";
            Some(Grade::different("DIFF_INEQUALITY", "solutions", words))
        }
        // Where one always or never holds, the other can say the same only if it does so on its boundary too.
        [Extent::All | Extent::None, Extent::Unknown] => {
            Some(at_the_edge(ctx, expected, answer, [answer, expected]))
        }
        [Extent::Unknown, Extent::All | Extent::None] => {
            Some(at_the_edge(ctx, expected, answer, [expected, answer]))
        }
        _ => None,
    }
}

/// Two inequalities without what is granted of the parameters, where something is.
fn beyond_granted(ctx: &Context, expected: &Normal, answer: &Normal) -> Option<Grade> {
    let mut key = ctx.key.clone();
    let granted = std::mem::take(&mut key.question.domains.relations);
    let wider = Context::new(&key, ctx.options, false);
    (!granted.is_empty()).then(|| inequalities(&wider, expected, answer))
}

/// Two inequalities that part on a boundary at most, of which the first of `pair` is open there.
fn at_the_edge(ctx: &Context, expected: &Normal, answer: &Normal, pair: [&Normal; 2]) -> Grade {
    let found = beside_boundary(ctx, pair[0], pair[1]);
    let strict = || {
        let wider = beyond_granted(ctx, expected, answer);
        wider.filter(|wider| wider.note == "DIFF_STRICT")
    };
    match found.verdict {
        Verdict::Undecided => strict().unwrap_or(found),
        _ => found,
    }
}

/// Two inequalities whose differences are the same up to a factor.
fn by_factor(ctx: &Context, expected: &Normal, answer: &Normal, common: &Factor) -> Option<Grade> {
    let domains = ctx.domains();
    let (f, g) = (&expected.difference, &answer.difference);
    let sought = sought_in(ctx, f, g);
    let free = |e: &Expr| e.symbols().is_disjoint(&sought);
    if common.positive && expected.relation == answer.relation {
        if common.weak.is_empty() {
            return Some(same_solutions(
                "the two differ by a factor that is positive",
            ));
        }
        // Where one of the two divides by it, that one has no value there.
        let below = poles(f, g, &domains.of(&[f, g]));
        if (common.weak.iter()).all(|part| free(part) || below.contains(part)) {
            let given = common.weak.iter().map(not_zero).collect();
            let words = "the two differ by a factor that is not negative";
            return Some(given_not_zero(words, given));
        }
    }
    let boundary = || locus::vanishing(f, [&Expr::one(), f], domains);
    if common.positive && expected.relation != answer.relation {
        match boundary() {
            Some((at, _)) => {
                let words =
                    "the boundary belongs to one of the two inequalities and not to the other";
                let hint = "look at the case of equality";
                let word = |n: &Normal| holding(n.relation != Relation::Less);
                let apart = Apart::new(at, word(answer), word(expected));
                let found = Grade::told("DIFF_STRICT", "solutions", words, hint);
                return Some(found.shown_by(apart));
            }
            None => return Some(undecided("the two differ at most on their boundary")),
        }
    }
    if !common.positive && common.weak.is_empty() {
        let words = "the inequality points the other way";
        let hint = "multiplying by something negative turns an inequality round";
        return Some(Grade::told("DIFF_TURNED", "solutions", words, hint));
    }
    None
}

/// A relation that changes on its boundary at most, held against one that always or never holds: different where the boundary
/// is reached, or where a point tells them apart.
fn beside_boundary(ctx: &Context, open: &Normal, sure: &Normal) -> Grade {
    let domains = ctx.domains();
    let pair = [open, sure].map(std::slice::from_ref);
    if let Some(finding) = apart_at_points(ctx, pair[0], pair[1]) {
        return finding;
    }
    let edge = &open.difference;
    match locus::vanishing(edge, [&Expr::one(), edge], domains) {
        Some(_) => {
            let words = "on its boundary one holds where the other does not";
            Grade::different("DIFF_INEQUALITY", "solutions", words)
        }
        None => undecided("the two differ at most on a boundary"),
    }
}

/// Whether two differences grow alike with a symbol, and by a number, and vanish at the same value of it.
fn same_bound(f: &Expr, g: &Expr, domains: &Domains) -> bool {
    unknowns(f, g).iter().any(|name| {
        let slopes = [f, g].map(|d| d.derivative(name));
        let [Some(a), Some(b)] = slopes.each_ref().map(Expr::as_number) else {
            return false;
        };
        if b.is_zero() || !(a / b).is_positive() {
            return false;
        }
        let [mine, theirs] = [f, g].map(|d| d.put(name, &Expr::zero()));
        let scaled = theirs * Expr::from(a / b);
        equality::identical(&mine, &scaled, domains)
    })
}

/// Whether two inequalities set different bounds on the same symbol, one of which lies inside its domain where they differ.
fn other_bound(ctx: &Context, f: &Expr, g: &Expr) -> Option<Grade> {
    let domains = ctx.domains();
    let plain = ctx.plain();
    unknowns(f, g).iter().find_map(|name| {
        let bounds = [solve_for(f, name, domains)?, solve_for(g, name, domains)?];
        let part = |sample: &Sample| {
            let point = sample.point::<Big<200>>(true);
            let values = bounds.each_ref().map(|bound| evaluate(bound, &point));
            let [Outcome::Value(a), Outcome::Value(b)] = values else {
                return false;
            };
            let [a, b] = [a.0, b.0];
            a.is_disjoint(&b) && [a, b].iter().any(|v| lies_inside(v, name, domains))
        };
        let [a, b] = &bounds;
        if !domains.points(&[a, b], 12).iter().any(part) {
            return None;
        }
        let finding = scalars(&plain, a, b);
        (finding.verdict == Verdict::Different).then_some(Grade {
            note: "DIFF_INEQUALITY",
            ..finding
        })
    })
}
