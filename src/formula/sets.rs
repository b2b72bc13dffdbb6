//! Sets of numbers: intervals, single values, their unions, and what is left out of one.

use super::several::{MOST, infinity, joined};
use super::{Content, Join, Reading, Relation, Symbols, framed, plain_unit, read_either};
use crate::dimension;
use crate::expr::Expr;

/// What lies in an interval that is written without a name, `[0, 1)`.
pub(crate) const UNNAMED: &str = "·";

/// `x ∈ [2, 3)`, `x in (0, ∞)`, `x ∈ (−∞, 1) ∪ (2, 3]` and `[0, 1)` as the relations they stand for; without a name only what
/// could be no vector, unless `pairs` are intervals too.
pub(super) fn interval(text: &str, symbols: &Symbols, pairs: bool) -> Option<Reading> {
    const SIGNS: [&str; 6] = ["∈", "\\in ", "\\in\\", "\\in(", "\\in[", " in "];
    let (mut start, mut stop) = framed(text);
    let plain = |c: char| c.is_whitespace() || c == '$';
    start = stop - text[start..stop].trim_start_matches(plain).len();
    stop = start
        + text[start..stop]
            .trim_end_matches(|c| plain(c) || c == '.')
            .len();
    let signed = |sign: &&'static str| Some((start + text[start..stop].find(*sign)?, *sign));
    let sign = SIGNS.iter().find_map(signed);
    // What opens the interval stands behind the word.
    let behind = sign.map(|(at, sign)| at + sign.trim_end_matches(['\\', '(', '[']).len());
    // `[2, 5] m`: the unit of both ends.
    let close = start + text[start..stop].rfind([')', ']', '[', '}'])? + 1;
    let behind_it = plain_unit(&text[close..stop]).filter(|plain| !plain.trim().is_empty());
    let unit = behind_it.and_then(|plain| Some((dimension::unit(&plain).ok()?, plain)));
    stop = if unit.is_some() { close } else { stop };
    let part = |[from, to]: [usize; 2]| {
        let read = read_either(&text[..to], from, symbols, 0).ok();
        let mut read = read.filter(|reading| {
            matches!(reading.content, Content::Scalar(_) | Content::Quantity(_))
        })?;
        if let Some((unit, plain)) = &unit {
            read.content = read.content.in_unit(unit, plain.trim());
        }
        Some(read)
    };
    let pieces = pieces(text, [behind.unwrap_or(start), stop]);
    if pieces.len() > MOST {
        return None;
    }
    // What is in several sets at once: each of a union is the sets that meet in it.
    let met = |whole: &[usize; 2]| -> Option<Vec<Piece>> {
        let parts = parts(text, *whole, &["∩", "\\cap", "\\bigcap"], &[]);
        parts
            .into_iter()
            .map(|part| Piece::of(text, part))
            .collect()
    };
    let pieces: Vec<Vec<Piece>> = pieces.iter().map(met).collect::<Option<_>>()?;
    if let [only] = pieces.as_slice()
        && let [piece] = only.as_slice()
        && !piece.is_set(sign.is_some() || pairs)
    {
        return None;
    }
    let (name, mut reading) = match sign {
        Some((at, _)) => {
            let name = part([start, at])?;
            (name.content.clone(), name)
        }
        None => {
            let end = pieces.iter().flatten().flat_map(Piece::values).next()?;
            (Content::Scalar(Expr::symbol(UNNAMED)), part(end)?)
        }
    };
    let mut cases = Vec::new();
    for met in &pieces {
        let of = |piece: &Piece| piece.cases(&name, &|at| Some(part(at)?.content));
        match met.as_slice() {
            [piece] => cases.extend(of(piece)?),
            all => {
                let each = all.iter().map(|piece| joined(Join::Or, of(piece)?));
                cases.push(joined(Join::And, each.collect::<Option<_>>()?)?);
            }
        }
    }
    reading.content = joined(Join::Or, cases)?;
    reading.literal = None;
    Some(reading)
}

