//! Mass, center and moment of inertia of the bodies, held against their outlines.
//!
//! In: a scene. Out: a check that what the reader's formulas make of each body is what an integration over its outline
//! finds, which has none of these formulas. Laws and numeric solution both take their inertias from the scene; without
//! this check a wrong row of its table would deceive both ways alike.

use super::Check;
use crate::expr::Point;
use crate::numeric::{self, follow};
use crate::scene::{Body, Scene, Shape};

/// Relative difference that rounding may make; the integration itself is exact for these outlines.
const ROUNDING: f64 = 1e-12;

/// The bodies of the scene against their outlines at some points; `None` where no body has one.
pub(super) fn check(scene: &Scene, at: &[Point<f64>]) -> Option<Check> {
    let bodies: Vec<usize> = (0..scene.bodies.len())
        .filter(|b| has_outline(&scene.bodies[*b]))
        .collect();
    if bodies.is_empty() {
        return None;
    }
    let mut points = 0;
    for point in at {
        let (Ok(given), Ok(solids)) = (numeric::given(scene, point), follow::solids(scene, point))
        else {
            continue;
        };
        points += 1;
        for &b in &bodies {
            let (told, found) = (&given.bodies[b], &solids[b]);
            let name = &scene.bodies[b].name;
            let size = (found.inertia / found.mass).sqrt();
            let reach = found.center.iter().fold(size, |r, x| r.max(x.abs()));
            let off = |x: f64, y: f64, scale: f64| (x - y).abs() > ROUNDING * scale;
            let wrong = match () {
                () if off(told.mass, found.mass, found.mass) => "mass",
                () if (0..2).any(|k| off(told.center[k], found.center[k], reach)) => {
                    "center of mass"
                }
                () if off(told.inertia, found.inertia, found.inertia) => "moment of inertia",
                () => continue,
            };
            return Some(Check::new(
                "inertia",
                format!("the {wrong} of {name} is not that of its outline"),
                Some(false),
            ));
        }
    }
    Some(match points {
        0 => Check::new("inertia", "no outline has a value in doubles", None),
        n => Check::new(
            "inertia",
            format!(
                "masses, centers and moments of inertia are those of the outlines, integrated at {}",
                super::points(n)
            ),
            Some(true),
        ),
    })
}

/// Whether mass or inertia of a body follow from an outline.
fn has_outline(body: &Body) -> bool {
    match body.shape {
        Shape::Fixed | Shape::Particle | Shape::Other => false,
        Shape::Composite { .. } => true,
        _ => !body.inertia_given && !body.mass.is_zero(),
    }
}
