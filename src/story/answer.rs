//! The questions of a story, answered in their order; formulas may use the answers before them.

use std::collections::BTreeSet;

use super::{Case, StageTold, State, Told, motion, second, spring, words, worlds};
use crate::answer::calc::{is_zero, tidy};
use crate::answer::{self, Answer, Check, Form, Known, Refused};
use crate::derive;
use crate::dimension::Dimension;
use crate::domain::Domains;
use crate::expr::{Expr, Symbol, Vector, cross, dot, minus};
use crate::formula::{Sentence, sentence};
use crate::scene::{Ask, EnergyWhen, Question, Scene, Stage, StageKind, Story, Turn};

/// Answers all questions.
pub(super) fn all(
    scene: &Scene,
    story: &Story,
    mut stages: Vec<StageTold>,
) -> Result<Told, Refused> {
    for told in &mut stages {
        if told.words.is_empty() {
            told.words = words::stage(told);
        }
    }
    let mut worlds = worlds::of(&stages);
    let mut answers: Vec<Answer> = Vec::new();
    for question in &story.questions {
        let new = if !question.ask.formulas().is_empty() {
            worlds::each(scene, &mut worlds, |known| {
                match needs_open(&question.ask, known, &answers) {
                    Some(why) => Ok(vec![unanswered(question, &why)]),
                    None => formula(scene, question, known),
                }
            })?
        } else {
            let new = one(scene, story, &stages, question, &answers)?;
            worlds::remember(&mut worlds, &new);
            new
        };
        answers.extend(new);
    }
    let second = second::look(scene, story, &worlds, &stages);
    for (i, check) in second::answers(&second, &worlds, &answers) {
        answers[i].checks.push(check);
    }
    let each = stages.iter().enumerate();
    let checks: Vec<_> = each
        .map(|(i, told)| second.stage(&worlds, i, told))
        .collect();
    for (told, check) in stages.iter_mut().zip(checks) {
        told.checks.push(check);
    }
    let unused = unused(scene, &answers);
    Ok(Told {
        stages,
        answers,
        readings: story.readings.clone(),
        unused,
        ended: Vec::new(),
    })
}

/// An answer that has no value, and why.
fn unanswered(question: &Question, why: &Sentence) -> Answer {
    let mut out = Answer::blank(question, &question.name, "what is asked");
    out.text.push(sentence!["not determined: ", why]);
    out
}

/// What a question about formulas needs that has no value.
fn needs_open(ask: &Ask, known: &Known, earlier: &[Answer]) -> Option<Sentence> {
    let symbols = ask.formulas().into_iter().flat_map(Expr::symbols);
    let mut missing = symbols.filter(|s| !known.contains_key(s));
    missing.find_map(|name| {
        let is_it = |a: &&Answer| a.name == *name || a.question == *name;
        let open = earlier
            .iter()
            .filter(is_it)
            .find(|a| a.formula().is_none() && a.told.is_some())?;
        let why = open.text.first().cloned().unwrap_or_default();
        Some(sentence!["it needs `", &open.name, "`, which is ", why])
    })
}

/// The answers of a question about formulas, with what the answers before stand for.
fn formula(scene: &Scene, question: &Question, known: &Known) -> Result<Vec<Answer>, Refused> {
    Ok(answer::formulas(scene, question, known)?.unwrap_or_default())
}

