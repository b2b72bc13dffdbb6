//! Tells a scene with stages: works out each stage from the end of the one before it, then answers the questions.
//!
//! In: a [`Scene`] with stages. Out: [`Told`], the stages with what each conserves and why, and the answers with how
//! each is known; or [`Refused`], the reason why the stages do not fit. Impacts are derived and proved by
//! [`crate::derive`] and [`crate::verify`]; motions follow from work and energy, and are integrated apart from that.

mod alone;
mod answer;
mod change;
mod granted;
mod impact;
mod integrate;
mod joined;
mod lent;
mod motion;
mod second;
mod sheet;
mod spring;
mod words;
mod worlds;

use std::collections::BTreeMap;
use std::iter::successors;

pub(crate) use granted::NO_TIME;
pub use lent::{accelerations, lent};
pub(crate) use motion::by_coordinate;
pub use second::held;
pub use sheet::{Way, beginning, impact, impacts, is_clockwise, moments, outcomes, sheet, ways};

use crate::algebra::Sign;
use crate::answer::calc::{at_least_zero, constant, tidy};
use crate::answer::{Answer, Check, Refused, TOO_LONG};
use crate::derive::{Derivation, Stop};
use crate::domain::Domain;
use crate::expr::{Expr, Point, Symbol, Vector, minus};
use crate::formula::{Sentence, sentence, write_plain};
use crate::scene::{Ask, Scene, Stage, StageKind, direction};
use crate::verify::Proof;
use crate::verify::possible::Possible;

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
    fn open(&mut self, scene: &Scene, [letter, axis]: [&str; 2], b: usize, why: &str) -> Expr {
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
    fn lose(&mut self, scene: &Scene, b: usize, why: &str, motion: bool) {
        self.center[b] = ["x", "y"].map(|letter| self.open(scene, [letter, ""], b, why));
        self.lose_angle(scene, b, why);
        if motion {
            self.velocity[b] = ["_x", "_y"].map(|axis| self.open(scene, ["u", axis], b, why));
            if !scene.bodies[b].is_particle() {
                self.spin[b] = self.open(scene, ["w", ""], b, why);
            }
        }
    }

    /// The angle of a body becomes open.
    fn lose_angle(&mut self, scene: &Scene, b: usize, why: &str) {
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
    fn places(&self, stage: &Stage) -> BTreeMap<Symbol, Expr> {
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
    /// What a contact with friction does, such as "`C` slides"; empty where there is none.
    pub rubs: String,
    /// What must be ≥ 0 for it, in words and as an expression; empty where it holds on the whole domain.
    pub conditions: Vec<(String, Expr)>,
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
        own.chain(self.proof.assumptions.iter().map(Sentence::from))
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
}

impl Step {
    /// An acceleration, by the force or moment and the inertia of what it moves.
    fn by_newton(
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

    fn new(letter: &'static str, raw: &Expr, value: &Expr, why: &'static str) -> Step {
        Step {
            letter,
            raw: raw.clone(),
            value: value.clone(),
            why,
            by_time: Vec::new(),
            inertia: None,
        }
    }
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
    /// What was checked.
    pub checks: Vec<Check>,
}

impl StageTold {
    /// The cluster in which a body flies, if it does.
    pub fn cluster_of(&self, body: usize) -> Option<&Cluster> {
        self.clusters.iter().find(|c| c.bodies.contains(&body))
    }

    /// A stage of which no more is told yet than how it begins and ends.
    fn new(stage: &Stage, before: State, after: State) -> StageTold {
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

impl Refused {
    fn new(stage: &str, reason: impl Into<String>, hint: impl Into<String>) -> Refused {
        let at = match stage {
            "" => String::new(),
            name => format!("stage `{name}`"),
        };
        Refused::at(at, reason, hint)
    }

    fn stop(stage: &str, stop: impl Into<Stop>) -> Refused {
        let stop = stop.into();
        let hint = match stop {
            Stop::Limit(_) => TOO_LONG,
            _ => "",
        };
        Refused::new(stage, stop.to_string(), hint)
    }
}

/// Most ways through the cases of a scene.
const BRANCHES: usize = 32;

/// Tells a scene: its one impact, or its stages. Where an impact has several outcomes, what follows it is told for each.
pub fn tell(scene: &Scene) -> Result<Told, Refused> {
    let mut told = match scene.has_stages() {
        true => {
            let course = course(scene)?;
            Told {
                ended: course.ended,
                ..answer::all(scene, course.stages)?
            }
        }
        false => alone::tell(scene)?,
    };
    for answer in &mut told.answers {
        let broken = answer.broken(scene);
        let told = |words| {
            sentence!(
                "no number at the given values, which do not keep to {}",
                words
            )
        };
        answer.text.extend(broken.map(told));
    }
    Ok(told)
}

/// The stages of a scene as [`tell`] has them, without what is asked and without a second look at them: what a picture needs.
pub fn course(scene: &Scene) -> Result<Told, Refused> {
    through(scene, None)
}

/// The same; what begins where the file begins begins with a state, where one is given.
fn through(scene: &Scene, from: Option<&State>) -> Result<Told, Refused> {
    let mut stages: Vec<StageTold> = Vec::new();
    let mut told_as: Vec<Vec<usize>> = Vec::new();
    let mut ended = Vec::new();
    for stage in &scene.stages {
        let mut mine = Vec::new();
        let mut refused = Vec::new();
        let ways = beginnings(stage, &stages, &told_as, from);
        let several = ways.len() > 1;
        for (branch, mut before, given) in ways {
            let mut earlier = BTreeMap::new();
            for name in &stage.earlier {
                match answer::earlier(scene, &stages, branch, name)? {
                    Ok(value) => _ = earlier.insert(name.clone(), value),
                    Err(why) => _ = before.open.insert(name.clone(), why),
                }
            }
            let mut known = before.places(stage);
            known.extend(earlier.clone());
            let mut placed = stage.placed(&known);
            if !stage.earlier.is_empty() {
                let domains = placed.scene.domains.clone();
                placed
                    .kind
                    .formulas_mut(&mut |e| *e = tidy(e, &domains).unwrap_or_else(|_| e.clone()));
            }
            if stage.from.is_none() && from.is_none() && !stage.earlier.is_empty() {
                before = start(&placed.scene, &placed.start);
            }
            for open in before.open.keys() {
                placed
                    .scene
                    .domains
                    .symbols
                    .insert(open.clone(), Domain::real());
            }
            // A motion goes on where the case that leads to it happens; an impact weighs its own conditions.
            if !matches!(stage.kind, StageKind::Impact { .. }) {
                for (_, need) in &given {
                    placed.scene.domains = placed.scene.domains.given(need, false);
                }
            }
            let begins = several.then(|| before.clone());
            let told = one(scene, &stages, &placed, (before, &given))
                .map(|told| motion::stays_in_front(&placed, &stages, branch, told));
            let mut told = match (told, begins) {
                (Ok(told), _) => told,
                (Err(why), _) if why.contradicts => {
                    ended.push(why);
                    continue;
                }
                // Of several ways one may lead nowhere, and the others on.
                (Err(why), Some(before)) if !placed.kind.moved().is_empty() => {
                    let told = motion::leads_nowhere(&placed, before, &why.reason);
                    refused.push(why);
                    told
                }
                (Err(why), _) => return Err(why),
            };
            told.checks.extend(at_values(scene, &told));
            told.earlier = earlier;
            told.branch = branch;
            told.given = given;
            if let Some((parent, case)) = branch
                && (stages[parent].cases.len() > 1 || told_as[stage.from.unwrap_or(0)].len() > 1)
            {
                told.name = format!("{} ({})", stage.name, words::leading(&stages, parent, case));
            }
            mine.push(stages.len());
            stages.push(told);
            if mine.len() > BRANCHES {
                let why = format!("more than {BRANCHES} cases lead here");
                let hint = "give values, or say with `supposing` which supports act";
                return Err(Refused::new(&stage.name, why, hint));
            }
        }
        if refused.len() == mine.len()
            && let Some(why) = refused.into_iter().next()
        {
            return Err(why);
        }
        told_as.push(mine);
    }
    Ok(Told {
        stages,
        readings: scene.readings.clone(),
        ended,
        ..Told::default()
    })
}

/// What a motion needs and the given values do not keep to.
fn at_values(scene: &Scene, told: &StageTold) -> Option<Check> {
    let given = scene.values();
    let fails = |e: &&Expr| constant(&e.substitute(&given)) == Some(Sign::Negative);
    let words = match told.needs.iter().find(fails) {
        Some(broken) => {
            let need = at_least_zero(broken, &scene.domains).written(write_plain);
            format!("it goes on as told only where {need}, and that is not so at the given values")
        }
        None => {
            let time = told.time.as_ref()?.substitute(&given);
            let is_number = time.symbols().iter().all(|s| &**s == "pi");
            let value = time.evaluate(&Point::<f64>::default());
            if !is_number || value.is_some_and(f64::is_finite) {
                return None;
            }
            String::from("at the given values it never gets to its end")
        }
    };
    Some(Check::new(second::POSSIBLE, words, Some(false)))
}

type Beginning = (Option<(usize, usize)>, State, Vec<(String, Expr)>);

/// The states a stage begins with, one for each way that leads to it.
fn beginnings(
    stage: &Stage,
    stages: &[StageTold],
    told_as: &[Vec<usize>],
    begun: Option<&State>,
) -> Vec<Beginning> {
    let Some(from) = stage.from else {
        let state = begun.cloned();
        let state = state.unwrap_or_else(|| start(&stage.scene, &stage.start));
        return vec![(None, state, Vec::new())];
    };
    let mut out = Vec::new();
    for &parent in &told_as[from] {
        let told = &stages[parent];
        if told.cases.is_empty() {
            out.push((Some((parent, 0)), told.after.clone(), told.given.clone()));
        }
        for (k, case) in told.cases.iter().enumerate() {
            let mut given = told.given.clone();
            // The only one that is supposed, or that values leave, rests on something as well.
            if told.cases.len() > 1 || is_open(&told.placed) {
                given.extend(case.conditions.iter().cloned());
            }
            out.push((Some((parent, k)), case.after.clone(), given));
        }
    }
    out
}

/// Whether an impact may come out one way or another.
fn is_open(stage: &Stage) -> bool {
    let StageKind::Impact { one_sided, .. } = &stage.kind else {
        return false;
    };
    !one_sided.is_empty() || stage.scene.friction().is_some()
}

/// One stage, from a state and what must be ≥ 0 on the way there.
fn one(
    scene: &Scene,
    stages: &[StageTold],
    stage: &Stage,
    (before, given): (State, &[(String, Expr)]),
) -> Result<StageTold, Refused> {
    if !stage.kind.moved().is_empty() {
        if let Some(open) = motion::open(stage, before.clone()) {
            return Ok(open);
        }
        joined::all_move(scene, stage)?;
    }
    match &stage.kind {
        StageKind::Impact {
            one_sided,
            supposed,
        } => {
            joined::left_out(scene, stage)?;
            let named = named(scene, stages, stage);
            let acting = (one_sided.as_slice(), supposed.as_deref());
            impact::tell(&scene.stages, stage, before, acting, &named, given)
        }
        StageKind::Turn(turn) => motion::turn(stage, before, turn),
        StageKind::Slide(slide) => {
            let mine = scene
                .questions
                .iter()
                .filter(|q| q.stage.is_some_and(|i| scene.stages[i].name == stage.name));
            let by_newton =
                |ask: &Ask| matches!(ask, Ask::Acceleration { .. } | Ask::Tension { .. });
            let is_driven = mine.into_iter().any(|q| by_newton(&q.ask));
            motion::slide(stage, before, slide, is_driven)
        }
        StageKind::Fall(fall) => {
            let clusters = joined::turning(scene, stage, &before)?;
            motion::fall(stage, before, fall, &clusters)
        }
        StageKind::Wind(wind) => motion::wind(stage, before, wind),
        StageKind::Linkage(linkage) => motion::linkage(stage, before, linkage),
    }
}

/// Speeds and spins at the end of a stage that have the name of a question, for the impacts after it to go on with.
fn named(scene: &Scene, stages: &[StageTold], later: &Stage) -> Vec<(Symbol, Expr)> {
    let mut out = Vec::new();
    let earlier = std::iter::successors(later.from, |j| scene.stages[*j].from);
    let earlier: Vec<usize> = earlier.collect();
    for question in &scene.questions {
        let Some(stage) = question.stage.filter(|stage| earlier.contains(stage)) else {
            continue;
        };
        let name = &scene.stages[stage].name;
        let mut all = stages.iter().filter(|s| s.placed.name == *name);
        let Some(told) = all.next().filter(|s| s.cases.len() <= 1) else {
            continue;
        };
        // Of an impact that was reached on several ways the name stands for several values.
        if !told.cases.is_empty() && all.next().is_some() {
            continue;
        }
        let value = match told.placed.asked(question) {
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
        open: BTreeMap::new(),
        part: vec![Part::Waits; scene.bodies.len()],
        angle: scene.bodies.iter().map(|b| b.angle.clone()).collect(),
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
