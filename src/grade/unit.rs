//! Units of answers: missing, wrong, compatible, in excess, or standing behind a formula that carries its own.

use std::collections::BTreeMap;

use super::context::Context;
use super::scalar::scalars;
use super::{Diagnosis, Grade, Key, Tolerance, Verdict, number};
use crate::dimension::{self, Clash, Dimension, Unit};
use crate::expr::{Expr, Rational, Symbol, ratio};
use crate::formula::{self, Content, Fault, Quantity, Reading, Remark, Symbols};

/// The unit behind a vector, a pair, or a formula in symbols, which carry none in their content.
///
/// Behind a formula whose symbols have dimensions the unit has to fit and to be the coherent one, and says nothing new;
/// where dimensions are not known it cannot be checked, and the reader's remark says that it was not used.
pub(super) fn behind(key: &Key, reading: &Reading, finding: &mut Grade) {
    let content = reading.content.answer();
    // Results with their names were compared with their units.
    let named = matches!(key.reading.content, Content::Joined(..));
    if named || matches!(content, Content::Quantity(_)) {
        return;
    }
    let constant = content.exprs().iter().all(|e| e.is_constant());
    let zero = content.exprs().iter().all(|e| e.is_zero());
    let asked = asked(key);
    let Some(unit) = &reading.unit else {
        let needed = key.reading.unit.as_ref().filter(|u| !u.dimension.is_none());
        let bare = matches!(
            content,
            Content::Vector(_) | Content::Matrix(_) | Content::Either(_)
        );
        if let Some(needed) = needed
            && bare
            && constant
            && !zero
        {
            *finding = missing(needed);
        }
        return;
    };
    match asked {
        Some(asked) if asked != unit.dimension && finding.verdict != Verdict::Undecided => {
            let right = finding.is_equivalent();
            *finding = wrong(&asked, &unit.dimension, &unit.dimension.si(), right);
        }
        Some(_) if !constant && !is_coherent(unit) && finding.is_equivalent() => {
            let words = "the symbols carry their units; the unit behind the formula is another one";
            let found = Diagnosis::new("UNIT_OF_SYMBOLS", words, "leave the unit away");
            *finding = Grade::new(Verdict::Invalid, "INVALID_UNIT", "none", words).with(found);
        }
        None if constant && !unit.dimension.is_none() => {
            *finding = extra(&unit.dimension.si(), false)
        }
        _ => {}
    }
}

/// Relations that would be right but for a number without its unit, or with another: `v > 2` for `v > 2 m/s`. What stands alone
/// beside a quantity in the expected relations has its dimension.
pub(super) fn of_relations(key: &Key, reading: &Reading, finding: &mut Grade) {
    let mut known = BTreeMap::new();
    for sides in key.reading.content.chains() {
        let names = sides.iter().filter_map(|side| side.name());
        if let Some(dimension) = sides.iter().find_map(dimension_of) {
            known.extend(names.map(|name| (name.to_string(), dimension.clone())));
        }
    }
    // Bounds of something without a name are those of whatever the answer calls it.
    if let Some(dimension) = known.get(formula::UNNAMED).cloned() {
        let sides = reading.content.chains().into_iter().flatten();
        let names = sides.filter_map(|side| side.name());
        known.extend(names.map(|name| (name.to_string(), dimension.clone())));
    }
    if finding.verdict != Verdict::Equivalent || known.is_empty() {
        return;
    }
    // Expected relations that mix dimensions themselves demand no unit.
    let clash =
        clash(&reading.content, &known).filter(|_| clash(&key.reading.content, &known).is_none());
    let Some(parts) = clash else { return };
    *finding = match parts.iter().position(Dimension::is_none) {
        Some(bare) => missing(&Unit::coherent(parts[1 - bare].clone())),
        None => wrong(&parts[0], &parts[1], &parts[1].si(), false),
    };
}

