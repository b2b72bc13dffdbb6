//! Several outcomes of one impact: what a case shares with one before it is named there and not told again.

use crate::solution::words::say;
use crate::solution::{Inline, Line, Math, Part, Section};

/// Equations that a case tells, with the sentence that leads to them.
pub(super) struct Shared {
    case: usize,
    lead: Vec<Inline>,
    lines: Vec<Vec<Math>>,
}

/// Points at an earlier case where this one, the sections given, tells the same equations for the same reason; notes the
/// others for the cases to come.
pub(super) fn share(known: &mut Vec<Shared>, case: usize, sections: &mut [Section]) {
    let mut fresh = Vec::new();
    for section in sections {
        let mut p = 0;
        while p + 1 < section.parts.len() {
            let told = equations(&section.parts[p], &section.parts[p + 1]);
            p += 1;
            let Some((lead, lines)) = told else {
                continue;
            };
            let same = |s: &&Shared| s.lead == lead && s.lines == lines;
            let Some(earlier) = known.iter().find(same) else {
                fresh.push(Shared { case, lead, lines });
                continue;
            };
            let Some(Inline::Text(words)) = lead.first() else {
                continue;
            };
            let first = words.split(". ").next().unwrap_or(words);
            let first = first.trim_end_matches(['.', ':', ',']);
            let comma = if first.ends_with(" are") { "" } else { "," };
            let text = format!("{first}{comma} as in case {}.", earlier.case);
            section.parts[p - 1] = Part::Text(vec![say(text)]);
            section.parts.remove(p);
        }
    }
    known.append(&mut fresh);
}

/// A law in words and the equations it gives; `None` for anything else, such as a solution of equations.
fn equations(lead: &Part, lines: &Part) -> Option<(Vec<Inline>, Vec<Vec<Math>>)> {
    let (Part::Text(text), Part::Display(lines)) = (lead, lines) else {
        return None;
    };
    let Some(Inline::Text(first)) = text.first() else {
        return None;
    };
    // Where a formula cuts the first sentence, it cannot be told by its beginning.
    let ends = |piece: &Inline| matches!(piece, Inline::Text(next) if next.starts_with(". "));
    let is_whole = text.len() == 1 || first.contains(". ") || ends(&text[1]);
    let is_result = first.starts_with("With") || first.starts_with("Solving");
    let math = |line: &Line| line.math.clone();
    (is_whole && !is_result).then(|| (text.clone(), lines.iter().map(math).collect()))
}
