//! Points that a formula's branches ask for: roots, logarithms and absolute values change where their arguments change sign.
//!
//! √(v² − 200) has no value at any number a person would try first, and |x + 1000| is x + 1000 at all of them. From given
//! points, each symbol is led to both sides of every place where an argument changes sign; one point is kept for each
//! new pattern of signs. Also whether the arguments forbid a value on the whole domain, by enclosures over its parts.

use std::collections::BTreeSet;

use num_traits::{One, Zero};

use super::Assumption;
use super::line::{lowest, rough_zeros};
use super::refute::sign_at;
use super::valley::{SYMBOLS, along, downhill, free_symbols, meetings};
use crate::algebra::{Field, Sign};
use crate::domain::{Coordinate, Domain, Domains, Limit, Roles, Sample, far};
use crate::expr::number::from_f64;
use crate::expr::{Expr, Function, Int, Node, Point, Rational, Symbol, ratio};
use crate::interval::{Interval, Outcome, evaluate};

/// Most points that come out.
const MOST: usize = 20;
/// Most arguments looked at.
const ARGUMENTS: usize = 8;
/// Most points walked from.
const STARTS: usize = 10;
/// How often every symbol is led to where an expression is least along it.
const ROUNDS: usize = 16;
/// Points from which the least value of an expression is looked for.
const DESCENTS: usize = 3;
/// Most parts of a domain that are looked at.
const PARTS: usize = 400;

/// What a formula takes roots, logarithms, arcs or absolute values of: it has a value only where those marked with `true` are
/// not negative. A square under a root comes out with the sign of what is squared.
pub(super) fn arguments(formulas: &[&Expr]) -> Vec<(Expr, bool)> {
    let mut out: Vec<(Expr, bool)> = Vec::new();
    let mut note = |e: Expr, needed: bool| {
        if !e.is_constant() && !out.iter().any(|(f, n)| *f == e && *n == needed) {
            out.push((e, needed));
        }
    };
    for part in formulas.iter().flat_map(|f| f.parts()) {
        match part.node() {
            Node::Call(Function::Abs, x) => note(x.clone(), false),
            Node::Call(Function::Ln, x) => note(x.clone(), true),
            Node::Call(Function::Asin | Function::Acos, x) => {
                note(Expr::one() - x, true);
                note(Expr::one() + x, true);
            }
            Node::Power(base, k) => match k.as_number() {
                Some(k) if k.is_integer() => {}
                // A root of odd degree is real everywhere.
                Some(k)
                    if k.denom().bits() > 1 && k.denom().as_i64().is_some_and(|d| d % 2 != 0) =>
                {
                    note(base.clone(), false);
                }
                _ => {
                    note(base.clone(), true);
                    squared(base).for_each(|x| note(x, false));
                }
            },
            _ => {}
        }
    }
    // In an order that is the same for both orders of a pair: what leads most symbols along comes first.
    out.sort_by(|(e, _), (f, _)| f.size().cmp(&e.size()).then_with(|| e.cmp(f)));
    out.truncate(ARGUMENTS);
    out
}

/// What stands to an even power in a product.
fn squared(e: &Expr) -> impl Iterator<Item = Expr> {
    let factors = e.factors();
    let even = |k: &Rational| k.is_integer() && k.numer().as_i64().is_some_and(|k| k % 2 == 0);
    let squared = move |factor: &Expr| match factor.node() {
        Node::Power(base, k) => k.as_number().is_some_and(even).then(|| base.clone()),
        _ => None,
    };
    factors.iter().filter_map(squared)
}

