//! Formulas as native MathML. In: expressions and the pieces of a worked solution. Out: elements without namespace, as HTML
//! takes them. Every character that comes from a scene is escaped.

use num_traits::Signed;

use super::math::{Style, is_plain, needs_brackets, vector_of};
use crate::expr::{Expr, Function, Node, ratio};
use crate::figure::Level;
use crate::figure::label::latex::{Glyph, glyphs};
use crate::formula::Quotient;
use crate::solution::{Math, Name, Solution};

pub use crate::figure::escape;

/// The contents of a `<math>` element.
pub fn formula(solution: &Solution, math: &[Math]) -> String {
    let mut out = String::new();
    let is_op = |m: &Math| matches!(m, Math::Op(_));
    for (i, m) in math.iter().enumerate() {
        // Factors side by side.
        if i > 0 && !is_op(m) && !is_op(&math[i - 1]) {
            out.push_str(THIN);
        }
        match m {
            Math::Expr(e) => out.push_str(&expr(solution, e)),
            Math::Factor(e) if needs_brackets(e) => out.push_str(&brackets(&expr(solution, e))),
            Math::Factor(e) => out.push_str(&expr(solution, e)),
            Math::Vector(_) | Math::Along(_) => {
                let sum = MATHML.vector(&vector_of(m).unwrap_or_default(), &|e| expr(solution, e));
                out.push_str(&format!("<mrow>{sum}</mrow>"));
            }
            Math::Name(name) => out.push_str(&quantity(name)),
            Math::Op(op) => {
                let space = match (*op, out.is_empty()) {
                    ("⇒", true) => " rspace=\"0.8em\"",
                    ("⇒", false) => " lspace=\"0.8em\" rspace=\"0.8em\"",
                    _ => "",
                };
                out.push_str(&format!("<mo{space}>{}</mo>", escape(op)));
            }
            Math::Brackets(inner) if is_plain(inner) => out.push_str(&formula(solution, inner)),
            Math::Brackets(inner) => out.push_str(&brackets(&formula(solution, inner))),
        }
    }
    out
}

pub(super) const MATHML: Style = Style {
    signs: ["<mo>−</mo>", "<mo>+</mo>", "<mo>−</mo>"],
    brackets,
    space: THIN,
    units: [
        "<mover accent=\"true\"><mi>ı</mi><mo>^</mo></mover>",
        "<mover accent=\"true\"><mi>ȷ</mi><mo>^</mo></mover>",
        "<mover accent=\"true\"><mi>k</mi><mo>^</mo></mover>",
    ],
    zero: "<mn>0</mn>",
};

/// A thin space, as between factors.
const THIN: &str = "<mspace width=\"0.17em\"></mspace>";

/// Brackets grow around what is tall; those that could grow are wider, and stand off.
fn brackets(inner: &str) -> String {
    let is_tall = ["<mfrac", "<msqrt", "stretchy=\"true\""]
        .iter()
        .any(|tall| inner.contains(tall));
    let [open, close] = ["(", ")"].map(|c| format!("<mo stretchy=\"{is_tall}\">{c}</mo>"));
    format!("<mrow>{open}{inner}{close}</mrow>")
}

/// A slanted capital that leans over what comes next.
fn leans(base: &str) -> bool {
    let letter = base
        .strip_prefix("<mi>")
        .and_then(|l| l.strip_suffix("</mi>"));
    letter.is_some_and(|l| l.len() == 1 && "FNPTVWXYZ".contains(l))
}

fn quantity(name: &Name) -> String {
    let letter = name.glyph();
    let base = if name.vector {
        format!("<mover accent=\"true\"><mi>{letter}</mi><mo stretchy=\"false\">→</mo></mover>")
    } else {
        format!("<mi>{letter}</mi>")
    };
    let index = match name.index.as_str() {
        "" => String::new(),
        index => format!("<mrow>{}</mrow>", words(index)),
    };
    let mark = match name.mark {
        "" => String::new(),
        "-" => String::from("<mo>−</mo>"),
        "2" => String::from("<mn>2</mn>"),
        mark => format!("<mo>{mark}</mo>"),
    };
    scripts(&base, &index, &mark)
}

