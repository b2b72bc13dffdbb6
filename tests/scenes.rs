//! Every scene in `derivations/` is read, and the schema knows every field it uses.
//!
//! `UPDATE=1 cargo test --test all scenes::` writes `schema/scene.schema.json` anew.

use crate::shared;

use std::fs;
use std::path::PathBuf;

use carom::expr::Expr;
use carom::scene;
use proptest::prelude::*;
use serde_json::Value;

/// All scene files, the refused ones not among them.
fn scenes() -> Vec<(PathBuf, String)> {
    let read = |path: PathBuf| {
        let text = fs::read_to_string(&path).expect("a scene file");
        (path, text)
    };
    let files = shared::files("derivations", "json");
    files.into_iter().map(read).collect()
}

#[test]
fn every_shipped_scene_is_read_without_remarks() {
    let scenes = scenes();
    assert!(scenes.len() >= 16, "{} scenes", scenes.len());
    for (path, text) in scenes {
        let name = path.display().to_string();
        match scene::read(&text) {
            Ok(scene) => assert_eq!(scene.remarks, Vec::<String>::new(), "{name}"),
            Err(faults) => panic!("{}", faults.render(&name, &text)),
        }
    }
}

/// The part of the schema that a `$ref` stands for.
fn resolved<'a>(schema: &'a Value, root: &'a Value) -> &'a Value {
    match schema["$ref"].as_str().and_then(|r| r.strip_prefix('#')) {
        Some(pointer) => root.pointer(pointer).expect("a definition of the schema"),
        None => schema,
    }
}

/// What is wrong with a value by the schema: types, fields, words and lengths, which is all our schema speaks of.
fn misfit(value: &Value, schema: &Value, root: &Value) -> Option<String> {
    let schema = resolved(schema, root);
    let choices = ["anyOf", "oneOf"].iter().find_map(|k| schema[k].as_array());
    if let Some(choices) = choices {
        let fits = choices.iter().any(|c| misfit(value, c, root).is_none());
        return (!fits).then(|| format!("{value} fits none of the choices"));
    }
    if schema["const"].is_string() && schema["const"] != *value {
        return Some(format!("{value} is not {}", schema["const"]));
    }
    let kind = match value {
        Value::Null => "null",
        Value::Bool(_) => "boolean",
        Value::Number(_) => "number",
        Value::String(_) => "string",
        Value::Array(_) => "array",
        Value::Object(_) => "object",
    };
    let is_kind = |t: &Value| t.as_str() == Some(kind);
    let has_kind = match &schema["type"] {
        Value::Array(kinds) => kinds.iter().any(is_kind),
        Value::Null => true,
        one => is_kind(one),
    };
    if !has_kind {
        return Some(format!("{value} is no {}", schema["type"]));
    }
    match value {
        Value::Array(items) => {
            let outside = |k: &str, wrong: fn(u64, u64) -> bool| {
                schema[k]
                    .as_u64()
                    .is_some_and(|bound| wrong(items.len() as u64, bound))
            };
            if outside("minItems", |n, b| n < b) || outside("maxItems", |n, b| n > b) {
                return Some(format!("{value} has {} items", items.len()));
            }
            items
                .iter()
                .find_map(|item| misfit(item, &schema["items"], root))
        }
        Value::Object(fields) => {
            let required = schema["required"]
                .as_array()
                .into_iter()
                .flatten()
                .filter_map(Value::as_str);
            if let Some(missing) = required
                .into_iter()
                .find(|name| !fields.contains_key(*name))
            {
                return Some(format!("{missing} is missing"));
            }
            fields.iter().find_map(|(name, field)| {
                match (&schema["properties"][name], &schema["additionalProperties"]) {
                    (Value::Null, Value::Bool(false)) => Some(format!("{name} is unknown")),
                    (Value::Null, others) => misfit(field, others, root),
                    (own, _) => misfit(field, own, root),
                }
            })
        }
        _ => None,
    }
}

#[test]
fn the_schema_fits_every_shipped_scene() {
    let schema: Value = serde_json::from_str(&scene::schema()).expect("the schema is JSON");
    for (path, text) in scenes() {
        let value: Value = serde_json::from_str(&text).expect("shipped scenes are plain JSON");
        assert_eq!(misfit(&value, &schema, &schema), None, "{}", path.display());
    }
}

