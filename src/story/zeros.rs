//! Where an expression vanishes, told factor by factor; and equations for an angle.
//!
//! In: an expression and the domains. Out: places in words, or values of an angle. An angle is solved for through the tangent
//! of its half, which makes sines and cosines fractions.

use std::collections::BTreeMap;

use num_integer::Integer;

use super::calc::{Root, Roots, Unsolved, is_zero, real, sign, solve, tidy};
use super::{Sentence, sentence::sentence};
use crate::domain::{Domain, Domains, Limit};
use crate::expr::{Expr, Function, Node, Rational, Symbol, ratio};

/// The tangent of half the angle.
const HALF: &str = "t_half";

/// The places where a product vanishes: values of a parameter, or an equation where there is no such value.
pub(super) fn of(e: &Expr, domains: &Domains) -> Vec<Sentence> {
    let factors: Vec<Expr> = match e.node() {
        Node::Product(factors) => factors.clone(),
        _ => vec![e.clone()],
    };
    let mut out = Vec::new();
    for factor in factors {
        let base = match factor.node() {
            Node::Power(_, k) if k.as_number().is_some_and(num_traits::Signed::is_negative) => {
                continue;
            }
            Node::Power(base, _) => base.clone(),
            _ => factor,
        };
        if base.as_number().is_some() || nowhere(&base, domains) {
            continue;
        }
        let symbols: Vec<Symbol> = base.symbols().into_iter().collect();
        let solved = match symbols.as_slice() {
            [only] => solve(&base, only, domains).ok(),
            _ => None,
        };
        match solved {
            Some(Roots {
                inside, open: None, ..
            }) if inside.iter().all(|r| r.proved) => {
                let name = &symbols[0];
                let places = inside.iter();
                out.extend(places.map(|r| sentence![name, " = ", &r.value]));
            }
            _ => out.push(sentence![&base, " = 0"]),
        }
    }
    out.sort();
    out.dedup();
    out
}

fn nowhere(e: &Expr, domains: &Domains) -> bool {
    use crate::algebra::Sign;
    matches!(
        sign(e, domains),
        super::calc::Seen::Proved(Sign::Positive | Sign::Negative)
    )
}

/// Values of an angle at which an expression in its sine and cosine vanishes.
pub(super) fn angle(e: &Expr, symbol: &Symbol, domains: &Domains) -> Result<Roots, Unsolved> {
    let domain = domains
        .symbols
        .get(symbol)
        .cloned()
        .unwrap_or_else(Domain::first_quadrant);
    let (Some(low), Some(high)) = (
        domain.low.as_ref().and_then(|l| half(l, true)),
        domain.high.as_ref().and_then(|l| half(l, false)),
    ) else {
        return Err(Unsolved::Inside);
    };
    let t = Expr::symbol(HALF);
    let below = Expr::one() + t.powi(2);
    let turned = swap(&tidy(e, domains)?, symbol, &t, &below).ok_or(Unsolved::Inside)?;
    let mut wide = domains.clone();
    wide.symbols.insert(
        HALF.into(),
        Domain {
            low: low.clone(),
            high: high.clone(),
        },
    );
    let found = match solve(&turned, &HALF.into(), &wide) {
        Ok(found) => found,
        // Only what is 0 for every tangent or for none is left.
        Err(Unsolved::Absent) => Roots::default(),
        Err(other) => return Err(other),
    };
    if found.open.is_some() {
        return Err(Unsolved::Inside);
    }
    let half_angle = &Expr::symbol(symbol) / &Expr::from(2);
    let back = BTreeMap::from([(Symbol::from(HALF), Expr::call(Function::Tan, half_angle))]);
    let mut out = Roots::default();
    for root in found.inside {
        let value = from_half(&root.value, &wide)?;
        let given = root.given.iter().map(|g| g.put_in(&back));
        // The conditions for the tangent to be real are those for the angle.
        let mut given: Vec<Sentence> = given.collect();
        for condition in real(&value, domains) {
            if !given.contains(&condition) {
                given.push(condition);
            }
        }
        out.inside.push(Root {
            value,
            proved: root.proved,
            given,
        });
    }
    // Half of a straight angle has no tangent.
    for (end, sign) in [(&domain.low, -1), (&domain.high, 1)] {
        let straight = end
            .as_ref()
            .is_some_and(|l| l.of_pi && l.value == ratio(sign, 1) && !l.open);
        let value = Expr::from(sign) * Expr::pi();
        let at = BTreeMap::from([(symbol.clone(), value.clone())]);
        if straight && is_zero(&e.substitute(&at), domains) == Some(true) {
            out.inside.push(Root {
                value,
                proved: true,
                given: Vec::new(),
            });
        }
    }
    Ok(out)
}

