//! What velocities, spins and impulses are called: as the questions name them, else by the book's usual letters.

use super::label::Label;
use super::plane::{Pair, size};
use super::stage::{Stage, center_name};
use crate::expr::{Expr, Vector};
use crate::formula::latex_words;
use crate::scene::Ask;

pub(super) fn vector_name(name: &str, latex: Option<&str>) -> Label {
    let mut label = Label::symbol(name, latex);
    if latex.is_none()
        && let Some(run) = label
            .runs
            .first_mut()
            .filter(|r| r.text.chars().count() == 1)
    {
        run.arrow = true;
    }
    label
}

/// The index of a body's quantities: nothing for the only one, else its own letter, its center's name, or its own.
pub(super) fn index(stage: &Stage, body: usize) -> String {
    if stage.movable().len() == 1 {
        return String::new();
    }
    match center_name(stage, body) {
        _ if stage.scene.bodies[body].is_lettered() => stage.scene.bodies[body].name.clone(),
        Some(label) => label.text().chars().map(plain_digit).collect(),
        None => stage.scene.bodies[body].name.clone(),
    }
}

fn plain_digit(c: char) -> char {
    match c {
        '₀'..='₉' => {
            char::from_u32(u32::from(c) - u32::from('₀') + u32::from('0')).unwrap_or(c)
        }
        _ => c,
    }
}

pub(super) fn velocity_name(stage: &Stage, body: usize) -> Label {
    let asked = stage.scene.asked_of_impact().find(|q| match &q.ask {
        Ask::Velocity {
            body: b,
            point: None,
            along: None,
        } => *b == body,
        _ => false,
    });
    match asked {
        Some(q) => vector_name(&q.name, q.latex.as_deref()),
        None => {
            let only = stage.movable().len() == 1 && !stage.scene.bodies[body].is_particle();
            let index = if only {
                "G".to_string()
            } else {
                index(stage, body)
            };
            Label::vector("v", &index, "+")
        }
    }
}

pub(super) fn spin_name(stage: &Stage, body: usize, spin: f64) -> Label {
    for question in stage.scene.asked_of_impact() {
        if let Ask::Spin { body: b, clockwise } = &question.ask
            && *b == body
        {
            let label = Label::symbol(&question.name, question.latex.as_deref());
            return if (spin < 0.0) == *clockwise {
                label
            } else {
                label.negated()
            };
        }
    }
    let index = index(stage, body);
    let label = Label::latex(&if index.is_empty() {
        "\\omega^{+}".to_string()
    } else {
        format!("\\omega_{{{}}}^{{+}}", latex_words(&index))
    });
    if spin < 0.0 { label.negated() } else { label }
}

/// Longest formula at an arrow, in characters; what is longer is named.
pub(super) const LEGIBLE: usize = 11;

/// The name of a spin before.
pub(super) fn spin_before(stage: &Stage, body: usize) -> Label {
    match index(stage, body) {
        none if none.is_empty() => Label::latex("\\omega^{-}"),
        index => Label::latex(&format!("\\omega_{{{}}}^{{-}}", latex_words(&index))),
    }
}

/// The label of a velocity arrow before.
pub(super) fn speed(stage: &Stage, body: usize, v: &Vector, value: Pair) -> Label {
    let short = magnitude(stage, v, value).filter(|l| l.text().chars().count() <= LEGIBLE);
    short.unwrap_or_else(|| {
        let scene = stage.scene;
        let pair = Label::words("(")
            .then(Label::formula(&v[0], scene))
            .then(Label::words(", "))
            .then(Label::formula(&v[1], scene))
            .then(Label::words(")"));
        if pair.text().chars().count() <= 14 {
            return pair;
        }
        let only = stage.movable().len() == 1 && !scene.bodies[body].is_particle();
        let index = if only {
            "G".to_string()
        } else {
            index(stage, body)
        };
        Label::vector("v", &index, "-")
    })
}

/// The length of a vector as a formula, where it is a short one.
pub(super) fn magnitude(stage: &Stage, v: &Vector, value: Pair) -> Option<Label> {
    let scene = stage.scene;
    let signed = |e: &Expr, value: f64| {
        let positive = if e.is_negative() { -e } else { e.clone() };
        let label = Label::formula(&positive, scene);
        // What points against its symbol carries a minus sign.
        if (value < 0.0) == e.is_negative() {
            label
        } else {
            label.negated()
        }
    };
    match (v[0].is_zero(), v[1].is_zero()) {
        (true, false) => return Some(signed(&v[1], value[1])),
        (false, true) => return Some(signed(&v[0], value[0])),
        _ => {}
    }
    // A symbol s with |v| = s here and elsewhere: v was written as s along a direction.
    let names = v[0].symbols().into_iter().chain(v[1].symbols());
    let mut elsewhere = stage.values.clone();
    for (k, entry) in elsewhere.point.values.values_mut().enumerate() {
        *entry *= 1.0 + 0.1 * (k as f64 + 1.0);
    }
    for name in names {
        let s = Expr::symbol(&name);
        let fits = [stage.values, &elsewhere].into_iter().all(|values| {
            match (values.pair(v), values.of(&s)) {
                (Some(p), Some(value)) => {
                    (size(p) - value.abs()).abs() < 1e-9 * value.abs().max(1e-300)
                }
                _ => false,
            }
        });
        if fits {
            return Some(Label::formula(&s, scene));
        }
    }
    None
}
