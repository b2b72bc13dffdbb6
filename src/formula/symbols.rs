//! The names a formula may use, and which spellings mean the same name.
//!
//! A name has a base (a letter, a Greek letter, or a declared word), an accent, an index and marks such as ′ or ⁺. Its
//! *key* writes these in one way, so that `v1`, `v_1`, `v_{1}` and `{v}_{1}` meet.

pub(crate) mod name;

use std::borrow::Cow;
use std::sync::LazyLock;

use rustc_hash::{FxHashMap, FxHashSet};

use super::near;
use crate::dimension::Dimension;
use crate::expr::Symbol;

/// Letters of `varepsilon`, the longest word that is known undeclared.
const LONGEST_KEYWORD: usize = 10;

/// A declared name.
#[derive(Clone, Debug)]
pub struct Declared {
    /// The name as the scene writes it.
    pub name: Symbol,
    /// Its dimension, where known; it helps to see where the argument of a function ends.
    pub dimension: Option<Dimension>,
}

/// The names in play while a formula is read.
#[derive(Clone, Debug, Default)]
pub struct Symbols {
    declared: Vec<Declared>,
    keys: FxHashMap<Symbol, usize>,
    bases: FxHashSet<String>,
    /// Names with an index of one letter, without the mark between: `vy` for v_y.
    joined: FxHashSet<String>,
    longest_base: usize,
    open: bool,
    lists: bool,
    axes: bool,
    brief: bool,
}

impl Symbols {
    /// Only what is declared may occur.
    pub fn strict() -> Symbols {
        Symbols::default()
    }

    /// Whatever is not declared is collected: letters with their indices, and Greek names.
    pub fn open() -> Symbols {
        Symbols {
            open: true,
            ..Symbols::default()
        }
    }

    /// The same names, where a comma between digits in round brackets separates components: `(2,3)` is a vector.
    pub fn with_lists(mut self) -> Symbols {
        self.lists = true;
        self
    }

    /// The same names, where i, j and k stand for the unit vectors along the axes unless they are declared, `2i − 3j`, and so
    /// do e_x, e_y and e_z, and e_1, e_2 and e_3.
    pub fn with_axes(mut self) -> Symbols {
        self.axes = true;
        self
    }

