//! One line of a batch: JSON text in, what to judge out; and the judging of many lines with keys read once.
//!
//! Knows no files: a scene named in a line is asked of the caller.

mod strict;

use std::collections::HashMap;
use std::sync::Arc;

use serde_json::{Map, Value};

use super::{Form, Given, Grade, Key, Options, Question, Tolerance, number};
use crate::dimension;
use crate::domain::{Domain, Limit};
use crate::expr::Rational;
use crate::formula::Fault;

/// Longest line, in bytes.
pub const MAX_LINE: usize = 1 << 18;

/// Keys kept at a time; when there are more, all are read anew.
const KEYS: usize = 1024;

/// What one line asks.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Whatever the line has as `id`, given back as it came.
    pub id: Value,
    /// The expected formula, where no scene is named.
    pub expected: Option<String>,
    /// The answer to judge.
    pub answer: String,
    /// The scene whose derivation is the key.
    pub scene: Option<String>,
    /// Which of its questions.
    pub quantity: Option<String>,
    /// The declarations.
    pub question: Question,
    /// How to compare.
    pub options: Options,
    /// The declarations as written: with `expected` they name a key.
    declared: String,
}

/// Why a line cannot be judged, with its `id` where that could be read.
#[derive(Clone, Debug)]
pub struct BadLine {
    /// The `id`, or null.
    pub id: Value,
    /// What is wrong.
    pub message: String,
}

/// Reads a line. `defaults` holds what the command line asks for; the line may ask for more.
pub fn entry(line: &str, defaults: &Options) -> Result<Entry, BadLine> {
    let bad = |id: &Value, message: String| BadLine {
        id: id.clone(),
        message,
    };
    if line.len() > MAX_LINE {
        return Err(bad(
            &id_in(line),
            format!("a line has at most {MAX_LINE} bytes"),
        ));
    }
    let line = line.trim_start_matches('\u{feff}');
    let value = strict::value(line).map_err(|(id, message)| bad(&id, message))?;
    let Value::Object(fields) = value else {
        return Err(bad(
            &Value::Null,
            "a line is a JSON object with \"expected\" and \"answer\"".into(),
        ));
    };
    let id = fields.get("id").cloned().unwrap_or(Value::Null);
    fill(&fields, &id, defaults).map_err(|message| bad(&id, message))
}

pub use strict::id_in;

fn fill(fields: &Map<String, Value>, id: &Value, defaults: &Options) -> Result<Entry, String> {
    const FIELDS: &str = "id, expected, answer, scene, name, quantity, symbols, tolerance, form";
    let is_known = |name: &str| FIELDS.split(", ").any(|field| field == name);
    if let Some(name) = fields.keys().find(|name| !is_known(name)) {
        return Err(format!("unknown field {name:?}; known are {FIELDS}"));
    }
    let text = |name: &str| match fields.get(name) {
        None | Some(Value::Null) => Ok(None),
        Some(Value::String(s)) => Ok(Some(s.clone())),
        Some(Value::Number(n)) => Ok(Some(n.to_string())),
        Some(_) => Err(format!("\"{name}\" is to be a text")),
    };
    let answer = text("answer")?.ok_or("\"answer\" is missing")?;
    // Requests over HTTP name a scene so.
    if fields.contains_key("scene") && fields.contains_key("name") {
        return Err("give \"scene\" or \"name\", not both".into());
    }
    let (expected, scene) = (text("expected")?, text("scene")?.or(text("name")?));
    if expected.is_none() && scene.is_none() {
        return Err("\"expected\" is missing, and no \"scene\" is named".into());
    }
    let mut question = Question::default();
    let mut declared = String::new();
    if let Some(symbols) = fields.get("symbols") {
        let Value::Object(symbols) = symbols else {
            return Err("\"symbols\" is to be an object of names".into());
        };
        for (name, entry) in symbols {
            declare(&mut question, name, entry)?;
        }
        declared = Value::Object(symbols.clone()).to_string();
    }
    let mut options = defaults.clone();
    if let Some(value) = fields.get("tolerance").filter(|v| !v.is_null()) {
        options.tolerance = Some(tolerance(value)?);
    }
    if let Some(value) = fields.get("form").filter(|v| !v.is_null()) {
        let list = match value {
            Value::Array(list) => list.clone(),
            one => vec![one.clone()],
        };
        for form in list {
            let read = form.as_str().and_then(Form::read);
            options.forms.push(read.ok_or_else(|| {
                format!("form {form} is none of \"simplified\", \"factored\", \"unit\", \"digits=3\", \"only=m,v\"")
            })?);
        }
    }
    Ok(Entry {
        id: id.clone(),
        expected,
        answer,
        scene,
        quantity: text("quantity")?,
        question,
        options,
        declared,
    })
}

