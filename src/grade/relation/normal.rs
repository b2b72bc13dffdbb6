//! Relations as `difference rel 0`, and a text of them as the systems of which one holds.

use num_traits::Signed;
use std::cmp::Ordering;

use super::sign_of;
use crate::algebra::Sign;
use crate::domain::Domains;
use crate::expr::{Expr, Function, Node};
use crate::formula::Relation;

/// `left − right  rel  0`, turned so that the relation is one of =, ≠, <, ≤.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Normal {
    pub(super) difference: Expr,
    pub(super) relation: Relation,
}

impl Normal {
    pub(super) fn new(difference: Expr, relation: Relation) -> Normal {
        Normal {
            difference,
            relation,
        }
    }

    /// The same relation of another difference.
    pub(super) fn of(&self, difference: Expr) -> Normal {
        Normal::new(difference, self.relation)
    }
}

/// A power vanishes where its base does.
pub(super) fn rooted(difference: Expr) -> Expr {
    match difference.node() {
        Node::Power(base, k) if k.as_number().is_some_and(Signed::is_positive) => base.clone(),
        _ => difference,
    }
}

/// What holds where none of several bounds does: nothing where a case has more than one, or some value may be missing.
pub(super) fn negated(cases: &Cases, domains: &Domains) -> Option<Vec<Normal>> {
    let everywhere = |part: &Expr| match part.node() {
        Node::Power(base, k) => k.as_number().is_some_and(|k| {
            let whole = k.is_integer() || sign_of(base, domains).is_some_and(Sign::is_not_negative);
            whole && !k.is_negative()
        }),
        Node::Call(function, _) => {
            matches!(function, Function::Abs | Function::Sin | Function::Cos)
        }
        _ => true,
    };
    let turned = |case: &Vec<Normal>| match case.as_slice() {
        [n] if n.difference.parts().all(everywhere) => {
            let relation = match n.relation {
                Relation::Less => Relation::LessEqual,
                Relation::LessEqual => Relation::Less,
                _ => return None,
            };
            Some(Normal::new(-&n.difference, relation))
        }
        _ => None,
    };
    cases.iter().map(turned).collect()
}

/// `e = 0`.
pub(super) fn equation(e: &Expr) -> Normal {
    Normal::new(e.clone(), Relation::Equal)
}

/// The differences of all sides of two systems.
pub(super) fn differences<'n>(
    expected: impl IntoIterator<Item = &'n Normal>,
    answer: impl IntoIterator<Item = &'n Normal>,
) -> Vec<&'n Expr> {
    let all = expected.into_iter().chain(answer);
    all.map(|n| &n.difference).collect()
}

/// Systems of relations of which one holds.
pub(super) type Cases = [Vec<Normal>];

/// Whether `difference relation 0` holds for a difference of this sign.
pub(super) fn holds(relation: Relation, sign: Option<Ordering>) -> bool {
    match sign {
        None => false,
        Some(sign) => match relation {
            Relation::NotEqual => sign.is_ne(),
            Relation::Less => sign.is_lt(),
            Relation::LessEqual => sign.is_le(),
            Relation::Greater => sign.is_gt(),
            Relation::GreaterEqual => sign.is_ge(),
            _ => sign.is_eq(),
        },
    }
}

/// Whether there is nothing but equations.
pub(super) fn equations_alone(expected: &Cases, answer: &Cases) -> bool {
    let mut all = expected.iter().chain(answer).flatten();
    all.all(|n| n.relation == Relation::Equal)
}
