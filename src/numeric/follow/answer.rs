//! The number that a question about motion asks for, from what was followed.
//!
//! In: a scene, what was followed, a question. Out: a number or a vector, or why there is none. Questions about formulas
//! (limits, thresholds, …) are not answered here.

mod turns;

pub use turns::OfTurn;

use std::fmt;

use super::impact::velocity_at;
use super::{
    BodyState, Component, Course, Driven, Followed, Impact, Impulse, Lost, Moved, Open, Passed,
    Solid, State, What, kinetic,
};
use crate::expr::arithmetic::{cross, dot};
use crate::expr::{Point, Symbol, Vector};
use crate::numeric::Answer;
use crate::numeric::given::{Freedom, Undefined, vector};
use crate::scene::{Ask, EnergyWhen, ImpulseAt, Question, Scene, Stage, StageKind};

/// Why a question has no number.
#[derive(Clone, Debug, PartialEq)]
pub enum Unanswered {
    /// The stage did not get to its end.
    Lost(Lost),
    /// A component it needs is open.
    Open(Open),
    /// A point or direction in the question has no value.
    Undefined(Undefined),
    /// It does not ask for a number of the motion.
    NotANumber,
}

impl fmt::Display for Unanswered {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Unanswered::Lost(lost) => write!(f, "{lost}"),
            Unanswered::Open(open) => write!(f, "{open}"),
            Unanswered::Undefined(undefined) => write!(f, "{undefined}"),
            Unanswered::NotANumber => f.write_str("asks for no number of the motion"),
        }
    }
}

impl std::error::Error for Unanswered {}

impl From<Open> for Unanswered {
    fn from(open: Open) -> Unanswered {
        Unanswered::Open(open)
    }
}

/// The number that the name of an answer stands for in a formula: of a question about a stage that was followed, of a
/// component of its vector, or of a formula of such answers.
pub fn named(
    scene: &Scene,
    followed: &Followed,
    name: &Symbol,
    values: &Point<f64>,
) -> Option<f64> {
    let question = scene.answering(name)?;
    if let Ask::Value { formula, with, .. } = &question.ask {
        if !with.is_empty() {
            return None;
        }
        let mut values = values.clone();
        for part in formula.symbols() {
            if !values.values.contains_key(&part)
                && let Some(value) = named(scene, followed, &part, &values)
            {
                values.values.insert(part, value);
            }
        }
        return question.ask.value(&values);
    }
    if question.stage? >= followed.stages.len() {
        return None;
    }
    let found = answer(scene, followed, question, values).ok()?;
    found.component(Some(usize::from(name.ends_with("_y"))))
}

/// The number or vector that a question about a stage asks for, or about the one impact of a scene without stages.
pub fn answer(
    scene: &Scene,
    followed: &Followed,
    question: &Question,
    values: &Point<f64>,
) -> Result<Answer<f64>, Unanswered> {
    if let Ask::Turn { .. } = &question.ask {
        let found = of_a_turn(scene, followed, &question.ask, values)?;
        return Ok(Answer::Scalar(found.value));
    }
    let course = scene.course();
    let alone = (!scene.has_stages()).then_some(0);
    let index = question.stage.or(alone).ok_or(Unanswered::NotANumber)?;
    let stage = course.get(index).ok_or(Unanswered::NotANumber)?;
    let passed = followed.stages[index].as_ref();
    let passed = passed.map_err(|lost| Unanswered::Lost(lost.clone()))?;
    let values = super::with_earlier(scene, followed, stage, &super::with_angles(values));
    let values = super::at_places(stage, &passed.before, &values);
    let course = Course {
        stage,
        solids: &followed.solids,
        values: &values,
    };
    let numbers = InStage {
        scene,
        course,
        stage,
        passed,
    };
    numbers.asked(&question.ask)
}

