//! A motion between impacts: the body at the beginning and at the end, the way of its center, and what is known of the way.
//!
//! In: a scene with the bodies where they are when the motion begins, and what happens. Out: a sheet. Where the bodies go is
//! told by `way`; how fast they are plays no part here.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::Course;
use super::fixture::hatched;
use super::label::Label;
use super::marks::centers;
use super::place::Spot;
use super::plane::{
    Pair, ahead, apart, bearing, dot, left, minus, opposite, plus, polar, right, size, unit,
};
use super::pose::{Look, Pose, posed};
use super::sheet::{Ink, Line, SIZE, SMALL, Sheet, arc};
use super::stage::{Stage, THICK, spanning};
use super::values::Values;
use super::way::Gone;
use crate::expr::Expr;
use crate::scene::{Ask, Body, FallEnd, Hinge, Scene, Slide, SlideEnd, StageKind, Turn, Until};

/// By how much a plank is longer than the slip, at each end, in pixels.
const PLANK: f64 = 16.0;
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

/// Draws the motion that is the only stage of the scene; `None` where it does not come to its end at these values, or something
/// has no finite place.
pub fn motion(scene: &Scene, values: &Values, course: &Course) -> Option<Sheet> {
    let mut sheet = Sheet::default();
    let sheet = &mut sheet;
    let kind = &course.kind;
    let begin = posed(scene, values)?;
    let gone = Gone::new(scene, values, &begin)?;
    let all: Vec<Pose> = gone.ways.iter().flat_map(|w| w.1.clone()).collect();
    let stage = spanning(scene, values, begin.clone(), &all)?;
    let last = gone.last(&begin);
    let (from, end) = (&begin[gone.body], &last[gone.body]);
    surroundings(&stage, sheet, kind, from, end)?;
    let below = match kind {
        StageKind::Slide(slide) => plank(&stage, sheet, slide, [&begin, &last]),
        _ => Vec::new(),
    };
    let moved: Vec<[&Pose; 2]> = gone
        .ways
        .iter()
        .filter(|(b, _)| !below.contains(b))
        .map(|(b, _)| [&begin[*b], &last[*b]])
        .collect();
    if let StageKind::Linkage(_) = kind {
        stage.guides(sheet, &moved);
    }
    for (i, pose) in begin.iter().enumerate() {
        let is_shown = !course.elsewhere.contains(&i) && !course.is_lost(i);
        let is_here = gone.way(i).is_empty() && is_shown;
        if is_here && !is_rolled_over(pose, end) {
            stage.body(sheet, pose, [0.0, 0.0]);
        }
    }
    // The beginning is broken lines, the end is the body as usual.
    for [from, end] in &moved {
        let pairs = from.outline().into_iter().zip(end.outline());
        if pairs.into_iter().any(|(p, q)| apart(p, q) > 1e-9) {
            broken(&stage, sheet, from);
        }
    }
    if !matches!(kind, StageKind::Slide(_)) {
        for strand in stage.strands(kind, &begin)? {
            stage.strand(sheet, &strand, true);
        }
    }
    for strand in stage.strands(kind, &last)? {
        stage.strand(sheet, &strand, false);
    }
    for [_, end] in &moved {
        stage.body(sheet, end, [0.0, 0.0]);
    }
    if let StageKind::Slide(slide) = kind {
        stage.pressed(sheet, slide, [from, end]);
    }
    stage.hinges(sheet, &|_| true);
    for (b, way) in &gone.ways {
        if *b == gone.body || matches!(kind, StageKind::Fall(_)) {
            let points: Vec<Pair> = way.iter().map(|pose| stage.px(pose.center)).collect();
            trail(sheet, &points);
        }
    }
    measures(&stage, sheet, course, &gone, [from, end]);
    forces(&stage, sheet, kind, &gone);
    if let StageKind::Slide(slide) = kind {
        rough(&stage, sheet, slide, &gone);
    }
    centers(&stage, sheet, &[gone.body]);
    for (pose, word) in [(from, "beginning"), (end, "end")] {
        sheet.wish(
            Label::words(word),
            SMALL,
            Spot::point(stage.px(pose.center), [0.0, 0.0], 9.0),
        );
    }
    sheet.settle();
    Some(std::mem::take(sheet))
}

