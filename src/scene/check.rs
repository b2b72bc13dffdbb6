//! Whether a scene is consistent: what its formulas claim, decided on the whole domain and tried at the given values.
//!
//! In: a scene and the claims collected while it was put together. Out: faults, and remarks on what could not be decided.
//! A claim is refused only where it is refuted.

use super::claim::{Claim, Claimed};
use super::fault::number_words;
use super::fault::{Fault, Span};
use super::proof::{Given, Zero, middle, violation, zero};
use super::touch::Placed;
use super::{ALONE, Ask, Contact, ContactLaw, Hinge, Scene, beside_friction, touch};
use crate::algebra::{Sign, sign};
use crate::expr::{Expr, Function, Node, Symbol, Vector, dot, minus};
use crate::interval::{Interval, Outcome, evaluate};

/// Tries every claim; what cannot be decided becomes a remark of the scene.
pub(super) fn check(scene: &mut Scene, claims: &[Claimed]) -> Vec<Fault> {
    let mut faults = Vec::new();
    let given = scene.given();
    for claimed in claims {
        // Where a size or a place is wrong, so is the outline.
        if matches!(claimed.claim, Claim::Placed(_)) && !faults.is_empty() {
            continue;
        }
        let (fault, remark) = try_claim(scene, claimed, &given);
        faults.extend(fault);
        scene.remarks.extend(remark);
    }
    faults
}

/// The fault that the values now given bring about, if there is one.
pub(super) fn at_values(scene: &Scene, span: Span) -> Option<Fault> {
    let unit_vectors = scene.domains.unit_vectors.iter().filter_map(|pair| {
        let value = |name: &Symbol| {
            let parameter = scene.parameter(name)?;
            parameter.value.clone()
        };
        let claim = Claim::Unit([value(&pair[0])?, value(&pair[1])?]);
        Some(Claimed { span, claim })
    });
    let contacts = 0..scene.contacts.len();
    let contacts = contacts.flat_map(|i| [Claim::Placed(Placed::Contact(i)), Claim::Approach(i)]);
    let blows = (0..scene.blows.len()).map(Placed::Blow);
    let hinges = (0..scene.hinges.len()).map(Placed::Hinge);
    let places = blows.chain(hinges).map(Claim::Placed);
    let approaches = contacts.chain(places).map(|claim| Claimed { span, claim });
    let given = scene.given();
    let turns = scene.questions.iter().filter_map(|q| match &q.ask {
        Ask::Turn { number, .. } => Some(Claim::Whole(number.clone())),
        _ => None,
    });
    unit_vectors
        .chain(approaches)
        .chain(turns.map(|claim| Claimed { span, claim }))
        .find_map(|claimed| try_claim(scene, &claimed, &given).0)
}

/// What is found of a claim.
enum Tried {
    /// Nothing speaks against it.
    Holds,
    /// It is wrong: what is wrong, and what to do about it.
    Refuted(String, String),
    /// It could not be decided, in a sentence.
    Undecided(String),
}

/// A fault if the claim is refuted, a remark if it stays open.
fn try_claim(scene: &Scene, claimed: &Claimed, given: &Given) -> (Option<Fault>, Option<String>) {
    let tried = match &claimed.claim {
        Claim::Unit(vector) => unit(scene, vector),
        Claim::Fraction(e) if e.as_symbol().is_some_and(|name| is_within_one(name, scene)) => {
            Tried::Holds
        }
        Claim::Fraction(e) => bounded(
            violation(e, scene, given, |v| v.high < 0.0 || v.low > 1.0),
            "a restitution is from 0 to 1",
            "0: no rebound, 1: no loss; for a symbol give \"domain\": {\"min\": 0, \"max\": 1}",
        ),
        Claim::Whole(name) => {
            let parameter = scene.parameter(name);
            let value = parameter.and_then(|p| p.value.as_ref());
            match value.and_then(Expr::as_number).filter(|n| !n.is_integer()) {
                None => Tried::Holds,
                Some(value) => Tried::Refuted(
                    format!("`{name}` counts turns, and {value} is no whole number"),
                    String::from("give it a value such as 3, or none"),
                ),
            }
        }
        Claim::Friction(mu) => bounded(
            violation(mu, scene, given, |v| v.high < 0.0),
            "a coefficient of friction is not negative",
            "friction opposes the slip by itself, whichever way it goes; change the value, or the `domain` of its parameters",
        ),
        Claim::Gravity(g) => bounded(
            violation(g, scene, given, |v| v.high < 0.0),
            "gravity is told by its size, which is not negative",
            "it draws down, along -y, by itself: leave out the minus sign",
        ),
        Claim::Tangential(e) => bounded(
            violation(e, scene, given, |v| v.high < -1.0 || v.low > 1.0),
            "a tangential restitution is from -1 to 1",
            "-1: no friction, 0: no slip after, 1: the slip is turned round",
        ),
        Claim::Size {
            size, may_vanish, ..
        } if is_positive(size, scene) || *may_vanish && size.is_zero() => Tried::Holds,
        Claim::Size {
            size,
            what,
            may_vanish,
        } => {
            let is_zero = |v: &Interval| v.low == 0.0 && v.high == 0.0;
            let is_wrong = |v: &Interval| v.high < 0.0 || !may_vanish && is_zero(v);
            let bound = if *may_vanish {
                "is not negative"
            } else {
                "is positive"
            };
            bounded(
                violation(size, scene, given, is_wrong),
                &format!("{what} {bound}"),
                "change the value, or the `domain` of its parameters",
            )
        }
        Claim::AtParticle { offset, at, body } => at_particle(scene, offset, at, *body),
        Claim::Rests(i) => rests(scene, *i),
        Claim::Approach(i) => return (approach(scene, *i, given, claimed.span), None),
        Claim::Placed(one) => touch::misplaced_one(scene, *one)
            .map_or(Tried::Holds, |off| Tried::Refuted(off.words, off.hint)),
        Claim::Hinge(i) => scene
            .hinges
            .get(*i)
            .map_or(Tried::Holds, |hinge| hinged(scene, hinge)),
    };
    match tried {
        Tried::Holds => (None, None),
        Tried::Refuted(message, hint) => (Some(Fault::new(claimed.span, message).hint(hint)), None),
        Tried::Undecided(remark) => (None, Some(remark)),
    }
}

