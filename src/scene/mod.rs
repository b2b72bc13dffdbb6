//! A scene: bodies, hinges, contacts, what is known and what is asked, with every position and velocity a formula.
//!
//! Coordinates are absolute: x to the right, y up, counterclockwise positive. A contact normal points out of the first
//! body into the second; the impulse of a contact is the one on the second body.

mod ask;
mod body;
mod body_file;
mod check;
mod contact;
mod contact_file;
mod drawing;
mod fault;
mod file;
mod formulas;
mod friction;
mod geometry;
mod joined;
mod json;
mod meant;
pub mod outline;
mod parameters;
mod place;
mod place_file;
mod plots;
mod printed;
mod proof;
mod question_file;
mod questions;
mod record;
mod relations;
mod repeat;
mod resolve;
mod stage;
mod stage_file;
mod stages;
pub mod touch;

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

use crate::dimension::{self, Dimension};
use crate::domain::{Domains, generic_point};
use crate::expr::{Expr, Point, Scalar, Symbol, Vector, minus};
use crate::formula::Symbols;
use crate::formula::near::nearest;

pub use ask::{Ask, EnergyWhen, ImpulseAt, PlotAsk, Question};
pub use drawing::{Drawn, Outline, Support};
pub use fault::{Fault, Faults, Span};
pub use friction::{
    ALONE, Condition, ContactSpace, Decided, Friction, FrictionEvent, Hypothesis, Mode,
    beside_friction,
};
pub use geometry::direction;
pub use joined::{HINGED, Joint, joints, left_behind, unsaid};
pub use printed::{Print, Printed};
pub use questions::INSTANTANEOUS_CENTER;
pub use stage::{
    Carrier, Fall, FallEnd, Linkage, Lump, OneSided, Slide, SlideEnd, Spring, Stage, StageKind,
    Strung, Turn, Turns, Until, Wind,
};

/// Longest text of a scene file, in bytes.
pub const LONGEST: usize = 1 << 20;

/// Reads a scene file, JSON with comments. What is wrong with it comes back as faults, all that one pass can find.
pub fn read(text: &str) -> Result<Scene, Faults> {
    parsed(text, "scene", |root, faults| {
        let unrolled = repeat::unrolled(root, faults);
        if !faults.is_empty() {
            return Scene::default();
        }
        let (root, turns) = match &unrolled {
            Some((root, turns)) => (root, turns.as_slice()),
            None => (root, [].as_slice()),
        };
        let Some(mut file) = <file::SceneFile as record::Read>::read(root, faults) else {
            return Scene::default();
        };
        questions::order::order(&mut file);
        stages::spread(&mut file);
        let lone = stages::lone(&file).or_else(|| questions::with_parts(&file));
        let whole = lone.as_ref().unwrap_or(&file);
        let (mut scene, all) = resolve::resolve(whole, turns, std::mem::take(faults));
        *faults = all;
        questions::name_centers(&file, &mut scene);
        scene
    })
}

/// Reads a list of printed things from a file of its own, in the form they have in a scene.
pub fn read_printed(text: &str) -> Result<Vec<Printed>, Faults> {
    parsed(text, "list", |root, faults| {
        let list: Option<Vec<file::PrintedFile>> = record::Read::read(root, faults);
        printed::entries(list.as_deref().unwrap_or_default(), faults)
    })
}

