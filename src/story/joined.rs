//! What an impact has joined moves on joined, and takes part in the next impact: a file that says nothing of it is asked.

use std::collections::BTreeSet;

use super::{Refused, State};
use crate::answer::calc::is_zero;
use crate::expr::{Expr, minus};
use crate::scene::{HINGED, Joint, Scene, Stage, StageKind, joints, left_behind, unsaid};

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
        let hint = match &stage.kind {
            StageKind::Wind(_) => format!(
                "a rope that winds up has one body at its end: begin a scene there with the mass of both in `{body}`"
            ),
            StageKind::Linkage(_) => {
                format!("give `{other}` a `center` by the coordinate of the linkage")
            }
            _ => format!("the motion takes it along with \"with\": [\"{other}\"]"),
        };
        return Err(Refused::new(&stage.name, why, hint));
    }
    Ok(())
}

/// The bodies in flight that are stuck together and turn, each cluster with one that is no particle in front: they turn about
/// their common center of mass, and all others fly each as by itself. A particle is held at one place, a larger body at two.
pub(super) fn turning(
    scene: &Scene,
    stage: &Stage,
    before: &State,
) -> Result<Vec<Vec<usize>>, Refused> {
    let bodies = &stage.scene.bodies;
    let is_none = |e: &Expr| is_zero(e, &stage.scene.domains) == Some(true);
    let moved = stage.kind.moved();
    let mut joints = joints(&scene.stages, stage);
    joints.retain(|joint| joint.bodies.iter().all(|b| moved.contains(b)));
    let apart = |[a, b]: [usize; 2]| {
        // A particle at the center of what turns stays there.
        let is_rigid = [a, b].iter().all(|b| !bodies[*b].is_particle());
        let turns = is_rigid && ![a, b].iter().all(|b| is_none(&before.spin[*b]));
        turns
            || !minus(&before.velocity[a], &before.velocity[b])
                .iter()
                .all(is_none)
    };
    let mut clusters: Vec<Vec<usize>> = Vec::new();
    for joint in joints.iter().filter(|joint| apart(joint.bodies)) {
        if clusters
            .iter()
            .any(|cluster| cluster.contains(&joint.bodies[0]))
        {
            continue;
        }
        let mut cluster = vec![joint.bodies[0]];
        let mut k = 0;
        while k < cluster.len() {
            let with = joints.iter().filter(|j| j.bodies.contains(&cluster[k]));
            let new = with.flat_map(|j| j.bodies).filter(|b| !cluster.contains(b));
            cluster.extend(new.collect::<BTreeSet<_>>());
            k += 1;
        }
        cluster.sort_by_key(|b| bodies[*b].is_particle());
        let lead = cluster[0];
        let w = &before.spin[lead];
        let carried = |b: &usize| {
            let [x, y] = minus(&before.center[*b], &before.center[lead]);
            let gap = minus(&before.velocity[*b], &before.velocity[lead]);
            let turns = bodies[*b].is_particle() || is_none(&(&before.spin[*b] - w));
            turns && minus(&gap, &[-(w * y), w * x]).iter().all(is_none)
        };
        let mut held = vec![lead];
        let is_held = |held: &[usize], b: usize| {
            let to = joints.iter().filter(|j| j.bodies.contains(&b));
            let mut to = to.filter(|j| j.bodies.iter().any(|a| held.contains(a)));
            let first = to.next().and_then(|j| j.at);
            let is_apart = |j: &Joint| {
                let gap = first.zip(j.at).map(|(one, other)| minus(one, other));
                gap.is_some_and(|gap| !gap.iter().all(is_none))
            };
            first.is_some() && (bodies[b].is_particle() || to.any(is_apart))
        };
        while let Some(next) = cluster
            .iter()
            .find(|b| !held.contains(b) && is_held(&held, **b))
        {
            held.push(*next);
        }
        if bodies[lead].is_particle() || held.len() < cluster.len() || !cluster.iter().all(carried)
        {
            let [a, b] = joint.bodies.map(|b| &bodies[b].name);
            let why = format!(
                "`{b}` {} `{a}` since `{}`, and where they turn neither flies as by itself",
                joint.how, joint.since
            );
            let hint = "particles that stick to a body turn with it, and larger bodies that stick to it at two points; others have to be one `composite` from the start";
            return Err(Refused::new(&stage.name, why, hint));
        }
        clusters.push(cluster);
    }
    Ok(clusters)
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
