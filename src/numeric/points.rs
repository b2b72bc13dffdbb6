//! Points to compare at: every symbol of a scene gets a small fraction inside its domain, every angle a rational point of
//! the unit circle.
//!
//! In: symbols, domains, a seed. Out: a point with exact values. The same seed gives the same point on every machine and
//! in whatever order symbols are met. Knows nothing of what will be evaluated there.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;

use num_integer::Integer;
use num_traits::{One, Zero};

use crate::domain::roles;
use crate::domain::{Domain, Domains, Limit};
use crate::expr::number::to_f64;
use crate::expr::{Expr, Int, Point, Rational, Symbol, ratio};
use crate::numeric::random::Rng;
use crate::scene::{BlowImpulse, ContactLaw, KnownQuantity, Scene};

/// The symbols some formulas need values for: plain ones, and angles with the divisor N whose multiples occur.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Needed {
    /// Symbols that occur outside sines and cosines.
    pub plain: BTreeSet<Symbol>,
    /// Symbols that occur under sine, cosine or tangent, with the least N such that only multiples of angle/N occur.
    pub angles: BTreeMap<Symbol, u32>,
}

impl Needed {
    /// Adds what `e` needs.
    pub fn add(&mut self, e: &Expr) {
        for (name, role) in roles(&[e]).symbols {
            if role.turns {
                let entry = self.angles.entry(name.clone()).or_insert(1);
                *entry = entry.lcm(&role.divisor.min(1 << 16)).min(1 << 16);
            }
            if role.bare {
                self.plain.insert(name);
            }
        }
    }
}

/// Everything the geometry, the motion before and the questions of a scene need.
pub fn needed(scene: &Scene) -> Needed {
    let mut needed = Needed::default();
    let mut vectors = Vec::new();
    for body in &scene.bodies {
        if !body.is_fixed() {
            needed.add(&body.mass);
            if !body.is_particle() {
                needed.add(&body.inertia);
            }
        }
        needed.add(&body.spin);
        vectors.extend([&body.center, &body.velocity]);
    }
    vectors.extend(scene.hinges.iter().map(|h| &h.at));
    for contact in &scene.contacts {
        vectors.push(&contact.at);
        vectors.extend(&contact.normal);
        match &contact.law {
            ContactLaw::Frictionless { restitution } => needed.add(restitution),
            ContactLaw::Friction(law) => law.numbers().into_iter().for_each(|e| needed.add(e)),
            ContactLaw::Decided(decided) => {
                let numbers = decided.conditions.iter().flat_map(|c| c.numbers());
                numbers.for_each(|e| needed.add(e));
            }
            ContactLaw::None | ContactLaw::Sticking => {}
        }
    }
    for blow in &scene.blows {
        let (BlowImpulse::Given(v) | BlowImpulse::Along(v)) = &blow.impulse;
        vectors.extend([&blow.at, v]);
    }
    for known in &scene.after {
        needed.add(&known.value);
        if let KnownQuantity::Velocity { at, along, .. } = &known.what {
            vectors.extend([at, along]);
        }
    }
    for question in scene.asked_of_impact() {
        vectors.extend(question.ask.vectors());
    }
    for v in vectors {
        v.iter().for_each(|e| needed.add(e));
    }
    needed
}

/// An exact point inside the domains. An undeclared symbol is taken as positive, an undeclared angle as one of the first
/// quadrant. A symbol that is both an angle under a sine and a plain factor gets its direction only.
pub fn random_point(needed: &Needed, domains: &Domains, seed: u64) -> Point<Rational> {
    if domains.relations.is_empty() {
        return any_point(needed, domains, seed);
    }
    let mut all = needed.clone();
    let own = needed.plain.iter().chain(needed.angles.keys());
    for relation in domains.relations_of(&own.cloned().collect()) {
        all.add(&relation.excess);
    }
    // Of points drawn one after the other, the first that keeps to the relations; seeds far apart stay apart.
    let drawn = (0..DRAWS).map(|k| any_point(&all, domains, seed.wrapping_add(k << 32)));
    let mut kept = drawn.filter(|point| keeps(domains, &rounded(point)));
    kept.next()
        .unwrap_or_else(|| any_point(needed, domains, seed))
}

