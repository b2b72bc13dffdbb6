//! One reading of one text: out of its frame, with symbols before units or after them, each place that can be read in two ways
//! read as told.

use std::collections::BTreeSet;

use super::convert::{self, Value};
use super::fault::Faulty;
use super::note::Remark;
use super::parser::{Parser, Side};
use super::written::{Shape, Sign, Written};
use super::{Content, Fault, Literal, Note, Quantity, Symbols, lexer, measured, prose, units};
use crate::dimension::Unit;
use crate::expr::{Expr, Symbol};

/// Longest formula, in bytes.
pub const MAX_BYTES: usize = 1 << 16;

/// A formula that was read.
#[derive(Clone, PartialEq, Debug)]
pub struct Reading {
    /// What it says.
    pub content: Content,
    /// The sides as written, one unless there are relations.
    pub written: Vec<Written>,
    /// The number with its digits, when the last side is a single number as written.
    pub literal: Option<Literal>,
    /// The unit behind the last side, where that is no plain quantity: a formula in symbols, a vector, a pair. Numbers in
    /// the content are in SI units all the same.
    pub unit: Option<Unit>,
    /// Remarks on how it was read.
    pub notes: Vec<Note>,
    /// How many places could be read in another way; see [`super::other_readings`].
    pub choices: u32,
    /// Whether one of these is how far slashes reach; see [`super::slashes_turned`].
    pub slashes: bool,
}

impl Reading {
    /// The same text, read as something else.
    pub(crate) fn with(&self, content: Content) -> Reading {
        Reading {
            content,
            ..self.clone()
        }
    }

    /// Moves the places of remarks into a text that is shorter than the one that was read.
    pub(super) fn keep_places_in(&mut self, text: &str) {
        for note in &mut self.notes {
            note.start = note.start.min(text.len());
            note.end = note.end.min(text.len());
        }
    }

    /// The single expression, when it is one; of `ω = …` the right side.
    pub fn expr(&self) -> Option<&Expr> {
        self.content.answer().expr()
    }

    /// The names that occur.
    pub fn symbols(&self) -> BTreeSet<Symbol> {
        self.content.symbols()
    }
}

/// Refuses a text beyond [`MAX_BYTES`], before anything searches it.
pub(crate) fn within_limit(text: &str) -> Faulty<()> {
    let length = text.len();
    if length <= MAX_BYTES {
        return Ok(());
    }
    let message = format!("a formula has at most {MAX_BYTES} bytes, this one has {length}");
    Err(Fault::new(message, 0, 0))
}

/// Reads a text with some places read in the other way: bits of `flips`, in the order in which they come.
pub(super) fn read_as(
    text: &str,
    symbols: &Symbols,
    flips: u64,
    held: prose::Held,
) -> Faulty<Reading> {
    within_limit(text)?;
    let (mut start, end) = framed(text);
    let mut inner = &text[..end];
    // `**x = 5**` in Markdown.
    let bold = inner[start..].trim().strip_prefix("**");
    if bold.is_some_and(|rest| {
        rest.strip_suffix("**")
            .is_some_and(|rest| !rest.contains("**"))
    }) {
        start += inner[start..].find("**").map_or(0, |at| at + 2);
        let shut = inner.trim_end();
        inner = &shut[..shut.len() - 2];
    }
    let end = inner.len();
    if let Some(last) = prose::conclusion(&inner[start..], held) {
        start += last;
    }
    if let Some(behind) = prose::value(&inner[start..]) {
        start = end - behind.len();
    }
    read_either(inner, start, symbols, flips)
}

/// With symbols before units, or where that fails and nothing but the symbols may occur, units before symbols.
pub(super) fn read_either(
    text: &str,
    start: usize,
    symbols: &Symbols,
    flips: u64,
) -> Faulty<Reading> {
    let read = |flips| {
        read_inner(text, start, symbols, false, flips).or_else(|first| match symbols.is_open() {
            // The attempt that got further tells more.
            false => {
                let second = read_inner(text, start, symbols, true, flips);
                second.map_err(|second| match second.start > first.start {
                    true => second,
                    false => first,
                })
            }
            true => Err(first),
        })
    };
    let nested = text[start..].matches('|').count() > 3;
    read(flips).or_else(|fault| match nested {
        true => read(flips | 1u64 << lexer::BARS).map_err(|_| fault),
        false => Err(fault),
    })
}

