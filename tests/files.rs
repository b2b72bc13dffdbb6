//! What commands do with files: whole or not at all, devices and links left standing, the input never overwritten.

#![cfg(unix)]

use std::fs;
use std::io::{Read, Write};
use std::os::unix::fs::{FileTypeExt, MetadataExt, PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};

const SCENE: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/derivations/book/falling-stick.json"
);

/// An empty folder of one test's own.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("files-{name}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

fn carom(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_carom"));
    command.current_dir(folder);
    command
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    carom(folder)
        .args(arguments)
        .output()
        .expect("the program starts")
}

fn draw(folder: &Path, output: &str) -> Output {
    run(folder, &["draw", SCENE, "-o", output])
}

fn words(out: &Output) -> String {
    String::from_utf8(out.stderr.clone()).expect("text")
}

/// The files of a folder by name.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> = entries
        .map(|e| {
            e.expect("an entry")
                .file_name()
                .into_string()
                .expect("text")
        })
        .collect();
    names.sort();
    names
}

fn is_drawing(path: &Path) -> bool {
    fs::read_to_string(path).is_ok_and(|t| t.starts_with("<svg") && t.ends_with("</svg>\n"))
}

#[test]
fn a_file_keeps_its_mode_its_links_and_its_other_names() {
    let folder = folder("links");
    let file = folder.join("real.svg");
    fs::write(&file, "old").expect("written");
    fs::set_permissions(&file, fs::Permissions::from_mode(0o604)).expect("set");
    symlink("real.svg", folder.join("link.svg")).expect("a link");
    symlink("link.svg", folder.join("chain.svg")).expect("a link");
    symlink("fresh.svg", folder.join("open.svg")).expect("a link");
    for output in ["link.svg", "chain.svg", "real.svg"] {
        fs::write(&file, "old").expect("written");
        assert!(draw(&folder, output).status.success(), "{output}");
        assert!(is_drawing(&file), "{output}");
        let mode = fs::metadata(&file).expect("there").permissions().mode();
        assert_eq!(mode & 0o777, 0o604, "{output}");
    }
    assert!(draw(&folder, "open.svg").status.success());
    assert!(is_drawing(&folder.join("fresh.svg")));
    for link in ["link.svg", "chain.svg", "open.svg"] {
        let found = fs::symlink_metadata(folder.join(link)).expect("there");
        assert!(found.is_symlink(), "{link}");
    }
    let twin = folder.join("twin.svg");
    fs::hard_link(&file, &twin).expect("a second name");
    fs::write(&file, "old, and longer than what comes".repeat(10_000)).expect("written");
    assert!(draw(&folder, "twin.svg").status.success());
    let nodes = [&file, &twin].map(|f| fs::metadata(f).expect("there").ino());
    assert_eq!(nodes[0], nodes[1]);
    assert!(is_drawing(&file));
    symlink("round.svg", folder.join("round.svg")).expect("a link");
    let round = draw(&folder, "round.svg");
    assert_eq!(round.status.code(), Some(74), "{}", words(&round));
}

#[test]
fn what_is_no_regular_file_is_written_through() {
    let folder = folder("through");
    symlink("/dev/null", folder.join("null.svg")).expect("a link");
    assert!(draw(&folder, "null.svg").status.success());
    assert!(
        run(&folder, &["emit", SCENE, "-o", "/dev/null"])
            .status
            .success()
    );
    let null = fs::metadata("/dev/null").expect("there");
    assert!(null.file_type().is_char_device());
    let pipe = folder.join("pipe.svg");
    let made = Command::new("mkfifo").arg(&pipe).status();
    assert!(made.is_ok_and(|s| s.success()), "a pipe");
    let reader = {
        let pipe = pipe.clone();
        std::thread::spawn(move || fs::read_to_string(pipe))
    };
    assert!(draw(&folder, "pipe.svg").status.success());
    let text = reader.join().expect("a thread").expect("text");
    assert!(text.ends_with("</svg>\n"));
    assert!(fs::metadata(&pipe).expect("there").file_type().is_fifo());
    let out = run(&folder, &["emit", SCENE, "-o", "-"]);
    assert!(out.stdout.starts_with(b"//! Falling stick"));
    assert_eq!(names(&folder), ["null.svg", "pipe.svg"]);
}

