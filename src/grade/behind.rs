//! The belief behind an equation that does not hold: a law written with a slip is true of the motion the slip leads to.
//!
//! In: a scene, an equation, and what its names stand for. Out: the beliefs under which it holds. Everything is tried in
//! doubles, at several points; one equation holds in few motions.

use super::Diagnosis;
use super::belief::{BELIEFS, Slip};
use super::believed::{NAMED, Written, doubles, words};
use crate::expr::{Expr, Point, Symbol};
use crate::numeric;
use crate::scene::{Ask, Contact, ContactLaw, EnergyWhen, Scene};

/// Points at which every belief is tried.
const POINTS: u64 = 3;

/// A name of an equation, what it asks of the motion, and which component of it.
pub(super) type Named = (Symbol, Ask, Option<usize>);

/// The beliefs under which the two sides agree.
pub(super) fn behind(scene: &Scene, [left, right]: [&Expr; 2], names: &[Named]) -> Vec<Diagnosis> {
    let points = points(scene, [left, right], names);
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

/// An equation, by what its two sides differ in the given quantities, in which just the energy is missing, or a multiple of it,
/// that a plastic impact loses.
pub(super) fn keeps_energy(scene: &Scene, gap: &Expr) -> Option<Diagnosis> {
    let belief = BELIEFS.iter().find(|b| b.code == "ENERGY_KEPT")?;
    let plastic = |c: &Contact| match &c.law {
        ContactLaw::Frictionless { restitution } => restitution.is_zero(),
        law => *law == ContactLaw::Sticking,
    };
    let truth = Slip::none(scene);
    let lost = Ask::Energy {
        when: EnergyWhen::Lost,
        of: None,
    };
    let share = |point: Point<f64>| {
        let share = gap.evaluate(&point)? / asked(scene, (&lost, None), &truth, &point)?;
        Some(share).filter(|k| k.is_finite() && *k != 0.0)
    };
    let shares: Option<Vec<f64>> = points(scene, [gap], &[]).into_iter().map(share).collect();
    let shares = shares.filter(|_| scene.contacts.iter().any(plastic))?;
    let same = |k: &f64| (k - shares[0]).abs() <= 1e-9 * k.abs();
    shares
        .iter()
        .all(same)
        .then(|| words(belief, &truth, false))
}

/// Points at which an equation is tried, all given quantities with values; those of `names` come from the motion.
fn points<const N: usize>(scene: &Scene, sides: [&Expr; N], names: &[Named]) -> Vec<Point<f64>> {
    let mut needed = numeric::needed(scene);
    sides.iter().for_each(|side| needed.add(side));
    needed
        .plain
        .retain(|name| names.iter().all(|(known, ..)| known != name));
    (11..11 + POINTS)
        .map(|seed| numeric::rounded(&numeric::random_point(&needed, &scene.domains, seed)))
        .collect()
}
