//! Where bodies are during a motion between impacts.
//!
//! In: a scene whose only stage is the motion, and the bodies at its beginning. Out: poses on the way, in meters, as
//! [`crate::numeric::follow()`] finds them. Knows nothing of paper.

use std::f64::consts::TAU;

use super::plane::{Pair, ahead, bearing, cross, minus, plus, polar, size, turned};
use super::pose::{Look, Pose};
use super::values::Values;
use crate::numeric::follow::{What, follow};
use crate::scene::{Scene, StageKind, Wind};

/// Pictures of a way, its beginning aside.
const STEPS: usize = 40;
/// Turns of a rope that winds up on a thin pole; how many there are is left open.
const TURNS: f64 = 1.75;

/// The bodies of a motion on their way.
pub struct Gone {
    /// Index of the body the motion is told of.
    pub body: usize,
    /// Each body that the motion moves, with its poses on the way: the beginning first, never empty.
    pub ways: Vec<(usize, Vec<Pose>)>,
    /// Angle of a rotation about a point, counterclockwise \[rad\]; 0 of other motions.
    pub turned: f64,
}

impl Gone {
    /// `None` where the motion does not come to its end at these values, or something has no finite place.
    pub fn new(scene: &Scene, values: &Values, begin: &[Pose]) -> Option<Gone> {
        let kind = &scene.stages.first()?.kind;
        let followed = follow(scene, &values.point).ok()?;
        let passed = followed.stages.first()?.as_ref().ok()?;
        let What::Motion(moved) = &passed.what else {
            return None;
        };
        let body = *kind.moved().first()?;
        let ways = match kind {
            StageKind::Wind(wind) => vec![(body, wound(scene, values, wind, begin.get(body)?)?)],
            _ => {
                let long = moved.samples.last()?.time;
                let way = |(i, b): (usize, &usize)| {
                    let from = begin.get(*b)?;
                    let at = |k: usize| long * (k as f64 / STEPS as f64);
                    let pose = |k: usize| from.moved_to(moved.pose(i, at(k)));
                    Some((*b, (0..=STEPS).map(pose).collect()))
                };
                let all = moved.bodies.iter().enumerate();
                all.map(way).collect::<Option<_>>()?
            }
        };
        let turned = moved.turned.unwrap_or(0.0);
        Some(Gone { body, ways, turned })
    }

    /// The way of a body; empty where the motion does not move it.
    pub fn way(&self, body: usize) -> &[Pose] {
        let found = self.ways.iter().find(|(b, _)| *b == body);
        found.map_or(&[], |(_, way)| way)
    }

    /// Bodies at the end, from those at the beginning.
    pub fn last(&self, begin: &[Pose]) -> Vec<Pose> {
        let last = |(b, pose): (usize, &Pose)| self.way(b).last().unwrap_or(pose).clone();
        begin.iter().enumerate().map(last).collect()
    }

    /// The center of mass of bodies at the end.
    pub fn middle(&self, scene: &Scene, values: &Values, bodies: &[usize]) -> Option<Pair> {
        let (mut sum, mut moment) = (0.0, [0.0, 0.0]);
        for b in bodies {
            let mass = values.of(&scene.bodies[*b].mass).unwrap_or(0.0);
            sum += mass;
            moment = ahead(moment, self.way(*b).last()?.center, mass);
        }
        match sum > 0.0 {
            true => Some(moment.map(|c| c / sum)),
            false => Some(self.way(*bodies.first()?).last()?.center),
        }
    }
}

/// A body on a rope that winds up on a thin pole, from its whole length to the length left.
fn wound(scene: &Scene, values: &Values, wind: &Wind, from: &Pose) -> Option<Vec<Pose>> {
    let (pole, to) = (values.pair(&wind.around)?, values.of(&wind.to)?);
    let arm = minus(from.center, pole);
    let velocity = values.pair(&scene.bodies[wind.body].velocity)?;
    let (long, phi, turns) = (
        size(arm),
        bearing(arm),
        TURNS * TAU * cross(arm, velocity).signum(),
    );
    let at = |k: usize| {
        let part = k as f64 / STEPS as f64;
        let [x, y] = polar(pole, long + (to - long) * part, phi + turns * part);
        from.moved_to([x, y, from.angle])
    };
    Some((0..=STEPS).map(at).collect())
}

impl Pose {
    /// The same body with its center at another place, at another angle.
    fn moved_to(&self, [x, y, angle]: [f64; 3]) -> Pose {
        let by = angle - self.angle;
        let part = |part: &Pose| {
            let arm = turned(minus(part.center, self.center), by);
            let [x, y] = plus([x, y], arm);
            part.moved_to([x, y, part.angle + by])
        };
        let look = match &self.look {
            Look::Blob(points) => Look::Blob(points.iter().map(|p| turned(*p, by)).collect()),
            Look::Parts(parts) => Look::Parts(parts.iter().map(part).collect()),
            other => other.clone(),
        };
        Pose {
            center: [x, y],
            angle,
            look,
            massless: self.massless,
            skin: self.skin.clone(),
        }
    }
}
