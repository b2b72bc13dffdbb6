//! Random whole scenes: flights, impacts and rotations in any order, each stage held against laws that it did not use.

use super::*;
use crate::numeric::tests::random::Dice;

const COURSES: u64 = 150;
const GRAVITY: f64 = 9.0;

/// What a stage is, for the laws it is held against.
enum Kind {
    Flight {
        body: usize,
        gravity: f64,
        time: f64,
    },
    /// Indices of the bodies at the contact, and its restitution where it has one.
    Impact {
        bodies: [usize; 2],
        restitution: Option<f64>,
    },
    Turn {
        body: usize,
        gravity: f64,
    },
}

/// A scene of ground and two bodies with two to five stages.
fn course(dice: &mut Dice) -> (String, Vec<Kind>) {
    let mut number = |low: i64, high: i64| {
        let numerator = low * 4 + dice.below((4 * (high - low) + 1) as u64) as i64;
        (format!("{numerator}/4"), numerator as f64 / 4.0)
    };
    let bodies: Vec<String> = ["A", "B"]
        .iter()
        .map(|name| {
            let [m, i, x, y, u, v, w] = [(1, 5), (1, 4), (-4, 4), (-4, 4), (-5, 5), (-5, 5), (-3, 3)]
                .map(|(low, high)| number(low, high).0);
            format!(
                r#""{name}": {{"shape": "body", "mass": "{m}", "inertia": "{i}", "center": ["{x}", "{y}"], "velocity": ["{u}", "{v}"], "spin": "{w}"}}"#
            )
        })
        .collect();
    let (mut stages, mut kinds) = (Vec::new(), Vec::new());
    let count = 2 + number(0, 3).1 as usize;
    let mut held: Option<(usize, String)> = None;
    for k in 0..count {
        let body = 1 + usize::from(number(0, 1).1 > 0.5);
        let name = ["", "A", "B"][body];
        let gravity = if number(0, 1).1 > 0.5 { GRAVITY } else { 0.0 };
        let weight = if gravity > 0.0 {
            format!(r#", "gravity": "{gravity}""#)
        } else {
            String::new()
        };
        let what = match (&held, number(0, 3).1 as u32) {
            (Some((held, place)), 0 | 1) => {
                kinds.push(Kind::Turn {
                    body: *held,
                    gravity,
                });
                let name = ["", "A", "B"][*held];
                let by = number(0, 2).0;
                format!(
                    r#""turn": {{"body": "{name}", "about": {place}, "by": "{by}" SENSE{weight}}}"#
                )
            }
            (_, 0 | 1) => {
                let (text, time) = number(0, 2);
                kinds.push(Kind::Flight {
                    body,
                    gravity,
                    time,
                });
                format!(r#""fall": {{"body": "{name}", "for": "{text}"{weight}}}"#)
            }
            (_, which) => {
                let other = if which == 2 { 0 } else { 3 - body };
                let place = format!(
                    r#"{{"from": "{name}", "distance": "{}", "angle": "{}"}}"#,
                    number(1, 2).0,
                    number(-3, 3).0
                );
                let (e, restitution) = number(0, 1);
                let sticks = number(0, 1).1 > 0.5;
                let law = match sticks {
                    true => String::from(r#""law": "sticking""#),
                    false => format!(
                        r#""law": "frictionless", "restitution": "{e}", "normal": ["3/5", "4/5"]"#
                    ),
                };
                kinds.push(Kind::Impact {
                    bodies: [other, body],
                    restitution: (!sticks).then_some(restitution),
                });
                held = (sticks && other == 0).then(|| (body, place.clone()));
                let other = ["ground", "A", "B"][other];
                format!(
                    r#""impact": {{"contacts": {{"C{k}": {{"bodies": ["{other}", "{name}"], "at": {place}, {law}}}}}}}"#
                )
            }
        };
        if !what.starts_with("\"impact\"") {
            held = None;
        }
        stages.push(format!(
            r#"{{"name": "s{k}", {}}}"#,
            what.replace(" SENSE", "")
        ));
    }
    let text = format!(
        r#"{{"title": "t", "bodies": {{"ground": {{"shape": "fixed"}}, {}}}, "stages": [{}],
        "questions": {{"w": {{"at": "s0", "spin": "A"}}}}}}"#,
        bodies.join(", "),
        stages.join(", ")
    );
    (text, kinds)
}

#[test]
fn every_stage_of_a_random_course_obeys_laws_it_did_not_use() {
    let mut seen = [0; 3];
    for seed in 0..COURSES {
        let (text, kinds) = course(&mut Dice::new(seed));
        let scene = read(&text);
        let followed = follow(&scene, &Point::default()).expect("numbers");
        for (k, (stage, kind)) in followed.stages.iter().zip(&kinds).enumerate() {
            let passed = match stage {
                Ok(passed) => passed,
                Err(Lost {
                    why: Loss::NeverEnds(_) | Loss::After(_),
                    ..
                }) => break,
                // At rest and without weight nothing says which way a body turns.
                Err(Lost {
                    why: Loss::Contradiction(_),
                    ..
                }) if matches!(kind, Kind::Turn { .. }) => break,
                // A formula that needs a place which is open has no value.
                Err(Lost {
                    why: Loss::Undefined(_),
                    ..
                }) if k > 0 => break,
                Err(lost) => panic!("seed {seed}, stage {k}: {lost}\n{text}"),
            };
            if let (true, Ok(last)) = (k > 0, &followed.stages[k.saturating_sub(1)]) {
                assert_eq!(
                    last.after, passed.before,
                    "seed {seed}: the state is handed on"
                );
            }
            let index = match kind {
                Kind::Flight {
                    body,
                    gravity,
                    time,
                } => {
                    flight_fits(passed, *body, *gravity, *time);
                    0
                }
                Kind::Impact {
                    bodies,
                    restitution,
                } => {
                    impact_fits(&followed, passed, *bodies, *restitution);
                    1
                }
                Kind::Turn { body, gravity } => {
                    turn_fits(&followed, passed, *body, *gravity);
                    2
                }
            };
            seen[index] += 1;
        }
    }
    assert!(
        seen.iter().all(|count| *count > 10),
        "{seen:?} flights, impacts, turns"
    );
}

/// All six components, where they are known.
fn known(body: &BodyState) -> Option<[f64; 6]> {
    body.known().ok()
}

fn near(found: f64, expected: f64, size: f64) {
    assert!(
        (found - expected).abs() <= 1e-8 * (1.0 + size),
        "{found} instead of {expected}"
    );
}

fn flight_fits(passed: &Passed, body: usize, gravity: f64, time: f64) {
    let states = [&passed.before, &passed.after].map(|s| known(&s.bodies[body]));
    let [Some([x, y, angle, u, v, w]), Some(after)] = states else {
        return;
    };
    let expected = [
        x + u * time,
        y + v * time - gravity * time * time / 2.0,
        angle + w * time,
        u,
        v - gravity * time,
        w,
    ];
    for (found, expected) in after.into_iter().zip(expected) {
        near(found, expected, expected.abs());
    }
}

fn turn_fits(followed: &Followed, passed: &Passed, body: usize, gravity: f64) {
    let states = [&passed.before, &passed.after].map(|s| known(&s.bodies[body]));
    let [Some(before), Some(after)] = states else {
        return;
    };
    let solid = &followed.solids[body];
    let energy = |s: &[f64; 6]| {
        let kinetic = solid.mass * (s[3] * s[3] + s[4] * s[4]) + solid.inertia * s[5] * s[5];
        kinetic / 2.0 + solid.mass * gravity * s[1]
    };
    near(
        energy(&after),
        energy(&before),
        energy(&before).abs() + solid.mass * gravity,
    );
    // The velocity is that of a rotation: the point that rests stays where it was.
    let resting = |s: &[f64; 6]| [s[0] - s[4] / s[5], s[1] + s[3] / s[5]];
    if before[5].abs() > 0.1 && after[5].abs() > 0.1 {
        let (was, is) = (resting(&before), resting(&after));
        near(is[0], was[0], 10.0 + was[0].abs());
        near(is[1], was[1], 10.0 + was[1].abs());
    }
}

fn impact_fits(followed: &Followed, passed: &Passed, bodies: [usize; 2], restitution: Option<f64>) {
    let What::Impact(impact) = &passed.what else {
        panic!("an impact")
    };
    let [Ok(px), Ok(py)] = &impact.contacts[0].impulse else {
        return;
    };
    for (body, sign) in [(bodies[1], 1.0), (bodies[0], -1.0)] {
        let states = [&passed.before, &passed.after].map(|s| known(&s.bodies[body]));
        let ([Some(before), Some(after)], false) = (states, body == 0) else {
            continue;
        };
        let mass = followed.solids[body].mass;
        near(
            mass * (after[3] - before[3]),
            sign * px,
            px.abs() + mass * before[3].abs(),
        );
        near(
            mass * (after[4] - before[4]),
            sign * py,
            py.abs() + mass * before[4].abs(),
        );
        assert_eq!(before[..3], after[..3], "nothing moves during an impact");
    }
    if let (Some(e), Some(opening)) = (restitution, impact.openings.first())
        && let (Ok(before), Ok(after)) = (&opening.before, &opening.after)
    {
        near(*after, -e * before, before.abs());
        near(*px * 4.0, *py * 3.0, px.abs());
    }
    if let [Ok(before), Ok(after)] = &passed.energy {
        assert!(
            *after <= before * (1.0 + 1e-9),
            "{before} J become {after} J"
        );
    }
}
