//! What was found of a scene, held against the scene followed in numbers from its beginning.
//!
//! In: the stages and answers in closed form. Out: checks. The other side is [`mod@crate::numeric::follow`], which starts at the
//! file and takes nothing from here: not a place, an inertia, a branch or a sense of rotation. A check that could not be made
//! says so.

mod asked;
mod values;

use std::collections::{BTreeMap, BTreeSet};

use super::integrate::points_of;
use super::worlds::{self, World};
use super::{Answer, Case, StageTold, State, Told};
use crate::answer::Check;
use crate::dimension::Dimension;
use crate::domain::Domains;
use crate::expr::{Expr, Point, Rational, Symbol};
use crate::interval::rounding;
use crate::numeric::follow::{self, BodyState, Component, Followed, Loss, Lost, Passed, What};
use crate::scene::{Scene, Stage, StageKind, Until};

/// Points at which each way through the cases is followed.
const POINTS: usize = 2;
/// Points that are tried to find them.
const TRIED: usize = 40;
/// Points beyond them of which those are tried where what is told should happen, and how many of these.
const PROMISING: [usize; 2] = [1000, 20];
/// Further points looked at before bodies are said to pass through each other wherever the motion comes about.
const ELSEWHERE: usize = 24;
/// Difference that counts as agreement, in parts of the largest quantity of its kind; the integrator works to 1e-12.
const CLOSE: f64 = 1e-7;
/// Relative error of the data whose effect is no disagreement either: a thousand times that of the integrator.
const BACKWARD: f64 = 1e-9;

/// The kind of check that tells whether a motion can be.
pub(super) const POSSIBLE: &str = "possible";

/// A scene followed at some points.
pub(super) struct Second<'a> {
    scene: &'a Scene,
    points: Vec<Seen>,
    /// Why points were given up.
    lost: Vec<Lost>,
    /// What happens at the values of the scene, where it gives them all.
    given: Option<Followed>,
}

/// Outcomes of stages told, both by index.
type Way = BTreeMap<usize, usize>;

/// The scene at one point.
struct Seen {
    /// What happens there, of the stages that are told of it.
    way: Way,
    point: Point<f64>,
    followed: Followed,
    units: Units,
}

/// The largest mass, length and speed there, for telling what is small.
#[derive(Clone, Copy)]
struct Units {
    mass: f64,
    length: f64,
    speed: f64,
}

/// Follows a scene at points of its domain: some for each way through its cases, and some for each outcome, which may suppose
/// what no whole way does.
pub(super) fn look<'a>(scene: &'a Scene, worlds: &[World], stages: &[StageTold]) -> Second<'a> {
    let mut out = Second {
        scene,
        points: Vec::new(),
        lost: Vec::new(),
        given: None,
    };
    let outcomes = stages.iter().enumerate();
    let outcomes = outcomes.flat_map(|(i, told)| (0..told.cases.len().max(1)).map(move |k| (i, k)));
    let mut wanted: Vec<Way> = worlds.iter().map(|world| world.outcome.clone()).collect();
    wanted.extend(outcomes.map(|at| super::line(stages, at).collect::<Way>()));
    let names = names(scene);
    // The values of the scene show a case that few points of its domain have.
    let own = scene.given();
    let is_whole = names.iter().all(|name| own.values.contains_key(name));
    // What plays no part needs no value.
    let is_given = follow::symbols(scene)
        .iter()
        .all(|name| own.values.contains_key(name));
    out.given = is_given.then(|| follow::follow(scene, &own).ok()).flatten();
    let own = is_whole.then_some(own);
    let random = points_of(names, &scene.domains, PROMISING[0]);
    let mut promising = 0;
    for (k, point) in own.into_iter().chain(random).enumerate() {
        if k > TRIED {
            if !wanted.iter().any(|way| promises(way, stages, &point)) {
                continue;
            }
            promising += 1;
            if promising > PROMISING[1] {
                break;
            }
        }
        let Some(seen) = seen_at(scene, stages, point) else {
            continue;
        };
        if let Some(Err(lost)) = seen.followed.stages.iter().find(|s| s.is_err()) {
            out.lost.push(lost.clone());
        }
        if !wanted.iter().any(|wanted| leads(&seen.way, wanted)) {
            continue;
        }
        out.points.push(seen);
        let count = |way: &Way| out.points.iter().filter(|s| leads(&s.way, way)).count();
        wanted.retain(|way| count(way) < POINTS);
        if wanted.is_empty() {
            break;
        }
    }
    out
}

