//! Laws that hold for every scene, over random ones: invariants, frames, units, order, limits, and f64 against fractions.

use num_traits::Signed;
use proptest::prelude::*;

use super::random::{Dice, random_scene};
use super::*;
use crate::expr::arithmetic::difference;
use crate::expr::number::to_f64;
use crate::expr::ratio;
use crate::numeric::given::{Freedom, GivenImpulse, GivenLaw};
use crate::numeric::number::velocity_at;

type Exact = (Given<Rational>, Motion<Rational>);

/// A random scene and its motion, where its laws do not contradict each other.
fn random_motion(seed: u64) -> Option<Exact> {
    let given = given(&random_scene(seed), &Point::default()).expect("fractions everywhere");
    solve(&given).map(|motion| (given, motion))
}

fn solve(given: &Given<Rational>) -> Option<Motion<Rational>> {
    let system = assemble(given);
    solve_exact(&system)
        .ok()
        .map(|solution| motion(given, &system, &solution))
}

/// The scene as another observer or another choice of units has it: positions, velocities, impulses and normals by the
/// given maps, spins by a factor.
struct View<'a> {
    place: &'a dyn Fn(&[Rational; 2]) -> [Rational; 2],
    velocity: &'a dyn Fn(&[Rational; 2]) -> [Rational; 2],
    impulse: &'a dyn Fn(&[Rational; 2]) -> [Rational; 2],
    direction: &'a dyn Fn(&[Rational; 2]) -> [Rational; 2],
    spin: Rational,
    mass: Rational,
    inertia: Rational,
}

impl View<'_> {
    fn of(&self, given: &Given<Rational>) -> Given<Rational> {
        let mut seen = given.clone();
        for b in &mut seen.bodies {
            b.mass *= &self.mass;
            b.inertia *= &self.inertia;
            b.center = (self.place)(&b.center);
            b.velocity = (self.velocity)(&b.velocity);
            b.spin *= &self.spin;
        }
        seen.hinges
            .iter_mut()
            .for_each(|h| h.at = (self.place)(&h.at));
        for c in &mut seen.contacts {
            c.joint.at = (self.place)(&c.joint.at);
            c.normal = c.normal.as_ref().map(self.direction);
        }
        for b in &mut seen.blows {
            b.at = (self.place)(&b.at);
            if let GivenImpulse::Whole(j) = &mut b.impulse {
                *j = (self.impulse)(j);
            }
        }
        seen
    }

    /// Whether the motion of the seen scene is the seen motion, in everything determined.
    fn agrees(&self, given: &Given<Rational>, motion: &Motion<Rational>) -> bool {
        let Some(seen) = solve(&self.of(given)) else {
            return false;
        };
        // A view may turn one loose component into a determined one; bodies and joints are compared whole.
        let body_known = |m: &Motion<Rational>, i| {
            m.determines(Unknown::Velocity(i, 0))
                && m.determines(Unknown::Velocity(i, 1))
                && m.determines(Unknown::Spin(i))
        };
        let bodies = (0..given.bodies.len()).all(|i| {
            !body_known(motion, i)
                || (seen.velocity[i] == (self.velocity)(&motion.velocity[i])
                    && seen.spin[i] == &motion.spin[i] * &self.spin)
        });
        let contacts = (0..given.contacts.len()).all(|i| {
            let loose = [
                Unknown::Contact(i, 0),
                Unknown::Contact(i, 1),
                Unknown::ContactNormal(i),
            ];
            loose.iter().any(|u| !motion.determines(*u))
                || seen.contact[i] == (self.impulse)(&motion.contact[i])
        });
        let hinges = (0..given.hinges.len()).all(|i| {
            let loose = [Unknown::Hinge(i, 0), Unknown::Hinge(i, 1)];
            loose.iter().any(|u| !motion.determines(*u))
                || seen.hinge[i] == (self.impulse)(&motion.hinge[i])
        });
        bodies && contacts && hinges
    }
}

fn same(v: &[Rational; 2]) -> [Rational; 2] {
    v.clone()
}

#[test]
fn most_random_scenes_have_a_motion_and_all_kinds_occur() {
    let scenes: Vec<_> = (0..400).map(random_scene).collect();
    let solved = (0..400).filter(|s| random_motion(*s).is_some()).count();
    assert!(solved > 340, "{solved}");
    assert!(scenes.iter().filter(|s| s.hinges.len() > 1).count() > 40);
    assert!(scenes.iter().filter(|s| s.contacts.len() > 1).count() > 20);
    let loose = (0..400)
        .filter_map(random_motion)
        .filter(|(_, m)| !m.loose.is_empty())
        .count();
    assert!(loose > 5, "{loose}");
}

