//! A motion between impacts: the body at the beginning and at the end, the way of its center, and what is known of the way.
//!
//! In: a scene with the bodies where they are when the motion begins, what happens, and the sense of a rotation. Out: a
//! sheet. Where the motion ends is geometry; how fast it is there plays no part here.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::label::Label;
use super::marks::centers;
use super::place::{Spot, Wish};
use super::pose::{Look, Pose, posed};
use super::sheet::{Ink, Line, SIZE, SMALL, Sheet, arc};
use super::stage::{Stage, spanning};
use super::values::{Pair, Values, size};
use crate::expr::Expr;
use crate::scene::{
    Body, Fall, FallEnd, Hinge, Linkage, Scene, Slide, SlideEnd, StageKind, Turn, Until,
};

/// Shortest length that is marked, in pixels.
const SHORTEST: f64 = 8.0;

/// The scene as it is drawn: a point that is turned about is a hinge here, so that its support is seen.
pub fn stand_in(scene: &Scene, kind: &StageKind) -> Scene {
    let mut out = scene.clone();
    out.contacts.clear();
    out.hinges.clear();
    out.blows.clear();
    let mut hold = |name: &str, at: &crate::expr::Vector, body: usize| {
        if let Some(fixed) = scene.bodies.iter().position(Body::is_fixed) {
            out.hinges.push(Hinge {
                name: name.to_string(),
                bodies: [fixed, body],
                at: at.clone(),
            });
        }
    };
    match kind {
        StageKind::Turn(turn) => hold(&turn.about_name, &turn.about, turn.body),
        StageKind::Wind(wind) => hold("pole", &wind.around, wind.body),
        StageKind::Slide(slide) => {
            for p in slide.pulleys() {
                hold("", &scene.bodies[p].center, p);
            }
        }
        _ => {}
    }
    out
}

