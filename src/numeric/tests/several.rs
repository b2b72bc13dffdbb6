//! Several contacts at once: known candidates, and what every candidate keeps.

use proptest::prelude::*;

use crate::expr::Point;
use crate::numeric::given;
use crate::numeric::several::{Candidate, Law, candidates};
use crate::scene::read;

/// Balls in a row: mass, velocity, and restitution towards the next one.
fn row(balls: &[(f64, f64, f64)]) -> Vec<Candidate> {
    let bodies = balls.iter().enumerate().map(|(i, (m, v, _))| {
        format!(r#""b{i}": {{"shape": "particle", "mass": "{m}", "center": [0, 0], "velocity": ["{v}", 0]}}"#)
    });
    let contacts = balls.iter().enumerate().skip(1).map(|(i, (_, _, e))| {
        format!(
            r#""c{i}": {{"bodies": ["b{}", "b{i}"], "at": [0, 0], "normal": "x", "law": "frictionless", "restitution": "{e}"}}"#,
            i - 1
        )
    });
    let text = format!(
        r#"{{"bodies": {{{}}}, "contacts": {{{}}}, "questions": {{"u": {{"velocity": "b0"}}}}}}"#,
        bodies.collect::<Vec<_>>().join(", "),
        contacts.collect::<Vec<_>>().join(", ")
    );
    let scene = read(&text).unwrap_or_else(|f| panic!("{}", f.render("row", &text)));
    let given = given(&scene, &Point::default()).expect("numbers everywhere");
    candidates(&given).expect("smooth contacts")
}

fn speeds(all: &[Candidate], law: &Law) -> Vec<f64> {
    let found = all.iter().find(|c| c.laws.contains(law));
    let found = found.unwrap_or_else(|| panic!("no candidate by {law:?}"));
    found.bodies.iter().map(|b| b[0]).collect()
}

#[test]
fn a_cradle_of_three_balls_moves_by_each_law_as_the_books_have_it() {
    let all = row(&[(1.0, 1.0, 1.0), (1.0, 0.0, 1.0), (1.0, 0.0, 1.0)]);
    let third = 1.0 / 3.0;
    // Springs between balls: F. Herrmann and M. Seitz, How does the ball-chain work?, Am. J. Phys. 50 (1982).
    let table: [(Law, [f64; 3]); 5] = [
        (Law::Newton, [-third, 2.0 * third, 2.0 * third]),
        (Law::Poisson, [-third, 2.0 * third, 2.0 * third]),
        (Law::Sequence(vec![0, 1]), [0.0, 0.0, 1.0]),
        (Law::LinearSprings, [-0.130, 0.150, 0.980]),
        (Law::HertzSprings, [-0.071, 0.076, 0.995]),
    ];
    for (law, expected) in table {
        let found = speeds(&all, &law);
        let close = found
            .iter()
            .zip(expected)
            .all(|(a, b)| (a - b).abs() < 6e-4);
        assert!(close, "{law:?}: {found:?}, not {expected:?}");
    }
}

#[test]
fn a_large_ball_throws_a_small_one_up_and_the_order_of_contacts_matters() {
    // A light ball on a heavy one, both falling at 1 onto the floor, which is a ball of enormous mass here.
    let all = row(&[(1e9, 0.0, 1.0), (1.0, -1.0, 1.0), (1e-6, -1.0, 1.0)]);
    let floor_first = speeds(&all, &Law::Sequence(vec![0, 1]));
    assert!((floor_first[2] - 3.0).abs() < 1e-4, "{floor_first:?}");
}

fn balls() -> impl Strategy<Value = Vec<(f64, f64, f64)>> {
    let ball = (0.1..10.0, -1.0..1.0, 0.0..=1.0);
    prop::collection::vec(ball, 3..6).prop_map(|mut all| {
        // Each ball catches up with the next one: bodies that part do not touch.
        let mut speeds: Vec<f64> = all.iter().map(|b| b.1).collect();
        speeds.sort_by(|a, b| b.total_cmp(a));
        for (ball, v) in all.iter_mut().zip(speeds) {
            ball.1 = v;
        }
        all
    })
}

proptest! {
    #[test]
    fn candidates_keep_momentum_open_contacts_and_make_no_energy(balls in balls()) {
        let all = row(&balls);
        let possible: Vec<&Candidate> = all.iter().filter(|c| c.is_possible()).collect();
        prop_assert!(!possible.is_empty());
        let momentum = |speeds: &mut dyn Iterator<Item = f64>| {
            balls.iter().zip(speeds).map(|((m, ..), v)| m * v).sum::<f64>()
        };
        let before = momentum(&mut balls.iter().map(|b| b.1));
        for candidate in &all {
            let after = momentum(&mut candidate.bodies.iter().map(|b| b[0]));
            prop_assert!((after - before).abs() < 1e-9, "{candidate:?}");
        }
        for candidate in possible {
            // Newton's and Poisson's laws may gain energy where coefficients differ; impacts one by one may not.
            let one_by_one = candidate.laws.iter().any(|l| matches!(l, Law::Sequence(_)));
            let [before, after] = candidate.energy;
            prop_assert!(!one_by_one || after <= before * (1.0 + 1e-9), "{candidate:?}");
        }
    }
}
