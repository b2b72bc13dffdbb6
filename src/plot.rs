//! Curves of a quantity against a parameter, as SVG.
//!
//! In: plain data, that is sampled points, labels, marked points. Out: SVG that reads on light and dark paper. Knows nothing of
//! scenes or formulas; whoever calls says which marks are exact.

use crate::figure;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// An axis.
#[derive(Clone, PartialEq, Debug)]
pub struct Axis {
    /// What it measures, with unit, such as `q = ℓ/d` or `v (m/s)`.
    pub label: String,
    /// Smallest and largest value shown; `None` fits the data.
    pub range: Option<[f64; 2]>,
}

/// A sampled curve; points that are not finite leave a gap.
#[derive(Clone, PartialEq, Debug)]
pub struct Curve {
    /// What tells it from the others, such as `m₁/m₂ = 2`.
    pub label: String,
    /// Points in order of x.
    pub points: Vec<[f64; 2]>,
}

/// A point worth knowing, such as a zero.
#[derive(Clone, PartialEq, Debug)]
pub struct Mark {
    /// Where.
    pub at: [f64; 2],
    /// What it is, such as `q = 3/4`.
    pub label: String,
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

/// Why nothing could be plotted.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum PlotFault {
    /// No curve has a finite point in range.
    Empty,
    /// The plotting library failed; its message.
    Backend(String),
}

impl std::fmt::Display for PlotFault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            PlotFault::Empty => {
                f.write_str("there is nothing to plot: no curve has a finite value in range")
            }
            PlotFault::Backend(message) => f.write_str(message),
        }
    }
}

impl std::error::Error for PlotFault {}

/// Size in pixels.
const SIZE: (u32, u32) = (380, 290);
/// Plotters rounds to whole pixels, so it draws on a sheet this many times larger.
const FINE: i32 = 8;
/// Stands for the page's text color until the SVG is written; plotters knows fixed colors only.
const INK: RGBColor = RGBColor(1, 2, 3);
const INK_WRITTEN: &str = "#010203";
/// Middle tones that read on white and on near-black alike.
const COLORS: [RGBColor; 6] = [
    RGBColor(47, 129, 214),
    RGBColor(217, 83, 74),
    RGBColor(46, 150, 95),
    RGBColor(176, 110, 205),
    RGBColor(196, 128, 28),
    RGBColor(20, 150, 160),
];
const STYLE: &str =
    "<style>@media (prefers-color-scheme:dark){svg.carom-plot:root{color:#e6e8eb}}</style>";

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

/// The plot as an SVG document.
pub fn curve(plot: &Plot) -> Result<String, PlotFault> {
    let [x, y] = ranges(plot)?;
    let mut svg = String::new();
    {
        let size = (SIZE.0 * FINE as u32, SIZE.1 * FINE as u32);
        let root = SVGBackend::with_string(&mut svg, size).into_drawing_area();
        draw(plot, x, y, &root).map_err(|e| PlotFault::Backend(e.to_string()))?;
        root.present()
            .map_err(|e| PlotFault::Backend(e.to_string()))?;
    }
    Ok(finish(&svg, plot))
}

/// What the axes show.
fn ranges(plot: &Plot) -> Result<[[f64; 2]; 2], PlotFault> {
    let finite = |p: &&[f64; 2]| p.iter().all(|v| v.is_finite() && v.abs() < 1e12);
    let points = || {
        plot.curves
            .iter()
            .flat_map(|c| c.points.iter())
            .filter(finite)
    };
    let x = range(&plot.x, points().map(|p| p[0]), 0.0).ok_or(PlotFault::Empty)?;
    let inside = points().filter(|p| p[0] >= x[0] && p[0] <= x[1]);
    let marks = plot.marks.iter().map(|m| &m.at).filter(finite);
    let y = range(&plot.y, inside.chain(marks).map(|p| p[1]), 0.06).ok_or(PlotFault::Empty)?;
    Ok([x, y])
}

