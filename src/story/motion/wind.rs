//! A particle on a rope that winds round a thin pole.

use super::{half, kept, meanwhile, tidied};
use crate::algebra::Sign;
use crate::answer::calc::{Seen, is_zero, sign};
use crate::domain::Domains;
use crate::expr::{Expr, cross, dot, minus};
use crate::formula::Sentence;
use crate::scene::{Stage, Wind};
use crate::story::{Refused, StageTold, State};

/// A rope that winds round a pole.
pub(in crate::story) fn wind(
    stage: &Stage,
    before: State,
    wind: &Wind,
) -> Result<StageTold, Refused> {
    let domains: &Domains = &stage.scene.domains;
    let body = &stage.scene.bodies[wind.body];
    let v = before.velocity[wind.body].clone();
    let rope = minus(&stage.scene.bodies[wind.body].center, &wind.around);
    let free = tidied(stage, &dot(&rope, &rope).sqrt())?;
    if is_zero(&dot(&rope, &v), domains) == Some(false) {
        let why = format!(
            "`{}` does not move straight across the rope, which would jerk",
            body.name
        );
        let hint = "put an impact with a string before it, in which the rope becomes taut";
        return Err(Refused::new(&stage.name, why, hint));
    }
    if let Seen::Proved(Sign::Negative) = sign(&(&free - &wind.to), domains) {
        let why = "a rope that winds up gets shorter, and this gets longer";
        return Err(Refused::new(&stage.name, why, "exchange the lengths"));
    }
    // Counterclockwise as at the beginning, or clockwise.
    let across = tidied(stage, &(cross(&rope, &v) / &free))?;
    let mut after = before.clone();
    after.velocity[wind.body] = [Expr::zero(), across.clone()];
    after.center[wind.body] = [&wind.around[0] + &wind.to, wind.around[1].clone()];
    // How long it takes goes beyond all bounds as the pole gets thinner.
    let mut assumptions = meanwhile::others(stage, &before, &mut after, None);
    let energy = tidied(stage, &half(&(&body.mass * &across.powi(2))))?;
    let mut out = StageTold::new(stage, before, after);
    out.kept = vec![
        kept(
            "energy",
            true,
            "the rope pulls across the velocity at every moment, because its free part turns about the point where it leaves the pole: no work",
        ),
        kept(
            "angular momentum about the pole",
            false,
            "the rope leaves the pole at its surface, so its pull has the pole's radius as an arm; the pole is thin, but the rope winds round it so often that the moment adds up",
        ),
    ];
    out.energy = Some([energy.clone(), energy]);
    assumptions.push(Sentence::words(
        "the pole is thin compared with the rope, and at the end x points along the rope",
    ));
    out.assumptions = assumptions;
    Ok(out)
}
