//! What the bodies do that a motion does not name, while it lasts.
//!
//! A body at rest stays. A body that has taken no part so far waits: it comes into play where the scene has it. A body that
//! moves freely goes on uniformly, where no weight is named and the time is known; a wall or platform whose motion is
//! prescribed goes on in any case, and so does a pulley, since its weight has no moment about its axle. Of any other body nothing is said, and what is not said is open.

use crate::answer::calc::{is_zero, tidy};
use crate::expr::Expr;
use crate::formula::{Sentence, sentence};
use crate::scene::Stage;
use crate::story::{Part, State};

/// Carries on what the stage does not name; gives what that takes for granted.
pub(super) fn others(
    stage: &Stage,
    before: &State,
    after: &mut State,
    time: Option<&Expr>,
) -> Vec<Sentence> {
    let scene = &stage.scene;
    let moved = stage.kind.moved();
    let mut out = Vec::new();
    for (b, body) in scene.bodies.iter().enumerate() {
        if moved.contains(&b) {
            after.part[b] = Part::Free;
            continue;
        }
        // What moves at the same time has its own stage, before this one or after it.
        if stage.during.is_some() {
            continue;
        }
        if stage.apart.contains(&b) {
            let why = format!(
                "`{}` moves during `{}` as another stage tells",
                body.name, stage.name
            );
            after.lose(scene, b, &why, true);
            continue;
        }
        let motion = || before.velocity[b].iter().chain([&before.spin[b]]);
        if motion().all(|c| is_zero(c, &scene.domains) == Some(true)) {
            continue;
        }
        let put = |from: &Expr, rate: &Expr, time: &Expr| {
            let e = from + &(rate * time);
            tidy(&e, &scene.domains).unwrap_or(e)
        };
        // What is open leads to what is open, component by component.
        let why_lost = |from: &Expr, rate: &Expr| {
            let stays = is_zero(rate, &scene.domains) == Some(true);
            before.why_open([from, rate]).filter(|_| !stays)
        };
        if scene.axles.contains(&b) {
            match time {
                Some(time) => after.angle[b] = put(&before.angle[b], &before.spin[b], time),
                None => after.lose_angle(scene, b, "how long it turns has no closed form"),
            }
            continue;
        }
        // What is prescribed goes on as it does, whatever acts on the others.
        let weightless = body.is_fixed() || stage.kind.gravity().is_none();
        match (&before.part[b], time) {
            (Part::Waits, _) if !body.is_fixed() => out.push(sentence!(
                "`{}` comes into play at the place that the scene gives",
                &body.name
            )),
            (Part::Free | Part::Waits, Some(time)) if weightless => {
                for (k, letter) in ["x", "y"].into_iter().enumerate() {
                    let (from, rate) = (&before.center[b][k], &before.velocity[b][k]);
                    after.center[b][k] = match why_lost(from, rate) {
                        Some(why) => after.open(scene, [letter, ""], b, &why),
                        None => put(from, rate, time),
                    };
                }
                match why_lost(&before.angle[b], &before.spin[b]) {
                    Some(why) => after.lose_angle(scene, b, &why),
                    None => after.angle[b] = put(&before.angle[b], &before.spin[b], time),
                }
            }
            (part, _) => {
                let why = match (part, weightless) {
                    (Part::Joined, _) => "it is joined to something, and",
                    (_, true) => "how long that takes has no closed form, and",
                    _ => "weight may act on it, and",
                };
                let why = format!(
                    "`{0}` goes on moving during `{1}`: {why} the stage does not say how (a stage with \"during\": \"{1}\" does)",
                    body.name, stage.name
                );
                let steady = weightless && *part != Part::Joined;
                after.lose(scene, b, &why, !steady);
            }
        }
    }
    out
}
