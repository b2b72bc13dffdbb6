//! Functions of two arguments, written with those the expressions have.

use super::fault::Faulty;
use super::parser::Parser;
use super::token::{Pair, Tok};
use super::value::whole_number;
use super::written::{Shape, Sign, Written};
use crate::expr::Function;

impl Parser<'_> {
    /// The arguments in brackets, and what the function makes of them. `atan2(y, x)` is twice the arctangent of
    /// y/(√(x² + y²) + x), and the greater of two numbers half of a + b + |a − b|.
    pub(super) fn pair(&mut self, function: Pair, start: usize) -> Faulty<Written> {
        let (one, other) = self.list_of_two(function.name())?;
        for argument in [&one, &other] {
            self.copies(argument)?;
        }
        let end = other.end;
        let number = |k| whole_number(k, start, end);
        let bracket = |w: &Written| w.clone().inside(Shape::Bracket);
        let length = |x: &Written, y: &Written| {
            let [x, y] = [x, y].map(|w| bracket(w).power(number(2)));
            x.plus(Sign::Plus, y).inside(|x| Shape::Root(None, x))
        };
        let found = match function {
            Pair::Root => one.inside(|x| Shape::Root(Some(Box::new(other)), x)),
            Pair::Length => length(&one, &other),
            Pair::Power => bracket(&one).power(bracket(&other)),
            Pair::Angle => {
                let below = length(&one, &other).plus(Sign::Plus, bracket(&other));
                let half = bracket(&one).over(below).call(Function::Atan);
                half.over(number(1).over(number(2)))
            }
            Pair::Greater | Pair::Smaller => {
                let sign = match function {
                    Pair::Greater => Sign::Plus,
                    _ => Sign::Minus,
                };
                let [a, b] = [one, other].map(|w| w.inside(Shape::Bracket));
                let apart = a.clone().plus(Sign::Minus, b.clone()).inside(Shape::Abs);
                let terms = vec![(Sign::Plus, a), (Sign::Plus, b), (sign, apart)];
                Written::new(Shape::Sum(terms), start, end).over(number(2))
            }
        };
        Ok(found.at(start, end))
    }

    /// Two arguments in round brackets, between which a comma is never a decimal one.
    fn list_of_two(&mut self, name: &str) -> Faulty<(Written, Written)> {
        let open = self.next()?;
        let needs = || {
            let message = format!("{name} takes two arguments, as in {name}(x, 3)");
            open.fault(message)
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