/// Reads from byte `start` to the end of the text; places count from the start of the text.
fn read_inner(
    text: &str,
    start: usize,
    symbols: &Symbols,
    units_first: bool,
    flips: u64,
) -> Faulty<Reading> {
    let (text, stop) = unpunctuated(text, start);
    let mut parser = Parser::new(text, start, symbols, units_first, flips);
    let parsed = parser.statement();
    let mut lexer = parser.lexer;
    if !lexer.unknown.is_empty() {
        let mut faults = std::mem::take(&mut lexer.unknown);
        if let Err(other) = parsed
            && !faults.iter().any(|f| f.start == other.start)
        {
            faults.push(*other);
        }
        let mut first = faults.remove(0);
        first.also = faults;
        return Err(Box::new(first));
    }
    let (sides, relations) = parsed?;
    if let Some(stop) = stop {
        lexer.note(Remark::Punctuation, stop.0, stop.0, stop.1);
    }
    let mut contents = Vec::with_capacity(sides.len());
    let mut unit = None;
    let any = |so: &dyn Fn(&Written) -> bool| sides.iter().any(|side| so(&side.written));
    let mode = convert::Mode {
        upper: true,
        components: true,
    };
    // Names with hats alone are numbers where they are no vectors: `\hat{a}\hat{b}`.
    let known = |name: &str| symbols.find(&format!("{name}_x")).is_some();
    let vectors = |w: &Written| w.multiplies_vectors() || w.names_hat(&known);
    let components = lexer.vectors
        && any(&vectors)
        && (any(&Written::names_vector) || !any(&|w| convert::value(w, mode).is_err()));
    for (i, side) in sides.iter().enumerate() {
        // The name of what is asked for stays a name.
        let named = i == 0 && sides.len() > 1 && matches!(side.written.shape, Shape::Symbol(_));
        let (content, behind) = content(side, text, components && !named, &mut lexer)?;
        contents.push(content);
        unit = behind;
    }
    let literal = sides.last().and_then(|side| side.written.literal());
    let content = match contents.pop() {
        Some(only) if relations.is_empty() => only,
        Some(last) => {
            contents.push(last);
            Content::Relations(contents, relations).with_shared_unit()
        }
        None => return Err(Fault::new("the formula is empty", 0, 0)),
    };
    let written = sides.into_iter().map(|side| side.written).collect();
    Ok(Reading {
        content,
        written,
        literal,
        unit,
        notes: lexer.notes,
        choices: lexer.sites + u32::from(lexer.slashes),
        slashes: lexer.slashes,
    })
}

/// The content of a side, and the unit behind it unless the content is a quantity and holds it.
fn content(
    side: &Side,
    text: &str,
    components: bool,
    lexer: &mut lexer::Lexer,
) -> Faulty<(Content, Option<Unit>)> {
    let pair = lexer.pairs && has_both_signs(&side.written);
    let mode = |upper| convert::Mode { upper, components };
    let (content, constant) = match convert::value(&side.written, mode(true))? {
        Value::Vector(_) if pair => {
            let (start, end) = (side.written.start, side.written.end);
            return Err(Fault::new("a pair of vectors is not read", start, end));
        }
        Value::Vector(v) => {
            let constant = v.iter().all(|c| c.is_constant());
            (Content::Vector(v), constant)
        }
        Value::Matrix(_) if pair => {
            let (start, end) = (side.written.start, side.written.end);
            return Err(Fault::new("a pair of matrices is not read", start, end));
        }
        Value::Matrix(rows) => {
            let constant = rows.iter().flatten().all(Expr::is_constant);
            (Content::Matrix(rows), constant)
        }
        Value::Scalar(e) => {
            let constant = e.is_constant();
            match pair {
                true => {
                    let lower = convert::one(&side.written, mode(false))?;
                    (Content::Either(vec![e, lower]), constant)
                }
                false => (Content::Scalar(e), constant),
            }
        }
    };
    if side.measured {
        let dimension = measured::dimension(&side.written)?;
        let unit_text = dimension.si();
        let unit = Unit::coherent(dimension);
        return Ok(match content {
            Content::Scalar(value) => {
                let quantity = Quantity::of(value, unit, &unit_text);
                (Content::Quantity(Box::new(quantity)), None)
            }
            other => (other, Some(unit)),
        });
    }
    let Some((unit, start, end)) = &side.unit else {
        return Ok((content, None));
    };
    if !constant {
        lexer.note(Remark::UnitOfSymbols, *start, *start, *end);
        return Ok((content, Some(unit.clone())));
    }
    let si = unit.value();
    Ok(match content {
        Content::Scalar(written) => {
            let blank = |c: char| c.is_whitespace() || c == '$';
            let unit_text = text[*start..*end].trim_matches(blank);
            // That of `\qty{3}{m/s}` stands before the end of the number.
            let in_braces = text[..*start].trim_end().strip_suffix('}');
            let in_braces = in_braces.and_then(|t| Some(units::spelled(t.rsplit_once("}{")?.1)));
            let unit_text = match (unit_text, &in_braces) {
                ("", Some(spelled)) => spelled,
                (shown, _) => shown,
            };
            let quantity = Quantity::of(written, unit.clone(), unit_text);
            (Content::Quantity(Box::new(quantity)), None)
        }
        Content::Either(values) => {
            let values = values.iter().map(|e| e * &si).collect();
            (Content::Either(values), Some(unit.clone()))
        }
        several @ (Content::Vector(_) | Content::Matrix(_)) => {
            (several.map(&|e| e * &si), Some(unit.clone()))
        }
        other => (other, Some(unit.clone())),
    })
}

