//! Points of a scene's domain at which its formulas are tried: exact fractions, angles by rational points of the circle.
//!
//! In: parameters and domains. Out: points. A point is made from the parameter's name and a counter alone, so it depends
//! neither on the order of the file nor on chance.

use num_traits::One;

use super::Scene;
use super::parameters::limit_f64;
use crate::dimension;
use crate::domain::Domain;
use crate::expr::number::{from_f64, to_f64};
use crate::expr::{Expr, Point, Rational, Symbol, ratio};

/// How many points are tried. A formula that is zero at all of them without being zero everywhere would need as many
/// coincidences.
const POINTS: u64 = 8;

/// Angles are given by the direction of their half, so that sine and cosine of θ/2 are exact too.
const DIVISOR: u32 = 2;

/// Sample points, each as exact fractions and in doubles.
pub(super) fn points(scene: &Scene) -> Vec<(Point<Rational>, Point<f64>)> {
    (0..POINTS).map(|i| point(scene, i)).collect()
}

fn point(scene: &Scene, i: u64) -> (Point<Rational>, Point<f64>) {
    let (mut exact, mut double) = (Point::default(), Point::default());
    for parameter in &scene.parameters {
        let name = &parameter.name;
        let domain = scene.domains.symbols.get(name).cloned().unwrap_or_default();
        let chance = hash(name, i);
        let is_angle = parameter.dimension.is_none()
            && dimension::unit(&parameter.unit).is_ok_and(|u| u.angle);
        if is_angle {
            let (phi, half) = angle(&domain, chance);
            double.directions.insert(
                name.clone(),
                (DIVISOR, [to_f64(&half[0]), to_f64(&half[1])]),
            );
            double.values.insert(name.clone(), phi);
            exact.directions.insert(name.clone(), (DIVISOR, half));
        } else {
            set(&mut exact, &mut double, name, number(&domain, chance));
        }
    }
    for [x, y] in &scene.domains.unit_vectors {
        let t = ratio((hash(x, i) % 41) as i64 - 20, 10);
        let [c, s] = circle(&t);
        set(&mut exact, &mut double, x, c);
        set(&mut exact, &mut double, y, s);
    }
    (exact, double)
}

fn set(exact: &mut Point<Rational>, double: &mut Point<f64>, name: &Symbol, value: Rational) {
    double.values.insert(name.clone(), to_f64(&value));
    exact.values.insert(name.clone(), value);
}

/// The point of the unit circle that belongs to t = tan(φ/2).
fn circle(t: &Rational) -> [Rational; 2] {
    let square = t * t;
    let below = Rational::one() + &square;
    [(Rational::one() - &square) / &below, (t + t) / &below]
}

/// A number inside the domain.
fn number(domain: &Domain, chance: u64) -> Rational {
    let share = ratio(1 + (chance % 61) as i64, 63);
    let size = ratio(1 + (chance % 53) as i64, 1 + (chance / 53 % 7) as i64);
    let end = |limit: &crate::domain::Limit| match limit.of_pi {
        false => limit.value.clone(),
        // A fraction close by; the share keeps clear of the ends.
        true => {
            from_f64((limit_f64(limit) * 4096.0).round() / 4096.0).unwrap_or_else(Rational::one)
        }
    };
    match (&domain.low, &domain.high) {
        (Some(low), Some(high)) => {
            let (low, high) = (end(low), end(high));
            &low + &(&(&high - &low) * &share)
        }
        (Some(low), None) => end(low) + size,
        (None, Some(high)) => end(high) - size,
        (None, None) => {
            if chance / 7 % 2 == 0 {
                size
            } else {
                -size
            }
        }
    }
}

