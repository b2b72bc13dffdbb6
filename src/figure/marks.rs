//! What stands on a picture beside the bodies: arrows, centers, names of points, masses, axes.

use std::f64::consts::PI;

use super::label::Label;
use super::place::{Room, Spot};
use super::plane::{Pair, ahead, apart, between, distance, plus, polar, size, unit};
use super::pose::{Look, Pose};
use super::sheet::{Ink, Item, Paint, SIZE, SMALL, Sheet};
use super::stage::{DOT, Stage, center_name};
use crate::expr::Vector;
use crate::scene::{Body, Shape};

/// A velocity arrow from a body, or with its head at a particle that flies towards its target.
pub(super) fn velocity(
    sheet: &mut Sheet,
    at: Pair,
    v: Pair,
    length: f64,
    label: Label,
    behind: bool,
) {
    let d = unit(v);
    let (from, to) = if behind {
        (
            ahead(at, d, -(length + DOT + 3.0)),
            ahead(at, d, -(DOT + 3.0)),
        )
    } else {
        (at, ahead(at, d, length))
    };
    sheet.arrow(from, to, Ink::Motion, 2.0);
    sheet.wish(label, SIZE, Spot::Along { from, to });
}

/// A curved arrow around a body's center, clear of its velocity.
pub(super) fn turning(stage: &Stage, sheet: &mut Sheet, body: usize, spin: f64, label: Label) {
    let center = stage.px(stage.poses[body].center);
    let radius = match &stage.poses[body].look {
        Look::Round { radius, .. } => (0.55 * stage.long(*radius)).clamp(14.0, 30.0),
        _ => 20.0,
    };
    let sign = spin.signum();
    let busy = |start: f64| {
        let steps = 12;
        (0..=steps)
            .map(|k| {
                let phi = start + sign * 1.4 * PI * 0.75 * f64::from(k) / f64::from(steps);
                let p = polar(center, radius, phi);
                let near = sheet
                    .walls
                    .iter()
                    .filter(|(a, b, _)| distance(p, *a, *b) < 4.0)
                    .count();
                near as f64
            })
            .sum::<f64>()
    };
    let start = (0..12)
        .map(|k| PI * f64::from(k) / 6.0)
        .min_by(|a, b| busy(*a).total_cmp(&busy(*b)))
        .unwrap_or(0.0);
    let sweep = sign * 1.05 * PI;
    sheet.turning(center, radius, start, sweep, Ink::Motion);
    let half = start + sweep / 2.0;
    let at = polar(center, radius, half);
    sheet.wish(label, SIZE, Spot::point(at, [half.cos(), half.sin()], 2.0));
}

/// Where a fixed body is drawn.
pub(super) fn wall_point(stage: &Stage, body: usize) -> Option<Pair> {
    stage
        .scene
        .contacts
        .iter()
        .find(|c| c.bodies.contains(&body))
        .and_then(|c| stage.spot(&c.at))
}

/// Dots and names at centers of mass.
pub(super) fn centers(stage: &Stage, sheet: &mut Sheet, bodies: &[usize]) {
    for i in bodies {
        let Some(label) = center_name(stage, *i) else {
            continue;
        };
        let at = stage.px(stage.poses[*i].center);
        sheet.dot(at, 2.4, Ink::Body);
        sheet.wish(label, SIZE, Spot::point(at, [0.0, 0.0], 3.0));
    }
}

/// Whether a place is far from all particles it belongs to: the other end of their string.
fn is_far(stage: &Stage, pair: &[usize; 2], shown: &[usize], at: &Vector) -> bool {
    let mut mine = pair.iter().filter(|b| shown.contains(b));
    let far = |b: &usize| {
        let center = stage.px(stage.poses[*b].center);
        stage.scene.bodies[*b].is_particle()
            && stage.spot(at).is_some_and(|p| apart(p, center) > 3.0 * DOT)
    };
    mine.all(far)
}

/// Names of points, contacts and hinges, each place once.
pub(super) fn names(stage: &Stage, sheet: &mut Sheet, bodies: &[usize], free: bool) {
    let scene = stage.scene;
    let touches = |pair: &[usize; 2]| pair.iter().any(|b| bodies.contains(b));
    let joints = scene
        .contacts
        .iter()
        .filter(|c| touches(&c.bodies) && (free || !is_far(stage, &c.bodies, bodies, &c.at)))
        .map(|c| (&c.name, &c.at))
        .chain(
            scene
                .hinges
                .iter()
                .filter(|h| touches(&h.bodies))
                .map(|h| (&h.name, &h.at)),
        );
    let blown: Vec<&Vector> = scene
        .blows
        .iter()
        .filter(|b| bodies.contains(&b.body))
        .map(|b| &b.at)
        .collect();
    let points = scene
        .points
        .iter()
        .filter(|p| free || blown.contains(&&p.at))
        .map(|p| (&p.name, &p.at));
    let mut done: Vec<Pair> = bodies
        .iter()
        .filter(|i| center_name(stage, **i).is_some())
        .map(|i| stage.px(stage.poses[*i].center))
        .collect();
    for (name, at) in points.chain(joints) {
        let Some(at) = stage.spot(at) else { continue };
        if done.iter().any(|p| apart(*p, at) < 2.0) {
            continue;
        }
        done.push(at);
        let hinge = scene.hinges.iter().any(|h| stage.spot(&h.at) == Some(at));
        if !hinge {
            sheet.dot(at, 1.9, Ink::Body);
        }
        let label = Label::symbol(name, None);
        sheet.wish(
            label,
            SIZE,
            Spot::point(at, [0.0, 0.0], if hinge { 5.0 } else { 3.0 }),
        );
    }
}

