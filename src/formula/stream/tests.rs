//! What this reader takes, the careful reader takes in the same way: cases by hand and at random.

use super::*;
use crate::expr::{Expr, Point, ratio};
use crate::formula::{Content, Symbols, read};

/// Builds expressions, so that the two readings can be compared.
struct Exprs(Vec<String>);

impl Builder for Exprs {
    type Value = Expr;
    fn number(&mut self, digits: u64, tens: u32) -> Option<Expr> {
        let below = 10i64.checked_pow(tens)?;
        Some(Expr::from(ratio(i64::try_from(digits).ok()?, below)))
    }
    fn symbol(&mut self, index: usize, _: &[u8]) -> Option<Expr> {
        Some(Expr::symbol(self.0.get(index).map_or("?", |n| n)))
    }
    fn pi(&mut self) -> Option<Expr> {
        Some(Expr::pi())
    }
    fn negative(&mut self, a: Expr) -> Option<Expr> {
        Some(-a)
    }
    fn sum(&mut self, a: Expr, b: Expr) -> Option<Expr> {
        Some(a + b)
    }
    fn product(&mut self, a: Expr, b: Expr) -> Option<Expr> {
        Some(a * b)
    }
    fn quotient(&mut self, a: Expr, b: Expr) -> Option<Expr> {
        (!b.is_zero()).then(|| a / b)
    }
    fn power(&mut self, a: Expr, halves: i32) -> Option<Expr> {
        if a.is_zero() {
            return None;
        }
        Some(a.power(Expr::ratio(i64::from(halves), 2)))
    }
    fn turn(&mut self, ratio: Ratio, angle: &Angle, _: &[&[u8]]) -> Option<Expr> {
        let mut total = Expr::pi() * Expr::ratio(i64::from(angle.quarters), 2);
        for (index, share) in angle.parts() {
            let factor = Expr::ratio(i64::from(share.above), i64::from(share.below));
            total = total + self.symbol(index, b"")? * factor;
        }
        let value = Expr::call(ratio.function, total);
        Some(if ratio.reciprocal {
            value.powi(-1)
        } else {
            value
        })
    }
}

/// A value for each name, the same on both sides.
fn point(names: &[String], round: u32) -> Point<f64> {
    let mut at = Point::default();
    for name in names {
        let hash = name.bytes().fold(round * 77 + 7, |h, b| {
            (h ^ u32::from(b)).wrapping_mul(0x0100_0193)
        });
        at.values
            .insert(name.as_str().into(), 0.3 + f64::from(hash % 9973) / 8000.0);
    }
    at
}

fn near(a: Option<f64>, b: Option<f64>) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => (a - b).abs() <= 1e-7 * (1.0 + a.abs().max(b.abs())),
        // Beyond doubles, or the root of something negative.
        (None, _) | (_, None) => true,
    }
}

/// Reads a text both ways; whether this reader took it.
fn check(text: &str, declared: Option<&[&str]>) -> bool {
    let (mut table, symbols) = match declared {
        None => (Names::collecting(), Symbols::open()),
        Some(names) => {
            let mut symbols = Symbols::open();
            names.iter().for_each(|n| symbols.declare(n));
            let table = Names::declared(names.iter().map(|n| (*n, None)), true);
            (table.expect("simple names"), symbols)
        }
    };
    // The builder needs names before it knows them, so the first pass collects.
    let mut seen = Seen::default();
    let first = match declared {
        None => Table::Collect(&mut table),
        Some(_) => Table::Known(&table),
    };
    if stream(text, first, &mut Exprs(Vec::new()), &mut seen).is_none() {
        return false;
    }
    let name = |index| String::from_utf8_lossy(table.echo(index)).into_owned();
    let names: Vec<String> = (0..table.count).map(name).collect();
    // As what declares these names.
    if declared.is_none() {
        table.close();
    }
    let mut build = Exprs(names.clone());
    let mine = stream(text, Table::Known(&table), &mut build, &mut seen).expect("as before");
    if declared.is_none() {
        let mut symbols = Symbols::open();
        names.iter().for_each(|n| symbols.declare(n));
        let again = read(text, &symbols).map(|r| r.content);
        let first = read(text, &Symbols::open()).map(|r| r.content);
        assert_eq!(again, first, "{text:?} changes its meaning");
    }
    let careful = match read(text, &symbols) {
        Ok(reading) => reading,
        Err(fault) => panic!("{text:?} is refused: {fault}"),
    };
    let Content::Scalar(theirs) = &careful.content else {
        panic!("{text:?} is {:?}", careful.content);
    };
    for round in 0..3 {
        let at = point(&names, round);
        assert!(
            near(mine.evaluate(&at), theirs.evaluate(&at)),
            "{text:?}: {mine:?} against {theirs:?}"
        );
    }
    assert!(
        seen.choices >= careful.choices.min(1),
        "{text:?} has choices"
    );
    let occurring = careful.symbols();
    for (index, name) in names.iter().enumerate() {
        let listed = seen.names >> index & 1 == 1;
        // What cancels while expressions are built, such as 0·x, is listed all the same.
        assert!(
            listed || !occurring.contains(name.as_str()),
            "{text:?}: {name}"
        );
    }
    let mut known = Symbols::open();
    names.iter().for_each(|n| known.declare(n));
    let again = match read(&seen.echo, &known) {
        Ok(again) => again,
        Err(fault) => panic!("the echo {:?} of {text:?} is refused: {fault}", seen.echo),
    };
    for round in 0..3 {
        let at = point(&names, round);
        let value = again.expr().and_then(|e| e.evaluate(&at));
        assert!(
            near(mine.evaluate(&at), value),
            "{text:?} is echoed {:?}",
            seen.echo
        );
    }
    true
}