/// The plot as TikZ, for documents that set their figures with their own fonts.
pub fn tikz(plot: &Plot) -> Result<String, PlotFault> {
    let [x, y] = ranges(plot)?;
    let (wide, high) = (190.0, 130.0);
    let place = |p: (f64, f64)| {
        let (u, v) = ((p.0 - x[0]) / (x[1] - x[0]), (p.1 - y[0]) / (y[1] - y[0]));
        format!("({:.2},{:.2})", u * wide, v * high)
    };
    let words = |text: &str| figure::Label::latex(&shown(text).replace(' ', "\\ ")).to_latex();
    let mut out = String::from("\\begin{tikzpicture}[x=1bp,y=1bp,font=\\footnotesize]\n");
    for at in ticks(x) {
        let (foot, head) = (place((at, y[0])), place((at, y[1])));
        out.push_str(&format!("\\draw[dimension!35] {foot}--{head};\n"));
        let number = tick(at, x[1] - x[0]).replace('−', "-");
        out.push_str(&format!("\\node[below] at {foot} {{${number}$}};\n"));
    }
    for at in ticks(y) {
        let (foot, head) = (place((x[0], at)), place((x[1], at)));
        let style = if at == 0.0 {
            "dimension"
        } else {
            "dimension!35"
        };
        out.push_str(&format!("\\draw[{style}] {foot}--{head};\n"));
        let number = tick(at, y[1] - y[0]).replace('−', "-");
        out.push_str(&format!("\\node[left] at {foot} {{${number}$}};\n"));
    }
    out.push_str(&format!(
        "\\draw[dimension] (0,{high})--(0,0)--({wide},0);\n"
    ));
    out.push_str(&format!(
        "\\node[below] at ({:.0},-12) {{${}$}};\n",
        wide / 2.0,
        words(&plot.x.label)
    ));
    out.push_str(&format!(
        "\\node[above right,inner xsep=0pt] at (-16,{high}) {{${}$}};\n",
        words(&plot.y.label)
    ));
    let mut ends: Vec<(i32, usize)> = Vec::new();
    for (i, curve) in plot.curves.iter().enumerate() {
        let RGBColor(r, g, b) = COLORS[i % COLORS.len()];
        out.push_str(&format!("\\definecolor{{curve}}{{RGB}}{{{r},{g},{b}}}\n"));
        for piece in pieces(&curve.points, x, y) {
            if let Some(end) = piece.last() {
                ends.retain(|(_, k)| *k != i);
                let row = (1.0 - (end.1 - y[0]) / (y[1] - y[0])) * f64::from(SIZE.1 as i32 * FINE);
                ends.push((row as i32, i));
            }
            let path: Vec<String> = piece.into_iter().map(place).collect();
            out.push_str(&format!(
                "\\draw[curve,line width=1.2bp] {};\n",
                path.join("--")
            ));
        }
    }
    if plot.curves.len() > 1 {
        for (row, i) in spread(ends, SIZE.1 as i32 * FINE) {
            let RGBColor(r, g, b) = COLORS[i % COLORS.len()];
            let up = (1.0 - f64::from(row) / f64::from(SIZE.1 as i32 * FINE)) * high;
            out.push_str(&format!("\\definecolor{{curve}}{{RGB}}{{{r},{g},{b}}}\n"));
            out.push_str(&format!(
                "\\node[right,curve] at ({wide},{up:.1}) {{${}$}};\n",
                words(&plot.curves[i].label)
            ));
        }
    }
    for mark in plot
        .marks
        .iter()
        .filter(|m| m.at[0] >= x[0] && m.at[0] <= x[1])
    {
        let spot = place((mark.at[0], mark.at[1]));
        let label = words(&mark.label);
        out.push_str(&format!(
            "\\fill {spot} circle[radius=2] node[below right] {{${label}$}};\n"
        ));
    }
    out.push_str("\\end{tikzpicture}\n");
    Ok(out)
}

