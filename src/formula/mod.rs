//! Formulas as people type them: text in, the written shape and expressions out, and expressions back to text.
//!
//! Plain text, Unicode and LaTeX are read by one reader, alone or mixed. The whole input is consumed or it is a
//! [`Fault`] with its place. What could be read in two ways is noted, and the other readings can be asked for. This
//! module never decides whether two formulas are equal.

mod again;
mod bound;
mod boxes;
mod calls;
mod characters;
mod component;
mod content;
mod convert;
mod differential;
mod digits;
mod dress;
mod fault;
mod frames;
mod inverse;
mod lexer;
mod marks;
mod measured;
pub mod near;
mod note;
mod number;
mod pair;
mod parser;
mod product;
mod prose;
mod quotient;
mod sentence;
mod sets;
mod several;
mod symbols;
mod tex;
mod together;
mod token;
mod units;
mod value;
mod visible;
mod words;
mod write;
mod written;

use std::collections::BTreeSet;

use crate::dimension::{self, Unit};
use crate::expr::{Expr, Symbol};
pub(crate) use again::said_once;
pub use component::with_subscript;
pub use content::{Content, Join, Quantity, Relation};
use convert::Value;
pub use fault::Fault;
use fault::Faulty;
pub(crate) use frames::{lines_apart, unlisted};
pub use note::{Note, Remark};
use parser::{Parser, Side};
pub(crate) use prose::{beside_condition, changes, concluded};
pub use quotient::Quotient;
pub(crate) use sentence::sentence;
pub use sentence::{Piece, Sentence, capital, digits, either, listed, sides, trimmed};
pub(crate) use sets::UNNAMED;
pub(crate) use several::{letters_apart, relations};
pub use symbols::{Declared, Symbols, letter};
pub(crate) use symbols::{is_angle_name, is_greek, letters};
pub(crate) use together::values_of_one;
pub use token::Literal;
pub(crate) use units::plain_unit;
pub use visible::{is_hidden, visible};
pub use write::{latex_name, latex_words, unicode_name, write_latex, write_plain, write_unicode};
pub use written::{Link, Shape, Sign, Written};
pub(crate) use written::{
    along_axes, along_axis, has_arrow, has_components, is_component, vector_name, with_arrow,
};

