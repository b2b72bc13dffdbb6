//! Tests of the numeric side: known numbers (`cases`), laws over random scenes (`laws`), the same at
//! extreme scales (`extreme`).

pub(in crate::numeric) mod build;
mod cases;
mod extreme;
mod laws;
pub(in crate::numeric) mod random;
mod several;

use super::*;
use crate::expr::{Point, Rational};
use crate::scene::Scene;

/// The exact motion after of a scene without symbols.
fn solved(scene: &Scene) -> (Given<Rational>, System<Rational>, Motion<Rational>) {
    let given = given(scene, &Point::default()).expect("numbers everywhere");
    let system = assemble(&given);
    let solution = solve_exact(&system).expect("consistent");
    let motion = motion(&given, &system, &solution);
    (given, system, motion)
}
