//! Cases in several symbols that hold for the same signs of the parts of their differences: `x ≠ y` and `x < y or x > y`.

use std::cmp::Ordering;

use super::normal::{Cases, Normal, equation, holds};
use super::{same_sign, sign_of};
use crate::algebra::Sign;
use crate::domain::Domains;
use crate::expr::{Expr, Node};
use crate::formula::Relation;

/// Most parts of which all signs are tried.
const MOST: usize = 6;

/// A relation of a product of parts, by their places, each with whether its power is odd.
struct Product {
    relation: Relation,
    negative: bool,
    parts: Vec<(usize, bool)>,
}

/// Whether two systems of relations hold for the same signs of their parts. Signs that no point has do no harm where the two
/// agree on them too.
pub(super) fn agree(expected: &Cases, answer: &Cases, domains: &Domains) -> bool {
    let mut parts = Vec::new();
    let mut read = |cases: &Cases| -> Option<Vec<Vec<Product>>> {
        let mut system = |all: &Vec<Normal>| {
            let each = all.iter().map(|n| product(n, &mut parts, domains));
            each.collect::<Option<Vec<Product>>>()
        };
        cases.iter().map(&mut system).collect()
    };
    let (Some(expected), Some(answer)) = (read(expected), read(answer)) else {
        return false;
    };
    let all = 3_usize.pow(parts.len() as u32);
    let truths = |cases: &[Vec<Product>]| -> Vec<bool> {
        let any = |signs| cases.iter().any(|all| all.iter().all(|p| p.holds(signs)));
        (0..all).map(any).collect()
    };
    truths(&expected) == truths(&answer)
}

/// A relation of a product of polynomials, which have a value everywhere; parts that are new are added to the list.
fn product(n: &Normal, parts: &mut Vec<Expr>, domains: &Domains) -> Option<Product> {
    let mut found = Product {
        relation: n.relation,
        negative: false,
        parts: Vec::new(),
    };
    for factor in n.difference.factors() {
        let (base, odd) = match factor.node() {
            Node::Power(base, k) => {
                let k = k.as_number().filter(|k| k.is_integer())?;
                (base, k.numer().as_i64()?.rem_euclid(2) == 1)
            }
            _ => (factor, true),
        };
        if !factor.is_polynomial() {
            return None;
        }
        match sign_of(base, domains) {
            Some(Sign::Positive) => continue,
            Some(Sign::Negative) => {
                found.negative ^= odd;
                continue;
            }
            _ => {}
        }
        let known = parts.iter().enumerate();
        let same = |(at, part): (usize, &Expr)| {
            let found = same_sign(&equation(part), &equation(base), domains)?;
            Some((at, found))
        };
        let (at, positive) = match known.filter_map(same).next() {
            Some(found) => found,
            None if parts.len() < MOST => {
                parts.push(base.clone());
                (parts.len() - 1, true)
            }
            None => return None,
        };
        found.negative ^= odd && !positive;
        found.parts.push((at, odd));
    }
    Some(found)
}

impl Product {
    /// Whether it holds where the parts have these signs, one digit to the base of three each.
    fn holds(&self, signs: usize) -> bool {
        let mut sign = Ordering::Greater;
        for (at, odd) in &self.parts {
            match signs / 3_usize.pow(*at as u32) % 3 {
                0 => return holds(self.relation, Some(Ordering::Equal)),
                1 if *odd => sign = sign.reverse(),
                _ => {}
            }
        }
        if self.negative {
            sign = sign.reverse();
        }
        holds(self.relation, Some(sign))
    }
}