fn one(
    scene: &Scene,
    story: &Story,
    stages: &[StageTold],
    question: &Question,
    earlier: &[Answer],
) -> Result<Vec<Answer>, Refused> {
    let domains = &scene.domains;
    let name = question.name.as_str();
    let stage = question.stage.map(|i| &story.stages[i]);
    let mut out = match &question.ask {
        Ask::Reaction { along, at_end } => {
            return each_way(stages, stage, |told| {
                reaction_asked(question, told, along, *at_end)
            });
        }
        Ask::Time => {
            return each_way(stages, stage, |told| {
                let mut out =
                    Answer::blank(question, name, format!("time that `{}` takes", told.name));
                out.dimension = Dimension::new(0, 0, 1);
                match &told.time {
                    Some(time) => valued(&mut out, time, &told.assumptions),
                    None => out
                        .text
                        .push(Sentence::words("not determined: it has no closed form")),
                }
                Ok(out)
            });
        }
        Ask::Distance => {
            return each_way(stages, stage, |told| {
                let words = format!("distance covered in `{}`", told.name);
                let mut out = Answer::blank(question, name, words);
                out.dimension = Dimension::new(0, 1, 0);
                match &told.way {
                    Some(way) => valued(&mut out, way, &told.assumptions),
                    None => out
                        .text
                        .push(Sentence::words("not determined: where it leads is open")),
                }
                Ok(out)
            });
        }
        Ask::Position {
            body,
            along,
            at_end,
        } => {
            let axes = match along {
                Some(_) => vec![("", None)],
                None => vec![("_x", Some(0)), ("_y", Some(1))],
            };
            let mut out = Vec::new();
            for (suffix, axis) in axes {
                let along = match (along, axis) {
                    (Some(along), _) => along.clone(),
                    (_, axis) => [0, 1].map(|k| Expr::from(i64::from(axis == Some(k)))),
                };
                let all = each_way(stages, stage, |told| {
                    position(question, suffix, told, *body, &along, *at_end)
                });
                out.extend(all?);
            }
            return Ok(out);
        }
        Ask::AngularMomentum {
            body,
            about,
            at_end,
        } => {
            return each_way(stages, stage, |told| {
                angular_momentum(scene, question, told, (*body, about), *at_end)
            });
        }
        Ask::Share {
            mass,
            stiffness,
            during,
        } => {
            let out = Answer::blank(
                question,
                name,
                "share of the blow that the spring takes while it lasts",
            );
            return Ok(spring::share(out, [mass, stiffness, during], domains));
        }
        Ask::Impulsive | Ask::Describe | Ask::Missing => {
            let Some(stage) = stage else {
                return Ok(Vec::new());
            };
            let told = ways(stages, stage);
            let name_of = |what: &str| format!("{what} `{}`", stage.name);
            let (words, each): (String, fn(&StageTold) -> Vec<Sentence>) = match &question.ask {
                Ask::Impulsive => (name_of("forces with an impulse in"), words::impulsive),
                Ask::Describe => (name_of("what happens in"), |t| t.words.clone()),
                _ => (format!("{} leaves open", name_of("what")), words::missing),
            };
            let mut out = Answer::blank(question, name, words);
            out.text = told.into_iter().flat_map(|(_, t, _)| each(t)).collect();
            out
        }
        Ask::Remark(words) => {
            let mut out = Answer::blank(question, name, "words of the scene's author, not derived");
            out.text.push(words.into());
            out
        }
        Ask::Assumed => {
            let mut out = Answer::blank(question, name, "what is assumed");
            out.text = words::assumed(&story.readings, stages);
            out
        }
        Ask::Unused(of) => {
            let mut out = Answer::blank(question, name, format!("data not needed for `{of}`"));
            let of = Symbol::from(of.as_str());
            let asked: Vec<Answer> = earlier
                .iter()
                .filter(|a| *a.question == *of || *a.name == *of)
                .cloned()
                .collect();
            let unused = unused(scene, &asked);
            out.text.push(if unused.is_empty() {
                sentence![&of, " needs all of the data"]
            } else {
                sentence![
                    &of,
                    " does not need ",
                    Sentence::list(&unused.iter().map(Sentence::from).collect::<Vec<_>>())
                ]
            });
            out
        }
        _ => match stage {
            Some(stage) => return quantity(scene, stages, question, stage),
            // Those about formulas have been answered before.
            None => return Ok(Vec::new()),
        },
    };
    out.assumptions.sort();
    out.assumptions.dedup();
    Ok(vec![out])
}

