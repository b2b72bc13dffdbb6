//! Numbers as people write them, read exactly: `.5`, `4.`, `1.5e-3`, `0.1` = 1/10.

use super::fault::{Fault, Faulty};
use super::token::{Literal, MAX_EXPONENT};
use crate::expr::number::ten_to;
use crate::expr::{Int, Rational};

/// Most digits of one number.
pub(crate) const MAX_DIGITS: usize = 400;

/// How an `e` behind the digits is taken.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Exponent {
    /// As a power of ten, where digits follow.
    Ten,
    /// As a symbol.
    Symbol,
}

/// A whole number of a few digits with nothing behind it that could belong to it, as most are; and how many bytes it has.
pub(crate) fn plain(text: &[u8]) -> Option<(Literal, usize)> {
    let digits = text.iter().take_while(|b| b.is_ascii_digit()).count();
    let ends = match text.get(digits) {
        None => true,
        // Groups of digits may follow.
        Some(b' ') => !text.get(digits + 1).is_some_and(u8::is_ascii_digit),
        Some(next) => next.is_ascii() && !b".,{\\eE'".contains(next),
    };
    if !ends || !(1..=18).contains(&digits) {
        return None;
    }
    let zeros = text[..digits].iter().take_while(|b| **b == b'0').count();
    let add = |value: i64, b: &u8| value * 10 + i64::from(b - b'0');
    let literal = Literal {
        value: Rational::from(Int::from(text[..digits].iter().fold(0, add))),
        digits: (digits - zeros).max(1) as u32,
        place: 0,
        decimal: false,
    };
    Some((literal, digits))
}

/// Reads the number that starts at byte `at`; gives it and the byte after it. In a `list` a comma separates components.
pub(crate) fn literal(
    text: &str,
    at: usize,
    exponent: Exponent,
    list: bool,
) -> Faulty<(Literal, usize)> {
    let bytes = text.as_bytes();
    let run = |mut i: usize| {
        while bytes.get(i).is_some_and(u8::is_ascii_digit) {
            i += 1;
        }
        i
    };
    let whole_end = run(at);
    let mut end = whole_end;
    let mut fraction = at..at;
    if bytes.get(end) == Some(&b'.') {
        let stop = run(end + 1);
        fraction = end + 1..stop;
        end = stop;
    }
    let decimal = end > whole_end;
    if !list {
        comma(text, at, end)?;
    }
    if bytes.get(end) == Some(&b'.') {
        let mut stop = end;
        while bytes
            .get(stop)
            .is_some_and(|b| b.is_ascii_digit() || *b == b'.')
        {
            stop += 1;
        }
        let shown = &text[at..stop];
        if shown.ends_with("...") {
            let message = format!("`{shown}` does not say which digits follow");
            let fault = Fault::new(message, at, stop);
            return Err(fault.hint("write a fraction, or 0.\\overline{3}"));
        }
        return Err(Fault::new(
            format!("`{shown}` is no number: it has two decimal points"),
            at,
            stop,
        ));
    }
    let digits = (whole_end - at) + fraction.len();
    if digits > MAX_DIGITS {
        return Err(Fault::new(
            format!("a number has at most {MAX_DIGITS} digits, this one has {digits}"),
            at,
            end,
        ));
    }
    let mut power = 0i64;
    let mut scientific = false;
    if exponent == Exponent::Ten
        && let Some((digits_at, stop, negative)) = exponent_at(bytes, end)
    {
        scientific = true;
        let digits = text[digits_at..stop].trim_start_matches('0');
        power = digits
            .bytes()
            .take(6)
            .fold(0, |value, b| value * 10 + i64::from(b - b'0'));
        if digits.len() > 6 || power > MAX_EXPONENT {
            let message = format!("the power of ten of a number is at most {MAX_EXPONENT}");
            return Err(Fault::new(message, end, stop));
        }
        if negative {
            power = -power;
        }
        end = stop;
    }
    let value = if digits <= 18 {
        let all = bytes[at..whole_end].iter().chain(&bytes[fraction.clone()]);
        Int::from(all.fold(0i64, |value, b| value * 10 + i64::from(b - b'0')))
    } else {
        let joined = format!("{}{}", &text[at..whole_end], &text[fraction.clone()]);
        <Int as num_traits::Num>::from_str_radix(&joined, 10)
            .map_err(|_| Fault::new("this is no number", at, end))?
    };
    let place = power - fraction.len() as i64;
    let zeros = text[at..end]
        .bytes()
        .take_while(|b| matches!(b, b'0' | b'.'))
        .filter(|b| *b == b'0')
        .count();
    let significant = digits.saturating_sub(zeros).max(usize::from(digits > 0));
    let found = Literal {
        value: match place {
            0 => Rational::from(value),
            _ => Rational::from(value) * ten_to(place),
        },
        digits: significant as u32,
        place: place as i32,
        decimal: decimal || scientific,
    };
    Ok((found, end))
}

