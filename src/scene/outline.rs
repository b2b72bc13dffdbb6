//! Outlines of bodies: where a point lies on them, how far away it is, and which way is out.
//!
//! In: a body as it stands, and a point, as formulas. Out: the pieces of its outline and, for each side of a piece, what
//! must hold for the point to lie there. A thin rod is a segment; disk, ring and sphere are circles about the center of
//! mass (the plane of motion cuts a sphere through its center); a composite consists of its parts and of the massless bars
//! that join them, which the file does not draw and which are taken as straight from center to center. A fixed body and a
//! `body` have no outline. Nothing here knows of velocities.

use super::{Body, Shape, geometry};
use crate::expr::{Expr, Point, Vector, cross, dot, minus, plus};

/// A piece of an outline.
#[derive(Clone, Debug)]
pub enum Piece {
    /// A point mass.
    Point(Vector),
    /// The points middle + s·along with |s| ≤ half: a thin rod, or a bar without mass.
    Straight {
        /// Its middle \[m\].
        middle: Vector,
        /// Its direction, of any length but 0.
        along: Vector,
        /// Half its length, in units of `along`.
        half: Expr,
        /// Square of the length of `along`.
        square: Expr,
    },
    /// A circle.
    Round {
        /// Center \[m\].
        center: Vector,
        /// Radius \[m\].
        radius: Expr,
        /// Whether it has an inner side too: a ring.
        hollow: bool,
    },
    /// A rectangle.
    Rectangle {
        /// Its middle \[m\].
        middle: Vector,
        /// Unit vector along its width.
        along: Vector,
        /// Half its width and half its height \[m\].
        half: [Expr; 2],
    },
}

/// Something that must hold for a point to lie at a spot.
#[derive(Clone, Debug, PartialEq)]
pub enum Need {
    /// This is zero.
    Zero(Expr),
    /// This is not negative.
    NotNegative(Expr),
}

/// One side of a piece, as a place where a point may lie.
#[derive(Clone, Debug)]
pub struct Spot {
    /// What must hold for the point to lie there.
    pub needs: Vec<Need>,
    /// The way out there; `None` for a point mass and for the inside of a body.
    pub out: Option<Out>,
}

/// The way out of a body at a point of its outline.
#[derive(Clone, Debug)]
pub struct Out {
    /// A vector across the outline, of any length.
    pub normal: Vector,
    /// Whether both senses lead out: thin rods and rings can be touched from either side.
    pub either_side: bool,
    /// Both ends of the straight side on which the point lies; `None` on a circle.
    pub ends: Option<[Vector; 2]>,
}

/// The pieces of the outline of a body; none where the scene does not tell its outline.
pub fn pieces(body: &Body) -> Vec<Piece> {
    let along = || geometry::direction(&body.angle);
    let middle = body.center.clone();
    let half = |e: &Expr| e * &Expr::ratio(1, 2);
    let round = |radius: &Expr, hollow| Piece::Round {
        center: body.center.clone(),
        radius: radius.clone(),
        hollow,
    };
    match &body.shape {
        Shape::Fixed | Shape::Other => Vec::new(),
        Shape::Particle => vec![Piece::Point(middle)],
        Shape::Rod { length } => vec![Piece::Straight {
            middle,
            along: along(),
            half: half(length),
            square: Expr::one(),
        }],
        Shape::Disk { radius } | Shape::Sphere { radius } => vec![round(radius, false)],
        Shape::Ring { radius } => vec![round(radius, true)],
        Shape::Rectangle { width, height } => vec![Piece::Rectangle {
            middle,
            along: along(),
            half: [half(width), half(height)],
        }],
        Shape::Composite { parts } => {
            let own: Vec<Vec<Piece>> = parts.iter().map(pieces).collect();
            if own.iter().any(Vec::is_empty) {
                return Vec::new();
            }
            let bars = parts.iter().enumerate().flat_map(|(i, a)| {
                let later = parts[i + 1..].iter();
                later.map(move |b| bar(&a.center, &b.center))
            });
            own.into_iter().flatten().chain(bars).collect()
        }
    }
}

/// A straight bar between two points.
fn bar(from: &Vector, to: &Vector) -> Piece {
    let half = |e: Expr| e * Expr::ratio(1, 2);
    let along = minus(to, from);
    Piece::Straight {
        middle: [half(&from[0] + &to[0]), half(&from[1] + &to[1])],
        square: dot(&along, &along),
        along,
        half: Expr::ratio(1, 2),
    }
}

impl Piece {
    /// The sides at which a point may lie; with `inside` also the inside of a disk, sphere or rectangle, where something may
    /// stick in the body.
    pub fn spots(&self, at: &Vector, inside: bool) -> Vec<Spot> {
        match self {
            Piece::Point(place) => {
                let needs = minus(at, place).map(Need::Zero).to_vec();
                vec![Spot { needs, out: None }]
            }
            Piece::Straight {
                middle,
                along,
                half,
                square,
            } => {
                let arm = minus(at, middle);
                let mut needs = vec![Need::Zero(cross(along, &arm))];
                needs.extend(within(&dot(along, &arm), &(half * square)));
                let out = Some(Out {
                    normal: across(along),
                    either_side: true,
                    ends: Some(ends(middle, along, half)),
                });
                vec![Spot { needs, out }]
            }
            Piece::Round {
                center,
                radius,
                hollow,
            } => {
                let arm = minus(at, center);
                let gap = radius.powi(2) - dot(&arm, &arm);
                let mut spots = vec![Spot {
                    needs: vec![Need::Zero(gap.clone())],
                    out: Some(Out {
                        normal: arm,
                        either_side: *hollow,
                        ends: None,
                    }),
                }];
                if inside {
                    let needs = vec![Need::NotNegative(gap)];
                    spots.push(Spot { needs, out: None });
                }
                spots
            }
            Piece::Rectangle {
                middle,
                along,
                half,
            } => sides(at, middle, along, half, inside),
        }
    }

