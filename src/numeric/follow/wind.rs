//! A particle on a rope that winds round a pole, as the pole becomes thin.
//!
//! In: a stage and the state before. Out: the stage as [`Passed`]. The rope leaves the pole along a tangent, its free part
//! turns about the point where it does, and its pull is all that acts: a = (v²/L) towards that point. Integrated with two
//! poles of finite radius; the limit is taken from both (Richardson). Time and number of turns grow beyond bounds.

use super::super::given::Freedom;
use super::mechanism::integrated;
use super::{Course, Lost, Moved, Passed, State, Why};
use crate::expr::arithmetic::{cross, dot};
use crate::scene::Wind;

/// Radii of the poles, as shares of the rope.
const RADII: [f64; 2] = [1.0 / 25.0, 1.0 / 50.0];
/// Pieces in which the rope gets shorter.
const PIECES: usize = 400;

/// A rope that winds round a pole.
pub(super) fn wind(course: &Course<'_>, before: State, wind: &Wind) -> Result<Passed, Lost> {
    let mut after = before.clone();
    let body = &before.bodies[wind.body];
    let end = &mut after.bodies[wind.body];
    end.has_begun = true;
    match body.known() {
        Err(_) => end.leave_open(&course.open(Why::Needed)),
        Ok([x, y, angle, u, v, _]) => {
            let around = course.pair(&wind.around, "the pole")?;
            let to = course.number(&wind.to, "length")?;
            let arm = [x - around[0], y - around[1]];
            let speed = wound(course, arm, [u, v], to)?;
            let sense = cross(&arm, &[u, v]).signum();
            end.set([around[0] + to, around[1], angle, 0.0, sense * speed, 0.0]);
            if course.solids[wind.body].freedom != Freedom::Particle {
                end.angle = Err(course.open(Why::Pole));
                end.spin = Err(course.open(Why::Pole));
            }
        }
    }
    let moved = Moved {
        bodies: vec![wind.body],
        ..Moved::default()
    };
    let time = Err(course.open(Why::Pole));
    Ok(course.moved([before, after], time, false, moved))
}

/// Speed when the free rope is as long as `to`, on a thin pole.
fn wound(course: &Course<'_>, arm: [f64; 2], velocity: [f64; 2], to: f64) -> Result<f64, Lost> {
    let rope = arm[0].hypot(arm[1]);
    let speed = velocity[0].hypot(velocity[1]);
    if dot(&arm, &velocity).abs() > 1e-9 * rope * speed {
        return Err(course.contradiction("it does not begin to move straight across the rope"));
    }
    if !(rope > 0.0 && to > 0.0 && to <= rope) {
        return Err(course.contradiction("the rope gets shorter as it winds, and does not here"));
    }
    if to == rope {
        return Ok(speed);
    }
    if speed == 0.0 {
        return Err(course.never("it is at rest"));
    }
    let lost = || course.out_of_reach("the winding rope could not be integrated");
    let [thick, thin] = RADII.map(|radius| on_pole(radius, to / rope));
    let (thick, thin) = (thick.ok_or_else(lost)?, thin.ok_or_else(lost)?);
    Ok(speed * (2.0 * thin - thick))
}

/// The same with the rope and the speed as units. The pole stands so that the rope is a tangent at the beginning.
fn on_pole(radius: f64, to: f64) -> Option<f64> {
    let free = |y: &[f64]| (y[0] * y[0] + y[1] * y[1] - radius * radius).sqrt();
    let rates = |y: &[f64]| {
        let rope = free(y);
        // From the particle to the point where the rope leaves: back along the rope, the pole lying to the side.
        let square = y[0] * y[0] + y[1] * y[1];
        let along = [
            -(rope * y[0] - radius * y[1]) / square,
            -(rope * y[1] + radius * y[0]) / square,
        ];
        let across = y[2] * along[1] - y[3] * along[0];
        let pull = across * across / rope;
        Some(vec![y[2], y[3], pull * along[0], pull * along[1]])
    };
    // The rope lies along x, its free length is 1, and it leaves the pole at the pole's lowest place.
    let mut y = vec![1.0, -radius, 0.0, 1.0];
    for _ in 0..PIECES {
        let left = free(&y);
        // The rope gets shorter by the pole's radius times the angle; a piece is half a radian at most.
        let rate = (y[0] * y[2] + y[1] * y[3]) / left;
        let step = (0.5 * left).min((left - to) / rate.abs());
        let next = integrated(&rates, &y, step)?;
        if free(&next) <= to * (1.0 + 1e-13) {
            return Some(next[2].hypot(next[3]));
        }
        y = next;
    }
    None
}