fn declare(question: &mut Question, name: &str, entry: &Value) -> Result<(), String> {
    let valid = !name.is_empty()
        && name.len() <= 64
        && name
            .chars()
            .all(|c| c.is_alphanumeric() || "_'^+-{}\\".contains(c));
    if !valid {
        return Err(format!("{name:?} is no name of a symbol"));
    }
    let mut given = Given::named(name);
    let fields = match entry {
        Value::Null => Map::new(),
        Value::Object(fields) => fields.clone(),
        // The short form: "m": "positive".
        Value::String(_) => Map::from_iter([("domain".to_string(), entry.clone())]),
        _ => return Err(format!("the declaration of {name} is to be an object")),
    };
    if &*given.name == "pi" {
        return Err("pi is the number π, and no symbol".into());
    }
    for (key, value) in &fields {
        match (key.as_str(), value) {
            ("domain", value) => {
                let domain = domain(value).map_err(|what| format!("domain of {name}: {what}"))?;
                question.domains.symbols.insert(given.name.clone(), domain);
            }
            ("dimension" | "unit", Value::String(text)) => {
                let unit = dimension::unit(text)
                    .map_err(|fault| format!("dimension of {name}: {}", fault.message))?;
                given.dimension = Some(unit.dimension);
            }
            ("latex", Value::String(text)) => given.latex = Some(text.clone()),
            (other, _) => {
                return Err(format!(
                    "{name} has no {other:?}: known are domain, dimension, latex"
                ));
            }
        }
    }
    question.symbols.push(given);
    Ok(())
}

/// `"positive"`, `"nonnegative"`, `"real"` or an object with `min` and `max`, each a number or a multiple of pi.
pub fn domain(value: &Value) -> Result<Domain, String> {
    match value {
        Value::String(word) => match word.as_str() {
            "positive" => Ok(Domain::positive()),
            "nonnegative" => Ok(Domain::nonnegative()),
            "real" => Ok(Domain::real()),
            other => Err(format!("{other:?} is none of positive, nonnegative, real")),
        },
        Value::Object(fields) => {
            let open = |name: &str| fields.get(name).and_then(Value::as_bool).unwrap_or(false);
            let mut out = Domain::default();
            for (key, value) in fields {
                match key.as_str() {
                    "min" => out.low = limit(value, open("open") || open("min_open"))?,
                    "max" => out.high = limit(value, open("open") || open("max_open"))?,
                    "open" | "min_open" | "max_open" if value.is_boolean() => {}
                    other => {
                        return Err(format!(
                            "unknown {other:?}; known are min, max, open, min_open, max_open"
                        ));
                    }
                }
            }
            match (&out.low, &out.high) {
                (Some(l), Some(h)) if l.approximate() > h.approximate() => {
                    Err("min is above max".into())
                }
                _ => Ok(out),
            }
        }
        _ => Err("a domain is a word or an object with min and max".into()),
    }
}

