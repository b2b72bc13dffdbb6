//! A scene followed stage by stage in numbers, for the terminal and as data.

use std::fmt::Write;

use serde_json::{Map, Value, json};

use crate::expr::Point;
use crate::numeric::follow::{
    BodyState, Breach, Component, Followed, Impact, Impulse, Loss, Lost, Moved, Passed, Unanswered,
    What, answer, named,
};
use crate::numeric::given::Freedom;
use crate::scene::{Ask, Scene};

/// Names of the components of a body's state, with their units.
const COMPONENTS: [(&str, &str); 6] = [
    ("x", "m"),
    ("y", "m"),
    ("angle", "rad"),
    ("v_x", "m/s"),
    ("v_y", "m/s"),
    ("spin", "rad/s"),
];

/// The numbers of every stage, then the answers.
pub fn text(scene: &Scene, followed: &Followed, at: &Point<f64>) -> String {
    let mut out = String::new();
    for (stage, found) in scene.stages.iter().zip(&followed.stages) {
        let kind = stage.kind.word();
        let _ = match found {
            Ok(passed) => {
                let time = match (&passed.time, &passed.what) {
                    (_, What::Impact(_)) => String::new(),
                    (Ok(time), _) => format!(", {} s", super::digits(*time)),
                    (Err(_), _) => ", time open".into(),
                };
                let body = stage_text(followed, passed);
                writeln!(out, "{} ({kind}{time})\n{body}", stage.name)
            }
            Err(lost) => writeln!(out, "{} ({kind})\n  {lost}\n", stage.name),
        };
    }
    let mut formulas = Vec::new();
    for (name, ask, value) in answers(scene, followed, at) {
        let _ = match value {
            Some(Ok(value)) => writeln!(out, "{name} = {}", super::answered(scene, ask, value)),
            Some(Err(reason)) => writeln!(out, "{name}: {reason}"),
            None => {
                formulas.push(name);
                Ok(())
            }
        };
    }
    if !formulas.is_empty() {
        let names = formulas.join(", ");
        let _ = writeln!(
            out,
            "no numbers of the motion (`carom derive` tells them): {names}"
        );
    }
    out
}

fn stage_text(followed: &Followed, passed: &Passed) -> String {
    let mut open: Vec<String> = Vec::new();
    let mut number = |c: &Component, largest: f64| match c {
        // What is left of sums that cancel is no number to show.
        Ok(value) if value.abs() < 1e-12 * largest => "0".into(),
        Ok(value) => super::digits(*value),
        Err(reason) => {
            let reason = reason.to_string();
            if !open.contains(&reason) {
                open.push(reason);
            }
            "open".into()
        }
    };
    let mut rows = vec![
        ["", ""]
            .into_iter()
            .map(String::from)
            .chain(COMPONENTS.map(|(name, unit)| format!("{name} [{unit}]")))
            .collect::<Vec<String>>(),
    ];
    for (b, solid) in followed.solids.iter().enumerate() {
        if solid.freedom == Freedom::Fixed {
            continue;
        }
        for (state, when, name) in [
            (&passed.before, "before", solid.name.as_str()),
            (&passed.after, "after", ""),
        ] {
            let mut row = vec![name.to_string(), when.to_string()];
            for (k, c) in state.bodies[b].components().into_iter().enumerate() {
                let is_told = solid.freedom == Freedom::Rigid || !matches!(k, 2 | 5);
                let largest = largest(&like(passed, k));
                row.push(if is_told {
                    number(c, largest)
                } else {
                    String::new()
                });
            }
            rows.push(row);
        }
    }
    let mut out = String::new();
    for line in super::columns(&rows, |j| j > 1) {
        let _ = writeln!(out, "  {}", line.trim_end());
    }
    match &passed.what {
        What::Impact(impact) => {
            let all: Vec<&Component> = impulses(impact).flat_map(|p| &p.impulse).collect();
            for p in impulses(impact) {
                let on = &followed.solids[p.on].name;
                let [x, y] = [0, 1].map(|k| number(&p.impulse[k], largest(&all)));
                let _ = writeln!(out, "  impulse of {} on {on}: ({x}, {y}) N s", p.name);
            }
            out.push_str(&acting(impact));
            for breach in &impact.breaches {
                let _ = writeln!(out, "  not possible: {}", breach_words(breach));
            }
        }
        What::Motion(moved) => {
            if let Some([begin, end]) = &moved.reaction {
                let all = [&begin[0], &begin[1], &end[0], &end[1]];
                let [a, b, c, d] = all.map(|c| number(c, largest(&all)));
                let of = match moved.clockwise {
                    Some(_) => "the fixed point",
                    None => "the surface or guide",
                };
                let _ = writeln!(
                    out,
                    "  force of {of}: ({a}, {b}) N at the beginning, ({c}, {d}) N at the end"
                );
            }
            for (name, when) in pulls(moved) {
                let _ = writeln!(
                    out,
                    "  taken for granted: {name} grips: it pulls at the {when}"
                );
            }
        }
    }
    for pair in &passed.passing {
        let [a, b] = pair.map(|b| &followed.solids[b].name);
        let _ = writeln!(
            out,
            "  not possible: {a} and {b} pass through each other on the way"
        );
    }
    let all = [&passed.energy[0], &passed.energy[1]];
    let [before, after] = all.map(|c| number(c, largest(&all)));
    let _ = writeln!(out, "  kinetic energy: {before} J before, {after} J after");
    for reason in open {
        let _ = writeln!(out, "  open: {reason}");
    }
    out
}

