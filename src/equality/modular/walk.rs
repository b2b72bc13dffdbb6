//! An expression, piece by piece, for whoever builds values of it.

use super::Place;
use crate::expr::angle::angle;
use crate::expr::{Expr, Function, Node, Rational, Symbol, ratio};

/// Largest exponent.
const HIGHEST: i64 = 1 << 20;
/// Most nodes.
const MOST: usize = 20_000;

/// What an expression is read into. Each step may decline by `None`.
pub(super) trait Builder {
    /// A value.
    type Value;
    /// A fraction in lowest terms.
    fn number(&mut self, above: i64, below: i64) -> Option<Self::Value>;
    /// The symbol at a place of the alphabet.
    fn symbol(&mut self, index: usize) -> Option<Self::Value>;
    /// The circle constant.
    fn pi(&mut self) -> Option<Self::Value>;
    /// a + b.
    fn sum(&mut self, a: Self::Value, b: Self::Value) -> Option<Self::Value>;
    /// a·b.
    fn product(&mut self, a: Self::Value, b: Self::Value) -> Option<Self::Value>;
    /// a to the power of `halves`/2, which is not 0.
    fn power(&mut self, a: Self::Value, halves: i32) -> Option<Self::Value>;
    /// Sine, cosine or tangent.
    fn turn(&mut self, function: Function, turn: &Turn) -> Option<Self::Value>;
}

/// An angle under a sine.
pub(super) struct Turn {
    /// Symbols with multiples of their parts; at least one.
    pub parts: Vec<(usize, i64)>,
    /// Quarter turns besides, from 0 to 3.
    pub quarters: i32,
    /// Whether it lies in the first quadrant for certain.
    pub acute: bool,
}

/// The value of an expression; `None` where it is not of the kind this is for.
pub(super) fn value<B: Builder>(e: &Expr, places: &[Place], build: &mut B) -> Option<B::Value> {
    let mut walk = Walk {
        places,
        build,
        left: MOST,
    };
    walk.value(e)
}

struct Walk<'a, B> {
    places: &'a [Place<'a>],
    build: &'a mut B,
    left: usize,
}

impl<B: Builder> Walk<'_, B> {
    fn value(&mut self, e: &Expr) -> Option<B::Value> {
        self.left = self.left.checked_sub(1)?;
        match e.node() {
            Node::Number(value) => {
                let (above, below) = (value.numer().as_i64()?, value.denom().as_i64()?);
                self.build.number(above, below)
            }
            Node::Symbol(name) if &**name == "pi" => self.build.pi(),
            Node::Symbol(name) => {
                let index = self.index(name)?;
                self.build.symbol(index)
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
                let halves = match exponent.as_number()? {
                    k if k.is_integer() => k.numer().as_i64()?.checked_mul(2)?,
                    k => k
                        .numer()
                        .as_i64()
                        .filter(|_| k.denom().as_i64() == Some(2))?,
                };
                if halves == 0 || halves.abs() > HIGHEST {
                    return None;
                }
                let base = self.value(base)?;
                self.build.power(base, i32::try_from(halves).ok()?)
            }
            Node::Call(f @ (Function::Sin | Function::Cos | Function::Tan), argument) => {
                let turn = self.turn(argument)?;
                self.build.turn(*f, &turn)
            }
            Node::Call(..) => None,
        }
    }

    fn index(&self, name: &Symbol) -> Option<usize> {
        let places = self.places;
        // Nearly always it is the same name, not only the same letters.
        let known = places.iter().position(|p| Symbol::ptr_eq(p.name, name));
        known.or_else(|| places.binary_search_by(|place| place.name.cmp(name)).ok())
    }

    /// A combination of angles and quarter turns.
    fn turn(&self, argument: &Expr) -> Option<Turn> {
        let read = angle(argument)?;
        let quarters = whole(&(&read.pi * ratio(2, 1)))?.rem_euclid(4);
        let mut turn = Turn {
            parts: Vec::with_capacity(read.symbols.len()),
            quarters: quarters as i32,
            acute: quarters == 0 && read.symbols.len() == 1,
        };
        for (name, share) in &read.symbols {
            let index = self.index(name)?;
            let place = &self.places[index];
            let divisor = i64::from(place.divisor);
            let (above, below) = (share.numer().as_i64()?, share.denom().as_i64()?);
            if divisor % below != 0 {
                return None;
            }
            turn.acute &= above > 0 && above <= below && place.acute;
            turn.parts
                .push((index, above.checked_mul(divisor / below)?));
        }
        (!turn.parts.is_empty()).then_some(turn)
    }
}

/// A fraction that is a whole number of a machine word.
fn whole(value: &Rational) -> Option<i64> {
    value.numer().as_i64().filter(|_| value.is_integer())
}
