//! From the written formula to expressions, with the size of numbers limited before any work.

use num_traits::{Signed, Zero};

use super::fault::Faulty;
use super::written::{Link, Shape, Sign, Written, has_components, is_unit};
use crate::expr::{Expr, Function, Rational, number};

/// Largest exponent that is a plain number.
const MAX_POWER: i64 = 10_000;
/// Most bits of a number that arises from numbers.
const MAX_BITS: u64 = 1 << 14;

/// A scalar, a vector along x, y and z, or a matrix by its rows.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Value {
    Scalar(Expr),
    Vector([Expr; 3]),
    Matrix(Vec<Vec<Expr>>),
}

/// How a written piece is taken.
#[derive(Clone, Copy)]
pub(crate) struct Mode {
    /// Which sign of ± is taken.
    pub upper: bool,
    /// Whether a name with an arrow stands for its three components.
    pub components: bool,
}

/// The value of a written piece.
pub(crate) fn value(w: &Written, mode: Mode) -> Faulty<Value> {
    let scalar = |e: Expr| Ok(Value::Scalar(e));
    match &w.shape {
        Shape::Number(literal) => scalar(Expr::from(literal.value.clone())),
        Shape::Symbol(name) => match &**name {
            "i_hat" => Ok(Value::Vector([Expr::one(), Expr::zero(), Expr::zero()])),
            "j_hat" => Ok(Value::Vector([Expr::zero(), Expr::one(), Expr::zero()])),
            "k_hat" => Ok(Value::Vector([Expr::zero(), Expr::zero(), Expr::one()])),
            name if mode.components && has_components(name) => {
                let along = |axis: &str| Expr::symbol(&format!("{name}_{axis}"));
                Ok(Value::Vector([along("x"), along("y"), along("z")]))
            }
            _ => scalar(Expr::from(name.clone())),
        },
        Shape::Sum(terms) => sum(w, terms, mode),
        Shape::Product(factors) => product(w, factors, mode),
        Shape::Fraction(above, below) => {
            let divisor = reciprocal(below, mode)?;
            times(w, value(above, mode)?, divisor)
        }
        Shape::Power(base, exponent)
            if mode.components
                && base.is_vector()
                && exponent
                    .literal()
                    .is_some_and(|k| number::is(&k.value, 2, 1)) =>
        {
            match value(base, mode)? {
                Value::Vector(v) => scalar(dotted(&v, &v)),
                Value::Scalar(e) => scalar(e.powi(2)),
                Value::Matrix(_) => Err(base.fault(UNREAD)),
            }
        }
        Shape::Power(base, exponent) => scalar(power(w, base, one(exponent, mode)?, mode)?),
        Shape::Root(index, inner) => {
            let index = match index {
                None => return scalar(one(inner, mode)?.sqrt()),
                Some(index) => one(index, mode)?,
            };
            let k = index
                .as_number()
                .filter(|k| k.is_integer() && k.is_positive());
            match k.and_then(|k| k.numer().as_i64()) {
                Some(2) => scalar(one(inner, mode)?.sqrt()),
                Some(k) if k <= 64 => scalar(one(inner, mode)?.power(Expr::ratio(1, k))),
                // `root(x, n)`
                _ if index.as_symbol().is_some() => scalar(power(w, inner, index.powi(-1), mode)?),
                _ => Err(w.fault("the index of a root is a whole number from 1 to 64")),
            }
        }
        Shape::Call(Function::Abs, inner) if inner.is_vector() => match value(inner, mode)? {
            Value::Vector(v) => scalar(dotted(&v, &v).sqrt()),
            _ => Err(inner.fault(UNREAD)),
        },
        Shape::Call(function, argument) => scalar(Expr::call(*function, one(argument, mode)?)),
        Shape::Reciprocal(function, argument) => {
            scalar(Expr::call(*function, one(argument, mode)?).powi(-1))
        }
        Shape::Bracket(inner) => value(inner, mode),
        Shape::Abs(inner) => scalar(match value(inner, mode)? {
            Value::Scalar(e) => Expr::call(Function::Abs, e),
            Value::Vector(v) => dotted(&v, &v).sqrt(),
            Value::Matrix(rows) => determinant(inner, &rows)?,
        }),
        Shape::Measured(inner, unit) => times(w, value(inner, mode)?, unit.value()),
        Shape::Degrees(inner) => scalar(one(inner, mode)? * Expr::pi() * Expr::ratio(1, 180)),
        Shape::List(rows) if w.is_matrix() => {
            let row = |row: &Written| {
                let entries = row.pieces().into_iter().map(|entry| one(entry, mode));
                entries.collect::<Faulty<Vec<Expr>>>()
            };
            let rows = rows.iter().map(row).collect::<Faulty<Vec<_>>>()?;
            match rows.iter().all(|row| row.len() == rows[0].len()) {
                true => Ok(Value::Matrix(rows)),
                false => Err(w.fault("the rows of a matrix are equally long")),
            }
        }
        Shape::List(parts) => {
            let mut components = [Expr::zero(), Expr::zero(), Expr::zero()];
            for (component, part) in components.iter_mut().zip(parts) {
                *component = one(part, mode)?;
            }
            Ok(Value::Vector(components))
        }
    }
}