/// Draws the motion; `None` where something has no finite place.
pub fn motion(scene: &Scene, values: &Values, kind: &StageKind, clockwise: bool) -> Option<Sheet> {
    let mut sheet = Sheet::default();
    let begin = posed(scene, values)?;
    let body = match kind {
        StageKind::Turn(t) => t.body,
        StageKind::Slide(s) => s.body,
        StageKind::Fall(f) => f.body,
        StageKind::Wind(w) => w.body,
        StageKind::Linkage(l) => l.places.first()?.0,
        StageKind::Impact { .. } => return None,
    };
    let from = begin.get(body)?;
    let path = way(scene, values, kind, clockwise, from)?;
    let with: &[usize] = match kind {
        StageKind::Turn(turn) => &turn.with,
        StageKind::Slide(slide) => &slide.with,
        StageKind::Fall(fall) => &fall.with,
        _ => &[],
    };
    let end = path
        .last()
        .map_or_else(|| from.clone(), |(pose, _)| pose.clone());
    let mut poses: Vec<Pose> = path.iter().map(|(pose, _)| pose.clone()).collect();
    // Bodies that fly at the same time go ways of their own.
    let mut others: Vec<(Pose, Vec<Pose>)> = Vec::new();
    if let StageKind::Fall(fall) = kind {
        for other in with
            .iter()
            .filter_map(|b| begin.get(*b).map(|pose| (*b, pose)))
        {
            let flown = flight(scene, values, fall, other)?;
            poses.extend(flown.iter().cloned());
            others.push((other.1.clone(), flown));
        }
    }
    let strung = ends(values, kind, &begin, from, &end)?;
    poses.extend(strung.iter().map(|(_, pose)| pose.clone()));
    let stage = spanning(scene, values, begin.clone(), &poses)?;
    stage.fixed(&mut sheet, &[]);
    if let StageKind::Slide(slide) = kind
        && let along = values.pair(&slide.along)?
        && (slide.rolling
            || slide.friction.is_some()
            || slide.gravity.is_some() && along[0].abs() > 1e-9)
    {
        stage.surface(&mut sheet, from, &end, along);
    }
    // A string of a later impact is slack while its body falls.
    if let StageKind::Fall(_) = kind
        && let [(name, Some(top))] = scene.figure.strings.as_slice()
        && scene.bodies.iter().all(|b| b.name != *name)
    {
        stage.slack(&mut sheet, top, from.center, end.center);
    }
    for (i, pose) in begin.iter().enumerate() {
        if i != body && !with.contains(&i) && strung.iter().all(|(b, _)| *b != i) {
            stage.body(&mut sheet, pose, [0.0, 0.0]);
        }
    }
    // The beginning is broken lines, the end is the body as usual.
    broken(&stage, &mut sheet, from);
    for (first, flown) in &others {
        broken(&stage, &mut sheet, first);
        if let Some(last) = flown.last() {
            stage.body(&mut sheet, last, [0.0, 0.0]);
        }
        let points: Vec<Pair> = flown.iter().map(|pose| stage.px(pose.center)).collect();
        trail(&mut sheet, &points);
    }
    if let StageKind::Slide(slide) = kind {
        strings(&stage, &mut sheet, slide, &begin, &end, &strung)?;
    }
    for (b, pose) in &strung {
        broken(&stage, &mut sheet, begin.get(*b)?);
        stage.body(&mut sheet, pose, [0.0, 0.0]);
    }
    if let (StageKind::Turn(turn), Look::Dot) = (kind, &from.look)
        && let Some(about) = stage.spot(&turn.about)
    {
        sheet.segment(about, stage.px(from.center), Line::dashed(Ink::Body), 1.0);
        sheet.segment(about, stage.px(end.center), Line::thin(Ink::Body), 1.0);
    }
    stage.body(&mut sheet, &end, [0.0, 0.0]);
    if let (StageKind::Turn(turn), Some((_, by))) = (kind, path.last())
        && let Some(about) = values.pair(&turn.about)
    {
        for pose in with.iter().filter_map(|b| begin.get(*b)) {
            sheet.circle(stage.px(pose.center), 4.0, Line::dashed(Ink::Body));
            stage.body(&mut sheet, &moved(pose, about, *by, [0.0, 0.0]), [0.0, 0.0]);
        }
    }
    stage.hinges(&mut sheet, &|_| true);
    let points: Vec<Pair> = path.iter().map(|(pose, _)| stage.px(pose.center)).collect();
    trail(&mut sheet, &points);
    match kind {
        StageKind::Turn(turn) => angle(&stage, &mut sheet, turn, from, &end, clockwise),
        StageKind::Slide(s) => {
            if let SlideEnd::Distance(distance) = &s.until {
                along(&stage, &mut sheet, &points, distance);
            }
        }
        StageKind::Fall(f) => {
            if let (Some(first), Some(last)) = (points.first(), points.last()) {
                let corner = [first[0], last[1]];
                // Straight down the way itself is the height.
                let is_apart = (last[0] - first[0]).abs() > SHORTEST;
                match &f.until {
                    FallEnd::Drop(h) => level(&stage, &mut sheet, [*first, corner], is_apart, h),
                    FallEnd::Range(s) => level(&stage, &mut sheet, [corner, *last], true, s),
                    FallEnd::Time(_) => {}
                }
            }
        }
        StageKind::Wind(w) => {
            if let Some(pole) = stage.spot(&w.around) {
                let ends = [(from, None), (&end, Some(&w.to))];
                for (pose, length) in ends {
                    let at = stage.px(pose.center);
                    sheet.segment(pole, at, Line::thin(Ink::Body), 1.0);
                    if let Some(e) = length {
                        beside(&stage, &mut sheet, pole, at, e);
                    }
                }
            }
        }
        StageKind::Linkage(_) | StageKind::Impact { .. } => {}
    }
    forces(&stage, &mut sheet, kind, body, &end);
    centers(&stage, &mut sheet, &[body]);
    for (pose, word) in [(from, "beginning"), (&end, "end")] {
        sheet.wish(Wish {
            label: Label::words(word),
            size: SMALL,
            spot: Spot::Point {
                at: stage.px(pose.center),
                toward: [0.0, 0.0],
                reach: 9.0,
            },
        });
    }
    sheet.settle();
    Some(sheet)
}

