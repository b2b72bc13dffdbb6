//! The matrix of one implicit step of a hinged rod as a differential-algebraic system of index 3, before and after scaling.
//!
//! A uniform rod (m = ℓ = 1) hangs from a fixed hinge at one end. Unknowns of a backward Euler step of length h: positions
//! q = (x, y, θ), velocities v, hinge reactions λ. Equations (q − q₀)/h = v, M (v − v₀)/h = Gᵀλ + f, g(q) = 0, G = ∂g/∂q.
//! Petzold and Lötstedt (1986): with h v and h² λ for unknowns, and the rows multiplied by h and h², nothing depends on h any
//! more except through terms that vanish with it.

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

/// Condition numbers at each step length, for the rod at `angle` from the horizontal \[rad\], turning at `spin`, with the
/// weight g = 1 along −y giving the reaction; `None` if the scaled matrix is singular, as it is for no finite step.
pub fn conditions(angle: f64, spin: f64, steps: &[f64]) -> Option<Vec<StepCondition>> {
    steps.iter().map(|&step| both(angle, spin, step)).collect()
}

fn both(angle: f64, spin: f64, step: f64) -> Option<StepCondition> {
    let raw = step_matrix(angle, spin, step);
    let [rows, columns] = scales(step);
    let scaled = Step::from_fn(|i, j| rows[i] * raw[(i, j)] / columns[j]);
    // The smallest singular value of the raw matrix drowns in rounding below h = 1e−5; its inverse, got through the
    // well-conditioned scaled one, does not.
    let scaled_inverse = scaled.try_inverse()?;
    let raw_inverse = Step::from_fn(|i, j| scaled_inverse[(i, j)] / columns[i] * rows[j]);
    Some(StepCondition {
        step,
        raw: norm(&raw) * norm(&raw_inverse),
        scaled: norm(&scaled) * norm(&scaled_inverse),
    })
}

type Step = SMatrix<f64, 8, 8>;

/// Jacobian of the residual ((q − q₀)/h − v, M (v − v₀)/h − Gᵀλ − f, g(q)) by (q, v, λ).
fn step_matrix(angle: f64, spin: f64, h: f64) -> Step {
    let (s, c) = angle.sin_cos();
    // g(q) = G − (cos θ, sin θ)/2: the hinge end stays at the origin.
    let jacobian = [[1.0, 0.0, 0.5 * s], [0.0, 1.0, -0.5 * c]];
    let mass = [1.0, 1.0, 1.0 / 12.0];
    // Reaction of the swinging rod: m a_G = λ + weight, with the angular acceleration of a pendulum, −(3/2) cos θ.
    let turn = -1.5 * c;
    let acceleration = [
        -0.5 * s * turn - 0.5 * c * spin * spin,
        0.5 * c * turn - 0.5 * s * spin * spin,
    ];
    let reaction = [acceleration[0], acceleration[1] + 1.0];
    let mut a = Step::zeros();
    for i in 0..3 {
        a[(i, i)] = 1.0 / h;
        a[(i, i + 3)] = -1.0;
        a[(i + 3, i + 3)] = mass[i] / h;
        for k in 0..2 {
            a[(i + 3, 6 + k)] = -jacobian[k][i];
            a[(6 + k, i)] = jacobian[k][i];
        }
    }
    // ∂(Gᵀλ)/∂θ: only the moment depends on the position.
    a[(5, 2)] = -0.5 * (c * reaction[0] + s * reaction[1]);
    a
}

/// What rows are multiplied by, and what unknowns are multiplied by.
fn scales(h: f64) -> [[f64; 8]; 2] {
    let of = |q: f64, v: f64, last: f64| {
        std::array::from_fn(|i| {
            if i < 3 {
                q
            } else if i < 6 {
                v
            } else {
                last
            }
        })
    };
    [of(h, h * h, 1.0), of(1.0, h, h * h)]
}

/// Spectral norm.
fn norm(a: &Step) -> f64 {
    a.singular_values().max()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::stiff::slope;

    #[test]
    fn the_raw_step_is_ill_conditioned_like_h_cubed_and_the_scaled_one_not_at_all() {
        let steps: Vec<f64> = (1..=8).map(|k| 10_f64.powi(-k)).collect();
        let rows = conditions(0.6, 0.4, &steps).expect("regular");
        let logs: Vec<(f64, f64)> = rows.iter().map(|r| (r.step.ln(), r.raw.ln())).collect();
        let order = slope(&logs).expect("several points");
        assert!((order + 3.0).abs() < 0.01, "order {order}: {rows:?}");
        let last = rows[7].scaled;
        assert!(
            rows.iter().all(|r| (r.scaled / last - 1.0).abs() < 0.02) && last < 20.0,
            "{rows:?}"
        );
    }

    #[test]
    fn where_doubles_resolve_it_the_condition_is_that_of_the_singular_values() {
        for step in [1e-1, 1e-2, 1e-3] {
            let values = step_matrix(0.6, 0.4, step).singular_values();
            let direct = values.max() / values.min();
            let row = both(0.6, 0.4, step).expect("regular");
            assert!((row.raw / direct - 1.0).abs() < 1e-4, "{row:?} {direct}");
        }
    }
}
