//! The ways a scene can go as a whole: one outcome chosen of every impact that has several.
//!
//! In: the stages as told. Out: what the answers stand for in each, so that a formula of answers is answered for each, with
//! the conditions under which it holds.

use std::collections::BTreeMap;

use super::StageTold;
use crate::answer::calc::{beyond_zero, sign};
use crate::answer::{Answer, Known, Refused};
use crate::domain::{Origin, Relation};
use crate::expr::{Expr, Symbol};
use crate::formula::{Sentence, sentence};
use crate::scene::{Question, Scene, without_case};

/// What must be ≥ 0, in words and as expressions.
type Given = Vec<(String, Expr)>;

/// One way a scene can go.
#[derive(Clone, Default)]
pub(super) struct World {
    /// The outcome of each stage told that happens here.
    pub outcome: BTreeMap<usize, usize>,
    /// What must be ≥ 0 for it, in words and as expressions.
    pub given: Given,
    /// What answers stand for.
    pub known: Known,
}

impl World {
    /// The scene on the part of the domain where it goes this way.
    pub fn part_of(&self, scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        for (why, e) in &self.given {
            let words = Sentence::not_negative(e).to_string();
            let relation = Relation::needed(e, true, words, Origin::Outcome(why.clone()));
            scene.domains = scene.domains.with_relation(relation);
        }
        scene
    }
}

/// All ways.
pub(super) fn of(stages: &[StageTold]) -> Vec<World> {
    let mut worlds = vec![World::default()];
    for (i, told) in stages.iter().enumerate() {
        let mut next = Vec::new();
        for mut world in worlds {
            let leads = |(parent, case)| world.outcome.get(&parent) == Some(&case);
            if !told.branch.is_none_or(leads) {
                next.push(world);
            } else if told.cases.len() < 2 {
                world.outcome.insert(i, 0);
                next.push(world);
            } else {
                for (k, case) in told.cases.iter().enumerate() {
                    let mut one = world.clone();
                    one.outcome.insert(i, k);
                    // What an impact before needs is not said again.
                    let known = |e: &Expr| told.given.iter().any(|(_, given)| given == e);
                    let given = case.conditions.iter().filter(|(_, e)| !known(e));
                    one.given.extend(given.cloned());
                    next.push(one);
                }
            }
        }
        worlds = next;
    }
    worlds
}

/// Answers in every way; where they differ each is told with what it needs, and remembered where it holds.
pub(super) fn each(
    scene: &Scene,
    question: &Question,
    worlds: &mut [World],
    answer: impl Fn(&World) -> Result<Vec<Answer>, Refused>,
) -> Result<Vec<Answer>, Refused> {
    let mut found: Vec<(Vec<Answer>, Vec<usize>)> = Vec::new();
    let put_in = put_in(scene, question, worlds);
    for (w, world) in worlds.iter_mut().enumerate() {
        if !put_in.contains_key(&w) {
            continue;
        }
        let answers = answer(world)?;
        // The name of a parameter stands for the parameter.
        let is_given = |a: &&Answer| scene.parameter(&a.name).is_some();
        for a in answers.iter().filter(|a| !is_given(a)) {
            let name = Symbol::from(a.name.as_str());
            match a.formula() {
                Some(formula) => world.known.insert(name, formula.clone()),
                None => world.known.remove(&name),
            };
        }
        let one = |a: &Answer| {
            let under = a.assumptions.clone();
            (a.form.clone(), a.range.clone(), a.text.clone(), under)
        };
        let says = |all: &[Answer]| all.iter().map(one).collect::<Vec<_>>();
        match found.iter_mut().find(|(f, ..)| says(f) == says(&answers)) {
            Some((_, holds)) => holds.push(w),
            None => found.push((answers, vec![w])),
        }
    }
    let several = found.len() > 1;
    let each = found.into_iter().flat_map(|(answers, holds)| {
        let told = alike(&put_in, holds).into_iter();
        told.map(move |(given, holds)| (answers.clone(), given, holds))
    });
    let mut out = Vec::new();
    for (k, (mut answers, given, holds)) in each.enumerate() {
        for a in answers.iter_mut().filter(|_| several) {
            if k > 0 {
                number_case(a, k + 1);
            }
            let given = (given.iter())
                .map(|(why, e)| sentence!("{} ({})", beyond_zero(e, &scene.domains, false), why));
            a.assumptions.extend(given);
            a.worlds = holds.clone();
        }
        out.extend(answers);
    }
    Ok(out)
}

