//! What has come to rest on a body that it slid on stays there by friction, as long as that suffices.

use super::supposed::Supposed;
use super::tidied;
use crate::answer::calc::sign;
use crate::scene::{Stage, StageKind};
use crate::story::{Refused, StageTold, line};

/// Adds to a slide what it needs so that a body which an earlier stage let slip on another moves along with it.
pub(in crate::story) fn riders_stay(
    stage: &Stage,
    stages: &[StageTold],
    branch: Option<(usize, usize)>,
    mut told: StageTold,
) -> Result<StageTold, Refused> {
    let StageKind::Slide(slide) = &stage.kind else {
        return Ok(told);
    };
    let (Some(acceleration), Some(g)) = (&told.acceleration, &slide.gravity) else {
        return Ok(told);
    };
    let company = slide.company();
    let mut supposed = Supposed::of(stage);
    let before = branch.into_iter().flat_map(|at| line(stages, at));
    for (i, _) in before {
        let StageKind::Slide(earlier) = &stages[i].placed.kind else {
            continue;
        };
        let (Some(on), Some(mu)) = (&earlier.on, &earlier.friction) else {
            continue;
        };
        let both = [earlier.body, on.body];
        if !both.iter().all(|b| company.contains(b)) {
            continue;
        }
        let [x, y] = &slide.along;
        let (pull, press) = match slide.level {
            true => (acceleration.clone(), g.clone()),
            false => (acceleration + &(g * y), g * x),
        };
        let [pull, press] = [pull, press].map(|e| match sign(&e, &stage.scene.domains).side() {
            Some(false) => -e,
            _ => e,
        });
        let need = tidied(stage, &(&(mu * &press) - &pull))?;
        let [rider, below] = both.map(|b| &stage.scene.bodies[b].name);
        supposed.not_negative(
            &need,
            format!("`{rider}` does not slip on `{below}`"),
            || {
                let why = format!(
                    "`{rider}` slips on `{below}`: friction does not suffice to take it along"
                );
                let hint = "let it slide \"on\" the other in this stage";
                Refused::new(&stage.name, why, hint)
            },
        )?;
        break;
    }
    told.needs.extend(supposed.needs);
    told.assumptions.extend(supposed.words);
    Ok(told)
}
