//! The second way through a whole scene, stage by stage, in doubles.
//!
//! In: a [`Scene`] and values of its parameters. Out: [`Followed`], for every stage what it begins and ends with.
//!
//! ```text
//! let followed = numeric::follow(&scene, &values)?;      // Err: a quantity that has no value at the point
//! for stage in &followed.stages {                        // in the order of the file
//!     let passed: &Passed = match stage { Ok(p) => p, Err(lost) => … };
//!     passed.after.bodies[b].velocity[0]                 // a Component: Ok(value), or Err(why it is open)
//! }
//! follow::answer(&scene, &followed, &ask, &values)       // the number that a question about motion asks for
//! follow::random_point(&scene, seed)                     // values inside the domains, for holding formulas against it
//! ```
//!
//! Nothing here comes from `laws`, `derive` or `algebra`, and of `scene` only what the file says of places, joints and
//! motions: mass, center and moment of inertia are integrated over the outlines (`outline`), impacts are one linear system of
//! all bodies and impulses (`impact`), one-sided supports are found by complementarity, motions are integrated in time
//! from the equations of motion with their constraints (`mechanism`, `motion`, `wind`; `passage` tells whether bodies pass through each other meanwhile). No step uses energy, so that
//! energies can be held against it.
//!
//! A component that the laws leave open stays open, and so does what needs it. A scene without stages is one impact.
//!
//! How the words of a file are taken, where they leave a choice:
//! - a body that takes part in nothing yet waits where the file puts it; afterwards it flies on uniformly while others move,
//!   unless the stage names gravity or a force, for then nobody says what acts on it;
//! - at rest a body begins to turn where its weight pulls it, or where the file says; balanced, it needs a small push, and the
//!   time until it gets away is open;
//! - a rotation until `above` or `below` that begins there goes all the way round; a fall through a height ends on the way
//!   down;
//! - after winding on a thin pole the axes are turned so that the rope lies along x, as the file's places have it.

mod answer;
mod grips;
mod impact;
mod lost;
mod mechanism;
mod motion;
mod outline;
mod passage;
mod state;
mod tips;
mod wind;

#[cfg(test)]
mod tests;

use std::collections::BTreeSet;
use std::iter::successors;

use super::given::{Freedom, Reason, Undefined, value};
use super::points::{self, Needed, needed, with_angles};
use crate::expr::{Expr, Point, Symbol, Vector};
use crate::scene::{Scene, Stage, StageKind};

pub use answer::OfTurn;
pub use answer::{Unanswered, answer, named, of_a_turn};
pub use impact::{Breach, Impact, Impulse, Opening};
pub use lost::{Loss, Lost};
pub use mechanism::integrated;
pub use motion::{Driven, Moved, Sample};
pub use outline::Solid;
pub use state::{BodyState, Component, Open, State, Why, kinetic};
pub use tips::tips;

/// A stage that was followed to its end.
#[derive(Clone, Debug)]
pub struct Passed {
    /// How long it takes \[s\]; 0 for an impact.
    pub time: Component,
    /// At its beginning.
    pub before: State,
    /// At its end.
    pub after: State,
    /// Kinetic energy of all bodies that are not fixed, at the beginning and at the end \[J\].
    pub energy: [Component; 2],
    /// Pairs of bodies that pass through each other on the way, by index.
    pub passing: Vec<[usize; 2]>,
    /// What happened.
    pub what: What,
}

impl Passed {
    /// Whether bodies touch, push and keep out of each other.
    pub fn is_possible(&self) -> bool {
        let breaches = match &self.what {
            What::Impact(impact) => impact.breaches.as_slice(),
            What::Motion(_) => &[],
        };
        self.passing.is_empty() && breaches.is_empty()
    }
}

/// What happened in a stage.
#[derive(Clone, Debug)]
pub enum What {
    /// Velocities jumped.
    Impact(Impact),
    /// Bodies moved.
    Motion(Moved),
}

/// A scene, followed from its beginning to the end of every stage.
#[derive(Clone, Debug)]
pub struct Followed {
    /// The bodies in numbers, in the scene's order.
    pub solids: Vec<Solid>,
    /// The stages in the order of the file, or the one impact of a scene without stages.
    pub stages: Vec<Result<Passed, Lost>>,
}

/// How heavy, large and fast the bodies of a scene are; 0 where nothing is.
#[derive(Clone, Copy, Debug)]
pub struct Sizes {
    /// The largest mass \[kg\].
    pub mass: f64,
    /// The largest coordinate of a center, or radius of gyration \[m\].
    pub length: f64,
    /// The largest speed of a center, or by a spin at that length [m/s].
    pub speed: f64,
}

