//! Bodies that pass through each other during a motion: the equations of motion do not know that, their outlines do.
//!
//! In: the file's bodies, and a motion with samples. Out: the pairs of bodies that are apart when it begins and in each other on
//! the way. Bodies that a hinge, a sticking contact or a linkage joins, or that slide on each other, at any time may overlap; so
//! may those that do when the stage begins. What is fixed has no outline: it is where it was struck before.

use std::iter::successors;

use super::{
    Component, Followed, Moved, Passed, Solid, State, What, at_places, finite, finite_pair,
};
use crate::expr::arithmetic::dot;
use crate::expr::{Expr, Point, Vector};
use crate::numeric::given::Undefined;
use crate::scene::{Body, Contact, ContactLaw, OneSided, Scene, Shape, Stage, StageKind};

/// Most places looked at between two samples, and about how many in all.
const BETWEEN: usize = 24;
const PLACES: usize = 600;
/// Bodies that are in each other by less than this share of what is at hand only touch.
const TOUCH: f64 = 1e-4;
/// Share of a coordinate below which differences are rounding.
const ROUNDING: f64 = 1e-9;

/// A rectangle with round corners: a disk has no sides, a rod no height, a particle neither.
struct Piece {
    /// Its middle, from the body's center, as the file puts the body \[m\].
    at: [f64; 2],
    /// Half its sides \[m\].
    half: [f64; 2],
    /// Direction of the first side, as the file puts the body \[rad\].
    angle: f64,
    /// How far the outline lies around the rectangle \[m\].
    radius: f64,
}

/// A piece where its body has come to.
struct Placed<'a> {
    piece: &'a Piece,
    at: [f64; 2],
    /// Unit vectors along the sides.
    axes: [[f64; 2]; 2],
}

/// The pairs of bodies that pass through each other in a stage, beside motions that happen at the same time.
pub(super) fn passing(
    scene: &Scene,
    solids: &[Solid],
    values: &Point<f64>,
    (stage, passed): (&Stage, &Passed),
    at_once: &[&Moved],
) -> Vec<[usize; 2]> {
    let What::Motion(moved) = &passed.what else {
        return Vec::new();
    };
    let Some(last) = moved.samples.last().filter(|s| s.time > 0.0) else {
        return Vec::new();
    };
    let outlines = Outlines::of(scene, solids, values);
    let pose = |b: usize, time: f64| -> Option<[f64; 3]> {
        for moved in at_once.iter().copied().chain([moved]) {
            if let Some(i) = moved.bodies.iter().position(|m| *m == b) {
                return Some(moved.pose(i, time));
            }
        }
        let at = |state: &super::BodyState| -> Option<[f64; 3]> {
            let number = |c: &Component| c.as_ref().ok().copied();
            let [x, y] = &state.center;
            Some([number(x)?, number(y)?, number(&state.angle)?])
        };
        let [before, after] = [&passed.before, &passed.after].map(|s| at(&s.bodies[b]));
        let (before, after) = (before?, after?);
        let share = time / last.time;
        Some([0, 1, 2].map(|k| before[k] + share * (after[k] - before[k])))
    };
    let times = times(moved);
    let mut out = Vec::new();
    for &a in &moved.bodies {
        for b in (0..scene.bodies.len()).filter(|b| *b != a) {
            let is_seen = moved.bodies.contains(&b) && b < a;
            // What another stage moves meanwhile is looked at there.
            let is_seen = is_seen || stage.apart.contains(&b);
            if !is_seen && outlines.pass([a, b], &times, pose) {
                out.push([a.min(b), a.max(b)]);
            }
        }
    }
    out
}

/// The outlines of the bodies of a scene, and how the file has turned them.
struct Outlines<'a> {
    scene: &'a Scene,
    pieces: Vec<Vec<Piece>>,
    angles: Vec<Option<f64>>,
}

