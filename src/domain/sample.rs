//! Exact points inside a domain, from simple to complicated, in an order that never changes.
//!
//! An angle is given by a rational direction of the angle itself or of a part of it (φ/2 where cos(φ/2) occurs), so that
//! every sine and cosine in sight is a fraction. A symbol that also stands outside sines gets a rational value instead.

use std::collections::BTreeMap;

use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::{Domain, Domains};
use crate::expr::Int;
use crate::expr::angle::angle;
use crate::expr::number::to_f64;
use crate::expr::{Expr, Function, Node, Point, Rational, Scalar, Symbol, ratio};
use crate::interval::{Certified, Outcome};

/// How a symbol occurs in formulas.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Role {
    /// It occurs under sin, cos or tan in a rational combination of symbols.
    pub turns: bool,
    /// It also occurs elsewhere, so that its value is needed and not only its direction.
    pub bare: bool,
    /// Smallest N such that only multiples of (angle)/N occur.
    pub divisor: u32,
}

/// The roles of all symbols of some formulas.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Roles {
    /// Role of each symbol.
    pub symbols: BTreeMap<Symbol, Role>,
    /// Whether angles known by direction are also needed in radians: sin(θ + π/3), sin(θ + x) with x bare.
    pub radians: bool,
}

/// Divisors above this make fractions too long; the angle gets a plain value.
const LARGEST_DIVISOR: u32 = 24;

/// The value of one symbol at a sample point.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Coordinate {
    /// The symbol has this value.
    Number(Rational),
    /// The symbol has this multiple of π as its value.
    Pi(Rational),
    /// The symbol is an angle φ = `divisor`·(ψ + 2π·`turns`), ψ in (−π, π] with (cos ψ, sin ψ) = `unit`.
    Direction {
        /// N in φ/N.
        divisor: u32,
        /// Cosine and sine of φ/N.
        unit: [Rational; 2],
        /// Full turns added to φ/N.
        turns: i32,
    },
}

/// An exact point of a domain.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Sample {
    /// Value of each symbol.
    pub coordinates: BTreeMap<Symbol, Coordinate>,
}

/// Finds how each symbol occurs.
pub fn roles(formulas: &[&Expr]) -> Roles {
    let mut out = Roles::default();
    formulas.iter().for_each(|e| note(e, &mut out));
    for role in out.symbols.values_mut() {
        // Too fine a division: treated as a value.
        role.bare |= role.turns && role.divisor > LARGEST_DIVISOR;
    }
    let mixed = out.symbols.values().any(|r| r.turns && r.bare)
        && out.symbols.values().any(|r| r.turns && !r.bare);
    out.radians |= mixed;
    out
}

fn note(e: &Expr, out: &mut Roles) {
    match e.node() {
        Node::Number(_) => {}
        Node::Symbol(name) => {
            if &**name != "pi" {
                role(out, name).bare = true;
            }
        }
        Node::Sum(parts) | Node::Product(parts) => parts.iter().for_each(|p| note(p, out)),
        Node::Power(base, exponent) => {
            note(base, out);
            note(exponent, out);
        }
        Node::Call(Function::Sin | Function::Cos | Function::Tan, argument) => {
            match angle(argument) {
                Some(read) => {
                    out.radians |= !(&read.pi * ratio(2, 1)).is_integer();
                    for (name, factor) in &read.symbols {
                        let role = role(out, name);
                        role.turns = true;
                        let below = factor.denom().to_u32().unwrap_or(u32::MAX);
                        role.divisor = if role.divisor.max(below) > LARGEST_DIVISOR
                            || factor.numer().bits() > 11
                        {
                            u32::MAX
                        } else {
                            role.divisor.lcm(&below)
                        };
                    }
                }
                None => {
                    out.radians = true;
                    note(argument, out);
                }
            }
        }
        Node::Call(_, argument) => note(argument, out),
    }
}

fn role<'a>(out: &'a mut Roles, name: &Symbol) -> &'a mut Role {
    out.symbols.entry(name.clone()).or_insert(Role {
        turns: false,
        bare: false,
        divisor: 1,
    })
}

