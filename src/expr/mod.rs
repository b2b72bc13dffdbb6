//! The expression: exact numbers, symbols, sums, products, powers and functions; build, walk, substitute, evaluate.
//!
//! An [`Expr`] is a value: cloning copies a pointer, nothing is interned, and no two expressions share state. The
//! constructors tidy only what cannot change a meaning (nested sums, 0 + x, 1·x, arithmetic of numbers). Deciding whether
//! two expressions are equal is the work of [`crate::algebra`]; how somebody wrote one is kept in [`crate::formula`].

pub mod angle;
pub mod eval;
pub mod number;

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::hash::{BuildHasher, Hash, Hasher};
use std::ops::{Add, Div, Mul, Neg, Sub};
use std::sync::Arc;

use num_integer::Integer;
use num_traits::{One, Signed, Zero};
use rustc_hash::FxBuildHasher;

pub use eval::{Point, Scalar};
pub use number::{Int, Rational, ratio};

/// The name of a symbol as the scene writes it, such as `m1`, `theta` or `v_G`.
pub type Symbol = Arc<str>;

/// An immutable mathematical expression; cheap to clone and to look up.
#[derive(Clone)]
pub struct Expr(Arc<Tree>);

/// A node with the hash of all below it, so that looking up a formula does not walk through it.
struct Tree {
    hash: u64,
    node: Node,
}

/// The six kinds of expression.
#[derive(Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Node {
    /// An exact number.
    Number(Rational),
    /// A parameter, an unknown or the constant `pi`.
    Symbol(Symbol),
    /// A sum of at least two terms.
    Sum(Vec<Expr>),
    /// A product of at least two factors; a numeric coefficient stands first.
    Product(Vec<Expr>),
    /// A base raised to an exponent; quotients and roots are powers.
    Power(Expr, Expr),
    /// A function of one argument.
    Call(Function, Expr),
}

/// The functions of one argument that formulas in mechanics use. Square roots are powers, not functions.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
#[allow(missing_docs)]
pub enum Function {
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Exp,
    Ln,
    Abs,
}

impl Function {
    /// Every function, in the order of declaration.
    pub const ALL: [Function; 12] = [
        Function::Sin,
        Function::Cos,
        Function::Tan,
        Function::Asin,
        Function::Acos,
        Function::Atan,
        Function::Sinh,
        Function::Cosh,
        Function::Tanh,
        Function::Exp,
        Function::Ln,
        Function::Abs,
    ];

    /// The name in plain infix notation.
    pub fn name(self) -> &'static str {
        match self {
            Function::Sin => "sin",
            Function::Cos => "cos",
            Function::Tan => "tan",
            Function::Asin => "asin",
            Function::Acos => "acos",
            Function::Atan => "atan",
            Function::Sinh => "sinh",
            Function::Cosh => "cosh",
            Function::Tanh => "tanh",
            Function::Exp => "exp",
            Function::Ln => "ln",
            Function::Abs => "abs",
        }
    }
}

impl Expr {
    fn new(node: Node) -> Expr {
        let hash = match &node {
            // A fraction by itself hashes by Euclid's algorithm; this one is in lowest terms.
            Node::Number(value) => FxBuildHasher.hash_one((value.numer(), value.denom())),
            other => FxBuildHasher.hash_one(other),
        };
        Expr(Arc::new(Tree { hash, node }))
    }

    /// The outermost node.
    pub fn node(&self) -> &Node {
        &self.0.node
    }

    /// A symbol of the given name.
    pub fn symbol(name: &str) -> Expr {
        Expr::new(Node::Symbol(Arc::from(name)))
    }

    /// The circle constant; its name is reserved.
    pub fn pi() -> Expr {
        Expr::symbol("pi")
    }

    /// Zero.
    pub fn zero() -> Expr {
        Expr::from(0)
    }

    /// One.
    pub fn one() -> Expr {
        Expr::from(1)
    }

    /// The fraction `numerator / denominator`; `denominator` must not be zero.
    pub fn ratio(numerator: i64, denominator: i64) -> Expr {
        Expr::from(ratio(numerator, denominator))
    }

    /// The number, when the expression is one.
    pub fn as_number(&self) -> Option<&Rational> {
        match self.node() {
            Node::Number(value) => Some(value),
            _ => None,
        }
    }

    /// The symbol's name, when the expression is a symbol.
    pub fn as_symbol(&self) -> Option<&Symbol> {
        match self.node() {
            Node::Symbol(name) => Some(name),
            _ => None,
        }
    }

    /// Whether the expression is literally the number 0. An expression that merely equals 0 is `algebra`'s affair.
    pub fn is_zero(&self) -> bool {
        self.as_number().is_some_and(Zero::is_zero)
    }

    /// The rational factor it is written with, and the rest.
    pub fn split_number(&self) -> (Rational, Expr) {
        match self.node() {
            Node::Number(value) => (value.clone(), Expr::one()),
            Node::Product(factors) => match factors[0].as_number() {
                Some(value) => (value.clone(), Expr::product(factors[1..].iter().cloned())),
                None => (Rational::one(), self.clone()),
            },
            _ => (Rational::one(), self.clone()),
        }
    }

