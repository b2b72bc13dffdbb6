//! What one stage does, an impact or a motion.
//!
//! In: the record of a stage and the scene it begins with. Out: a [`StageKind`].

use super::fields::{company, one_end, optional, weight};
use super::slide::slide;
use crate::expr::Expr;
use crate::scene::Scene;
use crate::scene::fault::{Fault, Span};
use crate::scene::formulas::Quantity;
use crate::scene::motion::{Fall, FallEnd, Linkage, Turn, Until, Wind};
use crate::scene::place_file::PositionFile;
use crate::scene::resolver::Resolver;
use crate::scene::stage::{OneSided, StageKind};
use crate::scene::stage_file::{FallFile, ImpactFile, LinkageFile, StageFile, TurnFile, UntilName};

const TURNED: Quantity = Quantity::other(
    [0, 0, 0],
    "`by` is the angle through which it turns, in radians; a way down is its `height`, a way across its `range`",
);

const MOMENT: Quantity = Quantity::other([1, 2, -2], "a moment is a force times a length");

pub(super) fn kind(
    r: &mut Resolver<'_>,
    scene: &mut Scene,
    stage: &StageFile,
    places: &[[Expr; 3]],
    lasts: Option<&Expr>,
) -> Option<StageKind> {
    let given = [
        stage.impact.is_some(),
        stage.turn.is_some(),
        stage.slide.is_some(),
        stage.fall.is_some(),
        stage.wind.is_some(),
        stage.linkage.is_some(),
    ];
    let given = given.iter().filter(|g| **g).count();
    if given != 1 {
        let message = format!(
            "the stage `{}` has {} of impact, turn, slide, fall, wind and linkage",
            stage.name.text,
            if given == 0 { "none" } else { "more than one" }
        );
        let hint =
            "one stage does one thing; what an impact changes is no motion with conserved energy";
        return r.refuse(stage.name.span, message, hint);
    }
    if let (Some(during), None, None, None) =
        (&stage.during, &stage.turn, &stage.slide, &stage.fall)
    {
        let message =
            "only a fall, a motion along a line or a rotation happens during another motion";
        let hint = "leave out `during`: the stage then begins where the one before ends";
        return r.refuse(during.span, message, hint);
    }
    if let Some(impact) = &stage.impact {
        return impact_of(r, scene, impact, impact.span.opening());
    }
    if let Some(turn) = &stage.turn {
        return turn_of(r, turn, lasts).map(StageKind::Turn);
    }
    if let Some(sliding) = &stage.slide {
        return slide(r, scene, sliding, lasts).map(StageKind::Slide);
    }
    if let Some(fall) = &stage.fall {
        return fall_of(r, fall, lasts).map(StageKind::Fall);
    }
    if let Some(linkage) = &stage.linkage {
        return linkage_of(r, scene, linkage, places).map(StageKind::Linkage);
    }
    let wind = stage.wind.as_ref()?;
    let body = r.moving(&wind.body);
    let around = r.position(&wind.around);
    let to = r.read(&wind.to, Quantity::LENGTH);
    let body = body?;
    if !r.is_particle(body) {
        return Fault::new(
            wind.body.span,
            "what hangs at the end of the rope is a particle here",
        )
        .add_to(&mut r.faults);
    }
    Some(StageKind::Wind(Wind {
        body,
        around: around?,
        to: to?,
    }))
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
        return Fault::new(span, "more than 6 supports and strings in one impact")
            .add_to(&mut r.faults);
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
        let message = "nothing collides in this impact";
        let hint = "give it contacts, hinges, supports, strings or blows";
        return r.refuse(span, message, hint);
    }
    Some(StageKind::Impact {
        one_sided,
        supposed,
    })
}

fn fall_of(r: &mut Resolver<'_>, fall: &FallFile, lasts: Option<&Expr>) -> Option<Fall> {
    let span = fall.span.opening();
    let ends = [
        ("height", fall.height.is_some()),
        ("range", fall.range.is_some()),
        ("by", fall.by.is_some()),
        ("for", fall.time.is_some()),
        ("until", fall.until.is_some()),
    ];
    let message = "a fall ends after a `height`, a horizontal distance `range`, an angle `by` or a time `for`, or `until` its top";
    one_end(r, &ends, lasts, (span, message))?;
    let all = company(r, &fall.body, fall.with.as_deref());
    let gravity = weight(r, fall.gravity.as_ref())?;
    let until = match (&fall.height, &fall.range, &fall.by, &fall.time, lasts) {
        (Some(height), ..) => FallEnd::Drop(r.read(height, Quantity::LENGTH)?),
        (_, Some(range), ..) => FallEnd::Range(r.read(range, Quantity::LENGTH)?),
        (_, _, Some(by), ..) => FallEnd::Turned(r.read(by, TURNED)?),
        (.., Some(time), _) => FallEnd::Time(r.read(time, Quantity::TIME)?),
        (.., Some(time)) => FallEnd::Time(time.clone()),
        _ if gravity.is_some() => FallEnd::Top,
        _ => {
            let message = "a flight without gravity has no top";
            return r.refuse(span, message, "add \"gravity\": \"g\"");
        }
    };
    let rising = fall.rising == Some(true);
    if rising && (gravity.is_none() || !matches!(until, FallEnd::Drop(_))) {
        let message = "`rising` tells which of two times at the same height is meant";
        let hint = "it goes with `height` and `gravity`";
        return r.refuse(span, message, hint);
    }
    let (body, with) = all?;
    Some(Fall {
        body,
        with,
        gravity,
        until,
        rising,
        stuck: Vec::new(),
    })
}

