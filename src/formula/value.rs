//! Values: numbers, names, brackets, fractions, and what is raised behind them.

use super::Relation;
use super::fault::{Fault, Faulty};
use super::parser::Parser;
use super::token::{Before, Literal, Tok, Token};
use super::written::{Shape, Sign, Written};
use crate::expr::{Function, ratio};

impl Parser<'_> {
    /// A value with its exponents.
    pub(super) fn factor(&mut self) -> Faulty<Written> {
        let primary = self.primary()?;
        self.raised(primary)
    }

    pub(super) fn raised(&mut self, mut base: Written) -> Faulty<Written> {
        loop {
            match self.peek()?.tok {
                Tok::Caret | Tok::Raised(_) => {
                    let token = self.next()?;
                    // A row or a column: which of them it is says nothing of a vector.
                    if let (Shape::List(_), Tok::Caret) = (&base.shape, &token.tok)
                        && let Some(length) = transposed(&self.lexer.text[self.lexer.pos..])
                    {
                        self.lexer.pos += length;
                        base = turned(base);
                        continue;
                    }
                    let exponent = match token.tok {
                        Tok::Caret => self.exponent()?,
                        _ => raised_number(&token),
                    };
                    base = base.power(exponent);
                    if let Tok::Caret | Tok::Raised(_) = self.peek()?.tok {
                        let token = self.next()?;
                        return Err(token
                            .fault("two exponents on one base")
                            .hint("write brackets"));
                    }
                }
                Tok::Percent(of) => {
                    let end = self.next()?.end;
                    base = base.clone().over(whole_number(of, base.start, end));
                }
                Tok::Degree => {
                    let token = self.next()?;
                    // `sin(45)°` is no number of degrees, and an arcsine is one.
                    let arc = match &base.shape {
                        Shape::Call(Function::Asin | Function::Acos | Function::Atan, inner) => {
                            inner.is_bare_number()
                        }
                        _ => base.is_numeric(),
                    };
                    if !arc {
                        let message = "degrees stand behind a number";
                        return Err(token.fault(message));
                    }
                    let (start, end) = (base.start, token.end);
                    base = Written::new(Shape::Degrees(Box::new(base)), start, end);
                }
                _ => return Ok(base),
            }
        }
    }

    /// One of a unit that is a group of its own.
    fn unit_alone(&mut self) -> Option<Written> {
        let start = self.lexer.pos;
        let unit = self.peeked.is_none().then(|| self.lexer.unit_group())??;
        self.units += 1;
        let end = self.lexer.pos;
        let one = Box::new(whole_number(1, start, end));
        Some(Written::new(
            Shape::Measured(one, Box::new(unit)),
            start,
            end,
        ))
    }

    /// An exponent behind `^`: a sign and one factor; a further `^` belongs to the exponent.
    pub(super) fn exponent(&mut self) -> Faulty<Written> {
        self.deeper(|p| {
            let (start, sign) = (p.peek()?.start, p.sign()?);
            let mut inner = p.primary()?;
            if let Tok::Caret = p.peek()?.tok {
                p.next()?;
                let above = p.exponent()?;
                inner = inner.power(above);
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
            Tok::Open('v') => Ok(self.bracket('m', start, end)?.inside(Shape::Abs)),
            Tok::Open(open) => self.bracket(open, start, end),
            Tok::Relation(Relation::Less) => self.bracket('<', start, end),
            Tok::Bar | Tok::OpenBar => {
                let (bars, closing) = match token.tok {
                    Tok::Bar => (1, Tok::Bar),
                    _ => (0, Tok::CloseBar),
                };
                let outer = std::mem::replace(&mut self.bars, bars);
                let inner = self.sum()?;
                self.bars = outer;
                let close = self.next()?;
                match close.tok == closing {
                    true => Ok(inner.inside(Shape::Abs).at(start, close.end)),
                    false => Err(self.unclosed("|", start, end, &close)),
                }
            }
            Tok::Fraction => self.deeper(|p| {
                let above = p.argument("the numerator")?;
                let below = match p.unit_alone() {
                    Some(unit) => unit,
                    None => p.argument("the denominator")?,
                };
                let stop = below.end;
                Ok(above.over(below).at(start, stop))
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
            Tok::Pair(function) => self.deeper(|p| p.pair(function, start)),
            Tok::Exponential => self.deeper(|p| p.exponential(start, end)),
            Tok::Signum => self.deeper(|p| p.signum(start)),
            Tok::Determinant => self.deeper(|p| {
                let inner = p.primary()?;
                match inner.is_matrix() {
                    true => Ok(inner.inside(Shape::Abs)),
                    false => Err(inner.fault("a determinant is of a matrix")),
                }
            }),
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
                let shown = self.shown(at);
                let message = format!(
                    "`{shown}` stands where the `{open}` opened at byte {start} should be closed"
                );
                at.fault(message)
            }
        }
    }

    /// What stands above `\over`, with what follows as its divisor.
    pub(super) fn over(&mut self, above: Written) -> Faulty<Written> {
        let below = self.sum()?;
        Ok(above.over(below))
    }

    fn bracket(&mut self, open: char, start: usize, opened: usize) -> Faulty<Written> {
        let outer = std::mem::replace(&mut self.bars, 0);
        let lists = open == '[' || open == '<' || open == '(' && self.lexer.lists();
        let list = std::mem::replace(&mut self.lexer.list, lists);
        let mut parts = vec![self.sum()?];
        let mut rows = Vec::new();
        let mut token = self.next()?;
        if token.tok == Tok::Over
            && open == '{'
            && let Some(above) = parts.pop()
        {
            parts.push(self.over(above)?);
            token = self.next()?;
        }
        while matches!(token.tok, Tok::Comma | Tok::EndOfRow) && open != '{' {
            if token.tok == Tok::EndOfRow {
                rows.push(row(std::mem::take(&mut parts)));
                // Some end the last row too.
                if self.peek()?.tok == Tok::Close('m') {
                    token = self.next()?;
                    break;
                }
            }
            if parts.len() >= 3 || rows.len() >= 3 {
                let message = "a vector has at most three components, a matrix three rows";
                return Err(token.fault(message));
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
        if angled {
            self.lexer.before = Before::Value;
        }
        if token.tok != Tok::Close(close) && !(angled && parts.len() > 1) {
            let shown = self.lexer.text[start..opened].to_string();
            return Err(self.unclosed(&shown, start, opened, &token));
        }
        if !rows.is_empty() {
            if !parts.is_empty() {
                rows.push(row(parts));
            }
            parts = rows;
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
                Err(token.fault(format!("{what} is expected here")))
            }
        }
    }
}

/// A row of a matrix; the only entry of a row is a component.
fn row(mut entries: Vec<Written>) -> Written {
    let (start, end) = (entries[0].start, entries[entries.len() - 1].end);
    match entries.len() {
        1 => entries.remove(0),
        _ => Written::new(Shape::List(entries), start, end),
    }
}

/// A matrix with its rows as columns; a vector as it is.
fn turned(matrix: Written) -> Written {
    let entries: Vec<Vec<&Written>> = match &matrix.shape {
        Shape::List(rows) if matrix.is_matrix() => rows.iter().map(Written::pieces).collect(),
        _ => return matrix,
    };
    let length = entries[0].len();
    if entries.iter().any(|row| row.len() != length) {
        return matrix;
    }
    let column = |k: usize| entries.iter().map(|row| row[k].clone()).collect();
    let rows = (0..length).map(|k| row(column(k))).collect();
    Written::new(Shape::List(rows), matrix.start, matrix.end)
}

pub(super) fn whole_number(value: i64, start: usize, end: usize) -> Written {
    Written::new(Shape::Number(Literal::of(ratio(value, 1))), start, end)
}

pub(super) fn raised_number(token: &Token) -> Written {
    let value = match &token.tok {
        Tok::Raised(value) => value.clone(),
        _ => ratio(1, 1),
    };
    Written::new(Shape::Number(Literal::of(value)), token.start, token.end)
}

fn vulgar(n: i64, d: i64, start: usize, end: usize) -> Written {
    whole_number(n, start, end).over(whole_number(d, start, end))
}

/// The bytes of the mark of a transpose behind `^`.
fn transposed(rest: &str) -> Option<usize> {
    let inside = rest.strip_prefix('{');
    let mark = inside.unwrap_or(rest).trim_start_matches(' ');
    const MARKS: &str = r"T|\top|\intercal|\mathsf{T}|\mathsf T|\mathrm{T}|\mathrm T";
    let behind = MARKS
        .split('|')
        .find_map(|known| mark.strip_prefix(known))?;
    let behind = match inside {
        Some(_) => behind.strip_prefix('}')?,
        None => behind,
    };
    (!behind.starts_with(|c: char| c.is_alphanumeric())).then(|| rest.len() - behind.len())
}
