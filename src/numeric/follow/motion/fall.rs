//! Flight of bodies, with gravity or without, until a time, a height or a horizontal distance.

use super::{Moved, Movers, REST, ROUNDING, Units, all_open, stopped};
use crate::numeric::follow::mechanism::{Goal, Mechanism, Mobile, Run};
use crate::numeric::follow::{
    BodyState, Component, Course, Freedom, Lost, Open, Passed, State, Why,
};
use crate::scene::{Fall, FallEnd};

/// Said of a height that is not on the way.
const NEVER: &str = "it does not get to this height";

/// How a flight ends.
enum End {
    Time(f64),
    /// After the center has come down by this much.
    Height(f64),
    /// After the center has come to the right by this much.
    Range(f64),
    /// When the center rises no more.
    Top,
}

/// Flight, with gravity or without.
pub(in crate::numeric::follow) fn fall(
    course: &Course<'_>,
    before: State,
    fall: &Fall,
) -> Result<Passed, Lost> {
    let bodies = fall.bodies();
    if turn_together(course, &before, &bodies) {
        return Err(
            course.out_of_reach("bodies that are joined and turn do not fly each by itself")
        );
    }
    let gravity = course.optional(fall.gravity.as_ref(), "gravity")?;
    let end = match &fall.until {
        FallEnd::Time(time) => End::Time(course.number(time, "time")?),
        FallEnd::Drop(height) => End::Height(course.number(height, "height")?),
        FallEnd::Range(range) => End::Range(course.number(range, "range")?),
        FallEnd::Top => End::Top,
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
        End::Height(_) | End::Top => leader.velocity[1].is_ok(),
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
    let moved = Moved {
        bodies,
        samples: if is_known { samples } else { Vec::new() },
        ..Moved::default()
    };
    Ok(course.moved([before, after], time, fall.gravity.is_some(), moved))
}

/// Whether bodies in flight are joined to each other and turn, other than a particle at the center of what turns.
fn turn_together(course: &Course<'_>, before: &State, bodies: &[usize]) -> bool {
    let mut joined = before
        .joined
        .iter()
        .filter(|pair| pair.iter().all(|b| bodies.contains(b)));
    joined.any(|[a, b]| {
        let [one, two] = [a, b].map(|b| &before.bodies[*b]);
        let gap = one.velocity.iter().zip(&two.velocity);
        let moves_off = gap.into_iter().any(|pair| match pair {
            (Ok(u), Ok(v)) => (u - v).abs() > ROUNDING * u.abs().max(v.abs()).max(REST),
            _ => false,
        });
        let is_rigid = |b: &usize| course.solids[*b].freedom == Freedom::Rigid;
        let turns = |body: &BodyState| matches!(body.spin, Ok(w) if w.abs() > ROUNDING);
        moves_off || is_rigid(a) && is_rigid(b) && (turns(one) || turns(two))
    })
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
    let units = units_of(movers, gravity, end);
    let flight = Flight {
        course,
        mechanism: free(movers, gravity, &units),
        start: movers.start(&units),
    };
    let run = match end {
        End::Time(time) => {
            let run = flight.mechanism.lasting(&flight.start, time / units.time);
            run.map_err(|stop| stopped(course, stop, NEVER))?
        }
        End::Range(range) => flight.to_range(range / units.length, u)?,
        End::Top => flight.to_top(v)?,
        End::Height(height) => {
            let height = height / units.length;
            match (gravity > 0.0, is_rising) {
                (false, _) => flight.straight(height, v, gravity)?,
                (true, true) => flight.upward(height, v)?,
                (true, false) => flight.over_the_top(height)?,
            }
        }
    };
    Ok((units, run))
}

/// Units of the order of the flight.
fn units_of(movers: &Movers, gravity: f64, end: &End) -> Units {
    let [.., u, v, _] = movers.states[0];
    let time = match end {
        End::Time(time) => *time,
        End::Height(h) if gravity > 0.0 => {
            let deep = (v * v + 2.0 * gravity * h.abs()).sqrt();
            (v.abs() + deep) / gravity
        }
        End::Height(h) if v != 0.0 => (h / v).abs(),
        End::Range(s) if u != 0.0 => (s / u).abs(),
        End::Top if gravity > 0.0 => v / gravity,
        End::Height(_) | End::Range(_) | End::Top => 0.0,
    };
    let time = if time > 0.0 && time.is_finite() {
        time
    } else {
        1.0
    };
    let size = match end {
        End::Height(h) | End::Range(h) => h.abs(),
        End::Time(_) | End::Top => 0.0,
    };
    let length = size.max(u.hypot(v) * time).max(gravity.abs() * time * time);
    let mass = movers.inertias.iter().fold(0.0, |a: f64, i| a.max(i[0]));
    Units {
        length: if length > 0.0 { length } else { 1.0 },
        time: time / 8.0,
        mass: if mass > 0.0 { mass } else { 1.0 },
    }
}

/// Bodies that nothing but weight acts on.
fn free(movers: &Movers, gravity: f64, units: &Units) -> Mechanism {
    let mut out = movers.mechanism(units, [0.0, -gravity], Vec::new(), |_| false);
    // What has no mass falls as all else does.
    for (inertia, force) in out.inertias.iter_mut().zip(&mut out.forces) {
        if inertia[0] <= 0.0 {
            inertia[0] = 1.0;
            force[1] = -gravity * units.mass / units.force();
        }
    }
    out
}

/// Velocity upward of the body that decides the end.
fn rising(y: &[f64]) -> f64 {
    y[y.len() / 2 + 1]
}

/// Bodies in flight, in units of their own.
struct Flight<'a> {
    course: &'a Course<'a>,
    mechanism: Mechanism,
    start: Vec<f64>,
}

