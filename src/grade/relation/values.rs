//! Where the parts of a relation have values: what logarithms, roots and divisors ask for.
//!
//! In: relations. Out: what has to hold besides them, and where only one of two holds for want of a value. A part that cancels, or that only one of two relations has, asks for it
//! all the same.

use super::defined::{asked_by, constant_sign, only_symbol};

use super::normal::holds;
use super::zeros::zeros;
use super::{Normal, sign_of};
use crate::algebra::Sign;
use crate::answer::calc::constant;
use crate::domain::{Domain, Domains, Limit, roles};
use crate::expr::{Expr, Symbol, ratio};
use crate::formula::Relation;

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