/// Values that answer by names of their own, and would be right but for their units: `v_1 = 2 kg` for `2 m/s`, and `x = 4 kg`
/// for `2x = 8`.
pub(super) fn of_names(key: &Key, reading: &Reading, finding: &mut Grade) {
    if finding.verdict != Verdict::Equivalent {
        return;
    }
    let expected = &key.reading.content;
    let mut sides = expected.chains().into_iter().flatten();
    if sides.any(|side| dimension_of(side).is_some()) {
        if let Some(found) = misfit_in(expected, &reading.content) {
            *finding = found;
        }
        return;
    }
    let related = !expected.chains().is_empty();
    let constant = || expected.exprs().iter().all(|e| e.is_constant());
    let of_values = match (&key.reading.unit, related) {
        (Some(unit), _) => Some(unit.dimension.clone()),
        (None, true) => None,
        (None, false) => asked(key).or_else(|| constant().then(Dimension::none)),
    };
    if of_values.is_none() && !related {
        return;
    }
    let mut chains = reading.content.chains();
    let is_asked = |name: &Symbol| key.question.asked.iter().any(|g| g.name == *name);
    if chains.len() > 1 && !related {
        // Results by their names were compared with their units, and of one value the last is the answer.
        if chains
            .iter()
            .any(|sides| sides.iter().filter_map(Content::name).any(is_asked))
        {
            return;
        }
        if matches!(expected, Content::Scalar(_) | Content::Quantity(_)) {
            chains.drain(..chains.len() - 1);
        }
    }
    let wrong_in = |sides: &[Content]| {
        let name = sides.iter().find_map(Content::name)?;
        let known = || key.question.dimension_of(name);
        let wanted = of_values
            .clone()
            .or_else(known)
            .unwrap_or_else(Dimension::none);
        let given = sides
            .iter()
            .filter_map(dimension_of)
            .find(|given| *given != wanted)?;
        Some(match wanted.is_none() {
            true => extra(&given.si(), true),
            false => wrong(&wanted, &given, &given.si(), true),
        })
    };
    if let Some(found) = chains.into_iter().find_map(wrong_in) {
        *finding = found;
    }
}

/// The finding on a value whose unit does not fit the expected relations, of which it is a solution by its number: `x = 4 kg` for
/// `2x = 8 m`.
fn misfit_in(expected: &Content, answer: &Content) -> Option<Grade> {
    // Expected relations that mix dimensions themselves demand no unit.
    if clash(expected, &BTreeMap::new()).is_some() {
        return None;
    }
    let misfit = |sides: &[Content]| {
        let name = sides.iter().find_map(Content::name)?;
        let given = sides.iter().find_map(dimension_of)?;
        let known = BTreeMap::from([(name.to_string(), given.clone())]);
        clash(expected, &known).map(|_| given.si())
    };
    let unit = answer.chains().into_iter().find_map(misfit)?;
    let words = format!("the unit {unit} of the answer does not fit the expected relation");
    let hint = "put your value with its unit into the relation";
    Some(Grade::told("DIFF_UNIT", "dimension", words, hint))
}

/// The fault of a number whose unit would be one but for brackets below its slash: `4186 J/kg K`.
pub(super) fn unclear(answer: &str) -> Option<Fault> {
    let at = answer.find(char::is_alphabetic)?;
    let (number, unit) = answer.split_at(at);
    let is_number = formula::read(number, &Symbols::strict()).is_ok_and(|r| r.literal.is_some());
    let fault = dimension::unit(unit)
        .err()
        .filter(|fault| is_number && fault.is_unclear)?;
    Some(*Fault::new(fault.message, at + fault.start, at + fault.end))
}

