//! Stages that hand the motion on. Types only.
//!
//! Every stage carries a [`Scene`] with the bodies as they are when it begins. A stage that follows another does not know
//! where that is: its formulas hold symbols for the places, [`Stage::places`], and for answers to stages before it,
//! [`Stage::earlier`], and each of the two ways puts in what it has found, [`Stage::placed`].

use std::collections::BTreeMap;

use super::motion::{Fall, FallEnd, Linkage, Slide, SlideEnd, Turn, Until, Wind};
use super::{
    Ask, BlowImpulse, Body, Contact, ContactLaw, KnownQuantity, Question, Scene, Shape, direction,
};
use crate::expr::{Expr, Symbol, Vector, dot, minus};

/// A group of stages that happens several times, one turn after the other, as the file writes it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Turns {
    /// Index of the first stage of the first turn.
    pub first: usize,
    /// How many stages a turn has.
    pub stages: usize,
    /// How many turns are written out.
    pub times: usize,
}

impl Turns {
    /// The stages of a turn, by its number from 1.
    pub fn turn(&self, number: usize) -> std::ops::Range<usize> {
        let begin = self.first + (number - 1) * self.stages;
        begin..begin + self.stages
    }
}

/// What a motion of other bodies at the same time begins and ends with.
#[derive(Clone, Debug)]
pub struct During {
    /// Index of the stage.
    pub stage: usize,
    /// Its name.
    pub name: String,
    /// Symbol for how long it takes.
    pub time: Symbol,
}

/// One stage.
#[derive(Clone, Debug, Default)]
pub struct Stage {
    /// Name.
    pub name: String,
    /// The stage whose end is the beginning of this one; `None` for the bodies as the file gives them.
    pub from: Option<usize>,
    /// The motion with which this one begins and ends, where it goes on from that and yet happens at the same time.
    pub during: Option<During>,
    /// Bodies that other stages move while this one lasts.
    pub apart: Vec<usize>,
    /// Bodies that start otherwise than the file says: index, velocity of the center, spin.
    pub start: Vec<(usize, Option<Vector>, Option<Expr>)>,
    /// What happens.
    pub kind: StageKind,
    /// Symbols for center x, y and angle of each body at the beginning, by index of body; empty for a stage that begins as
    /// the file says.
    pub places: Vec<[Symbol; 3]>,
    /// Names of answers to earlier stages that its formulas hold.
    pub earlier: Vec<Symbol>,
    /// The bodies at the beginning; of an impact also its hinges, contacts and blows. Its questions are those about the
    /// end of this stage. Velocities are those of the file and mean nothing after another stage.
    pub scene: Scene,
}

impl Stage {
    /// The one impact of a scene without stages, as its only stage; it has no name.
    pub fn alone(scene: Scene) -> Stage {
        Stage {
            scene,
            ..Stage::default()
        }
    }

    /// An impact that begins as the file says, as a scene of its own; `None` of any other stage, and where a support or string
    /// may let go.
    pub fn from_the_file(&self) -> Option<Scene> {
        let StageKind::Impact { one_sided, .. } = &self.kind else {
            return None;
        };
        if self.from.is_some() || !self.earlier.is_empty() || !one_sided.is_empty() {
            return None;
        }
        let mut scene = self.scene.clone();
        for (b, velocity, spin) in self.start.clone() {
            let body = &mut scene.bodies[b];
            body.velocity = velocity.unwrap_or_else(|| body.velocity.clone());
            body.spin = spin.unwrap_or_else(|| body.spin.clone());
        }
        Some(scene)
    }

    /// The stage with what is known of the places and of earlier answers put in; a symbol without a value stays.
    pub fn placed(&self, values: &BTreeMap<Symbol, Expr>) -> Stage {
        let mut out = self.clone();
        if !values.is_empty() {
            out.formulas_mut(&mut |e| *e = e.substitute(values));
        }
        out
    }

    /// Every formula of what happens, where bodies are, and how they start.
    pub(super) fn formulas_mut(&mut self, put: &mut impl FnMut(&mut Expr)) {
        self.kind.formulas_mut(put);
        self.scene.geometry_mut(put);
        for (_, velocity, spin) in &mut self.start {
            velocity
                .iter_mut()
                .flatten()
                .chain(spin)
                .for_each(&mut *put);
        }
    }