/// Points at which the signs of the arguments form patterns not seen at the given ones.
pub(super) fn points(
    arguments: &[Expr],
    near: &[Sample],
    domains: &Domains,
    roles: &Roles,
) -> Vec<Sample> {
    let pattern = |at: &Point<f64>| -> Vec<Option<bool>> {
        let sign = |e: &Expr| e.evaluate(at).filter(|v| *v != 0.0).map(|v| v > 0.0);
        arguments.iter().map(sign).collect()
    };
    let mut starts: Vec<Sample> = near.iter().take(2).cloned().collect();
    let mut seen: Vec<Vec<Option<bool>>> = near.iter().map(|at| pattern(&at.doubles())).collect();
    let mut out = Vec::new();
    let mut next = 0;
    while next < starts.len().min(STARTS) && out.len() < MOST {
        let start = starts[next].clone();
        next += 1;
        for name in free_symbols(arguments, domains, &start) {
            let Some(domain) = domains.symbols.get(&name) else {
                continue;
            };
            let from = start.doubles();
            let own = arguments.iter().filter(|e| e.symbols().contains(&name));
            let zeros = own.flat_map(|e| rough_zeros(e, &name, &from, domain));
            let mut zeros: Vec<f64> = zeros.collect();
            zeros.sort_by(f64::total_cmp);
            zeros.dedup_by(|a, b| (*a - *b).abs() <= 1e-9 * a.abs().max(1e-9));
            for part in parts(domain, &zeros) {
                let role = roles.symbols.get(&name).cloned().unwrap_or_default();
                let Some(value) = crate::domain::within(&part, domain, &role) else {
                    continue;
                };
                let moved = start.moved(&name, value);
                let signs = pattern(&moved.doubles());
                if seen.contains(&signs) || !domains.admits(&moved) {
                    continue;
                }
                seen.push(signs);
                starts.push(moved.clone());
                out.push(moved);
                if out.len() >= MOST {
                    return out;
                }
            }
        }
    }
    // Of an argument that was seen with one sign only, the corners.
    for (k, e) in arguments.iter().enumerate() {
        let one_sign = seen.iter().all(|signs| signs[k] == seen[0][k]);
        let Some(start) = near.first().filter(|_| one_sign) else {
            continue;
        };
        for corner in corners(e, start, domains) {
            let signs = pattern(&corner.doubles());
            if out.len() < MOST && !seen.contains(&signs) && domains.admits(&corner) {
                seen.push(signs);
                out.push(corner);
            }
        }
    }
    out
}

/// The parts of a domain between numbers, which are rounded: they and their nearest neighbours belong to none.
fn parts(domain: &Domain, cuts: &[f64]) -> Vec<Domain> {
    let beside = |cut: f64, side: f64| {
        let value = from_f64(cut + side * 1e-9 * cut.abs().max(1e-3))?;
        Some(Limit::number(value, true))
    };
    let mut out = Vec::new();
    let mut low = domain.low.clone();
    for cut in cuts {
        out.push(Domain::new(low, beside(*cut, -1.0)));
        low = beside(*cut, 1.0);
    }
    out.push(Domain::new(low, domain.high.clone()));
    out
}

/// A part of a domain: an interval for each symbol.
type Part = Vec<(Symbol, [f64; 2])>;

/// The whole domain of some symbols, widened by the rounding of its ends.
fn whole(arguments: &[&Expr], domains: &Domains) -> Option<Part> {
    let names: BTreeSet<Symbol> = arguments.iter().flat_map(|e| e.symbols()).collect();
    if names.len() > SYMBOLS {
        return None;
    }
    let interval = |name: Symbol| {
        let [low, high] = domains.symbols.get(&name)?.bounds();
        let low = low.map_or(f64::NEG_INFINITY, |x| x - x.abs() * 1e-15);
        let high = high.map_or(f64::INFINITY, |x| x + x.abs() * 1e-15);
        Some((name, [low, high]))
    };
    names.into_iter().map(interval).collect()
}

/// The values of an expression on a part of the domain.
fn enclosed(e: &Expr, part: &Part) -> Outcome<Interval> {
    let mut point = Point::default();
    for (name, [low, high]) in part {
        let value = Interval::new(*low, *high);
        point.values.insert(name.clone(), Outcome::Value(value));
    }
    evaluate(e, &point)
}

/// Whether one enclosure shows that an expression is nowhere negative on the domain.
pub(super) fn nowhere_negative(e: &Expr, domains: &Domains) -> bool {
    let Some(part) = whole(&[e], domains) else {
        return false;
    };
    matches!(enclosed(e, &part), Outcome::Value(v) if v.low >= 0.0)
}

