//! Rotation of bodies welded together about a fixed point; sense, turning back and end come from the motion itself.

use super::{Moved, Movers, NUDGE, REST, ROUNDING, Units, all_open, stopped};
use crate::expr::arithmetic::{cross, dot};
use crate::numeric::follow::mechanism::{Constraint, Goal, Mechanism, Mobile, Run};
use crate::numeric::follow::{Course, Lost, Passed, State, Why};
use crate::numeric::given::Freedom;
use crate::scene::{Turn, Until};
use std::f64::consts::TAU;

/// A rotation in numbers.
struct Rotation {
    movers: Movers,
    gravity: f64,
    torque: f64,
    /// Angular velocity at the beginning.
    spin: f64,
    /// The largest angular acceleration there can be.
    rate: f64,
    /// 1 counterclockwise, −1 clockwise.
    way: f64,
    /// Whether it rests where its weight has no moment, and nothing else acts.
    is_balanced: bool,
    units: Units,
}

impl Rotation {
    fn of(course: &Course<'_>, turn: &Turn, movers: Movers) -> Result<Rotation, Lost> {
        let gravity = course.optional(turn.gravity.as_ref(), "gravity")?;
        let torque = course.optional(turn.torque.as_ref(), "moment")?;
        let n = movers.bodies.len();
        let mass = movers.inertias.iter().fold(0.0, |a: f64, i| a.max(i[0]));
        let gyration = |[m, i]: [f64; 2]| if m > 0.0 { (i / m).sqrt() } else { 0.0 };
        let reach = |i: usize| {
            let [x, y] = movers.arm(i);
            x.hypot(y).max(gyration(movers.inertias[i]))
        };
        let length = (0..n).map(reach).fold(0.0, f64::max);
        if !(mass > 0.0 && length > 0.0) {
            return Err(without_inertia(course, turn));
        }
        let mut rotation = Rotation {
            spin: angular_velocity(course, &movers),
            movers,
            gravity,
            torque,
            rate: 0.0,
            way: 1.0,
            is_balanced: false,
            units: Units {
                length,
                time: 1.0,
                mass,
            },
        };
        rotation.fits(course, turn)?;
        rotation.decide(course, turn)?;
        Ok(rotation)
    }

    /// The bodies turn as one about the point, at the beginning.
    fn fits(&mut self, course: &Course<'_>, turn: &Turn) -> Result<(), Lost> {
        let w = self.spin;
        let start = self.movers.start(&self.units);
        let pulls = self.accelerations(1.0, &start).map_or(0.0, |a| a.abs());
        let least = (w.abs() + pulls.sqrt()) * self.units.length;
        let speeds = self.movers.states.iter().map(|s| s[3].hypot(s[4]));
        let fastest = speeds.fold(least, f64::max);
        for i in 0..self.movers.bodies.len() {
            let r = self.movers.arm(i);
            let [.., u, v, spin] = self.movers.states[i];
            let gap = (u + w * r[1]).hypot(v - w * r[0]);
            let is_rigid = course.solids[self.movers.bodies[i]].freedom == Freedom::Rigid;
            let slip = match is_rigid {
                true => (spin - w).abs() * self.units.length,
                false => 0.0,
            };
            if gap.max(slip) > ROUNDING * fastest {
                let name = &course.solids[self.movers.bodies[i]].name;
                let about = &turn.about_name;
                let why = format!("at its beginning `{name}` does not turn about {about}");
                return Err(course.contradiction(why));
            }
            // What is left is rounding; from here on the constraints hold.
            self.movers.states[i][3] = -w * r[1];
            self.movers.states[i][4] = w * r[0];
            self.movers.states[i][5] = w;
        }
        Ok(())
    }

    /// The sense of the rotation, whether a push is needed, and the unit of time.
    fn decide(&mut self, course: &Course<'_>, turn: &Turn) -> Result<(), Lost> {
        let broken = || without_inertia(course, turn);
        let start = self.movers.start(&self.units);
        let torque = std::mem::replace(&mut self.torque, 0.0);
        let mut weight = 0.0f64;
        for k in 0..16 {
            let y = turned(&start, TAU * f64::from(k) / 16.0);
            weight = weight.max(self.accelerations(1.0, &y).ok_or_else(broken)?.abs());
        }
        let begins = self.accelerations(1.0, &start).ok_or_else(broken)?;
        self.torque = torque;
        let moment = self.accelerations(1.0, &start).ok_or_else(broken)? - begins;
        // Seen at sixteen places only; between them it can be larger by the cosine of an eleventh of a half turn.
        self.rate = 1.02 * weight + moment.abs();
        let moves = self.spin.abs() > REST * self.rate.sqrt();
        let declared = turn.clockwise.map(|c| if c { -1.0 } else { 1.0 });
        self.is_balanced =
            !moves && torque == 0.0 && begins.abs() <= REST * self.rate && self.rate > 0.0;
        let lasts = matches!(turn.until, Until::For(_));
        // From rest it goes where its weight pulls it.
        let pulled = match moves {
            true => self.spin,
            false if torque == 0.0 && !self.is_balanced => begins,
            false => 0.0,
        };
        self.way = match (moves, declared) {
            (_, Some(way)) if way * pulled < 0.0 => {
                let sense = if way > 0.0 { "" } else { "counter" };
                return Err(course.contradiction(format!("it begins to turn {sense}clockwise")));
            }
            (true, _) => self.spin.signum(),
            (false, Some(way)) => way,
            // A moment counts in the sense of the rotation.
            (false, None) if torque != 0.0 => 1.0,
            (false, None) if !self.is_balanced && self.rate > 0.0 => begins.signum(),
            (false, None) if lasts => 1.0,
            (false, None) => {
                let why = "it is at rest, and nothing says which way it begins to turn";
                return Err(course.contradiction(why));
            }
        };
        let unit = 1.0 / (self.rate.sqrt() + self.spin.abs());
        self.units.time = match &turn.until {
            _ if unit.is_finite() => unit,
            Until::For(time) => course.number(time, "time")?,
            _ => return Err(course.never("it is at rest, and nothing sets it going")),
        };
        Ok(())
    }

