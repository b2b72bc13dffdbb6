//! Sentences about stages, made from what was found of them: what happens, which forces have impulses, what is open.

use super::calc::{Seen, is_zero, sign};
use super::{Case, StageTold};
use crate::algebra::Sign;
use crate::derive;
use crate::domain::Domains;
use crate::expr::{Expr, minus};
use crate::formula::write_plain;
use crate::scene::{BlowImpulse, ContactLaw, Scene, Stage, StageKind, Story};

/// Which supports act in an outcome.
pub(super) fn active(case: &Case) -> String {
    match case.active.as_slice() {
        [] => String::from("no support or string acts"),
        names => format!(
            "{} act{}",
            names.join(" and "),
            if names.len() == 1 { "s" } else { "" }
        ),
    }
}

/// What happens in a stage.
pub(super) fn stage(stage: &Stage, told: &StageTold) -> Vec<String> {
    let scene = &stage.scene;
    let mut out = Vec::new();
    match &stage.kind {
        StageKind::Impact { one_sided, .. } => {
            for case in &told.cases {
                if told.cases.len() > 1 || !one_sided.is_empty() {
                    let conditions: Vec<String> = case
                        .conditions
                        .iter()
                        .map(|(_, e)| format!("{} ≥ 0", write_plain(e)))
                        .collect();
                    let resting: Vec<&str> = one_sided
                        .iter()
                        .filter(|o| !case.active.contains(&o.name))
                        .map(|o| o.name.as_str())
                        .collect();
                    let left = if resting.is_empty() {
                        String::new()
                    } else {
                        format!(
                            ", {} {} free",
                            resting.join(" and "),
                            if resting.len() == 1 { "comes" } else { "come" }
                        )
                    };
                    out.push(if conditions.is_empty() {
                        format!("{}{left}, for all values in the domain", active(case))
                    } else {
                        format!("where {}: {}{left}", conditions.join(" and "), active(case))
                    });
                }
            }
            for (b, body) in scene
                .bodies
                .iter()
                .enumerate()
                .filter(|(_, b)| !b.is_fixed())
            {
                out.push(changed(
                    &body.name,
                    told,
                    b,
                    &scene.domains,
                    body.is_particle(),
                ));
            }
        }
        StageKind::Turn(turn) => {
            let name = &scene.bodies[turn.body].name;
            out.push(format!(
                "`{name}` turns about {}; {}",
                turn.about_name,
                spin_words(
                    "spin",
                    &told.before.spin[turn.body],
                    &told.after.spin[turn.body],
                    &scene.domains
                )
            ));
        }
        StageKind::Slide(slide) => out.push(format!(
            "`{}` moves along a line through {}",
            scene.bodies[slide.body].name,
            write_plain(&slide.distance)
        )),
        StageKind::Fall(fall) => {
            let name = &scene.bodies[fall.body].name;
            out.push(match &fall.height {
                Some(h) => format!("`{name}` falls freely through {}", write_plain(h)),
                None => format!("`{name}` moves freely"),
            });
            if is_zero(&told.after.spin[fall.body], &scene.domains) == Some(false) {
                out.push(format!(
                    "`{name}` keeps its spin, since nothing has a moment about its center of mass"
                ));
            }
        }
        StageKind::Wind(wind) => out.push(format!(
            "the rope winds up until {} of it is free; `{}` keeps its speed",
            write_plain(&wind.to),
            scene.bodies[wind.body].name
        )),
    }
    out
}

/// How a body's motion changed, in words.
fn changed(name: &str, told: &StageTold, b: usize, domains: &Domains, is_particle: bool) -> String {
    let (v0, v1) = (&told.before.velocity[b], &told.after.velocity[b]);
    let zero = |v: &[Expr; 2]| v.iter().all(|c| is_zero(c, domains) == Some(true));
    let same = minus(v0, v1)
        .iter()
        .all(|c| is_zero(c, domains) == Some(true));
    let center = if is_particle {
        format!("`{name}`")
    } else {
        format!("the center of mass of `{name}`")
    };
    let mut words = if same && zero(v1) {
        format!("{center} stays at rest")
    } else if same {
        format!("{center} keeps its velocity")
    } else if zero(v1) {
        format!("{center} comes to rest")
    } else {
        format!("{center} moves {}", heading(v1, domains))
    };
    if !is_particle {
        words.push_str(", and ");
        words.push_str(&spin_words(
            "its spin",
            &told.before.spin[b],
            &told.after.spin[b],
            domains,
        ));
    }
    words
}

fn heading(v: &[Expr; 2], domains: &Domains) -> String {
    let part = |e: &Expr, plus: &'static str, minus: &'static str| match sign(e, domains) {
        Seen::Proved(Sign::Zero) => None,
        s if s.is_positive() => Some(plus),
        s if s.is_negative() => Some(minus),
        _ => Some("one way or the other"),
    };
    let parts: Vec<&str> = [
        part(&v[0], "to the right", "to the left"),
        part(&v[1], "up", "down"),
    ]
    .into_iter()
    .flatten()
    .collect();
    parts.join(" and ")
}

fn spin_words(what: &str, before: &Expr, after: &Expr, domains: &Domains) -> String {
    if is_zero(&(before - after), domains) == Some(true) {
        return match is_zero(after, domains) {
            Some(true) => format!("{what} stays zero: it does not turn"),
            _ => format!("{what} does not change: it goes on turning as before"),
        };
    }
    if is_zero(after, domains) == Some(true) {
        return format!("{what} ends");
    }
    let way = match sign(after, domains) {
        s if s.is_positive() => "counterclockwise",
        s if s.is_negative() => "clockwise",
        _ => "in a sense that hangs on the values",
    };
    let larger = sign(&(&after.powi(2) - &before.powi(2)), domains);
    let change = if larger.is_positive() {
        "grows"
    } else if larger.is_negative() {
        "falls"
    } else {
        "changes"
    };
    format!("{what} {change}; at the end it is {way}")
}

