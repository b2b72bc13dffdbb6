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
    let uses = roles(&all);
    let (domains, assumed) = ctx.domains().completed(&uses);
    let inside = samples(&uses, &domains, 48);
    let near = inside.iter().take(NEAR);
    let ends = near.flat_map(|sample| on_boundaries(sample, &all, &domains));
    for sample in inside.iter().cloned().chain(ends) {
        // Whether all relations hold: nothing where one is too near to its boundary.
        let point = sample.point::<Interval>(true);
        let truth = |system: &Vec<Normal>| {
            let mut all = true;
            for link in system {
                let sign = match evaluate::<Interval>(&link.difference, &point) {
                    Outcome::Value(v) if v.high < 0.0 => Some(Ordering::Less),
                    Outcome::Value(v) if v.low > 0.0 => Some(Ordering::Greater),
                    Outcome::Undefined => None,
                    _ => Some(
                        link.difference
                            .evaluate(&sample.fractions())?
                            .cmp(&ratio(0, 1)),
                    ),
                };
                all &= holds(link.relation, sign);
            }
            Some(all)
        };
        let any = |cases: &Cases| {
            let truths: Option<Vec<bool>> = cases.iter().map(truth).collect();
            truths.map(|all| all.contains(&true))
        };
        if let (Some(e), Some(a)) = (any(expected), any(answer))
            && e != a
        {
            if equations_alone(expected, answer) {
                let mut finding = told(if e { LOST } else { GAINED });
                finding.counterexample = Some(Apart::new(sample.words(), holding(a), holding(e)));
                finding.assumed = assumed;
                return Some(finding);
            }
            let [note, words, hint] = OTHER_NUMBERS;
            let mut finding = Grade::different(note, "counterexample", words);
            finding.counterexample = Some(Apart::new(sample.words(), holding(a), holding(e)));
            finding.assumed = assumed;
            let message = "the inequality holds elsewhere than it should";
            return Some(finding.with(Diagnosis::new("INEQUALITY", message, hint)));
        }
    }
    None
}
