//! A motion along a line as the file writes it becomes a [`Slide`].
//!
//! In: its record. Out: the motion, or what does not go together in it.

use super::fields::{FORCE, coefficient, company, one_end, optional, weight};
use crate::expr::Expr;
use crate::scene::fault::Span;
use crate::scene::formulas::Quantity;
use crate::scene::motion::{Carrier, Slide, SlideEnd, Spring, Strung};
use crate::scene::resolver::Resolver;
use crate::scene::stage::{Stage, StageKind};
use crate::scene::stage_file::{CarrierFile, SlideEndName, SlideFile, SpringFile, StrungFile};
use crate::scene::{Scene, Shape};

pub(super) fn slide(
    r: &mut Resolver<'_>,
    scene: &Scene,
    slide: &SlideFile,
    lasts: Option<&Expr>,
) -> Option<Slide> {
    let span = slide.span.opening();
    let until = end(r, slide, lasts, span)?;
    let all = company(r, &slide.body, slide.with.as_deref());
    let along = r.direction(&slide.along);
    let gravity = weight(r, slide.gravity.as_ref())?;
    let force = optional(r, slide.force.as_ref(), FORCE)?;
    let friction = coefficient(r, slide.friction.as_ref())?;
    let strings = slide.strings.iter().flatten();
    let strings = strings
        .map(|s| strung(r, scene, s))
        .collect::<Option<Vec<Strung>>>()?;
    let on = match &slide.on {
        None => None,
        Some(on) => Some(Box::new(carrier(r, on)?)),
    };
    let spring = match &slide.spring {
        None => None,
        Some(spring) => Some(self::spring(r, spring)?),
    };
    let (body, with) = all?;
    let out = Slide {
        level: slide.level == Some(true),
        bend: slide.bend == Some(true),
        body,
        with,
        along: along?,
        until,
        gravity,
        force,
        friction,
        on,
        spring,
        rolling: slide.rolling == Some(true),
        strings,
    };
    let mut all = out.bodies();
    all.sort_unstable();
    let twice = all.windows(2).find(|pair| pair[0] == pair[1]);
    let wrong = twice.map(|twice| {
        let name = &scene.bodies[twice[0]].name;
        let message = format!("`{name}` moves along with itself");
        let is_drum = out
            .strings
            .iter()
            .any(|s| s.to.contains(&twice[0]) && s.over.contains(&twice[0]));
        (message, if is_drum { DRUM } else { "name each body once" })
    });
    match wrong.or_else(|| unfit(scene, &out)) {
        Some((message, hint)) => r.refuse(span, message, hint),
        None => Some(out),
    }
}

/// How the motion ends.
fn end(
    r: &mut Resolver<'_>,
    slide: &SlideFile,
    lasts: Option<&Expr>,
    span: Span,
) -> Option<SlideEnd> {
    let ends = [
        ("distance", slide.distance.is_some()),
        ("for", slide.time.is_some()),
        ("until", slide.until.is_some()),
    ];
    let message =
        "a motion along a line ends after a `distance`, a time `for`, or where `until` says";
    one_end(r, &ends, lasts, (span, message))?;
    match (&slide.distance, &slide.time, slide.until) {
        (Some(s), None, None) => r.read(s, Quantity::LENGTH).map(SlideEnd::Distance),
        (None, Some(t), None) => r.read(t, Quantity::TIME).map(SlideEnd::Time),
        (None, None, Some(name)) => Some(match name {
            SlideEndName::Stops => SlideEnd::Stops,
            SlideEndName::Rolls => SlideEnd::Rolls,
            SlideEndName::Together => SlideEnd::Together,
        }),
        _ => lasts.cloned().map(SlideEnd::Time),
    }
}

