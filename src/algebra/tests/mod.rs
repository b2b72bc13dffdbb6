//! Tables of facts about the algebra.

mod laws;

use super::*;
use crate::domain::{Domain, Domains, Limit};
use crate::expr::{Expr, Function, ratio};

fn s(name: &str) -> Expr {
    Expr::symbol(name)
}

fn call(function: Function, x: Expr) -> Expr {
    Expr::call(function, x)
}

fn n(value: i64) -> Expr {
    Expr::from(value)
}

fn angle_domain(name: &str, low: (i64, i64), high: (i64, i64)) -> Domains {
    let end = |(p, q): (i64, i64)| {
        Some(Limit {
            value: ratio(p, q),
            of_pi: true,
            open: true,
        })
    };
    let mut domains = Domains::default();
    domains.symbols.insert(
        name.into(),
        Domain {
            low: end(low),
            high: end(high),
        },
    );
    domains
}

fn is_zero_on(domains: &Domains, e: &Expr) -> bool {
    let mut field = Field::new(domains);
    field.prepare([e]);
    let x = field.element(e).expect("within limits");
    field.is_zero(&x)
}

fn is_zero(e: &Expr) -> bool {
    is_zero_on(&Domains::default(), e)
}

/// Identities on the default domain: symbols positive, angles in the first quadrant.
fn identities() -> Vec<(&'static str, Expr, Expr)> {
    let (a, b, t, u) = (s("a"), s("b"), s("theta"), s("phi"));
    let half = |e: &Expr| e * &Expr::ratio(1, 2);
    let r = (a.powi(2) + b.powi(2)).sqrt();
    let pi = Expr::pi();
    vec![
        ("Pythagoras", t.sin().powi(2) + t.cos().powi(2), n(1)),
        ("tangent", t.tan().powi(2) + n(1), t.cos().powi(-2)),
        ("root of a product", (&a * &b).sqrt(), a.sqrt() * b.sqrt()),
        ("root of a quotient", (&a / &b).sqrt(), a.sqrt() / b.sqrt()),
        ("root of 1/a", a.powi(-1).sqrt(), a.sqrt().powi(-1)),
        ("root of 12", n(12).sqrt(), n(2) * n(3).sqrt()),
        (
            "nested numbers",
            (n(11) + n(6) * n(2).sqrt()).sqrt(),
            n(3) + n(2).sqrt(),
        ),
        (
            "nested numbers with two roots",
            (n(5) + n(2) * n(6).sqrt()).sqrt(),
            n(2).sqrt() + n(3).sqrt(),
        ),
        (
            "three halves",
            (a.powi(2) + b.powi(2)).power(Expr::ratio(3, 2)),
            (a.powi(2) + b.powi(2)) * &r,
        ),
        (
            "product of nested roots",
            (&r - &b).sqrt() * (&r + &b).sqrt(),
            a.clone(),
        ),
        (
            "square under a root",
            (a.powi(2) + n(2) * &a * &b + b.powi(2)).sqrt(),
            &a + &b,
        ),
        ("sine as a root", (n(1) - t.cos().powi(2)).sqrt(), t.sin()),
        (
            "sine as a product of roots",
            (n(1) - t.cos()).sqrt() * (n(1) + t.cos()).sqrt(),
            t.sin(),
        ),
        (
            "half cosine",
            ((n(1) + t.cos()) / n(2)).sqrt(),
            half(&t).cos(),
        ),
        (
            "half sine",
            ((n(1) - t.cos()) / n(2)).sqrt(),
            half(&t).sin(),
        ),
        ("half tangent", half(&t).tan(), t.sin() / (n(1) + t.cos())),
        (
            "triple angle",
            (n(3) * &t).cos(),
            n(4) * t.cos().powi(3) - n(3) * t.cos(),
        ),
        (
            "product to sum",
            n(2) * t.sin() * u.cos(),
            (&t + &u).sin() + (&t - &u).sin(),
        ),
        (
            "two angles",
            (&t - &u).cos(),
            t.cos() * u.cos() + t.sin() * u.sin(),
        ),
        ("shifted", (&t + &half(&pi)).sin(), t.cos()),
        (
            "sin 15°",
            (&pi * &Expr::ratio(1, 12)).sin(),
            (n(6).sqrt() - n(2).sqrt()) / n(4),
        ),
        (
            "cos 36°",
            (&pi * &Expr::ratio(1, 5)).cos(),
            (n(1) + n(5).sqrt()) / n(4),
        ),
        (
            "cos 22.5°",
            (&pi * &Expr::ratio(1, 8)).cos(),
            (n(2) + n(2).sqrt()).sqrt() / n(2),
        ),
        (
            "sin 22.5°",
            (&pi * &Expr::ratio(1, 8)).sin(),
            (n(2) - n(2).sqrt()).sqrt() / n(2),
        ),
        (
            "sin 7.5° doubled",
            n(2) * (&pi * &Expr::ratio(1, 24)).sin() * (&pi * &Expr::ratio(1, 24)).cos(),
            (&pi * &Expr::ratio(1, 12)).sin(),
        ),
        (
            "cube root",
            (&a * &b).power(Expr::ratio(1, 3)),
            a.power(Expr::ratio(1, 3)) * b.power(Expr::ratio(1, 3)),
        ),
        ("cube root of 8", n(8).power(Expr::ratio(1, 3)), n(2)),
        ("fourth root", a.power(Expr::ratio(1, 4)).powi(2), a.sqrt()),
        (
            "even function",
            (&a - &b).powi(2).sqrt(),
            (&b - &a).powi(2).sqrt(),
        ),
        (
            "argument ωt",
            (n(2) * &a * &b).sin(),
            n(2) * (&a * &b).sin() * (&b * &a).cos(),
        ),
        (
            "opaque congruence",
            Expr::call(crate::expr::Function::Ln, &a + &b),
            Expr::call(crate::expr::Function::Ln, &b + &a),
        ),
        (
            "sine of an arc tangent",
            call(Function::Atan, &a / &b).sin(),
            &a / &r,
        ),
        (
            "sine of a sum with an arc tangent",
            (&t + &call(Function::Atan, &a / &b)).cos(),
            (&b * &t.cos() - &a * &t.sin()) / &r,
        ),
        (
            "arc sine of a half",
            call(Function::Asin, Expr::ratio(1, 2)),
            &pi * &Expr::ratio(1, 6),
        ),
        (
            "arc tangent of one",
            call(Function::Atan, n(-1)),
            &pi * &Expr::ratio(-1, 4),
        ),
        (
            "sum in an exponent",
            call(Function::Exp, &a - &b),
            call(Function::Exp, a.clone()) / call(Function::Exp, b.clone()),
        ),
        (
            "half in an exponent",
            call(Function::Exp, half(&a)).powi(2),
            call(Function::Exp, a.clone()),
        ),
        (
            "logarithm of a product",
            call(Function::Ln, a.powi(2) / &b),
            n(2) * call(Function::Ln, a.clone()) - call(Function::Ln, b.clone()),
        ),
        (
            "logarithm of a root",
            call(Function::Ln, a.sqrt()),
            half(&call(Function::Ln, a.clone())),
        ),
        (
            "angle of products and symbols",
            (&a * &b + &t).sin(),
            (&a * &b).sin() * t.cos() + (&a * &b).cos() * t.sin(),
        ),
        ("pi is a number", &pi * &a - &a * &pi, n(0)),
        (
            "a rational function",
            (a.powi(2) - b.powi(2)) / (&a - &b),
            &a + &b,
        ),
    ]
}

