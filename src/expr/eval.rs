//! Evaluation over any number type: doubles, exact fractions, intervals.

use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use super::angle::{Angle, angle};
use super::number::{self, Int};
use super::{Expr, Function, Node, Rational, Table, effort};

/// A number type expressions can be evaluated in. A partial operation returns `None` where it has no value *in this type*:
/// √2 is no fraction, and an interval around 0 has no reciprocal.
pub trait Scalar: Clone {
    /// Steps that an operation takes, about ten nanoseconds each.
    const STEPS: u64 = 1;
    /// The nearest value, or an enclosure.
    fn from_rational(value: &Rational) -> Self;
    /// The circle constant, where the type can represent it.
    fn pi() -> Option<Self>;
    /// Sum.
    fn plus(&self, other: &Self) -> Self;
    /// Product.
    fn times(&self, other: &Self) -> Self;
    /// Reciprocal.
    fn recip(&self) -> Option<Self>;
    /// Non-negative square root.
    fn sqrt(&self) -> Option<Self>;
    /// √n, in a type that holds it exactly as a root.
    fn exact_root(_n: u32) -> Option<Self> {
        None
    }
    /// Power with a whole exponent, by repeated squaring.
    fn to_the(&self, exponent: u64) -> Self {
        let mut result = None;
        let mut square = self.clone();
        let mut left = exponent;
        while left > 0 {
            if left & 1 == 1 {
                result = Some(result.map_or_else(|| square.clone(), |r: Self| r.times(&square)));
            }
            left >>= 1;
            if left > 0 {
                square = square.times(&square);
            }
        }
        result.unwrap_or_else(|| Self::from_rational(&Rational::one()))
    }
    /// Power with an exponent that is neither an integer nor a half-integer.
    fn pow(&self, exponent: &Self) -> Option<Self>;
    /// Whether the value is below zero for certain.
    fn below_zero(&self) -> bool {
        false
    }
    /// A function; `Sin`, `Cos` and `Tan` come here only where the point gives no exact direction for the angle.
    fn call(&self, function: Function) -> Option<Self>;
}

/// Values for the symbols of an expression.
#[derive(Clone, Debug)]
pub struct Point<T> {
    /// Value of each symbol, angles in radians among them.
    pub values: Table<T>,
    /// For an angle φ known by a direction: a divisor N and (cos(φ/N), sin(φ/N)). With rational entries this makes sin and
    /// cos of every multiple of φ/N exact.
    pub directions: Table<(u32, [T; 2])>,
}

impl<T> Point<T> {
    /// The same point in another number type.
    pub fn map<U>(&self, put: impl Fn(&T) -> U) -> Point<U> {
        let values = self.values.iter();
        let directions = self.directions.iter();
        let turned = |[c, s]: &[T; 2]| [put(c), put(s)];
        Point {
            values: values.map(|(name, v)| (name.clone(), put(v))).collect(),
            directions: directions
                .map(|(name, (n, unit))| (name.clone(), (*n, turned(unit))))
                .collect(),
        }
    }
}

impl<T> Default for Point<T> {
    fn default() -> Self {
        Point {
            values: Table::default(),
            directions: Table::default(),
        }
    }
}

impl Expr {
    /// The value at a point; `None` where the expression has none in `T`, a symbol has no value, or no steps are left.
    pub fn evaluate<T: Scalar>(&self, at: &Point<T>) -> Option<T> {
        if !effort::take(T::STEPS) {
            return None;
        }
        match self.node() {
            Node::Number(value) => Some(T::from_rational(value)),
            Node::Symbol(name) if &**name == "pi" => T::pi(),
            Node::Symbol(name) => at.values.get(name).cloned(),
            Node::Sum(terms) => {
                let mut total = terms[0].evaluate(at)?;
                for term in &terms[1..] {
                    total = total.plus(&term.evaluate(at)?);
                }
                Some(total)
            }
            Node::Product(factors) => {
                let mut total = factors[0].evaluate(at)?;
                for factor in &factors[1..] {
                    total = total.times(&factor.evaluate(at)?);
                }
                Some(total)
            }
            Node::Power(base, exponent) => power(&base.evaluate(at)?, exponent, at),
            Node::Call(function, argument) => call(*function, argument, at),
        }
    }
}

