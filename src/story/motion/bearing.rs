//! The direction of a vector as an angle a person would write.

use crate::algebra::Sign;
use crate::answer::calc::{Seen, is_zero, sign};
use crate::domain::Domains;
use crate::expr::{Expr, Function, Vector, cross, dot};
use crate::scene::direction;

/// The angle of a vector, counterclockwise from x and up to whole turns: a multiple of π/2, the angle of the body or a
/// multiple of π/2 from it, else an arc tangent; `None` where no sign decides the quadrant.
pub(super) fn bearing(r: &Vector, angle: &Expr, domains: &Domains) -> Option<Expr> {
    let quarter = Expr::ratio(1, 2) * Expr::pi();
    aligned(r, angle, domains).or_else(|| match sign(&r[1], domains) {
        // Above, whichever side it is on.
        Seen::Proved(Sign::Positive) => Some(quarter.clone() + upright(r)),
        _ => Some(from_below(r, domains)? - &quarter),
    })
}

/// The angle of a vector from x as a multiple of π/2, the angle of the body or a multiple of π/2 from it.
pub(super) fn aligned(r: &Vector, angle: &Expr, domains: &Domains) -> Option<Expr> {
    let quarters = (0..4).map(|k| Expr::ratio(k, 2) * Expr::pi());
    let from_body = quarters.clone().map(|q| angle + &q);
    from_body.chain(quarters).find(|phi| {
        let n = direction(phi);
        is_zero(&cross(&n, r), domains) == Some(true)
            && sign(&dot(&n, r), domains) == Seen::Proved(Sign::Positive)
    })
}

/// The angle of a vector from straight below, counterclockwise and within half a turn, as an arc tangent; `None` where no sign
/// decides the quadrant.
pub(super) fn from_below(r: &Vector, domains: &Domains) -> Option<Expr> {
    let quarter = Expr::ratio(1, 2) * Expr::pi();
    if sign(&r[1], domains) == Seen::Proved(Sign::Negative) {
        return Some(upright(r));
    }
    let slope = Expr::call(Function::Atan, &r[1] / &r[0]);
    match sign(&r[0], domains) {
        Seen::Proved(Sign::Positive) => Some(slope + quarter),
        Seen::Proved(Sign::Negative) => Some(slope - quarter),
        _ => None,
    }
}

/// The angle of a line from the vertical, counterclockwise and within a quarter of a turn.
fn upright(r: &Vector) -> Expr {
    -Expr::call(Function::Atan, &r[0] / &r[1])
}
