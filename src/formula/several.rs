//! Several values or bounds that are said as one: alternatives, lists and sets of two, intervals.

use super::{
    Content, Fault, MAX_BYTES, Reading, Relation, Remark, Symbols, boxed, prose, read_either,
    read_inner,
};
use crate::dimension::Unit;
use crate::expr::{Expr, Symbol};

/// `x ∈ [2, 3)` and `x in (0, ∞)` as the relations they stand for.
pub(super) fn interval(text: &str, symbols: &Symbols) -> Option<Reading> {
    let (start, stop) = boxed(text).ok()?;
    let part = |[from, to]: [usize; 2]| read_inner(&text[..to], from, symbols, false, 0).ok();
    let ends = prose::interval(&text[start..stop])?.map_bytes(start);
    let name = part(ends.name)?;
    let mut sides = vec![name.content.clone()];
    let mut signs = Vec::new();
    let strict = |open: bool| match open {
        true => Relation::Less,
        false => Relation::LessEqual,
    };
    if let Some(low) = ends.low {
        sides.insert(0, part(low)?.content);
        signs.push(strict(ends.open[0]));
    }
    if let Some(high) = ends.high {
        sides.push(part(high)?.content);
        signs.push(strict(ends.open[1]));
    }
    let plain = |side: &Content| matches!(side, Content::Scalar(_));
    (!signs.is_empty() && sides.iter().all(plain)).then_some(Reading {
        content: Content::Relations(sides, signs),
        ..name
    })
}

/// `x = 3 or x = -3` and `2, -2` as one pair of values, `x > 1 and x < 3` as a chain.
pub(super) fn values(text: &str, symbols: &Symbols) -> Option<Result<Reading, Fault>> {
    if text.len() > MAX_BYTES {
        return None;
    }
    let (start, stop) = boxed(text).ok()?;
    let set = prose::without_braces(&text[start..stop]);
    let set = set.map(|set| format!("{}{set}", " ".repeat(start)));
    let list = set.is_some();
    let (text, stop) = set.as_ref().map_or((text, stop), |set| (set, set.len()));
    let (end, next) = prose::alternatives(&text[start..stop], list)?;
    if symbols.find("or").is_some() || symbols.find("and").is_some() {
        return None;
    }
    let part = |from: usize, to: usize| {
        let strict = read_either(&text[..to], from, symbols, 0);
        let worded = |r: &Reading| r.notes.iter().any(|n| n.remark == Remark::Letters);
        strict.ok().filter(|r| !worded(r))
    };
    let (first, second) = (part(start, start + end)?, part(start + next, stop)?);
    let word = &text[start + end..start + next];
    let is_or = word.contains("or");
    if let (Content::Relations(a, s), Content::Relations(b, t)) = (&first.content, &second.content)
        && s.iter().chain(t).any(|sign| *sign != Relation::Equal)
    {
        let Some(content) = chain((a, s), (b, t), is_or)? else {
            let what = "two relations joined by a word are not read";
            let fault = Fault::new(what, start + end, start + next);
            return Some(Err(*fault.hint("write them as one, as in 1 < x < 3")));
        };
        return Some(Ok(Reading { content, ..second }));
    }
    let (content, unit) = pair(&first.content, &second.content)?;
    Some(Ok(Reading {
        content,
        written: first.written.into_iter().chain(second.written).collect(),
        literal: None,
        unit,
        notes: first.notes.into_iter().chain(second.notes).collect(),
        choices: 0,
        slashes: false,
    }))
}

/// `x > 1` and `x < 3` as `1 < x < 3`: nothing where one of them is no single relation, and no content where they bound
/// different things or one of them is enough.
fn chain(
    (a, s): (&[Content], &[Relation]),
    (b, t): (&[Content], &[Relation]),
    is_or: bool,
) -> Option<Option<Content>> {
    let ([x, low], [y, high], [s], [t]) = (a, b, s, t) else {
        return None;
    };
    // `a < x, x < b` begins with the lower bound.
    let (x, low, s) = match x == y {
        true => (x, low, *s),
        false => (low, x, s.turned()),
    };
    let sides = vec![low.clone(), x.clone(), high.clone()];
    let chain = Content::Relations(sides, vec![s.turned(), *t]);
    Some((x == y && !is_or).then_some(chain))
}

/// Two values of one kind, named alike or not at all, with the unit behind the last.
fn pair(first: &Content, second: &Content) -> Option<(Content, Option<Unit>)> {
    let ((name, a, its), (other, b, unit)) = (named(first)?, named(second)?);
    if other.is_some() && other != name {
        return None;
    }
    let a = match (its, &unit) {
        (None, None) => a,
        (Some(its), Some(unit)) if its.dimension == unit.dimension => a,
        // `2 or 3 m/s`: the unit behind the last number is that of both.
        (None, Some(unit)) if a.is_constant() => &a * &unit.value(),
        _ => return None,
    };
    let pair = Content::Either([a, b]);
    let content = match name {
        None => pair,
        Some(name) => {
            let sides = vec![Content::Scalar(Expr::symbol(&name)), pair];
            Content::Relations(sides, vec![Relation::Equal])
        }
    };
    Some((content, unit))
}

/// A value in SI units, the name it is given, and its unit.
fn named(content: &Content) -> Option<(Option<Symbol>, Expr, Option<Unit>)> {
    let (name, value) = match content {
        Content::Relations(sides, signs) if signs == &[Relation::Equal] => match sides.as_slice() {
            [Content::Scalar(name), value] => (Some(name.as_symbol()?.clone()), value),
            _ => return None,
        },
        value => (None, value),
    };
    match value {
        Content::Scalar(value) => Some((name, value.clone(), None)),
        Content::Quantity(q) => Some((name, q.value.clone(), Some(q.unit.clone()))),
        _ => None,
    }
}
