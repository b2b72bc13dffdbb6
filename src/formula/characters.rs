//! Characters beyond plain ASCII that stand for something in a formula, and those that have no place in one.

use super::Relation;
use super::fault::{Fault, Faulty, SETS, is_invisible};
use super::lexer::Lexer;
use super::symbols::{greek_name, pairs};
use super::token::{Before, Tok};
use super::units::is_unit_first;

impl Lexer<'_> {
    pub(super) fn other(&mut self) -> Faulty<Tok> {
        let rest = &self.text[self.pos..];
        let Some(c) = rest.chars().next() else {
            return Ok(Tok::End);
        };
        let end = self.pos + c.len_utf8();
        let fault = |message: &str| Fault::new(message, self.pos, end);
        match c {
            '°' if rest[c.len_utf8()..].starts_with(['C', 'F']) => {
                let message = "a temperature in degrees is not read";
                let fault = Fault::new(message, self.pos, self.pos + 3);
                Err(fault.hint("write it in kelvins, K"))
            }
            '‰' => self.percent(self.pos, end - self.pos, 1000),
            '⁰' | '¹' | '²' | '³' | '⁴'..='⁹' | '⁺' | '⁻' => self.raised(),
            '∂' | 'ⅆ' => self.derivative().unwrap_or_else(|| {
                let message = "∂ is read in a derivative of one name only, as in ∂x/∂t";
                Err(Fault::new(message, self.pos, end))
            }),
            'µ' | 'μ' | 'Ω' | '\u{2126}' | 'Å' | '\u{212b}'
                if self.before != Before::Nothing
                    && (self.units_first || is_unit_first(rest.trim_end_matches([' ', '$']))) =>
            {
                match self.unit(false) {
                    Some(tok) => Ok(tok),
                    None if greek_name(c).is_some() => self.name(self.pos, end),
                    None => Err(strange(c, self.pos)),
                }
            }
            _ if greek_name(c).is_some() || super::symbols::name::accented(c).is_some() => {
                self.name(self.pos, end)
            }
            'ⁿ' => Err(fault("a raised letter is not read here").hint("write ^n")),
            '\'' | '′' => Err(fault("a prime belongs right behind a name")),
            '_' => Err(fault("an index belongs right behind a name").hint("write v_1 or v_{G1}")),
            '.' => Err(fault("a point without digits").hint("write * for a product")),
            '∈' | '∉' | 'ℝ' | '∅' | '∞' => Err(strange(c, self.pos).hint(SETS)),
            '!' => Err(fault(
                "a factorial is read right behind a whole number only",
            )),
            '&' => Err(fault("`&` is no part of a formula")),
            c => {
                let tok = sign(c).ok_or_else(|| strange(c, self.pos))?;
                self.pos = end;
                Ok(tok)
            }
        }
    }
}

/// A text with plain characters for full-width ones and digits of other styles, and for each of its bytes, and its end, the
/// place in the text as it was. Nothing where there are none.
pub(super) fn plain_width(text: &str) -> Option<(String, Vec<usize>)> {
    let plain = |c: char| match u32::from(c) {
        code @ 0xff01..=0xff5e => char::from_u32(code - 0xfee0),
        code @ 0x1d7ce..=0x1d7ff => char::from_digit((code - 0x1d7ce) % 10, 10),
        _ => None,
    };
    text.contains(|c| plain(c).is_some()).then(|| {
        let (mut out, mut places) = (String::with_capacity(text.len()), Vec::new());
        for (at, c) in text.char_indices() {
            let written = plain(c).unwrap_or(c);
            out.push(written);
            places.extend(std::iter::repeat_n(at, written.len_utf8()));
        }
        places.push(text.len());
        (out, places)
    })
}

/// What one character stands for by itself.
fn sign(c: char) -> Option<Tok> {
    Some(match c {
        '−' | '–' | '—' | '‐' | '‑' | '﹣' => Tok::Minus,
        '∥' | '‖' => Tok::Bar,
        '±' => Tok::PlusMinus,
        '∓' => Tok::MinusPlus,
        '·' | '⋅' | '∙' | '•' | '∗' => Tok::Times,
        '×' | '⨯' | '✕' => Tok::Cross,
        '÷' | '∕' | '⁄' => Tok::Slash,
        '√' => Tok::Root(2),
        '∛' => Tok::Root(3),
        '≤' | '⩽' | '≦' => Tok::Relation(Relation::LessEqual),
        '≥' | '⩾' | '≧' => Tok::Relation(Relation::GreaterEqual),
        '≠' => Tok::Relation(Relation::NotEqual),
        '≈' | '≃' | '≅' => Tok::Relation(Relation::Approximately),
        '≡' => Tok::Relation(Relation::Equal),
        '°' | '∘' | 'º' | '˚' => Tok::Degree,
        '⟨' => Tok::Open('<'),
        '⟩' => Tok::Close('>'),
        'π' | '𝜋' | '𝛑' | '𝝅' => Tok::Name("pi".into()),
        _ => {
            let (_, of) = pairs(FRACTIONS).find(|(sign, _)| sign.chars().eq([c]))?;
            let (n, d) = of.split_once('/')?;
            Tok::Vulgar(n.parse().ok()?, d.parse().ok()?)
        }
    })
}

/// Fractions that are one sign.
const FRACTIONS: &str = "½ 1/2 ⅓ 1/3 ⅔ 2/3 ¼ 1/4 ¾ 3/4 ⅕ 1/5 ⅖ 2/5 ⅗ 3/5 ⅘ 4/5 ⅙ 1/6 ⅚ 5/6 ⅐ 1/7 ⅛ 1/8 ⅜ 3/8 ⅝ 5/8 \
    ⅞ 7/8 ⅑ 1/9 ⅒ 1/10";

/// A character that has no place in a formula.
fn strange(c: char, at: usize) -> Box<Fault> {
    let end = at + c.len_utf8();
    if is_invisible(c) {
        let message = format!(
            "an invisible character (U+{:04X}) stands here",
            u32::from(c)
        );
        return Fault::new(message, at, end).hint("type the formula anew");
    }
    if c.is_control() {
        return Fault::new(
            format!("a control character (U+{:04X}) stands here", u32::from(c)),
            at,
            end,
        );
    }
    Fault::new(format!("`{c}` has no place in a formula"), at, end)
}
