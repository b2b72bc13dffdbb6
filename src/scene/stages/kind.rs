//! What one stage does, an impact or a motion.
//!
//! In: the record of a stage and the scene it begins with. Out: a [`StageKind`].

use crate::expr::Expr;
use crate::scene::Scene;
use crate::scene::fault::{Fault, Span};
use crate::scene::formulas::Quantity;
use crate::scene::place_file::PositionFile;
use crate::scene::record::Formula;
use crate::scene::resolve::Resolver;
use crate::scene::stage::{Fall, FallEnd, OneSided, Slide, StageKind, Turn, Until, Wind};
use crate::scene::stage_file::{FallFile, ImpactFile, StageFile, TurnFile, UntilName};

pub(super) const TIME: Quantity =
    Quantity::other([0, 0, 1], "a time, such as t, or a number of seconds");
const ACCELERATION: Quantity = Quantity::other(
    [0, 1, -2],
    "gravity is a length per time squared, such as g",
);
const MOMENT: Quantity = Quantity::other([1, 2, -2], "a moment is a force times a length");
const FORCE: Quantity = Quantity::other([1, 1, -2], "a force is a mass times an acceleration");

pub(super) fn kind(
    r: &mut Resolver<'_>,
    scene: &mut Scene,
    stage: &StageFile,
) -> Option<StageKind> {
    let given = [
        stage.impact.is_some(),
        stage.turn.is_some(),
        stage.slide.is_some(),
        stage.fall.is_some(),
        stage.wind.is_some(),
    ];
    if given.iter().filter(|g| **g).count() != 1 {
        let message = format!(
            "the stage `{}` is one of impact, turn, slide, fall and wind",
            stage.name.text
        );
        let hint =
            "one stage does one thing; what an impact changes is no motion with conserved energy";
        r.faults
            .push(Fault::new(stage.name.span, message).hint(hint));
        return None;
    }
    if let Some(impact) = &stage.impact {
        return impact_of(r, scene, impact, stage.name.span);
    }
    if let Some(turn) = &stage.turn {
        return turn_of(r, turn, stage.name.span).map(StageKind::Turn);
    }
    if let Some(slide) = &stage.slide {
        let body = r.moving(&slide.body);
        let along = r.direction(&slide.along);
        let distance = r
            .symbols
            .read(&slide.distance, Quantity::LENGTH, &mut r.faults);
        return Some(StageKind::Slide(Slide {
            body: body?,
            along: along?,
            distance: distance?,
            gravity: optional(r, slide.gravity.as_ref(), ACCELERATION)?,
            force: optional(r, slide.force.as_ref(), FORCE)?,
        }));
    }
    if let Some(fall) = &stage.fall {
        return fall_of(r, fall, stage.name.span).map(StageKind::Fall);
    }
    let wind = stage.wind.as_ref()?;
    let body = r.moving(&wind.body);
    let around = r.position(&wind.around);
    let to = r.symbols.read(&wind.to, Quantity::LENGTH, &mut r.faults);
    let body = body?;
    if !r.is_particle(body) {
        r.faults.push(Fault::new(
            wind.body.span,
            "what hangs at the end of the rope is a particle here",
        ));
        return None;
    }
    Some(StageKind::Wind(Wind {
        body,
        around: around?,
        to: to?,
    }))
}

/// An optional formula; the outer `None` means that it was given and could not be read.
fn optional(
    r: &mut Resolver<'_>,
    formula: Option<&Formula>,
    quantity: Quantity,
) -> Option<Option<Expr>> {
    match formula {
        None => Some(None),
        Some(f) => r.symbols.read(f, quantity, &mut r.faults).map(Some),
    }
}

