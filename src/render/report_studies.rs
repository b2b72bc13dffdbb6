//! The studies that hang on no scene, as tables for a terminal and as a section of the page. Every figure comes in ready.

use std::fmt::Write;

use super::mathml::escape;
use super::report::{figure, findings};
use crate::plot::{Axis, Curve, Mark, Plot, curve};
use crate::report::batch::{Doubling, Route, Throughput};
use crate::report::growth::{ChainRoute, Growth, Pose};
use crate::report::stiff::{Contact, End, Ground, Integrator, Restitution, Run, Variables};
use crate::report::studies::{Studies, millions, route_words};
use crate::report::verdict::nanoseconds;

/// The tables for a terminal.
pub fn text(studies: &Studies) -> String {
    let mut out = String::from("Studies that hang on no scene\n\nwhat the numbers say:\n");
    for f in &studies.findings {
        let mark = if f.holds { "shown" } else { "not shown" };
        let _ = writeln!(out, "  {mark}: {} — {}", f.claim, f.evidence);
    }
    let stiff = &studies.stiff;
    let shown = |r: &&Run| {
        let held = r.collision.ground == Ground::Grip;
        matches!(r.integrator, Integrator::Dopri5 | Integrator::Radau5)
            && (held || r.tolerance == 1e-8)
    };
    if stiff.runs.iter().any(|r| shown(&r)) {
        let _ = writeln!(
            out,
            "\nrod at {} rad on ground that gives way, F = K d^p, or held by spring and dashpot (all runs are in the JSON and on the page)",
            stiff.angle
        );
        let _ = writeln!(
            out,
            "  {:>4} {:>6} {:9} {:7} {:>6} {:>8} {:>9} {:>10} {:>10}  end",
            "p", "K", "method", "in", "tol", "steps", "time", "from rigid", "energy"
        );
        for r in stiff.runs.iter().filter(shown) {
            let _ = writeln!(out, "  {}", run_row(r).join(" "));
        }
    }
    for l in &stiff.limits {
        let errors: Vec<String> = l.errors.iter().map(|e| format!("{e:.0e}")).collect();
        let _ = writeln!(
            out,
            "\nRichardson's limit, p = {}: error after 1, 2, … stiffnesses {}",
            l.exponent,
            errors.join(", ")
        );
    }
    if !stiff.restitution.is_empty() {
        let _ = writeln!(
            out,
            "\n{:44} {:>9} {:>9} {:>8}",
            "contact with losses", "formula", "integral", "error"
        );
        for r in &stiff.restitution {
            let _ = writeln!(
                out,
                "  {:42} {:>9.6} {:>9.6} {:>8.0e}",
                contact_words(r.contact),
                r.formula,
                r.integrated,
                r.error
            );
        }
    }
    if !stiff.step_matrix.is_empty() {
        let _ = writeln!(
            out,
            "\ncondition of the index-3 step matrix\n  {:>6} {:>9} {:>7}",
            "h", "raw", "scaled"
        );
        for s in &stiff.step_matrix {
            let _ = writeln!(out, "  {:>6.0e} {:>9.1e} {:>7.2}", s.step, s.raw, s.scaled);
        }
    }
    if !studies.symbolic.is_empty() {
        let _ = writeln!(
            out,
            "\nderiving a struck chain\n  {:>4} {:10} {:>9} {:>10}",
            "rods", "pose", "time", "operations"
        );
        for d in &studies.symbolic {
            let _ = writeln!(
                out,
                "  {:>4} {:10} {:>9} {:>10}",
                d.rods,
                pose_words(d.pose),
                nanoseconds(d.seconds[1]),
                d.operations
            );
        }
    }
    if !studies.numeric.is_empty() {
        let _ = writeln!(
            out,
            "\nsolving a struck chain in numbers, against double-double\n  {:>7} {:>8} {:16} {:>9} {:>9}",
            "rods", "unknowns", "way", "time", "error"
        );
        for g in &studies.numeric {
            let _ = writeln!(
                out,
                "  {:>7} {:>8} {:16} {:>9} {:>9.1e}",
                g.rods,
                g.unknowns,
                route_words(g.route),
                nanoseconds(g.seconds[1]),
                g.error
            );
        }
    }
    if let Some(b) = &studies.batch {
        let _ = writeln!(
            out,
            "\n{}: {} operations, {} inputs\n  {:32} {:>7} {:>18}",
            b.formula, b.operations, b.inputs, "way", "threads", "points per second"
        );
        for r in &b.rows {
            let _ = writeln!(
                out,
                "  {:32} {:>7} {:>18}",
                way(r),
                r.threads,
                millions(r.per_second)
            );
        }
        for d in &b.doublings {
            let _ = writeln!(out, "  {}", doubling(d));
        }
    }
    if studies.interrupted {
        out.push_str("\ninterrupted: what was finished is above\n");
    }
    out
}

