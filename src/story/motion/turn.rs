//! Rotation of a rigid body, and of what is fixed to it, about a point that does not move.

mod begin;
mod top;

use super::bearing::bearing;
use super::supposed::Supposed;
use super::{arrival, balance, half, kept, meanwhile, pushed, tidied};
use crate::answer::calc::{Seen, at_least_zero, is_zero, sign, tidy};
use crate::answer::solve::real;
use crate::expr::{Expr, Function, Vector, cross, dot, minus};
use crate::formula::{Sentence, sentence};
use crate::scene::{Lump, Stage, Turn, Until, direction};
use crate::story::{Refused, StageTold, State};
use begin::{fits, is_balanced, whirl};
use top::{highest, hurdle, stops, swung};

pub(in crate::story) use begin::sense;
pub(super) use begin::{free_sense, sense_words};

/// Whole turns that a body may have made before.
const MOST_TURNS: usize = 20;

/// Rotation about a fixed point.
pub(in crate::story) fn turn(
    stage: &Stage,
    mut before: State,
    turn: &Turn,
    string: Option<&str>,
) -> Result<StageTold, Refused> {
    let domains = &stage.scene.domains;
    let body = &stage.scene.bodies[turn.body];
    let lump = turn.lump(&stage.scene);
    let forward = counts_forward(stage, turn)?;
    whirl(stage, &mut before, turn)?;
    let spin = before.spin[turn.body].clone();
    fits(stage, &before, turn, &spin)?;
    let (way, assumed) = sense(stage, &spin, turn)?;
    let [r, r_end] = arms(stage, turn, &spin);
    let arms = [&r, &r_end];
    let mut way_there = minus(&r, &r_end).into_iter();
    let stays = way_there.all(|c| is_zero(&c, domains) == Some(true));
    if stays && matches!(turn.until, Until::Above | Until::Below) {
        let why = format!("`{}` is there at the beginning already", body.name);
        let hint = "say with `by` through which angle it turns, such as 2*pi";
        return Err(Refused::new(&stage.name, why, hint));
    }
    let about = inertia_about(stage, turn);
    let inertia = tidied(stage, &about)?;
    if is_zero(&inertia, domains) == Some(true) {
        let (name, about) = (&body.name, &turn.about_name);
        let why = format!("`{name}` has no moment of inertia about {about}");
        return Err(Refused::new(&stage.name, why, "give it a mass"));
    }
    let start = tidied(stage, &half(&(&inertia * &spin.powi(2))))?;
    let kept_below = stops(stage, turn, &spin, &start, &r)?;
    let turned = turned(stage, turn, &spin, &r);
    let through = through(stage, turn, turned.as_ref(), &r, way)?;
    let turned = through.as_ref().map(|by| Expr::from(way) * by).or(turned);
    let parts = work(stage, turn, &lump, arms, through.as_ref())?;
    let (work, end, reaches) = balance(stage, turn.body, &start, &parts)?;
    let (mut needs, mut besides, mut assumptions) = (Vec::new(), Vec::new(), Vec::new());
    // On a string it has to get over the top so fast that the string pulls there still, v² ≥ g ℓ.
    let spare = string.map_or_else(Expr::zero, |_| {
        let weight = &lump.mass * &turn.gravity.clone().unwrap_or_else(Expr::zero);
        half(&(&weight * &dot(&r, &r).sqrt()))
    });
    let hurdle = hurdle(stage, turn, &r, &(&start - &spare), way)?;
    for (need, words) in hurdle.into_iter().chain(kept_below) {
        let all = match words.is_partial() {
            true => &mut besides,
            false => &mut needs,
        };
        all.extend(need);
        assumptions.push(words);
    }
    // Only a time at a steady rate leads to the same end in either sense, where none is given.
    let is_steady = work.is_zero() && matches!(turn.until, Until::For(_));
    let is_either = is_steady && turn.clockwise.is_none();
    let assumed = assumed.filter(|_| !is_either).map(|(need, words)| {
        needs.push(need);
        words
    });
    if is_balanced(stage, turn, &spin, &r) {
        assumptions.push(pushed(&body.name));
    }
    assumptions.extend(forward);
    assumptions.extend(assumed);
    let spin_end = match work.is_zero() {
        true => spin.clone(),
        false => driven(stage, turn, &spin, [&inertia, &end], way)?,
    };
    let gained = &Expr::from(way) * &(&spin_end - &spin);
    let time = match (&turn.until, &turn.torque) {
        (Until::For(time), _) => Some(time.clone()),
        _ if turn.gravity.is_some() => None,
        (_, Some(torque)) => Some(&(&gained * &inertia) / torque),
        (_, None) => through.as_ref().map(|by| by / &(&Expr::from(way) * &spin)),
    };
    let time = time.map(|t| tidied(stage, &t)).transpose()?;
    let mut after = before.clone();
    carry(stage, turn, &mut after, arms, &spin, turned.as_ref())?;
    for b in turn.bodies() {
        let [x, y] = arm_at_end(stage, turn, b, arms, &spin);
        let [u, v] = [-(&spin_end * &y), &spin_end * &x].map(|c| tidied(stage, &c));
        after.velocity[b] = [u?, v?];
        after.spin[b] = spin_end.clone();
    }
    assumptions.extend(meanwhile::others(stage, &before, &mut after, time.as_ref()));
    let mut out = StageTold::new(stage, before, after);
    out.kept = conserved(turn);
    out.inertia = Some([about, inertia.clone()]);
    out.work = parts;
    out.kinetic = Some(half(&(&inertia * &out.after.spin[turn.body].powi(2))));
    out.energy = Some([start, end.clone()]);
    out.time = time;
    out.turned = through.map(|by| Expr::from(way) * by);
    if !work.is_zero()
        && let Some(words) = arrival(stage, turn.body, &end, (reaches, &needs))
    {
        // What makes the angle one that is turned through may be all that it takes.
        if !assumptions.contains(&at_least_zero(&end, &stage.scene.domains)) {
            assumptions.push(words);
        }
        needs.push(end);
    }
    out.needs = needs;
    out.besides = besides;
    out.assumptions = assumptions;
    if let Some(string) = string {
        stays_taut(&mut out, turn, way, string)?;
    }
    Ok(out)
}

