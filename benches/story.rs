//! From a scene with stages to its proved story and its worked solution, in process: each median should stay below 20 ms,
//! integration in time apart. With `--no-default-features` nothing is integrated, so the difference is what that costs.

use carom::render::markdown;
use carom::scene::{Scene, read};
use carom::solution::{self, Detail};
use carom::story::tell;

const SCENES: [&str; 10] = [
    "acrobat-to-handstand",
    "baseball-bat",
    "blocks-struck-from-above",
    "crude-see-saw",
    "dumbbell-strikes-edge",
    "gymnast-between-bars",
    "hanging-mass-is-hit",
    "skater-on-a-rope",
    "tipping-box",
    "tumbling-rod-catches-peg",
];

fn main() {
    divan::main();
}

fn scene(name: &str) -> Scene {
    let path = format!("derivations/problems/{name}.json");
    let text = std::fs::read_to_string(path).expect("a shipped scene");
    read(&text).unwrap_or_else(|_| panic!("{name} does not read"))
}

#[divan::bench(args = SCENES)]
fn telling(bencher: divan::Bencher, name: &str) {
    let scene = scene(name);
    bencher.bench(|| tell(divan::black_box(&scene)).is_ok_and(|t| t.holds()));
}

#[divan::bench(args = SCENES)]
fn writing(bencher: divan::Bencher, name: &str) {
    let scene = scene(name);
    let told = tell(&scene).expect("a story that fits");
    bencher.bench(|| {
        let solution = solution::write(&scene, &told, Detail::Normal);
        markdown::solution(&solution, &[]).len()
    });
}
