//! Verdicts on pairs of formulas: the table, and laws that hold for random pairs.

#[path = "equality/reader.rs"]
pub mod reader;

use carom::domain::Domains;
use carom::equality::{Equality, How, decide};
use carom::expr::{Expr, Function};
use proptest::prelude::*;

fn name(verdict: &Equality) -> &'static str {
    match verdict {
        Equality::Same {
            how: How::Identity { .. },
        } => "same",
        Equality::Same {
            how: How::OnBranch { .. },
        } => "branch",
        Equality::Different(_) => "different",
        Equality::Invalid { .. } => "invalid",
        Equality::Undecided { .. } => "undecided",
    }
}

#[test]
fn every_pair_of_the_table_gets_its_verdict() {
    let mut wrong = Vec::new();
    let mut rows = 0;
    for line in include_str!("equality/pairs.tsv")
        .lines()
        .filter(|l| !l.starts_with('#'))
    {
        let cells: Vec<&str> = line.split('\t').collect();
        let [left, right, domains, verdict, reason] = cells.as_slice() else {
            panic!("five cells: {line}")
        };
        let (a, b, domains) = (
            reader::formula(left),
            reader::formula(right),
            reader::domains(domains),
        );
        rows += 1;
        let both = [decide(&a, &b, &domains), decide(&b, &a, &domains)];
        if let [Equality::Different(p), Equality::Different(q)] = both.map(|d| d.equality) {
            assert_eq!((p.at, p.left, p.right), (q.at, q.right, q.left), "{line}");
        }
        for (x, y) in [(&a, &b), (&b, &a)] {
            let decision = decide(x, y, &domains);
            if name(&decision.equality) != *verdict {
                wrong.push(format!(
                    "{left} | {right}: {verdict} ({reason}), got {:?}",
                    decision.equality
                ));
                break;
            }
        }
    }
    assert!(rows >= 120, "{rows} rows");
    assert!(
        wrong.is_empty(),
        "{} of {rows} rows:\n{}",
        wrong.len(),
        wrong.join("\n")
    );
}

/// Formulas over positive masses, lengths, speeds, one real symbol and two angles.
fn formulas() -> impl Strategy<Value = Expr> {
    let leaf = prop_oneof![
        3 => prop::sample::select(vec!["m", "l", "v", "x"]).prop_map(Expr::symbol),
        1 => (1i64..6, 1i64..4).prop_map(|(n, d)| Expr::ratio(n, d)),
        2 => prop::sample::select(vec!["alpha", "beta"]).prop_map(|a| Expr::symbol(a).sin()),
        2 => prop::sample::select(vec!["alpha", "beta"]).prop_map(|a| Expr::symbol(a).cos()),
        1 => Just((Expr::symbol("m") * Expr::symbol("l")).sqrt()),
    ];
    leaf.prop_recursive(3, 12, 3, |inner| {
        prop_oneof![
            (inner.clone(), inner.clone()).prop_map(|(a, b)| a + b),
            (inner.clone(), inner.clone()).prop_map(|(a, b)| a - b),
            (inner.clone(), inner.clone()).prop_map(|(a, b)| a * b),
            (inner.clone(), inner).prop_map(|(a, b)| a / (b.powi(2) + Expr::one())),
        ]
    })
}

/// One rewrite that keeps the value, at every place where it applies.
fn rewritten(e: &Expr, rule: usize) -> Expr {
    use carom::expr::Node;
    let inner = e.map_parts(|p| rewritten(p, rule));
    match (rule, inner.node()) {
        (0, Node::Sum(terms)) => Expr::sum(terms.iter().rev().cloned()),
        (1, Node::Product(factors)) => Expr::product(factors.iter().rev().cloned()),
        (2, Node::Call(Function::Sin, x)) => {
            let half = x * &Expr::ratio(1, 2);
            Expr::from(2) * half.sin() * half.cos()
        }
        (3, Node::Call(Function::Cos, x)) => {
            let half = x * &Expr::ratio(1, 2);
            Expr::one() - Expr::from(2) * half.sin().powi(2)
        }
        (4, Node::Product(factors)) => match factors
            .iter()
            .position(|f| matches!(f.node(), Node::Sum(_)))
        {
            Some(at) => {
                let Node::Sum(terms) = factors[at].node() else {
                    unreachable!("a sum stands there")
                };
                Expr::sum(terms.iter().map(|t| {
                    Expr::product(
                        factors
                            .iter()
                            .enumerate()
                            .map(|(i, f)| if i == at { t.clone() } else { f.clone() }),
                    )
                }))
            }
            None => inner,
        },
        (5, Node::Symbol(_)) if e != &Expr::symbol("alpha") && e != &Expr::symbol("beta") => {
            e.powi(2) / e
        }
        (6, Node::Symbol(name)) if matches!(&**name, "m" | "l" | "v") => e.sqrt() * e.sqrt(),
        (7, Node::Call(Function::Sin, x)) => (Expr::pi() - x).sin(),
        _ => inner,
    }
}

