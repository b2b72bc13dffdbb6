//! Units of mechanics: text in, dimension and exact factor to SI out.
//!
//! Reads products, quotients and powers of SI units with prefixes, as people write them: `kg m^2`, `N·m`, `m s⁻²`,
//! `kg·m/s`, `km/h`, `rpm`. Case matters, as it does in the SI. After one slash everything is in the denominator up to
//! the end; `kg/m s` and `kg/m·s` are refused, because people disagree about them.

use num_traits::{One, Zero};

use super::Dimension;
use crate::expr::{Expr, Rational, ratio};

/// A unit and how it converts.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Unit {
    /// Dimension.
    pub dimension: Dimension,
    /// SI value of one of it, up to `pi`.
    pub factor: Rational,
    /// Power of π that multiplies `factor`: 1 for degrees and turns.
    pub pi: Rational,
    /// Whether the unit names an angle (rad, deg, rpm): an angle is a number, but not every number is an angle.
    pub angle: bool,
    /// Whether it counts turns rather than radians: Hz.
    pub cycles: bool,
}

impl Unit {
    /// SI value of one of it.
    pub fn value(&self) -> Expr {
        Expr::from(self.factor.clone()) * Expr::pi().power(Expr::from(self.pi.clone()))
    }

    /// The SI unit of a dimension.
    pub fn coherent(dimension: Dimension) -> Unit {
        Unit {
            dimension,
            ..Unit::number()
        }
    }

    fn number() -> Unit {
        Unit {
            dimension: Dimension::none(),
            factor: Rational::one(),
            pi: Rational::zero(),
            angle: false,
            cycles: false,
        }
    }

    fn times(&self, other: &Unit, power: i64) -> Unit {
        let k = ratio(power, 1);
        Unit {
            dimension: self.dimension.times(&other.dimension.power(&k)),
            factor: &self.factor * &raise(&other.factor, power),
            pi: &self.pi + &(&other.pi * &k),
            angle: self.angle || other.angle,
            cycles: self.cycles || other.cycles,
        }
    }
}

/// Why a text is no unit, with the bytes concerned.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct UnitFault {
    /// What is wrong and what to write instead.
    pub message: String,
    /// First byte concerned.
    pub start: usize,
    /// Byte after the last one concerned.
    pub end: usize,
}

/// Longest unit text looked at, in bytes.
const LONGEST: usize = 80;
/// Largest exponent of a unit.
const HIGHEST: i64 = 12;

/// Reads a unit; the whole text is consumed or it is a fault. `1` and the empty text are the unit of a pure number.
pub fn unit(text: &str) -> Result<Unit, UnitFault> {
    if text.len() > LONGEST {
        return Err(fault(
            format!("a unit has at most {LONGEST} bytes"),
            0,
            text.len(),
        ));
    }
    let mut reader = Reader { text, at: 0 };
    reader.product(0)
}

