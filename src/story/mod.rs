//! Tells a scene with stages: works out each stage from the end of the one before it, then answers the questions.
//!
//! In: a [`Scene`] with a [`Story`]. Out: [`Told`], the stages with what each conserves and why, and the answers with how
//! each is known; or [`Refused`], the reason why the stages do not fit. Impacts are derived and proved by
//! [`crate::derive`] and [`crate::verify`]; motions follow from work and energy, and are integrated apart from that.

mod answer;
mod calc;
mod graph;
mod impact;
mod integrate;
mod intervals;
mod limit;
mod motion;
mod optimum;
mod roots;
mod sentence;
mod sheet;
mod special;
mod spring;
mod threshold;
mod words;
mod zeros;

use std::collections::BTreeMap;
use std::fmt;

pub use graph::{Curve, Graph, graphs};
pub use sentence::{Piece, Sentence};
pub use sheet::{Unanswered, impact, is_clockwise, sheet, with_special};
pub use special::{about, known, special};

use crate::derive::{Derivation, Stop};
use crate::dimension::Dimension;
use crate::expr::{Expr, Symbol, Vector};
use crate::formula::Relation;
use crate::scene::{Ask, ContactLaw, Scene, Stage, StageKind, Story, StoryAsk, Turn};
use crate::verify::{Check, Proof};

/// Where all bodies are and how they move, by index of body.
#[derive(Clone, Debug)]
pub struct State {
    /// Centers of mass \[m\].
    pub center: Vec<Vector>,
    /// Velocities of the centers of mass \[m/s\].
    pub velocity: Vec<Vector>,
    /// Angular velocities \[rad/s\], counterclockwise.
    pub spin: Vec<Expr>,
}

/// A quantity that a stage keeps, or does not.
#[derive(Clone, Debug)]
pub struct Kept {
    /// The quantity.
    pub what: String,
    /// Whether it is the same at the end.
    pub conserved: bool,
    /// Why, or why not.
    pub why: Sentence,
}

/// One outcome of an impact with one-sided supports.
#[derive(Clone, Debug)]
pub struct Case {
    /// Names of the supports and strings that act.
    pub active: Vec<String>,
    /// What must be ≥ 0 for it, in words and as an expression; empty where it holds on the whole domain.
    pub conditions: Vec<(String, Expr)>,
    /// Symbols that stand for what an earlier stage hands on, in the scene and the derivation, with their values.
    pub handed: BTreeMap<Symbol, Expr>,
    /// Motion just after.
    pub after: State,
    /// The scene of this outcome: the supports that act are contacts without rebound.
    pub scene: Scene,
    /// Its derivation.
    pub derivation: Derivation,
    /// Its proof.
    pub proof: Proof,
}

