//! What is told of a scene: its stages with the motion each begins and ends with, the outcomes of its impacts, and the answers.

use std::collections::BTreeMap;
use std::iter::successors;

use super::grips::Grip;
use super::{granted, second};
use crate::answer::{Answer, Check, Refused};
use crate::derive::Derivation;
use crate::expr::{Expr, Symbol, Vector, minus};
use crate::formula::Sentence;
use crate::scene::{Ask, Scene, Stage, direction};
use crate::verify::Proof;
use crate::verify::possible::{Condition, Possible};

/// How a body has been taking part.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Part {
    /// Not at all so far: it waits as the scene has it.
    Waits,
    /// Nothing holds it.
    Free,
    /// Since the last impact it is hinged to something, sticks to it or is held by it.
    Joined,
}

/// Where all bodies are and how they move, by index of body. A component that is not determined is a symbol of
/// its field `open`; a formula in which one occurs has no value.
#[derive(Clone, Debug, Default)]
pub struct State {
    /// Symbols of components that are not determined, with the reason.
    pub open: BTreeMap<Symbol, String>,
    /// How each body has been taking part.
    pub part: Vec<Part>,
    /// Orientations \[rad\], counterclockwise.
    pub angle: Vec<Expr>,
    /// Centers of mass \[m\].
    pub center: Vec<Vector>,
    /// Velocities of the centers of mass \[m/s\].
    pub velocity: Vec<Vector>,
    /// Angular velocities \[rad/s\], counterclockwise.
    pub spin: Vec<Expr>,
}

impl State {
    /// Why a formula of some expressions has no value; `None` where it has one.
    pub fn why_open<'e>(&self, all: impl IntoIterator<Item = &'e Expr>) -> Option<String> {
        if self.open.is_empty() {
            return None;
        }
        let symbols = all.into_iter().flat_map(Expr::symbols);
        symbols.filter_map(|s| self.open.get(&s).cloned()).next()
    }

    /// A symbol for a component that is not determined, such as u_B_x.
    pub(super) fn open(
        &mut self,
        scene: &Scene,
        [letter, axis]: [&str; 2],
        b: usize,
        why: &str,
    ) -> Expr {
        let mut name = format!("{letter}_{}{axis}", scene.bodies[b].name);
        let is_taken = |name: &str| {
            self.open.contains_key(name)
                || scene.parameter(name).is_some()
                || scene.question(name).is_some()
        };
        while is_taken(&name) {
            name.push('\'');
        }
        let name = Symbol::from(name.as_str());
        self.open.insert(name.clone(), why.to_string());
        Expr::symbol(&name)
    }

    /// Where a body is becomes open; with `motion` also how it moves.
    pub(super) fn lose(&mut self, scene: &Scene, b: usize, why: &str, motion: bool) {
        self.center[b] = ["x", "y"].map(|letter| self.open(scene, [letter, ""], b, why));
        self.lose_angle(scene, b, why);
        if motion {
            self.velocity[b] = ["_x", "_y"].map(|axis| self.open(scene, ["u", axis], b, why));
            if !scene.bodies[b].is_particle() {
                self.spin[b] = self.open(scene, ["w", ""], b, why);
            }
        }
    }

    /// Bodies are where, and as fast as, another state has them.
    pub(super) fn take_back(&mut self, bodies: &[usize], to: &State) {
        for &b in bodies {
            self.part[b].clone_from(&to.part[b]);
            self.angle[b].clone_from(&to.angle[b]);
            self.center[b].clone_from(&to.center[b]);
            self.velocity[b].clone_from(&to.velocity[b]);
            self.spin[b].clone_from(&to.spin[b]);
        }
        self.open.extend(to.open.clone());
    }

    /// The angle of a body becomes open.
    pub(super) fn lose_angle(&mut self, scene: &Scene, b: usize, why: &str) {
        if !scene.bodies[b].is_particle() {
            self.angle[b] = self.open(scene, ["theta", ""], b, why);
        }
    }

    /// From the center of mass of a body to the point of it that the file puts at a named point, wherever that is by now.
    pub fn carried(&self, scene: &Scene, body: usize, point: &str) -> Vector {
        let b = &scene.bodies[body];
        let point = scene.points.iter().find(|p| p.name == point);
        let arm = point.map(|p| minus(&p.at, &b.center));
        let Some([p, q]) = arm.filter(|_| !b.is_particle()) else {
            return [Expr::zero(), Expr::zero()];
        };
        let [c, s] = direction(&(&self.angle[body] - &b.angle));
        [&(&p * &c) - &(&q * &s), &(&p * &s) + &(&q * &c)]
    }

    /// What stands for the places of a stage that begins like this.
    pub(super) fn places(&self, stage: &Stage) -> BTreeMap<Symbol, Expr> {
        let all = stage.places.iter().enumerate().flat_map(|(b, names)| {
            let [x, y] = &self.center[b];
            names.iter().zip([x, y, &self.angle[b]])
        });
        all.map(|(name, value)| (name.clone(), value.clone()))
            .collect()
    }
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
    /// Names of those that do not act and yet do not part: nothing pulls at them or presses on them.
    pub idle: Vec<String>,
    /// Whether more act than the motion needs, so that the impulse of one of them is not determined.
    pub redundant: bool,
    /// What a contact with friction does, such as "`C` slides"; empty where there is none.
    pub rubs: String,
    /// What must be ≥ 0 for it, in words and as an expression; empty where it holds on the whole domain.
    pub conditions: Vec<(String, Expr)>,
    /// What must hold so that its contacts lie on their bodies; the same whatever comes of the impact.
    pub places: Vec<Condition>,
    /// What its friction needs to be ≥ 0, in the symbols of its scene.
    pub when: Vec<Expr>,
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
    /// Whether it can happen: bodies touch, push and do not enter each other.
    pub possible: Possible,
}

