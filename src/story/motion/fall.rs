//! Free fall and flight: the center of mass moves as a particle does, and the body keeps its spin.

use super::supposed::Supposed;
use super::{half, kept, meanwhile, tidied};
use crate::answer::calc::is_zero;
use crate::expr::Expr;
use crate::scene::{Fall, FallEnd, Stage};
use crate::story::{Refused, StageTold, State};

/// Free fall or flight.
pub(in crate::story) fn fall(
    stage: &Stage,
    before: State,
    fall: &Fall,
) -> Result<StageTold, Refused> {
    let scene = &stage.scene;
    let mut supposed = Supposed::of(stage);
    let (time, down) = duration(stage, &before, fall, &mut supposed)?;
    let zero = Expr::zero();
    let g = fall.gravity.as_ref().unwrap_or(&zero);
    let mut after = before.clone();
    let mut energy = [Expr::zero(), Expr::zero()];
    let mut dropped = Vec::new();
    for b in fall.bodies() {
        let body = &scene.bodies[b];
        let [vx, vy] = &before.velocity[b];
        let v_end = match (&down, b == fall.body) {
            (Some(down), true) => down.clone(),
            _ => tidied(stage, &(vy - &(g * &time)))?,
        };
        let drop = match (&fall.until, b == fall.body) {
            (FallEnd::Drop(h), true) => h.clone(),
            _ => tidied(stage, &-&(&(vy * &time) - &half(&(g * &time.powi(2)))))?,
        };
        let along = if is_zero(vx, &scene.domains) == Some(true) {
            Expr::zero()
        } else {
            match (&fall.until, b == fall.body) {
                (FallEnd::Range(s), true) => s.clone(),
                _ => tidied(stage, &(vx * &time))?,
            }
        };
        after.center[b] = [&after.center[b][0] + &along, &after.center[b][1] - &drop];
        if !before.spin[b].is_zero() {
            after.angle[b] = tidied(stage, &(&before.angle[b] + &(&before.spin[b] * &time)))?;
        }
        after.velocity[b] = [vx.clone(), v_end.clone()];
        let turning = half(&(&body.inertia * &before.spin[b].powi(2)));
        for (total, vy) in energy.iter_mut().zip([vy, &v_end]) {
            let moving = half(&(&body.mass * &(&vx.powi(2) + &vy.powi(2))));
            *total = &*total + &(&moving + &turning);
        }
        dropped.push(&(&body.mass * g) * &drop);
    }
    supposed
        .words
        .extend(meanwhile::others(stage, &before, &mut after, Some(&time)));
    let [start, end] = energy;
    let energy = [tidied(stage, &start)?, tidied(stage, &end)?];
    let mut out = StageTold::new(stage, before, after);
    let turns = fall
        .bodies()
        .iter()
        .any(|b| !scene.bodies[*b].is_particle());
    out.kept = conserved(fall, turns);
    out.energy = Some(energy);
    if fall.gravity.is_some() {
        out.work = vec![("weight", Expr::sum(dropped))];
    }
    out.time = Some(time);
    supposed.told(&mut out);
    Ok(out)
}

/// The time a fall takes, and where it ends after a height also the vertical velocity at the end.
fn duration(
    stage: &Stage,
    before: &State,
    fall: &Fall,
    supposed: &mut Supposed<'_>,
) -> Result<(Expr, Option<Expr>), Refused> {
    let domains = &stage.scene.domains;
    let name = &stage.scene.bodies[fall.body].name;
    let [vx, vy] = &before.velocity[fall.body];
    let never = |why: &str, hint: &str| {
        Refused::new(
            &stage.name,
            format!("`{name}` never gets there: {why}"),
            hint,
        )
    };
    let (time, down) = match (&fall.until, &fall.gravity) {
        (FallEnd::Time(t), _) => (t.clone(), None),
        (FallEnd::Top, g) => {
            let g = g.clone().unwrap_or_else(Expr::zero);
            (tidied(stage, &(vy / &g))?, Some(Expr::zero()))
        }
        (FallEnd::Range(s), _) => {
            if is_zero(vx, domains) == Some(true) {
                return Err(never(
                    "it does not move sideways",
                    "give a `height` or a time `for`",
                ));
            }
            (tidied(stage, &(s / vx))?, None)
        }
        (FallEnd::Drop(h), Some(g)) => {
            let square = tidied(stage, &(&vy.powi(2) + &(&(&Expr::from(2) * g) * h)))?;
            supposed.not_negative(&square, format!("`{name}` gets there"), || {
                never("it turns back below this height", "give it more speed")
            })?;
            let way = Expr::from(if fall.rising { 1 } else { -1 });
            let end = tidied(stage, &(&way * &square.sqrt()))?;
            let time = tidied(stage, &(&(vy - &end) / g))?;
            if fall.rising {
                rises(stage, fall, [h, vy], supposed)?;
                return Ok((time, Some(end)));
            }
            (time, Some(end))
        }
        (FallEnd::Drop(h), None) => {
            if is_zero(vy, domains) == Some(true) {
                return Err(never(
                    "without gravity it stays at its height",
                    "add \"gravity\": \"g\", or give a time `for`",
                ));
            }
            (tidied(stage, &-(h / vy))?, Some(vy.clone()))
        }
    };
    let comes_after = format!("`{}` comes after what is before it", stage.name);
    let negative = || match fall.until {
        FallEnd::Time(_) => never(
            "its time is negative",
            "`for` counts from the beginning of the stage",
        ),
        FallEnd::Top => never(
            "it begins on its way down",
            "the top of a flight comes after a beginning upwards",
        ),
        _ => never(
            "it moves the other way",
            "look at the sign of `height` (counted downwards) or `range` (counted to the right)",
        ),
    };
    supposed.not_negative(&time, comes_after, negative)?;
    Ok((time, down))
}

/// What is still rising at the end began to rise, and ends above its beginning.
fn rises(
    stage: &Stage,
    fall: &Fall,
    [drop, up]: [&Expr; 2],
    supposed: &mut Supposed<'_>,
) -> Result<(), Refused> {
    let name = &stage.scene.bodies[fall.body].name;
    for need in [-drop, up.clone()] {
        supposed.not_negative(&need, format!("`{name}` rises to there"), || {
            let why = format!("`{name}` is not rising there");
            let hint = "a negative `height` counts upwards; leave out `rising` where it comes down";
            Refused::new(&stage.name, why, hint)
        })?;
    }
    Ok(())
}

/// What a flight conserves.
fn conserved(fall: &Fall, turns: bool) -> Vec<crate::story::Kept> {
    let heavy = fall.gravity.is_some();
    let pick = |with, without| if heavy { with } else { without };
    let mut out = vec![kept(
        "energy",
        true,
        pick(
            "only the weight acts, and it has a potential",
            "no force acts",
        ),
    )];
    // A particle has no spin to keep.
    if turns {
        out.push(kept(
            "spin",
            true,
            "no force has a moment about the center of mass",
        ));
    }
    out.push(kept(
        "momentum",
        !heavy,
        pick("weight changes its vertical part", "no force acts"),
    ));
    out
}
