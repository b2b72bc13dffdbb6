//! Derivatives.

use super::{Expr, Function, Node};

impl Expr {
    /// Derivative with respect to a symbol, untidied. The derivative of |x| is |x|/x, undefined at 0 as it should be.
    pub fn derivative(&self, by: &str) -> Expr {
        match self.node() {
            Node::Number(_) => Expr::zero(),
            Node::Symbol(name) => {
                if &**name == by {
                    Expr::one()
                } else {
                    Expr::zero()
                }
            }
            Node::Sum(terms) => Expr::sum(terms.iter().map(|t| t.derivative(by))),
            Node::Product(factors) => Expr::sum(factors.iter().enumerate().filter_map(|(i, f)| {
                let slope = f.derivative(by);
                let (before, after) = factors.split_at(i);
                let all = before.iter().chain([&slope]).chain(&after[1..]);
                (!slope.is_zero()).then(|| Expr::product(all.cloned()))
            })),
            Node::Power(base, exponent) => {
                let (slope, inner) = (base.derivative(by), exponent.derivative(by));
                let outer = match slope.is_zero() {
                    true => slope,
                    false => exponent * &base.power(exponent - &Expr::one()) * slope,
                };
                if inner.is_zero() {
                    outer
                } else {
                    outer + self * &Expr::call(Function::Ln, base.clone()) * inner
                }
            }
            Node::Call(function, x) => {
                let one = Expr::one;
                let slope = x.derivative(by);
                if slope.is_zero() {
                    return slope;
                }
                let outer = match function {
                    Function::Sin => x.cos(),
                    Function::Cos => -x.sin(),
                    Function::Tan => one() + x.tan().powi(2),
                    Function::Asin => (one() - x.powi(2)).power(Expr::ratio(-1, 2)),
                    Function::Acos => -(one() - x.powi(2)).power(Expr::ratio(-1, 2)),
                    Function::Atan => (one() + x.powi(2)).powi(-1),
                    Function::Sinh => Expr::call(Function::Cosh, x.clone()),
                    Function::Cosh => Expr::call(Function::Sinh, x.clone()),
                    Function::Tanh => one() - self.powi(2),
                    Function::Exp => self.clone(),
                    Function::Ln => x.powi(-1),
                    Function::Abs => self / x,
                };
                outer * slope
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivative_of_a_product_of_functions() {
        let (x, a) = (Expr::symbol("x"), Expr::symbol("a"));
        let d = (x.sin() * &a).derivative("x");
        assert_eq!(d, x.cos() * &a);
    }
}
