//! Whether contacts lie on the bodies that touch there, as far as the scene tells their outlines.
//!
//! In: a scene whose bodies stand where they are at the impact, with the values it gives. Out: words for a contact that lies
//! off one of its bodies: at the given values, or whatever the parameters are. What depends on parameters without a value is
//! no fault; `verify` tells the condition. A contact that sticks may also lie inside a body, as a bullet does in a block or
//! an axle in a wheel, and so may one with neither law nor normal, as of a man who walks on a turntable seen from above; any
//! other can only touch from outside.

use std::collections::BTreeMap;

use super::fault::number_words;
use super::outline::{Need, Piece, Spot, distance, pieces};
use super::{Body, Contact, ContactLaw, Scene, Shape};
use crate::algebra::{Sign, sign};
use crate::domain::{Domains, roles, samples};
use crate::expr::{Expr, Point, Symbol, Vector, dot, minus};

/// A contact, a blow or a hinge that does not lie on one of its bodies.
#[derive(Clone, Debug, PartialEq)]
pub struct Misplaced {
    /// Index of the body.
    pub body: usize,
    /// Where it is, such as "the contact `C` is 3 m from the nearest point of `rod`".
    pub words: String,
    /// What to do about it.
    pub hint: String,
}

/// Whether something may lie inside the bodies at this contact, and not on their outlines alone.
pub fn may_lie_inside(contact: &Contact) -> bool {
    let is_free = contact.law == ContactLaw::None && contact.normal.is_none();
    sticks(contact) || contact.is_string || is_free
}

fn sticks(contact: &Contact) -> bool {
    contact.law == ContactLaw::Sticking
}

/// Whether two bodies stick at another contact before this one too: they are one body afterwards, and the second point only says so.
/// It may lie beside them: disks that are glued together touch in one point.
pub fn is_second_latch(scene: &Scene, contact: &Contact) -> bool {
    let same =
        |other: &Contact| sticks(other) && other.bodies.iter().all(|b| contact.bodies.contains(b));
    let mut first = scene.contacts.iter().take_while(|c| c.name != contact.name);
    sticks(contact) && first.any(same)
}

/// What has its place on a body, by its index.
#[derive(Clone, Copy)]
pub enum Placed {
    /// A contact, on both bodies.
    Contact(usize),
    /// A blow, on the body it strikes.
    Blow(usize),
    /// A hinge, on those of its bodies that are rods.
    Hinge(usize),
}

/// The contacts, blows and hinges that lie off their bodies.
pub fn misplaced(scene: &Scene) -> Vec<Misplaced> {
    let contacts = (0..scene.contacts.len()).map(Placed::Contact);
    let blows = (0..scene.blows.len()).map(Placed::Blow);
    let hinges = (0..scene.hinges.len()).map(Placed::Hinge);
    let all = contacts.chain(blows).chain(hinges);
    all.filter_map(|one| misplaced_one(scene, one)).collect()
}

