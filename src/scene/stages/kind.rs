//! What one stage does, an impact or a motion, and where the bodies are at its end.
//!
//! In: the record of a stage and the scene it begins with. Out: a [`StageKind`]; places after a motion follow from geometry.

use super::Placed;
use crate::expr::{Expr, dot, minus};
use crate::scene::fault::{Fault, Span};
use crate::scene::file::PositionFile;
use crate::scene::formulas::Quantity;
use crate::scene::record::Formula;
use crate::scene::resolve::Resolver;
use crate::scene::stage::{Fall, OneSided, Slide, StageKind, Turn, Until, Wind};
use crate::scene::stage_file::{ImpactFile, StageFile, TurnFile, UntilName};
use crate::scene::{Scene, geometry};

pub(super) const TIME: Quantity =
    Quantity::other([0, 0, 1], "a time, such as t, or a number of seconds");
const ACCELERATION: Quantity = Quantity::other(
    [0, 1, -2],
    "gravity is a length per time squared, such as g",
);
const MOMENT: Quantity = Quantity::other([1, 2, -2], "a moment is a force times a length");
const FORCE: Quantity = Quantity::other([1, 1, -2], "a force is a mass times an acceleration");

/// Where all bodies are at the end of a stage.
pub(super) fn placed_after(scene: &Scene, kind: &StageKind) -> Vec<Placed> {
    let mut all: Vec<Placed> = scene
        .bodies
        .iter()
        .map(|b| (b.center.clone(), b.angle.clone()))
        .collect();
    match kind {
        StageKind::Impact { .. } => {}
        StageKind::Turn(turn) => {
            let lump = minus(&turn.lump(scene).center, &turn.about);
            let length = dot(&lump, &lump).sqrt();
            let alone = turn.with.is_empty();
            for body in turn.bodies() {
                let (center, angle) = &mut all[body];
                let r = minus(center, &turn.about);
                let [c, s] = match &turn.until {
                    Until::By(by) => {
                        let by = if turn.clockwise == Some(true) {
                            -by
                        } else {
                            by.clone()
                        };
                        *angle = &*angle + &by;
                        geometry::direction(&by)
                    }
                    Until::Above if alone => {
                        *center = [turn.about[0].clone(), &turn.about[1] + &length];
                        continue;
                    }
                    Until::Below if alone => {
                        *center = [turn.about[0].clone(), &turn.about[1] - &length];
                        continue;
                    }
                    Until::Above => [&lump[1] / &length, &lump[0] / &length],
                    Until::Below => [-(&lump[1] / &length), -(&lump[0] / &length)],
                    Until::For(_) => continue,
                };
                let x = &(&r[0] * &c) - &(&r[1] * &s);
                let y = &(&r[0] * &s) + &(&r[1] * &c);
                *center = [&turn.about[0] + &x, &turn.about[1] + &y];
            }
        }
        StageKind::Slide(slide) => {
            let center = &mut all[slide.body].0;
            for (coordinate, along) in center.iter_mut().zip(&slide.along) {
                *coordinate = &*coordinate + &(along * &slide.distance);
            }
        }
        StageKind::Fall(fall) => {
            if let Some(height) = &fall.height {
                let center = &mut all[fall.body].0;
                center[1] = &center[1] - height;
            }
        }
        StageKind::Wind(wind) => {
            all[wind.body].0 = [&wind.around[0] + &wind.to, wind.around[1].clone()];
        }
    }
    all
}

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
        if fall.height.is_some() == fall.time.is_some() {
            let fault = Fault::new(
                stage.name.span,
                "a fall ends after a `height` or after a time `for`",
            );
            r.faults.push(fault.hint("give one of them"));
            return None;
        }
        let body = r.moving(&fall.body);
        return Some(StageKind::Fall(Fall {
            body: body?,
            gravity: optional(r, fall.gravity.as_ref(), ACCELERATION)?,
            height: optional(r, fall.height.as_ref(), Quantity::LENGTH)?,
            time: optional(r, fall.time.as_ref(), TIME)?,
        }));
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
    if let (Some(time), true) = (&turn.time, turn.gravity.is_some() || turn.torque.is_some()) {
        let fault = Fault::new(
            time.span,
            "a rotation with a moment ends at an angle, not after a time",
        );
        r.faults
            .push(fault.hint("energy connects places, not times; give `by` or `until`"));
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
