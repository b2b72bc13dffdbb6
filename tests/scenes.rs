//! Every scene in `derivations/` is read, and the schema knows every field it uses.

use std::fs;
use std::path::{Path, PathBuf};

use carom::scene;

/// All scene files, the refused ones not among them.
fn scenes() -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("derivations")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a folder of scenes").flatten() {
            let path = entry.path();
            if path.is_dir() && !path.ends_with("refused") {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "json") {
                let text = fs::read_to_string(&path).expect("a scene file");
                found.push((path, text));
            }
        }
    }
    found.sort();
    found
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
