//! Units inside a formula of numbers: `2 m + 30 cm`, `(3 m/s, 4 m/s)`, `(2 kg)(3 m/s)`.
//!
//! In: a written side. Out: the dimension of its value in SI units, where a unit stands inside, or where two pieces do not
//! fit together. Symbols carry their units themselves and do not go together with units here.

use super::fault::Faulty;
use super::written::{Link, Shape, Written, is_axis};
use crate::dimension::Dimension;
use crate::expr::{Rational, ratio};

/// The dimension of a side with units inside.
pub(super) fn dimension(w: &Written) -> Faulty<Dimension> {
    let none = Dimension::none();
    match &w.shape {
        Shape::Number(_) => Ok(none),
        Shape::Symbol(name) if &**name == "pi" || is_axis(name) => Ok(none),
        Shape::Symbol(name) => {
            let message = format!("the symbol {name} stands beside units");
            Err(w
                .fault(message)
                .hint("leave the units away, or the symbols"))
        }
        Shape::Measured(inner, unit) => Ok(dimension(inner)?.times(&unit.dimension)),
        Shape::Sum(terms) => alike(terms.iter().map(|(_, term)| term)),
        Shape::List(parts) => alike(parts.iter()),
        Shape::Product(factors) => {
            let mut total = none;
            for (i, (link, factor)) in factors.iter().enumerate() {
                let factor = dimension(factor)?;
                total = match link {
                    Link::Over if i > 0 => total.over(&factor),
                    _ => total.times(&factor),
                };
            }
            Ok(total)
        }
        Shape::Fraction(above, below) => Ok(dimension(above)?.over(&dimension(below)?)),
        Shape::Power(base, exponent) => {
            let base = dimension(base)?;
            let number = number(exponent);
            match number {
                Some(k) => Ok(base.power(&k)),
                None if base.is_none() => Ok(base),
                None => Err(exponent.fault("a quantity with a unit has a number for its exponent")),
            }
        }
        Shape::Root(index, inner) => {
            let index = index.as_ref().map_or(Some(ratio(2, 1)), |i| number(i));
            Ok(dimension(inner)?.power(&index.map_or(ratio(1, 2), |k| k.recip())))
        }
        Shape::Abs(matrix) if matrix.is_matrix() => {
            Err(matrix.fault("a determinant of quantities with units is not read"))
        }
        Shape::Bracket(inner) | Shape::Abs(inner) => dimension(inner),
        Shape::Call(_, inner) | Shape::Reciprocal(_, inner) | Shape::Degrees(inner) => {
            match dimension(inner)?.is_none() {
                true => Ok(none),
                false => Err(inner.fault("the argument of a function has a unit")),
            }
        }
    }
}

/// The dimension of pieces that are added, or stand side by side as components.
fn alike<'a>(mut pieces: impl Iterator<Item = &'a Written>) -> Faulty<Dimension> {
    let mut first: Option<Dimension> = None;
    pieces.try_for_each(|piece| {
        let dimension = dimension(piece)?;
        match &first {
            // Zero needs no unit.
            _ if number(piece).is_some_and(|v| v == ratio(0, 1)) => {}
            None => first = Some(dimension),
            Some(known) if *known == dimension => {}
            Some(known) => {
                let name = |d: &Dimension| match d.is_none() {
                    true => "a number without unit".to_string(),
                    false => d.si(),
                };
                let message = format!(
                    "{} and {} do not go together",
                    name(known),
                    name(&dimension)
                );
                return Err(piece.fault(message));
            }
        }
        Ok(())
    })?;
    Ok(first.unwrap_or_else(Dimension::none))
}

/// The value of an exponent or index: a number, or a fraction of two.
fn number(w: &Written) -> Option<Rational> {
    let over = |a: &Written, b: &Written| {
        let below = number(b).filter(|below| *below != ratio(0, 1))?;
        Some(number(a)? / below)
    };
    match &w.shape {
        Shape::Fraction(a, b) => over(a, b),
        Shape::Bracket(inner) => number(inner),
        Shape::Product(factors) => match factors.as_slice() {
            [(_, a), (Link::Over, b)] => over(a, b),
            _ => None,
        },
        _ => w.literal().map(|l| l.value),
    }
}
