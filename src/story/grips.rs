//! What a contact that sticks does while a body turns about it: it pushes, or it has to pull, as only what grips can.
//!
//! In: a rotation, told, and the stages before it. Out: the same with what is said of the contact that holds its fixed point.

use super::motion::pivot_force;
use super::motion::{arms, sense};
use super::{StageTold, line};
use crate::algebra::Sign;
use crate::answer::Known;
use crate::answer::calc::{Seen, beyond_zero, essential, is_zero, sign, tidy};
use crate::domain::Domains;
use crate::expr::{Expr, Vector, cross, minus};
use crate::formula::{Sentence, sentence};
use crate::scene::{OneSided, Stage, StageKind, Turn};

/// A contact that grips what turns about it, unless it only has to push.
#[derive(Clone, Debug, PartialEq)]
pub struct Grip {
    name: String,
    /// Has the sign of its push.
    push: Expr,
    /// At which end of the motion.
    when: &'static str,
    motion: String,
}

impl Grip {
    /// The same with values put in.
    pub(super) fn put(&self, with: &Known, domains: &Domains) -> Grip {
        let push = match with.keys().any(|name| self.push.mentions(name)) {
            true => essential(&self.push.substitute(with), domains),
            false => self.push.clone(),
        };
        Grip {
            push,
            ..self.clone()
        }
    }

    /// What is said of it; `None` where it is proved to push.
    pub(super) fn told(&self, domains: &Domains) -> Option<Sentence> {
        let Grip {
            name,
            push,
            when,
            motion,
        } = self;
        match sign(push, domains) {
            Seen::Proved(s) if s.is_not_negative() => None,
            seen if seen.is_negative() || seen == Seen::Proved(Sign::NotPositive) => {
                Some(sentence!(
                    "`{}` grips: it pulls at the {} of `{}`",
                    name,
                    *when,
                    motion
                ))
            }
            _ => Some(sentence!(
                "`{}` grips and can pull at the {} of `{}`, or {}",
                name,
                *when,
                motion,
                beyond_zero(push, domains, false)
            )),
        }
    }
}

/// A contact at the fixed point of a rotation.
struct Pivot {
    name: String,
    /// The direction in which it pushes the body, where the scene gives it.
    pushes: Option<Vector>,
}

/// Says of a rotation about a contact where that would have to pull. Without a normal it pushes where its force has a part
/// toward the center of mass.
pub(super) fn pulls(
    stage: &Stage,
    stages: &[StageTold],
    branch: Option<(usize, usize)>,
    mut told: StageTold,
) -> StageTold {
    let StageKind::Turn(turn) = &stage.kind else {
        return told;
    };
    let spin = &told.before.spin[turn.body];
    let (Some(pivot), Ok((way, _))) =
        (pivot(stage, stages, branch, turn), sense(stage, spin, turn))
    else {
        return told;
    };
    if told.before.why_open([spin]).is_some() || told.energy.is_none() {
        return told;
    }
    let [first, last] = arms(stage, turn, spin);
    let mut ends = match &pivot.pushes {
        // Where the body turns, the surface that it touches is another one.
        Some(normal) => vec![(normal, false, "beginning")],
        None => vec![(&first, false, "beginning"), (&last, true, "end")],
    };
    // The end of a rotation before it was looked at there.
    let before = branch.map(|(i, _)| &stages[i].placed.kind);
    if matches!(before, Some(StageKind::Turn(before)) if before.body == turn.body) {
        ends.remove(0);
    }
    let mut domains = stage.scene.domains.clone();
    let mut before: Option<Expr> = None;
    for (along, at_end, when) in ends {
        let push = pivot_force(&told, turn, way, along, at_end);
        let need = match tidy(&push, &domains) {
            Ok(push) => essential(&push, &domains),
            Err(_) => continue,
        };
        // Where it pushes by more than at the beginning, that says it all.
        let more = before
            .as_ref()
            .map(|before| sign(&(&need - before), &domains));
        if matches!(more, Some(Seen::Proved(s)) if s.is_not_negative()) {
            continue;
        }
        let grip = Grip {
            name: pivot.name.clone(),
            push: need.clone(),
            when,
            motion: stage.name.clone(),
        };
        let Some(words) = grip.told(&domains) else {
            continue;
        };
        told.assumptions.push(words);
        told.grips.push(grip);
        domains = domains.given(&need, true);
        before = Some(need);
    }
    told
}

/// The string on which a particle turns since the last impact in which one was taut along the line to its fixed point.
pub(super) fn string(
    stage: &Stage,
    stages: &[StageTold],
    branch: Option<(usize, usize)>,
    turn: &Turn,
) -> Option<String> {
    let mut bodies = turn.bodies().into_iter();
    if !bodies.all(|b| stage.scene.bodies[b].is_particle()) {
        return None;
    }
    let domains = &stage.scene.domains;
    let before = branch.into_iter().flat_map(|at| line(stages, at));
    before.into_iter().find_map(|(i, k)| {
        let case = stages[i].cases.get(k)?;
        let StageKind::Impact { one_sided, .. } = &stages[i].placed.kind else {
            return None;
        };
        let is_taut = |o: &&OneSided| {
            let line = minus(&turn.about, &case.after.center[turn.body]);
            o.is_string
                && o.bodies.contains(&turn.body)
                && (case.active.contains(&o.name) || case.idle.contains(&o.name))
                && is_zero(&cross(&o.normal, &line), domains) == Some(true)
        };
        one_sided.iter().find(is_taut).map(|o| o.name.clone())
    })
}

/// The contact that holds the fixed point of a rotation since the last impact there; `None` where a hinge or a string does.
fn pivot(
    stage: &Stage,
    stages: &[StageTold],
    branch: Option<(usize, usize)>,
    turn: &Turn,
) -> Option<Pivot> {
    let domains = &stage.scene.domains;
    let is_pivot = |at: &Vector| {
        let mut gap = minus(at, &turn.about).into_iter();
        gap.all(|c| is_zero(&c, domains) == Some(true))
    };
    let holds = |bodies: &[usize; 2], at: &Vector| bodies.contains(&turn.body) && is_pivot(at);
    for (i, k) in branch.into_iter().flat_map(|at| line(stages, at)) {
        let Some(case) = stages[i].cases.get(k) else {
            continue;
        };
        let scene = &case.scene;
        let mut hinges = scene.hinges.iter();
        if hinges.any(|h| holds(&h.bodies, &h.at)) {
            return None;
        }
        let mut contacts = scene.contacts.iter();
        if let Some(contact) = contacts.find(|c| holds(&c.bodies, &c.at)) {
            let into = contact.bodies[1] == turn.body;
            let normal = contact.normal.clone();
            return (!contact.is_string).then(|| Pivot {
                name: contact.name.clone(),
                pushes: match into {
                    true => normal,
                    false => normal.map(|n| n.map(|c: Expr| -c)),
                },
            });
        }
    }
    None
}
