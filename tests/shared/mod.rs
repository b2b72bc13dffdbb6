//! Where the files of the tests lie, and what several of them begin with.

pub mod clock;

use std::fs;
use std::path::PathBuf;

use carom::derive::{Stop, derive};
use carom::grade::sheet::Sheet;
use carom::scene::Scene;

/// The answers of a scene of one impact as they are derived, whether they are proved or not, and nothing of its story.
pub fn sheet(scene: Scene) -> Result<Sheet, Stop> {
    let derivation = derive(&scene)?;
    Ok(Sheet {
        scene,
        derivation,
        moments: Vec::new(),
        all: Vec::new(),
        impacts: Vec::new(),
        ends: Vec::new(),
        laws: Vec::new(),
        accelerations: Vec::new(),
        coefficients: Vec::new(),
        story: None,
        given: Vec::new(),
        spoken: Vec::new(),
        otherwise: Vec::new(),
    })
}

/// Files below a folder of the crate whose names end in `.extension`, sorted. A folder `refused` inside is left out: its
/// scenes are not for use.
pub fn files(folder: &str, extension: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![PathBuf::from(folder)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a folder of the crate") {
            let path = entry.expect("a readable entry").path();
            if path.is_dir() && !path.ends_with("refused") {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == extension) {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}
