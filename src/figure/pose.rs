//! Where each body lies and what its outline is, in meters.
//!
//! In: a scene and values. Out: poses. Knows nothing of pixels.

use std::f64::consts::{PI, TAU};

use super::plane::{Pair, apart, bearing, cross, dot, minus, plus, size, turned};
use super::sheet::arc;
use super::values::Values;
use crate::scene::{Body, Outline, Scene, Shape};

/// Outline of a body around its center, in meters.
#[derive(Clone, Debug)]
pub enum Look {
    /// Nothing of its own: ground, wall, peg.
    Fixed,
    /// A particle.
    Dot,
    /// A rod of this half length.
    Bar(f64),
    /// A disk, ring or ball.
    Round {
        /// Radius.
        radius: f64,
        /// Whether it is a thin ring.
        ring: bool,
    },
    /// A rectangle of these half sides.
    Plate(f64, f64),
    /// Any other body, points around its center.
    Blob(Vec<Pair>),
    /// Parts joined by thin bars.
    Parts(Vec<Pose>),
}

/// A body in its place, in meters.
#[derive(Clone, Debug)]
pub struct Pose {
    /// Center of mass.
    pub center: Pair,
    /// Orientation.
    pub angle: f64,
    /// Outline.
    pub look: Look,
    /// Whether it has no mass.
    pub massless: bool,
    /// What is drawn in place of the plain outline: closed lines along and across the body's axis, in meters.
    pub skin: Vec<Vec<Pair>>,
}

/// Every body in its place; `None` where one has no finite place.
pub fn posed(scene: &Scene, values: &Values) -> Option<Vec<Pose>> {
    let bodies = scene.bodies.iter().enumerate();
    bodies
        .map(|(i, body)| pose(scene, values, body, Some(i)))
        .collect()
}

fn pose(scene: &Scene, values: &Values, body: &Body, index: Option<usize>) -> Option<Pose> {
    let center = values.pair(&body.center)?;
    let length = |e| values.of(e).map(f64::abs);
    let hint = index.and_then(|i| scene.figure.outline(i));
    let skin = match hint {
        Some(Outline::Person(long)) => person(length(long)?),
        Some(Outline::Bat(long)) => vec![bat(length(long)?)],
        _ => Vec::new(),
    };
    let look = match &body.shape {
        Shape::Fixed => Look::Fixed,
        Shape::Particle => Look::Dot,
        Shape::Rod { length: l } => Look::Bar(length(l)? / 2.0),
        Shape::Disk { radius } | Shape::Sphere { radius } => Look::Round {
            radius: length(radius)?,
            ring: false,
        },
        Shape::Ring { radius } => Look::Round {
            radius: length(radius)?,
            ring: true,
        },
        Shape::Rectangle { width, height } => {
            Look::Plate(length(width)? / 2.0, length(height)? / 2.0)
        }
        Shape::Other => match hint {
            Some(Outline::Person(long) | Outline::Bat(long)) => Look::Bar(length(long)? / 2.0),
            Some(Outline::Box([width, height])) => {
                Look::Plate(length(width)? / 2.0, length(height)? / 2.0)
            }
            None => Look::Blob(blob(&attached(scene, values, index?, center)?)),
        },
        Shape::Composite { parts } => Look::Parts(
            parts
                .iter()
                .filter(|p| !p.is_fixed())
                .map(|p| pose(scene, values, p, None))
                .collect::<Option<Vec<_>>>()?,
        ),
    };
    Some(Pose {
        center,
        angle: values.of(&body.angle)?,
        look,
        massless: body.mass.is_zero(),
        skin,
    })
}

/// A person seen from the side, arms stretched beyond the head, as long as given: outlines of the body and of the head.
fn person(long: f64) -> Vec<Vec<Pair>> {
    let half: [(f64, f64); 12] = [
        (-0.5, 0.010),
        (-0.46, 0.014),
        (-0.36, 0.016),
        (-0.26, 0.022),
        (-0.235, 0.042),
        (-0.16, 0.050),
        (-0.05, 0.040),
        (0.03, 0.046),
        (0.12, 0.040),
        (0.26, 0.026),
        (0.36, 0.026),
        (0.48, 0.014),
    ];
    let mut body: Vec<Pair> = half.iter().map(|(u, v)| [u * long, v * long]).collect();
    // The feet.
    body.extend([[0.5 * long, 0.014 * long], [0.5 * long, -0.045 * long]]);
    body.extend([[0.485 * long, -0.045 * long]]);
    body.extend(half.iter().rev().map(|(u, v)| [u * long, -v * long]));
    let head = arc([-0.29 * long, -0.048 * long], 0.04 * long, 0.0, TAU);
    vec![body, head]
}

/// A bat as long as given, the handle first.
fn bat(long: f64) -> Vec<Pair> {
    let half: [(f64, f64); 9] = [
        (-0.5, 0.022),
        (-0.485, 0.022),
        (-0.475, 0.012),
        (-0.15, 0.014),
        (0.1, 0.024),
        (0.3, 0.034),
        (0.44, 0.036),
        (0.485, 0.03),
        (0.5, 0.014),
    ];
    let upper = half.iter().map(|(u, v)| [u * long, v * long]);
    let lower = half.iter().rev().map(|(u, v)| [u * long, -v * long]);
    upper.chain(lower).collect()
}

/// Where others touch a body, as seen from its center.
fn attached(scene: &Scene, values: &Values, body: usize, center: Pair) -> Option<Vec<Pair>> {
    let own = scene.acting().filter(|one| one.bodies.contains(&body));
    own.map(|one| Some(minus(values.pair(one.at)?, center)))
        .collect()
}

