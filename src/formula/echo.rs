//! A written formula set in LaTeX as it was typed: the same fractions, brackets, minus signs and order, so that people
//! see how they were understood.

use super::symbols::greek_letter;
use super::write::{latex_function, latex_name};
use super::written::{Link, Shape, Sign, Written};

/// Sets a written piece in LaTeX. `text` is the formula it was read from; `names` gives the LaTeX spelling of a name,
/// where it is a special one.
pub fn echo_latex(w: &Written, text: &str, names: &dyn Fn(&str) -> Option<String>) -> String {
    let mut echo = Echo {
        text,
        names,
        out: String::new(),
    };
    echo.piece(w);
    echo.out
}

struct Echo<'a> {
    text: &'a str,
    names: &'a dyn Fn(&str) -> Option<String>,
    out: String,
}

impl Echo<'_> {
    fn piece(&mut self, w: &Written) {
        match &w.shape {
            Shape::Number(literal) => self.number(w, &literal.value.to_string()),
            Shape::Symbol(name) => {
                let spelled = (self.names)(name).unwrap_or_else(|| latex_name(name));
                self.out.push_str(&spelled);
            }
            Shape::Sum(terms) => self.sum(terms),
            Shape::Product(factors) => self.product(factors),
            Shape::Fraction(above, below) => {
                self.out.push_str("\\frac");
                self.braced(above);
                self.braced(below);
            }
            Shape::Power(base, exponent) => {
                match &base.shape {
                    Shape::Call(function, argument) => {
                        self.out.push_str(latex_function(*function));
                        self.out.push('^');
                        self.braced(exponent);
                        return self.argument(argument);
                    }
                    Shape::Number(_) if !self.is_plain(base) => self.enclosed(base),
                    Shape::Number(_) | Shape::Bracket(_) | Shape::Abs(_) => self.piece(base),
                    Shape::Symbol(name) if !name.contains(['^', '\'']) => self.piece(base),
                    _ => self.enclosed(base),
                }
                self.out.push('^');
                self.braced(exponent);
            }
            Shape::Root(index, inner) => {
                self.out.push_str("\\sqrt");
                if let Some(index) = index {
                    self.out.push('[');
                    self.piece(index);
                    self.out.push(']');
                }
                self.braced(inner);
            }
            Shape::Call(function, argument) => {
                self.out.push_str(latex_function(*function));
                self.argument(argument);
            }
            Shape::Reciprocal(function, argument) => {
                self.out.push_str(match function {
                    crate::expr::Function::Cos => "\\sec",
                    crate::expr::Function::Sin => "\\csc",
                    crate::expr::Function::Sinh => "\\operatorname{csch}",
                    crate::expr::Function::Cosh => "\\operatorname{sech}",
                    crate::expr::Function::Tanh => "\\coth",
                    _ => "\\cot",
                });
                self.argument(argument);
            }
            Shape::Bracket(inner) => self.enclosed(inner),
            Shape::Abs(inner) => {
                self.out.push_str("\\left|");
                self.piece(inner);
                self.out.push_str("\\right|");
            }
            Shape::Degrees(inner) => {
                if self.is_plain(inner) {
                    self.piece(inner);
                } else {
                    self.enclosed(inner);
                }
                self.out.push_str("^{\\circ}");
            }
            Shape::Measured(inner, _) => {
                self.piece(inner);
                let unit = self.text.get(inner.end..w.end).unwrap_or("").trim();
                self.out.push_str(&format!("\\,\\mathrm{{{unit}}}"));
            }
            Shape::List(parts) => {
                self.out.push_str("\\left(");
                for (i, part) in parts.iter().enumerate() {
                    self.out.push_str(if i > 0 { ", " } else { "" });
                    self.piece(part);
                }
                self.out.push_str("\\right)");
            }
        }
    }

    /// Whether it is a number typed in digits alone.
    fn is_plain(&self, w: &Written) -> bool {
        let typed = self.text.get(w.start..w.end).unwrap_or("");
        let digits = !typed.is_empty() && typed.bytes().all(|b| b.is_ascii_digit() || b == b'.');
        digits && matches!(w.shape, Shape::Number(_))
    }

    /// The digits as typed, where they were typed as such.
    fn number(&mut self, w: &Written, value: &str) {
        let typed = self.text.get(w.start..w.end).unwrap_or("");
        let plain = self.is_plain(w);
        let power = typed.split_once(['e', 'E']).filter(|(digits, power)| {
            let power = power.trim_start_matches(['+', '-']);
            !digits.is_empty() && power.bytes().all(|b| b.is_ascii_digit())
        });
        match power {
            _ if plain => self.out.push_str(typed),
            Some((digits, power)) => {
                let power = power.trim_start_matches('+');
                self.out
                    .push_str(&format!("{digits} \\times 10^{{{power}}}"));
            }
            None => self.out.push_str(value),
        }
    }

    fn sum(&mut self, terms: &[(Sign, Written)]) {
        for (i, (sign, term)) in terms.iter().enumerate() {
            let sign = match sign {
                Sign::Plus if i == 0 => "",
                Sign::Plus => "+",
                Sign::Minus => "-",
                Sign::PlusMinus => "\\pm",
                Sign::MinusPlus => "\\mp",
            };
            if i > 0 {
                self.out.push_str(&format!(" {sign} "));
            } else {
                self.out.push_str(sign);
                self.out
                    .push_str(if sign.starts_with('\\') { " " } else { "" });
            }
            self.piece(term);
        }
    }

    /// Factors from left to right; what stands before a slash goes above a bar, as it was understood.
    fn product(&mut self, factors: &[(Link, Written)]) {
        let mut done = String::new();
        for (i, (link, factor)) in factors.iter().enumerate() {
            let mut inner = Echo {
                text: self.text,
                names: self.names,
                out: String::new(),
            };
            if i > 0 && *link == Link::Over {
                inner.unbracketed(factor);
                let above = match (i, &factors[0].1.shape) {
                    // A bracket that fills the numerator is not needed above a bar.
                    (1, Shape::Bracket(_)) => {
                        let mut first = Echo {
                            text: self.text,
                            names: self.names,
                            out: String::new(),
                        };
                        first.unbracketed(&factors[0].1);
                        first.out
                    }
                    _ => done,
                };
                done = format!("\\frac{{{above}}}{{{}}}", inner.out);
                continue;
            }
            match &factor.shape {
                Shape::Sum(_) if i > 0 => inner.enclosed(factor),
                _ => inner.piece(factor),
            }
            let digit = inner
                .out
                .starts_with(|c: char| c.is_ascii_digit() || c == '.');
            done.push_str(match link {
                _ if i == 0 => "",
                Link::Times => " \\cdot ",
                Link::Cross => " \\times ",
                _ if digit => " \\cdot ",
                _ => " ",
            });
            done.push_str(&inner.out);
        }
        self.out.push_str(&done);
    }

    fn argument(&mut self, w: &Written) {
        match &w.shape {
            Shape::Number(_) if !self.is_plain(w) => self.enclosed(w),
            // Brackets right behind the function would close before the degrees.
            Shape::Degrees(inner) if !self.is_plain(inner) => self.enclosed(w),
            Shape::Bracket(inner) => self.enclosed(inner),
            Shape::Symbol(name) if greek_letter(name).is_some() && (self.names)(name).is_none() => {
                self.piece(w)
            }
            Shape::Abs(_) => self.piece(w),
            Shape::Symbol(_) | Shape::Number(_) | Shape::Degrees(_) => {
                self.out.push(' ');
                self.piece(w);
            }
            _ => self.enclosed(w),
        }
    }

    fn enclosed(&mut self, w: &Written) {
        self.out.push_str("\\left(");
        self.unbracketed(w);
        self.out.push_str("\\right)");
    }

    fn braced(&mut self, w: &Written) {
        self.out.push('{');
        self.unbracketed(w);
        self.out.push('}');
    }

    fn unbracketed(&mut self, w: &Written) {
        match &w.shape {
            Shape::Bracket(inner) => self.unbracketed(inner),
            _ => self.piece(w),
        }
    }
}
