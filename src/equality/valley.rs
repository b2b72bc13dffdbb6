//! Where an expression of several symbols is least: downhill by damped Newton steps, which follow a valley across all of them.

use std::collections::BTreeSet;

use num_traits::Zero;

use crate::domain::{Coordinate, Domain, Domains, Limit, Sample};
use crate::expr::number::from_f64;
use crate::expr::{Expr, Point, Symbol};

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

/// The point to which damped Newton steps lead down from another (Levenberg and Marquardt: the diagonal grows where a step
/// does not lead down).
pub(super) fn downhill(e: &Expr, start: &Sample, domains: &Domains) -> Option<Sample> {
    if e.size() > LONGEST {
        return None;
    }
    let names = free_symbols(std::slice::from_ref(e), domains, start).into_iter();
    let inside: Vec<(Symbol, &Domain)> = names
        .filter_map(|name| along(&name, start, domains).map(|domain| (name, domain)))
        .collect();
    if inside.len() < 2 {
        return None;
    }
    let slopes: Vec<Expr> = inside.iter().map(|(name, _)| e.derivative(name)).collect();
    let bends = slopes.iter().map(|slope| {
        let names = inside.iter().map(|(name, _)| name);
        names.map(|name| slope.derivative(name)).collect::<Vec<_>>()
    });
    let bends: Vec<Vec<Expr>> = bends.collect();
    let mut here = start.doubles();
    let mut height = e.evaluate(&here)?;
    let mut damping = 1e-3;
    for _ in 0..STEPS {
        let value = |e: &Expr| e.evaluate(&here).filter(|v| v.is_finite());
        let slope = slopes.iter().map(value).collect::<Option<Vec<f64>>>()?;
        let rows = bends.iter().zip(&slope).enumerate().map(|(i, (row, s))| {
            let mut row = row.iter().map(value).collect::<Option<Vec<f64>>>()?;
            row[i] += damping * row[i].abs().max(f64::MIN_POSITIVE);
            row.push(-s);
            Some(row)
        });
        let step = solved(rows.collect::<Option<Vec<_>>>()?);
        let lower = step.and_then(|step| {
            let next = stepped(&here, &inside, &step);
            let below = e.evaluate(&next).filter(|h| *h < height)?;
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
    let mut at = start.clone();
    for (name, _) in &inside {
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
