//! The questions of a story, answered in their order; formulas may use the answers before them.

use std::collections::{BTreeMap, BTreeSet};

use super::calc::{is_zero, tidy};
use super::{Answer, Case, Refused, StageTold, Told, integrate, motion, optimum, threshold, words};
use super::{Sentence, sentence::sentence};
use crate::derive::{self, Form};
use crate::dimension::{self, Dimension};
use crate::domain::Domains;
use crate::equality::{self, Equality, How};
use crate::expr::{Expr, Symbol, Vector, cross, dot, minus};
use crate::formula::write_plain;
use crate::scene::{Ask, EnergyWhen, Question, Scene, StageKind, Story, StoryAsk, StoryQuestion};
use crate::verify::Check;

/// What earlier answers stand for.
type Known = BTreeMap<Symbol, Expr>;

/// Answers all questions.
pub(super) fn all(
    scene: &Scene,
    story: &Story,
    mut stages: Vec<StageTold>,
) -> Result<Told, Refused> {
    for (i, stage) in story.stages.iter().enumerate() {
        let sentences = words::stage(stage, &stages[i]);
        stages[i].words = sentences;
    }
    let mut answers: Vec<Answer> = Vec::new();
    let mut known = Known::new();
    for question in &story.questions {
        let new = one(scene, story, &stages, question, &known, &answers)?;
        remember(&new, &mut known);
        answers.extend(new);
    }
    let unused = unused(scene, &answers);
    Ok(Told {
        stages,
        answers,
        readings: story.readings.clone(),
        unused,
    })
}

/// Answers questions about formulas alone, in their order: values, thresholds, largest values, limits, identities and words.
/// `known` holds the answers found before; no stage is needed, and a question about one is refused.
pub fn about(
    scene: &Scene,
    questions: &[StoryQuestion],
    known: &BTreeMap<Symbol, Expr>,
) -> Result<Vec<Answer>, Refused> {
    let mut known = known.clone();
    let mut answers: Vec<Answer> = Vec::new();
    let story = Story::default();
    for question in questions {
        if question.ask.stage().is_some() {
            return Err(Refused {
                at: format!("question `{}`", question.name),
                reason: String::from("it asks about a stage, and there are none"),
                hint: String::from("add \"stages\", or ask about a formula"),
            });
        }
        let new = one(scene, &story, &[], question, &known, &answers)?;
        remember(&new, &mut known);
        answers.extend(new);
    }
    Ok(answers)
}

/// Later formulas may use the answers by name.
fn remember(answers: &[Answer], known: &mut Known) {
    for answer in answers {
        if let Some(formula) = &answer.formula {
            known.insert(Symbol::from(answer.name.as_str()), formula.clone());
        }
    }
}

/// An answer without content yet.
fn blank(question: &StoryQuestion, name: &str, words: impl Into<String>) -> Answer {
    let latex = question
        .latex
        .clone()
        .unwrap_or_else(|| crate::formula::latex_name(name));
    Answer {
        question: question.name.clone(),
        name: name.to_string(),
        latex,
        words: words.into(),
        formula: None,
        range: Vec::new(),
        equation: None,
        stated: None,
        put_in: Vec::new(),
        text: Vec::new(),
        dimension: Dimension::none(),
        assumptions: Vec::new(),
        discarded: Vec::new(),
        checks: Vec::new(),
    }
}

/// Dimension of an expression in the scene's parameters.
pub(super) fn dimension_of(scene: &Scene, e: &Expr, at: &str) -> Result<Dimension, Refused> {
    let of = |name: &str| {
        scene
            .parameters
            .iter()
            .find(|p| *p.name == *name)
            .map(|p| p.dimension.clone())
    };
    match dimension::of(e, &of) {
        Ok(found) => Ok(found.unwrap_or_else(Dimension::none)),
        Err(clash) => Err(Refused {
            at: format!("question `{at}`"),
            reason: clash.message(&write_plain),
            hint: String::from("both sides of a sum or relation have the same dimension"),
        }),
    }
}