impl Followed {
    /// How a stage before another ended.
    fn end(&self, course: &[Stage], stage: &Stage, before: usize) -> Result<&State, Lost> {
        let passed = self.stages[before].as_ref();
        passed.map(|passed| &passed.after).map_err(|_| Lost {
            stage: stage.name.clone(),
            why: Loss::After(course[before].name.clone()),
        })
    }

    /// Sizes in all stages: a speed that comes out as the root of a difference is known to a part of the largest ones only.
    pub fn sizes(&self) -> Sizes {
        let solids = || self.solids.iter().filter(|s| s.mass > 0.0);
        let passed = self.stages.iter().filter_map(|s| s.as_ref().ok());
        let states = passed.flat_map(|p| [&p.before, &p.after]);
        let bodies: Vec<&BodyState> = states.flat_map(|s| &s.bodies).collect();
        let largest =
            |all: &mut dyn Iterator<Item = f64>| all.fold(0.0, |a: f64, v| a.max(v.abs()));
        let known = |c: &Component| c.clone().unwrap_or(0.0);
        let radii = solids().map(|s| (s.inertia / s.mass).sqrt());
        let centers = bodies.iter().flat_map(|b| b.center.iter().map(known));
        let length = largest(&mut radii.chain(centers));
        let speeds = bodies.iter().flat_map(|b| b.velocity.iter().map(known));
        let spins = bodies.iter().map(|b| known(&b.spin) * length);
        Sizes {
            mass: largest(&mut solids().map(|s| s.mass)),
            length,
            speed: largest(&mut speeds.chain(spins)),
        }
    }
}

/// The bodies of a scene in numbers, mass and inertia from their outlines.
pub fn solids(scene: &Scene, values: &Point<f64>) -> Result<Vec<Solid>, Undefined> {
    let values = with_angles(values);
    let all = scene.bodies.iter();
    all.map(|b| outline::solid(b, &values)).collect()
}

/// Follows a scene at a point that has a value for every parameter; an angle may have its direction only.
pub fn follow(scene: &Scene, values: &Point<f64>) -> Result<Followed, Undefined> {
    let solids = solids(scene, values)?;
    let values = with_angles(values);
    let start = start(scene, &solids, &values)?;
    Ok(through(scene, solids, &start, &values))
}

/// Follows the stages of a scene from a beginning.
fn through(scene: &Scene, solids: Vec<Solid>, start: &State, values: &Point<f64>) -> Followed {
    let course = scene.course();
    let mut followed = Followed {
        solids,
        stages: Vec::new(),
    };
    for stage in course.iter() {
        let values = with_earlier(scene, &followed, stage, values);
        let before = match stage.from {
            None => changed(stage, start, &values).map(|before| match &stage.kind {
                StageKind::Fall(fall) => State {
                    joined: fall.stuck.clone(),
                    ..before
                },
                _ => before,
            }),
            Some(j) => followed.end(&course, stage, j).cloned(),
        };
        let during = stage.during.as_ref();
        let first = during.and_then(|d| Some((d, followed.stages.get(d.stage)?)));
        let before = before.map(|before| match first {
            Some((_, Ok(first))) => before.taken_back(&stage.kind.moved(), &first.before),
            _ => before,
        });
        let mut values = values;
        if let Some((during, Ok(Passed { time: Ok(time), .. }))) = first {
            values.values.insert(during.time.clone(), *time);
        }
        let solids = &followed.solids;
        let mut passed = before.and_then(|before| one(stage, solids, before, &values));
        if let Ok(passed) = &mut passed {
            let at_once = at_once(&course, &followed, stage);
            passed.passing = passage::passing(scene, solids, &values, (stage, passed), &at_once);
            let back = passage::back_through(&course, &followed, (stage, passed), &values);
            passed.passing.extend(back);
            let pulls = grips::pulls(scene, (&course, &followed), (stage, passed), &values);
            let gone = passage::off_the_wall(&course, &followed, (stage, passed), &values);
            match &mut passed.what {
                What::Motion(moved) => moved.pulls = pulls,
                What::Impact(impact) => impact.breaches.extend(gone.into_iter().map(Breach::Gone)),
            }
            for (i, pair) in passage::beside(scene, (&course, &followed), passed, &values) {
                passed.passing.push(pair);
                if let Ok(other) = &mut followed.stages[i] {
                    other.passing.push(pair);
                }
            }
        }
        followed.stages.push(passed);
    }
    followed
}

/// The motions that happen at the same time as a stage, as far as they are followed.
fn at_once<'a>(course: &[Stage], followed: &'a Followed, stage: &Stage) -> Vec<&'a Moved> {
    let Some(during) = &stage.during else {
        return Vec::new();
    };
    let back = successors(stage.from, |j| {
        (*j != during.stage).then_some(course[*j].from?)
    });
    let passed = back.filter_map(|j| followed.stages[j].as_ref().ok());
    let moved = passed.filter_map(|passed| match &passed.what {
        What::Motion(moved) => Some(moved),
        What::Impact(_) => None,
    });
    moved.collect()
}

