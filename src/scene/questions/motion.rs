//! Questions about stages: forces, times, ways, places, and what happens in words.

use super::{answers, told};
use crate::scene::fault::Fault;
use crate::scene::formulas::{Quantity, Symbols};
use crate::scene::question_file::QuestionFile;
use crate::scene::record::Text;
use crate::scene::resolve::Resolver;
use crate::scene::stage_file::{EndName, SlideFile};
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
    let at_end = q.when != Some(EndName::Start);
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
    if let Some(name) = q.acceleration.as_ref().or(q.tension.as_ref()) {
        let i = stage_named(&mut base.faults, stages, q.at.as_ref())?;
        let body = base.moving(name)?;
        let (what, hint) = match q.tension {
            Some(_) => (
                "tension",
                "a tension is that of a body on one of the `strings` of a `slide`",
            ),
            None => (
                "acceleration",
                "an acceleration is that of a body which a `slide` moves",
            ),
        };
        let ask = match q.tension {
            Some(_) => Ask::Tension { body },
            None => Ask::Acceleration { body },
        };
        let slide = stages[i].slide.as_ref();
        let strung = |slide: &SlideFile| {
            slide
                .strings
                .iter()
                .flatten()
                .flat_map(|s| &s.to)
                .any(|b| b.text == name.text)
        };
        let own = |slide: &SlideFile| {
            slide.body.text == name.text || slide.with.iter().flatten().any(|b| b.text == name.text)
        };
        let fits = slide.is_some_and(|slide| {
            let has_strings = slide.strings.as_ref().is_some_and(|s| !s.is_empty());
            strung(slide) || own(slide) && (q.tension.is_none() || has_strings)
        });
        if !fits {
            let message = format!("no {what} of `{}` can be asked of this stage", name.text);
            base.faults.push(Fault::new(name.span, message).hint(hint));
            return None;
        }
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
            || answers::parameter_names(base.file).contains(&of.text.as_str())
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
