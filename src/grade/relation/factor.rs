//! What one equation is of another: a multiple of it, or the same with the sign of a term turned.

use super::super::context::WRITTEN;
use super::{Normal, equation, pair, same_sign};
use crate::algebra::{Element, Field, Sign};
use crate::domain::Domains;
use crate::expr::{Expr, Node};
use crate::formula::Relation;

/// The one term of the answer whose sign has to be turned to make the equations the same.
pub(super) fn turned_term(f: &Expr, g: &Expr, domains: &Domains) -> Option<Expr> {
    let Node::Sum(terms) = g.node() else {
        return None;
    };
    (0..terms.len().min(12)).find_map(|i| {
        let mut all = terms.clone();
        all[i] = -&terms[i];
        let turned = equation(&Expr::sum(all));
        same_sign(&equation(f), &turned, domains).map(|_| terms[i].clone())
    })
}

/// What sets two differences apart: the sign of the quotient where it has one, and its parts that may vanish.
pub(super) struct Factor {
    pub positive: bool,
    pub weak: Vec<Expr>,
}

impl Factor {
    /// One that is positive everywhere.
    pub(super) fn positive() -> Factor {
        Factor {
            positive: true,
            weak: Vec::new(),
        }
    }
}

/// The quotient of two differences, where its sign is known.
pub(super) fn factor(f: &Expr, g: &Expr, domains: &Domains) -> Option<Factor> {
    let (field, x, y) = pair(f, g, domains)?;
    if field.is_zero(&x) || field.is_zero(&y) {
        return None;
    }
    // One way round a quotient may divide out that does not the other way.
    let (quotient, sign) = [(&y, &x), (&x, &y)].into_iter().find_map(|(a, b)| {
        let quotient = field.div(a, b).ok().filter(|q| q.terms() <= WRITTEN)?;
        let sign = field.sign(&quotient)?;
        Some((quotient, sign))
    })?;
    let strict = |x: &Element| field.sign(x).is_some_and(Sign::is_strict);
    let below = field.below(&quotient).ok()?;
    let parts = [field.zeros(&quotient), field.zeros(&below)].concat();
    let weak = parts.iter().filter(|x| !strict(x));
    Some(Factor {
        positive: sign.is_not_negative(),
        weak: weak.map(|x| field.expr(x)).collect(),
    })
}

/// The same relation without a square root: multiplied by the difference with that root turned round, where this has one
/// sign on the domain, as v + √a has in (v − √a)(v + √a) > 0. What stands under the root must not be negative where the
/// other relation holds: it is not on the domain, or it is a square where the equation holds.
pub(super) fn unrooted(n: &Normal, domains: &Domains) -> Option<Normal> {
    let mut parts = n.difference.parts();
    let (root, inside) = parts.find_map(|part| Some((part, part.under_root()?)))?;
    let other = n.difference.replace(root, &-root);
    let domains = domains.of(&[&other]);
    let mut field = Field::new(&domains);
    field.prepare([&n.difference, &other]);
    let sign = |field: &mut Field, e: &Expr| {
        let x = field.proved(e).ok()??;
        field.sign(&x)
    };
    let is_term = |term: &Expr| match term.node() {
        Node::Product(factors) => {
            matches!(factors.as_slice(), [k, r] if k.as_number().is_some() && r == root)
        }
        _ => term == root,
    };
    let square = match (n.relation, n.difference.node()) {
        (Relation::Equal, Node::Sum(terms)) => terms.iter().any(is_term),
        _ => false,
    };
    let sure = square || sign(&mut field, inside).is_some_and(|sign| sign.is_not_negative());
    let other = match sign(&mut field, &other).filter(|_| sure)? {
        Sign::Positive => other,
        Sign::Negative => -other,
        _ => return None,
    };
    let product = field.proved(&(&n.difference * &other)).ok()??;
    Some(n.of(field.expr(&product)))
}
