//! Whole scenes: impacts of which the laws may leave something open, and motions of one body or both, in any order. What a stage
//! does not name goes on, is open or falls, component by component, as the scene followed in numbers has it.

use proptest::prelude::*;
use proptest::sample::select;

/// An impact of `p` or `q` against a wall, a flight or a slide.
fn stage() -> impl Strategy<Value = &'static str> {
    select(vec![
        r#""slide": {"body": "q", "along": "x", "distance": "d"}"#,
        r#""fall": {"body": "p", "for": "t"}"#,
        r#""fall": {"body": "q", "for": "t"}"#,
        r#""fall": {"body": "p", "with": ["q"], "for": "t"}"#,
        r#""fall": {"body": "p", "gravity": "g", "for": "t"}"#,
        r#""fall": {"body": "q", "with": ["p"], "gravity": "g", "for": "t"}"#,
        r#""impact": {"contacts": {"D": {"bodies": ["wall", "q"], "at": "q", "normal": "-x", "law": "frictionless", "restitution": "f"}}}"#,
        r#""impact": {"contacts": {"D": {"bodies": ["wall", "q"], "at": "q", "normal": "-x"}}, "after": [{"velocity": "q", "along": "y", "is": "u"}]}"#,
    ])
}

/// A body meets a wall by some law or none, and up to three stages follow.
pub fn scene() -> impl Strategy<Value = String> {
    let body = select(vec![
        r#""shape": "particle", "center": ["0", "0"]"#,
        r#""shape": "disk", "radius": "r", "center": ["-r", "0"]"#,
        r#""shape": "disk", "radius": "r", "center": ["-r", "0"], "spin": "w""#,
        r#""shape": "rod", "length": "2*r", "angle": "0", "center": ["-r", "0"]"#,
    ]);
    let law = select(vec![
        r#", "law": "frictionless", "restitution": "e"}}"#,
        r#", "law": "sticking"}}"#,
        "}}",
        r#"}}, "after": [{"velocity": "p", "along": "x", "is": "-v/2"}]"#,
        r#"}}, "after": [{"velocity": "p", "along": "y", "is": "u/2"}]"#,
        r#"}}, "after": [{"velocity": "p", "along": "x", "is": "-v/2"}, {"velocity": "p", "along": "y", "is": "u/2"}]"#,
    ]);
    let other = select(vec![r#"["w1", "0"]"#, r#"["w1", "u"]"#, r#"["0", "u"]"#]);
    let later = prop::collection::vec(stage(), 1..4);
    (body, law, other, later).prop_map(|(body, law, other, later)| {
        let later = later.iter().enumerate();
        let later: Vec<String> = later
            .map(|(k, stage)| format!(r#"{{"name": "S{k}", {stage}}}"#))
            .collect();
        format!(
            r#"{{
  "parameters": {{
    "m": {{"unit": "kg"}}, "M": {{"unit": "kg"}}, "r": {{"unit": "m"}}, "d": {{"unit": "m"}}, "t": {{"unit": "s"}},
    "v": {{"unit": "m/s"}}, "u": {{"unit": "m/s"}}, "w": {{"unit": "rad/s"}}, "w1": {{"unit": "m/s"}}, "g": {{"unit": "m/s^2"}},
    "e": {{"domain": {{"min": 0, "max": 1}}}}, "f": {{"domain": {{"min": 0, "max": 1}}}}
  }},
  "bodies": {{
    "wall": {{"shape": "fixed"}},
    "p": {{{body}, "mass": "m", "velocity": ["v", "u"]}},
    "q": {{"shape": "particle", "mass": "M", "center": ["-5*d", "9*r"], "velocity": {other}}}
  }},
  "stages": [
    {{"name": "hit", "impact": {{"contacts": {{"C": {{"bodies": ["wall", "p"], "at": ["0", "0"], "normal": "-x"{law}}}}},
    {}],
  "questions": {{
    "x": {{"position": "p", "along": "x"}}, "y": {{"position": "p", "along": "y"}}, "vx": {{"velocity": "p", "along": "x"}},
    "vy": {{"velocity": "p", "along": "y"}}, "X": {{"position": "q"}}, "V": {{"velocity": "q"}}, "K": {{"energy": "after"}}
  }}
}}"#,
            later.join(",\n    ")
        )
    })
}