    fn mechanism(&self, way: f64) -> Mechanism {
        let units = &self.units;
        let n = self.movers.bodies.len();
        let arm = self.movers.arm(0).map(|r| -r / units.length);
        let mut constraints = vec![Constraint::Pin { body: 0, arm }];
        constraints.extend(self.movers.welds(0, 1..n, units));
        let fall = [0.0, -self.gravity];
        let mut out = self.movers.mechanism(units, fall, constraints, |_| true);
        out.forces[0][2] = way * self.torque / (units.force() * units.length);
        out
    }

    /// Angular acceleration in the units.
    fn accelerations(&self, way: f64, y: &[f64]) -> Option<f64> {
        Some(self.mechanism(way).accelerations(y)?.0[2])
    }

    /// Force of the fixed point.
    fn reaction(&self, mechanism: &Mechanism, y: &[f64]) -> Option<[f64; 2]> {
        let (_, forces) = mechanism.accelerations(y)?;
        Some([forces[0], forces[1]].map(|f| f * self.units.force()))
    }

    /// The angle to the place straight above or below, in the sense of the rotation.
    fn angle_to(&self, course: &Course<'_>, is_above: bool) -> Result<f64, Lost> {
        let mass: f64 = self.movers.inertias.iter().map(|i| i[0]).sum();
        let center = [0, 1].map(|k| {
            let all = self.movers.inertias.iter().enumerate();
            all.map(|(i, [m, _])| m * self.movers.arm(i)[k])
                .sum::<f64>()
                / mass
        });
        if center[0].hypot(center[1]) <= REST * self.units.length {
            return Err(course.contradiction("the center of mass lies in the fixed point"));
        }
        let target = [0.0, if is_above { 1.0 } else { -1.0 }];
        let angle = (self.way * cross(&center, &target)).atan2(dot(&center, &target));
        let angle = angle.rem_euclid(TAU);
        let is_ahead = (ROUNDING..TAU - ROUNDING).contains(&angle);
        match is_ahead {
            true => Ok(angle),
            false => Err(course.contradiction("it is there at the beginning already")),
        }
    }

    fn run(&self, course: &Course<'_>, turn: &Turn, mechanism: &Mechanism) -> Result<Run, Lost> {
        let start = self.movers.start(&self.units);
        let stopped = |stop| stopped(course, stop, "it comes to rest before and turns back");
        let way = self.way;
        let n = 3 * self.movers.bodies.len();
        let (ahead, behind) = match &turn.until {
            Until::Stops if self.spin == 0.0 => {
                return Err(course.contradiction("it is at rest at the beginning already"));
            }
            Until::Stops => {
                let mut goal = Goal {
                    left: &|y| -way * y[n + 2],
                    rate: &|_| 1.0,
                    // Under its weight alone a body that has gone round once goes round for ever.
                    never: &mut |y, _| self.torque >= 0.0 && way * y[2] > TAU,
                };
                let never = |stop| super::stopped(course, stop, "it never comes to rest");
                return mechanism.until(&start, &mut goal).map_err(never);
            }
            Until::For(time) => {
                let time = course.number(time, "time")?;
                if time < 0.0 {
                    return Err(course.contradiction("the time is negative"));
                }
                return mechanism
                    .lasting(&start, time / self.units.time)
                    .map_err(stopped);
            }
            Until::By(by) => {
                let by = course.number(by, "angle")?;
                if by < 0.0 {
                    return Err(course.contradiction("the angle turned through is negative"));
                }
                (by, None)
            }
            Until::Above | Until::Below => {
                let angle = self.angle_to(course, matches!(turn.until, Until::Above))?;
                (angle, Some(angle - TAU))
            }
        };
        let start = match self.is_balanced && ahead > 0.0 {
            true => turned(&start, way * NUDGE),
            false => start,
        };
        let left = |y: &[f64]| {
            let angle = way * y[2];
            behind.map_or(angle - ahead, |b: f64| {
                (angle - ahead).max(b.min(-REST * REST) - angle)
            })
        };
        let mut returns = u32::from(self.spin == 0.0);
        let mut never = |y: &[f64], turns_back: bool| {
            returns += u32::from(turns_back);
            match behind {
                // What turns back under constant forces does not get further later.
                None => way * y[n + 2] < -REST,
                Some(_) => returns >= 2 && turns_back,
            }
        };
        let mut goal = Goal {
            left: &left,
            rate: &|y| y[n + 2],
            never: &mut never,
        };
        mechanism.until(&start, &mut goal).map_err(stopped)
    }
}

