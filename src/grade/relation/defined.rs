//! Where an expression has a value, and the sign of a constant that has one.

use std::cmp::Ordering;
use std::collections::BTreeSet;

use num_integer::Integer;
use num_traits::Signed;

use super::normal::{Normal, holds};
use crate::algebra::tidy;
use crate::domain::Domains;
use crate::equality::{self, Equality};
use crate::expr::{Expr, Function, Node, Symbol, only};
use crate::formula::Relation;
use crate::interval::{Big, Outcome, evaluate};

/// What has to hold for a part to have a value beside the parts in it; `None` where that is not known.
pub(super) fn has_value(part: &Expr) -> Option<Option<Normal>> {
    let positive = |e: &Expr| Normal::new(-e, Relation::Less);
    Some(match part.node() {
        Node::Call(Function::Ln, inside) => Some(positive(inside)),
        Node::Call(Function::Tan, angle) => Some(Normal::new(angle.cos(), Relation::NotEqual)),
        Node::Call(Function::Asin | Function::Acos, x) => {
            Some(Normal::new(x.powi(2) - Expr::one(), Relation::LessEqual))
        }
        Node::Call(..) => None,
        Node::Power(base, k) => match k.as_number() {
            Some(k) if k.is_integer() => k
                .is_negative()
                .then(|| Normal::new(base.clone(), Relation::NotEqual)),
            // Of an odd root a negative may have a value too.
            Some(k) if k.denom().is_odd() => match k.is_negative() {
                true => Some(Normal::new(base.clone(), Relation::NotEqual)),
                false => return None,
            },
            Some(k) if k.is_negative() => Some(positive(base)),
            Some(_) => Some(Normal::new(-base, Relation::LessEqual)),
            None => Some(positive(base)),
        },
        _ => None,
    })
}

/// What the parts of a formula ask for, of those with a symbol in them.
pub(super) fn asked_by(e: &Expr) -> impl Iterator<Item = (&Expr, Normal)> {
    let parts = e.parts().filter(|part| !part.is_constant());
    let asked = parts.filter_map(|part| Some((part, has_value(part)??)));
    asked.filter(|(_, need)| !need.difference.is_constant())
}

/// Whether a relation has a value everywhere, or is in several symbols, where a product stands for its factors.
pub(super) fn has_values(n: &Normal) -> bool {
    n.difference.symbols().len() > 1 || asked_by(&n.difference).next().is_none()
}

/// The sign of a constant; the inner `None` where it has no value.
pub(super) fn constant_sign(e: &Expr, domains: &Domains) -> Option<Option<Ordering>> {
    match evaluate::<Big<200>>(e, &Default::default()) {
        Outcome::Undefined => return Some(None),
        Outcome::Value(v) if !v.0.has_zero() => return Some(Some(v.0.low.sign().cmp(&0))),
        _ => {}
    }
    match equality::decide(e, &Expr::zero(), domains).equality {
        Equality::Same { .. } => return Some(Some(Ordering::Equal)),
        Equality::Invalid { .. } => return Some(None),
        _ => {}
    }
    // √(cos π/2) − 1 in a shorter form, once all that stands in it has values.
    let plain = tidy(e, domains).ok().filter(|plain| plain != e)?;
    for part in e.parts() {
        if let Some(need) = has_value(part)? {
            let sign = constant_sign(&need.difference, domains)?;
            if !holds(need.relation, sign) {
                return Some(None);
            }
        }
    }
    constant_sign(&plain, domains)
}

/// What has to hold for the sides of a relation in one symbol to have values, of the parts that their difference has not.
pub(super) fn cancelled(sides: [&Expr; 2], difference: &Expr) -> Vec<Normal> {
    let mut out: Vec<Normal> = Vec::new();
    if only_symbol(sides).is_none() {
        return out;
    }
    let asked = sides.into_iter().flat_map(asked_by);
    for (_, need) in asked.filter(|(part, _)| !difference.parts().any(|left| left == *part)) {
        if !out.contains(&need) {
            out.push(need);
        }
    }
    out
}

pub(super) fn only_symbol(sides: [&Expr; 2]) -> Option<Symbol> {
    let all: BTreeSet<Symbol> = sides.iter().flat_map(|side| side.symbols()).collect();
    only(all)
}