/// A scene followed at a point.
fn seen_at(scene: &Scene, stages: &[StageTold], point: Point<f64>) -> Option<Seen> {
    let followed = follow::follow(scene, &point).ok()?;
    Some(Seen {
        way: way_of(scene, stages, &followed, &point),
        units: Units::of(&followed),
        point,
        followed,
    })
}

/// A scene followed at points where something holds that an answer needs.
fn seen_where<'a>(
    scene: &'a Scene,
    stages: &'a [StageTold],
    domains: &'a Domains,
) -> impl Iterator<Item = Seen> + 'a {
    let points = points_of(names(scene), domains, ELSEWHERE);
    points.filter_map(|point| seen_at(scene, stages, point))
}

/// Whether all these outcomes are among those that happen.
fn leads(happens: &Way, outcomes: &Way) -> bool {
    outcomes.iter().all(|(i, k)| happens.get(i) == Some(k))
}

/// All that has to have a value for a scene to be followed.
fn names(scene: &Scene) -> BTreeSet<Symbol> {
    let mut names: BTreeSet<Symbol> = follow::symbols(scene);
    names.extend(scene.parameters.iter().map(|p| p.name.clone()));
    names
}

/// Whether all that some outcomes need is so at a point. What is followed there decides.
fn promises(way: &Way, stages: &[StageTold], point: &Point<f64>) -> bool {
    let holds = |e: &Expr| e.evaluate(point).is_none_or(|v| v > 0.0);
    way.iter().all(|(i, k)| {
        let told = &stages[*i];
        let conditions = told.cases.get(*k).into_iter().flat_map(|c| &c.conditions);
        told.rests_on().all(holds) && conditions.map(|(_, e)| e).all(holds)
    })
}

/// What the second way finds to happen: of each stage that it gets to the end of, as it is told, the outcome there. Where that
/// lies on a boundary, or what the stage supposes is not so, it is left out, and what goes on from it.
fn way_of(scene: &Scene, stages: &[StageTold], followed: &Followed, point: &Point<f64>) -> Way {
    let mut way = Way::new();
    let fails = |e: &Expr| e.evaluate(point).is_some_and(|v| v < 0.0);
    let holds = |e: &Expr| e.evaluate(point).is_none_or(|v| v > 0.0);
    for (i, told) in stages.iter().enumerate() {
        let follows = told
            .branch
            .is_none_or(|(parent, case)| way.get(&parent) == Some(&case));
        let passed = passed(scene, followed, told);
        // That a moment does not let it come to rest on the way is supposed in words alone.
        let is_told = |p: &&Passed| !came_back(told, p);
        let passed = passed.filter(|_| follows && !told.rests_on().any(fails));
        let Some(passed) = passed.filter(is_told) else {
            continue;
        };
        let acts = |case: &Case| match &passed.what {
            What::Motion(_) => false,
            // Of more than the motion needs, some are found to act.
            What::Impact(impact) if case.redundant => impact.is_within(&case.active),
            What::Impact(impact) => impact.is_by(&case.active),
        };
        let is_so = |case: &Case| acts(case) && case.conditions.iter().all(|(_, e)| holds(e));
        let outcome = match told.cases.as_slice() {
            [] => Some(0),
            cases => cases.iter().position(is_so),
        };
        way.extend(outcome.map(|k| (i, k)));
    }
    way
}

/// Whether a rotation under a moment, to the place above or below, has come there back against the sense in which it began.
fn came_back(told: &StageTold, passed: &Passed) -> bool {
    let (StageKind::Turn(turn), What::Motion(moved)) = (&told.placed.kind, &passed.what) else {
        return false;
    };
    if turn.torque.is_none() || !matches!(turn.until, Until::Above | Until::Below) {
        return false;
    }
    let ended = moved.turned.filter(|by| *by != 0.0).zip(moved.clockwise);
    ended.is_some_and(|(by, clockwise)| (by < 0.0) != clockwise)
}

fn passed<'f>(scene: &Scene, followed: &'f Followed, told: &StageTold) -> Option<&'f Passed> {
    let name = &told.placed.name;
    let index = scene.stages.iter().position(|s| s.name == *name);
    let index = index.or((!scene.has_stages()).then_some(0))?;
    followed.stages.get(index)?.as_ref().ok()
}

