//! Motion of bodies along a straight line: on a smooth guide, on a rough surface, or rolling on it.
//!
//! What presses a body on a rough surface is the multiplier of the constraint that keeps it there. Friction of that size
//! times its coefficient acts at the point of contact against the way this point moves, for as long as it moves.

use super::carried::carried;
use super::extents::stands;
use super::strings::{Ropes, across, fixed};
use super::{Driven, Moved, Movers, REST, ROUNDING, Units, all_open, rub, stopped, unsolved};
use crate::expr::arithmetic::{cross, dot};
use crate::numeric::follow::mechanism::{Constraint, Goal, Mechanism, Mobile, Run, Sprung};
use crate::numeric::follow::{Course, Lost, Passed, State, Why};
use crate::scene::{Slide, SlideEnd};

/// What acts along the line, in numbers.
struct Acting {
    along: [f64; 2],
    gravity: f64,
    /// Acceleration by gravity in the plane in which the press on the surface is found. A level surface is turned up for that: its
    /// bodies are pulled across their line alone.
    fall: [f64; 2],
    force: f64,
    /// Coefficient of friction.
    rough: Option<f64>,
    /// From the center to the point of contact, of a round body.
    contact: Option<[f64; 2]>,
    /// Stiffness of a spring, and the way at which it is relaxed.
    spring: Option<[f64; 2]>,
}

impl Acting {
    fn of(course: &Course<'_>, slide: &Slide) -> Result<Acting, Lost> {
        let along = course.pair(&slide.along, "direction")?;
        let is_on_surface = (slide.rolling || slide.friction.is_some()) && !slide.level;
        let body = &course.stage.scene.bodies[slide.body];
        let radius = match body.shape.radius() {
            Some(radius) if is_on_surface && slide.with.is_empty() => {
                Some(course.number(radius, "radius")?)
            }
            _ => None,
        };
        // The surface is below: of the two directions across the line the one that leads down.
        let down = match along[0] > 0.0 {
            true => [along[1], -along[0]],
            false => [-along[1], along[0]],
        };
        let gravity = course.optional(slide.gravity.as_ref(), "gravity")?;
        let spring = match &slide.spring {
            None => None,
            Some(spring) => Some([
                course.number(&spring.stiffness, "stiffness")?,
                course.number(&spring.relaxed, "length")?,
            ]),
        };
        let fall = if slide.level { down } else { [0.0, -1.0] };
        Ok(Acting {
            along,
            gravity,
            fall: fall.map(|d| d * gravity),
            force: course.optional(slide.force.as_ref(), "force")?,
            rough: (slide.friction.as_ref())
                .map(|mu| course.number(mu, "coefficient of friction"))
                .transpose()?,
            contact: radius.map(|r| [r * down[0], r * down[1]]),
            spring,
        })
    }

    /// Velocity of the point of contact along the line; of the body where it has no such point.
    fn slip(&self, [u, v]: [f64; 2], spin: f64) -> f64 {
        let [x, y] = self.contact.unwrap_or_default();
        dot(&[u - spin * y, v + spin * x], &self.along)
    }

    /// How much a spin of 1 adds to the slip.
    fn arm(&self) -> f64 {
        self.slip([0.0; 2], 1.0)
    }
}

