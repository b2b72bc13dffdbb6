//! The rod of Sample 17.29 on compliant ground: one run of one integrator, in raw or scaled variables.
//!
//! A uniform rod of mass m and length ℓ at angle θ₀ to the ground comes down at speed v without turning; its low end C hits.
//! Mass, length and speed are 1, so the moment of inertia is 1/12 and K is counted in m v²/ℓ². Gravity is left out: it has
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
use differential_equations::ode::OrdinaryNumericalMethod;
use differential_equations::prelude::{
    BackwardDifferentiationFormula, CrossingDirection, DiagonallyImplicitRungeKutta, Event,
    EventConfig, ExplicitRungeKutta, IVP, ImplicitRungeKutta, Interpolation, Matrix, ODE, Solution,
    Status,
};
use serde::Serialize;

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

/// Integrators of `differential-equations`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Integrator {
    /// Explicit, order 8, Dormand and Prince.
    Dop853,
    /// Explicit, order 5, Dormand and Prince.
    Dopri5,
    /// Implicit, order 5, Radau IIA.
    Radau5,
    /// Implicit, order 4, diagonally implicit with explicit first stage, Kværnø.
    Kvaerno4,
    /// Implicit multistep, orders 1 to 5.
    Bdf,
}

impl Integrator {
    /// All of them.
    pub const ALL: [Integrator; 5] = [
        Integrator::Dop853,
        Integrator::Dopri5,
        Integrator::Radau5,
        Integrator::Kvaerno4,
        Integrator::Bdf,
    ];

    /// Whether a step needs no system of equations solved.
    pub fn is_explicit(self) -> bool {
        matches!(self, Integrator::Dop853 | Integrator::Dopri5)
    }
}

/// The variables integrated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Variables {
    /// Positions [ℓ] and time [ℓ/v] as they are.
    Raw,
    /// Displacements and time in units of ε = K^(−1/(p+1)), in which the contact has size and duration of order 1.
    Scaled,
}

/// One collision to integrate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Collision {
    /// Angle of the rod to the ground, θ₀ [rad], 0 < θ₀ < π/2.
    pub angle: f64,
    /// The ground.
    pub ground: Ground,
    /// Stiffness K [m v²/ℓ^(p+1) ℓ^(p−1)], a pure number in these units.
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
    /// Time of the run [s].
    pub seconds: f64,
}

/// Time over which the grip is followed [ℓ/v]: long after every transient, for any K worth the name.
const GRIP_TIME: f64 = 0.5;

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
        Err(error) => out.end = End::Failed(error.to_string_short()),
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
            if !(end > from.0) {
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

/// The tightest tolerance that still makes a difference in doubles.
pub(super) const TIGHT: f64 = 1e-14;

/// Steps allowed where the number of steps is not the question.
pub(super) const MANY: usize = 1_000_000;

/// The moment when `event` is 0, near `guess`, and the state then. The system is integrated up to the guess, the rest bridged by
/// secants on one classical Runge–Kutta step; from the better moment again, until the bridge is too short for its error to count.
pub(super) fn end_of_contact<const N: usize, S>(system: &S, guess: f64) -> Option<(f64, [f64; N])>
where
    S: ODE<f64, [f64; N]> + Event<f64, [f64; N]> + Start<N>,
{
    let mut end = (guess, system.start());
    for _ in 0..4 {
        let solution = IVP::ode(system, 0.0, end.0, system.start())
            .method(
                ExplicitRungeKutta::dop853()
                    .rtol(TIGHT)
                    .atol(TIGHT)
                    .max_steps(MANY),
            )
            .solve()
            .ok()?;
        let (t, y) = (end.0, *solution.y.last()?);
        let value = |h: f64| system.event(t + h, &classical_step(system, t, &y, h));
        let (mut h0, mut h1) = (0.0, 1e-6 * t);
        let (mut g0, mut g1) = (value(h0), value(h1));
        for _ in 0..8 {
            if g1 == g0 {
                break;
            }
            let h2 = h1 - g1 * (h1 - h0) / (g1 - g0);
            (h0, g0, h1) = (h1, g1, h2);
            g1 = value(h1);
        }
        if !h1.is_finite() {
            return None;
        }
        end = (t + h1, classical_step(system, t, &y, h1));
        if h1.abs() <= 1e-9 * t {
            break;
        }
    }
    Some(end)
}

/// Where a system starts from.
pub(super) trait Start<const N: usize> {
    /// The state at time 0.
    fn start(&self) -> [f64; N];
}

fn classical_step<const N: usize, S: ODE<f64, [f64; N]>>(
    system: &S,
    t: f64,
    y: &[f64; N],
    h: f64,
) -> [f64; N] {
    let slope = |t: f64, y: &[f64; N]| {
        let mut k = [0.0; N];
        system.diff(t, y, &mut k);
        k
    };
    let moved = |k: &[f64; N], h: f64| std::array::from_fn(|i| y[i] + h * k[i]);
    let k1 = slope(t, y);
    let k2 = slope(t + h / 2.0, &moved(&k1, h / 2.0));
    let k3 = slope(t + h / 2.0, &moved(&k2, h / 2.0));
    let k4 = slope(t + h, &moved(&k3, h));
    std::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]))
}

