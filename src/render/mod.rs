//! Writes derivations, motions and verdicts in the formats people and programs read. Decides nothing: every number, verdict
//! and reason comes in ready.

pub mod certified;
pub mod compare;
pub mod content;
pub mod faults;
pub mod fonts;
pub mod friction;
pub mod grade;
pub mod html;
pub mod json;
pub mod latex_document;
pub mod markdown;
pub mod math;
pub mod mathml;
pub mod plain;
pub mod plots;
pub mod possible;
pub mod printed;
pub mod report;
mod report_pareto;
pub mod several;
#[cfg(feature = "site")]
pub mod site;
pub mod stages;
pub mod steps;
pub mod text;

use std::collections::BTreeMap;

use crate::answer::Matrix;
use crate::derive::{Derivation, Equation};
use crate::dimension::{Dimension, System};
use crate::expr::{Expr, Point, Rational, Symbol};
use crate::formula::{Symbols, is_hidden, trimmed, visible};
use crate::numeric::{self, Answered};
use crate::scene::{Ask, Scene};
pub use crate::solution::assumptions;
use crate::solution::{Solution, is_safe_latex};

/// Lines, and characters of a line, that are told of what is wrong.
const SCREEN: (usize, usize) = (100, 400);

/// A message for people: no longer than they will read, without characters that a terminal would obey.
pub fn screen(message: &str) -> String {
    let mut out = String::new();
    let mut lines = message.trim_end().lines();
    for line in lines.by_ref().take(SCREEN.0) {
        if !out.is_empty() {
            out.push('\n');
        }
        out.push_str(&shortened(&visible(line), SCREEN.1));
    }
    match lines.count() {
        0 => {}
        n => out.push_str(&format!("\nand {n} more lines")),
    }
    out
}

/// Text for a terminal: characters that it would obey are named.
pub fn terminal(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\n' | '\t' => out.push(c),
            c if is_hidden(c) => out.push_str(&format!("[U+{:04X}]", u32::from(c))),
            c => out.push(c),
        }
    }
    out
}

/// Rows with columns of equal width, numbers to the right and everything else to the left.
fn columns(rows: &[Vec<String>], is_number: impl Fn(usize) -> bool) -> Vec<String> {
    let width = |j: usize| rows.iter().map(|r| r[j].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..rows.first().map_or(0, Vec::len)).map(width).collect();
    let line = |row: &Vec<String>| {
        let cells = row.iter().zip(&widths).enumerate();
        let cells = cells.map(|(j, (cell, width))| match is_number(j) {
            true => format!("{cell:>width$}"),
            false => format!("{cell:<width$}"),
        });
        cells.collect::<Vec<_>>().join("  ")
    };
    rows.iter().map(line).collect()
}

/// Version of the JSON that is written; it grows when a field changes its meaning or goes.
pub const VERSION: u32 = 1;

/// Data as JSON for people and programs; what would be hidden stands there by its number.
pub fn pretty(value: &serde_json::Value) -> String {
    let text = serde_json::to_string_pretty(value).unwrap_or_default();
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if c != '\n' && is_hidden(c) {
            let units = c.encode_utf16(&mut [0; 2]).to_vec();
            units
                .iter()
                .for_each(|u| out.push_str(&format!("\\u{u:04x}")));
        } else {
            out.push(c);
        }
    }
    out
}

/// A text of at most `most` characters and how many more there are.
pub fn shortened(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        None => text.to_string(),
        Some((at, _)) => {
            let more = text[at..].chars().count();
            format!("{}… ({more} more characters)", &text[..at])
        }
    }
}

/// A line as it is, or beginning and end of one that nobody reads to its end.
pub(crate) fn cut(line: &str) -> String {
    const LONGEST: usize = 900;
    const BEGINNING: usize = 240;
    const END: usize = 120;
    let all: Vec<char> = line.chars().collect();
    if all.len() <= LONGEST {
        return line.to_string();
    }
    let part = |some: &[char]| some.iter().collect::<String>();
    let (begins, ends) = (part(&all[..BEGINNING]), part(&all[all.len() - END..]));
    let left = all.len() - BEGINNING - END;
    format!("{begins} … {left} characters, which `--format json` has … {ends}")
}

