//! Where the parts of a relation have values: what logarithms, roots and divisors ask for.
//!
//! In: relations. Out: what has to hold besides them. A part that cancels, or that only one of two relations has, asks for it
//! all the same.

use std::collections::BTreeSet;

use num_integer::Integer;
use num_traits::Signed;

use super::{Normal, sign_of};
use crate::algebra::Sign;
use crate::answer::calc::constant;
use crate::domain::Domains;
use crate::expr::{Expr, Function, Node, Symbol};
use crate::formula::Relation;

/// What has to hold for a part to have a value beside the parts in it; `None` where that is not known.
pub(super) fn has_value(part: &Expr) -> Option<Option<Normal>> {
    let positive = |e: &Expr| Normal::new(-e, Relation::Less);
    Some(match part.node() {
        Node::Call(Function::Ln, inside) => Some(positive(inside)),
        Node::Call(Function::Abs | Function::Exp, _) => None,
        Node::Call(..) if !part.symbols().is_empty() => return None,
        Node::Power(base, k) => match k.as_number() {
            Some(k) if k.is_integer() => k
                .is_negative()
                .then(|| Normal::new(base.clone(), Relation::NotEqual)),
            // Of an odd root a negative may have a value too.
            Some(k) if k.denom().is_odd() => return None,
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

fn only_symbol(sides: [&Expr; 2]) -> Option<Symbol> {
    let all: BTreeSet<Symbol> = sides.iter().flat_map(|side| side.symbols()).collect();
    let mut all = all.into_iter();
    all.next().filter(|_| all.next().is_none())
}

/// Whether a logarithm or a root that only one of two relations in one symbol has may leave it without a value where the other
/// holds. A divisor leaves out single values, which are told.
pub(super) fn may_lack_values(expected: &Normal, answer: &Normal, domains: &Domains) -> bool {
    let sides = [&expected.difference, &answer.difference];
    let Some(name) = only_symbol(sides) else {
        return false;
    };
    let domains = &domains.of(&sides);
    let asks = |n: &Normal| -> Vec<Expr> {
        let asked = asked_by(&n.difference).map(|(_, need)| need);
        let sided = asked.filter(|need| need.relation != Relation::NotEqual);
        sided.map(|need| -need.difference).collect()
    };
    let only = |own: &Normal, other: &Normal| {
        let shared = asks(other);
        let alone = asks(own).into_iter().filter(|x| !shared.contains(x));
        let is_sure = |x: &Expr| {
            let is_there = |sign: Option<Sign>| sign.is_some_and(Sign::is_not_negative);
            is_there(sign_of(x, domains)) || is_there(sign_where(x, &name, other, domains))
        };
        alone.filter(|x| !is_sure(x)).count() > 0
    };
    only(expected, answer) || only(answer, expected)
}

/// The sign of a formula where a relation holds: at the one value of an equation that is solved, or on one side of a bound.
fn sign_where(x: &Expr, name: &Symbol, n: &Normal, domains: &Domains) -> Option<Sign> {
    let slope = n.difference.derivative(name);
    match n.relation {
        Relation::Equal if slope.is_constant() => {
            let value = -(&n.difference.put(name, &Expr::zero()) / &slope);
            let x = x.put(name, &value);
            sign_of(&x, domains).or_else(|| constant(&x))
        }
        Relation::Less | Relation::LessEqual => {
            let closed = n.relation == Relation::LessEqual;
            sign_of(x, &domains.given(&-&n.difference, closed))
        }
        _ => None,
    }
}
