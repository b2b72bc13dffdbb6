//! What is asked: each question of the file becomes one [`Ask`], or a fault that says what is missing.
//!
//! One table of kinds, [`KINDS`], serves scenes of one impact and scenes with stages. Questions about answers are read when
//! the names of all answers before them are known.

pub(super) mod answers;
mod impact;
mod motion;
pub(super) mod order;
mod told;
mod turn;

use std::collections::HashMap;

use answers::Reader;

use super::fault::{Fault, Span};
use super::file::SceneFile;
use super::formulas::Symbols;
use super::parameters::spelling;
use super::question_file::QuestionFile;
use super::record::entries;
use super::record::{Formula, Map, Text, is_sound};
use super::resolver::Resolver;
use super::stage_file::EndName;
use super::{Ask, Question, Scene};
use crate::dimension::Dimension;
use crate::formula::{latex_name, with_subscript};

/// What a kind of question is about.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum About {
    /// The motion just after an impact or at the end of a stage, its impulses and equations.
    Motion,
    /// What a formula of the geometry and of that motion tells.
    Told,
    /// A stage, or all of them.
    Stage,
    /// The answers to other questions.
    Answers,
}

/// A kind of question.
pub(super) struct Kind {
    /// The field that asks it.
    pub name: &'static str,
    pub about: About,
    given: fn(&QuestionFile) -> bool,
    /// Fields that belong to it.
    fields: &'static [&'static str],
}

/// Kinds of question with the fields that belong to each.
macro_rules! kinds {
    ($($about:ident { $($name:ident($($field:ident)*),)* })*) => {
        &[$($(Kind {
            name: stringify!($name),
            about: About::$about,
            given: |q| q.$name.is_some(),
            fields: &[$(stringify!($field)),*],
        },)*)*]
    };
}

/// All of them, in the order in which hints name them.
static KINDS: &[Kind] = kinds! {
    Motion {
        velocity(of along when at),
        spin(clockwise when at),
        impulse(on along at),
        energy(of at),
        balance(system along at),
        matrix(unknowns at),
    }
    Told {
        speed(of when at),
        direction(of clockwise when at),
        angular_momentum(about when at),
        inertia(about),
        instantaneous_center(at),
    }
    Answers {
        value(with),
        solve(holds with),
        threshold(holds with at),
        maximum(over),
        minimum(over),
        limit(tends to),
        approximate(tends to order),
        show(with unless claim),
    }
    Stage {
        time(),
        distance(),
        acceleration(of along when at),
        angular_acceleration(clockwise when at),
        tension(at),
        angle(clockwise at),
        position(along when at),
        reaction(along when),
        turn(of total),
        share(),
        impulsive(),
        describe(),
        missing(),
        remark(),
        assumed(),
        unused(),
    }
};

/// The kinds that a question asks; one, if it is right.
fn kinds(q: &QuestionFile) -> impl Iterator<Item = &'static Kind> {
    KINDS.iter().filter(|kind| (kind.given)(q))
}

/// Whether a question asks something of this sort.
pub(super) fn asks(q: &QuestionFile, about: About) -> bool {
    kinds(q).any(|kind| kind.about == about)
}

/// The dimension of the number, or of the components, that a question about motion asks for; `None` where only the answer
/// tells.
pub(super) fn dimension(q: &QuestionFile) -> Option<Dimension> {
    let [mass, length, time] = match kinds(q).next()?.name {
        "velocity" | "speed" => [0, 1, -1],
        "spin" => [0, 0, -1],
        "impulse" => [1, 1, -1],
        "energy" => [1, 2, -2],
        "time" => [0, 0, 1],
        "distance" | "position" => [0, 1, 0],
        "acceleration" => [0, 1, -2],
        "angular_acceleration" => [0, 0, -2],
        "tension" => [1, 1, -2],
        "angle" | "direction" => [0, 0, 0],
        _ => return None,
    };
    Some(Dimension::new(mass, length, time))
}

/// Fields that belong to some kinds of question only, and whether they are given.
fn fields(q: &QuestionFile) -> impl Iterator<Item = (&'static str, bool)> {
    macro_rules! given {
        ($($field:ident)*) => { [$((stringify!($field), q.$field.is_some())),*] };
    }
    given!(at of along clockwise on system unknowns when about with holds over tends to order unless claim total)
        .into_iter()
}

