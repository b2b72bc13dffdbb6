//! What is wrong with a scene file, for editors and pages.

use serde_json::{Value, json};

use crate::scene::Faults;

/// What is wrong, and where; places count in UTF-16 units from the start of the text, as editors and pages count.
pub fn json(faults: &Faults, text: &str) -> Value {
    let place = |byte: usize| {
        let before = text.char_indices().take_while(|(at, _)| *at < byte);
        before.map(|(_, c)| c.len_utf16()).sum::<usize>()
    };
    let list = faults.list.iter().map(|f| {
        json!({
            "pointer": f.pointer,
            "line": f.line,
            "column": f.column,
            "start": place(f.span.start),
            "end": place(f.span.end),
            "message": f.message,
            "hint": f.hint,
        })
    });
    json!({"faults": list.collect::<Vec<_>>(), "untold": faults.untold})
}

/// The same of a file that has no text to be read.
pub fn of_file(why: &str) -> Value {
    let fault = json!({
        "pointer": "", "line": 1, "column": 1, "start": 0, "end": 0, "message": why, "hint": null,
    });
    json!({"faults": [fault], "untold": 0})
}
