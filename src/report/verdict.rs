//! What the numbers of a report say: who is dominated, which route to use, which known findings show.
//!
//! In: a measured report. Out: the same with its judgements; every figure in them is read from the report.

use serde::Serialize;

use super::measure::{Report, Row, Swept, digits_lost};
use super::routes::{Quantity, Route};

/// A known finding and what this report says of it.
#[derive(Clone, Debug, Serialize)]
pub struct Finding {
    /// The claim.
    pub claim: String,
    /// Whether it shows here.
    pub holds: bool,
    /// The figures.
    pub evidence: String,
}

/// An error up to which a route counts as accurate \[ulp\]: sixteen units leave fifteen digits.
const ACCURATE: f64 = 16.0;

/// Fills in dominance, findings and verdict.
pub fn judge(report: &mut Report, quantities: &[Quantity]) {
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
    report.findings = findings(report, quantities);
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

fn worst(
    row: &Row,
    of: impl Fn(Route) -> bool,
    figure: impl Fn(&super::measure::Cell) -> f64,
) -> Option<f64> {
    row.cells
        .iter()
        .filter(|c| of(c.route))
        .map(figure)
        .reduce(f64::max)
}

fn over(
    family: &Swept,
    of: impl Fn(Route) -> bool + Copy,
    figure: impl Fn(&super::measure::Cell) -> f64 + Copy,
) -> Option<f64> {
    family
        .rows
        .iter()
        .filter_map(|r| worst(r, of, figure))
        .reduce(f64::max)
}

fn findings(report: &Report, quantities: &[Quantity]) -> Vec<Finding> {
    let mut out = Vec::new();
    let family = |name: &str| report.families.iter().find(|f| f.name == name);
    let mut say = |claim: &str, holds: bool, evidence: String| {
        out.push(Finding {
            claim: claim.into(),
            holds,
            evidence,
        })
    };
    let ulp = |c: &super::measure::Cell| c.max;
    let factor = |c: &super::measure::Cell| c.stability;
    if let Some(f) = family("mass ratio") {
        let worst = over(f, |r| r == Route::LuRaw, factor).unwrap_or(0.0);
        let all = over(f, Route::is_plain, factor).unwrap_or(0.0);
        say(
            "mass ratios of 1e±15 are harmless: no plain route loses more than the data themselves do",
            all <= 64.0,
            format!(
                "largest stability factor {} by LU, {} by any plain route",
                short(worst),
                short(all)
            ),
        );
    }
    if let (Some(f), true) = (
        family("radius of gyration → 0"),
        report
            .routes
            .iter()
            .any(|r| r.route == Route::EffectiveMass),
    ) {
        let mass = over(f, |r| r == Route::EffectiveMass, factor).unwrap_or(0.0);
        if let Some(joints) = over(f, |r| r == Route::AboutJoints, factor) {
            say(
                "as the radius of gyration goes to 0 the effective mass loses (r/k)², angular momentum about the joint stays exact to a few units",
                mass >= 1e6 && joints <= 16.0,
                format!(
                    "stability factor {} by effective mass, {} about the joints",
                    short(mass),
                    short(joints)
                ),
            );
        } else {
            say(
                "without a joint a vanishing radius of gyration does not hurt the effective mass",
                mass <= 64.0,
                format!("stability factor {} by effective mass", short(mass)),
            );
        }
    }
    if let Some(f) = family("dead centre") {
        let of = |route: Route, figure: &dyn Fn(&super::measure::Cell) -> f64| {
            over(f, |r| r == route, |c| figure(c)).unwrap_or(0.0)
        };
        let (raw, joints) = (of(Route::LuRaw, &factor), of(Route::AboutJoints, &factor));
        let near = Swept {
            rows: f.rows.iter().filter(|r| r.x <= 6.0).cloned().collect(),
            ..f.clone()
        };
        let repaired = |route: Route| over(&near, |r| r == route, factor).unwrap_or(0.0);
        let (broken, refined) = (repaired(Route::LuRaw), repaired(Route::LuRefined));
        say(
            "near dead centre the full system loses digits that minimal coordinates keep",
            raw >= 1e3 * joints.max(1.0),
            format!(
                "stability factor {} by LU, {} about the joints",
                short(raw),
                short(joints)
            ),
        );
        say(
            "refinement in plain doubles repairs the full system near dead centre down to φ = 1e−6",
            refined <= 64.0 && broken > 64.0,
            format!(
                "stability factor {} by LU, {} with three steps of refinement",
                short(broken),
                short(refined)
            ),
        );
    }
    if let Some(f) = family("e → 1").filter(|_| quantities.iter().any(|q| q.is_loss)) {
        let derived = over(f, |r| r == Route::ClosedForm, ulp).unwrap_or(0.0);
        let arranged = over(f, |r| r == Route::Arranged, ulp).unwrap_or(0.0);
        say(
            "towards e = 1 an energy loss with 1 − e² loses digits, with (1 − e)(1 + e) it does not",
            derived >= 1e3 && arranged <= ACCURATE,
            format!(
                "{} ulp as derived, {} ulp arranged",
                short(derived),
                short(arranged)
            ),
        );
    }
    for f in report
        .families
        .iter()
        .filter(|f| f.name == "near grazing" || f.name.starts_with("stop"))
    {
        let plain = over(f, Route::is_plain, ulp).unwrap_or(0.0);
        let least = report
            .routes
            .iter()
            .filter(|r| r.route.is_plain())
            .filter_map(|r| over(f, |x| x == r.route, ulp))
            .reduce(f64::min)
            .unwrap_or(0.0);
        let exact = over(f, |r| r == Route::Exact, ulp).unwrap_or(0.0);
        say(
            &format!(
                "{}: every plain route loses digits, exact fractions none",
                f.name
            ),
            least >= 1e6 && exact <= 0.5,
            format!(
                "between {} and {} ulp by plain routes, {} by fractions",
                short(least),
                short(plain),
                short(exact)
            ),
        );
    }
    for f in report
        .families
        .iter()
        .filter(|f| f.name == "overflow" || f.name == "underflow")
    {
        let lost: Vec<&str> = report
            .routes
            .iter()
            .filter(|r| over(f, |x| x == r.route, ulp).is_some_and(|u| u > 1e6))
            .map(|r| r.words)
            .collect();
        let evidence = if lost.is_empty() {
            "no route is hurt".into()
        } else {
            format!("lost: {}", lost.join(", "))
        };
        say(
            &format!(
                "{}: formulas in the given units leave the range of doubles although the answers lie well inside",
                f.name
            ),
            !lost.is_empty(),
            evidence,
        );
    }
    out
}
