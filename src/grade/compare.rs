//! One content against another: values, vectors, pairs, quantities with units; relations go to [`super::relation`].

mod links;
mod named;
pub(super) mod several;

use std::collections::{BTreeMap, BTreeSet};

use super::context::Context;
use super::scalar::scalars;
use super::{
    Diagnosis, Grade, Key, Options, Strength, Tolerance, Verdict, number, partial, relation, show,
    unit,
};
use crate::algebra;
use crate::dimension::Dimension;
use crate::equality::{self};
use crate::expr::{Expr, Symbol};
use crate::formula::{self, Content, Reading, Relation};
use links::{broken_within, differ, lists_apart};
pub(super) use named::other_name;
use named::{is_size, named_values, of_two_names, only_unknown, solved};

/// Compares a reading with the key.
pub(crate) fn contents(key: &Key, answer: &Reading, options: &Options) -> Grade {
    let diagnose = options.strength == Strength::Identity;
    let beside = key.beside(&answer.content);
    let key = beside.as_ref().unwrap_or(key);
    let ctx = Context::new(key, options, diagnose);
    let found = tolerated(&ctx, answer);
    if found.is_equivalent()
        && let Some([one, two]) = broken_within(&ctx, &answer.content)
    {
        return chain_apart(&ctx, [&one, &two]);
    }
    if found.verdict == Verdict::Different
        && let Some(([expected, mine], sizes)) =
            of_length_one([&key.reading.content, &answer.content])
    {
        let mut key = key.with(expected);
        let domains = std::mem::take(&mut key.question.domains);
        key.question.domains = (sizes.iter()).fold(domains, |d, size| d.given(size, false));
        let same = tolerated(&Context::new(&key, options, false), &answer.with(mine));
        if same.is_equivalent() {
            return same;
        }
    }
    found
}

/// Contents with the components of each `\hat n` as those of some vector over its size, and the squares of these; nothing where
/// none is written.
fn of_length_one(contents: [&Content; 2]) -> Option<([Content; 2], Vec<Expr>)> {
    let names = contents.map(Content::symbols);
    let mut units: Vec<&str> = (names.iter().flatten())
        .filter_map(|name| formula::unit_of(name))
        .collect();
    units.dedup();
    if units.is_empty() {
        return None;
    }
    let (mut parts, mut squares) = (BTreeMap::new(), Vec::new());
    for unit in units {
        let names = ["x", "y", "z"].map(|axis| Symbol::from(format!("{unit}_{axis}")));
        let components = names.each_ref().map(|name| Expr::symbol(name));
        let size = size(&components);
        squares.push(size.powi(2));
        parts.extend(names.into_iter().zip(components.map(|c| c / &size)));
    }
    let put = contents.map(|content| content.map(&|e: &Expr| e.substitute(&parts)));
    Some((put, squares))
}

/// A value before its name, `5 m = x`, with the name first; formulas on both sides are an equation to be solved.
pub(super) fn turned(content: &Content) -> Option<Content> {
    let (sides, signs) = content.relations()?;
    let (last, values) = sides.split_last()?;
    let name = last.name().filter(|name| &***name != "pi")?;
    let is_value = |side: &Content| match side {
        Content::Scalar(e) => e.is_constant(),
        Content::Quantity(_) => true,
        Content::Vector(_) | Content::Matrix(_) | Content::Either(_) => !side.mentions(name),
        _ => false,
    };
    let equal = |sign: &Relation| matches!(sign, Relation::Equal | Relation::Approximately);
    if !values.iter().all(is_value) || !signs.iter().all(equal) {
        return None;
    }
    let sides = std::iter::once(last).chain(values).cloned().collect();
    let signs = std::iter::once(&signs[signs.len() - 1]).chain(&signs[..signs.len() - 1]);
    Some(Content::Relations(sides, signs.cloned().collect()))
}

