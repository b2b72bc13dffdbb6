//! Relations in one symbol without logarithms, exponentials and square roots: cases of polynomials, and what has to hold for
//! every part of the relation to have a value.

use std::cmp::Ordering;

use num_traits::{One, Signed, Zero};

use super::defined::{asked_by, has_value};
use super::normal::Cases;
use super::{Normal, equation, sign_of, undone};
use crate::algebra::{Sign, tidy};
use crate::domain::Domains;
use crate::expr::{Expr, Function, Node, Rational, Symbol, ratio};
use crate::formula::{Relation, write_plain};
use crate::interval::{Interval, Outcome, evaluate};

/// Most cases that come out.
pub(super) const MOST_CASES: usize = 48;
/// Functions that may stand in each other.
const DEPTH: usize = 6;
/// Highest power of a root.
const POWERS: i64 = 5;

/// Systems of relations of which one holds.
type Any = Vec<Vec<Normal>>;

/// The same cases without functions but absolute values; `None` where something else stands in them.
pub(super) fn plain(cases: &Cases, domains: &Domains) -> Option<Any> {
    let mut out = Vec::new();
    for system in cases {
        let mut all = vec![Vec::new()];
        for n in system {
            let mut needed = Vec::new();
            for part in n.difference.parts() {
                needed.extend(has_value(part)?);
            }
            // What cancels has left what it needs.
            let tidy = tidy(&n.difference, domains).unwrap_or_else(|_| n.difference.clone());
            let cancels = |part: &Expr| !tidy.parts().any(|left| left == part);
            let n = match asked_by(&n.difference).any(|(part, _)| cancels(part)) {
                true => &n.of(tidy),
                false => n,
            };
            for need in needed.iter().chain([n]) {
                all = both(all, without(need, domains, DEPTH)?)?;
            }
        }
        out.extend(all);
    }
    (out.len() <= MOST_CASES).then_some(out)
}

/// Both of two alternatives, without what says nothing.
fn both(one: Any, other: Any) -> Option<Any> {
    let holds = |n: &Normal| {
        let sign = match n.difference.as_number() {
            Some(k) => k.cmp(&Rational::zero()),
            None if !n.difference.is_constant() => return None,
            None => match evaluate::<Interval>(&n.difference, &Default::default()) {
                Outcome::Value(v) if v.high < 0.0 => Ordering::Less,
                Outcome::Value(v) if v.low > 0.0 => Ordering::Greater,
                _ => return None,
            },
        };
        Some(super::normal::holds(n.relation, Some(sign)))
    };
    let mut out: Any = Vec::new();
    for a in &one {
        for b in &other {
            let mut all: Vec<Normal> = Vec::new();
            for n in a.iter().chain(b).filter(|n| holds(n) != Some(true)) {
                if !all.contains(n) {
                    all.push(n.clone());
                }
            }
            if all.iter().all(|n| holds(n).is_none()) {
                out.push(all);
            }
        }
    }
    (out.len() <= MOST_CASES).then_some(out)
}

/// Whether a formula has a logarithm, an exponential or a root of a symbol.
fn is_plain(e: &Expr) -> bool {
    let simple = |part: &Expr| match part.node() {
        Node::Call(function, _) => *function == Function::Abs,
        Node::Power(_, k) => k.is_integer(),
        _ => true,
    };
    e.parts()
        .all(|part| part.symbols().is_empty() || simple(part))
}

/// The cases of a relation whose parts all have values.
fn without(n: &Normal, domains: &Domains, depth: usize) -> Option<Any> {
    let n = &n.of(tidied(&n.difference));
    if is_plain(&n.difference) {
        return Some(vec![vec![n.clone()]]);
    }
    // What is never zero where it has a value, such as an exponential.
    let sign = match sign_of(&n.difference, domains) {
        Some(Sign::Positive) => Some(Ordering::Greater),
        Some(Sign::Negative) => Some(Ordering::Less),
        _ => None,
    };
    if sign.is_some() {
        return Some(match super::normal::holds(n.relation, sign) {
            true => vec![Vec::new()],
            false => Vec::new(),
        });
    }
    let depth = depth.checked_sub(1)?;
    let next = |n: &Normal| without(n, domains, depth);
    let every = |systems: Vec<Vec<Normal>>| {
        let mut out = Vec::new();
        for system in systems {
            let mut all = vec![Vec::new()];
            for n in &system {
                all = both(all, next(n)?)?;
            }
            out.extend(all);
        }
        Some(out)
    };
    match n.difference.node() {
        Node::Product(factors)
            if factors.iter().filter(|f| f.as_number().is_none()).count() > 1 =>
        {
            return every(of_product(n.relation, factors));
        }
        Node::Power(base, k) if k.is_integer() => {
            return every(of_power(n, base, k.as_number()?));
        }
        _ => {}
    }
    if let Some((inside, p, q)) = by_root(&n.difference) {
        return every(of_root(n.relation, &inside, &p, &q));
    }
    let undone = undone::logarithms(n, domains).or_else(|| undone::exponents(n, domains))?;
    next(&undone.normal)
}