    /// What a question about the end of this stage asks, with the places known here.
    pub fn asked<'a>(&'a self, question: &'a Question) -> &'a Ask {
        &self.scene.question(&question.name).unwrap_or(question).ask
    }
}

/// An impact in which no support or string may let go.
impl Default for StageKind {
    fn default() -> StageKind {
        StageKind::Impact {
            one_sided: Vec::new(),
            supposed: None,
        }
    }
}

impl Body {
    /// Every formula of where the body is.
    pub(super) fn place_mut(&mut self, put: &mut impl FnMut(&mut Expr)) {
        let parts = match &mut self.shape {
            Shape::Composite { parts } => parts.as_mut_slice(),
            _ => &mut [],
        };
        for Body { center, angle, .. } in parts {
            center.iter_mut().chain([angle]).for_each(&mut *put);
        }
        self.center.iter_mut().for_each(&mut *put);
        put(&mut self.angle);
    }
}

impl Scene {
    /// Lets what is asked of a point of a body in an impact be asked where the body has carried it since the file's beginning,
    /// unless something acts at the place that the file gives.
    pub fn carry_points(
        &mut self,
        file: &Scene,
        is_zero: impl Fn(&Expr) -> bool,
        tidied: impl Fn(Expr) -> Expr,
    ) {
        let acting: Vec<Vector> = self.acting().map(|one| one.at.clone()).collect();
        for question in &mut self.questions {
            let Ask::Velocity {
                body,
                point: Some((name, at)),
                ..
            } = &mut question.ask
            else {
                continue;
            };
            let Some(point) = file.points.iter().find(|p| p.name == *name) else {
                continue;
            };
            let is_there = |place: &Vector| minus(place, at).iter().all(&is_zero);
            let (now, first) = (&self.bodies[*body], &file.bodies[*body]);
            if now.is_particle() || acting.iter().any(is_there) {
                continue;
            }
            let [p, q] = minus(&point.at, &first.center);
            let [c, s] = direction(&(&now.angle - &first.angle));
            let [x, y] = &now.center;
            let there = [
                x + &(&(&p * &c) - &(&q * &s)),
                y + &(&(&p * &s) + &(&q * &c)),
            ];
            *at = there.map(&tidied);
        }
    }

    /// The bodies that other stages move while the stage with this name lasts.
    pub fn moved_meanwhile(&self, name: &str) -> Vec<usize> {
        let first = |(j, stage): (usize, &Stage)| stage.during.as_ref().map_or(j, |d| d.stage);
        let all = || self.stages.iter().enumerate();
        let Some(mine) = all().find(|(_, stage)| stage.name == name).map(first) else {
            return Vec::new();
        };
        let others = all().filter(|(j, stage)| stage.name != name && first((*j, stage)) == mine);
        others.flat_map(|(_, stage)| stage.kind.moved()).collect()
    }

    /// The first turn of a repeated group as a scene of its own, which begins wherever one lets it.
    pub fn turn(&self, turns: &Turns) -> Scene {
        let range = turns.turn(1);
        let mut out = self.clone();
        let inside = |i: usize| range.contains(&i).then(|| i - range.start);
        out.stages = self.stages[range.clone()].to_vec();
        for stage in &mut out.stages {
            stage.from = stage.from.and_then(inside);
            let during = stage.during.take();
            stage.during = during.and_then(|during| {
                let stage = inside(during.stage)?;
                Some(During { stage, ..during })
            });
        }
        out.questions.retain_mut(|q| {
            let here = q.stage.map(inside);
            q.stage = here.flatten();
            here != Some(None)
        });
        out.turns = Vec::new();
        out
    }

    /// A scene of one impact as one of a single stage with this name, so that its outcomes can be told one after the other.
    pub fn staged(&self, name: &str) -> Scene {
        let mut out = self.clone();
        for question in &mut out.questions {
            let is_impact =
                question.ask.is_motion() || matches!(question.ask, Ask::Friction { .. });
            question.stage = is_impact.then_some(0);
        }
        let mut stage = Stage::alone(self.clone());
        stage.name = String::from(name);
        let is_asked = |q: &Question| q.ask.is_motion() || matches!(q.ask, Ask::Friction { .. });
        stage.scene.questions.retain(is_asked);
        out.stages = vec![stage];
        (out.hinges, out.contacts, out.blows, out.after) = Default::default();
        out
    }

