//! Reads an answer with the names its key allows, and a key that may be a quantity.
//!
//! Beside the declared symbols an answer may begin with a name of its own for the quantity asked for, and it may use what
//! students wrongly bring in, so that it is wrong rather than unreadable. A word that is no name is refused: read letter by
//! letter it would be a formula nobody wrote.

mod direction;
mod measured;
pub(super) mod mixed;
mod named;

use std::collections::BTreeMap;

use super::unit::misfit;
use super::{Key, with_names};
use crate::dimension;
use crate::expr::{Expr, Symbol};
use crate::formula::{
    self, Content, Fault, Note, Reading, Relation, Remark, Shape, Symbols, Written,
};
use direction::direction;
pub(super) use direction::{sense, with_sign};
pub(super) use measured::{is_quantity, quantity};
use measured::{unit_apart, unit_of_name};
use named::{named_in_order, with_definitions};

/// Quantities of mechanics that students bring in although a collision does not know them.
const STRANGERS: [&str; 6] = ["g", "t", "mu", "h", "dt", "F"];

/// Whether a name is read although nobody declared it.
pub(super) fn is_stranger(name: &Symbol) -> bool {
    STRANGERS.contains(&&**name)
}

/// Reads an expected formula; numbers in round brackets are components there.
pub(super) fn expected(text: &str, symbols: &Symbols) -> Result<Reading, Fault> {
    let reading = formula::read(text, symbols).or_else(|fault| {
        match formula::read(text, &symbols.clone().with_lists()) {
            Ok(reading) if vector(&reading) => Ok(reading),
            // `2\frac{3}{4}` of an author is a number.
            _ => match mixed::mixed(text) {
                Some(sum) if text.contains("frac") => formula::read(&sum, symbols),
                _ => Err(fault),
            },
        }
    })?;
    // `3 i + 4 j`: two letters i and j in every term are the directions, and so are e_x and e_y.
    let names = reading.symbols();
    let axes = AXES
        .iter()
        .any(|axes| axes.iter().all(|axis| names.contains(*axis)));
    let reading = match along_axes(text, symbols).filter(vector) {
        Some(other) if axes => other,
        _ => reading,
    };
    if let Some(fault) = english(text, &reading) {
        return Err(fault);
    }
    // Authors say which product they mean, or what the letters are.
    match cross(&reading, text, symbols, &|_| false) {
        None => Ok(reading),
        Some(note) => {
            let words = "× between symbols could be a cross product";
            let hint = "write * for a product of numbers, and arrows over vectors, as in \\vec{r} \\times \\vec{p}";
            Err(*Fault::new(words, note.start, note.end).hint(hint))
        }
    }
}

/// A × between names of which one may be a vector: nobody declares it, or those who do give it an arrow.
pub(super) fn cross<'r>(
    reading: &'r Reading,
    text: &str,
    symbols: &Symbols,
    undeclared: &dyn Fn(&Symbol) -> bool,
) -> Option<&'r Note> {
    let number = |name: &Symbol| {
        symbols.find(name).is_some() && !undeclared(name) && !formula::has_components(name)
    };
    let numbers = |note: &Note| {
        let product = formula::read(text.get(note.start..note.end)?, symbols).ok()?;
        Some(product.symbols().iter().all(number))
    };
    let mut crosses = reading.notes.iter().filter(|n| n.remark == Remark::Cross);
    crosses.find(|note| numbers(note) != Some(true))
}

/// What tells that a letter is a vector.
const ARROWS: [&str; 7] = [
    "\\vec", "\\math", "\\b", "\\text", "\\hat", "\\over", "\u{20d7}",
];

/// Letters for two directions.
const AXES: [[&str; 2]; 2] = [["i", "j"], ["e_x", "e_y"]];