#[test]
fn identities_are_proved() {
    for (name, left, right) in identities() {
        assert!(is_zero(&(&left - &right)), "{name}: {left:?} = {right:?}");
    }
}

/// Pairs that look alike and differ somewhere on the default domain.
#[test]
fn near_misses_are_not_zero() {
    let (a, b, t, u) = (s("a"), s("b"), s("theta"), s("phi"));
    let pi = Expr::pi();
    for (name, left, right) in [
        (
            "root of a square of a difference",
            (&a - &b).powi(2).sqrt(),
            &a - &b,
        ),
        (
            "sum under the root",
            (a.powi(2) + b.powi(2)).sqrt(),
            &a + &b,
        ),
        (
            "cos of a half",
            (&t * &Expr::ratio(1, 2)).cos(),
            ((n(1) - t.cos()) / n(2)).sqrt(),
        ),
        (
            "two angles, wrong sign",
            (&t - &u).cos(),
            t.cos() * u.cos() - t.sin() * u.sin(),
        ),
        ("pi as 22/7", pi.clone(), Expr::ratio(22, 7)),
        (
            "near numbers",
            n(2).sqrt(),
            Expr::ratio(1_414_213_562, 1_000_000_000),
        ),
        (
            "|x+1000| − 1000",
            Expr::call(crate::expr::Function::Abs, &a - &n(1000)),
            Expr::call(crate::expr::Function::Abs, &a - &n(1001)) + n(1),
        ),
        (
            "a third",
            Expr::ratio(333_333_333_333, 1_000_000_000_000) * &a,
            &a / &n(3),
        ),
    ] {
        assert!(!is_zero(&(&left - &right)), "{name}: {left:?} ≠ {right:?}");
    }
}