    /// Every formula that may depend on where bodies are.
    fn geometry_mut(&mut self, put: &mut impl FnMut(&mut Expr)) {
        for point in &mut self.points {
            point.at.iter_mut().for_each(&mut *put);
        }
        for body in &mut self.bodies {
            body.place_mut(put);
        }
        for hinge in &mut self.hinges {
            hinge.at.iter_mut().for_each(&mut *put);
        }
        for Contact {
            at, normal, law, ..
        } in &mut self.contacts
        {
            at.iter_mut()
                .chain(normal.iter_mut().flatten())
                .for_each(&mut *put);
            match law {
                ContactLaw::Frictionless { restitution } => put(restitution),
                ContactLaw::Friction(friction) => {
                    put(&mut friction.mu);
                    put(&mut friction.restitution);
                }
                _ => {}
            }
        }
        for blow in &mut self.blows {
            let (BlowImpulse::Given(v) | BlowImpulse::Along(v)) = &mut blow.impulse;
            blow.at.iter_mut().chain(v).for_each(&mut *put);
        }
        for known in &mut self.after {
            put(&mut known.value);
            if let KnownQuantity::Velocity { at, along, .. } = &mut known.what {
                at.iter_mut().chain(along).for_each(&mut *put);
            }
        }
        for question in &mut self.questions {
            let vectors = question.ask.vectors_mut();
            vectors.into_iter().flatten().for_each(&mut *put);
        }
    }
}

/// What happens in a stage.
#[derive(Clone, Debug)]
pub enum StageKind {
    /// A collision or blow: velocities jump, nothing moves.
    Impact {
        /// Supports that can only push and strings that can only pull.
        one_sided: Vec<OneSided>,
        /// Names of those taken to act, where the file says so.
        supposed: Option<Vec<String>>,
    },
    /// One body turns about a point that stays where it is.
    Turn(Turn),
    /// One body moves along a straight line.
    Slide(Slide),
    /// Bodies fall or fly freely.
    Fall(Fall),
    /// A particle on a rope that winds round a thin pole.
    Wind(Wind),
    /// Bodies joined so that one coordinate tells where they all are.
    Linkage(Linkage),
}

impl StageKind {
    /// Every formula of the stage.
    pub fn formulas_mut(&mut self, put: &mut impl FnMut(&mut Expr)) {
        match self {
            StageKind::Impact { one_sided, .. } => {
                for o in one_sided {
                    o.at.iter_mut().chain(&mut o.normal).for_each(&mut *put);
                }
            }
            StageKind::Turn(turn) => {
                turn.about.iter_mut().for_each(&mut *put);
                if let Until::By(e) | Until::For(e) = &mut turn.until {
                    put(e);
                }
                turn.gravity
                    .iter_mut()
                    .chain(&mut turn.torque)
                    .for_each(put);
            }
            StageKind::Slide(slide) => {
                if let SlideEnd::Distance(e) | SlideEnd::Time(e) = &mut slide.until {
                    put(e);
                }
                for string in &mut slide.strings {
                    let along = string.along.iter_mut();
                    along.chain(&mut string.friction).for_each(&mut *put);
                }
                if let Some(on) = &mut slide.on {
                    let all = on.friction.iter_mut().chain(&mut on.force);
                    all.for_each(&mut *put);
                }
                if let Some(spring) = &mut slide.spring {
                    put(&mut spring.stiffness);
                    put(&mut spring.relaxed);
                }
                let forces = slide.gravity.iter_mut().chain(&mut slide.force);
                forces
                    .chain(&mut slide.friction)
                    .chain(&mut slide.along)
                    .for_each(put);
            }
            StageKind::Fall(fall) => {
                match &mut fall.until {
                    FallEnd::Drop(e)
                    | FallEnd::Range(e)
                    | FallEnd::Turned(e)
                    | FallEnd::Time(e) => {
                        put(e);
                    }
                    FallEnd::Top => {}
                }
                fall.gravity.iter_mut().for_each(put);
            }
            StageKind::Wind(wind) => {
                wind.around.iter_mut().for_each(&mut *put);
                put(&mut wind.to);
            }
            StageKind::Linkage(linkage) => {
                linkage.ends.iter_mut().for_each(&mut *put);
                linkage.gravity.iter_mut().for_each(put);
            }
        }
    }

