//! Equations for an angle.
//!
//! In: an expression and the domains. Out: values of the angle. An angle is solved for through one of its
//! functions where only that stands, through its tangent where sine and cosine stand in products of even degree, else
//! through the tangent of its half, which makes sines and cosines fractions.

use std::collections::BTreeMap;

use num_integer::Integer;

use super::{Root, Roots, Unsolved, placed, placing, real, solve};
use crate::answer::calc::{bases, essential, has_root, is_zero, sign, tidy};
use crate::domain::{Domain, Domains, Limit};
use crate::expr::{Expr, Function, Node, Rational, Symbol, ratio};
use crate::formula::Sentence;

/// The tangent of the angle.
const TANGENT: &str = "\u{1}tangent";
/// The tangent of half the angle.
const HALF: &str = "\u{1}half";
/// The cosine or sine of the angle.
const RATIO: &str = "\u{1}ratio";

/// Values of an angle at which an expression in its sine and cosine vanishes, factor by factor.
pub(super) fn zeros(e: &Expr, symbol: &Symbol, domains: &Domains) -> Result<Roots, Unsolved> {
    let own = domains.symbols.get(symbol).cloned();
    let own = own.unwrap_or_else(Domain::first_quadrant);
    let ends = [(&own.low, true), (&own.high, false)]
        .map(|(end, is_low)| end.as_ref().and_then(|end| to_right_angle(end, is_low)));
    if swap(e, symbol, &Expr::one(), &Expr::one()).is_none() {
        return Err(Unsolved::Inside);
    }
    let [Some(low), Some(high)] = ends else {
        return Err(Unsolved::Limit(format!(
            "an angle is solved for between bounds within -pi and pi: give {symbol} a domain, such as {{\"min\": 0, \"max\": \"pi/2\"}}"
        )));
    };
    let domain = Domain {
        low: Some(low),
        high: Some(high),
    };
    let mut out = Roots::default();
    let all = bases(&tidy(e, domains)?).into_iter();
    for base in all.filter(|base| base.mentions(symbol)) {
        let by = |function| by_function(&base, symbol, function, &domain, domains);
        let found = match by(Function::Cos)? {
            Some(found) => Some(found),
            None => by(Function::Sin)?,
        };
        let found = match found {
            Some(found) => Some(found),
            None => by_tangent(&base, symbol, &domain, domains)?,
        };
        let found = match found {
            Some(found) => found,
            None => by_half(&base, symbol, &domain, domains)?,
        };
        for mut root in found.inside {
            if domain != own {
                match placed(symbol, &root.value, &own, domains) {
                    Ok(needs) => {
                        root.given.extend(placing(symbol, &needs));
                        root.needs.extend(needs);
                    }
                    Err(why) => {
                        out.discarded.push(why);
                        continue;
                    }
                }
            }
            let same = |r: &Root| is_zero(&(&r.value - &root.value), domains) == Some(true);
            // A divisor may vanish with the factor.
            let vanishes = is_zero(&e.put(symbol, &root.value), domains);
            if vanishes == Some(false) || out.inside.iter().any(same) {
                continue;
            }
            out.inside.push(Root {
                proved: root.proved && vanishes == Some(true),
                ..root
            });
        }
        out.discarded.extend(found.discarded);
    }
    Ok(out)
}

