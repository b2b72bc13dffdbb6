//! How high a rotation gets under its weight: where it comes to rest, and whether it gets over the highest place.

use super::super::bearing::{aligned, from_below};
use super::super::{half, tidied};
use super::{inertia_about, sense};
use crate::algebra::Sign;
use crate::answer::calc::{Seen, is_zero, sign, tidy};
use crate::expr::{Expr, Function, Vector, dot};
use crate::formula::{Sentence, sentence};
use crate::scene::{Stage, Turn, Until};
use crate::story::{Refused, integrate};

/// Where the arm to the center of mass points when weight has brought the body to rest, as it would be for a rotation
/// counterclockwise: to the right of the fixed point, on the way up.
pub(super) fn highest(stage: &Stage, turn: &Turn, spin: &Expr, r: &Vector) -> Vector {
    let lump = turn.lump(&stage.scene);
    let weight = &lump.mass * turn.gravity.as_ref().unwrap_or(&Expr::zero());
    let climb = &half(&(&inertia_about(stage, turn) * &spin.powi(2))) / &weight;
    let y = &r[1] + &climb;
    let x = (&dot(r, r) - &y.powi(2)).sqrt();
    [x, y]
}

/// The angle through which a body swings until weight has brought it to rest, counterclockwise; `None` where the direction of
/// its arm at the beginning cannot be written.
pub(super) fn swung(stage: &Stage, turn: &Turn, spin: &Expr, r: &Vector) -> Option<Expr> {
    let domains = &stage.scene.domains;
    let (way, _) = sense(stage, spin, turn).ok()?;
    let angle = &stage.scene.bodies[turn.body].angle;
    let half_turn = Expr::pi();
    // From straight below, in the sense of the rotation, within half a turn either way.
    let begins = match aligned(r, angle, domains) {
        None => Expr::from(way) * from_below(r, domains)?,
        Some(bearing) => {
            let begins = &Expr::from(way) * &(bearing + half(&half_turn));
            let within = |e: &Expr| {
                let gaps = [e + &half_turn, &half_turn - e];
                gaps.iter().all(|gap| sign(gap, domains).is_not_negative())
            };
            let mut turns = [0, -2, 2]
                .map(|k| &begins + &(Expr::from(k) * Expr::pi()))
                .into_iter();
            turns.find(within)?
        }
    };
    let [_, y] = highest(stage, turn, spin, r);
    let length = dot(r, r).sqrt();
    // The cosine less what it loses on the way up reads better than one fraction.
    let [from, rise] = [&r[1] / &length, (&y - &r[1]) / &length].map(|e| tidy(&e, domains));
    let (from, rise, begins) = (from.ok()?, rise.ok()?, tidy(&begins, domains).ok()?);
    let level = tidy(&(half(&half_turn) - &begins), domains).ok()?;
    // Counted from the level of the fixed point where the beginning is.
    let swings = match level.mentions("pi") {
        false => level + Expr::call(Function::Asin, from + rise),
        true => Expr::call(Function::Acos, -from - rise) - begins,
    };
    Some(Expr::from(way) * swings)
}

/// What must hold so that a body comes to rest: for weight, that it does not get over the highest place; for a moment, that it
/// works against the rotation.
pub(super) fn stops(
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
            // Each side is kept as it is: a condition reads by them.
            let [climb, start] = [&(&(&lump.mass * g) * &climb), start].map(|e| tidied(stage, e));
            (&climb? - &start?, "it does not go over the top")
        }
    };
    match sign(&left, domains) {
        Seen::Proved(Sign::Positive) => Ok(None),
        Seen::Proved(Sign::Negative | Sign::Zero | Sign::NotPositive) => Err(refused(
            "never comes to rest: it has energy enough to get round, or is driven on",
            "end the stage with `by`, or `until` it is above or below",
        )),
        _ => {
            let least = crate::answer::calc::above_zero(&left, domains);
            let words = sentence!("{}, so that {}", least, why);
            Ok(Some((Some(left), words)))
        }
    }
}

/// What is needed to get over the highest place on the way, where a rotation by an angle passes it: energy compares the
/// ends only.
pub(super) fn hurdle(
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
        let words = sentence!(
            "the body does not come to rest on the way through `{}`",
            &stage.name
        );
        return Ok(Some((None, words)));
    }
    if matches!(turn.until, Until::Above) {
        return Ok(None);
    }
    let names = [&r[0], &r[1], by].into_iter().flat_map(|e| e.symbols());
    let points = integrate::points_of(names.collect(), &stage.scene.domains, 12);
    // Where the stages before do not come to their ends there is nothing to see.
    let seen: Vec<bool> = points
        .filter_map(|point| {
            let [x, y, by] = [&r[0], &r[1], by].map(|e| e.evaluate(&point));
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
            match seen.contains(&false) {
                true => {
                    "end the stage before it: with `\"until\": \"stops\"`, or by a domain that keeps `by` below it; or give it more energy"
                }
                false => {
                    "end the stage before it, as with `\"until\": \"stops\"`, or give it more energy"
                }
            },
        )),
        _ => {
            let least = crate::answer::calc::at_least_zero(&left, &stage.scene.domains);
            if !seen.contains(&false) {
                let words = sentence!("{}, so that `{}` gets over the top", least, &body.name);
                return Ok(Some((Some(left), words)));
            }
            // Whether it passes there at all depends on values. On its way down to below it does where it begins on the side on
            // which it rises; the larger of two is not negative where one of them is not.
            let need = match &turn.until {
                Until::Below => {
                    let falling = -(&r[0] * &Expr::from(way));
                    let above = &left / &(&mass * g);
                    let gap = Expr::call(Function::Abs, &falling - &above);
                    Some(tidied(stage, &(&(&falling + &above) + &gap))?)
                }
                _ => None,
            };
            let words = sentence!(
                "the way through `{}` does not lead over its highest place, or {}, so that `{}` gets over it",
                &stage.name,
                least,
                &body.name
            );
            Ok(Some((need, words)))
        }
    }
}