/// What is made of a text of JSON, which is a `what`, unless faults are found.
fn parsed<T>(
    text: &str,
    what: &str,
    make: impl FnOnce(&json::Node<'_>, &mut Vec<Fault>) -> T,
) -> Result<T, Faults> {
    let alone = |fault| Faults::gather(vec![fault], text);
    if text.len() > LONGEST {
        let message = format!("{} bytes; a {what} has at most {LONGEST}", text.len());
        return Err(alone(Fault::new(Span::default(), message)));
    }
    let root = json::parse(text).map_err(alone)?;
    let mut faults = Vec::new();
    let made = make(&root, &mut faults);
    if faults.is_empty() {
        return Ok(made);
    }
    let mut faults = Faults::gather(faults, text);
    for fault in &mut faults.list {
        fault.pointer = root.pointer_to(fault.span);
    }
    Err(faults)
}

/// Name of the schema of scene files, wherever a copy of it lies; the number grows when a scene that was right no longer is.
const SCHEMA_ID: &str = "urn:carom:schema:scene:1";

/// The JSON Schema of scene files, for editors.
pub fn schema() -> String {
    let mut schema = schemars::schema_for!(file::SceneFile);
    schema.insert(String::from("$id"), String::from(SCHEMA_ID).into());
    serde_json::to_string_pretty(schema.as_value()).unwrap_or_default()
}

/// Gives a parameter a value in its unit, such as `2`, `1/3` or `acos(3/5)`; the scene is checked at the new value.
/// On a fault the scene is as before. The fault's place counts in `value`.
pub fn set(scene: &mut Scene, name: &str, value: &str) -> Result<(), Fault> {
    let all = Span::new(0, value.len());
    let Some(parameter) = scene.parameter(name) else {
        let fault = Fault::new(all, format!("there is no parameter `{name}`"));
        let near = nearest(name, scene.parameters.iter().map(|p| &*p.name));
        return Err(match near {
            Some(near) => fault.hint(format!("did you mean `{near}`?")),
            None => fault,
        });
    };
    let wrong = |message: String| Fault::new(all, message);
    let unit = dimension::unit(&parameter.unit).map_err(|trouble| wrong(trouble.message))?;
    let mut faults = Vec::new();
    let read = parameters::value(&parameters::whole(value), &unit, &mut faults);
    let why = faults.pop();
    let read = read.ok_or_else(|| why.unwrap_or_else(|| wrong("this is no value".into())))?;
    if let Some(domain) = scene.domains.symbols.get(&parameter.name) {
        parameters::lies_in(name, &read, domain).map_err(wrong)?;
    }
    let name = parameter.name.clone();
    let before = put(scene, &name, Some(read));
    let Some(fault) = check::at_values(scene, all) else {
        return Ok(());
    };
    put(scene, &name, before);
    Err(fault)
}

/// Gives a parameter its value, in the scenes of the stages too. Gives the value it had.
fn put(scene: &mut Scene, name: &Symbol, value: Option<Expr>) -> Option<Expr> {
    for stage in &mut scene.stages {
        put(&mut stage.scene, name, value.clone());
    }
    let parameter = scene.parameters.iter_mut().find(|p| p.name == *name)?;
    std::mem::replace(&mut parameter.value, value)
}

/// What is wrong with the values now given taken together, such as a relation that they break. The fault has no place.
pub fn values_fit(scene: &Scene) -> Result<(), Fault> {
    relations::broken(scene, Span::default()).map_or(Ok(()), Err)
}

/// Everything a scene file says, with names resolved to indices.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// Heading of the worked solution.
    pub title: String,
    /// Where the problem comes from, such as `Sample 17.29`.
    pub source: String,
    /// The problem in words.
    pub statement: String,
    /// Parameters in the order of the file.
    pub parameters: Vec<Parameter>,
    /// Domains of the parameters, and declared unit vectors.
    pub domains: Domains,
    /// Named points.
    pub points: Vec<NamedPoint>,
    /// Bodies in the order of the file.
    pub bodies: Vec<Body>,
    /// Hinges that hold before, during and after.
    pub hinges: Vec<Hinge>,
    /// Points where bodies collide.
    pub contacts: Vec<Contact>,
    /// Impulses from outside.
    pub blows: Vec<Blow>,
    /// What is known about the motion just after.
    pub after: Vec<Known>,
    /// Finite forces that act too; they have no impulse, and the solution says so.
    pub forces: Vec<Force>,
    /// What is asked: of a scene with stages in the order of the file, of one impact first what is asked of its motion.
    pub questions: Vec<Question>,
    /// Curves to be drawn.
    pub plots: Vec<PlotAsk>,
    /// How it wants to be drawn.
    pub figure: Drawn,
    /// What a book prints about the scene.
    pub printed: Vec<Printed>,
    /// Impacts and motions one after the other, in the order of the file, where the scene tells them; hinges, contacts and
    /// blows then stand there. Empty for a scene of one impact.
    pub stages: Vec<Stage>,
    /// Groups of stages that are repeated, in the order of the file.
    pub turns: Vec<Turns>,
    /// Indices of the bodies whose centers are held by axles in all stages: the pulleys of strings.
    pub axles: Vec<usize>,
    /// How an incomplete statement or a missing figure is read, in words.
    pub readings: Vec<String>,
    /// Whether kinetic energy may be gained at the contacts: something is set free there that the scene does not tell.
    pub gains_energy: bool,
    /// What the reader noticed that is no fault, such as a parameter that nothing uses.
    pub remarks: Vec<String>,
}

