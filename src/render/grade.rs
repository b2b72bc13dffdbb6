//! Grades for programs (JSON) and for people.

use serde::Serialize;
use serde_json::{Value, json};

use super::cut;
use crate::formula::Fault;
use crate::grade::steps::{Line, Status, Worked};
use crate::grade::{Apart, Diagnosis, Grade, Proof, Verdict};

/// A grade as it is written for programs.
#[derive(Serialize)]
struct Written<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    id: Option<&'a Value>,
    version: u32,
    verdict: &'static str,
    reward: Option<u8>,
    proof: &'a Proof,
    note: &'static str,
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    assumed: &'a [String],
    #[serde(skip_serializing_if = "Option::is_none")]
    counterexample: &'a Option<Apart>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<Value>,
    #[serde(skip_serializing_if = "<[Diagnosis]>::is_empty")]
    diagnosis: &'a [Diagnosis],
    read_as: Option<String>,
    symbols: Vec<String>,
}

impl<'a> Written<'a> {
    /// `text` is the formula an error speaks of: its places are told in characters.
    fn of(id: Option<&'a Value>, grade: &'a Grade, text: &str) -> Written<'a> {
        Written {
            id,
            version: super::VERSION,
            verdict: grade.verdict.word(),
            reward: grade.verdict.reward(),
            proof: &grade.proof,
            note: grade.note,
            assumed: &grade.assumed,
            counterexample: &grade.counterexample,
            error: grade.error.as_ref().map(|fault| error(fault, text)),
            diagnosis: &grade.diagnosis,
            read_as: grade.read_as(),
            symbols: grade.symbols().iter().map(|s| s.to_string()).collect(),
        }
    }
}

/// A grade as data. `text` is the formula an error speaks of: its places are told in characters.
pub fn json(grade: &Grade, text: &str) -> Value {
    json!(Written::of(None, grade, text))
}

/// The same with an `id`, appended to `out` as one line; a batch spends no time on building values. An error tells the number
/// of its line, from 1.
pub fn line(out: &mut String, id: &Value, number: u64, grade: &Grade, text: &str) {
    let mut written = Written::of(Some(id), grade, text);
    if let Some(error) = &mut written.error {
        error["line"] = json!(number);
    }
    // Texts and numbers can always be written.
    out.push_str(&serde_json::to_string(&written).unwrap_or_default());
    out.push('\n');
}

/// Longest message of a fault, in characters.
const MESSAGE: usize = 600;

/// A fault of a formula as data.
pub fn error(fault: &Fault, text: &str) -> Value {
    let characters = |byte: usize| text.char_indices().take_while(|(i, _)| *i < byte).count();
    let mut out = json!({
        "message": super::shortened(&fault.message, MESSAGE),
        "start": characters(fault.start),
        "end": characters(fault.end),
    });
    if let (Some(hint), Value::Object(fields)) = (&fault.hint, &mut out) {
        fields.insert("hint".into(), json!(super::shortened(hint, MESSAGE)));
    }
    out
}

/// A grade for the terminal.
pub fn text(grade: &Grade, answer: &str) -> String {
    let mut out = format!("{} · {}\n", grade.verdict.word(), grade.note);
    let mut line = |label: &str, words: &str| {
        let words: Vec<String> = words.lines().map(cut).collect();
        let words = words.join("\n          ");
        out.push_str(&format!("{label:<10}{words}\n"));
    };
    if let Some(read) = &grade.read_as() {
        line("read as", read);
    }
    if let Some(fault) = &grade.error {
        line("error", &fault.show(answer));
    }
    let bound = grade
        .proof
        .bound
        .map_or(String::new(), |b| format!(" (error below {b:.0e})"));
    line("because", &format!("{}{bound}", grade.proof.words));
    if let Some(c) = &grade.counterexample {
        let place = if c.at.is_empty() {
            String::new()
        } else {
            format!("with {}: ", c.at)
        };
        line(
            "at",
            &format!("{place}yours {}, expected {}", c.yours, c.expected),
        );
    }
    for d in &grade.diagnosis {
        line("finding", &format!("{} [{}]", d.message, d.code));
        if d.hint != d.message {
            line("  hint", &d.hint);
        }
    }
    if !grade.assumed.is_empty() {
        line("assumed", &grade.assumed.join(", "));
    }
    out
}

