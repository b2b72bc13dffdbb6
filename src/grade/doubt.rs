//! Where a text could mean something else: other readings, an e that nobody declared, and what the reader decided.

use num_traits::Signed;
use std::collections::BTreeMap;

use super::compare;
use super::{Diagnosis, Grade, Key, Options, Proof, Verdict, read, show};
use crate::algebra;
use crate::dimension;
use crate::domain::Domains;
use crate::expr::{Expr, Function, Node, Point, Symbol};
use crate::formula::{self, Content, Fault, Note, Reading, Relation, Remark};

/// `cosθ^2`, read as the cosine of a square, would be right as the square of the cosine.
pub(super) fn power_of_function(content: &Content) -> Option<Content> {
    fn lifted(e: &Expr) -> Option<Expr> {
        if let Node::Call(f, x) = e.node()
            && let Node::Power(base, k) = x.node()
            && k.as_number().is_some_and(|k| k.is_integer())
        {
            return Some(Expr::call(*f, base.clone()).power(k.clone()));
        }
        None
    }
    fn lift(e: &Expr) -> Expr {
        lifted(e).unwrap_or_else(|| e.map_parts(lift))
    }
    if !content.parts().any(|part| lifted(part).is_some()) {
        return None;
    }
    let changed = match content {
        Content::Scalar(_) | Content::Vector(_) | Content::Matrix(_) => content.map(&lift),
        _ => return None,
    };
    (changed != *content).then_some(changed)
}

/// `e^x` against `exp(x)` with an e that nobody declared: only one of them knows a symbol e. Where they are equal with e as
/// the base of the natural logarithm, that is what was meant, unless an expected e may be a restitution to the power of a
/// count: then nothing is decided, unless a logarithm takes part and no letter that counts.
pub(super) fn euler(key: &Key, reading: &Reading, options: &Options, finding: &mut Grade) {
    let (expected, answer) = (&key.reading.content, &reading.content);
    let is_ln = |part: &Expr| {
        use Function::{Cosh, Ln, Sinh, Tanh};
        matches!(part.node(), Node::Call(Ln | Sinh | Cosh | Tanh, _))
    };
    let logarithm = expected.parts().chain(answer.parts()).any(is_ln);
    fn number(e: &Expr, alone: bool) -> Expr {
        match e.node() {
            Node::Power(base, k) if is_e(base) => Expr::call(Function::Exp, number(k, alone)),
            Node::Call(Function::Ln, x) if is_e(x) => Expr::one(),
            Node::Symbol(_) if alone && is_e(e) => Expr::call(Function::Exp, Expr::one()),
            _ => e.map_parts(|part| number(part, alone)),
        }
    }
    // Alone it is a number beside a logarithm or a hyperbolic function only: `ln x = 1` and `x = e`.
    let number = |e: &Expr| number(e, logarithm);
    let occurs = |content: &Content| content.mentions("e");
    if finding.verdict != Verdict::Different || occurs(expected) == occurs(answer) || key.declares_e
    {
        return;
    }
    let (a, b) = (expected.map(&number), answer.map(&number));
    if occurs(&a) || occurs(&b) {
        return;
    }
    let other = key.with(a);
    let mine = reading.with(b);
    let found = compare::contents(&other, &mine, &options.plain());
    if found.verdict != Verdict::Equivalent {
        // Beside an exponential function or a logarithm e is no symbol that is too much.
        let is_exp =
            |part: &Expr| matches!(part.node(), Node::Call(Function::Exp | Function::Ln, _));
        if expected.parts().any(is_exp) {
            *finding = found;
        }
        return;
    }
    let counter = |name: &Symbol| matches!(&**name, "n" | "N" | "k" | "i" | "j");
    let mut exponents = expected.parts().filter_map(|part| match part.node() {
        Node::Power(base, k) if is_e(base) => Some(k),
        _ => None,
    });
    let counts = |k: &Expr| is_count(k) && (!logarithm || k.symbols().iter().any(counter));
    if !(occurs(expected) && exponents.all(counts)) {
        *finding = found;
        let given = "e is the base of the natural logarithm";
        finding.assumed.push(given.into());
        return;
    }
    let words = "e is a symbol; as the base of the natural logarithm it would be right";
    let hint = "write exp(x) for the exponential function";
    ambiguous(finding, words, hint);
}

