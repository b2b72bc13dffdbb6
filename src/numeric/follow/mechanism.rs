//! Bodies with constraints, moved in time by Newton's and Euler's equations.
//!
//! In: masses, constraints, constant forces, a state; all in units in which they are of ordinary size. Out: the state and
//! the time at which something happens, with samples on the way. The accelerations come with the multipliers of the
//! constraints from one linear system, M a − Jᵀλ = F and J a = −J̇ v; the integrator is the explicit Runge–Kutta method of
//! order 8 of Dormand and Prince (Hairer, Nørsett & Wanner, Solving Ordinary Differential Equations I, II.5). Nothing here
//! knows of energy.
//!
//! A state is a list: x, y, angle of each body, then their rates.

use std::cell::{Cell, RefCell};

use differential_equations::prelude::{ExplicitRungeKutta, IVP, ODE};

/// Pieces into which a motion may be cut.
const PIECES: usize = 20_000;
/// Times that the accelerations of one motion may be asked for; at usual values it is some thousand times.
const LOOKS: u32 = 50_000;
/// Length of a piece; in the units of the mechanism something happens within 1.
const PIECE: f64 = 0.5;
/// What counts as reached at a place where the motion comes to rest.
const REACHED: f64 = 1e-12;

/// A goal missed by less than this is met.
const CLOSE: f64 = 2e-16;

/// Something that bodies cannot do.
#[derive(Clone)]
pub(super) enum Constraint {
    /// A point of a body stays at the origin; the arm leads from the body's center to it, in the body's frame.
    Pin {
        /// The body.
        body: usize,
        /// The arm.
        arm: [f64; 2],
    },
    /// The second body keeps its place and angle in the frame of the first; the arm leads from the first center to the second.
    Weld {
        /// The bodies.
        bodies: [usize; 2],
        /// The arm.
        arm: [f64; 2],
    },
    /// A sum of rates is zero, each with a factor; rates count as in the second half of a state.
    Sum(Vec<(usize, f64)>),
}

/// Bodies, what they cannot do, and what acts on them.
#[derive(Clone)]
pub(super) struct Mechanism {
    /// Mass and moment of inertia about the center, of each body.
    pub inertias: Vec<[f64; 2]>,
    /// The constraints.
    pub constraints: Vec<Constraint>,
    /// Force and moment on each body; they do not change.
    pub forces: Vec<[f64; 3]>,
    /// What was asked of it so far.
    pub asked: Asked,
}

/// How often accelerations were asked for, and what was found last.
#[derive(Clone, Default)]
pub(super) struct Asked {
    looks: Cell<u32>,
    last: RefCell<Option<(Vec<f64>, Solved)>>,
}

/// Accelerations, and the multipliers of the constraints.
type Solved = (Vec<f64>, Vec<f64>);

/// A motion that got to its end.
pub(super) struct Run {
    /// How long it took.
    pub time: f64,
    /// State at the end.
    pub end: Vec<f64>,
    /// Times and states on the way, beginning and end among them.
    pub samples: Vec<(f64, Vec<f64>)>,
}

/// Why a motion did not get to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stop {
    /// The motion says so itself.
    Never,
    /// The number of pieces, or of times that accelerations may be asked for, is used up.
    TooLong,
    /// The equations of motion have no single solution, or the numbers leave the doubles.
    Broken,
}

/// How far a motion is from its end.
pub(super) struct Goal<'a> {
    /// Negative until the end is reached.
    pub left: &'a dyn Fn(&[f64]) -> f64,
    /// A rate that changes its sign where the motion turns back.
    pub rate: &'a dyn Fn(&[f64]) -> f64,
    /// Whether the end will never come, seen after each piece; `true` for its argument where the motion has just turned back.
    pub never: &'a mut dyn FnMut(&[f64], bool) -> bool,
}

impl Mechanism {
    /// Accelerations, and the multipliers in the order of the constraints; those of a pin are the force on the body.
    pub fn accelerations(&self, y: &[f64]) -> Option<Solved> {
        let mut last = self.asked.last.borrow_mut();
        if let Some((at, solved)) = &*last
            && at.iter().copied().eq(self.changing(y))
        {
            return Some(solved.clone());
        }
        let solved = self.solved(y)?;
        *last = Some((self.changing(y).collect(), solved.clone()));
        Some(solved)
    }

