//! Whether a contact about which a body turns pushes it, or has to pull as only what grips can: the number beside the condition.

use std::iter::successors;

use super::{Followed, Moved, Passed, State, What, at_places, finite_pair, with_earlier};
use crate::expr::arithmetic::{difference, dot};
use crate::expr::{Point, Vector};
use crate::scene::{Scene, Stage, StageKind, Turn};

/// Distances and forces below this share of those at hand are rounding.
const ROUNDING: f64 = 1e-9;

/// The contact that has to pull what turns about it, at the beginning of a stage and at its end. Without a normal it pushes
/// towards the center of mass; with one that is known at the beginning only, for then the body shows it another side.
pub(super) fn pulls(
    scene: &Scene,
    (course, followed): (&[Stage], &Followed),
    (stage, passed): (&Stage, &Passed),
    values: &Point<f64>,
) -> [Option<String>; 2] {
    let found = (|| {
        let (StageKind::Turn(turn), What::Motion(moved)) = (&stage.kind, &passed.what) else {
            return None;
        };
        let there = at_places(stage, &passed.before, values);
        let pivot = finite_pair(&turn.about, &there, String::new).ok()?;
        let (name, normal) = grip(scene, (course, followed), (stage, turn, pivot), values)?;
        let goes_on =
            |j: usize| matches!(&course[j].kind, StageKind::Turn(t) if t.body == turn.body);
        let toward = |state: &State| Some(difference(&center(followed, turn, state)?, &pivot));
        let [begins, ends] = match normal {
            Some(normal) => [Some(normal), None],
            // The end of a rotation before it was looked at there.
            None if stage.from.is_some_and(goes_on) => [None, toward(&passed.after)],
            None => [toward(&passed.before), toward(&passed.after)],
        };
        let pulls = |along: Option<[f64; 2]>, k: usize| {
            let name = || name.clone();
            along
                .and_then(|along| is_pulled(moved, &along, k))
                .filter(|p| *p)
                .map(|_| name())
        };
        Some([pulls(begins, 0), pulls(ends, 1)])
    })();
    found.unwrap_or_default()
}

/// Whether the force of the fixed point, at the beginning or at the end, is against a direction.
fn is_pulled(moved: &Moved, along: &[f64; 2], k: usize) -> Option<bool> {
    let [x, y] = moved.reaction.as_ref()?[k].clone();
    let force = [x.ok()?, y.ok()?];
    let size = force[0].hypot(force[1]) * along[0].hypot(along[1]);
    Some(dot(&force, along) < -ROUNDING * size)
}

/// The center of mass of what turns.
fn center(followed: &Followed, turn: &Turn, state: &State) -> Option<[f64; 2]> {
    let (mut mass, mut moment) = (0.0, [0.0; 2]);
    for b in turn.bodies() {
        let m = followed.solids[b].mass;
        mass += m;
        for (moment, c) in moment.iter_mut().zip(&state.bodies[b].center) {
            *moment += m * c.clone().ok()?;
        }
    }
    (mass > 0.0).then(|| moment.map(|s| s / mass))
}

/// The contact that holds the fixed point since the last impact there, with the direction in which it pushes the body where the
/// scene gives it; `None` where a hinge or a string does.
fn grip(
    scene: &Scene,
    (course, followed): (&[Stage], &Followed),
    (stage, turn, pivot): (&Stage, &Turn, [f64; 2]),
    values: &Point<f64>,
) -> Option<(String, Option<[f64; 2]>)> {
    for j in successors(stage.from, |j| course[*j].from) {
        let (StageKind::Impact { .. }, Ok(struck)) = (&course[j].kind, &followed.stages[j]) else {
            continue;
        };
        let known = with_earlier(scene, followed, &course[j], values);
        let there = at_places(&course[j], &struck.before, &known);
        let pair = |v: &Vector| finite_pair(v, &there, String::new).ok();
        let holds = |bodies: &[usize; 2], at: &Vector| {
            let Some(at) = pair(at).filter(|_| bodies.contains(&turn.body)) else {
                return false;
            };
            let gap = difference(&at, &pivot);
            let arm =
                center(followed, turn, &struck.before).map_or([0.0; 2], |c| difference(&c, &pivot));
            let size = arm[0].hypot(arm[1]).max(pivot[0].hypot(pivot[1]));
            gap[0].hypot(gap[1]) <= ROUNDING * size
        };
        let impact = &course[j].scene;
        if impact.hinges.iter().any(|h| holds(&h.bodies, &h.at)) {
            return None;
        }
        if let Some(contact) = impact.contacts.iter().find(|c| holds(&c.bodies, &c.at)) {
            let sign = if contact.bodies[1] == turn.body {
                1.0
            } else {
                -1.0
            };
            let normal = contact.normal.as_ref().and_then(pair);
            let pushes = normal.map(|n| n.map(|c| sign * c));
            return (!contact.is_string).then(|| (contact.name.clone(), pushes));
        }
    }
    None
}
