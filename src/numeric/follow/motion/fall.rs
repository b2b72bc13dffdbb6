//! Flight of bodies, with gravity or without, until a time, a height or a horizontal distance.

use super::{Moved, Movers, REST, Units, all_open, others, stopped};
use crate::numeric::follow::mechanism::{Asked, Goal, Mechanism, Mobile, Run};
use crate::numeric::follow::{BodyState, Component, Course, Lost, Open, Passed, State, What, Why};
use crate::scene::{Fall, FallEnd};
/// How a flight ends.
enum End {
    Time(f64),
    /// After the center has come down by this much.
    Height(f64),
    /// After the center has come to the right by this much.
    Range(f64),
}

/// Flight, with gravity or without.
pub(in crate::numeric::follow) fn fall(
    course: &Course<'_>,
    before: State,
    fall: &Fall,
) -> Result<Passed, Lost> {
    let bodies = fall.bodies();
    let gravity = course.optional(fall.gravity.as_ref(), "gravity")?;
    let end = match &fall.until {
        FallEnd::Time(time) => End::Time(course.number(time, "time")?),
        FallEnd::Drop(height) => End::Height(course.number(height, "height")?),
        FallEnd::Range(range) => End::Range(course.number(range, "range")?),
    };
    if matches!(end, End::Time(time) if time < 0.0) {
        return Err(course.contradiction("the time is negative"));
    }
    // Components that are open stay so; the others do not ask for them.
    let mut closed = before.clone();
    let leader = &before.bodies[fall.body];
    for b in &bodies {
        let body = &mut closed.bodies[*b];
        let [x, y] = &mut body.center;
        let [u, v] = &mut body.velocity;
        for component in [x, y, u, v, &mut body.angle, &mut body.spin] {
            if component.is_err() {
                *component = Ok(0.0);
            }
        }
    }
    let is_timed = match &end {
        End::Time(_) => true,
        End::Height(_) => leader.velocity[1].is_ok(),
        End::Range(_) => leader.velocity[0].is_ok(),
    };
    if !is_timed {
        let time = Err(course.open(Why::Needed));
        return Ok(all_open(
            course,
            before,
            &bodies,
            fall.gravity.is_some(),
            time,
        ));
    }
    let from = [0, 1].map(|k| closed.bodies[fall.body].center[k].clone().unwrap_or(0.0));
    let movers = Movers::of(course, &bodies, &closed, from)
        .map_err(|_| course.out_of_reach("the place of the body is open"))?;
    let (units, run) = flight(course, &movers, gravity, (&end, fall.rising))?;
    let sizes = [units.length, units.time, units.mass];
    if !sizes.iter().chain(&run.end).all(|x| x.is_finite()) {
        return Err(course.out_of_reach("the flight goes beyond the doubles"));
    }
    let (mut after, samples) = movers.ended(course, &units, &run, &closed);
    let open = course.open(Why::Needed);
    for b in &bodies {
        reopen(&before.bodies[*b], &mut after.bodies[*b], &open);
    }
    let is_known = bodies.iter().all(|b| before.bodies[*b].known().is_ok());
    let time = Ok(run.time * units.time);
    others(
        course,
        &before,
        &mut after,
        &bodies,
        &time,
        fall.gravity.is_some(),
    );
    let moved = Moved {
        bodies,
        clockwise: None,
        reaction: None,
        whirled: Vec::new(),
        driven: Vec::new(),
        samples: if is_known { samples } else { Vec::new() },
    };
    Ok(course.passed(time, before, after, What::Motion(moved)))
}

/// What was open stays open, and so do places that came from open velocities.
fn reopen(before: &BodyState, after: &mut BodyState, open: &Open) {
    let again = |was: &[&Component], now: &mut Component| {
        if was.iter().any(|c| c.is_err()) {
            *now = Err(open.clone());
        }
    };
    for k in 0..2 {
        let (place, rate) = (&before.center[k], &before.velocity[k]);
        again(&[place, rate], &mut after.center[k]);
        again(&[rate], &mut after.velocity[k]);
    }
    again(&[&before.angle, &before.spin], &mut after.angle);
    again(&[&before.spin], &mut after.spin);
}

