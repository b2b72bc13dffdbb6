//! How far boxes and rods reach along the line on which they move and across it, and whether friction turns a box over.

use super::ROUNDING;
use crate::expr::arithmetic::{cross, dot};
use crate::numeric::follow::{Course, Lost, State};
use crate::scene::{Shape, Slide};

/// Friction under a box turns it forwards. What presses it on the surface balances that as far as the box reaches.
pub(super) fn stands(course: &Course<'_>, slide: &Slide, before: &State) -> Result<(), Lost> {
    let is_box = matches!(
        course.stage.scene.bodies[slide.body].shape,
        Shape::Rectangle { .. }
    );
    if !is_box || slide.level || slide.gravity.is_none() || !slide.with.is_empty() {
        return Ok(());
    }
    let (Some(mu), Ok(angle)) = (&slide.friction, &before.bodies[slide.body].angle) else {
        return Ok(());
    };
    let along = course.pair(&slide.along, "direction")?;
    let rough = course.number(mu, "coefficient of friction")?;
    match extents(course, slide.body, *angle, along)? {
        Some([long, high]) if rough * high > long * (1.0 + ROUNDING) => {
            Err(course.contradiction("it tips over"))
        }
        _ => Ok(()),
    }
}

/// How long a box or a rod is along a line, and how high across it; nothing where no side lies along the line.
pub(super) fn extents(
    course: &Course<'_>,
    body: usize,
    angle: f64,
    along: [f64; 2],
) -> Result<Option<[f64; 2]>, Lost> {
    let axis = [angle.cos(), angle.sin()];
    let is_along = cross(&axis, &along).abs() < ROUNDING;
    let is_across = dot(&axis, &along).abs() < ROUNDING;
    let size = |e| course.number(e, "length");
    Ok(match &course.stage.scene.bodies[body].shape {
        Shape::Rectangle { width, height } if is_along => Some([size(width)?, size(height)?]),
        Shape::Rectangle { width, height } if is_across => Some([size(height)?, size(width)?]),
        Shape::Rod { length } if is_along => Some([size(length)?, 0.0]),
        _ => None,
    })
}
