//! Laws that hold for every input: normal forms against exact evaluation, divisors, written forms, linear systems.

use std::collections::BTreeMap;

use num_traits::{One, Zero};
use proptest::prelude::*;

use crate::algebra::factor::factor;
use crate::algebra::fuel::Fuel;
use crate::algebra::gcd::gcd;
use crate::algebra::mono::{exponent, mono_variables};
use crate::algebra::poly::Poly;
use crate::algebra::{Element, Field, Row, Stop, determinant, solve};
use crate::domain::Domains;
use crate::expr::{Expr, Int, Point, Rational, ratio};

/// Expressions in a, b, c and the angle t: sums, products, quotients, small powers, sines and cosines.
fn expression() -> impl Strategy<Value = Expr> {
    let leaf = prop_oneof![
        (-4i64..=4, 1i64..=3).prop_map(|(p, q)| Expr::ratio(p, q)),
        prop::sample::select(vec!["a", "b", "c"]).prop_map(Expr::symbol),
        (1i64..=3).prop_map(|k| (Expr::from(k) * Expr::symbol("t")).cos()),
        (1i64..=3).prop_map(|k| (Expr::from(k) * Expr::symbol("t")).sin()),
    ];
    leaf.prop_recursive(4, 24, 3, |inner| {
        prop_oneof![
            prop::collection::vec(inner.clone(), 2..4).prop_map(Expr::sum),
            prop::collection::vec(inner.clone(), 2..4).prop_map(Expr::product),
            (inner.clone(), inner.clone()).prop_map(|(x, y)| x / y),
            (inner.clone(), 2i64..=3).prop_map(|(x, k)| x.powi(k)),
            inner.prop_map(|x| -x),
        ]
    })
}

/// A rational point with t on the circle.
fn point() -> impl Strategy<Value = Point<Rational>> {
    (1i64..20, 1i64..20, 1i64..20, 1i64..7, 2i64..9).prop_map(|(a, b, c, p, q)| {
        let mut at = Point::default();
        for (name, value) in [("a", a), ("b", b), ("c", c)] {
            at.values.insert(name.into(), ratio(value, q));
        }
        let (p, q) = (p, p + q);
        let r = q * q + p * p;
        at.directions.insert(
            "t".into(),
            (1, [ratio(q * q - p * p, r), ratio(2 * p * q, r)]),
        );
        at
    })
}

fn field_of(exprs: &[&Expr]) -> Field {
    let mut field = Field::new(&Domains::default());
    field.prepare(exprs.iter().copied());
    field
}

