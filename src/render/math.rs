//! Formulas of a worked solution as Unicode and as LaTeX, and how long displayed lines are broken, the same in every format.

use crate::expr::{Expr, Node};
use crate::formula::{visible, write_latex, write_unicode};
use crate::solution::{Line, Math, Name, Solution};

/// Longest displayed line, in characters of its Unicode form.
const WIDE: usize = 76;

/// A displayed row: what stands left of the relation, and the relation with what follows.
pub type Cells = [Vec<Math>; 2];

/// The rows a display is set in: one per line, more where a line is too long; relations stand below each other.
pub fn rows(solution: &Solution, lines: &[Line]) -> Vec<Cells> {
    lines
        .iter()
        .flat_map(|l| broken(solution, &l.math))
        .collect()
}

/// A formula within a sentence in pieces between which a line may end: before relations, and before terms of a long sum.
pub fn pieces(solution: &Solution, math: &[Math], wide: usize) -> Vec<Vec<Math>> {
    if width(solution, math) <= wide {
        return vec![math.to_vec()];
    }
    let parts = at_relations(math).into_iter();
    parts
        .flat_map(|part| terms(solution, &part, wide))
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

fn broken(solution: &Solution, math: &[Math]) -> Vec<Cells> {
    let Some(first) = math.iter().position(is_relation) else {
        return vec![[Vec::new(), math.to_vec()]];
    };
    let (left, rest) = math.split_at(first);
    if width(solution, math) <= WIDE {
        return vec![[left.to_vec(), rest.to_vec()]];
    }
    let mut out: Vec<Cells> = Vec::new();
    let mut left = left.to_vec();
    if width(solution, &left) > WIDE / 2 {
        for piece in terms(solution, &left, WIDE) {
            out.push([Vec::new(), piece]);
        }
        left = Vec::new();
    }
    for piece in at_relations(rest) {
        for part in terms(solution, &piece, WIDE) {
            out.push([std::mem::take(&mut left), part]);
        }
    }
    out
}

/// A piece that ends in a long sum, with the sum spread over several rows.
fn terms(solution: &Solution, piece: &[Math], wide: usize) -> Vec<Vec<Math>> {
    let Some((Math::Expr(last), head)) = piece.split_last() else {
        return vec![piece.to_vec()];
    };
    let Node::Sum(all) = last.node() else {
        return vec![piece.to_vec()];
    };
    if width(solution, piece) <= wide {
        return vec![piece.to_vec()];
    }
    let mut rows: Vec<Vec<Math>> = Vec::new();
    let mut chunk: Vec<Expr> = Vec::new();
    let mut length = width(solution, head);
    let mut flush = |chunk: &mut Vec<Expr>| {
        if chunk.is_empty() {
            return;
        }
        let e = Expr::sum(chunk.drain(..));
        let mut row = if rows.is_empty() {
            head.to_vec()
        } else {
            Vec::new()
        };
        if !rows.is_empty() && !crate::formula::write_plain(&e).starts_with('-') {
            row.push(Math::Op("+"));
        }
        row.push(Math::Expr(e));
        rows.push(row);
    };
    for term in all {
        let size = width(solution, &[Math::Expr(term.clone())]) + 3;
        if length + size > wide {
            flush(&mut chunk);
            length = 4;
        }
        length += size;
        chunk.push(term.clone());
    }
    flush(&mut chunk);
    rows
}

/// Characters of its Unicode form.
pub fn width(solution: &Solution, math: &[Math]) -> usize {
    unicode(solution, math).chars().count()
}

/// Whether a scalar needs brackets as a factor.
pub fn needs_brackets(e: &Expr) -> bool {
    matches!(e.node(), Node::Sum(_)) || crate::formula::write_plain(e).starts_with('-')
}

/// The components of a vector that do not vanish: sign, size (`None` for 1), unit vector.
pub fn components(v: &[(Expr, usize)]) -> Vec<(bool, Option<Expr>, usize)> {
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

/// A bracketed vector with one positive term needs no brackets to be read right after `×`; any other does.
pub fn is_plain(inner: &[Math]) -> bool {
    match inner {
        [one] => vector_of(one).is_some_and(|v| {
            let c = components(&v);
            c.len() == 1
                && !c[0].0
                && !c[0]
                    .1
                    .as_ref()
                    .is_some_and(|e| matches!(e.node(), Node::Sum(_)))
        }),
        _ => false,
    }
}

/// How a format writes a sum of components along unit vectors.
struct Style {
    minus: &'static str,
    brackets: [&'static str; 2],
    /// Between a component and its unit vector.
    space: &'static str,
    units: [&'static str; 3],
}

const UNICODE: Style = Style {
    minus: "−",
    brackets: ["(", ")"],
    space: " ",
    units: ["î", "ĵ", "k̂"],
};

const LATEX: Style = Style {
    minus: "-",
    brackets: ["\\left(", "\\right)"],
    space: "\\,",
    units: ["\\hat{\\imath}", "\\hat{\\jmath}", "\\hat{k}"],
};

impl Style {
    fn vector(&self, v: &[(Expr, usize)], expr: &impl Fn(&Expr) -> String) -> String {
        let mut text = String::new();
        for (negative, size, axis) in components(v) {
            let sign = if negative { self.minus } else { "+" };
            match (text.is_empty(), negative) {
                (true, false) => {}
                (true, true) => text.push_str(sign),
                (false, _) => text.push_str(&format!(" {sign} ")),
            }
            if let Some(e) = size {
                let [open, close] = match e.node() {
                    Node::Sum(_) => self.brackets,
                    _ => [""; 2],
                };
                text.push_str(&format!("{open}{}{close}{}", expr(&e), self.space));
            }
            text.push_str(self.units[axis]);
        }
        if text.is_empty() {
            text.push('0');
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
            Math::Unit(axis) => UNICODE.units[*axis].to_string(),
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
    let letter = if name.letter == "omega" {
        "ω"
    } else {
        name.letter
    };
    let mark = match name.mark {
        "+" => "⁺",
        "-" => "⁻",
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
        format!("_{index}")
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
            Math::Unit(axis) => LATEX.units[*axis].to_string(),
            Math::Brackets(inner) if is_plain(inner) => latex(solution, inner),
            Math::Brackets(inner) => format!("\\left({}\\right)", latex(solution, inner)),
        };
        if !out.is_empty() {
            out.push(' ');
        }
        out.push_str(&piece);
    }
    out
}

fn latex_op(op: &str) -> &str {
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
    let letter = if name.letter == "omega" {
        "\\omega"
    } else {
        name.letter
    };
    let letter = if name.vector {
        format!("\\vec{{{letter}}}")
    } else {
        letter.to_string()
    };
    let mark = if name.mark.is_empty() {
        String::new()
    } else {
        format!("^{{{}}}", name.mark)
    };
    if name.index.is_empty() {
        return format!("{letter}{mark}");
    }
    let mut index = String::new();
    let mut word = String::new();
    for c in name.index.chars().chain(['\0']) {
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
    format!("{letter}_{{{index}}}{mark}")
}
