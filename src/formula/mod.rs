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
mod reading;
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

use crate::dimension;
use crate::expr::{Expr, Symbol};
pub(crate) use again::said_once;
pub use component::with_subscript;
pub use content::{Content, Join, Quantity, Relation};
pub use fault::Fault;
use fault::Faulty;
pub(crate) use frames::{lines_apart, unlisted};
pub use note::{Note, Remark};
pub(crate) use prose::{beside_condition, changes, concluded, is_in};
pub use quotient::Quotient;
pub(crate) use reading::within_limit;
pub use reading::{MAX_BYTES, Reading};
use reading::{framed, read_as, read_either};
pub(crate) use sentence::sentence;
pub use sentence::{Piece, Sentence, capital, digits, either, listed, sides, trimmed};
pub(crate) use sets::UNNAMED;
pub(crate) use several::{letters_apart, relations};
pub(crate) use symbols::name::closing;
pub use symbols::{Declared, Symbols, letter};
pub(crate) use symbols::{among, is_angle_name, is_greek, letters};
pub(crate) use together::values_of_one;
pub use token::Literal;
pub(crate) use units::plain_unit;
pub use visible::{is_hidden, visible};
pub use write::{latex_name, latex_words, unicode_name, write_latex, write_plain, write_unicode};
pub use written::{Link, Shape, Sign, Written};
pub(crate) use written::{
    along_axes, along_axis, has_arrow, has_components, is_component, unit_of, vector_name,
    with_arrow,
};

/// Longest text, in bytes, in which a formula is looked for among words.
const MAX_WORDED: usize = 1 << 14;

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