/// What a second thread brings, in words.
fn doubling(d: &Doubling) -> String {
    let rate = |k: usize| millions(d.points as f64 / d.seconds[k]);
    format!(
        "{} points: {} a second in blocks on one thread, {} on two",
        d.points,
        rate(0),
        rate(1)
    )
}

fn run_row(r: &Run) -> Vec<String> {
    let ok = r.end == End::Reached;
    let figure = |v: Option<f64>| match v.filter(|_| ok) {
        Some(v) => format!("{v:>10.1e}"),
        None => format!("{:>10}", "–"),
    };
    vec![
        match exponent(r) {
            Some(p) => format!("{p:>4}"),
            None => "held".into(),
        },
        format!("{:>6.0e}", r.collision.stiffness),
        format!("{:9}", integrator(r.integrator)),
        format!("{:7}", variables(r.collision.variables)),
        format!("{:>6.0e}", r.tolerance),
        format!("{:>8}", r.steps[0]),
        format!("{:>9}", nanoseconds(r.seconds)),
        figure(Some(r.rigid_error)),
        figure(r.energy_error),
        format!(
            " {}",
            match &r.end {
                End::Reached => "left the ground".into(),
                End::Missed => "stepped over the contact".into(),
                End::TooManySteps => "too many steps".into(),
                End::Failed(why) => format!("gave up: {why}"),
            }
        ),
    ]
}

/// Exponent of the force; `None` where spring and dashpot hold the end.
fn exponent(r: &Run) -> Option<f64> {
    match r.collision.ground {
        Ground::Smooth { exponent } => Some(exponent),
        Ground::Grip => None,
    }
}

fn integrator(i: Integrator) -> &'static str {
    match i {
        Integrator::Dop853 => "DOP853",
        Integrator::Dopri5 => "DOPRI5",
        Integrator::Radau5 => "Radau IIA",
        Integrator::Kvaerno4 => "Kværnø 4",
        Integrator::Bdf => "BDF",
    }
}

fn variables(v: Variables) -> &'static str {
    match v {
        Variables::Raw => "raw",
        Variables::Scaled => "scaled",
    }
}

fn contact_words(c: Contact) -> String {
    match c {
        Contact::DashpotToRest { damping } => format!("dashpot to x = 0, z = {damping}"),
        Contact::DashpotToZeroForce { damping } => format!("dashpot to zero force, z = {damping}"),
        Contact::HuntCrossley { damping, exponent } => {
            format!("Hunt–Crossley, d = {damping}, n = {exponent}")
        }
    }
}

fn pose_words(p: Pose) -> &'static str {
    match p {
        Pose::Straight => "in line",
        Pose::AnyAngles => "any angles",
    }
}

fn way(r: &Throughput) -> &'static str {
    match r.route {
        Route::Program => "compiled, a point at a time",
        Route::Blocks => "compiled, in blocks",
        Route::HandWritten => "written by hand in Rust",
    }
}

