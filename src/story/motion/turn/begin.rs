//! How a rotation begins: in which sense, and whether the motion before it fits.

use super::super::tidied;
use crate::algebra::Sign;
use crate::answer::calc::{Seen, at_least_zero, beyond_zero, constant, is_zero, sign};
use crate::expr::{Expr, Vector, cross, dot, minus};
use crate::formula::{Sentence, sentence};
use crate::scene::{Stage, Turn};
use crate::story::{Refused, State};

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
    match (declared, side(begins)) {
        (Some(d), Some(s)) if d != s => Err(Refused::new(
            &stage.name,
            format!(
                "`{body}` begins to turn {}, not {}",
                sense_words(s),
                sense_words(d)
            ),
            "the motion handed on decides the sense; leave `clockwise` out, or look at the stage before",
        )),
        (Some(d), None) if begins == Seen::Proved(Sign::Zero) => from_rest(stage, turn, Some(d)),
        (Some(d), Some(_)) => Ok((d, None)),
        (None, Some(s)) => Ok((s, None)),
        (None, None) if begins == Seen::Proved(Sign::Zero) => from_rest(stage, turn, None),
        // A spin of either sign keeps it.
        (declared, None) => {
            let way = declared.unwrap_or_else(|| supposed(stage, spin));
            let need = &Expr::from(way) * spin;
            // Without a force it has to turn already.
            let is_steady = turn.gravity.is_none() && turn.torque.is_none();
            let condition = beyond_zero(&need, domains, is_steady);
            let turns = sentence!("`{}` turns {}", body, sense_words(way));
            let words = sentence!("{}, so that {}", condition, turns);
            Ok((way, Some((need, words))))
        }
    }
}

/// The sense that a sign gives.
fn side(spin: Seen) -> Option<i64> {
    if spin.is_positive() || spin == Seen::Proved(Sign::NotNegative) {
        Some(1)
    } else if spin.is_negative() || spin == Seen::Proved(Sign::NotPositive) {
        Some(-1)
    } else {
        None
    }
}

/// The sense of a spin of open sign, as which it is told: counterclockwise, where values do not say otherwise.
fn supposed(stage: &Stage, spin: &Expr) -> i64 {
    match constant(&spin.substitute(&stage.scene.values())) {
        Some(Sign::Negative) => -1,
        _ => 1,
    }
}

/// The sense in which what nothing acts on turns, 1 counterclockwise and −1 clockwise.
pub(in crate::story::motion) fn free_sense(stage: &Stage, spin: &Expr) -> i64 {
    side(sign(spin, &stage.scene.domains)).unwrap_or_else(|| supposed(stage, spin))
}

/// The sense in words.
pub(in crate::story::motion) fn sense_words(way: i64) -> &'static str {
    if way > 0 {
        "counterclockwise"
    } else {
        "clockwise"
    }
}

