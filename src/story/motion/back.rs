//! Whether a body comes back to one that it has hit before: at the end of a motion to a fixed body, or in an impact at the same
//! instant to any.
//!
//! In: a motion, told, and the stages before it. Out: the same with what it needs so that the body ends on its own side of
//! every fixed body it has hit. Of round bodies and particles alone: the distance of any other from a plane depends on how
//! it is turned. Where it moved along the normal it is back at the very place it hit; where it moved sideways too, the fixed
//! body may have ended before, which is said.

use crate::answer::calc::{Seen, above_zero, at_least_zero, is_zero, sign, tidy};
use crate::expr::{Expr, Vector, cross, dot, minus};
use crate::formula::{Sentence, sentence, write_plain};
use crate::scene::{Contact, ContactLaw, Scene, Stage, StageKind};
use crate::story::{Refused, StageTold, State, line};

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
            let Some((wall, body, normal)) = wall_of(&case.scene, contact) else {
                continue;
            };
            let of = &case.scene.bodies[body];
            if !of.is_particle() && of.shape.radius().is_none() {
                told.assumptions.extend(unseen(&stage, &told, [wall, body]));
                continue;
            }
            let places = [wall, body].map(|b| &told.after.center[b]);
            if !stage.kind.moved().contains(&body)
                || told.after.why_open(places.into_iter().flatten()).is_some()
            {
                continue;
            }
            let gone = |state: &State| {
                let [body, wall] =
                    [body, wall].map(|b| minus(&state.center[b], &case.after.center[b]));
                minus(&body, &wall)
            };
            let moved = gone(&told.after);
            let off = dot(&moved, &normal);
            let sideways = &(&moved[0] * &normal[1]) - &(&moved[1] * &normal[0]);
            let Ok(off) = tidy(&off, domains) else {
                continue;
            };
            let seen = sign(&off, domains);
            let straight = is_zero(&sideways, domains) == Some(true);
            // Where it is straight behind in any case, the second way finds them passing through each other.
            let was_behind = || sign(&dot(&gone(&told.before), &normal), domains).is_negative();
            if seen.is_not_negative() || seen.is_negative() && (straight || was_behind()) {
                continue;
            }
            let [wall, name] = [wall, body].map(|b| &stage.scene.bodies[b].name);
            let at = &contact.name;
            told.assumptions.push(match straight {
                true => {
                    let need = at_least_zero(&off, domains);
                    told.needs.push(off);
                    let words = "{}, so that `{}` is not back at `{}` by the end of `{}`";
                    Sentence::filled(words, [need, name.into(), at.into(), (&stage.name).into()])
                }
                false if seen.is_negative() => sentence!(
                    "`{}` ends before `{}` passes its tangent at `{}`",
                    wall,
                    name,
                    at
                ),
                false => {
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

/// That a body which turns in flight is not held against a wall it has hit: its outline comes nearer than its center.
fn unseen(stage: &Stage, told: &StageTold, [wall, body]: [usize; 2]) -> Option<Sentence> {
    let turns = is_zero(&told.before.spin[body], &stage.scene.domains) != Some(true);
    let flies = matches!(&stage.kind, StageKind::Fall(fall) if fall.bodies().contains(&body));
    let [wall, body] = [wall, body].map(|b| &stage.scene.bodies[b].name);
    (turns && flies).then(|| {
        sentence!(
            "`{}` does not touch `{}` again in `{}`, which is not looked into",
            body,
            wall,
            &stage.name
        )
    })
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

/// A wall that an impact strikes has gone on moving since it was struck before: its face has to be where it is struck now. Where
/// something else of it may be struck, to the side, that is taken for granted.
pub(in crate::story) fn walls_are_there(
    stage: &Stage,
    stages: &[StageTold],
    branch: Option<(usize, usize)>,
    before: &State,
) -> Result<Vec<Sentence>, Refused> {
    let domains = &stage.scene.domains;
    let is_none = |e: &Expr| is_zero(e, domains) == Some(true);
    let mut out = Vec::new();
    for contact in &stage.scene.contacts {
        let Some((wall, _, normal)) = wall_of(&stage.scene, contact) else {
            continue;
        };
        if before.velocity[wall].iter().all(is_none) {
            continue;
        }
        let earlier = branch.into_iter().flat_map(|at| line(stages, at));
        let cases = earlier.filter_map(|(i, k)| stages[i].cases.get(k));
        for then in cases.flat_map(|case| case.scene.contacts.iter().map(move |c| (case, c))) {
            let (case, struck) = then;
            let same = wall_of(&case.scene, struck);
            let same = same.filter(|(w, _, n)| *w == wall && minus(n, &normal).iter().all(is_none));
            if same.is_none() {
                continue;
            }
            let moved = minus(&before.center[wall], &case.after.center[wall]);
            let gone = minus(&minus(&contact.at, &struck.at), &moved);
            let off = dot(&gone, &normal);
            if before.why_open([&off]).is_some() || is_none(&off) {
                continue;
            }
            let off = tidy(&off, domains).unwrap_or(off);
            let (name, at, was) = (&stage.scene.bodies[wall].name, &contact.name, &struck.name);
            if !is_none(&cross(&gone, &normal)) {
                let words = "`{}` has a face at `{}`, {} off that struck at `{}`";
                let parts = [name.into(), at.into(), (&off).into(), was.into()];
                out.push(Sentence::filled(words, parts));
                continue;
            }
            let between = match sign(&off, domains).is_negative() {
                true => -&off,
                false => off,
            };
            let why = format!(
                "`{name}` goes on moving, and what was struck at `{was}` is no longer at `{at}`: {} lies between them along the normal",
                write_plain(&between)
            );
            let hint = "end the motion before where they meet, such as \"for\" the time until then";
            return Err(Refused::new(&stage.name, why, hint));
        }
    }
    Ok(out)
}

/// The fixed body of a contact that pushes, if it does not turn, the other, and the normal towards that.
fn wall_of(scene: &Scene, contact: &Contact) -> Option<(usize, usize, Vector)> {
    let [first, second] = contact.bodies;
    let pushes = pushes(contact) && !contact.is_string;
    let normal = contact.normal.clone().filter(|_| pushes)?;
    let (wall, body, normal) = match scene.bodies[first].is_fixed() {
        true => (first, second, normal),
        false => (second, first, normal.map(|e| -&e)),
    };
    let [fixed, moving] = [wall, body].map(|b| &scene.bodies[b]);
    (fixed.is_fixed() && fixed.spin.is_zero() && !moving.is_fixed()).then_some((wall, body, normal))
}
