//! Angles as they stand under a sine: rational combinations of symbols and of π.

use std::collections::BTreeMap;

use num_traits::Zero;

use super::{Expr, Function, Node, Rational, Symbol, number, ratio};

/// A rational combination of angle symbols plus a rational multiple of π.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Angle {
    /// Coefficient of each symbol; no zero is kept.
    pub symbols: BTreeMap<Symbol, Rational>,
    /// Coefficient of π.
    pub pi: Rational,
}

/// Sines and cosines exchanged, those of some angles.
pub fn arcs_exchanged(e: &Expr, of: &dyn Fn(&Expr) -> bool) -> Expr {
    match e.node() {
        Node::Call(Function::Sin, x) if of(x) => x.cos(),
        Node::Call(Function::Cos, x) if of(x) => x.sin(),
        Node::Call(Function::Tan, x) if of(x) => x.tan().powi(-1),
        _ => e.map_parts(|part| arcs_exchanged(part, of)),
    }
}

/// Reads an expression as an angle: `None` where it is not a rational combination of symbols and π (a bare number, a
/// product of symbols, a root).
pub fn angle(e: &Expr) -> Option<Angle> {
    let mut out = Angle {
        symbols: BTreeMap::new(),
        pi: Rational::zero(),
    };
    for term in e.terms() {
        add_term(term, ratio(1, 1), &mut out)?;
    }
    out.symbols.retain(|_, k| !k.is_zero());
    Some(out)
}

fn add_term(term: &Expr, factor: Rational, out: &mut Angle) -> Option<()> {
    match term.node() {
        Node::Number(value) if value.is_zero() => Some(()),
        Node::Symbol(name) if &**name == "pi" => {
            out.pi = number::sum(&out.pi, &factor, false);
            Some(())
        }
        Node::Symbol(name) => {
            let share = out.symbols.entry(name.clone());
            let share = share.or_insert_with(Rational::zero);
            *share = number::sum(share, &factor, false);
            Some(())
        }
        Node::Sum(terms) => terms
            .iter()
            .try_for_each(|t| add_term(t, factor.clone(), out)),
        Node::Product(factors) => match factors.as_slice() {
            [share, rest] => add_term(rest, number::product(&factor, share.as_number()?), out),
            _ => None,
        },
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_combination_of_angles_is_read() {
        let (a, b) = (Expr::symbol("alpha"), Expr::symbol("beta"));
        let e = (&a - &b) * Expr::ratio(1, 2) + Expr::pi() * Expr::ratio(3, 4) - &a;
        let read = angle(&e).expect("a rational combination");
        assert_eq!(read.pi, ratio(3, 4));
        assert_eq!(read.symbols["alpha"], ratio(-1, 2));
        assert_eq!(read.symbols["beta"], ratio(-1, 2));
    }

    #[test]
    fn radians_as_a_bare_number_and_products_are_not() {
        assert_eq!(angle(&Expr::from(1)), None);
        assert_eq!(angle(&(Expr::symbol("omega") * Expr::symbol("t"))), None);
    }
}
