//! Sums, and products with and without signs.

use super::names::no_unit;
use super::reader::{Peek, Piece, Reader, Tie};
use super::{Builder, Table};
use crate::formula::tex::shows_space;

impl<B: Builder> Reader<'_, B> {
    pub(super) fn sum(&mut self) -> Option<Piece<B>> {
        self.deeper()?;
        let sign = self.peek()?;
        if matches!(sign, Peek::Plus | Peek::Minus) {
            self.take();
        }
        let negative = sign == Peek::Minus;
        if negative {
            self.echo.push(b'-');
        }
        let (mut total, mut tie) = self.term()?;
        if negative {
            total = self.build.negative(total)?;
            tie = Tie::Sum;
        }
        loop {
            let minus = match self.peek()? {
                Peek::Plus => false,
                Peek::Minus => true,
                _ => break,
            };
            self.take();
            self.echo
                .extend_from_slice(if minus { b" - " } else { b" + " });
            let (mut term, _) = self.term()?;
            if minus {
                term = self.build.negative(term)?;
            }
            total = self.build.sum(total, term)?;
            tie = Tie::Sum;
        }
        self.depth -= 1;
        Some((total, tie))
    }

    /// Groups tied by signs of multiplication and division, from left to right.
    pub(super) fn term(&mut self) -> Option<Piece<B>> {
        let (mut total, mut tie) = self.group(None)?;
        // A whole number that ends right here could be half of what follows: `1/2mv²`.
        let mut number_end = (tie == Tie::Whole).then_some(self.end);
        loop {
            match self.peek()? {
                Peek::Times => {
                    self.take();
                    self.echo.push(b'*');
                    let (factor, _) = self.group(None)?;
                    total = self.build.product(total, factor)?;
                }
                Peek::Slash => {
                    let number = number_end == Some(self.at);
                    // `2.4/s` on its own is a quantity.
                    let rest = &self.text[self.at + 1..];
                    let unit = rest.trim_ascii_start().first();
                    if matches!(self.names, Table::Collect(_))
                        && self.before
                        && unit.is_some_and(|b| b.is_ascii_alphabetic() || *b == b'(')
                        && !no_unit(rest, 0)
                    {
                        return None;
                    }
                    self.take();
                    self.echo.push(b'/');
                    total = self.below(total, number)?;
                }
                _ => return Some((total, tie)),
            }
            tie = Tie::Product;
            number_end = None;
        }
    }

    /// Divides by what stands below a slash: all that follows without a sign, or its first factor alone.
    fn below(&mut self, above: B::Value, number: bool) -> Option<B::Value> {
        let from = self.echo.len();
        self.blanks();
        let close = number && self.at == self.end;
        let (first, tie) = self.factor()?;
        if !self.goes_on()? {
            if tie == Tie::Product {
                self.wrap(from);
            }
            return self.build.quotient(above, first);
        }
        let half = close && tie == Tie::Whole;
        let enclosed = tie == Tie::Bracket;
        self.seen.choices += u32::from(!enclosed);
        if half || enclosed || self.spaced() {
            if tie == Tie::Product {
                self.wrap(from);
            }
            let total = self.build.quotient(above, first)?;
            self.echo.push(b'*');
            let (rest, _) = self.group(None)?;
            return self.build.product(total, rest);
        }
        let (divisor, _) = self.group_until(Some((first, tie)), true)?;
        self.wrap(from);
        let total = self.build.quotient(above, divisor)?;
        if !self.goes_on()? {
            return Some(total);
        }
        self.echo.push(b'*');
        let (rest, _) = self.group(None)?;
        self.build.product(total, rest)
    }

    /// Whether a space that people see stands before what comes next.
    fn spaced(&self) -> bool {
        self.at > self.end && shows_space(self.text, self.end, self.at)
    }

    pub(super) fn wrap(&mut self, from: usize) {
        self.echo.insert(from, b'(');
        self.echo.push(b')');
    }

    /// Whether another factor follows without a sign.
    #[inline]
    pub(super) fn goes_on(&mut self) -> Option<bool> {
        Some(match self.peek()? {
            // `2 3` is a fault, and `x 3` is rare.
            Peek::Digit => return None,
            Peek::Factor => true,
            _ => false,
        })
    }

    /// Factors side by side.
    #[inline]
    pub(super) fn group(&mut self, first: Option<Piece<B>>) -> Option<Piece<B>> {
        self.group_until(first, false)
    }

    /// Factors side by side, in a `tight` one up to the first space.
    #[inline]
    fn group_until(&mut self, first: Option<Piece<B>>, tight: bool) -> Option<Piece<B>> {
        let (mut total, mut tie) = match first {
            Some(first) => first,
            None => self.factor()?,
        };
        let mut last = tie;
        while self.goes_on()? && !(tight && self.spaced()) {
            self.echo.push(b'*');
            // `2\frac12` could be a mixed number.
            if tie == Tie::Whole
                && self.starts("\\")
                && self.text[self.at..]
                    .get(1..6)
                    .is_some_and(|w| w.windows(4).any(|w| w == b"frac"))
            {
                return None;
            }
            if last == Tie::Atom && self.at == self.end && self.is_argument() {
                return None;
            }
            let (factor, next) = self.factor()?;
            total = self.build.product(total, factor)?;
            (tie, last) = (Tie::Product, next);
        }
        Some((total, tie))
    }

    /// Whether a bracket right behind a name could hold a time or an index: `v(t)`, `a[2]`.
    fn is_argument(&self) -> bool {
        match self.byte(0) {
            b'[' => true,
            b'(' if matches!(self.names, Table::Collect(_)) => {
                let inside = self.text[self.at + 1..].trim_ascii_start();
                inside.starts_with(b"t")
            }
            _ => false,
        }
    }
}
