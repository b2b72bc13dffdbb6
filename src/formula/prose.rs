//! Words around a formula: finds the one formula in dollars or LaTeX brackets inside a sentence.
//!
//! Deliberately timid: it finds nothing where two formulas stand in the sentence, or where what stands outside could
//! belong to the formula.

/// Start and end of the only formula in a sentence; nothing where there are none or several, or no words around it.
pub(super) fn formula_in_words(text: &str) -> Option<(usize, usize)> {
    let (from, to, start, end) = [("$$", "$$"), ("$", "$"), ("\\(", "\\)"), ("\\[", "\\]")]
        .into_iter()
        .find_map(|(open, close)| {
            let from = text.find(open)?;
            let start = from + open.len();
            let end = start + text[start..].find(close)?;
            Some((from, end + close.len(), start, end))
        })?;
    let (before, behind) = (&text[..from], &text[to..]);
    let foreign = |c: char| c.is_ascii_digit() || "$\\=+*/^_<>()[]{}|".contains(c);
    let words = |t: &str| {
        t.split(|c: char| !c.is_alphabetic())
            .any(|word| word.len() > 2)
    };
    let prose = words(before) || words(behind);
    let several = before.contains(foreign) || behind.contains(foreign);
    // `$5$ m/s` and `$5$ meters` carry a unit outside.
    let unit =
        crate::dimension::unit(behind.trim().trim_end_matches('.')).is_ok_and(|_| words(behind));
    (prose && !several && !unit && !text[start..end].trim().is_empty()).then_some((start, end))
}