/// The same for one of them. A blow may also go to the middle of a body, and a hinge may sit there; what is no rod may hang on
/// its hinge by a light arm.
pub fn misplaced_one(scene: &Scene, one: Placed) -> Option<Misplaced> {
    let (what, name, at, inside, bodies) = match one {
        Placed::Contact(i) => {
            let c = scene.contacts.get(i)?;
            let is_on = |b: &usize| {
                let is_off = |body| off(scene, (&c.at, true), body).is_some();
                scene
                    .bodies
                    .get(*b)
                    .is_some_and(|body| !body.is_fixed() && !is_off(body))
            };
            // A string leaves one of its bodies at its place and reaches the other along its line.
            if is_second_latch(scene, c) || c.is_string && c.bodies.iter().any(is_on) {
                return None;
            }
            (
                "contact",
                &c.name,
                &c.at,
                may_lie_inside(c),
                c.bodies.to_vec(),
            )
        }
        Placed::Blow(i) => {
            let blow = scene.blows.get(i)?;
            ("blow", &blow.name, &blow.at, true, vec![blow.body])
        }
        Placed::Hinge(i) => {
            let hinge = scene.hinges.get(i)?;
            let is_rod = |b: &usize| matches!(scene.bodies[*b].shape, Shape::Rod { .. });
            let rods = hinge.bodies.into_iter().filter(is_rod).collect();
            ("hinge", &hinge.name, &hinge.at, true, rods)
        }
    };
    bodies.iter().find_map(|&b| {
        let body = scene.bodies.get(b)?;
        let words = off(scene, (at, inside), body)?;
        if let [first, second] = bodies[..]
            && is_between(scene, at, [first, second])
        {
            let [a, b] = [first, second].map(|b| &scene.bodies[b].name);
            return Some(Misplaced {
                body: second,
                words: format!("`{a}` and `{b}` do not touch at the {what} `{name}`: their centers are not as far apart as their radii together"),
                hint: "move one of them until they touch".into(),
            });
        }
        Some(Misplaced {
            body: b,
            words: format!("the {what} `{name}` {words}"),
            hint: hint(body),
        })
    })
}

/// Whether a place divides the line between the centers of two round bodies as their radii do, as where it was found so.
fn is_between(scene: &Scene, at: &Vector, bodies: [usize; 2]) -> bool {
    let [a, b] = bodies.map(|b| &scene.bodies[b]);
    let [Some(of_a), Some(of_b)] = [a, b].map(|body| body.shape.radius()) else {
        return false;
    };
    let [to_a, to_b] = [a, b].map(|body| minus(at, &body.center));
    let mut parts = to_a.iter().zip(&to_b).map(|(x, y)| x * of_b + y * of_a);
    parts.all(|e| sign(&e, &scene.domains) == Some(Sign::Zero))
}

/// How a place lies off a body, if it does for certain; whether it may lie inside is told with it.
fn off(scene: &Scene, (at, inside): (&Vector, bool), body: &Body) -> Option<String> {
    // Where a particle is touched elsewhere, that has its own words.
    if body.is_particle() {
        return None;
    }
    if let Some(distance) = distance(body, at, inside, &scene.given()) {
        return (distance > 0.0).then(|| away(distance, &body.name));
    }
    let spots: Vec<Spot> = spots(body, at, inside);
    if spots.iter().any(|spot| is_met(spot, scene)) {
        return None;
    }
    let given: BTreeMap<Symbol, Expr> = scene.values();
    let nowhere = |spot: &Spot| {
        let mut needs = spot.needs.iter();
        needs.any(|need| is_refuted(need, &given, &scene.domains))
    };
    let is_far = |e: &Expr| sign(&e.substitute(&given), &scene.domains) == Some(Sign::Negative);
    let is_off = !spots.is_empty() && spots.iter().all(nowhere);
    // What is round is looked at where the impact is judged.
    let is_far = body.shape.radius().is_none() && reach(body, at).iter().any(is_far);
    if !is_off && !is_far {
        return None;
    }
    let seen = example(&spots, &given, &scene.domains, |point| {
        distance(body, at, inside, point).filter(|d| *d > 0.0)
    });
    let seen = seen.map_or(String::new(), |(distance, words)| {
        format!("; at {words} it {}", away(distance, &body.name))
    });
    Some(format!(
        "is not on `{}`, whatever the parameters{seen}",
        body.name
    ))
}

/// All spots of a body at which a point may lie.
pub fn spots(body: &Body, at: &Vector, inside: bool) -> Vec<Spot> {
    let pieces = pieces(body);
    pieces.iter().flat_map(|p| p.spots(at, inside)).collect()
}