/// The ways that are left where a question puts in values for parameters, by index, with what must then hold.
fn put_in(scene: &Scene, question: &Question, worlds: &[World]) -> BTreeMap<usize, World> {
    let with: Known = question.ask.with().iter().cloned().collect();
    let mut out = BTreeMap::new();
    for (w, world) in worlds.iter().enumerate() {
        let mut world = world.clone();
        if !with.is_empty() {
            for (_, e) in &mut world.given {
                *e = e.substitute(&with).substitute(&world.known);
            }
            let seen = |e: &Expr| sign(e, &scene.domains);
            if world.given.iter().any(|(_, e)| seen(e).is_negative()) {
                continue;
            }
            let is_sure = |e: &Expr| seen(e).is_not_negative();
            world.given.retain(|(_, e)| !is_sure(e));
        }
        out.insert(w, world);
    }
    out
}

/// Ways put together as far as one set of conditions tells them from all others, each with these conditions.
fn alike(worlds: &BTreeMap<usize, World>, ways: Vec<usize>) -> Vec<(Given, Vec<usize>)> {
    let first = &worlds[&ways[0]];
    let needed = |world: &World, given: &Given| given.iter().all(|g| world.given.contains(g));
    let mut given = first.given.clone();
    given.retain(|g| ways.iter().all(|w| worlds[w].given.contains(g)));
    let met = worlds.iter().filter(|(_, world)| needed(world, &given));
    let mut met = met.map(|(w, _)| w);
    if ways.len() == 1 || met.all(|w| ways.contains(w)) {
        return vec![(given, ways)];
    }
    let differs = |stage: &&usize| {
        let outcome = first.outcome.get(stage);
        ways.iter().any(|w| worlds[w].outcome.get(stage) != outcome)
    };
    let split = first.outcome.keys().find(differs);
    let (here, there): (Vec<usize>, Vec<usize>) = ways.iter().partition(|w| {
        split.map_or(**w == ways[0], |stage| {
            worlds[*w].outcome.get(stage) == first.outcome.get(stage)
        })
    });
    let parts = [here, there].into_iter();
    parts.flat_map(|ways| alike(worlds, ways)).collect()
}

/// Later formulas may use the other answers by the name of their question, each where it holds, and by their own.
pub(super) fn remember(worlds: &mut [World], answers: &[Answer]) {
    for a in answers {
        let Some(formula) = a.formula() else { continue };
        let plain = without_case(&a.name);
        for world in worlds.iter_mut() {
            if happens(world, a, answers) {
                let name = Symbol::from(plain);
                world.known.insert(name, formula.clone());
            }
            if plain != a.name {
                let name = Symbol::from(a.name.as_str());
                world.known.insert(name, formula.clone());
            }
        }
    }
}

/// Whether an answer about a stage, one of several to a question, is the one of this way.
fn happens(world: &World, a: &Answer, answers: &[Answer]) -> bool {
    // Where bodies are at an impact is told once for all its outcomes.
    let splits = |stage: usize, case: usize| {
        let mut told = answers.iter().filter_map(|b| b.told);
        case > 0 || told.any(|(s, c)| s == stage && c != case)
    };
    a.told.is_none_or(|(stage, case)| {
        let outcome = world.outcome.get(&stage);
        outcome.is_some_and(|k| *k == case || !splits(stage, case))
    })
}

/// The answers as they are in one of the ways, by its index, under the names of their questions.
pub(super) fn answers(worlds: &[World], way: usize, all: &[Answer]) -> Vec<Answer> {
    let mut out: Vec<Answer> = Vec::new();
    for mine in all.chunk_by(|a, b| a.question == b.question) {
        let here = |a: &&Answer| {
            let is_so = a.worlds.is_empty() || a.worlds.contains(&way);
            is_so && happens(&worlds[way], a, mine)
        };
        for a in mine.iter().filter(here) {
            let is_question = a.name == a.question;
            let name = if is_question {
                &a.name
            } else {
                without_case(&a.name)
            };
            out.push(Answer {
                name: name.into(),
                ..a.clone()
            });
        }
    }
    out
}

/// The same of an answer that all ways share.
pub(super) fn everywhere(worlds: &mut [World], answer: &Answer) {
    let Some(formula) = answer.formula() else {
        return;
    };
    for world in worlds {
        let name = Symbol::from(answer.name.as_str());
        world.known.insert(name, formula.clone());
    }
}

/// Names an answer after its case.
pub(in crate::story) fn number_case(answer: &mut Answer, number: usize) {
    answer.name = format!("{}_case{number}", answer.name);
    answer.latex = numbered(&answer.latex, number);
}

/// The LaTeX of a symbol with a number at the end of its index.
fn numbered(latex: &str, number: usize) -> String {
    match latex.strip_suffix('}').filter(|l| l.contains("_{")) {
        Some(open) => format!("{open},{number}}}"),
        None if latex.contains('_') => format!("{{{latex}}}_{number}"),
        None => format!("{latex}_{number}"),
    }
}