/// Zeros of an expression in the cosine and even powers of the sine, or the other way round, where the domain holds each
/// value of that function once; `None` where it is not of this form or has no closed form so.
fn by_function(
    e: &Expr,
    symbol: &Symbol,
    function: Function,
    domain: &Domain,
    domains: &Domains,
) -> Result<Option<Roots>, Unsolved> {
    let (Some(low), Some(high)) = (&domain.low, &domain.high) else {
        return Ok(None);
    };
    // In multiples of π: where the function takes each value once. Its values at multiples of π/2 are whole numbers.
    let range = match function {
        Function::Cos => [ratio(0, 1), ratio(1, 1)],
        _ => [ratio(-1, 2), ratio(1, 2)],
    };
    if low.value < range[0] || range[1] < high.value {
        return Ok(None);
    }
    let Some(in_ratio) = in_one(e, symbol, function, &Expr::symbol(RATIO)) else {
        return Ok(None);
    };
    let at = |l: &Limit| match function {
        Function::Cos => ratio(1, 1) - &l.value * ratio(2, 1),
        _ => &l.value * ratio(2, 1),
    };
    let mut limits = [low, high].map(|l| Limit::number(at(l), l.open));
    limits.sort_by(|a, b| a.value.cmp(&b.value));
    let [low, high] = limits.map(Some);
    let mut wide = domains.clone();
    wide.symbols.insert(RATIO.into(), Domain { low, high });
    let Some(found) = closed(solve(&in_ratio, &RATIO.into(), &wide))? else {
        return Ok(None);
    };
    let inverse = match function {
        Function::Cos => Function::Acos,
        _ => Function::Asin,
    };
    let of_angle = Expr::call(function, Expr::symbol(symbol));
    let back = BTreeMap::from([(Symbol::from(RATIO), of_angle)]);
    let put_back = |all: &[Sentence]| all.iter().map(|s| s.put_in(&back)).collect();
    let inside = found.inside.iter().map(|root| {
        let same = |angle: &Expr| {
            let gap = Expr::call(function, angle.clone()) - root.value.clone();
            is_zero(&gap, domains) == Some(true)
        };
        let value = by_heart(&range, same);
        Root {
            value: value.unwrap_or_else(|| arc(inverse, &root.value, domains)),
            proved: root.proved,
            given: put_back(&root.given),
            needs: root.needs.clone(),
            other: None,
        }
    });
    Ok(Some(Roots {
        inside: inside.collect(),
        discarded: put_back(&found.discarded),
        open: Vec::new(),
    }))
}

/// Roots of which each has a closed form; none where only what vanishes for every value or for none is left, and `None` where
/// another way may give them.
fn closed(found: Result<Roots, Unsolved>) -> Result<Option<Roots>, Unsolved> {
    match found {
        Ok(found) if found.open.is_empty() => Ok(Some(found)),
        Err(Unsolved::Absent) => Ok(Some(Roots::default())),
        Ok(_) | Err(Unsolved::Inside) => Ok(None),
        Err(other) => Err(other),
    }
}

/// An expression in sine and cosine with one of them as `x`; `None` where odd powers of the other stand in it, or the angle
/// itself.
fn in_one(e: &Expr, symbol: &Symbol, function: Function, x: &Expr) -> Option<Expr> {
    if !e.symbols().contains(symbol) {
        return Some(e.clone());
    }
    let call = |e: &Expr| match e.node() {
        Node::Call(f, argument) if argument.as_symbol() == Some(symbol) => Some(*f),
        _ => None,
    };
    let other = match function {
        Function::Cos => Function::Sin,
        _ => Function::Cos,
    };
    if call(e) == Some(function) {
        return Some(x.clone());
    }
    match e.node() {
        Node::Power(base, k) if call(base) == Some(other) => {
            let half = k.as_number()? * ratio(1, 2);
            let square = Expr::one() - x.powi(2);
            half.is_integer().then(|| square.power(Expr::from(half)))
        }
        Node::Symbol(_) | Node::Call(..) => None,
        _ => e.try_map_parts(|part| in_one(part, symbol, function, x)),
    }
}

/// The first of the angles a person knows by heart, between two multiples of π, of which something holds.
fn by_heart(range: &[Rational; 2], holds: impl Fn(&Expr) -> bool) -> Option<Expr> {
    for n in -11..=11i64 {
        for d in [1, 2, 3, 4, 6, 12] {
            let turn = ratio(n, d);
            if turn < range[0] || range[1] < turn {
                continue;
            }
            let angle = Expr::from(turn) * Expr::pi();
            if holds(&angle) {
                return Some(angle);
            }
        }
    }
    None
}

