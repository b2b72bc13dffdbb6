//! Cuts a formula into tokens on demand: plain text, Unicode and LaTeX give the same ones.
//!
//! Names are resolved here against the symbols in play, because where one ends depends on them. Nothing is expanded:
//! a LaTeX command outside the list below is a fault.

use super::Relation;
use super::fault::{Fault, Faulty, is_invisible};
use super::name;
use super::note::{Note, Remark};
use super::number::{self, Exponent};
use super::symbols::{Parts, Symbols, greek_name, is_angle_name, is_greek};
use super::written::Literal;
use crate::dimension::{self, Unit};
use crate::expr::{Function, Rational, Symbol, ratio};

/// A token.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Tok {
    End,
    Number(Literal),
    Name(Symbol),
    Call(Function),
    Reciprocal(Function),
    /// A root of index 2 or 3.
    Root(i64),
    Fraction,
    Plus,
    Minus,
    PlusMinus,
    MinusPlus,
    Times,
    Slash,
    Caret,
    Raised(Rational),
    Open(char),
    Close(char),
    Bar,
    OpenBar,
    CloseBar,
    Comma,
    Relation(Relation),
    Vulgar(i64, i64),
    Degree,
    Unit(Box<Unit>),
}

/// A token and its place.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Token {
    pub tok: Tok,
    pub start: usize,
    pub end: usize,
    /// Whether a space stands before it.
    pub spaced: bool,
}

/// What stood before, as far as it decides how the next piece is read.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Before {
    Nothing,
    Number { decimal: bool },
    Value,
}

pub(crate) struct Lexer<'a> {
    pub text: &'a str,
    pub pos: usize,
    /// The next token is a TeX argument: one digit, one letter, one command or one group.
    pub single: bool,
    /// Units win over undeclared names.
    pub units_first: bool,
    /// Decisions met so far, and which of them are to be turned round.
    pub sites: u32,
    pub flips: u64,
    pub notes: Vec<Note>,
    /// Undeclared names met in open reading.
    pub found: Vec<Symbol>,
    /// Undeclared names met in strict reading.
    pub unknown: Vec<Fault>,
    symbols: &'a Symbols,
    before: Before,
    /// Whether a value stood before, so that an empty group is only a spacer.
    after_value: bool,
    /// Where the current run of letters starts, functions and Greek names apart.
    run_from: usize,
}

/// Longest unit with its decoration, in bytes.
const LONGEST_UNIT: usize = 120;
/// Most different names in one formula.
const MAX_NAMES: usize = 256;
/// Most faults reported together.
const MAX_FAULTS: usize = 8;

