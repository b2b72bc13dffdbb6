//! Words around a formula: finds the one formula in dollars or LaTeX brackets inside a sentence.
//!
//! Deliberately timid: it finds nothing where two formulas stand in the sentence, or where what stands outside could
//! belong to the formula.

/// The ASCII characters of a text as bits; the first bit stands for all others, the second for those that Unicode has arrows
/// and signs of relations among. Nearly all texts are a formula and nothing else, which one look at each character tells.
#[derive(Clone, Copy)]
pub(super) struct Held(u128);

impl Held {
    pub(super) fn of(text: &str) -> Held {
        let bit = |b: u8| match b {
            // The first byte of U+2000 to U+2FFF.
            0xe2 => 0b11,
            b if b.is_ascii() => 1u128 << b,
            _ => 1,
        };
        Held(text.bytes().fold(0, |bits, b| bits | bit(b)))
    }

    /// Whether one of these occurs; `\x01` asks for anything that could be an arrow.
    pub(super) fn any(self, characters: &str) -> bool {
        self.0 & Held::of(characters).0 != 0
    }

    /// Whether all of these occur.
    pub(super) fn all(self, characters: &str) -> bool {
        let asked = Held::of(characters).0;
        self.0 & asked == asked
    }

    /// Whether there could be a word that joins two values, or a comma.
    pub(super) fn joins(self) -> bool {
        self.any(",") || self.all("or") || self.all("and")
    }

    /// Whether there could be words or an arrow before the last statement.
    fn leads_on(self) -> bool {
        self.any("\\>,:=\x01") || self.all("is ")
    }
}

/// An interval that something lies in: where its name and its ends stand, from the first byte of each to the one behind it.
pub(super) struct Interval {
    pub name: [usize; 2],
    /// Nothing where there is no end on that side.
    pub low: Option<[usize; 2]>,
    pub high: Option<[usize; 2]>,
    /// Whether each end is left out.
    pub open: [bool; 2],
}

impl Interval {
    /// The same in a text before which so many bytes stand.
    pub(super) fn map_bytes(self, before: usize) -> Interval {
        let moved = |[from, to]: [usize; 2]| [from + before, to + before];
        Interval {
            name: moved(self.name),
            low: self.low.map(moved),
            high: self.high.map(moved),
            open: self.open,
        }
    }
}

/// `x ∈ [2, 3)`: a name, a sign of membership, and two ends in brackets.
pub(super) fn interval(text: &str) -> Option<Interval> {
    let signs = ["∈", "\\in ", "\\in\\", "\\in(", "\\in[", " in "];
    let found = signs
        .iter()
        .find_map(|sign| Some((text.find(sign)?, *sign)));
    let (at, sign) = found?;
    // What opens the interval stands behind the word.
    let behind = at + sign.trim_end_matches(['\\', '(', '[']).len();
    let rest = text[behind..].trim_start();
    let rest = rest.strip_prefix("\\left").unwrap_or(rest);
    let opened = rest.strip_prefix(['(', '[', ']'])?;
    let from = text.len() - opened.len();
    let closed = text.trim_end();
    let inside = closed.strip_suffix([')', ']', '['])?;
    let to = inside.strip_suffix("\\right").unwrap_or(inside).len();
    let ends = text.get(from..to)?;
    let comma = ends.find([',', ';'])?;
    if ends[comma + 1..].contains([',', ';']) || ends.contains(['{', '}']) && !ends.contains('\\') {
        return None;
    }
    let bounded = |[from, to]: [usize; 2]| {
        let end = text[from..to].trim().trim_start_matches(['+', '-', '−']);
        !matches!(end.trim(), "∞" | "\\infty" | "inf" | "oo")
    };
    let [low, high] = [[from, from + comma], [from + comma + 1, to]];
    Some(Interval {
        name: [0, at],
        low: Some(low).filter(|end| bounded(*end)),
        high: Some(high).filter(|end| bounded(*end)),
        open: [
            text[..from].ends_with(['(', ']']),
            closed.ends_with([')', '[']),
        ],
    })
}

/// `{2, 3}` and `x ∈ {2, 3}` with blanks for the braces and an equals sign for that of membership, byte for byte; nothing
/// where the text is no set.
pub(super) fn without_braces(text: &str) -> Option<String> {
    let (open, close) = (text.find('{')?, text.rfind('}')?);
    let inside = text.get(open + 1..close)?;
    if inside.contains(['{', '}']) || !text[close + 1..].trim().is_empty() {
        return None;
    }
    let escaped = inside.ends_with('\\');
    let before = match (text[..open].strip_suffix('\\'), escaped) {
        (Some(before), true) => before,
        (None, false) => &text[..open],
        _ => return None,
    };
    let inside = &inside[..inside.len() - usize::from(escaped)];
    let named = before.trim_end();
    let name = ["∈", "\\in", " in"]
        .iter()
        .find_map(|sign| named.strip_suffix(sign));
    let start = match name {
        Some(name) => format!("{name}{:<1$}", "=", open - name.len() + 1),
        None if named.is_empty() => " ".repeat(open + 1),
        None => return None,
    };
    Some(format!("{start}{inside}"))
}