impl Scene {
    /// Names of its parameters.
    pub fn symbols(&self) -> impl Iterator<Item = &Symbol> + Clone {
        self.parameters.iter().map(|p| &p.name)
    }

    /// Values in general position of its parameters, and of what stands for places and motion that earlier stages leave open.
    pub fn generic_point(&self) -> Point<f64> {
        let bodies = self.bodies.iter();
        let state = bodies.flat_map(|b| b.center.iter().chain(&b.velocity).chain([&b.spin]));
        let open: BTreeSet<Symbol> = state.flat_map(Expr::symbols).collect();
        let open = open.iter().filter(|name| self.parameter(name).is_none());
        generic_point(self.symbols().chain(open), &self.domains)
    }

    /// Whether anything acts on a body in the impact.
    pub fn takes_part(&self, b: usize) -> bool {
        let hinges = self.hinges.iter().map(|h| h.bodies);
        let mut pairs = hinges.chain(self.contacts.iter().map(|c| c.bodies));
        pairs.any(|bodies| bodies.contains(&b))
            || self.blows.iter().any(|blow| blow.body == b)
            || self.after.iter().any(|known| known.body == b)
    }

    /// Whether the laws of impact say how a body moves just after. A fixed body has none; nor has one without mass that
    /// takes no part: it moves on, as the lightest body would.
    pub fn has_law(&self, b: usize) -> bool {
        !self.bodies[b].is_fixed() && (!self.bodies[b].mass.is_zero() || self.takes_part(b))
    }

    /// Positions of its points relative to one another, r_{B/C} from C to B \[m\], none where there are many; G is the center
    /// of mass of the one body that can move.
    pub fn arms(&self) -> Vec<(String, Vector)> {
        const MOST: usize = 8;
        let mut free = self.bodies.iter().filter(|b| !b.is_fixed());
        let named = self.points.iter().map(|p| (p.name.as_str(), &p.at));
        let mut places: Vec<(&str, &Vector)> = named.collect();
        if let (Some(body), None) = (free.next(), free.next())
            && self.points.iter().all(|p| p.name != "G")
        {
            places.push(("G", &body.center));
        }
        let mut arms = Vec::new();
        for (i, (to, at)) in places.iter().enumerate().filter(|_| places.len() <= MOST) {
            for (_, (from, base)) in places.iter().enumerate().filter(|(j, _)| *j != i) {
                arms.push((format!("r_{to}/{from}"), minus(at, base)));
            }
        }
        arms
    }

    /// The name of what stands at a position at the beginning: a point, else a body with its center of mass there.
    pub fn named_at(&self, at: &Vector) -> Option<&str> {
        let points = self.points.iter().map(|p| (&p.name, &p.at));
        let bodies = self.bodies.iter().map(|b| (&b.name, &b.center));
        let mut all = points.chain(bodies).filter(|(_, place)| *place == at);
        all.next().map(|(name, _)| name.as_str())
    }

    /// Whether it goes through stages, and is not one impact.
    pub fn has_stages(&self) -> bool {
        !self.stages.is_empty()
    }

