//! A picture in words: for readers who cannot see it.

use super::Piece;
use super::label::Label;
use super::values::Values;
use crate::expr::{Expr, Vector};
use crate::scene::{Body, ContactLaw, Scene, Shape};

/// The name of a stage, with its case, as a heading.
pub fn title(name: &str) -> String {
    crate::formula::capital(&name.replace('_', " ").replace('`', ""))
}

/// What a scene shows, sentence by sentence.
pub fn scene(scene: &Scene) -> String {
    let text = |e: &Expr| Label::formula(e, scene).text();
    let mut out = Vec::new();
    for body in &scene.bodies {
        let what = shape(body, &text);
        let mut sentence = format!("{}: {what}", body.name);
        if !body.is_fixed() {
            sentence += &format!(" of mass {}", text(&body.mass));
            let moving = !(body.velocity[0].is_zero() && body.velocity[1].is_zero());
            sentence += &match (moving, body.spin.is_zero()) {
                (false, true) => ", at rest".to_string(),
                (true, true) => format!(", moving at {}", vector(&body.velocity, &text)),
                (false, false) => format!(", turning at {}", text(&body.spin)),
                (true, false) => format!(
                    ", moving at {} and turning at {}",
                    vector(&body.velocity, &text),
                    text(&body.spin)
                ),
            };
        }
        out.push(sentence);
    }
    let name = |i: usize| scene.bodies.get(i).map_or("?", |b| b.name.as_str());
    for hinge in &scene.hinges {
        out.push(format!(
            "a hinge {} joins {} and {}",
            hinge.name,
            name(hinge.bodies[0]),
            name(hinge.bodies[1])
        ));
    }
    for contact in &scene.contacts {
        let law = match contact.law {
            ContactLaw::None => "collide",
            ContactLaw::Friction(_) | ContactLaw::Decided(_) => "collide with friction",
            ContactLaw::Sticking => "collide and stick",
            ContactLaw::Frictionless { .. } => "collide without friction",
        };
        out.push(format!(
            "{} and {} {law} at {}",
            name(contact.bodies[0]),
            name(contact.bodies[1]),
            contact.name
        ));
    }
    for blow in &scene.blows {
        out.push(format!("{} is struck by {}", name(blow.body), blow.name));
    }
    let mut all = out.join("; ");
    all.push('.');
    all
}

fn shape(body: &Body, text: &dyn Fn(&Expr) -> String) -> String {
    match &body.shape {
        Shape::Fixed => "fixed".to_string(),
        Shape::Particle => "a particle".to_string(),
        Shape::Rod { length } => format!("a rod of length {}", text(length)),
        Shape::Disk { radius } => format!("a disk of radius {}", text(radius)),
        Shape::Ring { radius } => format!("a ring of radius {}", text(radius)),
        Shape::Sphere { radius } => format!("a ball of radius {}", text(radius)),
        Shape::Rectangle { width, height } => {
            format!("a rectangle {} by {}", text(width), text(height))
        }
        Shape::Other => "a rigid body".to_string(),
        Shape::Composite { parts } => format!("{} parts joined rigidly", parts.len()),
    }
}

fn vector(v: &Vector, text: &dyn Fn(&Expr) -> String) -> String {
    format!("({}, {})", text(&v[0]), text(&v[1]))
}

/// The values a scene is drawn at: ` Drawn for θ = 35°, ℓ = 1 m.`
pub fn values(scene: &Scene, values: &Values, shown: &dyn Fn(&str) -> bool) -> Vec<Piece> {
    let mut out = Vec::new();
    for p in scene.parameters.iter().filter(|p| shown(&p.name)) {
        let Some(value) = values.told(p) else {
            continue;
        };
        let lead = if out.is_empty() { " Drawn for " } else { ", " };
        out.push(Piece::Words(lead.to_string()));
        out.push(Piece::Symbol(Label::symbol(&p.name, p.latex.as_deref())));
        out.push(Piece::Value(value));
    }
    if !out.is_empty() {
        out.push(Piece::Words(String::from(".")));
    }
    out
}
