//! The equations in a line as students write them, with words and arrows around them.

use super::super::read;
use crate::formula::{self, Fault, among, changes, is_in};

/// Signs that relate two sides.
const SIGNS: [char; 5] = ['<', '>', '≤', '≥', '≈'];

/// Words and arrows before an equation.
const LEADS: &str = "=>|⇒|⟹|∴|→|->|\\Rightarrow|\\implies|\\therefore|therefore|hence|thus|so|then|with|\
     and|where|gives|which gives|this gives|we get|we find|we have|it follows that|that is|i.e.|since|because|\
     as|from|let";

/// What stands between two equations of one line.
pub(super) const BETWEEN: &str = "<=>|⇔|⟺|\\Leftrightarrow|\\iff|=>|⇒|⟹|∴|\\Rightarrow|\\implies|\\therefore|\
    →|->|; |, | so | hence | thus | therefore | we get | where | with | and |: ";

/// Which of these words lead from a sentence to what follows from it: `G is l/2 away, so I = m l^2/3`.
const CONCLUDING: [&str; 5] = [" so ", " hence ", " thus ", " therefore ", " we get "];

/// Words behind an equation that tell the moment it speaks of.
const MOMENTS: &str = "(just before)|(just after)|(before)|(after)|just before|just after";

/// First words of a remark in brackets behind an equation, which are never names.
const REMARKS: &str = "after along angular anticlockwise as because before by clockwise conservation counterclockwise definition down \
    downward downwards due energy from geometry hinge horizontal horizontally immediately in just kinematics leftward leftwards linear momentum \
    newton no parallel perpendicular relative restitution rightward rightwards rolling since symmetry to towards up upward upwards using vertical vertically";

/// Words of a description that stands in place of a name left of an equality sign: `kinetic energy before = …`.
const DESCRIBING: &str = "angular change energy force impulse kinetic loss lost momentum potential rotational speed total \
    velocity work";

pub(super) fn relates(text: &str) -> bool {
    text.contains('=') || text.contains(SIGNS) || text.contains("\\le") || text.contains("\\ge")
}

/// The equations of a line one by one, without the words before, between and behind them: `AMB about C: …`, `so …`,
/// `… => …`, `…, where I = …`.
pub(super) fn equations(text: &str) -> Vec<&str> {
    let lower = text.to_ascii_lowercase();
    let asides = ASIDES.split('|').filter_map(|words| lower.find(words));
    let aside = asides.filter(|at| ends_sentence(&text[..*at])).min();
    let text = &text[..aside.unwrap_or(text.len())];
    if let Some(formulas) = in_dollars(text) {
        return formulas;
    }
    let mut out = Vec::new();
    let (mut start, mut at, mut depth) = (0, 0, 0i32);
    while at < text.len() {
        let rest = &text[at..];
        let sign = (depth == 0).then(|| BETWEEN.split('|').find(|sign| rest.starts_with(sign)));
        match sign.flatten() {
            // A comma may part components, and an arrow may begin the line: equations stand on both sides.
            Some(sign) if relates(&text[start..at]) && parts(sign, &rest[sign.len()..]) => {
                out.push(equation(&text[start..at]));
                at += sign.len();
                start = at;
            }
            Some(sign) if CONCLUDING.contains(&sign) && is_prose(&text[start..at]) => {
                at += sign.len();
                start = at;
            }
            // `Energy is conserved. …`
            _ if [". ", "; "].iter().any(|end| rest.starts_with(end))
                && says(&text[start..at], if rest.starts_with('.') { 3 } else { 2 }) =>
            {
                at += 2;
                start = at;
            }
            _ => {
                let c = rest.chars().next().map_or('\0', |c| c);
                depth += i32::from("([{".contains(c)) - i32::from(")]}".contains(c));
                at += c.len_utf8().max(1);
            }
        }
    }
    out.push(equation(&text[start..]));
    out.retain(|part| relates(part));
    out
}

