//! Motions between impacts: rotation about a point, sliding, falling, a rope that winds up. Work changes kinetic energy.
//!
//! In: a stage and the motion it begins with. Out: the motion it ends with, what is conserved and why. Time plays no part:
//! work and energy connect places.

use super::calc::Seen;
use super::calc::{is_zero, sign, tidy};
use super::{Kept, Refused, StageTold, State, integrate};
use super::{Sentence, sentence::sentence};
use crate::algebra::Sign;
use crate::domain::Domains;
use crate::expr::{Expr, Vector, cross, dot, minus};
use crate::scene::{Fall, Slide, Stage, Turn, Until, Wind};

fn half(e: &Expr) -> Expr {
    &Expr::ratio(1, 2) * e
}

fn kept(what: &str, conserved: bool, why: &str) -> Kept {
    Kept {
        what: what.into(),
        conserved,
        why: why.into(),
    }
}

/// A tidy expression, or the limit that was met.
fn tidied(stage: &Stage, e: &Expr) -> Result<Expr, Refused> {
    tidy(e, &stage.scene.domains).map_err(|stop| Refused::stop(&stage.name, stop))
}

fn told(stage: &Stage, kind: &'static str, before: State, after: State) -> StageTold {
    StageTold {
        name: stage.name.clone(),
        kind,
        before,
        after,
        kept: Vec::new(),
        cases: Vec::new(),
        energy: None,
        kinetic: None,
        inertia: None,
        work: Vec::new(),
        words: Vec::new(),
        assumptions: Vec::new(),
        checks: Vec::new(),
    }
}

/// The arm from the fixed point to the center of mass, at the beginning and at the end.
pub(super) fn arms(stage: &Stage, turn: &Turn) -> [Vector; 2] {
    let r = minus(&turn.lump(&stage.scene).center, &turn.about);
    let r = r.map(|e| tidy(&e, &stage.scene.domains).unwrap_or(e));
    let length =
        tidy(&dot(&r, &r).sqrt(), &stage.scene.domains).unwrap_or_else(|_| dot(&r, &r).sqrt());
    let end = match &turn.until {
        Until::Above => [Expr::zero(), length],
        Until::Below => [Expr::zero(), -&length],
        Until::For(_) => r.clone(),
        Until::By(by) => {
            let (c, s) = (
                by.cos(),
                if turn.clockwise == Some(true) {
                    -by.sin()
                } else {
                    by.sin()
                },
            );
            [&(&r[0] * &c) - &(&r[1] * &s), &(&r[0] * &s) + &(&r[1] * &c)]
        }
    };
    [r, end]
}

/// Moment of inertia about the fixed point.
pub(super) fn inertia_about(stage: &Stage, turn: &Turn) -> Expr {
    let lump = turn.lump(&stage.scene);
    let r = minus(&lump.center, &turn.about);
    &lump.inertia + &(&lump.mass * &dot(&r, &r))
}

/// The sense of the rotation: 1 counterclockwise, −1 clockwise.
pub(super) fn sense(
    stage: &Stage,
    spin: &Expr,
    turn: &Turn,
) -> Result<(i64, Option<Sentence>), Refused> {
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
        (Some(d), _) => Ok((d, None)),
        (None, Some(s)) => Ok((s, None)),
        (None, None) if matches!(begins, Seen::Proved(Sign::Zero)) => {
            let r = minus(&turn.lump(&stage.scene).center, &turn.about);
            let pull = match (&turn.torque, &turn.gravity) {
                (Some(_), _) => Seen::Positive,
                (None, Some(_)) => sign(&-&r[0], domains),
                (None, None) => Seen::Mixed,
            };
            if pull.is_positive() {
                Ok((1, None))
            } else if pull.is_negative() {
                Ok((-1, None))
            } else {
                Err(Refused::new(
                    &stage.name,
                    format!("`{body}` is at rest, and nothing says which way it begins to turn"),
                    "add \"clockwise\": true or false, or a moment",
                ))
            }
        }
        // A spin of either sign keeps it: the end is told for a positive one.
        (None, None) => Ok((1, Some(sentence!["`", body, "` turns counterclockwise"]))),
    }
}

