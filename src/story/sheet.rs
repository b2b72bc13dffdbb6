//! A told scene as one scene and one derivation, for those who grade, verify and draw: all answers, and the first impact.
//!
//! In: a scene as it was told. Out: the scene of an impact with the motion handed on put in, and its derivation with
//! the answers of the whole story in place of its own. Nothing is derived here.

use super::{Case, StageTold, Told, line, worlds};
use crate::answer::calc::sign;
use crate::answer::{Answer, Form};
use crate::derive::{self, Derivation, Moment, Stop};
use crate::expr::{Expr, cross, minus};
use crate::scene::{Ask, ContactLaw, Question, Scene, StageKind};

/// The scene of an impact, by name of its stage; the first one for `None`. `None` where there is no such impact. Of several
/// cases it is the first, kept to where that holds.
pub fn impact(scene: &Scene, told: &Told, stage: Option<&str>) -> Option<Scene> {
    let found = told
        .stages
        .iter()
        .find(|s| stage.map_or(!s.cases.is_empty(), |name| s.placed.name == name))?;
    let case = found.cases.first()?;
    let mut out = put_together(scene, case);
    for (_, least) in &case.conditions {
        out.domains = out.domains.given(least, false);
    }
    Some(out)
}

/// The outcomes of all impacts: the name of the stage, with a number where it has several, and the outcome.
pub fn outcomes(told: &Told) -> impl Iterator<Item = (String, &Case)> {
    told.stages.iter().flat_map(|stage| {
        let several = stage.cases.len() > 1;
        stage.cases.iter().enumerate().map(move |(k, case)| {
            let name = match several {
                true => format!("{}, case {}", stage.name, k + 1),
                false => stage.name.clone(),
            };
            (name, case)
        })
    })
}

/// The scenes of all impacts with their own questions: name of the stage, and the scene with the motion handed on put in.
pub fn impacts(scene: &Scene, told: &Told) -> Vec<(String, Scene)> {
    let put = |(name, case): (String, &Case)| {
        let mut one = put_together(scene, case);
        one.printed.clear();
        one.questions = case.asked(&[]).0.questions;
        (name, one)
    };
    outcomes(told).map(put).collect()
}

/// The scene at the beginning of a stage, by index: the bodies where they are, in the motion they have, where the motions
/// before it go as told.
pub fn beginning(told: &Told, stage: usize) -> Scene {
    let stages = &told.stages;
    let mut out = stages[stage].placed.scene.clone();
    for (b, body) in out.bodies.iter_mut().enumerate() {
        if !body.is_fixed() {
            body.velocity.clone_from(&stages[stage].before.velocity[b]);
            body.spin.clone_from(&stages[stage].before.spin[b]);
        }
    }
    for (i, _) in line(stages, (stage, 0)) {
        for need in stages[i].rests_on() {
            out.domains = out.domains.given(need, false);
        }
    }
    out
}

/// Whether a rotation, or a rope that winds up, goes clockwise.
pub fn is_clockwise(told: &StageTold) -> bool {
    let stage = &told.placed;
    match &stage.kind {
        StageKind::Turn(turn) => {
            let way = super::motion::sense(stage, &told.before.spin[turn.body], turn);
            way.is_ok_and(|(way, _)| way < 0)
        }
        StageKind::Wind(wind) => {
            let arm = minus(&stage.scene.bodies[wind.body].center, &wind.around);
            let turning = cross(&arm, &told.before.velocity[wind.body]);
            sign(&turning, &stage.scene.domains).is_negative()
        }
        _ => false,
    }
}

/// The motion just after each impact, in each of its cases. What comes in is none of them: that a velocity stays as it was would
/// hold there.
pub fn moments(told: &Told) -> Vec<Moment> {
    let cases = told.stages.iter().flat_map(|stage| {
        let several = stage.cases.len() > 1;
        stage.cases.iter().enumerate().map(move |(k, case)| {
            let motion = case.derivation.motion_by_name();
            let motion = motion.map(|(_, name, value)| (name, case.put_in(&value)));
            let which = several.then(|| match case.rubs.as_str() {
                "" => format!(", case {}", k + 1),
                rubs => format!(", where {rubs}"),
            });
            let when = format!("just after `{}`{}", stage.name, which.unwrap_or_default());
            (when, motion.collect())
        })
    });
    cases.collect()
}