/// First words of what is no step: about a root that is not taken, or under which conditions results hold.
const ASIDES: &str = "discarded:|rejected:|not taken:|not determined:|impossible:|the results hold for|the result holds for|valid for|assumed:";

/// Whether nothing is open before a new sentence.
fn ends_sentence(before: &str) -> bool {
    let before = before.trim_end_matches([' ', '*', '-', '•']);
    before.is_empty() || before.ends_with(['.', ';'])
}

/// The equations of a sentence whose formulas stand between dollar signs, without those behind words that suppose something:
/// `No impulse acts along $x$, so $v_x = u$.`; nothing where a relation stands outside of them.
fn in_dollars(text: &str) -> Option<Vec<&str>> {
    const SUPPOSING: &str = "for at when if until than that normal direction";
    let pieces: Vec<&str> = text.split('$').collect();
    let is_formula = |k: usize| k % 2 == 1;
    let outside = pieces.iter().step_by(2);
    let mut words = outside.clone().flat_map(|piece| piece.split(' '));
    let sentence = pieces.len() % 2 == 1 && pieces.len() > 1 && words.any(is_word);
    if !sentence || outside.clone().any(|piece| relates(piece)) {
        return None;
    }
    let ends_in = |before: &str, words: &str| {
        let last = before.trim_end().rsplit(' ').next().unwrap_or_default();
        is_in(words, last)
    };
    let (mut supposing, mut of_range) = (false, false);
    let formulas = pieces.iter().enumerate().filter_map(|(k, piece)| {
        if !is_formula(k) {
            // `at $e = 1$ and $d = 0$` supposes both; `where $I = m l^2/3$` says what I is, `where $a > b$` supposes.
            let goes_on = ["and", ",", ", and"].contains(&piece.trim());
            supposing = ends_in(piece, SUPPOSING) || supposing && goes_on;
            of_range = ends_in(piece, "where with") || of_range && goes_on;
            return None;
        }
        let supposed = supposing || of_range && !piece.contains('=');
        (relates(piece) && !supposed).then(|| equation(piece))
    });
    Some(formulas.collect())
}

/// Whether a word is made of letters, with those that an apostrophe ties to it: `Newton's`, `d’Alembert's`, but no `v'`.
fn is_letters(word: &str) -> bool {
    let owner = ["'s", "’s"].iter().find_map(|end| word.strip_suffix(end));
    let owner = owner
        .filter(|name| name.chars().count() > 2)
        .unwrap_or(word);
    let name = ["d'", "d’"]
        .iter()
        .find_map(|start| owner.strip_prefix(start));
    name.unwrap_or(owner).chars().all(char::is_alphabetic)
}

pub(super) fn is_word(text: &str) -> bool {
    let function = ["sin", "cos", "tan", "cot"].contains(&text);
    text.len() > 2 && !function && text.chars().all(|c| c.is_ascii_alphabetic())
}

/// Words before a line that tries a special case.
const TRIALS: &str = "check|test|special case|in particular|especially|e.g.|for example|then";

/// An equation and the one in brackets behind it: `u = 2 √(g l) (R = −m g)`.
pub(super) fn beside(text: &str) -> Option<[&str; 2]> {
    let both = text.trim_end().strip_suffix(')')?.rsplit_once(" (")?;
    (relates(both.0) && relates(both.1)).then_some([both.0, both.1])
}

