//! From the file as written to the scene: names become indices, formulas expressions, shapes inertias.
//!
//! In: the records of [`super::file`]. Out: a [`Scene`] with the claims it rests on, or faults. Whatever cannot be read is
//! reported and skipped, so that one pass reports independent faults together. Mechanics is checked in [`super::check`].

use std::collections::HashMap;

use super::body_file::{BodyFile, ShapeName, VelocityFile};
use super::check::{check, unused};
use super::claim::Claim;
use super::fault::{Fault, TOLD};
use super::file::SceneFile;
use super::formulas::Quantity;
use super::geometry::{origin, turned};
use super::record::{Text, entries, keys, text};
use super::resolver::Resolver;
use super::touch::Placed;
use super::{
    Blow, BlowImpulse, Body, Force, Hinge, NamedPoint, Scene, Shape, Turns, parameters, plots,
    questions,
};
use crate::algebra;
use crate::expr::{Expr, Vector, minus, plus};

/// Most bodies, points or questions a scene may have.
const ENTRIES: usize = 10_000;

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

impl<'f> Resolver<'f> {
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
            self.report(file.bodies.1.opening(), "no body here can move", hint);
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
}
