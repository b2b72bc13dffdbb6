//! Systems of relations told apart at a point of the domain, on boundaries too, where `<` and `≤` part.

use std::cmp::Ordering;

use super::normal::{Cases, equations_alone, holds};
use super::solved::{solve_for, unknowns};
use super::told::{GAINED, LOST, OTHER_NUMBERS, holding, told};
use super::{Normal, differences};
use crate::domain::{Coordinate, Domains, Sample, roles, samples};
use crate::expr::{Expr, Symbol, ratio};
use crate::grade::context::Context;
use crate::grade::{Apart, Diagnosis, Grade};
use crate::interval::{Interval, Outcome, evaluate};

/// Points of which others are made that lie on boundaries.
const NEAR: usize = 6;

/// The point with one symbol moved to where the two sides of a relation are equal: there `<` and `≤` part.
fn on_boundaries(sample: &Sample, differences: &[&Expr], domains: &Domains) -> Vec<Sample> {
    let moved = |f: &Expr, name: &Symbol| {
        let root = solve_for(f, name, domains)?.evaluate(&sample.fractions())?;
        let domain = domains.symbols.get(name)?;
        let mut moved = sample.clone();
        let number = Coordinate::Number(root.clone());
        let was = moved.coordinates.insert(name.clone(), number)?;
        (matches!(was, Coordinate::Number(_)) && domain.contains(&root)).then_some(moved)
    };
    let mut all = Vec::new();
    for f in differences {
        all.extend(unknowns(f, f).iter().filter_map(|name| moved(f, name)));
    }
    all.into_iter()
        .filter(|moved| domains.admits(moved))
        .collect()
}

/// A point at which one system of relations holds and the other does not.
pub(super) fn apart_at_points(
    ctx: &Context,
    expected: &[Normal],
    answer: &[Normal],
) -> Option<Grade> {
    apart_in_cases(ctx, &[expected.to_vec()], &[answer.to_vec()])
}

/// A point at which one of several systems holds and none of the others does.
pub(super) fn apart_in_cases(ctx: &Context, expected: &Cases, answer: &Cases) -> Option<Grade> {
    let all = differences(expected.iter().flatten(), answer.iter().flatten());
    let (domains, assumed) = ctx.domains().completed(&roles(&all));
    for sample in inside_and_between(&all, &domains) {
        let (Some(e), Some(a)) = (hold_at(expected, &sample), hold_at(answer, &sample)) else {
            continue;
        };
        if e == a {
            continue;
        }
        let apart = Apart::new(sample.words(), holding(a), holding(e));
        let alone = equations_alone(expected, answer);
        let mut finding = if alone {
            told(if e { LOST } else { GAINED })
        } else {
            let [note, words, _] = OTHER_NUMBERS;
            Grade::different(note, "counterexample", words)
        };
        finding.counterexample = Some(apart);
        finding.assumed = assumed;
        if alone {
            return Some(finding);
        }
        let message = "the inequality holds elsewhere than it should";
        return Some(finding.with(Diagnosis::new("INEQUALITY", message, OTHER_NUMBERS[2])));
    }
    None
}

/// Whether points are found at which one of the cases holds and others at which none does: what holds nowhere or everywhere
/// says nothing.
pub(super) fn says_something(cases: &Cases, domains: &Domains) -> bool {
    let all = differences(cases.iter().flatten(), []);
    let (domains, _) = domains.completed(&roles(&all));
    let mut found = [false; 2];
    for holds in inside_and_between(&all, &domains).filter_map(|sample| hold_at(cases, &sample)) {
        found[usize::from(holds)] = true;
        if found == [true; 2] {
            return true;
        }
    }
    false
}

/// Points of the domains, and then others moved to where two sides are equal, which takes more work.
fn inside_and_between<'a>(
    differences: &'a [&'a Expr],
    domains: &'a Domains,
) -> impl Iterator<Item = Sample> + 'a {
    let inside = samples(&roles(differences), domains, 48);
    let near: Vec<Sample> = inside.iter().take(NEAR).cloned().collect();
    let between = near
        .into_iter()
        .flat_map(|sample| on_boundaries(&sample, differences, domains));
    inside.into_iter().chain(between)
}

/// Whether all relations of one of the cases hold at a point: nothing where one is too near to its boundary.
fn hold_at(cases: &Cases, sample: &Sample) -> Option<bool> {
    let point = sample.point::<Interval>(true);
    let truth = |system: &Vec<Normal>| {
        let mut all = true;
        for link in system {
            let sign = match evaluate::<Interval>(&link.difference, &point) {
                Outcome::Value(v) if v.high < 0.0 => Some(Ordering::Less),
                Outcome::Value(v) if v.low > 0.0 => Some(Ordering::Greater),
                Outcome::Undefined => None,
                _ => {
                    let exact = link.difference.evaluate(&sample.fractions())?;
                    Some(exact.cmp(&ratio(0, 1)))
                }
            };
            all &= holds(link.relation, sign);
        }
        Some(all)
    };
    let truths: Option<Vec<bool>> = cases.iter().map(truth).collect();
    truths.map(|all| all.contains(&true))
}
