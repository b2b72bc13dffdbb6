//! What is wrong with a formula, where, and what to write instead.

use std::fmt;

/// What is said of sets that are not read.
pub(super) const SETS: &str = "intervals are read as x ∈ (2, ∞) and values as x ∈ {1, 2}; all numbers, or none, are nothing to compare";

/// One fault of an input, with its place in bytes.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Fault {
    /// What is wrong and what was expected.
    pub message: String,
    /// First byte concerned.
    pub start: usize,
    /// Byte after the last one concerned; equal to `start` where something is missing.
    pub end: usize,
    /// What to write instead, such as the nearest declared symbol.
    pub hint: Option<String>,
    /// Further faults that do not follow from this one.
    pub also: Vec<Fault>,
}

/// Faults are rare and large; a result carries a pointer to them.
pub(crate) type Faulty<T> = Result<T, Box<Fault>>;

impl Fault {
    pub(crate) fn new(message: impl Into<String>, start: usize, end: usize) -> Box<Fault> {
        Box::new(Fault {
            message: message.into(),
            start,
            end: end.max(start),
            hint: None,
            also: Vec::new(),
        })
    }

    pub(crate) fn hint(mut self: Box<Fault>, hint: impl Into<String>) -> Box<Fault> {
        self.hint = Some(hint.into());
        self
    }

    /// The places that it and those beside it speak of.
    pub(super) fn places(&mut self) -> impl Iterator<Item = &mut usize> {
        let also = self.also.iter_mut();
        let also = also.flat_map(|fault| [&mut fault.start, &mut fault.end]);
        [&mut self.start, &mut self.end].into_iter().chain(also)
    }

    /// The message with the line of the formula it speaks of and a caret below the place, for each fault.
    pub fn show(&self, text: &str) -> String {
        let mut out = String::new();
        for fault in std::iter::once(self).chain(&self.also) {
            if !out.is_empty() {
                out.push('\n');
            }
            out.push_str(&fault.message);
            out.push('\n');
            out.push_str(&caret(text, fault.start, fault.end));
            if let Some(hint) = &fault.hint {
                out.push_str("\nhint: ");
                out.push_str(hint);
            }
        }
        out
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} (at byte {})", self.message, self.start)?;
        match &self.hint {
            Some(hint) => write!(f, "; {hint}"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for Fault {}

/// Characters shown on either side of the place.
const AROUND: usize = 30;

/// Two lines: the surroundings of the place, and carets below it. Invisible characters are shown as `�`.
fn caret(text: &str, start: usize, end: usize) -> String {
    let (start, end) = (floor(text, start), floor(text, end));
    let before: Vec<char> = text[..start]
        .chars()
        .rev()
        .take_while(|c| *c != '\n')
        .take(AROUND)
        .collect();
    let inside: Vec<char> = text[start..end]
        .chars()
        .take_while(|c| *c != '\n')
        .take(2 * AROUND)
        .collect();
    let after: Vec<char> = match text[start..end].contains('\n') {
        true => Vec::new(),
        false => text[end..]
            .chars()
            .take_while(|c| *c != '\n')
            .take(AROUND)
            .collect(),
    };
    let shown = |c: &char| {
        if c.is_control() || is_invisible(*c) {
            '\u{fffd}'
        } else {
            *c
        }
    };
    let line: String = before
        .iter()
        .rev()
        .chain(&inside)
        .chain(&after)
        .map(shown)
        .collect();
    format!(
        "  {line}\n  {}{}",
        " ".repeat(before.len()),
        "^".repeat(inside.len().max(1))
    )
}

fn floor(text: &str, mut at: usize) -> usize {
    at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

/// Characters that change how a text looks without being seen: zero width, direction marks, fillers.
pub(crate) fn is_invisible(c: char) -> bool {
    matches!(c,
        '\u{00ad}' | '\u{034f}' | '\u{061c}' | '\u{115f}' | '\u{1160}' | '\u{17b4}' | '\u{17b5}' | '\u{180b}'..='\u{180f}'
        | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{3164}' | '\u{fe00}'..='\u{fe0f}'
        | '\u{feff}' | '\u{ffa0}' | '\u{fff0}'..='\u{fffb}' | '\u{1d173}'..='\u{1d17a}' | '\u{e0000}'..='\u{e0fff}')
}