/// The word for what was found of a line, and more about it.
fn step_words(line: &Line) -> (&'static str, String) {
    match &line.status {
        Status::Holds => ("holds", String::new()),
        Status::Defines => ("defines", String::new()),
        Status::Wrong => ("WRONG", String::new()),
        Status::Carried(cause) => (
            "carried",
            format!("follows from line {cause}, which does not hold"),
        ),
        Status::Unreadable(fault) => ("unread", fault.to_string()),
        Status::Comment => ("words", String::new()),
        Status::Undecided => ("open", "could not be decided".into()),
    }
}

/// A worked solution for the terminal: each line with its verdict, a summary, and the verdict on each final answer.
pub fn steps_text(worked: &Worked) -> String {
    let lines = &worked.lines;
    let mut out = String::new();
    for line in lines {
        let (word, more) = step_words(line);
        let said = cut(&line.text);
        out.push_str(&format!("{:>3}  {word:<8} {said}\n", line.number));
        if !more.is_empty() {
            out.push_str(&format!("              {}\n", cut(&more)));
        }
        for d in &line.diagnosis {
            let message = cut(&d.message);
            out.push_str(&format!("              {message} [{}]\n", d.code));
        }
    }
    out.push_str(&summary(lines));
    out.push('\n');
    let mut missing = Vec::new();
    for (name, last) in &worked.finals {
        match last {
            Some(last) => {
                let word = match last.verdict {
                    Verdict::Equivalent => "right",
                    Verdict::Different => "wrong",
                    Verdict::Invalid | Verdict::Undecided => "not decided",
                };
                out.push_str(&format!(
                    "final answer for {name}: {word}, in line {}\n",
                    last.line
                ));
            }
            None => missing.push(name.as_str()),
        }
    }
    if !missing.is_empty() {
        out.push_str(&format!("no final answer for {}\n", missing.join(", ")));
    }
    out
}

fn hold(lines: usize) -> &'static str {
    if lines == 1 {
        "line holds"
    } else {
        "lines hold"
    }
}

fn summary(lines: &[Line]) -> String {
    let count = |f: &dyn Fn(&Status) -> bool| lines.iter().filter(|l| f(&l.status)).count();
    let holds = count(&|s| matches!(s, Status::Holds));
    let defined = match count(&|s| matches!(s, Status::Defines)) {
        0 => String::new(),
        1 => ", 1 gives a name".to_string(),
        n => format!(", {n} give names"),
    };
    let carried = count(&|s| matches!(s, Status::Carried(_)));
    let wrong = count(&|s| matches!(s, Status::Wrong));
    let first = lines.iter().find(|l| l.status == Status::Wrong);
    match first {
        None => format!("{} {}{defined}, none is wrong", holds, hold(holds)),
        Some(first) => format!(
            "first wrong line: {}; {holds} {}{defined}, {carried} {} from a slip, {wrong} {} of {} own",
            first.number,
            hold(holds),
            if carried == 1 { "follows" } else { "follow" },
            if wrong == 1 {
                "has a slip"
            } else {
                "have a slip"
            },
            if wrong == 1 { "its" } else { "their" },
        ),
    }
}

/// A worked solution as data.
pub fn steps_json(worked: &Worked) -> Value {
    let lines = &worked.lines;
    let all: Vec<Value> = lines
        .iter()
        .map(|line| {
            let (word, more) = step_words(line);
            let cause = match &line.status {
                Status::Carried(cause) => json!(cause),
                _ => Value::Null,
            };
            json!({
                "line": line.number,
                "text": line.text,
                "status": word.to_lowercase(),
                "follows_from": cause,
                "words": more,
                "diagnosis": line.diagnosis,
            })
        })
        .collect();
    let first = lines
        .iter()
        .find(|l| l.status == Status::Wrong)
        .map(|l| l.number);
    let answers = worked.finals.iter().map(|(name, last)| match last {
        Some(last) => json!({
            "quantity": name,
            "verdict": last.verdict.word(),
            "line": last.line,
            "text": last.text,
        }),
        None => json!({"quantity": name, "verdict": "missing", "line": null, "text": null}),
    });
    let answers: Vec<Value> = answers.collect();
    json!({"lines": all, "first_wrong": first, "summary": summary(lines), "answers": answers})
}
