//! A scene worked out, for the terminal: the answers with how each is known, then how it goes, stage by stage, with the few
//! equations that took and what was left out. A scene of one impact is one stage without a name.

use std::fmt::Write;

use super::{cut, unicode};
use crate::answer::{Answer, Check, Form, Matrix, given_alike};
use crate::derive::Derivation;
use crate::dimension::System;
use crate::expr::{Expr, Symbol};
use crate::formula::{Relation, Sentence};
use crate::laws;
use crate::scene::{Ask, Question, Scene};
use crate::story::{StageTold, Told};

/// What to say of a scene without questions: how it asks.
pub(super) fn nothing_asked(scene: &Scene) -> Option<String> {
    let body = &scene.bodies[scene.moving().next()?].name;
    let at = scene.stages.last().map(|stage| &stage.name);
    let at = at.map_or(String::new(), |name| format!(", \"at\": \"{name}\""));
    let question = format!("{{\"v\": {{\"velocity\": \"{body}\"{at}}}}}");
    let note = || format!("nothing is asked; ask such as \"questions\": {question}");
    scene.questions.is_empty().then(note)
}

/// What was told: what cannot be so first, then the answers, then the stages.
pub fn told(scene: &Scene, told: &Told) -> String {
    let mut out = String::new();
    for refusal in told.refusals() {
        let _ = writeln!(out, "{refusal}");
    }
    let _ = writeln!(out, "{}", super::heading(&scene.title, &scene.source));
    for reading in &told.readings {
        let _ = writeln!(out, "read as: {reading}");
    }
    for why in &told.ended {
        let _ = writeln!(out, "\n✗ {why}");
    }
    let alone = told.alone().map(|case| &case.derivation);
    if !told.answers.is_empty() {
        let _ = writeln!(out, "\nanswers");
        out.push_str(&answers(scene, Some(told), &told.answers));
    }
    if let Some(note) = nothing_asked(scene) {
        let _ = writeln!(out, "\n{note}");
    }
    let definitions = alone.map_or(&[][..], |d| &d.definitions);
    if !definitions.is_empty() {
        let _ = writeln!(out, "\nwhere");
    }
    for definition in definitions {
        let value = unicode(scene, &definition.value);
        let _ = writeln!(out, "   {} = {value}", definition.name);
        let _ = writeln!(out, "      {}", definition.meaning);
    }
    let under = scene.domains.conditions();
    if !under.is_empty() {
        let _ = writeln!(out, "\nunder: {}", under.join(", "));
    }
    if !told.unused.is_empty() {
        let names: Vec<&str> = told.unused.iter().map(AsRef::as_ref).collect();
        let _ = writeln!(out, "\nnot needed: {}", names.join(", "));
    }
    for (i, s) in told.stages.iter().enumerate() {
        let kind = s.placed.kind.word();
        let _ = match alone {
            Some(_) => writeln!(out, "\n{kind}"),
            None => writeln!(out, "\n{}. {} ({kind})", i + 1, s.name),
        };
        for line in stage(scene, s).lines() {
            let _ = writeln!(out, "{}", format!("   {line}").trim_end());
        }
    }
    out
}