impl Units {
    fn of(followed: &Followed) -> Units {
        let (sizes, heavy) = (followed.sizes(), followed.sizes().mass);
        // Where everything is at rest, before and after, an impulse tells what is fast.
        let passed = followed.stages.iter().filter_map(|s| s.as_ref().ok());
        let impulses = passed.filter_map(|p| match &p.what {
            What::Impact(impact) => Some(impact),
            What::Motion(_) => None,
        });
        let impulses = impulses.flat_map(|i| i.contacts.iter().chain(&i.hinges).chain(&i.blows));
        let parts = impulses.flat_map(|i| &i.impulse).flatten();
        let speed = parts.fold(sizes.speed, |a, p| a.max(p.abs() / heavy));
        let or_one = |v: f64| if v > 0.0 { v } else { 1.0 };
        Units {
            mass: or_one(heavy),
            length: or_one(sizes.length),
            speed: or_one(speed),
        }
    }

    /// The size of a quantity.
    fn size(&self, dimension: &Dimension) -> f64 {
        let number = |k: &Rational| Expr::from(k.clone()).evaluate(&Point::<f64>::default());
        let power = |base: f64, k: &Rational| base.powf(number(k).unwrap_or(0.0));
        let second = self.length / self.speed;
        power(self.mass, &dimension.mass)
            * power(self.length, &dimension.length)
            * power(second, &dimension.time)
    }
}

/// What a comparison came to.
#[derive(Default)]
struct Compared {
    worst: f64,
    points: usize,
    values: usize,
    apart: Option<String>,
}

impl Compared {
    /// A value told and the one found; `shaken` is how far the told one moves with the data.
    fn put(&mut self, what: &str, [told, found]: [f64; 2], size: f64, shaken: impl Fn() -> f64) {
        self.values += 1;
        let size = size.max(told.abs().max(found.abs()) * 1e-3).max(1e-300);
        let gap = (told - found).abs() / size;
        // A gap that is no number is one.
        if (gap.is_nan() || gap > CLOSE && gap > shaken() / size) && self.apart.is_none() {
            self.apart = Some(format!("{what} is {told:.9} here and {found:.9} there"));
        }
        self.worst = self.worst.max(gap);
    }

    /// A value told where the second way has none, since a stage leaves it open.
    fn missing(&mut self, what: &str, told: f64, stage: &str) {
        let words = || format!("{what} is {told:.9} here and open there since `{stage}`");
        self.apart.get_or_insert_with(words);
    }

    fn check(self, what: &str, second: &Second<'_>) -> Check {
        let kind = "integration";
        if self.points == 0 {
            return Check::new(
                kind,
                format!(
                    "{what} is not compared with the scene followed numerically{}",
                    second.why_not()
                ),
                second.contradicts().then_some(false),
            );
        }
        let points = crate::verify::points(self.points);
        let words = match &self.apart {
            // The integrator works to 1e-12; what is below is the rounding of the machine at hand.
            None => format!(
                "{what} agrees at {points} with the scene followed numerically from the given data (relative difference at most {:.0e})",
                self.worst.max(1e-10)
            ),
            Some(apart) => format!(
                "{what} differs from the scene followed numerically from the given data: {apart}"
            ),
        };
        Check::new(kind, words, Some(self.apart.is_none()))
    }
}

/// By how much a value changes when each of the data changes by [`BACKWARD`] of itself, and what rounding may make of its
/// formula: much where what is left is a small difference.
fn shaken(e: Option<&Expr>, point: &Point<f64>) -> f64 {
    let Some((e, here)) = e.and_then(|e| Some((e, e.evaluate(point)?))) else {
        return 0.0;
    };
    let used = e.symbols();
    let used = point.values.iter().filter(|(name, _)| used.contains(*name));
    let mut near = point.clone();
    let moves = used.filter_map(|(name, value)| {
        near.values.insert(name.clone(), value * (1.0 + BACKWARD));
        let there = e.evaluate(&near);
        near.values.insert(name.clone(), *value);
        Some((there? - here).abs())
    });
    moves.sum::<f64>() + rounding(e, point)
}

