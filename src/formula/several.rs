//! Several values or bounds that are said as one: alternatives, lists, sets, intervals and their unions.

use std::ops::Range;

use super::frames::{below_each_other, without_braces};
use super::prose::{Held, lead_to_values};
use super::together::together;
use super::{
    Content, Fault, Join, MAX_BYTES, Reading, Relation, Remark, Symbols, framed, read_either,
};

/// Signs that join two relations.
const LOGIC: [&str; 6] = ["∨", "∧", "\\lor", "\\land", "\\vee", "\\wedge"];

/// Whether a text could hold several values or relations; nearly all hold one.
pub(super) fn is_likely(text: &str, held: Held) -> bool {
    let command = |at: usize| {
        let behind = &text[at..];
        behind.starts_with("\\\\")
            || behind.starts_with("\\{")
            || LOGIC.iter().any(|sign| behind.starts_with(sign))
            || ["\\quad", "\\qquad"]
                .iter()
                .any(|gap| behind.starts_with(gap))
                && text[..at].contains('=')
                && behind.contains('=')
    };
    held.joins()
        || held.any("|:") && held.any("{")
        || held.any("\x01") && text.contains(['∨', '∧', '∈'])
        || held.all("{in") && (text.contains(" in ") || text.contains("\\in"))
        || held.any("\\") && text.match_indices('\\').any(|(at, _)| command(at))
}

/// What says that each of two will do, and that both hold, between relations.
const OR: [&str; 4] = ["or", "∨", "\\vee", "\\lor"];
const AND: [&str; 4] = ["and", "∧", "\\wedge", "\\land"];

/// Most values or bounds of one text.
pub(super) const MOST: usize = 12;

/// Several relations as one content; the only one as it is.
pub(super) fn joined(join: Join, mut parts: Vec<Content>) -> Option<Content> {
    match parts.len() {
        0 => None,
        1 => parts.pop(),
        _ => Some(Content::Joined(join, parts)),
    }
}

/// Whether an end is infinity, and then whether that is the positive one.
pub(super) fn infinity(end: &str) -> Option<bool> {
    let end = end.trim_matches([' ', '$']);
    let size = end.trim_start_matches(['+', '-', '−']).trim_start();
    const NAMES: &str = "∞ \\infty infty inf oo infinity \\infin";
    let mut names = NAMES.split(' ');
    let found = names.any(|name| size.eq_ignore_ascii_case(name));
    found.then_some(!end.starts_with(['-', '−']))
}

/// The signs between the sides of equations and inequalities, as people type them, the longer ones before what they begin with.
const SIGNS: [(&str, Relation); 35] = [
    ("\\leqslant", Relation::LessEqual),
    ("\\leqq", Relation::LessEqual),
    ("\\leq", Relation::LessEqual),
    ("\\le", Relation::LessEqual),
    ("\\lt", Relation::Less),
    ("<=", Relation::LessEqual),
    ("=<", Relation::LessEqual),
    ("<>", Relation::NotEqual),
    ("<", Relation::Less),
    ("≤", Relation::LessEqual),
    ("⩽", Relation::LessEqual),
    ("≦", Relation::LessEqual),
    ("\\geqslant", Relation::GreaterEqual),
    ("\\geqq", Relation::GreaterEqual),
    ("\\geq", Relation::GreaterEqual),
    ("\\ge", Relation::GreaterEqual),
    ("\\gt", Relation::Greater),
    (">=", Relation::GreaterEqual),
    (">", Relation::Greater),
    ("≥", Relation::GreaterEqual),
    ("⩾", Relation::GreaterEqual),
    ("≧", Relation::GreaterEqual),
    ("\\neq", Relation::NotEqual),
    ("\\ne", Relation::NotEqual),
    ("!=", Relation::NotEqual),
    ("≠", Relation::NotEqual),
    ("\\approx", Relation::Approximately),
    ("\\simeq", Relation::Approximately),
    ("\\doteq", Relation::Approximately),
    ("≈", Relation::Approximately),
    ("≃", Relation::Approximately),
    ("==", Relation::Equal),
    (":=", Relation::Equal),
    ("=", Relation::Equal),
    ("≡", Relation::Equal),
];

/// The signs of relation in a text, in order: where each stands, and what it says.
pub(crate) fn relations(text: &str) -> impl Iterator<Item = (Range<usize>, Relation)> {
    let may_begin = |c: char| !c.is_ascii() || "<>=!:\\".contains(c);
    let mut at = 0;
    std::iter::from_fn(move || {
        while let Some(next) = text[at..].find(may_begin) {
            let start = at + next;
            let found = SIGNS.iter().find(|(sign, _)| begins(&text[start..], sign));
            let length = found.map(|(sign, _)| sign.len());
            at = start + length.or(text[start..].chars().next().map(char::len_utf8))?;
            if let Some((_, relation)) = found {
                return Some((start..at, *relation));
            }
        }
        None
    })
}