#[test]
fn the_schema_lies_where_every_shipped_scene_names_it() {
    let file = "schema/scene.schema.json";
    let schema = scene::schema() + "\n";
    if std::env::var_os("UPDATE").is_some() {
        fs::write(file, &schema).expect("a writable schema");
    }
    let kept = fs::read_to_string(file).expect("the schema");
    assert_eq!(kept, schema, "UPDATE=1 cargo test --test all scenes::");
    let schema: Value = serde_json::from_str(&schema).expect("JSON");
    assert!(schema["$id"].is_string());
    let file = fs::canonicalize(file).expect("a path");
    for (path, text) in scenes() {
        let scene: Value = serde_json::from_str(&text).expect("JSON");
        let named = scene["$schema"].as_str().expect("a scene names its schema");
        let named = path.parent().expect("a folder").join(named);
        assert_eq!(
            fs::canonicalize(named).ok(),
            Some(file.clone()),
            "{}",
            path.display()
        );
    }
}

#[test]
fn the_schema_knows_what_is_required_and_what_is_not_there() {
    let schema: Value = serde_json::from_str(&scene::schema()).expect("the schema is JSON");
    for text in [
        r#"{}"#,
        r#"{"bodies": {}, "bodeis": {}}"#,
        r#"{"bodies": {"b": {"shape": "cube"}}}"#,
        r#"{"bodies": {"b": {"shape": "rod", "length": true}}}"#,
        r#"{"bodies": {"b": {"shape": "rod", "velocity": ["0"]}}}"#,
        r#"{"bodies": {"b": {"shape": "rod", "center": {"distance": "l"}}}}"#,
    ] {
        let value: Value = serde_json::from_str(text).expect("JSON");
        assert!(misfit(&value, &schema, &schema).is_some(), "{text}");
    }
}

#[test]
fn every_field_of_the_schema_is_described() {
    fn check(name: &str, schema: &Value) {
        for (field, described) in schema["properties"].as_object().into_iter().flatten() {
            assert!(described["description"].is_string(), "{name}: {field}");
        }
    }
    let schema: Value = serde_json::from_str(&scene::schema()).expect("the schema is JSON");
    check("scene", &schema);
    for (name, definition) in schema["$defs"].as_object().into_iter().flatten() {
        check(name, definition);
    }
}

fn question<'s>(scene: &'s scene::Scene, name: &str) -> &'s scene::Question {
    scene
        .questions
        .iter()
        .find(|q| q.name == name)
        .expect("the question is there")
}

fn parameter<'s>(scene: &'s scene::Scene, name: &str) -> &'s scene::Parameter {
    scene
        .parameters
        .iter()
        .find(|p| *p.name == *name)
        .expect("the parameter is there")
}

fn shipped(name: &str) -> scene::Scene {
    let (_, text) = scenes()
        .into_iter()
        .find(|(path, _)| path.ends_with(name))
        .expect("the scene is shipped");
    scene::read(&text).expect("the scene is read")
}

/// Whether two expressions are equal on the domain of a scene.
fn same(scene: &scene::Scene, a: &Expr, b: &str) -> bool {
    let symbols: carom::formula::Symbols = scene.parameters.iter().map(|p| &*p.name).collect();
    let b = carom::formula::read_expr(b, &symbols).expect("a formula");
    let decision = carom::equality::decide(a, &b, &scene.domains);
    matches!(decision.equality, carom::equality::Equality::Same { .. })
}

#[test]
fn a_value_is_kept_exactly_and_in_si_units() {
    let scene = shipped("billiard-ball.json");
    assert_eq!(parameter(&scene, "r").value, Some(Expr::ratio(3, 100)));
    assert_eq!(parameter(&scene, "r").scale(), Expr::ratio(1, 1000));
    assert_eq!(parameter(&scene, "m").value, Some(Expr::ratio(1, 5)));
}

