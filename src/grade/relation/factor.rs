//! What one equation is of another: a multiple of it, or the same with the sign of a term turned.

use super::super::compare::WRITTEN;
use super::{Normal, same_sign};
use crate::algebra::{Element, Field, Sign};
use crate::domain::{Domains, roles};
use crate::expr::{Expr, Node};
use crate::formula::Relation;

/// The one term of the answer whose sign has to be turned to make the equations the same.
pub(super) fn turned_term(f: &Expr, g: &Expr, domains: &Domains) -> Option<Expr> {
    let Node::Sum(terms) = g.node() else {
        return None;
    };
    (0..terms.len().min(12)).find_map(|i| {
        let all = terms
            .iter()
            .enumerate()
            .map(|(j, t)| if i == j { -t } else { t.clone() });
        let normal = |difference: Expr| Normal {
            difference,
            relation: Relation::Equal,
        };
        same_sign(&normal(f.clone()), &normal(Expr::sum(all)), domains).map(|_| terms[i].clone())
    })
}

/// What sets two differences apart: the sign of the quotient where it has one, and its parts that may vanish.
pub(super) struct Factor {
    pub positive: bool,
    pub weak: Vec<Expr>,
}

/// The quotient of two differences, where its sign is known.
pub(super) fn factor(f: &Expr, g: &Expr, domains: &Domains) -> Option<Factor> {
    let (domains, _) = domains.completed(&roles(&[f, g]));
    let mut field = Field::new(&domains);
    field.prepare([f, g]);
    let (x, y) = (field.element(f).ok()?, field.element(g).ok()?);
    if field.is_zero(&x) || field.is_zero(&y) {
        return None;
    }
    // One way round a quotient may divide out that does not the other way.
    let (quotient, sign) = [(&y, &x), (&x, &y)].into_iter().find_map(|(a, b)| {
        let quotient = field.div(a, b).ok().filter(|q| q.terms() <= WRITTEN)?;
        let sign = field.sign(&quotient)?;
        Some((quotient, sign))
    })?;
    let strict = |x: &Element| matches!(field.sign(x), Some(Sign::Positive | Sign::Negative));
    let below = field.below(&quotient).ok()?;
    let parts = [field.zeros(&quotient), field.zeros(&below)].concat();
    let weak = parts.iter().filter(|x| !strict(x));
    Some(Factor {
        positive: sign.is_not_negative(),
        weak: weak.map(|x| field.expr(x)).collect(),
    })
}
