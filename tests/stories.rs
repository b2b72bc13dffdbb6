//! Stories: the scenes of `derivations/problems/` with stages, their answers, and laws that hold for every story.

use std::path::Path;

use carom::equality::{Equality, How, decide};
use carom::formula::{Content, Symbols, read, write_plain};
use carom::scene::Scene;
use carom::story::{Told, tell};

fn scene(name: &str) -> Scene {
    let path = format!("derivations/problems/{name}.json");
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"));
    carom::scene::read(&text).unwrap_or_else(|faults| panic!("{}", faults.render(&path, &text)))
}

fn told(scene: &Scene) -> Told {
    let story = scene.story.as_ref().expect("a scene with stages");
    tell(scene, story).unwrap_or_else(|reason| panic!("{}: {reason}", scene.title))
}

fn shipped() -> Vec<String> {
    let mut names = Vec::new();
    for entry in std::fs::read_dir(Path::new("derivations/problems")).expect("a readable folder") {
        let path = entry.expect("a readable entry").path();
        let name = path
            .file_stem()
            .expect("a name")
            .to_string_lossy()
            .to_string();
        if scene(&name).story.is_some() {
            names.push(name);
        }
    }
    names.sort();
    names
}

#[test]
fn the_answers_are_those_of_the_table() {
    let table = std::fs::read_to_string("tests/stories/answers.tsv").expect("the table");
    let mut wrong = Vec::new();
    let mut last: Option<(String, Scene, Told)> = None;
    for row in table
        .lines()
        .filter(|l| !l.starts_with('#') && !l.is_empty())
    {
        let columns: Vec<&str> = row.split('\t').collect();
        let [name, answer, formula, _] = columns.as_slice() else {
            panic!("a row has four columns: {row}");
        };
        if last.as_ref().is_none_or(|l| l.0 != *name) {
            let scene = scene(name);
            let told = told(&scene);
            last = Some((name.to_string(), scene, told));
        }
        let Some((_, scene, told)) = &last else {
            continue;
        };
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
        let Some(value) = &found.formula else {
            wrong.push(format!("{name} {answer}: no formula; {:?}", found.text));
            continue;
        };
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
fn every_check_of_every_story_holds_and_every_question_has_an_answer() {
    for name in shipped() {
        let scene = scene(&name);
        let told = told(&scene);
        assert!(told.holds(), "{name}");
        for a in &told.answers {
            assert!(
                a.formula.is_some() || !a.text.is_empty() || a.equation.is_some(),
                "{name}: {} has no answer",
                a.name
            );
        }
    }
}

#[test]
fn energy_is_kept_wherever_a_stage_says_so() {
    for name in shipped() {
        let scene = scene(&name);
        for stage in told(&scene).stages {
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
