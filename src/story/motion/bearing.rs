//! The direction of a vector as an angle a person would write.

use crate::algebra::Sign;
use crate::answer::calc::{Seen, is_zero, sign};
use crate::domain::Domains;
use crate::expr::{Expr, Function, Vector, cross, dot};
use crate::scene::direction;

/// The angle of a vector, counterclockwise from x and up to whole turns: a multiple of π/2, the angle of the body or a
/// multiple of π/2 from it, else an arc tangent; `None` where no sign decides the quadrant.
pub(super) fn bearing(r: &Vector, angle: &Expr, domains: &Domains) -> Option<Expr> {
    let quarters = (0..4).map(|k| Expr::ratio(k, 2) * Expr::pi());
    let from_body = quarters.clone().map(|q| angle + &q);
    for phi in from_body.chain(quarters) {
        let n = direction(&phi);
        if is_zero(&cross(&n, r), domains) == Some(true)
            && sign(&dot(&n, r), domains) == Seen::Proved(Sign::Positive)
        {
            return Some(phi);
        }
    }
    let slope = Expr::call(Function::Atan, &r[1] / &r[0]);
    match sign(&r[0], domains) {
        Seen::Proved(Sign::Positive) => Some(slope),
        Seen::Proved(Sign::Negative) => Some(&slope + &Expr::pi()),
        _ => None,
    }
}