    /// Whether it is a negative number, or a product with one.
    pub fn is_negative(&self) -> bool {
        match self.node() {
            Node::Number(value) => value.is_negative(),
            Node::Product(factors) => factors[0].is_negative(),
            _ => false,
        }
    }

    /// Whether it is written with a minus sign in front.
    pub fn begins_with_minus(&self) -> bool {
        match self.node() {
            Node::Sum(terms) => terms[0].is_negative(),
            _ => self.is_negative(),
        }
    }

    /// Whether the expression is literally the number 1.
    pub fn is_one(&self) -> bool {
        self.as_number().is_some_and(One::is_one)
    }

    /// Sum of the terms; nested sums are opened, numbers added up at the place of the first, zeros dropped.
    pub fn sum(terms: impl IntoIterator<Item = Expr>) -> Expr {
        let terms = terms.into_iter();
        let mut out: Vec<Expr> = Vec::with_capacity(terms.size_hint().0);
        let mut number: Option<(usize, Rational)> = None;
        let mut add = |term: Expr, out: &mut Vec<Expr>| match term.as_number() {
            Some(value) => match &mut number {
                Some((_, total)) => *total += value,
                None => number = Some((out.len(), value.clone())),
            },
            None => out.push(term),
        };
        for term in terms {
            match term.node() {
                Node::Sum(inner) => inner.iter().for_each(|t| add(t.clone(), &mut out)),
                _ => add(term, &mut out),
            }
        }
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
        let factors = factors.into_iter();
        let mut out: Vec<Expr> = Vec::with_capacity(factors.size_hint().0);
        let mut number = Rational::one();
        let mut multiply = |factor: Expr, out: &mut Vec<Expr>| match factor.as_number() {
            // Most products hold one number.
            Some(value) if number.is_one() => number = value.clone(),
            Some(value) => number *= value,
            None => out.push(factor),
        };
        for factor in factors {
            match factor.node() {
                Node::Product(inner) => inner.iter().for_each(|f| multiply(f.clone(), &mut out)),
                _ => multiply(factor, &mut out),
            }
        }
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
                    let raised = Rational::new(base.numer().pow(k32), base.denom().pow(k32));
                    return Expr::from(if k < 0 { raised.recip() } else { raised });
                }
            }
            if let (Node::Power(inner, by), true) = (self.node(), power.is_integer()) {
                // (x^a)^n = x^(a n) for every integer n, unless the even root that forbids a negative x is lost.
                if let Some(a) = by.as_number() {
                    let total = a * power;
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

    /// The function of the expression.
    pub fn call(function: Function, argument: Expr) -> Expr {
        Expr::new(Node::Call(function, argument))
    }

    /// Sine; sin 0 is 0.
    pub fn sin(&self) -> Expr {
        if self.is_zero() {
            Expr::zero()
        } else {
            Expr::call(Function::Sin, self.clone())
        }
    }

    /// Cosine; cos 0 is 1.
    pub fn cos(&self) -> Expr {
        if self.is_zero() {
            Expr::one()
        } else {
            Expr::call(Function::Cos, self.clone())
        }
    }

    /// Tangent; tan 0 is 0.
    pub fn tan(&self) -> Expr {
        if self.is_zero() {
            Expr::zero()
        } else {
            Expr::call(Function::Tan, self.clone())
        }
    }

    /// Whether a root occurs, or a power whose exponent is no number.
    pub fn has_root(&self) -> bool {
        let mut found = false;
        self.walk(&mut |part| {
            if let Node::Power(_, exponent) = part.node() {
                found |= exponent.as_number().is_none_or(|k| !k.is_integer());
            }
        });
        found
    }

    /// Calls `visit` for this expression and everything inside it, outer before inner.
    pub fn walk(&self, visit: &mut impl FnMut(&Expr)) {
        visit(self);
        match self.node() {
            Node::Number(_) | Node::Symbol(_) => {}
            Node::Sum(parts) | Node::Product(parts) => parts.iter().for_each(|p| p.walk(visit)),
            Node::Power(base, exponent) => {
                base.walk(visit);
                exponent.walk(visit);
            }
            Node::Call(_, argument) => argument.walk(visit),
        }
    }

    /// Rebuilds the expression with every direct part replaced by `f` of it.
    pub fn map_parts(&self, mut f: impl FnMut(&Expr) -> Expr) -> Expr {
        match self.node() {
            Node::Number(_) | Node::Symbol(_) => self.clone(),
            Node::Sum(parts) => Expr::sum(parts.iter().map(f)),
            Node::Product(parts) => Expr::product(parts.iter().map(f)),
            Node::Power(base, exponent) => {
                let base = f(base);
                base.power(f(exponent))
            }
            Node::Call(function, argument) => Expr::call(*function, f(argument)),
        }
    }

    /// The same, if `f` gives something for every part.
    pub fn try_map_parts(&self, mut f: impl FnMut(&Expr) -> Option<Expr>) -> Option<Expr> {
        let mut whole = true;
        let out = self.map_parts(|part| {
            f(part).unwrap_or_else(|| {
                whole = false;
                part.clone()
            })
        });
        whole.then_some(out)
    }

    /// The names of all symbols, `pi` not among them.
    pub fn symbols(&self) -> BTreeSet<Symbol> {
        let mut names = BTreeSet::new();
        self.walk(&mut |e| {
            if let Some(name) = e.as_symbol()
                && &**name != "pi"
                && !names.contains(name)
            {
                names.insert(name.clone());
            }
        });
        names
    }

    /// Whether no symbol but `pi` occurs.
    pub fn is_constant(&self) -> bool {
        match self.node() {
            Node::Number(_) => true,
            Node::Symbol(name) => &**name == "pi",
            Node::Sum(parts) | Node::Product(parts) => parts.iter().all(Expr::is_constant),
            Node::Power(base, exponent) => base.is_constant() && exponent.is_constant(),
            Node::Call(_, argument) => argument.is_constant(),
        }
    }

    /// Number of nodes; the measure of length that limits and tie-breaks use.
    pub fn size(&self) -> usize {
        let mut count = 0;
        self.walk(&mut |_| count += 1);
        count
    }

    /// Replaces symbols by expressions, all at once.
    pub fn substitute(&self, values: &BTreeMap<Symbol, Expr>) -> Expr {
        match self.node() {
            Node::Symbol(name) => values.get(name).unwrap_or(self).clone(),
            _ => self.map_parts(|part| part.substitute(values)),
        }
    }

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

    /// Whether the expression has a value at every real point of its symbols: no quotient, root, logarithm and the like.
    fn is_total(&self) -> bool {
        let mut total = true;
        self.walk(&mut |e| match e.node() {
            Node::Power(_, exponent) => {
                total &= exponent
                    .as_number()
                    .is_some_and(|k| k.is_integer() && k.is_positive());
            }
            Node::Call(f, _) => {
                total &= !matches!(
                    f,
                    Function::Tan | Function::Asin | Function::Acos | Function::Ln
                );
            }
            _ => {}
        });
        total
    }
}

impl PartialEq for Expr {
    fn eq(&self, other: &Expr) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
            || (self.0.hash == other.0.hash && self.0.node == other.0.node)
    }
}

