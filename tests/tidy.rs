//! The house rules that a test can hold: who may import whom, every file says what it is for, the README's map is true.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Modules in reading order, each with the modules it may import. What is not listed here is not allowed.
const LAYERS: &[(&str, &str)] = &[
    ("expr", ""),
    ("interval", "expr"),
    ("domain", "expr interval"),
    ("dimension", "expr"),
    ("algebra", "expr domain"),
    ("equality", "expr interval domain algebra"),
    ("formula", "expr dimension"),
    (
        "scene",
        "expr interval domain dimension algebra equality formula",
    ),
    (
        "answer",
        "expr interval domain dimension algebra equality formula scene",
    ),
    ("laws", "expr scene"),
    ("numeric", "expr interval domain scene"),
    (
        "derive",
        "expr domain dimension algebra formula scene answer laws",
    ),
    (
        "verify",
        "expr interval domain dimension algebra equality formula scene answer laws numeric derive",
    ),
    (
        "grade",
        "expr interval domain dimension algebra equality formula scene answer laws numeric derive verify",
    ),
    (
        "story",
        "expr interval domain dimension algebra equality formula scene answer laws numeric derive verify",
    ),
    (
        "emit",
        "expr domain dimension formula scene answer numeric derive",
    ),
    (
        "report",
        "expr interval domain dimension scene answer laws numeric derive emit",
    ),
    ("figure", "expr domain dimension formula scene numeric"),
    ("plot", "figure"),
    (
        "solution",
        "expr domain dimension algebra formula scene answer laws derive verify story",
    ),
    ("worked", "scene answer derive verify story figure solution"),
    (
        "check",
        "expr interval domain dimension formula scene numeric",
    ),
    (
        "render",
        "expr domain dimension formula scene answer laws numeric derive verify story grade emit report figure plot solution worked",
    ),
    (
        "command",
        "expr dimension formula scene answer numeric derive verify grade story render worked",
    ),
    (
        "export",
        "expr domain formula scene answer numeric derive grade figure render",
    ),
    (
        "serve",
        "expr domain formula scene grade figure solution render",
    ),
];

fn sources(folder: &Path, out: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a readable source folder") {
        let path = entry.expect("a readable entry").path();
        if path.is_dir() {
            sources(&path, out);
        } else if path.extension().is_some_and(|e| e == "rs") {
            out.push(path);
        }
    }
}

fn all_sources() -> Vec<(PathBuf, String)> {
    let mut files = Vec::new();
    sources(Path::new("src"), &mut files);
    files.sort();
    let read = |file: PathBuf| {
        let text = fs::read_to_string(&file).expect("readable source");
        (file, text)
    };
    files.into_iter().map(read).collect()
}

/// The module a file belongs to: the first name below `src`.
fn module(file: &Path) -> String {
    let first = file.components().nth(1).expect("a path below src");
    first
        .as_os_str()
        .to_string_lossy()
        .trim_end_matches(".rs")
        .to_string()
}

/// Names after `crate::` in the code of a file, tests and comments aside.
fn imports(text: &str) -> Vec<String> {
    let code = text.split("#[cfg(test)]").next().unwrap_or(text);
    let mut found = Vec::new();
    for line in code.lines().filter(|l| !l.trim_start().starts_with("//")) {
        for after in line.split("crate::").skip(1) {
            found.push(
                after
                    .chars()
                    .take_while(|c| c.is_alphanumeric() || *c == '_')
                    .collect(),
            );
        }
    }
    found
}

#[test]
fn a_module_imports_only_what_lies_below_it() {
    let allowed: BTreeMap<&str, Vec<&str>> = LAYERS
        .iter()
        .map(|(name, below)| (*name, below.split(' ').collect()))
        .collect();
    let mut wrong = Vec::new();
    for (file, text) in all_sources() {
        let own = module(&file);
        if own == "lib" || own == "main" || own == "cli" || file.to_string_lossy().contains("tests")
        {
            continue;
        }
        let Some(below) = allowed.get(own.as_str()) else {
            wrong.push(format!(
                "{}: module {own} is missing in the table of layers",
                file.display()
            ));
            continue;
        };
        for name in imports(&text) {
            if name != own && allowed.contains_key(name.as_str()) && !below.contains(&name.as_str())
            {
                wrong.push(format!("{} imports {name}", file.display()));
            }
        }
    }
    assert!(
        wrong.is_empty(),
        "against the layers:\n{}",
        wrong.join("\n")
    );
}

