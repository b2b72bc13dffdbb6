//! JSON with comments and trailing commas, read into a tree in which every piece knows its place in the text.
//!
//! In: the text of a scene file. Out: a [`Node`], or the first place where the text stops being JSON. It knows nothing of
//! scenes. It is written here because the crates at hand lose what a helpful message needs: `serde_json` drops the places
//! and keeps the last of two equal keys, `jsonc-parser` lets a missing comma pass and recurses as deep as the text does.
//! Numbers stay text: 0.1 has to arrive as 1/10.

use std::borrow::Cow;

use super::fault::{Fault, Span};

/// A JSON value and where it stands.
pub(super) struct Node<'t> {
    pub span: Span,
    pub value: Value<'t>,
}

/// What a JSON value is; numbers as written.
pub(super) enum Value<'t> {
    Null,
    Bool(bool),
    Number(&'t str),
    Text(Cow<'t, str>),
    List(Vec<Node<'t>>),
    Object(Vec<Entry<'t>>),
}

/// A key with its value.
pub(super) struct Entry<'t> {
    pub key: Cow<'t, str>,
    pub key_span: Span,
    pub node: Node<'t>,
}

impl Node<'_> {
    /// What stands here, in words.
    pub fn kind(&self) -> &'static str {
        match &self.value {
            Value::Null => "null",
            Value::Bool(_) => "true or false",
            Value::Number(_) => "a number",
            Value::Text(_) => "a text",
            Value::List(_) => "a list",
            Value::Object(_) => "an object",
        }
    }

    /// The JSON pointer of the innermost value that contains `span`.
    pub fn pointer_to(&self, span: Span) -> String {
        let mut pointer = String::new();
        let mut node = self;
        loop {
            let inner = match &node.value {
                Value::List(items) => items
                    .iter()
                    .enumerate()
                    .find(|(_, n)| n.span.contains(span))
                    .map(|(i, n)| (i.to_string(), n)),
                Value::Object(entries) => entries
                    .iter()
                    .find(|e| e.key_span.to(e.node.span).contains(span))
                    .map(|e| (e.key.replace('~', "~0").replace('/', "~1"), &e.node)),
                _ => None,
            };
            let Some((step, next)) = inner else {
                return pointer;
            };
            pointer.push('/');
            pointer.push_str(&step);
            node = next;
        }
    }
}

/// Deepest nesting that is read. A scene needs eight levels or so.
const DEPTH: usize = 64;

/// Quotes that JSON has not.
const ODD: [char; 7] = ['\'', '`', '‘', '’', '“', '”', '„'];
const STRAIGHT: &str = "names and texts stand in straight double quotes: \"title\"";

/// Reads a whole text as one JSON value.
pub(super) fn parse(text: &str) -> Result<Node<'_>, Fault> {
    let mut parser = Parser { text, at: 0 };
    if text.starts_with('\u{feff}') {
        parser.at = '\u{feff}'.len_utf8();
    }
    parser.skip_blank()?;
    let node = parser.value(0)?;
    parser.skip_blank()?;
    match parser.peek() {
        None => Ok(node),
        Some(_) => Err(parser.fault_here("the scene ends here, but text follows")),
    }
}

struct Parser<'t> {
    text: &'t str,
    at: usize,
}

