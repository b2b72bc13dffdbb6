//! Units of mechanics: text in, dimension and exact factor to SI out.
//!
//! Reads products, quotients and powers of SI units with prefixes, as people write them: `kg m^2`, `N·m`, `m s⁻²`,
//! `kg·m/s`, `km/h`, `rpm`. Case matters, as it does in the SI. After one slash everything is in the denominator up to
//! the end; `kg/m s` and `kg/m·s` are refused, because people disagree about them.

use std::collections::HashMap;
use std::sync::LazyLock;

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

    /// Whether it is a smaller unit of the same kind, as minutes are of an hour.
    pub fn is_part_of(&self, larger: &Unit) -> bool {
        let alike = self.dimension == larger.dimension && self.pi == larger.pi;
        alike && !self.dimension.is_none() && self.factor < larger.factor
    }

    /// The SI unit of a dimension.
    pub fn coherent(dimension: Dimension) -> Unit {
        Unit {
            dimension,
            factor: Rational::one(),
            pi: Rational::zero(),
            angle: false,
            cycles: false,
        }
    }

    fn number() -> Unit {
        Unit::coherent(Dimension::none())
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
    /// Whether brackets below a slash would make it a unit.
    pub is_unclear: bool,
}

/// Longest unit text looked at, in bytes.
const LONGEST: usize = 80;
const NONE: &str = "this is no unit";
/// Largest exponent of a unit.
const HIGHEST: i64 = 12;

