//! Printed numbers: the exact value, rounded to the digits that are printed, in the unit that is printed.

use num_traits::{Signed, Zero};

use super::desk::Desk;
use super::{Finding, remainder};
use crate::dimension::{self, Dimension, Unit};
use crate::expr::number::to_f64;
use crate::expr::{Expr, Point, Rational, ratio};
use crate::formula::{self, Content, Literal, Quantity, Symbols, Written, write_plain};
use crate::scene::{Print, Printed};
use crate::verify::rounding::{bounds, fraction, magnitude_or_zero, ten_to};

/// A number as it is printed.
#[derive(Clone)]
pub(super) struct Figure {
    /// The number in its unit.
    written: Expr,
    /// What the unit is worth.
    unit: Expr,
    /// The power of ten of its last digit.
    place: i32,
    /// Whether it is digits and a sign alone, apart from what stands behind them.
    pub(super) is_literal: bool,
    /// Whether a degree or percent sign stands behind it.
    pub(super) is_marked: bool,
    is_percent: bool,
    /// The same with its unit, where it has one.
    pub(super) quantity: Option<Quantity>,
}

impl Figure {
    /// Reads a number with what stands behind it.
    pub(super) fn read(text: &str) -> Result<Figure, String> {
        let reading = formula::read(text, &Symbols::strict()).map_err(|f| f.to_string())?;
        let marked = reading.written.last().and_then(Written::marked);
        let is_marked = marked.is_some();
        let literal = reading.literal.or(marked);
        let quantity = match reading.content {
            Content::Quantity(q) => Err(*q),
            other => Ok(other.expr().cloned()),
        };
        let (value, unit, quantity) = match quantity {
            Err(q) => (q.written.clone(), q.unit.value(), Some(q)),
            Ok(Some(value)) => (value, Expr::one(), None),
            Ok(None) => return Err("the printed number is no number".into()),
        };
        // An angle in degrees is read as a multiple of π.
        let is_in = |signs: &[&str]| unit.is_one() && signs.iter().any(|sign| text.contains(sign));
        let is_percent = is_in(&["%", "percent"]);
        let (written, unit) = match is_in(&["deg", "°", "\\circ"]) {
            true => {
                let degree = Expr::pi() * Expr::ratio(1, 180);
                (value.put("pi", &Expr::from(180)), degree)
            }
            // Half a unit of the last digit is one of the percent.
            false if is_percent => (value * Expr::from(100), Expr::ratio(1, 100)),
            false => (value, unit),
        };
        let place = literal.as_ref().map(|l| l.place);
        Ok(Figure {
            written,
            unit,
            place: place.unwrap_or_else(|| last_place(text)),
            is_literal: literal.is_some(),
            is_marked,
            is_percent,
            quantity,
        })
    }
}

impl Figure {
    /// Whether nothing behind it says what it counts.
    fn is_bare(&self) -> bool {
        self.quantity.is_none() && !self.is_marked && !self.is_percent && self.unit.is_one()
    }
}