#[test]
fn the_input_and_what_must_not_be_written_stay_as_they_are() {
    let folder = folder("input");
    let text = fs::read_to_string(SCENE).expect("a scene");
    fs::write(folder.join("scene.svg"), &text).expect("written");
    symlink("scene.svg", folder.join("link.svg")).expect("a link");
    fs::hard_link(folder.join("scene.svg"), folder.join("twin.svg")).expect("a second name");
    for output in ["scene.svg", "./scene.svg", "link.svg", "twin.svg"] {
        for command in ["draw", "solution", "emit"] {
            let out = run(&folder, &[command, "scene.svg", "-o", output]);
            assert_eq!(out.status.code(), Some(2), "{command} {output}");
            assert!(words(&out).contains("is what was read"), "{}", words(&out));
        }
    }
    let kept = fs::read_to_string(folder.join("scene.svg")).expect("there");
    assert_eq!(kept, text);
    fs::create_dir(folder.join("folder.svg")).expect("a folder");
    for output in ["folder.svg", "nowhere/a.svg", "scene.svg/a.svg"] {
        let out = draw(&folder, output);
        assert_eq!(out.status.code(), Some(74), "{output}");
        assert!(words(&out).contains("cannot be written"), "{}", words(&out));
    }
    assert_eq!(
        names(&folder),
        ["folder.svg", "link.svg", "scene.svg", "twin.svg"]
    );
}

#[test]
fn a_full_disk_is_no_fault_of_carom_and_leaves_nothing_behind() {
    let folder = folder("full");
    for arguments in [
        &["draw", SCENE][..],
        &["grade", "--expected", "a", "--answer", "a"],
        &["schema"],
        &["draw", "nothing.json"],
    ] {
        let full = || fs::OpenOptions::new().write(true).open("/dev/full");
        let mut command = carom(&folder);
        let out = command
            .args(arguments)
            .stdout(full().expect("a device"))
            .stderr(Stdio::piped())
            .output()
            .expect("the program starts");
        let unreadable = arguments.contains(&"nothing.json");
        let expected = if unreadable { 2 } else { 74 };
        assert_eq!(out.status.code(), Some(expected), "{arguments:?}");
        // Nor does it matter that nobody hears of it.
        let status = carom(&folder)
            .args(arguments)
            .stdout(full().expect("a device"))
            .stderr(full().expect("a device"))
            .status();
        assert_eq!(status.expect("a start").code(), Some(expected));
    }
    symlink("/dev/full", folder.join("full.svg")).expect("a link");
    assert_eq!(draw(&folder, "full.svg").status.code(), Some(74));
    // The shell's limit counts blocks; a drawing is longer than one.
    fs::write(folder.join("old.svg"), "old").expect("written");
    let limited = Command::new("sh")
        .current_dir(&folder)
        .args(["-c", "ulimit -f 1; exec \"$0\" draw \"$1\" -o old.svg"])
        .args([env!("CARGO_BIN_EXE_carom"), SCENE])
        .output()
        .expect("a shell");
    assert_eq!(limited.status.code(), Some(74), "{}", words(&limited));
    assert_eq!(names(&folder), ["full.svg", "old.svg"]);
    let kept = fs::read_to_string(folder.join("old.svg")).expect("there");
    assert_eq!(kept, "old");
}

#[test]
fn a_closed_pipe_changes_no_verdict() {
    let folder = folder("pipe");
    for (answer, status) in [("a", 0), ("b", 1)] {
        let mut child = carom(&folder)
            .args(["grade", "--expected", "a", "--answer", answer])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program starts");
        drop(child.stdout.take());
        let out = child.wait_with_output().expect("an end");
        assert_eq!(out.status.code(), Some(status), "{}", words(&out));
        assert!(out.stderr.is_empty(), "{}", words(&out));
    }
}

