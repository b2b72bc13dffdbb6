//! Motion of a body along a straight guide, without turning.

use super::{Moved, Movers, REST, ROUNDING, Units, all_open, others, stopped};
use crate::numeric::follow::impact::first_open;
use crate::numeric::follow::mechanism::{Constraint, Goal, Mechanism};
use crate::numeric::follow::{Course, Lost, Passed, State, What, Why};
use crate::numeric::number::{cross, dot};
use crate::scene::Slide;
use std::cell::Cell;

/// Motion along a line.
pub(in crate::numeric::follow) fn slide(
    course: &Course<'_>,
    before: State,
    slide: &Slide,
) -> Result<Passed, Lost> {
    let bodies = [slide.body];
    let has_forces = slide.gravity.is_some() || slide.force.is_some();
    let from = match before.bodies[slide.body].known() {
        Ok([x, y, ..]) => [x, y],
        Err(_) if first_open(before.bodies[slide.body].components()).is_some() => {
            let time = Err(course.open(Why::Needed));
            return Ok(all_open(course, before, &bodies, has_forces, time));
        }
        Err(_) => [0.0; 2],
    };
    let along = course.pair(&slide.along, "direction")?;
    let distance = course.number(&slide.distance, "distance")?;
    let gravity = course.optional(slide.gravity.as_ref(), "gravity")?;
    let force = course.optional(slide.force.as_ref(), "force")?;
    let movers = Movers::of(course, &bodies, &before, from)
        .map_err(|_| course.out_of_reach("the place of the body is open"))?;
    if distance < 0.0 {
        return Err(course.contradiction("the distance is negative"));
    }
    let [mass, _] = movers.inertias[0];
    if mass <= 0.0 {
        return Err(course.contradiction("what slides has no mass"));
    }
    let [.., u, v, spin] = movers.states[0];
    let speed = dot(&[u, v], &along);
    let across = cross(&along, &[u, v]);
    let pull = force / mass - gravity * along[1];
    let fastest = u.hypot(v) + (pull.abs() * distance).sqrt();
    let turning = spin.abs() * distance;
    if across.abs().max(turning) > ROUNDING * fastest {
        return Err(
            course.contradiction("it does not begin to move along the line without turning")
        );
    }
    let never = "it comes to rest before, or moves the other way";
    if distance > 0.0 && speed <= REST * fastest && pull <= 0.0 {
        return Err(course.never(never));
    }
    let time = distance / fastest / 8.0;
    let units = Units {
        length: if distance > 0.0 { distance } else { 1.0 },
        time: if time > 0.0 { time } else { 1.0 },
        mass,
    };
    let mechanism = Mechanism {
        inertias: movers.scaled(&units),
        constraints: vec![Constraint::Guide { body: 0, along }],
        forces: vec![[
            force * along[0] / units.force(),
            (force * along[1] - mass * gravity) / units.force(),
            0.0,
        ]],
        looks: Cell::new(0),
    };
    let mut start = movers.start(&units);
    // What is across the line, and the spin, are rounding.
    (start[3], start[4], start[5]) = (
        speed * along[0] / units.speed(),
        speed * along[1] / units.speed(),
        0.0,
    );
    let rate = |y: &[f64]| dot(&[y[3], y[4]], &along);
    let mut goal = Goal {
        left: &|y| dot(&[y[0], y[1]], &along) - distance / units.length,
        rate: &rate,
        never: &mut |y, _| rate(y) <= 0.0 && pull <= 0.0,
    };
    let run = mechanism
        .until(&start, &mut goal)
        .map_err(|stop| stopped(course, stop, never))?;
    let (mut after, samples) = movers.ended(course, &units, &run, &before);
    let time = Ok(run.time * units.time);
    others(course, &before, &mut after, &bodies, &time, has_forces);
    let moved = Moved {
        bodies: bodies.to_vec(),
        clockwise: None,
        reaction: None,
        samples,
    };
    Ok(course.passed(time, before, after, What::Motion(moved)))
}
