//! Grading: from two texts to a verdict, by class of formula, and answers against stored keys.
//!
//! `cargo bench --bench grade`; with `stages` behind it, one table of what each stage takes, by class of formula. The same
//! pairs go through SymPy and giac by `benches/peers.py`, which sets them beside that table.

use std::hint::black_box;
use std::time::Instant;

use carom::equality::{at_points, decide};
use carom::formula::{Symbols, read_expr};
use carom::grade::entry::{self, Keys};
use carom::grade::{Options, Question, Strength, Verdict, judge, judge_against, key};
use carom::render;

fn main() {
    match std::env::args().any(|arg| arg == "stages") {
        true => stages(),
        false => divan::main(),
    }
}

/// Class, expected, an equal answer, a different answer.
const PAIRS: &[(&str, &str, &str, &str)] = &[
    (
        "rational",
        "m1*d*v/(m1*d^2+4*m2*l^2/3)",
        "3 m1 d v/(3 m1 d^2 + 4 m2 l^2)",
        "m1*d*v/(m1*d^2+m2*l^2/3)",
    ),
    (
        "one_angle",
        "3*v*cos(theta)/(2*l)",
        "3 v sin(2θ)/(4 l sinθ)",
        "3*v*sin(theta)/(2*l)",
    ),
    (
        "several_angles",
        "v*(sin(alpha)*cos(beta) - cos(alpha)*sin(beta))/(l*cos(alpha-beta)^2)",
        "v sin(α - β)/(l (1 - sin(α-β)²))",
        "v*(sin(alpha)*cos(beta) + cos(alpha)*sin(beta))/(l*cos(alpha-beta)^2)",
    ),
    (
        "roots",
        "2*sqrt(2*g*(a^2+b^2)^(3/2)*(1-b/sqrt(a^2+b^2))/3)/a",
        "(2/a) sqrt(2 g (a²+b²)(sqrt(a²+b²) - b)/3)",
        "2*sqrt(2*g*(a^2+b^2)^(3/2)*(1-a/sqrt(a^2+b^2))/3)/a",
    ),
    (
        "long",
        "(m1*(x1*u1-y1*w1)+m2*(x2*u2-y2*w2)+I1*s1+I2*s2)*(1+e)/(I1+m1*(x1^2+y1^2)+I2+m2*(x2^2+y2^2)) - e*(m1*u1+m2*u2)/(m1+m2)",
        "(1+e)*(I1*s1+I2*s2+m1*x1*u1-m1*y1*w1+m2*x2*u2-m2*y2*w2)/(I1+I2+m1*x1^2+m1*y1^2+m2*x2^2+m2*y2^2) - (e*m1*u1+e*m2*u2)/(m1+m2)",
        "(1+e)*(I1*s1+I2*s2+m1*x1*u1-m1*y1*w1+m2*x2*u2+m2*y2*w2)/(I1+I2+m1*x1^2+m1*y1^2+m2*x2^2+m2*y2^2) - (e*m1*u1+e*m2*u2)/(m1+m2)",
    ),
];

const CLASSES: [usize; 5] = [0, 1, 2, 3, 4];

fn options(strength: Strength) -> Options {
    Options {
        strength,
        ..Options::default()
    }
}

#[divan::bench(args = CLASSES)]
fn equal_identity(bencher: divan::Bencher, class: usize) {
    let (_, expected, equal, _) = PAIRS[class];
    bencher.bench(|| {
        judge(
            expected,
            equal,
            &Question::default(),
            &options(Strength::Identity),
        )
    });
}

#[divan::bench(args = CLASSES)]
fn different_with_diagnosis(bencher: divan::Bencher, class: usize) {
    let (_, expected, _, other) = PAIRS[class];
    bencher.bench(|| {
        judge(
            expected,
            other,
            &Question::default(),
            &options(Strength::Identity),
        )
    });
}

