//! Reads one name: base, accent, index and marks, in plain text, Unicode or LaTeX.

use super::{Parts, Symbols, greek_name, is_greek, letters_at, variants};

/// Longest index or mark, in bytes.
const LONGEST: usize = 40;

/// Bytes and text of an index or a raised mark in braces.
fn braced(text: &str, at: usize) -> Option<(&str, usize)> {
    let rest = text.as_bytes().get(at..)?;
    let end = closing(&rest[..rest.len().min(LONGEST * 3)])?;
    Some((&text[at + 1..at + end], at + end + 1))
}

/// The brace that closes the one with which a text begins.
pub(crate) fn closing(text: &[u8]) -> Option<usize> {
    let mut depth = 0u32;
    for (i, byte) in text.iter().enumerate() {
        match byte {
            b'{' => depth += 1,
            b'}' if depth == 1 => return Some(i),
            b'}' => depth = depth.checked_sub(1)?,
            _ if depth == 0 => return None,
            _ => {}
        }
    }
    None
}

/// The name of a letter or sign that stands as an index: π is no number there.
fn index_name(c: char) -> Option<&'static str> {
    match c {
        '⊥' => Some("perp"),
        '∥' | '‖' => Some("parallel"),
        '∞' => Some("infty"),
        'π' => Some("pi"),
        c => greek_name(c),
    }
}

/// The plain spelling of an index: fonts, braces and spaces dropped, Greek letters named. `None` where it is no name.
fn index_text(written: &str) -> Option<String> {
    let mut out = String::new();
    let mut rest = written;
    while let Some(c) = rest.chars().next() {
        rest = &rest[c.len_utf8()..];
        match c {
            '{' | '}' | '_' | ' ' | '~' => {}
            '/' | ',' | '+' | '-' | '\'' | '*' => out.push(c),
            '−' => out.push('-'),
            '′' | '’' => out.push('\''),
            '\\' => {
                let length = letters_at(rest);
                let word = &rest[..length];
                rest = &rest[length..];
                match word {
                    "mathrm" | "text" | "rm" | "mathit" | "textrm" | "mathbf" | "mathsf"
                    | "operatorname" | "it" => {}
                    "max" | "min" | "perp" | "parallel" | "infty" | "rel" | "circ" => {
                        out.push_str(word)
                    }
                    "prime" => out.push('\''),
                    "ell" => out.push('l'),
                    "" if rest.starts_with([',', ' ', ';', '!']) => rest = &rest[1..],
                    "" if rest.starts_with(['/', '_']) => {}
                    word if is_greek(word) || word == "pi" => out.push_str(word),
                    _ => return None,
                }
            }
            c if c.is_ascii_alphanumeric() => out.push(c),
            c => out.push_str(index_name(c)?),
        }
    }
    (!out.is_empty() && out.len() <= LONGEST).then_some(out)
}

/// An index character written low.
pub(crate) fn lowered(c: char) -> Option<char> {
    const LOW: &str = "₀₁₂₃₄₅₆₇₈₉ₐₑₕᵢⱼₖₗₘₙₒₚᵣₛₜᵤᵥₓ";
    const PLAIN: &str = "0123456789aehijklmnoprstuvx";
    if c.is_ascii() {
        return None;
    }
    let at = LOW.chars().position(|low| low == c)?;
    PLAIN.chars().nth(at)
}

/// What an index run without braces means.
pub(crate) struct Index {
    /// The index.
    pub text: String,
    /// Byte after it.
    pub end: usize,
    /// Whether digits took one of x, y, z along, as in `u1x`; it could be a product as well.
    pub took_letter: bool,
}

