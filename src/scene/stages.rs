//! Stages as written become stages of a scene: each gets its own [`Scene`] with the bodies where they are when it begins.
//!
//! In: the records of [`super::stage_file`]. Out: a [`Story`], or faults. Places after a motion follow from geometry alone
//! and are put in here; velocities are the affair of [`crate::story`].

use std::collections::HashMap;

use super::check::{Claim, check};
use super::fault::{Fault, Span, nearest};
use super::file::{ContactFile, PositionFile, QuestionFile, SceneFile, VelocityFile};
use super::formulas::{Quantity, Symbols};
use super::place::Place;
use super::record::{Formula, Map, Text};
use super::resolve::{Resolver, entries};
use super::stage::{
    Fall, OneSided, Slide, Stage, StageKind, Story, StoryAsk, StoryQuestion, Turn, Until, Wind,
};
use super::stage_file::{EndName, ImpactFile, StageFile, StartFile, TurnFile, UntilName};
use super::{Scene, geometry, question, special};
use crate::expr::{Expr, Vector, dot, minus};

/// Most stages a scene may have.
const STAGES: usize = 40;

const TIME: Quantity = Quantity::other([0, 0, 1], "a time, such as t, or a number of seconds");
const ACCELERATION: Quantity = Quantity::other(
    [0, 1, -2],
    "gravity is a length per time squared, such as g",
);
const STIFFNESS: Quantity =
    Quantity::other([1, 0, -2], "a stiffness is a force divided by a length");
const MOMENT: Quantity = Quantity::other([1, 2, -2], "a moment is a force times a length");
const FORCE: Quantity = Quantity::other([1, 1, -2], "a force is a mass times an acceleration");

/// Where a body is: its center and its orientation.
type Placed = (Vector, Expr);

/// Reads the stages and the questions about them into the scene.
pub(super) fn resolve(base: &mut Resolver<'_>, scene: &mut Scene) {
    let file = base.file;
    let Some(stages) = &file.stages else { return };
    if stages.is_empty() || stages.len() > STAGES {
        let message = format!(
            "a story has 1 to {STAGES} stages, and this has {}",
            stages.len()
        );
        base.faults.push(Fault::new(file.span, message));
        return;
    }
    let misplaced = [
        ("hinges", file.hinges.as_ref().map(|m| m.0.len())),
        ("contacts", file.contacts.as_ref().map(|m| m.0.len())),
        ("blows", file.blows.as_ref().map(|m| m.0.len())),
        ("after", file.after.as_ref().map(Vec::len)),
    ];
    for (what, count) in misplaced {
        if count.is_some_and(|n| n > 0) {
            let fault = Fault::new(
                file.span,
                format!("`{what}` of a scene with stages belongs into an impact"),
            );
            base.faults.push(
                fault.hint("\"stages\": [{\"name\": \"impact\", \"impact\": {\"contacts\": …}}]"),
            );
        }
    }
    let mut story = Story {
        readings: file
            .assumptions
            .iter()
            .flatten()
            .map(|t| t.text.clone())
            .collect(),
        ..Story::default()
    };
    let homes = homes(base, stages);
    let composed: Vec<SceneFile> = (0..stages.len())
        .map(|i| composed(file, &stages[i], i, &homes))
        .collect();
    let mut ends: Vec<Option<Vec<Placed>>> = Vec::new();
    for (i, stage) in stages.iter().enumerate() {
        let from = match predecessor(base, stages, i) {
            Some(from) => from,
            None => {
                ends.push(None);
                continue;
            }
        };
        let start = match from {
            Some(j) => match &ends[j] {
                Some(end) => Some(end.clone()),
                // That stage could not be read, which has been reported.
                None => {
                    ends.push(None);
                    continue;
                }
            },
            None => None,
        };
        let symbols = std::mem::replace(&mut base.symbols, Symbols::new(Default::default()));
        let (read, end, symbols, faults) = one(&composed[i], stage, from, start, scene, symbols);
        base.symbols = symbols;
        base.faults.extend(faults);
        ends.push(end);
        story.stages.extend(read);
    }
    if base.faults.is_empty() {
        questions(base, scene, &mut story, &homes);
    }
    scene.story = Some(Box::new(story));
}

