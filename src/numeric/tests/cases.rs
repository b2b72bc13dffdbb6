//! Known numbers: textbook samples, chains of rods, and scenes that leave something open.

use super::build::*;
use super::*;
use crate::expr::number::to_f64;
use crate::expr::{Symbol, ratio};

#[test]
fn a_falling_rod_that_sticks_turns_at_three_v_cos_theta_over_two_l() {
    // Sample 17.29 with v = 2, l = 3 and cos θ = 4/5, sin θ = 3/5: the left end C hits the ground.
    let (v, l, c, si) = (n(2), n(3), q(4, 5), q(3, 5));
    let center = [&l * &c * q(1, 2), &l * &si * q(1, 2)];
    let bar = rod(n(7), l, center, [n(0), -v], n(0));
    let (_, _, motion) = solved(&scene(
        vec![ground(), bar],
        vec![],
        vec![sticks(0, 1, at(0, 0), Some(at(0, 1)))],
    ));
    assert_eq!(motion.spin[1], ratio(-3 * 2 * 4, 2 * 3 * 5));
}

#[test]
fn the_flying_dish_recoils_exactly() {
    let (given, _, motion) = solved(&flying_dish());
    let p = ratio(22, 1) / (ratio(3, 2) + ratio(96, 125));
    assert_eq!(motion.contact[0], [p.clone(), ratio(0, 1)]);
    assert_eq!(motion.velocity[0], [ratio(1, 1) - &p, ratio(0, 1)]);
    assert_eq!(
        motion.velocity[1],
        [&p / ratio(2, 1) - ratio(10, 1), ratio(0, 1)]
    );
    assert_eq!(motion.spin, [ratio(-5, 1), -(&p * ratio(24, 25))]);
    assert_eq!(
        energy_before(&given, None),
        energy_after(&given, &motion, None)
    );
    assert!(identities(&given, &motion).iter().all(|i| i.holds(0.0)));
}

#[test]
fn a_free_chain_of_eight_rods_turns_its_struck_rod_at_23859_over_5432() {
    let (given, system, motion) = solved(&chain(8, false));
    assert_eq!(system.unknowns.len(), 3 * 8 + 2 * 7);
    assert_eq!(motion.spin[8], ratio(23859, 5432));
    assert!(identities(&given, &motion).iter().all(|i| i.holds(0.0)));
}

#[test]
fn a_hit_at_two_thirds_leaves_the_hinge_without_impulse() {
    let bar = rod(n(1), n(3), [q(3, 2), n(0)], at(0, 0), n(0));
    let mut scene = scene(vec![ground(), bar], vec![hinge(0, 1, at(0, 0))], vec![]);
    scene.blows.push(blow(1, at(2, 0), at(0, 5)));
    assert_eq!(solved(&scene).2.hinge[0], [ratio(0, 1), ratio(0, 1)]);
}

#[test]
fn two_hinges_to_the_ground_leave_reactions_open_and_velocities_unique() {
    let bar = rod(n(1), n(2), at(1, 0), at(0, 0), n(0));
    let mut scene = scene(
        vec![ground(), bar],
        vec![hinge(0, 1, at(0, 0)), hinge(0, 1, at(2, 0))],
        vec![],
    );
    scene.blows.push(blow(1, at(1, 0), at(3, 4)));
    let (given, system, motion) = solved(&scene);
    let open = [Unknown::Hinge(0, 0), Unknown::Hinge(1, 0)];
    assert_eq!(
        motion.loose, open,
        "along the bar only the sum of the reactions is determined"
    );
    assert_eq!(motion.hinge[0][1], ratio(-2, 1));
    assert_eq!(solve_exact(&system).map(|s| s.rank), Ok(6));
    let float = solve_f64(&system.map(to_f64)).expect("consistent");
    assert_eq!(float.rank, 6);
    let loose: Vec<_> = system
        .unknowns
        .iter()
        .zip(&float.unique)
        .filter(|(_, u)| !**u)
        .map(|(u, _)| *u)
        .collect();
    assert_eq!(loose, open);
    assert!(identities(&given, &motion).iter().all(|i| i.holds(0.0)));
}

#[test]
fn two_free_bodies_without_a_law_have_six_equations_for_eight_unknowns() {
    let mut scene = flying_dish();
    scene.contacts[0].law = crate::scene::ContactLaw::None;
    let (_, system, motion) = solved(&scene);
    assert_eq!((system.laws.len(), system.unknowns.len()), (6, 8));
    assert_eq!(solve_exact(&system).map(|s| s.rank), Ok(6));
    assert_eq!(
        motion.loose.len(),
        8,
        "every component depends on the open impulse"
    );
}

#[test]
fn impossible_knowledge_is_a_contradiction_that_names_its_rows() {
    let bar = rod(n(1), n(2), at(1, 0), at(0, 0), n(0));
    let mut scene = scene(vec![ground(), bar], vec![hinge(0, 1, at(0, 0))], vec![]);
    scene
        .after
        .push(known_velocity(1, at(0, 0), at(0, 1), n(1)));
    let system = assemble(&given(&scene, &Point::<Rational>::default()).expect("numbers"));
    let contradiction = solve_exact(&system).expect_err("the hinge does not move");
    assert_eq!(
        contradiction.laws(&system),
        [Law::Hinge(0, 1), Law::Known(0)]
    );
    assert!(solve_f64(&system.map(to_f64)).is_err());
}

