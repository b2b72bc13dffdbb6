//! The belief behind an equation that does not hold: a law written with a slip is true of the motion the slip leads to.
//!
//! In: a scene, an equation, and what its names stand for. Out: the beliefs under which it holds. Everything is tried in
//! doubles, at several points; one equation holds in few motions.

use super::Diagnosis;
use super::belief::BELIEFS;
use super::believed::{NAMED, Written, doubles, words};
use crate::expr::{Expr, Point, Symbol};
use crate::numeric;
use crate::scene::{Ask, Scene};

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
                    let written = Written {
                        scene,
                        ask,
                        component: *component,
                        values: Vec::new(),
                        rounding: None,
                    };
                    let [value] = doubles(&written, slip, &point)?[..] else {
                        return None;
                    };
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