/// The first `count` points; the first gives every symbol its simplest value, the second gives different symbols
/// different values, later ones are drawn from a fixed pseudo-random sequence. `domains` must declare every symbol of
/// `roles`. Fewer points come out where a domain has no point that could be found.
pub fn samples(roles: &Roles, domains: &Domains, count: usize) -> Vec<Sample> {
    if !domains.relations.is_empty() {
        return related(roles, domains, count);
    }
    drawn(roles, domains, 4 * count, count, |_| true)
}

/// Points that keep to the relations: the other symbols of these are placed too, and left out again.
fn related(some: &Roles, domains: &Domains, count: usize) -> Vec<Sample> {
    let bearing = domains.relations_of(&some.symbols.keys().cloned().collect());
    let excesses: Vec<&Expr> = bearing.iter().map(|r| &r.excess).collect();
    let mut all = roles(&excesses);
    all.symbols
        .retain(|name, _| !some.symbols.contains_key(name));
    all.symbols.extend(some.symbols.clone());
    let (domains, _) = domains.completed(&all);
    let mut out: Vec<Sample> = Vec::new();
    // Chains of relations leave few of the points drawn.
    drawn(&all, &domains, 200 + 60 * count, count, |point| {
        if !domains.admits(point) {
            return false;
        }
        let mut own = point.clone();
        own.coordinates
            .retain(|name, _| some.symbols.contains_key(name));
        let is_new = !out.contains(&own);
        if is_new {
            out.push(own);
        }
        is_new
    });
    out
}