fn one(
    scene: &Scene,
    story: &Story,
    stages: &[StageTold],
    question: &StoryQuestion,
    known: &Known,
    earlier: &[Answer],
) -> Result<Vec<Answer>, Refused> {
    let domains = &scene.domains;
    let name = question.name.as_str();
    let refused = |reason: String, hint: &str| Refused {
        at: format!("question `{name}`"),
        reason,
        hint: hint.into(),
    };
    let put = |e: &Expr, with: &[(Symbol, Expr)]| -> Result<Expr, Refused> {
        let open = e
            .symbols()
            .into_iter()
            .find(|s| !known.contains_key(s) && !scene.parameters.iter().any(|p| p.name == *s));
        if let Some(open) = open {
            return Err(refused(
                format!("`{open}` has no single value that could be put in"),
                "name an earlier answer that is a formula",
            ));
        }
        let with: Known = with
            .iter()
            .map(|(s, v)| (s.clone(), v.substitute(known)))
            .collect();
        let e = e.substitute(known).substitute(&with);
        tidy(&e, domains).map_err(|stop| refused(format!("not calculated: {stop}"), ""))
    };
    let mut out = match &question.ask {
        StoryAsk::Quantity { stage, question: q } => {
            return quantity(scene, story, stages, question, *stage, *q);
        }
        StoryAsk::Value { formula, with } => {
            let mut out = blank(question, name, format!("value of {}", write_plain(formula)));
            let value = put(formula, with)?;
            out.dimension = dimension_of(scene, &value, name)?;
            out.formula = Some(value);
            out.text.extend(with_words(with));
            out
        }
        StoryAsk::Condition {
            parameter,
            left,
            relation,
            right,
            with,
        } => {
            let statement = format!(
                "{} {} {}",
                write_plain(left),
                relation.sign(),
                write_plain(right)
            );
            let what = if *relation == crate::formula::Relation::Equal {
                "value"
            } else {
                "threshold"
            };
            let mut out = blank(
                question,
                name,
                format!("{what} of {parameter} for {statement}"),
            );
            let (left, right) = (put(left, with)?, put(right, with)?);
            if !left.is_zero() && !right.is_zero() {
                let (l, r) = (
                    dimension_of(scene, &left, name)?,
                    dimension_of(scene, &right, name)?,
                );
                if l != r {
                    return Err(refused(
                        format!("the sides of {statement} are {l} and {r}"),
                        "compare quantities of the same kind",
                    ));
                }
            }
            out.text.extend(with_words(with));
            out.stated = Some((left.clone(), *relation, right.clone()));
            threshold::fill(&mut out, parameter, &left, *relation, &right, scene);
            out.checks.extend(out.formula.as_ref().and_then(|value| {
                tipping(story, stages, &(&left - &right), parameter, value, domains)
            }));
            out.dimension = dimension_of(scene, &Expr::symbol(parameter), name)?;
            out
        }
        StoryAsk::Maximum { of, over } => {
            let value = put(of, &[])?;
            return optimum::maximum(
                scene,
                blank(
                    question,
                    name,
                    format!("largest value of {}", write_plain(of)),
                ),
                &value,
                over,
            );
        }
        StoryAsk::Limit { of, parameter, to } => {
            let target = to.as_ref().map_or_else(|| String::from("∞"), write_plain);
            let mut out = blank(
                question,
                name,
                format!("limit of {} as {parameter} → {target}", write_plain(of)),
            );
            let value = put(of, &[])?;
            let to = to.as_ref().map(|t| put(t, &[])).transpose()?;
            optimum::limit(&mut out, &value, parameter, to.as_ref(), domains);
            if let Some(formula) = &out.formula {
                out.dimension = dimension_of(scene, formula, name)?;
            }
            out
        }
        StoryAsk::Show { left, right } => {
            let statement = format!("{} = {}", write_plain(left), write_plain(right));
            let mut out = blank(question, name, format!("to be shown: {statement}"));
            let (left, right) = (put(left, &[])?, put(right, &[])?);
            out.checks.push(identity(&left, &right, domains));
            out.dimension = dimension_of(scene, &left, name)?;
            out.text.push(match out.checks[0].holds {
                Some(true) => sentence![statement, ": both are ", &left],
                Some(false) => sentence![statement, " does not hold: ", &left, " against ", &right],
                None => sentence![statement, " could not be decided"],
            });
            out.equation = Some((left, right));
            out
        }
        StoryAsk::Reaction {
            stage,
            along,
            at_end,
        } => {
            let value = reaction(story, stages, *stage, along, *at_end, domains)
                .map_err(|stop| refused(format!("not calculated: {stop}"), ""))?;
            let when = if *at_end { "end" } else { "beginning" };
            let mut out = blank(
                question,
                name,
                format!(
                    "force of the fixed point at the {when} of `{}`",
                    stages[*stage].name
                ),
            );
            out.dimension = Dimension::new(1, 1, -2);
            if *at_end {
                out.assumptions = stages[*stage].assumptions.clone();
            }
            out.formula = Some(value);
            out
        }
        StoryAsk::AngularMomentum {
            stage,
            body,
            about,
            at_end,
        } => {
            let told = &stages[*stage];
            let state = if *at_end { &told.after } else { &told.before };
            let b = &scene.bodies[*body];
            let arm = minus(&state.center[*body], about);
            let h = &(&b.mass * &cross(&arm, &state.velocity[*body]))
                + &(&b.inertia * &state.spin[*body]);
            let when = if *at_end { "end" } else { "beginning" };
            let mut out = blank(
                question,
                name,
                format!(
                    "angular momentum of `{}` at the {when} of `{}`",
                    b.name, told.name
                ),
            );
            out.formula = Some(
                tidy(&h, domains).map_err(|stop| refused(format!("not calculated: {stop}"), ""))?,
            );
            out.dimension = Dimension::new(1, 2, -1);
            out
        }
        StoryAsk::Impulsive { stage } => {
            let mut out = blank(
                question,
                name,
                format!("forces with an impulse in `{}`", stages[*stage].name),
            );
            out.text = words::impulsive(&story.stages[*stage], &stages[*stage]);
            out
        }
        StoryAsk::Describe { stage } => {
            let mut out = blank(
                question,
                name,
                format!("what happens in `{}`", stages[*stage].name),
            );
            out.text = stages[*stage].words.clone();
            out
        }
        StoryAsk::Missing { stage } => {
            let mut out = blank(
                question,
                name,
                format!("what `{}` leaves open", stages[*stage].name),
            );
            out.text = words::missing(&story.stages[*stage], &stages[*stage]);
            out
        }
        StoryAsk::Remark(words) => {
            let mut out = blank(question, name, "words of the scene's author, not derived");
            out.text.push(words.into());
            out
        }
        StoryAsk::Assumed => {
            let mut out = blank(question, name, "what is assumed");
            out.text = words::assumed(story, stages);
            out
        }
        StoryAsk::Unused(of) => {
            let mut out = blank(question, name, format!("data that `{of}` does not need"));
            let asked: Vec<Answer> = earlier
                .iter()
                .filter(|a| a.question == *of || a.name == *of)
                .cloned()
                .collect();
            let unused = unused(scene, &asked);
            out.text.push(if unused.is_empty() {
                sentence!["`", of, "` needs all of the data"]
            } else {
                sentence!["`", of, "` does not need ", unused.join(", ")]
            });
            out
        }
    };
    out.assumptions.sort();
    out.assumptions.dedup();
    Ok(vec![out])
}