impl Second<'_> {
    /// Whether the second way found a contradiction wherever it was tried.
    fn contradicts(&self) -> bool {
        let is_one = |lost: &Lost| matches!(lost.why, Loss::Contradiction(_));
        self.points.is_empty() && !self.lost.is_empty() && self.lost.iter().all(is_one)
    }

    fn why_not(&self) -> String {
        match (self.points.is_empty(), self.lost.first()) {
            (true, Some(lost)) => format!(" ({lost})"),
            _ => String::new(),
        }
    }

    /// That a stage never gets to its end at the values of the scene: a failed check.
    pub fn never_ends(&self, told: &StageTold) -> Option<Check> {
        let lost = self
            .given
            .as_ref()?
            .stages
            .iter()
            .filter_map(|s| s.as_ref().err());
        let mut lost = lost.filter(|lost| lost.stage == told.placed.name);
        let why = lost.find(|lost| matches!(lost.why, Loss::NeverEnds(_)))?;
        let words = format!("at the given values {why}");
        Some(Check::new(POSSIBLE, words, Some(false)))
    }

    /// Bodies that pass through each other in a stage, by index: a failed check where they do at every point looked at, or at the
    /// values of the scene.
    pub fn passage(&self, index: usize, told: &StageTold) -> Option<([usize; 2], Check)> {
        let between = |[a, b]: [usize; 2]| {
            let [a, b] = [a, b].map(|b| &self.scene.bodies[b].name);
            format!("`{a}` and `{b}` pass through each other on the way")
        };
        let given = self.given.as_ref();
        let given = given.and_then(|given| passed(self.scene, given, told));
        if let Some(&pair) = given.and_then(|given| given.passing.first()) {
            let words = between(pair) + " at the given values";
            return Some((pair, Check::new(POSSIBLE, words, Some(false))));
        }
        let here = |seen: &&Seen| seen.way.contains_key(&index);
        let seen = self.points.iter().filter(here);
        let seen = seen.filter_map(|seen| passed(self.scene, &seen.followed, told));
        let mut all: Vec<Vec<[usize; 2]>> = seen.map(|p| p.passing.clone()).collect();
        if all.iter().all(Vec::is_empty) && self.has_company(told) {
            // Which of two bodies gets farther few points may not show.
            let more = points_of(names(self.scene), &self.scene.domains, ELSEWHERE);
            let more = more.filter_map(|point| seen_at(self.scene, &[], point));
            let more = more.filter_map(|s| passed(self.scene, &s.followed, told).cloned());
            all.extend(more.map(|p| p.passing));
        }
        let pair = *all.iter().find_map(|p| p.first())?;
        let is_everywhere = |all: &[Vec<[usize; 2]>]| all.iter().all(|p| p.contains(&pair));
        if is_everywhere(&all) {
            // Two points are few to say that it cannot be.
            let more = points_of(names(self.scene), &self.scene.domains, ELSEWHERE);
            for point in more {
                let followed = follow::follow(self.scene, &point);
                let there = followed.as_ref().ok();
                let there = there.and_then(|f| passed(self.scene, f, told));
                all.extend(there.map(|p| p.passing.clone()));
                if !is_everywhere(&all) {
                    break;
                }
            }
        }
        let (words, holds) = match is_everywhere(&all) {
            true => ("", Some(false)),
            false => (" at some of the points looked at", None),
        };
        Some((pair, Check::new(POSSIBLE, between(pair) + words, holds)))
    }

    /// Whether another motion begins where this one does.
    fn has_company(&self, told: &StageTold) -> bool {
        let stages = &self.scene.stages;
        let is_motion = |s: &&Stage| !s.kind.moved().is_empty();
        let mine = stages.iter().find(|s| s.name == told.placed.name);
        let from = mine.filter(is_motion).and_then(|mine| mine.from);
        let beside = stages.iter().filter(|s| s.from == from).filter(is_motion);
        from.is_some() && beside.count() > 1
    }

    /// Holds places, angles, velocities, spins and times of a stage against what was followed.
    pub fn stage(&self, index: usize, told: &StageTold) -> Check {
        let mut compared = Compared::default();
        for seen in &self.points {
            let passed = passed(self.scene, &seen.followed, told);
            let (Some(passed), Some(outcome)) = (passed, seen.way.get(&index)) else {
                continue;
            };
            let after = told.cases.get(*outcome).map_or(&told.after, |c| &c.after);
            compared.points += 1;
            for (state, bodies, when) in [
                (&told.before, &passed.before.bodies, "before"),
                (after, &passed.after.bodies, "after"),
            ] {
                self.state(seen, state, bodies, when, &mut compared);
            }
            if let (Some(time), Ok(found)) = (&told.time, &passed.time)
                && let Some(time) = time.evaluate(&seen.point)
            {
                let size = seen.units.size(&Dimension::new(0, 0, 1));
                let shaken = || shaken(told.time.as_ref(), &seen.point);
                compared.put("the time it takes", [time, *found], size, shaken);
            }
        }
        if compared.points > 0 && compared.values == 0 && compared.apart.is_none() {
            let words = "nothing of the motion is determined, so that nothing is compared";
            return Check::new("integration", words, None);
        }
        compared.check("the motion", self)
    }

    fn state(
        &self,
        seen: &Seen,
        state: &State,
        bodies: &[BodyState],
        when: &str,
        compared: &mut Compared,
    ) {
        let units = &seen.units;
        for (b, found) in bodies.iter().enumerate() {
            let body = &self.scene.bodies[b];
            if body.is_fixed() {
                continue;
            }
            let mut put = |what: &str, told: &Expr, found: &Component, size: f64, moved: f64| {
                if state.why_open([told]).is_some() {
                    return;
                }
                let what = format!("{what} of `{}` {when}", body.name);
                match (told.evaluate(&seen.point), found) {
                    (Some(value), Ok(found)) => {
                        let shaken = || shaken(Some(told), &seen.point) + moved;
                        compared.put(&what, [value, *found], size, shaken);
                    }
                    (Some(value), Err(open)) => compared.missing(&what, value, &open.stage),
                    (None, _) => {}
                }
            };
            for (k, axis) in ["x", "y"].into_iter().enumerate() {
                let center = &state.center[b][k];
                put(axis, center, &found.center[k], units.length, 0.0);
                let (what, v) = (format!("v_{axis}"), &state.velocity[b][k]);
                put(&what, v, &found.velocity[k], units.speed, 0.0);
            }
            if body.is_particle() {
                continue;
            }
            // Where it is, and so the arm of what acts on it, is known to so many parts of the way; a small body far away feels it.
            let solid = &seen.followed.solids[b];
            let moved = match solid.inertia > 0.0 {
                true => BACKWARD * units.length * units.speed * solid.mass / solid.inertia,
                false => 0.0,
            };
            let size = units.speed / units.length;
            put("spin", &state.spin[b], &found.spin, size, moved);
            if let Ok(angle) = &found.angle {
                // A body that has turned round is where it was.
                let turned = &(&state.angle[b] - &Expr::symbol("angle found"));
                let mut point = seen.point.clone();
                point.values.insert(Symbol::from("angle found"), *angle);
                if state.why_open([&state.angle[b]]).is_none()
                    && let Some(gap) = turned.evaluate(&point)
                {
                    let what = format!("angle of `{}` {when}", body.name);
                    // After many turns an angle is known to so many parts of itself.
                    let size = angle.abs().max(1.0);
                    let turning = found.spin.as_ref().map_or(0.0, |w| w.abs());
                    let turned = if turning > 0.0 {
                        angle.abs() / turning
                    } else {
                        0.0
                    };
                    let shaken = || shaken(Some(&state.angle[b]), &seen.point) + moved * turned;
                    compared.put(&what, [2.0 * (gap / 2.0).sin(), 0.0], size, shaken);
                }
            }
        }
    }
}

/// Holds the answers of a scene against the scene followed in numbers from the file: checks by index of the answer.
pub fn held(scene: &Scene, told: &Told) -> BTreeMap<usize, Check> {
    let worlds = worlds::of(&told.stages);
    let second = look(scene, &worlds, &told.stages);
    answers(&second, (&worlds, &told.stages), &told.answers)
}

/// Checks of all answers, by index.
pub(super) fn answers(
    second: &Second<'_>,
    (worlds, stages): (&[World], &[StageTold]),
    answers: &[Answer],
) -> BTreeMap<usize, Check> {
    let asked = values::Asked {
        scene: second.scene,
        second,
        worlds,
        stages,
        answers,
    };
    let check = |(i, answer): (usize, &Answer)| {
        let question = second.scene.question(&answer.question)?;
        Some((i, asked.check(question, answer)?))
    };
    answers.iter().enumerate().filter_map(check).collect()
}
