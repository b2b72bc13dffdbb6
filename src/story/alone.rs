//! A scene of one impact, told as its only stage: derived as it stands, with nothing handed on and nothing that follows.
//!
//! In: a scene without stages, its friction decided. Out: [`Told`] with one stage that has no name, and the answers.

use std::collections::BTreeMap;

use super::answer::Led;
use super::worlds::World;
use super::{Case, StageTold, State, Told, second};
use crate::answer::{self, Answer, Refused};
use crate::derive;
use crate::formula::Sentence;
use crate::scene::{Scene, Stage};
use crate::verify::possible::{self, Rule};
use crate::verify::{self, APPROACH};

/// What to do where the laws of several contacts cannot hold together.
const SEVERAL: &str = "with values, `carom compare` tells what Moreau's law, Poisson's and one impact after the other give";

/// Tells the one impact of a scene.
pub(super) fn tell(scene: &Scene) -> Result<Told, Refused> {
    let derivation = derive::derive(scene).map_err(|stop| Refused::stop("", stop))?;
    let mut proof = verify::prove(scene, &derivation);
    let possible = possible::judge(scene, &derivation, &[]);
    let mut known = super::answer::as_decided(scene);
    for open in possible.open() {
        if open.is_equation {
            proof.assumptions.extend(open.told());
            continue;
        }
        let need = super::answer::of_condition(open).filter(|_| open.divides(&known));
        let Some(need) = need else { continue };
        if open.rule == Rule::Approach {
            // It says more.
            proof
                .assumptions
                .retain(|words| words.to_string() != APPROACH);
        }
        known = known.with_relation(need.relation);
        proof.assumptions.push(need.told);
    }
    let counting = &derivation.counting;
    let contradiction = counting.contradictory.then(|| Refused {
        contradicts: true,
        ..Refused::new(
            "",
            format!(
                "these laws contradict each other: {}",
                counting.conflict.join("; ")
            ),
            match scene.contacts.len() {
                0 | 1 => "",
                _ => SEVERAL,
            },
        )
    });
    let stage = Stage::alone(scene.clone());
    let before = super::start(scene, &[]);
    let after = unasked(scene, &before);
    let case = Case {
        active: Vec::new(),
        idle: Vec::new(),
        redundant: false,
        when: Vec::new(),
        rubs: String::new(),
        conditions: Vec::new(),
        places: Vec::new(),
        handed: BTreeMap::new(),
        after: after.clone(),
        scene: scene.clone(),
        derivation,
        proof,
        possible,
    };
    let about = match case.derivation.counting.contradictory {
        true => {
            let why = Sentence::words("the laws contradict each other");
            let asked = scene.asked_of_answers();
            asked.map(|q| super::answer::unanswered(q, &why)).collect()
        }
        false => about_answers(scene, &case)?,
    };
    let mut answers = answers(&case);
    let assumptions = case.assumptions().collect();
    let checks = case.proof.scene.clone();
    let first = answers.len();
    answers.extend(about);
    let mut told = Told {
        stages: vec![StageTold {
            cases: vec![case],
            assumptions,
            checks,
            ..StageTold::new(&stage, before, after)
        }],
        answers,
        ended: contradiction.into_iter().collect(),
        ..Told::default()
    };
    if told.answers.len() > first {
        for (i, check) in second::held(scene, &told) {
            // Those of the impact itself are held against exact solutions.
            if i >= first {
                told.answers[i].checks.push(check);
            }
        }
    }
    Ok(told)
}

/// What is asked about the answers, where the bodies collide.
fn about_answers(scene: &Scene, case: &Case) -> Result<Vec<Answer>, Refused> {
    let mut known = case.derivation.known();
    let mut out: Vec<Answer> = Vec::new();
    for question in scene.asked_of_answers() {
        let before = case.derivation.answers.iter().chain(&out);
        let before: Vec<Answer> = before.cloned().collect();
        if let Some(why) = super::answer::needs_open(&question.ask, &known, &before) {
            out.push(super::answer::unanswered(question, &why));
            continue;
        }
        let mut needs = super::answer::of_impact(scene, case, question);
        let world = World {
            known: known.clone(),
            ..World::default()
        };
        needs.extend(super::answer::needs(
            Led::by((scene, &[]), &world, &out),
            question,
        ));
        let part = super::answer::part(scene, &needs);
        let mut answers = answer::formulas(&part, question, &known)?.unwrap_or_default();
        answer::remember(scene, &answers, &mut known);
        for answer in &mut answers {
            // What friction needs to do something else, and a formula of parameters, rest on no outcome.
            if super::answer::is_of_outcomes(&scene.questions, question) {
                let is_told = |words: &Sentence| needs.iter().any(|need| need.says(words));
                let given = case.assumptions().filter(|words| !is_told(words));
                answer.assumptions.extend(given);
            }
            super::answer::tell(scene, &question.ask, &needs, answer);
        }
        let picked = super::answer::picked(scene);
        super::answer::leave_to_cases(scene, question, picked, &mut answers);
        out.extend(answers);
    }
    Ok(out)
}

/// The answers of the impact as they were derived.
fn answers(case: &Case) -> Vec<Answer> {
    let each = case.derivation.answers.iter().zip(&case.proof.answers);
    let answer = |(answer, checks): (&Answer, &Vec<_>)| Answer {
        told: Some((0, 0)),
        assumptions: case.assumptions().collect(),
        checks: case.identities().chain(checks).cloned().collect(),
        ..answer.clone()
    };
    each.map(answer).collect()
}

/// The motion after an impact that nothing follows: worked out where it is asked for, and left open here.
fn unasked(scene: &Scene, before: &State) -> State {
    let mut after = before.clone();
    for b in scene.moving() {
        after.lose(scene, b, "nothing follows this impact", true);
    }
    after
}