/// A stage, worked out.
#[derive(Clone, Debug)]
pub struct StageTold {
    /// Name.
    pub name: String,
    /// Kind in one word.
    pub kind: &'static str,
    /// Motion at the beginning.
    pub before: State,
    /// Motion at the end.
    pub after: State,
    /// What is conserved, and what is not.
    pub kept: Vec<Kept>,
    /// Outcomes of an impact, the one told first in front; empty for a motion.
    pub cases: Vec<Case>,
    /// Kinetic energy at the beginning and at the end, of a motion \[J\].
    pub energy: Option<[Expr; 2]>,
    /// The same at the end, put together from velocity and spin.
    pub kinetic: Option<Expr>,
    /// Moment of inertia about the fixed point of a rotation: as m r² is added to it, and tidy \[kg m²\].
    pub inertia: Option<[Expr; 2]>,
    /// Work done on the body during a motion: by what, and how much, as force times distance \[J\].
    pub work: Vec<(&'static str, Expr)>,
    /// What happens, in words.
    pub words: Vec<Sentence>,
    /// What the stage takes for granted.
    pub assumptions: Vec<Sentence>,
    /// What was checked.
    pub checks: Vec<Check>,
}

/// The answer to a question about a story.
#[derive(Clone, Debug)]
pub struct Answer {
    /// Name of the question.
    pub question: String,
    /// Name of the answer.
    pub name: String,
    /// The name typeset.
    pub latex: String,
    /// What it is, in words.
    pub words: String,
    /// The value, where the answer is one.
    pub formula: Option<Expr>,
    /// For which values of a parameter something holds: parameter, relation, value.
    pub range: Vec<(Symbol, Relation, Expr)>,
    /// An equation that was proved.
    pub equation: Option<(Expr, Expr)>,
    /// What is asked, put into parameters: an equation or inequality to be solved, or the formula that is to be largest.
    pub stated: Option<(Expr, Relation, Expr)>,
    /// Identities that show the answer: both sides are the same in the parameters, with the reason.
    pub put_in: Vec<(Expr, Expr, &'static str)>,
    /// The answer in sentences.
    pub text: Vec<Sentence>,
    /// Dimension of the value.
    pub dimension: Dimension,
    /// What it rests on beyond the domains.
    pub assumptions: Vec<Sentence>,
    /// Solutions that were discarded, with the reason.
    pub discarded: Vec<Sentence>,
    /// What stands for a formula close to a value of a parameter.
    pub near: Vec<Near>,
    /// What was checked.
    pub checks: Vec<Check>,
}

/// The closer the parameter comes to the value, the less the sides differ, even divided by the distance to a power.
#[derive(Clone, PartialEq, Debug)]
pub struct Near {
    /// Left side.
    pub left: Expr,
    /// Right side.
    pub right: Expr,
    /// The parameter.
    pub parameter: Symbol,
    /// The value it comes to; `None` beyond all bounds.
    pub to: Option<Expr>,
    /// The power.
    pub order: u32,
}

impl Answer {
    /// Whether no check failed.
    pub fn holds(&self) -> bool {
        self.checks.iter().all(|c| c.holds != Some(false))
    }
}

/// A story, told.
#[derive(Clone, Debug)]
pub struct Told {
    /// The stages.
    pub stages: Vec<StageTold>,
    /// The answers.
    pub answers: Vec<Answer>,
    /// How the statement is read.
    pub readings: Vec<String>,
    /// Data that no answer needs.
    pub unused: Vec<String>,
}

impl Told {
    /// Everything that is taken for granted: how the statement is read, and what the stages suppose.
    pub fn assumed(&self, story: &Story) -> Vec<Sentence> {
        words::assumed(story, &self.stages)
    }

    /// Whether no check failed.
    pub fn holds(&self) -> bool {
        let stages = self.stages.iter();
        let proofs = stages
            .clone()
            .flat_map(|s| &s.cases)
            .all(|c| c.proof.holds());
        let checks = stages
            .flat_map(|s| &s.checks)
            .chain(self.answers.iter().flat_map(|a| &a.checks));
        proofs && checks.clone().all(|c| c.holds != Some(false))
    }
}

/// Why a story cannot be told.
#[derive(Clone, Debug, PartialEq)]
pub struct Refused {
    /// The stage or question.
    pub at: String,
    /// The reason.
    pub reason: String,
    /// What to do.
    pub hint: String,
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.at, self.reason)?;
        if self.hint.is_empty() {
            Ok(())
        } else {
            write!(f, "\nhint: {}", self.hint)
        }
    }
}

impl std::error::Error for Refused {}

impl Refused {
    fn new(at: &str, reason: impl Into<String>, hint: impl Into<String>) -> Refused {
        Refused {
            at: format!("stage `{at}`"),
            reason: reason.into(),
            hint: hint.into(),
        }
    }

    fn stop(at: &str, stop: impl Into<Stop>) -> Refused {
        Refused::new(at, stop.into().to_string(), "")
    }
}

