//! Exact points inside a domain, from simple to complicated, in an order that never changes.
//!
//! An angle is given by a rational direction of the angle itself or of a part of it (φ/2 where cos(φ/2) occurs), so that
//! every sine and cosine in sight is a fraction. A symbol that also stands outside sines gets a rational value instead.

use num_traits::{One, Zero};

use super::coordinate::{CIRCLE, Lcg, directions, numbers, random_number};
use super::roles::{Role, Roles, roles};
use super::{Coordinate, Domain, Domains};
use crate::expr::{Expr, Function, Int, Point, Rational, Scalar, Symbol, Table, ratio};
use crate::interval::{Certified, Outcome};

/// An exact point of a domain.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Sample {
    /// Value of each symbol.
    pub coordinates: Table<Coordinate>,
}

/// The first `count` points; the first gives every symbol its simplest value, the second gives different symbols
/// different values, later ones are drawn from a fixed pseudo-random sequence. `domains` must declare every symbol of
/// `roles`. Fewer points come out where a domain has no point that could be found.
pub fn samples(roles: &Roles, domains: &Domains, count: usize) -> Vec<Sample> {
    samples_until(roles, domains, count, |_| false)
}

/// The same points up to the first that is the last one wanted; the others are not made.
pub fn samples_until(
    roles: &Roles,
    domains: &Domains,
    count: usize,
    mut is_last: impl FnMut(&Sample) -> bool,
) -> Vec<Sample> {
    if !domains.relations.is_empty() {
        return related(roles, domains, count, is_last);
    }
    drawn(roles, domains, 4 * count, count, |point| {
        match is_last(point) {
            true => Taken::Last,
            false => Taken::Yes,
        }
    })
}

/// Whether a point that was drawn is taken.
enum Taken {
    No,
    Yes,
    Last,
}

/// Points that keep to the relations: the other symbols of these are placed too, and left out again.
fn related(
    some: &Roles,
    domains: &Domains,
    count: usize,
    mut is_last: impl FnMut(&Sample) -> bool,
) -> Vec<Sample> {
    let bearing = domains.relations_of(&some.symbols.keys().cloned().collect());
    let excesses: Vec<&Expr> = bearing.iter().map(|r| &r.excess).collect();
    let mut all = roles(&excesses);
    all.symbols
        .retain(|name, _| !some.symbols.contains_key(name));
    all.symbols.extend(some.symbols.clone());
    let (domains, _) = domains.completed(&all);
    let placed = domains.placed(|name| all.symbols.contains_key(name));
    let mut out: Vec<Sample> = Vec::new();
    // Chains of relations leave few of the points drawn.
    drawn(&all, &domains, 200 + 60 * count, count, |point| {
        if !point.keeps_to(&placed) {
            return Taken::No;
        }
        let mut own = point.clone();
        own.coordinates
            .retain(|name, _| some.symbols.contains_key(name));
        if out.contains(&own) {
            return Taken::No;
        }
        let taken = match is_last(&own) {
            true => Taken::Last,
            false => Taken::Yes,
        };
        out.push(own);
        taken
    });
    out
}

/// How many points pick the values of symbols by place.
const EARLY: usize = 6;

/// The first `count` points of the sequence that are taken, of at most `most`.
fn drawn(
    roles: &Roles,
    domains: &Domains,
    most: usize,
    count: usize,
    mut takes: impl FnMut(&Sample) -> Taken,
) -> Vec<Sample> {
    let mut axes: Vec<(&Symbol, &Domain, Vec<Coordinate>)> = Vec::new();
    for (i, (name, role)) in roles.symbols.iter().enumerate() {
        // The early points pick by place, the later ones at random.
        let wanted = match domains.relations.is_empty() {
            true if count <= EARLY => (i + count.max(2)).min(24),
            _ => 24,
        };
        let Some(domain) = domains.symbols.get(name) else {
            continue;
        };
        let list = match role.bare {
            true => numbers(domain, wanted),
            false => directions(domain, role.divisor, wanted),
        };
        if list.is_empty() {
            return Vec::new();
        }
        axes.push((name, domain, list));
    }
    if axes.is_empty() {
        let only = Sample::default();
        return match takes(&only) {
            Taken::No => Vec::new(),
            Taken::Yes | Taken::Last => vec![only],
        };
    }
    let units = units(roles, domains);
    let mut out: Vec<Sample> = Vec::new();
    let mut picks: Vec<usize> = Vec::new();
    for k in 0..most {
        let mut random = Lcg(k as u64);
        let mut point = Sample::default();
        picks.clear();
        picks.extend((0..axes.len()).map(|i| match k {
            0 => 0,
            1..EARLY => i + k,
            _ => random.next() as usize,
        }));
        for ((name, domain, list), pick) in axes.iter().zip(&picks) {
            let listed = &list[pick % list.len()];
            let drawn = match k {
                12.. => random_number(domain, &mut random).filter(|v| domain.contains(v)),
                _ => None,
            };
            let coordinate = match (&list[0], drawn) {
                (Coordinate::Number(_), Some(value)) => Coordinate::Number(value),
                _ => listed.clone(),
            };
            point.coordinates.insert((*name).clone(), coordinate);
        }
        if !place_units(&mut point, &units, k) || out.contains(&point) {
            continue;
        }
        let taken = takes(&point);
        if matches!(taken, Taken::No) {
            continue;
        }
        out.push(point);
        if matches!(taken, Taken::Last) || out.len() == count {
            break;
        }
    }
    out
}

