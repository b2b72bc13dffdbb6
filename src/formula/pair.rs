//! Functions of two arguments, written with those the expressions have.

use super::fault::{Fault, Faulty};
use super::lexer::Tok;
use super::parser::Parser;
use super::value::whole_number;
use super::written::{Shape, Sign, Written};
use crate::expr::Function;

/// A function of two arguments.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Pair {
    /// `root(x, n)`, the root of index n.
    Root,
    /// `atan2(y, x)`, the angle from the x axis to a vector.
    Angle,
    /// `hypot(x, y)`, the length of a vector.
    Length,
    /// `max(a, b)`
    Greater,
    /// `min(a, b)`
    Smaller,
}

impl Pair {
    /// The function with this name.
    pub(super) fn named(word: &str) -> Option<Pair> {
        Some(match word.to_ascii_lowercase().as_str() {
            "root" | "nthroot" => Pair::Root,
            "atan2" | "arctan2" => Pair::Angle,
            "hypot" => Pair::Length,
            "max" => Pair::Greater,
            "min" => Pair::Smaller,
            _ => return None,
        })
    }

    fn name(self) -> &'static str {
        match self {
            Pair::Root => "root",
            Pair::Angle => "atan2",
            Pair::Length => "hypot",
            Pair::Greater => "max",
            Pair::Smaller => "min",
        }
    }
}

impl Parser<'_> {
    /// The arguments in brackets, and what the function makes of them. `atan2(y, x)` is twice the arctangent of
    /// y/(√(x² + y²) + x), and the greater of two numbers half of a + b + |a − b|.
    pub(super) fn pair(&mut self, function: Pair, start: usize) -> Faulty<Written> {
        let (one, other) = self.list_of_two(function.name())?;
        let end = other.end;
        let at = |shape| Written::new(shape, start, end);
        let number = |k| Box::new(whole_number(k, start, end));
        let inner = |w: &Written| at(Shape::Bracket(Box::new(w.clone())));
        let sum = |terms: Vec<(Sign, Written)>| at(Shape::Sum(terms));
        let square = |w: &Written| (Sign::Plus, at(Shape::Power(Box::new(inner(w)), number(2))));
        let length = |x: &Written, y: &Written| {
            let under = Box::new(sum(vec![square(x), square(y)]));
            at(Shape::Root(None, under))
        };
        let quotient = |above, below| at(Shape::Fraction(Box::new(above), Box::new(below)));
        let sign = match function {
            Pair::Root => {
                let (inside, index) = (Box::new(one), Box::new(other));
                return Ok(at(Shape::Root(Some(index), inside)));
            }
            Pair::Length => return Ok(length(&one, &other)),
            Pair::Angle => {
                let below = sum(vec![
                    (Sign::Plus, length(&one, &other)),
                    (Sign::Plus, inner(&other)),
                ]);
                let arc = Shape::Call(Function::Atan, Box::new(quotient(inner(&one), below)));
                return Ok(quotient(at(arc), at(Shape::Fraction(number(1), number(2)))));
            }
            Pair::Greater => Sign::Plus,
            Pair::Smaller => Sign::Minus,
        };
        let (a, b) = ((Sign::Plus, inner(&one)), inner(&other));
        let apart = sum(vec![a.clone(), (Sign::Minus, b.clone())]);
        let apart = at(Shape::Abs(Box::new(apart)));
        let above = sum(vec![a, (Sign::Plus, b), (sign, apart)]);
        Ok(quotient(above, *number(2)))
    }

    /// Two arguments in round brackets, between which a comma is never a decimal one.
    fn list_of_two(&mut self, name: &str) -> Faulty<(Written, Written)> {
        let open = self.next()?;
        let needs = || {
            let message = format!("{name} takes two arguments, as in {name}(x, 3)");
            Fault::new(message, open.start, open.end)
        };
        if open.tok != Tok::Open('(') {
            return Err(needs());
        }
        let bars = std::mem::replace(&mut self.bars, 0);
        let list = std::mem::replace(&mut self.lexer.list, true);
        let one = self.sum()?;
        let comma = self.next()?.tok == Tok::Comma;
        if !comma {
            return Err(needs());
        }
        let other = self.sum()?;
        self.lexer.list = list;
        self.bars = bars;
        match self.next()?.tok {
            Tok::Close(')') => Ok((one, other)),
            _ => Err(needs()),
        }
    }
}
