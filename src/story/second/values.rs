//! Values of formulas of answers where a scene is followed, and near that point.

use super::{Second, Seen, World};
use crate::answer::Answer;
use crate::expr::{Expr, Point, Symbol};
use crate::numeric::Answer as Found;
use crate::numeric::follow::{self, Breach, Followed, What};
use crate::numeric::points::keeps;
use crate::scene::{Ask, Question, Scene};
use crate::story::StageTold;

/// The answers of a scene, and the scene followed.
pub(super) struct Asked<'a> {
    pub scene: &'a Scene,
    pub second: &'a Second<'a>,
    pub worlds: &'a [World],
    pub stages: &'a [StageTold],
    pub answers: &'a [Answer],
}

/// What rounding may make of a value that is put in, as a part of it.
const ROUNDED: f64 = 1e-12;

impl Asked<'_> {
    /// The value of a formula of answers in the scene followed at a point, with some parameters at other values and others
    /// replaced.
    pub fn formula(
        &self,
        seen: &Seen,
        formula: &Expr,
        with: &[(Symbol, Expr)],
        values: &[(Symbol, f64)],
    ) -> Option<f64> {
        if with.is_empty() && values.is_empty() {
            return formula.evaluate(&self.known(&seen.point, &seen.followed, formula, 0.0)?);
        }
        let mut there = moved(&seen.point, values);
        // The other component of a unit vector goes along, on its side.
        for (name, value) in values {
            let other = self.scene.domains.other_component(name);
            if let Some(other) = other.and_then(|other| there.values.get_mut(other)) {
                *other = (1.0 - value * value).sqrt().copysign(*other);
            }
        }
        self.formula_at(&there, formula, with, 0.0)
    }

    /// By how much the value of a question about a formula changes with the rounding of what is put in for parameters, there and in
    /// the answers that it uses: much where a motion just comes to its end.
    pub fn shaken_by_what_is_put_in(&self, seen: &Seen, question: &Question, part: &Expr) -> f64 {
        let with = question.ask.with();
        let at = |nudge: f64| self.formula_at(&seen.point, part, with, nudge);
        let Some(here) = at(0.0) else {
            return 0.0;
        };
        let moves = [-ROUNDED, ROUNDED].into_iter().filter_map(at);
        moves.fold(0.0, |most, there| most.max((there - here).abs()))
    }

    /// The same with the values put in changed by so much of themselves.
    fn formula_at(
        &self,
        point: &Point<f64>,
        formula: &Expr,
        with: &[(Symbol, Expr)],
        nudge: f64,
    ) -> Option<f64> {
        let mut replaced = point.clone();
        for (name, value) in with {
            let value = match self.needs(value).is_empty() {
                true => value.evaluate(point)?,
                false => self.formula_at(point, value, &[], nudge)?,
            };
            replaced.values.insert(name.clone(), value * (1.0 + nudge));
        }
        let followed = follow::follow(self.scene, &replaced).ok()?;
        if !self.goes_as_supposed(&followed) {
            return None;
        }
        formula.evaluate(&self.known(&replaced, &followed, formula, nudge)?)
    }

    /// Whether every contact with friction does what the scene supposes of it.
    fn goes_as_supposed(&self, followed: &Followed) -> bool {
        let mut stages = self.scene.stages.iter().zip(&followed.stages);
        stages.all(|(stage, found)| {
            let supposed = stage.scene.friction().and_then(|(_, law)| law.supposing);
            let mode = match found.as_ref().map(|found| &found.what) {
                Ok(What::Impact(impact)) => impact.mode,
                _ => None,
            };
            match (supposed, mode) {
                (Some(supposed), Some(mode)) => mode.is(supposed),
                _ => true,
            }
        })
    }

    /// The point with values for the answers that a formula needs, as they are followed there; `None` where one of them is not a
    /// number of the motion, nor a formula of such, or where bodies that are to collide part before.
    fn known(
        &self,
        point: &Point<f64>,
        followed: &Followed,
        of: &Expr,
        nudge: f64,
    ) -> Option<Point<f64>> {
        let mut out = point.clone();
        let parts = |breach: &Breach| matches!(breach, Breach::Separates(_));
        let parts = followed.stages.iter().flatten().any(|s| match &s.what {
            What::Impact(impact) => impact.breaches.iter().any(parts),
            What::Motion(_) => false,
        });
        if parts {
            return None;
        }
        for question in self.needs(of) {
            let name = question.name.as_str();
            let found = match &question.ask {
                Ask::Value { with, .. } if with.is_empty() => {
                    question.ask.value(&out).map(Found::Scalar)
                }
                Ask::Value { formula, with, .. } => self
                    .formula_at(point, formula, with, nudge)
                    .map(Found::Scalar),
                // Where sides meet and what is largest or least are held against it by themselves.
                Ask::Condition { .. } | Ask::Extremum { .. } | Ask::Friction { .. } => {
                    let mut told = self.answers.iter().filter(|a| a.name == name);
                    let told = told.next().filter(|a| a.worlds.is_empty());
                    let value = told.and_then(|a| a.formula()?.evaluate(point));
                    value.map(Found::Scalar)
                }
                _ => follow::answer(self.scene, followed, question, point).ok(),
            };
            match found {
                Some(found) => {
                    let parts = found.components().into_iter();
                    out.values
                        .extend(parts.map(|(part, v)| (format!("{name}{part}").into(), v)));
                }
                None => return None,
            }
        }
        Some(out)
    }

    /// The questions whose answers a formula uses, and those that values of formulas among them use, in the order of the file.
    pub fn needs(&self, of: &Expr) -> Vec<&Question> {
        let mut names = of.symbols();
        let is_given = |name: &str| self.scene.parameter(name).is_some();
        let mut out: Vec<&Question> = Vec::new();
        for question in self.scene.questions.iter().rev() {
            let uses = |name: &Symbol| question.part(name).is_some() && !is_given(name);
            if names.iter().any(uses) {
                out.push(question);
                if let Ask::Value { formula, with, .. } = &question.ask {
                    let put_in = with.iter().map(|(_, value)| value);
                    names.extend(put_in.chain([formula]).flat_map(Expr::symbols));
                }
            }
        }
        out.reverse();
        out
    }

    /// What is an ordinary change of a parameter near a value.
    pub fn scale(&self, seen: &Seen, parameter: &Symbol, near: f64) -> f64 {
        let ordinary = || seen.point.values.get(parameter).map_or(1.0, |v| v.abs());
        match near == 0.0 {
            true => ordinary(),
            false => near.abs(),
        }
    }

    /// Whether a parameter may have a value, the others as they are.
    pub fn admits(&self, seen: &Seen, parameter: &Symbol, value: f64) -> bool {
        let domains = &self.scene.domains;
        let domain = domains.symbols.get(parameter);
        domain.is_none_or(|domain| domain.admits(value))
            && keeps(domains, &moved(&seen.point, &[(parameter.clone(), value)]))
    }
}

/// A point with other values of some parameters.
pub(super) fn moved(point: &Point<f64>, values: &[(Symbol, f64)]) -> Point<f64> {
    let mut point = point.clone();
    point.values.extend(values.iter().cloned());
    point
}