/// Reads a unit; the whole text is consumed or it is a fault. `1` and the empty text are the unit of a pure number.
pub fn unit(text: &str) -> Result<Unit, UnitFault> {
    if text.len() > LONGEST {
        let message = format!("a unit has at most {LONGEST} bytes");
        return fault(message, 0, text.len());
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
                    let message = format!("a unit is missing before `{c}`");
                    return fault(message, self.at, self.at + c.len_utf8());
                }
                // `N-s` and `kg-m²`: a hyphen between two units ties them.
                '*' | '·' | '⋅' | '•' | '∙' | '.' | '×' | '-' if c != '-' || self.hyphen() =>
                {
                    self.at += c.len_utf8();
                    // kg/m·s: the dot multiplies the denominator for some and the whole for others.
                    if over && below > 0 {
                        return self.unclear(before);
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
                return self.unclear(before);
            }
            let start = self.at;
            // `h 1 min` is no product: only `1/s` begins with a number.
            let tail = &self.text[start + c.len_utf8()..];
            if c == '1' && total.is_some() && !waiting && !tail.starts_with('/') {
                return fault("a number in the middle of a unit", start, start + 1);
            }
            // `square metres`
            let rest = &self.text[start..];
            let mut said = [("square ", 2), ("cubic ", 3)].into_iter();
            let said = said.find(|(word, _)| rest.starts_with(word));
            let said = said.unwrap_or(("", 1));
            self.at += said.0.len();
            let atom = self.atom(depth)?;
            // `ms-2` has two letters, of which the exponent belongs to the second.
            let several = total.as_ref().is_some_and(|t| *t != Unit::number())
                || &self.text[start..self.at] == "ms";
            let word = &self.text[start..self.at];
            let power = said.1 * self.exponent(several)?;
            // Nobody squares litres: `mL^2` is a mass and the square of a length.
            if power.abs() > 1 && matches!(word, "L" | "l" | "mL" | "ml" | "cc" | "ccm") {
                let message = format!("the square of `{word}` is no unit");
                return fault(message, start, self.at);
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
                return fault(NONE, start, self.text.len());
            }
            waiting = false;
        }
        if waiting {
            let message = "the unit ends where another one is expected";
            return fault(message, self.text.len(), self.text.len());
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

    fn unclear(&self, at: usize) -> Result<Unit, UnitFault> {
        Err(UnitFault {
            message: "what is below the slash is unclear; write brackets, as in kg/(m s)".into(),
            start: at,
            end: self.text.len(),
            is_unclear: true,
        })
    }

    fn atom(&mut self, depth: u32) -> Result<Unit, UnitFault> {
        let start = self.at;
        match self.peek() {
            Some('(') if depth < 3 => {
                self.at += 1;
                let inner = self.product(depth + 1)?;
                if self.peek() != Some(')') {
                    return fault("the bracket is not closed", start, self.text.len());
                }
                self.at += 1;
                Ok(inner)
            }
            Some('1') => {
                self.at += 1;
                Ok(Unit::number())
            }
            // In a product or quotient a degree Celsius is a difference of temperatures: `J/(kg °C)`.
            Some('°') if self.text[start..].starts_with("°C") && self.text.trim() != "°C" => {
                self.at += "°C".len();
                named("K").map_or_else(|| fault(NONE, start, self.at), Ok)
            }
            Some('°') => {
                self.at += '°'.len_utf8();
                plain("°").map_or_else(|| fault(NONE, start, self.at), Ok)
            }
            _ => {
                let rest = &self.text[start..];
                let letter =
                    |c: char| c.is_ascii_alphabetic() || "µμΩÅ\u{2126}\u{212b}".contains(c);
                let length = rest.find(|c| !letter(c)).unwrap_or(rest.len());
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
                let Some(read) = named(&word.replace('\u{2126}', "Ω").replace('\u{212b}', "Å"))
                else {
                    let shown = &self.text[start..end];
                    let message = format!("`{shown}` is no unit of mechanics I know");
                    return fault(message, start, end);
                };
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
                let raised = "⁰¹²³⁴".chars().zip("01234".chars());
                let plain = match c {
                    '⁻' if digits.is_empty() => Some('-'),
                    '2' | '3' if digits.is_empty() => Some(c),
                    _ => raised
                        .clone()
                        .find(|(high, _)| *high == c)
                        .map(|(_, low)| low),
                };
                let Some(plain) = plain else { break };
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
            _ => {
                let message = format!("the exponent of a unit is a whole number up to {HIGHEST}");
                fault(message, start, self.at)
            }
        }
    }

    fn blank(&mut self) {
        let rest = &self.text[self.at..];
        self.at += rest.len() - rest.trim_start().len();
    }

    fn peek(&self) -> Option<char> {
        self.text[self.at..].chars().next()
    }
}

fn fault<T>(message: impl Into<String>, start: usize, end: usize) -> Result<T, UnitFault> {
    Err(UnitFault {
        message: message.into(),
        start,
        end,
        is_unclear: false,
    })
}

fn raise(value: &Rational, power: i64) -> Rational {
    if value.is_one() {
        return value.clone();
    }
    let k = power.unsigned_abs().min(3 * HIGHEST as u64) as u32;
    let up = Rational::new(value.numer().pow(k), value.denom().pow(k));
    if power < 0 { up.recip() } else { up }
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
    let mut all = LONG_PREFIXES.into_iter().zip(LONG_POWERS);
    if let Some((prefix, power)) = all.find(|(p, _)| word.starts_with(p)) {
        let mut found = plain(&word[prefix.len()..]).filter(|_| word.len() > prefix.len() + 3)?;
        found.factor *= &raise(&ratio(10, 1), power);
        return Some(found);
    }
    let mut all = PREFIXES.into_iter().zip(POWERS);
    let (prefix, power) = all.find(|(p, _)| word.starts_with(p) && word.len() > p.len())?;
    let base = &word[prefix.len()..];
    let electrical = ELECTRICAL.contains(&base)
        && matches!(prefix, "k" | "M" | "m" | "µ" | "μ" | "u" | "n" | "p");
    if !TAKES_PREFIX.contains(&base) && !electrical {
        return None;
    }
    let mut found = plain(base)?;
    found.factor *= &raise(&ratio(10, 1), power);
    Some(found)
}

/// Prefixes and the powers of ten they stand for; `da` before `d` so that the longer is tried first.
const PREFIXES: [&str; 14] = [
    "da", "G", "M", "k", "h", "d", "c", "m", "µ", "μ", "u", "n", "p", "f",
];
const POWERS: [i64; 14] = [1, 9, 6, 3, 2, -1, -2, -3, -6, -6, -6, -9, -12, -15];

/// Units a prefix may stand before.
const TAKES_PREFIX: [&str; 12] = [
    "g", "m", "s", "N", "J", "W", "Pa", "Hz", "rad", "Nm", "Ns", "Ws",
];

/// Units of electricity, heat, amount and pressure, which take the prefixes that people write before them.
const ELECTRICAL: [&str; 12] = [
    "A", "V", "Ω", "ohm", "S", "C", "F", "T", "H", "K", "mol", "bar",
];

/// Prefixes in full, before a unit in full: `kilojoule`.
const LONG_PREFIXES: [&str; 8] = [
    "giga", "mega", "kilo", "hecto", "centi", "milli", "micro", "nano",
];
const LONG_POWERS: [i64; 8] = [9, 6, 3, 2, -2, -3, -6, -9];

/// Units by their names: dimension by mass, length, time, current, temperature and amount, then factors to SI, those behind the slash
/// below. Of angles, `pi` is one of them.
const UNITS: &str = "
kg kilogram kilograms; 1 0 0; 1
g gram grams; 1 0 0; 0.001
t tonne tonnes; 1 0 0; 1000
m meter meters metre metres; 0 1 0; 1
s sec secs second seconds; 0 0 1; 1
min mins minute minutes; 0 0 1; 60
h hr hrs hour hours; 0 0 1; 3600
N newton newtons; 1 1 -2; 1
Nm J joule joules Ws; 1 2 -2; 1
Ns; 1 1 -1; 1
kilometer kilometers kilometre kilometres; 0 1 0; 1000
centimeter centimeters centimetre centimetres; 0 1 0; 0.01
millimeter millimeters millimetre millimetres; 0 1 0; 0.001
W watt watts; 1 2 -3; 1
Pa pascal pascals; 1 -1 -2; 1
Hz hertz; 0 0 -1; 1 cycles
Wh; 1 2 -2; 3600
kWh; 1 2 -2; 3600000
MWh; 1 2 -2; 3600000000
GWh; 1 2 -2; 3600000000000
VA; 1 2 -3; 1
kVA; 1 2 -3; 1000
MVA; 1 2 -3; 1000000
eV; 1 2 -2; 1602176634 / 10000000000000000 1000000000000
keV; 1 2 -2; 1602176634 / 10000000000000 1000000000000
MeV; 1 2 -2; 1602176634 / 10000000000 1000000000000
GeV; 1 2 -2; 1602176634 / 10000000 1000000000000
cal; 1 2 -2; 4.184
kcal; 1 2 -2; 4184
hp; 1 2 -3; 0.45359237 9.80665 0.3048 550
bar bars; 1 -1 -2; 100000
torr Torr mmHg; 1 -1 -2; 101325 / 760
atm; 1 -1 -2; 101325
psi; 1 -1 -2; 0.45359237 9.80665 / 0.0254 0.0254
L l liter liters litre litres; 0 3 0; 0.001
mL ml cc ccm; 0 3 0; 0.000001
mi mile miles; 0 1 0; 1609.344
Å angstrom angstroms; 0 1 0; 1 / 10000000000
yd yard yards; 0 1 0; 0.9144
in inch inches; 0 1 0; 0.0254
ft foot feet; 0 1 0; 0.3048
oz ounce ounces; 1 0 0; 0.45359237 / 16
lb lbs lbm pound pounds; 1 0 0; 0.45359237
lbf; 1 1 -2; 0.45359237 9.80665
kgf; 1 1 -2; 9.80665
dyn dyne dynes; 1 1 -2; 0.00001
erg ergs; 1 2 -2; 0.0000001
slug slugs; 1 0 0; 0.45359237 9.80665 / 0.3048
day days; 0 0 1; 86400
week weeks; 0 0 1; 604800
year years yr yrs; 0 0 1; 31557600
knot knots; 0 1 -1; 1852 / 3600
kph; 0 1 -1; 1 / 3.6
mph; 0 1 -1; 0.44704
A ampere amperes; 0 0 0 1; 1
C coulomb coulombs; 0 0 1 1; 1
V volt volts; 1 2 -3 -1; 1
Ω ohm ohms; 1 2 -3 -2; 1
S siemens; -1 -2 3 2; 1
F farad farads; -1 -2 4 2; 1
H henry; 1 2 -2 -2; 1
T tesla; 1 0 -2 -1; 1
Wb weber; 1 2 -2 -1; 1
K kelvin kelvins; 0 0 0 0 1; 1
mol mole moles; 0 0 0 0 0 1; 1
rad rads radian radians; 0 0 0; 1 angle
deg degree degrees °; 0 0 0; pi / 180 angle
rev revs turn turns revolution revolutions; 0 0 0; 2 pi angle
rpm; 0 0 -1; pi / 30 angle
";

/// A unit by one of its names.
fn plain(word: &str) -> Option<Unit> {
    static ALL: LazyLock<HashMap<&str, Unit>> = LazyLock::new(|| {
        let rows = UNITS.lines().filter_map(|row| row.split_once("; "));
        rows.flat_map(|(names, rest)| {
            let unit = row(rest);
            names.split(' ').map(move |name| (name, unit.clone()))
        })
        .collect()
    });
    ALL.get(word).cloned()
}

/// A row of the table behind the names.
fn row(text: &str) -> Unit {
    let (powers, factors) = text.split_once("; ").unwrap_or((text, ""));
    let mut powers = powers.split(' ').map(|p| ratio(p.parse().unwrap_or(0), 1));
    let powers = std::array::from_fn(|_| powers.next().unwrap_or_default());
    let mut unit = Unit::coherent(Dimension::of(powers));
    let mut below = false;
    for factor in factors.split(' ') {
        match factor {
            "/" => below = true,
            "pi" => unit.pi = Rational::one(),
            "angle" => unit.angle = true,
            "cycles" => unit.cycles = true,
            number => {
                let (whole, part) = number.split_once('.').unwrap_or((number, ""));
                let digits = format!("{whole}{part}").parse().unwrap_or(1);
                let number = ratio(digits, 10i64.pow(part.len() as u32));
                unit.factor *= if below { number.recip() } else { number };
            }
        }
    }
    unit
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
            ("mph", Dimension::new(0, 1, -1), (1397, 3125)),
            (
                "psi",
                Dimension::new(1, -1, -2),
                (8896443230521, 1290320000),
            ),
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