/// The tangent of half an end of the domain, where it is a fraction; the inner `None` is infinite.
fn half(end: &Limit, is_low: bool) -> Option<Option<Limit>> {
    if !end.of_pi && end.value != ratio(0, 1) {
        return None;
    }
    let quarters: Rational = &end.value * ratio(2, 1);
    let number = |n: i64| Some(Some(Limit::number(ratio(n, 1), end.open)));
    for n in -1..=1 {
        if quarters == ratio(n, 1) {
            return number(n);
        }
    }
    let straight = if is_low { ratio(-2, 1) } else { ratio(2, 1) };
    (quarters == straight).then_some(None)
}

/// Sines and cosines of the angle as fractions of the tangent of its half; `None` where the angle stands elsewhere too.
fn swap(e: &Expr, symbol: &Symbol, t: &Expr, below: &Expr) -> Option<Expr> {
    if !e.symbols().contains(symbol) {
        return Some(e.clone());
    }
    match e.node() {
        Node::Call(f, argument) if argument.as_symbol() == Some(symbol) => match f {
            Function::Sin => Some(&(Expr::from(2) * t.clone()) / below),
            Function::Cos => Some(&(Expr::one() - t.powi(2)) / below),
            Function::Tan => Some(&(Expr::from(2) * t.clone()) / &(Expr::one() - t.powi(2))),
            _ => None,
        },
        Node::Symbol(_) | Node::Number(_) | Node::Call(..) => None,
        _ => {
            let mut whole = true;
            let out = e.map_parts(|part| {
                swap(part, symbol, t, below).unwrap_or_else(|| {
                    whole = false;
                    part.clone()
                })
            });
            whole.then_some(out)
        }
    }
}

/// The angle with this tangent of its half, between −π and π, in the shortest of the usual ways.
fn from_half(t: &Expr, domains: &Domains) -> Result<Expr, Unsolved> {
    let square = t.powi(2);
    let below = Expr::one() + square.clone();
    let cos = tidy(&(&(Expr::one() - square) / &below), domains)?;
    let sin = tidy(&(&(Expr::from(2) * t.clone()) / &below), domains)?;
    // Of the angles a person knows by heart.
    for n in -11..=11i64 {
        for d in [1, 2, 3, 4, 6] {
            let angle = Expr::ratio(n, d) * Expr::pi();
            let same = |a: &Expr, b: Expr| is_zero(&(a - &b), domains) == Some(true);
            if n.abs() <= d && same(&cos, angle.cos()) && same(&sin, angle.sin()) {
                return Ok(angle);
            }
        }
    }
    let has_root = |e: &Expr| {
        let mut found = false;
        e.walk(&mut |part| {
            found |= matches!(part.node(), Node::Power(_, k) if k.as_number().is_some_and(|k| !k.is_integer()));
        });
        found
    };
    let bare = tidy(t, domains)?;
    if is_not_negative(&bare, domains) && !has_root(&cos) {
        return Ok(Expr::call(Function::Acos, cos));
    }
    let small = sign(&(Expr::one() - t.powi(2)), domains).is_positive();
    if small && !has_root(&sin) {
        return Ok(Expr::call(Function::Asin, sin));
    }
    if small {
        return Ok(Expr::call(Function::Atan, tidy(&(&sin / &cos), domains)?));
    }
    Ok(Expr::from(2) * Expr::call(Function::Atan, bare))
}

/// Whether an expression is positive or zero wherever it is real, as a product of roots, magnitudes and what is positive is.
fn is_not_negative(e: &Expr, domains: &Domains) -> bool {
    match e.node() {
        Node::Product(factors) => factors.iter().all(|f| is_not_negative(f, domains)),
        Node::Call(Function::Abs, _) => true,
        Node::Power(base, k) => {
            let even = |k: &Rational| k.denom().is_even() || k.numer().is_even();
            k.as_number().is_some_and(even) || is_not_negative(base, domains)
        }
        _ => sign(e, domains).is_positive(),
    }
}
