//! Answers that say what they are values of, or leave it out: `v = …` where `u = …` is asked, a value for an equation, and an
//! equation for a value.

use std::collections::BTreeSet;

use num_traits::{One, Zero};

use super::super::{Diagnosis, Grade, Tolerance, Verdict, number, relation};
use super::{apart_in, chain, chain_apart, kind, values};
use crate::algebra::Sign;
use crate::dimension::{self, Dimension, Unit};
use crate::domain::Sample;
use crate::expr::{Expr, Function, Node, Rational, Symbol, only, ratio};
use crate::formula::{self, Content, Quantity, Reading, Relation};
use crate::grade::context::{Context, quotient};
use crate::interval::{Interval, Outcome, evaluate};

/// Points at which an equation is tried before its solutions are compared.
const POINTS: usize = 4;

/// The sides of `x = 2` for the values of the only symbol of an equation.
pub(super) fn only_unknown(equation: &Content, value: &Content) -> Option<[Content; 2]> {
    unknown(equation, value).filter(|_| !equation.is_bounded())
}

/// The same for the only symbol of a relation.
pub(super) fn unknown(equation: &Content, value: &Content) -> Option<[Content; 2]> {
    let constant = match value {
        Content::Scalar(e) => e.is_constant(),
        Content::Either(values) => values.iter().all(Expr::is_constant),
        _ => false,
    };
    let symbols = equation.symbols().into_iter();
    let name = only(symbols.filter(|s| &**s != "pi"))?;
    constant.then(|| [Content::Scalar(Expr::symbol(&name)), value.clone()])
}

/// A value, possibly with the name it is given to.
type Named<'a> = (Option<&'a Symbol>, &'a Content);

/// Two values with their names.
pub(super) fn named_values(
    ctx: &Context,
    answer: &Reading,
    (mine, expected): Named,
    (theirs, value): Named,
) -> Grade {
    let asked = &ctx.key.question.asked;
    let is_asked = |name: &Symbol| asked.iter().any(|g| g.name == *name);
    let inside = |c: &Content, name: &Symbol| c.symbols().contains(name);
    let mut finding = values(ctx, expected, value);
    if finding.verdict == Verdict::Different
        && let Content::Relations(sides, signs) = &answer.content
        && let [.., exact, rounded] = sides.as_slice()
        && signs.last() == Some(&Relation::Approximately)
        && signs.len() > 1
        && close(ctx, expected, rounded)
    {
        finding = values(ctx, expected, exact);
    }
    match (mine, theirs) {
        // `x_{1,2} = 1 ± √2`
        (Some(mine), Some(theirs)) if is_counted(theirs, mine) => {}
        (Some(mine), Some(theirs)) if mine != theirs && !(is_asked(mine) && is_asked(theirs)) => {
            // The same equation, solved for another of its symbols.
            if let (Content::Relations(a, s), Content::Relations(b, t)) =
                (&ctx.key.reading.content, &answer.content)
                && inside(expected, theirs)
                && inside(value, mine)
            {
                return relation::compare(ctx, (a, s), (b, t));
            }
            finding = other_name(finding, mine, theirs);
        }
        (Some(_), Some(theirs)) if !declared_symbol(ctx, theirs) => {
            finding.assumed.retain(|a| !a.starts_with(&**theirs));
        }
        // A symbol of the expected formula cannot be the name of its value: `v = 3v/2` says something else.
        (None, Some(theirs)) if inside(expected, theirs) && !is_asked(theirs) => {
            let words = "a value is expected, and the answer is an equation for";
            finding = Grade::different("DIFF_KIND", "kind", format!("{words} {theirs}"));
        }
        (None, Some(theirs)) if !is_asked(theirs) && declared_symbol(ctx, theirs) => {
            if let Some(first) = asked.first() {
                finding = other_name(finding, &first.name, theirs);
            }
        }
        _ => {}
    }
    chain(ctx, answer, &mut finding);
    finding
}

/// Whether a name is that of several values of another, `x_{1,2}` of `x`.
fn is_counted(name: &Symbol, of: &Symbol) -> bool {
    let index = name.strip_prefix(&**of).map(|i| i.trim_start_matches('_'));
    let number = |part: &str| !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit());
    index.is_some_and(|index| index.contains(',') && index.split(',').all(number))
}

