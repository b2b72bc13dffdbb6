//! Enclosures against exact fractions, known digits and each other.

use num_traits::{Signed, Zero};
use proptest::prelude::*;

use super::dyadic::{Dyadic, Round};
use super::*;
use crate::expr::{Expr, Int, number::from_f64, ratio};

type Wide = Big<512>;

fn at<const B: u32>(e: &Expr) -> Enclosure {
    evaluate::<Big<B>>(e, &Point::default())
        .value()
        .expect("has a value")
        .0
}

#[test]
fn a_root_of_what_lies_just_above_a_square_is_rounded_up() {
    let above = Dyadic::from_int((1 << 60) + 1);
    let [low, high] = [Round::Down, Round::Up].map(|to| above.sqrt(20, to));
    assert!(low.mul(&low) < above && above < high.mul(&high));
}

#[test]
fn constants_have_their_known_digits() {
    let table = [
        (
            Expr::pi(),
            "3.1415926535897932384626433832795028841971693993751058",
        ),
        (
            Expr::call(Function::Exp, Expr::one()),
            "2.7182818284590452353602874713526624977572470936999596",
        ),
        (
            Expr::call(Function::Ln, Expr::from(2)),
            "0.69314718055994530941723212145817656807550013436025525",
        ),
        (
            Expr::call(Function::Ln, Expr::from(10)),
            "2.3025850929940456840179914546843642076011014886287730",
        ),
        (
            Expr::from(2).sqrt(),
            "1.4142135623730950488016887242096980785696718753769481",
        ),
        (
            Expr::one().sin(),
            "0.84147098480789650665250232163029899962256306079837107",
        ),
        (
            Expr::one().cos(),
            "0.54030230586813971740093660744297660373231042061792223",
        ),
        (
            Expr::call(Function::Atan, Expr::ratio(1, 2)),
            "0.46364760900080611621425623146121440202853705428612026",
        ),
        (
            Expr::call(Function::Acos, Expr::from(-1)),
            "3.1415926535897932384626433832795028841971693993751058",
        ),
        (
            Expr::call(Function::Sinh, Expr::one()),
            "1.1752011936438014568823818505956008151557179813340959",
        ),
        (
            Expr::call(Function::Tanh, Expr::one()),
            "0.76159415595576488811945828260479359041276859725793655",
        ),
    ];
    for (e, digits) in table {
        let value = at::<512>(&e);
        assert!(value.digits() > 140, "{e:?} to {} digits", value.digits());
        assert_eq!(value.decimal(53), digits, "{e:?}");
    }
}

#[test]
fn large_arguments_are_reduced_by_enough_digits_of_pi() {
    // sin(10^22), a classical test of argument reduction.
    let e = Expr::from(crate::expr::Rational::from(Int::from(10).pow(22))).sin();
    assert_eq!(at::<128>(&e).decimal(17), "-0.85220084976718880");
}

#[test]
fn a_value_without_meaning_is_undefined_and_an_unresolved_one_unknown() {
    let point = Point::default();
    let undefined = [
        Expr::from(0).powi(-1),
        Expr::from(-2).sqrt(),
        Expr::call(Function::Ln, Expr::from(-1)),
    ];
    for e in undefined {
        assert_eq!(evaluate::<Wide>(&e, &point), Outcome::Undefined, "{e:?}");
        assert_eq!(
            evaluate::<Interval>(&e, &Point::default()),
            Outcome::Undefined,
            "{e:?}"
        );
    }
    let unresolved = (Expr::from(3).sqrt() * Expr::from(3).sqrt() - Expr::from(3)).powi(-1);
    assert_eq!(evaluate::<Wide>(&unresolved, &point), Outcome::Unknown);
}

#[test]
fn huge_exponents_are_bounded() {
    let tower = Expr::from(9).powi(9_i64.pow(9));
    assert!(matches!(
        evaluate::<Wide>(&tower, &Point::default()),
        Outcome::Value(_)
    ));
    let higher = Expr::from(9).powi(9_i64.pow(18));
    assert_eq!(
        evaluate::<Wide>(&higher, &Point::default()),
        Outcome::Unknown
    );
}

