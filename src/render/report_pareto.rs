//! Error against run time of every route, at usual values or at the extremes: the best joined by a line, no label on another.

use crate::figure::{Ink, Label};
use crate::plot::{Axis, Curve, Mark, Plot, draw};
use crate::report::verdict::{nanoseconds, short};
use crate::report::{Report, Route, RouteSummary};

/// The color of a route in every plot.
pub(super) fn ink(route: Route) -> Ink {
    Ink::Curve(route as usize)
}

/// Where the error of a route is taken.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum At {
    /// Largest at usual values.
    Usual,
    /// Over what rounding the data costs, wherever nothing leaves the range of doubles.
    Extremes,
}

/// The plot as SVG; `None` where no route has a time.
pub fn plot(report: &Report, at: At) -> Option<String> {
    let error = |r: &RouteSummary| match at {
        At::Usual => r.usual_max,
        At::Extremes => r.stability,
    };
    let timed = report.routes.iter();
    let timed: Vec<_> = timed.filter(|r| r.seconds[1].is_finite()).collect();
    let time = |seconds: f64| seconds.max(1e-10).log10();
    let times = || timed.iter().map(|r| time(r.seconds[1]));
    let low = times().reduce(f64::min)?.floor();
    let high = times().reduce(f64::max)?.ceil().max(low + 1.0);
    let mut front: Vec<[f64; 2]> = Vec::new();
    let mut marks: Vec<Mark> = Vec::new();
    for route in &timed {
        let at = [time(route.seconds[1]), level(error(route))];
        let faster = |r: &&&RouteSummary| r.seconds[1] < route.seconds[1];
        let beaten = (timed.iter().filter(faster)).any(|r| error(r) <= error(route));
        if !beaten {
            front.push(at);
        }
        marks.push(Mark {
            note: format!(
                "{}: {}, usual values {} ulp, stability factor {}",
                route.words,
                nanoseconds(route.seconds[1]),
                short(route.usual_max),
                short(route.stability)
            ),
            at,
            label: Label::words(route.route.short()),
            ink: ink(route.route),
        });
    }
    front.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let errors = timed.iter().map(|r| level(error(r)));
    let top = errors.fold(2.0, f64::max).ceil();
    let (title, label) = match at {
        At::Usual => (
            "Error at usual values",
            "largest error at usual values [ulp]",
        ),
        At::Extremes => ("Error at the extremes", "largest stability factor"),
    };
    let decades = (low as i32..=high as i32).map(|log| (f64::from(log), decade(log)));
    let step = if top > 5.0 { 4 } else { 1 };
    let errors = (0..=top as i32).step_by(step).map(|k| match k {
        ..4 => (f64::from(k), format!("{}", 10i32.pow(k as u32))),
        _ => (f64::from(k), format!("1e{k}")),
    });
    let plot = Plot {
        title: format!("{title} against run time: {}", report.title),
        x: Axis {
            label: Label::words("median time"),
            range: Some([low, high]),
            ticks: decades.collect(),
        },
        y: Axis {
            label: Label::words(label),
            range: Some([-1.2, top + 0.5]),
            ticks: errors.collect(),
        },
        curves: vec![Curve {
            note: String::new(),
            label: Label::default(),
            points: front,
            ink: Ink::Dimension,
        }],
        marks,
    };
    Some(draw(&plot).ok()?.svg)
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

/// Where an error stands on a logarithmic axis that ends at 10¹⁷ for ∞.
pub(super) fn level(ulps: f64) -> f64 {
    ulps.clamp(0.1, 1e17).log10()
}
