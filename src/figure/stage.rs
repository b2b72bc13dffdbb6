//! The scene as geometry: where each body lies on the sheet and what its outline is.
//!
//! In: poses of bodies and values. Out: places in pixels, y up, and how to draw bodies and hinges; what does not move is drawn
//! by `support`. Knows nothing of velocities' labels or of impulses.

use std::f64::consts::PI;

use super::label::Label;
use super::place::Room;
use super::plane::{Pair, ahead, apart, bearing, dot, minus, opposite, plus, size, times, unit};
use super::pose::{Look, Pose, posed};
use super::sheet::{Ink, Item, Line, Paint, Sheet, arc};
use super::values::Values;
use crate::scene::Scene;

/// A moment of the collision.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Moment {
    /// Just before.
    Before,
    /// During.
    During,
    /// Just after.
    After,
}

/// The scene in numbers, and how meters become pixels.
pub struct Stage<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// What it is drawn at.
    pub values: &'a Values,
    /// Bodies in the order of the scene.
    pub poses: Vec<Pose>,
    /// Pixels per meter.
    scale: f64,
    middle: Pair,
}

/// Room for the bodies themselves, in pixels.
const CORE: Pair = [225.0, 160.0];
/// Radius of a particle in pixels.
pub const DOT: f64 = 6.0;
/// Radius of a peg in pixels.
pub(super) const PEG: f64 = 7.0;
/// Half thickness of a rod in pixels.
pub const THICK: f64 = 3.5;

/// Puts a scene on stage; `None` where something has no finite place.
pub fn stage<'a>(scene: &'a Scene, values: &'a Values) -> Option<Stage<'a>> {
    spanning(scene, values, posed(scene, values)?, &[])
}

/// A stage with room for more than the bodies where they are.
pub fn spanning<'a>(
    scene: &'a Scene,
    values: &'a Values,
    poses: Vec<Pose>,
    more: &[Pose],
) -> Option<Stage<'a>> {
    let mut stage = Stage {
        scene,
        values,
        poses,
        scale: 1.0,
        middle: [0.0, 0.0],
    };
    let mut points: Vec<Pair> = stage
        .poses
        .iter()
        .chain(more)
        .flat_map(Pose::outline)
        .collect();
    for v in scene
        .points
        .iter()
        .map(|p| &p.at)
        .chain(scene.touching().map(|one| one.at))
    {
        points.push(values.pair(v)?);
    }
    if let Some(all) = Room::of(&points) {
        let [w, h] = all.extent();
        let scale = f64::min(CORE[0] / w.max(1e-12), CORE[1] / h.max(1e-12));
        stage.scale = if w.max(h) > 1e-9 { scale } else { 1.0 };
        stage.middle = all.middle();
    }
    Some(stage)
}