/// Rotation about a fixed point.
pub(super) fn turn(stage: &Stage, mut before: State, turn: &Turn) -> Result<StageTold, Refused> {
    let domains = &stage.scene.domains;
    let body = &stage.scene.bodies[turn.body];
    let lump = turn.lump(&stage.scene);
    whirl(stage, &mut before, turn)?;
    let spin = before.spin[turn.body].clone();
    let [r, r_end] = arms(stage, turn);
    fits(stage, &before, turn, &spin)?;
    let square = tidied(stage, &dot(&r, &r))?;
    let about = &tidied(stage, &lump.inertia)? + &(&lump.mass * &square);
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
    let mut work = Vec::new();
    if let Some(g) = &turn.gravity {
        let height = tidied(stage, &(&r[1] - &r_end[1]))?;
        work.push(("weight", &(&lump.mass * g) * &height));
    }
    if let Some(torque) = &turn.torque {
        let Until::By(by) = &turn.until else {
            return Err(Refused::new(
                &stage.name,
                "the work of a constant moment needs the angle it turns through",
                "end the stage with `by`",
            ));
        };
        work.push(("the applied moment", torque * by));
    }
    let parts = work;
    let work = tidied(stage, &Expr::sum(parts.iter().map(|(_, w)| w.clone())))?;
    let end = tidied(stage, &(&start + &work))?;
    let reaches = sign(&end, domains);
    if let Seen::Proved(Sign::Negative | Sign::NotPositive) = reaches {
        return Err(Refused::new(
            &stage.name,
            format!(
                "`{}` never gets there: its kinetic energy at the end would be {}, which is negative",
                body.name,
                crate::formula::write_plain(&end)
            ),
            "end the stage earlier, or give it more energy",
        ));
    }
    let (way, assumed) = sense(stage, &spin, turn)?;
    let mut assumptions: Vec<Sentence> =
        hurdle(stage, turn, &r, &start, way)?.into_iter().collect();
    if is_balanced(stage, turn, &spin, &r) {
        assumptions.push(sentence![
            "a small push sets `",
            &body.name,
            "` going: at rest and in balance it could stay"
        ]);
    }
    if let Until::By(by) = &turn.until {
        // Where bodies are at the end was put in before anything was known of their motion.
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
        match sign(by, domains) {
            Seen::Proved(s) if s.is_not_negative() => {}
            Seen::Proved(_) | Seen::Negative => {
                return Err(Refused::new(
                    &stage.name,
                    format!(
                        "`by` is the angle turned through, and {} is negative",
                        crate::formula::write_plain(by)
                    ),
                    "turn its sign round, and say \"clockwise\": true if it turns that way",
                ));
            }
            _ => assumptions.push(sentence![by, " ≥ 0"]),
        }
    }
    let spin_end = if work.is_zero() {
        spin.clone()
    } else {
        assumptions.extend(assumed);
        let size = (&(&Expr::from(2) * &end) / &inertia).sqrt();
        tidied(stage, &(&Expr::from(way) * &size))?
    };
    let mut after = before.clone();
    for b in turn.bodies() {
        let [x, y] = arm_at_end(stage, turn, b, &r, &r_end);
        after.center[b] = [&turn.about[0] + &x, &turn.about[1] + &y];
        after.velocity[b] = [
            tidied(stage, &-(&spin_end * &y))?,
            tidied(stage, &(&spin_end * &x))?,
        ];
        after.spin[b] = spin_end.clone();
    }
    let mut out = told(stage, "turn", before, after);
    let at = &turn.about_name;
    out.kept = vec![match (&turn.gravity, &turn.torque) {
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
    }];
    let moment = turn.gravity.is_some() || turn.torque.is_some();
    out.kept.push(kept(
        &format!("angular momentum about {at}"),
        !moment,
        if moment {
            "weight or the applied moment has a moment about it"
        } else {
            "no force has a moment about it"
        },
    ));
    out.kept.push(kept(
        "momentum",
        false,
        &format!("the force at {at} leads the center of mass round"),
    ));
    out.inertia = Some([about, inertia.clone()]);
    out.work = parts;
    out.kinetic = Some(half(&(&inertia * &out.after.spin[turn.body].powi(2))));
    out.energy = Some([start, end.clone()]);
    if !work.is_zero() {
        assumptions.extend(arrival(stage, &end, reaches));
    }
    out.assumptions = assumptions;
    out.checks.extend(integrate::turn(stage, &out, turn, way));
    Ok(out)
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
fn arm_at_end(stage: &Stage, turn: &Turn, body: usize, r: &Vector, r_end: &Vector) -> Vector {
    if turn.with.is_empty() {
        return r_end.clone();
    }
    let arm = minus(&stage.scene.bodies[body].center, &turn.about);
    let (c, s) = match (&turn.until, turn.clockwise) {
        (Until::By(by), Some(true)) => (by.cos(), -by.sin()),
        (Until::By(by), _) => (by.cos(), by.sin()),
        (Until::For(_), _) => return arm,
        _ => {
            let square = dot(r, r);
            (&dot(r, r_end) / &square, &cross(r, r_end) / &square)
        }
    };
    let end = [
        &(&arm[0] * &c) - &(&arm[1] * &s),
        &(&arm[0] * &s) + &(&arm[1] * &c),
    ];
    end.map(|e| tidy(&e, &stage.scene.domains).unwrap_or(e))
}

/// What is needed to get over the highest place on the way, where a rotation by an angle passes it: energy compares the
/// ends only.
fn hurdle(
    stage: &Stage,
    turn: &Turn,
    r: &Vector,
    start: &Expr,
    way: i64,
) -> Result<Option<Sentence>, Refused> {
    let (Until::By(by), Some(g)) = (&turn.until, &turn.gravity) else {
        return Ok(None);
    };
    if turn.torque.is_some() {
        return Ok(Some(sentence![
            "the body does not come to rest on the way through `",
            &stage.name,
            "`"
        ]));
    }
    let passes = integrate::points(stage, &[&r[0], &r[1], by], 12)
        .iter()
        .any(|point| {
            let values = [&r[0], &r[1], by].map(|e| e.evaluate(point));
            let [Some(x), Some(y), Some(by)] = values else {
                return true;
            };
            let to_top = (way as f64 * x).atan2(y).rem_euclid(std::f64::consts::TAU);
            by > to_top
        });
    if !passes {
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
        _ => Ok(Some(sentence![
            "where the way through `",
            &stage.name,
            "` leads over its highest place, ",
            &super::calc::essential(&left, &stage.scene.domains),
            " ≥ 0, so that `",
            &body.name,
            "` gets over it"
        ])),
    }
}

/// Motion along a line.
pub(super) fn slide(stage: &Stage, before: State, slide: &Slide) -> Result<StageTold, Refused> {
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
    let work = tidied(stage, &Expr::sum(parts.iter().map(|(_, w)| w.clone())))?;
    let end = tidied(stage, &(&start + &work))?;
    let reaches = sign(&end, domains);
    if let Seen::Proved(Sign::Negative | Sign::NotPositive) = reaches {
        return Err(Refused::new(
            &stage.name,
            format!("`{}` never gets there: it comes to rest before", body.name),
            "shorten the distance",
        ));
    }
    if !work.is_zero() {
        assumptions.extend(arrival(stage, &end, reaches));
    }
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
    let mut out = told(stage, "slide", before, after);
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
    out.checks.extend(integrate::slide(stage, &out, slide));
    Ok(out)
}

/// Whether a body at rest has no moment to start it.
pub(super) fn is_balanced(stage: &Stage, turn: &Turn, spin: &Expr, arm: &Vector) -> bool {
    let zero = |e: &Expr| is_zero(e, &stage.scene.domains) == Some(true);
    turn.gravity.is_some() && turn.torque.is_none() && zero(spin) && zero(&arm[0])
}

/// What must hold so that a motion gets to its end with this kinetic energy; nothing where that is proved.
fn arrival(stage: &Stage, end: &Expr, seen: Seen) -> Option<Sentence> {
    let proved = matches!(seen, Seen::Proved(s) if s.is_not_negative());
    (!proved).then(|| {
        sentence![
            "for what is told of the end of `",
            &stage.name,
            "`: ",
            &super::calc::essential(end, &stage.scene.domains),
            " ≥ 0, so that it gets there"
        ]
    })
}

/// Free fall or flight.
pub(super) fn fall(stage: &Stage, before: State, fall: &Fall) -> Result<StageTold, Refused> {
    let domains = &stage.scene.domains;
    let body = &stage.scene.bodies[fall.body];
    let [vx, vy] = before.velocity[fall.body].clone();
    let turning = half(&(&body.inertia * &before.spin[fall.body].powi(2)));
    let kinetic = |x: &Expr, y: &Expr| half(&(&body.mass * &(&x.powi(2) + &y.powi(2))));
    let start = tidied(stage, &(&kinetic(&vx, &vy) + &turning))?;
    let down = match (&fall.gravity, &fall.height, &fall.time) {
        (Some(g), Some(h), _) => {
            if is_zero(&vx, domains) == Some(false) {
                return Err(Refused::new(
                    &stage.name,
                    format!("`{}` moves sideways while it falls", body.name),
                    "a fall through a height is straight down; give a time `for`",
                ));
            }
            let square = tidied(stage, &(&vy.powi(2) + &(&(&Expr::from(2) * g) * h)))?;
            tidied(stage, &-square.sqrt())?
        }
        (Some(g), None, Some(t)) => tidied(stage, &(&vy - &(g * t)))?,
        (None, Some(_), _) => {
            return Err(Refused::new(
                &stage.name,
                "without gravity nothing falls through a height",
                "add \"gravity\": \"g\", or give a time `for`",
            ));
        }
        _ => vy.clone(),
    };
    let mut after = before.clone();
    after.velocity[fall.body] = [vx.clone(), down.clone()];
    if let Some(h) = &fall.height {
        after.center[fall.body][1] = &after.center[fall.body][1] - h;
    }
    let end = tidied(stage, &(&kinetic(&vx, &down) + &turning))?;
    let mut out = told(stage, "fall", before, after);
    out.kept = vec![
        kept(
            "energy",
            true,
            if fall.gravity.is_some() {
                "weight has a potential, and nothing else acts"
            } else {
                "no force acts"
            },
        ),
        kept(
            "spin",
            true,
            "no force has a moment about the center of mass",
        ),
        kept(
            "momentum",
            fall.gravity.is_none(),
            if fall.gravity.is_some() {
                "weight changes its vertical part"
            } else {
                "no force acts"
            },
        ),
    ];
    out.energy = Some([start, end]);
    if let (Some(g), Some(h)) = (&fall.gravity, &fall.height) {
        out.work = vec![("weight", &(&body.mass * g) * h)];
    }
    out.checks.extend(integrate::fall(stage, &out, fall));
    Ok(out)
}

/// A rope that winds round a pole.
pub(super) fn wind(stage: &Stage, before: State, wind: &Wind) -> Result<StageTold, Refused> {
    let domains: &Domains = &stage.scene.domains;
    let body = &stage.scene.bodies[wind.body];
    let v = before.velocity[wind.body].clone();
    let rope = minus(&stage.scene.bodies[wind.body].center, &wind.around);
    let free = tidied(stage, &dot(&rope, &rope).sqrt())?;
    if is_zero(&dot(&rope, &v), domains) == Some(false) {
        return Err(Refused::new(
            &stage.name,
            format!(
                "`{}` does not move straight across the rope, which would jerk",
                body.name
            ),
            "put an impact with a string before it, in which the rope becomes taut",
        ));
    }
    if let Seen::Proved(Sign::Negative) = sign(&(&free - &wind.to), domains) {
        return Err(Refused::new(
            &stage.name,
            "a rope that winds up gets shorter, and this gets longer",
            "exchange the lengths",
        ));
    }
    let speed = tidied(stage, &dot(&v, &v).sqrt())?;
    let mut after = before.clone();
    after.velocity[wind.body] = [Expr::zero(), speed.clone()];
    after.center[wind.body] = [&wind.around[0] + &wind.to, wind.around[1].clone()];
    let energy = tidied(stage, &half(&(&body.mass * &speed.powi(2))))?;
    let mut out = told(stage, "wind", before, after);
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
    out.assumptions = vec![Sentence::words(
        "the pole is thin against the rope, and the axes at the end are turned along the rope",
    )];
    out.checks
        .extend(integrate::wind(stage, &free, &speed, wind));
    Ok(out)
}
