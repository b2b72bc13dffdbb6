//! Every scene that has an answer gets it, however far apart its masses and however large or small its units.

use proptest::prelude::*;

use super::random::{Dice, random_scene};
use super::*;
use crate::expr::number::to_f64;
use crate::expr::{Expr, Int, Vector};
use crate::interval::{Big, Certified, Outcome};
use crate::scene::{Ask, BlowImpulse, ImpulseAt, Question};

/// Ten to a power, for each body, and for all lengths and times.
struct Scales {
    mass: Vec<i32>,
    length: i32,
    time: i32,
}

fn ten(power: i32) -> Expr {
    let size = Expr::from(Rational::from(Int::from(10).pow(power.unsigned_abs())));
    if power < 0 { size.powi(-1) } else { size }
}

/// A random scene at other scales, asked for every motion and every impulse.
fn scaled(seed: u64, scales: &Scales) -> Scene {
    let mut scene = random_scene(seed);
    let stretch = |v: &mut Vector, power: i32| v.iter_mut().for_each(|c| *c = &*c * ten(power));
    let speed = scales.length - scales.time;
    for (body, mass) in scene.bodies.iter_mut().zip(&scales.mass) {
        body.mass = &body.mass * ten(*mass);
        body.inertia = &body.inertia * ten(mass + 2 * scales.length);
        stretch(&mut body.center, scales.length);
        stretch(&mut body.velocity, speed);
        body.spin = &body.spin * ten(-scales.time);
    }
    let hinges = scene.hinges.iter_mut().map(|h| &mut h.at);
    let contacts = scene.contacts.iter_mut().map(|c| &mut c.at);
    let blows = scene.blows.iter_mut().map(|b| &mut b.at);
    hinges
        .chain(contacts)
        .chain(blows)
        .for_each(|at| stretch(at, scales.length));
    for blow in &mut scene.blows {
        if let BlowImpulse::Given(impulse) = &mut blow.impulse {
            stretch(impulse, speed + scales.mass[blow.body]);
        }
    }
    let mut ask = |name: String, ask: Ask| scene.questions.push(Question::new(&name, None, ask));
    for body in 1..scene.bodies.len() {
        ask(
            format!("v{body}"),
            Ask::Velocity {
                body,
                point: None,
                along: None,
            },
        );
        if !scene.bodies[body].is_particle() {
            ask(
                format!("w{body}"),
                Ask::Spin {
                    body,
                    clockwise: false,
                },
            );
        }
    }
    for (i, contact) in scene.contacts.iter().enumerate() {
        let from = ImpulseAt::Contact(i);
        ask(
            format!("P{i}"),
            Ask::Impulse {
                from,
                on: contact.bodies[1],
                along: None,
            },
        );
    }
    scene
}

/// Scales of a family, the same for the same seed.
fn scales(seed: u64, family: u8) -> Scales {
    let dice = &mut Dice::new(seed ^ 0x5ca1e);
    let spread = [15, 15, 100, 5, 5][usize::from(family)];
    let mut mass: Vec<i32> = (0..4)
        .map(|_| dice.below(2 * spread + 1) as i32 - spread as i32)
        .collect();
    let (length, time) = match family {
        0 | 2 => (0, 0),
        1 => (8 - 2 * dice.below(9) as i32, 0),
        // m l² underflows long before m, l and every answer do.
        3 => (-130, -130),
        // m v² overflows.
        _ => (0, -150),
    };
    let all = [0, 0, 0, -130, 140][usize::from(family)];
    mass.iter_mut().for_each(|m| *m += all);
    Scales { mass, length, time }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn every_answer_is_the_nearest_double_at_every_scale(seed: u64, family in 0u8..5) {
        let scene = scaled(seed, &scales(seed, family));
        let exact = match answers(&scene, &Point::default(), solve_exact) {
            Ok(exact) => exact,
            Err(why) => {
                prop_assert_eq!(doubles(&scene), Err(why));
                return Ok(());
            }
        };
        let found = doubles(&scene).expect("an answer, for there is an exact one");
        prop_assert_eq!(found.len(), exact.len());
        for ((name, found), (_, exact)) in found.into_iter().zip(exact) {
            let nearest = exact.map(|a| match a {
                Answer::Scalar(v) => Answer::Scalar(to_f64(&v)),
                Answer::Vector(v) => Answer::Vector(v.each_ref().map(to_f64)),
            });
            match (found, nearest) {
                (Ok(found), Ok(nearest)) => prop_assert_eq!(found, nearest, "{}", name),
                (found, nearest) => prop_assert_eq!(found.is_ok(), nearest.is_ok(), "{}", name),
            }
        }
    }

    #[test]
    fn elimination_over_enclosures_encloses_what_fractions_give(seed: u64, family in 0u8..5) {
        let scene = scaled(seed, &scales(seed, family));
        let exact = assemble(&given::<Rational>(&scene, &Point::default()).expect("numbers"));
        let enclosed = |v: &Rational| Outcome::Value(Big::<128>::from_rational(v));
        let found = eliminate(&exact.map(enclosed));
        let truth = solve_exact(&exact).ok().filter(Solution::is_determined);
        // Rows that follow from others leave no square system, and what may be zero is no pivot.
        let (Some(found), Some(truth)) = (found, truth) else { return Ok(()) };
        for (found, truth) in found.iter().zip(&truth.values) {
            prop_assert!(matches!(found, Outcome::Value(Big(v)) if v.contains(truth)), "{:?} {}", found, truth);
        }
    }

    #[test]
    fn doubles_call_a_regular_system_regular_and_lose_no_more_than_its_condition(seed: u64, family in 0u8..3) {
        let scene = scaled(seed, &scales(seed, family));
        let system = assemble(&given::<Rational>(&scene, &Point::default()).expect("numbers"));
        let Ok(exact) = solve_exact(&system) else { return Ok(()) };
        if !exact.is_determined() {
            return Ok(());
        }
        let found = solve_f64(&system.map(to_f64)).expect("regular");
        prop_assert!(found.is_determined());
        // |A⁻¹|(|A||x| + |b|) is what roundings of the entries may move each unknown by.
        let n = system.unknowns.len();
        let size = |v: &Rational| to_f64(v).abs();
        let rows: Vec<f64> = (0..n)
            .map(|r| {
                let terms = system.row(r).iter().zip(&exact.values).map(|(a, x)| size(a) * size(x));
                terms.sum::<f64>() + size(&system.right[r])
            })
            .collect();
        let mut moved = vec![0.0; n];
        for (row, by) in rows.iter().enumerate() {
            let mut unit = system.clone();
            unit.right.fill(<Rational as Number>::zero());
            unit.right[row] = <Rational as Number>::one();
            let column = solve_exact(&unit).expect("regular").values;
            moved.iter_mut().zip(&column).for_each(|(m, v)| *m += size(v) * by);
        }
        // Where the true value is zero and no row moves it, LU may leave dust far below all that is not zero.
        let least = exact.values.iter().map(size).filter(|v| *v != 0.0).fold(1.0, f64::min);
        for ((found, exact), moved) in found.values.iter().zip(&exact.values).zip(moved) {
            let gap = (found - to_f64(exact)).abs();
            prop_assert!(gap <= 1e-14 * moved + 1e-9 * least, "{} of {}", gap, moved);
        }
    }
}
