//! Words around a formula: finds the one formula in dollars or LaTeX brackets inside a sentence.
//!
//! Deliberately timid: it finds nothing where two formulas stand in the sentence, or where what stands outside could
//! belong to the formula.

use super::fault::{Fault, Faulty};
use crate::expr::only;

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
        self.any(",;") || self.all("or") || self.all("and")
    }

    /// Whether there could be words or an arrow before the last statement.
    fn leads_on(self) -> bool {
        self.any("\\>,:=\x01") || self.all("is ")
    }
}

/// Whether a word could change the value of what it stands beside.
pub(crate) fn changes(word: &str) -> bool {
    const CHANGING: &str = "above anything below but cannot complement cosine cotangent cube cubed decreased denied difference \
        divided double doubled doubt except exceeds false fifth fourth fraction half halved hardly if impossible incorrect \
        incorrectly increased instead inverse least less log logarithm minus mistaken more most multiplied negative neither \
        never no nobody none nor not nothing opposite or over per percent plus product proportional quarter quotient rather \
        ratio reciprocal reduced reverse reversed root sine square squared sum tangent tenth than third thirds thrice times \
        triple twice unless unlike untrue unlikely versus vs without wrong wrongly";
    CHANGING.split(' ').any(|w| word.eq_ignore_ascii_case(w))
        || word.ends_with("n't")
        || word.ends_with("n’t")
}

/// Words that lead to a formula.
const LEADS: &str = "is are was be becomes became equals gives give gave get got gets obtain obtains obtained find finds found \
    yields yield have hence thus so then therefore finally namely follows answer solution result";
/// Words that say what a formula is or where it holds.
const PLAIN: &str = "a after an and angular answer asked at ball before block bodies body both by center centre collision \
    correct desired disk energy final finally for here his hit i immediately impact impulse in is it its just kinetic loss \
    mass momentum my now of our qed required result rod sought solution speed spin stick that the their thus value \
    velocities velocity wanted we which with afterward afterwards as because independent motion move moves moving since \
    speeds this together travel travels us when where";

/// Whether a word is one of a list with blanks between.
pub(crate) fn is_in(list: &str, word: &str) -> bool {
    list.split(' ')
        .any(|known| word.eq_ignore_ascii_case(known))
}

/// Whether a word leads to the formula behind it.
pub(super) fn leads(word: &str) -> bool {
    is_in(LEADS, word)
}

/// Whether a word behind a formula begins what changes nothing of it.
pub(super) fn goes_on(word: &str) -> bool {
    is_in(PLAIN, word) && word != "of"
}

/// Whether words before and behind a formula say no more than that it is what was asked: `Solving gives`, `is the answer`.
/// None changes a value; before it a verb, a colon or a plain word leads to it, behind it a plain word begins: what no list
/// knows could change the value it stands next to, but for that of an equation, which says itself what it is about.
fn lead_to_it(before: &str, formula: &str, behind: &str) -> bool {
    const ADVERBS: &str =
        "about again approximately exactly indeed just now simply then therefore thus";
    const THAT: &str = "conclude concludes conclusion find finds follows implies see show shows";
    const TO: &str = "equal equals simplifies reduces leads comes evaluates amounts";
    let words = |text: &str| -> Vec<String> {
        let parts = text.split(|c: char| !c.is_alphabetic() && !"'’".contains(c));
        let parts = parts.filter(|word| !word.is_empty());
        parts.map(str::to_lowercase).collect()
    };
    let (mut said, more) = (words(before), words(behind));
    let unchanged = !said.iter().chain(&more).any(|word| changes(word));
    while said.last().is_some_and(|word| is_in(ADVERBS, word)) {
        said.pop();
    }
    let led = match said.as_slice() {
        [.., verb, to] if to == "to" => is_in(TO, verb),
        [.., given, by] if by == "by" => given == "given",
        [.., find, that] if that == "that" => is_in(THAT, find),
        [.., speed, of] if of == "of" => is_in(PLAIN, speed),
        [.., last] => is_in(LEADS, last) || is_in(PLAIN, last) || before.trim_end().ends_with(':'),
        [] => true,
    };
    let goes_on = || more.first().is_none_or(|word| goes_on(word));
    unchanged && (formula.contains('=') || led && goes_on())
}

