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
        line(&mut out, "", &refusal);
    }
    line(&mut out, "", &super::heading(&scene.title, &scene.source));
    equations(&mut out, scene, d);
    if !own.is_empty() {
        line(&mut out, "\n", "answers:");
    }
    for answer in own {
        self::answer(&mut out, scene, d, answer);
    }
    if !d.definitions.is_empty() {
        line(&mut out, "\n", "where:");
        for definition in &d.definitions {
            line(
                &mut out,
                "  ",
                &format!(
                    "{} = {}",
                    definition.name,
                    unicode(scene, &definition.value)
                ),
            );
            line(&mut out, "      ", &definition.meaning);
        }
    }
    let under = super::assumptions(scene, d, proof);
    if !under.is_empty() {
        line(&mut out, "\nunder: ", &under.join(", "));
    }
    let only = super::possible::conditions(scene, possible);
    if !only.is_empty() {
        line(&mut out, "\npossible where: ", &only.join(", "));
    }
    left_out(&mut out, d);
    line(&mut out, "\n", "checked:");
    proof.scene.iter().for_each(|c| check(&mut out, "  ", c));
    if let Some(possible) = super::possible::check(scene, possible) {
        check(&mut out, "  ", &possible);
    }
    for words in &possible.not_judged {
        line(&mut out, "  – not judged: ", words);
    }
    for note in &possible.notes {
        line(&mut out, "  – ", note);
    }
    for (answer, checks) in d.answers.iter().zip(&proof.answers) {
        for c in checks {
            check(&mut out, &format!("  {}: ", answer.name), c);
        }
    }
    if !about.is_empty() {
        line(&mut out, "\n", "asked about these answers:");
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
            line(
                out,
                "  ",
                &format!("{} = {}{}", answer.name, unicode(scene, short), value),
            );
            line(
                out,
                "      ",
                &format!("{} [{}]", answer.words, answer.dimension.spoken()),
            );
        }
        Form::Equation { left, right } => {
            line(
                out,
                "  ",
                &format!(
                    "{}: {} = {}",
                    answer.name,
                    unicode(scene, left),
                    unicode(scene, right)
                ),
            );
            line(out, "      ", &answer.words);
        }
        Form::Matrix(m) => {
            line(out, "  ", &format!("{}: {}", answer.name, answer.words));
            matrix_lines(out, scene, m);
            for sentence in &answer.text {
                line(out, "      ", &sentence.written(|e| unicode(scene, e)));
            }
        }
        Form::Words => {}
        Form::Open(names) => {
            line(
                out,
                "  ",
                &format!(
                    "{}: not determined by the laws ({} open)",
                    answer.name,
                    names.join(", ")
                ),
            );
        }
    }
}

/// How many equations there are, and the blocks that answer the questions.
pub(super) fn equations(out: &mut String, scene: &Scene, d: &Derivation) {
    counting(out, d);
    for (unknown, value) in &d.given {
        let name = d.names.plain(*unknown);
        line(
            out,
            "\ngiven: ",
            &format!("{name} = {}", unicode(scene, value)),
        );
    }
    for block in &d.blocks {
        let n = block.equations.len();
        let heading = format!("{n} equation{} in {n} unknown{}:", plural(n), plural(n));
        line(out, "\n", &heading);
        for equation in &block.equations {
            let (left, right) = super::sides(d, equation);
            line(out, "  ", &laws::describe(scene, &equation.law));
            line(
                out,
                "      ",
                &format!("{} = {}", unicode(scene, &left), unicode(scene, &right)),
            );
        }
        for (unknown, value) in block.unknowns.iter().zip(d.solution(block)) {
            let value = unicode(scene, &value);
            if value.chars().count() <= 120 {
                line(
                    out,
                    "  ⇒   ",
                    &format!("{} = {value}", d.names.plain(*unknown)),
                );
            }
        }
    }
}

/// What the scene did not need.
pub(super) fn left_out(out: &mut String, d: &Derivation) {
    if !d.left_out.is_empty() {
        line(out, "\n", "left out:");
        for left in &d.left_out {
            line(out, "  ", &format!("{}: {}", left.what, left.why));
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
        line(&mut out, "", &format!("{} = {text}", number.name));
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
    line(out, "      ", lines[0].trim_end());
    for (i, cells) in lines[1..].iter().enumerate() {
        let rhs = unicode(scene, &m.rhs[i]);
        line(out, "    [ ", &format!("{cells} | {rhs} ]   {}", m.rows[i]));
    }
}

fn counting(out: &mut String, d: &Derivation) {
    let c = &d.counting;
    let used: usize = d.blocks.iter().map(|b| b.equations.len()).sum();
    line(
        out,
        "",
        &format!(
            "full system: {} equations, {} unknowns, rank {}; used here: {used}",
            c.equations, c.unknowns, c.rank
        ),
    );
    if c.contradictory {
        line(
            out,
            "",
            "the equations contradict each other, so there is no answer; these cannot hold together:",
        );
        c.conflict.iter().for_each(|law| line(out, "  ", law));
    }
    if !c.open.is_empty() {
        let names: Vec<&str> = c.open.iter().map(|u| d.names.plain(*u)).collect();
        line(out, "", &format!("not determined: {}", names.join(", ")));
        for law in &c.closing_laws {
            line(out, "  would close it: ", law);
        }
        if c.rank_with_system == c.rank {
            line(
                out,
                "  ",
                "balances of the whole system are sums of those of its bodies and add no rank",
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
    line(out, lead, &format!("{mark} {}", check.words));
}

fn line(out: &mut String, lead: &str, text: &str) {
    // Writing to a string cannot fail.
    let _ = writeln!(out, "{lead}{text}");
}

fn plural(n: usize) -> &'static str {
    if n == 1 { "" } else { "s" }
}
