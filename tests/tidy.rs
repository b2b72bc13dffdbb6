//! The house rules that a test can hold: who may import whom, every file says what it is for, the README's map is true.

use std::collections::{BTreeMap, BTreeSet};
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
        "expr domain formula scene answer numeric derive grade figure solution render",
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

/// A file below `src` as the path of its module.
fn path_of(file: &Path) -> Vec<String> {
    let parts = file.with_extension("");
    let parts = parts.components().skip(1);
    let mut path: Vec<String> = parts
        .map(|part| part.as_os_str().to_string_lossy().into_owned())
        .collect();
    if path
        .last()
        .is_some_and(|last| last == "mod" || last == "lib")
    {
        path.pop();
    }
    path
}

/// The paths that one use names: `a::{b, c::{d, e}}` names three.
fn spread(tree: &str) -> Vec<String> {
    let tree = tree.trim();
    let Some((head, inside)) = tree.split_once('{') else {
        let name = tree.split(" as ").next().unwrap_or(tree);
        return vec![name.trim().to_owned()];
    };
    let inside = inside.trim_end().strip_suffix('}').unwrap_or(inside);
    let mut depth = 0;
    let parts = inside.split(|c: char| {
        depth += i32::from(c == '{') - i32::from(c == '}');
        c == ',' && depth == 0
    });
    let parts = parts.filter(|part| !part.trim().is_empty());
    parts
        .flat_map(spread)
        .map(|part| format!("{head}{part}"))
        .collect()
}

/// The paths in the code of a file, tests and comments aside; those it hands on are another file's.
fn paths(text: &str) -> Vec<String> {
    let code = text.split("#[cfg(test)]").next().unwrap_or(text);
    let lines = code.lines().map(|l| l.split("//").next().unwrap_or(l));
    let code: Vec<&str> = lines.filter(|l| !l.is_empty()).collect();
    let mut found = Vec::new();
    for statement in code.join("\n").split(';') {
        let start = statement.rfind("\nuse ").map(|at| at + 1);
        let start = start.or_else(|| statement.starts_with("use ").then_some(0));
        if let Some(at) = start {
            found.extend(spread(&statement[at + 4..]));
            continue;
        }
        if statement.trim_start().starts_with("pub") && statement.contains(" use ") {
            continue;
        }
        let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
        let words = statement.split(|c: char| !is_part(c));
        let words = words.filter(|w| w.starts_with("crate::") || w.starts_with("super::"));
        found.extend(words.map(str::to_owned));
    }
    found
}

#[test]
fn no_files_go_in_circles() {
    let all = all_sources();
    let files: BTreeSet<Vec<String>> = all.iter().map(|(file, _)| path_of(file)).collect();
    let mut needs: BTreeMap<Vec<String>, BTreeSet<Vec<String>>> = BTreeMap::new();
    for (file, text) in &all {
        let own = path_of(file);
        for path in paths(text) {
            let mut base = own.clone();
            let names: Vec<&str> = path.split("::").map(str::trim).collect();
            let up = names
                .iter()
                .take_while(|n| matches!(**n, "crate" | "super" | "self"));
            let up = up.count();
            for name in &names[..up] {
                match *name {
                    "crate" => base.clear(),
                    "super" => drop(base.pop()),
                    _ => {}
                }
            }
            base.extend(names[up..].iter().map(|name| (*name).to_owned()));
            while !base.is_empty() && !files.contains(&base) {
                base.pop();
            }
            // What a folder holds may use its head, and the head what it holds.
            if !base.starts_with(&own) && !own.starts_with(&base) {
                needs.entry(own.clone()).or_default().insert(base);
            }
        }
    }
    assert!(needs.len() > 400, "{} files that need others", needs.len());
    // What needs nothing that is left, or is needed by nothing, is in no circle.
    while let Some(free) = needs
        .iter()
        .find(|(own, of)| {
            of.iter().all(|path| !needs.contains_key(path))
                || needs.values().all(|of| !of.contains(*own))
        })
        .map(|(own, _)| own.clone())
    {
        needs.remove(&free);
    }
    let left: BTreeSet<&Vec<String>> = needs.keys().collect();
    let tied = needs.iter().map(|(own, of)| {
        let of = of.iter().filter(|path| left.contains(path));
        let of: Vec<String> = of.map(|path| path.join("::")).collect();
        format!("{} needs {}", own.join("::"), of.join(", "))
    });
    let tied: Vec<String> = tied.collect();
    assert!(tied.is_empty(), "in circles:\n{}", tied.join("\n"));
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
    // Each stands in a block of its own.
    let is_one = |expression: &str| {
        let mut depth = 0i32;
        let whole = expression.chars().all(|c| {
            depth += i32::from("([{".contains(c)) - i32::from(")]}".contains(c));
            depth > 0 || (depth == 0 && !",;".contains(c))
        });
        whole && depth == 0
    };
    let lost = rows.filter(|row| {
        let cells: Vec<&str> = row.split('\t').collect();
        let text = fs::read_to_string(format!("src/{}", cells[0])).unwrap_or_default();
        let which: usize = cells[1].parse().expect("which of them");
        text.matches(cells[2]).count() < which || !is_one(cells[2]) || !is_one(cells[3])
    });
    let lost: Vec<&str> = lost.collect();
    assert!(
        lost.is_empty(),
        "no longer in the sources, or no expression:\n{}",
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
