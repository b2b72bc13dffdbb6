//! Building expressions: sums, products, powers, functions and operators, each tidied only as far as no meaning can change.

use std::ops::{Add, Div, Mul, Neg, Sub};

use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use super::{Expr, Function, Node, Rational, Symbol, number, ratio};

impl Expr {
    /// Sum of the terms; nested sums are opened, numbers added up at the place of the first, zeros dropped.
    pub fn sum(terms: impl IntoIterator<Item = Expr>) -> Expr {
        Expr::sum_of(terms.into_iter().collect())
    }

    // Apart from `sum`, so that it is compiled once and not for each kind of iterator.
    fn sum_of(mut out: Vec<Expr>) -> Expr {
        let nested = |term: &Expr| matches!(term.node(), Node::Sum(_));
        if out.iter().any(nested) {
            out = opened(out, nested);
        }
        let mut number: Option<(usize, Rational)> = None;
        let mut kept = 0;
        out.retain(|term| {
            let Some(value) = term.as_number() else {
                kept += 1;
                return true;
            };
            match &mut number {
                Some((_, total)) => *total = number::sum(total, value, false),
                None => number = Some((kept, value.clone())),
            }
            false
        });
        if let Some((at, total)) = number
            && !total.is_zero()
        {
            out.insert(at, Expr::from(total));
        }
        match out.len() {
            0 => Expr::zero(),
            1 => out.remove(0),
            _ => Expr::new(Node::Sum(out)),
        }
    }

    /// Product of the factors; nested products are opened, numbers gathered in front, ones dropped.
    /// A factor 0 makes the product 0 only where every other factor has a value everywhere.
    pub fn product(factors: impl IntoIterator<Item = Expr>) -> Expr {
        Expr::product_of(factors.into_iter().collect())
    }

    fn product_of(mut out: Vec<Expr>) -> Expr {
        let nested = |factor: &Expr| matches!(factor.node(), Node::Product(_));
        if out.iter().any(nested) {
            out = opened(out, nested);
        }
        let mut number = Rational::one();
        out.retain(|factor| {
            match factor.as_number() {
                // Most products hold one number.
                Some(value) if number.is_one() => number = value.clone(),
                Some(value) => number = number::product(&number, value),
                None => return true,
            }
            false
        });
        if number.is_zero() && out.iter().all(Expr::is_total) {
            return Expr::zero();
        }
        if !number.is_one() || out.is_empty() {
            out.insert(0, Expr::from(number));
        }
        match out.len() {
            1 => out.remove(0),
            _ => Expr::new(Node::Product(out)),
        }
    }

    /// `self` raised to `exponent`. Small integer powers of numbers are carried out; x¹ is x, and x⁰ is 1 where x has
    /// a nonzero value for sure (a symbol counts: its zero is a point, and the scene's domains exclude or list it).
    pub fn power(&self, exponent: Expr) -> Expr {
        if let Some(power) = exponent.as_number() {
            if power.is_one() {
                return self.clone();
            }
            if power.is_zero()
                && (self.as_symbol().is_some() || self.as_number().is_some_and(|b| !b.is_zero()))
            {
                return Expr::one();
            }
            if let (Some(base), true, Some(k)) =
                (self.as_number(), power.is_integer(), power.numer().as_i64())
            {
                // 64 bits per unit of exponent at most: a number a person could have written.
                if k.unsigned_abs() <= 64 && !(base.is_zero() && k <= 0) {
                    let k32 = k.unsigned_abs() as u32;
                    // Powers of numbers without a common factor have none.
                    let raised = Rational::new_raw(base.numer().pow(k32), base.denom().pow(k32));
                    return Expr::from(if k < 0 { raised.recip() } else { raised });
                }
            }
            if let (Node::Power(inner, by), true) = (self.node(), power.is_integer()) {
                // (x^a)^n = x^(a n) for every integer n, unless the even root that forbids a negative x is lost.
                if let Some(a) = by.as_number() {
                    let total = number::product(a, power);
                    let lost = a.denom().is_even()
                        && total.denom().is_odd()
                        && inner.as_number().is_none_or(Signed::is_negative);
                    if !total.is_zero() && !lost {
                        return inner.power(Expr::from(total));
                    }
                }
            }
        }
        Expr::new(Node::Power(self.clone(), exponent))
    }

