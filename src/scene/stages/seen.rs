//! Whether a motion is drawn from the side, or seen from above.

use crate::expr::Expr;
use crate::scene::Scene;
use crate::scene::fault::{Fault, Span};
use crate::scene::proof::{Zero, zero};
use crate::scene::resolver::Resolver;
use crate::scene::stage::StageKind;

/// Refuses a rough incline onto which a body comes by a collision in the air, across the incline: what is drawn so is seen from
/// above, and its weight pulls nothing along.
pub(super) fn from_above(base: &mut Resolver<'_>, scene: &Scene, i: usize, span: Span) {
    let (stage, domains) = (&scene.stages[i], &scene.domains);
    let StageKind::Slide(slide) = &stage.kind else {
        return;
    };
    let Some(crash) = stage.from.map(|from| &scene.stages[from]) else {
        return;
    };
    let carried = match &crash.kind {
        StageKind::Impact { one_sided, .. } => {
            let mut all = crash.scene.touching().flat_map(|one| one.bodies);
            !one_sided.is_empty() || all.any(|b| crash.scene.bodies[b].is_fixed())
        }
        _ => true,
    };
    if carried || crash.from.is_some() || slide.level || slide.bend || slide.friction.is_none() {
        return;
    }
    let is_not = |e: &Expr| matches!(zero(e, domains), Zero::No(_));
    let [x, y] = &slide.along;
    let crosses = |b: &usize| {
        let [u, v] = &crash.scene.bodies[*b].velocity;
        is_not(&(&(x * v) - &(y * u)))
    };
    if is_not(x) && is_not(y) && slide.company().iter().any(crosses) {
        let name = &scene.bodies[slide.body].name;
        let message = format!(
            "`{name}` slides on an incline here, and in `{}` no incline carried it",
            crash.name
        );
        let hint = "where a bend leads it there, add \"bend\": true; where the scene is seen from above, \"level\": true; otherwise the surface is a contact or support of the impact";
        base.faults.push(Fault::new(span, message).hint(hint));
    }
}
