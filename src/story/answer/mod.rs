//! The questions of a story, answered in their order; formulas may use the answers before them.
//!
//! What is asked of an impact comes from its derivation; what is asked of a motion is in [`motion`].

mod motion;
mod reached;
mod turns;
mod ways;

pub(super) use reached::{
    Led, as_decided, is_of_outcomes, leave_to_cases, needs, of_condition, of_impact, part, picked,
    tell,
};

use crate::story::UNDETERMINED;
use ways::{each_outcome, each_way, happens_where, quantity, rests_on, supposed, ways};

use std::collections::BTreeSet;
use std::iter::successors;

use super::worlds::World;
use super::{StageTold, Told, change, granted, line, second, spring, words, worlds};
use crate::answer::{self, Answer, Check, Form, Known, Refused};
use crate::expr::{Expr, Symbol};
use crate::formula::{Piece, Sentence, sentence};
use crate::scene::{Ask, Question, Scene, Stage, StageKind};

/// Answers all questions.
pub(super) fn all(scene: &Scene, mut stages: Vec<StageTold>) -> Result<Told, Refused> {
    for i in 0..stages.len() {
        if stages[i].words.is_empty() {
            let before = stages[i].branch.map(|(before, _)| &stages[before]);
            let slack = before.and_then(|before| change::slack(&stages[i], before));
            let words = words::stage(&stages[i]).into_iter().chain(slack);
            stages[i].words = words.collect();
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
            let needs = |world: &World| needs(Led::by((scene, &stages), world, &answers), question);
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
                    reached::on_the_way(Led::by((scene, &stages), world, &answers), question, a);
                    reached::gripped(Led::by((whole, &stages), world, &answers), question, a);
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
            new.iter_mut().for_each(|a| {
                reached::led_to(&stages, a);
                say_what_is_missing(a);
                say_what_it_divides_by(scene, a);
            });
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

/// Lets an answer that the laws of an impact leave open say what would close it.
fn say_what_is_missing(answer: &mut Answer) {
    let why = answer.text.first().map(Sentence::to_string);
    if matches!(answer.form, Form::Open(_)) && why.is_some_and(|why| why.ends_with(UNDETERMINED)) {
        let hint = "`after` may say what is known just after, along x and along y";
        answer.text.push(hint.into());
    }
}

/// Lets an answer tell that what it divides by does not vanish at an end of the domain, where nothing that it rests on says so.
fn say_what_it_divides_by(scene: &Scene, answer: &mut Answer) {
    let Some(value) = answer.formula() else {
        return;
    };
    let told = answer.assumptions.iter().flat_map(Sentence::conditions);
    let domains = told.fold(scene.domains.clone(), |domains, (e, is_strict)| {
        domains.given(&e, !is_strict)
    });
    let divided_by = answer::divided_by(value, &domains, false);
    answer.assumptions.extend(divided_by);
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
        let why = why.to_string();
        let reason = why.strip_prefix("not determined: ");
        let laws = reason.and_then(|reason| reason.strip_suffix(UNDETERMINED));
        Some(
            match (laws, reason.and_then(|why| why.strip_prefix("it "))) {
                (Some(laws), _) => sentence!("it needs {}, which {} do not determine", &name, laws),
                (None, Some(why)) => sentence!("it needs {}, which {}", &name, why),
                (None, None) => sentence!("it needs {}, which is {}", &name, why),
            },
        )
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
        Ask::Acceleration { body, at_end } => {
            each(&|told| Ok(motion::acceleration(question, told, *body, *at_end)))
        }
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
