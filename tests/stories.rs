//! Stories: the scenes of `derivations/` with stages, their answers, and laws that hold for every story.

use crate::shared;

use std::path::{Path, PathBuf};

use carom::answer::{Answer, Form};
use carom::command::{self, Format, Numbers};
use carom::equality::{Equality, How, decide};
use carom::formula::{Content, Sentence, Symbols, read, write_plain};
use carom::numeric::{self, Answer as Found, follow};
use carom::render;
use carom::scene::Scene;
use carom::story::{Told, tell};

/// Where the scene of a name lies.
fn path(name: &str) -> PathBuf {
    let folders = [
        "tests/stories/scenes",
        "derivations/problems",
        "derivations/friction",
        "derivations/more",
    ];
    let paths = folders.map(|folder| Path::new(folder).join(format!("{name}.json")));
    let path = paths.into_iter().find(|path| path.exists());
    path.unwrap_or_else(|| panic!("no scene {name}"))
}

fn scene(name: &str) -> Scene {
    let path = path(name);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{name}: {e}"));
    carom::scene::read(&text).unwrap_or_else(|faults| panic!("{}", faults.render(name, &text)))
}

fn told(scene: &Scene) -> Told {
    tell(scene).unwrap_or_else(|reason| panic!("{}: {reason}", scene.title))
}

/// The scene of a name, told once for all tests.
fn told_of(name: &str) -> &'static Told {
    match shared::worked(&path(name)) {
        Ok(worked) => &worked.told,
        Err(reason) => panic!("{name}: {reason}"),
    }
}

fn shipped() -> Vec<String> {
    let files = shared::files("derivations/problems", "json");
    let stem = |path: &PathBuf| Some(path.file_stem()?.to_string_lossy().into_owned());
    let names = files.iter().filter_map(stem);
    names.filter(|name| scene(name).has_stages()).collect()
}

#[test]
fn the_second_way_finds_the_numbers_of_every_formula() {
    for name in shipped() {
        let scene = scene(&name);
        let told = told_of(&name);
        let mut held = 0;
        for seed in 0..40 {
            if held > 20 {
                break;
            }
            let at = follow::random_point(&scene, seed);
            let followed = numeric::follow(&scene, &at).unwrap_or_else(|u| panic!("{name}: {u}"));
            // Of several outcomes only the first is told, and only where its conditions hold.
            let is_told = |mut stage: Option<usize>| {
                while let Some(i) = stage {
                    let first = told.stages[i].cases.first();
                    let mut conditions = first.into_iter().flat_map(|c| &c.conditions);
                    if conditions.any(|(_, e)| e.evaluate(&at).is_none_or(|v: f64| v < 0.0)) {
                        return false;
                    }
                    stage = scene.stages[i].from;
                }
                true
            };
            for question in scene.questions.iter().filter(|q| is_told(q.stage)) {
                let found = match follow::answer(&scene, &followed, question, &at) {
                    Ok(numeric::Answer::Scalar(v)) => vec![(question.name.clone(), v)],
                    Ok(numeric::Answer::Vector([x, y])) => vec![
                        (format!("{}_x", question.name), x),
                        (format!("{}_y", question.name), y),
                    ],
                    Err(_) => continue,
                };
                for (answer, number) in found {
                    let formula = told.answers.iter().find(|a| a.name == answer);
                    let formula = formula.and_then(|a| a.formula());
                    let Some(expected) = formula.and_then(|f| f.evaluate(&at)) else {
                        continue;
                    };
                    let size = expected.abs().max(1e-3);
                    assert!(
                        (number - expected).abs() < 1e-7 * size,
                        "{name}, {answer} at {at:?}: {number} instead of {expected}"
                    );
                    held += 1;
                }
            }
        }
        let asks = scene.questions.iter().any(|q| q.stage.is_some());
        assert!(held > 0 || !asks, "{name}: nothing was compared");
    }
}

