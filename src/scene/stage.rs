//! Stages that hand the motion on. Types only.
//!
//! Every stage carries a [`Scene`] with the bodies as they are when it begins. A stage that follows another does not know
//! where that is: its formulas hold symbols for the places, [`Stage::places`], and for answers to stages before it,
//! [`Stage::earlier`], and each of the two ways puts in what it has found, [`Stage::placed`].

use std::collections::BTreeMap;

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

/// One stage.
#[derive(Clone, Debug, Default)]
pub struct Stage {
    /// Name.
    pub name: String,
    /// The stage whose end is the beginning of this one; `None` for the bodies as the file gives them.
    pub from: Option<usize>,
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
        let mut own = self.scene.questions.iter();
        let own = own.find(|q| q.name == question.name);
        &own.unwrap_or(question).ask
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
        let acting: Vec<Vector> = self.acting_at().cloned().collect();
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

    /// The first turn of a repeated group as a scene of its own, which begins wherever one lets it.
    pub fn turn(&self, turns: &Turns) -> Scene {
        let range = turns.turn(1);
        let mut out = self.clone();
        let inside = |i: usize| range.contains(&i).then(|| i - range.start);
        out.stages = self.stages[range.clone()].to_vec();
        for stage in &mut out.stages {
            stage.from = stage.from.and_then(inside);
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

/// Rotation of a body about a fixed point, between two configurations.
#[derive(Clone, Debug)]
pub struct Turn {
    /// Index of the body.
    pub body: usize,
    /// Indices of bodies that are fixed to it and turn along.
    pub with: Vec<usize>,
    /// The fixed point \[m\].
    pub about: Vector,
    /// What the file calls it.
    pub about_name: String,
    /// Where the stage ends.
    pub until: Until,
    /// Sense of the rotation, where the file tells it.
    pub clockwise: Option<bool>,
    /// Gravity g \[m/s²\], downwards.
    pub gravity: Option<Expr>,
    /// Constant moment about the point \[N m\], positive in the sense of the rotation.
    pub torque: Option<Expr>,
}

/// Bodies that move as one.
#[derive(Clone, Debug)]
pub struct Lump {
    /// Mass \[kg\].
    pub mass: Expr,
    /// Center of mass \[m\].
    pub center: Vector,
}

impl Turn {
    /// All bodies that turn.
    pub fn bodies(&self) -> Vec<usize> {
        [&[self.body], self.with.as_slice()].concat()
    }

    /// The bodies that turn as one, where they are in the scene.
    pub fn lump(&self, scene: &Scene) -> Lump {
        let first = &scene.bodies[self.body];
        if self.with.is_empty() {
            return Lump {
                mass: first.mass.clone(),
                center: first.center.clone(),
            };
        }
        let all: Vec<&super::Body> = self.bodies().iter().map(|b| &scene.bodies[*b]).collect();
        let mass = Expr::sum(all.iter().map(|b| b.mass.clone()));
        let center = [0, 1].map(|axis| {
            let moments = all.iter().map(|b| &b.mass * &b.center[axis]);
            &Expr::sum(moments) / &mass
        });
        Lump { mass, center }
    }
}

/// Where a rotation ends.
#[derive(Clone, Debug)]
pub enum Until {
    /// After turning through this angle \[rad\], counted in the sense of the rotation.
    By(Expr),
    /// When the center of mass is straight above the point.
    Above,
    /// When the center of mass is straight below the point.
    Below,
    /// When it comes to rest.
    Stops,
    /// After this time \[s\]; not under weight, which leaves no closed form.
    For(Expr),
}

/// Motion of a body along a straight line under constant forces: on a guide, or on a surface below it.
#[derive(Clone, Debug)]
pub struct Slide {
    /// Index of the body.
    pub body: usize,
    /// Indices of bodies that move along with it.
    pub with: Vec<usize>,
    /// Direction.
    pub along: Vector,
    /// How the stage ends.
    pub until: SlideEnd,
    /// Gravity g \[m/s²\], downwards; away from the reader where the surface is level.
    pub gravity: Option<Expr>,
    /// Whether the scene is seen from above, and the surface is level.
    pub level: bool,
    /// Whether the way bends gently into the line: the bodies begin along it with the speed that they have.
    pub bend: bool,
    /// Constant force along the direction, at the center of mass \[N\].
    pub force: Option<Expr>,
    /// Coefficient of sliding friction μ of the surface; `None` for a smooth guide.
    pub friction: Option<Expr>,
    /// The body whose surface that is, where it moves too; the direction is then that of the slip on it.
    pub on: Option<Box<Carrier>>,
    /// A light spring along the line.
    pub spring: Option<Spring>,
    /// Whether a round body rolls, by as much friction as that takes.
    pub rolling: bool,
    /// Light inextensible strings from the body to others.
    pub strings: Vec<Strung>,
}

impl Slide {
    /// All bodies that move, pulleys last.
    pub fn bodies(&self) -> Vec<usize> {
        let ends = self.strings.iter().flat_map(Strung::hung);
        let all = self.company().into_iter().chain(ends);
        let below = self.on.iter().flat_map(|on| on.company());
        all.chain(below).chain(self.pulleys()).collect()
    }

    /// The body and those that move along with it.
    pub fn company(&self) -> Vec<usize> {
        [&[self.body], self.with.as_slice()].concat()
    }

    /// Whether the surface is told to be smooth, so that a round body keeps its spin on it.
    pub fn is_smooth(&self) -> bool {
        self.friction.as_ref().is_some_and(Expr::is_zero)
    }

    /// The pulleys of all strings whose centers stay.
    pub fn pulleys(&self) -> impl Iterator<Item = usize> {
        self.strings.iter().flat_map(|s| s.over.iter().copied())
    }
}

/// A body on a level or inclined floor, with another that slides on it.
#[derive(Clone, Debug)]
pub struct Carrier {
    /// Index of the body.
    pub body: usize,
    /// Indices of bodies that move along with it.
    pub with: Vec<usize>,
    /// Coefficient of sliding friction of the floor; `None` for a smooth one.
    pub friction: Option<Expr>,
    /// Constant force on it along the direction of the slide, at the center of mass \[N\].
    pub force: Option<Expr>,
}

impl Carrier {
    /// Whether it is a belt, which runs with a prescribed velocity.
    pub fn is_belt(&self, scene: &Scene) -> bool {
        scene.bodies[self.body].is_fixed()
    }

    /// The body and those that move along with it.
    pub fn company(&self) -> Vec<usize> {
        [&[self.body], self.with.as_slice()].concat()
    }
}

/// A light spring along a line: its force on a body that has gone the way s is k (relaxed − s) along the direction.
#[derive(Clone, Debug)]
pub struct Spring {
    /// Stiffness k \[N/m\].
    pub stiffness: Expr,
    /// The way at which it is relaxed \[m\].
    pub relaxed: Expr,
}

/// Bodies at the other end of a string that runs from a body on a line over pulleys, without slipping on them.
#[derive(Clone, Debug)]
pub struct Strung {
    /// Indices of the bodies; they move as one.
    pub to: Vec<usize>,
    /// Their velocity where the body moves along its own direction at the speed 1: a unit vector, or half of one on a movable
    /// pulley.
    pub along: Vector,
    /// Indices of the pulleys whose centers stay, from the body on.
    pub over: Vec<usize>,
    /// Index of the movable pulley on whose axle the bodies hang; behind it the string is fastened.
    pub under: Option<usize>,
    /// Coefficient of sliding friction of a surface below them; `None` for a smooth guide, or where they hang.
    pub friction: Option<Expr>,
}

impl Strung {
    /// What moves along the line of the other end: the bodies there, and a movable pulley.
    pub fn hung(&self) -> impl Iterator<Item = usize> {
        self.to.iter().copied().chain(self.under)
    }

    /// Their speed where the body has the speed 1.
    pub fn ratio(&self) -> Expr {
        Expr::ratio(1, if self.under.is_some() { 2 } else { 1 })
    }
}

/// How a motion along a line ends.
#[derive(Clone, Debug)]
pub enum SlideEnd {
    /// After this distance \[m\], along the body below where that moves.
    Distance(Expr),
    /// After this time \[s\].
    Time(Expr),
    /// When the body comes to rest.
    Stops,
    /// When the point of contact of a round body no longer slips.
    Rolls,
    /// When the body moves with the one below it.
    Together,
}

/// Free fall, or free flight where there is no gravity.
#[derive(Clone, Debug)]
pub struct Fall {
    /// Index of the body whose way ends the stage.
    pub body: usize,
    /// Indices of bodies that fall or fly at the same time, each on its own or stuck to another of them.
    pub with: Vec<usize>,
    /// Gravity g \[m/s²\], downwards; `None` for free flight.
    pub gravity: Option<Expr>,
    /// How the stage ends.
    pub until: FallEnd,
    /// Whether the body passes the height at which it ends on its way up, and not on its way down.
    pub rising: bool,
    /// Pairs of these bodies that an earlier impact has joined, for whoever follows this stage by itself.
    pub stuck: Vec<[usize; 2]>,
}

impl Fall {
    /// All bodies that fall.
    pub fn bodies(&self) -> Vec<usize> {
        [&[self.body], self.with.as_slice()].concat()
    }
}

/// How a fall ends.
#[derive(Clone, Debug)]
pub enum FallEnd {
    /// When the center of mass is so far below its place at the beginning \[m\]; above it if negative.
    Drop(Expr),
    /// When the center of mass is so far to the right of its place at the beginning \[m\]; to the left of it if negative.
    Range(Expr),
    /// When it has turned through this angle in the sense in which it spins \[rad\].
    Turned(Expr),
    /// After this time \[s\].
    Time(Expr),
    /// When the center of mass rises no more.
    Top,
}

/// A rope that winds round a pole.
#[derive(Clone, Debug)]
pub struct Wind {
    /// Index of the particle.
    pub body: usize,
    /// The pole \[m\].
    pub around: Vector,
    /// Free length at the end \[m\].
    pub to: Expr,
}

/// Bodies with one freedom: joints and guides without friction leave them no other places than those that the file gives for
/// each value of a coordinate.
#[derive(Clone, Debug)]
pub struct Linkage {
    /// The coordinate, a parameter of the scene.
    pub coordinate: Symbol,
    /// Its values at the beginning and at the end.
    pub ends: [Expr; 2],
    /// Index of each body that moves with it, with center x, y \[m\] and angle \[rad\] as the file has them.
    pub places: Vec<(usize, [Expr; 3])>,
    /// Gravity g \[m/s²\], downwards.
    pub gravity: Option<Expr>,
}

impl Linkage {
    /// An expression at a value of the coordinate.
    pub fn at(&self, e: &Expr, value: &Expr) -> Expr {
        e.put(&self.coordinate, value)
    }
}
