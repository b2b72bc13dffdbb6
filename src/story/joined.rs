//! What an impact has joined moves on joined, and takes part in the next impact: a file that says nothing of it is asked.

use super::{Refused, State};
use crate::answer::calc::is_zero;
use crate::expr::minus;
use crate::scene::{HINGED, Scene, Stage, joints, left_behind, unsaid};

/// What is joined to a body moves along with it.
pub(super) fn all_move(scene: &Scene, stage: &Stage) -> Result<(), Refused> {
    for joint in joints(&scene.stages, stage) {
        let Some([body, other]) = left_behind(stage, &joint) else {
            continue;
        };
        let [other, body] = [other, body].map(|b| &stage.scene.bodies[b].name);
        let why = format!(
            "`{other}` {} `{body}` since `{}`, and is not said to move along",
            joint.how, joint.since
        );
        let hint = format!("the motion takes it along with \"with\": [\"{other}\"]");
        return Err(Refused::new(&stage.name, why, hint));
    }
    Ok(())
}

/// Bodies in flight move each as by itself, which joined ones do only where they do not turn about each other.
pub(super) fn fly_alike(scene: &Scene, stage: &Stage, before: &State) -> Result<(), Refused> {
    let moved = stage.kind.moved();
    let mut joints = joints(&scene.stages, stage).into_iter();
    let apart = joints.find(|joint| {
        let [a, b] = joint.bodies;
        let gap = minus(&before.velocity[a], &before.velocity[b]);
        // A particle at the center of what turns stays there.
        let rigid = [a, b].iter().all(|b| !stage.scene.bodies[*b].is_particle());
        let spins = [a, b].into_iter().filter(|_| rigid);
        let mut all = gap.iter().chain(spins.map(|b| &before.spin[b]));
        moved.contains(&a)
            && moved.contains(&b)
            && all.any(|e| is_zero(e, &stage.scene.domains) != Some(true))
    });
    apart.map_or(Ok(()), |joint| {
        let [a, b] = joint.bodies.map(|b| &stage.scene.bodies[b].name);
        let why = format!(
            "`{b}` {} `{a}` since `{}`, and where they turn neither flies as by itself",
            joint.how, joint.since
        );
        let hint = "bodies that stay stuck together fly on as one body: a `composite` with this velocity and spin, in a scene of its own";
        Err(Refused::new(&stage.name, why, hint))
    })
}

/// What is joined to a body that an impulse acts on has its part of it.
pub(super) fn left_out(scene: &Scene, stage: &Stage) -> Result<(), Refused> {
    let mut unsaid = unsaid(&scene.stages, stage).into_iter();
    unsaid.next().map_or(Ok(()), |joint| {
        let (how, since) = (joint.how, joint.since);
        let [a, b] = joint.bodies.map(|b| &stage.scene.bodies[b].name);
        let why = format!("`{b}` {how} `{a}` since `{since}`, and nothing is said of that here");
        let hint = match how {
            HINGED => {
                "repeat the hinge in this impact; one on a fixed body may stand at the top once for all"
            }
            _ => {
                "repeat the contact in this impact: sticking where it holds, without law where it comes loose"
            }
        };
        Err(Refused::new(&stage.name, why, hint))
    })
}
