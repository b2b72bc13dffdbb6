//! Time to read a formula into an expression, by kind of text.

use carom::formula::{Symbols, read, write_plain};

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