/// Components of the same kind as the k-th one, of all bodies before and after.
fn like(passed: &Passed, k: usize) -> Vec<&Component> {
    let bodies = passed.before.bodies.iter().chain(&passed.after.bodies);
    let same: &[usize] = match k {
        0 | 1 => &[0, 1],
        3 | 4 => &[3, 4],
        2 => &[2],
        _ => &[5],
    };
    bodies
        .flat_map(|b| same.iter().map(|k| b.components()[*k]))
        .collect()
}

fn largest(all: &[&Component]) -> f64 {
    let known = all.iter().filter_map(|c| c.as_ref().ok());
    known.fold(0.0, |a: f64, v| a.max(v.abs()))
}

fn acting(impact: &Impact) -> String {
    let words = |set: &Vec<String>| match set.is_empty() {
        true => String::from("none"),
        false => set.join(" and "),
    };
    match impact.acting.as_slice() {
        [only] if only.is_empty() => String::new(),
        [only] => format!("  supports and strings that act: {}\n", words(only)),
        several => {
            let all: Vec<String> = several.iter().map(words).collect();
            format!(
                "  supports and strings that may act: {}\n",
                all.join(", or ")
            )
        }
    }
}

fn impulses(impact: &Impact) -> impl Iterator<Item = &Impulse> {
    let all = impact.contacts.iter().chain(&impact.hinges);
    all.chain(&impact.blows)
}

/// The contacts that have to pull what turns about them, and when.
fn pulls(moved: &Moved) -> impl Iterator<Item = (&String, &'static str)> {
    let ends = moved.pulls.iter().zip(["beginning", "end"]);
    ends.filter_map(|(name, when)| Some((name.as_ref()?, when)))
}

fn breach_words(breach: &Breach) -> String {
    match breach {
        Breach::Separates(name) => format!("the bodies move apart at {name} before they touch"),
        Breach::Pulls(name) => format!("the impulse at {name} has the wrong direction"),
        Breach::Enters(name) => {
            format!("the bodies go on into each other at {name}, or a string gets longer")
        }
        Breach::Gone(name) => {
            format!("the wall that is struck at {name} has moved on since it was struck before")
        }
    }
}

/// A value, or why it is open; nothing where the question is about formulas.
type Number = Option<Result<f64, String>>;

/// Name, question and value of every answer.
fn answers<'s>(
    scene: &'s Scene,
    followed: &Followed,
    at: &Point<f64>,
) -> Vec<(String, &'s Ask, Number)> {
    let mut out = Vec::new();
    for question in &scene.questions {
        let name = &question.name;
        let found = answer(scene, followed, question, at);
        let ask = &question.ask;
        match found {
            Ok(found) => {
                let parts = found.components().into_iter();
                out.extend(parts.map(|(part, v)| (format!("{name}{part}"), ask, Some(Ok(v)))));
            }
            Err(Unanswered::NotANumber) => {
                let value = named(scene, followed, &name.as_str().into(), at);
                out.push((name.clone(), ask, value.map(Ok)));
            }
            Err(reason) => out.push((name.clone(), ask, Some(Err(reason.to_string())))),
        }
    }
    out
}

