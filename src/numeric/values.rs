//! The point that the values of a scene's own parameters make.
//!
//! In: a scene whose parameters have values. Out: the point, in doubles or in exact fractions, or the names of what has no
//! value. An angle is exact where both its cosine and its sine are fractions: quarter turns, and arcs given by one.

use num_traits::{One, Zero};

use super::points::{Needed, needed, quarter_turns};
use crate::expr::number::sqrt_exact;
use crate::expr::{Expr, Function, Node, Point, Rational, Symbol, ratio};
use crate::scene::Scene;

/// Why a scene's values make no point.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoPoint {
    /// These symbols have no value.
    Missing(Vec<Symbol>),
    /// The value of this symbol, or a cosine or sine of it, is not a fraction.
    Irrational(Symbol),
}

impl std::fmt::Display for NoPoint {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            NoPoint::Missing(names) => {
                let first = names.first().map_or("v", |name| name);
                let names = names.join(", ");
                write!(
                    f,
                    "no value for {names}\nhint: give values in the scene or with --set {first}=…"
                )
            }
            NoPoint::Irrational(name) => write!(
                f,
                "the value of {name} has no exact fraction\nhint: leave out --exact, or take an angle with rational cosine and sine, such as --set {name}=acos(3/5)"
            ),
        }
    }
}

/// The point in doubles.
pub fn values(scene: &Scene) -> Result<Point<f64>, NoPoint> {
    let all = given_values(scene)?;
    let mut point = Point::default();
    for (name, value) in all {
        let number = value.evaluate(&Point::<f64>::default());
        let number = number.ok_or_else(|| NoPoint::Missing(vec![name.clone()]))?;
        point.values.insert(name, number);
    }
    Ok(point)
}

/// The point in exact fractions.
pub fn exact_values(scene: &Scene) -> Result<Point<Rational>, NoPoint> {
    let irrational = |name: &Symbol| NoPoint::Irrational(name.clone());
    let number = |name: &Symbol, value: &Expr| {
        let number = value.evaluate(&Point::<Rational>::default());
        number.ok_or_else(|| irrational(name))
    };
    let unit = |name: &Symbol, part: &Expr| unit_of(part).ok_or_else(|| irrational(name));
    point_of(scene, number, unit)
}

/// The point that the values make: of what stands plain the `number`, and of an angle cosine and sine of the part in use, `unit`.
pub(super) fn point_of<T>(
    scene: &Scene,
    number: impl Fn(&Symbol, &Expr) -> Result<T, NoPoint>,
    unit: impl Fn(&Symbol, &Expr) -> Result<[T; 2], NoPoint>,
) -> Result<Point<T>, NoPoint> {
    let needed = needed(scene);
    let mut point = Point::default();
    for (name, value) in given_values(scene)? {
        if let Some(divisor) = needed.angles.get(&name) {
            let part = &value * &Expr::ratio(1, i64::from(*divisor));
            let unit = unit(&name, &part)?;
            point.directions.insert(name.clone(), (*divisor, unit));
        }
        if needed.plain.contains(&name) {
            let number = number(&name, &value)?;
            point.values.insert(name, number);
        }
    }
    Ok(point)
}

/// The values of all symbols that the scene needs.
pub(super) fn given_values(scene: &Scene) -> Result<Vec<(Symbol, Expr)>, NoPoint> {
    let Needed { plain, angles } = needed(scene);
    let mut found = Vec::new();
    let mut missing = Vec::new();
    for name in plain.into_iter().chain(angles.into_keys()) {
        match scene.parameter(&name).and_then(|p| p.value.clone()) {
            Some(value) => found.push((name, value)),
            None => missing.push(name),
        }
    }
    missing.sort();
    missing.dedup();
    found.dedup_by(|a, b| a.0 == b.0);
    if missing.is_empty() {
        Ok(found)
    } else {
        Err(NoPoint::Missing(missing))
    }
}

/// Cosine and sine of an angle where both are fractions.
pub(super) fn unit_of(value: &Expr) -> Option<[Rational; 2]> {
    if value.is_zero() {
        return quarter_turns(&Rational::zero());
    }
    match value.node() {
        Node::Symbol(name) if &**name == "pi" => quarter_turns(&Rational::one()),
        Node::Product(factors) => match factors.as_slice() {
            [k, pi] if pi.as_symbol().is_some_and(|s| &**s == "pi") => {
                quarter_turns(k.as_number()?)
            }
            [k, arc] => {
                let k = k.as_number()?;
                let times = k.is_integer().then(|| k.numer().as_i64())??;
                multiple(unit_of(arc)?, times)
            }
            _ => None,
        },
        Node::Sum(terms) => terms.iter().try_fold([ratio(1, 1), ratio(0, 1)], |sum, t| {
            Some(turned(&sum, &unit_of(t)?))
        }),
        Node::Call(Function::Acos, c) => {
            let c = c.evaluate(&Point::<Rational>::default())?;
            let s = sqrt_exact(&(Rational::one() - &c * &c))?;
            Some([c, s])
        }
        Node::Call(Function::Asin, s) => {
            let s = s.evaluate(&Point::<Rational>::default())?;
            let c = sqrt_exact(&(Rational::one() - &s * &s))?;
            Some([c, s])
        }
        Node::Call(Function::Atan, t) => {
            let t = t.evaluate(&Point::<Rational>::default())?;
            let c = sqrt_exact(&(Rational::one() + &t * &t))?.recip();
            Some([c.clone(), t * c])
        }
        _ => None,
    }
}

/// The unit vector of `times` times the angle; multiples beyond a few turns are nobody's angle.
fn multiple(unit: [Rational; 2], times: i64) -> Option<[Rational; 2]> {
    let [c, s] = unit;
    let step = [c, if times.is_negative() { -s } else { s }];
    let count = usize::try_from(times.unsigned_abs())
        .ok()
        .filter(|n| *n <= 64)?;
    Some((0..count).fold([ratio(1, 1), ratio(0, 1)], |sum, _| turned(&sum, &step)))
}

fn turned(a: &[Rational; 2], b: &[Rational; 2]) -> [Rational; 2] {
    [&a[0] * &b[0] - &a[1] * &b[1], &a[1] * &b[0] + &a[0] * &b[1]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arcs_of_pythagorean_fractions_are_exact_and_thirty_degrees_are_not() {
        let arc = |f, n, d| Expr::call(f, Expr::ratio(n, d));
        assert_eq!(
            unit_of(&arc(Function::Acos, 3, 5)),
            Some([ratio(3, 5), ratio(4, 5)])
        );
        assert_eq!(
            unit_of(&(arc(Function::Atan, 3, 4) * Expr::from(2))),
            Some([ratio(7, 25), ratio(24, 25)])
        );
        assert_eq!(
            unit_of(&(Expr::pi() * Expr::ratio(1, 2))),
            Some([ratio(0, 1), ratio(1, 1)])
        );
        assert_eq!(unit_of(&(Expr::pi() * Expr::ratio(1, 6))), None);
    }
}
