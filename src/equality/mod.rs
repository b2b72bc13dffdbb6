//! When are two formulas equal: proved, refuted at a point that can be checked by hand, or honestly undecided.
//!
//! In: two expressions and the domain their symbols live in. Out: a [`Decision`]. Refutation needs no algebra: unequal exact
//! fractions at an exact point of the domain, or disjoint enclosures there. Proof is `algebra`'s normal form. Nothing here is
//! probabilistic: agreement at points is evidence and is called that.

mod exact;
mod measure;
mod refute;

use crate::domain::{Domains, Roles, Sample, roles, samples};
use crate::expr::{Expr, Rational};
use crate::interval::Enclosure;
use refute::{Probe, Tally};

/// The answer with what it rests on.
#[derive(Clone, PartialEq, Debug)]
pub struct Decision {
    /// The answer.
    pub equality: Equality,
    /// Domains assumed for undeclared symbols, in words: `m > 0`.
    pub assumed: Vec<String>,
}

/// Whether two formulas have the same value on their domain.
#[derive(Clone, PartialEq, Debug)]
pub enum Equality {
    /// Equal.
    Same {
        /// How it is known, and where.
        how: How,
    },
    /// Not equal: here is a point.
    Different(Counterexample),
    /// A formula that has no value at any point tried, such as one with a denominator that is identically zero.
    Invalid {
        /// Which one.
        side: Side,
        /// At how many points of the domain it was shown to have no value.
        points: usize,
    },
    /// Not known.
    Undecided {
        /// What stood in the way.
        reason: Reason,
        /// What was seen.
        evidence: Evidence,
    },
}

/// How equality is known.
#[derive(Clone, PartialEq, Debug)]
pub enum How {
    /// The difference is zero in the normal form.
    Identity {
        /// What the proof divided by or took the sign of, in words; empty for most pairs.
        assumptions: Vec<String>,
    },
    /// Equal on a part of the domain only.
    OnBranch {
        /// Where, in words: `v ≥ 0`.
        condition: String,
        /// A point of the rest where the two part.
        elsewhere: Counterexample,
    },
}

/// Which of the two formulas.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum Side {
    Left,
    Right,
}

/// A point of the domain at which two formulas have different values.
#[derive(Clone, PartialEq, Debug)]
pub struct Counterexample {
    /// The point.
    pub at: Sample,
    /// Value of the first formula.
    pub left: Value,
    /// Value of the second formula.
    pub right: Value,
    /// Whether a second evaluation, in dyadic intervals, separates the two as well.
    pub confirmed: bool,
}

/// A value at a point.
#[derive(Clone, PartialEq, Debug)]
pub enum Value {
    /// A fraction.
    Exact(Rational),
    /// A real number within these bounds.
    Within(Enclosure),
    /// No real value: a division by zero or the root of a negative number.
    None,
}

/// What was seen of two formulas that could be neither proved equal nor told apart.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Evidence {
    /// Points at which both have the same exact value.
    pub exact_points: usize,
    /// Points at which both were enclosed and the enclosures overlap.
    pub enclosed_points: usize,
    /// Decimal digits to which they agree at the best enclosed point.
    pub digits: u32,
}

/// Why no answer was reached.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Reason {
    /// The formulas are longer or deeper than the limit.
    TooLarge,
    /// No point of the domain could be found or evaluated.
    NoPoint,
    /// One formula has a value where the other has none, although they agree elsewhere.
    DefinedApart(Side),
    /// The normal form could not be reached, or it does not know some function's laws.
    NotProved(String),
}

/// Decides whether two formulas have the same value everywhere on the domain.
///
/// Same result on every machine: limits count points, nodes and bits.
pub fn decide(a: &Expr, b: &Expr, domains: &Domains) -> Decision {
    let Some(size) = measure::of(&[a, b]) else {
        let equality = Equality::Undecided {
            reason: Reason::TooLarge,
            evidence: Evidence::default(),
        };
        return Decision {
            equality,
            assumed: Vec::new(),
        };
    };
    let roles = roles(&[a, b]);
    let (domains, assumed) = domains.completed(&roles);
    Decision {
        equality: decide_on(a, b, &domains, &roles, size),
        assumed,
    }
}

fn decide_on(
    a: &Expr,
    b: &Expr,
    domains: &Domains,
    roles: &Roles,
    size: measure::Size,
) -> Equality {
    let probe = Probe::new(a, b, roles);
    let mut tally = Tally::default();
    // The simplest points first: nearly every wrong formula fails there.
    let first = samples(roles, domains, 2);
    if let Some(found) = probe.points(&first, &mut tally) {
        return Equality::Different(found);
    }
    let certain = size.total_functions && tally.both_defined > 0;
    if certain && a == b {
        return Equality::Same {
            how: How::Identity {
                assumptions: Vec::new(),
            },
        };
    }
    let more = samples(roles, domains, size.points());
    let rest = more.get(first.len().min(more.len())..).unwrap_or_default();
    if let Some(found) = probe.points(rest, &mut tally) {
        return Equality::Different(found);
    }
    if let Some(verdict) = undefined(&tally) {
        return verdict;
    }
    if a == b && tally.both_defined > 0 {
        return Equality::Same {
            how: How::Identity {
                assumptions: Vec::new(),
            },
        };
    }
    if let Some(found) = probe.rising_precision(&more, size, &mut tally) {
        return Equality::Different(found);
    }
    let reason = if more.is_empty() || tally.is_empty() {
        Reason::NoPoint
    } else {
        Reason::NotProved("no proof was attempted".into())
    };
    Equality::Undecided {
        reason,
        evidence: tally.evidence(),
    }
}

/// What undefined values say about the pair.
fn undefined(tally: &Tally) -> Option<Equality> {
    let never = |undefined: usize, defined: usize| {
        undefined >= 4.min(tally.points) && undefined > 0 && defined == 0
    };
    if never(tally.left_undefined, tally.left_defined) {
        return Some(Equality::Invalid {
            side: Side::Left,
            points: tally.left_undefined,
        });
    }
    if never(tally.right_undefined, tally.right_defined) {
        return Some(Equality::Invalid {
            side: Side::Right,
            points: tally.right_undefined,
        });
    }
    None
}

impl Value {
    /// The value in words: a fraction, or a decimal number with the given number of significant digits.
    pub fn words(&self, digits: u32) -> String {
        match self {
            Value::Exact(v) => v.to_string(),
            Value::Within(e) => format!("≈ {}", e.decimal(digits)),
            Value::None => "no value".into(),
        }
    }
}

impl Counterexample {
    /// Both values in words, with as many digits as it takes to see the difference.
    pub fn values(&self) -> [String; 2] {
        let shown = |digits| [self.left.words(digits), self.right.words(digits)];
        for digits in [6, 9, 15, 30, 60, 120, 250, 500, 1000] {
            let pair = shown(digits);
            if pair[0] != pair[1] {
                return pair;
            }
        }
        shown(1300)
    }
}

#[cfg(test)]
mod tests;