/// Where the formula starts behind words that say what it is: `the speed of the boy u = 2 g t`, `its speed is 3 m/s`. Nothing
/// where a word could change the value, or where none of them is surely a word: `known` names are none.
pub(super) fn behind_words(text: &str, known: &dyn Fn(&str) -> bool) -> Option<usize> {
    const VERBS: [&str; 5] = ["is", "are", "be", "equals", "becomes"];
    let (mut at, mut words) = (0, Vec::new());
    for piece in text.split_inclusive(' ') {
        let word = piece.trim_end_matches([' ', ',']);
        let last = at + piece.len() == text.len();
        let number = last && word.trim_end_matches('.').eq_ignore_ascii_case("zero");
        let letters = word.bytes().all(|b| b.is_ascii_alphabetic());
        if number || !letters || word.is_empty() && piece != " " {
            break;
        }
        if !word.is_empty() {
            words.push((at, word));
        }
        at += piece.len();
    }
    let (start, last) = words.last()?;
    if words.iter().any(|(_, word)| changes(word)) {
        return None;
    }
    // `a with b = 2` says of b what it is, and is asked for a.
    let beside = words.len().checked_sub(2).map_or("", |i| words[i].1);
    let first = words[0].1;
    let article = is_in("a i", first) && words.get(1).is_some_and(|(_, w)| !is_in(BETWEEN, w));
    let formula = first.len() == 1 && !article || known(first);
    let condition =
        is_in(BETWEEN, beside) && !leads(beside) && !is_in("all both that which", beside);
    if words.len() > 2 && formula && condition {
        return None;
    }
    let surely = |(_, word): &(usize, &str)| word.len() > 2 && !known(word);
    let led = words[..words.len() - 1].iter().any(surely);
    let names = words.iter().rev().take_while(|(_, word)| known(word));
    match text[at..].split_once(['=', '≈']) {
        _ if led && VERBS.iter().any(|verb| last.eq_ignore_ascii_case(verb)) => Some(at),
        // `so M V = …` begins with the product.
        Some(("", _)) if led => Some(names.last().map_or(*start, |(start, _)| *start)),
        // `we get m v l cosθ/2 = …`: a product begins with the names at the end.
        Some((name, _)) if words.iter().any(surely) => match names.last() {
            Some((start, _)) => Some(*start),
            None => (!name.trim().contains(' ')).then_some(at),
        },
        _ => None,
    }
}

/// Where values begin behind words that lead to them: `The solutions are 1 and -4`, `Hence x = 1 or x = 2`.
pub(super) fn lead_to_values(text: &str, known: &dyn Fn(&str) -> bool) -> Option<usize> {
    const VALUES: &str = "answers at masses roots solutions times values";
    let (mut at, mut led) = (0, None);
    for piece in text.split_inclusive(' ') {
        let word = piece.trim_end_matches([' ', ',', ':']);
        let plain = is_in(VALUES, word) || is_in(LEADS, word) || is_in(PLAIN, word);
        if word.len() < 2 || !plain || known(word) || word.eq_ignore_ascii_case("and") {
            break;
        }
        at += piece.len();
        let leads = leads(word) || word.eq_ignore_ascii_case("at") || piece.contains(':');
        led = leads.then_some(at);
    }
    led
}

/// A ratio of two numbers, `5:2`, `5 to 2` and `m_1:m_2 = 1:3`, with a slash for its colon and nothing moved; nothing where a
/// colon stands for anything else.
pub(super) fn ratio(text: &str) -> Option<String> {
    let text = text.replace(" to ", "  : ");
    let inner = text.trim().trim_matches('$');
    let parts = |side: &str| {
        let (a, b) = side.split_once(':')?;
        Some([a, b].map(|part| part.trim().to_string()))
    };
    let number = |part: &String| {
        part.parse::<f64>()
            .is_ok_and(|_| !part.contains(['e', 'E', 'n']))
    };
    let name = |part: &String| {
        part.starts_with(char::is_alphabetic)
            && part
                .chars()
                .all(|c| c.is_alphanumeric() || "_{}".contains(c))
    };
    let mut sides = inner.split('=').rev();
    // The last side has numbers; those before may have names, or no colon.
    let last = parts(sides.next()?)?.iter().all(number);
    let plain = sides
        .all(|side| !side.contains(':') || parts(side).is_some_and(|parts| parts.iter().all(name)));
    (last && plain).then(|| text.replace(':', "/"))
}

