//! What is said of two formulas: equal, with the ground and what it takes for granted; different, with a point; or not known,
//! with what was seen.

use crate::domain::Sample;
use crate::expr::{Expr, Rational};
use crate::interval::Enclosure;

/// The answer with what it rests on.
#[derive(Clone, PartialEq, Debug)]
pub struct Decision {
    /// The answer.
    pub equality: Equality,
    /// Domains assumed for undeclared symbols, in words: `m > 0`.
    pub assumed: Vec<String>,
}

impl Decision {
    /// The same said of the two in the other order.
    pub(super) fn turned(mut self) -> Decision {
        match &mut self.equality {
            Equality::Different(point)
            | Equality::Same {
                how: How::OnBranch {
                    elsewhere: point, ..
                },
            } => std::mem::swap(&mut point.left, &mut point.right),
            Equality::Invalid { side, .. } => *side = side.other(),
            Equality::Same { .. } | Equality::Undecided { .. } => {}
        }
        self
    }
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

impl Equality {
    /// Whether the two are equal, and be it on a part of the domain.
    pub fn is_same(&self) -> bool {
        matches!(self, Equality::Same { .. })
    }

    /// Whether they are equal, and be it on a part of the domain; `None` where that is open.
    pub fn holds(&self) -> Option<bool> {
        match self {
            Equality::Same { .. } => Some(true),
            Equality::Different(_) | Equality::Invalid { .. } => Some(false),
            Equality::Undecided { .. } => None,
        }
    }

    /// Whether they are proved equal on the whole domain, with no sign that was only seen.
    pub fn is_identity(&self) -> bool {
        let Equality::Same { how } = self else {
            return false;
        };
        let is_seen = |a: &Assumption| matches!(a, Assumption::NotNegative(_));
        matches!(how, How::Identity { assumptions, .. } if !assumptions.iter().any(is_seen))
    }

    /// Whether a point tells them apart.
    pub fn is_different(&self) -> bool {
        matches!(self, Equality::Different(_))
    }
}

/// How equality is known.
#[derive(Clone, PartialEq, Debug)]
pub enum How {
    /// The difference is zero on the whole domain.
    Identity {
        /// Why it is zero.
        ground: Ground,
        /// What the proof took for granted; empty for most pairs.
        assumptions: Vec<Assumption>,
    },
    /// Equal on a part of the domain only.
    OnBranch {
        /// Where.
        condition: Condition,
        /// A point of the rest where the two part.
        elsewhere: Counterexample,
    },
}

/// Why a difference is zero.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Ground {
    /// Its normal form is.
    NormalForm,
    /// It is a whole number of turns everywhere, and less than one.
    Turns,
    /// It is a sum of logarithms, and what stands under them makes one.
    Logarithms,
    /// Its coefficients are algebraic numbers smaller than any of their kind that is not zero.
    Bound,
    /// It is at as many points as its degree asks for.
    Lattice,
}

impl Ground {
    /// The same in words.
    pub fn words(self) -> &'static str {
        match self {
            Ground::NormalForm => "the difference is zero in the normal form",
            Ground::Turns => "the difference is a whole number of turns, and less than one",
            Ground::Logarithms => "the difference is the logarithm of one",
            Ground::Bound => {
                "the numbers in the difference are closer to zero than any of their kind that is not zero"
            }
            Ground::Lattice => {
                "the difference is a polynomial that is zero at as many points as its degree asks for"
            }
        }
    }
}

/// What a proof took for granted.
#[derive(Clone, PartialEq, Debug)]
pub enum Assumption {
    /// The expression is ≥ 0 on the whole domain, which was seen at points but not proved.
    NotNegative(Expr),
    /// The expression is ≥ 0 wherever both formulas have values.
    HasRoot(Expr),
    /// This isolated point is left out: one formula has no value there.
    NotAt(Sample),
    /// Where the expression is zero only one formula has a value.
    NotZero(Expr),
}

/// The part of a domain on which two formulas are equal.
#[derive(Clone, PartialEq, Debug)]
pub enum Condition {
    /// Where the expression is ≥ 0.
    NotNegative(Expr),
    /// Where both formulas have a value; elsewhere one of them has none.
    BothDefined,
}

/// Which of the two formulas.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum Side {
    Left,
    Right,
}

impl Side {
    fn other(self) -> Side {
        match self {
            Side::Left => Side::Right,
            Side::Right => Side::Left,
        }
    }
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
    /// The normal forms differ, yet at every point tried the values agree to the precision reached.
    NoPointApart,
    /// The normal forms differ, but a function occurs whose laws they do not know.
    UnknownLaws,
    /// The limit named here was met.
    Limit(String),
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
    /// A point at which the values were told apart twice, or only one of them is.
    pub(super) fn confirmed(at: &Sample, left: Value, right: Value) -> Counterexample {
        Counterexample {
            at: at.clone(),
            left,
            right,
            confirmed: true,
        }
    }

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