fn has_both_signs(w: &Written) -> bool {
    let both = |(sign, _): &(Sign, Written)| matches!(sign, Sign::PlusMinus | Sign::MinusPlus);
    let here = matches!(&w.shape, Shape::Sum(terms) if terms.iter().any(both));
    here || w.pieces().into_iter().any(has_both_signs)
}

/// The inside of quotation marks around a whole text, or of those of code.
fn quoted(text: &str) -> Option<&str> {
    let code = text.trim().strip_prefix('`');
    if let Some(code) = code.and_then(|code| code.strip_suffix('`')) {
        let inside = code.trim_matches('`');
        return (!inside.contains('`')).then_some(inside);
    }
    let opened = text.trim().strip_prefix(['"', '“', '„', '«'])?;
    let inside = opened.strip_suffix(['"', '”', '“', '»'])?;
    (!inside.contains(['"', '“', '”', '»'])).then_some(inside)
}

/// Start and end of a formula in quotation marks or in `\text{2 m/s}`; of another the whole.
pub(super) fn framed(text: &str) -> (usize, usize) {
    const FONTS: [&str; 4] = ["\\text{", "\\textbf{", "\\mathrm{", "\\mathbf{"];
    if let Some(inside) = quoted(text) {
        let start = text.find(inside).unwrap_or(0);
        return (start, start + inside.len());
    }
    let inside = |font: &&str| text.strip_prefix(*font)?.strip_suffix('}');
    let font = FONTS.iter().find(|font| {
        inside(font)
            .is_some_and(|i| i.starts_with(|c: char| c.is_ascii_digit()) && !i.contains('}'))
    });
    font.map_or((0, text.len()), |font| (font.len(), text.len() - 1))
}

/// The text without a full stop or comma behind it, and the place of that; `4.` keeps its point.
fn unpunctuated(text: &str, start: usize) -> (&str, Option<(usize, usize)>) {
    let blank = |c: char| c.is_whitespace() || c == '$';
    let trimmed = text.trim_end_matches(blank);
    // A line of LaTeX ends in two backslashes.
    let (text, trimmed) = match trimmed
        .strip_suffix("\\\\")
        .filter(|line| line.len() > start)
    {
        Some(line) => (line, line.trim_end_matches(blank)),
        None => (text, trimmed),
    };
    let Some(body) = trimmed
        .strip_suffix(['.', ',', ';'])
        .filter(|b| b.len() >= start)
    else {
        return (text, None);
    };
    // In `v1.` the digit belongs to a name, in `2.5.` another point to the number, in `4.` the point belongs to the number.
    let before = body.trim_end_matches(|c: char| c.is_ascii_digit());
    let named = before.ends_with(|c: char| c.is_alphabetic() || matches!(c, '_' | '.'));
    let number = trimmed.ends_with('.') && before.len() < body.len() && !named;
    let empty = body[start..].trim().is_empty();
    let spaced = ["\\,", "\\;"].iter().any(|space| body.ends_with(space));
    match number || empty || !spaced && body.ends_with(['.', ',', ';', '\\']) {
        true => (text, None),
        false => (body, Some((body.len(), trimmed.len()))),
    }
}
