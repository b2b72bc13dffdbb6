//! Taken off a text that could not be read as it stands: commands that only dress a formula, marks of a proof behind it, and
//! words for signs.
//!
//! In: a text. Out: the same, byte for byte, with blanks for what is taken off.

use super::prose::{Held, changes, is_in};
use super::symbols::name;
use super::token::function;
use super::{Reading, Symbols, is_greek, read};

/// Commands with a first group that says how the second is set.
const SET: &str = "textcolor color overset stackrel";
/// Commands whose group nobody sees.
const UNSEEN: &str = "phantom hphantom vphantom";
/// Commands around a formula, some with a remark below or above it.
const AROUND: &str = "underbrace overbrace underline";
/// What stands behind the end of a proof, or says how sure somebody is.
const END: &str = "\\checkmark|\\blacksquare|\\square|\\Box|\\qed|QED|q.e.d.|□|■|∎|✓|✔|?|:)|:-)";

/// Whether a word is a name, a function or a Greek letter.
pub(super) fn is_known(word: &str, symbols: &Symbols) -> bool {
    symbols.find(word).is_some() || function(word).is_some() || is_greek(word)
}

/// What is left of a formula that `cannot` be read as it stands without what dresses it; and one that is spoken.
pub(super) fn read_without(
    text: &str,
    symbols: &Symbols,
    held: Held,
    cannot: bool,
) -> Option<Reading> {
    let plain = undressed(text).filter(|_| cannot);
    let known = |word: &str| is_known(word, symbols);
    let said = || without_reason(text).or_else(|| unspoken(text, &known));
    let plain = plain.or_else(|| held.any(" ").then(said)?);
    read(&plain?, symbols).ok()
}

/// A text without what only dresses it; nothing where there is no such thing.
fn undressed(text: &str) -> Option<String> {
    let mut out = without_end(text).to_string();
    out.push_str(&" ".repeat(text.len() - out.len()));
    let mut at = 0;
    while let Some(found) = out[at..].find('\\') {
        let start = at + found;
        let word = out[start + 1..].bytes().take_while(u8::is_ascii_alphabetic);
        at = start + 1 + word.count();
        let name = out[start + 1..at].to_string();
        let blank = |out: &mut String, from: usize, to: usize| {
            out.replace_range(from..to, &" ".repeat(to - from));
        };
        let Some(end) = group(&out, at) else { continue };
        if is_in(UNSEEN, &name) {
            blank(&mut out, start, end);
        } else if is_in(SET, &name) {
            blank(&mut out, start, end);
            let sign = matches!(&*name, "overset" | "stackrel");
            if let Some(close) = group(&out, end) {
                open(&mut out, end, close, sign);
            }
        } else if is_in(AROUND, &name) {
            let remark = out[end..].starts_with(['_', '^']);
            if let Some(close) = group(&out, end + 1).filter(|_| remark) {
                blank(&mut out, end, close);
            }
            blank(&mut out, start, at);
            open(&mut out, at, end, false);
        }
    }
    (out != text).then_some(out)
}

/// Makes brackets of the braces of a group, or blanks where it holds a relation.
fn open(out: &mut String, at: usize, end: usize, sign: bool) {
    let inside = &out[at..end];
    let relates = sign || inside.contains(['=', '<', '>', '≤', '≥', '≈']);
    let [left, right] = if relates { [" ", " "] } else { ["(", ")"] };
    let brace = at + inside.find('{').unwrap_or(0);
    out.replace_range(brace..brace + 1, left);
    out.replace_range(end - 1..end, right);
}

/// The byte behind the group in braces that begins at a place, or after blanks.
fn group(text: &str, at: usize) -> Option<usize> {
    let rest = text.get(at..)?.trim_start_matches(' ');
    let length = name::closing(rest.as_bytes())? + 1;
    Some(text.len() - rest.len() + length)
}

