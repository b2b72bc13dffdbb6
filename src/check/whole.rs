//! Replays a scene with stages as a whole, in doubles, stage by stage.
//!
//! In: the scene, what the solution says goes into each impact, and claims that belong to none. The scene is followed from its beginning by
//! [`mod@crate::numeric::follow`], which knows nothing of the solution. Where the solution hands on another place or motion than
//! is found there, that is a failure like any other.

use std::collections::BTreeMap;

use super::defined::{holds, within};
use super::impacts::Impact;
use super::{Claim, Meaning, POINTS, Report};
use crate::expr::{Expr, Point, Symbol};
use crate::numeric;
use crate::numeric::follow::{self, BodyState, Passed, Sizes, What};
use crate::scene::{Mode, Scene};

/// Points looked at before a motion that does not get to its end is given up.
const TRIES: u64 = 120;
/// The first of them are of ordinary size, the others of all sizes.
const ORDINARY: u64 = 40;
/// Points among which those are sought at which a rare case should come about.
const SOUGHT: u64 = 2000;
/// Relative difference between what is handed on and what is found.
const CLOSE: f64 = 1e-7;

/// Replays what belongs to no single impact, and holds what is handed on against the scene followed from its beginning.
pub(super) fn replay(
    scene: &Scene,
    impacts: &[Impact],
    meanings: &BTreeMap<Symbol, Meaning>,
    (claims, needs): (&[&Claim], &[Expr]),
    report: &mut Report,
) {
    let mut needed = numeric::needed(scene);
    let parameters = scene.parameters.iter().map(|p| p.name.clone());
    for symbol in follow::symbols(scene).into_iter().chain(parameters) {
        if !needed.angles.contains_key(&symbol) {
            needed.add(&Expr::symbol(&symbol));
        }
    }
    let needed = super::replay::needed(needed, meanings, claims);
    let mut points = Vec::new();
    let mut found: Vec<Found> = vec![Found::default(); impacts.len()];
    for seed in 1..=SOUGHT {
        if points.len() as u64 >= POINTS && found.iter().all(|f| f.compared) {
            break;
        }
        let draw = match seed {
            ..=ORDINARY => numeric::random_point,
            _ if seed > TRIES && seed % 2 == 0 => numeric::random_point,
            _ => numeric::point_of_any_size,
        };
        let point = draw(&needed, &scene.domains, seed);
        let mut doubles = numeric::rounded(&point);
        // Beyond that only where an impact that was not met yet should go as told.
        let mut rest = impacts.iter().zip(&found).filter(|(_, f)| !f.compared);
        if seed > TRIES && !rest.any(|(impact, _)| within(&impact.needs, &doubles)) {
            continue;
        }
        let Ok(followed) = follow::follow(scene, &doubles) else {
            continue;
        };
        let stages = followed.stages.iter().map(|s| s.as_ref().ok());
        let Some(stages) = stages.collect::<Option<Vec<&Passed>>>() else {
            continue;
        };
        for (impact, found) in impacts.iter().zip(&mut found) {
            let passed = stages[impact.stage];
            let here = |name: &Symbol| follow::named(scene, &followed, name, &doubles);
            match (holds(&impact.needs, &doubles), goes_so(impact, passed)) {
                (true, true) if found.apart.is_none() => {
                    let sizes = followed.sizes();
                    let apart = earlier_differs(impact, &doubles, here);
                    let bodies = &passed.before.bodies;
                    found.apart = apart.or_else(|| differs(impact, &doubles, bodies, &sizes));
                    found.compared = true;
                }
                // On the border of two cases it is either.
                (true, false) if within(&impact.needs, &doubles) => {
                    found.otherwise = found.otherwise.or_else(|| mode(passed));
                }
                _ => {}
            }
        }
        // Symbols of answers mean the first of several outcomes.
        let is_first = |passed: &Passed, i: usize| {
            let first = impacts.iter().find(|impact| impact.stage == i);
            // Which way a contact slips its mode does not tell.
            let slips_so =
                |impact: &Impact| impact.mode.is_none() || holds(&impact.needs, &doubles);
            first.is_none_or(|impact| goes_so(impact, passed) && slips_so(impact))
        };
        let mut each = stages.iter().enumerate();
        if points.len() as u64 >= POINTS
            || !holds(needs, &doubles)
            || !each.all(|(i, passed)| is_first(passed, i))
        {
            continue;
        }
        for (name, meaning) in meanings {
            let Meaning::Staged(question, axis) = meaning else {
                continue;
            };
            let answer = follow::answer(scene, &followed, question, &doubles).ok();
            if let Some(value) = answer.and_then(|a| a.component(*axis)) {
                doubles.values.insert(name.clone(), value);
            }
        }
        points.push((point, doubles));
    }
    if points.is_empty() && !impacts.is_empty() {
        let what = String::from("the motion from stage to stage");
        report.open.push(what);
    }
    for (impact, found) in impacts.iter().zip(found) {
        found.tell(impact, report);
    }
    super::defined::in_cases(scene, &needed, claims, report);
    super::replay::compare(points, (scene, meanings), claims, report);
}

