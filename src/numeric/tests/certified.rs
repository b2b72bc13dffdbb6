//! Certified doubles against fractions: on random scenes with ragged doubles, and where doubles are at their worst.

use proptest::prelude::*;

use super::build::*;
use super::random::random_scene;
use super::*;
use crate::expr::number::{from_f64, to_f64};
use crate::numeric::ball::Ball;
use crate::numeric::given::{GivenBody, GivenContact, GivenLaw, Joint};

/// The numbers of a random scene, each nudged by a random relative amount so that all 53 bits are in use.
fn ragged(seed: u64) -> Given<f64> {
    let exact = given(&random_scene(seed), &Point::<Rational>::default()).expect("numbers");
    let mut dice = super::random::Dice::new(seed ^ 0x5555);
    exact.map(|v| to_f64(v) * (1.0 + dice.below(1 << 31) as f64 / 3e11))
}

/// Exact values of the scene with these very doubles.
fn truth(given: &Given<f64>) -> Option<Solution<Rational>> {
    solve_exact(&assemble(&given.map(|v| from_f64(*v).expect("finite")))).ok()
}

fn assert_certified(given: &Given<f64>) -> Vec<Tier> {
    let truth = truth(given).expect("consistent");
    let found = certify(given).expect("certified");
    assert_eq!(found.solution.unique, truth.unique);
    for (i, right) in truth.values.iter().enumerate() {
        assert_eq!(
            found.solution.values[i],
            to_f64(right),
            "{:?} by {:?}",
            found.unknowns[i],
            found.tiers[i]
        );
    }
    found.tiers
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn certified_doubles_are_the_nearest_and_balls_hold_the_truth(seed: u64) {
        let given = ragged(seed);
        let Some(truth) = truth(&given) else { return Ok(()) };
        let found = certify(&given).expect("certified");
        prop_assert_eq!(&found.solution.unique, &truth.unique);
        for (value, right) in found.solution.values.iter().zip(&truth.values) {
            prop_assert_eq!(*value, to_f64(right));
        }
        if let Some(balls) = eliminate(&assemble(&given.map(|v| Ball::exact(*v)))) {
            for (ball, right) in balls.iter().zip(&truth.values) {
                let middle = from_f64(ball.middle.high).expect("finite") + from_f64(ball.middle.low).expect("finite");
                let gap = num_traits::Signed::abs(&(middle - right));
                prop_assert!(gap <= from_f64(ball.radius()).expect("finite"), "{:?} {}", ball, to_f64(&gap));
            }
        }
        if let Some(values) = solve_dyadic(&given) {
            prop_assert!(values.iter().zip(&truth.values).all(|(v, right)| *v == to_f64(right)));
        }
    }

    #[test]
    fn scaling_by_powers_of_two_changes_no_bit(seed: u64, m in -60i32..60, l in -60i32..60, t in -60i32..60) {
        let given = ragged(seed);
        let Ok(found) = certify(&given) else { return Ok(()) };
        let [m, l, t] = [m, l, t].map(|k| 2f64.powi(k));
        let mut scaled = given.clone();
        for b in &mut scaled.bodies {
            b.mass *= m;
            b.inertia *= m * l * l;
            b.center = b.center.map(|v| v * l);
            b.velocity = b.velocity.map(|v| v * (l / t));
            b.spin /= t;
        }
        scaled.hinges.iter_mut().for_each(|h| h.at = h.at.map(|v| v * l));
        scaled.contacts.iter_mut().for_each(|c| c.joint.at = c.joint.at.map(|v| v * l));
        for b in &mut scaled.blows {
            b.at = b.at.map(|v| v * l);
            if let crate::numeric::given::GivenImpulse::Whole(j) = &mut b.impulse {
                *j = j.map(|v| v * (m * l / t));
            }
        }
        let other = certify(&scaled).expect("the same scene");
        for (i, unknown) in found.unknowns.iter().enumerate().filter(|(i, _)| found.solution.unique[*i]) {
            let unit = match unknown {
                Unknown::VelocityX(_) | Unknown::VelocityY(_) => l / t,
                Unknown::Spin(_) => 1.0 / t,
                _ => m * l / t,
            };
            prop_assert_eq!(found.solution.values[i] * unit, other.solution.values[i]);
        }
    }
}

/// A body of mass m, inertia i and center (x, y) that moves at (u, v) and hits body 0 at the origin, normal up.
fn hits(bodies: [[f64; 7]; 2], normal: [f64; 2], law: GivenLaw<f64>) -> Given<f64> {
    let bodies = bodies.map(|[mass, inertia, x, y, u, v, spin]| GivenBody {
        freedom: crate::numeric::given::Freedom::Rigid,
        mass,
        inertia,
        center: [x, y],
        velocity: [u, v],
        spin,
    });
    let joint = Joint {
        bodies: [0, 1],
        at: [0.0, 0.0],
    };
    let contacts = vec![GivenContact {
        joint,
        normal: Some(normal),
        law,
    }];
    Given {
        bodies: bodies.into(),
        hinges: vec![],
        contacts,
        blows: vec![],
        known: vec![],
    }
}

