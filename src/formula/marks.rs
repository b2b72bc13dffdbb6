//! What stands in LaTeX for the eye alone: commands that decorate, spaces, degree signs.

use super::symbols::{among, letters_at};

/// Commands that only decorate.
const DECORATION: &str = "left right big Big bigg Bigg bigl bigr Bigl Bigr biggl biggr Biggl Biggr displaystyle textstyle \
    scriptstyle quad qquad limits thinspace medspace thickspace negthinspace negmedspace negthickspace \
    enspace it rm bf sf nonumber mathstrut underline";

/// Length of a command that only decorates, without its backslash.
pub(super) fn decoration(rest: &str) -> Option<usize> {
    let first = rest.chars().next()?;
    if matches!(
        first,
        ',' | ';' | ':' | '!' | ' ' | '(' | ')' | '[' | ']' | '>'
    ) {
        return Some(1);
    }
    let length = letters_at(rest);
    let known = among(DECORATION, &rest[..length]);
    // The number of an equation.
    if matches!(&rest[..length], "tag" | "label") {
        let group = rest[length..].strip_prefix('{')?;
        return Some(length + 2 + group.find('}')?);
    }
    if matches!(&rest[..length], "quad" | "qquad")
        && let Some(number) = number_behind(&rest[length..])
    {
        return Some(length + number);
    }
    // `\left.` and `\right.` are brackets nobody sees.
    let unseen = matches!(&rest[..length], "left" | "right") && rest[length..].starts_with('.');
    // `\rm{m}` is a letter in another font, as `\mathrm{m}` is.
    let font = rest.starts_with("rm{");
    (known && !font).then_some(length + usize::from(unseen))
}

/// Whether blanks from `start` to `end` show as a space: one that ends a command does not, nor does `\left`.
pub(super) fn shows_space(text: &[u8], start: usize, end: usize) -> bool {
    let letters = text[..start]
        .iter()
        .rev()
        .take_while(|b| b.is_ascii_alphabetic())
        .count();
    let mut ends_command = letters > 0 && text[..start - letters].ends_with(b"\\");
    let mut at = start;
    while at < end {
        if text[at] != b'\\' {
            if !ends_command && text[at] != b'$' {
                return true;
            }
            at += 1;
            continue;
        }
        let word = text[at + 1..end]
            .iter()
            .take_while(|b| b.is_ascii_alphabetic())
            .count();
        match &text[at + 1..at + 1 + word] {
            b"" if text.get(at + 1) != Some(&b'!') => return true,
            b"quad" | b"qquad" | b"thinspace" | b"medspace" => return true,
            _ => {}
        }
        ends_command = word > 0;
        at += 1 + word.max(1);
    }
    false
}

/// Length of a degree sign behind `^`.
pub(super) fn degree_mark(rest: &str) -> Option<usize> {
    let blanks = rest.len() - rest.trim_start_matches(' ').len();
    let body = &rest[blanks..];
    const MARKS: &str = r"{\circ}|\circ|{∘}|{°}|∘|°|{\degree}|\degree";
    let mark = MARKS.split('|').find(|mark| body.starts_with(mark))?;
    Some(blanks + mark.len())
}

/// Length of the number of an equation that ends a text, as `(2)` and `[2.3]` do well apart from the formula.
fn number_behind(text: &str) -> Option<usize> {
    let inside = text.trim_start().strip_prefix(['(', '['])?;
    let (number, behind) = inside.split_once([')', ']'])?;
    let is_number = number.starts_with(|c: char| c.is_ascii_digit())
        && number.chars().all(|c| c.is_ascii_digit() || c == '.');
    let is_last = behind.trim_matches([' ', '$', '.', '\\']).is_empty();
    (is_number && is_last).then_some(text.len() - behind.len())
}
