//! Units behind numbers, plain or in LaTeX.

use super::lexer::Lexer;
use super::note::Remark;
use super::symbols::{among, letters_at, pairs};
use super::token::{Before, Tok};
use crate::dimension::{self, Unit};

/// Longest unit with its decoration, in bytes.
const LONGEST_UNIT: usize = 120;

impl Lexer<'_> {
    /// A unit below a slash behind a number, as in `2.4/s` or `2.4 1/s`.
    pub(super) fn unit_below(&mut self) -> Option<Tok> {
        let degrees = self.text[..self.pos].trim_end();
        let turned = ["°", "\\circ", "\\circ}", "deg", "∘", "\\degree", "degrees"];
        let turned = turned.iter().any(|mark| degrees.ends_with(mark));
        let behind_pi = ["π", "pi"].iter().any(|pi| degrees.ends_with(pi));
        if !matches!(self.before, Before::Number { .. }) && !turned && !behind_pi {
            return None;
        }
        let start = self.pos;
        let side = self.rest_of_side()?;
        let below = side.trim_start_matches('1').strip_prefix('/')?.trim_start();
        if !below.starts_with(|c: char| c.is_ascii_alphabetic() || c == '(') {
            return None;
        }
        let below = plain_unit(below)?;
        // `2π/T` is one over a period, and no teslas.
        if behind_pi && words(&below).any(is_symbol_first) {
            return None;
        }
        let read = dimension::unit(&format!("1/{below}")).ok()?;
        self.pos = start + side.len();
        Some(Tok::Unit(Box::new(read)))
    }

    /// A group that holds a unit alone, as below the bar of `\frac{3 m}{s}`.
    pub(super) fn unit_group(&mut self) -> Option<Unit> {
        let group = self.text[self.pos..].strip_prefix('{')?;
        let ends = group.match_indices('}').map(|(at, _)| at);
        let mut ends = ends.take_while(|at| self.units_first && *at < LONGEST_UNIT);
        let whole = |at: usize| Some((at, plain_unit(&group[..at])?));
        let (end, plain) = ends.find_map(whole)?;
        let upright = group[..end].contains('\\');
        let symbol = |w| self.symbols.find(w).is_some() || !upright && is_symbol_first(w);
        let read = dimension::unit(&plain).ok();
        let read = read.filter(|_| !words(&plain).any(symbol))?;
        self.pos += end + 2;
        Some(read)
    }

    /// The text up to the next relation, where it is short enough for a unit.
    fn rest_of_side(&self) -> Option<&str> {
        let rest = &self.text[self.pos..];
        let ends = |c: char| matches!(c, '=' | '<' | '>' | '≤' | '≥' | '≠' | '≈');
        let stop = rest
            .char_indices()
            .take(LONGEST_UNIT)
            .find(|(_, c)| ends(*c))
            .map_or(rest.len(), |(at, _)| at);
        (stop <= LONGEST_UNIT).then(|| &rest[..stop])
    }

    /// `1.2 [m/s]`: a unit in square brackets behind a number.
    pub(super) fn bracketed_unit(&mut self) -> Option<Tok> {
        let inside = self.text[self.pos..].strip_prefix('[')?;
        let (inside, _) = inside
            .split_once(']')
            .filter(|(inside, _)| inside.len() < LONGEST_UNIT)?;
        let inside = inside.trim_end_matches("\\right");
        let plain = plain_unit(inside)?;
        let read = dimension::unit(&plain)
            .ok()
            .filter(|_| !words(&plain).any(|w| self.symbols.find(w).is_some()))?;
        let close = self.text[self.pos..].find(']')?;
        self.pos += close + 1;
        Some(Tok::Unit(Box::new(read)))
    }

    /// Whether nothing of the side is left behind a place.
    pub(super) fn fills_side(&self, end: usize) -> bool {
        let rest = self.text[end..].trim_start_matches(|c: char| c.is_whitespace() || c == '$');
        let relation = ["\\approx", "\\le", "\\ge", "\\ne", "\\simeq"];
        rest.is_empty()
            || rest.starts_with(['=', '<', '>', '≤', '≥', '≠', '≈'])
            || relation.iter().any(|r| rest.starts_with(r))
    }

    /// A unit that fills the rest of this side, where one can stand.
    pub(super) fn unit(&mut self, marked: bool) -> Option<Tok> {
        let start = self.pos;
        // Units win only where nothing is declared of their letters; looking is cheaper than reading them.
        if !marked {
            let side = self.rest_of_side()?;
            let free = |text| self.units_first || self.is_free(text);
            // No unit has a plus sign.
            if !self.units_first && side.contains('+') || !(side.contains('\\') || free(side)) {
                return None;
            }
            // `\frac{m}{s}` begins with no word.
            if !side.starts_with('\\') && !side.contains("\\Omega") {
                let word = first_word(side)?;
                if !free(word) || dimension::unit(word).is_err() {
                    return None;
                }
            }
        }
        let side = self.rest_of_side()?;
        let plain = plain_unit(side);
        if !marked && !self.units_first && !plain.as_deref().is_some_and(|p| self.is_free(p)) {
            return None;
        }
        let whole = plain.and_then(|plain| Some((dimension::unit(&plain).ok()?, plain)));
        let (stop, (read, plain)) = match whole {
            Some(read) => (side.len(), read),
            // Units inside a formula of numbers.
            None if self.units_first => {
                let piece = &side[..self.end_of_unit(side)?];
                let plain = plain_unit(piece)?;
                (piece.len(), (dimension::unit(&plain).ok()?, plain))
            }
            None => return None,
        };
        if !marked {
            let declared = |w: &str| is_symbol_first(w) && self.symbols.find(w).is_some();
            if words(&plain).any(declared) {
                return None;
            }
            if !self.units_first {
                // Without declarations 3 m g is a force more often than a unit, and m V a momentum; a word of four letters is a unit.
                const TELLING: &str = "kg rad deg rev revs rpm cm mm km Hz Nm Ns kN kJ MJ mph ft J N kWh MWh GWh kVA MVA kW MW kPa MPa GPa eV keV MeV bar hp uC uF uA pF nF mH mol";
                let telling = words(&plain).any(|w| among(TELLING, w) || w.len() > 3)
                    || is_unit_first(&plain)
                    || plain.contains("/s")
                    || plain.contains("s^-")
                    || plain.contains("s⁻");
                let unit_first = telling || self.before == Before::Number { decimal: true };
                let usual = self.usual();
                if unit_first != usual {
                    return None;
                }
                self.note(Remark::UnitNotSymbols, start, start, start + stop);
            }
        }
        self.pos = start + stop;
        Some(Tok::Unit(Box::new(read)))
    }

    /// Where a unit ends that does not fill its side: before a sign, a comma, a bracket that it did not open, a unit vector, or
    /// another number behind `*` or `/`.
    fn end_of_unit(&self, side: &str) -> Option<usize> {
        let mut before = ' ';
        let mut spaced = false;
        let mut depth = 0u32;
        for (at, c) in side.char_indices() {
            let command = ["\\hat", "\\vec", "\\mathbf", "\\right", "\\end"];
            match c {
                '+' | '-' | '−' | '±' if !"^{(⁻".contains(before) => return Some(at),
                ',' | ';' | ']' | '&' | 'î' | 'ĵ' => return Some(at),
                // `1 m 20 cm`, `1h30min`: no exponent has two digits.
                '0'..='9'
                    if depth == 0 && before.is_alphabetic() && (spaced || is_long(&side[at..])) =>
                {
                    return Some(at);
                }
                '\\' if command.iter().any(|c| side[at..].starts_with(c)) => return Some(at),
                '\\' if side[at..].starts_with("\\\\") => return Some(at),
                _ if depth == 0 && before != '^' && numbered(&side[at..]) => return Some(at),
                _ if depth == 0 && spaced && begins_function(&side[at..]) => return Some(at),
                'i' | 'j' | 'k' if self.is_axis(side, at) => return Some(at),
                '(' | '{' => depth += 1,
                ')' | '}' if depth == 0 => return Some(at),
                ')' | '}' => depth -= 1,
                _ => {}
            }
            spaced = c.is_whitespace();
            if !spaced {
                before = c;
            }
        }
        None
    }

    /// Whether a letter of a unit's side is the direction behind it, as in `3 m/s i`.
    fn is_axis(&self, side: &str, at: usize) -> bool {
        let alone = side[..at].ends_with(' ') && !side[at + 1..].starts_with(char::is_alphanumeric);
        alone && self.symbols.axis(&side[at..at + 1]).is_some()
    }

    /// Whether what could be a unit holds nothing that is declared, nor a letter that is a symbol first.
    fn is_free(&self, plain: &str) -> bool {
        let known = |c: char| self.symbols.find(c.encode_utf8(&mut [0; 4])).is_some();
        let first = |w| is_symbol_first(w) && !is_unit_first(plain);
        self.symbols.is_open() && !words(plain).any(|w| first(w) || w.chars().any(known))
    }
}

