//! Questions about stages: forces, times, ways, places, and what happens in words.

use super::{answers, told};
use crate::scene::fault::Fault;
use crate::scene::formulas::{Quantity, Symbols};
use crate::scene::question_file::QuestionFile;
use crate::scene::record::Text;
use crate::scene::resolve::Resolver;
use crate::scene::stage_file::{EndName, StageFile, TurnFile};
use crate::scene::stages::{TIME, stage_named};
use crate::scene::{Ask, Scene};

const STIFFNESS: Quantity =
    Quantity::other([1, 0, -2], "a stiffness is a force divided by a length");

/// Reads a question about a stage, or about all of them; with the index of that stage.
pub(super) fn ask(
    base: &mut Resolver<'_>,
    symbols: &Symbols,
    scene: &Scene,
    name: &Text,
    q: &QuestionFile,
) -> Option<(Option<usize>, Ask)> {
    let told = match (&q.speed, &q.inertia) {
        (Some(_), _) => Some(told::speed_of(&format!("{}_velocity", name.text))),
        (_, Some(_)) => Some(told::inertia(base, scene, name, q)?),
        _ => None,
    };
    if let Some(formula) = told {
        let ask = Ask::Value {
            formula,
            with: Vec::new(),
            meaning: told::meaning(q),
        };
        return Some((None, ask));
    }
    let stages = base.file.stages.as_deref()?;
    let at_stage = if let Some(stage) = &q.reaction {
        reaction(base, stages, name, q, stage)
    } else if let Some(stage) = q.time.as_ref().or(q.distance.as_ref()) {
        passed(base, stages, q, stage)
    } else if let Some(body) = q.acceleration.as_ref().or(q.tension.as_ref()) {
        driven(base, stages, q, body)
    } else if let Some(body) = &q.angular_acceleration {
        angular_acceleration(base, stages, q, body)
    } else if let Some(body) = &q.angle {
        angle(base, stages, q, body)
    } else if let Some(body) = &q.position {
        position(base, stages, q, body)
    } else if let Some(body) = &q.angular_momentum {
        angular_momentum(base, stages, name, q, body)
    } else {
        let in_words = [
            (&q.impulsive, Ask::Impulsive),
            (&q.describe, Ask::Describe),
            (&q.missing, Ask::Missing),
        ];
        let Some((stage, ask)) = in_words.into_iter().find(|(stage, _)| stage.is_some()) else {
            return Some((None, of_all(base, symbols, q)?));
        };
        let stage = stage_named(&mut base.faults, stages, stage.as_ref())?;
        return Some((Some(stage), ask));
    };
    at_stage.map(|(stage, ask)| (Some(stage), ask))
}

/// Whether it is asked for the end of a stage.
fn at_end(q: &QuestionFile) -> bool {
    q.when != Some(EndName::Start)
}

fn reaction(
    base: &mut Resolver<'_>,
    stages: &[StageFile],
    name: &Text,
    q: &QuestionFile,
    stage: &Text,
) -> Option<(usize, Ask)> {
    let i = stage_named(&mut base.faults, stages, Some(stage))?;
    if stages[i].turn.is_none() {
        let message = "a reaction is asked of a stage in which a body turns about a point";
        return Fault::new(stage.span, message).add_to(&mut base.faults);
    }
    let Some(along) = &q.along else {
        let message = "a reaction needs the direction `along` which it is asked";
        return Fault::new(name.span, message).add_to(&mut base.faults);
    };
    let along = base.direction(along)?;
    let at_end = at_end(q);
    Some((i, Ask::Reaction { along, at_end }))
}

/// The time that a stage takes, or the distance that a body goes in it.
fn passed(
    base: &mut Resolver<'_>,
    stages: &[StageFile],
    q: &QuestionFile,
    stage: &Text,
) -> Option<(usize, Ask)> {
    let i = stage_named(&mut base.faults, stages, Some(stage))?;
    let (ask, what, hint, fits) = match q.time {
        Some(_) => (
            Ask::Time,
            "time",
            "an impact takes none",
            stages[i].impact.is_none(),
        ),
        None => (
            Ask::Distance,
            "distance",
            "a distance is that of a `slide`; elsewhere ask for the `position` of a body",
            stages[i].slide.is_some(),
        ),
    };
    if !fits {
        let message = format!("no {what} can be asked of the stage `{}`", stage.text);
        let fault = Fault::new(stage.span, message).hint(hint);
        return fault.add_to(&mut base.faults);
    }
    Some((i, ask))
}