/// A number within its bounds, unless it is seen outside.
fn bounded(violation: Option<(f64, String)>, bound: &str, hint: &str) -> Tried {
    let Some((value, point)) = violation else {
        return Tried::Holds;
    };
    let message = format!("{bound}, and this is {}{}", number_words(value), at(&point));
    Tried::Refuted(message, hint.into())
}

/// Whether a direction has length 1.
fn unit(scene: &Scene, vector: &Vector) -> Tried {
    if is_cosine_and_sine(vector) || is_declared_unit(vector, scene) {
        return Tried::Holds;
    }
    match zero(&(dot(vector, vector) - Expr::one()), &scene.domains) {
        Zero::Yes => Tried::Holds,
        Zero::No(point) => {
            let message = format!("a direction has length 1, and this has not{}", at(&point));
            let hint = "divide by its length, give {\"angle\": …}, or declare its components under \"unit_vectors\"";
            Tried::Refuted(message, hint.into())
        }
        Zero::Unknown => {
            Tried::Undecided("whether a direction has length 1 could not be decided".into())
        }
    }
}

/// Whether what touches a particle touches it where it is.
fn at_particle(scene: &Scene, offset: &Vector, place: &str, body: usize) -> Tried {
    let is_elsewhere = |c: &Expr| matches!(zero(c, &scene.domains), Zero::No(_));
    if !offset.iter().any(is_elsewhere) {
        return Tried::Holds;
    }
    let name = scene.bodies.get(body).map_or("", |b| &b.name);
    let message = format!("`{place}` is not where the particle `{name}` is");
    let hint = "leave the particle's `center` out, or put it there; a body with extension is a disk, a rod, …";
    Tried::Refuted(message, hint.into())
}

/// Whether the bodies of a contact beside one with friction do not strike.
fn rests(scene: &Scene, contact: usize) -> Tried {
    let strikes = |e: &Expr| !matches!(zero(e, &scene.domains), Zero::Yes);
    let friction = scene.friction().map(|(f, _)| &scene.contacts[f].name);
    match friction {
        Some(friction) if scene.strikes(contact).iter().any(strikes) => {
            let message = beside_friction(&scene.contacts[contact].name, friction);
            Tried::Refuted(message, ALONE.into())
        }
        _ => Tried::Holds,
    }
}

/// Whether both bodies of a hinge move alike there.
fn hinged(scene: &Scene, hinge: &Hinge) -> Tried {
    let name = &hinge.name;
    for component in gap(scene, hinge) {
        match zero(&component, &scene.domains) {
            Zero::Yes => {}
            Zero::No(point) => {
                let [a, b] = hinge.bodies.map(|b| &scene.bodies[b].name);
                let message = format!(
                    "before the collision `{a}` and `{b}` move differently at the hinge `{name}`{}",
                    at(&point)
                );
                let hint = "with `velocity` left out, a body with its `spin` moves as its hinges do; a point that is caught in the collision is a contact, \"law\": \"sticking\"";
                return Tried::Refuted(message, hint.into());
            }
            Zero::Unknown => {
                let remark = format!(
                    "whether the bodies move alike at the hinge `{name}` could not be decided"
                );
                return Tried::Undecided(remark);
            }
        }
    }
    Tried::Holds
}

/// The point at which something was seen, as the end of a sentence.
fn at(point: &str) -> String {
    if point.is_empty() {
        String::new()
    } else {
        format!(" at {point}")
    }
}

