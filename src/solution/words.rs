//! How bodies, points and quantities are called in a sentence, and which LaTeX of a scene may be set as it stands.

use super::{Inline, Math, Meaning, Name};
use crate::derive::Derivation;
use crate::dimension;
use crate::expr::{Expr, Point, Symbol};
pub use crate::formula::{capital, digits, either, listed};
use crate::laws::{Place, Unknown};
use crate::scene::{Parameter, Scene, with_noun};
use crate::verify::Proof;

/// `the bar`, `ball 1`, `body A`, `the upper body`.
pub fn body(scene: &Scene, b: usize) -> String {
    scene.bodies[b].called()
}

/// A contact, hinge or blow by its name: letters stand as they are, words get an article and, where they need one, a noun.
pub fn place(name: &str, noun: &str) -> String {
    let is_word = name.starts_with(|c: char| c.is_lowercase()) && name.chars().count() > 2;
    if !is_word || name.contains(|c: char| c.is_ascii_digit()) {
        return name.replace('_', "");
    }
    with_noun(format!("the {}", name.replace('_', " ")), noun)
}

/// `the bar and the ball`.
pub fn bodies(scene: &Scene, system: &[usize]) -> String {
    listed(&system.iter().map(|b| body(scene, *b)).collect::<Vec<_>>())
}

/// A stage by its name: “Fall”.
pub fn stage(name: &str) -> String {
    format!("“{}”", capital(&name.replace('_', " ")))
}

/// A number up to twelve in words.
pub fn count(n: usize) -> String {
    const WORDS: [&str; 13] = [
        "no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten",
        "eleven", "twelve",
    ];
    WORDS.get(n).map_or(n.to_string(), |w| (*w).to_string())
}

/// `first order`, `order 4`.
pub fn order(n: u32) -> String {
    match ["zeroth", "first", "second", "third"].get(n as usize) {
        Some(word) => format!("{word} order"),
        None => format!("order {n}"),
    }
}

/// The letter of a point: its own name, or `G` for the center of mass of the only body that moves.
pub fn point(scene: &Scene, place: Place) -> String {
    match place {
        Place::Center(b) => center(scene, b),
        Place::Contact(c) => scene.contacts[c].name.clone(),
        Place::Hinge(h) => scene.hinges[h].name.clone(),
        Place::Blow(b) => scene.blows[b].name.clone(),
    }
}

/// The letter of a center of mass.
pub fn center(scene: &Scene, b: usize) -> String {
    let moving = scene.moving().count();
    let body = &scene.bodies[b];
    if moving == 1 && !body.is_fixed() && !body.is_particle() {
        String::from("G")
    } else {
        scene.bodies[b].name.clone()
    }
}

/// A point in a sentence.
pub fn at(scene: &Scene, place: Place) -> String {
    match place {
        Place::Center(b) if scene.bodies[b].is_particle() => body(scene, b),
        Place::Center(b) => {
            let moving = scene.moving().count();
            if moving == 1 {
                String::from("its center of mass G")
            } else {
                format!("the center of mass of {}", body(scene, b))
            }
        }
        Place::Contact(c) => self::place(&scene.contacts[c].name, "contact"),
        Place::Hinge(h) => self::place(&scene.hinges[h].name, "hinge"),
        Place::Blow(i) => self::place(&scene.blows[i].name, "blow"),
    }
}

/// The point of a balance of angular momentum in a sentence that names its bodies.
pub fn about(scene: &Scene, system: &[usize], place: Place) -> String {
    match (place, system) {
        (Place::Center(b), [only]) if b == *only => String::from("its center of mass"),
        _ => at(scene, place),
    }
}

/// A quantity of the textbook.
pub fn name(letter: &'static str, index: &str, mark: &'static str, vector: bool) -> Math {
    Math::Name(Name {
        letter,
        index: index.to_string(),
        mark,
        vector,
    })
}

/// Kinetic energy, of one body where the index names it: E_K, for T is as often a tension, a time or a point.
pub fn kinetic(index: &str, mark: &'static str) -> Math {
    let index = match index {
        "" => String::from("K"),
        body => format!("K,{body}"),
    };
    name("E", &index, mark, false)
}

