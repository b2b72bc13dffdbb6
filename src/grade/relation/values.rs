//! Where the parts of a relation have values: what logarithms, roots and divisors ask for.
//!
//! In: relations. Out: what has to hold besides them, and where only one of two holds for want of a value. A part that cancels, or that only one of two relations has, asks for it
//! all the same.

use std::cmp::Ordering;
use std::collections::BTreeSet;

use num_integer::Integer;
use num_traits::Signed;

use super::cells::holds;
use super::zeros::zeros;
use super::{Normal, sign_of};
use crate::algebra::{Sign, tidy};
use crate::answer::calc::constant;
use crate::domain::{Domain, Domains, Limit, roles};
use crate::equality::{self, Equality};
use crate::expr::{Expr, Function, Node, Symbol, ratio};
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
    let mut all = all.into_iter();
    all.next().filter(|_| all.next().is_none())
}

/// A number in words at which one of two relations holds and the other has no value, and whether the expected one holds there.
pub(super) type Hole = (String, bool);

/// The first number of the only symbol at which something is zero that one of two systems divides by, or that must not be zero
/// in it, and the other holds; `None` where there may be one that was not found. Each system has one relation beside what must
/// not be zero. In several symbols nothing is looked at.
pub(super) fn hole(
    expected: &[Normal],
    answer: &[Normal],
    domains: &Domains,
) -> Option<Option<Hole>> {
    let [(e, e_apart), (a, a_apart)] = [main(expected)?, main(answer)?];
    let Some(name) = only_symbol([&e.difference, &a.difference]) else {
        return Some(None);
    };
    let domains = one_turn(&[&e.difference, &a.difference], &name, domains);
    let mut is_sure = true;
    for (apart, others, other, is_lost) in [
        (&a_apart, &e_apart, e, true),
        (&e_apart, &a_apart, a, false),
    ] {
        for divisor in apart.iter().filter(|d| !others.contains(d)) {
            let is_strict = |sign: Option<Sign>| sign.is_some_and(Sign::is_strict);
            if is_strict(sign_of(divisor, &domains))
                || is_strict(sign_where(divisor, &name, other, &domains))
            {
                continue;
            }
            let Some(numbers) = zeros(divisor, &name, &domains) else {
                is_sure = false;
                continue;
            };
            let apart = |d: &Expr| Normal::new(d.clone(), Relation::NotEqual);
            for (at, place) in numbers {
                let all = others.iter().map(apart).chain([other.clone()]);
                let truths: Vec<_> = all.map(|n| holds_at(&n, &name, &at, &domains)).collect();
                if truths.contains(&Some(false)) {
                    continue;
                }
                if !truths.contains(&None) {
                    return Some(Some((format!("{name} = {}", place.decimal(6)), is_lost)));
                }
                is_sure = false;
            }
        }
    }
    is_sure.then_some(None)
}

/// The one relation of a system beside those that something is not zero, and all that must not be zero.
pub(super) fn main(system: &[Normal]) -> Option<(&Normal, Vec<Expr>)> {
    let is_beside = |n: &&Normal| system.len() > 1 && n.relation == Relation::NotEqual;
    let mut rest = system.iter().filter(|n| !is_beside(n));
    let main = rest.next().filter(|_| rest.next().is_none())?;
    let own = asked_by(&main.difference).map(|(_, need)| need);
    // A logarithm has no value of zero either.
    let divisors = own.filter(|need| need.relation != Relation::LessEqual);
    let beside = system.iter().filter(is_beside).cloned();
    Some((
        main,
        divisors.chain(beside).map(|need| need.difference).collect(),
    ))
}

/// The domains with one turn of a real symbol that only stands in sines, cosines and tangents.
pub(super) fn one_turn(all: &[&Expr], name: &Symbol, domains: &Domains) -> Domains {
    let (mut domains, _) = domains.completed(&roles(all));
    let whole = domains.symbols.get(name) == Some(&Domain::real());
    if let Some(role) = roles(all).symbols.get(name)
        && whole
        && role.turns
        && !role.bare
    {
        let ends = [0, 2 * i64::from(role.divisor)];
        let [low, high] = ends.map(|end| Some(Limit::pi(ratio(end, 1), false)));
        domains.symbols.insert(name.clone(), Domain::new(low, high));
    }
    domains
}

/// Whether a relation holds at a number.
pub(super) fn holds_at(n: &Normal, name: &Symbol, at: &Expr, domains: &Domains) -> Option<bool> {
    let sign = constant_sign(&n.difference.put(name, at), domains)?;
    Some(holds(n.relation, sign))
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

/// Whether a logarithm or a root that only one of two relations in one symbol has may leave it without a value where the other
/// holds.
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
