//! Symbols for the unknowns: the scene's own names where a question gives one, else names made from those of the bodies.

use std::collections::{BTreeMap, BTreeSet};

use crate::expr::{Expr, Vector};
use crate::formula::latex_words;
use crate::laws::{self, Place, Unknown};
use crate::scene::{Ask, BlowImpulse, ImpulseAt, Scene};

/// Plain and LaTeX names of the unknowns; none collides with a parameter or with another unknown.
#[derive(Clone, Debug, Default)]
pub struct Names {
    of: BTreeMap<Unknown, (String, String)>,
    used: BTreeSet<String>,
    reversed: BTreeSet<Unknown>,
}

impl Names {
    /// Names for all unknowns of a scene.
    pub fn of(scene: &Scene) -> Names {
        let mut names = Names::default();
        names
            .used
            .extend(scene.parameters.iter().map(|p| p.name.to_string()));
        for unknown in laws::unknowns(scene) {
            let (plain, latex) = asked_name(scene, unknown).unwrap_or_else(|| {
                // A question of that name may ask for the opposite, or for something else.
                let is_free = |(plain, _): &(String, String)| {
                    named(scene, plain).is_none_or(|ask| is_along(scene, ask, unknown))
                };
                let letters = LETTERS.iter();
                let mut made = letters.map(|letters| made_name(scene, unknown, letters));
                let found = made.find(is_free);
                found.unwrap_or_else(|| made_name(scene, unknown, &LETTERS[0]))
            });
            let plain = names.fresh(&plain);
            names.of.insert(unknown, (plain, latex));
            if asked_reversed(scene, unknown) {
                names.reversed.insert(unknown);
            }
        }
        names
    }

    /// The symbol of an unknown, such as `omega` or `v_bar_x`.
    pub fn plain(&self, unknown: Unknown) -> &str {
        self.of.get(&unknown).map_or("?", |(plain, _)| plain)
    }

    /// The same, typeset.
    pub fn latex(&self, unknown: Unknown) -> &str {
        self.of.get(&unknown).map_or("?", |(_, latex)| latex)
    }

    /// Whether the symbol stands for the opposite of the unknown: a spin that the scene counts clockwise, an impulse on the
    /// first body.
    pub fn is_reversed(&self, unknown: Unknown) -> bool {
        self.reversed.contains(&unknown)
    }

    /// What an unknown is, from the value of its symbol, or the other way round.
    pub fn signed(&self, unknown: Unknown, value: Expr) -> Expr {
        match self.is_reversed(unknown) {
            true => -value,
            false => value,
        }
    }

    /// An unknown by its symbol.
    pub fn symbol(&self, unknown: Unknown) -> Expr {
        self.signed(unknown, Expr::symbol(self.plain(unknown)))
    }

    /// A symbol near `wanted` that nothing else uses.
    pub fn fresh(&mut self, wanted: &str) -> String {
        let mut name = wanted.to_string();
        let mut count = 1;
        while !self.used.insert(name.clone()) {
            count += 1;
            name = format!("{wanted}_{count}");
        }
        name
    }
}

const AXES: [&str; 2] = ["x", "y"];

/// Letters of velocities, spins, impulses and reactions, and those that stand for them where a question has such a name for
/// something else.
const LETTERS: [[&str; 4]; 2] = [["v", "omega", "P", "R"], ["V", "Omega", "J", "J"]];

/// What the question of this name asks for.
fn named<'s>(scene: &'s Scene, plain: &str) -> Option<&'s Ask> {
    let mut asked = scene.asked_of_impact().filter(|q| !q.hidden);
    let found = asked.find(|q| {
        let axis = plain.strip_prefix(q.name.as_str());
        axis.is_some_and(|axis| ["", "_x", "_y"].contains(&axis))
    });
    found.map(|q| &q.ask)
}

/// Whether a question asks for an unknown, counted as the laws count it.
fn is_along(scene: &Scene, ask: &Ask, unknown: Unknown) -> bool {
    let is_unit = |d: &Vector, axis: usize| *d == [0, 1].map(|k| Expr::from(i64::from(k == axis)));
    match (ask, unknown) {
        (
            Ask::Velocity {
                body,
                point: None,
                along: Some(d),
            },
            Unknown::Velocity(b, axis),
        ) => *body == b && is_unit(d, axis),
        (
            Ask::Impulse {
                from,
                on,
                along: Some(d),
            },
            Unknown::Contact(i, axis) | Unknown::Hinge(i, axis),
        ) => {
            let acts = match unknown {
                Unknown::Contact(..) => ImpulseAt::Contact(i),
                _ => ImpulseAt::Hinge(i),
            };
            *from == acts && is_unit(d, axis) && Place::of(scene, *from).1 == *on
        }
        _ => asks_for(scene, ask, unknown).is_some_and(|(_, reversed)| !reversed),
    }
}

