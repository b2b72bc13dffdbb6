//! Points to measure at: usual values inside the domains, and families that run towards one extreme each.
//!
//! In: a scene and a seed. Out: exact points, the same for the same seed on every machine. Plain parameters are doubles,
//! so they are no source of error; an angle is a rational point of the unit circle.

use crate::domain::Domain;
use crate::expr::number::from_f64;
use crate::expr::{Point, Rational, Symbol};
use crate::numeric::points::{Needed, circle_point, keeps, needed};
use crate::numeric::random::Rng;
use crate::numeric::{Given, exact_values, given, rounded};
use crate::scene::Scene;

mod extremes;
mod flags;
mod vanishing;

pub use extremes::RANGES;
pub use flags::{approach, flags};

/// Points that share one extreme.
#[derive(Clone, Debug)]
pub struct Family {
    /// Short name, such as `mass ratio`.
    pub name: String,
    /// What is varied, in words.
    pub words: String,
    /// What the levels count, such as `log10(m1 × …)`.
    pub axis: String,
    /// The levels, in order.
    pub levels: Vec<Level>,
}

/// One step towards the extreme.
#[derive(Clone, Debug)]
pub struct Level {
    /// Place on the family's axis.
    pub x: f64,
    /// The points.
    pub points: Vec<Point<Rational>>,
}

/// A point under construction: every symbol by its value in doubles, angles in radians.
type Draft = Vec<(Symbol, f64)>;

/// What is needed to make points of a scene.
pub struct Sampler<'a> {
    scene: &'a Scene,
    needed: Needed,
    seed: u64,
}

