//! Names of symbols on a platform: none that means something there already, none with characters it does not know.

use std::collections::BTreeMap;

use crate::expr::{Expr, Symbol};
use crate::formula::write_plain;

/// How symbols are spelled.
pub(super) struct Names {
    spelled: BTreeMap<Symbol, String>,
    /// Functions of another name, and the circle constant.
    words: &'static [(&'static str, &'static str)],
}

impl Names {
    /// Spells symbols: a name in `taken`, or one that differs from another in `folded` alone, gets `_s` behind it.
    pub fn new<'a>(
        symbols: impl Iterator<Item = &'a Symbol>,
        taken: impl Iterator<Item = String>,
        folded: fn(&str) -> String,
        words: &'static [(&'static str, &'static str)],
    ) -> Names {
        let mut spelled: BTreeMap<Symbol, String> = BTreeMap::new();
        let mut used: Vec<String> = taken.map(|name| folded(&name)).collect();
        for symbol in symbols {
            let known = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
            let mut name: String = symbol.chars().map(known).collect();
            while used.contains(&folded(&name))
                || !name.starts_with(|c: char| c.is_ascii_alphabetic())
            {
                name = match name.starts_with(|c: char| c.is_ascii_alphabetic()) {
                    true => format!("{name}_s"),
                    false => format!("s{name}"),
                };
            }
            used.push(folded(&name));
            spelled.insert(symbol.clone(), name);
        }
        Names { spelled, words }
    }

    /// The same with something in front of every symbol.
    pub fn behind(&self, prefix: &str) -> Names {
        let each = self.spelled.iter();
        let each = each.map(|(symbol, name)| (symbol.clone(), format!("{prefix}{name}")));
        Names {
            spelled: each.collect(),
            words: self.words,
        }
    }

    /// The spelling of a symbol.
    pub fn name(&self, symbol: &Symbol) -> String {
        self.spelled
            .get(symbol)
            .cloned()
            .unwrap_or_else(|| symbol.to_string())
    }

    /// An expression in infix notation.
    pub fn written(&self, e: &Expr) -> String {
        let plain = write_plain(e);
        let mut out = String::new();
        let mut word = String::new();
        for c in plain.chars().chain(['\n']) {
            if c.is_alphanumeric() || "_'".contains(c) {
                word.push(c);
                continue;
            }
            out.push_str(&self.word(&word));
            word.clear();
            out.push(c);
        }
        out.truncate(out.trim_end().len());
        out
    }

    fn word(&self, word: &str) -> String {
        if let Some(name) = self.spelled.get(word) {
            return name.clone();
        }
        let other = self.words.iter().find(|(own, _)| *own == word);
        other.map_or(word, |(_, theirs)| theirs).to_string()
    }
}