fn is_e(e: &Expr) -> bool {
    e.as_symbol().is_some_and(|name| &**name == "e")
}

/// What e is raised to.
fn exponent(e: &Expr) -> Option<&Expr> {
    match e.node() {
        Node::Power(base, k) if is_e(base) => Some(k),
        Node::Call(Function::Exp, k) => Some(k),
        _ => None,
    }
}

/// `y'` for `dy/dx`, which would be right if it is that: a prime does not say by what.
pub(super) fn primes(key: &Key, reading: &Reading, options: &Options, finding: &mut Grade) {
    let primed = |name: &Symbol| {
        let (of, _) = name.strip_prefix('d')?.split_once("/d")?;
        Some((name.clone(), Expr::symbol(&Symbol::from(format!("{of}'")))))
    };
    let sides = [&key.reading.content, &reading.content];
    let names = sides.into_iter().flat_map(Content::symbols);
    let primed: BTreeMap<Symbol, Expr> = names.filter_map(|name| primed(&name)).collect();
    if finding.verdict != Verdict::Different || primed.is_empty() {
        return;
    }
    let [expected, mine] = sides.map(|content| content.map(&|e| e.substitute(&primed)));
    let other = key.with(expected);
    if compare::contents(&other, &reading.with(mine), options).verdict == Verdict::Equivalent {
        let words = "a prime does not say by what is differentiated; it would be right as the derivative that is asked for";
        let hint = "write the derivative as a quotient, as in dy/dx";
        ambiguous(finding, words, hint);
    }
}

/// `e^(i theta)` with an i that the question does not know: what sets the two apart is told of a symbol, and is no belief
/// where the imaginary unit was meant.
pub(super) fn imaginary(key: &Key, reading: &Reading, finding: &mut Grade) {
    let turns = |k: &Expr| !is_count(k) && (k.mentions("i") || k.mentions("j"));
    let all = key.reading.content.parts().chain(reading.content.parts());
    let found = all.filter_map(exponent).any(turns);
    if finding.verdict == Verdict::Different && found && !key.declares_i {
        let words = "i or j in an exponent is read as a symbol; complex numbers are not compared";
        let hint = "write cosines and sines, or declare i and j where they are quantities";
        finding.note = "DIFF";
        finding.diagnosis = vec![Diagnosis::new("AMBIGUOUS", words, hint)];
    }
    let sides = [&key.reading.content, &reading.content].map(|content| content.answer().expr());
    if let (Verdict::Different, false, [Some(a), Some(b)]) =
        (finding.verdict, key.declares_i, sides)
        && agree_as_complex(&turning(&(a - b)), &key.question.domains)
    {
        let words = "i is read as a symbol; as the imaginary unit it would be right";
        let hint = "complex numbers are not compared: ask for real and imaginary part";
        ambiguous(finding, words, hint);
    }
}

/// cos x + i sin x for e to the power of i x.
fn turning(e: &Expr) -> Expr {
    let factor = |k: &Expr| match k.node() {
        Node::Product(parts) => {
            let (units, others): (Vec<_>, Vec<_>) = parts
                .iter()
                .cloned()
                .partition(|part| *part == Expr::symbol("i"));
            (units.len() == 1 && others.iter().all(|part| !part.mentions("i")))
                .then(|| Expr::product(others))
        }
        _ => (*k == Expr::symbol("i")).then(Expr::one),
    };
    match exponent(e).and_then(factor) {
        Some(x) => {
            Expr::call(Function::Cos, x.clone()) + Expr::symbol("i") * Expr::call(Function::Sin, x)
        }
        None => e.map_parts(turning),
    }
}

