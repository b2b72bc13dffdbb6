//! The stiff limit: compliant contact against the rigid closed form, as the stiffness K grows.
//!
//! `contact` integrates one collision (`rod` its equations, `drive` the integrators), `restitution` does contacts with losses, `index3` the step matrix of a hinge kept as a
//! constraint. Here: sweeps over K, the observed order in K, and Richardson's limit. Nothing is read from a scene.

pub mod contact;
pub mod drive;
pub mod index3;
pub mod restitution;
mod rod;

use serde::Serialize;

pub use contact::{Collision, End, Ground, Run, Variables, accurate, run};
pub use drive::Integrator;
pub use index3::{StepCondition, conditions};
pub use restitution::{Contact, Restitution, restitutions, usual_contacts};

/// Every integrator in every kind of variables at every stiffness, one after the other; `row` is called with each run as it
/// finishes and says whether to go on.
pub fn sweep(
    angle: f64,
    ground: Ground,
    stiffnesses: &[f64],
    tolerance: f64,
    max_steps: usize,
    mut row: impl FnMut(&Run) -> bool,
) -> Vec<Run> {
    let mut rows = Vec::new();
    for &stiffness in stiffnesses {
        for variables in [Variables::Raw, Variables::Scaled] {
            for integrator in Integrator::ALL {
                let done = run(
                    Collision {
                        angle,
                        ground,
                        stiffness,
                        variables,
                    },
                    integrator,
                    tolerance,
                    max_steps,
                );
                let go_on = row(&done);
                rows.push(done);
                if !go_on {
                    return rows;
                }
            }
        }
    }
    rows
}

/// Observed dependence on K.
#[derive(Clone, Debug, Serialize)]
pub struct Order {
    /// Exponent p of the contact law.
    pub exponent: f64,
    /// 1/(p+1).
    pub expected: f64,
    /// Minus the slope of ln(error) over ln K.
    pub observed: f64,
    /// (K, error against the rigid limit) of the accurate runs it was found from.
    pub points: Vec<[f64; 2]>,
}

/// The order in 1/K of the distance from the rigid limit, from accurate runs; `None` if fewer than two succeed.
pub fn order(angle: f64, exponent: f64, stiffnesses: &[f64]) -> Option<Order> {
    let points: Vec<[f64; 2]> = stiffnesses
        .iter()
        .filter_map(|&k| Some([k, accurate(angle, exponent, k)?.rigid_error]))
        .filter(|[_, error]| *error > 0.0)
        .collect();
    let logs: Vec<(f64, f64)> = points.iter().map(|[k, e]| (k.ln(), e.ln())).collect();
    let expected = Ground::Smooth { exponent }.order();
    Some(Order {
        exponent,
        expected,
        observed: -slope(&logs)?,
        points,
    })
}

/// Limit for K → ∞ by extrapolation.
#[derive(Clone, Debug, Serialize)]
pub struct Limit {
    /// Exponent p of the contact law.
    pub exponent: f64,
    /// Rigid closed form, ω⁺ [v/ℓ].
    pub rigid: f64,
    /// (K, ω⁺) of each accurate run.
    pub points: Vec<[f64; 2]>,
    /// Extrapolated ω⁺ from the first k points, k = 1, 2, …
    pub extrapolated: Vec<f64>,
    /// Relative error of each against the closed form.
    pub errors: Vec<f64>,
    /// The value chosen without looking at the closed form: where two successive extrapolations differ least.
    pub chosen: f64,
    /// Relative error of the chosen value.
    pub chosen_error: f64,
}

/// Richardson's extrapolation in ε = K^(−1/(p+1)), halved `count` − 1 times from `coarsest` (a few tenths).
pub fn limit(angle: f64, exponent: f64, coarsest: f64, count: usize) -> Option<Limit> {
    let rigid = Ground::Smooth { exponent }.rigid_spin(angle);
    let mut points = Vec::new();
    let mut diagonal: Vec<f64> = Vec::new();
    let mut extrapolated = Vec::new();
    for step in 0..count {
        let unit = coarsest * 0.5_f64.powi(step as i32);
        let stiffness = unit.powf(-(exponent + 1.0));
        let spin = accurate(angle, exponent, stiffness)?.spin;
        points.push([stiffness, spin]);
        // Neville's scheme at ε = 0 for a polynomial in ε.
        let mut next = vec![spin];
        for (j, before) in diagonal.iter().enumerate() {
            let better = next[j] + (next[j] - before) / (2_f64.powi(j as i32 + 1) - 1.0);
            next.push(better);
        }
        extrapolated.push(*next.last()?);
        diagonal = next;
    }
    let chosen = extrapolated
        .windows(2)
        .min_by(|a, b| (a[1] - a[0]).abs().total_cmp(&(b[1] - b[0]).abs()))
        .map_or(*extrapolated.last()?, |pair| pair[1]);
    let error = |value: f64| ((value - rigid) / rigid).abs();
    let errors = extrapolated.iter().map(|v| error(*v)).collect();
    Some(Limit {
        exponent,
        rigid,
        points,
        extrapolated,
        errors,
        chosen,
        chosen_error: error(chosen),
    })
}

/// Slope of the straight line of least squares; `None` for fewer than two different abscissas.
pub fn slope(points: &[(f64, f64)]) -> Option<f64> {
    let n = points.len() as f64;
    let (x, y) = points
        .iter()
        .fold((0.0, 0.0), |(x, y), p| (x + p.0 / n, y + p.1 / n));
    let (above, below) = points.iter().fold((0.0, 0.0), |(a, b), p| {
        (a + (p.0 - x) * (p.1 - y), b + (p.0 - x) * (p.0 - x))
    });
    (below > 0.0).then(|| above / below)
}

#[cfg(test)]
mod tests;
