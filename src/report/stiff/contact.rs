//! The rod of Sample 17.29 on compliant ground: one run of one integrator, in raw or scaled variables.
//!
//! A uniform rod of mass m and length ℓ at angle θ₀ to the ground comes down at speed v without turning; its low end C hits.
//! Mass, length and speed are 1, so the moment of inertia is 1/12 and K is counted in m v²/ℓ^(p+1). Gravity is left out: it has
//! no impulse. Two kinds of ground, each with a rigid limit in closed form:
//!
//! - [`Ground::Smooth`]: a vertical force N = K dᵖ on C at depth d > 0, nothing lost. Rigid limit: frictionless impact with
//!   e = 1, ω⁺ = −12 cos θ₀/(1 + 3 cos²θ₀). The energy is an invariant, so that the integrator's own error shows apart from
//!   the error of the model.
//! - [`Ground::Grip`]: a spring K and a dashpot √K in both directions hold C where it struck. Rigid limit: C sticks,
//!   ω⁺ = −(3/2) cos θ₀, the answer of the sample. After a time of order K^(−1/2) nothing happens any more, but an explicit
//!   method still has to resolve it: stiff in the classical sense.
//!
//! Both turn the rod by an angle of order K^(−1/(p+1)) while contact lasts, and differ by that much from their rigid limit.

use std::time::Instant;

use differential_equations::error::Error;
use differential_equations::prelude::{Event, Solution, Status};
use serde::Serialize;

use super::drive::{Integrator, MANY, Start, TIGHT, end_of_contact, in_words, integrate};
use super::rod::{Rod, State};

/// How the ground gives way.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum Ground {
    /// Vertical force K dᵖ, nothing lost.
    Smooth {
        /// Exponent p: 1 for a linear spring, 3/2 for Hertz.
        exponent: f64,
    },
    /// Spring and dashpot that hold the end where it struck; p = 1.
    Grip,
}

impl Ground {
    /// The power of 1/K that the distance from the rigid limit goes with, 1/(p+1).
    pub fn order(self) -> f64 {
        match self {
            Ground::Smooth { exponent } => 1.0 / (exponent + 1.0),
            Ground::Grip => 0.5,
        }
    }

    /// Angular velocity just after in the rigid limit [v/ℓ], counterclockwise positive.
    pub fn rigid_spin(self, angle: f64) -> f64 {
        let c = angle.cos();
        match self {
            Ground::Smooth { .. } => -12.0 * c / (1.0 + 3.0 * c * c),
            Ground::Grip => -1.5 * c,
        }
    }
}

/// The variables integrated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Variables {
    /// Positions \[ℓ\] and time [ℓ/v] as they are.
    Raw,
    /// Displacements and time in units of ε = K^(−1/(p+1)), in which the contact has size and duration of order 1.
    Scaled,
}

/// One collision to integrate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Collision {
    /// Angle of the rod to the ground, θ₀ \[rad\], 0 < θ₀ < π/2.
    pub angle: f64,
    /// The ground.
    pub ground: Ground,
    /// Stiffness K [m v²/ℓ^(p+1)].
    pub stiffness: f64,
    /// The variables.
    pub variables: Variables,
}

/// How a run ended.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum End {
    /// The end of contact was located (smooth ground), or the end of the interval reached (grip).
    Reached,
    /// The integrator never saw contact end: it stepped over it.
    Missed,
    /// More steps than allowed.
    TooManySteps,
    /// The integrator gave up.
    Failed(String),
}

/// What a run cost and what came out.
#[derive(Clone, Debug, Serialize)]
pub struct Run {
    /// The collision.
    pub collision: Collision,
    /// The integrator.
    pub integrator: Integrator,
    /// Relative and absolute tolerance asked for.
    pub tolerance: f64,
    /// How it ended; the figures below mean something only if `Reached`.
    pub end: End,
    /// Duration of contact [ℓ/v] (smooth ground).
    pub duration: f64,
    /// Angular velocity after, ω⁺ [v/ℓ].
    pub spin: f64,
    /// |ω⁺ − ω_rigid| / |ω_rigid|: error of model and integrator together.
    pub rigid_error: f64,
    /// |T⁺ − T⁻| / T⁻ (smooth ground): error of the integrator alone.
    pub energy_error: Option<f64>,
    /// Steps accepted and rejected.
    pub steps: [usize; 2],
    /// Evaluations of the forces, of their Jacobian, and matrix factorizations.
    pub evaluations: [usize; 3],
    /// Time of the run \[s\].
    pub seconds: f64,
}