/// Most points made of one by moving symbols to ends.
const MOST_ENDS: usize = 64;

/// Points with one symbol or several at closed ends of their domains or at 0, and the others as they are.
pub fn at_ends(near: &[Sample], domains: &Domains) -> Vec<Sample> {
    let mut out = Vec::new();
    for point in near {
        let mut moved = vec![point.clone()];
        for (name, at) in &point.coordinates {
            let tied = domains.is_component(name);
            let Some(domain) = domains.symbols.get(name) else {
                continue;
            };
            if tied || matches!(at, Coordinate::Direction { .. }) {
                continue;
            }
            let closed = domain
                .ends()
                .filter(|l| !l.open)
                .map(|end| match end.of_pi {
                    true => Coordinate::Pi(end.value.clone()),
                    false => Coordinate::Number(end.value.clone()),
                });
            let zero = Rational::zero();
            let inside = domain.contains(&zero) && !domain.is_end(&zero);
            for value in closed.chain(inside.then_some(Coordinate::Number(zero))) {
                // What has been moved already does not come again.
                let free = |p: &&Sample| p.coordinates.get(name) == Some(at);
                let more = moved.iter().filter(free);
                let more: Vec<Sample> = more.map(|p| p.moved(name, value.clone())).collect();
                moved.extend(more);
            }
            moved.truncate(MOST_ENDS);
        }
        out.extend(moved.into_iter().skip(1));
    }
    out
}

/// Numbers far out and near the ends of a domain.
pub fn far(domain: &Domain) -> Vec<Coordinate> {
    let mut out = Vec::new();
    for k in [-9i32, -4, -2, 1, 2, 3, 4, 6, 12] {
        let power = Rational::from(Int::from(10).pow(k.unsigned_abs()));
        let size = if k < 0 { power.recip() } else { power };
        out.extend([size.clone(), -size.clone()]);
        for end in domain.ends() {
            if !end.of_pi {
                out.extend([&end.value + &size, &end.value - &size]);
            }
        }
    }
    out.push(Rational::zero());
    out.retain(|v| domain.contains(v));
    out.into_iter().map(Coordinate::Number).collect()
}

/// A simple value of a symbol in a part of its domain.
pub fn within(part: &Domain, domain: &Domain, role: &Role) -> Option<Coordinate> {
    let fits = |x: &Rational| part.contains(x) && domain.contains(x);
    if role.turns && !role.bare {
        let found = directions(part, role.divisor.max(1), 1);
        let number = |c: &Coordinate| match c {
            Coordinate::Number(x) => fits(x),
            _ => true,
        };
        return found.into_iter().find(number);
    }
    let one = Rational::one();
    let beside = match (&part.low, &part.high) {
        (Some(low), None) if !low.of_pi => Some(low.value.floor() + one),
        (None, Some(high)) if !high.of_pi => Some(high.value.ceil() - one),
        _ => None,
    };
    let simple = numbers(part, 3).into_iter().filter_map(|c| match c {
        Coordinate::Number(x) => Some(x),
        _ => None,
    });
    let found = beside.into_iter().chain(simple).find(fits);
    found.map(Coordinate::Number)
}