#[test]
fn the_largest_doubles_are_rounded_to_their_side() {
    // e^709.65 is a double; e^709.79 is beyond all of them.
    for (numerator, low, high) in [
        (70965, 1.57e308, 1.58e308),
        (70979, f64::MAX, f64::INFINITY),
    ] {
        let e = Expr::call(Function::Exp, Expr::ratio(numerator, 100));
        let value = at::<128>(&e);
        assert!(
            value.low.to_f64(Round::Down) >= low
                && value.low.to_f64(Round::Down) <= high.min(f64::MAX)
        );
        assert!(value.high.to_f64(Round::Up) <= high && value.high.to_f64(Round::Up) >= low);
    }
}

fn fraction() -> impl Strategy<Value = crate::expr::Rational> {
    (-2000i64..2000, 1i64..400).prop_map(|(n, d)| ratio(n, d))
}

proptest! {
    #[test]
    fn intervals_contain_the_exact_value(a in fraction(), b in fraction(), c in fraction()) {
        let [x, y, z] = [&a, &b, &c].map(|v| Expr::from(v.clone()));
        let e = Expr::call(Function::Abs, &x * &y - &z) + Expr::product([x.clone(), y.powi(2), z.powi(3)]);
        let exact = (&a * &b - &c).abs() + &a * &b * &b * &c * &c * &c;
        // Built from symbols, so that nothing is folded beforehand.
        let s = Expr::symbol;
        let open = Expr::call(Function::Abs, s("a") * s("b") - s("c")) + s("a") * s("b").powi(2) * s("c").powi(3);
        prop_assert_eq!(open.evaluate(&numbers::<crate::expr::Rational>(&a, &b, &c)), Some(exact.clone()));
        let double = evaluate::<Interval>(&open, &numbers(&a, &b, &c)).value().expect("total");
        prop_assert!(from_f64(double.low).expect("finite") <= exact && exact <= from_f64(double.high).expect("finite"));
        let wide = evaluate::<Big<64>>(&open, &numbers(&a, &b, &c)).value().expect("total");
        prop_assert!(wide.0.contains(&exact));
        prop_assert!(at::<64>(&e).contains(&exact));
    }

    #[test]
    fn coarse_enclosures_of_functions_contain_the_fine_ones(a in fraction(), scale in -20i64..20) {
        let a = if scale < 0 { a / Int::from(2).pow(scale.unsigned_abs() as u32) } else { a * Int::from(2).pow(scale as u32) };
        let mut at_a = [Point::default(), Point::default()];
        let symbol: crate::expr::Symbol = "a".into();
        at_a[0].values.insert(symbol.clone(), Outcome::<Big<64>>::from_rational(&a));
        let mut fine = Point::default();
        fine.values.insert(symbol.clone(), Outcome::<Wide>::from_rational(&a));
        let mut double = Point::default();
        double.values.insert(symbol, Outcome::<Interval>::from_rational(&a));
        for function in Function::ALL {
            let e = Expr::call(function, Expr::symbol("a"));
            let coarse = evaluate(&e, &at_a[0]);
            let fine = evaluate(&e, &fine);
            if let (Outcome::Value(coarse), Outcome::Value(fine)) = (&coarse, &fine) {
                prop_assert!(coarse.0.low <= fine.0.low && fine.0.high <= coarse.0.high, "{:?} {:?} {:?}", e, coarse, fine);
                if let Outcome::Value(double) = evaluate(&e, &double) {
                    let low = Dyadic::from_f64(double.low);
                    let high = Dyadic::from_f64(double.high);
                    prop_assert!(low.is_none_or(|l| l <= fine.0.low) && high.is_none_or(|h| fine.0.high <= h), "{function:?} {double:?} {fine:?}");
                }
            } else {
                prop_assert!(!matches!((&coarse, &fine), (Outcome::Undefined, Outcome::Value(_)) | (Outcome::Value(_), Outcome::Undefined)));
            }
        }
    }

    #[test]
    fn functions_of_a_narrow_interval_reach_from_end_to_end(a in fraction(), narrow in 42i64..60) {
        prop_assume!(!a.is_zero());
        let low = Dyadic::from_rational(&a, 53, Round::Down);
        let width = Dyadic::new(1, low.top() - narrow);
        let x = Enclosure::new(low.clone(), low.add(&width, 120, Round::Up));
        for function in [Function::Exp, Function::Ln, Function::Atan] {
            let value = |x: &Enclosure, bits| series::call(x, function, bits).value();
            let Some(whole) = value(&x, 80) else { continue };
            for end in [&x.low, &x.high] {
                let fine = value(&Enclosure::point(end.clone()), 400).expect("a value as well");
                prop_assert!(whole.low <= fine.low && fine.high <= whole.high, "{function:?} of {x:?}");
            }
        }
    }

    #[test]
    fn the_library_functions_lie_near_the_enclosures(a in -50.0f64..50.0) {
        let e = Expr::from(from_f64(a).expect("finite"));
        for (function, expected) in [(Function::Sin, a.sin()), (Function::Cos, a.cos()), (Function::Atan, a.atan()), (Function::Exp, a.exp()), (Function::Tanh, a.tanh())] {
            let value = at::<128>(&Expr::call(function, e.clone()));
            let near = value.low.to_f64(Round::Down);
            prop_assert!((near - expected).abs() <= 4.0 * f64::EPSILON * expected.abs() + 1e-300, "{function:?} {a} {near} {expected}");
        }
    }

    #[test]
    fn rounding_keeps_its_side(m in any::<i128>(), e in -40i64..40, n in any::<i64>()) {
        let x = Dyadic { mantissa: m.into(), exponent: e };
        prop_assert!(x.clone().round(20, Round::Down) <= x && x <= x.clone().round(20, Round::Up));
        let y = Dyadic { mantissa: n.into(), exponent: -e };
        let exact = x.to_rational() + y.to_rational();
        prop_assert!(x.add(&y, 30, Round::Down).to_rational() <= exact && exact <= x.add(&y, 30, Round::Up).to_rational());
        let (low, high) = (x.to_f64(Round::Down), x.to_f64(Round::Up));
        prop_assert!(from_f64(low).expect("finite") <= x.to_rational() && x.to_rational() <= from_f64(high).expect("finite"));
    }
}