/// Finds where an index without braces ends, asking `declared` which longer or shorter index gives a declared name.
pub(crate) fn bare_index(
    text: &str,
    at: usize,
    after_sign: bool,
    declared: &dyn Fn(&str) -> bool,
    any: bool,
    split: bool,
) -> Option<Index> {
    let bytes = text.as_bytes();
    let run = bytes[at..]
        .iter()
        .take_while(|b| b.is_ascii_alphanumeric())
        .take(LONGEST)
        .count();
    if run == 0 {
        return None;
    }
    let index = |length: usize, took_letter| Index {
        text: text[at..at + length].to_string(),
        end: at + length,
        took_letter,
    };
    let digits = bytes[at..at + run]
        .iter()
        .take_while(|b| b.is_ascii_digit())
        .count();
    if !after_sign && digits == 0 {
        return None;
    }
    for length in (1..=run).rev().filter(|_| any) {
        // Digits stay together: 12 is never 1 and 2.
        let splits_digits = bytes[at + length - 1].is_ascii_digit()
            && length < run
            && bytes[at + length].is_ascii_digit();
        if !splits_digits && declared(&text[at..at + length]) {
            return Some(index(length, false));
        }
    }
    if digits > 0 {
        // A letter with an index of its own is a name of its own: `x_1x_2`.
        let component = !split
            && run == digits + 1
            && matches!(bytes[at + digits], b'x' | b'y' | b'z')
            && bytes.get(at + run) != Some(&b'_');
        return Some(index(digits + usize::from(component), component));
    }
    // In LaTeX an index without braces is one letter, as in `k_BT`; a word that somebody typed there is one all the same.
    let word = run > 3 || WORDS.split(' ').any(|word| word == &text[at..at + run]);
    match run > 1 && !word && text.contains(['\\', '$']) {
        true => Some(index(1, false)),
        false => Some(index(run, false)),
    }
}

/// Words of two or three letters that stand as an index.
const WORDS: &str = "avg cm com CM COM cms eff end eq ext fin in ini int kin lab max min net out pot rel res rms rod rot top tot sys th";

/// Whether the text behind a raised sign makes it the sign of an exponent: `x^-2`, `x^-½`, `x^-(a+b)`, `x^-n`.
fn starts_exponent(rest: &str) -> bool {
    let begins = |c: char| c.is_alphanumeric() || "({[.".contains(c);
    rest.starts_with(begins) || rest.starts_with("\\frac")
}

/// Reads index and marks behind a base that ends at byte `at`; gives the byte after them.
pub(crate) fn tail(
    text: &str,
    mut at: usize,
    parts: &mut Parts,
    symbols: &Symbols,
    split: bool,
    took: &mut bool,
) -> usize {
    // Digits right behind a letter are an index in any order with marks; each kind is read once.
    loop {
        let mut rest = &text[at..];
        // A space before an index is not seen: `\epsilon _{0}`.
        let close = rest.trim_start_matches(' ');
        if close.len() < rest.len() && close.starts_with('_') && parts.index.is_empty() {
            at += rest.len() - close.len();
            rest = close;
        }
        let Some(c) = rest.chars().next() else {
            return at;
        };
        match c {
            '[' if parts.index.is_empty() && parts.marks.is_empty() => {
                // `a[2]` is a_2.
                let digits = rest[1..].bytes().take_while(u8::is_ascii_digit).count();
                if !(1..=3).contains(&digits) || !rest[1 + digits..].starts_with(']') {
                    return at;
                }
                put_index(parts, &rest[1..=digits]);
                at += digits + 2;
            }
            '0'..='9' if parts.index.is_empty() && parts.marks.is_empty() => {
                let Some(found) = declared_index(text, at, false, parts, symbols, split) else {
                    return at;
                };
                *took |= found.took_letter;
                (parts.index, at) = (found.text, found.end);
            }
            '_' if parts.index.is_empty() || parts.accent.is_empty() => {
                match lower(text, at + 1, parts, symbols, split, took) {
                    Some(end) => at = end,
                    None => return at,
                }
            }
            '\'' | '′' | '’' | '‵' => {
                put_prime(parts, 1);
                at += c.len_utf8();
            }
            '″' => {
                put_prime(parts, 2);
                at += c.len_utf8();
            }
            '⁺' | '⁻'
                if !parts.marks.contains('^')
                    && !rest[c.len_utf8()..]
                        .starts_with(['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹']) =>
            {
                parts.marks.push_str(if c == '⁺' { "^+" } else { "^-" });
                at += c.len_utf8();
            }
            '^' => match raised(text, at + 1, parts, symbols) {
                Some((mark, end)) if mark.starts_with('\'') => {
                    put_prime(parts, mark.len().min(2));
                    at = end;
                }
                // One raised mark; a second is a fault that the parser names.
                Some((mark, end)) if !parts.marks.contains('^') => {
                    parts.marks.push_str(&mark);
                    at = end;
                }
                _ => return at,
            },
            c => match lowered(c) {
                Some(_) if parts.index.is_empty() => {
                    for c in rest.chars() {
                        let Some(plain) = lowered(c) else { break };
                        parts.index.push(plain);
                        at += c.len_utf8();
                    }
                }
                _ => return at,
            },
        }
        if parts.marks.len() > LONGEST {
            return at;
        }
    }
}

