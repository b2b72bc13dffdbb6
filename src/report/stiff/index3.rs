//! The matrix of one implicit step of a hinged rod as a differential-algebraic system of index 3, before and after scaling.
//!
//! A uniform rod (m = ℓ = 1) hangs from a fixed hinge at one end. Unknowns of a backward Euler step of length h: positions
//! q = (x, y, θ), velocities v, hinge reactions λ. Its rows are q − h v, M v − h Gᵀλ, G q (with the Jacobian of the
//! constraint, G = ∂g/∂q). Petzold and Lötstedt (1986): divide the position rows by h, let h²λ and h v be the unknowns, and
//! nothing depends on h any more except through terms that vanish with it.

use nalgebra::SMatrix;
use serde::Serialize;

/// Condition numbers of the step matrix at one step length.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct StepCondition {
    /// Step length h [√(ℓ/g)].
    pub step: f64,
    /// 2-norm condition number as it stands.
    pub raw: f64,
    /// 2-norm condition number after scaling.
    pub scaled: f64,
}

/// Condition numbers at each step length, for the rod at `angle` from the horizontal [rad], turning at `spin`, with the
/// weight g = 1 along −y giving the reaction.
pub fn conditions(angle: f64, spin: f64, steps: &[f64]) -> Vec<StepCondition> {
    steps
        .iter()
        .map(|&step| {
            let raw = step_matrix(angle, spin, step);
            StepCondition { step, raw: condition(&raw), scaled: condition(&scaled(&raw, step)) }
        })
        .collect()
}

type Step = SMatrix<f64, 8, 8>;

/// Jacobian of the residual (q − q₀ − h v, M (v − v₀) − h (Gᵀλ + f), g(q)) by (q, v, λ).
fn step_matrix(angle: f64, spin: f64, h: f64) -> Step {
    let (s, c) = angle.sin_cos();
    // g(q) = G − (cos θ, sin θ)/2: the hinge end stays at the origin.
    let jacobian = [[1.0, 0.0, 0.5 * s], [0.0, 1.0, -0.5 * c]];
    let mass = [1.0, 1.0, 1.0 / 12.0];
    // Reaction of the swinging rod: m a_G = λ + weight, with the angular acceleration of a pendulum, −(3/2) cos θ.
    let turn = -1.5 * c;
    let acceleration = [-0.5 * s * turn - 0.5 * c * spin * spin, 0.5 * c * turn - 0.5 * s * spin * spin];
    let reaction = [acceleration[0], acceleration[1] + 1.0];
    let mut a = Step::zeros();
    for i in 0..3 {
        a[(i, i)] = 1.0;
        a[(i, i + 3)] = -h;
        a[(i + 3, i + 3)] = mass[i];
        for k in 0..2 {
            a[(i + 3, 6 + k)] = -h * jacobian[k][i];
            a[(6 + k, i)] = jacobian[k][i];
        }
    }
    // ∂(Gᵀλ)/∂θ: only the moment depends on the position.
    a[(5, 2)] = -h * 0.5 * (c * reaction[0] + s * reaction[1]);
    a
}

/// Unknowns q, h v, h² λ; momentum rows times h. Then every block is free of h, up to terms that vanish with it.
fn scaled(raw: &Step, h: f64) -> Step {
    Step::from_fn(|row, column| {
        let by_row = if (3..6).contains(&row) { h } else { 1.0 };
        let by_column = match column {
            0..3 => 1.0,
            3..6 => h,
            _ => h * h,
        };
        by_row * raw[(row, column)] / by_column
    })
}

fn condition(a: &Step) -> f64 {
    let values = a.singular_values();
    values.max() / values.min()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::stiff::slope;

    #[test]
    fn the_raw_step_is_ill_conditioned_like_h_cubed_and_the_scaled_one_not_at_all() {
        let steps: Vec<f64> = (1..=8).map(|k| 10_f64.powi(-k)).collect();
        let rows = conditions(0.6, 0.4, &steps);
        // A condition number beyond 1e16 is not resolved by doubles: regress where it is.
        let seen: Vec<(f64, f64)> = rows.iter().filter(|r| r.raw < 1e14).map(|r| (r.step.ln(), r.raw.ln())).collect();
        let order = slope(&seen).expect("several points");
        assert!((order + 3.0).abs() < 0.15, "order {order}: {rows:?}");
        assert!(rows.iter().all(|r| r.scaled < 40.0), "{rows:?}");
        let (first, last) = (rows[1].scaled, rows[7].scaled);
        assert!((first / last - 1.0).abs() < 0.02, "{first} {last}");
    }
}
