//! The values of a parameter at which a condition of higher degree is met: closed forms, and exact isolation of the other roots.

use std::cmp::Ordering;

use super::Answer;
use super::calc::tidy;
use super::solve::Roots;
use crate::algebra::{Cell, Field};
use crate::domain::{Domain, Domains};
use crate::expr::{Expr, Rational, Symbol, ratio};
use crate::formula::{Sentence, sentence};
use crate::interval::enclosure::decimal;
use crate::scene::Scene;

/// A condition of higher degree: the values with closed forms, and exact isolation of the others once all other symbols have
/// values.
pub(super) fn isolate(
    out: &mut Answer,
    parameter: &Symbol,
    gap: &Expr,
    roots: &Roots,
    scene: &Scene,
) {
    for root in &roots.inside {
        let mut words = sentence!("{} = {}", parameter, &root.value);
        if !root.given.is_empty() {
            let given = Sentence::join(root.given.clone(), " and ");
            words = sentence!("{}, given that {}", words, given);
        }
        if !root.proved {
            words = sentence!("{} (not proved)", words);
        }
        out.text.push(words);
    }
    let mut values = scene.values();
    values.remove(parameter);
    let at_values = |e: &Expr| tidy(&e.substitute(&values), &scene.domains).ok();
    let bounds = bounds(parameter, scene);
    let beside = ratio(1, 1 << 40);
    for coefficients in &roots.open {
        let degree = (coefficients.len() - 1).to_string();
        let terms = coefficients.iter().zip(0..);
        let terms = terms.map(|(c, k)| {
            Some(Expr::from(at_values(c)?.as_number()?.clone()) * Expr::symbol(parameter).powi(k))
        });
        let polynomial = terms.collect::<Option<Vec<_>>>().map(Expr::sum);
        let Some((polynomial, found)) =
            polynomial.and_then(|p| Some((p.clone(), roots_of(&p, &p, parameter)?)))
        else {
            out.text.push(sentence!("a polynomial of degree {} in {} has to vanish, which has no closed form here; with fractions as values of all other symbols its roots are enclosed", degree, parameter));
            continue;
        };
        // What has no exact sign at the roots is not held against them.
        let bounds = bounds.iter().filter_map(|(excess, closed, against)| {
            Some((
                roots_of(&polynomial, &at_values(excess)?, parameter)?,
                closed,
                against,
            ))
        });
        let bounds: Vec<_> = bounds.collect();
        for (i, root) in found.into_iter().enumerate() {
            let [low, high] = root.around;
            let ends = [&low, &high].map(|end| decimal(end, 15));
            let words = match low == high {
                true => sentence!("{} = {}", parameter, &Expr::from(low.clone())),
                false => sentence!("{} between {} and {}", parameter, &ends[0], &ends[1]),
            };
            let excluded = bounds
                .iter()
                .find(|(roots, closed, _)| match roots[i].signs[1] {
                    Some(sign) => sign.is_lt() || sign.is_eq() && !**closed,
                    None => false,
                });
            if let Some((_, _, against)) = excluded {
                out.discarded.push(sentence!("{}, {}", words, *against));
                continue;
            }
            // Squaring may have brought the root in: the difference must change its sign across it.
            let side = |x: &Rational| {
                let e = gap
                    .substitute(&values)
                    .put(parameter, &Expr::from(x.clone()));
                e.evaluate(&crate::expr::Point::<f64>::default())
            };
            let changes = match (side(&(low - &beside)), side(&(high + &beside))) {
                (Some(a), Some(b)) if a * b <= 0.0 => "changes its sign there",
                (Some(_), Some(_)) => "does not change its sign there",
                _ => "has no value beyond it",
            };
            out.text.push(sentence!(
                "{}: one root of degree {}, isolated exactly; the difference of the sides {}",
                words,
                &degree,
                changes
            ));
        }
    }
    if out.text.is_empty() {
        out.text.push(Sentence::words(
            "no real root within the domain: the sides never meet",
        ));
    }
}

/// What a parameter keeps to: something that is not negative, or positive where it is open, and the words for a value that does
/// not keep to it.
fn bounds(parameter: &Symbol, scene: &Scene) -> Vec<(Expr, bool, Sentence)> {
    let value = Expr::symbol(parameter);
    let domain = scene.domains.of_symbol(parameter);
    let outside = || Sentence::words("outside the domain");
    let low = domain.low.map(|l| (&value - &l.expr(), !l.open, outside()));
    let high = domain
        .high
        .map(|h| (&h.expr() - &value, !h.open, outside()));
    let relations = scene.domains.relations.iter();
    let relations = relations.filter(|r| r.excess.mentions(parameter)).map(|r| {
        let against = sentence!("against {}", super::solve::stated(r));
        (r.excess.clone(), r.closed, against)
    });
    low.into_iter().chain(high).chain(relations).collect()
}

/// The real roots of a polynomial in one symbol, each a fraction or between two, with the sign of another formula there.
fn roots_of(polynomial: &Expr, other: &Expr, name: &Symbol) -> Option<Vec<Cell>> {
    let mut domains = Domains::default();
    domains.symbols.insert(name.clone(), Domain::real());
    let mut field = Field::new(&domains);
    field.prepare([polynomial, other]);
    let elements = [field.element(polynomial).ok()?, field.element(other).ok()?];
    let mut cells = field.signs_along(name, &elements)?;
    cells.retain(|cell| cell.single && cell.signs[0].is_some_and(Ordering::is_eq));
    Some(cells)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_held_against_an_end_exactly() {
        let x = Expr::symbol("x");
        let left = Expr::from(ratio(1, 2)) - &x;
        let signs = |p: Expr| {
            let roots = roots_of(&p, &left, &"x".into()).expect("decided");
            roots
                .iter()
                .flat_map(|root| root.signs[1])
                .collect::<Vec<_>>()
        };
        let near = |k: i64| &left * Expr::from(1000) + Expr::from(k);
        assert_eq!(signs(left.clone()), [Ordering::Equal]);
        assert_eq!(signs(near(1)), [Ordering::Less]);
        assert_eq!(signs(near(-1)), [Ordering::Greater]);
        let square = x.powi(2);
        let quartic = (&square + Expr::one()) * (&square - Expr::from(2));
        assert_eq!(signs(quartic), [Ordering::Greater, Ordering::Less]);
        assert!(signs(square + Expr::one()).is_empty());
    }
}