/// Refuses an English word that was read as a product of its letters: `5 m/s east`, `at least 5`.
fn english(text: &str, reading: &Reading) -> Option<Fault> {
    const WORDS: &str = "about above answer approximately below between both clockwise \
        counterclockwise degree degrees direction does down downward downwards east equal equals \
        false from greater horizontal increases infinite infinity joules left less meters metres \
        more most least neither newtons none north nothing of only positive negative right same \
        seconds sign solution south than that the then there true undefined upward upwards \
        vertical west where with yes";
    let split = reading.notes.iter().filter(|n| n.remark == Remark::Letters);
    let word = |note: &&Note| {
        let run = text.get(note.start..note.end).unwrap_or_default();
        run.len() > 2 && formula::is_in(WORDS, run)
    };
    let note = split.clone().find(word)?;
    let word = &text[note.start..note.end];
    let message = format!("`{word}` is a word and no product of its letters");
    let hint = "give the formula alone, with signs such as >= for what words say";
    Some(*Fault::new(message, note.start, note.end).hint(hint))
}

/// Whether a text multiplies letters as vectors: with ×, or with a dot where the expected formula multiplies vectors, unless
/// arrows tell vectors from sizes.
fn multiplies_letters(key: &Key, text: &str, usual: Option<&Reading>) -> bool {
    let has = |signs: &[&str]| signs.iter().any(|sign| text.contains(sign));
    let crossed = match usual {
        Some(reading) => reading.notes.iter().any(|n| n.remark == Remark::Cross),
        None => has(&["×", "\\times"]),
    };
    let dotted = || has(&["·", "\\cdot", "⋅"]) && !has(&ARROWS);
    let mut sides = key.reading.written.iter();
    crossed || dotted() && sides.any(Written::multiplies_vectors)
}

/// A text with letters for the vectors that the expected formula writes with arrows over them.
fn arrows_put(key: &Key, text: &str) -> Option<Reading> {
    let names = key.reading.symbols();
    let stems = names.iter().map(|name| match formula::is_component(name) {
        true => &name[..name.len() - 2],
        false => name,
    });
    let mut arrows: Vec<&str> = stems.filter(|name| formula::has_components(name)).collect();
    arrows.dedup();
    let mut symbols = key.readable.clone();
    for arrow in &arrows {
        let plain = arrow.replacen("_vec", "", 1).replacen("_hat", "", 1);
        if !names.contains(&*plain) {
            symbols.declare_as(*arrow, Some(&formula::latex_name(&plain)), None);
        }
    }
    (!arrows.is_empty()).then(|| formula::read(text, &symbols).ok())?
}

/// A text with letters for the directions.
fn along_axes(text: &str, symbols: &Symbols) -> Option<Reading> {
    let letters = |axes: &[&str; 2]| {
        let mut letters = axes.iter().flat_map(|axis| axis.chars());
        letters.all(|letter| text.contains(letter))
    };
    AXES.iter()
        .any(letters)
        .then(|| formula::read(text, &symbols.clone().with_lists().with_axes()).ok())?
}

/// Whether a text is read in the same way once its names are declared: there was nothing to choose, no unit, and every
/// name is one letter, Latin or Greek, with digits at most.
pub(super) fn is_stable(reading: &Reading) -> bool {
    let plain = |name: &Symbol| {
        let base = name.trim_end_matches(|c: char| c.is_ascii_digit());
        base.len() == 1 || base == "pi" || formula::is_greek(base)
    };
    let scalar = matches!(reading.content, Content::Scalar(_)) && reading.unit.is_none();
    scalar
        && reading.choices == 0
        && reading.notes.is_empty()
        && reading.content.expr().is_some_and(|e| {
            let mut names = e.parts().filter_map(Expr::as_symbol);
            names.all(plain)
        })
}

/// A number beside a condition that says of something else what it is: `v = 3 m/s at t = 2 s`. A formula, which may be right in
/// that case alone, is not read so.
fn beside_condition(key: &Key, text: &str) -> Option<Reading> {
    let ([answered, name, value], [start, end]) = formula::beside_condition(text)?;
    let open = Symbols::open();
    let name = formula::read(name, &open).ok()?;
    let name = name.expr()?.as_symbol()?.clone();
    let number = |content: &Content| content.expr().is_some_and(Expr::is_constant);
    let value = formula::read(value, &Symbols::strict()).ok()?;
    let mut reading = answer(key, answered).ok()?;
    let free = |reading: &Reading| !reading.symbols().contains(&name);
    if !number(&value.content) || !number(reading.content.answer()) {
        return None;
    }
    reading.notes.push(Note {
        remark: Remark::Words,
        start,
        middle: start,
        end,
    });
    (free(&reading) && free(&key.reading)).then_some(reading)
}

