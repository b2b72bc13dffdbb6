//! Reads plain formulas in one pass, straight into values: numbers modulo a prime, polynomials, whatever a [`Builder`] makes.
//!
//! What comes in is text and a table of names; what comes out is a value and an echo of how the text was read. No tree
//! is built. Only formulas of the everyday kind are taken: sums, products, quotients, powers, roots, sine and its kin of
//! angles. Everything else (units, bars, relations, vectors, accents, faults) makes this reader decline, and so does
//! every place where it is not sure to read as [`super::read`] does; tests hold the two together. It never says no.

mod angle;
mod names;
mod word;

pub use angle::Angle;
pub use names::Names;
use names::no_unit;
use word::Word;
pub(crate) use word::keyword;

use crate::expr::Function;

/// Longest formula read here, in bytes.
const LONGEST: usize = 4000;
/// Deepest nesting; the careful reader allows more.
const DEEPEST: u32 = 40;
/// Largest exponent of the everyday kind.
const LARGEST_POWER: i32 = 64;

/// What a formula is read into. Each step may decline by `None`.
pub trait Builder {
    /// A value.
    type Value;
    /// The number `digits`/10^`tens`.
    fn number(&mut self, digits: u64, tens: u32) -> Option<Self::Value>;
    /// The name with this index.
    fn symbol(&mut self, index: usize, name: &[u8]) -> Option<Self::Value>;
    /// The circle constant.
    fn pi(&mut self) -> Option<Self::Value>;
    /// −a.
    fn negative(&mut self, a: Self::Value) -> Option<Self::Value>;
    /// a + b.
    fn sum(&mut self, a: Self::Value, b: Self::Value) -> Option<Self::Value>;
    /// a·b.
    fn product(&mut self, a: Self::Value, b: Self::Value) -> Option<Self::Value>;
    /// a/b.
    fn quotient(&mut self, a: Self::Value, b: Self::Value) -> Option<Self::Value>;
    /// a to the power of `halves`/2, which is not 0.
    fn power(&mut self, a: Self::Value, halves: i32) -> Option<Self::Value>;
    /// Sine, cosine or tangent of an angle, or its reciprocal; `names` are those of the angle's parts.
    fn turn(
        &mut self,
        f: Function,
        reciprocal: bool,
        angle: &Angle,
        names: &[&[u8]],
    ) -> Option<Self::Value>;
}

/// The names a formula is read with.
#[derive(Debug)]
pub enum Table<'a> {
    /// These and no others.
    Known(&'a Names),
    /// Whatever occurs, entered here.
    Collect(&'a mut Names),
}

impl Table<'_> {
    #[inline]
    fn get(&self) -> &Names {
        match self {
            Table::Known(names) => names,
            Table::Collect(names) => names,
        }
    }
}

/// What was read besides the value.
#[derive(Clone, Debug, Default)]
pub struct Seen {
    /// The formula in plain notation, every product with its sign.
    pub echo: String,
    /// The names that occur, as bits by their index.
    pub names: u64,
    /// Those of them that occur under a sine or its kin, and those that occur elsewhere.
    pub turned: u64,
    /// See `turned`.
    pub bare: u64,
    /// Places that people read in another way too.
    pub choices: u32,
}

/// Reads a formula into a value; `None` where it is not of the kind this reader is for.
pub fn stream<B: Builder>(
    text: &str,
    names: Table,
    build: &mut B,
    seen: &mut Seen,
) -> Option<B::Value> {
    if text.len() > LONGEST {
        return None;
    }
    // Dollars around the whole; elsewhere they could part a formula from words.
    let text = text.trim_matches(|c: char| c.is_ascii_whitespace() || c == '$');
    let echo = std::mem::take(&mut seen.echo).into_bytes();
    let mut reader = Reader {
        text: text.as_bytes(),
        at: 0,
        width: 0,
        found: (usize::MAX, Peek::End),
        end: 0,
        before: false,
        depth: 0,
        names,
        build,
        echo,
        seen: Seen::default(),
    };
    reader.echo.clear();
    reader.echo.reserve(2 * text.len());
    let read = reader.sum();
    let whole = read.is_some() && matches!(reader.peek(), Some(Peek::End));
    let (echo, found) = (reader.echo, reader.seen);
    *seen = found;
    // Only ASCII is echoed.
    seen.echo = String::from_utf8(echo).unwrap_or_default();
    read.filter(|_| whole).map(|(value, _)| value)
}

