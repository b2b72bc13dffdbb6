//! Labels as short runs of text: symbols from their LaTeX names, and formulas on one line.
//!
//! In: names, LaTeX spellings, expressions. Out: runs that say what is italic, lowered or raised, with an estimate of
//! their size. Knows nothing of where a label goes. Whatever LaTeX it does not know it shows as text.

mod inline;
pub(crate) mod latex;

use crate::expr::Expr;
use crate::formula::{is_hidden, latex_name, latex_words};
use crate::scene::Scene;

/// Where a run stands against the line of text.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Level {
    /// On the line.
    Base,
    /// Lowered and small.
    Sub,
    /// Raised and small.
    Sup,
}

/// A piece of text in one style.
#[derive(Clone, PartialEq, Debug)]
pub struct Run {
    /// The text; escaped only when written.
    pub text: String,
    /// Whether it is a quantity, set in italics.
    pub italic: bool,
    /// Lowered or raised.
    pub level: Level,
    /// Whether an arrow stands over it.
    pub arrow: bool,
}

/// A line of text in a figure.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Label {
    /// Its pieces from left to right; a raised piece after a lowered one stands above it.
    pub runs: Vec<Run>,
}

/// Longest label in characters; what is longer ends in an ellipsis.
pub(super) const LONGEST: usize = 40;
/// Size of lowered and raised text against the line's.
pub const SMALL: f64 = 0.7;

impl Label {
    /// Words, upright.
    pub fn words(text: &str) -> Label {
        let mut label = Label::default();
        label.push(&visible(text), false, Level::Base);
        label.cut()
    }

    /// The symbol of a parameter or answer, from its LaTeX spelling or its name.
    pub fn symbol(name: &str, latex: Option<&str>) -> Label {
        match latex {
            Some(latex) if !latex.trim().is_empty() => Label::latex(latex),
            _ => Label::latex(&latex_name(name)),
        }
    }

    /// The LaTeX spelling of a name.
    pub fn latex(text: &str) -> Label {
        latex::read(text).cut()
    }

    /// A vector symbol: an arrow over `base`, with an index.
    pub fn vector(base: &str, index: &str, mark: &str) -> Label {
        let mut text = format!("\\vec{{{base}}}");
        if !index.is_empty() {
            text.push_str("_{");
            text.push_str(&match index.contains('_') {
                true => latex_words(index),
                false => latex_name(index),
            });
            text.push('}');
        }
        if !mark.is_empty() {
            text.push_str(&format!("^{{{mark}}}"));
        }
        Label::latex(&text)
    }

    /// A formula on one line.
    pub fn formula(e: &Expr, scene: &Scene) -> Label {
        let mut label = Label::default();
        inline::write(e, scene, &mut label, 0);
        label.cut()
    }

    /// Adds text in a style of its own.
    pub fn push(&mut self, text: &str, italic: bool, level: Level) {
        if !text.is_empty() {
            self.runs.push(Run {
                text: text.to_string(),
                italic,
                level,
                arrow: false,
            });
        }
    }

    /// This label after a minus sign.
    pub fn negated(mut self) -> Label {
        self.runs.insert(
            0,
            Run {
                text: "−".to_string(),
                italic: false,
                level: Level::Base,
                arrow: false,
            },
        );
        self
    }

    /// This label with another one behind it.
    pub fn then(mut self, more: Label) -> Label {
        self.runs.extend(more.runs);
        self
    }

    /// The characters alone, for captions and text alternatives.
    pub fn text(&self) -> String {
        let mut out = String::new();
        let mut digits = false;
        for (i, run) in self.runs.iter().enumerate() {
            match run.level {
                Level::Base => out.push_str(&run.text),
                Level::Sub => {
                    if i == 0 || self.runs[i - 1].level != Level::Sub {
                        let index = self.runs[i..].iter().take_while(|r| r.level == Level::Sub);
                        digits = index
                            .flat_map(|r| r.text.chars())
                            .all(|c| c.is_ascii_digit());
                        out.push_str(if digits { "" } else { "_" });
                    }
                    out.extend(
                        run.text
                            .chars()
                            .map(|c| if digits { lowered(c) } else { c }),
                    );
                }
                Level::Sup => out.extend(run.text.chars().map(raised)),
            }
        }
        out
    }

    /// Width at a font size.
    pub fn width(&self, size: f64) -> f64 {
        let ends = self.ends(size);
        ends.iter().fold(0.0, |most: f64, (_, end)| most.max(*end))
    }

