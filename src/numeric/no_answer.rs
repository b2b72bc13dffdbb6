//! Why a question has no number.

use std::fmt;

use super::given::{Reason, Undefined};
use super::path::NoPath;
use super::system::{Law, Unknown};
use super::values::NoPoint;

/// Why a question has no number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoAnswer {
    /// The equations leave it open.
    NotDetermined(Vec<Unknown>),
    /// A point or direction in the question has no value.
    Undefined(Undefined),
    /// The question asks for equations rather than numbers.
    NotANumber,
    /// These laws contradict each other, so there is no motion at all.
    Contradiction(Vec<Law>),
    /// The impact with friction has no end.
    NoPath(NoPath),
    /// A parameter has no value, or none in fractions.
    NoPoint(NoPoint),
    /// No enclosure tells the equations apart from singular ones; at irrational values that cannot be decided.
    Undecided,
}

impl NoAnswer {
    /// Whether it is wanting in this number type alone.
    pub fn is_of_number_type(&self) -> bool {
        matches!(self, NoAnswer::Undefined(undefined) if undefined.reason == Reason::NotANumber)
    }
}

impl fmt::Display for NoAnswer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoAnswer::NotDetermined(_) => f.write_str("not determined by the laws"),
            NoAnswer::Undefined(undefined) => write!(f, "{undefined}"),
            NoAnswer::NotANumber => f.write_str("asks for an equation, not for a number"),
            NoAnswer::Contradiction(_) => f.write_str("the laws contradict each other"),
            NoAnswer::NoPath(why) => write!(f, "{why}"),
            NoAnswer::NoPoint(why) => write!(f, "{why}"),
            NoAnswer::Undecided => f.write_str(
                "the values are irrational and the equations cannot be told from singular ones\nhint: take angles with rational cosine and sine, such as acos(3/5)",
            ),
        }
    }
}

impl std::error::Error for NoAnswer {}
