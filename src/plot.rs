//! Curves of a quantity against a parameter, drawn on the sheet of a figure.
//!
//! In: plain data, that is sampled points, labels, marked points. Out: a picture as SVG and TikZ, with its words. Knows nothing
//! of scenes or formulas; whoever calls says which marks are exact.

use crate::figure::{Drawing, Ink, Label, Line, Piece, Room, Sheet, Spot, framed, visible};

/// An axis.
#[derive(Clone, PartialEq, Debug)]
pub struct Axis {
    /// What it measures, with unit, such as `q = ℓ/d` or `v (m/s)`.
    pub label: Label,
    /// Smallest and largest value shown; `None` fits the data.
    pub range: Option<[f64; 2]>,
    /// What stands at which values; where there is nothing, round numbers do.
    pub ticks: Vec<(f64, String)>,
}

/// A sampled curve; points that are not finite leave a gap.
#[derive(Clone, PartialEq, Debug)]
pub struct Curve {
    /// What tells it from the others, such as `m₁/m₂ = 2`.
    pub label: Label,
    /// What it says where it is pointed at; nothing if empty.
    pub note: String,
    /// Points in order of x.
    pub points: Vec<[f64; 2]>,
    /// Its color.
    pub ink: Ink,
}

/// A point worth knowing, such as a zero.
#[derive(Clone, PartialEq, Debug)]
pub struct Mark {
    /// Where.
    pub at: [f64; 2],
    /// What it is, such as `q = 3/4`.
    pub label: Label,
    /// What it says where it is pointed at; nothing if empty.
    pub note: String,
    /// How it is drawn.
    pub ink: Ink,
}

/// Everything a plot shows.
#[derive(Clone, PartialEq, Debug)]
pub struct Plot {
    /// Heading.
    pub title: String,
    /// The parameter.
    pub x: Axis,
    /// The quantity.
    pub y: Axis,
    /// Curves, drawn in this order.
    pub curves: Vec<Curve>,
    /// Marked points.
    pub marks: Vec<Mark>,
}

/// Nothing could be plotted: no curve has a finite point in range.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Empty;

impl std::fmt::Display for Empty {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("there is nothing to plot: no curve has a finite value in range")
    }
}

impl std::error::Error for Empty {}

/// Width and height of the field between the axes, in pixels.
const FIELD: [f64; 2] = [300.0, 205.0];
/// Font sizes: of labels, and of numbers and names of curves.
const LETTERS: [f64; 2] = [15.0, 13.0];
/// Least distance between names of curves, in pixels.
const LINE: f64 = 17.0;

/// Points of a function at `count` equal steps from `from` to `to`.
pub fn sample(f: impl Fn(f64) -> f64, from: f64, to: f64, count: usize) -> Vec<[f64; 2]> {
    let last = count.max(2) - 1;
    (0..=last)
        .map(|i| {
            let x = from + (to - from) * i as f64 / last as f64;
            [x, f(x)]
        })
        .collect()
}

/// Draws a plot.
pub fn draw(plot: &Plot) -> Result<Drawing, Empty> {
    let [x, y] = ranges(plot)?;
    let place = |[a, b]: [f64; 2]| {
        let (u, v) = ((a - x[0]) / (x[1] - x[0]), (b - y[0]) / (y[1] - y[0]));
        [u * FIELD[0], v * FIELD[1]]
    };
    let mut sheet = Sheet::default();
    axes(&mut sheet, plot, [x, y], &place);
    let mut ends: Vec<(f64, usize)> = Vec::new();
    for (i, curve) in plot.curves.iter().enumerate() {
        for piece in pieces(&curve.points, x, y) {
            let path: Vec<[f64; 2]> = piece.into_iter().map(place).collect();
            if let Some(end) = path.last() {
                ends.retain(|(_, k)| *k != i);
                ends.push((FIELD[1] - end[1], i));
            }
            sheet.path(path, false, Line::of(curve.ink), 3.0);
            sheet.note(&curve.note);
        }
    }
    if plot.curves.len() > 1 {
        for (row, i) in spread(ends, FIELD[1]) {
            let [edge, high] = [FIELD[0], FIELD[1] - row];
            let dash = Line {
                width: 3.0,
                ..Line::of(plot.curves[i].ink)
            };
            sheet.segment([edge + 4.0, high], [edge + 12.0, high], dash, 1.0);
            let label = plot.curves[i].label.clone();
            sheet.put(label, LETTERS[1], [edge + 16.0, high], [0.0, 0.5]);
        }
    }
    let within =
        |m: &&Mark| m.at[0] >= x[0] && m.at[0] <= x[1] && m.at[1] >= y[0] && m.at[1] <= y[1];
    for mark in plot.marks.iter().filter(within) {
        let at = place(mark.at);
        sheet.dot(at, 3.5, mark.ink);
        sheet.note(&mark.note);
        let spot = Spot::point(at, [0.7, 0.7], 5.0);
        sheet.wish(mark.label.clone(), LETTERS[1], spot);
    }
    // What is marked is named within the field.
    let [wide, high] = FIELD;
    let far = 1e3;
    let outside = [
        [[-far, -far], [wide + far, -1.0]],
        [[-far, high + 1.0], [wide + far, high + far]],
        [[-far, -far], [-1.0, high + far]],
        [[wide + 1.0, -far], [wide + far, high + far]],
    ];
    sheet
        .kept
        .extend(outside.map(|[low, high]| Room { low, high }));
    sheet.settle();
    let texts = |labels: &mut dyn Iterator<Item = &Label>| {
        let texts = labels.filter(|l| !l.runs.is_empty()).map(Label::text);
        texts.collect::<Vec<_>>().join("; ")
    };
    let mut alternative = format!("{} against {}.", plot.y.label.text(), plot.x.label.text());
    for (lead, all) in [
        ("Curves", texts(&mut plot.curves.iter().map(|c| &c.label))),
        ("Marked", texts(&mut plot.marks.iter().map(|m| &m.label))),
    ] {
        if !all.is_empty() {
            alternative.push_str(&format!(" {lead}: {all}."));
        }
    }
    let caption = vec![Piece::Words(visible(&plot.title))];
    Ok(framed(sheet, &plot.title, caption, &alternative))
}