fn with_words(with: &[(Symbol, Expr)]) -> Vec<Sentence> {
    with.iter()
        .map(|(s, v)| sentence!["taken at ", s, " = ", v])
        .collect()
}

/// Parameters that no answer so far depends on.
fn unused(scene: &Scene, answers: &[Answer]) -> Vec<String> {
    let mut used: BTreeSet<Symbol> = BTreeSet::new();
    for a in answers {
        used.extend(a.formula.iter().flat_map(Expr::symbols));
        used.extend(
            a.range
                .iter()
                .flat_map(|(s, _, e)| std::iter::once(s.clone()).chain(e.symbols())),
        );
    }
    scene
        .parameters
        .iter()
        .filter(|p| !used.contains(&p.name))
        .map(|p| p.name.to_string())
        .collect()
}

/// An identity, decided.
pub(super) fn identity(left: &Expr, right: &Expr, domains: &Domains) -> Check {
    let decision = equality::decide(left, right, domains).equality;
    let (words, holds) = match decision {
        Equality::Same {
            how: How::Identity { .. },
        } => (
            String::from("identity: the difference is zero in the normal form"),
            Some(true),
        ),
        Equality::Same {
            how: How::OnBranch { elsewhere, .. },
        } => (
            format!(
                "holds on a part of the domain only, not at {}",
                elsewhere.at.words()
            ),
            Some(false),
        ),
        Equality::Different(point) => (format!("different at {}", point.at.words()), Some(false)),
        _ => (String::from("not decided"), None),
    };
    Check {
        kind: "identity",
        words,
        holds,
    }
}

