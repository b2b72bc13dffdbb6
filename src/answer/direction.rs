//! The direction of a velocity: its angle from the x axis, in the quarter that the signs of its components tell.

use super::Work;
use super::calc::{Seen, above_zero, sign, tidy};
use super::{Answer, Check, Form, Refused};
use crate::algebra::Sign;
use crate::domain::Domains;
use crate::expr::{Expr, Function, Node, Vector};
use crate::formula::{Sentence, sentence};

/// The angle of which a formula is the tangent, where it lies within a quarter turn of zero.
fn angle_of(tangent: &Expr, domains: &Domains) -> Option<Expr> {
    let angle = tangent.factors().iter().find_map(|f| match f.node() {
        Node::Call(Function::Sin, angle) => Some(angle),
        _ => None,
    })?;
    let quarter = Expr::pi() * Expr::ratio(1, 2);
    let room = [&quarter - angle, &quarter + angle];
    let is_within = |room: &Expr| sign(room, domains) == Seen::Proved(Sign::Positive);
    (*tangent == angle.sin() / angle.cos() && room.iter().all(is_within)).then(|| angle.clone())
}

impl Work<'_> {
    /// The angle of a direction, as the proved signs of its components tell in which quarter it lies; where they tell nothing, by
    /// that of its half.
    pub(super) fn direction(
        &self,
        half: &Expr,
        parts: &Vector,
        meaning: &str,
    ) -> Result<Answer, Refused> {
        let mut out = self.blank(meaning);
        let domains = &self.scene.domains;
        let [x, y] = [self.put(&parts[0], &[])?, self.put(&parts[1], &[])?];
        let (x_sign, y_sign) = (sign(&x, domains), sign(&y, domains));
        use Sign::{Negative, Positive, Zero};
        let quarter = || Expr::pi() * Expr::ratio(1, 2);
        let tidied =
            |e: &Expr| tidy(e, domains).map_err(|stop| Refused::uncalculated(self.name, stop));
        let arc = |above: &Expr, below: &Expr| {
            let tangent = tidied(&(above / below))?;
            let is_along = tangent.is_zero().then(Expr::zero);
            let angle = is_along.or_else(|| angle_of(&tangent, domains));
            Ok(angle.unwrap_or_else(|| tangent.atan()))
        };
        let mut is_by_quarter = true;
        let angle = match (x_sign, y_sign) {
            (Seen::Proved(Zero), Seen::Proved(Zero)) => {
                return Ok(out.leave_open(sentence!("what is at rest moves in no direction")));
            }
            (Seen::Proved(Positive), _) => arc(&y, &x)?,
            (Seen::Proved(Negative), Seen::Proved(Negative)) => arc(&y, &x)? - Expr::pi(),
            (Seen::Proved(Negative), _) => Expr::pi() - arc(&y, &-&x)?,
            (_, Seen::Proved(Positive)) => quarter() - arc(&x, &y)?,
            (_, Seen::Proved(Negative)) => -quarter() - arc(&x, &y)?,
            (_, Seen::Proved(Zero)) => {
                out.assumptions.push(above_zero(&x, domains));
                Expr::zero()
            }
            _ => {
                is_by_quarter = false;
                let against_x = "the velocity does not point straight against x";
                out.assumptions.push(Sentence::words(against_x));
                tidied(&half.substitute(self.known))?
            }
        };
        // An angle known by heart is told as such: atan(1) − π as −3π/4.
        out.form = Form::value(match angle.is_constant() {
            true => tidied(&angle)?,
            false => angle,
        });
        let words = match is_by_quarter {
            true => {
                "its tangent is the quotient of the components, whose signs are proved and tell the quarter"
            }
            false => {
                "the tangent of its half is the component across x over the sum of the speed and that along x"
            }
        };
        out.checks.push(Check::new("identity", words, Some(true)));
        Ok(out)
    }
}
