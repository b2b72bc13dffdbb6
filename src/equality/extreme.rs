//! Points far out, for identities that lean on a sign which was seen at points rather than proved.
//!
//! |x + 1000| is x + 1000 at every point a person would try. Before such a sign is granted, each symbol is driven to both
//! ends of its domain, to zero, and to where the expression in question changes sign if it is linear in the symbol.

use num_traits::{Signed, Zero};

use super::Assumption;
use crate::domain::{Coordinate, Domain, Domains, Sample};
use crate::expr::{Expr, Int, Point, Rational, Symbol, ratio};

/// Magnitudes tried for an unbounded domain.
const POWERS: [i32; 9] = [-9, -4, -2, 1, 2, 3, 4, 6, 12];

/// Samples of the domain at which the assumptions are most in danger, made from given ones.
pub(super) fn points(
    assumptions: &[Assumption],
    near: &[Sample],
    domains: &Domains,
) -> Vec<Sample> {
    let signs: Vec<&Expr> = assumptions
        .iter()
        .filter_map(|a| match a {
            Assumption::NotNegative(e) => Some(e),
            Assumption::NotAt(_) => None,
        })
        .collect();
    let names: Vec<Symbol> = {
        let mut all: Vec<Symbol> = signs.iter().flat_map(|e| e.symbols()).collect();
        all.sort();
        all.dedup();
        all
    };
    let mut out = Vec::new();
    for sample in near.iter().take(3) {
        for name in &names {
            let (Some(domain), Some(Coordinate::Number(_))) =
                (domains.symbols.get(name), sample.coordinates.get(name))
            else {
                continue;
            };
            if domains.unit_vectors.iter().flatten().any(|s| s == name) {
                continue;
            }
            let roots = signs.iter().filter_map(|e| root(e, name, sample));
            let beside = roots.flat_map(|r| {
                let step = (r.abs() + ratio(1, 1)) * ratio(1, 8);
                [&r - &step, &r + &step, r]
            });
            for value in far(domain)
                .into_iter()
                .chain(beside)
                .filter(|v| domain.contains(v))
            {
                let mut moved = sample.clone();
                moved
                    .coordinates
                    .insert(name.clone(), Coordinate::Number(value));
                out.push(moved);
            }
        }
    }
    out
}

/// Numbers near the ends of a domain.
fn far(domain: &Domain) -> Vec<Rational> {
    let ten = |k: i32| {
        let power = Rational::from(Int::from(10).pow(k.unsigned_abs()));
        if k < 0 { power.recip() } else { power }
    };
    let ends = [&domain.low, &domain.high]
        .map(|l| l.as_ref().filter(|l| !l.of_pi).map(|l| l.value.clone()));
    let mut out = Vec::new();
    for k in POWERS {
        let size = ten(k);
        out.extend([size.clone(), -size.clone()]);
        for end in ends.iter().flatten() {
            out.extend([end + &size, end - &size]);
        }
    }
    out.push(Rational::zero());
    out
}

/// Where an expression vanishes as a function of one symbol, from two of its values, if it is linear in it.
fn root(e: &Expr, name: &Symbol, sample: &Sample) -> Option<Rational> {
    let mut point = Point::<Rational>::default();
    for (symbol, coordinate) in &sample.coordinates {
        match coordinate {
            Coordinate::Number(value) => {
                point.values.insert(symbol.clone(), value.clone());
            }
            Coordinate::Direction { divisor, unit, .. } => {
                point
                    .directions
                    .insert(symbol.clone(), (*divisor, unit.clone()));
            }
            Coordinate::Pi(_) => return None,
        }
    }
    let mut at = |x: i64| {
        point.values.insert(name.clone(), ratio(x, 1));
        e.evaluate(&point)
    };
    let (zero, one, two) = (at(0)?, at(1)?, at(2)?);
    let slope = &one - &zero;
    let linear = &two - &one == slope && !slope.is_zero();
    linear.then(|| -zero / slope)
}
