//! Lines of a batch of the plainest kind, cut into their fields without building values.
//!
//! In: a JSON object with `id`, `expected`, `answer` and perhaps `symbols`, as text; out: slices of it. Any other field, an
//! escape other than `\\`, and whatever is no JSON make it decline; [`super::entry`] then reads the line and says what is
//! wrong with it.

use std::borrow::Cow;

/// The fields of a line.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Plain<'a> {
    /// The `id` as written.
    pub id: &'a str,
    /// What stands between the quotes of `expected`.
    pub expected: &'a str,
    /// The answer.
    pub answer: Cow<'a, str>,
    /// The declarations as written; empty where there are none.
    pub symbols: &'a str,
}

/// Cuts a line.
pub fn plain(line: &str) -> Option<Plain<'_>> {
    let mut cut = Cut {
        text: line,
        bytes: line.as_bytes(),
        at: 0,
    };
    let (mut id, mut expected, mut answer, mut symbols) = (None, None, None, None);
    cut.expect(b'{')?;
    loop {
        cut.blanks();
        let name = cut.name()?;
        cut.expect(b':')?;
        cut.blanks();
        let twice = match name {
            Name::Id => id.replace(cut.id()?).is_some(),
            Name::Expected => expected.replace(cut.string()?).is_some(),
            Name::Answer => answer.replace(cut.string()?).is_some(),
            Name::Symbols => symbols.replace(cut.object()?).is_some(),
        };
        if twice {
            return None;
        }
        cut.blanks();
        match cut.next()? {
            b',' => {}
            b'}' => break,
            _ => return None,
        }
    }
    cut.blanks();
    let answer = answer?;
    let whole = cut.at == cut.bytes.len();
    whole.then_some(Plain {
        id: id.unwrap_or("null"),
        expected: expected?,
        answer: match answer.contains('\\') {
            false => Cow::Borrowed(answer),
            // Strings with other escapes were declined.
            true => Cow::Owned(answer.replace("\\\\", "\\")),
        },
        symbols: symbols.unwrap_or(""),
    })
}

/// The fields of a plain line.
#[derive(Clone, Copy)]
enum Name {
    Id,
    Expected,
    Answer,
    Symbols,
}

struct Cut<'a> {
    text: &'a str,
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Cut<'a> {
    #[inline]
    fn blanks(&mut self) {
        while let Some(b' ' | b'\t' | b'\r' | b'\n') = self.bytes.get(self.at) {
            self.at += 1;
        }
    }

    #[inline]
    fn next(&mut self) -> Option<u8> {
        let byte = *self.bytes.get(self.at)?;
        self.at += 1;
        Some(byte)
    }

    #[inline]
    fn expect(&mut self, byte: u8) -> Option<()> {
        self.blanks();
        (self.next()? == byte).then_some(())
    }

    #[inline]
    fn name(&mut self) -> Option<Name> {
        let rest = &self.bytes[self.at..];
        let (name, length) = match rest.get(1)? {
            b'i' if rest.starts_with(b"\"id\"") => (Name::Id, 4),
            b'e' if rest.starts_with(b"\"expected\"") => (Name::Expected, 10),
            b'a' if rest.starts_with(b"\"answer\"") => (Name::Answer, 8),
            b's' if rest.starts_with(b"\"symbols\"") => (Name::Symbols, 9),
            _ => return None,
        };
        self.at += length;
        Some(name)
    }

    /// What stands between quotes; the only escape in it is `\\`.
    #[inline]
    fn string(&mut self) -> Option<&'a str> {
        self.expect(b'"')?;
        let start = self.at;
        loop {
            self.at = special(self.bytes, self.at)?;
            match self.bytes[self.at] {
                b'"' => break,
                b'\\' if self.bytes.get(self.at + 1) == Some(&b'\\') => self.at += 2,
                _ => return None,
            }
        }
        let inside = &self.text[start..self.at];
        self.at += 1;
        Some(inside)
    }

    /// A whole number, a word of JSON or a string without escapes, with its quotes.
    fn id(&mut self) -> Option<&'a str> {
        let start = self.at;
        if self.bytes.get(start) == Some(&b'"') {
            let inside = self.string()?;
            return (!inside.contains('\\')).then(|| &self.text[start..self.at]);
        }
        if self.text[start..].starts_with("null") {
            self.at += 4;
            return Some("null");
        }
        while self.bytes.get(self.at).is_some_and(u8::is_ascii_digit) {
            self.at += 1;
        }
        let digits = &self.text[start..self.at];
        let whole = digits.len() == 1 || !digits.is_empty() && !digits.starts_with('0');
        whole.then_some(digits)
    }

    /// An object up to its closing brace. Whether it is one is found when it is read.
    fn object(&mut self) -> Option<&'a str> {
        let start = self.at;
        self.expect(b'{')?;
        let mut depth = 1;
        while depth > 0 {
            match self.next()? {
                b'{' => depth += 1,
                b'}' => depth -= 1,
                b'"' => {
                    self.at -= 1;
                    self.string()?;
                }
                _ => {}
            }
        }
        Some(&self.text[start..self.at])
    }
}

