//! Time to read a formula into an expression, by kind of text, and to refuse or judge the worst that strangers send.

use carom::formula::{Symbols, read, write_plain};
use carom::grade::{Options, Question, judge};

fn main() {
    divan::main();
}

/// Name and text; the first is the 65-byte formula other readers are compared by.
const TEXTS: [(&str, &str); 6] = [
    (
        "plain, 65 bytes",
        "3*m*v*cos(theta)*(1+e)/(2*l*(m1+m2))-omega*sin(theta)^2/(1+e) + v",
    ),
    ("as the book prints", "3v cosθ/2ℓ"),
    ("LaTeX", r"\frac{3 v \cos\theta}{2 \ell}"),
    (
        "LaTeX, long",
        r"\frac{(1-e^2) m_1 m_2 (v_1-v_2)^2}{2(m_1+m_2)} + \frac12 m \ell^2\omega^2\sqrt{1+3\sin^2\theta}",
    ),
    ("a wrong name", "3*v*omga/(2*l)"),
    ("a million brackets", ""),
];

fn symbols() -> Symbols {
    let names = ["m", "m1", "m2", "v", "v1", "v2", "l", "e", "theta", "omega"];
    names.into_iter().collect()
}

#[divan::bench(args = TEXTS.map(|(name, _)| name))]
fn reading(bencher: divan::Bencher, name: &str) {
    let text = TEXTS
        .iter()
        .find(|(n, _)| *n == name)
        .map_or("", |(_, t)| t);
    let text = if text.is_empty() {
        "(".repeat(1_000_000)
    } else {
        text.to_string()
    };
    let symbols = symbols();
    bencher.bench(|| read(divan::black_box(&text), &symbols).is_ok());
}

#[divan::bench]
fn writing(bencher: divan::Bencher) {
    let reading = read(TEXTS[0].1, &symbols());
    let e = reading.ok().and_then(|r| r.expr().cloned());
    bencher.bench(|| e.as_ref().map(write_plain));
}

/// Texts made to waste time, refused or legal; each has to be answered within 10 ms.
const HOSTILE: [&str; 24] = [
    "tower of powers",
    "a million brackets",
    "a million digits",
    "digits up to the limit",
    "a huge exponent",
    "deep fractions",
    "fractions as deep as allowed",
    "deep roots",
    "deep indices",
    "a definition",
    "20 000 pieces",
    "sums up to the limit",
    "products up to the limit",
    "powers of sums",
    "a power of a power",
    "a thousand sines",
    "a thousand angles",
    "roots side by side",
    "roots in roots",
    "bars in bars",
    "plus and minus side by side",
    "decimals up to the limit",
    "relations in a chain",
    "a unit without end",
];

fn hostile_text(name: &str) -> String {
    let many =
        |count: u32, piece: &dyn Fn(u32) -> String| (0..count).map(piece).collect::<String>();
    let nested = |open: &str, close: &str, count: usize| {
        format!("{}a{}", open.repeat(count), close.repeat(count))
    };
    match name {
        "tower of powers" => "9^9^9^9".into(),
        "a million brackets" => "(".repeat(1_000_000),
        "a million digits" => "9".repeat(1_000_000),
        "digits up to the limit" => "9".repeat(65_000),
        "a huge exponent" => "1e1000000000".into(),
        "deep fractions" => "\\frac{".repeat(10_000),
        "fractions as deep as allowed" => nested("1/(1+", ")", 60),
        "deep roots" => "\\sqrt{".repeat(9_000),
        "deep indices" => format!("v{}", "_{".repeat(30_000)),
        "a definition" => r"\def\a{\a\a}\a".into(),
        "20 000 pieces" => many(10_000, &|i| format!("x{}+", i % 30)) + "a",
        "sums up to the limit" => many(9_000, &|i| format!("{i}a+")) + "a",
        "products up to the limit" => many(6_000, &|i| format!("(a+{i})")),
        "powers of sums" => many(60, &|i| format!("(a+b+{i})^50+")) + "a",
        "a power of a power" => "((((a+b)^99)^99)^99)^99".into(),
        "a thousand sines" => many(1_000, &|i| format!("sin({i}a)+")) + "a",
        "a thousand angles" => many(1_000, &|i| format!("cos(a/{})*", i + 1)) + "a",
        "roots side by side" => many(500, &|i| format!("sqrt(a+{i})+")) + "a",
        "roots in roots" => nested("sqrt(1+", ")", 60),
        "bars in bars" => nested("|1+", "|", 60),
        "plus and minus side by side" => many(300, &|_| "±a".into()),
        "decimals up to the limit" => many(1_000, &|i| format!("1.{i}e-300a+")) + "a",
        "relations in a chain" => many(2_000, &|_| "a=".into()) + "a",
        _ => format!("5 {}", "kg ".repeat(20_000)),
    }
}

#[divan::bench(args = HOSTILE, sample_count = 20)]
fn hostile(bencher: divan::Bencher, name: &str) {
    let text = hostile_text(name);
    bencher.bench(|| {
        judge(
            "a",
            divan::black_box(&text),
            &Question::default(),
            &Options::default(),
        )
        .verdict
    });
}
