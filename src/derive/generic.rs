//! A point in general position, in doubles: what vanishes there is taken to vanish everywhere while planning.

use crate::domain::{Domain, Limit};
use crate::expr::Point;
use crate::scene::Scene;

/// Values in general position inside the domain; the golden ratio keeps them apart.
pub(super) fn generic_point(scene: &Scene) -> Point<f64> {
    let mut fraction = 0.371_943_1_f64;
    let mut next = || {
        fraction = (fraction + 0.618_033_988_749_895).fract();
        0.15 + 0.7 * fraction
    };
    let keeps = |point: &Point<f64>| {
        let mut relations = scene.domains.relations.iter();
        relations.all(|r| r.excess.evaluate(point).is_none_or(|value| value > 0.0))
    };
    let mut point = at_fractions(scene, &mut next);
    for _ in 0..MOST {
        if keeps(&point) {
            break;
        }
        point = at_fractions(scene, &mut next);
    }
    point
}

/// Most points tried for one that keeps to the relations.
const MOST: usize = 1000;

fn at_fractions(scene: &Scene, next: &mut impl FnMut() -> f64) -> Point<f64> {
    let mut point = Point::default();
    for parameter in &scene.parameters {
        let value = within(scene.domains.symbols.get(&parameter.name), next());
        point.values.insert(parameter.name.clone(), value);
    }
    for [a, b] in &scene.domains.unit_vectors {
        let (sin, cos) = next().sin_cos();
        point.values.insert(a.clone(), cos);
        point.values.insert(b.clone(), sin);
    }
    point
}

fn within(domain: Option<&Domain>, fraction: f64) -> f64 {
    match domain.map(|d| {
        (
            d.low.as_ref().map(Limit::approximate),
            d.high.as_ref().map(Limit::approximate),
        )
    }) {
        None => 0.6 + fraction,
        Some((Some(low), Some(high))) => low + fraction * (high - low),
        Some((Some(low), None)) => low + 0.6 + fraction,
        Some((None, Some(high))) => high - 0.6 - fraction,
        Some((None, None)) => 0.6 + fraction,
    }
}
