//! What programs may ask: the commands, the fields of their requests, and how a request becomes a command line.

use serde_json::{Map, Value};

use super::folder::Folder;
use super::work::Job;

/// Longest text of a field, in bytes; scenes, solutions and lists of answers aside.
const TEXT: usize = 1 << 16;
/// Most values or forms a request may hold.
pub(super) const MANY: usize = 256;

/// A command that can be asked for.
pub(super) struct Command {
    /// Its name, here and on the command line.
    pub name: &'static str,
    /// What it does.
    pub what: &'static str,
    /// Its own fields.
    pub fields: &'static [Field],
    /// Options it is always given; a format that is asked for takes the place of them.
    always: &'static [&'static str],
    /// What comes back if the request names no format.
    pub gives: Gives,
    /// Whether it can do without a scene.
    pub sceneless: bool,
}

/// A field of a request.
pub(super) struct Field {
    /// Its name.
    pub name: &'static str,
    /// What it may hold, and the option it becomes.
    pub kind: Kind,
    /// What it is for.
    pub what: &'static str,
}

/// What a field may hold; each kind carries the option of the command line it becomes.
#[derive(Clone, Copy)]
pub(super) enum Kind {
    /// An object of names and values, such as {"v": 2, "theta": "pi/6"}.
    Values(&'static str),
    /// A text or a number.
    Text(&'static str),
    /// One of these words.
    Word(&'static str, &'static [&'static str]),
    /// Whether something is wanted.
    Flag(&'static str),
    /// Several texts.
    Texts(&'static str),
    /// A text of several lines.
    Lines(&'static str),
    /// A list of objects.
    List(&'static str),
}

/// The form of an answer.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Gives {
    /// JSON, to which the version is added.
    Json,
    /// JSON that tells its version itself.
    OwnJson,
    /// Text of this type.
    Text(&'static str),
}

const SET: Field = Field {
    name: "set",
    kind: Kind::Values("--set"),
    what: "values of parameters in their units, such as {\"v\": 2, \"theta\": \"pi/6\"}",
};
const STAGE: Field = Field {
    name: "stage",
    kind: Kind::Text("--stage"),
    what: "only this stage",
};

/// All commands.
pub(super) const COMMANDS: &[Command] = &[
    Command {
        name: "derive",
        what: "closed forms, the equations they took, what was left out, the proof",
        fields: &[
            SET,
            STAGE,
            Field {
                name: "matrix",
                kind: Kind::Flag("--matrix"),
                what: "the full system of equations in matrix form instead",
            },
        ],
        always: &["--format=json"],
        gives: Gives::Json,
        sceneless: false,
    },
    Command {
        name: "solve",
        what: "numbers with units, from the geometry alone; a scene with stages is followed in time",
        fields: &[
            SET,
            Field {
                name: "exact",
                kind: Kind::Flag("--exact"),
                what: "exact fractions instead of doubles",
            },
            Field {
                name: "certify",
                kind: Kind::Flag("--certify"),
                what: "the double nearest to each true value",
            },
        ],
        always: &["--format=json"],
        gives: Gives::Json,
        sceneless: false,
    },
    Command {
        name: "grade",
        what: "whether an answer is right, how that is known, and what is wrong with it",
        fields: &[
            Field {
                name: "quantity",
                kind: Kind::Text("--quantity"),
                what: "the question of the scene that is answered",
            },
            Field {
                name: "expected",
                kind: Kind::Text("--expected"),
                what: "the expected formula, where there is no scene",
            },
            Field {
                name: "answer",
                kind: Kind::Text("--answer"),
                what: "the answer to judge",
            },
            Field {
                name: "steps",
                kind: Kind::Lines("--steps"),
                what: "a worked solution, one equation a line, instead of an answer",
            },
            Field {
                name: "symbols",
                kind: Kind::Values("--symbol"),
                what: "domains of symbols where there is no scene, such as {\"e\": \"0..1\"}",
            },
            Field {
                name: "tolerance",
                kind: Kind::Text("--tolerance"),
                what: "how far a number may be off, such as 2%",
            },
            Field {
                name: "form",
                kind: Kind::Texts("--form"),
                what: "demands on the form: simplified, factored, unit, digits=3, only=m,v",
            },
            Field {
                name: "proof",
                kind: Kind::Word("--proof", &["identity", "fast"]),
                what: "how strong a proof of equality has to be",
            },
            Field {
                name: "slash",
                kind: Kind::Word("--slash", &["usual", "strict"]),
                what: "what a slash without brackets means",
            },
        ],
        always: &["--format=json"],
        gives: Gives::Json,
        sceneless: true,
    },
    Command {
        name: "verify",
        what: "which printed formulas, numbers and matrix entries hold, and what explains those that do not",
        fields: &[Field {
            name: "answers",
            kind: Kind::List("--answers"),
            what: "printed things in the form of a scene's \"printed\", instead of its own",
        }],
        always: &["--format=json"],
        gives: Gives::Json,
        sceneless: false,
    },
    Command {
        name: "solution",
        what: "the worked solution; as JSON each step is a claim that can be replayed",
        fields: &[
            SET,
            Field {
                name: "format",
                kind: Kind::Word(
                    "--format",
                    &[
                        "json",
                        "html",
                        "markdown",
                        "text",
                        "latex",
                        "latex-fragment",
                    ],
                ),
                what: "the format",
            },
            Field {
                name: "detail",
                kind: Kind::Word("--detail", &["brief", "normal", "full"]),
                what: "how much is shown",
            },
        ],
        always: &["--format=json"],
        gives: Gives::OwnJson,
        sceneless: false,
    },
    Command {
        name: "compare",
        what: "laws of friction side by side at the values of a scene",
        fields: &[SET],
        always: &["--format=json"],
        gives: Gives::Json,
        sceneless: false,
    },
    Command {
        name: "draw",
        what: "the pictures of a scene as one SVG",
        fields: &[
            SET,
            STAGE,
            Field {
                name: "which",
                kind: Kind::Word("--which", &["before", "during", "after", "all"]),
                what: "the moment",
            },
            Field {
                name: "body",
                kind: Kind::Text("--body"),
                what: "the free-body diagram of this body alone",
            },
            Field {
                name: "plot",
                kind: Kind::Text("--plot"),
                what: "this plot of the scene instead",
            },
        ],
        always: &[],
        gives: Gives::Text("image/svg+xml; charset=utf-8"),
        sceneless: false,
    },
    Command {
        name: "describe",
        what: "parameters of a scene with ranges for sliders, its stages and plots, and how formulas about it are read; where it cannot be read, what is wrong and where",
        fields: &[
            SET,
            Field {
                name: "formulas",
                kind: Kind::Texts("--formula"),
                what: "formulas about the scene, given back as plain text and as MathML",
            },
            Field {
                name: "symbols",
                kind: Kind::Texts("--symbol"),
                what: "symbols in LaTeX, given back as MathML",
            },
        ],
        always: &[],
        gives: Gives::Json,
        sceneless: false,
    },
];

/// What a request for a command needs besides its own fields.
pub(super) const SCENE: [(&str, &str); 2] = [
    ("scene", "a scene: an object, or the text of a scene file"),
    ("name", "a scene of the folder, instead of \"scene\""),
];

/// A request that is no request: the JSON pointer to what is wrong, and what that is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Bad {
    pub pointer: String,
    pub message: String,
}

impl Bad {
    pub(super) fn new(pointer: impl Into<String>, message: impl Into<String>) -> Bad {
        Bad {
            pointer: pointer.into(),
            message: message.into(),
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
        Some(name) => Err(Bad::new(
            below("", name),
            format!("unknown field; known are {}", known.join(", ")),
        )),
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
        (None, Some(Value::String(name))) => match folder.text(name) {
            Some(text) => Ok(Some(text)),
            None => Err(Bad::new(
                "/name",
                "the folder has no such scene; GET /v1/scenes lists them",
            )),
        },
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
    for field in command.fields {
        if let Some(value) = fields.get(field.name).filter(|v| !v.is_null()) {
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
    if fields.get("format").is_none_or(Value::is_null) {
        let always = command.always.iter().map(ToString::to_string);
        job.arguments.extend(always);
    }
    Ok((job, gives))
}

/// Adds a field to a command line.
fn put(job: &mut Job, field: &Field, value: &Value) -> Result<(), Bad> {
    let pointer = below("", field.name);
    let expected = |what: &str| Bad::new(&pointer, format!("expected {what}"));
    match (field.kind, value) {
        (Kind::Text(option), value) => {
            let text = text(value, &pointer)?;
            job.arguments.push(format!("{option}={text}"));
        }
        (Kind::Flag(option), Value::Bool(wanted)) => {
            job.arguments.extend(wanted.then(|| String::from(option)));
        }
        (Kind::Word(option, words), Value::String(word)) if words.contains(&word.as_str()) => {
            job.arguments.push(format!("{option}={word}"));
        }
        (Kind::Word(_, words), _) => {
            return Err(expected(&format!("one of {}", words.join(", "))));
        }
        (Kind::Values(option), Value::Object(values)) if values.len() <= MANY => {
            for (name, value) in values {
                let pointer = below(&pointer, name);
                if name.contains(['=', '\0']) || name.len() > TEXT {
                    return Err(Bad::new(pointer, "this is no name"));
                }
                let text = text(value, &pointer)?;
                job.arguments.push(format!("{option}={name}={text}"));
            }
        }
        (Kind::Texts(option), Value::Array(texts)) if texts.len() <= MANY => {
            for (i, value) in texts.iter().enumerate() {
                let text = text(value, &format!("{pointer}/{i}"))?;
                job.arguments.push(format!("{option}={text}"));
            }
        }
        (Kind::Lines(option), Value::String(lines)) => job.file = Some((option, lines.clone())),
        (Kind::List(option), list @ Value::Array(_)) => {
            job.file = Some((option, list.to_string()));
        }
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

/// The scenes that lines of a batch name have to be scenes of the folder.
pub(super) fn named_scenes_exist(lines: &str, folder: &Folder) -> Result<(), Bad> {
    #[derive(serde::Deserialize)]
    struct Line {
        scene: Option<String>,
    }
    let mut last = None;
    for (i, line) in lines.lines().enumerate() {
        // What cannot be read names no scene; the batch tells what is wrong with it.
        let Ok(Line { scene: Some(name) }) = serde_json::from_str(line) else {
            continue;
        };
        if last.as_ref() != Some(&name) && folder.find(&name).is_none() {
            let message = format!("line {}: the folder has no scene {name}", i + 1);
            return Err(Bad::new("", message));
        }
        last = Some(name);
    }
    Ok(())
}