proptest! {
    #[test]
    fn every_invariant_holds_exactly(seed: u64) {
        let Some((given, motion)) = random_motion(seed) else { return Ok(()) };
        for identity in identities(&given, &motion) {
            prop_assert!(identity.holds(0.0), "{:?}", identity);
        }
        let no_work_from_outside = given.blows.is_empty()
            && given.bodies.iter().filter(|b| b.freedom == Freedom::Fixed).all(|b| b.velocity == [ratio(0, 1), ratio(0, 1)]);
        // Two contacts with restitutions of their own may gain energy under Newton's law; one never does.
        if no_work_from_outside && given.contacts.len() == 1 {
            prop_assert!(!energy_lost(&given, &motion, None).is_negative());
        }
        for body in (0..given.bodies.len()).map(Some) {
            let change = energy_before(&given, body) - energy_after(&given, &motion, body);
            prop_assert_eq!(energy_lost(&given, &motion, body), change);
        }
    }

    #[test]
    fn a_wrong_motion_breaks_an_invariant(seed: u64, which: u64) {
        let Some((given, mut motion)) = random_motion(seed) else { return Ok(()) };
        let free: Vec<usize> = (0..given.bodies.len()).filter(|i| given.bodies[*i].freedom != Freedom::Fixed).collect();
        let body = free[which as usize % free.len()];
        motion.velocity[body][(which >> 8) as usize % 2] += ratio(1, 1);
        prop_assert!(identities(&given, &motion).iter().any(|i| !i.holds(0.0)));
    }

    #[test]
    fn a_turned_frame_sees_the_turned_motion(seed: u64) {
        let Some((given, motion)) = random_motion(seed) else { return Ok(()) };
        let [c, s] = Dice::new(!seed).unit();
        let turn = |v: &[Rational; 2]| [&v[0] * &c - &v[1] * &s, &v[0] * &s + &v[1] * &c];
        let view = View { place: &turn, velocity: &turn, impulse: &turn, direction: &turn,
            spin: ratio(1, 1), mass: ratio(1, 1), inertia: ratio(1, 1) };
        prop_assert!(view.agrees(&given, &motion));
    }

    #[test]
    fn a_mirror_sees_the_mirrored_motion(seed: u64) {
        let Some((given, motion)) = random_motion(seed) else { return Ok(()) };
        let mirror = |v: &[Rational; 2]| [-&v[0], v[1].clone()];
        let view = View { place: &mirror, velocity: &mirror, impulse: &mirror, direction: &mirror,
            spin: ratio(-1, 1), mass: ratio(1, 1), inertia: ratio(1, 1) };
        prop_assert!(view.agrees(&given, &motion));
    }

    #[test]
    fn a_moving_observer_sees_the_same_impulses(seed: u64) {
        let Some((given, motion)) = random_motion(seed) else { return Ok(()) };
        let by = Dice::new(!seed).vector();
        let boost = |v: &[Rational; 2]| difference(v, &by);
        let view = View { place: &same, velocity: &boost, impulse: &same, direction: &same,
            spin: ratio(1, 1), mass: ratio(1, 1), inertia: ratio(1, 1) };
        prop_assert!(view.agrees(&given, &motion));
    }

    #[test]
    fn other_units_give_the_same_motion_in_those_units(seed: u64) {
        let Some((given, motion)) = random_motion(seed) else { return Ok(()) };
        let mut dice = Dice::new(!seed);
        let (mass, length, time) = (dice.positive(), dice.positive(), dice.positive());
        let speed = &length / &time;
        let by = |k: Rational| move |v: &[Rational; 2]| [&v[0] * &k, &v[1] * &k];
        let (place, velocity, impulse) = (by(length.clone()), by(speed.clone()), by(&mass * &speed));
        let view = View { place: &place, velocity: &velocity, impulse: &impulse, direction: &same,
            spin: time.recip(), mass: mass.clone(), inertia: &mass * &length * &length };
        prop_assert!(view.agrees(&given, &motion));
    }

    #[test]
    fn exchanging_the_bodies_of_a_contact_turns_its_impulse_around(seed: u64) {
        let Some((given, motion)) = random_motion(seed) else { return Ok(()) };
        let mut swapped = given.clone();
        for c in &mut swapped.contacts {
            c.joint.bodies.reverse();
            c.normal = c.normal.as_ref().map(|n| [-&n[0], -&n[1]]);
        }
        swapped.hinges.iter_mut().for_each(|h| h.bodies.reverse());
        let other = solve(&swapped).expect("the same scene");
        if motion.loose.is_empty() {
            prop_assert_eq!(&other.velocity, &motion.velocity);
            prop_assert_eq!(&other.spin, &motion.spin);
            for (a, b) in other.contact.iter().zip(&motion.contact).chain(other.hinge.iter().zip(&motion.hinge)) {
                prop_assert_eq!(a, &[-&b[0], -&b[1]]);
            }
        }
    }

    #[test]
    fn a_very_heavy_body_is_a_wall(seed: u64) {
        let dice = &mut Dice::new(seed);
        let wall = super::build::body("wall", crate::scene::Shape::Other, super::build::n(1), super::build::n(1),
            super::build::exact(&dice.vector()), super::build::exact(&dice.vector()), super::build::n(0));
        let hit = |k: i64, fixed: bool| {
            let dice = &mut Dice::new(!seed);
            let mut heavy = wall.clone();
            if fixed {
                heavy.shape = crate::scene::Shape::Fixed;
            } else {
                heavy.mass = super::build::n(10).powi(k);
                heavy.inertia = super::build::n(10).powi(k);
            }
            let ball = super::build::rigid(dice.positive().into(), dice.positive().into(),
                super::build::exact(&dice.vector()), super::build::exact(&dice.vector()), dice.any().into());
            let (place, normal) = (super::build::exact(&dice.vector()), super::build::exact(&dice.unit()));
            let contact = match dice.below(2) {
                0 => super::build::sticks(0, 1, place, Some(normal)),
                _ => super::build::bounces(0, 1, place, normal, super::build::q(dice.below(8) as i64, 7)),
            };
            solved(&super::build::scene(vec![heavy, ball], vec![], vec![contact])).2
        };
        let limit = hit(0, true);
        let gap = |k: i64| {
            let m = hit(k, false);
            let d = [&m.velocity[1][0] - &limit.velocity[1][0], &m.velocity[1][1] - &limit.velocity[1][1],
                &m.spin[1] - &limit.spin[1]];
            d.iter().map(|v| to_f64(v).abs()).fold(0.0, f64::max)
        };
        // The gap falls like 1/m₂.
        let (near, nearer) = (gap(12), gap(16));
        prop_assert!(near < 1e-5, "{near}");
        prop_assert!(nearer <= near * 1.01e-4, "{near} {nearer}");
    }

    #[test]
    fn doubles_agree_with_fractions_as_far_as_the_conditioning_lets_them(seed: u64) {
        let Some((exact, motion)) = random_motion(seed) else { return Ok(()) };
        let system = assemble(&exact);
        let float = system.map(to_f64);
        let Ok(found) = solve_f64(&float) else {
            prop_assert!(false, "the doubles contradict each other");
            return Ok(());
        };
        let unique: Vec<bool> = system.unknowns.iter().map(|u| motion.determines(*u)).collect();
        prop_assert_eq!(&found.unique, &unique);
        let right = solve_exact(&system).expect("solved before");
        let size = right.values.iter().map(|v| to_f64(v).abs()).fold(1e-3, f64::max);
        let n = system.unknowns.len();
        let dense = nalgebra::DMatrix::from_row_slice(system.laws.len(), n, &float.matrix);
        let inverse = dense.clone().pseudo_inverse(1e-12).expect("a non-negative threshold");
        let condition = dense.norm() * inverse.norm();
        for i in (0..n).filter(|i| unique[*i]) {
            let gap = (found.values[i] - to_f64(&right.values[i])).abs();
            prop_assert!(gap <= 64.0 * f64::EPSILON * condition * size, "{gap} {condition} {size}");
        }
    }
}