/// Motion along a line.
pub(in crate::numeric::follow) fn slide(
    course: &Course<'_>,
    before: State,
    slide: &Slide,
) -> Result<Passed, Lost> {
    let before = match slide.bend {
        true => bent(course, before, slide)?,
        false => before,
    };
    let bodies = slide.bodies();
    let has_weight = slide.gravity.is_some();
    let begin = begun(course, slide, &before);
    let Ok(mut movers) = Movers::of(course, &bodies, &begin, [0.0; 2]) else {
        let time = Err(course.open(Why::Needed));
        return Ok(all_open(course, before, &bodies, has_weight, time));
    };
    movers.from = movers.arm(0);
    if let Some(below) = &slide.on {
        return carried(course, before, (slide, below), movers);
    }
    let acting = Acting::of(course, slide)?;
    let ropes = Ropes::of(course, slide, acting.along, &movers)?;
    let company = slide.company().len();
    let own: f64 = movers.inertias[..company].iter().map(|i| i[0]).sum();
    let mass = own + ropes.mass(&movers);
    if mass <= 0.0 {
        return Err(course.contradiction("what slides has no mass"));
    }
    let [.., u, v, spin] = movers.states[0];
    let speed = dot(&[u, v], &acting.along);
    let [hangs, drags] = ropes.weights(&movers);
    let pull = acting.force + acting.gravity * hangs + own * dot(&acting.fall, &acting.along);
    let rubs = acting.gravity * (drags + own * acting.rough.unwrap_or(0.0));
    let [pull, rubs] = [pull, rubs].map(|force| force / mass);
    let size = sizes(course, slide, &movers, &acting, [speed, pull, rubs])?;
    let turns = acting.contact.is_some();
    fits(course, (&movers, company), &acting, &size)?;
    ropes.fits(course, &movers, speed, size.speed)?;
    stands(course, slide, &before)?;
    let units = Units {
        length: size.length,
        time: size.time,
        mass,
    };
    let slip = acting.slip([u, v], spin);
    let grips = turns && slip.abs() <= ROUNDING * size.speed && !slide.is_smooth();
    let slips = acting.rough.is_some() && !grips;
    if slide.rolling && slip.abs() > ROUNDING * size.speed {
        return Err(course.contradiction("it slips when it is to begin to roll"));
    }
    let guides = guides(&acting, slips, &units);
    let first = guides.len();
    let mut mechanism = on_line(&movers, &units, &acting, company, guides, &ropes);
    let directions = directions(&acting, company, &ropes, bodies.len());
    let start = start_on_line(&movers, &units, &ropes, &directions, (speed, turns));
    let slipping_at = slips.then_some(slip);
    roughen(
        course,
        &mut mechanism,
        &start,
        (&acting, &ropes, &units),
        first,
        slipping_at,
    )?;
    let (rates, pulls) = mechanism
        .accelerations(&start)
        .ok_or_else(|| unsolved(course))?;
    let tensions = &pulls[pulls.len() - ropes.parts(&units).count()..];
    pull_only(course, &mechanism, tensions)?;
    let way = if slip < 0.0 { -1.0 } else { 1.0 };
    let sprung = sprung(course, &mechanism, &start, &acting, &units)?;
    let mobile: &dyn Mobile = match &sprung {
        Some(sprung) => sprung,
        None => &mechanism,
    };
    let rubbed = (way, rubs > 0.0);
    let run = to_the_end(course, slide, &acting, &units, mobile, &start, rubbed)?;
    let still = |y: &[f64]| way * slipping(&acting, &units, y) < -ROUNDING * size.speed;
    if turns && slips && !slide.is_smooth() && still(&run.end) {
        return Err(course.never("it rolls before"));
    }
    let rates = match &sprung {
        None => [rates.clone(), rates],
        Some(sprung) => {
            let [first, last] = [&start, &run.end].map(|y| sprung.accelerations_of(y));
            first.zip(last).ok_or_else(|| unsolved(course))?.into()
        }
    };
    let (after, samples) = movers.ended(course, &units, &run, &before);
    let way = gone(&before, &after, slide.body, acting.along);
    if ropes.room.iter().any(|room| way > room * (1.0 + ROUNDING)) {
        return Err(course.never("a body gets to the pulley of its string before"));
    }
    let moved = Moved {
        bodies: bodies.to_vec(),
        reaction: (slide.strings.is_empty() && slide.spring.is_none()).then(|| {
            let force = |rates: &Vec<f64>| {
                pressed((&movers, company), &acting, rates, &units, slide.level).map(Ok)
            };
            rates.each_ref().map(force)
        }),
        driven: driven(
            &bodies,
            &directions,
            &rates,
            (&ropes, company, tensions),
            &units,
        ),
        samples,
        ..Moved::default()
    };
    let time = Ok(run.time * units.time);
    Ok(course.moved([before, after], time, has_weight, moved))
}