impl<'a> Outlines<'a> {
    fn of(scene: &'a Scene, solids: &[Solid], values: &Point<f64>) -> Outlines<'a> {
        let outline = |(body, solid): (&Body, &Solid)| {
            let mut out = Vec::new();
            let known = pieces(body, solid.center, values, &mut out);
            known.map(|()| out).unwrap_or_default()
        };
        let angles = scene.bodies.iter().map(|b| match b.is_particle() {
            true => Some(0.0),
            false => b.angle.evaluate(values),
        });
        Outlines {
            scene,
            pieces: scene.bodies.iter().zip(solids).map(outline).collect(),
            angles: angles.collect(),
        }
    }

    /// Whether two bodies that nothing joins pass through each other, by their poses at these times.
    fn pass(
        &self,
        [a, b]: [usize; 2],
        times: &[f64],
        pose: impl Fn(usize, f64) -> Option<[f64; 3]>,
    ) -> bool {
        let has_none = [a, b].iter().any(|b| self.pieces[*b].is_empty());
        if has_none || joined(self.scene, [a, b]) {
            return false;
        }
        let placed = |body: usize, time: f64| -> Option<Vec<Placed<'_>>> {
            let (pose, from) = (pose(body, time)?, self.angles[body]?);
            Some(self.pieces[body].iter().map(|p| p.at(pose, from)).collect())
        };
        let course: Option<Vec<[Vec<Placed<'_>>; 2]>> = times
            .iter()
            .map(|t| Some([placed(a, *t)?, placed(b, *t)?]))
            .collect();
        course.is_some_and(|course| !course.is_empty() && pass(&course))
    }
}

/// A motion on one of several branches that go on from the same impact.
struct Branch<'a> {
    moved: &'a Moved,
    /// When it begins after that impact \[s\].
    begins: f64,
    /// When it ends; never for bodies that have come to rest and that nothing moves any more.
    ends: f64,
    /// All bodies that the branch moves up to there.
    bodies: Vec<usize>,
}

impl<'a> Branch<'a> {
    /// A motion at the end of stages, the last one first, that follow each other from where the branches part.
    fn of(
        course: &[Stage],
        followed: &Followed,
        way: impl Iterator<Item = usize>,
        (index, passed): (usize, &'a Passed),
    ) -> Option<Branch<'a>> {
        let What::Motion(moved) = &passed.what else {
            return None;
        };
        if course[index].during.is_some() {
            return None;
        }
        let (mut begins, mut bodies) = (0.0, moved.bodies.clone());
        for j in way {
            // What happens at the same time as a motion before it takes no time of its own.
            if course[j].during.is_none() {
                begins += followed.stages[j].as_ref().ok()?.time.clone().ok()?;
            }
            bodies.extend(course[j].kind.moved());
        }
        let ends = begins + passed.time.clone().ok()?;
        let rests = |b: &usize| {
            let body = &passed.after.bodies[*b];
            let mut motion = body.velocity.iter().chain([&body.spin]);
            motion.all(|v| *v == Ok(0.0))
        };
        let goes_on = course.iter().any(|s| s.from == Some(index));
        let stays = !goes_on && moved.bodies.iter().all(rests);
        Some(Branch {
            moved,
            begins,
            ends: if stays { f64::INFINITY } else { ends },
            bodies,
        })
    }

    /// Where it has a body at a time after the branches part; it waits before it begins to move and after it has come to rest.
    fn pose(&self, body: usize, time: f64) -> Option<[f64; 3]> {
        let k = self.moved.bodies.iter().position(|m| *m == body)?;
        let lasts = self.moved.samples.last()?.time;
        let time = (time - self.begins).clamp(0.0, lasts);
        Some(self.moved.pose(k, time))
    }
}

/// The motions followed before that go on beside this one, on other branches from the same impact, with the pairs of bodies that
/// pass through each other meanwhile.
pub(super) fn beside(
    scene: &Scene,
    (course, followed): (&[Stage], &Followed),
    passed: &Passed,
    values: &Point<f64>,
) -> Vec<(usize, [usize; 2])> {
    let index = followed.stages.len();
    let way = |i: usize| successors(course[i].from, |j| course[*j].from);
    let mut out = Vec::new();
    for (i, other) in followed.stages.iter().enumerate() {
        let (Ok(other), false) = (other, way(index).any(|j| j == i)) else {
            continue;
        };
        let Some(parting) = way(i).find(|i| way(index).any(|j| j == *i)) else {
            continue;
        };
        let branch = |index: usize, passed| {
            let since = way(index).take_while(|j| *j != parting);
            Branch::of(course, followed, since, (index, passed))
        };
        let (Some(mine), Some(theirs)) = (branch(index, passed), branch(i, other)) else {
            continue;
        };
        // Where both move a body they tell of different things that may happen.
        if mine.bodies.iter().any(|b| theirs.bodies.contains(b)) {
            continue;
        }
        let window = mine.begins.max(theirs.begins)..=mine.ends.min(theirs.ends);
        let both = [&mine, &theirs].into_iter();
        let each = both.flat_map(|b| times(b.moved).into_iter().map(|t| t + b.begins));
        let mut times: Vec<f64> = each.filter(|t| window.contains(t)).collect();
        times.sort_by(f64::total_cmp);
        let pose = |b, time| mine.pose(b, time).or_else(|| theirs.pose(b, time));
        let outlines = Outlines::of(scene, &followed.solids, values);
        for a in &mine.moved.bodies {
            let pairs = theirs.moved.bodies.iter().map(|b| [*a.min(b), *a.max(b)]);
            let passing = pairs.filter(|pair| outlines.pass(*pair, &times, pose));
            out.extend(passing.map(|pair| (i, pair)));
        }
    }
    out
}

