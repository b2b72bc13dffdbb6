//! What a contact with friction does on both sides of a coefficient.
//!
//! In: a scene, the impact of one of its stages, and what is told to begin or end at a value of its coefficient. Out: whether it does.

use super::{What, follow};
use crate::expr::Point;
use crate::numeric::friction::contact_space;
use crate::numeric::{given, solve_f64};
use crate::scene::{ContactLaw, FrictionEvent, Mode, Scene};

/// How far from the value its sides are looked at, in parts of it.
const ASIDE: f64 = 1e-3;

/// Whether what a contact with friction does changes at a value of its coefficient as told; `None` where it was not seen.
pub fn tips(
    scene: &Scene,
    stage: usize,
    (contact, event): (usize, FrictionEvent),
    at: f64,
    values: &Point<f64>,
) -> Option<bool> {
    let impact = &scene.stages.get(stage)?.scene;
    let ContactLaw::Friction(law) = &impact.contacts.get(contact)?.law else {
        return None;
    };
    let mu = law.mu.as_symbol()?;
    let sides = [-ASIDE, ASIDE].map(|step| at * (1.0 + step));
    if event == FrictionEvent::Jams {
        // While it slips, an impulse along n comes with μ times as much against the slip, in either of its directions.
        let given = given(impact, values).ok()?;
        let normal = given.contacts[contact].normal?;
        let space = contact_space(&given, contact, &normal, solve_f64).ok()?;
        let stops = |mu: f64, way: f64| space.c - way * mu * space.b > 0.0;
        let [below, above] = sides;
        return Some(
            [-1.0, 1.0]
                .iter()
                .any(|way| stops(below, *way) && !stops(above, *way)),
        );
    }
    let [below, above] = sides.map(|value| {
        let mut there = values.clone();
        there.values.insert(mu.clone(), value);
        let followed = follow(scene, &there).ok()?;
        match &followed.stages[stage].as_ref().ok()?.what {
            What::Impact(impact) => impact.mode,
            What::Motion(_) => None,
        }
    });
    let [below, above] = [below?, above?];
    let sticks = |mode: Mode| mode.sticks() || mode == Mode::InsideCone;
    let slides = |mode: Mode| matches!(mode, Mode::Slides | Mode::OnCone);
    Some(match event {
        FrictionEvent::Slides => slides(below) && !slides(above),
        _ => sticks(above) && !sticks(below),
    })
}