/// Which way a body at rest begins to turn, by its weight; what is declared has to agree with it, and values that are given
/// decide where nothing is declared and the domains leave it open.
fn from_rest(
    stage: &Stage,
    turn: &Turn,
    declared: Option<i64>,
) -> Result<(i64, Option<(Expr, Sentence)>), Refused> {
    let body = &stage.scene.bodies[turn.body].name;
    let moment = match turn.gravity {
        Some(_) => -&minus(&turn.lump(&stage.scene).center, &turn.about)[0],
        None => Expr::zero(),
    };
    if let Some(torque) = &turn.torque {
        return driven(stage, turn, declared, [torque, &moment]);
    }
    let told = match sign(&moment, &stage.scene.domains) {
        Seen::Proved(Sign::NotNegative) => Some(true),
        Seen::Proved(Sign::NotPositive) => Some(false),
        seen => seen.side(),
    };
    let told = told.map(|left| if left { 1 } else { -1 });
    let way = match (told, declared) {
        (Some(way), Some(d)) if way != d => {
            let why = format!(
                "`{body}` is at rest, and its weight turns it {}, not {}",
                sense_words(way),
                sense_words(d)
            );
            let hint = "leave `clockwise` out, or give it a spin";
            return Err(Refused::new(&stage.name, why, hint));
        }
        (Some(way), _) => return Ok((way, None)),
        // What nothing pulls, or what stands in balance, goes where it is told to.
        (None, Some(d)) if is_zero(&moment, &stage.scene.domains) == Some(true) => {
            return Ok((d, None));
        }
        (None, Some(d)) => d,
        (None, None) => match constant(&moment.substitute(&stage.scene.values())) {
            Some(Sign::Positive) => 1,
            Some(Sign::Negative) => -1,
            _ => {
                let why =
                    format!("`{body}` is at rest, and nothing says which way it begins to turn");
                let hint = "add \"clockwise\": true or false, a moment, or the domain or value of the angle at which it begins";
                return Err(Refused::new(&stage.name, why, hint));
            }
        },
    };
    let need = tidied(stage, &(&Expr::from(way) * &moment))?;
    let condition = at_least_zero(&need, &stage.scene.domains);
    let words = match declared {
        Some(_) => sentence!(
            "{}, so that `{}` begins to turn {}",
            condition,
            body,
            sense_words(way)
        ),
        None => sentence!(
            "{}, so that `{}` begins to turn as it does at the values given",
            condition,
            body
        ),
    };
    Ok((way, Some((need, words))))
}

/// The same where a moment acts in the sense of the rotation: it has to overcome the weight where this is against it.
fn driven(
    stage: &Stage,
    turn: &Turn,
    declared: Option<i64>,
    [torque, arm]: [&Expr; 2],
) -> Result<(i64, Option<(Expr, Sentence)>), Refused> {
    let body = &stage.scene.bodies[turn.body].name;
    let Some(g) = turn.gravity.as_ref().filter(|_| !arm.is_zero()) else {
        return Ok((declared.unwrap_or(1), None));
    };
    let Some(way) = declared else {
        let why = format!(
            "`{body}` is at rest, and whether its moment turns it with its weight or against it is not said"
        );
        let hint = "add \"clockwise\": true or false: the moment acts in the sense of the rotation";
        return Err(Refused::new(&stage.name, why, hint));
    };
    let weight = &(&turn.lump(&stage.scene).mass * g) * arm;
    let need = tidied(stage, &(torque + &(&Expr::from(way) * &weight)))?;
    let needed = match sign(&need, &stage.scene.domains) {
        Seen::Proved(s) if s.is_not_negative() => None,
        _ => {
            let condition = at_least_zero(&need, &stage.scene.domains);
            let sense = sense_words(way);
            let words = sentence!("{}, so that `{}` begins to turn {}", condition, body, sense);
            Some((need, words))
        }
    };
    Ok((way, needed))
}

/// A particle that goes round a point has no spin of its own, but an angular velocity about the point.
pub(super) fn whirl(stage: &Stage, before: &mut State, turn: &Turn) -> Result<(), Refused> {
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
pub(super) fn fits(stage: &Stage, before: &State, turn: &Turn, spin: &Expr) -> Result<(), Refused> {
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
            let why = format!(
                "`{}` does not begin to turn like `{}`",
                body.name, stage.scene.bodies[turn.body].name
            );
            let hint = "bodies turn along together after an impact in which they stick; what stuck before holds on in a later impact where a contact says so there, too";
            return Err(Refused::new(&stage.name, why, hint));
        }
        if gaps.iter().any(moves) {
            let why = format!(
                "at its beginning the point {} of `{}` moves, so the body does not turn about it, and energy cannot carry over the jump that stops it",
                turn.about_name, body.name
            );
            let hint = "put an impact before it, in which the point is caught, or begin with a velocity {\"about\": …}";
            return Err(Refused::new(&stage.name, why, hint));
        }
    }
    Ok(())
}

/// Whether a body at rest has no moment to start it.
pub(super) fn is_balanced(stage: &Stage, turn: &Turn, spin: &Expr, arm: &Vector) -> bool {
    let zero = |e: &Expr| is_zero(e, &stage.scene.domains) == Some(true);
    turn.gravity.is_some() && turn.torque.is_none() && zero(spin) && zero(&arm[0])
}