/// The first `count` points of the sequence that are taken, of at most `most`.
fn drawn(
    roles: &Roles,
    domains: &Domains,
    most: usize,
    count: usize,
    mut takes: impl FnMut(&Sample) -> bool,
) -> Vec<Sample> {
    let mut axes: Vec<(&Symbol, &Domain, Vec<Coordinate>)> = Vec::new();
    for (i, (name, role)) in roles.symbols.iter().enumerate() {
        // The early points pick by place, the later ones at random.
        let wanted = if count <= 2 && domains.relations.is_empty() {
            (i + 2).min(24)
        } else {
            24
        };
        let Some(domain) = domains.symbols.get(name) else {
            continue;
        };
        let list = if role.bare {
            numbers(domain, wanted)
        } else {
            directions(domain, role.divisor, wanted)
        };
        if list.is_empty() {
            return Vec::new();
        }
        axes.push((name, domain, list));
    }
    if axes.is_empty() {
        let only = Sample::default();
        return if takes(&only) { vec![only] } else { Vec::new() };
    }
    let mut out: Vec<Sample> = Vec::new();
    for k in 0..most {
        let mut random = Lcg(k as u64);
        let mut point = Sample::default();
        for (i, (name, _, list)) in axes.iter().enumerate() {
            let pick = match k {
                0 => 0,
                1..6 => i + k,
                _ => random.next() as usize,
            };
            point
                .coordinates
                .insert((*name).clone(), list[pick % list.len()].clone());
        }
        if k >= 12 {
            for (name, domain, list) in &axes {
                let drawn = random_number(domain, &mut random).filter(|v| domain.contains(v));
                if let (Coordinate::Number(_), Some(value)) = (&list[0], drawn) {
                    point
                        .coordinates
                        .insert((*name).clone(), Coordinate::Number(value));
                }
            }
        }
        if place_units(&mut point, domains, k) && !out.contains(&point) && takes(&point) {
            out.push(point);
            if out.len() == count {
                break;
            }
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
            let tied = domains.unit_vectors.iter().flatten().any(|s| s == name);
            let Some(domain) = domains.symbols.get(name) else {
                continue;
            };
            if tied || matches!(at, Coordinate::Direction { .. }) {
                continue;
            }
            let ends = [&domain.low, &domain.high].into_iter().flatten();
            let closed = ends.filter(|l| !l.open).map(|end| match end.of_pi {
                true => Coordinate::Pi(end.value.clone()),
                false => Coordinate::Number(end.value.clone()),
            });
            let zero = Rational::zero();
            let inside = domain.contains(&zero) && !domain.is_end(&zero);
            for value in closed.chain(inside.then_some(Coordinate::Number(zero))) {
                // What has been moved already does not come again.
                let free = |p: &&Sample| p.coordinates.get(name) == Some(at);
                let more: Vec<Sample> = moved.iter().filter(free).cloned().collect();
                moved.extend(more.into_iter().map(|mut p| {
                    p.coordinates.insert(name.clone(), value.clone());
                    p
                }));
            }
            moved.truncate(MOST_ENDS);
        }
        out.extend(moved.into_iter().skip(1));
    }
    out
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

/// Moves the components of declared unit vectors to a rational point of the circle; `false` where none fits.
fn place_units(point: &mut Sample, domains: &Domains, k: usize) -> bool {
    for (i, pair) in domains.unit_vectors.iter().enumerate() {
        if !pair.iter().any(|s| point.coordinates.contains_key(s)) {
            continue;
        }
        let fits = |unit: &[Rational; 2]| {
            pair.iter()
                .zip(unit)
                .all(|(s, v)| domains.symbols.get(s).is_none_or(|d| d.contains(v)))
        };
        let all: Vec<[Rational; 2]> = circle().filter(fits).collect();
        if all.is_empty() {
            return false;
        }
        let unit = &all[(k * (i + 1)) % all.len()];
        for (symbol, value) in pair.iter().zip(unit) {
            if point.coordinates.contains_key(symbol) {
                point
                    .coordinates
                    .insert(symbol.clone(), Coordinate::Number(value.clone()));
            }
        }
    }
    true
}

/// Magnitudes tried in this order; a person can check a counterexample made of them.
const SIMPLE: [(i64, i64); 26] = [
    (1, 1),
    (2, 1),
    (1, 2),
    (3, 1),
    (1, 3),
    (3, 2),
    (2, 3),
    (4, 1),
    (1, 4),
    (3, 4),
    (4, 3),
    (5, 1),
    (1, 5),
    (2, 5),
    (3, 5),
    (4, 5),
    (5, 2),
    (7, 1),
    (1, 7),
    (1, 10),
    (9, 10),
    (10, 1),
    (1, 100),
    (99, 100),
    (100, 1),
    (1000, 1),
];

/// Up to `count` numbers of a domain, simplest first, its ends last.
fn numbers(domain: &Domain, count: usize) -> Vec<Coordinate> {
    let mut inside = Vec::new();
    let mut ends = Vec::new();
    let signs: &[i64] = if domain.low.as_ref().is_some_and(|l| !l.value.is_negative()) {
        &[1]
    } else {
        &[1, -1]
    };
    let closed = [&domain.low, &domain.high]
        .into_iter()
        .flatten()
        .any(|l| !l.open);
    for (n, d) in SIMPLE {
        for sign in signs {
            let value = Rational::new_raw(Int::from(sign * n), Int::from(d));
            if domain.contains(&value) {
                if closed && domain.is_end(&value) {
                    ends.push(value)
                } else {
                    inside.push(value)
                }
            }
        }
        if inside.len() >= count {
            break;
        }
    }
    let mut k = 0;
    while inside.len() < count.min(6) && k < 12 {
        // A narrow interval: the simplest fractions of its parts.
        if let Some(value) = part(domain, k).filter(|v| domain.contains(v) && !inside.contains(v)) {
            inside.push(value);
        }
        k += 1;
    }
    let zero = Rational::zero();
    if domain.contains(&zero) && inside.len() < 24 {
        ends.push(zero);
    }
    inside.truncate(count);
    if inside.len() < count {
        inside.extend(ends);
    }
    let mut out: Vec<Coordinate> = inside.into_iter().map(Coordinate::Number).collect();
    if let (true, Some(low), Some(high)) = (out.is_empty(), &domain.low, &domain.high) {
        if low == high && low.of_pi && !low.open {
            out.push(Coordinate::Pi(low.value.clone()));
        } else if low == high && !low.open {
            out.push(Coordinate::Number(low.value.clone()));
        }
    }
    out
}

/// The simplest fraction in a part of a bounded domain: the whole, halves, quarters, eighths.
fn part(domain: &Domain, k: usize) -> Option<Rational> {
    let (low, high) = (
        domain.low.as_ref()?.approximate(),
        domain.high.as_ref()?.approximate(),
    );
    let (pieces, piece) = match k {
        0 => (1, 0),
        1 | 2 => (2, k - 1),
        3..=6 => (4, k - 3),
        _ => (8, k - 7),
    };
    let step = (high - low) / pieces as f64;
    let from = crate::expr::number::from_f64(low + step * piece as f64)?;
    let to = crate::expr::number::from_f64(low + step * (piece + 1) as f64)?;
    (from < to).then(|| simplest(&from, &to, 64)).flatten()
}

/// The fraction with the smallest denominator strictly between two others (Stern and Brocot).
fn simplest(low: &Rational, high: &Rational, depth: u32) -> Option<Rational> {
    let whole = low.floor();
    let next = &whole + Rational::one();
    if next < *high {
        return Some(next);
    }
    if depth == 0 {
        return None;
    }
    let rest = low - &whole;
    let (top, bottom) = (high - &whole, rest);
    if bottom.is_zero() {
        // Between 0 and `top` ≤ 1: one over the first integer above 1/top.
        return Some(&whole + (top.recip().floor() + Rational::one()).recip());
    }
    Some(whole + simplest(&top.recip(), &bottom.recip(), depth - 1)?.recip())
}

/// A number of the domain with two-digit parts.
fn random_number(domain: &Domain, random: &mut Lcg) -> Option<Rational> {
    let step = ratio(1 + (random.next() % 96) as i64, 97);
    let scale = ratio(1 + (random.next() % 12) as i64, 1);
    let end = |l: &super::Limit| {
        if l.of_pi {
            crate::expr::number::from_f64(l.approximate())
        } else {
            Some(l.value.clone())
        }
    };
    let short =
        |x: Rational| Rational::new((x * ratio(1009, 1)).round().to_integer(), Int::from(1009));
    Some(match (&domain.low, &domain.high) {
        (Some(l), Some(h)) => {
            let (l, h) = (end(l)?, end(h)?);
            short(&l + (&h - &l) * step)
        }
        (Some(l), None) => end(l)? + step * scale,
        (None, Some(h)) => end(h)? - step * scale,
        (None, None) => (step - ratio(1, 2)) * scale * ratio(2, 1),
    })
}

/// Halved tangents t of the first quadrant's rational directions ((1 − t²)/(1 + t²), 2t/(1 + t²)), simplest first.
const TANGENTS: [(i64, i64); 20] = [
    (1, 2),
    (1, 3),
    (2, 3),
    (1, 5),
    (3, 5),
    (1, 4),
    (3, 4),
    (1, 7),
    (3, 7),
    (2, 5),
    (5, 7),
    (1, 9),
    (4, 5),
    (2, 7),
    (1, 10),
    (1, 20),
    (9, 11),
    (1, 40),
    (1, 100),
    (1, 400),
];

/// Rational points of the whole circle, simplest first: four per tangent, then the four ends of the axes.
fn circle() -> impl Iterator<Item = [Rational; 2]> {
    let slanted = TANGENTS.into_iter().flat_map(|(n, d)| {
        let (c, s, h) = (d * d - n * n, 2 * n * d, d * d + n * n);
        [(c, s, h), (-c, s, h), (c, -s, h), (-c, -s, h)]
    });
    let axes = [(1, 0, 1), (0, 1, 1), (-1, 0, 1), (0, -1, 1)];
    slanted
        .chain(axes)
        .map(|(c, s, h)| [ratio(c, h), ratio(s, h)])
}

/// Directions of φ/N that put φ inside the domain. Directions nearer than 10⁻⁹ to an end are left out, far more than
/// floating-point arctangents err by.
fn directions(domain: &Domain, divisor: u32, count: usize) -> Vec<Coordinate> {
    const MARGIN: f64 = 1e-9;
    let low = domain
        .low
        .as_ref()
        .map_or(f64::NEG_INFINITY, super::Limit::approximate);
    let high = domain
        .high
        .as_ref()
        .map_or(f64::INFINITY, super::Limit::approximate);
    let n = f64::from(divisor);
    let mut out = Vec::new();
    for unit in circle() {
        let psi = to_f64(&unit[1]).atan2(to_f64(&unit[0]));
        for turns in [0, 1, -1] {
            let phi = n * (psi + 2.0 * std::f64::consts::PI * f64::from(turns));
            if low + MARGIN < phi && phi < high - MARGIN {
                out.push(Coordinate::Direction {
                    divisor,
                    unit,
                    turns,
                });
                break;
            }
        }
        if out.len() >= count {
            return out;
        }
    }
    if out.is_empty() {
        // Too narrow for the list, or a single angle: plain values.
        return numbers(domain, count);
    }
    out
}

/// A linear congruential generator (Knuth's MMIX constants): the same points on every machine.
struct Lcg(u64);

impl Lcg {
    fn next(&mut self) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 33
    }
}