/// The verdict alone, without looking for what is wrong.
pub(crate) fn verdict_of(key: &Key, answer: &Reading, options: &Options) -> Verdict {
    let beside = key.beside(&answer.content);
    let key = beside.as_ref().unwrap_or(key);
    tolerated(&Context::new(key, options, false), answer).verdict
}

/// Compares with every number of the answer that the tolerance allows in the place of the expected one.
fn tolerated(ctx: &Context, answer: &Reading) -> Grade {
    let found = compare(ctx, answer);
    let (expected, domains) = (&ctx.key.reading.content, ctx.domains());
    let changed = |content: &Content| *content != answer.content;
    let in_place = |tolerance| number::aligned(expected, &answer.content, tolerance);
    let near = |tolerance| {
        let near = |a: &Expr, e: &Expr| number::within(a, e, tolerance) == Some(true);
        relation::at_zeros(expected, &answer.content, &near, domains)
    };
    let bounded = |tolerance| {
        let near = |a: &Expr, e: &Expr| number::within(a, e, tolerance) == Some(true);
        relation::at_bounds(expected, &answer.content, &near)
    };
    if let (Verdict::Different, Some(tolerance)) = (found.verdict, &ctx.options.tolerance)
        && let Some(content) = in_place(tolerance)
            .filter(changed)
            .or_else(|| near(tolerance).filter(changed))
            .or_else(|| bounded(tolerance).filter(changed))
    {
        let near = answer.with(content);
        let exact = compare(&ctx.plain(), &near);
        if exact.is_equivalent() {
            let (note, words) = ("EQUIV_TOLERANCE", tolerance.words());
            let mut finding = Grade::new(Verdict::Equivalent, note, "tolerance", words);
            // Numbers near those of a difference say nothing of its value.
            if let [Some(e), Some(a), Some(near)] =
                [&ctx.key.reading, answer, &near].map(Reading::expr)
                && !(super::scalar::has_one_sign(ctx, near)
                    || super::scalar::is_near(ctx, e, a, tolerance))
            {
                let words = "the numbers in it are near enough, and it is not shown that the value always is";
                finding = Grade::new(Verdict::Undecided, "UNDECIDED_TOLERANCE", "none", words);
            }
            finding.assume(exact.assumed);
            return finding;
        }
    }
    found
}

/// A value, possibly with the name it is given to; or relations.
enum Claim<'a> {
    Value(Option<&'a Symbol>, &'a Content),
    Relations(&'a [Content], &'a [Relation]),
}

fn claim(content: &Content) -> Claim<'_> {
    match content {
        Content::Relations(sides, signs) => {
            let name = sides.first().and_then(Content::name);
            let name = name.filter(|name| &***name != "pi");
            let value = content.answer();
            let free = |name: &Symbol| !sides[1..].iter().any(|side| side.mentions(name));
            match name {
                Some(name) if !std::ptr::eq(value, content) && free(name) => {
                    Claim::Value(Some(name), value)
                }
                // `(v_x, v_y) = (3, 4)`
                None if sides[0].expr().is_none() && !std::ptr::eq(value, content) => {
                    Claim::Value(None, value)
                }
                _ => Claim::Relations(sides, signs),
            }
        }
        other => Claim::Value(None, other),
    }
}

/// The names that stand alone left of an equality sign in relations that are joined.
fn solved_for(content: &Content) -> BTreeSet<Symbol> {
    match content {
        Content::Relations(sides, signs) if signs[..] == [Relation::Equal] => {
            sides[0].name().cloned().into_iter().collect()
        }
        Content::Joined(_, parts) => parts.iter().flat_map(solved_for).collect(),
        _ => BTreeSet::new(),
    }
}

/// Whether several equations are meant together: a chain, results for several names, or one that is solved for none, as in
/// `T − m g = m a, T = M (g − a)`.
fn is_system(content: &Content) -> bool {
    let is_unsolved = match content {
        Content::Relations(sides, _) => sides.len() > 2,
        Content::Joined(_, parts) => parts.iter().any(|part| solved_for(part).is_empty()),
        _ => false,
    };
    is_unsolved || solved_for(content).len() > 1
}