#[test]
fn everyday_formulas_are_taken() {
    for text in [
        "3*m*v*cos(theta)*(1+e)/(2*l*(m1+m2))-omega*sin(theta)^2/(1+e) + v",
        "3v cosθ/2ℓ",
        r"\frac{3 v \cos\theta}{2 \ell}",
        r"\frac{(1-e^2) m_1 m_2 (v_1-v_2)^2}{2(m_1+m_2)} + \frac12 m \ell^2\omega^2\sqrt{1+3\sin^2\theta}",
        "3 m1 d v/(3 m1 d^2 + 4 m2 l^2)",
        "3 v sin(2θ)/(4 l sinθ)",
        "v*(sin(alpha)*cos(beta) - cos(alpha)*sin(beta))/(l*cos(alpha-beta)^2)",
        "v sin(α - β)/(l (1 - sin(α-β)²))",
        "2*sqrt(2*g*(a^2+b^2)^(3/2)*(1-b/sqrt(a^2+b^2))/3)/a",
        "(2/a) sqrt(2 g (a²+b²)(sqrt(a²+b²) - b)/3)",
        "1/2 m v²",
        "-v_1' + v_{G1}",
        r"\frac12\left(m_1+m_2\right)\cdot v^{2}",
        "0.25*m*v**2",
        "√(2gh)",
        "sinθ cosθ + cos 2θ − sin²θ",
    ] {
        assert!(check(text, None), "{text}");
    }
}

#[test]
fn what_needs_care_is_left_alone() {
    for text in [
        "",
        "3 m",
        "2.5 kg m/s",
        "|x|",
        "x = 1",
        "a ± b",
        "1e3",
        "2e-3",
        "v̂",
        "u1x",
        "1,5",
        "4.",
        "x..y",
        "sin 30",
        "sin(30°)",
        "sin(x y)",
        "asin(x)",
        "x^y",
        "x^2^3",
        "x!",
        "a -> b",
        "2 3",
        "varphi",
        "SIN(x)",
        "v^+",
        "v^{+}",
        r"\dot x",
        r"\vec v",
        "(a, b)",
        "((((",
        "a)",
        "1/(x",
        "½ m",
        "x^0",
        "ln(x)",
        "9999999999999999999",
    ] {
        assert!(!check(text, None), "{text}");
    }
}

