//! The names a plain formula may use, found by comparing sixteen bytes.
//!
//! Which spelling means which name is the affair of [`crate::formula::symbols`]. Whatever this table cannot hold as simply
//! (accents, marks, names longer than sixteen bytes) makes it decline.

use std::sync::LazyLock;

use crate::dimension;
use crate::expr::Symbol;
use crate::formula::name::key_of_latex;
use crate::formula::symbols::{ACCENTS, is_greek, parts_of};
use crate::formula::units::is_symbol_first;

/// Most names: a set of names is a word of bits.
pub(crate) const MOST: usize = 64;
/// Places of the table; a power of two well above the spellings.
const PLACES: usize = 256;

/// A spelling, filled up with zeros; its first byte is the lowest.
pub(crate) type Key = u128;

/// The names in play, each known by its index.
#[derive(Clone, Debug)]
pub struct Names {
    /// Spellings with their length and the index of the name they mean.
    spellings: Vec<Spelled>,
    /// The declared names as they were declared; none where names are collected.
    shown: Vec<Symbol>,
    /// Place of a spelling in the list above, plus one, by the hash of its key.
    places: [u8; PLACES],
    /// Index of a name of one letter by its ASCII code, plus one.
    single: [u8; 128],
    /// Number of names.
    pub(crate) count: usize,
    /// Words of more than one letter that declared names start with, the Greek ones aside; the longest first.
    pub(crate) words: Vec<Vec<u8>>,
    /// Letters that are names of their own, as bits by their ASCII code.
    pub(crate) letters: u128,
    /// Whether a unit may stand behind a number, as it may where undeclared names are read.
    pub(crate) open: bool,
}

#[derive(Clone, Copy, Debug)]
struct Spelled {
    key: Key,
    bytes: [u8; 16],
    length: u8,
    index: u8,
}

/// The key of a spelling.
fn key(text: &[u8]) -> Option<Key> {
    let mut bytes = [0; 16];
    bytes.get_mut(..text.len())?.copy_from_slice(text);
    Some(Key::from_le_bytes(bytes))
}

#[inline]
fn place(key: Key) -> usize {
    let folded = (key ^ (key >> 64)) as u64;
    (folded.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 56) as usize
}

impl Names {
    /// A table to collect names in.
    pub fn collecting() -> Names {
        Names {
            spellings: Vec::with_capacity(16),
            shown: Vec::new(),
            places: [0; PLACES],
            single: [0; 128],
            count: 0,
            words: Vec::new(),
            letters: 0,
            open: true,
        }
    }

    /// A table of declared names, each perhaps with a LaTeX spelling; `None` where one is too special for it. Without
    /// `open` nothing else may occur in a formula.
    pub fn declared<'a>(
        names: impl IntoIterator<Item = (&'a str, Option<&'a str>)>,
        open: bool,
    ) -> Option<Names> {
        let mut table = Names {
            open,
            ..Names::collecting()
        };
        for (name, latex) in names {
            let index = table.count;
            if index >= MOST {
                return None;
            }
            table.count += 1;
            table.shown.push(Symbol::from(name));
            let spelled = parts_of(name).key();
            let other = latex.and_then(key_of_latex);
            for spelling in [Some(spelled), other].into_iter().flatten() {
                table.spell(&spelling, index)?;
            }
        }
        table
            .words
            .sort_by_key(|word| std::cmp::Reverse(word.len()));
        Some(table)
    }

    fn spell(&mut self, spelling: &str, index: usize) -> Option<()> {
        let key = simple(spelling)?;
        match self.find(key) {
            None => self.enter(key, index),
            Some(found) if found == index => {}
            Some(_) => return None,
        }
        let length = spelling.bytes().take_while(u8::is_ascii_alphabetic).count();
        let base = &spelling[..length];
        if spelling.len() == 1 {
            self.letters |= 1 << spelling.as_bytes()[0];
        }
        if length > 1 && !is_greek(base) && !self.words.iter().any(|w| w == base.as_bytes()) {
            self.words.push(base.as_bytes().to_vec());
        }
        Some(())
    }

    fn enter(&mut self, key: Key, index: usize) {
        let mut at = place(key);
        while self.places[at] != 0 {
            at = (at + 1) % PLACES;
        }
        if key < 0x80 {
            self.single[key as usize] = index as u8 + 1;
        }
        self.spellings.push(Spelled {
            key,
            bytes: key.to_le_bytes(),
            length: 16 - (key.leading_zeros() / 8) as u8,
            index: index as u8,
        });
        self.places[at] = self.spellings.len() as u8;
    }

    /// The index of a name of one letter that is known.
    #[inline]
    pub(crate) fn letter(&self, letter: u8) -> Option<usize> {
        match self.single[usize::from(letter & 0x7f)] {
            0 => None,
            found => Some(usize::from(found) - 1),
        }
    }

    /// The index of a name that is known.
    #[inline]
    pub(crate) fn find(&self, key: Key) -> Option<usize> {
        let mut at = place(key);
        loop {
            match self.places[at] {
                0 => return None,
                found => {
                    let known = &self.spellings[usize::from(found) - 1];
                    if known.key == key {
                        return Some(usize::from(known.index));
                    }
                }
            }
            at = (at + 1) % PLACES;
        }
    }

    /// The index of a name, which is entered where it is new.
    #[inline]
    pub(crate) fn index(&mut self, key: Key) -> Option<usize> {
        if let Some(found) = self.find(key) {
            return Some(found);
        }
        if self.count >= MOST {
            return None;
        }
        self.enter(key, self.count);
        self.count += 1;
        Some(self.count - 1)
    }

    /// What was collected is declared from here on, which tells it from units.
    pub fn close(&mut self) {
        for known in self.spellings.iter().filter(|known| known.key < 0x80) {
            self.letters |= 1 << known.key;
        }
    }

    /// Whether the names were collected, so that each is spelled in one way.
    #[inline]
    pub(crate) fn is_collected(&self) -> bool {
        self.shown.is_empty()
    }

    /// The name with this index, in characters.
    #[inline]
    pub fn echo(&self, index: usize) -> &[u8] {
        match self.shown.get(index) {
            Some(name) => name.as_bytes(),
            // Collected names have one spelling each.
            None => {
                let known = &self.spellings[index];
                &known.bytes[..usize::from(known.length)]
            }
        }
    }

    /// The names that were collected, in alphabetical order, with their indices.
    pub fn sorted(&self) -> impl Iterator<Item = (usize, &str)> {
        // Each was entered with the next index.
        let mut order: [u8; MOST] = std::array::from_fn(|index| index as u8);
        let count = self.spellings.len().min(MOST);
        order[..count].sort_unstable_by_key(|at| self.spellings[usize::from(*at)].key.swap_bytes());
        (0..count).map(move |at| {
            let index = usize::from(order[at]);
            (index, std::str::from_utf8(self.echo(index)).unwrap_or(""))
        })
    }
}