/// A relation where a value is expected: whether it says that the value is this.
pub(super) fn solved(
    ctx: &Context,
    (name, expected): Named,
    (mine, signs): (&[Content], &[Relation]),
) -> Grade {
    if let Some(finding) = nameless(ctx, (name, expected), mine, signs) {
        return finding;
    }
    let solved = |name: &Symbol| {
        let sides = [Content::Scalar(Expr::symbol(name)), expected.clone()];
        relation::compare(ctx, (&sides, &[Relation::Equal]), (mine, signs))
    };
    let asked = ctx.key.question.asked.first().map(|g| &g.name);
    if let Some(name) = name.or(asked) {
        return solved(name);
    }
    match strangers(ctx, mine).as_slice() {
        [name] => solved(name),
        // `mgh = ½mv²` says what v is, whatever m is.
        names => {
            let names = names.iter().take(3);
            let mut found = names
                .filter(|name| may_hold(ctx, mine, name, expected))
                .map(solved);
            found
                .find(Grade::is_equivalent)
                .unwrap_or_else(|| kind("a value is expected, and the answer is a relation"))
        }
    }
}

/// `3v/(2l) = 1.5 v/l` for `3v/(2l)`: a chain without a name, of which every side is the expected value; behind ≈ a rounded
/// one will do.
fn nameless(
    ctx: &Context,
    (name, expected): Named,
    sides: &[Content],
    signs: &[Relation],
) -> Option<Grade> {
    let plain = ctx.plain();
    let sides = &match expected {
        Content::Quantity(_) => {
            let [by_last, by_si] = in_unit_of_last(sides);
            match apart_in(ctx, &by_last, signs) {
                None => by_last,
                Some(_) => by_si,
            }
        }
        _ => sides.to_vec(),
    };
    let (first, others) = sides.split_first()?;
    let mut finding = values(&plain, expected, first);
    // `KE = mv²/2`: letters that stand nowhere else are a name of the value; a difference or a quotient of names is no other
    // word for the name that is asked for.
    let free = |name: &Symbol| !declared_symbol(ctx, name);
    if let [side, value] = &sides[..]
        && side.expr().is_some_and(|e| {
            name.is_none() && of_two_names(e, &free, expected.expr())
                || is_word(ctx, e, (name, expected))
                || is_size_of(ctx, e, expected)
        })
        && strangers(ctx, std::slice::from_ref(value)).is_empty()
    {
        finding = values(&plain, expected, value);
    }
    // `10/2 = 5 m`, `2√3 ≈ 3.46 cm`: what leads to the quantity at the end.
    let same_kind = |last: &Quantity, side: &Content| matches!(side, Content::Quantity(q) if q.unit.dimension == last.unit.dimension);
    if let Some((last @ Content::Quantity(unit), before)) = sides.split_last()
        && matches!(expected, Content::Quantity(_))
        && signs
            .iter()
            .all(|sign| matches!(sign, Relation::Equal | Relation::Approximately))
        && before
            .iter()
            .all(|side| same_kind(unit, side) && close(ctx, side, last))
    {
        let last = values(&plain, expected, last);
        if last.is_equivalent() {
            return Some(last);
        }
    }
    let right = finding.is_equivalent();
    let constant = |side: &Content| side.expr().is_some_and(Expr::is_constant);
    let follows = |(sign, side): (&Relation, &Content)| match sign {
        Relation::Equal => values(&plain, expected, side).is_equivalent(),
        Relation::Approximately => close(ctx, expected, side),
        _ => false,
    };
    let apart = signs.iter().zip(others).find(|pair| !follows(*pair));
    match apart {
        None if right => Some(finding),
        // Numbers alone are no equation for anything.
        Some((_, other)) if sides.iter().all(constant) => {
            Some(match (right, first.expr(), other.expr()) {
                (true, Some(_), Some(_)) => chain_apart(ctx, [first, other]),
                _ => values(ctx, expected, first),
            })
        }
        _ => None,
    }
}