/// The stage each question about motion belongs to, by index of question.
fn homes(base: &mut Resolver<'_>, stages: &[StageFile]) -> HashMap<usize, usize> {
    let mut out = HashMap::new();
    for (k, (_, q)) in base.file.questions.iter().flat_map(|m| &m.0).enumerate() {
        let Some(q) = q else { continue };
        if question::is_motion(q)
            && let Some(i) = stage_named(&mut base.faults, stages, q.at.as_ref())
        {
            out.insert(k, i);
        }
    }
    out
}

fn stage_named(
    faults: &mut Vec<Fault>,
    stages: &[StageFile],
    name: Option<&Text>,
) -> Option<usize> {
    let Some(name) = name else {
        return stages.len().checked_sub(1);
    };
    let found = stages.iter().position(|s| s.name.text == name.text);
    if found.is_none() {
        let fault = Fault::new(name.span, format!("there is no stage `{}`", name.text));
        faults.push(
            match nearest(&name.text, stages.iter().map(|s| s.name.text.as_str())) {
                Some(near) => fault.hint(format!("did you mean `{near}`?")),
                None => fault,
            },
        );
    }
    found
}

/// The stage before, `Some(None)` for the start.
fn predecessor(base: &mut Resolver<'_>, stages: &[StageFile], i: usize) -> Option<Option<usize>> {
    let stage = &stages[i];
    if stages[..i].iter().any(|s| s.name.text == stage.name.text) || stage.name.text == "start" {
        let fault = Fault::new(
            stage.name.span,
            format!("the name `{}` is taken", stage.name.text),
        );
        base.faults.push(
            fault.hint("every stage has a name of its own, and `start` is where the story begins"),
        );
        return None;
    }
    match &stage.from {
        None => Some(i.checked_sub(1)),
        Some(name) if name.text == "start" => Some(None),
        Some(name) => match stages[..i].iter().position(|s| s.name.text == name.text) {
            Some(j) => Some(Some(j)),
            None => {
                let fault = Fault::new(
                    name.span,
                    format!("no stage `{}` comes before this one", name.text),
                );
                base.faults
                    .push(fault.hint("`from` names an earlier stage, or \"start\""));
                None
            }
        },
    }
}

/// The file of a stage taken by itself: all bodies, the impact's contacts, the questions about its end.
fn composed(
    file: &SceneFile,
    stage: &StageFile,
    i: usize,
    homes: &HashMap<usize, usize>,
) -> SceneFile {
    let mut out = file.clone();
    out.stages = None;
    out.assumptions = None;
    let impact = stage.impact.clone();
    let part = impact.as_ref();
    out.hinges = part.and_then(|p| p.hinges.clone());
    // Supports and strings stand behind the contacts, so that questions can name them; the stage takes them out again.
    let one_sided = part
        .iter()
        .flat_map(|p| [&p.supports, &p.strings])
        .flatten()
        .flat_map(|m| m.0.iter());
    let one_sided = one_sided.map(|(name, entry)| {
        let entry = entry.as_ref().map(|e| ContactFile {
            span: e.span,
            bodies: e.bodies.clone(),
            at: e.at.clone(),
            normal: Some(e.normal.clone()),
            law: None,
            restitution: None,
        });
        (name.clone(), entry)
    });
    let contacts = part
        .iter()
        .flat_map(|p| &p.contacts)
        .flat_map(|m| m.0.iter().cloned());
    out.contacts = Some(Map(contacts.chain(one_sided).collect()));
    out.blows = part.and_then(|p| p.blows.clone());
    out.after = part.and_then(|p| p.after.clone());
    let forces = file
        .forces
        .iter()
        .flatten()
        .chain(part.iter().flat_map(|p| p.forces.iter().flatten()));
    out.forces = Some(forces.cloned().collect());
    let all = file
        .questions
        .iter()
        .flat_map(|m| m.0.iter().cloned())
        .enumerate();
    out.questions = Some(Map(all
        .filter(|(k, _)| homes.get(k) == Some(&i))
        .map(|(_, q)| q)
        .collect()));
    out
}

type OneRead = (Option<Stage>, Option<Vec<Placed>>, Symbols, Vec<Fault>);