    /// The unit vector a name stands for.
    pub(crate) fn axis(&self, name: &str) -> Option<&'static str> {
        let axis = match name {
            "i" | "e_x" | "e1" | "e_hat1" => "i_hat",
            "j" | "e_y" | "e2" | "e_hat2" => "j_hat",
            "k" | "e_z" | "e3" | "e_hat3" => "k_hat",
            _ => return None,
        };
        (self.axes && self.find(name).is_none()).then_some(axis)
    }

    /// The same names, where the first undeclared one ends reading: for trying whether a text can be read at all.
    pub fn briefly(mut self) -> Symbols {
        self.brief = true;
        self
    }

    /// Whether the first undeclared name ends reading.
    pub(crate) fn is_brief(&self) -> bool {
        self.brief
    }

    /// Whether a comma between digits in round brackets separates components.
    pub(crate) fn lists(&self) -> bool {
        self.lists
    }

    /// Whether undeclared names are collected rather than refused.
    pub fn is_open(&self) -> bool {
        self.open
    }

    /// Makes room for names that are declared next.
    pub(crate) fn reserve(&mut self, count: usize) {
        self.declared.reserve(count);
        self.keys.reserve(count);
    }

    /// Declares a name.
    pub fn declare(&mut self, name: &str) {
        self.declare_as(name, None, None);
    }

    /// Declares a name with its LaTeX spelling and dimension, where there are such.
    pub fn declare_as(
        &mut self,
        name: impl Into<Symbol>,
        latex: Option<&str>,
        dimension: Option<Dimension>,
    ) {
        let index = self.declared.len();
        let symbol = name.into();
        let name = &*symbol;
        let typeset = latex.and_then(name::key_of_latex).map(Cow::Owned);
        for key in [key_of(name)].into_iter().chain(typeset) {
            let letters = key.bytes().take_while(u8::is_ascii_alphabetic).count();
            self.add_base(&key[..letters]);
            if key != name {
                self.keys.entry(key.into()).or_insert(index);
            }
        }
        self.keys.insert(symbol.clone(), index);
        // Declared itself, it is no longer a name with its index run into it.
        self.joined.remove(name);
        if let [base, b'_', letter] = name.as_bytes()
            && base.is_ascii_alphabetic()
            && letter.is_ascii_alphabetic()
        {
            let joined: String = [char::from(*base), char::from(*letter)].iter().collect();
            let function = super::token::function(&joined).is_some() || joined == "pi";
            let unit = crate::dimension::unit(&joined).is_ok();
            if !function && !unit && !is_greek(&joined) && self.find(&joined).is_none() {
                self.keys.insert(joined.as_str().into(), index);
                self.add_base(&joined);
                self.joined.insert(joined);
            }
        }
        if name.len() > 1 && name.bytes().all(|b| b.is_ascii_alphabetic()) {
            self.add_base(name);
        }
        self.declared.push(Declared {
            name: symbol,
            dimension,
        });
    }

    /// Declares a LaTeX spelling alone, beside a name that may stand for something else without it: `\\vec{v}`.
    pub fn declare_typeset(&mut self, name: impl Into<Symbol>, latex: &str) {
        if let Some(key) = name::key_of_latex(latex) {
            let letters = key.bytes().take_while(u8::is_ascii_alphabetic).count();
            self.add_base(&key[..letters]);
            self.keys.entry(key.into()).or_insert(self.declared.len());
            self.declared.push(Declared {
                name: name.into(),
                dimension: None,
            });
        }
    }

    /// Spells a declared name in another way, whatever was spelled so before.
    pub(crate) fn respell(&mut self, name: &str, latex: &str) {
        let index = self.declared.iter().position(|d| *d.name == *name);
        if let (Some(index), Some(key)) = (index, name::key_of_latex(latex)) {
            let letters = key.bytes().take_while(u8::is_ascii_alphabetic).count();
            self.add_base(&key[..letters]);
            self.keys.insert(key.into(), index);
        }
    }

    fn add_base(&mut self, base: &str) {
        if base.len() > 1 {
            self.longest_base = self.longest_base.max(base.len());
            self.bases.insert(base.to_string());
        }
    }

    /// Most letters a word can have that is a declared base, a function or a Greek name.
    pub(crate) fn longest_word(&self) -> usize {
        self.longest_base.max(LONGEST_KEYWORD)
    }

    /// The declared names in the order of declaration.
    pub fn declared(&self) -> &[Declared] {
        &self.declared
    }

    /// The declared name of this key.
    pub(crate) fn find(&self, key: &str) -> Option<&Declared> {
        self.keys.get(key).map(|&index| &self.declared[index])
    }

    /// Whether some declared name starts with this word of letters as its base.
    pub(crate) fn has_base(&self, word: &str) -> bool {
        !self.bases.is_empty() && self.bases.contains(word)
    }

    /// Whether a word is a declared name only by an index that runs into it, and one of its letters is a name by itself, or both
    /// where nothing else may occur: then it is a product.
    pub(crate) fn is_product(&self, word: &str) -> bool {
        let letter = |at: usize| self.find(&word[at..=at]).is_some();
        self.joined.contains(word)
            && match self.open {
                true => letter(0) || letter(1),
                false => letter(0) && letter(1),
            }
    }

    /// The declared name that looks most like `name`, when one is near.
    pub fn nearest(&self, name: &str) -> Option<&str> {
        near::nearest(name, self.declared.iter().map(|d| &*d.name))
    }
}

impl<'a> FromIterator<&'a str> for Symbols {
    /// Declares names; nothing else may occur.
    fn from_iter<I: IntoIterator<Item = &'a str>>(names: I) -> Symbols {
        let mut symbols = Symbols::strict();
        names.into_iter().for_each(|name| symbols.declare(name));
        symbols
    }
}

/// Accents that are part of a name.
pub(crate) const ACCENTS: [&str; 6] = ["hat", "dot", "ddot", "bar", "vec", "tilde"];

/// What two accents over one letter make: dots may stand over an arrow or a hat, and an accent over nothing is itself.
pub(crate) fn both(one: &'static str, other: &'static str) -> Option<&'static str> {
    match (one, other) {
        ("", only) | (only, "") => Some(only),
        ("vec", "dot") | ("dot", "vec") => Some("vec_dot"),
        ("vec", "ddot") | ("ddot", "vec") => Some("vec_ddot"),
        ("hat", "dot") | ("dot", "hat") => Some("hat_dot"),
        ("hat", "ddot") | ("ddot", "hat") => Some("hat_ddot"),
        _ => None,
    }
}

/// A name in its parts.
#[derive(Clone, Default, Debug)]
pub(crate) struct Parts {
    pub base: String,
    pub accent: &'static str,
    pub index: String,
    /// The index in its parts, as underscores divide it.
    pub pieces: Vec<String>,
    /// Whether it was written bold, as vectors are.
    pub bold: bool,
    /// Primes, and `^` with what stands raised behind.
    pub marks: String,
}

impl Parts {
    /// A base alone.
    pub fn of(base: impl Into<String>) -> Parts {
        Parts {
            base: base.into(),
            ..Parts::default()
        }
    }

