//! Relations in one symbol: their solutions along its domain, exactly.
//!
//! The zeros of all differences cut the domain into numbers and intervals on which every relation holds or does not. Absolute
//! values are cut where what they are taken of changes sign: on each part they are that or its negative.

use std::cmp::Ordering;

use super::Normal;
use super::solved::replaced;
use crate::algebra::{Cell, Field};
use crate::domain::{Domains, roles};
use crate::expr::{Expr, Function, Node, Rational, Symbol};
use crate::formula::Relation;
use crate::interval::Enclosure;

/// Most different absolute values.
const MOST_FOLDED: usize = 3;

/// Where two systems of relations hold.
#[derive(Debug)]
pub(super) struct Along {
    /// A number in words at which the first holds and the second does not.
    pub lost: Option<String>,
    /// The other way round.
    pub gained: Option<String>,
    /// Whether the first holds somewhere, and whether it does not somewhere; the same of the second.
    pub holds: [[bool; 2]; 2],
}

/// Compares two systems in one symbol; `None` where there are more, or the differences are no quotients of polynomials.
pub(super) fn compare(first: &[Normal], second: &[Normal], domains: &Domains) -> Option<Along> {
    let all: Vec<&Expr> = first.iter().chain(second).map(|n| &n.difference).collect();
    let uses = roles(&all);
    let mut names = uses.symbols.iter();
    let (name, role) = names.next()?;
    if names.next().is_some() || role.turns {
        return None;
    }
    let (domains, _) = domains.completed(&uses);
    // The differences for every choice of signs, then what absolute values are taken of.
    let folded = folded(&all)?;
    let choices = (0..1 << folded.len()).flat_map(|signs| {
        let folded = &folded;
        all.iter().map(move |e| unfolded(e, folded, signs))
    });
    let choices: Vec<Expr> = choices.chain(folded.iter().cloned()).collect();
    let mut field = Field::new(&domains);
    field.prepare(&choices);
    let elements: Option<Vec<_>> = choices.iter().map(|e| field.element(e).ok()).collect();
    let mut cells = field.signs_along(name, &elements?)?;
    for cell in &mut cells {
        let arguments = cell.signs.split_off(all.len() << folded.len());
        let signs = arguments.iter().enumerate().try_fold(0, |signs, (k, s)| {
            Some(signs | usize::from(s.as_ref()?.is_lt()) << k)
        })?;
        cell.signs.drain(..signs * all.len());
    }
    let mut out = Along {
        lost: None,
        gained: None,
        holds: [[false; 2]; 2],
    };
    for cell in &cells {
        let (mine, theirs) = cell.signs[..all.len()].split_at(first.len());
        let truth = [(first, mine), (second, theirs)].map(|(system, signs)| {
            let links = system.iter().zip(signs);
            links
                .into_iter()
                .all(|(link, sign)| holds(link.relation, *sign))
        });
        for (seen, truth) in out.holds.iter_mut().zip(truth) {
            seen[usize::from(!truth)] = true;
        }
        match truth {
            [true, false] => out.lost = out.lost.take().or_else(|| Some(words(cell, name))),
            [false, true] => out.gained = out.gained.take().or_else(|| Some(words(cell, name))),
            _ => {}
        }
    }
    Some(out)
}

/// What absolute values are taken of; `None` where these are too many or one stands inside another.
fn folded(all: &[&Expr]) -> Option<Vec<Expr>> {
    let arguments = |e: &Expr| {
        let mut found = Vec::new();
        e.walk(&mut |part| {
            if let Node::Call(Function::Abs, x) = part.node() {
                found.push(x.clone());
            }
        });
        found
    };
    let mut out: Vec<Expr> = all.iter().flat_map(|e| arguments(e)).collect();
    out.sort();
    out.dedup();
    let plain = out.len() <= MOST_FOLDED && out.iter().all(|x| arguments(x).is_empty());
    plain.then_some(out)
}

/// A formula with each absolute value taken as what stands inside, or as its negative where the bit is set.
fn unfolded(e: &Expr, folded: &[Expr], signs: usize) -> Expr {
    let arguments = folded.iter().enumerate();
    arguments.fold(e.clone(), |e, (k, x)| {
        let branch = if signs >> k & 1 == 1 { -x } else { x.clone() };
        replaced(&e, &Expr::call(Function::Abs, x.clone()), &branch)
    })
}

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

fn words(cell: &Cell, name: &Symbol) -> String {
    let [low, high] = &cell.around;
    let short = |x: &Rational| x.denom().bits() < 20;
    let value = match low == high && short(low) {
        true => low.to_string(),
        false => Enclosure {
            low: Enclosure::of(low, 64).low,
            high: Enclosure::of(high, 64).high,
        }
        .decimal(6),
    };
    format!("{name} = {value}")
}