/// What a line supposes and what follows then: `For θ = 0: ω = 3v/(2l)`, `If e = 1, E = 0`, `Check: M = 0 gives a = g`.
pub(super) fn supposition(text: &str) -> Option<(&str, Vec<&str>)> {
    let lower = text.to_ascii_lowercase();
    let tries = TRIALS.split('|').find(|words| {
        let behind = lower.strip_prefix(*words);
        behind.is_some_and(|behind| behind.starts_with([' ', ':', ',']))
    });
    let text = text[tries.map_or(0, str::len)..].trim_start_matches([':', ',', ' ']);
    let lead = text.split(' ').next()?;
    let leads = "for if when setting at with take taking putting let";
    let supposes = is_in(leads, lead);
    if !supposes {
        let words = [" for ", " if ", " when "].into_iter();
        if let Some((said, given)) = words.filter_map(|word| text.split_once(word)).next() {
            let both = relates(said) && relates(given);
            let given = given.trim_end_matches('.').trim_matches([' ', '$']);
            return both.then(|| (given, equations(said)));
        }
    }
    let rest = &text[if supposes { lead.len() } else { 0 }..];
    let ends = ": | gives |, | then | we get | we find | we have ".split('|');
    let ends: Vec<&str> = ends.take(if supposes { 7 } else { 2 }).collect();
    // `For e = 0, d = l/2: …` and `For the end, d = l/2: …` suppose what stands before the colon.
    let found = |end: &&str| {
        let at = rest.find(*end).filter(|at| relates(&rest[..*at]))?;
        Some((at, end.len()))
    };
    let colon = ends.first().and_then(&found);
    let end = colon.or_else(|| ends.iter().filter_map(found).min());
    // `for θ = 0 ω = 3v/(2l)`: behind a number the second equation begins with its name.
    let second = || {
        let (before, _) = rest.rsplit_once('=').filter(|_| supposes)?;
        let at = before.trim_end().rfind(' ')?;
        let (_, value) = before[..at].split_once('=')?;
        let value = value.replace("pi", "π");
        let number = |c: char| c.is_ascii_digit() || " ./°π+-−\\".contains(c);
        value.chars().all(number).then_some((at, 1))
    };
    let (at, length) = end.or_else(second)?;
    let (given, behind) = (&rest[..at], &rest[at + length..]);
    let both = relates(given) && relates(behind);
    both.then(|| (without_words(given), equations(behind)))
}

/// What is supposed without words before it: `the end, d = l/2`, `it strikes at the end (d = l/2)`.
fn without_words(given: &str) -> &str {
    let given = given.trim_matches([' ', '$']);
    let inside = given.strip_suffix(')').and_then(|g| g.split_once(" ("));
    let inside = inside.filter(|(words, _)| !relates(words));
    let behind = given.split_once(", ");
    let behind = behind.filter(|(words, behind)| !relates(words) && relates(behind));
    inside.or(behind).map_or(given, |(_, behind)| behind)
}

/// Whether a line says what a name is as a function of time: `v(t) = …`.
pub(super) fn is_of_time(text: &str) -> bool {
    let left = text.split('=').next().unwrap_or_default().trim_end();
    let name = left.strip_suffix("(t)").map(str::trim_end);
    name.is_some_and(|name| {
        let plain = |c: char| c.is_alphanumeric() || "_\\{}".contains(c);
        !name.is_empty() && name.chars().all(plain)
    })
}

/// A chain that ends in a number with its unit, `ω = 3v/(2l) = 5.2 rad/s`, as the chain before that and its name with the
/// number: symbols and units do not stand in one formula.
pub(super) fn measured_end(text: &str) -> Option<[String; 2]> {
    let at = text.rfind(['=', '≈'])?;
    let (chain, end) = text.split_at(at);
    let (name, _) = chain.split_once('=')?;
    let number = end.trim_start_matches(['=', '≈', ' ', '-', '−']);
    let measured = number.starts_with(|c: char| c.is_ascii_digit() || c == '.');
    measured.then(|| [chain.trim_end().to_string(), format!("{name}{end}")])
}

/// Whether what follows a separator is an equation of its own; behind an arrow a chain may go on without a name.
fn parts(sign: &str, behind: &str) -> bool {
    let next = BETWEEN
        .split('|')
        .skip(6)
        .filter_map(|s| behind.find(s))
        .min();
    let own = &behind[..next.unwrap_or(behind.len())];
    let words = |text: &str| {
        let mut all = text.split_whitespace();
        text.chars().all(|c| c.is_alphabetic() || " .,".contains(c)) && all.any(|w| w.len() > 3)
    };
    relates(own) || sign == ", " && words(own)
}