fn scripts(base: &str, sub: &str, sup: &str) -> String {
    match (sub.is_empty(), sup.is_empty()) {
        (true, true) if leans(base) => format!("{base}<mspace width=\"0.08em\"></mspace>"),
        (true, true) => base.to_string(),
        (false, true) => format!("<msub>{base}{sub}</msub>"),
        (true, false) => format!("<msup>{base}{sup}</msup>"),
        (false, false) => format!("<msubsup>{base}{sub}{sup}</msubsup>"),
    }
}

/// An index such as `G/C` or `ball 1`.
fn words(index: &str) -> String {
    let mut out = String::new();
    let mut word = String::new();
    let flush = |word: &mut String, out: &mut String| {
        if !word.is_empty() {
            let digits = word.chars().all(|c| c.is_ascii_digit());
            let tag = if digits { "mn" } else { "mi" };
            out.push_str(&format!("<{tag}>{}</{tag}>", escape(word)));
            word.clear();
        }
    };
    for c in index.chars() {
        match c {
            '/' | ',' => {
                flush(&mut word, &mut out);
                out.push_str(&format!("<mo lspace=\"0\" rspace=\"0\">{c}</mo>"));
            }
            c => word.push(if "_-".contains(c) { ' ' } else { c }),
        }
    }
    flush(&mut word, &mut out);
    out
}

/// An expression.
pub fn expr(solution: &Solution, e: &Expr) -> String {
    let mut out = String::from("<mrow>");
    for (i, term) in e.terms().iter().enumerate() {
        let q = Quotient::typeset(term);
        match (i, q.negative) {
            (_, true) => out.push_str("<mo>−</mo>"),
            (0, false) => {}
            (_, false) => out.push_str("<mo>+</mo>"),
        }
        out.push_str(&quotient(solution, &q));
    }
    out.push_str("</mrow>");
    out
}

fn quotient(solution: &Solution, q: &Quotient) -> String {
    if q.below.is_empty() {
        return product(solution, &q.above, false);
    }
    format!(
        "<mfrac><mrow>{}</mrow><mrow>{}</mrow></mfrac>",
        product(solution, &q.above, true),
        product(solution, &q.below, true)
    )
}

fn product(solution: &Solution, factors: &[Expr], alone: bool) -> String {
    if factors.is_empty() {
        return String::from("<mn>1</mn>");
    }
    if let ([only], true) = (factors, alone)
        && matches!(only.node(), Node::Sum(_))
    {
        return expr(solution, only);
    }
    let mut out = String::new();
    for (i, factor) in factors.iter().enumerate() {
        if i > 0 {
            let digits = matches!(factor.node(), Node::Number(_));
            out.push_str(if digits { "<mo>·</mo>" } else { THIN });
        }
        out.push_str(&one(solution, factor));
    }
    out
}

/// A factor, in brackets where it needs them.
fn one(solution: &Solution, e: &Expr) -> String {
    match e.node() {
        Node::Number(value) if value.is_integer() && !value.is_negative() => {
            format!("<mn>{value}</mn>")
        }
        Node::Number(_) | Node::Sum(_) | Node::Product(_) => brackets(&expr(solution, e)),
        Node::Symbol(name) => symbol(solution, name),
        Node::Call(Function::Abs, argument) => {
            format!(
                "<mrow><mo>|</mo>{}<mo>|</mo></mrow>",
                expr(solution, argument)
            )
        }
        Node::Call(function, argument) => call(solution, *function, argument, ""),
        Node::Power(base, exponent) => power(solution, base, exponent),
    }
}

