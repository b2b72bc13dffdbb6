//! Formulas of a worked solution as Unicode and as LaTeX, and how long displayed lines are broken, the same in every format.

use num_traits::Signed;

use crate::expr::{Expr, Node};
use crate::formula::{latex_words, visible, write_latex, write_unicode};
use crate::solution::{Line, Math, Name, Solution};

/// Longest displayed line, in characters as they are set.
const WIDE: usize = 58;

/// A displayed row: what stands left of the relation, and the relation with what follows.
pub type Cells = [Vec<Math>; 2];

/// The rows a display is set in: one per line, more where a line is too long; relations stand below each other.
pub fn rows(solution: &Solution, lines: &[Line]) -> Vec<Cells> {
    rows_within(solution, lines, WIDE)
}

/// The same where a row holds only so many characters.
pub fn rows_within(solution: &Solution, lines: &[Line], wide: usize) -> Vec<Cells> {
    lines
        .iter()
        .flat_map(|l| broken(solution, &l.math, wide))
        .collect()
}

/// A formula within a sentence in pieces between which a line may end: before relations, and before terms of a long sum.
pub fn pieces(solution: &Solution, math: &[Math], wide: usize) -> Vec<Vec<Math>> {
    if width(solution, math) <= wide {
        return vec![math.to_vec()];
    }
    let parts = at_relations(math).into_iter();
    parts
        .flat_map(|part| filled(solution, &part, wide))
        .collect()
}

fn is_relation(m: &Math) -> bool {
    matches!(m, Math::Op("=" | "≈" | "→" | "≥" | "≤" | ">" | "<"))
}

/// Cut before every relation.
fn at_relations(math: &[Math]) -> Vec<Vec<Math>> {
    let mut pieces: Vec<Vec<Math>> = Vec::new();
    for m in math {
        match pieces.last_mut() {
            Some(piece) if !is_relation(m) => piece.push(m.clone()),
            _ => pieces.push(vec![m.clone()]),
        }
    }
    pieces
}

/// A display in the parts it is set in: a left side that fills its own row begins a new one, since below other rows it would
/// read as what goes on in them.
pub fn apart<'l>(solution: &Solution, lines: &'l [Line]) -> Vec<&'l [Line]> {
    let mut out = Vec::new();
    let mut from = 0;
    for (i, line) in lines.iter().enumerate().skip(1) {
        let left = line.math.iter().position(is_relation).unwrap_or(0);
        if fills_row(solution, &line.math, left, WIDE) {
            out.push(&lines[from..i]);
            from = i;
        }
    }
    out.push(&lines[from..]);
    out
}

/// Whether what stands left of a relation is set in rows of its own.
fn fills_row(solution: &Solution, math: &[Math], left: usize, wide: usize) -> bool {
    width(solution, math) > wide && width(solution, &math[..left]) > wide / 2
}

fn broken(solution: &Solution, math: &[Math], wide: usize) -> Vec<Cells> {
    let Some(first) = math.iter().position(is_relation) else {
        return filled(solution, math, wide)
            .into_iter()
            .map(|row| [Vec::new(), row])
            .collect();
    };
    let (left, rest) = math.split_at(first);
    if width(solution, math) <= wide {
        return vec![[left.to_vec(), rest.to_vec()]];
    }
    // What follows begins its own row, with its name and its value together.
    if let Some(at) = math
        .iter()
        .rposition(|m| *m == Math::Op("⇒"))
        .filter(|at| *at > 0)
    {
        let (said, follows) = math.split_at(at);
        let mut out = broken(solution, said, wide);
        let rows = filled(solution, follows, wide - width(solution, left));
        out.extend(rows.into_iter().map(|row| [Vec::new(), row]));
        return out;
    }
    let mut out: Vec<Cells> = Vec::new();
    let mut left = left.to_vec();
    let beside = width(solution, &left);
    if fills_row(solution, math, first, wide) {
        for piece in filled(solution, &left, wide) {
            out.push([Vec::new(), piece]);
        }
        left = Vec::new();
    }
    let room = wide - if left.is_empty() { 0 } else { beside };
    for piece in at_relations(rest) {
        for part in filled(solution, &piece, room) {
            out.push([std::mem::take(&mut left), part]);
        }
    }
    out
}

/// A piece spread over rows that hold so many characters each, cut before terms and, where that is not enough, before factors.
fn filled(solution: &Solution, piece: &[Math], wide: usize) -> Vec<Vec<Math>> {
    if width(solution, piece) <= wide {
        return vec![piece.to_vec()];
    }
    let mut rows: Vec<Vec<Math>> = Vec::new();
    for chunk in chunks(solution, piece, &["+", "−"], wide) {
        let smaller = match width(solution, &chunk) > wide {
            true => chunks(solution, &chunk, &["×", "·"], wide),
            false => vec![chunk],
        };
        for part in smaller {
            match rows.last_mut() {
                Some(row) if width(solution, row) + width(solution, &part) < wide => {
                    row.extend(part);
                }
                _ => rows.push(part),
            }
        }
    }
    rows
}

