//! Characters that act on a terminal, turn the direction of text, or hide: shown, never obeyed, in every format.

/// Whether a character is not seen as itself: control, bidirectional, zero-width and tag characters, other line ends.
pub fn is_hidden(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}')
        || matches!(c, '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}' | '\u{fffe}' | '\u{ffff}')
        || matches!(c, '\u{e0000}'..='\u{e007f}')
}

/// One line of text in which every hidden character is named by its number, and every blank is a plain one.
pub fn visible(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            c if is_hidden(c) && !c.is_whitespace() => {
                out.push_str(&format!("[U+{:04X}]", u32::from(c)));
            }
            c if c.is_whitespace() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

/// What TeX would act on in a name, or Markdown and HTML around its formulas, becomes a thin space: in a name it separates.
pub(super) fn in_math(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            c if c.is_alphanumeric() || "+-*/,.'()".contains(c) => out.push(c),
            _ => out.push_str("\\,"),
        }
    }
    out
}