/// Whether a text begins with a sign; a command of LaTeX goes on as far as its letters.
fn begins(text: &str, sign: &str) -> bool {
    let behind = text.strip_prefix(sign);
    let goes_on = |rest: &str| sign.starts_with('\\') && rest.starts_with(char::is_alphabetic);
    behind.is_some_and(|rest| !goes_on(rest))
}

/// A chain with blanks for an end that is no bound: `-∞ < x < 3`, `\infty > x \ge 3`.
pub(super) fn without_infinity(text: &str, symbols: &Symbols) -> Option<String> {
    let mut found = relations(text).filter(|(_, sign)| sign.is_order());
    let ((first, sign), (last, other)) = (found.next()?, found.next()?);
    let less = sign.is_below();
    if found.next().is_some() || less != other.is_below() || symbols.find("inf").is_some() {
        return None;
    }
    let low = infinity(&text[..first.start]).is_some_and(|positive| positive != less);
    let high = infinity(&text[last.end..]).is_some_and(|positive| positive == less);
    let (start, stop) = match (low, high) {
        (true, false) => (first.end, text.len()),
        (false, true) => (0, last.start),
        _ => return None,
    };
    Some(format!(
        "{:start$}{}",
        "",
        &text[start..stop].replace('$', " ")
    ))
}

/// A text with blanks between the letters of declared names that could be products of declared letters, `m u` for `mu`;
/// nothing where there are none.
pub(crate) fn letters_apart(text: &str, symbols: &Symbols) -> Option<String> {
    let letter = |c: char| symbols.find(c.encode_utf8(&mut [0; 4])).is_some();
    let product =
        |name: &&str| name.len() > 1 && name.chars().all(|c| c.is_ascii_alphabetic() && letter(c));
    let names = symbols.declared().iter().map(|d| &*d.name);
    let mut out = text.to_string();
    for name in names.filter(product) {
        let letters: Vec<String> = name.chars().map(String::from).collect();
        let mut from = 0;
        while let Some(at) = out[from..].find(name).map(|at| from + at) {
            let end = at + name.len();
            let command = out[..at].ends_with(|c: char| c == '\\' || c.is_ascii_alphabetic());
            let alone = !command && !out[end..].starts_with(|c: char| c.is_ascii_alphabetic());
            from = end;
            if alone {
                out.replace_range(at..end, &letters.join(" "));
                from += name.len() - 1;
            }
        }
    }
    (out != text).then_some(out)
}

/// Where the parts of a list end and the next begin: `x = 3 or x = -3`, `2, -2`. In a set any comma parts them.
fn gaps(text: &str, set: bool) -> Vec<(usize, usize)> {
    const WORDS: &str = "∨|∧|\\lor|\\land|\\vee|\\wedge|\\text{ or }|\\text{or}|\\mathrm{or}| or |\
        \\text{ and }|\\text{and}| and |\\quad|\\qquad|\\\\|; ";
    let mut found: Vec<(usize, usize)> = Vec::new();
    let mut depth = 0i32;
    let mut at = 0;
    let semicolons = text.contains(';');
    let begins = |c: char| c.is_alphabetic() || " \\-−±".contains(c);
    while let Some(c) = text[at..].chars().next() {
        // A space of LaTeX, and no semicolon.
        if text[at..].starts_with("\\;") {
            at += 2;
            continue;
        }
        let word = WORDS.split('|').find(|word| text[at..].starts_with(word));
        let length = match (word, c) {
            (Some(word), _) if depth == 0 => word.len(),
            // Behind a comma a sign or a name begins another value: `3,-3`, `x=1,y=2`.
            (None, ',')
                if depth == 0
                    && !text[at + 1..].starts_with("\\!")
                    && (set && !semicolons || text[at + 1..].starts_with(begins)) =>
            {
                1
            }
            (None, ';') if depth == 0 && set => 1,
            _ => 0,
        };
        if length > 0 {
            match found.last_mut() {
                // `2, 3, and 4`
                Some((_, end)) if text[*end..at].trim().is_empty() => *end = at + length,
                _ => found.push((at, at + length)),
            }
            at += length;
            continue;
        }
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            _ => {}
        }
        at += c.len_utf8();
    }
    let inside = |(start, end): &(usize, usize)| {
        !text[..*start].trim().is_empty() && !text[*end..].trim().is_empty()
    };
    match found.iter().all(inside) {
        true => found,
        false => Vec::new(),
    }
}

