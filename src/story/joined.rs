//! What an impact has joined stays joined: bodies that stick to each other or are hinged together move on as such, and take the
//! next impact as such, unless the file says otherwise.

use super::Refused;
use crate::scene::{ContactLaw, Scene, Stage, StageKind};

const HINGED: &str = "is hinged to";

/// Two bodies that are joined, how, and since which stage.
struct Joint<'a> {
    bodies: [usize; 2],
    how: &'static str,
    since: &'a str,
}

/// The joints that are left of earlier impacts: those of the last one that acted on either body. What sticks to something fixed
/// only leans on it: it tips over, or is lifted off. A hinge on it holds until the body slides or flies.
fn joints<'a>(scene: &'a Scene, stage: &Stage) -> Vec<Joint<'a>> {
    let (mut out, mut later): (Vec<Joint>, Vec<[usize; 2]>) = (Vec::new(), Vec::new());
    let mut freed = Vec::new();
    let mut from = stage.from;
    while let Some(before) = from.map(|j| &scene.stages[j]) {
        let contacts = before.scene.contacts.iter();
        let sticking = contacts.filter(|c| matches!(c.law, ContactLaw::Sticking));
        let hinges = before.scene.hinges.iter();
        let joined = sticking.map(|c| (c.bodies, "sticks to"));
        let joined = joined.chain(hinges.map(|h| (h.bodies, HINGED)));
        let is_fixed = |b: &usize| before.scene.bodies[*b].is_fixed();
        let holds = |bodies: &[usize; 2], how: &str| match bodies.iter().any(is_fixed) {
            true => how == HINGED && !bodies.iter().any(|b| freed.contains(b)),
            false => true,
        };
        let joined = joined.filter(|(bodies, how)| holds(bodies, how));
        let is_open = |bodies: &[usize; 2]| !later.iter().flatten().any(|b| bodies.contains(b));
        let joined = joined.filter(|(bodies, _)| is_open(bodies));
        let since = before.name.as_str();
        out.extend(joined.map(|(bodies, how)| Joint { bodies, how, since }));
        later.extend(acting(before));
        if let StageKind::Fall(_) | StageKind::Slide(_) | StageKind::Wind(_) = before.kind {
            freed.extend(before.kind.moved());
        }
        from = before.from;
    }
    out
}

/// The bodies on which each impulse of an impact acts.
fn acting(stage: &Stage) -> Vec<[usize; 2]> {
    let StageKind::Impact { one_sided, .. } = &stage.kind else {
        return Vec::new();
    };
    let contacts = stage.scene.contacts.iter().map(|c| c.bodies);
    let hinges = stage.scene.hinges.iter().map(|h| h.bodies);
    let blows = stage.scene.blows.iter().map(|b| [b.body; 2]);
    let one_sided = one_sided.iter().map(|o| o.bodies);
    contacts
        .chain(hinges)
        .chain(blows)
        .chain(one_sided)
        .collect()
}

/// What is joined to a body moves along with it.
pub(super) fn left_behind(scene: &Scene, stage: &Stage) -> Result<(), Refused> {
    let moved = stage.kind.moved();
    for joint in joints(scene, stage) {
        let [a, b] = joint.bodies;
        let is_fixed = |b: usize| stage.scene.bodies[b].is_fixed();
        let (body, other) = match (moved.contains(&a), moved.contains(&b)) {
            (true, false) if !is_fixed(b) => (a, b),
            (false, true) if !is_fixed(a) => (b, a),
            _ => continue,
        };
        let [other, body] = [other, body].map(|b| &stage.scene.bodies[b].name);
        let why = format!(
            "`{other}` {} `{body}` since `{}`, and is not said to move along",
            joint.how, joint.since
        );
        let hint = format!("the motion takes it along with \"with\": [\"{other}\"]");
        return Err(Refused::new(&stage.name, why, hint));
    }
    Ok(())
}

/// What is joined to a body that an impulse acts on has its part of it.
pub(super) fn left_out(scene: &Scene, stage: &Stage) -> Result<(), Refused> {
    let acting = acting(stage);
    for Joint { bodies, how, since } in joints(scene, stage) {
        let [a, b] = bodies;
        let is_struck = acting.iter().any(|of| of.contains(&a) || of.contains(&b));
        let is_said = acting.iter().any(|of| of.contains(&a) && of.contains(&b));
        if is_said || !is_struck {
            continue;
        }
        let [a, b] = [a, b].map(|b| &stage.scene.bodies[b].name);
        let why = format!("`{b}` {how} `{a}` since `{since}`, and nothing is said of that here");
        let hint = match how {
            HINGED => {
                "repeat the hinge in this impact; one on a fixed body may stand at the top once for all"
            }
            _ => {
                "repeat the contact in this impact: sticking where it holds, without law where it comes loose"
            }
        };
        return Err(Refused::new(&stage.name, why, hint));
    }
    Ok(())
}