/// Digits, end and sign of a power of ten written `e-3` at byte `at`.
pub(crate) fn exponent_at(bytes: &[u8], at: usize) -> Option<(usize, usize, bool)> {
    if !matches!(bytes.get(at), Some(b'e' | b'E')) {
        return None;
    }
    let rest = bytes.get(at + 1..)?;
    let mut signs = ["-", "−", "–", "+"].into_iter();
    let sign = signs.find(|s| rest.starts_with(s.as_bytes()));
    let negative = sign.is_some_and(|sign| sign != "+");
    let digits_at = at + 1 + sign.map_or(0, str::len);
    let count = bytes[digits_at.min(bytes.len())..]
        .iter()
        .take_while(|b| b.is_ascii_digit())
        .count();
    (count > 0).then_some((digits_at, digits_at + count, negative))
}

/// `0.1\overline{6}`, `0.\bar{3}` and `0.(3)`: a decimal number whose last digits repeat without end. Brackets behind a digit,
/// as in `0.1(6)`, may be a product.
pub(crate) fn repeating(
    text: &str,
    at: usize,
    end: usize,
    begun: &Literal,
) -> Option<(Literal, usize)> {
    let rest = &text[end..];
    let marks = [("\\overline{", '}'), ("\\bar{", '}'), ("(", ')')];
    let (mark, close) = marks.iter().find(|(mark, _)| rest.starts_with(mark))?;
    let (digits, _) = rest[mark.len()..].split_once(*close)?;
    let are_digits = digits.len() < 9 && digits.bytes().all(|b| b.is_ascii_digit());
    let period = digits.parse::<u32>().ok().filter(|_| are_digits)?;
    let written = &text[at..end];
    if !written.contains('.') || *close == ')' && !written.ends_with('.') {
        return None;
    }
    let nines = ten_to(digits.len() as i64) - Rational::from(Int::from(1));
    let tail = Rational::from(Int::from(i64::from(period))) / nines;
    let value = &begun.value + &(tail * ten_to(i64::from(begun.place)));
    let literal = Literal {
        value,
        decimal: false,
        ..begun.clone()
    };
    Some((literal, end + mark.len() + digits.len() + 1))
}

/// Whether digits in brackets with a unit or a name behind them follow: `(2) m` of `1.5(2) m`.
pub(crate) fn uncertain(rest: &str) -> bool {
    let inside = rest.strip_prefix('(').and_then(|r| r.split_once(')'));
    inside.is_some_and(|(digits, behind)| {
        let behind = behind.trim_start().trim_start_matches("\\,");
        matches!(digits.len(), 1 | 2)
            && digits.bytes().all(|b| b.is_ascii_digit())
            && behind.starts_with(|c: char| c.is_alphabetic() || c == '\\')
    })
}

