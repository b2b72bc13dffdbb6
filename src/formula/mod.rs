//! Formulas as people type them: text in, the written shape and expressions out, and expressions back to text.
//!
//! Plain text, Unicode and LaTeX are read by one reader, alone or mixed. The whole input is consumed or it is a
//! [`Fault`] with its place. What could be read in two ways is noted, and the other readings can be asked for. This
//! module never decides whether two formulas are equal.

mod calls;
mod characters;
mod component;
mod convert;
mod differential;
mod digits;
mod fault;
mod inverse;
mod lexer;
mod measured;
mod name;
pub mod near;
mod note;
mod number;
mod parser;
mod product;
mod prose;
mod sentence;
mod symbols;
mod tex;
mod units;
mod value;
mod visible;
mod words;
mod write;
mod written;

use std::collections::BTreeSet;

use crate::dimension::Unit;
use crate::expr::{Expr, Symbol};
pub use component::with_subscript;
use convert::Value;
pub use fault::Fault;
use fault::Faulty;
pub use note::{Note, Remark};
use parser::{Parser, Side};
pub(crate) use sentence::sentence;
pub use sentence::{Piece, Sentence, sides};
pub use symbols::{Declared, Symbols, letter};
pub(crate) use symbols::{is_angle_name, is_greek, letters};
pub(crate) use units::plain_unit;
pub use visible::{is_hidden, visible};
pub use write::{latex_name, unicode_name, write_latex, write_plain, write_unicode};
pub use written::{Link, Literal, Shape, Sign, Written};
pub(crate) use written::{has_arrow, is_component, with_arrow};

/// Longest formula, in bytes.
pub const MAX_BYTES: usize = 1 << 16;

/// A sign between two sides.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum Relation {
    Equal,
    NotEqual,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Approximately,
}

impl Relation {
    /// Whether it says which side is the smaller one.
    pub fn is_order(self) -> bool {
        self.is_below() || self.turned().is_below()
    }

    /// Whether the left side is the smaller one, or both may be the same.
    pub fn is_below(self) -> bool {
        matches!(self, Relation::Less | Relation::LessEqual)
    }

    /// The same read from right to left.
    pub fn turned(self) -> Relation {
        match self {
            Relation::Less => Relation::Greater,
            Relation::LessEqual => Relation::GreaterEqual,
            Relation::Greater => Relation::Less,
            Relation::GreaterEqual => Relation::LessEqual,
            same => same,
        }
    }

    /// The sign in Unicode.
    pub fn sign(self) -> &'static str {
        match self {
            Relation::Equal => "=",
            Relation::NotEqual => "≠",
            Relation::Less => "<",
            Relation::LessEqual => "≤",
            Relation::Greater => ">",
            Relation::GreaterEqual => "≥",
            Relation::Approximately => "≈",
        }
    }
}

/// A number, or an expression, with a unit.
#[derive(Clone, PartialEq, Debug)]
pub struct Quantity {
    /// Value in SI units.
    pub value: Expr,
    /// Value in the unit written.
    pub written: Expr,
    /// The unit.
    pub unit: Unit,
    /// The unit as written.
    pub unit_text: String,
}

/// What was read.
#[derive(Clone, PartialEq, Debug)]
pub enum Content {
    /// An expression.
    Scalar(Expr),
    /// Two values written with ±: the one of the upper sign first.
    Either([Expr; 2]),
    /// A vector along x, y and z.
    Vector([Expr; 3]),
    /// A value with a unit.
    Quantity(Box<Quantity>),
    /// Sides with relations between them; one side more than there are relations.
    Relations(Vec<Content>, Vec<Relation>),
}

impl Content {
    /// The expression, when it is one; a quantity gives its SI value.
    pub fn expr(&self) -> Option<&Expr> {
        match self {
            Content::Scalar(e) => Some(e),
            Content::Quantity(q) => Some(&q.value),
            _ => None,
        }
    }

    /// What is said of a quantity: the right side of `ω = …`, of `ω = … = …` the last one, else the content itself.
    pub fn answer(&self) -> &Content {
        match self {
            Content::Relations(sides, signs) => {
                let defines = signs
                    .iter()
                    .all(|s| matches!(s, Relation::Equal | Relation::Approximately));
                let named = sides
                    .first()
                    .and_then(Content::expr)
                    .is_some_and(|e| e.as_symbol().is_some());
                match sides.last() {
                    Some(last) if defines && named => last,
                    _ => self,
                }
            }
            other => other,
        }
    }

