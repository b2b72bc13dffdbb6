//! Where bodies are during a motion between impacts.
//!
//! In: the bodies at its beginning, what happens, and where it was found to end. Out: poses on the way, in meters. Knows
//! nothing of paper.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::Course;
use super::plane::{Pair, ahead, apart, bearing, minus, plus, polar, size, times, turned};
use super::pose::{Look, Pose};
use super::values::Values;
use crate::expr::Expr;
use crate::scene::{Fall, FallEnd, Linkage, Scene, SlideEnd, StageKind, Turn, Until};

/// Pictures of a way, its beginning aside.
const STEPS: u32 = 40;
/// The angle of a rotation whose end is not known \[rad\].
const SOME_ANGLE: f64 = 1.2;

/// The bodies of a motion on their way.
pub struct Gone {
    /// Index of the body the motion is told of.
    pub body: usize,
    /// That body on its way, the beginning first; never empty.
    pub way: Vec<Pose>,
    /// Bodies that fly at the same time, each on a way of its own.
    pub flying: Vec<(usize, Vec<Pose>)>,
    /// Bodies that turn as one with it, at the end.
    pub carried: Vec<(usize, Pose)>,
    /// Bodies that a linkage or a string moves, at the end.
    pub driven: Vec<(usize, Pose)>,
    /// Bodies that are one with it on a line.
    along: Vec<usize>,
}

impl Gone {
    /// `None` where something has no finite place.
    pub fn new(scene: &Scene, values: &Values, course: &Course, begin: &[Pose]) -> Option<Gone> {
        let kind = &course.kind;
        let body = match kind {
            StageKind::Turn(t) => t.body,
            StageKind::Slide(s) => s.body,
            StageKind::Fall(f) => f.body,
            StageKind::Wind(w) => w.body,
            StageKind::Linkage(l) => l.places.first()?.0,
            StageKind::Impact { .. } => return None,
        };
        let from = begin.get(body)?;
        let way = way(scene, values, course, from)?;
        let end = way.last()?;
        let mut gone = Gone {
            body,
            driven: driven(values, kind, begin, from, &end.0)?,
            way: way.iter().map(|(pose, _)| pose.clone()).collect(),
            flying: Vec::new(),
            carried: Vec::new(),
            along: Vec::new(),
        };
        match kind {
            StageKind::Fall(fall) => {
                for b in &fall.with {
                    let flown = flight(scene, values, fall, (*b, begin.get(*b)?))?;
                    gone.flying.push((*b, flown));
                }
            }
            StageKind::Turn(turn) => {
                let about = values.pair(&turn.about)?;
                let turned =
                    |b: &usize| Some((*b, moved(begin.get(*b)?, about, end.1, [0.0, 0.0])));
                gone.carried = turn.with.iter().map(turned).collect::<Option<_>>()?;
            }
            StageKind::Slide(slide) => gone.along.clone_from(&slide.with),
            _ => {}
        }
        Some(gone)
    }

    /// The body at the end.
    pub fn end(&self) -> &Pose {
        &self.way[self.way.len() - 1]
    }

    /// The center of mass of all that turns as one, at the end.
    pub fn middle(&self, scene: &Scene, values: &Values) -> Pair {
        let carried = self.carried.iter().map(|(b, pose)| (*b, pose));
        let all = carried.chain([(self.body, self.end())]);
        let (mut sum, mut moment) = (0.0, [0.0, 0.0]);
        for (b, pose) in all {
            let mass = values.of(&scene.bodies[b].mass).unwrap_or(0.0);
            sum += mass;
            moment = ahead(moment, pose.center, mass);
        }
        match sum > 0.0 {
            true => moment.map(|c| c / sum),
            false => self.end().center,
        }
    }

    /// Every pose that needs room.
    pub fn all(&self) -> impl Iterator<Item = Pose> {
        let flying = self.flying.iter().flat_map(|(_, way)| way);
        let others = self
            .carried
            .iter()
            .chain(&self.driven)
            .map(|(_, pose)| pose);
        self.way.iter().chain(flying).chain(others).cloned()
    }

