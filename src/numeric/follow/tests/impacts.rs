//! Impacts against the exact solver, balances over random impacts, supports, and where the laws leave something open or
//! contradict each other.

use super::*;
use crate::expr::number::to_f64;
use crate::numeric::tests::random::random_scene;
use crate::numeric::{Unknown, assemble, given, motion, solve_exact};

/// Random scenes with hinges, contacts of every law and blows.
const SEEDS: u64 = 400;

#[test]
fn random_impacts_agree_with_the_exact_solver_in_values_and_in_what_is_open() {
    let (mut open, mut contradictory) = (0, 0);
    for seed in 0..SEEDS {
        let scene = random_scene(seed);
        let exact = given(&scene, &Point::default()).expect("fractions");
        let system = assemble(&exact);
        let followed = follow(&scene, &Point::default()).expect("numbers");
        let solution = match (solve_exact(&system), &followed.stages[0]) {
            (
                Err(_),
                Err(Lost {
                    why: Loss::Contradiction(_),
                    ..
                }),
            ) => {
                contradictory += 1;
                continue;
            }
            (Ok(solution), Ok(_)) => solution,
            (told, found) => panic!("seed {seed}: {told:?} and {found:?}"),
        };
        let told = motion(&exact, &system, &solution);
        let passed = passed(&followed, 0);
        let mut held = |unknown: Unknown, told: f64, found: &Component, size: f64| {
            if !system.unknowns.contains(&unknown) {
                return;
            }
            let is_unique = !solution_is_loose(&solution.unique, &system.unknowns, unknown);
            assert_eq!(found.is_ok(), is_unique, "seed {seed}: {unknown:?}");
            match found {
                Ok(found) => assert!(
                    (found - told).abs() <= 1e-9 * size,
                    "seed {seed}: {unknown:?}: {found} instead of {told}"
                ),
                Err(_) => open += 1,
            }
        };
        let size = told
            .velocity
            .iter()
            .flatten()
            .chain(&told.spin)
            .map(|v| to_f64(v).abs());
        let size = size.fold(1.0, f64::max);
        for (b, body) in passed.after.bodies.iter().enumerate() {
            held(
                Unknown::Velocity(b, 0),
                to_f64(&told.velocity[b][0]),
                &body.velocity[0],
                size,
            );
            held(
                Unknown::Velocity(b, 1),
                to_f64(&told.velocity[b][1]),
                &body.velocity[1],
                size,
            );
            held(Unknown::Spin(b), to_f64(&told.spin[b]), &body.spin, size);
        }
        let What::Impact(impact) = &passed.what else {
            panic!("an impact")
        };
        let size = told
            .hinge
            .iter()
            .chain(&told.contact)
            .flatten()
            .map(|v| to_f64(v).abs());
        let size = size.fold(1.0, f64::max);
        for (i, p) in impact.hinges.iter().enumerate() {
            held(
                Unknown::Hinge(i, 0),
                to_f64(&told.hinge[i][0]),
                &p.impulse[0],
                size,
            );
            held(
                Unknown::Hinge(i, 1),
                to_f64(&told.hinge[i][1]),
                &p.impulse[1],
                size,
            );
        }
        for (i, p) in impact.contacts.iter().enumerate() {
            held(
                Unknown::Contact(i, 0),
                to_f64(&told.contact[i][0]),
                &p.impulse[0],
                size,
            );
            held(
                Unknown::Contact(i, 1),
                to_f64(&told.contact[i][1]),
                &p.impulse[1],
                size,
            );
        }
    }
    assert!(
        open > 0 && contradictory > 0,
        "{open} open, {contradictory} contradictory"
    );
}

fn solution_is_loose(unique: &[bool], unknowns: &[Unknown], unknown: Unknown) -> bool {
    unknowns
        .iter()
        .zip(unique)
        .any(|(u, unique)| *u == unknown && !unique)
}