/// Cut before the given signs; a sum and a vector that stand alone are cut between their terms.
fn chunks(solution: &Solution, piece: &[Math], signs: &[&str], wide: usize) -> Vec<Vec<Math>> {
    let mut out: Vec<Vec<Math>> = vec![Vec::new()];
    for (i, m) in piece.iter().enumerate() {
        let alone = i == 0 || is_relation(&piece[i - 1]);
        let long = |e: &Expr| extent(solution, e) > wide as f64;
        let apart = match m {
            Math::Expr(e) if alone && long(e) => numerator(solution, e),
            _ => None,
        };
        let terms = match m {
            Math::Expr(_) if apart.is_some() => apart
                .as_ref()
                .map(|(_, sum)| sum.iter().map(signed_term).collect())
                .unwrap_or_default(),
            Math::Expr(e) if alone => match e.node() {
                Node::Sum(terms) => terms.iter().map(signed_term).collect(),
                _ => Vec::new(),
            },
            Math::Vector([x, y]) if alone && !x.is_zero() && !y.is_zero() => {
                let [first, second] = [[x.clone(), Expr::zero()], [Expr::zero(), y.clone()]];
                let negative = components(&[(y.clone(), 1)]).iter().any(|c| c.0);
                let second = match negative {
                    true => (true, Math::Vector([Expr::zero(), -y])),
                    false => (false, Math::Vector(second)),
                };
                vec![(false, Math::Vector(first)), second]
            }
            _ => Vec::new(),
        };
        if terms.len() > 1 && signs.contains(&"+") {
            if let (Some((rest, _)), Some(last)) = (&apart, out.last_mut()) {
                let rest = match rest.node() {
                    Node::Sum(_) => Math::Factor(rest.clone()),
                    _ => Math::Expr(rest.clone()),
                };
                last.extend([rest, Math::Op("(")]);
            }
            for (k, (negative, term)) in terms.into_iter().enumerate() {
                let sign = if negative { "−" } else { "+" };
                if k > 0 {
                    out.push(vec![Math::Op(sign)]);
                } else if negative && let Some(last) = out.last_mut() {
                    last.push(Math::Op(sign));
                }
                if let Some(last) = out.last_mut() {
                    last.push(term);
                }
            }
            if let (Some(_), Some(last)) = (&apart, out.last_mut()) {
                last.push(Math::Op(")"));
            }
            continue;
        }
        let cut = matches!(m, Math::Op(op) if signs.contains(op)) && !alone;
        match out.last_mut() {
            Some(last) if !cut => last.push(m.clone()),
            _ => out.push(vec![m.clone()]),
        }
    }
    out.retain(|chunk| !chunk.is_empty());
    out
}

/// A long product taken apart: what stands before its longest sum, and the terms of that sum.
fn numerator(solution: &Solution, e: &Expr) -> Option<(Expr, Vec<Expr>)> {
    let Node::Product(factors) = e.node() else {
        return None;
    };
    let sums = factors
        .iter()
        .enumerate()
        .filter_map(|(i, f)| match f.node() {
            Node::Sum(terms) => Some((i, terms, extent(solution, f))),
            _ => None,
        });
    let (at, terms, _) = sums.max_by(|a, b| a.2.total_cmp(&b.2))?;
    let rest = factors.iter().enumerate().filter(|(i, _)| *i != at);
    Some((Expr::product(rest.map(|(_, f)| f.clone())), terms.clone()))
}

/// A term with its sign apart.
fn signed_term(term: &Expr) -> (bool, Math) {
    match crate::formula::write_plain(term).starts_with('-') {
        true => (true, Math::Expr(-term)),
        false => (false, Math::Expr(term.clone())),
    }
}

/// About how many characters wide a formula is set: fractions are as wide as their wider part, indices are small.
pub fn width(solution: &Solution, math: &[Math]) -> usize {
    let each = math.iter().map(|m| match m {
        Math::Expr(e) => extent(solution, e),
        Math::Factor(e) => extent(solution, e) + if needs_brackets(e) { 2.0 } else { 0.0 },
        Math::Vector(_) | Math::Along(_) => vector_of(m)
            .unwrap_or_default()
            .iter()
            .filter(|(e, _)| !e.is_zero())
            .map(|(e, _)| extent(solution, e) + 4.0)
            .sum(),
        Math::Name(name) => 1.0 + 0.7 * (name.index.chars().count() as f64),
        Math::Op(op) => 2.0 + op.chars().count() as f64,
        Math::Brackets(inner) => width(solution, inner) as f64 + 2.0,
    });
    each.sum::<f64>().ceil() as usize
}