    /// What the accelerations depend on: the forces, and the angle and spin of each body whose arm turns.
    fn changing(&self, y: &[f64]) -> impl Iterator<Item = f64> {
        let turning = self.constraints.iter().filter_map(|c| match c {
            Constraint::Pin { body, .. } => Some(*body),
            Constraint::Weld { bodies, .. } => Some(bodies[0]),
            Constraint::Sum(_) => None,
        });
        let angles = turning.map(|body| 3 * body + 2);
        let angles = angles.flat_map(|angle| [y[angle], y[y.len() / 2 + angle]]);
        self.forces.iter().flatten().copied().chain(angles)
    }

    fn solved(&self, y: &[f64]) -> Option<Solved> {
        let n = 3 * self.inertias.len();
        let (place, rate) = y.split_at(n);
        let turned = |b: usize, [x, y]: [f64; 2]| {
            let (s, c) = place[3 * b + 2].sin_cos();
            [x * c - y * s, x * s + y * c]
        };
        let all = n + self.constraints.iter().map(Constraint::rows).sum::<usize>();
        // Row by row, each with its right side behind.
        let width = all + 1;
        let mut system = vec![0.0; all * width];
        for (b, [mass, inertia]) in self.inertias.iter().enumerate() {
            for (k, m) in [mass, mass, inertia].into_iter().enumerate() {
                let row = &mut system[(3 * b + k) * width..];
                row[3 * b + k] = *m;
                row[all] = self.forces[b][k];
            }
        }
        let mut i = n;
        let mut put = |terms: &[(usize, f64)], value: f64| {
            for (k, factor) in terms {
                system[i * width + k] = *factor;
                system[k * width + i] = -factor;
            }
            system[i * width + all] = value;
            i += 1;
        };
        for constraint in &self.constraints {
            match constraint {
                Constraint::Pin { body, arm } => {
                    let (r, w) = (turned(*body, *arm), rate[3 * body + 2]);
                    let b = 3 * body;
                    put(&[(b, 1.0), (b + 2, -r[1])], w * w * r[0]);
                    put(&[(b + 1, 1.0), (b + 2, r[0])], w * w * r[1]);
                }
                Constraint::Weld { bodies, arm } => {
                    let [a, b] = bodies.map(|b| 3 * b);
                    let (r, w) = (turned(bodies[0], *arm), rate[a + 2]);
                    let x = [(b, 1.0), (a, -1.0), (a + 2, r[1])];
                    let y = [(b + 1, 1.0), (a + 1, -1.0), (a + 2, -r[0])];
                    put(&x, -w * w * r[0]);
                    put(&y, -w * w * r[1]);
                    put(&[(b + 2, 1.0), (a + 2, -1.0)], 0.0);
                }
                Constraint::Sum(row) => put(row, 0.0),
            }
        }
        let mut accelerations = unknowns(&mut system, all);
        let multipliers = accelerations.split_off(n);
        let mut found = accelerations.iter().chain(&multipliers);
        let is_sound = found.all(|v| v.is_finite());
        is_sound.then_some((accelerations, multipliers))
    }
}

impl Constraint {
    /// How many equations it is.
    fn rows(&self) -> usize {
        match self {
            Constraint::Pin { .. } => 2,
            Constraint::Weld { .. } => 3,
            Constraint::Sum(_) => 1,
        }
    }
}

