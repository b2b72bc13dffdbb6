//! Numbers and exponents.

use super::Builder;
use super::reader::{Peek, Piece, Reader, Tie};

/// Largest exponent of the everyday kind.
const LARGEST_POWER: i32 = 64;

impl<B: Builder> Reader<'_, B> {
    /// An exponent in halves, if one follows.
    #[inline(always)]
    pub(super) fn exponent(&mut self) -> Option<Option<i32>> {
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

    pub(super) fn echo_power(&mut self, halves: i32) {
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
    pub(super) fn whole(&mut self) -> Option<i32> {
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

    pub(super) fn number(&mut self) -> Option<Piece<B>> {
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
}
