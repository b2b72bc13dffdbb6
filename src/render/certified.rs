//! Correctly rounded answers, for people and for programs: each double with the way it was certified.

use std::fmt::Write;

use serde_json::{Value, json};

use crate::numeric::redundant::POINTS;
use crate::numeric::{Correct, CorrectAnswers, How, Law, NoAnswer, Unknown};
use crate::scene::Scene;

const AXES: [&str; 2] = ["x", "y"];

/// Answers first, then every unknown of the full system.
pub fn text(scene: &Scene, answers: &CorrectAnswers) -> String {
    let mut out = String::new();
    for (name, unit, value) in entries(scene, answers).into_iter().flatten() {
        let _ = match value {
            Ok(Correct::Rounded(v, how)) => {
                let (number, words) = (super::double(*v), words(*how));
                writeln!(out, "{name} = {number} {unit}  [{words}]")
            }
            Ok(Correct::Open) | Err(_) => writeln!(out, "{name}: not determined by the laws"),
            Ok(Correct::Undecided(_)) => {
                writeln!(out, "{name}: too close to call, even in 4096 bits")
            }
        };
    }
    out.push_str("each number is the double nearest to the true value");
    if !answers.left_out.is_empty() {
        let laws: Vec<String> = answers.left_out.iter().map(|l| law(scene, *l)).collect();
        let _ = write!(
            out,
            ", if the laws agree: {} left out, for at {POINTS} random exact points the others imply {}, which is seen, not proved",
            laws.join(" and "),
            if laws.len() == 1 { "it" } else { "them" }
        );
    }
    out.push('\n');
    out
}

/// A law by the scene's names.
fn law(scene: &Scene, law: Law) -> String {
    let body = |b: usize| &scene.bodies[b].name;
    let hinge = |h: usize| &scene.hinges[h].name;
    let contact = |c: usize| &scene.contacts[c].name;
    match law {
        Law::Momentum(b, axis) => format!("momentum of {} along {}", body(b), AXES[axis]),
        Law::AngularMomentum(b) => format!("angular momentum of {}", body(b)),
        Law::Hinge(h, axis) => format!("hinge {} along {}", hinge(h), AXES[axis]),
        Law::Sticking(c, axis) => format!("sticking at {} along {}", contact(c), AXES[axis]),
        Law::Restitution(c) => format!("restitution at {}", contact(c)),
        Law::Condition(c, _) => format!("friction at {}", contact(c)),
        Law::Known(k) => format!("known value {}", k + 1),
    }
}

/// The same as data.
pub fn json(scene: &Scene, answers: &CorrectAnswers) -> Value {
    let entry = |(name, unit, value): &Entry<'_>| match value {
        Ok(Correct::Rounded(v, how)) => {
            json!({"name": name, "value": v, "unit": unit, "certified_by": words(*how)})
        }
        Ok(Correct::Open) => json!({"name": name, "value": null, "reason": "not determined"}),
        Ok(Correct::Undecided(_)) => json!({"name": name, "value": null, "reason": "undecided"}),
        Err(reason) => json!({"name": name, "value": null, "reason": reason.to_string()}),
    };
    let lists = entries(scene, answers);
    let [list, unknowns] = lists.map(|all| all.iter().map(entry).collect::<Vec<Value>>());
    let mut out = json!({"title": scene.title, "source": scene.source, "answers": list, "unknowns": unknowns});
    if !answers.left_out.is_empty() {
        let laws: Vec<String> = answers.left_out.iter().map(|l| law(scene, *l)).collect();
        out["left_out"] = json!({"laws": laws, "because": "the others imply them", "known_at_random_points": POINTS, "proved": false});
    }
    out
}

/// Name, unit and number; or why an answer has none.
type Entry<'a> = (String, String, Result<&'a Correct, &'a NoAnswer>);

/// What is asked, and the unknowns of the equations.
fn entries<'a>(scene: &Scene, answers: &'a CorrectAnswers) -> [Vec<Entry<'a>>; 2] {
    let mut asked = Vec::new();
    for (question, answer) in &answers.answers {
        let unit = super::unit_of(scene, question);
        let named = |part: &str| format!("{question}{part}");
        match answer.as_deref() {
            Ok([one]) => asked.push((named(""), unit, Ok(one))),
            Ok(several) => {
                let parts = ["_x", "_y"].iter().zip(several);
                asked.extend(parts.map(|(part, v)| (named(part), unit.clone(), Ok(v))));
            }
            Err(why) => asked.push((named(""), unit, Err(why))),
        }
    }
    let unknowns = answers.unknowns.iter().map(|(unknown, value)| {
        let (name, unit) = unknown_words(scene, *unknown);
        (name, unit.to_string(), Ok(value))
    });
    [asked, unknowns.collect()]
}

/// How a double was certified.
pub fn words(how: How) -> String {
    match how {
        How::Exact => "exact fractions".into(),
        How::Bits(bits) => format!("enclosure of {bits} bits"),
    }
}

/// An unknown of the full system by the scene's names, and its unit.
pub fn unknown_words(scene: &Scene, unknown: Unknown) -> (String, &'static str) {
    let body = |b: usize| &scene.bodies[b].name;
    let contact = |c: usize| &scene.contacts[c].name;
    let words = match unknown {
        Unknown::Velocity(b, axis) => {
            return (
                format!("velocity of {} along {}", body(b), AXES[axis]),
                "m/s",
            );
        }
        Unknown::Spin(b) => return (format!("spin of {}", body(b)), "rad/s"),
        Unknown::Hinge(h, axis) => {
            let hinge = &scene.hinges[h].name;
            format!("impulse at hinge {hinge} along {}", AXES[axis])
        }
        Unknown::Contact(c, axis) => format!("impulse at {} along {}", contact(c), AXES[axis]),
        Unknown::ContactNormal(c) => format!("impulse at {} along the normal", contact(c)),
        Unknown::Blow(b) => format!("size of the applied impulse {}", scene.blows[b].name),
    };
    (words, "N s")
}