fn numbers<T: Scalar>(
    a: &crate::expr::Rational,
    b: &crate::expr::Rational,
    c: &crate::expr::Rational,
) -> Point<T> {
    let mut point = Point::default();
    for (name, value) in [("a", a), ("b", b), ("c", c)] {
        point.values.insert(name.into(), T::from_rational(value));
    }
    point
}

#[test]
fn sums_and_products_of_short_numbers_are_exact_in_doubles() {
    let value = |n: i64, d: i64| Interval::from_rational(&ratio(n, d));
    let point = |x: f64| Outcome::Value(Interval { low: x, high: x });
    assert_eq!(value(5, 2).plus(&value(-3, 2)), point(1.0));
    assert_eq!(value(-1, 1).times(&value(3, 2)), point(-1.5));
    assert_eq!(value(0, 1).sqrt(), point(0.0));
    // One digit more than a double has.
    let long = value((1 << 53) - 1, 1);
    for sum in [long.plus(&value(1, 2)), long.times(&value(3, 1))] {
        assert!(
            matches!(sum, Outcome::Value(v) if v.low < v.high),
            "{sum:?}"
        );
    }
    let tiny = Interval {
        low: 1e-200,
        high: 1e-200,
    };
    let Outcome::Value(square) = tiny.times(&tiny) else {
        panic!("a product has a value")
    };
    assert!(square.low == 0.0 && square.high > 0.0, "{square:?}");
}

#[test]
fn the_ends_of_a_product_are_among_the_products_of_the_ends() {
    let ends = [-3.0, -1.0, 0.0, 2.0, 5.0];
    let all = ends.iter().flat_map(|a| ends.iter().map(|b| (*a, *b)));
    let all: Vec<(f64, f64)> = all.filter(|(a, b)| a <= b).collect();
    for (a, b) in &all {
        for (c, d) in &all {
            let products = [a * c, a * d, b * c, b * d];
            let low = products.iter().copied().fold(f64::INFINITY, f64::min);
            let high = products.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let [x, y] = [(a, b), (c, d)].map(|(low, high)| Interval {
                low: *low,
                high: *high,
            });
            let found = x.times(&y);
            assert_eq!(found, Outcome::Value(Interval { low, high }), "{x:?} {y:?}");
        }
    }
}
