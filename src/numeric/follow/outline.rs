//! Mass, center of mass and moment of inertia of a body, found from its outline by numerical integration.
//!
//! In: a body of the file and a point. Out: a [`Solid`]. The formulas for moments of inertia and for centers of composites
//! that the reader writes into a scene are not looked at; a wrong one is noticed because this module has none. Only an
//! inertia which the file itself gives, as it must for a body without outline, is taken from there.

use std::f64::consts::TAU;
use std::sync::LazyLock;

use super::super::given::{Freedom, Undefined};
use super::{finite, finite_pair};
use crate::expr::{Expr, Point, Vector, minus};
use crate::scene::{Body, Shape};

/// What a body is, as far as motion goes.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// Name in the scene.
    pub name: String,
    /// Which unknowns it has.
    pub freedom: Freedom,
    /// Mass m \[kg\]; zero for a massless link and for a fixed body.
    pub mass: f64,
    /// Moment of inertia about the center of mass I_G [kg m²].
    pub inertia: f64,
    /// Center of mass where the file puts the body \[m\]; of a fixed body the point its velocity refers to.
    pub center: [f64; 2],
}

/// A piece of a body: a share of mass at a place, with the moment of inertia of what is smaller than the piece.
struct Piece {
    mass: f64,
    at: [f64; 2],
    inertia: f64,
}

/// Nodes and weights of Gauss and Legendre on [−1, 1], exact up to the seventh power.
const GAUSS: [[f64; 2]; 4] = [
    [-0.861_136_311_594_052_6, 0.347_854_845_137_453_9],
    [-0.339_981_043_584_856_3, 0.652_145_154_862_546_1],
    [0.339_981_043_584_856_3, 0.652_145_154_862_546_1],
    [0.861_136_311_594_052_6, 0.347_854_845_137_453_9],
];

/// Sines and cosines of directions round a circle; more than the squares of coordinates need.
static ROUND: LazyLock<[(f64, f64); 8]> =
    LazyLock::new(|| std::array::from_fn(|k| (TAU * (k as f64 + 0.5) / 8.0).sin_cos()));

/// The body in numbers.
pub(super) fn solid(body: &Body, at: &Point<f64>) -> Result<Solid, Undefined> {
    let freedom = match () {
        () if body.is_fixed() => Freedom::Fixed,
        () if body.is_particle() => Freedom::Particle,
        () => Freedom::Rigid,
    };
    let mut out = Solid {
        name: body.name.clone(),
        freedom,
        mass: 0.0,
        inertia: 0.0,
        center: [0.0; 2],
    };
    if freedom == Freedom::Fixed {
        out.center = finite_pair(&body.center, at, || format!("center of {}", body.name))?;
        return Ok(out);
    }
    let mut all = Vec::new();
    // From the center of the first part, so that a body far from the origin loses nothing.
    let from = &first(body).center;
    pieces(body, from, at, &mut all)?;
    out.mass = all.iter().map(|p| p.mass).sum();
    if out.mass == 0.0 {
        out.center = finite_pair(&body.center, at, || format!("center of {}", body.name))?;
        return Ok(out);
    }
    let from = finite_pair(from, at, || format!("center of {}", body.name))?;
    let offset = [0, 1].map(|k| {
        let moment: f64 = all.iter().map(|p| p.mass * p.at[k]).sum();
        moment / out.mass
    });
    out.center = [from[0] + offset[0], from[1] + offset[1]];
    out.inertia = all
        .iter()
        .map(|p| {
            let arm = [0, 1].map(|k| p.at[k] - offset[k]);
            p.inertia + p.mass * (arm[0] * arm[0] + arm[1] * arm[1])
        })
        .sum();
    Ok(out)
}

/// The first part of a composite that is none itself, or the body.
fn first(body: &Body) -> &Body {
    match &body.shape {
        Shape::Composite { parts } => parts.first().map_or(body, first),
        _ => body,
    }
}

/// Cuts a body into pieces where the file puts it, seen from a place.
fn pieces(
    body: &Body,
    from: &Vector,
    at: &Point<f64>,
    into: &mut Vec<Piece>,
) -> Result<(), Undefined> {
    if let Shape::Composite { parts } = &body.shape {
        let mut parts = parts.iter();
        return parts.try_for_each(|part| pieces(part, from, at, into));
    }
    let name = &body.name;
    let number = |e: &Expr, what: &str| finite(e, at, || format!("{what} of {name}"));
    let mass = number(&body.mass, "mass")?;
    let center = minus(&body.center, from);
    let center = finite_pair(&center, at, || format!("center of {name}"))?;
    if body.inertia_given || matches!(body.shape, Shape::Other) {
        into.push(Piece {
            mass,
            at: center,
            inertia: number(&body.inertia, "moment of inertia")?,
        });
        return Ok(());
    }
    // Every outline is symmetric about its center, and each part says where that is: how it is turned plays no part.
    let spots = spots(body, &number)?;
    let whole: f64 = spots.iter().map(|[_, _, share]| share).sum();
    into.extend(spots.iter().map(|[x, y, share]| Piece {
        mass: mass * share / whole,
        at: [center[0] + x, center[1] + y],
        inertia: 0.0,
    }));
    Ok(())
}

/// Places in the outline, along and across the body's axis, each with its share.
fn spots(
    body: &Body,
    number: &dyn Fn(&Expr, &str) -> Result<f64, Undefined>,
) -> Result<Vec<[f64; 3]>, Undefined> {
    let circle = |radius: f64, share: f64| {
        let around = ROUND.iter();
        around.map(move |(s, c)| [radius * c, radius * s, share])
    };
    // Rings of a disk: at the radius r there is mass in proportion to r.
    let disk = |radius: f64, share: f64| {
        GAUSS.iter().flat_map(move |[node, weight]| {
            let r = radius * (1.0 + node) / 2.0;
            circle(r, share * weight * r * radius)
        })
    };
    Ok(match &body.shape {
        Shape::Fixed | Shape::Particle | Shape::Other | Shape::Composite { .. } => {
            vec![[0.0, 0.0, 1.0]]
        }
        Shape::Rod { length } => {
            let half = number(length, "length")? / 2.0;
            GAUSS.iter().map(|[x, w]| [half * x, 0.0, *w]).collect()
        }
        Shape::Ring { radius } => circle(number(radius, "radius")?, 1.0).collect(),
        Shape::Disk { radius } => disk(number(radius, "radius")?, 1.0).collect(),
        Shape::Sphere { radius } => {
            let radius = number(radius, "radius")?;
            // Slices across the axis of rotation.
            let slices = GAUSS.iter().flat_map(|[height, weight]| {
                let r = radius * (1.0 - height * height).sqrt();
                disk(r, *weight)
            });
            slices.collect()
        }
        Shape::Rectangle { width, height } => {
            let half = [
                number(width, "width")? / 2.0,
                number(height, "height")? / 2.0,
            ];
            let rows = GAUSS.iter().flat_map(|[y, v]| {
                GAUSS
                    .iter()
                    .map(move |[x, w]| [half[0] * x, half[1] * y, v * w])
            });
            rows.collect()
        }
    })
}