    /// The one way to write the name.
    pub fn key(&self) -> String {
        let mut key = self.base.clone();
        if !self.accent.is_empty() {
            key.push('_');
            key.push_str(self.accent);
        }
        if !self.index.is_empty() {
            if !self.index.starts_with(|c: char| c.is_ascii_digit()) {
                key.push('_');
            }
            key.push_str(&self.index);
        }
        key.push_str(&self.marks);
        key
    }
}

/// The parts of a name as scenes write it: `v1`, `v_G1`, `theta_dot`, `v1'`, `v_G1^+`.
pub(crate) fn parts_of(name: &str) -> Parts {
    let mut parts = Parts::default();
    let marks_at = name.find(['\'', '^']).unwrap_or(name.len());
    let (plain, marks) = name.split_at(marks_at);
    let behind = marks.trim_start_matches('\'');
    if behind.len() < marks.len() && behind.starts_with('_') {
        // `v'_x` is `v_x'`.
        let primes = &marks[..marks.len() - behind.len()];
        return parts_of(&format!("{plain}{behind}{primes}"));
    }
    parts.marks = marks.replace(['{', '}'], "");
    let base_end = plain
        .find(|c: char| c == '_' || c.is_ascii_digit())
        .unwrap_or(plain.len());
    parts.base = plain[..base_end].to_string();
    for piece in plain[base_end..].split('_') {
        // `x_dot1` is ẋ₁: digits may stand right behind an accent.
        let letters = piece.trim_end_matches(|c: char| c.is_ascii_digit());
        match ACCENTS.iter().find(|accent| **accent == letters) {
            Some(accent) if both(parts.accent, accent).is_some() => {
                parts.accent = both(parts.accent, accent).unwrap_or_default();
                parts.pieces.push(piece[letters.len()..].to_string());
            }
            _ => parts.pieces.push(piece.replace(['{', '}'], "")),
        }
    }
    parts.pieces.retain(|piece| !piece.is_empty());
    parts.index = parts.pieces.concat();
    parts
}

fn in_words(name: &str) -> String {
    let words = |c: char| match c {
        'π' => String::from("pi"),
        c => greek_name(c).map_or_else(|| c.to_string(), String::from),
    };
    name.chars().map(words).collect()
}

fn key_of(name: &str) -> Cow<'_, str> {
    // Letters, then digits, are their own key; so is a word with an index of one.
    let own = name.split_once('_').is_some_and(|(base, index)| {
        let is_word = |s: &str| !s.is_empty() && s.bytes().all(|b| b.is_ascii_alphabetic());
        is_word(base) && is_word(index) && !ACCENTS.contains(&index)
    });
    match !own && name.contains(['_', '\'', '^', '{', '}']) {
        // Greek letters are read as their names: `m_π` is `m_pi`.
        _ if !name.is_ascii() => Cow::Owned(parts_of(&in_words(name)).key()),
        true => Cow::Owned(parts_of(name).key()),
        false => Cow::Borrowed(name),
    }
}

/// Other spellings of a base, tried when the written one is not declared.
pub(crate) fn variants(base: &str) -> &'static [&'static str] {
    match base {
        "phi" => &["varphi"],
        "varphi" => &["phi"],
        "theta" => &["vartheta"],
        "vartheta" => &["theta"],
        "epsilon" => &["varepsilon"],
        "varepsilon" => &["epsilon"],
        "rho" => &["varrho"],
        "varrho" => &["rho"],
        "l" => &["ell"],
        "ell" => &["l"],
        _ => &[],
    }
}

/// Letters by their commands in LaTeX, which are the words for them too.
const LETTERS: &str = "alpha α beta β gamma γ delta δ epsilon ϵ varepsilon ε zeta ζ eta η theta θ vartheta ϑ iota ι \
    kappa κ lambda λ mu μ nu ν xi ξ pi π rho ρ sigma σ tau τ upsilon υ phi ϕ varphi φ chi χ psi ψ omega ω \
    Gamma Γ Delta Δ Theta Θ Lambda Λ Xi Ξ Pi Π Sigma Σ Upsilon Υ Phi Φ Psi Ψ Omega Ω ell ℓ int ∫";

/// Commands of letters with the letters.
pub(crate) fn letters() -> impl Iterator<Item = (&'static str, &'static str)> {
    pairs(LETTERS)
}

/// Whether a word is one of a list.
pub(crate) fn among(list: &str, word: &str) -> bool {
    list.split(' ').any(|known| known == word)
}

/// How many letters a text begins with.
pub(super) fn letters_at(text: &str) -> usize {
    text.bytes().take_while(u8::is_ascii_alphabetic).count()
}

/// The words of a table, two and two.
pub(super) fn pairs(table: &'static str) -> impl Iterator<Item = (&'static str, &'static str)> {
    let mut words = table.split(' ');
    std::iter::from_fn(move || words.next().zip(words.next()))
}

