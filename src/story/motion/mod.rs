//! Motions between impacts: rotation about a point, sliding with strings over pulleys, falling, linkages with one freedom, a
//! rope that winds up. Work changes kinetic energy,
//! and where the time has a closed form everything that moves is carried on by it.
//!
//! In: a stage and the motion it begins with. Out: the motion it ends with, what is conserved and why, the time it takes.

mod back;
mod bearing;
mod fall;
mod linkage;
mod meanwhile;
mod riders;
mod slide;
mod strings;
mod supposed;
mod turn;
mod wind;

pub(super) use back::{meets_again, stays_in_front, walls_are_there};
pub(super) use fall::fall;
pub(crate) use linkage::by_coordinate;
pub(super) use linkage::{accelerations, linkage};
pub(super) use riders::riders_stay;
pub(super) use slide::{slide, support};
pub(super) use turn::{angular, arms, pivot_force, sense, turn};
pub(super) use wind::wind;

use crate::answer::calc::{Seen, keeps_to, sign, tidy};
use crate::story::UNDETERMINED;

use super::{Kept, Refused, StageTold, State};
use crate::algebra::Sign;
use crate::expr::Expr;
use crate::formula::{Sentence, sentence};
use crate::scene::Stage;

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

/// A sum as one expression, or as it is where both parts are short and long under one denominator.
fn together(stage: &Stage, one: &Expr, other: &Expr) -> Result<Expr, Refused> {
    let joined = tidied(stage, &(one + other))?;
    let apart = one + other;
    Ok(match apart.size() < joined.size() {
        true => apart,
        false => joined,
    })
}

/// Kinetic energy at the end of a motion, with the work done on the way and what is known of its sign; refused where it
/// is negative.
fn balance(
    stage: &Stage,
    body: usize,
    start: &Expr,
    parts: &[(&'static str, Expr)],
) -> Result<(Expr, Expr, Seen), Refused> {
    let work = tidied(stage, &Expr::sum(parts.iter().map(|(_, w)| w.clone())))?;
    let end = together(stage, start, &work)?;
    let reaches = sign(&end, &stage.scene.domains);
    if let Seen::Proved(Sign::Negative | Sign::NotPositive) = reaches {
        return Err(never_arrives(stage, body, &end));
    }
    Ok((work, end, reaches))
}

/// Why a body does not get to the end of a motion at which its kinetic energy would be negative.
fn never_arrives(stage: &Stage, body: usize, end: &Expr) -> Refused {
    Refused::new(
        &stage.name,
        format!(
            "`{}` never gets there: its kinetic energy at the end would be {}, which is negative",
            stage.scene.bodies[body].name,
            crate::formula::write_plain(end)
        ),
        "end the stage earlier, or give it more energy",
    )
}

/// What must hold so that a body gets to the end of a motion with this kinetic energy; nothing where that is proved, or follows
/// from what is needed on the way.
fn arrival(
    stage: &Stage,
    body: usize,
    end: &Expr,
    (seen, needs): (Seen, &[Expr]),
) -> Option<Sentence> {
    let domains = &stage.scene.domains;
    let given = needs
        .iter()
        .fold(domains.clone(), |all, need| all.given(need, true));
    let follows = || !needs.is_empty() && keeps_to(end, true, &given) == Some(true);
    let proved = seen.is_not_negative() || follows();
    let need = || crate::answer::calc::at_least_zero(end, domains);
    (!proved).then(|| arrives(stage, body, need()))
}

/// What must hold, with what it is needed for.
fn arrives(stage: &Stage, body: usize, need: Sentence) -> Sentence {
    let name = &stage.scene.bodies[body].name;
    sentence!(
        "{}, so that `{}` gets to the end of `{}`",
        need,
        name,
        &stage.name
    )
}

/// What is granted of a body that is at rest and in balance when its motion begins.
fn pushed(body: &str) -> Sentence {
    sentence!(
        "a small push sets `{}` going: at rest and in balance it could stay",
        body
    )
}

/// A motion that begins with something that is not determined: where it leads is open as well.
pub(super) fn open(stage: &Stage, before: State) -> Option<StageTold> {
    let moved = stage.kind.moved();
    let scene = &stage.scene;
    let mut reason = None;
    for &b in &moved {
        let parts = before.center[b].iter().chain(&before.velocity[b]);
        let spin = Some(&before.spin[b]).filter(|_| !scene.bodies[b].is_light_pulley());
        reason = reason.or_else(|| before.why_open(parts.chain(spin)));
    }
    Some(leads_nowhere(stage, before, &reason?))
}

/// A motion of which it is not determined where it leads, and why.
pub(super) fn leads_nowhere(stage: &Stage, before: State, why: &str) -> StageTold {
    // Of a fault of the body it says that it does this.
    let why = why.replacen("`: it ", "` ", 1);
    let mut after = before.clone();
    for b in stage.kind.moved() {
        after.lose(&stage.scene, b, &why, true);
    }
    let time = fall::known(stage, &before, &mut after);
    meanwhile::others(stage, &before, &mut after, time.as_ref());
    let mut out = StageTold::new(stage, before, after);
    out.time = time;
    out.words = vec![match why.strip_suffix(UNDETERMINED) {
        Some(laws) => sentence!(
            "where this leads is open, since {} do not determine how it begins",
            laws
        ),
        None => sentence!("where this leads is open: {}", &why),
    }];
    out
}
