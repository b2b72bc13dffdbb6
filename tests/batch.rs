//! `carom grade --batch`: a line out for every line in, in order, whatever comes in.

use std::io::Write;
use std::process::{Command, Stdio};

use serde_json::{Value, json};

/// Sends bytes through a batch and gives the lines that come out.
fn batch(input: &[u8], more: &[&str]) -> Vec<Value> {
    let mut child = Command::new(env!("CARGO_BIN_EXE_carom"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(["grade", "--batch"])
        .args(more)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut pipe = child.stdin.take().expect("a pipe");
    let input = input.to_vec();
    let writer = std::thread::spawn(move || pipe.write_all(&input));
    let out = child.wait_with_output().expect("an end");
    writer.join().expect("a thread").expect("all was taken");
    assert!(
        out.status.success(),
        "a batch ends well however wrong the answers are"
    );
    assert!(
        out.stderr.is_empty(),
        "{}",
        String::from_utf8_lossy(&out.stderr)
    );
    let text = String::from_utf8(out.stdout).expect("UTF-8 out");
    text.lines()
        .map(|l| serde_json::from_str(l).expect("JSON out"))
        .collect()
}

fn one(line: Value) -> Value {
    let mut all = batch(line.to_string().as_bytes(), &[]);
    assert_eq!(all.len(), 1);
    all.remove(0)
}

/// The verdict on an answer within a tolerance, with its note.
fn within(tolerance: Value, expected: &str, answer: &str) -> String {
    judged(json!({"expected": expected, "answer": answer, "tolerance": tolerance}))
}

fn judged(line: Value) -> String {
    let out = one(line);
    format!(
        "{} {}",
        out["verdict"].as_str().unwrap_or(""),
        out["note"].as_str().unwrap_or("")
    )
}

#[test]
fn every_line_has_an_answer_in_its_place() {
    let mut input: Vec<u8> = Vec::new();
    let lines: [&[u8]; 16] = [
        b"\xef\xbb\xbf{\"id\": \"a\", \"expected\": \"2 x\", \"answer\": \"x + x\"}\r",
        b"{\"id\": \"a\", \"expected\": \"2 x\", \"answer\": \"x\"}",
        b"",
        b"   \t",
        b"no JSON",
        b"[1, 2]",
        b"null",
        b"{\"id\": 7, \"expected\": \"a\"}",
        b"{\"id\": [1, {\"x\": 2.50}], \"expected\": \"a\", \"answer\": \"a\", \"extra\": 1}",
        b"{\"id\": 1, \"expected\": \"a\", \"answer\": \"\xff\xfe\"}",
        b"{\"id\": 2, \"expected\": \"a\", \"answer\": \"\\ud800\"}",
        b"{\"id\": 3, \"expected\": \"2*\", \"answer\": \"a\"}",
        b"{\"id\": 4, \"expected\": \"a\", \"answer\": \"\"}",
        b"{\"id\": 5, \"expected\": \"1/2\", \"answer\": 0.5}",
        b"{\"id\": 123456789012345678901234567890, \"expected\": \"a\", \"answer\": \"a\"}",
        b"{\"id\": 6, \"expected\": \"x^y*z\", \"answer\": null}",
    ];
    for line in lines {
        input.extend_from_slice(line);
        input.push(b'\n');
    }
    let long = format!(
        "{{\"id\": 8, \"expected\": \"a\", \"answer\": \"{}\"}}\n",
        "9".repeat(400_000)
    );
    input.extend_from_slice(long.as_bytes());
    // The last line need not end.
    input.extend_from_slice(b"{\"id\": \"last\", \"expected\": \"a\", \"answer\": \"a\"}");
    let out = batch(&input, &[]);
    let told: Vec<String> = out
        .iter()
        .map(|line| {
            for field in [
                "id", "verdict", "reward", "proof", "note", "read_as", "symbols",
            ] {
                assert!(line.get(field).is_some(), "{line} lacks {field}");
            }
            let reward = match line["verdict"].as_str() {
                Some("equivalent") => json!(1),
                Some("different") => json!(0),
                _ => json!(null),
            };
            assert_eq!(line["reward"], reward, "{line}");
            let at = match line["error"]["line"].as_u64() {
                Some(number) => format!(" at {number}"),
                None => String::new(),
            };
            format!("{} {}{at}", line["id"], line["note"].as_str().unwrap_or(""))
        })
        .collect();
    assert_eq!(
        told,
        [
            "\"a\" EQUIV_IDENTITY",
            "\"a\" DIFF_FACTOR",
            "null INVALID_LINE at 3",
            "null INVALID_LINE at 4",
            "null INVALID_LINE at 5",
            "null INVALID_LINE at 6",
            "null INVALID_LINE at 7",
            "7 INVALID_LINE at 8",
            "[1,{\"x\":2.50}] INVALID_LINE at 9",
            "1 INVALID_LINE at 10",
            "2 INVALID_LINE at 11",
            "3 INVALID_EXPECTED at 12",
            "4 INVALID_SYNTAX at 13",
            "5 EQUIV_IDENTITY",
            "123456789012345678901234567890 EQUIV_IDENTITY",
            "6 INVALID_LINE at 16",
            "8 INVALID_LINE at 17",
            "\"last\" EQUIV_IDENTITY",
        ]
    );
}

#[test]
fn a_message_is_never_longer_than_a_screen() {
    let long = "a".repeat(100_000);
    for line in [
        json!({"expected": "a", "answer": "a", long.as_str(): 1}),
        json!({"expected": "a", "answer": "a", "form": long}),
        json!({"expected": "a", "answer": "a", "tolerance": long}),
        json!({"expected": "a", "answer": "a", "symbols": {long.as_str(): {}}}),
        json!({"expected": "a", "answer": "a", "symbols": {"a": long}}),
        json!({"expected": "a", "answer": "a", "symbols": {"a": {"unit": long}}}),
        json!({"expected": "a", "answer": "a", "scene": long}),
        json!({"expected": "a", "answer": format!("{long}$")}),
        json!({"expected": format!("({long}"), "answer": "a"}),
    ] {
        let out = one(line);
        let error = out["error"].to_string();
        assert!(!out["error"].is_null() && error.len() < 2_000, "{error}");
    }
}

#[test]
fn the_order_is_kept_on_any_number_of_threads() {
    let lines: String = (0..3_000)
        .map(|i| {
            format!(
                "{}\n",
                json!({"id": i, "expected": "a + b", "answer": format!("b + a + {}", i % 3)})
            )
        })
        .collect();
    for jobs in ["1", "4"] {
        let out = batch(lines.as_bytes(), &["--jobs", jobs]);
        assert_eq!(out.len(), 3_000);
        for (i, line) in out.iter().enumerate() {
            assert_eq!(line["id"], json!(i));
            assert_eq!(line["reward"], json!(u8::from(i % 3 == 0)), "{line}");
        }
    }
}

#[test]
fn declared_symbols_say_where_they_live_and_what_they_measure() {
    let line = |symbols: Value| json!({"expected": "sqrt(v^2)", "answer": "v", "symbols": symbols});
    assert_eq!(
        judged(line(json!({"v": {"domain": "positive"}}))),
        "equivalent EQUIV_IDENTITY"
    );
    assert_eq!(
        judged(line(json!({"v": {"domain": "nonnegative"}}))),
        "equivalent EQUIV_IDENTITY"
    );
    assert_eq!(
        judged(line(json!({"v": {"domain": "real"}}))),
        "different DIFF_BRANCH"
    );
    assert_eq!(judged(line(json!({"v": "real"}))), "different DIFF_BRANCH");
    assert_eq!(
        judged(line(json!({"v": {"domain": {"min": 0, "max": 2}}}))),
        "equivalent EQUIV_IDENTITY"
    );
    assert_eq!(
        judged(line(
            json!({"v": {"domain": {"min": "-pi", "max": "pi/2"}}})
        )),
        "different DIFF_BRANCH"
    );
    let assumed = one(line(json!({})));
    assert_eq!(assumed["assumed"], json!(["v > 0"]));
    let measured = one(json!({"expected": "v t", "answer": "v",
        "symbols": {"v": {"domain": "real", "dimension": "m/s"}, "t": {"dimension": "s"}}}));
    assert_eq!(measured["note"], "DIFF_DIMENSION");
    assert_eq!(measured["diagnosis"][0]["code"], "DIMENSION");
    for wrong in [
        json!({"v": {"domain": "imaginary"}}),
        json!({"v": {"domain": {"min": 2, "max": 1}}}),
        json!({"v": {"dimension": "quux"}}),
        json!({"v": {"colour": "red"}}),
        json!({"a b": {}}),
        json!({"v": 3}),
        json!("v"),
    ] {
        assert_eq!(
            judged(line(wrong.clone())),
            "invalid INVALID_LINE",
            "{wrong}"
        );
    }
}

#[test]
fn e_d_i_a_and_m_are_what_the_question_declares() {
    let symbols =
        json!({"e": {"domain": {"min": 0, "max": 1}}, "d": {}, "I1": {}, "a": "real", "m": {}});
    let same = json!({"expected": "e*I1*d*a*m", "answer": "m a d I_1 e", "symbols": symbols});
    assert_eq!(judged(same), "equivalent EQUIV_IDENTITY");
    let euler = json!({"expected": "e", "answer": "2.718281828", "symbols": {"e": {}}});
    assert_eq!(one(euler)["reward"], json!(0));
    let meters = json!({"expected": "2 m", "answer": "200 cm", "symbols": {"m": {}}});
    assert_ne!(one(meters)["verdict"], "equivalent");
}

#[test]
fn numbers_that_stand_alone_in_their_place_lie_within_the_tolerance() {
    let rows = [
        ("x+2", "x+2.01", "equivalent"),
        ("x+2", "x+2.1", "different"),
        ("x+2", "x-2.01", "different"),
        ("x+2", "y+2.01", "different"),
        ("v0+9.8*t", "v0+9.81*t", "equivalent"),
        ("v0+9.8*t", "1.05*v0+9.81*t", "different"),
        ("v0+9.8*t", "v0-9.81*t", "different"),
        ("x^2+2", "x^2.01+2", "different"),
        ("v > 3.13 m/s", "v > 3.132 m/s", "equivalent"),
        ("v > 3.13 m/s", "v < 3.132 m/s", "different"),
        ("v > 3.13 m/s", "v > 3.5 m/s", "different"),
        ("0.5 < mu < 0.577", "0.5 < mu < 0.5774", "equivalent"),
        ("0.5 < mu < 0.577", "0.52 < mu < 0.5774", "different"),
        ("x > 1/3", "0.333 < x", "equivalent"),
        ("x > 1/3", "0.333 > x", "different"),
        ("x > 1/3", "x - 0.333 > 0", "equivalent"),
        ("x > 1/3", "3x > 1.002", "equivalent"),
        ("x > 1/3", "3x > 1.02", "different"),
        ("x > 1/3", "-3x > -1.002", "different"),
        ("x < 1 or x > 3", "x < 1.001 or x > 2.999", "equivalent"),
        ("x < 1 or x > 3", "x < 1.001 and x > 2.999", "different"),
        ("x < 1 or x > 3", "x < 1.001 or x > 2.9", "different"),
        ("abs(x) < 1/3", "-0.333 < x < 0.333", "equivalent"),
        ("abs(x) < 1/3", "-0.333 < x < 0.35", "different"),
        ("v = 5 m/s", "2v = 10.02 m/s", "equivalent"),
        ("v = 5 m/s", "2v = 10.2 m/s", "different"),
        ("5 m", "5.01 m = x", "equivalent"),
        ("5 m", "5.1 m = x", "different"),
    ];
    for (expected, answer, verdict) in rows {
        let line = json!({"expected": expected, "answer": answer, "tolerance": "1%"});
        assert_eq!(one(line)["verdict"], verdict, "{expected} | {answer}");
    }
}

#[test]
fn a_formula_is_refuted_by_a_point_outside_the_tolerance_alone() {
    let rows = [
        ("exp(x)", "1+x", 0.1, "equivalent EQUIV_TOLERANCE"),
        ("sin(x)", "x", 0.1, "equivalent EQUIV_TOLERANCE"),
        ("sin(x)", "0.999x", 0.1, "equivalent EQUIV_TOLERANCE"),
        ("1/(1-x)", "1+x", 0.1, "equivalent EQUIV_TOLERANCE"),
        ("sin(x)", "x-x^3/6", 0.5, "equivalent EQUIV_TOLERANCE"),
        ("sin(x)", "x", 0.5, "different DIFF_SMALL_ANGLE"),
        ("exp(x)", "1+2x", 0.1, "different DIFF"),
    ];
    for (expected, answer, most, verdict) in rows {
        let symbols = json!({"x": {"domain": {"min": 0, "max": most}}});
        let line =
            json!({"expected": expected, "answer": answer, "tolerance": "1%", "symbols": symbols});
        assert_eq!(judged(line), verdict, "{expected} | {answer}");
    }
}

#[test]
fn a_rounding_is_told_where_there_is_one() {
    let codes = |expected: &str, answer: &str| {
        let found = one(json!({"expected": expected, "answer": answer, "tolerance": "0.001%"}));
        found["diagnosis"][0]["code"].clone()
    };
    assert_eq!(codes("12.34", "12.3"), "ROUNDED");
    assert_eq!(codes("12.34", "12.4"), Value::Null);
    assert_eq!(codes("100", "104"), Value::Null);
}

#[test]
fn a_name_without_an_index_belongs_to_no_second_body() {
    let line = |answer: &str| judged(json!({"expected": "m_1 v_1", "answer": answer}));
    assert_eq!(line("m 1 v 1"), "different DIFF_SYMBOLS");
    assert_eq!(line("m_2 v_2"), "different DIFF_EXCHANGED");
}

#[test]
fn a_tolerance_is_relative_absolute_or_in_digits() {
    let line = |answer: &str, tolerance: Value| within(tolerance, "9.81 m/s^2", answer);
    assert_eq!(line("9.7 m/s^2", json!("2%")), "equivalent EQUIV_TOLERANCE");
    assert_eq!(
        line("9.7 m/s^2", json!({"relative": 0.02})),
        "equivalent EQUIV_TOLERANCE"
    );
    assert_eq!(
        line("9.6 m/s^2", json!({"relative": 0.02})),
        "different DIFF_TOLERANCE"
    );
    assert_eq!(
        line("980 cm/s^2", json!({"absolute": "0.05"})),
        "equivalent EQUIV_TOLERANCE"
    );
    assert_eq!(
        line("9.7 m/s^2", json!({"absolute": 0.05})),
        "different DIFF_TOLERANCE"
    );
    assert_eq!(
        line("9.8 m/s^2", json!({"significant": 2})),
        "equivalent EQUIV_TOLERANCE"
    );
    assert_eq!(
        line("9.8 m/s^2", json!({"significant": 3})),
        "different DIFF_TOLERANCE"
    );
    // A factor of a formula is rounded to digits as a number is.
    let rounded =
        |expected: &str, answer: &str| within(json!({"significant": 2}), expected, answer);
    assert_eq!(rounded("3*v/7", "0.43 v"), "equivalent EQUIV_TOLERANCE");
    assert_eq!(rounded("3*v/7", "0.44 v"), "different DIFF_FACTOR");
    let root = |answer| rounded("sqrt(2*g*h)", answer);
    assert_eq!(root("1.4 sqrt(g h)"), "equivalent EQUIV_TOLERANCE");
    assert!(root("1.5 sqrt(g h)").starts_with("different"));
    let sum = |answer| rounded("3*v/7 + 2*u/7", answer);
    assert_eq!(sum("0.43 v + 0.29 u"), "equivalent EQUIV_TOLERANCE");
    assert!(sum("0.43 v + 0.28 u").starts_with("different"));
    assert!(rounded("3*(v+u)/7", "0.45 (v + u)").starts_with("different"));
    // Numbers near those of a difference say nothing of its value.
    let near = |expected: &str, answer: &str| within(json!("1%"), expected, answer);
    assert_eq!(near("a+b", "a+1.009b"), "equivalent EQUIV_TOLERANCE");
    assert_eq!(near("a-b", "a-1.009b"), "undecided UNDECIDED_TOLERANCE");
    let rounded = near("m*v/(m+M/3)", "m*v/(m+0.333M)");
    assert_eq!(rounded, "equivalent EQUIV_TOLERANCE");
    // The edge of a tolerance belongs to it, exactly.
    let edge = |answer: &str| near("10", answer);
    assert_eq!(edge("10.1"), "equivalent EQUIV_TOLERANCE");
    assert_eq!(
        edge("10.1000000000000000000001"),
        "different DIFF_TOLERANCE"
    );
    // Of an equation the solutions count, all of them.
    let root = |answer: &str| {
        let symbols = json!({"x": "real"});
        judged(
            json!({"expected": "x^2 = 2", "answer": answer, "tolerance": "1%", "symbols": symbols}),
        )
    };
    assert_eq!(root("x = ±1.414"), "equivalent EQUIV_TOLERANCE");
    assert!(root("x = 1.414").starts_with("different"));
    assert!(root("x = ±1.44").starts_with("different"));
    assert!(root("x = ±1.414 or x = 3").starts_with("different"));
    for wrong in [
        json!(-1),
        json!("two"),
        json!({"significant": 0}),
        json!({"relative": 1, "absolute": 1}),
    ] {
        assert_eq!(
            line("9.8 m/s^2", wrong.clone()),
            "invalid INVALID_LINE",
            "{wrong}"
        );
    }
}

#[test]
fn a_tolerance_with_a_unit_is_an_amount() {
    let rows = [
        ("5 m", "14 m", "2 m", "different DIFF_TOLERANCE"),
        ("5 m", "7 m", "2 m", "equivalent EQUIV_TOLERANCE"),
        ("5 m", "509 cm", "10 cm", "equivalent EQUIV_TOLERANCE"),
        ("5 m", "5.2 m", "10 cm", "different DIFF_TOLERANCE"),
        ("500 cm", "5.09 m", "0.1 m", "equivalent EQUIV_TOLERANCE"),
        ("30 deg", "31 deg", "1.5 deg", "equivalent EQUIV_TOLERANCE"),
        ("30 deg", "32 deg", "1.5 deg", "different DIFF_TOLERANCE"),
        (
            "[3, 4] km/h",
            "[3.1, 4] km/h",
            "0.1 km/h",
            "equivalent EQUIV_TOLERANCE",
        ),
        ("5 m", "5 m", "0.1 s", "invalid INVALID_TOLERANCE"),
        ("5", "5", "0.1 m", "invalid INVALID_TOLERANCE"),
    ];
    for (expected, answer, tolerance, grade) in rows {
        let line = json!({"expected": expected, "answer": answer, "tolerance": tolerance});
        assert_eq!(
            judged(line),
            grade,
            "{expected} | {answer} within {tolerance}"
        );
    }
}

#[test]
fn each_value_is_given_by_a_number_of_its_own() {
    let rows = [
        ("1, 1.005", "1", "1%", "different"),
        ("1, 1.005", "1, 1.005", "1%", "equivalent"),
        ("x = 1 or x = 1.005", "x = 1", "1%", "different"),
        ("10, 10.3", "10.1", "5%", "different"),
        ("10, 10.3", "10.1, 10.2, 9.9", "5%", "different"),
        ("10, 10.3", "10.1, 10.2", "5%", "equivalent"),
        // The one near both is left to that which no other is near.
        ("10, 10.4", "10.2, 9.6", "5%", "equivalent"),
        ("10.1", "10, 10.3", "5%", "different"),
        ("±1", "1", "300%", "different"),
        ("1/2, 1/3", "0.5, 1/2, 0.333", "1%", "equivalent"),
    ];
    for (expected, answer, tolerance, verdict) in rows {
        let found = within(json!(tolerance), expected, answer);
        assert!(found.starts_with(verdict), "{expected} | {answer}");
    }
}

#[test]
fn a_component_that_vanishes_has_the_room_of_the_vector() {
    let near = |answer: &str| within(json!("1%"), "[3, 0] m/s", answer);
    assert_eq!(near("(3.02, 0.001) m/s"), "equivalent EQUIV_TOLERANCE");
    assert!(near("(3.02, 0.04) m/s").starts_with("different"));
    assert!(near("(3.04, 0) m/s").starts_with("different"));
}

#[test]
fn a_form_may_be_asked_for() {
    let line = |answer: &str, form: Value| {
        judged(json!({"expected": "(a+b)^2", "answer": answer, "form": form}))
    };
    assert_eq!(
        line("(b+a)^2", json!("factored")),
        "equivalent EQUIV_IDENTITY"
    );
    assert_eq!(
        line("a^2+2 a b+b^2", json!("factored")),
        "different DIFF_FORM_FACTORED"
    );
    assert_eq!(
        line("a^2+2 a b+b^2", json!(["simplified"])),
        "different DIFF_FORM_SIMPLIFIED"
    );
    assert_eq!(line("(a+b)^2", json!("pretty")), "invalid INVALID_LINE");
}

#[test]
fn what_can_be_reduced_or_factored_has_not_the_form() {
    for (form, right, wrong) in [
        ("simplified", "1/2", "2/4"),
        ("simplified", "1/2", "\\frac{2}{4}"),
        ("simplified", "2", "4/2"),
        ("simplified", "x/2", "2x/4"),
        ("simplified", "3x/(2y)", "6x/(4y)"),
        ("simplified", "2 sqrt(2)", "sqrt(8)"),
        ("simplified", "3", "1+2"),
        ("simplified", "5/6", "1/2+1/3"),
        ("simplified", "9", "3^2"),
        ("simplified", "8", "2*4"),
        ("simplified", "6a", "2*3*a"),
        ("simplified", "a", "a*1"),
        ("simplified", "a", "a+0"),
        ("simplified", "a", "a^1"),
        ("simplified", "-a", "-1*a"),
        ("simplified", "a b/(c d)", "(a/c)/(d/b)"),
        ("simplified", "(3/2) v/l", "(6/4) v/l"),
        ("simplified", "3*10^4", "3*100^2"),
        ("simplified", "x/(x+1)", "x^2/(x^2+x)"),
        ("simplified", "(m-M)/(m+M)", "(m^2-M^2)/(m+M)^2"),
        ("simplified", "(x+1)/(x+2)", "(x^2+3x+2)/(x+2)^2"),
        ("simplified", "1", "e^0"),
        ("simplified", "-x", "-(-(-x))"),
        ("factored", "(x+1)(x+2)", "(x+1)(x+2)x/x"),
        ("digits=3", "12300", "12300.0"),
        ("digits=2", "1300", "1300.0"),
        ("digits=1", "100", "100.0"),
        ("digits=2", "1.0e2", "100.0"),
        ("digits=3", "30.0°", "30°"),
        ("digits=3", "50.0%", "50%"),
        ("digits=3", "±3.00 m", "±3.0 m"),
        ("digits=3", "(3.00,4.00) m/s", "(3.00,4.0) m/s"),
        ("digits=3", "(3.00 m/s, 4.00 m/s)", "(3 m/s, 4 m/s)"),
        ("factored", "(x-1)(x+1)", "x^2-1"),
        ("factored", "2(x-1)(x+1)", "2(x^2-1)"),
        ("factored", "x(x-1)(x+1)", "x(x^2-1)"),
    ] {
        for (answer, verdict) in [(right, "equivalent"), (wrong, "different")] {
            let line = json!({"expected": right, "answer": answer, "form": form});
            assert!(judged(line).starts_with(verdict), "{answer} as {form}");
        }
    }
}

#[test]
fn a_scene_below_the_working_folder_gives_key_and_symbols() {
    let scene = "derivations/book/falling-stick.json";
    let right = json!({"scene": scene, "quantity": "omega", "answer": "3 v cosθ/(2ℓ)"});
    assert_eq!(judged(right), "equivalent EQUIV_IDENTITY");
    let believed = one(json!({"scene": scene, "quantity": "omega", "answer": "6 v cosθ/ℓ"}));
    assert_eq!(believed["diagnosis"][0]["code"], "PARALLEL_AXIS_DROPPED");
    // With a formula of its own the line takes the meaning of symbols from the scene.
    let own = json!({"scene": scene, "expected": "m v", "answer": "v m"});
    assert_eq!(judged(own), "equivalent EQUIV_IDENTITY");
    let strange = json!({"scene": scene, "expected": "m v", "answer": "M v"});
    assert_eq!(judged(strange), "invalid INVALID_SYNTAX");
    // Questions about answers: what a condition is solved for, and the bound it sets.
    for (scene, quantity, answer, verdict) in [
        (
            "book/ball-hits-bat",
            "d_0",
            "4l/3",
            "equivalent EQUIV_IDENTITY",
        ),
        (
            "book/ball-hits-bat",
            "d_0",
            "d = 4l/3",
            "equivalent EQUIV_IDENTITY",
        ),
        (
            "book/ball-hits-bat",
            "d_0",
            "d = 2l/3",
            "different DIFF_FACTOR",
        ),
        (
            "book/falling-stick",
            "upright",
            "90°",
            "equivalent EQUIV_IDENTITY",
        ),
        (
            "problems/tipping-box",
            "flattest",
            "a <= b",
            "different DIFF_INEQUALITY",
        ),
        (
            "problems/tipping-box",
            "flattest",
            "a >= 2b/sqrt(5)",
            "equivalent EQUIV_SOLUTIONS",
        ),
        (
            "problems/tipping-box",
            "flattest",
            "2b/sqrt(5)",
            "equivalent EQUIV_IDENTITY",
        ),
    ] {
        let scene = format!("derivations/{scene}.json");
        let line = json!({"scene": scene, "quantity": quantity, "answer": answer});
        assert_eq!(judged(line), verdict, "{quantity}: {answer}");
    }
    for (path, quantity) in [
        (scene, "spin"),
        ("derivations/none.json", "omega"),
        ("../main/derivations/book/falling-stick.json", "omega"),
        ("/etc/passwd", "omega"),
    ] {
        let line = json!({"scene": path, "quantity": quantity, "answer": "1"});
        assert_eq!(judged(line), "invalid INVALID_LINE", "{path}");
    }
}