/// The fault where all sides of an equation are the same as they stand, where one is asked for: `1 = 1` for `x = 1`.
fn says_nothing(key: &Key, text: &str) -> Option<Fault> {
    let mut sides = text.split('=').map(|side| side.trim_matches([' ', '$']));
    let first = sides.next().unwrap_or_default();
    let named = match &key.reading.content {
        Content::Relations(sides, _) => sides.first() != sides.last(),
        other => matches!(other, Content::Joined(..)),
    };
    let whole = !first.is_empty() && !first.ends_with(['<', '>', '!', ':']);
    let mut others = sides.peekable();
    let same = named && whole && others.peek().is_some() && others.all(|side| side == first);
    let fault = Fault::new("both sides are the same", 0, text.len());
    same.then(|| *fault.hint("say what the name is equal to"))
}

/// Whether a letter is a name before it is a unit.
fn is_named(key: &Key, letter: &str) -> bool {
    let name = Symbol::from(letter);
    is_stranger(&name) || declared(key, &name)
}

/// Reads an answer.
pub(super) fn answer(key: &Key, text: &str) -> Result<Reading, Fault> {
    if let (Some((value, mine)), Some(theirs)) = (sense(text), key.direction)
        && (mine == theirs || mine == theirs.map(|part| -part))
    {
        return answer(key, &with_sign(value, mine == theirs));
    }
    if let Some(fault) = direction(text).or_else(|| says_nothing(key, text)) {
        return Err(fault);
    }
    if let Some(reading) = with_definitions(key, text).or_else(|| beside_condition(key, text)) {
        return Ok(reading);
    }
    if let Some(text) = unit_of_name(text)
        && let Ok(reading) = answer(key, &text)
    {
        return Ok(reading);
    }
    let mut usual = formula::read(text, &key.readable);
    if let Ok(reading) = &usual
        && let Some(places) = misfit(key, text, reading)
        && (places.len() == 1 || places.iter().all(|at| is_named(key, &text[*at..=*at])))
    {
        let mut product = text.to_string();
        places.iter().rev().for_each(|at| product.insert(*at, '*'));
        if let Ok(product) = answer(key, &product) {
            return Ok(product);
        }
    }
    // `between 0 and 1` says nothing of its ends.
    if let Ok(Reading {
        content: Content::Relations(_, signs),
        notes,
        ..
    }) = &mut usual
        && notes.iter().any(|n| n.remark == Remark::Between)
        && includes_ends(&key.reading.content)
    {
        signs.fill(Relation::LessEqual);
    }
    // `(0, 1)` and `[0, 1]`, where bounds are asked.
    let bounded = |reading: &Reading| reading.content.is_bounded();
    if bounded(&key.reading)
        && !usual.as_ref().is_ok_and(bounded)
        && let Some(range) = formula::read_interval(text, &key.readable)
    {
        usual = Ok(range);
    }
    // `2,3` and `(2, 3)`, where several values are asked.
    if matches!(key.reading.content.answer(), Content::Either(_))
        && !usual.as_ref().is_ok_and(either)
        && text.contains(',')
    {
        let inside = text.trim().strip_prefix('(');
        let inside = inside.and_then(|rest| rest.strip_suffix(')'));
        let spaced = inside.unwrap_or(text).replace(',', ", ");
        let spaced = formula::read(&spaced, &key.readable);
        usual = spaced.ok().filter(either).map_or(usual, Ok);
    }
    if usual.is_err()
        && let Some(named) = named_in_order(key, text)
        && let Ok(reading) = formula::read(&named, &key.readable)
    {
        return worded(key, &named, reading);
    }
    // A result in each line, where several are asked.
    if matches!(key.reading.content, Content::Joined(..))
        && let Some(spaced) = formula::lines_apart(text)
        && let Ok(reading) = formula::read(&spaced, &key.readable)
        && matches!(reading.content, Content::Joined(..))
    {
        return worded(key, &spaced, reading);
    }
    // `r × p`, where the expected formula has arrows over these letters.
    if multiplies_letters(key, text, usual.as_ref().ok())
        && let Some(reading) = arrows_put(key, text)
    {
        return worded(key, text, reading);
    }
    if !usual.as_ref().is_ok_and(vector)
        && let Some((text, reading)) = as_vector(key, text)
    {
        return worded(key, &text, reading);
    }
    // `2000 g` for `m = 2 kg`: where a quantity is asked, a letter behind a number is a unit if it can be one.
    if quantitative(&key.reading) && !usual.as_ref().is_ok_and(quantitative) {
        let strict = with_names(Symbols::strict(), &key.question);
        if let Ok(reading) = formula::read(text, &strict)
            && quantitative(&reading)
        {
            return worded(key, text, reading);
        }
    }
    match usual {
        Ok(reading) => worded(key, text, reading),
        Err(fault) => mended(key, text, fault),
    }
}

