//! From the file as written to the scene: names become indices, formulas expressions, shapes inertias.
//!
//! In: the records of [`super::file`]. Out: a [`Scene`] with the claims it rests on, or faults. Whatever cannot be read is
//! reported and skipped, so that one pass reports independent faults together. Mechanics is checked in [`super::check`].

use std::collections::HashMap;

use super::body::{Solid, SolidReader};
use super::body_file::{BodyFile, ShapeName, VelocityFile};
use super::check::{Claim, Claimed, check, unused};
use super::fault::{Fault, Span, TOLD};
use super::file::SceneFile;
use super::formulas::{Quantity, Symbols};
use super::geometry::turned;
use super::place::Place;
use super::record::{Formula, Map, Pair, Text};
use super::touch::Placed;
use super::{
    Blow, BlowImpulse, Body, Force, Hinge, NamedPoint, Scene, Shape, Turns, parameters, plots,
    questions,
};
use crate::algebra;
use crate::expr::{Expr, Vector, minus, plus};
use crate::formula::near::nearest;

/// Most bodies, points or questions a scene may have.
const ENTRIES: usize = 10_000;

/// What is known while a scene is put together.
pub(super) struct Resolver<'f> {
    pub file: &'f SceneFile,
    pub symbols: Symbols,
    pub faults: Vec<Fault>,
    /// What the scene claims of its formulas, to be checked when everything is read.
    pub claims: Vec<Claimed>,
    pub points: HashMap<&'f str, usize>,
    pub bodies: HashMap<&'f str, usize>,
    pub point_places: Vec<Place>,
    pub body_places: Vec<Place>,
    pub composites: HashMap<usize, Solid>,
    pub chain: Vec<String>,
}

/// Puts the scene together and checks it; `faults` are those of the file's shape, to which more are added.
pub(super) fn resolve(
    file: &SceneFile,
    turns: &[Turns],
    mut faults: Vec<Fault>,
) -> (Scene, Vec<Fault>) {
    let mut scene = Scene {
        turns: turns.to_vec(),
        title: text(&file.title),
        source: text(&file.source),
        statement: text(&file.statement),
        gains_energy: file.gains_energy.unwrap_or_default(),
        ..Scene::default()
    };
    scene.printed = super::printed::resolve(file, &mut faults);
    let mut claims = Vec::new();
    let symbols = parameters::resolve(file, &mut scene, &mut claims, &mut faults);
    for parameter in &scene.parameters {
        if super::printed::mentions(&scene.printed, &parameter.name) {
            symbols.mark_used(&parameter.name);
        }
    }
    let mut resolver = Resolver::new(file, symbols, faults, claims);
    resolver.sizes();
    if resolver.faults.len() <= TOLD {
        resolver.fill(&mut scene);
    }
    if resolver.faults.is_empty() {
        scene.figure = super::drawing::hints(&mut resolver, &scene.domains);
    }
    if resolver.faults.is_empty() && file.stages.is_some() {
        super::stages::resolve(&mut resolver, &mut scene);
    } else if resolver.faults.is_empty() {
        questions::of_answers(&mut resolver, &mut scene);
    }
    if resolver.faults.is_empty() {
        plots::plots(&mut resolver, &mut scene);
    }
    let Resolver {
        symbols,
        mut faults,
        claims,
        ..
    } = resolver;
    if faults.is_empty() {
        scene.remarks.extend(symbols.remarks());
        scene.units = symbols.units();
        scene.has_plain_numbers = symbols.has_plain_numbers();
        faults = check(&mut scene, &claims);
        let unused = unused(&scene, |name| symbols.is_used(name));
        // Data that a problem gives in vain are no oversight where the scene asks for them.
        let asks = |q: &super::Question| matches!(q.ask, super::Ask::Unused(_));
        if !scene.questions.iter().any(asks) {
            scene.remarks.extend(unused);
        }
    }
    (scene, faults)
}

pub(super) fn names<T>(map: Option<&Map<T>>) -> HashMap<&str, usize> {
    let all = keys(map).into_iter().map(|name| name.text.as_str());
    all.zip(0..).collect()
}

pub(super) fn text(text: &Option<Text>) -> String {
    text.as_ref().map(|t| t.text.clone()).unwrap_or_default()
}

/// The entries of a map that could be read.
pub(super) fn entries<T>(map: Option<&Map<T>>) -> impl Iterator<Item = (&Text, &T)> {
    let all = map.into_iter().flat_map(|m| &m.0);
    all.filter_map(|(name, entry)| Some((name, entry.as_ref()?)))
}