/// Values of the parameters, and of the answers to earlier stages that a stage uses.
fn with_earlier(
    scene: &Scene,
    followed: &Followed,
    stage: &Stage,
    values: &Point<f64>,
) -> Point<f64> {
    let mut out = values.clone();
    for name in &stage.earlier {
        if let Some(value) = answer::named(scene, followed, name, values) {
            out.values.insert(name.clone(), value);
        }
    }
    out
}

/// Values of the parameters, and of the places of a stage that begins like this.
pub fn at_places(stage: &Stage, before: &State, values: &Point<f64>) -> Point<f64> {
    let mut out = values.clone();
    for (names, body) in stage.places.iter().zip(&before.bodies) {
        let [x, y] = &body.center;
        for (name, value) in names.iter().zip([x, y, &body.angle]) {
            if let Ok(value) = value {
                out.values.insert(name.clone(), *value);
            }
        }
    }
    out
}

/// The symbols that have to have values so that a scene can be followed.
pub fn symbols(scene: &Scene) -> BTreeSet<Symbol> {
    let mut out = BTreeSet::new();
    let mut add = |e: &Expr| out.extend(e.symbols().into_iter().filter(|s| &**s != "pi"));
    let mut of_scene = |scene: &Scene| {
        let needed = needed(scene);
        let angles = scene.bodies.iter().filter(|b| !b.is_particle());
        angles.for_each(|b| add(&b.angle));
        let names = needed.plain.into_iter().chain(needed.angles.into_keys());
        names.for_each(|n| add(&Expr::symbol(&n)));
    };
    let bodies = Scene {
        bodies: scene.bodies.clone(),
        ..Scene::default()
    };
    of_scene(&bodies);
    let course = scene.course();
    for stage in course.iter() {
        let without = Scene {
            bodies: Vec::new(),
            ..stage.scene.clone()
        };
        of_scene(&without);
    }
    for stage in course.iter() {
        for (_, velocity, spin) in &stage.start {
            velocity.iter().flatten().for_each(&mut add);
            spin.iter().for_each(&mut add);
        }
        stage.kind.clone().formulas_mut(&mut |e| add(e));
    }
    for stage in course.iter() {
        let during = stage.during.iter().map(|d| &d.time);
        let found = stage.places.iter().flatten().chain(&stage.earlier);
        let found = found.chain(during);
        found.for_each(|symbol| _ = out.remove(symbol));
    }
    out
}

/// A point inside the domains at which a scene can be followed; the same seed gives the same point on every machine.
pub fn random_point(scene: &Scene, seed: u64) -> Point<f64> {
    let mut needed = Needed::default();
    for name in symbols(scene) {
        needed.add(&Expr::symbol(&name));
    }
    with_angles(&points::rounded(&points::random_point(
        &needed,
        &scene.domains,
        seed,
    )))
}

/// The point that the values of the scene's own parameters make, or the names of what has no value though it has to.
pub fn values(scene: &Scene) -> Result<Point<f64>, Vec<Symbol>> {
    let point = scene.given();
    let missing = symbols(scene).into_iter();
    let missing: Vec<Symbol> = missing
        .filter(|name| !point.values.contains_key(name))
        .collect();
    match missing.is_empty() {
        true => Ok(point),
        false => Err(missing),
    }
}

/// What the followers of single stages look at.
pub(super) struct Course<'a> {
    /// The stage.
    pub stage: &'a Stage,
    /// The bodies in numbers.
    pub solids: &'a [Solid],
    /// Values of the parameters, and of the places at the beginning of the stage.
    pub values: &'a Point<f64>,
}

