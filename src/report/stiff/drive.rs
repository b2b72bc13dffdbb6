//! Running the integrators of `differential-equations`: from a system and a method to a solution, and to the exact moment when
//! contact ends. It knows nothing of what is integrated.

use differential_equations::error::Error;
use differential_equations::ode::OrdinaryNumericalMethod;
use differential_equations::prelude::{
    BackwardDifferentiationFormula, DiagonallyImplicitRungeKutta, Event, ExplicitRungeKutta, IVP,
    ImplicitRungeKutta, Interpolation, ODE, Solution,
};
use serde::Serialize;

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
pub(super) fn in_words<const N: usize>(error: &Error<f64, [f64; N]>) -> String {
    match error {
        Error::StepSize { t, .. } => format!("step too small at t = {t:e}"),
        Error::Stiffness { t, .. } => format!("too many steps rejected at t = {t:e}"),
        Error::LinearAlgebra { t, msg, .. } => format!("linear system at t = {t:e}: {msg}"),
        other => format!("{other:?}").chars().take(120).collect(),
    }
}
