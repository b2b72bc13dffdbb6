//! Physical dimensions: arithmetic, spelling, units ([`unit()`]), and the dimension of an expression ([`of`]).
//!
//! Knows mass, length and time, which is all that mechanics of collisions needs, and current, temperature and amount for the
//! units of answers from elsewhere; a plane angle has no dimension. Does not know how formulas are written: messages take a writer
//! from the caller.

mod infer;
mod unit;

use std::fmt;

use num_traits::{One, Signed, Zero};

use crate::expr::Rational;

pub use infer::{Clash, of};
pub use unit::{Unit, UnitFault, unit};

/// A product of powers of mass, length, time, current, temperature and amount. A plane angle has no dimension.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Dimension {
    /// Exponent of mass.
    pub mass: Rational,
    /// Exponent of length.
    pub length: Rational,
    /// Exponent of time.
    pub time: Rational,
    /// Exponent of electric current.
    pub current: Rational,
    /// Exponent of temperature.
    pub temperature: Rational,
    /// Exponent of amount of substance.
    pub amount: Rational,
}

/// How many base units there are.
const BASES: usize = 6;
const NAMES: [&str; BASES] = ["mass", "length", "time", "current", "temperature", "amount"];

/// A system of units in which numbers are told.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum System {
    /// Metres, kilograms, seconds.
    Si,
    /// Feet, pounds of force, seconds.
    FootPound,
}

impl System {
    /// The system of units as people wrote them: feet and pounds where such stand, and no metres and kilograms.
    pub fn of<'a>(written: impl Iterator<Item = &'a str>) -> System {
        const FEET: [&str; 13] = [
            "ft", "foot", "feet", "in", "inch", "inches", "lb", "lbs", "lbf", "slug", "slugs",
            "oz", "mph",
        ];
        const NEITHER: [&str; 10] = [
            "s", "ms", "min", "h", "rad", "deg", "rev", "rpm", "Hz", "mi",
        ];
        let words = written.flat_map(|unit| unit.split(|c: char| !c.is_alphabetic()));
        let mut words = words
            .filter(|w| !w.is_empty() && !NEITHER.contains(w))
            .peekable();
        match words.peek().is_some() && words.all(|w| FEET.contains(&w)) {
            true => System::FootPound,
            false => System::Si,
        }
    }

    /// The unit of a dimension as a person says it.
    pub fn unit(self, dimension: &Dimension) -> String {
        match (self, dimension.spoken()) {
            (System::FootPound, spoken) if spoken != "rad/s" && spoken != "1" => {
                dimension.in_feet_and_pounds()
            }
            (_, spoken) => spoken,
        }
    }

    /// The unit in which a number of a dimension counts that has none, and how it is written.
    pub fn counted_in(self, dimension: &Dimension) -> (Unit, String) {
        let text = self.unit(dimension);
        match (self, unit(&text)) {
            (System::FootPound, Ok(unit)) => (unit, text),
            _ => (Unit::coherent(dimension.clone()), dimension.si()),
        }
    }

    /// How many SI units one of its unit of a dimension is.
    pub fn scale(self, dimension: &Dimension) -> f64 {
        let unit = match self {
            System::Si => return 1.0,
            System::FootPound => unit(&self.unit(dimension)),
        };
        unit.map_or(1.0, |unit| crate::expr::number::to_f64(&unit.factor))
    }
}

impl Dimension {
    /// The dimension mass^`mass` · length^`length` · time^`time`.
    pub fn new(mass: i64, length: i64, time: i64) -> Dimension {
        Dimension::of([mass, length, time, 0, 0, 0].map(|k| crate::expr::ratio(k, 1)))
    }

    /// The dimension with these exponents of what [`NAMES`] says.
    fn of([mass, length, time, current, temperature, amount]: [Rational; BASES]) -> Dimension {
        Dimension {
            mass,
            length,
            time,
            current,
            temperature,
            amount,
        }
    }

    /// No dimension: a number or an angle.
    pub fn none() -> Dimension {
        Dimension::default()
    }

    /// Whether all exponents are zero.
    pub fn is_none(&self) -> bool {
        self.exponents().iter().all(|k| k.is_zero())
    }

    fn exponents(&self) -> [&Rational; BASES] {
        let [mass, length, time] = [&self.mass, &self.length, &self.time];
        let others = [&self.current, &self.temperature, &self.amount];
        let [current, temperature, amount] = others;
        [mass, length, time, current, temperature, amount]
    }

    /// What it is made of, with the exponents that are not zero.
    pub(crate) fn powers(&self) -> impl Iterator<Item = (&'static str, &Rational)> {
        let all = NAMES.into_iter().zip(self.exponents());
        all.filter(|(_, k)| !k.is_zero())
    }