/// A number whose size is anything within so many decades, sometimes plain, sometimes nothing at all.
fn wild(dice: &mut super::random::Dice, decades: u64, zero: bool) -> f64 {
    let plain = [1.0, 0.5, 2.0, 0.6, 0.8, -1.0, 3.0];
    match dice.below(8) {
        0 if zero => 0.0,
        1 | 2 => plain[dice.below(if zero { 7 } else { 5 }) as usize],
        _ => {
            let digits = 1.0 + dice.below(1 << 31) as f64 / (1u64 << 31) as f64;
            let power = dice.below(2 * decades + 1) as i32 - decades as i32;
            let sign = if zero && dice.below(2) == 0 {
                -1.0
            } else {
                1.0
            };
            sign * (digits + dice.below(1 << 20) as f64 * 2f64.powi(-51)) * 10f64.powi(power)
        }
    }
}

/// Two or three bodies of any sizes, touching and hinged in any way.
fn wild_scene(seed: u64, decades: u64) -> Given<f64> {
    let dice = &mut super::random::Dice::new(seed);
    let count = 2 + dice.below(2) as usize;
    let bodies = (0..count).map(|i| GivenBody {
        freedom: match dice.below(6) {
            0 if i == 0 => crate::numeric::given::Freedom::Fixed,
            1 => crate::numeric::given::Freedom::Particle,
            _ => crate::numeric::given::Freedom::Rigid,
        },
        mass: wild(dice, decades, false),
        inertia: wild(dice, decades, false),
        center: [wild(dice, decades, true), wild(dice, decades, true)],
        velocity: [wild(dice, decades, true), wild(dice, decades, true)],
        spin: wild(dice, decades, true),
    });
    let bodies: Vec<_> = bodies.collect();
    let mut hinges = Vec::new();
    let mut contacts = Vec::new();
    for two in 1..count {
        let at = [wild(dice, decades, true), wild(dice, decades, true)];
        let joint = Joint {
            bodies: [dice.below(two as u64) as usize, two],
            at,
        };
        let normals = [[1.0, 0.0], [0.0, -1.0], [0.6, 0.8], [-0.28, 0.96]];
        let law = match dice.below(4) {
            0 => {
                hinges.push(joint);
                continue;
            }
            1 => GivenLaw::Sticking,
            2 => GivenLaw::Frictionless(1.0),
            _ => GivenLaw::Frictionless(wild(dice, decades, false)),
        };
        let normal = Some(normals[dice.below(4) as usize]);
        contacts.push(GivenContact { joint, normal, law });
    }
    let blows = match dice.below(4) {
        0 => vec![crate::numeric::given::GivenBlow {
            body: count - 1,
            at: [wild(dice, decades, true), 0.5],
            impulse: crate::numeric::given::GivenImpulse::Whole([wild(dice, decades, true), 1.5]),
        }],
        _ => vec![],
    };
    Given {
        bodies,
        hinges,
        contacts,
        blows,
        known: vec![],
    }
}

/// Every unknown certified to be the nearest double, and every enclosure around the truth; whether balls as entries are
/// enclosed wherever doubles are.
fn hold(given: &Given<f64>) -> bool {
    let Some(truth) = truth(given) else {
        return true;
    };
    let mut alike = true;
    let found = certify(given).expect("certified");
    assert_eq!(found.unknowns, assemble(given).unknowns);
    assert_eq!(found.solution.unique, truth.unique);
    let unique = || {
        truth
            .unique
            .iter()
            .enumerate()
            .filter(|(_, u)| **u)
            .map(|(i, _)| i)
    };
    for i in unique() {
        let (value, right) = (found.solution.values[i], to_f64(&truth.values[i]));
        assert_eq!(
            value, right,
            "{:?} by {:?}: {given:?}",
            found.unknowns[i], found.tiers[i]
        );
    }
    let mut balls = Vec::new();
    if contact_space::enclosures(given, |ball| balls.push(ball)).is_some() && truth.is_determined()
    {
        let converted = given.map(|v| Ball::exact(*v));
        let mut others = Vec::new();
        let wider = contact_space::enclosures(&converted, |ball| others.push(ball));
        assert_eq!(balls.len(), truth.values.len());
        for (ball, right) in balls.iter().zip(&truth.values) {
            assert_holds(ball, right);
        }
        // Operations on balls round more often; where that leaves a pivot open there is no enclosure, which is never wrong.
        alike = wider.is_some();
        if alike {
            assert_eq!(others.len(), truth.values.len());
            for (ball, right) in others.iter().zip(&truth.values) {
                assert_holds(ball, right);
            }
        }
    }
    if let Some(values) = solve_dyadic(given) {
        assert!(truth.is_determined());
        for (value, right) in values.iter().zip(&truth.values) {
            assert_eq!(*value, to_f64(right), "{given:?}");
        }
    }
    alike
}

