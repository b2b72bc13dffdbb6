//! Motions integrated in time from Newton's laws at points of the domain, and held against the closed forms.
//!
//! In: a stage and what was found of it. Out: checks. Nothing here uses work or energy; where the integrator is not built in
//! (feature `report`), the check says that it was not carried out.

use std::collections::BTreeSet;

use super::StageTold;
use crate::domain::{Domains, Limit};
use crate::expr::{Expr, Point, Symbol, Vector};
use crate::scene::{Fall, FallEnd, Slide, Stage, Turn, Until, Wind};
use crate::verify::Check;

/// Points at which motions are integrated.
const POINTS: u64 = 3;
/// Points that are tried to find them.
const TRIED: u64 = 60;
/// The first of these are of ordinary size.
const ORDINARY: u64 = 12;
/// Relative difference that counts as agreement; the integrator works to 1e-12.
const CLOSE: f64 = 1e-7;

/// Angle at which a motion out of balance is taken up; what weight does until there is of the order of its square.
const NUDGE: f64 = 1e-6;

/// Points of the domain in doubles for some expressions: every symbol at its own golden fraction of the interval, the same
/// on every machine.
pub(super) fn points(stage: &Stage, all: &[&Expr], count: u64) -> Vec<Point<f64>> {
    points_in(&stage.scene.domains, all, count)
}

fn points_in(domains: &Domains, all: &[&Expr], count: u64) -> Vec<Point<f64>> {
    let names: BTreeSet<Symbol> = all.iter().flat_map(|e| e.symbols()).collect();
    let value = |name: &Symbol, k: u64, seed: u64| {
        let domain = domains.symbols.get(name);
        let fraction =
            (0.618_033_988_75 * (k + 1) as f64 + 0.381_7 * seed as f64).fract() * 0.9 + 0.05;
        // Later points are of all sizes: a motion may get to its end only where something is large.
        let size = (0.754_877_666 * (k + 1) as f64 + 0.569_840_291 * seed as f64).fract();
        let size = match seed {
            0..=ORDINARY => 1.0,
            _ => 10f64.powf(6.0 * size - 3.0),
        };
        let low = domain.and_then(|d| d.low.as_ref()).map(Limit::approximate);
        let high = domain.and_then(|d| d.high.as_ref()).map(Limit::approximate);
        match (low, high) {
            (Some(low), Some(high)) => low + fraction * (high - low),
            (Some(low), None) => low + (0.3 + 2.0 * fraction) * size,
            (None, Some(high)) => high - (0.3 + 2.0 * fraction) * size,
            (None, None) => (4.0 * fraction - 2.0) * size,
        }
    };
    (1..=count)
        .map(|seed| Point {
            values: (0..)
                .zip(&names)
                .map(|(k, name)| (name.clone(), value(name, k, seed)))
                .collect(),
            ..Point::default()
        })
        .collect()
}

fn check(worst: f64, count: usize, what: &str) -> Check {
    if count == 0 {
        return Check {
            kind: "integration",
            words: format!("{what}: not integrated"),
            holds: None,
        };
    }
    // The integrator works to 1e-12; what is below is the rounding of the machine at hand.
    let worst_shown = if worst <= 1e-12 { 1e-12 } else { worst };
    Check {
        kind: "integration",
        words: format!(
            "{what}: integrated in time at {count} point{}, relative difference at most {worst_shown:.0e}",
            if count == 1 { "" } else { "s" }
        ),
        holds: Some(worst < CLOSE),
    }
}