/// Times at which the bodies of a motion are looked at.
fn times(moved: &Moved) -> Vec<f64> {
    let mut times: Vec<f64> = Vec::new();
    let between = (PLACES / moved.samples.len().max(1)).clamp(1, BETWEEN);
    for pair in moved.samples.windows(2) {
        let step = (pair[1].time - pair[0].time) / between as f64;
        times.extend((0..between).map(|k| pair[0].time + step * k as f64));
    }
    times.extend(moved.samples.last().map(|s| s.time));
    times
}

/// The bodies that a motion along a line or a flight takes through a wall which they have struck before: straight back against
/// its normal, from the place where they struck it. It has no outline, but there it is, or has gone on as it does.
pub(super) fn back_through(
    course: &[Stage],
    followed: &Followed,
    (stage, passed): (&Stage, &Passed),
    values: &Point<f64>,
) -> Vec<[usize; 2]> {
    let What::Motion(moved) = &passed.what else {
        return Vec::new();
    };
    if !matches!(stage.kind, StageKind::Slide(_) | StageKind::Fall(_)) {
        return Vec::new();
    }
    let times = times(moved);
    let mut out = Vec::new();
    for j in successors(stage.from, |j| course[*j].from) {
        let Ok(struck) = &followed.stages[j] else {
            continue;
        };
        let there = at_places(&course[j], &struck.before, values);
        for Struck {
            wall, body, normal, ..
        } in walls(&course[j])
        {
            let pair = [wall.min(body), wall.max(body)];
            let is_so = || {
                let i = moved.bodies.iter().position(|m| *m == body)?;
                let turns = |s: &State| s.bodies[body].spin != Ok(0.0);
                if !is_round(&course[j].scene.bodies[body]) && turns(&passed.before) {
                    return None;
                }
                let normal = finite_pair(&normal, &there, String::new).ok()?;
                let from = known_center(&struck.before, body)?;
                let [was, begins, ends] = [&struck.before, &passed.before, &passed.after]
                    .map(|state| known_center(state, wall));
                let (was, begins, ends) = (was?, begins?, ends?);
                let last = times.last().filter(|t| **t > 0.0).copied().unwrap_or(1.0);
                let away = times.iter().map(|t| {
                    let [x, y, _] = moved.pose(i, *t);
                    let wall =
                        [0, 1].map(|k| begins[k] + t / last * (ends[k] - begins[k]) - was[k]);
                    let gone = [x - from[0] - wall[0], y - from[1] - wall[1]];
                    let aside = gone[0] * normal[1] - gone[1] * normal[0];
                    [dot(&gone, &normal), aside.abs()]
                });
                let far = from[0].hypot(from[1]);
                Some(is_behind(&away.collect::<Vec<_>>(), far))
            };
            if is_so() == Some(true) && !out.contains(&pair) {
                out.push(pair);
            }
        }
    }
    out
}

/// The contacts of an impact at which a wall that goes on moving is struck straight before or behind the face it was struck at before:
/// it is not there.
pub(super) fn off_the_wall(
    course: &[Stage],
    followed: &Followed,
    (stage, passed): (&Stage, &Passed),
    values: &Point<f64>,
) -> Vec<String> {
    let mut out = Vec::new();
    for now in walls(stage) {
        let velocity = &passed.before.bodies[now.wall].velocity;
        let earlier = successors(stage.from, |j| course[*j].from);
        let is_off = |j: usize| {
            let before = &followed.stages[j].as_ref().ok()?.before;
            let [here, normal] = now.face(stage, &passed.before, values)?;
            let then = walls(&course[j]).into_iter().filter(|s| s.wall == now.wall);
            let mut then = then.filter_map(|s| s.face(&course[j], before, values));
            Some(then.any(|[there, n]| {
                let gone = [here[0] - there[0], here[1] - there[1]];
                let aside = (gone[0] * normal[1] - gone[1] * normal[0]).abs();
                let turned = (n[0] - normal[0]).hypot(n[1] - normal[1]);
                let size = here[0].hypot(here[1]).max(there[0].hypot(there[1]));
                let tolerance = TOUCH * size;
                turned < ROUNDING && aside <= tolerance && dot(&gone, &normal).abs() > tolerance
            }))
        };
        let moves = velocity.iter().any(|v| *v != Ok(0.0));
        if moves && earlier.filter_map(is_off).any(|off| off) {
            out.push(now.contact.name);
        }
    }
    out
}

