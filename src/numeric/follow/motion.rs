//! Motions between impacts: rotation about a point, sliding along a line, flight. Integrated in time.
//!
//! In: a stage and the state before. Out: the stage as [`Passed`], or why the motion does not get to its end. Sense of a
//! rotation, end and time come from the motion itself.

use std::cell::Cell;
use std::f64::consts::TAU;

use super::super::given::Freedom;
use super::super::number::{cross, dot};
use super::impact::first_open;
use super::mechanism::{Constraint, Goal, Mechanism, Run, Stop};
use super::{BodyState, Component, Course, Lost, Open, Passed, State, What, Why};
use crate::scene::{Fall, FallEnd, Slide, Turn, Until};

/// Differences below this share of what is at hand are rounding.
const ROUNDING: f64 = 1e-9;
/// Accelerations and speeds below this share are none.
const REST: f64 = 1e-12;
/// Angle at which a balanced body is taken up; what its weight does until there is of the order of its square.
const NUDGE: f64 = 1e-6;
/// Most samples that are kept of a motion.
const SAMPLES: usize = 400;

/// What bodies did during a motion.
#[derive(Clone, Debug)]
pub struct Moved {
    /// Indices of the bodies that the stage moves.
    pub bodies: Vec<usize>,
    /// Sense of a rotation.
    pub clockwise: Option<bool>,
    /// Force of the fixed point of a rotation on the bodies, at the beginning and at the end \[N\].
    pub reaction: Option<[[Component; 2]; 2]>,
    /// Places on the way, for pictures; empty where something is open.
    pub samples: Vec<Sample>,
}

/// Where the moved bodies are at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// Time since the beginning of the stage \[s\].
    pub time: f64,
    /// x, y \[m\] and angle \[rad\] of each body in [`Moved::bodies`].
    pub poses: Vec<[f64; 3]>,
}

/// Units in which a motion is of ordinary size.
#[derive(Clone, Copy)]
struct Units {
    length: f64,
    time: f64,
    mass: f64,
}

impl Units {
    fn speed(&self) -> f64 {
        self.length / self.time
    }

    fn force(&self) -> f64 {
        self.mass * self.length / self.time / self.time
    }
}

/// Bodies that move, with their state in numbers and the point from which places count.
struct Movers {
    bodies: Vec<usize>,
    from: [f64; 2],
    states: Vec<[f64; 6]>,
    /// Mass and moment of inertia about the center.
    inertias: Vec<[f64; 2]>,
}

impl Movers {
    fn of(
        course: &Course<'_>,
        bodies: &[usize],
        before: &State,
        from: [f64; 2],
    ) -> Result<Movers, Open> {
        let mut states = Vec::new();
        for b in bodies {
            let mut body = before.bodies[*b].clone();
            // How the picture of a body is turned does not matter for its motion.
            body.angle = body.angle.or(Ok(0.0));
            states.push(body.known()?);
        }
        let solids = bodies.iter().map(|b| &course.solids[*b]);
        Ok(Movers {
            bodies: bodies.to_vec(),
            from,
            states,
            inertias: solids.map(|s| [s.mass, s.inertia]).collect(),
        })
    }

    fn arm(&self, i: usize) -> [f64; 2] {
        [0, 1].map(|k| self.states[i][k] - self.from[k])
    }

    /// Masses in the units.
    fn scaled(&self, units: &Units) -> Vec<[f64; 2]> {
        let square = units.mass * units.length * units.length;
        let all = self.inertias.iter();
        all.map(|[m, i]| [m / units.mass, i / square]).collect()
    }

    /// The state in the units; angles count from the beginning.
    fn start(&self, units: &Units) -> Vec<f64> {
        let all = 0..self.bodies.len();
        let places = all.clone().flat_map(|i| {
            let [x, y] = self.arm(i).map(|r| r / units.length);
            [x, y, 0.0]
        });
        let rates = all.flat_map(|i| {
            let [_, _, _, u, v, w] = self.states[i];
            [u / units.speed(), v / units.speed(), w * units.time]
        });
        places.chain(rates).collect()
    }

    /// Place, angle, velocity and spin of each body from a state in the units.
    fn told(&self, units: &Units, y: &[f64]) -> Vec<[f64; 6]> {
        let n = 3 * self.bodies.len();
        let one = |i: usize| {
            let (q, v) = (&y[3 * i..3 * i + 3], &y[n + 3 * i..n + 3 * i + 3]);
            [
                self.from[0] + q[0] * units.length,
                self.from[1] + q[1] * units.length,
                self.states[i][2] + q[2],
                v[0] * units.speed(),
                v[1] * units.speed(),
                v[2] / units.time,
            ]
        };
        (0..self.bodies.len()).map(one).collect()
    }