/// How a stage goes, what it keeps, its outcomes, and how that was checked.
fn stage(scene: &Scene, s: &StageTold) -> String {
    let mut out = String::new();
    let written = |words: &Sentence| words.written(|e| unicode(scene, e));
    for words in &s.words {
        let _ = writeln!(out, "{}", written(words));
    }
    for k in &s.kept {
        let not = if k.conserved { "" } else { "not " };
        let _ = writeln!(out, "{} {not}conserved: {}", k.what, written(&k.why));
    }
    for words in &s.assumptions {
        let _ = writeln!(out, "taken for granted: {}", written(words));
    }
    for (k, case) in s.cases.iter().enumerate() {
        if s.cases.len() > 1 {
            let _ = writeln!(out, "case {}:", k + 1);
        }
        let (scene, derivation) = case.asked(&[]);
        let stands = |name: &Symbol| {
            let all = derivation.blocks.iter().flat_map(|b| &b.equations);
            let mut all = all.flat_map(|e| e.terms.iter().map(|(_, k)| k).chain([&e.known]));
            all.any(|e| e.symbols().contains(name))
        };
        for (name, value) in case.handed.iter().filter(|(name, _)| stands(name)) {
            let [name, value] = [&Expr::symbol(name), value].map(|e| unicode(&scene, e));
            let _ = writeln!(out, "from before: {name} = {value}");
        }
        equations(&mut out, &scene, &derivation);
        left_out(&mut out, &derivation);
        let only = super::possible::conditions(&scene, &case.possible);
        if !only.is_empty() {
            let _ = writeln!(out, "\npossible where: {}", only.join(", "));
        }
        out.push('\n');
        let is_open = !derivation.counting.contradictory;
        let possible = super::possible::check(&scene, &case.possible);
        if let Some(possible) = possible.filter(|_| is_open) {
            check(&mut out, "", &possible);
        }
        for words in &case.possible.not_judged {
            let _ = writeln!(out, "? not judged: {words}");
        }
        for note in &case.possible.notes {
            let _ = writeln!(out, "? {note}");
        }
    }
    s.checks.iter().for_each(|c| check(&mut out, "", c));
    out
}

/// Answers one after the other, each with what it rests on and how it was checked, but for what is said of their stages. Those
/// of a scene of one impact may hold definitions of its derivation.
pub fn answers(scene: &Scene, of: Option<&Told>, answers: &[Answer]) -> String {
    let mut out = String::new();
    let alone = of.and_then(Told::alone).map(|case| &case.derivation);
    let stages = of.map_or(&[][..], |told| &told.stages);
    let is_new = |c: &&Check| !stages.iter().any(|s| s.checks.contains(c));
    let written = |words: &Sentence| words.written(|e| unicode(scene, e));
    let groups = answers.iter().enumerate();
    let groups = groups.filter(|(i, a)| !answers[..*i].iter().any(|before| is_alike(before, a)));
    let given = groups.clone().map(|(i, a)| {
        let alike = answers[i + 1..].iter().filter(|b| is_alike(a, b));
        given_alike(
            &[a].into_iter().chain(alike).collect::<Vec<_>>(),
            &scene.domains,
        )
    });
    let throughout = throughout(&given.collect::<Vec<_>>());
    if !throughout.is_empty() {
        let _ = writeln!(out, "\n   all given that");
        for words in &throughout {
            let _ = writeln!(out, "      {}", cut(&written(words)));
        }
    }
    for (i, a) in groups {
        let alone = alone.filter(|_| a.told.is_some());
        let _ = writeln!(out, "\n   {}", says(scene, alone, a));
        if let Form::Matrix(m) = &a.form {
            for line in matrix(scene, m).lines() {
                let _ = writeln!(out, "   {line}");
            }
        }
        let alike: Vec<&Answer> = answers[i + 1..].iter().filter(|b| is_alike(a, b)).collect();
        let unit = a
            .formula()
            // A unit beside a number in the scene has become part of the formulas, in SI units.
            .map(|e| match scene.units.is_empty() || e.is_constant() {
                true => a.unit_of_data(scene),
                false => a.unit(scene),
            })
            .filter(|unit| unit != "1");
        let unit = unit.map_or(String::new(), |unit| format!(" [{unit}]"));
        let mut lines = vec![format!("{}{unit}", shared_words(a, &alike))];
        lines.extend(a.left_open().filter(|_| a.text.is_empty()));
        lines.extend(a.text.iter().map(written));
        lines.extend(
            a.discarded
                .iter()
                .map(|words| format!("discarded: {}", written(words))),
        );
        let told: Vec<&Answer> = [a].into_iter().chain(alike).collect();
        let given = given_alike(&told, &scene.domains).into_iter();
        let given = given.filter(|words| !throughout.iter().any(|s| s.tells_as(words)));
        lines.extend(given.map(|words| format!("given that {}", written(&words))));
        for line in lines {
            let _ = writeln!(out, "      {}", cut(&line));
        }
        let checks = a.checks.iter().filter(is_new);
        checks.for_each(|c| check(&mut out, "      ", c));
    }
    out
}