/// Whether a difference vanishes where i² = −1: its even and its odd part in i do, which stand on i² alone.
fn agree_as_complex(difference: &Expr, domains: &Domains) -> bool {
    let square = Expr::symbol("i^2");
    let root = square.sqrt();
    let [plus, minus] = [&root, &-&root].map(|root| difference.put("i", root));
    let vanishes = |part: Expr| {
        let part = algebra::tidy(&part, domains).ok();
        let part = part.map(|part| part.replace(&root, &Expr::symbol("i")));
        let part = part.filter(|part| !part.mentions("i"));
        let there = part.map(|part| part.put("i^2", &Expr::from(-1)));
        there.is_some_and(|there| algebra::tidy(&there, domains).is_ok_and(|e| e.is_zero()))
    };
    difference.mentions("i") && vanishes(&plus + &minus) && vanishes((&plus - &minus) * &root)
}

/// `x = n pi` for an equation in sines: its n may stand for any whole number, which is told of no symbol.
pub(super) fn any_whole_number(key: &Key, reading: &Reading, finding: &mut Grade) {
    let asked = key.reading.content.symbols();
    let said = reading.content.symbols();
    let is_count = |name: &Symbol| matches!(&**name, "n" | "k" | "m" | "N" | "j");
    let mut counts = said
        .iter()
        .filter(|name| !asked.contains(*name) && is_count(name));
    let Some(count) = counts.next() else {
        return;
    };
    let is_turn = |part: &Expr| {
        matches!(part.node(), Node::Product(_)) && part.mentions(count) && part.mentions("pi")
    };
    let is_arc = |part: &Expr| {
        use Function::{Cos, Sin, Tan};
        matches!(part.node(), Node::Call(Sin | Cos | Tan, _))
    };
    let turns = reading.content.parts().any(is_turn);
    let periodic = key.reading.content.parts().any(is_arc);
    if finding.verdict == Verdict::Different && turns && periodic {
        let words =
            format!("{count} is read as a symbol; what holds for any whole number is not compared");
        ambiguous(finding, &words, "give the solutions of one period");
    }
}

/// `(1, 2) or (2, 1)`: an interval whose ends stand the wrong way round holds nothing and would agree with anything; it is a
/// point, or a slip.
pub(super) fn backwards(key: &Key, reading: &Reading, finding: &mut Grade) {
    let value = |side: &Content| side.expr()?.evaluate(&Point::default());
    let empty = |part: &Content| match part {
        Content::Relations(sides, signs) => match (&sides[..], &signs[..]) {
            (
                [low, _, high],
                [
                    Relation::Less | Relation::LessEqual,
                    Relation::Less | Relation::LessEqual,
                ],
            ) => {
                let ends: Option<(f64, f64)> = value(low).zip(value(high));
                ends.is_some_and(|(low, high)| low > high)
            }
            _ => false,
        },
        _ => false,
    };
    let some =
        |content: &Content| matches!(content, Content::Joined(_, parts) if parts.iter().any(empty));
    if finding.is_equivalent() && (some(&key.reading.content) || some(&reading.content)) {
        let words = "the ends of an interval stand the wrong way round; it holds nothing, and may be meant as a point";
        undecide(finding, words);
    }
}

/// `e^2x` that is wrong as it stands, and would be right with all of 2x in the exponent: many who type mean that. What would
/// be right with a quotient there, `x^1/2`, stays wrong and is told.
pub(super) fn raised(key: &Key, answer: &str, options: &Options, finding: &mut Grade) {
    if finding.verdict != Verdict::Different || answer.len() > LONGEST {
        return;
    }
    for signs in ["", "/"] {
        if let Some(text) = raised_further(answer, signs)
            && let Ok(other) = read::answer(key, &text)
        {
            let mut found = compare::contents(key, &other, options);
            euler(key, &other, options, &mut found);
            if found.verdict == Verdict::Equivalent {
                let words = format!(
                    "it would be right as {text}; without brackets one factor alone is the exponent"
                );
                // A slash ends an exponent by every rule.
                if signs.is_empty() {
                    undecide(finding, &words);
                }
                let hint = "write brackets around all that stands in the exponent";
                finding.diagnosis = vec![Diagnosis::new("AMBIGUOUS", words, hint)];
                return;
            }
        }
    }
}