    /// The state at the end, and the samples.
    fn ended(
        &self,
        course: &Course<'_>,
        units: &Units,
        run: &Run,
        before: &State,
    ) -> (State, Vec<Sample>) {
        let mut after = before.clone();
        for (b, state) in self.bodies.iter().zip(self.told(units, &run.end)) {
            let body = &mut after.bodies[*b];
            let angle = std::mem::replace(&mut body.angle, Ok(0.0));
            body.set(state);
            body.has_begun = true;
            if course.solids[*b].freedom == Freedom::Particle {
                (body.angle, body.spin) = (angle, Ok(0.0));
            } else if angle.is_err() {
                body.angle = angle;
            }
        }
        let stride = run.samples.len().div_ceil(SAMPLES);
        let last = run.samples.len() - 1;
        let picked = run.samples.iter().enumerate();
        let picked = picked.filter(|(k, _)| k % stride == 0 || *k == last);
        let samples = picked.map(|(_, (time, y))| Sample {
            time: time * units.time,
            poses: self
                .told(units, y)
                .iter()
                .map(|s| [s[0], s[1], s[2]])
                .collect(),
        });
        (after, samples.collect())
    }
}

/// What to say of a motion that stopped.
fn stopped(course: &Course<'_>, stop: Stop, never: &str) -> Lost {
    match stop {
        Stop::Never => course.never(never),
        Stop::TooLong => course.out_of_reach("the motion takes too many steps"),
        Stop::Broken => {
            course.out_of_reach("the equations of motion have no single solution in doubles")
        }
    }
}

/// A stage whose motion hangs on something open: the moving bodies end open too.
fn all_open(
    course: &Course<'_>,
    before: State,
    bodies: &[usize],
    has_forces: bool,
    time: Component,
) -> Passed {
    let open = course.open(Why::Needed);
    let mut after = before.clone();
    for b in bodies {
        after.bodies[*b].leave_open(&open);
        after.bodies[*b].has_begun = true;
    }
    others(course, &before, &mut after, bodies, &time, has_forces);
    let moved = Moved {
        bodies: bodies.to_vec(),
        clockwise: None,
        reaction: None,
        samples: Vec::new(),
    };
    course.passed(time, before, after, What::Motion(moved))
}

/// Bodies that the stage does not name: they wait, rest, fly on, or nobody knows.
pub(super) fn others(
    course: &Course<'_>,
    before: &State,
    after: &mut State,
    moving: &[usize],
    time: &Component,
    has_forces: bool,
) {
    let fastest = before.bodies.iter().chain(&after.bodies);
    let fastest = fastest.flat_map(|b| &b.velocity).flatten();
    let fastest = fastest.fold(0.0, |a: f64, v| a.max(v.abs()));
    let turning = before.bodies.iter().chain(&after.bodies);
    let turning = turning
        .flat_map(|b| &b.spin)
        .fold(0.0, |a: f64, w| a.max(w.abs()));
    let rests = |c: &Component, largest: f64| c.as_ref().is_ok_and(|v| v.abs() <= REST * largest);
    let joined = |b: usize| {
        let pairs = before.joined.iter().filter(|pair| pair.contains(&b));
        pairs.flatten().any(|other| moving.contains(other))
    };
    for (b, body) in after.bodies.iter_mut().enumerate() {
        if moving.contains(&b) || !body.has_begun {
            continue;
        }
        if joined(b) {
            body.leave_open(&course.open(Why::Joined));
            continue;
        }
        let is_at_rest =
            body.velocity.iter().all(|v| rests(v, fastest)) && rests(&body.spin, turning);
        if is_at_rest {
            continue;
        }
        let is_prescribed = course.solids[b].freedom == Freedom::Fixed;
        if has_forces && !is_prescribed {
            body.leave_open(&course.open(Why::Forces));
            continue;
        }
        let [u, v] = body.velocity.clone();
        let [x, y] = &mut body.center;
        for (place, rate) in [(x, u), (y, v), (&mut body.angle, body.spin.clone())] {
            *place = drifted(course, place, &rate, time);
        }
    }
}