#[test]
fn the_numeric_side_never_sees_the_symbolic_one() {
    for (file, text) in all_sources()
        .into_iter()
        .filter(|(f, _)| module(f) == "numeric")
    {
        for name in imports(&text) {
            assert!(
                !["algebra", "laws", "derive", "verify"].contains(&name.as_str()),
                "{} imports {name}",
                file.display()
            );
        }
    }
}

#[test]
fn no_function_is_longer_than_a_hundred_lines() {
    let mut long = Vec::new();
    for (file, text) in all_sources() {
        if file.to_string_lossy().contains("tests") {
            continue;
        }
        let lines: Vec<&str> = text.lines().collect();
        for (first, line) in lines.iter().enumerate() {
            let head = line.trim_start();
            let indent = &line[..line.len() - head.len()];
            let head = head.strip_prefix("pub").map_or(head, |rest| {
                rest.trim_start_matches(|c: char| c != ')' && c != ' ')
                    .trim_start_matches([')', ' '])
            });
            if !(head.starts_with("fn ") || head.starts_with("const fn ")) {
                continue;
            }
            let end = lines[first..]
                .iter()
                .position(|l| l.strip_prefix(indent).is_some_and(|l| l.starts_with('}')));
            if end.is_some_and(|end| end >= 100) {
                long.push(format!("{}:{}", file.display(), first + 1));
            }
        }
    }
    assert!(long.is_empty(), "more than 100 lines: {long:#?}");
}

#[test]
fn every_mutant_has_its_place() {
    let table = fs::read_to_string("tests/mutants.tsv").expect("the table");
    let rows = table
        .lines()
        .filter(|l| !l.is_empty() && !l.starts_with('#'));
    let lost = rows.filter(|row| {
        let cells: Vec<&str> = row.split('\t').collect();
        let text = fs::read_to_string(format!("src/{}", cells[0])).unwrap_or_default();
        let which: usize = cells[1].parse().expect("which of them");
        text.matches(cells[2]).count() < which
    });
    let lost: Vec<&str> = lost.collect();
    assert!(
        lost.is_empty(),
        "no longer in the sources:\n{}",
        lost.join("\n")
    );
}

#[test]
fn every_file_opens_by_saying_what_it_is_for() {
    let mute: Vec<_> = all_sources()
        .into_iter()
        .filter(|(_, t)| !t.starts_with("//!"))
        .map(|(f, _)| f)
        .collect();
    assert!(
        mute.is_empty(),
        "files without an opening //! line: {mute:?}"
    );
}

#[test]
fn modules_are_declared_in_reading_order() {
    let lib = fs::read_to_string("src/lib.rs").expect("src/lib.rs");
    let declared: Vec<&str> = lib
        .lines()
        .filter_map(|l| l.strip_prefix("pub mod ")?.strip_suffix(';'))
        .collect();
    let expected: Vec<&str> = LAYERS.iter().map(|(name, _)| *name).collect();
    assert_eq!(
        declared, expected,
        "src/lib.rs lists the modules in the order of the table of layers"
    );
}

#[test]
fn the_map_in_the_readme_names_every_module_and_no_other() {
    let readme = fs::read_to_string("README.md").expect("README.md");
    let map = readme.split("## Map of `src`").nth(1).expect("the map");
    let map = map.split("\n## ").next().expect("a section");
    let mut named: Vec<&str> = map
        .lines()
        .filter_map(|line| line.strip_prefix("| `")?.split('|').next())
        .flat_map(|cell| cell.split(',').map(|name| name.trim().trim_matches('`')))
        .collect();
    let mut modules: Vec<&str> = LAYERS.iter().map(|(name, _)| *name).collect();
    named.sort_unstable();
    modules.sort_unstable();
    assert_eq!(named, modules);
}