/// Where one of two values ends and the other begins: `x = 3 or x = -3`, `2, -2`. Nothing where more than two stand there.
/// In a list any comma parts them.
pub(super) fn alternatives(text: &str, list: bool) -> Option<(usize, usize)> {
    const WORDS: [&str; 6] = [
        "\\text{ or }",
        "\\text{or}",
        "\\mathrm{or}",
        " or ",
        "\\text{ and }",
        " and ",
    ];
    let mut found = None;
    let mut depth = 0i32;
    let mut at = 0;
    while let Some(c) = text[at..].chars().next() {
        let word = WORDS.iter().find(|word| text[at..].starts_with(**word));
        let length = match (word, c) {
            (Some(word), _) if depth == 0 => word.len(),
            // Behind a comma a sign begins another value: `3,-3`.
            (None, ',')
                if depth == 0
                    && (list || text[at + 1..].starts_with([' ', '\\', '-', '−', '±'])) =>
            {
                1
            }
            _ => 0,
        };
        if length > 0 {
            if found.is_some() {
                return None;
            }
            found = Some((at, at + length));
            at += length;
            continue;
        }
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            _ => {}
        }
        at += c.len_utf8();
    }
    found
        .filter(|(start, end)| !text[..*start].trim().is_empty() && !text[*end..].trim().is_empty())
}

/// Where the formula starts behind words that say what it is: `the speed of the boy u = 2 g t`, `its speed is 3 m/s`. Nothing
/// where a word could change the value, or where none of them is surely a word: `known` names are none.
pub(super) fn behind_words(text: &str, known: &dyn Fn(&str) -> bool) -> Option<usize> {
    const VERBS: [&str; 4] = ["is", "are", "equals", "becomes"];
    const CHANGING: &str = "above below cosine cube cubed difference double except exceeds half if \
        inverse least less logarithm minus more most negative never no not opposite or over per \
        plus product quarter ratio reverse root sine square squared sum tangent tenth than third \
        thrice triple twice unless without";
    let (mut at, mut words) = (0, Vec::new());
    for piece in text.split_inclusive(' ') {
        let word = piece.trim_end_matches([' ', ',']);
        if !word.bytes().all(|b| b.is_ascii_alphabetic()) || word.is_empty() && piece != " " {
            break;
        }
        if !word.is_empty() {
            words.push((at, word.to_ascii_lowercase()));
        }
        at += piece.len();
    }
    let (start, last) = words.last()?;
    let changing = |(_, word): &(usize, String)| CHANGING.split(' ').any(|w| w == word);
    if words.iter().any(changing) {
        return None;
    }
    let surely = |(_, word): &(usize, String)| word.len() > 2 && !known(word);
    let led = words[..words.len() - 1].iter().any(surely);
    match text[at..].split_once(['=', '≈']) {
        _ if led && VERBS.contains(&&**last) => Some(at),
        Some(("", _)) if led => Some(*start),
        Some((name, _)) if words.iter().any(surely) && !name.trim().contains(' ') => Some(at),
        _ => None,
    }
}

/// The value that goes on from what was asked: `≈ 1.2 m/s`, `= 1.2 m/s`, `about 1.2 m/s`.
pub(super) fn value(text: &str) -> Option<&str> {
    const WORDS: [&str; 7] = [
        "about",
        "approximately",
        "approx.",
        "approx",
        "roughly",
        "circa",
        "ca.",
    ];
    let text = text.trim_start();
    let signed = |sign: &&str| text.strip_prefix(*sign);
    if let Some(behind) = ["≈", "\\approx", "="].iter().find_map(signed) {
        return (!behind.starts_with(['=', '>', '<'])).then_some(behind);
    }
    let said = |word: &&str| {
        let (said, behind) = text.split_at_checked(word.len())?;
        let number = behind.strip_prefix(' ')?.trim_start();
        let is_number = number.starts_with(|c: char| c.is_ascii_digit() || "-−+.".contains(c));
        (said.eq_ignore_ascii_case(word) && is_number).then_some(behind)
    };
    WORDS.iter().find_map(said)
}