fn power(solution: &Solution, base: &Expr, exponent: &Expr) -> String {
    if exponent.as_number().is_some_and(|k| *k == ratio(1, 2)) {
        return format!("<msqrt>{}</msqrt>", expr(solution, base));
    }
    let raised = expr(solution, exponent);
    match base.node() {
        Node::Call(function, argument) if *function != Function::Abs => {
            call(solution, *function, argument, &raised)
        }
        // The index and the exponent of a name stand above each other only if the name has no mark of its own.
        Node::Symbol(_) | Node::Number(_) if !one(solution, base).contains("<msup") => {
            format!("<msup>{}{raised}</msup>", one(solution, base))
        }
        Node::Symbol(_) => format!("<msup>{}{raised}</msup>", brackets(&one(solution, base))),
        _ => format!("<msup>{}{raised}</msup>", brackets(&expr(solution, base))),
    }
}

fn call(solution: &Solution, function: Function, argument: &Expr, power: &str) -> String {
    let name = match function {
        Function::Asin => "arcsin",
        Function::Acos => "arccos",
        Function::Atan => "arctan",
        other => other.name(),
    };
    let head = format!("<mi>{name}</mi>");
    let head = if power.is_empty() {
        head
    } else {
        format!("<msup>{head}{power}</msup>")
    };
    let bare = argument.as_symbol().is_some();
    let inner = expr(solution, argument);
    let inner = if bare {
        format!("{THIN}{inner}")
    } else {
        brackets(&inner)
    };
    format!("<mrow>{head}<mo>&#x2061;</mo>{inner}</mrow>")
}

fn symbol(solution: &Solution, name: &str) -> String {
    let latex = match solution.names.get(name) {
        Some(latex) => latex.clone(),
        None => crate::formula::latex_name(name),
    };
    from_latex(&latex)
}

/// A typeset symbol: base, indices and marks of the small LaTeX that names use.
pub fn from_latex(latex: &str) -> String {
    format!("<mrow>{}</mrow>", row(&glyphs(latex)))
}

fn row(glyphs: &[Glyph]) -> String {
    let mut out = String::new();
    let mut rest = glyphs.iter().peekable();
    let is_script = |glyph: &&Glyph| matches!(glyph, Glyph::Script(..) | Glyph::Prime);
    while rest.peek().is_some() {
        let base = rest.next_if(|glyph| !is_script(glyph)).map(one_glyph);
        let (mut sub, mut sup) = (String::new(), String::new());
        while let Some(script) = rest.next_if(|glyph| is_script(glyph)) {
            match script {
                Glyph::Script(Level::Sub, inner) => sub.push_str(&one_glyph(inner)),
                Glyph::Script(_, inner) => sup.push_str(&one_glyph(inner)),
                _ => sup.push_str("<mo>′</mo>"),
            }
        }
        let group = |s: String| match s.is_empty() {
            true => s,
            false => format!("<mrow>{s}</mrow>"),
        };
        let base = base.unwrap_or_else(|| String::from("<mrow></mrow>"));
        out.push_str(&scripts(&base, &group(sub), &group(sup)));
    }
    out
}

fn one_glyph(glyph: &Glyph) -> String {
    match glyph {
        Glyph::Letter(text) => format!("<mi>{}</mi>", escape(text)),
        Glyph::Number(text) => format!("<mn>{text}</mn>"),
        Glyph::Sign(text) => format!("<mo lspace=\"0\" rspace=\"0\">{}</mo>", escape(text)),
        Glyph::Word(text) => format!("<mi mathvariant=\"normal\">{}</mi>", escape(text)),
        Glyph::Space => String::from(THIN),
        Glyph::Prime | Glyph::Script(..) => row(std::slice::from_ref(glyph)),
        Glyph::Group(inner) => format!("<mrow>{}</mrow>", row(inner)),
        Glyph::Accent(mark, inner) => {
            let mark = match mark {
                None => "→",
                Some('\u{302}') => "^",
                Some('\u{304}') => "¯",
                Some('\u{303}') => "~",
                Some('\u{307}') => "˙",
                Some(_) => "¨",
            };
            let inner = one_glyph(inner);
            format!("<mover accent=\"true\">{inner}<mo stretchy=\"false\">{mark}</mo></mover>")
        }
    }
}
