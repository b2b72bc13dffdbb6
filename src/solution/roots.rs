//! Long roots that formulas share get a letter, told before its first use.

use super::isolate::is_square_root;
use super::words::{self, fill};
use super::{Claim, Line, Meaning, Part, Writer};
use crate::expr::{Expr, Node};

/// Least size, in nodes, of a root that gets a letter.
const LONG: usize = 25;

impl Writer<'_> {
    /// Gives letters to the long roots in formulas that stand there at least so often.
    pub(super) fn name_roots(&mut self, formulas: &[Expr], least: usize) {
        let mut found: Vec<(Expr, usize)> = Vec::new();
        for part in formulas.iter().flat_map(Expr::parts) {
            if !is_long_root(part) {
                continue;
            }
            match found.iter_mut().find(|(root, _)| root == part) {
                Some((_, count)) => *count += 1,
                None => found.push((part.clone(), 1)),
            }
        }
        found.retain(|(root, count)| *count >= least && self.roots.iter().all(|(r, _)| r != root));
        for (root, _) in found {
            let [name] = self.free(&["s", "q", "z"], |letter| [letter.to_owned()]);
            let symbol = Expr::symbol(&name);
            let claim = Claim::new(symbol.clone(), root.clone());
            self.step(Vec::new(), vec![claim], "a letter for a long root");
            if let Some(step) = self.last_step() {
                step.defines = Some(name.clone());
            }
            self.solution
                .meanings
                .insert(name.clone(), Meaning::Defined);
            // Its square is a sum, and so breaks over lines.
            let square = Claim::new(symbol.powi(2), radicand(&root));
            let id = self.step(Vec::new(), vec![square.clone()], "the square of the root");
            let lead = "Let {} be the positive root of";
            self.text(fill(lead, [words::formula(&symbol)]));
            let math = words::related(&square.left, "=", &square.right);
            let step = Some(id);
            self.push(Part::Display(vec![Line { math, step }]));
            self.roots.push((root, name));
        }
    }

    /// A formula with the letters of its roots.
    pub(super) fn with_roots(&self, e: &Expr) -> Expr {
        match self.roots.iter().find(|(root, _)| root == e) {
            Some((_, name)) => Expr::symbol(name),
            None => e.map_parts(|part| self.with_roots(part)),
        }
    }
}

fn is_long_root(e: &Expr) -> bool {
    is_square_root(e) && e.size() > LONG
}

/// What stands under a root.
fn radicand(e: &Expr) -> Expr {
    match e.node() {
        Node::Power(base, _) => base.clone(),
        _ => e.powi(2),
    }
}
