//! Numbers as tokens: digits, raised digits, percentages.

use super::fault::{Fault, Faulty};
use super::lexer::Lexer;
use super::note::Remark;
use super::number::{self, Exponent};
use super::token::{Before, Literal, Tok};
use crate::expr::ratio;

/// Most digits and powers of ten of all numbers together, beyond what fits a machine word: long fractions cost much.
const MAX_LONG_DIGITS: u32 = 6_000;
/// Largest number of which a factorial is read.
const MAX_FACTORIAL: i64 = 100;

impl Lexer<'_> {
    /// An exponent in raised digits.
    pub(super) fn raised(&mut self) -> Faulty<Tok> {
        let start = self.pos;
        let mut digits = 0i64;
        let mut count = 0;
        let mut negative = false;
        for c in self.text[start..].chars() {
            let digit = match c {
                '⁰' => 0,
                '¹' => 1,
                '²' => 2,
                '³' => 3,
                '⁴'..='⁹' => i64::from(u32::from(c) - u32::from('⁴')) + 4,
                '⁺' | '⁻' if self.pos == start => {
                    negative = c == '⁻';
                    self.pos += c.len_utf8();
                    continue;
                }
                _ => break,
            };
            self.pos += c.len_utf8();
            count += 1;
            if count > 4 {
                return Err(Fault::new(
                    "an exponent has at most four raised digits",
                    start,
                    self.pos,
                ));
            }
            digits = digits * 10 + digit;
        }
        if count == 0 {
            return Err(Fault::new(
                "a raised sign without digits belongs right behind a name",
                start,
                self.pos,
            ));
        }
        Ok(Tok::Raised(ratio(
            if negative { -digits } else { digits },
            1,
        )))
    }

    /// A number with the sign of a factorial behind it, `5!`; of a name none is read.
    pub(super) fn factorial(&mut self, number: Tok) -> Faulty<Tok> {
        let rest = &self.text[self.pos..];
        let Tok::Number(literal) = &number else {
            return Ok(number);
        };
        if !rest.starts_with('!') || rest.starts_with("!=") {
            return Ok(number);
        }
        let whole = (0..=MAX_FACTORIAL).find(|n| literal.value == ratio(*n, 1));
        let Some(whole) = whole.filter(|_| !literal.decimal) else {
            let message = format!("a factorial is read of a whole number up to {MAX_FACTORIAL}");
            return Err(Fault::new(message, self.pos, self.pos + 1));
        };
        self.pos += 1;
        Ok(Tok::Number(counted(&(1..=whole).collect::<Vec<_>>(), &[])))
    }

    /// `\\binom{5}{2}` of whole numbers.
    pub(super) fn binomial(&mut self, start: usize) -> Faulty<Tok> {
        let mut of = [""; 2];
        for number in &mut of {
            let (inside, end) = self.group(start)?;
            *number = inside;
            self.pos = end;
        }
        self.binomial_of(of, start)
    }

    /// The rest of `binomial(5, 2)`.
    pub(super) fn binomial_of_list(&mut self, start: usize) -> Faulty<Tok> {
        let inside = self.text[self.pos..].strip_prefix('(');
        let inside = inside.and_then(|rest| rest.split_once(')'));
        let list = inside.and_then(|(inside, _)| Some((inside.len(), inside.split_once(',')?)));
        let Some((length, (n, k))) = list else {
            return self.binomial_of([""; 2], start);
        };
        self.pos += length + 2;
        self.binomial_of([n, k], start)
    }

    fn binomial_of(&self, of: [&str; 2], start: usize) -> Faulty<Tok> {
        let whole = |text: &str| text.trim().parse().ok();
        let small = |n: &i64| (0..=MAX_FACTORIAL).contains(n);
        let [Some(n), Some(k)] = of.map(|text| whole(text).filter(small)) else {
            let message = format!("a binomial is read of whole numbers up to {MAX_FACTORIAL}");
            return Err(Fault::new(message, start, self.pos));
        };
        let above: Vec<i64> = (n - k + 1..=n).collect();
        let below: Vec<i64> = (1..=k).collect();
        Ok(Tok::Number(counted(&above, &below)))
    }

    pub(super) fn number(&mut self) -> Faulty<Tok> {
        let start = self.pos;
        let bytes = self.text.as_bytes();
        if let Some((literal, end)) = number::plain(&bytes[start..]) {
            self.pos = start + end;
            return Ok(Tok::Number(literal));
        }
        let mut digits_end = start;
        let mut dot = false;
        while bytes
            .get(digits_end)
            .is_some_and(|b| b.is_ascii_digit() || (*b == b'.' && !dot))
        {
            dot |= bytes[digits_end] == b'.';
            digits_end += 1;
        }
        let mut exponent = Exponent::Ten;
        if let Some((digits_at, stop, _)) = number::exponent_at(bytes, digits_end) {
            let letter = &self.text[digits_end..=digits_end];
            let declared = self.symbols.find(letter).is_some();
            if declared || letter == "e" && self.symbols.is_open() {
                let signed = digits_at > digits_end + 1;
                // 2e-1 with e declared is 2e minus 1; 1.5e-3 is a number to everybody.
                let ten = !(declared && signed && !dot);
                let usual = self.usual();
                self.note(
                    Remark::PowerOfTen { ten: ten == usual },
                    start,
                    digits_end,
                    stop,
                );
                exponent = if ten == usual {
                    Exponent::Ten
                } else {
                    Exponent::Symbol
                };
            }
        }
        let (literal, end) = match number::grouped(self.text, start, self.list, self.open > 0) {
            Some(found) => found?,
            None => match number::decimal_comma(self.text, start)
                .filter(|_| !self.list && self.open == 0)
            {
                Some((literal, end)) => {
                    self.note(Remark::DecimalComma, start, start, end);
                    (literal, end)
                }
                None => number::literal(self.text, start, exponent, self.list)?,
            },
        };
        let (literal, end) = match number::repeating(self.text, start, end, &literal) {
            Some(found) => found,
            None => (literal, end),
        };
        self.long_digits += (literal.digits + literal.place.unsigned_abs()).saturating_sub(18);
        if self.long_digits > MAX_LONG_DIGITS {
            let message =
                format!("the numbers of a formula have at most {MAX_LONG_DIGITS} digits in all");
            return Err(Fault::new(message, start, end));
        }
        if literal.decimal && number::uncertain(&self.text[end..]) {
            let message = "digits in brackets behind a decimal number may be its uncertainty";
            let fault = Fault::new(message, start, end);
            return Err(fault.hint("write * for a product, ± for an uncertainty"));
        }
        self.pos = end;
        Ok(Tok::Number(literal))
    }

    /// Whether an x stands for the times sign of a power of ten, as in `6.02 x 10^23`.
    pub(super) fn times_ten(&self, rest: &str) -> bool {
        let behind = rest[1..].trim_start();
        matches!(self.before, Before::Number { .. })
            && (behind.starts_with("10^") || behind.starts_with("10**"))
            && self.symbols.find(&rest[..1]).is_none()
    }

    /// A percent sign behind a number, or one of another share, with nothing behind it that could make it a remainder.
    pub(super) fn percent(&mut self, start: usize, length: usize, of: i64) -> Faulty<Tok> {
        let end = start + length;
        // Maxima writes constants with the sign before them: `2*%pi`, `%e^x`.
        let rest = &self.text[end..];
        let constant = [("pi", Tok::Name("pi".into())), ("e", Tok::Exponential)];
        for (word, tok) in constant {
            let alone = |behind: &str| !behind.starts_with(|c: char| c.is_alphanumeric());
            if rest.strip_prefix(word).is_some_and(alone) && self.before == Before::Nothing {
                self.pos = end + word.len();
                return Ok(tok);
            }
        }
        let behind = self.text[end..].trim_start().chars().next();
        // `40% m`: of a remainder the sign is no closer to the one number than to the other.
        let closer = self.text[..start].ends_with(|c: char| c.is_ascii_digit())
            && self.text[end..].starts_with(' ')
            && behind.is_some_and(|c| c.is_alphabetic() || c == '\\');
        let alone = closer || behind.is_none_or(|c| "+-−±*·/=<>≤≥≈)]},;.$|".contains(c));
        // Behind a bracket or a fraction too: `(33 + 1/3)%`, `\frac{1}{3}\%`.
        if !alone || self.before == Before::Nothing {
            let fault = Fault::new("a percent sign belongs behind a number", start, end);
            return Err(fault.hint("write 5% or 0.05"));
        }
        self.pos = end;
        Ok(Tok::Percent(of))
    }
}

/// The whole number that is a product above another.
fn counted(above: &[i64], below: &[i64]) -> Literal {
    let product = |factors: &[i64]| {
        factors
            .iter()
            .fold(ratio(1, 1), |all, n| all * ratio(*n, 1))
    };
    let value = product(above) / product(below);
    let digits = value.to_string().len() as u32;
    Literal {
        digits,
        ..Literal::of(value)
    }
}
