//! What can be decided about one expression on a scene's domain: zero or not, its sign, a point where it breaks a bound.
//!
//! In: an expression and domains. Out: an answer of three, with the point that refutes. Nothing is guessed: doubles count
//! only as enclosures, and what cannot be told is said to be unknown.

use super::Scene;
use crate::domain::{Domains, roles, samples};
use crate::equality::{self, Equality, How};
use crate::expr::{Expr, Point};
use crate::interval::{Interval, Outcome, evaluate};

/// Whether an expression is zero on the whole domain.
pub(super) enum Zero {
    /// Proved.
    Yes,
    /// Refuted at this point, in words.
    No(String),
    /// Not known.
    Unknown,
}

/// Whether an expression is zero on the whole domain.
pub(super) fn zero(e: &Expr, domains: &Domains) -> Zero {
    if e.is_zero() {
        return Zero::Yes;
    }
    if e.as_number().is_some() {
        return Zero::No(String::new());
    }
    match equality::decide(e, &Expr::zero(), domains).equality {
        Equality::Same {
            how: How::Identity { .. },
        } => Zero::Yes,
        Equality::Same {
            how: How::OnBranch { elsewhere, .. },
        } => Zero::No(elsewhere.at.words()),
        Equality::Different(point) => Zero::No(point.at.words()),
        Equality::Invalid { .. } | Equality::Undecided { .. } => Zero::Unknown,
    }
}

/// How many points of the domain are tried.
const POINTS: usize = 24;

/// A value that is wrong for certain, and the point in words: the given values first, then points of the domain.
pub(super) fn violation(
    e: &Expr,
    scene: &Scene,
    given: &Given,
    is_wrong: impl Fn(&Interval) -> bool,
) -> Option<(f64, String)> {
    let enclosed = |at: &Given| match evaluate::<Interval>(e, at) {
        Outcome::Value(value) if is_wrong(&value) => Some(middle(&value)),
        _ => None,
    };
    if let Some(value) = enclosed(given) {
        return Some((value, String::new()));
    }
    let roles = roles(&[e]);
    let points = samples(&roles, &scene.domains, POINTS);
    points
        .iter()
        .find_map(|p| Some((enclosed(&p.point(roles.radians))?, p.words())))
}

/// Enclosures of the values of parameters.
pub(super) type Given = Point<Outcome<Interval>>;

/// A double to show for an enclosure.
pub(super) fn middle(value: &Interval) -> f64 {
    value.low + (value.high - value.low) / 2.0
}
