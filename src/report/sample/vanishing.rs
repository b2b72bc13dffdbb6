//! Families that run towards a point at which something vanishes: an answer, the approach, or the arm of an impulse.

use super::{Draft, Family, Level, Sampler, approach, put, steps};
use crate::expr::Symbol;
use crate::numeric::{Given, answers, rounded, solve_f64};

impl Sampler<'_> {
    /// Families that run towards the root of some quantity.
    pub(super) fn roots(&self, count: usize, list: &mut Vec<Family>) {
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
        for (q, name) in crate::report::routes::quantities(self.scene)
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
                            Ok(a) => a.components().into_iter().map(|(_, v)| v).collect(),
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
        self.domain(name).admits(value)
    }

    /// A root of the target along one parameter, by scanning its domain and halving.
    fn root(
        &self,
        draft: &Draft,
        parameter: &Symbol,
        target: &dyn Fn(&Given<f64>, &Draft) -> Option<f64>,
    ) -> Option<f64> {
        let domain = self.domain(parameter);
        let grid: Vec<f64> = match domain.bounds() {
            [Some(low), Some(high)] => (0..=24)
                .map(|k| low + (high - low) * f64::from(k) / 24.0)
                .collect(),
            [Some(low), None] => (-16..=16)
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
}
