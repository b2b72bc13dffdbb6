//! Scenes as questions of learning platforms: well-formed, a branch for every belief, nothing of a scene acted on as markup.
//! That the branches end where they should is tried in Maxima by `tests/platforms/stack.py`.

use carom::export::{Exercise, Shown, exercise, moodle, numbas, stack};
use carom::expr::{Point, Symbol};
use carom::formula::Symbols;
use carom::grade::sheet::Sheet;
use carom::grade::{Options, Verdict};
use carom::render::html;
use carom::solution::Detail;
use carom::{command, worked};
use roxmltree::{Document, Node};
use std::collections::BTreeMap;

const FIGURE: &str = "A ball before a wall";

fn opened(text: &str) -> (Sheet, Exercise) {
    let scene = command::scene("scene", text, &[]).expect("a sound scene");
    let (sheet, _) = command::sheet(scene.clone()).expect("proved answers");
    let assumed = worked::in_cases(&scene).expect("a told scene").told;
    let marks = "<p>[[input:ans9]] {@1@} \\(x\\) $y$ {z}</p>";
    let shown = Shown {
        figure: format!("<img alt=\"{FIGURE}\" src=\"data:,\">"),
        solution: String::from(marks),
    };
    let exercise = exercise(&sheet, &scene, shown, &assumed.assumed());
    (sheet, exercise.expect("questions"))
}

fn scene(name: &str) -> (Sheet, Exercise) {
    let path = format!("derivations/{name}.json");
    opened(&std::fs::read_to_string(path).expect("a shipped scene"))
}

const SCENES: [&str; 2] = ["book/two-masses", "book/billiard-ball"];

fn field<'a>(node: Node<'a, '_>, name: &str) -> &'a str {
    let found = node.descendants().find(|n| n.has_tag_name(name));
    found.and_then(|n| n.text()).unwrap_or_default()
}

fn all<'a, 'b>(node: Node<'a, 'b>, name: &'static str) -> impl Iterator<Item = Node<'a, 'b>> {
    node.descendants().filter(move |n| n.has_tag_name(name))
}

#[test]
fn every_belief_has_a_branch() {
    for name in SCENES {
        let (sheet, exercise) = scene(name);
        let quiz = stack(&exercise);
        let quiz = Document::parse(&quiz).expect("XML");
        let mut beliefs = 0;
        for question in all(quiz.root(), "question") {
            let title = field(
                question
                    .children()
                    .find(|n| n.has_tag_name("name"))
                    .expect("a name"),
                "text",
            );
            let (_, quantity) = title
                .rsplit_once(" · ")
                .expect("the quantity behind the title");
            let entry = sheet.entry(quantity).expect("a quantity of the scene");
            let expected = sheet.believed(&entry);
            let tree = all(question, "prt").next().expect("a tree");
            let notes: Vec<&str> = all(tree, "trueanswernote")
                .filter_map(|n| n.text())
                .collect();
            assert_eq!(notes.len(), expected.len() + 1, "{title}");
            for (k, (believed, note)) in expected.iter().zip(&notes[1..]).enumerate() {
                let code = believed.diagnosis.code;
                assert_eq!(*note, format!("prt1-{code}-{}", k + 1), "{title}");
                beliefs += 1;
            }
        }
        assert!(beliefs > 0, "{name} has no wrong answer");
    }
}

#[test]
fn a_belief_s_answer_is_wrong_and_the_grader_names_the_belief() {
    let (sheet, _) = scene("book/falling-stick");
    let entry = sheet.entry("omega").expect("omega");
    for believed in sheet.believed(&entry) {
        let answer = carom::formula::write_plain(&believed.values[0]);
        let grade = sheet.judge(&entry, &answer, &Options::default());
        assert_eq!(grade.verdict, Verdict::Different, "{answer}");
        let codes: Vec<&str> = grade.diagnosis.iter().map(|d| d.code).collect();
        assert!(
            codes.contains(&believed.diagnosis.code),
            "{answer}: {codes:?}"
        );
    }
}