/// The key of a spelling made of a base, digits or `_` with an index that starts with a letter, and primes.
fn simple(spelling: &str) -> Option<Key> {
    let plain = spelling.trim_end_matches('\'');
    let length = plain.bytes().take_while(u8::is_ascii_alphabetic).count();
    let (base, index) = plain.split_at(length);
    let fits = match index.strip_prefix('_') {
        None => index.bytes().all(|b| b.is_ascii_digit()),
        Some(index) => {
            index.bytes().all(|b| b.is_ascii_alphanumeric())
                && index.starts_with(|c: char| c.is_ascii_alphabetic())
                && !ACCENTS.contains(&index.trim_end_matches(|c: char| c.is_ascii_digit()))
        }
    };
    // These have a second spelling, and `deg` is a unit as well.
    let special = base.starts_with("var") || matches!(base, "" | "ell" | "pi");
    if !fits || special || spelling.len() - plain.len() > 2 {
        return None;
    }
    // A word that is a function to everybody else is looked up by the careful reader.
    if length > 1
        && !is_greek(base)
        && (super::keyword(base.as_bytes()).is_some() || base.len() > 10)
    {
        return None;
    }
    key(spelling.as_bytes())
}

static UNIT_LETTERS: LazyLock<u128> = LazyLock::new(|| {
    let letters = (b'a'..=b'z').chain(b'A'..=b'Z');
    letters
        .filter(|b| {
            let letter = (*b as char).to_string();
            dimension::unit(&letter).is_ok() && !is_symbol_first(&letter)
        })
        .fold(0, |set, b| set | 1 << b)
});

/// Whether what follows a number is a formula for sure and no unit: something in it belongs to no unit, or a letter in it
/// is declared, which makes it one to the careful reader too.
pub(crate) fn no_unit(rest: &[u8], letters: u128) -> bool {
    let mut at = 0;
    let mut open = 0u32;
    while at < rest.len() {
        match rest[at] {
            b'+' => return true,
            b'(' => {
                open += 1;
                at += 1;
            }
            b')' if open == 0 => return true,
            b')' => {
                open -= 1;
                at += 1;
            }
            // In a unit a minus stands in an exponent only.
            b'-' if at > 0 && (rest[at - 1] == b' ' || rest[at - 1].is_ascii_alphanumeric()) => {
                return true;
            }
            b'\\' => {
                at += 1;
                while rest.get(at).is_some_and(u8::is_ascii_alphabetic) {
                    at += 1;
                }
            }
            b if b.is_ascii_alphabetic() => {
                let start = at;
                while rest.get(at).is_some_and(u8::is_ascii_alphabetic) {
                    if letters >> rest[at] & 1 == 1 {
                        return true;
                    }
                    at += 1;
                }
                // µ and Ω are letters of units.
                let micro = |piece: &[u8]| matches!(piece, [0xc2, 0xb5] | [0xce, 0xbc | 0xa9]);
                let lone = at == start + 1 && !rest.get(at..at + 2).is_some_and(micro);
                let joined = start > 1 && micro(&rest[start - 2..start]);
                if lone && !joined && *UNIT_LETTERS >> rest[start] & 1 == 0 {
                    return true;
                }
            }
            _ => at += 1,
        }
    }
    false
}
