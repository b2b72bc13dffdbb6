//! Reads plain formulas in one pass, straight into values: numbers modulo a prime, polynomials, whatever a [`Builder`] makes.
//!
//! What comes in is text and a table of names; what comes out is a value and an echo of how the text was read. No tree
//! is built. Only formulas of the everyday kind are taken: sums, products, quotients, powers, roots, sine and its kin of
//! angles. Everything else (units, bars, relations, vectors, accents, faults) makes this reader decline, and so does
//! every place where it is not sure to read as [`super::read`] does; tests hold the two together. It never says no.

mod angle;
mod factor;
mod names;
mod number;
mod reader;
mod terms;
mod word;

pub use angle::Angle;
pub use names::Names;
use reader::{Peek, Reader};
pub(crate) use word::keyword;

use crate::expr::Function;

/// Longest formula read here, in bytes.
const LONGEST: usize = 4000;

/// What a formula is read into. Each step may decline by `None`.
pub trait Builder {
    /// A value.
    type Value;
    /// The number `digits`/10^`tens`.
    fn number(&mut self, digits: u64, tens: u32) -> Option<Self::Value>;
    /// The name with this index.
    fn symbol(&mut self, index: usize, name: &[u8]) -> Option<Self::Value>;
    /// The circle constant.
    fn pi(&mut self) -> Option<Self::Value>;
    /// −a.
    fn negative(&mut self, a: Self::Value) -> Option<Self::Value>;
    /// a + b.
    fn sum(&mut self, a: Self::Value, b: Self::Value) -> Option<Self::Value>;
    /// a·b.
    fn product(&mut self, a: Self::Value, b: Self::Value) -> Option<Self::Value>;
    /// a/b.
    fn quotient(&mut self, a: Self::Value, b: Self::Value) -> Option<Self::Value>;
    /// a to the power of `halves`/2, which is not 0.
    fn power(&mut self, a: Self::Value, halves: i32) -> Option<Self::Value>;
    /// Sine, cosine or the like of an angle; `names` are those of the angle's parts.
    fn turn(&mut self, ratio: Ratio, angle: &Angle, names: &[&[u8]]) -> Option<Self::Value>;
}

/// Sine, cosine or tangent, or the reciprocal of one.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Ratio {
    /// Sine, cosine or tangent.
    pub function: Function,
    /// Whether 1 is divided by it.
    pub reciprocal: bool,
}

/// The names a formula is read with.
#[derive(Debug)]
pub enum Table<'a> {
    /// These and no others.
    Known(&'a Names),
    /// Whatever occurs, entered here.
    Collect(&'a mut Names),
}

impl Table<'_> {
    #[inline]
    fn get(&self) -> &Names {
        match self {
            Table::Known(names) => names,
            Table::Collect(names) => names,
        }
    }
}

/// What was read besides the value.
#[derive(Clone, Debug, Default)]
pub struct Seen {
    /// The formula in plain notation, every product with its sign.
    pub echo: String,
    /// The names that occur, as bits by their index.
    pub names: u64,
    /// Those of them that occur under a sine or its kin, and those that occur elsewhere.
    pub turned: u64,
    /// See `turned`.
    pub bare: u64,
    /// Places that people read in another way too.
    pub choices: u32,
}

/// Reads a formula into a value; `None` where it is not of the kind this reader is for.
pub fn stream<B: Builder>(
    text: &str,
    names: Table,
    build: &mut B,
    seen: &mut Seen,
) -> Option<B::Value> {
    if text.len() > LONGEST {
        return None;
    }
    // Dollars around the whole; elsewhere they could part a formula from words.
    let text = text.trim_matches(|c: char| c.is_ascii_whitespace() || c == '$');
    let echo = std::mem::take(&mut seen.echo).into_bytes();
    let mut reader = Reader {
        text: text.as_bytes(),
        at: 0,
        width: 0,
        found: (usize::MAX, Peek::End),
        end: 0,
        before: false,
        depth: 0,
        names,
        build,
        echo,
        seen: Seen::default(),
    };
    reader.echo.clear();
    reader.echo.reserve(2 * text.len());
    let read = reader.sum();
    let whole = read.is_some() && matches!(reader.peek(), Some(Peek::End));
    let (echo, found) = (reader.echo, reader.seen);
    *seen = found;
    // Only ASCII is echoed.
    seen.echo = String::from_utf8(echo).unwrap_or_default();
    read.filter(|_| whole).map(|(value, _)| value)
}

#[cfg(test)]
mod tests;
