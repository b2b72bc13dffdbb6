//! Printed formulas with a decimal in them, `1.05 sqrt(g a)`: held where that is the exact coefficient, rounded to its digits.

use num_traits::Signed;

use super::Finding;
use super::desk::Desk;
use super::number::{number_of, slip_of_digits};
use crate::algebra;
use crate::expr::{Expr, Symbol, ratio};
use crate::formula::{self, Content};
use crate::interval::enclosure::decimal;
use crate::scene::Printed;
use crate::verify::rounding::{bounds, magnitude_or_zero, ten_to};

/// What stands for the decimal; no scene has such a name.
const COEFFICIENT: &str = "roundedcoefficient";
/// Digits of an exact coefficient beyond those that are printed.
const MORE: i32 = 2;

/// The only decimal of a text.
fn only_decimal(text: &str) -> Option<&str> {
    let is_part = |c: char| c.is_ascii_digit() || c == '.';
    let mut all = text.split(|c| !is_part(c)).filter(|word| {
        let whole = word.split_once('.');
        whole.is_some_and(|(a, b)| {
            ![a, b]
                .iter()
                .any(|part| part.is_empty() || part.contains('.'))
        })
    });
    let (first, others) = (all.next()?, all.count());
    (others == 0 && text.matches(first).count() == 1).then_some(first)
}

impl Desk<'_> {
    /// Whether a formula that is not the derived one is that one with its coefficient rounded to the printed digits; nothing is
    /// said where it differs by more than a number.
    pub(super) fn coefficient(
        &self,
        printed: &Printed,
        item: &Symbol,
        (text, pair): (&str, &(Expr, Expr)),
        finding: &mut Finding,
    ) {
        let Some((exact, digits)) = self.exact(printed, item, (text, &pair.0)) else {
            return;
        };
        let Some(([low, high], written)) = bounds(&exact).zip(number_of(digits)) else {
            return;
        };
        let place = -(digits.split_once('.').map_or(0, |(_, behind)| behind.len()) as i32);
        let off = (&written - &low).abs().max((&written - &high).abs());
        let shown = decimal(&low, (magnitude_or_zero(&low) - place + MORE).max(3) as u32);
        let is_rounded = off <= ten_to(place) * ratio(1, 2);
        finding.holds = Some(is_rounded);
        finding.because = match is_rounded {
            true => format!("the exact coefficient, {shown}, rounded to the printed digits"),
            false => format!(
                "the exact coefficient is {shown}, not within half a unit of the last printed digit of {digits}"
            ),
        };
        if !is_rounded {
            finding.explained = slip_of_digits(&written, &low, place);
            self.caught(std::slice::from_ref(pair), printed, finding);
        }
    }

    /// The number with which a formula is the derived one in place of its decimal, and that decimal.
    fn exact<'t>(
        &self,
        printed: &Printed,
        item: &Symbol,
        (text, closed): (&'t str, &Expr),
    ) -> Option<(Expr, &'t str)> {
        let digits = only_decimal(text)?;
        let mut symbols = self.symbols(printed);
        symbols.declare(COEFFICIENT);
        let text = text.replacen(digits, &format!("({COEFFICIENT})"), 1);
        let content: Content = formula::read(&text, &symbols).ok()?.content;
        let value = match self.bound(item, &content) {
            Some((_, value, _)) => value,
            None => content.answer().expr()?.clone(),
        };
        let value = self.put_in(&value, printed).ok()?;
        let coefficient = Symbol::from(COEFFICIENT);
        let slope = value.derivative(&coefficient);
        if slope.mentions(&coefficient) || slope.is_zero() {
            return None;
        }
        let rest = value.put(&coefficient, &Expr::zero());
        let exact = algebra::quotient(&(closed - &rest), &slope, &self.scene.domains).ok()?;
        (exact.is_constant()).then_some((exact, digits))
    }
}
