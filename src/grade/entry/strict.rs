//! JSON in which a name stands once: of two values for one key neither is taken in silence.

use serde_json::Value;

/// Reads a text; the fault is told with the `id` the text holds.
pub(super) fn value(text: &str) -> Result<Value, (Value, String)> {
    let value: Value =
        serde_json::from_str(text).map_err(|e| (Value::Null, format!("no JSON: {e}")))?;
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
