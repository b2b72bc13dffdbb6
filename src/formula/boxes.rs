//! The last `\boxed{}` of a text, and what of the text around it belongs to its formula.
//!
//! In: a text. Out: the same, byte for byte, with blanks for what is passed over: words before the box and behind it, the
//! left side of an equation that ends in it. A sign, number or symbol that touches the box stays, and then the braces of the
//! box are brackets. Words that could change the value are a fault, and so is another value beside the box.

use super::fault::{Fault, Faulty};
use super::plain_unit;
use super::prose::{changes, goes_on, is_in, leads};
use super::several::MOST;
use super::symbols::{among, name};
use crate::dimension;

const OPEN: [&str; 2] = ["\\boxed", "\\fbox"];
/// What ends the formula before a box.
const BEFORE: &str = "=|≈|:|;|, |. |\n|&|\\\\|\\approx|\\simeq|\\implies|\\Rightarrow|\\Longrightarrow|\\rightarrow|\\to|\
    \\therefore|\\iff|\\Leftrightarrow|\\quad|\\qquad|⟹|⇒|→|∴|⟺|⇔|->";
/// What ends the formula behind one.
const BEHIND: &str =
    "\n|&|\\\\|\\end{|\\tag|\\label|\\quad|\\qquad|\\blacksquare|\\square|\\Box|□|■|∎|;|, |. ";
/// Groups of words in LaTeX.
const WORDS: [&str; 5] = ["text", "textbf", "textrm", "mbox", "textit"];

/// The formula of the last box; nothing where there is no box.
pub(super) fn unboxed(text: &str) -> Option<Faulty<String>> {
    let last = last_box(text, text.len())?;
    let text = named(text);
    Some(last.and_then(|[at, start, end]| around(&text, at, [start, end])))
}

/// Several boxes that a sentence names, `v is \boxed{5} m/s and t is \boxed{3} s`, with signs of equality.
fn named(text: &str) -> String {
    let mut out = text.to_string();
    let opens = |rest: &str| OPEN.iter().any(|open| rest.starts_with(open));
    if OPEN
        .map(|open| text.matches(open).count())
        .iter()
        .sum::<usize>()
        < 2
    {
        return out;
    }
    for (at, verb) in text.match_indices(" is ") {
        let before = text[..at].trim_end_matches('$');
        let name = before.rsplit([' ', '$']).next().unwrap_or_default();
        let letters = name.trim_start_matches('\\').split('_').next();
        let short =
            letters.is_some_and(|l| name.starts_with('\\') || (1..3).contains(&l.chars().count()));
        if short && opens(text[at + verb.len()..].trim_start_matches([' ', '$'])) {
            out.replace_range(at + 1..at + 3, "= ");
        }
    }
    out
}

/// Where the last box before a byte begins, and start and end of its inside.
fn last_box(text: &str, before: usize) -> Option<Faulty<[usize; 3]>> {
    let found = OPEN.iter().filter_map(|open| {
        let at = text[..before].rfind(open)?;
        Some((at, at + open.len()))
    });
    let (at, named) = found.max()?;
    let start = named + text[named..].len() - text[named..].trim_start().len();
    Some(match closing(text, start) {
        Some(end) => Ok([at, start + 1, end]),
        None => {
            let message = "\\boxed needs a group in braces that is closed";
            Err(Fault::new(message, at, named))
        }
    })
}

/// The brace that closes the one at a byte.
fn closing(text: &str, open: usize) -> Option<usize> {
    Some(open + name::closing(text.as_bytes().get(open..)?)?)
}