/// The name a question gives to an unknown, if one asks for exactly it or its opposite.
fn asked_name(scene: &Scene, unknown: Unknown) -> Option<(String, String)> {
    let (question, axis) = scene
        .asked_of_impact()
        .filter(|q| !q.hidden)
        .find_map(|q| Some((q, asks_for(scene, &q.ask, unknown)?.0)))?;
    let latex = question
        .latex
        .clone()
        .unwrap_or_else(|| crate::formula::latex_name(&question.name));
    Some(match axis {
        Some(axis) => (
            format!("{}_{}", question.name, AXES[axis]),
            crate::formula::with_subscript(&latex, AXES[axis]),
        ),
        None => (question.name.clone(), latex),
    })
}

fn asked_reversed(scene: &Scene, unknown: Unknown) -> bool {
    scene
        .asked_of_impact()
        .filter(|q| !q.hidden)
        .find_map(|q| asks_for(scene, &q.ask, unknown))
        .is_some_and(|(_, reversed)| reversed)
}

/// Whether a question asks for an unknown: the component it is, if any, and whether the opposite is asked for.
fn asks_for(scene: &Scene, ask: &Ask, unknown: Unknown) -> Option<(Option<usize>, bool)> {
    match (ask, unknown) {
        (
            Ask::Velocity {
                body,
                point: None,
                along: None,
            },
            Unknown::Velocity(b, axis),
        ) if *body == b => Some((Some(axis), false)),
        (Ask::Spin { body, clockwise }, Unknown::Spin(b)) if *body == b => Some((None, *clockwise)),
        (
            Ask::Impulse {
                from: ImpulseAt::Contact(c),
                on,
                along,
            },
            Unknown::Normal(i),
        ) if *c == i => {
            // Asked as a vector or along the normal, the name is that of its size.
            let contact = &scene.contacts[i];
            let whole = along.is_none() || *along == contact.normal;
            (whole && contact.bodies[1] == *on).then_some((None, false))
        }
        (
            Ask::Impulse {
                from: ImpulseAt::Contact(c),
                on,
                along: None,
            },
            Unknown::Contact(i, axis),
        ) if *c == i => Some((Some(axis), scene.contacts[i].bodies[1] != *on)),
        (
            Ask::Impulse {
                from: ImpulseAt::Hinge(h),
                on,
                along: None,
            },
            Unknown::Hinge(i, axis),
        ) if *h == i => Some((Some(axis), scene.hinges[i].bodies[1] != *on)),
        (
            Ask::Impulse {
                from: ImpulseAt::Blow(b),
                along,
                ..
            },
            Unknown::Blow(i),
        ) if *b == i => {
            let direction = match &scene.blows[i].impulse {
                BlowImpulse::Given(v) | BlowImpulse::Along(v) => v,
            };
            (along.as_ref() == Some(direction)).then_some((None, false))
        }
        _ => None,
    }
}

fn made_name(scene: &Scene, unknown: Unknown, letters: &[&str; 4]) -> (String, String) {
    let [v, omega, p, r] = *letters;
    let turning = format!("\\{omega}");
    let body = |b: usize| identifier(&scene.bodies[b].name);
    let made = |letter: &str, latex_letter: &str, of: &str, axis: Option<usize>, after: bool| {
        let plus = if after { "^{+}" } else { "" };
        // A letter is a point or a body, a word is upright.
        let index = latex_words(of);
        match axis {
            Some(axis) => {
                let x = AXES[axis];
                (
                    format!("{letter}_{of}_{x}"),
                    format!("{latex_letter}_{{{index},{x}}}{plus}"),
                )
            }
            None => (
                format!("{letter}_{of}"),
                format!("{latex_letter}_{{{index}}}{plus}"),
            ),
        }
    };
    match unknown {
        Unknown::Velocity(b, axis) => made(v, v, &body(b), Some(axis), true),
        Unknown::Spin(b) => made(omega, &turning, &body(b), None, true),
        Unknown::Contact(c, axis) => made(
            p,
            p,
            &identifier(&scene.contacts[c].name),
            Some(axis),
            false,
        ),
        Unknown::Normal(c) => made(p, p, &identifier(&scene.contacts[c].name), None, false),
        Unknown::Hinge(h, axis) => {
            // A reaction, unless a radius has that letter.
            let is_taken = scene.parameters.iter().any(|p| &*p.name == "R");
            let letter = if is_taken { p } else { r };
            let of = identifier(&scene.hinges[h].name);
            made(letter, letter, &of, Some(axis), false)
        }
        Unknown::Blow(i) => made(p, p, &identifier(&scene.blows[i].name), None, false),
    }
}

/// A name reduced to letters, digits and underscores.
fn identifier(name: &str) -> String {
    let mut out: String = name
        .chars()
        .map(|c| if c.is_alphanumeric() { c } else { '_' })
        .collect();
    if out.is_empty() {
        out.push('_');
    }
    out
}
