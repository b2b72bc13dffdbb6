//! Representative values: what a symbolic scene is drawn at.
//!
//! In: a scene. Out: a number for every symbol. Given values stay; the others are tried from short lists until bodies
//! touch where they should, lie on opposite sides of their contact and approach each other. Nothing here depends on chance.

use std::f64::consts::PI;

use super::plane::{Pair, ahead, dot, minus, opposite, right, size, turned};
use crate::dimension::Dimension;
use crate::domain::Domain;
use crate::expr::{Expr, Point, Symbol, Vector, ratio};
use crate::scene::{Body, Parameter, Scene, Shape};

/// Values of all symbols of a scene.
#[derive(Clone, Debug)]
pub struct Values {
    /// The point to evaluate formulas at, in SI units.
    pub point: Point<f64>,
}

/// Free symbols whose values are looked for; beyond that the first choice stays.
const MOST: usize = 24;

/// Values to draw a scene at.
pub fn representative(scene: &Scene) -> Values {
    let mut point = Point::default();
    let mut free: Vec<(Vec<Symbol>, Vec<Vec<f64>>)> = Vec::new();
    let in_pair = |name: &Symbol| {
        scene
            .domains
            .unit_vectors
            .iter()
            .any(|pair| pair.contains(name))
    };
    let mut seen: Vec<&Dimension> = Vec::new();
    for parameter in &scene.parameters {
        let name = &parameter.name;
        if in_pair(name) {
            continue;
        }
        let hinted = scene.figure.values.iter().find(|(n, _)| n == name);
        let given = hinted
            .map(|(_, value)| value)
            .or(parameter.value.as_ref())
            .and_then(|v| v.evaluate(&Point::default()));
        let value = match given {
            Some(value) => value,
            None => {
                let earlier = seen.iter().filter(|d| ***d == parameter.dimension).count();
                let choices = choices(scene, parameter, earlier);
                let first = choices.first().copied().unwrap_or(1.0);
                free.push((
                    vec![name.clone()],
                    choices.into_iter().map(|v| vec![v]).collect(),
                ));
                first
            }
        };
        seen.push(&parameter.dimension);
        point.values.insert(name.clone(), value);
    }
    for [x, y] in &scene.domains.unit_vectors {
        let directions: Vec<Vec<f64>> = [30, 0, 90, 150, -30, 180, -90, 60, 120, -60, -120, -150]
            .iter()
            .map(|degrees| {
                let (s, c) = (f64::from(*degrees) * PI / 180.0).sin_cos();
                vec![c, s]
            })
            .collect();
        point.values.insert(x.clone(), directions[0][0]);
        point.values.insert(y.clone(), directions[0][1]);
        free.push((vec![x.clone(), y.clone()], directions));
    }
    // Turning a velocity round is less of a surprise than a negative coordinate, so lengths come later, the last one
    // first; a normal fits best once the places are settled.
    let rank = |names: &[Symbol]| {
        let length = Dimension::new(0, 1, 0);
        let is_length = |p: &Parameter| p.name == names[0] && p.dimension == length;
        (names.len(), scene.parameters.iter().any(is_length))
    };
    free.reverse();
    free.sort_by_key(|(names, _)| rank(names));
    free.truncate(MOST);
    let mut best = penalty(scene, &point);
    for _ in 0..3 {
        let before = best;
        for (names, choices) in &free {
            for (rank, choice) in choices.iter().enumerate() {
                let mut trial = point.clone();
                for (name, value) in names.iter().zip(choice) {
                    trial.values.insert(name.clone(), *value);
                }
                let cost = penalty(scene, &trial) + 1e-3 * rank as f64;
                if cost + 1e-6 < best {
                    (best, point) = (cost, trial);
                }
            }
        }
        if best == before {
            break;
        }
    }
    Values { point }
}

impl Values {
    /// Value of a formula; `None` where it has no finite one.
    pub fn of(&self, e: &Expr) -> Option<f64> {
        e.evaluate(&self.point)
            .filter(|v| v.is_finite() && v.abs() < 1e12)
    }

    /// Value of a vector.
    pub fn pair(&self, v: &Vector) -> Option<Pair> {
        Some([self.of(&v[0])?, self.of(&v[1])?])
    }