/// Round numbers inside a range, about five of them.
fn ticks(range: [f64; 2]) -> Vec<f64> {
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
        .collect()
}

type Fallible = Result<(), std::boxed::Box<dyn std::error::Error>>;

fn draw(plot: &Plot, x: [f64; 2], y: [f64; 2], root: &DrawingArea<SVGBackend, Shift>) -> Fallible {
    let text = |size: i32| ("serif", size * FINE).into_font().color(&INK);
    let wide = FINE as u32;
    let longest = plot
        .curves
        .iter()
        .map(|c| shown(&c.label).chars().count())
        .max()
        .unwrap_or(0);
    let right = if plot.curves.len() > 1 {
        (22 + 8 * longest as u32).min(160)
    } else {
        14
    };
    let mut chart = ChartBuilder::on(root)
        .margin(6 * FINE)
        .margin_right(right as i32 * FINE)
        .margin_top(36 * FINE)
        .x_label_area_size(46 * FINE)
        .y_label_area_size(46 * FINE)
        .build_cartesian_2d(x[0]..x[1], y[0]..y[1])?;
    let grid = RGBColor(133, 139, 147);
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(grid.mix(0.25).stroke_width(wide))
        .axis_style(grid.stroke_width(wide))
        .set_all_tick_mark_size(4 * FINE)
        .x_labels(6)
        .y_labels(6)
        .x_desc(shown(&plot.x.label))
        .axis_desc_style(text(20))
        .label_style(text(17))
        .x_label_formatter(&|v| tick(*v, x[1] - x[0]))
        .y_label_formatter(&|v| tick(*v, y[1] - y[0]))
        .draw()?;
    // The quantity stands above its axis, upright.
    root.draw(&Text::new(
        shown(&plot.y.label),
        (10 * FINE, 10 * FINE),
        text(20),
    ))?;
    if y[0] < 0.0 && y[1] > 0.0 {
        chart.draw_series(LineSeries::new(
            [(x[0], 0.0), (x[1], 0.0)],
            grid.stroke_width(wide),
        ))?;
    }
    let mut ends: Vec<(i32, usize)> = Vec::new();
    for (i, curve) in plot.curves.iter().enumerate() {
        let color = COLORS[i % COLORS.len()];
        for piece in pieces(&curve.points, x, y) {
            if let Some(end) = piece.last() {
                let (_, row) = chart.backend_coord(end);
                ends.retain(|(_, k)| *k != i);
                ends.push((row, i));
            }
            chart.draw_series(LineSeries::new(piece, color.stroke_width(2 * wide)))?;
        }
    }
    if plot.curves.len() > 1 {
        let (edge, _) = chart.backend_coord(&(x[1], y[0]));
        for (row, i) in spread(ends, (SIZE.1 as i32 - 62) * FINE) {
            let color = COLORS[i % COLORS.len()];
            let dash = vec![(edge + 4 * FINE, row), (edge + 13 * FINE, row)];
            root.draw(&PathElement::new(dash, color.stroke_width(3 * wide)))?;
            let style = text(17).pos(Pos::new(HPos::Left, VPos::Center));
            root.draw(&Text::new(
                shown(&plot.curves[i].label),
                (edge + 16 * FINE, row),
                style,
            ))?;
        }
    }
    let within =
        |m: &&Mark| m.at[0] >= x[0] && m.at[0] <= x[1] && m.at[1] >= y[0] && m.at[1] <= y[1];
    for mark in plot.marks.iter().filter(within) {
        let at = (mark.at[0], mark.at[1]);
        chart.draw_series([Circle::new(at, 4 * FINE, INK.filled())])?;
        let spot = chart.backend_coord(&at);
        let area = chart.plotting_area().get_pixel_range();
        let corner = emptiest(plot, &area, spot, &|p| chart.backend_coord(&p), &mark.label);
        root.draw(&Text::new(shown(&mark.label), corner, text(19)))?;
    }
    Ok(())
}