impl Case {
    /// What it rests on beyond the domains, in what the scene gives: what was divided by, and what was seen and not proved.
    pub fn assumptions(&self) -> impl Iterator<Item = Sentence> {
        let own = self.derivation.assumptions.iter();
        let own = own.map(|words| words.put_in(&self.handed));
        own.chain(self.proof.assumptions.iter().cloned())
    }

    /// The laws that its motion was put into.
    pub fn identities(&self) -> impl Iterator<Item = &Check> {
        self.proof.scene.iter().filter(|c| c.kind == "identity")
    }
}

/// A quantity that is worked out on the way.
#[derive(Clone, Debug)]
pub struct Step {
    /// Its letter; `alpha` for α.
    pub letter: &'static str,
    /// What it is made of; of an acceleration with an inertia, the force or moment.
    pub raw: Expr,
    /// The same, tidy.
    pub value: Expr,
    /// What it is.
    pub why: &'static str,
    /// What it is made of by powers of the time that a step before it found; empty where it does not go by that.
    pub by_time: Vec<Expr>,
    /// For an acceleration, the inertia it is multiplied by in its equation of motion \[kg or kg m²\].
    pub inertia: Option<Expr>,
    /// For the pull of a string, the equation of motion it comes from.
    pub balance: Option<Balance>,
}

/// An equation of motion of what a string moves: inertia × acceleration = force + pulls.
#[derive(Clone, Debug)]
pub struct Balance {
    /// What the acceleration is multiplied by \[kg\].
    pub inertia: Expr,
    /// All forces but those of the string \[N\].
    pub force: Expr,
    /// How often each pull of the string counts, by the letter of its step.
    pub pulls: Vec<(&'static str, Expr)>,
}

impl Step {
    /// An acceleration, by the force or moment and the inertia of what it moves.
    pub(super) fn by_newton(
        letter: &'static str,
        [force, inertia]: [&Expr; 2],
        value: &Expr,
        why: &'static str,
    ) -> Step {
        Step {
            inertia: Some(inertia.clone()),
            ..Step::new(letter, force, value, why)
        }
    }