fn extent(solution: &Solution, e: &Expr) -> f64 {
    let small = |text: &str| {
        let (letter, index) = text.split_once('_').unwrap_or((text, ""));
        letter.chars().count() as f64 + 0.6 * index.chars().count() as f64
    };
    match e.node() {
        Node::Sum(terms) => {
            let inner: f64 = terms.iter().map(|t| extent(solution, t)).sum();
            inner + 2.5 * (terms.len() as f64 - 1.0)
        }
        Node::Product(factors) => {
            let (mut above, mut below) = (0.0, 0.0);
            for factor in factors {
                let brackets = if matches!(factor.node(), Node::Sum(_)) {
                    1.5
                } else {
                    0.3
                };
                match factor.node() {
                    Node::Number(value) => {
                        let digits = |n: String| if n == "1" { 0.0 } else { n.len() as f64 };
                        above += digits(value.numer().to_string().replace('-', ""));
                        below += digits(value.denom().to_string());
                    }
                    Node::Power(base, k) if k.as_number().is_some_and(Signed::is_negative) => {
                        below += extent(solution, &base.power(-k)) + brackets;
                    }
                    _ => above += extent(solution, factor) + brackets,
                }
            }
            f64::max(above, below)
        }
        Node::Power(base, k) if k.as_number().is_some_and(Signed::is_negative) => {
            extent(solution, &base.power(-k))
        }
        Node::Power(base, _) => {
            let brackets = if matches!(base.node(), Node::Symbol(_)) {
                0.0
            } else {
                1.5
            };
            extent(solution, base) + 0.7 + brackets
        }
        Node::Call(function, argument) => {
            let brackets = if argument.as_symbol().is_some() {
                0.3
            } else {
                1.5
            };
            function.name().len() as f64 + extent(solution, argument) + brackets
        }
        Node::Number(_) | Node::Symbol(_) => small(&unicode(
            solution,
            std::slice::from_ref(&Math::Expr(e.clone())),
        )),
    }
}

/// Whether a scalar needs brackets as a factor.
pub fn needs_brackets(e: &Expr) -> bool {
    matches!(e.node(), Node::Sum(_)) || crate::formula::write_plain(e).starts_with('-')
}

/// The components of a vector that do not vanish: sign, size (`None` for 1), unit vector.
fn components(v: &[(Expr, usize)]) -> Vec<(bool, Option<Expr>, usize)> {
    let mut out = Vec::new();
    for (e, axis) in v {
        if e.is_zero() {
            continue;
        }
        let negative =
            !matches!(e.node(), Node::Sum(_)) && crate::formula::write_plain(e).starts_with('-');
        let size = if negative { -e } else { e.clone() };
        out.push((negative, (!size.is_one()).then_some(size), *axis));
    }
    out
}

/// The components of a vector-valued piece.
pub fn vector_of(m: &Math) -> Option<Vec<(Expr, usize)>> {
    match m {
        Math::Vector([x, y]) => Some(vec![(x.clone(), 0), (y.clone(), 1)]),
        Math::Along(z) => Some(vec![(z.clone(), 2)]),
        _ => None,
    }
}

/// A bracketed vector with one positive term needs no brackets to be read right after `×`, as a sum has its own; any other does.
pub fn is_plain(inner: &[Math]) -> bool {
    match inner {
        [one] => vector_of(one).is_some_and(|v| {
            let c = components(&v);
            c.len() == 1 && !c[0].0
        }),
        _ => false,
    }
}