#[test]
fn a_cue_ball_stopped_by_a_known_velocity_tells_the_blow() {
    // A ball of mass 2 at rest is pushed along x so that it leaves at 3.
    let ball = rigid(n(2), n(1), at(0, 0), at(0, 0), n(0));
    let mut scene = scene(vec![ball], vec![], vec![]);
    let push = crate::scene::BlowImpulse::Along(at(1, 0));
    scene.blows.push(crate::scene::Blow {
        name: "cue".into(),
        body: 0,
        at: at(-1, 1),
        impulse: push,
    });
    scene
        .after
        .push(known_velocity(0, at(0, 0), at(1, 0), n(3)));
    let (_, _, motion) = solved(&scene);
    assert_eq!(
        (&motion.blow[0], &motion.spin[0]),
        (&[ratio(6, 1), ratio(0, 1)], &ratio(-6, 1))
    );
}

#[test]
fn a_massless_link_between_two_particles_is_the_rigid_dumbbell() {
    // Particles of mass 1 and 2 at (0, 0) and (3, 0); the dumbbell has G at (2, 0) and I = 1·4 + 2·1 = 6.
    let link = rigid(n(0), n(0), at(1, 0), at(0, 0), n(0));
    let ends = [
        particle(n(1), at(0, 0), at(0, -4)),
        particle(n(2), at(3, 0), at(0, -4)),
    ];
    let [one, two] = ends;
    let contact = |i| bounces(0, i, at(0, 0), at(0, 1), q(1, 2));
    let hinges = vec![hinge(1, 2, at(0, 0)), hinge(1, 3, at(3, 0))];
    let mut link = link;
    link.velocity = at(0, -4);
    let (given, _, linked) = solved(&scene(
        vec![ground(), link, one, two],
        hinges,
        vec![contact(2)],
    ));
    let dumbbell = rigid(n(3), n(6), at(2, 0), at(0, -4), n(0));
    let (_, _, rigid) = solved(&scene(vec![ground(), dumbbell], vec![], vec![contact(1)]));
    assert_eq!(linked.contact, rigid.contact);
    assert_eq!(linked.spin[1], rigid.spin[1]);
    assert_eq!(
        linked.velocity[3][1],
        &rigid.velocity[1][1] + &rigid.spin[1]
    );
    assert!(identities(&given, &linked).iter().all(|i| i.holds(0.0)));
}

#[test]
fn a_disk_hit_centrally_moves_as_a_particle_does() {
    let ball = |shape: bool| match shape {
        true => rigid(n(3), q(1, 7), at(0, 0), at(2, -5), n(0)),
        false => particle(n(3), at(0, 0), at(2, -5)),
    };
    let hit = |b| {
        solved(&scene(
            vec![ground(), ball(b)],
            vec![],
            vec![bounces(0, 1, at(0, 0), at(0, 1), q(2, 3))],
        ))
        .2
    };
    let (disk, point) = (hit(true), hit(false));
    assert_eq!(
        (&disk.velocity, &disk.contact),
        (&point.velocity, &point.contact)
    );
}

#[test]
fn an_angle_without_a_rational_direction_says_which_quantity_it_spoils() {
    let mut scene = flying_dish();
    scene.bodies[0].velocity[1] = (crate::expr::Expr::pi() * q(1, 6)).cos();
    let undefined =
        given(&scene, &Point::<Rational>::default()).expect_err("cos 30° is no fraction");
    assert_eq!(
        undefined.to_string(),
        "velocity of D: has no value in this number type at this point"
    );
    assert!(given(&scene, &Point::<f64>::default()).is_ok());
    scene.bodies[1].mass = s("m_P");
    let missing = given(&scene, &Point::<f64>::default()).expect_err("no value");
    assert_eq!(
        missing.reason,
        Reason::NoValueFor(vec![Symbol::from("m_P")])
    );
}

#[test]
fn a_body_index_out_of_range_is_an_error() {
    let mut scene = flying_dish();
    scene.contacts[0].bodies[1] = 9;
    assert!(given(&scene, &Point::<Rational>::default()).is_err());
}

#[test]
fn a_component_along_any_angle_is_a_double_where_all_else_is_a_fraction() {
    for law in [
        r#""frictionless", "restitution": "1/2""#,
        r#""friction", "mu": "1/3", "hypothesis": "poisson", "restitution": "1/2""#,
    ] {
        let text = format!(
            r#"{{
  "parameters": {{"m": {{"unit": "kg", "value": 1}}, "v": {{"unit": "m/s", "value": 2}}}},
  "bodies": {{"w": {{"shape": "fixed"}}, "b": {{"shape": "particle", "mass": "m", "center": [0, 0], "velocity": [0, "-v"]}}}},
  "contacts": {{"K": {{"bodies": ["w", "b"], "normal": "y", "law": {law}}}}},
  "questions": {{"u": {{"velocity": "b", "along": {{"angle": "pi/6"}}}}, "w": {{"velocity": "b", "along": {{"angle": "pi/3"}}}}}}
}}"#
        );
        let scene = crate::scene::read(&text).expect("a valid scene");
        let found = crate::numeric::doubles(&scene).expect("numbers");
        let along: Vec<f64> = (found.into_iter())
            .filter_map(|(_, a)| a.ok()?.components().first().map(|(_, v)| *v))
            .collect();
        // The ball rises at 1 m/s.
        let [u, w] = along[..] else {
            panic!("two components: {along:?}");
        };
        assert!((u - 0.5).abs() < 1e-15 && (w - 0.75f64.sqrt()).abs() < 1e-15);
    }
}