/// A rotation: I θ″ = moment of weight and applied moment.
pub(super) fn turn(stage: &Stage, told: &StageTold, turn: &Turn, way: i64) -> Vec<Check> {
    if turn.gravity.is_none() && turn.torque.is_none() || matches!(turn.until, Until::For(_)) {
        return Vec::new();
    }
    let body = turn.lump(&stage.scene);
    let [r, r_end] = super::motion::arms(stage, turn, &told.before.spin[turn.body]);
    let inertia = super::motion::inertia_about(stage, turn);
    let zero = Expr::zero();
    let g = turn.gravity.as_ref().unwrap_or(&zero);
    let torque = turn.torque.as_ref().unwrap_or(&zero);
    let by = match &turn.until {
        Until::By(by) => by.clone(),
        _ => zero.clone(),
    };
    let (begin, end) = (&told.before.spin[turn.body], &told.after.spin[turn.body]);
    let all = [
        &r[0], &r[1], &r_end[0], &r_end[1], &inertia, &body.mass, g, torque, &by, begin, end,
    ];
    // Out of balance the motion begins a little way on, where it would have got by an even smaller push.
    let nudge = match super::motion::is_balanced(stage, turn, begin, &r) {
        true => NUDGE,
        false => 0.0,
    };
    let (mut worst, mut count) = (0.0f64, 0);
    for point in points(stage, &all, TRIED) {
        let value = |e: &Expr| e.evaluate(&point);
        let values: Option<Vec<f64>> = all.iter().map(|e| value(e)).collect();
        let Some(v) = values else { continue };
        let way = way as f64;
        let angle = match turn.until {
            Until::By(_) if v[8] < 0.0 => continue,
            Until::By(_) => v[8],
            // From r to r_end in the sense of the rotation.
            _ => (way * (v[0] * v[3] - v[1] * v[2]))
                .atan2(v[0] * v[2] + v[1] * v[3])
                .rem_euclid(std::f64::consts::TAU),
        };
        let (s, c) = (way * nudge).sin_cos();
        let motion = Rotation {
            r: [v[0] * c - v[1] * s, v[0] * s + v[1] * c],
            inertia: v[4],
            weight: v[5] * v[6],
            torque: v[7],
            way,
        };
        let Some(speed) = motion.speed_at(angle - nudge, way * v[9]) else {
            continue;
        };
        let expected = way * v[10];
        // Squares are compared, as energies: at a place just reached the speed itself is the root of rounding.
        let gap = speed * speed.abs() - expected * expected.abs();
        let largest = expected.abs().max(v[9].abs());
        worst = worst.max(gap.abs() / (largest * largest).max(motion.rate()).max(1e-300));
        count += 1;
        if count as u64 == POINTS {
            break;
        }
    }
    vec![check(worst, count, "spin at the end")]
}

/// The force of the fixed point on a turning body, from the acceleration of the center of mass: differences of its places on
/// the integrated motion, a little before and after.
pub(super) fn reaction(
    stage: &Stage,
    turn: &Turn,
    way: i64,
    (at_end, spin): (bool, &Expr),
    along: &Vector,
    force: &Expr,
) -> Check {
    let body = turn.lump(&stage.scene);
    let r = &super::motion::arms(stage, turn, spin)[usize::from(at_end)];
    let inertia = super::motion::inertia_about(stage, turn);
    let zero = Expr::zero();
    let g = turn.gravity.as_ref().unwrap_or(&zero);
    let torque = turn.torque.as_ref().unwrap_or(&zero);
    let all = [
        &r[0], &r[1], &inertia, &body.mass, g, torque, spin, &along[0], &along[1], force,
    ];
    let (mut worst, mut count) = (0.0f64, 0);
    for point in points(stage, &all, TRIED) {
        let values: Option<Vec<f64>> = all.iter().map(|e| e.evaluate(&point)).collect();
        let Some(v) = values else { continue };
        let way = way as f64;
        let [x, y, inertia, mass, g, torque, spin, ax, ay, told] = v[..] else {
            continue;
        };
        let motion = Rotation {
            r: [x, y],
            inertia,
            weight: mass * g,
            torque,
            way,
        };
        let size = mass * x.hypot(y) * (spin * spin + motion.rate()) + mass * g;
        let step = 1e-3 * motion.unit(spin);
        let field = |y: [f64; 2]| [y[1], motion.acceleration(y[0])];
        let place = |time: f64| {
            let [angle, _] = advance(field, [0.0, way * spin], time)?;
            let (s, c) = (way * angle).sin_cos();
            Some([x * c - y * s, x * s + y * c])
        };
        // Backwards in time: the same motion with the speed turned round.
        let back = |time: f64| {
            let [angle, _] = advance(field, [0.0, -way * spin], time)?;
            let (s, c) = (way * angle).sin_cos();
            Some([x * c - y * s, x * s + y * c])
        };
        let (Some(after), Some(before)) = (place(step), back(step)) else {
            continue;
        };
        let bend = |k: usize| (after[k] - 2.0 * [x, y][k] + before[k]) / (step * step);
        let found = ax * mass * bend(0) + ay * (mass * bend(1) + mass * g);
        worst = worst.max((found - told).abs() / size.max(1e-300));
        count += 1;
        if count as u64 == POINTS {
            break;
        }
    }
    let words = match count {
        0 => String::from("mass times acceleration less the weight: not integrated"),
        _ => format!(
            "mass times the acceleration of the center of mass, seen on the motion integrated in time at {count} points, less the weight: relative difference at most 1e-6"
        ),
    };
    Check {
        kind: "integration",
        words,
        holds: (count > 0).then_some(worst <= 1e-6),
    }
}