    /// Its stages, or its one impact as the only stage.
    pub fn course(&self) -> Cow<'_, [Stage]> {
        match self.has_stages() {
            true => Cow::Borrowed(&self.stages),
            false => {
                // What is printed or told of the scene is no part of the impact; where it is drawn, what stands round it is.
                let impact = Scene {
                    points: self.points.clone(),
                    forces: self.forces.clone(),
                    figure: self.figure.clone(),
                    bodies: self.bodies.clone(),
                    hinges: self.hinges.clone(),
                    contacts: self.contacts.clone(),
                    blows: self.blows.clone(),
                    after: self.after.clone(),
                    questions: self.questions.clone(),
                    axles: self.axles.clone(),
                    gains_energy: self.gains_energy,
                    ..Scene::default()
                };
                Cow::Owned(vec![Stage::alone(impact)])
            }
        }
    }

    /// The questions about this impact: its motion, impulses, energy and equations.
    pub fn asked_of_impact(&self) -> impl Iterator<Item = &Question> {
        let impact = |q: &&Question| q.stage.is_none() && q.ask.is_motion();
        self.questions.iter().filter(impact)
    }

    /// The parameter of this name.
    pub fn parameter(&self, name: &str) -> Option<&Parameter> {
        self.parameters.iter().find(|p| *p.name == *name)
    }

    /// Declares the parameters, each with its LaTeX and its dimension, as names of formulas.
    pub fn declare_parameters(&self, symbols: &mut Symbols) {
        for p in &self.parameters {
            let dimension = Some(p.dimension.clone());
            symbols.declare_as(p.name.clone(), p.latex.as_deref(), dimension);
        }
    }

    /// The question of this name.
    pub fn question(&self, name: &str) -> Option<&Question> {
        self.questions.iter().find(|q| q.name == name)
    }

    /// The values that are given, in SI units.
    pub fn values(&self) -> BTreeMap<Symbol, Expr> {
        let each = self.parameters.iter();
        let given = each.filter_map(|p| Some((p.name.clone(), p.value.clone()?)));
        given.collect()
    }

    /// The values that are given as numbers, of those that this type can represent.
    pub fn given<T: Scalar>(&self) -> Point<T> {
        let nowhere = Point::default();
        let value = |p: &Parameter| {
            let value = p.value.as_ref()?.evaluate(&nowhere)?;
            Some((p.name.clone(), value))
        };
        Point {
            values: self.parameters.iter().filter_map(value).collect(),
            ..Point::default()
        }
    }

    /// The same in doubles, where every parameter has one.
    pub fn all_given(&self) -> Option<Point<f64>> {
        let point = self.given();
        let mut names = self.parameters.iter().map(|p| &p.name);
        let all = names.all(|name| point.values.contains_key(name));
        all.then_some(point)
    }

    /// The questions about answers: values, zeros, limits, forms for a small parameter, identities.
    pub fn asked_of_answers(&self) -> impl Iterator<Item = &Question> {
        let answers = |q: &&Question| q.stage.is_none() && !q.ask.is_motion();
        self.questions.iter().filter(answers)
    }

    /// The contact with friction, by index, and its law.
    pub fn friction(&self) -> Option<(usize, &Friction)> {
        let mut contacts = self.contacts.iter().enumerate();
        contacts.find_map(|(c, contact)| match &contact.law {
            ContactLaw::Friction(law) => Some((c, &**law)),
            _ => None,
        })
    }
}

/// A given quantity.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Name in formulas.
    pub name: Symbol,
    /// How it is typeset, such as `\ell`.
    pub latex: Option<String>,
    /// Unit as written, such as `kg m^2`.
    pub unit: String,
    /// Dimension of the unit.
    pub dimension: Dimension,
    /// Value in SI units, exact: 30 mm is 3/100, 30 deg is a sixth of `pi`.
    pub value: Option<Expr>,
    /// What it is, in words.
    pub meaning: String,
}

impl Parameter {
    /// SI value of one unit, such as 1/1000 for mm: a value divided by it is the number to write before the unit.
    pub fn scale(&self) -> Expr {
        dimension::unit(&self.unit).map_or_else(|_| Expr::one(), |unit| unit.value())
    }

    /// Whether it is a plane angle.
    pub fn is_angle(&self) -> bool {
        self.dimension.is_none() && dimension::unit(&self.unit).is_ok_and(|u| u.angle)
    }
}

/// A point with a name.
#[derive(Clone, Debug)]
pub struct NamedPoint {
    /// Name, such as `C`.
    pub name: String,
    /// Position \[m\].
    pub at: Vector,
}

/// A rigid body, a particle, or something that does not move because of the collision.
#[derive(Clone, Debug)]
pub struct Body {
    /// Name in the scene.
    pub name: String,
    /// What it looks like, and its inertia.
    pub shape: Shape,
    /// Mass m \[kg\]; zero for a massless link, meaningless for a fixed body.
    pub mass: Expr,
    /// Moment of inertia about the center of mass, I_G [kg m²].
    pub inertia: Expr,
    /// Whether the file gives the moment of inertia itself instead of leaving it to the shape.
    pub inertia_given: bool,
    /// Center of mass G \[m\]; for a fixed body the point its velocity refers to.
    pub center: Vector,
    /// Orientation of the body's long axis, counterclockwise from x \[rad\].
    pub angle: Expr,
    /// Velocity of G just before, v_G⁻ [m/s].
    pub velocity: Vector,
    /// Angular velocity just before, ω⁻ [rad/s], counterclockwise.
    pub spin: Expr,
}

