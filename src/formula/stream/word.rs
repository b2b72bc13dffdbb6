//! Words of a plain formula: names with their indices, functions, commands.

use super::names::{Key, no_unit};
use super::reader::Reader;
use super::{Builder, Ratio, Table};
use crate::expr::Function;
use crate::formula::symbols::{ACCENTS, greek_name};

/// Most letters in a row that are looked at.
const RUN: usize = 24;

/// Bytes behind a letter that could belong to its name or to a longer word.
const GOES_ON: [bool; 256] = {
    let mut set = [false; 256];
    let mut byte = 0;
    while byte < 256 {
        let b = byte as u8;
        set[byte] = b.is_ascii_alphanumeric() || matches!(b, b'_' | b'\'' | 0xcc | 0xe2);
        byte += 1;
    }
    set
};

/// What a word is.
pub(super) enum Word {
    Name(usize),
    Pi,
    Root { tex: bool },
    Fraction,
    Call(Ratio),
}

/// A word that means something by itself.
#[derive(Clone, Copy)]
pub(crate) enum Keyword {
    Greek,
    Pi,
    Root,
    Call(Ratio),
    /// For the careful reader.
    Other,
}

/// Words by their first letter, the longest first.
fn keywords(first: u8) -> &'static [(&'static [u8], Keyword)] {
    use Function::{Cos, Sin, Tan};
    use Keyword::{Greek, Other, Pi, Root};
    const fn call(function: Function) -> Keyword {
        Keyword::Call(Ratio {
            function,
            reciprocal: false,
        })
    }
    const fn inverse(function: Function) -> Keyword {
        Keyword::Call(Ratio {
            function,
            reciprocal: true,
        })
    }
    match first {
        b'a' => &[
            (b"arcsin", Other),
            (b"arccos", Other),
            (b"arctan", Other),
            (b"alpha", Greek),
            (b"asin", Other),
            (b"acos", Other),
            (b"atan", Other),
            (b"abs", Other),
        ],
        b'b' => &[(b"beta", Greek)],
        b'c' => &[
            (b"cosech", Other),
            (b"cosec", const { inverse(Sin) }),
            (b"cosh", Other),
            (b"csch", Other),
            (b"coth", Other),
            (b"cbrt", Other),
            (b"cos", const { call(Cos) }),
            (b"csc", const { inverse(Sin) }),
            (b"cot", const { inverse(Tan) }),
            (b"chi", Greek),
        ],
        b'd' => &[
            (b"degrees", Other),
            (b"degree", Other),
            (b"delta", Greek),
            (b"deg", Other),
        ],
        b'e' => &[
            (b"epsilon", Greek),
            (b"eta", Greek),
            (b"ell", Greek),
            (b"exp", Other),
        ],
        b'g' => &[(b"gamma", Greek)],
        b'i' => &[(b"iota", Greek)],
        b'k' => &[(b"kappa", Greek)],
        b'l' => &[(b"lambda", Greek), (b"log", Other), (b"ln", Other)],
        b'm' => &[(b"mu", Greek)],
        b'n' => &[(b"nu", Greek)],
        b'o' => &[(b"omega", Greek)],
        b'p' => &[(b"phi", Greek), (b"psi", Greek), (b"pi", Pi)],
        b'r' => &[(b"rho", Greek)],
        b's' => &[
            (b"sigma", Greek),
            (b"sqrt", Root),
            (b"sinh", Other),
            (b"sech", Other),
            (b"sin", const { call(Sin) }),
            (b"sec", const { inverse(Cos) }),
        ],
        b't' => &[
            (b"theta", Greek),
            (b"tanh", Other),
            (b"tan", const { call(Tan) }),
            (b"tau", Greek),
        ],
        b'u' => &[(b"upsilon", Greek)],
        b'v' => &[
            (b"varepsilon", Other),
            (b"vartheta", Other),
            (b"varphi", Other),
            (b"varrho", Other),
        ],
        b'x' => &[(b"xi", Greek)],
        b'z' => &[(b"zeta", Greek)],
        b'G' => &[(b"Gamma", Greek)],
        b'D' => &[(b"Delta", Greek)],
        b'T' => &[(b"Theta", Greek)],
        b'L' => &[(b"Lambda", Greek)],
        b'X' => &[(b"Xi", Greek)],
        b'S' => &[(b"Sigma", Greek)],
        b'U' => &[(b"Upsilon", Greek)],
        b'P' => &[(b"Phi", Greek), (b"Psi", Greek)],
        b'O' => &[(b"Omega", Greek)],
        _ => &[],
    }
}

/// The longest word a run of letters starts with, and its length.
#[inline]
pub(crate) fn keyword(run: &[u8]) -> Option<(usize, Keyword)> {
    keywords(*run.first()?)
        .iter()
        .find(|(word, _)| run.starts_with(word))
        .map(|(word, kind)| (word.len(), *kind))
}

