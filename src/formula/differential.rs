//! Changes and derivatives: `Δp`, `dx/dt`, `\frac{d^2θ}{dt^2}`. A Δ or d before a name is no factor, and never cancels.
//!
//! In: the place where such a sign stands. Out: one name, the one that dots give where the derivative is by the time. What
//! is declared as a factor stays one: where d, x and t are all declared, `dx/dt` is a quotient of products.

use super::fault::{Fault, Faulty};
use super::lexer::Lexer;
use super::symbols::name;
use super::symbols::{Parts, both, is_greek};
use super::token::Tok;

/// Ways to write the sign of a derivative, apart from a plain d.
const SIGNS: &str =
    "\\mathrm{d}|\\mathrm d|\\text{d}|{\\rm d}|\\differentialD|\\partial|\\dd|\\mathrm{\\,d}|∂|ⅆ";

/// Commands of a fraction.
const FRACTIONS: [&str; 3] = ["\\frac", "\\dfrac", "\\tfrac"];

/// Most bytes that are searched for the end of what is differentiated.
const FARTHEST: usize = 200;

fn unread(start: usize, end: usize) -> Box<Fault> {
    let message = "the derivative of a product, power or sum is not read";
    Fault::new(message, start, end).hint("write the derivative of each name, as in dx/dt")
}

/// Something differentiated: its order, its name, and the byte behind.
struct Differential {
    order: u32,
    parts: Option<Parts>,
    end: usize,
    plain: bool,
    /// Whether a space parts a plain d from the name: `d x`.
    spaced: bool,
}