/// What is asked of a turn among several, by its number.
pub fn of_a_turn(
    scene: &Scene,
    followed: &Followed,
    ask: &Ask,
    values: &Point<f64>,
) -> Result<OfTurn, Unanswered> {
    let Ask::Turn {
        number,
        turns,
        of,
        total,
    } = ask
    else {
        return Err(Unanswered::NotANumber);
    };
    // Nothing that is followed depends on it, so the values may be without it.
    let given = scene.parameter(number);
    let given = given.and_then(|p| p.value.as_ref()?.evaluate(values));
    let number = values.values.get(number).copied().or(given);
    turns::answer(scene, followed, turns, (of, *total), number, values)
}

/// A stage that was followed, and the values with which its questions are read.
struct InStage<'a> {
    scene: &'a Scene,
    course: Course<'a>,
    stage: &'a Stage,
    passed: &'a Passed,
}

impl InStage<'_> {
    fn asked(&self, ask: &Ask) -> Result<Answer<f64>, Unanswered> {
        let course = &self.course;
        match ask {
            Ask::Reaction { along, at_end } => {
                let reaction = self.moved()?.reaction.as_ref();
                let reaction = reaction.ok_or(Unanswered::NotANumber)?;
                component(course, reaction[usize::from(*at_end)].clone(), Some(along))
            }
            Ask::AngularAcceleration {
                body,
                clockwise,
                at_end,
            } => {
                let [.., value] = accelerations(self.moved()?, *body, *at_end)?;
                Ok(Answer::Scalar(if *clockwise { -value } else { value }))
            }
            Ask::PointAcceleration {
                body,
                point,
                along,
                at_end,
            } => {
                let there = self.point_acceleration(*body, point.as_deref(), *at_end)?;
                component(course, there.map(Ok), Some(along))
            }
            Ask::Time => Ok(Answer::Scalar(self.passed.time.clone()?)),
            Ask::Acceleration { body, at_end } => {
                let accelerations = self.driven(*body)?.accelerations;
                Ok(Answer::Scalar(accelerations[usize::from(*at_end)]))
            }
            Ask::Tension { body } => {
                let tension = self.driven(*body)?.tension;
                tension.map(Answer::Scalar).ok_or(Unanswered::NotANumber)
            }
            Ask::Distance => self.distance().map(Answer::Scalar),
            Ask::Angle { body, clockwise } => {
                let by = self.turned(*body)?;
                Ok(Answer::Scalar(if *clockwise { -by } else { by }))
            }
            Ask::Position {
                body,
                along,
                at_end,
            } => {
                let center = self.state(*at_end).bodies[*body].center.clone();
                component(course, center, along.as_ref())
            }
            Ask::AngularMomentum {
                body,
                about,
                center_of,
                at_end,
            } => {
                let bodies = &self.state(*at_end).bodies;
                let about = match center_of {
                    Some(other) => {
                        let [x, y] = bodies[*other].center.clone();
                        [x?, y?]
                    }
                    None => pair(course, about)?,
                };
                let state = &bodies[*body];
                let moment = angular_momentum(&course.solids[*body], state, about);
                Ok(Answer::Scalar(moment?))
            }
            Ask::Velocity {
                body,
                point: Some((name, at)),
                along,
            } if self.is_carried(name, at) => {
                let state = &self.passed.after.bodies[*body];
                let velocity = carried(course, self.scene, state, *body, name)?;
                component(course, velocity, along.as_ref())
            }
            ask => about_end(course, self.passed, ask),
        }
    }

    /// Whether a point of a body is asked for where the body has carried it: in a motion always, in an impact unless something
    /// acts at the place that the file gives.
    fn is_carried(&self, name: &str, at: &Vector) -> bool {
        if matches!(self.passed.what, What::Motion(_)) {
            return true;
        }
        let is_named = self.scene.points.iter().any(|p| p.name == name);
        let Ok(at) = pair(&self.course, at) else {
            return false;
        };
        let is_there = |place: &Vector| {
            pair(&self.course, place).is_ok_and(|[x, y]| {
                let size = 1.0 + at[0].abs() + at[1].abs();
                (x - at[0]).hypot(y - at[1]) <= 1e-9 * size
            })
        };
        is_named && !self.stage.scene.acting().any(|one| is_there(one.at))
    }

    fn moved(&self) -> Result<&Moved, Unanswered> {
        match &self.passed.what {
            What::Motion(moved) => Ok(moved),
            What::Impact(_) => Err(Unanswered::NotANumber),
        }
    }

    fn state(&self, at_end: bool) -> &State {
        match at_end {
            true => &self.passed.after,
            false => &self.passed.before,
        }
    }

    /// Acceleration of a named point of a body \[m/s²\], of its center where none is named.
    fn point_acceleration(
        &self,
        body: usize,
        point: Option<&str>,
        at_end: bool,
    ) -> Result<[f64; 2], Unanswered> {
        let [x, y, angular] = accelerations(self.moved()?, body, at_end)?;
        let state = &self.state(at_end).bodies[body];
        let [p, q] = match point {
            Some(name) => arm(&self.course, self.scene, state, body, name)?,
            None => [0.0; 2],
        };
        // A particle has no point but its center.
        let square = state.spin.clone().map_or(0.0, |w| w * w);
        Ok([x - angular * q - square * p, y + angular * p - square * q])
    }

    /// What is known of a body that is driven along a line, or hangs on a string.
    fn driven(&self, body: usize) -> Result<&Driven, Unanswered> {
        let driven = self.moved()?.driven.iter().find(|d| d.body == body);
        driven.ok_or(Unanswered::NotANumber)
    }

    /// How far a body slid \[m\], on a moving one as seen from there and in the sense of its slip at the beginning.
    fn distance(&self) -> Result<f64, Unanswered> {
        let slide = match &self.stage.kind {
            StageKind::Slide(slide) => slide,
            StageKind::Fall(fall) => {
                let [from, to] = [&self.passed.before, &self.passed.after];
                let [from, to] = [from, to].map(|state| state.bodies[fall.body].center.clone());
                let [[x, y], [u, v]] = [from, to];
                return Ok((u? - x?).hypot(v? - y?));
            }
            _ => return Err(Unanswered::NotANumber),
        };
        let along = pair(&self.course, &slide.along)?;
        let far = gone(self.passed, slide.body, along)?;
        let below = slide.on.as_ref();
        let below = below.map_or(Ok(0.0), |on| gone(self.passed, on.body, along))?;
        Ok(match self.moved()?.slides_back {
            true => below - far,
            false => far - below,
        })
    }

    /// The angle by which a body turned \[rad\], counterclockwise.
    fn turned(&self, body: usize) -> Result<f64, Unanswered> {
        let turning = self.moved().ok().filter(|m| m.bodies.contains(&body));
        if let Some(by) = turning.and_then(|moved| moved.turned) {
            return Ok(by);
        }
        let ends = [&self.passed.before, &self.passed.after];
        let [from, to] = ends.map(|s| s.bodies[body].angle.clone());
        Ok(to? - from?)
    }
}