impl Struck {
    /// The place that is struck, seen from the wall, and the normal.
    fn face(&self, stage: &Stage, before: &State, values: &Point<f64>) -> Option<[[f64; 2]; 2]> {
        let there = at_places(stage, before, values);
        let number = |v: &Vector| finite_pair(v, &there, String::new).ok();
        let (at, wall) = (number(&self.contact.at)?, known_center(before, self.wall)?);
        Some([[at[0] - wall[0], at[1] - wall[1]], number(&self.normal)?])
    }
}

/// Where the center of a body is, where that is determined.
fn known_center(state: &State, body: usize) -> Option<[f64; 2]> {
    let [x, y] = &state.bodies[body].center;
    Some([x.clone().ok()?, y.clone().ok()?])
}

/// Whether places by their height above a wall, and how far aside, come to lie behind it straight below where it was struck, by more
/// than what is lost to rounding so far from the origin.
fn is_behind(away: &[[f64; 2]], far: f64) -> bool {
    let size = away
        .iter()
        .fold(0.0f64, |size, a| size.max(a[0].hypot(a[1])));
    let tolerance = (TOUCH * size).max(ROUNDING * far);
    away.windows(2).any(|pair| {
        let [from, to] = [pair[0], pair[1]];
        from[0] >= -tolerance && to[0] < -tolerance && from[1].max(to[1]) < tolerance
    })
}

/// A fixed body that does not turn, struck in an impact.
struct Struck {
    contact: Contact,
    wall: usize,
    /// What strikes it.
    body: usize,
    /// Normal towards that.
    normal: Vector,
}

/// The walls that an impact strikes.
fn walls(stage: &Stage) -> Vec<Struck> {
    let StageKind::Impact { one_sided, .. } = &stage.kind else {
        return Vec::new();
    };
    let bodies = &stage.scene.bodies;
    let is_wall = |b: usize| bodies[b].is_fixed() && bodies[b].spin.is_zero();
    let supports = one_sided
        .iter()
        .filter(|o| !o.is_string)
        .map(OneSided::acting);
    let contacts = stage.scene.contacts.iter().cloned().chain(supports);
    let pushes =
        |c: &Contact| !matches!(c.law, ContactLaw::None | ContactLaw::Sticking) && !c.is_string;
    let all = contacts.filter(pushes).filter_map(|contact| {
        let ([first, second], normal) = (contact.bodies, contact.normal.clone()?);
        let (wall, body, normal) = match (is_wall(first), is_wall(second)) {
            (true, false) => (first, second, normal),
            (false, true) => (second, first, normal.map(|n| -n)),
            _ => return None,
        };
        Some(Struck {
            contact,
            wall,
            body,
            normal,
        })
    });
    all.collect()
}

/// Whether it makes no difference how a body has turned.
fn is_round(body: &Body) -> bool {
    body.is_particle()
        || matches!(
            body.shape,
            Shape::Disk { .. } | Shape::Ring { .. } | Shape::Sphere { .. }
        )
}

/// Whether a hinge, a sticking contact or a linkage joins two bodies somewhere in a scene, or one slides on the other.
fn joined(scene: &Scene, [a, b]: [usize; 2]) -> bool {
    let joins = |scene: &Scene| {
        let sticking = scene.contacts.iter();
        let sticking = sticking.filter(|c| c.law == ContactLaw::Sticking || c.passes);
        let mut all = sticking
            .map(|c| c.bodies)
            .chain(scene.hinges.iter().map(|h| h.bodies));
        all.any(|pair| pair.contains(&a) && pair.contains(&b))
    };
    let linked = |stage: &Stage| {
        let moved = stage.kind.moved();
        let links = matches!(stage.kind, StageKind::Linkage(_));
        links && moved.contains(&a) && moved.contains(&b) || stage.kind.bears([a, b])
    };
    let mut stages = scene.stages.iter();
    joins(scene) || stages.any(|s| joins(&s.scene) || linked(s))
}

