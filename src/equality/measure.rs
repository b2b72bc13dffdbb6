//! How large a pair of formulas is, counted without walking further than the limit.

use crate::expr::{Expr, Function, Node};

/// Nodes of both formulas together beyond which no decision is attempted.
const NODES: usize = 20_000;

/// Nesting beyond which no decision is attempted; evaluation recurses once per level.
const DEPTH: usize = 400;

/// The size of a pair.
#[derive(Clone, Copy, Debug)]
pub(super) struct Size {
    /// Nodes, shared parts counted as often as they occur.
    pub nodes: usize,
    /// Calls of functions and powers with exponents that are no small integers.
    pub calls: usize,
    /// Whether roots, logarithms and the like occur, which lack values on whole parts of a domain.
    pub partial: bool,
    /// Whether roots or absolute values occur, whose branch depends on a sign.
    pub branches: bool,
}

/// The size, or `None` beyond the limits.
pub(super) fn of(formulas: &[&Expr]) -> Option<Size> {
    let mut size = Size {
        nodes: 0,
        calls: 0,
        partial: false,
        branches: false,
    };
    formulas
        .iter()
        .all(|e| count(e, 0, &mut size))
        .then_some(size)
}

fn count(e: &Expr, depth: usize, size: &mut Size) -> bool {
    size.nodes += 1;
    if size.nodes > NODES || depth > DEPTH {
        return false;
    }
    match e.node() {
        Node::Number(_) | Node::Symbol(_) => true,
        Node::Sum(parts) | Node::Product(parts) => parts.iter().all(|p| count(p, depth + 1, size)),
        Node::Power(base, exponent) => {
            match exponent.as_number() {
                Some(k) if k.is_integer() => {}
                _ => {
                    size.partial = true;
                    size.branches = true;
                    size.calls += 1;
                }
            }
            count(base, depth + 1, size) && count(exponent, depth + 1, size)
        }
        Node::Call(function, argument) => {
            size.calls += 1;
            size.branches |= *function == Function::Abs;
            size.partial |= matches!(function, Function::Asin | Function::Acos | Function::Ln);
            count(argument, depth + 1, size)
        }
    }
}

impl Size {
    /// Points at which the pair is compared: fewer for long formulas.
    pub fn points(&self) -> usize {
        (40_000 / (self.nodes + 8 * self.calls).max(1)).clamp(3, 24)
    }

    /// How many evaluations of both formulas at a precision the work limit allows.
    pub fn evaluations(&self, bits: u32) -> usize {
        // A product costs about (bits/64)^1.6 word operations, a function some (bits/64)^0.5·16 products.
        let words = u64::from(bits) / 64;
        let product = 8 + words * words.isqrt();
        let cost =
            self.nodes as u64 * product + self.calls as u64 * product * (16 + 4 * words.isqrt());
        (8_000_000 / cost.max(1)).min(64) as usize
    }
}
