//! Plots of a scene: curves sampled, zeros marked with their exact values, axes with symbols and units.
//!
//! In: the curves of [`crate::answer::graphs`] in closed form. Out: a picture with a caption.

use super::html::Picture;
use crate::answer::{Curve, Graph};
use crate::dimension::Dimension;
use crate::expr::{Expr, Point};
use crate::figure::{Ink, Label, Piece};
use crate::plot::{self, Axis, Empty, Mark, Plot};
use crate::scene::Scene;
use crate::solution::Slot;

/// Points of a curve.
const POINTS: usize = 400;
/// Most marked points; more would hide the curves.
const MARKS: usize = 6;

/// A plot as a picture.
pub fn picture(scene: &Scene, graph: &Graph) -> Result<Picture, Empty> {
    let formula = |e: &Expr| Label::formula(e, scene);
    let variable = Expr::symbol(&graph.ask.against);
    let x = match &graph.ask.stands_for {
        Some((stands_for, _)) => equation(scene, &variable, stands_for),
        None => formula(&variable),
    };
    let quantity = match &graph.ask.label {
        Some(label) => Label::latex(&label.replace(' ', "\\ ")),
        None => formula(&graph.ask.quantity),
    };
    let mut marks: Vec<Mark> = Vec::new();
    for (exact, at) in graph.curves.iter().flat_map(|c| &c.zeros) {
        let mark = Mark {
            note: String::new(),
            at: [*at, 0.0],
            label: equation(scene, &variable, exact),
            ink: Ink::Body,
        };
        // Curves may cross the axis together.
        if !marks.contains(&mark) && marks.len() < MARKS {
            marks.push(mark);
        }
    }
    let [from, to] = graph.range;
    let curves = graph.curves.iter().enumerate().map(|(i, c)| plot::Curve {
        note: String::new(),
        ink: Ink::Curve(i),
        label: label(scene, c),
        points: plot::sample(|x| value(graph, c, x), from, to, POINTS),
    });
    let title = match graph.ask.title.as_str() {
        "" => format!("{} against {}", quantity.text(), x.text()),
        title => title.to_string(),
    };
    let whole = Plot {
        title,
        x: Axis {
            label: with_unit(x, &graph.x),
            range: Some(graph.range),
            ticks: Vec::new(),
        },
        y: Axis {
            label: with_unit(quantity, &graph.y),
            range: None,
            ticks: Vec::new(),
        },
        curves: curves.collect(),
        marks,
    };
    let drawing = plot::draw(&whole)?;
    let (tikz, mut caption) = (drawing.tikz(), drawing.caption);
    for (i, zero) in whole.marks.iter().enumerate() {
        let lead = if i == 0 { "; zero at " } else { " and " };
        caption.push(Piece::Words(lead.to_string()));
        caption.push(Piece::Symbol(zero.label.clone()));
    }
    let end = if whole.marks.is_empty() {
        "."
    } else {
        ", exactly."
    };
    caption.push(Piece::Words(end.to_string()));
    Ok(Picture {
        slot: Slot::Plot,
        tikz,
        svg: drawing.svg,
        alternative: format!("Plot of {}", drawing.alternative),
        caption,
    })
}

fn value(graph: &Graph, curve: &Curve, x: f64) -> f64 {
    let mut point = Point::<f64>::default();
    point.values.insert(graph.ask.against.clone(), x);
    curve.formula.evaluate(&point).unwrap_or(f64::NAN)
}

fn equation(scene: &Scene, left: &Expr, right: &Expr) -> Label {
    let [left, right] = [left, right].map(|e| Label::formula(e, scene));
    left.then(Label::words(" = ")).then(right)
}

fn label(scene: &Scene, curve: &Curve) -> Label {
    let mut out = Label::default();
    for (symbol, value) in &curve.with {
        if !out.runs.is_empty() {
            out = out.then(Label::words(", "));
        }
        out = out.then(equation(scene, &Expr::symbol(symbol), value));
    }
    out
}

fn with_unit(label: Label, dimension: &Dimension) -> Label {
    match dimension.is_none() {
        true => label,
        false => label.then(Label::words(&format!(" ({})", dimension.si()))),
    }
}
