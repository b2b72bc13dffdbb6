//! Several values, named results and relations in one answer.

use std::collections::BTreeSet;

use super::{kind, values};
use crate::dimension::Unit;
use crate::equality;
use crate::expr::{Expr, Symbol, only};
use crate::formula::{self, UNNAMED};
use crate::formula::{Content, Join, Quantity, Reading, Relation};
use crate::grade::context::Context;
use crate::grade::scalar::scalars;
use crate::grade::{Diagnosis, Grade, Verdict, number, relation, show, unit};

/// The finding where the expected content or the answer joins several relations.
pub(super) fn joined(ctx: &Context, expected: &Content, reading: &Reading) -> Option<Grade> {
    let answer = &reading.content;
    let is_joined = |content: &Content| matches!(content, Content::Joined(..));
    let unnamed = |content: &Content| content.mentions(UNNAMED);
    let relations =
        |content: &Content| matches!(content, Content::Relations(..) | Content::Joined(..));
    if unnamed(expected) != unnamed(answer) {
        if !relations(expected) {
            return Some(kind("a value is expected, and the answer is an interval"));
        }
        if !relations(answer) {
            return Some(kind("an interval is expected, and the answer is a value"));
        }
        let subject = subject(answer, &expected.symbols())?;
        let answer =
            answer.map(&|e| e.substitute(&[(subject.clone(), Expr::symbol(UNNAMED))].into()));
        return Some(relation::joined(ctx, expected, &answer));
    }
    if !is_joined(expected) && !is_joined(answer) {
        return None;
    }
    // `u = v/3, w = 4v/3` where u is asked.
    let asked = ctx.key.question.asked.first();
    let asked = asked.map(|given| given.name.clone());
    if let (None, Some(name), Some(answer)) = (results(expected), asked, results(answer)) {
        if answer.iter().any(|(other, _)| *other == name) {
            return Some(by_name(ctx, &[(name, expected.clone())], &answer));
        }
        if let Content::Scalar(_) | Content::Quantity(_) = expected {
            let words = format!("several results are given, and none of them is called {name}");
            return Some(kind(&words));
        }
    }
    // `(2, 3)`, `F = (2, 3)` and `2, 3` for `x = 2, y = 3`: in their order.
    let given = match (answer, answer.answer()) {
        (Content::Vector(values), _) => Some(values.as_slice()),
        (Content::Either(values), _) => Some(values.as_slice()),
        (Content::Relations(sides, _), Content::Vector(values)) => {
            Some(values.as_slice()).filter(|_| sides[0].expr().is_some())
        }
        _ => None,
    };
    if let (Some(expected), Some(given)) = (results(expected), given) {
        let named = expected.iter().zip(given);
        let answer: Vec<_> = named
            .map(|((name, _), value)| (name.clone(), measured(value, reading.unit.as_ref())))
            .collect();
        let rest = given.iter().skip(expected.len()).all(Expr::is_zero);
        return rest.then(|| by_name(ctx, &expected, &answer));
    }
    if let (Content::Joined(Join::And, parts), Some(given)) = (expected, given) {
        return Some(relation::joined(
            ctx,
            expected,
            &point(ctx, parts.len(), given)?,
        ));
    }
    if let (Content::Scalar(_) | Content::Quantity(_), Content::Joined(Join::And, parts)) =
        (expected, answer)
        && let Some(found) = found_last(ctx, parts)
    {
        return Some(found);
    }
    match (expected, expected.answer()) {
        // `v_x = 3, v_y = 4` for the vector `v`
        (Content::Vector(_), vector) | (_, vector @ Content::Vector(_))
            if results(expected).is_none_or(|r| r.len() == 1) =>
        {
            return unit_missing(ctx, answer)
                .or_else(|| Some(values(ctx, vector, &components(answer)?)));
        }
        // `v_1 = 2, v_2 = 3` for `2, 3`, and for `v = 2 or v = 3`
        (Content::Either(values), _) | (_, Content::Either(values))
            if results(expected).is_none_or(|r| answer_counts(&r, answer)) =>
        {
            let given = results(answer)?;
            let given: Option<Vec<Expr>> = given.iter().map(|(_, v)| v.expr().cloned()).collect();
            return unit_missing(ctx, answer).or_else(|| Some(lists(ctx, values, &given?)));
        }
        _ => {}
    }
    let (whole, mine) = (expected, answer);
    if let (Some(expected), Some(answer)) = (results(whole), results(mine)) {
        let found = by_name(ctx, &expected, &answer);
        if found.verdict != Verdict::Different {
            return Some(found);
        }
        // `a = c, b = c` for `a = b, b = c`
        let system = relation::joined(ctx, whole, mine);
        return Some(if system.is_equivalent() {
            system
        } else {
            found
        });
    }
    match relations(expected) && relations(answer) {
        true => Some(relation::joined(ctx, expected, answer)),
        false => None,
    }
}

