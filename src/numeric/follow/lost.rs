//! Why a stage was not followed to its end.

use std::fmt;

use crate::numeric::given::Undefined;

/// A stage that was not followed to its end.
#[derive(Clone, Debug, PartialEq)]
pub struct Lost {
    /// Its name.
    pub stage: String,
    /// Why.
    pub why: Loss,
}

/// Why a stage has no end that is known.
#[derive(Clone, Debug, PartialEq)]
pub enum Loss {
    /// Its laws, or the motion it begins with, contradict each other: what cannot hold, in words.
    Contradiction(String),
    /// The motion never gets to its end: what happens instead, in words.
    NeverEnds(String),
    /// A limit of the calculation was met, so that nothing is known: the limit, in words.
    OutOfReach(String),
    /// This quantity of the stage has no value at the point.
    Undefined(Undefined),
    /// The stage of this name, before it, was lost.
    After(String),
}

impl fmt::Display for Lost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.why {
            Loss::Contradiction(reason) => write!(f, "a contradiction: {reason}"),
            Loss::NeverEnds(reason) => write!(f, "it never gets to its end: {reason}"),
            Loss::OutOfReach(reason) => write!(f, "not followed: {reason}"),
            Loss::Undefined(quantity) => write!(f, "{quantity}"),
            Loss::After(lost) => write!(f, "`{lost}` before it does not get to its end"),
        }
    }
}

impl std::error::Error for Lost {}