/// Each body's mass, or its name where masses do not tell bodies apart.
pub(super) fn masses(stage: &Stage, sheet: &mut Sheet, asides: &[Pair]) {
    let scene = stage.scene;
    let movable = stage.movable();
    let same = |body: &Body| {
        movable
            .iter()
            .filter(|i| scene.bodies[**i].mass == body.mass)
            .count()
            > 1
    };
    for i in &movable {
        let body = &scene.bodies[*i];
        if let (Shape::Composite { parts }, Look::Parts(poses)) =
            (&body.shape, &stage.poses[*i].look)
        {
            for (part, pose) in parts.iter().zip(poses) {
                mass(
                    stage,
                    sheet,
                    pose,
                    [0.0, 0.0],
                    Label::formula(&part.mass, scene),
                );
            }
            continue;
        }
        let label = if same(body) || body.mass.size() > 4 || body.mass.is_zero() {
            Label::words(&short_name(body))
        } else {
            Label::formula(&body.mass, scene)
        };
        mass(stage, sheet, &stage.poses[*i], asides[*i], label);
    }
}

/// A body's name beside it: `ball 1` as in the text, `upper` for the upper body.
fn short_name(body: &Body) -> String {
    let name = body.name.replace('_', " ");
    match name.ends_with(|c: char| c.is_ascii_digit()) && name.chars().count() > 2 {
        true => body.called(),
        false => name,
    }
}

fn mass(stage: &Stage, sheet: &mut Sheet, pose: &Pose, aside: Pair, label: Label) {
    let at = stage.px(pose.center);
    let at = plus(at, aside);
    let spot = match &pose.look {
        Look::Bar(_) => match pose.ends() {
            Some([a, b]) => {
                let (a, b) = (stage.px(a), stage.px(b));
                // Beside the rod, away from its middle, where the velocity starts.
                Spot::Along {
                    from: between(a, b, 0.5),
                    to: b,
                }
            }
            None => return,
        },
        Look::Round { radius, .. } => Spot::Inside {
            at,
            radius: stage.long(*radius),
        },
        Look::Plate(w, h) => Spot::Inside {
            at,
            radius: stage.long(w.min(*h)),
        },
        Look::Blob(points) => {
            let least = points
                .iter()
                .map(|p| size(*p))
                .fold(f64::INFINITY, f64::min);
            Spot::Inside {
                at,
                radius: stage.long(least),
            }
        }
        _ => Spot::point(at, [0.0, 0.0], DOT),
    };
    sheet.wish(label, SIZE, spot);
}

/// The axes, in the lower left corner.
pub(super) fn axes(sheet: &mut Sheet) {
    let Some(room) = sheet.room() else { return };
    let blocked = |b: &Room| {
        sheet.items.iter().any(|item| match item {
            Item::Text { room, .. } => room.overlap(b) > 0.0,
            Item::Path {
                points,
                paint: Paint::Stroke(_),
                ..
            } => points.windows(2).any(|w| {
                (0..=10).any(|k| {
                    let t = f64::from(k) / 10.0;
                    let p = between(w[0], w[1], t);
                    Room::around(p, 0.5).overlap(b) > 0.0
                })
            }),
            _ => false,
        })
    };
    let cover = |p: Pair| Room {
        low: [p[0] - 6.0, p[1] - 4.0],
        high: [p[0] + 50.0, p[1] + 50.0],
    };
    // Lower left of the column where it is free, else further out.
    let left = f64::min(room.middle()[0] - 156.0, room.low[0] - 22.0);
    let places = [
        [left, room.low[1]],
        [left, room.high[1] - 40.0],
        [-left - 36.0 + 2.0 * room.middle()[0], room.low[1]],
    ];
    let at = places
        .into_iter()
        .find(|p| !blocked(&cover(*p)))
        .unwrap_or([room.low[0] - 56.0, room.low[1]]);
    let mut extra = Sheet::default();
    for (to, latex) in [([26.0, 0.0], "\\hat{i}"), ([0.0, 26.0], "\\hat{j}")] {
        let tip = plus(at, to);
        extra.arrow(at, tip, Ink::Dimension, 1.1);
        let toward = [to[0], to[1]];
        extra.wish(Label::latex(latex), SMALL, Spot::point(tip, toward, 1.0));
    }
    extra.settle();
    sheet.items.extend(extra.items);
}
