//! Motion of a body along a straight line, without turning, under constant forces.

use super::{arrival, balance, half, kept, meanwhile, tidied};
use crate::answer::calc::{Seen, is_zero, sign};
use crate::expr::{Expr, dot};
use crate::formula::sentence;
use crate::scene::{Slide, Stage};
use crate::story::{Refused, StageTold, State};

/// Motion along a line.
pub(in crate::story) fn slide(
    stage: &Stage,
    before: State,
    slide: &Slide,
) -> Result<StageTold, Refused> {
    let domains = &stage.scene.domains;
    let body = &stage.scene.bodies[slide.body];
    let v = &before.velocity[slide.body];
    let across = [-&slide.along[1], slide.along[0].clone()];
    if is_zero(&dot(v, &across), domains) == Some(false)
        || is_zero(&before.spin[slide.body], domains) == Some(false)
    {
        return Err(Refused::new(
            &stage.name,
            format!(
                "`{}` does not begin to move along this line without turning",
                body.name
            ),
            "an impact before it may stop what does not fit",
        ));
    }
    let speed = tidied(stage, &dot(v, &slide.along))?;
    let mut assumptions = Vec::new();
    for (what, size) in [("speed", &speed), ("distance", &slide.distance)] {
        match sign(size, domains) {
            Seen::Proved(s) if s.is_not_negative() => {}
            Seen::Proved(_) | Seen::Negative => {
                return Err(Refused::new(
                    &stage.name,
                    format!(
                        "`{}` is to move along the line, and its {what} along it, {}, is negative",
                        body.name,
                        crate::formula::write_plain(size)
                    ),
                    "turn the direction round",
                ));
            }
            _ => assumptions.push(sentence![size, " ≥ 0"]),
        }
    }
    let start = tidied(stage, &half(&(&body.mass * &speed.powi(2))))?;
    let mut work = Vec::new();
    if let Some(g) = &slide.gravity {
        let lost = -&(&slide.along[1] * &slide.distance);
        work.push(("weight", &(&body.mass * g) * &lost));
    }
    if let Some(force) = &slide.force {
        work.push(("the applied force", force * &slide.distance));
    }
    let parts = work;
    let (work, end, reaches) = balance(stage, slide.body, &start, &parts)?;
    if !work.is_zero() {
        assumptions.extend(arrival(stage, slide.body, &end, reaches));
    }
    let begins = speed.clone();
    let speed = if work.is_zero() {
        speed
    } else {
        tidied(stage, &(&(&Expr::from(2) * &end) / &body.mass).sqrt())?
    };
    let mut after = before.clone();
    for k in 0..2 {
        after.center[slide.body][k] =
            &after.center[slide.body][k] + &(&slide.along[k] * &slide.distance);
    }
    for k in 0..2 {
        after.velocity[slide.body][k] = tidied(stage, &(&speed * &slide.along[k]))?;
    }
    let time = if work.is_zero() {
        &slide.distance / &begins
    } else {
        // A constant force F over the distance s does the work F s, and F t is the momentum gained.
        &(&(&speed - &begins) * &(&body.mass * &slide.distance)) / &work
    };
    let rests = is_zero(&speed, domains) == Some(true) && work.is_zero();
    let time = (!rests).then(|| tidied(stage, &time)).transpose()?;
    assumptions.extend(meanwhile::others(stage, &before, &mut after, time.as_ref()));
    let mut out = StageTold::new(stage, before, after);
    out.time = time;
    out.kept = vec![kept(
        "energy",
        slide.force.is_none(),
        if slide.force.is_none() {
            "the guide does no work, and weight has a potential"
        } else {
            "the force does work, its size times the distance"
        },
    )];
    out.energy = Some([start, end]);
    out.work = parts;
    out.assumptions = assumptions;
    Ok(out)
}