/// `(2, 1)` for `x + y = 3, x − y = 1`: numbers for the names of as many relations, in the order of the alphabet.
fn point(ctx: &Context, count: usize, given: &[Expr]) -> Option<Content> {
    let names = ctx.key.reading.content.symbols().into_iter();
    let names: Vec<Symbol> = names.filter(|name| &**name != "pi").collect();
    let (values, rest) = given.split_at_checked(count)?;
    if names.len() != count
        || !values.iter().all(Expr::is_constant)
        || !rest.iter().all(Expr::is_zero)
    {
        return None;
    }
    let part = |(name, value): (&Symbol, &Expr)| {
        let sides = [Expr::symbol(name), value.clone()].map(Content::Scalar);
        Content::Relations(sides.to_vec(), vec![Relation::Equal])
    };
    Some(Content::Joined(
        Join::And,
        names.iter().zip(values).map(part).collect(),
    ))
}

/// `2v_f = v; v_f = v/2` for `v/2`: a name of the answer's own is solved for last, and what stands before agrees with it.
fn found_last(ctx: &Context, parts: &[Content]) -> Option<Grade> {
    let (last, before) = parts.split_last()?;
    let [(name, value)] = &results(last)?[..] else {
        return None;
    };
    let known = |other: &Symbol| ctx.key.question.symbols.iter().any(|g| g.name == *other);
    let whole = &ctx.key.reading.content;
    if known(name) || !before.iter().any(|part| part.mentions(name)) {
        return None;
    }
    let put = [(name.clone(), value.expr()?.clone())].into();
    let contradicts = |part: &Content| match part.map(&|e| e.substitute(&put)) {
        Content::Relations(sides, signs) if signs == [Relation::Equal] => {
            let [left, right] = [sides[0].expr()?, sides[1].expr()?];
            let own = left.symbols().iter().chain(&right.symbols()).all(known);
            let decision = equality::decide(left, right, ctx.domains());
            Some(own && decision.equality.is_different())
        }
        _ => None,
    };
    let agree = before.iter().all(|part| contradicts(part) == Some(false));
    agree.then(|| values(ctx, whole, value))
}

/// Whether the names of an answer are the only expected one with a number each, `x_1` and `x_2` for `x`.
fn answer_counts(expected: &[(Symbol, Content)], answer: &Content) -> bool {
    match expected {
        [(name, _)] => counts(name, answer).is_some(),
        _ => false,
    }
}

/// The names of the results of an answer where these are one name with a number each.
fn counts(name: &Symbol, answer: &Content) -> Option<Vec<Symbol>> {
    let number = |other: &Symbol| {
        let index = other.strip_prefix(&**name)?.trim_start_matches('_');
        Some(!index.is_empty() && index.bytes().all(|b| b.is_ascii_digit()))
    };
    let names = results(answer)?.into_iter().map(|(other, _)| other);
    names
        .map(|other| (number(&other) == Some(true)).then_some(other))
        .collect()
}

/// Numbered results as values of the only symbol of an equation.
pub(super) fn counted(expected: &Content, answer: &Content) -> Option<Content> {
    let (Content::Relations(..), Content::Joined(..)) = (expected, answer) else {
        return None;
    };
    let symbols = expected.symbols().into_iter();
    let name = only(symbols.filter(|s| &**s != "pi"))?;
    let same = counts(&name, answer)?.into_iter();
    let same = same.map(|other| (other, Expr::symbol(&name))).collect();
    formula::values_of_one(&answer.map(&|e| e.substitute(&same)))
}

/// A value in SI units, as a quantity where a unit stands behind it or a list with it.
fn measured(value: &Expr, unit: Option<&Unit>) -> Content {
    match unit {
        Some(unit) if value.is_constant() => {
            let written = value / &unit.value();
            let quantity = Quantity::of(written, unit.clone(), &unit.dimension.si());
            Content::Quantity(Box::new(quantity))
        }
        _ => Content::Scalar(value.clone()),
    }
}