fn around(text: &str, mut at: usize, inside: [usize; 2]) -> Faulty<String> {
    let [mut from, mut to] = inside;
    let mut close = to + 1;
    // `\text{the speed is \boxed{5}}`, `\underline{\boxed{5}}`: a group that changes nothing.
    while let Some(open) = trimmed(&text[..at]).strip_suffix('{')
        && text[close..]
            .trim_start_matches([' ', '.'])
            .starts_with('}')
    {
        let letters = open.trim_end_matches(|c: char| c.is_ascii_alphabetic());
        let name = &open[letters.len()..];
        let dresses = "boxed fbox underline mathbf boldsymbol bm mathrm displaystyle color";
        let known = letters.ends_with('\\') && (WORDS.contains(&name) || dresses.contains(name));
        if !known && !open.is_empty() && !open.ends_with([' ', '$']) {
            break;
        }
        close += text[close..].find('}').map_or(0, |end| end + 1);
        at = if known { letters.len() - 1 } else { open.len() };
    }
    let in_dollars = text[..at].matches('$').count() % 2 == 1;
    let opened = text[..at].trim_end().ends_with('$');
    let math = in_dollars && !opened;
    let (left, joined) = match joined_boxes(text, at)? {
        Some(first) => (first, true),
        None => (before(text, at, math)?, false),
    };
    if beside(&text[..at], &text[inside[0]..inside[1]], &text[close..]) && !joined {
        let fault = Fault::new("another value stands beside the box", at, close);
        return Err(fault.hint("give one value, or each value in its own box"));
    }
    let math = in_dollars && !text[close..].trim_start().starts_with('$');
    let right = behind(text, close, math, left < at)?;
    let soft = joined || left == at || text[left..at].contains(['<', '>', '≤', '≥']);
    let soft = soft && right.is_none_or(|(_, soft)| soft);
    let right = right.map(|(end, _)| end);
    if left < at || right.is_some() {
        (from, to) = (left, right.unwrap_or(close));
    }
    let mut out = format!("{:from$}{}", "", &text[from..to]);
    // Each box inside what is kept; its braces are brackets where something touches it.
    while let Some(Ok([at, start, end])) = last_box(&out, out.len()) {
        let [open, shut] = if soft { [" ", " "] } else { ["(", ")"] };
        out.replace_range(end..end + 1, shut);
        out.replace_range(start - 1..start, open);
        out.replace_range(at..start - 1, &" ".repeat(start - 1 - at));
    }
    if joined {
        for frame in ["\\(", "\\)", "\\[", "\\]"] {
            out = out.replace(frame, "  ");
        }
    }
    Ok(out.replace('$', " "))
}

/// A text without blanks, dollars and what else only sets the type at its end.
fn trimmed(mut text: &str) -> &str {
    const DRESS: &str = "**|\\(|\\[|\\,|\\;|\\!|\\ |\\displaystyle|\\Large|\\large|\\left|#";
    loop {
        text = text.trim_end_matches(|c: char| c.is_whitespace() || "$\"“~".contains(c));
        match DRESS.split('|').find_map(|dress| text.strip_suffix(dress)) {
            Some(shorter) => text = shorter,
            None => return text,
        }
    }
}

/// A text without the like at its beginning.
fn bare(mut text: &str) -> &str {
    const DRESS: &str = "**|\\)|\\]|\\,|\\;|\\!|\\ |\\right";
    loop {
        text = text.trim_start_matches(|c: char| c.is_whitespace() || "$\"”~".contains(c));
        match DRESS.split('|').find_map(|dress| text.strip_prefix(dress)) {
            Some(shorter) => text = shorter,
            None => return text,
        }
    }
}

/// A text with blanks for some signs, `|` between them.
fn blanked(text: &str, signs: &str) -> String {
    let signs = signs.split('|');
    signs.fold(text.to_string(), |text, sign| text.replace(sign, " "))
}

/// Where the first of several boxes begins that a comma or a word joins: `\boxed{5} and \boxed{6}`.
fn joined_boxes(text: &str, mut at: usize) -> Faulty<Option<usize>> {
    let mut first = None;
    for _ in 1..MOST {
        let Some(Ok([other, _, end])) = last_box(text, at) else {
            break;
        };
        if !joins(text.get(end + 1..at).unwrap_or_default()) {
            break;
        }
        first = Some(other);
        at = other;
    }
    // The name before the first of them, as before the others.
    let Some(first) = first else { return Ok(None) };
    let named = trimmed(&text[..first]).strip_suffix('=').map(str::trim_end);
    let name = named.and_then(|named| named.rsplit([' ', '$']).next());
    let begins = name.and_then(|name| text[..first].rfind(name));
    Ok(Some(begins.unwrap_or(first)))
}