/// The flight of bodies, of which the first one decides the end.
fn flight(
    course: &Course<'_>,
    movers: &Movers,
    gravity: f64,
    (end, is_rising): (&End, bool),
) -> Result<(Units, Run), Lost> {
    let [.., u, v, _] = movers.states[0];
    let time = match end {
        End::Time(time) => *time,
        End::Height(h) if gravity > 0.0 => {
            let deep = (v * v + 2.0 * gravity * h.abs()).sqrt();
            (v.abs() + deep) / gravity
        }
        End::Height(h) if v != 0.0 => (h / v).abs(),
        End::Range(s) if u != 0.0 => (s / u).abs(),
        End::Height(_) | End::Range(_) => 0.0,
    };
    let time = if time > 0.0 && time.is_finite() {
        time
    } else {
        1.0
    };
    let size = match end {
        End::Height(h) | End::Range(h) => h.abs(),
        End::Time(_) => 0.0,
    };
    let length = size.max(u.hypot(v) * time).max(gravity.abs() * time * time);
    let mass = movers.inertias.iter().fold(0.0, |a: f64, i| a.max(i[0]));
    let units = Units {
        length: if length > 0.0 { length } else { 1.0 },
        time: time / 8.0,
        mass: if mass > 0.0 { mass } else { 1.0 },
    };
    let weight = |m: f64| [0.0, -m * gravity / units.force(), 0.0];
    let mut inertias = movers.scaled(&units);
    // Without forces and moments on it, inertia does not matter; none would leave the equations open.
    for (inertia, _) in inertias.iter_mut().zip(&movers.bodies) {
        inertia[1] = inertia[1].max(1.0);
        inertia[0] = if inertia[0] > 0.0 { inertia[0] } else { 1.0 };
    }
    let forces = inertias
        .iter()
        .map(|[m, _]| weight(m * units.mass))
        .collect();
    let mechanism = Mechanism {
        inertias,
        constraints: Vec::new(),
        forces,
        asked: Asked::default(),
    };
    let start = movers.start(&units);
    let n = start.len() / 2;
    let stopped = |stop| stopped(course, stop, "it does not get to this height");
    let height = match end {
        End::Time(time) => {
            let run = mechanism
                .lasting(&start, time / units.time)
                .map_err(stopped)?;
            return Ok((units, run));
        }
        End::Height(height) => height / units.length,
        End::Range(range) => {
            let (far, way) = (range / units.length, if *range < 0.0 { -1.0 } else { 1.0 });
            let sideways = |y: &[f64]| y[n];
            let mut goal = Goal {
                left: &|y| way * (y[0] - far),
                rate: &|_| 1.0,
                never: &mut |y, _| way * sideways(y) <= 0.0,
            };
            let never = || course.never("it does not move that way");
            if *range != 0.0 && way * u <= 0.0 {
                return Err(never());
            }
            let run = mechanism.until(&start, &mut goal).map_err(stopped)?;
            return Ok((units, run));
        }
    };
    let never = || course.never("it does not get to this height");
    let rising = |y: &[f64]| y[n + 1];
    if gravity <= 0.0 {
        let way = if height < 0.0 { -1.0 } else { 1.0 };
        if height != 0.0 && way * -v <= 0.0 && gravity * way <= 0.0 {
            return Err(never());
        }
        let mut goal = Goal {
            left: &|y| way * (-y[1] - height),
            rate: &rising,
            never: &mut |y, _| way * -rising(y) <= 0.0,
        };
        let run = mechanism.until(&start, &mut goal).map_err(stopped)?;
        return Ok((units, run));
    }
    if is_rising {
        if height > 0.0 || v < 0.0 {
            return Err(never());
        }
        let mut goal = Goal {
            left: &|y| y[1] + height,
            rate: &rising,
            never: &mut |y, _| rising(y) <= 0.0,
        };
        let run = mechanism.until(&start, &mut goal).map_err(stopped)?;
        return Ok((units, run));
    }
    // Up to the highest place first: the stage ends on the way down.
    let mut top = Goal {
        left: &|y| -rising(y),
        rate: &|_| 1.0,
        never: &mut |_, _| false,
    };
    let up = mechanism.until(&start, &mut top).map_err(stopped)?;
    if -up.end[1] - height > REST {
        return Err(never());
    }
    let mut down = Goal {
        left: &|y| -y[1] - height,
        rate: &|_| 1.0,
        never: &mut |_, _| false,
    };
    let mut run = mechanism.until(&up.end, &mut down).map_err(stopped)?;
    let later = run.samples.drain(..).map(|(time, y)| (up.time + time, y));
    run.samples = up.samples.into_iter().chain(later.skip(1)).collect();
    run.time += up.time;
    Ok((units, run))
}
