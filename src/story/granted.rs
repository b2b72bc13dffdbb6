//! What a story takes for granted, in sentences: that impacts take no time, and what holds of each kind of motion.

use super::StageTold;
use crate::formula::{Sentence, listed, sentence};
use crate::scene::StageKind;

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
        let body = &told.placed.scene.bodies[turn.body];
        let about = &turn.about_name;
        let name = &body.name;
        let bodies = turn.bodies().into_iter();
        let bodies = bodies.map(|b| format!("`{}`", told.placed.scene.bodies[b].name));
        let rigid = match turn.with.is_empty() {
            true => format!("`{name}` is rigid"),
            false => listed(&bodies.collect::<Vec<_>>()) + " turn as one rigid body",
        };
        let holds = match body.is_particle() && turn.with.is_empty() {
            true => format!(" `{name}` keeps its distance from `{about}`, which does not move"),
            false => format!(" {rigid}, and `{about}` is frictionless and does not move"),
        };
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