    /// Whether a body takes part in the motion.
    pub fn moves(&self, body: usize) -> bool {
        let others = self.carried.iter().chain(&self.driven).map(|(b, _)| b);
        let others = others
            .chain(self.flying.iter().map(|(b, _)| b))
            .chain(&self.along);
        body == self.body || others.copied().any(|b| b == body)
    }
}

/// What else a motion moves, at its end: the other bodies of a linkage, and what hangs at the other ends of strings, as far
/// along its line as the body itself.
fn driven(
    values: &Values,
    kind: &StageKind,
    begin: &[Pose],
    from: &Pose,
    end: &Pose,
) -> Option<Vec<(usize, Pose)>> {
    if let StageKind::Linkage(linkage) = kind {
        let others = linkage.places.iter().skip(1);
        let end = |(b, place): &(usize, [Expr; 3])| {
            Some((
                *b,
                linked(values, linkage, place, begin.get(*b)?, &linkage.ends[1])?,
            ))
        };
        return others.map(end).collect();
    }
    let StageKind::Slide(slide) = kind else {
        return Some(Vec::new());
    };
    let far = apart(end.center, from.center);
    let mut out = Vec::new();
    for string in &slide.strings {
        let along = values.pair(&string.along)?;
        for b in string.hung() {
            let pose = begin.get(b)?;
            let shift = along.map(|c| c * far);
            out.push((b, moved(pose, pose.center, 0.0, shift)));
        }
    }
    Some(out)
}

/// Poses on the way, the first one the beginning, each with the angle turned through.
fn way(scene: &Scene, values: &Values, course: &Course, from: &Pose) -> Option<Vec<(Pose, f64)>> {
    let straight = |d: Pair| {
        let at = |k: u32| (moved(from, from.center, 0.0, times(d, part(k))), 0.0);
        (0..=STEPS).map(at).collect::<Vec<_>>()
    };
    Some(match &course.kind {
        StageKind::Turn(turn) => {
            let about = values.pair(&turn.about)?;
            let center = values.pair(&turn.lump(scene).center)?;
            let by = angle_of(values, course, turn, [about, center, from.center])?;
            let at = |k: u32| (moved(from, about, by * part(k), [0.0, 0.0]), by * part(k));
            (0..=STEPS).map(at).collect()
        }
        StageKind::Slide(s) => {
            let along = values.pair(&s.along)?;
            let far = match &s.until {
                SlideEnd::Distance(distance) => values.of(distance)?,
                // How far it gets is the result; the picture shows which way.
                _ => {
                    let arms = from.outline().into_iter();
                    let arms = arms.map(|p| apart(p, from.center));
                    3.0 * arms.fold(0.1, f64::max)
                }
            };
            straight(times(along, far))
        }
        StageKind::Fall(f) => flight(scene, values, f, (f.body, from))?
            .into_iter()
            .map(|pose| (pose, 0.0))
            .collect(),
        StageKind::Wind(w) => {
            let (pole, to) = (values.pair(&w.around)?, values.of(&w.to)?);
            let arm = minus(from.center, pole);
            let (long, phi) = (size(arm), bearing(arm));
            let turns = 1.75 * TAU * if course.clockwise { -1.0 } else { 1.0 };
            let at = |k: u32| {
                let r = long + (to - long) * part(k);
                let at = polar(pole, r, phi + turns * part(k));
                (moved(from, from.center, 0.0, minus(at, from.center)), 0.0)
            };
            (0..=STEPS).map(at).collect()
        }
        StageKind::Linkage(linkage) => {
            let (_, place) = linkage.places.first()?;
            let [begin, end] = &linkage.ends;
            let at = |k: u32| {
                let part = Expr::ratio(i64::from(k), i64::from(STEPS));
                let value = begin + &(&part * &(end - begin));
                Some((linked(values, linkage, place, from, &value)?, 0.0))
            };
            (0..=STEPS).map(at).collect::<Option<Vec<_>>>()?
        }
        StageKind::Impact { .. } => return None,
    })
}