/// The same, with values of all sizes where nothing bounds them: some motions only come about where something is large or
/// small against the rest.
pub fn point_of_any_size(needed: &Needed, domains: &Domains, seed: u64) -> Point<Rational> {
    let point = random_point(needed, domains, seed);
    let mut scaled = point.clone();
    for (name, value) in scaled.values.iter_mut() {
        let domain = domains.of_symbol(name);
        let factors = [(1, 100), (1, 10), (1, 1), (10, 1), (100, 1)].map(|(p, q)| ratio(p, q));
        // Another sequence than the one that drew the value.
        let other = &*value * &factors[Rng::of(!seed, name).below(factors.len())];
        if domain.high.is_none() && domain.contains(&other) {
            *value = other;
        }
    }
    match keeps(domains, &rounded(&scaled)) {
        true => scaled,
        false => point,
    }
}

/// Most points drawn for one that keeps to all relations.
const DRAWS: u64 = 2000;

/// Whether a point keeps clearly to every relation between symbols that have a value there.
pub fn keeps(domains: &Domains, point: &Point<f64>) -> bool {
    let mut relations = domains.relations.iter();
    relations.all(|r| {
        let value = r.excess.evaluate(point);
        value.is_none_or(|value| value > 1e-9 || (r.closed && value > -1e-12))
    })
}

fn any_point(needed: &Needed, domains: &Domains, seed: u64) -> Point<Rational> {
    let mut point = Point::default();
    for (name, divisor) in &needed.angles {
        let mut rng = Rng::of(seed, name);
        point.directions.insert(
            name.clone(),
            (
                *divisor,
                direction(domains.symbols.get(name), *divisor, &mut rng),
            ),
        );
    }
    for pair in &domains.unit_vectors {
        let mut rng = Rng::of(seed, &pair[0]);
        let tangent = ratio(rng.below(19) as i64 - 9, 1 + rng.below(9) as i64);
        let [c, s] = circle_point(&tangent);
        point.values.insert(pair[0].clone(), c);
        point.values.insert(pair[1].clone(), s);
    }
    for name in &needed.plain {
        if !point.values.contains_key(name) && !point.directions.contains_key(name) {
            let mut rng = Rng::of(seed, name);
            point
                .values
                .insert(name.clone(), inside(domains.symbols.get(name), &mut rng));
        }
    }
    point
}

/// The exact values of given numbers: plain symbols as they are; an angle by a rational point of the circle, where its
/// value is a multiple of π/2. `None` for an angle whose sine is no fraction.
pub fn quarter_turns(turns: &Rational) -> Option<[Rational; 2]> {
    let quarters = turns * ratio(2, 1);
    let k = quarters
        .is_integer()
        .then(|| quarters.numer().mod_floor(&Int::from(4)))?
        .as_i64()?;
    let (c, s) = [(1, 0), (0, 1), (-1, 0), (0, -1)][k as usize];
    Some([ratio(c, 1), ratio(s, 1)])
}

/// The same point in doubles: plain values rounded, angles by their directions.
pub fn rounded(point: &Point<Rational>) -> Point<f64> {
    point.map(to_f64)
}

/// The same point, in which angles that are known by their direction only have their value between −π and π, times the
/// divisor.
pub fn with_angles(point: &Point<f64>) -> Point<f64> {
    let mut out = point.clone();
    for (name, (divisor, [c, s])) in &point.directions {
        let whole = s.atan2(*c) * f64::from(*divisor);
        out.values.get_or_insert(name, || whole);
    }
    out
}

/// (cos φ, sin φ) for t = tan(φ/2).
pub fn circle_point(t: &Rational) -> [Rational; 2] {
    let square = t * t;
    let below = (&square + Rational::one()).recip();
    [(Rational::one() - square) * &below, t * ratio(2, 1) * below]
}

