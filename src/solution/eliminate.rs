//! The algebra of a block line by line: earlier results substituted, unknowns eliminated one after another, values put back.

use super::Writer;
use super::words::{self, fill};
use crate::derive::Block;
use crate::expr::Expr;
use crate::laws::Unknown;

/// Largest coefficient worth printing while eliminating.
const READABLE: usize = 120;

/// Coefficients of a block's unknowns, and the right side.
type Row = (Vec<Expr>, Expr);

impl Writer<'_> {
    /// Every line from a block's equations to the values of its unknowns, except the last.
    pub(super) fn eliminate(&mut self, block: &Block) {
        let mut rows: Vec<Row> = Vec::new();
        let mut changed: Vec<Row> = Vec::new();
        for equation in &block.equations {
            let mut put_in = false;
            let mut coeffs = vec![Expr::zero(); block.unknowns.len()];
            let mut rhs = equation.known.clone();
            let terms = equation
                .terms
                .iter()
                .filter(|(u, _)| !self.zero.contains(u));
            for (u, k) in terms.cloned().collect::<Vec<_>>() {
                match block.unknowns.iter().position(|v| *v == u) {
                    Some(i) => coeffs[i] = k,
                    None => {
                        let Some(value) = self.value_of(u) else {
                            return;
                        };
                        rhs = rhs - k * &value;
                        put_in = true;
                    }
                }
            }
            let row = (coeffs, self.tidy(&rhs));
            changed.extend(put_in.then(|| row.clone()));
            rows.push(row);
        }
        let put_in = !changed.is_empty();
        if put_in {
            self.say("With the earlier results substituted,");
        }
        if let ([(coeffs, rhs)], [_]) = (rows.as_slice(), block.unknowns.as_slice()) {
            // Where a sign at most stands before the unknown, the result is the next line.
            let [factor, opposite] = [coeffs[0].clone(), -&coeffs[0]];
            if factor.is_one() || opposite.is_one() {
                return;
            }
            let is_zero = rhs.is_zero();
            let mut divisor = factor;
            if put_in {
                let mut row = rows[0].clone();
                if divisor.is_negative() {
                    row = (vec![opposite.clone()], -&row.1);
                    divisor = opposite;
                }
                self.row_line(&block.unknowns, &row, "earlier results substituted");
            }
            if !is_zero {
                self.text(fill("Dividing by {},", [words::formula(&divisor)]));
            }
            return;
        }
        // The others stand above as they are.
        for row in changed {
            self.row_line(&block.unknowns, &row, "earlier results substituted");
        }
        self.forward(block, rows);
    }

    fn forward(&mut self, block: &Block, mut rows: Vec<Row>) {
        let mut left: Vec<usize> = (0..block.unknowns.len()).collect();
        while left.len() > 1 {
            // The row with the fewest unknowns, and of these the simplest coefficient.
            let weight = |row: &Row| {
                row.0.iter().filter(|k| !k.is_zero()).count() * 1000
                    + row.0.iter().map(Expr::size).sum::<usize>()
            };
            let Some(at) = (0..rows.len()).min_by_key(|i| weight(&rows[*i])) else {
                return;
            };
            let (coeffs, rhs) = rows.swap_remove(at);
            let Some(&pivot) = left
                .iter()
                .filter(|i| !coeffs[**i].is_zero())
                .min_by_key(|i| coeffs[**i].size())
            else {
                return;
            };
            let symbol = |i: usize| Expr::symbol(self.d.names.plain(block.unknowns[i]));
            let others: Vec<usize> = left.iter().copied().filter(|i| *i != pivot).collect();
            let mut terms = vec![(Expr::one(), &rhs / &coeffs[pivot])];
            for &i in &others {
                if !coeffs[i].is_zero() {
                    terms.push((symbol(i), -(&coeffs[i] / &coeffs[pivot])));
                }
            }
            let named = symbol(pivot);
            let tidied: Vec<(Expr, Expr)> =
                terms.into_iter().map(|(s, k)| (s, self.tidy(&k))).collect();
            if tidied.iter().any(|(_, k)| k.size() > READABLE) {
                self.say("The remaining coefficients are long; eliminating the other unknowns in the same way ends in the values below.");
                return;
            }
            let right = Expr::sum(tidied.iter().map(|(s, k)| k * s));
            let mut next = Vec::new();
            for (mut c, mut r) in rows {
                let factor = c[pivot].clone();
                if !factor.is_zero() {
                    let raw = &r - &factor * &tidied[0].1;
                    r = self.tidy(&raw);
                    for &i in &others {
                        let raw = &c[i] - &factor * &(&coeffs[i] / &coeffs[pivot]);
                        c[i] = self.tidy(&raw);
                    }
                    c[pivot] = Expr::zero();
                }
                next.push((c, r));
            }
            rows = next;
            left = others;
            self.text(fill("Solve for {}:", [words::formula(&named)]));
            self.claim(named, right, "solved for one unknown");
        }
        if let Some(row) = rows.first().cloned()
            && row.0.iter().chain([&row.1]).all(|e| e.size() <= READABLE)
        {
            self.say("Put into the last equation, this leaves");
            self.row_line(&block.unknowns, &row, "the other unknowns eliminated");
        }
        self.say("and, putting back,");
    }

    fn row_line(&mut self, unknowns: &[Unknown], row: &Row, reason: &str) {
        let terms = unknowns
            .iter()
            .zip(&row.0)
            .map(|(u, k)| k * &Expr::symbol(self.d.names.plain(*u)));
        let left = Expr::sum(terms.filter(|t| !t.is_zero()));
        match left.is_negative() && row.1.is_negative() {
            true => self.claim(-left, -&row.1, reason),
            false => self.claim(left, row.1.clone(), reason),
        };
    }

    /// The closed form of an unknown's symbol.
    fn value_of(&mut self, u: Unknown) -> Option<Expr> {
        let value = self.d.motion.get(&u)?.clone();
        if self.d.names.is_reversed(u) {
            Some(self.tidy(&-&value))
        } else {
            Some(value)
        }
    }
}
