//! Hints for words of mechanics that people write where scene files have another one.

/// The words, what must be able to stand in their place, with `!` what must not, and the hint, if there is one.
const HINTS: &str = include_str!("meant.tsv");

/// What there is for a word of mechanics that is no word of scene files, by the first row that fits.
/// `here` are the words that could stand in its place.
pub(super) fn meant(word: &str, here: &[&str]) -> Option<&'static str> {
    let word = word.to_lowercase().replace(' ', "_");
    let has = |there: &str| match there.strip_prefix('!') {
        Some(absent) => !here.contains(&absent),
        None => here.contains(&there),
    };
    let hint = HINTS.lines().skip(1).find_map(|row| {
        let (words, rest) = row.split_once('\t')?;
        let (there, hint) = rest.split_once('\t')?;
        let is_meant = words.split(' ').any(|own| own == word || own == "_");
        (is_meant && there.split_whitespace().all(has)).then_some(hint)
    });
    hint.filter(|hint| !hint.is_empty())
}

/// What a field that is missing has to say.
pub(super) fn missing(field: &str) -> Option<&'static str> {
    Some(match field {
        "along" => {
            "the direction: \"x\", \"-x\", \"y\", \"-y\", the components [x, y] of a unit vector, or {\"angle\": …}"
        }
        "about" => "the point that it turns about: its name, or its place [x, y]",
        _ => return None,
    })
}

/// An object with many fields, where something else stands in its place.
pub(super) fn example(fields: &[&str]) -> Option<&'static str> {
    match fields {
        _ if fields.contains(&"threshold") => {
            Some("such as {\"velocity\": \"A\", \"along\": \"x\"}")
        }
        _ if fields.starts_with(&["unit", "meaning"]) => {
            Some("such as {\"unit\": \"kg\"}, or with its value {\"value\": \"3 kg\"}")
        }
        _ if fields.starts_with(&["body", "with", "friction"]) => Some(
            "what is slid `on` moves too, such as {\"body\": \"plank\"}; fixed ground has no `on`",
        ),
        _ => None,
    }
}