/// The sides before a quantity at the end, their bare numbers counted in its unit, and counted in SI units: `x = 50 = 50 cm` and
/// `x = 0.5 = 50 cm` are both meant so.
pub(super) fn in_unit_of_last(sides: &[Content]) -> [Vec<Content>; 2] {
    let Some(Content::Quantity(last)) = sides.last() else {
        return [sides.to_vec(), sides.to_vec()];
    };
    let si = Unit {
        factor: Rational::one(),
        pi: Rational::zero(),
        ..last.unit.clone()
    };
    [&last.unit, &si].map(|unit| {
        let measured = |side: &Content| match side {
            Content::Scalar(e) if e.is_constant() => {
                let quantity = Quantity::of(e.clone(), unit.clone(), &last.unit_text);
                Content::Quantity(Box::new(quantity))
            }
            other => other.clone(),
        };
        sides.iter().map(measured).collect()
    })
}

/// Whether a side behind ≈ is the expected value with its factor rounded, or cut, to the digits written.
fn close(ctx: &Context, expected: &Content, side: &Content) -> bool {
    let (Some(rounded), Some(exact)) = (side.expr(), expected.expr()) else {
        return false;
    };
    let factor = match side {
        Content::Quantity(q) => q.written.split_number().0,
        _ => rounded.split_number().0,
    };
    quotient(rounded, exact, &ctx.plain()).is_some_and(|share| number::rounds(&factor, &share))
}

/// Whether two expressions are at most 1/20 apart; nothing where their quotient is no number.
pub(super) fn is_close(ctx: &Context, exact: &Expr, rounded: &Expr) -> Option<bool> {
    let share = quotient(rounded, exact, &ctx.plain())?;
    number::within(&share, &Expr::one(), &Tolerance::Relative(ratio(1, 20)))
}

/// Whether letters side by side, none of them of the question, are a name such as `KE`, `pe` or `Fnet`, or a product that
/// measures what is asked, as `Iω` does for `m v l/2`; so are the letters of a velocity with an index, `vf` and `vx`.
/// Beside a number they are no other word for the name that is asked for.
fn is_word(ctx: &Context, e: &Expr, (name, expected): Named) -> bool {
    let free = |name: &Symbol| !declared_symbol(ctx, name);
    let Node::Product(parts) = e.node() else {
        return false;
    };
    let letters: Option<Vec<&Symbol>> = parts.iter().map(Expr::as_symbol).collect();
    let index = |name: &Symbol| free(name) && matches!(&**name, "f" | "i" | "x" | "y");
    let velocity = |name: &Symbol| matches!(&**name, "v" | "u" | "V");
    letters.is_some_and(|letters| {
        let capital = |name: &&Symbol| name.starts_with(char::is_uppercase);
        let energy = || letters.iter().any(|name| &***name == "e");
        let word = || letters.len() > 2 || energy() || letters.iter().all(capital);
        let measured = |e: &Expr| dimension::of(e, &usual).ok().flatten();
        let asked = expected.expr().filter(|e| !e.is_constant());
        let fits = match asked.map(|asked| [e, asked].map(measured)) {
            Some([Some(mine), Some(asked)]) => mine == asked,
            Some(_) => word(),
            None => name.is_none(),
        };
        fits && letters.iter().all(|name| free(name))
            || matches!(letters.as_slice(), [a, b] if velocity(a) && index(b) || velocity(b) && index(a))
    })
}

/// Whether a formula is the size of what the question does not know, and the expected value may be a size.
fn is_size_of(ctx: &Context, e: &Expr, expected: &Content) -> bool {
    let free = |name: &Symbol| !declared_symbol(ctx, name);
    let sign = |e| relation::sign_of(e, ctx.domains());
    is_size(e, &free) && expected.expr().and_then(sign) != Some(Sign::Negative)
}

/// What a letter of mechanics nearly always measures.
fn usual(name: &str) -> Option<Dimension> {
    let (letter, _) = name.split_once('_').unwrap_or((name, ""));
    let [mass, length, time] = match letter.trim_end_matches(|c: char| c.is_ascii_digit()) {
        "m" | "M" => [1, 0, 0],
        "h" | "l" | "L" | "d" | "r" | "R" | "x" | "s" => [0, 1, 0],
        "t" => [0, 0, 1],
        "v" | "u" => [0, 1, -1],
        "a" | "g" => [0, 1, -2],
        "omega" => [0, 0, -1],
        "F" => [1, 1, -2],
        "I" => [1, 2, 0],
        _ => return None,
    };
    Some(Dimension::new(mass, length, time))
}

