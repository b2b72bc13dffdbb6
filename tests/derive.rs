//! Derivations of the shipped scenes: what the answers are, how few equations they took, and that every check holds.

use crate::shared;

use std::collections::BTreeMap;
use std::path::PathBuf;

use carom::answer::Form;
use carom::derive::{Derivation, derive};
use carom::equality::{Equality, decide};
use carom::expr::Expr;
use carom::formula::{Symbols, read_expr, write_plain};
use carom::scene::Scene;
use carom::verify::{expand, prove};

fn scene(name: &str) -> Scene {
    let path = format!("derivations/{name}.json");
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"));
    carom::scene::read(&text).unwrap_or_else(|faults| panic!("{}", faults.render(&path, &text)))
}

fn shipped() -> Vec<String> {
    let files = shared::files("derivations", "json");
    let name = |p: &PathBuf| {
        p.strip_prefix("derivations")
            .expect("below derivations")
            .with_extension("")
    };
    // Stories have a table and tests of their own.
    let alone = |name: &String| !scene(name).has_stages();
    files
        .iter()
        .map(|p| name(p).display().to_string())
        .filter(alone)
        .collect()
}

fn closed(derivation: &Derivation, answer: &str) -> Expr {
    let found = derivation
        .answers
        .iter()
        .find(|a| a.name == answer)
        .unwrap_or_else(|| panic!("no answer {answer}"));
    match &found.form {
        Form::Value { closed, .. } => closed.clone(),
        other => panic!("{answer} is no closed form: {other:?}"),
    }
}

/// A formula, with a part that may be defined behind `where`.
fn formula(scene: &Scene, text: &str) -> Expr {
    let mut symbols = Symbols::strict();
    scene
        .parameters
        .iter()
        .for_each(|p| symbols.declare(&p.name));
    let (text, definition) = text.split_once(" where ").unwrap_or((text, ""));
    let mut values = BTreeMap::new();
    if let Some((name, value)) = definition.split_once(" = ") {
        let value = read_expr(value, &symbols).unwrap_or_else(|f| panic!("{}", f.show(value)));
        symbols.declare(name);
        values.insert(name.into(), value);
    }
    let e = read_expr(text, &symbols).unwrap_or_else(|f| panic!("{}", f.show(text)));
    e.substitute(&values)
}

#[test]
fn the_answers_are_those_of_the_table() {
    let table = std::fs::read_to_string("tests/derive/answers.tsv").expect("the table of answers");
    let mut rows = 0;
    for row in table
        .lines()
        .filter(|l| !l.starts_with('#') && !l.is_empty())
    {
        let cells: Vec<&str> = row.split('\t').collect();
        let [name, answer, expected, _why] = cells.as_slice() else {
            panic!("not four columns: {row}")
        };
        let scene = scene(name);
        let derivation = derive(&scene).expect("a derivation");
        let got = closed(&derivation, answer);
        let decision = decide(&got, &formula(&scene, expected), &scene.domains);
        let same = matches!(decision.equality, Equality::Same { .. });
        assert!(
            same,
            "{name}: {answer} = {}, expected {expected}: {:?}",
            write_plain(&got),
            decision.equality
        );
        rows += 1;
    }
    assert!(rows >= 25, "the table has only {rows} rows");
}

#[test]
fn every_check_of_every_shipped_scene_holds() {
    let scenes = shipped();
    assert!(scenes.len() >= 16, "{scenes:?}");
    for name in scenes {
        let scene = scene(&name);
        let derivation = derive(&scene).unwrap_or_else(|stop| panic!("{name}: {stop}"));
        let proof = prove(&scene, &derivation);
        for check in proof.scene.iter().chain(proof.answers.iter().flatten()) {
            assert!(
                check.holds != Some(false),
                "{name}: {} {}",
                check.kind,
                check.words
            );
        }
        if derivation.counting.determined() {
            let identity = proof
                .scene
                .iter()
                .find(|c| c.kind == "identity")
                .expect("an identity check");
            assert_eq!(identity.holds, Some(true), "{name}: {}", identity.words);
        }
    }
}

