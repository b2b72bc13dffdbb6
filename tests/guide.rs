//! Every command of the guide and of the README that has its output below it is run, and prints just that; what the guide
//! shows of a scene stands there.
//!
//! `UPDATE=1 cargo test --test all guide::` writes the outputs anew; reading that diff is the review.

#![cfg(unix)]

use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

const GUIDE: &str = "GUIDE.md";

/// What a block of commands prints in the folder, standard error included.
fn printed(commands: &str, folder: &Path) -> String {
    let program = Path::new(env!("CARGO_BIN_EXE_carom"));
    let path = std::env::var("PATH").unwrap_or_default();
    let programs = program.parent().expect("a folder").display();
    let run = Command::new("sh")
        .args(["-c", &format!("exec 2>&1\n{commands}")])
        .current_dir(folder)
        .env("PATH", format!("{programs}:{path}"))
        .output()
        .expect("a shell");
    String::from_utf8(run.stdout).expect("text")
}

fn has(program: &str) -> bool {
    Command::new(program).arg("--version").output().is_ok()
}

#[test]
fn every_command_of_the_guide_prints_what_stands_below_it() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("guide");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder");
    // A machine without GNU parallel takes the guide's word for it.
    let is_here = |commands: &str| !commands.contains("parallel ") || has("parallel");
    let blocks = prints_what_it_shows(GUIDE, &folder, &is_here);
    assert!(blocks >= 6);
}

#[test]
fn every_output_of_the_readme_is_what_its_command_prints() {
    let blocks = prints_what_it_shows("README.md", Path::new("."), &|_| true);
    assert!(blocks >= 2);
}

/// Holds what stands below commands of a document against what they print in a folder, where they can run here; gives how
/// many were.
fn prints_what_it_shows(document: &str, folder: &Path, is_here: &dyn Fn(&str) -> bool) -> usize {
    let guide = fs::read_to_string(document).expect("a document");
    let mut renewed = String::new();
    let mut rest = guide.as_str();
    let mut blocks = 0;
    while let Some((before, behind)) = rest.split_once("```sh\n") {
        let (commands, behind) = behind.split_once("```\n").expect("an end of the block");
        let Some(behind) = behind.strip_prefix("\n```text\n") else {
            assert!(document != GUIDE, "no output below {commands}");
            renewed.push_str(&format!("{before}```sh\n{commands}```\n"));
            rest = behind;
            continue;
        };
        let (told, behind) = behind.split_once("```\n").expect("an end of the output");
        let output = match is_here(commands) {
            true => printed(commands, folder),
            false => told.to_string(),
        };
        renewed.push_str(&format!(
            "{before}```sh\n{commands}```\n\n```text\n{output}```\n"
        ));
        rest = behind;
        blocks += 1;
    }
    renewed.push_str(rest);
    if std::env::var_os("UPDATE").is_some() {
        fs::write(document, &renewed).expect("a writable document");
    }
    let told = fs::read_to_string(document).expect("a document");
    assert_eq!(told, renewed, "UPDATE=1 cargo test --test all guide::");
    blocks
}

/// Whether all that a part says is said by the whole.
fn says(whole: &Value, part: &Value) -> bool {
    match (whole, part) {
        (Value::Object(whole), Value::Object(part)) => part
            .iter()
            .all(|(name, part)| whole.get(name).is_some_and(|whole| says(whole, part))),
        (Value::Array(whole), Value::Array(part)) => {
            whole.len() == part.len()
                && whole
                    .iter()
                    .zip(part)
                    .all(|(whole, part)| says(whole, part))
        }
        _ => whole == part,
    }
}

/// Whether a scene, or anything inside of it, says all that a part says.
fn holds(scene: &Value, part: &Value) -> bool {
    says(scene, part)
        || match scene {
            Value::Object(inside) => inside.values().any(|v| holds(v, part)),
            Value::Array(inside) => inside.iter().any(|v| holds(v, part)),
            _ => false,
        }
}

#[test]
fn what_the_guide_shows_of_a_scene_stands_in_that_scene() {
    let guide = fs::read_to_string(GUIDE).expect("the guide");
    let mut rows = 0;
    for row in guide.lines().filter(|line| line.ends_with(".json) |")) {
        let (_, shown) = row.split_once("| `").expect("a part of a scene");
        let (part, link) = shown.split_once("` | ").expect("an end of the part");
        let (_, path) = link.split_once("](").expect("a link");
        let path = path.trim_end_matches(") |");
        let part: Value = serde_json::from_str(&format!("{{{part}}}")).expect(row);
        let scene = fs::read_to_string(path).expect(path);
        let scene: Value = serde_json::from_str(&scene).expect(path);
        assert!(holds(&scene, &part), "{path} does not say {part}");
        rows += 1;
    }
    assert!(rows >= 50);
}