#[test]
fn branches_follow_each_other_and_end() {
    let (_, exercise) = scene("book/billiard-ball");
    let quiz = stack(&exercise);
    let quiz = Document::parse(&quiz).expect("XML");
    for tree in all(quiz.root(), "prt") {
        let nodes: Vec<Node> = all(tree, "node").collect();
        for (k, node) in nodes.iter().enumerate() {
            let next = if k + 1 < nodes.len() {
                (k + 1).to_string()
            } else {
                String::from("-1")
            };
            assert_eq!(field(*node, "name"), k.to_string());
            assert_eq!(field(*node, "truenextnode"), "-1");
            assert_eq!(field(*node, "falsenextnode"), next);
            assert_eq!(field(*node, "truescore"), if k == 0 { "1" } else { "0" });
            assert_eq!(
                k > 0,
                all(*node, "truefeedback").any(|n| !field(n, "text").is_empty())
            );
        }
    }
}

#[test]
fn other_platforms_hold_the_same_beliefs() {
    for name in SCENES {
        let (sheet, exercise) = scene(name);
        let exam = numbas(&exercise);
        let (heading, exam) = exam.split_once('\n').expect("a heading");
        assert_eq!(heading, "// Numbas version: exam_results_page_options");
        let exam: serde_json::Value = serde_json::from_str(exam).expect("JSON");
        let questions = exam["question_groups"][0]["questions"]
            .as_array()
            .expect("questions");
        let alternatives = questions
            .iter()
            .map(|q| q["parts"][0]["alternatives"].as_array().map_or(0, Vec::len));
        let quiz = moodle(&exercise).expect("exact values");
        let quiz = Document::parse(&quiz).expect("XML");
        for question in all(quiz.root(), "question") {
            let right = all(question, "answer").filter(|a| a.attribute("fraction") == Some("100"));
            assert_eq!(right.count(), 1, "{name}");
            for answer in all(question, "answer") {
                assert!(
                    field(answer, "text")
                        .parse::<f64>()
                        .is_ok_and(f64::is_finite)
                );
            }
        }
        let entries = sheet
            .derivation
            .answers
            .iter()
            .filter_map(|a| sheet.entry(&a.name).ok());
        let asked = |e: &carom::grade::sheet::Entry| {
            e.key
                .reading
                .content
                .expr()
                .is_some_and(|e| !e.symbols().is_empty())
        };
        let beliefs: usize = entries
            .filter(asked)
            .map(|e| sheet.believed(&e).len())
            .sum();
        assert_eq!(alternatives.sum::<usize>(), beliefs, "{name}");
    }
}

#[test]
fn a_question_shows_how_it_begins_with_its_symbols_typeset() {
    let (_, exercise) = scene("book/falling-stick");
    let typeset = "inclined at <math><mrow><mrow><mi>θ</mi></mrow></mrow></math>, comes down";
    for quiz in [stack(&exercise), moodle(&exercise).expect("exact values")] {
        let quiz = Document::parse(&quiz).expect("XML");
        for asked in all(quiz.root(), "questiontext") {
            let asked = field(asked, "text");
            assert!(asked.contains(FIGURE) && asked.contains(typeset), "{asked}");
        }
    }
    let exam = numbas(&exercise);
    let asked = exam.matches(FIGURE).count();
    assert_eq!(asked, exam.matches("\"statement\"").count());
}

#[test]
fn a_solution_in_somebody_else_s_page_needs_no_style() {
    let text = std::fs::read_to_string("derivations/book/falling-stick.json").expect("a scene");
    let scene = command::scene("scene", &text, &[]).expect("a sound scene");
    let worked = worked::out(&scene).expect("a worked scene");
    let solution = worked.solution(Detail::Normal);
    // A page has a second form for narrow windows, of which its style shows one.
    assert!(html::page(&solution, &[]).contains(" phone\""));
    let fragment = html::fragment(&solution, &[]);
    assert!(!fragment.contains(" phone"), "an equation stands twice");
    assert!(
        !fragment.contains("class=\"l\""),
        "left sides are aligned by their class"
    );
}

/// What Numbas defines in a question: each variable with its values, one for every variant.
fn defined(question: &serde_json::Value) -> BTreeMap<String, Vec<String>> {
    let variables = question["variables"].as_object().expect("variables");
    let each = variables.iter().map(|(name, held)| {
        let text = held["definition"].as_str().expect("a definition");
        let values = text.strip_suffix("][pick]").map(|t| &t[1..]);
        let values = values.unwrap_or(text).split(", ").map(String::from);
        (name.clone(), values.collect())
    });
    each.collect()
}

