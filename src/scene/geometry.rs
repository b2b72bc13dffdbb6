//! Directions and rotations of the plane, as expressions a person would write.

use num_integer::Integer;
use num_traits::{Signed, Zero};

use crate::expr::angle::{Angle, angle};
use crate::expr::{Expr, Int, Vector, ratio};

/// The unit vector at an angle counterclockwise from x. Multiples of π/2 are taken out, and of ±φ the one is used that
/// does not start with a minus sign: the direction at π/2 + θ is (−sin θ, cos θ).
pub fn direction(e: &Expr) -> Vector {
    let Some(read) = angle(e) else {
        return [e.cos(), e.sin()];
    };
    let quarters = (&read.pi * ratio(2, 1)).floor();
    let rest = Angle {
        pi: &read.pi - &quarters / ratio(2, 1),
        symbols: read.symbols,
    };
    let is_turned = rest
        .symbols
        .values()
        .next()
        .is_some_and(Signed::is_negative);
    let sign = if is_turned { ratio(-1, 1) } else { ratio(1, 1) };
    let mut terms: Vec<Expr> = rest
        .symbols
        .iter()
        .map(|(name, k)| Expr::from(k * &sign) * Expr::symbol(name))
        .collect();
    if !rest.pi.is_zero() {
        terms.push(Expr::from(&rest.pi * &sign) * Expr::pi());
    }
    let phi = Expr::sum(terms);
    let (c, s) = (phi.cos(), if is_turned { -phi.sin() } else { phi.sin() });
    match quarters.to_integer().mod_floor(&Int::from(4)).as_i64() {
        Some(1) => [-s, c],
        Some(2) => [-c, -s],
        Some(3) => [s, -c],
        _ => [c, s],
    }
}

/// The velocity ω k × r of a point at r from a fixed point, in a body with spin ω.
pub(super) fn turned(spin: &Expr, r: &Vector) -> Vector {
    [-(spin * &r[1]), spin * &r[0]]
}

/// The zero vector.
pub(super) fn origin() -> Vector {
    [Expr::zero(), Expr::zero()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarter_turns_and_minus_signs_leave_the_angle() {
        let theta = Expr::symbol("theta");
        let (c, s) = (theta.cos(), theta.sin());
        let quarter = Expr::pi() * Expr::ratio(1, 2);
        for (angle, expected) in [
            (theta.clone(), [c.clone(), s.clone()]),
            (-&theta, [c.clone(), -&s]),
            (&quarter + &theta, [-&s, c.clone()]),
            (&quarter - &theta, [s.clone(), c.clone()]),
            (Expr::pi() + &theta, [-&c, -&s]),
            (quarter.clone(), [Expr::zero(), Expr::one()]),
            (-&quarter, [Expr::zero(), Expr::from(-1)]),
        ] {
            assert_eq!(direction(&angle), expected, "{angle:?}");
        }
    }
}
