//! How far a rotation raises a center of mass that ends straight above or below the point about which it turns: the work of the
//! weight is by that height.

use super::Page;
use crate::answer::calc::sign;
use crate::expr::{Expr, dot, minus};
use crate::scene::{Stage, StageKind, Until};
use crate::solution::neat::tidied;
use crate::solution::words::{self, say};
use crate::story::StageTold;

impl Page<'_> {
    /// Says where such a rotation ends, and the height that follows from that.
    pub(super) fn height(&mut self, stage: &Stage, told: &StageTold) {
        let StageKind::Turn(turn) = &stage.kind else {
            return;
        };
        let (end, up) = match turn.until {
            Until::Above => ("above", Expr::one()),
            Until::Below => ("below", -Expr::one()),
            _ => return,
        };
        // Of a particle its string or its track says it.
        let at = |b: &usize| minus(&stage.scene.bodies[*b].center, &turn.about);
        let is_away = |b: &usize| !at(b).iter().all(Expr::is_zero);
        let bodies: Vec<usize> = turn.bodies().into_iter().filter(is_away).collect();
        let is_extended = |b: &usize| !stage.scene.bodies[*b].is_particle();
        if turn.gravity.is_none() || !bodies.iter().any(is_extended) || told.work.len() != 1 {
            return;
        }
        let arm = match bodies.as_slice() {
            [only] => at(only),
            _ if bodies.len() < turn.bodies().len() => return,
            _ => minus(&turn.lump(&stage.scene).center, &turn.about),
        };
        let far = tidied(self.scene, &dot(&arm, &arm).sqrt());
        let rise = tidied(self.scene, &(up * &far - &arm[1]));
        if rise.is_zero() {
            return;
        }
        let falls = sign(&rise, &stage.scene.domains).is_negative();
        let (verb, height) = match falls {
            true => (" from there: it has sunk by ", tidied(self.scene, &-&rise)),
            false => (" from there: it has risen by ", rise),
        };
        let center = match bodies.as_slice() {
            [_] => format!(
                "the center of mass of {}",
                words::bodies(self.scene, &bodies)
            ),
            _ => format!(
                "the common center of mass of {}",
                words::bodies(self.scene, &bodies)
            ),
        };
        let about = &turn.about_name;
        let start = format!("At the end {center} is straight {end} {about}, at the distance ");
        let text = vec![
            say(start),
            words::formula(&far),
            say(verb),
            words::formula(&height),
            say("."),
        ];
        self.solution.text(text);
    }
}
