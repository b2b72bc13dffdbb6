//! From JSON to the records of [`super::file`]: every field in its type, every piece with its place, all faults at once.
//!
//! In: a [`Node`]. Out: a record, in which whatever could not be read is missing and has been reported. It checks shape
//! only: names, formulas and mechanics are the affair of [`super::resolve`].

use std::borrow::Cow;
use std::collections::{BTreeSet, HashMap};

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};

use super::fault::{Fault, Span, far};
use super::json::{Entry, Node, Value};
use super::meant::{self, meant};
use crate::expr::only;
use crate::formula::near::nearest;

/// What can be read from a JSON value.
pub(super) trait Read: Sized {
    /// The fields it has, where it is a record.
    const FIELDS: &'static [&'static str] = &[];

    /// The value; `None` where there is none, which has then been reported.
    fn read(node: &Node<'_>, faults: &mut Vec<Fault>) -> Option<Self>;

    /// What stands for a missing field, if it may be missing.
    fn absent() -> Option<Self> {
        None
    }
}

/// Reports that something else was expected.
pub(super) fn unexpected<T>(node: &Node<'_>, expected: &str, faults: &mut Vec<Fault>) -> Option<T> {
    faults.push(Fault::new(
        node.span,
        format!("expected {expected}, found {}", node.kind()),
    ));
    None
}

impl<T: Read> Read for Option<T> {
    const FIELDS: &'static [&'static str] = T::FIELDS;

    fn read(node: &Node<'_>, faults: &mut Vec<Fault>) -> Option<Self> {
        // A field that cannot be read is reported and then counts as missing, so that its neighbors are still read.
        Some(T::read(node, faults))
    }
    fn absent() -> Option<Self> {
        Some(None)
    }
}

impl<T: Read> Read for Box<T> {
    const FIELDS: &'static [&'static str] = T::FIELDS;

    fn read(node: &Node<'_>, faults: &mut Vec<Fault>) -> Option<Self> {
        T::read(node, faults).map(Box::new)
    }
}

impl<T: Read> Read for Vec<T> {
    fn read(node: &Node<'_>, faults: &mut Vec<Fault>) -> Option<Self> {
        match &node.value {
            Value::List(items) => Some(
                items
                    .iter()
                    .filter_map(|item| T::read(item, faults))
                    .collect(),
            ),
            Value::Text(text) => {
                let message = "expected a list, found a text";
                let hint = format!("a list of one is [\"{text}\"]");
                Fault::new(node.span, message).hint(hint).add_to(faults)
            }
            _ => unexpected(node, "a list", faults),
        }
    }
}

/// A pair, written as a list of two.
#[derive(Clone, Debug)]
pub(super) struct Pair<T> {
    pub span: Span,
    pub items: [T; 2],
}

impl<T: Read> Read for Pair<T> {
    fn read(node: &Node<'_>, faults: &mut Vec<Fault>) -> Option<Self> {
        match &node.value {
            Value::List(items) => match items.as_slice() {
                [a, b] => {
                    let (a, b) = (T::read(a, faults), T::read(b, faults));
                    Some(Pair {
                        span: node.span,
                        items: [a?, b?],
                    })
                }
                _ => {
                    let message = format!("expected a list of two, found {}", items.len());
                    faults.push(Fault::new(node.span, message));
                    None
                }
            },
            _ => unexpected(node, "a list of two", faults),
        }
    }
}

impl<T: JsonSchema> JsonSchema for Pair<T> {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        format!("Pair_of_{}", T::schema_name()).into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let item = generator.subschema_for::<T>();
        json_schema!({ "type": "array", "items": item, "minItems": 2, "maxItems": 2 })
    }
}

/// A text with its place.
#[derive(Clone, Debug)]
pub(super) struct Text {
    pub span: Span,
    pub text: String,
}

impl Read for Text {
    fn read(node: &Node<'_>, faults: &mut Vec<Fault>) -> Option<Self> {
        match &node.value {
            Value::Text(text) => Some(Text {
                span: node.span,
                text: text.to_string(),
            }),
            _ => unexpected(node, "a text in quotes", faults),
        }
    }
}

impl JsonSchema for Text {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Text".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "string" })
    }
}

impl Read for bool {
    fn read(node: &Node<'_>, faults: &mut Vec<Fault>) -> Option<Self> {
        match node.value {
            Value::Bool(value) => Some(value),
            Value::Text(ref text) if matches!(text.to_lowercase().as_str(), "true" | "false") => {
                let hint = format!("write `{}` without quotes", text.to_lowercase());
                let message = "expected true or false, found a text";
                Fault::new(node.span, message).hint(hint).add_to(faults)
            }
            _ => unexpected(node, "true or false", faults),
        }
    }
}

