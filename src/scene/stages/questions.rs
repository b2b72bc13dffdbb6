//! The questions of a scene with stages: about motion at the end of one, and about all of them.
//!
//! In: the questions as written, and the stages as read. Out: the questions of the [`Story`], in the order of the file.

use std::collections::HashMap;

use super::kind::TIME;
use super::stage_named;
use crate::scene::fault::Fault;
use crate::scene::formulas::{Quantity, Symbols};
use crate::scene::question_file::QuestionFile;
use crate::scene::record::Text;
use crate::scene::resolve::Resolver;
use crate::scene::stage::Story;
use crate::scene::stage_file::{EndName, StageFile};
use crate::scene::{Ask, Question, Scene, question, special, told};

const STIFFNESS: Quantity =
    Quantity::other([1, 0, -2], "a stiffness is a force divided by a length");

/// All questions, in the order of the file.
pub(super) fn read(
    base: &mut Resolver<'_>,
    scene: &Scene,
    story: &mut Story,
    homes: &HashMap<usize, usize>,
) {
    let file = base.file;
    let Some(stages) = &file.stages else { return };
    let mut names: Vec<String> = Vec::new();
    for (k, (name, entry)) in file.questions.iter().flat_map(|m| &m.0).enumerate() {
        let Some(q) = entry else { continue };
        question::name_is_free(base, name, Some(q));
        let ask = match homes.get(&k) {
            Some(stage) => {
                let mut own = story.stages[*stage].scene.questions.iter();
                let found = own.find(|s| s.name == name.text);
                found.map(|q| (Some(*stage), q.ask.clone()))
            }
            None => special::with_names(base, &names, |base, symbols| match &q.inertia {
                Some(_) => told::inertia(base, scene, name, q).map(|formula| {
                    let meaning = told::meaning(q);
                    let with = Vec::new();
                    (
                        None,
                        Ask::Value {
                            formula,
                            with,
                            meaning,
                        },
                    )
                }),
                None => story_ask(base, symbols, stages, name, q),
            }),
        };
        if let Some((stage, ask)) = ask {
            let latex = q.latex.as_ref().map(|t| t.text.clone());
            story.questions.push(Question {
                stage,
                ..Question::new(&name.text, latex, ask)
            });
        }
        if told::is_own(name, Some(q)) {
            continue;
        }
        for suffix in ["", "_x", "_y"] {
            names.push(format!("{}{suffix}", name.text));
        }
    }
}

fn story_ask(
    base: &mut Resolver<'_>,
    symbols: &Symbols,
    stages: &[StageFile],
    name: &Text,
    q: &QuestionFile,
) -> Option<(Option<usize>, Ask)> {
    let kinds = special::asked(q).map(|(kind, given, _)| (kind, given));
    let angular = ("angular_momentum", q.angular_momentum.is_some());
    let kinds: Vec<_> = kinds
        .into_iter()
        .chain(question::about_stage(q))
        .chain([angular])
        .collect();
    let asked: Vec<&str> = kinds.iter().filter(|k| k.1).map(|k| k.0).collect();
    if let Some((kind, _)) = told::kinds(q).into_iter().find(|k| k.1) {
        let fault = Fault::new(
            name.span,
            format!("`{kind}` is asked of a scene without stages"),
        );
        base.faults.push(fault.hint(
            "ask for the velocity `at` that stage, and for a `value` of it, such as \"sqrt(v_x^2 + v_y^2)\"",
        ));
        return None;
    }
    if asked.len() != 1 {
        let all: Vec<&str> = kinds.iter().map(|k| k.0).collect();
        let hint = format!(
            "give one of velocity, spin, impulse, energy, {}",
            all.join(", ")
        );
        let fault = Fault::new(name.span, question::things_asked(&asked));
        base.faults.push(fault.hint(hint));
        return None;
    }
    let at_end = q.when != Some(EndName::Start);
    if special::is_asked(q) {
        return Some((None, special::ask(base, symbols, name, q)?));
    }
    if let Some(stage) = &q.reaction {
        let i = stage_named(&mut base.faults, stages, Some(stage))?;
        if stages[i].turn.is_none() {
            base.faults.push(Fault::new(
                stage.span,
                "a reaction is asked of a stage in which a body turns about a point",
            ));
            return None;
        }
        let Some(along) = &q.along else {
            base.faults.push(Fault::new(
                name.span,
                "a reaction needs the direction `along` which it is asked",
            ));
            return None;
        };
        let along = base.direction(along)?;
        return Some((Some(i), Ask::Reaction { along, at_end }));
    }
    if let Some(stage) = q.time.as_ref().or(q.distance.as_ref()) {
        let i = stage_named(&mut base.faults, stages, Some(stage))?;
        let (what, hint, fits) = match q.time {
            Some(_) => ("time", "an impact takes none", stages[i].impact.is_none()),
            None => (
                "distance",
                "a distance is that of a `slide`; elsewhere ask for the `position` of a body",
                stages[i].slide.is_some(),
            ),
        };
        if !fits {
            let message = format!("no {what} can be asked of the stage `{}`", stage.text);
            base.faults.push(Fault::new(stage.span, message).hint(hint));
            return None;
        }
        let ask = q.time.as_ref().map_or(Ask::Distance, |_| Ask::Time);
        return Some((Some(i), ask));
    }
    if let Some(body) = &q.position {
        let i = stage_named(&mut base.faults, stages, q.at.as_ref())?;
        let along = q.along.as_ref();
        let ask = Ask::Position {
            body: base.moving(body)?,
            along: along
                .map(|d| base.direction(d).ok_or(()))
                .transpose()
                .ok()?,
            at_end,
        };
        return Some((Some(i), ask));
    }
    if let Some(body) = &q.angular_momentum {
        let i = stage_named(&mut base.faults, stages, q.at.as_ref())?;
        let Some(about) = &q.about else {
            base.faults.push(Fault::new(
                name.span,
                "an angular momentum needs the point `about` which it is meant",
            ));
            return None;
        };
        let ask = Ask::AngularMomentum {
            body: base.moving(body)?,
            about: base.position(about)?,
            at_end,
        };
        return Some((Some(i), ask));
    }
    if let Some(share) = &q.share {
        let ask = Ask::Share {
            mass: symbols.read(&share.mass, Quantity::MASS, &mut base.faults)?,
            stiffness: symbols.read(&share.stiffness, STIFFNESS, &mut base.faults)?,
            during: symbols.read(&share.during, TIME, &mut base.faults)?,
        };
        return Some((None, ask));
    }
    if let Some(words) = &q.remark {
        return Some((None, Ask::Remark(words.text.clone())));
    }
    let in_words = [
        (&q.impulsive, Ask::Impulsive),
        (&q.describe, Ask::Describe),
        (&q.missing, Ask::Missing),
    ];
    if let Some((stage, ask)) = in_words.into_iter().find(|(stage, _)| stage.is_some()) {
        let stage = stage_named(&mut base.faults, stages, stage.as_ref())?;
        return Some((Some(stage), ask));
    }
    if let Some(of) = &q.unused {
        let names = symbols
            .names()
            .declared()
            .iter()
            .map(|d| d.name.to_string());
        if !names.clone().any(|n| n == of.text)
            || special::parameter_names(base.file).contains(&of.text.as_str())
        {
            base.faults.push(Fault::new(
                of.span,
                format!("no earlier answer is called `{}`", of.text),
            ));
            return None;
        }
        return Some((None, Ask::Unused(of.text.clone())));
    }
    Some((None, Ask::Assumed))
}