    /// Start and end of each run at a font size, from the label's left edge.
    pub fn ends(&self, size: f64) -> Vec<(f64, f64)> {
        let (mut at, mut stack) = (0.0, 0.0);
        let mut ends: Vec<(f64, f64)> = Vec::new();
        for (i, run) in self.runs.iter().enumerate() {
            let small = if run.level == Level::Base { 1.0 } else { SMALL };
            let width: f64 = run.text.chars().map(advance).sum::<f64>() * size * small;
            let above = i > 0 && run.level == Level::Sup && self.runs[i - 1].level == Level::Sub;
            // A raised mark stands over the whole index, clear of an arrow over the letter before it.
            let base = self.runs[..i].iter().rposition(|r| r.level != Level::Sub);
            let arrow = base.is_some_and(|b| self.runs[b].arrow);
            let start = match base {
                _ if !above => at,
                None => 0.0,
                Some(b) => ends[b].1,
            };
            let start = if arrow && run.level == Level::Sup {
                start + 0.16 * size
            } else {
                start
            };
            stack = if above {
                f64::max(stack, start + width)
            } else {
                start + width
            };
            ends.push((start, start + width));
            at = stack;
        }
        ends
    }

    /// Whether it is one line of text, without anything raised, lowered or below an arrow.
    pub fn is_plain(&self) -> bool {
        let mut runs = self.runs.iter();
        runs.all(|run| run.level == Level::Base && !run.arrow)
    }

    /// Whether something is raised, and whether something is lowered.
    pub fn reach(&self) -> (bool, bool) {
        let has = |level| self.runs.iter().any(|r| r.level == level);
        (
            has(Level::Sup) || self.runs.iter().any(|r| r.arrow),
            has(Level::Sub),
        )
    }

    fn cut(mut self) -> Label {
        let mut left = LONGEST;
        for i in 0..self.runs.len() {
            let count = self.runs[i].text.chars().count();
            if count > left {
                let short: String = self.runs[i].text.chars().take(left).collect();
                self.runs[i].text = short + "…";
                self.runs.truncate(i + 1);
                break;
            }
            left -= count;
        }
        self
    }
}

/// Control characters, and those that would turn the direction of text, are shown as a box.
pub fn visible(text: &str) -> String {
    text.chars()
        .map(|c| {
            if c == '\n' || c == '\t' {
                ' '
            } else if is_hidden(c) {
                '□'
            } else {
                c
            }
        })
        .collect()
}

/// Width of a character in the usual serif fonts, in units of the font size, rounded up.
pub fn advance(c: char) -> f64 {
    match c {
        'i' | 'j' | 'l' | 't' | 'ι' | 'ℓ' => 0.33,
        'f' | 'I' | 'J' | 'r' | 's' | '(' | ')' | '[' | ']' | '/' | '-' => 0.4,
        ' ' | '.' | ',' | ':' | ';' | '\'' | '′' | '|' | '·' => 0.27,
        '\u{2009}' => 0.17,
        'm' | 'w' | 'ω' | '+' | '−' | '=' | '<' | '>' | '√' | '≈' => 0.72,
        'M' | 'W' | '…' | '@' | '%' | '∫' => 0.95,
        'A'..='Z' | 'Γ'..='Ω' | '□' => 0.7,
        c if c.is_ascii() => 0.52,
        'α'..='ω' => 0.58,
        '²' | '³' | '¹' | '⁺' | '⁻' | '°' => 0.4,
        c if u32::from(c) < 0x0500 => 0.6,
        _ => 1.0,
    }
}

fn lowered(c: char) -> char {
    match c {
        '0'..='9' => char::from_u32(u32::from('₀') + u32::from(c) - u32::from('0')).unwrap_or(c),
        _ => c,
    }
}

fn raised(c: char) -> char {
    match c {
        '+' => '⁺',
        '−' | '-' => '⁻',
        _ => c,
    }
}

/// The room a label takes: width and height.
pub fn extent(label: &Label, size: f64) -> [f64; 2] {
    let (raised, lowered) = label.reach();
    let height = 0.95 + if raised { 0.3 } else { 0.0 } + if lowered { 0.17 } else { 0.0 };
    [label.width(size) + 2.0, height * size]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_are_set_as_in_print() {
        for (name, latex, text) in [
            ("l", Some("\\ell"), "ℓ"),
            ("theta", None, "θ"),
            ("m1", None, "m₁"),
            ("v", Some("\\vec{v}_{G1}^{+}"), "v_G1⁺"),
            ("omega", Some("\\dot{\\theta}"), "θ\u{307}"),
            ("x", Some("{{{{{{{{{{{{{{{{{{x"), ""),
            ("x", Some("\\input{/etc/passwd}"), "input/etc/passwd"),
        ] {
            let label = Label::symbol(name, latex);
            assert!(
                label.text() == text || text.is_empty(),
                "{name}: {:?}",
                label.text()
            );
        }
    }

    #[test]
    fn formulas_stand_on_one_line() {
        let (l, d) = (Expr::symbol("l"), Expr::symbol("d"));
        let scene = Scene::default();
        assert_eq!(Label::formula(&(&l / &Expr::from(2)), &scene).text(), "l/2");
        assert_eq!(Label::formula(&(&d - &l), &scene).text(), "d − l");
        assert_eq!(Label::formula(&(&Expr::from(2) * &l), &scene).text(), "2l");
    }

    #[test]
    fn a_long_name_is_cut() {
        assert!(Label::words(&"x".repeat(1000)).text().chars().count() <= LONGEST + 1);
    }
}
