//! Values with their exponents: numbers, names, brackets, fractions, roots, functions.

use super::reader::{Peek, Piece, Reader, Tie};
use super::word::Word;
use super::{Builder, Ratio};
use crate::expr::Function;

impl<B: Builder> Reader<'_, B> {
    /// A value with its exponent.
    #[inline]
    pub(super) fn factor(&mut self) -> Option<Piece<B>> {
        let from = self.echo.len();
        let (base, tie) = self.primary()?;
        let Some(halves) = self.exponent()? else {
            return Some((base, tie));
        };
        if tie >= Tie::Power {
            self.wrap(from);
        }
        self.echo_power(halves);
        Some((self.build.power(base, halves)?, Tie::Power))
    }

    #[inline]
    pub(super) fn primary(&mut self) -> Option<Piece<B>> {
        match self.peek()? {
            Peek::Digit => self.number(),
            Peek::Factor => match self.byte(0) {
                open @ (b'(' | b'[') => {
                    let value = self.bracket(if open == b'(' { b')' } else { b']' })?;
                    Some((value, Tie::Bracket))
                }
                _ => match self.word(false)? {
                    Word::Name(index) => Some((self.named(index)?, Tie::Atom)),
                    Word::Pi => {
                        self.echo.extend_from_slice(b"pi");
                        self.before = true;
                        Some((self.build.pi()?, Tie::Atom))
                    }
                    Word::Root { tex } => self.root(tex),
                    Word::Fraction => self.fraction(),
                    Word::Call(ratio) => self.call(ratio),
                },
            },
            _ => None,
        }
    }

    #[inline]
    fn named(&mut self, index: usize) -> Option<B::Value> {
        self.before = false;
        self.seen.names |= 1 << index;
        self.seen.bare |= 1 << index;
        let name = self.names.get().echo(index);
        self.build.symbol(index, name)
    }

    /// What stands in brackets; the opening one is here.
    fn bracket(&mut self, close: u8) -> Option<B::Value> {
        self.at += 1;
        self.before = false;
        self.echo.push(b'(');
        let (value, _) = self.sum()?;
        self.echo.push(b')');
        self.closed(close)?;
        Some(value)
    }

    pub(super) fn closed(&mut self, close: u8) -> Option<()> {
        if self.peek()? != Peek::Close(close) {
            return None;
        }
        self.take();
        self.before = true;
        Some(())
    }

    /// One argument of a LaTeX command: a group or a digit. It is echoed without brackets.
    fn argument(&mut self) -> Option<Piece<B>> {
        self.blanks();
        match self.byte(0) {
            b'{' => {
                self.at += 1;
                self.before = false;
                let piece = self.sum()?;
                self.closed(b'}')?;
                // `{v}_1` is one name.
                if matches!(self.byte(0), b'_' | b'\'') || self.starts("′") {
                    return None;
                }
                Some(piece)
            }
            digit @ b'0'..=b'9' => {
                self.at += 1;
                (self.before, self.end) = (true, self.at);
                self.echo.push(digit);
                let value = self.build.number(u64::from(digit - b'0'), 0)?;
                Some((value, Tie::Whole))
            }
            _ => None,
        }
    }

    fn fraction(&mut self) -> Option<Piece<B>> {
        self.deeper()?;
        let from = self.echo.len();
        let (above, tie) = self.argument()?;
        if tie == Tie::Sum {
            self.wrap(from);
        }
        self.echo.push(b'/');
        let from = self.echo.len();
        let (below, tie) = self.argument()?;
        if tie >= Tie::Product {
            self.wrap(from);
        }
        self.depth -= 1;
        Some((self.build.quotient(above, below)?, Tie::Product))
    }

    fn root(&mut self, tex: bool) -> Option<Piece<B>> {
        self.deeper()?;
        self.before = false;
        self.echo.extend_from_slice(b"sqrt");
        if self.byte(0) == b'[' {
            return None;
        }
        let from = self.echo.len();
        let (inner, tie) = if tex {
            self.argument()?
        } else {
            self.primary()?
        };
        if tie != Tie::Bracket || tex {
            self.wrap(from);
        }
        self.depth -= 1;
        if !tex && tie != Tie::Bracket && self.goes_on()? {
            self.seen.choices += 1;
        }
        Some((self.build.power(inner, 1)?, Tie::Atom))
    }

    /// A function: its own exponent, then its argument.
    fn call(&mut self, ratio: Ratio) -> Option<Piece<B>> {
        self.deeper()?;
        self.before = false;
        let exponent = self.exponent()?;
        if exponent.is_some_and(|k| k < 0) {
            return None;
        }
        let name: &[u8] = match (ratio.function, ratio.reciprocal) {
            (Function::Sin, false) => b"sin",
            (Function::Cos, false) => b"cos",
            (_, false) => b"tan",
            (Function::Sin, true) => b"csc",
            (Function::Cos, true) => b"sec",
            (_, true) => b"cot",
        };
        self.echo.extend_from_slice(name);
        self.echo.push(b'(');
        let angle = self.angle()?;
        self.echo.push(b')');
        self.depth -= 1;
        let mut spelled: [&[u8]; 4] = [b""; 4];
        for (name, (index, _)) in spelled.iter_mut().zip(angle.parts()) {
            *name = self.names.get().echo(index);
        }
        let mut value = self.build.turn(ratio, &angle, &spelled)?;
        for (index, _) in angle.parts() {
            self.seen.names |= 1 << index;
            self.seen.turned |= 1 << index;
        }
        match exponent {
            None => Some((value, Tie::Atom)),
            Some(halves) => {
                self.echo_power(halves);
                value = self.build.power(value, halves)?;
                Some((value, Tie::Power))
            }
        }
    }
}
