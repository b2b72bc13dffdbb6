//! Tests of the second way: outlines against textbook values, motions against known laws, impacts against the other solver,
//! and every shipped scene followed at points of its domain.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};
use std::path::Path;

use super::*;
use crate::numeric;
use crate::scene;

mod courses;
mod impacts;
mod motions;
mod shipped;

/// A scene from its text.
fn read(text: &str) -> Scene {
    scene::read(text).unwrap_or_else(|faults| panic!("{}", faults.render("scene", text)))
}

fn point(values: &[(&str, f64)]) -> Point<f64> {
    Point {
        values: values.iter().map(|(n, v)| (Symbol::from(*n), *v)).collect(),
        ..Point::default()
    }
}

fn passed(followed: &Followed, stage: usize) -> &Passed {
    match &followed.stages[stage] {
        Ok(passed) => passed,
        Err(lost) => panic!("stage {stage}: {lost}"),
    }
}

fn close(found: f64, expected: f64, share: f64) {
    assert!(
        (found - expected).abs() <= share * expected.abs().max(1e-3),
        "{found} instead of {expected}"
    );
}

fn value_of(component: &Component) -> f64 {
    match component {
        Ok(value) => *value,
        Err(open) => panic!("{open}"),
    }
}

#[test]
fn outlines_have_the_moments_of_inertia_of_the_textbook() {
    let rows = [
        (
            r#""shape": "rod", "mass": "3", "length": "2", "angle": "0.3""#,
            3.0 * 4.0 / 12.0,
        ),
        (
            r#""shape": "disk", "mass": "3", "radius": "2""#,
            3.0 * 4.0 / 2.0,
        ),
        (r#""shape": "ring", "mass": "3", "radius": "2""#, 3.0 * 4.0),
        (
            r#""shape": "sphere", "mass": "3", "radius": "2""#,
            3.0 * 4.0 * 2.0 / 5.0,
        ),
        (
            r#""shape": "rectangle", "mass": "3", "width": "2", "height": "5", "angle": "1""#,
            3.0 * (4.0 + 25.0) / 12.0,
        ),
        (r#""shape": "body", "mass": "3", "inertia": "7""#, 7.0),
        (
            r#""shape": "body", "mass": "3", "radius_of_gyration": "2""#,
            12.0,
        ),
        (
            r#""shape": "rod", "mass": "3", "length": "2", "inertia": "7""#,
            7.0,
        ),
        (r#""shape": "rod", "mass": "0", "length": "2""#, 0.0),
    ];
    for (body, expected) in rows {
        let text = format!(
            r#"{{"title": "t", "bodies": {{"ground": {{"shape": "fixed"}}, "b": {{{body}, "center": ["1", "-2"]}}}},
            "contacts": {{"C": {{"bodies": ["ground", "b"], "at": "b", "law": "sticking"}}}},
            "questions": {{"w": {{"spin": "b"}}}}}}"#
        );
        let scene = read(&text);
        let solid = outline::solid(&scene.bodies[1], &Point::default()).expect("numbers");
        assert!(
            (solid.inertia - expected).abs() < 1e-13 * expected.max(1.0),
            "{body}: {}",
            solid.inertia
        );
        close(solid.center[0], 1.0, 1e-15);
        close(solid.center[1], -2.0, 1e-15);
    }
}

#[test]
fn a_composite_has_its_center_and_inertia_by_parallel_axes() {
    let scene = read(
        r#"{"title": "t", "points": {"A": ["1", "2"], "B": ["4", "6"]},
        "bodies": {"ground": {"shape": "fixed"}, "c": {"shape": "composite", "parts": {
            "disk": {"shape": "disk", "mass": "2", "radius": "1/2", "center": "A"},
            "rod": {"shape": "rod", "mass": "3", "length": "5", "angle": "atan(4/3)", "center": ["5/2", "4"]},
            "ball": {"shape": "particle", "mass": "5", "center": "B"}}}},
        "contacts": {"C": {"bodies": ["ground", "c"], "at": "A", "law": "sticking"}},
        "questions": {"w": {"spin": "c"}}}"#,
    );
    let solid = outline::solid(&scene.bodies[1], &Point::default()).expect("numbers");
    // Along the line from A: 0, 5/2 and 5; the center of mass at 65/20.
    let s: f64 = (3.0 * 2.5 + 5.0 * 5.0) / 10.0;
    let inertia =
        2.0 * (0.125 + s * s) + 3.0 * (25.0 / 12.0 + (2.5 - s).powi(2)) + 5.0 * (5.0 - s).powi(2);
    close(solid.inertia, inertia, 1e-14);
    close(solid.center[0], 1.0 + 0.6 * s, 1e-14);
    close(solid.center[1], 2.0 + 0.8 * s, 1e-14);
    assert_eq!(solid.mass, 10.0);
}

#[test]
fn a_wrong_row_of_inertia_is_noticed() {
    let text = std::fs::read_to_string("derivations/book/falling-stick.json").expect("shipped");
    let mut scene = read(&text);
    let bar = scene
        .bodies
        .iter()
        .position(|b| b.name == "bar")
        .expect("the bar");
    let at = point(&[("m", 2.0), ("l", 3.0), ("v", 5.0), ("theta", 0.4)]);
    let gap = |scene: &Scene| {
        let answers = numeric::answers(scene, &at, numeric::solve_f64).expect("answers");
        let Ok(numeric::Answer::Scalar(told)) = answers[0].1 else {
            panic!("a spin");
        };
        let followed = follow(scene, &at).expect("numbers");
        told + value_of(&passed(&followed, 0).after.bodies[bar].spin)
    };
    assert!(gap(&scene).abs() < 1e-12);
    scene.bodies[bar].inertia = &scene.bodies[bar].inertia * &Expr::from(2);
    assert!(gap(&scene).abs() > 0.1);
}
