//! Decisions on pairs built by hand.

use super::*;
use crate::domain::Domain;
use crate::expr::{Function, ratio};

fn s(name: &str) -> Expr {
    Expr::symbol(name)
}

fn refuted(a: &Expr, b: &Expr) -> Counterexample {
    match decide(a, b, &Domains::default()).equality {
        Equality::Different(found) => found,
        other => panic!("{other:?}"),
    }
}

#[test]
fn the_counterexample_is_the_simplest_point() {
    let omega = Expr::ratio(3, 2) * s("v") * s("theta").cos() / s("l");
    let wrong = Expr::from(2) * s("v") * s("theta").cos() / s("l");
    let found = refuted(&omega, &wrong);
    assert_eq!(
        found.at.words(),
        "l = 1, theta with cos(theta) = 3/5, v = 1"
    );
    assert_eq!(found.values(), ["9/10", "6/5"]);
    assert!(found.confirmed);
}

#[test]
fn numbers_that_agree_to_many_digits_are_told_apart() {
    let third = crate::expr::Rational::new(
        crate::expr::Int::from(333_333_333_333_333_i64),
        crate::expr::Int::from(10).pow(15),
    );
    refuted(&Expr::from(third), &Expr::ratio(1, 3));
    // √2 and √2 + 10⁻³⁰⁰
    let tiny = Expr::from(crate::expr::Rational::new(
        crate::expr::Int::from(1),
        crate::expr::Int::from(10).pow(300),
    ));
    let found = refuted(&Expr::from(2).sqrt(), &(Expr::from(2).sqrt() + tiny));
    assert_ne!(found.values()[0], found.values()[1]);
}

#[test]
fn shifted_absolute_values_part_at_a_negative_number() {
    let shifted = |k: i64| Expr::call(Function::Abs, s("x") + Expr::from(k)) - Expr::from(k);
    let mut domains = Domains::default();
    domains
        .symbols
        .insert("x".into(), Domain::between(ratio(-5000, 1), ratio(5000, 1)));
    let verdict = decide(&shifted(1000), &shifted(1001), &domains).equality;
    assert!(matches!(verdict, Equality::Different(_)), "{verdict:?}");
}

#[test]
fn high_powers_do_not_hang() {
    let base = s("x") - s("a");
    refuted(&base.powi(6000), &base.powi(5999));
    let tower = |n: i64| Expr::from(9).powi(n).powi(1_000_000);
    assert!(!matches!(
        decide(&tower(65), &tower(66), &Domains::default()).equality,
        Equality::Same { .. }
    ));
}

#[test]
fn a_zero_denominator_is_invalid_and_never_the_same() {
    let zero = s("x") - s("x");
    let bad = zero.powi(-1);
    let verdict = decide(&bad, &bad, &Domains::default()).equality;
    assert!(
        matches!(
            verdict,
            Equality::Invalid {
                side: Side::Left,
                ..
            }
        ),
        "{verdict:?}"
    );
}