impl Lexer<'_> {
    /// A derivative that starts here with `d`, `∂` or `\frac`.
    pub(super) fn derivative(&mut self) -> Option<Faulty<Tok>> {
        let start = self.pos;
        self.derivative_of_name(start).or_else(|| {
            let end = self.derivative_of_more(start)?;
            Some(Err(unread(start, end)))
        })
    }

    /// The end of a derivative of more than one name: `d(mv)/dt`, `\frac{d v^2}{dt}`.
    fn derivative_of_more(&self, start: usize) -> Option<usize> {
        let rest = &self.text[start..];
        let fraction = FRACTIONS.iter().find(|f| rest.starts_with(**f));
        let (sign_at, between, stops): (usize, _, &[u8]) = match fraction {
            Some(word) => {
                let open = self.blanks(start + word.len());
                self.text[open..].starts_with('{').then_some(())?;
                (self.blanks(open + 1), b'}', b"")
            }
            None => (start, b'/', b"+-*=,;<>&"),
        };
        let (above, plain) = self.sign(sign_at)?;
        if plain && self.symbols.find("d").is_some() {
            return None;
        }
        let below = self.blanks(self.outside(above, between, stops)? + 1);
        let close = match self.text[below..].chars().next()? {
            '{' => Some('}'),
            '(' if fraction.is_none() => Some(')'),
            _ if fraction.is_none() => None,
            _ => return None,
        };
        let from = self.blanks(below + usize::from(close.is_some()));
        let end = self.differential(from, false, true)?.end;
        let Some(close) = close else {
            return Some(end);
        };
        let end = self.blanks(end);
        self.text[end..].starts_with(close).then_some(end + 1)
    }

    /// Where a byte stands outside all brackets that open behind `at`, with none of the `stops` before it.
    pub(super) fn outside(&self, at: usize, wanted: u8, stops: &[u8]) -> Option<usize> {
        let mut depth = 0_u32;
        for (i, byte) in self.text.bytes().enumerate().skip(at).take(FARTHEST) {
            match byte {
                _ if depth == 0 && byte == wanted => return Some(i),
                b'(' | b'[' | b'{' => depth += 1,
                b')' | b']' | b'}' => depth = depth.checked_sub(1)?,
                _ if depth == 0 && stops.contains(&byte) => return None,
                _ => {}
            }
        }
        None
    }

    /// A derivative of one name.
    fn derivative_of_name(&mut self, start: usize) -> Option<Faulty<Tok>> {
        let rest = &self.text[start..];
        let fraction = FRACTIONS.iter().find(|f| rest.starts_with(**f));
        let (above, below, mut end) = match fraction {
            Some(word) => {
                let above_at = self.blanks(start + word.len());
                let inside = self.text[above_at..].strip_prefix('{')?;
                let above = self.differential(self.blanks(above_at + 1), true, true)?;
                let closed = self.blanks(above.end);
                (inside.len() > 1 && self.text[closed..].starts_with('}')).then_some(())?;
                let below_at = self.blanks(closed + 1);
                self.text[below_at..].starts_with('{').then_some(())?;
                let below = self.differential(self.blanks(below_at + 1), false, true)?;
                let stop = self.blanks(below.end);
                self.text[stop..].starts_with('}').then_some(())?;
                (above, below, stop + 1)
            }
            None => {
                let above = self.differential(start, true, false)?;
                let slash = self.blanks(above.end);
                self.text[slash..].starts_with('/').then_some(())?;
                let below_at = self.blanks(slash + 1);
                let bracket = self.text[below_at..].starts_with('(');
                let from = below_at + usize::from(bracket);
                let below = self.differential(from, false, false)?;
                let mut end = below.end;
                if bracket {
                    end = self.blanks(end);
                    self.text[end..].starts_with(')').then_some(())?;
                    end += 1;
                }
                (above, below, end)
            }
        };
        let by = below.parts?;
        let (of, order) = match above.parts {
            Some(of) => (of, above.order),
            // `\frac{d}{dt} x`
            None => {
                fraction?;
                let at = self.blanks(end);
                let Some((of, stop)) = self.differentiated(at) else {
                    return Some(Err(unread(start, end)));
                };
                end = stop;
                (of, above.order)
            }
        };
        if order != below.order || !(1..=9).contains(&order) {
            return None;
        }
        if of.key() == by.key() {
            let fault = Fault::new("the derivative of a name by itself", start, end);
            return Some(Err(fault));
        }
        let declared = |parts: &Parts| name::find(parts, self.symbols).is_some();
        let factor = self.symbols.find("d").is_some();
        // Nobody writes d² as dd.
        let apart = above.spaced || below.spaced || declared(&of) && declared(&by);
        if above.plain && factor && apart && by.key() != "d" {
            return None;
        }
        Some(self.derived(start, end, of, by, order))
    }

    /// The name of a derivative.
    fn derived(
        &mut self,
        start: usize,
        end: usize,
        of: Parts,
        by: Parts,
        order: u32,
    ) -> Faulty<Tok> {
        let dots = match (of.accent, order) {
            ("dot", 1) => Some("ddot"),
            ("vec_dot", 1) => Some("vec_ddot"),
            ("hat_dot", 1) => Some("hat_ddot"),
            ("" | "vec" | "hat", 1) => both(of.accent, "dot"),
            ("" | "vec" | "hat", 2) => both(of.accent, "ddot"),
            _ => None,
        };
        if by.key() == "t"
            && let Some(accent) = dots
        {
            return self.resolve(start, end, Parts { accent, ..of });
        }
        let (above, below) = match order {
            1 => (String::from("d"), String::new()),
            n => (format!("d{n}"), n.to_string()),
        };
        let key = format!("{above}{}/d{}{below}", of.key(), by.key());
        let base = key;
        self.resolve(start, end, Parts::of(base))
    }

    /// A sign of a derivative, its order and what it stands before; the upper one of `\frac{d}{dt}` stands alone. `inside` the
    /// groups of a fraction a space is not seen.
    fn differential(&self, at: usize, above: bool, inside: bool) -> Option<Differential> {
        let (mut end, plain) = self.sign(at)?;
        let mut order = 1;
        if above && let Some((k, stop)) = self.order(end) {
            (order, end) = (k, stop);
        }
        let from = self.blanks(end);
        let macro_behind = self.text[from..].starts_with('\\');
        let spaced = plain && order == 1 && !inside && from > end && !macro_behind;
        let parts = match self.differentiated(from) {
            Some((parts, stop)) => {
                end = stop;
                Some(parts)
            }
            None if above => None,
            None => return None,
        };
        if !above && let Some((k, stop)) = self.order(end) {
            (order, end) = (k, stop);
        }
        Some(Differential {
            order,
            parts,
            end,
            plain,
            spaced,
        })
    }

    /// The byte behind a sign of a derivative, and whether it is a plain d.
    fn sign(&self, at: usize) -> Option<(usize, bool)> {
        let rest = &self.text[at..];
        let Some(sign) = SIGNS.split('|').find(|sign| rest.starts_with(sign)) else {
            return rest.starts_with('d').then_some((at + 1, true));
        };
        let command = sign.ends_with(|c: char| c.is_ascii_alphabetic());
        let longer = rest[sign.len()..].starts_with(|c: char| c.is_ascii_alphabetic());
        (!(command && longer)).then_some((at + sign.len(), false))
    }

    /// The exponent of a sign of a derivative.
    fn order(&self, at: usize) -> Option<(u32, usize)> {
        let rest = &self.text[at..];
        for (sign, order) in [("²", 2), ("³", 3)] {
            if rest.starts_with(sign) {
                return Some((order, at + sign.len()));
            }
        }
        let digits = rest.strip_prefix('^')?.trim_start_matches(' ');
        let inside = digits.strip_prefix('{');
        let digit = inside.unwrap_or(digits).chars().next()?.to_digit(10)?;
        let end = self.text.len() - inside.unwrap_or(digits).len() + 1;
        match inside {
            Some(_) => self.text[end..]
                .starts_with('}')
                .then_some((digit, end + 1)),
            None => Some((digit, end)),
        }
    }

    /// The name behind a sign of a derivative.
    fn differentiated(&self, at: usize) -> Option<(Parts, usize)> {
        let rest = &self.text[at..];
        let run = rest.bytes().take_while(u8::is_ascii_alphabetic).count();
        if run == 0 {
            let (parts, end, _) = name::whole(self.text, at, self.symbols)?;
            return Some((parts, end));
        }
        let greek = (2..=run.min(10)).rev().find(|n| is_greek(&rest[..*n]));
        let (parts, end) = self.beginning(at, greek.unwrap_or(1));
        // `dtheta` ends here; `dxy` is no differential of one name.
        let goes_on = self.text[end..].starts_with(|c: char| c.is_ascii_alphabetic());
        (!goes_on).then_some((parts, end))
    }

    /// `dt` of an equation of differentials.
    pub(super) fn differential_alone(&mut self, start: usize, at: usize) -> Option<Faulty<Tok>> {
        let (mut parts, end) = self.changed(at)?;
        parts.base.insert(0, 'd');
        Some(self.resolve(start, end, parts))
    }

    fn blanks(&self, at: usize) -> usize {
        let rest = &self.text[at..];
        let mut trimmed = rest.trim_start_matches(' ');
        while let Some(behind) = trimmed.strip_prefix("\\,") {
            trimmed = behind.trim_start_matches(' ');
        }
        at + rest.len() - trimmed.len()
    }

    /// `Δp` and `δx` as one name, where Δ is not declared: the sign stands before this byte.
    pub(super) fn change(&mut self, sign: &Parts, start: usize, at: usize) -> Option<Faulty<Tok>> {
        let plain = sign.index.is_empty() && sign.marks.is_empty() && sign.accent.is_empty();
        let capital = match sign.base.as_str() {
            "Delta" => true,
            "delta" => false,
            _ => return None,
        };
        if !plain || self.symbols.find(&sign.base).is_some() {
            return None;
        }
        // A small δ is a name more often: it has to stand right before the other.
        let command = self.text[start..].starts_with('\\');
        let from = if capital || command {
            self.blanks(at)
        } else {
            at
        };
        let word = self.text[from..]
            .bytes()
            .take_while(u8::is_ascii_alphabetic)
            .count();
        if super::token::function(&self.text[from..from + word]).is_some() {
            return None;
        }
        let (mut parts, end) = self.changed(from)?;
        if &*parts.base == "pi" {
            return None;
        }
        parts.base = format!("{}{}", sign.base, parts.base);
        Some(self.resolve(start, end, parts))
    }

    /// The name behind a Δ: the longest word that is declared, a Greek name, or one letter.
    fn changed(&self, at: usize) -> Option<(Parts, usize)> {
        let rest = &self.text[at..];
        let run = rest.bytes().take_while(u8::is_ascii_alphabetic).count();
        if run == 0 {
            let c = rest.chars().next()?;
            let letter = c == '\\' || super::symbols::greek_name(c).is_some();
            let (parts, end, _) = name::whole(self.text, at, self.symbols).filter(|_| letter)?;
            return Some((parts, end));
        }
        let known = |n: &usize| is_greek(&rest[..*n]) || self.symbols.has_base(&rest[..*n]);
        let length = (2..=run.min(40)).rev().find(known).unwrap_or(1);
        Some(self.beginning(at, length))
    }

    /// The name that begins with so many letters.
    fn beginning(&self, at: usize, length: usize) -> (Parts, usize) {
        let mut parts = Parts::of(self.text[at..at + length].to_string());
        let from = name::combining(self.text, at + length, &mut parts);
        let end = name::tail(self.text, from, &mut parts, self.symbols, false, &mut false);
        (parts, end)
    }

    /// Differentials on both sides of an equation, as in `F dt = dp`: each d stands right before a name.
    pub(super) fn differentials(&self) -> bool {
        if !self.symbols.is_open() || self.symbols.find("d").is_some() {
            return false;
        }
        let plain = self.text.replace("\\mathrm{d}", "d");
        let Some((left, right)) = plain.split_once('=') else {
            return false;
        };
        let found = |side: &str| {
            let mut count = 0;
            for (at, _) in side.match_indices('d') {
                let before = side[..at].chars().next_back();
                if before.is_some_and(|c| c.is_alphanumeric() || matches!(c, '_' | '\\' | '{')) {
                    continue;
                }
                let behind = side[at + 1..].chars().next();
                if !behind.is_some_and(|c| c.is_alphabetic() || c == '\\') {
                    return None;
                }
                count += 1;
            }
            Some(count)
        };
        let one = |side: &str| found(side).is_some_and(|count| count > 0);
        one(left) && one(right)
    }
}
