//! Questions about stages: forces, times, ways, places, and what happens in words.

use super::{answers, impact, told, turn, velocity_asked};
use crate::scene::fault::Fault;
use crate::scene::formulas::{Quantity, Symbols};
use crate::scene::meanwhile::home;
use crate::scene::place_file::PositionFile;
use crate::scene::question_file::QuestionFile;
use crate::scene::record::Text;
use crate::scene::resolver::Resolver;
use crate::scene::stage_file::stage_named;
use crate::scene::stage_file::{EndName, SlideFile, StageFile, TurnFile};
use crate::scene::{Ask, Scene};

/// Reads a question about a stage, or about all of them; with the index of that stage.
pub(super) fn ask(
    base: &mut Resolver<'_>,
    symbols: &Symbols,
    scene: &Scene,
    name: &Text,
    q: &QuestionFile,
) -> Option<(Option<usize>, Ask)> {
    let asked = base.file.questions.iter().flat_map(|m| &m.0);
    let before = asked.take_while(|(other, _)| other.text != name.text);
    let whole = velocity_asked(before, q).map_or("", |found| &found.text);
    let velocity = || told::parts_of(whole);
    let told = match (&q.speed, &q.direction, &q.inertia) {
        (Some(_), ..) => Some(("speed", told::size(&velocity()), None)),
        (_, Some(_), _) => {
            let (angle, polar) = told::direction(velocity(), q.clockwise == Some(true));
            Some(("direction", angle, Some(polar)))
        }
        (.., Some(_)) => Some(("inertia", told::inertia(base, scene, name, q)?, None)),
        _ => None,
    };
    if let Some((kind, formula, polar)) = told {
        let ask = Ask::Value {
            formula,
            with: Vec::new(),
            meaning: told::meaning(q, base.file.stages.as_deref().unwrap_or_default()),
            dimension: Some(told::dimension(kind)),
            polar,
        };
        return Some((None, ask));
    }
    let stages = base.file.stages.as_deref()?;
    let named = [&q.reaction, &q.time, &q.distance]
        .into_iter()
        .chain([&q.impulsive, &q.describe, &q.missing])
        .find_map(Option::as_ref);
    let of_body = [
        &q.acceleration,
        &q.tension,
        &q.angular_acceleration,
        &q.angle,
    ]
    .into_iter()
    .chain([&q.position, &q.angular_momentum])
    .find_map(Option::as_ref);
    let Some(subject) = named.or(of_body) else {
        let ask = match &q.turn {
            Some(number) => turn::ask(base, symbols, scene, number, q),
            None => of_all(base, symbols, q),
        };
        return Some((None, ask?));
    };
    let stage = if of_body.is_some() {
        q.at.as_ref()
    } else {
        named
    };
    let i = home(stages, stage_named(&mut base.faults, stages, stage)?, q);
    let mut asked = Asked {
        base,
        stage: &stages[i],
        name,
        subject,
        q,
    };
    let ask = match q {
        _ if q.reaction.is_some() => asked.reaction(),
        _ if q.time.is_some() || q.distance.is_some() => asked.passed(),
        _ if q.acceleration.is_some() && asked.stage.slide.is_none() => {
            asked.point_acceleration(scene)
        }
        _ if q.acceleration.is_some() || q.tension.is_some() => asked.driven(),
        _ if q.angular_acceleration.is_some() => asked.angular_acceleration(),
        _ if q.angle.is_some() => asked.angle(),
        _ if q.position.is_some() => asked.position(),
        _ if q.angular_momentum.is_some() => asked.angular_momentum(),
        _ if q.impulsive.is_some() => Some(Ask::Impulsive),
        _ if q.describe.is_some() => Some(Ask::Describe),
        _ => Some(Ask::Missing),
    };
    Some((Some(i), ask?))
}

/// A question about one stage.
struct Asked<'a, 'f> {
    base: &'a mut Resolver<'f>,
    stage: &'a StageFile,
    name: &'a Text,
    /// The body or the stage that it names first.
    subject: &'a Text,
    q: &'a QuestionFile,
}

