//! The equation in a line as students write it, with words around it.

use crate::formula::Fault;

/// The equation of a line, without the words before it: `AMB about C: …`, `so …`, `=> …`.
pub(super) fn equation(text: &str) -> &str {
    const LEADS: [&str; 18] = [
        "=>",
        "⇒",
        "⟹",
        "∴",
        "→",
        "->",
        "\\Rightarrow",
        "\\implies",
        "\\therefore",
        "therefore",
        "hence",
        "thus",
        "so",
        "then",
        "with",
        "and",
        "where",
        "gives",
    ];
    let mut rest = text.trim().trim_start_matches('$').trim_start();
    // A law or body named before a colon; a definition `a := b` has its sign behind the colon.
    if let Some((words, behind)) = rest.split_once(':')
        && !behind.starts_with('=')
        && behind.contains(['=', '<', '>', '≤', '≥', '≈'])
        && !words.contains(['=', '<', '>', '^', '*'])
        && words.chars().any(char::is_alphabetic)
    {
        rest = behind.trim_start();
    }
    loop {
        let lower = rest.to_ascii_lowercase();
        let lead = LEADS.iter().find(|lead| {
            let word = lead.ends_with(|c: char| c.is_ascii_alphabetic());
            lower.strip_prefix(**lead).is_some_and(|behind| {
                let apart = !word || behind.starts_with([' ', ',', '\\', '$']);
                apart && behind.contains(['=', '<', '>', '≤', '≥', '≈'])
            })
        });
        match lead {
            Some(lead) => rest = rest[lead.len()..].trim_start_matches([' ', ',', '$', '~']),
            None => return rest.trim_end_matches('$').trim_end(),
        }
    }
}

/// Whether a refused name of several letters resembles a declared one.
pub(super) fn is_near(fault: &Fault) -> bool {
    let offered = fault
        .hint
        .as_ref()
        .is_some_and(|h| h.starts_with("did you"));
    offered && fault.end - fault.start > 1
}
