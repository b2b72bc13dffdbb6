//! A quantity said again in brackets behind itself: `5 m/s (18 km/h)`, `90° (π/2 rad)`, `0.25 (25 %)`.
//!
//! In brackets stands no factor then, and nothing that is added: both are read, and a relation says that they are the same.

use super::content::{Content, Relation};
use super::fault::{Fault, Faulty};
use super::token::Literal;
use super::written::Shape;
use super::{Reading, Symbols, read};
use crate::dimension::Dimension;
use crate::expr::{Expr, Point};

/// The values before and in the brackets as sides of one relation; `≈` where one rounds the other.
pub(super) fn said_again(text: &str, symbols: &Symbols) -> Option<Reading> {
    let (open, close) = last_brackets(text)?;
    let mut first = read(&text[..open], symbols).ok()?;
    let (value, dimension, shown) = measured(&first)?;
    let words = ["or ", "i.e. ", "that is "];
    let inside = &text[open + 1..close];
    let said = words.iter().find_map(|word| inside.strip_prefix(word));
    let start = close - said.unwrap_or(inside).len();
    let again = read(&format!("{:start$}{}", "", &text[start..close]), symbols).ok()?;
    let (same, its, shows) = measured(&again)?;
    if dimension != its || !(shown || shows) || matches!(again.content, Content::Relations(..)) {
        return None;
    }
    // A whole number in front is what it is.
    let decimal = first.literal.as_ref().is_some_and(|l| l.decimal);
    let rounded = decimal && rounds(&first, &value, &same) || rounds(&again, &same, &value);
    let sign = match rounded {
        true => Relation::Approximately,
        false => Relation::Equal,
    };
    let (mut sides, mut signs) = match first.content {
        Content::Relations(sides, signs) => (sides, signs),
        value => (vec![value], Vec::new()),
    };
    sides.push(again.content);
    signs.push(sign);
    first.content = Content::Relations(sides, signs);
    first.written.extend(again.written);
    Some(first)
}

/// The value alone that a text says again in brackets; a fault where these say another one.
pub(crate) fn said_once<'t>(text: &'t str, symbols: &Symbols) -> Option<Faulty<&'t str>> {
    let reading = said_again(text, symbols)?;
    let (open, close) = last_brackets(text)?;
    let (sides, signs) = reading.content.relations()?;
    let value = |side: &Content| match side {
        Content::Quantity(q) => q.value.evaluate(&Point::<f64>::default()),
        side => side.expr()?.evaluate(&Point::<f64>::default()),
    };
    let ([.., first, again], Some(sign)) = (sides, signs.last()) else {
        return None;
    };
    let (first, again) = (value(first)?, value(again)?);
    let same = (first - again).abs() <= 1e-12 * first.abs();
    Some(match same || *sign == Relation::Approximately {
        true => Ok(&text[..open]),
        false => Err(Fault::new(
            "brackets behind a value say another one",
            open,
            close,
        )),
    })
}

/// Where the brackets open and close that end a text behind a space.
fn last_brackets(text: &str) -> Option<(usize, usize)> {
    let ends = |c: char| c.is_whitespace() || "$.".contains(c);
    let inside = text.trim_end_matches(ends).strip_suffix([')', ']'])?;
    let open = inside.rfind(['(', '['])?;
    let spaced = text[..open].ends_with(|c: char| c.is_whitespace() || c == '~');
    let digits = |part: &str| part.contains(|c: char| c.is_ascii_digit());
    (spaced && digits(&text[..open]) && digits(&inside[open..])).then_some((open, inside.len()))
}

/// The value and dimension of a reading that is a number, and whether it shows a unit, or a degree or percent sign.
fn measured(reading: &Reading) -> Option<(Expr, Dimension, bool)> {
    let shape = reading.written.last();
    let marked = shape.is_some_and(|w| matches!(w.shape, Shape::Degrees(_)) || w.is_percentage());
    match reading.content.answer() {
        Content::Quantity(q) => Some((q.value.clone(), q.unit.dimension.clone(), true)),
        // What a percentage says again may be a plain number.
        Content::Scalar(e) if marked || reading.literal.is_some() => {
            Some((e.clone(), Dimension::none(), marked))
        }
        _ => None,
    }
}

/// Whether a value as written is another one, up to half a unit of its last digit, and not just the same.
fn rounds(reading: &Reading, value: &Expr, exact: &Expr) -> bool {
    let of = |e: &Expr| e.evaluate(&Point::<f64>::default());
    let digits = |literal: &Literal| 10f64.powi(literal.place) / 2.0;
    let (Some(literal), Some(mine), Some(exact)) = (&reading.literal, of(value), of(exact)) else {
        return false;
    };
    let unit = match reading.content.answer() {
        Content::Quantity(q) => of(&q.unit.value()).unwrap_or(1.0),
        _ => 1.0,
    };
    let off = (mine - exact).abs();
    off > 1e-12 * mine.abs() && off <= digits(literal) * unit * (1.0 + 1e-9)
}
