//! Motions between impacts: rotation about a point, sliding along a line with strings over pulleys, flight, linkages.
//! Integrated in time.
//!
//! In: a stage and the state before. Out: the stage as [`Passed`], or why the motion does not get to its end. Sense of a
//! rotation, end and time come from the motion itself.

mod carried;
mod extents;
mod fall;
mod linkage;
mod slide;
mod strings;
mod turn;

pub(super) use fall::fall;
pub(super) use linkage::linkage;
pub(super) use slide::slide;
pub(super) use turn::turn;

use super::super::given::Freedom;
use super::mechanism::{Asked, Constraint, Mechanism, Run, Stop};
use super::{Component, Course, Lost, Open, Passed, State, Why};
use crate::expr::arithmetic::{cross, difference};

/// Differences below this share of what is at hand are rounding.
const ROUNDING: f64 = 1e-9;
/// Accelerations and speeds below this share are none.
const REST: f64 = 1e-12;
/// Angle at which a balanced body is taken up; what its weight does until there is of the order of its square.
const NUDGE: f64 = 1e-6;
/// Share of a motion's time that parts two samples at least.
const CLOSE: f64 = 1e-4;
/// Most samples that are kept of a motion.
const SAMPLES: usize = 400;

/// What bodies did during a motion.
#[derive(Clone, Debug, Default)]
pub struct Moved {
    /// Indices of the bodies that the stage moves.
    pub bodies: Vec<usize>,
    /// Sense of a rotation.
    pub clockwise: Option<bool>,
    /// Angle of a rotation about a point, counterclockwise \[rad\]: of a particle too, which has none of its own.
    pub turned: Option<f64>,
    /// Force of the fixed point of a rotation, or of the surface of a slide, on the bodies, at the beginning and at the end \[N\].
    pub reaction: Option<[[Component; 2]; 2]>,
    /// Name of the contact that holds the fixed point where it has to pull, at the beginning and at the end.
    pub pulls: [Option<String>; 2],
    /// Index of each body of a rotation or a linkage, with its acceleration along x and y [m/s²] and its angular one [rad/s²], at the
    /// beginning and at the end.
    pub accelerations: Vec<(usize, [[f64; 3]; 2])>,
    /// Whether what slides on another body slides back over it; its distance along that one counts so.
    pub slides_back: bool,
    /// What drives each body of a motion along a line; empty for other motions.
    pub driven: Vec<Driven>,
    /// Places on the way, for pictures; empty where something is open.
    pub samples: Vec<Sample>,
}

impl Moved {
    /// Place and angle of the i-th moved body at a time: the cubic through the four samples around it.
    pub fn pose(&self, i: usize, time: f64) -> [f64; 3] {
        let samples = &self.samples;
        let next = samples.partition_point(|s| s.time < time);
        let first = next.saturating_sub(2).min(samples.len().saturating_sub(4));
        let near = &samples[first..samples.len().min(first + 4)];
        [0, 1, 2].map(|k| {
            let terms = near.iter().enumerate().map(|(j, s)| {
                let others = near.iter().enumerate().filter(|(m, _)| *m != j);
                let weight = others.map(|(_, o)| (time - o.time) / (s.time - o.time));
                s.poses[i][k] * weight.product::<f64>()
            });
            terms.sum()
        })
    }
}