/// Whether a formula has no value on the whole domain: a logarithm of what is nowhere positive, a root of what is negative,
/// or arguments of which one or another is negative everywhere.
pub(super) fn no_value(e: &Expr, domains: &Domains) -> bool {
    let mut field = Field::new(domains);
    let mut sign = |x: &Expr| {
        field.prepare([x]);
        let x = field.element(x).ok()?;
        field.sign(&x)
    };
    let never = e.parts().any(|part| match part.node() {
        Node::Call(Function::Ln, x) => {
            sign(x).is_some_and(|s| !matches!(s, Sign::Positive | Sign::NotNegative))
        }
        _ => false,
    });
    let needed = arguments(&[e]).into_iter().filter(|(_, needed)| *needed);
    let needed: Vec<Expr> = needed.map(|(e, _)| e).collect();
    never || needed.iter().any(|x| sign(x) == Some(Sign::Negative)) || nowhere(&needed, domains)
}

/// Whether one of the arguments is negative at every point of the domain, by enclosures over parts of it.
fn nowhere(arguments: &[Expr], domains: &Domains) -> bool {
    let all: Vec<&Expr> = arguments.iter().collect();
    let Some(whole) = whole(&all, domains).filter(|_| !arguments.is_empty()) else {
        return false;
    };
    let mut open = vec![(whole, 0)];
    let mut left = PARTS;
    while let Some((part, depth)) = open.pop() {
        let below = |e: &Expr| match enclosed(e, &part) {
            Outcome::Value(v) => v.high < 0.0,
            Outcome::Undefined => true,
            Outcome::Unknown => false,
        };
        if arguments.iter().any(below) {
            continue;
        }
        let Some(rest) = left.checked_sub(1).filter(|_| !part.is_empty()) else {
            return false;
        };
        left = rest;
        let at = depth % part.len();
        let [low, high] = part[at].1;
        let middle = match (low.is_finite(), high.is_finite()) {
            (true, true) => 0.5 * (low + high),
            (true, false) => low + low.abs().max(1.0),
            (false, true) => high - high.abs().max(1.0),
            (false, false) => 0.0,
        };
        if !(low < middle && middle < high) {
            return false;
        }
        for half in [[low, middle], [middle, high]] {
            let mut part = part.clone();
            part[at].1 = half;
            open.push((part, depth + 1));
        }
    }
    true
}

/// Puts signs that were only seen to the test: each symbol is led to both sides of every place where one changes, and far
/// out; so are the squares of the given sums to where all of them vanish. Points at which one sign does not hold, or the
/// assumptions that are left after those that enclosures prove.
pub(super) fn tested(
    assumptions: &[Assumption],
    sums: &[Expr],
    near: &[Sample],
    domains: &Domains,
    roles: &Roles,
) -> Result<Vec<Assumption>, Vec<Sample>> {
    let mut left = Vec::new();
    for assumption in assumptions {
        let Assumption::NotNegative(e) = assumption else {
            left.push(assumption.clone());
            continue;
        };
        if nowhere(&[-e], domains) {
            continue;
        }
        let starts = |count| near.iter().take(count);
        // What takes fewer steps first.
        let ways: [&dyn Fn() -> Vec<Sample>; 9] = [
            &|| {
                starts(1)
                    .flat_map(|start| corners(e, start, domains))
                    .collect()
            },
            &|| {
                starts(1)
                    .filter_map(|start| vertex(e, start, domains))
                    .collect()
            },
            &|| {
                starts(2)
                    .flat_map(|start| edges(e, start, domains))
                    .collect()
            },
            &|| {
                let down = |start| descended(e, start, domains, roles);
                starts(DESCENTS).map(down).collect()
            },
            &|| {
                let down = |start| downhill(e, start, domains);
                starts(DESCENTS).filter_map(down).collect()
            },
            &|| {
                let of = |sum| starts(DESCENTS).flat_map(move |at| meetings(sum, at, domains));
                sums.iter().chain([e]).flat_map(of).collect()
            },
            &|| {
                starts(2)
                    .flat_map(|start| kinks(e, start, domains))
                    .collect()
            },
            &|| far_out(e, near, domains),
            &|| points(std::slice::from_ref(e), near, domains, roles),
        ];
        let below = |at: &Sample| sign_at(e, at) == Some(-1) && domains.admits(at);
        let mut found = ways.iter().map(|way| {
            let mut all = way();
            all.retain(below);
            all
        });
        if let Some(all) = found.find(|all| !all.is_empty()) {
            return Err(all);
        }
        left.push(assumption.clone());
    }
    Ok(left)
}