/// The value that goes on from what was asked: `≈ 1.2 m/s`, `= 1.2 m/s`, `about 1.2 m/s`.
pub(super) fn value(text: &str) -> Option<&str> {
    const WORDS: &str = "about approximately approx. approx roughly circa ca.";
    let text = text.trim_start();
    let signed = |sign: &&str| text.strip_prefix(*sign);
    if let Some(behind) = ["≈", "\\approx", "\\simeq", "\\sim", "="]
        .iter()
        .find_map(signed)
    {
        return (!behind.starts_with(['=', '>', '<'])).then_some(behind);
    }
    // A value, and no further word.
    let is_value = |text: &str| {
        let first = text.trim_start().split(' ').next().unwrap_or_default();
        let letters = first.chars().all(char::is_alphabetic);
        !first.is_empty() && (!letters || first.chars().count() == 1)
    };
    // `\text{about } 5`
    let framed = text.strip_prefix("\\text{").and_then(|r| r.split_once('}'));
    if let Some((said, behind)) = framed {
        let said = said.trim();
        let known = is_in(WORDS, said);
        return (known && is_value(behind)).then_some(behind);
    }
    let said = |word: &str| {
        let (said, behind) = text.split_at_checked(word.len())?;
        let number = behind.strip_prefix(' ').is_some_and(is_value);
        (said.eq_ignore_ascii_case(word) && number).then_some(behind)
    };
    WORDS.split(' ').find_map(said)
}

/// Where the words begin behind a formula that let a letter of it be any whole number: `with n an integer`, `, n ∈ ℤ`.
pub(super) fn without_count(text: &str) -> Option<usize> {
    const SETS: [&str; 5] = ["\\in\\mathbb{Z}", "\\in\\mathbbZ", "\\in\\Z", "∈ℤ", "∈Z"];
    const WORDS: &str = "a all an any arbitrary every for integer integers is where with";
    let is_said = ["integer", "Z", "ℤ"].iter().any(|set| text.contains(set));
    let end = text.trim_end_matches([' ', '.', ')', '$']).len();
    let plain = |c: char| c.is_ascii_alphabetic() || " ,$\\{}∈ℤ(".contains(c);
    let from = text[..end].rfind([',', ';', '(']).filter(|_| is_said);
    let from = from.or_else(|| {
        let said = [" with ", " for ", " where "].into_iter();
        said.filter(|_| is_said)
            .filter_map(|word| text.rfind(word))
            .max()
    })?;
    let clause = text[from..end].trim_start_matches([',', ';', '(', ' ']);
    let clause = clause
        .replace(['$'], "")
        .replace("\\quad", " ")
        .replace("\\text", " ");
    let mut words: Vec<&str> = clause
        .split([' ', '{', '}'])
        .filter(|w| !w.is_empty())
        .collect();
    let joined = words.concat();
    let in_set = SETS
        .iter()
        .find_map(|set| joined.strip_suffix(&set.replace(['{', '}'], "")));
    let said = words.iter().any(|word| word.starts_with("integer"));
    words.retain(|word| !WORDS.split(' ').any(|known| known == *word));
    let count = match (in_set, words.as_slice()) {
        (Some(count), _) => count,
        (None, [count]) if said => count,
        _ => return None,
    };
    let letter = count.len() == 1 && count.starts_with(|c: char| c.is_ascii_alphabetic());
    let before = text[..from].trim_end();
    (letter && clause.chars().all(plain) && before.contains(count)).then_some(before.len())
}