/// Whether a formula is the difference, the sum or the quotient of two names of one letter, as in `E_1 − E_2` and `K_2/K_1`; a
/// number may be the quotient of any two, as in `h/l = 2/3`.
pub(super) fn of_two_names(e: &Expr, free: &dyn Fn(&Symbol) -> bool, value: Option<&Expr>) -> bool {
    let name = |e: &Expr| e.as_symbol().cloned().filter(free);
    let letter = |name: &Symbol| {
        let name = name
            .strip_prefix("Delta")
            .unwrap_or(name)
            .trim_start_matches('_');
        let base = name.split(['_', '\'']).next().unwrap_or_default();
        base.trim_end_matches(|c: char| c.is_ascii_digit())
            .to_string()
    };
    let number = matches!(e.node(), Node::Product(_)) && value.is_some_and(Expr::is_constant);
    let alike = |a: &Expr, b: &Expr| match (name(a), name(b)) {
        (Some(a), Some(b)) => a != b && (number || letter(&a) == letter(&b)),
        _ => false,
    };
    let pair = |parts: &[Expr], turned: &dyn Fn(&Expr) -> Expr| matches!(parts, [a, b] if alike(a, &turned(b)) || alike(&turned(a), b));
    match e.node() {
        Node::Sum(parts) => pair(parts, &|b| -b) || pair(parts, &Expr::clone),
        Node::Product(parts) => pair(parts, &|b| b.powi(-1)),
        _ => false,
    }
}

/// Whether a formula is the size of a name, as in `|v|`, or of a vector.
pub(super) fn is_size(e: &Expr, free: &dyn Fn(&Symbol) -> bool) -> bool {
    let square = |e: &Expr| match e.node() {
        Node::Product(parts) => {
            let mut names = parts.iter().map(Expr::as_symbol);
            names.all(|name| name.is_some_and(|name| formula::is_component(name) && free(name)))
        }
        _ => false,
    };
    match e.node() {
        Node::Call(Function::Abs, inner) => inner.as_symbol().is_some_and(free),
        Node::Power(base, _) => matches!(base.node(), Node::Sum(parts) if parts.iter().all(square)),
        _ => false,
    }
}

pub(super) fn declared_symbol(ctx: &Context, name: &Symbol) -> bool {
    ctx.key.question.symbols.iter().any(|g| g.name == *name)
}

/// The names of an equation that the expected value does not know.
fn strangers(ctx: &Context, sides: &[Content]) -> Vec<Symbol> {
    let mut found: BTreeSet<Symbol> = sides.iter().flat_map(Content::symbols).collect();
    found.retain(|name| !declared_symbol(ctx, name));
    found.into_iter().collect()
}

/// Whether an equation can hold with a value in the place of a name: solutions are compared at much greater cost.
fn may_hold(ctx: &Context, sides: &[Content], name: &Symbol, value: &Content) -> bool {
    let ([left, right], Some(value)) = (sides, value.expr()) else {
        return true;
    };
    let (Some(left), Some(right)) = (left.expr(), right.expr()) else {
        return true;
    };
    let difference = (left - right).put(name, value);
    let points = ctx.domains().points(&[&difference], POINTS);
    let is_zero = |sample: &Sample| match evaluate::<Interval>(&difference, &sample.point(true)) {
        Outcome::Value(value) => value.low <= 0.0 && value.high >= 0.0,
        _ => true,
    };
    points.iter().all(is_zero)
}

pub(in crate::grade) fn other_name(finding: Grade, mine: &Symbol, theirs: &Symbol) -> Grade {
    let words = format!("the answer speaks of {theirs}, and {mine} is asked for");
    let message = match finding.is_equivalent() {
        true => format!("{words}; the right side is the expected one"),
        false => words.clone(),
    };
    Grade::different("DIFF_NAME", "kind", words.clone())
        .with(Diagnosis::new("NAME", message, words))
}
