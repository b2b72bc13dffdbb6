//! A scene: bodies, hinges, contacts, what is known and what is asked, with every position and velocity a formula.
//!
//! Coordinates are absolute: x to the right, y up, counterclockwise positive. A contact normal points out of the first
//! body into the second; the impulse of a contact is the one on the second body.

mod ask;
mod body;
mod body_file;
mod check;
mod claim;
mod contact;
mod contact_file;
mod drawing;
mod elements;
mod fault;
mod file;
mod formulas;
mod friction;
mod geometry;
mod joined;
mod json;
mod meaning;
mod meant;
mod meanwhile;
mod motion;
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
mod resolver;
mod stage;
mod stage_file;
mod stages;
pub mod touch;
mod touched;

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

use crate::dimension::{self, System};
use crate::domain::{Domains, generic_point};
use crate::expr::{Expr, Point, Scalar, Symbol, Vector, minus, only};
use crate::formula::Symbols;
use crate::formula::near::nearest;

pub use ask::{Ask, Extremum, ImpulseAt, PlotAsk, Question};
pub use drawing::{Drawn, Outline};
pub use elements::{
    Acting, Blow, BlowImpulse, Body, Contact, ContactLaw, Force, Hinge, Known, KnownQuantity,
    NamedPoint, Parameter, Shape, with_noun,
};
pub use fault::{Fault, Faults, Span};
pub use file::Support;
pub use friction::{
    ALONE, Condition, ContactSpace, Decided, Friction, FrictionEvent, Hypothesis, Mode,
    beside_friction,
};
pub use geometry::direction;
pub use joined::{HINGED, Joint, joints, left_behind, unsaid};
pub use motion::{
    Carrier, Fall, FallEnd, Linkage, Lump, Slide, SlideEnd, Spring, Strung, Turn, Until, Wind,
};
pub use printed::{Print, Printed};
pub use question_file::EnergyWhen;
pub use questions::INSTANTANEOUS_CENTER;
pub use stage::{OneSided, Stage, StageKind, Turns};
pub use stages::without_case;

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
        touched::settle(&mut file);
        let lone = stages::lone(&file).or_else(|| questions::with_parts(&file));
        let whole = lone.as_ref().unwrap_or(&file);
        let (mut scene, all) = resolve::resolve(whole, turns, std::mem::take(faults));
        *faults = all;
        questions::name_centers(&file, &mut scene);
        meaning::infer(&mut scene);
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
    set_all(scene, [(name, value)]).map_err(|unfit| unfit.1)
}

/// Gives several parameters values, one after the other; the scene is checked at all of them together. A fault comes with
/// the name that it is about, where it is about one alone.
pub fn set_all<'a>(
    scene: &mut Scene,
    values: impl IntoIterator<Item = (&'a str, &'a str)>,
) -> Result<(), Box<(Option<&'a str>, Fault)>> {
    let mut before = Vec::new();
    let mut names = Vec::new();
    let mut fault = None;
    for (name, value) in values {
        names.push(name);
        match put_in(scene, name, value) {
            Ok(old) => before.push((Symbol::from(name), old)),
            Err(why) => {
                fault = Some((Some(name), why));
                break;
            }
        }
    }
    let fault = fault.or_else(|| {
        let why = check::at_values(scene, Span::default())?;
        Some((names.first().copied().filter(|_| names.len() == 1), why))
    });
    let Some(fault) = fault else { return Ok(()) };
    for (name, old) in before.into_iter().rev() {
        put(scene, &name, old);
    }
    Err(Box::new(fault))
}

/// Gives a parameter a value inside its domain; gives the value it had.
fn put_in(scene: &mut Scene, name: &str, value: &str) -> Result<Option<Expr>, Fault> {
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
    Ok(put(scene, &name, Some(read)))
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
    /// Units that stand beside numbers in its formulas, as they are written.
    pub units: Vec<String>,
    /// Whether a mass, a place, a speed of the file is a plain number in its unit: dimensions of what is made of them cannot be
    /// told then.
    pub has_plain_numbers: bool,
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

    /// What acts between two bodies: contacts, then hinges.
    pub fn touching(&self) -> impl Iterator<Item = Acting<'_>> {
        let contacts = self.contacts.iter().enumerate().map(|(i, c)| Acting {
            from: ImpulseAt::Contact(i),
            name: &c.name,
            at: &c.at,
            bodies: c.bodies,
        });
        let hinges = self.hinges.iter().enumerate().map(|(i, h)| Acting {
            from: ImpulseAt::Hinge(i),
            name: &h.name,
            at: &h.at,
            bodies: h.bodies,
        });
        contacts.chain(hinges)
    }

    /// What acts on bodies in the impact: contacts, hinges, then blows.
    pub fn acting(&self) -> impl Iterator<Item = Acting<'_>> {
        let blows = self.blows.iter().enumerate().map(|(i, b)| Acting {
            from: ImpulseAt::Blow(i),
            name: &b.name,
            at: &b.at,
            bodies: [b.body; 2],
        });
        self.touching().chain(blows)
    }

    /// Whether anything acts on a body in the impact.
    pub fn takes_part(&self, b: usize) -> bool {
        self.acting().any(|one| one.bodies.contains(&b))
            || self.after.iter().any(|known| known.body == b)
    }

    /// Whether the laws of impact say how a body moves just after. A fixed body has none; nor has one without mass that
    /// takes no part: it moves on, as the lightest body would.
    pub fn has_law(&self, b: usize) -> bool {
        !self.bodies[b].is_fixed() && (!self.bodies[b].mass.is_zero() || self.takes_part(b))
    }

    /// The bodies that can move.
    pub fn moving(&self) -> impl Iterator<Item = usize> + Clone {
        (0..self.bodies.len()).filter(|b| !self.bodies[*b].is_fixed())
    }

    /// Positions of its points relative to one another, r_{B/C} from C to B \[m\], none where there are many; G is the center
    /// of mass of the one body that can move.
    pub fn arms(&self) -> Vec<(String, Vector)> {
        const MOST: usize = 8;
        let free = self.bodies.iter().filter(|b| !b.is_fixed());
        let named = self.points.iter().map(|p| (p.name.as_str(), &p.at));
        let mut places: Vec<(&str, &Vector)> = named.collect();
        if let Some(body) = only(free)
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

    /// The system of units that its data are in.
    pub fn system(&self) -> System {
        let given = self.parameters.iter().filter(|p| p.value.is_some());
        let given = given.map(|p| p.unit.as_str());
        System::of(given.chain(self.units.iter().map(String::as_str)))
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

    /// Whether a parameter is the number of a turn among several, and so a whole one.
    pub fn counts_turns(&self, name: &str) -> bool {
        let mut asked = self.questions.iter();
        asked.any(|q| matches!(&q.ask, Ask::Turn { number, .. } if **number == *name))
    }

    /// The question of this name about the impact.
    pub fn question_of_impact(&self, name: &str) -> Option<&Question> {
        self.asked_of_impact().find(|q| q.name == name)
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
