//! What the studies say of the known findings; every figure is read from them.

use super::super::stiff::{Contact, End, Ground, Integrator, Run, Variables, slope};
use super::super::verdict::{Finding, nanoseconds};
use super::Studies;
use crate::report::batch;
use crate::report::growth::{ChainRoute, Pose};

/// The findings that were measured.
pub fn findings(studies: &Studies) -> Vec<Finding> {
    let mut out = Vec::new();
    let mut say = |claim: &str, holds: bool, evidence: String| {
        out.push(Finding {
            claim: claim.into(),
            holds,
            evidence,
        });
    };
    let stiff = &studies.stiff;
    for order in &stiff.orders {
        say(
            &format!(
                "compliant contact F = K d^{} is away from the rigid answer by K^−{:.3}",
                order.exponent, order.expected
            ),
            (order.observed - order.expected).abs() < 0.01,
            format!(
                "observed order {:.4} over {} stiffnesses",
                order.observed,
                order.points.len()
            ),
        );
    }
    for limit in &stiff.limits {
        say(
            &format!(
                "Richardson's extrapolation in K^(−1/(p+1)) shows the rigid answer to 12 digits, p = {}",
                limit.exponent
            ),
            limit.chosen_error < 1e-12,
            format!(
                "{} against the closed form {}: relative error {:.1e}",
                limit.chosen, limit.rigid, limit.chosen_error
            ),
        );
    }
    for variables in [Variables::Scaled, Variables::Raw] {
        if let Some((claim, holds, evidence)) = cost(&stiff.runs, variables) {
            say(claim, holds, evidence);
        }
    }
    if let Some((claim, holds, evidence)) = held(&stiff.runs) {
        say(claim, holds, evidence);
    }
    type Is = fn(&Contact) -> bool;
    let kinds: [(&str, Is); 3] = [
        (
            "a dashpot whose contact ends at x = 0 has e = exp(−πz/√(1−z²))",
            |c| matches!(c, Contact::DashpotToRest { .. }),
        ),
        (
            "a dashpot whose contact ends at zero force has e = exp(−2z acos z/√(1−z²))",
            |c| matches!(c, Contact::DashpotToZeroForce { .. }),
        ),
        (
            "Hunt and Crossley's contact has (1+e)d = ln((1+d)/(1−e d)), whatever its exponent",
            |c| matches!(c, Contact::HuntCrossley { .. }),
        ),
    ];
    for (claim, is) in kinds {
        let errors: Vec<f64> = stiff
            .restitution
            .iter()
            .filter(|r| is(&r.contact))
            .map(|r| r.error)
            .collect();
        if let Some(worst) = errors.iter().copied().reduce(f64::max) {
            say(
                claim,
                worst < 1e-10,
                format!(
                    "integrated for {} dampings, largest relative error {worst:.1e}",
                    errors.len()
                ),
            );
        }
    }
    let logs = |f: &dyn Fn(&super::StepCondition) -> f64| -> Vec<(f64, f64)> {
        stiff
            .step_matrix
            .iter()
            .map(|s| (s.step.ln(), f(s).ln()))
            .collect()
    };
    if let Some(power) = slope(&logs(&|s| s.raw)) {
        let scaled = || stiff.step_matrix.iter().map(|s| s.scaled);
        let least = scaled().fold(f64::INFINITY, f64::min);
        let most = scaled().fold(0.0, f64::max);
        say(
            "the step matrix of an index-3 hinge has a condition that grows like h⁻³; scaled it is the same for every h",
            (power + 3.0).abs() < 0.1 && most < 1.1 * least,
            format!(
                "h^{power:.2} raw, {least:.2} to {most:.2} scaled, h from {:e} to {:e}",
                stiff.step_matrix.first().map_or(0.0, |s| s.step),
                stiff.step_matrix.last().map_or(0.0, |s| s.step)
            ),
        );
    }
    for pose in [Pose::Straight, Pose::AnyAngles] {
        let rows = || {
            studies
                .symbolic
                .iter()
                .filter(|d| d.pose == pose && d.rods >= 2)
        };
        let times: Vec<(f64, f64)> = rows()
            .map(|d| ((d.rods as f64).ln(), d.seconds[1].ln()))
            .collect();
        if let (Some(power), Some(last)) = (slope(&times), rows().next_back()) {
            let words = match pose {
                Pose::Straight => "in line",
                Pose::AnyAngles => "at any angles",
            };
            say(
                &format!(
                    "deriving a struck chain {words} costs less than the fifth power of the number of rods"
                ),
                power < 5.0,
                format!(
                    "n^{power:.1} up to n = {}, {} there",
                    last.rods,
                    nanoseconds(last.seconds[1])
                ),
            );
        }
    }
    for route in [ChainRoute::Sparse, ChainRoute::Recursion] {
        let rows = || {
            studies
                .numeric
                .iter()
                .filter(|g| g.route == route && g.rods >= 100)
        };
        let times: Vec<(f64, f64)> = rows()
            .map(|g| ((g.rods as f64).ln(), g.seconds[1].ln()))
            .collect();
        if let (Some(power), Some(last)) = (slope(&times), rows().next_back()) {
            let error = rows().map(|g| g.error).fold(0.0, f64::max);
            say(
                &format!(
                    "{} costs a chain nearly in proportion to its length, and its error stays small",
                    route_words(route)
                ),
                power < 1.5 && error < 1e-10,
                format!(
                    "n^{power:.2} up to n = {}, {} there; largest error {error:.1e} of the largest speed",
                    last.rods,
                    nanoseconds(last.seconds[1])
                ),
            );
        }
    }
    if let Some(b) = &studies.batch {
        let rate = |route, threads| {
            b.rows
                .iter()
                .find(|r| r.route == route && r.threads == threads)
                .map(|r| r.per_second)
        };
        if let (Some(hand), Some(blocks)) = (
            rate(batch::Route::HandWritten, 1),
            rate(batch::Route::Blocks, 1),
        ) {
            say(
                "a compiled closed form in blocks is as fast as the function written by hand",
                blocks >= 0.8 * hand,
                format!(
                    "{} points/s against {} on one thread; difference {:.1e}",
                    millions(blocks),
                    millions(hand),
                    b.difference
                ),
            );
        }
        let gain = |d: &batch::Doubling| d.seconds[0] / d.seconds[1];
        if let Some(last) = b.doublings.last() {
            let pays = b.doublings.iter().find(|d| gain(d) > 1.2);
            let from = match pays {
                Some(d) => format!("quicker from {} points on", d.points),
                None => String::from("no quicker at any size"),
            };
            say(
                "a second thread takes a large batch at least half as fast again",
                gain(last) > 1.5,
                format!(
                    "{from}, {:.2} times as fast at {} points, on {} processors",
                    gain(last),
                    last.points,
                    studies.machine.processors
                ),
            );
        }
    }
    out
}