#[divan::bench(args = CLASSES)]
fn equal_pair_fast(bencher: divan::Bencher, class: usize) {
    let (_, expected, equal, _) = PAIRS[class];
    let options = options(Strength::Fast);
    bencher.bench(|| judge(expected, equal, &Question::default(), &options));
}

#[divan::bench(args = CLASSES)]
fn different_pair_fast(bencher: divan::Bencher, class: usize) {
    let (_, expected, _, other) = PAIRS[class];
    let options = options(Strength::Fast);
    bencher.bench(|| judge(expected, other, &Question::default(), &options));
}

#[divan::bench(args = CLASSES)]
fn equal_fast_against_a_stored_key(bencher: divan::Bencher, class: usize) {
    let (_, expected, equal, _) = PAIRS[class];
    let key = key(expected, &Question::default()).expect("a readable formula");
    bencher.bench(|| judge_against(&key, equal, &options(Strength::Fast)));
}

#[divan::bench(args = CLASSES)]
fn different_fast_against_a_stored_key(bencher: divan::Bencher, class: usize) {
    let (_, expected, _, other) = PAIRS[class];
    let key = key(expected, &Question::default()).expect("a readable formula");
    bencher.bench(|| judge_against(&key, other, &options(Strength::Fast)));
}

/// All a batch does for a line at the first strength: cut the JSON, read, compare at points, write.
#[divan::bench(args = CLASSES)]
fn line_of_a_batch_fast(bencher: divan::Bencher, class: usize) {
    let (_, expected, equal, _) = PAIRS[class];
    let line = serde_json::json!({"id": 17, "expected": expected, "answer": equal}).to_string();
    let options = options(Strength::Fast);
    let (mut keys, mut out) = (Keys::default(), String::new());
    bencher.bench_local(|| {
        let entry = entry::entry(black_box(&line), &options).expect("a line of JSON");
        let grade = entry::judge(&entry, &mut keys, &|_, _| Err(String::new()));
        out.clear();
        render::grade::line(&mut out, &entry.id, 1, &grade, &entry.answer);
        out.len()
    });
}

/// The median time of a call in microseconds, of a few thousand calls.
fn median(mut call: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..4_000)
        .map(|_| {
            let start = Instant::now();
            call();
            start.elapsed().as_secs_f64() * 1e6
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// What the stages take by themselves, then whole verdicts, in microseconds and as a multiple of reading.
fn stages() {
    let [fast, identity] = [Strength::Fast, Strength::Identity].map(options);
    let question = Question::default();
    let columns = [
        "reading",
        "key",
        "points",
        "decision",
        "fast, equal",
        "fast, differ",
        "proof",
        "stored key",
    ];
    print!("{:<15}", "us (x reading)");
    columns.iter().for_each(|name| print!(" {name:>15}"));
    println!();
    for (name, expected, equal, other) in PAIRS {
        let judged = |answer: &str, options: &Options, verdict: Verdict| {
            let once = || judge(black_box(expected), black_box(answer), &question, options);
            assert_eq!(once().verdict, verdict);
            median(|| drop(black_box(once())))
        };
        let open = Symbols::open();
        let read = |text: &str| read_expr(black_box(text), &open).expect("a readable formula");
        let kept = key(expected, &question).expect("a readable formula");
        let (a, b) = (read(expected), read(equal));
        let domains = &question.domains;
        let times = [
            median(|| drop(black_box((read(expected), read(equal))))),
            median(|| drop(black_box(key(black_box(expected), &question)))),
            median(|| drop(black_box(at_points(&a, &b, domains)))),
            median(|| drop(black_box(decide(&a, &b, domains)))),
            judged(equal, &fast, Verdict::Equivalent),
            judged(other, &fast, Verdict::Different),
            judged(equal, &identity, Verdict::Equivalent),
            median(|| drop(black_box(judge_against(&kept, equal, &fast)))),
        ];
        print!("{name:<15}");
        for time in times {
            print!(" {:>15}", format!("{time:.2} ({:.1})", time / times[0]));
        }
        println!();
    }
}