/// Which forces have an impulse, and why; which have none.
pub(super) fn impulsive(stage: &Stage, told: &StageTold) -> Vec<String> {
    let StageKind::Impact { one_sided, .. } = &stage.kind else {
        return vec![format!(
            "`{}` is a motion: nothing jumps, so no force has an impulse in no time",
            stage.name
        )];
    };
    let scene = &stage.scene;
    let mut out = Vec::new();
    for blow in &scene.blows {
        let size = match &blow.impulse {
            BlowImpulse::Given(v) => format!(" ({}, {})", write_plain(&v[0]), write_plain(&v[1])),
            BlowImpulse::Along(_) => String::new(),
        };
        out.push(format!(
            "`{}` is a blow: its impulse{size} is what is given, however short it lasts",
            blow.name
        ));
    }
    for c in &scene.contacts {
        out.push(format!("`{}` is impulsive: the bodies are stiff there, and only a force that grows without bound as the time shrinks can change a velocity at once", c.name));
    }
    for h in &scene.hinges {
        out.push(format!("`{}` is impulsive: the joint cannot give way, and answers with whatever impulse keeps it together", h.name));
    }
    for o in one_sided {
        let verb = if o.is_string { "pull" } else { "push" };
        let mut cases = Vec::new();
        for case in &told.cases {
            let value = case.derivation.answers.iter().find_map(|a| match &a.form {
                derive::Form::Value { closed, .. } if a.name == format!("\u{1}{}", o.name) => {
                    Some(closed.clone())
                }
                _ => None,
            });
            let conditions: Vec<String> = case
                .conditions
                .iter()
                .map(|(_, e)| format!("{} ≥ 0", write_plain(e)))
                .collect();
            let place = if conditions.is_empty() {
                String::new()
            } else {
                format!(" where {}", conditions.join(" and "))
            };
            cases.push(match value {
                Some(v) => format!("{}{place}", write_plain(&v)),
                None => format!("none{place}"),
            });
        }
        out.push(format!("`{}` can only {verb}, and is stiff, so it is impulsive where it is needed: its impulse is {}", o.name, cases.join(", and ")));
    }
    for f in &scene.forces {
        out.push(format!(
            "`{}` on `{}` is finite: over a contact time τ its impulse is at most its largest size times τ, which vanishes with τ; it is left out",
            f.name, scene.bodies[f.body].name
        ));
    }
    out
}

/// What the balances alone leave open, and what would close them.
pub(super) fn missing(stage: &Stage, told: &StageTold) -> Vec<String> {
    let mut bare: Scene = stage.scene.clone();
    for (body, (v, w)) in bare
        .bodies
        .iter_mut()
        .zip(told.before.velocity.iter().zip(&told.before.spin))
    {
        body.velocity = v.clone();
        body.spin = w.clone();
    }
    let mut out = Vec::new();
    let mut used = Vec::new();
    for c in &mut bare.contacts {
        used.push(match &c.law {
            ContactLaw::Sticking => format!("at `{}` the bodies stick", c.name),
            ContactLaw::Frictionless { restitution } => format!(
                "at `{}` there is no friction, the normal is the one given, and e = {}",
                c.name,
                write_plain(restitution)
            ),
            ContactLaw::None => format!("nothing is supposed at `{}`", c.name),
        });
        c.law = ContactLaw::None;
        c.normal = None;
    }
    if let StageKind::Impact { one_sided, .. } = &stage.kind {
        for case in &told.cases {
            for o in one_sided {
                used.push(if case.active.contains(&o.name) {
                    format!(
                        "`{}` {}",
                        o.name,
                        if o.is_string {
                            "is taut, cannot stretch, and does not rebound"
                        } else {
                            "pushes and does not rebound"
                        }
                    )
                } else {
                    format!(
                        "`{}` {}",
                        o.name,
                        if o.is_string {
                            "goes slack and has no impulse"
                        } else {
                            "is left and has no impulse"
                        }
                    )
                });
            }
        }
    }
    let counting = match derive::count(&bare) {
        Ok(counting) => counting,
        Err(stop) => {
            out.push(format!("not counted: {stop}"));
            return out;
        }
    };
    out.push(format!(
        "the balances of `{}` alone are {} equations for {} unknowns, of rank {}: {} short",
        stage.name,
        counting.equations,
        counting.unknowns,
        counting.rank,
        counting.unknowns.saturating_sub(counting.rank)
    ));
    out.extend(
        counting
            .closing_laws
            .iter()
            .map(|law| format!("missing, for instance: {law}")),
    );
    out.extend(used.into_iter().map(|u| format!("supposed here: {u}")));
    out
}

/// Everything the story takes for granted.
pub(super) fn assumed(story: &Story, stages: &[StageTold]) -> Vec<String> {
    let mut out = story.readings.clone();
    for (stage, told) in story.stages.iter().zip(stages) {
        match &stage.kind {
            StageKind::Impact { .. } => out.push(format!("`{}` takes no time: nothing moves while velocities jump, and finite forces have no impulse", stage.name)),
            StageKind::Turn(turn) => out.push(format!("in `{}` the body is rigid, and {} is frictionless and does not move", stage.name, turn.about_name)),
            StageKind::Fall(_) => out.push(format!("in `{}` there is no drag", stage.name)),
            StageKind::Slide(_) | StageKind::Wind(_) => {}
        }
        out.extend(told.assumptions.iter().cloned());
    }
    out
}