/// A text with brackets around all letters, digits and `signs` behind each sign of a power; nothing where that changes nothing.
fn raised_further(text: &str, signs: &str) -> Option<String> {
    let mut pieces = text.split('^');
    let mut out = pieces.next()?.to_string();
    let mut changed = false;
    for piece in pieces {
        let unsigned = piece.trim_start_matches(['-', '−']);
        let inside = |c: char| c.is_alphanumeric() || signs.contains(c);
        let rest = unsigned.trim_start_matches(inside);
        let (exponent, rest) = piece.split_at(piece.len() - rest.len());
        let further = unsigned.len() > rest.len() + 1;
        changed |= further;
        out.push_str(&match further {
            true => format!("^({exponent}){rest}"),
            false => format!("^{piece}"),
        });
    }
    changed.then_some(out)
}

/// Nothing is decided, for a text has two meanings.
fn undecide(finding: &mut Grade, words: &str) {
    finding.verdict = Verdict::Undecided;
    finding.note = "UNDECIDED_AMBIGUOUS";
    finding.proof = Proof::of("none", words);
    finding.counterexample = None;
    finding.diagnosis.clear();
}

/// The same, with words on what could be written in place of it.
fn ambiguous(finding: &mut Grade, words: &str, hint: &str) {
    undecide(finding, words);
    finding.diagnosis = vec![Diagnosis::new("AMBIGUOUS", words, hint)];
}

/// Whether an exponent may count something: a whole number, a symbol, or a sum of such with positive factors.
fn is_count(k: &Expr) -> bool {
    let whole = |e: &Expr| e.as_number().is_some_and(|k| k.is_integer());
    match k.node() {
        Node::Symbol(_) => true,
        Node::Sum(terms) => terms.iter().all(is_count),
        Node::Product(factors) => match factors.as_slice() {
            [number, rest] => {
                whole(number)
                    && number.as_number().is_some_and(Signed::is_positive)
                    && rest.as_symbol().is_some()
            }
            _ => false,
        },
        _ => whole(k),
    }
}

/// An answer that is wrong as it is usually read, and right with every slash turned round, is right, and is told how it was
/// taken: people differ about slashes. So is `acosφ` that is right as a times the cosine.
pub(super) fn turned(
    key: &Key,
    answer: &str,
    options: &Options,
    reading: &mut Reading,
    finding: &mut Grade,
) {
    let arc = |notes: &[Note], arc| {
        let remark = Remark::ArcOrFactor { arc };
        notes.iter().any(|n| n.remark == remark)
    };
    let arcs = arc(&reading.notes, true);
    if !(reading.slashes || arcs) || finding.verdict != Verdict::Different {
        return;
    }
    let slashes = || formula::slashes_turned(answer, &key.readable);
    let slashes = reading.slashes.then(slashes);
    let factors = || {
        let mut others = formula::other_readings(answer, &key.readable, false);
        others.retain(|other| arc(&other.notes, false));
        others
    };
    let others = slashes.into_iter().flatten();
    let others = others.filter(|other| other.content != reading.content);
    let mut others = others.chain(arcs.then(factors).into_iter().flatten());
    let found = others.find_map(|other| {
        let turned = compare::contents(key, &other, options);
        (turned.verdict == Verdict::Equivalent).then_some((turned, other))
    });
    let Some((turned, other)) = found else {
        return;
    };
    let [theirs, mine] = [&other, &*reading].map(|reading| show(&reading.content));
    let message = format!("right when it is read as {theirs}; by the usual rule it is {mine}");
    let hint = match arc(&other.notes, false) {
        true => "write a space before the function: acos is the arccosine",
        false => "the slash can be read in two ways; use brackets to say what stands below",
    };
    *finding = turned.reread(message, hint);
    *reading = other;
}

/// The grade of an answer that cannot be read as it stands, where there is another way.
pub(super) fn unread(key: &Key, answer: &str, options: &Options) -> Option<Grade> {
    number(key, answer, options).or_else(|| aside(key, answer, options))
}