/// Words that need a noun after them in a sentence.
const ADJECTIVES: [&str; 23] = [
    "left", "right", "upper", "lower", "top", "bottom", "front", "rear", "back", "inner", "outer",
    "near", "far", "first", "second", "third", "last", "hanging", "small", "large", "big", "light",
    "heavy",
];

/// `the upper body` of `the upper`; what needs no noun stays as it is.
pub fn with_noun(words: String, noun: &str) -> String {
    match words.rsplit(' ').next() {
        Some(last) if ADJECTIVES.contains(&last) => format!("{words} {noun}"),
        _ => words,
    }
}

impl Body {
    /// Velocity just before of its point at this place [m/s], v_G⁻ + ω⁻ × r; a particle has but one.
    pub fn velocity_at(&self, at: &Vector) -> Vector {
        if self.is_particle() || self.spin.is_zero() {
            return self.velocity.clone();
        }
        let [x, y] = geometry::turned(&self.spin, &minus(at, &self.center));
        [&self.velocity[0] + x, &self.velocity[1] + y]
    }

    /// Whether its motion is prescribed: ground, walls, pegs.
    pub fn is_fixed(&self) -> bool {
        matches!(self.shape, Shape::Fixed)
    }

    /// What a sentence calls it: `the bar`, `ball 1`, `body A`.
    pub fn called(&self) -> String {
        let name = self.name.replace('_', " ");
        let name = name.trim();
        if name.to_lowercase().starts_with("the ") {
            return name.to_string();
        }
        if name.chars().count() == 1 || ["one", "two", "three", "four"].contains(&name) {
            return format!("body {name}");
        }
        let digits = name.chars().rev().take_while(char::is_ascii_digit).count();
        let count = name.chars().count();
        if digits > 0 && digits < count {
            let word: String = name.chars().take(count - digits).collect();
            let number: String = name.chars().skip(count - digits).collect();
            let word = word.trim();
            return match word.chars().count() {
                1 => format!("body {word}{number}"),
                _ => format!("{word} {number}"),
            };
        }
        match name.chars().next() {
            Some(first) if first.is_uppercase() => name.to_string(),
            _ => with_noun(format!("the {name}"), "body"),
        }
    }

    /// Whether it has no extension, so that neither spin nor moment equation belong to it.
    pub fn is_particle(&self) -> bool {
        matches!(self.shape, Shape::Particle)
    }

    /// Whether it is a pulley without mass: it turns as its strings do, and how it turned before plays no part.
    pub fn is_light_pulley(&self) -> bool {
        matches!(self.shape, Shape::Disk { .. }) && self.mass.is_zero()
    }
}

/// The shapes a scene can name.
#[derive(Clone, Debug)]
pub enum Shape {
    /// Ground, wall, peg; also a wall that moves at a prescribed velocity.
    Fixed,
    /// A point mass.
    Particle,
    /// A uniform thin rod of this length along the body's axis.
    Rod {
        /// Length \[m\].
        length: Expr,
    },
    /// A uniform disk.
    Disk {
        /// Radius \[m\].
        radius: Expr,
    },
    /// A thin ring.
    Ring {
        /// Radius \[m\].
        radius: Expr,
    },
    /// A uniform solid sphere.
    Sphere {
        /// Radius \[m\].
        radius: Expr,
    },
    /// A uniform rectangle.
    Rectangle {
        /// Side along the body's axis \[m\].
        width: Expr,
        /// Side across the body's axis \[m\].
        height: Expr,
    },
    /// Any other body; mass, center and inertia are all that is known.
    Other,
    /// Parts held together rigidly by massless bars.
    Composite {
        /// The parts; only shape, mass, inertia, center and angle of each mean something.
        parts: Vec<Body>,
    },
}