/// Points with each symbol of an expression led far out and near the ends of its domain.
fn far_out(e: &Expr, near: &[Sample], domains: &Domains) -> Vec<Sample> {
    let led = |start: &Sample| {
        let names = free_symbols(std::slice::from_ref(e), domains, start).into_iter();
        names
            .flat_map(|name| start.led_far(&name, domains))
            .collect::<Vec<_>>()
    };
    near.iter().flat_map(led).collect()
}

/// The point to which going down leads: symbol by symbol to where the expression is least along the domain, first to simple
/// numbers near it, as often as that leads on (`cos β + sin(α + β)` is least in a valley across both), and then to nearer ones.
fn descended(e: &Expr, start: &Sample, domains: &Domains, roles: &Roles) -> Sample {
    let mut at = start.clone();
    let names = free_symbols(std::slice::from_ref(e), domains, start);
    let lowered = |at: &mut Sample, share: f64| {
        let before = e.evaluate(&at.doubles());
        for name in &names {
            let here = at.doubles();
            let Some(domain) = domains.symbols.get(name) else {
                continue;
            };
            let beside = |x: f64, side: f64| {
                let value = from_f64(x + side * share * x.abs().max(1e-2))?;
                Some(Limit::number(value, false))
            };
            let role = roles.symbols.get(name).cloned().unwrap_or_default();
            let value = lowest(e, name, &here, domain).and_then(|x| {
                let part = Domain::new(beside(x, -1.0), beside(x, 1.0));
                crate::domain::within(&part, domain, &role)
            });
            let Some(value) = value else { continue };
            let moved = at.moved(name, value);
            let [old, new] = [here, moved.doubles()].map(|point| e.evaluate(&point));
            if new.is_some() && new < old {
                *at = moved;
            }
        }
        e.evaluate(&at.doubles()) < before
    };
    let _ = (0..ROUNDS).all(|_| lowered(&mut at, 1e-3));
    for share in [1e-6, 1e-9] {
        lowered(&mut at, share);
    }
    at
}

/// The point at which all slopes of an expression vanish that are linear, exactly: doubles do not tell the least value of
/// `(x − 71234567)² − 1/1000` from zero.
fn vertex(e: &Expr, start: &Sample, domains: &Domains) -> Option<Sample> {
    let mut roots: Vec<(Symbol, Expr)> = Vec::new();
    for name in free_symbols(std::slice::from_ref(e), domains, start) {
        let slope = e.derivative(&name);
        let slope = roots
            .iter()
            .fold(slope, |slope, (other, root)| slope.put(other, root));
        let rate = slope.derivative(&name);
        let rate = rate.as_number().filter(|rate| !rate.is_zero());
        if let (Some(rate), Some(_)) = (rate, along(&name, start, domains)) {
            let root = slope.put(&name, &Expr::zero()) * Expr::from(-rate.recip());
            roots.push((name, root));
        }
    }
    let mut at = start.clone();
    // The last one found depends on none of the others.
    while let Some((name, root)) = roots.pop() {
        let value = root.as_number()?.clone();
        let inside = domains.symbols.get(&name)?.contains(&value);
        let moved = inside.then(|| at.moved(&name, Coordinate::Number(value.clone())))?;
        at = moved;
        let value = Expr::from(value);
        roots
            .iter_mut()
            .for_each(|(_, root)| *root = root.put(&name, &value));
    }
    Some(at)
}

