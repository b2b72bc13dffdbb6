//! Bounds in words, and behind a sign that begins an answer: `at least 3 m/s`, `v must exceed 2`, `between 0 and 1`, `≥ 3`.

use super::sets::UNNAMED;
use super::together::together;
use super::{Content, Join, Note, Reading, Relation, Remark, Symbols, prose, read_either};
use crate::expr::Expr;

/// What stands before a bound, by its relation: `no more than` comes before `more than`, which is a part of it.
const BEFORE: Phrases = [
    (
        Relation::GreaterEqual,
        "greater than or equal to|no less than|not less than|no smaller than|not smaller than|at least|\\geq|\\ge",
    ),
    (
        Relation::LessEqual,
        "less than or equal to|no more than|not more than|no greater than|not greater than|no larger than|not larger than|\
         at most|up to|\\leq|\\le",
    ),
    (
        Relation::Greater,
        "greater than|larger than|bigger than|more than|above|exceeds|exceed|\\gt",
    ),
    (Relation::Less, "less than|smaller than|below|\\lt"),
];

/// Signs that may begin an answer.
const SIGNS: Phrases = [
    (Relation::GreaterEqual, ">=|≥"),
    (Relation::LessEqual, "<=|≤"),
    (Relation::Greater, ">"),
    (Relation::Less, "<"),
];

/// What stands behind a bound.
const BEHIND: [(Relation, &str); 2] = [
    (Relation::GreaterEqual, " or more| or greater| or above"),
    (Relation::LessEqual, " or less| or smaller| or below"),
];

