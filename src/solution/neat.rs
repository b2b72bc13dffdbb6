//! A formula as it comes from a law, tidied only as far as a hand would on the way: like factors as one power, no term that
//! is zero, no quotient of two negative sums. What it is made of stays to be seen, which a normal form would hide.

use num_traits::One;

use crate::algebra::Field;
use crate::expr::{Expr, Int, Node, Rational};
use crate::formula::write_plain;
use crate::scene::Scene;

/// The same formula, as a hand would write it before working it out.
pub(super) fn neat(scene: &Scene, e: &Expr) -> Expr {
    match e.node() {
        Node::Sum(terms) => {
            let each = terms.iter().map(|t| {
                let made = neat(scene, t);
                let short = tidied(scene, &made);
                if short.size() <= made.size() {
                    short
                } else {
                    made
                }
            });
            let mut each: Vec<Expr> = without_opposites(each.collect());
            // What is taken away stands behind.
            each.sort_by_key(Expr::is_negative);
            Expr::sum(each)
        }
        Node::Product(factors) => product(scene, factors),
        Node::Power(base, exponent) => {
            let base = neat(scene, base);
            let even = exponent
                .as_number()
                .and_then(whole)
                .is_some_and(|n| n % 2 == 0);
            match even && base.is_negative() {
                true => (-base).power(exponent.clone()),
                false => base.power(exponent.clone()),
            }
        }
        _ => e.clone(),
    }
}

/// Terms without those that another one takes away, within brackets too: of `d + h − (h + s)` is left `d − s`.
fn without_opposites(terms: Vec<Expr>) -> Vec<Expr> {
    let opened = |term: &Expr| match (term.split_number(), term.terms().len()) {
        ((sign, inside), 1) if sign == Rational::from(-Int::one()) => {
            inside.terms().iter().map(|t| -t).collect()
        }
        _ => term.terms().to_vec(),
    };
    let mut left: Vec<Expr> = terms.iter().flat_map(opened).collect();
    let opened = left.len();
    let mut i = 0;
    while i < left.len() {
        match left.iter().position(|other| *other == -&left[i]) {
            Some(j) if j != i => {
                left.remove(i.max(j));
                left.remove(i.min(j));
                i = 0;
            }
            _ => i += 1,
        }
    }
    if left.len() == opened { terms } else { left }
}

/// A sum in which equal terms stand as one: of `M + m + M` is made `2 M + m`.
pub(super) fn counted(e: &Expr) -> Expr {
    let mut counts: Vec<(Expr, i64)> = Vec::new();
    for term in e.terms() {
        match counts.iter_mut().find(|(other, _)| other == term) {
            Some((_, count)) => *count += 1,
            None => counts.push((term.clone(), 1)),
        }
    }
    Expr::sum(
        counts
            .into_iter()
            .map(|(term, count)| Expr::from(count) * term),
    )
}

fn product(scene: &Scene, factors: &[Expr]) -> Expr {
    let mut sign = 1;
    // What stands below the line is gathered by itself: a mass that cancels is to be seen.
    let mut gathered: Vec<(Expr, i64)> = Vec::new();
    let mut others = Vec::new();
    for factor in factors {
        let factor = neat(scene, factor);
        if factor.is_zero() {
            return factor;
        }
        let (mut base, exponent) = match factor.node() {
            Node::Power(base, exponent) => match exponent.as_number().and_then(whole) {
                Some(n) => (base.clone(), n),
                None => {
                    others.push(factor);
                    continue;
                }
            },
            Node::Number(_) => {
                others.push(factor);
                continue;
            }
            _ => (factor.clone(), 1),
        };
        if let Node::Sum(terms) = base.node()
            && terms.iter().all(Expr::is_negative)
        {
            base = Expr::sum(terms.iter().map(|t| -t));
            if exponent % 2 != 0 {
                sign = -sign;
            }
        }
        let like = |(b, n): &&mut (Expr, i64)| *b == base && (*n > 0) == (exponent > 0);
        match gathered.iter_mut().find(like) {
            Some((_, n)) => *n += exponent,
            None => gathered.push((base, exponent)),
        }
    }
    let powers = gathered.into_iter().map(|(base, n)| base.powi(n));
    Expr::product([Expr::from(sign)].into_iter().chain(others).chain(powers))
}

fn whole(number: &crate::expr::Rational) -> Option<i64> {
    number.is_integer().then(|| number.numer().as_i64())?
}

/// An expression in its shortest normal form; as it is where a limit of the algebra is met.
pub(super) fn tidied(scene: &Scene, e: &Expr) -> Expr {
    let mut field = Field::new(&scene.domains);
    field.prepare([e]);
    match field.proved(e) {
        Ok(Some(x)) => field.expr(&x),
        _ => e.clone(),
    }
}

/// Whether two formulas read alike, whatever the order of terms and factors.
pub(super) fn alike(a: &Expr, b: &Expr) -> bool {
    // D/(e w) is one fraction however it was put together.
    same_parts(a, b) || write_plain(a) == write_plain(b)
}

fn same_parts(a: &Expr, b: &Expr) -> bool {
    match (a.node(), b.node()) {
        (Node::Product(x), Node::Product(y)) | (Node::Sum(x), Node::Sum(y)) => {
            x.len() == y.len() && x.iter().all(|f| y.iter().any(|g| same_parts(f, g)))
        }
        (Node::Power(x, j), Node::Power(y, k)) => same_parts(x, y) && same_parts(j, k),
        _ => a == b,
    }
}