/// How a body on a line is driven.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Driven {
    /// Index of the body.
    pub body: usize,
    /// Acceleration along its own way, at the beginning and at the end [m/s²].
    pub accelerations: [f64; 2],
    /// Pull of the string at it \[N\]; `None` without one, and with several.
    pub tension: Option<f64>,
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
        let after = arrived(course, before, &self.bodies, self.told(units, &run.end));
        let poses = |y: &[f64]| {
            let states = self.told(units, y).into_iter();
            Some(states.map(|[x, y, angle, ..]| [x, y, angle]).collect())
        };
        (after, sampled(run, units.time, poses))
    }

    /// The bodies under an acceleration by gravity. What neither turns nor has a moment of inertia needs one, for none would
    /// leave the equations open.
    fn mechanism(
        &self,
        units: &Units,
        fall: [f64; 2],
        constraints: Vec<Constraint>,
        turns: impl Fn(usize) -> bool,
    ) -> Mechanism {
        let mut inertias = self.scaled(units);
        for (i, inertia) in inertias.iter_mut().enumerate() {
            if inertia[1] <= 0.0 && !turns(i) {
                inertia[1] = 1.0;
            }
        }
        let weights = self.inertias.iter().map(|[m, _]| m / units.force());
        Mechanism {
            inertias,
            constraints,
            forces: weights.map(|m| [m * fall[0], m * fall[1], 0.0]).collect(),
            asked: Asked::default(),
        }
    }

    /// Bodies keep their places in the frame of another.
    fn welds(
        &self,
        lead: usize,
        bodies: impl IntoIterator<Item = usize>,
        units: &Units,
    ) -> Vec<Constraint> {
        let arm = |i: usize| difference(&self.arm(i), &self.arm(lead)).map(|r| r / units.length);
        let each = bodies.into_iter().filter(|i| *i != lead);
        each.map(|i| Constraint::Weld {
            bodies: [lead, i],
            arm: arm(i),
        })
        .collect()
    }
}

/// The state after a motion that brings bodies to these places, angles, velocities and spins.
fn arrived(course: &Course<'_>, before: &State, bodies: &[usize], states: Vec<[f64; 6]>) -> State {
    let mut after = before.clone();
    for (b, state) in bodies.iter().zip(states) {
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
    after
}

/// Places on the way of a run, its beginning and end among them.
fn sampled(run: &Run, unit: f64, poses: impl Fn(&[f64]) -> Option<Vec<[f64; 3]>>) -> Vec<Sample> {
    let stride = run.samples.len().div_ceil(SAMPLES);
    let last = run.samples.len() - 1;
    let picked = run.samples.iter().enumerate();
    // A cubic through places at nearly the same time would swing out: where something ends, its last step may be short.
    let (end, gap) = (run.samples[last].0, run.samples[last].0 * CLOSE);
    let mut before = f64::NEG_INFINITY;
    let picked = picked.filter(|(k, (time, _))| {
        let stands = k % stride == 0 && *time >= before + gap && *time < end - gap;
        if stands {
            before = *time;
        }
        stands || *k == 0 || *k == last
    });
    let samples = picked.filter_map(|(_, (time, y))| {
        Some(Sample {
            time: time * unit,
            poses: poses(y)?,
        })
    });
    samples.collect()
}

fn unsolved(course: &Course<'_>) -> Lost {
    course.out_of_reach("the equations of motion have no solution")
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
    has_weight: bool,
    time: Component,
) -> Passed {
    let open = course.open(Why::Needed);
    let mut after = before.clone();
    for b in bodies {
        after.bodies[*b].leave_open(&open);
        after.bodies[*b].has_begun = true;
    }
    let moved = Moved {
        bodies: bodies.to_vec(),
        ..Moved::default()
    };
    course.moved([before, after], time, has_weight, moved)
}

/// Bodies that the stage does not name: they wait, rest, fly on, or nobody knows. An applied force or moment is that of what it
/// names; weight would act on all.
pub(super) fn others(
    course: &Course<'_>,
    before: &State,
    after: &mut State,
    moving: &[usize],
    time: &Component,
    has_weight: bool,
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
        if course.stage.apart.contains(&b) {
            body.leave_open(&course.open(Why::Meanwhile));
            continue;
        }
        // What moves at the same time has its own stage.
        if moving.contains(&b) || course.stage.during.is_some() || !body.has_begun {
            continue;
        }
        if course.stage.scene.axles.contains(&b) {
            // Its weight has no moment about its axle.
            body.angle = drifted(course, &body.angle, &body.spin.clone(), time);
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
        if has_weight && !is_prescribed {
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

/// Adds a force of this size along a line, in units of force, at an arm from the center of a body.
pub(super) fn rub(
    mechanism: &mut Mechanism,
    body: usize,
    along: [f64; 2],
    arm: [f64; 2],
    size: f64,
) {
    let force = along.map(|u| size * u);
    let moment = cross(&arm, &force);
    let all = &mut mechanism.forces[body];
    for (total, part) in all.iter_mut().zip([force[0], force[1], moment]) {
        *total += part;
    }
}