/// What a string needs so that it pulls all the way: its pull is least where the particle is highest, at one of the ends or at
/// the top.
fn stays_taut(told: &mut StageTold, turn: &Turn, way: i64, string: &str) -> Result<(), Refused> {
    if told.energy.is_none() {
        return Ok(());
    }
    let stage = &told.placed;
    let arms = arms(stage, turn, &told.before.spin[turn.body]);
    let pull = |at_end: bool| {
        let along = &arms[usize::from(at_end)];
        tidied(stage, &-pivot_force(told, turn, way, along, at_end))
    };
    let [first, last] = [pull(false)?, pull(true)?];
    let is_less = |a: &Expr, b: &Expr| {
        let less = sign(&(b - a), &stage.scene.domains);
        matches!(less, Seen::Proved(s) if s.is_not_negative())
    };
    let ends = match () {
        () if is_less(&last, &first) => vec![last],
        () if is_less(&first, &last) => vec![first],
        () => vec![first, last],
    };
    let mut supposed = Supposed::of(stage);
    for pull in ends {
        supposed.not_negative(&pull, format!("the string `{string}` stays taut"), || {
            let why = format!("the string `{string}` goes slack on the way");
            let hint = "end the stage where it still pulls, and let a `fall` follow; what can push as well is a rod: a body of mass \"0\" joined to it";
            Refused::new(&stage.name, why, hint)
        })?;
    }
    let Supposed { needs, words, .. } = supposed;
    told.needs.extend(needs);
    told.assumptions.extend(words);
    Ok(())
}

/// The spin to which work has brought a rotation: in a given time a moment may also turn it back.
fn driven(
    stage: &Stage,
    turn: &Turn,
    spin: &Expr,
    [inertia, end]: [&Expr; 2],
    way: i64,
) -> Result<Expr, Refused> {
    let way = Expr::from(way);
    match (&turn.until, &turn.torque) {
        (Until::For(time), Some(torque)) => {
            let gained = &(torque * time) / inertia;
            tidied(stage, &(spin + &(&way * &gained)))
        }
        _ => tidied(stage, &(&way * &(&(&Expr::from(2) * end) / inertia).sqrt())),
    }
}

