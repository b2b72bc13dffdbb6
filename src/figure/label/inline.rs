//! A formula on one line as runs of a label.
//!
//! In: an expression and the scene its symbols belong to. Out: runs, cut short where a formula is too deep or too long.

use num_traits::Signed;

use super::{LONGEST, Label, Level};
use crate::expr::{Expr, Node, ratio};
use crate::formula::Quotient;
use crate::scene::Scene;

/// Deepest formula that is written out.
const DEEPEST_FORMULA: usize = 24;

/// Adds a formula to a label.
pub(super) fn write(e: &Expr, scene: &Scene, out: &mut Label, depth: usize) {
    if depth > DEEPEST_FORMULA || out.runs.len() > LONGEST {
        return out.push("…", false, Level::Base);
    }
    match e.node() {
        Node::Number(value) => out.push(&value.to_string().replace('-', "−"), false, Level::Base),
        Node::Symbol(name) => {
            let latex = scene.parameter(name).and_then(|p| p.latex.as_deref());
            out.runs.extend(Label::symbol(name, latex).runs);
        }
        Node::Sum(terms) => {
            for (i, term) in terms.iter().enumerate() {
                let negative = term.is_negative();
                let sign = match (i, negative) {
                    (0, false) => "",
                    (0, true) => "−",
                    (_, false) => " + ",
                    (_, true) => " − ",
                };
                out.push(sign, false, Level::Base);
                write(
                    &if negative { -term } else { term.clone() },
                    scene,
                    out,
                    depth + 1,
                );
            }
        }
        Node::Product(_) => product(e, scene, out, depth),
        Node::Power(base, exponent) => match exponent.as_number() {
            Some(k) if *k == ratio(1, 2) => {
                out.push("√", false, Level::Base);
                factor(base, scene, out, depth);
            }
            Some(k) if k.is_negative() => product(e, scene, out, depth),
            _ => {
                factor(base, scene, out, depth);
                let mut power = Label::default();
                write(exponent, scene, &mut power, depth + 1);
                out.push(&power.text(), false, Level::Sup);
            }
        },
        Node::Call(function, argument) => {
            out.push(function.name(), false, Level::Base);
            let simple = matches!(argument.node(), Node::Symbol(_) | Node::Number(_));
            out.push(if simple { "\u{2009}" } else { "(" }, false, Level::Base);
            write(argument, scene, out, depth + 1);
            out.push(if simple { "" } else { ")" }, false, Level::Base);
        }
    }
}

fn product(e: &Expr, scene: &Scene, out: &mut Label, depth: usize) {
    let q = Quotient::typeset(e);
    out.push(if q.negative { "−" } else { "" }, false, Level::Base);
    if q.above.is_empty() {
        out.push("1", false, Level::Base);
    }
    for (i, f) in q.above.iter().enumerate() {
        let numbered = i > 0 && q.above[i - 1].as_number().is_some();
        if i > 0 && (!numbered || matches!(f.node(), Node::Call(..))) {
            out.push("\u{2009}", false, Level::Base);
        }
        factor(f, scene, out, depth);
    }
    let [open, close] = match q.below.len() {
        0 => ["", ""],
        1 => ["/", ""],
        _ => ["/(", ")"],
    };
    out.push(open, false, Level::Base);
    for f in &q.below {
        factor(f, scene, out, depth);
    }
    out.push(close, false, Level::Base);
}

fn factor(e: &Expr, scene: &Scene, out: &mut Label, depth: usize) {
    let bracket = matches!(e.node(), Node::Sum(_) | Node::Product(_))
        || e.as_number().is_some_and(|k| !k.is_integer());
    out.push(if bracket { "(" } else { "" }, false, Level::Base);
    write(e, scene, out, depth + 1);
    out.push(if bracket { ")" } else { "" }, false, Level::Base);
}
