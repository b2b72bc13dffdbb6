//! Mixed numbers: `1 3/4`.

/// A text with mixed numbers as sums in brackets: `(1+3/4) m` for `1 3/4 m`; nothing where there are none.
pub(in crate::grade) fn mixed(text: &str) -> Option<String> {
    let mut out = String::new();
    let (mut rest, mut found) = (text, false);
    while let Some(c) = rest.chars().next() {
        let whole = digits(rest);
        let apart = !out.ends_with(|c: char| c.is_alphanumeric() || matches!(c, '.' | ',' | '_'));
        let blanks = rest.len() - whole - rest[whole..].trim_start().len();
        let fraction = &rest[whole + blanks..];
        let length = fraction_length(fraction, blanks > 0).filter(|_| whole > 0 && apart);
        let taken = match length {
            Some(length) => {
                found = true;
                out.push_str(&format!("({}+{})", &rest[..whole], &fraction[..length]));
                whole + blanks + length
            }
            None => {
                let taken = whole.max(c.len_utf8());
                out.push_str(&rest[..taken]);
                taken
            }
        };
        rest = &rest[taken..];
    }
    found.then_some(out)
}

/// How many bytes a fraction of two whole numbers takes at the start of a text: `½`, `\frac{1}{2}`, `\frac12`, and `1/2` behind
/// a space.
fn fraction_length(text: &str, spaced: bool) -> Option<usize> {
    const SIGNS: &str = "½⅓⅔¼¾⅕⅖⅗⅘⅙⅚⅛⅜⅝⅞";
    if let Some(sign) = text.chars().next().filter(|c| SIGNS.contains(*c)) {
        return Some(sign.len_utf8());
    }
    let above = digits(text);
    if above > 0 {
        let below = digits(text[above..].strip_prefix('/')?);
        return (spaced && below > 0).then_some(above + 1 + below);
    }
    let commands = ["\\frac", "\\dfrac", "\\tfrac"];
    let mut rest = commands.iter().find_map(|name| text.strip_prefix(name))?;
    for _ in 0..2 {
        rest = rest.trim_start();
        rest = match rest.strip_prefix('{') {
            Some(inside) => inside[digits(inside)..].strip_prefix('}')?,
            None => rest.strip_prefix(|c: char| c.is_ascii_digit())?,
        };
    }
    Some(text.len() - rest.len())
}

pub(in crate::grade) fn digits(text: &str) -> usize {
    text.bytes().take_while(u8::is_ascii_digit).count()
}
