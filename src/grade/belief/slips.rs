//! What a belief changes: scenes with another inertia, restitution, velocity or length, one slip each.
//!
//! In: a scene. Out: slips with the place they concern. Which belief makes which is the table's business.

use super::{Change, Slip};
use crate::expr::{Expr, Vector, dot, minus};
use crate::scene::{ContactLaw, Scene, Shape};

pub(super) fn slip(scene: Scene, place: &str) -> Slip {
    Slip {
        scene,
        changes: Vec::new(),
        place: place.to_string(),
    }
}

pub(super) fn changed(scene: &Scene, change: Change, place: &str) -> Slip {
    Slip {
        scene: scene.clone(),
        changes: vec![change],
        place: place.to_string(),
    }
}

pub(super) fn movable(s: &Scene) -> impl Iterator<Item = usize> + '_ {
    (0..s.bodies.len()).filter(|b| !s.bodies[*b].is_fixed())
}

pub(super) fn rigid(s: &Scene) -> impl Iterator<Item = usize> + '_ {
    movable(s).filter(|b| !s.bodies[*b].is_particle())
}

pub(super) fn frictionless(s: &Scene) -> impl Iterator<Item = usize> + '_ {
    (0..s.contacts.len()).filter(|c| matches!(s.contacts[*c].law, ContactLaw::Frictionless { .. }))
}

/// The points at which something acts on a body, with names.
pub(super) fn places(s: &Scene, b: usize) -> Vec<(Vector, String)> {
    let contacts = s
        .contacts
        .iter()
        .filter(|c| c.bodies.contains(&b))
        .map(|c| (c.at.clone(), c.name.clone()));
    let hinges = s
        .hinges
        .iter()
        .filter(|h| h.bodies.contains(&b))
        .map(|h| (h.at.clone(), h.name.clone()));
    let blows = s
        .blows
        .iter()
        .filter(|p| p.body == b)
        .map(|p| (p.at.clone(), p.name.clone()));
    contacts.chain(hinges).chain(blows).collect()
}

/// Every point about which somebody might take moments.
pub(super) fn all_places(s: &Scene) -> Vec<(Vector, String)> {
    let mut all: Vec<(Vector, String)> = Vec::new();
    let mut add = |at: &Vector, name: &str| {
        if !all.iter().any(|(known, _)| known == at) {
            all.push((at.clone(), name.to_string()));
        }
    };
    s.points.iter().for_each(|p| add(&p.at, &p.name));
    movable(s).for_each(|b| {
        add(
            &s.bodies[b].center,
            &format!("the center of {}", s.bodies[b].name),
        )
    });
    s.contacts.iter().for_each(|c| add(&c.at, &c.name));
    s.hinges.iter().for_each(|h| add(&h.at, &h.name));
    s.blows.iter().for_each(|p| add(&p.at, &p.name));
    all.truncate(8);
    all
}

pub(super) type Inertias<'a> = &'a dyn Fn(&Scene, usize) -> Vec<(Expr, String)>;

/// Slips that give one body another moment of inertia.
pub(super) fn inertia(s: &Scene, others: Inertias) -> Vec<Slip> {
    let mut found = Vec::new();
    for b in rigid(s) {
        for (value, place) in others(s, b) {
            if value == s.bodies[b].inertia {
                continue;
            }
            let mut scene = s.clone();
            scene.bodies[b].inertia = value;
            let name = &s.bodies[b].name;
            found.push(slip(
                scene,
                &if place.is_empty() {
                    format!("of {name}")
                } else {
                    format!("of {name} {place}")
                },
            ));
        }
    }
    found
}

/// I + k m r² with r from the center to a point.
pub(super) fn shifted(s: &Scene, b: usize, at: &Vector, k: Expr) -> Expr {
    let r = minus(at, &s.bodies[b].center);
    &s.bodies[b].inertia + &(k * &s.bodies[b].mass * dot(&r, &r))
}