/// A smooth outline around the origin that passes through the points.
fn blob(through: &[Pair]) -> Vec<Pair> {
    let far = through.iter().map(|p| size(*p)).fold(0.0, f64::max);
    let base = if far > 0.0 { 0.78 * far } else { 0.5 };
    let plain =
        |phi: f64| base * (1.0 + 0.10 * (2.0 * phi + 0.7).cos() + 0.05 * (3.0 * phi - 0.4).cos());
    let bump = |phi: f64, at: f64| {
        let d = (phi - at + PI).rem_euclid(TAU) - PI;
        (-(d / 0.75).powi(2)).exp()
    };
    let points: Vec<(f64, f64)> = through.iter().map(|p| (bearing(*p), size(*p))).collect();
    let mut heights = vec![0.0; points.len()];
    let radius = |phi: f64, heights: &[f64]| {
        let bumps: f64 = points
            .iter()
            .zip(heights)
            .map(|((at, _), h)| h * bump(phi, *at))
            .sum();
        (plain(phi) + bumps).max(0.15 * base)
    };
    for _ in 0..12 {
        for i in 0..points.len() {
            heights[i] += points[i].1 - radius(points[i].0, &heights);
        }
    }
    (0..72)
        .map(|k| {
            let phi = TAU * f64::from(k) / 72.0;
            let r = radius(phi, &heights).clamp(0.0, 4.0 * base);
            [r * phi.cos(), r * phi.sin()]
        })
        .collect()
}

impl Pose {
    /// A point given along and across the body's axis, in meters.
    fn at(&self, along: f64, across: f64) -> Pair {
        plus(self.center, turned([along, across], self.angle))
    }

    /// The closed lines that are drawn in place of the plain outline.
    pub fn drawn(&self) -> Vec<Vec<Pair>> {
        let each = self.skin.iter();
        each.map(|line| line.iter().map(|p| self.at(p[0], p[1])).collect())
            .collect()
    }

    /// Closed lines that show the body, in meters.
    pub fn lines(&self) -> Vec<Vec<Pair>> {
        match &self.look {
            _ if !self.skin.is_empty() => self.drawn(),
            Look::Fixed => Vec::new(),
            Look::Parts(parts) => {
                // The parts are joined by light bars, each from its center to the next.
                let bars = parts
                    .windows(2)
                    .filter(|two| !two[0].meets(&two[1]))
                    .map(|two| vec![two[0].center, two[1].center]);
                bars.chain(parts.iter().flat_map(Pose::lines)).collect()
            }
            _ => vec![self.outline()],
        }
    }

    /// How far the body reaches from a point in a direction, in meters; a thin body reaches nowhere across itself.
    pub fn reach(&self, from: Pair, direction: Pair) -> f64 {
        let lines = match self.skin.is_empty() {
            true => vec![self.outline()],
            false => self.drawn(),
        };
        let mut far = 0.0_f64;
        for points in &lines {
            for (i, a) in points.iter().enumerate() {
                let b = points[(i + 1) % points.len()];
                let (u, w) = (minus(b, *a), minus(*a, from));
                let det = cross(u, direction);
                if det.abs() < 1e-12 * (size(u) * size(direction)).max(1e-300) {
                    continue;
                }
                let (t, s) = (cross(u, w) / det, cross(direction, w) / det);
                if (-1e-9..=1.0 + 1e-9).contains(&s) {
                    far = far.max(t);
                }
            }
        }
        far * size(direction)
    }

    /// Points that span the body, in meters.
    pub fn outline(&self) -> Vec<Pair> {
        match &self.look {
            Look::Fixed => Vec::new(),
            Look::Dot => vec![self.center],
            Look::Bar(half) => vec![self.at(*half, 0.0), self.at(-half, 0.0)],
            Look::Round { radius, .. } => arc(self.center, *radius, 0.0, TAU),
            Look::Plate(w, h) => vec![
                self.at(*w, *h),
                self.at(-w, *h),
                self.at(-w, -h),
                self.at(*w, -h),
            ],
            Look::Blob(points) => points.iter().map(|p| plus(self.center, *p)).collect(),
            Look::Parts(parts) => parts.iter().flat_map(Pose::outline).collect(),
        }
    }

    /// Whether it is a rod, or has one, that lies through a point along a surface with this normal.
    pub fn lies_along(&self, at: Pair, n: Pair) -> bool {
        let level = |[a, b]: [Pair; 2]| {
            let long = apart(b, a);
            let off = |p: Pair| dot(minus(p, a), n).abs();
            off(b) < 0.02 * long && off(at) < 0.02 * long
        };
        match &self.look {
            Look::Parts(parts) => parts.iter().any(|part| part.lies_along(at, n)),
            _ => self.skin.is_empty() && self.ends().is_some_and(level),
        }
    }

    /// Whether two rods have an end in common.
    pub fn meets(&self, other: &Pose) -> bool {
        let (Some(mine), Some(theirs)) = (self.ends(), other.ends()) else {
            return false;
        };
        let close = |a: &Pair, b: &Pair| apart(*a, *b) < 1e-9;
        mine.iter().any(|a| theirs.iter().any(|b| close(a, b)))
    }

    /// Ends of a rod, in meters.
    pub fn ends(&self) -> Option<[Pair; 2]> {
        match self.look {
            Look::Bar(half) => Some([self.at(-half, 0.0), self.at(half, 0.0)]),
            _ => None,
        }
    }
}