/// Reads one stage; gives also where the bodies are at its end.
fn one(
    file: &SceneFile,
    stage: &StageFile,
    from: Option<usize>,
    start: Option<Vec<Placed>>,
    whole: &Scene,
    symbols: Symbols,
) -> OneRead {
    let mut r = Resolver {
        file,
        symbols,
        faults: Vec::new(),
        claims: Vec::new(),
        points: super::resolve::names(file.points.as_ref()),
        bodies: super::resolve::names(Some(&file.bodies)),
        point_places: vec![Place::Untouched; file.points.as_ref().map_or(0, |m| m.0.len())],
        body_places: vec![Place::Untouched; file.bodies.0.len()],
        composites: HashMap::new(),
        chain: Vec::new(),
    };
    let mut scene = Scene {
        title: whole.title.clone(),
        source: whole.source.clone(),
        parameters: whole.parameters.clone(),
        domains: whole.domains.clone(),
        ..Scene::default()
    };
    if let Some(start) = &start {
        for (b, (center, _)) in start.iter().enumerate() {
            // First from the file, so that a composite finds its parts.
            r.center(b);
            r.body_places[b] = Place::Done(Some(center.clone()));
        }
        r.point_places.fill(Place::Untouched);
    }
    r.fill(&mut scene);
    if let Some(start) = &start {
        for (body, (_, angle)) in scene.bodies.iter_mut().zip(start) {
            body.angle = angle.clone();
        }
    }
    let starts = starts(&mut r, &scene, stage, from);
    let kind = kind(&mut r, &mut scene, stage);
    let end = kind.as_ref().map(|k| placed_after(&scene, k));
    // Motion before an impact is known only when the stages before it are worked out; the story checks it then.
    r.claims
        .retain(|c| !matches!(c.claim, Claim::Approach(_) | Claim::Hinge(_)));
    let Resolver {
        symbols,
        mut faults,
        claims,
        ..
    } = r;
    if faults.is_empty() {
        faults.extend(check(&mut scene, &claims));
    }
    let read = kind.map(|kind| Stage {
        name: stage.name.text.clone(),
        from,
        start: starts,
        kind,
        scene,
    });
    (read, end, symbols, faults)
}

/// Bodies that start otherwise.
fn starts(
    r: &mut Resolver<'_>,
    scene: &Scene,
    stage: &StageFile,
    from: Option<usize>,
) -> Vec<(usize, Option<Vector>, Option<Expr>)> {
    let Some(map) = &stage.start else {
        return Vec::new();
    };
    if from.is_some() {
        let fault = Fault::new(
            stage.name.span,
            "a stage that follows another takes over its motion",
        );
        r.faults
            .push(fault.hint("`start` belongs to a stage with \"from\": \"start\""));
        return Vec::new();
    }
    let mut out = Vec::new();
    for (name, entry) in entries(Some(map)) {
        let StartFile { velocity, spin, .. } = entry;
        let Some(b) = r.moving(name) else { continue };
        let spin = spin
            .as_ref()
            .and_then(|w| r.symbols.read(w, Quantity::SPIN, &mut r.faults));
        let turning = spin.clone().unwrap_or_else(|| scene.bodies[b].spin.clone());
        let velocity = match velocity {
            None => None,
            Some(VelocityFile::Components(v)) => {
                r.symbols.vector(v, Quantity::VELOCITY, &mut r.faults)
            }
            Some(VelocityFile::About(a)) => r
                .position(&a.about)
                .map(|p| geometry::turned(&turning, &minus(&scene.bodies[b].center, &p))),
        };
        out.push((b, velocity, spin));
    }
    out
}

