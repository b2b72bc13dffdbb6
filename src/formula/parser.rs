//! Builds the written formula from tokens by recursive descent, with depth limited well below the stack.
//!
//! The grammar, from loose to tight; `{ }` repeats, `[ ]` may be missing. Tokens are those of [`super::lexer`], in which
//! plain text, Unicode and LaTeX are alike.
//!
//! ```text
//! statement = side { relation side } [ "," ]
//! side      = sum [ "\over" sum ] [ unit ]
//! sum       = [ sign ] term { sign [ "+" | "-" ] term }          sign = "+" | "-" | "±" | "∓"
//! term      = group { ( "*" | "×" | "/" ) [ "+" | "-" ] group }  below "/" only what product.rs tells
//! group     = factor { factor }                                  side by side: a product
//! factor    = value { "^" exponent | raised digits | "%" | "°" }
//! exponent  = [ sign ] value [ "^" exponent ]
//! value     = number | name | fraction | root | call | det | bars | bracket
//! fraction  = "½" … | "\frac" argument argument
//! root      = "√" value | "\sqrt" [ "[" sum "]" ] argument | pair
//! det       = "det" value | bars                               of a matrix, as bars around one
//! pair      = ( "root" | "atan2" | "hypot" | "max" | "min" | "pow" ) "(" sum "," sum ")"
//! call      = function [ "^" exponent ] ( bracket | group )      how far the group reaches: calls.rs
//! bars      = "|" sum "|"
//! bracket   = "(" sum { "," sum } ")" | "[" … "]" | "⟨" … "⟩" | "{" sum [ "\over" sum ] "}"
//! argument  = digit | letter | command | bracket
//! ```
//!
//! Lists, several relations, and intervals are cut into statements by `several.rs`.
//!
//! A unit behind a term stands wherever it is told from a product of letters, see `units.rs`. Where people's habits differ
//! the decision is a numbered site, see [`super::other_readings`].

use super::Relation;
use super::fault::{Fault, Faulty};
use super::lexer::Lexer;
use super::note::Remark;
use super::symbols::Symbols;
use super::token::{Tok, Token};
use super::units::numbered;
use super::written::{Shape, Sign, Written, is_axis};
use crate::dimension::Unit;

/// Deepest nesting of brackets, fractions, exponents and functions.
pub(crate) const MAX_DEPTH: u32 = 60;

/// One side of a relation.
pub(crate) struct Side {
    pub written: Written,
    /// The unit behind it and where it stands.
    pub unit: Option<(Unit, usize, usize)>,
    /// Whether units stand inside.
    pub measured: bool,
}

pub(crate) struct Parser<'a> {
    pub lexer: Lexer<'a>,
    pub(super) peeked: Option<Token>,
    depth: u32,
    /// Whether there is nothing but blanks to read.
    empty: bool,
    pub(super) bars: u32,
    /// Functions around the current place.
    pub(super) arguments: u32,
    /// Units inside the current side.
    pub(super) units: u32,
    /// Pieces written more than once so far.
    copied: usize,
}

/// Most pieces that a formula is written out with for functions of which an argument stands in several places.
const MAX_COPIED: usize = 20_000;

