//! A told story for the terminal and as data: stages with what they keep, answers with their checks.

use serde_json::{Value, json};

use super::unicode;
use crate::answer::{Answer, Check, Form};
use crate::formula::{Relation, Sentence, write_plain};
use crate::scene::{Ask, Question, Scene};
use crate::story::{Case, StageTold, Told};

/// What was told as data: one impact with its equations, or answers with the stages beside them.
pub fn json(scene: &Scene, told: &Told) -> Value {
    if let Some(impact) = told.alone() {
        return super::json::impact(scene, told, impact);
    }
    json!({
        "title": scene.title,
        "source": scene.source,
        "admissible": told.refusals().is_empty(),
        "refusals": told.refusals(),
        "answers": told.answers.iter().map(|a| super::json::answer(scene, told, a)).collect::<Vec<_>>(),
        "stages": told.stages.iter().map(|s| stage(scene, s)).collect::<Vec<_>>(),
        "readings": told.readings,
        "unused": told.unused.iter().map(|s| &**s).collect::<Vec<_>>(),
        "remarks": scene.remarks,
        "verified": told.holds(),
    })
}

fn stage(scene: &Scene, s: &StageTold) -> Value {
    let bodies: Vec<Value> = scene
        .bodies
        .iter()
        .enumerate()
        .filter(|(_, b)| !b.is_fixed())
        .map(|(i, b)| {
            let state = |s: &crate::story::State| {
                json!({
                    "center": [write_plain(&s.center[i][0]), write_plain(&s.center[i][1])],
                    "velocity": [write_plain(&s.velocity[i][0]), write_plain(&s.velocity[i][1])],
                    "spin": write_plain(&s.spin[i]),
                })
            };
            json!({"body": b.name, "before": state(&s.before), "after": state(&s.after)})
        })
        .collect();
    json!({
        "name": s.name,
        "kind": s.placed.kind.word(),
        "words": plain(&s.words),
        "conserved": s.kept.iter().map(|k| json!({"what": k.what, "conserved": k.conserved, "why": k.why.to_string()})).collect::<Vec<_>>(),
        "cases": s.cases.iter().map(|c| case(scene, c)).collect::<Vec<_>>(),
        "energy": s.energy.as_ref().map(|[a, b]| json!({"before": write_plain(a), "after": write_plain(b)})),
        "bodies": bodies,
        "assumptions": plain(&s.assumptions),
        "checks": s.checks.iter().map(super::json::check).collect::<Vec<_>>(),
    })
}

/// An outcome of an impact, with the equations it took.
fn case(scene: &Scene, case: &Case) -> Value {
    let conditions = case.conditions.iter();
    let conditions = conditions.map(|(why, e)| format!("{} >= 0 ({why})", write_plain(e)));
    let mut out = super::json::object(json!({
        "active": case.active,
        "conditions": conditions.collect::<Vec<_>>(),
        "verified": case.proof.holds(),
        "admissible": super::possible::json(scene, &case.possible),
    }));
    let (asked, derivation) = case.asked();
    out.extend(super::json::equations(&asked, &derivation));
    Value::Object(out)
}

fn plain(all: &[Sentence]) -> Vec<String> {
    all.iter().map(ToString::to_string).collect()
}

/// What was told as plain text: one impact, or a section for each stage and then the answers.
pub fn text(scene: &Scene, told: &Told) -> String {
    if let Some(impact) = told.alone() {
        return super::text::impact(scene, told, impact);
    }
    let mut out = String::new();
    let written = |words: &Sentence| words.written(|e| unicode(scene, e));
    let mut line = |text: String| {
        out.push_str(text.trim_end());
        out.push('\n');
    };
    for refusal in told.refusals() {
        line(refusal);
    }
    line(super::heading(&scene.title, &scene.source));
    for reading in &told.readings {
        line(format!("read as: {reading}"));
    }
    for (i, s) in told.stages.iter().enumerate() {
        line(String::new());
        line(format!("{}. {} ({})", i + 1, s.name, s.placed.kind.word()));
        for words in &s.words {
            line(format!("   {}", written(words)));
        }
        for k in &s.kept {
            let is = if k.conserved {
                "conserved"
            } else {
                "not conserved"
            };
            line(format!("   {} {is}: {}", k.what, written(&k.why)));
        }
        for words in &s.assumptions {
            line(format!("   taken for granted: {}", written(words)));
        }
        for (k, case) in s.cases.iter().enumerate() {
            if s.cases.len() > 1 {
                line(format!("   case {}:", k + 1));
            }
            equations(case)
                .lines()
                .for_each(|l| line(format!("   {l}")));
        }
        for c in &s.checks {
            line(format!("   {} {}", mark(c), c.words));
        }
    }
    for why in &told.ended {
        line(String::new());
        line(format!("✗ {why}"));
    }
    line(String::new());
    line(String::from("answers"));
    out.push_str(&answers(scene, &told.answers));
    if !told.unused.is_empty() {
        let names: Vec<&str> = told.unused.iter().map(AsRef::as_ref).collect();
        out.push_str(&format!("\nnot needed: {}\n", names.join(", ")));
    }
    out
}

/// The equations of an outcome, and what it did not need.
fn equations(case: &Case) -> String {
    let (scene, derivation) = case.asked();
    let mut out = String::new();
    super::text::equations(&mut out, &scene, &derivation);
    super::text::left_out(&mut out, &derivation);
    out
}