/// A polynomial in three variables.
fn polynomial() -> impl Strategy<Value = Poly> {
    prop::collection::vec((-5i64..=5, 0u32..3, 0u32..3, 0u32..3), 1..5).prop_map(|terms| {
        let mut total = Poly::zero();
        for (c, i, j, k) in terms {
            let mut term = Poly::constant(Int::from(c));
            // Variables 0, 3 and 9: the last one lies in the second word.
            for (v, e) in [(0, i), (3, j), (9, k)] {
                for _ in 0..e {
                    term = term.mul(&Poly::var(v)).expect("small");
                }
            }
            total = total.add(&term);
        }
        total
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn a_determinant_is_that_of_the_transposed_and_turns_its_sign_with_two_rows(
        entries in prop::collection::vec(-3i64..=3, 16), factor in 1i64..=3
    ) {
        let field = field_of(&[]);
        let of = |entry: &dyn Fn(usize, usize) -> i64| {
            let row = |i: usize| (0..4).map(|j| field.integer(entry(i, j))).collect();
            determinant(&field, &(0..4).map(row).collect::<Vec<Vec<_>>>())
                .map(|d| field.expr(&d))
        };
        let there = of(&|i, j| entries[4 * i + j]);
        prop_assert_eq!(&of(&|i, j| entries[4 * j + i]), &there);
        let turned = of(&|i, j| entries[4 * [1, 0, 2, 3][i] + j]);
        prop_assert_eq!(turned.map(|d| -d), there.clone());
        // A multiple of one row added to another changes nothing.
        let sheared = of(&|i, j| entries[4 * i + j] + if i == 2 { factor * entries[j] } else { 0 });
        prop_assert_eq!(sheared, there);
        // Below the diagonal nothing: the product of the diagonal.
        let diagonal: i64 = (0..4).map(|i| entries[5 * i]).product();
        let triangle = of(&|i, j| if j < i { 0 } else { entries[4 * i + j] });
        prop_assert_eq!(triangle, Ok(Expr::from(diagonal)));
    }

    #[test]
    fn the_written_normal_form_has_the_value_of_the_original(e in expression(), at in point()) {
        let mut field = field_of(&[&e]);
        let x = match field.element(&e) {
            Ok(x) => x,
            Err(Stop::DivisionByZero) => { prop_assert!(e.evaluate(&at).is_none()); return Ok(()); }
            Err(stop) => { prop_assert!(matches!(stop, Stop::TooLarge(_))); return Ok(()); }
        };
        let written = field.expr(&x);
        if let Some(value) = e.evaluate(&at) {
            prop_assert_eq!(written.evaluate(&at), Some(value), "{:?} written {:?}", e, written);
        }
        let again = field.element(&written).expect("no larger than before");
        prop_assert!(field.equal(&again, &x));
    }

    #[test]
    fn zero_is_decided_as_evaluation_says(e in expression(), f in expression(), at in point()) {
        let difference = &e - &f;
        let mut field = field_of(&[&difference]);
        let Ok(x) = field.element(&difference) else { return Ok(()) };
        if field.is_zero(&x) {
            prop_assert!(difference.evaluate(&at).is_none_or(|v| v.is_zero()));
        }
        let twin = (&e + &f) * (&e - &f) - e.powi(2) + f.powi(2);
        if let Ok(x) = field.element(&twin) {
            prop_assert!(field.is_zero(&x));
        }
    }

    #[test]
    fn a_proved_sign_is_the_sign_of_every_value(e in expression(), at in point()) {
        let mut field = field_of(&[&e]);
        let Ok(x) = field.element(&e) else { return Ok(()) };
        if let (Some(sign), Some(value)) = (field.sign(&x), e.evaluate(&at)) {
            use crate::algebra::Sign::*;
            let zero = Rational::zero();
            prop_assert!(match sign {
                Positive => value > zero,
                NotNegative => value >= zero,
                Zero => value == zero,
                NotPositive => value <= zero,
                Negative => value < zero,
            }, "{:?} is said to be {:?}", e, sign);
        }
    }

    #[test]
    fn a_common_factor_is_found(a in polynomial(), b in polynomial(), g in polynomial()) {
        prop_assume!(!a.is_zero() && !b.is_zero() && !g.is_zero());
        let (x, y) = (a.mul(&g).expect("small"), b.mul(&g).expect("small"));
        let d = gcd(&x, &y, &Fuel::new()).expect("within limits");
        prop_assert!(d.try_div(&g).is_some(), "{:?} must divide {:?}", g, d);
        let (p, q) = (x.try_div(&d).expect("divides"), y.try_div(&d).expect("divides"));
        prop_assert!(gcd(&p, &q, &Fuel::new()).expect("within limits").is_one());
    }

    #[test]
    fn factors_multiply_to_the_whole(a in polynomial(), b in polynomial()) {
        let p = a.mul(&b).and_then(|p| p.mul(&b)).expect("small");
        prop_assume!(!p.is_zero());
        let parts = factor(&p, &Fuel::new());
        let mut whole = Poly::constant(parts.content.clone());
        for (f, k) in &parts.factors {
            whole = whole.mul(&f.pow(*k).expect("small")).expect("small");
        }
        prop_assert_eq!(whole, p);
        for (i, (f, _)) in parts.factors.iter().enumerate() {
            for (g, _) in &parts.factors[..i] {
                prop_assert!(gcd(f, g, &Fuel::new()).expect("within limits").is_one(), "{:?} and {:?} have a factor in common", f, g);
            }
        }
    }

    #[test]
    fn the_root_of_a_square_is_found(a in polynomial()) {
        let root = a.mul(&a).expect("small").sqrt().expect("a square");
        prop_assert!(root == a || root == a.neg());
    }

    #[test]
    fn division_undoes_multiplication(a in polynomial(), b in polynomial()) {
        prop_assume!(!b.is_zero());
        prop_assert_eq!(a.mul(&b).expect("small").try_div(&b), Some(a));
    }

    #[test]
    fn splitting_by_powers_and_joining_is_nothing(a in polynomial()) {
        for v in [0, 3, 9, 20] {
            let parts = a.by_power(v);
            prop_assert!(parts.iter().all(|p| !p.has(v)));
            prop_assert_eq!(Poly::from_powers(&parts, v).expect("small"), a.clone());
            prop_assert_eq!(mono_variables(&a.degrees()).contains(&v), a.has(v));
            prop_assert_eq!(exponent(&a.degrees(), v), a.degree(v));
        }
    }

    #[test]
    fn a_solution_fulfils_every_row(entries in prop::collection::vec((0usize..4, 0usize..4, expression()), 4..10), right in prop::collection::vec(expression(), 4)) {
        let all: Vec<&Expr> = entries.iter().map(|(_, _, e)| e).chain(&right).collect();
        let mut field = field_of(&all);
        let mut matrix: BTreeMap<(usize, usize), Element> = BTreeMap::new();
        for (i, j, e) in &entries {
            let Ok(x) = field.element(e) else { return Ok(()) };
            matrix.insert((*i, *j), x);
        }
        let mut rows = Vec::new();
        for (i, e) in right.iter().enumerate() {
            let Ok(rhs) = field.element(e) else { return Ok(()) };
            let coeffs = matrix.iter().filter(|((r, _), _)| *r == i).map(|((_, j), x)| (*j, x.clone())).collect();
            rows.push(Row { coeffs, rhs });
        }
        let Ok(solution) = solve(&field, &rows, 4) else { return Ok(()) };
        prop_assert_eq!(solution.rank + solution.free.len(), 4);
        if solution.contradiction.is_none() && solution.values.iter().all(Option::is_some) {
            for row in &rows {
                let mut total = field.neg(&row.rhs);
                for (j, c) in &row.coeffs {
                    let x = solution.values[*j].as_ref().expect("all there");
                    let (Ok(p), true) = (field.mul(c, x), true) else { return Ok(()) };
                    let Ok(sum) = field.add(&total, &p) else { return Ok(()) };
                    total = sum;
                }
                prop_assert!(field.is_zero(&total));
            }
        }
    }
}

#[test]
fn one_is_the_neutral_element() {
    let mut field = Field::new(&Domains::default());
    let x = field.element(&Expr::symbol("x")).expect("a symbol");
    let one = field.number(&Rational::one());
    assert!(field.equal(&field.mul(&x, &one).expect("small"), &x));
}
