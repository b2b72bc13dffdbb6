//! Cuts a formula into tokens on demand: plain text, Unicode and LaTeX give the same ones.
//!
//! Names are resolved here against the symbols in play, because where one ends depends on them. Nothing is expanded:
//! a LaTeX command outside the list below is a fault.

use super::Relation;
use super::fault::{Fault, Faulty};
use super::frames;
use super::marks::{decoration, degree_mark, shows_space};
use super::note::{Note, Remark};
use super::symbols::{Symbols, is_angle_name};
use super::token::{Before, Literal, Tok, Token};
use super::written::{has_components, is_axis};
use crate::expr::{Symbol, ratio};

/// The decision that turns all slashes round; sites below it are turned one by one.
pub(super) const SLASHES: u32 = 63;
/// The decision that opens a bar inside bars where a value stands right behind it: `|x+b|y||`.
pub(super) const BARS: u32 = 62;
/// The decision that leaves fractions of two whole numbers as they are where the other slashes are turned round.
pub(super) const HALVES: u32 = 61;
/// Most tokens of one formula.
const MAX_TOKENS: u32 = 20_000;

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
    /// Whether slashes could reach further or less far.
    pub slashes: bool,
    pub notes: Vec<Note>,
    /// Undeclared names met in open reading.
    pub found: Vec<Symbol>,
    /// Undeclared names met in strict reading.
    pub unknown: Vec<Fault>,
    pub(super) symbols: &'a Symbols,
    pub(super) before: Before,
    /// Whether a value stood before, so that an empty group is only a spacer.
    pub(super) after_value: bool,
    /// Where the current run of letters starts, functions and Greek names apart.
    pub(super) run_from: usize,
    /// Tokens so far.
    pub(super) count: u32,
    /// Digits of long numbers so far.
    pub(super) long_digits: u32,
    /// Whether a comma between digits separates components here.
    pub list: bool,
    /// Whether lines are aligned: `&` and `\\\\` only lay them out.
    pub(super) aligned: bool,
    /// A token that stands behind the last one in meaning, though before it in the text: the square of `v^2_0`.
    pub(super) pending: Option<Tok>,
    /// Whether ± or ∓ stands somewhere, and whether something that could be a vector does.
    pub pairs: bool,
    pub vectors: bool,
    /// Brackets around the current place.
    pub(super) open: u32,
    /// Whether a LaTeX matrix is being read.
    pub(super) matrix: bool,
}