struct Reader<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Reader<'a> {
    fn product(&mut self, depth: u32) -> Result<Unit, UnitFault> {
        let mut total: Option<Unit> = None;
        let mut over = false;
        let mut below = 0;
        let mut waiting = false;
        loop {
            let before = self.at;
            self.blank();
            let Some(c) = self.peek() else { break };
            match c {
                ')' if depth > 0 => break,
                '*' | '·' | '⋅' | '•' | '∙' | '.' | '×' | '/' if waiting || before == 0 => {
                    return Err(fault(
                        format!("a unit is missing before `{c}`"),
                        self.at,
                        self.at + c.len_utf8(),
                    ));
                }
                // `N-s` and `kg-m²`: a hyphen between two units ties them.
                '*' | '·' | '⋅' | '•' | '∙' | '.' | '×' | '-' if c != '-' || self.hyphen() =>
                {
                    self.at += c.len_utf8();
                    // kg/m·s: the dot multiplies the denominator for some and the whole for others.
                    if over && below > 0 {
                        return Err(self.unclear(before));
                    }
                    waiting = true;
                    continue;
                }
                '/' => {
                    // m/s/s: every slash divides by the one unit behind it.
                    self.at += 1;
                    (over, waiting, below) = (true, true, 0);
                    continue;
                }
                _ => {}
            }
            if over && below > 0 {
                return Err(self.unclear(before));
            }
            let start = self.at;
            let atom = self.atom(depth)?;
            // `ms-2` has two letters, of which the exponent belongs to the second.
            let several = total.as_ref().is_some_and(|t| *t != Unit::number())
                || &self.text[start..self.at] == "ms";
            let word = &self.text[start..self.at];
            let power = self.exponent(several)?;
            // Nobody squares litres: `mL^2` is a mass and the square of a length.
            if power.abs() > 1 && matches!(word, "L" | "l" | "mL" | "ml") {
                let message = format!("the square of `{word}` is no unit");
                return Err(fault(message, start, self.at));
            }
            let signed = if over { -power } else { power };
            if over {
                below += 1;
            }
            total = Some(match total {
                None if signed == 1 => atom,
                before => before.unwrap_or_else(Unit::number).times(&atom, signed),
            });
            if self.at == start {
                return Err(fault("this is no unit".into(), start, self.text.len()));
            }
            waiting = false;
        }
        if waiting {
            return Err(fault(
                "the unit ends where another one is expected".into(),
                self.text.len(),
                self.text.len(),
            ));
        }
        Ok(total.unwrap_or_else(Unit::number))
    }

    /// Whether a hyphen here stands right between two units of which the first is no length or time: `2 m-s` may be 2m − s.
    fn hyphen(&self) -> bool {
        let (before, behind) = (&self.text[..self.at], &self.text[self.at + 1..]);
        const FIRST: [&str; 9] = [
            "N", "kg", "lb", "lbf", "ft", "newton", "kilogram", "pound", "foot",
        ];
        let first = FIRST.iter().any(|unit| {
            let rest = before.strip_suffix(unit);
            rest.is_some_and(|rest| !rest.ends_with(|c: char| c.is_alphanumeric() && c != 'k'))
        });
        first && behind.starts_with(|c: char| c.is_ascii_alphabetic())
    }

    fn unclear(&self, at: usize) -> UnitFault {
        let message = "what is below the slash is unclear; write brackets, as in kg/(m s)";
        fault(message.into(), at, self.text.len())
    }

    fn atom(&mut self, depth: u32) -> Result<Unit, UnitFault> {
        let start = self.at;
        match self.peek() {
            Some('(') if depth < 3 => {
                self.at += 1;
                let inner = self.product(depth + 1)?;
                if self.peek() != Some(')') {
                    return Err(fault(
                        "the bracket is not closed".into(),
                        start,
                        self.text.len(),
                    ));
                }
                self.at += 1;
                Ok(inner)
            }
            Some('1') => {
                self.at += 1;
                Ok(Unit::number())
            }
            Some('°') => {
                self.at += '°'.len_utf8();
                Ok(angle(ratio(1, 180), 1))
            }
            _ => {
                let rest = &self.text[start..];
                let length = rest
                    .find(|c: char| {
                        !(c.is_ascii_alphabetic() || matches!(c, 'µ' | 'μ' | 'Ω' | '\u{2126}'))
                    })
                    .unwrap_or(rest.len());
                // `kgm`, `kgms` and `rads` are written for kg·m, kg·m·s and rad·s by many, and are nothing else; `rads` alone
                // or above a slash is more than one.
                let plural = matches!(rest[length..].chars().next(), None | Some('/' | ' '));
                let length = match &rest[..length] {
                    "kgm" | "kgms" => 2,
                    "rads" if !plural => 3,
                    _ => length,
                };
                let word = &rest[..length];
                let end = start + length.max(rest.chars().next().map_or(0, char::len_utf8));
                let read = named(&word.replace('\u{2126}', "Ω")).ok_or_else(|| {
                    let shown = &self.text[start..end];
                    fault(
                        format!("`{shown}` is no unit of mechanics I know"),
                        start,
                        end,
                    )
                })?;
                self.at = end;
                Ok(read)
            }
        }
    }

    /// The exponent after a unit: `^-2`, `^{2}`, `**2`, `²`, `⁻¹`, or a digit right behind, as in `m2`, or a word, as in `second squared`; at the end and behind
    /// another unit with a sign as well, as in `m s-1`.
    fn exponent(&mut self, behind: bool) -> Result<i64, UnitFault> {
        let start = self.at;
        let rest = &self.text[start..];
        for (word, power) in [(" squared", 2), (" cubed", 3)] {
            if rest.starts_with(word) {
                self.at += word.len();
                return Ok(power);
            }
        }
        if behind
            && let Some(digit) = rest.strip_prefix(['-', '−'])
            && matches!(digit, "1" | "2" | "3")
        {
            self.at = self.text.len();
            return Ok(-digit.parse::<i64>().unwrap_or(1));
        }
        let mut digits = String::new();
        let mut length = 0;
        if let Some(tail) = rest.strip_prefix("**").or_else(|| rest.strip_prefix('^')) {
            length = rest.len() - tail.len();
            let braced = tail.starts_with('{') || tail.starts_with('(');
            let body = if braced { &tail[1..] } else { tail };
            for c in body.chars() {
                match c {
                    '-' | '−' if digits.is_empty() => digits.push('-'),
                    '0'..='9' if digits.len() < 5 => digits.push(c),
                    _ => break,
                }
                length += c.len_utf8();
            }
            if braced {
                let closed = rest[length + 1..].starts_with(['}', ')']);
                length += if closed { 2 } else { 1 };
                if !closed {
                    digits.clear();
                }
            }
        } else {
            for c in rest.chars() {
                let plain = match c {
                    '⁻' if digits.is_empty() => '-',
                    '⁰' => '0',
                    '¹' => '1',
                    '²' => '2',
                    '³' => '3',
                    '⁴' => '4',
                    '2' | '3' if digits.is_empty() => c,
                    _ => break,
                };
                digits.push(plain);
                length += c.len_utf8();
            }
        }
        if length == 0 {
            return Ok(1);
        }
        self.at += length.min(rest.len());
        match digits.parse::<i64>() {
            Ok(k) if k.abs() <= HIGHEST && k != 0 => Ok(k),
            _ => Err(fault(
                format!("the exponent of a unit is a whole number up to {HIGHEST}"),
                start,
                self.at,
            )),
        }
    }

    fn blank(&mut self) {
        while let Some(c) = self.peek() {
            if !c.is_whitespace() {
                break;
            }
            self.at += c.len_utf8();
        }
    }

    fn peek(&self) -> Option<char> {
        self.text[self.at..].chars().next()
    }
}

