//! Builds the written formula from tokens by precedence climbing, with depth limited well below the stack.
//!
//! From loose to tight: sums; products and quotients with a sign; products without a sign; functions without brackets;
//! powers. Where people's habits differ the decision is a numbered site, see [`super::other_readings`].

use super::Relation;
use super::fault::{Fault, Faulty};
use super::lexer::{Lexer, Tok, Token};
use super::note::Remark;
use super::symbols::Symbols;
use super::written::{Link, Literal, Shape, Sign, Written};
use crate::dimension::Unit;
use crate::expr::ratio;

/// Deepest nesting of brackets, fractions, exponents and functions.
pub(crate) const MAX_DEPTH: u32 = 60;

/// One side of a relation.
pub(crate) struct Side {
    pub written: Written,
    /// The unit behind it and where it stands.
    pub unit: Option<(Unit, usize, usize)>,
}

pub(crate) struct Parser<'a> {
    pub lexer: Lexer<'a>,
    peeked: Option<Token>,
    depth: u32,
    /// Whether there is nothing but blanks to read.
    empty: bool,
    pub(super) bars: u32,
    /// Functions around the current place.
    pub(super) arguments: u32,
    /// Units inside the current side.
    units: u32,
}

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
                        return Err(Fault::new(
                            "at most 32 relations in one line",
                            token.start,
                            token.end,
                        ));
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
        let written = self.sum()?;
        if let Tok::Unit(_) = self.peek()?.tok {
            let token = self.next()?;
            if let Tok::Unit(unit) = token.tok {
                return Ok(Side {
                    written,
                    unit: Some((*unit, token.start, token.end)),
                });
            }
        }
        Ok(Side {
            written,
            unit: None,
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

    pub(super) fn unexpected(&self, token: &Token) -> Box<Fault> {
        let shown: String = self.lexer.text[token.start..token.end]
            .chars()
            .take(24)
            .collect();
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
        Fault::new(message, token.start, token.end)
    }

    /// The fault where a value should start.
    pub(super) fn missing(&self, token: &Token) -> Box<Fault> {
        let shown: String = self.lexer.text[token.start..token.end]
            .chars()
            .take(24)
            .collect();
        let message = match &token.tok {
            Tok::End if self.empty => "the formula is empty".to_string(),
            Tok::End => {
                "a number, a name or a bracket is expected, and the formula ends".to_string()
            }
            _ => format!("a number, a name or a bracket is expected before `{shown}`"),
        };
        Fault::new(message, token.start, token.end)
    }

    pub(super) fn sum(&mut self) -> Faulty<Written> {
        self.deeper(Self::sum_here)
    }

    fn sum_here(&mut self) -> Faulty<Written> {
        let start = self.peek()?.start;
        let mut terms: Vec<(Sign, Written)> = Vec::new();
        let mut sign = self.sign()?;
        let signed = sign.is_some();
        loop {
            let term = self.term()?;
            let term = self.measured(term)?;
            terms.push((sign.unwrap_or(Sign::Plus), term));
            sign = self.signs()?;
            if sign.is_none() {
                break;
            }
        }
        if terms.len() == 1
            && !(signed && terms[0].0 != Sign::Plus)
            && let Some((_, term)) = terms.pop()
        {
            return Ok(term);
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
        let token = self.next()?;
        let Tok::Unit(unit) = token.tok else {
            return Ok(term);
        };
        self.units += 1;
        let start = term.start;
        Ok(Written::new(
            Shape::Measured(Box::new(term), unit),
            start,
            token.end,
        ))
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

    /// Groups tied by `*` and `/`, from left to right.
    fn term(&mut self) -> Faulty<Written> {
        let first = self.group()?;
        let mut factors: Vec<(Link, Written)> = Vec::new();
        let (start, mut end) = (first.start, first.end);
        let mut first = Some(first);
        loop {
            let link = match self.peek()?.tok {
                Tok::Times => Link::Times,
                Tok::Cross => Link::Cross,
                Tok::Slash => Link::Over,
                _ => break,
            };
            self.next()?;
            if let Some(first) = first.take() {
                factors.push((Link::Times, first));
            }
            let negative = match self.peek()?.tok {
                Tok::Minus => Some(self.next()?.start),
                Tok::Plus => {
                    self.next()?;
                    None
                }
                _ => None,
            };
            let (mut factor, rest) = if link == Link::Over {
                self.below(&factors)?
            } else {
                (self.group()?, None)
            };
            if let Some(at) = negative {
                let stop = factor.end;
                factor = Written::new(Shape::Sum(vec![(Sign::Minus, factor)]), at, stop);
            }
            end = factor.end;
            if link == Link::Cross
                && let Some((_, before)) = factors.last()
            {
                self.crossed(before, &factor)?;
            }
            factors.push((link, factor));
            if let Some(rest) = rest {
                end = rest.end;
                factors.push((Link::Beside, rest));
            }
        }
        match first {
            Some(only) => Ok(only),
            None => Ok(Written::new(Shape::Product(factors), start, end)),
        }
    }

    /// × between two symbols that no arrow makes vectors: a product of numbers, unless one is a cross product itself.
    fn crossed(&mut self, before: &Written, behind: &Written) -> Faulty<()> {
        let plain = |w: &Written| !w.is_numeric() && !w.is_vector();
        if !plain(before) || !plain(behind) {
            return Ok(());
        }
        let nested = |w: &Written| {
            let Shape::Bracket(inner) = &w.shape else {
                return false;
            };
            matches!(&inner.shape, Shape::Product(factors)
                if factors.iter().any(|(link, f)| *link == Link::Cross && !f.is_numeric()))
        };
        let (start, end) = (before.start, behind.end);
        if nested(before) || nested(behind) {
            let fault = Fault::new("a cross product of symbols without arrows", start, end);
            return Err(fault.hint("write \\vec{r} \\times \\vec{p} for vectors, * for a product"));
        }
        self.lexer.note(Remark::Cross, start, start, end);
        Ok(())
    }

    /// What stands below a slash, and what follows it: a product without signs and spaces stands below, but behind a
    /// fraction of two whole numbers only the number does.
    fn below(&mut self, above: &[(Link, Written)]) -> Faulty<(Written, Option<Written>)> {
        let first = self.factor()?;
        if !self.starts_factor()? {
            return Ok((first, None));
        }
        // `1/2mv²` is half of the rest to everybody.
        let whole = |w: &Written| matches!(&w.shape, Shape::Number(n) if !n.decimal);
        let half = match above {
            [(_, number)] => whole(number) && whole(&first) && first.start == number.end + 1,
            _ => false,
        };
        // Brackets show where the divisor ends: `3v/(2l) cosθ`.
        let enclosed = matches!(first.shape, Shape::Bracket(_));
        let vector = matches!(&self.peek()?.tok, Tok::Name(name) if is_unit_vector(name));
        if vector || enclosed {
            return Ok((first, Some(self.group()?)));
        }
        let usual = self.lexer.usual_slash(self.arguments > 0);
        let from = above.last().map_or(first.start, |(_, w)| w.start);
        let middle = first.end;
        let parted = half || self.peek()?.spaced;
        let product = if parted {
            first
        } else {
            self.group_until(Some(first), true)?
        };
        let (below, rest) = match (parted || self.starts_factor()?, usual) {
            (true, true) => (product, Some(self.group()?)),
            (true, false) => vector_above(self.group_from(Some(product))?),
            (false, true) => vector_above(product),
            (false, false) => first_alone(product),
        };
        if self.arguments == 0 {
            let tight = rest.is_none();
            let middle = if tight { middle } else { below.end };
            let end = rest.as_ref().map_or(below.end, |r| r.end);
            self.lexer.note(Remark::Slash { tight }, from, middle, end);
        }
        Ok((below, rest))
    }

    /// Factors side by side.
    fn group(&mut self) -> Faulty<Written> {
        let first = self.factor()?;
        self.group_from(Some(first))
    }

    pub(super) fn group_from(&mut self, first: Option<Written>) -> Faulty<Written> {
        self.group_until(first, false)
    }

    /// Factors side by side, in a `tight` one up to the first space.
    fn group_until(&mut self, first: Option<Written>, tight: bool) -> Faulty<Written> {
        let first = match first {
            Some(first) => first,
            None => self.factor()?,
        };
        if !self.starts_factor()? {
            return Ok(first);
        }
        let (start, mut end) = (first.start, first.end);
        let mut factors = vec![(Link::Beside, first)];
        while self.starts_factor()? && !(tight && self.peek()?.spaced) {
            if let (
                Tok::Number(_),
                Some((
                    _,
                    Written {
                        shape: Shape::Number(_),
                        ..
                    },
                )),
            ) = (&self.peek()?.tok, factors.last())
            {
                let token = self.next()?;
                return Err(self.unexpected(&token).hint("write * for a product"));
            }
            let factor = self.factor()?;
            if let Some((_, before)) = factors.last() {
                beside(before, &factor)?;
            }
            end = factor.end;
            factors.push((Link::Beside, factor));
        }
        Ok(Written::new(Shape::Product(factors), start, end))
    }

    pub(super) fn starts_factor(&mut self) -> Faulty<bool> {
        let bars = self.bars;
        Ok(match self.peek()?.tok {
            Tok::Number(_)
            | Tok::Name(_)
            | Tok::Call(_)
            | Tok::Reciprocal(_)
            | Tok::Logarithm(_)
            | Tok::LogarithmTo
            | Tok::Area(_)
            | Tok::RootOf
            | Tok::Exponential
            | Tok::Signum
            | Tok::Root(_)
            | Tok::Fraction => true,
            Tok::Open(_) | Tok::OpenBar | Tok::Vulgar(..) => true,
            Tok::Bar => bars == 0,
            _ => false,
        })
    }

    /// A value with its exponents.
    pub(super) fn factor(&mut self) -> Faulty<Written> {
        let primary = self.primary()?;
        self.raised(primary)
    }

    pub(super) fn raised(&mut self, mut base: Written) -> Faulty<Written> {
        loop {
            match self.peek()?.tok {
                Tok::Caret => {
                    self.next()?;
                    let exponent = self.exponent()?;
                    let (start, end) = (base.start, exponent.end);
                    base =
                        Written::new(Shape::Power(Box::new(base), Box::new(exponent)), start, end);
                    if let Tok::Caret | Tok::Raised(_) = self.peek()?.tok {
                        let token = self.next()?;
                        return Err(Fault::new(
                            "two exponents on one base",
                            token.start,
                            token.end,
                        )
                        .hint("write brackets"));
                    }
                }
                Tok::Raised(_) => {
                    let token = self.next()?;
                    let exponent = raised_number(&token);
                    let (start, end) = (base.start, token.end);
                    base =
                        Written::new(Shape::Power(Box::new(base), Box::new(exponent)), start, end);
                    if let Tok::Caret | Tok::Raised(_) = self.peek()?.tok {
                        let token = self.next()?;
                        return Err(Fault::new(
                            "two exponents on one base",
                            token.start,
                            token.end,
                        )
                        .hint("write brackets"));
                    }
                }
                Tok::Percent => {
                    let end = self.next()?.end;
                    let start = base.start;
                    let hundred = Box::new(whole_number(100, start, end));
                    base = Written::new(Shape::Fraction(Box::new(base), hundred), start, end);
                }
                Tok::Degree => {
                    let token = self.next()?;
                    if !base.is_numeric() {
                        let message = "degrees stand behind a number";
                        return Err(Fault::new(message, token.start, token.end));
                    }
                    let (start, end) = (base.start, token.end);
                    base = Written::new(Shape::Degrees(Box::new(base)), start, end);
                }
                _ => return Ok(base),
            }
        }
    }

    /// An exponent behind `^`: a sign and one factor; a further `^` belongs to the exponent.
    pub(super) fn exponent(&mut self) -> Faulty<Written> {
        self.deeper(|p| {
            let (start, sign) = (p.peek()?.start, p.sign()?);
            let mut inner = p.primary()?;
            if let Tok::Caret = p.peek()?.tok {
                p.next()?;
                let above = p.exponent()?;
                let (from, to) = (inner.start, above.end);
                inner = Written::new(Shape::Power(Box::new(inner), Box::new(above)), from, to);
            }
            let end = inner.end;
            Ok(match sign {
                None | Some(Sign::Plus) => inner,
                Some(sign) => Written::new(Shape::Sum(vec![(sign, inner)]), start, end),
            })
        })
    }

    pub(super) fn primary(&mut self) -> Faulty<Written> {
        let token = self.next()?;
        let (start, end) = (token.start, token.end);
        match token.tok {
            Tok::Number(literal) => Ok(Written::new(Shape::Number(literal), start, end)),
            Tok::Name(name) => Ok(Written::new(Shape::Symbol(name), start, end)),
            Tok::Vulgar(n, d) => Ok(vulgar(n, d, start, end)),
            Tok::Open(open) => self.bracket(open, start, end),
            Tok::Relation(Relation::Less) => self.bracket('<', start, end),
            Tok::Bar => {
                let outer = std::mem::replace(&mut self.bars, 1);
                let inner = self.sum()?;
                self.bars = outer;
                let close = self.next()?;
                match close.tok {
                    Tok::Bar => Ok(Written::new(Shape::Abs(Box::new(inner)), start, close.end)),
                    _ => Err(self.unclosed("|", start, end, &close)),
                }
            }
            Tok::OpenBar => {
                let outer = std::mem::replace(&mut self.bars, 0);
                let inner = self.sum()?;
                self.bars = outer;
                let close = self.next()?;
                match close.tok {
                    Tok::CloseBar => {
                        Ok(Written::new(Shape::Abs(Box::new(inner)), start, close.end))
                    }
                    _ => Err(self.unclosed("|", start, end, &close)),
                }
            }
            Tok::Fraction => self.deeper(|p| {
                let above = p.argument("the numerator")?;
                let below = p.argument("the denominator")?;
                let stop = below.end;
                Ok(Written::new(
                    Shape::Fraction(Box::new(above), Box::new(below)),
                    start,
                    stop,
                ))
            }),
            Tok::Root(index) => self.deeper(|p| p.root(index, start, end)),
            Tok::Call(function) => self.deeper(|p| p.call(function, false, start, end)),
            Tok::Reciprocal(function) => self.deeper(|p| p.call(function, true, start, end)),
            Tok::Logarithm(base) => {
                let base = whole_number(base, start, end);
                self.deeper(|p| p.logarithm(base, start, end))
            }
            Tok::LogarithmTo => self.deeper(|p| {
                let base = p.argument("the base of the logarithm")?;
                p.logarithm(base, start, end)
            }),
            Tok::Area(function) => self.deeper(|p| p.area(function, start, end)),
            Tok::RootOf => self.deeper(|p| p.root_of(start)),
            Tok::Exponential => self.deeper(|p| p.exponential(start, end)),
            Tok::Signum => self.deeper(|p| p.signum(start)),
            _ => Err(self.missing(&token)),
        }
    }

    fn unclosed(&self, open: &str, start: usize, end: usize, at: &Token) -> Box<Fault> {
        match at.tok {
            Tok::End => Fault::new(
                format!("`{open}` is opened here and never closed"),
                start,
                end,
            ),
            _ => {
                let shown: String = self.lexer.text[at.start..at.end].chars().take(24).collect();
                let message = format!(
                    "`{shown}` stands where the `{open}` opened at byte {start} should be closed"
                );
                Fault::new(message, at.start, at.end)
            }
        }
    }

    fn bracket(&mut self, open: char, start: usize, opened: usize) -> Faulty<Written> {
        let outer = std::mem::replace(&mut self.bars, 0);
        let lists = open == '[' || open == '<' || open == '(' && self.lexer.lists();
        let list = std::mem::replace(&mut self.lexer.list, lists);
        let mut parts = vec![self.sum()?];
        let mut token = self.next()?;
        if token.tok == Tok::Over
            && open == '{'
            && let Some(above) = parts.pop()
        {
            let below = self.sum()?;
            let (from, to) = (above.start, below.end);
            let shape = Shape::Fraction(Box::new(above), Box::new(below));
            parts.push(Written::new(shape, from, to));
            token = self.next()?;
        }
        while token.tok == Tok::Comma && open != '{' {
            if parts.len() >= 3 {
                return Err(Fault::new(
                    "a vector has at most three components",
                    token.start,
                    token.end,
                ));
            }
            parts.push(self.sum()?);
            token = self.next()?;
        }
        self.bars = outer;
        self.lexer.list = list;
        let close = match open {
            '(' => ')',
            '[' => ']',
            '{' => '}',
            'm' => 'm',
            _ => '>',
        };
        let angled = open == '<' && token.tok == Tok::Relation(Relation::Greater);
        if token.tok != Tok::Close(close) && !(angled && parts.len() > 1) {
            let shown = self.lexer.text[start..opened].to_string();
            return Err(self.unclosed(&shown, start, opened, &token));
        }
        let shape = match parts.pop() {
            Some(_) if parts.is_empty() && matches!(open, 'm' | '<') => {
                let fault = Fault::new("a vector has two or three components", start, token.end);
                return Err(fault);
            }
            Some(only) if parts.is_empty() => Shape::Bracket(Box::new(only)),
            Some(last) => {
                parts.push(last);
                Shape::List(parts)
            }
            None => return Err(self.missing(&token)),
        };
        Ok(Written::new(shape, start, token.end))
    }

    /// One argument of a LaTeX command: a group, or a single digit, letter or command.
    pub(super) fn argument(&mut self, what: &str) -> Faulty<Written> {
        if self.peeked.is_none() {
            self.lexer.single = true;
        }
        let token = self.peek()?;
        match token.tok {
            Tok::Number(_)
            | Tok::Name(_)
            | Tok::Open('{' | '(')
            | Tok::Fraction
            | Tok::Root(_)
            | Tok::Vulgar(..) => self.primary(),
            _ => {
                let token = self.next()?;
                Err(Fault::new(
                    format!("{what} is expected here"),
                    token.start,
                    token.end,
                ))
            }
        }
    }
}

/// Two neighbours that people read as a sum or as one number: `1½`, `2\frac12`, `x^1 0`.
fn beside(before: &Written, factor: &Written) -> Faulty<()> {
    let whole = |w: &Written| matches!(&w.shape, Shape::Number(n) if !n.decimal);
    let inner = |w: &Written| match &w.shape {
        Shape::Bracket(inner) => whole(inner),
        _ => whole(w),
    };
    let mixed = match &factor.shape {
        Shape::Fraction(above, below) => whole(before) && inner(above) && inner(below),
        _ => false,
    };
    if mixed {
        let fault = Fault::new("a mixed number or a product", before.start, factor.end);
        return Err(fault.hint("write 3/2 or 1 + 1/2 for one and a half, and * for a product"));
    }
    match (&before.shape, &factor.shape) {
        (Shape::Power(_, exponent), Shape::Number(_)) if whole(exponent) => {
            let fault = Fault::new(
                "a number directly behind an exponent",
                before.start,
                factor.end,
            );
            Err(fault.hint("write braces around the exponent, or * for a product"))
        }
        _ => Ok(()),
    }
}

/// A unit vector never stands below: 3v/2ℓ k̂.
fn vector_above(mut below: Written) -> (Written, Option<Written>) {
    let last = match &mut below.shape {
        Shape::Product(factors) if factors.last().is_some_and(|(_, f)| ends_in_unit_vector(f)) => {
            factors.pop()
        }
        _ => None,
    };
    if let Some((_, vector)) = &last {
        below.end = vector.start;
    }
    (below, last.map(|(_, vector)| vector))
}

/// The first factor of a product, and the others.
fn first_alone(product: Written) -> (Written, Option<Written>) {
    let end = product.end;
    let Shape::Product(mut factors) = product.shape else {
        return (product, None);
    };
    let (_, first) = factors.remove(0);
    let start = factors.first().map_or(end, |(_, f)| f.start);
    (
        first,
        Some(Written::new(Shape::Product(factors), start, end)),
    )
}

fn is_unit_vector(name: &str) -> bool {
    matches!(name, "i_hat" | "j_hat" | "k_hat")
}

fn ends_in_unit_vector(written: &Written) -> bool {
    matches!(&written.shape, Shape::Symbol(name) if is_unit_vector(name))
}

pub(super) fn whole_number(value: i64, start: usize, end: usize) -> Written {
    let literal = Literal {
        value: ratio(value, 1),
        digits: 1,
        place: 0,
        decimal: false,
    };
    Written::new(Shape::Number(literal), start, end)
}

pub(super) fn raised_number(token: &Token) -> Written {
    let value = match &token.tok {
        Tok::Raised(value) => value.clone(),
        _ => ratio(1, 1),
    };
    let literal = Literal {
        value,
        digits: 1,
        place: 0,
        decimal: false,
    };
    Written::new(Shape::Number(literal), token.start, token.end)
}

fn vulgar(n: i64, d: i64, start: usize, end: usize) -> Written {
    let part = |value| Box::new(whole_number(value, start, end));
    Written::new(Shape::Fraction(part(n), part(d)), start, end)
}