/// The expression of a piece that is no vector.
pub(crate) fn one(w: &Written, mode: Mode) -> Faulty<Expr> {
    match value(w, mode)? {
        Value::Scalar(e) => Ok(e),
        Value::Vector(_) => Err(w.fault("a vector stands where a number is expected")),
        Value::Matrix(_) => Err(w.fault(UNREAD)),
    }
}

const UNREAD: &str = "a matrix stands where a number is expected";
/// Most pieces of an entry of a product of matrices.
const LARGEST_ENTRY: usize = 2_000;

/// The scalar product of two vectors.
fn dotted(a: &[Expr; 3], b: &[Expr; 3]) -> Expr {
    match a == b && is_unit(a) {
        true => Expr::one(),
        false => dot(a, b),
    }
}

fn sum(w: &Written, terms: &[(Sign, Written)], mode: Mode) -> Faulty<Value> {
    let mut scalars = Vec::with_capacity(terms.len());
    let mut vectors: Vec<[Expr; 3]> = Vec::new();
    let mut matrix: Option<Vec<Vec<Expr>>> = None;
    for (sign, term) in terms {
        let minus = match sign {
            Sign::Plus => false,
            Sign::Minus => true,
            Sign::PlusMinus => !mode.upper,
            Sign::MinusPlus => mode.upper,
        };
        match value(term, mode)? {
            Value::Scalar(e) => scalars.push(if minus { -e } else { e }),
            Value::Vector(v) => vectors.push(if minus { v.map(|c| -c) } else { v }),
            Value::Matrix(rows) => {
                let sign = Expr::from(if minus { -1 } else { 1 });
                let total = matrix.take();
                let zero = || vec![vec![Expr::zero(); rows[0].len()]; rows.len()];
                let total = total.unwrap_or_else(zero);
                let shape = |m: &[Vec<Expr>]| (m.len(), m[0].len());
                if shape(&total) != shape(&rows) {
                    return Err(term.fault("matrices of two sizes are added"));
                }
                let row = |(a, b): (&Vec<Expr>, &Vec<Expr>)| {
                    a.iter().zip(b).map(|(a, b)| a + &(&sign * b)).collect()
                };
                matrix = Some(total.iter().zip(&rows).map(row).collect());
            }
        }
    }
    if let Some(rows) = matrix {
        return match scalars.is_empty() && vectors.is_empty() {
            true => Ok(Value::Matrix(rows)),
            false => Err(w.fault("a matrix and something else are added")),
        };
    }
    if vectors.is_empty() {
        let total = Expr::sum(scalars);
        return bounded(&total, w).map(|()| Value::Scalar(total));
    }
    if scalars.iter().any(|e| !e.is_zero()) {
        return Err(w.fault("a vector and a number are added"));
    }
    let along = |k: usize| Expr::sum(vectors.iter().map(|v| v[k].clone()));
    Ok(Value::Vector([along(0), along(1), along(2)]))
}

