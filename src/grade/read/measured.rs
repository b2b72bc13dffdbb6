//! Quantities with their units, where names are declared or stand for such quantities alone.

use std::collections::BTreeSet;

use super::super::{Key, Question, with_names};
use super::{along_axes, answer, quantitative, vector};
use crate::dimension::{self, Dimension};
use crate::expr::{Expr, Symbol, only};
use crate::formula::{self, Content, Reading, Symbols};

/// An answer whose unit a sign ties to its number, or brackets enclose: `9.81*m/s^2`, `5 (m/s)`; and `2.4 s-1`.
pub(super) fn unit_apart(key: &Key, text: &str) -> Option<Reading> {
    let quantity = |from: usize, to: usize, last: bool| {
        let mut text = text.to_string();
        let instead = if &text[from..to] == "s-1" { "/s" } else { "" };
        text.replace_range(from..to, &format!("{instead:width$}", width = to - from));
        if last {
            text.truncate(text.trim_end().len() - 1);
        }
        let reading = formula::read(&text, &key.readable).ok()?;
        let plain = quantitative(&reading);
        (plain && reading.symbols().is_empty()).then_some(reading)
    };
    let signs = ["s-1", "*", "·", "\\cdot", "\\times"];
    let mut places = signs
        .iter()
        .flat_map(|sign| text.match_indices(sign).take(3));
    places
        .find_map(|(at, sign)| quantity(at, at + sign.len(), false))
        .or_else(|| {
            let at = text.rfind(['(', '{'])?;
            let closed = text.trim_end().ends_with([')', '}']);
            closed.then(|| quantity(at, at + 1, true)).flatten()
        })
}

/// `v = 5 [m/s]` for `v [m/s] = 5`.
pub(super) fn unit_of_name(text: &str) -> Option<String> {
    let (left, value) = text.split_once('=')?;
    let (name, unit) = left.trim_end().strip_suffix(']')?.rsplit_once('[')?;
    let measures = dimension::unit(unit).is_ok_and(|unit| !unit.dimension.is_none());
    (measures && !name.trim().is_empty()).then(|| format!("{name}={value} [{unit}]"))
}

/// A text as a quantity with a unit, where no undeclared symbol is needed to read it, or none but names of quantities in the
/// `open` reading of it.
pub(in crate::grade) fn quantity(
    text: &str,
    open: &Reading,
    question: &Question,
) -> Option<Reading> {
    let symbols = with_names(Symbols::strict().briefly(), question);
    let list = || {
        let lists = text.contains(',').then(|| symbols.clone().with_lists());
        let reading = lists.and_then(|lists| formula::read(text, &lists).ok());
        reading
            .or_else(|| along_axes(text, &symbols))
            .filter(vector)
    };
    let direct = || match begins_unnamed(text, question) {
        true => None,
        false => formula::read(text, &symbols).ok(),
    };
    let plain = direct().or_else(list).filter(|reading| {
        quantitative(reading) || reading.unit.is_some() && reading.symbols().is_empty()
    });
    let found = plain.or_else(|| bounds(text, open, question));
    found.filter(|reading| !is_weight(text, reading))
}

/// Whether what would measure a mass times a length is a weight, or its work, in symbols: `3 m g/4`, and `2 m g h`.
fn is_weight(text: &str, reading: &Reading) -> bool {
    let unit = match reading.content.answer() {
        Content::Quantity(q) => &q.unit.dimension,
        _ => return false,
    };
    let grams = text.contains('g') && !text.contains("kg");
    grams
        && [0, 1]
            .iter()
            .any(|time| *unit == Dimension::new(1, 1, *time))
}

/// A text that says of names alone which quantities they are, or lie between: `2 m < x < 3 m`, `v = 2 m/s; s = 4 m`.
fn bounds(text: &str, open: &Reading, question: &Question) -> Option<Reading> {
    let sides = open.content.chains().into_iter().flatten();
    let names = sides.filter_map(|side| side.name().cloned());
    let names: BTreeSet<Symbol> = names.collect();
    if names.is_empty() || !text.contains(|c: char| c.is_ascii_digit()) {
        return None;
    }
    let mut symbols = with_names(Symbols::strict().briefly(), question);
    names.iter().for_each(|name| symbols.declare(name));
    let reading = formula::read(text, &symbols).ok()?;
    let mut sides = reading.content.chains().into_iter().flatten();
    let units = sides.any(|side| matches!(side, Content::Quantity(_)));
    (units && reading.symbols() == names && measured(&reading.content)).then_some(reading)
}

/// Whether every side of some relations is a name, a quantity or a number.
fn measured(content: &Content) -> bool {
    let plain = |e: &Expr| e.is_constant() || e.as_symbol().is_some();
    let mut sides = content.chains().into_iter().flatten();
    matches!(content, Content::Relations(..) | Content::Joined(..))
        && sides.all(|side| side.expr().is_some_and(plain))
}

/// Whether a formula, with nothing before it that would be passed over, begins with a letter that is no declared name.
fn begins_unnamed(text: &str, question: &Question) -> bool {
    let plain = |b: u8| b.is_ascii() && !b"\\$>=:,".contains(&b);
    let letter = only(text.chars().take_while(char::is_ascii_alphabetic));
    letter.is_some_and(|letter| {
        let declared = || question.given().any(|g| g.name.starts_with(letter));
        letter != 'e' && text.bytes().all(plain) && !declared()
    })
}

/// Whether an answer to a key that is a quantity is one too, or a bare number.
pub(in crate::grade) fn is_quantity(key: &Key, text: &str) -> bool {
    answer(key, text).is_ok_and(|reading| {
        let answer = reading.content.answer();
        matches!(answer, Content::Quantity(_))
            || answer.exprs().iter().all(|e| e.is_constant())
                && !matches!(answer, Content::Relations(..))
            || measured(&reading.content)
    })
}