/// Where the last of several statements starts that follow from each other: `mgh = ½mv² ⟹ v = √(2gh)`; also behind a word
/// such as `Therefore,`.
pub(super) fn conclusion(text: &str, held: Held) -> Option<usize> {
    const ARROWS: [&str; 11] = [
        "\\implies",
        "\\Longrightarrow",
        "\\Rightarrow",
        "\\therefore",
        "\\Leftrightarrow",
        "\\iff",
        "⟹",
        "⇒",
        "∴",
        "⟺",
        "⇔",
    ];
    const WORDS: [&str; 15] = [
        "the final answer is",
        "the answer is",
        "the solution is",
        "the result is",
        "we get",
        "final answer",
        "therefore",
        "hence",
        "thus",
        "so",
        "then",
        "finally",
        "consequently",
        "answer",
        "it follows that",
    ];
    if !held.leads_on() {
        return None;
    }
    // Where nothing stands before it an arrow leads on from the question.
    if let Some(behind) = ["=>", "->", "→", "\\to", "\\rightarrow"]
        .iter()
        .find_map(|arrow| text.trim_start().strip_prefix(arrow))
        && !behind.starts_with(|c: char| c.is_ascii_alphabetic())
    {
        return Some(text.len() - behind.len());
    }
    let arrow = match held.any("\\\x01") {
        true => ARROWS
            .iter()
            .filter_map(|arrow| text.rfind(arrow).map(|at| at + arrow.len()))
            .max()
            .filter(|at| !text[*at..].trim().is_empty()),
        false => None,
    };
    let arrow = arrow.or_else(|| said_between(text));
    let arrow = arrow.or_else(|| last_line(text));
    if arrow.is_none() && !text.contains([',', ':', '=']) && !text.contains(" is ") {
        return None;
    }
    let from = arrow.unwrap_or(0);
    // `**Answer:** …` in Markdown.
    let bold = text[from..].trim_start().starts_with("**");
    let rest = text[from..].trim_start_matches(|c: char| c.is_whitespace() || bold && c == '*');
    let start = text.len() - rest.len();
    // `\text{so } t = …`, `\text{The velocity is } …`
    if let Some((said, behind)) = rest.strip_prefix("\\text{").and_then(|r| r.split_once('}')) {
        let said = said.trim().trim_end_matches([',', ':']);
        if said.ends_with(" is") || WORDS.iter().any(|word| word.eq_ignore_ascii_case(said)) {
            return Some(text.len() - behind.len());
        }
    }
    let word = WORDS.iter().find_map(|word| {
        let (said, behind) = rest.split_at_checked(word.len())?;
        said.eq_ignore_ascii_case(word).then_some(())?;
        let mark = behind.starts_with([',', ':']);
        // `so x = …`, where a name alone stands before the sign.
        let named = || {
            let name = behind.split('=').next().unwrap_or_default().trim();
            !name.is_empty() && !name.contains(' ')
        };
        let short = matches!(*word, "so" | "then");
        let gap = mark || (behind.starts_with(' ') && (!short || named()));
        let said = behind.contains('=') || word.ends_with(" is");
        let stars = 2 * usize::from(bold && behind[usize::from(mark)..].starts_with("**"));
        (gap && said || mark).then_some(word.len() + usize::from(mark) + stars)
    });
    match (arrow, word) {
        (None, None) => None,
        (_, Some(length)) => Some(start + length),
        (Some(_), None) => Some(start),
    }
}

/// Where a relation starts that a word or an arrow ties to the one before it: `½mv² = mgh so v = √(2gh)`.
fn said_between(text: &str) -> Option<usize> {
    const WORDS: [&str; 9] = [
        " so ",
        " hence ",
        " thus ",
        " therefore ",
        " gives ",
        " yields ",
        " and so ",
        "=>",
        "->",
    ];
    if text.matches(RELATIONS).count() < 2 {
        return None;
    }
    let found = WORDS
        .iter()
        .filter_map(|word| text.rfind(word).map(|at| (at, at + word.len())));
    let (start, end) = found.max_by_key(|(_, end)| *end)?;
    (text[..start].contains(RELATIONS) && text[end..].contains(RELATIONS)).then_some(end)
}

/// Signs between two sides.
const RELATIONS: [char; 5] = ['=', '<', '>', '≤', '≥'];

/// Where the last of several lines starts, when it says what a name is that stands in the line before as well.
fn last_line(text: &str) -> Option<usize> {
    let (before, last) = text.trim_end().rsplit_once('\n')?;
    let line = before.trim_end().rsplit('\n').next()?;
    let name = last.split('=').next().map(str::trim)?;
    let named = !name.is_empty() && !name.contains(|c: char| " +-*/()^".contains(c));
    (named && last.contains('=') && line.contains('=') && line.contains(name))
        .then_some(before.len() + 1)
}

/// Start and end of the only formula in a sentence; nothing where there are none or several, or no words around it.
pub(super) fn formula_in_words(text: &str) -> Option<(usize, usize)> {
    if !text.contains(['$', '\\']) {
        return None;
    }
    let (from, to, start, end) = [("$$", "$$"), ("$", "$"), ("\\(", "\\)"), ("\\[", "\\]")]
        .into_iter()
        .find_map(|(open, close)| {
            let from = text.find(open)?;
            let start = from + open.len();
            let end = start + text[start..].find(close)?;
            Some((from, end + close.len(), start, end))
        })?;
    let (before, behind) = (&text[..from], &text[to..]);
    let foreign = |c: char| c.is_ascii_digit() || "$\\=+*/^_<>()[]{}|".contains(c);
    let words = |t: &str| {
        t.split(|c: char| !c.is_alphabetic())
            .any(|word| word.len() > 2)
    };
    let prose = words(before) || words(behind);
    let several = before.contains(foreign) || behind.contains(foreign);
    // `$5$ m/s` and `$5$ meters` carry a unit outside.
    let unit =
        crate::dimension::unit(behind.trim().trim_end_matches('.')).is_ok_and(|_| words(behind));
    (prose && !several && !unit && !text[start..end].trim().is_empty()).then_some((start, end))
}