/// The finding where a number stands without the unit of the expected values.
fn unit_missing(ctx: &Context, answer: &Content) -> Option<Grade> {
    let unit = ctx.key.reading.unit.as_ref()?;
    let bare = |value: &Content| match value {
        Content::Scalar(e) => e.is_constant() && !e.is_zero(),
        _ => false,
    };
    let bare = results(answer)?.iter().any(|(_, value)| bare(value));
    (bare && !unit.dimension.is_none()).then(|| unit::missing(unit))
}

/// Bounds of something without a name, said of the symbol that the expected bounds are about.
pub(in crate::grade) fn named(expected: &Content, answer: &Content) -> Option<Content> {
    if expected.mentions(UNNAMED) || !answer.mentions(UNNAMED) {
        return None;
    }
    let Some(subject) = subject(expected, &answer.symbols()) else {
        return points(expected, answer);
    };
    let subject = Expr::symbol(&subject);
    Some(answer.map(&|e| e.substitute(&[(UNNAMED.into(), subject.clone())].into())))
}

/// `(1, 2) or (2, 1)` where two quantities are asked for: points, not intervals.
fn points(expected: &Content, answer: &Content) -> Option<Content> {
    let unknowns: Vec<Symbol> = expected.symbols().into_iter().collect();
    let [x, y] = unknowns.as_slice() else {
        return None;
    };
    let Content::Joined(Join::Or, cases) = answer else {
        return None;
    };
    let point = |case: &Content| match case {
        Content::Relations(sides, signs) if *signs == [Relation::Less; 2] => {
            let is = |name: &Symbol, value: &Content| {
                let sides = vec![Content::Scalar(Expr::symbol(name)), value.clone()];
                Content::Relations(sides, vec![Relation::Equal])
            };
            let both = vec![is(x, sides.first()?), is(y, sides.last()?)];
            Some(Content::Joined(Join::And, both))
        }
        _ => None,
    };
    let cases: Option<Vec<Content>> = cases.iter().map(point).collect();
    Some(Content::Joined(Join::Or, cases?))
}

/// The symbol that stands alone on a side of every relation, and is no bound; the only one of its own.
fn subject(content: &Content, bounds: &BTreeSet<Symbol>) -> Option<Symbol> {
    let parts = match content {
        Content::Joined(_, parts) => parts.as_slice(),
        part => std::slice::from_ref(part),
    };
    let mut own = content.symbols();
    own.retain(|name| !bounds.contains(name));
    let alone = |name: &Symbol, part: &Content| match part {
        Content::Relations(sides, _) => {
            let mut names = sides.iter().filter_map(|side| side.name());
            names.any(|other| other == name)
        }
        _ => false,
    };
    let everywhere = own
        .iter()
        .find(|name| parts.iter().all(|part| alone(name, part)));
    let only = own.iter().next().filter(|_| own.len() == 1);
    everywhere.or(only).cloned()
}

/// `v_x = 3, v_y = 4`, `v_{Bx} = 3, v_{By} = 4` or `x = 3, y = 4` as a vector.
fn components(content: &Content) -> Option<Content> {
    let results = results(content)?;
    let (of_which, _) = formula::along_axis(&results.first()?.0)?;
    let along = |axis: usize| {
        let of = |name: &Symbol| {
            formula::along_axis(name).is_some_and(|n| n == (of_which.clone(), axis))
        };
        let mut all = results.iter();
        all.find_map(|(name, value)| of(name).then_some(value))
    };
    let axes = [0, 1, 2].map(along);
    let zero = Expr::zero();
    let unit_less =
        |value: Option<&Content>| value.map_or(Some(zero.clone()), |v| v.expr().cloned());
    let [x, y, z] = axes.map(unit_less);
    let known = axes.iter().flatten().count() == results.len();
    known.then_some(Content::Vector([x?, y?, z?]))
}