/// `\boxed{2 m v} (to the right)`: what is boxed is right, and the words beside the box say the direction that nearly always
/// counts as positive. With other words it stays unread.
fn aside(key: &Key, answer: &str, options: &Options) -> Option<Grade> {
    let (value, direction) = read::sense(answer)?;
    let boxed = value.contains("\\boxed{") && value.trim_end_matches('$').ends_with('}');
    if !boxed || direction.iter().sum::<i32>() < 0 || key.direction.is_some() {
        return None;
    }
    let mut grade = super::judge_here(key, value, options);
    let words = "the direction in words is not judged";
    grade.assumed.push(words.to_string());
    (grade.verdict == Verdict::Equivalent).then_some(grade)
}

/// Longest answer, in bytes, of which a number is tried in its other meaning: what is longer no student wrote.
const LONGEST: usize = 1_000;

/// An answer that cannot be read because a number in it has two meanings, and is right in one of them, is right: `1,500 N`,
/// where a comma groups thousands or begins the decimals, and the mixed number `1 3/4`. Otherwise it stays unread.
pub(super) fn number(key: &Key, answer: &str, options: &Options) -> Option<Grade> {
    if answer.len() > LONGEST {
        return None;
    }
    let comma = |rest: &str| {
        let mut signs = ["{,}", ","].into_iter();
        let sign = signs.find(|sign| rest.starts_with(sign))?;
        (digits(&rest[sign.len()..]) > 0).then_some(sign.len())
    };
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
        let grade = super::judge_here(key, &text, options);
        let message = format!("right when it is read as {text}");
        (grade.is_equivalent()).then(|| grade.reread(message, hint))
    })
}