#[test]
fn a_cosine_lies_between_minus_one_and_one_whatever_the_angle() {
    let cos = s("phi").cos();
    for (e, sign) in [
        (n(1) - &cos, Some(Sign::NotNegative)),
        (n(2) - cos.powi(2), Some(Sign::Positive)),
        (s("m") * (&cos - n(1)), Some(Sign::NotPositive)),
        (n(2) + &cos, Some(Sign::Positive)),
        (n(1) - n(2) * &cos, None),
    ] {
        let mut field = Field::new(&angle_domain("phi", (0, 1), (4, 1)));
        field.prepare([&e]);
        let x = field.element(&e).expect("within limits");
        assert_eq!(field.sign(&x), sign, "{e:?}");
    }
}

#[test]
fn what_only_adds_to_a_root_is_left_out_of_its_sign() {
    let (a, b, c) = (s("a"), s("b"), s("c"));
    let diagonal = (a.powi(2) + b.powi(2)).sqrt();
    let root = (n(1) + s("phi").cos().powi(2)).sqrt();
    for (e, sign) in [
        (
            n(4) * &diagonal + n(3) * &c - n(4) * &b,
            Some(Sign::Positive),
        ),
        (&b - n(2) * &c - &diagonal, Some(Sign::Negative)),
        (&diagonal + &c - n(2) * &b, None),
        // Where c is huge the sum is positive, at no point that is tried.
        (&root + &c - n(10).powi(30), None),
    ] {
        let mut field = Field::new(&angle_domain("phi", (0, 1), (4, 1)));
        field.prepare([&e]);
        let x = field.element(&e).expect("within limits");
        assert_eq!(field.sign(&x), sign, "{e:?}");
    }
}

#[test]
fn a_factor_with_a_root_is_divided_out() {
    let (a, b) = (s("a"), s("b"));
    let root = (a.powi(2) + b.powi(2)).sqrt();
    let factor = &b + n(2) * &root;
    for other in [&a - &root, n(3) * &a + &b * &root] {
        for k in [1, 2] {
            let mut field = Field::new(&Domains::default());
            let e = (&other * factor.powi(k) * &b) / (factor.powi(k) * &a);
            let short = &other * &b / &a;
            field.prepare([&e, &short]);
            let [x, y] = [&e, &short].map(|e| field.element(e).expect("within limits"));
            // Multiplied out, what cancels is no longer seen.
            let stored = field.stored(&x);
            let again = field.element(&stored).expect("within limits");
            assert_eq!(field.expr(&again), field.expr(&y), "{stored:?}");
        }
    }
}

#[test]
fn the_domain_fixes_the_sign_of_a_root() {
    let phi = s("phi");
    let half = &phi * &Expr::ratio(1, 2);
    let root = ((n(1) + phi.cos()) / n(2)).sqrt();
    let sum = &root + &half.cos();
    let difference = &root - &half.cos();
    assert!(is_zero_on(
        &angle_domain("phi", (0, 1), (1, 1)),
        &difference
    ));
    assert!(is_zero_on(&angle_domain("phi", (1, 1), (2, 1)), &sum));
    let both = angle_domain("phi", (0, 1), (2, 1));
    assert!(!is_zero_on(&both, &sum) && !is_zero_on(&both, &difference));
}

#[test]
fn writing_and_reading_gives_the_same_element() {
    for (name, left, right) in identities() {
        let mut field = Field::new(&Domains::default());
        field.prepare([&left, &right]);
        for e in [left, right] {
            let x = field.element(&e).expect("within limits");
            let written = field.expr(&x);
            let again = field.element(&written).expect("within limits");
            assert!(
                field.equal(&x, &again),
                "{name}: {e:?} was written {written:?}"
            );
        }
    }
}

#[test]
fn what_would_be_written_as_thousands_of_products_stays_as_it_stands() {
    let inner = call(Function::Cos, n(2) + s("x"));
    let e = call(Function::Cos, call(Function::Sin, inner));
    assert_eq!(tidy(&e, &Domains::default()), Ok(e));
}

