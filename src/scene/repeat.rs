//! Groups of stages that a file writes once and that happen several times, such as the bounces of a ball.
//!
//! In: the tree of a scene file. Out: the same tree with every group written out, turn after turn, the number of the turn in
//! place of `#`; or nothing, where no group is repeated. Whoever reads the tree afterwards sees plain stages.

use std::borrow::Cow;

use super::fault::{Fault, Span};
use super::file::RepeatFile;
use super::json::{Entry, Node, Value};
use super::record::Read;
use super::stage::Turns;
use super::stages::STAGES;

/// The tree with its groups written out, and where they stand; `None` where it has none, or where one is faulty, which is
/// reported.
pub(super) fn unrolled<'t>(
    root: &Node<'t>,
    faults: &mut Vec<Fault>,
) -> Option<(Node<'t>, Vec<Turns>)> {
    let Value::Object(entries) = &root.value else {
        return None;
    };
    let stages = entries.iter().find(|e| e.key == "stages")?;
    let Value::List(listed) = &stages.node.value else {
        return None;
    };
    if !listed.iter().any(|node| inside(node, "repeat").is_some()) {
        return None;
    }
    let mut plain = Vec::new();
    let mut asked = Vec::new();
    let mut groups = Vec::new();
    for node in listed {
        if inside(node, "repeat").is_none() {
            plain.push(turn(node, None));
            continue;
        }
        let turns = turns(node, plain.len(), faults)?;
        groups.push(turns);
        for k in 1..=turns.times {
            if let Some(Value::List(stages)) = inside(node, "stages") {
                plain.extend(stages.iter().map(|stage| turn(stage, Some(k))));
            }
            if let Some(Value::Object(questions)) = inside(node, "questions") {
                asked.extend(questions.iter().map(|q| entry(q, Some(k))));
            }
        }
    }
    // What is asked in a turn stands first: later questions may use it.
    let others = inside(root, "questions");
    if let Some(Value::Object(others)) = others {
        asked.extend(others.iter().map(|q| entry(q, None)));
    }
    let mut out: Vec<Entry<'t>> = entries
        .iter()
        .filter(|e| e.key != "stages" && e.key != "questions")
        .map(|e| entry(e, None))
        .collect();
    for (key, value) in [
        ("stages", Value::List(plain)),
        ("questions", Value::Object(asked)),
    ] {
        let old = entries.iter().find(|e| e.key == key).unwrap_or(stages);
        out.push(Entry {
            key: Cow::Borrowed(key),
            key_span: old.key_span,
            node: Node {
                span: old.node.span,
                value,
            },
        });
    }
    let out = Node {
        span: root.span,
        value: Value::Object(out),
    };
    Some((out, groups))
}

/// How often a group happens; what is wrong with it is reported.
fn turns(node: &Node<'_>, before: usize, faults: &mut Vec<Fault>) -> Option<Turns> {
    let count = faults.len();
    let group = RepeatFile::read(node, faults)?;
    let turns = group.repeat.text.parse::<usize>();
    let most = STAGES.saturating_sub(before) / group.stages.len().max(1);
    let mut refuse = |span: Span, message: String, hint: &str| {
        faults.push(Fault::new(span, message).hint(hint));
    };
    match turns {
        Ok(n) if (1..=most).contains(&n) => {}
        Ok(n) if n > most => refuse(
            group.repeat.span,
            format!("{n} turns of this group are more than {STAGES} stages"),
            "repeat it less often",
        ),
        _ => refuse(
            group.repeat.span,
            String::from("a group of stages is repeated a whole number of times"),
            "write \"repeat\": 3; a question \"h_n\": {\"turn\": \"n\", \"of\": \"h_#\"} goes on from there to any number of turns",
        ),
    }
    if group.stages.is_empty() {
        let hint = "write the stages of one turn, such as one named \"bounce #\"";
        refuse(group.span, "this group has no stages".into(), hint);
    }
    let stages = group.stages.iter().map(|stage| &stage.name);
    let questions = group.questions.iter().flat_map(|map| &map.0);
    for name in stages.chain(questions.map(|(name, _)| name)) {
        if !name.text.contains('#') {
            refuse(
                name.span,
                format!("`{}` would have the same name in every turn", name.text),
                "put `#` where the number of the turn belongs, such as \"bounce #\" or \"v_#\"",
            );
        }
    }
    let times = turns.ok().filter(|_| faults.len() == count)?;
    Some(Turns {
        first: before,
        stages: group.stages.len(),
        times,
    })
}

/// What a field of an object holds.
fn inside<'n, 't>(node: &'n Node<'t>, key: &str) -> Option<&'n Value<'t>> {
    let Value::Object(entries) = &node.value else {
        return None;
    };
    entries.iter().find(|e| e.key == key).map(|e| &e.node.value)
}

/// A copy, in a turn with its number in place of `#`.
fn turn<'t>(node: &Node<'t>, k: Option<usize>) -> Node<'t> {
    let value = match &node.value {
        Value::Null => Value::Null,
        Value::Bool(value) => Value::Bool(*value),
        Value::Number(number) => Value::Number(number),
        Value::Text(text) => Value::Text(numbered(text, k)),
        Value::List(items) => Value::List(items.iter().map(|item| turn(item, k)).collect()),
        Value::Object(entries) => Value::Object(entries.iter().map(|e| entry(e, k)).collect()),
    };
    Node {
        span: node.span,
        value,
    }
}

fn entry<'t>(old: &Entry<'t>, k: Option<usize>) -> Entry<'t> {
    Entry {
        key: numbered(&old.key, k),
        key_span: old.key_span,
        node: turn(&old.node, k),
    }
}

fn numbered<'t>(text: &Cow<'t, str>, k: Option<usize>) -> Cow<'t, str> {
    match k {
        Some(k) if text.contains('#') => Cow::Owned(text.replace('#', &k.to_string())),
        _ => text.clone(),
    }
}
