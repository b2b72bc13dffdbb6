//! Facts about the stiff limit.

use super::*;

const ANGLE: f64 = 0.7;

fn powers(range: std::ops::RangeInclusive<i32>) -> Vec<f64> {
    range.map(|k| 10_f64.powi(k)).collect()
}

fn collision(ground: Ground, stiffness: f64, variables: Variables) -> Collision {
    Collision {
        angle: ANGLE,
        ground,
        stiffness,
        variables,
    }
}

#[test]
fn the_distance_from_the_rigid_limit_goes_with_one_half_and_two_fifths() {
    for (exponent, expected) in [(1.0, 0.5), (1.5, 0.4)] {
        let found = order(ANGLE, exponent, &powers(6..=14)).expect("integrates");
        assert_eq!(found.points.len(), 9);
        assert!((found.observed - expected).abs() < 0.005, "{found:?}");
        assert!((found.expected - expected).abs() < 1e-15);
    }
}

#[test]
fn richardson_reaches_the_closed_form_to_twelve_digits() {
    for exponent in [1.0, 1.5] {
        let found = limit(ANGLE, exponent, 0.05, 9).expect("integrates");
        assert!(found.chosen_error < 1e-12, "{found:?}");
    }
}

#[test]
fn steps_in_scaled_variables_do_not_depend_on_the_stiffness() {
    for exponent in [1.0, 1.5] {
        // The diagonally implicit method does not get over the corner of the Hertz force where contact ends.
        for integrator in Integrator::ALL
            .into_iter()
            .filter(|i| exponent == 1.0 || *i != Integrator::Kvaerno4)
        {
            let steps: Vec<usize> = [1e6, 1e11, 1e16]
                .map(|k| {
                    let run = run(
                        collision(Ground::Smooth { exponent }, k, Variables::Scaled),
                        integrator,
                        1e-8,
                        20_000,
                    );
                    assert_eq!(run.end, End::Reached, "{run:?}");
                    run.steps[0]
                })
                .to_vec();
            let (low, high) = (steps.iter().min(), steps.iter().max());
            assert!(
                high.zip(low).is_some_and(|(h, l)| 10 * h <= 11 * l + 20),
                "{integrator:?} p = {exponent}: {steps:?}"
            );
        }
    }
}

#[test]
fn raw_variables_cost_more_and_more_as_the_stiffness_grows() {
    let ground = Ground::Smooth { exponent: 1.0 };
    let run = |variables, k| {
        run(
            collision(ground, k, variables),
            Integrator::Dopri5,
            1e-13,
            100_000,
        )
    };
    let (few, many) = (run(Variables::Scaled, 1e16), run(Variables::Raw, 1e16));
    assert!(
        few.end == End::Reached && few.energy_error.is_some_and(|e| e < 1e-11),
        "{few:?}"
    );
    // Depths of 1e−8 as differences of positions near 1 carry noise that no step is short enough for.
    let gave_up = many.end != End::Reached;
    assert!(
        gave_up || many.steps.iter().sum::<usize>() > 5 * few.steps.iter().sum::<usize>(),
        "{many:?}"
    );
    assert!(gave_up || many.energy_error > few.energy_error, "{many:?}");
}

#[test]
fn a_gripped_end_costs_explicit_steps_like_the_root_of_the_stiffness_and_few_implicit_ones() {
    let steps = |integrator, k| {
        let run = run(
            collision(Ground::Grip, k, Variables::Raw),
            integrator,
            1e-6,
            1_000_000,
        );
        assert_eq!(run.end, End::Reached, "{run:?}");
        assert!(run.rigid_error < 3.0 / f64::sqrt(k), "{run:?}");
        run.steps[0] as f64
    };
    let growth = |integrator| (steps(integrator, 1e8) / steps(integrator, 1e5)).log10() / 3.0;
    let explicit = growth(Integrator::Dopri5);
    assert!((explicit - 0.5).abs() < 0.1, "order {explicit}");
    for integrator in [Integrator::Radau5, Integrator::Kvaerno4] {
        assert!(
            growth(integrator) < 0.2,
            "{integrator:?}: {}",
            growth(integrator)
        );
    }
}

#[test]
fn the_accurate_run_keeps_its_energy() {
    for exponent in [1.0, 1.5] {
        for stiffness in [1e2, 1e8, 1e16] {
            let run = accurate(ANGLE, exponent, stiffness).expect("integrates");
            assert!(run.energy_error.is_some_and(|e| e < 1e-13), "{run:?}");
        }
    }
}

#[test]
fn a_sweep_can_be_stopped_and_keeps_what_is_done() {
    let mut seen = 0;
    let rows = sweep(
        ANGLE,
        Ground::Smooth { exponent: 1.0 },
        &[1e4],
        1e-6,
        10_000,
        |_| {
            seen += 1;
            seen < 3
        },
    );
    assert_eq!(rows.len(), 3);
}