/// Answers one after the other, each with what it rests on and how it was checked.
pub fn answers(scene: &Scene, answers: &[Answer]) -> String {
    let mut out = String::new();
    let written = |words: &Sentence| words.written(|e| unicode(scene, e));
    let mut line = |text: String| {
        out.push_str(text.trim_end());
        out.push('\n');
    };
    for (i, a) in answers.iter().enumerate() {
        if answers[..i].iter().any(|before| is_alike(before, a)) {
            continue;
        }
        line(String::new());
        let is_largest =
            |q: &Question| q.name == a.question && matches!(q.ask, Ask::Maximum { .. });
        let is_largest = scene.questions.iter().any(is_largest);
        let value = a.formula().map(|e| unicode(scene, e));
        match (&value, a.range.as_slice()) {
            // A largest value, and where it is.
            (Some(value), [(s, Relation::Equal, e)])
                if is_largest || *value != unicode(scene, e) =>
            {
                let s = unicode(scene, s);
                line(format!(
                    "   {} = {value}, at {s} = {}",
                    a.name,
                    unicode(scene, e)
                ));
            }
            (_, [(s, relation, e)]) => line(format!(
                "   {}: {} {} {}",
                a.name,
                unicode(scene, s),
                relation.sign(),
                unicode(scene, e)
            )),
            (None, several @ [_, _, ..])
                if several.iter().all(|(_, r, _)| *r == Relation::Equal) =>
            {
                let all = several.iter().map(|(s, _, e)| {
                    let s = unicode(scene, s);
                    format!("{s} = {}", unicode(scene, e))
                });
                let all: Vec<String> = all.collect();
                line(format!("   {}: {}", a.name, all.join(" or ")));
            }
            (Some(value), _) => line(format!("   {} = {value}", a.name)),
            (None, _) => match &a.form {
                // An identity that was to be shown stands in its text.
                Form::Equation { left, right } if a.told.is_some() => {
                    let [left, right] = [left, right].map(|e| unicode(scene, e));
                    line(format!("   {}: {left} = {right}", a.name));
                }
                _ => line(format!("   {}:", a.name)),
            },
        }
        let formula = a.formula().filter(|e| !e.is_zero());
        if let Some(value) = formula.and_then(|e| super::value(scene, e)) {
            let number = super::digits(value.approximate);
            let measured = match formula.is_some_and(|e| e.is_arc()) {
                true => format!(
                    "{number} rad, {}°",
                    super::digits(value.approximate.to_degrees())
                ),
                false => a.dimension.measured(&number),
            };
            line(format!("      ≈ {measured}"));
        }
        if let Form::Matrix(m) = &a.form {
            super::text::matrix(scene, m)
                .lines()
                .for_each(|l| line(format!("      {l}")));
        }
        let alike: Vec<&Answer> = answers[i + 1..].iter().filter(|b| is_alike(a, b)).collect();
        line(format!("      {}", shared_words(a, &alike)));
        for words in &a.text {
            line(format!("      {}", written(words)));
        }
        for words in &a.discarded {
            line(format!("      discarded: {}", written(words)));
        }
        for words in given(a, &alike, written) {
            line(format!("      given that {words}"));
        }
        for c in &a.checks {
            line(format!("      {} {}", mark(c), c.words));
        }
    }
    out
}

/// Whether two cases of an answer say the same, and all that was checked of the second holds: they are told as one.
fn is_alike(a: &Answer, b: &Answer) -> bool {
    let plain = |a: &Answer| a.name.split("_case").next().map(str::to_string);
    let says = |a: &Answer| (a.form.clone(), a.range.clone(), a.text.clone());
    a.told.is_some()
        && a.question == b.question
        && plain(a) == plain(b)
        && says(a) == says(b)
        && a.formula().is_some()
        && b.checks.iter().all(|c| c.holds == Some(true))
}

/// What an answer is, as far as those alike are the same.
fn shared_words<'a>(a: &'a Answer, alike: &[&Answer]) -> &'a str {
    let mut words = a.words.as_str();
    while let Some((shorter, _)) = words.rsplit_once(", ")
        && !alike
            .iter()
            .all(|b| b.words == words || b.words.starts_with(&format!("{words}, ")))
    {
        words = shorter;
    }
    words
}

/// What an answer and those alike rest on: what all of them do, and then what each of them does besides.
fn given(a: &Answer, alike: &[&Answer], written: impl Fn(&Sentence) -> String) -> Vec<String> {
    let everywhere = |s: &&Sentence| alike.iter().all(|b| b.assumptions.contains(s));
    let (common, own): (Vec<&Sentence>, Vec<&Sentence>) =
        a.assumptions.iter().partition(everywhere);
    let mut out: Vec<String> = common.iter().map(|s| written(s)).collect();
    let besides = |b: &&Answer| -> Vec<String> {
        let more = b.assumptions.iter().filter(|s| !common.contains(s));
        more.map(&written).collect()
    };
    if alike.is_empty() {
        return out;
    }
    let mut each: Vec<Vec<String>> = vec![own.into_iter().map(&written).collect()];
    each.extend(alike.iter().map(besides));
    if each.iter().all(|words| !words.is_empty()) {
        let each: Vec<String> = each.iter().map(|words| words.join(" and ")).collect();
        out.push(each.join(", or that "));
    }
    out
}

fn mark(c: &Check) -> &'static str {
    match c.holds {
        Some(true) => "✓",
        Some(false) => "✗",
        None => "?",
    }
}
