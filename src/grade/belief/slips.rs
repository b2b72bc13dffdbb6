//! What a belief changes: scenes with another inertia, restitution, velocity or length, one slip each.
//!
//! In: a scene. Out: slips with the place they concern. Which belief makes which is the table's business.

use super::{Change, Slip};
use crate::dimension::Dimension;
use crate::expr::{Expr, Vector, dot, minus};
use crate::scene::{ContactLaw, Scene, Shape};

impl Slip {
    /// The scene as it is, without a slip.
    pub fn none(scene: &Scene) -> Slip {
        Slip {
            scene: scene.clone(),
            change: None,
            place: String::new(),
        }
    }
}

pub(super) fn slip(scene: Scene, place: String) -> Slip {
    Slip {
        scene,
        change: None,
        place,
    }
}

pub(super) fn changed(scene: &Scene, change: Change, place: impl Into<String>) -> Slip {
    Slip {
        scene: scene.clone(),
        change: Some(change),
        place: place.into(),
    }
}

/// One slip for each part of a scene that `change` changes; it gives the words for where that shows.
pub(super) fn each<T>(
    s: &Scene,
    parts: impl IntoIterator<Item = T>,
    change: impl Fn(&mut Scene, T) -> Option<String>,
) -> Vec<Slip> {
    let changed = |part| {
        let mut scene = s.clone();
        let place = change(&mut scene, part)?;
        Some(slip(scene, place))
    };
    parts.into_iter().filter_map(changed).collect()
}

/// Where a contact is, in words.
pub(super) fn at(s: &Scene, contact: usize) -> String {
    format!("at {}", s.contacts[contact].name)
}

/// Whose a quantity of a body is, in words.
pub(super) fn of(s: &Scene, body: usize) -> String {
    format!("of {}", s.bodies[body].name)
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

/// Contacts without friction at which bodies strike: strings pull along themselves, and a support is at rest on what it bears.
pub(super) fn struck(s: &Scene) -> impl Iterator<Item = usize> + '_ {
    let strikes = |c: &usize| {
        let contact = &s.contacts[*c];
        let comes_in = contact.relative_velocity(s);
        !contact.is_string && !comes_in.iter().all(Expr::is_zero)
    };
    frictionless(s).filter(strikes)
}

pub(super) fn sticking(s: &Scene) -> impl Iterator<Item = usize> + '_ {
    (0..s.contacts.len()).filter(|c| s.contacts[*c].law == ContactLaw::Sticking)
}

/// The points at which something acts on a body, with names.
pub(super) fn places(s: &Scene, b: usize) -> Vec<(Vector, String)> {
    let own = s.acting().filter(|one| one.bodies.contains(&b));
    own.map(|one| (one.at.clone(), one.name.clone())).collect()
}

/// Every point about which somebody might take moments.
pub(super) fn all_places(s: &Scene) -> Vec<(Vector, String)> {
    let points = s.points.iter().map(|p| (&p.at, p.name.clone()));
    let center = |b: usize| (&s.bodies[b].center, format!("the center {}", of(s, b)));
    let others = s.acting().map(|one| (one.at, one.name.clone()));
    let mut all: Vec<(Vector, String)> = Vec::new();
    for (at, name) in points.chain(movable(s).map(center)).chain(others) {
        if !all.iter().any(|(known, _)| known == at) {
            all.push((at.clone(), name));
        }
    }
    all.truncate(8);
    all
}

/// The places of bodies and of what acts on them.
pub(super) fn positions(s: &mut Scene) -> impl Iterator<Item = &mut Vector> {
    let bodies = s.bodies.iter_mut().map(|b| &mut b.center);
    let contacts = s.contacts.iter_mut().map(|c| &mut c.at);
    let hinges = s.hinges.iter_mut().map(|h| &mut h.at);
    let blows = s.blows.iter_mut().map(|p| &mut p.at);
    bodies.chain(contacts).chain(hinges).chain(blows)
}

pub(super) type Inertias<'a> = &'a dyn Fn(&Scene, usize) -> Vec<(Expr, String)>;

