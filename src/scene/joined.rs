//! What an impact has joined stays joined: bodies that stick to each other or are hinged together move on as such, and take the
//! next impact as such, unless the file says otherwise. A particle that has stuck is rigidly fixed where it is, so later stages
//! that do not speak of it keep it there and take it along; of larger bodies, which stick at a point, the file has to tell, but
//! where they slide.

use super::{Ask, Contact, ContactLaw, ImpulseAt, Scene, Stage, StageKind};
use crate::expr::Vector;

/// What holds a hinge.
pub const HINGED: &str = "is hinged to";

/// What holds a body that turns with another, and the name of the contact that keeps it there.
const FIXED: [&str; 2] = ["is fixed to", "K"];

/// Two bodies that are joined, how, and since which stage.
pub struct Joint<'a> {
    /// Indices of the bodies.
    pub bodies: [usize; 2],
    /// In words, between the second and the first.
    pub how: &'static str,
    /// Name of the contact or hinge.
    pub name: &'a str,
    /// Where it is as the stage begins that joins them; of what turns with another there is no one place.
    pub at: Option<&'a Vector>,
    /// Name of the stage.
    pub since: &'a str,
}

/// The joints that are left of earlier impacts: those of the last one that acted on either body. What sticks to something fixed
/// only leans on it: it tips over, or is lifted off. A hinge on it holds until the body slides or flies.
pub fn joints<'a>(stages: &'a [Stage], stage: &Stage) -> Vec<Joint<'a>> {
    let (mut out, mut later): (Vec<Joint>, Vec<[usize; 2]>) = (Vec::new(), Vec::new());
    let mut freed = Vec::new();
    let (mut fixed, mut moved): (Vec<Joint>, Vec<usize>) = (Vec::new(), Vec::new());
    let mut from = stage.from;
    while let Some(before) = from.map(|j| &stages[j]) {
        let contacts = before.scene.contacts.iter();
        let sticking = contacts.filter(|c| matches!(c.law, ContactLaw::Sticking));
        let hinges = before.scene.hinges.iter();
        let joined = sticking.map(|c| (c.bodies, "sticks to", c.name.as_str(), &c.at));
        let joined = joined.chain(hinges.map(|h| (h.bodies, HINGED, h.name.as_str(), &h.at)));
        let is_fixed = |b: &usize| before.scene.bodies[*b].is_fixed();
        let holds = |bodies: &[usize; 2], how: &str| match bodies.iter().any(is_fixed) {
            true => how == HINGED && !bodies.iter().any(|b| freed.contains(b)),
            false => true,
        };
        let joined = joined.filter(|(bodies, how, ..)| holds(bodies, how));
        let is_open = |bodies: &[usize; 2]| !later.iter().flatten().any(|b| bodies.contains(b));
        let joined = joined.filter(|(bodies, ..)| is_open(bodies));
        let since = before.name.as_str();
        out.extend(joined.map(|(bodies, how, name, at)| Joint {
            bodies,
            how,
            name,
            at: Some(at),
            since,
        }));
        // What turned as one in the last motion of both is one in an impact, as far as no impact since has acted on it.
        if let (StageKind::Impact { .. }, StageKind::Turn(turn)) = (&stage.kind, &before.kind) {
            let pairs = turn.with.iter().map(|b| [turn.body, *b]);
            let pairs =
                pairs.filter(|pair| is_open(pair) && !pair.iter().any(|b| moved.contains(b)));
            fixed.extend(pairs.map(|bodies| Joint {
                bodies,
                how: FIXED[0],
                name: FIXED[1],
                at: None,
                since,
            }));
        }
        moved.extend(before.kind.moved());
        later.extend(acting(before));
        if let StageKind::Fall(_) | StageKind::Slide(_) | StageKind::Wind(_) = before.kind {
            freed.extend(before.kind.moved());
        }
        from = before.from;
    }
    // What has stuck in an impact is told by that.
    fixed.retain(|f| {
        !out.iter()
            .any(|j| f.bodies.iter().all(|b| j.bodies.contains(b)))
    });
    out.extend(fixed);
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

/// The joints with a part in an impact that says nothing of them: an impulse acts on one of their bodies.
pub fn unsaid<'a>(stages: &'a [Stage], stage: &Stage) -> Vec<Joint<'a>> {
    let acting = acting(stage);
    let mut out = joints(stages, stage);
    out.retain(|joint| {
        let [a, b] = joint.bodies;
        let is_struck = acting.iter().any(|of| of.contains(&a) || of.contains(&b));
        let is_said = acting.iter().any(|of| of.contains(&a) && of.contains(&b));
        is_struck && !is_said
    });
    out
}

/// Keeps particles where they stick, in every impact and every motion that does not speak of them; the scene tells that it is read so.
pub(super) fn keep(scene: &mut Scene) {
    for i in 0..scene.stages.len() {
        // What is kept may strike, or take along, what sticks to it.
        while let Some((keep, bodies)) = kept(&scene.stages, &scene.stages[i]) {
            let names = bodies.map(|b| scene.bodies[b].name.clone());
            match keep {
                Keep::Fixed(contact) => {
                    let [a, b] = names;
                    let at = &contact.name;
                    let reading =
                        format!("`{b}`, which turns with `{a}`, stays fixed to it at `{at}`");
                    told(scene, reading);
                    hold(&mut scene.stages[i], contact);
                    continue;
                }
                Keep::Holding(contact) => hold(&mut scene.stages[i], contact),
                Keep::Moving { of, too } => match scene.stages[i].kind.company_of(of) {
                    Some(company) => company.push(too),
                    None => break,
                },
            }
            stays(scene, &names);
        }
    }
}

