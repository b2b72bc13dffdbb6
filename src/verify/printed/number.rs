//! Printed numbers: the exact value, rounded to the digits that are printed, in the unit that is printed.

use num_traits::Signed;

use super::desk::Desk;
use super::{Finding, remainder};
use crate::dimension::{self, Dimension};
use crate::expr::number::to_f64;
use crate::expr::{Expr, Point, Rational, ratio};
use crate::formula::{self, Content, Quantity, Symbols, write_plain};
use crate::scene::Printed;
use crate::verify::rounding::{bounds, fraction, magnitude_or_zero, ten_to};

impl Desk<'_> {
    pub(super) fn number(
        &self,
        printed: &Printed,
        text: &str,
        of: &str,
        finding: &mut Finding,
    ) -> Result<(), String> {
        let reading = formula::read(text, &Symbols::strict()).map_err(|f| f.to_string())?;
        let target = self.read(of, printed)?;
        let of_expr = target
            .expr()
            .ok_or_else(|| format!("{of} is no single expression"))?;
        let (value, unit) = match &reading.content {
            Content::Quantity(q) => {
                if let Some(is) = self.other_dimension(of_expr, q) {
                    let place = reading.literal.as_ref();
                    let place = place.map_or_else(|| last_place(text), |l| l.place);
                    finding.holds = Some(false);
                    finding.carom = is.si();
                    finding.because = format!(
                        "{} measures {}, and {of} is {is}",
                        q.unit_text, q.unit.dimension
                    );
                    finding.caught_by = Some("dimensions".into());
                    let right = self.value(&self.put_in(of_expr, printed)?).ok();
                    finding.explained = right.and_then(|[right, _]| {
                        let off = (fraction(&q.written)? - right).abs();
                        Some(match off <= ten_to(place) * ratio(1, 2) {
                            true => format!("the number is right for {}", is.spoken()),
                            false => "the number is wrong too".into(),
                        })
                    });
                    return Ok(());
                }
                (q.written.clone(), q.unit.value())
            }
            other => (
                other
                    .expr()
                    .cloned()
                    .ok_or("the printed number is no number")?,
                Expr::one(),
            ),
        };
        // An angle in degrees is read as a multiple of π.
        let is_in = |signs: &[&str]| unit.is_one() && signs.iter().any(|sign| text.contains(sign));
        let is_percent = is_in(&["%", "percent"]);
        let (value, unit) = match is_in(&["deg", "°", "\\circ"]) {
            true => {
                let degree = Expr::pi() * Expr::ratio(1, 180);
                (value.put("pi", &Expr::from(180)), degree)
            }
            // Half a unit of the last digit is one of the percent.
            false if is_percent => (value * Expr::from(100), Expr::ratio(1, 100)),
            false => (value, unit),
        };
        // In the printed unit, which may hold π: 286 deg/s.
        let [low, high] = self.value(&(self.put_in(of_expr, printed)? * unit.powi(-1)))?;
        let written = fraction(&value).ok_or("the printed number is no fraction")?;
        let place = reading
            .literal
            .as_ref()
            .map_or_else(|| last_place(text), |l| l.place);
        let half = ten_to(place) * ratio(1, 2);
        let off = (&written - &low).abs().max((&written - &high).abs());
        let digits = (magnitude_or_zero(&low) - place + 2).max(3) as u32;
        finding.carom = crate::interval::enclosure::decimal(&low, digits);
        if is_percent {
            finding.carom.push_str(" %");
        }
        if off <= half {
            finding.holds = Some(true);
            finding.because = "the exact value, rounded to the printed digits".into();
            return Ok(());
        }
        finding.holds = Some(false);
        finding.because = format!(
            "the exact value is {}, not within half a unit of the last printed digit",
            finding.carom
        );
        finding.caught_by = Some("putting the numbers into the printed formula".into());
        let unit = unit.evaluate(&Point::<f64>::default());
        let unit = unit.ok_or("the unit has no size")?;
        finding.explained = slip_of_digits(&written, &low, place).or_else(|| {
            let [wanted, room] = [&written, &half].map(|v| to_f64(v) * unit);
            self.slips(of_expr, wanted, room * 1.000_001)
                .or_else(|| remainder::digits(&written, &low, place))
        });
        Ok(())
    }

    /// The dimension of an answer, where a printed quantity has another one.
    pub(super) fn other_dimension(&self, of: &Expr, printed: &Quantity) -> Option<Dimension> {
        let known = |name: &str| self.dimensions.get(name).cloned();
        let is = dimension::of(of, &known).ok()??;
        (is != printed.unit.dimension).then_some(is)
    }

    /// Bounds of an expression at the scene's values.
    pub(super) fn value(&self, e: &Expr) -> Result<[Rational; 2], String> {
        let put_in = e.substitute(&self.scene.values());
        if let Some(name) = put_in.symbols().into_iter().next() {
            return Err(format!("the scene gives {name} no value"));
        }
        bounds(&put_in).ok_or_else(|| format!("{} has no value", write_plain(e)))
    }
}

/// How a number was miscopied from the right one: its last digit, its sign, or a power of ten.
fn slip_of_digits(written: &Rational, right: &Rational, place: i32) -> Option<String> {
    let half = ten_to(place) * ratio(1, 2);
    if (written - right).abs() < ten_to(place) {
        return Some("the last digit was cut off or rounded the wrong way".into());
    }
    if (written + right).abs() <= half {
        return Some("the sign is wrong".into());
    }
    let power = (-6..=6).filter(|k| *k != 0).find(|k| {
        let off = (written / ten_to(*k) - right).abs();
        off <= &half / ten_to(*k)
    })?;
    let size = to_f64(&ten_to(power.abs()));
    let way = if power > 0 { "large" } else { "small" };
    Some(format!(
        "it is {size} times too {way}: a power of ten, or the unit"
    ))
}

/// The number at the head of a text such as `-2.08 m/s`, in the unit written.
pub(super) fn number_of(text: &str) -> Option<Rational> {
    let reading = formula::read(text, &Symbols::strict()).ok()?;
    match &reading.content {
        Content::Quantity(q) => crate::verify::rounding::fraction(&q.value),
        other => crate::verify::rounding::fraction(other.expr()?),
    }
}

/// The power of ten of the last digit of the number at the head of a text.
pub(super) fn last_place(text: &str) -> i32 {
    let digits: String = text
        .trim_start_matches(['-', '+', '−', ' '])
        .chars()
        .take_while(|c| c.is_ascii_digit() || *c == '.')
        .collect();
    let after = digits.split_once('.').map_or(0, |(_, d)| d.len());
    -(after as i32)
}

/// The components of a vector in numbers, each with the unit behind all: `[-1.84, 3.12] N s`.
pub(super) fn numbers(text: &str) -> Option<[String; 2]> {
    let (inside, unit) = text
        .trim()
        .strip_prefix(['[', '('])?
        .split_once([']', ')'])?;
    let (x, y) = inside.split_once(',')?;
    let number = |part: &str| {
        let text = format!("{} {}", part.trim(), unit.trim());
        let read = formula::read(&text, &Symbols::strict()).ok()?;
        read.literal.map(|_| text)
    };
    Some([number(x)?, number(y)?])
}

/// The decimal number in its unit that is printed by itself, or as the bound of something: rounded, like every decimal.
pub(super) fn decimal_in(text: &str) -> Option<&str> {
    let mut sides = text.split(['<', '>', '=', '≤', '≥']).map(str::trim);
    sides.find(|side| {
        side.contains('.')
            && formula::read(side, &Symbols::strict()).is_ok_and(|r| r.literal.is_some())
    })
}