/// A text with mixed numbers as sums in brackets: `(1+3/4) m` for `1 3/4 m`; nothing where there are none.
pub(super) fn mixed(text: &str) -> Option<String> {
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

fn digits(text: &str) -> usize {
    text.bytes().take_while(u8::is_ascii_digit).count()
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

/// `mv sinθ N s`: a wrong answer with a unit behind its last spaces whose letters the question does not know is right when
/// the formula before it is, and is told so. One letter, or two small ones, are a factor; J, N and W are units first.
pub(super) fn unit_behind(
    key: &Key,
    answer: &str,
    options: &Options,
    reading: &mut Reading,
    finding: &mut Grade,
) {
    let known = |word: &str| key.question.symbols.iter().any(|g| *g.name == *word);
    // `0.25 m g h J` is a number of units where m, g and h are the symbols of a formula.
    let formula = key
        .reading
        .content
        .answer()
        .expr()
        .is_some_and(|e| !e.is_constant());
    let measured = formula && matches!(reading.content.answer(), Content::Quantity(_));
    let own = !reading.symbols().iter().all(|name| known(name));
    if finding.verdict != Verdict::Different || !(measured || own) {
        return;
    }
    let spaces = answer.rmatch_indices(' ').take(3);
    let found = spaces.into_iter().find_map(|(at, _)| {
        let (formula, behind) = (answer[..at].trim_end(), &answer[at..]);
        let inside = behind
            .trim()
            .strip_prefix('[')
            .and_then(|unit| unit.strip_suffix(']'));
        let text = formula::plain_unit(inside.unwrap_or(behind))?;
        let letters = text.split(|c: char| !c.is_alphabetic());
        let unit = dimension::unit(&text).ok()?;
        let mut words = letters.filter(|word| !word.is_empty());
        let mut plain = !text.contains(['/', '^', '²', '⁻']);
        let declared = words.any(|word| {
            plain &= word.len() == 1 && word.to_lowercase() == word;
            known(word)
        });
        let letter = text.chars().count() == 1 && !matches!(text.as_str(), "J" | "N" | "W");
        // Brackets show a unit: `v/2 [m/s]`.
        let told = declared || letter || plain;
        if told && inside.is_none() || unit.dimension.is_none() {
            return None;
        }
        let mut other = read::answer(key, formula).ok()?;
        let verdict = compare::verdict_of(key, &other, options);
        other.unit = Some(unit);
        (verdict == Verdict::Equivalent).then_some((other, text))
    });
    if let Some((other, unit)) = found {
        let message = format!("right with {unit} read as a unit, not as a factor");
        let hint = "symbols carry their units: leave the unit away";
        *finding = compare::contents(key, &other, options).reread(message, hint);
        *reading = other;
    }
}

/// What an author should know about an expected formula in which a slash could reach further or less far.
pub(super) fn told(expected: &str, reading: &Reading) -> Option<String> {
    if !reading.slashes {
        return None;
    }
    let slash = |n: &&Note| matches!(n.remark, Remark::Slash { .. });
    let note = reading.notes.iter().find(slash)?;
    Some(note.message(expected))
}

/// The fault of a slash whose reach is not shown by brackets, where that is asked for.
pub(super) fn unclear_slash(text: &str, reading: &Reading) -> Option<Fault> {
    let slash = |n: &&Note| matches!(n.remark, Remark::Slash { .. });
    let note = reading.notes.iter().find(slash)?;
    let reading = note.message(text);
    let message = format!("what stands below the slash is unclear: {reading}");
    let hint = "write brackets around all that stands below";
    Some(*Fault::new(message, note.start, note.end).hint(hint))
}

/// Where a text could be read in another way and that would be right, the grade says so; the usual reading decides.
pub(super) fn ambiguity(
    key: &Key,
    answer: &str,
    options: &Options,
    reading: &Reading,
    finding: &mut Grade,
) {
    if !matches!(finding.verdict, Verdict::Equivalent | Verdict::Different) {
        return;
    }
    let plain = options.plain();
    let mut others = formula::other_readings(answer, &key.readable, false);
    if let Some(content) = power_of_function(&reading.content) {
        others.push(reading.with(content));
    }
    for other in others {
        let verdict = compare::verdict_of(key, &other, &plain);
        if verdict != finding.verdict && matches!(verdict, Verdict::Equivalent | Verdict::Different)
        {
            let right = finding.is_equivalent();
            let [mine, theirs] = [reading, &other].map(|reading| show(&reading.content));
            let would = if right { "wrong" } else { "right" };
            let message = format!("read as {mine}; read as {theirs} it would be {would}");
            let hint = "the formula can be read in two ways; use brackets to say which is meant";
            if tight_root(&other, answer, right) {
                let words = "the root sign may reach over one letter or over all of them";
                undecide(finding, words);
            } else if behind_fraction(&other, answer) {
                undecide(
                    finding,
                    "the function may be taken of the fraction or of all behind it",
                );
            }
            let found = Diagnosis::new("AMBIGUOUS", message, hint);
            finding.diagnosis.insert(0, found);
            return;
        }
    }
}

/// Whether a reading takes `√ab`, with nothing between the letters, as the root of all of them: no habit decides that.
fn tight_root(other: &Reading, answer: &str, right: bool) -> bool {
    let tight = |note: &Note| {
        let (root, behind) = answer.split_at_checked(note.middle).unwrap_or_default();
        // The root of a number and then letters is what most mean by `√2x`.
        if right && root.ends_with(|c: char| c.is_ascii_digit()) {
            return false;
        }
        behind.starts_with(|c: char| c.is_alphanumeric() || c == '\\')
    };
    let long = Remark::Root { long: true };
    other.notes.iter().any(|n| n.remark == long && tight(n))
}

/// Whether a reading takes a function of a fraction and the name behind it, as in `\sin\frac{n\pi}{L}x`.
fn behind_fraction(other: &Reading, answer: &str) -> bool {
    let long = Remark::Argument { long: true };
    let fraction = |note: &Note| answer.get(..note.middle).is_some_and(|t| t.ends_with('}'));
    other.notes.iter().any(|n| n.remark == long && fraction(n))
}

/// What the reader decided that a student should know about.
pub(super) fn remarks(reading: &Reading, answer: &str, verdict: Verdict) -> Vec<Diagnosis> {
    let wrong = verdict != Verdict::Equivalent;
    let worth = |note: &&Note| match note.remark {
        Remark::Letters => wrong && note.end > note.start + 3,
        Remark::Radians | Remark::NaturalLogarithm => wrong,
        Remark::UnitOfSymbols | Remark::Words => true,
        Remark::Inverse | Remark::UnitNotSymbols => wrong,
        _ => false,
    };
    let said = reading.notes.iter().filter(worth).map(|note| {
        let words = note.message(answer);
        Diagnosis::new("READING", words.clone(), words)
    });
    said.collect()
}
