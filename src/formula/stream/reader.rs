//! Where a reader stands in its text, and what comes next there.

use super::{Builder, Seen, Table};

/// Deepest nesting; the careful reader allows more.
const DEEPEST: u32 = 40;

/// How tightly an echoed piece holds together.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd)]
pub(super) enum Tie {
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
pub(super) enum Peek {
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

pub(super) struct Reader<'a, B: Builder> {
    pub(super) text: &'a [u8],
    pub(super) at: usize,
    /// Bytes of the sign that was peeked at.
    pub(super) width: usize,
    /// What was found at which byte, so that it is looked at once.
    pub(super) found: (usize, Peek),
    /// Byte after the last piece that was taken; blanks may follow.
    pub(super) end: usize,
    /// Whether a number or the like stands before, behind which a unit could follow.
    pub(super) before: bool,
    pub(super) depth: u32,
    pub(super) names: Table<'a>,
    pub(super) build: &'a mut B,
    pub(super) echo: Vec<u8>,
    pub(super) seen: Seen,
}

pub(super) type Piece<B> = (<B as Builder>::Value, Tie);

impl<B: Builder> Reader<'_, B> {
    #[inline]
    pub(super) fn byte(&self, ahead: usize) -> u8 {
        self.text.get(self.at + ahead).copied().unwrap_or(0)
    }

    pub(super) fn starts(&self, text: &str) -> bool {
        self.text[self.at..].starts_with(text.as_bytes())
    }

    /// Passes over spaces and what only decorates.
    #[inline]
    pub(super) fn blanks(&mut self) {
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
    pub(super) fn peek(&mut self) -> Option<Peek> {
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
                    b"cdot" => {
                        self.width = 1 + length;
                        Peek::Times
                    }
                    b"times" => {
                        self.width = 1 + length;
                        return self.times();
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
                return self.times();
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

    /// × before a number; between symbols it could be a cross product.
    fn times(&self) -> Option<Peek> {
        let behind = self.text[self.at + self.width..].trim_ascii_start().first();
        behind
            .is_some_and(u8::is_ascii_digit)
            .then_some(Peek::Times)
    }

    #[inline]
    pub(super) fn take(&mut self) {
        self.at += self.width;
        self.end = self.at;
        self.before = false;
    }

    pub(super) fn deeper(&mut self) -> Option<()> {
        self.depth += 1;
        (self.depth <= DEEPEST).then_some(())
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
