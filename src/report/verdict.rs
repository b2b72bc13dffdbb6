//! What the numbers of a report say: who is dominated, and which route to use.
//!
//! In: a measured report. Out: the same with its judgements; every figure in them is read from the report.

use super::errors::digits_lost;
use super::measure::{Report, RouteSummary};

/// An error up to which a route counts as accurate at usual values \[ulp\]: sixteen units leave fifteen digits.
const ACCURATE: f64 = 16.0;
/// The same for its stability anywhere: it loses no more than a change of the data's last digits by as much would.
const STABLE: f64 = 16.0;

/// Fills in dominance and verdict.
pub fn judge(report: &mut Report) {
    let figures = |r: &RouteSummary| [r.seconds[1], r.usual_max, r.worst];
    let all: Vec<_> = report.routes.iter().map(figures).collect();
    for route in &mut report.routes {
        let [time, usual, worst] = figures(route);
        // One that is better at usual values is not beaten by one that is no worse where both fail.
        let beats = |[t, u, w]: &[f64; 3]| *t < time && *u <= usual && *w <= worst;
        route.dominated = all.iter().any(beats);
    }
    report.verdict = verdict(report);
}

fn verdict(report: &Report) -> String {
    let fastest = |of: &dyn Fn(&RouteSummary) -> bool| {
        let routes = report.routes.iter().filter(|r| of(r));
        routes.min_by(|a, b| a.seconds[1].total_cmp(&b.seconds[1]))
    };
    let Some(quick) = fastest(&|_| true) else {
        return "no route has an answer".into();
    };
    // What no route could keep from rounded data is no fault of a route: near a zero of the answer every one loses digits.
    let sound = fastest(&|r| r.usual_max <= ACCURATE && r.stability <= STABLE);
    let best = sound.unwrap_or_else(|| {
        let calmest = report.routes.iter();
        calmest
            .min_by(|a, b| a.stability.total_cmp(&b.stability))
            .unwrap_or(quick)
    });
    let mut out = format!(
        "Use {}: {}, within {} ulp at usual values",
        advised(best.words),
        nanoseconds(best.seconds[1]),
        short(best.usual_max)
    );
    out.push_str(&match best.worst {
        worst if worst <= ACCURATE => format!(" and {} ulp on everything measured.", short(worst)),
        worst => {
            let (family, steady) = (&best.worst_family, short(best.stability));
            let lost = match worst.is_infinite() {
                true => format!("until something leaves the range of doubles ({family})"),
                false => format!("and loses {:.0} digits at the extremes ({family})", digits_lost(worst)),
            };
            format!("; its error is at most {steady} times what rounding the data by half a unit costs, {lost}.")
        }
    });
    if best.route != quick.route {
        out.push_str(&format!(
            " {} takes {}, with {} ulp at usual values and up to {} times the loss by rounded data.",
            capital(&advised(quick.words)),
            nanoseconds(quick.seconds[1]),
            short(quick.usual_max),
            short(quick.stability)
        ));
    }
    out
}

/// Words at the beginning of a sentence.
fn capital(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map_or(String::new(), |first| {
        first.to_uppercase().chain(letters).collect()
    })
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
