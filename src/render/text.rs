//! A derivation for the terminal: the answers, the few equations they took, what was left out, how it was checked.

use std::fmt::Write;

use super::unicode;
use crate::answer::{Answer, Check, Form, Matrix};
use crate::derive::Derivation;
use crate::laws;
use crate::scene::Scene;
use crate::story::{Case, Told};

/// The one impact of a scene as plain text.
pub(super) fn impact(scene: &Scene, told: &Told, impact: &Case) -> String {
    let Case {
        derivation: d,
        proof,
        possible,
        ..
    } = impact;
    let (own, about) = told.answers.split_at(d.answers.len());
    let mut out = String::new();
    if let Some(refusal) = possible.refusal() {
        let _ = writeln!(out, "{refusal}");
    }
    let _ = writeln!(out, "{}", super::heading(&scene.title, &scene.source));
    equations(&mut out, scene, d);
    if !own.is_empty() {
        let _ = writeln!(out, "\nanswers:");
    }
    for answer in own {
        self::answer(&mut out, scene, d, answer);
    }
    if !d.definitions.is_empty() {
        let _ = writeln!(out, "\nwhere:");
        for definition in &d.definitions {
            let _ = writeln!(
                out,
                "  {} = {}",
                definition.name,
                unicode(scene, &definition.value)
            );
            let _ = writeln!(out, "      {}", definition.meaning);
        }
    }
    let under = super::assumptions(scene, d, proof);
    if !under.is_empty() {
        let _ = writeln!(out, "\nunder: {}", under.join(", "));
    }
    let only = super::possible::conditions(scene, possible);
    if !only.is_empty() {
        let _ = writeln!(out, "\npossible where: {}", only.join(", "));
    }
    left_out(&mut out, d);
    let _ = writeln!(out, "\nchecked:");
    proof.scene.iter().for_each(|c| check(&mut out, "  ", c));
    if let Some(possible) = super::possible::check(scene, possible) {
        check(&mut out, "  ", &possible);
    }
    for words in &possible.not_judged {
        let _ = writeln!(out, "  – not judged: {words}");
    }
    for note in &possible.notes {
        let _ = writeln!(out, "  – {note}");
    }
    for (answer, checks) in d.answers.iter().zip(&proof.answers) {
        for c in checks {
            check(&mut out, &format!("  {}: ", answer.name), c);
        }
    }
    if !about.is_empty() {
        let _ = writeln!(out, "\nasked about these answers:");
        out.push_str(&super::story::answers(scene, about));
    }
    out
}

/// An answer: its formula with its value, its equation, its matrix, or that it stays open.
fn answer(out: &mut String, scene: &Scene, d: &Derivation, answer: &Answer) {
    match &answer.form {
        Form::Value { closed, short } => {
            let value = super::answer_value(scene, d, closed)
                .filter(|_| !closed.is_zero())
                .map_or(String::new(), |v| {
                    let number = super::digits(v.approximate);
                    format!(" = {}", answer.dimension.measured(&number))
                });
            let _ = writeln!(
                out,
                "  {} = {}{}",
                answer.name,
                unicode(scene, short),
                value
            );
            let _ = writeln!(
                out,
                "      {} [{}]",
                answer.words,
                answer.dimension.spoken()
            );
        }
        Form::Equation { left, right } => {
            let _ = writeln!(
                out,
                "  {}: {} = {}",
                answer.name,
                unicode(scene, left),
                unicode(scene, right)
            );
            let _ = writeln!(out, "      {}", answer.words);
        }
        Form::Matrix(m) => {
            let _ = writeln!(out, "  {}: {}", answer.name, answer.words);
            matrix_lines(out, scene, m);
            for sentence in &answer.text {
                let _ = writeln!(out, "      {}", sentence.written(|e| unicode(scene, e)));
            }
        }
        Form::Words => {}
        Form::Open(names) => {
            let _ = writeln!(
                out,
                "  {}: not determined by the laws ({} open)",
                answer.name,
                names.join(", ")
            );
        }
    }
}

/// How many equations there are, and the blocks that answer the questions.
pub(super) fn equations(out: &mut String, scene: &Scene, d: &Derivation) {
    counting(out, d);
    for (unknown, value) in &d.given {
        let name = d.names.plain(*unknown);
        let _ = writeln!(out, "\ngiven: {name} = {}", unicode(scene, value));
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
                let _ = writeln!(out, "  ⇒   {} = {value}", d.names.plain(*unknown));
            }
        }
    }
}

/// What the scene did not need.
pub(super) fn left_out(out: &mut String, d: &Derivation) {
    if !d.left_out.is_empty() {
        let _ = writeln!(out, "\nleft out:");
        for left in &d.left_out {
            let _ = writeln!(out, "  {}: {}", left.what, left.why);
        }
    }
}

/// Numbers, one a line.
pub fn numbers(scene: &Scene, numbers: &[super::Number]) -> String {
    let mut out = String::new();
    for number in numbers {
        let unit = super::unit_of(scene, &number.question);
        let text = match &number.value {
            Ok(value) => match &value.exact {
                Some(exact) => format!("{exact} {unit} ≈ {}", super::digits(value.approximate)),
                None => format!("{} {unit}", super::double(value.approximate)),
            },
            Err(reason) => reason.clone(),
        };
        let _ = writeln!(out, "{} = {text}", number.name);
    }
    out
}

/// A matrix, one row a line.
pub fn matrix(scene: &Scene, m: &Matrix) -> String {
    let mut out = String::new();
    matrix_lines(&mut out, scene, m);
    out
}

fn matrix_lines(out: &mut String, scene: &Scene, m: &Matrix) {
    let entries = m.entries.iter();
    let entries = entries.map(|row| row.iter().map(|e| unicode(scene, e)).collect());
    let rows: Vec<Vec<String>> = [m.unknowns.clone()].into_iter().chain(entries).collect();
    let lines = super::columns(&rows, |_| false);
    let _ = writeln!(out, "      {}", lines[0].trim_end());
    for (i, cells) in lines[1..].iter().enumerate() {
        let rhs = unicode(scene, &m.rhs[i]);
        let _ = writeln!(out, "    [ {cells} | {rhs} ]   {}", m.rows[i]);
    }
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
        Some(false) => "✗ FAILED:",
        None => "–",
    };
    let _ = writeln!(out, "{lead}{mark} {}", check.words);
}

fn plural(n: usize) -> &'static str {
    if n == 1 { "" } else { "s" }
}