/// Work done on the bodies, by what.
fn work(
    stage: &Stage,
    turn: &Turn,
    lump: &Lump,
    [r, r_end]: [&Vector; 2],
    through: Option<&Expr>,
) -> Result<Vec<(&'static str, Expr)>, Refused> {
    let mut work = Vec::new();
    if let Some(g) = &turn.gravity {
        let height = tidied(stage, &(&r[1] - &r_end[1]))?;
        let weighed = &(&lump.mass * g) * &height;
        // The masses of several bodies stand below the line of their common center.
        let lone = turn.with.is_empty();
        work.push((
            "weight",
            match lone {
                true => weighed,
                false => tidied(stage, &weighed)?,
            },
        ));
    }
    if let Some(torque) = &turn.torque {
        let by = through.ok_or_else(|| {
            Refused::new(
                &stage.name,
                "the work of a constant moment needs the angle it turns through, and this is not decided",
                "end the stage with `by`",
            )
        })?;
        work.push(("moment", torque * by));
    }
    Ok(work)
}

/// The angle `by` counts forward, in the sense of the rotation.
fn counts_forward(stage: &Stage, turn: &Turn) -> Result<Option<Sentence>, Refused> {
    let Until::By(by) = &turn.until else {
        return Ok(None);
    };
    match sign(by, &stage.scene.domains) {
        // Its sign is known wherever it has a value.
        Seen::Proved(s) if s.is_not_negative() => {
            let has_value = real(by, &stage.scene.domains).into_iter();
            let has_value = has_value.map(|need| Sentence::not_negative(&need));
            Ok(has_value.reduce(|all, need| sentence!("{} and {}", all, need)))
        }
        Seen::Proved(_) | Seen::Negative => Err(Refused::new(
            &stage.name,
            format!(
                "`by` is the angle turned through, and {} is negative",
                crate::formula::write_plain(by)
            ),
            "turn its sign round, and say \"clockwise\": true if it turns that way",
        )),
        _ => Ok(Some(Sentence::not_negative(by))),
    }
}

/// The angle turned through, counterclockwise and up to whole turns; `None` where it has no closed form here.
fn turned(stage: &Stage, turn: &Turn, spin: &Expr, r: &Vector) -> Option<Expr> {
    let to = match &turn.until {
        Until::By(_) | Until::For(_) => return angle_turned(stage, turn, spin),
        Until::Stops if turn.gravity.is_none() => return angle_turned(stage, turn, spin),
        Until::Stops => return swung(stage, turn, spin, r),
        Until::Above => Expr::ratio(1, 2),
        Until::Below => Expr::ratio(-1, 2),
    };
    let angle = &stage.scene.bodies[turn.body].angle;
    let from = bearing(r, angle, &stage.scene.domains)?;
    tidy(&(&(&to * &Expr::pi()) - &from), &stage.scene.domains).ok()
}

/// The angle turned through in the sense of the rotation; `None` where it has no closed form here, or its sign is not decided.
fn through(
    stage: &Stage,
    turn: &Turn,
    turned: Option<&Expr>,
    r: &Vector,
    way: i64,
) -> Result<Option<Expr>, Refused> {
    let forward = turned.map(|by| Expr::from(way) * by);
    let forward = match turn.until {
        // The arc cosine of a swing reads best as it is.
        Until::Stops if turn.gravity.is_some() => return Ok(forward),
        Until::Stops | Until::By(_) | Until::For(_) => forward,
        // A place is reached up to whole turns, and the sense of the rotation says which.
        Until::Above | Until::Below => forward
            .and_then(|forward| within_a_turn(stage, forward))
            .or_else(|| arc(stage, turn, r, way)),
    };
    forward.map(|by| tidied(stage, &by)).transpose()
}

/// The angle in the sense of the rotation from an arm to the vertical through the fixed point, by its cosine; `None` where the side
/// of the vertical on which the arm begins is not decided.
fn arc(stage: &Stage, turn: &Turn, r: &Vector, way: i64) -> Option<Expr> {
    let end = if matches!(turn.until, Until::Above) {
        1
    } else {
        -1
    };
    let length = dot(r, r).sqrt();
    let least = Expr::call(Function::Acos, &(Expr::from(end) * &r[1]) / &length);
    let ahead = Expr::from(end * way) * &r[0];
    match sign(&ahead, &stage.scene.domains).side()? {
        true => Some(least),
        false => Some(Expr::from(2) * Expr::pi() - least),
    }
}

