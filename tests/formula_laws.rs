//! What holds for every formula: what is written reads back as the same value, and no text makes the reader panic or
//! work for long.

use std::collections::BTreeSet;

use carom::expr::{Expr, Function, Point, ratio};
use carom::formula::{
    Content, Symbols, other_readings, read, write_latex, write_plain, write_unicode,
};
use proptest::prelude::*;

use crate::shared::clock;

const NAMES: [&str; 12] = [
    "v",
    "l",
    "m",
    "e",
    "theta",
    "omega1",
    "v_G1",
    "v1'",
    "v1^+",
    "theta_dot",
    "u1x",
    "phi",
];

fn declared() -> Symbols {
    NAMES.into_iter().collect()
}

fn expression() -> impl Strategy<Value = Expr> {
    let leaf = prop_oneof![
        3 => proptest::sample::select(&NAMES[..]).prop_map(Expr::symbol),
        2 => (-9i64..=9, 1i64..=6).prop_map(|(n, d)| Expr::from(ratio(n, d))),
        1 => Just(Expr::pi()),
    ];
    leaf.prop_recursive(5, 40, 4, |inner| {
        let functions = vec![Function::Sin, Function::Cos, Function::Tan, Function::Exp, Function::Abs, Function::Atan, Function::Tanh];
        prop_oneof![
            3 => proptest::collection::vec(inner.clone(), 2..4).prop_map(Expr::sum),
            4 => proptest::collection::vec(inner.clone(), 2..5).prop_map(Expr::product),
            2 => (inner.clone(), -3i64..=3).prop_map(|(b, k)| b.powi(k)),
            1 => inner.clone().prop_map(|b| b.sqrt()),
            1 => (inner.clone(), proptest::sample::select(vec![(3, 2), (-1, 2), (1, 3)])).prop_map(|(b, (n, d))| b.power(Expr::ratio(n, d))),
            1 => (inner.clone(), inner.clone()).prop_map(|(b, k)| b.power(k)),
            3 => (proptest::sample::select(functions), inner.clone()).prop_map(|(f, x)| Expr::call(f, x)),
            1 => inner.prop_map(|x| -x),
        ]
    })
}

fn at(seed: u32) -> Point<f64> {
    let mut point = Point::default();
    for (i, name) in NAMES.iter().enumerate() {
        let value = 0.2
            + f64::from(
                (seed
                    .wrapping_mul(2_654_435_761)
                    .wrapping_add(i as u32 * 40_503))
                    % 1000,
            ) / 500.0;
        point.values.insert((*name).into(), value);
    }
    point
}

/// Both have the same value to rounding, or neither has one.
fn agree(a: &Expr, b: &Expr) -> Result<(), TestCaseError> {
    for seed in 1..4 {
        let (x, y) = (a.evaluate(&at(seed)), b.evaluate(&at(seed)));
        if let (Some(x), Some(y)) = (x, y) {
            let close = (x - y).abs() <= 1e-6 * (1.0 + x.abs().max(y.abs()))
                || !x.is_finite()
                || x.abs() > 1e9;
            prop_assert!(close, "{x} against {y} for {a:?} and {b:?}");
        }
    }
    Ok(())
}

fn reads_back(e: &Expr, text: &str) -> Result<(), TestCaseError> {
    let reading = match read(text, &declared()) {
        Ok(reading) => reading,
        // A literal division by zero, and a power that cannot be, are refused on purpose.
        Err(fault)
            if fault.message.contains("zero")
                || fault.message.contains("large")
                || fault.message.contains("at most") =>
        {
            return Ok(());
        }
        Err(fault) => {
            return Err(TestCaseError::fail(format!(
                "{text}\n{}\n{e:?}",
                fault.show(text)
            )));
        }
    };
    let Content::Scalar(again) = reading.content else {
        return Err(TestCaseError::fail(format!(
            "{text} is no single expression"
        )));
    };
    agree(e, &again).map_err(|fault| TestCaseError::fail(format!("{text}: {fault}")))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn what_is_written_plainly_reads_back(e in expression()) {
        reads_back(&e, &write_plain(&e))?;
    }

    #[test]
    fn what_is_written_in_unicode_reads_back(e in expression()) {
        reads_back(&e, &write_unicode(&e, &|_| None))?;
    }

    #[test]
    fn what_is_written_in_latex_reads_back(e in expression()) {
        reads_back(&e, &write_latex(&e, &|name| (name == "l").then(|| "\\ell".to_string())))?;
    }

    #[test]
    fn no_text_makes_the_reader_panic(text in "\\PC{0,80}") {
        let _ = read(&text, &Symbols::open());
        let _ = read(&text, &declared());
    }

    #[test]
    fn no_soup_of_tokens_makes_the_reader_panic(
        pieces in proptest::collection::vec(proptest::sample::select(&SOUP[..]), 0..25),
        open in any::<bool>(),
    ) {
        let text = pieces.concat();
        let symbols = if open { Symbols::open() } else { declared() };
        match read(&text, &symbols) {
            Ok(reading) => {
                for other in other_readings(&text, &symbols, true) {
                    prop_assert!(other.content != reading.content);
                }
                for note in &reading.notes {
                    prop_assert!(!note.message(&text).is_empty());
                }
                if let Content::Scalar(e) = &reading.content {
                    let mut again = Symbols::strict();
                    e.symbols().iter().for_each(|name| again.declare(name));
                    let written = write_plain(e);
                    match read(&written, &again) {
                        Ok(_) => {}
                        Err(fault) => prop_assert!(fault.message.contains("zero") || fault.message.contains("at most") || fault.message.contains("large"),
                            "{text} was written as {written}: {}", fault.message),
                    }
                }
            }
            Err(fault) => {
                prop_assert!(fault.start <= fault.end && fault.end <= text.len(), "{text}: {fault:?}");
                prop_assert!(fault.show(&text).contains('^'));
            }
        }
    }
}

