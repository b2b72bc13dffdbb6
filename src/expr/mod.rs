//! The expression: exact numbers, symbols, sums, products, powers and functions; build, walk, substitute, evaluate.
//!
//! An [`Expr`] is a value: cloning copies a pointer, nothing is interned, and no two expressions share state. The
//! constructors tidy only what cannot change a meaning (nested sums, 0 + x, 1·x, arithmetic of numbers). Deciding whether
//! two expressions are equal is the work of [`crate::algebra`]; how somebody wrote one is kept in [`crate::formula`].

pub mod angle;
pub mod arithmetic;
mod build;
mod derivative;
pub(crate) mod effort;
pub mod eval;
mod function;
pub mod number;
pub mod rows;
pub mod surd;
mod table;
mod vector;

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::hash::{BuildHasher, Hash, Hasher};
use std::sync::Arc;

use num_traits::{One, Signed, Zero};
use rustc_hash::FxBuildHasher;

pub use eval::{Point, Scalar};
pub use function::Function;
pub use number::{Int, Rational, ratio};
pub use table::Table;
pub use vector::{Vector, cross, dot, minus, plus};

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

    /// The terms of a sum; anything else is one term.
    pub fn terms(&self) -> &[Expr] {
        match self.node() {
            Node::Sum(terms) => terms,
            _ => std::slice::from_ref(self),
        }
    }

    /// The factors of a product; anything else is one factor.
    pub fn factors(&self) -> &[Expr] {
        match self.node() {
            Node::Product(factors) => factors,
            _ => std::slice::from_ref(self),
        }
    }

    /// What stands under the square root that the expression is.
    pub fn under_root(&self) -> Option<&Expr> {
        match self.node() {
            Node::Power(base, k) if k.as_number().is_some_and(|k| number::is(k, 1, 2)) => {
                Some(base)
            }
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

    /// What it divides by, as a power of a negative number stands below the line: the base, and that exponent.
    pub fn divides_by(&self) -> Option<(&Expr, &Rational)> {
        match self.node() {
            Node::Power(base, k) => Some((base, k.as_number().filter(|k| k.is_negative())?)),
            _ => None,
        }
    }

    /// Its factors above the line and what stands below it, each to a positive power.
    pub fn above_and_below(&self) -> [Vec<Expr>; 2] {
        let mut parts = [Vec::new(), Vec::new()];
        for factor in self.factors() {
            match factor.divides_by() {
                Some((base, k)) => parts[1].push(base.power(Expr::from(-k))),
                None => parts[0].push(factor.clone()),
            }
        }
        parts
    }

    /// Whether it is a whole number.
    pub fn is_integer(&self) -> bool {
        self.as_number().is_some_and(Rational::is_integer)
    }

    /// Whether it is made by sums, products and whole powers alone.
    pub fn is_rational(&self) -> bool {
        self.parts().all(|part| match part.node() {
            Node::Call(..) => false,
            Node::Power(_, k) => k.is_integer(),
            _ => true,
        })
    }

    /// Whether it is so without a power below one, and has a value everywhere.
    pub fn is_polynomial(&self) -> bool {
        let positive = |k: &Rational| k.is_integer() && k.is_positive();
        self.parts().all(|part| match part.node() {
            Node::Call(..) => false,
            Node::Power(_, k) => k.as_number().is_some_and(positive),
            _ => true,
        })
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

    /// Whether a root occurs, or a power whose exponent is no number.
    pub fn has_root(&self) -> bool {
        self.parts().any(|part| match part.node() {
            Node::Power(_, exponent) => exponent.as_number().is_none_or(|k| !k.is_integer()),
            _ => false,
        })
    }

    /// Whether a power occurs whose exponent is no number or beyond 64 either way: a tower of powers would be computed to the
    /// last digit.
    pub fn has_high_power(&self) -> bool {
        let low = |k: &Rational| k.numer().as_i64().is_some_and(|k| k.abs() <= 64);
        self.parts().any(|part| match part.node() {
            Node::Power(_, k) => !k.as_number().is_some_and(low),
            _ => false,
        })
    }

    /// This expression and everything inside it, outer before inner, left before right.
    pub fn parts(&self) -> impl Iterator<Item = &Expr> {
        let (mut next, mut later) = (Some(self), Vec::new());
        std::iter::from_fn(move || {
            let part = next.take().or_else(|| later.pop())?;
            match part.node() {
                Node::Number(_) | Node::Symbol(_) => {}
                Node::Sum(parts) | Node::Product(parts) => later.extend(parts.iter().rev()),
                Node::Power(base, exponent) => later.extend([exponent, base]),
                Node::Call(_, argument) => next = Some(argument),
            }
            Some(part)
        })
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
        let mut names: Vec<&Symbol> = Vec::new();
        for name in self.parts().filter_map(Expr::as_symbol) {
            // Nearly all occurrences of a name share it.
            if &**name != "pi" && !names.iter().any(|known| Arc::ptr_eq(known, name)) {
                names.push(name);
            }
        }
        names.into_iter().cloned().collect()
    }

    /// Whether a symbol occurs.
    pub fn mentions(&self, name: &str) -> bool {
        let mut names = self.parts().filter_map(Expr::as_symbol);
        names.any(|symbol| &**symbol == name)
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

    /// Whether it is an angle by its form: an arc of sine, cosine or tangent, or π, times numbers, or a sum of such.
    pub fn is_arc(&self) -> bool {
        match self.node() {
            Node::Symbol(name) => &**name == "pi",
            Node::Call(f, _) => matches!(f, Function::Asin | Function::Acos | Function::Atan),
            Node::Sum(parts) => parts.iter().all(Expr::is_arc),
            Node::Product(parts) => match parts.as_slice() {
                [number, arc] => number.as_number().is_some() && arc.is_arc(),
                _ => false,
            },
            Node::Number(_) | Node::Power(..) => false,
        }
    }

    /// Number of nodes; the measure of length that limits and tie-breaks use.
    pub fn size(&self) -> usize {
        self.parts().count()
    }

    /// Replaces symbols by expressions, all at once.
    pub fn substitute(&self, values: &BTreeMap<Symbol, Expr>) -> Expr {
        match self.node() {
            Node::Symbol(name) => values.get(name).unwrap_or(self).clone(),
            _ => self.map_parts(|part| part.substitute(values)),
        }
    }

    /// Replaces one symbol throughout.
    pub fn put(&self, name: &str, value: &Expr) -> Expr {
        match self.node() {
            Node::Symbol(own) if **own == *name => value.clone(),
            _ => self.map_parts(|part| part.put(name, value)),
        }
    }

    /// Replaces one part throughout.
    pub fn replace(&self, old: &Expr, new: &Expr) -> Expr {
        match self == old {
            true => new.clone(),
            false => self.map_parts(|part| part.replace(old, new)),
        }
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

/// The only one of several, where there is just one.
pub fn only<T>(all: impl IntoIterator<Item = T>) -> Option<T> {
    let mut all = all.into_iter();
    let first = all.next()?;
    all.next().is_none().then_some(first)
}
