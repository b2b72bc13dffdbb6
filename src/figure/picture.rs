//! The pictures before and after.
//!
//! In: a scene on stage, and the motion after as numbers. Out: a sheet.

use super::during::impulses;
use super::label::Label;
use super::marks::{axes, centers, masses, names, turning, velocity, wall_point};
use super::measure;
use super::plane::{Pair, ahead, apart, dot, left, minus, plus, size};
use super::quantity::{LEGIBLE, speed, spin_before, spin_name, vector_name, velocity_name};
use super::sheet::{LONG, Sheet, arrow_length};
use super::stage::{DOT, Moment, Stage};
use crate::expr::{Expr, Point};
use crate::numeric::system::Unknown;
use crate::numeric::{Motion, motion_of, solve_f64, solved};
use crate::scene::Ask;

/// The motion after at the values the scene is drawn at; `None` where the equations contradict each other.
pub fn outcome(stage: &Stage) -> Option<Motion<f64>> {
    let point: &Point<f64> = &stage.values.point;
    let found = solved(stage.scene, point, solve_f64).ok()?;
    let rates = found.motion.velocity.iter().flatten();
    let mut rates = rates.chain(&found.motion.spin);
    rates.all(|v| v.is_finite()).then_some(found.motion)
}

fn fastest(stage: &Stage, after: Option<&Motion<f64>>) -> f64 {
    let before = stage
        .scene
        .bodies
        .iter()
        .filter_map(|b| stage.values.pair(&b.velocity))
        .map(size);
    let after = after
        .iter()
        .flat_map(|m| m.velocity.iter().map(|v| size(*v)));
    before
        .chain(after.filter(|v| v.is_finite()))
        .fold(0.0, f64::max)
}

fn all_bodies(stage: &Stage, sheet: &mut Sheet, moment: Moment, velocity: &[Pair]) -> Vec<Pair> {
    let asides: Vec<Pair> = (0..stage.poses.len())
        .map(|i| stage.aside(i, moment, velocity))
        .collect();
    stage.fixed(sheet);
    for (pose, aside) in stage.poses.iter().zip(&asides) {
        stage.body(sheet, pose, *aside);
    }
    stage.hinges(sheet, &|_| true);
    asides
}

/// Just before: bodies, dimensions, velocities, spins.
pub fn before(stage: &Stage, after: Option<&Motion<f64>>) -> Sheet {
    let mut sheet = Sheet::default();
    let scene = stage.scene;
    let asides = all_bodies(stage, &mut sheet, Moment::Before, &[]);
    centers(stage, &mut sheet, &stage.movable());
    let most = fastest(stage, after);
    for (i, body) in scene.bodies.iter().enumerate() {
        let (Some(v), Some(spin)) = (
            stage.values.pair(&body.velocity),
            stage.values.of(&body.spin),
        ) else {
            continue;
        };
        let start = stage.px(stage.poses[i].center);
        let start = plus(start, asides[i]);
        let start = if body.is_fixed() {
            wall_point(stage, i).unwrap_or(start)
        } else {
            start
        };
        // A body that turns about a hinge is told by its spin.
        let hinged = body.velocity.iter().map(Expr::size).sum::<usize>() > 30 && spin != 0.0;
        if size(v) > 1e-9 * most && !hinged {
            let label = speed(stage, i, &body.velocity, v);
            velocity(
                &mut sheet,
                start,
                v,
                arrow_length(size(v), most),
                label,
                body.is_particle(),
            );
        }
        if spin.abs() > 1e-12 && !body.is_particle() {
            let e = if (spin < 0.0) == body.spin.is_negative() {
                body.spin.clone()
            } else {
                -&body.spin
            };
            let e = if e.is_negative() { -&e } else { e };
            let mut label = Label::formula(&e, scene);
            if label.text().chars().count() > LEGIBLE {
                label = spin_before(stage, i);
            }
            if stage.values.of(&e).is_some_and(|value| value < 0.0) {
                label = label.negated();
            }
            turning(stage, &mut sheet, i, spin, label);
        }
    }
    for push in impulses(stage, &stage.movable(), after) {
        if push.is_blow {
            push.draw(stage, &mut sheet, LONG, false);
        }
    }
    measure::measure(stage, &mut sheet);
    names(stage, &mut sheet, &stage.movable(), true);
    masses(stage, &mut sheet, &asides);
    sheet.settle();
    axes(&mut sheet);
    sheet
}

