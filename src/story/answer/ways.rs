//! The answers to one question for each way a stage may come about, and for each outcome of an impact.

use super::super::worlds::number_case;
use super::super::{Case, StageTold, State, words};
use super::motion;
use crate::answer::{self, Answer, Check, Form, Refused};
use crate::dimension::Dimension;
use crate::expr::Expr;
use crate::formula::{Sentence, sentence};
use crate::scene::{Ask, Question, Scene, Stage};
use crate::verify::APPROACH;
use crate::verify::possible::Condition;

/// One of the ways a stage may come about, where there are several.
pub(super) struct Way {
    /// Its number, from 0, where there are several.
    number: Option<usize>,
    /// What leads to it, in words.
    words: String,
    /// What must be ≥ 0 for it.
    given: Vec<Sentence>,
}

impl Way {
    /// Names the answer after the way.
    fn put(&self, answer: &mut Answer) {
        answer.assumptions.splice(0..0, self.given.iter().cloned());
        if let Some(i) = self.number {
            if i > 0 {
                number_case(answer, i + 1);
            }
            if !self.words.is_empty() {
                answer.words = format!("{}, {}", answer.words, self.words);
            }
        }
    }
}

/// All ways a stage has been told.
pub(super) fn ways<'a>(stages: &'a [StageTold], stage: &Stage) -> Vec<(usize, &'a StageTold, Way)> {
    let mine = stages.iter().enumerate();
    let mine: Vec<_> = mine.filter(|(_, t)| t.placed.name == stage.name).collect();
    let several = mine.len() > 1;
    let each = mine.into_iter().enumerate();
    each.map(|(i, (index, told))| {
        let way = Way {
            number: several.then_some(i),
            words: (told.branch).map_or(String::new(), |(at, k)| words::leading(stages, at, k)),
            given: told.given.iter().map(supposed).collect(),
        };
        (index, told, way)
    })
    .collect()
}

/// The answers to a question about a stage, one for each way it may come about.
pub(super) fn each_way(
    stages: &[StageTold],
    stage: Option<&Stage>,
    answer: impl Fn(&StageTold) -> Result<Answer, Refused>,
) -> Result<Vec<Answer>, Refused> {
    let ways = stage.map_or_else(Vec::new, |stage| ways(stages, stage));
    let each = ways.into_iter().map(|(i, told, way)| {
        let mut one = answer(told)?;
        one.told = Some((i, 0));
        way.put(&mut one);
        Ok(one)
    });
    each.collect()
}

/// The answers to a question about the motion at one end of a stage, one for each way it may come about and, at the end of
/// an impact, each outcome.
pub(super) fn each_outcome(
    stages: &[StageTold],
    stage: Option<&Stage>,
    at_end: bool,
    answer: impl Fn(&StageTold, &State) -> Result<Answer, Refused>,
) -> Result<Vec<Answer>, Refused> {
    if !at_end {
        return each_way(stages, stage, |told| answer(told, &told.before));
    }
    let ways = stage.map_or_else(Vec::new, |stage| ways(stages, stage));
    let cases: usize = ways.iter().map(|(_, t, _)| t.cases.len().max(1)).sum();
    let mut out = Vec::new();
    for (i, told, mut way) in ways {
        let outcomes = told.cases.iter().map(Some);
        let motion = told.cases.is_empty().then_some(None);
        for (k, case) in outcomes.chain(motion).enumerate() {
            let mut one = answer(told, case.map_or(&told.after, |case| &case.after))?;
            if let Some(case) = case {
                one.assumptions = rests_on(case);
                if cases > 1 {
                    one.words = format!("{}, {}", one.words, words::active(case));
                }
            }
            way.number = (cases > 1).then_some(out.len());
            way.put(&mut one);
            one.told = Some((i, k));
            out.push(one);
        }
    }
    Ok(out)
}

/// What an outcome of an impact rests on, and what must hold for it.
pub(super) fn rests_on(case: &Case) -> Vec<Sentence> {
    let mut conditions = case.conditions.iter();
    // When they approach is told with the contact.
    let is_told = conditions.any(|(words, _)| words.starts_with("the bodies approach at"));
    let told = |words: &Sentence| is_told && words.to_string() == APPROACH;
    case.assumptions()
        .filter(|words| !told(words))
        .chain(happens_where(case))
        .collect()
}

/// What must hold for an outcome of an impact.
pub(super) fn happens_where(case: &Case) -> impl Iterator<Item = Sentence> {
    let places = case.places.iter().filter_map(Condition::told);
    case.conditions.iter().map(supposed).chain(places)
}

/// What must be ≥ 0, with the words for it.
pub(super) fn supposed((why, e): &(String, Expr)) -> Sentence {
    sentence!("{} ({})", Sentence::not_negative(e), why)
}