/// SplitMix64.
fn next(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

const PIECES: &[&str] = &[
    "m",
    "v",
    "l",
    "g",
    "s",
    "e",
    "a",
    "d",
    "x",
    "m1",
    "v_1",
    "v_{1}",
    "v_G1",
    "I_{cm}",
    "theta",
    "θ",
    "\\theta",
    "α",
    "ω",
    "omega",
    "ℓ",
    "ell",
    "\\ell",
    "pi",
    "π",
    "mgl",
    "kg",
    "rad",
    "mu",
    "phi",
    "varphi",
    "u1x",
    "m12",
    "2",
    "3",
    "12",
    "0.5",
    "1e3",
    ".5",
    "7.",
    "+",
    "-",
    "−",
    "*",
    "·",
    "/",
    "/",
    "^2",
    "^2",
    "²",
    "³",
    "^(1/2)",
    "^{3/2}",
    "^-1",
    "^{-2}",
    "**2",
    "^",
    "(",
    ")",
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    " ",
    " ",
    "\\,",
    "\\left(",
    "\\right)",
    "\\frac12",
    "\\frac{1}{2}",
    "\\frac{v}{l}",
    "\\sqrt{l}",
    "\\sqrt2",
    "sqrt(",
    "sqrt",
    "√",
    "sin",
    "cos",
    "sin(",
    "cos(2",
    "tan",
    "sin^2",
    "sin²",
    "\\sin",
    "\\cos",
    "sec",
    "cot(",
    "asin",
    "'",
    "′",
    "_",
    "°",
    ",",
    "=",
    "$",
    "~",
    "\\cdot",
    "\\times ",
    "₁",
    "⁺",
    "^+",
    "|",
    "!",
    "N",
    "J",
    "W",
    "Pa",
    "sinθ",
    "cos(θ)",
    "1/2",
    "3/2 ",
    "(a+b)",
    "(2l)",
    "\u{302}",
    "min",
    "in",
    "t",
    "h",
    "cosθ/2",
    "exp",
    "SIN",
    "Sin",
    "Om",
    "Omega",
    "\\Omega",
];

fn cases() -> u64 {
    let asked = std::env::var("CAROM_CASES").ok();
    asked.and_then(|n| n.parse().ok()).unwrap_or(20_000)
}

#[test]
fn what_is_taken_is_read_as_the_careful_reader_does() {
    let mut state = 11;
    let mut taken = 0u64;
    let tables: [Option<&[&str]>; 4] = [
        None,
        Some(&["m", "v", "l", "g", "e", "theta", "m1", "v_1", "x", "d", "a"]),
        Some(&[
            "m1", "m12", "v_G1", "I_cm", "omega", "kg", "phi", "alpha", "v", "s",
        ]),
        Some(&[
            "mass", "vel", "theta1", "v'", "v_1'", "mu", "t", "min", "N", "l",
        ]),
    ];
    for round in 0..cases() {
        let count = 1 + next(&mut state) % 9;
        let mut text = String::new();
        for _ in 0..count {
            text.push_str(PIECES[(next(&mut state) % PIECES.len() as u64) as usize]);
        }
        taken += u64::from(check(&text, tables[(round % 4) as usize]));
    }
    assert!(taken > cases() / 40, "{taken} taken");
}

/// A random formula of the kind this reader is for.
fn formula(state: &mut u64, depth: u32) -> String {
    let names = [
        "m", "v_1", "l", "theta1", "omega", "m_{2}", "x", "g", "e", "s",
    ];
    let name = |state: &mut u64| names[(next(state) % 10) as usize].to_string();
    if depth == 0 {
        return match next(state) % 3 {
            0 => (next(state) % 30).to_string(),
            _ => name(state),
        };
    }
    let sub = |state: &mut u64| formula(state, depth - 1);
    match next(state) % 14 {
        0 | 1 => format!("{} + {}", sub(state), sub(state)),
        2 => format!("{} - {}", sub(state), sub(state)),
        3 | 4 => format!("{} {}", sub(state), name(state)),
        5 => format!("{}*({})", sub(state), sub(state)),
        6 => format!("{}/{}", sub(state), sub(state)),
        7 => format!("{}/({})", sub(state), sub(state)),
        8 => format!("\\frac{{{}}}{{{}}}", sub(state), sub(state)),
        9 => format!("({})^{}", sub(state), next(state) % 4 + 1),
        10 => format!("sin({} theta)^2", next(state) % 3 + 1),
        11 => format!("cosφ {}", sub(state)),
        12 => format!("sqrt({})", sub(state)),
        _ => format!("1/2 {}", sub(state)),
    }
}

#[test]
fn random_formulas_are_mostly_taken() {
    let mut state = 5;
    let rounds = cases() / 4;
    let taken = (0..rounds).filter(|_| {
        let depth = (next(&mut state) % 4) as u32;
        check(&formula(&mut state, depth), None)
    });
    let taken = taken.count() as u64;
    assert!(taken > rounds / 3, "{taken} of {rounds}");
}