/// The names a formula about a scene may hold. Answers may name what a derivation defines, so names that are not declared are
/// read as they stand.
pub fn symbols_of(scene: &Scene) -> Symbols {
    let mut symbols = Symbols::open();
    scene.declare_parameters(&mut symbols);
    for q in &scene.questions {
        symbols.declare_as(q.name.as_str(), q.latex.as_deref(), None);
    }
    symbols
}

/// A solution that holds nothing but how the scene's symbols are written.
pub fn naming(scene: &Scene) -> Solution {
    let mut names: BTreeMap<Symbol, String> = latex_names(scene)
        .into_iter()
        .map(|(name, latex)| (Symbol::from(name.as_str()), latex))
        .collect();
    for q in &scene.questions {
        if let Some(latex) = &q.latex {
            names.insert(Symbol::from(q.name.as_str()), latex.clone());
        }
    }
    Solution {
        names,
        ..Solution::default()
    }
}

/// LaTeX of a scene's own symbols, where it only sets symbols.
pub fn latex_names(scene: &Scene) -> BTreeMap<String, String> {
    let named = scene
        .parameters
        .iter()
        .filter_map(|p| Some((p.name.to_string(), p.latex.clone()?)));
    named.filter(|(_, latex)| is_safe_latex(latex)).collect()
}

/// An expression in LaTeX with the scene's own symbols.
pub fn latex(scene: &Scene, e: &Expr) -> String {
    let names = latex_names(scene);
    crate::formula::write_latex(e, &|name| names.get(name).cloned())
}

/// An expression for the terminal.
pub fn unicode(scene: &Scene, e: &Expr) -> String {
    let names = latex_names(scene);
    crate::formula::write_unicode(e, &|name| names.get(name).cloned())
}

/// The two sides of an equation: Σ coefficient × unknown = known.
pub fn sides(derivation: &Derivation, equation: &Equation) -> (Expr, Expr) {
    let symbol = |u| Expr::symbol(derivation.names.plain(u));
    let left = Expr::sum(equation.terms.iter().map(|(u, k)| k * &symbol(*u)));
    (left, equation.known.clone())
}

/// A value in SI units.
#[derive(Clone, Debug)]
pub struct Value {
    /// Nearest double, or close to it.
    pub approximate: f64,
    /// The exact value, where it is a fraction.
    pub exact: Option<Rational>,
}

/// One number of a numeric solution, or why there is none.
#[derive(Clone, Debug)]
pub struct Number {
    /// Name of the question, with `_x` or `_y` for a component.
    pub name: String,
    /// The question.
    pub question: String,
    /// The value in SI units.
    pub value: Result<Value, String>,
}

/// The numbers of an exact solution.
pub fn exact_numbers(answers: Answered<Rational>) -> Vec<Number> {
    let value = |v: Rational| Value {
        approximate: crate::expr::number::to_f64(&v),
        exact: Some(v),
    };
    numbers(answers, value)
}

/// The numbers of a solution in doubles.
pub fn double_numbers(answers: Answered<f64>) -> Vec<Number> {
    numbers(answers, |v| Value {
        approximate: v,
        exact: None,
    })
}

fn numbers<T>(answers: Answered<T>, value: impl Fn(T) -> Value) -> Vec<Number> {
    let mut out = Vec::new();
    for (question, answer) in answers {
        let mut push = |suffix: &str, value| {
            out.push(Number {
                name: format!("{question}{suffix}"),
                question: question.clone(),
                value,
            });
        };
        match answer {
            Ok(found) => {
                for (suffix, v) in found.components() {
                    push(suffix, Ok(value(v)));
                }
            }
            Err(reason) => push("", Err(reason.to_string())),
        }
    }
    out
}

/// The value of a closed form at the scene's values; `None` where a symbol has none.
pub fn value(scene: &Scene, e: &Expr) -> Option<Value> {
    let values = scene.values();
    if !e.symbols().iter().all(|s| values.contains_key(s)) {
        return None;
    }
    let put_in = e.substitute(&values);
    let exact = put_in.evaluate(&Point::<Rational>::default());
    let approximate = match &exact {
        Some(exact) => crate::expr::number::to_f64(exact),
        None => put_in.evaluate(&Point::<f64>::default())?,
    };
    Some(Value { approximate, exact })
}