/// Changes the formula at its `at`-th leaf.
fn mutated(e: &Expr, at: &mut usize, slip: usize) -> Expr {
    use carom::expr::Node;
    match e.node() {
        Node::Number(_) | Node::Symbol(_) | Node::Call(..) => {
            *at = at.wrapping_sub(1);
            if *at != usize::MAX {
                return e.clone();
            }
            match (slip, e.node()) {
                (0, Node::Call(Function::Sin, x)) => x.cos(),
                (0, Node::Call(Function::Cos, x)) => x.sin(),
                (1, _) => -e,
                (2, _) => e * &Expr::ratio(1001, 1000),
                (3, _) => e + &Expr::ratio(1, 1_000_000_007),
                _ => e * &Expr::from(2),
            }
        }
        Node::Power(base, exponent) => mutated(base, at, slip).power(exponent.clone()),
        _ => e.map_parts(|p| mutated(p, at, slip)),
    }
}

fn declared() -> Domains {
    reader::domains("x real; alpha 0pi..1/2pi; beta -1pi..1pi")
}

/// A point of the declared domain with nothing special about it.
fn generic() -> carom::expr::Point<f64> {
    let mut point = carom::expr::Point::default();
    for (name, value) in [
        ("m", 1.37),
        ("l", 0.83),
        ("v", 2.11),
        ("x", -0.71),
        ("alpha", 0.9),
        ("beta", -1.3),
    ] {
        point.values.insert(name.into(), value);
    }
    point
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn a_rewritten_formula_is_never_called_different(e in formulas(), first in 0usize..8, second in 0usize..8) {
        let other = rewritten(&rewritten(&e, first), second);
        let verdict = decide(&e, &other, &declared()).equality;
        prop_assert!(!matches!(verdict, Equality::Different(_) | Equality::Invalid { .. }), "{e:?} {other:?} {verdict:?}");
    }

    #[test]
    fn a_mutated_formula_is_refuted_by_a_point_that_floating_point_confirms(e in formulas(), mut at in 0usize..6, slip in 0usize..5) {
        let other = mutated(&e, &mut at, slip);
        match decide(&e, &other, &declared()).equality {
            Equality::Different(found) => {
                let mut point = carom::expr::Point::<f64>::default();
                for (name, coordinate) in &found.at.coordinates {
                    use carom::domain::Coordinate::{Direction, Number, Pi};
                    use carom::expr::number::to_f64;
                    let value = match coordinate {
                        Number(value) => to_f64(value),
                        Pi(value) => to_f64(value) * std::f64::consts::PI,
                        Direction { divisor, unit: [c, s], .. } => f64::from(*divisor) * to_f64(s).atan2(to_f64(c)),
                    };
                    point.values.insert(name.clone(), value);
                }
                let (a, b) = (e.evaluate(&point), other.evaluate(&point));
                let (Some(a), Some(b)) = (a, b) else { return Err(TestCaseError::fail("no value")) };
                prop_assert!(found.confirmed, "{:?} {:?}", e, other);
                // A slip in the ninth digit may change less than doubles resolve; the enclosures above still part.
                prop_assert!(slip == 3 || (a - b).abs() > 1e-13 * (1.0 + a.abs()), "{:?} {:?} {} {}", e, other, a, b);
            }
            Equality::Same { .. } => {
                // The slip may change nothing: a factor 0, a sign under a square. Then it is the same at any point.
                let (a, b) = (e.evaluate(&generic()), other.evaluate(&generic()));
                let (Some(a), Some(b)) = (a, b) else { return Err(TestCaseError::fail("no value")) };
                prop_assert!((a - b).abs() <= 1e-12 * (1.0 + a.abs()), "{e:?} {other:?} {a} {b}");
            }
            // A sign under the root.
            Equality::Invalid { .. } => prop_assert_eq!(other.evaluate(&generic()), None),
            Equality::Undecided { reason, .. } => prop_assert!(false, "undecided: {e:?} {other:?} {reason:?}"),
        }
    }
}