/// Equations of the book's own solution, counted in section 17.5.
#[test]
fn an_angle_with_a_fixed_part_is_held_against_the_solution_in_doubles() {
    let text = r#"{"title": "a rod falls on the edge of a table, 30° more than θ above it",
        "parameters": {"m": {"unit": "kg"}, "l": {"unit": "m"}, "v": {"unit": "m/s"},
                       "theta": {"unit": "rad", "domain": {"min": 0, "max": "pi/4"}}},
        "bodies": {"table": {"shape": "fixed"},
                   "rod": {"shape": "rod", "mass": "m", "length": "l", "angle": "theta + pi/6", "velocity": [0, "-v"],
                           "center": ["l/2*cos(theta + pi/6)", "l/2*sin(theta + pi/6)"]}},
        "contacts": {"A": {"bodies": ["table", "rod"], "at": [0, 0], "law": "frictionless", "normal": "y",
                           "restitution": 0}},
        "questions": {"omega": {"spin": "rod"}}}"#;
    let scene = carom::scene::read(text).unwrap_or_else(|f| panic!("{}", f.render("rod", text)));
    let proof = prove(&scene, &derive(&scene).expect("a motion"));
    let mut checks = proof.answers.iter().flatten();
    let held = checks.find(|check| check.kind == "doubles");
    let held = held.expect("a check in doubles");
    assert_eq!(held.holds, Some(true), "{}", held.words);
}

#[test]
fn no_derivation_uses_more_equations_than_the_book() {
    let book = [
        ("book/falling-stick", 3), // one for ω, two for the impulse
        ("book/billiard-ball", 2), // momentum along x, angular momentum about the center
        ("book/ball-hits-bat", 5), // one for ω; momentum of the ball and of the bar, two components each
        ("book/flying-dish", 7),   // (17.63) to (17.69)
        ("book/pool-balls-elastic", 7),
        ("book/pool-balls", 7),
        ("book/two-masses", 3), // (17.59), (17.60) and the given one
        ("book/immovable-object", 3),
        ("book/two-bodies-sticking", 8),
        ("book/two-bodies-frictionless", 7),
    ];
    for (name, most) in book {
        let derivation = derive(&scene(name)).expect("a derivation");
        let used: usize = derivation.blocks.iter().map(|b| b.equations.len()).sum();
        assert!(
            used <= most,
            "{name}: {used} equations, the book takes {most}"
        );
    }
}

#[test]
fn momentum_balance_alone_leaves_two_of_eight_unknowns_open() {
    let derivation = derive(&scene("book/two-bodies")).expect("a derivation");
    let c = &derivation.counting;
    assert_eq!(
        (c.equations, c.unknowns, c.rank, c.rank_with_system),
        (6, 8, 6, 6)
    );
    assert!(!c.determined());
    assert_eq!(
        c.closing_laws.len(),
        2,
        "sticking, and frictionless with restitution"
    );
}

#[test]
fn the_two_laws_of_the_book_close_the_equations() {
    for (name, n) in [
        ("book/two-bodies-sticking", 8),
        ("book/two-bodies-frictionless", 7),
    ] {
        let c = derive(&scene(name)).expect("a derivation").counting;
        assert_eq!((c.equations, c.unknowns, c.rank), (n, n, n), "{name}");
        assert!(c.determined());
    }
}

#[test]
fn the_general_answers_are_short() {
    let derivation = derive(&scene("book/two-bodies-frictionless")).expect("a derivation");
    let mut length: usize = derivation
        .definitions
        .iter()
        .map(|d| d.name.len() + 3 + write_plain(&d.value).len())
        .sum();
    for answer in &derivation.answers {
        if let Form::Value { short, .. } = &answer.form {
            let defined = derivation.definitions.iter().any(|d| d.value == *short);
            length += if defined { 0 } else { write_plain(short).len() };
        }
    }
    assert!(length <= 360, "{length} characters for all seven unknowns");
}

#[test]
fn a_short_form_stands_for_its_closed_form() {
    for name in shipped() {
        let derivation = derive(&scene(&name)).expect("a derivation");
        for answer in &derivation.answers {
            if let Form::Value { closed, short } = &answer.form {
                let names = expand(short, &derivation).symbols();
                assert!(
                    names.is_subset(
                        &scene(&name)
                            .parameters
                            .iter()
                            .map(|p| p.name.clone())
                            .collect()
                    ),
                    "{name}"
                );
                assert!(
                    closed.symbols().is_superset(&names) || closed != short,
                    "{name}: {}",
                    answer.name
                );
            }
        }
    }
}
