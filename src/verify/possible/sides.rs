//! Which way is out at a contact: the normals that the scene and the outlines give, and further points that touch.
//!
//! In: a scene and one of its contacts. Out: normals out of the first body into the second, and the ends of straight sides
//! that lie along each other. Nothing here knows of the motion after.

use super::decide::{self, sign};
use super::{Verdict, is_zero};
use crate::algebra::Sign;
use crate::domain::Domains;
use crate::expr::{Expr, Vector, cross, dot, minus};
use crate::scene::outline::{Need, Out, Piece, pieces};
use crate::scene::{Body, Contact, Scene, touch};

/// How the sense of a normal is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sense {
    /// It points out of the first body into the second.
    Out,
    /// Its line is known only; it points to where the second body comes from.
    ByApproach,
}

/// A normal at a contact, of any length.
#[derive(Clone, Debug)]
pub(super) struct Side {
    pub normal: Vector,
    pub sense: Sense,
    /// Whether the scene gives it.
    pub is_given: bool,
}

/// A further point at which the bodies touch.
#[derive(Clone, Debug)]
pub(super) struct Touching {
    pub at: Vector,
    pub normal: Vector,
    pub sense: Sense,
}

/// What is known of a contact's surroundings.
#[derive(Clone, Debug, Default)]
pub(super) struct Sides {
    pub list: Vec<Side>,
    /// Ends of straight sides that lie along each other.
    pub along: Vec<Touching>,
    /// Whether sides lie along each other and how far depends on the parameters.
    pub unsure: bool,
}

/// A side of a body on which the contact lies.
struct Face {
    out: Out,
    /// Whether the contact is at one of its ends.
    at_corner: bool,
}

/// The normals at a contact.
pub(super) fn of(scene: &Scene, contact: &Contact) -> Sides {
    let domains = &scene.domains;
    let mut sides = Sides::default();
    if let Some(normal) = &contact.normal {
        sides.list.push(Side {
            normal: normal.clone(),
            sense: Sense::Out,
            is_given: true,
        });
    }
    if contact.is_string {
        return sides;
    }
    let bodies = contact.bodies.map(|b| &scene.bodies[b]);
    let faces = bodies.map(|b| faces(b, contact, domains));
    let mut oriented: [Vec<(usize, Vector, Sense)>; 2] = [Vec::new(), Vec::new()];
    for (k, of_body) in faces.iter().enumerate() {
        for (index, face) in of_body.iter().enumerate() {
            let normal = if k == 0 {
                face.out.normal.clone()
            } else {
                negated(&face.out.normal)
            };
            let (normal, sense) = if face.out.either_side {
                orient(normal, k, contact, bodies, domains)
            } else {
                (normal, Sense::Out)
            };
            oriented[k].push((index, normal, sense));
        }
    }
    for (k, list) in oriented.iter().enumerate() {
        for (index, normal, sense) in list {
            let face = &faces[k][*index];
            if !face.at_corner && !known(&sides.list, normal, *sense, domains) {
                sides.list.push(Side {
                    normal: normal.clone(),
                    sense: *sense,
                    is_given: false,
                });
            }
        }
    }
    for (i, normal, sense) in &oriented[0] {
        for (j, other, other_sense) in &oriented[1] {
            // Of two normals the one whose sense is known is taken.
            let (normal, sense) = if *sense == Sense::Out {
                (normal, *sense)
            } else {
                (other, *other_sense)
            };
            along(
                &faces[0][*i],
                &faces[1][*j],
                normal,
                sense,
                domains,
                &mut sides,
            );
        }
    }
    sides
}

/// Why the outlines of two bodies that touch do not fit the contact, whatever happens there: they overlap, or the given normal
/// is none of theirs. `None` where nothing of that is proved.
///
/// Where an outline is smooth its own normal is the only one; at a corner all between those of the two sides are normals, at the
/// end of a rod all that lead away from it (normal cone: Glocker, "Set-Valued Force Laws", ch. 4).
pub(super) fn misfit(scene: &Scene, contact: &Contact) -> Option<String> {
    let domains = &scene.domains;
    let is_sure = |e: &Expr| sign(e, domains);
    let bodies = contact.bodies.map(|b| &scene.bodies[b]);
    let cones = bodies.map(|b| Cone::of(b, contact, domains));
    let is_across = |cone: &Cone, out: &Vector| {
        let mut off = cone.across.iter().map(|n| is_sure(&cross(n, out)));
        off.any(|s| matches!(s, Some(Sign::Positive | Sign::Negative)))
    };
    let excludes = |cone: &Cone, out: &Vector| {
        let mut within = cone.within.iter();
        is_across(cone, out) || within.any(|n| is_sure(&dot(n, out)) == Some(Sign::Negative))
    };
    let name = &contact.name;
    for (k, other) in [(0, 1), (1, 0)] {
        let mut smooth = cones[k].across.iter();
        // The other body is on the far side of a smooth outline; a thin rod has both sides free.
        let meets = smooth.any(|n| match cones[k].within.is_empty() {
            true => is_across(&cones[other], n),
            false => excludes(&cones[other], &negated(n)),
        });
        if meets {
            let [a, b] = bodies.map(|b| &b.name);
            return Some(format!("`{a}` and `{b}` overlap at `{name}`"));
        }
    }
    if let Some(normal) = &contact.normal {
        for (k, out) in [normal.clone(), negated(normal)].iter().enumerate() {
            // On a smooth outline a normal that is turned round is told as such.
            let is_turned = !cones[k].across.is_empty() && !is_across(&cones[k], out);
            if !is_turned && excludes(&cones[k], out) {
                let body = &bodies[k].name;
                return Some(format!(
                    "the normal at `{name}` is none of the outline of `{body}` there"
                ));
            }
        }
    }
    None
}