/// Place of the next quote, backslash or control character; eight bytes at a time.
#[inline]
fn special(bytes: &[u8], mut at: usize) -> Option<usize> {
    const ONES: u64 = 0x0101_0101_0101_0101;
    const HIGH: u64 = 0x8080_8080_8080_8080;
    // High bits where a byte is zero; exact up to the first such byte, which is all that is asked.
    let zero = |x: u64| x.wrapping_sub(ONES) & !x & HIGH;
    while let Some(eight) = bytes.get(at..at + 8) {
        let mut word = [0; 8];
        word.copy_from_slice(eight);
        let word = u64::from_le_bytes(word);
        let control = word.wrapping_sub(ONES * 0x20) & !word & HIGH;
        let found = zero(word ^ (ONES * u64::from(b'"')))
            | zero(word ^ (ONES * u64::from(b'\\')))
            | control;
        if found != 0 {
            return Some(at + (found.trailing_zeros() / 8) as usize);
        }
        at += 8;
    }
    let rest = bytes.get(at..)?;
    rest.iter()
        .position(|b| *b < 0x20 || matches!(b, b'"' | b'\\'))
        .map(|found| at + found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::Value;

    #[test]
    fn a_plain_line_is_cut_as_json_reads_it() {
        let lines = [
            r#"{"id": 17, "expected": "3*v/(2*l)", "answer": "1.5 v/l"}"#,
            r#"{"expected":"m","answer":"\\frac{m}{2}","id":"a-1"}"#,
            r#" { "id" : null , "answer" : "θ²" , "expected" : "theta" , "symbols" : {"m": {"domain": "}"}} } "#,
            r#"{"id":0,"expected":"","answer":""}"#,
        ];
        for line in lines {
            let cut = plain(line).expect("a plain line");
            let read: Value = serde_json::from_str(line).expect("JSON");
            assert_eq!(cut.id, read["id"].to_string());
            assert_eq!(&*cut.answer, read["answer"].as_str().expect("a text"));
            assert_eq!(
                cut.expected.replace("\\\\", "\\"),
                read["expected"].as_str().expect("a text")
            );
            if !cut.symbols.is_empty() {
                let symbols: Value = serde_json::from_str(cut.symbols).expect("JSON");
                assert_eq!(symbols, read["symbols"]);
            }
        }
    }

    #[test]
    fn what_is_no_plain_line_is_left_to_the_careful_reader() {
        let lines = [
            "",
            "[]",
            "{}",
            r#"{"id":1,"answer":"x"}"#,
            r#"{"id":01,"expected":"x","answer":"x"}"#,
            r#"{"id":1,"expected":"x","answer":"\u0041"}"#,
            r#"{"id":1,"expected":"x","answer":"a\"b"}"#,
            "{\"id\":1,\"expected\":\"x\",\"answer\":\"a\tb\"}",
            r#"{"id":1,"expected":"x","answer":"x","answer":"y"}"#,
            r#"{"id":1,"expected":"x","answer":3}"#,
            r#"{"id":1,"expected":"x","answer":"x","tolerance":"2%"}"#,
            r#"{"id":1,"expected":"x","answer":"x"} {}"#,
            r#"{"id":1.0,"expected":"x","answer":"x"}"#,
            r#"{"id":1,"expected":"x","answer":"x",}"#,
        ];
        for line in lines {
            assert_eq!(plain(line), None, "{line}");
        }
    }

    #[test]
    fn special_bytes_are_found_wherever_they_stand() {
        for length in 0..40usize {
            for special_byte in [b'"', b'\\', 0x1f, 0, b'\n'] {
                let mut text = vec![b'\xc3'; length];
                text.extend([special_byte, b'"', 0x7f, 0x80]);
                assert_eq!(special(&text, 0), Some(length));
            }
            assert_eq!(special(&vec![0xff; length], 0), None);
        }
    }
}