impl<'f> Resolver<'f> {
    /// Nothing of the file placed yet.
    pub fn new(
        file: &'f SceneFile,
        symbols: Symbols,
        faults: Vec<Fault>,
        claims: Vec<Claimed>,
    ) -> Resolver<'f> {
        let points = names(file.points.as_ref());
        let bodies = names(Some(&file.bodies));
        Resolver {
            file,
            symbols,
            faults,
            claims,
            point_places: vec![Place::Untouched; points.len()],
            body_places: vec![Place::Untouched; bodies.len()],
            points,
            bodies,
            composites: HashMap::new(),
            chain: Vec::new(),
        }
    }

    /// Reports absurd sizes and unusable names.
    fn sizes(&mut self) {
        let file = self.file;
        let lists: [(&str, Vec<&Text>); 6] = [
            ("points", keys(file.points.as_ref())),
            ("bodies", keys(Some(&file.bodies))),
            ("hinges", keys(file.hinges.as_ref())),
            ("contacts", keys(file.contacts.as_ref())),
            ("blows", keys(file.blows.as_ref())),
            ("questions", keys(file.questions.as_ref())),
        ];
        let mut transmitters: HashMap<&str, &str> = HashMap::new();
        for (what, keys) in &lists {
            if keys.len() > ENTRIES {
                let message = format!("{} {what}, more than {ENTRIES}", keys.len());
                self.faults.push(Fault::new(keys[ENTRIES].span, message));
            }
            for key in keys {
                let fits = (1..=100).contains(&key.text.chars().count());
                let bad = key.text.trim() != key.text || key.text.chars().any(char::is_control);
                if bad || !fits {
                    let message = "a name has 1 to 100 characters and no blank at its ends";
                    self.faults.push(Fault::new(key.span, message));
                }
                if matches!(*what, "hinges" | "contacts" | "blows")
                    && let Some(other) = transmitters.insert(&key.text, what)
                {
                    let message =
                        format!("`{}` is already the name of one of the {other}", key.text);
                    let hint = "an impulse is asked for by this name";
                    self.report(key.span, message, hint);
                }
            }
        }
    }

    pub fn fill(&mut self, scene: &mut Scene) {
        let file = self.file;
        for (i, (name, _)) in file.points.iter().flat_map(|m| &m.0).enumerate() {
            let at = self.point(i).unwrap_or_else(origin);
            let name = name.text.clone();
            scene.points.push(NamedPoint { name, at });
        }
        for i in 0..file.bodies.0.len() {
            let body = self.body(i);
            scene.bodies.push(body);
        }
        if self.faults.is_empty() && scene.bodies.iter().all(Body::is_fixed) {
            let hint = "add a body that is not fixed";
            self.report(file.span, "no body here can move", hint);
        }
        for (name, hinge) in entries(file.hinges.as_ref()) {
            let bodies = self.pair(&hinge.bodies.items, hinge.bodies.span, "hinge");
            let at = self.position(&hinge.at);
            if let (Some(bodies), Some(at)) = (bodies, at) {
                self.reach(bodies, &at, name.span, &name.text);
                self.claim(name.span, Claim::Hinge(scene.hinges.len()));
                if self.file.stages.is_none() {
                    self.claim(name.span, Claim::Placed(Placed::Hinge(scene.hinges.len())));
                }
                scene.hinges.push(Hinge {
                    name: name.text.clone(),
                    bodies,
                    at,
                });
            }
        }
        self.move_with_hinges(scene);
        for (name, contact) in entries(file.contacts.as_ref()) {
            self.contact(name, contact, scene);
        }
        for (name, blow) in entries(file.blows.as_ref()) {
            let body = self.moving(&blow.on);
            let at = self.position(&blow.at);
            let impulse = match (&blow.impulse, &blow.along) {
                (Some(given), None) => self
                    .vector(given, Quantity::IMPULSE)
                    .map(BlowImpulse::Given),
                (None, Some(along)) => self.direction(along).map(BlowImpulse::Along),
                _ => {
                    let message = "a blow has either `impulse` or `along`";
                    let fault = Fault::new(blow.span, message).shown_at(name.span);
                    self.faults.push(fault.hint(
                            "`impulse` gives it; `along` only says in which direction it acts, and one of unknown direction is two blows, `along` x and `along` y",
                        ));
                    None
                }
            };
            if let (Some(body), Some(at), Some(impulse)) = (body, at, impulse) {
                self.reach([body, body], &at, name.span, &name.text);
                if self.file.stages.is_none() {
                    self.claim(name.span, Claim::Placed(Placed::Blow(scene.blows.len())));
                }
                scene.blows.push(Blow {
                    name: name.text.clone(),
                    body,
                    at,
                    impulse,
                });
            }
        }
        for known in file.after.iter().flatten() {
            let known = self.known(known);
            scene.after.extend(known);
        }
        self.friction_alone(scene);
        for force in file.forces.iter().flatten() {
            let name = force.name.text.clone();
            let body = self.body_named(&force.on);
            scene.forces.extend(body.map(|body| Force { name, body }));
        }
        if file.stages.is_none() {
            questions::of_impact(self, scene);
        }
    }

    /// Lets hinged bodies without a velocity of their own move as their hinges do: v_G = v_A + ω k × r_G/A, from one body to
    /// the next. In a scene with stages the hinges of its first impact say so, where that is how it begins.
    fn move_with_hinges(&mut self, scene: &mut Scene) {
        let file = self.file;
        let stages = file.stages.as_ref();
        let first = stages.and_then(|s| s.first()?.impact.as_ref());
        let begins = first.and_then(|impact| impact.hinges.as_ref());
        let mut hinges: Vec<([usize; 2], Vector)> = Vec::new();
        for (_, hinge) in entries(begins) {
            let bodies = hinge.bodies.items.each_ref();
            if let [Some(a), Some(b)] = bodies.map(|name| self.find_body(&name.text))
                && let Some(at) = self.position(&hinge.at)
            {
                hinges.push(([a, b], at));
            }
        }
        hinges.extend(scene.hinges.iter().map(|h| (h.bodies, h.at.clone())));
        let told = |(_, entry): &(Text, Option<BodyFile>)| {
            let told = |b: &BodyFile| b.velocity.is_some() || b.shape == ShapeName::Fixed;
            entry.as_ref().is_none_or(told)
        };
        let mut moves: Vec<bool> = file.bodies.0.iter().map(told).collect();
        let hinged = || hinges.iter().flat_map(|(pair, _)| pair);
        while let Some(waiting) = hinged().find(|b| !moves[**b]) {
            let mut all = hinges.iter();
            let next = all.find_map(|([a, b], at)| match [moves[*a], moves[*b]] {
                [true, false] => Some((*a, *b, at)),
                [false, true] => Some((*b, *a, at)),
                _ => None,
            });
            // The first of bodies hinged to each other alone is at rest.
            let Some((known, other, at)) = next else {
                moves[*waiting] = true;
                continue;
            };
            let [known, body] = [known, other].map(|b| &scene.bodies[b]);
            let on = turned(&body.spin, &minus(&body.center, at));
            let velocity = plus(&known.velocity_at(at), &on);
            scene.bodies[other].velocity =
                velocity.map(|v| algebra::tidy(&v, &scene.domains).unwrap_or(v));
            moves[other] = true;
        }
    }

    /// The body as the scene holds it. Of a body that cannot be read only the name is right, and a fault tells.
    fn body(&mut self, i: usize) -> Body {
        let (name, entry) = &self.file.bodies.0[i];
        let mut body = Body {
            name: name.text.clone(),
            shape: Shape::Other,
            mass: Expr::zero(),
            inertia: Expr::zero(),
            inertia_given: false,
            center: self.center(i).unwrap_or_else(origin),
            angle: Expr::zero(),
            velocity: origin(),
            spin: Expr::zero(),
        };
        let Some(entry) = entry else { return body };
        let solid = match self.composites.remove(&i) {
            Some(solid) => Some(solid),
            None if entry.shape == ShapeName::Composite => None,
            None => self.solids().read(entry),
        };
        if let Some(solid) = solid {
            (body.shape, body.mass, body.inertia) = (solid.shape, solid.mass, solid.inertia);
            body.inertia_given = solid.inertia_given;
        }
        if let Some(angle) = &entry.angle {
            body.angle = self.read(angle, Quantity::ANGLE).unwrap_or_else(Expr::zero);
        }
        if let Some(spin) = &entry.spin {
            body.spin = self.read(spin, Quantity::SPIN).unwrap_or_else(Expr::zero);
        }
        let velocity = match &entry.velocity {
            None => None,
            Some(VelocityFile::Components(v)) => self.vector(v, Quantity::VELOCITY),
            Some(VelocityFile::About(turn)) => {
                if body.is_particle() {
                    let message = "a particle has no spin to turn with";
                    let hint = "give its velocity as [x, y]";
                    self.report(turn.span, message, hint);
                }
                self.position(&turn.about)
                    .map(|about| turned(&body.spin, &minus(&body.center, &about)))
            }
        };
        body.velocity = velocity.unwrap_or_else(origin);
        body
    }

    /// Reads a formula of a quantity.
    pub fn read(&mut self, formula: &Formula, quantity: Quantity) -> Option<Expr> {
        self.symbols.read(formula, quantity, &mut self.faults)
    }

    /// Reads both components of a vector.
    pub fn vector(&mut self, pair: &Pair<Formula>, quantity: Quantity) -> Option<Vector> {
        self.symbols.vector(pair, quantity, &mut self.faults)
    }

    /// Notes what the scene relies on, to be checked when everything is read.
    pub fn claim(&mut self, span: Span, claim: Claim) {
        self.claims.push(Claimed { span, claim });
    }

    /// Reports what is wrong at a place, and what to do about it.
    pub fn report(&mut self, at: Span, message: impl Into<String>, hint: impl Into<String>) {
        self.faults.push(Fault::new(at, message).hint(hint));
    }

    /// The same, for what cannot be read because of it.
    pub fn refuse<T>(
        &mut self,
        at: Span,
        message: impl Into<String>,
        hint: impl Into<String>,
    ) -> Option<T> {
        self.report(at, message, hint);
        None
    }

    pub fn solids(&mut self) -> SolidReader<'_> {
        SolidReader {
            symbols: &self.symbols,
            claims: &mut self.claims,
            faults: &mut self.faults,
        }
    }

    pub(super) fn shape(&self, body: usize) -> Option<ShapeName> {
        self.file.bodies.0.get(body)?.1.as_ref().map(|b| b.shape)
    }

    /// Whether the body is a particle.
    pub fn is_particle(&self, body: usize) -> bool {
        self.shape(body) == Some(ShapeName::Particle)
    }

    /// Whether the body is fixed.
    pub fn is_fixed(&self, body: usize) -> bool {
        self.shape(body) == Some(ShapeName::Fixed)
    }

    /// Index of a body.
    pub fn body_named(&mut self, name: &Text) -> Option<usize> {
        let found = self.bodies.get(name.text.as_str()).copied();
        if found.is_none() {
            self.unknown(name, "body", |this| this.bodies.keys().copied().collect());
        }
        found
    }

    /// Index of a body that can move.
    pub fn moving(&mut self, name: &Text) -> Option<usize> {
        let body = self.body_named(name)?;
        if self.is_fixed(body) {
            let message = format!("`{}` is fixed, and does not move", name.text);
            return Fault::new(name.span, message).add_to(&mut self.faults);
        }
        Some(body)
    }

    /// Index of a body, if one has this name.
    pub fn find_body(&self, name: &str) -> Option<usize> {
        self.bodies.get(name).copied()
    }

    /// Position of a named point, if there is one of this name.
    pub fn find_point(&mut self, name: &str) -> Option<Option<Vector>> {
        let i = self.points.get(name).copied()?;
        Some(self.point(i))
    }

    /// Reports a name that stands for nothing, with the nearest that does.
    pub fn unknown<'a>(
        &mut self,
        name: &Text,
        what: &str,
        candidates: impl FnOnce(&Self) -> Vec<&'a str>,
    ) {
        let fault = Fault::new(name.span, format!("there is no {what} `{}`", name.text));
        // Searching for the nearest name takes time that is not worth it for faults nobody will be told.
        let mut candidates = match self.faults.len() <= TOLD {
            true => candidates(self),
            false => Vec::new(),
        };
        candidates.sort_unstable();
        let near = nearest(&name.text, candidates.iter().copied());
        self.faults.push(match near {
            Some(near) => fault.hint(format!("did you mean `{near}`?")),
            None if (1..=12).contains(&candidates.len()) => {
                fault.hint(format!("there is {}", candidates.join(", ")))
            }
            None => fault,
        });
    }

    /// Names of all bodies and points.
    pub fn positions(&self) -> Vec<&'f str> {
        let all = self.points.keys().chain(self.bodies.keys());
        all.copied().collect()
    }
}

/// The names of a map.
pub(super) fn keys<T>(map: Option<&Map<T>>) -> Vec<&Text> {
    let all = map.into_iter().flat_map(|m| &m.0);
    all.map(|(name, _)| name).collect()
}

/// The zero vector.
pub(super) fn origin() -> Vector {
    [Expr::zero(), Expr::zero()]
}
