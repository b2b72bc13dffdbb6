//! The lines between a relation and the value of the parameter it was solved for: roots and arcs undone, a power or a
//! cosine of the parameter alone on one side.

use std::collections::BTreeMap;
use std::iter::successors;

use super::neat::tidied;
use crate::algebra::{Sign, sign};
use crate::expr::{Expr, Function, Node, Symbol, ratio};
use crate::formula::Relation;
use crate::scene::Scene;

/// Left side, relation, right side.
pub(super) type Related = (Expr, Relation, Expr);

/// What lies between a relation and the range of a parameter that comes of it, each line the same as the one before.
pub(super) fn on_the_way(scene: &Scene, stated: &Related, range: &Related) -> Vec<Related> {
    let undone = undone(scene, stated);
    // What is of the first degree in the parameter is solved without its square.
    let (left, _, right) = undone.as_ref().unwrap_or(stated);
    let slope = range
        .0
        .as_symbol()
        .map(|p| (p, (left - right).derivative(p)));
    let is_linear = slope.is_some_and(|(p, slope)| !slope.mentions(p));
    let is_quadratic = |p: &Symbol| {
        let derivatives = successors(Some(left - right), |e| Some(e.derivative(p)));
        derivatives
            .take(4)
            .last()
            .is_some_and(|e| tidied(scene, &e).is_zero())
    };
    let solves = |p: &Symbol, value: Expr| {
        let put = (left - right).substitute(&BTreeMap::from([(p.clone(), value)]));
        tidied(scene, &put).is_zero()
    };
    let alone = match alone(scene, range) {
        _ if is_linear => Vec::new(),
        Some(line) => vec![line],
        None => match (range.0.as_symbol(), &range.1) {
            // Where the other root is zero, the square says less than the product.
            (Some(p), Relation::Equal) if solves(p, Expr::zero()) && is_quadratic(p) => {
                let product = Expr::symbol(p) * (Expr::symbol(p) - &range.2);
                vec![(product, Relation::Equal, Expr::zero())]
            }
            (Some(p), _) => completed(scene, range, |other| solves(p, other)),
            _ => Vec::new(),
        },
    };
    let lines = undone.into_iter().chain(alone);
    lines
        .filter(|line| line != stated && line != range)
        .collect()
}

/// Both sides squared where the left one is a root, or their cosines or sines where it is an arc.
fn undone(scene: &Scene, (left, relation, right): &Related) -> Option<Related> {
    let half = Expr::symbol("pi") / Expr::from(2);
    let (x, middle, there, turned) = match left.node() {
        // The cosine falls all the way from 0 to π, the sine rises from −π/2 to π/2.
        Node::Call(Function::Acos, x) => (x, half.clone(), right.cos(), relation.turned()),
        Node::Call(Function::Asin, x) => (x, Expr::zero(), right.sin(), *relation),
        _ => return undone_root(scene, left, *relation, right),
    };
    let beyond = [right - &middle + &half, &middle + &half - right];
    let is_within = beyond.iter().all(|e| never_below_zero(scene, e));
    let holds = *relation == Relation::Equal || is_within;
    holds.then(|| (x.clone(), turned, tidied(scene, &there)))
}

/// Both sides squared where the left one is a root.
fn undone_root(scene: &Scene, left: &Expr, relation: Relation, right: &Expr) -> Option<Related> {
    // Beside zero what the root is multiplied by has no part.
    if let (Node::Product(factors), true) = (left.node(), right.is_zero()) {
        let (roots, others): (Vec<_>, Vec<_>) = factors.iter().cloned().partition(is_square_root);
        if let [root] = roots.as_slice()
            && sign(&Expr::product(others), &scene.domains) == Some(Sign::Positive)
        {
            return undone_root(scene, root, relation, right);
        }
    }
    (is_root(left) && never_below_zero(scene, left) && never_below_zero(scene, right))
        .then(|| (square(scene, left), relation, square(scene, right)))
}

/// The square of a parameter whose value is a root, or the cosine, sine or tangent of one whose value is an arc.
fn alone(scene: &Scene, (p, relation, value): &Related) -> Option<Related> {
    if let Node::Call(arc, x) = value.node() {
        let inverse = match arc {
            Function::Acos => p.cos(),
            Function::Asin => p.sin(),
            Function::Atan => p.tan(),
            _ => return None,
        };
        return (*relation == Relation::Equal).then(|| (inverse, Relation::Equal, x.clone()));
    }
    (is_root(value) && never_below_zero(scene, p) && never_below_zero(scene, value))
        .then(|| (square(scene, p), *relation, square(scene, value)))
}

/// The completed square of a parameter whose value is a root and something beside it, and its root where that has one sign;
/// nothing where the value with the other sign of the root does not solve the relation, as one of both does its square.
fn completed(
    scene: &Scene,
    (p, relation, value): &Related,
    solves: impl Fn(Expr) -> bool,
) -> Vec<Related> {
    let is_sum = |e: &&Expr| matches!(e.node(), Node::Sum(_));
    let terms = match value.node() {
        Node::Sum(terms) => terms.to_vec(),
        Node::Product(factors) => {
            let Some(Node::Sum(terms)) = factors.iter().find(is_sum).map(Expr::node) else {
                return Vec::new();
            };
            let others = Expr::product(factors.iter().filter(|f| !is_sum(f)).cloned());
            terms
                .iter()
                .map(|term| tidied(scene, &(term * &others)))
                .collect()
        }
        _ => return Vec::new(),
    };
    let (roots, rest): (Vec<Expr>, Vec<Expr>) = terms.into_iter().partition(is_root);
    let [root] = roots.as_slice() else {
        return Vec::new();
    };
    let rest = tidied(scene, &Expr::sum(rest));
    if !solves(&rest - root) {
        return Vec::new();
    }
    let beyond = p - &rest;
    let has_sign = never_below_zero(scene, &beyond);
    if !never_below_zero(scene, root) || !has_sign && *relation != Relation::Equal {
        return Vec::new();
    }
    let squares = (beyond.powi(2), *relation, square(scene, root));
    let roots = has_sign.then(|| (beyond, *relation, root.clone()));
    [Some(squares), roots].into_iter().flatten().collect()
}

/// The square, without the size that a root of a square in it would leave.
fn square(scene: &Scene, e: &Expr) -> Expr {
    let squared = |factor: &Expr| match factor.node() {
        Node::Power(base, _) if is_square_root(factor) => base.clone(),
        _ => factor.powi(2),
    };
    let square = match e.node() {
        Node::Product(factors) => Expr::product(factors.iter().map(squared)),
        _ => squared(e),
    };
    tidied(scene, &square)
}

fn never_below_zero(scene: &Scene, e: &Expr) -> bool {
    sign(e, &scene.domains).is_some_and(Sign::is_not_negative)
}

/// Whether it is a root, or has one root among its factors.
fn is_root(e: &Expr) -> bool {
    match e.node() {
        Node::Product(factors) => factors.iter().filter(|f| is_square_root(f)).count() == 1,
        _ => is_square_root(e),
    }
}

/// Whether it is the square root of something.
pub(super) fn is_square_root(e: &Expr) -> bool {
    let half = |k: &Expr| k.as_number().is_some_and(|k| *k == ratio(1, 2));
    matches!(e.node(), Node::Power(_, k) if half(k))
}
