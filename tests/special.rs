//! What a scene asks about its answers: zeros, thresholds, limits, forms for a small parameter, identities. Each row of the table
//! is a question about the scene below; a fact of its own stands in a test of its own.

use carom::answer::{self, Answer, Refused};
use carom::domain::Domains;
use carom::equality::{Equality, decide};
use carom::formula::{Symbols, read_expr, write_plain};
use carom::scene::{self, Scene};
use carom::{derive, story};

/// A bar hinged at A is hit by a ball that sticks at D; the parameters beside are for questions alone.
fn asked(questions: &str) -> Result<Vec<Answer>, String> {
    asked_where("", questions)
}

/// The same with relations between the parameters.
fn asked_where(relations: &str, questions: &str) -> Result<Vec<Answer>, String> {
    let text = format!(
        r#"{{
  "parameters": {{
    "m1": {{"unit": "kg"}}, "m2": {{"unit": "kg"}}, "l": {{"unit": "m"}}, "d": {{"unit": "m"}}, "v": {{"unit": "m/s"}},
    "x": {{"unit": "m", "domain": "real"}}, "theta": {{"unit": "rad", "domain": {{"min": 0, "max": "pi/2"}}}},
    "phi": {{"unit": "rad", "domain": {{"min": "-pi", "max": "pi"}}}}, "e": {{"unit": "1", "domain": {{"min": 0, "max": 1}}}}
  }},
  "relations": [{relations}],
  "points": {{"A": [0, 0], "D": [0, "-d"]}},
  "bodies": {{
    "support": {{"shape": "fixed"}},
    "bar": {{"shape": "rod", "mass": "m2", "length": "2*l", "angle": "-pi/2", "center": [0, "-l"]}},
    "ball": {{"shape": "particle", "mass": "m1", "center": "D", "velocity": ["-v", 0]}}
  }},
  "hinges": {{"A": {{"bodies": ["support", "bar"], "at": "A"}}}},
  "contacts": {{"D": {{"bodies": ["ball", "bar"], "at": "D", "law": "sticking"}}}},
  "questions": {{
    "omega": {{"spin": "bar"}}, "P_A": {{"impulse": "A", "on": "bar"}}, "E_lost": {{"energy": "lost"}},
    {questions}
  }}
}}"#
    );
    let scene = scene::read(&text).map_err(|faults| faults.render("scene", &text))?;
    about_answers(&scene).map_err(|refused| refused.to_string())
}

/// The answers to questions about answers.
fn about_answers(scene: &Scene) -> Result<Vec<Answer>, Refused> {
    let mut answers = story::tell(scene)?.answers;
    answers.retain(|a| scene.asked_of_answers().any(|q| q.name == a.question));
    Ok(answers)
}

/// Everything an answer says, in one line.
fn said(answers: &[Answer]) -> String {
    let mut all = Vec::new();
    for a in answers {
        if let Some(formula) = a.formula() {
            all.push(format!("{} = {}", a.name, write_plain(formula)));
        }
        for (s, relation, e) in &a.range {
            let s = write_plain(s);
            all.push(format!("{s} {} {}", relation.sign(), write_plain(e)));
        }
        let sentences = a.text.iter().chain(&a.discarded);
        all.extend(sentences.map(ToString::to_string));
        all.extend(a.assumptions.iter().map(|g| format!("given {g}")));
        for c in &a.checks {
            all.push(format!("{} {:?}", c.kind, c.holds));
        }
    }
    all.join(" | ")
}