/// Position and velocity of G and the rod's angle: x, y, θ, ẋ, ẏ, θ̇. In scaled variables the first three are
/// displacements since contact began, in units of ε.
type State = [f64; 6];

/// The equations of motion.
struct Rod {
    collision: Collision,
    /// ε in scaled variables, 1 in raw ones: the unit of displacement and of time.
    unit: f64,
    /// Stiffness in these variables.
    stiffness: f64,
    /// Dashpot constant of the grip in these variables.
    dashpot: f64,
}

impl Rod {
    fn new(collision: Collision) -> Rod {
        let (unit, stiffness, dashpot) = match collision.variables {
            Variables::Raw => (1.0, collision.stiffness, collision.stiffness.sqrt()),
            Variables::Scaled => (
                collision.stiffness.powf(-collision.ground.order()),
                1.0,
                1.0,
            ),
        };
        Rod {
            collision,
            unit,
            stiffness,
            dashpot,
        }
    }

    /// When to stop at the latest.
    fn horizon(&self) -> f64 {
        match (self.collision.ground, self.collision.variables) {
            (Ground::Grip, _) => GRIP_TIME / self.unit,
            // At K = 1 and beyond contact lasts less than 10 ε in any position of the rod.
            (Ground::Smooth { .. }, Variables::Scaled) => 10.0,
            (Ground::Smooth { .. }, Variables::Raw) => 1.0,
        }
    }

    fn angle(&self, y: &State) -> f64 {
        match self.collision.variables {
            Variables::Raw => y[2],
            Variables::Scaled => self.collision.angle + self.unit * y[2],
        }
    }

    /// Displacement of C since it struck, in units of displacement.
    fn end(&self, y: &State) -> [f64; 2] {
        match self.collision.variables {
            Variables::Raw => [y[0] - 0.5 * y[2].cos(), y[1] - 0.5 * y[2].sin()],
            Variables::Scaled => {
                // cos(a+b) − cos a and sin(a+b) − sin a without cancellation.
                let half = 0.5 * self.unit * y[2];
                let middle = self.collision.angle + half;
                let chord = half.sin() / self.unit;
                [y[0] + middle.sin() * chord, y[1] - middle.cos() * chord]
            }
        }
    }
}

impl Start<6> for Rod {
    fn start(&self) -> State {
        let a = self.collision.angle;
        match self.collision.variables {
            Variables::Raw => [0.5 * a.cos(), 0.5 * a.sin(), a, 0.0, -1.0, 0.0],
            Variables::Scaled => [0.0, 0.0, 0.0, 0.0, -1.0, 0.0],
        }
    }
}

/// Force on C and its derivatives by the displacement and by the velocity of C (both diagonal).
struct Push {
    force: [f64; 2],
    by_place: [f64; 2],
    by_speed: f64,
}

impl Rod {
    fn push(&self, end: [f64; 2], speed: [f64; 2]) -> Push {
        match self.collision.ground {
            Ground::Smooth { exponent } => {
                // Contact ends at depth 0; the force goes on as an odd function, so that a step over the end meets no corner.
                let depth = -end[1];
                let root = self.stiffness * depth.abs().powf(exponent - 1.0);
                let (force, slope) = (root * depth, root * exponent);
                Push {
                    force: [0.0, force],
                    by_place: [0.0, -slope],
                    by_speed: 0.0,
                }
            }
            Ground::Grip => Push {
                force: std::array::from_fn(|i| -self.stiffness * end[i] - self.dashpot * speed[i]),
                by_place: [-self.stiffness; 2],
                by_speed: -self.dashpot,
            },
        }
    }
}

impl ODE<f64, State> for Rod {
    fn diff(&self, _: f64, y: &State, rate: &mut State) {
        let (sin, cos) = self.angle(y).sin_cos();
        let speed = [y[3] + 0.5 * sin * y[5], y[4] - 0.5 * cos * y[5]];
        let f = self.push(self.end(y), speed).force;
        // I = 1/12; the arm from G to C is −(cos θ, sin θ)/2.
        *rate = [
            y[3],
            y[4],
            y[5],
            f[0],
            f[1],
            6.0 * (sin * f[0] - cos * f[1]),
        ];
    }

    /// By hand: a difference quotient of step 1e−8 is wider than the whole contact when K is large.
    fn jacobian(&self, _: f64, y: &State, j: &mut Matrix<f64>) {
        let (sin, cos) = self.angle(y).sin_cos();
        let speed = [y[3] + 0.5 * sin * y[5], y[4] - 0.5 * cos * y[5]];
        let push = self.push(self.end(y), speed);
        let lever = [0.5 * sin, -0.5 * cos];
        // ∂(lever)/∂θ, in the unit of y[2].
        let turned = [0.5 * cos * self.unit, 0.5 * sin * self.unit];
        for row in 0..6 {
            for column in 0..6 {
                j[(row, column)] = 0.0;
            }
        }
        for i in 0..3 {
            j[(i, i + 3)] = 1.0;
        }
        for i in 0..2 {
            let mut gradient = [0.0; 6];
            gradient[i] = push.by_place[i];
            gradient[2] = push.by_place[i] * lever[i] + push.by_speed * turned[i] * y[5];
            gradient[i + 3] = push.by_speed;
            gradient[5] = push.by_speed * lever[i];
            for (column, value) in gradient.into_iter().enumerate() {
                j[(i + 3, column)] = value;
                j[(5, column)] += 12.0 * lever[i] * value;
            }
            j[(5, 2)] += 12.0 * turned[i] * push.force[i];
        }
    }
}