/// Whether a text begins with two digits.
fn is_long(text: &str) -> bool {
    text.bytes().take(2).filter(u8::is_ascii_digit).count() == 2
}

/// The runs of letters in a unit.
fn words(plain: &str) -> impl Iterator<Item = &str> {
    let words = plain.split(|c: char| !c.is_ascii_alphabetic());
    words.filter(|w| !matches!(*w, "" | "per"))
}

/// Whether a text is more often a unit than a product although nothing is declared: `μF` is, and μg and μN are not.
pub(super) fn is_unit_first(text: &str) -> bool {
    const UNITS: &str = "kΩ MΩ Å \u{212b} µA µC µF µV μA μC μF μV";
    among(UNITS, text)
}

/// Whether a letter is a symbol rather than a unit where nothing is declared: 2.5 V is two and a half volumes as well.
pub(super) fn is_symbol_first(word: &str) -> bool {
    matches!(
        word,
        "A" | "C" | "F" | "H" | "K" | "L" | "S" | "T" | "V" | "l"
    )
}

/// The unit of siunitx in plain characters: `\kilo\metre\per\second\squared`, `m.s^{-2}`.
pub(super) fn spelled(text: &str) -> String {
    const WORDS: &str = "kilogram kg metre m meter m second s gram g newton N joule J watt W pascal Pa hertz Hz radian \
        rad degree deg hour h minute min kilo k mega M giga G centi c milli m micro u nano n deci d \
        squared ^2 cubed ^3 ampere A volt V kelvin K celsius °C litre L ohm Ω";
    let mut out = String::new();
    let mut rest = text;
    let mut prefix = false;
    let mut per = false;
    while let Some(c) = rest.chars().next() {
        rest = &rest[c.len_utf8()..];
        if c != '\\' {
            out.push(if matches!(c, '.' | '~' | '{' | '}') {
                ' '
            } else {
                c
            });
            // Braces of an exponent go with it.
            continue;
        }
        let length = letters_at(rest);
        let word = &rest[..length];
        rest = &rest[length..];
        if word == "per" {
            per = true;
            continue;
        }
        let found = pairs(WORDS).find(|(long, _)| *long == word);
        let short = found.map_or(word, |(_, short)| short);
        let raised = short.starts_with('^');
        if !prefix && !raised && !out.is_empty() {
            out.push(if per { '/' } else { ' ' });
            per = false;
        }
        out.push_str(short);
        prefix = matches!(
            word,
            "kilo" | "mega" | "giga" | "centi" | "milli" | "micro" | "nano" | "deci"
        );
    }
    out.replace("^ ", "^").trim().to_string()
}

