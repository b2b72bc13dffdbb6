//! Values that one side lists, `x = 2` or `x = 1 ± √2`, held against an equation: each is put in, and they are counted.

use super::super::Grade;
use super::super::context::Context;
use super::solved::{lies_in, solve_for};
use super::told::{LOST, OTHER, told};
use super::zeros::{self, Number, zeros};
use super::{Normal, cells, same_solutions};
use crate::domain::Domains;
use crate::equality::{self, Equality};
use crate::expr::{Expr, Symbol};
use crate::formula::{Content, Relation, write_plain};
use crate::interval::{Big, Enclosure, Outcome, evaluate};

/// The finding on a value that one side lists although it fulfils no equation of the other, which the domain would hide: −4 of
/// `x = ±4` for `√x = 2` with x positive.
pub(super) fn beyond(
    ctx: &Context,
    (sides, expected): (&[Content], &[Normal]),
    (mine, answer): (&[Content], &[Normal]),
) -> Option<Grade> {
    if let Some(value) = missed(ctx, mine, expected) {
        return Some(gained(format!(
            "{value} does not fulfil the expected equation"
        )));
    }
    let value = missed(ctx, sides, answer)?;
    let words = format!("the expected {value} does not fulfil the equation of the answer");
    Some(Grade::told(LOST[0], "solutions", words, LOST[2]))
}

/// A value beyond the domain that the sides of an equation list and that does not fulfil the equations.
fn missed(ctx: &Context, sides: &[Content], equations: &[Normal]) -> Option<String> {
    let [name, Content::Either(values)] = sides else {
        return None;
    };
    let name = name.name()?;
    let domains = ctx.domains();
    let outside =
        |value: &&Expr| number(value, domains).is_some_and(|v| !lies_in(&v, name, domains));
    let value = values.iter().find(outside)?;
    let (mut missed, zero) = (false, Expr::zero());
    for n in equations {
        let left = n.difference.put(name, value);
        missed |= match equality::decide(&left, &zero, domains).equality {
            Equality::Same { .. } => false,
            Equality::Different(_) | Equality::Invalid { .. } => true,
            Equality::Undecided { .. } => return None,
        };
    }
    let equal = equations.iter().all(|n| n.relation == Relation::Equal);
    (missed && equal).then(|| format!("{name} = {}", ctx.say(value)))
}

/// The value of a formula, in symbols at some point of the domain.
fn number(value: &Expr, domains: &Domains) -> Option<Enclosure> {
    let point = domains.points(&[value], 1).into_iter().next()?;
    match evaluate::<Big<200>>(value, &point.point(true)) {
        Outcome::Value(v) => Some(v.0),
        _ => None,
    }
}

fn gained(words: String) -> Grade {
    let hint = "put each of your values into the equation";
    Grade::told("DIFF_ROOT_GAINED", "solutions", words, hint)
}

/// Compares two equations in one symbol of which one lists values, that need not be fractions: they are the solutions of the
/// other where each fulfils it and it has no more of them.
pub(super) fn values(expected: &Normal, answer: &Normal, domains: &Domains) -> Option<Grade> {
    if expected.relation != Relation::Equal {
        return None;
    }
    let (mine, name, list, other) = match listed(answer, domains) {
        Some((name, list)) => (true, name, list, expected),
        None => {
            let (name, list) = listed(expected, domains)?;
            (false, name, list, answer)
        }
    };
    if !other.difference.symbols().iter().eq([&name]) {
        return None;
    }
    let alone = [vec![other.clone()]];
    let count = match cells::compare(&alone, &alone, domains) {
        Some(along) => along.count[0]?,
        None => zeros(&other.difference, &name, domains)?.len(),
    };
    let domain = domains.of_symbol(&name);
    let mut inside: Vec<Enclosure> = Vec::new();
    let mut beside = None;
    for value in list {
        let number: Number = (value.clone(), number(&value, domains)?);
        if !zeros::lies_in(&number, &domain, domains)? {
            continue;
        }
        let place = number.1;
        let left = other.difference.put(&name, &value);
        match equality::decide(&left, &Expr::zero(), domains).equality {
            Equality::Same { .. } if inside.iter().all(|v| v.is_disjoint(&place)) => {
                inside.push(place);
            }
            Equality::Different(_) | Equality::Invalid { .. } => beside = Some(value),
            _ => return None,
        }
    }
    let all = inside.len() == count;
    match (beside, all) {
        (None, true) if count > 0 => Some(same_solutions(
            "each value listed fulfils the equation, which has no other",
        )),
        (Some(value), true) if mine => Some(gained(format!(
            "{name} = {} does not fulfil the expected equation",
            write_plain(&value)
        ))),
        (None, false) if mine && !inside.is_empty() => Some(told(LOST)),
        (None, true) => None,
        _ => {
            let hint = "put each of the values into the equation";
            Some(told([OTHER[0], OTHER[1], hint]))
        }
    }
}

/// The symbol and the values of an equation such as `x = a` or `(x − a)(x − b) = 0`.
fn listed(n: &Normal, domains: &Domains) -> Option<(Symbol, Vec<Expr>)> {
    let name = n.difference.symbols().into_iter().next()?;
    let linear = n
        .difference
        .factors()
        .iter()
        .filter(|part| part.as_number().is_none());
    let values: Option<Vec<Expr>> = linear.map(|part| solve_for(part, &name, domains)).collect();
    let values = values?;
    let constant = values.iter().all(|value| value.symbols().is_empty());
    constant.then_some((name, values))
}