/// Points where an absolute value or a root inside an expression vanishes: with one symbol led along its domain, another
/// follows. Such a valley may be too narrow to be met by going down along either.
fn kinks(e: &Expr, start: &Sample, domains: &Domains) -> Vec<Sample> {
    let mut out = Vec::new();
    for (inner, _) in arguments(&[e]).into_iter().take(2) {
        let inside = free_symbols(std::slice::from_ref(&inner), domains, start);
        for led in free_symbols(std::slice::from_ref(e), domains, start) {
            let Some(domain) = along(&led, start, domains) else {
                continue;
            };
            let values = far(domain).into_iter();
            for value in values.chain([start.coordinates[&led].clone()]) {
                let moved = start.moved(&led, value);
                let here = moved.doubles();
                for follows in inside.iter().filter(|name| **name != led).take(2) {
                    let Some(domain) = domains.symbols.get(follows) else {
                        continue;
                    };
                    let zeros = rough_zeros(&inner, follows, &here, domain).into_iter();
                    let zeros = zeros.filter_map(from_f64).filter(|z| domain.contains(z));
                    out.extend(zeros.map(|z| moved.moved(follows, Coordinate::Number(z))));
                }
            }
        }
    }
    out
}

/// Points close to where an expression stops having a value, or bends: with one symbol led along its domain, what stands in a
/// logarithm, a root, an arc or an absolute value vanishes. `ln(x − 1)` is below all bounds in a strip next to x = 1 alone.
fn edges(e: &Expr, start: &Sample, domains: &Domains) -> Vec<Sample> {
    let mut out = Vec::new();
    for (inner, _) in arguments(&[e]).into_iter().take(4) {
        for name in free_symbols(std::slice::from_ref(&inner), domains, start) {
            let Some(domain) = along(&name, start, domains) else {
                continue;
            };
            for zero in rough_zeros(&inner, &name, &start.doubles(), domain) {
                let size = zero.abs().max(1e-2);
                let [Some(zero), Some(size)] = [zero, size].map(from_f64) else {
                    continue;
                };
                let shares = [10, 1_000, 1_000_000].into_iter();
                let shares = shares.flat_map(|k| [ratio(1, k), ratio(-1, k)]);
                let near = shares.map(|share| &zero + &(&share * &size));
                let near = near.filter(|x| domain.contains(x));
                out.extend(near.map(|x| start.moved(&name, Coordinate::Number(x))));
            }
        }
    }
    out
}

/// A point with the numbers of an expression led towards the ends of their domains in every combination: what is linear in
/// each of them changes sign at a corner if anywhere.
fn corners(e: &Expr, start: &Sample, domains: &Domains) -> Vec<Sample> {
    let mut out = vec![start.clone()];
    for name in free_symbols(std::slice::from_ref(e), domains, start) {
        let Some(domain) = along(&name, start, domains) else {
            continue;
        };
        let ends = near_ends(domain).map(Coordinate::Number);
        let led = |at: &Sample| ends.each_ref().map(|end| at.moved(&name, end.clone()));
        out = out.iter().flat_map(led).collect();
    }
    out
}

/// A number at or near each end of a domain, far out where there is none.
fn near_ends(domain: &Domain) -> [Rational; 2] {
    let far = Rational::from(Int::from(1000));
    // A multiple of π is as good as an open end at a fraction near it.
    let ends = [&domain.low, &domain.high].map(|limit| {
        let limit = limit.as_ref()?;
        Some(match limit.of_pi {
            true => Limit::number(from_f64(limit.approximate())?, true),
            false => limit.clone(),
        })
    });
    let width = match &ends {
        [Some(low), Some(high)] => &high.value - &low.value,
        _ => Rational::one(),
    };
    let inside = |l: &Limit| match l.open {
        true => &width / &far,
        false => Rational::zero(),
    };
    match &ends {
        [Some(low), Some(high)] => [&low.value + inside(low), &high.value - inside(high)],
        [Some(low), None] => [&low.value + inside(low), &low.value + &far],
        [None, Some(high)] => [&high.value - &far, &high.value - inside(high)],
        [None, None] => [-far.clone(), far],
    }
}
