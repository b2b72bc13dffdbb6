//! What is wrong with a scene file, where, and what to do about it.
//!
//! In: places and messages, as the reader meets them. Out: text for people. It knows neither JSON nor mechanics, and it
//! does no IO: the caller names the file.

use crate::formula::near::distance;
use std::fmt::Write;

/// A stretch of the text, in bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Default)]
pub struct Span {
    /// First byte.
    pub start: usize,
    /// Byte after the last.
    pub end: usize,
}

impl Span {
    /// The bytes from `start` up to `end`.
    pub fn new(start: usize, end: usize) -> Span {
        Span {
            start,
            end: end.max(start),
        }
    }

    /// From the start of this stretch to the end of `other`.
    pub fn to(self, other: Span) -> Span {
        Span::new(self.start, other.end)
    }

    /// The opening bracket of an object: the place to show when something in it is missing.
    pub fn opening(self) -> Span {
        Span::new(self.start, self.start + 1)
    }

    /// Whether `other` lies inside.
    pub fn contains(self, other: Span) -> bool {
        self.start <= other.start && other.end <= self.end
    }
}

/// One thing that is wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Where in the text.
    pub span: Span,
    /// JSON pointer of the innermost value around it; empty for the whole scene.
    pub pointer: String,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// What is wrong.
    pub message: String,
    /// What to do about it.
    pub hint: Option<String>,
    /// At which byte what the message ends with is declared, whose line is told when reading ends.
    pub(super) declared: Option<usize>,
}

impl Fault {
    /// A fault at a place; pointer, line and column are found when reading ends.
    pub(super) fn new(span: Span, message: impl Into<String>) -> Fault {
        Fault {
            span,
            pointer: String::new(),
            line: 0,
            column: 0,
            message: message.into(),
            hint: None,
            declared: None,
        }
    }

    /// The same, shown at a smaller place.
    pub(super) fn shown_at(mut self, span: Span) -> Fault {
        self.span = span;
        self
    }

    /// The same with advice.
    pub(super) fn hint(mut self, hint: impl Into<String>) -> Fault {
        self.hint = Some(hint.into());
        self
    }

    /// Adds it to those found. The answer is `None`, for what could not be read because of it.
    pub(super) fn add_to<T>(self, faults: &mut Vec<Fault>) -> Option<T> {
        faults.push(self);
        None
    }
}

/// Everything that is wrong with a scene, in the order of the text; never empty.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Faults {
    /// The faults that are told.
    pub list: Vec<Fault>,
    /// How many more there are.
    pub untold: usize,
}

/// As many faults as are told at once; more would bury the first.
pub(super) const TOLD: usize = 20;

impl Faults {
    /// Sorts faults by place and gives each its line and column.
    pub(super) fn gather(mut list: Vec<Fault>, text: &str) -> Faults {
        list.sort_by_key(|fault| fault.span);
        list.dedup_by(|a, b| a.span == b.span && a.message == b.message);
        let untold = list.len().saturating_sub(TOLD);
        list.truncate(TOLD);
        for fault in &mut list {
            let before = &text[..floor(text, fault.span.start)];
            let line_start = before.rfind('\n').map_or(0, |at| at + 1);
            if let Some(at) = fault.declared.take() {
                let line = text[..floor(text, at)].matches('\n').count() + 1;
                fault.message += &format!(", in line {line}");
            }
            fault.line = before.matches('\n').count() + 1;
            fault.column = before[line_start..].chars().count() + 1;
        }
        Faults { list, untold }
    }