/// A rotation about a fixed point; angle and speed count in its own sense.
pub(super) struct Rotation {
    /// Arm from the fixed point to the center of mass at the beginning.
    pub r: [f64; 2],
    /// Moment of inertia about the fixed point.
    pub inertia: f64,
    /// Weight.
    pub weight: f64,
    /// Applied moment, in the sense of the rotation.
    pub torque: f64,
    /// 1 counterclockwise, −1 clockwise.
    pub way: f64,
}

impl Rotation {
    /// Angular acceleration at an angle.
    fn acceleration(&self, angle: f64) -> f64 {
        let (s, c) = (self.way * angle).sin_cos();
        let x = self.r[0] * c - self.r[1] * s;
        (self.torque - self.way * self.weight * x) / self.inertia
    }

    /// The largest angular acceleration there can be.
    fn rate(&self) -> f64 {
        (self.torque.abs() + self.weight * self.r[0].hypot(self.r[1])) / self.inertia
    }

    /// A time in which something happens.
    fn unit(&self, speed: f64) -> f64 {
        0.2 / (self.rate().sqrt() + speed.abs()).max(1e-12)
    }

    /// Angular speed on reaching an angle; `None` where it is not reached.
    pub fn speed_at(&self, angle: f64, speed: f64) -> Option<f64> {
        let (rate, unit) = (self.rate(), self.unit(speed));
        let field = |y: [f64; 2]| [y[1], self.acceleration(y[0])];
        let mut y = [0.0, speed];
        for _ in 0..4000 {
            let next = advance(field, y, unit)?;
            let turned = next[1] < -1e-9 * rate.sqrt();
            // A body that comes to rest within the step may have been there before it turned back.
            let (reach, longest) = if turned {
                rest(field, y, unit)?
            } else {
                (next, unit)
            };
            if turned && reach[0] < angle {
                return None;
            }
            if reach[0] >= angle {
                // Newton on the length of the last step.
                let mut step = longest * (angle - y[0]) / (reach[0] - y[0]).max(1e-300);
                let mut last = y;
                for _ in 0..30 {
                    last = advance(field, y, step)?;
                    let miss = angle - last[0];
                    if miss.abs() < 1e-13 || last[1].abs() < 1e-12 {
                        break;
                    }
                    step = (step + miss / last[1]).clamp(0.0, longest);
                }
                return Some(last[1]);
            }
            y = next;
        }
        None
    }
}

/// The place within a step at which the speed falls to zero, and the time until then.
fn rest(field: impl Fn([f64; 2]) -> [f64; 2], y: [f64; 2], step: f64) -> Option<([f64; 2], f64)> {
    let (mut low, mut high) = (0.0, step);
    let mut place = y;
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        place = advance(&field, y, middle)?;
        if place[1] > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some((place, high))
}

/// Whether a rotation gets to its end at a point, by integration in time; `None` where it could not be integrated.
pub(super) fn gets_there(
    stage: &Stage,
    told: &StageTold,
    turn: &Turn,
    way: i64,
    point: &Point<f64>,
) -> Option<bool> {
    let body = turn.lump(&stage.scene);
    let [r, r_end] = super::motion::arms(stage, turn, &told.before.spin[turn.body]);
    let zero = Expr::zero();
    let value = |e: &Expr| e.evaluate(point);
    let way = way as f64;
    let [x, y, u, w] = [
        value(&r[0])?,
        value(&r[1])?,
        value(&r_end[0])?,
        value(&r_end[1])?,
    ];
    let angle = match &turn.until {
        Until::By(by) => value(by)?,
        _ => (way * (x * w - y * u))
            .atan2(x * u + y * w)
            .rem_euclid(std::f64::consts::TAU),
    };
    let motion = Rotation {
        r: [x, y],
        inertia: value(&super::motion::inertia_about(stage, turn))?,
        weight: value(&body.mass)? * value(turn.gravity.as_ref().unwrap_or(&zero))?,
        torque: value(turn.torque.as_ref().unwrap_or(&zero))?,
        way,
    };
    // A first step tells whether there is an integrator at all.
    advance(|y| [y[1], 0.0], [0.0, 1.0], 1.0)?;
    Some(
        motion
            .speed_at(angle, way * value(&told.before.spin[turn.body])?)
            .is_some(),
    )
}

