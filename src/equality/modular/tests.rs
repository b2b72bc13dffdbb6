//! Pairs that are decided at points, and pairs that are left to the proof.

use super::*;
use crate::domain::roles;

fn found(a: &Expr, b: &Expr, domains: &Domains) -> Option<AtPoints> {
    let roles = roles(&[a, b]);
    compare(a, b, &domains.completed(&roles).0, &roles)
}

fn equal(a: &Expr, b: &Expr) -> Option<bool> {
    found(a, b, &Domains::default()).map(|found| found.equal)
}

#[test]
fn identities_hold_with_a_small_bound_and_other_pairs_are_told_apart() {
    let [x, y] = ["x", "y"].map(Expr::symbol);
    let square = (&x + &y).powi(2);
    let written = x.powi(2) + Expr::from(2) * &x * &y + y.powi(2);
    let same = found(&square, &written, &Domains::default()).expect("polynomials");
    assert!(same.equal && same.bound > 0.0 && same.bound < 1e-30 && !same.roots);
    assert_eq!(equal(&square, &(&written + &Expr::one())), Some(false));
    let half = Expr::ratio(1, 2) * &x;
    assert_eq!(
        equal(&x.sin(), &(Expr::from(2) * half.sin() * half.cos())),
        Some(true)
    );
    let turned = &x + &(Expr::pi() * Expr::ratio(1, 2));
    assert_eq!(equal(&turned.sin(), &x.cos()), Some(true));
    assert_eq!(equal(&turned.cos(), &x.sin()), Some(false));
}

#[test]
fn roots_are_those_of_real_numbers() {
    let [x, y] = ["x", "y"].map(Expr::symbol);
    assert_eq!(equal(&x.powi(2).sqrt(), &x), Some(true));
    let nested = (Expr::from(3) + Expr::from(2) * Expr::from(2).sqrt()).sqrt();
    assert_ne!(
        equal(&nested, &(Expr::from(2) + Expr::from(2).sqrt())),
        Some(true)
    );
    let difference = (&x - &y).powi(2).sqrt();
    assert_ne!(equal(&difference, &(&x - &y)), Some(true));
    let sum = (&x + &y).sqrt();
    assert_eq!(equal(&sum.powi(3), &((&x + &y) * &sum)), Some(true));
    // A root of what has no sign: negative x.
    let mut real = Domains::default();
    real.symbols.insert("x".into(), Domain::real());
    let root = x.powi(2).sqrt();
    assert!(!found(&root, &x, &real).is_some_and(|found| found.equal));
}

#[test]
fn what_is_no_quotient_of_polynomials_is_declined() {
    let x = Expr::symbol("x");
    let logarithm = Expr::call(crate::expr::Function::Ln, x.clone());
    assert_eq!(equal(&logarithm, &logarithm), None);
    // An angle that is a value as well, and a division by what is zero.
    assert_eq!(equal(&(&x * &x.sin()), &(&x.sin() * &x)), None);
    assert_eq!(equal(&(&x - &x).powi(-1), &x), None);
    // Coefficients that the prime could divide.
    let high = Expr::from(2).powi(61) * &x;
    assert_ne!(equal(&high, &x), Some(true));
    let mut one = Domains::default();
    one.symbols.insert(
        "x".into(),
        Domain::between(crate::expr::ratio(1, 1), crate::expr::ratio(1, 1)),
    );
    assert_eq!(found(&x, &x.powi(2), &one), None);
}

#[test]
fn components_of_a_unit_vector_lie_on_the_circle() {
    let [a, b] = ["a", "b"].map(Expr::symbol);
    let mut domains = Domains::default();
    domains.unit_vectors.push(["a".into(), "b".into()]);
    let sum = a.powi(2) + b.powi(2);
    assert!(found(&sum, &Expr::one(), &domains).is_some_and(|found| found.equal));
    assert_eq!(equal(&sum, &Expr::one()), Some(false));
}
