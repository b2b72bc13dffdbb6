//! Plots of a scene: curves sampled, zeros marked with their exact values, axes with symbols and units.
//!
//! In: the curves of [`crate::answer::graphs`] in closed form. Out: SVG with a caption.

use super::html::Picture;
use super::unicode;
use crate::answer::{Curve, Graph};
use crate::dimension::Dimension;
use crate::expr::{Expr, Point};
use crate::figure::{Label, Piece};
use crate::plot::{self, Axis, Mark, Plot, PlotFault};
use crate::scene::Scene;
use crate::solution::Slot;

/// Points of a curve.
const POINTS: usize = 400;
/// Most marked points; more would hide the curves.
const MARKS: usize = 6;

/// A plot as a picture.
pub fn picture(scene: &Scene, graph: &Graph) -> Result<Picture, PlotFault> {
    let variable = &graph.ask.against;
    let symbol = unicode(scene, &Expr::symbol(variable));
    let x = match &graph.ask.stands_for {
        Some((formula, _)) => format!("{symbol} = {}", unicode(scene, formula)),
        None => symbol.clone(),
    };
    let quantity = match &graph.ask.label {
        Some(label) => label.clone(),
        None => unicode(scene, &graph.ask.quantity),
    };
    let mut marks: Vec<Mark> = Vec::new();
    for (exact, at) in graph.curves.iter().flat_map(|c| &c.zeros) {
        let mark = Mark {
            at: [*at, 0.0],
            label: format!("{symbol} = {}", unicode(scene, exact)),
        };
        // Curves may cross the axis together.
        if !marks.contains(&mark) && marks.len() < MARKS {
            marks.push(mark);
        }
    }
    let curves = graph.curves.iter().map(|c| plot::Curve {
        label: label(scene, c),
        points: plot::sample(
            |x| value(graph, c, x),
            graph.range[0],
            graph.range[1],
            POINTS,
        ),
    });
    let title = match graph.ask.title.as_str() {
        "" => format!("{quantity} against {x}"),
        title => title.to_string(),
    };
    let zeros: Vec<String> = marks.iter().map(|m| m.label.clone()).collect();
    let whole = Plot {
        title: title.clone(),
        x: Axis {
            label: with_unit(&x, &graph.x),
            range: Some(graph.range),
        },
        y: Axis {
            label: with_unit(&quantity, &graph.y),
            range: None,
        },
        curves: curves.collect(),
        marks,
    };
    let mut caption = vec![Piece::Words(title)];
    for (i, zero) in zeros.iter().enumerate() {
        let lead = if i == 0 { "; zero at " } else { " and " };
        caption.push(Piece::Words(lead.to_string()));
        caption.push(Piece::Symbol(Label::latex(&zero.replace(' ', "\\ "))));
    }
    let end = if zeros.is_empty() { "." } else { ", exactly." };
    caption.push(Piece::Words(end.to_string()));
    let curves: Vec<&str> = whole.curves.iter().map(|c| c.label.as_str()).collect();
    let curves = curves.join("; ");
    Ok(Picture {
        slot: Slot::Plot,
        svg: plot::curve(&whole)?,
        tikz: plot::tikz(&whole)?,
        alternative: match zeros.as_slice() {
            [] => format!("Plot of {quantity} against {x}. Curves: {curves}."),
            zeros => format!(
                "Plot of {quantity} against {x}. Curves: {curves}. Zero at {}.",
                zeros.join(" and ")
            ),
        },
        caption,
    })
}

fn value(graph: &Graph, curve: &Curve, x: f64) -> f64 {
    let mut point = Point::<f64>::default();
    point.values.insert(graph.ask.against.clone(), x);
    curve.formula.evaluate(&point).unwrap_or(f64::NAN)
}

fn label(scene: &Scene, curve: &Curve) -> String {
    let each = curve.with.iter().map(|(s, v)| {
        let (s, v) = (unicode(scene, &Expr::symbol(s)), unicode(scene, v));
        format!("{s} = {v}")
    });
    each.collect::<Vec<_>>().join(", ")
}

fn with_unit(label: &str, dimension: &Dimension) -> String {
    if dimension.is_none() {
        label.to_string()
    } else {
        format!("{label} ({})", dimension.si())
    }
}