/// Reads an index behind its sign; gives the byte after it.
fn lower(
    text: &str,
    at: usize,
    parts: &mut Parts,
    symbols: &Symbols,
    split: bool,
    took: &mut bool,
) -> Option<usize> {
    let next = text.len() - text[at..].trim_start_matches(' ').len();
    if let Some((inside, end)) = braced(text, next) {
        put_index(parts, &index_text(inside)?);
        return Some(end);
    }
    if let Some(word) = text[next..].strip_prefix('\\') {
        let end = next + 1 + letters_at(word);
        let font = matches!(&text[next + 1..end], "mathrm" | "text" | "textrm" | "rm");
        let (inside, end) = match braced(text, end) {
            Some(inside) if font => inside,
            _ => (&text[next..end], end),
        };
        put_index(parts, &index_text(inside)?);
        return Some(end);
    }
    if let Some(found) = declared_index(text, next, true, parts, symbols, split) {
        *took |= found.took_letter;
        put_index(parts, &found.text);
        return Some(found.end);
    }
    let c = text[next..].chars().next()?;
    put_index(parts, index_name(c)?);
    Some(next + c.len_utf8())
}

/// Primes stand before a raised mark, in whatever order they were written.
fn put_prime(parts: &mut Parts, count: usize) {
    let at = parts.marks.find('^').unwrap_or(parts.marks.len());
    parts.marks.insert_str(at, &"''"[..count]);
}

fn put_index(parts: &mut Parts, index: &str) {
    match super::ACCENTS.iter().find(|accent| **accent == index) {
        Some(accent) if super::both(parts.accent, accent).is_some() => {
            parts.accent = super::both(parts.accent, accent).unwrap_or_default();
        }
        _ => parts.index.push_str(index),
    }
}

fn declared_index(
    text: &str,
    at: usize,
    after_sign: bool,
    parts: &Parts,
    symbols: &Symbols,
    split: bool,
) -> Option<Index> {
    let declared = |index: &str| {
        let tried = Parts {
            index: format!("{}{index}", parts.index),
            ..parts.clone()
        };
        find(&tried, symbols).is_some()
            || tried.index.len() > 1 && symbols.find(&format!("{}_{}", parts.base, index)).is_some()
    };
    bare_index(
        text,
        at,
        after_sign,
        &declared,
        !symbols.declared().is_empty(),
        split,
    )
}

/// A mark raised behind a name: `^+`, `^{-}`, `^\prime`, `^*`, or a raised word of a declared name (`I_{zz}^{cm}`).
fn raised(text: &str, at: usize, parts: &Parts, symbols: &Symbols) -> Option<(String, usize)> {
    let skipped = text[at..].len() - text[at..].trim_start_matches(' ').len();
    let at = at + skipped;
    let rest = &text[at..];
    if let Some((inside, end)) = braced(text, at) {
        let mark = inside.trim();
        let spelled = match mark {
            "+" => "^+".to_string(),
            "-" | "−" => "^-".to_string(),
            "*" | "\\ast" | "\\star" => "^*".to_string(),
            "'" | "′" | "\\prime" => "'".to_string(),
            "''" | "″" | "\\prime\\prime" => "''".to_string(),
            _ => {
                let index = index_text(mark)?;
                let center = matches!(
                    index.trim_end_matches(|c: char| c.is_ascii_digit()),
                    "cm" | "com"
                );
                let worded = center || mark.starts_with("\\text") || mark.starts_with("\\mathrm");
                let marked = Parts {
                    marks: format!("{}^{index}", parts.marks),
                    ..parts.clone()
                };
                if !worded && find(&marked, symbols).is_none() {
                    return None;
                }
                format!("^{index}")
            }
        };
        return Some((spelled, end));
    }
    if rest.starts_with("\\prime") {
        return Some(("'".into(), at + 6));
    }
    if rest.starts_with("\\ast") {
        return Some(("^*".into(), at + 4));
    }
    let c = rest.chars().next()?;
    let mark = match c {
        '+' => "^+",
        '-' | '−' => "^-",
        '*' if !rest[1..].starts_with('*') && skipped == 0 && !starts_exponent(&rest[1..]) => "^*",
        _ => return None,
    };
    let behind = &rest[c.len_utf8()..];
    let marked = Parts {
        marks: format!("{}{mark}", parts.marks),
        ..parts.clone()
    };
    let digit = behind.starts_with(|c: char| c.is_numeric() || c == '(' || c == '{');
    if starts_exponent(behind) && (digit || find(&marked, symbols).is_none()) {
        return None;
    }
    Some((mark.into(), at + c.len_utf8()))
}