/// A rational direction of angle/N with the angle strictly inside its domain.
fn direction(domain: Option<&Domain>, divisor: u32, rng: &mut Rng) -> [Rational; 2] {
    let domain = domain.cloned().unwrap_or_else(Domain::first_quadrant);
    let low = domain.low.as_ref().map_or(-PI, Limit::approximate);
    let high = domain.high.as_ref().map_or(PI, Limit::approximate).max(low);
    // The angle is chosen first, then replaced by a nearby one with a simple tangent of a quarter... of its N-th part.
    let share = (1 + rng.below(62)) as f64 / 64.0;
    let part = (low + (high - low) * share) / f64::from(divisor);
    let half = part / 2.0;
    let spread = (high - low) / f64::from(divisor) / 2.0;
    // Thirds alone would give the first quadrant two directions only.
    let coarsest = rng.below(2);
    for denominator in [3i64, 8, 21, 64, 1024, 1 << 20].into_iter().skip(coarsest) {
        let numerator = (half.tan() * denominator as f64).round();
        let found = (numerator / denominator as f64).atan();
        let turned = (half / PI).round() * PI;
        let margin = spread * (share.min(1.0 - share)) * 0.9;
        if (found + turned - half).abs() < margin && numerator.abs() < 1e15 {
            let [c, s] = circle_point(&ratio(numerator as i64, denominator));
            return [c, s];
        }
    }
    match half.cos().abs() < 1e-6 {
        true => [ratio(-1, 1), Rational::zero()],
        false => circle_point(&ratio((half.tan() * 1048576.0).round() as i64, 1048576)),
    }
}

/// A small fraction strictly inside the domain.
fn inside(domain: Option<&Domain>, rng: &mut Rng) -> Rational {
    let domain = domain.cloned().unwrap_or_else(Domain::positive);
    // 22/7 for π would do for sampling anywhere but at the end; 355/113 is closer, and the end itself is never taken.
    let end = |l: &Limit| {
        if l.of_pi {
            &l.value * ratio(355, 113)
        } else {
            l.value.clone()
        }
    };
    let step = ratio(1 + rng.below(24) as i64, 1 + rng.below(7) as i64);
    match (&domain.low, &domain.high) {
        (Some(low), Some(high)) => {
            let (low, high) = (end(low), end(high));
            let width = &high - &low;
            low + width * ratio(1 + rng.below(22) as i64, 24)
        }
        (Some(low), None) => end(low) + step,
        (None, Some(high)) => end(high) - step,
        (None, None) => {
            if rng.below(2) == 0 {
                step
            } else {
                -step
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use num_traits::Signed;

    use super::*;

    fn between(low: Rational, high: Rational, of_pi: bool) -> Domain {
        let limit = |value| {
            Some(Limit {
                value,
                of_pi,
                open: true,
            })
        };
        Domain {
            low: limit(low),
            high: limit(high),
        }
    }

    #[test]
    fn points_lie_inside_their_domains_and_on_the_circle() {
        let mut domains = Domains::default();
        domains
            .symbols
            .insert("e".into(), between(ratio(0, 1), ratio(1, 1), false));
        domains
            .symbols
            .insert("alpha".into(), between(ratio(2, 5), ratio(1, 2), true));
        domains.unit_vectors.push(["nx".into(), "ny".into()]);
        let mut needed = Needed::default();
        let half = Expr::symbol("alpha") * Expr::ratio(1, 2);
        let theta = Expr::symbol("theta");
        for e in [
            half.sin(),
            Expr::symbol("e") * Expr::symbol("nx") + Expr::symbol("ny"),
            theta.cos(),
        ] {
            needed.add(&e);
        }
        assert_eq!(needed.angles[&Symbol::from("alpha")], 2);
        for seed in 0..500 {
            let point = random_point(&needed, &domains, seed);
            let e = &point.values["e"];
            assert!(e.is_positive() && *e < ratio(1, 1));
            let [nx, ny] = ["nx", "ny"].map(|n| &point.values[n]);
            assert_eq!(nx * nx + ny * ny, ratio(1, 1));
            for (name, low, high) in [("alpha", 0.4 * PI, 0.5 * PI), ("theta", 0.0, 0.5 * PI)] {
                let (n, [c, s]) = &point.directions[name];
                assert_eq!(c * c + s * s, ratio(1, 1));
                let angle = to_f64(s).atan2(to_f64(c)) * f64::from(*n);
                assert!(low < angle && angle < high, "{name} = {angle}");
            }
        }
    }
}
