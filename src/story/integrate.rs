//! Points at which motions are followed, and the one motion that no stage tells: a body on a spring while a blow lasts.
//!
//! In: domains, and what was found. Out: points in doubles, and a check. The motion is integrated in time from Newton's law.

use std::collections::BTreeSet;

use crate::answer::Check;
use crate::domain::Domains;
use crate::expr::{Expr, Point, Symbol};
use crate::numeric::follow::integrated;
use crate::numeric::points;

/// Points at which the motion is integrated.
const POINTS: usize = 3;
/// The first of the points that are tried are of ordinary size.
const ORDINARY: u64 = 12;
/// Relative difference that counts as agreement; the integrator works to 1e-12.
const CLOSE: f64 = 1e-7;

/// Most points drawn to find some that keep to the relations.
const DRAWS: u64 = 2000;
/// Their square and cube roots are independent, so that the points of a sequence of their multiples fill a box of all symbols
/// (Kronecker).
const PRIMES: [u32; 16] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53];

/// Points of the domain in doubles for some symbols: every symbol at its own irrational fraction of the interval, the same on
/// every machine; of these, points that keep to the relations.
pub(super) fn points_of(
    mut names: BTreeSet<Symbol>,
    domains: &Domains,
    count: usize,
) -> impl Iterator<Item = Point<f64>> {
    let bearing = domains.relations_of(&names);
    names.extend(bearing.iter().flat_map(|r| r.excess.symbols()));
    let value = move |name: &Symbol, k: usize, seed: u64| {
        let domain = domains.symbols.get(name).cloned().unwrap_or_default();
        let prime = f64::from(PRIMES[k % PRIMES.len()]);
        let fraction =
            (0.618_033_988_75 * (k + 1) as f64 + prime.sqrt() * seed as f64).fract() * 0.9 + 0.05;
        // Later points are of all sizes, and near the ends: a motion may get to its end only where something is large.
        let size = match seed {
            0..=ORDINARY => 1.0,
            _ => {
                let part = (0.754_877_666 * (k + 1) as f64 + prime.cbrt() * seed as f64).fract();
                10f64.powf(6.0 * part - 3.0)
            }
        };
        let share = match size <= 1.0 {
            true => fraction * size,
            false => 1.0 - fraction / size,
        };
        let step = (0.3 + 2.0 * fraction) * size;
        domain.at(share, step, (4.0 * fraction - 2.0) * size)
    };
    let all = (1..=DRAWS).filter_map(move |seed| {
        let mut point = Point::<f64>::default();
        let values = (0..).zip(&names);
        let values = values.map(|(k, name)| (name.clone(), value(name, k, seed)));
        point.values = values.collect();
        // Components of a unit vector lie on the circle.
        for [a, b] in &domains.unit_vectors {
            let along = point.values.get(a).copied();
            let (Some(along), Some(across)) = (along, point.values.get_mut(b)) else {
                continue;
            };
            *across = (1.0 - along * along).sqrt().copysign(*across);
            let domain = domains.symbols.get(b);
            if domain.is_some_and(|domain| !domain.admits(*across)) {
                return None;
            }
        }
        Some(point)
    });
    all.filter(|point| points::keeps(domains, point))
        .take(count)
}

fn check(worst: f64, count: usize, what: &str) -> Check {
    if count == 0 {
        return Check::new("integration", format!("{what}: not integrated"), None);
    }
    // The integrator works to 1e-12; what is below is the rounding of the machine at hand.
    let worst_shown = if worst <= 1e-12 { 1e-12 } else { worst };
    let points = if count == 1 { "point" } else { "points" };
    let words = format!(
        "{what} agrees with the motion integrated in time at {count} {points} (relative difference at most {worst_shown:.0e})"
    );
    Check::new("integration", words, Some(worst < CLOSE))
}

/// A body on a spring under a constant force: m y″ = 1/τ − k y over the time τ, from rest. The blow is 1, what is left of it
/// moves the body, and the spring has taken the rest.
pub(super) fn share(
    domains: &Domains,
    [mass, stiffness, during]: [&Expr; 3],
    share: &Expr,
) -> Check {
    let (mut worst, mut count) = (0.0f64, 0);
    let names = [mass, stiffness, during]
        .into_iter()
        .flat_map(|e| e.symbols());
    for point in points_of(names.collect(), domains, POINTS) {
        let value = |e: &Expr| e.evaluate(&point);
        let (Some(m), Some(k), Some(time), Some(expected)) =
            (value(mass), value(stiffness), value(during), value(share))
        else {
            continue;
        };
        let rates = |y: &[f64]| Some(vec![y[1], (1.0 / time - k * y[0]) / m]);
        let Some(end) = integrated(&rates, &[0.0, 0.0], time) else {
            continue;
        };
        let speed = end[1];
        worst = worst.max((1.0 - m * speed - expected).abs() / expected.abs().max(1e-9));
        count += 1;
    }
    check(worst, count, "what the spring takes")
}
