//! Functions and roots, and how far they reach without brackets.

use super::fault::{Fault, Faulty};
use super::inverse::inverse;
use super::note::Remark;
use super::parser::Parser;
use super::token::Tok;
use super::value::{raised_number, whole_number};
use super::written::{Link, Shape, Sign, Written};
use crate::expr::{Function, ratio};

impl Parser<'_> {
    pub(super) fn root(&mut self, index: i64, start: usize, end: usize) -> Faulty<Written> {
        let tex = self.lexer.text[start..].starts_with('\\');
        let mut degree = (index != 2).then(|| Box::new(whole_number(index, start, end)));
        let mut inner = None;
        if index == 2 && self.lexer.text[end..].starts_with('[') {
            // `sqrt[3]{x}` has an index, `sqrt[x+1]` an argument.
            let bracket = self.primary()?;
            let braced = matches!(self.peek()?.tok, Tok::Open('{' | '('));
            match bracket.shape {
                Shape::Bracket(index) if tex || braced => degree = Some(index),
                shape => inner = Some(Written::new(shape, bracket.start, bracket.end)),
            }
        }
        let inner = match inner {
            Some(inner) => inner,
            None if tex => self.argument("what stands under the root")?,
            None => self.primary()?,
        };
        let bracketed = matches!(
            inner.shape,
            Shape::Bracket(_) | Shape::Call(..) | Shape::Root(..) | Shape::Fraction(..)
        );
        let shown = !tex && !bracketed && self.starts_factor()?;
        let mut inner = inner;
        if shown {
            let usual = self.lexer.usual();
            let middle = inner.end;
            if usual {
                let stop = self.peek()?.end;
                self.lexer
                    .note(Remark::Root { long: false }, start, middle, stop);
            } else {
                inner = self.group_from(Some(inner))?;
                self.lexer
                    .note(Remark::Root { long: true }, start, middle, inner.end);
            }
        }
        let stop = inner.end;
        Ok(Written::new(
            Shape::Root(degree, Box::new(inner)),
            start,
            stop,
        ))
    }

    /// A function: its own exponent, then its argument.
    pub(super) fn call(
        &mut self,
        function: Function,
        reciprocal: bool,
        start: usize,
        end: usize,
    ) -> Faulty<Written> {
        self.arguments += 1;
        let called = self.call_here(function, reciprocal, start, end);
        self.arguments -= 1;
        called
    }

    fn call_here(
        &mut self,
        function: Function,
        reciprocal: bool,
        start: usize,
        end: usize,
    ) -> Faulty<Written> {
        let mut exponent = None;
        match self.peek()?.tok {
            Tok::Caret => {
                self.next()?;
                exponent = Some(self.exponent()?);
            }
            Tok::Raised(_) => exponent = Some(raised_number(&self.next()?)),
            _ => {}
        }
        let minus_one = exponent
            .as_ref()
            .and_then(Written::literal)
            .is_some_and(|k| k.value == ratio(-1, 1));
        let inverses = matches!(function, Function::Asin | Function::Acos | Function::Atan);
        let is_inverse = inverses || minus_one;
        let argument = match self.peek()?.tok {
            Tok::Open('(') if function == Function::Ln => {
                // log(u, b) has its base behind a comma.
                let list = std::mem::replace(&mut self.lexer.list, true);
                let inner = self.primary();
                self.lexer.list = list;
                let inner = inner?;
                match inner.shape {
                    Shape::List(mut parts) if parts.len() == 2 && exponent.is_none() => {
                        let (base, stop) = (parts.remove(1), inner.end);
                        let above = parts.remove(0).call(Function::Ln);
                        return Ok(above.over(base.call(Function::Ln)).at(start, stop));
                    }
                    shape => Written::new(shape, inner.start, inner.end),
                }
            }
            Tok::Open('[') if function == Function::Ln => {
                let inner = self.primary()?;
                match inner.shape {
                    // As Mathematica writes it, `Log[b, x]`, the base comes first.
                    Shape::List(mut parts) if parts.len() == 2 && exponent.is_none() => {
                        let (above, stop) = (parts.remove(1), inner.end);
                        let base = parts.remove(0).call(Function::Ln);
                        return Ok(above.call(Function::Ln).over(base).at(start, stop));
                    }
                    shape => Written::new(shape, inner.start, inner.end),
                }
            }
            _ => self.taken_of(function, is_inverse, start, end)?,
        };
        let trigonometric = matches!(function, Function::Sin | Function::Cos | Function::Tan);
        if trigonometric && plain_number(&argument) {
            self.lexer.note(
                Remark::Radians,
                argument.start,
                argument.start,
                argument.end,
            );
        }
        let stop = argument.end;
        let hyperbolic = matches!(function, Function::Sinh | Function::Cosh | Function::Tanh);
        if minus_one && (hyperbolic || trigonometric) {
            let raised_end = exponent.map_or(end, |e| e.end);
            if !hyperbolic {
                self.lexer.note(Remark::Inverse, start, start, raised_end);
            }
            return Ok(inverse(function, reciprocal, argument, [start, stop]));
        }
        let argument = Box::new(argument);
        let shape = if reciprocal {
            Shape::Reciprocal(function, argument)
        } else {
            Shape::Call(function, argument)
        };
        let called = Written::new(shape, start, stop);
        Ok(match exponent {
            Some(exponent) => called.power(exponent).at(start, stop),
            None => called,
        })
    }

    /// What a function is taken of: in brackets or bars, or what stands behind it without them.
    fn taken_of(
        &mut self,
        function: Function,
        is_inverse: bool,
        start: usize,
        end: usize,
    ) -> Faulty<Written> {
        let in_bars = self.bars > 0;
        let first = self.peek()?;
        match first.tok {
            Tok::Open(_) | Tok::Bar | Tok::OpenBar if first.tok != Tok::Bar || !in_bars => {
                self.primary()
            }
            Tok::Minus | Tok::Plus => {
                let (at, sign) = (first.start, self.sign()?);
                let inner = self.bare_argument(is_inverse)?;
                let stop = inner.end;
                let signed = Shape::Sum(vec![(sign.unwrap_or(Sign::Plus), inner)]);
                Ok(Written::new(signed, at, stop))
            }
            Tok::Number(_)
            | Tok::Name(_)
            | Tok::Vulgar(..)
            | Tok::Fraction
            | Tok::Root(_)
            | Tok::Call(_)
            | Tok::Reciprocal(_)
            | Tok::Exponential
            | Tok::Logarithm(_) => self.bare_argument(is_inverse),
            _ => {
                let token = self.next()?;
                let message = format!("{} needs an argument", function.name());
                Err(Fault::new(message, start, end.max(token.start)))
            }
        }
    }

    /// e as the base of the natural logarithm: exp of the exponent behind it, or of 1.
    pub(super) fn exponential(&mut self, start: usize, end: usize) -> Faulty<Written> {
        let exponent = match self.peek()?.tok {
            Tok::Caret => {
                self.next()?;
                self.exponent()?
            }
            Tok::Raised(_) => raised_number(&self.next()?),
            _ => whole_number(1, start, end),
        };
        let stop = exponent.end;
        Ok(exponent.call(Function::Exp).at(start, stop))
    }

    /// `log_2 x` is ln x over ln 2.
    pub(super) fn logarithm(&mut self, base: Written, start: usize, end: usize) -> Faulty<Written> {
        let above = self.call(Function::Ln, false, start, end)?;
        let stop = above.end;
        let (above, power) = match above.shape {
            Shape::Power(called, exponent) => (*called, Some(*exponent)),
            _ => (above, None),
        };
        let below = base.call(Function::Ln).at(start, end);
        let quotient = above.over(below).at(start, stop);
        Ok(match power {
            Some(power) => quotient.power(power).at(start, stop),
            None => quotient,
        })
    }

    /// `sgn(x)` is x over |x|, which has no value at zero.
    pub(super) fn signum(&mut self, start: usize) -> Faulty<Written> {
        let above = self.primary()?;
        self.copies(&above)?;
        let stop = above.end;
        let size = above.clone().inside(Shape::Abs);
        Ok(above.over(size).at(start, stop))
    }

    /// The argument of a function without brackets: numbers, then one angle, or a product of names such as ω t; of an inverse
    /// one also their quotient, as in `arcsin v/c`.
    fn bare_argument(&mut self, is_inverse: bool) -> Faulty<Written> {
        let first = self.factor()?;
        if let Shape::Call(..) | Shape::Reciprocal(..) = first.shape {
            return Ok(first);
        }
        let (start, mut end) = (first.start, first.end);
        let mut numeric = first.is_numeric();
        let mut counted = is_counted(&first);
        let mut angle = self.has_angle(&first);
        let mut named = is_name(&first);
        let mut factors = vec![(Link::Beside, first)];
        loop {
            let token = self.peek()?.clone();
            let name = match &token.tok {
                Tok::Name(name) => Some(name.clone()),
                _ => None,
            };
            let hat = name.as_ref().is_some_and(|n| n.contains("_hat"));
            let goes_on = match &token.tok {
                Tok::Name(_) if hat => false,
                Tok::Name(_) | Tok::Root(_) | Tok::Fraction | Tok::Open(_) if numeric => true,
                Tok::Name(name) if named => {
                    let both = angle && self.lexer.is_angle(name);
                    let usual = self.lexer.usual();
                    let long = (!angle || both) == usual;
                    self.lexer
                        .note(Remark::Argument { long }, start, end, token.end);
                    long
                }
                // `\sin\frac{n\pi}{L}x`: of the fraction, or of all of it.
                Tok::Name(_) if factors.len() == 1 && self.is_open_fraction(&factors[0].1) => {
                    let long = !self.lexer.usual();
                    self.lexer
                        .note(Remark::Argument { long }, start, end, token.end);
                    long
                }
                Tok::Slash => {
                    let rest = &self.lexer.text[self.lexer.pos..];
                    let tight = !token.spaced;
                    let begins = |c: char| c.is_alphabetic() || "\\√(".contains(c);
                    let digits = rest.starts_with(|c: char| c.is_ascii_digit());
                    // sinθ/2: half of the sine, unless somebody meant the half angle.
                    let half = named && lone_number(rest);
                    // `arctan 3/4` and `sin π/6`: of the quotient, unless somebody meant the number above alone.
                    let counts = (counted || is_inverse && numeric) && tight && quotient_ends(rest);
                    let quotient = is_inverse
                        && tight
                        && (named && digits || (named || numeric) && rest.starts_with(begins));
                    if half || counts || quotient {
                        let long = self.lexer.usual() != half;
                        let ends = |c: char| " +-−±=≈<>≤≥]|,;$*·".contains(c);
                        let mut stop = token.end + rest.find(ends).unwrap_or(rest.len());
                        if long {
                            self.next()?;
                            let below = self.tight_below()?;
                            stop = below.end;
                            factors.push((Link::Over, below));
                        }
                        self.lexer.note(Remark::Argument { long }, start, end, stop);
                        end = if long { stop } else { end };
                    }
                    false
                }
                _ => false,
            };
            if !goes_on {
                break;
            }
            let factor = self.factor()?;
            counted &= is_counted(&factor);
            end = factor.end;
            let still = factor.is_numeric();
            angle |= self.has_angle(&factor);
            named = is_name(&factor);
            factors.push((Link::Beside, factor));
            if numeric && !still && !named {
                break;
            }
            numeric &= still;
        }
        match factors.pop() {
            Some((_, only)) if factors.is_empty() => Ok(only),
            Some(last) => {
                factors.push(last);
                Ok(Written::new(Shape::Product(factors), start, end))
            }
            None => Err(Fault::new("an argument is missing", start, end)),
        }
    }

    /// What stands below a slash in an argument: brackets, or a product without spaces.
    fn tight_below(&mut self) -> Faulty<Written> {
        let first = self.factor()?;
        match first.shape {
            Shape::Bracket(_) => Ok(first),
            _ => self.group_until(Some(first), true),
        }
    }

    /// Whether a fraction of names holds no angle, so that it need not be all that a function is taken of.
    fn is_open_fraction(&self, written: &Written) -> bool {
        let Shape::Fraction(above, below) = &written.shape else {
            return false;
        };
        !written.is_numeric() && !self.holds_angle(above) && !self.holds_angle(below)
    }

    fn holds_angle(&self, written: &Written) -> bool {
        match &written.shape {
            Shape::Product(factors) => factors.iter().any(|(_, f)| self.holds_angle(f)),
            Shape::Sum(terms) => terms.iter().any(|(_, t)| self.holds_angle(t)),
            Shape::Bracket(inner) => self.holds_angle(inner),
            _ => self.has_angle(written),
        }
    }

    pub(super) fn has_angle(&self, written: &Written) -> bool {
        match &written.shape {
            Shape::Symbol(name) => self.lexer.is_angle(name),
            Shape::Power(base, _) => self.has_angle(base),
            _ => false,
        }
    }
}

