//! Relations in one symbol: their solutions along its domain, exactly.
//!
//! The zeros of all differences cut the domain into numbers and intervals on which every relation holds or does not.

use std::cmp::Ordering;

use super::Normal;
use crate::algebra::{Cell, Field};
use crate::domain::{Domains, roles};
use crate::expr::{Expr, Rational, Symbol};
use crate::formula::Relation;
use crate::interval::Enclosure;

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
    let mut field = Field::new(&domains);
    field.prepare(all.iter().copied());
    let elements: Option<Vec<_>> = all.iter().map(|e| field.element(e).ok()).collect();
    let cells = field.signs_along(name, &elements?)?;
    let mut out = Along {
        lost: None,
        gained: None,
        holds: [[false; 2]; 2],
    };
    for cell in &cells {
        let (mine, theirs) = cell.signs.split_at(first.len());
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