/// Strings push nothing.
fn pull_only(course: &Course<'_>, mechanism: &Mechanism, tensions: &[f64]) -> Result<(), Lost> {
    let forces = mechanism.forces.iter().flatten();
    let largest = forces.fold(0.0, |a: f64, f| a.max(f.abs()));
    match tensions.iter().any(|t| *t < -ROUNDING * largest) {
        true => Err(course.contradiction("a string goes slack")),
        false => Ok(()),
    }
}

/// How each body on a line is driven, from the rates at the beginning and at the end and the tensions in the units.
fn driven(
    bodies: &[usize],
    directions: &[([f64; 2], f64)],
    rates: &[Vec<f64>; 2],
    (ropes, company, tensions): (&Ropes, usize, &[f64]),
    units: &Units,
) -> Vec<Driven> {
    let acceleration = units.length / (units.time * units.time);
    let lines = directions.iter().map(|(along, _)| along).enumerate();
    lines
        .filter(|(_, along)| **along != [0.0; 2])
        .map(|(i, along)| Driven {
            body: bodies[i],
            accelerations: rates
                .each_ref()
                .map(|r| dot(&[r[3 * i], r[3 * i + 1]], along) * acceleration),
            tension: (ropes.pull(i, company, tensions)).map(|t| t * units.force()),
        })
        .collect()
}

/// Force of the surface on the bodies, from the rates in the units: what they are accelerated with more than by the other forces.
/// What carries the weight on a level surface lies across the plane.
fn pressed(
    (movers, company): (&Movers, usize),
    acting: &Acting,
    rates: &[f64],
    units: &Units,
    is_level: bool,
) -> [f64; 2] {
    let unit = units.length / (units.time * units.time);
    [0, 1].map(|k| {
        let fall = if is_level { 0.0 } else { acting.fall[k] };
        let masses = movers.inertias[..company].iter().map(|i| i[0]).enumerate();
        let forces = masses.map(|(i, mass)| mass * (rates[3 * i + k] * unit - fall));
        forces.sum::<f64>() - acting.force * acting.along[k]
    })
}

/// The state behind a bend: what came along as one turns into the line.
fn bent(course: &Course<'_>, mut before: State, slide: &Slide) -> Result<State, Lost> {
    let along = course.pair(&slide.along, "direction")?;
    let [Ok(u), Ok(v)] = before.bodies[slide.body].velocity.clone() else {
        return Ok(before);
    };
    let speed = u.hypot(v);
    for b in slide.company() {
        let velocity = &mut before.bodies[b].velocity;
        if let [Ok(x), Ok(y)] = velocity
            && (*x - u).hypot(*y - v) <= ROUNDING * speed
        {
            *velocity = along.map(|c| Ok(speed * c));
        }
    }
    Ok(before)
}

/// The state at the beginning, with no spin of light pulleys left open.
fn begun(course: &Course<'_>, slide: &Slide, before: &State) -> State {
    let mut begin = before.clone();
    for p in slide.pulleys().filter(|p| course.solids[*p].mass == 0.0) {
        // Whatever a light pulley does takes nothing.
        let spin = &mut begin.bodies[p].spin;
        *spin = spin.clone().or(Ok(0.0));
    }
    begin
}

/// The motion with the spring that the first body meets; nothing without one.
fn sprung<'m>(
    course: &Course<'_>,
    mechanism: &'m Mechanism,
    start: &[f64],
    acting: &Acting,
    units: &Units,
) -> Result<Option<Sprung<'m>>, Lost> {
    let Some([stiffness, relaxed]) = acting.spring else {
        return Ok(None);
    };
    let push = pushed(mechanism, start, acting.along).ok_or_else(|| unsolved(course))?;
    Ok(Some(Sprung {
        smooth: mechanism,
        along: acting.along,
        stiffness: stiffness / units.mass * units.time * units.time,
        push,
        relaxed: relaxed / units.length,
    }))
}

/// How the rates of all bodies change by one unit of force on the first one along a line.
fn pushed(mechanism: &Mechanism, start: &[f64], along: [f64; 2]) -> Option<Vec<f64>> {
    let mut with = mechanism.clone();
    rub(&mut with, 0, along, [0.0; 2], 1.0);
    let [with, without] = [&with, mechanism].map(|m| m.accelerations(start));
    let ((with, _), (without, _)) = (with?, without?);
    Some(with.iter().zip(without).map(|(a, b)| a - b).collect())
}