fn kind(r: &mut Resolver<'_>, scene: &mut Scene, stage: &StageFile) -> Option<StageKind> {
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

/// Where all bodies are at the end of a stage.
fn placed_after(scene: &Scene, kind: &StageKind) -> Vec<Placed> {
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

/// All questions, in the order of the file.
fn questions(
    base: &mut Resolver<'_>,
    scene: &Scene,
    story: &mut Story,
    homes: &HashMap<usize, usize>,
) {
    let file = base.file;
    let Some(stages) = &file.stages else { return };
    let mut names: Vec<String> = Vec::new();
    for (k, (name, entry)) in file.questions.iter().flat_map(|m| &m.0).enumerate() {
        let Some(q) = entry else { continue };
        if scene.parameters.iter().any(|p| *p.name == *name.text) {
            let message = format!(
                "the question `{0}` has the name of the parameter `{0}`",
                name.text
            );
            base.faults.push(
                Fault::new(name.span, message)
                    .hint("what is asked and what is given need different names"),
            );
        }
        let ask = match homes.get(&k) {
            Some(stage) => {
                let found = story.stages[*stage]
                    .scene
                    .questions
                    .iter()
                    .position(|s| s.name == name.text);
                found.map(|question| StoryAsk::Quantity {
                    stage: *stage,
                    question,
                })
            }
            None => {
                let symbols = base.symbols.extended(names.iter().map(String::as_str));
                let ask = story_ask(base, &symbols, stages, name, q);
                for used in symbols.used() {
                    base.symbols.mark_used(&used);
                }
                ask
            }
        };
        if let Some(ask) = ask {
            story.questions.push(StoryQuestion {
                name: name.text.clone(),
                latex: q.latex.as_ref().map(|t| t.text.clone()),
                ask,
            });
        }
        for suffix in ["", "_x", "_y"] {
            names.push(format!("{}{suffix}", name.text));
        }
    }
}

fn story_ask(
    base: &mut Resolver<'_>,
    symbols: &Symbols,
    stages: &[StageFile],
    name: &Text,
    q: &QuestionFile,
) -> Option<StoryAsk> {
    let kinds = [
        ("value", q.value.is_some()),
        ("threshold", q.threshold.is_some()),
        ("solve", q.solve.is_some()),
        ("maximum", q.maximum.is_some()),
        ("limit", q.limit.is_some()),
        ("approximate", q.approximate.is_some()),
        ("show", q.show.is_some()),
        ("reaction", q.reaction.is_some()),
        ("angular_momentum", q.angular_momentum.is_some()),
        ("share", q.share.is_some()),
        ("impulsive", q.impulsive.is_some()),
        ("describe", q.describe.is_some()),
        ("missing", q.missing.is_some()),
        ("remark", q.remark.is_some()),
        ("assumed", q.assumed.is_some()),
        ("unused", q.unused.is_some()),
    ];
    let asked: Vec<&str> = kinds.iter().filter(|k| k.1).map(|k| k.0).collect();
    if asked.len() != 1 {
        let message = match asked.len() {
            0 => String::from("this question asks nothing"),
            n => format!("this question asks {n} things: {}", asked.join(", ")),
        };
        let all: Vec<&str> = kinds.iter().map(|k| k.0).collect();
        let hint = format!(
            "give one of velocity, spin, impulse, energy, {}",
            all.join(", ")
        );
        base.faults.push(Fault::new(name.span, message).hint(hint));
        return None;
    }
    let at_end = q.when != Some(EndName::Start);
    if special::is_asked(q) {
        return special::ask(base, symbols, name, q);
    }
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
        return Some(StoryAsk::Reaction {
            stage: i,
            along: base.direction(along)?,
            at_end,
        });
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
        return Some(StoryAsk::AngularMomentum {
            stage: i,
            body: base.moving(body)?,
            about: base.position(about)?,
            at_end,
        });
    }
    if let Some(share) = &q.share {
        return Some(StoryAsk::Share {
            mass: symbols.read(&share.mass, Quantity::MASS, &mut base.faults)?,
            stiffness: symbols.read(&share.stiffness, STIFFNESS, &mut base.faults)?,
            during: symbols.read(&share.during, TIME, &mut base.faults)?,
        });
    }
    if let Some(words) = &q.remark {
        return Some(StoryAsk::Remark(words.text.clone()));
    }
    let mut stage = |name: &Text| stage_named(&mut base.faults, stages, Some(name));
    if let Some(text) = &q.impulsive {
        return Some(StoryAsk::Impulsive {
            stage: stage(text)?,
        });
    }
    if let Some(text) = &q.describe {
        return Some(StoryAsk::Describe {
            stage: stage(text)?,
        });
    }
    if let Some(text) = &q.missing {
        return Some(StoryAsk::Missing {
            stage: stage(text)?,
        });
    }
    if let Some(of) = &q.unused {
        let names = symbols
            .names()
            .declared()
            .iter()
            .map(|d| d.name.to_string());
        if !names.clone().any(|n| n == of.text)
            || special::parameter_names(base.file).contains(&of.text.as_str())
        {
            base.faults.push(Fault::new(
                of.span,
                format!("no earlier answer is called `{}`", of.text),
            ));
            return None;
        }
        return Some(StoryAsk::Unused(of.text.clone()));
    }
    Some(StoryAsk::Assumed)
}