/// The kind of a question, or what is wrong with one that asks nothing, several things, or has fields of another kind.
fn kind(r: &mut Resolver<'_>, name: &Text, q: &QuestionFile) -> Option<&'static Kind> {
    let asked: Vec<&Kind> = kinds(q).collect();
    let names = |kinds: &mut dyn Iterator<Item = &Kind>| {
        let names: Vec<&str> = kinds.map(|kind| kind.name).collect();
        names.join(", ")
    };
    let [one] = asked.as_slice() else {
        // What is there but could not be read has been reported.
        if asked.is_empty() && !is_sound(q.span, &r.faults) {
            return None;
        }
        let (message, hint) = if asked.is_empty() {
            let staged = r.file.stages.is_some();
            let mut fit = KINDS.iter().filter(|k| staged || k.about != About::Stage);
            (
                String::from("this question asks nothing"),
                format!("give one of {}", names(&mut fit)),
            )
        } else {
            let all = names(&mut asked.iter().copied());
            (
                format!("this question asks {} things: {all}", asked.len()),
                String::from("give each of them a question of its own"),
            )
        };
        return r.refuse(name.span, message, hint);
    };
    for (field, given) in fields(q) {
        if given && !one.fields.contains(&field) {
            let message = format!("a question that asks `{}` has no `{field}`", one.name);
            let fields: Vec<String> = one.fields.iter().map(|f| format!("`{f}`")).collect();
            const OF_STAGES: &str = "time distance reaction impulsive describe missing";
            let hint = match field {
                "at" if OF_STAGES.split(' ').any(|of| of == one.name) => {
                    format!("`{}` itself names the stage", one.name)
                }
                _ if fields.is_empty() => String::from("it stands alone"),
                _ => format!("beside it may stand {}", fields.join(", ")),
            };
            r.faults.push(Fault::new(name.span, message).hint(hint));
        }
    }
    Some(one)
}

/// Reads what is asked of one impact: of its motion, and what formulas of the geometry and of that motion tell.
pub(super) fn of_impact(r: &mut Resolver<'_>, scene: &mut Scene) {
    let file = r.file;
    let mut told = Vec::new();
    for (name, q) in entries(file.questions.as_ref()) {
        name_is_free(r, name, q);
        let Some(kind) = kind(r, name, q) else {
            continue;
        };
        match kind.about {
            About::Motion if q.when != Some(EndName::Start) => {
                if let Some(ask) = impact::ask(r, scene, name, q) {
                    scene.questions.push(question(name, q, ask));
                }
            }
            About::Motion | About::Told => told.push((name, q, kind.name)),
            About::Stage => {
                let message = format!(
                    "`{}` is asked of a stage, and this scene has none",
                    kind.name
                );
                let hint = "what moves before or after the impact is a stage of its own: put it and the impact into `stages`";
                r.faults.push(Fault::new(name.span, message).hint(hint));
            }
            // Read when all of these are known.
            About::Answers => {}
        }
    }
    for (name, q, kind) in told {
        told::resolve(r, scene, name, q, kind);
    }
    for (name, q) in entries(file.questions.as_ref()) {
        impact::matrix_names(r, scene, name, q);
    }
}

/// Reads what is asked about the answers of one impact.
pub(super) fn of_answers(r: &mut Resolver<'_>, scene: &mut Scene) {
    let names = scene.questions.iter();
    let names: Vec<String> = names.flat_map(|q| names_of(&q.name, &q.ask)).collect();
    let mut symbols = None;
    for (name, q) in entries(r.file.questions.as_ref()) {
        if let Some(at) = &q.at {
            let message = "`at` names a stage, and this scene has none";
            let fault = Fault::new(at.span, message);
            let bodies = [
                ("velocity", &q.velocity),
                ("speed", &q.speed),
                ("direction", &q.direction),
            ];
            let body = bodies
                .iter()
                .find_map(|(asked, body)| Some((asked, &body.as_ref()?.text)));
            r.faults.push(match body {
                Some((asked, body)) => fault.hint(format!(
                    "a point of `{body}` is named in place of it: \"{asked}\": \"{}\", \"of\": \"{body}\"",
                    at.text
                )),
                None => fault,
            });
        }
        if !asks(q, About::Answers) {
            continue;
        }
        // Most scenes ask nothing of this sort, and need no table of these names.
        let symbols = symbols.get_or_insert_with(|| r.symbols.extended(&names));
        let ask = with_names(r, symbols, |base| Reader { base, symbols }.ask(name, q));
        if let Some(ask) = ask {
            scene.questions.push(question(name, q, ask));
        }
        if !is_own(name, q) {
            symbols.add(&name.text, &["", "_x", "_y", "_at"]);
        }
    }
}

/// Reads all questions of a scene with stages, in the order of the file; `homes` are the stages of those about motion, by
/// index of question.
pub(super) fn of_stages(r: &mut Resolver<'_>, scene: &mut Scene, homes: &HashMap<usize, usize>) {
    let file = r.file;
    let mut symbols = r.symbols.extended(&[]);
    for (k, (name, entry)) in file.questions.iter().flat_map(|m| &m.0).enumerate() {
        let Some(q) = entry else { continue };
        name_is_free(r, name, q);
        let Some(kind) = kind(r, name, q) else {
            continue;
        };
        let found = match homes.get(&k) {
            Some(stage) => {
                let mut own = scene.stages[*stage].scene.questions.iter();
                let found = own.find(|s| s.name == name.text);
                found.map(|q| (Some(*stage), q.ask.clone()))
            }
            None => with_names(r, &symbols, |base| match kind.about {
                About::Answers => {
                    let symbols = &symbols;
                    let ask = Reader { base, symbols }.ask(name, q)?;
                    Some((answers::stage_of(file, q, &ask), ask))
                }
                _ => motion::ask(base, &symbols, scene, name, q),
            }),
        };
        if let Some((stage, ask)) = found {
            if let (Some(stage), Ask::Friction { .. }) = (stage, &ask) {
                // What its contact feels shows when the impact is worked out.
                let asked = question(name, q, ask.clone());
                scene.stages[stage].scene.questions.push(asked);
            }
            scene.questions.push(Question {
                stage,
                ..question(name, q, ask)
            });
        }
        if !is_own(name, q) {
            symbols.add(&name.text, &["", "_x", "_y"]);
        }
    }
    turn::live(scene);
}

fn question(name: &Text, q: &QuestionFile, ask: Ask) -> Question {
    Question::new(&name.text, q.latex.as_ref().map(|t| t.text.clone()), ask)
}

/// The same file where in a scene with stages that from which something is put together stands before it, under names of its
/// own: of a speed or a direction the velocity, of an instantaneous center the velocity, the spin and the place of the body.
pub(super) fn with_parts(file: &SceneFile) -> Option<SceneFile> {
    let asked = entries(file.questions.as_ref());
    let names = |q: &QuestionFile| kinds(q).map(|kind| kind.name).collect::<Vec<_>>();
    let parted = |q: &QuestionFile| {
        matches!(
            names(q)[..],
            ["speed" | "direction" | "instantaneous_center"]
        )
    };
    if file.stages.is_none() || !asked.into_iter().any(|(_, q)| parted(q)) {
        return None;
    }
    let mut out = file.clone();
    let mut all: Vec<Entry> = Vec::new();
    for (name, entry) in file.questions.iter().flat_map(|m| &m.0) {
        match entry.as_ref().filter(|q| parted(q)) {
            Some(q) if q.instantaneous_center.is_none() => {
                if velocity_asked(all.iter(), q).is_none() {
                    all.push(velocity_of(name, q));
                }
                all.push((name.clone(), entry.clone()));
            }
            Some(q) => {
                let parts = parts_of_center(&all, name, q);
                all.extend(parts);
            }
            None => all.push((name.clone(), entry.clone())),
        }
    }
    out.questions = Some(Map(all, Span::default()));
    Some(out)
}

type Entry = (Text, Option<QuestionFile>);

fn own_name(name: &Text, suffix: &str) -> Text {
    Text {
        span: name.span,
        text: format!("{}{suffix}", name.text),
    }
}

/// Name of the question, among these, that asks for the whole velocity of which a speed or a direction is made.
fn velocity_asked<'a>(
    mut asked: impl Iterator<Item = &'a Entry>,
    q: &QuestionFile,
) -> Option<&'a Text> {
    let body = q.speed.as_ref().or(q.direction.as_ref())?;
    let text = |t: &Option<Text>| t.as_ref().map(|t| t.text.clone());
    let is_same = |e: &QuestionFile| {
        let is_whole =
            e.along.is_none() && e.velocity.as_ref().is_some_and(|b| b.text == body.text);
        is_whole
            && e.when == q.when
            && [(&e.at, &q.at), (&e.of, &q.of)].map(|(a, b)| text(a) == text(b)) == [true; 2]
    };
    let found = asked.find(|(_, entry)| entry.as_ref().is_some_and(is_same));
    found.map(|(name, _)| name)
}