impl<'a> Parser<'a> {
    pub fn new(
        text: &'a str,
        start: usize,
        symbols: &'a Symbols,
        units_first: bool,
        flips: u64,
    ) -> Parser<'a> {
        Parser {
            lexer: Lexer::new(text, start, symbols, units_first, flips),
            peeked: None,
            depth: 0,
            empty: text[start..].trim().is_empty(),
            bars: 0,
            arguments: 0,
            units: 0,
            copied: 0,
        }
    }

    /// The whole input: one side, or sides with relations between them.
    pub fn statement(&mut self) -> Faulty<(Vec<Side>, Vec<Relation>)> {
        let mut sides = vec![self.side()?];
        let mut relations = Vec::new();
        loop {
            let token = self.next()?;
            match token.tok {
                Tok::End => return Ok((sides, relations)),
                Tok::Relation(relation) => {
                    if relations.len() >= 32 {
                        return Err(token.fault("at most 32 relations in one line"));
                    }
                    relations.push(relation);
                    sides.push(self.side()?);
                }
                Tok::Comma if self.lexer.at_end() => {
                    self.lexer
                        .note(Remark::Punctuation, token.start, token.start, token.end);
                }
                _ => return Err(self.unexpected(&token)),
            }
        }
    }

    fn side(&mut self) -> Faulty<Side> {
        self.units = 0;
        let mut written = self.sum()?;
        if self.peek()?.tok == Tok::Over {
            self.next()?;
            written = self.over(written)?;
        }
        let mut unit = None;
        if let Tok::Unit(_) = self.peek()?.tok {
            let token = self.next()?;
            if let Tok::Unit(found) = token.tok {
                unit = Some((*found, token.start, token.end));
            }
        }
        Ok(Side {
            written,
            unit,
            measured: self.units > 0,
        })
    }

    pub(super) fn peek(&mut self) -> Faulty<&Token> {
        if self.peeked.is_none() {
            self.peeked = Some(self.lexer.next()?);
        }
        match &self.peeked {
            Some(token) => Ok(token),
            None => Err(Fault::new("nothing to read", 0, 0)),
        }
    }

    pub(super) fn next(&mut self) -> Faulty<Token> {
        match self.peeked.take() {
            Some(token) => Ok(token),
            None => self.lexer.next(),
        }
    }

    /// Counts an argument that is about to be written more than once; such functions inside each other double what they hold.
    pub(super) fn copies(&mut self, argument: &Written) -> Faulty<()> {
        self.copied += argument.size();
        match self.copied > MAX_COPIED {
            true => Err(argument.fault("functions inside each other make this formula too large")),
            false => Ok(()),
        }
    }

    pub(super) fn deeper<T>(&mut self, work: impl FnOnce(&mut Self) -> Faulty<T>) -> Faulty<T> {
        if self.depth >= MAX_DEPTH {
            let at = self.peeked.as_ref().map_or(self.lexer.pos, |t| t.start);
            return Err(Fault::new(
                format!("nested more than {MAX_DEPTH} deep"),
                at,
                at,
            ));
        }
        self.depth += 1;
        let result = work(self);
        self.depth -= 1;
        result
    }

    /// The text of a token, as far as messages show it.
    pub(super) fn shown(&self, token: &Token) -> String {
        let text = &self.lexer.text[token.start..token.end];
        text.chars().take(24).collect()
    }

    pub(super) fn unexpected(&self, token: &Token) -> Box<Fault> {
        let shown = self.shown(token);
        let message = match &token.tok {
            Tok::End => "the formula ends here, and something is missing".to_string(),
            Tok::Close(_) => format!("`{shown}` closes a bracket that was not opened"),
            Tok::CloseBar => format!("`{shown}` closes a bar that was not opened"),
            Tok::Relation(_) => format!("`{shown}` needs something on both sides"),
            Tok::Comma => format!("`{shown}` separates components only inside brackets"),
            Tok::Unit(_) => format!("the unit `{shown}` stands in the middle of a formula"),
            Tok::Number(_) => format!("the number `{shown}` directly behind another number"),
            _ => format!("`{shown}` is not expected here"),
        };
        token.fault(message)
    }

    /// The fault where a value should start.
    pub(super) fn missing(&self, token: &Token) -> Box<Fault> {
        let shown = self.shown(token);
        let message = match &token.tok {
            Tok::End if self.empty => "the formula is empty".to_string(),
            Tok::End => {
                "a number, a name or a bracket is expected, and the formula ends".to_string()
            }
            _ => format!("a number, a name or a bracket is expected before `{shown}`"),
        };
        token.fault(message)
    }

    pub(super) fn sum(&mut self) -> Faulty<Written> {
        self.deeper(Self::sum_here)
    }

    fn sum_here(&mut self) -> Faulty<Written> {
        let start = self.peek()?.start;
        let first = self.sign()?;
        let term = self.term()?;
        let term = self.measured(term)?;
        let mut sign = self.signs()?;
        if sign.is_none() && matches!(first, None | Some(Sign::Plus)) {
            return Ok(term);
        }
        let mut terms = Vec::with_capacity(FEW);
        terms.push((first.unwrap_or(Sign::Plus), term));
        while let Some(next) = sign {
            let term = self.term()?;
            let term = self.measured(term)?;
            terms.push((next, term));
            sign = self.signs()?;
        }
        let end = terms.last().map_or(start, |(_, t)| t.end);
        Ok(Written::new(Shape::Sum(terms), start, end))
    }

    /// A term with the unit behind it, where more of the side follows or an earlier term had one.
    fn measured(&mut self, term: Written) -> Faulty<Written> {
        let token = self.peek()?;
        let (is_unit, end) = (matches!(token.tok, Tok::Unit(_)), token.end);
        if !is_unit || self.units == 0 && self.lexer.fills_side(end) {
            return Ok(term);
        }
        self.with_unit(term)
    }

    /// A factor with its own unit, as in `10 m / 2 s`: behind it stands another number, or an earlier factor has a unit.
    pub(super) fn measured_factor(&mut self, factor: Written, beside: bool) -> Faulty<Written> {
        let token = self.peek()?;
        let (is_unit, end) = (matches!(token.tok, Tok::Unit(_)), token.end);
        match is_unit && (beside || numbered(self.lexer.text[end..].trim_start())) {
            true => self.with_unit(factor),
            false => Ok(factor),
        }
    }

    fn with_unit(&mut self, term: Written) -> Faulty<Written> {
        let token = self.next()?;
        let Tok::Unit(unit) = token.tok else {
            return Ok(term);
        };
        self.units += 1;
        let (start, end) = (term.start, token.end);
        let whole = matches!(&term.shape, Shape::Number(n) if !n.decimal);
        let larger = (*unit).clone();
        let measured = Written::new(Shape::Measured(Box::new(term), unit), start, end);
        // `1 m 20 cm`: a smaller unit of the same kind goes on, less than one of the larger, behind a whole number of those.
        if let Tok::Number(number) = &self.peek()?.tok {
            let number = number.value.clone();
            let rest = self.factor()?;
            let smaller = match &self.peek()?.tok {
                Tok::Unit(next) => {
                    whole && next.is_part_of(&larger) && number * &next.factor < larger.factor
                }
                _ => false,
            };
            if !smaller {
                let token = self.next()?;
                return Err(self.unexpected(&token));
            }
            let rest = self.with_unit(rest)?;
            let end = rest.end;
            let terms = vec![(Sign::Plus, measured), (Sign::Plus, rest)];
            return Ok(Written::new(Shape::Sum(terms), start, end));
        }
        // The direction may stand behind the unit, `3 m/s \hat{i}`, and so may a function, `3 m/s cos 60°`.
        let goes_on = match &self.peek()?.tok {
            Tok::Name(name) => is_axis(name),
            tok => matches!(tok, Tok::Call(_) | Tok::Root(_)),
        };
        match goes_on {
            true => self.group_from(Some(measured)),
            false => Ok(measured),
        }
    }

    /// A sign, or two of them, as in `a + -b` and `a - -b`.
    fn signs(&mut self) -> Faulty<Option<Sign>> {
        let first = self.sign()?;
        let second = match (first, &self.peek()?.tok) {
            (Some(Sign::Plus | Sign::Minus), Tok::Plus | Tok::Minus) => self.sign()?,
            _ => None,
        };
        Ok(match (first, second) {
            (first, None) => first,
            (Some(a), Some(b)) if a == b => Some(Sign::Plus),
            _ => Some(Sign::Minus),
        })
    }

    pub(super) fn sign(&mut self) -> Faulty<Option<Sign>> {
        let sign = match self.peek()?.tok {
            Tok::Plus => Sign::Plus,
            Tok::Minus => Sign::Minus,
            Tok::PlusMinus => Sign::PlusMinus,
            Tok::MinusPlus => Sign::MinusPlus,
            _ => return Ok(None),
        };
        self.next()?;
        Ok(Some(sign))
    }
}

/// Room made at once for factors or terms: few products and sums have more.
pub(super) const FEW: usize = 4;
