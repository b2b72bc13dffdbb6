//! The questions of a story, answered in their order; formulas may use the answers before them.
//!
//! What is asked of an impact comes from its derivation; what is asked of a motion is in [`motion`].

mod motion;
mod reached;
mod turns;

pub(super) use motion::{angular, bearing};
pub(super) use reached::{
    as_decided, is_of_outcomes, leave_to_cases, needs, of_condition, of_impact, part, picked, tell,
};

use std::collections::BTreeSet;
use std::iter::successors;

use super::worlds::World;
use super::{Case, StageTold, State, Told, granted, line, second, spring, words, worlds};
use crate::answer::{self, Answer, Check, Form, Known, Refused};
use crate::dimension::Dimension;
use crate::expr::{Expr, Symbol};
use crate::formula::{Piece, Sentence, sentence};
use crate::scene::{Ask, Question, Scene, Stage, StageKind};
use crate::verify::APPROACH;
use crate::verify::possible::Condition;

/// Answers all questions.
pub(super) fn all(scene: &Scene, mut stages: Vec<StageTold>) -> Result<Told, Refused> {
    for told in &mut stages {
        if told.words.is_empty() {
            told.words = words::stage(told);
        }
    }
    let mut worlds = worlds::of(&stages);
    let mut answers: Vec<Answer> = Vec::new();
    for question in &scene.questions {
        let new = if !question.ask.formulas().is_empty() {
            // What is the same in every case holds on the whole domain.
            let put_in = |known: &Known| -> Vec<Expr> {
                let asked = question.ask.formulas().into_iter();
                asked.map(|e| e.substitute(known)).collect()
            };
            let mut pairs = worlds.windows(2);
            let is_same = pairs.all(|pair| put_in(&pair[0].known) == put_in(&pair[1].known));
            let needs = |world: &World| reached::needs(scene, &stages, world, question, &answers);
            let mut shared = needs(&worlds[0]);
            for world in &worlds[1..] {
                let own = needs(world);
                shared.retain(|need| own.contains(need));
            }
            worlds::each(scene, question, &mut worlds, |world| {
                if let Some(why) = needs_open(&question.ask, &world.known, &answers) {
                    return Ok(vec![unanswered(question, &why)]);
                }
                let (whole, needs) = match is_same {
                    true => (scene, shared.clone()),
                    false => (&world.part_of(scene), needs(world)),
                };
                let mut new = formula(&reached::part(whole, &needs), question, &world.known)?;
                for a in &mut new {
                    reached::tell(whole, &question.ask, &needs, a);
                    reached::on_the_way(scene, &stages, world, question, &answers, a);
                    reached::gripped(whole, &stages, world, question, &answers, a);
                    if is_same {
                        reached::one_of_the_cases(scene, question, &answers, a);
                    }
                }
                let cases = world.outcome.iter();
                let cases = cases.filter_map(|(i, k)| stages[*i].cases.get(*k));
                let conditions = cases.flat_map(|case| case.conditions.iter().map(|(_, e)| e));
                leave_to_cases(scene, question, conditions, &mut new);
                Ok(new)
            })?
        } else {
            let mut new = one(scene, &stages, question, &answers)?;
            new.iter_mut().for_each(|a| reached::led_to(&stages, a));
            worlds::remember(&mut worlds, &new);
            if let (Ask::Friction { .. }, [only]) = (&question.ask, new.as_slice()) {
                worlds::everywhere(&mut worlds, only);
            }
            new
        };
        answers.extend(new);
    }
    let second = second::look(scene, &worlds, &stages);
    for (i, check) in second::answers(&second, (&worlds, &stages), &answers) {
        answers[i].checks.push(check);
    }
    let checks = of_stages(scene, &stages, &second, &mut answers);
    for (told, checks) in stages.iter_mut().zip(checks) {
        told.checks.extend(checks);
    }
    // What decides the case is needed too, and what an answer rests on.
    let cases = stages.iter().flat_map(|told| &told.cases);
    let decide = cases.flat_map(|case| &case.conditions);
    let mut decide: BTreeSet<Symbol> = decide.flat_map(|(_, e)| e.symbols()).collect();
    let rests_on = answers.iter().flat_map(|a| &a.assumptions);
    decide.extend(
        rests_on
            .flat_map(|words| &words.0)
            .flat_map(|piece| match piece {
                Piece::Formula(e) => e.symbols(),
                Piece::Words(_) => Default::default(),
            }),
    );
    let mut unused = unused(scene, &answers);
    unused.retain(|name| !decide.contains(name));
    Ok(Told {
        stages,
        answers,
        readings: scene.readings.clone(),
        unused,
        ..Told::default()
    })
}