/// The direction of each body, with its speed as a share of that of the first one; nothing for what only turns.
fn directions(
    acting: &Acting,
    company: usize,
    ropes: &Ropes,
    bodies: usize,
) -> Vec<([f64; 2], f64)> {
    let mut directions = vec![(acting.along, 1.0); company];
    let ends = ropes.ends.iter();
    directions.extend(ends.flat_map(|e| e.hung().map(|_| (e.along, e.ratio))));
    directions.resize(bodies, ([0.0; 2], 0.0));
    directions
}

/// The state at the beginning: what is across the line is rounding, and so is the spin of what does not turn.
fn start_on_line(
    movers: &Movers,
    units: &Units,
    ropes: &Ropes,
    directions: &[([f64; 2], f64)],
    (speed, turns): (f64, bool),
) -> Vec<f64> {
    let mut start = movers.start(units);
    let n = start.len() / 2;
    for (i, (along, ratio)) in directions.iter().enumerate() {
        start[n + 3 * i] = speed * ratio * along[0] / units.speed();
        start[n + 3 * i + 1] = speed * ratio * along[1] / units.speed();
        if !turns || i > 0 {
            start[n + 3 * i + 2] = 0.0;
        }
    }
    for pulley in &ropes.pulleys {
        start[n + 3 * pulley.body + 2] = speed * pulley.spin * units.time;
    }
    start
}

/// Puts friction of the size that the press at the beginning gives on all that slides; `slip` is nothing where it rolls, which
/// takes no more friction than there is. The constraints of the strings follow the `first`.
fn roughen(
    course: &Course<'_>,
    mechanism: &mut Mechanism,
    start: &[f64],
    (acting, ropes, units): (&Acting, &Ropes, &Units),
    first: usize,
    slip: Option<f64>,
) -> Result<(), Lost> {
    let held = |mechanism: &Mechanism| {
        let at_start = mechanism.accelerations(start).map(|(_, held)| held);
        at_start.ok_or_else(|| unsolved(course))
    };
    let presses = held(mechanism)?;
    for (end, press) in ropes.ends.iter().zip(&presses[first..]) {
        let size = -end.rough.unwrap_or(0.0) * press.abs();
        rub(mechanism, end.bodies[0], end.along, [0.0; 2], size);
    }
    let Some(mu) = acting.rough else {
        return Ok(());
    };
    let held_at_start = held(mechanism)?;
    let press = held_at_start[0].abs();
    if let Some(slip) = slip {
        let way = if acting.contact.is_some() && slip < 0.0 {
            -1.0
        } else {
            1.0
        };
        let arm = acting.contact.unwrap_or_default().map(|r| r / units.length);
        rub(mechanism, 0, acting.along, arm, -way * mu * press);
    } else if held_at_start[1].abs() > mu * press * (1.0 + ROUNDING) {
        return Err(course.contradiction("the surface is too smooth for it to roll"));
    }
    Ok(())
}

/// The bodies begin to move together along the line, and turn only where they may.
fn fits(
    course: &Course<'_>,
    (movers, company): (&Movers, usize),
    acting: &Acting,
    size: &Sizes,
) -> Result<(), Lost> {
    let states = &movers.states[..company];
    let [.., u, v, spin] = states[0];
    let off = cross(&acting.along, &[u, v]).abs();
    // What has no extension turns nothing.
    let turning = match acting.contact {
        None if movers.inertias[0][1] > 0.0 => spin.abs() * size.length,
        _ => 0.0,
    };
    if off.max(turning) > ROUNDING * size.speed {
        let why = "it does not begin to move along the line without turning";
        return Err(course.contradiction(why));
    }
    if dot(&[u, v], &acting.along) < -ROUNDING * size.speed {
        return Err(course.contradiction("it begins to move against the direction of the line"));
    }
    for [.., a, b, _] in &states[1..] {
        if (a - u).abs().max((b - v).abs()) > ROUNDING * size.speed {
            return Err(course.contradiction("the bodies do not begin to move together"));
        }
    }
    Ok(())
}