    /// The same with every expression inside changed; a quantity stays as it is.
    pub(crate) fn map(&self, change: &dyn Fn(&Expr) -> Expr) -> Content {
        match self {
            Content::Scalar(e) => Content::Scalar(change(e)),
            Content::Either(pair) => Content::Either(pair.each_ref().map(change)),
            Content::Vector(components) => Content::Vector(components.each_ref().map(change)),
            Content::Quantity(_) => self.clone(),
            Content::Relations(sides, signs) => {
                let sides = sides.iter().map(|side| side.map(change)).collect();
                Content::Relations(sides, signs.clone())
            }
        }
    }

    /// The names that occur.
    pub fn symbols(&self) -> BTreeSet<Symbol> {
        let mut names = BTreeSet::new();
        self.each(&mut |e| names.append(&mut e.symbols()));
        names
    }

    /// Calls `visit` for every expression inside.
    pub fn each(&self, visit: &mut dyn FnMut(&Expr)) {
        match self {
            Content::Scalar(e) => visit(e),
            Content::Either(pair) => pair.iter().for_each(visit),
            Content::Vector(components) => components.iter().for_each(visit),
            Content::Quantity(q) => visit(&q.value),
            Content::Relations(sides, _) => sides.iter().for_each(|side| side.each(visit)),
        }
    }
}

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
    /// The single expression, when it is one; of `ω = …` the right side.
    pub fn expr(&self) -> Option<&Expr> {
        self.content.answer().expr()
    }

    /// The names that occur.
    pub fn symbols(&self) -> BTreeSet<Symbol> {
        self.content.symbols()
    }
}

/// Reads a formula. Of several `\boxed{}` the last counts, and what stands around it is passed over; so are words
/// around a single formula in dollars.
pub fn read(text: &str, symbols: &Symbols) -> Result<Reading, Fault> {
    let held = prose::Held::of(text);
    if held.any("\\")
        && let Some(text) = box_beside_unit(text)
    {
        return read(&text, symbols);
    }
    if held.joins()
        && let Some(pair) = two_values(text, symbols)
    {
        return pair;
    }
    if held.any(",;")
        && let Some(between) = interval(text, symbols)
    {
        return Ok(between);
    }
    let usual = read_as(text, symbols, 0, held);
    let worded = match &usual {
        Ok(reading) => reading.notes.iter().any(|n| n.remark == Remark::Letters),
        Err(_) => text.len() <= MAX_BYTES,
    };
    if worded && let Some(reading) = read_behind_words(text, symbols) {
        return Ok(reading);
    }
    // What no rule read as words is no product of their letters.
    let between = |word: &str| Some((text.find(word)?, word.len()));
    if usual.is_ok()
        && held.any(" ")
        && held.joins()
        && !text.contains("\\boxed")
        && let Some((at, length)) = between(" or ").or_else(|| between(" and "))
    {
        let fault = Fault::new("a word between two formulas", at + 1, at + length - 1);
        return Err(*fault.hint("at most two values or bounds are read, as in x = 1 or x = 2"));
    }
    usual.map_err(|fault| *fault)
}

/// A formula with words around or before it.
fn read_behind_words(text: &str, symbols: &Symbols) -> Option<Reading> {
    let known = |word: &str| {
        symbols.find(word).is_some() || words::function(word).is_some() || is_greek(word)
    };
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
    let marked = prose::formula_in_words(text).and_then(part);
    marked.or_else(|| {
        let start = prose::behind_words(text, &known)?;
        part((start, text.len())).filter(|reading| !split(reading))
    })
}

/// `x ∈ [2, 3)` and `x in (0, ∞)` as the relations they stand for.
fn interval(text: &str, symbols: &Symbols) -> Option<Reading> {
    let (start, stop) = boxed(text).ok()?;
    let part = |[from, to]: [usize; 2]| read_inner(&text[..to], from, symbols, false, 0).ok();
    let ends = prose::interval(&text[start..stop])?.map_bytes(start);
    let name = part(ends.name)?;
    let mut sides = vec![name.content.clone()];
    let mut signs = Vec::new();
    let strict = |open: bool| match open {
        true => Relation::Less,
        false => Relation::LessEqual,
    };
    if let Some(low) = ends.low {
        sides.insert(0, part(low)?.content);
        signs.push(strict(ends.open[0]));
    }
    if let Some(high) = ends.high {
        sides.push(part(high)?.content);
        signs.push(strict(ends.open[1]));
    }
    let plain = |side: &Content| matches!(side, Content::Scalar(_));
    (!signs.is_empty() && sides.iter().all(plain)).then_some(Reading {
        content: Content::Relations(sides, signs),
        ..name
    })
}