/// What the second way says of each stage; answers rest on what it could not see.
fn of_stages(
    scene: &Scene,
    stages: &[StageTold],
    second: &second::Second<'_>,
    answers: &mut [Answer],
) -> Vec<Vec<Check>> {
    let mut checks: Vec<Vec<Check>> = Vec::new();
    for (i, told) in stages.iter().enumerate() {
        let mut mine = vec![second.stage(i, told)];
        mine.extend(second.never_ends(told));
        if let Some((pair, check)) = second.passage(i, told) {
            if check.holds.is_none() {
                // Whether they meet depends on the data, and what comes of it is not told.
                let [a, b] = pair.map(|b| &scene.bodies[b].name);
                let words = "`{}` and `{}` do not pass through each other in `{}`";
                let apart = Sentence::filled(words, [a, b, &told.name].map(Sentence::from));
                let resting = resting(scene, stages, answers, i);
                for answer in (answers.iter_mut()).filter(|a| resting.contains(&a.question)) {
                    answer.assumptions.push(apart.clone());
                }
            }
            mine.push(check);
        }
        checks.push(mine);
    }
    checks
}

/// The questions whose answers rest on what happens in a stage, some of them by the answers that they use.
fn resting(scene: &Scene, stages: &[StageTold], answers: &[Answer], i: usize) -> BTreeSet<String> {
    let mut out: BTreeSet<String> = BTreeSet::new();
    for question in &scene.questions {
        let mine = answers.iter().filter(|a| a.question == question.name);
        let mut led = mine.filter_map(|a| a.told).peekable();
        let rests = match (question.ask.formulas().is_empty(), led.peek()) {
            (_, Some(_)) => led.any(|at| line(stages, at).any(|(stage, _)| stage == i)),
            (true, None) => true,
            (false, None) => (reached::used(&scene.questions, question).iter())
                .any(|used| out.contains(&used.name)),
        };
        if rests {
            out.insert(question.name.clone());
        }
    }
    out
}

/// An answer that has no value, and why.
pub(super) fn unanswered(question: &Question, why: &Sentence) -> Answer {
    Answer::blank(question, &question.name, "what is asked").leave_open(why)
}

/// What a question about formulas needs that has no value.
pub(super) fn needs_open(ask: &Ask, known: &Known, earlier: &[Answer]) -> Option<Sentence> {
    let put_in = ask.with().iter().map(|(_, value)| value);
    let all = ask.formulas().into_iter().chain(put_in);
    let symbols = all.flat_map(Expr::symbols);
    let mut missing = symbols.filter(|s| !known.contains_key(s));
    missing.find_map(|name| {
        // A vector without a value has no components that could be named.
        let whole = ["_x", "_y"].iter().find_map(|axis| name.strip_suffix(axis));
        let is_it =
            |a: &&Answer| a.name == *name || a.question == *name || whole == Some(a.name.as_str());
        let open = earlier
            .iter()
            .filter(is_it)
            .find(|a| matches!(a.form, Form::Open(_)))?;
        let why = open.text.first().cloned();
        let why = why
            .or_else(|| open.left_open().map(Sentence::words))
            .unwrap_or_default();
        let name = Expr::symbol(&open.name);
        Some(match why.to_string().strip_prefix("not determined: it ") {
            Some(why) => sentence!("it needs {}, which {}", &name, why),
            None => sentence!("it needs {}, which is {}", &name, why),
        })
    })
}

/// The answers of a question about formulas, with what the answers before stand for.
fn formula(scene: &Scene, question: &Question, known: &Known) -> Result<Vec<Answer>, Refused> {
    Ok(answer::formulas(scene, question, known)?.unwrap_or_default())
}

