//! Every command of the guide is run, and prints what stands below it; what it shows of a scene stands there.
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
    let guide = fs::read_to_string(GUIDE).expect("the guide");
    let mut renewed = String::new();
    let mut rest = guide.as_str();
    let mut blocks = 0;
    while let Some((before, behind)) = rest.split_once("```sh\n") {
        let (commands, behind) = behind.split_once("```\n").expect("an end of the block");
        let (between, behind) = behind.split_once("```text\n").expect("the output");
        assert_eq!(
            between.trim(),
            "",
            "the output stands right below its commands"
        );
        let (told, behind) = behind.split_once("```\n").expect("an end of the output");
        // A machine without GNU parallel takes the guide's word for it.
        let is_here = !commands.contains("parallel ") || has("parallel");
        let output = if is_here {
            printed(commands, &folder)
        } else {
            told.to_string()
        };
        renewed.push_str(&format!(
            "{before}```sh\n{commands}```\n\n```text\n{output}```\n"
        ));
        rest = behind;
        blocks += 1;
    }
    renewed.push_str(rest);
    assert!(blocks >= 6);
    if std::env::var_os("UPDATE").is_some() {
        fs::write(GUIDE, &renewed).expect("a writable guide");
    }
    let told = fs::read_to_string(GUIDE).expect("the guide");
    assert_eq!(told, renewed, "UPDATE=1 cargo test --test all guide::");
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
