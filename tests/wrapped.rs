//! A scene of one impact and the same impact as the only stage of a scene are one scene: both are read alike, and every command
//! says the same of both.

use crate::shared;

use std::path::Path;
use std::process::Command;

use carom::scene::read;
use serde_json::{Map, Value};

/// Fields that stand in the impact once there are stages.
const MOVED: [&str; 5] = ["hinges", "contacts", "blows", "after", "forces"];

/// The scene in one stage; `None` where it has stages already, or says what only a scene without stages can.
fn wrapped(text: &str) -> Option<String> {
    let scene: Value = serde_json::from_str(text).ok()?;
    let mut scene = scene.as_object()?.clone();
    if scene.contains_key("stages") || scene.contains_key("assumptions") {
        return None;
    }
    let impact: Map<String, Value> = MOVED
        .iter()
        .filter_map(|field| Some((field.to_string(), scene.remove(*field)?)))
        .collect();
    let stage = serde_json::json!([{"name": "impact", "impact": impact}]);
    scene.insert(String::from("stages"), stage);
    Some(Value::Object(scene).to_string())
}

fn said(command: &[&str], scene: &Path) -> (Option<i32>, String) {
    let (verb, more) = command.split_first().expect("a command");
    let out = Command::new(env!("CARGO_BIN_EXE_carom"))
        .arg(verb)
        .arg(scene)
        .args(more)
        .output()
        .expect("carom runs");
    let text = String::from_utf8_lossy(&out.stdout).to_string();
    let errors = String::from_utf8_lossy(&out.stderr).to_string();
    let name = scene.to_string_lossy().to_string();
    let told = format!("{text}{errors}").replace(&name, "SCENE");
    (out.status.code(), told)
}

#[test]
fn a_scene_wrapped_in_one_stage_is_the_same_scene() {
    let folder = std::env::temp_dir().join(format!("carom-wrapped-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let mut count = 0;
    for path in shared::files("derivations", "json") {
        let text = std::fs::read_to_string(&path).expect("a readable scene");
        let Some(wrapped) = wrapped(&text) else {
            continue;
        };
        count += 1;
        let [plain, staged] = [&text, &wrapped].map(|text| read(text).expect("a scene"));
        assert_eq!(
            format!("{plain:?}"),
            format!("{staged:?}"),
            "{}",
            path.display()
        );
        // Commands know a scene as it is read, and no file: a folder of them shows it.
        if !path.to_string_lossy().contains("/book/") {
            continue;
        }
        let other = folder.join("wrapped.json");
        std::fs::write(&other, wrapped).expect("a written scene");
        for command in [
            &["derive"][..],
            &["derive", "--matrix"],
            &["derive", "--format", "json"],
            &["solve"],
            &["solution", "--format", "markdown"],
            &["emit", "--lang", "c"],
            &["verify"],
        ] {
            let [plain, staged] = std::thread::scope(|scope| {
                [&path, &other]
                    .map(|scene| scope.spawn(|| said(command, scene)))
                    .map(|told| told.join().expect("carom runs"))
            });
            assert_eq!(plain, staged, "{}: {command:?}", path.display());
        }
    }
    assert!(count > 15, "{count} scenes of one impact");
    std::fs::remove_dir_all(&folder).expect("a folder removed");
}