#[test]
fn limits_are_applied_while_reading() {
    let folder = folder("limits");
    for arguments in [
        &["derive", "-"][..],
        &["solve", "/dev/zero"],
        &["check", "-"],
        &["verify", SCENE, "--answers", "/dev/zero"],
        &["grade", SCENE, "--steps", "-"],
    ] {
        let zeros = fs::File::open("/dev/zero").expect("a device");
        let out = carom(&folder)
            .args(arguments)
            .stdin(zeros)
            .output()
            .expect("the program starts");
        assert_eq!(out.status.code(), Some(2), "{arguments:?}");
        assert!(words(&out).contains("too long"), "{}", words(&out));
    }
}

/// A batch that has answered some lines and waits for more.
fn waiting_batch(folder: &Path) -> (Child, Vec<u8>) {
    let mut child = carom(folder)
        .args(["grade", "--batch"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut pipe = child.stdin.take().expect("a pipe");
    let line = "{\"id\": 1, \"expected\": \"a + b\", \"answer\": \"b + a\"}\n";
    pipe.write_all(line.repeat(100).as_bytes()).expect("taken");
    let mut seen = vec![0; 1];
    let out = child.stdout.as_mut().expect("a pipe");
    out.read_exact(&mut seen).expect("an answer");
    // What was asked stays open: the batch waits for the next line.
    child.stdin = Some(pipe);
    (child, seen)
}

#[test]
fn a_signal_ends_a_batch_behind_a_whole_line() {
    let folder = folder("signal");
    for (name, number) in [("INT", 2), ("TERM", 15)] {
        let (mut child, mut seen) = waiting_batch(&folder);
        let pid = child.id().to_string();
        let sent = Command::new("kill").args(["-s", name, &pid]).status();
        assert!(sent.is_ok_and(|s| s.success()));
        let mut out = child.stdout.take().expect("a pipe");
        out.read_to_end(&mut seen).expect("the rest");
        let status = child.wait().expect("an end");
        let signal = std::os::unix::process::ExitStatusExt::signal(&status);
        assert_eq!(signal, Some(number));
        let text = String::from_utf8(seen).expect("text");
        assert!(text.ends_with("}\n"), "{text}");
        for line in text.lines() {
            serde_json::from_str::<serde_json::Value>(line).expect("whole lines");
        }
    }
}

#[test]
fn a_prefix_that_begins_no_name_is_refused() {
    let folder = folder("prefix");
    for (prefix, status) in [("1x;", 2), ("a b", 2), ("9", 2), ("_x", 0), ("x9_", 0)] {
        let out = run(&folder, &["emit", SCENE, "--lang", "c", "--prefix", prefix]);
        assert_eq!(out.status.code(), Some(status), "{prefix}: {}", words(&out));
        assert_eq!(out.stdout.is_empty(), status == 2, "{prefix}");
    }
}

#[test]
fn speeds_near_the_ends_of_doubles_have_a_picture_and_a_number() {
    let folder = folder("ends");
    let at = |command: &str, v: &str, more: &[&str]| {
        let set = ["m=1", "l=1", "theta=0.5", v].map(|value| format!("--set={value}"));
        let mut arguments = vec![command, SCENE];
        arguments.extend(set.iter().map(String::as_str));
        arguments.extend(more);
        let out = run(&folder, &arguments);
        assert_eq!(out.status.code(), Some(0), "{v}: {}", words(&out));
        String::from_utf8(out.stdout).expect("text")
    };
    for v in ["v=1e-310", "v=1e308"] {
        let drawn = at("draw", v, &["--which", "before"]);
        assert!(!drawn.contains("NaN") && !drawn.contains("inf"), "{drawn}");
    }
    // What is left of 2e-401 J in a double.
    let solved = at("solve", "v=1e-200", &[]);
    assert!(solved.contains("E_lost = 0 J"), "{solved}");
}