/// Velocities, spins, impulses and energies at the end of a stage.
pub(super) fn quantity(
    scene: &Scene,
    stages: &[StageTold],
    question: &Question,
    stage: &Stage,
) -> Result<Vec<Answer>, Refused> {
    let ways = ways(stages, stage);
    if let Ask::Friction { .. } = question.ask {
        return Ok(threshold(question, ways));
    }
    let cases: usize = ways.iter().map(|(_, t, _)| t.cases.len().max(1)).sum();
    let mut number = 0;
    let mut out = Vec::new();
    for (i, told, way) in ways {
        let name = (scene.stages.len() > 1).then_some(told.placed.name.as_str());
        let mut own: Vec<(usize, Answer)> = Vec::new();
        if told.cases.is_empty() {
            let at_end = motion::at_end(scene, question, told)?;
            own.extend(at_end.into_iter().map(|a| (0, a)));
        }
        for k in 0..told.cases.len() {
            let answers = of_case(question, (name, &told.cases), k, cases > 1);
            own.extend(answers.into_iter().map(|a| (k, a)));
        }
        for (k, mut answer) in own {
            let state = told.cases.get(k).map_or(&told.after, |case| &case.after);
            if let Some(why) = state.why_open(answer.form.formulas()) {
                answer = answer.leave_open(why);
            }
            if matches!(answer.form, Form::Open(_) | Form::Words) {
                answer.checks.clear();
            }
            let way = Way {
                number: (cases > 1).then_some(number + k),
                words: way.words.clone(),
                given: way.given.clone(),
            };
            way.put(&mut answer);
            answer.told = Some((i, k));
            out.push(answer);
        }
        number += told.cases.len().max(1);
    }
    Ok(out)
}

/// A threshold of friction, which is the same whatever the contact does; one for each way the impact comes about, and each set
/// of supports with another one.
fn threshold(question: &Question, ways: Vec<(usize, &StageTold, Way)>) -> Vec<Answer> {
    let mut out: Vec<Answer> = Vec::new();
    for (i, told, way) in ways {
        for (k, case) in told.cases.iter().enumerate() {
            let Some(asked) = case.scene.question(&question.name) else {
                continue;
            };
            let Ask::Value {
                formula, meaning, ..
            } = &asked.ask
            else {
                out.push(answer::no_coefficient(question));
                return out;
            };
            let mut answer = Answer::blank(question, &question.name, meaning.as_str());
            answer.form = Form::value(case.put_in(formula));
            if out.iter().any(|a| a.form == answer.form) {
                continue;
            }
            answer
                .assumptions
                .extend(case.places.iter().filter_map(Condition::told));
            way.put(&mut answer);
            if !out.is_empty() {
                number_case(&mut answer, out.len() + 1);
            }
            answer.told = Some((i, k));
            out.push(answer);
        }
    }
    out
}

/// What is asked of an impact, told of the one of this name.
fn in_impact(words: &str, name: &str) -> String {
    for when in ["just after", "just before"] {
        if let Some((what, rest)) = words.split_once(when) {
            return format!("{what}{when} `{name}`{rest}");
        }
    }
    let (what, along) = words.split_at(words.find(", along ").unwrap_or(words.len()));
    format!("{what} in `{name}`{along}")
}

/// The answers of outcome `k` of an impact, which has a name where there are others.
fn of_case(
    question: &Question,
    (name, cases): (Option<&str>, &[Case]),
    k: usize,
    several: bool,
) -> Vec<Answer> {
    let case = &cases[k];
    let asked = |case: &Case| {
        let all = case.derivation.answers.iter().zip(&case.proof.answers);
        let mine = all.filter(|(a, _)| a.question == question.name);
        mine.map(|(a, checks)| (a.clone(), checks.clone()))
            .collect::<Vec<_>>()
    };
    let mut mine = asked(case);
    // What does not act here has the components that it has where it acts.
    let acts = !mine.is_empty();
    if !acts {
        let mut others = cases.iter().map(asked);
        mine = others.find(|all| !all.is_empty()).unwrap_or_else(|| {
            let mut nowhere = Answer::blank(question, &question.name, "impulse");
            nowhere.dimension = Dimension::new(1, 1, -1);
            vec![(nowhere, Vec::new())]
        });
    }
    let mut out = Vec::new();
    for (answer, checks) in mine {
        let said = name.map_or_else(
            || answer.words.clone(),
            |name| in_impact(&answer.words, name),
        );
        let words = match several {
            true => format!("{said}, {}", words::active(case)),
            false => said,
        };
        if !acts {
            let mut a = Answer::blank(question, &answer.name, words);
            a.form = Form::value(Expr::zero());
            let why = words::active(case);
            a.text
                .push(sentence!("nothing is transmitted there: {}", why));
            a.assumptions.extend(happens_where(case));
            (a.latex, a.dimension) = (answer.latex, answer.dimension);
            a.checks = case.identities().cloned().collect();
            out.push(a);
            continue;
        }
        let mut a = Answer {
            words,
            form: case.form(&answer.form),
            ..answer
        };
        a.text.extend(a.left_open().map(Sentence::words));
        a.assumptions.extend(rests_on(case));
        // Of what is left open nothing was checked.
        let is_given = !matches!(a.form, Form::Open(_));
        let identities = case.identities().filter(|_| is_given);
        let identities = identities.map(|check| for_any(case, check));
        a.checks = identities.chain(checks).collect();
        out.push(a);
    }
    out
}

/// What holds for any motion handed on, and so for the one that is.
fn for_any(case: &Case, check: &Check) -> Check {
    let mut check = check.clone();
    if !case.handed.is_empty() {
        check.words += ", whatever motion is handed on";
    }
    check
}