/// Results with their names: `v_1 = 2 m/s, v_2 = 3 m/s`, `(x, y) = (2, 3)`.
fn results(content: &Content) -> Option<Vec<(Symbol, Content)>> {
    let parts = match content {
        Content::Joined(Join::And, parts) => parts.as_slice(),
        part => std::slice::from_ref(part),
    };
    let mut out = Vec::new();
    for part in parts {
        let (sides, signs) = part.relations()?;
        if signs.iter().any(|sign| *sign != Relation::Equal) {
            return None;
        }
        match (sides.first()?, sides.last()?) {
            (Content::Vector(names), Content::Vector(values)) => {
                for (name, value) in names.iter().zip(values) {
                    match name.as_symbol() {
                        Some(name) => out.push((name.clone(), Content::Scalar(value.clone()))),
                        None if name.is_zero() && value.is_zero() => {}
                        None => return None,
                    }
                }
            }
            (name, value) => out.push((name.name()?.clone(), value.clone())),
        }
    }
    Some(out)
}

/// Results compared by their names, in any order. One that is not asked for is not judged.
fn by_name(ctx: &Context, expected: &[(Symbol, Content)], answer: &[(Symbol, Content)]) -> Grade {
    let mut total: Option<Grade> = None;
    for (name, value) in expected {
        let mut given = answer.iter().filter(|(other, _)| other == name);
        let Some((_, mine)) = given.next() else {
            let words = format!("{name} is missing");
            let hint = "more results are asked for";
            return Grade::told("DIFF_ONE_OF_TWO", "kind", words, hint);
        };
        let mut finding = values(ctx, value, mine);
        if finding.verdict == Verdict::Different {
            let words = format!("{name} is wrong");
            let found = Diagnosis::new("RESULT", words.clone(), words);
            finding.diagnosis.insert(0, found);
            return finding;
        }
        // Who gives two values leaves the choice to the reader; a number for a formula is no other value of it.
        let constant = |value: &Content| value.exprs().iter().all(|e| e.is_constant());
        let alike = given.filter(|(_, other)| constant(other) == constant(mine));
        let mut others = alike.map(|(_, other)| values(&ctx.plain(), value, other));
        if others.any(|found| found.verdict == Verdict::Different) {
            let words =
                format!("two values of {name} are given, and one of them is not the expected one");
            let hint = "decide for one value";
            return Grade::told("DIFF_TWO_FOR_ONE", "kind", words, hint);
        }
        match &mut total {
            Some(total) if finding.is_equivalent() => total.assume(finding.assumed),
            _ => total = Some(finding),
        }
    }
    let mut total = total.unwrap_or_else(|| Grade::different("DIFF_KIND", "kind", "no result"));
    for (name, value) in answer {
        if !expected.iter().any(|(other, _)| other == name) {
            total.assumed.push(format!(
                "{name} = {} is not asked for and not judged",
                show(value)
            ));
        }
    }
    total
}

/// Values without those that are an earlier one once more; within a tolerance alone these are to be told from near ones.
pub(super) fn distinct<'e>(ctx: &Context, values: &'e [Expr]) -> Vec<&'e Expr> {
    let mut own: Vec<&Expr> = Vec::new();
    for value in values {
        let again = |other: &&Expr| equality::identical(other, value, ctx.domains());
        if ctx.options.tolerance.is_none() || !own.iter().any(again) {
            own.push(value);
        }
    }
    own
}

/// Leaves each expected value at most one of the answers that fit it, and each answer at most one value, so that as many values
/// as can be have one: two values near each other are not both given by a number near both.
fn one_to_one(fitting: &mut [Vec<(usize, Grade)>], answers: usize) {
    fn place(i: usize, fits: &[Vec<usize>], of: &mut [Option<usize>], tried: &mut [bool]) -> bool {
        fits[i].iter().any(|k| {
            let new = !std::mem::replace(&mut tried[*k], true);
            let free = new && of[*k].is_none_or(|other| place(other, fits, of, tried));
            if free {
                of[*k] = Some(i);
            }
            free
        })
    }
    let fits = fitting
        .iter()
        .map(|here| here.iter().map(|(k, _)| *k).collect());
    let fits: Vec<Vec<usize>> = fits.collect();
    let mut of = vec![None; answers];
    for i in 0..fits.len() {
        place(i, &fits, &mut of, &mut vec![false; answers]);
    }
    for (i, here) in fitting.iter_mut().enumerate() {
        here.retain(|(k, _)| of[*k] == Some(i));
    }
}

