//! Units in which the arguments of a function are near one, so that what lies between them and the value neither over- nor
//! underflows.
//!
//! A formula whose dimensions agree gives the same in any units. Powers of two as units change no digit: the largest mass
//! and the largest length are brought near one, say, and the value back. In: dimensions. Out: the exponents, and the few
//! helpers in each language.

use num_traits::{Signed, Zero};

use super::dialect::Language;
use crate::dimension::Dimension;
use crate::expr::rows::reduce;
use crate::expr::{Rational, ratio};

/// How arguments become near one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Units {
    /// For each unit the arguments of which the largest is brought near one; they share a dimension.
    pub of: Vec<Vec<usize>>,
    /// For each argument twice the power of each unit in its dimension.
    pub arguments: Vec<Vec<i64>>,
    /// The same for the value.
    pub value: Vec<i64>,
}

/// Units for arguments of these dimensions; `None` where no argument has one, and where a dimension is no product of
/// those of the others, with whole or half powers.
pub fn units(arguments: &[Dimension], value: &Dimension) -> Option<Units> {
    let mut classes: Vec<Vec<usize>> = Vec::new();
    for (i, dimension) in arguments.iter().enumerate() {
        if dimension.is_none() {
            continue;
        }
        match classes.iter_mut().find(|c| arguments[c[0]] == *dimension) {
            Some(class) => class.push(i),
            None => classes.push(vec![i]),
        }
    }
    // The simplest first: a mass and a length rather than a moment of inertia.
    let weight = |class: &Vec<usize>| {
        let exponents = exponents(&arguments[class[0]]);
        exponents.iter().map(|e| e.abs()).sum::<Rational>()
    };
    classes.sort_by_key(|class| (weight(class), class[0]));
    let mut of: Vec<Vec<usize>> = Vec::new();
    let mut base: Vec<[Rational; 3]> = Vec::new();
    for class in classes {
        let exponents = exponents(&arguments[class[0]]);
        if powers(&base, &exponents).is_none() {
            base.push(exponents);
            of.push(class);
        }
    }
    let twice = |dimension: &Dimension| -> Option<Vec<i64>> {
        let powers = powers(&base, &exponents(dimension))?;
        let whole = powers.into_iter().map(|p| {
            let twice = p * ratio(2, 1);
            (twice.is_integer()).then(|| twice.numer().as_i64())?
        });
        whole.collect()
    };
    let all: Option<Vec<Vec<i64>>> = arguments.iter().map(twice).collect();
    (!of.is_empty()).then_some(Units {
        value: twice(value)?,
        arguments: all?,
        of,
    })
}

fn exponents(dimension: &Dimension) -> [Rational; 3] {
    [
        dimension.mass.clone(),
        dimension.length.clone(),
        dimension.time.clone(),
    ]
}

/// The powers of independent vectors that make a target; `None` where there are none.
fn powers(base: &[[Rational; 3]], target: &[Rational; 3]) -> Option<Vec<Rational>> {
    let n = base.len();
    let mut rows: Vec<Vec<Rational>> = (0..3)
        .map(|r| {
            let row = base.iter().map(|v| v[r].clone());
            row.chain([target[r].clone()]).collect()
        })
        .collect();
    if reduce(&mut rows, n).len() < n {
        return None;
    }
    let rest = rows[n..].iter().all(|row| row[n].is_zero());
    rest.then(|| rows[..n].iter().map(|row| row[n].clone()).collect())
}

/// Names of the helpers.
pub const NAMES: [&str; 3] = ["unit_far", "unit_size", "unit_scaled"];

/// Whether an argument is beyond 1/limit … limit, half the exponent of the largest, and a number times a power of two.
pub fn helpers(language: Language) -> String {
    let [open, close] = language.dialect().remark;
    let source = match language {
        Language::Rust => RUST.to_string(),
        Language::NoStd => RUST.replace("f64::abs(", "libm::fabs("),
        Language::C => C.to_string(),
        Language::Python => PYTHON.to_string(),
        Language::NumPy => NUMPY.to_string(),
    };
    format!(
        "{open}Units of powers of two, for arguments so large or small that products would leave the range of doubles.{close}\n{source}"
    )
}

const RUST: &str = "fn unit_far(x: f64, limit: f64) -> bool {
    x != 0.0 && !(1.0 / limit..=limit).contains(&f64::abs(x))
}

fn unit_size(largest: f64) -> i32 {
    if largest == 0.0 || !largest.is_finite() {
        return 0;
    }
    let tiny = largest < f64::MIN_POSITIVE;
    let normal = if tiny { largest * 18446744073709551616.0 } else { largest };
    let exponent = (normal.to_bits() >> 52) as i32 - 1022 - if tiny { 64 } else { 0 };
    exponent.div_euclid(2)
}

fn unit_scaled(mut x: f64, mut power: i32) -> f64 {
    while power != 0 {
        let step = power.clamp(-1000, 1000);
        x *= f64::from_bits(((1023 + step) as u64) << 52);
        power -= step;
    }
    x
}

";

const C: &str = "static int unit_far(double x, double limit) {
    return x != 0.0 && !(fabs(x) >= 1.0 / limit && fabs(x) <= limit);
}

static int unit_size(double largest) {
    int exponent = 0;
    if (isfinite(largest)) frexp(largest, &exponent);
    return (exponent - (exponent < 0)) / 2;
}

static double unit_scaled(double x, int power) {
    return ldexp(x, power);
}

";

const PYTHON: &str = "def unit_far(x, limit):
    return x != 0.0 and not 1.0 / limit <= abs(x) <= limit


def unit_size(largest):
    return math.frexp(largest)[1] // 2 if math.isfinite(largest) else 0


def unit_scaled(x, power):
    try:
        return math.ldexp(x, power)
    except OverflowError:
        return math.copysign(math.inf, x)


";

const NUMPY: &str = "def unit_far(x, limit):
    return np.not_equal(x, 0.0) & ~((np.abs(x) >= 1.0 / limit) & (np.abs(x) <= limit))


def unit_size(largest):
    return np.where(np.isfinite(largest), np.frexp(largest)[1] // 2, 0)


def unit_scaled(x, power):
    return np.ldexp(x, power)


";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spin_is_a_speed_over_a_length_and_a_moment_of_inertia_needs_no_unit_of_its_own() {
        let [m, l, v] = [(1, 0, 0), (0, 1, 0), (0, 1, -1)].map(|(a, b, c)| Dimension::new(a, b, c));
        let [inertia, spin] = [(1, 2, 0), (0, 0, -1)].map(|(a, b, c)| Dimension::new(a, b, c));
        let all = [inertia, m.clone(), l.clone(), v, m, Dimension::none()];
        let found = units(&all, &spin).expect("units");
        assert_eq!(found.of, [vec![1, 4], vec![2], vec![3]]);
        assert_eq!(found.arguments[0], [2, 4, 0]);
        assert_eq!(found.arguments[5], [0, 0, 0]);
        assert_eq!(found.value, [0, -2, 2]);
        assert_eq!(units(&[l], &spin), None);
    }
}