/// The same through the tangent, where the domain lies between two right angles and no root of 1 + tan² is left: as in
/// V² sin2α = g d, or y = d tanα − g d²/(2 V² cos²α).
fn by_tangent(
    e: &Expr,
    symbol: &Symbol,
    domain: &Domain,
    domains: &Domains,
) -> Result<Option<Roots>, Unsolved> {
    // Each end as a tangent; the inner `None` is infinite.
    let end = |limit: &Option<Limit>| match limit {
        Some(l) if l.value == ratio(0, 1) => Some(Some(Limit::number(ratio(0, 1), l.open))),
        Some(l) if l.of_pi && [ratio(1, 2), ratio(-1, 2)].contains(&l.value) => Some(None),
        _ => None,
    };
    let (Some(low), Some(high)) = (end(&domain.low), end(&domain.high)) else {
        return Ok(None);
    };
    let t = Expr::symbol(TANGENT);
    let cos = (Expr::one() + t.powi(2)).power(Expr::ratio(-1, 2));
    let Some(turned) = replaced(e, symbol, &[&t * &cos, cos, t]) else {
        return Ok(None);
    };
    let mut wide = domains.clone();
    wide.symbols.insert(TANGENT.into(), Domain { low, high });
    let turned = essential(&turned, &wide);
    if has_root(&turned, &TANGENT.into()) {
        return Ok(None);
    }
    let Some(found) = closed(solve(&turned, &TANGENT.into(), &wide))? else {
        return Ok(None);
    };
    let of_angle = Expr::call(Function::Tan, Expr::symbol(symbol));
    let back = BTreeMap::from([(Symbol::from(TANGENT), of_angle)]);
    let put_back = |all: &[Sentence]| all.iter().map(|s| s.put_in(&back)).collect();
    let range = [ratio(-1, 2), ratio(1, 2)];
    let inside = found.inside.iter().map(|root| {
        let same = |angle: &Expr| {
            let gap = angle.sin() - &root.value * &angle.cos();
            is_zero(&gap, domains) == Some(true)
        };
        let arc = || Expr::call(Function::Atan, root.value.clone());
        Root {
            value: by_heart(&range, same).unwrap_or_else(arc),
            given: put_back(&root.given),
            ..root.clone()
        }
    });
    let mut inside: Vec<Root> = inside.collect();
    // A right angle has no tangent.
    for (end, sign) in [(&domain.low, -1), (&domain.high, 1)] {
        let is_right = |l: &Limit| l.of_pi && l.value == ratio(sign, 2) && !l.open;
        let right = end.as_ref().is_some_and(is_right);
        let value = Expr::ratio(sign, 2) * Expr::pi();
        if right && is_zero(&e.put(symbol, &value), domains) == Some(true) {
            inside.push(Root::sure(value));
        }
    }
    Ok(Some(Roots {
        inside,
        discarded: put_back(&found.discarded),
        open: Vec::new(),
    }))
}

/// The same through the tangent of half the angle.
fn by_half(
    e: &Expr,
    symbol: &Symbol,
    domain: &Domain,
    domains: &Domains,
) -> Result<Roots, Unsolved> {
    let low = domain.low.as_ref().and_then(|l| half(l, true));
    let high = domain.high.as_ref().and_then(|l| half(l, false));
    let (Some(low), Some(high)) = (low, high) else {
        return Err(Unsolved::Inside);
    };
    let t = Expr::symbol(HALF);
    let below = Expr::one() + t.powi(2);
    let turned = swap(&tidy(e, domains)?, symbol, &t, &below).ok_or(Unsolved::Inside)?;
    let mut wide = domains.clone();
    wide.symbols.insert(HALF.into(), Domain { low, high });
    let found = closed(solve(&turned, &HALF.into(), &wide))?.ok_or(Unsolved::Inside)?;
    let half_angle = &Expr::symbol(symbol) / &Expr::from(2);
    let back = BTreeMap::from([(Symbol::from(HALF), Expr::call(Function::Tan, half_angle))]);
    let mut out = Roots::default();
    for root in found.inside {
        let value = from_half(&root.value, &wide)?;
        let given = root.given.iter().map(|g| g.put_in(&back));
        // The conditions for the tangent to be real are those for the angle.
        let mut given: Vec<Sentence> = given.collect();
        let mut needs = root.needs;
        for need in real(&value, domains) {
            let condition = Sentence::not_negative(&need);
            if !given.contains(&condition) {
                given.push(condition);
                needs.push((need, true));
            }
        }
        out.inside.push(Root {
            value,
            proved: root.proved,
            given,
            needs,
            other: None,
        });
    }
    // Half of a straight angle has no tangent.
    for (end, sign) in [(&domain.low, -1), (&domain.high, 1)] {
        let is_straight = |l: &Limit| l.of_pi && l.value == ratio(sign, 1) && !l.open;
        let straight = end.as_ref().is_some_and(is_straight);
        let value = Expr::from(sign) * Expr::pi();
        if straight && is_zero(&e.put(symbol, &value), domains) == Some(true) {
            out.inside.push(Root::sure(value));
        }
    }
    Ok(out)
}