/// Whether a text begins with a sign of a product or quotient and a number behind it, in brackets or not.
pub(super) fn numbered(text: &str) -> bool {
    const SIGNS: [&str; 7] = ["*", "/", "·", "×", "⋅", "\\cdot", "\\times"];
    let behind = SIGNS.iter().find_map(|sign| text.strip_prefix(sign));
    behind.is_some_and(|behind| {
        let opened = [" ", "(", "{", "\\left", "\\frac", "\\,"];
        let mut number = behind;
        while let Some(rest) = opened.iter().find_map(|open| number.strip_prefix(open)) {
            number = rest;
        }
        number.starts_with(|c: char| c.is_ascii_digit()) || begins_function(number)
    })
}

/// Whether a text begins with a function or root, which is no unit: `10 m/s cos 60°`.
fn begins_function(text: &str) -> bool {
    let name = text.strip_prefix('\\').unwrap_or(text);
    let functions = ["sin", "cos", "tan", "cot", "sqrt", "√"];
    functions.iter().any(|function| name.starts_with(function))
}

/// The word at the start of a text, where it is short enough for a unit.
fn first_word(text: &str) -> Option<&str> {
    let letter = |c: &char| c.is_ascii_alphabetic() || "µμΩÅ\u{2126}\u{212b}".contains(*c);
    let raised = |word| text.strip_prefix(word);
    let text = raised("square ")
        .or_else(|| raised("cubic "))
        .unwrap_or(text);
    let word = text.chars().take(12).take_while(letter);
    let length = word.map(char::len_utf8).sum();
    (1..16).contains(&length).then(|| &text[..length])
}

