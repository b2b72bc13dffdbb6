//! All numbers of a domain at which a formula in one symbol vanishes, in closed form.
//!
//! In: a formula, its symbol, domains. Out: the numbers, each put in and found to fulfil the equation. Parts are solved that are
//! of the first or second degree in the symbol, in an exponential, logarithm or root of it, or in sines and cosines of one
//! angle; where there is any other part nothing is told.

use std::cmp::Ordering;

use num_traits::Signed;

use super::defined::constant_sign;
use super::locus::squared;
use super::solved::Turning;
use super::{equation, pair, undone};
use crate::algebra::Sign;
use crate::answer::calc::constant;
use crate::domain::{Domain, Domains, Limit, roles};
use crate::equality;
use crate::expr::{Expr, Function, Node, Symbol, ratio};
use crate::interval::{Big, Enclosure, Outcome, evaluate};

/// Over how many half turns an angle may go.
const MOST_TURNS: f64 = 16.0;
/// Polynomials within polynomials.
const DEPTH: usize = 6;

/// A number with an enclosure of it.
pub(super) type Number = (Expr, Enclosure);

/// A constant with an enclosure of it.
pub(super) fn number(e: &Expr) -> Option<Number> {
    match evaluate::<Big<200>>(e, &Default::default()) {
        Outcome::Value(place) => Some((e.clone(), place.0)),
        _ => None,
    }
}

/// All numbers of its domain at which a formula vanishes; `None` where that is not sure.
pub(super) fn zeros(f: &Expr, name: &Symbol, domains: &Domains) -> Option<Vec<Number>> {
    among(f, name, domains, DEPTH)
}

fn among(f: &Expr, name: &Symbol, domains: &Domains, depth: usize) -> Option<Vec<Number>> {
    let depth = depth.checked_sub(1)?;
    let (domains, _) = domains.completed(&roles(&[f]));
    let domain = domains.symbols.get(name)?;
    let mut found: Vec<Number> = Vec::new();
    for root in roots(f, name, &domains, depth)? {
        let number = number(&root)?;
        if !lies_in(&number, domain, &domains)? {
            continue;
        }
        match found.iter().find(|(_, at)| !at.is_disjoint(&number.1)) {
            Some((other, _)) if equality::identical(other, &number.0, &domains) => continue,
            Some(_) => return None,
            None => {}
        }
        // Others are poles, or roots that squaring brought in.
        if constant_sign(&f.put(name, &number.0), &domains)? == Some(Ordering::Equal) {
            found.push(number);
        }
    }
    Some(found)
}

/// Numbers among which are all at which a formula vanishes.
fn roots(f: &Expr, name: &Symbol, domains: &Domains, depth: usize) -> Option<Vec<Expr>> {
    // Of one argument alone, sin 2x = cos 2x, as of an angle.
    if let Some(turning) = Turning::of(f, name, domains.symbols.get(name)?)
        && turning.argument.as_symbol() != Some(name)
    {
        let letter: Symbol = "argument of the functions".into();
        let call = |function, x: &Expr| Expr::call(function, x.clone());
        let inside = [Function::Sin, Function::Cos, Function::Tan].into_iter();
        let inside = inside.fold(f.clone(), |e, function| {
            let own = call(function, &turning.argument);
            e.replace(&own, &call(function, &Expr::symbol(&letter)))
        });
        let [from, to] = turning.span;
        if !inside.mentions(name) && to - from <= MOST_TURNS {
            let mut domains = domains.clone();
            let [low, high] =
                [from.floor(), to.ceil()].map(|end| Some(Limit::pi(ratio(end as i64, 1), false)));
            domains
                .symbols
                .insert(letter.clone(), Domain::new(low, high));
            let found = among(&inside, &letter, &domains, depth)?.into_iter();
            return Some(found.map(|(root, _)| turning.angle(root)).collect());
        }
    }
    let (field, x, _) = pair(f, &Expr::one(), domains)?;
    if field.is_zero(&x) {
        return None;
    }
    let parts = field.zeros(&squared(&field, &x)?);
    let weak = parts
        .iter()
        .filter(|part| !field.sign(part).is_some_and(Sign::is_strict));
    let all = weak.map(|part| candidates(&field.expr(part), name, domains, depth));
    Some(all.collect::<Option<Vec<_>>>()?.concat())
}

/// Whether a number lies in a domain, of whose ends it may be one.
pub(super) fn lies_in((value, place): &Number, domain: &Domain, domains: &Domains) -> Option<bool> {
    for (limit, is_low) in [(&domain.low, true), (&domain.high, false)] {
        let Some(limit) = limit else {
            continue;
        };
        let end = limit.expr();
        let (_, at) = number(&end)?;
        let is_outside = match at.is_disjoint(place) {
            true => (place.low > at.high) != is_low,
            false if equality::identical(value, &end, domains) => limit.open,
            false => return None,
        };
        if is_outside {
            return Some(false);
        }
    }
    Some(true)
}

