//! Bounds of one symbol that need not be exact: each is solved for first, and then stands in the place of the expected one that it
//! is near.

use num_traits::Signed;

use super::between_bars;
use super::solved::solve_for;
use crate::domain::Domains;
use crate::expr::{Expr, Symbol, only};
use crate::formula::{Content, Join, Relation};

/// `name  sign  value`.
#[derive(Clone)]
struct Bound {
    name: Symbol,
    sign: Relation,
    value: Content,
}

impl Bound {
    /// A relation of two sides, solved for the one name in it, which stands in it with a number before it.
    fn of(left: &Content, sign: Relation, right: &Content) -> Option<Bound> {
        let difference = left.expr()? - right.expr()?;
        let name = only(difference.symbols())?;
        let falls = difference.derivative(&name).as_number()?.is_negative();
        let sign = if falls { sign.turned() } else { sign };
        let value = solve_for(&difference, &name, &Domains::default())?;
        let value = match [left, right]
            .into_iter()
            .find(|side| matches!(side, Content::Quantity(_)))
        {
            Some(Content::Quantity(q)) => {
                let written = &value * &q.unit.value().powi(-1);
                let quantity = crate::formula::Quantity::of(written, q.unit.clone(), &q.unit_text);
                Content::Quantity(Box::new(quantity))
            }
            _ => Content::Scalar(value),
        };
        Some(Bound { name, sign, value })
    }

    fn content(self) -> Content {
        let name = Content::Scalar(Expr::symbol(&self.name));
        Content::Relations(vec![name, self.value], vec![self.sign])
    }
}

/// `|x| < a` as `x < a and x > -a`, and `|x| > a` as `x > a or x < -a`.
fn folded(left: &Content, sign: Relation, right: &Content) -> Option<(Join, [Bound; 2])> {
    let (name, sign, value) = match between_bars(left) {
        Some(name) => (name, sign, right.expr()?),
        None => (between_bars(right)?, sign.turned(), left.expr()?),
    };
    if !value.is_constant() || !sign.is_order() {
        return None;
    }
    let join = if sign.is_below() { Join::And } else { Join::Or };
    let bound = |sign: Relation, value: Expr| Bound {
        name: name.clone(),
        sign,
        value: Content::Scalar(value),
    };
    Some((
        join,
        [bound(sign, value.clone()), bound(sign.turned(), -value)],
    ))
}

/// A content with each of its bounds solved for and changed; nothing where something else stands in it.
fn solved(content: &Content, change: &mut dyn FnMut(Bound) -> Bound) -> Option<Content> {
    let mut join = Join::And;
    let parts: Vec<Content> = match content {
        Content::Joined(said, parts) => {
            join = *said;
            let parts = parts.iter().map(|part| solved(part, change));
            parts.collect::<Option<_>>()?
        }
        Content::Relations(sides, signs) => {
            let links = sides.windows(2).zip(signs);
            let links = links.map(|(sides, sign)| match folded(&sides[0], *sign, &sides[1]) {
                Some((join, bounds)) => {
                    let bounds = bounds.map(|bound| change(bound).content());
                    Some(Content::Joined(join, bounds.into()))
                }
                None => Some(change(Bound::of(&sides[0], *sign, &sides[1])?).content()),
            });
            links.collect::<Option<_>>()?
        }
        _ => return None,
    };
    Some(match <[Content; 1]>::try_from(parts) {
        Ok([one]) => one,
        Err(parts) => Content::Joined(join, parts),
    })
}

/// An answer with every bound solved for, and with the expected bound in the place of one of the same sense that is near.
pub(in crate::grade) fn at_bounds(
    expected: &Content,
    answer: &Content,
    near: &dyn Fn(&Expr, &Expr) -> bool,
) -> Option<Content> {
    let mut all = Vec::new();
    solved(expected, &mut |bound| {
        all.push(bound.clone());
        bound
    })?;
    solved(answer, &mut |mut bound| {
        let is_near = |other: &&Bound| {
            let units = [&bound.value, &other.value].map(|value| match value {
                Content::Quantity(q) => Some(&q.unit.dimension),
                _ => None,
            });
            let values = bound.value.expr().zip(other.value.expr());
            other.name == bound.name
                && other.sign == bound.sign
                && units[0] == units[1]
                && values.is_some_and(|(own, expected)| near(own, expected))
        };
        let found = all.iter().find(is_near).map(|other| other.value.clone());
        bound.value = found.unwrap_or(bound.value);
        bound
    })
}