/// Stands for `\frac` until its groups are found.
const FRACTION: char = '\u{1}';

/// The unit without LaTeX decoration.
pub(crate) fn plain_unit(side: &str) -> Option<String> {
    let mut out = String::new();
    let mut rest = side;
    while let Some(c) = rest.chars().next() {
        rest = &rest[c.len_utf8()..];
        match c {
            '\\' => {
                let length = letters_at(rest);
                let word = &rest[..length];
                rest = &rest[length..];
                match word {
                    "mathrm" | "text" | "textrm" | "textbf" | "mathsf" | "rm" => {
                        if !out.is_empty() && !out.ends_with('µ') {
                            out.push(' ');
                        }
                    }
                    "cdot" | "times" => out.push('·'),
                    "circ" => out.push('°'),
                    "mu" => {
                        out.push('µ');
                        rest = rest.trim_start();
                    }
                    "Omega" => out.push('Ω'),
                    "frac" | "dfrac" | "tfrac" => out.push(FRACTION),
                    "" => {
                        out.push(' ');
                        rest = rest.strip_prefix([',', ';', ':', '!', ' ', ')', ']'])?;
                    }
                    _ => return None,
                }
            }
            '$' => {}
            '~' => out.push(' '),
            c => out.push(c),
        }
    }
    // Braces that grouped a font; those of an exponent stay.
    let mut plain = String::new();
    let mut open = Vec::new();
    for c in out.chars() {
        match c {
            '{' => {
                let group = match plain.chars().last() {
                    Some('^') => "}",
                    Some(FRACTION) => {
                        plain.pop();
                        ")/"
                    }
                    Some('/') => ")",
                    _ => "",
                };
                open.push(group);
                match group {
                    "" => {}
                    "}" => plain.push('{'),
                    _ => plain.push('('),
                }
            }
            '}' => plain.push_str(open.pop()?),
            c => plain.push(c),
        }
    }
    // What words say behind `per` is all below it: `joules per kilogram kelvin`.
    let below =
        |part: &str| match part.trim().contains(' ') && words(part).eq(part.split_whitespace()) {
            true => format!("({part})"),
            false => part.to_string(),
        };
    let mut parts = plain.split(" per ");
    let above = parts.next().map(str::to_string);
    let plain: Vec<String> = above.into_iter().chain(parts.map(below)).collect();
    let plain = plain.join("/");
    let trimmed = plain.trim().trim_end_matches(['.', ',', ';']).trim_end();
    (open.is_empty() && !trimmed.is_empty()).then(|| trimmed.to_string())
}
