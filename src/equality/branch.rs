//! Formulas that part on one branch only: √(v²) is v where v ≥ 0.

use num_traits::Signed;

use super::proof::{self, Proof};
use super::refute::{enclosure, sign_at};
use super::{Condition, Counterexample, How};
use crate::domain::{Domains, Roles, samples};
use crate::expr::{Expr, Function, Node};

/// Branches tried; each costs one proof.
const BRANCHES: usize = 4;

/// Where two formulas known to part at a point are equal after all, if a condition on one sign tells it.
pub(super) fn equal_where(
    a: &Expr,
    b: &Expr,
    domains: &Domains,
    roles: &Roles,
    elsewhere: &Counterexample,
) -> Option<How> {
    let condition = on_half(a, b, domains, roles)
        .or_else(|| on_sign(a, b, domains, roles))
        .or_else(|| {
            if opposite(elsewhere) {
                on_square(a, b, domains, roles)
            } else {
                None
            }
        })?;
    if sign_at(&condition, &elsewhere.at) != Some(-1)
        || !parts_elsewhere(a, b, &condition, domains, roles)
    {
        return None;
    }
    Some(How::OnBranch {
        condition: Condition::NotNegative(condition),
        elsewhere: elsewhere.clone(),
    })
}

/// One symbol restricted to one sign.
fn on_half(a: &Expr, b: &Expr, domains: &Domains, roles: &Roles) -> Option<Expr> {
    let signed =
        |name: &&crate::expr::Symbol| domains.symbols.get(*name).is_some_and(|d| d.changes_sign());
    for name in roles.symbols.keys().filter(signed).take(BRANCHES) {
        for positive in [true, false] {
            let mut half = domains.clone();
            if let Some(domain) = half.symbols.get_mut(name) {
                *domain = domain.half(positive);
            }
            if proved(a, b, &half) {
                let symbol = Expr::symbol(name);
                return Some(if positive { symbol } else { -symbol });
            }
        }
    }
    None
}

/// One |f| or √(f²) replaced by f or −f throughout.
fn on_sign(a: &Expr, b: &Expr, domains: &Domains, roles: &Roles) -> Option<Expr> {
    let mut inner: Vec<&Expr> = Vec::new();
    for f in [a, b].into_iter().flat_map(Expr::parts).filter_map(folded) {
        if !inner.contains(&f) {
            inner.push(f);
        }
    }
    for f in inner.into_iter().take(BRANCHES) {
        for branch in [f.clone(), -f] {
            if proved(&unfold(a, f, &branch), &unfold(b, f, &branch), domains)
                && occurs(&branch, domains, roles)
            {
                return Some(branch);
            }
        }
    }
    None
}

/// A root a with a² = b² identically: equal where b ≥ 0.
fn on_square(a: &Expr, b: &Expr, domains: &Domains, roles: &Roles) -> Option<Expr> {
    [(a, b), (b, a)].into_iter().find_map(|(root, other)| {
        let square = |e: &Expr| Expr::product([e.clone(), e.clone()]);
        let fits = is_root(root)
            && proved(&square(root), &square(other), domains)
            && occurs(other, domains, roles);
        fits.then(|| other.clone())
    })
}

/// Whether the two part at every point tried where the condition fails, so that it tells the whole branch: |x + 1| and x + 1
/// are equal where x ≥ 0, but that is not what sets them apart.
fn parts_elsewhere(a: &Expr, b: &Expr, condition: &Expr, domains: &Domains, roles: &Roles) -> bool {
    let difference = a - b;
    samples(roles, domains, 10)
        .iter()
        .filter(|at| sign_at(condition, at) == Some(-1))
        .all(|at| sign_at(&difference, at).is_some_and(|s| s != 0))
}

fn proved(a: &Expr, b: &Expr, domains: &Domains) -> bool {
    matches!(proof::compare(a, b, domains), Proof::Equal(assumed, _) if assumed.is_empty())
}

/// Whether the values at a point may be each other's negative, as those of √(f²) and f are.
fn opposite(at: &Counterexample) -> bool {
    match (enclosure(&at.left), enclosure(&at.right)) {
        (Some(l), Some(r)) => !l.is_disjoint(&r.neg()),
        _ => false,
    }
}

/// Whether the condition f ≥ 0 holds at some point, so that it describes more than nothing.
fn occurs(f: &Expr, domains: &Domains, roles: &Roles) -> bool {
    samples(roles, domains, 8)
        .iter()
        .any(|at| sign_at(f, at) == Some(1))
}

fn is_root(e: &Expr) -> bool {
    match e.node() {
        Node::Power(_, exponent) => exponent.as_number().is_some_and(|k| !k.is_integer()),
        Node::Call(function, _) => *function == Function::Abs,
        _ => false,
    }
}

/// The f of |f| or (f^2n)^(k/2).
fn folded(e: &Expr) -> Option<&Expr> {
    match e.node() {
        Node::Call(Function::Abs, f) => Some(f),
        Node::Power(base, exponent) if exponent.as_number().is_some_and(|k| !k.is_integer()) => {
            match base.node() {
                Node::Power(f, even) => {
                    let half = even.as_number()? / crate::expr::ratio(2, 1);
                    (half.is_integer() && half.is_positive()).then_some(f)
                }
                _ => None,
            }
        }
        _ => None,
    }
}

/// Replaces |f| by `branch`, and (f^2n)^(k/2) by branch^(n k), for this one f.
pub(super) fn unfold(e: &Expr, f: &Expr, branch: &Expr) -> Expr {
    if folded(e) == Some(f) {
        return match e.node() {
            Node::Power(base, exponent) => match base.node() {
                Node::Power(_, even) => branch.power(even * exponent),
                _ => e.clone(),
            },
            _ => branch.clone(),
        };
    }
    e.map_parts(|part| unfold(part, f, branch))
}
