//! Error against run time of every route, as SVG: the best joined by a line, the others grey, no label on another.

use std::fmt::Write;

use super::mathml::escape;
use super::report::level;
use crate::report::Report;

const WIDTH: f64 = 460.0;
const HEIGHT: f64 = 320.0;
/// Left, top, right and bottom of the field.
const FIELD: [f64; 4] = [44.0, 14.0, 436.0, 276.0];
const LETTER: f64 = 6.3;

struct Dot {
    at: [f64; 2],
    label: &'static str,
    best: bool,
}

/// The plot; `None` where no route has a time.
pub fn plot(report: &Report) -> Option<String> {
    let timed: Vec<_> = report
        .routes
        .iter()
        .filter(|r| r.seconds[1].is_finite())
        .collect();
    let times = || timed.iter().map(|r| r.seconds[1].max(1e-10).log10());
    let low = times().reduce(f64::min)?.floor();
    let high = times().reduce(f64::max)?.ceil().max(low + 1.0);
    let x = |log: f64| FIELD[0] + (log - low) / (high - low) * (FIELD[2] - FIELD[0]);
    let y = |level: f64| FIELD[3] - (level + 1.2) / 18.7 * (FIELD[3] - FIELD[1]);
    let mut dots: Vec<Dot> = timed
        .iter()
        .map(|r| Dot {
            at: [x(r.seconds[1].max(1e-10).log10()), y(level(r.worst))],
            label: r.route.short(),
            best: !r.dominated,
        })
        .collect();
    // The best choose their places first, then from left to right.
    dots.sort_by(|a, b| b.best.cmp(&a.best).then(a.at[0].total_cmp(&b.at[0])));
    let mut out = format!(
        "<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" aria-label=\"{}\" font-family=\"system-ui,sans-serif\" font-size=\"11\" fill=\"currentColor\">",
        escape(&format!("Error against run time: {}", report.title))
    );
    axes(&mut out, [low, high], &x, &y);
    let mut front: Vec<[f64; 2]> = dots.iter().filter(|d| d.best).map(|d| d.at).collect();
    front.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let path: Vec<String> = front
        .iter()
        .map(|p| format!("{:.1},{:.1}", p[0], p[1]))
        .collect();
    let _ = write!(
        out,
        "<polyline points=\"{}\" fill=\"none\" stroke=\"rgb(47,129,214)\" stroke-width=\"1.5\"/>",
        path.join(" ")
    );
    let mut taken: Vec<[f64; 4]> = dots
        .iter()
        .map(|d| [d.at[0] - 4.0, d.at[1] - 4.0, d.at[0] + 4.0, d.at[1] + 4.0])
        .collect();
    // No label lies on the line either.
    for pair in front.windows(2) {
        for k in 1..40 {
            let share = f64::from(k) / 40.0;
            let [x, y] = [0, 1].map(|i| pair[0][i] + share * (pair[1][i] - pair[0][i]));
            taken.push([x - 1.0, y - 1.0, x + 1.0, y + 1.0]);
        }
    }
    for dot in &dots {
        let (fill, opacity) = if dot.best {
            ("rgb(47,129,214)", 1.0)
        } else {
            ("currentColor", 0.45)
        };
        let _ = write!(
            out,
            "<g fill-opacity=\"{opacity}\"><circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"3.5\" fill=\"{fill}\"/>",
            dot.at[0], dot.at[1]
        );
        let place = free(dot, &taken);
        text(&mut out, [place[0], place[3] - 3.0], "start", dot.label);
        let beside = [0.5 * (place[0] + place[2]), 0.5 * (place[1] + place[3])];
        if (beside[1] - dot.at[1]).abs() > 16.0 {
            let end = if beside[1] > dot.at[1] {
                place[1] + 2.0
            } else {
                place[3]
            };
            line(
                &mut out,
                [
                    dot.at[0],
                    dot.at[1],
                    beside[0].clamp(place[0], place[2]),
                    end,
                ],
                0.3,
            );
        }
        out.push_str("</g>");
        taken.push(place);
    }
    out.push_str("</svg>");
    Some(out)
}

fn line(out: &mut String, [a, b, c, d]: [f64; 4], faint: f64) {
    let _ = write!(
        out,
        "<line x1=\"{a:.1}\" y1=\"{b:.1}\" x2=\"{c:.1}\" y2=\"{d:.1}\" stroke=\"currentColor\" stroke-opacity=\"{faint}\"/>"
    );
}

fn text(out: &mut String, [a, b]: [f64; 2], anchor: &str, words: &str) {
    let _ = write!(
        out,
        "<text x=\"{a:.1}\" y=\"{b:.1}\" text-anchor=\"{anchor}\">{}</text>",
        escape(words)
    );
}

/// Decades of time from `low` to `high` and of error, with their labels.
fn axes(out: &mut String, [low, high]: [f64; 2], x: &dyn Fn(f64) -> f64, y: &dyn Fn(f64) -> f64) {
    for k in 0..=((high - low) as i32) {
        let log = low + f64::from(k);
        line(out, [x(log), FIELD[1], x(log), FIELD[3]], 0.15);
        text(
            out,
            [x(log), FIELD[3] + 15.0],
            "middle",
            &decade(log as i32),
        );
    }
    for k in [0, 4, 8, 12, 16] {
        let at = y(f64::from(k));
        line(out, [FIELD[0], at, FIELD[2], at], 0.15);
        text(
            out,
            [FIELD[0] - 6.0, at + 4.0],
            "end",
            &match k {
                0 => String::from("1"),
                _ => format!("1e{k}"),
            },
        );
    }
    text(
        out,
        [0.5 * (FIELD[0] + FIELD[2]), HEIGHT - 8.0],
        "middle",
        "median time; worst error [ulp] upwards, ∞ on top",
    );
}

/// A box for the label that lies in the field and on nothing else: beside the dot, else as near as there is room.
fn free(dot: &Dot, taken: &[[f64; 4]]) -> [f64; 4] {
    let width = dot.label.chars().count() as f64 * LETTER;
    let [x, y] = dot.at;
    let mut best = None;
    for step in 0..14 {
        for side in [1.0, -1.0] {
            let top = y - 7.0 + side * 14.0 * f64::from(step);
            for left in [x + 6.0, x - 6.0 - width, x - 0.5 * width] {
                let place = [left, top, left + width, top + 14.0];
                let inside = left >= FIELD[0]
                    && place[2] <= FIELD[2]
                    && top >= FIELD[1] - 12.0
                    && place[3] <= FIELD[3];
                let apart = |t: &[f64; 4]| {
                    place[2] <= t[0] || t[2] <= place[0] || place[3] <= t[1] || t[3] <= place[1]
                };
                if inside && taken.iter().all(apart) {
                    return place;
                }
                best = best.or(inside.then_some(place));
            }
        }
    }
    best.unwrap_or([x, y - 7.0, x + width, y + 7.0])
}

/// A power of ten of a second.
fn decade(log: i32) -> String {
    let (unit, power) = match log {
        ..-6 => ("ns", 9),
        -6..-3 => ("µs", 6),
        -3..0 => ("ms", 3),
        _ => ("s", 0),
    };
    match 10f64.powi(log + power) {
        v if v < 1.0 => format!("{v:.1} {unit}"),
        v => format!("{v:.0} {unit}"),
    }
}