fn impact_of(
    r: &mut Resolver<'_>,
    scene: &mut Scene,
    impact: &ImpactFile,
    span: Span,
) -> Option<StageKind> {
    let strings = impact.strings.as_ref().map_or(0, |m| m.0.len());
    let all = strings + impact.supports.as_ref().map_or(0, |m| m.0.len());
    let others = scene.contacts.len().checked_sub(all)?;
    let mut one_sided = Vec::new();
    for (i, contact) in scene.contacts.drain(others..).enumerate() {
        one_sided.push(OneSided {
            name: contact.name,
            bodies: contact.bodies,
            at: contact.at,
            normal: contact.normal?,
            is_string: i >= all - strings,
        });
    }
    if one_sided.len() > 6 {
        r.faults.push(Fault::new(
            span,
            "more than 6 supports and strings in one impact",
        ));
        return None;
    }
    if scene.friction().is_some() {
        let fault = Fault::new(span, "friction is not followed through stages");
        r.faults
            .push(fault.hint("write the impact as a scene of its own, without `stages`"));
        return None;
    }
    let supposed = impact.supposing.as_ref().map(|list| {
        for name in list {
            if !one_sided.iter().any(|o| o.name == name.text) {
                r.faults.push(Fault::new(
                    name.span,
                    format!("there is no support or string `{}`", name.text),
                ));
            }
        }
        list.iter().map(|t| t.text.clone()).collect()
    });
    let touching = scene.contacts.len() + scene.hinges.len() + scene.blows.len() + one_sided.len();
    if touching == 0 && r.faults.is_empty() {
        let fault = Fault::new(span, "nothing collides in this impact");
        r.faults
            .push(fault.hint("give it contacts, hinges, supports, strings or blows"));
        return None;
    }
    Some(StageKind::Impact {
        one_sided,
        supposed,
    })
}

fn fall_of(r: &mut Resolver<'_>, fall: &FallFile, span: Span) -> Option<Fall> {
    let ends = usize::from(fall.height.is_some())
        + usize::from(fall.range.is_some())
        + usize::from(fall.time.is_some());
    if ends != 1 {
        let fault = Fault::new(
            span,
            "a fall ends after a `height`, a horizontal distance `range` or a time `for`",
        );
        r.faults.push(fault.hint("give one of them"));
        return None;
    }
    let body = r.moving(&fall.body);
    let with = fall.with.iter().flatten().map(|name| r.moving(name));
    let with = with.collect::<Option<Vec<usize>>>();
    let gravity = optional(r, fall.gravity.as_ref(), ACCELERATION)?;
    let until = match (&fall.height, &fall.range, &fall.time) {
        (Some(height), ..) => {
            FallEnd::Drop(r.symbols.read(height, Quantity::LENGTH, &mut r.faults)?)
        }
        (_, Some(range), _) => {
            FallEnd::Range(r.symbols.read(range, Quantity::LENGTH, &mut r.faults)?)
        }
        (.., Some(time)) => FallEnd::Time(r.symbols.read(time, TIME, &mut r.faults)?),
        _ => return None,
    };
    Some(Fall {
        body: body?,
        with: with?,
        gravity,
        until,
    })
}

fn turn_of(r: &mut Resolver<'_>, turn: &TurnFile, span: Span) -> Option<Turn> {
    let ends = usize::from(turn.by.is_some())
        + usize::from(turn.until.is_some())
        + usize::from(turn.time.is_some());
    if ends != 1 {
        let fault = Fault::new(
            span,
            "a rotation ends after an angle `by`, at a place `until`, or after a time `for`",
        );
        r.faults.push(fault.hint("give one of them"));
        return None;
    }
    if let (Some(time), true) = (&turn.time, turn.gravity.is_some()) {
        let fault = Fault::new(
            time.span,
            "a rotation under its weight ends at an angle, not after a time",
        );
        r.faults
            .push(fault.hint("where it is after a time has no closed form; give `by` or `until`"));
        return None;
    }
    let body = r.moving(&turn.body);
    let with = turn.with.iter().flatten().map(|name| r.moving(name));
    let with = with.collect::<Option<Vec<usize>>>()?;
    let about = r.position(&turn.about);
    let about_name = match &turn.about {
        PositionFile::Name(name) => name.text.clone(),
        _ => String::from("the fixed point"),
    };
    let until = match (&turn.by, turn.until, &turn.time) {
        (Some(by), ..) => Until::By(r.symbols.read(by, Quantity::ANGLE, &mut r.faults)?),
        (_, Some(UntilName::Above), _) => Until::Above,
        (_, Some(UntilName::Below), _) => Until::Below,
        (_, _, Some(time)) => Until::For(r.symbols.read(time, TIME, &mut r.faults)?),
        _ => return None,
    };
    Some(Turn {
        body: body?,
        with,
        about: about?,
        about_name,
        until,
        clockwise: turn.clockwise,
        gravity: optional(r, turn.gravity.as_ref(), ACCELERATION)?,
        torque: optional(r, turn.torque.as_ref(), MOMENT)?,
    })
}