/// A number in groups of three digits: `12\,000`, `12 000`, `12,\!000` and `12'000`, `1,000,000` with two commas or more or
/// a point behind, which nothing else could be outside a `list`; `inside` brackets `(1,234.5)` could be one.
pub(crate) fn grouped(
    text: &str,
    at: usize,
    list: bool,
    inside: bool,
) -> Option<Faulty<(Literal, usize)>> {
    const BETWEEN: [&str; 10] = [
        "\\,", "\u{202f}", "\u{2009}", "{,}", " ", ",\\! ", ",\\!", "'", "’", ",",
    ];
    let digits = |from: usize| text[from..].bytes().take_while(u8::is_ascii_digit).count();
    let first = digits(at);
    if !(1..=3).contains(&first) {
        return None;
    }
    let mut end = at + first;
    let between = BETWEEN.iter().find(|s| text[end..].starts_with(**s))?;
    let mut plain = text[at..end].to_string();
    let mut groups = 0;
    while text[end..].starts_with(between) && digits(end + between.len()) == 3 {
        let from = end + between.len();
        plain.push_str(&text[from..from + 3]);
        end = from + 3;
        groups += 1;
    }
    let unclear = match *between {
        "," | "{,}" => {
            let point = !inside && text[end..].starts_with('.') && digits(end + 1) > 0;
            list || groups < 2 && !point || text[end..].starts_with(',')
        }
        " " => plain.starts_with('0') || text[end..].starts_with(','),
        _ => false,
    };
    if groups == 0 || unclear {
        return None;
    }
    let part = match text[end..].strip_prefix('.') {
        Some(_) if digits(end + 1) > 0 => 1 + digits(end + 1),
        _ => 0,
    };
    plain.push_str(&text[end..end + part]);
    let read = literal(&plain, 0, Exponent::Symbol, false);
    Some(read.map(|(found, _)| (found, end + part)))
}

/// `3,5` as three and a half, where nothing else can be meant: the only comma, no point elsewhere, not three digits behind
/// it unless a zero stands before.
pub(crate) fn decimal_comma(text: &str, at: usize) -> Option<(Literal, usize)> {
    let digits = |from: usize| text[from..].bytes().take_while(u8::is_ascii_digit).count();
    let whole = digits(at);
    let rest = &text[at + whole..];
    let sign = ["{,}", ","].into_iter().find(|s| rest.starts_with(s))?;
    let from = at + whole + sign.len();
    let part = digits(from);
    let other = text.replacen(sign, "", 1);
    let points = other
        .as_bytes()
        .windows(2)
        .any(|w| w[0] == b'.' && w[1].is_ascii_digit() || w[0] == b',' && sign == ",");
    let thousands = part == 3 && &text[at..at + whole] != "0";
    if whole == 0 || part == 0 || thousands || points || whole + part > 18 {
        return None;
    }
    let plain = format!("{}.{}", &text[at..at + whole], &text[from..from + part]);
    let (found, _) = literal(&plain, 0, Exponent::Symbol, false).ok()?;
    Some((found, from + part))
}

/// A comma between digits is asked back: it could be a decimal sign, a thousands separator or a list.
fn comma(text: &str, at: usize, end: usize) -> Faulty<()> {
    let rest = &text[end..];
    let length = if rest.starts_with("{,}") { 3 } else { 1 };
    if !(rest.starts_with("{,}") || rest.starts_with(',')) {
        return Ok(());
    }
    let digits = rest[length..]
        .bytes()
        .take_while(u8::is_ascii_digit)
        .count();
    if digits == 0 {
        return Ok(());
    }
    let part = &rest[length..length + digits];
    // The points of `1.000,5` divide thousands.
    let whole = text[at..end].replace('.', "");
    let mut hint = format!("write {whole}.{part} for a decimal number");
    if digits == 3 {
        hint.push_str(&format!(", {whole}{part} for thousands"));
    }
    hint.push_str(&format!(
        ", or {whole}, {part} with a space for two components"
    ));
    let fault = Fault::new(
        "a comma between digits could mean several things",
        end,
        end + length,
    );
    Err(fault.hint(hint))
}
