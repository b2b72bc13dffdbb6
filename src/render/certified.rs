//! Correctly rounded answers, for people and for programs: each double with the way it was certified.

use std::fmt::Write;

use serde_json::{Value, json};

use crate::numeric::redundant::POINTS;
use crate::numeric::{Correct, CorrectAnswers, How, Law, Unknown};
use crate::scene::Scene;

const AXES: [&str; 2] = ["x", "y"];

/// Answers first, then every unknown of the full system.
pub fn text(scene: &Scene, answers: &CorrectAnswers) -> String {
    let mut out = String::new();
    let mut line = |name: &str, unit: &str, value: &Correct| {
        let _ = match value {
            Correct::Rounded(v, how) => {
                writeln!(
                    out,
                    "{name} = {} {unit}  [{}]",
                    super::double(*v),
                    words(*how)
                )
            }
            Correct::Open => writeln!(out, "{name}: not determined by the laws"),
            Correct::Undecided(_) => writeln!(out, "{name}: too close to call, even in 4096 bits"),
        };
    };
    for (question, answer) in &answers.answers {
        let unit = super::unit_of(scene, question);
        match answer {
            Ok(values) => {
                for (name, value) in components(question, values) {
                    line(&name, &unit, value);
                }
            }
            Err(_) => line(question, &unit, &Correct::Open),
        }
    }
    for (unknown, value) in &answers.unknowns {
        let (name, unit) = unknown_words(scene, *unknown);
        line(&name, unit, value);
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
    let entry = |name: &str, unit: &str, value: &Correct| match value {
        Correct::Rounded(v, how) => {
            json!({"name": name, "value": v, "unit": unit, "certified_by": words(*how)})
        }
        Correct::Open => json!({"name": name, "value": null, "reason": "not determined"}),
        Correct::Undecided(_) => json!({"name": name, "value": null, "reason": "undecided"}),
    };
    let mut list = Vec::new();
    for (question, answer) in &answers.answers {
        let unit = super::unit_of(scene, question);
        match answer {
            Ok(values) => {
                for (name, value) in components(question, values) {
                    list.push(entry(&name, &unit, value));
                }
            }
            Err(reason) => {
                list.push(json!({"name": question, "value": null, "reason": reason.to_string()}))
            }
        }
    }
    let unknowns: Vec<Value> = answers
        .unknowns
        .iter()
        .map(|(unknown, value)| {
            let (name, unit) = unknown_words(scene, *unknown);
            entry(&name, unit, value)
        })
        .collect();
    let mut out = json!({"title": scene.title, "source": scene.source, "answers": list, "unknowns": unknowns});
    if !answers.left_out.is_empty() {
        let laws: Vec<String> = answers.left_out.iter().map(|l| law(scene, *l)).collect();
        out["left_out"] = json!({"laws": laws, "because": "the others imply them", "known_at_random_points": POINTS, "proved": false});
    }
    out
}

fn components<'a>(question: &str, values: &'a [Correct]) -> Vec<(String, &'a Correct)> {
    match values {
        [one] => vec![(question.to_string(), one)],
        _ => AXES
            .iter()
            .zip(values)
            .map(|(axis, v)| (format!("{question}_{axis}"), v))
            .collect(),
    }
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
