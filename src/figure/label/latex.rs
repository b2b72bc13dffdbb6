//! The LaTeX spelling of a symbol: letters, indices, marks and accents.
//!
//! In: a spelling. Out: its glyphs, and the runs of a label that they make. What it does not know it shows as text.

use std::iter::Peekable;
use std::str::Chars;

use super::{Label, Level, Run, visible};
use crate::formula::{letter, letters};

/// Deepest nesting that is followed.
const DEEPEST: usize = 12;

/// A part of a spelling.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Glyph {
    /// A letter, which leans.
    Letter(String),
    Number(String),
    /// A sign between letters and numbers.
    Sign(String),
    /// An upright word.
    Word(String),
    /// A thin space.
    Space,
    Prime,
    Group(Vec<Glyph>),
    /// Something with a mark above it, as a character that combines; `None` for an arrow.
    Accent(Option<char>, Box<Glyph>),
    /// Below or above what stands before it.
    Script(Level, Box<Glyph>),
}

/// Reads a spelling as far as it goes.
pub(crate) fn glyphs(text: &str) -> Vec<Glyph> {
    let mut reader = Reader(text.chars().peekable());
    let mut all = Vec::new();
    while reader.0.peek().is_some() {
        all.extend(reader.group(0));
        reader.0.next();
    }
    all
}

struct Reader<'a>(Peekable<Chars<'a>>);

impl Reader<'_> {
    /// Up to a closing brace, or the end.
    fn group(&mut self, depth: usize) -> Vec<Glyph> {
        let mut all = Vec::new();
        while self.0.peek().is_some_and(|c| *c != '}') {
            all.extend(self.one(depth));
        }
        all
    }

    /// The characters from here on that are of one kind.
    fn run(&mut self, is_of: fn(&char) -> bool) -> String {
        let mut run = String::new();
        while let Some(c) = self.0.next_if(is_of) {
            run.push(c);
        }
        run
    }

    fn one(&mut self, depth: usize) -> Option<Glyph> {
        if depth > DEEPEST {
            // Nobody nests so deep; the rest is passed over.
            self.0.by_ref().for_each(drop);
            return None;
        }
        if self.0.peek().is_some_and(char::is_ascii_digit) {
            return Some(Glyph::Number(self.run(char::is_ascii_digit)));
        }
        Some(match self.0.next()? {
            '{' => {
                let inner = self.group(depth + 1);
                self.0.next();
                Glyph::Group(inner)
            }
            '_' => Glyph::Script(Level::Sub, Box::new(self.one(depth + 1)?)),
            '^' => Glyph::Script(Level::Sup, Box::new(self.one(depth + 1)?)),
            '\\' => return self.command(depth),
            ' ' | '}' => return None,
            '\'' => Glyph::Prime,
            '-' => Glyph::Sign(String::from("−")),
            c if c.is_alphabetic() => Glyph::Letter(visible(&c.to_string())),
            c => Glyph::Sign(visible(&c.to_string())),
        })
    }

    fn command(&mut self, depth: usize) -> Option<Glyph> {
        let name = self.run(char::is_ascii_alphabetic);
        let mark = match name.as_str() {
            "" => {
                return Some(match self.0.next() {
                    Some(',' | ';' | ':' | ' ' | '!') | None => Glyph::Space,
                    Some(c) => Glyph::Word(visible(&c.to_string())),
                });
            }
            "prime" => return Some(Glyph::Prime),
            "mathrm" | "text" | "operatorname" | "mathbf" | "mathit" | "boldsymbol" | "rm" => {
                return self.upright(depth);
            }
            "vec" => None,
            "dot" => Some('\u{307}'),
            "ddot" => Some('\u{308}'),
            "hat" => Some('\u{302}'),
            "bar" => Some('\u{304}'),
            "tilde" => Some('\u{303}'),
            _ => {
                let _ = self.run(|c| *c == ' ');
                return Some(match letter(&name) {
                    Some("∫") => Glyph::Sign(String::from("∫")),
                    Some(letter) => Glyph::Letter(letter.to_string()),
                    None => Glyph::Word(name),
                });
            }
        };
        let _ = self.run(|c| *c == ' ');
        Some(Glyph::Accent(mark, Box::new(self.one(depth + 1)?)))
    }

    /// The word in the braces that follow, or the one thing without braces.
    fn upright(&mut self, depth: usize) -> Option<Glyph> {
        let _ = self.run(|c| *c == ' ');
        if self.0.next_if_eq(&'{').is_none() {
            return self.one(depth + 1);
        }
        let word = self.run(|c| *c != '}');
        self.0.next();
        let word = word.replace(['\\', '{'], "").replace('_', " ");
        Some(Glyph::Word(visible(&word)))
    }
}