/// A text without the reason in words behind it, `0 because the contact is smooth`, which holds no formula and denies nothing.
fn without_reason(text: &str) -> Option<String> {
    let words = [" because ", " since "].into_iter();
    let at = words.filter_map(|word| text.rfind(word)).max()?;
    let mut reason = text[at..]
        .split([' ', ',', '.'])
        .filter(|word| !word.is_empty());
    let plain = |word: &str| word.bytes().all(|b| b.is_ascii_alphabetic()) && !changes(word);
    let said = reason.all(plain) && text[at..].split_whitespace().count() > 2;
    (said && !text[..at].trim().is_empty()).then(|| text[..at].to_string())
}

/// A text without marks behind its end.
fn without_end(text: &str) -> &str {
    let mut text = text;
    loop {
        let plain = text.trim_end_matches(|c: char| c.is_whitespace() || c == '$');
        let Some(shorter) = END.split('|').find_map(|mark| plain.strip_suffix(mark)) else {
            return text;
        };
        text = shorter;
    }
}

/// A text with signs for the words that speak them, `m v squared over 2 l`; nothing where there are none, where a word is left
/// that is not `known`, or where it is not said how far a fraction or a root reaches.
fn unspoken(text: &str, known: &dyn Fn(&str) -> bool) -> Option<String> {
    let (name, right) = text
        .rfind('=')
        .map_or(("", text), |at| text.split_at(at + 1));
    let words: Vec<&str> = right
        .trim_matches([' ', '.', '$'])
        .split_whitespace()
        .collect();
    let mut out = String::new();
    let (mut rest, mut spoken, mut reaches) = (words.as_slice(), false, false);
    let mut open = 0;
    let mut summed = false;
    while let Some(word) = rest.first() {
        let before = rest.len();
        let (sign, length) = match rest {
            ["the", ..] => ("", 1),
            ["plus", ..] => ("+", 1),
            ["minus" | "negative", ..] => ("-", 1),
            ["multiplied", "by", ..] => ("*", 2),
            ["times", ..] => ("*", 1),
            ["twice", ..] => ("2*", 1),
            ["one", "half", "of", ..] => ("1/2*", 3),
            ["one", "half", ..] | ["half", "of", ..] => ("1/2*", 2),
            ["half", ..] => ("1/2*", 1),
            ["squared", ..] => ("^2", 1),
            ["cubed", ..] => ("^3", 1),
            ["sine", "of", ..] => ("sin", 2),
            ["sine", ..] => ("sin", 1),
            ["cosine", "of", ..] => ("cos", 2),
            ["cosine", ..] => ("cos", 1),
            ["divided", "by", ..] => (")/(", 2),
            ["over", ..] => (")/(", 1),
            ["square", "root", "of", ..] => ("sqrt(", 3),
            ["root" | "sqrt", "of", ..] => ("sqrt(", 2),
            _ => (*word, 0),
        };
        rest = &rest[length.max(1)..];
        spoken |= length > 0 && !sign.is_empty();
        let sum = sign.contains(['+', '-', '−']) && !sign.starts_with('(') && !out.is_empty();
        summed |= sum;
        let divides = sign.starts_with(')');
        // `a plus b over c` and `root of a plus b` may reach over the sum or not.
        if reaches && (sum || sign.ends_with('(')) || divides && (summed || reaches) {
            return None;
        }
        if divides {
            out.insert(0, '(');
        }
        if sign.ends_with('(') && length > 0 {
            reaches = before > length && !rest[0].starts_with('(');
            open += 1;
        }
        let strange = |run: &str| {
            let short = run.len() < 3 && !is_in("an as at by if in is it of on or to up", run);
            !(run.is_empty() || short || known(run))
        };
        if length == 0 && sign.split(|c: char| !c.is_alphabetic()).any(strange) {
            return None;
        }
        out.push_str(sign);
        out.push_str(if sign.starts_with('^') || length == 0 {
            " "
        } else {
            ""
        });
    }
    let out = out.replace(" ^", "^");
    spoken.then(|| format!("{name} {out}{}", ")".repeat(open)))
}
