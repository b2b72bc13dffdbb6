//! How a request becomes a command line.

use serde_json::{Map, Value};

use super::commands::{Command, Field, Gives, Kind, SCENE};
use super::folder::Folder;
use super::work::Job;

/// Longest text of a field, in bytes; scenes, solutions and lists of answers aside.
const TEXT: usize = 1 << 16;
/// Most values or forms a request may hold.
pub(super) const MANY: usize = 256;

/// A request that is no request: the JSON pointer to what is wrong, and what that is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Bad {
    pub pointer: String,
    pub message: String,
    /// Whether it names a scene that the folder does not have.
    pub is_absent: bool,
}

impl Bad {
    pub(super) fn new(pointer: impl Into<String>, message: impl Into<String>) -> Bad {
        Bad {
            pointer: pointer.into(),
            message: message.into(),
            is_absent: false,
        }
    }

    fn absent(pointer: &str, message: impl Into<String>) -> Bad {
        Bad {
            is_absent: true,
            ..Bad::new(pointer, message)
        }
    }
}

/// The fields of a request's body.
pub(super) fn fields(body: &[u8]) -> Result<Map<String, Value>, Bad> {
    match serde_json::from_slice(body) {
        Ok(Value::Object(fields)) => Ok(fields),
        Ok(_) => Err(Bad::new("", "the body is to be a JSON object")),
        Err(e) => Err(Bad::new("", format!("the body is no JSON: {e}"))),
    }
}

/// Refuses fields of other names.
pub(super) fn only(fields: &Map<String, Value>, known: &[&str]) -> Result<(), Bad> {
    match fields.keys().find(|name| !known.contains(&name.as_str())) {
        None => Ok(()),
        Some(name) => {
            let message = format!("unknown field; known are {}", known.join(", "));
            Err(Bad::new(below("", name), message))
        }
    }
}

/// The text of the scene a request speaks of, if it speaks of one.
pub(super) fn scene(fields: &Map<String, Value>, folder: &Folder) -> Result<Option<String>, Bad> {
    let given = |name| fields.get(name).filter(|v| !v.is_null());
    match (given("scene"), given("name")) {
        (None, None) => Ok(None),
        (Some(Value::String(text)), None) => Ok(Some(text.clone())),
        (Some(object @ Value::Object(_)), None) => Ok(Some(crate::render::pretty(object))),
        (Some(_), None) => Err(Bad::new("/scene", "expected an object or a text")),
        (None, Some(Value::String(name))) => {
            let none = "the folder has no such scene; GET /v1/scenes lists them";
            let text = folder.text(name);
            text.map(Some).ok_or_else(|| Bad::absent("/name", none))
        }
        (None, Some(_)) => Err(Bad::new("/name", "expected a text")),
        (Some(_), Some(_)) => Err(Bad::new("/name", "give a scene or a name, not both")),
    }
}

/// A request as a command line, and the form of what it gives.
pub(super) fn job(
    command: &Command,
    fields: &Map<String, Value>,
    scene: Option<String>,
) -> Result<(Job, Gives), Bad> {
    let own = command.fields.iter().map(|f| f.name);
    let known: Vec<&str> = SCENE.iter().map(|s| s.0).chain(own).collect();
    only(fields, &known)?;
    let mut job = Job {
        arguments: vec![command.name.to_string()],
        ..Job::default()
    };
    match scene {
        Some(text) => {
            job.arguments.push(String::from("-"));
            job.input = text;
        }
        None if command.sceneless => {}
        None => return Err(Bad::new("", "\"scene\" or \"name\" is missing")),
    }
    let mut gives = command.gives;
    let given = |name: &str| fields.get(name).filter(|v| !v.is_null());
    for field in &command.fields {
        if let Some(value) = given(field.name) {
            let is_off = |name: &&&str| given(name).is_none_or(|v| *v == Value::Bool(false));
            if let Some(other) = field.needs.iter().find(is_off) {
                let message = format!("\"{}\" needs \"{other}\" beside it", field.name);
                return Err(Bad::new(below("", field.name), message));
            }
            put(&mut job, field, value)?;
            if let ("format", Value::String(word)) = (field.name, value) {
                gives = match word.as_str() {
                    "json" => gives,
                    "html" => Gives::Text("text/html; charset=utf-8"),
                    "markdown" => Gives::Text("text/markdown; charset=utf-8"),
                    _ => Gives::Text("text/plain; charset=utf-8"),
                };
            }
        }
    }
    if given("format").is_none() {
        let always = command.always.iter().map(ToString::to_string);
        job.arguments.extend(always);
    }
    Ok((job, gives))
}