    pub(super) fn new(letter: &'static str, raw: &Expr, value: &Expr, why: &'static str) -> Step {
        Step {
            letter,
            raw: raw.clone(),
            value: value.clone(),
            why,
            by_time: Vec::new(),
            inertia: None,
            balance: None,
        }
    }
}

/// How the forces drive a body on a spring.
#[derive(Clone, Debug)]
pub struct OnSpring {
    /// Mass of what moves, with what turning adds to it \[kg\].
    pub inertia: Expr,
    /// Acceleration along the line at the beginning and at the end [m/s²].
    pub rates: [Expr; 2],
}

/// Bodies in flight that are stuck together and turn as one about their common center of mass.
#[derive(Clone, Debug)]
pub struct Cluster {
    /// Indices of the bodies; the only one that is no particle in front.
    pub bodies: Vec<usize>,
    /// The common center of mass at the beginning \[m\].
    pub center: Vector,
    /// Its velocity at the beginning [m/s].
    pub velocity: Vector,
    /// The common spin [rad/s].
    pub spin: Expr,
}

/// A stage, worked out; the only stage of a scene that is one impact has no name.
#[derive(Clone, Debug, Default)]
pub struct StageTold {
    /// Name; where an earlier impact has several outcomes, with the one it goes on from.
    pub name: String,
    /// The stage, with the places of the bodies put in.
    pub placed: Stage,
    /// Answers to earlier stages that its formulas hold, and what they stand for.
    pub earlier: BTreeMap<Symbol, Expr>,
    /// What it goes on from: index of the stage told before it, and of the outcome there.
    pub branch: Option<(usize, usize)>,
    /// What must be ≥ 0 for the outcomes it goes on from, in words and as expressions.
    pub given: Vec<(String, Expr)>,
    /// What must be ≥ 0 for a motion to go as told, beyond the domains.
    pub needs: Vec<Expr>,
    /// The same of what is told in words alone: that of two inequalities one holds.
    pub besides: Vec<Expr>,
    /// How long it lasts \[s\]; `None` for an impact, and where that has no closed form.
    pub time: Option<Expr>,
    /// Motion at the beginning.
    pub before: State,
    /// Motion at the end.
    pub after: State,
    /// What is conserved, and what is not.
    pub kept: Vec<Kept>,
    /// Outcomes of an impact, the one told first in front; empty for a motion.
    pub cases: Vec<Case>,
    /// Distance along the line of a motion along one \[m\].
    pub way: Option<Expr>,
    /// Angle through which a rotation leads, counterclockwise \[rad\]; `None` where it is not decided.
    pub turned: Option<Expr>,
    /// Acceleration along the line of a motion along one \[m/s²\], or of the coordinate of a linkage, where it stays the same.
    pub acceleration: Option<Expr>,
    /// The same of a motion on a spring, where it changes on the way.
    pub on_spring: Option<OnSpring>,
    /// Pulls of the strings at bodies, by index of body \[N\].
    pub tensions: Vec<(usize, Expr)>,
    /// What forces give by Newton's laws, where a motion does not follow from its energy alone.
    pub steps: Vec<Step>,
    /// Bodies in flight that turn as one.
    pub clusters: Vec<Cluster>,
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
    /// Where it stands in them that what holds its fixed point grips: more than pushing may be needed.
    pub grips: Vec<Grip>,
    /// What was checked.
    pub checks: Vec<Check>,
}

impl StageTold {
    /// The cluster in which a body flies, if it does.
    pub fn cluster_of(&self, body: usize) -> Option<&Cluster> {
        self.clusters.iter().find(|c| c.bodies.contains(&body))
    }

    /// All that must be ≥ 0 for it.
    pub fn rests_on(&self) -> impl Iterator<Item = &Expr> {
        self.needs.iter().chain(&self.besides)
    }

    /// Whether words stand in what it takes for granted, and tell what has to grip.
    pub fn says_of_grips(&self, words: &Sentence) -> bool {
        let mut grips = self.grips.iter();
        self.assumptions.contains(words)
            && grips.any(|grip| grip.told(&self.placed.scene.domains).as_ref() == Some(words))
    }

