//! Numbers that nobody would write as a fraction stand as decimals of four digits: data in pounds and inches make fractions of
//! twenty digits. Only what is displayed is rounded; the claims keep every digit.

use super::words::{self, say};
use super::{Inline, Math, Part, Solution};
use crate::expr::{Expr, Node, Rational, Symbol, number};

/// Digits above and below the line that are still written out, and those that are where others are rounded.
const WRITTEN: [usize; 2] = [14, 4];

impl Solution {
    /// Rounds all that is displayed; `axes` begins the sentence that then says so.
    pub(super) fn round(&mut self, axes: &str) {
        let mut names = Vec::new();
        for most in WRITTEN {
            for math in self
                .sections
                .iter_mut()
                .flat_map(|s| &mut s.parts)
                .flat_map(maths)
            {
                each(math, most, &mut names);
            }
            if names.is_empty() {
                return;
            }
        }
        let is_axes =
            |text: &[Inline]| matches!(text.first(), Some(Inline::Text(t)) if t.starts_with(axes));
        for part in self.sections.iter_mut().flat_map(|s| &mut s.parts) {
            if let Part::Text(text) = part
                && is_axes(text)
            {
                text.push(say(" Decimals are rounded."));
            }
        }
        let latex = |name: Symbol| (name.clone(), name.to_string());
        self.names.extend(names.into_iter().map(latex));
    }
}

/// All formulas of a part.
fn maths(part: &mut Part) -> Vec<&mut Vec<Math>> {
    let texts: &mut [Vec<Inline>] = match part {
        Part::Display(lines) | Part::Result(lines) => {
            return lines.iter_mut().map(|l| &mut l.math).collect();
        }
        Part::Text(text) => std::slice::from_mut(text),
        Part::List(items) => items,
        Part::Matrix(_) | Part::Figure(_) => &mut [],
    };
    let pieces = texts.iter_mut().flatten();
    let math = pieces.filter_map(|piece| match piece {
        Inline::Math(math) => Some(math),
        Inline::Text(_) => None,
    });
    math.collect()
}

fn each(math: &mut [Math], most: usize, names: &mut Vec<Symbol>) {
    for m in math {
        match m {
            // Between other numbers a decimal stands in brackets.
            Math::Factor(e) => {
                let decimal = rounded(e, most, names);
                *m = match e.as_number().is_some() && decimal != *e {
                    true => Math::Brackets(vec![decimal.into()]),
                    false => Math::Factor(decimal),
                };
            }
            Math::Expr(e) | Math::Along(e) => *e = rounded(e, most, names),
            Math::Vector(v) => *v = v.each_ref().map(|e| rounded(e, most, names)),
            Math::Brackets(inner) => each(inner, most, names),
            Math::Name(_) | Math::Op(_) => {}
        }
    }
}

/// A formula with the decimal of each long number in its place, as a symbol of that name.
fn rounded(e: &Expr, most: usize, names: &mut Vec<Symbol>) -> Expr {
    match e.node() {
        Node::Number(value) if is_long(value, most) => {
            let value = number::to_f64(value);
            let name = Symbol::from(words::digits(value.abs()).as_str());
            let decimal = Expr::symbol(&name);
            names.push(name);
            if value < 0.0 { -decimal } else { decimal }
        }
        Node::Sum(terms) => Expr::sum(terms.iter().map(|t| rounded(t, most, names))),
        Node::Product(factors) => Expr::product(factors.iter().map(|f| rounded(f, most, names))),
        Node::Power(base, exponent) => rounded(base, most, names).power(exponent.clone()),
        Node::Call(function, argument) => Expr::call(*function, rounded(argument, most, names)),
        _ => e.clone(),
    }
}

fn is_long(value: &Rational, most: usize) -> bool {
    let digits = [value.numer(), value.denom()].map(|part| part.to_string().len());
    let is_plain = (1e-3..1e5).contains(&number::to_f64(value).abs());
    !value.is_integer() && is_plain && digits.iter().sum::<usize>() > most
}