    /// The faults as text for a terminal: for each the file, the JSON pointer and the message, the line of the file with
    /// the place underlined, and a hint. `text` is the text that was read.
    pub fn render(&self, file: &str, text: &str) -> String {
        let mut out = String::new();
        for (i, fault) in self.list.iter().enumerate() {
            if i > 0 {
                out.push('\n');
            }
            let place = match fault.pointer.as_str() {
                "" => format!("{}:{}", fault.line, fault.column),
                pointer => pointer.to_owned(),
            };
            // Writing to a String cannot fail.
            let _ = writeln!(
                out,
                "{}: {}: {}",
                visible(file),
                visible(&place),
                visible(&fault.message)
            );
            snippet(&mut out, fault, text);
            if let Some(hint) = &fault.hint {
                let _ = writeln!(out, "hint: {}", visible(hint));
            }
        }
        if self.untold > 0 {
            let _ = writeln!(out, "\nand {} more", self.untold);
        }
        out
    }
}

/// Characters shown of a long line, before the place and from it on.
const SHOWN: (usize, usize) = (50, 50);

/// The line of the fault with the place underlined.
fn snippet(out: &mut String, fault: &Fault, text: &str) {
    let start = floor(text, fault.span.start);
    let line_start = text[..start].rfind('\n').map_or(0, |at| at + 1);
    let line_end = text[start..].find('\n').map_or(text.len(), |at| start + at);
    let end = floor(text, fault.span.end).clamp(start, line_end);

    let before: String = text[line_start..start].trim_start().into();
    let skipped = before.chars().count().saturating_sub(SHOWN.0);
    let before: String = before.chars().skip(skipped).collect();
    let marked: String = text[start..end].trim_end().chars().take(SHOWN.1).collect();
    let after: String = text[start..line_end]
        .trim_end()
        .chars()
        .skip(marked.chars().count())
        .collect();
    let room = SHOWN.1.saturating_sub(marked.chars().count());
    let cut = after.chars().count() > room;
    let after: String = after.chars().take(room).collect();

    let before = format!("{}{}", if skipped > 0 { "…" } else { "" }, visible(&before));
    let marked = visible(&marked);
    let number = fault.line.to_string();
    let pad = " ".repeat(number.len());
    let _ = writeln!(
        out,
        "{number} | {before}{marked}{}{}",
        visible(&after),
        if cut { "…" } else { "" }
    );
    let blank = " ".repeat(before.chars().count());
    let _ = writeln!(
        out,
        "{pad} | {blank}{}",
        "^".repeat(marked.chars().count().max(1))
    );
}

/// The text with characters that would act on the terminal, or hide, shown by their number.
fn visible(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\t' => out.push(' '),
            c if crate::formula::is_hidden(c) => {
                let _ = write!(out, "<U+{:04X}>", u32::from(c));
            }
            c => out.push(c),
        }
    }
    out
}

/// The nearest character boundary at or below `at`.
fn floor(text: &str, at: usize) -> usize {
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

/// How little a name looks like a word: slips that turn one into the other, fewer where one holds the other.
pub(super) fn far(word: &str, name: &str) -> usize {
    let slips = 2 * distance(word, name);
    let (word, name) = (word.to_lowercase(), name.to_lowercase());
    let holds = word.contains(&name) || name.contains(&word);
    // Two or three letters are in many words.
    match holds && word.len().min(name.len()) > 3 {
        true => slips / 4,
        false => slips,
    }
}

/// A double as people write it.
pub(super) fn number_words(number: f64) -> String {
    if number != 0.0 && !(1e-4..1e6).contains(&number.abs()) {
        return format!("{number:e}");
    }
    crate::formula::trimmed(&format!("{number:.6}")).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_that_turn_text_round_are_shown_and_not_obeyed() {
        assert_eq!(visible("a\u{202e}b\u{1b}[0m"), "a<U+202E>b<U+001B>[0m");
    }

    #[test]
    fn a_long_line_is_cut_around_the_place() {
        let text = format!("{}X{}", "a".repeat(500), "b".repeat(500));
        let faults = Faults::gather(vec![Fault::new(Span::new(500, 501), "here")], &text);
        let shown = faults.render("f", &text);
        assert!(
            shown.contains("1 | …aaaa") && shown.lines().all(|l| l.chars().count() < 120),
            "{shown}"
        );
        assert_eq!(faults.list[0].column, 501);
    }
}
