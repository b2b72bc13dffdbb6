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
        self.copies(&called)?;
        match called.shape {
            Shape::Call(_, x) => Ok(inverse(function, reciprocal, *x, [start, called.end])),
            Shape::Power(base, exponent) => {
                let Shape::Call(_, x) = base.shape else {
                    return Err(Fault::new("this exponent is not read", start, end));
                };
                let inner = inverse(function, reciprocal, *x, [start, called.end]);
                Ok(inner.power(*exponent).at(start, called.end))
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
    let number = |k| whole_number(k, start, end);
    let cotangent = (function, reciprocal) == (Function::Tan, true);
    let x = match reciprocal && !cotangent {
        true => number(1).over(x),
        false => x,
    };
    let found = match function {
        Function::Sin => x.call(Function::Asin),
        Function::Cos => x.call(Function::Acos),
        Function::Tan if cotangent => {
            let pi = Written::new(Shape::Symbol("pi".into()), start, end);
            pi.over(number(2)).plus(Sign::Minus, x.call(Function::Atan))
        }
        Function::Tan => x.call(Function::Atan),
        Function::Tanh => {
            let x = x.inside(Shape::Bracket);
            let sum = |sign| number(1).plus(sign, x.clone());
            let log = sum(Sign::Plus).over(sum(Sign::Minus)).call(Function::Ln);
            log.over(number(2))
        }
        _ => {
            let sign = match function {
                Function::Sinh => Sign::Plus,
                _ => Sign::Minus,
            };
            let x = x.inside(Shape::Bracket);
            let under = x.clone().power(number(2)).plus(sign, number(1));
            let root = under.inside(|x| Shape::Root(None, x));
            x.plus(Sign::Plus, root).call(Function::Ln)
        }
    };
    found.at(start, end)
}
