//! Answers to earlier stages in the formulas of later ones: the height to which a ball rose is the height from which it falls.
//!
//! Names are read as symbols. Each of the two ways through a scene puts in what it has found for them; here only who may
//! use what is decided.

use std::collections::BTreeSet;

use super::super::file::SceneFile;
use super::super::record::entries;
use super::super::resolver::Resolver;
use super::super::stage_file::StageFile;
use super::super::{Ask, Question, Scene, questions};
use crate::dimension::{self, Dimension};
use crate::domain::{Domain, Domains};
use crate::expr::Symbol;

/// Names that answers may have in formulas, with their dimensions; a question that bears the name of a parameter gives none.
pub(super) fn names(file: &SceneFile) -> Vec<(String, Option<Dimension>)> {
    let parameters = entries(file.parameters.as_ref());
    let parameters: BTreeSet<&str> = parameters.map(|(name, _)| name.text.as_str()).collect();
    let asked = entries(file.questions.as_ref());
    let each = asked.flat_map(|(name, q)| {
        let axes: &[&str] = match q.along.is_none()
            && (q.velocity.is_some() || q.position.is_some() || q.impulse.is_some())
        {
            true => &["_x", "_y"],
            false => &[""],
        };
        let dimension = questions::dimension(q);
        axes.iter()
            .map(move |axis| (format!("{}{axis}", name.text), dimension.clone()))
    });
    each.filter(|(name, _)| !parameters.contains(name.as_str()))
        .collect()
}

/// Where answers live: times, distances and speeds are not negative, anything else may have either sign.
pub(super) fn live(file: &SceneFile, domains: &mut Domains) {
    for (name, q) in entries(file.questions.as_ref()) {
        let is_size = q.time.is_some() || q.speed.is_some() || q.energy.is_some();
        for axis in ["", "_x", "_y"] {
            let domain = match is_size {
                true => Domain::nonnegative(),
                false => Domain::real(),
            };
            let name = Symbol::from(format!("{}{axis}", name.text).as_str());
            domains.symbols.entry(name).or_insert(domain);
        }
    }
}

/// Notes which answers the formulas of each stage hold, and refuses those that are not known by then.
pub(super) fn take(
    base: &mut Resolver<'_>,
    scene: &mut Scene,
    stages: &[StageFile],
    names: &[(String, Option<Dimension>)],
) {
    for (i, file) in stages.iter().enumerate() {
        let mut used = BTreeSet::new();
        scene.stages[i].formulas_mut(&mut |e| used.extend(e.symbols()));
        let (earlier, other): (Vec<Symbol>, Vec<Symbol>) = used
            .into_iter()
            .filter(|s| names.iter().any(|(name, _)| **name == **s))
            .partition(|s| is_known(scene, s, i));
        for name in other {
            let message = format!("`{name}` is no answer to a stage before this one");
            let hint = "a stage may use what is asked of the motions and impacts before it, and a `value` made of that";
            let is_about_answers = scene.answering(&name).is_some_and(|q| {
                !q.ask.formulas().is_empty() && !matches!(q.ask, Ask::Value { .. })
            });
            let hint = match is_about_answers {
                true => format!(
                    "{hint}; of what is found from answers it takes the formula, as `derive` tells it without this stage"
                ),
                false => hint.to_string(),
            };
            base.report(file.name.span, message, hint);
        }
        // Answers that it does not use are nothing to it.
        let stage = &mut scene.stages[i];
        stage.scene.domains.symbols.retain(|name, _| {
            earlier.contains(name) || !names.iter().any(|(other, _)| **other == **name)
        });
        stage.earlier = earlier;
    }
}

/// Whether an answer is known when a stage begins: it is asked of one before it, or is a formula of such answers.
fn is_known(scene: &Scene, name: &Symbol, stage: usize) -> bool {
    if scene.parameter(name).is_some() {
        return true;
    }
    let Some(question) = scene.answering(name) else {
        return false;
    };
    match &question.ask {
        Ask::Value { formula, with, .. } => {
            let mut parts = formula.symbols().into_iter();
            with.is_empty() && parts.all(|s| &*s == "pi" || is_known(scene, &s, stage))
        }
        Ask::Balance { .. } | Ask::Matrix { .. } => false,
        ask => ask.is_motion() && question.stage.is_some_and(|j| j < stage),
    }
}

/// The name of an answer without the number of its case.
pub fn without_case(name: &str) -> &str {
    let numbered = name.rsplit_once("_case");
    let numbered = numbered.filter(|(_, k)| k.bytes().all(|c| c.is_ascii_digit()));
    numbered.map_or(name, |(plain, _)| plain)
}

impl Scene {
    /// The question whose answer, or a component of it, has this name.
    pub fn answering(&self, name: &str) -> Option<&Question> {
        let whole = ["_x", "_y"].iter().find_map(|axis| name.strip_suffix(axis));
        let named = |name: &str| self.questions.iter().find(|q| q.name == name);
        named(name).or_else(|| named(whole?))
    }

    /// The SI unit of what is asked for, as a person says it.
    pub fn unit_of(&self, ask: &Ask) -> String {
        ask.unit(&self.dimension_of(ask))
    }

    /// The dimension of what is asked for: of a formula that of the parameters and answers in it, where they have one.
    pub fn dimension_of(&self, ask: &Ask) -> Dimension {
        let formula = match ask {
            Ask::Value { formula, .. } => formula,
            Ask::Turn { of, .. } => &of[0],
            ask => return ask.dimension(),
        };
        let of_name = |name: &str| match self.parameter(name) {
            Some(given) => Some(given.dimension.clone()),
            None => Some(self.dimension_of(&self.answering(name)?.ask)),
        };
        let found = dimension::of(formula, &of_name);
        found.ok().flatten().unwrap_or_else(Dimension::none)
    }
}