/// An answer without the words in brackets behind it, `v_1 = m v/(m+M) (by conservation of momentum)`: none that could change it,
/// such as `(if e = 1)` or `(negative)`, and no name.
fn without_remark(text: &str) -> Option<&str> {
    let (before, inside) = text.trim_end().strip_suffix(')')?.rsplit_once(" (")?;
    let words: Vec<&str> = inside.split(' ').collect();
    let is_word = |word: &&str| {
        let word = word.trim_end_matches([',', '.']);
        let plain = word.len() > 1 || word == "a";
        plain && word.chars().all(|c| c.is_alphabetic() && c.is_lowercase())
    };
    const CONDITIONS: &str = "when where while for upward upwards down downward downwards up left right clockwise \
        counterclockwise anticlockwise approximately about roughly each both";
    let changes = |word: &&str| formula::changes(word) || formula::among(CONDITIONS, word);
    let is_remark = words.iter().all(is_word) && !words.iter().any(changes);
    (is_remark && words.iter().any(|word| word.len() > 2)).then_some(before)
}

/// Where a vector is asked, `(2,3)` and `2, 3` are one, and so is `2i + 3j`.
fn as_vector(key: &Key, text: &str) -> Option<(String, Reading)> {
    let content = &key.reading.content;
    let several = matches!(content, Content::Joined(..)) && !content.is_bounded();
    if !several && !vector(&key.reading) {
        return None;
    }
    let lists = key.readable.clone().with_lists();
    let axes = lists.clone().with_axes();
    let bare = !several && !text.contains(['±', '=']) && has_open_comma(text);
    let bare = bare.then(|| (format!("({text})"), &lists));
    let mut all = [&lists, &axes]
        .map(|names| (text.to_string(), names))
        .into_iter()
        .chain(bare);
    all.find_map(|(text, names)| {
        let reading = formula::read(&text, names).ok().filter(vector)?;
        Some((text, reading))
    })
}

/// Whether a comma or a semicolon stands outside all brackets.
fn has_open_comma(text: &str) -> bool {
    let mut depth = 0;
    text.chars().any(|c| {
        depth += i32::from("([{".contains(c)) - i32::from(")]}".contains(c));
        depth == 0 && matches!(c, ',' | ';')
    })
}

/// Whether a bound belongs to what it bounds.
fn includes_ends(content: &Content) -> bool {
    let closed = |sign: &Relation| matches!(sign, Relation::LessEqual | Relation::GreaterEqual);
    match content {
        Content::Relations(_, signs) => signs.iter().any(closed),
        Content::Joined(_, parts) => parts.iter().any(includes_ends),
        _ => false,
    }
}

/// An answer that cannot be read as it stands: by names of its own, or without a remark behind it.
fn mended(key: &Key, text: &str, fault: Fault) -> Result<Reading, Fault> {
    by_own_names(key, text, fault).or_else(|fault| {
        let plain = without_remark(text).and_then(|plain| answer(key, plain).ok());
        plain.ok_or(fault)
    })
}