impl Course<'_> {
    fn open(&self, why: Why) -> Open {
        Open {
            stage: self.stage.name.clone(),
            why,
        }
    }

    fn lost(&self, why: Loss) -> Lost {
        Lost {
            stage: self.stage.name.clone(),
            why,
        }
    }

    fn contradiction(&self, reason: impl Into<String>) -> Lost {
        self.lost(Loss::Contradiction(reason.into()))
    }

    fn never(&self, reason: impl Into<String>) -> Lost {
        self.lost(Loss::NeverEnds(reason.into()))
    }

    fn out_of_reach(&self, reason: impl Into<String>) -> Lost {
        self.lost(Loss::OutOfReach(reason.into()))
    }

    fn undefined(&self, quantity: Undefined) -> Lost {
        self.lost(Loss::Undefined(quantity))
    }

    fn number(&self, e: &Expr, what: &str) -> Result<f64, Lost> {
        finite(e, self.values, || what.into()).map_err(|u| self.undefined(u))
    }

    /// A number that may be left out, and is zero then.
    fn optional(&self, e: Option<&Expr>, what: &str) -> Result<f64, Lost> {
        e.map_or(Ok(0.0), |e| self.number(e, what))
    }

    fn pair(&self, v: &[Expr; 2], what: &str) -> Result<[f64; 2], Lost> {
        Ok([self.number(&v[0], what)?, self.number(&v[1], what)?])
    }

    /// A motion that got to its end; what it does not name waits, rests or flies on, unless forces act that nobody tells of it.
    fn moved(
        &self,
        [before, mut after]: [State; 2],
        time: Component,
        has_weight: bool,
        moved: Moved,
    ) -> Passed {
        motion::others(self, &before, &mut after, &moved.bodies, &time, has_weight);
        self.passed(time, before, after, What::Motion(moved))
    }

    fn passed(&self, time: Component, before: State, after: State, what: What) -> Passed {
        Passed {
            time,
            energy: [&before, &after].map(|state| kinetic(self.solids, state, None)),
            before,
            after,
            passing: Vec::new(),
            what,
        }
    }
}

/// A value, where it is a number that can be reckoned with.
fn finite(e: &Expr, at: &Point<f64>, quantity: impl Fn() -> String) -> Result<f64, Undefined> {
    let found = value(e, at, &quantity)?;
    found.is_finite().then_some(found).ok_or_else(|| Undefined {
        quantity: quantity(),
        reason: Reason::NotANumber,
    })
}

/// The same with two components.
fn finite_pair(
    v: &Vector,
    at: &Point<f64>,
    quantity: impl Fn() -> String + Copy,
) -> Result<[f64; 2], Undefined> {
    Ok([finite(&v[0], at, quantity)?, finite(&v[1], at, quantity)?])
}

/// The bodies as the file gives them.
fn start(scene: &Scene, solids: &[Solid], at: &Point<f64>) -> Result<State, Undefined> {
    let mut bodies = Vec::with_capacity(solids.len());
    for (body, solid) in scene.bodies.iter().zip(solids) {
        let number = |e: &Expr, what: &str| finite(e, at, || format!("{what} of {}", body.name));
        let is_particle = solid.freedom == Freedom::Particle;
        let turning = |e: &Expr, what: &str| match is_particle {
            true => Ok(0.0),
            false => number(e, what),
        };
        let velocity = finite_pair(&body.velocity, at, || format!("velocity of {}", body.name))?;
        bodies.push(BodyState {
            center: solid.center.map(Ok),
            angle: Ok(turning(&body.angle, "angle")?),
            velocity: velocity.map(Ok),
            spin: Ok(turning(&body.spin, "spin")?),
            has_begun: false,
        });
    }
    Ok(State {
        bodies,
        joined: Vec::new(),
        fastest: 0.0,
    })
}

/// The beginning, with what a stage has otherwise.
fn changed(stage: &Stage, start: &State, at: &Point<f64>) -> Result<State, Lost> {
    let mut state = start.clone();
    let lost = |quantity| Lost {
        stage: stage.name.clone(),
        why: Loss::Undefined(quantity),
    };
    for (body, velocity, spin) in &stage.start {
        let name = &stage.scene.bodies[*body].name;
        let body = &mut state.bodies[*body];
        if let Some(v) = velocity {
            let v = finite_pair(v, at, || format!("velocity of {name}")).map_err(lost)?;
            body.velocity = v.map(Ok);
        }
        if let Some(w) = spin {
            body.spin = Ok(finite(w, at, || format!("spin of {name}")).map_err(lost)?);
        }
    }
    Ok(state)
}

/// One stage.
fn one(
    stage: &Stage,
    solids: &[Solid],
    before: State,
    values: &Point<f64>,
) -> Result<Passed, Lost> {
    let values = at_places(stage, &before, values);
    let course = Course {
        stage,
        solids,
        values: &values,
    };
    match &stage.kind {
        StageKind::Impact {
            one_sided,
            supposed,
        } => {
            let (what, after) = impact::impact(&course, one_sided, supposed.as_deref(), &before)?;
            Ok(course.passed(Ok(0.0), before, after, What::Impact(what)))
        }
        StageKind::Turn(turn) => motion::turn(&course, before, turn),
        StageKind::Slide(slide) => motion::slide(&course, before, slide),
        StageKind::Fall(fall) => motion::fall(&course, before, fall),
        StageKind::Wind(wind) => wind::wind(&course, before, wind),
        StageKind::Linkage(linkage) => motion::linkage(&course, before, linkage),
    }
}
