//! Where equations hold: two of them compared by the parts of their numerators that may vanish.
//!
//! In: the differences of two equations over a domain. Out: whether every part that only one of them has vanishes nowhere, or
//! where the other vanishes too; else a point at which one holds and the other does not.

use super::normal::Normal;
use super::solved::{rounded, solution_apart, solve_for, unknowns, words_at};
use super::{pair, sign_of};
use crate::algebra::{Element, Field, Sign};
use crate::domain::{Domains, roles, samples};
use crate::equality::identical;
use crate::equality::zero_apart;
use crate::expr::{Expr, Symbol};
use crate::formula::Relation;
use crate::interval::Interval;
use std::collections::BTreeSet;

/// A point in words, with the value there of the difference that does not vanish.
pub(super) type Point = (String, Expr);

/// Most points from which a zero is looked for.
const STARTS: usize = 6;
/// Most roots squared away.
const ROOTS: usize = 4;

/// A part of one equation that the other lacks.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub expr: Expr,
    /// A point at which it vanishes and the other equation does not hold; `None` where none was found.
    pub at: Option<Point>,
}

/// Whether an equation has solutions.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Extent {
    /// It holds everywhere.
    All,
    /// It holds at some points and not at others.
    Some,
    /// It holds nowhere.
    None,
    Unknown,
}

/// Two equations.
pub(super) struct Compared {
    /// Parts of the first that the second lacks and that may vanish where it does not hold.
    pub lost: Vec<Part>,
    /// The other way round.
    pub gained: Vec<Part>,
    /// The symbols of the parts they share, and those that stand in a part of each.
    pub shared: BTreeSet<Symbol>,
    pub extents: [Extent; 2],
}

/// Compares the solutions of `f = 0` and `g = 0`; `None` where their normal forms cannot be found.
pub(super) fn compare(f: &Expr, g: &Expr, domains: &Domains) -> Option<Compared> {
    let domains = domains.of(&[f, g]);
    let (field, x, y) = pair(f, g, &domains)?;
    let zero = [field.is_zero(&x), field.is_zero(&y)];
    if zero != [false, false] {
        let extents = [&x, &y].map(|x| match field.is_zero(x) {
            true => Extent::All,
            false => {
                let parts = field.zeros(x);
                extent(&field, &written(&field, &parts), &domains)
            }
        });
        return Some(Compared {
            lost: Vec::new(),
            gained: Vec::new(),
            shared: BTreeSet::new(),
            extents,
        });
    }
    let split = field.split_zeros(&x, &y).ok()?;
    let [mut lost, mut shared, mut gained] = [0, 1, 2].map(|i| written(&field, &split[i]));
    if shared.is_empty() {
        // Roots squared away may show what the two share: √y = √x and y = x.
        let (plain_x, plain_y) = (squared(&field, &x)?, squared(&field, &y)?);
        let again = field.split_zeros(&plain_x, &plain_y).ok()?;
        shared = written(&field, &again[1]);
    }
    // What is the only part of an equation vanishes with the equation, which may be much shorter as it was written.
    for (parts, whole) in [(&mut lost, f), (&mut gained, g)] {
        if let ([(_, part)], true) = (&mut parts[..], shared.is_empty())
            && whole.size() < part.size()
        {
            *part = whole.clone();
        }
    }
    let part = |(element, expr): (Element, Expr), own: &Expr, other: &Expr| {
        if field.sign(&element).is_some_and(Sign::is_strict) {
            return None;
        }
        if covered(&expr, other, &domains) {
            return None;
        }
        let at = vanishing(&expr, [other, own], &domains);
        Some(Part { expr, at })
    };
    let extents = [&lost, &gained]
        .map(|parts| extent(&field, &[parts.as_slice(), &shared].concat(), &domains));
    // A factor of both that is zero nowhere says nothing of its symbols: `(m + M) v = (m + M) w` is about v and w.
    let symbols = |parts: &[(Element, Expr)]| -> BTreeSet<Symbol> {
        parts.iter().flat_map(|(_, e)| e.symbols()).collect()
    };
    let mut open = shared.clone();
    open.retain(|(x, _)| !field.sign(x).is_some_and(Sign::is_strict));
    let symbols = &symbols(&open) | &(&symbols(&lost) & &symbols(&gained));
    Some(Compared {
        lost: lost.into_iter().filter_map(|p| part(p, f, g)).collect(),
        gained: gained.into_iter().filter_map(|p| part(p, g, f)).collect(),
        shared: symbols,
        extents,
    })
}