/// The velocity of a speed, whose letter it bears, or of a direction.
fn velocity_of(name: &Text, q: &QuestionFile) -> Entry {
    let latex = match &q.latex {
        Some(latex) => latex.text.clone(),
        None => latex_name(&name.text),
    };
    let text = match &q.speed {
        Some(_) => format!("\\vec{{{latex}}}"),
        None => format!("\\vec{{v}}_{{{latex}}}"),
    };
    let velocity = QuestionFile {
        latex: Some(Text {
            span: name.span,
            text,
        }),
        velocity: q.speed.clone().or_else(|| q.direction.clone()),
        speed: None,
        direction: None,
        clockwise: None,
        ..q.clone()
    };
    (own_name(name, "_velocity"), Some(velocity))
}

/// The instantaneous center by its coordinates: with v = ω k × (G − C), it lies v/ω to the left of the motion of the center
/// of mass G. What it is put together from is asked before it, unless it has been.
fn parts_of_center(earlier: &[Entry], name: &Text, q: &QuestionFile) -> Vec<Entry> {
    let body = &q.instantaneous_center;
    let is_at = |asked: &Option<Text>| match (asked, &q.at) {
        (Some(asked), Some(at)) => asked.text == at.text,
        (asked, at) => asked.is_none() && at.is_none(),
    };
    let is_body = |asked: &Option<Text>| match (asked, body) {
        (Some(asked), Some(body)) => asked.text == body.text,
        _ => false,
    };
    let whole = |q: &QuestionFile| is_at(&q.at) && q.along.is_none() && q.of.is_none();
    let bare = QuestionFile {
        instantaneous_center: None,
        latex: None,
        ..q.clone()
    };
    let mut out = Vec::new();
    let mut part = |suffix, letter: &str, is: &dyn Fn(&QuestionFile) -> bool, q: QuestionFile| {
        let found = earlier
            .iter()
            .find(|(_, e)| e.as_ref().is_some_and(|e| whole(e) && is(e)));
        if let Some((found, _)) = found {
            return found.text.clone();
        }
        let own = own_name(name, suffix);
        let latex = Some(Text {
            span: name.span,
            text: with_subscript(letter, &latex_name(&name.text)),
        });
        let text = own.text.clone();
        out.push((own, Some(QuestionFile { latex, ..q })));
        text
    };
    let velocity = QuestionFile {
        velocity: body.clone(),
        ..bare.clone()
    };
    let v = part("_velocity", "v", &|q| is_body(&q.velocity), velocity);
    let spin = QuestionFile {
        spin: body.clone(),
        ..bare.clone()
    };
    let counts_up = |q: &QuestionFile| is_body(&q.spin) && q.clockwise != Some(true);
    let w = part("_spin", "\\omega", &counts_up, spin);
    let place = QuestionFile {
        position: body.clone(),
        ..bare.clone()
    };
    let r = part("_from", "r", &|q| is_body(&q.position), place);
    for (axis, text) in [
        ("x", format!("{r}_x - {v}_y/{w}")),
        ("y", format!("{r}_y + {v}_x/{w}")),
    ] {
        let subscript = |latex: &Text| Text {
            span: latex.span,
            text: with_subscript(&latex.text, axis),
        };
        let value = QuestionFile {
            at: None,
            latex: q.latex.as_ref().map(subscript),
            value: Some(Formula {
                span: name.span,
                text,
                start: None,
            }),
            ..bare.clone()
        };
        out.push((own_name(name, &format!("_{axis}")), Some(value)));
    }
    out
}