    /// A power as somebody wrote it: 1/(1/x) keeps its hole at 0.
    pub(crate) fn written_power(&self, exponent: Expr) -> Expr {
        let below = |k: &Expr| k.as_number().is_some_and(Signed::is_negative);
        match self.node() {
            Node::Power(base, k) if below(k) && below(&exponent) && base.as_number().is_none() => {
                Expr::new(Node::Power(self.clone(), exponent))
            }
            _ => self.power(exponent),
        }
    }

    /// Integer power.
    pub fn powi(&self, exponent: i64) -> Expr {
        self.power(Expr::from(exponent))
    }

    /// The non-negative square root; carried out for squares of fractions.
    pub fn sqrt(&self) -> Expr {
        match self.as_number().and_then(number::sqrt_exact) {
            Some(root) => Expr::from(root),
            None => self.power(Expr::ratio(1, 2)),
        }
    }

    /// The function of the expression; of the angle 0 its value.
    pub fn call(function: Function, argument: Expr) -> Expr {
        match function {
            Function::Sin | Function::Tan if argument.is_zero() => Expr::zero(),
            Function::Cos if argument.is_zero() => Expr::one(),
            _ => Expr::new(Node::Call(function, argument)),
        }
    }

    /// Sine; sin 0 is 0.
    pub fn sin(&self) -> Expr {
        Expr::call(Function::Sin, self.clone())
    }

    /// Cosine; cos 0 is 1.
    pub fn cos(&self) -> Expr {
        Expr::call(Function::Cos, self.clone())
    }

    /// Tangent; tan 0 is 0.
    pub fn tan(&self) -> Expr {
        Expr::call(Function::Tan, self.clone())
    }

    /// Arc tangent, between −π/2 and π/2.
    pub fn atan(&self) -> Expr {
        Expr::call(Function::Atan, self.clone())
    }

    /// Whether the expression has a value at every real point of its symbols: no quotient, root, logarithm and the like.
    fn is_total(&self) -> bool {
        use Function::{Acos, Asin, Ln, Tan};
        let whole = |k: &Rational| k.is_integer() && k.is_positive();
        self.parts().all(|e| match e.node() {
            Node::Power(_, exponent) => exponent.as_number().is_some_and(whole),
            Node::Call(f, _) => !matches!(f, Tan | Asin | Acos | Ln),
            _ => true,
        })
    }
}

/// The parts of parts that are of one kind with the whole in their place.
fn opened(parts: Vec<Expr>, nested: impl Fn(&Expr) -> bool) -> Vec<Expr> {
    let mut out = Vec::with_capacity(2 * parts.len());
    for part in parts {
        match part.node() {
            Node::Sum(inner) | Node::Product(inner) if nested(&part) => {
                out.extend_from_slice(inner);
            }
            _ => out.push(part),
        }
    }
    out
}

/// Whole numbers up to this size, either sign, are made once in each thread: most numbers of a formula are such.
const SMALL: i64 = 16;

thread_local! {
    static NUMBERS: [Expr; 2 * SMALL as usize + 1] =
        std::array::from_fn(|i| Expr::new(Node::Number(ratio(i as i64 - SMALL, 1))));
}

/// A small whole number.
fn small(value: &Rational) -> Option<Expr> {
    let at = value.numer().as_i64()?.checked_add(SMALL)?;
    let at = usize::try_from(at).ok()?;
    if !number::is_whole(value) {
        return None;
    }
    NUMBERS.try_with(|known| known.get(at).cloned()).ok()?
}

impl From<i32> for Expr {
    fn from(value: i32) -> Expr {
        Expr::from(i64::from(value))
    }
}