/// Upper left corner for a mark's label, where fewest points of curves lie.
fn emptiest(
    plot: &Plot,
    area: &(std::ops::Range<i32>, std::ops::Range<i32>),
    at: (i32, i32),
    place: &dyn Fn((f64, f64)) -> (i32, i32),
    label: &str,
) -> (i32, i32) {
    let (w, h) = (8 * FINE * label.chars().count() as i32, 16 * FINE);
    let mut best = ((at.0 + 8, at.1 - h - 6), i64::MAX);
    for gap in [8 * FINE, 20 * FINE, 36 * FINE] {
        for (dx, dy) in [
            (gap, -h - gap),
            (gap, gap),
            (-w - gap, -h - gap),
            (-w - gap, gap),
            (-w / 2, -h - gap - 4 * FINE),
            (-w / 2, gap + 4 * FINE),
        ] {
            let corner = (at.0 + dx, at.1 + dy);
            let inside = |p: (i32, i32)| {
                p.0 > corner.0 - 4 * FINE
                    && p.0 < corner.0 + w + 4 * FINE
                    && p.1 > corner.1 - 3 * FINE
                    && p.1 < corner.1 + h + 3 * FINE
            };
            let on_curves = plot
                .curves
                .iter()
                .flat_map(|c| &c.points)
                .filter(|p| p.iter().all(|v| v.is_finite()))
                .filter(|p| inside(place((p[0], p[1]))))
                .count() as i64;
            let out = corner.0 < area.0.start
                || corner.0 + w > area.0.end
                || corner.1 < area.1.start
                || corner.1 + h > area.1.end;
            let cost = on_curves * 10 + i64::from(gap / FINE) + if out { 10_000 } else { 0 };
            if cost < best.1 {
                best = (corner, cost);
            }
        }
    }
    best.0
}

/// Rows in the same order, at least one line of text apart.
fn spread(mut rows: Vec<(i32, usize)>, lowest: i32) -> Vec<(i32, usize)> {
    const LINE: i32 = 17 * FINE;
    rows.sort();
    for k in 1..rows.len() {
        rows[k].0 = rows[k].0.max(rows[k - 1].0 + LINE);
    }
    let over = rows.last().map_or(0, |r| r.0 - lowest).max(0);
    if over > 0 {
        let mut limit = lowest;
        for row in rows.iter_mut().rev() {
            row.0 = row.0.min(limit);
            limit = row.0 - LINE;
        }
    }
    rows
}