/// Whether all values of a list may be one and the same, as those of `F = 3 and F = m a`: they are in different symbols, and no
/// two of them are apart everywhere, as 0 and a are.
fn may_all_hold(ctx: &Context, list: &Content) -> bool {
    let Content::Either(values) = list.answer() else {
        return false;
    };
    let domains = ctx.domains();
    let apart = |(a, b): (&Expr, &Expr)| {
        relation::sign_of(&(a - b), domains).is_some_and(algebra::Sign::is_strict)
    };
    let mut pairs = values.iter().enumerate();
    let mut others = values.iter().skip(1);
    others.any(|e| e.symbols() != values[0].symbols())
        && !pairs.any(|(i, a)| values[..i].iter().any(|b| apart((a, b))))
}

/// The finding where values of one name are a list of which each will do: unless the other side says that they are all the same,
/// or speaks of several, as `y = x² and y = x` does beside `x = 1 and y = 1`. Solutions of a single equation are such a list in
/// any case.
fn lists(ctx: &Context, answer: &Reading) -> Option<Grade> {
    let expected = &ctx.key.reading.content;
    let several = match expected {
        Content::Relations(..) => matches!(expected.answer(), Content::Either(_)),
        other => matches!(other, Content::Joined(..)),
    };
    if !is_system(expected)
        && let Some(list) = formula::values_of_one(&answer.content)
        && !(several && may_all_hold(ctx, &list))
    {
        return Some(compare(ctx, &answer.with(list)));
    }
    if !is_system(&answer.content)
        && let Some(list) = formula::values_of_one(expected)
        && !may_all_hold(ctx, &list)
    {
        let key = ctx.key.with(list);
        let with = Context::new(&key, ctx.options, ctx.diagnose);
        return Some(compare(&with, answer));
    }
    // `x_1 = 2, x_2 = 3` for `x² − 5x + 6 = 0`
    let list = several::counted(expected, &answer.content)?;
    Some(compare(ctx, &answer.with(list)))
}

fn compare(ctx: &Context, answer: &Reading) -> Grade {
    if let Some(found) = lists(ctx, answer) {
        return found;
    }
    // `a = b = c` is a system, in whatever order, where b and c are not the same of themselves.
    if let (Content::Relations(a, s), Content::Relations(b, t)) =
        (&ctx.key.reading.content, &answer.content)
        && a.len() > 2
        && b.len() > 2
        && apart(ctx, a, s).is_some()
    {
        return relation::compare(ctx, (a, s), (b, t));
    }
    if let Some(found) = several::joined(ctx, &ctx.key.reading.content, answer) {
        return found;
    }
    // An equation between vectors, solved for another of them.
    if let (Content::Relations(a, s), Content::Relations(b, t)) =
        (&ctx.key.reading.content, &answer.content)
        && a.first() != b.first()
        && a.iter()
            .chain(b)
            .any(|side| matches!(side, Content::Vector(_)))
    {
        return relation::compare(ctx, (&spread(a), s), (&spread(b), t));
    }
    match (claim(&ctx.key.reading.content), claim(&answer.content)) {
        (Claim::Value(mine, expected), Claim::Value(theirs, value)) => {
            named_values(ctx, answer, (mine, expected), (theirs, value))
        }
        (Claim::Relations(sides, signs), Claim::Relations(mine, my_signs)) => {
            let finding = relation::compare(ctx, (sides, signs), (mine, my_signs));
            let same = answer.content == ctx.key.reading.content;
            match finding.verdict {
                // What cannot be solved still says the same as itself.
                Verdict::Equivalent | Verdict::Invalid => finding,
                _ if same => {
                    let words = "the same relation";
                    Grade::new(Verdict::Equivalent, "EQUIV_SOLUTIONS", "identity", words)
                }
                _ => finding,
            }
        }
        (Claim::Relations(sides, signs), Claim::Value(Some(_), _)) => match &answer.content {
            Content::Relations(mine, my_signs) => {
                relation::compare(ctx, (sides, signs), (mine, my_signs))
            }
            _ => kind("an equation is expected"),
        },
        (Claim::Relations([left, right], [Relation::Equal]), Claim::Value(None, value))
            if left.expr().is_some_and(|e| {
                let (theirs, mine) = (right.symbols(), value.symbols());
                let free = |name: &Symbol| !theirs.contains(name) && !mine.contains(name);
                of_two_names(e, &free, right.expr())
                    || is_size(e, &free) && !matches!(value, Content::Either(_))
            }) =>
        {
            values(ctx, right, value)
        }
        (Claim::Relations(sides, signs), Claim::Value(None, value)) => {
            // `2, -2` for `x^2 = 4`
            if let Some(named) = only_unknown(&ctx.key.reading.content, value) {
                return relation::compare(ctx, (sides, signs), (&named, &[Relation::Equal]));
            }
            // `2` for `|x - 2| ≤ 0`, which holds there alone.
            if let Some(named) = named::unknown(&ctx.key.reading.content, value) {
                let found =
                    relation::compare(&ctx.plain(), (sides, signs), (&named, &[Relation::Equal]));
                if found.is_equivalent() {
                    return found;
                }
            }
            match sides.first().and_then(Content::expr) {
                // `v ≤ X`: the bare right side of an inequality does not say which way.
                Some(_) if signs.iter().any(|s| *s != Relation::Equal) => kind(&format!(
                    "an inequality is expected, and {} alone does not say which way",
                    show(value)
                )),
                _ => kind("an equation is expected, not a value"),
            }
        }
        (Claim::Value(name, expected), Claim::Relations(mine, my_signs)) => {
            solved(ctx, (name, expected), (mine, my_signs))
        }
    }
}