/// A body at the beginning.
fn broken(stage: &Stage, sheet: &mut Sheet, pose: &Pose) {
    let outline: Vec<Pair> = pose.outline().into_iter().map(|p| stage.px(p)).collect();
    match pose.look {
        Look::Dot => sheet.circle(stage.px(pose.center), 6.0, Line::dashed(Ink::Body)),
        _ if !pose.skin.is_empty() => {
            for line in pose.drawn() {
                let line = line.into_iter().map(|p| stage.px(p)).collect();
                sheet.path(line, true, Line::dashed(Ink::Body), 1.0);
            }
        }
        _ => sheet.path(outline, true, Line::dashed(Ink::Body), 1.0),
    }
}

/// What else a motion moves, at its end: the other bodies of a linkage, and what hangs at the other ends of strings, as far
/// along its line as the body itself.
fn ends(
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
    let far = size([0, 1].map(|k| end.center[k] - from.center[k]));
    let mut out = Vec::new();
    for string in &slide.strings {
        let along = values.pair(&string.along)?;
        for b in &string.to {
            let pose = begin.get(*b)?;
            let shift = along.map(|c| c * far);
            out.push((*b, moved(pose, pose.center, 0.0, shift)));
        }
    }
    Some(out)
}

/// The strings at the end of a motion: straight from each body to the rim of its pulley, and between two pulleys.
fn strings(
    stage: &Stage,
    sheet: &mut Sheet,
    slide: &Slide,
    begin: &[Pose],
    end: &Pose,
    strung: &[(usize, Pose)],
) -> Option<()> {
    for string in &slide.strings {
        let other = strung.iter().find(|(b, _)| *b == string.to[0])?;
        let legs = [
            (end, &slide.along, string.over[0]),
            (&other.1, &string.along, string.over[string.over.len() - 1]),
        ];
        let mut feet = Vec::new();
        for (pose, along, pulley) in legs {
            let along = stage.values.pair(along)?;
            let center = begin.get(pulley)?.center;
            let ahead = (0..2).map(|k| (center[k] - pose.center[k]) * along[k]);
            let ahead: f64 = ahead.sum();
            let foot = [0, 1].map(|k| pose.center[k] + ahead * along[k]);
            let ends = [pose.center, foot].map(|p| stage.px(p));
            sheet.segment(ends[0], ends[1], Line::thin(Ink::Body), 1.0);
            feet.push(stage.px(foot));
        }
        if string.over.len() > 1 {
            sheet.segment(feet[0], feet[1], Line::thin(Ink::Body), 1.0);
        }
    }
    Some(())
}