#[test]
fn momentum_angular_momentum_and_energy_obey_their_laws_in_random_impacts() {
    for seed in 0..SEEDS {
        let scene = random_scene(seed);
        let followed = follow(&scene, &Point::default()).expect("numbers");
        let Ok(passed) = &followed.stages[0] else {
            continue;
        };
        let What::Impact(impact) = &passed.what else {
            panic!("an impact")
        };
        let joints = scene.hinges.iter().map(|h| (h.bodies, &h.at));
        let joints = joints.chain(scene.contacts.iter().map(|c| (c.bodies, &c.at)));
        let transmitted = impact.hinges.iter().chain(&impact.contacts);
        let mut acting: Vec<(usize, [f64; 2], [f64; 2])> = Vec::new();
        let mut is_known = true;
        for ((bodies, at), p) in joints.zip(transmitted) {
            let [Ok(x), Ok(y)] = p.impulse else {
                is_known = false;
                break;
            };
            let at = at
                .each_ref()
                .map(|e| e.evaluate(&Point::default()).expect("a number"));
            acting.push((bodies[1], at, [x, y]));
            acting.push((bodies[0], at, [-x, -y]));
        }
        for (blow, p) in scene.blows.iter().zip(&impact.blows) {
            let at = blow
                .at
                .each_ref()
                .map(|e| e.evaluate(&Point::default()).expect("a number"));
            let [Ok(x), Ok(y)] = p.impulse else {
                is_known = false;
                break;
            };
            acting.push((blow.body, at, [x, y]));
        }
        let is_known = is_known && passed.energy[1].is_ok();
        if !is_known {
            continue;
        }
        let size: f64 = 1.0
            + acting
                .iter()
                .map(|(_, _, p)| p[0].abs() + p[1].abs())
                .sum::<f64>();
        let mut work = 0.0;
        for (b, solid) in followed.solids.iter().enumerate() {
            let (before, after) = (&passed.before.bodies[b], &passed.after.bodies[b]);
            let [x, y, _, u0, v0, w0] = before.components().map(value_of);
            let [.., u, v, w] = after.components().map(value_of);
            let (mut momentum, mut moment) = ([0.0; 2], 0.0);
            for (_, at, p) in acting.iter().filter(|(on, ..)| *on == b) {
                let arm = match solid.freedom {
                    Freedom::Particle => [0.0; 2],
                    _ => [at[0] - x, at[1] - y],
                };
                momentum = [momentum[0] + p[0], momentum[1] + p[1]];
                moment += arm[0] * p[1] - arm[1] * p[0];
                // ΔT = ½ P·(u⁻ + u⁺), without subtracting energies.
                let mean = [
                    (u0 + u - (w0 + w) * arm[1]) / 2.0,
                    (v0 + v + (w0 + w) * arm[0]) / 2.0,
                ];
                if solid.freedom != Freedom::Fixed {
                    work += p[0] * mean[0] + p[1] * mean[1];
                }
            }
            if solid.freedom == Freedom::Fixed {
                continue;
            }
            assert!(
                (solid.mass * (u - u0) - momentum[0]).abs() < 1e-9 * size,
                "seed {seed}"
            );
            assert!(
                (solid.mass * (v - v0) - momentum[1]).abs() < 1e-9 * size,
                "seed {seed}"
            );
            if solid.freedom == Freedom::Rigid {
                assert!(
                    (solid.inertia * (w - w0) - moment).abs() < 1e-8 * size,
                    "seed {seed}"
                );
            }
        }
        let [before, after] = [0, 1].map(|k| value_of(&passed.energy[k]));
        assert!(
            (after - before - work).abs() < 1e-8 * (1.0 + before + after),
            "seed {seed}"
        );
        let wall = &scene.bodies[0];
        // Newton's law may gain energy at several contacts at once.
        let is_closed = scene.blows.is_empty()
            && scene.contacts.len() == 1
            && wall.velocity.iter().all(Expr::is_zero);
        if is_closed {
            assert!(
                after <= before * (1.0 + 1e-9),
                "seed {seed}: {before} J become {after} J"
            );
        }
    }
}

/// A plank of mass 1 and length 6 that comes down level with the spin `w` on supports at these places.
fn landed(places: &[f64], w: f64) -> Result<Passed, Lost> {
    let supports: Vec<String> = places
        .iter()
        .enumerate()
        .map(|(i, x)| format!(r#""S{i}": {{"bodies": ["ground", "plank"], "at": ["{x}", "0"], "normal": ["0", "1"]}}"#))
        .collect();
    let scene = read(&format!(
        r#"{{"title": "t", "parameters": {{"w": {{"unit": "rad/s", "domain": "real"}}}},
        "bodies": {{"ground": {{"shape": "fixed"}},
            "plank": {{"shape": "rod", "mass": "1", "length": "6", "center": ["0", "0"], "velocity": ["0", "-1"], "spin": "w"}}}},
        "stages": [{{"name": "landing", "impact": {{"supports": {{{}}}}}}}],
        "questions": {{"omega": {{"at": "landing", "spin": "plank"}}}}}}"#,
        supports.join(", ")
    ));
    let mut followed = follow(&scene, &point(&[("w", w)])).expect("numbers");
    followed.stages.remove(0)
}

fn acting(passed: &Passed) -> Vec<Vec<&str>> {
    let What::Impact(impact) = &passed.what else {
        panic!("an impact")
    };
    impact
        .acting
        .iter()
        .map(|set| set.iter().map(String::as_str).collect())
        .collect()
}

