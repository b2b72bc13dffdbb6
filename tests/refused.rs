//! Every scene in `derivations/refused/` is refused, with exactly the text beside it.
//!
//! `UPDATE=1 cargo test --test refused` writes the expected texts anew; reading that diff is the review.

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
            Ok(scene) => match scene.story.as_ref().map(|s| carom::story::tell(&scene, s)) {
                Some(Err(reason)) => format!("{name}: {reason}\n"),
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