/// Draws what a body slides on at the beginning and at the end, as long as the slip, and the floor below it; gives the bodies
/// drawn so. What has an outline of its own is drawn as usual.
fn plank(stage: &Stage, sheet: &mut Sheet, slide: &Slide, ends: [&[Pose]; 2]) -> Vec<usize> {
    let Some(on) = &slide.on else {
        return Vec::new();
    };
    let below = on.company();
    let is_dot = |b: &usize| matches!(ends[0][*b].look, Look::Dot);
    let along = stage.values.pair(&slide.along).map(unit);
    let (Some(along), true) = (along, below.iter().all(is_dot)) else {
        return Vec::new();
    };
    let down = if along[0] < 0.0 {
        left(along)
    } else {
        right(along)
    };
    let at = |k: usize, b: usize| stage.px(ends[k][b].center);
    let own = minus(at(1, on.body), at(0, on.body));
    let slip = dot(
        minus(minus(at(1, slide.body), at(0, slide.body)), own),
        along,
    );
    let first = stage.foot(&ends[0][slide.body], down);
    // What the body slides back on lies behind it.
    let [back, front] = [slip.min(0.0) - PLANK, slip.max(0.0) + PLANK];
    let corners = |by: Pair| {
        let point = |far: f64, deep: f64| plus(by, ahead(ahead(first, along, far), down, deep));
        vec![
            point(back, 0.0),
            point(front, 0.0),
            point(front, THICK * 2.0),
            point(back, THICK * 2.0),
        ]
    };
    let [begins, stops] = [[0.0; 2], own].map(corners);
    let gone = dot(own, along);
    let floor = |far: f64| ahead(ahead(first, along, far), down, THICK * 2.0 + 1.7);
    let floor = [
        floor(back + gone.min(0.0) - 20.0),
        floor(front + gone.max(0.0) + 20.0),
    ];
    sheet.path(begins, true, Line::dashed(Ink::Body), 1.0);
    sheet.path(stops, true, Line::solid(), 1.0);
    match along[0] < 0.0 {
        true => hatched(sheet, floor[1], floor[0], down),
        false => hatched(sheet, floor[0], floor[1], down),
    }
    below
}

/// Whether something round is where a round body comes to: it has gone on by then, as another stage tells.
fn is_rolled_over(pose: &Pose, end: &Pose) -> bool {
    match (&pose.look, &end.look) {
        (Look::Round { radius: a, .. }, Look::Round { radius: b, .. }) => {
            apart(pose.center, end.center) < 0.98 * (a + b)
        }
        _ => false,
    }
}

/// What a motion goes along: fixed bodies, the surface under a slide, a string that is slack during a fall.
pub(super) fn surroundings(
    stage: &Stage,
    sheet: &mut Sheet,
    kind: &StageKind,
    from: &Pose,
    end: &Pose,
) -> Option<()> {
    stage.fixed(sheet);
    if let StageKind::Slide(slide) = kind
        && let along = stage.values.pair(&slide.along)?
        && !slide.level
        && slide.on.iter().all(|on| on.is_belt(stage.scene))
        && (slide.rolling
            || slide.friction.is_some()
            || slide.gravity.is_some() && along[0].abs() > 1e-9)
    {
        stage.surface(sheet, from, end, along);
    }
    // A string of a later impact is slack while its body falls.
    if let StageKind::Fall(_) = kind
        && let [(name, Some(top))] = stage.scene.figure.strings.as_slice()
        && stage.scene.bodies.iter().all(|b| b.name != *name)
    {
        stage.slack(sheet, top, from.center, end.center);
    }
    Some(())
}