/// The character that a LaTeX command for a letter stands for, such as `theta` or `ell`.
pub fn letter(name: &str) -> Option<&'static str> {
    static BY_NAME: LazyLock<FxHashMap<&str, &str>> = LazyLock::new(|| letters().collect());
    BY_NAME.get(name).copied()
}

/// Whether a word is the name of a Greek letter, as a word and as a macro; π has a meaning of its own.
pub(crate) fn is_greek(word: &str) -> bool {
    match word {
        "pi" | "Pi" | "ell" | "int" => false,
        _ => word == "hbar" || letter(word).is_some(),
    }
}

/// Letters with the names they are read by; capitals that look as their Latin kin do are these.
const NAMES: &str = "α alpha β beta γ gamma δ delta ε epsilon ϵ epsilon ζ zeta η eta θ theta ϑ theta ι iota κ kappa \
    λ lambda μ mu µ mu ν nu ξ xi ρ rho ϱ rho σ sigma τ tau υ upsilon φ phi ϕ phi χ chi ψ psi ω omega ħ hbar ℏ hbar \
    Γ Gamma Δ Delta ∆ Delta Θ Theta Λ Lambda Ξ Xi Σ Sigma Υ Upsilon Φ Phi Ψ Psi Ω Omega \u{2126} Omega ℓ l Α A Β B \
    Ε E Ζ Z Η H Ι I Κ K Μ M Ν N Ο O Ρ P Τ T Χ X ο o";

/// The name of a Greek letter or a letter that stands for one; π is not among them.
pub(crate) fn greek_name(c: char) -> Option<&'static str> {
    static BY_LETTER: LazyLock<FxHashMap<char, &str>> = LazyLock::new(|| {
        let letters = pairs(NAMES).flat_map(|(c, name)| c.chars().map(move |c| (c, name)));
        letters.collect()
    });
    match c.is_ascii() {
        true => None,
        false => BY_LETTER.get(&c).copied().or_else(|| mathematical(c)),
    }
}

/// The plain letter behind one of the styled letters of Unicode, such as an italic or a full-width m.
fn mathematical(c: char) -> Option<&'static str> {
    const LATIN: &str = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
    const CAPITALS: &str = "ΑΒΓΔΕΖΗΘΙΚΛΜΝΞΟΠΡΘΣΤΥΦΧΨΩ";
    const SMALL: &str = "∇αβγδεζηθικλμνξοπρςστυφχψω∂εθκφρπ";
    match u32::from(c) {
        code @ 0x1d400..=0x1d6a3 => {
            let at = (code - 0x1d400) as usize % 52;
            LATIN.get(at..=at)
        }
        code @ 0x1d6a8..=0x1d7c9 => {
            let at = (code - 0x1d6a8) as usize % 58;
            let mut letters = CAPITALS.chars().chain(SMALL.chars());
            letters.nth(at).and_then(greek_name)
        }
        // Full-width letters.
        code @ (0xff21..=0xff3a | 0xff41..=0xff5a) => {
            let small = usize::from(code > 0xff40);
            let at = (code as usize & 0x1f) - 1 + 26 * small;
            LATIN.get(at..=at)
        }
        _ => match c {
            'ℎ' => Some("h"),
            '𝚤' => Some("i"),
            '𝚥' => Some("j"),
            _ => None,
        },
    }
}

/// The letter of a Greek name.
pub(crate) fn greek_letter(name: &str) -> Option<char> {
    static BY_NAME: LazyLock<FxHashMap<&str, char>> = LazyLock::new(|| {
        let letters = "αβγδεζηθικλμνξρστυφχψωΓΔΘΛΞΣΥΦΨΩħ".chars();
        letters.filter_map(|c| Some((greek_name(c)?, c))).collect()
    });
    let plain = match name {
        "varphi" => "phi",
        "vartheta" => "theta",
        "varepsilon" => "epsilon",
        "varrho" => "rho",
        "pi" => return Some('π'),
        "ell" => return Some('ℓ'),
        other => other,
    };
    BY_NAME.get(plain).copied()
}

/// Names that mean an angle unless the scene says otherwise.
pub(crate) fn is_angle_name(name: &str) -> bool {
    let base = name.find(['_', '\'', '^']).map_or(name, |end| &name[..end]);
    let base = base.trim_end_matches(|c: char| c.is_ascii_digit());
    let index = name[base.len()..].strip_prefix('_');
    let accented = |index: &str| ACCENTS.iter().any(|accent| index.starts_with(accent));
    !index.is_some_and(accented)
        && among(
            "alpha beta gamma theta vartheta phi varphi psi Theta Phi",
            base,
        )
}
