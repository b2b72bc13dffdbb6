//! Scenes by hand, for tests of the numeric side.

use crate::expr::{Expr, Rational, Vector};
use crate::scene::{
    Blow, BlowImpulse, Body, Contact, ContactLaw, Hinge, Known, KnownQuantity, Scene, Shape,
};

pub fn n(value: i64) -> Expr {
    Expr::from(value)
}

pub fn q(numerator: i64, denominator: i64) -> Expr {
    Expr::ratio(numerator, denominator)
}

pub fn exact(v: &[Rational; 2]) -> Vector {
    [Expr::from(v[0].clone()), Expr::from(v[1].clone())]
}

pub fn at(x: i64, y: i64) -> Vector {
    [n(x), n(y)]
}

pub fn s(name: &str) -> Expr {
    Expr::symbol(name)
}

pub fn body(
    name: &str,
    shape: Shape,
    mass: Expr,
    inertia: Expr,
    center: Vector,
    velocity: Vector,
    spin: Expr,
) -> Body {
    Body {
        name: name.into(),
        shape,
        mass,
        inertia,
        inertia_given: false,
        center,
        angle: n(0),
        velocity,
        spin,
    }
}

pub fn ground() -> Body {
    body("ground", Shape::Fixed, n(0), n(0), at(0, 0), at(0, 0), n(0))
}

pub fn particle(mass: Expr, center: Vector, velocity: Vector) -> Body {
    body(
        "particle",
        Shape::Particle,
        mass,
        n(0),
        center,
        velocity,
        n(0),
    )
}

pub fn rigid(mass: Expr, inertia: Expr, center: Vector, velocity: Vector, spin: Expr) -> Body {
    body("body", Shape::Other, mass, inertia, center, velocity, spin)
}

/// A rod with I = m l²/12.
pub fn rod(mass: Expr, length: Expr, center: Vector, velocity: Vector, spin: Expr) -> Body {
    let inertia = &mass * &length.powi(2) * q(1, 12);
    body(
        "rod",
        Shape::Rod { length },
        mass,
        inertia,
        center,
        velocity,
        spin,
    )
}

pub fn hinge(one: usize, two: usize, place: Vector) -> Hinge {
    Hinge {
        name: "H".into(),
        bodies: [one, two],
        at: place,
    }
}

pub fn sticks(one: usize, two: usize, place: Vector, normal: Option<Vector>) -> Contact {
    Contact {
        name: "C".into(),
        bodies: [one, two],
        at: place,
        normal,
        law: ContactLaw::Sticking,
        passes: false,
        is_string: false,
    }
}

pub fn bounces(
    one: usize,
    two: usize,
    place: Vector,
    normal: Vector,
    restitution: Expr,
) -> Contact {
    let law = ContactLaw::Frictionless { restitution };
    Contact {
        name: "C".into(),
        bodies: [one, two],
        at: place,
        normal: Some(normal),
        law,
        passes: false,
        is_string: false,
    }
}

pub fn blow(on: usize, place: Vector, impulse: Vector) -> Blow {
    Blow {
        name: "Q".into(),
        body: on,
        at: place,
        impulse: BlowImpulse::Given(impulse),
    }
}

pub fn known_velocity(on: usize, place: Vector, along: Vector, value: Expr) -> Known {
    Known {
        name: String::new(),
        body: on,
        what: KnownQuantity::Velocity {
            at: place,
            along,
            to: None,
        },
        value,
    }
}

pub fn scene(bodies: Vec<Body>, hinges: Vec<Hinge>, contacts: Vec<Contact>) -> Scene {
    Scene {
        bodies,
        hinges,
        contacts,
        ..Scene::default()
    }
}

/// A chain of `count` equal rods along x, each of mass 1 and length 1, the first hinged to the ground at the origin if
/// `pinned`, hit across by a unit impulse at the last end. Ground is body 0.
pub fn chain(count: usize, pinned: bool) -> Scene {
    let mut bodies = vec![ground()];
    let mut hinges = Vec::new();
    for i in 0..count as i64 {
        bodies.push(rod(n(1), n(1), [q(2 * i + 1, 2), n(0)], at(0, 0), n(0)));
        if i > 0 || pinned {
            hinges.push(hinge(i as usize, i as usize + 1, at(i, 0)));
        }
    }
    let mut scene = scene(bodies, hinges, Vec::new());
    scene.blows.push(blow(count, at(count as i64, 0), at(0, 1)));
    scene
}

/// Sample 17.32: a spinning disk hits a plate, frictionless, e = 1. The contact point A is the origin.
pub fn flying_dish() -> Scene {
    let disk = body(
        "D",
        Shape::Disk { radius: q(1, 4) },
        n(1),
        q(1, 32),
        [q(-1, 4), n(0)],
        at(1, 0),
        n(-5),
    );
    let shape = Shape::Rectangle {
        width: n(2),
        height: n(1),
    };
    let plate = body(
        "P",
        shape,
        n(2),
        q(5, 6),
        [q(1, 2), q(-4, 5)],
        at(-10, 0),
        n(0),
    );
    scene(
        vec![disk, plate],
        vec![],
        vec![bounces(0, 1, at(0, 0), at(1, 0), n(1))],
    )
}
