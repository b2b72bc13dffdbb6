//! Grades answers line by line, each expected formula read once: `cargo run --example grade`.

use carom::grade::entry::{self, Entry, Keys};
use carom::grade::{Grade, Options};
use carom::render;

const LINES: [&str; 4] = [
    r#"{"id": 1, "expected": "3 v cos(theta)/(2 l)", "answer": "\\frac{3v}{2l}\\cos\\theta"}"#,
    r#"{"id": 2, "expected": "3 v cos(theta)/(2 l)", "answer": "6 v cos(theta)/l"}"#,
    r#"{"id": 3, "expected": "sqrt(v^2)", "answer": "v", "symbols": {"v": "real"}}"#,
    r#"{"id": 4, "expected": "m v", "answer": "m v +"}"#,
];

fn main() {
    let options = Options::default();
    let mut keys = Keys::default();
    let no_scene = |_: &Entry, scene: &str| -> Result<Grade, String> {
        Err(format!("{scene}: no scenes here"))
    };
    for (number, line) in (1..).zip(LINES) {
        let mut out = String::new();
        match entry::entry(line, &options) {
            Ok(entry) => {
                let grade = entry::judge(&entry, &mut keys, &no_scene);
                render::grade::line(&mut out, &entry.id, number, &grade, &entry.answer);
            }
            Err(bad) => {
                let grade = entry::refused(bad.message);
                render::grade::line(&mut out, &bad.id, number, &grade, "");
            }
        }
        print!("{out}");
    }
}
