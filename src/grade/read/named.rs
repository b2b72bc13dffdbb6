//! Names that an answer gives to its parts, or leaves out: values in the order of what is asked, and names of its own that are
//! said behind the formula.

use std::collections::BTreeMap;

use super::super::Key;
use super::declared;
use crate::expr::{Expr, Symbol};
use crate::formula::{self, Content, Join, Reading, Relation, Remark, Symbols};

/// Values of several kinds with the names of what is asked, in this order: `3 m/s, 30°` and `3 m/s at 30°` for
/// `v = 3 m/s, θ = 30°`.
pub(super) fn named_in_order(key: &Key, text: &str) -> Option<String> {
    const WORDS: [&str; 4] = [" at an angle of ", " at ", " and ", "; "];
    let Content::Joined(Join::And, asked) = &key.reading.content else {
        return None;
    };
    let text = WORDS
        .iter()
        .fold(text.to_string(), |text, word| text.replace(word, ", "));
    let given: Vec<&str> = text.split(", ").collect();
    let name = |part: &Content| match part {
        Content::Relations(sides, signs) if signs == &[Relation::Equal] => sides[0].name().cloned(),
        _ => None,
    };
    let names: Vec<Symbol> = asked.iter().map(name).collect::<Option<_>>()?;
    if names.len() != given.len() || text.contains('=') {
        return None;
    }
    let named = names.iter().zip(given);
    let named: Vec<String> = named
        .map(|(name, value)| format!("{name} = {value}"))
        .collect();
    Some(named.join(", "))
}

/// Most names that an answer says behind its formula.
const MOST_DEFINITIONS: usize = 8;

/// Whether a text is a number, with or without a unit.
fn is_number(text: &str) -> bool {
    formula::read(text, &Symbols::strict())
        .is_ok_and(|reading| matches!(reading.content, Content::Scalar(_) | Content::Quantity(_)))
}

/// A formula with names of its own that are said behind it: `m d v/I where I = M l^2/3 + m d^2`; or before it,
/// `I = M l²/3 ⇒ ω = L/I`.
pub(super) fn with_definitions(key: &Key, text: &str) -> Option<Reading> {
    let text = text.replace(",\\ ", ", ").replace(",\\quad", ", ");
    let text = text.as_str();
    let several = matches!(key.reading.content, Content::Joined(..));
    said_behind(key, text)
        .or_else(|| said_behind(key, &definitions_last(text).filter(|_| !several)?))
}

/// A text that begins with what names are, with the statement at its end put first: each of them is an equation for a name.
fn definitions_last(text: &str) -> Option<String> {
    const SIGNS: &str = "\\Longrightarrow|\\Rightarrow|\\implies|⟹|⇒|=>|, so |, hence |, thus | so | hence | thus |; | and ";
    let equation = text.contains('=') && text.len() <= LONGEST;
    let plain = equation.then(|| {
        let signs = SIGNS.split('|');
        signs.fold(text.to_string(), |text, sign| text.replace(sign, ", "))
    })?;
    let pieces: Vec<&str> = plain
        .split(", ")
        .map(|piece| piece.trim_matches([' ', '$', ',']))
        .collect();
    let (last, before) = pieces.split_last()?;
    let defines = |piece: &&str| {
        let sides: Vec<&str> = piece.split('=').map(str::trim).collect();
        matches!(sides[..], [name, _] if !name.contains([' ', '+', '*', '/', '(', '<', '>', '^', '²']))
    };
    let all = !before.is_empty() && before.iter().all(defines) && last.matches('=').count() < 2;
    all.then(|| format!("{last}, {}", before.join(", ")))
}

/// Longest text, in bytes, in which names are looked for that are said before the formula.
const LONGEST: usize = 2_000;

fn said_behind(key: &Key, text: &str) -> Option<Reading> {
    const WORDS: &str =
        " where | with | mit | wobei |\\text{where}|\\text{ where }|\\text{with}|\\text{ with }";
    let found = WORDS.split('|');
    let found = found.filter_map(|word| Some((text.find(word)?, word.len())));
    // `½ μ v², μ = …` and `½ μ v² (μ = …)`
    let names = |sign: &str, at: usize| {
        let (name, _) = text[at + sign.len()..].split_once('=')?;
        (!name.trim().contains(' ')).then_some((at, sign.len()))
    };
    let behind = |sign: &str| {
        let mut places = text.match_indices(sign).take(MOST_DEFINITIONS);
        places.find_map(|(at, _)| names(sign, at))
    };
    let apart = || behind(", ").or_else(|| behind(" ("));
    let said_so = found.min();
    let (at, length) = said_so.or_else(apart)?;
    let formula = text[..at]
        .trim_end_matches([' ', ',', ';', '$'])
        .trim_start_matches('$');
    let said = &text[at + length..];
    let said = match text[at..].starts_with(" (") {
        true => said.strip_suffix(')')?,
        false => said,
    };
    let said = said.replace(" and ", ", ").replace(';', ",");
    let mut symbols = key.readable.clone();
    let (mut parts, mut told) = (Vec::new(), Vec::new());
    for part in said.split(", ") {
        let Some((name, value)) = part.trim_matches([' ', '$', '.']).split_once('=') else {
            // `and v_0 is the speed before`
            part.contains(" is ").then_some(())?;
            continue;
        };
        // `I = m l^2/3 is its moment of inertia`
        let value = value.split(" is ").next().unwrap_or(value);
        let name = formula::read(name, &Symbols::open()).ok()?;
        let name = name.content.name()?.clone();
        // `m g, where g = 9.8 m/s²`: the value of a name of the question, which nobody asked for.
        if said_so.is_some() && declared(key, &name) && is_number(value) {
            told.push(name);
            continue;
        }
        let twice = parts.iter().any(|(other, _)| *other == name);
        if declared(key, &name) || twice || value.contains('=') || parts.len() == MOST_DEFINITIONS {
            return None;
        }
        symbols.declare(&name);
        parts.push((name, value.to_string()));
    }
    let value = |(name, text): (Symbol, String)| {
        let value = formula::read(&text, &symbols).ok()?;
        let split = value.notes.iter().any(|n| n.remark == Remark::Letters);
        Some((name, value.content.expr().filter(|_| !split)?.clone()))
    };
    let values: BTreeMap<Symbol, Expr> = parts.into_iter().map(value).collect::<Option<_>>()?;
    let mut reading = formula::read(formula, &symbols).ok()?;
    let mut names = values.keys().chain(&told);
    let used = names.any(|name| reading.symbols().contains(name));
    // `x = 2, x = 3` are two values of x, and `m v = 2 m u, u = v/2` solves an equation, unless that is about what is asked for:
    // `I ω = L, I = m l²/3`.
    let sought = key.reading.content.relations();
    let sought = sought.and_then(|(sides, _)| sides[0].name());
    let asked = key.question.asked.iter().map(|given| &given.name);
    let sought = sought
        .into_iter()
        .chain(asked)
        .any(|name| reading.symbols().contains(name));
    let defined = match &reading.content {
        Content::Relations(sides, _) => match sides[0].name() {
            Some(name) => values.contains_key(name),
            None => said_so.is_none() && !sought,
        },
        _ => false,
    };
    if !used || defined || reading.unit.is_some() {
        return None;
    }
    // One definition may use another.
    for _ in 0..values.len() {
        reading.content = reading.content.map(&|e| e.substitute(&values));
    }
    // Places in this text are not those of the whole.
    reading.choices = 0;
    reading.slashes = false;
    reading.notes.clear();
    let own = |name: &Symbol| values.contains_key(name);
    (!reading.symbols().iter().any(own)).then_some(reading)
}