/// Whether the bodies of a contact separate, at the given values or at any.
fn approach(scene: &Scene, i: usize, given: &Given, span: Span) -> Option<Fault> {
    let contact = scene.contacts.get(i)?;
    let speed = separation(scene, contact)?;
    let name = &contact.name;
    // Beside another contact that collides, what parts may be driven in all the same.
    let collides = |other: &Contact| {
        let speed = separation(scene, other);
        speed.is_some_and(|speed| match evaluate::<Interval>(&speed, given) {
            Outcome::Value(value) => value.high < 0.0,
            _ => sign(&speed, &scene.domains) == Some(Sign::Negative),
        })
    };
    let is_plain = |c: &Contact| matches!(c.law, ContactLaw::Frictionless { .. });
    if scene.contacts.iter().all(is_plain) && scene.contacts.iter().any(collides) {
        return None;
    }
    let hint = "the normal points out of the first body into the second; check the order of `bodies`, and the velocities";
    if let Outcome::Value(value) = evaluate::<Interval>(&speed, given) {
        if value.low <= 0.0 {
            return None;
        }
        let speed = number_words(middle(&value));
        let message = format!(
            "the bodies separate at `{name}`, at {speed} m/s along the normal: they do not collide"
        );
        return Some(Fault::new(span, message).hint(hint));
    }
    (sign(&speed, &scene.domains) == Some(Sign::Positive)).then(|| {
        let message = format!(
            "the bodies separate at `{name}`, whatever the parameters: they do not collide"
        );
        Fault::new(span, message).hint(hint)
    })
}

/// Whether a vector is (cos φ, ± sin φ), or the same with its components exchanged or negated.
fn is_cosine_and_sine(vector: &Vector) -> bool {
    let split = |e: &Expr| {
        let (factor, rest) = e.split_number();
        let is_sign = factor.is_integer() && factor.numer().as_i64().is_some_and(|k| k.abs() == 1);
        match rest.node() {
            Node::Call(f @ (Function::Sin | Function::Cos), argument) if is_sign => {
                Some((*f, argument.clone()))
            }
            _ => None,
        }
    };
    let is_unit = |e: &Expr| {
        e.as_number()
            .is_some_and(|k| k.is_integer() && k.numer().as_i64().is_some_and(|k| k.abs() == 1))
    };
    match vector {
        [a, b] if a.is_zero() => is_unit(b),
        [a, b] if b.is_zero() => is_unit(a),
        [a, b] => match (split(a), split(b)) {
            (Some((f, x)), Some((g, y))) => f != g && x == y,
            _ => false,
        },
    }
}

fn is_declared_unit(vector: &Vector, scene: &Scene) -> bool {
    let names = vector.each_ref().map(|e| e.as_symbol());
    let is_pair = |[x, y]: &[Symbol; 2]| names == [Some(x), Some(y)] || names == [Some(y), Some(x)];
    scene.domains.unit_vectors.iter().any(is_pair)
}

/// Whether the domain of a symbol lies between 0 and 1.
fn is_within_one(name: &Symbol, scene: &Scene) -> bool {
    scene.domains.symbols.get(name).is_some_and(|domain| {
        let low = domain.low.as_ref().is_some_and(|l| l.approximate() >= 0.0);
        low && domain.high.as_ref().is_some_and(|h| h.approximate() <= 1.0)
    })
}

/// Whether it is a positive number times symbols that are positive on their domain: most sizes are.
fn is_positive(size: &Expr, scene: &Scene) -> bool {
    let is_positive_symbol = |name: &Symbol| {
        let low = scene.domains.symbols.get(name).and_then(|d| d.low.as_ref());
        low.is_some_and(|l| l.approximate() > 0.0 || l.approximate() == 0.0 && l.open)
    };
    match size.node() {
        Node::Number(value) => *value.numer() > 0.into(),
        Node::Symbol(name) => is_positive_symbol(name),
        Node::Sum(parts) | Node::Product(parts) => parts.iter().all(|p| is_positive(p, scene)),
        Node::Power(base, exponent) => exponent.as_number().is_some() && is_positive(base, scene),
        Node::Call(..) => false,
    }
}

/// Normal relative velocity u_n⁻ just before [m/s]; positive where the bodies separate.
fn separation(scene: &Scene, contact: &Contact) -> Option<Expr> {
    let known = contact.bodies.iter().all(|b| *b < scene.bodies.len());
    let normal = contact.normal.as_ref().filter(|_| known)?;
    Some(dot(&contact.relative_velocity(scene), normal))
}

/// Relative velocity at a hinge just before.
fn gap(scene: &Scene, hinge: &Hinge) -> Vector {
    let [a, b] = hinge.bodies.map(|i| scene.bodies[i].velocity_at(&hinge.at));
    minus(&b, &a)
}

/// Remarks on what a scene declares without need.
pub(super) fn unused(scene: &Scene, is_used: impl Fn(&str) -> bool) -> Vec<String> {
    let idle = scene.parameters.iter().filter(|p| !is_used(&p.name));
    idle.map(|p| format!("the parameter `{}` is not used in this scene", p.name))
        .collect()
}
