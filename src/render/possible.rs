//! Whether a collision is possible, in the formats people and programs read.

use serde_json::{Value, json};

use super::{latex, unicode};
use crate::answer::Check;
use crate::expr::Expr;
use crate::formula::{self, write_plain};
use crate::scene::Scene;
use crate::verify::possible::{Condition, Possible, Verdict};

/// The conditions under which it is possible, such as `2 l ≥ d`.
pub fn conditions(scene: &Scene, possible: &Possible) -> Vec<String> {
    let written = |e: &_| unicode(scene, e);
    possible
        .open()
        .into_iter()
        .filter_map(|c| sides(c, "≥", written))
        .collect()
}

/// What was judged, as a check.
pub fn check(scene: &Scene, possible: &Possible) -> Option<Check> {
    if scene.contacts.is_empty() {
        return None;
    }
    let at_values = match possible.at_values {
        Some(true) => "; all hold at the given values",
        Some(false) => "; not at the given values",
        None => "",
    };
    let words = match possible.verdict {
        Verdict::Everywhere if scene.contacts.iter().any(|c| c.law.may_gain()) => {
            String::from("what touches pushes and parts, for all admitted parameters")
        }
        Verdict::Everywhere => String::from("possible for all admitted parameters"),
        Verdict::Where => match not_decided(possible) {
            Some(open) => format!("possible on a part of the domain at most; {open}{at_values}"),
            None => format!("possible on a part of the domain only{at_values}"),
        },
        Verdict::Nowhere => String::from("possible nowhere"),
        Verdict::Undecided => match not_decided(possible) {
            Some(open) => format!("{open}{at_values}"),
            None => String::from("possible as far as it could be judged"),
        },
    };
    let holds = match (possible.verdict, possible.at_values) {
        (Verdict::Nowhere, _) | (_, Some(false)) => Some(false),
        (Verdict::Everywhere, _) => Some(true),
        (_, Some(true)) => Some(true),
        _ => None,
    };
    Some(Check::new("possible", words, holds))
}

/// The conditions that are neither shown nor refuted for symbols.
fn not_decided(possible: &Possible) -> Option<String> {
    let open = possible.conditions.iter();
    let open = open.filter(|c| c.verdict == Verdict::Undecided && c.at_values != Some(true));
    let mut open: Vec<&str> = open.map(|c| c.words.as_str()).collect();
    open.dedup();
    (!open.is_empty()).then(|| format!("not decided whether {}", open.join(", ")))
}

/// The verdict as data.
pub fn json(scene: &Scene, possible: &Possible) -> Value {
    let all: Vec<Value> = possible
        .conditions
        .iter()
        .map(|c| {
            json!({
                "rule": c.rule.name(),
                "words": c.words,
                "verdict": verdict(c.verdict),
                "condition": sides(c, "≥", write_plain),
                "latex": sides(c, "\\ge", |e| latex(scene, e)),
                "at_values": c.at_values,
            })
        })
        .collect();
    json!({
        "holds": possible.holds(),
        "verdict": verdict(possible.verdict),
        "at_values": possible.at_values,
        "reasons": possible.reasons(),
        "conditions": all,
        "not_judged": possible.not_judged,
        "notes": possible.notes,
    })
}

fn verdict(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Everywhere => "everywhere",
        Verdict::Where => "where",
        Verdict::Nowhere => "nowhere",
        Verdict::Undecided => "undecided",
    }
}

/// A condition by its two sides; `at_least` is how ≥ is written.
fn sides(c: &Condition, at_least: &str, written: impl Fn(&Expr) -> String) -> Option<String> {
    let [left, right] = formula::sides(c.essential.as_ref()?);
    let relation = if c.is_equation { "=" } else { at_least };
    Some(format!("{} {relation} {}", written(&left), written(&right)))
}