impl Eq for Expr {}

impl Hash for Expr {
    fn hash<H: Hasher>(&self, state: &mut H) {
        state.write_u64(self.0.hash);
    }
}

impl PartialOrd for Expr {
    fn partial_cmp(&self, other: &Expr) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Expr {
    /// By the nodes alone, so that no order depends on hashes.
    fn cmp(&self, other: &Expr) -> Ordering {
        if Arc::ptr_eq(&self.0, &other.0) {
            return Ordering::Equal;
        }
        self.0.node.cmp(&other.0.node)
    }
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
        Expr::new(Node::Number(value))
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
operator!(Add, add, |a, b| Expr::sum([a.clone(), b.clone()]));
operator!(Sub, sub, |a, b| Expr::sum([a.clone(), -b]));
operator!(Mul, mul, |a, b| Expr::product([a.clone(), b.clone()]));
operator!(Div, div, |a, b| Expr::product([a.clone(), b.powi(-1)]));

impl Neg for &Expr {
    type Output = Expr;
    fn neg(self) -> Expr {
        match self.node() {
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

/// Fully bracketed prefix notation, for debugging and test failures; people read `formula::write`.
impl fmt::Debug for Expr {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let list = |f: &mut fmt::Formatter<'_>, head: &str, parts: &[Expr]| {
            write!(f, "({head}")?;
            parts.iter().try_for_each(|p| write!(f, " {p:?}"))?;
            write!(f, ")")
        };
        match self.node() {
            Node::Number(value) => write!(f, "{value}"),
            Node::Symbol(name) => write!(f, "{name}"),
            Node::Sum(parts) => list(f, "+", parts),
            Node::Product(parts) => list(f, "*", parts),
            Node::Power(base, exponent) => list(f, "^", &[base.clone(), exponent.clone()]),
            Node::Call(function, argument) => {
                list(f, function.name(), std::slice::from_ref(argument))
            }
        }
    }
}

/// A vector in the plane, components along x and y.
pub type Vector = [Expr; 2];

/// z-component of the cross product a × b.
pub fn cross(a: &Vector, b: &Vector) -> Expr {
    &a[0] * &b[1] - &a[1] * &b[0]
}

/// Scalar product a · b.
pub fn dot(a: &Vector, b: &Vector) -> Expr {
    &a[0] * &b[0] + &a[1] * &b[1]
}

/// The difference a − b.
pub fn minus(a: &Vector, b: &Vector) -> Vector {
    [&a[0] - &b[0], &a[1] - &b[1]]
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

    #[test]
    fn derivative_of_a_product_of_functions() {
        let (x, a) = (Expr::symbol("x"), Expr::symbol("a"));
        let d = (x.sin() * &a).derivative("x");
        assert_eq!(d, x.cos() * &a);
    }
}
