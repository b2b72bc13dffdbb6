//! Proof of equality by the normal form of the difference.

use super::{Assumption, Ground, Side};
use crate::algebra::{self, Field, Stop};
use crate::domain::Domains;
use crate::expr::Expr;

/// What the normal form says.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum Proof {
    /// The difference is zero, and why.
    Equal(Vec<Assumption>, Ground),
    /// The difference is not zero in the normal form. Whether that settles the matter is told by `settled`: not if a
    /// function occurs whose laws the normal form does not know.
    Unequal {
        settled: bool,
        /// What absolute values are taken of: where it changes sign, the two may part.
        folded: Vec<Expr>,
    },
    /// A formula divides by zero identically, or takes an even root of something negative everywhere.
    Invalid(Side),
    /// A limit was met.
    Stopped(String),
}

impl Proof {
    /// A proof of equality where besides these roots have values.
    pub(super) fn with_roots(self, roots: impl IntoIterator<Item = Expr>) -> Option<Proof> {
        let Proof::Equal(mut assumed, ground) = self else {
            return None;
        };
        assumed.extend(roots.into_iter().map(Assumption::HasRoot));
        Some(Proof::Equal(assumed, ground))
    }
}

/// Compares the normal forms of two formulas whose symbols are all declared.
pub(super) fn compare(a: &Expr, b: &Expr, domains: &Domains) -> Proof {
    let mut field = Field::new(domains);
    field.prepare([a, b]);
    compare_in(&mut field, a, b)
}

/// Compares them at points at which both have values: what they take roots and logarithms of is not negative there. With
/// what was used; `None` where nothing new is learnt.
pub(super) fn compare_where_defined(
    a: &Expr,
    b: &Expr,
    domains: &Domains,
    needed: &[Expr],
) -> Option<(Proof, Vec<Expr>)> {
    let mut field = Field::new(domains);
    field.prepare([a, b]);
    let used = needed.iter().filter(|e| field.suppose(e));
    let used: Vec<Expr> = used.cloned().collect();
    (!used.is_empty()).then(|| (compare_in(&mut field, a, b), used))
}

fn compare_in(field: &mut Field, a: &Expr, b: &Expr) -> Proof {
    let mut read = |e: &Expr, side: Side| match field.element(e) {
        Ok(element) => Ok(element),
        Err(Stop::TooLarge(what)) => Err(Proof::Stopped(what.into())),
        Err(Stop::DivisionByZero | Stop::NotReal) => Err(Proof::Invalid(side)),
    };
    let (left, right) = match (read(a, Side::Left), read(b, Side::Right)) {
        (Ok(left), Ok(right)) => (left, right),
        (Err(stop), _) | (_, Err(stop)) => return stop,
    };
    match field.sub(&left, &right) {
        Ok(difference) if field.is_zero(&difference) => {
            Proof::Equal(seen(field), Ground::NormalForm)
        }
        Ok(_) => Proof::Unequal {
            settled: field.complete(),
            folded: field.absolute(),
        },
        Err(stop) => Proof::Stopped(stop.to_string()),
    }
}

/// The signs that a field took for granted.
pub(super) fn seen(field: &Field) -> Vec<Assumption> {
    let assumed = field.assumptions().into_iter();
    assumed
        .map(|algebra::Assumption::NotNegative(e)| Assumption::NotNegative(e))
        .collect()
}