/// What was found of an impact at the points where the scene was followed.
#[derive(Clone, Default)]
struct Found {
    /// Whether a point was found at which it goes as told.
    compared: bool,
    /// What is otherwise there.
    apart: Option<String>,
    /// What its contact did where all that it supposes holds and it does not go as told.
    otherwise: Option<&'static str>,
}

impl Found {
    fn tell(self, impact: &Impact, report: &mut Report) {
        let name = impact.name.clone().unwrap_or_default();
        match (self.apart, self.otherwise) {
            (Some(why), _) => {
                let claim = "where the bodies are and how they move into the impact";
                report.fail(&name, claim, why);
            }
            (None, _) if self.compared => report.held += 1,
            (None, Some(does)) if impact.mode.is_some() => {
                let why = format!("where it is so, the contact {does} when followed");
                report.fail(&name, "what friction does in the impact", why);
            }
            // No point was found at which the scene goes this way.
            _ => report.open.push(name),
        }
    }
}

/// What a contact with friction did, in words.
fn mode(passed: &Passed) -> Option<&'static str> {
    match &passed.what {
        What::Impact(found) => found.mode.map(Mode::words),
        What::Motion(_) => None,
    }
}

/// Whether the supports and strings that act are those of the outcome that the solution tells, and friction does the same.
fn goes_so(impact: &Impact, passed: &Passed) -> bool {
    match &passed.what {
        What::Impact(found) if found.mode.map(Mode::words) != impact.mode.as_deref() => false,
        What::Impact(found) => found.is_by(&impact.active),
        What::Motion(_) => true,
    }
}

/// Where the solution takes another value of an answer to an earlier stage than is found.
fn earlier_differs(
    impact: &Impact,
    at: &Point<f64>,
    found: impl Fn(&Symbol) -> Option<f64>,
) -> Option<String> {
    impact.earlier.iter().find_map(|(name, told)| {
        let (value, found) = (told.evaluate(at)?, found(name)?);
        let apart = (value - found).abs() > CLOSE * value.abs().max(found.abs());
        apart.then(|| format!("`{name}` is {value} in the solution, {found} when followed"))
    })
}

/// Where the solution lets bodies be elsewhere or move otherwise than is found.
fn differs(impact: &Impact, at: &Point<f64>, found: &[BodyState], sizes: &Sizes) -> Option<String> {
    let (extent, speed) = (sizes.length.max(1e-12), sizes.speed.max(1e-12));
    for (body, state) in impact.scene.bodies.iter().zip(found) {
        if body.is_fixed() {
            continue;
        }
        let [x, y] = &state.center;
        let [u, v] = &state.velocity;
        let pairs = [
            ("is at x =", &body.center[0], x, extent),
            ("is at y =", &body.center[1], y, extent),
            ("moves with v_x =", &body.velocity[0], u, speed),
            ("moves with v_y =", &body.velocity[1], v, speed),
        ];
        let spin = ("turns with", &body.spin, &state.spin, speed / extent);
        let turns = (!body.is_particle()).then_some(spin);
        for (words, told, found, scale) in pairs.into_iter().chain(turns) {
            let value = told.substitute(&impact.handed).evaluate(at);
            let (Some(value), Ok(found)) = (value, found) else {
                continue;
            };
            if (value - found).abs() > CLOSE * scale {
                let name = &body.name;
                let found = format!("{value} in the solution, {found} when followed");
                return Some(format!("`{name}` {words} {found}"));
            }
        }
    }
    None
}
