//! What is read of several parts of a text as one: a list of values, a chain of bounds, or relations that are joined.

use super::{Content, Join, Reading, Relation};
use crate::dimension::Unit;
use crate::expr::{Expr, Symbol};

/// Parts that are said together; nothing where they do not belong together. Equations for one name are joined by a word where
/// their sides are formulas, as in `x = y and x = z`, and are a list of its values else.
pub(super) fn together(parts: &[Reading], said: Option<Join>) -> Option<(Content, Option<Unit>)> {
    let contents: Vec<&Content> = parts.iter().map(|part| &part.content).collect();
    let signs: Option<Vec<Vec<Relation>>> = contents.iter().map(|c| signs_of(c)).collect();
    let Some(signs) = signs else {
        return list(&contents);
    };
    let whole = || contents.iter().map(|part| (*part).clone()).collect();
    if signs.concat().iter().all(|sign| *sign == Relation::Equal) {
        let formula = |part: &&Content| part.answer().expr().is_some_and(|e| !e.is_constant());
        // `a = 0 or x = y`
        let both = || Some((Content::Joined(said.unwrap_or(Join::And), whole()), None));
        return match said != Some(Join::Or) && contents.iter().any(formula) {
            true => both(),
            false => list(&contents).or_else(both),
        };
    }
    let content = match contents.as_slice() {
        [a, b] if said != Some(Join::Or) => chain(a, b),
        _ => None,
    };
    // `x < 2, x ≥ 5` are bounds of which one holds.
    let never = said.is_none() && content.as_ref().is_some_and(is_never);
    let content = content.filter(|_| !never);
    let join = said.unwrap_or(if never { Join::Or } else { Join::And });
    Some((
        content.unwrap_or_else(|| Content::Joined(join, whole())),
        None,
    ))
}

/// Whether a chain of bounds says that a larger number is below a smaller one.
fn is_never(chain: &Content) -> bool {
    let Content::Relations(sides, signs) = chain else {
        return false;
    };
    let numbers = [sides.first(), sides.last()].map(|side| side?.expr()?.as_number().cloned());
    match numbers {
        [Some(low), Some(high)] if signs.iter().all(|sign| sign.is_below()) => low > high,
        [Some(high), Some(low)] if signs.iter().all(|sign| sign.turned().is_below()) => low > high,
        _ => false,
    }
}

/// The signs of relations that are said together.
fn signs_of(content: &Content) -> Option<Vec<Relation>> {
    match content {
        Content::Relations(_, signs) => Some(signs.clone()),
        Content::Joined(_, parts) => {
            let all: Vec<_> = parts.iter().map(signs_of).collect::<Option<_>>()?;
            Some(all.concat())
        }
        _ => None,
    }
}

/// `x > 1` and `x < 3` as `1 < x < 3`: nothing where one of them is no single relation, or they bound different things.
fn chain(first: &Content, second: &Content) -> Option<Content> {
    let (Content::Relations(a, s), Content::Relations(b, t)) = (first, second) else {
        return None;
    };
    let ([x, low], [y, high], [s], [t]) = (&a[..], &b[..], &s[..], &t[..]) else {
        return None;
    };
    // `a < x, x < b` begins with the lower bound.
    let (x, low, s) = match x == y {
        true => (x, low, *s),
        false => (low, x, s.turned()),
    };
    let sides = vec![low.clone(), x.clone(), high.clone()];
    (x == y).then(|| Content::Relations(sides, vec![s.turned(), *t]))
}

/// `x = a and x = -a` as the list of the values of x; nothing where it is none.
pub(crate) fn values_of_one(content: &Content) -> Option<Content> {
    let Content::Joined(Join::And, parts) = content else {
        return None;
    };
    Some(list(&parts.iter().collect::<Vec<_>>())?.0)
}

/// Values of one kind, named alike or not at all, with the unit behind the last.
fn list(parts: &[&Content]) -> Option<(Content, Option<Unit>)> {
    let parts: Vec<_> = parts
        .iter()
        .map(|part| named(part))
        .collect::<Option<_>>()?;
    let name = parts[0].0.clone();
    if parts
        .iter()
        .any(|(other, ..)| other.is_some() && *other != name)
    {
        return None;
    }
    let unit = parts.last()?.2.clone();
    let mut values = Vec::new();
    for (_, given, its) in &parts {
        let factor = match (its, &unit) {
            (None, None) => Expr::one(),
            (Some(its), Some(unit)) if its.dimension == unit.dimension => Expr::one(),
            // `2 or 3 m/s`: the unit behind the last number is that of all.
            (None, Some(unit)) if given.iter().all(Expr::is_constant) => unit.value(),
            _ => return None,
        };
        values.extend(given.iter().map(|value| value * &factor));
    }
    let values = Content::Either(values);
    let content = match name {
        None => values,
        Some(name) => {
            let sides = vec![Content::Scalar(Expr::symbol(&name)), values];
            Content::Relations(sides, vec![Relation::Equal])
        }
    };
    Some((content, unit))
}

/// A value, or both of `±2`, in SI units, the name it is given, and its unit.
fn named(content: &Content) -> Option<(Option<Symbol>, Vec<Expr>, Option<Unit>)> {
    let (name, value) = match content {
        Content::Relations(sides, signs) if signs == &[Relation::Equal] => match sides.as_slice() {
            [Content::Scalar(name), value] => (Some(name.as_symbol()?.clone()), value),
            _ => return None,
        },
        value => (None, value),
    };
    match value {
        Content::Scalar(value) => Some((name, vec![value.clone()], None)),
        Content::Either(values) => Some((name, values.clone(), None)),
        Content::Quantity(q) => Some((name, vec![q.value.clone()], Some(q.unit.clone()))),
        _ => None,
    }
}
