//! What a body has to do at the beginning so that it can move along its line.

use super::super::supposed::Supposed;
use super::super::tidied;
use super::line::Line;
use super::lumps;
use crate::algebra::Sign;
use crate::answer::calc::{Seen, is_zero, sign, tidy};
use crate::expr::{Expr, Vector, dot};
use crate::formula::{sentence, write_plain};
use crate::scene::{Shape, Slide, Stage};
use crate::story::{Refused, State};

/// The motion behind the bend by which the bodies come to their line, where there is one: along it, as fast as before.
pub(super) fn bent(
    stage: &Stage,
    mut before: State,
    slide: &Slide,
    supposed: &mut Supposed<'_>,
) -> Result<State, Refused> {
    if !slide.bend {
        return Ok(before);
    }
    let velocity = before.velocity[slide.body].clone();
    let speed = tidied(stage, &dot(&velocity, &velocity).sqrt())?;
    let is_same = |v: &Vector| {
        let mut gaps = v.iter().zip(&velocity).map(|(a, b)| a - b);
        gaps.all(|gap| is_zero(&gap, &stage.scene.domains) == Some(true))
    };
    // Whatever moves otherwise stays as it is, and does not fit the line.
    for b in slide.company() {
        if is_same(&before.velocity[b]) {
            before.velocity[b] = slide.along.each_ref().map(|c| &speed * c);
        }
    }
    supposed.words.push(sentence!(
        "a short and smooth bend leads `{}` into the line of this stage, so that it keeps its speed",
        &stage.scene.bodies[slide.body].name
    ));
    Ok(before)
}

/// Refuses a body that does not begin to move along its line, or turns where nothing lets it.
pub(super) fn fits(stage: &Stage, before: &State, slide: &Slide) -> Result<(), Refused> {
    let speed = dot(&before.velocity[slide.body], &slide.along);
    for (bodies, along) in lumps(slide) {
        fits_line(stage, before, slide, &bodies, along, &speed)?;
    }
    for p in slide.pulleys() {
        let zero = |e: &Expr| is_zero(e, &stage.scene.domains) != Some(false);
        if !before.velocity[p].iter().all(zero) {
            let why = format!("the center of `{}` moves", stage.scene.bodies[p].name);
            let hint = "a string runs over pulleys whose centers stay";
            return Err(Refused::new(&stage.name, why, hint));
        }
    }
    Ok(())
}

pub(super) fn fits_line(
    stage: &Stage,
    before: &State,
    slide: &Slide,
    bodies: &[usize],
    direction: &Vector,
    speed: &Expr,
) -> Result<(), Refused> {
    let domains = &stage.scene.domains;
    let across = [-&direction[1], direction[0].clone()];
    let turns = slide.rolling || slide.friction.is_some();
    // On a movable pulley the line has half the speed of the body.
    let square = dot(direction, direction);
    let how = match is_zero(&(&square - &Expr::one()), domains) {
        Some(false) => "at half the speed of",
        _ => "like",
    };
    let speed = speed * &square;
    for &b in bodies {
        let body = &stage.scene.bodies[b];
        let v = &before.velocity[b];
        let is_alone = b == slide.body && slide.with.is_empty();
        let may_turn = turns && is_alone && body.shape.radius().is_some();
        let may_turn = may_turn || slide.strings.iter().any(|s| s.under == Some(b));
        let refuse = |does: &str, e: &Expr, hint: &str| {
            let value = write_plain(&tidy(e, domains).unwrap_or_else(|_| e.clone()));
            let words = format!("`{}` does not begin to move along this line", body.name);
            let why = format!("{words}: {does} {value}");
            Err(Refused::new(&stage.name, why, hint))
        };
        let aside = dot(v, &across);
        if is_zero(&aside, domains) == Some(false) {
            let hint = match slide.bend {
                true => "what comes round a bend together moves as one before it",
                false => {
                    "where the way bends gently into this line, say \"bend\": true; an impact before it may stop what does not fit"
                }
            };
            return refuse("across it, its velocity is", &aside, hint);
        }
        let is_small = matches!(body.shape, Shape::Particle);
        if !may_turn && !is_small && is_zero(&before.spin[b], domains) == Some(false) {
            let hint = match is_alone && body.shape.radius().is_some() {
                true => {
                    "a round body may turn where it is `rolling` or slides with `friction`, which is 0 where the surface is smooth"
                }
                false => "an impact before it may stop what does not fit",
            };
            return refuse("it turns, at", &before.spin[b], hint);
        }
        let gap = &dot(v, direction) - &speed;
        if is_zero(&gap, domains) == Some(false) {
            let why = format!(
                "`{}` does not begin to move {how} `{}`",
                body.name, stage.scene.bodies[slide.body].name
            );
            let hint = "bodies move along together after an impact in which they stick";
            return Err(Refused::new(&stage.name, why, hint));
        }
    }
    Ok(())
}

/// Refuses a spring whose stiffness is not positive.
pub(super) fn springy(stage: &Stage, slide: &Slide) -> Result<(), Refused> {
    let Some(spring) = &slide.spring else {
        return Ok(());
    };
    match sign(&spring.stiffness, &stage.scene.domains) {
        Seen::Proved(Sign::Positive) => Ok(()),
        _ => Err(Refused::new(
            &stage.name,
            format!(
                "the stiffness of a spring is positive, and {} need not be",
                write_plain(&spring.stiffness)
            ),
            "a parameter with a unit and no domain is positive",
        )),
    }
}

/// Refuses a heavy pulley whose rim does not begin to move with the string.
pub(super) fn rims(line: &Line<'_>, before: &State) -> Result<(), Refused> {
    let scene = &line.stage.scene;
    for (pulley, spin) in line.pulleys() {
        let body = &scene.bodies[pulley];
        let gap = &before.spin[pulley] - &(spin * &line.speed);
        if !body.is_light_pulley() && is_zero(&gap, &scene.domains) == Some(false) {
            let why = format!(
                "the rim of `{}` does not begin to move with the string",
                body.name
            );
            let hint =
                "put an impact before it in which the string pulls, or give it a spin that fits";
            return Err(Refused::new(&line.stage.name, why, hint));
        }
    }
    Ok(())
}

/// Refuses a speed or distance that is negative; one that may be is supposed not to be, nor to be zero where it has to get
/// somewhere.
pub(super) fn forward(
    stage: &Stage,
    slide: &Slide,
    (what, size, moves): (&str, &Expr, bool),
    supposed: &mut Supposed<'_>,
) -> Result<(), Refused> {
    let name = &stage.scene.bodies[slide.body].name;
    let refused = || {
        let size = write_plain(size);
        let why = format!(
            "`{name}` is to move along the line, and its {what} along it, {size}, is negative"
        );
        Refused::new(&stage.name, why, "turn the direction round")
    };
    match moves && is_zero(size, &stage.scene.domains) != Some(true) {
        true => supposed.positive(size, format!("`{name}` moves forward"), refused),
        false => supposed.not_negative(
            size,
            format!("`{name}` does not at first move backward"),
            refused,
        ),
    }
}