/// Whether two bodies that are apart at the beginning are in each other later.
fn pass(course: &[[Vec<Placed<'_>>; 2]]) -> bool {
    let [first, second] = [0, 1].map(|k| course[0][k].len());
    let each = (0..first).flat_map(|i| (0..second).map(move |j| (i, j)));
    let ways: Vec<Vec<f64>> = each
        .map(|(i, j)| {
            let all = course.iter();
            let gaps = all.map(|[a, b]| gap(&a[i], &b[j]));
            gaps.chain(closest(course, i, j)).collect()
        })
        .collect();
    let sizes = course.iter().flatten().flatten();
    let size = sizes.fold(0.0f64, |size, p| {
        let reach = p.piece.half[0].max(p.piece.half[1]) + p.piece.radius;
        size.max(reach).max(p.at[0].hypot(p.at[1]))
    });
    let tolerance = TOUCH * size;
    // A body that touches when it begins and is small beside its way is not told from where that was; a particle is none.
    let reach = |k: usize| {
        let pieces = course[0][k].iter().map(|p| p.piece);
        pieces.fold(0.0f64, |most, p| {
            most.max(p.half[0].max(p.half[1]) + p.radius)
        })
    };
    let is_small = |reach: &f64| *reach > 0.0 && *reach < 10.0 * tolerance;
    let touch = ways.iter().any(|way| way[0].abs() <= tolerance);
    if touch && [0, 1].map(reach).iter().any(is_small) {
        return false;
    }
    if ways.iter().any(|way| way[0] < -tolerance) {
        return false;
    }
    let enters = |way: &Vec<f64>| way.iter().any(|gap| *gap < -tolerance);
    ways.iter().any(enters) || crosses(course, tolerance)
}

/// How far two round pieces are apart where they come closest between the places looked at.
fn closest(course: &[[Vec<Placed<'_>>; 2]], i: usize, j: usize) -> impl Iterator<Item = f64> {
    let between = move |[a, b]: &[Vec<Placed<'_>>; 2]| {
        let (a, b) = (&a[i], &b[j]);
        let is_round = a.piece.half == [0.0; 2] && b.piece.half == [0.0; 2];
        let radii = a.piece.radius + b.piece.radius;
        is_round.then(|| ([b.at[0] - a.at[0], b.at[1] - a.at[1]], radii))
    };
    course.windows(2).filter_map(move |pair| {
        let ((from, radii), (to, _)) = (between(&pair[0])?, between(&pair[1])?);
        let way = [to[0] - from[0], to[1] - from[1]];
        let share = (-dot(&from, &way) / dot(&way, &way)).clamp(0.0, 1.0);
        let there = [0, 1].map(|k| from[k] + share * way[k]);
        (radii > 0.0 && share.is_finite()).then(|| there[0].hypot(there[1]) - radii)
    })
}

/// Whether a particle gets from one side of a thin rod, or of another particle, to the other.
fn crosses(course: &[[Vec<Placed<'_>>; 2]], tolerance: f64) -> bool {
    // What is too small to be seen in something is seen to pass it.
    let is_thin = |p: &Placed<'_>| p.piece.half[1] + p.piece.radius <= tolerance;
    let is_particle = |p: &Placed<'_>| is_thin(p) && p.piece.half[0] <= tolerance;
    [(0, 1), (1, 0)].into_iter().any(|(first, second)| {
        let thin = (0..course[0][first].len()).filter(|i| is_thin(&course[0][first][*i]));
        let each = thin.flat_map(|i| (0..course[0][second].len()).map(move |j| (i, j)));
        let mut each = each.filter(|(_, j)| is_particle(&course[0][second][*j]));
        each.any(|(i, j)| {
            let half = course[0][first][i].piece.half[0];
            let seen = course.iter().map(|at| at[first][i].seen(&at[second][j].at));
            let is_apart = |p: &[f64; 2]| match half > 0.0 {
                true => p[1].abs() > tolerance,
                false => p[0].hypot(p[1]) > tolerance,
            };
            let apart: Vec<[f64; 2]> = seen.filter(is_apart).collect();
            apart.windows(2).any(|pair| {
                let [from, to] = [pair[0], pair[1]];
                if half > 0.0 {
                    let share = from[1] / (from[1] - to[1]);
                    let meets = from[0] + share * (to[0] - from[0]);
                    return from[1] * to[1] < 0.0 && meets.abs() < half - tolerance;
                }
                let length = (to[0] - from[0]).hypot(to[1] - from[1]);
                let beside = (from[0] * to[1] - from[1] * to[0]).abs();
                dot(&from, &to) < 0.0 && beside <= tolerance * length
            })
        })
    })
}

/// How far two pieces are apart \[m\]; below zero, how far they are in each other at least.
fn gap(a: &Placed<'_>, b: &Placed<'_>) -> f64 {
    let between = [b.at[0] - a.at[0], b.at[1] - a.at[1]];
    let round = |p: &Placed<'_>| p.piece.half == [0.0; 2];
    let radii = a.piece.radius + b.piece.radius;
    let sides = match (round(a), round(b)) {
        (true, true) => between[0].hypot(between[1]),
        (true, false) => outside(b, &a.at),
        (false, true) => outside(a, &b.at),
        (false, false) => {
            let axes = a.axes.iter().chain(&b.axes);
            let reach = |p: &Placed<'_>, axis: &[f64; 2]| {
                let along = [0, 1].map(|k| p.piece.half[k] * dot(&p.axes[k], axis).abs());
                along[0] + along[1]
            };
            axes.map(|axis| dot(&between, axis).abs() - reach(a, axis) - reach(b, axis))
                .fold(f64::NEG_INFINITY, f64::max)
        }
    };
    sides - radii
}

/// How far a place lies outside a rectangle; below zero inside it.
fn outside(box_: &Placed<'_>, place: &[f64; 2]) -> f64 {
    let seen = box_.seen(place);
    let beyond = [0, 1].map(|k| seen[k].abs() - box_.piece.half[k]);
    match beyond[0].max(beyond[1]) {
        inside if inside <= 0.0 => inside,
        _ => beyond[0].max(0.0).hypot(beyond[1].max(0.0)),
    }
}

impl Piece {
    fn at(&self, [x, y, angle]: [f64; 3], from: f64) -> Placed<'_> {
        let turned = |[p, q]: [f64; 2], angle: f64| {
            let (s, c) = angle.sin_cos();
            [p * c - q * s, p * s + q * c]
        };
        let [p, q] = turned(self.at, angle - from);
        // What is round looks the same however fast it turns.
        let along = match self.half {
            [0.0, 0.0] => 0.0,
            _ => self.angle + angle - from,
        };
        Placed {
            piece: self,
            at: [x + p, y + q],
            axes: [turned([1.0, 0.0], along), turned([0.0, 1.0], along)],
        }
    }
}

impl Placed<'_> {
    /// A place along and across the sides.
    fn seen(&self, place: &[f64; 2]) -> [f64; 2] {
        let arm = [place[0] - self.at[0], place[1] - self.at[1]];
        [dot(&arm, &self.axes[0]), dot(&arm, &self.axes[1])]
    }
}

/// The outline of a body from its center; none where the file gives none.
fn pieces(
    body: &Body,
    center: [f64; 2],
    values: &Point<f64>,
    into: &mut Vec<Piece>,
) -> Result<(), Undefined> {
    let number = |e: &Expr| finite(e, values, || format!("outline of {}", body.name));
    let (half, radius) = match &body.shape {
        Shape::Composite { parts } => {
            let mut parts = parts.iter();
            return parts.try_for_each(|part| pieces(part, center, values, into));
        }
        Shape::Fixed | Shape::Other => return Ok(()),
        Shape::Particle => ([0.0; 2], 0.0),
        Shape::Rod { length } => ([number(length)? / 2.0, 0.0], 0.0),
        Shape::Ring { radius } | Shape::Disk { radius } | Shape::Sphere { radius } => {
            ([0.0; 2], number(radius)?)
        }
        Shape::Rectangle { width, height } => ([number(width)? / 2.0, number(height)? / 2.0], 0.0),
    };
    let at = finite_pair(&body.center, values, || format!("center of {}", body.name))?;
    let angle = match half {
        [0.0, 0.0] => 0.0,
        _ => number(&body.angle)?,
    };
    into.push(Piece {
        at: [at[0] - center[0], at[1] - center[1]],
        half,
        angle,
        radius,
    });
    Ok(())
}
