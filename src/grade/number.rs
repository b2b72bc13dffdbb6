//! Numbers that need not be exact: tolerances, rounding, significant digits.
//!
//! Every comparison is made in exact fractions or certified enclosures, so the edge of a tolerance is the same everywhere.

use num_traits::{Signed, Zero};

use crate::dimension;
use crate::expr::{Expr, Node, Rational, ratio};
use crate::formula::{Content, Quantity};

pub use crate::verify::rounding::{bounds, half_unit, ten_to};

/// How far a number may be from the expected one.
#[derive(Clone, PartialEq, Debug)]
pub enum Tolerance {
    /// At most this share of the expected value: 1/50 for 2 %.
    Relative(Rational),
    /// At most this much, in the unit of the expected value.
    Absolute(Rational),
    /// At most this much, in a unit of its own that has to fit the expected value.
    Measured(Box<Quantity>),
    /// Equal when rounded to this many significant digits, up to half a unit of the last one.
    Significant(u32),
}

impl Tolerance {
    /// Largest allowed distance from an expected value.
    pub fn width(&self, expected: &Rational) -> Rational {
        match self {
            Tolerance::Relative(share) => expected.abs() * share,
            Tolerance::Absolute(width) => width.clone(),
            Tolerance::Measured(width) => bounds(&width.value).map_or(ratio(0, 1), |[low, _]| low),
            Tolerance::Significant(digits) => half_unit(expected, *digits),
        }
    }

    /// In words, such as `within 2 %`.
    pub fn words(&self) -> String {
        match self {
            Tolerance::Relative(share) => {
                let percent = share * ratio(100, 1);
                let shown = if percent.is_integer() {
                    percent.to_string()
                } else {
                    format!("{}", crate::expr::number::to_f64(&percent))
                };
                format!("within {shown} % of the expected value")
            }
            Tolerance::Absolute(width) => format!(
                "within {} of the expected value",
                crate::expr::number::to_f64(width)
            ),
            Tolerance::Measured(width) => format!(
                "within {} {} of the expected value",
                shown(&width.written),
                width.unit_text
            ),
            Tolerance::Significant(digits) => format!("equal to {digits} significant digits"),
        }
    }

    /// Reads `2%`, `0.02` (relative) and `0.1 m` (absolute, with its unit); `None` for anything else.
    pub fn read(text: &str) -> Option<Tolerance> {
        let text = text.trim();
        let width = match content(text) {
            Some(Content::Quantity(width)) => Some(width),
            // `1°` is read as a multiple of π.
            Some(Content::Scalar(e)) if super::fraction(&e).is_none() => {
                let degree = dimension::unit("deg").ok()?;
                let written = &e / &degree.value();
                Some(Box::new(Quantity::of(written, degree, "°")))
            }
            _ => None,
        };
        if let Some(width) = width {
            let is_size = bounds(&width.value)?.iter().all(|end| !end.is_negative());
            return is_size.then_some(Tolerance::Measured(width));
        }
        let (number, percent) = match text.strip_suffix('%') {
            Some(number) => (number.trim(), true),
            None => (text, false),
        };
        let value = decimal(number)?;
        let share = if percent {
            value / ratio(100, 1)
        } else {
            value
        };
        (!share.is_negative()).then_some(Tolerance::Relative(share))
    }
}

/// An exact decimal number such as `0.02` or `1e-3`.
pub fn decimal(text: &str) -> Option<Rational> {
    match content(text)? {
        Content::Scalar(e) => super::fraction(&e),
        _ => None,
    }
}

/// What a short text without symbols says.
fn content(text: &str) -> Option<Content> {
    let symbols = crate::formula::Symbols::strict();
    let reading = (text.len() <= 60).then(|| crate::formula::read(text, &symbols).ok());
    Some(reading??.content)
}

/// An expression in plain notation; a number that is a decimal fraction of more than one digit as a decimal.
pub fn shown(e: &Expr) -> String {
    let plain = crate::formula::write_plain(e);
    let Some(value) = e.as_number().filter(|v| !v.is_integer()) else {
        return plain;
    };
    // 3/2 and 3/10 read well as they are; 1389/50 does not.
    let tens = (2..=20).find(|k| (value * ten_to(*k)).is_integer());
    match tens {
        Some(k) if value.denom().bits() > 4 => {
            let scaled = (value * ten_to(k)).abs();
            let digits = scaled.numer().to_string();
            let padded = format!("{digits:0>width$}", width = k as usize + 1);
            let (whole, part) = padded.split_at(padded.len() - k as usize);
            let sign = if value.is_negative() { "-" } else { "" };
            format!("{sign}{whole}.{part}")
        }
        _ => plain,
    }
}