/// The declared name these parts spell.
pub(crate) fn find<'s>(parts: &Parts, symbols: &'s Symbols) -> Option<&'s super::Declared> {
    if symbols.declared().is_empty() {
        return None;
    }
    if let Some(found) = symbols.find(&parts.key()) {
        return Some(found);
    }
    for other in variants(&parts.base) {
        let tried = Parts {
            base: (*other).to_string(),
            ..parts.clone()
        };
        if let Some(found) = symbols.find(&tried.key()) {
            return Some(found);
        }
    }
    // Bold for an arrow; and dots over an arrow where they are declared alone.
    let other = match parts.accent {
        "" | "dot" | "ddot" if parts.bold => super::both("vec", parts.accent),
        "vec_dot" => Some("dot"),
        "vec_ddot" => Some("ddot"),
        _ => None,
    };
    if let Some(accent) = other {
        let tried = Parts {
            accent,
            ..parts.clone()
        };
        if let Some(found) = symbols.find(&tried.key()) {
            return Some(found);
        }
    }
    if !parts.index.is_empty() && parts.accent.is_empty() {
        // `u_{Gx}` for a declared `uGx`; but m_u is not μ.
        let joined = format!("{}{}{}", parts.base, parts.index, parts.marks);
        if !is_greek(&joined) {
            return symbols.find(&joined);
        }
    }
    None
}

/// The key of a name written in LaTeX; `None` where the text is not one name.
pub(crate) fn key_of_latex(latex: &str) -> Option<String> {
    let open = Symbols::open();
    let text = latex.trim();
    // `\\Delta T` is one name of two letters.
    let read = || {
        let reading = crate::formula::read(text, &open).ok()?;
        Some(super::parts_of(reading.content.expr()?.as_symbol()?).key())
    };
    let (mut parts, mut end, _) = whole(text, 0, &open)?;
    if let Some((word, stop)) = text[end..]
        .strip_prefix('^')
        .and_then(|_| braced(text, end + 1))
    {
        // I_{zz}^{cm}: as a spelling of one name the raised word is no exponent.
        parts.marks.push('^');
        parts.marks.push_str(&index_text(word)?);
        end = tail(text, stop, &mut parts, &open, false, &mut false);
    }
    match end == text.len() {
        true => Some(parts.key()),
        false => read(),
    }
}

/// Reads a name that starts at byte `at` with a macro, a Greek letter, a letter or a brace, undeclared or not.
pub(crate) fn whole(text: &str, at: usize, symbols: &Symbols) -> Option<(Parts, usize, bool)> {
    let mut parts = Parts::default();
    let end = base(text, at, &mut parts, 0)?;
    let mut took = false;
    let end = tail(text, end, &mut parts, symbols, false, &mut took);
    Some((parts, end, took))
}

