//! Letters that a worked solution gives to what is given: `let m be the mass of the ball`, where the scene calls that M.

use super::MAX_LINES;
use crate::expr::Symbol;
use crate::formula::{self, Symbols};
use crate::scene::{Body, Scene};

/// Words that say nothing of what is spoken of.
const FILLERS: &str = "a an as be by call called can denote denoted denotes equal here is its it let of our say set that the \
    then to use we where with write";

/// Words for one kind of body.
const ALIKE: [&str; 3] = [
    "bar beam pole rod stick",
    "bob ball pellet puck",
    "board plank",
];

/// Parameters with the letters under which a page says that it speaks of them, where these are not their own.
pub(super) fn letters(scene: &Scene, page: &str) -> Vec<(Symbol, String)> {
    let mut out: Vec<(Symbol, String)> = Vec::new();
    for line in page.lines().take(MAX_LINES) {
        let mut of_masses = false;
        for piece in pieces(line) {
            let Some((letter, body)) = spoken(&piece, of_masses) else {
                continue;
            };
            of_masses = true;
            let Some(mass) = body_of(scene, &body).and_then(|body| body.mass.as_symbol()) else {
                continue;
            };
            // What is asked keeps its name, and what is said of a letter last does not count for what stands above it.
            let taken = scene.question(&letter).is_some() || out.iter().any(|(_, l)| *l == letter);
            if !taken {
                out.push((mass.clone(), letter));
            }
        }
    }
    let mut symbols = Symbols::strict();
    scene.declare_parameters(&mut symbols);
    let is_new = |(name, letter): &(Symbol, String)| {
        formula::read_name(letter, &symbols).is_none_or(|own| own != *name)
    };
    match out.iter().any(is_new) {
        true => out,
        false => Vec::new(),
    }
}

/// The parts of a line that may each say what a letter is.
fn pieces(line: &str) -> Vec<String> {
    let plain = line
        .replace(['$', '*'], "")
        .replace("\\(", "")
        .replace("\\)", "");
    let plain = plain
        .replace(" and ", ", ")
        .replace(['(', ')', ';', '.'], ",");
    plain
        .split(',')
        .map(|piece| piece.trim().to_string())
        .collect()
}

/// A letter and the words for the body whose mass it is: `m be the mass of the ball`, `the mass of the ball is m`; after one of
/// a mass, `M that of the rod`.
fn spoken(piece: &str, of_masses: bool) -> Option<(String, Vec<String>)> {
    let lower = piece.to_lowercase();
    let that = || {
        lower
            .find("that of ")
            .filter(|_| of_masses)
            .map(|at| (at, "that of ".len()))
    };
    let (at, length) = lower
        .find("mass of ")
        .map(|at| (at, "mass of ".len()))
        .or_else(that)?;
    let words = |text: &str| -> Vec<String> {
        let parts = text.split([' ', '=', ':', '-', '—']);
        let says = |word: &&str| !formula::is_in(FILLERS, word) || *word == "A";
        let parts = parts.filter(|word| !word.is_empty() && says(word));
        parts.map(str::to_string).collect()
    };
    let before = words(piece.get(..at)?);
    let behind = piece.get(at + length..)?;
    if let [letter] = before.as_slice() {
        return is_letter(letter).then(|| (letter.clone(), words(behind)));
    }
    let verbs = [" be ", " is ", " = "];
    let (body, letter) = verbs.iter().find_map(|verb| behind.split_once(verb))?;
    let letter = letter.trim();
    (before.is_empty() && is_letter(letter)).then(|| (letter.to_string(), words(body)))
}

/// Whether a word is a letter, with an index at most.
fn is_letter(word: &str) -> bool {
    let name = formula::read_name(word, &Symbols::open());
    let (base, index) = word.split_once('_').unwrap_or((word, ""));
    let short = base.chars().count() == 1 || base.starts_with('\\');
    name.is_some() && short && index.len() < 10
}

/// The one body of a scene of which words speak: by its name, or by another word for one of its kind.
fn body_of<'s>(scene: &'s Scene, words: &[String]) -> Option<&'s Body> {
    let words: Vec<String> = words.iter().map(|word| word.to_lowercase()).collect();
    let says = |name: &str, alike: bool| {
        let is = |word: &String| {
            let kind = ALIKE.iter().find(|kind| formula::among(kind, name));
            word == name || alike && kind.is_some_and(|kind| formula::among(kind, word))
        };
        words.iter().any(is)
    };
    let named = |alike: bool| {
        let bodies = scene.bodies.iter().filter(|body| !body.is_fixed());
        let mut all = bodies.filter(|body| {
            let name = body.name.to_lowercase();
            let mut parts = name.split([' ', '_']);
            parts.all(|part| says(part, alike))
        });
        let first = all.next()?;
        all.next().is_none().then_some(first)
    };
    let plain = words
        .iter()
        .all(|w| !["both", "each", "total", "all", "other", "together"].contains(&w.as_str()));
    named(false).or_else(|| named(true)).filter(|_| plain)
}
