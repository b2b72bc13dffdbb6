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
    /// When it has turned through this angle.
    Turned(f64),
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
    let clusters = turning(course, &before, &bodies)?;
    let gravity = course.optional(fall.gravity.as_ref(), "gravity")?;
    let end = match &fall.until {
        FallEnd::Time(time) => End::Time(course.number(time, "time")?),
        FallEnd::Drop(height) => End::Height(course.number(height, "height")?),
        FallEnd::Range(range) => End::Range(course.number(range, "range")?),
        FallEnd::Turned(angle) => End::Turned(course.number(angle, "angle")?),
        FallEnd::Top => End::Top,
    };
    let ends_at_place = matches!(end, End::Height(_) | End::Range(_) | End::Top);
    if ends_at_place && clusters.iter().any(|cluster| cluster.contains(&fall.body)) {
        return Err(course.out_of_reach("the place of a body that turns with another"));
    }
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
        End::Turned(_) => leader.spin.is_ok(),
        End::Height(_) | End::Top => leader.velocity[1].is_ok(),
        End::Range(_) => leader.velocity[0].is_ok(),
    };
    let is_known = bodies.iter().all(|b| before.bodies[*b].known().is_ok());
    if !is_timed || !clusters.is_empty() && !is_known {
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
    let stuck = clusters.iter().map(|cluster| {
        let place = |b: &usize| bodies.iter().position(|other| other == b).unwrap_or(0);
        cluster.iter().map(place).collect()
    });
    let flying = (&movers, stuck.collect::<Vec<_>>());
    let (units, run) = flight(course, &flying, gravity, (&end, fall.rising))?;
    let sizes = [units.length, units.time, units.mass];
    if !sizes.iter().chain(&run.end).all(|x| x.is_finite()) {
        return Err(course.out_of_reach("the flight goes beyond the doubles"));
    }
    let (mut after, samples) = movers.ended(course, &units, &run, &closed);
    let open = course.open(Why::Needed);
    for b in &bodies {
        reopen(&before.bodies[*b], &mut after.bodies[*b], &open);
    }
    let time = Ok(run.time * units.time);
    let moved = Moved {
        bodies,
        samples: if is_known { samples } else { Vec::new() },
        ..Moved::default()
    };
    Ok(course.moved([before, after], time, fall.gravity.is_some(), moved))
}