/// The unknowns of n equations with their right sides behind, by elimination with partial pivoting; not finite where there is no
/// single solution. (Golub & Van Loan, Matrix Computations, 3.4.)
fn unknowns(rows: &mut [f64], n: usize) -> Vec<f64> {
    let width = n + 1;
    for k in 0..n {
        let size = |i: &usize| rows[i * width + k].abs();
        let largest = (k..n).max_by(|i, j| size(i).total_cmp(&size(j)));
        let (above, below) = rows.split_at_mut((k + 1) * width);
        let pivot = &mut above[k * width..];
        if let Some(largest) = largest.filter(|largest| *largest > k) {
            let other = &mut below[(largest - k - 1) * width..][..width];
            pivot.swap_with_slice(other);
        }
        let pivot = &pivot[k..];
        // Most entries are zero.
        for row in below.chunks_exact_mut(width) {
            let row = &mut row[k..];
            if row[0] != 0.0 {
                let factor = row[0] / pivot[0];
                let both = row.iter_mut().zip(pivot);
                both.for_each(|(entry, p)| *entry -= factor * p);
            }
        }
    }
    let mut out = vec![0.0; n];
    for (k, row) in rows.chunks_exact(width).enumerate().rev() {
        let known = row[k + 1..n].iter().zip(&out[k + 1..]);
        let known: f64 = known.map(|(factor, x)| factor * x).sum();
        out[k] = (row[n] - known) / row[k];
    }
    out
}

impl Mobile for Mechanism {
    fn accelerations_of(&self, y: &[f64]) -> Option<Vec<f64>> {
        Some(self.accelerations(y)?.0)
    }

    fn looks(&self) -> &Cell<u32> {
        &self.asked.looks
    }
}

/// Bodies that move as one along a line, on a spring.
pub(super) struct Sprung<'a> {
    /// The bodies without the spring.
    pub smooth: &'a Mechanism,
    /// Direction of the line.
    pub along: [f64; 2],
    /// Stiffness.
    pub stiffness: f64,
    /// How all rates change by one unit of force along the line.
    pub push: Vec<f64>,
    /// The way of the first body at which the spring is relaxed; it begins at the origin.
    pub relaxed: f64,
}

impl Mobile for Sprung<'_> {
    fn accelerations_of(&self, y: &[f64]) -> Option<Vec<f64>> {
        let mut all = self.smooth.accelerations_of(y)?;
        let way = y[0] * self.along[0] + y[1] * self.along[1];
        let force = self.stiffness * (self.relaxed - way);
        for (rate, push) in all.iter_mut().zip(&self.push) {
            *rate += force * push;
        }
        Some(all)
    }

    fn looks(&self) -> &Cell<u32> {
        self.smooth.looks()
    }
}

/// What moves by itself in time, with places in the first half of its state and rates in the second.
pub(super) trait Mobile {
    /// How the rates change.
    fn accelerations_of(&self, y: &[f64]) -> Option<Vec<f64>>;

    /// How often that was asked for.
    fn looks(&self) -> &Cell<u32>;

    /// Moves on until something that keeps growing is no longer negative.
    fn until_grown(&self, start: &[f64], left: &dyn Fn(&[f64]) -> f64) -> Result<Run, Stop> {
        let mut goal = Goal {
            left,
            rate: &|_| 1.0,
            never: &mut |_, _| false,
        };
        self.until(start, &mut goal)
    }

    /// Moves on until the goal is reached.
    fn until(&self, start: &[f64], goal: &mut Goal<'_>) -> Result<Run, Stop> {
        let mut run = Run::at(start);
        if (goal.left)(start) >= 0.0 {
            return Ok(run);
        }
        for _ in 0..PIECES {
            let next = self.advance(&run.end, PIECE)?;
            let rates = [&run.end, &next].map(|y| (goal.rate)(y));
            let turns_back = rates[0] * rates[1] < 0.0;
            let mut beyond = ((goal.left)(&next) >= 0.0).then(|| (PIECE, next.clone()));
            if turns_back {
                let sign = rates[1].signum();
                let there = (PIECE, next.clone());
                let (time, rest) = self.root(&run.end, there, &|y| sign * (goal.rate)(y))?;
                let left = (goal.left)(&rest);
                if (-REACHED..0.0).contains(&left) {
                    return Ok(run.ended(time, rest));
                }
                if left >= 0.0 {
                    beyond = Some((time, rest));
                }
            }
            if let Some(beyond) = beyond {
                let (time, end) = self.root(&run.end, beyond, goal.left)?;
                return Ok(run.ended(time, end));
            }
            run = run.ended(PIECE, next);
            if (goal.never)(&run.end, turns_back) {
                return Err(Stop::Never);
            }
        }
        Err(Stop::TooLong)
    }