/// The same as data.
pub fn json(scene: &Scene, followed: &Followed, at: &Point<f64>) -> Value {
    let stages = scene.stages.iter().zip(&followed.stages);
    let stages: Vec<Value> = stages
        .map(|(stage, found)| {
            let mut out = Map::new();
            out.insert("name".into(), json!(stage.name));
            out.insert("kind".into(), json!(stage.kind.word()));
            let during = stage.during.as_ref();
            out.extend(during.map(|d| ("during".into(), json!(d.name))));
            match found {
                Ok(passed) => stage_json(followed, passed, &mut out),
                Err(lost) => {
                    out.insert("lost".into(), json!(lost_kind(lost)));
                    out.insert("reason".into(), json!(lost.to_string()));
                }
            }
            Value::Object(out)
        })
        .collect();
    let answers = answers(scene, followed, at);
    let answers = answers.into_iter().map(|(name, ask, value)| {
        let unit = scene.unit_of(ask);
        match value.unwrap_or_else(|| Err(Unanswered::NotANumber.to_string())) {
            Ok(value) => json!({"name": name, "value": value, "unit": unit}),
            Err(reason) => {
                json!({"name": name, "value": Value::Null, "unit": unit, "reason": reason})
            }
        }
    });
    json!({
        "title": scene.title,
        "source": scene.source,
        "stages": stages,
        "answers": answers.collect::<Vec<Value>>(),
    })
}

fn lost_kind(lost: &Lost) -> &'static str {
    match lost.why {
        Loss::Contradiction(_) => "contradiction",
        Loss::NeverEnds(_) => "never ends",
        Loss::OutOfReach(_) => "not followed",
        Loss::Undefined(_) => "no value",
        Loss::After(_) => "after one that was lost",
    }
}

fn stage_json(followed: &Followed, passed: &Passed, out: &mut Map<String, Value>) {
    out.insert("time".into(), component(&passed.time));
    let bodies = followed.solids.iter().enumerate().map(|(b, solid)| {
        json!({
            "name": solid.name,
            "mass": solid.mass,
            "inertia": solid.inertia,
            "before": body_json(&passed.before.bodies[b]),
            "after": body_json(&passed.after.bodies[b]),
        })
    });
    out.insert("bodies".into(), bodies.collect());
    let [before, after] = &passed.energy;
    let energy = json!({"before": component(before), "after": component(after)});
    out.insert("kinetic_energy".into(), energy);
    let passing = passed.passing.iter();
    let passing = passing.map(|pair| json!(pair.map(|b| &followed.solids[b].name)));
    out.insert("pass_through_each_other".into(), passing.collect());
    match &passed.what {
        What::Impact(impact) => impact_json(followed, impact, out),
        What::Motion(moved) => motion_json(followed, moved, out),
    }
}

fn impact_json(followed: &Followed, impact: &Impact, out: &mut Map<String, Value>) {
    let all = impulses(impact).map(|p| {
        json!({
            "name": p.name,
            "on": followed.solids[p.on].name,
            "x": component(&p.impulse[0]),
            "y": component(&p.impulse[1]),
        })
    });
    out.insert("impulses".into(), all.collect());
    out.insert("acting".into(), json!(impact.acting));
    let openings = impact.openings.iter().map(
        |o| json!({"name": o.name, "before": component(&o.before), "after": component(&o.after)}),
    );
    out.insert("opening_speeds".into(), openings.collect());
    let breaches: Vec<String> = impact.breaches.iter().map(breach_words).collect();
    out.insert("not_possible".into(), json!(breaches));
}

fn motion_json(followed: &Followed, moved: &Moved, out: &mut Map<String, Value>) {
    if let Some([begin, end]) = &moved.reaction {
        let pair = |c: &[Component; 2]| json!([component(&c[0]), component(&c[1])]);
        let reaction = json!({"before": pair(begin), "after": pair(end)});
        out.insert("reaction".into(), reaction);
    }
    let pulling = pulls(moved).map(|(name, when)| json!({"name": name, "at": when}));
    let pulling: Vec<Value> = pulling.collect();
    if !pulling.is_empty() {
        out.insert("pulls".into(), json!(pulling));
    }
    if let Some(clockwise) = moved.clockwise {
        out.insert("clockwise".into(), json!(clockwise));
    }
    let names: Vec<&String> = moved
        .bodies
        .iter()
        .map(|b| &followed.solids[*b].name)
        .collect();
    let poses = moved
        .samples
        .iter()
        .map(|s| json!({"time": s.time, "poses": s.poses}));
    out.insert("moving".into(), json!(names));
    out.insert("samples".into(), poses.collect());
}

fn body_json(body: &BodyState) -> Value {
    let all = COMPONENTS.iter().zip(body.components());
    all.map(|((name, _), c)| (name.to_string(), component(c)))
        .collect()
}

/// A number, or an object with the reason why there is none.
fn component(c: &Component) -> Value {
    match c {
        Ok(value) => json!(value),
        Err(open) => json!({"open": open.to_string()}),
    }
}