/// The equation of a piece of text, without the words before it.
fn equation(text: &str) -> &str {
    let mut rest = text.trim().trim_start_matches('$').trim_start();
    // `\text{LMB of both: }`
    if let Some((said, behind)) = rest.strip_prefix("\\text{").and_then(|r| r.split_once('}'))
        && said.contains([' ', ':', ','])
        && relates(behind)
    {
        rest = behind.trim_start();
    }
    // `As M→∞, …`
    if let Some((words, behind)) = rest.split_once(", ")
        && ["→", "->", "\\to"]
            .iter()
            .any(|arrow| words.contains(arrow))
        && !relates(&words.replace("->", ""))
        && relates(behind)
    {
        rest = behind.trim_start();
    }
    // `The gate turns at a steady rate, t = …`, `Putting (1) into (2) gives …`
    let ends = [", ", " we get ", " gives ", " yields "];
    let said = ends.iter().filter_map(|end| rest.split_once(end));
    let least = |said: &str| if said.ends_with(')') { 3 } else { 4 };
    if let Some((_, behind)) = said
        .filter(|(said, behind)| says(said, least(said)) && relates(behind))
        .min_by_key(|(said, _)| said.len())
    {
        rest = behind.trim_start();
    }
    // `The disc turns back for η > 4`
    let stated = [" for ", " if ", " when "].into_iter();
    if let Some((_, behind)) = stated
        .filter_map(|word| rest.split_once(word))
        .find(|(said, behind)| says(said, 3) && relates(behind) && !behind.contains('='))
    {
        rest = behind.trim_start();
    }
    // A law or body named before a colon; a definition `a := b` has its sign behind the colon.
    if let Some((words, behind)) = rest.split_once(':')
        && !behind.starts_with('=')
        && relates(behind)
        && !words.contains(['=', '<', '>', '^', '*'])
        && (words.chars().any(char::is_alphabetic) || words.starts_with('('))
    {
        rest = behind.trim_start();
    }
    loop {
        let lower = rest.to_ascii_lowercase();
        let lead = LEADS.split('|').find(|lead| {
            let word = lead.ends_with(|c: char| c.is_ascii_alphabetic());
            lower
                .strip_prefix(&lead.to_ascii_lowercase())
                .is_some_and(|behind| {
                    let apart = !word || behind.starts_with([' ', ',', '\\', '$']);
                    apart && relates(behind)
                })
        });
        match lead {
            Some(lead) => rest = rest[lead.len()..].trim_start_matches([' ', ',', '$', '~']),
            None => break,
        }
    }
    if let Some((left, right)) = rest.split_once('=')
        && describes(left)
    {
        rest = if relates(right) {
            right.trim_start()
        } else {
            ""
        };
    }
    let rest = without_remark(
        without_reason(rest).trim_end_matches(['$', ' ', '.', ',', ';', ':', '✓', '✔']),
    );
    let moment = MOMENTS
        .split('|')
        .find_map(|words| rest.strip_suffix(words));
    moment.unwrap_or(rest).trim_end()
}

/// Words that turn a sign, or say which counts as positive: an equation beside them is not the one without.
const SENSES: &str = "up upward upwards down downward downwards left leftward right rightward opposite negative positive \
    backward backwards clockwise counterclockwise anticlockwise not never wrong false";

fn turns_sign(word: &str) -> bool {
    is_in(SENSES, word)
}

/// Whether a text without an equation is a sentence, which may have formulas in it: `The distance of G is l/2`.
fn is_prose(text: &str) -> bool {
    let words = text.split([' ', ',']).filter(|word| is_word(word));
    !relates(text) && words.count() > 1
}

/// First words of a reason.
const REASONING: &str =
    "since |because |as |assuming |neglecting |ignoring |rejecting |discarding ";