/// The angular velocity of a body as a vector, with an index where several bodies move.
pub fn spin(scene: &Scene, b: usize, mark: &'static str) -> Math {
    let index = center(scene, b);
    let index = if index == "G" { "" } else { &index };
    vector("omega", index, mark)
}

/// `Here m is the mass and ℓ is the length.` With the values that the scene gives: `the mass (2 kg)`.
pub fn meant(scene: &Scene, values: bool) -> Option<Vec<Inline>> {
    let meant: Vec<_> = scene
        .parameters
        .iter()
        .filter(|p| !p.meaning.is_empty())
        .collect();
    if meant.is_empty() {
        return None;
    }
    let mut text = vec![say("Here ")];
    for (i, p) in meant.iter().enumerate() {
        text.push(formula(&Expr::symbol(&p.name)));
        let own = ["a ", "an ", "the ", "half ", "twice ", "one "];
        let is_own = own.iter().any(|w| p.meaning.starts_with(w));
        let article = match p.meaning.starts_with(char::is_lowercase) && !is_own {
            true => "the ",
            false => "",
        };
        let end = match meant.len() - i {
            1 => ".",
            2 => " and ",
            _ => ", ",
        };
        text.push(say(format!(" is {article}")));
        text.extend(with_symbols(scene, &p.meaning));
        if let Some(value) = value(p).filter(|_| values) {
            text.extend([say(" ("), value, say(")")]);
        }
        text.push(say(end));
    }
    Some(text)
}

/// The value that the scene gives a parameter, with its unit.
pub fn value(p: &Parameter) -> Option<Inline> {
    let value = p.value.as_ref()?;
    Some(match value.as_number().map(crate::expr::number::to_f64) {
        // As the scene writes it: a moment is so many N m.
        Some(number) if is_plain(&p.unit) => {
            let one = p
                .scale()
                .as_number()
                .map_or(1.0, crate::expr::number::to_f64);
            let unit = p.unit.replace("^2", "²").replace("^3", "³");
            say(format!("{} {unit}", digits(number / one)))
        }
        Some(number) => say(match p.dimension.spoken().as_str() {
            "1" => digits(number),
            unit => format!("{} {unit}", digits(number)),
        }),
        // Degrees and turns hold π, which their numbers do not.
        None if !p.scale().is_one() => {
            let at = Point::<f64>::default();
            let number = digits(value.evaluate(&at)? / p.scale().evaluate(&at)?);
            match p.unit.starts_with("deg") {
                true => say(format!("{number}°")),
                false => say(format!("{number} {}", p.unit)),
            }
        }
        None => formula(value),
    })
}

/// Whether a unit reads as it is typed.
fn is_plain(unit: &str) -> bool {
    let higher = unit.replace("^2", "").replace("^3", "");
    unit.starts_with(char::is_alphabetic) && !higher.contains(['^', '*', '('])
}

/// Words of two letters that are no symbols in a sentence.
const WORDS: [&str; 20] = [
    "am", "an", "as", "at", "be", "by", "do", "go", "he", "if", "in", "is", "it", "no", "of", "on",
    "or", "so", "to", "up",
];

/// Words in which the names of parameters stand as their symbols, with a number before and a divisor behind: 2b, d/2.
pub fn with_symbols(scene: &Scene, text: &str) -> Vec<Inline> {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    let mut out = Vec::new();
    let mut words = String::new();
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        if !is_part(c) {
            words.push(c);
            rest = &rest[c.len_utf8()..];
            continue;
        }
        let end = rest.find(|c: char| !is_part(c)).unwrap_or(rest.len());
        let (whole, after) = rest.split_at(end);
        rest = after;
        let word = whole.trim_start_matches(|c: char| c.is_ascii_digit());
        let is_factor = word.len() < whole.len();
        let in_formula = is_factor || word == "a" && !is_article(after);
        let symbol = symbol_in(scene, word, in_formula);
        let Some(symbol) = symbol.filter(|_| !is_unit(&words, word, after)) else {
            words.push_str(whole);
            continue;
        };
        let number = |digits: &str| digits.parse::<i64>().ok().map(Expr::from);
        let (power, after) = raised(after);
        rest = after;
        let symbol = symbol.power(Expr::from(power));
        let factor = number(&whole[..whole.len() - word.len()]).unwrap_or_else(Expr::one);
        let below = after.strip_prefix('/').unwrap_or("");
        let digits = below
            .find(|c: char| !c.is_ascii_digit())
            .unwrap_or(below.len());
        let (divisor, behind) = below.split_at(digits);
        let divisor = number(divisor).filter(|n| !n.is_zero() && !behind.starts_with(is_part));
        if divisor.is_some() {
            rest = behind;
        }
        out.push(say(std::mem::take(&mut words)));
        let one = Expr::one();
        out.push(formula(&(&factor * &symbol / divisor.unwrap_or(one))));
    }
    out.push(say(words));
    out
}