impl Coordinate {
    /// The coordinate in words: `v = 1`, `theta with cos(theta) = 3/5`.
    pub fn words(&self, symbol: &str) -> String {
        match self {
            Coordinate::Number(value) => format!("{symbol} = {value}"),
            Coordinate::Pi(value) => format!("{symbol} = {value}*pi"),
            Coordinate::Direction {
                divisor,
                unit,
                turns,
            } => {
                let [cos, sin] = self.direction().unwrap_or_else(|| unit.clone());
                let quarter = *divisor == 1 && *turns == 0 && !sin.is_negative();
                // A cosine fixes an angle between 0 and π; elsewhere the sine is told too.
                let phi = f64::from(*divisor) * to_f64(&unit[1]).atan2(to_f64(&unit[0]));
                if quarter || (*turns == 0 && (0.0..=std::f64::consts::PI).contains(&phi)) {
                    format!("{symbol} with cos({symbol}) = {cos}")
                } else {
                    format!("{symbol} with cos({symbol}) = {cos}, sin({symbol}) = {sin}")
                }
            }
        }
    }

    /// Cosine and sine of the angle itself, where it is given by a direction.
    pub fn direction(&self) -> Option<[Rational; 2]> {
        let Coordinate::Direction {
            divisor,
            unit: [c, s],
            ..
        } = self
        else {
            return None;
        };
        let mut total = [Rational::one(), Rational::zero()];
        for _ in 0..*divisor {
            let [x, y] = &total;
            total = [x * c - y * s, x * s + y * c];
        }
        Some(total)
    }
}