/// Parameters that no answer so far depends on.
fn unused(scene: &Scene, answers: &[Answer]) -> Vec<Symbol> {
    let mut used: BTreeSet<Symbol> = BTreeSet::new();
    for a in answers {
        // An identity that was shown holds for any data; what a stage is asked for needs what stands in it.
        let shown = a.told.is_none() && matches!(a.form, Form::Equation { .. });
        let formulas = a.form.formulas().into_iter().filter(|_| !shown);
        used.extend(formulas.flat_map(Expr::symbols));
        used.extend(
            a.range
                .iter()
                .flat_map(|(s, _, e)| s.symbols().into_iter().chain(e.symbols())),
        );
    }
    scene
        .parameters
        .iter()
        .filter(|p| !used.contains(&p.name))
        .map(|p| p.name.clone())
        .collect()
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
            words: told.branch.map_or(String::new(), |(parent, k)| {
                words::leading(stages, parent, k)
            }),
            given: (told.given.iter())
                .map(|(why, e)| sentence![e, " ≥ 0 (", why, ")"])
                .collect(),
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

/// Velocities, spins, impulses and energies at the end of a stage.
fn quantity(
    scene: &Scene,
    stages: &[StageTold],
    question: &Question,
    stage: &Stage,
) -> Result<Vec<Answer>, Refused> {
    let ways = ways(stages, stage);
    if ways.is_empty() {
        let why = Sentence::words("the laws contradict each other before");
        let mut out = unanswered(question, &why);
        out.told = Some((usize::MAX, 0));
        return Ok(vec![out]);
    }
    let cases: usize = ways.iter().map(|(_, t, _)| t.cases.len().max(1)).sum();
    let mut number = 0;
    let mut out = Vec::new();
    for (i, told, way) in ways {
        let mut own = if told.cases.is_empty() {
            of_motion(scene, question, told)?
        } else {
            told.cases
                .iter()
                .flat_map(|case| of_case(question, case, cases > 1))
                .collect()
        };
        let per = own.len() / told.cases.len().max(1);
        for (k, answer) in own.iter_mut().enumerate() {
            let state = match told.cases.get(k / per.max(1)) {
                Some(case) => &case.after,
                None => &told.after,
            };
            if let Some(why) = state.why_open(answer.form.formulas()) {
                answer.form = Form::Words;
                answer.checks.clear();
                answer.text = vec![sentence!["not determined: ", why]];
            }
            if matches!(answer.form, Form::Open(_) | Form::Words) {
                answer.checks.clear();
            }
            let way = Way {
                number: (cases > 1).then_some(number + k / per.max(1)),
                words: way.words.clone(),
                given: way.given.clone(),
            };
            way.put(answer);
            answer.told = Some((i, k / per.max(1)));
        }
        number += told.cases.len().max(1);
        out.extend(own);
    }
    Ok(out)
}

/// The force of the fixed point on a turning body, as asked.
fn reaction_asked(
    question: &Question,
    told: &StageTold,
    along: &Vector,
    at_end: bool,
) -> Result<Answer, Refused> {
    let when = if at_end { "end" } else { "beginning" };
    let words = format!("force of the fixed point at the {when} of `{}`", told.name);
    let mut out = Answer::blank(question, &question.name, words);
    out.dimension = Dimension::new(1, 1, -2);
    let StageKind::Turn(turn) = &told.placed.kind else {
        return Ok(out);
    };
    let state = if at_end { &told.after } else { &told.before };
    if let Some(why) = state.why_open(state.spin.iter().take(turn.body + 1).skip(turn.body)) {
        out.text.push(sentence!["not determined: ", why]);
        return Ok(out);
    }
    let (way, _) = motion::sense(&told.placed, &told.before.spin[turn.body], turn)?;
    let value = reaction(&told.placed, told, turn, way, along, at_end)
        .map_err(|stop| Refused::question(&question.name, format!("not calculated: {stop}"), ""))?;
    if at_end {
        out.assumptions = told.assumptions.clone();
    }
    out.form = Form::value(value);
    Ok(out)
}

/// Gives an answer its value, and what that takes for granted.
fn valued(answer: &mut Answer, value: &Expr, assumptions: &[Sentence]) {
    answer.form = Form::value(value.clone());
    answer.assumptions = assumptions.to_vec();
}

/// Where the center of mass of a body is at the beginning or end of a stage, along a direction.
fn position(
    question: &Question,
    suffix: &str,
    told: &StageTold,
    body: usize,
    along: &Vector,
    at_end: bool,
) -> Result<Answer, Refused> {
    let scene = &told.placed.scene;
    let (state, when) = match at_end {
        true => (&told.after, "end"),
        false => (&told.before, "beginning"),
    };
    let words = format!(
        "position of the center of mass of `{}` at the {when} of `{}`",
        scene.bodies[body].name, told.name
    );
    let mut out = Answer::blank(question, &format!("{}{suffix}", question.name), words);
    out.dimension = Dimension::new(0, 1, 0);
    if let Some(why) = state.why_open(&state.center[body]) {
        out.text.push(sentence!["not determined: ", why]);
        return Ok(out);
    }
    let value = tidy(&dot(&state.center[body], along), &scene.domains)
        .map_err(|stop| Refused::question(&question.name, format!("not calculated: {stop}"), ""))?;
    let assumptions = if at_end {
        told.assumptions.as_slice()
    } else {
        &[]
    };
    valued(&mut out, &value, assumptions);
    Ok(out)
}

/// The angular momentum of a body about a point at the beginning or end of a stage.
fn angular_momentum(
    scene: &Scene,
    question: &Question,
    told: &StageTold,
    (body, about): (usize, &Vector),
    at_end: bool,
) -> Result<Answer, Refused> {
    let state = if at_end { &told.after } else { &told.before };
    let b = &scene.bodies[body];
    let arm = minus(&state.center[body], about);
    let h = &(&b.mass * &cross(&arm, &state.velocity[body])) + &(&b.inertia * &state.spin[body]);
    let when = if at_end { "end" } else { "beginning" };
    let words = format!(
        "angular momentum of `{}` at the {when} of `{}`",
        b.name, told.name
    );
    let mut out = Answer::blank(question, &question.name, words);
    out.dimension = Dimension::new(1, 2, -1);
    if let Some(why) = state.why_open([&h]) {
        out.text.push(sentence!["not determined: ", why]);
        return Ok(out);
    }
    let value = tidy(&h, &scene.domains)
        .map_err(|stop| Refused::question(&question.name, format!("not calculated: {stop}"), ""))?;
    out.checks.push(Check {
        kind: "identity",
        words: format!(
            "r × m v + I ω of the motion told in `{}`: the difference is zero in the normal form",
            told.name
        ),
        holds: is_zero(&(&h - &value), &scene.domains),
    });
    out.form = Form::value(value);
    Ok(out)
}

/// The answers of one outcome of an impact.
fn of_case(question: &Question, case: &Case, several: bool) -> Vec<Answer> {
    let mut out = Vec::new();
    for (answer, checks) in case.derivation.answers.iter().zip(&case.proof.answers) {
        if answer.question != question.name {
            continue;
        }
        let words = match several {
            true => format!("{}, {}", answer.words, words::active(case)),
            false => answer.words.clone(),
        };
        let mut a = Answer {
            words,
            form: answer.form.map(|e| case.put_in(e)),
            ..answer.clone()
        };
        if let Form::Open(names) = &a.form {
            let names = names.join(", ");
            a.text
                .push(sentence!["not determined: it depends on ", names]);
        }
        for (name, value) in &case.handed {
            a.text.push(sentence![
                "derived and checked for any ",
                name,
                "; then ",
                name,
                " = ",
                value,
                " is substituted"
            ]);
        }
        let taken = case
            .derivation
            .assumptions
            .iter()
            .chain(&case.proof.assumptions);
        a.assumptions.extend(taken.map(Sentence::from));
        for (why, e) in &case.conditions {
            a.assumptions.push(sentence![e, " ≥ 0 (", why, ")"]);
        }
        a.checks = identities(case).chain(checks).cloned().collect();
        out.push(a);
    }
    if out.is_empty() {
        let mut a = Answer::blank(question, &question.name, words::active(case));
        a.form = Form::value(Expr::zero());
        a.text.push(sentence![
            "nothing is transmitted there: ",
            words::active(case)
        ]);
        for (why, e) in &case.conditions {
            a.assumptions.push(sentence![e, " ≥ 0 (", why, ")"]);
        }
        a.dimension = Dimension::new(1, 1, -1);
        a.checks = identities(case).cloned().collect();
        out.push(a);
    }
    out
}

/// The laws of an outcome that its motion was put into.
fn identities(case: &Case) -> impl Iterator<Item = &Check> {
    case.proof.scene.iter().filter(|c| c.kind == "identity")
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

/// Quantities at the end of a motion.
fn of_motion(scene: &Scene, question: &Question, told: &StageTold) -> Result<Vec<Answer>, Refused> {
    let domains = &scene.domains;
    let refuse = |reason: &str| Refused::question(&question.name, reason, "");
    let ask = told.placed.asked(question);
    let what = match ask {
        Ask::Spin { .. } => "angular velocity",
        Ask::Velocity { .. } => "velocity of the center of mass",
        Ask::Energy {
            when: EnergyWhen::Lost,
            ..
        } => "kinetic energy lost",
        _ => "kinetic energy",
    };
    let when = match &question.ask {
        Ask::Energy { when, .. } => match when {
            EnergyWhen::Before => "at the beginning",
            EnergyWhen::After => "at the end",
            EnergyWhen::Lost => "from the beginning to the end",
        },
        _ => "at the end",
    };
    let words = format!("{what}, {when} of `{}`", told.name);
    let mut parts: Vec<(String, Expr)> = Vec::new();
    match ask {
        Ask::Spin { body, clockwise } => {
            let w = &told.after.spin[*body];
            parts.push((String::new(), if *clockwise { -w } else { w.clone() }));
        }
        Ask::Velocity {
            body,
            point: None,
            along,
        } => {
            let v = &told.after.velocity[*body];
            match along {
                Some(along) => parts.push((String::new(), dot(v, along))),
                None => parts.extend([
                    ("_x".to_string(), v[0].clone()),
                    ("_y".to_string(), v[1].clone()),
                ]),
            }
        }
        Ask::Velocity { .. } => {
            return Err(refuse(
                "at the end of a motion the velocity of the center of mass is known; a point of the body is elsewhere by then",
            ));
        }
        Ask::Energy { when, of } => {
            let whole = told.energy.as_ref().filter(|_| is_alone(told, *of));
            let [before, after] = match whole {
                Some(energy) => energy.clone(),
                None => [&told.before, &told.after].map(|state| kinetic(scene, state, *of)),
            };
            parts.push((
                String::new(),
                match when {
                    EnergyWhen::Before => before,
                    EnergyWhen::After => after,
                    EnergyWhen::Lost => before - after,
                },
            ));
        }
        _ => return Err(refuse("a motion transmits no impulse; ask it of an impact")),
    }
    let dimension = derive::dimension(ask);
    let mut out = Vec::new();
    for (suffix, value) in parts {
        let mut a = Answer::blank(
            question,
            &format!("{}{suffix}", question.name),
            words.clone(),
        );
        let value = tidy(&value, domains).map_err(|stop| refuse(&stop.to_string()))?;
        a.checks.extend(told.checks.iter().cloned());
        a.checks.extend(energy_check(told, domains));
        a.form = Form::value(value);
        a.dimension = dimension.clone();
        if !matches!(ask, Ask::Energy { .. }) {
            a.assumptions = told.assumptions.clone();
        }
        out.push(a);
    }
    Ok(out)
}

/// Whether the motion of a stage is all that moves of what is asked about.
fn is_alone(told: &StageTold, of: Option<usize>) -> bool {
    let moved = told.placed.kind.moved();
    let scene = &told.placed.scene;
    let rests = |b: usize| {
        let mut parts = told.before.velocity[b].iter().chain([&told.before.spin[b]]);
        parts.all(|c| is_zero(c, &scene.domains) == Some(true))
    };
    match of {
        Some(body) => moved == [body],
        None => (0..scene.bodies.len()).all(|b| moved.contains(&b) || rests(b)),
    }
}

/// Kinetic energy of a body, or of all.
fn kinetic(scene: &Scene, state: &State, of: Option<usize>) -> Expr {
    let half = Expr::ratio(1, 2);
    let moving = scene
        .bodies
        .iter()
        .enumerate()
        .filter(|(_, b)| !b.is_fixed());
    let parts = moving
        .filter(|(b, _)| of.is_none_or(|of| of == *b))
        .map(|(b, body)| {
            let v = &state.velocity[b];
            let moves = &body.mass * &dot(v, v);
            // A particle that goes round a point has an angular velocity, but no energy beyond that of its velocity.
            let turns = &body.inertia * &state.spin[b].powi(2);
            &half * &(&moves + &turns)
        });
    Expr::sum(parts)
}

/// The kinetic energy of the end, put together again from the motion at the end, where that came from a root.
fn energy_check(told: &StageTold, domains: &Domains) -> Option<Check> {
    let [_, end] = told.energy.as_ref()?;
    let again = told.kinetic.as_ref()?;
    Some(Check {
        kind: "identity",
        words: String::from(
            "velocity and spin at the end give the energy at the beginning and the work",
        ),
        holds: is_zero(&(again - end), domains),
    })
}

/// Force of the fixed point on a turning body along a direction: m a_G less the weight.
fn reaction(
    stage: &Stage,
    told: &StageTold,
    turn: &Turn,
    way: i64,
    along: &Vector,
    at_end: bool,
) -> Result<Expr, crate::algebra::Stop> {
    let body = turn.lump(&stage.scene);
    let inertia = motion::inertia_about(stage, turn);
    let [r0, r1] = motion::arms(stage, turn, &told.before.spin[turn.body]);
    let r = if at_end { &r1 } else { &r0 };
    let square = match &told.energy {
        Some([start, end]) => &(&Expr::from(2) * if at_end { end } else { start }) / &inertia,
        None => Expr::zero(),
    };
    let zero = Expr::zero();
    let g = turn.gravity.as_ref().unwrap_or(&zero);
    // The moment counts in the sense of the rotation.
    let applied = Expr::from(way) * turn.torque.clone().unwrap_or_else(Expr::zero);
    let weight = &body.mass * g;
    let angular = &(&applied - &(&weight * &r[0])) / &inertia;
    let a = [
        -(&(&angular * &r[1])) - &square * &r[0],
        &angular * &r[0] - &square * &r[1],
    ];
    let force = [&body.mass * &a[0], &body.mass * &a[1] + &weight];
    tidy(&dot(&force, along), &stage.scene.domains)
}
