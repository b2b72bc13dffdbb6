//! Lines of a batch: JSON text in, one line of JSON out for each, whatever comes in. Scenes named in a line are derived once.

use std::collections::HashMap;
use std::path::{Component, Path};
use std::sync::{Arc, Mutex, PoisonError};

use super::only_quantity;
use crate::grade::entry::{self, Entry, Keys};
use crate::grade::sheet::Sheet;
use crate::grade::{self, Grade, Options};
use crate::render;

/// Scenes kept at a time.
const SHEETS: usize = 256;

/// What gives the sheet of the scene a line names.
type Open = dyn Fn(&str) -> Result<Sheet, String> + Send + Sync;

/// What all lines of a batch share.
pub struct Lines {
    options: Options,
    open: Box<Open>,
    known: Mutex<HashMap<String, Arc<Result<Sheet, String>>>>,
}

impl Lines {
    /// `options` hold for every line, which may ask for more; `open` gives the sheet of a scene by the path a line names.
    pub fn new(
        options: Options,
        open: impl Fn(&str) -> Result<Sheet, String> + Send + Sync + 'static,
    ) -> Lines {
        Lines {
            options,
            open: Box::new(open),
            known: Mutex::default(),
        }
    }

    /// Judges a line and appends what it gives to `out`. `number` is that of the line, from 1.
    pub fn judge(&self, keys: &mut Keys, line: &str, number: u64, out: &mut String) {
        if line.bytes().all(|b| b.is_ascii_whitespace()) {
            return refuse(&[], number, String::from("the line is blank"), out);
        }
        match entry::entry(line, &self.options) {
            Ok(entry) => {
                let scenes = |entry: &Entry, scene: &str| self.in_scene(entry, scene);
                let grade = entry::judge(&entry, keys, &scenes);
                let text = match grade.note {
                    "INVALID_EXPECTED" => entry.expected.as_deref().unwrap_or_default(),
                    "INVALID_LINE" => "",
                    _ => &entry.answer,
                };
                render::grade::line(out, &entry.id, number, &grade, text);
            }
            Err(bad) => {
                render::grade::line(out, &bad.id, number, &entry::refused(bad.message), "");
            }
        }
    }

    fn in_scene(&self, entry: &Entry, path: &str) -> Result<Grade, String> {
        let sheet = self.sheet(path);
        let sheet = sheet.as_ref().as_ref().map_err(Clone::clone)?;
        // With a formula of its own a line takes from the scene what its symbols mean.
        if let Some(expected) = &entry.expected {
            let mut question = sheet.question();
            if let Some(name) = &entry.quantity {
                question.asked = sheet.entry(name)?.key.question.asked;
            }
            return Ok(grade::judge(
                expected,
                &entry.answer,
                &question,
                &entry.options,
            ));
        }
        let name = entry
            .quantity
            .clone()
            .or_else(|| only_quantity(sheet))
            .ok_or_else(|| {
                format!(
                    "\"quantity\" is missing: one of {}",
                    sheet.quantities().join(", ")
                )
            })?;
        let found = sheet.entry(&name)?;
        Ok(sheet.judge(&found, &entry.answer, &entry.options))
    }

    fn sheet(&self, path: &str) -> Arc<Result<Sheet, String>> {
        let known = || self.known.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(sheet) = known().get(path) {
            return sheet.clone();
        }
        // Lines come from strangers: no way out of the folder, and nothing of a file's text in a message.
        let is_below = |c: Component| matches!(c, Component::Normal(_) | Component::CurDir);
        let sheet = Arc::new(match Path::new(path).components().all(is_below) {
            true => (self.open)(path).map_err(|_| {
                format!("{path}: not a readable scene; `carom derive {path}` tells why")
            }),
            false => Err(format!(
                "{path}: a scene is named by a path below the working folder, without `..`"
            )),
        });
        let mut known = known();
        if known.len() >= SHEETS {
            known.clear();
        }
        known.insert(path.to_string(), sheet.clone());
        sheet
    }
}

/// Answers a line that cannot be read, with its `id` where that can.
pub fn refuse(line: &[u8], number: u64, message: String, out: &mut String) {
    let id = entry::id_in(&String::from_utf8_lossy(line));
    render::grade::line(out, &id, number, &entry::refused(message), "");
}