/// An angle inside the domain, and the direction of its half.
fn angle(domain: &Domain, chance: u64) -> (f64, [Rational; 2]) {
    use std::f64::consts::PI;
    let low = domain.low.as_ref().map(limit_f64);
    let high = domain.high.as_ref().map(limit_f64);
    // Beyond a full turn directions repeat; a piece of the domain one turn wide is enough.
    let (low, high) = match (low, high) {
        (None, None) => (-PI, PI),
        (Some(low), None) => (low, low + 2.0 * PI),
        (None, Some(high)) => (high - 2.0 * PI, high),
        (Some(low), Some(high)) => (low, high.min(low + 2.0 * PI)),
    };
    let wanted = low + (high - low) * ((1 + chance % 61) as f64 / 63.0);
    // φ/2 = 2 atan t; the turn by whole periods of the half angle changes neither sine nor cosine of it.
    let quarter = (wanted / 4.0).tan();
    let mut best = (wanted, quarter);
    for below in [16.0, 256.0, 1e6] {
        let t = (quarter * below).round() / below;
        let phi = wanted + 4.0 * (t.atan() - quarter.atan());
        best = (phi, t);
        if low < phi && phi < high {
            break;
        }
    }
    let t = from_f64(best.1).unwrap_or_else(Rational::one);
    (best.0, circle(&t))
}

/// FNV-1a, of a name and a counter.
fn hash(name: &str, i: u64) -> u64 {
    let bytes = name.bytes().chain(i.to_le_bytes());
    let mixed = bytes.fold(0xcbf2_9ce4_8422_2325_u64, |h, b| {
        (h ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3)
    });
    mixed >> 20
}

/// The given values of all parameters, if each has one.
pub(super) fn given(scene: &Scene) -> Option<Point<f64>> {
    let mut point = Point::default();
    for parameter in &scene.parameters {
        let value = parameter
            .value
            .as_ref()?
            .evaluate(&Point::<f64>::default())?;
        point.values.insert(parameter.name.clone(), value);
    }
    Some(point)
}

/// Whether an expression is zero at every sample point; `None` if it has a value at none of them.
pub(super) fn vanishes(e: &Expr, points: &[(Point<Rational>, Point<f64>)]) -> Option<bool> {
    let mut found = None;
    for (exact, double) in points {
        let is_zero = match e.evaluate(exact) {
            Some(value) => Some(value == ratio(0, 1)),
            // A root or an angle outside sine and cosine: doubles decide, with a margin far above their rounding.
            None => e
                .evaluate(double)
                .map(|value| value.abs() <= 1e-9 * magnitude(e, double)),
        };
        match is_zero {
            Some(false) => return Some(false),
            Some(true) => found = Some(true),
            None => {}
        }
    }
    found
}

/// The size of what cancels when a sum is formed.
fn magnitude(e: &Expr, at: &Point<f64>) -> f64 {
    match e.node() {
        crate::expr::Node::Sum(terms) => terms.iter().map(|t| magnitude(t, at)).sum(),
        crate::expr::Node::Product(factors) => factors.iter().map(|f| magnitude(f, at)).product(),
        _ => e.evaluate(at).unwrap_or(0.0).abs(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Limit;

    #[test]
    fn angles_stay_in_their_interval_and_on_the_circle() {
        let limit = |value: Rational, of_pi| {
            Some(Limit {
                value,
                of_pi,
                open: true,
            })
        };
        let narrow = Domain {
            low: limit(ratio(1, 2), true),
            high: limit(ratio(51, 100), true),
        };
        for chance in 0..200 {
            for domain in [Domain::default(), narrow.clone()] {
                let (phi, [c, s]) = angle(&domain, chance);
                assert_eq!(&c * &c + &s * &s, ratio(1, 1));
                assert!(
                    (to_f64(&c) - (phi / 2.0).cos()).abs() < 1e-9
                        && (to_f64(&s) - (phi / 2.0).sin()).abs() < 1e-9
                );
                assert!(
                    domain.low.is_none() || (0.5..0.51).contains(&(phi / std::f64::consts::PI)),
                    "{phi}"
                );
            }
        }
    }
}