#[test]
fn every_question_gets_its_answer() {
    let table: Vec<[&str; 3]> = include_str!("special/questions.tsv")
        .lines()
        .skip(1)
        .filter_map(|line| {
            let mut cells = line.split('\t');
            Some([cells.next()?, cells.next()?, cells.next()?])
        })
        .collect();
    assert!(table.len() > 20);
    let mut wrong = Vec::new();
    for [question, expected, reason] in table {
        let answer = match asked(&format!("\"it\": {question}")) {
            Ok(answers) => said(&answers),
            Err(message) => message,
        };
        for part in expected.split(" & ") {
            let found = match part.strip_prefix("not ") {
                Some(absent) => !answer.contains(absent),
                None => answer.contains(part),
            };
            if !found {
                wrong.push(format!(
                    "{question}\n  expected {part} ({reason})\n  got {answer}"
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_later_question_uses_the_answer_of_an_earlier_one() {
    let answers = asked(
        r#""d_0": {"solve": "d", "holds": "P_A_x = 0"}, "q_0": {"value": "l/d_0"}, "spin_0": {"value": "omega", "with": {"d": "d_0"}}"#,
    );
    let said = said(&answers.expect("answers"));
    assert!(said.contains("q_0 = 3/4"), "{said}");
    assert!(
        said.contains("spin_0 = -3*m1*v/(l*(4*m1 + 3*m2))"),
        "{said}"
    );
}

fn book() -> (scene::Scene, String) {
    let text = std::fs::read_to_string("derivations/book/ball-hits-bat.json").expect("a scene");
    (scene::read(&text).expect("a valid scene"), text)
}

fn graphs(scene: &scene::Scene) -> Result<Vec<answer::Graph>, answer::Refused> {
    let derivation = derive::derive(scene).expect("a derivation");
    let special = about_answers(scene).expect("answers");
    answer::graphs(scene, &derivation.known(), &special)
}

#[test]
fn the_impulse_at_the_hinge_is_plotted_with_its_zero_at_three_quarters() {
    let (scene, _) = book();
    let graphs = graphs(&scene).expect("curves");
    assert_eq!(graphs.len(), 1);
    for curve in &graphs[0].curves {
        let zeros: Vec<String> = curve.zeros.iter().map(|z| write_plain(&z.0)).collect();
        assert_eq!(zeros, ["3/4"]);
        // P_A/(m1 v) = q (4 q − 3) r/(3 + 4 r q²) with r = m2/m1, at q = 1.
        let mut masses = carom::expr::Point::<f64>::default();
        masses.values.insert("m1".into(), 1.0);
        let ratio = curve.with[0].1.evaluate(&masses).expect("a ratio");
        let mut point = carom::expr::Point::<f64>::default();
        point.values.insert("q".into(), 1.0);
        let value = curve.formula.evaluate(&point).expect("a value");
        assert!(
            (value - ratio / (3.0 + 4.0 * ratio)).abs() < 1e-12,
            "{value}"
        );
    }
    let picture = carom::render::plots::picture(&scene, &graphs[0]).expect("a plot");
    assert!(picture.svg.contains("q = 3/4") && picture.svg.contains("q = ℓ/d"));
    assert!(carom::figure::plain(&picture.caption).contains("zero at q = 3/4, exactly"));
}

#[test]
fn a_plot_that_cannot_be_drawn_says_why() {
    let (_, text) = book();
    let with = |from: &str, to: &str| {
        let text = text.replacen(from, to, 1);
        assert!(text.contains(to));
        match scene::read(&text) {
            Err(faults) => faults.render("scene", &text),
            Ok(scene) => match graphs(&scene) {
                Err(refused) => refused.to_string(),
                Ok(graphs) => match carom::render::plots::picture(&scene, &graphs[0]) {
                    Err(fault) => fault.to_string(),
                    Ok(_) => String::from("drawn"),
                },
            },
        }
    };
    let axis = r#""from": "1/4", "to": "2""#;
    for (from, to, said) in [
        (axis, r#""from": "2", "to": "1/4""#, "ends before it begins"),
        (axis, r#""from": "1/4", "to": "1/0""#, "division by zero"),
        (
            r#""varying": "d""#,
            r#""varying": "m2""#,
            "m2 is not given by q alone",
        ),
        (r#""varying": "d", "#, r#""#, "belong together"),
        (
            r#""against": "q""#,
            r#""against": "v""#,
            "the name `v` is taken",
        ),
        (
            r#"{"m2": "m1"}, {"m2""#,
            r#"{"m3": "m1"}, {"m2""#,
            "there is no parameter `m3`",
        ),
        (r#""P_A_x/(m1*v)""#, r#""P_B_x/(m1*v)""#, "P_B_x"),
        (r#""unit": "kg", "value": 0.25"#, r#""unit": "kg""#, "drawn"),
    ] {
        let text = with(from, to);
        assert!(text.contains(said), "{to}: {text}");
    }
}

#[test]
fn solutions_keep_to_relations() {
    let question = r#""it": {"solve": "d", "holds": "P_A_x = 0"}"#;
    let inside = said(&asked_where(r#""d <= 2 l""#, question).expect("an answer"));
    assert!(
        inside.contains("d = 4*l/3") && !inside.contains("given"),
        "{inside}"
    );
    let outside = said(&asked_where(r#""d < l""#, question).expect("an answer"));
    assert!(outside.contains("d = 4*l/3, against d < l"), "{outside}");
    let open = said(&asked_where(r#""d < x""#, question).expect("an answer"));
    assert!(open.contains("given 3*x > 4*l, so that d < x"), "{open}");
    let question = r#""it": {"solve": "x", "holds": "x^2 = l*(d - l)"}"#;
    let rooted = said(&asked_where(r#""x < 2 l""#, question).expect("an answer"));
    assert!(
        rooted.contains("given 5*l > d, so that x < 2*l"),
        "{rooted}"
    );
    // A root that is enclosed only.
    let question = r#""it": {"solve": "e", "holds": "(1 - 3*e)*sqrt(e^3 + e - 1) = 0"}"#;
    let enclosed = said(&asked_where(r#""e < 1/2""#, question).expect("an answer"));
    assert!(enclosed.contains("e = 1/3"), "{enclosed}");
    assert!(
        enclosed.contains("e between 0.68") && enclosed.contains("against e < 1/2"),
        "{enclosed}"
    );
    let within = said(&asked_where(r#""e < 7/10""#, question).expect("an answer"));
    assert!(!within.contains("against"), "{within}");
}

#[test]
fn a_relation_ends_the_range_of_a_maximum() {
    let question = r#""it": {"maximum": "d*v", "over": ["d"]}"#;
    let end = said(&asked_where(r#""d <= 2 l""#, question).expect("an answer"));
    assert!(
        end.contains("it = 2*l*v") && end.contains("d = 2*l"),
        "{end}"
    );
    let several = asked_where(r#""d <= 2 l", "d <= x""#, question).expect("an answer");
    let several = said(&several);
    assert!(
        several.contains("several relations end the range of d"),
        "{several}"
    );
}

#[test]
fn what_is_sought_may_bear_the_name_of_its_parameter() {
    let questions = r#""d": {"solve": "d", "holds": "P_A_x = 0"}, "later": {"value": "3*d*v"}"#;
    let all = said(&asked(questions).expect("answers"));
    assert!(
        all.contains("d = 4*l/3") && all.contains("later = 3*d*v"),
        "{all}"
    );
    let other = asked(r#""v": {"solve": "d", "holds": "P_A_x = 0"}"#);
    assert!(
        other
            .expect_err("another parameter")
            .contains("has the name of the parameter")
    );
}

#[test]
fn what_was_before_and_what_belongs_to_a_point_can_be_asked() {
    let table = [
        (
            r#"{"angular_momentum": "ball", "about": "A", "when": "start"}"#,
            "it = -d*m1*v",
        ),
        (r#"{"inertia": "bar", "about": "A"}"#, "it = 4*l^2*m2/3"),
        (r#"{"inertia": "ball", "about": "A"}"#, "it = d^2*m1"),
        (r#"{"speed": "D", "of": "bar", "when": "start"}"#, "it = 0"),
        (r#"{"speed": "ball", "when": "start"}"#, "it = v"),
        (
            r#"{"velocity": "ball", "when": "start", "along": "-x"}"#,
            "it = v",
        ),
        (r#"{"spin": "bar", "when": "start"}"#, "it = 0"),
        (r#"{"instantaneous_center": "bar"}"#, "it_x = 0 & it_y = 0"),
        (
            r#"{"angular_momentum": "bar", "about": "A"}"#,
            "it = -4*d*l^2*m1*m2*v/(3*d^2*m1 + 4*l^2*m2)",
        ),
        (
            r#"{"speed": "ball"}"#,
            "it = 3*d^2*m1*v/(3*d^2*m1 + 4*l^2*m2)",
        ),
    ];
    for (question, expected) in table {
        let found = asked(&format!("\"it\": {question}")).expect("an answer");
        let expected: Vec<(&str, &str)> = expected
            .split(" & ")
            .filter_map(|one| one.split_once(" = "))
            .collect();
        assert_eq!(found.len(), expected.len(), "{question}");
        for (answer, (name, formula)) in found.iter().zip(expected) {
            let formula = read_expr(formula, &Symbols::open()).expect("a formula");
            let got = answer.formula().expect("a formula");
            let same = decide(got, &formula, &Domains::default()).equality;
            let is_same = matches!(same, Equality::Same { .. });
            assert!(
                answer.name == name && is_same,
                "{question}: {}",
                write_plain(got)
            );
        }
    }
}

#[test]
fn what_needs_an_open_answer_is_open_and_leaves_the_others_answered() {
    let text = r#"{
      "parameters": {"m": {"unit": "kg"}, "M": {"unit": "kg"}, "w": {"unit": "m/s"}, "E": {"unit": "J"}},
      "gains_energy": true,
      "bodies": {"one": {"shape": "particle", "mass": "m"}, "two": {"shape": "particle", "mass": "M"}},
      "contacts": {"C": {"bodies": ["one", "two"], "at": [0, 0], "normal": "x"}},
      "after": [{"velocity": "two", "relative_to": "one", "along": "x", "is": "w"}],
      "questions": {
        "u": {"velocity": "two", "along": "x"}, "K": {"energy": "after"},
        "w0": {"solve": "w", "holds": "K = E"}, "u0": {"value": "u", "with": {"w": "w0"}}
      }
    }"#;
    let scene = scene::read(text).expect("a sound scene");
    let told = story::tell(&scene).expect("a scene that can be told");
    let says = |name: &str| {
        let mut all = told.answers.iter();
        let mine = all.find(|a| a.name == name).expect("the answer");
        mine.text.first().map(ToString::to_string)
    };
    let why = |name| says(name).unwrap_or_default();
    // Across the line the carts may go anyhow.
    assert!(told.answers[0].formula().is_some());
    assert!(
        why("w0").starts_with("not determined: it needs K, which depends on "),
        "{}",
        why("w0")
    );
    assert!(
        why("u0").starts_with("not determined: it needs w0"),
        "{}",
        why("u0")
    );
}