/// Longest formula, in bytes.
pub const MAX_BYTES: usize = 1 << 16;
/// Longest text, in bytes, in which a formula is looked for among words.
const MAX_WORDED: usize = 1 << 14;

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
    /// How many places could be read in another way; see [`other_readings`].
    pub choices: u32,
    /// Whether one of these is how far slashes reach; see [`slashes_turned`].
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
    fn keep_places_in(&mut self, text: &str) {
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

/// The name that a text is read as, when it is one.
pub(crate) fn read_name(text: &str, symbols: &Symbols) -> Option<Symbol> {
    read(text, symbols).ok()?.expr()?.as_symbol().cloned()
}

/// Reads a formula. Of several `\boxed{}` the last counts, with what touches it; words around it are passed over, and so are
/// those around a single formula in dollars.
pub fn read(text: &str, symbols: &Symbols) -> Result<Reading, Fault> {
    let held = prose::Held::of(text);
    if held.all("\\box")
        && let Some(formula) = boxes::unboxed(text)
    {
        return read(&formula.map_err(|fault| *fault)?, symbols);
    }
    if held.all("\\{=&")
        && let Some(last) = frames::last_equation(text)
    {
        return read(&last, symbols);
    }
    if held.all("\\.")
        && let Some(text) = without_full_stop(text)
    {
        return read(&text, symbols);
    }
    if held.any("\\")
        && let Some(text) = upright(text)
        && let Ok(reading) = read(&text, symbols)
    {
        return Ok(reading);
    }
    if held.any("<>\\\u{2264}")
        && let Some(text) = several::without_infinity(text, symbols)
    {
        return read(&text, symbols);
    }
    if held.any("\u{ff10}")
        && let Some(reading) = read_full_width(text, symbols)
    {
        return reading;
    }
    if (held.all("integ") || held.any("\\\u{2124}"))
        && let Some(end) = prose::without_count(text)
    {
        return read(&text[..end], symbols);
    }
    if held.any(")]")
        && let Some(reading) = again::said_again(text, symbols)
    {
        return Ok(reading);
    }
    if several::is_likely(text, held)
        && let Some(pair) = several::values(text, symbols)
    {
        return pair;
    }
    if (held.any(",;") || held.any("{") && sets::leaves_out(text))
        && let Some(between) = sets::interval(text, symbols, false)
    {
        return Ok(between);
    }
    let mut usual = read_as(text, symbols, 0, held);
    if (usual.is_err() && held.any(":") || held.all("to "))
        && let Some(ratio) = prose::ratio(text)
    {
        usual = read_as(&ratio, symbols, 0, held);
    }
    let short = text.len() <= MAX_WORDED;
    let worded = match &usual {
        Ok(reading) => reading.notes.iter().any(|n| n.remark == Remark::Letters),
        Err(_) => short,
    };
    if (worded || short && held.all("up to"))
        && let Some(bound) = bound::in_words(text, symbols)
    {
        return Ok(bound);
    }
    if let Err(fault) = &usual
        && held.any("/")
        && let Some(set) = unit_behind(text, fault.start)
        && let Ok(mut reading) = read(&set, symbols)
    {
        reading.keep_places_in(text);
        return Ok(reading);
    }
    if worded && let Some(reading) = read_behind_words(text, symbols) {
        return reading.map_err(|fault| *fault);
    }
    if worded && let Some(mut reading) = dress::read_without(text, symbols, held, usual.is_err()) {
        reading.keep_places_in(text);
        return Ok(reading);
    }
    if let Ok(reading) = &usual
        && held.any(" ")
        && let Some(fault) = word_between(text, symbols, held, reading)
    {
        return Err(*fault);
    }
    usual.map_err(|fault| *fault)
}

/// Refuses a word between formulas that no rule read: it is no product of its letters.
fn word_between(
    text: &str,
    symbols: &Symbols,
    held: prose::Held,
    reading: &Reading,
) -> Option<Box<Fault>> {
    let between = |word: &str| Some((text.find(word)?, word.len()));
    let joining = held
        .joins()
        .then(|| between(" or ").or_else(|| between(" and ")));
    // `13 m to 17 m`
    let range = || {
        between(" to ").filter(|_| {
            ["t", "o"]
                .iter()
                .all(|name| reading.symbols().contains(*name))
        })
    };
    let (found, hint) = match joining.flatten().or_else(range) {
        Some(found) => (
            found,
            "values and bounds are joined by words, as in x = 1 or x = 2",
        ),
        // `x = 5 since x > 0`
        None => {
            let found = prose::conditional(text);
            let name = |(at, length): &(usize, usize)| &text[at + 1..at + length - 1];
            let found = found.filter(|found| symbols.find(name(found)).is_none());
            let inside = || {
                let (start, end) = word_inside(text, symbols, reading)?;
                Some((start - 1, end - start + 2))
            };
            (
                found.or_else(inside)?,
                "give the formula alone, without the condition behind it",
            )
        }
    };
    let (start, end) = (found.0 + 1, found.0 + found.1 - 1);
    Some(Fault::new("a word between two formulas", start, end).hint(hint))
}

/// Where a word of prose stands inside what was read.
fn word_inside(text: &str, symbols: &Symbols, reading: &Reading) -> Option<(usize, usize)> {
    let letter = |c: char| symbols.find(c.encode_utf8(&mut [0; 4])).is_some();
    let known = |word: &str| symbols.find(word).is_some() || word.chars().all(letter);
    let read = [reading.written.first()?.start, reading.written.last()?.end];
    prose::word_inside(text, read, &known)
}

/// A text whose last word, `m/s` or `[m/s]`, is set as a unit where a fault lies in it: m may be a mass as well.
fn unit_behind(text: &str, fault: usize) -> Option<String> {
    let (before, word) = text.trim_end().rsplit_once(' ')?;
    let inside = word.strip_prefix('[').and_then(|w| w.strip_suffix(']'));
    let unit = inside.unwrap_or(word);
    let is_unit = unit.contains('/') && dimension::unit(unit).is_ok();
    let stands_behind = !before.trim().is_empty() && fault > before.len();
    (is_unit && stands_behind).then(|| format!("{before} \\text{{{unit}}}"))
}

/// A text with a blank for the full stop before the end of its frame: `\[ 2mv. \]`, `2mv. \end{equation}`; `4.` keeps its point.
fn without_full_stop(text: &str) -> Option<String> {
    let end = text.trim_end_matches(|c: char| c.is_whitespace() || c == '$');
    let frame = ["\\]", "\\)", "\\end{"]
        .iter()
        .filter_map(|end| text.rfind(end));
    let at = frame
        .max()
        .filter(|at| !end[*at..].trim_end_matches('}').contains(['}', ' ']))?;
    let body = text[..at].trim_end().strip_suffix('.')?;
    let before = body.trim_end_matches(|c: char| c.is_ascii_digit());
    let named = before.ends_with(|c: char| c.is_alphabetic() || matches!(c, '_' | '.'));
    let number = before.len() < body.len() && !named;
    let point = number || body.ends_with(['.', '\\']);
    let sized = ["\\left", "\\right"]
        .iter()
        .any(|size| body.ends_with(size));
    (!point && !sized).then(|| format!("{body} {}", &text[body.len() + 1..]))
}

/// A text with ` \rm{m}` for `{\rm m}`, which is as long; an index and a d stay.
fn upright(text: &str) -> Option<String> {
    const OLD: &str = "{\\rm ";
    let mut parts = text.split(OLD);
    let mut out = parts.next()?.to_string();
    for part in parts {
        let stays = out.ends_with(['_', '^']) || part.starts_with("d}");
        out.push_str(if stays { OLD } else { " \\rm{" });
        out.push_str(part);
    }
    (out != text).then_some(out)
}

/// Reads a text with full-width characters as plain text, and tells places as they are in the text.
fn read_full_width(text: &str, symbols: &Symbols) -> Option<Result<Reading, Fault>> {
    let (plain, places) = characters::plain_width(text)?;
    let place = |at: &mut usize| *at = places.get(*at).copied().unwrap_or(text.len());
    let mut reading = read(&plain, symbols);
    match &mut reading {
        Ok(reading) => {
            let notes = reading.notes.iter_mut();
            notes
                .flat_map(|n| [&mut n.start, &mut n.middle, &mut n.end])
                .for_each(place);
        }
        Err(fault) => fault.places().for_each(place),
    }
    Some(reading)
}

/// Reads a pair of numbers in brackets as an interval: `(0, 1)` and `[0, 1]`.
pub(crate) fn read_interval(text: &str, symbols: &Symbols) -> Option<Reading> {
    let short = text.len() <= MAX_BYTES && text.contains([',', ';']);
    short.then(|| sets::interval(text, symbols, true))?
}

/// A formula with words around or before it.
fn read_behind_words(text: &str, symbols: &Symbols) -> Option<Faulty<Reading>> {
    let known = |word: &str| dress::is_known(word, symbols);
    let part = |(start, end): (usize, usize)| {
        let mut reading = read_either(&text[..end], start, symbols, 0).ok()?;
        reading.notes.push(Note {
            remark: Remark::Words,
            start,
            middle: start,
            end,
        });
        Some(reading)
    };
    let split = |r: &Reading| r.notes.iter().any(|n| n.remark == Remark::Letters);
    let marked = match prose::formula_in_words(text) {
        Some(Err(fault)) => return Some(Err(fault)),
        Some(Ok(place)) => part(place),
        None => None,
    };
    let marked = marked.or_else(|| {
        let start = prose::behind_words(text, &known)?;
        part((start, text.len())).filter(|reading| !split(reading))
    });
    // `x is 5` says what a name is, in a text of the same length.
    let said = || {
        let named = |verb| {
            text.split_once(verb)
                .map(|(name, value)| (name, verb, value))
        };
        let (name, verb, value) = [" is ", " equals "].into_iter().find_map(named)?;
        let said = format!("{name} ={:1$}{value}", "", verb.len() - 2);
        let reading = read_either(&said, 0, symbols, 0).ok()?;
        let is_name =
            !name.trim().contains(' ') && !std::ptr::eq(reading.content.answer(), &reading.content);
        (is_name && !split(&reading)).then_some(reading)
    };
    marked.or_else(said).map(Ok)
}

/// Reads a formula that is a single expression, such as those in scenes.
pub fn read_expr(text: &str, symbols: &Symbols) -> Result<Expr, Fault> {
    let reading = read(text, symbols)?;
    match reading.content {
        Content::Scalar(e) => Ok(e),
        _ => Err(*Fault::new(
            "a single expression is expected",
            0,
            text.len(),
        )),
    }
}

/// Most readings tried beside the usual one.
const MAX_READINGS: u32 = 16;

/// The other plausible readings of a text that was read with [`Reading::choices`] above 0: all slashes turned round, each
/// other choice alone, and all of these together. The same content is given once; a turned reading that fails is left out.
/// Without `slashes` these stay as they are usually read.
pub fn other_readings(text: &str, symbols: &Symbols, slashes: bool) -> Vec<Reading> {
    let Ok(usual) = read(text, symbols) else {
        return Vec::new();
    };
    let formula = boxes::unboxed(text).and_then(Result::ok);
    let text = formula.as_deref().unwrap_or(text);
    let held = prose::Held::of(text);
    let mut out: Vec<Reading> = Vec::new();
    let count = (usual.choices - u32::from(usual.slashes)).min(MAX_READINGS);
    let all = (count > 1).then_some(!(0b111u64 << lexer::HALVES));
    let slashes = (slashes && usual.slashes).then_some(1u64 << lexer::SLASHES);
    let sites = (0..count).map(|site| 1u64 << site);
    for flips in slashes.into_iter().chain(sites).chain(all) {
        if let Ok(reading) = read_as(text, symbols, flips, held) {
            let known = reading.content == usual.content
                || out.iter().any(|r| r.content == reading.content);
            if !known {
                out.push(reading);
            }
        }
    }
    out
}

/// The readings in which every slash outside functions reaches as far as some people mean it: over the first factor where
/// all of a tight product was taken, over all where a number or a space parted it; in the second, `3/4 x` stays as it is.
pub fn slashes_turned(text: &str, symbols: &Symbols) -> Vec<Reading> {
    let formula = boxes::unboxed(text).and_then(Result::ok);
    let text = formula.as_deref().unwrap_or(text);
    let held = prose::Held::of(text);
    let turned = [0, 1u64 << lexer::HALVES].map(|halves| halves | 1u64 << lexer::SLASHES);
    let read = |flips| read_as(text, symbols, flips, held).ok();
    turned.into_iter().filter_map(read).collect()
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

fn read_as(text: &str, symbols: &Symbols, flips: u64, held: prose::Held) -> Faulty<Reading> {
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
fn read_either(text: &str, start: usize, symbols: &Symbols, flips: u64) -> Faulty<Reading> {
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
fn framed(text: &str) -> (usize, usize) {
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