/// The acceleration of a body that slides, or the tension of its string.
fn driven(
    base: &mut Resolver<'_>,
    stages: &[StageFile],
    q: &QuestionFile,
    name: &Text,
) -> Option<(usize, Ask)> {
    let i = stage_named(&mut base.faults, stages, q.at.as_ref())?;
    let body = base.moving(name)?;
    let is_it = |b: &Text| b.text == name.text;
    let slide = stages[i].slide.as_ref();
    let strings = slide.and_then(|slide| slide.strings.as_deref());
    let strings = strings.unwrap_or_default();
    let strung = strings.iter().flat_map(|s| &s.to).any(is_it);
    let slides = slide.is_some_and(|slide| {
        let with = slide.with.iter().flatten();
        is_it(&slide.body) || with.into_iter().any(is_it)
    });
    let (ask, what, hint, fits) = match q.tension {
        Some(_) => (
            Ask::Tension { body },
            "tension",
            "a tension is that of a body on one of the `strings` of a `slide`",
            strung || slides && !strings.is_empty(),
        ),
        None => (
            Ask::Acceleration { body },
            "acceleration",
            "an acceleration is that of a body which a `slide` moves",
            strung || slides,
        ),
    };
    if !fits {
        let message = format!("no {what} of `{}` can be asked of this stage", name.text);
        let fault = Fault::new(name.span, message).hint(hint);
        return fault.add_to(&mut base.faults);
    }
    Some((i, ask))
}

fn angular_acceleration(
    base: &mut Resolver<'_>,
    stages: &[StageFile],
    q: &QuestionFile,
    name: &Text,
) -> Option<(usize, Ask)> {
    let i = stage_named(&mut base.faults, stages, q.at.as_ref())?;
    let body = base.moving(name)?;
    let is_it = |b: &Text| b.text == name.text;
    let turns = |turn: &TurnFile| is_it(&turn.body) || turn.with.iter().flatten().any(is_it);
    let fits = stages[i].turn.as_ref().is_some_and(turns) || stages[i].linkage.is_some();
    if !fits || base.is_particle(body) {
        let message = format!(
            "no angular acceleration of `{}` can be asked of this stage",
            name.text
        );
        let hint = "an angular acceleration is that of a body with a spin which a `turn` or a `linkage` moves";
        let fault = Fault::new(name.span, message).hint(hint);
        return fault.add_to(&mut base.faults);
    }
    let ask = Ask::AngularAcceleration {
        body,
        clockwise: q.clockwise == Some(true),
        at_end: at_end(q),
    };
    Some((i, ask))
}

fn angle(
    base: &mut Resolver<'_>,
    stages: &[StageFile],
    q: &QuestionFile,
    body: &Text,
) -> Option<(usize, Ask)> {
    let i = stage_named(&mut base.faults, stages, q.at.as_ref())?;
    if stages[i].impact.is_some() {
        let fault = Fault::new(body.span, "a body keeps its angle in an impact");
        let fault = fault.hint("name the motion in which it turns with `at`");
        return fault.add_to(&mut base.faults);
    }
    let body = base.moving(body)?;
    let clockwise = q.clockwise == Some(true);
    Some((i, Ask::Angle { body, clockwise }))
}

fn position(
    base: &mut Resolver<'_>,
    stages: &[StageFile],
    q: &QuestionFile,
    body: &Text,
) -> Option<(usize, Ask)> {
    let i = stage_named(&mut base.faults, stages, q.at.as_ref())?;
    let body = base.moving(body)?;
    let along = match &q.along {
        Some(along) => Some(base.direction(along)?),
        None => None,
    };
    let at_end = at_end(q);
    Some((
        i,
        Ask::Position {
            body,
            along,
            at_end,
        },
    ))
}

fn angular_momentum(
    base: &mut Resolver<'_>,
    stages: &[StageFile],
    name: &Text,
    q: &QuestionFile,
    body: &Text,
) -> Option<(usize, Ask)> {
    let i = stage_named(&mut base.faults, stages, q.at.as_ref())?;
    let Some(about) = &q.about else {
        let message = "an angular momentum needs the point `about` which it is meant";
        return Fault::new(name.span, message).add_to(&mut base.faults);
    };
    let ask = Ask::AngularMomentum {
        body: base.moving(body)?,
        about: base.position(about)?,
        at_end: at_end(q),
    };
    Some((i, ask))
}

/// A question about the scene as a whole.
fn of_all(base: &mut Resolver<'_>, symbols: &Symbols, q: &QuestionFile) -> Option<Ask> {
    if let Some(share) = &q.share {
        return Some(Ask::Share {
            mass: symbols.read(&share.mass, Quantity::MASS, &mut base.faults)?,
            stiffness: symbols.read(&share.stiffness, STIFFNESS, &mut base.faults)?,
            during: symbols.read(&share.during, TIME, &mut base.faults)?,
        });
    }
    if let Some(words) = &q.remark {
        return Some(Ask::Remark(words.text.clone()));
    }
    let Some(of) = &q.unused else {
        return Some(Ask::Assumed);
    };
    let mut answers = symbols.names().declared().iter();
    let parameters = answers::parameter_names(base.file);
    if !answers.any(|d| *d.name == *of.text) || parameters.contains(&of.text.as_str()) {
        let message = format!("no earlier answer is called `{}`", of.text);
        return Fault::new(of.span, message).add_to(&mut base.faults);
    }
    Some(Ask::Unused(of.text.clone()))
}