/// The sides of an equation between vectors, names with an arrow and sums of them in their components.
fn spread(sides: &[Content]) -> Vec<Content> {
    let vectors = sides.iter().any(|side| matches!(side, Content::Vector(_)));
    let components = |side: &Content| {
        let e = side.expr().filter(|_| vectors)?;
        let mut names = e.symbols();
        names.retain(|name| formula::has_components(name) && !formula::is_component(name));
        let part =
            |name: &Symbol, axis: &str| (name.clone(), Expr::symbol(&format!("{name}_{axis}")));
        let along = |axis: &str| e.substitute(&names.iter().map(|n| part(n, axis)).collect());
        (!names.is_empty()).then(|| Content::Vector(["x", "y", "z"].map(along)))
    };
    let spread = |side: &Content| components(side).unwrap_or_else(|| side.clone());
    sides.iter().map(spread).collect()
}

pub(super) fn kind(words: &str) -> Grade {
    Grade::told("DIFF_KIND", "kind", words, words)
}

/// In `ω = a = b` all sides after the name should be equal; the last one decides, and is not right where what leads to it is
/// wrong for sure.
fn chain(ctx: &Context, answer: &Reading, finding: &mut Grade) {
    let Some((sides, signs)) = answer.content.relations() else {
        return;
    };
    let wrong = sides
        .get(1..)
        .and_then(|sides| broken(ctx, sides, &signs[1..]));
    let apart = apart(ctx, sides, signs).filter(|_| ctx.diagnose && wrong.is_none());
    let apart = apart.map(|pair| pair.map(|e| Content::Scalar(e.clone())));
    let is_wrong = wrong.is_some();
    let Some(pair) = wrong.or(apart) else { return };
    if is_wrong && finding.is_equivalent() {
        *finding = chain_apart(ctx, [&pair[0], &pair[1]]);
    } else if ctx.diagnose {
        finding
            .diagnosis
            .extend(chain_apart(ctx, [&pair[0], &pair[1]]).diagnosis);
    }
}