    /// Whether a symbol stands in a formula of the stage.
    pub fn mentions(&self, name: &Symbol) -> bool {
        let mut found = false;
        let mut look = |e: &mut Expr| found |= e.mentions(name);
        self.clone().formulas_mut(&mut look);
        found
    }

    /// The kind in one word.
    pub fn word(&self) -> &'static str {
        match self {
            StageKind::Impact { .. } => "impact",
            StageKind::Turn(_) => "turn",
            StageKind::Slide(_) => "slide",
            StageKind::Fall(_) => "fall",
            StageKind::Wind(_) => "wind",
            StageKind::Linkage(_) => "linkage",
        }
    }

    /// Indices of the bodies that a motion moves; of an impact none.
    pub fn moved(&self) -> Vec<usize> {
        match self {
            StageKind::Impact { .. } => Vec::new(),
            StageKind::Turn(turn) => turn.bodies(),
            StageKind::Slide(slide) => slide.bodies(),
            StageKind::Fall(fall) => fall.bodies(),
            StageKind::Wind(wind) => vec![wind.body],
            StageKind::Linkage(linkage) => linkage.places.iter().map(|(b, _)| *b).collect(),
        }
    }

    /// Whether one of two bodies slides on the other.
    pub fn bears(&self, [a, b]: [usize; 2]) -> bool {
        let StageKind::Slide(slide) = self else {
            return false;
        };
        slide.on.as_ref().is_some_and(|on| {
            let (above, below) = (slide.company(), on.company());
            let rests = |top: usize, on: usize| above.contains(&top) && below.contains(&on);
            rests(a, b) || rests(b, a)
        })
    }

    /// The list of those that move as one with a body which the motion moves; `None` where none can be added.
    pub(super) fn company_of(&mut self, body: usize) -> Option<&mut Vec<usize>> {
        match self {
            StageKind::Turn(turn) => Some(&mut turn.with),
            StageKind::Slide(slide) => {
                if slide.company().contains(&body) {
                    return Some(&mut slide.with);
                }
                if let Some(on) = &mut slide.on
                    && on.company().contains(&body)
                {
                    return Some(&mut on.with);
                }
                let mut hung = slide.strings.iter_mut().map(|s| &mut s.to);
                hung.find(|to| to.contains(&body))
            }
            _ => None,
        }
    }

    /// Whether a force that is named here, weight or another, may also act on bodies that are not.
    pub fn gravity(&self) -> Option<&Expr> {
        match self {
            StageKind::Impact { .. } | StageKind::Wind(_) => None,
            StageKind::Turn(turn) => turn.gravity.as_ref(),
            StageKind::Slide(slide) => slide.gravity.as_ref(),
            StageKind::Fall(fall) => fall.gravity.as_ref(),
            StageKind::Linkage(linkage) => linkage.gravity.as_ref(),
        }
    }
}

/// A support or string: its impulse on the second body has the direction `normal` or is zero.
#[derive(Clone, Debug)]
pub struct OneSided {
    /// Name.
    pub name: String,
    /// Indices of the bodies.
    pub bodies: [usize; 2],
    /// Position \[m\].
    pub at: Vector,
    /// Direction of the impulse on the second body.
    pub normal: Vector,
    /// Whether it pulls; a support pushes.
    pub is_string: bool,
}

impl OneSided {
    /// What it is where it acts: a contact without rebound.
    pub fn acting(&self) -> Contact {
        Contact {
            name: self.name.clone(),
            bodies: self.bodies,
            at: self.at.clone(),
            normal: Some(self.normal.clone()),
            law: ContactLaw::Frictionless {
                restitution: Expr::zero(),
            },
            passes: false,
            is_string: self.is_string,
        }
    }

    /// Where it acts, as seen from a place: of a string only the part across its pull, since it acts anywhere on its line.
    pub fn gap(&self, from: &Vector) -> Vector {
        let gap = minus(&self.at, from);
        if !self.is_string {
            return gap;
        }
        let across = [-&self.normal[1], self.normal[0].clone()];
        let aside = dot(&gap, &across);
        across.map(|c| &aside * &c)
    }
}