/// What is below zero where a point lies too far from a body of one piece: for one that is round r² − x² and r² − y², for others
/// the square of what it reaches from its middle, less that of the distance.
pub fn reach(body: &Body, at: &Vector) -> Vec<Expr> {
    let around = |middle: &Vector, reach: Expr| {
        let to = minus(at, middle);
        vec![reach - dot(&to, &to)]
    };
    match pieces(body).as_slice() {
        [Piece::Round { center, radius, .. }] => minus(at, center)
            .map(|part| radius.powi(2) - part.powi(2))
            .to_vec(),
        [
            Piece::Straight {
                middle,
                half,
                square,
                ..
            },
        ] => around(middle, half.powi(2) * square),
        [
            Piece::Rectangle {
                middle,
                half: [a, b],
                ..
            },
        ] => around(middle, a.powi(2) + b.powi(2)),
        _ => Vec::new(),
    }
}

fn away(distance: f64, body: &str) -> String {
    let distance = number_words(distance);
    format!("is {distance} m from the nearest point of `{body}`")
}

/// Whether a spot fits at one point of the domain, as far as doubles tell: then it is not off whatever the parameters are.
fn is_met(spot: &Spot, scene: &Scene) -> bool {
    let mut point = scene.generic_point();
    point.values.extend(scene.given().values);
    let value = |e: &Expr| e.evaluate(&point).unwrap_or(f64::NAN);
    let mut relations = scene.domains.relations.iter();
    let is_inside = relations.all(|r| value(&r.excess) > 0.0);
    is_inside
        && spot.needs.iter().all(|need| match need {
            Need::Zero(e) => value(e).abs() < ROUNDING,
            Need::NotNegative(e) => value(e) > -ROUNDING,
        })
}

/// What roundings leave of zero where values are of ordinary size.
const ROUNDING: f64 = 1e-13;

/// Whether what must hold fails on the whole domain.
fn is_refuted(need: &Need, given: &BTreeMap<Symbol, Expr>, domains: &Domains) -> bool {
    match need {
        Need::Zero(e) if e.is_zero() => false,
        Need::Zero(e) => matches!(
            sign(&e.substitute(given), domains),
            Some(Sign::Positive | Sign::Negative)
        ),
        Need::NotNegative(e) => sign(&e.substitute(given), domains) == Some(Sign::Negative),
    }
}

/// The first point of the domain at which `look` finds something, with the point in words.
fn example(
    spots: &[Spot],
    given: &BTreeMap<Symbol, Expr>,
    domains: &Domains,
    look: impl Fn(&Point<f64>) -> Option<f64>,
) -> Option<(f64, String)> {
    let needs = spots.iter().flat_map(|s| &s.needs).map(|need| match need {
        Need::Zero(e) | Need::NotNegative(e) => e.clone(),
    });
    let all: Vec<Expr> = needs.collect();
    let roles = roles(&all.iter().collect::<Vec<_>>());
    let (domains, _) = domains.completed(&roles);
    samples(&roles, &domains, 4).iter().find_map(|sample| {
        let mut doubles = sample.doubles();
        // What is given stays as it is given; the sample stands for the rest.
        for (name, value) in given {
            doubles
                .values
                .insert(name.clone(), value.evaluate(&Point::default())?);
        }
        let mut told = sample.clone();
        told.coordinates.retain(|name, _| !given.contains_key(name));
        Some((look(&doubles)?, told.words()))
    })
}

fn hint(body: &Body) -> String {
    let outline = match body.shape {
        Shape::Rod { .. } => {
            "reaches half its `length` from its `center` to either side, along its `angle` (0 is level, \"pi/2\" upright)"
        }
        Shape::Rectangle { .. } => {
            "reaches half its `width` from its `center` along `angle`, and half its `height` across"
        }
        Shape::Composite { .. } => {
            "consists of its parts and of straight bars between their centers"
        }
        _ => "reaches its `radius` from its `center`",
    };
    format!(
        "`{}` {outline}; a body of unknown outline has the shape \"body\"",
        body.name
    )
}