impl Desk<'_> {
    pub(super) fn number(
        &self,
        printed: &Printed,
        text: &str,
        of: &str,
        finding: &mut Finding,
    ) -> Result<(), String> {
        if self.vectors.contains_key(of) {
            return self.answer(printed, of, text, finding);
        }
        let figure = Figure::read(text)?;
        let target = self.read(of, printed)?;
        let value = target.expr();
        let value = value.ok_or_else(|| format!("{of} is no single expression"))?;
        self.rounded(printed, &figure, of, value, finding)?;
        match (&printed.what, finding.holds) {
            (
                Print::Number {
                    from: Some(from), ..
                },
                Some(true),
            ) => self.led_to(printed, from, (of, value), finding),
            _ => Ok(()),
        }
    }

    /// Whether the formula that a right number is said to come from gives what the number is of, and not by chance at the values
    /// of the scene; one with numbers put in gives no more than these.
    fn led_to(
        &self,
        printed: &Printed,
        from: &str,
        (of, value): (&str, &Expr),
        finding: &mut Finding,
    ) -> Result<(), String> {
        let read = self
            .read(from, printed)
            .inspect_err(|_| finding.holds = None)?;
        let Some(formula) = read.expr().filter(|_| !from.contains('.')) else {
            return Ok(());
        };
        let right = self.put_in(&self.by_answer(value), printed)?;
        let pair = (right, self.put_in(formula, printed)?);
        let mut found = Finding::default();
        self.identities(std::slice::from_ref(&pair), printed, &mut found);
        if found.holds == Some(false) {
            let because = format!(
                "the number is right, and {from} is not {of}: {}",
                found.because
            );
            finding.holds = Some(false);
            finding.because = because;
            finding.carom = self.tidy(&pair.0);
            self.caught(std::slice::from_ref(&pair), printed, finding);
            finding.explained = self
                .factor(std::slice::from_ref(&pair))
                .or_else(|| self.exchanged(std::slice::from_ref(&pair)))
                .or_else(|| self.slip(std::slice::from_ref(&pair)));
        }
        Ok(())
    }

    /// Whether a number is a value, which `of` names, rounded to the printed digits.
    pub(super) fn rounded(
        &self,
        printed: &Printed,
        figure: &Figure,
        of: &str,
        value: &Expr,
        finding: &mut Finding,
    ) -> Result<(), String> {
        let (asked, value) = (value, &self.by_answer(value));
        let forces = figure.quantity.as_ref();
        let forces = forces.and_then(|q| in_pounds_of_force(q, &self.other_dimension(value, q)?));
        if let Some(quantity) = forces {
            let figure = Figure {
                unit: quantity.unit.value(),
                quantity: Some(quantity),
                ..figure.clone()
            };
            self.rounded(printed, &figure, of, asked, finding)?;
            finding.because.push_str(", lb read as lbf");
            return Ok(());
        }
        // A number without a unit counts in that of the scene's data.
        let bare = (self.dimension(value)).filter(|d| figure.is_bare() && !d.is_none());
        let bare = bare.map(|dimension| self.scene.system().counted_in(&dimension));
        let own = bare.as_ref().map(|(unit, _)| unit.value());
        let (place, unit) = (figure.place, own.as_ref().unwrap_or(&figure.unit));
        let half = ten_to(place) * ratio(1, 2);
        if let Some(q) = &figure.quantity
            && let Some(is) = self.other_dimension(value, q)
        {
            finding.holds = Some(false);
            finding.carom = is.si();
            finding.because = format!(
                "{} measures {}, and {of} is {is}",
                q.unit_text, q.unit.dimension
            );
            finding.caught_by = Some("dimensions".into());
            let right = self.value(&self.put_in(value, printed)?).ok();
            finding.explained = right.and_then(|[right, _]| {
                let off = (fraction(&q.written)? - right).abs();
                Some(match off <= half {
                    true => format!("the number is right for {}", is.spoken()),
                    false => "the number is wrong too".into(),
                })
            });
            return Ok(());
        }
        // In the printed unit, which may hold π: 286 deg/s.
        let [low, high] = self.value(&(self.put_in(value, printed)? * unit.powi(-1)))?;
        let written = fraction(&figure.written).ok_or("the printed number is no fraction")?;
        // Of an exact half either rounding is right.
        let off = (&written - &low).abs().min((&written - &high).abs());
        let digits = (magnitude_or_zero(&low) - place + 2).max(3) as u32;
        finding.carom = crate::interval::enclosure::decimal(&low, digits);
        match &bare {
            _ if figure.is_percent => finding.carom.push_str(" %"),
            Some((unit, text)) if !unit.value().is_one() => {
                finding.carom.push_str(&format!(" {text}"));
            }
            _ => {}
        }
        if off <= half {
            finding.holds = Some(true);
            finding.because = "the exact value, rounded to the printed digits".into();
            if let Some((_, text)) = bare {
                finding.because = format!("{} in {text}, which is not printed", finding.because);
            }
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
        let in_si = bare.as_ref().filter(|(counted, _)| {
            let off = fraction(&counted.value()).map(|worth| (&low * worth - &written).abs());
            off.is_some_and(|off| off <= half)
        });
        let in_si =
            in_si.map(|(unit, _)| format!("the number is right for {}", unit.dimension.si()));
        let is_angle = figure.quantity.as_ref().is_some_and(|q| q.unit.angle);
        let explained = in_si
            .or_else(|| slip_of_digits(&written, &low, place))
            .or_else(|| {
                let [written, right, half] = [&written, &low, &half].map(to_f64);
                is_angle.then(|| turned(written, right * unit, half))?
            });
        finding.explained = explained.or_else(|| {
            let [wanted, room] = [&written, &half].map(|v| to_f64(v) * unit);
            self.slips(printed, asked, wanted, room * 1.000_001)
                .or_else(|| remainder::digits(&written, &low, place))
        });
        Ok(())
    }

    /// The dimension of a value, where it is known.
    pub(super) fn dimension(&self, of: &Expr) -> Option<Dimension> {
        let known = |name: &str| self.dimensions.get(name).cloned();
        dimension::of(of, &known).ok()?
    }

    /// The same, where a printed quantity has another one.
    pub(super) fn other_dimension(&self, of: &Expr, printed: &Quantity) -> Option<Dimension> {
        let is = self.dimension(of)?;
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

/// A quantity whose pounds are forces, as in many books, where it has the dimension then that it should have.
fn in_pounds_of_force(q: &Quantity, is: &Dimension) -> Option<Quantity> {
    let mut text = String::new();
    for piece in q.unit_text.split_inclusive(|c: char| !c.is_alphabetic()) {
        let word = piece.trim_end_matches(|c: char| !c.is_alphabetic());
        let force = if ["lb", "lbs"].contains(&word) {
            "lbf"
        } else {
            word
        };
        text.extend([force, &piece[word.len()..]]);
    }
    let unit = dimension::unit(&text).ok()?;
    (unit.dimension == *is).then(|| Quantity::of(q.written.clone(), unit, &text))
}

/// How a number was miscopied from the right one: its last digit, its sign, or a power of ten.
pub(super) fn slip_of_digits(written: &Rational, right: &Rational, place: i32) -> Option<String> {
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

/// An angle or a rate that is printed in one unit and counts in another.
fn turned(written: f64, radians: f64, half: f64) -> Option<String> {
    use std::f64::consts::{PI, TAU};
    let units = [
        ("radians", 1.0),
        ("degrees", PI / 180.0),
        ("turns", TAU),
        ("turns in a minute", TAU / 60.0),
    ];
    // One of two digits fits something too easily.
    let is_long = half <= written.abs() / 200.0;
    let fits = |(_, worth): &(&str, f64)| (written - radians / worth).abs() <= half;
    let (said, _) = units.into_iter().find(fits).filter(|_| is_long)?;
    Some(format!("the number counts in {said}"))
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

/// The components of a vector in numbers with the unit behind all: `[-1.84, 3.12] N s`, `6.4\,\hat{i} + 1.2\,\hat{j}`.
pub(super) fn components(text: &str) -> Option<[Figure; 2]> {
    let reading = formula::read(text, &Symbols::strict()).ok()?;
    let Content::Vector([x, y, z]) = reading.content.answer() else {
        return None;
    };
    let literals = literals(reading.written.last()?);
    let is_rounded = reading.unit.is_some() || literals.iter().any(|l| l.decimal);
    if !z.is_zero() || !is_rounded {
        return None;
    }
    let worth = reading.unit.as_ref().map_or_else(Expr::one, Unit::value);
    let figure = |c: &Expr| {
        let written = fraction(&(c * worth.powi(-1)))?;
        let digits = literals.iter().find(|l| l.value.abs() == written.abs());
        let place = match digits {
            Some(digits) => digits.place,
            // One that is left out is zero as far as the other goes.
            None if written.is_zero() => literals.first()?.place,
            None => return None,
        };
        let quantity = reading.unit.as_ref().map(|unit| {
            let text = unit.dimension.si();
            Quantity::of(written.clone().into(), unit.clone(), &text)
        });
        Some(Figure {
            written: written.into(),
            unit: worth.clone(),
            place,
            is_literal: true,
            is_marked: false,
            is_percent: false,
            quantity,
        })
    };
    Some([figure(x)?, figure(y)?])
}

/// The numbers that a formula is written with.
fn literals(written: &Written) -> Vec<Literal> {
    match written.literal() {
        Some(one) => vec![one],
        None => written.pieces().into_iter().flat_map(literals).collect(),
    }
}
