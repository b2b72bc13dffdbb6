//! Motions between impacts: rotation about a point, sliding, falling, a rope that winds up. Work changes kinetic energy,
//! and where the time has a closed form everything that moves is carried on by it.
//!
//! In: a stage and the motion it begins with. Out: the motion it ends with, what is conserved and why, the time it takes.

mod bearing;
mod fall;
mod meanwhile;
mod slide;
mod turn;
mod wind;

pub(super) use fall::fall;
pub(super) use slide::slide;
pub(super) use turn::{arms, inertia_about, sense, turn};
pub(super) use wind::wind;

use super::calc::{Seen, tidy};
use super::{Kept, Refused, StageTold, State};
use super::{Sentence, sentence::sentence};
use crate::expr::Expr;
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

fn told(stage: &Stage, before: State, after: State) -> StageTold {
    StageTold {
        name: stage.name.clone(),
        placed: stage.clone(),
        branch: None,
        given: Vec::new(),
        time: None,
        needs: Vec::new(),
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

/// A motion that begins with something that is not determined: where it leads is open as well.
pub(super) fn open(stage: &Stage, before: State) -> Option<StageTold> {
    let moved = stage.kind.moved();
    let scene = &stage.scene;
    let mut reason = None;
    for &b in &moved {
        let parts = before.center[b].iter().chain(&before.velocity[b]);
        reason = reason.or_else(|| before.why_open(parts.chain([&before.spin[b]])));
    }
    let why = reason?;
    let mut after = before.clone();
    for b in moved {
        after.lose(scene, b, &why, true);
    }
    meanwhile::others(stage, &before, &mut after, None);
    let mut out = told(stage, before, after);
    out.words = vec![sentence!["where this leads is open: ", &why]];
    Some(out)
}