/// What the coordinates of such a point mean.
pub const INSTANTANEOUS_CENTER: &str = "instantaneous center";

/// Says of the coordinates that an instantaneous center is put together from what they are.
pub(super) fn name_centers(file: &SceneFile, scene: &mut Scene) {
    for (name, q) in entries(file.questions.as_ref()) {
        let Some(body) = &q.instantaneous_center else {
            continue;
        };
        for question in &mut scene.questions {
            let axis = question.name.strip_prefix(&name.text);
            if let (Some("_x" | "_y"), Ask::Value { meaning, .. }) = (axis, &mut question.ask) {
                *meaning = format!("{INSTANTANEOUS_CENTER} of `{}`", body.text);
            }
        }
    }
}

/// A question and a parameter need different names, unless that parameter is what is sought; and no two names are one symbol.
fn name_is_free(r: &mut Resolver<'_>, name: &Text, q: &QuestionFile) {
    let asked = entries(r.file.questions.as_ref()).map(|(asked, _)| asked.text.as_str());
    let before = asked.take_while(|asked| *asked != name.text);
    let mut others = answers::parameter_names(r.file).into_iter().chain(before);
    let is_same = |other: &&str| spelling(other) == spelling(&name.text);
    let Some(other) = others.find(|o| is_same(o) && !(is_own(name, q) && *o == name.text)) else {
        return parts_are_free(r, name, q);
    };
    let (name, span) = (&name.text, name.span);
    let message = match other == name {
        true => format!("the question `{name}` has the name of the parameter `{name}`"),
        false => format!("`{name}` and `{other}` are one symbol in formulas"),
    };
    let hint = "what is asked and what is given need different names; only a `solve` or `threshold` may bear the name of the parameter it seeks";
    r.report(span, message, hint);
}

