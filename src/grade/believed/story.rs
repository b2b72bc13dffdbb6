//! What comes out of a scene with stages under a belief: the whole story is told again as believed.
//!
//! In: the scene, and somebody who tells stories. Out: what explains a wrong answer to a question about a stage.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use super::super::belief::{self, Belief, Slip};
use super::super::context::{Context, quotient};
use super::super::{Diagnosis, Key, Options};
use super::{COINCIDENCE, FACTORS, MOST_STEPS, NAMED, in_decade, words};
use crate::answer::{Answer, Form};
use crate::equality::identical;
use crate::expr::{Expr, Point, effort};
use crate::scene::{Scene, StageKind};

/// Stories told at most for one question; most take milliseconds.
const TOLD: usize = 32;

/// A scene with stages, and the answers that come out of it under each belief, told when they are first asked for.
#[derive(Clone, Debug)]
pub struct Story {
    scene: Scene,
    /// The answers of a scene; none where it cannot be as told.
    tell: fn(&Scene) -> Vec<Answer>,
    /// What was told, by the question that was asked.
    believed: Arc<Mutex<BTreeMap<String, Arc<[Retold]>>>>,
}

/// The answers under one belief.
#[derive(Clone, Debug)]
struct Retold {
    belief: &'static Belief,
    slip: Slip,
    /// Values by the name of the answer.
    answers: Vec<(String, Expr)>,
}

impl Story {
    /// A story yet to be told.
    pub fn new(scene: Scene, tell: fn(&Scene) -> Vec<Answer>) -> Story {
        Story {
            scene,
            tell,
            believed: Arc::default(),
        }
    }

    /// Whether bodies move between its impacts.
    pub fn has_motions(&self) -> bool {
        let mut stages = self.scene.stages.iter();
        stages.any(|stage| !matches!(stage.kind, StageKind::Impact { .. }))
    }

    /// The scene with one question, and those whose answers it needs.
    fn only(&self, asked: &str) -> Scene {
        let mut scene = self.scene.clone();
        let mut wanted = vec![asked.to_string()];
        let mut at = 0;
        while let Some(name) = wanted.get(at).cloned() {
            at += 1;
            let of_it = self.scene.questions.iter().filter(|q| q.name == name);
            let formulas = of_it.flat_map(|q| q.ask.formulas());
            for used in formulas.flat_map(Expr::symbols) {
                let whole = used.trim_end_matches("_x").trim_end_matches("_y");
                if !wanted.iter().any(|known| known == whole) {
                    wanted.push(whole.to_string());
                }
            }
        }
        let stages = scene.stages.iter_mut().map(|s| &mut s.scene.questions);
        for questions in stages.chain([&mut scene.questions]) {
            questions.retain(|q| wanted.contains(&q.name));
        }
        scene.plots.clear();
        scene
    }

    fn believed(&self, asked: &str) -> Arc<[Retold]> {
        let mut known = self.believed.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(told) = known.get(asked) {
            return told.clone();
        }
        let slips = belief::in_stages(&self.only(asked)).into_iter().take(TOLD);
        let retold = slips.map(|(belief, slip)| {
            let told = || {
                let answers = (self.tell)(&slip.scene);
                if effort::spent() { Vec::new() } else { answers }
            };
            let answers = effort::within(MOST_STEPS, told).into_iter();
            let value = |a: Answer| match a.form {
                Form::Value { closed, .. } => Some((a.name, closed)),
                _ => None,
            };
            let answers = answers.filter_map(value).collect();
            Retold {
                belief,
                slip,
                answers,
            }
        });
        let told: Arc<[Retold]> = retold.collect();
        known.insert(asked.to_string(), told.clone());
        told
    }

    /// The beliefs that give exactly the written values of these answers, or, where a number is rounded, these numbers.
    /// Nothing where so many of them would do that it tells nothing.
    pub fn explain(
        &self,
        key: &Key,
        (asked, names): (&str, &[String]),
        written: &[Expr],
        rounding: Option<f64>,
    ) -> Vec<Diagnosis> {
        let domains = &key.question.domains;
        let of = |retold: &Retold| -> Option<Vec<Expr>> {
            let value = |name: &String| {
                let found = retold.answers.iter().find(|(known, _)| known == name);
                found.map(|(_, value)| value.clone())
            };
            names.iter().map(value).collect()
        };
        let near = |a: &Expr, b: &Expr, room: f64| -> Option<bool> {
            Some((self.number(a)? - self.number(b)?).abs() <= room)
        };
        let fits = |values: &[Expr]| {
            let mut pairs = values.iter().zip(written);
            values.len() == written.len()
                && pairs.all(|(value, mine)| match rounding {
                    Some(room) => near(value, mine, room) == Some(true),
                    None => identical(value, mine, domains),
                })
        };
        let mut found: Vec<Diagnosis> = Vec::new();
        let mut outcomes: Vec<Vec<Expr>> = Vec::new();
        for retold in self.believed(asked).iter() {
            let Some(values) = of(retold) else {
                continue;
            };
            let named = found.iter().any(|d| d.code == retold.belief.code);
            if !named && fits(&values) {
                found.push(words(retold.belief, &retold.slip, rounding.is_some()));
            }
            if !outcomes.contains(&values) {
                outcomes.push(values);
            }
        }
        let likely = || self.by_chance(key, written, &outcomes, rounding) <= COINCIDENCE;
        match found.len() {
            1..=NAMED if likely() => found,
            _ => Vec::new(),
        }
    }

    /// The value of a formula with the values that the scene gives.
    fn number(&self, e: &Expr) -> Option<f64> {
        e.substitute(&self.scene.values())
            .evaluate(&Point::default())
    }

    /// The chance that an answer of this kind meets one of the outcomes by coincidence.
    fn by_chance(
        &self,
        key: &Key,
        written: &[Expr],
        outcomes: &[Vec<Expr>],
        rounding: Option<f64>,
    ) -> f64 {
        let size = |e: &Expr| self.number(e).map(f64::abs);
        if let Some(room) = rounding {
            let mine = written.first().and_then(size).unwrap_or(0.0);
            let values = outcomes.iter().filter_map(|o| size(o.first()?));
            return in_decade(mine, values, room);
        }
        // A multiple of the right answer is met by others more easily than anything else.
        let options = Options::default();
        let ctx = Context::new(key, &options, false);
        let right = key.reading.content.expr();
        let multiple = |e: &Expr| right.is_some_and(|right| quotient(e, right, &ctx).is_some());
        if !written.first().is_some_and(multiple) {
            return 0.0;
        }
        let multiples = outcomes.iter().filter(|o| o.first().is_some_and(multiple));
        multiples.count() as f64 / FACTORS
    }
}
