//! Rotation of a rigid body, and of what is fixed to it, about a point that does not move.

use super::bearing::bearing;
use super::{arrival, balance, half, kept, meanwhile, pushed, tidied};
use crate::algebra::Sign;
use crate::answer::calc::{Seen, constant, is_zero, sign, tidy};
use crate::expr::{Expr, Function, Vector, cross, dot, minus};
use crate::formula::{Sentence, sentence};
use crate::scene::{Lump, Stage, Turn, Until, direction};
use crate::story::{Refused, StageTold, State, given, integrate};

/// Rotation about a fixed point.
pub(in crate::story) fn turn(
    stage: &Stage,
    mut before: State,
    turn: &Turn,
) -> Result<StageTold, Refused> {
    let domains = &stage.scene.domains;
    let body = &stage.scene.bodies[turn.body];
    let lump = turn.lump(&stage.scene);
    whirl(stage, &mut before, turn)?;
    let spin = before.spin[turn.body].clone();
    fits(stage, &before, turn, &spin)?;
    let (way, assumed) = sense(stage, &spin, turn)?;
    let [r, r_end] = arms(stage, turn, &spin);
    let ends_where_it_begins = matches!(turn.until, Until::Above | Until::Below)
        && minus(&r, &r_end)
            .iter()
            .all(|c| is_zero(c, domains) == Some(true));
    if ends_where_it_begins {
        return Err(Refused::new(
            &stage.name,
            format!("`{}` is there at the beginning already", body.name),
            "say with `by` through which angle it turns, such as 2*pi",
        ));
    }
    let about = inertia_about(stage, turn);
    let inertia = tidied(stage, &about)?;
    if is_zero(&inertia, domains) == Some(true) {
        return Err(Refused::new(
            &stage.name,
            format!(
                "`{}` has no moment of inertia about {}",
                body.name, turn.about_name
            ),
            "give it a mass",
        ));
    }
    let start = tidied(stage, &half(&(&inertia * &spin.powi(2))))?;
    let kept_below = stops(stage, turn, &spin, &start, &r)?;
    let turned = turned(stage, turn, &spin, &r);
    let through = through(stage, turn, turned.as_ref(), way)?;
    let parts = work(stage, turn, &lump, [&r, &r_end], through.as_ref())?;
    let (work, end, reaches) = balance(stage, turn.body, &start, &parts)?;
    let (mut needs, mut assumptions) = (Vec::new(), Vec::new());
    for (need, words) in hurdle(stage, turn, &r, &start, way)?
        .into_iter()
        .chain(kept_below)
    {
        needs.extend(need);
        assumptions.push(words);
    }
    let assumed = assumed.map(|(need, words)| {
        needs.push(need);
        words
    });
    if is_balanced(stage, turn, &spin, &r) {
        assumptions.push(pushed(&body.name));
    }
    assumptions.extend(counts_forward(stage, turn, way)?);
    let spin_end = if work.is_zero() {
        spin.clone()
    } else {
        assumptions.extend(assumed);
        let size = (&(&Expr::from(2) * &end) / &inertia).sqrt();
        tidied(stage, &(&Expr::from(way) * &size))?
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
    carry(
        stage,
        turn,
        &mut after,
        [&r, &r_end],
        &spin,
        turned.as_ref(),
    )?;
    for b in turn.bodies() {
        let [x, y] = arm_at_end(stage, turn, b, [&r, &r_end], &spin);
        after.velocity[b] = [
            tidied(stage, &-(&spin_end * &y))?,
            tidied(stage, &(&spin_end * &x))?,
        ];
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
        && let Some(words) = arrival(stage, turn.body, &end, reaches)
    {
        assumptions.push(words);
        needs.push(end);
    }
    out.needs = needs;
    out.assumptions = assumptions;
    Ok(out)
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
        work.push(("weight", &(&lump.mass * g) * &height));
    }
    if let Some(torque) = &turn.torque {
        let by = through.ok_or_else(|| {
            Refused::new(
                &stage.name,
                "the work of a constant moment needs the angle it turns through, and this is not decided",
                "end the stage with `by`",
            )
        })?;
        work.push(("the applied moment", torque * by));
    }
    Ok(work)
}

/// The angle `by` counts forward, in the sense of the rotation.
fn counts_forward(stage: &Stage, turn: &Turn, way: i64) -> Result<Option<Sentence>, Refused> {
    let Until::By(by) = &turn.until else {
        return Ok(None);
    };
    let body = &stage.scene.bodies[turn.body];
    if way < 0 && turn.clockwise.is_none() {
        return Err(Refused::new(
            &stage.name,
            format!(
                "`{}` turns clockwise, and `by` counts counterclockwise here",
                body.name
            ),
            "add \"clockwise\": true",
        ));
    }
    match sign(by, &stage.scene.domains) {
        Seen::Proved(s) if s.is_not_negative() => Ok(None),
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
    way: i64,
) -> Result<Option<Expr>, Refused> {
    let Some(forward) = turned.map(|by| Expr::from(way) * by) else {
        return Ok(None);
    };
    let forward = match turn.until {
        // The arc cosine of a swing reads best as it is.
        Until::Stops if turn.gravity.is_some() => return Ok(Some(forward)),
        Until::Stops | Until::By(_) | Until::For(_) => forward,
        // A place is reached up to whole turns, and the sense of the rotation says which.
        Until::Above | Until::Below => match sign(&forward, &stage.scene.domains).side() {
            Some(true) => forward,
            Some(false) => forward + Expr::from(2) * Expr::pi(),
            None => return Ok(None),
        },
    };
    tidied(stage, &forward).map(Some)
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
            "the moment does work, its size times the angle, and that work is the gain",
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
fn rotated(r: &Vector, [c, s]: &Vector) -> Vector {
    [&(&r[0] * c) - &(&r[1] * s), &(&r[0] * s) + &(&r[1] * c)]
}

/// The angle turned through, counterclockwise, where the stage gives it or the time; `None` where it ends at a place.
fn angle_turned(stage: &Stage, turn: &Turn, spin: &Expr) -> Option<Expr> {
    let way = if turn.clockwise == Some(true) { -1 } else { 1 };
    match &turn.until {
        Until::By(by) if way < 0 => Some(-by),
        Until::By(by) => Some(by.clone()),
        Until::For(time) => {
            let steady = spin * time;
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

/// Where the arm to the center of mass points when weight has brought the body to rest, as it would be for a rotation
/// counterclockwise: to the right of the fixed point, on the way up.
fn highest(stage: &Stage, turn: &Turn, spin: &Expr, r: &Vector) -> Vector {
    let lump = turn.lump(&stage.scene);
    let weight = &lump.mass * turn.gravity.as_ref().unwrap_or(&Expr::zero());
    let climb = &half(&(&inertia_about(stage, turn) * &spin.powi(2))) / &weight;
    let y = &r[1] + &climb;
    let x = (&dot(r, r) - &y.powi(2)).sqrt();
    [x, y]
}

/// The angle through which a body swings until weight has brought it to rest, counterclockwise; `None` where the direction of
/// its arm at the beginning cannot be written.
fn swung(stage: &Stage, turn: &Turn, spin: &Expr, r: &Vector) -> Option<Expr> {
    let domains = &stage.scene.domains;
    let (way, _) = sense(stage, spin, turn).ok()?;
    let angle = &stage.scene.bodies[turn.body].angle;
    let half_turn = Expr::pi();
    // From straight below, in the sense of the rotation, within half a turn either way.
    let begins = &Expr::from(way) * &(&bearing(r, angle, domains)? + &half(&half_turn));
    let within = |e: &Expr| {
        let gaps = [e + &half_turn, &half_turn - e];
        gaps.iter()
            .all(|gap| matches!(sign(gap, domains), Seen::Proved(s) if s.is_not_negative()))
    };
    let turns = [0, -2, 2].map(|k| &begins + &(Expr::from(k) * Expr::pi()));
    let begins = turns.into_iter().find(within)?;
    let [_, y] = highest(stage, turn, spin, r);
    let length = dot(r, r).sqrt();
    // The cosine less what it loses on the way up reads better than one fraction.
    let [from, rise] = [&r[1] / &length, (&y - &r[1]) / &length].map(|e| tidy(&e, domains));
    let ends = Expr::call(Function::Acos, -(from.ok()?) - rise.ok()?);
    Some(Expr::from(way) * (ends - tidy(&begins, domains).ok()?))
}

/// What must hold so that a body comes to rest: for weight, that it does not get over the highest place; for a moment, that it
/// works against the rotation.
fn stops(
    stage: &Stage,
    turn: &Turn,
    spin: &Expr,
    start: &Expr,
    r: &Vector,
) -> Result<Option<(Option<Expr>, Sentence)>, Refused> {
    if !matches!(turn.until, Until::Stops) {
        return Ok(None);
    }
    let domains = &stage.scene.domains;
    let name = &stage.scene.bodies[turn.body].name;
    let refused =
        |what: &str, hint: &str| Refused::new(&stage.name, format!("`{name}` {what}"), hint);
    if is_zero(spin, domains) == Some(true) {
        return Err(refused(
            "is at rest at the beginning already",
            "say with `by` through which angle it turns",
        ));
    }
    let (left, why) = match (&turn.gravity, &turn.torque) {
        (None, None) => {
            return Err(refused(
                "never comes to rest: nothing slows it down",
                "add `gravity`, or a `torque` below zero",
            ));
        }
        (Some(_), Some(_)) => {
            return Err(refused(
                "comes to rest under its weight and a moment at an angle that has no closed form",
                "give the angle `by` as a parameter, and `solve` for it where the energy at the end is zero",
            ));
        }
        (None, Some(torque)) => (-torque, "the moment slows the rotation down"),
        (Some(g), None) => {
            let lump = turn.lump(&stage.scene);
            let climb = &dot(r, r).sqrt() - &r[1];
            let left = &(&(&lump.mass * g) * &climb) - start;
            (left, "it does not get over the highest place and round")
        }
    };
    let left = tidied(stage, &left)?;
    match sign(&left, domains) {
        Seen::Proved(Sign::Positive) => Ok(None),
        Seen::Proved(Sign::Negative | Sign::Zero | Sign::NotPositive) => Err(refused(
            "never comes to rest: it has energy enough to get round, or is driven on",
            "end the stage with `by`, or `until` it is above or below",
        )),
        _ => {
            let least = crate::answer::calc::above_zero(&left, domains);
            let words = sentence![least, ", so that ", why];
            Ok(Some((Some(left), words)))
        }
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

/// The sense of the rotation, 1 counterclockwise and −1 clockwise, and what must be ≥ 0 for it where that is taken for granted.
pub(in crate::story) fn sense(
    stage: &Stage,
    spin: &Expr,
    turn: &Turn,
) -> Result<(i64, Option<(Expr, Sentence)>), Refused> {
    let domains = &stage.scene.domains;
    let body = &stage.scene.bodies[turn.body].name;
    let begins = sign(spin, domains);
    let declared = turn.clockwise.map(|c| if c { -1 } else { 1 });
    let seen = if begins.is_positive() || begins == Seen::Proved(Sign::NotNegative) {
        Some(1)
    } else if begins.is_negative() || begins == Seen::Proved(Sign::NotPositive) {
        Some(-1)
    } else {
        None
    };
    let sense_words = |s: i64| {
        if s > 0 {
            "counterclockwise"
        } else {
            "clockwise"
        }
    };
    match (declared, seen) {
        (Some(d), Some(s)) if d != s => Err(Refused::new(
            &stage.name,
            format!(
                "`{body}` begins to turn {}, not {}",
                sense_words(s),
                sense_words(d)
            ),
            "the motion handed on decides the sense; leave `clockwise` out, or look at the stage before",
        )),
        (Some(d), None) if begins == Seen::Proved(Sign::Zero) && turn.torque.is_none() => {
            // From rest a body goes where its weight pulls it.
            let r = minus(&turn.lump(&stage.scene).center, &turn.about);
            let pull = match &turn.gravity {
                Some(_) => sign(&(&Expr::from(-d) * &r[0]), domains),
                None => Seen::Mixed,
            };
            if let Seen::Proved(Sign::Negative | Sign::NotPositive) = pull {
                return Err(Refused::new(
                    &stage.name,
                    format!(
                        "`{body}` is at rest, and its weight turns it {}, not {}",
                        sense_words(-d),
                        sense_words(d)
                    ),
                    "leave `clockwise` out, or give it a spin",
                ));
            }
            Ok((d, None))
        }
        (Some(d), _) => Ok((d, None)),
        (None, Some(s)) => Ok((s, None)),
        (None, None) if begins == Seen::Proved(Sign::Zero) => from_rest(stage, turn),
        // A spin of either sign keeps it: the end is told for a positive one, where values do not say otherwise.
        (None, None) => {
            let way = match constant(&spin.substitute(&given(&stage.scene))) {
                Some(Sign::Negative) => -1,
                _ => 1,
            };
            let words = sentence!["`", body, "` turns ", sense_words(way)];
            Ok((way, Some((&Expr::from(way) * spin, words))))
        }
    }
}

/// Which way a body at rest begins to turn, by its moments; values that are given decide where the domains leave it open.
fn from_rest(stage: &Stage, turn: &Turn) -> Result<(i64, Option<(Expr, Sentence)>), Refused> {
    let body = &stage.scene.bodies[turn.body].name;
    if turn.torque.is_some() {
        return Ok((1, None));
    }
    let moment = match turn.gravity {
        Some(_) => -&minus(&turn.lump(&stage.scene).center, &turn.about)[0],
        None => Expr::zero(),
    };
    let told = match sign(&moment, &stage.scene.domains) {
        Seen::Proved(Sign::NotNegative) => Some(true),
        Seen::Proved(Sign::NotPositive) => Some(false),
        seen => seen.side(),
    };
    if let Some(left) = told {
        return Ok((if left { 1 } else { -1 }, None));
    }
    let way = match constant(&moment.substitute(&given(&stage.scene))) {
        Some(Sign::Positive) => 1,
        Some(Sign::Negative) => -1,
        _ => {
            return Err(Refused::new(
                &stage.name,
                format!("`{body}` is at rest, and nothing says which way it begins to turn"),
                "add \"clockwise\": true or false, a moment, or the domain or value of the angle at which it begins",
            ));
        }
    };
    let need = tidied(stage, &(&Expr::from(way) * &moment))?;
    let words = sentence![
        crate::answer::calc::at_least_zero(&need, &stage.scene.domains),
        ", so that `",
        body,
        "` begins to turn as it does at the values given"
    ];
    Ok((way, Some((need, words))))
}

/// A particle that goes round a point has no spin of its own, but an angular velocity about the point.
fn whirl(stage: &Stage, before: &mut State, turn: &Turn) -> Result<(), Refused> {
    for b in turn.bodies() {
        if stage.scene.bodies[b].is_particle() {
            let r = minus(&stage.scene.bodies[b].center, &turn.about);
            let square = tidied(stage, &dot(&r, &r))?;
            if square.is_zero() {
                continue;
            }
            let about = &cross(&r, &before.velocity[b]) / &square;
            before.spin[b] = tidied(stage, &about)?;
        }
    }
    Ok(())
}

/// Every body that turns moves as a rotation about the point has it.
fn fits(stage: &Stage, before: &State, turn: &Turn, spin: &Expr) -> Result<(), Refused> {
    for b in turn.bodies() {
        let body = &stage.scene.bodies[b];
        let r = minus(&body.center, &turn.about);
        let needed = [-(spin * &r[1]), spin * &r[0]];
        let mut gaps: Vec<Expr> = (0..2)
            .map(|k| &before.velocity[b][k] - &needed[k])
            .collect();
        if !body.is_particle() {
            gaps.push(&before.spin[b] - spin);
        }
        let moves = |gap: &Expr| is_zero(gap, &stage.scene.domains) == Some(false);
        if gaps.iter().any(moves) && b != turn.body {
            return Err(Refused::new(
                &stage.name,
                format!(
                    "`{}` does not begin to turn like `{}`",
                    body.name, stage.scene.bodies[turn.body].name
                ),
                "bodies turn along together after an impact in which they stick; what stuck before holds on in a later impact where a contact says so there, too",
            ));
        }
        if gaps.iter().any(moves) {
            return Err(Refused::new(
                &stage.name,
                format!(
                    "at its beginning the point {} of `{}` moves, so the body does not turn about it, and energy cannot carry over the jump that stops it",
                    turn.about_name, body.name
                ),
                "put an impact before it, in which the point is caught, or begin with a velocity {\"about\": …}",
            ));
        }
    }
    Ok(())
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

/// What is needed to get over the highest place on the way, where a rotation by an angle passes it: energy compares the
/// ends only.
fn hurdle(
    stage: &Stage,
    turn: &Turn,
    r: &Vector,
    start: &Expr,
    way: i64,
) -> Result<Option<(Option<Expr>, Sentence)>, Refused> {
    let Some(g) = &turn.gravity else {
        return Ok(None);
    };
    let zero = Expr::zero();
    let by = match &turn.until {
        Until::By(by) => by,
        // From rest its weight draws it down, not over the top.
        Until::Below if start.is_zero() && turn.torque.is_none() && turn.clockwise.is_none() => {
            return Ok(None);
        }
        Until::Above | Until::Below => &zero,
        Until::For(_) | Until::Stops => return Ok(None),
    };
    if turn.torque.is_some() {
        let words = sentence![
            "the body does not come to rest on the way through `",
            &stage.name,
            "`"
        ];
        return Ok(Some((None, words)));
    }
    if matches!(turn.until, Until::Above) {
        return Ok(None);
    }
    let names = [&r[0], &r[1], by].into_iter().flat_map(|e| e.symbols());
    let points = integrate::points_of(names.collect(), &stage.scene.domains, 12);
    // Where the stages before do not come to their ends there is nothing to see.
    let seen: Vec<bool> = points
        .iter()
        .filter_map(|point| {
            let [x, y, by] = [&r[0], &r[1], by].map(|e| e.evaluate(point));
            let (x, y, by) = (x?, y?, by?);
            let to_top = (way as f64 * x).atan2(y).rem_euclid(std::f64::consts::TAU);
            Some(match turn.until {
                Until::Below => to_top < std::f64::consts::PI,
                _ => by > to_top,
            })
        })
        .collect();
    if !seen.is_empty() && !seen.contains(&true) {
        return Ok(None);
    }
    let body = &stage.scene.bodies[turn.body];
    let climb = &dot(r, r).sqrt() - &r[1];
    let mass = turn.lump(&stage.scene).mass;
    let left = tidied(stage, &(start - &(&(&mass * g) * &climb)))?;
    match sign(&left, &stage.scene.domains) {
        Seen::Proved(s) if s.is_not_negative() => Ok(None),
        Seen::Proved(Sign::Negative) => Err(Refused::new(
            &stage.name,
            format!(
                "`{}` does not get over the highest place on its way: its kinetic energy there would be {}",
                body.name,
                crate::formula::write_plain(&left)
            ),
            "end the stage before, or give it more energy",
        )),
        _ => {
            let words = sentence![
                "where the way through `",
                &stage.name,
                "` leads over its highest place, ",
                crate::answer::calc::at_least_zero(&left, &stage.scene.domains),
                ", so that `",
                &body.name,
                "` gets over it"
            ];
            Ok(Some((Some(left), words)))
        }
    }
}

/// Whether a body at rest has no moment to start it.
fn is_balanced(stage: &Stage, turn: &Turn, spin: &Expr, arm: &Vector) -> bool {
    let zero = |e: &Expr| is_zero(e, &stage.scene.domains) == Some(true);
    turn.gravity.is_some() && turn.torque.is_none() && zero(spin) && zero(&arm[0])
}