/// How a format writes a sum of components along unit vectors.
pub(super) struct Style {
    /// A minus sign in front; plus and minus between two.
    pub signs: [&'static str; 3],
    /// A sum in brackets.
    pub brackets: fn(&str) -> String,
    /// Between a component and its unit vector.
    pub space: &'static str,
    pub units: [&'static str; 3],
    pub zero: &'static str,
}

const UNICODE: Style = Style {
    signs: ["−", " + ", " − "],
    brackets: |inner| format!("({inner})"),
    space: " ",
    units: ["î", "ĵ", "k̂"],
    zero: "0",
};

pub(super) const LATEX: Style = Style {
    signs: ["-", " + ", " - "],
    brackets: |inner| format!("\\left({inner}\\right)"),
    space: "\\,",
    units: ["\\hat{\\imath}", "\\hat{\\jmath}", "\\hat{k}"],
    zero: "0",
};

impl Style {
    pub fn vector(&self, v: &[(Expr, usize)], expr: &impl Fn(&Expr) -> String) -> String {
        let mut text = String::new();
        for (negative, size, axis) in components(v) {
            let [first, plus, minus] = self.signs;
            text.push_str(match (text.is_empty(), negative) {
                (true, false) => "",
                (true, true) => first,
                (false, false) => plus,
                (false, true) => minus,
            });
            if let Some(e) = size {
                let size = match e.node() {
                    Node::Sum(_) => (self.brackets)(&expr(&e)),
                    _ => expr(&e),
                };
                text.push_str(&size);
                text.push_str(self.space);
            }
            text.push_str(self.units[axis]);
        }
        if text.is_empty() {
            text.push_str(self.zero);
        }
        text
    }
}

/// A formula in one line of Unicode.
pub fn unicode(solution: &Solution, math: &[Math]) -> String {
    let names = |n: &str| solution.names.get(n).cloned();
    let expr = |e: &Expr| write_unicode(e, &names);
    let mut out = String::new();
    for m in math {
        let piece = match m {
            Math::Expr(e) => expr(e),
            Math::Factor(e) if needs_brackets(e) || expr(e).contains('/') => {
                format!("({})", expr(e))
            }
            Math::Factor(e) => expr(e),
            Math::Vector(_) | Math::Along(_) => {
                UNICODE.vector(&vector_of(m).unwrap_or_default(), &expr)
            }
            Math::Name(name) => unicode_name(name),
            Math::Op(",") => {
                out.push(',');
                continue;
            }
            Math::Op(op) => (*op).to_string(),
            Math::Brackets(inner) if is_plain(inner) => unicode(solution, inner),
            Math::Brackets(inner) => format!("({})", unicode(solution, inner)),
        };
        let signed = out == "−" || out.ends_with("= −");
        if !out.is_empty() && !signed {
            out.push(' ');
        }
        out.push_str(&piece);
    }
    out
}

fn unicode_name(name: &Name) -> String {
    let letter = name.glyph();
    let mark = match name.mark {
        "+" => "⁺",
        "-" => "⁻",
        "2" => "²",
        _ => "",
    };
    let index = &name.index;
    let low = !index.is_empty() && index.chars().all(|c| c.is_ascii_digit());
    if low {
        let digits = index
            .chars()
            .filter_map(|c| char::from_u32(u32::from('₀') + c.to_digit(10)?));
        return format!("{letter}{}{mark}", digits.collect::<String>());
    }
    let sub = if index.is_empty() {
        String::new()
    } else {
        format!("_{}", index.replace('_', ""))
    };
    visible(&format!("{letter}{sub}{mark}"))
}

/// A formula in LaTeX.
pub fn latex(solution: &Solution, math: &[Math]) -> String {
    let names = |n: &str| solution.names.get(n).cloned();
    let expr = |e: &Expr| write_latex(e, &names);
    let mut out = String::new();
    for m in math {
        let piece = match m {
            Math::Expr(e) => expr(e),
            Math::Factor(e) if needs_brackets(e) => format!("\\left({}\\right)", expr(e)),
            Math::Factor(e) => expr(e),
            Math::Vector(_) | Math::Along(_) => {
                LATEX.vector(&vector_of(m).unwrap_or_default(), &expr)
            }
            Math::Name(name) => latex_name(name),
            Math::Op(op) => latex_op(op).to_string(),
            Math::Brackets(inner) if is_plain(inner) => latex(solution, inner),
            Math::Brackets(inner) => format!("\\left({}\\right)", latex(solution, inner)),
        };
        if !out.is_empty() {
            let follows = matches!(m, Math::Op("⇒"));
            out.push_str(if follows { " \\quad" } else { " " });
        }
        out.push_str(&piece);
    }
    out
}

pub(super) fn latex_op(op: &str) -> &str {
    match op {
        "×" => "\\times",
        "·" => "\\cdot",
        "−" => "-",
        "≈" => "\\approx",
        "⇒" => "\\Rightarrow\\quad",
        "→" => "\\to",
        "∞" => "\\infty",
        "≤" => "\\le",
        "≥" => "\\ge",
        "≠" => "\\ne",
        "<" => "\\lt",
        other => other,
    }
}

fn latex_name(name: &Name) -> String {
    let letter = match name.glyph() {
        glyph if glyph == name.letter => glyph.to_string(),
        _ => format!("\\{}", name.letter),
    };
    let letter = if name.vector {
        format!("\\vec{{{letter}}}")
    } else {
        letter
    };
    let mark = if name.mark.is_empty() {
        String::new()
    } else {
        format!("^{{{}}}", name.mark)
    };
    if name.index.is_empty() {
        return format!("{letter}{mark}");
    }
    let index = latex_words(&name.index);
    format!("{letter}_{{{index}}}{mark}")
}