    /// Moves on for a time.
    fn lasting(&self, start: &[f64], time: f64) -> Result<Run, Stop> {
        let mut run = Run::at(start);
        let pieces = (time / PIECE).ceil().max(1.0);
        if pieces > PIECES as f64 {
            return Err(Stop::TooLong);
        }
        for _ in 0..pieces as usize {
            let step = time / pieces;
            let next = self.advance(&run.end, step)?;
            run = run.ended(step, next);
        }
        run.time = time;
        Ok(run)
    }

    /// The first state within a piece at which a function that begins negative is not, by the Illinois method; it is none at
    /// the time and state that are given. What is left to move through gets shorter with the interval.
    fn root(
        &self,
        start: &[f64],
        (longest, mut state): (f64, Vec<f64>),
        f: &dyn Fn(&[f64]) -> f64,
    ) -> Result<(f64, Vec<f64>), Stop> {
        let (mut low, mut high) = ((0.0, f(start)), (longest, f(&state)));
        let mut before = start.to_vec();
        let mut kept = 0i32;
        for _ in 0..80 {
            if high.0 - low.0 <= 4.0 * f64::EPSILON * longest || high.1 == 0.0 {
                break;
            }
            let secant = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
            let time = match secant > low.0 && secant < high.0 {
                true => secant,
                false => 0.5 * (low.0 + high.0),
            };
            let there = self.advance(&before, time - low.0)?;
            let value = f(&there);
            if value < 0.0 {
                // The end that stays counts half, or it would stay for ever.
                if kept > 0 {
                    high.1 /= 2.0;
                }
                (low, kept) = ((time, value), kept.max(0) + 1);
                before = there;
                if value > -CLOSE {
                    (high.0, state) = (time, before);
                    break;
                }
            } else {
                if kept < 0 {
                    low.1 /= 2.0;
                }
                (high, kept, state) = ((time, value), kept.min(0) - 1, there);
                if value < CLOSE {
                    break;
                }
            }
        }
        Ok((high.0, state))
    }

    /// The state after a time.
    fn advance(&self, start: &[f64], time: f64) -> Result<Vec<f64>, Stop> {
        if time <= 0.0 {
            return Ok(start.to_vec());
        }
        let rates = |y: &[f64]| {
            self.looks().set(self.looks().get() + 1);
            (self.looks().get() <= LOOKS).then(|| self.rates(y))?
        };
        let found = integrated(&rates, start, time);
        match self.looks().get() > LOOKS {
            true => Err(Stop::TooLong),
            false => found.ok_or(Stop::Broken),
        }
    }

    fn rates(&self, y: &[f64]) -> Option<Vec<f64>> {
        let n = y.len() / 2;
        Some([&y[n..], &self.accelerations_of(y)?].concat())
    }
}

impl Run {
    fn at(start: &[f64]) -> Run {
        Run {
            time: 0.0,
            end: start.to_vec(),
            samples: vec![(0.0, start.to_vec())],
        }
    }

    fn ended(mut self, step: f64, end: Vec<f64>) -> Run {
        self.time += step;
        self.samples.push((self.time, end.clone()));
        self.end = end;
        self
    }
}

/// The state after a time; `None` where the rates have no value on the way.
pub fn integrated(
    rates: &dyn Fn(&[f64]) -> Option<Vec<f64>>,
    start: &[f64],
    time: f64,
) -> Option<Vec<f64>> {
    struct Equations<'a>(&'a dyn Fn(&[f64]) -> Option<Vec<f64>>);
    impl ODE<f64, Vec<f64>> for Equations<'_> {
        fn diff(&self, _: f64, y: &Vec<f64>, rates: &mut Vec<f64>) {
            match (self.0)(y) {
                Some(found) => rates.copy_from_slice(&found),
                None => rates.fill(f64::NAN),
            }
        }
    }
    let is_finite = |all: &[f64]| all.iter().all(|v| v.is_finite());
    rates(start).filter(|rates| is_finite(rates))?;
    let method = ExplicitRungeKutta::dop853().rtol(1e-12).atol(1e-14);
    let solution = IVP::ode(&Equations(rates), 0.0, time, start.to_vec())
        .method(method)
        .solve()
        .ok()?;
    let end = solution.y.last()?.clone();
    is_finite(&end).then_some(end)
}