/// The finding of two sides that are not equal.
fn chain_apart(ctx: &Context, pair: [&Content; 2]) -> Grade {
    let [one, two] = pair.map(|side| match side {
        Content::Scalar(e) => ctx.say(e),
        other => show(other),
    });
    let words = format!("{one} and {two} are not equal");
    let hint = "two sides of your chain of equations are not equal";
    Grade::told("DIFF_CHAIN", "kind", words, hint)
}

/// The finding where numbers at the end of an answer are not equal although its chain says so.
pub(super) fn numbers_apart(key: &Key, answer: &Content) -> Option<Grade> {
    let Content::Relations(sides, signs) = answer else {
        return None;
    };
    let options = Options::default();
    let ctx = Context::new(key, &options, false);
    let number = |side: &&Content| side.expr().is_some_and(Expr::is_constant);
    let count = sides.iter().rev().take_while(number).count();
    let from = sides.len() - count;
    let [one, two] = broken(&ctx, sides.get(from..)?, signs.get(from..)?)?;
    Some(chain_apart(&ctx, [&one, &two]))
}

/// Two values that are not equal although a chain says so, whether its numbers without a unit have that of the last side or are
/// counted in SI units.
fn broken(ctx: &Context, sides: &[Content], signs: &[Relation]) -> Option<[Content; 2]> {
    let [by_last, by_si] = named::in_unit_of_last(sides);
    let pair = apart_in(ctx, &by_last, signs)?;
    apart_in(ctx, &by_si, signs).map(|_| pair)
}

/// Two values that are not equal although a chain says so, and not what is rounded for the other. Names that the question does
/// not know may be anything, and what stands on both sides of them is equal all the same.
fn apart_in(ctx: &Context, measured: &[Content], signs: &[Relation]) -> Option<[Content; 2]> {
    let unit = |side: &Content| match side {
        Content::Quantity(q) => q.unit.dimension.clone(),
        _ => Dimension::none(),
    };
    let known = |e: &Expr| {
        e.symbols()
            .iter()
            .all(|name| &**name == "pi" || named::declared_symbol(ctx, name))
    };
    let equal = |sign: &Relation| matches!(sign, Relation::Equal | Relation::Approximately);
    for (i, pair) in measured.windows(2).enumerate() {
        if equal(&signs[i]) && lists_apart(ctx, [&pair[0], &pair[1]], &known) {
            return Some([pair[0].clone(), pair[1].clone()]);
        }
    }
    let mut before: Option<(usize, &Content, &Expr)> = None;
    for (i, side) in measured.iter().enumerate() {
        let Some(two) = side.expr().filter(|e| known(e)) else {
            continue;
        };
        let Some((from, first, one)) = before.replace((i, side, two)) else {
            continue;
        };
        let between = &signs[from..i];
        let constant = one.is_constant() && two.is_constant();
        let same_kind = unit(first) == unit(side) || one.is_zero() && two.is_zero();
        let rounded = constant || between.contains(&Relation::Approximately);
        let apart = match between.iter().all(equal) {
            false => false,
            true if !same_kind => constant,
            true => differ(ctx, one, two, rounded),
        };
        if apart {
            return Some([first.clone(), side.clone()]);
        }
    }
    None
}

/// Two neighbouring sides of a chain of equations, after its first, that are not equal.
fn apart<'a>(ctx: &Context, sides: &'a [Content], signs: &[Relation]) -> Option<[&'a Expr; 2]> {
    if sides.len() < 3 || signs.iter().any(|s| *s != Relation::Equal) {
        return None;
    }
    let exprs: Vec<&Expr> = sides[1..].iter().filter_map(Content::expr).collect();
    let differ = |pair: &&[&Expr]| {
        let decision = equality::decide(pair[0], pair[1], ctx.domains());
        decision.equality.is_different()
    };
    let pair = exprs.windows(2).find(differ)?;
    Some([pair[0], pair[1]])
}