/// A formula, not yet read: a text, or a number as it was written.
#[derive(Clone, Debug)]
pub(super) struct Formula {
    pub span: Span,
    pub text: String,
    /// Where the text of the formula starts in the file, when it stands there letter by letter, without escapes.
    pub start: Option<usize>,
}

impl Read for Formula {
    fn read(node: &Node<'_>, faults: &mut Vec<Fault>) -> Option<Self> {
        match &node.value {
            Value::Text(text) => {
                let start = matches!(text, Cow::Borrowed(_)).then_some(node.span.start + 1);
                Some(Formula {
                    span: node.span,
                    text: text.to_string(),
                    start,
                })
            }
            Value::Number(number) => Some(Formula {
                span: node.span,
                text: (*number).to_owned(),
                start: Some(node.span.start),
            }),
            _ => unexpected(node, "a formula in quotes, or a number", faults),
        }
    }
}

impl JsonSchema for Formula {
    fn schema_name() -> Cow<'static, str> {
        "Formula".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A formula in the parameters, such as \"l/2*cos(theta)\" or \"2/5*m*r^2\", or a number. \
                Numbers are exact (0.1 is 1/10) and count in SI units, or have their unit beside them, such as \"500 g\".",
            "type": ["string", "number"]
        })
    }
}

/// Entries under names, in the order of the file, and the place of the whole. An entry that could not be read keeps its name.
#[derive(Clone, Debug)]
pub(super) struct Map<T>(pub Vec<(Text, Option<T>)>, pub Span);

impl<T: Read> Read for Map<T> {
    fn read(node: &Node<'_>, faults: &mut Vec<Fault>) -> Option<Self> {
        let Value::Object(entries) = &node.value else {
            return unexpected(node, "an object of named entries", faults);
        };
        let entries = unique(entries, faults);
        let named = |e: &Entry<'_>| {
            let text = e.key.to_string();
            let name = Text {
                span: e.key_span,
                text,
            };
            (name, T::read(&e.node, faults))
        };
        Some(Map(entries.into_iter().map(named).collect(), node.span))
    }
}

impl<T: JsonSchema> JsonSchema for Map<T> {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        format!("Map_of_{}", T::schema_name()).into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let item = generator.subschema_for::<T>();
        json_schema!({ "type": "object", "additionalProperties": item })
    }
}

/// The entries whose name has not come before; the others are reported.
fn unique<'n, 't>(entries: &'n [Entry<'t>], faults: &mut Vec<Fault>) -> Vec<&'n Entry<'t>> {
    let mut seen = BTreeSet::new();
    let mut out = Vec::with_capacity(entries.len());
    for entry in entries {
        if seen.insert(&*entry.key) {
            out.push(entry);
        } else {
            faults.push(Fault::new(
                entry.key_span,
                format!("`{}` stands here twice", entry.key),
            ));
        }
    }
    out
}