    /// Dimension of a product.
    pub fn times(&self, other: &Dimension) -> Dimension {
        let added = |a: &Rational, b: &Rational| match (a.is_zero(), b.is_zero()) {
            (_, true) => a.clone(),
            (true, _) => b.clone(),
            _ => a + b,
        };
        let (mine, theirs) = (self.exponents(), other.exponents());
        Dimension::of(std::array::from_fn(|i| added(mine[i], theirs[i])))
    }

    /// Dimension of a quotient.
    pub fn over(&self, other: &Dimension) -> Dimension {
        self.times(&other.power(&-Rational::one()))
    }

    /// Dimension of a power.
    pub fn power(&self, exponent: &Rational) -> Dimension {
        // Most exponents are zero.
        let times = |a: &Rational| match a.is_zero() {
            true => a.clone(),
            false => a * exponent,
        };
        Dimension::of(self.exponents().map(times))
    }

    /// In plain characters, such as `mass*length^2/time`; `1` without dimension.
    pub fn plain(&self) -> String {
        self.spell(NAMES, "*", |k| match k.is_integer() {
            true => format!("^{k}"),
            false => format!("^({k})"),
        })
    }

    /// As a unit of the SI, such as `kg m²/s`; `1` without dimension.
    pub fn si(&self) -> String {
        self.spell(["kg", "m", "s", "A", "K", "mol"], " ", superscript)
    }

    /// The SI unit as a person says it of the quantities of a collision: rad/s, N s, N and J where they fit, else as [`si`].
    ///
    /// [`si`]: Dimension::si
    pub fn spoken(&self) -> String {
        let si = self.si();
        match si.as_str() {
            "1/s" => String::from("rad/s"),
            "1/s²" => String::from("rad/s²"),
            "kg m/s" => String::from("N s"),
            "kg m/s²" => String::from("N"),
            "kg m²/s²" => String::from("J"),
            _ => si,
        }
    }

    /// The unit in feet, pounds of force and seconds, such as `ft/s`, `lbf s`, `ft lbf` or `slug ft²`.
    fn in_feet_and_pounds(&self) -> String {
        let [mass, length, time] = [&self.mass, &self.length, &self.time];
        if self.exponents()[3..].iter().any(|k| !k.is_zero()) {
            return self.si();
        }
        let none = Rational::zero;
        // A pound of force holds a mass, a length and a time.
        if mass.is_zero() || time.is_zero() {
            return self.spell(["slug", "ft", "s", "", "", ""], " ", superscript);
        }
        let rest = [length - mass, mass.clone(), time + mass + mass];
        let [feet, pounds, seconds] = rest;
        let powers = Dimension::of([feet, pounds, seconds, none(), none(), none()]);
        powers.spell(["ft", "lbf", "s", "", "", ""], " ", superscript)
    }

    fn spell(
        &self,
        names: [&str; BASES],
        times: &str,
        raise: impl Fn(&Rational) -> String,
    ) -> String {
        let all = || names.iter().zip(self.exponents());
        let part = |positive: bool| -> Vec<String> {
            let mine = all().filter(|(_, k)| !k.is_zero() && k.is_positive() == positive);
            mine.map(|(name, k)| match k.abs() {
                size if size.is_one() => (*name).to_string(),
                size => format!("{name}{}", raise(&size)),
            })
            .collect()
        };
        let (above, below) = (part(true), part(false));
        let numerator = match above.is_empty() {
            true => "1".to_string(),
            false => above.join(times),
        };
        match below.as_slice() {
            [] => numerator,
            [one] => format!("{numerator}/{one}"),
            many => format!("{numerator}/({})", many.join(times)),
        }
    }
}

/// In words, such as `mass × length²/time`; `a number` without dimension.
impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_none() {
            return f.write_str("a number");
        }
        f.write_str(&self.spell(NAMES, " × ", superscript))
    }
}

/// The exponent in raised characters.
pub(crate) fn superscript(exponent: &Rational) -> String {
    let raised = |c: char| {
        let mut both = "0123456789-/".chars().zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁻ᐟ".chars());
        both.find(|(low, _)| *low == c).map_or(c, |(_, high)| high)
    };
    exponent.to_string().chars().map(raised).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expr::ratio;

    #[test]
    fn a_dimension_is_spelled_in_words_in_characters_and_as_a_unit() {
        let momentum = Dimension::new(1, 2, -1);
        assert_eq!(momentum.to_string(), "mass × length²/time");
        assert_eq!(momentum.plain(), "mass*length^2/time");
        assert_eq!(momentum.si(), "kg m²/s");
        assert_eq!(Dimension::none().to_string(), "a number");
        assert_eq!(Dimension::new(0, 0, -1).plain(), "1/time");
        assert_eq!(
            Dimension::new(0, 1, 0).power(&ratio(1, 2)).plain(),
            "length^(1/2)"
        );
    }
}