/// One of several parts: a formula or a relation, or several that `and` or brackets hold together.
fn part(text: &str, [from, to]: [usize; 2], symbols: &Symbols) -> Option<Reading> {
    let inside = text[from..to].trim();
    if !gaps(inside, false).is_empty()
        && let Some(Ok(several)) = values(&format!("{:from$}{inside}", ""), symbols)
    {
        return Some(several);
    }
    let bracketed = || {
        let inside = inside.strip_prefix('(')?.strip_suffix(')')?;
        let relates = inside.contains(['<', '>', '=', '≤', '≥', '≠']);
        let at = from + 1;
        let text = relates.then(|| format!("{:at$}{inside}", ""))?;
        part(&text, [at, text.len()], symbols)
    };
    // `$v_1 = 3$ m/s`
    let undressed = || {
        let text = inside.contains('$').then(|| inside.replace('$', " "))?;
        read_either(&format!("{:from$}{text}", ""), from, symbols, 0).ok()
    };
    read_either(&text[..to], from, symbols, 0)
        .ok()
        .or_else(bracketed)
        .or_else(undressed)
}

/// Values with blanks for words that lead to them, byte for byte: `The solutions are 1 and 2`, `x is 1 or 2`.
fn behind_words(text: &str, known: &dyn Fn(&str) -> bool) -> Option<String> {
    if let Some((name, values)) = text.split_once(" is ")
        && name.starts_with(char::is_alphabetic)
        && name.chars().all(|c| c.is_alphanumeric() || c == '_')
        && (known(name)
            || name
                .split('_')
                .next()
                .is_some_and(|base| base.chars().count() == 1))
    {
        return Some(format!("{name} =  {values}"));
    }
    let at = lead_to_values(text, known)?;
    Some(format!("{:at$}{}", "", &text[at..]))
}

/// `x = 3 or x = -3`, `2, -2` and `{1, 2, 3}` as values of which each will do; `x > 1 and x < 3` as a chain; other relations
/// joined by a word, and values of several names, as they are.
pub(super) fn values(text: &str, symbols: &Symbols) -> Option<Result<Reading, Fault>> {
    if text.len() > MAX_BYTES {
        return None;
    }
    let (start, stop) = framed(text);
    let set = without_braces(&text[start..stop]);
    let list = set.is_some();
    let known = |word: &str| symbols.find(word).is_some();
    let plain = set
        .or_else(|| below_each_other(&text[start..stop]))
        .or_else(|| behind_words(&text[start..stop], &known));
    let plain = plain.map(|plain| format!("{:start$}{plain}", ""));
    let (text, stop) = plain
        .as_ref()
        .map_or((text, stop), |plain| (plain, plain.len()));
    let mut gaps = gaps(&text[start..stop], list);
    // `and` binds tighter than `or`.
    let joins = |gap: &(usize, usize), signs: &[&str]| {
        let gap = &text[start + gap.0..start + gap.1];
        signs.iter().any(|sign| gap.contains(*sign))
    };
    if gaps.iter().any(|gap| joins(gap, &AND)) && gaps.iter().any(|gap| joins(gap, &OR)) {
        gaps.retain(|gap| joins(gap, &OR));
    }
    // So does a comma between equations for several names; semicolons may part such groups.
    let mut alternatives = false;
    if let Some((pieces, several)) = equated(&text[start..stop], &gaps) {
        let has = |sign: &[&str]| gaps.iter().any(|gap| joins(gap, sign));
        if has(&OR) {
            gaps.retain(|gap| joins(gap, &OR));
        } else if has(&[";"]) && has(&[","]) && several {
            gaps.retain(|gap| joins(gap, &[";"]));
            alternatives = true;
        } else if !several && pieces.iter().filter(|piece| has_either_sign(piece)).count() > 1 {
            return in_either_sign(&text[..stop], symbols);
        }
    }
    if list && gaps.is_empty() {
        let one = read_either(&text[..stop], start, symbols, 0).ok();
        return one
            .filter(|one| matches!(one.content, Content::Relations(..)))
            .map(Ok);
    }
    if gaps.is_empty() || symbols.find("or").is_some() || symbols.find("and").is_some() {
        return None;
    }
    let mut from = start;
    let mut parts = Vec::new();
    let last = [(stop - start, stop - start)];
    for (end, next) in gaps.iter().chain(&last).take(MOST + 1) {
        let strict = part(text, [from, start + end], symbols)?;
        let letters = strict.notes.iter().any(|n| n.remark == Remark::Letters);
        if letters || super::word_inside(text, symbols, &strict).is_some() {
            return None;
        }
        parts.push(strict);
        from = start + next;
    }
    if parts.len() > MOST {
        let (first, second) = gaps[0];
        let what = format!("at most {MOST} values or bounds are read");
        return Some(Err(*Fault::new(what, start + first, start + second)));
    }
    let notes = parts
        .iter()
        .flat_map(|part| part.notes.iter().cloned())
        .collect();
    let between = |signs: &[&str]| gaps.iter().any(|gap| joins(gap, signs));
    let said = match alternatives || between(&OR) {
        true => Some(Join::Or),
        false => between(&AND).then_some(Join::And),
    };
    let (content, unit) = together(&parts, said)?;
    // Lines hold results with their names; `a\\b` is a slip of the pen.
    let lines = between(&["\\\\"]);
    // Between vectors ∧ is a product.
    if between(&LOGIC)
        && parts
            .iter()
            .any(|part| !matches!(part.content, Content::Relations(..)))
    {
        return None;
    }
    if lines && !matches!(content, Content::Joined(..)) {
        return None;
    }
    Some(Ok(Reading {
        content,
        written: parts.into_iter().flat_map(|part| part.written).collect(),
        literal: None,
        unit,
        notes,
        choices: 0,
        slashes: false,
    }))
}