/// Just after, at the values the scene is drawn at.
pub fn after(stage: &Stage, motion: &Motion<f64>) -> Sheet {
    let mut sheet = Sheet::default();
    let scene = stage.scene;
    let asides = all_bodies(stage, &mut sheet, Moment::After, &motion.velocity);
    centers(stage, &mut sheet, &stage.movable());
    let most = fastest(stage, Some(motion));
    let fastest_spin = motion.spin.iter().fold(0.0, |m: f64, s| m.max(s.abs()));
    for (i, body) in scene.bodies.iter().enumerate() {
        let known = motion.determines(Unknown::Velocity(i, 0))
            && motion.determines(Unknown::Velocity(i, 1));
        let v = motion.velocity[i];
        let start = stage.px(stage.poses[i].center);
        let start = plus(start, asides[i]);
        let told = body.is_particle() && asked_at(stage, motion, stage.poses[i].center, v);
        // Of particles that go on together the foremost has the arrow.
        let leads = |j: &usize| {
            let ahead_of = minus(plus(stage.px(stage.poses[*j].center), asides[*j]), start);
            let together =
                size(minus(motion.velocity[*j], v)) < 1e-7 * most && size(ahead_of) < 3.0 * DOT;
            scene.bodies[*j].is_particle() && together && dot(ahead_of, v) > 1e-9
        };
        let told = told || body.is_particle() && stage.movable().iter().any(leads);
        if known && size(v) > 1e-7 * most && !body.is_fixed() && !told {
            velocity(
                &mut sheet,
                start,
                v,
                arrow_length(size(v), most),
                velocity_name(stage, i),
                false,
            );
        }
        let spin = motion.spin[i];
        let known = motion.determines(Unknown::Spin(i));
        if known && spin.abs() > 1e-7 * fastest_spin && !body.is_particle() && !body.is_fixed() {
            turning(stage, &mut sheet, i, spin, spin_name(stage, i, spin));
        }
    }
    for question in scene.asked_of_impact() {
        let Ask::Velocity {
            body,
            point: Some((_, at)),
            along: None,
        } = &question.ask
        else {
            continue;
        };
        let Some(p) = stage.values.pair(at) else {
            continue;
        };
        let v = of_point(stage, motion, *body, p);
        let known = motion_of(*body);
        if size(v) > 1e-7 * most && known.into_iter().all(|u| motion.determines(u)) {
            let label = vector_name(&question.name, question.latex.as_deref());
            velocity(
                &mut sheet,
                stage.px(p),
                v,
                arrow_length(size(v), most.max(size(v))),
                label,
                false,
            );
        }
    }
    names(stage, &mut sheet, &stage.movable(), true);
    sheet.settle();
    sheet
}

/// Velocity after of the point of a body that is somewhere now.
fn of_point(stage: &Stage, motion: &Motion<f64>, body: usize, at: Pair) -> Pair {
    let arm = minus(at, stage.poses[body].center);
    ahead(motion.velocity[body], left(arm), motion.spin[body])
}

/// Whether a question about a point of another body already shows this velocity here.
fn asked_at(stage: &Stage, motion: &Motion<f64>, at: Pair, v: Pair) -> bool {
    stage.scene.asked_of_impact().any(|question| {
        let Ask::Velocity {
            body,
            point: Some((_, p)),
            along: None,
        } = &question.ask
        else {
            return false;
        };
        let Some(p) = stage.values.pair(p) else {
            return false;
        };
        let u = of_point(stage, motion, *body, p);
        apart(p, at) < 1e-9 && apart(u, v) <= 1e-6 * size(v)
    })
}