/// Angular velocity about the point: of a body that has one, or of the particle farthest out.
fn angular_velocity(course: &Course<'_>, movers: &Movers) -> f64 {
    let is_rigid = |i: &usize| course.solids[movers.bodies[*i]].freedom == Freedom::Rigid;
    if let Some(i) = (0..movers.bodies.len()).find(is_rigid) {
        return movers.states[i][5];
    }
    let square = |i: usize| dot(&movers.arm(i), &movers.arm(i));
    let farthest = (0..movers.bodies.len()).max_by(|a, b| square(*a).total_cmp(&square(*b)));
    farthest.filter(|i| square(*i) > 0.0).map_or(0.0, |i| {
        let [.., u, v, _] = movers.states[i];
        cross(&movers.arm(i), &[u, v]) / square(i)
    })
}

fn without_inertia(course: &Course<'_>, turn: &Turn) -> Lost {
    let about = &turn.about_name;
    course.contradiction(format!("what turns has no moment of inertia about {about}"))
}

/// A state turned about the origin.
fn turned(y: &[f64], angle: f64) -> Vec<f64> {
    let (s, c) = angle.sin_cos();
    let n = y.len() / 2;
    let mut out = y.to_vec();
    for i in (0..y.len()).step_by(3) {
        (out[i], out[i + 1]) = (y[i] * c - y[i + 1] * s, y[i] * s + y[i + 1] * c);
        if i < n {
            out[i + 2] += angle;
        }
    }
    out
}

/// Rotation about a fixed point.
pub(in crate::numeric::follow) fn turn(
    course: &Course<'_>,
    before: State,
    turn: &Turn,
) -> Result<Passed, Lost> {
    let mut bodies: Vec<usize> = Vec::new();
    for b in turn.bodies() {
        if !bodies.contains(&b) {
            bodies.push(b);
        }
    }
    let has_weight = turn.gravity.is_some();
    // The bodies first: where they are open, the fixed point may have no value either.
    let Ok(mut movers) = Movers::of(course, &bodies, &before, [0.0; 2]) else {
        let time = match &turn.until {
            Until::For(time) => Ok(course.number(time, "time")?),
            _ => Err(course.open(Why::Needed)),
        };
        return Ok(all_open(course, before, &bodies, has_weight, time));
    };
    movers.from = course.pair(&turn.about, "the fixed point")?;
    let rotation = Rotation::of(course, turn, movers)?;
    let mechanism = rotation.mechanism(rotation.way);
    let run = rotation.run(course, turn, &mechanism)?;
    let units = &rotation.units;
    let begin = rotation.movers.start(units);
    let force = |y: &[f64]| {
        let force = rotation.reaction(&mechanism, y);
        let lost = || course.out_of_reach("the force of the fixed point has no value");
        force.map(|f| f.map(Ok)).ok_or_else(lost)
    };
    let reaction = [force(&begin)?, force(&run.end)?];
    let rates = |y: &[f64]| {
        let lost = || course.out_of_reach("the acceleration has no value");
        let (rates, _) = mechanism.accelerations(y).ok_or_else(lost)?;
        Ok(rates)
    };
    let ends = [rates(&begin)?, rates(&run.end)?];
    let square = units.time * units.time;
    let scales = [units.length / square, units.length / square, 1.0 / square];
    let at_end = |i: usize, k: usize| [0, 1, 2].map(|c| ends[k][3 * i + c] * scales[c]);
    let all = bodies.iter().enumerate();
    let accelerations = all
        .map(|(i, b)| (*b, [at_end(i, 0), at_end(i, 1)]))
        .collect();
    let is_pushed = rotation.is_balanced && run.time > 0.0 && !matches!(turn.until, Until::For(_));
    let (after, samples) = rotation.movers.ended(course, units, &run, &before);
    let time = match is_pushed {
        true => Err(course.open(Why::Push)),
        false => Ok(run.time * units.time),
    };
    let moved = Moved {
        clockwise: Some(rotation.way < 0.0),
        turned: Some(run.end[2] - begin[2]),
        reaction: Some(reaction),
        accelerations,
        bodies,
        samples,
        ..Moved::default()
    };
    Ok(course.moved([before, after], time, has_weight, moved))
}