/// Tells the story of a scene.
pub fn tell(scene: &Scene, story: &Story) -> Result<Told, Refused> {
    let mut stages: Vec<StageTold> = Vec::new();
    for stage in &story.stages {
        let before = match stage.from {
            Some(j) => {
                let mut state = stages[j].after.clone();
                // Where the bodies are is geometry, and the reader has put it in.
                state.center = stage
                    .scene
                    .bodies
                    .iter()
                    .map(|b| b.center.clone())
                    .collect();
                state
            }
            None => start(&stage.scene, &stage.start),
        };
        let told = match &stage.kind {
            StageKind::Impact {
                one_sided,
                supposed,
            } => {
                let named = named(story, &stages);
                impact::tell(stage, before, one_sided, supposed.as_deref(), &named)?
            }
            StageKind::Turn(turn) => {
                left_behind(story, stage, turn)?;
                motion::turn(stage, before, turn)?
            }
            StageKind::Slide(slide) => motion::slide(stage, before, slide)?,
            StageKind::Fall(fall) => motion::fall(stage, before, fall)?,
            StageKind::Wind(wind) => motion::wind(stage, before, wind)?,
        };
        stages.push(told);
    }
    answer::all(scene, story, stages)
}

/// What stuck to a body in the last impact turns along with it.
fn left_behind(story: &Story, stage: &Stage, turn: &Turn) -> Result<(), Refused> {
    let turning = turn.bodies();
    let mut from = stage.from;
    while let Some(before) = from.map(|j| &story.stages[j]) {
        if let StageKind::Impact { .. } = before.kind {
            let stuck = before.scene.contacts.iter().find_map(|c| {
                let [a, b] = c.bodies;
                let is_other =
                    |b: usize| !turning.contains(&b) && !stage.scene.bodies[b].is_fixed();
                let sticks = matches!(c.law, ContactLaw::Sticking);
                match (turning.contains(&a), turning.contains(&b)) {
                    (true, false) if sticks && is_other(b) => Some(b),
                    (false, true) if sticks && is_other(a) => Some(a),
                    _ => None,
                }
            });
            let Some(stuck) = stuck else { return Ok(()) };
            let [stuck, body] = [stuck, turn.body].map(|b| &stage.scene.bodies[b].name);
            return Err(Refused::new(
                &stage.name,
                format!(
                    "`{stuck}` sticks to `{body}` since `{}`, and is not said to turn along",
                    before.name
                ),
                format!("add \"with\": [\"{stuck}\"] to the turn"),
            ));
        }
        from = before.from;
    }
    Ok(())
}

/// Speeds and spins at the end of motions that have the name of a question, for the impacts after them to go on with.
fn named(story: &Story, stages: &[StageTold]) -> Vec<(Symbol, Expr)> {
    let mut out = Vec::new();
    for question in &story.questions {
        let StoryAsk::Quantity { stage, question: q } = &question.ask else {
            continue;
        };
        let Some(told) = stages.get(*stage).filter(|s| s.cases.is_empty()) else {
            continue;
        };
        let value = match &story.stages[*stage].scene.questions[*q].ask {
            Ask::Spin { body, clockwise } => {
                let w = &told.after.spin[*body];
                if *clockwise { -w } else { w.clone() }
            }
            Ask::Velocity {
                body,
                point: None,
                along: Some(along),
            } => crate::expr::dot(&told.after.velocity[*body], along),
            _ => continue,
        };
        out.push((Symbol::from(question.name.as_str()), value));
    }
    out
}

/// The motion as the file gives it.
fn start(scene: &Scene, changes: &[(usize, Option<Vector>, Option<Expr>)]) -> State {
    let mut state = State {
        center: scene.bodies.iter().map(|b| b.center.clone()).collect(),
        velocity: scene.bodies.iter().map(|b| b.velocity.clone()).collect(),
        spin: scene.bodies.iter().map(|b| b.spin.clone()).collect(),
    };
    for (body, velocity, spin) in changes {
        if let Some(v) = velocity {
            state.velocity[*body] = v.clone();
        }
        if let Some(w) = spin {
            state.spin[*body] = w.clone();
        }
    }
    state
}