fn one(
    scene: &Scene,
    stages: &[StageTold],
    question: &Question,
    earlier: &[Answer],
) -> Result<Vec<Answer>, Refused> {
    let stage = question.stage.map(|i| &scene.stages[i]);
    if stage.is_some_and(|stage| ways(stages, stage).is_empty()) {
        let why = Sentence::words("the laws contradict each other before");
        return Ok(vec![unanswered(question, &why)]);
    }
    let each =
        |answer: &dyn Fn(&StageTold) -> Result<Answer, Refused>| each_way(stages, stage, answer);
    match &question.ask {
        Ask::Reaction { along, at_end } => {
            each(&|told| motion::reaction(question, told, along, *at_end))
        }
        Ask::Time => each(&|told| Ok(motion::time(question, told))),
        Ask::Distance => each(&|told| Ok(motion::distance(question, told))),
        Ask::Acceleration { body } => each(&|told| Ok(motion::acceleration(question, told, *body))),
        Ask::AngularAcceleration { at_end, .. } => {
            each(&|told| motion::angular_acceleration(question, told, *at_end))
        }
        Ask::PointAcceleration { at_end, .. } => {
            each(&|told| motion::point_acceleration(scene, question, told, *at_end))
        }
        Ask::Tension { body } => each(&|told| Ok(motion::tension(question, told, *body))),
        Ask::Angle { body, clockwise } => {
            each(&|told| motion::angle(question, told, *body, *clockwise))
        }
        Ask::Position {
            body,
            along,
            at_end,
        } => {
            let axis = |k: usize| [0, 1].map(|i| Expr::from(i64::from(i == k)));
            let axes = match along {
                Some(along) => vec![("", along.clone())],
                None => vec![("_x", axis(0)), ("_y", axis(1))],
            };
            let mut out = Vec::new();
            for (suffix, along) in axes {
                out.extend(each(&|told| {
                    motion::position(question, suffix, told, *body, &along, *at_end)
                })?);
            }
            Ok(out)
        }
        Ask::AngularMomentum {
            body,
            about,
            center_of,
            at_end,
        } => each_outcome(stages, stage, *at_end, |told, state| {
            let about = center_of.map_or(about, |b| &state.center[b]);
            let about = (about, *center_of);
            motion::angular_momentum(question, (told, state), (*body, about), *at_end)
        }),
        Ask::Share {
            mass,
            stiffness,
            during,
        } => {
            let words = "share of the blow that the spring takes while it lasts";
            let out = Answer::blank(question, &question.name, words);
            let spring = [mass, stiffness, during];
            Ok(spring::share(out, spring, &scene.domains))
        }
        Ask::Impulsive
        | Ask::Describe
        | Ask::Missing
        | Ask::Remark(_)
        | Ask::Assumed
        | Ask::Unused(_) => {
            let answer = in_words(scene, stages, question, stage, earlier);
            Ok(answer.into_iter().collect())
        }
        Ask::Turn {
            number,
            turns,
            of,
            total,
        } => turns::answer(scene, stages, question, (number, turns, of, *total)).map(|a| vec![a]),
        // Those about formulas have been answered before.
        _ => stage.map_or_else(
            || Ok(Vec::new()),
            |stage| quantity(scene, stages, question, stage),
        ),
    }
}

/// What the name of an answer to an earlier stage stands for on the way that ends with an outcome of a stage, or why it is
/// open.
pub(super) fn earlier(
    scene: &Scene,
    stages: &[StageTold],
    branch: Option<(usize, usize)>,
    name: &Symbol,
) -> Result<Result<Expr, String>, Refused> {
    let is_given = scene.parameter(name).is_some();
    let question = scene.answering(name).filter(|_| !is_given);
    let Some(question) = question else {
        return Ok(Ok(Expr::symbol(name)));
    };
    if let Ask::Value { formula, .. } = &question.ask {
        return put(scene, stages, branch, formula);
    }
    let way: Vec<(usize, usize)> = successors(branch, |(stage, _)| stages[*stage].branch).collect();
    let all = one(scene, stages, question, &[])?;
    let mine = |a: &&Answer| {
        let rest = a.name.strip_prefix(&**name);
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with("_case"))
    };
    let all: Vec<&Answer> = all.iter().filter(mine).collect();
    let here = |a: &&&Answer| a.told.is_some_and(|told| way.contains(&told));
    let found = match all[..] {
        [only] => Some(only),
        _ => all.iter().find(here).copied(),
    };
    let value = found.and_then(Answer::formula).cloned();
    Ok(value.ok_or_else(|| format!("it needs {name}, which is not determined")))
}