impl Asked<'_, '_> {
    /// Whether it is asked for the end of the stage.
    fn at_end(&self) -> bool {
        self.q.when != Some(EndName::Start)
    }

    fn clockwise(&self) -> bool {
        self.q.clockwise == Some(true)
    }

    fn lacks(&mut self, message: &str) -> Option<Ask> {
        Fault::new(self.name.span, message).add_to(&mut self.base.faults)
    }

    /// The stage is not of the kind of which this can be asked.
    fn unfit(&mut self, message: &str, hint: &str) -> Option<Ask> {
        let fault = Fault::new(self.subject.span, message).hint(hint);
        fault.add_to(&mut self.base.faults)
    }

    fn reaction(&mut self) -> Option<Ask> {
        let by_itself = |slide: &SlideFile| {
            slide.on.is_none() && slide.strings.is_none() && slide.spring.is_none()
        };
        if self.stage.turn.is_none() && !self.stage.slide.as_ref().is_some_and(by_itself) {
            let message = "no reaction can be asked of this stage";
            let hint = "it is the force of the point about which a body turns, or of the surface on what slides or rolls by itself, without a spring, strings or a body below";
            return self.unfit(message, hint);
        }
        let Some(along) = &self.q.along else {
            return self.lacks("a reaction needs the direction `along` which it is asked");
        };
        let along = self.base.direction(along)?;
        let at_end = self.at_end();
        Some(Ask::Reaction { along, at_end })
    }

    /// The time that a stage takes, or the distance that a body goes in it.
    fn passed(&mut self) -> Option<Ask> {
        let flies = self.stage.fall.as_ref();
        let (ask, what, hint, fits) = match self.q.time {
            Some(_) => (
                Ask::Time,
                "time",
                "an impact takes none",
                self.stage.impact.is_none(),
            ),
            None => (
                Ask::Distance,
                "distance",
                "a distance is that of a `slide`, or of a `fall` without gravity; elsewhere ask for the `position` of a body",
                self.stage.slide.is_some() || flies.is_some_and(|fall| fall.gravity.is_none()),
            ),
        };
        if !fits {
            let stage = &self.subject.text;
            let message = format!("no {what} can be asked of the stage `{stage}`");
            return self.unfit(&message, hint);
        }
        Some(ask)
    }

    /// The acceleration of a body that slides, or the tension of its string.
    fn driven(&mut self) -> Option<Ask> {
        let name = &self.subject.text;
        let body = self.base.moving(self.subject)?;
        let is_it = |b: &Text| b.text == *name;
        let slide = self.stage.slide.as_ref();
        let strings = slide.and_then(|slide| slide.strings.as_deref());
        let strings = strings.unwrap_or_default();
        let strung = strings.iter().flat_map(|s| &s.to).any(is_it);
        let slides = slide.is_some_and(|slide| {
            let on = slide.on.iter();
            let below = on.flat_map(|on| on.with.iter().flatten().chain([&on.body]));
            let mut with = slide.with.iter().flatten().chain(below);
            is_it(&slide.body) || with.any(is_it)
        });
        let (ask, what, hint, fits) = match self.q.tension {
            Some(_) => (
                Ask::Tension { body },
                "tension",
                "a tension is that of a body on one of the `strings` of a `slide`",
                strung || slides && !strings.is_empty(),
            ),
            None => (
                Ask::Acceleration {
                    body,
                    at_end: self.at_end(),
                },
                "acceleration",
                "in a `slide` it is that of a body which moves, along its own way, without `of` and `along`; what sticks to it and is asked of stands in `with`",
                (strung || slides) && self.q.of.is_none() && self.q.along.is_none(),
            ),
        };
        if !fits {
            let message = format!("no {what} of `{name}` can be asked of this stage");
            return self.unfit(&message, hint);
        }
        Some(ask)
    }