/// A part of a union: an interval, values one by one, or either without some values. Each place goes from the first byte to the
/// one behind.
#[derive(Default)]
struct Piece {
    /// Nothing where there are values, or where it is all numbers.
    ends: Option<Ends>,
    single: Vec<[usize; 2]>,
    without: Vec<[usize; 2]>,
}

impl Piece {
    fn of(text: &str, [from, stop]: [usize; 2]) -> Option<Piece> {
        if let Some(ends) = ends(text, [from, stop]) {
            return Some(Piece {
                ends: Some(ends),
                ..Piece::default()
            });
        }
        let (before, values) = values(text, [from, stop])?;
        let named = text[from..before].trim();
        if named.is_empty() {
            return Some(Piece {
                single: values,
                ..Piece::default()
            });
        }
        const LESS: [&str; 6] = ["\\setminus", "\\backslash", "∖", "\\", "-", "−"];
        let of = LESS.iter().find_map(|sign| named.strip_suffix(sign))?;
        let of = of.trim_end();
        let reals = ["ℝ", "\\mathbb{R}", "\\mathbb R", "\\R"].contains(&of);
        let first = before - text[from..before].trim_start().len();
        let ends = match reals {
            true => None,
            false => Some(ends(text, [from, first + of.len()])?),
        };
        Some(Piece {
            ends,
            single: Vec::new(),
            without: values,
        })
    }

    /// Whether it is a set where it stands alone: `(0, 1)` may be a vector, and values in braces are a list.
    fn is_set(&self, pairs: bool) -> bool {
        let pair = self.ends.as_ref().is_some_and(|ends| ends.may_be_pair);
        self.single.is_empty() && (pairs || !pair || !self.without.is_empty())
    }

    /// Where its numbers stand.
    fn values(&self) -> impl Iterator<Item = [usize; 2]> {
        let ends = self.ends.iter().flat_map(|ends| [ends.low, ends.high]);
        let others = self.single.iter().chain(&self.without).copied();
        ends.flatten().chain(others)
    }

    /// What it says of a name, one case each.
    fn cases(
        &self,
        name: &Content,
        part: &dyn Fn([usize; 2]) -> Option<Content>,
    ) -> Option<Vec<Content>> {
        let link = |at: &[usize; 2], sign: Relation| {
            let sides = vec![name.clone(), part(*at)?];
            Some(Content::Relations(sides, vec![sign]))
        };
        if !self.single.is_empty() {
            let each = self.single.iter().map(|at| link(at, Relation::Equal));
            return each.collect();
        }
        let mut sides = vec![name.clone()];
        let mut signs = Vec::new();
        let strict = |open: bool| match open {
            true => Relation::Less,
            false => Relation::LessEqual,
        };
        if let Some(ends) = &self.ends {
            if let Some(low) = ends.low {
                sides.insert(0, part(low)?);
                signs.push(strict(ends.open[0]));
            }
            if let Some(high) = ends.high {
                sides.push(part(high)?);
                signs.push(strict(ends.open[1]));
            }
        }
        let mut all: Vec<Content> = Vec::new();
        all.extend((!signs.is_empty()).then_some(Content::Relations(sides, signs)));
        for at in &self.without {
            all.push(link(at, Relation::NotEqual)?);
        }
        Some(vec![joined(Join::And, all)?])
    }
}

/// Values in braces at the end of a text: where the braces begin, and the place of each.
fn values(text: &str, [from, stop]: [usize; 2]) -> Option<(usize, Vec<[usize; 2]>)> {
    let piece = text[from..stop].trim_end();
    let inside = piece.strip_suffix('}')?;
    let open = inside.rfind('{')?;
    let mut before = open;
    let escaped = inside.strip_suffix('\\');
    let escaped_end = inside.strip_suffix("\\right\\");
    if escaped.is_some() {
        before = piece[..open].strip_suffix('\\')?.len();
        let left = piece[..before].strip_suffix("\\left");
        before = left
            .filter(|_| escaped_end.is_some())
            .map_or(before, str::len);
    }
    let close = escaped_end.or(escaped).map_or(inside.len(), str::len);
    let mut at = from + open + 1;
    let mut out = Vec::new();
    for value in text.get(at..from + close)?.split([',', ';']) {
        if value.trim().is_empty() {
            return None;
        }
        out.push([at, at + value.len()]);
        at += value.len() + 1;
    }
    Some((from + before, out))
}