impl<'t> Parser<'t> {
    fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    fn rest(&self) -> &'t str {
        &self.text[self.at..]
    }

    /// A fault at the next character, or at the end of the text.
    fn fault_here(&self, message: &str) -> Fault {
        let width = self.rest().chars().next().map_or(0, char::len_utf8);
        Fault::new(Span::new(self.at, self.at + width), message)
    }

    fn skip_blank(&mut self) -> Result<(), Fault> {
        loop {
            match self.peek() {
                Some(b' ' | b'\t' | b'\n' | b'\r') => self.at += 1,
                Some(b'/') if self.rest().starts_with("//") => {
                    self.at += self.rest().find('\n').unwrap_or(self.rest().len());
                }
                Some(b'/') if self.rest().starts_with("/*") => match self.rest().find("*/") {
                    // "/*/" opens a comment without closing it.
                    Some(end) if end >= 2 => self.at += end + 2,
                    Some(_) => match self.rest()[2..].find("*/") {
                        Some(end) => self.at += end + 4,
                        None => return Err(self.fault_here("this comment is never closed")),
                    },
                    None => return Err(self.fault_here("this comment is never closed")),
                },
                _ => return Ok(()),
            }
        }
    }

    fn value(&mut self, depth: usize) -> Result<Node<'t>, Fault> {
        let start = self.at;
        let value = match self.peek() {
            None => return Err(self.fault_here("expected a value, found the end of the text")),
            Some(b'{' | b'[') if depth >= DEPTH => {
                return Err(self.fault_here(&format!("nested more than {DEPTH} deep")));
            }
            Some(b'{') => self.object(depth)?,
            Some(b'[') => self.list(depth)?,
            Some(b'"') => Value::Text(self.string()?),
            Some(b'-' | b'0'..=b'9') => Value::Number(self.number()?),
            Some(_) => self.word()?,
        };
        Ok(Node {
            span: Span::new(start, self.at),
            value,
        })
    }

    fn object(&mut self, depth: usize) -> Result<Value<'t>, Fault> {
        let entry = |own: &mut Self| {
            if own.peek() != Some(b'"') {
                return Err(own.unquoted("expected a name in double quotes, or }"));
            }
            let start = own.at;
            let key = own.string()?;
            let key_span = Span::new(start, own.at);
            own.skip_blank()?;
            if own.peek() != Some(b':') {
                let fault = own.fault_here("expected a colon after the name");
                return Err(match key.contains(ODD) {
                    true => fault.hint(STRAIGHT),
                    false => fault,
                });
            }
            own.at += 1;
            own.skip_blank()?;
            Ok(Entry {
                key,
                key_span,
                node: own.value(depth + 1)?,
            })
        };
        self.items(["{", "}"], entry).map(Value::Object)
    }

    fn list(&mut self, depth: usize) -> Result<Value<'t>, Fault> {
        let items = self.items(["[", "]"], |own| own.value(depth + 1));
        items.map(Value::List)
    }

    /// What stands between two brackets with commas, one behind the last allowed.
    fn items<T>(
        &mut self,
        [from, to]: [&str; 2],
        one: impl Fn(&mut Self) -> Result<T, Fault>,
    ) -> Result<Vec<T>, Fault> {
        let open = self.at;
        let mut out = Vec::new();
        self.at += 1;
        loop {
            self.skip_blank()?;
            match self.peek() {
                Some(end) if to.as_bytes() == [end] => break,
                None => return Err(never_closed(open, from, to)),
                Some(_) => out.push(one(self)?),
            }
            self.skip_blank()?;
            match self.peek() {
                Some(b',') => self.at += 1,
                Some(end) if to.as_bytes() == [end] => break,
                None => return Err(never_closed(open, from, to)),
                Some(_) => {
                    let message = format!("expected a comma or {to} after the value");
                    return Err(self.fault_here(&message));
                }
            }
        }
        self.at += 1;
        Ok(out)
    }

    fn string(&mut self) -> Result<Cow<'t, str>, Fault> {
        let open = self.at;
        self.at += 1;
        let start = self.at;
        let mut decoded: Option<String> = None;
        loop {
            let plain = self.rest().bytes().take_while(|b| is_plain(*b)).count();
            if let Some(text) = &mut decoded {
                text.push_str(&self.rest()[..plain]);
            }
            self.at += plain;
            let Some(c) = self.rest().chars().next() else {
                return Err(
                    Fault::new(Span::new(open, open + 1), "this text is never closed")
                        .hint("add a \" at its end"),
                );
            };
            match c {
                '"' => {
                    let raw = &self.text[start..self.at];
                    self.at += 1;
                    return Ok(decoded.map_or(Cow::Borrowed(raw), Cow::Owned));
                }
                '\\' => {
                    let mut text = decoded
                        .take()
                        .unwrap_or_else(|| self.text[start..self.at].to_owned());
                    text.push(self.escape()?);
                    decoded = Some(text);
                    continue;
                }
                '\n' | '\r' => {
                    let span = Span::new(open, self.at);
                    let fault = Fault::new(span, "this text does not end on its line");
                    return Err(match self.text[open..self.at].contains(ODD) {
                        true => fault.hint(STRAIGHT),
                        false => fault.hint("close it with \", or write \\n for a line break"),
                    });
                }
                c if c.is_control() && c != '\t' => {
                    return Err(self.fault_here("a control character stands in a text"));
                }
                c => {
                    if let Some(text) = &mut decoded {
                        text.push(c);
                    }
                    self.at += c.len_utf8();
                }
            }
        }
    }

    /// Reads one escape, its backslash included.
    fn escape(&mut self) -> Result<char, Fault> {
        let start = self.at;
        let simple = match self.text.as_bytes().get(start + 1) {
            Some(b'"') => '"',
            Some(b'\\') => '\\',
            Some(b'/') => '/',
            Some(b'b') => '\u{8}',
            Some(b'f') => '\u{c}',
            Some(b'n') => '\n',
            Some(b'r') => '\r',
            Some(b't') => '\t',
            Some(b'u') => {
                let first = self.hex(start)?;
                let code = match first {
                    // Two halves of one character beyond the first 65536.
                    0xd800..=0xdbff if self.rest().starts_with("\\u") => {
                        let second = self.hex(self.at)?;
                        0x10000 + ((first - 0xd800) << 10) + (second.wrapping_sub(0xdc00) & 0x3ff)
                    }
                    code => code,
                };
                return char::from_u32(code).ok_or_else(|| {
                    Fault::new(Span::new(start, self.at), "this escape names no character")
                });
            }
            _ => {
                return Err(Fault::new(
                    Span::new(start, start + 1),
                    "this backslash starts no known escape",
                )
                .hint("a backslash in LaTeX is written twice: \"\\\\ell\""));
            }
        };
        self.at += 2;
        Ok(simple)
    }

    /// The four hexadecimal digits after `\u` at `start`.
    fn hex(&mut self, start: usize) -> Result<u32, Fault> {
        let digits = self.text.get(start + 2..start + 6);
        let code = digits
            .filter(|d| d.bytes().all(|b| b.is_ascii_hexdigit()))
            .and_then(|d| u32::from_str_radix(d, 16).ok());
        self.at = start + 6;
        code.ok_or_else(|| {
            Fault::new(
                Span::new(start, start + 2),
                "\\u needs four hexadecimal digits",
            )
        })
    }

    fn number(&mut self) -> Result<&'t str, Fault> {
        let start = self.at;
        if self.peek() == Some(b'-') {
            self.at += 1;
        }
        let integer = self.digits()?;
        if integer.len() > 1 && integer.starts_with('0') {
            return Err(
                Fault::new(Span::new(start, self.at), "a number does not start with 0")
                    .hint("JSON writes 7, not 07; formulas stand in quotes"),
            );
        }
        if self.peek() == Some(b'.') {
            self.at += 1;
            self.digits()?;
        }
        if let Some(b'e' | b'E') = self.peek() {
            self.at += 1;
            if let Some(b'+' | b'-') = self.peek() {
                self.at += 1;
            }
            self.digits()?;
        }
        match self.rest().chars().next() {
            Some(c)
                if c.is_alphanumeric()
                    || "._+-*/^".contains(c)
                        && !self.rest().starts_with("//")
                        && !self.rest().starts_with("/*") =>
            {
                Err(Fault::new(
                    Span::new(start, self.at + c.len_utf8()),
                    "this is more than a number",
                )
                .hint("formulas stand in quotes: \"2*l\", \"pi/6\""))
            }
            _ => Ok(&self.text[start..self.at]),
        }
    }

    fn digits(&mut self) -> Result<&'t str, Fault> {
        let count = self.rest().bytes().take_while(u8::is_ascii_digit).count();
        if count == 0 {
            return Err(self.fault_here("expected a digit"));
        }
        let digits = &self.rest()[..count];
        self.at += count;
        Ok(digits)
    }

    /// The letters that stand next.
    fn letters(&self) -> &'t str {
        let end = self.rest().find(|c: char| !c.is_alphanumeric() && c != '_');
        &self.rest()[..end.unwrap_or(self.rest().len())]
    }

    /// A fault at what stands without quotes, or in those of other languages.
    fn unquoted(&self, message: &str) -> Fault {
        let word = self.letters();
        if word.is_empty() {
            let fault = self.fault_here(message);
            return match self.rest().starts_with(ODD) {
                true => fault.hint(STRAIGHT),
                false => fault,
            };
        }
        let span = Span::new(self.at, self.at + word.len());
        let small = word.to_lowercase();
        let (message, hint) = match small.as_str() {
            "true" | "false" => (
                format!("`{word}` is no word of JSON"),
                format!("write `{small}`"),
            ),
            "none" | "nil" | "undefined" => (
                format!("`{word}` is no word of JSON"),
                String::from("leave out what is not there"),
            ),
            _ => (message.to_owned(), format!("write \"{word}\"")),
        };
        Fault::new(span, message).hint(hint)
    }

    fn word(&mut self) -> Result<Value<'t>, Fault> {
        let word = self.letters();
        let value = match word {
            "true" => Value::Bool(true),
            "false" => Value::Bool(false),
            "null" => Value::Null,
            "" => return Err(self.unquoted("expected a value")),
            _ => return Err(self.unquoted(&format!("`{word}` stands without quotes"))),
        };
        self.at += word.len();
        Ok(value)
    }
}