/// A formula without powers of powers and of products, and without what is zero or one, wherever every part has a value.
fn tidied(e: &Expr) -> Expr {
    let e = e.map_parts(tidied);
    match e.node() {
        Node::Product(factors) if factors.iter().any(Expr::is_zero) => Expr::zero(),
        Node::Power(base, k) if k.is_integer() => match base.node() {
            _ if k.is_zero() => Expr::one(),
            Node::Product(parts) => {
                Expr::product(parts.iter().map(|part| tidied(&part.power(k.clone()))))
            }
            Node::Power(inner, own) if own.as_number().is_some() => tidied(&inner.power(own * k)),
            _ => e,
        },
        _ => e,
    }
}

/// `f g rel 0` by the signs of both.
fn of_product(relation: Relation, factors: &[Expr]) -> Any {
    let first = factors.iter().position(|f| f.as_number().is_none());
    let mut rest = factors.to_vec();
    let f = &rest.remove(first.unwrap_or_default());
    let g = Expr::product(rest);
    let is = |e: &Expr| Normal::new(e.clone(), relation);
    match relation {
        Relation::Equal => vec![vec![is(f)], vec![is(&g)]],
        Relation::NotEqual => vec![vec![is(f), is(&g)]],
        _ => vec![vec![is(f), is(&-&g)], vec![is(&-f), is(&g)]],
    }
}

/// `base^k rel 0` with a whole k.
fn of_power(n: &Normal, base: &Expr, k: &Rational) -> Any {
    let odd = !(k * ratio(1, 2)).is_integer();
    let zero = match k.is_positive() {
        true => vec![vec![equation(base)]],
        false => Vec::new(),
    };
    match n.relation {
        Relation::Equal => zero,
        Relation::NotEqual => vec![vec![Normal::new(base.clone(), Relation::NotEqual)]],
        _ if odd => vec![vec![n.of(base.clone())]],
        Relation::LessEqual => zero,
        _ => Vec::new(),
    }
}

/// What stands under the first square root of a formula p + q √u, with p and q.
fn by_root(e: &Expr) -> Option<(Expr, Expr, Expr)> {
    let half = |k: &Rational| *k.denom() == *ratio(2, 1).numer();
    let root = |part: &Expr| match part.node() {
        Node::Power(u, k) if !u.symbols().is_empty() && k.as_number().is_some_and(half) => {
            Some(u.clone())
        }
        _ => None,
    };
    let inside = e.parts().find_map(root)?;
    let letter: Symbol = write_plain(&inside.sqrt()).into();
    let mut left = rootless(e, &inside, &Expr::symbol(&letter));
    let mut sums = [Expr::zero(), Expr::zero()];
    let mut scale = Rational::one();
    for k in 0..POWERS {
        let there = left.put(&letter, &Expr::zero()) * inside.powi(k / 2);
        let sum = &mut sums[usize::from(k % 2 == 1)];
        *sum = &*sum + &(there * Expr::from(scale.clone()));
        left = left.derivative(&letter);
        if left.is_zero() {
            let [p, q] = sums;
            return Some((inside, p, q));
        }
        scale /= ratio(k + 1, 1);
    }
    None
}

/// A formula with the roots of a radicand as a letter.
fn rootless(e: &Expr, inside: &Expr, letter: &Expr) -> Expr {
    match e.node() {
        Node::Power(base, k) if base == inside => match k.as_number() {
            Some(k) if !k.is_integer() => letter * &base.power(Expr::from(k.floor())),
            _ => e.clone(),
        },
        _ => e.map_parts(|part| rootless(part, inside, letter)),
    }
}

/// `p + q √u rel 0` where u is not negative: p² against q² u, by the signs of p and q.
fn of_root(relation: Relation, u: &Expr, p: &Expr, q: &Expr) -> Any {
    let gap = p.powi(2) - q.powi(2) * u;
    let is = |e: Expr| Normal::new(e, relation);
    let [below, at_most] =
        [Relation::Less, Relation::LessEqual].map(|r| move |e: Expr| Normal::new(e, r));
    match relation {
        Relation::Equal => vec![vec![is(gap), at_most(p * q)]],
        Relation::NotEqual => vec![vec![is(gap)], vec![below(-(p * q))]],
        _ => vec![
            vec![at_most(-q), is(p.clone()), is(-&gap)],
            vec![below(q.clone()), is(p.clone())],
            vec![below(q.clone()), at_most(-p), is(gap)],
        ],
    }
}
