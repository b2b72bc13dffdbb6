//! Expressions back to text: plain for machines, Unicode for terminals, LaTeX for print.
//!
//! What is written reads back as the same value with the same names declared. Only the order of factors is touched:
//! numbers first, functions last.

use num_traits::Signed;

use super::quotient::Quotient;
use super::symbols::{greek_letter, greek_name, is_greek, parts_of};
use super::visible::{in_math, visible};
use crate::dimension::superscript;
use crate::expr::{Expr, Function, Node, Rational, number};

/// How a name is typeset where the caller says so.
type Names<'a> = &'a dyn Fn(&str) -> Option<String>;

/// Machine-readable infix: `3*v*cos(theta)/(2*l)`.
pub fn write_plain(e: &Expr) -> String {
    write(e, Style::Plain, &|_| None)
}

/// For terminals: `3 v cosθ/(2 ℓ)`. `names` gives the LaTeX spelling of a name, where it is a special one.
pub fn write_unicode(e: &Expr, names: &dyn Fn(&str) -> Option<String>) -> String {
    write(e, Style::Unicode, names)
}

/// For print: `\frac{3 v \cos\theta}{2 \ell}`. `names` gives the LaTeX spelling of a name, where it is a special one.
pub fn write_latex(e: &Expr, names: &dyn Fn(&str) -> Option<String>) -> String {
    write(e, Style::Latex, names)
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Style {
    Plain,
    Unicode,
    Latex,
}

struct Writer<'a> {
    style: Style,
    names: Names<'a>,
    out: String,
}

fn write(e: &Expr, style: Style, names: Names) -> String {
    let mut writer = Writer {
        style,
        names,
        out: String::new(),
    };
    writer.sum(e);
    writer.out
}