/// A spelling as a label.
pub(super) fn read(text: &str) -> Label {
    let mut label = Label::default();
    label.set(&glyphs(text), Level::Base, false);
    label
}

impl Label {
    fn set(&mut self, glyphs: &[Glyph], level: Level, arrow: bool) {
        for glyph in glyphs {
            let (text, italic) = match glyph {
                Glyph::Letter(text) => (text.as_str(), true),
                Glyph::Number(text) | Glyph::Sign(text) | Glyph::Word(text) => {
                    (text.as_str(), false)
                }
                Glyph::Space => ("\u{2009}", false),
                Glyph::Prime => ("′", false),
                Glyph::Group(inner) => {
                    self.set(inner, level, arrow);
                    continue;
                }
                Glyph::Script(level, inner) => {
                    self.set(std::slice::from_ref(inner), *level, false);
                    continue;
                }
                Glyph::Accent(mark, inner) => {
                    self.set(std::slice::from_ref(inner), level, arrow || mark.is_none());
                    if let (Some(run), Some(mark)) = (self.runs.last_mut(), mark) {
                        run.text.push(*mark);
                    }
                    continue;
                }
            };
            match self.runs.last_mut() {
                Some(last)
                    if last.italic == italic && last.level == level && !last.arrow && !arrow =>
                {
                    last.text.push_str(text);
                }
                _ => self.runs.push(Run {
                    text: text.to_string(),
                    italic,
                    level,
                    arrow,
                }),
            }
        }
    }
}

/// The command of LaTeX for a character outside ASCII that stands in formulas and sentences.
pub fn command(c: char) -> Option<String> {
    const SIGNS: [(char, &str); 20] = [
        ('µ', "\\mu"),
        ('∫', "\\textstyle\\int"),
        ('√', "\\surd"),
        ('≠', "\\ne"),
        ('≤', "\\le"),
        ('≥', "\\ge"),
        ('≈', "\\approx"),
        ('→', "\\to"),
        ('⇒', "\\Rightarrow"),
        ('∞', "\\infty"),
        ('−', "-"),
        ('×', "\\times"),
        ('·', "\\cdot"),
        ('±', "\\pm"),
        ('°', "^\\circ"),
        ('′', "'"),
        ('″', "''"),
        ('…', "\\dots"),
        ('⁺', "^{+}"),
        ('⁻', "^{-}"),
    ];
    if let Some((_, sign)) = SIGNS.iter().find(|(sign, _)| *sign == c) {
        return Some((*sign).to_string());
    }
    let digit = |digits: &str| digits.chars().position(|d| d == c);
    if let Some(k) = digit("⁰¹²³⁴⁵⁶⁷⁸⁹") {
        return Some(format!("^{{{k}}}"));
    }
    if let Some(k) = digit("₀₁₂₃₄₅₆₇₈₉") {
        return Some(format!("_{{{k}}}"));
    }
    let (name, _) = letters().find(|(_, letter)| letter.chars().eq([c]))?;
    Some(format!("\\{name}"))
}