impl Shape {
    /// Radius of a disk, ring or sphere \[m\]; `None` for anything that is not round.
    pub fn radius(&self) -> Option<&Expr> {
        match self {
            Shape::Disk { radius } | Shape::Ring { radius } | Shape::Sphere { radius } => {
                Some(radius)
            }
            _ => None,
        }
    }
}

/// A frictionless hinge between two bodies, of which one may be fixed.
#[derive(Clone, Debug)]
pub struct Hinge {
    /// Name.
    pub name: String,
    /// Indices of the bodies; the reaction is the impulse on the second.
    pub bodies: [usize; 2],
    /// Position \[m\].
    pub at: Vector,
}

/// A point where two bodies collide.
#[derive(Clone, Debug)]
pub struct Contact {
    /// Name.
    pub name: String,
    /// Indices of the bodies; the impulse is the one on the second.
    pub bodies: [usize; 2],
    /// Position \[m\].
    pub at: Vector,
    /// Outward unit normal of the first body.
    pub normal: Option<Vector>,
    /// The law that closes the equations.
    pub law: ContactLaw,
    /// Whether one body goes through the other.
    pub passes: bool,
}

impl Contact {
    /// Velocity just before of the point of the second body relative to that of the first [m/s].
    pub fn relative_velocity(&self, scene: &Scene) -> Vector {
        let [one, two] = self.bodies.map(|b| scene.bodies[b].velocity_at(&self.at));
        minus(&two, &one)
    }
}

/// What is assumed of a collision beyond momentum balance.
#[derive(Clone, Debug, PartialEq)]
pub enum ContactLaw {
    /// None: momentum balance alone.
    None,
    /// The touching points have the same velocity after.
    Sticking,
    /// Impulse along the normal; normal relative velocity after = −e × before.
    Frictionless {
        /// Coefficient of restitution, 0 ≤ e ≤ 1.
        restitution: Expr,
    },
    /// Coulomb friction. It closes the equations only once its mode is known; until then it counts as no law.
    Friction(Box<Friction>),
    /// Friction in one of its modes. No scene file states it.
    Decided(Box<Decided>),
}

impl ContactLaw {
    /// The conditions of a decided mode of friction.
    pub fn conditions(&self) -> Option<&[Condition; 2]> {
        match self {
            ContactLaw::Decided(decided) => Some(&decided.conditions),
            _ => None,
        }
    }
}

/// An impulse from outside the scene.
#[derive(Clone, Debug)]
pub struct Blow {
    /// Name.
    pub name: String,
    /// Index of the body it acts on.
    pub body: usize,
    /// Point of application \[m\].
    pub at: Vector,
    /// The given impulse [N s], or the direction along which an impulse of unknown size acts.
    pub impulse: BlowImpulse,
}

/// What is known of an impulse from outside.
#[derive(Clone, Debug)]
pub enum BlowImpulse {
    /// Both components [N s].
    Given(Vector),
    /// A direction (unit vector); the magnitude follows from what is known after.
    Along(Vector),
}

/// Something known of the motion just after, in place of a law.
#[derive(Clone, Debug)]
pub struct Known {
    /// Name under which a matrix question takes it as a row; may be empty.
    pub name: String,
    /// Index of the body.
    pub body: usize,
    /// The quantity.
    pub what: KnownQuantity,
    /// Its value just after.
    pub value: Expr,
}

impl Known {
    /// The body that a velocity is counted from.
    pub fn to(&self) -> Option<usize> {
        match self.what {
            KnownQuantity::Velocity { to, .. } => to,
            KnownQuantity::Spin => None,
        }
    }
}

/// What [`Known`] speaks of.
#[derive(Clone, Debug)]
pub enum KnownQuantity {
    /// Component along `along` of the velocity of the body's point at `at` [m/s].
    Velocity {
        /// Point of the body.
        at: Vector,
        /// Direction, a unit vector.
        along: Vector,
        /// Index of the body whose point at the same place the velocity is counted from; `None` for the ground.
        to: Option<usize>,
    },
    /// Angular velocity [rad/s].
    Spin,
}

/// A finite force, which has no impulse in the vanishing time of a collision.
#[derive(Clone, Debug)]
pub struct Force {
    /// Name in words, such as `weight`.
    pub name: String,
    /// Index of the body it acts on.
    pub body: usize,
}