/// Runs of points inside the range; a curve that leaves it is cut at the edge.
fn pieces(points: &[[f64; 2]], x: [f64; 2], y: [f64; 2]) -> Vec<Vec<(f64, f64)>> {
    let mut all = vec![Vec::new()];
    let inside = |p: &[f64; 2]| p[0] >= x[0] && p[0] <= x[1] && p[1] >= y[0] && p[1] <= y[1];
    for (k, p) in points.iter().enumerate() {
        let cut = |q: &[f64; 2]| {
            // Where the segment from inside point p to outside point q meets the upper or lower edge.
            let edge = if q[1] > y[1] { y[1] } else { y[0] };
            let t = (edge - p[1]) / (q[1] - p[1]);
            (p[0] + (q[0] - p[0]) * t, edge)
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
            piece.push((p[0], p[1]));
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

/// Text without control or direction characters, of bounded length.
fn shown(text: &str) -> String {
    crate::figure::visible(text).chars().take(60).collect()
}

/// The page's ink, a name, and words for who cannot see the plot.
fn finish(svg: &str, plot: &Plot) -> String {
    let marks: Vec<&str> = plot.marks.iter().map(|m| m.label.as_str()).collect();
    let curves: Vec<&str> = plot.curves.iter().map(|c| c.label.as_str()).collect();
    let mut words = format!(
        "{} against {}. Curves: {}.",
        plot.y.label,
        plot.x.label,
        curves.join("; ")
    );
    if !marks.is_empty() {
        words.push_str(&format!(" Marked: {}.", marks.join("; ")));
    }
    let head = format!(
        "<title>{}</title>\n<desc>{}</desc>\n{STYLE}\n",
        crate::figure::escape(&plot.title),
        crate::figure::escape(&words)
    );
    let svg = svg.replace(INK_WRITTEN, "currentColor");
    let body = svg
        .split_once("<svg ")
        .and_then(|(_, rest)| rest.split_once('>'))
        .map_or("", |(_, body)| body);
    let (w, h) = SIZE;
    let (wide, high) = (w * FINE as u32, h * FINE as u32);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"carom-plot\" role=\"img\" width=\"{w}\" height=\"{h}\" \
         viewBox=\"0 0 {wide} {high}\">\n{head}"
    );
    // Plotters writes each text on a line of its own.
    for line in body.lines().filter(|l| !l.is_empty()) {
        if line.starts_with('<') {
            out.push_str(line)
        } else {
            out.push_str(&indexed(line))
        }
        out.push('\n');
    }
    out
}

/// Sets `_A` and `_{G1}` in a line of text as an index.
fn indexed(line: &str) -> String {
    let mut out = String::new();
    let mut rest = line;
    while let Some((before, after)) = rest.split_once('_') {
        out.push_str(before);
        let (index, tail) = match after.strip_prefix('{').and_then(|a| a.split_once('}')) {
            Some(parts) => parts,
            None => after.split_at(
                after
                    .find(|c: char| !c.is_alphanumeric())
                    .unwrap_or(after.len()),
            ),
        };
        let drop = 4 * FINE;
        if index.is_empty() || index.contains(['<', '>', '&']) {
            out.push('_');
            rest = after;
            continue;
        }
        out.push_str(&format!(
            "<tspan dy=\"{drop}\" font-size=\"70%\">{index}</tspan><tspan dy=\"-{drop}\">"
        ));
        out.push_str(&indexed(tail));
        out.push_str("</tspan>");
        return out;
    }
    out.push_str(rest);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The hinge impulse of a struck bar against the place of the blow (book, fig. 17.88).
    fn hinge() -> Plot {
        let curves = [0.25, 1.0, 4.0]
            .map(|ratio| Curve {
                label: format!("m₁/m₂ = {ratio}"),
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
                label: "q = ℓ/d".to_string(),
                range: None,
            },
            y: Axis {
                label: "P_A/(m₁ v)".to_string(),
                range: None,
            },
            curves,
            marks: vec![Mark {
                at: [0.75, 0.0],
                label: "q = 3/4".to_string(),
            }],
        }
    }

    #[test]
    fn a_plot_is_well_formed_and_the_same_twice() {
        let svg = curve(&hinge()).expect("data in range");
        let document = roxmltree::Document::parse(&svg).expect("XML");
        let said: String = document.descendants().filter_map(|n| n.text()).collect();
        for text in ["q = 3/4", "q = ℓ/d", "/(m₁ v)", "m₁/m₂ = 4", "<script>"] {
            assert!(said.contains(text), "{text}");
        }
        assert!(!svg.contains("NaN") && !svg.contains("<script") && !svg.contains(INK_WRITTEN));
        assert_eq!(curve(&hinge()), Ok(svg));
    }

    #[test]
    fn no_finite_value_is_a_fault_and_a_pole_is_a_gap() {
        let mut plot = hinge();
        plot.curves = vec![Curve {
            label: String::new(),
            points: vec![[0.0, f64::NAN]],
        }];
        plot.marks.clear();
        assert_eq!(curve(&plot), Err(PlotFault::Empty));
        plot.y.range = Some([-10.0, 10.0]);
        plot.curves[0].points = sample(|x| 1.0 / x, -1.0, 1.0, 101);
        assert!(curve(&plot).is_ok_and(|svg| !svg.contains("inf") && !svg.contains("NaN")));
        assert_eq!(
            pieces(&plot.curves[0].points, [-1.0, 1.0], [-10.0, 10.0]).len(),
            2
        );
    }
}