#[test]
fn results_are_written_as_a_person_would() {
    let (v, t, u, l, m, e) = (s("v"), s("theta"), s("phi"), s("l"), s("m"), s("e"));
    let (m1, m2, v1, v2) = (s("m1"), s("m2"), s("v1"), s("v2"));
    let energy = &m * &v.powi(2) / n(4);
    for (from, expected) in [
        (&v * &(n(1) - t.cos().powi(2)), "(* v (^ (sin theta) 2))"),
        (
            n(3) * &v * t.cos() / (n(2) * &l),
            "(* 3/2 (^ l -1) v (cos theta))",
        ),
        (
            &energy - &e.powi(2) * &energy * t.cos().powi(2) - &energy * &t.sin().powi(2),
            "(* 1/4 m (^ v 2) (^ (cos theta) 2) (+ 1 (* -1 (^ e 2))))",
        ),
        (
            &m1 + &(&m2 * &t.sin().powi(2)),
            "(+ m1 (* m2 (^ (sin theta) 2)))",
        ),
        (
            (&m1 + &m2) * t.cos().powi(2) + &m1 * &t.sin().powi(2),
            "(+ m1 (* m2 (^ (cos theta) 2)))",
        ),
        (&v - &(&v * &e), "(* v (+ 1 (* -1 e)))"),
        // Of an angle that is met three times over only, nothing else is written.
        (
            &l - &(&l * &(n(3) * &t).cos()),
            "(* l (+ 1 (* -1 (cos (* 3 theta)))))",
        ),
        (
            &l * &(n(3) * &v * &e / n(4)).sin(),
            "(* l (sin (* 3/4 e v)))",
        ),
        (&e - &n(1), "(+ e -1)"),
        (t.sin() / (n(1) - t.cos().powi(2)), "(^ (sin theta) -1)"),
        (
            (t.sin().powi(2) - &e.powi(2) * &t.cos().powi(2)) / (t.sin() + &e * &t.cos()).powi(3),
            "(* (+ (sin theta) (* -1 e (cos theta))) (^ (+ (sin theta) (* e (cos theta))) -2))",
        ),
        (
            t.cos() * u.cos() + t.sin() * u.sin(),
            "(cos (+ phi (* -1 theta)))",
        ),
        (
            &m1 + &(&m2
                * &(t.cos().powi(2) + u.cos().powi(2)
                    - n(2) * t.cos() * u.cos() * (&t - &u).cos())),
            "(+ m1 (* m2 (^ (sin (+ phi (* -1 theta))) 2)))",
        ),
        (&l / &n(2).sqrt(), "(* 1/2 (^ 2 1/2) l)"),
        ((n(2) * &l * &v).sqrt(), "(^ (* 2 l v) 1/2)"),
        (m.sqrt() / v.sqrt(), "(^ (* m (^ v -1)) 1/2)"),
        (
            (&m1 * &v1 + &m2 * &v2 + &e * &m2 * &v2 - &e * &m2 * &v1) / (&m1 + &m2),
            "(* (^ (+ m1 m2) -1) (+ (* m1 v1) (* m2 v2) (* m2 e (+ v2 (* -1 v1)))))",
        ),
        (
            (&v1.powi(2) - &v2.powi(2)) / (&v1 - &v2).powi(2),
            "(* (+ v1 v2) (^ (+ v1 (* -1 v2)) -1))",
        ),
        (
            (&v1 + &v2).powi(40) / (&v1 + &v2).powi(38),
            "(^ (+ v1 v2) 2)",
        ),
        (s("H") * s("g") * s("d") * s("mu") * &m, "(* mu m g H d)"),
        (
            &m1 + &m2 * &((&l + &v).powi(2) + u.powi(2)),
            "(+ m1 (* m2 (+ (^ (+ l v) 2) (^ phi 2))))",
        ),
        (
            &v1 - (n(1) + &e) * (&v1 + &v2) * (&m1 + &m2 * &u) / (&m * &u + &m1 * &l.powi(2) + &m2),
            "(+ v1 (* -1 (+ 1 e) (+ m1 (* m2 phi)) (^ (+ m2 (* m phi) (* m1 (^ l 2))) -1) (+ v1 v2)))",
        ),
        (
            &v1.powi(2) - &m * &l * (n(1) - t.cos()),
            "(+ (^ v1 2) (* -1 m l (+ 1 (* -1 (cos theta)))))",
        ),
        (
            (&v * &m1 + &u * &m1 + &v * &m2 + &u * &m2 + &m * &l * &e) / (n(2) * &m1 + &m2),
            "(* (^ (+ (* 2 m1) m2) -1) (+ (* (+ m1 m2) (+ phi v)) (* m e l)))",
        ),
        (
            (&m.powi(2) * &l * (n(1) + &e).powi(2) * (n(1) - t.cos())
                - n(2) * &v1 * &(&m2 + &m).powi(2))
                .sqrt(),
            "(^ (+ (* (^ m 2) l (^ (+ 1 e) 2) (+ 1 (* -1 (cos theta)))) (* -2 v1 (^ (+ m m2) 2))) 1/2)",
        ),
        (e.power(s("n")).powi(2) * &l, "(* l (^ e (* 2 n)))"),
        (
            (&t * Expr::ratio(37, 216)).cos() * &l,
            "(* l (cos (* 37/216 theta)))",
        ),
    ] {
        let mut field = Field::new(&Domains::default());
        field.prepare([&from]);
        let x = field.element(&from).expect("within limits");
        assert_eq!(format!("{:?}", field.expr(&x)), expected, "from {from:?}");
    }
}