/// How much of a way lies behind at one of its pictures.
fn part(k: u32) -> f64 {
    f64::from(k) / f64::from(STEPS)
}

/// Poses of a body in free flight, the first one the beginning: the parabola of its center, and its spin.
fn flight(
    scene: &Scene,
    values: &Values,
    fall: &Fall,
    (body, from): (usize, &Pose),
) -> Option<Vec<Pose>> {
    let g = fall.gravity.as_ref().map_or(Some(0.0), |g| values.of(g))?;
    let ends = values.pair(&scene.bodies[fall.body].velocity)?;
    let time = match &fall.until {
        FallEnd::Time(time) => values.of(time)?,
        FallEnd::Range(s) => values.of(s)? / ends[0],
        FallEnd::Drop(h) if g == 0.0 => -values.of(h)? / ends[1],
        FallEnd::Drop(h) => {
            let end = (ends[1] * ends[1] + 2.0 * g * values.of(h)?).sqrt();
            (ends[1] + if fall.rising { -end } else { end }) / g
        }
    };
    let velocity = values.pair(&scene.bodies[body].velocity)?;
    let spin = values.of(&scene.bodies[body].spin)?;
    // Values at which it does not get there show where it should get.
    let goal = match &fall.until {
        FallEnd::Drop(h) => [0.0, -values.of(h)?],
        FallEnd::Range(s) => [values.of(s)?, 0.0],
        FallEnd::Time(_) => [0.0, 0.0],
    };
    let at = |k: u32| match time.is_finite() {
        true => {
            let t = time * part(k);
            let shift = [velocity[0] * t, velocity[1] * t - g * t * t / 2.0];
            moved(from, from.center, spin * t, shift)
        }
        false => moved(from, from.center, 0.0, goal.map(|d| d * part(k))),
    };
    Some((0..=STEPS).map(at).collect())
}

/// A body of a linkage where its coordinate has a value.
fn linked(
    values: &Values,
    linkage: &Linkage,
    place: &[Expr; 3],
    from: &Pose,
    value: &Expr,
) -> Option<Pose> {
    let [x, y, angle] = place.each_ref().map(|e| values.of(&linkage.at(e, value)));
    let shift = [x? - from.center[0], y? - from.center[1]];
    Some(moved(from, from.center, angle? - from.angle, shift))
}

/// The angle of a rotation, counterclockwise; `center` is that of all that turns, `begin` that of the body.
fn angle_of(
    values: &Values,
    course: &Course,
    turn: &Turn,
    [about, center, begin]: [Pair; 3],
) -> Option<f64> {
    let way = if course.clockwise { -1.0 } else { 1.0 };
    let toward = |p: Pair| bearing(minus(p, about));
    let by = match &turn.until {
        Until::By(by) => return Some(way * values.of(by)?),
        Until::Above => FRAC_PI_2 - toward(center),
        Until::Below => -FRAC_PI_2 - toward(center),
        Until::For(_) | Until::Stops => {
            let end = course.end.get(turn.body).and_then(|e| values.pair(e));
            match end.filter(|end| apart(*end, about) > 1e-9) {
                Some(end) => toward(end) - toward(begin),
                None => return Some(way * SOME_ANGLE),
            }
        }
    };
    Some(way * (way * by).rem_euclid(TAU))
}

/// A pose turned about a point and shifted.
fn moved(pose: &Pose, about: Pair, by: f64, shift: Pair) -> Pose {
    let arm = turned(minus(pose.center, about), by);
    let look = match &pose.look {
        Look::Blob(points) => Look::Blob(points.iter().map(|p| turned(*p, by)).collect()),
        Look::Parts(parts) => {
            Look::Parts(parts.iter().map(|p| moved(p, about, by, shift)).collect())
        }
        other => other.clone(),
    };
    Pose {
        center: plus(plus(about, arm), shift),
        angle: pose.angle + by,
        look,
        massless: pose.massless,
        skin: pose.skin.clone(),
    }
}
