//! The belief behind an equation that does not hold: a law written with a slip is true of the motion the slip leads to.
//!
//! In: a scene, an equation, and what its names stand for. Out: the beliefs under which it holds. Everything is tried in
//! doubles, at several points; one equation holds in few motions.

use super::Diagnosis;
use super::belief::{BELIEFS, Slip};
use super::believed::{NAMED, Written, doubles, words};
use crate::expr::{Expr, Point, Symbol};
use crate::numeric;
use crate::scene::{Ask, EnergyWhen, Scene};

/// Points at which every belief is tried.
const POINTS: u64 = 3;

/// A name of an equation, what it asks of the motion, and which component of it.
pub(super) type Named = (Symbol, Ask, Option<usize>);

/// The beliefs under which the two sides agree.
pub(super) fn behind(scene: &Scene, [left, right]: [&Expr; 2], names: &[Named]) -> Vec<Diagnosis> {
    let mut needed = numeric::needed(scene);
    needed.add(left);
    needed.add(right);
    needed
        .plain
        .retain(|name| names.iter().all(|(known, ..)| known != name));
    let points: Vec<Point<f64>> = (11..11 + POINTS)
        .map(|seed| numeric::rounded(&numeric::random_point(&needed, &scene.domains, seed)))
        .collect();
    let mut found = Vec::new();
    for belief in BELIEFS {
        let slips = (belief.slips)(scene);
        let agrees = slips.iter().find(|slip| {
            // Where something stays at rest, equations hold that say nothing about it.
            let mut moves = vec![false; names.len()];
            let mut at = |point: &Point<f64>| {
                let mut point = point.clone();
                for ((name, ask, component), moves) in names.iter().zip(&mut moves) {
                    let value = asked(scene, (ask, *component), slip, &point)?;
                    *moves |= value != 0.0;
                    point.values.insert(name.clone(), value);
                }
                let (a, b) = (left.evaluate(&point)?, right.evaluate(&point)?);
                Some((a - b).abs() <= 1e-9 * a.abs().max(b.abs()))
            };
            points.iter().all(|point| at(point) == Some(true)) && moves.iter().all(|m| *m)
        });
        found.extend(agrees.map(|slip| words(belief, slip, false)));
    }
    // What holds under very many beliefs tells none of them.
    if found.len() > NAMED {
        found.clear();
    }
    if found.is_empty() {
        found.extend(keeps_energy(scene, [left, right], names, &points));
    }
    found
}

/// What is asked, in the motion a slip leads to.
fn asked(
    scene: &Scene,
    (ask, component): (&Ask, Option<usize>),
    slip: &Slip,
    point: &Point<f64>,
) -> Option<f64> {
    let written = Written {
        scene,
        ask,
        component,
        values: Vec::new(),
        rounding: None,
    };
    match doubles(&written, slip, point)?[..] {
        [value] => Some(value),
        _ => None,
    }
}

/// A balance of velocities and spins in which just the energy is missing, or a multiple of it, that the impact loses.
fn keeps_energy(
    scene: &Scene,
    [left, right]: [&Expr; 2],
    names: &[Named],
    points: &[Point<f64>],
) -> Option<Diagnosis> {
    let belief = BELIEFS.iter().find(|b| b.code == "ENERGY_KEPT")?;
    let slip = (belief.slips)(scene).into_iter().next()?;
    let moves = |(_, ask, _): &Named| matches!(ask, Ask::Velocity { .. } | Ask::Spin { .. });
    if !names.iter().all(moves) {
        return None;
    }
    let truth = Slip {
        change: None,
        ..slip.clone()
    };
    let lost = Ask::Energy {
        when: EnergyWhen::Lost,
        of: None,
    };
    let share = |point: &Point<f64>| {
        let mut here = point.clone();
        for (name, ask, component) in names {
            let value = asked(scene, (ask, *component), &truth, point)?;
            here.values.insert(name.clone(), value);
        }
        let gap = left.evaluate(&here)? - right.evaluate(&here)?;
        Some(gap / asked(scene, (&lost, None), &truth, point)?).filter(|k| k.is_finite())
    };
    let shares: Vec<f64> = points.iter().map(share).collect::<Option<_>>()?;
    let first = *shares.first()?;
    let same = |k: &f64| (k - first).abs() <= 1e-9 * first.abs();
    (first != 0.0 && shares.iter().all(same)).then(|| words(belief, &slip, false))
}
