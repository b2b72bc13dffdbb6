//! One contact with friction: followed in doubles, and its table of cases derived and proved.

use carom::derive::friction::table;
use carom::numeric::path::follow;
use carom::scene::{ContactSpace, Friction, Hypothesis, Scene, read};
use carom::verify::friction::judge;
use carom::{derive, verify};

fn main() {
    divan::main();
}

const LAWS: [&str; 3] = ["Newton", "Poisson", "Stronge"];

/// A rod at 53° that sticks in restitution: every kind of event lies on its path.
fn contact(law: &str) -> (ContactSpace<f64>, Friction<f64>) {
    let hypothesis = match law {
        "Newton" => Hypothesis::Newton,
        "Poisson" => Hypothesis::Poisson,
        _ => Hypothesis::Stronge,
    };
    let space = ContactSpace {
        a: 2.92,
        b: -1.44,
        c: 2.08,
        tangential: -1.0,
        normal: -1.0,
    };
    let law = Friction {
        mu: 0.8,
        restitution: 0.5,
        hypothesis,
        supposing: None,
    };
    (space, law)
}

#[divan::bench(args = LAWS)]
fn one_contact_in_doubles(bencher: divan::Bencher, law: &str) {
    let (space, law) = contact(law);
    bencher.bench(|| follow(divan::black_box(&space), divan::black_box(&law)));
}

fn rod() -> Scene {
    let text = std::fs::read_to_string("derivations/friction/rod-slides-into-floor.json");
    let mut scene = read(&text.expect("the scene")).expect("a scene");
    scene.questions.retain(|q| q.ask.is_motion());
    scene
}

#[divan::bench]
fn table_of_cases(bencher: divan::Bencher) {
    let scene = rod();
    bencher.bench(|| table(divan::black_box(&scene)));
}

#[divan::bench]
fn table_derived_and_proved(bencher: divan::Bencher) {
    let scene = rod();
    bencher.bench(|| {
        let table = table(divan::black_box(&scene))
            .expect("a table")
            .expect("friction");
        for case in &table.cases {
            let derivation = derive::derive(&case.scene).expect("closed forms");
            divan::black_box(verify::prove(&case.scene, &derivation));
        }
    });
}

#[divan::bench]
fn table_against_the_path(bencher: divan::Bencher) {
    let scene = rod();
    let table = table(&scene).expect("a table").expect("friction");
    bencher.bench(|| judge(divan::black_box(&scene), &table));
}