/// The power behind a symbol, `^2`, and what follows.
fn raised(after: &str) -> (i64, &str) {
    let digits = after.strip_prefix('^').unwrap_or("");
    let end = digits.find(|c: char| !c.is_ascii_digit());
    let (digits, behind) = digits.split_at(end.unwrap_or(digits.len()));
    match digits.parse() {
        Ok(power) if !behind.starts_with(char::is_alphabetic) => (power, behind),
        _ => (1, after),
    }
}

/// Words that no article stands before.
const NO_NOUNS: [&str; 20] = [
    "above", "and", "are", "as", "at", "below", "beside", "for", "from", "in", "is", "lies", "of",
    "off", "on", "or", "over", "to", "when", "with",
];

/// Whether an a is the article of what follows it, and not a letter.
fn is_article(after: &str) -> bool {
    let Some(next) = after.strip_prefix(char::is_whitespace) else {
        return false;
    };
    let end = next.find(|c: char| !c.is_alphanumeric() && c != '-');
    !NO_NOUNS.contains(&&next[..end.unwrap_or(next.len())])
}

/// Whether a word is the beginning of a unit behind a number: the m of `120 m/s`.
fn is_unit(before: &str, word: &str, after: &str) -> bool {
    let below = after.strip_prefix('/').unwrap_or("");
    let end = below.find(|c: char| !c.is_alphanumeric() && c != '^');
    let below = &below[..end.unwrap_or(below.len())];
    let words = before.strip_suffix(' ').unwrap_or("");
    let start = words.trim_end_matches(|c: char| c.is_ascii_digit() || c == '.');
    let number = words[start.len()..].parse::<f64>();
    // A body may have the mass 2 m, or 10 m, and nothing else is 200 m but a length.
    let is_long =
        number.as_ref().is_ok_and(|n| *n >= 10.0 || n.fract() > 0.0) && !start.ends_with("mass ");
    let unit = match below {
        "" if is_long => word.to_owned(),
        "" => return false,
        _ => format!("{word}/{below}"),
    };
    number.is_ok() && dimension::unit(&unit).is_ok()
}

/// The symbol that a word of a sentence stands for, as it is typed or as it is set: `omega_0`, `ω₀`. Words of the language stay
/// words unless they stand in a formula: the article a, the pronoun I, names that are spelled out.
fn symbol_in(scene: &Scene, word: &str, in_formula: bool) -> Option<Expr> {
    let set = |p: &Parameter| {
        let latex = p.latex.clone();
        crate::formula::write_unicode(&Expr::symbol(&p.name), &|_| latex.clone()) == word
    };
    let mut all = scene.parameters.iter();
    let p = match word.is_ascii() {
        true => all.find(|p| *p.name == *word)?,
        false => all.find(|p| *p.name == *word || set(p))?,
    };
    let made = crate::formula::latex_name(word);
    let typeset = p.latex.as_deref().is_some_and(is_safe_latex);
    let short = word.len() == 2 && typeset && !WORDS.contains(&word);
    let one = word.chars().count() == 1 && (in_formula || !matches!(word, "a" | "A" | "I"));
    let dotted = typeset && p.latex.iter().any(|l| l.starts_with("\\dot"));
    let indexed = word.contains(|c: char| c.is_ascii_digit() || c == '_');
    let is_symbol = !word.is_ascii()
        || short
        || dotted
        || (one || indexed || made.starts_with("\\")) && !made.starts_with("\\mathrm");
    is_symbol.then(|| Expr::symbol(&p.name))
}

