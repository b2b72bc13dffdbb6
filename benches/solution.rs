//! Writing a worked solution, and printing it in every format, beside deriving and proving the same scene in the same run:
//! printing should cost less than deriving.

use carom::derive::derive;
use carom::render::{html, latex_document, markdown, plain, steps};
use carom::scene::{Scene, read};
use carom::solution::{self, Detail, Solution};
use carom::story::tell;
use carom::verify::prove;

const SCENES: [&str; 4] = [
    "book/falling-stick",
    "book/ball-hits-bat",
    "book/flying-dish",
    "book/two-bodies-frictionless",
];

fn main() {
    divan::main();
}

fn scene(name: &str) -> (Scene, String) {
    let text =
        std::fs::read_to_string(format!("derivations/{name}.json")).expect("a shipped scene");
    let scene = read(&text).unwrap_or_else(|_| panic!("{name} does not read"));
    (scene, text)
}

fn written(scene: &Scene) -> Solution {
    let told = tell(scene).expect("told");
    solution::write(scene, &told, Detail::Normal)
}

#[divan::bench(args = SCENES)]
fn deriving(bencher: divan::Bencher, name: &str) {
    let (scene, _) = scene(name);
    bencher.bench(|| derive(divan::black_box(&scene)).is_ok());
}

#[divan::bench(args = SCENES)]
fn deriving_and_proving(bencher: divan::Bencher, name: &str) {
    let (scene, _) = scene(name);
    bencher.bench(|| {
        let derivation = derive(divan::black_box(&scene)).expect("derived");
        prove(&scene, &derivation).holds()
    });
}

#[divan::bench(args = SCENES)]
fn writing(bencher: divan::Bencher, name: &str) {
    let (scene, _) = scene(name);
    let told = tell(&scene).expect("told");
    bencher.bench(|| solution::write(&scene, &told, Detail::Normal));
}

#[divan::bench(args = SCENES)]
fn printing_text(bencher: divan::Bencher, name: &str) {
    let solution = written(&scene(name).0);
    bencher.bench(|| plain::solution(&solution));
}

#[divan::bench(args = SCENES)]
fn printing_markdown(bencher: divan::Bencher, name: &str) {
    let solution = written(&scene(name).0);
    bencher.bench(|| markdown::solution(&solution, &[]));
}

#[divan::bench(args = SCENES)]
fn printing_latex(bencher: divan::Bencher, name: &str) {
    let solution = written(&scene(name).0);
    bencher.bench(|| latex_document::document(&solution, &[]));
}

#[divan::bench(args = SCENES)]
fn printing_html(bencher: divan::Bencher, name: &str) {
    let solution = written(&scene(name).0);
    bencher.bench(|| html::page(&solution, &[]));
}

#[divan::bench(args = SCENES)]
fn printing_json(bencher: divan::Bencher, name: &str) {
    let (scene, text) = scene(name);
    let solution = written(&scene);
    bencher.bench(|| steps::solution(&solution, &text, &[]).to_string());
}
