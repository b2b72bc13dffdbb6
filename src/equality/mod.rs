//! When are two formulas equal: proved, refuted at a point that can be checked by hand, or honestly undecided.
//!
//! In: two expressions and the domain their symbols live in. Out: a [`Decision`]. Refutation needs no algebra: unequal exact
//! fractions at an exact point of the domain, or disjoint enclosures there. Proof is `algebra`'s normal form. Nothing here is
//! probabilistic: agreement at points is evidence and is called that.

mod arcs;
mod branch;
mod constants;
mod critical;
mod exact;
mod gap;
mod line;

mod measure;
mod proof;
mod refute;

use crate::domain::{Domain, Domains, Roles, Sample, roles, samples};
use crate::expr::{Expr, Rational};
use crate::interval::Enclosure;
pub(crate) use line::zero_apart;
use measure::Size;
pub(crate) use measure::work;
use proof::Proof;
use refute::{Probe, Tally};

/// Points tried before any proof.
const FIRST: usize = 2;
/// Products of terms beyond which a proof costs more than a look at many digits.
const COSTLY: usize = 2_000_000;

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
    /// Its coefficients are algebraic numbers smaller than any of their kind that is not zero.
    Bound,
}

impl Ground {
    /// The same in words.
    pub fn words(self) -> &'static str {
        match self {
            Ground::NormalForm => "the difference is zero in the normal form",
            Ground::Turns => "the difference is a whole number of turns, and less than one",
            Ground::Bound => {
                "the numbers in the difference are closer to zero than any of their kind that is not zero"
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

/// Decides whether two formulas have the same value everywhere on the domain.
///
/// Same result on every machine: limits count points, nodes and bits.
pub fn decide(a: &Expr, b: &Expr, domains: &Domains) -> Decision {
    let too_large = || Decision {
        equality: Equality::Undecided {
            reason: Reason::TooLarge,
            evidence: Evidence::default(),
        },
        assumed: Vec::new(),
    };
    let Some(size) = measure::of(&[a, b]) else {
        return too_large();
    };
    let roles = roles(&[a, b]);
    let Some(size) = size.with(&roles) else {
        return too_large();
    };
    let (domains, assumed) = domains.completed(&roles);
    Decision {
        equality: decide_on(a, b, &domains, &roles, size),
        assumed,
    }
}

fn decide_on(a: &Expr, b: &Expr, domains: &Domains, roles: &Roles, size: Size) -> Equality {
    let probe = Probe::new(a, b, roles);
    let mut tally = Tally::default();
    let different = |found: Counterexample| {
        let how = if size.branches {
            branch::equal_where(a, b, domains, roles, &found)
        } else {
            None
        };
        how.map_or(Equality::Different(found), |how| Equality::Same { how })
    };
    // The simplest points first: nearly every wrong formula fails there.
    let first = samples(roles, domains, FIRST);
    if let Some(found) = probe.points(&first, &mut tally) {
        return different(found);
    }
    // Roots and logarithms lack values on whole parts of a domain; more points show it.
    let mut points = first;
    let mut extend = |tally: &mut Tally, count: usize| {
        let more = samples(roles, domains, count);
        let new: Vec<Sample> = more.into_iter().filter(|p| !points.contains(p)).collect();
        let found = probe.points(&new, tally);
        points.extend(new);
        found
    };
    let signed = domains.symbols.values().any(Domain::changes_sign);
    let seen = if signed || tally.both_defined == 0 {
        8
    } else {
        5
    };
    let look = size.partial || tally.both_defined == 0;
    if look && let Some(found) = extend(&mut tally, size.points().min(seen)) {
        return different(found);
    }
    // Then where roots and absolute values ask for: both sides of the places where their arguments change sign.
    let arguments = match size.branches || size.partial {
        true => critical::arguments(&[a, b]),
        false => Vec::new(),
    };
    let unsure = arguments.iter().map(|(e, _)| e);
    let unsure = unsure.filter(|e| !critical::nowhere_negative(e, domains));
    let unsure: Vec<Expr> = unsure.cloned().collect();
    let risky = match unsure.as_slice() {
        [] => Vec::new(),
        unsure => {
            let near = samples(roles, domains, FIRST + 2);
            critical::points(unsure, &near, domains, roles)
        }
    };
    if let Some(found) = probe.points(&risky, &mut tally) {
        return different(found);
    }
    if a != b && work(a).saturating_add(work(b)) > COSTLY {
        let first = samples(roles, domains, FIRST);
        if let Some(found) = probe.rising_precision(&first, size, &mut Tally::default()) {
            return different(found);
        }
    }
    let proof = if a == b && tally.both_defined > 0 {
        Proof::Equal(Vec::new(), Ground::NormalForm)
    } else {
        match proof::compare(a, b, domains) {
            Proof::Equal(assumed, ground) => Proof::Equal(assumed, ground),
            Proof::Invalid(side) => Proof::Invalid(side),
            open => {
                let known = matches!(open, Proof::Unequal { settled: true });
                let arcs = || arcs::prove(a, b, domains);
                let arcs = if known { None } else { arcs() };
                arcs.or_else(|| constants::prove(a, b, domains))
                    .or_else(|| {
                        // Both have values only where what they take roots of is not negative.
                        let needed = arguments.iter().filter(|(e, n)| *n && unsure.contains(e));
                        let needed: Vec<Expr> = needed.map(|(e, _)| e.clone()).collect();
                        let (proof, used) = proof::compare_where_defined(a, b, domains, &needed)?;
                        let Proof::Equal(mut assumed, ground) = proof else {
                            return None;
                        };
                        assumed.extend(used.into_iter().map(Assumption::HasRoot));
                        Some(Proof::Equal(assumed, ground))
                    })
                    .unwrap_or(open)
            }
        }
    };
    match proof {
        Proof::Invalid(side) => {
            return Equality::Invalid {
                side,
                points: tally.undefined(side),
            };
        }
        Proof::Equal(assumptions, ground) if tally.both_defined > 0 => {
            // A sign that was only seen is put to the test first.
            let near = samples(roles, domains, FIRST + 2);
            match critical::tested(&assumptions, &near, domains, roles) {
                Ok(assumptions) => return gap::same((a, b), domains, assumptions, ground, &tally),
                Err(points) => {
                    if let Some(found) = probe.points(&points, &mut tally) {
                        return different(found);
                    }
                    return Equality::Undecided {
                        reason: Reason::NoPointApart,
                        evidence: tally.evidence(),
                    };
                }
            }
        }
        _ => {}
    }
    if let Some(found) = extend(&mut tally, size.points()) {
        return different(found);
    }
    for (side, e) in [(Side::Left, a), (Side::Right, b)] {
        if tally.defined(side) > 0 || tally.undefined(side) == 0 {
            continue;
        }
        // Constants have one point only; elsewhere no value at points is no proof.
        let needed = critical::arguments(&[e]).into_iter();
        let needed: Vec<Expr> = needed
            .filter(|(_, needed)| *needed)
            .map(|(e, _)| e)
            .collect();
        if roles.symbols.is_empty() || critical::nowhere(&needed, domains) {
            return Equality::Invalid {
                side,
                points: tally.undefined(side),
            };
        }
    }
    if let Some(found) = probe.rising_precision(&points, size, &mut tally) {
        return different(found);
    }
    let reason = match proof {
        _ if tally.both_defined == 0 => Reason::NoPoint,
        // A point at which both have a value was found only now.
        Proof::Equal(assumptions, ground) => {
            return gap::same((a, b), domains, assumptions, ground, &tally);
        }
        Proof::Unequal { settled: true } => Reason::NoPointApart,
        Proof::Unequal { settled: false } => Reason::UnknownLaws,
        Proof::Stopped(limit) => Reason::Limit(limit),
        Proof::Invalid(side) => {
            return Equality::Invalid {
                side,
                points: tally.undefined(side),
            };
        }
    };
    Equality::Undecided {
        reason,
        evidence: tally.evidence(),
    }
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