/// `a, b and c` of formulas, with the word before the last one.
pub fn row(items: impl IntoIterator<Item = Inline>, last: &'static str) -> Vec<Inline> {
    let items: Vec<Inline> = items.into_iter().collect();
    let count = items.len();
    let mut out = Vec::new();
    for (i, item) in items.into_iter().enumerate() {
        if i > 0 {
            out.push(say(if i + 1 == count { last } else { ", " }));
        }
        out.push(item);
    }
    out
}

/// `a, b and c` of symbols, with the word before the last one.
pub fn symbols<'s>(names: impl IntoIterator<Item = &'s Symbol>, last: &'static str) -> Vec<Inline> {
    row(names.into_iter().map(|n| formula(&Expr::symbol(n))), last)
}

/// `e = 1, m = 0 and α = π/4`.
pub fn values(of: &[(Symbol, Expr)]) -> Vec<Inline> {
    let each = of
        .iter()
        .map(|(name, value)| equation(&Expr::symbol(name), value));
    row(each, " and ")
}

/// A condition that is given as text: its formulas set where it is a relation between such, its words otherwise.
pub fn condition(scene: &Scene, text: &str) -> Inline {
    let mut names = crate::formula::Symbols::strict();
    for p in &scene.parameters {
        names.declare(&p.name);
    }
    let read = |side: &str| crate::formula::read_expr(side.trim(), &names).ok();
    for op in ["≥", "≤", "≠", ">", "<"] {
        if let Some((left, right)) = text.split_once(op)
            && let (Some(left), Some(right)) = (read(left), read(right))
        {
            return Inline::Math(related(&left, op, &right));
        }
    }
    say(text)
}

/// How the condition begins that is a sentence by itself.
pub const AT_ONCE: &str = "all contacts act at the same instant";

/// A sentence with the next of some pieces, words or formulas, in place of each `{}`.
pub fn fill(form: &'static str, pieces: impl IntoIterator<Item = Inline>) -> Vec<Inline> {
    let mut pieces = pieces.into_iter();
    let mut out: Vec<Inline> = Vec::new();
    for (i, words) in form.split("{}").enumerate() {
        let piece = if i > 0 { pieces.next() } else { None };
        for piece in piece.into_iter().chain([say(words)]) {
            match (out.last_mut(), piece) {
                (Some(Inline::Text(before)), Inline::Text(more)) => before.push_str(&more),
                (_, piece) => out.push(piece),
            }
        }
    }
    out.retain(|piece| *piece != say(""));
    out
}

/// A formula: the next piece in place of each `{}`, brackets, and what stands between as operators.
pub fn set(form: &'static str, pieces: impl IntoIterator<Item = Math>) -> Vec<Math> {
    let mut open = vec![Vec::new()];
    let mut pieces = pieces.into_iter();
    let mut rest = form;
    while let Some(c) = rest.chars().next() {
        let width = match c {
            '{' => "{}".len(),
            '(' | ')' | ' ' => c.len_utf8(),
            _ => rest.find(['{', '(', ')', ' ']).unwrap_or(rest.len()),
        };
        let (part, behind) = rest.split_at(width);
        rest = behind;
        let piece = match c {
            ' ' => None,
            '{' => pieces.next(),
            '(' => {
                open.push(Vec::new());
                None
            }
            ')' => open.pop().map(Math::Brackets),
            _ => Some(Math::Op(part)),
        };
        if let (Some(last), Some(piece)) = (open.last_mut(), piece) {
            last.push(piece);
        }
    }
    open.swap_remove(0)
}

/// ` The impulse at A is …`, with what one or several do; nothing where there is none.
pub fn impulses_at(places: &[String], one: &str, several: &str) -> String {
    match places {
        [] => String::new(),
        [only] => format!(" The impulse at {only} {one}"),
        all => format!(" The impulses at {} {several}", listed(all)),
    }
}

