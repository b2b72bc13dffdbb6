//! Tokens of formulas: numbers, names, functions and signs, each with its place.

use super::Relation;
use super::fault::Fault;
use crate::dimension::Unit;
use crate::expr::{Function, Rational, Symbol};

/// A number as written.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Literal {
    /// Exact value.
    pub value: Rational,
    /// Significant digits: `0.050` has two.
    pub digits: u32,
    /// Power of ten of the last digit: −3 for `0.050`.
    pub place: i32,
    /// Whether a decimal point or an exponent was written.
    pub decimal: bool,
}

impl Literal {
    /// A number of one digit.
    pub(crate) fn of(value: Rational) -> Literal {
        Literal {
            value,
            digits: 1,
            place: 0,
            decimal: false,
        }
    }
}

/// A token.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Tok {
    End,
    Number(Literal),
    Name(Symbol),
    Call(Function),
    Reciprocal(Function),
    /// The logarithm to a whole base.
    Logarithm(i64),
    /// The logarithm to the base that follows as an argument.
    LogarithmTo,
    /// The inverse of a hyperbolic function, or of the reciprocal of a sine, cosine or tangent.
    Area(Function),
    /// A function of two arguments.
    Pair(Pair),
    /// The base of the natural logarithm, which shows its exponent behind.
    Exponential,
    /// `\over`
    Over,
    /// The sign of what follows.
    Signum,
    /// The determinant of what follows.
    Determinant,
    /// A root of index 2 or 3.
    Root(i64),
    Fraction,
    Plus,
    Minus,
    PlusMinus,
    MinusPlus,
    Times,
    /// ×: the product of numbers, or the cross product of vectors.
    Cross,
    Slash,
    Caret,
    Raised(Rational),
    Open(char),
    Close(char),
    Bar,
    OpenBar,
    CloseBar,
    Comma,
    /// The end of a row of a matrix.
    EndOfRow,
    Relation(Relation),
    Vulgar(i64, i64),
    Degree,
    Percent(i64),
    Unit(Box<Unit>),
}

/// A token and its place.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Token {
    pub tok: Tok,
    pub start: usize,
    pub end: usize,
    /// Whether a space stands before it.
    pub spaced: bool,
}

/// What stood before, as far as it decides how the next piece is read.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Before {
    Nothing,
    Number { decimal: bool },
    Value,
}

impl Token {
    pub fn fault(&self, message: impl Into<String>) -> Box<Fault> {
        Fault::new(message, self.start, self.end)
    }
}

/// A function of two arguments.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Pair {
    /// `root(x, n)`, the root of index n.
    Root,
    /// `atan2(y, x)`, the angle from the x axis to a vector.
    Angle,
    /// `hypot(x, y)`, the length of a vector.
    Length,
    /// `max(a, b)`
    Greater,
    /// `min(a, b)`
    Smaller,
    /// `pow(x, n)`, as programs write a power.
    Power,
}

impl Pair {
    /// The function with this name.
    pub(super) fn named(word: &str) -> Option<Pair> {
        Some(match word.to_ascii_lowercase().as_str() {
            "root" | "nthroot" => Pair::Root,
            "atan2" | "arctan2" => Pair::Angle,
            "hypot" => Pair::Length,
            "max" => Pair::Greater,
            "min" => Pair::Smaller,
            "pow" => Pair::Power,
            _ => return None,
        })
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Pair::Root => "root",
            Pair::Angle => "atan2",
            Pair::Length => "hypot",
            Pair::Greater => "max",
            Pair::Smaller => "min",
            Pair::Power => "pow",
        }
    }
}

/// A function by name; capitals are accepted.
pub(super) fn function(word: &str) -> Option<Tok> {
    if word.len() < 2 || word.len() > 7 {
        return None;
    }
    let mut lower = [0u8; 7];
    for (to, from) in lower.iter_mut().zip(word.bytes()) {
        *to = from.to_ascii_lowercase();
    }
    use Function::*;
    Some(match &lower[..word.len()] {
        b"sin" => Tok::Call(Sin),
        b"cos" => Tok::Call(Cos),
        b"tan" => Tok::Call(Tan),
        b"tg" => Tok::Call(Tan),
        b"lg" => Tok::Logarithm(10),
        b"asin" | b"arcsin" => Tok::Call(Asin),
        b"acos" | b"arccos" => Tok::Call(Acos),
        b"atan" | b"arctan" | b"arctg" => Tok::Call(Atan),
        b"sinh" => Tok::Call(Sinh),
        b"cosh" => Tok::Call(Cosh),
        b"tanh" => Tok::Call(Tanh),
        b"exp" => Tok::Call(Exp),
        b"ln" | b"log" => Tok::Call(Ln),
        b"abs" => Tok::Call(Abs),
        b"asinh" | b"arsinh" | b"arcsinh" => Tok::Area(Sinh),
        b"acosh" | b"arcosh" | b"arccosh" => Tok::Area(Cosh),
        b"atanh" | b"artanh" | b"arctanh" => Tok::Area(Tanh),
        b"acsc" | b"arccsc" => Tok::Area(Sin),
        b"asec" | b"arcsec" => Tok::Area(Cos),
        b"acot" | b"arccot" | b"arcctg" => Tok::Area(Tan),
        b"sech" => Tok::Reciprocal(Cosh),
        b"csch" | b"cosech" => Tok::Reciprocal(Sinh),
        b"coth" => Tok::Reciprocal(Tanh),
        b"sec" => Tok::Reciprocal(Cos),
        b"csc" | b"cosec" => Tok::Reciprocal(Sin),
        b"cot" | b"cotg" | b"ctg" => Tok::Reciprocal(Tan),
        b"sqrt" => Tok::Root(2),
        b"cbrt" => Tok::Root(3),
        _ => return None,
    })
}

/// Largest decimal exponent.
pub(crate) const MAX_EXPONENT: i64 = 400;