/// Angular momentum of a body about a place \[kg m²/s\], counterclockwise.
fn angular_momentum(solid: &Solid, body: &BodyState, about: [f64; 2]) -> Component {
    let [x, y, _, u, v, w] = body.components();
    let arm = [x.clone()? - about[0], y.clone()? - about[1]];
    let orbital = solid.mass * cross(&arm, &[u.clone()?, v.clone()?]);
    let own = match solid.freedom {
        Freedom::Rigid => solid.inertia * w.clone()?,
        Freedom::Particle | Freedom::Fixed => 0.0,
    };
    Ok(orbital + own)
}

/// How far a body has come along a direction.
fn gone(passed: &Passed, body: usize, along: [f64; 2]) -> Result<f64, Unanswered> {
    let [from, to] = [&passed.before, &passed.after].map(|s| s.bodies[body].center.clone());
    let mut far = 0.0;
    for ((from, to), way) in from.into_iter().zip(to).zip(along) {
        far += (to? - from?) * way;
    }
    Ok(far)
}

/// Velocity of the point of a body that the file puts at a named point, wherever that is by now.
fn carried(
    course: &Course<'_>,
    scene: &Scene,
    state: &BodyState,
    body: usize,
    name: &str,
) -> Result<[Component; 2], Unanswered> {
    let arm = arm(course, scene, state, body, name)?;
    let [x, y, ..] = state.known()?;
    let at = [x + arm[0], y + arm[1]];
    Ok(velocity_at(course.solids[body].freedom, state, &at))
}