type Phrases = [(Relation, &'static str); 4];

/// The phrases one by one, each with its relation.
fn each(phrases: &[(Relation, &'static str)]) -> impl Iterator<Item = (&'static str, Relation)> {
    let all = phrases.iter();
    all.flat_map(|(sign, words)| words.split('|').map(|word| (word, *sign)))
}

/// Bounds in words as relations, of what is named before them or of what was asked; nothing where a word could change what is
/// said. A range between two values is without its ends, one from a value to another with them.
pub(super) fn in_words(text: &str, symbols: &Symbols) -> Option<Reading> {
    let small = text.to_ascii_lowercase();
    let words = Words { text, symbols };
    let mut parts = Vec::new();
    let ranges = [
        ("between", " and ", Relation::Less),
        ("from", " to ", Relation::LessEqual),
    ];
    let range = ranges
        .into_iter()
        .find_map(|(first, second, sign)| Some((place(&small, first)?, first.len(), second, sign)));
    if let Some((at, length, second, sign)) = range {
        let from = at + length;
        let middle = from + small[from..].find(second)?;
        let low = words.value(from, middle)?;
        let mut high = words.value(middle + second.len(), text.len())?;
        let name = words.subject(0, at)?.unwrap_or_else(unnamed);
        let sides = vec![low.content, name, high.content];
        high.content = Content::Relations(sides, vec![sign; 2]).with_shared_unit();
        if sign == Relation::Less {
            high.notes.push(Note {
                remark: Remark::Between,
                start: at,
                middle: from,
                end: text.trim_end().len(),
            });
        }
        high.literal = None;
        return Some(high);
    }
    let mut from = 0;
    let (mut name, mut worded) = (None, false);
    while from < text.len() {
        let ends = [" and ", " but "].iter().filter_map(|word| {
            let at = from + small[from..].find(word)?;
            Some((at, at + word.len()))
        });
        let (to, next) = ends.min().unwrap_or((text.len(), text.len()));
        let (mut reading, subject) = words.bound(&small, from, to)?;
        name = subject.or(name);
        if let Content::Relations(sides, _) = &mut reading.content
            && sides[0] == unnamed()
        {
            worded = true;
            sides[0] = name.clone().unwrap_or_else(unnamed);
        }
        parts.push(reading);
        from = next;
    }
    if !worded {
        return None;
    }
    let content = match parts.as_slice() {
        [only] => only.content.clone(),
        _ => together(&parts, Some(Join::And))?.0,
    };
    let mut reading = parts.pop()?;
    reading.content = content;
    reading.literal = None;
    Some(reading)
}

/// What was asked, without its name.
fn unnamed() -> Content {
    Content::Scalar(Expr::symbol(UNNAMED))
}

/// Where a phrase stands as words of their own.
fn place(small: &str, phrase: &str) -> Option<usize> {
    let apart = |at: &usize| {
        let behind = &small[at + phrase.len()..];
        (*at == 0 || small[..*at].ends_with([' ', '$'])) && behind.starts_with([' ', '\\', '$'])
    };
    small.match_indices(phrase).map(|(at, _)| at).find(apart)
}

struct Words<'a> {
    text: &'a str,
    symbols: &'a Symbols,
}

impl Words<'_> {
    /// A value between two places.
    fn value(&self, from: usize, to: usize) -> Option<Reading> {
        let reading = read_either(&self.text[..to], from, self.symbols, 0).ok()?;
        let plain = matches!(reading.content, Content::Scalar(_) | Content::Quantity(_));
        let split = reading.notes.iter().any(|n| n.remark == Remark::Letters);
        (plain && !split).then_some(reading)
    }

    /// One bound, with a gap for its subject, and that.
    fn bound(&self, small: &str, from: usize, to: usize) -> Option<(Reading, Option<Content>)> {
        let part = &small[from..to];
        let before = || {
            each(&BEFORE)
                .find_map(|(phrase, sign)| Some((place(part, phrase)?, phrase.len(), sign)))
        };
        let signed = || {
            let start = part.len() - part.trim_start_matches([' ', '$']).len();
            let (text, sign) = each(&SIGNS).find(|(sign, _)| part[start..].starts_with(sign))?;
            Some((start, text.len(), sign))
        };
        let behind = || {
            let said = part.trim_end_matches([' ', '.']);
            each(&BEHIND).find_map(|(word, sign)| Some((said.strip_suffix(word)?, sign)))
        };
        let (subject, mut reading, sign) = match before().or_else(signed) {
            Some((at, length, sign)) => (
                self.subject(from, from + at)?,
                self.value(from + at + length, to)?,
                sign,
            ),
            None => match behind() {
                Some((said, sign)) => (None, self.value(from, from + said.len())?, sign),
                // `n > 3 and at most 5`
                None => {
                    let reading = read_either(&self.text[..to], from, self.symbols, 0).ok()?;
                    let (sides, _) = reading.content.relations()?;
                    let subject = sides[0].clone();
                    return Some((reading, Some(subject)));
                }
            },
        };
        reading.content = Content::Relations(vec![unnamed(), reading.content], vec![sign]);
        Some((reading, subject))
    }

    /// What is bounded: the name before a verb, or nothing where words alone stand there.
    fn subject(&self, from: usize, to: usize) -> Option<Option<Content>> {
        const VERBS: &str = "is are be must has have to should needs need can may always lies lie";
        let mut said = self.text[from..to].trim_end_matches([' ', '$']);
        while let Some(word) = said.rsplit(' ').next()
            && !word.is_empty()
            && VERBS.split(' ').any(|verb| verb.eq_ignore_ascii_case(word))
            && self.symbols.find(word).is_none()
        {
            said = said[..said.len() - word.len()].trim_end();
        }
        if said.trim().is_empty() {
            return Some(None);
        }
        let last = from + said.rfind(' ').map_or(0, |at| at + 1);
        if let Some(reading) = self.value(from, from + said.len()) {
            return Some(Some(reading.content));
        }
        let word = |word: &str| word.bytes().all(|b| b.is_ascii_alphabetic());
        if said.split(' ').any(prose::changes) {
            return None;
        }
        let ended = &said[last - from..];
        if self.symbols.find(ended).is_some() && said[..last - from].split(' ').all(word) {
            return self
                .value(last, last + ended.len())
                .map(|r| Some(r.content));
        }
        said.split(' ').all(word).then_some(None)
    }
}