/// An answer that cannot be read with the names of its question alone: with a unit apart, or names of its own.
fn by_own_names(key: &Key, text: &str, fault: Fault) -> Result<Reading, Fault> {
    let numbered = text.contains(|c: char| c.is_ascii_digit())
        && !text.trim().starts_with(char::is_alphabetic);
    if quantitative(&key.reading) && !numbered && dimension::unit(text.trim()).is_ok() {
        let fault = Fault::new("a unit without a number", 0, text.len());
        return Err(*fault.hint("the value is missing"));
    }
    if !key.question.closed {
        return Err(fault);
    }
    let measured = quantitative(&key.reading);
    if measured && let Some(reading) = unit_apart(key, text) {
        return Ok(reading);
    }
    let open = with_names(Symbols::open(), &key.question);
    let Ok(reading) = formula::read(text, &open) else {
        return Err(fault);
    };
    let first = |content: &Content| match content {
        Content::Relations(sides, _) => {
            let mut names = sides.iter().filter_map(|side| side.name());
            names.next().cloned()
        }
        _ => None,
    };
    // `v_1 = 2 m/s, v_2 = 3 m/s` for two values without names.
    if let Content::Joined(_, parts) = &reading.content {
        let mut symbols = key.readable.clone();
        let names = parts.iter().filter_map(first);
        names.for_each(|name| symbols.declare(&name));
        return formula::read(text, &symbols).map_err(|_| fault);
    }
    let left = first(&reading.content);
    let strange = |name: &Symbol| is_stranger(name) || left.as_ref() == Some(name);
    let split = reading.notes.iter().any(|n| n.remark == Remark::Letters);
    let named_quantity = measured && left.is_some();
    let known = |name: &Symbol| declared(key, name) || strange(name);
    // `v = \sqrt{2gh} = 14 m/s`: the number at the end is the answer.
    let signs = ["=", "≈", "\\approx"].map(|sign| Some((text.rfind(sign)?, sign.len())));
    if measured && let Some((at, sign)) = signs.into_iter().flatten().max() {
        let last = format!("{}{}", " ".repeat(at + sign), &text[at + sign..]);
        if let Ok(reading) = formula::read(&last, &key.readable)
            && reading.symbols().is_empty()
            && (["=", "≈", "\\approx"]
                .iter()
                .any(|sign| text[..at].contains(sign))
                || is_size(&text[..at])
                || computes(&text[..at], &open))
        {
            return match is_chain(key, text, &open) {
                true => Ok(with_middle(key, text, reading, left)),
                false => {
                    let fault = Fault::new("words between two formulas", 0, text.len());
                    Err(*fault.hint("give the formula alone"))
                }
            };
        }
    }
    if !split && !named_quantity && reading.symbols().iter().all(known) {
        return Ok(reading);
    }
    // `v = 5 m/s`, where v is not declared and m is the unit.
    let named = left.filter(|name| !declared(key, name)).and_then(|name| {
        let mut symbols = key.readable.clone();
        symbols.declare(&name);
        formula::read(text, &symbols).ok()
    });
    named.ok_or(fault)
}

/// Whether what stands between the signs of the last statement are formulas, without a word that could deny it or begin
/// another: `F = 5 N, not F = 2 N`.
fn is_chain(key: &Key, text: &str, open: &Symbols) -> bool {
    let plain = formula::concluded(text).replace("\\approx", "≈");
    let pieces: Vec<&str> = plain.split(['=', '≈']).collect();
    let split = |note: &Note| matches!(note.remark, Remark::Letters | Remark::Words);
    let formula = |piece: &&str, symbols: &Symbols| {
        formula::read(piece, symbols).is_ok_and(|reading| !reading.notes.iter().any(split))
    };
    let (Some(first), Some(middle)) = (pieces.first(), pieces.get(1..pieces.len() - 1)) else {
        return true;
    };
    let mut words = first.split(|c: char| !c.is_alphabetic() && !"'’".contains(c));
    let readable = |piece: &&str| formula(piece, &key.readable) || formula(piece, open);
    !words.any(formula::changes) && middle.iter().all(readable)
}