impl Sample {
    /// The point in words, symbols in alphabetical order.
    pub fn words(&self) -> String {
        self.coordinates
            .iter()
            .map(|(name, c)| c.words(name))
            .collect::<Vec<_>>()
            .join(", ")
    }

    /// The point for evaluation in a certified number type. With `radians`, angles known by direction also get their value.
    pub fn point<T: Certified>(&self, radians: bool) -> Point<Outcome<T>> {
        let mut point = Point::default();
        let number = Outcome::<T>::from_rational;
        for (name, coordinate) in &self.coordinates {
            match coordinate {
                Coordinate::Number(value) => {
                    point.values.insert(name.clone(), number(value));
                }
                Coordinate::Pi(value) => {
                    point
                        .values
                        .insert(name.clone(), number(value).times(&T::pi()));
                }
                Coordinate::Direction {
                    divisor,
                    unit,
                    turns,
                } => {
                    let unit_of = [number(&unit[0]), number(&unit[1])];
                    point.directions.insert(name.clone(), (*divisor, unit_of));
                    if radians {
                        point
                            .values
                            .insert(name.clone(), value_of(*divisor, unit, *turns));
                    }
                }
            }
        }
        point
    }
}

/// φ = N (ψ + 2π k) with ψ = 2 atan(sin/(1 + cos)), or π where the direction points backwards.
fn value_of<T: Certified>(divisor: u32, unit: &[Rational; 2], turns: i32) -> Outcome<T> {
    let number = |n: i64| Outcome::<T>::from_rational(&ratio(n, 1));
    let below = &unit[0] + Rational::one();
    let psi = if below.is_zero() {
        T::pi()
    } else {
        let half = Outcome::<T>::from_rational(&(&unit[1] / below));
        half.call(Function::Atan)
            .unwrap_or(Outcome::Unknown)
            .times(&number(2))
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
            let value = evaluate::<Big<128>>(&phi, &sample.point(true))
                .value()
                .expect("a value")
                .0;
            let pi = crate::interval::Enclosure::pi(128);
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
