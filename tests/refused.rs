//! Every scene in `derivations/refused/` is refused, with exactly the text beside it.
//!
//! `UPDATE=1 cargo test --test all refused::` writes the expected texts anew; reading that diff is the review.

use std::fs;
use std::path::Path;

use carom::scene;

#[test]
fn every_refused_scene_is_refused_with_the_text_beside_it() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("derivations/refused");
    let mut paths: Vec<_> = fs::read_dir(&folder)
        .expect("the folder")
        .flatten()
        .map(|e| e.path())
        .collect();
    paths.retain(|p| p.extension().is_some_and(|e| e == "json"));
    paths.sort();
    assert!(paths.len() >= 30, "{} scenes", paths.len());
    let mut wrong = Vec::new();
    for path in paths {
        let name = path
            .file_name()
            .map(|n| n.to_string_lossy().into_owned())
            .unwrap_or_default();
        let text = fs::read_to_string(&path).expect("a scene file");
        let said = match scene::read(&text) {
            // Whether stages fit shows only when the story is told.
            Ok(scene) => match carom::story::tell(&scene) {
                Err(reason) if scene.has_stages() => format!("{name}: {reason}\n"),
                _ => "accepted\n".to_owned(),
            },
            Err(faults) => faults.render(&name, &text),
        };
        let beside = path.with_extension("expected");
        if std::env::var_os("UPDATE").is_some() {
            fs::write(&beside, &said).expect("the expected text is written");
        }
        let expected = fs::read_to_string(&beside).unwrap_or_default();
        if said != expected || said.starts_with("accepted") {
            wrong.push(format!("{name} says\n{said}\nexpected\n{expected}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn editors_are_told_the_places_as_data() {
    let told = |scene: &str| {
        let run = std::process::Command::new(env!("CARGO_BIN_EXE_carom"))
            .args(["check-scene", "--format", "json", scene])
            .output()
            .expect("the program starts");
        let told: serde_json::Value = serde_json::from_slice(&run.stdout).expect("JSON");
        (run.status.code(), told)
    };
    let (status, sound) = told("derivations/book/falling-stick.json");
    assert_eq!(
        (status, sound["faults"].as_array().map(Vec::len)),
        (Some(0), Some(0))
    );
    // What is no text has its one fault too.
    for missing in ["derivations/nowhere.json", "derivations/book"] {
        let (status, told) = told(missing);
        let message = told["faults"][0]["message"].as_str();
        assert_eq!(status, Some(2));
        assert!(
            message.is_some_and(|m| m.contains("cannot be read")),
            "{told}"
        );
    }
    let (status, told) = told("derivations/refused/broken-formula.json");
    let fault = &told["faults"][0];
    assert_eq!(status, Some(2));
    let text = fs::read_to_string("derivations/refused/broken-formula.json").expect("a scene");
    let place = |name: &str| fault[name].as_u64().expect("a place") as usize;
    let line = text.lines().nth(place("line") - 1).expect("the line");
    let found: String = text
        .encode_utf16()
        .skip(place("start"))
        .take(place("end") - place("start"))
        .map(|u| char::from_u32(u.into()).unwrap_or(' '))
        .collect();
    assert!(!found.is_empty() && line.contains(&found), "{found}");
}

fn run(arguments: &[&str]) -> (Option<i32>, String) {
    let run = std::process::Command::new(env!("CARGO_BIN_EXE_carom"))
        .args(arguments)
        .output()
        .expect("the program starts");
    let said = [run.stdout, run.stderr].concat();
    (run.status.code(), String::from_utf8_lossy(&said).into())
}

#[test]
fn a_command_that_is_not_in_this_build_tells_its_feature() {
    for (feature, is_in) in [
        ("serve", cfg!(feature = "serve")),
        ("site", cfg!(feature = "site")),
    ] {
        if !is_in {
            let (status, said) = run(&[feature, "derivations"]);
            assert_eq!(status, Some(2));
            assert!(said.contains(&format!("--features {feature}")), "{said}");
        }
    }
}

#[test]
fn a_scene_that_asks_nothing_is_told_how_to_ask() {
    let folder = std::path::PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    for (name, says) in [
        ("book/falling-stick", r#"{"v": {"velocity": "bar"}}"#),
        ("friction/rod-turns-its-slip-round", r#"{"velocity": "#),
        ("problems/tipping-box", r#""at": "#),
    ] {
        let text = fs::read_to_string(format!("derivations/{name}.json")).expect("a scene");
        let mut scene: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        let fields = scene.as_object_mut().expect("an object");
        fields.retain(|field, _| !matches!(field.as_str(), "questions" | "plots" | "printed"));
        let path = folder.join("nothing-asked.json");
        fs::write(&path, scene.to_string()).expect("a scene");
        let (status, said) = run(&["derive", &path.display().to_string()]);
        assert_eq!(status, Some(0), "{said}");
        assert!(
            said.contains("nothing is asked") && said.contains(says),
            "{said}"
        );
    }
}