/// How tightly an echoed piece holds together.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd)]
enum Tie {
    Atom,
    /// A number without a point.
    Whole,
    /// In brackets as written.
    Bracket,
    Power,
    Product,
    Sum,
}

/// What comes next.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Peek {
    Plus,
    Minus,
    Times,
    Slash,
    Caret,
    Raised,
    Digit,
    Factor,
    Close(u8),
    End,
}

struct Reader<'a, B: Builder> {
    text: &'a [u8],
    at: usize,
    /// Bytes of the sign that was peeked at.
    width: usize,
    /// What was found at which byte, so that it is looked at once.
    found: (usize, Peek),
    /// Byte after the last piece that was taken; blanks may follow.
    end: usize,
    /// Whether a number or the like stands before, behind which a unit could follow.
    before: bool,
    depth: u32,
    names: Table<'a>,
    build: &'a mut B,
    echo: Vec<u8>,
    seen: Seen,
}

type Piece<B> = (<B as Builder>::Value, Tie);

impl<B: Builder> Reader<'_, B> {
    #[inline]
    fn byte(&self, ahead: usize) -> u8 {
        self.text.get(self.at + ahead).copied().unwrap_or(0)
    }

    fn starts(&self, text: &str) -> bool {
        self.text[self.at..].starts_with(text.as_bytes())
    }

    /// Passes over spaces and what only decorates.
    #[inline]
    fn blanks(&mut self) {
        loop {
            match self.byte(0) {
                b' ' | b'\t' | b'\n' | b'\r' | b'~' => self.at += 1,
                b'\\' => match decoration(&self.text[self.at + 1..]) {
                    Some(length) => self.at += 1 + length,
                    None => break,
                },
                _ => break,
            }
        }
    }

    /// What comes next, its width noted; `None` for what this reader does not know.
    #[inline(always)]
    fn peek(&mut self) -> Option<Peek> {
        if self.found.0 == self.at {
            return Some(self.found.1);
        }
        // Most that comes needs no second look.
        let found = match self.byte(0) {
            b'a'..=b'z' | b'A'..=b'Z' | b'(' => Peek::Factor,
            b'0'..=b'9' => Peek::Digit,
            b')' => {
                self.width = 1;
                Peek::Close(b')')
            }
            _ => self.look()?,
        };
        self.found = (self.at, found);
        Some(found)
    }

    fn look(&mut self) -> Option<Peek> {
        self.blanks();
        if self.at >= self.text.len() {
            return Some(Peek::End);
        }
        self.width = 1;
        let next = self.byte(1);
        Some(match self.byte(0) {
            b'0'..=b'9' => Peek::Digit,
            b'.' if next.is_ascii_digit() => Peek::Digit,
            b'a'..=b'z' | b'A'..=b'Z' | b'(' | b'[' => Peek::Factor,
            b'+' if next != b'-' && next != b'/' => Peek::Plus,
            b'-' if next != b'>' => Peek::Minus,
            b'*' if next == b'*' => {
                self.width = 2;
                Peek::Caret
            }
            b'*' => Peek::Times,
            b'/' if next != b'=' => Peek::Slash,
            b'^' => Peek::Caret,
            close @ (b')' | b']' | b'}') => Peek::Close(close),
            b'\\' => {
                let rest = &self.text[self.at + 1..];
                let length = rest.iter().take_while(|b| b.is_ascii_alphabetic()).count();
                match &rest[..length] {
                    b"cdot" | b"times" => {
                        self.width = 1 + length;
                        Peek::Times
                    }
                    b"" => return None,
                    _ => Peek::Factor,
                }
            }
            0xc2 => {
                self.width = 2;
                match next {
                    0xb7 => Peek::Times,
                    0xb2 | 0xb3 => Peek::Raised,
                    _ => return None,
                }
            }
            0xc3 if next == 0x97 => {
                self.width = 2;
                Peek::Times
            }
            0xce | 0xcf => Peek::Factor,
            0xe2 => {
                self.width = 3;
                match (next, self.byte(2)) {
                    // − ⋅
                    (0x88, 0x92) => Peek::Minus,
                    (0x8b, 0x85) => Peek::Times,
                    // √ ℓ
                    (0x88, 0x9a) | (0x84, 0x93) => Peek::Factor,
                    _ => return None,
                }
            }
            _ => return None,
        })
    }

    #[inline]
    fn take(&mut self) {
        self.at += self.width;
        self.end = self.at;
        self.before = false;
    }

    fn deeper(&mut self) -> Option<()> {
        self.depth += 1;
        (self.depth <= DEEPEST).then_some(())
    }

    fn sum(&mut self) -> Option<Piece<B>> {
        self.deeper()?;
        let sign = self.peek()?;
        if matches!(sign, Peek::Plus | Peek::Minus) {
            self.take();
        }
        let negative = sign == Peek::Minus;
        if negative {
            self.echo.push(b'-');
        }
        let (mut total, mut tie) = self.term()?;
        if negative {
            total = self.build.negative(total)?;
            tie = Tie::Sum;
        }
        loop {
            let minus = match self.peek()? {
                Peek::Plus => false,
                Peek::Minus => true,
                _ => break,
            };
            self.take();
            self.echo
                .extend_from_slice(if minus { b" - " } else { b" + " });
            let (mut term, _) = self.term()?;
            if minus {
                term = self.build.negative(term)?;
            }
            total = self.build.sum(total, term)?;
            tie = Tie::Sum;
        }
        self.depth -= 1;
        Some((total, tie))
    }

    /// Groups tied by signs of multiplication and division, from left to right.
    fn term(&mut self) -> Option<Piece<B>> {
        let (mut total, mut tie) = self.group(None)?;
        // A whole number that ends right here could be half of what follows: `1/2 m v²`.
        let mut number_end = (tie == Tie::Whole).then_some(self.end);
        loop {
            match self.peek()? {
                Peek::Times => {
                    self.take();
                    self.echo.push(b'*');
                    let (factor, _) = self.group(None)?;
                    total = self.build.product(total, factor)?;
                }
                Peek::Slash => {
                    let number = number_end == Some(self.at);
                    // `2.4/s` on its own is a quantity.
                    let rest = &self.text[self.at + 1..];
                    let unit = rest.trim_ascii_start().first();
                    if matches!(self.names, Table::Collect(_))
                        && self.before
                        && unit.is_some_and(|b| b.is_ascii_alphabetic() || *b == b'(')
                        && !no_unit(rest, 0)
                    {
                        return None;
                    }
                    self.take();
                    self.echo.push(b'/');
                    total = self.below(total, number)?;
                }
                _ => return Some((total, tie)),
            }
            tie = Tie::Product;
            number_end = None;
        }
    }

    /// Divides by what stands below a slash: all that follows without a sign, or its first factor alone.
    fn below(&mut self, above: B::Value, number: bool) -> Option<B::Value> {
        let from = self.echo.len();
        self.blanks();
        let close = number && self.at == self.end;
        let (first, tie) = self.factor()?;
        if !self.goes_on()? {
            if tie == Tie::Product {
                self.wrap(from);
            }
            return self.build.quotient(above, first);
        }
        let half = close && tie == Tie::Whole && self.at > self.end;
        self.seen.choices += 1;
        if half || tie == Tie::Bracket {
            if tie == Tie::Product {
                self.wrap(from);
            }
            let total = self.build.quotient(above, first)?;
            self.echo.push(b'*');
            let (rest, _) = self.group(None)?;
            return self.build.product(total, rest);
        }
        let (divisor, _) = self.group(Some((first, tie)))?;
        self.wrap(from);
        self.build.quotient(above, divisor)
    }

    fn wrap(&mut self, from: usize) {
        self.echo.insert(from, b'(');
        self.echo.push(b')');
    }

    /// Whether another factor follows without a sign.
    #[inline]
    fn goes_on(&mut self) -> Option<bool> {
        Some(match self.peek()? {
            // `2 3` is a fault, and `x 3` is rare.
            Peek::Digit => return None,
            Peek::Factor => true,
            _ => false,
        })
    }

    /// Factors side by side.
    #[inline]
    fn group(&mut self, first: Option<Piece<B>>) -> Option<Piece<B>> {
        let (mut total, mut tie) = match first {
            Some(first) => first,
            None => self.factor()?,
        };
        while self.goes_on()? {
            self.echo.push(b'*');
            // `2\frac12` could be a mixed number.
            if tie == Tie::Whole
                && self.starts("\\")
                && self.text[self.at..]
                    .get(1..6)
                    .is_some_and(|w| w.windows(4).any(|w| w == b"frac"))
            {
                return None;
            }
            let (factor, _) = self.factor()?;
            total = self.build.product(total, factor)?;
            tie = Tie::Product;
        }
        Some((total, tie))
    }

    /// A value with its exponent.
    #[inline]
    fn factor(&mut self) -> Option<Piece<B>> {
        let from = self.echo.len();
        let (base, tie) = self.primary()?;
        let Some(halves) = self.exponent()? else {
            return Some((base, tie));
        };
        if tie >= Tie::Power {
            self.wrap(from);
        }
        self.echo_power(halves);
        Some((self.build.power(base, halves)?, Tie::Power))
    }

    /// An exponent in halves, if one follows.
    #[inline(always)]
    fn exponent(&mut self) -> Option<Option<i32>> {
        match self.peek()? {
            Peek::Caret | Peek::Raised => self.exponent_here().map(Some),
            _ => Some(None),
        }
    }

    fn exponent_here(&mut self) -> Option<i32> {
        let halves = match self.peek()? {
            Peek::Caret => {
                self.take();
                self.blanks();
                let open = self.byte(0);
                if !matches!(open, b'(' | b'{') {
                    let negative = self.minus();
                    let k = self.whole()?;
                    2 * if negative { -k } else { k }
                } else {
                    self.at += 1;
                    self.blanks();
                    let negative = self.minus();
                    let mut halves = 2 * self.whole()?;
                    self.blanks();
                    if self.byte(0) == b'/' {
                        self.at += 1;
                        self.blanks();
                        match self.whole()? {
                            1 => {}
                            2 => halves /= 2,
                            _ => return None,
                        }
                        self.blanks();
                    }
                    let close = if open == b'(' { b')' } else { b'}' };
                    if self.byte(0) != close {
                        return None;
                    }
                    self.at += 1;
                    if negative { -halves } else { halves }
                }
            }
            Peek::Raised => {
                let cube = self.byte(1) == 0xb3;
                self.take();
                // ²³ is 23.
                if self.byte(0) == 0xc2 || self.byte(0) == 0xe2 && self.byte(1) == 0x81 {
                    return None;
                }
                if cube { 6 } else { 4 }
            }
            _ => return None,
        };
        (self.before, self.end) = (true, self.at);
        if halves == 0
            || halves.abs() > 2 * LARGEST_POWER
            || matches!(self.peek()?, Peek::Caret | Peek::Raised)
        {
            return None;
        }
        Some(halves)
    }

    fn minus(&mut self) -> bool {
        let minus = self.byte(0) == b'-';
        let long = self.starts("−");
        self.at += if minus {
            1
        } else if long {
            3
        } else {
            0
        };
        minus || long
    }

    fn echo_power(&mut self, halves: i32) {
        self.echo.push(b'^');
        let plain = halves % 2 == 0 && halves > 0;
        if !plain {
            self.echo.push(b'(');
        }
        if halves < 0 {
            self.echo.push(b'-');
        }
        let size = halves.unsigned_abs();
        self.echo_whole(if size.is_multiple_of(2) {
            size / 2
        } else {
            size
        });
        if size % 2 == 1 {
            self.echo.extend_from_slice(b"/2");
        }
        if !plain {
            self.echo.push(b')');
        }
    }

    fn echo_whole(&mut self, k: u32) {
        if k >= 10 {
            self.echo_whole(k / 10);
        }
        self.echo.push(b'0' + (k % 10) as u8);
    }

    /// A whole number of few digits behind which no fraction or power of ten follows.
    #[inline]
    fn whole(&mut self) -> Option<i32> {
        let start = self.at;
        let mut value = 0;
        while self.byte(0).is_ascii_digit() && self.at < start + 4 {
            value = value * 10 + i32::from(self.byte(0) - b'0');
            self.at += 1;
        }
        self.end = self.at;
        (self.at > start && self.number_ends()).then_some(value)
    }

    /// Whether a number really ends here.
    #[inline]
    fn number_ends(&self) -> bool {
        match self.byte(0) {
            b'0'..=b'9' | b'.' | b',' => false,
            b'e' | b'E' => {
                let next = self.byte(1);
                !next.is_ascii_digit() && !matches!(next, b'+' | b'-')
            }
            b'{' => self.byte(1) != b',',
            _ => true,
        }
    }

    fn number(&mut self) -> Option<Piece<B>> {
        let start = self.at;
        let (mut value, mut tens) = (0u64, None);
        loop {
            match self.byte(0) {
                digit @ b'0'..=b'9' => {
                    value = value * 10 + u64::from(digit - b'0');
                    tens = tens.map(|t: u32| t + 1);
                }
                b'.' if tens.is_none() && self.byte(1).is_ascii_digit() => tens = Some(0),
                _ => break,
            }
            self.at += 1;
            if self.at > start + 18 {
                return None;
            }
        }
        if !self.number_ends() {
            return None;
        }
        self.echo.extend_from_slice(&self.text[start..self.at]);
        (self.before, self.end) = (true, self.at);
        let tie = if tens.is_none() {
            Tie::Whole
        } else {
            Tie::Atom
        };
        Some((self.build.number(value, tens.unwrap_or(0))?, tie))
    }

    #[inline]
    fn primary(&mut self) -> Option<Piece<B>> {
        match self.peek()? {
            Peek::Digit => self.number(),
            Peek::Factor => match self.byte(0) {
                open @ (b'(' | b'[') => {
                    let value = self.bracket(if open == b'(' { b')' } else { b']' })?;
                    Some((value, Tie::Bracket))
                }
                _ => match self.word(false)? {
                    Word::Name(index) => Some((self.named(index)?, Tie::Atom)),
                    Word::Pi => {
                        self.echo.extend_from_slice(b"pi");
                        self.before = true;
                        Some((self.build.pi()?, Tie::Atom))
                    }
                    Word::Root { tex } => self.root(tex),
                    Word::Fraction => self.fraction(),
                    Word::Call(function, reciprocal) => self.call(function, reciprocal),
                },
            },
            _ => None,
        }
    }

    #[inline]
    fn named(&mut self, index: usize) -> Option<B::Value> {
        self.before = false;
        self.seen.names |= 1 << index;
        self.seen.bare |= 1 << index;
        let name = self.names.get().echo(index);
        self.build.symbol(index, name)
    }

    /// What stands in brackets; the opening one is here.
    fn bracket(&mut self, close: u8) -> Option<B::Value> {
        self.at += 1;
        self.before = false;
        self.echo.push(b'(');
        let (value, _) = self.sum()?;
        self.echo.push(b')');
        self.closed(close)?;
        Some(value)
    }

    fn closed(&mut self, close: u8) -> Option<()> {
        if self.peek()? != Peek::Close(close) {
            return None;
        }
        self.take();
        self.before = true;
        Some(())
    }

    /// One argument of a LaTeX command: a group or a digit. It is echoed without brackets.
    fn argument(&mut self) -> Option<Piece<B>> {
        self.blanks();
        match self.byte(0) {
            b'{' => {
                self.at += 1;
                self.before = false;
                let piece = self.sum()?;
                self.closed(b'}')?;
                // `{v}_1` is one name.
                if matches!(self.byte(0), b'_' | b'\'') || self.starts("′") {
                    return None;
                }
                Some(piece)
            }
            digit @ b'0'..=b'9' => {
                self.at += 1;
                (self.before, self.end) = (true, self.at);
                self.echo.push(digit);
                let value = self.build.number(u64::from(digit - b'0'), 0)?;
                Some((value, Tie::Whole))
            }
            _ => None,
        }
    }

    fn fraction(&mut self) -> Option<Piece<B>> {
        self.deeper()?;
        let from = self.echo.len();
        let (above, tie) = self.argument()?;
        if tie == Tie::Sum {
            self.wrap(from);
        }
        self.echo.push(b'/');
        let from = self.echo.len();
        let (below, tie) = self.argument()?;
        if tie >= Tie::Product {
            self.wrap(from);
        }
        self.depth -= 1;
        Some((self.build.quotient(above, below)?, Tie::Product))
    }

    fn root(&mut self, tex: bool) -> Option<Piece<B>> {
        self.deeper()?;
        self.before = false;
        self.echo.extend_from_slice(b"sqrt");
        if self.byte(0) == b'[' {
            return None;
        }
        let from = self.echo.len();
        let (inner, tie) = if tex {
            self.argument()?
        } else {
            self.primary()?
        };
        if tie != Tie::Bracket || tex {
            self.wrap(from);
        }
        self.depth -= 1;
        if !tex && tie != Tie::Bracket && self.goes_on()? {
            self.seen.choices += 1;
        }
        Some((self.build.power(inner, 1)?, Tie::Atom))
    }

    /// A function: its own exponent, then its argument.
    fn call(&mut self, function: Function, reciprocal: bool) -> Option<Piece<B>> {
        self.deeper()?;
        self.before = false;
        let exponent = self.exponent()?;
        if exponent.is_some_and(|k| k < 0) {
            return None;
        }
        let name: &[u8] = match (function, reciprocal) {
            (Function::Sin, false) => b"sin",
            (Function::Cos, false) => b"cos",
            (_, false) => b"tan",
            (Function::Sin, true) => b"csc",
            (Function::Cos, true) => b"sec",
            (_, true) => b"cot",
        };
        self.echo.extend_from_slice(name);
        self.echo.push(b'(');
        let angle = self.angle()?;
        self.echo.push(b')');
        self.depth -= 1;
        let mut spelled: [&[u8]; 4] = [b""; 4];
        for (name, (index, _)) in spelled.iter_mut().zip(angle.parts()) {
            *name = self.names.get().echo(index);
        }
        let mut value = self.build.turn(function, reciprocal, &angle, &spelled)?;
        for (index, _) in angle.parts() {
            self.seen.names |= 1 << index;
            self.seen.turned |= 1 << index;
        }
        match exponent {
            None => Some((value, Tie::Atom)),
            Some(halves) => {
                self.echo_power(halves);
                value = self.build.power(value, halves)?;
                Some((value, Tie::Power))
            }
        }
    }
}

/// Length of a command that only decorates, without its backslash.
fn decoration(rest: &[u8]) -> Option<usize> {
    match rest.first()? {
        b',' | b';' | b':' | b'!' | b' ' => return Some(1),
        b'l' | b'r' | b'q' | b'd' => {}
        _ => return None,
    }
    let length = rest.iter().take_while(|b| b.is_ascii_alphabetic()).count();
    matches!(
        &rest[..length],
        b"left" | b"right" | b"quad" | b"qquad" | b"displaystyle"
    )
    .then_some(length)
}

#[cfg(test)]
mod tests;