impl From<i64> for Expr {
    fn from(value: i64) -> Expr {
        Expr::from(ratio(value, 1))
    }
}

impl From<Symbol> for Expr {
    fn from(name: Symbol) -> Expr {
        Expr::new(Node::Symbol(name))
    }
}

impl From<Rational> for Expr {
    fn from(value: Rational) -> Expr {
        small(&value).unwrap_or_else(|| Expr::new(Node::Number(value)))
    }
}

impl Expr {
    /// Whether 0 + x is x to the letter: a number inside a sum would come to stand in front.
    fn holds_no_number(&self) -> bool {
        match self.node() {
            Node::Sum(terms) => terms.iter().all(|t| t.as_number().is_none()),
            _ => true,
        }
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, |$a:ident, $b:ident| $body:expr) => {
        impl<'a> $trait<&'a Expr> for &'a Expr {
            type Output = Expr;
            fn $method(self, other: &Expr) -> Expr {
                let ($a, $b) = (self, other);
                $body
            }
        }
        impl $trait<Expr> for Expr {
            type Output = Expr;
            fn $method(self, other: Expr) -> Expr {
                (&self).$method(&other)
            }
        }
        impl $trait<&Expr> for Expr {
            type Output = Expr;
            fn $method(self, other: &Expr) -> Expr {
                (&self).$method(other)
            }
        }
        impl $trait<Expr> for &Expr {
            type Output = Expr;
            fn $method(self, other: Expr) -> Expr {
                self.$method(&other)
            }
        }
    };
}
operator!(Add, add, |a, b| match (a.is_zero(), b.is_zero()) {
    (_, true) => a.clone(),
    (true, _) if b.holds_no_number() => b.clone(),
    _ => Expr::sum([a.clone(), b.clone()]),
});
operator!(Sub, sub, |a, b| match b.is_zero() {
    true => a.clone(),
    false => a + -b,
});
operator!(Mul, mul, |a, b| match (a.is_one(), b.is_one()) {
    (true, _) => b.clone(),
    (_, true) => a.clone(),
    _ => Expr::product([a.clone(), b.clone()]),
});
operator!(Div, div, |a, b| Expr::product([a.clone(), b.powi(-1)]));

impl Neg for &Expr {
    type Output = Expr;
    fn neg(self) -> Expr {
        match self.node() {
            Node::Number(value) => Expr::from(-value),
            Node::Sum(terms) => Expr::sum(terms.iter().map(|t| -t)),
            _ => Expr::product([Expr::from(-1), self.clone()]),
        }
    }
}

impl Neg for Expr {
    type Output = Expr;
    fn neg(self) -> Expr {
        -&self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_gather_and_neutral_elements_vanish() {
        let x = Expr::symbol("x");
        assert_eq!(Expr::from(2) * &x * Expr::ratio(1, 2), x);
        assert_eq!(&x + &Expr::zero(), x);
        assert_eq!(
            &x - &x + Expr::from(1) - Expr::from(1),
            Expr::sum([x.clone(), -&x])
        );
    }

    #[test]
    fn zero_times_a_quotient_is_not_folded() {
        let product = Expr::zero() * Expr::symbol("x").powi(-1);
        assert!(!product.is_zero(), "0·(1/x) has no value at x = 0");
    }

    #[test]
    fn an_even_root_of_a_square_keeps_its_root() {
        let x = Expr::symbol("x");
        assert_ne!(x.powi(2).sqrt(), x);
    }

    #[test]
    fn the_square_of_an_even_root_keeps_its_gap() {
        let x = Expr::symbol("x");
        assert_ne!(x.sqrt().powi(2), x);
        assert_eq!(x.sqrt().powi(3), x.power(Expr::ratio(3, 2)));
        assert_eq!(x.power(Expr::ratio(1, 3)).powi(3), x);
        assert_eq!(Expr::from(2).sqrt().powi(2), Expr::from(2));
    }
}