#[test]
fn shapes_have_the_inertia_of_the_tables() {
    let text = |body: &str| {
        format!(
            r#"{{"parameters": {{"m": {{"unit": "kg"}}, "a": {{"unit": "m"}}, "b": {{"unit": "m"}}}},
                "bodies": {{"x": {{"mass": "m", "center": ["0", "0"], {body}}}}}}}"#
        )
    };
    for (body, inertia) in [
        (r#""shape": "rod", "length": "a""#, "m*a^2/12"),
        (r#""shape": "disk", "radius": "a""#, "m*a^2/2"),
        (r#""shape": "ring", "radius": "a""#, "m*a^2"),
        (r#""shape": "sphere", "radius": "a""#, "2/5*m*a^2"),
        (
            r#""shape": "rectangle", "width": "a", "height": "b""#,
            "m*(a^2 + b^2)/12",
        ),
        (r#""shape": "body", "radius_of_gyration": "a""#, "m*a^2"),
        (
            r#""shape": "rod", "length": "a", "inertia": "m*a*b""#,
            "m*a*b",
        ),
    ] {
        let text = text(body);
        let scene =
            scene::read(&text).unwrap_or_else(|faults| panic!("{}", faults.render(body, &text)));
        assert!(
            same(&scene, &scene.bodies[0].inertia, inertia),
            "{body}: {:?}",
            scene.bodies[0].inertia
        );
    }
}

#[test]
fn a_composite_has_its_center_and_inertia_by_parallel_axes() {
    let scene = shipped("dumbbell-strikes-peg.json");
    let dumbbell = &scene.bodies[1];
    assert!(same(&scene, &dumbbell.mass, "4*m"));
    assert!(same(&scene, &dumbbell.center[0], "l"));
    assert!(dumbbell.center[1].is_zero());
    assert!(
        same(&scene, &dumbbell.inertia, "12*m*l^2"),
        "m (3l)² + 3m l²: {:?}",
        dumbbell.inertia
    );
}

#[test]
fn a_body_that_turns_about_a_point_has_the_velocity_of_that_motion() {
    let text = r#"{"parameters": {"m": {"unit": "kg"}, "l": {"unit": "m"}, "w": {"unit": "rad/s"}},
        "points": {"A": ["0", "0"]},
        "bodies": {"support": {"shape": "fixed"},
            "rod": {"shape": "rod", "mass": "m", "length": "l", "angle": "-pi/2",
                    "center": {"from": "A", "by": ["0", "-l/2"]}, "velocity": {"about": "A"}, "spin": "w"}},
        "hinges": {"A": {"bodies": ["support", "rod"], "at": "A"}}}"#;
    let scene = scene::read(text).expect("the hinge does not pull");
    assert!(same(&scene, &scene.bodies[1].velocity[0], "w*l/2"));
    assert!(same(&scene, &scene.bodies[1].velocity[1], "0*w"));
}

#[test]
fn the_contact_of_the_flying_dish_is_left_of_and_above_the_center_of_the_plate() {
    let scene = shipped("flying-dish.json");
    let plate = scene
        .bodies
        .iter()
        .find(|b| b.name == "plate")
        .expect("the plate");
    let arm = carom::expr::minus(&scene.contacts[0].at, &plate.center);
    assert!(same(&scene, &arm[0], "-b") && same(&scene, &arm[1], "d"));
}

#[test]
fn a_matrix_takes_balances_and_known_velocities_as_rows() {
    let scene = shipped("two-masses.json");
    let scene::Ask::Matrix { rows, unknowns } = &question(&scene, "matrix").ask else {
        panic!("no matrix")
    };
    assert_eq!(rows, &["lmb_n", "lmb_t", "given"]);
    assert_eq!(unknowns, &["v1", "v2t", "v2n"]);
    assert_eq!(scene.after[1].name, "given");
}

#[test]
fn a_value_can_be_set_and_is_checked() {
    let mut scene = shipped("falling-stick.json");
    assert_eq!(scene::set(&mut scene, "theta", "pi/6"), Ok(()));
    assert_eq!(scene::set(&mut scene, "l", "0.1"), Ok(()));
    assert_eq!(parameter(&scene, "l").value, Some(Expr::ratio(1, 10)));
    for (name, value, said) in [
        (
            "theta",
            "2",
            "theta is 2, outside its domain 0 ≤ theta ≤ pi/2",
        ),
        ("tehta", "1", "there is no parameter `tehta`"),
        ("l", "1/0", "division by zero"),
        ("l", "v", "`v` is not declared"),
    ] {
        let fault = scene::set(&mut scene, name, value).expect_err(value);
        assert_eq!(fault.message, said);
    }
    assert!(
        same(
            &scene,
            parameter(&scene, "theta").value.as_ref().expect("a value"),
            "pi/6"
        ),
        "a refused value changes nothing"
    );
}

#[test]
fn what_counts_turns_is_shown_at_a_whole_number() {
    let mut seen = 0;
    for (path, text) in scenes() {
        let scene = scene::read(&text).expect("a sound scene");
        let counts = |p: &&scene::Parameter| scene.counts_turns(&p.name);
        for p in scene.parameters.iter().filter(counts) {
            let shown = carom::figure::shown_at(&scene);
            let value = shown.values.get(&p.name).copied().expect("a value");
            assert!(value >= 1.0 && value.fract() == 0.0, "{path:?}: {value}");
            seen += 1;
        }
    }
    assert!(seen >= 2, "{seen} numbers of turns");
}

#[test]
fn values_are_checked_together_in_whatever_order_they_come() {
    let value = |scene: &scene::Scene, name: &str| parameter(scene, name).value.clone();
    for values in [[("r", "8"), ("d", "5")], [("d", "5"), ("r", "8")]] {
        let mut scene = shipped("billiard-ball.json");
        assert_eq!(scene::set_all(&mut scene, values), Ok(()));
        assert_eq!(value(&scene, "d"), Some(Expr::ratio(5, 1000)));
        let wrong = [("d", "4"), ("r", "3")];
        let fault =
            scene::set_all(&mut scene, wrong).expect_err("the ball is struck beside itself");
        assert_eq!(fault.0, None);
        assert_eq!(value(&scene, "d"), Some(Expr::ratio(5, 1000)));
        assert_eq!(value(&scene, "r"), Some(Expr::ratio(8, 1000)));
    }
}

#[test]
fn numbers_may_have_their_unit_beside_them() {
    let scene = r#"{
        "title": "Gliders",
        "parameters": {"v": {"unit": "m/s", "value": "36 km/h"}, "theta": {"unit": "deg", "value": "30 deg"}},
        "bodies": {
            "a": {"shape": "particle", "mass": "500 g", "center": [0, 0], "velocity": ["v*cos(theta)", "18 km/h"]},
            "b": {"shape": "particle", "mass": 2, "center": [0, 0]}
        },
        "contacts": {"C": {"bodies": ["a", "b"], "at": [0, 0], "law": "sticking"}},
        "questions": {"u": {"velocity": "a"}}
    }"#;
    let read = scene::read(scene).expect("a sound scene");
    let value = |name: &str| parameter(&read, name).value.clone().expect("a value");
    assert_eq!(value("v"), Expr::from(10));
    assert!(same(&read, &value("theta"), "pi/6"));
    assert_eq!(read.bodies[0].mass, Expr::ratio(1, 2));
    assert_eq!(read.bodies[0].velocity[1], Expr::from(5));
    for (from, to, said) in [
        ("500 g", "500 m", "expected mass, found length (m)"),
        (
            "18 km/h",
            "18 Hz",
            "expected length/time, found 1/time (Hz)",
        ),
        (
            "36 km/h",
            "36 km",
            "expected length/time, found length (km)",
        ),
    ] {
        let faults = scene::read(&scene.replace(from, to)).expect_err(to);
        assert_eq!(faults.list[0].message, said);
    }
}

#[test]
fn a_value_in_degrees_is_a_multiple_of_pi() {
    let mut scene = shipped("rod-hits-smooth-floor.json");
    assert_eq!(scene::set(&mut scene, "theta", "30"), Ok(()));
    assert!(same(
        &scene,
        parameter(&scene, "theta").value.as_ref().expect("a value"),
        "pi/6"
    ));
    // The value of an inverse function is an angle as it stands.
    assert_eq!(scene::set(&mut scene, "theta", "2*acos(12/13)"), Ok(()));
    assert!(same(
        &scene,
        parameter(&scene, "theta").value.as_ref().expect("a value"),
        "2*acos(12/13)"
    ));
    assert!(
        scene::set(&mut scene, "theta", "90").is_err(),
        "the upper end is excluded"
    );
}

#[test]
fn distractor_data_are_named_as_unused() {
    let text = r#"{"parameters": {"m": {"unit": "kg"}, "g": {"unit": "m/s^2"}},
        "bodies": {"ball": {"shape": "particle", "mass": "m"}}}"#;
    let scene = scene::read(text).expect("a scene");
    assert_eq!(
        scene.remarks,
        ["the parameter `g` is not used in this scene"]
    );
}

/// Pieces that scenes are made of, to be put in wrong places.
fn piece() -> impl Strategy<Value = String> {
    let words = prop::sample::select(vec![
        "{",
        "}",
        "[",
        "]",
        ":",
        ",",
        "\"",
        "\\",
        "//",
        "/*",
        "*/",
        "\"bodies\"",
        "\"shape\"",
        "\"rod\"",
        "\"from\"",
        "\"C\"",
        "null",
        "true",
        "1e999",
        "-0.1",
        "0",
        "\"l/2\"",
        "\"((\"",
        "\"theta\"",
        "\"1/0\"",
        "\"about\"",
        "\u{202e}",
        "\"\\ud835\"",
        "é",
    ]);
    prop_oneof![
        words.prop_map(str::to_owned),
        any::<char>().prop_map(String::from)
    ]
}

fn read_and_render(text: &str) {
    if let Err(faults) = scene::read(text) {
        assert!(!faults.list.is_empty());
        for fault in &faults.list {
            assert!(fault.line >= 1 && fault.column >= 1 && fault.span.start <= fault.span.end);
        }
        faults.render("fuzz.json", text);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_text_makes_the_reader_panic(text in ".{0,200}") {
        read_and_render(&text);
    }

    #[test]
    fn no_jumble_of_pieces_makes_the_reader_panic(pieces in prop::collection::vec(piece(), 0..60)) {
        read_and_render(&pieces.concat());
    }

    #[test]
    fn no_change_of_a_shipped_scene_makes_the_reader_panic(
        which in any::<prop::sample::Index>(),
        edits in prop::collection::vec((any::<prop::sample::Index>(), 0..12usize, piece()), 1..4),
    ) {
        let all = scenes();
        let mut letters: Vec<char> = all[which.index(all.len())].1.chars().collect();
        for (at, cut, new) in edits {
            let start = at.index(letters.len() + 1);
            let end = (start + cut).min(letters.len());
            letters.splice(start..end, new.chars());
        }
        read_and_render(&letters.into_iter().collect::<String>());
    }
}

#[test]
fn a_formula_may_name_an_answer_that_is_asked_further_down() {
    let names = |questions: &str| -> Vec<String> {
        let text = format!(
            r#"{{
              "parameters": {{"m": {{"unit": "kg"}}, "v": {{"unit": "m/s"}}, "e": {{}}}},
              "bodies": {{
                "left": {{"shape": "particle", "mass": "m", "velocity": ["v", "0"]}},
                "right": {{"shape": "particle", "mass": "2*m"}}
              }},
              "contacts": {{
                "c": {{"bodies": ["left", "right"], "at": ["0", "0"], "normal": ["1", "0"], "law": "frictionless", "restitution": "e"}}
              }},
              "questions": {{{questions}}}
            }}"#
        );
        let scene =
            carom::scene::read(&text).unwrap_or_else(|f| panic!("{}", f.render("a", &text)));
        scene.questions.iter().map(|q| q.name.clone()).collect()
    };
    let [share, w, u] = [
        r#""share": {"value": "w/v"}"#,
        r#""w": {"value": "u_x/2"}"#,
        r#""u": {"velocity": "right"}"#,
    ];
    let found = names(&[share, w, u].join(", "));
    assert_eq!(found, ["u", "w", "share"]);
    let found = names(&[u, w, share].join(", "));
    assert_eq!(found, ["u", "w", "share"]);
}

#[test]
fn round_bodies_touch_on_the_line_of_their_centers() {
    let text = r#"{
      "parameters": {"m": {"unit": "kg"}, "R": {"unit": "m"}, "v": {"unit": "m/s"}},
      "bodies": {
        "A": {"shape": "sphere", "mass": "m", "radius": "R", "center": [0, "R"], "velocity": ["v", 0]},
        "B": {"shape": "sphere", "mass": "m", "radius": "2*R", "center": ["3*R", "R"]}
      },
      "contacts": {"C": {"bodies": ["A", "B"], "law": "frictionless", "restitution": 1}},
      "questions": {"u": {"velocity": "B"}}
    }"#;
    let scene = scene::read(text).unwrap_or_else(|f| panic!("{}", f.render("a", text)));
    let contact = &scene.contacts[0];
    let radius = Expr::symbol("R");
    // Nothing is left of what cancels.
    assert_eq!(contact.normal, Some([Expr::one(), Expr::zero()]));
    assert_eq!(contact.at, [radius.clone(), radius]);
}