impl<'a> Lexer<'a> {
    pub fn new(
        text: &'a str,
        start: usize,
        symbols: &'a Symbols,
        units_first: bool,
        flips: u64,
    ) -> Lexer<'a> {
        Lexer {
            text,
            pos: start,
            single: false,
            units_first,
            sites: 0,
            flips,
            slashes: false,
            notes: Vec::new(),
            found: Vec::new(),
            unknown: Vec::new(),
            symbols,
            before: Before::Nothing,
            after_value: false,
            run_from: 0,
            count: 0,
            long_digits: 0,
            list: false,
            aligned: false,
            pending: None,
            pairs: false,
            vectors: false,
            open: 0,
            matrix: false,
        }
    }

    /// Whether a decision is taken the usual way; each call is a place where another reading is possible.
    pub fn usual(&mut self) -> bool {
        let site = self.sites;
        self.sites += 1;
        site >= HALVES || self.flips >> site & 1 == 0
    }

    /// Whether slashes reach as far as usual. There is one other reading for all of them, or for all but those of a `half`, and
    /// none `inside` a function.
    pub fn usual_slash(&mut self, inside: bool, half: bool) -> bool {
        self.slashes |= !inside;
        let is_set = |flip: u32| self.flips >> flip & 1 == 1;
        inside || !is_set(SLASHES) || half && is_set(HALVES)
    }

    /// Whether a bar that ends at `end`, inside bars and behind a value, opens others.
    pub fn opens_inside(&self, end: usize) -> bool {
        let value = |c: char| c.is_alphanumeric() || matches!(c, '\\' | '(');
        self.flips >> BARS & 1 == 1 && self.text[end..].starts_with(value)
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
        self.count += 1;
        if self.count > MAX_TOKENS {
            let message = format!("a formula has at most {MAX_TOKENS} pieces");
            return Err(Fault::new(message, start, start));
        }
        let tok = match self.pending.take() {
            Some(tok) => tok,
            None => self.token(single)?,
        };
        match &tok {
            Tok::Open('(' | '[' | '<' | 'm' | 'v') => self.open += 1,
            Tok::Close(')' | ']' | '>' | 'm') => self.open = self.open.saturating_sub(1),
            Tok::PlusMinus | Tok::MinusPlus => self.pairs = true,
            Tok::Comma => self.vectors = true,
            // A letter and `_hat` at least.
            Tok::Name(name) if name.len() > 4 => {
                self.vectors |= is_axis(name) || has_components(name);
            }
            _ => {}
        }
        self.before = match &tok {
            Tok::Number(literal) => Before::Number {
                decimal: literal.decimal,
            },
            Tok::Vulgar(..) | Tok::Close(_) | Tok::Raised(_) | Tok::Degree | Tok::Percent(_) => {
                Before::Value
            }
            Tok::Name(name) if &**name == "pi" || is_axis(name) => Before::Value,
            _ => Before::Nothing,
        };
        self.after_value = self.before != Before::Nothing || matches!(tok, Tok::Name(_));
        if let Tok::Call(_)
        | Tok::Reciprocal(_)
        | Tok::Logarithm(_)
        | Tok::Area(_)
        | Tok::Signum
        | Tok::Root(_) = tok
        {
            self.run_from = self.pos;
        }
        Ok(Token {
            tok,
            start,
            end: self.pos,
            spaced,
        })
    }

    /// Passes over spaces and what only decorates; whether a space is among it that people see.
    pub(super) fn skip_blanks(&mut self) -> Faulty<bool> {
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
                '&' if self.aligned => 1,
                '\\' if self.aligned && rest.starts_with("\\\\") => {
                    if !frames::goes_on(&rest[2..]) {
                        let fault = Fault::new("a line begins here", self.pos, self.pos + 2);
                        return Err(fault.hint("a line that goes on begins with a sign"));
                    }
                    2
                }
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
        Ok(self.pos > start && shows_space(self.text.as_bytes(), start, self.pos))
    }

    pub(super) fn token(&mut self, single: bool) -> Faulty<Tok> {
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
                return Ok(Tok::Number(Literal::of(ratio(digit, 1))));
            }
            b'1' if self.units_first && second == b'/' => match self.unit_below() {
                Some(tok) => return Ok(tok),
                None => return self.number(),
            },
            b'0'..=b'9' => return self.number().and_then(|tok| self.factorial(tok)),
            b'.' if second.is_ascii_digit() => {
                // `x.1` is neither x/10 nor x·1.
                if self.after_value && !self.text[..self.pos].ends_with(char::is_whitespace) {
                    let fault = Fault::new("a point behind a value", self.pos, self.pos + 1);
                    return Err(fault.hint("write * for a product, and 0.1 for a tenth"));
                }
                return self.number();
            }
            b'x' | b'X' if self.times_ten(rest) => (1, Tok::Times),
            b'a'..=b'z' | b'A'..=b'Z' => return self.word(single),
            b'\\' => return self.command(single),
            b'+' if rest[1..].starts_with("/-") => (3, Tok::PlusMinus),
            // `a +- b` is a pair; `a+-b` is as often a machine's way to add something negative.
            b'+' if second == b'-' => {
                let tight = self.pos > 0
                    && !self.text[..self.pos].ends_with(|c: char| c.is_whitespace() || c == '=')
                    && !rest[2..].starts_with(char::is_whitespace);
                if tight && self.after_value {
                    let fault = Fault::new("two signs in a row", self.pos, self.pos + 2);
                    return Err(fault.hint("write ± for both signs, or a + (-b)"));
                }
                (2, Tok::PlusMinus)
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
            b'/' if self.units_first => match self.unit_below() {
                Some(tok) => return Ok(tok),
                None => (1, Tok::Slash),
            },
            b'/' => (1, Tok::Slash),
            b'^' if degree_mark(&rest[1..]).is_some() => {
                (1 + degree_mark(&rest[1..]).unwrap_or(0), Tok::Degree)
            }
            b'^' => (1, Tok::Caret),
            b'[' if self.units_first && matches!(self.before, Before::Number { .. }) => {
                match self.bracketed_unit() {
                    Some(tok) => return Ok(tok),
                    None => (1, Tok::Open('[')),
                }
            }
            b'(' | b'[' => (1, Tok::Open(first as char)),
            b')' | b']' | b'}' => (1, Tok::Close(first as char)),
            b'{' => match self.braced_name() {
                Some(tok) => return Ok(tok),
                None => (1, Tok::Open('{')),
            },
            b'|' => (1, sided_bar(&self.text[..self.pos])),
            b',' | b';' => (1, Tok::Comma),
            b'%' => return self.percent(self.pos, 1, 100),
            b'&' if self.matrix => (1, Tok::Comma),
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

    /// Whether a comma between digits in round brackets separates components.
    pub fn lists(&self) -> bool {
        self.symbols.lists()
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

/// A bar behind `\left` or `\right` says itself which side it is; any other may be either.
fn sided_bar(before: &str) -> Tok {
    let before = before.trim_end();
    let sizes = ["\\big", "\\Big", "\\bigg", "\\Bigg"];
    let sided = |letter: char| {
        let size = before.strip_suffix(letter);
        size.is_some_and(|size| sizes.iter().any(|s| size.ends_with(s)))
    };
    match before {
        _ if before.ends_with("\\left") || sided('l') => Tok::OpenBar,
        _ if before.ends_with("\\right") || sided('r') => Tok::CloseBar,
        _ => Tok::Bar,
    }
}
