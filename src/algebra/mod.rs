//! Exact algebra: normal forms of expressions, a zero test that decides, linear solving, and writing results shortly.
//!
//! In go expressions and the domains of their symbols; out come [`Element`]s of a [`Field`]: quotients of polynomials in
//! generators (symbols, cosines and sines of base angles, roots, opaque calls) reduced by the relations between these.
//! An element is zero exactly when its numerator is; no guess and no floating number takes part in that. What a limit
//! stops is an error, what was only seen and not proved is listed in [`Field::assumptions`], and whether a nonzero
//! element proves two formulas different is told by [`Field::complete`]. Nothing here knows of mechanics.

mod angles;
mod calls;
mod constant;
mod den;
mod differences;
mod element;
mod factor;
mod field;
mod fuel;
mod gcd;
mod image;
mod joined;
mod minors;
pub(crate) mod mono;
mod parts;
mod points;
pub(crate) mod poly;
mod powers;
pub(crate) mod prime;
mod product;
mod range;
mod read;
mod related;
mod roots;
mod sampled;
mod sign;
mod solve;
mod substitution;
mod write;
mod zeros;

use std::fmt;

use crate::domain::Domains;
use crate::expr::Expr;

pub use element::Element;
pub use field::{Assumption, Field};
pub use minors::Row;
pub use minors::determinant;
pub use powers::Powers;
pub use solve::{Solution, solve};
pub use zeros::Cell;

/// Why a computation ended without a result.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Stop {
    /// A budget counted in terms, degree, digits or depth is used up; the text names which.
    TooLarge(&'static str),
    /// Something that is zero was divided by.
    DivisionByZero,
    /// An even root of something negative on the whole domain.
    NotReal,
}

impl fmt::Display for Stop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Stop::TooLarge(what) => write!(f, "too large: the limit of {what} is reached"),
            Stop::DivisionByZero => f.write_str("division by zero"),
            Stop::NotReal => f.write_str("an even root of a negative value"),
        }
    }
}

impl std::error::Error for Stop {}

/// Most terms of a normal form beside the size of the expression: nobody writes `cos(sin(cos(2 + x)))` as its 50 625 products.
const MOST_WRITTEN: [usize; 2] = [500, 20];

/// The expression as a person would write it; as it stands where its normal form has very many more terms.
pub fn tidy(e: &Expr, domains: &Domains) -> Result<Expr, Stop> {
    let (field, x) = Field::of(domains, e)?;
    let [most, times] = MOST_WRITTEN;
    // A sign that was only seen at points changes no form unsaid.
    let proved = field.assumptions().is_empty();
    Ok(match proved && x.num.len() <= most.max(times * e.size()) {
        true => field.expr(&x),
        false => e.clone(),
    })
}

/// The sign of an expression, where it has one on the whole domain.
pub fn sign(e: &Expr, domains: &Domains) -> Option<Sign> {
    let (field, x) = Field::of(domains, e).ok()?;
    field.sign(&x).filter(|_| field.assumptions().is_empty())
}

/// A quotient as a person would write it.
pub fn quotient(a: &Expr, b: &Expr, domains: &Domains) -> Result<Expr, Stop> {
    let (field, x, y) = Field::pair(domains, a, b)?;
    Ok(match field.assumptions().is_empty() {
        true => field.expr(&field.div(&x, &y)?),
        false => a / b,
    })
}

/// A sign that holds at every point of the domain.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Sign {
    /// Below zero everywhere.
    Negative,
    /// Nowhere above zero.
    NotPositive,
    /// Zero.
    Zero,
    /// Nowhere below zero.
    NotNegative,
    /// Above zero everywhere.
    Positive,
}

impl Sign {
    /// The sign of the negative.
    pub fn flip(self) -> Sign {
        match self {
            Sign::Zero => Sign::Zero,
            _ => Sign::made(!self.is_not_negative(), self.is_strict()),
        }
    }

    /// The sign of a product.
    pub fn times(self, other: Sign) -> Sign {
        if self == Sign::Zero || other == Sign::Zero {
            return Sign::Zero;
        }
        let plus = self.is_not_negative() == other.is_not_negative();
        Sign::made(plus, self.is_strict() && other.is_strict())
    }

    /// Above zero or below, for certain or at most.
    pub(crate) fn made(positive: bool, strict: bool) -> Sign {
        match (positive, strict) {
            (true, true) => Sign::Positive,
            (true, false) => Sign::NotNegative,
            (false, true) => Sign::Negative,
            (false, false) => Sign::NotPositive,
        }
    }

    /// Whether a value of this sign is nowhere zero.
    pub fn is_strict(self) -> bool {
        matches!(self, Sign::Negative | Sign::Positive)
    }

    /// Whether a value of this sign is nowhere below zero.
    pub fn is_not_negative(self) -> bool {
        matches!(self, Sign::Zero | Sign::NotNegative | Sign::Positive)
    }
}

#[cfg(test)]
mod tests;