fn linkage_of(
    r: &mut Resolver<'_>,
    scene: &Scene,
    linkage: &LinkageFile,
    places: &[[Expr; 3]],
) -> Option<Linkage> {
    const LENGTH: Quantity = Quantity::other([0, 1, 0], "a value of the coordinate, a length");
    const ANGLE: Quantity = Quantity::other([0, 0, 0], "a value of the coordinate, an angle");
    let name = &linkage.coordinate;
    let parameter = scene.parameter(&name.text);
    let length = LENGTH.dimension();
    let quantity = match parameter.map(|p| &p.dimension) {
        Some(d) if *d == length => LENGTH,
        Some(d) if *d == ANGLE.dimension() => ANGLE,
        _ => {
            let message = format!(
                "`{}` is no parameter that is an angle or a length",
                name.text
            );
            let hint = "the coordinate is a parameter by which `bodies` gives places";
            return r.refuse(name.span, message, hint);
        }
    };
    let coordinate = parameter?.name.clone();
    let depends = |e: &Expr| e.symbols().contains(&coordinate);
    let moving = places.iter().enumerate();
    let moving = moving.filter(|(b, p)| !scene.bodies[*b].is_fixed() && p.iter().any(depends));
    let moving: Vec<(usize, [Expr; 3])> = moving.map(|(b, p)| (b, p.clone())).collect();
    if moving.is_empty() {
        let message = format!("the place of no body depends on `{}`", name.text);
        let hint = "give `center` and `angle` of what moves by the coordinate";
        return r.refuse(name.span, message, hint);
    }
    let from = optional(r, linkage.from.as_ref(), quantity)?;
    let to = r.read(&linkage.to, quantity)?;
    Some(Linkage {
        ends: [from.unwrap_or_else(|| Expr::symbol(&coordinate)), to],
        coordinate,
        places: moving,
        gravity: weight(r, linkage.gravity.as_ref())?,
    })
}

fn turn_of(r: &mut Resolver<'_>, turn: &TurnFile, lasts: Option<&Expr>) -> Option<Turn> {
    let span = turn.span.opening();
    let ends = [
        ("by", turn.by.is_some()),
        ("until", turn.until.is_some()),
        ("for", turn.time.is_some()),
    ];
    let message = "a rotation ends after an angle `by`, at a place `until`, or after a time `for`";
    one_end(r, &ends, lasts, (span, message))?;
    if turn.gravity.is_some() && (turn.time.is_some() || lasts.is_some()) {
        let at = turn.time.as_ref().map_or(span, |time| time.span);
        let message = "a rotation under its weight ends at an angle, not after a time";
        let hint = "where it is after a time has no closed form; give `by` or `until`";
        return r.refuse(at, message, hint);
    }
    let all = company(r, &turn.body, turn.with.as_deref());
    let Some(about_file) = &turn.about else {
        let message = "the field `about` is missing";
        let hint = "the point that it turns about: its name, or its place [x, y]; one hinge in `hinges` says it too";
        return r.refuse(span, message, hint);
    };
    let about = r.position(about_file);
    if let Some((name, pivot)) = r.named_body(about_file)
        && !r.is_fixed(pivot)
        && all
            .as_ref()
            .is_some_and(|(b, with)| *b != pivot && !with.contains(&pivot))
    {
        let message = format!(
            "nothing holds `{0}`: it moves when `{1}` turns about it",
            name.text, turn.body.text
        );
        let hint = "a rotation is about a point that stays where it is: a `fixed` body, or a place [x, y]; how two bodies swing that both are free is not worked out";
        return r.refuse(name.span, message, hint);
    }
    let about_name = match about_file {
        PositionFile::Name(name) => name.text.clone(),
        // Named when all stages are read.
        _ => String::new(),
    };
    let until = match (&turn.by, turn.until, &turn.time) {
        (Some(by), ..) => Until::By(r.read(by, Quantity::ANGLE)?),
        (_, Some(UntilName::Above), _) => Until::Above,
        (_, Some(UntilName::Below), _) => Until::Below,
        (_, Some(UntilName::Stops), _) => Until::Stops,
        (.., Some(time)) => Until::For(r.read(time, Quantity::TIME)?),
        _ => Until::For(lasts?.clone()),
    };
    let (body, with) = all?;
    Some(Turn {
        body,
        with,
        about: about?,
        about_name,
        until,
        clockwise: turn.clockwise,
        gravity: weight(r, turn.gravity.as_ref())?,
        torque: optional(r, turn.torque.as_ref(), MOMENT)?,
    })
}