/// What keeps the body on its line: nothing across it, and no turning or no slip.
fn guides(acting: &Acting, slips: bool, units: &Units) -> Vec<Constraint> {
    let mut guides = vec![across(0, acting.along)];
    match (acting.contact.is_some(), slips) {
        (false, _) => guides.push(fixed(2)),
        (true, true) => {}
        (true, false) => {
            // The point of contact stays at rest along the line.
            let [x, y] = acting.along;
            let row = vec![(0, x), (1, y), (2, acting.arm() / units.length)];
            guides.push(Constraint::Sum(row));
        }
    }
    guides
}

/// A length, a time and a speed of the order of the motion's.
struct Sizes {
    length: f64,
    time: f64,
    speed: f64,
}

fn sizes(
    course: &Course<'_>,
    slide: &Slide,
    movers: &Movers,
    acting: &Acting,
    [speed, pull, rubs]: [f64; 3],
) -> Result<Sizes, Lost> {
    let rim = movers.states[0][5].abs() * acting.arm().abs();
    let begins = movers.states[0][3].hypot(movers.states[0][4]) + rim;
    let rate = pull.abs() + rubs;
    let (length, fastest, time) = match &slide.until {
        SlideEnd::Distance(s) => {
            let s = course.number(s, "distance")?;
            if s < 0.0 {
                return Err(course.contradiction("the distance is negative"));
            }
            let fastest = begins + (rate * s).sqrt();
            let pushed = acting.spring.is_some_and(|[_, relaxed]| relaxed > 0.0);
            if s > 0.0 && !pushed && speed <= REST * fastest && pull <= 0.0 && rim == 0.0 {
                return Err(course.never(NEVER));
            }
            (s, fastest, s / fastest / 8.0)
        }
        SlideEnd::Time(t) => {
            let t = course.number(t, "time")?;
            if t < 0.0 {
                return Err(course.contradiction("the time is negative"));
            }
            let fastest = begins + rate * t;
            (fastest * t, fastest, t / 8.0)
        }
        SlideEnd::Stops | SlideEnd::Rolls | SlideEnd::Together => {
            let time = begins / rate;
            (begins * time, begins, time / 8.0)
        }
    };
    let (length, fastest, time) = match acting.spring {
        None => (length, fastest, time),
        Some([stiffness, relaxed]) => {
            // A quarter of a swing takes a little more than this.
            let swing = (movers.inertias.iter().map(|i| i[0]).sum::<f64>() / stiffness).sqrt();
            let reach = begins * swing + 2.0 * (rate * swing * swing + relaxed.abs());
            match &slide.until {
                SlideEnd::Distance(_) => {
                    let fastest = begins + (reach + length) / swing;
                    (length, fastest, (length / fastest / 8.0).min(swing))
                }
                _ => (reach, begins + reach / swing, swing),
            }
        }
    };
    let or_one = |v: f64| if v > 0.0 && v.is_finite() { v } else { 1.0 };
    Ok(Sizes {
        length: or_one(length),
        time: or_one(time),
        speed: fastest,
    })
}

const NEVER: &str = "it comes to rest before, or moves the other way";

/// The bodies on their lines, without friction: the body on the line and its company, the ends of strings, pulleys.
fn on_line(
    movers: &Movers,
    units: &Units,
    acting: &Acting,
    company: usize,
    guides: Vec<Constraint>,
    ropes: &Ropes,
) -> Mechanism {
    let welds = movers.welds(0, 1..company, units);
    let held = guides.into_iter().chain(ropes.guides()).chain(welds);
    let held = held
        .chain(ropes.joints(movers, units))
        .chain(ropes.parts(units));
    let is_pulley = |i: usize| ropes.pulleys.iter().any(|p| p.body == i);
    let mut out = movers.mechanism(units, acting.fall, held.collect(), is_pulley);
    rub(
        &mut out,
        0,
        acting.along,
        [0.0; 2],
        acting.force / units.force(),
    );
    out
}