/// The section of the page.
pub fn section(out: &mut String, studies: &Studies) {
    out.push_str("<section id=\"studies\"><h2>Stiff limit, growth and batches</h2>");
    if studies.interrupted {
        out.push_str("<p><strong>Interrupted:</strong> only finished rows are shown.</p>");
    }
    findings(out, "What the numbers say", &studies.findings);
    out.push_str("<h3>Compliant contact towards the rigid limit</h3><div class=\"plots\">");
    let angle = studies.stiff.angle;
    figure(
        out,
        orders(studies),
        &format!("Distance of ω⁺ from the rigid answer, rod at {angle} rad, F = K dᵖ."),
    );
    figure(
        out,
        limits(studies),
        "Error of Richardson's extrapolation in K^(−1/(p+1)) after 1, 2, … stiffnesses.",
    );
    figure(
        out,
        steps(studies),
        "Accepted steps at tolerance 1e−8: p = 1 until the rod leaves; at 1e−6: an end held by spring and dashpot.",
    );
    figure(
        out,
        work(studies),
        "Energy error against run time, p = 1, K = 1e8, scaled variables, tolerances 1e−5 to 1e−11.",
    );
    figure(
        out,
        restitution(studies),
        "Restitution of contacts with losses: curves by formula, dots integrated.",
    );
    figure(
        out,
        step_matrix(studies),
        "Condition of the step matrix of a hinge kept as a constraint (index 3).",
    );
    out.push_str("</div><h3>Growth of a struck chain</h3><div class=\"plots\">");
    figure(out, derivations(studies), "Time from scene to closed form.");
    figure(
        out,
        chains(studies, "log10 of time [µs]", |g| g.seconds[1] * 1e6),
        "Time of the numeric solution.",
    );
    figure(
        out,
        chains(studies, "log10 of error", |g| g.error.max(1e-18)),
        "Largest error over the largest speed, against double-double.",
    );
    figure(
        out,
        along(studies),
        "Relative error rod by rod in the longest chain.",
    );
    out.push_str("</div>");
    if let Some(b) = &studies.batch {
        let _ = write!(
            out,
            "<h3>Points per second</h3><p>{}: {} operations, {} inputs; largest relative difference {:.1e}.</p><table><thead><tr><th>way<th>threads<th>points per second</tr></thead><tbody>",
            escape(b.formula),
            b.operations,
            b.inputs,
            b.difference
        );
        for r in &b.rows {
            let _ = write!(
                out,
                "<tr><th>{}<td>{}<td>{}</tr>",
                way(r),
                r.threads,
                millions(r.per_second)
            );
        }
        out.push_str("</tbody></table><ul>");
        for d in &b.doublings {
            let _ = write!(out, "<li>{}</li>", escape(&doubling(d)));
        }
        out.push_str("</ul>");
    }
    if !studies.stiff.runs.is_empty() {
        out.push_str("<details><summary>Every integration</summary><table><thead><tr><th>p<th>K<th>method<th>variables<th>tolerance<th>steps<th>time<th>from rigid<th>energy<th>end</tr></thead><tbody>");
        for r in &studies.stiff.runs {
            out.push_str("<tr>");
            for cell in run_row(r) {
                let _ = write!(out, "<td>{}", escape(cell.trim()));
            }
            out.push_str("</tr>");
        }
        out.push_str("</tbody></table></details>");
    }
    out.push_str("</section>");
}

fn plot(title: &str, x: &str, y: &str, curves: Vec<Curve>, marks: Vec<Mark>) -> Option<String> {
    let axis = |label: &str| Axis {
        label: label.into(),
        range: None,
    };
    let curves: Vec<Curve> = curves
        .into_iter()
        .filter(|c| !c.points.is_empty())
        .collect();
    (!curves.is_empty()).then(|| {
        curve(&Plot {
            title: title.into(),
            x: axis(x),
            y: axis(y),
            curves,
            marks,
        })
        .ok()
    })?
}

fn named(label: impl Into<String>, points: impl IntoIterator<Item = [f64; 2]>) -> Curve {
    Curve {
        label: label.into(),
        points: points.into_iter().collect(),
    }
}

fn logs([x, y]: [f64; 2]) -> [f64; 2] {
    [x.log10(), y.log10()]
}

fn orders(s: &Studies) -> Option<String> {
    let curves = s.stiff.orders.iter().map(|o| {
        named(
            format!("p = {}: K^−{:.3}", o.exponent, o.observed),
            o.points.iter().map(|p| logs(*p)),
        )
    });
    plot(
        "Order in K",
        "log10 of K",
        "log10 of relative distance",
        curves.collect(),
        vec![],
    )
}

fn limits(s: &Studies) -> Option<String> {
    let curves = s.stiff.limits.iter().map(|l| {
        let errors = l.errors.iter().enumerate();
        named(
            format!("p = {}", l.exponent),
            errors.map(|(i, e)| [i as f64 + 1.0, e.max(1e-17).log10()]),
        )
    });
    plot(
        "Richardson's limit",
        "stiffnesses used",
        "log10 of relative error",
        curves.collect(),
        vec![],
    )
}