impl Event<f64, State> for Rod {
    fn config(&self) -> EventConfig {
        EventConfig::new(CrossingDirection::Negative, Some(1))
    }

    /// Depth of C: contact ends where it falls to 0.
    fn event(&self, _: f64, y: &State) -> f64 {
        -self.end(y)[1]
    }
}

type Outcome<const N: usize> = Result<Solution<f64, [f64; N]>, Error<f64, [f64; N]>>;

/// Runs a system on from a time and state to `until`; `stop` ends it at the event.
pub(super) fn integrate<const N: usize, S>(
    system: &S,
    integrator: Integrator,
    from: (f64, [f64; N]),
    until: f64,
    tolerance: f64,
    max_steps: usize,
    stop: bool,
) -> Outcome<N>
where
    S: ODE<f64, [f64; N]> + Event<f64, [f64; N]>,
{
    let (r, a, n) = (tolerance, tolerance, max_steps);
    match integrator {
        Integrator::Dop853 => solve(
            system,
            ExplicitRungeKutta::dop853().rtol(r).atol(a).max_steps(n),
            from,
            until,
            stop,
        ),
        Integrator::Dopri5 => solve(
            system,
            ExplicitRungeKutta::dopri5().rtol(r).atol(a).max_steps(n),
            from,
            until,
            stop,
        ),
        Integrator::Radau5 => solve(
            system,
            // One tolerance per component: given a single one, the crate loosens it once per component (0.7.0).
            ImplicitRungeKutta::radau5()
                .rtol(vec![r; N])
                .atol(vec![a; N])
                .max_steps(n),
            from,
            until,
            stop,
        ),
        Integrator::Kvaerno4 => solve(
            system,
            DiagonallyImplicitRungeKutta::kvaerno745()
                .rtol(r)
                .atol(a)
                .max_steps(n),
            from,
            until,
            stop,
        ),
        Integrator::Bdf => solve(
            system,
            BackwardDifferentiationFormula::adaptive()
                .rtol(r)
                .atol(a)
                .max_steps(n),
            from,
            until,
            stop,
        ),
    }
}

fn solve<const N: usize, S, M>(
    system: &S,
    method: M,
    from: (f64, [f64; N]),
    until: f64,
    stop: bool,
) -> Outcome<N>
where
    S: ODE<f64, [f64; N]> + Event<f64, [f64; N]>,
    M: OrdinaryNumericalMethod<f64, [f64; N]> + Interpolation<f64, [f64; N]>,
{
    let problem = IVP::ode(system, from.0, until, from.1).method(method);
    if stop {
        problem.event(system).solve()
    } else {
        problem.solve()
    }
}

/// The kind of failure in a few words.
trait Short {
    fn to_string_short(&self) -> String;
}

impl<const N: usize> Short for Error<f64, [f64; N]> {
    fn to_string_short(&self) -> String {
        match self {
            Error::StepSize { t, .. } => format!("step too small at t = {t:e}"),
            Error::Stiffness { t, .. } => format!("found stiff at t = {t:e}"),
            Error::LinearAlgebra { t, msg, .. } => format!("linear system at t = {t:e}: {msg}"),
            other => format!("{other:?}").chars().take(120).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_jacobian_by_hand_is_the_derivative_of_the_equations() {
        for ground in [
            Ground::Smooth { exponent: 1.0 },
            Ground::Smooth { exponent: 1.5 },
            Ground::Grip,
        ] {
            for variables in [Variables::Raw, Variables::Scaled] {
                let rod = Rod::new(Collision {
                    angle: 0.7,
                    ground,
                    stiffness: 50.0,
                    variables,
                });
                let mut y = rod.start();
                for (i, value) in y.iter_mut().enumerate() {
                    *value += [0.03, -0.2, 0.1, 0.4, 0.3, -0.8][i];
                }
                let mut by_hand = Matrix::zeros(6, 6);
                rod.jacobian(0.0, &y, &mut by_hand);
                for column in 0..6 {
                    let side = |h: f64| {
                        let (mut moved, mut rate) = (y, [0.0; 6]);
                        moved[column] += h;
                        rod.diff(0.0, &moved, &mut rate);
                        rate
                    };
                    let (low, high) = (side(-1e-6), side(1e-6));
                    for row in 0..6 {
                        let quotient = (high[row] - low[row]) / 2e-6;
                        let error = (by_hand[(row, column)] - quotient).abs();
                        assert!(
                            error < 1e-6 * (1.0 + quotient.abs()),
                            "{ground:?} {variables:?} {row} {column}"
                        );
                    }
                }
            }
        }
    }
}
