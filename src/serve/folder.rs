//! The scenes of a folder, by name. Nothing outside of it can be named, and links are not followed.

use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};

use crate::scene::LONGEST;

/// Scenes listed of a folder.
const MOST: usize = 2000;
/// Folders within each other that are looked into.
const DEEPEST: usize = 8;

/// A folder with scenes.
#[derive(Clone, Debug)]
pub(super) struct Folder {
    root: PathBuf,
}

impl Folder {
    /// The folder at a path.
    pub(super) fn open(path: &Path) -> std::io::Result<Folder> {
        let root = path.canonicalize()?;
        fs::read_dir(&root)?;
        Ok(Folder { root })
    }

    /// Where it is.
    pub(super) fn root(&self) -> &Path {
        &self.root
    }

    /// Names of the scene files in it, such as `book/falling-stick.json`, in order; refused examples aside.
    pub(super) fn names(&self) -> Vec<String> {
        let mut names = Vec::new();
        collect(&self.root, "", DEEPEST, &mut names);
        names.sort();
        names
    }

    /// The text of a scene; `None` where the folder has none of this name.
    pub(super) fn text(&self, name: &str) -> Option<String> {
        let path = self.find(name)?;
        let mut bytes = Vec::new();
        // One byte more than a scene may have: the reader then says that it is too long.
        let most = LONGEST as u64 + 1;
        let file = File::open(path).ok()?;
        file.take(most).read_to_end(&mut bytes).ok()?;
        String::from_utf8(bytes).ok()
    }

    /// The regular file of a name, which no link leads to.
    pub(super) fn find(&self, name: &str) -> Option<PathBuf> {
        if !is_scene(name) || name.contains(['\\', '\0', ':']) {
            return None;
        }
        let mut path = self.root.clone();
        let mut parts = name.split('/').peekable();
        while let Some(part) = parts.next() {
            if part.is_empty() || part.starts_with('.') {
                return None;
            }
            path.push(part);
            let kind = fs::symlink_metadata(&path).ok()?.file_type();
            let fits = match parts.peek() {
                Some(_) => kind.is_dir(),
                None => kind.is_file(),
            };
            if !fits {
                return None;
            }
        }
        Some(path)
    }
}

/// Whether a file is named as scenes are; lists of printed answers beside them are none.
fn is_scene(name: &str) -> bool {
    name.ends_with(".json") && !name.ends_with(".answers.json")
}

fn collect(folder: &Path, before: &str, depth: usize, names: &mut Vec<String>) {
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    for entry in entries.flatten() {
        let (Ok(name), Ok(kind)) = (entry.file_name().into_string(), entry.file_type()) else {
            continue;
        };
        if names.len() >= MOST || name.starts_with('.') {
            continue;
        }
        if kind.is_dir() && depth > 0 && name != "refused" {
            collect(&entry.path(), &format!("{before}{name}/"), depth - 1, names);
        } else if kind.is_file() && is_scene(&name) {
            names.push(format!("{before}{name}"));
        }
    }
}