/// Axes with their numbers, the lines they stand at, and what is measured.
fn axes(
    sheet: &mut Sheet,
    plot: &Plot,
    [x, y]: [[f64; 2]; 2],
    place: &dyn Fn([f64; 2]) -> [f64; 2],
) {
    let fine = |ink| Line {
        width: 0.8,
        ..Line::of(ink)
    };
    let mut depth: f64 = 0.0;
    for (at, words) in ticks(&plot.x, x) {
        let [foot, head] = [place([at, y[0]]), place([at, y[1]])];
        sheet.segment(foot, head, fine(Ink::Grid), 0.0);
        let room = sheet.put(
            Label::words(&words),
            LETTERS[1],
            [foot[0], -4.0],
            [0.5, 1.0],
        );
        depth = depth.min(room.low[1]);
    }
    for (at, words) in ticks(&plot.y, y) {
        let [foot, head] = [place([x[0], at]), place([x[1], at])];
        let ink = if at == 0.0 && plot.y.ticks.is_empty() {
            Ink::Dimension
        } else {
            Ink::Grid
        };
        sheet.segment(foot, head, fine(ink), 0.0);
        sheet.put(
            Label::words(&words),
            LETTERS[1],
            [-5.0, foot[1]],
            [1.0, 0.5],
        );
    }
    let corners = vec![[0.0, FIELD[1]], [0.0, 0.0], [FIELD[0], 0.0]];
    sheet.path(corners, false, fine(Ink::Dimension), 1.0);
    let below = [FIELD[0] / 2.0, depth - 3.0];
    sheet.put(plot.x.label.clone(), LETTERS[0], below, [0.5, 1.0]);
    // The quantity stands above its axis, upright.
    let above = [-30.0, FIELD[1] + 7.0];
    sheet.put(plot.y.label.clone(), LETTERS[0], above, [0.0, 0.0]);
}

/// What the axes show.
fn ranges(plot: &Plot) -> Result<[[f64; 2]; 2], Empty> {
    let finite = |p: &&[f64; 2]| p.iter().all(|v| v.is_finite() && v.abs() < 1e12);
    let points = || {
        plot.curves
            .iter()
            .flat_map(|c| c.points.iter())
            .filter(finite)
    };
    let x = range(&plot.x, points().map(|p| p[0]), 0.0).ok_or(Empty)?;
    let inside = points().filter(|p| p[0] >= x[0] && p[0] <= x[1]);
    let marks = plot.marks.iter().map(|m| &m.at).filter(finite);
    let y = range(&plot.y, inside.chain(marks).map(|p| p[1]), 0.06).ok_or(Empty)?;
    Ok([x, y])
}

/// What stands along an axis: about five round numbers, unless the axis has its own.
fn ticks(axis: &Axis, range: [f64; 2]) -> Vec<(f64, String)> {
    if !axis.ticks.is_empty() {
        return axis.ticks.clone();
    }
    let span = range[1] - range[0];
    let power = 10.0_f64.powf((span / 5.0).log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|k| k * power)
        .find(|step| span / step <= 6.0)
        .unwrap_or(span);
    let first = (range[0] / step - 1e-9).ceil() as i64;
    let last = (range[1] / step + 1e-9).floor() as i64;
    (first..=last.min(first + 20))
        .map(|k| k as f64 * step)
        .map(|value| (value, tick(value, span)))
        .collect()
}

/// Names of curves in the same order, at least one line of text apart, the last one no lower than `lowest`.
fn spread(mut rows: Vec<(f64, usize)>, lowest: f64) -> Vec<(f64, usize)> {
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    for k in 1..rows.len() {
        rows[k].0 = rows[k].0.max(rows[k - 1].0 + LINE);
    }
    let mut limit = lowest;
    for row in rows.iter_mut().rev() {
        row.0 = row.0.min(limit);
        limit = row.0 - LINE;
    }
    rows
}