/// A unit vector: its place in the domains, its components, and the points of the circle that it may be.
type Unit<'a> = (usize, &'a [Symbol; 2], Vec<&'static [Rational; 2]>);

/// The unit vectors with a component among the symbols.
fn units<'a>(roles: &Roles, domains: &'a Domains) -> Vec<Unit<'a>> {
    let pairs = domains.unit_vectors.iter().enumerate();
    let placed = pairs.filter(|(_, pair)| pair.iter().any(|s| roles.symbols.contains_key(s)));
    let points = |(i, pair): (usize, &'a [Symbol; 2])| {
        let fits = |unit: &&[Rational; 2]| {
            let mut parts = pair.iter().zip(*unit);
            parts.all(|(s, v)| domains.symbols.get(s).is_none_or(|d| d.contains(v)))
        };
        (i, pair, CIRCLE.iter().filter(fits).collect())
    };
    placed.map(points).collect()
}

/// Moves the components of unit vectors to a rational point of the circle; `false` where none fits.
fn place_units(point: &mut Sample, units: &[Unit<'_>], k: usize) -> bool {
    for (i, pair, all) in units {
        if all.is_empty() {
            return false;
        }
        let unit = all[(k * (i + 1)) % all.len()];
        for (symbol, value) in pair.iter().zip(unit) {
            if let Some(place) = point.coordinates.get_mut(symbol) {
                *place = Coordinate::Number(value.clone());
            }
        }
    }
    true
}

impl Sample {
    /// The point in words, symbols in alphabetical order.
    pub fn words(&self) -> String {
        let words = self.coordinates.iter().map(|(name, c)| c.words(name));
        words.collect::<Vec<_>>().join(", ")
    }

    /// The point with another value of one symbol.
    pub fn moved(&self, name: &Symbol, value: Coordinate) -> Sample {
        let mut moved = self.clone();
        moved.coordinates.insert(name.clone(), value);
        moved
    }

    /// Points with a symbol that has a number here led far out and near the ends of its domain.
    pub fn led_far(&self, name: &Symbol, domains: &Domains) -> Vec<Sample> {
        let number = matches!(self.coordinates.get(name), Some(Coordinate::Number(_)));
        let domain = domains.symbols.get(name).filter(|_| number);
        let all = domain.map(far).unwrap_or_default().into_iter();
        all.map(|value| self.moved(name, value)).collect()
    }

    /// The point in doubles; angles have their values, but no directions.
    pub fn doubles(&self) -> Point<f64> {
        let mut point = Point::default();
        for (name, coordinate) in &self.coordinates {
            point.values.insert(name.clone(), coordinate.double());
        }
        point
    }

    /// The point in fractions alone: what is a multiple of π has no value there.
    pub fn fractions(&self) -> Point<Rational> {
        let mut point = Point::default();
        for (name, coordinate) in &self.coordinates {
            match coordinate.clone() {
                Coordinate::Number(value) => {
                    point.values.insert(name.clone(), value);
                }
                Coordinate::Direction { divisor, unit, .. } => {
                    point.directions.insert(name.clone(), (divisor, unit));
                }
                Coordinate::Pi(_) => {}
            }
        }
        point
    }

    /// The point for evaluation in a certified number type. With `radians`, angles known by direction also get their value.
    pub fn point<T: Certified>(&self, radians: bool) -> Point<Outcome<T>> {
        let mut point = Point::default();
        let number = Outcome::<T>::from_rational;
        for (name, coordinate) in &self.coordinates {
            let value = match coordinate {
                Coordinate::Number(value) => number(value),
                Coordinate::Pi(value) => number(value).times(&T::pi()),
                Coordinate::Direction {
                    divisor,
                    unit,
                    turns,
                } => {
                    let unit_of = [number(&unit[0]), number(&unit[1])];
                    point.directions.insert(name.clone(), (*divisor, unit_of));
                    if !radians {
                        continue;
                    }
                    value_of(*divisor, unit, *turns)
                }
            };
            point.values.insert(name.clone(), value);
        }
        point
    }
}

/// φ = N (ψ + 2π k) with ψ = 2 atan(sin/(1 + cos)), or π where the direction points backwards.
fn value_of<T: Certified>(divisor: u32, unit: &[Rational; 2], turns: i32) -> Outcome<T> {
    let number = |n: i64| Outcome::<T>::from_rational(&ratio(n, 1));
    let below = &unit[0] + Rational::one();
    let psi = match below.is_zero() {
        true => T::pi(),
        false => {
            let half = Outcome::<T>::from_rational(&(&unit[1] / below));
            let half = half.call(Function::Atan).unwrap_or(Outcome::Unknown);
            half.times(&number(2))
        }
    };
    psi.plus(&T::pi().times(&number(2 * i64::from(turns))))
        .times(&number(i64::from(divisor)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interval::{Big, evaluate};

    fn points(e: &Expr, domains: &Domains, count: usize) -> (Roles, Domains, Vec<Sample>) {
        let roles = roles(&[e]);
        let (domains, _) = domains.completed(&roles);
        let all = samples(&roles, &domains, count);
        (roles, domains, all)
    }

    #[test]
    fn the_first_point_is_the_simplest() {
        let s = Expr::symbol;
        let e = s("v") * s("theta").cos() / s("l");
        let (_, _, all) = points(&e, &Domains::default(), 3);
        assert_eq!(all[0].words(), "l = 1, theta with cos(theta) = 3/5, v = 1");
        assert_eq!(all.len(), 3);
    }

    #[test]
    fn distinct_symbols_get_distinct_values_at_the_second_point() {
        let e = Expr::sum(["a", "b", "c", "d"].map(Expr::symbol));
        let (_, _, all) = points(&e, &Domains::default(), 2);
        let mut seen = Vec::new();
        for c in all[1].coordinates.values() {
            assert!(!seen.contains(c));
            seen.push(c.clone());
        }
    }

    #[test]
    fn half_angles_stay_inside_the_interval_and_exact() {
        let phi = Expr::symbol("phi");
        let e = (&phi * &Expr::ratio(1, 2)).cos() + phi.sin();
        let mut domains = Domains::default();
        domains
            .symbols
            .insert("phi".into(), Domain::angle(ratio(1, 1), ratio(2, 1)));
        let (roles, _, all) = points(&e, &domains, 8);
        assert_eq!(roles.symbols["phi"].divisor, 2);
        assert!(all.len() >= 4);
        for sample in all {
            let value = |e: &Expr| evaluate::<Big<128>>(e, &sample.point(true)).value();
            let [value, pi] = [&phi, &Expr::pi()].map(|e| value(e).expect("a value").0);
            assert!(
                pi.high < value.low && value.high < pi.scale(1).low,
                "{}",
                sample.words()
            );
        }
    }

    #[test]
    fn unit_vectors_lie_on_the_circle() {
        let domains = Domains {
            unit_vectors: vec![["a".into(), "b".into()]],
            ..Domains::default()
        };
        let (_, _, all) = points(&(Expr::symbol("a") + Expr::symbol("b")), &domains, 12);
        assert!(all.len() == 12);
        for sample in all {
            let value = (Expr::symbol("a").powi(2) + Expr::symbol("b").powi(2))
                .evaluate(&sample.point::<Big<64>>(false));
            let one = value.and_then(Outcome::value).expect("a value").0;
            assert!(one.contains(&ratio(1, 1)));
        }
    }

    #[test]
    fn every_number_lies_in_its_domain() {
        let table = [
            Domain::positive(),
            Domain::nonnegative(),
            Domain::real(),
            Domain::between(ratio(0, 1), ratio(1, 1)),
            Domain::between(ratio(3001, 10_000), ratio(3002, 10_000)),
            Domain::between(ratio(-7, 2), ratio(-3, 1)),
            Domain::first_quadrant(),
            Domain::angle(ratio(-1, 1), ratio(1, 1)),
        ];
        for domain in table {
            let mut domains = Domains::default();
            domains.symbols.insert("x".into(), domain.clone());
            let (_, _, all) = points(&Expr::symbol("x"), &domains, 24);
            assert!(all.len() >= 6, "{domain:?} {}", all.len());
            for sample in all {
                let Coordinate::Number(value) = &sample.coordinates["x"] else {
                    panic!("a number")
                };
                assert!(domain.contains(value), "{domain:?} {value}");
            }
        }
    }

    #[test]
    fn a_symbol_under_a_sine_and_outside_gets_a_value() {
        let theta = Expr::symbol("theta");
        let (roles, _, all) = points(&(&theta * &theta.sin()), &Domains::default(), 1);
        assert!(roles.symbols["theta"].turns && roles.symbols["theta"].bare);
        assert_eq!(all[0].words(), "theta = 1");
    }
}