fn steps(s: &Studies) -> Option<String> {
    let mut curves = Vec::new();
    for i in [Integrator::Dopri5, Integrator::Radau5] {
        for v in [Variables::Raw, Variables::Scaled] {
            let runs = s.stiff.runs.iter().filter(|r| {
                r.integrator == i
                    && r.collision.variables == v
                    && exponent(r) == Some(1.0)
                    && r.tolerance == 1e-8
                    && r.end == End::Reached
            });
            curves.push(named(
                format!("{}, {}", integrator(i), variables(v)),
                runs.map(|r| logs([r.collision.stiffness, r.steps[0] as f64])),
            ));
        }
    }
    plot(
        "Cost over stiffness",
        "log10 of K",
        "log10 of steps",
        curves,
        vec![],
    )
}

fn work(s: &Studies) -> Option<String> {
    let curves = Integrator::ALL.into_iter().map(|i| {
        let runs = s.stiff.runs.iter().filter(|r| {
            r.integrator == i
                && r.collision.variables == Variables::Scaled
                && r.collision.stiffness == 1e8
                && exponent(r) == Some(1.0)
                && r.end == End::Reached
        });
        let mut points: Vec<[f64; 2]> = runs
            .filter_map(|r| Some(logs([r.seconds * 1e6, r.energy_error?.max(1e-17)])))
            .collect();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        named(integrator(i), points)
    });
    plot(
        "Energy error against time",
        "log10 of time [µs]",
        "log10 of relative energy error",
        curves.collect(),
        vec![],
    )
}

fn restitution(s: &Studies) -> Option<String> {
    let damping = |r: &Restitution| match r.contact {
        Contact::DashpotToRest { damping }
        | Contact::DashpotToZeroForce { damping }
        | Contact::HuntCrossley { damping, .. } => damping,
    };
    let kind = |r: &&Restitution| match r.contact {
        Contact::DashpotToRest { .. } => 0,
        Contact::DashpotToZeroForce { .. } => 1,
        Contact::HuntCrossley { .. } => 2,
    };
    let names = ["dashpot to x = 0", "to zero force", "Hunt–Crossley"];
    let curves = (0..3).map(|k| {
        let all = s.stiff.restitution.iter().filter(|r| kind(r) == k);
        named(names[k], all.map(|r| [damping(r), r.formula]))
    });
    let marks = s.stiff.restitution.iter().map(|r| Mark {
        at: [damping(r), r.integrated],
        label: String::new(),
    });
    plot(
        "Contacts with losses",
        "damping z or d",
        "restitution e",
        curves.collect(),
        marks.collect(),
    )
}

fn step_matrix(s: &Studies) -> Option<String> {
    let all = || s.stiff.step_matrix.iter();
    let curves = vec![
        named("raw", all().map(|m| logs([m.step, m.raw]))),
        named("scaled", all().map(|m| logs([m.step, m.scaled]))),
    ];
    plot(
        "Index-3 step matrix",
        "log10 of step h",
        "log10 of condition",
        curves,
        vec![],
    )
}

fn derivations(s: &Studies) -> Option<String> {
    let curves = [Pose::Straight, Pose::AnyAngles].map(|pose| {
        let all = s.symbolic.iter().filter(|d| d.pose == pose);
        named(
            pose_words(pose),
            all.map(|d| [d.rods as f64, (d.seconds[1] * 1e6).log10()]),
        )
    });
    plot(
        "Deriving a chain",
        "rods",
        "log10 of time [µs]",
        curves.into(),
        vec![],
    )
}

fn chains(s: &Studies, label: &str, of: impl Fn(&Growth) -> f64) -> Option<String> {
    let curves = [ChainRoute::Sparse, ChainRoute::Recursion].map(|route| {
        let all = s.numeric.iter().filter(|g| g.route == route);
        named(
            route_words(route),
            all.map(|g| logs([g.rods as f64, of(g)])),
        )
    });
    plot(
        &format!("Solving a chain: {label}"),
        "log10 of rods",
        label,
        curves.into(),
        vec![],
    )
}

fn along(s: &Studies) -> Option<String> {
    let longest = s.numeric.iter().map(|g| g.rods).max()?;
    let all = s.numeric.iter().filter(|g| g.rods == longest);
    let curves = all.map(|g| {
        let points = g
            .along
            .iter()
            .map(|(rod, e)| logs([*rod as f64, e.max(1e-18)]));
        named(route_words(g.route), points)
    });
    plot(
        "Error along the chain",
        "log10 of rod",
        "log10 of relative error",
        curves.collect(),
        vec![],
    )
}
