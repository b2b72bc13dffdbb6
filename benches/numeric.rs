//! What each numeric route to the motion after costs: `cargo bench --bench numeric`.
//!
//! Two free bodies in one frictionless contact, 7 equations in 7 unknowns, unless a name says otherwise. The benches in
//! `from_values` start from the same thing, the numbers of the scene as doubles, and end with the 7 unknowns: nalgebra
//! fills its matrix (written out by hand for this scene, which is the quickest), factors and solves; `certify` finds the
//! correctly rounded answers. `nalgebra_alone` is factoring and solving only, with the matrix given.

use carom::expr::number::{from_f64, to_f64};
use carom::expr::{Expr, Point, Rational};
use carom::numeric::ball::Ball;
use carom::numeric::certify::Certified;
use carom::numeric::dd::Dd;
use carom::numeric::given::GivenLaw;
use carom::numeric::{
    Given, System, Tier, assemble, certify, certify_into, eliminate, given, solve_dyadic,
    solve_exact, solve_f64,
};
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

/// Doubles of small integers, halves and quarters.
fn plain() -> Given<f64> {
    given(
        &two_bodies(|v| Expr::ratio((v * 4.0).ceil() as i64, 4)),
        &Point::default(),
    )
    .expect("numbers")
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

/// The matrix of two free bodies in one frictionless contact and its right side, by rows.
fn fill(given: &Given<f64>, mut put: impl FnMut(usize, usize, f64)) {
    let contact = &given.contacts[0];
    let (Some([nx, ny]), GivenLaw::Frictionless(e)) = (contact.normal, &contact.law) else {
        return;
    };
    let mut target = 0.0;
    for (b, body) in given.bodies.iter().enumerate() {
        let (row, sign) = (3 * b, if b == 0 { 1.0 } else { -1.0 });
        let arm = [0, 1].map(|i| contact.joint.at[i] - body.center[i]);
        let lever = arm[0] * ny - arm[1] * nx;
        let moments = [body.mass, body.mass, body.inertia];
        let before = [body.velocity[0], body.velocity[1], body.spin];
        for (i, along) in [nx, ny, lever].into_iter().enumerate() {
            put(row + i, row + i, moments[i]);
            put(row + i, 7, moments[i] * before[i]);
            put(row + i, 6, sign * along);
            put(6, row + i, -sign * along);
            target += sign * along * before[i];
        }
    }
    put(6, 7, e * target);
}

fn static_lu(given: &Given<f64>) -> Option<nalgebra::SVector<f64, 7>> {
    let mut matrix = nalgebra::SMatrix::<f64, 7, 7>::zeros();
    let mut right = nalgebra::SVector::<f64, 7>::zeros();
    fill(given, |r, c, v| match c {
        7 => right[r] = v,
        _ => matrix[(r, c)] = v,
    });
    matrix.lu().solve(&right)
}

fn dynamic_lu(given: &Given<f64>) -> Option<nalgebra::DVector<f64>> {
    let mut matrix = nalgebra::DMatrix::<f64>::zeros(7, 7);
    let mut right = nalgebra::DVector::<f64>::zeros(7);
    fill(given, |r, c, v| match c {
        7 => right[r] = v,
        _ => matrix[(r, c)] = v,
    });
    matrix.lu().solve(&right)
}

mod from_values {
    use super::*;

    #[divan::bench(sample_size = 100, sample_count = 500)]
    fn nalgebra_static(bencher: Bencher) {
        let numbers = doubles();
        let right = certify(&numbers).expect("certified").solution.values;
        let found = static_lu(&numbers).expect("regular");
        for (a, b) in found.iter().zip(right) {
            assert!((a - b).abs() <= 1e-14 * b.abs(), "the same unknowns");
        }
        bencher.bench(|| static_lu(black_box(&numbers)));
    }

    #[divan::bench(sample_size = 100, sample_count = 500)]
    fn nalgebra_dynamic(bencher: Bencher) {
        let numbers = doubles();
        bencher.bench(|| dynamic_lu(black_box(&numbers)));
    }

    #[divan::bench(sample_size = 100, sample_count = 500, args = FAMILIES.map(|f| f.0))]
    fn certify_family(bencher: Bencher, name: &str) {
        let numbers = family(name);
        let mut found = Certified::default();
        bencher.bench_local(|| certify_into(black_box(&numbers), &mut found));
    }

    #[divan::bench(sample_size = 20, sample_count = 500, args = FAMILIES.map(|f| f.0))]
    fn exact_family(bencher: Bencher, name: &str) {
        let numbers = family(name);
        assert!(solve_dyadic(&numbers).is_some());
        bencher.bench(|| solve_dyadic(black_box(&numbers)));
    }

    #[divan::bench(sample_size = 100)]
    fn certify_with_fresh_memory(bencher: Bencher) {
        let numbers = doubles();
        bencher.bench(|| certify(black_box(&numbers)));
    }
}

/// A change of the scene's doubles towards an extreme, and what tells its unknowns.
type Family = (&'static str, fn(&mut Given<f64>), Tier);

const FAMILIES: [Family; 11] = [
    ("ordinary", |_| (), Tier::Ball),
    ("mass ratio 1e15", |g| scale_mass(g, 1e15), Tier::Ball),
    ("mass ratio 1e-15", |g| scale_mass(g, 1e-15), Tier::Ball),
    ("arm 1e8", |g| g.bodies[1].center[0] *= 1e8, Tier::Ball),
    (
        "radius of gyration 1e-8",
        |g| g.bodies[1].inertia *= 1e-16,
        Tier::Ball,
    ),
    ("e = 1 - 1e-16", |g| restitution(g, 1.0 - 1e-16), Tier::Ball),
    ("e = 1e-300", |g| restitution(g, 1e-300), Tier::Ball),
    ("m v^2 of 1e300", |g| scale_speed(g, 1e150), Tier::Ball),
    ("grazing 1e-12", |g| graze(g, 1e-12), Tier::Ball),
    ("stops dead", stop, Tier::Exact),
    (
        "sticking, 8 unknowns",
        |g| g.contacts[0].law = GivenLaw::Sticking,
        Tier::Ball,
    ),
];

/// The scene of a family; what was to be shown about it is held.
fn family(name: &str) -> Given<f64> {
    let (_, change, tier) = FAMILIES
        .into_iter()
        .find(|f| f.0 == name)
        .expect("a family");
    let mut given = doubles();
    change(&mut given);
    let found = certify(&given).expect("certified");
    assert_eq!(found.tiers.iter().max(), Some(&tier), "{name}");
    given
}

fn scale_mass(given: &mut Given<f64>, by: f64) {
    given.bodies[1].mass *= by;
    given.bodies[1].inertia *= by;
}

fn scale_speed(given: &mut Given<f64>, by: f64) {
    for body in &mut given.bodies {
        body.velocity = body.velocity.map(|v| v * by);
        body.spin *= by;
    }
}

fn restitution(given: &mut Given<f64>, e: f64) {
    given.contacts[0].law = GivenLaw::Frictionless(e);
}

/// The plate moves with the disk but for a small approach.
fn graze(given: &mut Given<f64>, approach: f64) {
    let [disk, plate] = &mut given.bodies[..] else {
        return;
    };
    (disk.spin, plate.spin) = (0.0, 0.0);
    plate.velocity = [disk.velocity[0] * (1.0 - approach), disk.velocity[1]];
}

/// Equal masses, central and elastic: one body hands over all its motion.
fn stop(given: &mut Given<f64>) {
    restitution(given, 1.0);
    given.contacts[0].normal = Some([1.0, 0.0]);
    for body in &mut given.bodies {
        (body.mass, body.spin) = (1.3, 0.0);
        body.center[1] = given.contacts[0].joint.at[1];
    }
    given.bodies[0].velocity = [0.0, 0.0];
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
fn eliminate_double_double(bencher: Bencher) {
    let system = assemble(&doubles().map(|v| Dd::exact(*v)));
    bencher.bench(|| eliminate(black_box(&system)));
}

#[divan::bench]
fn assemble_and_eliminate_balls(bencher: Bencher) {
    let numbers = doubles();
    bencher.bench(|| eliminate(&assemble(&black_box(&numbers).map(|v| Ball::exact(*v)))));
}

#[divan::bench]
fn exact_dyadic_plain(bencher: Bencher) {
    let numbers = plain();
    assert!(solve_dyadic(&numbers).is_some());
    bencher.bench(|| solve_dyadic(black_box(&numbers)));
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
    let numbers = doubles().map(|v| from_f64(*v).expect("finite"));
    let system = assemble(&numbers);
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
