//! Sentences about stages, made from what was found of them: what happens, which forces have impulses, what is open.

use super::calc::{essential, is_zero, sign};
use super::{Case, StageTold};
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
                let moving = scene
                    .bodies
                    .iter()
                    .enumerate()
                    .filter(|(_, b)| !b.is_fixed());
                let given: Vec<&Expr> = case.conditions.iter().map(|(_, e)| e).collect();
                for (b, body) in moving {
                    out.push(
                        Change {
                            told,
                            case,
                            b,
                            domains: &scene.domains,
                            given: &given,
                        }
                        .words(&body.name, body.is_particle()),
                    );
                }
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
                    &scene.domains,
                    &[]
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

/// How an impact changes a body's motion, where its conditions hold.
struct Change<'a> {
    told: &'a StageTold,
    case: &'a Case,
    b: usize,
    domains: &'a Domains,
    given: &'a [&'a Expr],
}

impl Change<'_> {
    fn words(&self, name: &str, is_particle: bool) -> String {
        let (before, after) = (&self.told.before, &self.case.after);
        let (v0, v1) = (&before.velocity[self.b], &after.velocity[self.b]);
        let zero = |v: &[Expr; 2]| v.iter().all(|c| is_zero(c, self.domains) == Some(true));
        let center = if is_particle {
            format!("`{name}`")
        } else {
            format!("the center of mass of `{name}`")
        };
        let mut words = match (zero(&minus(v0, v1)), zero(v1)) {
            (true, true) => format!("{center} stays at rest"),
            (true, false) => format!("{center} keeps its velocity"),
            (false, true) => format!("{center} comes to rest"),
            (false, false) => format!("{center} moves {}", self.heading(v1)),
        };
        if !is_particle {
            let (w0, w1) = (&before.spin[self.b], &after.spin[self.b]);
            words.push_str(", and ");
            words.push_str(&spin_words("its spin", w0, w1, self.domains, self.given));
        }
        words
    }

    fn heading(&self, v: &[Expr; 2]) -> String {
        let part = |e: &Expr, plus: &'static str, minus: &'static str, either: &'static str| {
            if is_zero(e, self.domains) == Some(true) {
                return None;
            }
            Some(match way(e, self.domains, self.given) {
                Some(true) => plus,
                Some(false) => minus,
                None => either,
            })
        };
        let x = part(
            &v[0],
            "to the right",
            "to the left",
            "sideways, to which side hangs on the values",
        );
        let y = part(&v[1], "up", "down", "up or down as the values decide");
        let parts: Vec<&str> = [x, y].into_iter().flatten().collect();
        parts.join(" and ")
    }
}

/// Whether a value is above zero where some others are not negative; `None` where that is not known.
fn way(e: &Expr, domains: &Domains, given: &[&Expr]) -> Option<bool> {
    let s = sign(e, domains);
    if s.is_positive() || s.is_negative() {
        return Some(s.is_positive());
    }
    let rest = essential(e, domains);
    let matches = |f: Expr| {
        given
            .iter()
            .any(|g| is_zero(&(&f - *g), domains) == Some(true))
    };
    if matches(rest.clone()) {
        Some(true)
    } else if matches(-&rest) {
        Some(false)
    } else {
        None
    }
}

fn spin_words(
    what: &str,
    before: &Expr,
    after: &Expr,
    domains: &Domains,
    given: &[&Expr],
) -> String {
    if is_zero(&(before - after), domains) == Some(true) {
        return match is_zero(after, domains) {
            Some(true) => format!("{what} stays zero: it does not turn"),
            _ => format!("{what} does not change: it goes on turning as before"),
        };
    }
    if is_zero(after, domains) == Some(true) {
        return format!("{what} ends");
    }
    let sense = match way(after, domains, given) {
        Some(true) => "counterclockwise",
        Some(false) => "clockwise",
        None => "in a sense that hangs on the values",
    };
    if is_zero(before, domains) == Some(true) {
        return format!("{what} begins, {sense}");
    }
    let change = match way(&(&after.powi(2) - &before.powi(2)), domains, given) {
        Some(true) => "grows",
        Some(false) => "falls",
        None => "changes",
    };
    let turned = match (way(before, domains, given), way(after, domains, given)) {
        (Some(a), Some(b)) if a != b => " and turns round",
        _ => "",
    };
    format!("{what} {change}{turned}; at the end it is {sense}")
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
            let value = case.value(&format!("\u{1}{}", o.name));
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