#[test]
fn huge_powers_stop_early() {
    let mut field = Field::new(&Domains::default());
    for e in [
        (s("x") + s("a") + s("b") + s("c")).powi(120),
        s("x").powi(100) * s("x").powi(100),
    ] {
        assert!(matches!(field.element(&e), Err(Stop::TooLarge(_))), "{e:?}");
    }
    // A power of a symbol alone is kept as it is.
    let x = field.element(&s("x").powi(200)).expect("a power");
    assert_eq!(field.expr(&x), s("x").powi(200));
}

#[test]
fn a_small_system_is_solved() {
    let mut field = Field::new(&Domains::default());
    let (a, b) = (
        field.element(&s("a")).expect("a"),
        field.element(&s("b")).expect("b"),
    );
    let one = field.integer(1);
    // x + y = a, x − y = b
    let rows = [
        Row {
            coeffs: vec![(0, one.clone()), (1, one.clone())],
            rhs: a,
        },
        Row {
            coeffs: vec![(0, one.clone()), (1, field.neg(&one))],
            rhs: b,
        },
    ];
    let solution = solve(&field, &rows, 2).expect("within limits");
    assert_eq!(solution.rank, 2);
    let x = field.expr(solution.values[0].as_ref().expect("unique"));
    assert_eq!(format!("{x:?}"), "(* 1/2 (+ a b))");
}

#[test]
fn components_of_a_unit_vector_know_each_other() {
    let mut domains = Domains::default();
    domains.unit_vectors.push(["nx".into(), "ny".into()]);
    let (x, y) = (s("nx"), s("ny"));
    assert!(is_zero_on(&domains, &(x.powi(2) + y.powi(2) - n(1))));
    assert!(
        !is_zero_on(&domains, &((n(1) - y.powi(2)).sqrt() - &x)),
        "nx may be negative"
    );
    assert!(is_zero_on(
        &domains,
        &((n(1) - y.powi(2)).sqrt() - call(Function::Abs, x.clone()))
    ));
    // Without preparation, too.
    let mut field = Field::new(&domains);
    let late = field.element(&(y.powi(2) - n(1))).expect("small");
    let square = field.element(&x.powi(2)).expect("small");
    assert!(field.is_zero(&field.add(&late, &square).expect("small")));
}

#[test]
fn deep_nesting_ends_with_a_limit_and_no_overflow() {
    for function in [
        Function::Sin,
        Function::Exp,
        Function::Abs,
        Function::Ln,
        Function::Atan,
    ] {
        for depth in [100, 1_000] {
            let mut e = s("x");
            for _ in 0..depth {
                e = call(function, n(1) + e);
            }
            let mut field = Field::new(&Domains::default());
            match field.element(&e) {
                Ok(x) => drop(field.expr(&x)),
                Err(stop) => assert!(matches!(stop, Stop::TooLarge(_) | Stop::NotReal), "{stop}"),
            }
        }
    }
    let mut e = s("x");
    for _ in 0..100 {
        e = (n(1) + e).sqrt();
    }
    let mut field = Field::new(&Domains::default());
    if let Ok(x) = field.element(&e) {
        drop(field.expr(&x));
    }
}

#[test]
fn hostile_sums_stay_bounded() {
    let sum = |k: usize| Expr::sum((0..k).map(|i| s(&format!("x{i}"))));
    let e = Expr::product((0..40).map(|i| sum(12) + n(i)));
    assert!(matches!(
        Field::new(&Domains::default()).element(&e),
        Err(Stop::TooLarge(_))
    ));
    let fractions = Expr::sum((0..40).map(|i| (s("x") + s("y").powi(i) + n(i)).powi(-1)));
    assert!(matches!(
        Field::new(&Domains::default()).element(&fractions),
        Err(Stop::TooLarge(_)) | Ok(_)
    ));
    let roots = Expr::sum((0..30).map(|i| (s("x") + n(i)).sqrt()));
    let mut field = Field::new(&Domains::default());
    if let Ok(x) = field.element(&roots.powi(2)) {
        drop(field.expr(&x));
    }
}
