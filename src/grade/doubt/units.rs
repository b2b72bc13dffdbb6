//! Units run together before a negative exponent: `50 Nm^{-1}` for newtons per metre.

use super::super::{Grade, Key, Options, judge_here, read};
use super::LONGEST;
use crate::dimension;
use crate::formula::{self, Content, Quantity};

/// Ways in which the letters of a unit are tried.
const MOST: usize = 16;

/// Longest symbol of a unit that is run together with others: `kg`, `mol`.
const LONGEST_UNIT: usize = 3;

/// A grade that is right where units run together, in the answer or in the expected value, are a product of units of which the
/// exponent belongs to the last.
pub(in crate::grade) fn run_together(key: &Key, answer: &str, options: &Options) -> Option<Grade> {
    let own = key.quantity.as_deref().unwrap_or(key);
    let asked = match own.reading.content.answer() {
        Content::Quantity(q) => Some(q),
        _ => None,
    };
    let dimension = asked.map(|q| &q.unit.dimension);
    let dimension = dimension.or(own.question.dimension.as_ref())?;
    let right = |key: &Key, text: &str, meant: String| {
        let mut grade = judge_here(key, text, options);
        grade.assumed.push(meant);
        grade.is_equivalent().then_some(grade)
    };
    let fitting = |text: &String| match read::answer(own, text).ok()?.content.answer() {
        Content::Quantity(q) if q.unit.dimension == *dimension => Some(q.unit_text.clone()),
        _ => None,
    };
    let mut texts = apart(answer).into_iter();
    if let Some((text, unit)) = texts.find_map(|text| Some((text.clone(), fitting(&text)?))) {
        let meant = format!("the unit is read as {unit}");
        return right(key, &text, meant);
    }
    // The same of the key, where the answer has the unit that it then is.
    let quantity = asked?;
    let reading = read::answer(own, answer).ok()?;
    let Content::Quantity(given) = reading.content.answer() else {
        return None;
    };
    let mut units = apart(&quantity.unit_text).into_iter();
    let (text, unit) = units.find_map(|text| {
        let unit = dimension::unit(&formula::plain_unit(&text)?).ok()?;
        (unit.dimension == given.unit.dimension).then_some((text, unit))
    })?;
    let meant = format!("the expected unit is read as {text}");
    let quantity = Quantity::of(quantity.written.clone(), unit, &text);
    right(
        &own.with(Content::Quantity(Box::new(quantity))),
        answer,
        meant,
    )
}

/// A text with the letters before its negative exponents parted into units, in all ways.
fn apart(text: &str) -> Vec<String> {
    if text.len() > LONGEST {
        return Vec::new();
    }
    let mut found = vec![String::new()];
    let mut parted = false;
    let mut rest = text;
    while let Some(at) = rest.find(|c: char| c.is_ascii_alphabetic()) {
        let (before, word) = rest.split_at(at);
        let end = word
            .find(|c: char| !c.is_ascii_alphabetic())
            .unwrap_or(word.len());
        let (word, behind) = word.split_at(end);
        let is_command = before.ends_with('\\');
        let raised = ["^-", "^{-", "^−", "^{−", "⁻"]
            .iter()
            .any(|sign| behind.starts_with(sign));
        let ways = match raised && !is_command {
            true => units(word),
            false => vec![word.to_string()],
        };
        parted |= ways.iter().any(|way| way != word);
        // A space ends the exponent before.
        let space = if raised && behind.len() < rest.len() && !before.is_empty() {
            " "
        } else {
            ""
        };
        let longer = found.iter().flat_map(|start| {
            ways.iter()
                .map(move |way| format!("{start}{before}{space}{way}"))
        });
        found = longer.take(MOST).collect();
        rest = behind;
    }
    found.iter_mut().for_each(|text| text.push_str(rest));
    found.retain(|_| parted);
    found
}

/// The ways in which letters are units side by side, of which there may be one alone; the letters themselves where there is none.
fn units(word: &str) -> Vec<String> {
    let mut found = Vec::new();
    for length in 1..word.len().min(LONGEST_UNIT + 1) {
        let (first, rest) = word.split_at(length);
        if dimension::unit(first).is_err() {
            continue;
        }
        found.extend(
            units(rest)
                .into_iter()
                .map(|rest| format!("{first} {rest}")),
        );
        found.truncate(MOST);
    }
    let is_one = word.len() <= LONGEST_UNIT && dimension::unit(word).is_ok();
    if is_one || found.is_empty() {
        found.push(word.to_string());
    }
    found
}