/// Whether what stands between two boxes joins them: a comma or a word, a unit before it, and the name of the next behind it.
fn joins(between: &str) -> bool {
    let bare = blanked(between, "\\text|\\mathrm|\\quad|\\(|\\)|\\[|\\]|\\,");
    let bare = format!(" {} ", bare.replace(['$', '{', '}'], " ").trim());
    let signs = [" and ", " or ", ",", ";"].into_iter();
    let Some((at, sign)) = signs
        .filter_map(|sign| Some((bare.find(sign)?, sign)))
        .min()
    else {
        return false;
    };
    let (unit, name) = (bare[..at].trim(), bare[at + sign.len()..].trim());
    let name = name.strip_prefix("and ").unwrap_or(name);
    let measures = |unit: &str| plain_unit(unit).is_some_and(|unit| dimension::unit(&unit).is_ok());
    let named = |name: &str| {
        name.strip_suffix('=')
            .is_some_and(|name| !name.trim().contains(' '))
    };
    (unit.is_empty() || measures(unit)) && (name.is_empty() || matches!(name, "and") || named(name))
}

/// Words that take back what was said.
const TAKEN_BACK: &str =
    "actually correction corrected edit except mistake oops otherwise sorry unless wait";
/// Words with which a clause begins: what it says of its names is no other value.
const CLAUSES: &str = "because by from hence in since so therefore thus using where which with";
/// Words that lead to a case.
const CASES: &str = "for if provided when whenever while";
/// Words that lead to another value.
const MORE: &str =
    "also alternatively and another besides but could either may might or other plus second well";

/// Whether what stands before or behind a box says another value than its `inside`, or takes it back: `\boxed{2} and 3`,
/// `\boxed{v/2} for m = M`, `\boxed{2}. Correction: 3`.
fn beside(before: &str, inside: &str, behind: &str) -> bool {
    let ends = [". ", ".$", "\n", "\\\\", "&", "\\end", "\\tag"];
    let end = ends.iter().filter_map(|end| behind.find(end)).min();
    let (sentence, further) = behind.split_at(end.unwrap_or(behind.len()));
    let mut all = words(sentence).chain(words(further));
    if all.any(|(word, _)| is_in(TAKEN_BACK, word)) {
        return true;
    }
    // `\boxed{5}. Final answer: 10`
    let concludes = |(word, at): (&str, usize)| {
        let rest = behind[at + word.len()..].trim_start();
        let said = ["is ", ":", "="]
            .iter()
            .find_map(|lead| rest.strip_prefix(lead));
        let again = |said: &str| {
            let said = bare(said).strip_prefix(inside.trim());
            said.is_some_and(|rest| !rest.starts_with(char::is_alphanumeric))
        };
        said.is_some_and(|said| says_value(said) && !again(said))
    };
    let answers = words(behind).filter(|(word, _)| word.eq_ignore_ascii_case("answer"));
    if answers.last().is_some_and(concludes) {
        return true;
    }
    let last = trimmed(before);
    let joined = |word: &str| {
        let rest = last.strip_suffix(word);
        rest.is_some_and(|rest| rest.ends_with(' ') && trimmed(rest) != rest.trim_end())
    };
    if !inside.contains('=') && (joined("and") || joined("or")) {
        return true;
    }
    let semicolon = sentence.find(';');
    let semicolon = semicolon.filter(|at| !sentence[..*at].ends_with('\\'));
    let (near, apart) = sentence.split_at(semicolon.unwrap_or(sentence.len()));
    let mut near = words(near).take_while(|(word, _)| !is_in(CLAUSES, word));
    let another = |(word, at): (&str, usize)| {
        let rest = &sentence[at + word.len()..];
        is_in(CASES, word) && relates(rest) || is_in(MORE, word) && says_value(rest)
    };
    let begins_clause = words(apart)
        .next()
        .is_some_and(|(word, _)| is_in(CLAUSES, word));
    near.any(another) || !begins_clause && says_value(apart.trim_start_matches(';'))
}

/// The words of a text, each with the byte where it begins.
fn words(text: &str) -> impl Iterator<Item = (&str, usize)> {
    let mut end = 0;
    let pieces = text.split_inclusive(|c: char| !c.is_alphabetic());
    pieces.filter_map(move |piece| {
        let at = end;
        end += piece.len();
        let word = piece.trim_end_matches(|c: char| !c.is_alphabetic());
        (!word.is_empty()).then_some((word, at))
    })
}