fn fault(message: String, start: usize, end: usize) -> UnitFault {
    UnitFault {
        message,
        start,
        end,
    }
}

fn raise(value: &Rational, power: i64) -> Rational {
    if value.is_one() {
        return value.clone();
    }
    let k = power.unsigned_abs().min(HIGHEST as u64) as u32;
    let up = Rational::new(value.numer().pow(k), value.denom().pow(k));
    if power < 0 { up.recip() } else { up }
}

fn angle(factor: Rational, pi: i64) -> Unit {
    Unit {
        dimension: Dimension::none(),
        factor,
        pi: ratio(pi, 1),
        angle: true,
        cycles: false,
    }
}

/// A unit by its name, with a prefix where the SI allows one.
fn named(word: &str) -> Option<Unit> {
    if let Some(found) = plain(word) {
        return Some(found);
    }
    // `Newton`: a word is no symbol, whatever it begins with.
    if word.len() > 3 && word.starts_with(|c: char| c.is_ascii_uppercase()) {
        let small = word.to_ascii_lowercase();
        if let Some(found) = plain(&small).filter(|_| small[1..] == word[1..]) {
            return Some(found);
        }
    }
    if let Some((prefix, power)) = LONG_PREFIXES.iter().find(|(p, _)| word.starts_with(p)) {
        let mut found = plain(&word[prefix.len()..]).filter(|_| word.len() > prefix.len() + 3)?;
        found.factor *= &raise(&ratio(10, 1), *power);
        return Some(found);
    }
    let (prefix, power) = PREFIXES
        .iter()
        .find(|(prefix, _)| word.starts_with(prefix) && word.len() > prefix.len())?;
    let base = &word[prefix.len()..];
    let electrical = ELECTRICAL.contains(&base) && matches!(*prefix, "k" | "M" | "m" | "µ" | "μ");
    if !TAKES_PREFIX.contains(&base) && !electrical {
        return None;
    }
    let mut found = plain(base)?;
    found.factor *= &raise(&ratio(10, 1), *power);
    Some(found)
}

