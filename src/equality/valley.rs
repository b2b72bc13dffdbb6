//! Where an expression of several symbols is least: downhill by damped steps, which follow a valley across all of them.

use std::collections::BTreeSet;

use num_traits::{Signed, Zero};

use crate::domain::{Coordinate, Domain, Domains, Limit, Sample};
use crate::expr::number::from_f64;
use crate::expr::{Expr, Node, Point, Symbol};

/// Most symbols walked along, from each point.
pub(super) const SYMBOLS: usize = 6;
/// Most steps, accepted or not.
const STEPS: usize = 80;
/// Longest expression whose second derivatives are formed.
const LONGEST: usize = 300;

/// The symbols of expressions that may be moved at a point.
pub(super) fn free_symbols(arguments: &[Expr], domains: &Domains, at: &Sample) -> Vec<Symbol> {
    let names: BTreeSet<Symbol> = arguments.iter().flat_map(|e| e.symbols()).collect();
    let free = |name: &Symbol| at.coordinates.contains_key(name) && !domains.is_component(name);
    names.into_iter().filter(free).take(SYMBOLS).collect()
}

/// The domain of a symbol that has a number at a point.
pub(super) fn along<'d>(name: &Symbol, at: &Sample, domains: &'d Domains) -> Option<&'d Domain> {
    let number = matches!(at.coordinates.get(name), Some(Coordinate::Number(_)));
    domains.symbols.get(name).filter(|_| number)
}

/// The symbols of an expression that have a number at a point, with their domains.
fn moving<'d>(e: &Expr, start: &Sample, domains: &'d Domains) -> Vec<(Symbol, &'d Domain)> {
    let names = free_symbols(std::slice::from_ref(e), domains, start).into_iter();
    names
        .filter_map(|name| along(&name, start, domains).map(|domain| (name, domain)))
        .collect()
}

/// The point to which damped Newton steps lead down from another.
pub(super) fn downhill(e: &Expr, start: &Sample, domains: &Domains) -> Option<Sample> {
    let inside = moving(e, start, domains);
    if e.size() > LONGEST || inside.len() < 2 {
        return None;
    }
    let slopes = gradient(e, &inside);
    let bends: Vec<Vec<Expr>> = slopes.iter().map(|s| gradient(s, &inside)).collect();
    let steps = |here: &Point<f64>| {
        let rows = bends.iter().zip(&slopes).map(|(row, slope)| {
            let mut row = values(row, here)?;
            row.push(-value(slope, here)?);
            Some(row)
        });
        rows.collect()
    };
    led_down(&|at| e.evaluate(at), &steps, start, &inside)
}

/// The points to which steps lead that make each square of a sum vanish (Gauss and Newton), full ones and damped ones: a valley
/// of several squares may bend too much for the curvature of the sum to tell where it goes.
pub(super) fn meetings(sum: &Expr, start: &Sample, domains: &Domains) -> Vec<Sample> {
    let squared: Vec<Expr> = sum.terms().iter().filter_map(square).collect();
    let inside = moving(sum, start, domains);
    if sum.size() > LONGEST || squared.len() < 2 || inside.is_empty() {
        return Vec::new();
    }
    let slopes: Vec<Vec<Expr>> = squared.iter().map(|e| gradient(e, &inside)).collect();
    let height = |at: &Point<f64>| Some(values(&squared, at)?.iter().map(|r| r * r).sum());
    let steps = |here: &Point<f64>| {
        let left = values(&squared, here)?;
        let slopes = slopes.iter().map(|row| values(row, here));
        let slopes = slopes.collect::<Option<Vec<Vec<f64>>>>()?;
        let product = |i: usize, other: &dyn Fn(usize) -> f64| -> f64 {
            let each = slopes.iter().enumerate();
            each.map(|(k, row)| row[i] * other(k)).sum()
        };
        let rows = (0..inside.len()).map(|i| {
            let row = (0..inside.len()).map(|j| product(i, &|k| slopes[k][j]));
            row.chain([-product(i, &|k| left[k])]).collect()
        });
        Some(rows.collect())
    };
    let full = led_on(&steps, start, &inside);
    let damped = led_down(&height, &steps, start, &inside);
    full.into_iter().chain(damped).collect()
}

/// What a positive term is the square of.
fn square(term: &Expr) -> Option<Expr> {
    let (factor, rest) = term.split_number();
    let Node::Power(base, k) = rest.node() else {
        return None;
    };
    let k = k.as_number().filter(|k| k.is_integer())?.numer().as_i64()?;
    let even = k > 0 && k % 2 == 0;
    (even && factor.is_positive()).then(|| base.powi(k / 2))
}

