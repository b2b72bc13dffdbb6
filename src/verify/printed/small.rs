//! What is printed for small quantities: the powers of them up to the last one that is printed, and how far that goes.

use std::collections::BTreeMap;

use crate::expr::{Expr, Symbol};

/// Highest power of what is small that is looked at.
const MOST: usize = 6;

/// One number by which everything small shrinks.
const SHARE: &str = "share of what is small";

/// An expression with all that is small as a share of itself.
fn shrunk(e: &Expr, small: &[String]) -> Expr {
    let share = Expr::symbol(&Symbol::from(SHARE));
    let each = small.iter().map(|name| {
        let name = Symbol::from(name.as_str());
        let shrunk = &share * &Expr::symbol(&name);
        (name, shrunk)
    });
    e.substitute(&each.collect::<BTreeMap<_, _>>())
}

/// The terms of an expression of each power of what is small, from the zeroth.
fn terms(e: &Expr, small: &[String]) -> impl Iterator<Item = Expr> {
    let share = Symbol::from(SHARE);
    let slopes = std::iter::successors(Some((1, Expr::one(), shrunk(e, small))), {
        let share = share.clone();
        move |(n, part, slope)| {
            let part = part * &Expr::ratio(1, *n);
            Some((n + 1, part, slope.derivative(&share)))
        }
    });
    slopes.map(move |(_, part, slope)| part * slope.put(&share, &Expr::zero()))
}

/// An expression up to a power of what is small.
pub(super) fn up_to(e: &Expr, small: &[String], order: usize) -> Expr {
    match small {
        [] => e.clone(),
        small => Expr::sum(terms(e, small).take(order + 1)),
    }
}

/// The power of what is small up to which something is printed, and whether that is all of it: the highest of a polynomial, of
/// anything else that with which it begins.
pub(super) fn order(e: &Expr, small: &[String]) -> (usize, bool) {
    let share = Symbol::from(SHARE);
    let slopes = std::iter::successors(Some(shrunk(e, small)), |slope| {
        Some(slope.derivative(&share))
    });
    let degree = slopes
        .take(MOST + 1)
        .position(|slope| !slope.mentions(&share));
    let first = || {
        terms(e, small)
            .take(MOST + 1)
            .position(|term| !term.is_zero())
    };
    match degree {
        Some(degree) => (degree, true),
        None => (first().unwrap_or(0), false),
    }
}
