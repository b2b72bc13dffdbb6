//! A closed form in doubles beside nalgebra's solution in doubles.
//!
//! In: the form of an answer, and the scene. Out: a check that tells by how many units in the last place they differ. A
//! value that all but vanishes has no digits of its own: it is measured by what a change of the data's last digits would
//! make of it, as the independent solution shows.

use super::{Check, Run, asked, numeric_value};
use crate::answer::Answer;
use crate::derive::Derivation;
use crate::expr::{Expr, Point};
use crate::numeric;
use crate::scene::{Ask, Scene};

/// Differences up to this many units in the last place of the value need no other measure.
const CLOSE: f64 = 4096.0;
/// Relative change of the data by which the condition is found: far above rounding, far below the data.
const NUDGE: f64 = 1.0 / (1 << 20) as f64;
/// Doubles may lose digits for good reasons; only a loss of all of them is a contradiction.
const ALL_LOST: f64 = 1e12;

/// The formula in doubles against nalgebra's solution in doubles.
pub(super) fn check(
    scene: &Scene,
    derivation: &Derivation,
    answer: &Answer,
    closed: &Expr,
    runs: &[Run<f64>],
) -> Check {
    // A component is as exact as its vector is: one that vanishes has no digits of its own.
    let of_one_vector = |a: &&Answer| {
        a.question == answer.question && a.axis().is_some() && answer.axis().is_some()
    };
    let siblings = derivation.answers.iter().filter(of_one_vector);
    let siblings: Vec<Ask> = siblings.filter_map(|a| asked(scene, a)).collect();
    let ask = asked(scene, answer);
    let mut worst: f64 = 0.0;
    let mut count = 0;
    // Whether a value was measured by what it is made of.
    let mut weighed = false;
    for run in runs {
        let point = &run.point;
        let Some(value) = closed.evaluate(&run.named) else {
            continue;
        };
        let Some(ask) = &ask else {
            continue;
        };
        let Some((expected, length)) = value_of(ask, &siblings, run) else {
            continue;
        };
        let scale = length.max(value.abs()).max(expected.abs());
        // A value that vanishes exactly has no relative error; what the solver leaves there is rounding of its terms.
        let unit = if closed.is_zero() { 1.0 } else { scale };
        let apart = (value - expected).abs();
        let mut off = apart / (unit * f64::EPSILON);
        if off > CLOSE {
            let condition = condition(scene, ask, point, expected);
            let weight = condition.max(size_before(ask, run));
            weighed |= weight > unit;
            off = apart / (weight.max(unit) * f64::EPSILON);
        }
        worst = worst.max(off);
        count += 1;
    }
    if count == 0 {
        return Check::new("doubles", "no value in doubles", None);
    }
    Check::new(
        "doubles",
        match weighed {
            false => format!("within {worst:.0} ulp of nalgebra's solution in doubles"),
            true if worst < 0.5 => String::from(
                "as near to nalgebra's solution in doubles as rounding of the data allows",
            ),
            true => format!(
                "within {worst:.0} times what rounding of the data makes of it, of nalgebra's solution in doubles"
            ),
        },
        Some(worst < ALL_LOST),
    )
}

/// The independent solution at a point: LU with refinement, and the nearest doubles where a pivot seems to vanish.
pub(super) fn run(scene: &Scene, point: Point<f64>) -> Option<Run<f64>> {
    super::run(scene, point, |system| {
        let refined = numeric::lu_scaled(system, 2).map(numeric::Solution::determined);
        refined.map_or_else(|| numeric::solve_f64(system), Ok)
    })
}

/// The independent value of an answer, and the length of the vector it is a component of.
fn value_of(ask: &Ask, siblings: &[Ask], run: &Run<f64>) -> Option<(f64, f64)> {
    let value = numeric_value(ask, run)?;
    let length = siblings
        .iter()
        .filter_map(|ask| numeric_value(ask, run))
        .fold(f64::MIN_POSITIVE, |length, x| length.max(x.abs()));
    Some((value, length))
}

/// The largest quantity of its kind just before, as the independent solution is given it: what is zero everywhere has no size of
/// its own, and no change of the data shows one.
fn size_before(ask: &Ask, run: &Run<f64>) -> f64 {
    let bodies = run.given.bodies.iter();
    let speed = |v: &[f64; 2]| v[0].abs().max(v[1].abs());
    match ask {
        Ask::Energy { .. } => numeric::energy_before(&run.given, None),
        Ask::Velocity { .. } => bodies.map(|b| speed(&b.velocity)).fold(0.0, f64::max),
        Ask::Impulse { .. } => {
            let all = bodies.map(|b| b.mass * speed(&b.velocity));
            all.fold(0.0, f64::max)
        }
        _ => 0.0,
    }
}

/// Σ |xᵢ ∂f/∂xᵢ| over the data: what relative errors of the data do to the value.
fn condition(scene: &Scene, ask: &Ask, point: &Point<f64>, value: f64) -> f64 {
    let mut sum = 0.0;
    let mut add = |nudged: Point<f64>| {
        let there = run(scene, nudged).and_then(|run| value_of(ask, &[], &run));
        if let Some((there, _)) = there {
            sum += (there - value).abs() / NUDGE;
        }
    };
    for name in point.values.keys() {
        let mut nudged = point.clone();
        if let Some(x) = nudged.values.get_mut(name) {
            *x = if *x == 0.0 { NUDGE } else { *x * (1.0 + NUDGE) };
            add(nudged);
        }
    }
    for name in point.directions.keys() {
        let mut nudged = point.clone();
        if let Some((_, [cos, sin])) = nudged.directions.get_mut(name) {
            let (turn_sin, turn_cos) = NUDGE.sin_cos();
            (*cos, *sin) = (
                *cos * turn_cos - *sin * turn_sin,
                *sin * turn_cos + *cos * turn_sin,
            );
            add(nudged);
        }
    }
    sum
}
