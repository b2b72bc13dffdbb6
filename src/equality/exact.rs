//! Exact fractions of bounded size: evaluation that stops instead of growing.

use num_traits::{One, Signed, ToPrimitive, Zero};

use crate::expr::number::sqrt_exact;
use crate::expr::{Function, Int, Rational};
use crate::interval::{Certified, Outcome};
use Outcome::{Undefined, Unknown, Value};

/// Bits of numerator and denominator together beyond which a fraction is given up: greatest common divisors of longer
/// numbers cost more than an enclosure of the same value.
const LARGEST: u64 = 512;

/// A fraction that is known exactly.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Exact(pub Rational);

fn bits(x: &Rational) -> u64 {
    x.numer().bits() + x.denom().bits()
}

fn small(x: &Rational, y: &Rational) -> bool {
    bits(x) + bits(y) <= LARGEST
}

impl Certified for Exact {
    fn from_rational(value: &Rational) -> Self {
        Exact(value.clone())
    }
    fn pi() -> Outcome<Self> {
        Unknown
    }
    fn plus(&self, other: &Self) -> Outcome<Self> {
        if small(&self.0, &other.0) {
            Value(Exact(&self.0 + &other.0))
        } else {
            Unknown
        }
    }
    fn times(&self, other: &Self) -> Outcome<Self> {
        if small(&self.0, &other.0) {
            Value(Exact(&self.0 * &other.0))
        } else {
            Unknown
        }
    }
    fn recip(&self) -> Outcome<Self> {
        if self.0.is_zero() {
            Undefined
        } else {
            Value(Exact(self.0.recip()))
        }
    }
    fn sqrt(&self) -> Outcome<Self> {
        if self.0.is_negative() {
            return Undefined;
        }
        sqrt_exact(&self.0).map_or(Unknown, |root| Value(Exact(root)))
    }
    fn pow(&self, exponent: &Self) -> Outcome<Self> {
        if self.0.is_negative() {
            return if exponent.0.is_integer() {
                self.power(&exponent.0)
            } else {
                Undefined
            };
        }
        if self.0.is_zero() {
            return if exponent.0.is_positive() {
                Value(self.clone())
            } else {
                Undefined
            };
        }
        self.power(&exponent.0)
    }
    fn below_zero(&self) -> bool {
        self.0.is_negative()
    }
    fn call(&self, function: Function) -> Outcome<Self> {
        let x = &self.0;
        let zero = || Value(Exact(Rational::zero()));
        match function {
            Function::Abs => Value(Exact(x.abs())),
            Function::Ln if !x.is_positive() => Undefined,
            Function::Ln if x.is_one() => zero(),
            Function::Asin | Function::Acos if x.abs() > Rational::one() => Undefined,
            Function::Cos | Function::Exp | Function::Cosh if x.is_zero() => {
                Value(Exact(Rational::one()))
            }
            Function::Sin
            | Function::Tan
            | Function::Asin
            | Function::Atan
            | Function::Sinh
            | Function::Tanh
                if x.is_zero() =>
            {
                zero()
            }
            _ => Unknown,
        }
    }
}

impl Exact {
    /// x^(p/q) where the q-th root is a fraction; x is not 0, and positive unless q = 1.
    fn power(&self, exponent: &Rational) -> Outcome<Exact> {
        let (Some(p), Some(q)) = (exponent.numer().as_i64(), exponent.denom().to_u32()) else {
            return Unknown;
        };
        if q > 64 || bits(&self.0).saturating_mul(p.unsigned_abs()) > LARGEST {
            return Unknown;
        }
        let root = |n: &Int| {
            let root = Int::from(n.to_bigint().nth_root(q));
            (root.pow(q) == *n).then_some(root)
        };
        let (Some(n), Some(d)) = (root(self.0.numer()), root(self.0.denom())) else {
            return Unknown;
        };
        let k = p.unsigned_abs() as u32;
        let raised = Rational::new(n.pow(k), d.pow(k));
        Value(Exact(if p < 0 { raised.recip() } else { raised }))
    }
}