#[test]
fn numbas_knows_every_variable_it_is_told_of() {
    let value = |text: &str, known: &[(Symbol, f64)]| {
        let text = text.replace("arccos", "acos");
        let mut symbols = Symbols::strict();
        known.iter().for_each(|(name, _)| symbols.declare(name));
        let read = carom::formula::read(&text, &symbols).expect("a formula");
        let mut at = Point::<f64>::default();
        at.values.extend(known.iter().cloned());
        let read = read.content.expr().expect("one expression");
        read.evaluate(&at).expect("a number")
    };
    let mut seen = 0;
    for name in SCENES {
        let (_, exercise) = scene(name);
        let exam = numbas(&exercise);
        let (_, exam) = exam.split_once('\n').expect("a heading");
        let exam: serde_json::Value = serde_json::from_str(exam).expect("JSON");
        let quiz = moodle(&exercise).expect("exact values");
        let quiz = Document::parse(&quiz).expect("XML");
        let right = all(quiz.root(), "answer").filter(|a| a.attribute("fraction") == Some("100"));
        let mut right = right.map(|a| field(a, "text").parse::<f64>().expect("a number"));
        let questions = exam["question_groups"][0]["questions"].as_array();
        for question in questions.expect("questions") {
            let variables = defined(question);
            let prompt = question["parts"][1]["prompt"].as_str().expect("a prompt");
            for shown in prompt.split("\\var{").skip(1) {
                let (shown, _) = shown.split_once('}').expect("an end");
                assert!(
                    variables.contains_key(shown),
                    "{name}: {shown} is nowhere defined"
                );
            }
            let held = |k: usize| {
                let given = variables.iter().filter(|(n, _)| n.starts_with("val_"));
                given.map(move |(n, values)| (Symbol::from(n.as_str()), value(&values[k], &[])))
            };
            let held_at = variables.iter().find(|(n, _)| n.starts_with("val_"));
            for k in 0..held_at.expect("a value").1.len() {
                let number = value(&variables["number"][0], &held(k).collect::<Vec<_>>());
                let other = right.next().expect("the same variants");
                assert!(
                    (number - other).abs() <= 1e-12 * other.abs(),
                    "{name}: {number}, {other}"
                );
                seen += 1;
            }
        }
        assert_eq!(right.next(), None, "{name}");
    }
    assert!(seen >= 20, "{seen} variants");
}

/// A scene whose words try every format, and whose names mean something on the platforms.
const HOSTILE: &str = r#"{
    "title": "]]></text><script>alert(1)</script> {@1@}",
    "statement": "[[input:ans3]] \\(a\\) $b$ {c} & <b>",
    "parameters": {
        "e": {"unit": "1", "domain": {"min": 0, "max": 1}}, "i": {"unit": "m/s", "meaning": "<i> ]]>"},
        "m": {"unit": "kg"}, "M": {"unit": "kg"}, "gamma": {"unit": "m/s"}
    },
    "points": {"A": [0, 0]},
    "bodies": {
        "one": {"shape": "particle", "mass": "m", "velocity": ["i", 0]},
        "two": {"shape": "particle", "mass": "M", "velocity": ["-gamma", 0]}
    },
    "contacts": {"A": {"bodies": ["one", "two"], "at": "A", "normal": [1, 0], "law": "frictionless", "restitution": "e"}},
    "questions": {"v": {"velocity": "two", "along": [1, 0]}}
}"#;

#[test]
fn variants_keep_to_what_the_answers_rest_on() {
    let (_, exercise) = scene("problems/crude-see-saw");
    let quiz = stack(&exercise);
    let quiz = Document::parse(&quiz).expect("XML");
    let mut seen = 0;
    for question in all(quiz.root(), "question") {
        let text = field(question, "questionvariables");
        let variables = all(question, "questionvariables").next();
        let text = variables.map_or(text, |v| field(v, "text"));
        let is_pivot = text.contains("(L^2 - 3*d^2)/(L^2 + 3*d^2)");
        for row in text.lines().filter(|l| l.contains("L=")) {
            let value = |name: &str| {
                let (_, rest) = row.split_once(name).expect("the value");
                let (n, d) = rest
                    .split([',', ']'])
                    .next()
                    .map(|v| v.split_once('/').unwrap_or((v, "1")))
                    .expect("a number");
                n.parse::<f64>().expect("a number") / d.parse::<f64>().expect("a number")
            };
            let (length, apart) = (value("L="), value("d="));
            assert!(length >= apart, "the supports stand under the plank: {row}");
            assert!(
                !is_pivot || length * length >= 3.0 * apart * apart,
                "the left one comes free: {row}"
            );
            seen += 1;
        }
    }
    assert!(seen >= 10, "variants are compared");
}

