//! Whether a scene is consistent: what its formulas claim, tried at exact points of the domain and at the given values.
//!
//! In: a scene and the claims collected while it was put together. Out: faults, and remarks that are none. A claim is
//! refused only where a point refutes it; what cannot be tried here is left to the layers that prove.

use super::fault::{Fault, Span};
use super::parameters::{is_negative, number_words};
use super::sample::{self, vanishes};
use super::{Body, Contact, Hinge, Scene, geometry};
use crate::expr::number::to_f64;
use crate::expr::{Expr, Point, Rational, Symbol, Vector, dot, minus};

/// Something a scene relies on.
pub(super) enum Claim {
    /// A unit vector.
    Unit(Vector),
    /// A number from 0 to 1.
    Fraction(Expr),
    /// A mass, length or inertia is positive.
    Size {
        size: Expr,
        what: &'static str,
        may_vanish: bool,
    },
    /// What touches a particle touches it where it is.
    AtParticle {
        offset: Vector,
        at: String,
        body: usize,
    },
    /// The bodies of this contact approach at the given values.
    Approach(usize),
    /// Both bodies of this hinge move alike there.
    Hinge(usize),
}

/// A claim and the place in the file that makes it.
pub(super) struct Claimed {
    pub span: Span,
    pub claim: Claim,
}

type Points = [(Point<Rational>, Point<f64>)];

/// Tries every claim.
pub(super) fn check(scene: &Scene, claims: &[Claimed]) -> Vec<Fault> {
    if claims.is_empty() {
        return Vec::new();
    }
    let points = sample::points(scene);
    let given = sample::given(scene);
    claims
        .iter()
        .filter_map(|c| try_claim(scene, c, &points, given.as_ref()))
        .collect()
}

fn try_claim(
    scene: &Scene,
    claimed: &Claimed,
    points: &Points,
    given: Option<&Point<f64>>,
) -> Option<Fault> {
    let fault = |message: String| Fault::new(claimed.span, message);
    match &claimed.claim {
        Claim::Unit(vector) => {
            let excess = dot(vector, vector) - Expr::one();
            (vanishes(&excess, points) == Some(false)).then(|| {
                let length = match (vector[0].as_number(), vector[1].as_number()) {
                    (Some(x), Some(y)) => format!(" but {}", number_words(to_f64(x).hypot(to_f64(y)))),
                    _ => String::new(),
                };
                fault(format!("a direction has length 1, not this{length}")
                    .replace("not this but", "not"))
                .hint("divide by its length, give an {\"angle\": …}, or declare its components under \"unit_vectors\"")
            })
        }
        Claim::Fraction(e) => {
            let wrong = out_of_range(e, points, given, |v| !(0.0..=1.0).contains(&v))?;
            let why = if e.as_number().is_some() {
                "it is".to_owned()
            } else {
                format!("it can be {}", number_words(wrong))
            };
            let message = match e.as_number() {
                Some(_) => format!(
                    "a restitution is from 0 to 1, and this is {}",
                    number_words(wrong)
                ),
                None => format!("a restitution is from 0 to 1, and in its domain {why}"),
            };
            Some(fault(message).hint(
                "0: no rebound, 1: no loss; for a symbol give \"domain\": {\"min\": 0, \"max\": 1}",
            ))
        }
        Claim::Size {
            size,
            what,
            may_vanish,
        } => {
            let wrong = out_of_range(size, points, given, |v| v < 0.0 || v == 0.0 && !may_vanish)?;
            let bound = if *may_vanish {
                "is not negative"
            } else {
                "is positive"
            };
            let now = match (size.as_number(), wrong == 0.0) {
                (_, true) => "this is 0".to_owned(),
                (Some(_), _) => format!("this is {}", number_words(wrong)),
                _ => format!("in its domain this can be {}", number_words(wrong)),
            };
            Some(
                fault(format!("a {what} {bound}, and {now}").replace("a inertia", "an inertia"))
                    .hint("change the value, or the `domain` of its parameters"),
            )
        }
        Claim::AtParticle { offset, at, body } => {
            let is_elsewhere = offset.iter().any(|c| vanishes(c, points) == Some(false));
            let name = &scene.bodies.get(*body)?.name;
            is_elsewhere.then(|| {
                fault(format!("`{at}` is not where the particle `{name}` is"))
                    .hint(format!("leave the particle's `center` out, or put it at {at}; a body with extension is a disk, a rod, …"))
            })
        }
        Claim::Approach(i) => {
            let speed = separation(scene, scene.contacts.get(*i)?)?.evaluate(given?)?;
            let noise = 1e-12 * speed_scale(scene, given?);
            (speed > noise).then(|| {
                fault(format!(
                    "the bodies separate at `{}`, at {} m/s along the normal: they do not collide",
                    scene.contacts[*i].name,
                    number_words(speed)
                ))
                .hint("the normal points out of the first body into the second; check the order of `bodies`, and the velocities")
            })
        }
        Claim::Hinge(i) => {
            let hinge = scene.hinges.get(*i)?;
            let gap = gap(scene, hinge);
            let moves_apart = gap.iter().any(|c| vanishes(c, points) == Some(false));
            let [a, b] = hinge.bodies.map(|b| &scene.bodies[b].name);
            moves_apart.then(|| {
                fault(format!("before the collision `{a}` and `{b}` move differently at the hinge `{}`", hinge.name))
                    .hint(format!("a body that turns about it has \"velocity\": {{\"about\": \"{}\"}} and a `spin`", hinge.name))
            })
        }
    }
}

