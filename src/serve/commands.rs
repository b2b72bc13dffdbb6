//! The commands that can be asked for: what each does, the fields of its requests, and the options these become. The table
//! itself is `commands.json`.

use std::sync::LazyLock;

use serde::Deserialize;

/// A command that can be asked for.
#[derive(Deserialize)]
pub(super) struct Command {
    /// Its name, here and on the command line.
    pub name: &'static str,
    /// What it does.
    pub what: String,
    /// Its own fields.
    pub fields: Vec<Field>,
    /// Options it is always given; a format that is asked for takes the place of them.
    pub always: Vec<String>,
    /// What comes back if the request names no format.
    pub gives: Gives,
    /// Whether it can do without a scene.
    pub sceneless: bool,
}

/// A field of a request.
#[derive(Deserialize)]
pub(super) struct Field {
    /// Its name.
    pub name: &'static str,
    /// What it may hold, and the option it becomes.
    pub kind: Kind,
    /// What it is for.
    pub what: String,
    /// Other fields without which it says nothing.
    #[serde(default)]
    pub needs: Vec<&'static str>,
}

/// What a field may hold; each kind carries the option of the command line it becomes.
#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Kind {
    /// An object of names and values, such as {"v": 2, "theta": "pi/6"}.
    Values(&'static str),
    /// A text or a number.
    Text(&'static str),
    /// One of these words.
    Word(&'static str, Vec<String>),
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
#[derive(Clone, Copy, PartialEq, Eq, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Gives {
    /// JSON.
    Json,
    /// Text of this type.
    Text(&'static str),
}

/// All commands.
pub(super) static COMMANDS: LazyLock<Vec<Command>> = LazyLock::new(|| {
    serde_json::from_str(include_str!("commands.json")).expect("a table that its tests have read")
});

/// What a request for a command needs besides its own fields.
pub(super) const SCENE: [(&str, &str); 2] = [
    ("scene", "a scene: an object, or the text of a scene file"),
    ("name", "a scene of the folder, instead of \"scene\""),
];