/// Directions that bound the normals of a body at a contact.
#[derive(Default)]
struct Cone {
    /// Normals are parallel to these.
    across: Vec<Vector>,
    /// Normals have no component against these.
    within: Vec<Vector>,
}

impl Cone {
    fn of(body: &Body, contact: &Contact, domains: &Domains) -> Cone {
        let mut cone = Cone::default();
        // Where parts of a composite meet, neither side is out for sure.
        if pieces(body).len() != 1 {
            return cone;
        }
        let is_met = |need: &Need| match need {
            Need::Zero(e) => is_zero(e, domains),
            Need::NotNegative(_) => decide::need(need, domains).verdict == Verdict::Everywhere,
        };
        let spots = touch::spots(body, &contact.at, false).into_iter();
        let sure: Vec<_> = spots.filter(|spot| spot.needs.iter().all(is_met)).collect();
        let alone = sure.len() == 1;
        for spot in sure {
            let Some(out) = spot.out else { continue };
            let is_end = |need: &Need| matches!(need, Need::NotNegative(e) if is_zero(e, domains));
            let is_smooth = alone && !spot.needs.iter().any(is_end);
            if is_smooth {
                cone.across.push(out.normal.clone());
            }
            match (out.either_side, &out.ends) {
                (false, _) => cone.within.push(out.normal),
                (true, Some(ends)) if !is_smooth => {
                    let at_first = minus(&ends[0], &contact.at)
                        .iter()
                        .all(|c| is_zero(c, domains));
                    let [from, to] = if at_first {
                        [&ends[1], &ends[0]]
                    } else {
                        [&ends[0], &ends[1]]
                    };
                    cone.within.push(minus(to, from));
                }
                _ => {}
            }
        }
        cone
    }
}

/// The sides of a body on which a contact lies, for certain or where its parameters let it lie on the body at all.
fn faces(body: &Body, contact: &Contact, domains: &Domains) -> Vec<Face> {
    let mut faces = Vec::new();
    for spot in touch::spots(body, &contact.at, false) {
        let Some(out) = spot.out else { continue };
        let mut at_corner = false;
        let holds = spot.needs.iter().all(|need| match need {
            Need::Zero(e) => is_zero(e, domains),
            Need::NotNegative(e) => {
                at_corner |= is_zero(e, domains);
                decide::need(need, domains).verdict != Verdict::Nowhere
            }
        });
        if holds {
            faces.push(Face { out, at_corner });
        }
    }
    // Where a rectangle's corner is, two of its sides end; where parts of a composite meet, neither side is out for sure.
    if faces.len() > 1 {
        faces.iter_mut().for_each(|f| f.at_corner = true);
    }
    faces
}

/// The sense of a normal of a body that can be touched from either side, `k` telling which body of the contact it is.
fn orient(
    normal: Vector,
    k: usize,
    contact: &Contact,
    bodies: [&Body; 2],
    domains: &Domains,
) -> (Vector, Sense) {
    let toward = |hint: Expr| match sign(&hint, domains) {
        Some(Sign::Positive) => Some(normal.clone()),
        Some(Sign::Negative) => Some(negated(&normal)),
        _ => None,
    };
    let by_given = contact
        .normal
        .as_ref()
        .and_then(|n| toward(dot(n, &normal)));
    // A convex body lies on the side of its tangent on which its center is.
    let other = bodies[1 - k];
    let convex = matches!(
        pieces(other).as_slice(),
        [Piece::Round { hollow: false, .. } | Piece::Rectangle { .. }]
    );
    let by_center = || {
        let reach = minus(&other.center, &contact.at);
        let reach = if k == 0 { reach } else { negated(&reach) };
        if convex {
            toward(dot(&reach, &normal))
        } else {
            None
        }
    };
    match by_given.or_else(by_center) {
        Some(normal) => (normal, Sense::Out),
        None => (normal, Sense::ByApproach),
    }
}

/// Whether a normal is among those already known.
fn known(list: &[Side], normal: &Vector, sense: Sense, domains: &Domains) -> bool {
    list.iter().any(|side| {
        is_zero(&cross(&side.normal, normal), domains)
            && (sense == Sense::ByApproach
                || side.sense == Sense::ByApproach
                || sign(&dot(&side.normal, normal), domains) == Some(Sign::Positive))
    })
}

/// Adds the ends of two straight sides that lie along each other.
fn along(a: &Face, b: &Face, normal: &Vector, sense: Sense, domains: &Domains, sides: &mut Sides) {
    let (Some(first), Some(second)) = (&a.out.ends, &b.out.ends) else {
        return;
    };
    let direction = |ends: &[Vector; 2]| minus(&ends[1], &ends[0]);
    let (d, e) = (direction(first), direction(second));
    if !is_zero(&cross(&d, &e), domains) {
        return;
    }
    for (ends, other, line) in [(first, second, &e), (second, first, &d)] {
        for end in ends {
            let reach = [
                dot(&minus(end, &other[0]), line),
                dot(&minus(&other[1], end), line),
            ];
            let verdicts = reach.map(|r| decide::decide(&r, domains).verdict);
            if verdicts.contains(&Verdict::Nowhere) {
                continue;
            }
            if verdicts != [Verdict::Everywhere; 2] {
                sides.unsure = true;
                continue;
            }
            let is_new = |t: &Touching| {
                let gap = minus(&t.at, end);
                !(is_zero(&gap[0], domains) && is_zero(&gap[1], domains))
            };
            if sides.along.iter().all(is_new) {
                sides.along.push(Touching {
                    at: end.clone(),
                    normal: normal.clone(),
                    sense,
                });
            }
        }
    }
}

fn negated(v: &Vector) -> Vector {
    [-&v[0], -&v[1]]
}