/// Integrates one collision with `tolerance` both relative and absolute and at most `max_steps` steps.
pub fn run(collision: Collision, integrator: Integrator, tolerance: f64, max_steps: usize) -> Run {
    let start = Instant::now();
    let rod = Rod::new(collision);
    let smooth = matches!(collision.ground, Ground::Smooth { .. });
    let result = integrate(
        &rod,
        integrator,
        (0.0, rod.start()),
        rod.horizon(),
        tolerance,
        max_steps,
        smooth,
    );
    let seconds = start.elapsed().as_secs_f64();
    let mut out = Run {
        collision,
        integrator,
        tolerance,
        end: End::Missed,
        duration: f64::NAN,
        spin: f64::NAN,
        rigid_error: f64::NAN,
        energy_error: None,
        steps: [0; 2],
        evaluations: [0; 3],
        seconds,
    };
    match result {
        Err(Error::MaxSteps { .. }) => out.end = End::TooManySteps,
        Err(error) => out.end = End::Failed(in_words(&error)),
        Ok(solution) => {
            out.steps = [solution.steps.accepted, solution.steps.rejected];
            out.evaluations = [
                solution.evals.function,
                solution.evals.jacobian,
                solution.evals.decompositions,
            ];
            if smooth && solution.status != Status::Interrupted {
                return out;
            }
            let (Some(t), Some(y)) = (solution.t.last(), solution.y.last()) else {
                return out;
            };
            out.end = End::Reached;
            out.report(&rod, *t, y);
            if smooth {
                out.repeat_last_step(&rod, &solution, max_steps);
            }
            out.seconds = start.elapsed().as_secs_f64();
        }
    }
    out
}

impl Run {
    /// The state at the end of contact by integration instead of interpolation, which is of lower order: the last step, from
    /// the point before contact ended, is repeated up to the located end, and the end corrected by Newton's rule.
    fn repeat_last_step(&mut self, rod: &Rod, solution: &Solution<f64, State>, max_steps: usize) {
        let (count, Some(found)) = (solution.t.len(), solution.t.last()) else {
            return;
        };
        // The last two points are the end of the step that crossed, and the crossing.
        let Some(before) = count.checked_sub(3) else {
            return;
        };
        let (from, mut end) = ((solution.t[before], solution.y[before]), *found);
        for _ in 0..2 {
            let again = integrate(
                rod,
                self.integrator,
                from,
                end,
                self.tolerance,
                max_steps,
                false,
            );
            let Ok(again) = again else { return };
            let Some(y) = again.y.last() else { return };
            self.evaluations[0] += again.evals.function;
            self.evaluations[1] += again.evals.jacobian;
            self.evaluations[2] += again.evals.decompositions;
            self.report(rod, end, y);
            // Depth over the speed at which the end of the rod leaves.
            end += rod.event(end, y) / (y[4] - 0.5 * rod.angle(y).cos() * y[5]);
            if end.is_nan() || end <= from.0 {
                return;
            }
        }
    }

    fn report(&mut self, rod: &Rod, t: f64, y: &State) {
        let rigid = rod.collision.ground.rigid_spin(rod.collision.angle);
        self.duration = t * rod.unit;
        self.spin = y[5];
        self.rigid_error = ((self.spin - rigid) / rigid).abs();
        if let Ground::Smooth { .. } = rod.collision.ground {
            self.energy_error = Some((y[4] * y[4] + y[5] * y[5] / 12.0 - 1.0).abs());
        }
    }
}

/// The compliant answer as accurately as doubles give it: DOP853 at tolerance 1e−14 in scaled variables, the end of contact
/// located by integrating up to it, not by interpolation. Smooth ground only; `None` if the integrator fails.
pub fn accurate(angle: f64, exponent: f64, stiffness: f64) -> Option<Run> {
    let collision = Collision {
        angle,
        ground: Ground::Smooth { exponent },
        stiffness,
        variables: Variables::Scaled,
    };
    let mut out = run(collision, Integrator::Dop853, TIGHT, MANY);
    if out.end != End::Reached {
        return None;
    }
    let rod = Rod::new(collision);
    let (t, y) = end_of_contact(&rod, out.duration / rod.unit)?;
    out.report(&rod, t, &y);
    Some(out)
}