/// Poses on the way, the first one the beginning, each with the angle turned through.
fn way(
    scene: &Scene,
    values: &Values,
    kind: &StageKind,
    clockwise: bool,
    from: &Pose,
) -> Option<Vec<(Pose, f64)>> {
    let straight = |d: Pair| {
        let at = |k: u32| {
            (
                moved(from, from.center, 0.0, [d[0] * part(k), d[1] * part(k)]),
                0.0,
            )
        };
        (0..=STEPS).map(at).collect::<Vec<_>>()
    };
    Some(match kind {
        StageKind::Turn(turn) => {
            let about = values.pair(&turn.about)?;
            let center = values.pair(&turn.lump(scene).center)?;
            let by = turned(values, turn, center, about, clockwise)?;
            let at = |k: u32| (moved(from, about, by * part(k), [0.0, 0.0]), by * part(k));
            (0..=STEPS).map(at).collect()
        }
        StageKind::Slide(s) => {
            let along = values.pair(&s.along)?;
            let far = match &s.until {
                SlideEnd::Distance(distance) => values.of(distance)?,
                // How far it gets is the result; the picture shows which way.
                _ => {
                    3.0 * from.outline().iter().fold(0.1, |far: f64, p| {
                        far.max(size([p[0] - from.center[0], p[1] - from.center[1]]))
                    })
                }
            };
            straight([along[0] * far, along[1] * far])
        }
        StageKind::Fall(f) => flight(scene, values, f, (f.body, from))?
            .into_iter()
            .map(|pose| (pose, 0.0))
            .collect(),
        StageKind::Wind(w) => {
            let (pole, to) = (values.pair(&w.around)?, values.of(&w.to)?);
            let arm = [from.center[0] - pole[0], from.center[1] - pole[1]];
            let (long, phi) = (size(arm), arm[1].atan2(arm[0]));
            let turns = 1.75 * TAU * if clockwise { -1.0 } else { 1.0 };
            let at = |k: u32| {
                let (s, c) = (phi + turns * part(k)).sin_cos();
                let r = long + (to - long) * part(k);
                let shift = [
                    pole[0] + r * c - from.center[0],
                    pole[1] + r * s - from.center[1],
                ];
                (moved(from, from.center, 0.0, shift), 0.0)
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

/// Pictures of a way.
const STEPS: u32 = 40;

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

/// The angle of a rotation, counterclockwise.
fn turned(values: &Values, turn: &Turn, center: Pair, about: Pair, clockwise: bool) -> Option<f64> {
    let way = if clockwise { -1.0 } else { 1.0 };
    let phi = (center[1] - about[1]).atan2(center[0] - about[0]);
    let to = match &turn.until {
        Until::By(by) => return Some(way * values.of(by)?),
        Until::For(_) | Until::Stops => return Some(way * 1.2),
        Until::Above => FRAC_PI_2,
        Until::Below => -FRAC_PI_2,
    };
    Some(way * (way * (to - phi)).rem_euclid(TAU))
}

/// A pose turned about a point and shifted.
fn moved(pose: &Pose, about: Pair, by: f64, shift: Pair) -> Pose {
    let (s, c) = by.sin_cos();
    let turn = |p: Pair| [p[0] * c - p[1] * s, p[0] * s + p[1] * c];
    let arm = turn([pose.center[0] - about[0], pose.center[1] - about[1]]);
    let look = match &pose.look {
        Look::Blob(points) => Look::Blob(points.iter().map(|p| turn(*p)).collect()),
        Look::Parts(parts) => {
            Look::Parts(parts.iter().map(|p| moved(p, about, by, shift)).collect())
        }
        other => other.clone(),
    };
    Pose {
        center: [about[0] + arm[0] + shift[0], about[1] + arm[1] + shift[1]],
        angle: pose.angle + by,
        look,
        massless: pose.massless,
        skin: pose.skin.clone(),
    }
}

/// The angle a rotation goes through, at the point it turns about.
fn angle(stage: &Stage, sheet: &mut Sheet, turn: &Turn, from: &Pose, end: &Pose, clockwise: bool) {
    let Some(at) = stage.spot(&turn.about) else {
        return;
    };
    let ray = |pose: &Pose| {
        let p = stage.px(pose.center);
        [p[0] - at[0], p[1] - at[1]]
    };
    let (a, b) = (ray(from), ray(end));
    let start = a[1].atan2(a[0]);
    let way = if clockwise { -1.0 } else { 1.0 };
    let sweep = way * (way * (b[1].atan2(b[0]) - start)).rem_euclid(TAU);
    // A center of mass there has its name already.
    if size(a) > 1.0 {
        sheet.wish(Wish {
            label: Label::symbol(&turn.about_name, None),
            size: SIZE,
            spot: Spot::Point {
                at,
                toward: [0.0, 0.0],
                reach: 6.0,
            },
        });
    }
    if size(a) < 8.0 || sweep.abs() < 0.03 {
        return;
    }
    let reach = (0.55 * size(a).min(size(b))).clamp(16.0, 44.0);
    let tip = |phi: f64, r: f64| [at[0] + r * phi.cos(), at[1] + r * phi.sin()];
    for phi in [start, start + sweep] {
        sheet.segment(at, tip(phi, reach + 8.0), Line::dashed(Ink::Dimension), 1.0);
    }
    sheet.path(
        arc(at, reach, start, start + sweep),
        false,
        Line::thin(Ink::Dimension),
        3.0,
    );
    if let Until::By(by) = &turn.until {
        let half = start + sweep / 2.0;
        sheet.wish(Wish {
            label: Label::formula(by, stage.scene),
            size: SIZE,
            spot: Spot::Point {
                at: tip(half, reach),
                toward: [half.cos(), half.sin()],
                reach: 1.5,
            },
        });
    }
}

/// The way of a center, with an arrow at its end.
fn trail(sheet: &mut Sheet, points: &[Pair]) {
    let [.., last_but, last] = points else {
        return;
    };
    let before = points[..points.len() - 1].to_vec();
    sheet.path(before, false, Line::dashed(Ink::Motion), 2.0);
    let d = [last[0] - last_but[0], last[1] - last_but[1]];
    if size(d) > 1e-6 {
        let u = [d[0] / size(d), d[1] / size(d)];
        let tail = [last[0] - u[0] * 11.0, last[1] - u[1] * 11.0];
        sheet.arrow(tail, *last, Ink::Motion, 1.6);
    }
}

/// A height or a range beside a flight, on a line of its own where the flight does not go along it.
fn level(stage: &Stage, sheet: &mut Sheet, [from, to]: [Pair; 2], is_apart: bool, e: &Expr) {
    if size([to[0] - from[0], to[1] - from[1]]) < SHORTEST {
        return;
    }
    if is_apart {
        sheet.segment(from, to, Line::thin(Ink::Dimension), 1.0);
    }
    beside(stage, sheet, from, to, e);
}

/// The length of a straight way.
fn along(stage: &Stage, sheet: &mut Sheet, points: &[Pair], length: &Expr) {
    if let (Some(a), Some(b)) = (points.first(), points.last()) {
        beside(stage, sheet, *a, *b, length);
    }
}

fn beside(stage: &Stage, sheet: &mut Sheet, from: Pair, to: Pair, e: &Expr) {
    sheet.wish(Wish {
        label: Label::formula(e, stage.scene),
        size: SIZE,
        spot: Spot::Along { from, to },
    });
}

/// What does work: weight at the center, a moment at the fixed point, a force along the way.
fn forces(stage: &Stage, sheet: &mut Sheet, kind: &StageKind, body: usize, end: &Pose) {
    let (gravity, torque, push) = match kind {
        StageKind::Turn(t) => (&t.gravity, &t.torque, None),
        StageKind::Slide(s) => (&s.gravity, &None, s.force.as_ref().map(|f| (f, &s.along))),
        StageKind::Fall(f) => (&f.gravity, &None, None),
        _ => return,
    };
    let at = stage.px(end.center);
    let mut arrow = |to: Pair, e: &Expr| {
        sheet.arrow(at, to, Ink::Impulse, 1.8);
        sheet.wish(Wish {
            label: Label::formula(e, stage.scene),
            size: SIZE,
            spot: Spot::Along { from: at, to },
        });
    };
    if let Some(g) = gravity {
        let with: &[usize] = match kind {
            StageKind::Turn(turn) => &turn.with,
            StageKind::Slide(slide) => &slide.with,
            _ => &[],
        };
        let masses = with.iter().chain([&body]);
        let mass = Expr::sum(masses.map(|b| stage.scene.bodies[*b].mass.clone()));
        arrow([at[0], at[1] - 40.0], &(&mass * g));
    }
    if let Some((force, direction)) = push
        && let Some(d) = stage.values.pair(direction)
    {
        arrow([at[0] + 40.0 * d[0], at[1] + 40.0 * d[1]], force);
    }
    if let (Some(torque), StageKind::Turn(turn)) = (torque, kind)
        && let Some(at) = stage.spot(&turn.about)
    {
        let sign = if turn.clockwise == Some(true) {
            -1.0
        } else {
            1.0
        };
        let (radius, sweep) = (24.0, sign * 1.1 * FRAC_PI_2 * 2.0);
        let start = FRAC_PI_2 + 0.3;
        sheet.turning(at, radius, start, sweep, Ink::Impulse);
        let half: f64 = start + sweep / 2.0;
        sheet.wish(Wish {
            label: Label::formula(torque, stage.scene),
            size: SIZE,
            spot: Spot::Point {
                at: [at[0] + radius * half.cos(), at[1] + radius * half.sin()],
                toward: [half.cos(), half.sin()],
                reach: 2.0,
            },
        });
    }
}