/// An angle less whole turns, so that it is positive and no more than one; `None` where its sign is not decided.
fn within_a_turn(stage: &Stage, mut angle: Expr) -> Option<Expr> {
    let whole = Expr::from(2) * Expr::pi();
    let side = |e: &Expr| sign(e, &stage.scene.domains).side();
    for _ in 0..MOST_TURNS {
        if side(&angle)? {
            match side(&(&angle - &whole)) {
                Some(true) => angle = angle - &whole,
                _ => return Some(angle),
            }
        } else {
            angle = angle + &whole;
        }
    }
    None
}

/// Leads the bodies round: their places and angles at the end.
fn carry(
    stage: &Stage,
    turn: &Turn,
    after: &mut State,
    [r, r_end]: [&Vector; 2],
    spin: &Expr,
    turned: Option<&Expr>,
) -> Result<(), Refused> {
    let by = angle_turned(stage, turn, spin).map(|by| direction(&by));
    for b in turn.bodies() {
        let arm = minus(&stage.scene.bodies[b].center, &turn.about);
        let [x, y] = match &by {
            Some(by) => rotated(&arm, by),
            None => arm_at_end(stage, turn, b, [r, r_end], spin),
        };
        after.center[b] = [&turn.about[0] + &x, &turn.about[1] + &y];
        match turned {
            Some(by) => after.angle[b] = &after.angle[b] + by,
            None => after.lose_angle(
                &stage.scene,
                b,
                "its angle is found from where its center of mass is, and this has no direction that could be written",
            ),
        }
    }
    Ok(())
}

/// What a rotation conserves.
fn conserved(turn: &Turn) -> Vec<crate::story::Kept> {
    let at = format!("`{}`", turn.about_name);
    let energy = match (&turn.gravity, &turn.torque) {
        (_, Some(_)) => kept(
            "energy",
            false,
            "the moment does work, the moment times the angle",
        ),
        (Some(_), None) => kept(
            "energy",
            true,
            &format!(
                "the force at {at} does no work, since {at} does not move, and weight has a potential"
            ),
        ),
        (None, None) => kept(
            "energy",
            true,
            &format!("the only force acts at {at}, which does not move"),
        ),
    };
    let why = match (&turn.gravity, &turn.torque) {
        (None, None) => "no force has a moment about it",
        (Some(_), None) => "weight has a moment about it",
        (None, Some(_)) => "the applied moment changes it",
        (Some(_), Some(_)) => "weight and the applied moment change it",
    };
    vec![
        energy,
        kept(
            &format!("angular momentum about {at}"),
            turn.gravity.is_none() && turn.torque.is_none(),
            why,
        ),
        kept(
            "momentum",
            false,
            &format!("the force at {at} bends the path of the center of mass"),
        ),
    ]
}

/// The arm from the fixed point to the common center of mass, at the beginning and at the end.
pub(in crate::story) fn arms(stage: &Stage, turn: &Turn, spin: &Expr) -> [Vector; 2] {
    let tidied = |e: Expr| tidy(&e, &stage.scene.domains).unwrap_or(e);
    let r = minus(&turn.lump(&stage.scene).center, &turn.about).map(tidied);
    let length = tidied(dot(&r, &r).sqrt());
    let end = match &turn.until {
        Until::Above => [Expr::zero(), length],
        Until::Below => [Expr::zero(), -&length],
        Until::Stops if turn.gravity.is_some() => {
            let [x, y] = highest(stage, turn, spin, &r).map(tidied);
            let way = sense(stage, spin, turn).map_or(1, |(way, _)| way);
            [Expr::from(way) * x, y]
        }
        Until::Stops | Until::For(_) | Until::By(_) => {
            let by = angle_turned(stage, turn, spin).unwrap_or_else(Expr::zero);
            rotated(&r, &[by.cos(), by.sin()])
        }
    };
    [r, end]
}

/// A vector turned by the angle with this cosine and sine.
pub(super) fn rotated(r: &Vector, [c, s]: &Vector) -> Vector {
    // What has no extent along an axis takes no sine with it.
    let times = |r: &Expr, c: &Expr| match r.is_zero() {
        true => Expr::zero(),
        false => r * c,
    };
    [
        times(&r[0], c) - times(&r[1], s),
        times(&r[0], s) + times(&r[1], c),
    ]
}