fn product(w: &Written, factors: &[(Link, Written)], mode: Mode) -> Faulty<Value> {
    let mut scalars = Vec::with_capacity(factors.len());
    // The vector or matrix among the factors so far, and how many scalars stand before it.
    let mut held: Option<(usize, Value)> = None;
    for (i, (link, factor)) in factors.iter().enumerate() {
        let next = match link {
            Link::Over if i > 0 => Value::Scalar(reciprocal(factor, mode)?),
            _ => value(factor, mode)?,
        };
        match (next, held.take()) {
            (Value::Scalar(e), before) => {
                scalars.push(e);
                held = before;
            }
            (next, None) => held = Some((scalars.len(), next)),
            (next, Some((at, Value::Matrix(rows)))) => {
                held = Some((at, applied(factor, &rows, &next)?));
            }
            // Two vectors: a dot or a cross says what is meant.
            (Value::Vector(b), Some((at, Value::Vector(a)))) => match link {
                Link::Times => scalars.insert(at, dotted(&a, &b)),
                Link::Cross => held = Some((at, Value::Vector(cross(&a, &b)))),
                _ => {
                    let message = "a product of two vectors is not read";
                    return Err(w.fault(message));
                }
            },
            (_, Some(_)) => {
                return Err(factor.fault("a matrix stands before the vector it multiplies"));
            }
        }
    }
    match held {
        None => scaled(w, scalars, None),
        Some((_, Value::Vector(v))) => scaled(w, scalars, Some(v)),
        Some((_, other)) => times(w, other, Expr::product(scalars)),
    }
}

/// A matrix times a matrix, or a vector as a column.
fn applied(w: &Written, rows: &[Vec<Expr>], to: &Value) -> Faulty<Value> {
    let n = rows[0].len();
    let columns: Vec<Vec<Expr>> = match to {
        Value::Matrix(other) if other.len() == n => {
            let column = |k: usize| other.iter().map(|row| row[k].clone()).collect();
            (0..other[0].len()).map(column).collect()
        }
        Value::Vector(v) if v[n..].iter().all(Expr::is_zero) => vec![v[..n].to_vec()],
        _ => return Err(w.fault("a matrix of another size cannot be multiplied")),
    };
    let entry = |row: &Vec<Expr>, column: &Vec<Expr>| {
        let total = Expr::sum(row.iter().zip(column).map(|(a, b)| a * b));
        match total.size() > LARGEST_ENTRY {
            true => Err(w.fault("this product of matrices is too large")),
            false => bounded(&total, w).map(|()| total),
        }
    };
    let row = |row| columns.iter().map(|column| entry(row, column)).collect();
    let mut rows = rows.iter().map(row).collect::<Faulty<Vec<Vec<Expr>>>>()?;
    Ok(match to {
        Value::Vector(_) => {
            let mut components = rows.iter_mut().map(|row| row.remove(0));
            Value::Vector([(); 3].map(|()| components.next().unwrap_or_else(Expr::zero)))
        }
        _ => Value::Matrix(rows),
    })
}

/// The determinant of a square matrix, by its first row.
fn determinant(w: &Written, rows: &[Vec<Expr>]) -> Faulty<Expr> {
    if rows.len() != rows[0].len() {
        return Err(w.fault("a determinant is of as many rows as columns"));
    }
    let total = match rows {
        [a, b] => &a[0] * &b[1] - &a[1] * &b[0],
        [a, b, c] => {
            let [a, b, c] = [a, b, c].map(|row| [row[0].clone(), row[1].clone(), row[2].clone()]);
            dot(&a, &cross(&b, &c))
        }
        _ => return Err(w.fault(UNREAD)),
    };
    bounded(&total, w).map(|()| total)
}

fn dot(a: &[Expr; 3], b: &[Expr; 3]) -> Expr {
    Expr::sum((0..3).map(|i| &a[i] * &b[i]))
}