const SOUP: [&str; 84] = [
    "a",
    "v",
    "v_1",
    "v_{G1}",
    "^{+}",
    "^+",
    "'",
    "_",
    "{",
    "}",
    "(",
    ")",
    "[",
    "]",
    "|",
    "\\left(",
    "\\right)",
    "\\left|",
    "\\right|",
    "+",
    "-",
    "−",
    "±",
    "\\mp",
    "*",
    "·",
    "\\cdot ",
    "/",
    "÷",
    "^",
    "**",
    "²",
    "⁻¹",
    "⁺",
    "½",
    "1",
    "2",
    "10",
    ".5",
    "4.",
    "1.5e-3",
    "2e",
    " ",
    "\\,",
    "~",
    "$",
    "\\frac",
    "\\frac12",
    "\\sqrt",
    "\\sqrt[3]",
    "√",
    "sin",
    "\\sin",
    "cos",
    "ln",
    "\\ln",
    "sec",
    "asin",
    "θ",
    "\\theta",
    "theta",
    "\\dot",
    "\\hat",
    "\\hat k",
    "k\u{302}",
    "\\vec",
    "π",
    "pi",
    "°",
    "^\\circ",
    " deg",
    "=",
    "≤",
    "<",
    "\\ne",
    ",",
    ";",
    ".",
    "\\mathrm{m/s}",
    " kg",
    " m/s",
    "\\text{",
    "\\boxed{",
    "e",
];

/// Runs the reader on a long or hostile text. The 10 ms of the promise hold for an optimized build; the limits here leave
/// room for others, and still tell linear from quadratic.
fn quickly(text: &str) -> Result<Content, String> {
    let (reading, spent) = clock::spent(|| read(text, &Symbols::open()));
    let result = reading.map(|r| r.content).map_err(|fault| fault.message);
    let limit = if cfg!(debug_assertions) { 5000 } else { 50 };
    assert!(
        spent.as_millis() < limit,
        "{} bytes took {spent:?}: {}",
        text.len(),
        text.chars().take(40).collect::<String>()
    );
    result
}

#[test]
fn hostile_texts_are_refused_at_once() {
    let million = 1_000_000;
    let texts = [
        format!("x{}", "+x".repeat(30_000)),
        "x".repeat(60_000),
        "1 kg ".repeat(12_000),
        "(".repeat(million),
        "(".repeat(60_000),
        "{".repeat(60_000),
        "|".repeat(60_000),
        "-".repeat(60_000),
        "√".repeat(20_000),
        "sin ".repeat(15_000),
        "\\frac".repeat(12_000),
        "\\sqrt".repeat(12_000),
        "\\frac{1}{".repeat(5_000),
        "a^".repeat(30_000),
        "a/".repeat(30_000),
        "\\hat".repeat(15_000),
        "\\mathrm{".repeat(8_000),
        "v_{".repeat(20_000),
        "1".repeat(million),
        "1".repeat(60_000),
        format!("0.{}", "1".repeat(60_000)),
        format!("1e{}", "9".repeat(60_000)),
        "1e1000000000".into(),
        "9^9^9^9".into(),
        "((((9^64)^64)^64)^64)^64".into(),
        format!("v_{{{}}}", "a".repeat(60_000)),
        format!("v{}", "'".repeat(60_000)),
        "\\boxed{".repeat(8_000),
        "a\u{200b}b".into(),
        "\u{202e}a+b".into(),
        "a\0b".into(),
        "\\input{/etc/passwd}".into(),
        "\\def\\x{\\x\\x}\\x".into(),
        "<script>alert(1)</script>".into(),
        "\u{fffd}".into(),
        "a=".repeat(30_000),
        "(1,".repeat(20_000),
        "'".repeat(60_000),
        "^\\circ".repeat(9_000),
    ];
    for text in texts {
        let result = quickly(&text);
        assert!(
            result.is_err(),
            "{} was read",
            text.chars().take(40).collect::<String>()
        );
    }
}