/// Values in any order, of which each has to be given.
pub(super) fn lists(ctx: &Context, expected: &[Expr], answer: &[Expr]) -> Grade {
    let plain = ctx.plain();
    let [expected, answer] = [distinct(ctx, expected), distinct(ctx, answer)];
    let mut fitting: Vec<Vec<(usize, Grade)>> = vec![Vec::new(); expected.len()];
    let mut undecided = None;
    for (value, here) in expected.iter().zip(&mut fitting) {
        for (k, mine) in answer.iter().enumerate() {
            let finding = scalars(&plain, value, mine);
            match finding.verdict {
                Verdict::Equivalent => here.push((k, finding)),
                Verdict::Different => {}
                _ => undecided = Some(finding),
            }
        }
    }
    if ctx.options.tolerance.is_some() {
        one_to_one(&mut fitting, answer.len());
    }
    let is_each = fitting.iter().all(|here| !here.is_empty());
    if !is_each
        && undecided.is_none()
        && let Some(same) = same_pair(&plain, &expected, &answer)
    {
        return same;
    }
    let mut found = vec![false; answer.len()];
    let (mut total, mut lost) = (None::<Grade>, Vec::new());
    for (value, mut here) in expected.iter().zip(fitting) {
        here.iter().for_each(|(k, _)| found[*k] = true);
        match (here.pop(), &mut total) {
            (None, _) => lost.push(*value),
            (Some((_, finding)), None) => total = Some(finding),
            (Some((_, finding)), Some(total)) => total.assume(finding.assumed),
        }
    }
    let gained = answer.iter().zip(&found).filter(|(_, found)| !**found);
    let gained: Vec<&Expr> = gained.map(|(value, _)| *value).collect();
    if let Some(total) = total.as_mut() {
        total.assumed.sort();
    }
    match (lost.as_slice(), gained.as_slice(), undecided, total) {
        ([], [], _, Some(total)) => total,
        (_, _, Some(undecided), _) => undecided,
        ([lost, ..], [], ..) => {
            let words = match expected.len() {
                2 => "one of the two values is missing".to_string(),
                _ => format!("the value {} is missing", ctx.say(lost)),
            };
            Grade::told("DIFF_ONE_OF_TWO", "kind", words, "there are more values")
        }
        ([], [_, ..], ..) if answer.len() > expected.len() && ctx.options.tolerance.is_some() => {
            let words = format!(
                "{} values are expected, and {} given",
                expected.len(),
                answer.len()
            );
            Grade::told(
                "DIFF_ROOT_GAINED",
                "kind",
                words,
                "check each of your values",
            )
        }
        (lost, gained, ..) => rounded(ctx, lost, gained).unwrap_or_else(|| match (lost, gained) {
            // What is wrong with the only value that is.
            ([lost], [beside]) => scalars(&plain, lost, beside),
            _ => {
                let beside = gained.first().unwrap_or(&answer[0]);
                let said = match beside.as_number() {
                    Some(_) => number::shown(beside),
                    None => ctx.say(beside),
                };
                let words = format!("{said} is none of the values");
                let hint = "check each of your values";
                Grade::told("DIFF_ROOT_GAINED", "kind", words, hint)
            }
        }),
    }
}

/// The finding that two values are two others in one order here and in the other there, as `±|x|` is `±x`: they have the same
/// sum and the same product.
fn same_pair(ctx: &Context, expected: &[&Expr], answer: &[&Expr]) -> Option<Grade> {
    let ([a, b], [c, d], None) = (expected, answer, &ctx.options.tolerance) else {
        return None;
    };
    let sum = scalars(ctx, &(*a + *b), &(*c + *d));
    let product = scalars(ctx, &(*a * *b), &(*c * *d));
    (sum.is_equivalent() && product.is_equivalent()).then(|| {
        let mut found = product;
        found.assume(sum.assumed);
        found
    })
}

/// The finding that values are those that are expected with fewer digits, each of them one.
fn rounded(ctx: &Context, expected: &[&Expr], answer: &[&Expr]) -> Option<Grade> {
    let mut left = expected.to_vec();
    let mut found = None;
    for mine in answer {
        let each = left.iter().map(|value| scalars(ctx, value, mine));
        let (at, grade) = each
            .enumerate()
            .find(|(_, grade)| grade.note == "DIFF_ROUNDED")?;
        left.remove(at);
        found.get_or_insert(grade);
    }
    found.filter(|_| left.is_empty())
}
