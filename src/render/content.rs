//! What a text was read as, set in LaTeX or MathML.

use super::math::{LATEX, Style, latex_op};
use super::mathml::{MATHML, escape};
use crate::expr::Expr;
use crate::formula::Content;

/// How a format joins formulas.
struct Format {
    style: &'static Style,
    /// Words between two formulas.
    words: fn(&str) -> String,
    /// A sign between two formulas.
    sign: fn(&str) -> String,
    matrix: fn(&[Vec<String>]) -> String,
    /// A unit behind a number.
    unit: fn(&str) -> String,
}

/// A content in LaTeX; `expr` writes a formula.
pub fn latex(content: &Content, expr: &impl Fn(&Expr) -> String) -> String {
    let format = Format {
        style: &LATEX,
        words: |words| format!(" \\text{{{words}}} "),
        sign: |sign| format!(" {} ", latex_op(sign)),
        matrix: |rows| {
            let rows: Vec<String> = rows.iter().map(|row| row.join(" & ")).collect();
            let rows = rows.join(" \\\\ ");
            format!("\\begin{{pmatrix}} {rows} \\end{{pmatrix}}")
        },
        unit: |unit| format!("\\,\\mathrm{{{unit}}}"),
    };
    format.written(content, expr)
}

/// The same in MathML.
pub fn mathml(content: &Content, expr: &impl Fn(&Expr) -> String) -> String {
    let format = Format {
        style: &MATHML,
        words: |words| format!("<mtext>{words}</mtext>"),
        sign: |sign| format!("<mo>{}</mo>", escape(sign)),
        matrix: |rows| {
            let cells = |row: &Vec<String>| format!("<mtd>{}</mtd>", row.join("</mtd><mtd>"));
            let rows = rows.iter().map(|row| format!("<mtr>{}</mtr>", cells(row)));
            let rows: String = rows.collect();
            format!("<mrow><mo>(</mo><mtable>{rows}</mtable><mo>)</mo></mrow>")
        },
        unit: |unit| {
            let unit = escape(unit);
            format!("<mspace width=\"0.2em\"></mspace><mi mathvariant=\"normal\">{unit}</mi>")
        },
    };
    format.written(content, expr)
}

impl Format {
    fn written(&self, content: &Content, expr: &impl Fn(&Expr) -> String) -> String {
        let all = |values: &[Expr]| values.iter().map(expr).collect::<Vec<String>>();
        match content {
            Content::Scalar(e) => expr(e),
            Content::Either(values) => all(values).join(&(self.words)(" or ")),
            Content::Joined(join, parts) => {
                let parts = parts.iter().map(|part| self.written(part, expr));
                let parts: Vec<String> = parts.collect();
                parts.join(&(self.words)(join.word()))
            }
            Content::Vector(v) => {
                let parts: Vec<(Expr, usize)> = v.iter().cloned().zip(0..).collect();
                self.style.vector(&parts, expr)
            }
            Content::Matrix(rows) => {
                let rows: Vec<Vec<String>> = rows.iter().map(|row| all(row)).collect();
                (self.matrix)(&rows)
            }
            Content::Quantity(q) => expr(&q.written) + &(self.unit)(&q.unit_text),
            Content::Relations(sides, signs) => {
                let signs = signs.iter().map(|sign| (self.sign)(sign.sign()));
                let signs = std::iter::once(String::new()).chain(signs);
                let sides = sides.iter().map(|side| self.written(side, expr));
                signs.zip(sides).map(|(sign, side)| sign + &side).collect()
            }
        }
    }
}