/// Numbers among which are all at which a part vanishes.
fn candidates(p: &Expr, name: &Symbol, domains: &Domains, depth: usize) -> Option<Vec<Expr>> {
    if let Some(roots) = quadratic(p, name) {
        return Some(roots);
    }
    if let Some(roots) = turning(p, name, domains, depth) {
        return Some(roots);
    }
    let steps: [undone::Step; 3] = [undone::logarithms, undone::exponents, undone::powers];
    let undone = |step: undone::Step| step(&equation(p), domains);
    let plain = steps.into_iter().find_map(undone)?.normal.difference;
    let found = among(&plain, name, domains, depth)?.into_iter();
    Some(found.map(|(root, _)| root).collect())
}

/// The real zeros of a polynomial of the first or second degree.
fn quadratic(p: &Expr, name: &Symbol) -> Option<Vec<Expr>> {
    let slope = p.derivative(name);
    let bend = slope.derivative(name);
    let [c, b] = [p, &slope].map(|e| e.put(name, &Expr::zero()));
    if ![&bend, &c, &b].iter().all(|e| e.is_constant()) {
        return None;
    }
    if bend.is_zero() {
        return (!b.is_zero()).then(|| vec![-(c / b)]);
    }
    // With the bend 2 a the zeros are (−b ± √(b² − 4 a c))/(2 a).
    let inner = b.powi(2) - Expr::from(2) * &bend * c;
    let sign = match inner.as_number() {
        Some(k) if k.is_positive() => Sign::Positive,
        Some(k) if k.is_negative() => Sign::Negative,
        Some(_) => return Some(vec![-(b / bend)]),
        None => constant(&inner)?,
    };
    let root = |inner: Expr| (inner - &b) / &bend;
    Some(match sign {
        Sign::Positive => vec![root(inner.sqrt()), root(-inner.sqrt())],
        _ => Vec::new(),
    })
}

/// The angles at which a polynomial in sines, cosines or the tangent of one argument vanishes, by the values of one of them.
fn turning(p: &Expr, name: &Symbol, domains: &Domains, depth: usize) -> Option<Vec<Expr>> {
    use Function::{Cos, Sin, Tan};
    let turning = Turning::of(p, name, domains.symbols.get(name)?)?;
    let [from, to] = turning.span;
    if to - from > MOST_TURNS {
        return None;
    }
    let call = |function| Expr::call(function, turning.argument.clone());
    // With the other sign of the sine as well only its squares are left.
    let both = || {
        let (field, x, y) = pair(p, &p.replace(&call(Sin), &-call(Sin)), domains)?;
        Some(field.expr(&field.mul(&x, &y).ok()?))
    };
    let value: Symbol = "value of the function".into();
    let by = |p: &Expr, function: Function, other: Function| {
        let inside = in_one(p, [&call(function), &call(other)], &Expr::symbol(&value));
        (!inside.mentions(name)).then_some((function, inside))
    };
    let one = by(p, Tan, Tan)
        .or_else(|| by(p, Cos, Sin))
        .or_else(|| by(p, Sin, Cos));
    let (function, inside) = one.or_else(|| by(&both()?, Cos, Sin))?;
    let mut domains = domains.clone();
    let range = match function {
        Tan => Domain::real(),
        _ => Domain::between(ratio(-1, 1), ratio(1, 1)),
    };
    domains.symbols.insert(value.clone(), range);
    let mut out = Vec::new();
    for (value, _) in among(&inside, &value, &domains, depth)? {
        let (period, firsts) = match function {
            Sin => {
                let arc = Expr::call(Function::Asin, value);
                (2, vec![arc.clone(), Expr::pi() - arc])
            }
            Cos => {
                let arc = Expr::call(Function::Acos, value);
                (2, vec![arc.clone(), -arc])
            }
            _ => (1, vec![Expr::call(Function::Atan, value)]),
        };
        for turn in from.floor() as i64 - 2..=to.ceil() as i64 + 2 {
            let here = firsts.iter().filter(|_| turn % period == 0);
            out.extend(here.map(|first| turning.angle(first + Expr::pi() * Expr::from(turn))));
        }
    }
    Some(out)
}

/// A formula with one function of an angle as a letter, even powers of the other by it.
fn in_one(e: &Expr, [own, other]: [&Expr; 2], letter: &Expr) -> Expr {
    if e == own {
        return letter.clone();
    }
    match e.node() {
        Node::Power(base, k) if base == other && own != other => {
            let half = k.as_number().map(|k| k * ratio(1, 2));
            match half.filter(|half| half.is_integer()) {
                Some(half) => (Expr::one() - letter.powi(2)).power(Expr::from(half)),
                None => e.clone(),
            }
        }
        _ => e.map_parts(|part| in_one(part, [own, other], letter)),
    }
}
