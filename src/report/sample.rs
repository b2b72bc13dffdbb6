//! Points to measure at: usual values inside the domains, and families that run towards one extreme each.
//!
//! In: a scene and a seed. Out: exact points, the same for the same seed on every machine. Plain parameters are doubles,
//! so they are no source of error; an angle is a rational point of the unit circle.

use crate::domain::{Domain, Limit};
use crate::expr::number::{from_f64, to_f64};
use crate::expr::{Expr, Point, Rational, Symbol};
use crate::numeric::given::GivenLaw;
use crate::numeric::points::{Needed, circle_point, needed};
use crate::numeric::{
    Answer, Given, answers, assemble, contact_reports, exact_values, given, motion, rounded,
    solve_f64,
};
use crate::scene::{ContactLaw, Scene, Shape};

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

/// SplitMix64 (Steele, Lea & Flood 2014), seeded by number and words.
#[derive(Clone)]
pub struct Rng(u64);

impl Rng {
    /// A sequence of its own for every seed and name.
    pub fn of(seed: u64, name: &str) -> Rng {
        let hash = name.bytes().fold(0xcbf2_9ce4_8422_2325u64, |h, b| {
            (h ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3)
        });
        let mut rng = Rng(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ hash);
        rng.next();
        rng
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A double in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }
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
        let mut points: Vec<Point<Rational>> = (0..count)
            .map(|k| self.exact(&self.draft("usual", k)))
            .collect();
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
        self.scene
            .domains
            .symbols
            .get(name)
            .cloned()
            .unwrap_or_else(Domain::positive)
    }

    fn is_unit_vector(&self, name: &Symbol) -> bool {
        self.scene
            .domains
            .unit_vectors
            .iter()
            .flatten()
            .any(|n| n == name)
    }

    /// Usual values in doubles, tried until the bodies approach each other at every contact.
    fn draft(&self, family: &str, k: usize) -> Draft {
        let mut rng = Rng::of(self.seed, &format!("{family} {k}"));
        let mut draft = self.any(&mut rng);
        for _ in 0..64 {
            if self.approaches(&draft) {
                break;
            }
            draft = self.any(&mut rng);
        }
        draft
    }

    fn any(&self, rng: &mut Rng) -> Draft {
        let mut draft = Draft::new();
        let plain = self
            .needed
            .plain
            .iter()
            .filter(|n| !self.needed.angles.contains_key(*n));
        for (name, angle) in plain
            .map(|n| (n, false))
            .chain(self.needed.angles.keys().map(|n| (n, true)))
        {
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
            let ends = [&domain.low, &domain.high].map(|l| l.as_ref().map(Limit::approximate));
            draft.push((
                name.clone(),
                match ends {
                    [Some(low), Some(high)] => low + (high - low) * share,
                    [Some(low), None] => low + size,
                    [None, Some(high)] => high - size,
                    [None, None] if angle => std::f64::consts::PI * (2.0 * share - 1.0),
                    [None, None] => sign * size,
                },
            ));
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
                point
                    .directions
                    .insert(name.clone(), (*n, circle(value / f64::from(*n) / 2.0)));
            } else if !self.is_unit_vector(name) {
                point
                    .values
                    .insert(name.clone(), from_f64(*value).unwrap_or_default());
            }
        }
        let of = |name: &Symbol| {
            draft
                .iter()
                .find(|(n, _)| n == name)
                .map_or(0.0, |(_, v)| *v)
        };
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
        let all = self
            .scene
            .parameters
            .iter()
            .filter(|p| p.dimension == wanted && fits(&p.name));
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

    fn masses(&self, count: usize, list: &mut Vec<Family>) {
        let masses = self.of_dimension(1, 0, 0);
        if let [first, _, ..] = masses.as_slice() {
            list.push(self.family(
                "mass ratio",
                format!("{first} × 10^k, k = −15 … 15"),
                format!("log10 of the factor of {first}"),
                &steps(-15.0, 15.0, 5.0),
                count,
                |d, x| scale(d, first, 10f64.powf(x)),
            ));
        }
    }

    fn restitution(&self, count: usize, list: &mut Vec<Family>) {
        let of = |e: &Expr| e.as_symbol().cloned();
        let e = self.scene.contacts.iter().find_map(|c| match &c.law {
            ContactLaw::Frictionless { restitution } => of(restitution),
            _ => None,
        });
        let Some(e) = e else { return };
        let zero = self.family(
            "e → 0",
            format!("{e} = 10^−k"),
            format!("−log10 {e}"),
            &steps(1.0, 16.0, 3.0),
            count,
            |d, x| put(d, &e, 10f64.powf(-x)),
        );
        let one = self.family(
            "e → 1",
            format!("{e} = 1 − 10^−k"),
            format!("−log10(1 − {e})"),
            &steps(1.0, 16.0, 1.0),
            count,
            |d, x| put(d, &e, 1.0 - 10f64.powf(-x)),
        );
        list.extend([zero, one]);
    }

    /// Families that run towards the root of some quantity.
    fn roots(&self, count: usize, list: &mut Vec<Family>) {
        type Target<'t> = (
            String,
            String,
            bool,
            Box<dyn Fn(&Given<f64>, &Draft) -> Option<f64> + 't>,
        );
        let mut targets: Vec<Target> = Vec::new();
        if let Some(c) = self.scene.contacts.iter().position(|c| c.normal.is_some()) {
            let name = &self.scene.contacts[c].name;
            targets.push((
                "near grazing".into(),
                format!("normal approach velocity at {name} → 0"),
                true,
                Box::new(move |g, _| approach(g, c)),
            ));
            let rigid = self.scene.contacts[c].bodies.into_iter().filter(|b| {
                !self.scene.bodies[*b].is_fixed() && !self.scene.bodies[*b].is_particle()
            });
            for body in rigid {
                let words = format!(
                    "arm of the impulse at {name} about the center of {} → 0",
                    self.scene.bodies[body].name
                );
                targets.push((
                    "central hit".into(),
                    words,
                    false,
                    Box::new(move |g, _| {
                        let (r, n) = (
                            g.bodies[body].arm(&g.contacts[c].joint.at),
                            g.contacts[c].normal?,
                        );
                        Some(r[0] * n[1] - r[1] * n[0])
                    }),
                ));
            }
        }
        for (q, name) in super::routes::quantities(self.scene)
            .into_iter()
            .enumerate()
            .filter(|(_, q)| q.is_motion)
            .map(|(i, q)| (i, q.name))
            .take(6)
        {
            let words = format!("{name} just after → 0 by cancellation");
            targets.push((
                format!("stop of {name}"),
                words,
                false,
                Box::new(move |_, d| {
                    let at = rounded(&self.exact(d));
                    let all = answers(self.scene, &at, solve_f64).ok()?;
                    let flat: Vec<f64> = all
                        .into_iter()
                        .flat_map(|(_, a)| match a {
                            Ok(Answer::Scalar(v)) => vec![v],
                            Ok(Answer::Vector(v)) => v.to_vec(),
                            Err(_) => vec![f64::NAN],
                        })
                        .collect();
                    flat.get(q).copied()
                }),
            ));
        }
        let mut stops = 0;
        for (name, words, approaching, target) in targets {
            let stop = name.starts_with("stop");
            if (stop && stops == 2) || list.iter().any(|f| f.name == name) {
                continue;
            }
            if let Some(family) = self.towards(&name, &words, approaching, stop, count, &*target) {
                stops += usize::from(stop);
                list.push(family);
            }
        }
        self.dead_centre(count, list);
    }

    /// Points where one parameter runs to a root of `target`; the first parameter that has one is taken.
    fn towards(
        &self,
        name: &str,
        words: &str,
        approaching: bool,
        keeps_approach: bool,
        count: usize,
        target: &dyn Fn(&Given<f64>, &Draft) -> Option<f64>,
    ) -> Option<Family> {
        let angles = self.needed.angles.keys();
        let mut parameters: Vec<Symbol> = [(0, 1, -1), (0, 0, -1)]
            .iter()
            .flat_map(|(m, l, t)| self.of_dimension(*m, *l, *t))
            .collect();
        let lengths = self.of_dimension(0, 1, 0);
        parameters.extend(angles.cloned());
        parameters.extend(lengths);
        parameters.extend(
            self.scene
                .parameters
                .iter()
                .filter(|p| p.dimension.is_none())
                .map(|p| p.name.clone())
                .filter(|n| self.needed.plain.contains(n) && !self.is_unit_vector(n)),
        );
        parameters.extend(self.of_dimension(1, 0, 0));
        let mut roots: Option<(Symbol, Vec<(Draft, f64)>)> = None;
        for parameter in &parameters {
            let found: Vec<(Draft, f64)> = (0..count)
                .filter_map(|k| {
                    let draft = self.draft(name, k);
                    let root = self.root(&draft, parameter, target)?;
                    Some((draft, root))
                })
                .collect();
            if found.len() * 2 > count.min(4)
                && roots.as_ref().is_none_or(|(_, r)| r.len() < found.len())
            {
                let complete = found.len() == count;
                roots = Some((parameter.clone(), found));
                if complete {
                    break;
                }
            }
        }
        let (parameter, roots) = roots?;
        let angle = self.needed.angles.contains_key(&parameter);
        let level = |x: f64| {
            let points = roots.iter().filter_map(|(draft, root)| {
                let step = 10f64.powf(-x);
                [1.0, -1.0].into_iter().find_map(|side| {
                    let value = if angle || *root == 0.0 {
                        root + side * step
                    } else {
                        root * (1.0 + side * step)
                    };
                    let mut near = draft.clone();
                    if !put(&mut near, &parameter, value) || !self.inside(&parameter, value) {
                        return None;
                    }
                    let fits = (!approaching && !keeps_approach) || self.approaches(&near);
                    fits.then(|| self.exact(&near))
                })
            });
            Level {
                x,
                points: points.collect(),
            }
        };
        let mut levels: Vec<Level> = steps(1.0, 15.0, 2.0).into_iter().map(level).collect();
        levels.retain(|l| !l.points.is_empty());
        (!levels.is_empty()).then(|| Family {
            name: name.into(),
            words: format!("{words}, by {parameter}"),
            axis: format!("−log10 of distance in {parameter}"),
            levels,
        })
    }

    fn inside(&self, name: &Symbol, value: f64) -> bool {
        let domain = self.domain(name);
        let ends = [&domain.low, &domain.high].map(|l| l.as_ref().map(Limit::approximate));
        ends[0].is_none_or(|low| value >= low) && ends[1].is_none_or(|high| value <= high)
    }

    /// A root of the target along one parameter, by scanning its domain and halving.
    fn root(
        &self,
        draft: &Draft,
        parameter: &Symbol,
        target: &dyn Fn(&Given<f64>, &Draft) -> Option<f64>,
    ) -> Option<f64> {
        let domain = self.domain(parameter);
        let [low, high] = [&domain.low, &domain.high].map(|l| l.as_ref().map(Limit::approximate));
        let grid: Vec<f64> = match (low, high) {
            (Some(low), Some(high)) => (0..=24)
                .map(|k| low + (high - low) * f64::from(k) / 24.0)
                .collect(),
            (Some(low), None) => (-16..=16)
                .map(|k| low + 2f64.powf(f64::from(k) / 4.0))
                .collect(),
            _ => (-16..=16).map(|k| f64::from(k) / 2.0 + 0.013).collect(),
        };
        let mut near = draft.clone();
        let mut at = |value: f64| {
            put(&mut near, parameter, value);
            let given = self.given(&near)?;
            target(&given, &near).filter(|v| v.is_finite())
        };
        let values: Vec<Option<f64>> = grid.iter().map(|v| at(*v)).collect();
        // A quantity that is zero all along is no root but a fact.
        if values.iter().flatten().filter(|v| v.abs() < 1e-12).count() > 2 {
            return None;
        }
        for (k, pair) in values.windows(2).enumerate() {
            let [Some(a), Some(b)] = pair else { continue };
            let (a, b) = (*a, *b);
            if a * b > 0.0 {
                continue;
            }
            let (mut left, mut right) = (grid[k], grid[k + 1]);
            for _ in 0..70 {
                let middle = 0.5 * (left + right);
                if middle <= left || middle >= right {
                    break;
                }
                match at(middle) {
                    Some(v) if (v > 0.0) == (a > 0.0) && v != 0.0 => left = middle,
                    Some(_) => right = middle,
                    None => return None,
                }
            }
            return Some(right);
        }
        None
    }

    /// All links that carry the impulse in line with it: the joints take everything, the contact gives way no more.
    fn dead_centre(&self, count: usize, list: &mut Vec<Family>) {
        let Some(contact) =
            self.scene.contacts.iter().position(|c| {
                c.normal.is_some() && matches!(c.law, ContactLaw::Frictionless { .. })
            })
        else {
            return;
        };
        if self.scene.hinges.is_empty() || self.needed.angles.is_empty() {
            return;
        }
        // Links from the struck body on, each from the joint met to its other hinge.
        let mut links: Vec<(usize, Option<usize>, usize)> = Vec::new();
        let mut at = self.scene.contacts[contact]
            .bodies
            .into_iter()
            .find(|b| self.scene.hinges.iter().any(|h| h.bodies.contains(b)));
        let mut from: Option<usize> = None;
        while let Some(body) = at {
            let next = self.scene.hinges.iter().position(|h| {
                h.bodies.contains(&body) && from.is_none_or(|f| self.scene.hinges[f].at != h.at)
            });
            let Some(hinge) = next else { break };
            links.push((body, from, hinge));
            let [a, b] = self.scene.hinges[hinge].bodies;
            let other = if a == body { b } else { a };
            from = Some(hinge);
            at = (!self.scene.bodies[other].is_fixed() && links.len() < 8).then_some(other);
        }
        if links.is_empty() {
            return;
        }
        let sine = |g: &Given<f64>, (_, from, to): &(usize, Option<usize>, usize)| {
            let start = from.map_or(g.contacts[contact].joint.at, |h| g.hinges[h].at);
            let end = g.hinges[*to].at;
            let n = g.contacts[contact].normal?;
            let l = [end[0] - start[0], end[1] - start[1]];
            Some((l[0] * n[1] - l[1] * n[0]) / l[0].hypot(l[1]))
        };
        let mut aligned: Vec<(Draft, Vec<(Symbol, f64)>)> = Vec::new();
        for k in 0..count {
            let mut draft = self.draft("dead centre", k);
            let mut set: Vec<(Symbol, f64)> = Vec::new();
            for link in &links {
                let free = self
                    .needed
                    .angles
                    .keys()
                    .filter(|n| !set.iter().any(|(s, _)| s == *n))
                    .cloned()
                    .collect::<Vec<_>>();
                for parameter in free {
                    if let Some(root) = self.root(&draft, &parameter, &|g, _| sine(g, link)) {
                        put(&mut draft, &parameter, root);
                        set.push((parameter, root));
                        break;
                    }
                }
            }
            let Some(given) = self.given(&draft) else {
                continue;
            };
            if links
                .iter()
                .all(|l| sine(&given, l).is_some_and(|s| s.abs() < 1e-12))
            {
                aligned.push((draft, set));
            }
        }
        if aligned.is_empty() {
            return;
        }
        let level = |x: f64| {
            let points = aligned.iter().filter_map(|(draft, set)| {
                [1.0, -1.0].into_iter().find_map(|side| {
                    let mut near = draft.clone();
                    for (k, (name, root)) in set.iter().enumerate() {
                        // Not quite in parallel, or the links would stay in line with each other.
                        let value = root + side * 10f64.powf(-x) * (1.0 + 0.5 * k as f64);
                        put(&mut near, name, value);
                        if !self.inside(name, value) {
                            return None;
                        }
                    }
                    Some(self.exact(&near))
                })
            });
            Level {
                x,
                points: points.collect(),
            }
        };
        let mut levels: Vec<Level> = steps(1.0, 8.0, 1.0).into_iter().map(level).collect();
        levels.retain(|l| !l.points.is_empty());
        if !levels.is_empty() {
            list.push(Family {
                name: "dead centre".into(),
                words: format!(
                    "{} link{} at an angle φ to the normal, φ → 0",
                    links.len(),
                    if links.len() == 1 { "" } else { "s" }
                ),
                axis: "−log10 φ".into(),
                levels,
            });
        }
    }

    fn sizes(&self, count: usize, list: &mut Vec<Family>) {
        let lengths = self.of_dimension(0, 1, 0);
        let inertias = self.of_dimension(1, 2, 0);
        let in_place = |name: &Symbol| {
            let mut places = self
                .scene
                .bodies
                .iter()
                .map(|b| &b.center)
                .chain(self.scene.hinges.iter().map(|h| &h.at))
                .chain(self.scene.contacts.iter().map(|c| &c.at));
            places.any(|v| v.iter().any(|e| e.symbols().contains(name)))
        };
        let in_inertia = |name: &Symbol| {
            self.scene
                .bodies
                .iter()
                .any(|b| b.inertia.symbols().contains(name))
        };
        let rectangle = self.scene.bodies.iter().find_map(|b| match &b.shape {
            Shape::Rectangle { width, .. } => width.as_symbol().cloned(),
            _ => None,
        });
        if let Some(width) = rectangle {
            list.push(self.family(
                "slender and wide",
                format!("{width} × 10^k, k = −6 … 6"),
                format!("log10 of the factor of {width}"),
                &steps(-6.0, 6.0, 3.0),
                count,
                |d, x| scale(d, &width, 10f64.powf(x)),
            ));
        }
        if let Some(arm) = lengths
            .iter()
            .find(|l| in_place(l))
            .filter(|_| lengths.len() + inertias.len() > 1)
        {
            list.push(self.family(
                "long and short arms",
                format!("{arm} × 10^k, k = −8 … 8"),
                format!("log10 of the factor of {arm}"),
                &steps(-8.0, 8.0, 4.0),
                count,
                |d, x| scale(d, arm, 10f64.powf(x)),
            ));
        }
        let radius = lengths.iter().find(|l| in_inertia(l) && !in_place(l));
        match (inertias.is_empty(), radius) {
            (false, _) => list.push(self.family(
                "radius of gyration → 0",
                format!("{} × 10^−2k, so k_G × 10^−k", inertias.join(", ")),
                "−log10 of the factor of k_G".into(),
                &steps(0.0, 8.0, 1.0),
                count,
                |d, x| inertias.iter().all(|i| scale(d, i, 10f64.powf(-2.0 * x))),
            )),
            (true, Some(k)) => list.push(self.family(
                "radius of gyration → 0",
                format!("{k} × 10^−k"),
                format!("−log10 of the factor of {k}"),
                &steps(0.0, 8.0, 1.0),
                count,
                |d, x| scale(d, k, 10f64.powf(-x)),
            )),
            _ => {}
        }
    }

    /// Everything large or small in powers of two, which changes no digit of any right answer.
    fn ranges(&self, count: usize, list: &mut Vec<Family>) {
        let masses = self.of_dimension(1, 0, 0);
        let lengths = self.of_dimension(0, 1, 0);
        let inertias = self.of_dimension(1, 2, 0);
        let speeds = self.of_dimension(0, 1, -1);
        let spins = self.of_dimension(0, 0, -1);
        let impulses = self.of_dimension(1, 1, -1);
        if speeds.is_empty() && spins.is_empty() && impulses.is_empty() {
            return;
        }
        let change = |d: &mut Draft, mass: i32, length: i32, time: i32| {
            let mut all = true;
            for (names, power) in [
                (&masses, mass),
                (&lengths, length),
                (&inertias, mass + 2 * length),
                (&speeds, length - time),
                (&spins, -time),
                (&impulses, mass + length - time),
            ] {
                for name in names {
                    all &= (-1000..1000).contains(&power) && scale(d, name, 2f64.powi(power));
                }
            }
            all
        };
        list.push(self.family(
            "overflow",
            "all masses and speeds × 2^k: m v² up to 10^405".into(),
            "k".into(),
            &steps(0.0, 450.0, 90.0),
            count,
            |d, x| {
                let k = x as i32;
                change(d, k, 0, -k)
            },
        ));
        list.push(self.family(
            "underflow",
            "all masses and lengths × 2^−k, speeds kept: m l² down to 10^−325".into(),
            "k".into(),
            &steps(0.0, 360.0, 90.0),
            count,
            |d, x| {
                let k = x as i32;
                change(d, -k, -k, -k)
            },
        ));
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

/// Normal relative velocity before at a contact with a normal, u_n⁻; negative when approaching.
pub fn approach(given: &Given<f64>, contact: usize) -> Option<f64> {
    let c = &given.contacts[contact];
    let n = c.normal?;
    let [one, two] = c
        .joint
        .bodies
        .map(|b| given.bodies[b].velocity_before(&c.joint.at));
    Some(n[0] * (two[0] - one[0]) + n[1] * (two[1] - one[1]))
}

/// What is special about a point: grazing, cancelling and the like.
pub fn flags(given: &Given<f64>, conditions: &[f64]) -> Vec<&'static str> {
    let mut flags = Vec::new();
    for (i, c) in given.contacts.iter().enumerate() {
        let Some(u) = approach(given, i) else {
            continue;
        };
        let size: f64 = c
            .joint
            .bodies
            .iter()
            .map(|b| {
                let body = &given.bodies[*b];
                let r = body.arm(&c.joint.at);
                body.velocity[0].abs()
                    + body.velocity[1].abs()
                    + body.spin.abs() * (r[0].abs() + r[1].abs())
            })
            .sum();
        if u.abs() <= 1e-6 * size {
            flags.push("grazing");
        }
        if u > 0.0 {
            flags.push("separating");
        }
        if let (GivenLaw::Frictionless(_), Some(n)) = (&c.law, &c.normal) {
            let lined = |h: &crate::numeric::given::Joint<f64>| {
                let l = [h.at[0] - c.joint.at[0], h.at[1] - c.joint.at[1]];
                h.bodies.iter().any(|b| c.joint.bodies.contains(b))
                    && (l[0] * n[1] - l[1] * n[0]).abs() <= 1e-3 * l[0].hypot(l[1])
            };
            if given.hinges.iter().any(lined) {
                flags.push("dead centre");
            }
        }
    }
    if conditions.iter().any(|c| *c > 1e6) {
        flags.push("cancelling");
    }
    let inertia = given.bodies.iter().map(|b| b.inertia).filter(|i| *i != 0.0);
    let energy = given
        .bodies
        .iter()
        .map(|b| b.mass * (b.velocity[0].powi(2) + b.velocity[1].powi(2)))
        .filter(|e| *e != 0.0);
    if inertia.chain(energy).any(|v| !(1e-290..1e290).contains(&v)) {
        flags.push("out of range");
    }
    flags.sort_unstable();
    flags.dedup();
    flags
}

/// Whether the motion at a point is possible at every contact with a normal, in doubles.
pub fn is_admissible(given: &Given<f64>) -> bool {
    let system = assemble(given);
    let Ok(solution) = solve_f64(&system) else {
        return false;
    };
    contact_reports(given, &motion(given, &system, &solution))
        .iter()
        .flatten()
        .all(|r| r.admissible)
}

/// The parameter values of a point, for people.
pub fn words(point: &Point<Rational>) -> String {
    let plain = point
        .values
        .iter()
        .map(|(n, v)| format!("{n} = {:e}", to_f64(v)));
    let turned = point
        .directions
        .iter()
        .map(|(n, (k, [c, s]))| format!("{n} = {:e}", f64::from(*k) * to_f64(s).atan2(to_f64(c))));
    plain.chain(turned).collect::<Vec<_>>().join(", ")
}