fn cross(a: &[Expr; 3], b: &[Expr; 3]) -> [Expr; 3] {
    [0, 1, 2].map(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        &a[j] * &b[k] - &a[k] * &b[j]
    })
}

/// A value times a number.
fn times(w: &Written, value: Value, by: Expr) -> Faulty<Value> {
    match value {
        Value::Scalar(e) => scaled(w, vec![e, by], None),
        Value::Vector(v) => scaled(w, vec![by], Some(v)),
        Value::Matrix(rows) => {
            let entry = |e| match scaled(w, vec![e, by.clone()], None)? {
                Value::Scalar(e) => Ok(e),
                _ => Err(w.fault(UNREAD)),
            };
            let row = |row: Vec<Expr>| row.into_iter().map(entry).collect::<Faulty<_>>();
            Ok(Value::Matrix(
                rows.into_iter().map(row).collect::<Faulty<_>>()?,
            ))
        }
    }
}

/// The product of some scalars, and of a vector where there is one.
fn scaled(w: &Written, scalars: Vec<Expr>, vector: Option<[Expr; 3]>) -> Faulty<Value> {
    if scalars.iter().map(leading_bits).sum::<u64>() > MAX_BITS {
        return Err(w.fault("the numbers in this product are too large"));
    }
    let scale = Expr::product(scalars);
    Ok(match vector {
        None => Value::Scalar(scale),
        Some(v) => Value::Vector(v.map(|c| if c.is_zero() { c } else { &scale * &c })),
    })
}

fn reciprocal(w: &Written, mode: Mode) -> Faulty<Expr> {
    let below = one(w, mode)?;
    if below.is_zero() {
        return Err(w.fault("division by zero"));
    }
    // 1/(x^-n) stays within the limit of powers, and 1/number is exact.
    Ok(below.written_power(Expr::from(-1)))
}

fn power(w: &Written, base: &Written, exponent: Expr, mode: Mode) -> Faulty<Expr> {
    let below = one(base, mode)?;
    if let Some(k) = exponent.as_number() {
        // Comparing fractions costs a division.
        let beyond = |k: &Rational| {
            k.numer().bits() > 13 && k.abs() > Rational::from(crate::expr::Int::from(MAX_POWER))
        };
        if beyond(k) {
            return Err(w.fault(format!("an exponent is at most {MAX_POWER}")));
        }
        if below.is_zero() && !k.is_positive() {
            return Err(w.fault("zero to a power that is not positive has no value"));
        }
        let times = k.numer().as_i64().unwrap_or(0).unsigned_abs();
        let folds = k.is_integer() && times <= 64;
        if folds && leading_bits(&below) * times > MAX_BITS {
            return Err(w.fault("this power is too large"));
        }
        // Towers such as ((x^100)^100)^100 multiply their exponents.
        if let crate::expr::Node::Power(_, inner) = below.node()
            && inner.as_number().is_some_and(|a| beyond(&(a * k)))
        {
            return Err(w.fault(format!("an exponent is at most {MAX_POWER}")));
        }
        if number::is(k, 1, 2) {
            return Ok(below.sqrt());
        }
        if k.is_zero() && below.as_number().is_some() {
            return Ok(Expr::one());
        }
    }
    Ok(below.written_power(exponent))
}

/// Bits of the number an expression is or starts with.
fn leading_bits(e: &Expr) -> u64 {
    let of = |n: &Rational| (n.numer().bits() + n.denom().bits()).saturating_sub(2);
    match e.node() {
        crate::expr::Node::Number(n) => of(n),
        crate::expr::Node::Product(factors) => {
            factors.first().and_then(Expr::as_number).map_or(0, of)
        }
        _ => 0,
    }
}

fn bounded(e: &Expr, w: &Written) -> Faulty<()> {
    match e.terms().iter().any(|t| leading_bits(t) > MAX_BITS) {
        true => Err(w.fault("the numbers in this sum are too large")),
        false => Ok(()),
    }
}