/// What every one of several answers rests on, which is told once.
fn throughout(given: &[Vec<Sentence>]) -> Vec<Sentence> {
    const SEVERAL: usize = 3;
    match given {
        [first, rest @ ..] if given.len() >= SEVERAL => {
            let is_in = |words: &Sentence, all: &[Sentence]| all.iter().any(|s| s.tells_as(words));
            let is_shared = |words: &&Sentence| rest.iter().all(|other| is_in(words, other));
            first.iter().filter(is_shared).cloned().collect()
        }
        _ => Vec::new(),
    }
}

/// An answer in one line: its formula, equation or range, with the number it has at the given values.
pub(super) fn says(scene: &Scene, alone: Option<&Derivation>, a: &Answer) -> String {
    let name = &a.name;
    let is_it = |q: &&Question| q.name == a.question;
    let asked = scene.questions.iter().find(is_it).map(|q| &q.ask);
    // Its place is an answer of its own, which says no more.
    let is_extreme = *name == a.question && matches!(asked, Some(Ask::Extremum { .. }));
    let text = |e: &Expr| unicode(scene, e);
    let value = match &a.form {
        Form::Value { short, .. } => Some(text(short)),
        _ => None,
    };
    let number = number(scene, alone, a).filter(|number| value.as_ref() != Some(number));
    let constant = a.formula().is_some_and(Expr::is_constant);
    if let (Some(value), Some(number), true, []) = (&value, &number, constant, &*a.range) {
        // A number says no more than its value in the unit, and has no other in feet and pounds.
        let is_it = number.split_once(' ').is_some_and(|(n, _)| n == value);
        let scale = scene.system().scale(&a.dimension);
        if is_it || scale != 1.0 {
            return format!("{name} = {number}");
        }
    }
    let number = number.map_or(String::new(), |number| format!(" ≈ {number}"));
    match (&value, a.range.as_slice()) {
        // A largest or least value, and where it is.
        (Some(value), [(s, Relation::Equal, e)]) if is_extreme || *value != text(e) => {
            format!("{name} = {value}{number}, at {} = {}", text(s), text(e))
        }
        (_, [(s, relation, e)]) => {
            format!(
                "{name}: {} {} {}{number}",
                text(s),
                relation.sign(),
                text(e)
            )
        }
        (None, several @ [_, _, ..]) if several.iter().all(|(_, r, _)| *r == Relation::Equal) => {
            let all = several.iter();
            let all = all.map(|(s, _, e)| format!("{} = {}", text(s), text(e)));
            format!("{name}: {}", all.collect::<Vec<_>>().join(" or "))
        }
        (Some(value), _) => format!("{name} = {value}{number}"),
        (None, _) => match &a.form {
            // An identity that was to be shown stands in its text.
            Form::Equation { left, right } if a.told.is_some() => {
                format!("{name}: {} = {}", text(left), text(right))
            }
            _ => format!("{name}:"),
        },
    }
}

