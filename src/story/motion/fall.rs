//! Free fall and flight: the center of mass moves as a particle does, and the body keeps its spin.

use super::supposed::Supposed;
use super::turn::{free_sense, rotated, sense_words};
use super::{half, kept, meanwhile, tidied, together};
use crate::answer::calc::{Seen, is_zero, sign};
use crate::expr::{Expr, Vector, dot, minus};
use crate::formula::sentence;
use crate::scene::{Fall, FallEnd, Stage, StageKind};
use crate::story::{Cluster, Part, Refused, StageTold, State};

/// Free fall or flight; clusters of bodies that are stuck together and turn do so about their common center of mass.
pub(in crate::story) fn fall(
    stage: &Stage,
    before: State,
    fall: &Fall,
    clusters: &[Vec<usize>],
) -> Result<StageTold, Refused> {
    let scene = &stage.scene;
    let mut supposed = Supposed::of(stage);
    let clusters = clusters
        .iter()
        .map(|cluster| Cluster::of(stage, &before, cluster));
    let clusters = clusters.collect::<Result<Vec<_>, _>>()?;
    ends_alone(stage, &before, fall, &clusters)?;
    let (time, down) = duration(stage, &before, fall, &mut supposed)?;
    let zero = Expr::zero();
    let g = fall.gravity.as_ref().unwrap_or(&zero);
    // The angle that ends a flight is that of its first body.
    let lead = before.spin[fall.body].clone();
    let turned = |b: usize, spin: &Expr| match &fall.until {
        FallEnd::Turned(by) if b == fall.body || *spin == lead => {
            Expr::from(free_sense(stage, spin)) * by
        }
        _ => spin * &time,
    };
    let mut after = before.clone();
    let mut energy = [Expr::zero(), Expr::zero()];
    let mut dropped = Vec::new();
    for b in fall.bodies() {
        let body = &scene.bodies[b];
        let cluster = clusters.iter().find(|cluster| cluster.bodies.contains(&b));
        let [vx, vy] = cluster.map_or(&before.velocity[b], |cluster| &cluster.velocity);
        let v_end = match (&down, b == fall.body) {
            (Some(down), true) => down.clone(),
            _ => together(stage, vy, &-tidied(stage, &(g * &time))?)?,
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
        let (mut way, mut end) = ([along, -drop], [vx.clone(), v_end]);
        let spin = cluster.map_or(&before.spin[b], |cluster| &cluster.spin);
        if let Some(cluster) = cluster {
            let arm = minus(&before.center[b], &cluster.center);
            let turned = turned(b, spin);
            let arm_end = rotated(&arm, &[turned.cos(), turned.sin()]);
            let swings = [-(spin * &arm_end[1]), spin * &arm_end[0]];
            for k in 0..2 {
                way[k] = tidied(stage, &(&way[k] + &arm_end[k] - &arm[k]))?;
                end[k] = tidied(stage, &(&end[k] + &swings[k]))?;
            }
        }
        after.center[b] = [0, 1].map(|k| &after.center[b][k] + &way[k]);
        if !before.spin[b].is_zero() {
            after.angle[b] = tidied(stage, &(&before.angle[b] + &turned(b, spin)))?;
        }
        let turning = half(&(&body.inertia * &before.spin[b].powi(2)));
        for (total, v) in energy.iter_mut().zip([&before.velocity[b], &end]) {
            let moving = half(&(&body.mass * &dot(v, v)));
            *total = &*total + &(&moving + &turning);
        }
        after.velocity[b] = end;
        dropped.push(-(&body.mass * g) * &way[1]);
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
    out.turned = match &fall.until {
        FallEnd::Turned(_) => Some(turned(fall.body, &lead)),
        _ => None,
    };
    out.clusters = clusters;
    // Without weight it goes straight on.
    if fall.gravity.is_none() && out.cluster_of(fall.body).is_none() {
        let v = &out.before.velocity[fall.body];
        out.way = Some(tidied(stage, &(&dot(v, v).sqrt() * &time))?);
    }
    out.time = Some(time);
    supposed.told(&mut out);
    Ok(out)
}

/// Of a flight that lasts a given time and begins with something open: what is determined nonetheless, since each component
/// moves by itself; gives that time. What is joined to another body has no flight of its own.
pub(super) fn known(stage: &Stage, before: &State, after: &mut State) -> Option<Expr> {
    let StageKind::Fall(fall) = &stage.kind else {
        return None;
    };
    let FallEnd::Time(time) = &fall.until else {
        return None;
    };
    // As long as another motion that has no closed form.
    if let Some(during) = &stage.during
        && stage.kind.mentions(&during.time)
    {
        return None;
    }
    let zero = Expr::zero();
    let g = fall.gravity.as_ref().unwrap_or(&zero);
    let put = |from: &Expr, rate: &Expr, gained: &Expr| {
        let way = rate * time + &half(&(gained * time));
        let is_open = before.why_open([from, rate]).is_some();
        tidied(stage, &(from + &way)).ok().filter(|_| !is_open)
    };
    let bodies = fall.bodies().into_iter();
    for b in bodies.filter(|b| before.part[*b] != Part::Joined) {
        for (k, pull) in [&zero, g].into_iter().enumerate() {
            let gained = -(pull * time);
            let rate = &before.velocity[b][k];
            if before.why_open([rate]).is_none()
                && let Ok(end) = tidied(stage, &(rate + &gained))
            {
                after.velocity[b][k] = end;
            }
            if let Some(end) = put(&before.center[b][k], rate, &gained) {
                after.center[b][k] = end;
            }
        }
        if before.why_open([&before.spin[b]]).is_none() {
            after.spin[b] = before.spin[b].clone();
        }
        if let Some(end) = put(&before.angle[b], &before.spin[b], &zero) {
            after.angle[b] = end;
        }
    }
    Some(time.clone())
}

impl Cluster {
    fn of(stage: &Stage, before: &State, bodies: &[usize]) -> Result<Cluster, Refused> {
        let mass = |b: &usize| &stage.scene.bodies[*b].mass;
        let all = Expr::sum(bodies.iter().map(|b| mass(b).clone()));
        let mean = |of: &[Vector], k: usize| {
            let parts = bodies.iter().map(|b| mass(b) * &of[*b][k]);
            tidied(stage, &(Expr::sum(parts) / &all))
        };
        Ok(Cluster {
            center: [mean(&before.center, 0)?, mean(&before.center, 1)?],
            velocity: [mean(&before.velocity, 0)?, mean(&before.velocity, 1)?],
            spin: before.spin[bodies[0]].clone(),
            bodies: bodies.to_vec(),
        })
    }
}

/// A height or a distance is reached by what moves as a particle does, and not by a body that turns about a point beside its center.
fn ends_alone(
    stage: &Stage,
    before: &State,
    fall: &Fall,
    clusters: &[Cluster],
) -> Result<(), Refused> {
    let is_at_center = |cluster: &Cluster| {
        let arm = minus(&before.center[fall.body], &cluster.center);
        arm.iter()
            .all(|e| is_zero(e, &stage.scene.domains) == Some(true))
    };
    let ends_at_place = !matches!(fall.until, FallEnd::Time(_) | FallEnd::Turned(_));
    let mut clusters = clusters
        .iter()
        .filter(|cluster| cluster.bodies.contains(&fall.body));
    if ends_at_place && clusters.any(|cluster| !is_at_center(cluster)) {
        let name = &stage.scene.bodies[fall.body].name;
        let why = format!(
            "`{name}` turns about the center of mass that it has in common with what sticks to it: when it is at this place has no closed form"
        );
        let hint = "end the flight after a time `for`, or an angle `by`";
        return Err(Refused::new(&stage.name, why, hint));
    }
    Ok(())
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
        (FallEnd::Turned(by), _) => {
            let spin = &before.spin[fall.body];
            if is_zero(spin, domains) == Some(true) {
                let hint = match stage.scene.bodies[fall.body].is_particle() {
                    true => "`body` names one that turns, and `with` what sticks to it",
                    false => "give it a spin, or end the flight after a time `for`",
                };
                return Err(never("it does not turn", hint));
            }
            let way = free_sense(stage, spin);
            let size = Expr::from(way) * spin;
            let so = sentence!("`{}` turns {}", name, sense_words(way));
            let still = || never("it does not turn", "end the flight after a time `for`");
            supposed.positive(&size, so, still)?;
            (tidied(stage, &(by / size))?, None)
        }
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
    let comes_after = in_order(stage, fall, name);
    let negative = || match fall.until {
        FallEnd::Time(_) => never(
            "its time is negative",
            "`for` counts from the beginning of the stage",
        ),
        FallEnd::Turned(_) => never(
            "its angle is negative",
            "`by` counts in the sense in which it spins",
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
    match &fall.until {
        // A ball that comes off a wall with e v never gets there for e = 0.
        FallEnd::Range(s) => {
            let ahead = tidied(stage, &(s * vx))?;
            supposed.positive(&ahead, format!("`{name}` gets there"), negative)?;
        }
        FallEnd::Drop(h) if is_later(stage, fall, h) => {}
        _ => supposed.not_negative(&time, comes_after, negative)?,
    }
    Ok((time, down))
}

/// What it means that a flight takes a positive time.
fn in_order(stage: &Stage, fall: &Fall, body: &str) -> String {
    match fall.until {
        FallEnd::Top => format!("`{body}` begins on its way up"),
        _ => format!("the end of `{}` comes after its beginning", stage.name),
    }
}

/// Whether the end comes after the beginning whatever the values: what falls comes below where it began, and what rises is
/// held to that by itself.
fn is_later(stage: &Stage, fall: &Fall, drop: &Expr) -> bool {
    let is_below = || match sign(drop, &stage.scene.domains) {
        Seen::Proved(sign) => sign.is_not_negative(),
        _ => false,
    };
    fall.gravity.is_some() && (fall.rising || is_below())
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