/// The pieces between gaps where each is an equation and not all are for the same, and whether several are for the same.
fn equated<'a>(text: &'a str, gaps: &[(usize, usize)]) -> Option<(Vec<&'a str>, bool)> {
    let starts = std::iter::once(0).chain(gaps.iter().map(|gap| gap.1));
    let ends = gaps.iter().map(|gap| gap.0).chain([text.len()]);
    let pieces: Vec<&str> = starts.zip(ends).map(|(from, to)| &text[from..to]).collect();
    let left = |piece: &&str| {
        let (left, right) = piece.split_once('=')?;
        let is_plain = !right.contains('=') && !left.ends_with(['<', '>', '!']);
        is_plain.then(|| left.trim_matches([' ', '$']).to_owned())
    };
    let mut names: Vec<String> = pieces.iter().map(left).collect::<Option<_>>()?;
    let all = names.len();
    names.sort();
    names.dedup();
    (names.len() > 1).then_some((pieces, names.len() < all))
}

/// Signs of which the upper or the lower one is meant, and each of the two.
const EITHER_SIGN: [(&str, [&str; 2]); 4] = [
    ("\\pm", ["+", "-"]),
    ("\\mp", ["-", "+"]),
    ("±", ["+", "-"]),
    ("∓", ["-", "+"]),
];

/// A text with the upper or the lower one of such signs, as long as before so that places in it stay.
fn in_one_sign(text: &str, which: usize) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let is_here = |sign: &str| {
            let behind = rest.strip_prefix(sign)?;
            let goes_on = behind.starts_with(|c: char| c.is_ascii_alphabetic());
            (!sign.starts_with('\\') || !goes_on).then_some(behind)
        };
        let mut signs = EITHER_SIGN.iter();
        let found = signs.find_map(|(sign, each)| Some((sign.len(), each, is_here(sign)?)));
        rest = match found {
            Some((length, each, behind)) => {
                out.extend(std::iter::repeat_n(' ', length - 1));
                out.push_str(each[which]);
                behind
            }
            None => {
                out.push(c);
                &rest[c.len_utf8()..]
            }
        };
    }
    out
}

fn has_either_sign(piece: &str) -> bool {
    in_one_sign(piece, 0) != *piece
}

/// Results for several names with upper and lower signs: the upper ones go together, and the lower ones.
fn in_either_sign(text: &str, symbols: &Symbols) -> Option<Result<Reading, Fault>> {
    let read = |which: usize| values(&in_one_sign(text, which), symbols)?.ok();
    let (upper, lower) = (read(0)?, read(1)?);
    let both = vec![upper.content.clone(), lower.content];
    Some(Ok(upper.with(Content::Joined(Join::Or, both))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sign_is_found_where_it_stands_and_read_as_what_it_says() {
        for (sign, relation) in SIGNS {
            let text = format!("a {sign} b");
            let found: Vec<_> = relations(&text).collect();
            assert_eq!(found, [(2..2 + sign.len(), relation)], "{sign}");
            let mut symbols = Symbols::strict();
            ["a", "b"].iter().for_each(|name| symbols.declare(name));
            let read = super::super::read(&text, &symbols).expect(sign);
            match read.content {
                Content::Relations(_, signs) => assert_eq!(signs, [relation], "{sign}"),
                other => panic!("{sign}: {other:?}"),
            }
        }
        let none = relations("\\left( a \\geometry b \\right)").next();
        assert_eq!(none, None);
        let row: Vec<_> = relations("w = 2 \\le 3 ≈ x").map(|(at, _)| at).collect();
        assert_eq!(row, [2..3, 6..9, 12..15]);
    }
}