fn gradient(e: &Expr, inside: &[(Symbol, &Domain)]) -> Vec<Expr> {
    inside.iter().map(|(name, _)| e.derivative(name)).collect()
}

fn value(e: &Expr, at: &Point<f64>) -> Option<f64> {
    e.evaluate(at).filter(|v| v.is_finite())
}

fn values(all: &[Expr], at: &Point<f64>) -> Option<Vec<f64>> {
    all.iter().map(|e| value(e, at)).collect()
}

/// The height of a point.
type Height<'a> = &'a dyn Fn(&Point<f64>) -> Option<f64>;
/// The linear equations of a step from a point, each with its right side last.
type Steps<'a> = &'a dyn Fn(&Point<f64>) -> Option<Vec<Vec<f64>>>;

/// The point to which damped steps lead (Levenberg and Marquardt: the diagonal grows where a step does not lead down).
fn led_down(
    height_at: Height,
    steps: Steps,
    start: &Sample,
    inside: &[(Symbol, &Domain)],
) -> Option<Sample> {
    let mut here = start.doubles();
    let mut height = height_at(&here)?;
    let mut damping = 1e-3;
    for _ in 0..STEPS {
        let lower = damped(steps(&here)?, damping).and_then(|step| {
            let next = stepped(&here, inside, &step);
            let below = height_at(&next).filter(|h| *h < height)?;
            Some((next, below))
        });
        match lower {
            Some((next, below)) => {
                (here, height) = (next, below);
                damping /= 10.0;
            }
            None if damping > 1e12 => break,
            None => damping *= 10.0,
        }
    }
    moved(start, &here, inside)
}

/// The point to which full steps lead, up or down.
fn led_on(steps: Steps, start: &Sample, inside: &[(Symbol, &Domain)]) -> Option<Sample> {
    let mut here = start.doubles();
    for _ in 0..STEPS / 4 {
        here = stepped(&here, inside, &damped(steps(&here)?, f64::EPSILON)?);
    }
    moved(start, &here, inside)
}

/// A step by its equations, with a share of the diagonal added.
fn damped(mut rows: Vec<Vec<f64>>, damping: f64) -> Option<Vec<f64>> {
    for (i, row) in rows.iter_mut().enumerate() {
        row[i] += damping * row[i].abs().max(f64::MIN_POSITIVE);
    }
    solved(rows)
}

/// A point with the numbers found for some symbols.
fn moved(start: &Sample, here: &Point<f64>, inside: &[(Symbol, &Domain)]) -> Option<Sample> {
    let mut at = start.clone();
    for (name, _) in inside {
        let value = from_f64(*here.values.get(name)?)?;
        at = at.moved(name, Coordinate::Number(value));
    }
    Some(at)
}

/// A point moved by a step, no farther than most of the way to the end of a domain.
fn stepped(here: &Point<f64>, inside: &[(Symbol, &Domain)], step: &[f64]) -> Point<f64> {
    let mut next = here.clone();
    for ((name, domain), step) in inside.iter().zip(step) {
        let from = here.values.get(name).copied().unwrap_or(0.0);
        let end = |limit: &Option<Limit>| {
            limit
                .as_ref()
                .map(|l| from + 0.9 * (l.approximate() - from))
        };
        let low = end(&domain.low).unwrap_or(f64::NEG_INFINITY);
        let high = end(&domain.high).unwrap_or(f64::INFINITY);
        next.values
            .insert(name.clone(), (from + step).max(low).min(high));
    }
    next
}

/// The solution of a few linear equations, each with its right side last: elimination with the largest pivot.
fn solved(mut rows: Vec<Vec<f64>>) -> Option<Vec<f64>> {
    let n = rows.len();
    for k in 0..n {
        let largest = (k..n).max_by(|i, j| rows[*i][k].abs().total_cmp(&rows[*j][k].abs()))?;
        rows.swap(k, largest);
        if rows[k][k].is_zero() {
            return None;
        }
        let pivot = rows[k].clone();
        for (_, row) in rows.iter_mut().enumerate().filter(|(i, _)| *i != k) {
            let share = row[k] / pivot[k];
            for (x, p) in row.iter_mut().zip(&pivot).skip(k) {
                *x -= share * p;
            }
        }
    }
    let all: Vec<f64> = rows
        .iter()
        .enumerate()
        .map(|(k, row)| row[n] / row[k])
        .collect();
    all.iter().all(|x| x.is_finite()).then_some(all)
}