/// The value of an answer at the scene's values, through the definitions where the derivation it comes from went in steps.
pub fn answer_value(scene: &Scene, from: Option<&Derivation>, closed: &Expr) -> Option<Value> {
    let Some(derivation) = from.filter(|d| d.in_steps) else {
        return value(scene, closed);
    };
    let point = numeric::values(scene).ok()?;
    let approximate = crate::verify::evaluate(closed, derivation, &point)?;
    Some(Value {
        approximate,
        exact: None,
    })
}

/// The shortest digits that read back as the same double; with an exponent where there would be a row of zeros.
pub fn double(value: f64) -> String {
    match value.abs() {
        size if size == f64::INFINITY => "beyond the largest double".into(),
        size if size == 0.0 || (1e-5..1e16).contains(&size) => format!("{value}"),
        _ => format!("{value:e}"),
    }
}

/// A number with six significant digits, without trailing zeros.
pub fn digits(value: f64) -> String {
    if value == 0.0 {
        return String::from("0");
    }
    let magnitude = value.abs().log10().floor();
    if !(-4.0..6.0).contains(&magnitude) {
        let text = format!("{value:.5e}");
        return match text.split_once('e') {
            Some((mantissa, exponent)) => format!("{}e{exponent}", trimmed(mantissa)),
            None => text,
        };
    }
    trimmed(&format!("{value:.*}", (5.0 - magnitude).max(0.0) as usize)).to_string()
}

/// Title and source in one line, as far as they are given.
fn heading(title: &str, source: &str) -> String {
    let given = [title, source].into_iter().filter(|t| !t.is_empty());
    given.map(visible).collect::<Vec<_>>().join(" · ")
}

/// A matrix equation in LaTeX.
pub fn latex_matrix(scene: &Scene, m: &Matrix) -> String {
    latex_system(m, |e| latex(scene, e), " ")
}

/// A matrix equation in LaTeX, its entries as `write` gives them, with `gap` between rows and factors.
fn latex_system(m: &Matrix, write: impl Fn(&Expr) -> String, gap: &str) -> String {
    let column = |cells: Vec<String>| {
        let cells = cells.join(&format!(" \\\\{gap}"));
        format!("\\begin{{bmatrix}}{gap}{cells}{gap}\\end{{bmatrix}}")
    };
    let row = |row: &Vec<Expr>| row.iter().map(&write).collect::<Vec<_>>().join(" & ");
    let rows = m.entries.iter().map(row).collect();
    let unknowns = m.unknowns.iter().map(|u| write(&Expr::symbol(u))).collect();
    let rhs = m.rhs.iter().map(&write).collect();
    [
        column(rows),
        column(unknowns),
        String::from("="),
        column(rhs),
    ]
    .join(gap)
}

/// A value in SI units as the number and the unit that people who gave the scene's data read.
pub fn in_units_of_data(scene: &Scene, dimension: &Dimension, value: f64) -> (f64, String) {
    let system = scene.system();
    (value / system.scale(dimension), system.unit(dimension))
}

/// The number that a question is answered with, in the units of the data; an angle in radians and in degrees.
pub fn answered(scene: &Scene, ask: &Ask, value: f64) -> String {
    if ask.is_angle() {
        let degrees = digits(value.to_degrees());
        return format!("{} rad ≈ {degrees}°", double(value));
    }
    let (value, unit) = match scene.system() {
        System::Si => (value, scene.unit_of(ask)),
        _ => in_units_of_data(scene, &scene.dimension_of(ask), value),
    };
    let unit = if unit == "1" { "" } else { &*unit };
    format!("{} {unit}", double(value)).trim_end().to_owned()
}

/// The SI unit of what a question asks for.
pub fn unit_of(scene: &Scene, question: &str) -> String {
    let found = scene.question(question);
    found.map_or_else(String::new, |q| scene.unit_of(&q.ask))
}