/// What is known of the way: the angle, the length, the height, the string at both ends.
fn measures(
    stage: &Stage,
    sheet: &mut Sheet,
    course: &Course,
    gone: &Gone,
    [from, end]: [&Pose; 2],
) {
    let [first, last] = [from, end].map(|pose| stage.px(pose.center));
    match &course.kind {
        StageKind::Turn(turn) => angle(stage, sheet, course, turn, (from, gone.turned)),
        StageKind::Slide(slide) => {
            let asked = |ask: &Ask| matches!(ask, Ask::Distance);
            let label = match &slide.until {
                SlideEnd::Distance(distance) => Some(Label::formula(distance, stage.scene)),
                _ => course.symbol(asked),
            };
            // Along the body below it is the way beyond that body's own.
            let own = slide.on.as_ref().map(|on| gone.way(on.body));
            let first = match own {
                Some([from, .., to]) => {
                    let [from, to] = [from, to].map(|pose| stage.px(pose.center));
                    plus(first, minus(to, from))
                }
                _ => first,
            };
            // The mark on a belt runs on with it.
            let on_belt = slide.on.iter().any(|on| on.is_belt(stage.scene));
            if let Some(label) = label.filter(|_| !on_belt) {
                beside(sheet, first, last, label);
            }
        }
        StageKind::Fall(fall) => {
            let corner = [first[0], last[1]];
            // Straight down the way itself is the height.
            let is_apart = (last[0] - first[0]).abs() > SHORTEST;
            match &fall.until {
                FallEnd::Drop(h) => level(stage, sheet, [first, corner], is_apart, h),
                FallEnd::Range(s) => level(stage, sheet, [corner, last], true, s),
                FallEnd::Turned(_) | FallEnd::Time(_) | FallEnd::Top => {}
            }
        }
        StageKind::Wind(wind) => {
            if let Some(pole) = stage.spot(&wind.around) {
                beside(sheet, pole, last, Label::formula(&wind.to, stage.scene));
            }
        }
        StageKind::Linkage(_) | StageKind::Impact { .. } => {}
    }
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
        // There and back a broken line would fill its own gaps.
        _ => {
            let closed = outline.len() > 2;
            sheet.path(outline, closed, Line::dashed(Ink::Body), 1.0);
        }
    }
}

/// The angle a rotation goes through, at the point it turns about.
fn angle(
    stage: &Stage,
    sheet: &mut Sheet,
    course: &Course,
    turn: &Turn,
    (from, turned): (&Pose, f64),
) {
    let Some(at) = stage.spot(&turn.about) else {
        return;
    };
    let a = minus(stage.px(from.center), at);
    let (start, sweep) = (bearing(a), turned % TAU);
    // A center of mass there has its name already.
    if size(a) > 1.0 {
        sheet.wish(
            Label::symbol(&turn.about_name, None),
            SIZE,
            Spot::point(at, [0.0, 0.0], 6.0),
        );
    }
    if size(a) < 8.0 || sweep.abs() < 0.03 {
        return;
    }
    let reach = (0.55 * size(a)).clamp(16.0, 44.0);
    let tip = |phi: f64, r: f64| polar(at, r, phi);
    for phi in [start, start + sweep] {
        sheet.segment(at, tip(phi, reach + 8.0), Line::dashed(Ink::Dimension), 1.0);
    }
    sheet.path(
        arc(at, reach, start, start + sweep),
        false,
        Line::thin(Ink::Dimension),
        3.0,
    );
    let label = match &turn.until {
        Until::By(by) => Some(Label::formula(by, stage.scene)),
        _ => course.symbol(|ask| matches!(ask, Ask::Angle { body, .. } if *body == turn.body)),
    };
    if let Some(label) = label {
        let half = start + sweep / 2.0;
        sheet.wish(
            label,
            SIZE,
            Spot::point(tip(half, reach), [half.cos(), half.sin()], 1.5),
        );
    }
}

/// The way of a center, with an arrow at its end.
fn trail(sheet: &mut Sheet, points: &[Pair]) {
    let [.., last_but, last] = points else {
        return;
    };
    let before = points[..points.len() - 1].to_vec();
    sheet.path(before, false, Line::dashed(Ink::Motion), 2.0);
    let d = minus(*last, *last_but);
    if size(d) > 1e-6 {
        let u = unit(d);
        let tail = ahead(*last, u, -11.0);
        sheet.arrow(tail, *last, Ink::Motion, 1.6);
    }
}

/// A height or a range beside a flight, on a line of its own where the flight does not go along it.
fn level(stage: &Stage, sheet: &mut Sheet, [from, to]: [Pair; 2], is_apart: bool, e: &Expr) {
    if apart(to, from) < SHORTEST {
        return;
    }
    if is_apart {
        sheet.segment(from, to, Line::thin(Ink::Dimension), 1.0);
    }
    // A rise is a fall through less than nothing; its length is what is marked.
    let rises = stage.values.of(e).is_some_and(|value| value < 0.0);
    let length = if rises { -e } else { e.clone() };
    beside(sheet, from, to, Label::formula(&length, stage.scene));
}

fn beside(sheet: &mut Sheet, from: Pair, to: Pair, label: Label) {
    sheet.wish(label, SIZE, Spot::Along { from, to });
}