/// Two dimensions that relations set against each other, `known` being those of names.
fn clash(content: &Content, known: &BTreeMap<String, Dimension>) -> Option<[Dimension; 2]> {
    let known = |name: &str| known.get(name).cloned();
    let dimension = |side: &Content| match side {
        Content::Quantity(q) => Some(q.unit.dimension.clone()),
        other => dimension::of(other.expr()?, &known).ok()?,
    };
    let sum = |side: &Content| match *dimension::of(side.expr()?, &known).err()? {
        Clash::Sum {
            left_is, right_is, ..
        } => Some([left_is, right_is]),
        _ => None,
    };
    content.chains().into_iter().find_map(|sides| {
        let all: Vec<Dimension> = sides.iter().filter_map(dimension).collect();
        let apart = all.iter().find(|other| **other != all[0]);
        let apart = apart.map(|other| [all[0].clone(), other.clone()]);
        apart.or_else(|| sides.iter().find_map(sum))
    })
}

/// The dimension of a quantity that is no plain number.
fn dimension_of(side: &Content) -> Option<Dimension> {
    match side {
        Content::Quantity(q) => Some(&q.unit.dimension).filter(|d| !d.is_none()).cloned(),
        _ => None,
    }
}

/// What letters of a unit may mean where only that fits what is asked: without a space `ms` of `1.2 ms^{-1}` would be a
/// millisecond, and a pound is a force in `12 ft lb`.
const MEANT: [(&str, &str); 6] = [
    ("ms", "m s"),
    ("kgms", "kg m s"),
    ("lb", "lbf"),
    ("lbs", "lbf"),
    ("pound", "lbf"),
    ("pounds", "lbf"),
];

/// Reads the unit of an answer as it fits what is asked, if it only fits so, and says what is assumed of it.
pub(super) fn as_asked(key: &Key, reading: &mut Reading) -> Option<String> {
    let asked = match key.reading.content.answer() {
        Content::Quantity(expected) => Some(expected.unit.dimension.clone()),
        _ => asked(key),
    };
    let asked = asked?;
    let said = match &mut reading.content {
        Content::Relations(sides, _) => sides.last_mut(),
        other => Some(other),
    };
    let Some(Content::Quantity(quantity)) = said else {
        return None;
    };
    if quantity.unit.dimension == asked {
        return None;
    }
    // `5 ms` says what it means.
    let alone = quantity.unit_text.trim() == "ms";
    let meanings = MEANT.iter().filter(|(word, _)| !alone || *word != "ms");
    let (words, unit) = meanings.into_iter().find_map(|(word, meant)| {
        let text = formula::plain_unit(&with_word(&quantity.unit_text, word, meant)?)?;
        let unit = dimension::unit(&text).ok()?;
        (unit.dimension == asked).then(|| (format!("{word} stands for {meant}"), unit))
    })?;
    quantity.value = &quantity.written * &unit.value();
    quantity.unit = unit;
    Some(words)
}

/// A text with a word of letters replaced wherever it stands, if it does.
fn with_word(text: &str, word: &str, other: &str) -> Option<String> {
    let mut out = String::new();
    let mut found = false;
    for part in text.split_inclusive(|c: char| !c.is_alphabetic()) {
        let letters = part.trim_end_matches(|c: char| !c.is_alphabetic());
        found |= letters == word;
        out.push_str(if letters == word { other } else { letters });
        out.push_str(&part[letters.len()..]);
    }
    found.then_some(out)
}

const MISSING: &str = "a unit is missing";

/// The finding where a number stands without a unit; one of another system is not told by its name.
pub(super) fn missing(unit: &Unit) -> Grade {
    let words = match unit.value().is_one() {
        true => format!("the unit {} is missing", unit.dimension.si()),
        false => MISSING.to_string(),
    };
    Grade::told("DIFF_UNIT_MISSING", "dimension", words, MISSING)
}

fn is_coherent(unit: &Unit) -> bool {
    unit.value().is_one()
}