/// The number that an answer has at the given values, with its unit.
fn number(scene: &Scene, alone: Option<&Derivation>, a: &Answer) -> Option<String> {
    let closed = a
        .formula()
        .filter(|e| !e.is_zero() && a.broken(scene).is_none())?;
    let value = super::answer_value(scene, alone, closed)?.approximate;
    Some(match closed.is_arc() {
        true => format!(
            "{} rad, {}°",
            super::digits(value),
            super::digits(value.to_degrees())
        ),
        false => a.measured(scene, value, super::digits),
    })
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

/// How many equations there are, and the blocks that answer the questions.
fn equations(out: &mut String, scene: &Scene, d: &Derivation) {
    counting(out, d);
    for (unknown, value) in &d.given {
        let symbol = unicode(scene, &Expr::symbol(d.names.plain(*unknown)));
        let _ = writeln!(out, "\ngiven: {symbol} = {}", unicode(scene, value));
    }
    for block in &d.blocks {
        let n = block.equations.len();
        let heading = format!("{n} equation{} in {n} unknown{}:", plural(n), plural(n));
        let _ = writeln!(out, "\n{heading}");
        for equation in &block.equations {
            let (left, right) = super::sides(d, equation);
            let _ = writeln!(out, "  {}", laws::describe(scene, &equation.law));
            let _ = writeln!(
                out,
                "      {} = {}",
                unicode(scene, &left),
                unicode(scene, &right)
            );
        }
        for (unknown, value) in block.unknowns.iter().zip(d.solution(block)) {
            let value = unicode(scene, &value);
            if value.chars().count() <= 120 {
                let symbol = unicode(scene, &Expr::symbol(d.names.plain(*unknown)));
                let _ = writeln!(out, "  ⇒   {symbol} = {value}");
            }
        }
    }
}

/// What the scene did not need.
fn left_out(out: &mut String, d: &Derivation) {
    if !d.left_out.is_empty() {
        let _ = writeln!(out, "\nleft out:");
        for left in &d.left_out {
            let _ = writeln!(out, "  {}: {}", left.what, left.why);
        }
    }
}

/// Why what follows cannot happen, and what is strange of it, one a line.
pub fn noted(noted: &[Vec<String>; 2]) -> String {
    let all = noted.iter().flatten();
    all.map(|what| format!("{what}\n")).collect()
}

/// Numbers, one a line.
pub fn numbers(scene: &Scene, numbers: &[super::Number]) -> String {
    let mut out = String::new();
    for number in numbers {
        let Some(asked) = scene.question(&number.question) else {
            continue;
        };
        let text = match &number.value {
            Ok(value) => match &value.exact {
                Some(exact) if scene.system() == System::Si => {
                    let unit = scene.unit_of(&asked.ask);
                    format!("{exact} {unit} ≈ {}", super::digits(value.approximate))
                }
                _ => super::answered(scene, &asked.ask, value.approximate),
            },
            Err(reason) => reason.clone(),
        };
        let _ = writeln!(out, "{} = {text}", number.name);
    }
    out
}

/// A matrix, one row a line.
pub fn matrix(scene: &Scene, m: &Matrix) -> String {
    let entries = m.entries.iter();
    let entries = entries.map(|row| row.iter().map(|e| unicode(scene, e)).collect());
    let rows: Vec<Vec<String>> = [m.unknowns.clone()].into_iter().chain(entries).collect();
    let lines = super::columns(&rows, |_| false);
    let mut out = format!("      {}\n", lines[0].trim_end());
    for (i, cells) in lines[1..].iter().enumerate() {
        let rhs = unicode(scene, &m.rhs[i]);
        let _ = writeln!(out, "    [ {cells} | {rhs} ]   {}", m.rows[i]);
    }
    out
}

fn counting(out: &mut String, d: &Derivation) {
    let c = &d.counting;
    let used: usize = d.blocks.iter().map(|b| b.equations.len()).sum();
    let _ = writeln!(
        out,
        "full system: {} equations, {} unknowns, rank {}; used here: {used}",
        c.equations, c.unknowns, c.rank
    );
    if c.contradictory {
        let _ = writeln!(
            out,
            "the equations contradict each other, so there is no answer; these cannot hold together:"
        );
        for law in &c.conflict {
            let _ = writeln!(out, "  {law}");
        }
    }
    if !c.open.is_empty() {
        let names: Vec<&str> = c.open.iter().map(|u| d.names.plain(*u)).collect();
        let _ = writeln!(out, "not determined: {}", names.join(", "));
        for law in &c.closing_laws {
            let _ = writeln!(out, "  would close it: {law}");
        }
        if c.rank_with_system == c.rank {
            let _ = writeln!(
                out,
                "  balances of the whole system are sums of those of its bodies and add no rank"
            );
        }
    }
}

fn check(out: &mut String, lead: &str, check: &Check) {
    let mark = match check.holds {
        Some(true) => "✓",
        Some(false) => "✗",
        None => "?",
    };
    let _ = writeln!(out, "{lead}{mark} {}", check.words);
}

fn plural(n: usize) -> &'static str {
    if n == 1 { "" } else { "s" }
}