/// What rough ground does: it presses on the body that slides over it, and acts against the slip.
fn rough(stage: &Stage, sheet: &mut Sheet, slide: &Slide, gone: &Gone) -> Option<()> {
    let (mu, g) = (slide.friction.as_ref()?, slide.gravity.as_ref()?);
    let along = stage.values.pair(&slide.along).map(unit)?;
    if slide.level || along[0].abs() < 1e-9 || mu.is_zero() {
        return None;
    }
    let company = slide.company();
    let masses = company.iter().map(|b| stage.scene.bodies[*b].mass.clone());
    let (up, level) = match along[0] < 0.0 {
        true => (right(along), -&slide.along[0]),
        false => (left(along), slide.along[0].clone()),
    };
    let normal = &(&Expr::sum(masses) * g) * &level;
    let at = stage.px(gone.middle(stage.scene, stage.values, &company)?);
    let foot = stage.foot(gone.way(slide.body).last()?, opposite(up));
    let back = -40.0 * slip(stage, slide, gone, along, up)?.signum();
    for (from, to, e) in [
        (at, ahead(at, up, 40.0), &normal),
        (foot, ahead(foot, along, back), &(mu * &normal)),
    ] {
        sheet.arrow(from, to, Ink::Impulse, 1.8);
        sheet.wish(
            Label::formula(e, stage.scene),
            SIZE,
            Spot::Along { from, to },
        );
    }
    Some(())
}

/// How fast a body slips at first over what is below it, along its way; from rest, how far it gets.
fn slip(stage: &Stage, slide: &Slide, gone: &Gone, along: Pair, up: Pair) -> Option<f64> {
    let below = slide.on.as_ref().map(|on| on.body);
    let way = |b: usize| match gone.way(b) {
        [from, .., to] => dot(minus(to.center, from.center), along),
        _ => 0.0,
    };
    let speed = |b: usize| {
        Some(dot(
            stage.values.pair(&stage.scene.bodies[b].velocity)?,
            along,
        ))
    };
    let beyond =
        |of: &dyn Fn(usize) -> Option<f64>| Some(of(slide.body)? - below.map_or(Some(0.0), of)?);
    let body = &stage.scene.bodies[slide.body];
    let rim = match body.shape.radius() {
        Some(radius) => stage.values.of(radius)? * stage.values.of(&body.spin)?,
        None => 0.0,
    };
    let first = beyond(&speed)? + rim * dot(left(along), up);
    match first.abs() > 1e-9 {
        true => Some(first),
        false => beyond(&|b| Some(way(b))),
    }
}

/// What does work: weight at the center of all that moves as one, a moment at the fixed point, a force along the way.
fn forces(stage: &Stage, sheet: &mut Sheet, kind: &StageKind, gone: &Gone) {
    let (gravity, torque, push) = match kind {
        StageKind::Turn(t) => (&t.gravity, &t.torque, None),
        StageKind::Slide(s) if s.level => return,
        StageKind::Slide(s) => (&s.gravity, &None, s.force.as_ref().map(|f| (f, &s.along))),
        StageKind::Fall(f) => (&f.gravity, &None, None),
        _ => return,
    };
    let mut arrow = |at: Pair, to: Pair, e: &Expr| {
        sheet.arrow(at, to, Ink::Impulse, 1.8);
        sheet.wish(
            Label::formula(e, stage.scene),
            SIZE,
            Spot::Along { from: at, to },
        );
    };
    let company = match kind {
        StageKind::Turn(turn) => turn.bodies(),
        StageKind::Slide(slide) => slide.company(),
        _ => vec![gone.body],
    };
    let Some(at) = gone.middle(stage.scene, stage.values, &company) else {
        return;
    };
    let at = stage.px(at);
    if let Some(g) = gravity {
        let masses = company.iter().map(|b| stage.scene.bodies[*b].mass.clone());
        let mass = Expr::sum(masses);
        arrow(at, [at[0], at[1] - 40.0], &(&mass * g));
    }
    if let Some((force, direction)) = push
        && let Some(d) = stage.values.pair(direction)
    {
        arrow(at, ahead(at, d, 40.0), force);
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
        sheet.wish(
            Label::formula(torque, stage.scene),
            SIZE,
            Spot::point(polar(at, radius, half), [half.cos(), half.sin()], 2.0),
        );
    }
}