/// Gives an impact one more contact. Its supports and strings count after its contacts where an impulse is asked for, so that
/// what asks for theirs counts one further.
fn hold(stage: &mut Stage, contact: Contact) {
    let behind = stage.scene.contacts.len();
    for question in &mut stage.scene.questions {
        if let Ask::Impulse {
            from: ImpulseAt::Contact(i),
            ..
        } = &mut question.ask
        {
            *i += usize::from(*i >= behind);
        }
    }
    stage.scene.contacts.push(contact);
}

/// The scene tells that what has stuck stays stuck.
pub(super) fn stays(scene: &mut Scene, [a, b]: &[String; 2]) {
    told(
        scene,
        format!("once `{b}` has stuck to `{a}`, it stays stuck"),
    );
}

fn told(scene: &mut Scene, reading: String) {
    if !scene.readings.contains(&reading) {
        scene.readings.push(reading);
    }
}

/// The two, by name, that stick at a contact of this name after a stage, one of them a particle.
pub(super) fn sticking_at(scene: &Scene, from: Option<usize>, name: &str) -> Option<[String; 2]> {
    let stage = Stage {
        from,
        ..Stage::default()
    };
    let mut joints = joints(&scene.stages, &stage).into_iter();
    let is_small = |b: &usize| scene.bodies[*b].is_particle();
    let joint =
        joints.find(|j| j.name == name && j.how != HINGED && j.bodies.iter().any(is_small))?;
    Some(joint.bodies.map(|b| scene.bodies[b].name.clone()))
}

/// Notes with each flight which of its bodies are joined by then.
pub(super) fn note(scene: &mut Scene) {
    for i in 0..scene.stages.len() {
        let moved = scene.stages[i].kind.moved();
        let joints = joints(&scene.stages, &scene.stages[i]).into_iter();
        let flying = joints.map(|joint| joint.bodies);
        let flying = flying.filter(|pair| pair.iter().all(|b| moved.contains(b)));
        let stuck = flying.collect();
        if let StageKind::Fall(fall) = &mut scene.stages[i].kind {
            fall.stuck = stuck;
        }
    }
}

/// How a stage keeps a particle where it sticks.
enum Keep {
    /// An impact has this contact too.
    Holding(Contact),
    /// The same of a particle that turned with a body.
    Fixed(Contact),
    /// A motion takes a body along with another one of its own.
    Moving { of: usize, too: usize },
}

/// A particle that sticks to something since before this stage, which does not speak of it: how it is kept there, and the two.
fn kept(stages: &[Stage], stage: &Stage) -> Option<(Keep, [usize; 2])> {
    let bodies = &stage.scene.bodies;
    let is_impact = matches!(stage.kind, StageKind::Impact { .. });
    let slides = matches!(stage.kind, StageKind::Slide(_));
    let found = match is_impact {
        true => unsaid(stages, stage),
        false => joints(stages, stage),
    };
    let mut found = found.into_iter().filter(|joint| joint.how != HINGED);
    found.find_map(|joint| {
        let mut both = joint.bodies.into_iter();
        let particle = both.find(|b| bodies[*b].is_particle());
        let keep = match particle {
            Some(at) if is_impact => {
                let contact = Contact {
                    name: free_name(stage, joint.name),
                    bodies: joint.bodies,
                    at: bodies[at].center.clone(),
                    normal: None,
                    law: ContactLaw::Sticking,
                    passes: false,
                    is_string: false,
                };
                match joint.how == FIXED[0] {
                    true => Keep::Fixed(contact),
                    false => Keep::Holding(contact),
                }
            }
            // What slides does not turn, and what sticks to it goes where it goes.
            _ if slides || particle.is_some() => {
                let [of, too] = left_behind(stage, &joint)?;
                Keep::Moving { of, too }
            }
            _ => return None,
        };
        Some((keep, joint.bodies))
    })
}

/// Of two joined bodies the one that a motion moves, and the other one, if that is not said to move.
pub fn left_behind(stage: &Stage, joint: &Joint<'_>) -> Option<[usize; 2]> {
    let [a, b] = joint.bodies;
    let moved = stage.kind.moved();
    let (of, too) = match (moved.contains(&a), moved.contains(&b)) {
        (true, false) => (a, b),
        (false, true) => (b, a),
        _ => return None,
    };
    (!stage.scene.bodies[too].is_fixed()).then_some([of, too])
}

/// The name of the contact, or a letter if the impact has given it to something else.
fn free_name(stage: &Stage, name: &str) -> String {
    let Scene {
        contacts,
        hinges,
        blows,
        bodies,
        points,
        ..
    } = &stage.scene;
    let acting = contacts.iter().map(|c| &c.name);
    let acting = acting.chain(hinges.iter().map(|h| &h.name));
    let mut taken: Vec<&String> = acting.chain(blows.iter().map(|b| &b.name)).collect();
    if let StageKind::Impact { one_sided, .. } = &stage.kind {
        taken.extend(one_sided.iter().map(|o| &o.name));
    }
    if taken.iter().all(|t| *t != name) {
        return name.to_owned();
    }
    taken.extend(bodies.iter().map(|b| &b.name));
    taken.extend(points.iter().map(|p| &p.name));
    let mut letters = ["K", "L", "N", "Q", "S", "U", "Z"].into_iter();
    let free = letters.find(|letter| taken.iter().all(|t| t != letter));
    free.map_or_else(|| format!("K_{}", taken.len()), String::from)
}