#[test]
fn words_of_a_scene_stay_words_and_names_keep_their_meaning() {
    let (_, exercise) = opened(HOSTILE);
    for quiz in [stack(&exercise), moodle(&exercise).expect("exact values")] {
        let quiz = Document::parse(&quiz).expect("XML");
        assert!(all(quiz.root(), "script").next().is_none());
        let inner = field(
            all(quiz.root(), "questiontext").next().expect("a text"),
            "text",
        );
        assert!(!inner.contains("<b>") && !inner.contains("<i>"), "{inner}");
    }
    let quiz = stack(&exercise);
    let quiz = Document::parse(&quiz).expect("XML");
    let feedback = all(quiz.root(), "generalfeedback")
        .next()
        .expect("a solution");
    let asked = all(quiz.root(), "questiontext").next().expect("a text");
    for text in [field(feedback, "text"), field(asked, "text")] {
        assert!(
            !text.contains("[[input:ans9]]")
                && !text.contains("[[input:ans3]]")
                && !text.contains("{@1@}"),
            "{text}"
        );
    }
    let variables = field(
        all(quiz.root(), "questionvariables")
            .next()
            .expect("variables"),
        "text",
    );
    let right = variables
        .lines()
        .find(|l| l.starts_with("ta1"))
        .expect("the answer");
    for name in ["e_s", "i_s", "gamma_s", "M", "m"] {
        assert!(right.contains(name), "{right}");
    }
    let exam = numbas(&exercise);
    let answer = exam
        .lines()
        .find(|l| l.contains("\"answer\""))
        .expect("an answer");
    assert!(
        answer.contains("M_s") && !answer.contains("e_s"),
        "{answer}"
    );
}

#[test]
fn no_variable_of_the_question_is_a_symbol_of_the_scene() {
    let (_, exercise) = opened(&HOSTILE.replace("gamma", "belief1"));
    let quiz = stack(&exercise);
    let quiz = Document::parse(&quiz).expect("XML");
    let question = all(quiz.root(), "question").next().expect("a question");
    let variables = all(question, "questionvariables").next();
    let text = variables.map(|v| field(v, "text")).expect("variables");
    let own: Vec<&str> = text
        .lines()
        .filter_map(|l| Some(l.split_once(": ")?.0))
        .collect();
    assert!(
        own.contains(&"belief1") && own.contains(&"beliefn1"),
        "{own:?}"
    );
    let right = text.lines().find(|l| l.starts_with("ta1"));
    assert!(right.is_some_and(|r| r.contains("belief1_s")), "{right:?}");
    // Students may type what STACK takes for no symbol by itself: names of more than two characters.
    let input = all(question, "input").next().expect("an input");
    assert_eq!(field(input, "allowwords"), "e_s,i_s,belief1_s");
}

#[test]
fn a_scene_that_asks_for_no_formula_says_what_would_help() {
    let text = HOSTILE.replace(
        r#"{"velocity": "two", "along": [1, 0]}"#,
        r#"{"balance": "momentum", "system": ["one", "two"], "along": [1, 0]}"#,
    );
    let scene = command::scene("scene", &text, &[]).expect("a sound scene");
    let (sheet, _) = command::sheet(scene.clone()).expect("answers");
    let refused = exercise(&sheet, &scene, Shown::default(), &[]).expect_err("nothing to ask");
    assert!(refused.contains("hint: add a question"), "{refused}");
}

/// What carom prints, run with these arguments.
fn carom(arguments: &[&str], input: &str) -> (Option<i32>, String) {
    let mut run = std::process::Command::new(env!("CARGO_BIN_EXE_carom"))
        .args(arguments)
        .stdin(std::process::Stdio::piped())
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::null())
        .spawn()
        .expect("the program starts");
    let mut to = run.stdin.take().expect("standard input");
    std::io::Write::write_all(&mut to, input.as_bytes()).expect("it is read");
    drop(to);
    let out = run.wait_with_output().expect("it ends");
    (
        out.status.code(),
        String::from_utf8_lossy(&out.stdout).into_owned(),
    )
}