pub(super) fn values(ctx: &Context, expected: &Content, answer: &Content) -> Grade {
    match (expected, answer) {
        (Content::Scalar(e), Content::Scalar(a)) => scalars(ctx, e, a),
        (Content::Quantity(e), Content::Quantity(a)) => unit::quantities(ctx, e, a),
        (Content::Quantity(e), Content::Scalar(a)) => unit::without(ctx, e, a),
        (Content::Scalar(e), Content::Quantity(a)) => unit::with(ctx, e, a),
        (Content::Vector(e), Content::Vector(a)) => {
            let room = room_beside(ctx, e);
            let options = room.as_ref().unwrap_or(ctx.options);
            let beside = Context::new(ctx.key, options, false);
            let one = |e: &Expr, a: &Expr| match e.is_zero() {
                true => scalars(&beside, e, a),
                false => scalars(&ctx.plain(), e, a),
            };
            let pairs = e.iter().zip(a);
            all_of(ctx, pairs, one, |i| partial::vectors(ctx, e, a, i))
        }
        (Content::Matrix(e), Content::Matrix(a)) => matrices(ctx, e, a),
        (Content::Either(e), Content::Either(a)) => several::lists(ctx, e, a),
        (Content::Either(e), Content::Scalar(a)) => {
            let right = e.iter().filter(|e| equal(ctx, e, a)).count();
            let together = ctx.options.tolerance.is_none() || several::distinct(ctx, e).len() == 1;
            if right == e.len() && together {
                return scalars(ctx, &e[0], a);
            }
            let one = right > 0;
            let words = match (one, e.len()) {
                (true, 2) => "one of the two values is missing",
                (true, _) => "the other values are missing",
                (false, 2) => "two values are expected",
                (false, _) => "several values are expected",
            };
            Grade::told("DIFF_ONE_OF_TWO", "kind", words, "there are two values")
        }
        (Content::Scalar(e), Content::Either(a)) => {
            let right = a.iter().filter(|a| equal(ctx, e, a)).count();
            let together = ctx.options.tolerance.is_none() || several::distinct(ctx, a).len() == 1;
            if right == a.len() && together {
                return scalars(ctx, e, &a[0]);
            }
            let words = match right {
                all if all == 0 || all == a.len() => "one value is expected",
                _ if a.len() > 2 => "one of the values is the expected one; the others are not",
                _ => "one of the two values is the expected one; the other is not",
            };
            let hint = "the answer is a single value: decide which sign it has";
            Grade::told("DIFF_TWO_FOR_ONE", "kind", words, hint)
        }
        (Content::Quantity(e), Content::Either(_)) => {
            values(ctx, &Content::Scalar(e.value.clone()), answer)
        }
        (Content::Vector(e), Content::Scalar(a)) => {
            // `a × a = 0`
            if a.is_zero() && e.iter().all(|e| equal(ctx, e, a)) {
                return scalars(ctx, &e[0], a);
            }
            // `ω² \vec r` is a vector as well.
            match &spread(&[expected.clone(), answer.clone()])[1] {
                vector @ Content::Vector(_) => values(ctx, expected, vector),
                _ => without_direction(ctx, e, a),
            }
        }
        (Content::Vector(e), Content::Quantity(q)) => without_direction(ctx, e, &q.value),
        (Content::Scalar(e), Content::Vector(a)) => {
            // `-(3v/2l) k` for a spin: only the sense of rotation is left of the vector.
            if a[0].is_zero() && a[1].is_zero() {
                return scalars(ctx, e, &a[2]);
            }
            kind("a number is expected, and the answer is a vector")
        }
        _ => kind("the answer is of another kind than what is expected"),
    }
}

/// A number where a vector is expected, which may be its size.
fn without_direction(ctx: &Context, expected: &[Expr; 3], answer: &Expr) -> Grade {
    let tolerance = ctx.options.tolerance.as_ref();
    let is_it = |e: &Expr| {
        let near = tolerance.and_then(|t| number::within(answer, e, t));
        near == Some(true) || equal(ctx, e, answer)
    };
    let nonzero: Vec<&Expr> = expected.iter().filter(|c| !c.is_zero()).collect();
    let message = match nonzero[..] {
        [only] if is_it(only) => "the component is right; the direction is missing",
        _ if is_it(&size(expected)) => "the size is right; the direction is missing",
        _ => "a vector is expected, and the answer is a number",
    };
    let hint = "a vector is asked: give its direction or components";
    Grade::told("DIFF_KIND", "kind", message, hint)
}

