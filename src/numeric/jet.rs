//! A number with its first two derivatives along one variable, by the rules of differentiation (Griewank & Walther,
//! Evaluating Derivatives, chapter 13): places that a file gives by a coordinate are differentiated as they are evaluated.

use crate::expr::{Function, Rational, Scalar};

/// Value, first and second derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Jet(pub [f64; 3]);

impl Jet {
    /// A number that does not change.
    pub fn constant(value: f64) -> Jet {
        Jet([value, 0.0, 0.0])
    }

    /// A function of it, by the function's value and derivatives there.
    fn through(&self, [f, first, second]: [f64; 3]) -> Option<Jet> {
        let Jet([_, u, w]) = self;
        let all = [f, first * u, second * u * u + first * w];
        all.iter().all(|v| v.is_finite()).then_some(Jet(all))
    }

    /// u^p, of which the derivatives vanish for the exponents 0 and 1 wherever u is.
    fn power(&self, p: f64) -> Option<Jet> {
        let u = self.0[0];
        self.through([
            u.powf(p),
            p * u.powf(p - 1.0),
            p * (p - 1.0) * u.powf(p - 2.0),
        ])
    }
}

impl Scalar for Jet {
    fn from_rational(value: &Rational) -> Jet {
        Jet::constant(f64::from_rational(value))
    }
    fn pi() -> Option<Jet> {
        f64::pi().map(Jet::constant)
    }
    fn plus(&self, other: &Jet) -> Jet {
        Jet([0, 1, 2].map(|k| self.0[k] + other.0[k]))
    }
    fn times(&self, other: &Jet) -> Jet {
        let (Jet([a, b, c]), Jet([u, v, w])) = (self, other);
        Jet([a * u, a * v + b * u, a * w + 2.0 * b * v + c * u])
    }
    fn recip(&self) -> Option<Jet> {
        self.power(-1.0)
    }
    fn sqrt(&self) -> Option<Jet> {
        match *self == Jet::constant(0.0) {
            true => Some(*self),
            false => self.power(0.5),
        }
    }
    fn pow(&self, exponent: &Jet) -> Option<Jet> {
        // u^v = e^(v ln u)
        exponent
            .times(&self.call(Function::Ln)?)
            .call(Function::Exp)
    }
    fn below_zero(&self) -> bool {
        self.0[0] < 0.0
    }
    fn call(&self, function: Function) -> Option<Jet> {
        let u = self.0[0];
        let f = u.call(function)?;
        let [first, second] = match function {
            Function::Sin => [u.cos(), -f],
            Function::Cos => [-u.sin(), -f],
            Function::Tan => [1.0 + f * f, 2.0 * f * (1.0 + f * f)],
            Function::Asin => arc(u, 1.0),
            Function::Acos => arc(u, -1.0),
            Function::Atan => {
                let first = 1.0 / (1.0 + u * u);
                [first, -2.0 * u * first * first]
            }
            Function::Sinh => [u.cosh(), f],
            Function::Cosh => [u.sinh(), f],
            Function::Tanh => [1.0 - f * f, -2.0 * f * (1.0 - f * f)],
            Function::Exp => [f, f],
            Function::Ln => [1.0 / u, -1.0 / (u * u)],
            Function::Abs => [u.signum(), 0.0],
        };
        self.through([f, first, second])
    }
}

/// Derivatives of the arc of a sine, or of a cosine with the factor −1.
fn arc(u: f64, factor: f64) -> [f64; 2] {
    let first = factor / (1.0 - u * u).sqrt();
    [first, u * first / (1.0 - u * u)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expr::{Expr, Point};

    #[test]
    fn derivatives_agree_with_differences() {
        let x = Expr::symbol("x");
        let inner = &(&x * &x) + &Expr::ratio(1, 5);
        let mut all: Vec<Expr> = Function::ALL
            .iter()
            .map(|f| Expr::call(*f, inner.clone()))
            .collect();
        all.extend([
            inner.sqrt(),
            inner.powi(-1),
            inner.powi(3),
            inner.power(x.clone()),
        ]);
        all.push(&x.sin() * &inner.sqrt());
        for e in all {
            let at = |x: f64| {
                let mut point = Point::default();
                point.values.insert("x".into(), x);
                e.evaluate::<f64>(&point).unwrap()
            };
            let mut point = Point::default();
            point.values.insert("x".into(), Jet([0.4, 1.0, 0.0]));
            let Jet([f, first, second]) = e.evaluate(&point).unwrap();
            let h = 1e-4;
            let differences = [
                (at(0.4 + h) - at(0.4 - h)) / (2.0 * h),
                (at(0.4 + h) - 2.0 * f + at(0.4 - h)) / (h * h),
            ];
            assert!((first - differences[0]).abs() < 1e-6, "{e:?}");
            assert!((second - differences[1]).abs() < 1e-5, "{e:?}");
        }
    }
}
