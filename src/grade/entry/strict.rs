//! JSON in which a name stands once: of two values for one key neither is taken in silence.

use serde_json::Value;

/// Reads a text; the fault is told with the `id` the text holds.
pub(super) fn value(text: &str) -> Result<Value, (Value, String)> {
    let value: Value =
        serde_json::from_str(text).map_err(|e| (id_in(text), format!("no JSON: {e}")))?;
    match twice(text) {
        Some(name) => {
            let id = value.get("id").cloned().unwrap_or(Value::Null);
            Err((id, format!("the field {name} stands here twice")))
        }
        None => Ok(value),
    }
}

/// A key that stands twice in one object of a text that is JSON, as written.
fn twice(text: &str) -> Option<String> {
    // The keys of the objects that are open; an open list has none.
    let mut open: Vec<Option<Vec<String>>> = Vec::new();
    let mut key = false;
    let mut at = 0;
    while let Some(byte) = text.as_bytes().get(at) {
        match byte {
            b'{' => {
                open.push(Some(Vec::new()));
                key = true;
            }
            b'[' => {
                open.push(None);
                key = false;
            }
            b'}' | b']' => {
                open.pop();
            }
            b',' => key = matches!(open.last(), Some(Some(_))),
            b'"' => {
                let length = quoted(&text[at..]);
                let string = &text[at..at + length];
                at += length - 1;
                if key && let Some(Some(known)) = open.last_mut() {
                    let name = serde_json::from_str(string).unwrap_or_default();
                    if known.contains(&name) {
                        return Some(string.to_string());
                    }
                    known.push(name);
                }
                key = false;
            }
            _ => {}
        }
        at += 1;
    }
    None
}

/// Longest `id` that is looked for in a text that is no JSON, in bytes.
const LONGEST_ID: usize = 1 << 10;

/// The `id` of a line that is no JSON, as far as it can be read: the value behind the first `"id":` of the outermost object.
pub fn id_in(text: &str) -> Value {
    let (mut depth, mut at) = (0_usize, 0);
    while let Some(byte) = text.as_bytes().get(at) {
        match byte {
            b'{' | b'[' => depth += 1,
            b'}' | b']' => depth = depth.saturating_sub(1),
            b'"' => {
                let end = at + quoted(&text[at..]);
                let behind = text[end..].trim_start();
                if depth == 1
                    && &text[at..end] == "\"id\""
                    && let Some(value) = behind.strip_prefix(':')
                {
                    let mut values = serde_json::Deserializer::from_str(value).into_iter();
                    let found = values.next().and_then(Result::ok);
                    let short = values.byte_offset() <= LONGEST_ID;
                    return found.filter(|_| short).unwrap_or_default();
                }
                at = end - 1;
            }
            _ => {}
        }
        at += 1;
    }
    Value::Null
}

/// Length of the string in quotes at the start of a text.
fn quoted(text: &str) -> usize {
    let mut escaped = false;
    for (at, byte) in text.bytes().enumerate().skip(1) {
        match byte {
            _ if escaped => escaped = false,
            b'\\' => escaped = true,
            b'"' => return at + 1,
            _ => {}
        }
    }
    text.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_id_is_read_where_the_rest_is_no_json() {
        for (text, id) in [
            (r#"{"id": 7, "answer": "#, "7"),
            (r#"{"expected": {"id": 1}, "id": "a\"b", x}"#, r#""a\"b""#),
            (r#"{"id": "#, "null"),
            (r#"{"id": "open"#, "null"),
            (r#"{"answer": "\"id\": 3""#, "null"),
            ("\"id\": 3", "null"),
        ] {
            assert_eq!(id_in(text).to_string(), id, "{text}");
        }
    }

    #[test]
    fn a_name_that_stands_twice_in_one_object_is_a_fault() {
        for text in [
            r#"{"id": 1, "a": 2, "a": 3}"#,
            r#"{"id": 1, "s": {"x": 1, "\u0078": 2}}"#,
            r#"{"id": 1, "l": [{"x": 1, "y": "{\"", "x": 2}]}"#,
        ] {
            let (id, message) = value(text).expect_err(text);
            assert_eq!(id, Value::from(1));
            assert!(message.ends_with("twice"), "{message}");
        }
        for text in [
            r#"{"a": {"x": "a"}, "b": ["x", "x"], "x": {"x": 1}}"#,
            r#"[{"x": 1}, {"x": 2}]"#,
        ] {
            assert!(value(text).is_ok(), "{text}");
        }
    }
}