    /// A value as a caption gives it: `35°`, `0.03 m`.
    pub fn told(&self, parameter: &Parameter) -> Option<String> {
        let value = *self.point.values.get(&parameter.name)?;
        if parameter.is_angle() {
            return Some(format!("{}°", short(value * 180.0 / PI)));
        }
        let scale = parameter
            .scale()
            .evaluate(&Point::default())
            .filter(|s: &f64| *s > 0.0)
            .unwrap_or(1.0);
        let unit = parameter.unit.replace("^2", "²").replace("^3", "³");
        let unit = match unit.as_str() {
            "1" => String::new(),
            _ => format!(" {}", unit.replace('*', " ")),
        };
        Some(format!("{}{unit}", short(value / scale)))
    }
}

/// A number with at most three decimals.
pub fn short(value: f64) -> String {
    let text = format!("{value:.3}");
    let text = crate::formula::trimmed(&text);
    if text == "-0" {
        "0".to_string()
    } else {
        text.replace('-', "−")
    }
}

/// Values to try for a parameter inside its domain, the most pleasant first.
fn choices(scene: &Scene, parameter: &Parameter, earlier: usize) -> Vec<f64> {
    let domain = scene
        .domains
        .symbols
        .get(&parameter.name)
        .cloned()
        .unwrap_or_default();
    let dimension = &parameter.dimension;
    let is = |m, l, t| *dimension == Dimension::new(m, l, t);
    let wanted: Vec<f64> = if scene.counts_turns(&parameter.name) {
        vec![2.0, 1.0, 3.0]
    } else if parameter.is_angle() {
        [35.0, 55.0, 25.0, 20.0, -35.0, 125.0, 80.0, 10.0]
            .iter()
            .map(|d| d * PI / 180.0)
            .collect()
    } else if is(0, 1, 0) {
        let mut lengths = [1.0, 0.6, 0.8, 0.5, 0.7, 0.35, 1.5, 2.0];
        lengths.rotate_left(earlier % 5);
        lengths.iter().flat_map(|v| [*v, -*v]).collect()
    } else if is(1, 2, 0) {
        vec![0.2]
    } else if is(1, 0, 0) {
        let mut masses = vec![1.0, 2.0, 3.0];
        masses.rotate_left(earlier % 3);
        masses
    } else if is(0, 0, 0) {
        vec![0.5, 0.25, 1.5, -0.5]
    } else if is(0, 1, -2) {
        vec![9.81]
    } else {
        let size = [1.0, 0.6, 0.8, 0.5][earlier % 4] * pace(scene, dimension);
        vec![size, -size, 3.0 * size, 0.2 * size]
    };
    let fitting: Vec<f64> = wanted
        .into_iter()
        .filter(|v| lies_in(*v, &domain))
        .collect();
    if fitting.is_empty() {
        vec![domain.at(0.4, 1.0, 1.0)]
    } else {
        fitting
    }
}

/// How large a quantity is where things weigh: within a meter a fall takes a third of a second.
fn pace(scene: &Scene, dimension: &Dimension) -> f64 {
    let is_acceleration = |p: &Parameter| p.dimension == Dimension::new(0, 1, -2);
    let per_second = [(1, 0.3), (-1, 4.0), (-2, 10.0)];
    let found = per_second
        .iter()
        .find(|(power, _)| dimension.time == ratio(*power, 1));
    match scene.parameters.iter().any(is_acceleration) {
        true => found.map_or(1.0, |(_, size)| *size),
        false => 1.0,
    }
}

/// Whether a parameter may have a value, and all that is said of the others still holds.
pub fn fits(scene: &Scene, parameter: &Parameter, point: &Point<f64>) -> bool {
    let value = point.values.get(&parameter.name);
    let domain = scene.domains.symbols.get(&parameter.name);
    let mut relations = scene.domains.relations.iter();
    value.is_some_and(|v| domain.is_none_or(|domain| lies_in(*v, domain)))
        && relations.all(|r| r.excess.evaluate(point).is_some_and(|v: f64| v > 0.0))
}

/// Inside, and not so near an end that nothing could be seen.
fn lies_in(value: f64, domain: &Domain) -> bool {
    domain.low.as_ref().is_none_or(|l| value > l.approximate())
        && domain.high.as_ref().is_none_or(|h| value < h.approximate())
}