/// Steps over stiffness, explicit integrators at the middle tolerance.
fn cost(runs: &[Run], variables: Variables) -> Option<(&'static str, bool, String)> {
    let of = |integrator: Integrator| {
        move |r: &&Run| {
            r.collision.variables == variables
                && r.collision.ground != Ground::Grip
                && r.integrator == integrator
                && r.tolerance == 1e-8
        }
    };
    let all: Vec<&Run> = runs.iter().filter(of(Integrator::Dopri5)).collect();
    let reached: Vec<&&Run> = all.iter().filter(|r| r.end == End::Reached).collect();
    let (least, most) = (
        reached.iter().map(|r| r.steps[0]).min()?,
        reached.iter().map(|r| r.steps[0]).max()?,
    );
    let evidence = format!(
        "{least} to {most} steps of DOPRI5 over K = {:e} … {:e}; {} of {} runs reached the end of contact",
        all.first()?.collision.stiffness,
        all.last()?.collision.stiffness,
        reached.len(),
        all.len()
    );
    Some(match variables {
        Variables::Scaled => (
            "in scaled variables the cost of integrating the contact does not depend on K",
            reached.len() == all.len() && 10 * most <= 13 * least + 20,
            evidence,
        ),
        Variables::Raw => (
            "in raw variables the cost grows with K until the integrator no longer sees the contact",
            reached.len() < all.len() || most > 2 * least,
            evidence,
        ),
    })
}

/// Steps of an explicit and an implicit integrator on an end held by spring and dashpot.
fn held(runs: &[Run]) -> Option<(&'static str, bool, String)> {
    let growth = |integrator: Integrator| {
        let reached = runs.iter().filter(|r| {
            r.collision.ground == Ground::Grip
                && r.collision.stiffness >= 1e5
                && r.integrator == integrator
                && r.end == End::Reached
        });
        let logs: Vec<(f64, f64)> = reached
            .map(|r| (r.collision.stiffness.ln(), (r.steps[0].max(1) as f64).ln()))
            .collect();
        slope(&logs)
    };
    let (explicit, implicit) = (growth(Integrator::Dopri5)?, growth(Integrator::Radau5)?);
    Some((
        "where spring and dashpot hold the end, explicit integrators need steps like √K and implicit ones do not",
        (explicit - 0.5).abs() < 0.15 && implicit < 0.25,
        format!("steps of DOPRI5 like K^{explicit:.2}, of Radau IIA like K^{implicit:.2}"),
    ))
}

/// A way to solve a chain, in words.
pub fn route_words(route: ChainRoute) -> &'static str {
    match route {
        ChainRoute::Sparse => "sparse Cholesky",
        ChainRoute::Recursion => "recursion",
    }
}

/// A rate in readable units.
pub fn millions(rate: f64) -> String {
    match rate / 1e6 {
        r if r < 10.0 => format!("{r:.1} million"),
        r => format!("{r:.0} million"),
    }
}
