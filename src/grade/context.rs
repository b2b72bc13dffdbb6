//! What a comparison works with, and how much is written out while looking for what is wrong.

use std::collections::BTreeMap;

use super::{Key, Options, fraction};
use crate::algebra::Field;
use crate::dimension::Dimension;
use crate::domain::Domains;
use crate::equality;
use crate::expr::Expr;
use crate::formula::write_unicode;

/// What a comparison works with.
pub(crate) struct Context<'a> {
    pub key: &'a Key,
    pub options: &'a Options,
    /// Whether to look for what is wrong.
    pub diagnose: bool,
}

impl<'a> Context<'a> {
    pub(super) fn new(key: &'a Key, options: &'a Options, diagnose: bool) -> Context<'a> {
        Context {
            key,
            options,
            diagnose,
        }
    }

    /// The same without a look for what is wrong.
    pub(super) fn plain(&self) -> Context<'a> {
        Context::new(self.key, self.options, false)
    }

    /// Where the symbols live.
    pub fn domains(&self) -> &'a Domains {
        &self.key.question.domains
    }

    /// Dimension of a symbol, where the question declares it.
    pub fn dimension_of(&self, name: &str) -> Option<Dimension> {
        self.key.question.dimension_of(name)
    }

    /// An expression as the question's author typesets it, for messages.
    pub fn say(&self, e: &Expr) -> String {
        let names: BTreeMap<&str, &str> = self
            .key
            .question
            .symbols
            .iter()
            .filter_map(|g| Some((&*g.name, g.latex.as_deref()?)))
            .collect();
        write_unicode(e, &|name| names.get(name).map(|l| (*l).to_string()))
    }
}

/// Most terms of what is written out while looking for what is wrong; more would cost much and tell nobody anything.
pub(crate) const WRITTEN: usize = 300;

/// Most products of terms it may take to write out two formulas while looking for what is wrong.
const PRODUCTS: usize = 100_000;

/// Whether two formulas are written out as sums of products without much work.
pub(crate) fn is_short(a: &Expr, b: &Expr) -> bool {
    equality::work(a).saturating_add(equality::work(b)) <= PRODUCTS
}

/// The quotient of two expressions where it is a number.
pub(crate) fn quotient(a: &Expr, b: &Expr, ctx: &Context) -> Option<Expr> {
    if !is_short(a, b) {
        return None;
    }
    let (field, x, y) = Field::pair(ctx.domains(), a, b).ok()?;
    let q = field.div(&x, &y).ok()?;
    if q.terms() > WRITTEN {
        return None;
    }
    let q = field.expr(&q);
    q.is_constant().then_some(q)
}

/// Whether two constants are plainly equal.
pub(crate) fn same_number(a: &Expr, b: &Expr) -> bool {
    matches!((fraction(a), fraction(b)), (Some(a), Some(b)) if a == b)
}