/// The places of letters behind a formula in symbols that were read as a unit and measure something else than what is asked, as
/// in `v − μ g t` and `½ μ g t²`: they may be names.
pub(super) fn misfit(key: &Key, text: &str, reading: &Reading) -> Option<Vec<usize>> {
    let mut notes = reading.notes.iter();
    let note = notes.find(|n| n.remark == Remark::UnitOfSymbols)?;
    let fits = asked(key)? == reading.unit.as_ref()?.dimension;
    let mut places = Vec::new();
    let mut at = note.start;
    let unit = text.get(note.start..note.end)?.trim_end();
    for word in unit.split([' ', '/']) {
        let power = word
            .get(1..)
            .filter(|_| word.starts_with(|c: char| c.is_ascii_alphabetic()))?;
        let plain = |c: char| "^{}²³".contains(c) || c.is_ascii_digit();
        power.chars().all(plain).then_some(())?;
        if !text[..at].ends_with('/') {
            places.push(at);
        }
        at += word.len() + 1;
    }
    (!fits && !places.is_empty()).then_some(places)
}

/// Dimension of what is asked, where it is known and not that of a number.
fn asked(key: &Key) -> Option<Dimension> {
    let unit = match key.reading.content.answer() {
        Content::Quantity(quantity) => Some(&quantity.unit),
        _ => key.reading.unit.as_ref(),
    };
    let dimension = unit.map(|unit| &unit.dimension);
    if let Some(dimension) = dimension.or(key.question.dimension.as_ref()) {
        return Some(dimension.clone());
    }
    let known = |name: &str| key.question.dimension_of(name);
    let said = key.reading.content.answer().exprs().into_iter();
    let mut said = said.filter(|e| !e.is_zero() && !e.is_constant());
    said.find_map(|e| dimension::of(e, &known).ok()?)
}

/// A tolerance with a unit as so many of the unit that the expected value is compared in.
pub(super) fn width_of(key: &Key, width: &Quantity) -> Result<Rational, String> {
    let [unit, measures] = [&width.unit_text, &width.unit.dimension.to_string()];
    let Some(asked) = asked(key) else {
        let dimensionless = width.unit.dimension.is_none();
        let why = "and the expected value has no unit";
        return match dimensionless {
            true => Ok(low(&width.value)),
            false => Err(format!("the tolerance is in {unit}, {why}")),
        };
    };
    if asked != width.unit.dimension {
        return Err(format!(
            "the tolerance is in {unit}, which measures {measures}, and {asked} is asked for"
        ));
    }
    let own = match key.reading.content.answer() {
        Content::Quantity(expected) => expected.unit.value(),
        _ => Expr::one(),
    };
    Ok(low(&(&width.value / &own)))
}

/// The lower bound of a constant.
fn low(e: &Expr) -> Rational {
    number::bounds(e).map_or(ratio(0, 1), |[low, _]| low)
}

/// Two quantities with units.
pub(super) fn quantities(ctx: &Context, expected: &Quantity, answer: &Quantity) -> Grade {
    let (asked, given) = (&expected.unit.dimension, &answer.unit.dimension);
    if asked != given {
        let right = scalars(ctx, &expected.value, &answer.value).is_equivalent();
        return wrong(asked, given, &answer.unit_text, right);
    }
    let mut finding = match &ctx.options.tolerance {
        // So many of the unit the expected value is written in.
        Some(Tolerance::Absolute(_)) => {
            let own = &answer.value * &expected.unit.value().powi(-1);
            scalars(ctx, &expected.written, &own)
        }
        // So many digits of the number as it is written.
        Some(Tolerance::Significant(_)) => {
            let own = &expected.value * &answer.unit.value().powi(-1);
            scalars(ctx, &own, &answer.written)
        }
        _ => scalars(ctx, &expected.value, &answer.value),
    };
    let turns = [&expected.unit, &answer.unit].map(|u| (u.cycles, u.angle));
    if let [(true, false), (false, true)] | [(false, true), (true, false)] = turns {
        let words = "Hz counts turns in a second, rad/s radians: one is 2π of the other";
        let hint = "is an angular velocity asked for, or a frequency?";
        let found = Diagnosis::new("UNIT_WRONG", words, hint);
        return Grade::different("DIFF_UNIT", "dimension", words).with(found);
    }
    if finding.is_equivalent() && expected.unit.value() != answer.unit.value() {
        let own = number::shown(&answer.written);
        let own = match own.len() > LONGEST_NUMBER {
            true => "the number in",
            false => &own,
        };
        let (given, unit) = (&answer.unit_text, &expected.unit_text);
        let words = format!("{own} {given} is the same in {unit}");
        let found = Diagnosis::new("UNIT_CONVERTED", words.clone(), words);
        finding.diagnosis.push(found);
    } else if finding.verdict == Verdict::Different
        && scalars(ctx, &expected.written, &answer.written).is_equivalent()
    {
        finding.note = "DIFF_UNIT";
        let words = format!(
            "the number is right for {}, not for {}",
            expected.unit_text, answer.unit_text
        );
        let hint = "check the prefix or scale of your unit";
        let found = Diagnosis::new("UNIT_PREFIX", words, hint);
        finding.diagnosis.insert(0, found);
    }
    finding
}