impl<'a> Sampler<'a> {
    /// For a scene and a seed.
    pub fn new(scene: &'a Scene, seed: u64) -> Sampler<'a> {
        Sampler {
            scene,
            needed: needed(scene),
            seed,
        }
    }

    /// Usual values: the scene's own where they are exact, then `count` points of size one.
    pub fn usual(&self, count: usize) -> Family {
        let points = (0..count).map(|k| self.exact(&self.draft("usual", k)));
        let mut points: Vec<Point<Rational>> = points.collect();
        if let Ok(own) = exact_values(self.scene) {
            points.insert(0, own);
        }
        Family {
            name: "usual values".into(),
            words: "all parameters of size one, bodies approaching".into(),
            axis: "".into(),
            levels: vec![Level { x: 0.0, points }],
        }
    }

    fn domain(&self, name: &Symbol) -> Domain {
        let domain = self.scene.domains.symbols.get(name);
        domain.cloned().unwrap_or_else(Domain::positive)
    }

    fn is_unit_vector(&self, name: &Symbol) -> bool {
        let vectors = &self.scene.domains.unit_vectors;
        vectors.iter().flatten().any(|n| n == name)
    }

    /// Usual values in doubles, tried until the bodies approach each other at every contact.
    fn draft(&self, family: &str, k: usize) -> Draft {
        let mut rng = Rng::of(self.seed, &format!("{family} {k}"));
        let mut draft = self.any(&mut rng);
        for _ in 0..64 {
            if self.keeps_relations(&draft) && self.approaches(&draft) {
                break;
            }
            draft = self.any(&mut rng);
        }
        draft
    }

    fn keeps_relations(&self, draft: &Draft) -> bool {
        keeps(&self.scene.domains, &rounded(&self.exact(draft)))
    }

    fn any(&self, rng: &mut Rng) -> Draft {
        let mut draft = Draft::new();
        let Needed { plain, angles, .. } = &self.needed;
        let plain = plain.iter().filter(|n| !angles.contains_key(*n));
        let angles = angles.keys().map(|n| (n, true));
        for (name, angle) in plain.map(|n| (n, false)).chain(angles) {
            let share = 0.03 + 0.94 * rng.unit();
            let size = 2f64.powf(4.0 * share - 2.0);
            let sign = if rng.unit() < 0.5 { -1.0 } else { 1.0 };
            if self.is_unit_vector(name) {
                continue;
            }
            let domain = match self.scene.domains.symbols.get(name) {
                None if angle => Domain::first_quadrant(),
                _ => self.domain(name),
            };
            let free = match angle {
                true => std::f64::consts::PI * (2.0 * share - 1.0),
                false => sign * size,
            };
            draft.push((name.clone(), domain.at(share, size, free)));
        }
        for pair in &self.scene.domains.unit_vectors {
            let t = 3.0 * (2.0 * rng.unit() - 1.0);
            let whole = 1.0 + t * t;
            draft.push((pair[0].clone(), (1.0 - t * t) / whole));
            draft.push((pair[1].clone(), 2.0 * t / whole));
        }
        draft
    }

    /// The exact point: plain values as they are, angles and unit vectors by the tangent of their half, a double.
    fn exact(&self, draft: &Draft) -> Point<Rational> {
        let mut point = Point::default();
        let circle = |half: f64| {
            let t = half.tan();
            circle_point(&from_f64(if t.abs() < 1e16 { t } else { 1e16 }).unwrap_or_default())
        };
        for (name, value) in draft {
            if let Some(n) = self.needed.angles.get(name) {
                let direction = (*n, circle(value / f64::from(*n) / 2.0));
                point.directions.insert(name.clone(), direction);
            } else if !self.is_unit_vector(name) {
                let value = from_f64(*value).unwrap_or_default();
                point.values.insert(name.clone(), value);
            }
        }
        let entry = |name: &Symbol| draft.iter().find(|(n, _)| n == name);
        let of = |name: &Symbol| entry(name).map_or(0.0, |(_, v)| *v);
        for [a, b] in &self.scene.domains.unit_vectors {
            let [c, s] = circle(of(b).atan2(of(a)) / 2.0);
            point.values.insert(a.clone(), c);
            point.values.insert(b.clone(), s);
        }
        point
    }

    fn given(&self, draft: &Draft) -> Option<Given<f64>> {
        given(self.scene, &rounded(&self.exact(draft))).ok()
    }

    fn approaches(&self, draft: &Draft) -> bool {
        let Some(given) = self.given(draft) else {
            return false;
        };
        (0..given.contacts.len()).all(|c| approach(&given, c).is_none_or(|u| u < 0.0))
    }

    /// Every family the scene has, `count` points a level.
    pub fn families(&self, count: usize) -> Vec<Family> {
        let mut list = vec![self.usual(count * 8)];
        self.masses(count, &mut list);
        self.restitution(count, &mut list);
        self.roots(count, &mut list);
        self.sizes(count, &mut list);
        self.ranges(count, &mut list);
        list
    }

    fn of_dimension(&self, mass: i64, length: i64, time: i64) -> Vec<Symbol> {
        let wanted = crate::dimension::Dimension::new(mass, length, time);
        let fits = |name: &Symbol| self.needed.plain.contains(name);
        let all = self.scene.parameters.iter();
        let all = all.filter(|p| p.dimension == wanted && fits(&p.name));
        all.map(|p| p.name.clone()).collect()
    }

    fn family(
        &self,
        name: &str,
        words: String,
        axis: String,
        xs: &[f64],
        count: usize,
        change: impl Fn(&mut Draft, f64) -> bool,
    ) -> Family {
        let level = |x: f64| {
            let points = (0..count).filter_map(|k| {
                let mut draft = self.draft(name, k);
                change(&mut draft, x).then(|| self.exact(&draft))
            });
            Level {
                x,
                points: points.collect(),
            }
        };
        let mut levels: Vec<Level> = xs.iter().map(|x| level(*x)).collect();
        levels.retain(|l| !l.points.is_empty());
        Family {
            name: name.into(),
            words,
            axis,
            levels,
        }
    }
}

fn steps(from: f64, to: f64, by: f64) -> Vec<f64> {
    let count = ((to - from) / by).round() as i32;
    (0..=count).map(|k| from + by * f64::from(k)).collect()
}

fn put(draft: &mut Draft, name: &Symbol, value: f64) -> bool {
    match draft.iter_mut().find(|(n, _)| n == name) {
        Some(entry) if value.is_finite() => {
            entry.1 = value;
            true
        }
        _ => false,
    }
}

fn scale(draft: &mut Draft, name: &Symbol, by: f64) -> bool {
    match draft.iter().find(|(n, _)| n == name).map(|(_, v)| v * by) {
        Some(value) if value.is_normal() => put(draft, name, value),
        _ => false,
    }
}
