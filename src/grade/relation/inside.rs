//! Equations solved for a symbol by what it stands in alone: a square, a root, a quotient, the sine of an angle.

use super::solve_for;
use crate::algebra::tidy;
use crate::domain::Domains;
use crate::expr::{Expr, Function, Node, Symbol};

/// The value of a part of an equation, where a symbol stands nowhere else in it.
fn value_of(part: &Expr, line: &Expr, name: &Symbol, domains: &Domains) -> Option<Expr> {
    let letter = Symbol::from(format!("part with {name} inside"));
    let line = line.replace(part, &Expr::symbol(&letter));
    (!line.mentions(name)).then(|| solve_for(&line, &letter, domains))?
}

/// What stands below alone: I in `F R/I`.
pub(in crate::grade) fn below_in(line: &Expr, name: &Symbol, domains: &Domains) -> Option<Expr> {
    let inverse = Expr::symbol(name).powi(-1);
    Some(value_of(&inverse, line, name, domains)?.powi(-1))
}

/// The angle between 0 and 90° whose sine, cosine or tangent alone occurs.
pub(in crate::grade) fn angle_in(line: &Expr, name: &Symbol, domains: &Domains) -> Option<Expr> {
    let angle = Expr::symbol(name);
    let forms = [
        (angle.sin(), Function::Asin),
        (angle.cos(), Function::Acos),
        (angle.tan(), Function::Atan),
    ];
    forms.into_iter().find_map(|(form, inverse)| {
        let value = value_of(&form, line, name, domains)?;
        Some(Expr::call(inverse, value))
    })
}

/// The size of what occurs by its square alone, as the speed does in an energy.
pub(in crate::grade) fn size_in(line: &Expr, name: &Symbol, domains: &Domains) -> Option<Expr> {
    // The square of a quotient is one of squares.
    let line = tidy(line, domains).unwrap_or_else(|_| line.clone());
    let square = Expr::symbol(name).powi(2);
    Some(value_of(&square, &line, name, domains)?.sqrt())
}

/// What occurs under one root alone, as the height does in the speed of a fall.
pub(in crate::grade) fn under_root(line: &Expr, name: &Symbol, domains: &Domains) -> Option<Expr> {
    let half = |part: &&Expr| match part.node() {
        Node::Power(base, k) => base.mentions(name) && *k == Expr::ratio(1, 2),
        _ => false,
    };
    let root = line.parts().find(half)?;
    let value = value_of(root, line, name, domains)?;
    solve_for(&(root.powi(2) - value.powi(2)), name, domains)
}