/// The values of a question of plain Moodle, as assignments, and the number that is right.
fn at_values(question: Node) -> (Vec<String>, f64) {
    let asked = all(question, "questiontext").next().expect("a text");
    let (_, values) = field(asked, "text")
        .split_once("In SI units ")
        .expect("values");
    let (values, _) = values.split_once(". What is").expect("a question");
    let plain = |text: &str| {
        let text = text
            .replace("\\left", "")
            .replace("\\right", "")
            .replace("\\arccos", "acos");
        let text = text.replace("\\frac{", "(").replace("}{", ")/(");
        text.replace('}', ")")
    };
    let values = values.split(", ").map(|v| {
        let v = v.trim_start_matches("\\(").trim_end_matches("\\)");
        let (name, value) = v.split_once(" = ").expect("a value");
        let name = name.trim_start_matches('\\');
        let name = if name == "ell" { "l" } else { name };
        format!("{name}={}", plain(value))
    });
    let right = all(question, "answer").find(|a| a.attribute("fraction") == Some("100"));
    let right = field(right.expect("a right answer"), "text");
    (values.collect(), right.parse().expect("a number"))
}

#[test]
fn keys_are_the_numbers_of_the_scene_at_the_values_of_the_question() {
    for (scene, least) in [
        ("rod-turns-its-slip-round", 3),
        ("ball-slides-at-its-bounce", 12),
    ] {
        let path = format!("derivations/friction/{scene}.json");
        let (status, quiz) = carom(&["export", &path, "--to", "moodle"], "");
        assert_eq!(status, Some(0), "{scene}");
        let quiz = Document::parse(&quiz).expect("XML");
        let mut seen = 0;
        for question in all(quiz.root(), "question") {
            let title = question.children().find(|n| n.has_tag_name("name"));
            let title = field(title.expect("a name"), "text");
            let name = title.split(" · ").nth(1).expect("the quantity");
            let (values, right) = at_values(question);
            let set = values.iter().map(|v| format!("--set={v}"));
            let set: Vec<String> = set.collect();
            let mut arguments = vec!["solve", "--format=json", &path];
            arguments.extend(set.iter().map(String::as_str));
            let (_, solved) = carom(&arguments, "");
            let solved: serde_json::Value = serde_json::from_str(&solved).expect("JSON");
            let answers = solved["answers"].as_array().expect("answers");
            let found = answers.iter().find(|a| a["name"] == name);
            // A threshold is no number of the motion.
            let Some(found) = found.and_then(|a| a["value"].as_f64()) else {
                continue;
            };
            assert!(
                (found - right).abs() <= 1e-9 * right.abs(),
                "{title}: {values:?}: {found}, not {right}"
            );
            seen += 1;
        }
        assert!(seen >= least, "{scene}: {seen} questions");
    }
}

#[test]
fn a_question_of_one_case_gives_its_condition_and_all_that_decides_it() {
    let (_, exercise) = scene("friction/ball-bounces-with-backspin");
    let quiz = stack(&exercise);
    let quiz = Document::parse(&quiz).expect("XML");
    for question in all(quiz.root(), "question") {
        let asked = all(question, "questiontext").next().expect("a text");
        let asked = field(asked, "text");
        assert!(
            asked.contains(", given that <math>") && asked.contains("sticks"),
            "{asked}"
        );
        assert!(!asked.contains('`'), "{asked}");
        let variables = all(question, "questionvariables")
            .next()
            .expect("variables");
        let vals = field(variables, "text");
        assert!(vals.starts_with("vals: ") && vals.contains("mu="), "{vals}");
    }
    let quiz = moodle(&exercise).expect("exact values");
    assert!(quiz.contains("\\mu ="), "the coefficient is given");
}

#[test]
fn a_scene_may_come_by_standard_input() {
    let text = std::fs::read_to_string("derivations/book/two-masses.json").expect("a scene");
    for platform in ["stack", "moodle", "numbas"] {
        let (status, quiz) = carom(&["export", "-", "--to", platform], &text);
        assert_eq!(status, Some(0), "{platform}");
        assert!(!quiz.is_empty(), "{platform}");
    }
}