/// An end of the domain, or the next multiple of π/2 beyond it; `None` beyond a straight angle.
fn to_right_angle(end: &Limit, is_low: bool) -> Option<Limit> {
    if half(end, is_low).is_some() {
        return Some(end.clone());
    }
    let quarters = end.approximate() / std::f64::consts::FRAC_PI_2;
    let whole = match is_low {
        true => quarters.floor(),
        false => quarters.ceil(),
    };
    (whole.abs() <= 2.0).then(|| Limit::pi(ratio(whole as i64, 2), true))
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
    let [twice, rest] = [Expr::from(2) * t.clone(), Expr::one() - t.powi(2)];
    replaced(e, symbol, &[&twice / below, &rest / below, twice / rest])
}

/// An expression with these for sine, cosine and tangent of an angle; `None` where the angle stands elsewhere too.
fn replaced(e: &Expr, symbol: &Symbol, by: &[Expr; 3]) -> Option<Expr> {
    if !e.mentions(symbol) {
        return Some(e.clone());
    }
    match e.node() {
        Node::Call(f, argument) if argument.as_symbol() == Some(symbol) => match f {
            Function::Sin => Some(by[0].clone()),
            Function::Cos => Some(by[1].clone()),
            Function::Tan => Some(by[2].clone()),
            _ => None,
        },
        Node::Symbol(_) | Node::Number(_) | Node::Call(..) => None,
        _ => e.try_map_parts(|part| replaced(part, symbol, by)),
    }
}

/// The angle with this sine or cosine, by its tangent or the other of the two where that is shorter: cosθ = √5/5 is tanθ = 2, and
/// cosθ = √(1 − k) is sinθ = √k.
fn arc(inverse: Function, value: &Expr, domains: &Domains) -> Expr {
    let rest = Expr::one() - value.powi(2);
    let is_positive = |e: &Expr| sign(e, domains).is_positive();
    let mut ways = vec![(inverse, value.clone())];
    let mut add = |f: Function, x: Expr| ways.extend(tidy(&x, domains).ok().map(|x| (f, x)));
    match inverse {
        Function::Acos if is_positive(value) => add(Function::Atan, rest.sqrt() / value.clone()),
        Function::Asin if is_positive(&rest) => add(Function::Atan, value.clone() / rest.sqrt()),
        _ => {}
    }
    // A sine below zero is not told from the cosine.
    match inverse {
        _ if !is_not_negative(value, domains) => {}
        Function::Acos => add(Function::Asin, rest.sqrt()),
        Function::Asin => add(Function::Acos, rest.sqrt()),
        _ => {}
    }
    let shortest = ways.into_iter().min_by_key(|(_, x)| x.size());
    shortest.map_or_else(
        || Expr::call(inverse, value.clone()),
        |(f, x)| Expr::call(f, x),
    )
}

/// The angle with this tangent of its half, between −π and π, in the shortest of the usual ways.
fn from_half(t: &Expr, domains: &Domains) -> Result<Expr, Unsolved> {
    let square = t.powi(2);
    let below = Expr::one() + square.clone();
    let cos = tidy(&(&(Expr::one() - square) / &below), domains)?;
    let sin = tidy(&(&(Expr::from(2) * t.clone()) / &below), domains)?;
    let same = |a: &Expr, b: Expr| is_zero(&(a - &b), domains) == Some(true);
    let known = by_heart(&[ratio(-1, 1), ratio(1, 1)], |angle| {
        same(&cos, angle.cos()) && same(&sin, angle.sin())
    });
    if let Some(angle) = known {
        return Ok(angle);
    }
    let bare = tidy(t, domains)?;
    let mut ways = vec![];
    if is_not_negative(&bare, domains) {
        ways.push(Expr::call(Function::Acos, cos.clone()));
    }
    if sign(&(Expr::one() - t.powi(2)), domains).is_positive() {
        ways.push(Expr::call(Function::Asin, sin.clone()));
        ways.push(Expr::call(Function::Atan, tidy(&(&sin / &cos), domains)?));
    }
    ways.push(Expr::from(2) * Expr::call(Function::Atan, bare));
    let shortest = ways.into_iter().min_by_key(Expr::size);
    shortest.ok_or(Unsolved::Inside)
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
