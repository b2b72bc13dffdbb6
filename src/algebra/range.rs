//! Ranges of variables with their ends, and what is known of the sign of a polynomial on them.

use super::Sign;
use crate::expr::{Rational, ratio};

/// Ends of an interval; `None` is infinite.
#[derive(Clone, Debug)]
pub(crate) struct Interval {
    pub low: Option<(Rational, bool)>,
    pub high: Option<(Rational, bool)>,
}

impl Interval {
    /// The open interval between two fractions.
    pub fn open(low: Rational, high: Rational) -> Interval {
        let [low, high] = [low, high].map(|end| Some((end, true)));
        Interval { low, high }
    }

    /// Whether it lies between two fractions.
    pub fn is_within(&self, low: &Rational, high: &Rational) -> bool {
        let is_low = self.low.as_ref().is_some_and(|(end, _)| end >= low);
        is_low && self.high.as_ref().is_some_and(|(end, _)| end <= high)
    }

    /// Everything above zero.
    pub fn above_zero(open: bool) -> Interval {
        let low = Some((ratio(0, 1), open));
        Interval { low, high: None }
    }
}

/// What a variable that stands for another one may also be.
#[derive(Clone, Copy, Debug)]
pub(crate) struct End {
    pub v: usize,
    /// It may be 0.
    pub zero: bool,
    /// It may be infinite, where only terms of this degree in it count.
    pub infinite: Option<u32>,
}

/// What is known of the sign of a polynomial on a domain.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Found {
    Proved(Sign),
    /// Both signs occur.
    Mixed,
    Unknown,
}