impl Writer<'_> {
    fn sum(&mut self, e: &Expr) {
        for (i, term) in e.terms().iter().enumerate() {
            let q = match self.style {
                Style::Plain => Quotient::of(term),
                _ => Quotient::typeset(term),
            };
            match (i, q.negative) {
                (0, true) => self.out.push_str(if self.style == Style::Unicode {
                    "−"
                } else {
                    "-"
                }),
                (0, false) => {}
                (_, true) => self.out.push_str(if self.style == Style::Unicode {
                    " − "
                } else {
                    " - "
                }),
                (_, false) => self.out.push_str(" + "),
            }
            self.quotient(&q);
        }
    }

    fn quotient(&mut self, q: &Quotient) {
        if q.below.is_empty() {
            return self.product(&q.above);
        }
        if self.style == Style::Latex {
            self.out.push_str("\\frac{");
            self.lone_product(&q.above);
            self.out.push_str("}{");
            self.lone_product(&q.below);
            self.out.push('}');
            return;
        }
        self.product(&q.above);
        self.out.push('/');
        let single = q.below.len() == 1;
        // Without brackets √2 x and 2³ x would go on below the slash.
        if !single {
            self.out.push('(');
        }
        self.product(&q.below);
        if !single {
            self.out.push(')');
        }
    }

    /// A product that stands alone in braces, where a sum needs no brackets.
    fn lone_product(&mut self, factors: &[Expr]) {
        match factors {
            [only] if matches!(only.node(), Node::Sum(_)) => self.sum(only),
            _ => self.product(factors),
        }
    }

    fn product(&mut self, factors: &[Expr]) {
        if factors.is_empty() {
            self.out.push('1');
        }
        for (i, factor) in factors.iter().enumerate() {
            if i > 0 {
                let digit = matches!(leading(factor).node(), Node::Number(_));
                self.out.push_str(match self.style {
                    Style::Plain => "*",
                    Style::Unicode if digit => "·",
                    Style::Latex if digit => " \\cdot ",
                    _ => " ",
                });
            }
            self.factor(factor);
        }
    }

    fn bracketed(&mut self, e: &Expr) {
        let tall = self.style == Style::Latex && is_tall(e);
        self.out.push_str(if tall { "\\left(" } else { "(" });
        self.sum(e);
        self.out.push_str(if tall { "\\right)" } else { ")" });
    }

    fn factor(&mut self, e: &Expr) {
        match e.node() {
            Node::Number(value) if value.is_integer() && !value.is_negative() => {
                self.out.push_str(&value.numer().to_string())
            }
            Node::Number(_) | Node::Sum(_) | Node::Product(_) => self.bracketed(e),
            Node::Symbol(name) => self.name(name),
            Node::Call(function, argument) => self.call(*function, argument, None),
            Node::Power(base, exponent) => self.power(base, exponent),
        }
    }

    fn power(&mut self, base: &Expr, exponent: &Expr) {
        if exponent.as_number().is_some_and(|k| number::is(k, 1, 2)) {
            match self.style {
                Style::Plain => {
                    self.out.push_str("sqrt(");
                    self.sum(base);
                    self.out.push(')');
                }
                Style::Unicode => {
                    self.out.push('√');
                    match base.as_number() {
                        Some(n) if n.is_integer() && !n.is_negative() => self.factor(base),
                        _ => self.bracketed(base),
                    }
                }
                Style::Latex => {
                    self.out.push_str("\\sqrt{");
                    self.sum(base);
                    self.out.push('}');
                }
            }
            return;
        }
        let raised = exponent
            .as_number()
            .filter(|k| k.is_integer() && k.is_positive());
        if let (Node::Call(function, argument), true, Some(k)) =
            (base.node(), self.style != Style::Plain, raised)
            && *function != Function::Abs
        {
            return self.call(*function, argument, Some(k));
        }
        let simple = match base.node() {
            Node::Number(value) => value.is_integer() && !value.is_negative(),
            Node::Symbol(name) => !self.has_mark(name),
            Node::Call(..) => self.style == Style::Plain,
            Node::Power(_, k) => {
                self.style == Style::Plain && k.as_number().is_some_and(|k| number::is(k, 1, 2))
            }
            _ => false,
        };
        if simple {
            self.factor(base);
        } else {
            self.bracketed(base);
        }
        match (self.style, raised) {
            (Style::Unicode, Some(k)) if k.numer().bits() < 16 => {
                self.out.push_str(&superscript(k))
            }
            (Style::Latex, _) => {
                self.out.push_str("^{");
                self.sum(exponent);
                self.out.push('}');
            }
            (_, Some(k)) => {
                self.out.push('^');
                self.out.push_str(&k.numer().to_string());
            }
            _ if exponent
                .as_symbol()
                .is_some_and(|n| !n.contains(['^', '\''])) =>
            {
                self.out.push('^');
                self.factor(exponent);
            }
            _ => {
                self.out.push_str("^(");
                self.sum(exponent);
                self.out.push(')');
            }
        }
    }

    /// Whether a name carries a prime or a raised mark, beside which an exponent would be misread.
    fn has_mark(&self, name: &str) -> bool {
        let marked = |text: &str| text.contains(['^', '\'']);
        marked(name)
            || self.style != Style::Plain && (self.names)(name).is_some_and(|latex| marked(&latex))
    }

    fn call(&mut self, function: Function, argument: &Expr, power: Option<&Rational>) {
        // Bars inside bars cannot tell which ones close, so beyond LaTeX's \left and \right the name is written out.
        let bars =
            self.style == Style::Latex || self.style == Style::Unicode && !has_bars(argument);
        if function == Function::Abs && bars {
            self.out.push_str(if self.style == Style::Latex {
                "\\left|"
            } else {
                "|"
            });
            self.sum(argument);
            self.out.push_str(if self.style == Style::Latex {
                "\\right|"
            } else {
                "|"
            });
            return;
        }
        match self.style {
            Style::Latex => self.out.push_str(latex_function(function)),
            _ => self.out.push_str(function.name()),
        }
        if let Some(k) = power {
            match self.style {
                Style::Latex => self.out.push_str(&format!("^{{{k}}}")),
                _ if k.numer().bits() < 14 => self.out.push_str(&superscript(k)),
                _ => self.out.push_str(&format!("^{k}")),
            }
        }
        // A bare argument: a name, or a whole number of times a Greek angle.
        let bare = match argument.node() {
            // A number goes on: `sinπ √v` is read as sin(π √v).
            Node::Symbol(name) => &**name != "pi" && !name.contains(['^', '\'']),
            Node::Product(factors) => match factors.as_slice() {
                [k, name] => {
                    k.as_number()
                        .is_some_and(|k| k.is_integer() && k.is_positive())
                        && name
                            .as_symbol()
                            .is_some_and(|n| greek_letter(n).is_some() && &**n != "pi")
                }
                _ => false,
            },
            _ => false,
        };
        // A quotient behind an inverse function belongs to it: `atan v/c` is read as that of v/c.
        let inverse = matches!(function, Function::Asin | Function::Acos | Function::Atan);
        if self.style == Style::Plain || !bare || inverse && self.style == Style::Unicode {
            return self.bracketed(argument);
        }
        let greek = argument
            .as_symbol()
            .is_some_and(|n| greek_letter(&parts_of(n).base).is_some());
        if !greek
            || (self.style == Style::Latex
                && (self.names)(argument.as_symbol().map_or("", |n| n)).is_some())
        {
            self.out.push(' ');
        }
        match argument.node() {
            Node::Product(factors) => {
                for factor in factors {
                    self.factor(factor);
                }
            }
            _ => self.factor(argument),
        }
    }

    fn name(&mut self, name: &str) {
        // Letters and digits are plain as they are; most names are.
        if self.style == Style::Plain && name.bytes().all(|b| b.is_ascii_alphanumeric()) {
            return self.out.push_str(name);
        }
        let special = (self.names)(name);
        let text = match (self.style, special) {
            (Style::Plain, _) => plain_name(name),
            (Style::Unicode, Some(latex)) => unicode_of_latex(name, &latex),
            (Style::Unicode, None) => unicode_name(name),
            (Style::Latex, Some(latex)) => latex,
            (Style::Latex, None) => latex_name(name),
        };
        self.out.push_str(&text);
    }
}