fn power<T: Scalar>(base: &T, exponent: &Expr, at: &Point<T>) -> Option<T> {
    if let Some(k) = exponent.as_number() {
        let half = k.denom().as_i64() == Some(2);
        if half || k.is_integer() {
            let times = k.numer().as_i64()?;
            let root = if half { base.sqrt()? } else { base.clone() };
            let raised = root.to_the(times.unsigned_abs());
            return match times < 0 {
                true => raised.recip(),
                false => Some(raised),
            };
        }
        // A root of odd degree is real for every base.
        if k.denom().is_odd() && base.below_zero() {
            let minus = T::from_rational(&-Rational::one());
            let size = minus.times(base).pow(&T::from_rational(k))?;
            let odd = k.numer().is_odd();
            return Some(if odd { minus.times(&size) } else { size });
        }
    }
    base.pow(&exponent.evaluate(at)?)
}

fn call<T: Scalar>(function: Function, argument: &Expr, at: &Point<T>) -> Option<T> {
    let turned = || match argument.as_symbol().filter(|name| &***name != "pi") {
        // Most angles are a bare symbol.
        Some(name) => {
            let (divisor, unit) = at.directions.get(name)?;
            Some(multiple(unit, i64::from(*divisor)))
        }
        None => angle(argument).and_then(|a| direction(&a, at)),
    };
    if let Function::Sin | Function::Cos | Function::Tan = function
        && let Some([cos, sin]) = turned()
    {
        return match function {
            Function::Sin => Some(sin),
            Function::Cos => Some(cos),
            _ => Some(sin.times(&cos.recip()?)),
        };
    }
    argument.evaluate(at)?.call(function)
}

/// (cos, sin) of an angle whose symbols all have directions that divide it.
fn direction<T: Scalar>(angle: &Angle, at: &Point<T>) -> Option<[T; 2]> {
    // Nothing to turn yet where no multiple of π is added.
    let mut total = match angle.pi.is_zero() {
        true => None,
        false => Some(quarter_turns(&angle.pi)?),
    };
    for (name, factor) in &angle.symbols {
        let (divisor, unit) = at.directions.get(name)?;
        let turns = number::product(factor, &number::ratio(i64::from(*divisor), 1));
        if !turns.is_integer() {
            return None;
        }
        let k = turns.numer().as_i64()?;
        if k.unsigned_abs() > 4096 {
            return None;
        }
        let turned = multiple(unit, k);
        total = Some(match total {
            Some(before) => turn(&before, &turned),
            None => turned,
        });
    }
    total.or_else(|| quarter_turns(&angle.pi))
}

/// (cos, sin) of a multiple of π, for multiples of π/2, and of π/4 and π/6 where the type holds their roots.
fn quarter_turns<T: Scalar>(pi: &Rational) -> Option<[T; 2]> {
    let steps = number::product(pi, &number::ratio(12, 1));
    if !steps.is_integer() {
        return None;
    }
    let k = steps.numer().mod_floor(&Int::from(24)).as_i64()?;
    let half = |n| Some(T::exact_root(n)?.times(&T::from_rational(&number::ratio(1, 2))));
    let whole = |n| Some(T::from_rational(&number::ratio(n, 1)));
    let unit = match k % 6 {
        0 => [whole(1)?, whole(0)?],
        2 => [half(3)?, half(1)?],
        3 => [half(2)?, half(2)?],
        4 => [half(1)?, half(3)?],
        _ => return None,
    };
    let quarter = [whole(0)?, whole(1)?];
    Some((0..k / 6).fold(unit, |turned, _| turn(&turned, &quarter)))
}

fn turn<T: Scalar>(a: &[T; 2], b: &[T; 2]) -> [T; 2] {
    let minus_one = T::from_rational(&-Rational::one());
    [
        a[0].times(&b[0]).plus(&minus_one.times(&a[1].times(&b[1]))),
        a[1].times(&b[0]).plus(&a[0].times(&b[1])),
    ]
}

