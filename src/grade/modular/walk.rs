//! An expression put into a builder piece by piece, as the reader in one pass does with a text.

use super::Uses;
use crate::expr::angle::angle;
use crate::expr::{Expr, Function, Node, Rational, Symbol};
use crate::formula::stream::{Angle, Builder, Ratio};

/// Largest number taken, so that it stays below every prime used.
const LARGEST: u64 = 1_000_000_000_000_000_000;
/// Largest exponent.
const HIGHEST: i64 = 1 << 20;
/// Most nodes.
const MOST: usize = 20_000;

/// The value of an expression. Names that are not in the list are entered behind it.
pub(super) fn value<B: Builder>(
    e: &Expr,
    list: &mut Vec<Symbol>,
    uses: &mut Uses,
    build: &mut B,
) -> Option<B::Value> {
    let mut walk = Walk {
        list,
        uses,
        build,
        left: MOST,
    };
    walk.value(e)
}

struct Walk<'a, B: Builder> {
    list: &'a mut Vec<Symbol>,
    uses: &'a mut Uses,
    build: &'a mut B,
    left: usize,
}

impl<B: Builder> Walk<'_, B> {
    fn index(&mut self, name: &Symbol) -> Option<usize> {
        let index = match self.list.iter().position(|n| n == name) {
            Some(index) => index,
            None => {
                self.list.push(name.clone());
                self.list.len() - 1
            }
        };
        (index < 64).then_some(index)
    }

    fn value(&mut self, e: &Expr) -> Option<B::Value> {
        self.left = self.left.checked_sub(1)?;
        match e.node() {
            Node::Number(value) => self.number(value),
            Node::Symbol(name) if &**name == "pi" => self.build.pi(),
            Node::Symbol(name) => {
                let index = self.index(name)?;
                self.uses.bare |= 1 << index;
                self.build.symbol(index, name.as_bytes())
            }
            Node::Sum(terms) => {
                let mut total = self.value(&terms[0])?;
                for term in &terms[1..] {
                    let term = self.value(term)?;
                    total = self.build.sum(total, term)?;
                }
                Some(total)
            }
            Node::Product(factors) => {
                let mut total = self.value(&factors[0])?;
                for factor in &factors[1..] {
                    let factor = self.value(factor)?;
                    total = self.build.product(total, factor)?;
                }
                Some(total)
            }
            Node::Power(base, exponent) => {
                let twice = exponent.as_number()? * Rational::from(crate::expr::Int::from(2));
                let halves = twice.numer().as_i64().filter(|_| twice.is_integer())?;
                if halves == 0 || halves.abs() > HIGHEST {
                    return None;
                }
                let base = self.value(base)?;
                self.build.power(base, i32::try_from(halves).ok()?)
            }
            Node::Call(f @ (Function::Sin | Function::Cos | Function::Tan), argument) => {
                let read = angle(argument)?;
                let quarters = &read.pi * Rational::from(crate::expr::Int::from(2));
                let quarters = quarters
                    .numer()
                    .as_i64()
                    .filter(|_| quarters.is_integer())?;
                let mut parts = Vec::new();
                for (name, share) in &read.symbols {
                    let index = self.index(name)?;
                    self.uses.turned |= 1 << index;
                    parts.push((index, share.numer().as_i64()?, share.denom().as_i64()?));
                }
                let angle = Angle::new(parts, quarters)?;
                let names: Vec<&[u8]> = read.symbols.keys().map(|n| n.as_bytes()).collect();
                let ratio = Ratio {
                    function: *f,
                    reciprocal: false,
                };
                self.build.turn(ratio, &angle, &names)
            }
            Node::Call(..) => None,
        }
    }

    fn number(&mut self, value: &Rational) -> Option<B::Value> {
        let small = |n: i64| Some(n.unsigned_abs()).filter(|n| *n <= LARGEST);
        let above = value.numer().as_i64()?;
        let mut out = self.build.number(small(above)?, 0)?;
        if above < 0 {
            out = self.build.negative(out)?;
        }
        match small(value.denom().as_i64()?)? {
            1 => Some(out),
            below => {
                let below = self.build.number(below, 0)?;
                self.build.quotient(out, below)
            }
        }
    }
}