/// The factor a written product would start with.
fn leading(e: &Expr) -> &Expr {
    match e.node() {
        Node::Power(base, _) if e.under_root().is_none() => leading(base),
        _ => e,
    }
}

/// Whether a bracket around it should grow: a fraction or a root stands inside.
fn is_tall(e: &Expr) -> bool {
    e.parts().any(|part| match part.node() {
        Node::Number(value) => !value.is_integer(),
        Node::Power(_, exponent) => exponent
            .as_number()
            .is_none_or(|k| !k.is_integer() || k.is_negative()),
        _ => false,
    })
}

/// Whether an absolute value stands inside.
fn has_bars(e: &Expr) -> bool {
    e.parts()
        .any(|part| matches!(part.node(), Node::Call(Function::Abs, _)))
}

pub(super) fn latex_function(function: Function) -> &'static str {
    match function {
        Function::Sin => "\\sin",
        Function::Cos => "\\cos",
        Function::Tan => "\\tan",
        Function::Asin => "\\arcsin",
        Function::Acos => "\\arccos",
        Function::Atan => "\\arctan",
        Function::Sinh => "\\sinh",
        Function::Cosh => "\\cosh",
        Function::Tanh => "\\tanh",
        Function::Exp => "\\exp",
        Function::Ln => "\\ln",
        Function::Abs => "\\operatorname{abs}",
    }
}

fn plain_name(name: &str) -> String {
    if name.contains(['(', '/']) && !name.contains('_') {
        return name.to_string();
    }
    let (body, mark) = match name.split_once('^') {
        Some((body, mark)) => (body, format!("^{{{mark}}}")),
        None => (name, String::new()),
    };
    let parts = parts_of(body);
    if parts.index.bytes().all(|b| b.is_ascii_alphanumeric()) {
        return format!("{body}{mark}");
    }
    // v_{C/G1}: without braces the index would end early.
    let accent = if parts.accent.is_empty() {
        String::new()
    } else {
        format!("_{}", parts.accent)
    };
    format!(
        "{}{accent}_{{{}}}{}{mark}",
        parts.base, parts.index, parts.marks
    )
}

/// The LaTeX spelling of a name: `theta` → `\theta`, `omega1` → `\omega_{1}`, `v_G1` → `v_{G1}`, `v1^+` → `v_{1}^{+}`.
pub fn latex_name(name: &str) -> String {
    if let Some((of, when)) = name.strip_suffix(')').and_then(|n| n.split_once('(')) {
        return format!("{}({})", latex_name(of), latex_name(when));
    }
    if let Some((above, below)) = derivative(name) {
        return format!(
            "\\frac{{d {}}}{{d {}}}",
            latex_name(above),
            latex_name(below)
        );
    }
    let parts = parts_of(name);
    let base = match parts.base.as_str() {
        "pi" => "\\pi".to_string(),
        base if is_greek(base) => format!("\\{base}"),
        "ell" => "\\ell".to_string(),
        base if base.chars().count() == 1 => match base.chars().next().and_then(greek_name) {
            Some(name) => format!("\\{name}"),
            None => in_math(base),
        },
        base => match change(base) {
            Some((sign, of)) => format!("\\{sign} {}", latex_name(of)),
            None => format!("\\mathrm{{{}}}", in_math(base)),
        },
    };
    let mut out = match parts.accent {
        "" => base,
        accent => (accent.split('_')).fold(base, |base, accent| format!("\\{accent}{{{base}}}")),
    };
    if !parts.index.is_empty() {
        let pieces: Vec<String> = parts.pieces.iter().map(|p| latex_index(p)).collect();
        out.push_str(&format!("_{{{}}}", pieces.join(",")));
    }
    let (primes, raised) = parts.marks.split_once('^').unwrap_or((&parts.marks, ""));
    out.push_str(&in_math(primes));
    match raised {
        "" => {}
        "+" | "-" | "*" => out.push_str(&format!("^{{{raised}}}")),
        word => out.push_str(&format!("^{{\\mathrm{{{}}}}}", in_math(word))),
    }
    out
}