/// The slip of a state in the units \[m/s\].
fn slipping(acting: &Acting, units: &Units, y: &[f64]) -> f64 {
    let n = y.len() / 2;
    let velocity = [y[n], y[n + 1]].map(|v| v * units.speed());
    acting.slip(velocity, y[n + 2] / units.time)
}

fn to_the_end(
    course: &Course<'_>,
    slide: &Slide,
    acting: &Acting,
    units: &Units,
    mechanism: &dyn Mobile,
    start: &[f64],
    (way, rubs): (f64, bool),
) -> Result<Run, Lost> {
    let n = start.len() / 2;
    let along = acting.along;
    let rate = |y: &[f64]| dot(&[y[n], y[n + 1]], &along);
    let gains = |f: &dyn Fn(&[f64]) -> f64| {
        // The change of something in a short time, at the rate with which it begins.
        let run = mechanism.lasting(start, 0.1).ok();
        run.is_none_or(|r| f(&r.end) >= f(start))
    };
    let stopped = |never: &'static str| move |stop| stopped(course, stop, never);
    match &slide.until {
        SlideEnd::Distance(distance) => {
            let far = course.number(distance, "distance")? / units.length;
            let slows = acting.spring.is_some() || !gains(&rate);
            let mut goal = Goal {
                left: &|y| dot(&[y[0], y[1]], &along) - far,
                rate: &rate,
                never: &mut |y, _| rate(y) <= 0.0 && slows,
            };
            mechanism.until(start, &mut goal).map_err(stopped(NEVER))
        }
        SlideEnd::Time(time) => {
            let time = course.number(time, "time")? / units.time;
            let run = mechanism.lasting(start, time).map_err(stopped(NEVER))?;
            let is_rubbed = rubs && acting.contact.is_none();
            match is_rubbed && rate(&run.end) < -ROUNDING {
                true => Err(course.never("friction stops it before")),
                false => Ok(run),
            }
        }
        SlideEnd::Stops | SlideEnd::Rolls | SlideEnd::Together => {
            let slip = |y: &[f64]| way * slipping(acting, units, y) / units.speed();
            // What comes to nothing in the end.
            let stops = matches!(slide.until, SlideEnd::Stops);
            let wanes: &dyn Fn(&[f64]) -> f64 = if stops { &rate } else { &slip };
            if !stops && wanes(start).abs() <= ROUNDING {
                // It rolls already, and what is left of its slip is rounding.
                let run = mechanism.lasting(start, 0.0);
                return run.map_err(stopped(NEVER));
            }
            let never = match stops {
                true => "nothing slows it down",
                false => "its slip grows",
            };
            if acting.spring.is_none() && gains(wanes) && wanes(start) > 0.0 {
                return Err(course.never(never));
            }
            // At rest a spring first has to set it going.
            let first = match acting.spring.is_some() && wanes(start) <= ROUNDING {
                true => 0.1,
                false => 0.0,
            };
            let first = mechanism.lasting(start, first).map_err(stopped(never))?;
            if acting.spring.is_some() && wanes(&first.end) < 0.0 {
                return Err(course.never("nothing moves it"));
            }
            let mut run = mechanism
                .until_grown(&first.end, &|y| -wanes(y))
                .map_err(stopped(never))?;
            // Where it rests, what is left of its speed is rounding; on a spring there may be no other speed to measure it by.
            let rest = match acting.spring.is_some() {
                true => f64::INFINITY,
                false if stops => ROUNDING,
                false => 0.0,
            };
            let rates = run.end[n..].iter_mut().filter(|v| v.abs() < rest);
            rates.for_each(|v| *v = 0.0);
            run.time += first.time;
            run.samples
                .iter_mut()
                .for_each(|(time, _)| *time += first.time);
            Ok(run)
        }
    }
}

/// How far a body has gone along a direction \[m\]; nothing where its place is open.
fn gone(before: &State, after: &State, body: usize, along: [f64; 2]) -> f64 {
    let centers = [before, after].map(|state| &state.bodies[body].center);
    let part = |k: usize| match [&centers[0][k], &centers[1][k]] {
        [Ok(from), Ok(to)] => (to - from) * along[k],
        _ => 0.0,
    };
    part(0) + part(1)
}