/// Prefixes and the powers of ten they stand for; `da` before `d` so that the longer is tried first.
const PREFIXES: [(&str, i64); 13] = [
    ("da", 1),
    ("G", 9),
    ("M", 6),
    ("k", 3),
    ("h", 2),
    ("d", -1),
    ("c", -2),
    ("m", -3),
    ("µ", -6),
    ("μ", -6),
    ("u", -6),
    ("n", -9),
    ("p", -12),
];

/// Units a prefix may stand before.
const TAKES_PREFIX: [&str; 12] = [
    "g", "m", "s", "N", "J", "W", "Pa", "Hz", "rad", "Nm", "Ns", "Ws",
];

/// Electrical units, which take the prefixes that do not look like a product of letters.
const ELECTRICAL: [&str; 6] = ["A", "V", "Ω", "C", "F", "T"];

/// Prefixes in full, before a unit in full: `kilojoule`.
const LONG_PREFIXES: [(&str, i64); 8] = [
    ("giga", 9),
    ("mega", 6),
    ("kilo", 3),
    ("hecto", 2),
    ("centi", -2),
    ("milli", -3),
    ("micro", -6),
    ("nano", -9),
];

fn electric(mass: i64, length: i64, time: i64, current: i64) -> Unit {
    Unit {
        dimension: Dimension {
            current: ratio(current, 1),
            ..Dimension::new(mass, length, time)
        },
        ..Unit::number()
    }
}

/// 10^`tens` electron volts, exact since 2019.
fn electron_volt(tens: i64) -> Unit {
    let joule = ratio(1_602_176_634, 1)
        * raise(&ratio(10, 1), -12)
        * raise(&ratio(10, 1), -12)
        * ratio(1, 10_000);
    Unit {
        dimension: Dimension::new(1, 2, -2),
        factor: joule * raise(&ratio(10, 1), tens),
        ..Unit::number()
    }
}