/// Whether a run with capitals starts with a function written in capitals, as the careful reader allows.
fn shouted(run: &[u8]) -> bool {
    let mut lower = [0; RUN];
    for (to, from) in lower.iter_mut().zip(run) {
        *to = from.to_ascii_lowercase();
    }
    let lower = &lower[..run.len().min(RUN)];
    match keyword(lower) {
        Some((length, kind)) => {
            !matches!(kind, Keyword::Greek | Keyword::Pi) && lower[..length] != run[..length]
        }
        None => false,
    }
}

impl<B: Builder> Reader<'_, B> {
    /// Reads a word; its echo is written, unless it is only looked at, for names.
    #[inline]
    pub(super) fn word(&mut self, look: bool) -> Option<Word> {
        let word = self.word_here(look)?;
        self.end = self.at;
        Some(word)
    }

    #[inline]
    fn word_here(&mut self, look: bool) -> Option<Word> {
        match self.byte(0) {
            b'a'..=b'z' | b'A'..=b'Z' => match self.short(look) {
                None => self.letters(look),
                word => word,
            },
            b'\\' => self.command(look),
            0xe2 if self.starts("√") => {
                self.at += 3;
                Some(Word::Root { tex: false })
            }
            0xe2 if self.starts("ℓ") => {
                self.at += 3;
                self.tail(b"l", look)
            }
            lead @ (0xce | 0xcf) => {
                let low = self.byte(1);
                let code = u32::from(lead & 0x1f) << 6 | u32::from(low & 0x3f);
                self.at += 2;
                let letter = char::from_u32(code)?;
                if letter == 'Ω' && self.before {
                    return None;
                }
                if letter == 'π' {
                    return Some(Word::Pi);
                }
                let name = greek_name(letter)?;
                // A combining accent makes another name of it.
                self.tail(name.as_bytes(), look)
            }
            _ => None,
        }
    }

    /// Most names: a letter, perhaps with a digit, and nothing behind that could belong to them.
    #[inline]
    fn short(&mut self, look: bool) -> Option<Word> {
        let [letter, next, after] = [0, 1, 2].map(|ahead| self.byte(ahead));
        let (key, length, end) = match next.is_ascii_digit() {
            true => (u128::from(letter) | u128::from(next) << 8, 2, after),
            false => (u128::from(letter), 1, next),
        };
        if self.before || GOES_ON[usize::from(end)] || letter == b'd' {
            return None;
        }
        let word = self.name(key, look)?;
        self.at += length;
        Some(word)
    }

    fn letters(&mut self, look: bool) -> Option<Word> {
        let rest = &self.text[self.at..];
        let count = rest.iter().take_while(|b| b.is_ascii_alphabetic()).count();
        if count > RUN {
            return None;
        }
        if self.before && self.names.get().open && !no_unit(rest, self.names.get().letters) {
            return None;
        }
        let run = &rest[..count];
        // `dx` could be a differential.
        let next = rest.get(1).copied().unwrap_or(0);
        let opens = self.at > 0 && self.text[self.at - 1] == b'{';
        let before_name = count > 1 || opens || matches!(next, 0xce | 0xcf | b'\\');
        let differential = run[0] == b'd' && before_name && matches!(self.names, Table::Collect(_));
        if count == 1 {
            if differential {
                return None;
            }
            self.at += 1;
            return self.tail(run, look);
        }
        let known = keyword(run);
        let length = known.map_or(0, |(length, _)| length);
        if run.iter().any(u8::is_ascii_uppercase) && shouted(run) {
            return None;
        }
        let declared = self.names.get().words.iter().find(|w| run.starts_with(w));
        if let Some(word) = declared.filter(|w| w.len() >= length) {
            let length = word.len();
            self.at += length;
            return self.tail(&rest[..length], look);
        }
        match known {
            None if differential => None,
            None => {
                self.at += 1;
                self.tail(&run[..1], look)
            }
            Some((length, kind)) => {
                self.at += length;
                match kind {
                    Keyword::Greek if &run[..length] == b"ell" => self.tail(b"l", look),
                    Keyword::Greek => self.tail(&run[..length], look),
                    Keyword::Pi => Some(Word::Pi),
                    Keyword::Root => Some(Word::Root { tex: false }),
                    Keyword::Call(ratio) => Some(Word::Call(ratio)),
                    Keyword::Other => None,
                }
            }
        }
    }

    fn command(&mut self, look: bool) -> Option<Word> {
        let rest = &self.text[self.at + 1..];
        let count = rest.iter().take_while(|b| b.is_ascii_alphabetic()).count();
        let word = &rest[..count];
        self.at += 1 + count;
        match word {
            b"frac" | b"dfrac" | b"tfrac" => return Some(Word::Fraction),
            b"sqrt" => return Some(Word::Root { tex: true }),
            b"ell" => return self.tail(b"l", look),
            b"pi" => return Some(Word::Pi),
            _ => {}
        }
        match keyword(word) {
            Some((length, Keyword::Greek)) if length == count => self.tail(word, look),
            Some((length, Keyword::Call(ratio))) if length == count => Some(Word::Call(ratio)),
            _ => None,
        }
    }

    /// Index and primes behind a base, and the name that comes out.
    #[inline]
    fn tail(&mut self, base: &[u8], look: bool) -> Option<Word> {
        // Δ before a name is no factor.
        if matches!(base, b"Delta" | b"delta") && matches!(self.names, Table::Collect(_)) {
            return None;
        }
        let next = self.byte(0);
        let ends = !(next.is_ascii_digit() || matches!(next, b'_' | b'\'' | 0xcc | 0xe2));
        // Most names are one letter and end here.
        if let (true, [letter], Some(index)) = (ends, base, self.names.get().letter(base[0])) {
            if !look {
                match self.names.get().is_collected() {
                    true => self.echo.push(*letter),
                    false => self.echo.extend_from_slice(self.names.get().echo(index)),
                }
            }
            return Some(Word::Name(index));
        }
        let mut spelled = Spelling::default();
        spelled.push(base)?;
        if ends {
            return self.name(spelled.key(), look);
        }
        match next {
            b'0'..=b'9' => self.digits(&mut spelled)?,
            b'_' => {
                self.at += 1;
                self.index(&mut spelled)?;
            }
            0xe2 if self.byte(1) == 0x82 => {
                while self.byte(0) == 0xe2
                    && self.byte(1) == 0x82
                    && (0x80..=0x89).contains(&self.byte(2))
                {
                    spelled.push(&[b'0' + (self.byte(2) - 0x80)])?;
                    self.at += 3;
                }
            }
            _ => {}
        }
        let mut primes = 0;
        loop {
            match self.byte(0) {
                b'\'' => self.at += 1,
                0xe2 if self.starts("′") => self.at += 3,
                // Indices and marks in an unusual order, accents, raised signs.
                b'0'..=b'9' | b'_' | 0xcc => return None,
                0xe2 if matches!(self.byte(1), 0x80..=0x83) => return None,
                _ => break,
            }
            primes += 1;
            if primes > 2 {
                return None;
            }
            spelled.push(b"'")?;
        }
        self.name(spelled.key(), look)
    }

    fn digits(&mut self, spelled: &mut Spelling) -> Option<()> {
        let rest = &self.text[self.at..];
        let count = rest.iter().take_while(|b| b.is_ascii_digit()).count();
        // `u1x` is a component.
        if matches!(rest.get(count), Some(b'x' | b'y' | b'z')) {
            return None;
        }
        spelled.push(&rest[..count])?;
        self.at += count;
        Some(())
    }

    /// An index behind `_`.
    fn index(&mut self, spelled: &mut Spelling) -> Option<()> {
        let braced = self.byte(0) == b'{';
        if braced {
            self.at += 1;
        } else if self.byte(0).is_ascii_digit() {
            return self.digits(spelled);
        }
        let rest = &self.text[self.at..];
        let count = rest
            .iter()
            .take_while(|b| b.is_ascii_alphanumeric())
            .count();
        let index = &rest[..count];
        if count == 0 || ACCENTS.iter().any(|a| index.starts_with(a.as_bytes())) {
            return None;
        }
        if !index[0].is_ascii_digit() {
            spelled.push(b"_")?;
        } else if !index.iter().all(u8::is_ascii_digit) {
            return None;
        }
        spelled.push(index)?;
        self.at += count;
        if braced {
            if self.byte(0) != b'}' {
                return None;
            }
            self.at += 1;
        } else if self.byte(0) == b'\'' || self.starts("′") {
            // Where the index ends could depend on the names without the prime.
            return None;
        }
        Some(())
    }

    #[inline]
    fn name(&mut self, key: Key, look: bool) -> Option<Word> {
        let index = match &mut self.names {
            Table::Collect(names) if !look => names.index(key)?,
            names => names.get().find(key)?,
        };
        if !look {
            self.echo.extend_from_slice(self.names.get().echo(index));
        }
        Some(Word::Name(index))
    }
}

/// The one way to write a name, in the making.
#[derive(Default)]
struct Spelling {
    bytes: [u8; 16],
    length: usize,
}

impl Spelling {
    #[inline]
    fn push(&mut self, piece: &[u8]) -> Option<()> {
        let end = self.length + piece.len();
        self.bytes.get_mut(self.length..end)?.copy_from_slice(piece);
        self.length = end;
        Some(())
    }

    fn key(&self) -> Key {
        Key::from_le_bytes(self.bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::symbols::is_greek;

    #[test]
    fn the_words_are_the_greek_names_of_the_careful_reader() {
        for first in (b'a'..=b'z').chain(b'A'..=b'Z') {
            for (word, kind) in keywords(first) {
                let text = std::str::from_utf8(word).expect("ASCII");
                assert_eq!(is_greek(text) || text == "ell", {
                    matches!(kind, Keyword::Greek) || text.starts_with("var")
                });
            }
        }
    }
}
