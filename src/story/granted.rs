//! What a story takes for granted, in sentences: that impacts take no time, and what holds of each kind of motion.

use super::StageTold;
use super::words::carried;
use crate::answer::calc::is_zero;
use crate::expr::{Expr, minus};
use crate::formula::{Sentence, listed, sentence};
use crate::scene::{Ask, OneSided, Scene, StageKind, Turn};

/// What is told of impacts.
pub(crate) const NO_TIME: &str =
    "no time: nothing moves while velocities jump, and finite forces have no impulse";

/// Everything the story takes for granted.
pub(super) fn assumed(readings: &[String], stages: &[StageTold]) -> Vec<Sentence> {
    let mut out: Vec<Sentence> = readings.iter().map(Sentence::from).collect();
    let named = |is: fn(&StageKind) -> bool| {
        let mut names: Vec<String> = Vec::new();
        let has_name = |s: &&StageTold| !s.placed.name.is_empty();
        for told in stages
            .iter()
            .filter(|s| is(&s.placed.kind))
            .filter(has_name)
        {
            let name = format!("`{}`", told.placed.name);
            if !names.contains(&name) {
                names.push(name);
            }
        }
        names
    };
    let impacts = named(|kind| matches!(kind, StageKind::Impact { .. }));
    if !impacts.is_empty() {
        let takes = if impacts.len() == 1 { "takes" } else { "take" };
        out.push(sentence!("{} {} {}", listed(&impacts), takes, NO_TIME));
    }
    let falls = named(|kind| matches!(kind, StageKind::Fall(_)));
    if !falls.is_empty() {
        out.push(sentence!("in {} there is no drag", listed(&falls)));
    }
    let strung = named(|kind| matches!(kind, StageKind::Slide(s) if !s.strings.is_empty()));
    if !strung.is_empty() {
        out.push(sentence!("in {} strings have no mass, keep their length and do not slip on their pulleys, whose axles are frictionless", listed(&strung)));
    }
    let linked = named(|kind| matches!(kind, StageKind::Linkage(_)));
    if !linked.is_empty() {
        out.push(sentence!("in {} joints and guides hold the bodies all the way, pulling where need be, and are frictionless", listed(&linked)));
    }
    // Rotations about one point are told together.
    let mut turns: Vec<(String, Vec<String>)> = Vec::new();
    for told in stages {
        let StageKind::Turn(turn) = &told.placed.kind else {
            continue;
        };
        let holds = in_a_turn(stages, told, turn);
        let name = format!("`{}`", told.placed.name);
        match turns.iter_mut().find(|(h, _)| *h == holds) {
            Some((_, names)) if names.contains(&name) => {}
            Some((_, names)) => names.push(name),
            None => turns.push((holds, vec![name])),
        }
    }
    let turns = turns.into_iter();
    out.extend(turns.map(|(holds, names)| sentence!("in {}{}", listed(&names), holds)));
    out.extend(stages.iter().flat_map(|told| told.assumptions.clone()));
    let mut seen: Vec<Sentence> = Vec::new();
    out.retain(|s| {
        !seen.contains(s) && {
            seen.push(s.clone());
            true
        }
    });
    out
}

/// Which point of a body is asked about where the body has turned since: a step from a body is one along the axes at any time,
/// and what lay there at the beginning has turned with the body.
pub(super) fn points_carried(scene: &Scene, told: &StageTold) -> Vec<Sentence> {
    // A stage that begins as the file says has no symbols for the places of bodies.
    let Some(stage) = scene.stages.iter().find(|s| !s.places.is_empty()) else {
        return Vec::new();
    };
    let by_now = told.after.places(stage);
    let placed = &told.placed.scene;
    let mut out = Vec::new();
    for question in &placed.questions {
        let Ask::Velocity {
            body,
            point: Some((name, at)),
            ..
        } = &question.ask
        else {
            continue;
        };
        let Some(point) = stage.scene.points.iter().find(|p| p.name == *name) else {
            continue;
        };
        let is_step = |e: &Expr| stage.places.iter().flatten().any(|s| e.mentions(s));
        if !point.at.iter().any(is_step) {
            continue;
        }
        let is_impact = matches!(told.placed.kind, StageKind::Impact { .. });
        let arm = match is_impact {
            true => minus(at, &placed.bodies[*body].center),
            false => told.after.carried(scene, *body, name),
        };
        let step = minus(
            &point.at.each_ref().map(|e| e.substitute(&by_now)),
            &told.after.center[*body],
        );
        let stays = |e: &Expr| is_zero(e, &placed.domains) == Some(true);
        if !minus(&arm, &step).iter().all(stays) {
            let body = &placed.bodies[*body].name;
            out.push(sentence!(
                "`{}` is the point of `{}` that lay there at the beginning, and has turned with it",
                name,
                body
            ));
        }
    }
    out
}

/// What holds of the bodies of a rotation.
fn in_a_turn(stages: &[StageTold], told: &StageTold, turn: &Turn) -> String {
    let about = &turn.about_name;
    let each = carried(told, turn).into_iter();
    let each: Vec<_> = each.map(|b| &told.placed.scene.bodies[b]).collect();
    let names: Vec<String> = each.iter().map(|body| format!("`{}`", body.name)).collect();
    let all = listed(&names);
    let holds = match (each.iter().all(|body| body.is_particle()), names.len()) {
        (true, 1) => format!(" {all} keeps its distance from `{about}`, which does not move"),
        (true, _) => format!(" {all} keep their distance from `{about}`, which does not move"),
        (false, 1) => {
            format!(" {all} is rigid, and `{about}` is frictionless and does not move")
        }
        (false, _) => format!(
            " {all} turn as one rigid body, and `{about}` is frictionless and does not move"
        ),
    };
    let strings = stages.iter().filter_map(|told| match &told.placed.kind {
        StageKind::Impact { one_sided, .. } => Some(one_sided),
        _ => None,
    });
    let holds_one =
        |o: &OneSided| o.is_string && o.bodies.iter().any(|b| turn.bodies().contains(b));
    match strings.flatten().any(holds_one) {
        true => holds + ", and the string stays taut all the way",
        false => holds,
    }
}