fn plain(word: &str) -> Option<Unit> {
    let si = |mass, length, time, factor| Unit {
        dimension: Dimension::new(mass, length, time),
        factor,
        ..Unit::number()
    };
    let one = Rational::one;
    Some(match word {
        "kg" | "kilogram" | "kilograms" => si(1, 0, 0, one()),
        "g" | "gram" | "grams" => si(1, 0, 0, ratio(1, 1000)),
        "t" | "tonne" | "tonnes" => si(1, 0, 0, ratio(1000, 1)),
        "m" | "meter" | "meters" | "metre" | "metres" => si(0, 1, 0, one()),
        "s" | "sec" | "second" | "seconds" => si(0, 0, 1, one()),
        "min" | "minute" | "minutes" => si(0, 0, 1, ratio(60, 1)),
        "h" | "hr" | "hour" | "hours" => si(0, 0, 1, ratio(3600, 1)),
        "N" | "newton" | "newtons" => si(1, 1, -2, one()),
        // Nm and Ns are not SI spelling, but how newton metre and newton second are often typed.
        "Nm" | "J" | "joule" | "joules" => si(1, 2, -2, one()),
        "Ns" => si(1, 1, -1, one()),
        "Ws" => si(1, 2, -2, one()),
        "kilometer" | "kilometers" | "kilometre" | "kilometres" => si(0, 1, 0, ratio(1000, 1)),
        "centimeter" | "centimeters" | "centimetre" | "centimetres" => si(0, 1, 0, ratio(1, 100)),
        "millimeter" | "millimeters" | "millimetre" | "millimetres" => si(0, 1, 0, ratio(1, 1000)),
        "W" => si(1, 2, -3, one()),
        "Pa" => si(1, -1, -2, one()),
        "Hz" | "hertz" => Unit {
            cycles: true,
            ..si(0, 0, -1, one())
        },
        "watt" | "watts" => si(1, 2, -3, one()),
        "pascal" | "pascals" => si(1, -1, -2, one()),
        "Wh" => si(1, 2, -2, ratio(3600, 1)),
        "kWh" => si(1, 2, -2, ratio(3_600_000, 1)),
        "eV" => electron_volt(0),
        "keV" => electron_volt(3),
        "MeV" => electron_volt(6),
        "GeV" => electron_volt(9),
        "cal" => si(1, 2, -2, ratio(4184, 1000)),
        "kcal" => si(1, 2, -2, ratio(4184, 1)),
        "hp" => si(
            1,
            2,
            -3,
            ratio(45_359_237, 100_000_000)
                * ratio(980_665, 100_000)
                * ratio(381, 1250)
                * ratio(550, 1),
        ),
        "bar" => si(1, -1, -2, ratio(100_000, 1)),
        "atm" => si(1, -1, -2, ratio(101_325, 1)),
        "psi" => si(
            1,
            -1,
            -2,
            ratio(45_359_237, 100_000_000) * ratio(980_665, 100_000) / ratio(127 * 127, 25_000_000),
        ),
        "L" | "l" | "liter" | "liters" | "litre" | "litres" => si(0, 3, 0, ratio(1, 1000)),
        "mL" | "ml" => si(0, 3, 0, ratio(1, 1_000_000)),
        "mi" | "mile" | "miles" => si(0, 1, 0, ratio(201_168, 125)),
        "yd" | "yard" | "yards" => si(0, 1, 0, ratio(1143, 1250)),
        "oz" | "ounce" | "ounces" => si(1, 0, 0, ratio(45_359_237, 1_600_000_000)),
        "lbs" => si(1, 0, 0, ratio(45_359_237, 100_000_000)),
        "day" | "days" => si(0, 0, 1, ratio(86_400, 1)),
        "knot" | "knots" => si(0, 1, -1, ratio(1852, 3600)),
        "A" | "ampere" | "amperes" => electric(0, 0, 0, 1),
        "C" | "coulomb" | "coulombs" => electric(0, 0, 1, 1),
        "V" | "volt" | "volts" => electric(1, 2, -3, -1),
        "Ω" | "ohm" | "ohms" => electric(1, 2, -3, -2),
        "F" | "farad" | "farads" => electric(-1, -2, 4, 2),
        "H" | "henry" => electric(1, 2, -2, -2),
        "T" | "tesla" => electric(1, 0, -2, -1),
        "Wb" | "weber" => electric(1, 2, -2, -1),
        "K" | "kelvin" | "kelvins" => Unit {
            dimension: Dimension {
                temperature: one(),
                ..Dimension::none()
            },
            ..Unit::number()
        },
        "rad" | "rads" | "radian" | "radians" => angle(one(), 0),
        "deg" | "degree" | "degrees" => angle(ratio(1, 180), 1),
        "rev" | "turn" | "revolution" | "revolutions" => angle(ratio(2, 1), 1),
        "rpm" => Unit {
            dimension: Dimension::new(0, 0, -1),
            ..angle(ratio(1, 30), 1)
        },
        "in" | "inch" | "inches" => si(0, 1, 0, ratio(127, 5000)),
        "ft" | "foot" | "feet" => si(0, 1, 0, ratio(381, 1250)),
        "lb" | "lbm" | "pound" | "pounds" => si(1, 0, 0, ratio(45_359_237, 100_000_000)),
        "lbf" => si(
            1,
            1,
            -2,
            ratio(45_359_237, 100_000_000) * ratio(980_665, 100_000),
        ),
        "slug" | "slugs" => si(
            1,
            0,
            0,
            ratio(45_359_237, 100_000_000) * ratio(980_665, 100_000) * ratio(1250, 381),
        ),
        "kph" => si(0, 1, -1, ratio(5, 18)),
        "mph" => si(0, 1, -1, ratio(1397, 3125)),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_convert_exactly() {
        let table = [
            ("kg m^2", Dimension::new(1, 2, 0), (1, 1)),
            ("m/s", Dimension::new(0, 1, -1), (1, 1)),
            ("m s^-2", Dimension::new(0, 1, -2), (1, 1)),
            ("m s⁻²", Dimension::new(0, 1, -2), (1, 1)),
            ("N s", Dimension::new(1, 1, -1), (1, 1)),
            ("N·m", Dimension::new(1, 2, -2), (1, 1)),
            ("J", Dimension::new(1, 2, -2), (1, 1)),
            ("kg·m/s", Dimension::new(1, 1, -1), (1, 1)),
            ("kg*m**2/s", Dimension::new(1, 2, -1), (1, 1)),
            ("kg/(m s)", Dimension::new(1, -1, -1), (1, 1)),
            ("mm", Dimension::new(0, 1, 0), (1, 1000)),
            ("cm^2", Dimension::new(0, 2, 0), (1, 10_000)),
            ("g", Dimension::new(1, 0, 0), (1, 1000)),
            ("km/h", Dimension::new(0, 1, -1), (5, 18)),
            ("rad/s", Dimension::new(0, 0, -1), (1, 1)),
            ("1/s", Dimension::new(0, 0, -1), (1, 1)),
            ("s^{-1}", Dimension::new(0, 0, -1), (1, 1)),
            ("1", Dimension::none(), (1, 1)),
            ("", Dimension::none(), (1, 1)),
            ("ms", Dimension::new(0, 0, 1), (1, 1000)),
            ("MJ", Dimension::new(1, 2, -2), (1_000_000, 1)),
            ("m2", Dimension::new(0, 2, 0), (1, 1)),
            ("ft/s", Dimension::new(0, 1, -1), (381, 1250)),
            ("kph", Dimension::new(0, 1, -1), (5, 18)),
            ("kg•m", Dimension::new(1, 1, 0), (1, 1)),
            ("newton-seconds", Dimension::new(1, 1, -1), (1, 1)),
            ("meters/second squared", Dimension::new(0, 1, -2), (1, 1)),
            ("meters cubed", Dimension::new(0, 3, 0), (1, 1)),
        ];
        for (text, dimension, (n, d)) in table {
            let read = unit(text).unwrap_or_else(|fault| panic!("{text}: {}", fault.message));
            assert_eq!(
                (read.dimension, read.factor),
                (dimension, ratio(n, d)),
                "{text}"
            );
        }
        assert_eq!(
            unit("deg").map(|u| u.value()),
            Ok(Expr::pi() * Expr::ratio(1, 180))
        );
        assert_eq!(
            unit("rpm").map(|u| u.value()),
            Ok(Expr::pi() * Expr::ratio(1, 30))
        );
    }

    #[test]
    fn what_is_no_unit_is_refused_with_its_place() {
        for text in [
            "Kg", "kg m^", "kg/m s/s", "kg/m s", "m^99999", "v", "m/", "/s", "m··s", "(m", "m)",
            "kkg", "^2", "m^0", "é", "mL^2", "kg L²",
        ] {
            let found = unit(text);
            assert!(found.is_err(), "{text} was read as {found:?}");
            let fault = found.unwrap_err();
            assert!(
                fault.start <= fault.end && fault.end <= text.len(),
                "{text}: {fault:?}"
            );
        }
    }
}