/// Where the last of several statements starts that follow from each other: `mgh = ½mv² ⟹ v = √(2gh)`; also behind a word
/// such as `Therefore,`.
pub(super) fn conclusion(text: &str, held: Held) -> Option<usize> {
    const ARROWS: &str =
        "\\implies|\\Longrightarrow|\\Rightarrow|\\therefore|\\Leftrightarrow|\\iff|⟹|⇒|∴|⟺|⇔";
    const WORDS: &str = "the final answer is|the answer is|the solution is|the result is|we get|final answer|\
        therefore|hence|thus|so|then|finally|consequently|answer|it follows that";
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
            .split('|')
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
        let plain = !said.split(' ').any(changes);
        if plain && said.ends_with(" is")
            || WORDS.split('|').any(|word| word.eq_ignore_ascii_case(said))
        {
            return Some(text.len() - behind.len());
        }
    }
    let word = WORDS.split('|').find_map(|word| {
        let (said, behind) = rest.split_at_checked(word.len())?;
        said.eq_ignore_ascii_case(word).then_some(())?;
        let mark = behind.starts_with([',', ':']);
        // `so x = …`, where a name alone stands before the sign.
        let named = || {
            let name = behind.split('=').next().unwrap_or_default().trim();
            !name.is_empty() && !name.contains(' ')
        };
        let short = matches!(word, "so" | "then");
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
    const WORDS: &str = " so | hence | thus | therefore | gives | yields | and so | we get | we find | we obtain |=>|->";
    if text.matches(RELATIONS).count() < 2 {
        return None;
    }
    let found = WORDS
        .split('|')
        .filter_map(|word| text.rfind(word).map(|at| (at, at + word.len())));
    let (start, end) = found.max_by_key(|(_, end)| *end)?;
    (text[..start].contains(RELATIONS) && text[end..].contains(RELATIONS)).then_some(end)
}

/// Where a word begins a condition behind a relation, and its length with the blanks around it: `x = 5 since x > 0`.
pub(super) fn conditional(text: &str) -> Option<(usize, usize)> {
    const WORDS: [&str; 5] = [" as ", " since ", " if ", " for ", " because "];
    let place = |word: &&str| Some((text.find(*word)?, word.len()));
    let (at, length) = WORDS.iter().find_map(place)?;
    let relates = text[..at].contains(RELATIONS) && text[at + length..].contains(RELATIONS);
    relates.then_some((at, length))
}

/// Words of prose between formulas that could be products of their letters.
const BETWEEN: &str = "after also are as assuming at because before but by does each either else except for from given hence if \
    is let near nor not of off on out over set since so than that the then thus unless unlike until upon using versus vs was \
    were when whenever where which while with without all any both no yes aus auf bei bis dann durch für ist mit nach nicht \
    oder ohne sind sonst statt und von vor weil wenn wobei zu zum avec dans donc et ou où par pas pour sans sur";

/// The first word of prose that stands between two formulas inside a text.
pub(super) fn word_inside(
    text: &str,
    [from, to]: [usize; 2],
    known: &dyn Fn(&str) -> bool,
) -> Option<(usize, usize)> {
    let blank = |c: char| c.is_whitespace() || "$,".contains(c);
    let mut end = from;
    for piece in text.get(from..to)?.split_inclusive(char::is_whitespace) {
        let at = end;
        end += piece.len();
        let word = piece.trim_end_matches(blank);
        if word.chars().count() < 2 || !is_in(BETWEEN, &word.to_lowercase()) || known(word) {
            continue;
        }
        let (before, behind) = (&text[from..at], &text[at + word.len()..to]);
        let before_it = before.trim_end_matches(blank).chars().next_back();
        let behind_it = behind.trim_start_matches(blank).chars().next();
        let ends = |c: char| c.is_alphanumeric() || ")]}'′|°%!∞".contains(c);
        let begins = |c: char| c.is_alphanumeric() || "([{\\|√Δ∫∞".contains(c);
        let index = before
            .rfind("_{")
            .is_some_and(|open| !before[open..].contains('}'));
        if before.ends_with(blank)
            && before_it.is_some_and(ends)
            && behind_it.is_some_and(begins)
            && !index
        {
            return Some((at, at + word.len()));
        }
    }
    None
}

/// An answer beside a condition that a word begins, the name and the value of that, and where the answer stands: `v = 3 m/s at
/// t = 2 s`, `v = 3 m/s (when e = 1)`, `if m = 2 kg then v = 3 m/s`.
pub(crate) fn beside_condition(text: &str) -> Option<([&str; 3], [usize; 2])> {
    const WORDS: &str = "after at bei for für given if mit nach since using wenn when where with";
    let word = |at: usize| text[at..].split(' ').next().unwrap_or_default();
    let begins =
        |at: &usize| is_in(WORDS, word(*at)) && text[at + word(*at).len()..].starts_with(' ');
    let behind = text.match_indices([' ', '(']).map(|(at, _)| at + 1);
    let at = only(std::iter::once(0).chain(behind).filter(begins))?;
    let clause = at + word(at).len();
    let (range, clause) = match text[..at].trim().is_empty() {
        false => {
            let before = text[..at].trim_end_matches([' ', ',', '(']);
            let dress: &[char] = if text[..at].ends_with('(') {
                &[' ', '.', ')']
            } else {
                &[]
            };
            ([0, before.len()], text[clause..].trim_end_matches(dress))
        }
        // What follows then says by itself what it is about.
        true => {
            let joins = [", then ", " then ", ","].into_iter();
            let (joint, length) = joins
                .filter_map(|joint| Some((clause + text[clause..].find(joint)?, joint.len())))
                .find(|(joint, length)| text[joint + length..].contains('='))?;
            ([joint + length, text.len()], &text[clause..joint])
        }
    };
    let (name, value) = clause.split_once('=')?;
    let dress = |c: char| c.is_whitespace() || "$.".contains(c);
    let [name, value] = [name, value].map(|part| part.trim_matches(dress));
    let plain = |c: char| c.is_alphanumeric() || "_{}'\\".contains(c);
    let several =
        value.contains(RELATIONS) || value.contains([',', ';', ':']) || value.contains(" and ");
    let is_one = !several && !text.contains("\\boxed");
    let answer = &text[range[0]..range[1]];
    (is_one && !name.is_empty() && name.chars().all(plain))
        .then_some(([answer, name, value], range))
}

/// The last of several statements that follow from each other.
pub(crate) fn concluded(text: &str) -> &str {
    &text[conclusion(text, Held::of(text)).unwrap_or(0)..]
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

/// Whether a clause only says what names are: `, where $m$ is the mass.`
fn says_names(clause: &str) -> bool {
    let said = clause.trim_start_matches([',', ' ']);
    let foreign = |c: char| c.is_ascii_digit() || "=+*/^<>≤≥()[]|".contains(c);
    let mut words = said.split(|c: char| !c.is_alphabetic());
    ["where ", "with "]
        .iter()
        .any(|lead| said.starts_with(lead))
        && [" is ", " are ", " being ", " denotes "]
            .iter()
            .any(|verb| said.contains(verb))
        && !said.contains(foreign)
        && !words.any(changes)
}

/// Start and end of the only formula in a sentence; nothing where there are none or several, or no words around it, and a fault
/// where these could change what it says.
pub(super) fn formula_in_words(text: &str) -> Option<Faulty<(usize, usize)>> {
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
    // `(independent of the mass)` is said beside it.
    let aside = behind.trim().trim_end_matches('.').strip_prefix('(');
    let aside = aside.and_then(|words| words.strip_suffix(')'));
    let behind = aside
        .filter(|words| !words.contains(foreign))
        .unwrap_or(behind);
    let words = |t: &str| {
        t.split(|c: char| !c.is_alphabetic())
            .any(|word| word.len() > 2)
    };
    let prose = words(before) || words(behind);
    let behind = match says_names(behind) {
        true => "",
        false => behind,
    };
    let several = before.contains(foreign) || behind.contains(foreign);
    // `$5$ m/s` and `$5$ meters` carry a unit outside.
    let unit =
        crate::dimension::unit(behind.trim().trim_end_matches('.')).is_ok_and(|_| words(behind));
    if !prose || several || unit || text[start..end].trim().is_empty() {
        return None;
    }
    if lead_to_it(before, &text[start..end], behind) {
        return Some(Ok((start, end)));
    }
    let fault = Fault::new(
        "words beside the formula could change what it says",
        0,
        text.len(),
    );
    Some(Err(fault.hint("give the formula alone")))
}