/// Whether a constant lies within a tolerance of another; `None` where that hangs on digits beyond the precision used.
pub fn within(answer: &Expr, expected: &Expr, tolerance: &Tolerance) -> Option<bool> {
    let ([a, b], [low, high]) = (bounds(answer)?, bounds(expected)?);
    let width = tolerance.width(&low);
    let (least, most) = (
        least_distance([&a, &b], [&low, &high]),
        most_distance([&a, &b], [&low, &high]),
    );
    if most <= width {
        Some(true)
    } else if least > width {
        Some(false)
    } else {
        None
    }
}

/// An answer with the expected number wherever its own stands alone in the same place and lies within a tolerance: a side, a
/// term, or the factor of a term.
pub(super) fn aligned(
    expected: &Content,
    answer: &Content,
    tolerance: &Tolerance,
) -> Option<Content> {
    let near = |a: &Expr, e: &Expr| within(a, e, tolerance) == Some(true);
    let factor = |term: &Expr, terms: &[Expr]| {
        let (k, rest) = term.split_number();
        let mut same = terms.iter().filter(|e| e.split_number().1 == rest);
        let same = same.find(|e| near(&Expr::from(k.clone()), &Expr::from(e.split_number().0)));
        same.unwrap_or(term).clone()
    };
    let relative = !matches!(tolerance, Tolerance::Absolute(_) | Tolerance::Measured(_));
    match (expected, answer) {
        (Content::Quantity(e), Content::Quantity(a)) if relative => {
            let same = e.unit.dimension == a.unit.dimension && near(&a.value, &e.value);
            Some(if same { expected } else { answer }.clone())
        }
        (Content::Scalar(e), Content::Scalar(a)) if relative => {
            let parts = |x: &Expr| match x.node() {
                Node::Sum(terms) => terms.clone(),
                _ => vec![x.clone()],
            };
            let terms = parts(e);
            let own = parts(a);
            Some(Content::Scalar(Expr::sum(
                own.iter()
                    .map(|term| factor(term, &terms))
                    .collect::<Vec<_>>(),
            )))
        }
        (Content::Relations(sides, signs), Content::Relations(own, its))
            if signs == its && sides.len() == own.len() =>
        {
            let pairs = sides.iter().zip(own);
            let sides: Option<Vec<Content>> =
                pairs.map(|(e, a)| aligned(e, a, tolerance)).collect();
            Some(Content::Relations(sides?, its.clone()))
        }
        _ => None,
    }
}

/// Whether a number is the rounding of another to the digits written, or has these digits cut off; `share` is the quotient of
/// the two.
pub(super) fn rounds(rounded: &Rational, share: &Expr) -> bool {
    let Some(shares) = bounds(share) else {
        return false;
    };
    if share.is_one() || shares.iter().any(|share| !share.is_positive()) {
        return share.is_one();
    }
    let size = rounded.abs();
    let Some(places) = (0..=20).find(|k| (&size * ten_to(*k)).is_integer()) else {
        return false;
    };
    let mut unit = ten_to(-places);
    // Zeros at the end of 1500 need not be digits.
    let whole = |unit: &Rational| (&size / (unit * ratio(10, 1))).is_integer();
    let zeros = whole(&unit);
    while whole(&unit) && !size.is_zero() {
        unit *= ratio(10, 1);
    }
    let half = &unit * ratio(1, 2);
    shares.iter().all(|share| {
        let exact = &size / share;
        let off = &exact - &size;
        let near = off.abs() <= &exact * ratio(1, 20);
        let digit = off.abs() <= &exact * ratio(1, 5);
        let cut = near && !off.is_negative() && off < unit;
        off.abs() <= half && (near || digit && !zeros) || cut
    })
}

fn most_distance([a, b]: [&Rational; 2], [low, high]: [&Rational; 2]) -> Rational {
    (b - low).abs().max((a - high).abs())
}

fn least_distance([a, b]: [&Rational; 2], [low, high]: [&Rational; 2]) -> Rational {
    if b < low {
        low - b
    } else if a > high {
        a - high
    } else {
        Rational::zero()
    }
}

/// Whether a number has no more than some significant digits: 12 and 120 have two, 12.4 has three.
pub fn has_digits(value: &Rational, digits: u32) -> bool {
    value.is_zero() || (half_unit(value, digits).recip() * value / ratio(2, 1)).is_integer()
}

/// Most digits to which numbers are compared.
pub const MOST_DIGITS: u32 = 40;

/// To how many significant digits a decimal number is the rounding of an exact one; 0 where it is not even close.
pub fn digits_shared(answer: &Rational, exact: &[Rational; 2]) -> u32 {
    if exact[0].is_zero() {
        return 0;
    }
    let middle = (&exact[0] + &exact[1]) * ratio(1, 2);
    let off = (answer - &middle).abs();
    if off.is_zero() {
        return 100;
    }
    // Bounds on both sides of 1 are those of 1, and not of 0.999….
    let [low, high] = exact.each_ref().map(Signed::abs);
    let size = low.max(high);
    (1..=MOST_DIGITS)
        .rev()
        .find(|n| off <= half_unit(&size, *n))
        .unwrap_or(0)
}