/// A field of a record, and the fields of the record that stands in it.
pub(super) type Known = (&'static str, &'static [&'static str]);

/// The known fields of an object; unknown and repeated ones are reported.
pub(super) fn fields<'n, 't>(
    node: &'n Node<'t>,
    known: &[Known],
    faults: &mut Vec<Fault>,
) -> Option<Vec<&'n Entry<'t>>> {
    let names = || known.iter().map(|(name, _)| *name);
    let Value::Object(entries) = &node.value else {
        let message = format!("expected an object, found {}", node.kind());
        let mut fault = Fault::new(node.span, message);
        let all: Vec<&str> = names().collect();
        let few = || (known.len() <= MANY).then(|| format!("its fields are {}", all.join(", ")));
        fault.hint = meant::example(&all).map(str::to_owned).or_else(few);
        return fault.add_to(faults);
    };
    let mut entries = unique(entries, faults);
    let is_known = |entry: &&Entry<'t>| names().any(|name| name == entry.key);
    if entries.iter().all(is_known) {
        return Some(entries);
    }
    let present: BTreeSet<String> = entries.iter().map(|e| e.key.to_string()).collect();
    entries.retain(|entry| {
        let is_known = is_known(entry);
        if !is_known {
            let fault = Fault::new(entry.key_span, format!("unknown field `{}`", entry.key));
            let cut_short = || only(names().filter(|name| is_cut_short(&entry.key, name)));
            let near = || nearest(&entry.key, names()).or_else(cut_short);
            let near = || near().map(|name| format!("did you mean `{name}`?"));
            // A scene has these in its figure, and means those of an impact.
            let held = matches!(&*entry.key, "supports" | "strings");
            let further = || further_in(&entry.key, known, &present);
            let hint = Some(further)
                .filter(|_| !held)
                .and_then(|further| further())
                .or_else(|| meant(&entry.key, &names().collect::<Vec<_>>()).map(str::to_owned))
                .or_else(near)
                .unwrap_or_else(|| likely(&entry.key, names().collect()));
            faults.push(fault.hint(hint));
        }
        is_known
    });
    Some(entries)
}

/// Whether a word is the beginning of a name, such as `grav` of `gravity`.
fn is_cut_short(word: &str, name: &str) -> bool {
    word.len() > 2 && name.starts_with(word)
}

/// Where a field stands that was written one level too far out: in those fields that are there, if they have it.
fn further_in(word: &str, known: &[Known], present: &BTreeSet<String>) -> Option<String> {
    let homes = known.iter().filter(|(_, fields)| fields.contains(&word));
    let homes: Vec<&str> = homes.map(|(name, _)| *name).collect();
    let here = homes.iter().copied().filter(|name| present.contains(*name));
    let here: Vec<&str> = here.collect();
    let homes = if here.is_empty() { homes } else { here };
    let all: Vec<String> = homes.iter().map(|name| format!("`{name}`")).collect();
    (!all.is_empty()).then(|| format!("`{word}` stands inside {}", all.join(" or ")))
}

/// Whether nothing inside this place has been reported. Among very many faults the question is not worth its time.
pub(super) fn is_sound(span: Span, faults: &[Fault]) -> bool {
    faults.len() < 1000 && !faults.iter().any(|f| span.contains(f.span))
}

/// Most fields that are listed whole beside one that is unknown.
const FEW: usize = 8;

/// Most fields of an object that are told where something else stands in its place.
const MANY: usize = 12;

/// The fields that may be meant: all of a short list, the three nearest of a long one.
fn likely(word: &str, mut near: Vec<&str>) -> String {
    let all = near.len();
    if all <= FEW {
        return format!("the fields here are {}", near.join(", "));
    }
    near.sort_by_key(|field| far(word, field));
    near.truncate(3);
    format!(
        "the nearest of the {all} fields here are {}; `carom schema` tells them all",
        near.join(", ")
    )
}

/// One field of an object.
pub(super) fn field<T: Read>(
    node: &Node<'_>,
    entries: &[&Entry<'_>],
    name: &str,
    meaning: fn(&str) -> Option<String>,
    faults: &mut Vec<Fault>,
) -> Option<T> {
    match entries.iter().find(|e| e.key == name) {
        Some(entry) => {
            let before = faults.len();
            let read = T::read(&entry.node, faults);
            let own = |f: &&mut Fault| f.span == entry.node.span && f.hint.is_none();
            for fault in faults[before..].iter_mut().filter(own) {
                fault.hint = meaning(name).map(|meaning| format!("`{name}`: {meaning}"));
            }
            read
        }
        None => {
            let absent = T::absent();
            // An unreadable or misspelled neighbor may be this field.
            if absent.is_none() && is_sound(node.span, faults) {
                let fault = Fault::new(node.span, format!("the field `{name}` is missing"));
                let fault = fault.shown_at(node.span.opening());
                let told = || meaning(name).map(|meaning| format!("`{name}`: {meaning}"));
                let hint = super::meant::missing(name).map(String::from);
                faults.push(match hint.or_else(told) {
                    Some(hint) => fault.hint(hint),
                    None => fault,
                });
            }
            absent
        }
    }
}

/// What a field of a record is, by the first sentence of its description.
pub(super) fn meaning<R: JsonSchema>(field: &str) -> Option<String> {
    let schema = SchemaGenerator::default().into_root_schema_for::<R>();
    let described = schema.get("properties")?.get(field)?.get("description")?;
    let text = described.as_str()?;
    let ends = [". ", "? "].iter().filter_map(|end| text.find(end));
    let first = ends.min().map_or(text, |end| &text[..=end]);
    let first = first.trim_end_matches('.').replace('\n', " ");
    // `mass`: mass.
    first.contains(' ').then_some(())?;
    let mut letters = first.chars();
    let small = letters.next()?.to_lowercase();
    Some(small.chain(letters).collect())
}

/// Declares a record of a scene file: a struct with its schema, and how it is read. `span` is the place of the whole.
macro_rules! record {
    ($(#[doc = $doc:literal])+ $name:ident { $($(#[$field_meta:meta])+ $field:ident $(as $key:literal)?: $type:ty,)+ }) => {
        $(#[doc = $doc])+
        #[derive(Clone, Debug, schemars::JsonSchema)]
        #[schemars(deny_unknown_fields)]
        pub(super) struct $name {
            #[schemars(skip)]
            #[allow(dead_code, reason = "not every record has faults that concern the whole of it")]
            pub span: super::fault::Span,
            $($(#[$field_meta])+ $(#[schemars(rename = $key)])? pub $field: $type,)+
        }

        impl super::record::Read for $name {
            const FIELDS: &'static [&'static str] = &[$(super::record::key!($field $($key)?)),+];

            fn read(node: &super::json::Node<'_>, faults: &mut Vec<super::fault::Fault>) -> Option<Self> {
                const KNOWN: &[super::record::Known] =
                    &[$((super::record::key!($field $($key)?), <$type as super::record::Read>::FIELDS)),+];
                let entries = super::record::fields(node, KNOWN, faults)?;
                $(let $field = super::record::field(node, &entries, super::record::key!($field $($key)?), super::record::meaning::<$name>, faults);)+
                Some($name { span: node.span, $($field: $field?),+ })
            }
        }
    };
}

/// The name of a field in the file.
macro_rules! key {
    ($field:ident $key:literal) => {
        $key
    };
    ($field:ident) => {
        stringify!($field)
    };
}

/// Declares a choice among words.
macro_rules! choice {
    ($(#[doc = $doc:literal])+ $vis:vis $name:ident { $($(#[doc = $word_doc:literal])+ $variant:ident = $word:literal,)+ }) => {
        $(#[doc = $doc])+
        #[derive(Clone, Copy, Debug, PartialEq, Eq, schemars::JsonSchema)]
        $vis enum $name {
            $($(#[doc = $word_doc])+ #[schemars(rename = $word)] $variant,)+
        }

        impl super::record::Read for $name {
            fn read(node: &super::json::Node<'_>, faults: &mut Vec<super::fault::Fault>) -> Option<Self> {
                const WORDS: &[(&str, $name)] = &[$(($word, $name::$variant)),+];
                super::record::word(node, WORDS, faults)
            }
        }
    };
}

pub(super) use {choice, key, record};

/// One of a few words.
pub(super) fn word<T: Copy>(
    node: &Node<'_>,
    words: &[(&str, T)],
    faults: &mut Vec<Fault>,
) -> Option<T> {
    let all = || words.iter().map(|(w, _)| *w).collect::<Vec<_>>().join(", ");
    let Value::Text(text) = &node.value else {
        return unexpected(node, &format!("one of {}", all()), faults);
    };
    let found = words
        .iter()
        .find(|(w, _)| w == text)
        .map(|(_, value)| *value);
    if found.is_none() {
        let fault = Fault::new(node.span, format!("`{text}` is none of {}", all()));
        let names = || words.iter().map(|(w, _)| *w);
        // `stick` is more likely to be `sticking` here than a rod.
        let begun = names().find(|w| text.len() > 2 && w.starts_with(text.as_ref() as &str));
        let likely = |n: &str| format!("did you mean `{n}`?");
        let known = || meant(text, &names().collect::<Vec<_>>()).map(str::to_owned);
        let near = || nearest(text, names()).map(likely);
        faults.push(match begun.map(likely).or_else(known).or_else(near) {
            Some(hint) => fault.hint(hint),
            None => fault,
        });
    }
    found
}

pub(super) fn names<T>(map: Option<&Map<T>>) -> HashMap<&str, usize> {
    let all = keys(map).into_iter().map(|name| name.text.as_str());
    all.zip(0..).collect()
}

pub(super) fn text(text: &Option<Text>) -> String {
    text.as_ref().map(|t| t.text.clone()).unwrap_or_default()
}

/// The entries of a map that could be read.
pub(super) fn entries<T>(map: Option<&Map<T>>) -> impl Iterator<Item = (&Text, &T)> {
    let all = map.into_iter().flat_map(|m| &m.0);
    all.filter_map(|(name, entry)| Some((name, entry.as_ref()?)))
}

/// The names of a map.
pub(super) fn keys<T>(map: Option<&Map<T>>) -> Vec<&Text> {
    let all = map.into_iter().flat_map(|m| &m.0);
    all.map(|(name, _)| name).collect()
}
