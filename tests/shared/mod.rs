//! Where the files of the tests lie, and what several of them begin with.

pub mod clock;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, OnceLock};

use carom::command;
use carom::derive::{Stop, derive};
use carom::grade::sheet::Sheet;
use carom::scene::{self, Scene};
use carom::worked::{self, Worked};

/// What is found of the scene of a file, once for all tests.
struct Once<T: 'static>(Mutex<BTreeMap<PathBuf, &'static OnceLock<T>>>);

impl<T> Once<T> {
    fn get(&self, path: &Path, find: impl FnOnce(Scene) -> T) -> &'static T {
        let mut all = self.0.lock().expect("no test fails while it looks");
        let cell = all.entry(path.to_owned());
        let cell = *cell.or_insert_with(|| Box::leak(Box::default()));
        drop(all);
        cell.get_or_init(|| {
            let text = fs::read_to_string(path);
            let text = text.unwrap_or_else(|e| panic!("{}: {e}", path.display()));
            let place = path.to_string_lossy();
            find(scene::read(&text).unwrap_or_else(|f| panic!("{}", f.render(&place, &text))))
        })
    }
}

/// The scene of a file (its path from the crate's folder), worked out in all its cases.
pub fn worked(path: &Path) -> &'static Result<Worked, String> {
    static ALL: Once<Result<Worked, String>> = Once(Mutex::new(BTreeMap::new()));
    ALL.get(path, |scene| worked::in_cases(&scene))
}

/// The key by which answers to the scene of a file are graded.
pub fn key(path: &Path) -> &'static Sheet {
    static ALL: Once<Sheet> = Once(Mutex::new(BTreeMap::new()));
    ALL.get(path, |scene| {
        command::sheet(scene).expect("answers that are proved").0
    })
}

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