/// Whether words say something by themselves, so many at least: `The gate turns at a steady rate`, `Using (1) and (2)`.
fn says(words: &str, least: usize) -> bool {
    let all = || words.trim().split([' ', '-']);
    let number = |word: &str| {
        let inside = word.strip_prefix('(').and_then(|w| w.strip_suffix(')'));
        inside.is_some_and(|n| !n.is_empty() && n.bytes().all(|b| b.is_ascii_digit()))
    };
    // A reason turns no sign: `Since no torque acts about C, …`.
    let reason = REASONING.split('|').any(|lead| {
        let start = words.trim().get(..lead.len());
        start.is_some_and(|start| start.eq_ignore_ascii_case(lead))
    });
    let is_said = |word: &str| is_letters(word) && (reason || !turns_sign(word));
    all().count() + usize::from(all().any(number)) + usize::from(reason) >= least
        && all().all(|word| is_said(word) || number(word))
}

/// An equation without the reason in words behind it: `T1 = T2 since the pulley is light`, `…, where v' is the speed after`.
fn without_reason(text: &str) -> &str {
    const REASONS: &str =
        " be the | where | which | because | since | using | due to | as the | by the ";
    const PLACES: &str = " at the | at rest| in the | in this | in that | on the | along the | during the | for the | until the | of the ";
    let first = |leads: &str| {
        let found = leads
            .split('|')
            .filter_map(|lead| Some((text.find(lead)?, lead.len())));
        found.min()
    };
    let is_reason =
        |&(at, length): &(usize, usize)| !relates(&text[at..]) && text[at + length..].contains(' ');
    let is_place = |&(at, length): &(usize, usize)| {
        let mut words = text[at + length..].split([' ', '-']);
        relates(&text[..at]) && words.all(|word| is_letters(word) && !turns_sign(word))
    };
    let place = || first(PLACES).filter(is_place);
    match first(REASONS).filter(is_reason).or_else(place) {
        Some((at, _)) => text[..at].trim_end_matches([' ', ',']),
        None => text,
    }
}

/// Whether words left of an equality sign describe a quantity and do not end in its name: `the energy lost`, `momentum about A`,
/// but not `the energy E`.
fn describes(left: &str) -> bool {
    let lower = left.to_ascii_lowercase();
    let words: Vec<&str> = lower.split_whitespace().collect();
    let [.., before, last] = words[..] else {
        return false;
    };
    let place = ["about", "at", "of", "on"].contains(&before);
    lower.chars().all(|c| c.is_ascii_alphabetic() || c == ' ')
        && (last.len() > 2 || place)
        && words.iter().any(|word| among(DESCRIBING, word))
}

/// Whether words in brackets say what stands before them, and are no factors: `the deceleration of the block`.
fn describes_it(words: &str) -> bool {
    // `(phidot - ω)` is a factor.
    let subtracts = [" -", "- "].iter().any(|sign| words.contains(sign));
    let mut all = words.split([' ', ',', '-']).filter(|word| !word.is_empty());
    let plain = |word: &str| is_letters(word) && !changes(word);
    let name = |word: &str| formula::is_greek(word) || !is_word(word) || word.len() < 4;
    let says = all.clone().any(|word| !name(word)) && all.clone().count() > 1;
    says && !subtracts && all.all(|word| plain(word) && !turns_sign(word))
}