/// Slips that give one body another moment of inertia.
pub(super) fn inertia(s: &Scene, others: Inertias) -> Vec<Slip> {
    let all = rigid(s).flat_map(|b| others(s, b).into_iter().map(move |other| (b, other)));
    let other = all.filter(|(b, (value, _))| *value != s.bodies[*b].inertia);
    each(s, other, |scene, (b, (value, place))| {
        scene.bodies[b].inertia = value;
        Some(format!("{} {place}", of(s, b)).trim_end().to_string())
    })
}

/// I + k m r² for every point at which something acts, with r from the center to it.
pub(super) fn about_places(s: &Scene, b: usize, k: i64) -> Vec<(Expr, String)> {
    let shifted = |(at, name): (Vector, String)| {
        let r = minus(&at, &s.bodies[b].center);
        let k = Expr::from(k);
        let value = &s.bodies[b].inertia + &(k * &s.bodies[b].mass * dot(&r, &r));
        (value, format!("about {name}"))
    };
    places(s, b).into_iter().map(shifted).collect()
}

/// Moments of inertia a student might look up in place of the right one.
pub(in crate::grade) fn other_shapes(s: &Scene, b: usize) -> Vec<(Expr, String)> {
    let m = &s.bodies[b].mass;
    let of = |n: i64, d: i64, square: &Expr, words: &str| {
        let value = Expr::ratio(n, d) * m * square.powi(2);
        (value, format!("as if {words}"))
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
            of(1, 4, length, "all mass at both ends"),
            of(1, 6, length, "twice as much"),
            of(1, 24, length, "half as much"),
        ],
        Shape::Rectangle { width, height } => {
            let sum = |n: i64, d: i64, words: &str| {
                let value = Expr::ratio(n, d) * m * (width.powi(2) + height.powi(2));
                (value, format!("as if {words}"))
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
    each(s, frictionless(s), |scene, c| {
        let ContactLaw::Frictionless { restitution } = &mut scene.contacts[c].law else {
            return None;
        };
        let value = other(restitution);
        if value == *restitution {
            return None;
        }
        *restitution = value;
        Some(at(s, c))
    })
}

pub(super) fn velocities(s: &Scene, other: &dyn Fn(&Vector) -> Vector) -> Vec<Slip> {
    let moves = |b: &usize| s.bodies[*b].velocity.iter().any(|v| !v.is_zero());
    each(s, (0..s.bodies.len()).filter(moves), |scene, b| {
        scene.bodies[b].velocity = other(&s.bodies[b].velocity);
        Some(of(s, b))
    })
}

/// A parameter that is a length, doubled or halved: in the inertia alone, in the positions alone, and everywhere.
pub(super) fn lengths(s: &Scene) -> Vec<Slip> {
    let meter = Dimension::new(0, 1, 0);
    let lengths = s.parameters.iter().filter(|p| p.dimension == meter);
    let each_twice = lengths.flat_map(|p| {
        let twice = (p, Expr::from(2), "twice");
        [twice, (p, Expr::ratio(1, 2), "half")]
    });
    let all = each_twice.flat_map(|(p, k, words)| {
        let value = Expr::symbol(&p.name) * k;
        let where_put = [
            (true, false, "in the moment of inertia"),
            (false, true, "in the positions"),
            (true, true, "everywhere"),
        ];
        where_put.map(|put| (p, value.clone(), words, put))
    });
    each(
        s,
        all,
        |scene, (p, value, words, (inertia, arms, place))| {
            let put = |e: &Expr| e.put(&p.name, &value);
            for body in scene.bodies.iter_mut().filter(|_| inertia) {
                body.inertia = put(&body.inertia);
            }
            for at in positions(scene).filter(|_| arms) {
                *at = at.each_ref().map(put);
            }
            Some(format!("{words} {} {place}", p.name))
        },
    )
}

/// Every body that turns, with another spin before.
pub(super) fn spins(s: &Scene, other: &dyn Fn(&Expr) -> Expr) -> Vec<Slip> {
    let turns = |b: &usize| !s.bodies[*b].spin.is_zero();
    each(s, (0..s.bodies.len()).filter(turns), |scene, b| {
        scene.bodies[b].spin = other(&s.bodies[b].spin);
        Some(of(s, b))
    })
}
