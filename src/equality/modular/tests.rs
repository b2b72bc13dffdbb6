//! Pairs that are decided at points, and pairs that are left to the proof.

use super::*;
use crate::algebra::prime;
use crate::domain::roles;

fn found(a: &Expr, b: &Expr, domains: &Domains) -> Option<AtPoints> {
    let roles = roles(&[a, b]);
    Pair::of(a, b, &domains.completed(&roles).0, &roles)?.at_points()
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

fn read(text: &str) -> Expr {
    let symbols = crate::formula::Symbols::open();
    crate::formula::read_expr(text, &symbols).expect("a formula")
}

/// Whether a pair is proved; `x` and `y` are real where that is told.
fn proved(a: &str, b: &str, real: bool) -> bool {
    proves(&read(a), &read(b), real)
}

fn proves(a: &Expr, b: &Expr, real: bool) -> bool {
    let mut domains = Domains::default();
    for name in ["x", "y"].iter().filter(|_| real) {
        domains.symbols.insert((*name).into(), Domain::real());
    }
    let roles = roles(&[a, b]);
    let domains = domains.completed(&roles).0;
    Pair::of(a, b, &domains, &roles).is_some_and(|pair| pair.proved())
}

#[test]
fn identities_of_polynomials_and_angles_are_proved() {
    for (a, b) in [
        ("(a+b)^2", "a^2 + 2*a*b + b^2"),
        ("1/a + 1/b", "(a+b)/(a*b)"),
        ("sin(2*theta)", "2*sin(theta)*cos(theta)"),
        ("cos(alpha - beta)^2", "1 - sin(alpha-beta)^2"),
        ("tan(theta)*cos(theta)", "sin(theta)"),
        ("0.5*m*v^2", "m*v^2/2"),
        ("sin(pi/2 - theta)", "cos(theta)"),
        ("v/cos(alpha-beta)^2", "v/(1 - sin(alpha-beta)^2)"),
    ] {
        assert!(proved(a, b, false), "{a} = {b}");
    }
}

#[test]
fn what_is_different_or_lacks_values_elsewhere_is_not_proved() {
    for (a, b) in [
        ("(a+b)^2", "a^2 + b^2"),
        ("sin(theta)", "cos(theta)"),
        // Equal where a is not b.
        ("(a^2-b^2)/(a-b)", "a+b"),
        ("sqrt(a+b)", "sqrt(a)+sqrt(b)"),
        ("sqrt(a^2-2*a*b+b^2)", "a-b"),
        ("a + sqrt(a-b) - sqrt(a-b)", "a"),
        ("sqrt(a-b)/sqrt(a-c)", "sqrt((a-b)/(a-c))"),
        ("sqrt(a-b)*sqrt(a-c)", "sqrt((a-b)*(a-c))"),
        ("1/(sqrt(a)-sqrt(b))", "(sqrt(a)+sqrt(b))/(a-b)"),
    ] {
        assert!(!proved(a, b, false), "{a} against {b}");
    }
}

#[test]
fn roots_taken_apart_and_nested_are_proved() {
    for (a, b) in [
        ("sqrt(2*g*h)", "sqrt(2)*sqrt(g)*sqrt(h)"),
        ("sqrt(12*a^2*b)/6", "a*sqrt(b/3)"),
        ("sqrt(g/l)", "sqrt(g*l)/l"),
        ("1/sqrt(2*a)", "sqrt(2*a)/(2*a)"),
        ("a*sqrt(1/2)", "a/sqrt(2)"),
        ("a^(3/2)", "a*sqrt(a)"),
        ("sqrt(sqrt(a))*sqrt(sqrt(a))", "sqrt(a)"),
        ("sqrt(2*g*l*(1-cos(theta)))", "2*sqrt(g*l)*sin(theta/2)"),
        ("sqrt(a^2 - a^2*cos(theta)^2)", "a*sin(theta)"),
        ("sqrt(a^2+2*a*b+b^2)", "a+b"),
        ("v*sqrt(1+3*cos(theta)^2)/2", "v*sqrt(1 - 3*sin(theta)^2/4)"),
        ("(a-b)^(3/2)", "(a-b)*sqrt(a-b)"),
        (
            "sqrt(a^2+b^2)*sqrt(a^2+b^2-c)",
            "sqrt((a^2+b^2)*(a^2+b^2-c))",
        ),
        (
            "sqrt(2*g*(a^2+b^2)^(3/2)*(1-b/sqrt(a^2+b^2))/3)",
            "sqrt(2*g*(a^2+b^2)*(sqrt(a^2+b^2)-b)/3)",
        ),
    ] {
        assert!(proved(a, b, false), "{a} = {b}");
    }
}

#[test]
fn the_root_of_a_square_keeps_its_sign_where_that_is_unknown() {
    for (a, b) in [
        ("sqrt(x^2)", "x"),
        ("sqrt(x^2*y)", "x*sqrt(y)"),
        ("sqrt(x*y)", "sqrt(x)*sqrt(y)"),
        ("sqrt(y/x)", "sqrt(x*y)/x"),
        ("sqrt(x^2+2*x*y+y^2)", "x+y"),
    ] {
        assert!(proved(a, b, false), "{a} = {b}");
        assert!(!proved(a, b, true), "{a} against {b}");
    }
    assert!(proved("sqrt(x-y)*2", "sqrt(4*x-4*y)", true));
}

/// A small formula of `x` and `y` with roots.
fn grown(draw: &mut impl FnMut(u64) -> u64, depth: u32) -> String {
    if depth == 0 {
        return ["x", "y", "2", "x", "y", "8"][draw(6) as usize].to_string();
    }
    let one = grown(draw, depth - 1);
    match draw(9) {
        0 | 1 => format!("({one})*({})", grown(draw, depth - 1)),
        2 => format!("({one})/({})", grown(draw, depth - 1)),
        3 => format!("(({one})+({}))", grown(draw, depth - 1)),
        4 => format!("(({one})-({}))", grown(draw, depth - 1)),
        5 | 6 => format!("sqrt({one})"),
        7 => format!("({one})^2"),
        _ => format!("({one})^(3/2)"),
    }
}

/// Proves what can be proved of random pairs and looks at the values at points; how many were proved.
fn compared(real: bool, points: &[[i64; 2]], count: u64) -> usize {
    use crate::expr::Scalar;
    use crate::interval::{Interval, Outcome, evaluate};
    let mut round = 0;
    let mut draw = |below: u64| {
        round += 1;
        prime::random::<PLAIN>(17, round) % below
    };
    let symbols = crate::formula::Symbols::open();
    let formulas: Vec<Expr> = (0..count)
        .map(|k| grown(&mut draw, 1 + k as u32 % 3))
        .filter_map(|text| crate::formula::read_expr(&text, &symbols).ok())
        .collect();
    let values = |e: &Expr| -> Vec<Outcome<Interval>> {
        let at = |[x, y]: &[i64; 2]| {
            let mut point = crate::expr::Point::default();
            for (name, value) in [("x", x), ("y", y)] {
                let value = Outcome::from_rational(&crate::expr::ratio(*value, 8));
                point.values.insert(name.into(), value);
            }
            evaluate(e, &point)
        };
        points.iter().map(at).collect()
    };
    let mut proofs = 0;
    for (i, a) in formulas.iter().enumerate() {
        let mine = values(a);
        // Divisors that are 0 everywhere are found at points, before a proof is asked for.
        if !mine.iter().any(|v| matches!(v, Outcome::Value(_))) {
            continue;
        }
        for b in formulas[..i].iter().filter(|b| *b != a) {
            if !proves(a, b, real) {
                continue;
            }
            proofs += 1;
            for (x, y) in mine.iter().zip(values(b)) {
                let clash = match (x, &y) {
                    (Outcome::Value(x), Outcome::Value(y)) => x.is_disjoint(y),
                    (Outcome::Value(_), Outcome::Undefined) => true,
                    (Outcome::Undefined, Outcome::Value(_)) => true,
                    _ => false,
                };
                assert!(!clash, "{a:?} and {b:?}: {x:?} and {y:?}");
            }
        }
    }
    proofs
}

#[test]
fn what_is_proved_has_the_same_values_at_the_same_points() {
    let positive = [[6, 15], [18, 3], [10, 12], [24, 23], [8, 8], [16, 8]];
    assert!(compared(false, &positive, 120) > 20);
    let anywhere = [[6, 15], [-18, 3], [10, -12], [-24, -23], [-8, 8], [0, 8]];
    assert!(compared(true, &anywhere, 120) > 5);
}
