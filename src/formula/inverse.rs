//! Inverse functions that are written with those the expressions have.

use super::fault::{Fault, Faulty};
use super::parser::Parser;
use super::value::whole_number;
use super::written::{Shape, Sign, Written};
use crate::expr::Function;

impl Parser<'_> {
    /// The inverse of a hyperbolic function, `arsinh x`, or of the reciprocal of a sine, cosine or tangent, `arccot x`.
    pub(super) fn area(&mut self, function: Function, start: usize, end: usize) -> Faulty<Written> {
        let reciprocal = matches!(function, Function::Sin | Function::Cos | Function::Tan);
        let called = self.call(function, false, start, end)?;
        match called.shape {
            Shape::Call(_, x) => Ok(inverse(function, reciprocal, *x, [start, called.end])),
            Shape::Power(base, exponent) => {
                let Shape::Call(_, x) = base.shape else {
                    return Err(Fault::new("this exponent is not read", start, end));
                };
                let inner = inverse(function, reciprocal, *x, [start, called.end]);
                let shape = Shape::Power(Box::new(inner), exponent);
                Ok(Written::new(shape, start, called.end))
            }
            _ => Err(Fault::new("an argument is missing", start, end)),
        }
    }
}

/// The inverse of a function, or of its `reciprocal`: `sec⁻¹ x` is the arccosine of 1/x, and `cot⁻¹ x` lies between 0 and π
/// (ISO 80000-2). `arsinh x` is ln(x + √(x² + 1)), `arcosh x` is ln(x + √(x² − 1)), `artanh x` half of ln((1 + x)/(1 − x)).
pub(super) fn inverse(
    function: Function,
    reciprocal: bool,
    x: Written,
    [start, end]: [usize; 2],
) -> Written {
    let at = |shape| Written::new(shape, start, end);
    let number = |k| whole_number(k, start, end);
    if (function, reciprocal) == (Function::Tan, true) {
        let pi = Box::new(at(Shape::Symbol("pi".into())));
        let quarter = at(Shape::Fraction(pi, Box::new(number(2))));
        let arc = at(Shape::Call(Function::Atan, Box::new(x)));
        return at(Shape::Sum(vec![(Sign::Plus, quarter), (Sign::Minus, arc)]));
    }
    let x = match reciprocal {
        true => at(Shape::Fraction(Box::new(number(1)), Box::new(x))),
        false => x,
    };
    let arc = match function {
        Function::Sin => Some(Function::Asin),
        Function::Cos => Some(Function::Acos),
        Function::Tan => Some(Function::Atan),
        _ => None,
    };
    if let Some(arc) = arc {
        return at(Shape::Call(arc, Box::new(x)));
    }
    let log = |w: Written| at(Shape::Call(Function::Ln, Box::new(w)));
    let x = at(Shape::Bracket(Box::new(x)));
    if function == Function::Tanh {
        let sum = |sign| {
            let terms = vec![(Sign::Plus, number(1)), (sign, x.clone())];
            Box::new(at(Shape::Sum(terms)))
        };
        let quotient = at(Shape::Fraction(sum(Sign::Plus), sum(Sign::Minus)));
        return at(Shape::Fraction(
            Box::new(log(quotient)),
            Box::new(number(2)),
        ));
    }
    let sign = match function {
        Function::Sinh => Sign::Plus,
        _ => Sign::Minus,
    };
    let square = at(Shape::Power(Box::new(x.clone()), Box::new(number(2))));
    let under = at(Shape::Sum(vec![(Sign::Plus, square), (sign, number(1))]));
    let root = at(Shape::Root(None, Box::new(under)));
    log(at(Shape::Sum(vec![(Sign::Plus, x), (Sign::Plus, root)])))
}