#[test]
fn long_honest_texts_are_read_at_once() {
    let texts = [
        format!("x{}", "+x".repeat(9_000)),
        format!("x{}", "*x".repeat(9_000)),
        format!("x{}", "/x".repeat(9_000)),
        "x".repeat(60),
        "x ".repeat(9_000),
        "x_1 ".repeat(6_000),
        format!("x{}", "-x/y".repeat(4_500)),
        "sinθ ".repeat(9_000),
        format!("1{}", "+9^64".repeat(4_500)),
        "3 m".repeat(9_000),
        "1 kg ".repeat(6_000),
        format!("{}1{}", "(".repeat(55), ")".repeat(55)),
    ];
    for text in texts {
        let result = quickly(&text);
        assert!(
            result.is_ok(),
            "{}: {result:?}",
            text.chars().take(40).collect::<String>()
        );
    }
}

#[test]
fn the_other_readings_are_told() {
    let table = [
        ("*", "1/ab", &["b/a"][..]),
        ("*", "6x/3x", &["6*x*x/3"]),
        ("*", "3v cosθ/2ℓ", &["3*v*l*cos(theta)/2"]),
        ("*", "1/2 m v^2", &["1/(2*m*v^2)"]),
        ("*", "a/(bc)", &[]),
        ("*", "sin ωt", &["t*sin(omega)"]),
        ("*", "cosθ l", &["cos(theta*l)"]),
        ("*", "sinθ/2", &["sin(theta/2)"]),
        ("*", "√2gh", &["sqrt(2*g*h)"]),
        ("e", "2e-1", &["1/5"]),
        ("*", "2e-1", &["2*e - 1"]),
        ("a theta", "asinθ", &["a*sin(theta)"]),
        ("*", "u1x", &["u1*x"]),
        ("*", "3 m/s", &["3*m/s"]),
        ("*", "x+1", &[]),
    ];
    for (names, text, expected) in table {
        let symbols = if names == "*" {
            Symbols::open()
        } else {
            names.split(' ').collect()
        };
        let readings = other_readings(text, &symbols, true);
        let found: BTreeSet<String> = readings
            .iter()
            .filter_map(|r| r.content.expr().map(write_plain))
            .collect();
        let expected: BTreeSet<String> = expected
            .iter()
            .map(|e| {
                read(e, &Symbols::open()).map_or_else(
                    |f| f.message,
                    |r| r.expr().map(write_plain).unwrap_or_default(),
                )
            })
            .collect();
        assert_eq!(found, expected, "{text}");
    }
}

#[test]
fn a_note_says_how_an_unclear_text_was_read() {
    let table = [
        (
            "3v/2l",
            "I read 3v/2l as 3v/(2 l); the other reading is (3v/2)·l",
        ),
        (
            "1/2 m v",
            "I read 1/2 m v as (1/2)·m v; the other reading is 1/(2 m v)",
        ),
        (
            "sin 30",
            "30 under the function counts as radians; degrees are written 30°",
        ),
        (
            "\\sin^{-1} x",
            "I read \\sin^{-1} as the inverse function, not as a reciprocal",
        ),
        ("log x", "I read log as the natural logarithm"),
    ];
    for (text, expected) in table {
        let notes = read(text, &Symbols::open())
            .map(|r| r.notes)
            .unwrap_or_default();
        let told: Vec<String> = notes.iter().map(|n| n.message(text)).collect();
        assert_eq!(told, [expected], "{text}");
    }
}

#[test]
fn a_fault_points_at_its_place_and_offers_the_nearest_name() {
    let symbols: Symbols = ["omega", "v", "l"].into_iter().collect();
    let fault = read("3*v/omga + q", &symbols).unwrap_err();
    assert_eq!(
        fault.show("3*v/omga + q"),
        "`omga` is not declared\n  3*v/omga + q\n      ^^^^\nhint: did you mean omega?\n`q` is not declared\n  3*v/omga + q\n             ^\nhint: declared are omega, v, l"
    );
}

#[test]
fn digits_are_counted_as_written() {
    for (text, digits, place) in [
        ("0.050", 2, -3),
        ("3.0\\times10^{-2}", 2, -3),
        ("12", 2, 0),
        ("1.50e3", 3, 1),
        ("-4.20", 3, -2),
        ("0", 1, 0),
    ] {
        let literal = read(text, &Symbols::open()).ok().and_then(|r| r.literal);
        assert_eq!(
            literal.map(|l| (l.digits, l.place)),
            Some((digits, place)),
            "{text}"
        );
    }
}

#[test]
fn places_count_from_the_start_of_the_text_even_inside_a_box() {
    let text = r"so \boxed{a + }";
    let fault = read(text, &Symbols::open()).unwrap_err();
    assert_eq!(&text[fault.start..], "}");
    let text = "２＊omga";
    let fault = read(text, &Symbols::from_iter(["omega"])).unwrap_err();
    assert_eq!(&text[fault.start..fault.end], "omga");
    let text = r"so \boxed{ab}";
    let reading = read(text, &Symbols::open()).unwrap();
    assert_eq!(
        &text[reading.written[0].start..reading.written[0].end],
        "ab"
    );
}