/// How badly the scene would look; infinite where it has no place at all.
fn penalty(scene: &Scene, point: &Point<f64>) -> f64 {
    let values = Values {
        point: point.clone(),
    };
    let mut cost = 0.0;
    for relation in &scene.domains.relations {
        // The less is missing the better, so that values found one after the other lead there.
        cost += match values.of(&relation.excess) {
            Some(excess) if excess > 0.0 => 0.0,
            Some(excess) => 1e3 + (-excess).min(1e2),
            None => 1.1e3,
        };
    }
    let bodies: Option<Vec<Pair>> = scene
        .bodies
        .iter()
        .map(|b| values.pair(&b.center))
        .collect();
    let Some(centers) = bodies else { return 1e9 };
    // What an earlier stage hands on may have no value: there the scene does not get so far.
    let never = |b: &&Body| values.pair(&b.velocity).is_none() || values.of(&b.spin).is_none();
    cost += 1e3 * scene.bodies.iter().filter(never).count() as f64;
    let arm = |body: usize, at: Pair| minus(centers[body], at);
    for contact in &scene.contacts {
        let (Some(at), [a, b]) = (values.pair(&contact.at), contact.bodies) else {
            return 1e9;
        };
        let (Some(first), Some(second)) = (scene.bodies.get(a), scene.bodies.get(b)) else {
            return 1e9;
        };
        cost += miss(first, &values, at, true) + miss(second, &values, at, true);
        let (ra, rb) = (arm(a, at), arm(b, at));
        let normal = contact.normal.as_ref().and_then(|n| values.pair(n));
        let out = match normal {
            Some(n) => n,
            None if first.is_fixed() || first.is_particle() => rb,
            None if second.is_fixed() || second.is_particle() => opposite(ra),
            None => minus(rb, ra),
        };
        for (body, r, sign) in [(first, ra, -1.0), (second, rb, 1.0)] {
            if !body.is_fixed() && size(r) > 0.0 {
                let cosine = sign * dot(r, out) / (size(r) * size(out)).max(1e-9);
                cost += if cosine < -0.05 { 4.0 } else { 0.0 };
                if matches!(body.shape, Shape::Other) {
                    cost += 2.0 * (1.0 - cosine);
                }
            }
        }
        if matches!((&first.shape, &second.shape), (Shape::Other, Shape::Other))
            && size(ra) > 0.0
            && size(rb) > 0.0
        {
            // Bodies of unknown shape are drawn about equally large.
            cost += (size(ra) / size(rb)).ln().abs();
        }
        let (Some(va), Some(vb)) = (moving(first, &values, ra), moving(second, &values, rb)) else {
            return 1e9;
        };
        let closing = dot(minus(vb, va), out);
        cost += if closing >= -1e-9 && size(out) > 0.0 {
            3.0
        } else {
            0.0
        };
    }
    for hinge in &scene.hinges {
        let Some(at) = values.pair(&hinge.at) else {
            return 1e9;
        };
        cost += hinge
            .bodies
            .iter()
            .filter_map(|b| scene.bodies.get(*b))
            .map(|b| miss(b, &values, at, false))
            .sum::<f64>();
    }
    for blow in &scene.blows {
        let (Some(at), Some(body)) = (values.pair(&blow.at), scene.bodies.get(blow.body)) else {
            return 1e9;
        };
        cost += miss(body, &values, at, false);
    }
    cost
}

/// Velocity of the body's point from which the center of mass lies at `r`.
fn moving(body: &Body, values: &Values, r: Pair) -> Option<Pair> {
    let (v, spin) = (values.pair(&body.velocity)?, values.of(&body.spin)?);
    Some(ahead(v, right(r), spin))
}

/// How far a point lies off a body's edge, or outside the body, against the body's size.
fn miss(body: &Body, values: &Values, at: Pair, on_edge: bool) -> f64 {
    let (Some(center), Some(angle)) = (values.pair(&body.center), values.of(&body.angle)) else {
        return 1e9;
    };
    let d = minus(at, center);
    let [along, across] = turned(d, -angle);
    let value = |e: &Expr| values.of(e).unwrap_or(f64::NAN);
    let off = match &body.shape {
        Shape::Rod { length } => {
            let half = value(length) / 2.0;
            ((along.abs() - half).max(0.0) + across.abs()) / half
        }
        Shape::Disk { radius } | Shape::Ring { radius } | Shape::Sphere { radius } => {
            let off = size(d) / value(radius) - 1.0;
            if on_edge { off.abs() } else { off.max(0.0) }
        }
        Shape::Rectangle { width, height } => {
            let (x, y) = (
                2.0 * along.abs() / value(width) - 1.0,
                2.0 * across.abs() / value(height) - 1.0,
            );
            if on_edge {
                x.max(y).abs()
            } else {
                x.max(y).max(0.0)
            }
        }
        _ => 0.0,
    };
    if off.is_finite() { 4.0 * off } else { 1e6 }
}