impl Flight<'_> {
    fn until(&self, start: &[f64], mut goal: Goal<'_>) -> Result<Run, Lost> {
        let run = self.mechanism.until(start, &mut goal);
        run.map_err(|stop| stopped(self.course, stop, NEVER))
    }

    /// Sideways over a range.
    fn to_range(&self, far: f64, u: f64) -> Result<Run, Lost> {
        let way = if far < 0.0 { -1.0 } else { 1.0 };
        if far != 0.0 && way * u <= 0.0 {
            return Err(self.course.never("it does not move that way"));
        }
        let goal = Goal {
            left: &|y| way * (y[0] - far),
            rate: &|_| 1.0,
            never: &mut |y, _| way * y[y.len() / 2] <= 0.0,
        };
        self.until(&self.start, goal)
    }

    /// Up to where it rises no more.
    fn to_top(&self, v: f64) -> Result<Run, Lost> {
        if v < 0.0 {
            return Err(self.course.never("it begins on its way down"));
        }
        let goal = Goal {
            left: &|y| -rising(y),
            rate: &|_| 1.0,
            never: &mut |_, _| false,
        };
        self.until(&self.start, goal)
    }

    /// Without weight, or with one that pulls upward, down through a height.
    fn straight(&self, height: f64, v: f64, gravity: f64) -> Result<Run, Lost> {
        let way = if height < 0.0 { -1.0 } else { 1.0 };
        if height != 0.0 && way * -v <= 0.0 && gravity * way <= 0.0 {
            return Err(self.course.never(NEVER));
        }
        let goal = Goal {
            left: &|y| way * (-y[1] - height),
            rate: &rising,
            never: &mut |y, _| way * -rising(y) <= 0.0,
        };
        self.until(&self.start, goal)
    }

    /// To a height on the way up.
    fn upward(&self, height: f64, v: f64) -> Result<Run, Lost> {
        if height > 0.0 || v < 0.0 {
            return Err(self.course.never(NEVER));
        }
        let goal = Goal {
            left: &|y| y[1] + height,
            rate: &rising,
            never: &mut |y, _| rising(y) <= 0.0,
        };
        self.until(&self.start, goal)
    }

    /// To a height on the way down: up to the highest place first.
    fn over_the_top(&self, height: f64) -> Result<Run, Lost> {
        let top = Goal {
            left: &|y| -rising(y),
            rate: &|_| 1.0,
            never: &mut |_, _| false,
        };
        let up = self.until(&self.start, top)?;
        if -up.end[1] - height > REST {
            return Err(self.course.never(NEVER));
        }
        let down = Goal {
            left: &|y| -y[1] - height,
            rate: &|_| 1.0,
            never: &mut |_, _| false,
        };
        let mut run = self.until(&up.end, down)?;
        let later = run.samples.drain(..).map(|(time, y)| (up.time + time, y));
        run.samples = up.samples.into_iter().chain(later.skip(1)).collect();
        run.time += up.time;
        Ok(run)
    }
}