/// `x = 3 or x = -3` and `2, -2` as one pair of values, `x > 1 and x < 3` as a chain.
fn two_values(text: &str, symbols: &Symbols) -> Option<Result<Reading, Fault>> {
    if text.len() > MAX_BYTES {
        return None;
    }
    let (start, stop) = boxed(text).ok()?;
    let set = prose::without_braces(&text[start..stop]);
    let set = set.map(|set| format!("{}{set}", " ".repeat(start)));
    let list = set.is_some();
    let (text, stop) = set.as_ref().map_or((text, stop), |set| (set, set.len()));
    let (end, next) = prose::alternatives(&text[start..stop], list)?;
    if symbols.find("or").is_some() || symbols.find("and").is_some() {
        return None;
    }
    let part = |from: usize, to: usize| {
        let strict = read_either(&text[..to], from, symbols, 0);
        let worded = |r: &Reading| r.notes.iter().any(|n| n.remark == Remark::Letters);
        strict.ok().filter(|r| !worded(r))
    };
    let (first, second) = (part(start, start + end)?, part(start + next, stop)?);
    let word = &text[start + end..start + next];
    if let (Content::Relations(a, s), Content::Relations(b, t)) = (&first.content, &second.content)
        && s.iter().chain(t).any(|sign| *sign != Relation::Equal)
    {
        let (a, b) = (a.as_slice(), b.as_slice());
        let ([x, low], [y, high], [s], [t]) = (a, b, s.as_slice(), t.as_slice()) else {
            return None;
        };
        // `a < x, x < b` begins with the lower bound.
        let (x, low, s) = match x == y {
            true => (x, low, *s),
            false => (low, x, s.turned()),
        };
        if x != y || word.contains("or") {
            let fault = Fault::new(
                "two relations joined by a word are not read",
                start + end,
                start + next,
            );
            return Some(Err(*fault.hint("write them as one, as in 1 < x < 3")));
        }
        let sides = vec![low.clone(), x.clone(), high.clone()];
        return Some(Ok(Reading {
            content: Content::Relations(sides, vec![s.turned(), *t]),
            ..second
        }));
    }
    let named = |content: &Content| {
        let (name, value) = match content {
            Content::Relations(sides, signs) if signs == &[Relation::Equal] => {
                match sides.as_slice() {
                    [Content::Scalar(name), value] => (Some(name.as_symbol()?.clone()), value),
                    _ => return None,
                }
            }
            value => (None, value),
        };
        match value {
            Content::Scalar(value) => Some((name, value.clone(), None)),
            Content::Quantity(q) => Some((name, q.value.clone(), Some(q.unit.clone()))),
            _ => None,
        }
    };
    let ((name, a, its), (other, b, unit)) = (named(&first.content)?, named(&second.content)?);
    if other.is_some() && other != name {
        return None;
    }
    let a = match (&its, &unit) {
        (None, None) => a,
        (Some(its), Some(unit)) if its.dimension == unit.dimension => a,
        // `2 or 3 m/s`: the unit behind the last number is that of both.
        (None, Some(unit)) if a.is_constant() => &a * &unit.value(),
        _ => return None,
    };
    let pair = Content::Either([a, b]);
    let content = match name {
        None => pair,
        Some(name) => {
            let sides = vec![Content::Scalar(Expr::symbol(&name)), pair];
            Content::Relations(sides, vec![Relation::Equal])
        }
    };
    Some(Ok(Reading {
        content,
        written: first.written.into_iter().chain(second.written).collect(),
        literal: None,
        unit,
        notes: first.notes.into_iter().chain(second.notes).collect(),
        choices: 0,
        slashes: false,
    }))
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
    let held = prose::Held::of(text);
    let mut out: Vec<Reading> = Vec::new();
    let count = (usual.choices - u32::from(usual.slashes)).min(MAX_READINGS);
    let all = (count > 1).then_some(!(1u64 << lexer::SLASHES));
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

/// The reading in which every slash outside functions reaches as far as some people mean it: over the first factor where
/// all of a tight product was taken, over all where a number or a space parted it.
pub fn slashes_turned(text: &str, symbols: &Symbols) -> Option<Reading> {
    read_as(text, symbols, 1u64 << lexer::SLASHES, prose::Held::of(text)).ok()
}

fn read_as(text: &str, symbols: &Symbols, flips: u64, held: prose::Held) -> Faulty<Reading> {
    if text.len() > MAX_BYTES {
        let message = format!(
            "a formula has at most {MAX_BYTES} bytes, this one has {}",
            text.len()
        );
        return Err(Fault::new(message, 0, 0));
    }
    let (mut start, end) = boxed(text)?;
    let inner = &text[..end];
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
    let components = lexer.vectors && sides.iter().any(|side| side.written.multiplies_vectors());
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
            Content::Relations(contents, relations)
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
        Value::Scalar(e) => {
            let constant = e.is_constant();
            match pair {
                true => {
                    let lower = convert::one(&side.written, mode(false))?;
                    (Content::Either([e, lower]), constant)
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
                let quantity = Quantity {
                    written: value.clone(),
                    value,
                    unit,
                    unit_text,
                };
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
            let quantity = Quantity {
                value: &written * &si,
                written,
                unit: unit.clone(),
                unit_text: text[*start..*end]
                    .trim_matches(|c: char| c.is_whitespace() || c == '$')
                    .to_string(),
            };
            (Content::Quantity(Box::new(quantity)), None)
        }
        Content::Either(pair) => (Content::Either(pair.map(|e| &e * &si)), Some(unit.clone())),
        Content::Vector(v) => (Content::Vector(v.map(|e| &e * &si)), Some(unit.clone())),
        other => (other, Some(unit.clone())),
    })
}

fn has_both_signs(w: &Written) -> bool {
    match &w.shape {
        Shape::Sum(terms) => terms.iter().any(|(sign, term)| {
            matches!(sign, Sign::PlusMinus | Sign::MinusPlus) || has_both_signs(term)
        }),
        Shape::Product(factors) => factors.iter().any(|(_, f)| has_both_signs(f)),
        Shape::Fraction(a, b) | Shape::Power(a, b) => has_both_signs(a) || has_both_signs(b),
        Shape::Root(_, a)
        | Shape::Call(_, a)
        | Shape::Reciprocal(_, a)
        | Shape::Bracket(a)
        | Shape::Abs(a) => has_both_signs(a),
        Shape::Degrees(a) | Shape::Measured(a, _) => has_both_signs(a),
        Shape::List(parts) => parts.iter().any(has_both_signs),
        Shape::Number(_) | Shape::Symbol(_) => false,
    }
}

/// `\boxed{1.5}\text{ m}`: the text with blanks for all that stands before the inside of the box, and for what closes it,
/// where a unit stands behind.
fn box_beside_unit(text: &str) -> Option<String> {
    if !text.contains("\\boxed") {
        return None;
    }
    let (start, end) = boxed(text).ok()?;
    let ends = |c: char| c.is_whitespace() || "$.".contains(c);
    let behind = text[end..].strip_prefix('}')?.trim_end_matches(ends);
    let unit = crate::dimension::unit(&plain_unit(behind)?);
    unit.is_ok_and(|unit| !unit.dimension.is_none() || unit.angle)
        .then(|| format!("{:start$}{} {behind}", "", &text[start..end]))
}

/// Start and end of the inside of the last `\boxed{}`; without one of the whole text.
fn boxed(text: &str) -> Faulty<(usize, usize)> {
    const OPEN: &str = "\\boxed";
    let command = text.contains('\\').then(|| text.rfind(OPEN));
    let Some(at) = command.flatten() else {
        return Ok((0, text.len()));
    };
    let behind = &text[at + OPEN.len()..];
    let blanks = behind.len() - behind.trim_start().len();
    let start = at + OPEN.len() + blanks;
    let mut depth = 0u32;
    for (i, b) in text.bytes().enumerate().skip(start) {
        match b {
            b'{' => depth += 1,
            b'}' if depth == 1 => return Ok((start + 1, i)),
            b'}' => depth = depth.saturating_sub(1),
            _ if depth == 0 => break,
            _ => {}
        }
    }
    Err(Fault::new(
        "\\boxed needs a group in braces that is closed",
        at,
        at + OPEN.len(),
    ))
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