/// Bodies in flight that are joined to each other and turn, each cluster with the rigid one in front.
fn turning(course: &Course<'_>, before: &State, bodies: &[usize]) -> Result<Vec<Vec<usize>>, Lost> {
    let is_rigid = |b: usize| course.solids[b].freedom == Freedom::Rigid;
    let all = before.joined.iter();
    let joined: Vec<_> = all
        .filter(|pair| pair.iter().all(|b| bodies.contains(b)))
        .collect();
    let apart = |pair: &[usize; 2]| {
        let [one, two] = pair.map(|b| &before.bodies[b]);
        let gap = one.velocity.iter().zip(&two.velocity);
        let moves_off = gap.into_iter().any(|pair| match pair {
            (Ok(u), Ok(v)) => (u - v).abs() > ROUNDING * u.abs().max(v.abs()).max(REST),
            _ => false,
        });
        let turns = |body: &BodyState| matches!(body.spin, Ok(w) if w.abs() > ROUNDING);
        moves_off || pair.iter().all(|b| is_rigid(*b)) && (turns(one) || turns(two))
    };
    // What is joined to a body at so many places or more, and to what is by then, one after the other.
    let grown = |start: usize, places: &dyn Fn(usize) -> usize| {
        let mut cluster = vec![start];
        let joints = |cluster: &[usize], b: usize| {
            let to = |p: &&&[usize; 2]| p.contains(&b) && p.iter().any(|a| cluster.contains(a));
            joined.iter().filter(to).count()
        };
        let is_next = |cluster: &[usize], b: &&usize| {
            !cluster.contains(b) && joints(cluster, **b) >= places(**b)
        };
        while let Some(next) = bodies.iter().find(|b| is_next(&cluster, b)) {
            cluster.push(*next);
        }
        cluster
    };
    let mut out: Vec<Vec<usize>> = Vec::new();
    for start in bodies.iter().filter(|b| is_rigid(**b)) {
        if out.iter().any(|cluster| cluster.contains(start)) {
            continue;
        }
        let cluster = grown(*start, &|_| 1);
        let mut within = joined.iter().filter(|p| cluster.contains(&p[0]));
        if !within.any(|pair| apart(pair)) {
            continue;
        }
        // A body that is held at one place alone turns there by itself.
        if grown(*start, &|b| 1 + usize::from(is_rigid(b))).len() < cluster.len() {
            return Err(course.out_of_reach("bodies that turn and are joined at one place alone"));
        }
        out.push(cluster);
    }
    let is_in = |pair: &[usize; 2]| out.iter().any(|cluster| cluster.contains(&pair[0]));
    match joined.iter().any(|pair| apart(pair) && !is_in(pair)) {
        true => Err(course.out_of_reach("particles that are joined and move apart")),
        false => Ok(out),
    }
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
    flying: &(&Movers, Vec<Vec<usize>>),
    gravity: f64,
    (end, is_rising): (&End, bool),
) -> Result<(Units, Run), Lost> {
    let (movers, stuck) = flying;
    let [.., u, v, spin] = movers.states[0];
    let units = units_of(movers, gravity, end);
    let flight = Flight {
        course,
        mechanism: free(movers, stuck, gravity, &units),
        start: movers.start(&units),
    };
    let run = match end {
        End::Time(time) => {
            let run = flight.mechanism.lasting(&flight.start, time / units.time);
            run.map_err(|stop| stopped(course, stop, NEVER))?
        }
        End::Range(range) => flight.to_range(range / units.length, u)?,
        End::Top => flight.to_top(v)?,
        End::Turned(angle) => flight.to_angle(*angle, spin)?,
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
    let [.., u, v, spin] = movers.states[0];
    let time = match end {
        End::Time(time) => *time,
        End::Turned(angle) if spin != 0.0 => (angle / spin).abs(),
        End::Height(h) if gravity > 0.0 => {
            let deep = (v * v + 2.0 * gravity * h.abs()).sqrt();
            (v.abs() + deep) / gravity
        }
        End::Height(h) if v != 0.0 => (h / v).abs(),
        End::Range(s) if u != 0.0 => (s / u).abs(),
        End::Top if gravity > 0.0 => v / gravity,
        End::Height(_) | End::Range(_) | End::Turned(_) | End::Top => 0.0,
    };
    let time = if time > 0.0 && time.is_finite() {
        time
    } else {
        1.0
    };
    let size = match end {
        End::Height(h) | End::Range(h) => h.abs(),
        End::Time(_) | End::Turned(_) | End::Top => 0.0,
    };
    let length = size.max(u.hypot(v) * time).max(gravity.abs() * time * time);
    let mass = movers.inertias.iter().fold(0.0, |a: f64, i| a.max(i[0]));
    Units {
        length: if length > 0.0 { length } else { 1.0 },
        time: time / 8.0,
        mass: if mass > 0.0 { mass } else { 1.0 },
    }
}

/// Bodies that nothing but weight acts on, and those that are stuck together.
fn free(movers: &Movers, stuck: &[Vec<usize>], gravity: f64, units: &Units) -> Mechanism {
    let welds = stuck
        .iter()
        .flat_map(|cluster| movers.welds(cluster[0], cluster.iter().copied(), units));
    let is_stuck = |i: usize| stuck.iter().any(|cluster| cluster.contains(&i));
    let mut out = movers.mechanism(units, [0.0, -gravity], welds.collect(), is_stuck);
    // What has no mass falls as all else does.
    let alone = out.inertias.iter_mut().zip(&mut out.forces).enumerate();
    for (_, (inertia, force)) in alone.filter(|(i, _)| !is_stuck(*i)) {
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

    /// Until what keeps growing is no longer negative.
    fn until_grown(&self, start: &[f64], left: &dyn Fn(&[f64]) -> f64) -> Result<Run, Lost> {
        let run = self.mechanism.until_grown(start, left);
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

    /// Round through an angle.
    fn to_angle(&self, angle: f64, spin: f64) -> Result<Run, Lost> {
        let way = spin.signum();
        if spin == 0.0 || angle < 0.0 {
            return Err(self.course.never("it does not turn that way"));
        }
        self.until_grown(&self.start, &|y| way * y[2] - angle)
    }

    /// Up to where it rises no more.
    fn to_top(&self, v: f64) -> Result<Run, Lost> {
        if v < 0.0 {
            return Err(self.course.never("it begins on its way down"));
        }
        self.until_grown(&self.start, &|y| -rising(y))
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
        let up = self.until_grown(&self.start, &|y| -rising(y))?;
        if -up.end[1] - height > REST {
            return Err(self.course.never(NEVER));
        }
        let mut run = self.until_grown(&up.end, &|y| -y[1] - height)?;
        let later = run.samples.drain(..).map(|(time, y)| (up.time + time, y));
        run.samples = up.samples.into_iter().chain(later.skip(1)).collect();
        run.time += up.time;
        Ok(run)
    }
}