/// A coordinate after uniform motion.
fn drifted(
    course: &Course<'_>,
    place: &Component,
    rate: &Component,
    time: &Component,
) -> Component {
    let start = place.clone()?;
    match (rate, time) {
        (Ok(0.0), _) => Ok(start),
        (Ok(rate), Ok(time)) => Ok(start + rate * time),
        (Err(_), Ok(0.0)) => Ok(start),
        (Err(_), _) => Err(course.open(Why::Needed)),
        (Ok(_), Err(_)) => Err(course.open(Why::Time)),
    }
}

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
        let length = (0..n)
            .map(|i| {
                movers.arm(i)[0]
                    .hypot(movers.arm(i)[1])
                    .max(gyration(movers.inertias[i]))
            })
            .fold(0.0, f64::max);
        if !(mass > 0.0 && length > 0.0) {
            return Err(course.contradiction(format!(
                "what turns has no moment of inertia about {}",
                turn.about_name
            )));
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
        let fastest = (0..self.movers.bodies.len())
            .map(|i| self.movers.states[i][3].hypot(self.movers.states[i][4]))
            .fold((w.abs() + pulls.sqrt()) * self.units.length, f64::max);
        for i in 0..self.movers.bodies.len() {
            let r = self.movers.arm(i);
            let [.., u, v, spin] = self.movers.states[i];
            let gap = (u + w * r[1]).hypot(v - w * r[0]);
            let is_rigid = course.solids[self.movers.bodies[i]].freedom == Freedom::Rigid;
            let slip = if is_rigid {
                (spin - w).abs() * self.units.length
            } else {
                0.0
            };
            if gap.max(slip) > ROUNDING * fastest {
                return Err(course.contradiction(format!(
                    "at its beginning `{}` does not turn about {}",
                    course.solids[self.movers.bodies[i]].name, turn.about_name
                )));
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
        let broken = || {
            course.contradiction(format!(
                "what turns has no moment of inertia about {}",
                turn.about_name
            ))
        };
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
        self.way = match (moves, declared) {
            (true, Some(way)) if way * self.spin < 0.0 => {
                let sense = if way > 0.0 {
                    "clockwise"
                } else {
                    "counterclockwise"
                };
                return Err(course.contradiction(format!("it begins to turn {sense}")));
            }
            (true, _) => self.spin.signum(),
            (false, Some(way)) => way,
            // A moment counts in the sense of the rotation.
            (false, None) if torque != 0.0 => 1.0,
            (false, None) if !self.is_balanced && self.rate > 0.0 => begins.signum(),
            (false, None) if lasts => 1.0,
            (false, None) => {
                return Err(course
                    .contradiction("it is at rest, and nothing says which way it begins to turn"));
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
        let scaled = |i: usize| self.movers.arm(i).map(|r| r / units.length);
        let [x, y] = scaled(0);
        let mut constraints = vec![Constraint::Pin {
            body: 0,
            arm: [-x, -y],
        }];
        constraints.extend((1..n).map(|i| {
            let [u, v] = scaled(i);
            Constraint::Weld {
                bodies: [0, i],
                arm: [u - x, v - y],
            }
        }));
        let mut forces: Vec<[f64; 3]> = self
            .movers
            .inertias
            .iter()
            .map(|[m, _]| [0.0, -m * self.gravity / units.force(), 0.0])
            .collect();
        forces[0][2] = way * self.torque / (units.force() * units.length);
        Mechanism {
            inertias: self.movers.scaled(units),
            constraints,
            forces,
            looks: Cell::new(0),
        }
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

    /// The angle to the place straight above or below, in the sense of the rotation; once round where it begins there.
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
        Ok(if (ROUNDING..TAU - ROUNDING).contains(&angle) {
            angle
        } else {
            TAU
        })
    }

    fn run(&self, course: &Course<'_>, turn: &Turn, mechanism: &Mechanism) -> Result<Run, Lost> {
        let start = self.movers.start(&self.units);
        let stopped = |stop| stopped(course, stop, "it comes to rest before and turns back");
        let way = self.way;
        let n = 3 * self.movers.bodies.len();
        let (ahead, behind) = match &turn.until {
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
            Until::Above => {
                let angle = self.angle_to(course, true)?;
                (angle, Some(angle - TAU))
            }
            Until::Below => {
                let angle = self.angle_to(course, false)?;
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
pub(super) fn turn(course: &Course<'_>, before: State, turn: &Turn) -> Result<Passed, Lost> {
    let mut bodies = turn.bodies();
    let mut seen = Vec::new();
    bodies.retain(|b| {
        !seen.contains(b) && {
            seen.push(*b);
            true
        }
    });
    let has_forces = turn.gravity.is_some() || turn.torque.is_some();
    // The bodies first: where they are open, the fixed point may have no value either.
    let Ok(mut movers) = Movers::of(course, &bodies, &before, [0.0; 2]) else {
        let time = match &turn.until {
            Until::For(time) => Ok(course.number(time, "time")?),
            _ => Err(course.open(Why::Needed)),
        };
        return Ok(all_open(course, before, &bodies, has_forces, time));
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
    let is_pushed = rotation.is_balanced && run.time > 0.0 && !matches!(turn.until, Until::For(_));
    let (mut after, samples) = rotation.movers.ended(course, units, &run, &before);
    let time = match is_pushed {
        true => Err(course.open(Why::Push)),
        false => Ok(run.time * units.time),
    };
    others(course, &before, &mut after, &bodies, &time, has_forces);
    let moved = Moved {
        bodies,
        clockwise: Some(rotation.way < 0.0),
        reaction: Some(reaction),
        samples,
    };
    Ok(course.passed(time, before, after, What::Motion(moved)))
}

/// Motion along a line.
pub(super) fn slide(course: &Course<'_>, before: State, slide: &Slide) -> Result<Passed, Lost> {
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

/// How a flight ends.
enum End {
    Time(f64),
    /// After the center has come down by this much.
    Height(f64),
    /// After the center has come to the right by this much.
    Range(f64),
}

/// Flight, with gravity or without.
pub(super) fn fall(course: &Course<'_>, before: State, fall: &Fall) -> Result<Passed, Lost> {
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
    let (units, run) = flight(course, &movers, gravity, &end)?;
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
    end: &End,
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
        looks: Cell::new(0),
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