    /// Distance of a point from the piece, at a point of the parameters \[m\]; zero inside, if `inside`.
    fn distance(&self, at: &Vector, inside: bool, values: &Point<f64>) -> Option<f64> {
        let number = |e: &Expr| e.evaluate(values).filter(|v| v.is_finite());
        let pair = |v: &Vector| Some([number(&v[0])?, number(&v[1])?]);
        let [x, y] = pair(at)?;
        match self {
            Piece::Point(place) => {
                let [a, b] = pair(place)?;
                Some((x - a).hypot(y - b))
            }
            Piece::Straight {
                middle,
                along,
                half,
                ..
            } => {
                let ([a, b], [u, v], half) = (pair(middle)?, pair(along)?, number(half)?);
                let square = (u * u + v * v).max(f64::MIN_POSITIVE);
                let s = (((x - a) * u + (y - b) * v) / square).clamp(-half.abs(), half.abs());
                Some((x - a - s * u).hypot(y - b - s * v))
            }
            Piece::Round { center, radius, .. } => {
                let ([a, b], radius) = (pair(center)?, number(radius)?);
                let over = (x - a).hypot(y - b) - radius;
                Some(if inside { over.max(0.0) } else { over.abs() })
            }
            Piece::Rectangle {
                middle,
                along,
                half,
            } => {
                let ([a, b], [u, v], half) = (pair(middle)?, pair(along)?, pair(half)?);
                let over = [(x - a) * u + (y - b) * v, (y - b) * u - (x - a) * v];
                let over = [over[0].abs() - half[0], over[1].abs() - half[1]];
                let outside = over[0].max(0.0).hypot(over[1].max(0.0));
                let depth = over[0].max(over[1]).min(0.0);
                Some(if inside { outside } else { outside - depth })
            }
        }
    }

    /// The largest extent \[m\], the ruler for how exactly a place is given.
    fn extent(&self, values: &Point<f64>) -> Option<f64> {
        let number = |e: &Expr| e.evaluate(values);
        match self {
            Piece::Point(_) => Some(0.0),
            Piece::Straight { half, square, .. } => {
                Some(2.0 * number(half)? * number(square)?.sqrt())
            }
            Piece::Round { radius, .. } => Some(2.0 * number(radius)?),
            Piece::Rectangle { half, .. } => Some(2.0 * number(&half[0])?.hypot(number(&half[1])?)),
        }
    }
}

/// The four sides of a rectangle, and its inside.
fn sides(
    at: &Vector,
    middle: &Vector,
    along: &Vector,
    half: &[Expr; 2],
    inside: bool,
) -> Vec<Spot> {
    let arm = minus(at, middle);
    let axes = [along.clone(), across(along)];
    let place = axes.each_ref().map(|axis| dot(axis, &arm));
    let mut spots = Vec::new();
    for (k, sense) in [(0, 1), (0, -1), (1, 1), (1, -1)] {
        let other = 1 - k;
        let normal = scaled(&axes[k], &Expr::from(sense));
        let face = plus(middle, &scaled(&normal, &half[k]));
        let mut needs = vec![Need::Zero(
            &half[k] - &(Expr::from(sense) * place[k].clone()),
        )];
        needs.extend(within(&place[other], &half[other]));
        let out = Out {
            ends: Some(ends(&face, &axes[other], &half[other])),
            normal,
            either_side: false,
        };
        spots.push(Spot {
            needs,
            out: Some(out),
        });
    }
    if inside {
        let needs = [within(&place[0], &half[0]), within(&place[1], &half[1])].concat();
        spots.push(Spot { needs, out: None });
    }
    spots
}

/// |s| ≤ half.
fn within(s: &Expr, half: &Expr) -> Vec<Need> {
    vec![Need::NotNegative(half - s), Need::NotNegative(half + s)]
}

fn across(along: &Vector) -> Vector {
    [-&along[1], along[0].clone()]
}

fn scaled(v: &Vector, k: &Expr) -> Vector {
    [&v[0] * k, &v[1] * k]
}

fn ends(middle: &Vector, along: &Vector, half: &Expr) -> [Vector; 2] {
    let step = scaled(along, half);
    [minus(middle, &step), plus(middle, &step)]
}

/// Share of a body's extent by which a place given in numbers may miss its outline: numbers are rounded, to three digits at
/// the roughest.
const ROUNDED: f64 = 1e-3;

/// Distance of a point from the outline of a body, at a point of the parameters \[m\]: 0 where it lies on it to within what
/// rounded numbers leave, `None` where a value is missing or the body has no outline.
pub fn distance(body: &Body, at: &Vector, inside: bool, values: &Point<f64>) -> Option<f64> {
    let pieces = pieces(body);
    let (mut nearest, mut extent) = (f64::INFINITY, 0.0_f64);
    for piece in &pieces {
        nearest = nearest.min(piece.distance(at, inside, values)?);
        extent = extent.max(piece.extent(values)?);
    }
    let slack = ROUNDED * extent;
    (!pieces.is_empty()).then_some(if nearest <= slack { 0.0 } else { nearest })
}
