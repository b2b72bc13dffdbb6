//! Answers that cannot be read as they stand: numbers with two meanings, and words beside a box.

use super::super::{
    Grade, Key, Options, Verdict, compare, judge_against, judge_here, read, unreadable,
};
use super::{LONGEST, ambiguous, with_commas};
use crate::formula::{Content, Fault};
use crate::grade::read::mixed::{digits, mixed};

/// The grade of an answer that cannot be read as it stands, where there is another way.
pub(in crate::grade) fn unread(key: &Key, answer: &str, options: &Options) -> Option<Grade> {
    number(key, answer, options)
        .or_else(|| aside(key, answer, options))
        .or_else(|| without_commas(key, answer, options))
}

/// `v_1 = 3 m/s v_2 = 4 m/s`, which can be read with a comma: right with it is not decided.
fn without_commas(key: &Key, answer: &str, options: &Options) -> Option<Grade> {
    let text = with_commas(answer).filter(|_| answer.len() <= LONGEST)?;
    let reading = read::answer(key, &text).ok()?;
    let hint = "write a comma between two equations";
    let mut finding = compare::contents(key, &reading, options);
    if finding.is_equivalent() {
        let words = format!("it would be right as {text}");
        ambiguous(&mut finding, &words, hint);
        return Some(finding);
    }
    let at = answer.rfind('=').unwrap_or_default();
    let fault = Fault::new("two equations side by side", at, at + 1);
    Some(unreadable(*fault.hint(hint)))
}

/// `\boxed{2 m v} (to the right)`: what is boxed is right, and the words beside the box say the direction that nearly always
/// counts as positive. With other words it stays unread.
fn aside(key: &Key, answer: &str, options: &Options) -> Option<Grade> {
    let (value, direction) = read::sense(answer)?;
    let boxed = value.contains("\\boxed{") && value.trim_end_matches('$').ends_with('}');
    if !boxed || direction.iter().sum::<i32>() < 0 || key.direction.is_some() {
        return None;
    }
    let mut grade = judge_here(key, value, options);
    let words = "the direction in words is not judged";
    grade.assumed.push(words.to_string());
    grade.is_equivalent().then_some(grade)
}

/// An answer that cannot be read because a number in it has two meanings, and is right in one of them, is right: `1,500 N`,
/// where a comma groups thousands or begins the decimals, and the mixed number `1 3/4`. Otherwise it stays unread.
pub(in crate::grade) fn number(key: &Key, answer: &str, options: &Options) -> Option<Grade> {
    if answer.len() > LONGEST {
        return None;
    }
    let comma = |rest: &str| Some(comma(rest)?.0);
    let hint = "write numbers without a comma: it parts thousands in some countries and decimals in others";
    let beside = "write 7/4 or 1 + 3/4: side by side they could be a product";
    // `(2,3)` is two components.
    let inside = answer.trim_start().strip_prefix(['(', '[']);
    let pair = inside.is_some_and(|rest| rest[digits(rest)..].starts_with(','));
    let parts = parted(answer, comma).filter(|_| !pair);
    let comma = parts.into_iter().flat_map(|parts| {
        let thousands = parts[1..].iter().all(|part| digits(part) == 3);
        let mut signs = if thousands { vec!["", "."] } else { vec!["."] };
        // `x=2,3` are two values where the expected equation has two.
        if matches!(key.reading.content, Content::Relations(..)) {
            signs.push(", ");
        }
        let read = |sign| (parts.join(sign), hint);
        signs.into_iter().map(read).collect::<Vec<_>>()
    });
    let mixed = mixed(answer).map(|text| (text, beside));
    comma.chain(mixed).find_map(|(text, hint)| {
        let grade = judge_here(key, &text, options);
        let message = format!("right when it is read as {text}");
        grade.is_equivalent().then(|| grade.reread(message, hint))
    })
}

/// The bytes of a comma with which a text begins, and how many digits stand behind it, one at least.
fn comma(text: &str) -> Option<(usize, usize)> {
    let mut signs = ["{,}", ","].into_iter();
    let length = signs.find(|sign| text.starts_with(sign))?.len();
    Some((length, digits(&text[length..]))).filter(|(_, digits)| *digits > 0)
}

/// A text cut behind digits where something stands, which is so many bytes long; nothing where it stands nowhere.
fn parted(text: &str, stands: impl Fn(&str) -> Option<usize>) -> Option<Vec<String>> {
    let mut parts = vec![String::new()];
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let behind = parts.last()?.ends_with(|c: char| c.is_ascii_digit());
        let length = Some(rest).filter(|_| behind).and_then(&stands);
        match length {
            Some(length) => {
                parts.push(String::new());
                rest = &rest[length..];
                // What follows belongs to the next part whatever it is.
                let next = rest.chars().next()?;
                parts.last_mut()?.push(next);
                rest = &rest[next.len_utf8()..];
            }
            None => {
                parts.last_mut()?.push(c);
                rest = &rest[c.len_utf8()..];
            }
        }
    }
    (parts.len() > 1).then_some(parts)
}

/// An expected formula with one comma before three digits, as a number of thousands and as a decimal number.
pub(in crate::grade) fn commas(expected: &str) -> Option<[String; 2]> {
    let comma = |rest: &str| Some(comma(rest).filter(|(_, digits)| *digits == 3)?.0);
    let inside = expected.trim_start().starts_with(['(', '[', '{', '\\']);
    let parts = parted(expected, comma).filter(|parts| parts.len() == 2 && !inside)?;
    let starts = parts[0].len()
        - parts[0]
            .trim_end_matches(|c: char| c.is_ascii_digit())
            .len();
    (1..4)
        .contains(&starts)
        .then(|| ["", "."].map(|sign| parts.join(sign)))
}

/// The grade against a number whose comma is taken to part thousands; undecided where it is right with a decimal comma.
pub(in crate::grade) fn either_comma(keys: [&Key; 2], answer: &str, options: &Options) -> Grade {
    let [thousands, decimals] = keys.map(|key| judge_against(key, answer, options));
    let words = "the comma in the expected number parts thousands or decimals: the answer is right in one reading";
    let mut grade = match (thousands.is_equivalent(), decimals.is_equivalent()) {
        (false, true) => Grade::new(Verdict::Undecided, "UNDECIDED_AMBIGUOUS", "none", words),
        _ => thousands,
    };
    if grade.is_equivalent() {
        grade
            .assumed
            .push("the comma in the expected number parts thousands".into());
    }
    grade
}
