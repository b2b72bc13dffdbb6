//! A point in general position, in doubles: what vanishes there is taken to vanish everywhere while planning.

use super::Domains;
use crate::expr::{Point, Symbol};

/// Values of symbols in general position inside the domains; the golden ratio keeps them apart.
pub fn generic_point<'a>(
    names: impl Iterator<Item = &'a Symbol> + Clone,
    domains: &Domains,
) -> Point<f64> {
    let mut fraction = 0.371_943_1_f64;
    let mut next = || {
        fraction = (fraction + 0.618_033_988_749_895).fract();
        0.15 + 0.7 * fraction
    };
    let keeps = |point: &Point<f64>| {
        let mut relations = domains.relations.iter();
        relations.all(|r| r.excess.evaluate(point).is_none_or(|value| value > 0.0))
    };
    let mut point = at_fractions(names.clone(), domains, &mut next);
    for _ in 0..MOST {
        if keeps(&point) {
            break;
        }
        point = at_fractions(names.clone(), domains, &mut next);
    }
    point
}

/// Most points tried for one that keeps to the relations.
const MOST: usize = 1000;

fn at_fractions<'a>(
    names: impl Iterator<Item = &'a Symbol>,
    domains: &Domains,
    next: &mut impl FnMut() -> f64,
) -> Point<f64> {
    let mut point = Point::default();
    for name in names {
        let share = next();
        let domain = domains.symbols.get(name).cloned().unwrap_or_default();
        let value = domain.at(share, 0.6 + share, 0.6 + share);
        point.values.insert(name.clone(), value);
    }
    for [a, b] in &domains.unit_vectors {
        let (sin, cos) = next().sin_cos();
        point.values.insert(a.clone(), cos);
        point.values.insert(b.clone(), sin);
    }
    point
}