fn multiple<T: Scalar>(unit: &[T; 2], k: i64) -> [T; 2] {
    let mut square = unit.clone();
    if k < 0 {
        square[1] = T::from_rational(&-Rational::one()).times(&square[1]);
    }
    let mut left = k.unsigned_abs();
    let mut result = None;
    loop {
        if left & 1 == 1 {
            result = Some(result.map_or_else(|| square.clone(), |r| turn(&r, &square)));
        }
        left >>= 1;
        if left == 0 {
            return result.unwrap_or_else(|| {
                [Rational::one(), Rational::zero()].map(|v| T::from_rational(&v))
            });
        }
        square = turn(&square, &square);
    }
}

impl Scalar for f64 {
    fn from_rational(value: &Rational) -> f64 {
        number::to_f64(value)
    }
    fn pi() -> Option<f64> {
        Some(std::f64::consts::PI)
    }
    fn plus(&self, other: &f64) -> f64 {
        self + other
    }
    fn times(&self, other: &f64) -> f64 {
        self * other
    }
    fn recip(&self) -> Option<f64> {
        (*self != 0.0).then(|| 1.0 / self)
    }
    fn sqrt(&self) -> Option<f64> {
        (*self >= 0.0).then(|| f64::sqrt(*self))
    }
    fn pow(&self, exponent: &f64) -> Option<f64> {
        (*self > 0.0).then(|| self.powf(*exponent))
    }
    fn below_zero(&self) -> bool {
        *self < 0.0
    }
    fn call(&self, function: Function) -> Option<f64> {
        let value = match function {
            Function::Sin => self.sin(),
            Function::Cos => self.cos(),
            Function::Tan => self.tan(),
            Function::Asin => self.asin(),
            Function::Acos => self.acos(),
            Function::Atan => self.atan(),
            Function::Sinh => self.sinh(),
            Function::Cosh => self.cosh(),
            Function::Tanh => self.tanh(),
            Function::Exp => self.exp(),
            Function::Ln => self.ln(),
            Function::Abs => self.abs(),
        };
        value.is_finite().then_some(value)
    }
}

impl Scalar for Rational {
    fn from_rational(value: &Rational) -> Rational {
        value.clone()
    }
    fn pi() -> Option<Rational> {
        None
    }
    fn plus(&self, other: &Rational) -> Rational {
        number::sum(self, other, false)
    }
    fn times(&self, other: &Rational) -> Rational {
        number::product(self, other)
    }
    fn recip(&self) -> Option<Rational> {
        (!self.is_zero()).then(|| Rational::recip(self))
    }
    fn sqrt(&self) -> Option<Rational> {
        number::sqrt_exact(self)
    }
    /// Powers of what has nothing in common have nothing in common.
    fn to_the(&self, exponent: u64) -> Rational {
        let power = |n: &Int| num_traits::pow(n.clone(), exponent as usize);
        Rational::new_raw(power(self.numer()), power(self.denom()))
    }
    fn pow(&self, exponent: &Rational) -> Option<Rational> {
        (self.is_zero() && exponent.is_positive()).then(Rational::zero)
    }
    fn call(&self, function: Function) -> Option<Rational> {
        match function {
            Function::Abs => Some(self.abs()),
            Function::Sin | Function::Tan | Function::Asin | Function::Atan if self.is_zero() => {
                Some(Rational::zero())
            }
            Function::Cos if self.is_zero() => Some(Rational::one()),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expr::ratio;

    #[test]
    fn a_rational_point_of_the_circle_makes_multiple_angles_exact() {
        let theta = Expr::symbol("theta");
        let mut at = Point::<Rational>::default();
        at.directions
            .insert("theta".into(), (1, [ratio(3, 5), ratio(4, 5)]));
        let cos2 = (&theta * &Expr::from(2)).cos();
        assert_eq!(cos2.evaluate(&at), Some(ratio(-7, 25)));
        let shifted = (&theta + &(Expr::pi() * Expr::ratio(1, 2))).sin();
        assert_eq!(shifted.evaluate(&at), Some(ratio(3, 5)));
    }

    #[test]
    fn a_fraction_has_no_irrational_root() {
        let nothing = Expr::zero().power(Expr::ratio(1, 4));
        assert_eq!(
            nothing.evaluate(&Point::<Rational>::default()),
            Some(Rational::zero())
        );
        assert_eq!(
            Expr::from(2).sqrt().evaluate(&Point::<Rational>::default()),
            None
        );
        assert_eq!(
            Expr::from(0)
                .powi(-1)
                .evaluate(&Point::<Rational>::default()),
            None
        );
    }
}
