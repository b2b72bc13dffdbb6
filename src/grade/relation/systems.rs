//! A text of relations as the systems of which one holds.

use super::defined::{cancelled, has_values};
use super::normal::{Normal, rooted};
use super::plain;
use crate::expr::{Expr, Node, ratio};
use crate::formula::{Content, Join, Relation};
use num_traits::Signed;

/// The systems of which one holds.
pub(super) fn cases(content: &Content) -> Option<Vec<Vec<Normal>>> {
    match content {
        Content::Relations(sides, signs) => Some(vec![links(sides, signs)?]),
        Content::Joined(join, parts) => {
            let parts: Vec<_> = parts.iter().map(cases).collect::<Option<_>>()?;
            match join {
                // One of several equations holds where the product of their differences vanishes.
                Join::Or => Some(match one_of(&parts).filter(has_values) {
                    Some(product) => vec![vec![product]],
                    None => parts.concat(),
                }),
                // Each case of one with each case of the others.
                Join::And => {
                    let first = vec![Vec::new()];
                    parts.iter().try_fold(first, |all, part| {
                        let with = |case: &Vec<Normal>| {
                            let each = part.iter().map(|other| [&case[..], other].concat());
                            each.collect::<Vec<_>>()
                        };
                        let all: Vec<_> = all.iter().flat_map(with).collect();
                        (all.len() <= plain::MOST_CASES).then_some(all)
                    })
                }
            }
        }
        _ => None,
    }
}

/// The equation that holds where one of several does.
fn one_of(parts: &[Vec<Vec<Normal>>]) -> Option<Normal> {
    let alone = |cases: &Vec<Vec<Normal>>| match cases.as_slice() {
        [system] => match system.as_slice() {
            [n] if n.relation == Relation::Equal => Some(n.difference.clone()),
            _ => None,
        },
        _ => None,
    };
    let differences: Vec<Expr> = parts.iter().map(alone).collect::<Option<_>>()?;
    Some(Normal::new(Expr::product(differences), Relation::Equal))
}

/// The relations of a chain; an equation between vectors is one for each component, and with ± it is one that vanishes for
/// either sign.
pub(super) fn links(sides: &[Content], signs: &[Relation]) -> Option<Vec<Normal>> {
    let mut out = Vec::new();
    for (pair, sign) in sides.windows(2).zip(signs) {
        let equation = matches!(sign, Relation::Equal | Relation::NotEqual);
        match pair {
            [Content::Vector(a), Content::Vector(b)] if *sign == Relation::Equal => {
                let parts = a.iter().zip(b).map(|(a, b)| normal(a, b, *sign));
                out.extend(parts.filter(|n| !n.difference.is_zero()));
            }
            [Content::Vector(v), other] | [other, Content::Vector(v)]
                if *sign == Relation::Equal && other.expr().is_some_and(Expr::is_zero) =>
            {
                out.extend(v.iter().map(|c| normal(c, &Expr::zero(), *sign)));
            }
            [Content::Either(a), Content::Either(b)] if equation && a.len() == b.len() => {
                out.push(either(a.iter().zip(b), *sign));
            }
            [Content::Either(values), other] | [other, Content::Either(values)] if equation => {
                let other = other.expr()?;
                out.push(either(values.iter().map(|value| (other, value)), *sign));
            }
            [a, b] => {
                let (a, b) = (a.expr()?, b.expr()?);
                let n = normal(a, b, *sign);
                let gone = cancelled([a, b], &n.difference);
                match squares(&n) {
                    Some(all) => out.extend(all),
                    None => out.push(n),
                }
                out.extend(gone);
            }
            _ => return None,
        }
    }
    (!out.is_empty()).then_some(out)
}

fn either<'e>(pairs: impl Iterator<Item = (&'e Expr, &'e Expr)>, relation: Relation) -> Normal {
    let differences: Vec<Expr> = pairs.map(|(a, b)| a - b).collect();
    Normal::new(Expr::product(differences), relation)
}

fn normal(left: &Expr, right: &Expr, relation: Relation) -> Normal {
    let (difference, relation) = match relation {
        Relation::Greater => (right - left, Relation::Less),
        Relation::GreaterEqual => (right - left, Relation::LessEqual),
        other => (left - right, other),
    };
    match relation {
        Relation::Equal | Relation::NotEqual => Normal::new(rooted(difference), relation),
        _ => Normal::new(difference, relation),
    }
}

/// A sum of squares vanishes where each of them does.
fn squares(n: &Normal) -> Option<Vec<Normal>> {
    let terms = n.difference.terms();
    let even = |k: &Expr| {
        let half = k.as_number().map(|k| k / ratio(2, 1));
        half.is_some_and(|half| half.is_integer() && half.is_positive())
    };
    let base = |term: &Expr| {
        let (factor, rest) = term.split_number();
        match rest.node() {
            Node::Power(base, k) if even(k) => Some((factor.is_positive(), base.clone())),
            _ => None,
        }
    };
    let all: Vec<(bool, Expr)> = terms.iter().map(base).collect::<Option<_>>()?;
    let alike = all.len() > 1 && all.iter().all(|(sign, _)| *sign == all[0].0);
    let each = all.into_iter();
    (alike && n.relation == Relation::Equal).then(|| each.map(|(_, base)| n.of(base)).collect())
}