#[test]
fn what_sticks_to_a_floor_needs_the_friction_of_its_slope() {
    use super::build::*;
    let ball = particle(n(1), at(0, 0), at(3, -4));
    let floor = sticks(0, 1, at(0, 0), Some(at(0, 1)));
    let (given, _, motion) = solved(&scene(vec![ground(), ball], vec![], vec![floor]));
    let report = contact_reports(&given, &motion)[0]
        .clone()
        .expect("a normal");
    assert_eq!(report.required_friction, Some(ratio(3, 4)));
}

#[test]
fn a_moving_wall_gives_energy_but_no_loss() {
    // An elastic ball of mass 1 at rest is hit by a wall that moves at 3: it leaves at 6.
    use super::build::*;
    let mut wall = ground();
    wall.velocity = at(3, 0);
    let ball = particle(n(1), at(0, 0), at(0, 0));
    let (given, _, motion) = solved(&scene(
        vec![wall, ball],
        vec![],
        vec![bounces(0, 1, at(0, 0), at(1, 0), n(1))],
    ));
    assert_eq!(motion.velocity[1], [ratio(6, 1), ratio(0, 1)]);
    assert_eq!(energy_lost(&given, &motion, None), ratio(-18, 1));
    let report = contact_reports(&given, &motion)[0]
        .clone()
        .expect("a normal");
    assert!(!report.separates);
    assert_eq!(report.required_friction, Some(ratio(0, 1)));
    assert_eq!(motion.contact[0], [ratio(6, 1), ratio(0, 1)]);
    assert!(
        given
            .contacts
            .iter()
            .all(|c| matches!(c.law, GivenLaw::Frictionless(_)))
    );
    assert_eq!(
        velocity_at(
            &[ratio(0, 1), ratio(0, 1)],
            &ratio(2, 1),
            &[ratio(1, 1), ratio(0, 1)]
        )[1],
        ratio(2, 1)
    );
}
