//! Where an expression vanishes, told factor by factor.
//!
//! In: an expression and the domains. Out: places in words.

use super::calc::{bases, sign};
use super::solve::{Roots, solve};
use crate::domain::Domains;
use crate::expr::{Expr, Symbol};
use crate::formula::{Sentence, sentence};

/// The places where a product vanishes: values of a parameter, or an equation where there is no such value.
pub(super) fn of(e: &Expr, domains: &Domains) -> Vec<Sentence> {
    let mut out = Vec::new();
    for base in bases(e) {
        if base.as_number().is_some() || nowhere(&base, domains) {
            continue;
        }
        let symbols: Vec<Symbol> = base.symbols().into_iter().collect();
        let solved = match symbols.as_slice() {
            [only] => solve(&base, only, domains).ok(),
            _ => None,
        };
        match solved {
            Some(Roots { inside, open, .. })
                if open.is_empty() && inside.iter().all(|r| r.proved) =>
            {
                let name = &symbols[0];
                let places = inside.iter();
                out.extend(places.map(|r| sentence!("{} = {}", name, &r.value)));
            }
            _ => out.push(sentence!("{} = 0", &base)),
        }
    }
    out.sort();
    out.dedup();
    out
}

fn nowhere(e: &Expr, domains: &Domains) -> bool {
    let seen = sign(e, domains);
    seen.is_proved() && (seen.is_positive() || seen.is_negative())
}
