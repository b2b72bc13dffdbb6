//! Facts about reading and writing.
use super::*;

fn plain(text: &str, symbols: &Symbols) -> String {
    match read(text, symbols) {
        Ok(reading) => show(&reading.content),
        Err(fault) => format!("error: {}", fault.message),
    }
}

fn show(content: &Content) -> String {
    match content {
        Content::Scalar(e) => write_plain(e),
        Content::Either([a, b]) => format!("{} or {}", write_plain(a), write_plain(b)),
        Content::Vector(v) => format!(
            "[{}]",
            v.iter().map(write_plain).collect::<Vec<_>>().join(", ")
        ),
        Content::Quantity(q) => format!("{} {}", write_plain(&q.value), q.unit.dimension.si()),
        Content::Relations(sides, signs) => {
            let mut out = show(&sides[0]);
            for (side, sign) in sides[1..].iter().zip(signs) {
                out.push_str(&format!(" {} {}", sign.sign(), show(side)));
            }
            out
        }
    }
}

#[test]
fn quick_look() {
    let open = Symbols::open();
    for text in [
        "3v cosθ/2ℓ",
        r"\frac{3 v \cos\theta}{2 \ell}",
        "1/2 m v^2",
        "½ m v²",
        "mgl",
        "v_{G1}^{+} + v_1'",
        "e(v_1-v_2)",
        "sin 2θ cosφ",
        r"\sin\theta\cos\theta",
        "√(2gh)",
        "|a|b|c|",
        "-(3v/2ℓ) cosθ k̂",
        "30°",
        r"\sin30^\circ",
        "3.0\\times10^{-2} m/s",
        "a = b",
        "1.1.1",
        "a\\cdot\\cdot b",
    ] {
        println!("{text:40} {}", plain(text, &open));
    }
}
