//! Strangers' input beside scenes that are worked out: answers to what they ask, solutions line by line, printed answers,
//! and scenes with stages that somebody has changed.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::time::Duration;

use carom::grade::sheet::Sheet;
use carom::grade::{Options, show, steps};
use carom::numeric::random::Rng;
use carom::solution::Detail;
use carom::{command, render, scene, verify, worked};

use super::{corpus, mutated, replaced, run, shared, text};

/// The longest that one input may take: a scene is worked out within a second or so, a test without optimization takes ten.
const LONGEST: Duration = Duration::from_secs(20);

/// The sheet of a scene; nothing where its friction leaves cases that differ in all they answer.
fn sheet(path: &Path) -> Option<Rc<Sheet>> {
    let text = fs::read_to_string(path).expect("a scene");
    let scene = scene::read(&text).expect("a sound scene");
    let (sheet, _) = command::sheet(scene).ok()?;
    Some(Rc::new(sheet))
}

/// Of a list as much as so many cases can use, spread over it.
fn some<T>(all: Vec<T>, cases: u64) -> Vec<T> {
    let wanted = (cases / 10).max(3) as usize;
    let step = all.len().div_ceil(wanted);
    all.into_iter().step_by(step).collect()
}

fn shipped(cases: u64) -> Vec<PathBuf> {
    let folders = ["derivations", "tests/stories/scenes"];
    let all = folders.iter().flat_map(|f| shared::files(f, "json"));
    some(all.collect(), cases)
}

pub fn answer_anything(cases: u64) {
    let corpus = corpus();
    let sheets: Vec<Rc<Sheet>> = shipped(cases).iter().filter_map(|p| sheet(p)).collect();
    run("answers in scenes", cases, LONGEST, |rng| {
        let sheet = sheets[rng.below(sheets.len())].clone();
        let names = sheet.quantities();
        let name = names[rng.below(names.len())].clone();
        let other = names[rng.below(names.len())].clone();
        let shown = |name: &str| {
            let entry = sheet.entry(name);
            entry.map_or(String::from("1"), |e| show(&e.key.reading.content))
        };
        let answer = match rng.below(4) {
            0 => text(rng, &corpus),
            1 => mutated(&corpus[rng.below(corpus.len())], &shown(&name), rng),
            _ => mutated(&shown(&name), &shown(&other), rng),
        };
        let input = format!("{}, {name}: {answer}", sheet.scene.title);
        let work = move || {
            let Ok(entry) = sheet.entry(&name) else {
                return;
            };
            let grade = sheet.judge(&entry, &answer, &Options::default());
            assert!(!render::grade::text(&grade, &answer).is_empty());
        };
        (input, Box::new(work))
    });
}

pub fn check_any_solution(cases: u64) {
    let corpus = corpus();
    let mut sheets = BTreeMap::new();
    let solutions: Vec<(Rc<Sheet>, Vec<String>)> =
        some(shared::files("tests/grading/steps", "tsv"), cases)
            .iter()
            .filter_map(|file| {
                let table = fs::read_to_string(file).expect("a table");
                let head = table.lines().next()?.strip_prefix("# ")?;
                let path = Path::new("derivations").join(head.split_whitespace().next()?);
                let sheet = sheets.entry(path.clone()).or_insert_with(|| sheet(&path));
                let rows = table.lines().skip(1);
                let lines = rows.filter_map(|row| Some(row.split('\t').nth(1)?.to_string()));
                Some((sheet.clone()?, lines.collect()))
            })
            .collect();
    assert!(!solutions.is_empty());
    run("worked solutions", cases, LONGEST, |rng| {
        let (sheet, lines) = solutions[rng.below(solutions.len())].clone();
        let (_, others) = &solutions[rng.below(solutions.len())];
        let mut lines = lines;
        for _ in 0..1 + rng.below(3) {
            let at = rng.below(lines.len() + 1);
            let there = lines.get(at).cloned();
            match (rng.below(5), there) {
                (0, _) => lines.insert(at, text(rng, &corpus).replace('\n', " ")),
                (1, _) if !others.is_empty() => {
                    lines.insert(at, others[rng.below(others.len())].clone());
                }
                (2, Some(_)) => {
                    lines.remove(at);
                }
                (_, Some(line)) => {
                    lines[at] = mutated(&line, &corpus[rng.below(corpus.len())], rng)
                }
                _ => {}
            }
        }
        let written = lines.join("\n");
        let input = format!("{}: {written}", sheet.scene.title);
        let work = move || {
            let checked = steps::check(&sheet, &written, &Options::default());
            let _ = render::grade::steps_text(&checked);
        };
        (input, Box::new(work))
    });
}

pub fn verify_anything(cases: u64) {
    let corpus = corpus();
    let lists: Vec<(Rc<Sheet>, String)> = some(shared::files("tests/printed", "json"), cases)
        .iter()
        .filter_map(|file| {
            let list = fs::read_to_string(file).expect("a list");
            let name = file.file_name()?.to_str()?.replace(".answers", "");
            let beside = |path: &PathBuf| path.file_name().is_some_and(|n| n == name.as_str());
            let path = shared::files(".", "json").into_iter().find(beside)?;
            Some((sheet(&path)?, list))
        })
        .collect();
    assert!(!lists.is_empty());
    run("printed answers", cases, LONGEST, |rng| {
        let (sheet, list) = lists[rng.below(lists.len())].clone();
        let list = replaced(&list, &text(rng, &corpus), rng);
        let input = format!("{}: {list}", sheet.scene.title);
        let work = move || match scene::read_printed(&list) {
            Ok(printed) => {
                let mut scene = sheet.scene.clone();
                scene.printed = printed;
                let mut findings = verify::printed::check(&verify::printed::Way::of(
                    &scene,
                    &sheet.derivation,
                    &sheet.all,
                ));
                sheet.explain(&mut findings);
                let _ = render::printed::text(&scene, &findings, findings.len());
            }
            Err(faults) => assert!(!faults.list.is_empty()),
        };
        (input, Box::new(work))
    });
}

pub fn work_out_any_stages(cases: u64) {
    let corpus = corpus();
    let scenes: Vec<String> = shared::files("derivations", "json")
        .into_iter()
        .chain(shared::files("tests/stories/scenes", "json"))
        .map(|file| fs::read_to_string(file).expect("a scene"))
        .filter(|text| text.contains("\"stages\"") && text.len() < 8_000)
        .collect();
    run("stages", cases, LONGEST, |rng| {
        let scene_text = scenes[rng.below(scenes.len())].clone();
        let damaged = match rng.below(3) {
            0 => renumbered(&scene_text, rng),
            _ => replaced(&scene_text, &text(rng, &corpus), rng),
        };
        let input = damaged.clone();
        let work = move || {
            if let Ok(scene) = scene::read(&damaged)
                && let Ok(worked) = worked::in_cases(&scene)
            {
                let _ = render::plain::solution(&worked.solution(Detail::Normal));
            }
        };
        (input, Box::new(work))
    });
}

/// A text with one of its digits changed: often still a scene, with other values or a form that no longer fits.
fn renumbered(text: &str, rng: &mut Rng) -> String {
    let digits: Vec<usize> = text
        .match_indices(|c: char| c.is_ascii_digit())
        .map(|(at, _)| at)
        .collect();
    let at = digits[rng.below(digits.len())];
    format!("{}{}{}", &text[..at], rng.below(10), &text[at + 1..])
}