/// From the center of a body to that point of it.
fn arm(
    course: &Course<'_>,
    scene: &Scene,
    state: &BodyState,
    body: usize,
    name: &str,
) -> Result<[f64; 2], Unanswered> {
    let point = scene.points.iter().find(|p| p.name == name);
    let point = pair(course, &point.ok_or(Unanswered::NotANumber)?.at)?;
    let [_, _, angle, ..] = state.known()?;
    let begin = super::finite(&scene.bodies[body].angle, course.values, || name.into())
        .map_err(Unanswered::Undefined)?;
    let (s, c) = (angle - begin).sin_cos();
    let [p, q] = [0, 1].map(|k| point[k] - course.solids[body].center[k]);
    Ok([p * c - q * s, p * s + q * c])
}

/// Accelerations of a body at an end of a motion, the angular one last.
fn accelerations(moved: &Moved, body: usize, at_end: bool) -> Result<[f64; 3], Unanswered> {
    let found = moved.accelerations.iter().find(|(b, _)| *b == body);
    let (_, ends) = found.ok_or(Unanswered::NotANumber)?;
    Ok(ends[usize::from(at_end)])
}

/// A question about the end of a stage, or about the impact of a scene without stages.
pub(super) fn about_end(
    course: &Course<'_>,
    passed: &Passed,
    ask: &Ask,
) -> Result<Answer<f64>, Unanswered> {
    let after = &passed.after.bodies;
    match ask {
        Ask::Velocity { body, point, along } => {
            let velocity = match point {
                None => after[*body].velocity.clone(),
                Some((_, at)) => {
                    let at = pair(course, at)?;
                    velocity_at(course.solids[*body].freedom, &after[*body], &at)
                }
            };
            component(course, velocity, along.as_ref())
        }
        Ask::Spin { body, clockwise } => {
            let spin = after[*body].spin.clone()?;
            Ok(Answer::Scalar(if *clockwise { -spin } else { spin }))
        }
        Ask::Impulse { from, on, along } => {
            let What::Impact(impact) = &passed.what else {
                return Err(Unanswered::NotANumber);
            };
            let found = transmitted(impact, *from).ok_or(Unanswered::NotANumber)?;
            let felt = match found.on == *on {
                true => found.impulse.clone(),
                false => found.impulse.clone().map(|c| c.map(|p| -p)),
            };
            component(course, felt, along.as_ref())
        }
        Ask::Energy { when, of } => {
            let [before, after] = [&passed.before, &passed.after];
            let energy = |state| kinetic(course.solids, state, *of);
            Ok(Answer::Scalar(match when {
                EnergyWhen::Before => energy(before)?,
                EnergyWhen::After => energy(after)?,
                EnergyWhen::Lost => energy(before)? - energy(after)?,
            }))
        }
        _ => Err(Unanswered::NotANumber),
    }
}

fn transmitted(impact: &Impact, from: ImpulseAt) -> Option<&Impulse> {
    match from {
        ImpulseAt::Contact(i) => impact.contacts.get(i),
        ImpulseAt::Hinge(i) => impact.hinges.get(i),
        ImpulseAt::Blow(i) => impact.blows.get(i),
    }
}

fn pair(course: &Course<'_>, v: &Vector) -> Result<[f64; 2], Unanswered> {
    vector(v, course.values, || "point or direction asked for".into())
        .map_err(Unanswered::Undefined)
}

fn component(
    course: &Course<'_>,
    v: [Component; 2],
    along: Option<&Vector>,
) -> Result<Answer<f64>, Unanswered> {
    let Some(along) = along else {
        let [x, y] = v;
        return Ok(Answer::Vector([x?, y?]));
    };
    let along = pair(course, along)?;
    // A component across the direction may stay open.
    let mut known = [0.0; 2];
    for (k, c) in v.into_iter().enumerate() {
        if along[k] != 0.0 {
            known[k] = c?;
        }
    }
    Ok(Answer::Scalar(dot(&known, &along)))
}