/// Reads base and accent of a name; gives the byte after them.
pub(crate) fn base(text: &str, at: usize, parts: &mut Parts, depth: u32) -> Option<usize> {
    let rest = text.get(at..)?;
    let c = rest.chars().next()?;
    if depth > 4 {
        return None;
    }
    let end = match c {
        '\\' => {
            let length = letters_at(&rest[1..]);
            let word = &rest[1..1 + length];
            let behind = at + 1 + length;
            match word {
                "hat" | "widehat" | "dot" | "ddot" | "bar" | "overline" | "vec"
                | "overrightarrow" | "tilde" => {
                    parts.accent = match word {
                        "widehat" => "hat",
                        "overline" => "bar",
                        "overrightarrow" => "vec",
                        other => super::ACCENTS.iter().find(|accent| **accent == other)?,
                    };
                    let accent = parts.accent;
                    let end = argument(text, behind, parts, depth)?;
                    // `\ddot{\vec r}`
                    if parts.accent != accent {
                        parts.accent = super::both(parts.accent, accent)?;
                    }
                    end
                }
                "mathbf" | "boldsymbol" | "bm" | "textbf" => {
                    parts.bold = true;
                    argument(text, behind, parts, depth)?
                }
                "mathrm" | "mathit" | "mathsf" | "text" | "textit" | "textrm" | "mathcal" => {
                    argument(text, behind, parts, depth)?
                }
                _ => {
                    parts.base.push_str(match word {
                        "ell" => "l",
                        "imath" => "i",
                        "jmath" => "j",
                        word if is_greek(word) => word,
                        _ => return None,
                    });
                    behind
                }
            }
        }
        '{' => argument(text, at, parts, depth)?,
        c if accented(c).is_some() => {
            let (letter, accent) = accented(c)?;
            parts.accent = accent;
            parts.base.push(letter);
            at + c.len_utf8()
        }
        c if c.is_ascii_alphabetic() => {
            parts.base.push(c);
            at + 1
        }
        c => {
            parts.base.push_str(greek_name(c)?);
            at + c.len_utf8()
        }
    };
    Some(combining(text, end, parts))
}

/// Letter and accent of one character.
pub(crate) fn accented(c: char) -> Option<(char, &'static str)> {
    const LETTERS: [[&str; 3]; 3] = [
        ["îĵŷẑ", "ijyz", "hat"],
        ["ẋẏżṙṡṗ", "xyzrsp", "dot"],
        ["ẍÿ", "xy", "ddot"],
    ];
    if c.is_ascii() {
        return None;
    }
    LETTERS.iter().find_map(|[with, plain, accent]| {
        let at = with.chars().position(|letter| letter == c)?;
        Some((plain.chars().nth(at)?, *accent))
    })
}

/// An accent as a combining character behind the letter.
pub(crate) fn combining(text: &str, at: usize, parts: &mut Parts) -> usize {
    let Some(c) = text[at..].chars().next() else {
        return at;
    };
    let accent = match c {
        '\u{302}' => "hat",
        '\u{307}' => "dot",
        '\u{308}' => "ddot",
        '\u{304}' | '\u{305}' => "bar",
        '\u{20d7}' => "vec",
        '\u{303}' => "tilde",
        _ => return at,
    };
    match super::both(parts.accent, accent) {
        Some(accent) => parts.accent = accent,
        None => return at,
    }
    combining(text, at + c.len_utf8(), parts)
}

/// The base in braces, or the next single one, behind an accent or a font.
fn argument(text: &str, at: usize, parts: &mut Parts, depth: u32) -> Option<usize> {
    let at = at + text[at..].len() - text[at..].trim_start_matches(' ').len();
    let Some((inside, end)) = braced(text, at) else {
        return base(text, at, parts, depth + 1);
    };
    let trimmed = inside.trim();
    let used = base(trimmed, 0, parts, depth + 1)?;
    if used == trimmed.len() {
        return Some(end);
    }
    // \vec{v}_{G} may be written \vec{v_G}.
    let mut took = false;
    let inner = tail(trimmed, used, parts, &Symbols::open(), false, &mut took);
    if inner == trimmed.len() {
        return Some(end);
    }
    if depth == 0 && trimmed.len() <= LONGEST && trimmed.bytes().all(|b| b.is_ascii_alphanumeric())
    {
        parts.base = trimmed.to_string();
        return Some(end);
    }
    None
}
