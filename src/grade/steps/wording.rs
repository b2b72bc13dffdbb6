//! Signs and names for the words of a line: `ω is 3v/(2l)`, `KE before = ½mv²`, `v just after the hit`.

use super::text::{is_word, relates};

/// Words that stand for a sign of equality behind a name.
pub(super) const VERBS: [&str; 4] = [" is equal to ", " is given by ", " equals ", " is "];

/// `$\omega$ is negative: …` with a relation for the words, where they end a clause: `θ is positive counterclockwise` tells how
/// it is counted.
fn signs_in_words(line: &str, asked: &dyn Fn(&str) -> bool) -> Option<String> {
    const SIGNED: [(&str, &str); 3] = [
        (" is positive", " > 0"),
        (" is negative", " < 0"),
        (" is zero", " = 0"),
    ];
    SIGNED.iter().find_map(|(words, relation)| {
        let (before, behind) = line.split_once(words)?;
        if !behind.is_empty() && !behind.starts_with([':', '.', ',', ';']) {
            return None;
        }
        if let Some(formula) = before.strip_suffix('$') {
            let inside = formula
                .rsplit('$')
                .next()
                .is_some_and(|inside| !relates(inside));
            return inside.then(|| format!("{formula}{relation}$ {behind}"));
        }
        let name = before.rsplit([' ', ',']).next()?;
        (asked(name) && !relates(before)).then(|| format!("{name}{relation}{behind}"))
    })
}

/// Words behind the letters of a quantity that tell which value of it is meant.
const WHICH: [&str; 6] = ["before", "after", "lost", "gained", "initially", "finally"];

/// A line with signs and names for words: `ω is 3v/(2l)` with a sign of equality, `KE before = ½mv²` with the name `KE_before`.
/// What is `asked` of the moment just after is its own name then.
pub(super) fn in_names(line: &str, asked: &dyn Fn(&str) -> bool) -> String {
    let line = line.replace("K.E.", "KE").replace("P.E.", "PE");
    // `After the 1st bounce v = …`
    let line = line.replace(" the 1st ", " the first ");
    let line = line.replace(" the 2nd ", " the second ");
    // `v_B,x`
    let line = ["x", "y"]
        .iter()
        .fold(line, |line, axis| with_axis(&line, axis));
    let line = signs_in_words(&line, asked).unwrap_or(line);
    let line = moment_first(&line, asked).unwrap_or(line);
    let words: Vec<&str> = line.split(' ').collect();
    let sign = |word: &str| word.ends_with(['=', '+', '-', '−', '≈', ':', ',']);
    let mut out: Vec<String> = Vec::new();
    let mut at = 0;
    while let Some(word) = words.get(at) {
        let first = out.last().is_none_or(|w| sign(w) || is_word(w));
        let which = Some(&words[at + 1..]).filter(|_| first && (is_letters(word) || asked(word)));
        match which.and_then(which_value) {
            Some((which, used)) if which.starts_with("after") && asked(word) => {
                out.push(format!("{word}{}", &which["after".len()..]));
                at += used;
            }
            Some((which, used)) => {
                out.push(format!("{word}_{which}"));
                at += used;
            }
            None => out.push(word.to_string()),
        }
        at += 1;
    }
    let mut line = out.join(" ");
    for verb in VERBS {
        if let Some((left, right)) = line.split_once(verb) {
            let name = left.rsplit(' ').next().unwrap_or_default();
            let name = name.trim_start_matches('$');
            if asked(name) || verb != " is " && is_letters(name) {
                line = format!("{left} = {right}");
            }
        }
    }
    line
}

/// An index that goes on behind a comma with an axis, `v_B,x`, in braces.
fn with_axis(line: &str, axis: &str) -> String {
    let comma = format!(",{axis}");
    let mut pieces = line.split(&comma);
    let mut out = pieces.next().unwrap_or_default().to_string();
    for piece in pieces {
        let index = out.rfind('_').filter(|at| {
            let index = &out[at + 1..];
            !index.is_empty() && index.chars().all(char::is_alphanumeric)
        });
        match index.filter(|_| !piece.starts_with(|c: char| c.is_alphanumeric() || c == '_')) {
            Some(at) => out = format!("{}_{{{},{axis}}}", &out[..at], &out[at + 1..]),
            None => out.push_str(&comma),
        }
        out.push_str(piece);
    }
    out
}

/// `v = √(2gh) just before the hit` as what the name `v_before` is where v is asked of another moment; without the words else.
fn moment_first(line: &str, asked: &dyn Fn(&str) -> bool) -> Option<String> {
    let sides = [" before", " after"].into_iter();
    let (said, side) = sides
        .filter_map(|s| Some((&line[..line.rfind(s)?], s)))
        .max()?;
    let behind = line[said.len() + side.len()..].trim_end_matches(['.', ',']);
    let words = behind.split(' ').skip(1);
    let few = behind.is_empty() || behind.starts_with(' ') && words.clone().count() < 4;
    let (name, _) = said
        .split_once('=')
        .filter(|_| few && words.clone().all(is_word))?;
    let said = [" just", " immediately", " right"]
        .iter()
        .find_map(|word| said.strip_suffix(word))
        .unwrap_or(said);
    let name = name.trim();
    Some(match side == " before" && asked(name) {
        true => said.replacen(name, &format!("{name}_before"), 1),
        false => said.to_string(),
    })
}

/// Which value words behind a name speak of, and how many words that takes: `just after the hit`.
fn which_value<'t>(words: &[&'t str]) -> Option<(&'t str, usize)> {
    let mut at = usize::from(["just", "right", "immediately"].contains(words.first()?));
    let plain = |word: &&str| word.trim_end_matches([':', ',', '.']).len();
    let which = *words
        .get(at)
        .filter(|word| WHICH.contains(&&word[..plain(word)]))?;
    at += 1;
    if plain(&which) < which.len() {
        return Some((which, at));
    }
    if words.get(at) == Some(&"the") {
        at += 1 + usize::from(words.get(at + 1).is_some_and(|word| is_word(word)));
    }
    let ends = |next: &str| {
        next.starts_with(['=', '+', '-', '−', '≈', ':', ',']) || ["is", "equals"].contains(&next)
    };
    let end = words.get(at).is_none_or(|next| ends(next));
    end.then_some((which, at))
}

/// Whether a word is one or two letters as they stand for a quantity, maybe with an index.
fn is_letters(word: &str) -> bool {
    const WORDS: [&str; 12] = [
        "a", "as", "at", "by", "if", "in", "is", "it", "of", "so", "to", "we",
    ];
    let base = word.split('_').next().unwrap_or_default();
    let plain = word.chars().all(|c| c.is_alphanumeric() || c == '_');
    let letters = base.chars().filter(|c| c.is_alphabetic()).count();
    plain && (1..3).contains(&letters) && !WORDS.contains(&word)
}