/// Whether a text could leave values out of a set: `ℝ \ {2}`.
pub(super) fn leaves_out(text: &str) -> bool {
    let text = text.trim_start_matches([' ', '$']);
    let reals = ["ℝ", "\\mathbb{R}", "\\mathbb R", "\\R"];
    let begins = reals.iter().any(|set| text.starts_with(set)) || text.contains("\\setminus");
    let within = reals.iter().any(|set| text.contains(set)) && text.contains(['∈']);
    begins || within || text.contains("\\in")
}

/// The parts of a union of sets.
fn pieces(text: &str, within: [usize; 2]) -> Vec<[usize; 2]> {
    parts(text, within, &["∪", "\\cup", "\\bigcup"], &["U", "u", "or"])
}

/// The parts of a text between signs, or words between brackets.
fn parts(text: &str, [from, stop]: [usize; 2], signs: &[&str], words: &[&str]) -> Vec<[usize; 2]> {
    let mut out = Vec::new();
    let mut start = from;
    loop {
        let rest = &text[start..stop];
        // A letter or a word joins two intervals where it stands between their brackets.
        let between = |word: &str, at: usize| {
            let closed = rest[..at].trim_end().ends_with([')', ']', '[', '}']);
            closed
                && rest[at + word.len()..]
                    .trim_start()
                    .starts_with(['(', ']', '[', '{'])
        };
        let word = |word: &str| {
            let mut found = rest.match_indices(word).map(|(at, _)| at);
            Some((found.find(|at| between(word, *at))?, word.len()))
        };
        let sign = signs
            .iter()
            .filter_map(|sign| Some((rest.find(sign)?, sign.len())));
        let sign = sign.chain(words.iter().filter_map(|name| word(name))).min();
        let Some((at, length)) = sign else {
            out.push([start, stop]);
            return out;
        };
        out.push([start, start + at]);
        start += at + length;
    }
}

/// An interval: where its ends stand, from the first byte of each to the one behind it.
struct Ends {
    /// Nothing where there is no end on that side.
    low: Option<[usize; 2]>,
    high: Option<[usize; 2]>,
    /// Whether each end is left out.
    open: [bool; 2],
    /// Whether it could be two components in brackets as well.
    may_be_pair: bool,
}

fn ends(text: &str, [from, stop]: [usize; 2]) -> Option<Ends> {
    let rest = text[from..stop].trim_start();
    let rest = rest.strip_prefix("\\left").unwrap_or(rest);
    let closed = rest.trim_end();
    let opened = rest.strip_prefix(['(', '[', ']'])?;
    let from = stop - opened.len();
    let inside = closed.strip_suffix([')', ']', '['])?;
    let inside = inside.strip_suffix("\\right").unwrap_or(inside);
    let to = from + inside.len().checked_sub(rest.len() - opened.len())?;
    let between = text.get(from..to)?;
    let comma = between.find([',', ';'])?;
    let braces = between.contains(['{', '}']) && !between.contains('\\');
    if between[comma + 1..].contains([',', ';']) || braces {
        return None;
    }
    let bounded = |[from, to]: [usize; 2]| infinity(&text[from..to]).is_none();
    let [low, high] = [[from, from + comma], [from + comma + 1, to]];
    let (low, high) = (
        Some(low).filter(|end| bounded(*end)),
        Some(high).filter(|end| bounded(*end)),
    );
    let brackets = (rest.chars().next()?, closed.chars().next_back()?);
    Some(Ends {
        low,
        high,
        open: [
            matches!(brackets.0, '(' | ']'),
            matches!(brackets.1, ')' | '['),
        ],
        may_be_pair: matches!(brackets, ('(', ')') | ('[', ']')) && low.is_some() && high.is_some(),
    })
}