/// Longest number that is told again, in bytes.
const LONGEST_NUMBER: usize = 16;

fn wrong(asked: &Dimension, given: &Dimension, unit: &str, number_right: bool) -> Grade {
    let words = format!("{unit} measures {given}, and {asked} is asked for");
    let beside = if number_right {
        "; the number is right"
    } else {
        ""
    };
    let message = format!("{words}{beside}");
    let hint = format!("the unit {unit} does not fit what is asked");
    let found = Diagnosis::new("UNIT_WRONG", message, hint);
    Grade::different("DIFF_UNIT", "dimension", words).with(found)
}

/// A number or formula for a quantity with a unit.
pub(super) fn without(ctx: &Context, expected: &Quantity, answer: &Expr) -> Grade {
    // A formula in symbols carries its unit with them.
    if expected.unit.dimension.is_none() || !answer.is_constant() {
        return scalars(ctx, &expected.value, answer);
    }
    if answer.is_zero() && expected.value.is_zero() {
        let words = "zero is zero in any unit; other numbers need theirs";
        let found = Diagnosis::new("UNIT_MISSING", words, MISSING);
        return scalars(ctx, &expected.value, answer).with(found);
    }
    // Zero is zero in any unit: what is wrong with it is no unit.
    if answer.is_zero() {
        return scalars(ctx, &expected.value, answer);
    }
    let right = scalars(ctx, &expected.written, answer).is_equivalent();
    let words = match right {
        true => format!(
            "the number is right, and its unit {} is missing",
            expected.unit_text
        ),
        false => "the unit is missing, and the number is not the expected one".to_string(),
    };
    Grade::told("DIFF_UNIT_MISSING", "dimension", words, MISSING)
}

/// A quantity with a unit for a number or formula.
pub(super) fn with(ctx: &Context, expected: &Expr, answer: &Quantity) -> Grade {
    if answer.unit.dimension.is_none() {
        return scalars(ctx, expected, &answer.value);
    }
    let dimension = ctx.key.question.dimension.clone().or_else(|| {
        dimension::of(expected, &|name| ctx.dimension_of(name))
            .ok()
            .flatten()
    });
    match dimension {
        Some(asked) if asked == answer.unit.dimension && !asked.is_none() => {
            scalars(ctx, expected, &answer.value)
        }
        Some(asked) if !asked.is_none() => {
            wrong(&asked, &answer.unit.dimension, &answer.unit_text, false)
        }
        // Zero is zero in any unit.
        _ if expected.is_zero() && answer.value.is_zero() => scalars(ctx, expected, &answer.value),
        _ => {
            let right = scalars(ctx, expected, &answer.written).is_equivalent();
            extra(&answer.unit_text, right)
        }
    }
}

fn extra(unit: &str, right: bool) -> Grade {
    let words = match right {
        true => format!("a pure number is expected; without {unit} it would be right"),
        false => format!("a pure number is expected, not one in {unit}"),
    };
    let hint = "a unit stands where none is asked";
    Grade::told("DIFF_UNIT_EXTRA", "dimension", words, hint)
}