#[test]
fn supports_act_where_they_have_to() {
    let passed = landed(&[-1.0, 1.0], 0.0).expect("it lands");
    assert_eq!(acting(&passed), [["S0", "S1"]]);
    let plank = &passed.after.bodies[1];
    assert!(value_of(&plank.velocity[1]).abs() < 1e-14);
    let What::Impact(impact) = &passed.what else {
        panic!("an impact")
    };
    close(value_of(&impact.contacts[0].impulse[1]), 0.5, 1e-12);
    // Turning clockwise it comes down on the right support and leaves the left one: I about it is 3 + 1, and 1 − 4·… stays.
    let passed = landed(&[-1.0, 1.0], -3.0).expect("it lands");
    assert_eq!(acting(&passed), [["S1"]]);
    let spin = (3.0 * -3.0 + 1.0 * 1.0) / (3.0 + 1.0);
    close(value_of(&passed.after.bodies[1].spin), spin, 1e-12);
    assert!(impact_of(&passed).breaches.is_empty());
}

fn impact_of(passed: &Passed) -> &Impact {
    match &passed.what {
        What::Impact(impact) => impact,
        What::Motion(_) => panic!("an impact"),
    }
}

#[test]
fn with_a_support_too_many_the_motion_is_known_and_the_impulses_are_not() {
    let passed = landed(&[-1.0, 0.0, 1.0], 0.0).expect("it lands");
    let plank = &passed.after.bodies[1];
    assert!(value_of(&plank.velocity[1]).abs() < 1e-14);
    assert!(value_of(&plank.spin).abs() < 1e-14);
    assert!(acting(&passed).len() > 1);
    let impulse = &impact_of(&passed).contacts[1].impulse[1];
    assert_eq!(impulse.clone().expect_err("not known").why, Why::Supports);
}

/// Two stages of a bar that is struck by a ball; `second` follows the collision.
fn two_stages(contact: &str, second: &str) -> Followed {
    let scene = read(&format!(
        r#"{{"title": "t", "points": {{"P": ["0", "0"]}},
        "bodies": {{"ground": {{"shape": "fixed", "center": ["0", "3"]}},
            "ball": {{"shape": "particle", "mass": "2", "center": "P", "velocity": ["3", "1"]}},
            "bar": {{"shape": "rod", "mass": "6", "length": "2", "angle": "pi/2", "center": ["0", "1"]}}}},
        "stages": [{{"name": "hit", "impact": {{"contacts": {{"P": {{"bodies": ["ball", "bar"], "at": "P"{contact}}}}}}}}},
            {{"name": "next", {second}}}],
        "questions": {{"omega": {{"at": "next", "spin": "bar"}}}}}}"#
    ));
    follow(&scene, &Point::default()).expect("numbers")
}