/// Runs of points inside the range; a curve that leaves it is cut at the edge.
fn pieces(points: &[[f64; 2]], x: [f64; 2], y: [f64; 2]) -> Vec<Vec<[f64; 2]>> {
    let mut all = vec![Vec::new()];
    let inside = |p: &[f64; 2]| p[0] >= x[0] && p[0] <= x[1] && p[1] >= y[0] && p[1] <= y[1];
    for (k, p) in points.iter().enumerate() {
        let cut = |q: &[f64; 2]| {
            // Where the segment from inside point p to outside point q meets the upper or lower edge.
            let edge = if q[1] > y[1] { y[1] } else { y[0] };
            let t = (edge - p[1]) / (q[1] - p[1]);
            [p[0] + (q[0] - p[0]) * t, edge]
        };
        let crosses = |q: &&[f64; 2]| {
            q.iter().all(|v| v.is_finite())
                && (q[1] > y[1] || q[1] < y[0])
                && q[0] >= x[0]
                && q[0] <= x[1]
        };
        if !inside(p) {
            all.push(Vec::new());
            continue;
        }
        let before = if k > 0 {
            points.get(k - 1).filter(crosses)
        } else {
            None
        };
        let after = points.get(k + 1).filter(crosses);
        if let Some(piece) = all.last_mut() {
            piece.extend(before.map(cut));
            piece.push(*p);
            piece.extend(after.map(cut));
        }
    }
    all.retain(|piece| !piece.is_empty());
    all
}

fn range(axis: &Axis, values: impl Iterator<Item = f64>, margin: f64) -> Option<[f64; 2]> {
    if let Some([low, high]) = axis.range {
        return (low.is_finite() && high.is_finite() && low < high).then_some([low, high]);
    }
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| {
        (l.min(v), h.max(v))
    });
    if low > high {
        return None;
    }
    let span = if high > low {
        high - low
    } else {
        low.abs().max(1.0)
    };
    let pad = if high > low {
        margin * span
    } else {
        0.5 * span
    };
    Some([low - pad, high + pad])
}

/// A number at a tick; what is nothing against the span of the axis is 0.
fn tick(value: f64, span: f64) -> String {
    let value = if value.abs() < 1e-9 * span {
        0.0
    } else {
        value
    };
    let text = if value != 0.0 && (value.abs() >= 1e5 || value.abs() < 1e-3) {
        format!("{value:.1e}")
    } else {
        format!("{value:.3}")
    };
    let text = match text.contains(['e', '.']) {
        true if !text.contains('e') => text.trim_end_matches('0').trim_end_matches('.').to_string(),
        _ => text,
    };
    if text == "-0" {
        "0".to_string()
    } else {
        text.replace('-', "−")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The hinge impulse of a struck bar against the place of the blow (book, fig. 17.88).
    fn hinge() -> Plot {
        let curves = [(0, 0.25), (1, 1.0), (2, 4.0)]
            .map(|(i, ratio)| Curve {
                note: String::new(),
                ink: Ink::Curve(i),
                label: Label::words(&format!("m₁/m₂ = {ratio}")),
                points: sample(
                    |q| (3.0 - 4.0 * q) / (3.0 * ratio + 4.0 * q * q) * q,
                    0.3,
                    2.0,
                    200,
                ),
            })
            .to_vec();
        Plot {
            title: "Hinge impulse <script>".to_string(),
            x: Axis {
                label: Label::words("q = ℓ/d"),
                range: None,
                ticks: Vec::new(),
            },
            y: Axis {
                label: Label::latex("P_A/(m_1\\ v)"),
                range: None,
                ticks: Vec::new(),
            },
            curves,
            marks: vec![Mark {
                note: String::new(),
                at: [0.75, 0.0],
                label: Label::words("q = 3/4"),
                ink: Ink::Body,
            }],
        }
    }

    #[test]
    fn a_plot_is_well_formed_and_the_same_twice() {
        let drawing = draw(&hinge()).expect("data in range");
        let svg = &drawing.svg;
        let document = roxmltree::Document::parse(svg).expect("XML");
        let said: String = document.descendants().filter_map(|n| n.text()).collect();
        for text in ["q = 3/4", "q = ℓ/d", "A", "m₁/m₂ = 4", "<script>"] {
            assert!(said.contains(text), "{text}");
        }
        assert!(!svg.contains("NaN") && !svg.contains("<script"));
        assert_eq!(draw(&hinge()), Ok(drawing));
    }

    #[test]
    fn no_finite_value_is_a_fault_and_a_pole_is_a_gap() {
        let mut plot = hinge();
        plot.curves = vec![Curve {
            note: String::new(),
            label: Label::default(),
            points: vec![[0.0, f64::NAN]],
            ink: Ink::Curve(0),
        }];
        plot.marks.clear();
        assert_eq!(draw(&plot), Err(Empty));
        plot.y.range = Some([-10.0, 10.0]);
        plot.curves[0].points = sample(|x| 1.0 / x, -1.0, 1.0, 101);
        assert!(draw(&plot).is_ok_and(|d| !d.svg.contains("inf") && !d.svg.contains("NaN")));
        assert_eq!(
            pieces(&plot.curves[0].points, [-1.0, 1.0], [-10.0, 10.0]).len(),
            2
        );
    }
}
