//! From a scene file to proved closed forms: reading, deriving and proving each sample of the book, and how the cost grows
//! with the number of hinged rods in a chain.

use carom::answer::Form;
use carom::derive::derive;
use carom::formula::write_plain;
use carom::scene::{Scene, read};
use carom::verify::prove;

const SCENES: [&str; 10] = [
    "ball-hits-bat",
    "billiard-ball",
    "falling-stick",
    "flying-dish",
    "immovable-object",
    "pool-balls-elastic",
    "two-bodies",
    "two-bodies-frictionless",
    "two-bodies-sticking",
    "two-masses",
];

fn main() {
    println!("length of the last rod's spin, in characters, by number of rods in line:");
    for n in [1, 2, 3, 4, 6, 8, 10] {
        println!("  n = {n:2}: {}", last_spin(&chain(n)).len());
    }
    println!("and at any angles:");
    for n in [1, 2, 3, 4] {
        println!("  n = {n:2}: {}", last_spin(&bent_chain(n)).len());
    }
    divan::main();
}

fn text(name: &str) -> String {
    std::fs::read_to_string(format!("derivations/book/{name}.json")).expect("a shipped scene")
}

fn scene(name: &str) -> Scene {
    read(&text(name)).unwrap_or_else(|_| panic!("{name} does not read"))
}

#[divan::bench(args = SCENES)]
fn reading(bencher: divan::Bencher, name: &str) {
    let text = text(name);
    bencher.bench(|| read(divan::black_box(&text)).is_ok());
}

#[divan::bench(args = SCENES)]
fn deriving(bencher: divan::Bencher, name: &str) {
    let scene = scene(name);
    bencher.bench(|| derive(divan::black_box(&scene)).is_ok());
}

#[divan::bench(args = SCENES)]
fn proving(bencher: divan::Bencher, name: &str) {
    let scene = scene(name);
    let derivation = derive(&scene).expect("a derivation");
    bencher.bench(|| prove(divan::black_box(&scene), &derivation).holds());
}

#[divan::bench(args = [1, 2, 3, 4, 6, 8, 10])]
fn chain_in_line(bencher: divan::Bencher, n: usize) {
    let scene = chain(n);
    bencher.bench(|| derive(divan::black_box(&scene)).is_ok());
}

#[divan::bench(args = [1, 2, 3, 4], sample_count = 10)]
fn chain_at_any_angles(bencher: divan::Bencher, n: usize) {
    let scene = bent_chain(n);
    bencher.bench(|| derive(divan::black_box(&scene)).is_ok());
}

fn last_spin(scene: &Scene) -> String {
    let derivation = derive(scene).expect("a derivation");
    match &derivation.answers.last().expect("an answer").form {
        Form::Value { short, .. } => write_plain(short),
        other => panic!("{other:?}"),
    }
}

/// n uniform rods of mass m and length l, hinged in a row along x, free at both ends, struck across at the far end.
fn chain(n: usize) -> Scene {
    chain_scene(n, |_| String::from("0"), &[])
}

/// The same at arbitrary angles.
fn bent_chain(n: usize) -> Scene {
    let angles: Vec<String> = (1..=n).map(|i| format!("theta{i}")).collect();
    chain_scene(n, |i| format!("theta{i}"), &angles)
}

fn chain_scene(n: usize, angle: impl Fn(usize) -> String, angles: &[String]) -> Scene {
    let mut parameters = vec![String::from(
        r#""m": {"unit": "kg"}, "l": {"unit": "m"}, "J": {"unit": "N s"}"#,
    )];
    parameters.extend(
        angles
            .iter()
            .map(|a| format!(r#""{a}": {{"unit": "rad", "domain": "real"}}"#)),
    );
    let mut points = vec![String::from(r#""A0": ["0", "0"]"#)];
    let mut bodies = Vec::new();
    let mut hinges = Vec::new();
    for i in 1..=n {
        let (a, before) = (angle(i), i - 1);
        points.push(format!(
            r#""A{i}": {{"from": "A{before}", "distance": "l", "angle": "{a}"}}"#
        ));
        bodies.push(format!(
            r#""rod{i}": {{"shape": "rod", "mass": "m", "length": "l", "angle": "{a}", "center": {{"from": "A{before}", "distance": "l/2", "angle": "{a}"}}}}"#
        ));
        if i > 1 {
            hinges.push(format!(
                r#""H{i}": {{"bodies": ["rod{before}", "rod{i}"], "at": "A{before}"}}"#
            ));
        }
    }
    let text = format!(
        r#"{{"title": "chain", "source": "bench", "parameters": {{{}}}, "points": {{{}}}, "bodies": {{{}}}, "hinges": {{{}}},
            "blows": {{"J": {{"on": "rod{n}", "at": "A{n}", "impulse": ["0", "J"]}}}},
            "questions": {{"omega": {{"spin": "rod{n}"}}}}}}"#,
        parameters.join(", "),
        points.join(", "),
        bodies.join(", "),
        hinges.join(", "),
    );
    read(&text).unwrap_or_else(|faults| panic!("{}", faults.render("chain", &text)))
}