/// The names that the components of an answer get, or the place of a largest or least value, are no names of parameters or of other
/// answers.
fn parts_are_free(r: &mut Resolver<'_>, name: &Text, q: &QuestionFile) {
    let parts = |name: &Text, q: &QuestionFile| {
        let suffixes: &[&str] = match kinds(q).next().map(|kind| kind.name) {
            Some("velocity" | "impulse" | "position") if q.along.is_none() => &["_x", "_y"],
            Some("instantaneous_center") => &["_x", "_y"],
            Some("maximum" | "minimum") => &["_at"],
            _ => &[],
        };
        let each = suffixes.iter();
        each.map(|part| format!("{}{part}", name.text))
            .collect::<Vec<_>>()
    };
    let own = parts(name, q);
    let mut given = answers::parameter_names(r.file).into_iter();
    let taken = given.find(|given| own.iter().any(|part| part == given));
    let mut asked = entries(r.file.questions.as_ref());
    let message = if let Some(given) = taken {
        let name = &name.text;
        format!("a part of the answer `{name}` has the name of the parameter `{given}`")
    } else if let Some((of, _)) = asked.find(|(of, q)| parts(of, q).contains(&name.text)) {
        let (name, of) = (&name.text, &of.text);
        format!("`{name}` is the name of a part of the answer `{of}` too")
    } else {
        return;
    };
    r.report(name.span, message, "take another name for one of the two");
}

/// Whether a question is answered by the parameter whose name it has: `"d": {"solve": "d", …}`. Its answer has no name for
/// later formulas, in which the name stands for the parameter.
fn is_own(name: &Text, q: &QuestionFile) -> bool {
    let sought = q.solve.as_ref().or(q.threshold.as_ref());
    sought.is_some_and(|sought| sought.text == name.text)
}

/// Reads a question with symbols for earlier answers beside the parameters.
fn with_names<T>(
    r: &mut Resolver<'_>,
    symbols: &Symbols,
    read: impl FnOnce(&mut Resolver<'_>) -> Option<T>,
) -> Option<T> {
    let earlier = r.faults.len();
    let found = read(r);
    for used in symbols.used() {
        r.symbols.mark_used(&used);
    }
    if r.faults.len() == earlier {
        return found;
    }
    let questions = r.file.questions.iter().flat_map(|m| &m.0);
    let in_a_circle = questions.map(|(name, _)| {
        let hint = format!(
            "`{name}` is asked, and needs this one; no formula takes an answer that rests on it",
            name = name.text
        );
        (&name.text, hint)
    });
    let stages = r.file.stages.iter().flatten();
    let of_stages = stages.map(|stage| &stage.name.text).map(|stage| {
        let hint = format!("`{stage}` is a stage; ask for its `distance` or `time` in a question above, and name that one here");
        (stage, hint)
    });
    for (name, hint) in in_a_circle.chain(of_stages) {
        let open = format!("`{name}` is not declared");
        for fault in r.faults[earlier..].iter_mut().filter(|f| f.message == open) {
            fault.hint = Some(hint.clone());
        }
    }
    found
}

/// Names under which the answer to a question about motion stands in formulas.
pub(super) fn names_of(name: &str, ask: &Ask) -> Vec<String> {
    match ask {
        Ask::Velocity { along: None, .. } | Ask::Impulse { along: None, .. } => ["", "_x", "_y"]
            .map(|suffix| format!("{name}{suffix}"))
            .to_vec(),
        Ask::Balance { .. } | Ask::Matrix { .. } => Vec::new(),
        _ => vec![name.to_string()],
    }
}