/// Moments of inertia a student might look up in place of the right one.
pub(super) fn other_shapes(s: &Scene, b: usize) -> Vec<(Expr, String)> {
    let m = &s.bodies[b].mass;
    let of = |n: i64, d: i64, square: &Expr, words: &str| {
        (
            Expr::ratio(n, d) * m * square.powi(2),
            format!("as if {words}"),
        )
    };
    match &s.bodies[b].shape {
        Shape::Disk { radius } | Shape::Ring { radius } | Shape::Sphere { radius } => vec![
            of(2, 5, radius, "a sphere"),
            of(1, 2, radius, "a disk"),
            of(1, 1, radius, "a ring"),
            of(2, 3, radius, "a hollow sphere"),
            of(1, 4, radius, "a disk about its diameter"),
        ],
        Shape::Rod { length } => vec![
            of(1, 3, length, "taken about the end"),
            of(1, 2, length, "a disk"),
            of(1, 1, length, "all mass at the end"),
            of(1, 4, length, "half of it"),
            of(1, 6, length, "twice as much"),
            of(1, 24, length, "half as much"),
        ],
        Shape::Rectangle { width, height } => {
            let sum = |n: i64, d: i64, words: &str| {
                (
                    Expr::ratio(n, d) * m * (width.powi(2) + height.powi(2)),
                    format!("as if {words}"),
                )
            };
            vec![
                of(1, 12, width, "a rod of its width"),
                of(1, 12, height, "a rod of its height"),
                sum(1, 3, "taken about a corner"),
                sum(1, 48, "its sides were halved"),
            ]
        }
        _ => Vec::new(),
    }
}

pub(super) fn restitution(s: &Scene, other: &dyn Fn(&Expr) -> Expr) -> Vec<Slip> {
    frictionless(s)
        .filter_map(|c| {
            let ContactLaw::Frictionless { restitution } = &s.contacts[c].law else {
                return None;
            };
            let value = other(restitution);
            if value == *restitution {
                return None;
            }
            let mut scene = s.clone();
            scene.contacts[c].law = ContactLaw::Frictionless { restitution: value };
            Some(slip(scene, &format!("at {}", s.contacts[c].name)))
        })
        .collect()
}

pub(super) fn velocities(s: &Scene, other: &dyn Fn(&Vector) -> Vector) -> Vec<Slip> {
    (0..s.bodies.len())
        .filter(|b| s.bodies[*b].velocity.iter().any(|v| !v.is_zero()))
        .map(|b| {
            let mut scene = s.clone();
            scene.bodies[b].velocity = other(&s.bodies[b].velocity);
            slip(scene, &format!("of {}", s.bodies[b].name))
        })
        .collect()
}

/// A parameter that is a length, doubled or halved: in the inertia alone, and everywhere.
pub(super) fn lengths(s: &Scene) -> Vec<Slip> {
    let mut found = Vec::new();
    let meter = crate::dimension::Dimension::new(0, 1, 0);
    for p in s.parameters.iter().filter(|p| p.dimension == meter) {
        for (k, words) in [(Expr::from(2), "twice"), (Expr::ratio(1, 2), "half")] {
            let map =
                std::collections::BTreeMap::from([(p.name.clone(), Expr::symbol(&p.name) * &k)]);
            let place = format!("{words} {}", p.name);
            let mut scene = s.clone();
            for body in &mut scene.bodies {
                body.inertia = body.inertia.substitute(&map);
            }
            found.push(slip(
                scene.clone(),
                &format!("{place} in the moment of inertia"),
            ));
            let both = |v: &Vector| [v[0].substitute(&map), v[1].substitute(&map)];
            let mut arms = s.clone();
            for (b, body) in s.bodies.iter().enumerate() {
                arms.bodies[b].center = both(&body.center);
                scene.bodies[b].center = both(&body.center);
            }
            for (c, contact) in s.contacts.iter().enumerate() {
                arms.contacts[c].at = both(&contact.at);
                scene.contacts[c].at = both(&contact.at);
            }
            for (h, hinge) in s.hinges.iter().enumerate() {
                arms.hinges[h].at = both(&hinge.at);
                scene.hinges[h].at = both(&hinge.at);
            }
            for (i, blow) in s.blows.iter().enumerate() {
                arms.blows[i].at = both(&blow.at);
                scene.blows[i].at = both(&blow.at);
            }
            found.push(slip(arms, &format!("{place} in the positions")));
            found.push(slip(scene, &format!("{place} everywhere")));
        }
    }
    found
}

/// Every body that turns, with another spin before.
pub(super) fn spins(s: &Scene, other: &dyn Fn(&Expr) -> Expr) -> Vec<Slip> {
    (0..s.bodies.len())
        .filter(|b| !s.bodies[*b].spin.is_zero())
        .map(|b| {
            let mut scene = s.clone();
            scene.bodies[b].spin = other(&s.bodies[b].spin);
            slip(scene, &format!("of {}", s.bodies[b].name))
        })
        .collect()
}