/// Velocities, spins, impulses and energies at the end of a stage.
fn quantity(
    scene: &Scene,
    story: &Story,
    stages: &[StageTold],
    question: &StoryQuestion,
    stage: usize,
    index: usize,
) -> Result<Vec<Answer>, Refused> {
    let told = &stages[stage];
    let asked = &story.stages[stage].scene.questions[index];
    if !told.cases.is_empty() {
        let several = told.cases.len() > 1;
        let mut out = Vec::new();
        for (i, case) in told.cases.iter().enumerate() {
            out.extend(of_case(
                question,
                case,
                if several { Some(i) } else { None },
            ));
        }
        return Ok(out);
    }
    of_motion(scene, question, story, told, stage, asked)
}

/// The answers of one outcome of an impact.
fn of_case(question: &StoryQuestion, case: &Case, number: Option<usize>) -> Vec<Answer> {
    let mut out = Vec::new();
    for (answer, checks) in case.derivation.answers.iter().zip(&case.proof.answers) {
        if answer.question != question.name {
            continue;
        }
        let name = match number {
            Some(i) if i > 0 => format!("{}_case{}", answer.name, i + 1),
            _ => answer.name.clone(),
        };
        let words = match number {
            Some(_) => format!("{}, {}", answer.words, words::active(case)),
            None => answer.words.clone(),
        };
        let mut a = blank(question, &name, words);
        a.latex = match number {
            Some(i) if i > 0 => format!("{}^{{({})}}", answer.latex, i + 1),
            _ => answer.latex.clone(),
        };
        a.dimension = answer.dimension.clone();
        match &answer.form {
            Form::Value { closed, .. } => a.formula = Some(case.put_in(closed)),
            Form::Equation { left, right } => {
                a.equation = Some((case.put_in(left), case.put_in(right)));
            }
            Form::Matrix(_) => a
                .text
                .push(Sentence::words("a matrix; ask it of the impact by itself")),
            Form::Open(unknowns) => {
                let names: Vec<&str> = unknowns
                    .iter()
                    .map(|u| case.derivation.names.plain(*u))
                    .collect();
                a.text
                    .push(sentence!["not determined: it hangs on ", names.join(", ")]);
            }
        }
        for (name, value) in &case.handed {
            a.text.push(sentence![
                "derived and checked for any ",
                name,
                ", then ",
                name,
                " = ",
                value,
                " put in"
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
        a.checks = case
            .proof
            .scene
            .iter()
            .filter(|c| c.kind == "identity")
            .chain(checks)
            .cloned()
            .collect();
        out.push(a);
    }
    if out.is_empty() {
        let mut a = blank(question, &question.name, words::active(case));
        if let Some(i) = number.filter(|i| *i > 0) {
            a.name = format!("{}_case{}", question.name, i + 1);
        }
        a.formula = Some(Expr::zero());
        a.text.push(sentence![
            "nothing is transmitted there: ",
            words::active(case)
        ]);
        for (why, e) in &case.conditions {
            a.assumptions.push(sentence![e, " ≥ 0 (", why, ")"]);
        }
        a.dimension = Dimension::new(1, 1, -1);
        out.push(a);
    }
    out
}

/// A threshold at which a rotation just gets to its end, integrated on both sides.
fn tipping(
    story: &Story,
    stages: &[StageTold],
    gap: &Expr,
    parameter: &Symbol,
    value: &Expr,
    domains: &Domains,
) -> Option<Check> {
    stages.iter().zip(&story.stages).find_map(|(told, stage)| {
        let (StageKind::Turn(turn), Some([_, end])) = (&stage.kind, &told.energy) else {
            return None;
        };
        let is_end = is_zero(&(gap - end), domains) == Some(true)
            || is_zero(&(gap + end), domains) == Some(true);
        if !is_end {
            return None;
        }
        let (way, _) = motion::sense(stage, &told.before.spin[turn.body], turn).ok()?;
        Some(integrate::both_sides(
            stage, told, turn, way, parameter, value,
        ))
    })
}

/// Quantities at the end of a motion.
fn of_motion(
    scene: &Scene,
    question: &StoryQuestion,
    story: &Story,
    told: &StageTold,
    stage: usize,
    asked: &Question,
) -> Result<Vec<Answer>, Refused> {
    let domains = &scene.domains;
    let refuse = |reason: &str| Refused {
        at: format!("question `{}`", question.name),
        reason: reason.into(),
        hint: String::new(),
    };
    let what = match &asked.ask {
        Ask::Spin { .. } => "angular velocity",
        Ask::Velocity { .. } => "velocity of the center of mass",
        _ => "kinetic energy",
    };
    let words = format!("{what}, at the end of `{}`", told.name);
    let mut parts: Vec<(String, Expr)> = Vec::new();
    match &asked.ask {
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
            let Some([before, after]) = &told.energy else {
                return Err(refuse("this stage has no kinetic energy of its own"));
            };
            let moving = match &story.stages[stage].kind {
                StageKind::Turn(t) => t.body,
                StageKind::Slide(s) => s.body,
                StageKind::Fall(f) => f.body,
                StageKind::Wind(w) => w.body,
                StageKind::Impact { .. } => return Err(refuse("an impact answers this itself")),
            };
            if of.is_some_and(|b| b != moving) {
                return Err(refuse("this body takes no part in the stage"));
            }
            parts.push((
                String::new(),
                match when {
                    EnergyWhen::Before => before.clone(),
                    EnergyWhen::After => after.clone(),
                    EnergyWhen::Lost => before - after,
                },
            ));
        }
        _ => return Err(refuse("a motion transmits no impulse; ask it of an impact")),
    }
    let dimension = derive::dimension(&asked.ask);
    let mut out = Vec::new();
    for (suffix, value) in parts {
        let mut a = blank(
            question,
            &format!("{}{suffix}", question.name),
            words.clone(),
        );
        let value = tidy(&value, domains).map_err(|stop| refuse(&stop.to_string()))?;
        a.checks.extend(told.checks.iter().cloned());
        a.checks.extend(energy_check(told, domains));
        a.formula = Some(value);
        a.dimension = dimension.clone();
        if !matches!(asked.ask, Ask::Energy { .. }) {
            a.assumptions = told.assumptions.clone();
        }
        out.push(a);
    }
    Ok(out)
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
    story: &Story,
    stages: &[StageTold],
    stage: usize,
    along: &Vector,
    at_end: bool,
    domains: &Domains,
) -> Result<Expr, crate::algebra::Stop> {
    let StageKind::Turn(turn) = &story.stages[stage].kind else {
        return Ok(Expr::zero());
    };
    let told = &stages[stage];
    let body = &story.stages[stage].scene.bodies[turn.body];
    let inertia = motion::inertia_about(&story.stages[stage], turn);
    let [r0, r1] = motion::arms(&story.stages[stage], turn);
    let r = if at_end { &r1 } else { &r0 };
    let square = match &told.energy {
        Some([start, end]) => &(&Expr::from(2) * if at_end { end } else { start }) / &inertia,
        None => Expr::zero(),
    };
    let zero = Expr::zero();
    let g = turn.gravity.as_ref().unwrap_or(&zero);
    let applied = match (&turn.torque, turn.clockwise) {
        (Some(t), Some(true)) => -t,
        (Some(t), _) => t.clone(),
        (None, _) => zero.clone(),
    };
    let weight = &body.mass * g;
    let angular = &(&applied - &(&weight * &r[0])) / &inertia;
    let a = [
        -(&(&angular * &r[1])) - &square * &r[0],
        &angular * &r[0] - &square * &r[1],
    ];
    let force = [&body.mass * &a[0], &body.mass * &a[1] + &weight];
    tidy(&dot(&force, along), domains)
}