fn assert_holds(ball: &Ball, right: &Rational) {
    let (Some(high), Some(low)) = (from_f64(ball.middle.high), from_f64(ball.middle.low)) else {
        return;
    };
    let gap = num_traits::Signed::abs(&(high + low - right));
    let holds = from_f64(ball.radius()).is_none_or(|radius| gap <= radius);
    assert!(holds, "{ball:?} misses by {:e}", to_f64(&gap));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn scenes_of_any_sizes_are_certified(seed: u64, decades in 0usize..4) {
        hold(&wild_scene(seed, [0, 3, 30, 120][decades]));
    }
}

#[test]
fn balls_are_enclosed_nearly_wherever_doubles_are() {
    let scenes = (0..400u64).map(|k| {
        let seed = k.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        wild_scene(seed, [0, 3, 30, 120][(k % 4) as usize])
    });
    let refused = scenes.filter(|given| !hold(given)).count();
    assert!(refused <= 4, "{refused} of 400 scenes");
}

#[test]
fn extreme_families_are_certified() {
    let one = [1.1, 0.3, 0.2, -0.7, 0.1, 0.3, 0.4];
    let two = [2.3, 0.7, -0.3, 0.9, -0.2, -1.7, -0.9];
    let elastic = || GivenLaw::Frictionless(1.0);
    for k in [1e15, 1e-15, 1e8, 1e-8] {
        let heavy = [
            two[0] * k,
            two[1] * k,
            two[2],
            two[3],
            two[4],
            two[5],
            two[6],
        ];
        let wide = [two[0], two[1], two[2] * k, two[3], two[4], two[5], two[6]];
        let round = [two[0], two[1] * k, two[2], two[3], two[4], two[5], two[6]];
        for changed in [heavy, wide, round] {
            assert_certified(&hits([one, changed], [0.0, 1.0], elastic()));
            assert_certified(&hits([one, changed], [0.6, 0.8], GivenLaw::Sticking));
            assert_certified(&hits(
                [one, changed],
                [0.6, 0.8],
                GivenLaw::Frictionless(1.0 - 1e-16),
            ));
            assert_certified(&hits(
                [one, changed],
                [0.6, 0.8],
                GivenLaw::Frictionless(1e-300),
            ));
        }
    }
}

#[test]
fn a_ball_that_stops_dead_needs_the_exact_tier() {
    // Equal masses, central and elastic: the second stops, by a cancellation that no rounding sees through.
    let one = [0.1, 0.3, 0.0, -0.7, 0.0, 0.0, 0.0];
    let two = [0.1, 0.7, 0.0, 0.9, 0.0, -1.7, 0.0];
    let tiers = assert_certified(&hits([one, two], [0.0, 1.0], GivenLaw::Frictionless(1.0)));
    assert_eq!(tiers.iter().max(), Some(&Tier::Exact));
    let near = [0.1f64.next_up(), 0.7, 0.0, 0.9, 0.0, -1.7, 0.0];
    let given = hits([one, near], [0.0, 1.0], GivenLaw::Frictionless(1.0));
    assert_certified(&given);
    let stopped = certify(&given).expect("certified").solution.values[4];
    assert!(stopped != 0.0 && stopped.abs() < 1e-15, "{stopped}");
}

#[test]
fn numbers_at_the_ends_of_the_range_are_certified() {
    let one = [1e-200, 1e-300, 1e-60, -0.7, 1e150, 0.3, 0.4];
    let two = [2e200, 7e250, -3e40, 0.9, -0.2, -1.7e150, -0.9];
    assert_certified(&hits([one, two], [0.0, 1.0], GivenLaw::Frictionless(0.5)));
}

#[test]
fn infinities_are_refused() {
    let one = [1.0, f64::INFINITY, 0.0, 0.0, 0.0, 0.0, 0.0];
    let given = hits([one, [1.0; 7]], [0.0, 1.0], GivenLaw::Frictionless(0.5));
    assert_eq!(certify(&given), Err(Uncertified::NotFinite));
}

#[test]
fn an_angle_in_radians_is_certified_by_balls() {
    // Sample 17.29 at θ = 1/3: ω = 3 v cos θ / (2 l), clockwise.
    let theta = s("theta");
    let center = [
        s("l") * theta.cos() * q(1, 2),
        s("l") * theta.sin() * q(1, 2),
    ];
    let bar = rod(s("m"), s("l"), center, [n(0), -s("v")], n(0));
    let scene = scene(
        vec![ground(), bar],
        vec![],
        vec![sticks(0, 1, at(0, 0), Some(at(0, 1)))],
    );
    let mut point = Point::<f64>::default();
    for (name, value) in [("theta", 1.0 / 3.0), ("l", 0.7), ("m", 1.3), ("v", 2.1)] {
        point.values.insert(name.into(), value);
    }
    let found = certify_scene(&scene, &point).expect("certified");
    assert_eq!(found.tiers, vec![Tier::Ball; 5]);
    let spin = found.solution.values[2];
    let closed = -3.0 * 2.1 * (1.0f64 / 3.0).cos() / (2.0 * 0.7);
    assert!(
        (spin - closed).abs() <= 4.0 * f64::EPSILON * closed.abs(),
        "{spin} {closed}"
    );
}