/// Whether a text holds a relation.
fn relates(text: &str) -> bool {
    text.contains(['=', '<', '>', '≤', '≥']) || text.contains("\\l") || text.contains("\\g")
}

/// Whether a text holds a number, a name of one letter or a formula.
fn says_value(text: &str) -> bool {
    let bare = blanked(text, "\\text|\\quad|\\mathrm|\\;|\\,|\\)|\\]");
    let mut words = bare.split(|c: char| !c.is_alphanumeric());
    let name = |word: &str| word.chars().count() == 1 && !is_in("a i", word);
    bare.contains(['\\', '=']) || words.any(|w| name(w) || w.contains(char::is_numeric))
}

/// The last place where one of several signs ends.
fn last_end(text: &str, signs: &str) -> usize {
    let ends = signs
        .split('|')
        .filter_map(|sign| Some(text.rfind(sign)? + sign.len()));
    ends.max().unwrap_or(0)
}

/// Whether a word is one of prose: two letters at least, and no command.
fn is_prose(word: &str) -> bool {
    let word = word.trim_matches(|c: char| !c.is_alphabetic() && c != '\\');
    word.chars().count() > 1 && word.chars().all(|c| c.is_alphabetic() || "'’-".contains(c))
}

fn fault(from: usize, to: usize) -> Box<Fault> {
    let fault = Fault::new("words beside the box could change what it says", from, to);
    fault.hint("give the formula alone")
}

/// Where the formula begins that a box ends: at the box, unless something before it touches it.
fn before(text: &str, at: usize, math: bool) -> Faulty<usize> {
    let mut from = last_end(&text[..at], BEFORE);
    if math {
        from = from.max(last_end(&text[..at], "$"));
    }
    // Behind a group of words or another box.
    for group in WORDS
        .iter()
        .chain(&["begin", "end", "boxed", "fbox", "tag"])
    {
        let opened = text[from..at]
            .rfind(&format!("\\{group}{{"))
            .map(|open| from + open);
        let shut = opened.and_then(|open| closing(text, open + group.len() + 1));
        if let Some(shut) = shut.filter(|shut| *shut < at) {
            let last = trimmed(&text[..at]).len() == shut + 1;
            let is_box = matches!(*group, "boxed" | "fbox");
            if WORDS.contains(group) {
                let words = &text[opened.unwrap_or(shut) + group.len() + 2..shut];
                checked(words, [from, at])?;
            }
            if !is_box || last {
                from = from.max(shut + 1);
            }
        }
    }
    let body = trimmed(&text[from..at]);
    let from = from + body.len() - bare(body).len();
    let body = bare(body);
    let label = !math && matches!(body.trim_matches(['(', ')']), "a" | "b" | "c" | "d");
    if body.is_empty() || label && body.ends_with(')') {
        return Ok(at);
    }
    if math {
        return Ok(from);
    }
    // What stands behind the last word touches the box.
    let mut start = from;
    let mut word_end = None;
    for word in body.split_inclusive([' ', '\n']) {
        start += word.len();
        if is_prose(word) {
            word_end = Some((start, word.trim()));
        }
    }
    let Some((end, word)) = word_end else {
        return Ok(from);
    };
    checked(&text[from..end], [from, at])?;
    let rest = &text[end.min(at)..at];
    match bare(trimmed(rest)) {
        "" => Ok(at),
        touching if leads(word) || touching.starts_with(['-', '−', '+', '±']) => {
            Ok(at - rest.len())
        }
        _ => Err(fault(from, at)),
    }
}

/// Refuses words before a box of which one could change its value: those behind the last verb, or the last three.
fn checked(words: &str, [from, to]: [usize; 2]) -> Faulty<()> {
    let split = words.split(|c: char| !c.is_alphabetic() && !"'’".contains(c));
    let words: Vec<&str> = split.filter(|word| !word.is_empty()).collect();
    let verb = words.iter().rposition(|word| leads(word) && *word != "by");
    let behind = verb.map_or(words.len().saturating_sub(3), |verb| verb + 1);
    let denied = words.iter().rev().take(4);
    let denied = denied.filter(|word| is_denial(word)).count() > 0;
    match denied || words[behind..].iter().any(|word| changes(word)) {
        true => Err(fault(from, to)),
        false => Ok(()),
    }
}