/// Whether the text goes on with a whole number that nothing multiplies.
fn lone_number(text: &str) -> bool {
    let rest = text.trim_start();
    let behind = rest.trim_start_matches(|c: char| c.is_ascii_digit());
    let next = behind.trim_start().chars().next();
    behind.len() < rest.len() && next.is_none_or(|c| "+-−±=<>)]}|,$".contains(c))
}

/// Whether the text goes on with a whole number that ends what stands below a slash.
fn quotient_ends(text: &str) -> bool {
    let behind = text.trim_start_matches(|c: char| c.is_ascii_digit());
    let next = behind.chars().next();
    behind.len() < text.len() && next.is_none_or(|c| " +-−±=≈<>≤≥)]}|,;$*·\\".contains(c))
}

/// Whether it is a number, or π.
fn is_counted(written: &Written) -> bool {
    match &written.shape {
        Shape::Number(_) => true,
        Shape::Symbol(name) => &**name == "pi",
        _ => false,
    }
}

fn is_name(written: &Written) -> bool {
    match &written.shape {
        Shape::Symbol(name) => &**name != "pi",
        Shape::Power(base, _) => is_name(base),
        _ => false,
    }
}

/// A whole number other than 0, with or without brackets and sign.
fn plain_number(written: &Written) -> bool {
    match &written.shape {
        Shape::Number(n) => n.value != ratio(0, 1),
        Shape::Bracket(inner) => plain_number(inner),
        Shape::Sum(terms) => matches!(terms.as_slice(), [(_, inner)] if plain_number(inner)),
        _ => false,
    }
}
