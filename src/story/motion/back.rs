//! Whether a body comes back to one that it has hit before: at the end of a motion to a fixed body, or in an impact at the same
//! instant to any.
//!
//! In: a motion, told, and the stages before it. Out: the same with what it needs so that the body ends on its own side of
//! every fixed body it has hit. Of round bodies and particles alone: the distance of any other from a plane depends on how
//! it is turned. Where it moved along the normal it is back at the very place it hit; where it moved sideways too, the fixed
//! body may have ended before, which is said.

use crate::answer::calc::{Seen, above_zero, at_least_zero, is_zero, sign, tidy};
use crate::expr::{Expr, Vector, dot, minus};
use crate::formula::{Sentence, sentence};
use crate::scene::{Contact, ContactLaw, Scene, Stage, StageKind};
use crate::story::{StageTold, line};

/// Adds to a motion what it needs so that it does not end behind what its bodies have hit.
pub(in crate::story) fn stays_in_front(
    stage: &Stage,
    stages: &[StageTold],
    branch: Option<(usize, usize)>,
    mut told: StageTold,
) -> StageTold {
    let ways = || branch.into_iter().flat_map(|at| line(stages, at));
    // What the motions before it need is told with them.
    let mut stage = stage.clone();
    let before = ways().flat_map(|(i, _)| &stages[i].needs);
    for need in before.chain(&told.needs) {
        stage.scene.domains = stage.scene.domains.given(need, false);
    }
    let domains = &stage.scene.domains;
    for (i, k) in ways() {
        let Some(case) = stages[i].cases.get(k) else {
            continue;
        };
        for contact in &case.scene.contacts {
            let Some((wall, body, normal)) = hit(&case.scene, contact) else {
                continue;
            };
            if !stage.kind.moved().contains(&body)
                || told.after.why_open(&told.after.center[body]).is_some()
            {
                continue;
            }
            let moved = minus(&told.after.center[body], &case.after.center[body]);
            let off = dot(&moved, &normal);
            let sideways = &(&moved[0] * &normal[1]) - &(&moved[1] * &normal[0]);
            let Ok(off) = tidy(&off, domains) else {
                continue;
            };
            // Where it is behind in any case, the second way finds them passing through each other.
            if matches!(sign(&off, domains), Seen::Proved(_) | Seen::Negative) {
                continue;
            }
            let [wall, name] = [wall, body].map(|b| &stage.scene.bodies[b].name);
            let at = &contact.name;
            told.assumptions.push(match is_zero(&sideways, domains) {
                Some(true) => {
                    let need = at_least_zero(&off, domains);
                    told.needs.push(off);
                    let words = "{}, so that `{}` is not back at `{}` by the end of `{}`";
                    Sentence::filled(words, [need, name.into(), at.into(), (&stage.name).into()])
                }
                _ => {
                    let behind = at_least_zero(&-&off, domains);
                    let words =
                        "`{}` ends before `{}` passes its tangent at `{}`, which it does where {}";
                    Sentence::filled(words, [wall.into(), name.into(), at.into(), behind])
                }
            });
        }
    }
    told
}

/// Says of an impact that nothing follows at once where it drives a body into one that was hit at the same instant: what comes
/// out of that further impact is not told.
pub(in crate::story) fn meets_again(
    scene: &Scene,
    stage: &Stage,
    stages: &[StageTold],
    branch: Option<(usize, usize)>,
    mut told: StageTold,
) -> StageTold {
    let is_impact = |stage: &Stage| matches!(stage.kind, StageKind::Impact { .. });
    let is_mine = |from: usize| scene.stages[from].name == stage.name;
    let is_next = |s: &Stage| is_impact(s) && s.from.is_some_and(is_mine);
    let [case] = told.cases.as_slice() else {
        return told;
    };
    if scene.stages.iter().any(is_next) {
        return told;
    }
    let mut after = stage.scene.clone();
    let motion = case.after.velocity.iter().zip(&case.after.spin);
    for (body, (v, w)) in after.bodies.iter_mut().zip(motion) {
        body.velocity.clone_from(v);
        body.spin.clone_from(w);
    }
    let domains = (case.conditions.iter()).fold(stage.scene.domains.clone(), |domains, (_, e)| {
        domains.given(e, false)
    });
    let before = branch.into_iter().flat_map(|at| line(stages, at));
    let before = before.take_while(|(i, _)| is_impact(&stages[*i].placed));
    let touched = before.flat_map(|(i, k)| &stages[i].cases[k].scene.contacts);
    let is_hit_now = |c: &Contact| {
        let is_none = |e: &Expr| is_zero(e, &domains) == Some(true);
        let is_here = |now: &Contact| minus(&now.at, &c.at).iter().all(is_none);
        let mut all = stage.scene.contacts.iter();
        all.any(|now| now.bodies == c.bodies && is_here(now))
    };
    for contact in touched.filter(|c| pushes(c) && !is_hit_now(c)) {
        let Some(normal) = &contact.normal else {
            continue;
        };
        let opening = dot(&contact.relative_velocity(&after), normal);
        let Ok(opening) = tidy(&opening, &domains) else {
            continue;
        };
        if case.after.why_open([&opening]).is_some() {
            continue;
        }
        let [first, second] = contact.bodies.map(|b| &stage.scene.bodies[b].name);
        let words = sentence!(
            "`{}` and `{}`, which met at `{}` at the same instant, do not collide there again",
            first,
            second,
            &contact.name
        );
        told.assumptions.push(match sign(&opening, &domains) {
            Seen::Proved(s) if s.is_not_negative() => continue,
            seen if seen.is_negative() => sentence!("{}, though they approach", words),
            _ => {
                let approach = above_zero(&-&opening, &domains);
                sentence!("{}, though they approach where {}", words, approach)
            }
        });
    }
    told
}

/// Whether bodies that touch push each other apart.
fn pushes(contact: &Contact) -> bool {
    !contact.passes && !matches!(contact.law, ContactLaw::None | ContactLaw::Sticking)
}

/// The fixed body at rest that a round body or a particle hits at a contact that pushes, that body, and the normal towards it.
fn hit(scene: &Scene, contact: &Contact) -> Option<(usize, usize, Vector)> {
    let [first, second] = contact.bodies;
    let normal = contact.normal.clone().filter(|_| pushes(contact))?;
    let (wall, body, normal) = match scene.bodies[first].is_fixed() {
        true => (first, second, normal),
        false => (second, first, normal.map(|e| -&e)),
    };
    let [fixed, moving] = [wall, body].map(|b| &scene.bodies[b]);
    let rests = fixed
        .velocity
        .iter()
        .chain([&fixed.spin])
        .all(Expr::is_zero);
    let is_round = moving.is_particle() || moving.shape.radius().is_some();
    (fixed.is_fixed() && rests && is_round && !moving.is_fixed()).then_some((wall, body, normal))
}