/// Just below and just above a threshold a rotation behaves differently: integrated in time on both sides.
pub(super) fn both_sides(
    stage: &Stage,
    told: &StageTold,
    turn: &Turn,
    way: i64,
    parameter: &Symbol,
    value: &Expr,
) -> Check {
    let mut all = vec![value, &told.before.spin[turn.body]];
    let [r, r_end] = super::motion::arms(stage, turn, &told.before.spin[turn.body]);
    let inertia = super::motion::inertia_about(stage, turn);
    all.extend(r.iter().chain(&r_end));
    let mass = turn.lump(&stage.scene).mass;
    all.extend([&inertia, &mass]);
    all.extend(turn.gravity.iter().chain(&turn.torque));
    let (mut parted, mut count) = (0, 0);
    for mut point in points(stage, &all, POINTS) {
        let Some(critical) = value.evaluate(&point) else {
            continue;
        };
        let mut at = |factor: f64| {
            point.values.insert(parameter.clone(), critical * factor);
            gets_there(stage, told, turn, way, &point)
        };
        let (Some(below), Some(above)) = (at(0.999), at(1.001)) else {
            continue;
        };
        count += 1;
        parted += usize::from(below != above);
    }
    Check {
        kind: "integration",
        words: if count == 0 {
            String::from("not integrated on both sides")
        } else {
            format!(
                "integrated in time a thousandth below and above it: `{}` gets to its end on one side only at {parted} of {count} points",
                stage.name
            )
        },
        holds: (count > 0).then_some(parted == count),
    }
}

/// A body on a spring under a constant force: m y″ = 1/τ − k y over the time τ, from rest. The blow is 1, what is left of it
/// moves the body, and the spring has taken the rest.
pub(super) fn share(
    domains: &Domains,
    [mass, stiffness, during]: [&Expr; 3],
    share: &Expr,
) -> Check {
    let (mut worst, mut count) = (0.0f64, 0);
    for point in points_in(domains, &[mass, stiffness, during], POINTS) {
        let value = |e: &Expr| e.evaluate(&point);
        let (Some(m), Some(k), Some(time), Some(expected)) =
            (value(mass), value(stiffness), value(during), value(share))
        else {
            continue;
        };
        let field = |y: [f64; 2]| [y[1], (1.0 / time - k * y[0]) / m];
        let Some([_, speed]) = advance(field, [0.0, 0.0], time) else {
            continue;
        };
        worst = worst.max((1.0 - m * speed - expected).abs() / expected.abs().max(1e-9));
        count += 1;
    }
    check(worst, count, "what the spring takes")
}

/// Motion along a line under constant forces, until the distance is covered.
pub(super) fn slide(stage: &Stage, told: &StageTold, slide: &Slide) -> Vec<Check> {
    if slide.gravity.is_none() && slide.force.is_none() {
        return Vec::new();
    }
    let along = |v: &Vector| crate::expr::dot(v, &slide.along);
    let begin = along(&told.before.velocity[slide.body]);
    let end = along(&told.after.velocity[slide.body]);
    let mass = &stage.scene.bodies[slide.body].mass;
    let zero = Expr::zero();
    let g = slide.gravity.as_ref().unwrap_or(&zero);
    let force = slide.force.as_ref().unwrap_or(&zero);
    let all = [
        mass,
        g,
        force,
        &slide.along[1],
        &slide.distance,
        &begin,
        &end,
    ];
    let (mut worst, mut count) = (0.0f64, 0);
    for point in points(stage, &all, TRIED) {
        let values: Option<Vec<f64>> = all.iter().map(|e| e.evaluate(&point)).collect();
        let Some(&[mass, g, force, up, distance, begin, end]) = values.as_deref() else {
            continue;
        };
        // A rotation with constant moment is the same equation.
        let motion = Rotation {
            r: [0.0, 0.0],
            inertia: mass,
            weight: 0.0,
            torque: force - mass * g * up,
            way: 1.0,
        };
        if begin < 0.0 || distance < 0.0 {
            continue;
        }
        let Some(speed) = motion.speed_at(distance, begin) else {
            continue;
        };
        worst = worst.max((speed - end).abs() / end.abs().max(1e-9));
        count += 1;
        if count as u64 == POINTS {
            break;
        }
    }
    vec![check(worst, count, "speed at the end")]
}