/// The scene at the end of each motion, by name of its stage: the bodies, and the points on them that questions are about, are
/// where they are then and move as they do.
pub fn ends(scene: &Scene, told: &Told) -> Vec<(String, Scene)> {
    let on_bodies = scene.questions.iter().filter_map(|q| match &q.ask {
        Ask::Velocity { body, point, .. } => Some((*body, point.as_ref()?.0.as_str())),
        Ask::PointAcceleration { body, point, .. } => Some((*body, point.as_deref()?)),
        _ => None,
    });
    let on_bodies: Vec<(usize, &str)> = on_bodies.collect();
    let motions = told.stages.iter().filter(|stage| stage.cases.is_empty());
    let each = motions.map(|stage| {
        let (mut out, after) = (stage.placed.scene.clone(), &stage.after);
        out.questions.clear();
        let bodies = out.bodies.iter_mut().enumerate();
        for (b, body) in bodies.filter(|(_, body)| !body.is_fixed()) {
            body.center.clone_from(&after.center[b]);
            body.angle.clone_from(&after.angle[b]);
            body.velocity.clone_from(&after.velocity[b]);
            body.spin.clone_from(&after.spin[b]);
        }
        for (b, name) in &on_bodies {
            let arm = after.carried(scene, *b, name);
            if let Some(point) = out.points.iter_mut().find(|p| p.name == *name) {
                point.at = [0, 1].map(|axis| &after.center[*b][axis] + &arm[axis]);
            }
        }
        (stage.name.clone(), out)
    });
    each.collect()
}

/// One of the ways a told scene can go, as one scene and one derivation.
pub struct Way {
    /// What must be ≥ 0 for it; empty where there is no other way.
    pub given: Vec<Expr>,
    /// The scene of its first impact, on the part of the domain where it goes this way.
    pub scene: Scene,
    /// The derivation of that impact with the answers of this way.
    pub derivation: Derivation,
}

/// What was told as one scene and one derivation, for each way the scene can go.
pub fn ways(scene: &Scene, told: &Told) -> Result<Vec<Way>, Stop> {
    let worlds = worlds::of(&told.stages);
    let mut out = Vec::new();
    for (w, world) in worlds.iter().enumerate() {
        let mut impacts = world.outcome.iter().map(|(i, k)| (&told.stages[*i], *k));
        let first = impacts.find_map(|(stage, k)| Some((stage, stage.cases.get(k)?)));
        let answers = worlds::answers(&worlds, w, &told.answers);
        let (flat, derivation) = flat(scene, told, first, &answers)?;
        out.push(Way {
            given: world.given.iter().map(|(_, e)| e.clone()).collect(),
            scene: world.part_of(&flat),
            derivation,
        });
    }
    Ok(out)
}

/// What was told as one scene and one derivation; where the scene can go several ways, the one told first.
pub fn sheet(scene: &Scene, told: &Told) -> Result<(Scene, Derivation), Stop> {
    let first = told.stages.iter().find(|s| !s.cases.is_empty());
    let first = first.and_then(|stage| Some((stage, stage.cases.first()?)));
    flat(scene, told, first, &told.answers)
}

/// One scene and one derivation, with the outcome of the first impact and the answers that go with it.
fn flat(
    scene: &Scene,
    told: &Told,
    first: Option<(&StageTold, &Case)>,
    answers: &[Answer],
) -> Result<(Scene, Derivation), Stop> {
    let (mut flat, mut derivation) = match first {
        Some((_, case)) => (put_together(scene, case), case.derivation.clone()),
        None => {
            let mut bare = scene.clone();
            bare.stages.clear();
            let derivation = derive::derive(&bare)?;
            (bare, derivation)
        }
    };
    if let Some((_, case)) = first {
        for value in derivation.motion.values_mut() {
            *value = case.put_in(value);
        }
    }
    let own = |q: &Question| {
        let mut all = first?.0.placed.scene.questions.iter();
        all.find(|own| own.name == q.name).cloned()
    };
    let asked = scene.questions.iter();
    flat.questions = asked.map(|q| own(q).unwrap_or_else(|| q.clone())).collect();
    if told.alone().is_none() {
        derivation.definitions.clear();
    }
    derivation.answers = answers.iter().filter(is_flat).cloned().collect();
    Ok((flat, derivation))
}

/// Whether an answer with a formula has the name of its question; further outcomes and places of maxima have names of their
/// own.
fn is_flat(a: &&Answer) -> bool {
    let has_form = !matches!(a.form, Form::Words);
    let is_whole = ["", "_x", "_y"]
        .iter()
        .any(|suffix| a.name == format!("{}{suffix}", a.question));
    has_form && is_whole
}

/// The scene of an outcome, with what was handed on put in.
fn put_together(scene: &Scene, case: &Case) -> Scene {
    let mut out = case.scene.clone();
    out.statement = scene.statement.clone();
    out.printed = scene.printed.clone();
    out.domains = scene.domains.clone();
    out.questions.retain(|q| !q.hidden);
    out.parameters
        .retain(|p| !case.handed.contains_key(&p.name));
    // A value may have been given since the stages were read.
    for p in &mut out.parameters {
        if let Some(given) = scene.parameters.iter().find(|g| g.name == p.name) {
            p.value.clone_from(&given.value);
        }
    }
    let put = |e: &mut Expr| *e = case.put_in(e);
    for body in &mut out.bodies {
        put(&mut body.spin);
        body.velocity.iter_mut().for_each(put);
    }
    for contact in &mut out.contacts {
        if let ContactLaw::Decided(decided) = &mut contact.law {
            let numbers = decided.conditions.iter_mut().flat_map(|c| c.numbers_mut());
            numbers.for_each(put);
        }
    }
    out
}
