//! Directions in words and arrows behind a formula.

use crate::formula::Fault;

/// Words and arrows behind a formula for a direction, each with its sense along x and y or about the axis out of the page.
const SENSES: [(&str, [i32; 3]); 6] = [
    (
        "counterclockwise|counter-clockwise|anticlockwise|anti-clockwise|ccw|↺|out of the page",
        [0, 0, 1],
    ),
    ("clockwise|cw|↻|into the page", [0, 0, -1]),
    (
        "to the right|rightwards|rightward|eastward|to the east|→|\\rightarrow",
        [1, 0, 0],
    ),
    (
        "to the left|leftwards|leftward|westward|to the west|←|\\leftarrow",
        [-1, 0, 0],
    ),
    (
        "upwards|upward|up|northward|to the north|↑|\\uparrow",
        [0, 1, 0],
    ),
    (
        "downwards|downward|down|southward|to the south|↓|\\downarrow",
        [0, -1, 0],
    ),
];

/// A formula without the direction in words behind it, and that direction: `9.31 rad/s clockwise`, `5 N (to the left)`.
pub(in crate::grade) fn sense(text: &str) -> Option<(&str, [i32; 3])> {
    let said = text.trim_end_matches([' ', '.', ')', '}']);
    // `in the clockwise sense`
    let kind = [" sense", " direction"].into_iter();
    let said = kind
        .filter_map(|kind| said.strip_suffix(kind))
        .next()
        .unwrap_or(said);
    let senses = SENSES.into_iter();
    let mut words = senses.flat_map(|(words, sense)| words.split('|').map(move |w| (w, sense)));
    words.find_map(|(word, sense)| {
        let at = said.len().checked_sub(word.len())?;
        let (before, end) = said.split_at_checked(at)?;
        let before = ["in the ", "in a "]
            .into_iter()
            .find_map(|led| before.strip_suffix(led))
            .unwrap_or(before);
        let apart =
            before.ends_with([' ', '(', '~', ',', '{']) || !word.starts_with(char::is_alphabetic);
        if !apart || !end.eq_ignore_ascii_case(word) {
            return None;
        }
        let body = before.trim_end_matches([' ', ',', '(', '~']);
        let body = body.strip_suffix("\\text{").unwrap_or(body).trim_end();
        (!body.is_empty()).then_some((body, sense))
    })
}

/// A value, maybe behind its name, as it stands or with the other sign.
pub(in crate::grade) fn with_sign(text: &str, same: bool) -> String {
    let at = text.rfind('=').map_or(0, |at| at + 1);
    let (name, value) = (&text[..at], text[at..].trim());
    // `|ω| = … clockwise` says the size and the sense.
    let bars = ["|", "\\vert", "\\mid"];
    let size = name.trim_end_matches(['=', ' ']);
    let inside = bars
        .iter()
        .find_map(|bar| size.trim_start().strip_prefix(*bar)?.strip_suffix(*bar));
    let named = inside.map(|inside| format!("{inside} ="));
    let name = named.as_deref().unwrap_or(name);
    let positive = value.strip_prefix(['-', '−']);
    let several = positive
        .unwrap_or(value)
        .contains(['+', '-', '−', '±', '∓']);
    match (same, positive) {
        (true, _) => format!("{name}{value}"),
        (false, _) if several => format!("{name}-({value})"),
        (false, Some(positive)) => format!("{name}{positive}"),
        (false, None) => format!("{name}-{value}"),
    }
}

/// Refuses a direction in words behind a formula.
pub(super) fn direction(text: &str) -> Option<Fault> {
    let (body, [.., turn]) = sense(text)?;
    let (what, message) = match turn {
        0 => (
            "direction",
            "a direction in words is no part of the formula",
        ),
        _ => ("sense", "a sense of rotation is no part of the formula"),
    };
    let start = text.len()
        - text[body.len()..]
            .trim_start_matches([' ', ',', '(', '~'])
            .len();
    let end = text.trim_end_matches([' ', '.', ')', '}']).len();
    let hint = format!("which {what} counts as positive is told by the question");
    Some(*Fault::new(message, start, end).hint(hint))
}