/// Whether a word says that something is not so, wherever it stands.
fn is_wrong(word: &str) -> bool {
    const WORDS: &str = "wrong incorrect incorrectly wrongly mistaken false untrue";
    is_in(WORDS, word)
}

fn is_denial(word: &str) -> bool {
    const WORDS: &str = "not never cannot no impossible neither";
    is_wrong(word) || is_in(WORDS, word) || word.ends_with("n't") || word.ends_with("n’t")
}

/// Where the formula ends that begins with a box, and whether what touches it is a unit, a relation or the like, which needs
/// no brackets around the box; nothing where it ends with the box.
fn behind(text: &str, close: usize, math: bool, touched: bool) -> Faulty<Option<(usize, bool)>> {
    const FACTORS: &str = "million thousand billion trillion hundred dozen or";
    let rest = &text[close..];
    let words = rest.split(|c: char| !c.is_alphabetic() && !"'’".contains(c));
    let mut words = words
        .filter(|word| !word.is_empty() && *word != "text")
        .take(12);
    if words.any(is_wrong) {
        return Err(fault(close, text.len()));
    }
    let stops = BEHIND.split('|').filter_map(|sign| rest.find(sign));
    let mut stop = stops.min().unwrap_or(rest.len());
    let listed = rest[stop..].strip_prefix(", ").map(bare);
    if listed.is_some_and(|next| next.starts_with(|c: char| c.is_ascii_digit() || "-−".contains(c)))
    {
        return Ok(Some((text.len(), true)));
    }
    if let Some(end) = rest[..stop]
        .find('$')
        .filter(|end| math && !bare(&rest[..*end]).is_empty())
    {
        stop = stop.min(end);
    }
    let punctuation = |c: char| c.is_whitespace() || "$.,".contains(c);
    let body = bare(&rest[..stop]).trim_end_matches(punctuation);
    let end = close + stop;
    let apart = rest[..rest.len() - bare(rest).len()].contains([' ', '$']);
    let unit = plain_unit(body).and_then(|plain| dimension::unit(&plain).ok());
    if unit.is_some_and(|unit| !unit.dimension.is_none() || unit.angle) {
        return Ok(Some((end, true)));
    }
    let first = body.split([' ', '$', ',']).next().unwrap_or_default();
    let in_group = WORDS
        .iter()
        .find_map(|group| body.strip_prefix(&format!("\\{group}{{")));
    let said = in_group.map(|inside| inside.split('}').next().unwrap_or(inside));
    let aside = body
        .strip_prefix('(')
        .filter(|inside| inside.split([' ', ')']).any(is_prose));
    let dash = body.strip_prefix(['-', '–', '—']).map(str::trim_start);
    let dash = dash.filter(|said| apart && said.split(' ').next().is_some_and(is_prose));
    let prose = (!math && is_prose(first)).then_some(body);
    let prose = said.or(aside).or(dash).or(prose).map(str::trim_start);
    if let Some(said) = prose {
        let word = said.split([' ', ',', '}', ')']).next().unwrap_or_default();
        if ["percent", "pct", "degrees", "degree", "deg", "per"].contains(&word) {
            return Ok(Some((end, true)));
        }
        let capital = word.starts_with(char::is_uppercase);
        let mut first = said.split([' ', ',']).take(4);
        let changed = match word {
            "is" | "was" | "are" => first.any(is_denial),
            _ => first.any(changes),
        };
        let plain = capital || goes_on(word) || word.is_empty();
        return match changed || !plain || among(FACTORS, word) {
            true => Err(fault(close, text.len())),
            false => Ok(None),
        };
    }
    if body.is_empty()
        || !touched && body.starts_with(['}', ')'])
        || apart && matches!(body, "!" | "*")
    {
        return Ok(None);
    }
    let soft =
        body.starts_with(['=', '≈', '<', '>', '≤', '≥', '°', ',']) || body.starts_with("\\approx");
    Ok(Some((end, soft)))
}
