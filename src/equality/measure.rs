//! How large a pair of formulas is, counted without walking further than the limit.

use crate::domain::Roles;
use crate::expr::angle::angle;
use crate::expr::{Expr, Function, Node};

/// Nodes of both formulas together beyond which no decision is attempted.
const NODES: usize = 20_000;

/// Functions needing a series beyond which no decision is attempted; each takes some 15 µs per point.
const SERIES: usize = 200;

/// Nesting beyond which no decision is attempted; evaluation recurses once per level.
const DEPTH: usize = 400;

/// The size of a pair.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Size {
    /// Nodes, shared parts counted as often as they occur.
    pub nodes: usize,
    /// Functions and general powers, which need a series.
    pub series: usize,
    /// Sines, cosines and tangents of angles, which a rational direction makes exact.
    pub turns: usize,
    /// Square roots and their powers.
    pub roots: usize,
    /// Whether roots, logarithms and the like occur, which lack values on whole parts of a domain.
    pub partial: bool,
    /// Whether roots or absolute values occur, whose branch depends on a sign.
    pub branches: bool,
}

/// The size, or `None` beyond the limits.
pub(super) fn of(formulas: &[&Expr]) -> Option<Size> {
    let mut size = Size::default();
    let all = formulas.iter().all(|e| count(e, 0, &mut size));
    all.then_some(size)
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
                // Repeated squaring.
                Some(k) if k.is_integer() => size.nodes += k.numer().bits() as usize,
                _ => {
                    size.partial = true;
                    size.branches = true;
                    match exponent.as_number().is_some_and(|k| (k + k).is_integer()) {
                        true => size.roots += 1,
                        false => size.series += 1,
                    }
                }
            }
            count(base, depth + 1, size) && count(exponent, depth + 1, size)
        }
        Node::Call(function, argument) => {
            match function {
                Function::Abs => {}
                Function::Sin | Function::Cos | Function::Tan if angle(argument).is_some() => {
                    size.turns += 1
                }
                _ => size.series += 1,
            }
            size.branches |= *function == Function::Abs;
            size.partial |= matches!(function, Function::Asin | Function::Acos | Function::Ln);
            count(argument, depth + 1, size)
        }
    }
}

/// About how many products of terms it takes to write a formula out as a sum of products.
pub fn work(e: &Expr) -> usize {
    cost(e).1
}

/// Terms, and products of terms on the way there; both at most.
fn cost(e: &Expr) -> (usize, usize) {
    match e.node() {
        Node::Sum(parts) => parts.iter().map(cost).fold((0, 0), |total, part| {
            let work = total.1.saturating_add(part.1);
            (total.0.saturating_add(part.0), work)
        }),
        Node::Product(parts) => parts.iter().map(cost).fold((1, 0), |total, part| {
            let terms = total.0.saturating_mul(part.0);
            let work = total.1.saturating_add(part.1);
            (terms, work.saturating_add(terms))
        }),
        Node::Power(base, k) => {
            let (base, work) = cost(base);
            let k = k.as_number().filter(|k| k.is_integer());
            let k = k.and_then(|k| k.numer().as_i64()).unwrap_or(1);
            let k = usize::try_from(k.unsigned_abs()).unwrap_or(usize::MAX);
            // k of the terms, their order left aside: (base + k − 1 over k).
            let mut terms = 1usize;
            for i in 1..base.min(6) {
                terms = terms.saturating_mul(k.saturating_add(i)) / i;
            }
            let squared = if base > 1 {
                terms.saturating_mul(terms)
            } else {
                0
            };
            (terms, work.saturating_add(squared))
        }
        _ => (1, 0),
    }
}

impl Size {
    /// The size once it is known how symbols occur: sines need a series too where an angle has no direction. `None`
    /// beyond the limit of series.
    pub fn with(mut self, roles: &Roles) -> Option<Size> {
        if roles.radians || roles.symbols.values().any(|r| r.turns && r.bare) {
            self.series += self.turns;
        }
        (self.series <= SERIES).then_some(self)
    }

    /// Points at which the pair is compared: fewer for long formulas.
    pub fn points(&self) -> usize {
        (40_000 / (self.nodes + 8 * self.turns + 80 * self.series).max(1)).clamp(3, 24)
    }

    /// How many evaluations of both formulas at a precision the work limit allows.
    pub fn evaluations(&self, bits: u32) -> usize {
        // Counted in products of one word, about 40 ns; a product of w words costs about 8 + w^1.5 of them, a function some
        // 16 + 4√w products, a root four.
        let words = u64::from(bits) / 64;
        let product = 8 + words * words.isqrt();
        let [nodes, series, roots] = [self.nodes, self.series, self.roots].map(|n| n as u64);
        let cost = product * (nodes + 4 * roots + series * (16 + 4 * words.isqrt()));
        (150_000 / cost.max(1)).min(64) as usize
    }
}
