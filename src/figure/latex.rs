//! The LaTeX spelling of a symbol as runs of a label: letters, indices, marks and accents.
//!
//! In: a spelling. Out: a label. What it does not know it shows as text.

use std::iter::Peekable;
use std::str::Chars;

use super::label::{Label, Level, Run, visible};
use crate::formula::{letter, letters};

/// Deepest nesting of braces that is followed.
const DEEPEST: usize = 8;

/// Reads a spelling as far as it goes.
pub(super) fn read(text: &str) -> Label {
    let mut reader = Reader {
        rest: text.chars().peekable(),
        label: Label::default(),
    };
    let style = Style {
        italic: true,
        level: Level::Base,
        arrow: false,
    };
    while reader.rest.peek().is_some() {
        reader.group(style, 0);
        reader.rest.next();
    }
    reader.label
}

#[derive(Clone, Copy)]
struct Style {
    italic: bool,
    level: Level,
    arrow: bool,
}

struct Reader<'a> {
    rest: Peekable<Chars<'a>>,
    label: Label,
}

impl Reader<'_> {
    /// Reads up to a closing brace, which stays.
    fn group(&mut self, style: Style, depth: usize) {
        while let Some(&c) = self.rest.peek() {
            if c == '}' {
                return;
            }
            self.one(style, depth);
        }
    }

    /// Reads one character, command or braced group.
    fn one(&mut self, style: Style, depth: usize) {
        let Some(c) = self.rest.next() else { return };
        match c {
            '{' if depth < DEEPEST => {
                self.group(style, depth + 1);
                self.rest.next();
            }
            '_' | '^' if depth < DEEPEST => {
                let level = if c == '_' { Level::Sub } else { Level::Sup };
                self.one(
                    Style {
                        level,
                        arrow: false,
                        ..style
                    },
                    depth + 1,
                );
            }
            '\\' => self.command(style, depth),
            ' ' if style.italic => {}
            '\'' => self.add(
                "′",
                Style {
                    italic: false,
                    ..style
                },
            ),
            '-' if style.italic => self.add(
                "−",
                Style {
                    italic: false,
                    ..style
                },
            ),
            c => self.add(
                &visible(&c.to_string()),
                Style {
                    italic: style.italic && c.is_alphabetic(),
                    ..style
                },
            ),
        }
    }

    fn command(&mut self, style: Style, depth: usize) {
        let mut name = String::new();
        while let Some(&c) = self.rest.peek() {
            if !c.is_ascii_alphabetic() {
                break;
            }
            name.push(c);
            self.rest.next();
        }
        if depth >= DEEPEST {
            return;
        }
        let upright = Style {
            italic: false,
            ..style
        };
        match name.as_str() {
            "" => match self.rest.next() {
                Some(',' | ';' | ':' | ' ' | '!') | None => self.add("\u{2009}", upright),
                Some(c) => self.add(&visible(&c.to_string()), upright),
            },
            "vec" => self.one(
                Style {
                    arrow: true,
                    ..style
                },
                depth + 1,
            ),
            "mathrm" | "text" | "operatorname" | "mathbf" | "rm" => self.one(upright, depth + 1),
            "dot" | "ddot" | "hat" | "bar" | "tilde" => {
                let before = self.label.runs.len();
                self.one(style, depth + 1);
                let mark = match name.as_str() {
                    "dot" => '\u{307}',
                    "ddot" => '\u{308}',
                    "hat" => '\u{302}',
                    "bar" => '\u{304}',
                    _ => '\u{303}',
                };
                if self.label.runs.len() > before
                    && let Some(run) = self.label.runs.last_mut()
                {
                    run.text.push(mark);
                }
            }
            _ => match letter(&name) {
                Some(c) if c != "∫" => self.add(c, style),
                other => self.add(other.unwrap_or(name.as_str()), upright),
            },
        }
    }

    fn add(&mut self, text: &str, style: Style) {
        match self.label.runs.last_mut() {
            Some(last)
                if last.italic == style.italic
                    && last.level == style.level
                    && !last.arrow
                    && !style.arrow =>
            {
                last.text.push_str(text);
            }
            _ => self.label.runs.push(Run {
                text: text.to_string(),
                italic: style.italic,
                level: style.level,
                arrow: style.arrow,
            }),
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