/// A vector of the textbook.
pub fn vector(letter: &'static str, index: &str, mark: &'static str) -> Math {
    name(letter, index, mark, true)
}

/// Words of a sentence.
pub fn say(text: impl Into<String>) -> Inline {
    Inline::Text(text.into())
}

/// A formula in a sentence.
pub fn formula(e: &Expr) -> Inline {
    Inline::Math(vec![Math::Expr(e.clone())])
}

/// Two sides and what stands between them.
pub fn related(left: &Expr, sign: &'static str, right: &Expr) -> Vec<Math> {
    vec![left.into(), Math::Op(sign), right.into()]
}

/// An equation in a sentence.
pub fn equation(left: &Expr, right: &Expr) -> Inline {
    Inline::Math(related(left, "=", right))
}

/// What an unknown is, for another program.
pub fn meaning(scene: &Scene, unknown: Unknown, reversed: bool) -> Meaning {
    let on = |bodies: [usize; 2]| scene.bodies[bodies[usize::from(!reversed)]].name.clone();
    match unknown {
        Unknown::Velocity(b, axis) => Meaning::Velocity(scene.bodies[b].name.clone(), axis),
        Unknown::Spin(b) => Meaning::Spin(scene.bodies[b].name.clone(), reversed),
        Unknown::Contact(c, axis) => {
            let contact = &scene.contacts[c];
            Meaning::Impulse(contact.name.clone(), on(contact.bodies), Some(axis))
        }
        Unknown::Normal(c) => {
            let contact = &scene.contacts[c];
            Meaning::Impulse(contact.name.clone(), on(contact.bodies), None)
        }
        Unknown::Hinge(h, axis) => {
            let hinge = &scene.hinges[h];
            Meaning::Impulse(hinge.name.clone(), on(hinge.bodies), Some(axis))
        }
        Unknown::Blow(i) => {
            let blow = &scene.blows[i];
            let body = scene.bodies[blow.body].name.clone();
            Meaning::Impulse(blow.name.clone(), body, None)
        }
    }
}

/// Everything an answer rests on: what is said of the scene's symbols, what was divided by, what was seen and not proved.
pub fn assumptions(scene: &Scene, d: &Derivation, proof: &Proof) -> Vec<String> {
    let mut all = scene.domains.conditions();
    all.extend(d.assumptions.iter().map(ToString::to_string));
    all.extend(proof.assumptions.iter().map(ToString::to_string));
    all
}

/// Commands besides those of letters that only set a symbol; nothing here reads files, defines macros or runs anything.
const COMMANDS: &str = "vec hat bar dot ddot tilde mathrm mathbf mathit boldsymbol text prime _ ,";

/// Whether the LaTeX a scene gives for a symbol only sets a symbol: known commands, balanced braces, plain characters.
pub fn is_safe_latex(latex: &str) -> bool {
    // `^^5c` is a backslash to TeX.
    if latex.is_empty() || latex.len() > 80 || latex.contains("^^") {
        return false;
    }
    let mut depth = 0_i32;
    let mut chars = latex.chars().peekable();
    while let Some(c) = chars.next() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            '\\' => {
                let mut command = String::new();
                while let Some(letter) = chars.next_if(char::is_ascii_alphabetic) {
                    command.push(letter);
                }
                if command.is_empty() {
                    command.extend(chars.next());
                }
                let is_letter = command != "int" && crate::formula::letter(&command).is_some();
                if !is_letter && !COMMANDS.split(' ').any(|known| known == command) {
                    return false;
                }
            }
            c if c.is_alphanumeric() || "_^ ,+-*'/().".contains(c) => {}
            _ => return false,
        }
        if depth < 0 {
            return false;
        }
    }
    depth == 0
}

/// A text of the derivation in which bodies are called as they are in sentences.
pub fn named(scene: &Scene, text: &str) -> String {
    let mut out = text.to_string();
    for (b, of) in scene.bodies.iter().enumerate() {
        let tail = format!(" of {}", of.name);
        if out.ends_with(&tail) {
            out.truncate(out.len() - tail.len());
            out.push_str(&format!(" of {}", body(scene, b)));
        }
    }
    out
}