impl Job {
    /// Adds an option with its value.
    fn give(&mut self, option: &str, value: &str) {
        self.arguments.push(format!("{option}={value}"));
    }
}

/// Adds a field to a command line.
fn put(job: &mut Job, field: &Field, value: &Value) -> Result<(), Bad> {
    let pointer = below("", field.name);
    let expected = |what: &str| Bad::new(&pointer, format!("expected {what}"));
    match (&field.kind, value) {
        (Kind::Text(option), value) => {
            job.give(option, &text(value, &pointer)?);
        }
        (Kind::Flag(option), Value::Bool(wanted)) => {
            job.arguments.extend(wanted.then(|| option.to_string()));
        }
        (Kind::Word(option, words), Value::String(word)) if words.contains(word) => {
            job.give(option, word);
        }
        (Kind::Values(option), Value::Object(values)) if values.len() <= MANY => {
            for (name, value) in values {
                let pointer = below(&pointer, name);
                if name.contains(['=', '\0']) || name.len() > TEXT {
                    return Err(Bad::new(pointer, "this is no name"));
                }
                job.give(option, &format!("{name}={}", text(value, &pointer)?));
            }
        }
        (Kind::Texts(option), Value::Array(texts)) if texts.len() <= MANY => {
            for (i, value) in texts.iter().enumerate() {
                job.give(option, &text(value, &format!("{pointer}/{i}"))?);
            }
        }
        (Kind::Lines(option), Value::String(lines)) => job.file = Some((option, lines.clone())),
        (Kind::List(option), list @ Value::Array(_)) => {
            job.file = Some((option, list.to_string()));
        }
        (Kind::Word(_, words), _) => return Err(expected(&format!("one of {}", words.join(", ")))),
        (Kind::Flag(_), _) => return Err(expected("true or false")),
        (Kind::Values(_), _) => return Err(expected("an object of at most 256 names and values")),
        (Kind::Texts(_), _) => return Err(expected("a list of at most 256 texts")),
        (Kind::Lines(_), _) => return Err(expected("a text")),
        (Kind::List(_), _) => return Err(expected("a list")),
    }
    Ok(())
}

/// A text, or a number as it was written.
fn text(value: &Value, pointer: &str) -> Result<String, Bad> {
    let text = match value {
        Value::String(text) => text.clone(),
        Value::Number(number) => number.to_string(),
        _ => return Err(Bad::new(pointer, "expected a text or a number")),
    };
    if text.len() > TEXT {
        return Err(Bad::new(pointer, format!("at most {TEXT} bytes")));
    }
    if text.contains('\0') {
        return Err(Bad::new(pointer, "the character U+0000 has no place here"));
    }
    Ok(text)
}

/// The JSON pointer to a field.
fn below(pointer: &str, name: &str) -> String {
    format!("{pointer}/{}", name.replace('~', "~0").replace('/', "~1"))
}

/// The lines of a batch, by index, that name a scene which the folder does not have: the id of each, and that name.
pub(super) fn absent_scenes(lines: &str, folder: &Folder) -> Vec<(usize, Value, String)> {
    #[derive(serde::Deserialize)]
    struct Line {
        #[serde(default)]
        id: Value,
        #[serde(alias = "name")]
        scene: Option<String>,
    }
    let mut last = None;
    let each = lines.lines().enumerate().filter_map(|(k, line)| {
        // What cannot be read names no scene; the batch tells what is wrong with it.
        let Ok(Line {
            id,
            scene: Some(name),
        }) = serde_json::from_str(line)
        else {
            return None;
        };
        let is_there = last.as_ref() == Some(&name) || folder.find(&name).is_some();
        match is_there {
            true => {
                last = Some(name);
                None
            }
            false => Some((k, id, name)),
        }
    });
    each.collect()
}