/// The number at the end of a chain with the numbers in its middle, which it has to equal.
fn with_middle(key: &Key, text: &str, last: Reading, name: Option<Symbol>) -> Reading {
    let asked = match &key.reading.content {
        Content::Relations(sides, _) => sides[0].name().cloned(),
        _ => None,
    };
    let name = asked.or(name).map(|name| Expr::symbol(&name));
    let plain = formula::concluded(text).replace("\\approx", "≈");
    let pieces: Vec<&str> = plain.split(['=', '≈']).collect();
    let number = |piece: &&str| {
        let reading = formula::read(piece, &key.readable).ok()?;
        let plain = matches!(reading.content, Content::Scalar(_) | Content::Quantity(_));
        (plain && reading.symbols().is_empty()).then_some(reading.content)
    };
    let middle = pieces.get(1..pieces.len() - 1).into_iter().flatten();
    let mut sides: Vec<Content> = name.map(Content::Scalar).into_iter().collect();
    let before = sides.len();
    sides.extend(middle.filter_map(number));
    if sides.len() == before {
        return last;
    }
    sides.push(last.content.clone());
    let signs = vec![Relation::Equal; sides.len() - 1];
    last.with(Content::Relations(sides, signs))
}

/// Whether a side is worked out in what follows, as in `\sqrt{2gh} = 14 m/s`; with one symbol it would be an equation for it.
fn computes(side: &str, open: &Symbols) -> bool {
    formula::read(side, open).is_ok_and(|reading| {
        let split = |note: &Note| matches!(note.remark, Remark::Letters | Remark::Words);
        let value = reading.content.expr().is_some();
        value && reading.symbols().len() > 1 && !reading.notes.iter().any(split)
    })
}

/// Whether a side is the size of something, as in `|v| = 5 m/s`.
fn is_size(side: &str) -> bool {
    let side = side
        .trim()
        .trim_start_matches("\\left")
        .trim_end_matches("\\right|");
    let bars = ["|", "\\|", "\\lVert", "\\lvert", "‖"];
    bars.iter().any(|bar| side.starts_with(bar)) && !side.contains(['+', '-'])
}

/// `x''` for `\ddot x`; `dv = a dt` for `a = dv/dt`, and `F = dp/dt` for `F dt = dp`: the derivative by the time is the quotient of the
/// differentials, and an answer is put in the terms of its key.
pub(super) fn differentials(key: &Key, reading: &mut Reading) {
    let (known, mine) = (key.reading.symbols(), reading.symbols());
    let dt = Expr::symbol("dt");
    let mut same = BTreeMap::new();
    for (names, others) in [(&known, &mine), (&mine, &known)] {
        for name in names.iter().filter(|name| name.ends_with("_dot")) {
            let differential = format!("d{}", name.trim_end_matches("_dot"));
            if others.contains("dt") && others.contains(&*differential) && !others.contains(name) {
                let (rate, change) = (Expr::symbol(name), Expr::symbol(&differential));
                match std::ptr::eq(names, &known) {
                    true => same.insert(Symbol::from(differential), &rate * &dt),
                    false => same.insert(name.clone(), &change / &dt),
                };
            }
        }
    }
    for name in mine.iter().filter(|name| !known.contains(*name)) {
        let dotted = match name.split_once('\'') {
            Some((base, "" | "(t)")) => format!("{base}_dot"),
            Some((base, "'" | "'(t)")) => format!("{base}_ddot"),
            _ => continue,
        };
        if known.contains(&*dotted) {
            same.insert(name.clone(), Expr::symbol(&dotted));
        }
    }
    // A single prime of the key may as well speak of the moment after.
    for name in known.iter().filter(|name| !mine.contains(*name)) {
        let twice = name.strip_suffix("''").map(|base| format!("{base}_ddot"));
        if let Some(dotted) = twice.filter(|dotted| mine.contains(&**dotted)) {
            same.insert(Symbol::from(dotted), Expr::symbol(name));
        }
    }
    if !same.is_empty() {
        reading.content = reading.content.map(&|e| e.substitute(&same));
    }
}