/// A formula with what the answers in it stand for, or why it is open.
fn put(
    scene: &Scene,
    stages: &[StageTold],
    branch: Option<(usize, usize)>,
    formula: &Expr,
) -> Result<Result<Expr, String>, Refused> {
    let mut known = Known::new();
    for part in formula.symbols() {
        match earlier(scene, stages, branch, &part)? {
            Ok(value) => _ = known.insert(part, value),
            Err(why) => return Ok(Err(why)),
        }
    }
    Ok(Ok(formula.substitute(&known)))
}

/// An answer in sentences; `None` where it needs a stage and names none.
fn in_words(
    scene: &Scene,
    stages: &[StageTold],
    question: &Question,
    stage: Option<&Stage>,
    earlier: &[Answer],
) -> Option<Answer> {
    let of_stage = |what: String, words: fn(&StageTold) -> Vec<Sentence>| {
        let told = ways(stages, stage?).into_iter();
        Some((what, told.flat_map(|(_, t, _)| words(t)).collect()))
    };
    let called = || stage.map_or("", |stage| stage.name.as_str());
    let (what, text) = match &question.ask {
        Ask::Impulsive => of_stage(
            format!("forces with an impulse in `{}`", called()),
            words::impulsive,
        )?,
        Ask::Describe => of_stage(format!("what happens in `{}`", called()), |t| {
            t.words.clone()
        })?,
        Ask::Missing => of_stage(format!("what `{}` leaves open", called()), words::missing)?,
        Ask::Remark(words) => (
            String::from("words of the scene's author, not derived"),
            vec![words.into()],
        ),
        Ask::Unused(of) => (
            format!("data not needed for `{of}`"),
            vec![without(scene, of, earlier)],
        ),
        _ => (
            String::from("what is assumed"),
            granted::assumed(&scene.readings, stages),
        ),
    };
    let mut out = Answer::blank(question, &question.name, what);
    out.text = text;
    Some(out)
}

/// Without which data an answer is found.
fn without(scene: &Scene, of: &str, earlier: &[Answer]) -> Sentence {
    let asked = earlier.iter().filter(|a| a.question == of || a.name == of);
    let unused = unused(scene, &asked.cloned().collect::<Vec<_>>());
    let of = Symbol::from(of);
    if unused.is_empty() {
        return sentence!("{} needs all of the data", &of);
    }
    let unused: Vec<Sentence> = unused.iter().map(Sentence::from).collect();
    sentence!("{} is found without {}", &of, Sentence::list(&unused))
}

/// Parameters that no answer so far depends on.
fn unused(scene: &Scene, answers: &[Answer]) -> Vec<Symbol> {
    let mut used: BTreeSet<Symbol> = BTreeSet::new();
    for a in answers {
        // An identity that was shown holds for any data; what a stage is asked for needs what stands in it.
        let shown = a.told.is_none() && matches!(a.form, Form::Equation { .. });
        let formulas = a.form.formulas().into_iter().filter(|_| !shown);
        used.extend(formulas.flat_map(Expr::symbols));
        let ends = a.range.iter().flat_map(|(s, _, e)| [s, e]);
        used.extend(ends.flat_map(Expr::symbols));
    }
    // A coordinate takes every value on the way.
    used.extend(scene.stages.iter().filter_map(|s| match &s.kind {
        StageKind::Linkage(linkage) => Some(linkage.coordinate.clone()),
        _ => None,
    }));
    let names = scene.parameters.iter().map(|p| p.name.clone());
    names.filter(|name| !used.contains(name)).collect()
}

/// One of the ways a stage may come about, where there are several.
struct Way {
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
fn ways<'a>(stages: &'a [StageTold], stage: &Stage) -> Vec<(usize, &'a StageTold, Way)> {
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
fn each_way(
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
fn each_outcome(
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
fn rests_on(case: &Case) -> Vec<Sentence> {
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
fn happens_where(case: &Case) -> impl Iterator<Item = Sentence> {
    let places = case.places.iter().filter_map(Condition::told);
    case.conditions.iter().map(supposed).chain(places)
}

/// What must be ≥ 0, with the words for it.
fn supposed((why, e): &(String, Expr)) -> Sentence {
    sentence!("{} ({})", Sentence::not_negative(e), why)
}

/// Velocities, spins, impulses and energies at the end of a stage.
fn quantity(
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
            let asked = case.scene.questions.iter();
            let Some(asked) = asked.into_iter().find(|q| q.name == question.name) else {
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

/// Names an answer after its case.
pub(super) fn number_case(answer: &mut Answer, number: usize) {
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