/// An equation without the number or the words in brackets behind it: `(downwards)`, `(by symmetry)`, `\\tag{3}`, and a `(3)`
/// that stands well apart or behind dots, since closer it is a factor.
pub(super) fn without_remark(text: &str) -> &str {
    let Some((before, behind)) = text.rsplit_once(['(', '{']) else {
        return text;
    };
    let Some(inside) = behind.strip_suffix([')', '}']) else {
        return text;
    };
    let number = !inside.is_empty() && inside.bytes().all(|b| b.is_ascii_digit());
    let first = inside.split(' ').next().unwrap_or_default();
    let mut dots = ["..", "…", "--"].iter();
    let far = ["\\quad", "\\qquad"];
    let apart = before.ends_with("  ")
        || dots.any(|d| before.trim_end().ends_with(d))
        || far.iter().any(|far| before.trim_end().ends_with(far));
    let words = text.ends_with(')')
        && (among(REMARKS, first) || before.ends_with(' ') && describes_it(inside));
    match before.strip_suffix("\\tag") {
        Some(equation) if number => equation.trim_end(),
        None if words => before.trim_end(),
        None if text.ends_with(')') && number && apart => {
            let before = before.trim_end();
            let before = far
                .iter()
                .find_map(|far| before.strip_suffix(far))
                .unwrap_or(before);
            before.trim_end_matches([' ', '.', '…', '-'])
        }
        _ => text,
    }
}

/// Words between an equation and the direction that is said of it: `ω = …, i.e. it turns clockwise`.
const BEFORE_SENSES: &str = "a acting and directed hence i.e. in is it means moves points pointing rotates so that the thus turns which";

/// An equation with the direction that its line says of it: behind it, `ω = 3v/(2l) (clockwise)` and `V = m u/M, to the left`, or
/// before it, `Clockwise: ω = …`.
pub(super) fn with_direction(line: &str, equation: &str) -> Option<String> {
    if let Some((word, own)) = direction_before(equation) {
        return Some(format!("{own} ({word})"));
    }
    let (before, behind) = line.split_once(equation)?;
    if let Some((word, "")) = direction_before(&format!("{} ", before.trim())) {
        return Some(format!("{equation} ({word})"));
    }
    let behind = behind.trim_start_matches([' ', '$', ',', '(']);
    let ends = [", ", "; ", ")"].into_iter();
    let end = ends.filter_map(|end| behind.find(end)).min();
    let said = behind[..end.unwrap_or(behind.len())].trim_end_matches(['.', ' ', '$', ',', ';']);
    let whole = format!("_ {said}");
    let (body, _) = read::sense(&whole)?;
    let mut words = body.split([' ', ',']).skip(1);
    let led = words.all(|word| word.is_empty() || among(BEFORE_SENSES, word));
    led.then(|| {
        format!(
            "{equation} ({})",
            whole[body.len()..].trim_matches([' ', ','])
        )
    })
}

/// The word for a direction with which a text begins, and what follows it.
fn direction_before(text: &str) -> Option<(&str, &str)> {
    let ends = text.match_indices([':', ',', ' ']).map(|(at, _)| at);
    let mut said = ends.filter_map(|at| {
        let whole = format!("_ {}", &text[..at]);
        (read::sense(&whole)?.0 == "_").then_some(at)
    });
    let at = said.next_back()?;
    Some((&text[..at], text[at..].trim_start_matches([':', ',', ' '])))
}

/// Whether a refused name of several letters looks like a slip of the pen for a declared one, which begins alike and has an
/// index as well.
pub(super) fn near<'f>(fault: &'f Fault, text: &str) -> Option<&'f str> {
    let offered = fault.hint.as_ref().and_then(|h| h.strip_prefix("did you"));
    let first = |text: &str| text.chars().find(|c| c.is_alphabetic());
    let meant = offered.and_then(|words| words.split_whitespace().last());
    let meant = meant.map(|name| name.trim_end_matches('?'));
    let own = text.get(fault.start..fault.end).unwrap_or_default();
    let indexed = |name: &str| {
        name.contains('_') || name.ends_with(|c: char| c.is_ascii_digit() || c == '\'')
    };
    let alike = |meant: &str| first(meant) == first(own) && (indexed(meant) || !indexed(own));
    // `ma` is m a rather than a slip for m.
    let product = |meant: &str| meant.len() == 1 && own.len() < 4 && !own.contains('_');
    meant.filter(|meant| own.len() > 1 && alike(meant) && !product(meant))
}