/// A value of the expression that is wrong: at the given values, or at a point of the domain.
fn out_of_range(
    e: &Expr,
    points: &Points,
    given: Option<&Point<f64>>,
    is_wrong: impl Fn(f64) -> bool,
) -> Option<f64> {
    if let Some(number) = e.as_number() {
        let value = if is_negative(e) {
            to_f64(number).min(-f64::MIN_POSITIVE)
        } else {
            to_f64(number)
        };
        return is_wrong(value).then_some(value);
    }
    let at_given = given.and_then(|at| e.evaluate(at)).filter(|v| is_wrong(*v));
    at_given.or_else(|| {
        points
            .iter()
            .filter_map(|(_, at)| e.evaluate(at))
            .find(|v| is_wrong(*v))
    })
}

/// The fault that the values now given bring about at a contact, if there is one.
pub(super) fn at_values(scene: &Scene, span: Span) -> Option<Fault> {
    let given = sample::given(scene)?;
    let contacts = (0..scene.contacts.len()).map(|i| Claimed {
        span,
        claim: Claim::Approach(i),
    });
    let given_vectors = scene.domains.unit_vectors.iter().filter_map(|pair| {
        let value = |name: &Symbol| {
            scene
                .parameters
                .iter()
                .find(|p| p.name == *name)
                .and_then(|p| p.value.clone())
        };
        Some(Claimed {
            span,
            claim: Claim::Unit([value(&pair[0])?, value(&pair[1])?]),
        })
    });
    let claims: Vec<Claimed> = given_vectors.chain(contacts).collect();
    claims.iter().find_map(|c| {
        try_claim(
            scene,
            c,
            &[(Point::default(), Point::default())],
            Some(&given),
        )
    })
}

/// Velocity just before of the point of a body at a position.
fn velocity_at(body: &Body, at: &Vector) -> Vector {
    if body.is_particle() {
        return body.velocity.clone();
    }
    let turn = geometry::turned(&body.spin, &minus(at, &body.center));
    [&body.velocity[0] + &turn[0], &body.velocity[1] + &turn[1]]
}

/// Normal relative velocity u_n⁻ just before [m/s]; positive where the bodies separate.
pub(super) fn separation(scene: &Scene, contact: &Contact) -> Option<Expr> {
    let [a, b] = contact.bodies.map(|i| scene.bodies.get(i));
    let relative = minus(&velocity_at(b?, &contact.at), &velocity_at(a?, &contact.at));
    Some(dot(&relative, contact.normal.as_ref()?))
}

/// Relative velocity at a hinge just before.
fn gap(scene: &Scene, hinge: &Hinge) -> Vector {
    let [a, b] = hinge
        .bodies
        .map(|i| velocity_at(&scene.bodies[i], &hinge.at));
    minus(&b, &a)
}

/// The largest speed in the scene, as a measure of rounding.
fn speed_scale(scene: &Scene, at: &Point<f64>) -> f64 {
    let components = scene.bodies.iter().flat_map(|b| &b.velocity);
    components
        .filter_map(|v| v.evaluate(at))
        .fold(0.0, |m: f64, v| m.max(v.abs()))
}

/// Remarks on what a scene declares without need.
pub(super) fn unused(scene: &Scene, is_used: impl Fn(&str) -> bool) -> Vec<String> {
    let idle = scene.parameters.iter().filter(|p| !is_used(&p.name));
    idle.map(|p| format!("the parameter `{}` is not used in this scene", p.name))
        .collect()
}