/// The size of a vector by its letter without the arrow, `ω²` for `ω⃗·ω⃗`, where `components` of that vector are known and the
/// letter is nothing else.
pub(super) fn sizes<'a>(
    content: &Content,
    known: impl Iterator<Item = &'a Symbol>,
) -> Option<Content> {
    let (components, known): (Vec<&Symbol>, Vec<&Symbol>) =
        known.partition(|name| formula::is_component(name));
    if components.is_empty() {
        return None;
    }
    let size = |name: Symbol| {
        let arrow = formula::with_arrow(&name)?;
        let along = formula::along_axes(&arrow);
        let here = components.iter().any(|c| along.contains(c));
        let squares = along.map(|c| Expr::symbol(&c).powi(2));
        here.then(|| (name, Expr::sum(squares.to_vec()).sqrt()))
    };
    let free = content
        .symbols()
        .into_iter()
        .filter(|name| !known.contains(&name));
    let same: BTreeMap<Symbol, Expr> = free.filter_map(size).collect();
    (!same.is_empty()).then(|| content.map(&|e| e.substitute(&same)))
}

fn declared(key: &Key, name: &Symbol) -> bool {
    key.question.given().any(|g| g.name == *name)
}

fn quantitative(reading: &Reading) -> bool {
    matches!(reading.content.answer(), Content::Quantity(_))
}

fn either(reading: &Reading) -> bool {
    matches!(reading.content.answer(), Content::Either(_))
}

fn vector(reading: &Reading) -> bool {
    matches!(
        reading.content.answer(),
        Content::Vector(_) | Content::Matrix(_)
    )
}

/// Refuses a word that was read letter by letter although its letters are no names of the question.
fn worded(key: &Key, text: &str, reading: Reading) -> Result<Reading, Fault> {
    for note in reading.notes.iter().filter(|n| n.remark == Remark::Letters) {
        let letters = text.get(note.start..note.end).unwrap_or_default();
        let strange = |c: &char| {
            let name = Symbol::from(c.to_string().as_str());
            !declared(key, &name) && !is_stranger(&name)
        };
        if letters.chars().filter(strange).count() > 1 {
            let before = text.get(..note.start).unwrap_or_default();
            let before = before.trim_end_matches(|c: char| c.is_ascii_alphabetic());
            let word = text.get(before.len()..note.end).unwrap_or_default();
            // Behind a number stands its unit.
            let numbered = before.trim_end().ends_with(|c: char| c.is_ascii_digit());
            let kind = if numbered {
                "unit known here"
            } else {
                "name of the question"
            };
            let fault = Fault::new(format!("`{word}` is no {kind}"), before.len(), note.end);
            let hint = "write * between the factors of a product; words do not belong to a formula";
            return Err(*fault.hint(hint));
        }
    }
    if is_other_word(key, text) {
        let fault = Fault::new("a word is no product of its letters", 0, text.len());
        return Err(*fault.hint("write * between the factors of a product"));
    }
    Ok(reading)
}

/// Whether letters behind a number and a space are those of the key in another order, with a vowel among them: `12 arcs` for
/// `12 cars` are words.
fn is_other_word(key: &Key, text: &str) -> bool {
    let Some((before, run)) = text.trim().rsplit_once(' ') else {
        return false;
    };
    let numbered = before.ends_with(|c: char| c.is_ascii_digit());
    let word = run.len() > 2
        && run.bytes().all(|b| b.is_ascii_lowercase())
        && run.contains(['a', 'e', 'i', 'o', 'u']);
    if !numbered || !word {
        return false;
    }
    let sorted = |word: &str| {
        let mut letters: Vec<char> = word.chars().collect();
        letters.sort_unstable();
        letters
    };
    let theirs = key.reading.written.iter().map(|side| match &side.shape {
        Shape::Product(factors) => factors
            .iter()
            .filter_map(|(_, factor)| match &factor.shape {
                Shape::Symbol(name) => Some(&**name),
                _ => None,
            })
            .collect(),
        _ => String::new(),
    });
    let mut theirs = theirs.collect::<Vec<String>>().into_iter();
    theirs.any(|theirs| theirs != run && sorted(&theirs) == sorted(run))
}