impl Stage<'_> {
    /// A place on the sheet.
    pub fn px(&self, p: Pair) -> Pair {
        times(minus(p, self.middle), self.scale)
    }

    /// What place \[m\] a point of the sheet shows.
    pub fn place(&self, p: Pair) -> Pair {
        [0, 1].map(|k| p[k] / self.scale + self.middle[k])
    }

    /// A length on the sheet.
    pub fn long(&self, meters: f64) -> f64 {
        meters * self.scale
    }

    /// Where a formula's point lies on the sheet.
    pub fn spot(&self, v: &crate::expr::Vector) -> Option<Pair> {
        self.values.pair(v).map(|p| self.px(p))
    }

    /// Movable bodies.
    pub fn movable(&self) -> Vec<usize> {
        self.scene.moving().collect()
    }

    /// How far a particle is drawn from its place, so that it is seen beside what it touches.
    pub fn aside(&self, body: usize, moment: Moment, velocity: &[Pair]) -> Pair {
        let nothing = [0.0, 0.0];
        if !self.scene.bodies[body].is_particle() {
            return nothing;
        }
        let contact = self
            .scene
            .contacts
            .iter()
            .find(|c| c.bodies.contains(&body) && self.scene.figure.string(&c.name).is_none());
        let Some(contact) = contact.filter(|_| !self.is_held(body)) else {
            return nothing;
        };
        let other = if contact.bodies[0] == body {
            contact.bodies[1]
        } else {
            contact.bodies[0]
        };
        let relative = |v: &[Pair]| match (v.get(body), v.get(other)) {
            (Some(a), Some(b)) => minus(*a, *b),
            _ => nothing,
        };
        let before: Vec<Pair> = self
            .scene
            .bodies
            .iter()
            .map(|b| self.values.pair(&b.velocity).unwrap_or(nothing))
            .collect();
        let incoming = relative(&before);
        let normal = contact.normal.as_ref().and_then(|n| self.values.pair(n));
        // Away from the partner: against the normal for the first body, else back where it came from.
        let back = match normal {
            Some(n) if contact.bodies[0] == body => opposite(n),
            Some(n) => n,
            None => opposite(incoming),
        };
        let direction = |v: Pair| if size(v) > 1e-9 { unit(v) } else { nothing };
        let back = direction(back);
        let both_dots = self.scene.bodies[other].is_particle();
        let near = match self.poses[other].look {
            Look::Bar(_) => DOT + THICK + 1.0,
            Look::Dot if self.is_held(other) => 2.0 * DOT,
            Look::Dot => DOT,
            _ => DOT + 1.0,
        };
        let gap = match moment {
            Moment::Before
                if size(incoming) > 1e-9 && before.get(body).is_some_and(|v| size(*v) > 1e-9) =>
            {
                let from = direction(opposite(before[body]));
                return ahead(times(from, 30.0), back, near);
            }
            Moment::Before | Moment::During => 0.0,
            Moment::After => {
                let leaving = relative(velocity);
                let scale = size(incoming).max(1e-9);
                if size(leaving) > 1e-6 * scale && both_dots {
                    let away = direction(leaving);
                    return times(away, 15.0);
                }
                if size(leaving) > 1e-6 * scale && dot(leaving, back) > 0.0 {
                    16.0
                } else {
                    0.0
                }
            }
        };
        times(back, near + gap)
    }

    /// Whether a particle is at a hinge or on a string, which is drawn to where the particle is.
    fn is_held(&self, body: usize) -> bool {
        let string = |name: &str| self.scene.figure.string(name).is_some();
        let mut contacts = self.scene.contacts.iter();
        let mut hinges = self.scene.hinges.iter();
        hinges.any(|h| h.bodies.contains(&body))
            || string(&self.scene.bodies[body].name)
            || contacts.any(|c| string(&c.name) && c.bodies.contains(&body))
    }

    /// Draws a body, moved aside by some pixels.
    pub fn body(&self, sheet: &mut Sheet, pose: &Pose, aside: Pair) {
        let put = |p: Pair| {
            let q = self.px(p);
            plus(q, aside)
        };
        if !pose.skin.is_empty() {
            for line in pose.drawn() {
                let line = line.into_iter().map(put).collect();
                sheet.path(line, true, Line::solid(), 1.0);
            }
            return;
        }
        let outline: Vec<Pair> = pose.outline().into_iter().map(put).collect();
        match &pose.look {
            Look::Fixed => {}
            Look::Dot => {
                sheet.dot(put(pose.center), DOT, Ink::Body);
            }
            Look::Bar(_) if pose.massless => sheet.path(outline, false, Line::of(Ink::Body), 2.0),
            Look::Bar(_) => {
                let [a, b] = [outline[0], outline[1]];
                sheet.path(capsule(a, b), true, Line::solid(), 1.0);
                sheet.walls.push((a, b, 1.5));
            }
            Look::Round { radius, ring } => {
                let (center, r) = (put(pose.center), self.long(*radius));
                sheet.circle(
                    center,
                    r,
                    if *ring {
                        Line::of(Ink::Body)
                    } else {
                        Line::solid()
                    },
                );
                if *ring {
                    sheet.circle(center, (r - 4.0).max(r * 0.8), Line::of(Ink::Body));
                }
            }
            Look::Plate(..) | Look::Blob(_) => sheet.path(outline, true, Line::solid(), 1.0),
            Look::Parts(parts) => {
                for pair in parts.windows(2).filter(|two| !two[0].meets(&two[1])) {
                    let [a, b] = [put(pair[0].center), put(pair[1].center)];
                    sheet.segment(
                        a,
                        b,
                        Line {
                            width: 2.2,
                            ..Line::of(Ink::Body)
                        },
                        2.0,
                    );
                }
                for part in parts {
                    self.body(sheet, part, aside);
                }
            }
        }
    }

    /// Draws the hinges' circles.
    pub fn hinges(&self, sheet: &mut Sheet, shown: &dyn Fn([usize; 2]) -> bool) {
        for hinge in self.scene.hinges.iter().filter(|h| shown(h.bodies)) {
            if let Some(at) = self.spot(&hinge.at) {
                sheet.kept.push(Room::around(at, 5.0));
                sheet.items.push(Item::Circle {
                    center: at,
                    radius: 3.6,
                    paint: Paint::Stroke(Line::of(Ink::Body)),
                });
            }
        }
    }
}

fn capsule(a: Pair, b: Pair) -> Vec<Pair> {
    let phi = bearing(minus(b, a));
    let mut points = arc(b, THICK, phi - PI / 2.0, phi + PI / 2.0);
    points.extend(arc(a, THICK, phi + PI / 2.0, phi + 1.5 * PI));
    points
}

/// The symbol of a body's center of mass: a point's name if one lies there, else G with the body's number.
pub fn center_name(stage: &Stage, body: usize) -> Option<Label> {
    let scene = stage.scene;
    if scene.bodies[body].is_fixed() || scene.bodies[body].is_particle() {
        return None;
    }
    let center = stage.px(stage.poses[body].center);
    let named = scene
        .points
        .iter()
        .find(|p| stage.spot(&p.at).is_some_and(|q| apart(q, center) < 1.5));
    if let Some(point) = named {
        return Some(Label::symbol(&point.name, None));
    }
    let extended: Vec<usize> = stage
        .movable()
        .into_iter()
        .filter(|i| !scene.bodies[*i].is_particle() && !scene.bodies[*i].mass.is_zero())
        .collect();
    if scene.bodies[body].mass.is_zero() {
        return None;
    }
    // Bodies A and B have G_A and G_B, as their velocities in the text have their letters.
    let lettered = extended.iter().all(|i| scene.bodies[*i].is_lettered());
    let each = extended.iter().position(|i| *i == body)?;
    Some(Label::latex(&match extended.len() {
        1 => String::from("G"),
        _ if lettered => format!("G_{{{}}}", scene.bodies[body].name),
        _ => format!("G_{{{}}}", each + 1),
    }))
}
