//! What a solution says of an answer beside its formula: its number, and how it is known.

use super::words;
use super::{Claim, Detail, Meaning, Solution};
use crate::answer::{Answer, Check, NOT_FOUND};
use crate::expr::{Expr, Node, Symbol};
use crate::formula::Sentence;
use crate::scene::{Scene, without_case};

/// ` = 1.2 m/s`, where the scene gives every value.
pub(super) fn number(scene: &Scene, answer: &Answer) -> Option<String> {
    let formula = answer
        .formula()
        .filter(|_| answer.broken(scene).is_none())?;
    // What is plain already needs a number only for its unit, and an arc one in degrees.
    let is_plain = formula.symbols().iter().all(|s| s.as_ref() == "pi");
    let is_turn = formula
        .parts()
        .all(|part| !matches!(part.node(), Node::Call(..)));
    let is_bare = answer.dimension.is_none() && (is_turn || !formula.is_arc());
    if is_plain && (formula.is_zero() || is_bare) {
        return None;
    }
    let value = formula
        .substitute(&scene.values())
        .evaluate(&crate::expr::Point::<f64>::default())?;
    Some(format!(
        " = {}",
        answer.measured(scene, value, words::digits)
    ))
}

/// What is told of checks: that one holds is told once, at the end of a solution, and by itself only at full length.
pub(super) fn worth_telling(checks: &[Check], detail: Detail) -> Option<String> {
    let full = detail == Detail::Full;
    let all = checks.iter().filter(|c| full || c.holds != Some(true));
    // That it was not found stands with the answer.
    let all = all.filter(|c| c.words != NOT_FOUND);
    known(&all.cloned().collect::<Vec<_>>())
}

/// How an answer is known: what was checked, what failed, what stayed open.
pub fn known(checks: &[Check]) -> Option<String> {
    let list = |holds: Option<bool>| {
        let mut all: Vec<&str> = checks
            .iter()
            .filter(|c| c.holds == holds)
            .map(|c| c.words.as_str())
            .collect();
        all.dedup();
        all.join("; ")
    };
    let mut out = Vec::new();
    for (holds, lead) in [
        (Some(true), "Checked"),
        (None, "Not proved"),
        (Some(false), "A check failed, do not use this"),
    ] {
        let words = list(holds);
        if !words.is_empty() {
            out.push(format!("{lead}: {words}."));
        }
    }
    (!out.is_empty()).then(|| out.join(" "))
}

/// Whether the name of an answer is new; its symbol is noted then.
pub(super) fn is_fresh(solution: &mut Solution, answer: &Answer) -> bool {
    let name = Symbol::from(answer.name.as_str());
    let fresh = !solution.meanings.contains_key(&name);
    if fresh && words::is_safe_latex(&answer.latex) {
        solution.names.insert(name, answer.latex.clone());
    }
    fresh
}

/// Records the step that names an answer, and gives its id.
pub(super) fn defined(
    solution: &mut Solution,
    answer: &Answer,
    formula: &Expr,
    fresh: bool,
) -> String {
    let name = Symbol::from(answer.name.as_str());
    let claim = Claim::new(Expr::symbol(&answer.name), formula.clone());
    let id = solution.step(Vec::new(), vec![claim], &answer.words);
    if fresh {
        solution.meanings.insert(name.clone(), Meaning::Defined);
    }
    if let Some(step) = solution.steps.last_mut() {
        step.defines = fresh.then_some(name);
        step.near = answer.near.clone();
        let is_of_a_case = without_case(&answer.name) != answer.name;
        let given = answer.assumptions.iter();
        let given =
            given.filter(|a| is_of_a_case || !solution.assumptions.contains(&a.to_string()));
        let given = given.flat_map(Sentence::conditions);
        step.needs = given.map(|(e, _)| e).collect();
    }
    id
}