#[test]
fn the_answers_are_those_of_the_table_and_are_held() {
    let table = std::fs::read_to_string("tests/stories/answers.tsv").expect("the table");
    let mut wrong = Vec::new();
    let mut last: Option<(String, Scene, &Told)> = None;
    for row in table
        .lines()
        .filter(|l| !l.starts_with('#') && !l.is_empty())
    {
        let columns: Vec<&str> = row.split('\t').collect();
        let [name, answer, formula, _] = columns.as_slice() else {
            panic!("a row has four columns: {row}");
        };
        if last.as_ref().is_none_or(|l| l.0 != *name) {
            last = Some((name.to_string(), scene(name), told_of(name)));
        }
        let Some((_, scene, told)) = &last else {
            continue;
        };
        // An answer is open where its value is not determined, and there is none where no value does.
        if matches!(*formula, "open" | "none") {
            let found = told.answers.iter().find(|a| a.name == *answer);
            let fits = |form: &Form| match *formula {
                "open" => matches!(form, Form::Open(_)),
                _ => matches!(form, Form::Words),
            };
            let of_itself = format!("depends on {answer}");
            let ends = |t: &Sentence, with: &str| t.to_string().ends_with(with);
            // What the laws of an impact leave open, its author can close.
            let closes = |a: &Answer| match a.text.as_slice() {
                [only] => !ends(only, " do not determine it"),
                _ => true,
            };
            let tells = |a: &Answer| closes(a) && !a.text.iter().any(|t| ends(t, &of_itself));
            if !found.is_some_and(|a| fits(&a.form) && a.checks.is_empty() && tells(a)) {
                wrong.push(format!("{name} {answer}: not {formula}"));
            }
            continue;
        }
        let mut symbols = Symbols::strict();
        scene
            .parameters
            .iter()
            .for_each(|p| symbols.declare(&p.name));
        let reading = read(formula, &symbols).unwrap_or_else(|f| panic!("{}", f.show(formula)));
        let found = told
            .answers
            .iter()
            .find(|a| a.name == *answer)
            .unwrap_or_else(|| panic!("{name}: no answer {answer}"));
        let (relation, expected) = match &reading.content {
            Content::Relations(sides, relations) => (
                Some(relations[0]),
                sides[1].expr().expect("a formula").clone(),
            ),
            content => (None, content.expr().expect("a formula").clone()),
        };
        let Some(value) = found.formula() else {
            wrong.push(format!("{name} {answer}: no formula; {:?}", found.text));
            continue;
        };
        let holds = |c: &carom::answer::Check| {
            c.holds == Some(true) || c.holds.is_none() && c.kind != "integration"
        };
        if found.checks.is_empty() || !found.checks.iter().all(holds) {
            wrong.push(format!("{name} {answer}: not held: {:?}", found.checks));
        }
        if !matches!(
            decide(value, &expected, &scene.domains).equality,
            Equality::Same {
                how: How::Identity { .. }
            }
        ) {
            wrong.push(format!(
                "{name} {answer}: {} instead of {formula}",
                write_plain(value)
            ));
        }
        if let Some(relation) = relation
            && found.range.first().map(|r| r.1) != Some(relation)
        {
            wrong.push(format!(
                "{name} {answer}: {:?} instead of {formula}",
                found.range
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn no_check_of_a_further_scene_with_stages_fails() {
    let mut tried = 0;
    for path in shared::files("derivations/more", "json") {
        let text = std::fs::read_to_string(&path).expect("a scene");
        let scene = carom::scene::read(&text).expect("a sound scene");
        if scene.has_stages() {
            let told = carom::story::tell(&scene).expect("stages that fit");
            assert!(told.is_proved(), "{}", path.display());
            tried += 1;
        }
    }
    assert!(tried >= 30);
}

#[test]
fn every_check_of_every_story_holds_and_every_question_has_an_answer() {
    for name in shipped() {
        let told = told_of(&name);
        assert!(told.holds(), "{name}");
        for a in &told.answers {
            assert!(
                a.formula().is_some()
                    || !a.text.is_empty()
                    || matches!(a.form, carom::answer::Form::Equation { .. }),
                "{name}: {} has no answer",
                a.name
            );
            assert!(
                a.formula().is_none() && a.range.is_empty() || !a.checks.is_empty(),
                "{name}: {} does not say how it is known",
                a.name
            );
            let mut followed = a.checks.iter().filter(|c| c.kind == "integration");
            assert!(
                followed.all(|c| c.holds == Some(true)),
                "{name}: {} is not compared with the scene followed numerically",
                a.name
            );
        }
    }
}

#[test]
fn an_impact_that_begins_as_the_file_says_is_solved_in_fractions() {
    let mut held = 0;
    for folder in ["derivations/problems", "derivations/more"] {
        for path in shared::files(folder, "json") {
            let text = std::fs::read_to_string(&path).expect("a scene");
            let Ok(scene) = carom::scene::read(&text) else {
                continue;
            };
            for (i, stage) in scene.stages.iter().enumerate() {
                let Some(impact) = stage.from_the_file().filter(|own| own.friction().is_none())
                else {
                    continue;
                };
                let mut needed = numeric::needed(&impact);
                for symbol in follow::symbols(&scene) {
                    if !needed.angles.contains_key(&symbol) {
                        needed.add(&carom::expr::Expr::symbol(&symbol));
                    }
                }
                let exact = numeric::random_point(&needed, &scene.domains, 7);
                let at = numeric::rounded(&exact);
                let Ok(followed) = numeric::follow(&scene, &at) else {
                    continue;
                };
                let answers = numeric::answers(&impact, &exact, numeric::solve_exact);
                for (name, found) in answers.expect("laws that agree") {
                    let question = scene
                        .questions
                        .iter()
                        .find(|q| q.name == name && q.stage == Some(i));
                    let Some(question) = question else { continue };
                    let same = follow::answer(&scene, &followed, question, &at).expect("a number");
                    let pairs = match (found.expect("a fraction"), same) {
                        (Found::Scalar(a), Found::Scalar(b)) => vec![(a, b)],
                        (Found::Vector(a), Found::Vector(b)) => a.into_iter().zip(b).collect(),
                        _ => panic!("{name}: a number and a vector"),
                    };
                    for (exact, double) in pairs {
                        let exact = carom::expr::number::to_f64(&exact);
                        let close = (exact - double).abs() <= 1e-9 * exact.abs().max(1.0);
                        assert!(close, "{}: {name} is {exact} and {double}", path.display());
                        held += 1;
                    }
                }
            }
        }
    }
    assert!(held >= 20, "{held}");
}

#[test]
fn energy_is_kept_wherever_a_stage_says_so() {
    for name in shipped() {
        for stage in &told_of(&name).stages {
            for check in stage.checks.iter().filter(|c| c.kind == "integration") {
                assert_ne!(
                    check.holds,
                    Some(false),
                    "{name}, {}: {}",
                    stage.name,
                    check.words
                );
            }
        }
    }
}

#[test]
fn ways_that_only_a_boundary_would_allow_are_not_told() {
    let told = told_of("ball-bounces-twice-on-rough-ground");
    let ways = told.answers.iter().filter(|a| a.question == "w2").count();
    assert_eq!(ways, 5);
    let held = |a: &carom::answer::Answer| {
        a.checks
            .iter()
            .any(|c| c.kind == "integration" && c.holds == Some(true))
    };
    assert!(told.answers.iter().all(held));
}

#[test]
fn where_laws_contradict_the_solution_says_so_first() {
    let worked = carom::worked::out(&scene("laws-contradict")).expect("a scene that is told");
    let solution = worked.solution(carom::solution::Detail::Normal);
    let text = format!("{solution:?}");
    assert!(text.contains("the laws contradict each other"), "{text}");
}

/// A story in which a rod catches a peg, with these questions beside.
fn with(questions: &str) -> Result<Told, String> {
    let text = format!(
        r#"{{
          "parameters": {{
            "m": {{"unit": "kg"}}, "l": {{"unit": "m"}}, "v": {{"unit": "m/s"}}, "g": {{"unit": "m/s^2"}},
            "e": {{"unit": "1", "domain": {{"min": 0, "max": 1}}}}, "x": {{"unit": "1"}}, "y": {{"unit": "1"}}
          }},
          "points": {{"O": ["0", "0"]}},
          "bodies": {{
            "peg": {{"shape": "fixed"}},
            "rod": {{"shape": "rod", "mass": "m", "length": "l", "center": ["l/2", "0"], "velocity": ["0", "-v"]}}
          }},
          "stages": [
            {{"name": "catch", "impact": {{"contacts": {{"O": {{"bodies": ["peg", "rod"], "at": "O", "law": "sticking"}}}}}}}},
            {{"name": "swing", "turn": {{"body": "rod", "about": "O", "until": "above", "gravity": "g"}}}}
          ],
          "questions": {{"K": {{"at": "swing", "energy": "after"}}, {questions}}}
        }}"#
    );
    let scene = carom::scene::read(&text).map_err(|faults| faults.render("test", &text))?;
    tell(&scene).map_err(|reason| reason.to_string())
}

fn answer(questions: &str) -> carom::answer::Answer {
    let told = with(questions).unwrap_or_else(|reason| panic!("{reason}"));
    told.answers
        .into_iter()
        .find(|a| a.name == "q")
        .expect("the answer")
}

fn plain(all: &[carom::formula::Sentence]) -> String {
    let each: Vec<String> = all.iter().map(ToString::to_string).collect();
    each.join("; ")
}

fn said(questions: &str) -> String {
    plain(&answer(questions).text)
}

#[test]
fn a_threshold_tells_its_side_and_whether_the_limit_belongs_to_it() {
    for (holds, expected) in [
        ("K > 0", ">"),
        ("K >= 0", "≥"),
        ("0 > K", "<"),
        ("0 >= K", "≤"),
    ] {
        let a = answer(&format!(r#""q": {{"threshold": "v", "holds": "{holds}"}}"#));
        assert_eq!(
            a.range.first().map(|r| r.1.sign()),
            Some(expected),
            "{holds}"
        );
        assert!(
            a.checks
                .iter()
                .any(|c| c.kind == "sign" && c.holds == Some(true)),
            "{holds}"
        );
    }
}

#[test]
fn what_holds_wherever_a_motion_comes_to_rest_holds_beyond_the_value_from_which_it_does() {
    let told = told_of("block-thrown-down-a-slope-comes-to-rest");
    let least = told.answers.iter().find(|a| a.name == "mu_min");
    let range = &least.expect("an answer").range;
    let range = range
        .iter()
        .map(|(_, relation, value)| (relation.sign(), write_plain(value)));
    assert_eq!(
        range.collect::<Vec<_>>(),
        [(">", String::from("sin(alpha)/cos(alpha)"))]
    );
}

#[test]
fn a_condition_that_always_or_never_holds_is_told_as_such() {
    assert!(said(r#""q": {"threshold": "v", "holds": "v*m > 0"}"#).starts_with("it always holds"));
    assert!(
        said(r#""q": {"threshold": "v", "holds": "v + sqrt(g*l) < 0"}"#)
            .starts_with("it never holds")
    );
    assert!(said(r#""q": {"threshold": "g", "holds": "v > 0"}"#).contains("whatever g is"));
}

#[test]
fn just_below_and_just_above_a_threshold_the_integrated_motion_differs() {
    let a = answer(r#""q": {"threshold": "v", "holds": "K <= 0"}"#);
    assert!(
        a.checks
            .iter()
            .any(|c| c.kind == "integration" && c.holds == Some(true))
    );
    let told = with(r#""q": {"threshold": "v", "holds": "K <= 0"}"#).expect("a story");
    assert!(
        told.stages[1]
            .checks
            .iter()
            .any(|c| c.kind == "integration" && c.holds == Some(true))
    );
}

#[test]
fn roots_of_higher_degree_are_isolated_and_those_outside_the_domain_named() {
    let a = answer(r#""q": {"solve": "x", "holds": "x^5 - x - 1 = 0"}"#);
    assert!(plain(&a.text).contains("1.1673"), "{:?}", a.text);
    let a = answer(r#""q": {"solve": "x", "holds": "x^2 - x - 2 = 0"}"#);
    assert_eq!(a.formula().map(write_plain).as_deref(), Some("2"));
    assert!(
        a.discarded.iter().any(|d| d.to_string().contains("-1")),
        "{:?}",
        a.discarded
    );
    assert!(said(r#""q": {"solve": "x", "holds": "x^5 + y*x = 1"}"#).contains("degree 5"));
    // A root with a closed form stays beside factors that have none, and every such factor is isolated.
    let a = answer(r#""q": {"solve": "x", "holds": "(1 - 3*x)*sqrt(x^3 + x^2 + 1) = 0"}"#);
    assert_eq!(plain(&a.text), "x = 1/3");
    let a = answer(r#""q": {"solve": "x", "holds": "(2*y - x)*sqrt(x^3 + x - 1) = 0"}"#);
    let text = plain(&a.text);
    assert!(
        text.contains("x = 2*y") && text.contains("0.68232"),
        "{text}"
    );
    let a = answer(r#""q": {"solve": "x", "holds": "sqrt(x^3 + x - 1)*sqrt(x^5 + x - 3) = 0"}"#);
    let text = plain(&a.text);
    assert!(
        text.contains("0.68232") && text.contains("1.1329"),
        "{text}"
    );
}

#[test]
fn a_solution_brought_in_by_squaring_is_discarded() {
    // √(x + 2) = x has the solution 2; squared, also −1, and √(x + 2) = x − 4 has 7 and not 2.
    let a = answer(r#""q": {"solve": "x", "holds": "sqrt(x + 2) = x - 4"}"#);
    assert_eq!(a.formula().map(write_plain).as_deref(), Some("7"));
    assert!(
        a.discarded
            .iter()
            .any(|d| d.to_string().contains("squaring")),
        "{:?}",
        a.discarded
    );
}

#[test]
fn a_maximum_inside_at_the_bound_or_at_infinity_is_told_apart() {
    let inside = answer(r#""q": {"maximum": "e*(1 - e)", "over": ["e"]}"#);
    assert_eq!(inside.formula().map(write_plain).as_deref(), Some("1/4"));
    let bound = answer(r#""q": {"maximum": "v*(1 + e)", "over": ["e"]}"#);
    assert_eq!(bound.formula().map(write_plain).as_deref(), Some("2*v"));
    assert!(plain(&bound.text).contains("bound"));
    assert!(said(r#""q": {"maximum": "v/(1 + 1/x)", "over": ["x"]}"#).contains("never reached"));
    let apart = answer(r#""q": {"maximum": "x/(1 + x^2) + y/(1 + y^2)", "over": ["x", "y"]}"#);
    assert!(apart.formula().is_none() && plain(&apart.text).contains("one combination only"));
}

#[test]
fn a_false_claim_to_be_shown_fails_its_check() {
    let told = with(r#""q": {"show": "K = m*v^2"}"#).expect("a story");
    assert!(!told.holds());
}

#[test]
fn limits_are_found_by_value_by_powers_and_by_derivatives() {
    for (limit, to, expected) in [
        ("(x^2 - 1)/(x - 1)", "1", "2"),
        ("sin(x)/x", "0", "1"),
        ("(2*x + 1)/(x + 3)", "infinity", "2"),
        ("sqrt(x)/(x + 1)", "infinity", "0"),
    ] {
        let a = answer(&format!(
            r#""q": {{"limit": "{limit}", "tends": "x", "to": "{to}"}}"#
        ));
        assert_eq!(
            a.formula().map(write_plain).as_deref(),
            Some(expected),
            "{limit}"
        );
    }
    assert!(
        said(r#""q": {"limit": "x^2/(x + 1)", "tends": "x", "to": "infinity"}"#)
            .contains("beyond all bounds")
    );
}

#[test]
fn a_speed_at_a_stage_is_the_length_of_the_velocity_there() {
    let text = r#"{
        "parameters": {"m": {"unit": "kg"}, "h": {"unit": "m"}, "u": {"unit": "m/s"}, "g": {"unit": "m/s^2"}, "e": {"unit": "1"}},
        "bodies": {"floor": {"shape": "fixed"},
            "ball": {"shape": "particle", "mass": "m", "center": ["0", "h"], "velocity": ["u", "0"]}},
        "stages": [{"name": "fall", "fall": {"body": "ball", "gravity": "g", "height": "h"}},
            {"name": "bounce", "impact": {"contacts": {"C": {"bodies": ["floor", "ball"], "at": "ball",
                "normal": ["0", "1"], "law": "frictionless", "restitution": "e"}}}}],
        "questions": {"v": {"speed": "ball", "at": "fall", "latex": "v_1"}, "w": {"speed": "ball"}}
    }"#;
    let scene = carom::scene::read(text).unwrap_or_else(|f| panic!("{}", f.render("test", text)));
    let told = told(&scene);
    assert!(told.holds());
    let answers = told.answers.iter().filter_map(|a| {
        let value = carom::formula::write_plain(a.formula()?);
        Some((a.name.as_str(), a.latex.as_str(), value))
    });
    let expected = [
        ("v_velocity_x", "v_{1,x}", "u"),
        ("v_velocity_y", "v_{1,y}", "-sqrt(2*g*h)"),
        ("v", "v_1", "sqrt(2*g*h+u^2)"),
        ("w_velocity_x", "w_{x}", "u"),
        ("w_velocity_y", "w_{y}", "e*sqrt(2*g*h)"),
        ("w", "w", "sqrt(u^2+2*e^2*g*h)"),
    ];
    let found: Vec<_> = answers
        .map(|(a, b, c)| (a, b, c.replace(' ', "")))
        .collect();
    for (name, latex, value) in expected {
        assert!(
            found.contains(&(name, latex, String::from(value))),
            "{name}: {found:?}"
        );
    }
}

#[test]
fn questions_about_formulas_need_no_stages() {
    let scene = scene("tipping-box");
    let asks = scene.questions.clone();
    let formulas: Vec<_> = asks.into_iter().filter(|q| q.stage.is_none()).collect();
    let found = told(&scene);
    let known = found
        .answers
        .iter()
        .filter_map(|a| Some((a.name.as_str().into(), a.formula().cloned()?)))
        .collect();
    let alone = carom::answer::about(&scene, formulas.iter(), &known).expect("answers");
    let with_stages: Vec<_> = found
        .answers
        .iter()
        .filter(|a| formulas.iter().any(|q| q.name == a.question))
        .map(|a| (a.name.clone(), a.formula().cloned()))
        .collect();
    let alone: Vec<_> = alone
        .into_iter()
        .map(|a| (a.name.clone(), a.formula().cloned()))
        .collect();
    assert_eq!(alone, with_stages);
}

#[test]
fn where_sides_meet_several_times_the_intervals_are_told() {
    for (holds, expected) in [
        ("(x - 1)*(x - 3) <= 0", "it holds for 1 ≤ x ≤ 3"),
        ("(x - 1)*(x - 3) > 0", "it holds for x < 1, and for x > 3"),
        ("(x - 2)^2 > 0", "it holds for x < 2, and for x > 2"),
        ("(x - 2)^2 <= 0", "it holds for x = 2"),
        (
            "(x - y)*(x - 2*y) >= 0",
            "it holds for x ≤ y, and for x ≥ 2*y",
        ),
    ] {
        let found = said(&format!(r#""q": {{"threshold": "x", "holds": "{holds}"}}"#));
        assert!(found.starts_with(expected), "{holds}: {found}");
    }
}

/// A rod that turns clockwise through an angle under a moment.
fn driven(more: &str) -> Result<Told, String> {
    let text = format!(
        r#"{{
          "parameters": {{
            "m": {{"unit": "kg"}}, "l": {{"unit": "m"}}, "w": {{"unit": "rad/s"}}, "M": {{"unit": "N m"}},
            "a": {{"unit": "rad"}}
          }},
          "bodies": {{"rod": {{"shape": "rod", "mass": "m", "length": "l", "center": ["l/2", "0"], "spin": "-w",
            "velocity": {{"about": ["0", "0"]}}}}}},
          "stages": [{{"name": "drive", "turn": {{"body": "rod", "about": ["0", "0"], "torque": "M", {more}}}}}],
          "questions": {{"q": {{"reaction": "drive", "along": "y", "when": "start"}}, "w2": {{"spin": "rod"}}}}
        }}"#
    );
    let scene = carom::scene::read(&text).map_err(|faults| faults.render("test", &text))?;
    tell(&scene).map_err(|reason| reason.to_string())
}

#[test]
fn a_moment_counts_in_the_sense_of_the_rotation() {
    let told = driven(r#""by": "a", "clockwise": true"#).expect("a story");
    // I = m l²/3: clockwise, the center of mass is speeded up downwards.
    let force = told.answers[0].formula().expect("a force");
    assert_eq!(write_plain(force), "-3*M/(2*l)");
    assert!(told.holds(), "{:?}", told.answers);
    let taken: Vec<String> = told.stages[0]
        .assumptions
        .iter()
        .map(ToString::to_string)
        .collect();
    assert!(taken.contains(&String::from("a ≥ 0")), "{taken:?}");
}

#[test]
fn an_angle_turned_through_counts_in_the_sense_in_which_the_body_begins() {
    let spins = [r#""by": "a""#, r#""by": "a", "clockwise": true"#].map(|turn| {
        let told = driven(turn).expect("a story");
        write_plain(told.answers[1].formula().expect("a spin"))
    });
    assert_eq!(spins[0], spins[1]);
    let reason = driven(r#""by": "-1", "clockwise": true"#).expect_err("another sense");
    assert!(reason.contains("turn its sign round"), "{reason}");
}

#[test]
fn the_numbers_of_every_stage_are_printed() {
    let mut scene = scene("acrobat-to-handstand");
    for (name, value) in [("m", "2"), ("l", "3"), ("g", "10"), ("h", "2")] {
        carom::scene::set(&mut scene, name, value).expect("a value");
    }
    let at = follow::values(&scene).expect("every parameter has a value");
    let followed = numeric::follow(&scene, &at).expect("numbers");
    let text = render::stages::text(&scene, &followed, &at);
    for line in [
        "fall (fall, 0.632456 s)",
        "  acrobat  before    1.5      2            0          0          0             0",
        "  impulse of O on acrobat: (0, 3.16228) N s",
        "  it never gets to its end: it comes to rest before and turns back",
        "omega = 3.16227766016838 rad/s",
    ] {
        assert!(text.lines().any(|l| l == line), "{line}\nis not in\n{text}");
    }
    let json = render::stages::json(&scene, &followed, &at);
    assert_eq!(json["stages"][2]["lost"], "never ends");
    assert_eq!(
        json["stages"][1]["bodies"][1]["after"]["spin"],
        -3.16227766016838
    );
    scene.parameters[0].value = None;
    assert!(follow::values(&scene).is_err_and(|missing| missing.len() == 1));
}

#[test]
fn numbers_tell_where_what_a_body_turns_about_has_to_pull_it() {
    // It need not as long as v² (3 R − 2 h)² ≤ 9 g R² (R − h): up to v = 3.2636.
    for (speed, pulls) in [("3.263", false), ("3.264", true)] {
        let mut scene = scene("disk-climbs-over-a-step");
        for (name, value) in [
            ("m", "2"),
            ("R", "1"),
            ("h", "1/5"),
            ("g", "10"),
            ("v", speed),
        ] {
            carom::scene::set(&mut scene, name, value).expect("a value");
        }
        let out = command::solve(&scene, Numbers::Doubles, Format::Text);
        let text = out.expect("numbers").text;
        let words = "taken for granted: P grips: it pulls at the beginning";
        assert_eq!(text.contains(words), pulls, "{text}");
    }
}

#[test]
fn numbers_tell_formulas_of_answers_and_directions_in_degrees() {
    let solved = |name: &str, values: &[(&str, &str)]| {
        let mut scene = scene(name);
        for (name, value) in values {
            carom::scene::set(&mut scene, name, value).expect("a value");
        }
        let out = command::solve(&scene, Numbers::Doubles, Format::Text);
        out.expect("numbers").text
    };
    let wall = [
        ("m", "1"),
        ("u", "2"),
        ("w", "1"),
        ("h", "5"),
        ("g", "10"),
        ("e", "1/2"),
    ];
    let text = solved("where-a-ball-goes-from-a-wall", &wall);
    assert!(
        text.contains("phi = 2.356194490192345 rad ≈ 135°"),
        "{text}"
    );
    let drop = [("m", "1"), ("v", "3"), ("h", "5"), ("g", "10")];
    let text = solved("answers-named-by-double-letters", &drop);
    assert!(text.contains("twice = 5.99999999999999"), "{text}");
    let balls = [("m", "2"), ("M", "1"), ("v", "3")];
    let text = solved("ball-at-half-its-speed", &balls);
    assert!(text.lines().any(|l| l == "d = 1 m/s"), "{text}");
    let cars = [
        ("m1", "3"),
        ("m2", "4"),
        ("v1", "7"),
        ("v2", "7"),
        ("mu", "1/2"),
        ("g", "10"),
    ];
    let text = solved("cars-slide-from-a-crossing", &cars);
    assert!(text.lines().any(|l| l == "d = 2.5 m"), "{text}");
    // At another speed than the given one nothing was followed: its square has no number either.
    let box_ = [
        ("m", "1"),
        ("a", "1"),
        ("b", "1/2"),
        ("g", "10"),
        ("v", "2"),
    ];
    let text = solved("tipping-box", &box_);
    assert!(text.contains("omega = -1.2 rad/s"), "{text}");
    assert!(!text.contains("omega_critical_squared ="), "{text}");
    let none = text
        .lines()
        .find(|l| l.starts_with("no numbers of the motion"));
    let none = none.expect("what has no number is named");
    assert!(
        none.contains("omega_critical, omega_critical_squared"),
        "{none}"
    );
}

#[test]
fn what_follows_the_case_that_is_supposed_rests_on_its_condition() {
    let told = told_of("ball-bounces-with-backspin");
    let x = told.answers.iter().find(|a| a.name == "x");
    let given = plain(&x.expect("where it lands").assumptions);
    assert!(given.contains("sticks in compression"), "{given}");
}

#[test]
fn an_answer_tells_what_it_rests_on() {
    let table = std::fs::read_to_string("tests/stories/given.tsv").expect("the table");
    let rows = table
        .lines()
        .filter(|l| !l.starts_with('#') && !l.is_empty());
    for row in rows {
        let columns: Vec<&str> = row.split('\t').collect();
        let [name, answer, words, _] = columns.as_slice() else {
            panic!("a row has four columns: {row}");
        };
        let (scene, told) = (scene(name), told_of(name));
        let is_it = |a: &&Answer| a.name.split("_case").next() == Some(answer);
        let mine: Vec<&Answer> = told.answers.iter().filter(is_it).collect();
        let given = carom::answer::given_alike(&mine, &scene.domains).into_iter();
        let given = given.map(|words| words.written(|e| render::unicode(&scene, e)));
        let given: Vec<String> = given.collect();
        let is_told = |words: &str| given.iter().any(|g| g.contains(words));
        let as_stated = match words.strip_prefix("not: ") {
            Some(absent) => !mine.is_empty() && !is_told(absent),
            None => is_told(words),
        };
        assert!(as_stated, "{name} {answer}: {given:?}");
    }
}