/// `dv/dx` as v and x.
pub(super) fn derivative(name: &str) -> Option<(&str, &str)> {
    let (above, below) = name.split_once("/d")?;
    above.strip_prefix('d').map(|above| (above, below))
}

/// `Deltap` as Δ and p: a change of something.
fn change(base: &str) -> Option<(&'static str, &str)> {
    let split = |sign| base.strip_prefix(sign).map(|of| (sign, of));
    let found = split("Delta").or_else(|| split("delta"));
    found.filter(|(_, of)| of.len() == 1 || is_greek(of))
}

/// One index: a Greek letter, a word upright, or letters and digits.
fn latex_index(index: &str) -> String {
    // Two letters are two indices, as in ω_AB or v_xy, unless they are a word.
    let is_word = index == "in"
        || index.chars().count() > 2
            && index.chars().all(char::is_alphabetic)
            && index.chars().any(char::is_lowercase);
    if is_greek(index) {
        format!("\\{index}")
    } else if is_word {
        format!("\\mathrm{{{}}}", in_math(index))
    } else {
        in_math(index)
    }
}

/// Words as an index, upright: `rear_cart` → `\mathrm{rear}\,\mathrm{cart}`; a letter by itself leans.
pub fn latex_words(words: &str) -> String {
    let mut index = String::new();
    let mut word = String::new();
    for c in words.chars().chain(['\0']) {
        if c.is_alphanumeric() {
            word.push(c);
            continue;
        }
        match word.chars().count() {
            0 => {}
            1 => index.push_str(&word),
            _ => index.push_str(&format!("\\mathrm{{{word}}}")),
        }
        word.clear();
        match c {
            '/' | ',' => index.push(c),
            '\0' => {}
            // Anything else in a name is a separator; nothing of it reaches TeX.
            _ => index.push_str("\\,"),
        }
    }
    index
}

/// The name in Unicode: `theta` → `θ`, `omega1` → `ω₁`, `v_G1` → `v_G1`, `v1^+` → `v₁⁺`.
pub fn unicode_name(name: &str) -> String {
    if let Some((of, when)) = name.strip_suffix(')').and_then(|n| n.split_once('(')) {
        return format!("{}({})", unicode_name(of), unicode_name(when));
    }
    if let Some((above, below)) = derivative(name) {
        return format!("d{}/d{}", unicode_name(above), unicode_name(below));
    }
    let parts = parts_of(name);
    let mut out = match greek_letter(&parts.base) {
        Some(letter) => letter.to_string(),
        None => match change(&parts.base) {
            Some((sign, of)) => {
                let sign = greek_letter(sign).map_or(String::new(), String::from);
                sign + &unicode_name(of)
            }
            None => parts.base.clone(),
        },
    };
    out.extend(parts.accent.split('_').filter_map(|accent| match accent {
        "" => None,
        "hat" => Some('\u{302}'),
        "dot" => Some('\u{307}'),
        "ddot" => Some('\u{308}'),
        "bar" => Some('\u{304}'),
        "vec" => Some('\u{20d7}'),
        _ => Some('\u{303}'),
    }));
    let single = parts.base.chars().count() == 1 || greek_letter(&parts.base).is_some();
    if single && parts.index.bytes().all(|b| b.is_ascii_digit()) {
        let low = |c: char| char::from_u32(u32::from('₀') + c.to_digit(10).unwrap_or(0));
        out.extend(parts.index.chars().filter_map(low));
    } else if !parts.index.is_empty() {
        if !parts.index.starts_with(|c: char| c.is_ascii_digit()) {
            out.push('_');
        }
        // Words side by side would read as one.
        let apart = parts.pieces.iter().any(|p| p.chars().count() > 2);
        match apart {
            true => out.push_str(&parts.pieces.join(",")),
            false => out.push_str(&parts.index),
        }
    }
    let (primes, raised) = parts.marks.split_once('^').unwrap_or((&parts.marks, ""));
    out.push_str(&primes.replace('\'', "′"));
    match raised {
        "" => {}
        "+" => out.push('⁺'),
        "-" => out.push('⁻'),
        word => out.push_str(&format!("^{{{word}}}")),
    }
    visible(&out)
}

fn unicode_of_latex(name: &str, latex: &str) -> String {
    if latex == "\\ell" {
        return "ℓ".into();
    }
    match super::symbols::name::key_of_latex(latex) {
        Some(key) => {
            let written = unicode_name(&key);
            if latex.starts_with("\\ell") {
                written.replacen('l', "ℓ", 1)
            } else {
                written
            }
        }
        None => unicode_name(name),
    }
}