/// What does not go together in a motion, and what to do about it.
fn unfit(scene: &Scene, slide: &Slide) -> Option<(String, &'static str)> {
    let is_rough = slide.friction.is_some() || slide.strings.iter().any(|s| s.friction.is_some());
    let shape = &scene.bodies[slide.body];
    let is_round = slide.with.is_empty() && shape.shape.radius().is_some();
    let rolls = slide.rolling || matches!(slide.until, SlideEnd::Rolls);
    let goes_alone = slide.strings.is_empty() && !rolls;
    Some(match () {
        () if rolls && shape.shape.radius().is_none() => (
            format!("`{}` does not roll", shape.name),
            "a disk, ring or sphere does",
        ),
        () if is_rough && slide.gravity.is_none() => (
            String::from("what presses the body on the rough surface is not said"),
            "add \"gravity\": \"g\"",
        ),
        () if slide.rolling && slide.friction.is_some() => (
            String::from("a body that rolls takes as much friction as that needs"),
            "leave out `friction`, or leave out `rolling` and say where the slip ends with \"until\": \"rolls\"",
        ),
        () if slide.friction.as_ref().is_none_or(Expr::is_zero)
            && matches!(slide.until, SlideEnd::Rolls) =>
        {
            (
                String::from("without friction a body that slips never begins to roll"),
                "add \"friction\": \"mu\"",
            )
        }
        () if slide.level && !goes_alone => (
            String::from(
                "a scene seen from above has bodies that slide, and neither roll nor hang on strings",
            ),
            "leave out `level` where the scene is seen from the side",
        ),
        () if slide.bend && !slide.strings.is_empty() => (
            String::from("what hangs on strings comes round no bend"),
            "leave out `bend`",
        ),
        () if slide.on.is_none() && matches!(slide.until, SlideEnd::Together) => (
            String::from("what it comes to move together with is not said"),
            "name the body below it, such as \"on\": {\"body\": \"plank\"}",
        ),
        () if slide.on.is_some() => return not_carried(slide, is_round),
        () if slide.spring.is_some() && (!slide.strings.is_empty() || is_round && is_rough) => (
            String::from(
                "a spring acts on a body without strings that slides without turning or rolls",
            ),
            "leave out `strings`; a round body by a spring is \"rolling\": true",
        ),
        () => return None,
    })
}

/// Refuses a round body that turns as it goes, with others that move along as if it did not.
pub(super) fn loaded_wheel(base: &mut Resolver<'_>, stage: &Stage, span: Span) {
    let StageKind::Slide(slide) = &stage.kind else {
        return;
    };
    let turns = slide.rolling || slide.friction.is_some() && !slide.level;
    let bodies = &stage.scene.bodies;
    let wheel = &bodies[slide.body];
    let Some(load) = slide.with.first().map(|b| &bodies[*b].name) else {
        return;
    };
    if turns && wheel.shape.radius().is_some() {
        let message = format!(
            "`{}` turns as it goes over the surface, and `{load}` is to move along as if it did not",
            wheel.name
        );
        let hint = "where the load sits at its center, give it the mass of both and the `inertia` that it has alone, in a scene that begins here; what slides without turning is no disk, ring or sphere";
        base.report(span, message, hint);
    }
}

/// What does not go together where the body below moves too.
fn not_carried(slide: &Slide, is_round: bool) -> Option<(String, &'static str)> {
    Some(match () {
        // What a spring between two bodies hands on is an impact that takes long.
        () if slide.spring.is_some() => (
            String::from("a spring between two bodies that both move is no motion of a stage"),
            "pressed together it hands on what an impact does: with \"restitution\": 1 as it is free again, with \"law\": \"sticking\" as it is pressed most, when it holds the energy that is lost there, k*s^2/2",
        ),
        () if !slide.strings.is_empty() || slide.rolling || slide.level => (
            String::from(
                "what slides on a body that moves too neither hangs on strings nor goes on rolling, and is seen from the side",
            ),
            "a block slides on it until both move \"together\", a ball until it \"rolls\"",
        ),
        () if is_round && !matches!(slide.until, SlideEnd::Rolls | SlideEnd::Time(_)) => (
            String::from("a round body on a body that moves too slips until it rolls"),
            "write \"until\": \"rolls\", or a time `for`",
        ),
        () if slide.friction.is_none() && matches!(slide.until, SlideEnd::Together) => (
            String::from("without friction what slides goes on sliding on the body below"),
            "add \"friction\": \"mu\" between the two",
        ),
        () if matches!(slide.until, SlideEnd::Stops) => (
            String::from("whether it stops on the body below it or over the ground is not said"),
            "write \"until\": \"together\", or a time `for`",
        ),
        () => return None,
    })
}