/// Whether a byte of a text stands for itself or is a later one of a character: it ends no text, begins no escape and no
/// control character, of which those beyond ASCII begin with 0xc2.
fn is_plain(byte: u8) -> bool {
    !matches!(byte, b'"' | b'\\' | ..0x20 | 0x7f | 0xc2)
}

fn never_closed(open: usize, bracket: &str, closing: &str) -> Fault {
    Fault::new(
        Span::new(open, open + 1),
        format!("this {bracket} is never closed"),
    )
    .hint(format!("add the missing {closing}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_and_trailing_commas_are_read_and_a_missing_comma_is_not() {
        assert!(parse("{ // c\n \"a\": [1, 2,], /* d */ \"b\": 0.1, }").is_ok());
        for text in [
            "{\"a\": 1 \"b\": 2}",
            "[1 2]",
            "{\"a\" 1}",
            "{a: 1}",
            "[01]",
            "[1.]",
            "[--1]",
            "\"a",
            "{",
            "",
            "[1]x",
            "/*/",
            "[tru]",
            "[2*l]",
        ] {
            assert!(parse(text).is_err(), "{text}");
        }
    }

    #[test]
    fn escapes_are_decoded() {
        let node = parse(r#""\\ell \u03b8 \ud835\udc65""#);
        assert!(matches!(node.map(|n| n.value), Ok(Value::Text(t)) if t == "\\ell θ 𝑥"));
        assert!(
            parse(r#""\ud835""#).is_err()
                && parse(r#""\ell""#).is_err()
                && parse("\"\\u12").is_err()
        );
    }

    #[test]
    fn a_pointer_names_the_innermost_value() {
        let text = r#"{"a": {"b/c": [1, "xyz"]}}"#;
        let at = text.find("yz").unwrap_or(0);
        let pointer = parse(text).map(|n| n.pointer_to(Span::new(at, at + 1)));
        assert!(matches!(pointer.as_deref(), Ok("/a/b~1c/1")));
    }

    #[test]
    fn nesting_is_bounded() {
        assert!(parse(&"[".repeat(1_000_000)).is_err());
        assert!(parse(&format!("{}{}", "[".repeat(60), "]".repeat(60))).is_ok());
    }
}
