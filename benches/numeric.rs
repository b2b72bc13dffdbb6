//! What each numeric route to the motion after costs: `cargo bench --bench numeric`.
//!
//! Two free bodies in one frictionless contact, 7 equations in 7 unknowns, unless a name says otherwise. `nalgebra_alone`
//! is factoring and solving only, with the matrix given; `correctly_rounded` is all that `carom solve --certify` does.

use carom::expr::number::{from_f64, to_f64};
use carom::expr::{Expr, Point, Rational};
use carom::interval::{Big, Certified, Outcome};
use carom::numeric::{Given, System, assemble, correct, eliminate, given, solve_exact, solve_f64};
use carom::scene::{Blow, BlowImpulse, Body, Contact, ContactLaw, Hinge, Scene, Shape};
use divan::{Bencher, black_box};

fn main() {
    divan::main();
}

fn body(
    shape: Shape,
    mass: Expr,
    inertia: Expr,
    center: [Expr; 2],
    velocity: [Expr; 2],
    spin: Expr,
) -> Body {
    Body {
        name: "body".into(),
        shape,
        mass,
        inertia,
        inertia_given: true,
        center,
        angle: Expr::zero(),
        velocity,
        spin,
    }
}

fn two_bodies(n: impl Fn(f64) -> Expr) -> Scene {
    let disk = body(
        Shape::Other,
        n(1.3),
        n(0.07),
        [n(-0.31), n(0.02)],
        [n(1.1), n(-0.2)],
        n(-5.3),
    );
    let plate = body(
        Shape::Other,
        n(2.1),
        n(0.83),
        [n(0.49), n(-0.81)],
        [n(-10.7), n(0.3)],
        n(0.9),
    );
    let law = ContactLaw::Frictionless {
        restitution: n(0.9),
    };
    let normal = Some([n(0.8), n(0.6)]);
    let contact = Contact {
        name: "C".into(),
        bodies: [0, 1],
        at: [n(0.03), n(0.01)],
        normal,
        law,
        passes: false,
        is_string: false,
    };
    Scene {
        bodies: vec![disk, plate],
        contacts: vec![contact],
        ..Scene::default()
    }
}

/// Textbook numbers: 0.31 is 31/100.
fn textbook() -> Scene {
    two_bodies(|v| Expr::ratio((v * 100.0).round() as i64, 100))
}

/// The doubles nearest to them, and what 53 digits of their like cost.
fn doubles() -> Given<f64> {
    let near = |v: f64| Expr::from(from_f64(v).expect("finite"));
    given(&two_bodies(near), &Point::default()).expect("numbers")
}

fn exact_given() -> Given<Rational> {
    given(&textbook(), &Point::default()).expect("numbers")
}

fn chain(count: i64) -> System<Rational> {
    let n = Expr::from;
    let zero = || [n(0), n(0)];
    let mut bodies = vec![body(Shape::Fixed, n(0), n(0), zero(), zero(), n(0))];
    let mut scene = Scene::default();
    for i in 0..count {
        let shape = Shape::Rod { length: n(1) };
        bodies.push(body(
            shape,
            n(1),
            Expr::ratio(1, 12),
            [Expr::ratio(2 * i + 1, 2), n(0)],
            zero(),
            n(0),
        ));
        if i > 0 {
            let i_body = i as usize;
            scene.hinges.push(Hinge {
                name: "H".into(),
                bodies: [i_body, i_body + 1],
                at: [n(i), n(0)],
            });
        }
    }
    let impulse = BlowImpulse::Given([n(0), n(1)]);
    scene.blows.push(Blow {
        name: "Q".into(),
        body: count as usize,
        at: [n(count), n(0)],
        impulse,
    });
    scene.bodies = bodies;
    assemble(&given(&scene, &Point::default()).expect("numbers"))
}

mod nalgebra_alone {
    use super::*;

    #[divan::bench]
    fn static_size(bencher: Bencher) {
        let system = assemble(&doubles());
        let matrix = nalgebra::SMatrix::<f64, 7, 7>::from_row_slice(&system.matrix);
        let right = nalgebra::SVector::<f64, 7>::from_row_slice(&system.right);
        bencher.bench(|| black_box(matrix).lu().solve(black_box(&right)));
    }

    #[divan::bench]
    fn dynamic_size(bencher: Bencher) {
        let system = assemble(&doubles());
        let matrix = nalgebra::DMatrix::<f64>::from_row_slice(7, 7, &system.matrix);
        let right = nalgebra::DVector::<f64>::from_row_slice(&system.right);
        bencher.bench(|| black_box(&matrix).clone().lu().solve(black_box(&right)));
    }
}

#[divan::bench]
fn evaluate_scene_f64(bencher: Bencher) {
    let (scene, at) = (textbook(), Point::<f64>::default());
    bencher.bench(|| given(black_box(&scene), &at));
}

#[divan::bench]
fn assemble_f64(bencher: Bencher) {
    let numbers = doubles();
    bencher.bench(|| assemble(black_box(&numbers)));
}

#[divan::bench]
fn solve_f64_scaled_lu(bencher: Bencher) {
    let system = assemble(&doubles());
    bencher.bench(|| solve_f64(black_box(&system)));
}

#[divan::bench]
fn eliminate_enclosures_of_256_bits(bencher: Bencher) {
    let system = assemble(&exact_given());
    let system = system.map(|v| Outcome::Value(Big::<256>::from_rational(v)));
    assert!(eliminate(&system).is_some());
    bencher.bench(|| eliminate(black_box(&system)));
}

#[divan::bench]
fn correctly_rounded(bencher: Bencher) {
    let scene = textbook();
    bencher.bench(|| correct(black_box(&scene)));
}

#[divan::bench]
fn exact_textbook_solve(bencher: Bencher) {
    let system = assemble(&exact_given());
    bencher.bench(|| solve_exact(black_box(&system)));
}

#[divan::bench]
fn exact_textbook_assemble(bencher: Bencher) {
    let numbers = exact_given();
    bencher.bench(|| assemble(black_box(&numbers)));
}

#[divan::bench]
fn exact_from_53_bit_fractions(bencher: Bencher) {
    let system = assemble(&doubles()).map(|v| from_f64(*v).expect("finite"));
    bencher.bench(|| solve_exact(black_box(&system)));
}

#[divan::bench(args = [2, 4, 8])]
fn chain_exact(bencher: Bencher, count: i64) {
    let system = chain(count);
    bencher.bench(|| solve_exact(black_box(&system)));
}

#[divan::bench(args = [2, 4, 8])]
fn chain_f64(bencher: Bencher, count: i64) {
    let system = chain(count).map(to_f64);
    bencher.bench(|| solve_f64(black_box(&system)));
}