    /// The acceleration of a body, or of a point of it, in a rotation or a linkage.
    fn point_acceleration(&mut self, scene: &Scene) -> Option<Ask> {
        let (body, point) = impact::velocity(self.base, scene, self.subject, self.q.of.as_ref())?;
        let is_it = |b: &Text| b.text == scene.bodies[body].name;
        let turns = |turn: &TurnFile| is_it(&turn.body) || turn.with.iter().flatten().any(is_it);
        if !self.stage.turn.as_ref().is_some_and(turns) && self.stage.linkage.is_none() {
            let name = &scene.bodies[body].name;
            let message = format!("no acceleration of `{name}` can be asked of this stage");
            let hint =
                "an acceleration is that of a body which a `slide`, a `turn` or a `linkage` moves";
            return self.unfit(&message, hint);
        }
        let Some(along) = &self.q.along else {
            return self.lacks(
                "an acceleration in this stage needs the direction `along` which it is asked",
            );
        };
        Some(Ask::PointAcceleration {
            body,
            point: point.map(|(name, _)| name),
            along: self.base.direction(along)?,
            at_end: self.at_end(),
        })
    }

    fn angular_acceleration(&mut self) -> Option<Ask> {
        let name = &self.subject.text;
        let body = self.base.moving(self.subject)?;
        let is_it = |b: &Text| b.text == *name;
        let turns = |turn: &TurnFile| is_it(&turn.body) || turn.with.iter().flatten().any(is_it);
        let fits = self.stage.turn.as_ref().is_some_and(turns) || self.stage.linkage.is_some();
        if !fits || self.base.is_particle(body) {
            let message = format!("no angular acceleration of `{name}` can be asked of this stage");
            let hint = "an angular acceleration is that of a body with a spin which a `turn` or a `linkage` moves";
            return self.unfit(&message, hint);
        }
        Some(Ask::AngularAcceleration {
            body,
            clockwise: self.clockwise(),
            at_end: self.at_end(),
        })
    }

    fn angle(&mut self) -> Option<Ask> {
        if self.stage.impact.is_some() {
            let hint = "name the motion in which it turns with `at`";
            return self.unfit("a body keeps its angle in an impact", hint);
        }
        let body = self.base.moving(self.subject)?;
        if self.stage.turn.is_none() && self.stage.linkage.is_none() && self.base.is_particle(body)
        {
            let message = format!(
                "the particle `{}` has no angle of its own",
                self.subject.text
            );
            let hint = "that of its path is asked as `direction`";
            return self.unfit(&message, hint);
        }
        let clockwise = self.clockwise();
        Some(Ask::Angle { body, clockwise })
    }

    fn position(&mut self) -> Option<Ask> {
        Some(Ask::Position {
            body: self.base.moving(self.subject)?,
            along: match &self.q.along {
                Some(along) => Some(self.base.direction(along)?),
                None => None,
            },
            at_end: self.at_end(),
        })
    }

    fn angular_momentum(&mut self) -> Option<Ask> {
        let Some(about) = &self.q.about else {
            return self.lacks("an angular momentum needs the point `about` which it is meant");
        };
        let center_of = match about {
            PositionFile::Name(name) if self.base.find_point(&name.text).is_none() => {
                self.base.find_body(&name.text)
            }
            _ => None,
        };
        Some(Ask::AngularMomentum {
            body: self.base.moving(self.subject)?,
            about: self.base.position(about)?,
            center_of,
            at_end: self.at_end(),
        })
    }
}

/// A question about the scene as a whole.
fn of_all(base: &mut Resolver<'_>, symbols: &Symbols, q: &QuestionFile) -> Option<Ask> {
    if let Some(share) = &q.share {
        return Some(Ask::Share {
            mass: symbols.read(&share.mass, Quantity::MASS, &mut base.faults)?,
            stiffness: symbols.read(&share.stiffness, Quantity::STIFFNESS, &mut base.faults)?,
            during: symbols.read(&share.during, Quantity::TIME, &mut base.faults)?,
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