/// The body below, where it moves too: a free one, or a belt, whose velocity is prescribed.
fn carrier(r: &mut Resolver<'_>, on: &CarrierFile) -> Option<Carrier> {
    let below = r.body_named(&on.body)?;
    let runs = r.is_fixed(below);
    if runs && (on.with.is_some() || on.friction.is_some() || on.force.is_some()) {
        let message = format!(
            "`{}` is moved as it is said to be, whatever acts on it",
            on.body.text
        );
        let hint = "a belt has a `velocity` where the bodies are, and nothing beside `body` here; friction on it is that of the slide";
        return r.refuse(on.body.span, message, hint);
    }
    let all = match runs {
        true => Some((below, Vec::new())),
        false => company(r, &on.body, on.with.as_deref()),
    };
    let friction = coefficient(r, on.friction.as_ref())?;
    let force = optional(r, on.force.as_ref(), FORCE)?;
    let (body, with) = all?;
    Some(Carrier {
        body,
        with,
        friction,
        force,
    })
}

/// A spring along the line.
fn spring(r: &mut Resolver<'_>, spring: &SpringFile) -> Option<Spring> {
    let relaxed = optional(r, spring.relaxed.as_ref(), Quantity::LENGTH)?;
    Some(Spring {
        stiffness: r
            .symbols
            .read(&spring.stiffness, Quantity::STIFFNESS, &mut r.faults)?,
        relaxed: relaxed.unwrap_or_else(Expr::zero),
    })
}

const DRUM: &str = "where the string is wound on a drum, a `linkage` whose coordinate is the length run off moves both; the drum turns by that over its radius";

/// A string over pulleys with what moves at its other end.
fn strung(r: &mut Resolver<'_>, scene: &Scene, string: &StrungFile) -> Option<Strung> {
    let to: Vec<_> = string.to.iter().map(|name| r.moving(name)).collect();
    let over: Vec<_> = string.over.iter().map(|name| r.moving(name)).collect();
    let along = r.direction(&string.along);
    let friction = coefficient(r, string.friction.as_ref())?;
    let under = string.under.as_ref().map(|name| r.moving(name));
    let (to, over): (Option<Vec<_>>, Option<Vec<_>>) =
        (to.into_iter().collect(), over.into_iter().collect());
    let (to, over) = (to?, over?);
    let under = match under {
        None => None,
        Some(pulley) => Some(pulley?),
    };
    if to.is_empty() || !(1..=2).contains(&over.len()) {
        let message = "a string runs over one or two pulleys to one or more bodies";
        let hint = match to.is_empty() {
            true => DRUM,
            false => "a body that is pulled along the same line is named under `with`",
        };
        return r.refuse(string.span, message, hint);
    }
    let pulleys = over.iter().zip(&string.over);
    for (pulley, name) in pulleys.chain(under.iter().zip(&string.under)) {
        let body = &scene.bodies[*pulley];
        if !matches!(body.shape, Shape::Disk { .. } | Shape::Ring { .. }) {
            let message = format!("`{}` is no pulley", body.name);
            let hint =
                "a pulley is a disk or ring; where it is light or smooth, a disk of mass \"0\"";
            return r.refuse(name.span, message, hint);
        }
    }
    let mut out = Strung {
        to,
        along: along?,
        over,
        under,
        friction,
    };
    if under.is_some() {
        let ratio = out.ratio();
        out.along = out.along.map(|c| &ratio * &c);
    }
    Some(out)
}