/// The numerator with all square roots squared away.
pub(super) fn squared(field: &Field, x: &Element) -> Option<Element> {
    let mut x = x.clone();
    for _ in 0..ROOTS {
        match field.without_root(&x).ok()? {
            Some(norm) if !field.is_zero(&norm) => x = norm,
            _ => break,
        }
    }
    Some(x)
}

fn written(field: &Field, parts: &[Element]) -> Vec<(Element, Expr)> {
    parts.iter().map(|x| (x.clone(), field.expr(x))).collect()
}

/// Whether a product of parts vanishes somewhere on the domain.
fn extent(field: &Field, parts: &[(Element, Expr)], domains: &Domains) -> Extent {
    let strict = |x: &Element| field.sign(x).is_some_and(Sign::is_strict);
    let mut left = parts.iter().filter(|(x, _)| !strict(x)).peekable();
    if left.peek().is_none() {
        return Extent::None;
    }
    let one = Expr::one();
    match left.any(|(_, x)| vanishing(x, [&one, x], domains).is_some()) {
        true => Extent::Some,
        false => Extent::Unknown,
    }
}

/// Whether `other` vanishes wherever `part` does: what the part is with its roots squared away divides it, or is linear in
/// some symbol and, solved for it, turns it into zero. Parts without a common symbol say nothing of each other.
fn covered(part: &Expr, other: &Expr, domains: &Domains) -> bool {
    if part.symbols().is_disjoint(&other.symbols()) {
        return false;
    }
    let pieces = || {
        let (field, x, y) = pair(part, other, domains)?;
        let [left, _, _] = field.split_zeros(&squared(&field, &x)?, &y).ok()?;
        Some((field, left))
    };
    let Some((field, left)) = pieces() else {
        return false;
    };
    let strict = |x: &Element| field.sign(x).is_some_and(Sign::is_strict);
    left.iter()
        .all(|x| strict(x) || solved(&field.expr(x), other, domains))
}

/// Whether `part = 0`, solved for some symbol in which it is linear, turns `other` into zero identically.
fn solved(part: &Expr, other: &Expr, domains: &Domains) -> bool {
    unknowns(part, part).iter().any(|name| {
        let root = solve_for(part, name, domains);
        root.is_some_and(|root| identical(&other.put(name, &root), &Expr::zero(), domains))
    })
}

/// A point of the domain at which `part`, of what has a value there, vanishes and `other` does not.
pub(super) fn vanishing(part: &Expr, [other, own]: [&Expr; 2], domains: &Domains) -> Option<Point> {
    if let Some(found) = solution_apart(part, [other, own], domains) {
        return Some(found);
    }
    let uses = roles(&[part, other, own]);
    let (domains, _) = domains.completed(&uses);
    // Along the only symbol every line is the same.
    let starts = if uses.symbols.len() == 1 { 1 } else { STARTS };
    for start in samples(&uses, &domains, starts) {
        for name in part.symbols() {
            let Some(domain) = domains.symbols.get(&name) else {
                continue;
            };
            if domains.is_component(&name) {
                continue;
            }
            if let Some([root, value]) = zero_apart(part, [other, own], &name, &start, domain)
                && let (Some(low), Some(high)) = (root.low.nearest(), root.high.nearest())
                && domains.admits_with(&start, &name, Interval::new(low, high))
            {
                return Some((words_at(&start, &name, &root), rounded(&value)));
            }
        }
    }
    None
}

/// Where a relation `difference < 0` or `≤ 0` holds on a domain, as far as the sign of its difference tells.
pub(super) fn by_sign(n: &Normal, domains: &Domains) -> Extent {
    match (sign_of(&n.difference, domains), n.relation) {
        (Some(Sign::Negative), _) => Extent::All,
        (Some(Sign::NotPositive | Sign::Zero), Relation::LessEqual) => Extent::All,
        (Some(Sign::Positive), _) => Extent::None,
        (Some(Sign::NotNegative | Sign::Zero), Relation::Less) => Extent::None,
        (Some(_), _) => Extent::Unknown,
        (None, _) => Extent::Some,
    }
}