impl<'a> Lexer<'a> {
    pub fn new(text: &'a str, symbols: &'a Symbols, units_first: bool, flips: u64) -> Lexer<'a> {
        Lexer {
            text,
            pos: 0,
            single: false,
            units_first,
            sites: 0,
            flips,
            notes: Vec::new(),
            found: Vec::new(),
            unknown: Vec::new(),
            symbols,
            before: Before::Nothing,
            after_value: false,
            run_from: 0,
        }
    }

    /// Whether a decision is taken the usual way; each call is a place where another reading is possible.
    pub fn usual(&mut self) -> bool {
        let site = self.sites;
        self.sites += 1;
        site >= 64 || self.flips >> site & 1 == 0
    }

    pub fn note(&mut self, remark: Remark, start: usize, middle: usize, end: usize) {
        if self.notes.len() < 32 {
            self.notes.push(Note {
                remark,
                start,
                middle,
                end,
            });
        }
    }

    /// The next token.
    pub fn next(&mut self) -> Faulty<Token> {
        let spaced = self.skip_blanks()?;
        let single = std::mem::take(&mut self.single);
        let start = self.pos;
        let tok = self.token(single)?;
        self.before = match &tok {
            Tok::Number(literal) => Before::Number {
                decimal: literal.decimal,
            },
            Tok::Vulgar(..) | Tok::Close(_) | Tok::Raised(_) | Tok::Degree => Before::Value,
            Tok::Name(name) if &**name == "pi" => Before::Value,
            _ => Before::Nothing,
        };
        self.after_value = self.before != Before::Nothing || matches!(tok, Tok::Name(_));
        if let Tok::Call(_) | Tok::Reciprocal(_) | Tok::Root(_) = tok {
            self.run_from = self.pos;
        }
        Ok(Token {
            tok,
            start,
            end: self.pos,
            spaced,
        })
    }

    /// Passes over spaces and what only decorates.
    fn skip_blanks(&mut self) -> Faulty<bool> {
        let start = self.pos;
        loop {
            let rest = &self.text[self.pos..];
            let Some(c) = rest.chars().next() else { break };
            let length = match c {
                ' '
                | '\t'
                | '\n'
                | '\r'
                | '~'
                | '$'
                | '\u{a0}'
                | '\u{2000}'..='\u{200a}'
                | '\u{202f}'
                | '\u{205f}'
                | '\u{3000}' => c.len_utf8(),
                '\\' => match decoration(&rest[1..]) {
                    Some(length) => 1 + length,
                    None => break,
                },
                // An empty group: `{}^{2}`.
                '{' if rest[1..].trim_start_matches(' ').starts_with('}') && self.after_value => {
                    rest.find('}').map_or(1, |at| at + 1)
                }
                _ => break,
            };
            self.pos += length;
        }
        Ok(self.pos > start)
    }

    fn token(&mut self, single: bool) -> Faulty<Tok> {
        let rest = &self.text[self.pos..];
        let bytes = rest.as_bytes();
        let Some(&first) = bytes.first() else {
            return Ok(Tok::End);
        };
        let second = bytes.get(1).copied().unwrap_or(0);
        let (length, tok) = match first {
            b'0'..=b'9' if single => {
                let digit = i64::from(first - b'0');
                self.pos += 1;
                return Ok(Tok::Number(Literal {
                    value: ratio(digit, 1),
                    digits: 1,
                    place: 0,
                    decimal: false,
                }));
            }
            b'0'..=b'9' => return self.number(),
            b'.' if second.is_ascii_digit() => return self.number(),
            b'a'..=b'z' | b'A'..=b'Z' => return self.word(single),
            b'\\' => return self.command(single),
            b'+' if second == b'-' || rest[1..].starts_with("/-") => {
                (if second == b'-' { 2 } else { 3 }, Tok::PlusMinus)
            }
            b'+' => (1, Tok::Plus),
            b'-' if rest.starts_with("->") => {
                return Err(Fault::new(
                    "an arrow is no part of a formula",
                    self.pos,
                    self.pos + 2,
                ));
            }
            b'-' => (1, Tok::Minus),
            b'*' if second == b'*' => (2, Tok::Caret),
            b'*' => (1, Tok::Times),
            b'/' if second == b'=' => (2, Tok::Relation(Relation::NotEqual)),
            b'/' => (1, Tok::Slash),
            b'^' if degree_mark(&rest[1..]).is_some() => {
                (1 + degree_mark(&rest[1..]).unwrap_or(0), Tok::Degree)
            }
            b'^' => (1, Tok::Caret),
            b'(' | b'[' => (1, Tok::Open(first as char)),
            b')' | b']' | b'}' => (1, Tok::Close(first as char)),
            b'{' => match self.braced_name() {
                Some(tok) => return Ok(tok),
                None => (1, Tok::Open('{')),
            },
            b'|' => (1, Tok::Bar),
            b',' | b';' => (1, Tok::Comma),
            b'=' if second == b'<' => (2, Tok::Relation(Relation::LessEqual)),
            b'=' if second == b'>' => {
                return Err(Fault::new("`=>` is no relation", self.pos, self.pos + 2)
                    .hint("write >= for `at least`"));
            }
            b'=' if second == b'=' => (2, Tok::Relation(Relation::Equal)),
            b'=' => (1, Tok::Relation(Relation::Equal)),
            b':' if second == b'=' => (2, Tok::Relation(Relation::Equal)),
            b'!' if second == b'=' => (2, Tok::Relation(Relation::NotEqual)),
            b'<' if second == b'=' => (2, Tok::Relation(Relation::LessEqual)),
            b'<' if second == b'>' => (2, Tok::Relation(Relation::NotEqual)),
            b'<' => (1, Tok::Relation(Relation::Less)),
            b'>' if second == b'=' => (2, Tok::Relation(Relation::GreaterEqual)),
            b'>' => (1, Tok::Relation(Relation::Greater)),
            _ => return self.other(),
        };
        self.pos += length;
        Ok(tok)
    }

    fn other(&mut self) -> Faulty<Tok> {
        let rest = &self.text[self.pos..];
        let Some(c) = rest.chars().next() else {
            return Ok(Tok::End);
        };
        let tok = match c {
            '−' | '–' | '﹣' | '－' => Tok::Minus,
            '＋' => Tok::Plus,
            '±' => Tok::PlusMinus,
            '∓' => Tok::MinusPlus,
            '·' | '⋅' | '×' | '∙' | '•' | '∗' | '⨯' | '✕' => Tok::Times,
            '÷' | '∕' | '⁄' => Tok::Slash,
            '√' => Tok::Root(2),
            '∛' => Tok::Root(3),
            '≤' | '⩽' | '≦' => Tok::Relation(Relation::LessEqual),
            '≥' | '⩾' | '≧' => Tok::Relation(Relation::GreaterEqual),
            '≠' => Tok::Relation(Relation::NotEqual),
            '≈' | '≃' | '≅' => Tok::Relation(Relation::Approximately),
            '≡' | '＝' => Tok::Relation(Relation::Equal),
            '½' => Tok::Vulgar(1, 2),
            '⅓' => Tok::Vulgar(1, 3),
            '⅔' => Tok::Vulgar(2, 3),
            '¼' => Tok::Vulgar(1, 4),
            '¾' => Tok::Vulgar(3, 4),
            '⅕' => Tok::Vulgar(1, 5),
            '⅖' => Tok::Vulgar(2, 5),
            '⅗' => Tok::Vulgar(3, 5),
            '⅘' => Tok::Vulgar(4, 5),
            '⅙' => Tok::Vulgar(1, 6),
            '⅚' => Tok::Vulgar(5, 6),
            '⅐' => Tok::Vulgar(1, 7),
            '⅛' => Tok::Vulgar(1, 8),
            '⅜' => Tok::Vulgar(3, 8),
            '⅝' => Tok::Vulgar(5, 8),
            '⅞' => Tok::Vulgar(7, 8),
            '⅑' => Tok::Vulgar(1, 9),
            '⅒' => Tok::Vulgar(1, 10),
            '°' | '∘' => Tok::Degree,
            '⟨' => Tok::Open('<'),
            '⟩' => Tok::Close('>'),
            'π' => Tok::Name("pi".into()),
            '⁰' | '¹' | '²' | '³' | '⁴'..='⁹' | '⁺' | '⁻' => return self.raised(),
            'ⁿ' => {
                let message = "a raised letter is not read here";
                return Err(Fault::new(message, self.pos, self.pos + c.len_utf8()).hint("write ^n"));
            }
            _ if greek_name(c).is_some() || matches!(c, 'î' | 'ĵ' | 'ŷ') => {
                return self.name(self.pos, self.pos + c.len_utf8());
            }
            '\'' | '′' => {
                let message = "a prime belongs right behind a name";
                return Err(Fault::new(message, self.pos, self.pos + c.len_utf8()));
            }
            '_' => {
                let message = "an index belongs right behind a name";
                return Err(Fault::new(message, self.pos, self.pos + 1).hint("write v_1 or v_{G1}"));
            }
            '.' => {
                return Err(Fault::new("a point without digits", self.pos, self.pos + 1)
                    .hint("write * for a product"));
            }
            '!' => {
                return Err(Fault::new(
                    "a factorial has no place in these formulas",
                    self.pos,
                    self.pos + 1,
                ));
            }
            '&' => {
                return Err(Fault::new(
                    "`&` is no part of a formula",
                    self.pos,
                    self.pos + 1,
                ));
            }
            c => return Err(strange(c, self.pos)),
        };
        self.pos += c.len_utf8();
        Ok(tok)
    }

    /// An exponent in raised digits.
    fn raised(&mut self) -> Faulty<Tok> {
        let start = self.pos;
        let mut digits = 0i64;
        let mut count = 0;
        let mut negative = false;
        for c in self.text[start..].chars() {
            let digit = match c {
                '⁰' => 0,
                '¹' => 1,
                '²' => 2,
                '³' => 3,
                '⁴'..='⁹' => i64::from(u32::from(c) - u32::from('⁴')) + 4,
                '⁺' | '⁻' if self.pos == start => {
                    negative = c == '⁻';
                    self.pos += c.len_utf8();
                    continue;
                }
                _ => break,
            };
            self.pos += c.len_utf8();
            count += 1;
            if count > 4 {
                return Err(Fault::new(
                    "an exponent has at most four raised digits",
                    start,
                    self.pos,
                ));
            }
            digits = digits * 10 + digit;
        }
        if count == 0 {
            return Err(Fault::new(
                "a raised sign without digits belongs right behind a name",
                start,
                self.pos,
            ));
        }
        Ok(Tok::Raised(ratio(
            if negative { -digits } else { digits },
            1,
        )))
    }

    fn number(&mut self) -> Faulty<Tok> {
        let start = self.pos;
        let bytes = self.text.as_bytes();
        let mut digits_end = start;
        let mut dot = false;
        while bytes
            .get(digits_end)
            .is_some_and(|b| b.is_ascii_digit() || (*b == b'.' && !dot))
        {
            dot |= bytes[digits_end] == b'.';
            digits_end += 1;
        }
        let mut exponent = Exponent::Ten;
        if let Some((_, stop, _)) = number::exponent_at(bytes, digits_end) {
            let letter = &self.text[digits_end..=digits_end];
            let declared = self.symbols.find(letter).is_some();
            if letter == "e" && (declared || self.symbols.is_open()) || declared {
                let signed = matches!(bytes.get(digits_end + 1), Some(b'+' | b'-'));
                // 2e-1 with e declared is 2e minus 1; 1.5e-3 is a number to everybody.
                let ten = !(declared && signed && !dot);
                let usual = self.usual();
                self.note(
                    Remark::PowerOfTen { ten: ten == usual },
                    start,
                    digits_end,
                    stop,
                );
                exponent = if ten == usual {
                    Exponent::Ten
                } else {
                    Exponent::Symbol
                };
            }
        }
        let (literal, end) = number::literal(self.text, start, exponent)?;
        self.pos = end;
        Ok(Tok::Number(literal))
    }

    /// A run of letters: a function, a declared word, a Greek name, or the first letter alone.
    fn word(&mut self, single: bool) -> Faulty<Tok> {
        let start = self.pos;
        let rest = &self.text[start..];
        if single {
            let parts = Parts {
                base: rest[..1].to_string(),
                ..Parts::default()
            };
            return self.resolve(start, start + 1, parts);
        }
        // A longer run is read in pieces.
        let run = rest
            .bytes()
            .take(64)
            .take_while(u8::is_ascii_alphabetic)
            .count();
        if !(start > 0 && self.text.as_bytes()[start - 1].is_ascii_alphabetic()) {
            self.run_from = start;
        }
        if self.before != Before::Nothing {
            let word = &rest[..run];
            let degrees =
                matches!(word, "deg" | "degree" | "degrees") && self.symbols.find(word).is_none();
            if degrees && !rest[run..].trim_start().starts_with('/') {
                self.pos += run;
                return Ok(Tok::Degree);
            }
            if let Some(tok) = self.unit(false) {
                return Ok(tok);
            }
        }
        for length in (1..=run.min(self.symbols.longest_word())).rev() {
            let word = &rest[..length];
            let base = length == 1 || self.symbols.has_base(word);
            if base {
                if let Some(tok) = self.declared_name(start, start + length) {
                    return Ok(tok);
                }
            }
            if length < 2 {
                break;
            }
            if let Some(tok) = function(word) {
                if !self.function_wanted(word, start) {
                    continue;
                }
                self.pos = start + length;
                if let ("log", Tok::Call(_)) = (word, &tok) {
                    self.note(Remark::NaturalLogarithm, start, start, self.pos);
                }
                return Ok(tok);
            }
            if word == "pi" {
                self.pos = start + length;
                return Ok(Tok::Name("pi".into()));
            }
            if is_greek(word) || word == "ell" {
                if let Some(tok) = self.declared_name(start, start + length) {
                    return Ok(tok);
                }
                if self.symbols.is_open() {
                    return self.name(start, start + length);
                }
            }
        }
        if self.symbols.is_open() {
            if run > 3
                && self.before == Before::Nothing
                && !self.notes.iter().any(|n| n.end >= start + run)
            {
                self.note(Remark::Letters, start, start, start + run);
            }
            return self.name(start, start + 1);
        }
        self.unknown_word(start, run)
    }

    /// `asin` is the arcsine unless `a` is declared and the other reading is asked for.
    fn function_wanted(&mut self, word: &str, start: usize) -> bool {
        if !matches!(word, "asin" | "acos" | "atan") || self.symbols.find("a").is_none() {
            return true;
        }
        let usual = self.usual();
        self.note(
            Remark::ArcOrFactor { arc: usual },
            start,
            start + 1,
            start + word.len(),
        );
        usual
    }

    fn unknown_word(&mut self, start: usize, run: usize) -> Faulty<Tok> {
        // A word that starts with declared letters is one fault, not a product and a fault.
        let from = self.run_from.min(start);
        let (start, run) = (from, run + start - from);
        let mut parts = Parts {
            base: self.text[start..start + run].to_string(),
            ..Parts::default()
        };
        let mut took = false;
        let end = name::tail(
            self.text,
            start + run,
            &mut parts,
            self.symbols,
            false,
            &mut took,
        );
        self.refuse(&parts.key(), start, end)
    }

    /// Notes an undeclared name and goes on with it, so that all are reported together.
    fn refuse(&mut self, key: &str, start: usize, end: usize) -> Faulty<Tok> {
        let shown = &self.text[start..end];
        let mut fault = Fault::new(format!("`{shown}` is not declared"), start, end);
        if let Some(nearest) = self.symbols.nearest(key) {
            fault = fault.hint(format!("did you mean {nearest}?"));
        } else if !self.symbols.declared().is_empty() && self.symbols.declared().len() <= 24 {
            let names: Vec<&str> = self.symbols.declared().iter().map(|d| &*d.name).collect();
            fault = fault.hint(format!("declared are {}", names.join(", ")));
        }
        if self.unknown.len() >= MAX_FAULTS {
            return Err(fault);
        }
        self.unknown.push(*fault);
        self.pos = end;
        Ok(Tok::Name(key.into()))
    }

    /// A declared name whose base is these bytes.
    fn declared_name(&mut self, start: usize, end: usize) -> Option<Tok> {
        let mut parts = Parts {
            base: self.text[start..end].to_string(),
            ..Parts::default()
        };
        let at = name::combining(self.text, end, &mut parts);
        let mut took = false;
        let stop = name::tail(self.text, at, &mut parts, self.symbols, false, &mut took);
        let found = name::find(&parts, self.symbols)?.name.clone();
        self.pos = stop;
        Some(Tok::Name(found))
    }

    /// A name whose base starts here; `end` bounds a base of plain letters.
    fn name(&mut self, start: usize, end: usize) -> Faulty<Tok> {
        let mut parts = Parts::default();
        let plain = self.text[start..end]
            .bytes()
            .all(|b| b.is_ascii_alphabetic());
        let at = if plain {
            parts.base = self.text[start..end].to_string();
            if parts.base == "ell" {
                parts.base = "l".into();
            }
            name::combining(self.text, end, &mut parts)
        } else {
            match name::base(self.text, start, &mut parts, 0) {
                Some(at) => at,
                None => return Err(Fault::new("this is no name I can read", start, end)),
            }
        };
        self.finish(start, at, parts)
    }

    /// Reads index and marks behind a base and resolves the name.
    fn finish(&mut self, start: usize, at: usize, parts: Parts) -> Faulty<Tok> {
        let mut whole = parts.clone();
        let mut took = false;
        let mut stop = name::tail(self.text, at, &mut whole, self.symbols, false, &mut took);
        if took {
            let usual = self.usual();
            if !usual {
                whole = parts;
                stop = name::tail(self.text, at, &mut whole, self.symbols, true, &mut took);
            }
            self.note(Remark::Component { one: usual }, start, start, stop);
        }
        self.resolve(start, stop, whole)
    }

    /// Looks a complete name up.
    fn resolve(&mut self, start: usize, stop: usize, whole: Parts) -> Faulty<Tok> {
        self.pos = stop;
        if let Some(found) = name::find(&whole, self.symbols) {
            return Ok(Tok::Name(found.name.clone()));
        }
        let key = whole.key();
        if matches!(key.as_str(), "i_hat" | "j_hat" | "k_hat") {
            return Ok(Tok::Name(key.as_str().into()));
        }
        if !self.symbols.is_open() {
            return self.refuse(&key, start, stop);
        }
        if let Some(known) = self.found.iter().find(|name| ***name == *key) {
            return Ok(Tok::Name(known.clone()));
        }
        if self.found.len() >= MAX_NAMES {
            return Err(Fault::new(
                format!("a formula has at most {MAX_NAMES} different names"),
                start,
                stop,
            ));
        }
        let name = Symbol::from(key.as_str());
        self.found.push(name.clone());
        Ok(Tok::Name(name))
    }

    /// `{v}_{1}`: a name in braces whose index stands outside.
    fn braced_name(&mut self) -> Option<Tok> {
        let start = self.pos;
        let mut parts = Parts::default();
        let at = name::base(self.text, start, &mut parts, 0)?;
        let behind = self.text[at..].chars().next();
        if !matches!(behind, Some('_' | '\'' | '′'))
            || parts.base.len() > 1 && !is_greek(&parts.base)
        {
            return None;
        }
        self.finish(start, at, parts).ok()
    }

    /// A unit that fills the rest of this side, where one can stand.
    fn unit(&mut self, marked: bool) -> Option<Tok> {
        let start = self.pos;
        let rest = &self.text[start..];
        if !marked && !starts_like_a_unit(rest) {
            return None;
        }
        let ends = |c: char| matches!(c, '=' | '<' | '>' | '≤' | '≥' | '≠' | '≈');
        let stop = rest
            .char_indices()
            .take(LONGEST_UNIT)
            .find(|(_, c)| ends(*c))
            .map_or(rest.len(), |(at, _)| at);
        let side = &rest[..stop];
        if side.len() > LONGEST_UNIT {
            return None;
        }
        let plain = plain_unit(side)?;
        let read = dimension::unit(&plain).ok()?;
        if !marked {
            let words = || {
                plain
                    .split(|c: char| !c.is_ascii_alphabetic())
                    .filter(|w| !w.is_empty())
            };
            if !self.units_first {
                if !self.symbols.is_open()
                    || words().any(|w| {
                        w.chars()
                            .any(|c| self.symbols.find(c.encode_utf8(&mut [0; 4])).is_some())
                    })
                {
                    return None;
                }
                // Without declarations 3 m g is a force more often than a unit.
                let telling = words().any(|w| {
                    matches!(
                        w,
                        "kg" | "rad"
                            | "deg"
                            | "rpm"
                            | "cm"
                            | "mm"
                            | "km"
                            | "Hz"
                            | "Nm"
                            | "Ns"
                            | "kN"
                            | "kJ"
                            | "MJ"
                            | "mph"
                            | "ft"
                            | "J"
                            | "N"
                    )
                }) || plain.contains("/s")
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

    fn command(&mut self, single: bool) -> Faulty<Tok> {
        let start = self.pos;
        let rest = &self.text[start + 1..];
        let length = rest
            .find(|c: char| !c.is_ascii_alphabetic())
            .unwrap_or(rest.len());
        let word = &rest[..length];
        let end = start + 1 + length;
        self.pos = end;
        let tok = match word {
            "frac" | "dfrac" | "tfrac" | "cfrac" => Tok::Fraction,
            "sqrt" | "surd" => Tok::Root(2),
            "cdot" | "times" | "ast" | "bullet" => Tok::Times,
            "div" => Tok::Slash,
            "pm" => Tok::PlusMinus,
            "mp" => Tok::MinusPlus,
            "le" | "leq" | "leqslant" | "leqq" => Tok::Relation(Relation::LessEqual),
            "ge" | "geq" | "geqslant" | "geqq" => Tok::Relation(Relation::GreaterEqual),
            "lt" => Tok::Relation(Relation::Less),
            "gt" => Tok::Relation(Relation::Greater),
            "ne" | "neq" => Tok::Relation(Relation::NotEqual),
            "approx" | "simeq" | "cong" => Tok::Relation(Relation::Approximately),
            "equiv" => Tok::Relation(Relation::Equal),
            "vert" | "mid" => Tok::Bar,
            "lvert" => Tok::OpenBar,
            "rvert" => Tok::CloseBar,
            "langle" => Tok::Open('<'),
            "rangle" => Tok::Close('>'),
            "lbrace" => Tok::Open('{'),
            "rbrace" => Tok::Close('}'),
            "lbrack" => Tok::Open('['),
            "rbrack" => Tok::Close(']'),
            "pi" => Tok::Name("pi".into()),
            "degree" => Tok::Degree,
            "" => match rest.chars().next() {
                Some('{') => {
                    self.pos += 1;
                    Tok::Open('{')
                }
                Some('}') => {
                    self.pos += 1;
                    Tok::Close('}')
                }
                Some(c) => {
                    let shown = if is_invisible(c) || c.is_control() {
                        '\u{fffd}'
                    } else {
                        c
                    };
                    return Err(Fault::new(
                        format!("`\\{shown}` is no command I read"),
                        start,
                        end + c.len_utf8(),
                    ));
                }
                None => return Err(Fault::new("a lone backslash", start, end)),
            },
            "operatorname" => return self.operator(start),
            "mathrm" | "text" | "textrm" | "mathsf" | "mathbf" | "mathit" | "textbf" | "textit"
            | "boldsymbol" | "bm" | "mathcal" => {
                return self.font(start, word);
            }
            "over" | "atop" => {
                return Err(Fault::new(format!("`\\{word}` is not read"), start, end)
                    .hint("write \\frac{…}{…}"));
            }
            "infty" => {
                return Err(Fault::new(
                    "infinity is no value of a formula here",
                    start,
                    end,
                ));
            }
            word => match function(word).filter(|_| word.chars().all(|c| c.is_ascii_lowercase())) {
                Some(tok) => {
                    if word == "log" {
                        self.note(Remark::NaturalLogarithm, start, start, end);
                    }
                    tok
                }
                None => {
                    let mut parts = Parts::default();
                    let Some(at) = name::base(self.text, start, &mut parts, 0) else {
                        let shown: String = word.chars().take(24).collect();
                        let fault =
                            Fault::new(format!("`\\{shown}` is no command I read"), start, end);
                        return Err(match function(word).or_else(|| nearest_command(word)) {
                            Some(_) => fault.hint("commands are written in lower case and in full, as in \\sin"),
                            None => fault.hint("known are \\frac, \\sqrt, \\sin and the like, \\cdot, Greek letters, accents and \\mathrm"),
                        });
                    };
                    return if single {
                        self.resolve(start, at, parts)
                    } else {
                        self.finish(start, at, parts)
                    };
                }
            },
        };
        Ok(tok)
    }

    fn operator(&mut self, start: usize) -> Faulty<Tok> {
        let (inside, end) = self.group(start)?;
        let word: String = inside.chars().filter(|c| !c.is_whitespace()).collect();
        self.pos = end;
        match function(&word) {
            Some(tok) => Ok(tok),
            None => Err(Fault::new(
                format!("`{word}` is no function I know"),
                start,
                end,
            )),
        }
    }

    /// A piece in another font: a unit behind a number, a function, or a name.
    fn font(&mut self, start: usize, word: &str) -> Faulty<Tok> {
        self.pos = start;
        self.pos = start + 1 + word.len();
        if let Ok((inside, end)) = self.group(start) {
            if matches!(inside.trim(), "deg" | "degrees" | "°") && self.before != Before::Nothing {
                self.pos = end;
                return Ok(Tok::Degree);
            }
        }
        self.pos = start;
        if self.before != Before::Nothing && matches!(word, "mathrm" | "text" | "textrm" | "mathsf")
        {
            if let Some(tok) = self.unit(true) {
                return Ok(tok);
            }
        }
        self.pos = start + 1 + word.len();
        if let Ok((inside, end)) = self.group(start) {
            let trimmed = inside.trim();
            if let Some(tok) = function(trimmed) {
                self.pos = end;
                return Ok(tok);
            }
            if trimmed == "pi" || trimmed == "\\pi" {
                self.pos = end;
                return Ok(Tok::Name("pi".into()));
            }
        }
        let mut parts = Parts::default();
        match name::base(self.text, start, &mut parts, 0) {
            Some(at) => self.finish(start, at, parts),
            None => {
                let end = self.group(start).map_or(self.pos, |(_, end)| end);
                Err(Fault::new(
                    "this text is neither a unit, a function nor a name",
                    start,
                    end,
                ))
            }
        }
    }

    /// The text of the brace group that starts at the current place, and the byte after it.
    fn group(&self, start: usize) -> Faulty<(&'a str, usize)> {
        let blanks = self.text[self.pos..].len()
            - self.text[self.pos..].trim_start_matches([' ', '*']).len();
        let at = self.pos + blanks;
        let inside = self.text[at..].strip_prefix('{');
        let length = inside.and_then(|inside| inside.find('}'));
        match (inside, length) {
            (Some(inside), Some(length)) => Ok((&inside[..length], at + length + 2)),
            _ => Err(Fault::new("a group in braces is expected here", start, at)),
        }
    }

    /// Whether a name is known to be, or looks like, an angle.
    pub fn is_angle(&self, name: &str) -> bool {
        match self.symbols.find(name).and_then(|d| d.dimension.as_ref()) {
            Some(dimension) => dimension.is_none(),
            None => is_angle_name(name),
        }
    }

    /// Whether nothing but spaces is left.
    pub fn at_end(&self) -> bool {
        self.text[self.pos..]
            .chars()
            .all(|c| c.is_whitespace() || c == '$')
    }
}

/// A function by name; capitals are accepted.
fn function(word: &str) -> Option<Tok> {
    if word.len() < 2 || word.len() > 7 {
        return None;
    }
    let mut lower = [0u8; 7];
    for (to, from) in lower.iter_mut().zip(word.bytes()) {
        *to = from.to_ascii_lowercase();
    }
    use Function::*;
    Some(match &lower[..word.len()] {
        b"sin" => Tok::Call(Sin),
        b"cos" => Tok::Call(Cos),
        b"tan" => Tok::Call(Tan),
        b"asin" | b"arcsin" => Tok::Call(Asin),
        b"acos" | b"arccos" => Tok::Call(Acos),
        b"atan" | b"arctan" => Tok::Call(Atan),
        b"sinh" => Tok::Call(Sinh),
        b"cosh" => Tok::Call(Cosh),
        b"tanh" => Tok::Call(Tanh),
        b"exp" => Tok::Call(Exp),
        b"ln" | b"log" => Tok::Call(Ln),
        b"abs" => Tok::Call(Abs),
        b"sec" => Tok::Reciprocal(Cos),
        b"csc" | b"cosec" => Tok::Reciprocal(Sin),
        b"cot" => Tok::Reciprocal(Tan),
        b"sqrt" => Tok::Root(2),
        b"cbrt" => Tok::Root(3),
        _ => return None,
    })
}

fn nearest_command(word: &str) -> Option<Tok> {
    function(&word.to_ascii_lowercase())
}

/// Length of a command that only decorates, without its backslash.
fn decoration(rest: &str) -> Option<usize> {
    let first = rest.chars().next()?;
    if matches!(
        first,
        ',' | ';' | ':' | '!' | ' ' | '(' | ')' | '[' | ']' | '>'
    ) {
        return Some(1);
    }
    let length = rest
        .find(|c: char| !c.is_ascii_alphabetic())
        .unwrap_or(rest.len());
    let known = matches!(
        &rest[..length],
        "left"
            | "right"
            | "big"
            | "Big"
            | "bigg"
            | "Bigg"
            | "bigl"
            | "bigr"
            | "Bigl"
            | "Bigr"
            | "biggl"
            | "biggr"
            | "Biggl"
            | "Biggr"
            | "displaystyle"
            | "textstyle"
            | "scriptstyle"
            | "quad"
            | "qquad"
            | "limits"
            | "thinspace"
            | "medspace"
            | "nonumber"
            | "mathstrut"
    );
    known.then_some(length)
}

/// Length of a degree sign behind `^`.
fn degree_mark(rest: &str) -> Option<usize> {
    let blanks = rest.len() - rest.trim_start_matches(' ').len();
    let body = &rest[blanks..];
    let marks = [
        "{\\circ}",
        "\\circ",
        "{∘}",
        "{°}",
        "∘",
        "°",
        "{\\degree}",
        "\\degree",
    ];
    marks
        .iter()
        .find(|mark| body.starts_with(**mark))
        .map(|mark| blanks + mark.len())
}

/// Whether the text starts with a word that is a unit, so that trying is worth it.
fn starts_like_a_unit(side: &str) -> bool {
    let length = side
        .bytes()
        .take(8)
        .take_while(u8::is_ascii_alphabetic)
        .count();
    (1..8).contains(&length) && dimension::unit(&side[..length]).is_ok()
}

/// The unit without LaTeX decoration.
fn plain_unit(side: &str) -> Option<String> {
    let mut out = String::new();
    let mut rest = side;
    while let Some(c) = rest.chars().next() {
        rest = &rest[c.len_utf8()..];
        match c {
            '\\' => {
                let length = rest
                    .find(|c: char| !c.is_ascii_alphabetic())
                    .unwrap_or(rest.len());
                let word = &rest[..length];
                rest = &rest[length..];
                match word {
                    "mathrm" | "text" | "textrm" | "mathsf" | "rm" => {
                        if !out.is_empty() {
                            out.push(' ');
                        }
                    }
                    "cdot" | "times" => out.push('·'),
                    "circ" => out.push('°'),
                    "mu" => out.push('µ'),
                    "" => {
                        out.push(' ');
                        rest = rest.strip_prefix([',', ';', ':', '!', ' '])?;
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
                let kept = plain.ends_with('^');
                open.push(kept);
                if kept {
                    plain.push(c);
                }
            }
            '}' => {
                if open.pop()? {
                    plain.push(c);
                }
            }
            c => plain.push(c),
        }
    }
    let trimmed = plain.trim().trim_end_matches(['.', ',', ';']).trim_end();
    (open.is_empty() && !trimmed.is_empty()).then(|| trimmed.to_string())
}

/// A character that has no place in a formula.
fn strange(c: char, at: usize) -> Box<Fault> {
    let end = at + c.len_utf8();
    if is_invisible(c) {
        let message = format!(
            "an invisible character (U+{:04X}) stands here",
            u32::from(c)
        );
        return Fault::new(message, at, end).hint("type the formula anew");
    }
    if c.is_control() {
        return Fault::new(
            format!("a control character (U+{:04X}) stands here", u32::from(c)),
            at,
            end,
        );
    }
    Fault::new(format!("`{c}` has no place in a formula"), at, end)
}
