//! Relations as `difference rel 0`, and a text of them as the systems of which one holds.

use num_traits::Signed;

use super::cells::Cases;
use super::values::{cancelled, has_values};
use super::{plain, sign_of};
use crate::algebra::Sign;
use crate::domain::Domains;
use crate::expr::{Expr, Function, Node, ratio};
use crate::formula::{Content, Join, Relation};

/// `left − right  rel  0`, turned so that the relation is one of =, ≠, <, ≤.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Normal {
    pub(super) difference: Expr,
    pub(super) relation: Relation,
}

impl Normal {
    pub(super) fn new(difference: Expr, relation: Relation) -> Normal {
        Normal {
            difference,
            relation,
        }
    }

    /// The same relation of another difference.
    pub(super) fn of(&self, difference: Expr) -> Normal {
        Normal::new(difference, self.relation)
    }
}

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

/// A power vanishes where its base does.
pub(super) fn rooted(difference: Expr) -> Expr {
    match difference.node() {
        Node::Power(base, k) if k.as_number().is_some_and(Signed::is_positive) => base.clone(),
        _ => difference,
    }
}

/// What holds where none of several bounds does: nothing where a case has more than one, or some value may be missing.
pub(super) fn negated(cases: &Cases, domains: &Domains) -> Option<Vec<Normal>> {
    let everywhere = |part: &Expr| match part.node() {
        Node::Power(base, k) => k.as_number().is_some_and(|k| {
            let whole = k.is_integer() || sign_of(base, domains).is_some_and(Sign::is_not_negative);
            whole && !k.is_negative()
        }),
        Node::Call(function, _) => {
            matches!(function, Function::Abs | Function::Sin | Function::Cos)
        }
        _ => true,
    };
    let turned = |case: &Vec<Normal>| match case.as_slice() {
        [n] if n.difference.parts().all(everywhere) => {
            let relation = match n.relation {
                Relation::Less => Relation::LessEqual,
                Relation::LessEqual => Relation::Less,
                _ => return None,
            };
            Some(Normal::new(-&n.difference, relation))
        }
        _ => None,
    };
    cases.iter().map(turned).collect()
}

/// `e = 0`.
pub(super) fn equation(e: &Expr) -> Normal {
    Normal::new(e.clone(), Relation::Equal)
}

/// The differences of all sides of two systems.
pub(super) fn differences<'n>(
    expected: impl IntoIterator<Item = &'n Normal>,
    answer: impl IntoIterator<Item = &'n Normal>,
) -> Vec<&'n Expr> {
    let all = expected.into_iter().chain(answer);
    all.map(|n| &n.difference).collect()
}