fn limit(value: &Value, open: bool) -> Result<Option<Limit>, String> {
    let text = match value {
        Value::Null => return Ok(None),
        Value::Number(n) => n.to_string(),
        Value::String(s) => s.clone(),
        other => return Err(format!("{other} is no number")),
    };
    let no_number = || format!("{text:?} is neither a number nor a multiple of pi");
    let e = crate::formula::read_expr(&text, &crate::formula::Symbols::strict())
        .map_err(|_| no_number())?;
    if let Some(value) = super::fraction(&e) {
        return Ok(Some(Limit::number(value, open)));
    }
    let angle = crate::expr::angle::angle(&e)
        .filter(|a| a.symbols.is_empty())
        .ok_or_else(no_number)?;
    Ok(Some(Limit::pi(angle.pi, open)))
}

/// A tolerance as a line writes it.
pub fn tolerance(value: &Value) -> Result<Tolerance, String> {
    let wrong = || {
        format!(
            "tolerance {value} is none of \"2%\", \"0.1 m\", {{\"relative\": 0.02}}, {{\"absolute\": 0.1}}, {{\"significant\": 3}}"
        )
    };
    let amount = |v: &Value| -> Option<Rational> {
        let found = match v {
            Value::Number(n) => number::decimal(&n.to_string()),
            Value::String(s) => match Tolerance::read(s)? {
                Tolerance::Relative(share) => Some(share),
                _ => None,
            },
            _ => None,
        };
        found.filter(|f| !num_traits::Signed::is_negative(f))
    };
    match value {
        Value::String(text) => Tolerance::read(text).ok_or_else(wrong),
        Value::Number(_) => amount(value).map(Tolerance::Relative).ok_or_else(wrong),
        Value::Object(fields) if fields.len() == 1 => {
            let (key, v) = fields.iter().next().ok_or_else(wrong)?;
            match key.as_str() {
                "relative" => amount(v).map(Tolerance::Relative).ok_or_else(wrong),
                "absolute" => amount(v).map(Tolerance::Absolute).ok_or_else(wrong),
                "significant" => {
                    let digits = v
                        .as_u64()
                        .filter(|n| (1..=40).contains(n))
                        .ok_or_else(wrong)?;
                    Ok(Tolerance::Significant(digits as u32))
                }
                _ => Err(wrong()),
            }
        }
        _ => Err(wrong()),
    }
}

/// Keys read so far; bounded.
#[derive(Default)]
pub struct Keys {
    known: HashMap<(String, String), Arc<Result<Key, Fault>>>,
}

impl Keys {
    /// The key of an entry with an expected formula, read at most once while it is kept.
    pub fn key(&mut self, entry: &Entry, expected: &str) -> Arc<Result<Key, Fault>> {
        let name = (expected.to_string(), entry.declared.clone());
        if let Some(key) = self.known.get(&name) {
            return key.clone();
        }
        if self.known.len() >= KEYS {
            self.known.clear();
        }
        let key = Arc::new(super::key(expected, &entry.question));
        self.known.insert(name, key.clone());
        key
    }
}

/// The grade of a line that cannot be judged for a reason outside the formulas.
pub fn refused(message: String) -> Grade {
    let fault = *Fault::new(message, 0, 0);
    Grade::invalid("INVALID_LINE", "the line cannot be judged", fault)
}

/// Judges an entry; `in_scene` judges those that name a scene.
pub fn judge(
    entry: &Entry,
    keys: &mut Keys,
    in_scene: &dyn Fn(&Entry, &str) -> Result<Grade, String>,
) -> Grade {
    match (&entry.scene, &entry.expected) {
        (Some(scene), _) => in_scene(entry, scene).unwrap_or_else(refused),
        (None, Some(expected)) => match &*keys.key(entry, expected) {
            Ok(key) => super::judge_against(key, &entry.answer, &entry.options),
            Err(fault) => super::unreadable_key(fault.clone()),
        },
        (None, None) => refused("\"expected\" is missing".into()),
    }
}