/// The angle turned through, counterclockwise, where the stage gives it or the time; `None` where it ends at a place.
fn angle_turned(stage: &Stage, turn: &Turn, spin: &Expr) -> Option<Expr> {
    match &turn.until {
        Until::By(by) => {
            let (way, _) = sense(stage, spin, turn).ok()?;
            Some(&Expr::from(way) * by)
        }
        Until::For(time) => {
            let steady = spin * time;
            let steady = tidy(&steady, &stage.scene.domains).unwrap_or(steady);
            let Some(torque) = &turn.torque else {
                return Some(steady);
            };
            let (way, _) = sense(stage, spin, turn).ok()?;
            let gained = &half(&(torque * &time.powi(2))) / &inertia_about(stage, turn);
            Some(&steady + &(&Expr::from(way) * &gained))
        }
        Until::Stops if turn.gravity.is_none() => {
            let (way, _) = sense(stage, spin, turn).ok()?;
            let start = half(&(&inertia_about(stage, turn) * &spin.powi(2)));
            Some(&(&Expr::from(-way) * &start) / turn.torque.as_ref()?)
        }
        Until::Above | Until::Below | Until::Stops => None,
    }
}

/// Moment of inertia about the fixed point: that of each body, and its mass at its distance.
pub(in crate::story) fn inertia_about(stage: &Stage, turn: &Turn) -> Expr {
    let tidied = |e: &Expr| tidy(e, &stage.scene.domains).unwrap_or_else(|_| e.clone());
    Expr::sum(turn.bodies().into_iter().flat_map(|b| {
        let body = &stage.scene.bodies[b];
        let r = minus(&body.center, &turn.about);
        [tidied(&body.inertia), &body.mass * tidied(&dot(&r, &r))]
    }))
}

/// Where a body is at the end, from the fixed point: the rotation that leads the common center of mass there leads it.
fn arm_at_end(
    stage: &Stage,
    turn: &Turn,
    body: usize,
    [r, r_end]: [&Vector; 2],
    spin: &Expr,
) -> Vector {
    if turn.with.is_empty() {
        return r_end.clone();
    }
    let arm = minus(&stage.scene.bodies[body].center, &turn.about);
    let [c, s] = match angle_turned(stage, turn, spin) {
        Some(by) => [by.cos(), by.sin()],
        None => {
            let square = dot(r, r);
            [&dot(r, r_end) / &square, &cross(r, r_end) / &square]
        }
    };
    rotated(&arm, &[c, s]).map(|e| tidy(&e, &stage.scene.domains).unwrap_or(e))
}

/// Angular acceleration of a turning body, counterclockwise: the moments about the fixed point over the moment of inertia.
pub(in crate::story) fn angular(told: &StageTold, turn: &Turn, way: i64, at_end: bool) -> Expr {
    let stage = &told.placed;
    let arms = arms(stage, turn, &told.before.spin[turn.body]);
    let weight = match &turn.gravity {
        Some(g) => &turn.lump(&stage.scene).mass * g,
        None => Expr::zero(),
    };
    // The moment counts in the sense of the rotation.
    let applied = Expr::from(way) * turn.torque.clone().unwrap_or_else(Expr::zero);
    let moments = &applied - &(&weight * &arms[usize::from(at_end)][0]);
    &moments / &inertia_about(stage, turn)
}

/// Force of the fixed point on a turning body along a direction: m a_G less the weight.
pub(in crate::story) fn pivot_force(
    told: &StageTold,
    turn: &Turn,
    way: i64,
    along: &Vector,
    at_end: bool,
) -> Expr {
    let stage = &told.placed;
    let body = turn.lump(&stage.scene);
    let inertia = inertia_about(stage, turn);
    let [r0, r1] = arms(stage, turn, &told.before.spin[turn.body]);
    let r = if at_end { &r1 } else { &r0 };
    let square = match &told.energy {
        Some([start, end]) => &(&Expr::from(2) * if at_end { end } else { start }) / &inertia,
        None => Expr::zero(),
    };
    let weight = &body.mass * &turn.gravity.clone().unwrap_or_else(Expr::zero);
    let angular = angular(told, turn, way, at_end);
    let a = [
        -(&(&angular * &r[1])) - &square * &r[0],
        &angular * &r[0] - &square * &r[1],
    ];
    let force = [&body.mass * &a[0], &body.mass * &a[1] + &weight];
    dot(&force, along)
}