#[test]
fn what_an_impact_leaves_open_stays_open_and_the_rest_goes_on() {
    let followed = two_stages("", r#""fall": {"body": "bar", "for": "2"}"#);
    for component in passed(&followed, 0).after.bodies[2]
        .components()
        .into_iter()
        .skip(3)
    {
        assert_eq!(
            component.clone().expect_err("no law closes it").why,
            Why::Laws
        );
    }
    let bar = &passed(&followed, 1).after.bodies[2];
    let whys: Vec<Option<Why>> = bar
        .components()
        .map(|c| c.as_ref().err().map(|o| o.why))
        .to_vec();
    assert_eq!(whys, [Some(Why::Needed); 6]);
    // Nothing pushes along y without friction: v_y of the ball is known, and so is where it flies.
    let smooth = r#", "law": "frictionless", "restitution": "1/2", "normal": ["1", "0"]"#;
    let followed = two_stages(smooth, r#""fall": {"body": "bar", "for": "2"}"#);
    let ball = &passed(&followed, 1).after.bodies[1];
    close(value_of(&ball.center[1]), 2.0, 1e-12);
    // Bodies that collide so: W = 1/2 + 1/6 + 1/2 along the normal, P = 3(1 + 1/2)/W.
    let push = 4.5 / (0.5 + 1.0 / 6.0 + 0.5);
    let bar = &passed(&followed, 1).after.bodies[2];
    close(value_of(&bar.center[0]), 2.0 * push / 6.0, 1e-12);
    close(value_of(&bar.spin), push / 2.0, 1e-12);
    close(value_of(&bar.angle), PI / 2.0 + push, 1e-12);
    assert!(value_of(&passed(&followed, 1).energy[1]) < 10.0);
}

#[test]
fn an_open_velocity_does_not_spoil_what_does_not_depend_on_it() {
    // After a collision without a law the ball sticks to the ground: at rest, whatever it did before.
    let stop = r#""impact": {"contacts": {"Q": {"bodies": ["ground", "ball"], "at": "ball", "law": "sticking"}}}"#;
    let followed = two_stages("", stop);
    let ball = &passed(&followed, 1).after.bodies[1];
    assert!(ball.velocity.iter().all(|v| value_of(v).abs() < 1e-12));
    let impact = impact_of(passed(&followed, 1));
    assert_eq!(
        impact.contacts[0].impulse[0].clone().expect_err("open").why,
        Why::Needed
    );
    assert!(passed(&followed, 1).after.bodies[2].spin.is_err());
}

#[test]
fn a_body_that_sticks_is_not_left_behind_silently() {
    let sticks = r#", "law": "sticking""#;
    let followed = two_stages(sticks, r#""fall": {"body": "bar", "for": "2"}"#);
    let ball = &passed(&followed, 1).after.bodies[1];
    assert_eq!(
        ball.center[0].clone().expect_err("it is carried along").why,
        Why::Joined
    );
    // Where gravity is named and nothing is said of the other body, nobody knows.
    let smooth = r#", "law": "frictionless", "restitution": "1", "normal": ["1", "0"]"#;
    let followed = two_stages(
        smooth,
        r#""fall": {"body": "bar", "for": "2", "gravity": "10"}"#,
    );
    let ball = &passed(&followed, 1).after.bodies[1];
    assert_eq!(
        ball.center[0].clone().expect_err("nobody says").why,
        Why::Forces
    );
}

#[test]
fn a_contradictory_impact_ends_the_scene_there() {
    let hit = r#", "law": "sticking""#;
    let against = r#""impact": {"contacts": {"Q": {"bodies": ["ground", "bar"], "at": "bar", "law": "sticking"}},
        "after": [{"spin": "bar", "is": "3"}, {"spin": "bar", "is": "4"}]}"#;
    let followed = two_stages(hit, against);
    assert!(followed.stages[0].is_ok());
    let lost = followed.stages[1].as_ref().expect_err("3 is not 4");
    assert!(matches!(lost.why, Loss::Contradiction(_)), "{lost}");
    assert_eq!(lost.stage, "next");
}

#[test]
fn a_rod_that_flies_to_a_peg_and_catches_it_turns_with_three_halves_of_its_speed() {
    let mut scene = read(
        r#"{"title": "t", "parameters": {"l": {"unit": "m"}, "v": {"unit": "m/s"}, "D": {"unit": "m"}},
        "bodies": {"peg": {"shape": "fixed"},
            "rod": {"shape": "rod", "mass": "1", "length": "l", "angle": "pi/2", "center": ["-D", "-l/2"], "velocity": ["v", "0"]}},
        "stages": [{"name": "flight", "fall": {"body": "rod", "for": "D/v"}},
            {"name": "catch", "impact": {"contacts": {"C": {"bodies": ["peg", "rod"], "at": ["-D", "0"], "law": "sticking"}}}}],
        "questions": {"omega": {"at": "catch", "spin": "rod"}}}"#,
    );
    scene.stages[1].scene.contacts[0].at = [Expr::zero(), Expr::zero()];
    let (l, v) = (0.7, 3.0);
    let followed = follow(&scene, &point(&[("l", l), ("v", v), ("D", 5.0)])).expect("numbers");
    close(
        value_of(&passed(&followed, 1).after.bodies[1].spin),
        3.0 * v / (2.0 * l),
        1e-12,
    );
}

#[test]
fn bodies_that_part_or_pull_are_told() {
    let apart = |v: &str| {
        let scene = read(&format!(
            r#"{{"title": "t", "bodies": {{"wall": {{"shape": "fixed"}},
                "ball": {{"shape": "particle", "mass": "1", "center": ["0", "0"], "velocity": ["-1", "0"]}}}},
            "stages": [{{"name": "go", "fall": {{"body": "ball", "for": "1"}}}},
                {{"name": "hit", "impact": {{"contacts": {{"C": {{"bodies": ["wall", "ball"], "at": "ball", "normal": ["{v}", "0"],
                    "law": "frictionless", "restitution": "1"}}}}}}}}],
            "questions": {{"u": {{"at": "hit", "velocity": "ball"}}}}}}"#
        ));
        let followed = follow(&scene, &Point::default()).expect("numbers");
        impact_of(passed(&followed, 1)).breaches.clone()
    };
    assert_eq!(apart("1"), []);
    let name = || String::from("C");
    assert_eq!(
        apart("-1"),
        [
            Breach::Separates(name()),
            Breach::Pulls(name()),
            Breach::Enters(name())
        ]
    );
}
