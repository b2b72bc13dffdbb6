//! What the numbers of a report say: who is dominated, and which route to use.
//!
//! In: a measured report. Out: the same with its judgements; every figure in them is read from the report.

use super::errors::digits_lost;
use super::measure::Report;

/// An error up to which a route counts as accurate \[ulp\]: sixteen units leave fifteen digits.
const ACCURATE: f64 = 16.0;

/// Fills in dominance and verdict.
pub fn judge(report: &mut Report) {
    let figures: Vec<(f64, f64)> = report
        .routes
        .iter()
        .map(|r| (r.seconds[1], r.worst))
        .collect();
    for (i, route) in report.routes.iter_mut().enumerate() {
        let (time, worst) = figures[i];
        route.dominated = figures
            .iter()
            .enumerate()
            .any(|(j, (t, w))| j != i && *t < time && *w <= worst);
    }
    report.verdict = verdict(report);
}

fn verdict(report: &Report) -> String {
    let fastest = |of: &dyn Fn(&super::measure::RouteSummary) -> bool| {
        report
            .routes
            .iter()
            .filter(|r| of(r))
            .min_by(|a, b| a.seconds[1].total_cmp(&b.seconds[1]))
    };
    let Some(quick) = fastest(&|_| true) else {
        return "no route has an answer".into();
    };
    let safe = fastest(&|r| r.worst <= ACCURATE);
    match safe {
        Some(best) if best.route == quick.route => format!(
            "Use {}: it is the fastest route here ({}) and stays within {} ulp on everything measured.",
            advised(best.words),
            nanoseconds(best.seconds[1]),
            short(best.worst)
        ),
        Some(best) => format!(
            "Use {}: {} and within {} ulp on everything measured; {} takes {} but loses up to {:.0} digits ({}).",
            advised(best.words),
            nanoseconds(best.seconds[1]),
            short(best.worst),
            advised(quick.words),
            nanoseconds(quick.seconds[1]),
            digits_lost(quick.worst),
            quick.worst_family
        ),
        None => {
            let calm = report
                .routes
                .iter()
                .min_by(|a, b| a.worst.total_cmp(&b.worst))
                .unwrap_or(quick);
            format!(
                "No route stays within {ACCURATE} ulp everywhere: {} is closest with {} ulp ({}), at {}.",
                advised(calm.words),
                short(calm.worst),
                calm.worst_family,
                nanoseconds(calm.seconds[1])
            )
        }
    }
}

/// A route as a sentence speaks of it.
fn advised(words: &str) -> String {
    match words {
        "about the joints" => "angular momentum about the joints".into(),
        "effective mass" => "effective mass at the joints".into(),
        _ if words.starts_with("exact") => words.into(),
        _ => format!("the {words}"),
    }
}

/// A time in readable units.
pub fn nanoseconds(seconds: f64) -> String {
    match seconds {
        s if !s.is_finite() => "no time".into(),
        s if s < 0.95e-6 => format!("{:.0} ns", s * 1e9),
        s if s < 0.95e-3 => format!("{:.1} µs", s * 1e6),
        s => format!("{:.1} ms", s * 1e3),
    }
}

/// A count of ulps in few characters.
pub fn short(ulps: f64) -> String {
    match ulps {
        u if !u.is_finite() => "∞".into(),
        u if u < 100.0 => format!("{u:.2}"),
        u => format!("{u:.1e}"),
    }
}