/// Free fall: y″ = −g, until the height is fallen through.
pub(super) fn fall(stage: &Stage, told: &StageTold, fall: &Fall) -> Vec<Check> {
    let (Some(g), FallEnd::Drop(h)) = (&fall.gravity, &fall.until) else {
        return Vec::new();
    };
    let (begin, end) = (
        &told.before.velocity[fall.body][1],
        &told.after.velocity[fall.body][1],
    );
    let (mut worst, mut count) = (0.0f64, 0);
    for point in points(stage, &[g, h, begin, end], POINTS) {
        let value = |e: &Expr| e.evaluate(&point);
        let (Some(g), Some(h), Some(v), Some(end)) = (value(g), value(h), value(begin), value(end))
        else {
            continue;
        };
        // A rotation with constant moment is the same equation.
        let motion = Rotation {
            r: [0.0, 0.0],
            inertia: 1.0,
            weight: 0.0,
            torque: g,
            way: 1.0,
        };
        let Some(speed) = motion.speed_at(h, -v) else {
            continue;
        };
        worst = worst.max((speed + end).abs() / end.abs());
        count += 1;
    }
    vec![check(worst, count, "speed at the end")]
}

/// The rope on a pole of small radius ρ: with φ the angle of the tangent point and L = L₀ − ρφ, Lagrange gives φ″ = ρ φ′²/L.
pub(super) fn wind(stage: &Stage, free: &Expr, speed: &Expr, wind: &Wind) -> Vec<Check> {
    let (mut worst, mut count) = (0.0f64, 0);
    for point in points(stage, &[free, speed, &wind.to], TRIED) {
        let value = |e: &Expr| e.evaluate(&point);
        let (Some(free), Some(speed), Some(to)) = (value(free), value(speed), value(&wind.to))
        else {
            continue;
        };
        if to >= free {
            continue;
        }
        let radius = free / 50.0;
        let field = |y: [f64; 2]| [y[1], radius * y[1] * y[1] / (free - radius * y[0])];
        let target = (free - to) / radius;
        let step = to / speed / 40.0;
        let mut y = [0.0, speed / free];
        let mut steps = 0;
        while y[0] < target && steps < 100_000 {
            let Some(next) = advance(field, y, step) else {
                break;
            };
            y = next;
            steps += 1;
        }
        let found = (free - radius * y[0]) * y[1];
        worst = worst.max((found - speed).abs() / speed);
        count += 1;
        if count as u64 == POINTS {
            break;
        }
    }
    vec![check(worst, count, "speed on a pole of finite radius")]
}

/// The state after a time, by an explicit Runge–Kutta method of order 8.
fn advance(field: impl Fn([f64; 2]) -> [f64; 2], y: [f64; 2], time: f64) -> Option<[f64; 2]> {
    use differential_equations::prelude::{ExplicitRungeKutta, IVP, ODE};

    struct System<F>(F);
    impl<F: Fn([f64; 2]) -> [f64; 2]> ODE<f64, [f64; 2]> for System<F> {
        fn diff(&self, _: f64, y: &[f64; 2], dydt: &mut [f64; 2]) {
            *dydt = self.0(*y);
        }
    }
    if time <= 0.0 {
        return Some(y);
    }
    let system = System(field);
    let method = ExplicitRungeKutta::dop853().rtol(1e-12).atol(1e-13);
    let solution = IVP::ode(&system, 0.0, time, y)
        .method(method)
        .solve()
        .ok()?;
    solution.y.last().copied()
}