    /// A stage of which no more is told yet than how it begins and ends.
    pub(super) fn new(stage: &Stage, before: State, after: State) -> StageTold {
        StageTold {
            name: stage.name.clone(),
            placed: stage.clone(),
            before,
            after,
            ..StageTold::default()
        }
    }
}

/// An outcome of a stage and those it goes on from, by index of the stage and of the outcome; the nearest first.
pub(crate) fn line(
    stages: &[StageTold],
    at: (usize, usize),
) -> impl Iterator<Item = (usize, usize)> {
    successors(Some(at), |(stage, _)| stages[*stage].branch)
}

/// A scene, told: its stages, or the one impact that it is.
#[derive(Clone, Debug, Default)]
pub struct Told {
    /// The stages.
    pub stages: Vec<StageTold>,
    /// The answers.
    pub answers: Vec<Answer>,
    /// How the statement is read.
    pub readings: Vec<String>,
    /// Data that no answer needs.
    pub unused: Vec<Symbol>,
    /// Where the laws contradict each other: the scene ends there, and nothing that would follow is told.
    pub ended: Vec<Refused>,
}

impl Told {
    /// The impact of a scene that has no stages.
    pub fn alone(&self) -> Option<&Case> {
        match self.stages.as_slice() {
            [only] if only.name.is_empty() => only.cases.first(),
            _ => None,
        }
    }

    /// Everything that is taken for granted: how the statement is read, and what the stages suppose.
    pub fn assumed(&self) -> Vec<Sentence> {
        granted::assumed(&self.readings, &self.stages)
    }

    /// Why what is told cannot happen, by stage; empty where it can.
    pub fn refusals(&self) -> Vec<String> {
        let cases = self
            .stages
            .iter()
            .flat_map(|s| s.cases.iter().map(move |c| (s, c)));
        let all = cases.filter_map(|(s, c)| {
            let refusal = c.possible.refusal()?;
            Some(match s.name.as_str() {
                "" => refusal,
                name => format!("{name}: {refusal}"),
            })
        });
        let motions = self.stages.iter().flat_map(|s| {
            let failed = s.checks.iter();
            let failed = failed.filter(|c| c.kind == second::POSSIBLE && c.holds == Some(false));
            failed.map(|c| format!("{}: not possible: {}", s.name, c.words))
        });
        all.chain(motions).collect()
    }

    /// Whether no check failed, and no laws contradict each other.
    pub fn holds(&self) -> bool {
        let mut cases = self.stages.iter().flat_map(|s| &s.cases);
        self.ended.is_empty() && cases.all(|c| c.possible.holds()) && self.is_proved()
    }

    /// Whether all that fails is what somebody wanted to see shown.
    pub fn fails_in_claims_alone(&self, scene: &Scene) -> bool {
        let is_claim = |answer: &Answer| {
            let question = scene.question(&answer.question);
            question.is_some_and(|q| matches!(q.ask, Ask::Show { .. }))
        };
        let others = self.answers.iter().filter(|a| !is_claim(a));
        let mut others = others
            .flat_map(|a| &a.checks)
            .chain(self.checks_of_stages());
        let mut cases = self.stages.iter().flat_map(|s| &s.cases);
        let can_be = self.ended.is_empty() && cases.all(|c| c.possible.holds());
        can_be && !self.is_proved() && others.all(|c| c.holds != Some(false))
    }

    /// Whether no check failed.
    pub fn is_proved(&self) -> bool {
        self.checks().all(|c| c.holds != Some(false))
    }

    /// The checks of the stages and of the answers.
    pub fn checks(&self) -> impl Iterator<Item = &Check> {
        let answers = self.answers.iter().flat_map(|a| &a.checks);
        self.checks_of_stages().chain(answers)
    }

    /// The checks of the stages.
    pub fn checks_of_stages(&self) -> impl Iterator<Item = &Check> {
        let cases = self.stages.iter().flat_map(|s| &s.cases);
        let proofs = cases.flat_map(|c| c.proof.checks());
        proofs.chain(self.stages.iter().flat_map(|s| &s.checks))
    }
}