/// The size of a vector.
pub(super) fn size(vector: &[Expr; 3]) -> Expr {
    let squares = vector.each_ref().map(|part| part.powi(2));
    Expr::sum(squares.to_vec()).sqrt()
}

fn equal(ctx: &Context, expected: &Expr, answer: &Expr) -> bool {
    scalars(ctx, expected, answer).is_equivalent()
}

/// Matrices, entry by entry.
fn matrices(ctx: &Context, expected: &[Vec<Expr>], answer: &[Vec<Expr>]) -> Grade {
    let columns = expected[0].len();
    if [expected.len(), columns] != [answer.len(), answer[0].len()] {
        let size = |m: &[Vec<Expr>]| format!("{} × {}", m.len(), m[0].len());
        let (expected, answer) = (size(expected), size(answer));
        return kind(&format!(
            "a matrix of {expected} entries is expected, and the answer has {answer}"
        ));
    }
    let pairs = expected.iter().flatten().zip(answer.iter().flatten());
    let one = |e: &Expr, a: &Expr| scalars(&ctx.plain(), e, a);
    all_of(ctx, pairs, one, |i| {
        let turned = |(r, row): (usize, &Vec<Expr>)| {
            let mut entries = row.iter().enumerate();
            entries.all(|(c, e)| answer.get(c).is_some_and(|row| equal(ctx, e, &row[r])))
        };
        let square = expected.len() == columns;
        let found = match square && expected.iter().enumerate().all(turned) {
            true => {
                let words = "rows and columns are exchanged";
                Diagnosis::new("TRANSPOSED", words, "which index counts the rows?")
            }
            false => {
                let (row, column) = (i / columns + 1, i % columns + 1);
                let words =
                    format!("the entry in row {row} and column {column} is not the expected one");
                Diagnosis::new(
                    "ENTRY",
                    words,
                    "compare the entries with the equations they come from",
                )
            }
        };
        vec![found]
    })
}

/// The tolerance of a component that vanishes: as a share of it would be nothing, it is that of the vector's length.
fn room_beside(ctx: &Context, expected: &[Expr; 3]) -> Option<Options> {
    let tolerance = ctx.options.tolerance.as_ref()?;
    let length = Expr::sum(expected.iter().map(|e| e * e)).sqrt();
    let [low, _] = number::bounds(&length)?;
    Some(Options {
        tolerance: Some(Tolerance::Absolute(tolerance.width(&low))),
        ..ctx.options.clone()
    })
}

/// Components or entries, one by one; the first that differs decides, and is explained.
fn all_of<'e>(
    ctx: &Context,
    pairs: impl Iterator<Item = (&'e Expr, &'e Expr)>,
    one: impl Fn(&Expr, &Expr) -> Grade,
    explained: impl Fn(usize) -> Vec<Diagnosis>,
) -> Grade {
    let mut undecided = None;
    let mut total: Option<Grade> = None;
    for (i, (e, a)) in pairs.enumerate() {
        let mut finding = one(e, a);
        match finding.verdict {
            Verdict::Equivalent => match &mut total {
                None => total = Some(finding),
                Some(total) => total.assume(finding.assumed),
            },
            Verdict::Undecided => undecided = Some(finding),
            _ => {
                if ctx.diagnose {
                    finding.diagnosis.extend(explained(i));
                    if let Some(first) = finding.diagnosis.first() {
                        finding.note = partial::note(first.code);
                    }
                }
                return finding;
            }
        }
    }
    undecided
        .or(total)
        .unwrap_or_else(|| kind("an empty vector"))
}
