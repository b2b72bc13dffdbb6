//! Worked solutions: generated beside every scene, replayed step by step, safe whatever the scene is called.
//! `UPDATE=1 cargo test --test all solutions::` writes the expected texts anew; reading that diff is the review.

use crate::shared;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use carom::expr::Expr;
use carom::grade::steps::{self, Status};
use carom::solution::{Detail, Solution};
use carom::worked::{self, Worked};
use carom::{check, figure, formula, grade, render, scene, solution};
use rayon::prelude::*;

/// A scene, worked out once for all tests.
struct Case {
    path: PathBuf,
    text: String,
    scene: scene::Scene,
    worked: &'static Worked,
    /// Its solutions by detail, each written once for all tests.
    written: [OnceLock<Solution>; 3],
}

impl Case {
    fn read(path: PathBuf) -> Case {
        let text = fs::read_to_string(&path).expect("a readable scene");
        let worked = shared::worked(&path).as_ref();
        let worked = worked.unwrap_or_else(|why| panic!("{}: {why}", path.display()));
        Case {
            path,
            text,
            scene: worked.scene.clone(),
            worked,
            written: Default::default(),
        }
    }

    /// Whether it is one of `derivations`, held to every law of a page without exception.
    fn is_shipped(&self) -> bool {
        self.path.starts_with("derivations")
    }

    fn solution(&self, detail: Detail) -> &Solution {
        self.written[detail as usize].get_or_init(|| self.worked.solution(detail))
    }
}

/// Every shipped scene with a worked solution.
fn cases() -> &'static [Case] {
    static CASES: OnceLock<Vec<Case>> = OnceLock::new();
    CASES.get_or_init(|| {
        let files = shared::files("derivations", "json");
        files.into_par_iter().map(Case::read).collect()
    })
}

/// The same, and the scenes of the tests of stories.
fn all_cases() -> impl Iterator<Item = &'static Case> {
    static STORIES: OnceLock<Vec<Case>> = OnceLock::new();
    let stories = STORIES.get_or_init(|| {
        let files = shared::files("tests/stories/scenes", "json");
        files.into_par_iter().map(Case::read).collect()
    });
    cases().iter().chain(stories)
}

fn solved(scene: &scene::Scene, detail: Detail) -> Solution {
    worked::out(scene)
        .expect("a scene that is worked out")
        .solution(detail)
}

#[test]
fn every_scene_has_its_generated_solution_beside_it() {
    let mut stale = Vec::new();
    for case in cases() {
        let text = render::markdown::solution(case.solution(Detail::Normal), &[]);
        let file = case.path.with_extension("md");
        if std::env::var_os("UPDATE").is_some() {
            fs::write(&file, &text).expect("a writable folder");
        } else if fs::read_to_string(&file).unwrap_or_default() != text {
            stale.push(file);
        }
    }
    assert!(stale.is_empty(), "differ from what is generated: {stale:?}");
}

#[test]
fn every_step_of_every_solution_can_be_replayed() {
    all_cases().par_bridge().for_each(|case| {
        for detail in [Detail::Brief, Detail::Normal, Detail::Full] {
            let written = case.solution(detail);
            let json = render::steps::solution(written, &case.text, &[]).to_string();
            let report = check::check(&json).expect("a usable solution");
            let name = case.path.display();
            assert!(report.failed.is_empty(), "{name}: {:?}", report.failed);
            // No point may be found where a narrow case holds.
            assert!(
                report.open.is_empty() || !case.is_shipped(),
                "{name}: {:?}",
                report.open
            );
        }
    });
}

#[test]
fn steps_that_suppose_something_are_replayed_where_it_is_so() {
    // Whether the scene supposes something by which it stands and falls: the contrary supposed, the motion found is another.
    let supposes = |case: &&Case| {
        let written = case.solution(Detail::Normal);
        let json = render::steps::solution(written, &case.text, &[]);
        let mut contrary = json.clone();
        for need in contrary["needs"].as_array_mut().into_iter().flatten() {
            *need = format!("-({})", need.as_str().expect("a formula")).into();
        }
        for impact in contrary["impacts"].as_array_mut().into_iter().flatten() {
            impact["needs"] = serde_json::json!([]);
        }
        let report = |json| check::check(&format!("{json}")).expect("a usable solution");
        contrary != json && report(json).failed.is_empty() && !report(contrary).failed.is_empty()
    };
    let stories = all_cases().filter(|case| !case.is_shipped());
    assert!(stories.par_bridge().filter(supposes).count() > 0);
}

#[test]
fn every_line_of_algebra_is_part_of_the_step_it_leads_to() {
    let mut nested = 0;
    for case in cases() {
        let solution = case.solution(Detail::Full);
        let mut ids = Vec::new();
        for (i, step) in solution.steps.iter().enumerate() {
            assert_eq!(step.id, (i + 1).to_string(), "{:?}", case.path);
            ids.push(step.id.clone());
            for (k, inner) in step.substeps.iter().enumerate() {
                assert_eq!(inner.id, format!("{}.{}", step.id, k + 1));
                ids.push(inner.id.clone());
                nested += 1;
            }
        }
        let parts = solution.sections.iter().flat_map(|s| &s.parts);
        for part in parts {
            let solution::Part::Display(lines) = part else {
                continue;
            };
            for step in lines.iter().filter_map(|line| line.step.as_ref()) {
                assert!(ids.contains(step), "{:?} points at step {step}", case.path);
            }
        }
    }
    assert!(nested > 100, "{nested} lines of algebra");
}

#[test]
fn a_tampered_step_is_caught_and_named() {
    let text = fs::read_to_string("derivations/book/falling-stick.json").expect("a scene");
    let scene = scene::read(&text).expect("a valid scene");
    let json = render::steps::solution(&solved(&scene, Detail::Full), &text, &[]);
    let count = json["steps"].as_array().map_or(0, Vec::len);
    assert!(count > 10);
    for i in 0..count {
        for list in ["before", "after", "near"] {
            let claims = json["steps"][i][list].as_array().map_or(0, Vec::len);
            for k in 0..claims {
                let mut tampered = json.clone();
                let side = &mut tampered["steps"][i][list][k]["right"];
                *side = format!("1 + ({})", side.as_str().expect("a formula")).into();
                let report = check::check(&tampered.to_string()).expect("a usable solution");
                let id = json["steps"][i]["id"].as_str().expect("an id");
                // What a name stands for is caught where the name is used.
                if json["steps"][i]["defines"].is_string() {
                    assert!(!report.failed.is_empty(), "step {id}, {list} {k}");
                    continue;
                }
                assert!(!report.failed.is_empty(), "step {id}, {list} {k}");
                assert!(report.failed.iter().all(|f| f.step == id));
            }
        }
    }
}

/// The claims of a list of steps and of their substeps, each with the id of its step.
fn claims<'a>(
    steps: &'a mut serde_json::Value,
    out: &mut Vec<(String, &'a mut serde_json::Value)>,
) {
    for step in steps.as_array_mut().into_iter().flatten() {
        let id = step["id"].as_str().expect("an id").to_string();
        for (key, value) in step.as_object_mut().expect("a step") {
            match key.as_str() {
                "before" | "after" => {
                    let list = value.as_array_mut().into_iter().flatten();
                    out.extend(list.map(|claim| (id.clone(), claim)));
                }
                "substeps" => claims(value, out),
                _ => {}
            }
        }
    }
}

#[test]
fn a_claim_typeset_as_another_is_caught_and_named() {
    let mut caught = 0;
    for case in cases().iter().step_by(6) {
        let json = render::steps::solution(case.solution(Detail::Normal), &case.text, &[]);
        let mut all = json.clone();
        let mut found = Vec::new();
        claims(&mut all["steps"], &mut found);
        let originals: Vec<String> = found
            .iter()
            .map(|(_, claim)| claim["latex"].as_str().expect("LaTeX").to_string())
            .collect();
        for (i, (id, _)) in found.iter().enumerate().step_by(9) {
            let own = &originals[i];
            let other = originals.iter().find(|l| *l != own).expect("another claim");
            let turned = match own.split_once(" = ") {
                Some((left, right)) => format!("{left} = -({right}) + 1"),
                None => unreachable!("a claim is an equation"),
            };
            for latex in [
                turned,
                other.clone(),
                own.replacen("= ", "= 2 ", 1) + " + 1",
                "x".into(),
                String::new(),
            ] {
                let mut tampered = json.clone();
                let mut all = Vec::new();
                claims(&mut tampered["steps"], &mut all);
                all[i].1["latex"] = latex.clone().into();
                let report = check::check(&tampered.to_string()).expect("a usable solution");
                let named = report.failed.iter().any(|f| f.step == *id);
                assert!(
                    named,
                    "{:?}, step {id}: {latex} in place of {own}",
                    case.path
                );
                caught += 1;
            }
        }
    }
    assert!(caught > 60, "{caught} tampered claims");
}

#[test]
fn a_tampered_step_of_a_story_is_caught_and_so_is_another_motion_handed_on() {
    for name in ["acrobat-to-handstand", "crude-see-saw"] {
        let text = fs::read_to_string(format!("derivations/problems/{name}.json"));
        let text = text.expect("a scene");
        let scene = scene::read(&text).expect("a valid scene");
        let json = render::steps::solution(&solved(&scene, Detail::Normal), &text, &[]);
        let failed = |json: &serde_json::Value| {
            let report = check::check(&json.to_string()).expect("a usable solution");
            let mut steps: Vec<String> = report.failed.into_iter().map(|f| f.step).collect();
            steps.dedup();
            steps
        };
        for i in 0..json["steps"].as_array().map_or(0, Vec::len) {
            let mut tampered = json.clone();
            let side = &mut tampered["steps"][i]["after"][0]["right"];
            *side = format!("1 + ({})", side.as_str().expect("a formula")).into();
            // The name of a threshold means what its step defines, and nothing else knows it.
            if json["steps"][i]["defines"].is_string() {
                continue;
            }
            let id = json["steps"][i]["id"].as_str().expect("an id");
            assert_eq!(failed(&tampered), [id], "{name}");
        }
        let mut tampered = json.clone();
        let symbol = tampered["impacts"][0]["handed"].as_object();
        let symbol = symbol.and_then(|h| h.keys().next()).cloned();
        let value = &mut tampered["impacts"][0]["handed"][symbol.expect("a speed")];
        *value = format!("2*({})", value.as_str().expect("a formula")).into();
        assert!(!failed(&tampered).is_empty(), "{name}");
    }
}

#[test]
fn words_of_a_scene_are_never_obeyed() {
    let text = fs::read_to_string("derivations/book/falling-stick.json").expect("a scene");
    let mut scene = scene::read(&text).expect("a valid scene");
    for hostile in [
        "<script>alert(1)</script>",
        "\\input{/etc/passwd} $x$ %",
        "\"'><img src=x onerror=alert(1)>",
        "![x](http://a.b/c) `code` \u{202e}abc",
    ] {
        scene.title = hostile.to_string();
        scene.source = hostile.to_string();
        scene.statement = hostile.to_string();
        scene.parameters[0].meaning = hostile.to_string();
        scene.parameters[0].latex = Some(hostile.to_string());
        let s = solved(&scene, Detail::Normal);
        let page = render::html::page(&s, &[]);
        assert!(
            !page.contains("<script") && !page.contains("<img"),
            "{page}"
        );
        let tex = render::latex_document::document(&s, &[]);
        assert!(!tex.contains("\\input"), "{tex}");
        let markdown = render::markdown::solution(&s, &[]);
        assert!(!markdown.contains("<script") && !markdown.contains("<img"));
        assert!(!markdown.contains("http://") && !markdown.contains("\\input{"));
        for written in [page, tex, markdown, render::plain::solution(&s)] {
            assert!(!written.contains('\u{202e}'));
        }
    }
}

#[test]
fn the_page_needs_no_script_and_no_network() {
    for case in cases() {
        let page = render::html::page(case.solution(Detail::Normal), &[]);
        let own = page.replace("src:url(data:font/woff2;base64,", "");
        for part in ["<script", "src=", "@import", "url(", "http://", "https://"] {
            assert!(!own.contains(part), "{}: {part}", case.path.display());
        }
    }
}

#[test]
fn the_latex_document_compiles() {
    if Command::new("pdflatex").arg("--version").output().is_err() {
        println!("skipped: no LaTeX");
        return;
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("latex");
    fs::create_dir_all(&folder).expect("a folder");
    for case in cases() {
        let file = folder.join("solution.tex");
        let held: Vec<_> = pictures(case).into_iter().map(held).collect();
        let text = render::latex_document::document(case.solution(Detail::Normal), &held);
        fs::write(&file, text).expect("a writable folder");
        let run = Command::new("pdflatex")
            .args([
                "-interaction=nonstopmode",
                "-halt-on-error",
                "-no-shell-escape",
                "solution.tex",
            ])
            .current_dir(&folder)
            .output()
            .expect("pdflatex runs");
        assert!(
            run.status.success(),
            "{}: {}",
            case.path.display(),
            String::from_utf8_lossy(&run.stdout)
        );
    }
}

#[test]
fn an_output_that_cannot_be_written_is_one_message_and_leaves_nothing() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("nowhere")
        .join("deeper");
    let run = Command::new(env!("CARGO_BIN_EXE_carom"))
        .args([
            "solution",
            "derivations/book/falling-stick.json",
            "--format",
            "html",
            "-o",
        ])
        .arg(folder.join("page.html"))
        .output()
        .expect("carom runs");
    assert_eq!(run.status.code(), Some(74));
    assert!(run.stdout.is_empty());
    assert_eq!(
        String::from_utf8_lossy(&run.stderr).trim().lines().count(),
        1
    );
    assert!(!folder.exists());
}

/// Runs the program in an empty folder; gives its exit status, what it said, and the files it left.
fn run_in(name: &str, arguments: &[&str]) -> (Option<i32>, String, Vec<String>) {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder");
    let scene = fs::canonicalize("derivations/book/ball-hits-bat.json").expect("a scene");
    let run = Command::new(env!("CARGO_BIN_EXE_carom"))
        .arg("solution")
        .arg(scene)
        .args(arguments)
        .current_dir(&folder)
        .output()
        .expect("carom runs");
    let mut files: Vec<String> = fs::read_dir(&folder)
        .expect("a folder")
        .map(|e| e.expect("an entry").file_name().to_string_lossy().into())
        .collect();
    files.sort();
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    (run.status.code(), said, files)
}

#[test]
fn bad_arguments_are_one_message_and_leave_no_file() {
    for (name, arguments, said) in [
        ("format", &["--format", "docx", "-o", "x.docx"][..], "docx"),
        (
            "html-figures",
            &["--format", "html", "--figures", "-o", "x.html"],
            "links no files",
        ),
        (
            "no-output",
            &["--format", "markdown", "--figures"],
            "--output",
        ),
        ("no-format", &["-o", "x.doc"], "does not tell a format"),
        ("pdf", &["--format", "pdf"], "a file is needed"),
        (
            "set",
            &["--set", "w=2", "-o", "x.md"],
            "there is no parameter `w`",
        ),
        (
            "folder",
            &["--format", "text", "-o", "."],
            "cannot be written",
        ),
        (
            "nowhere",
            &["--figures", "--format", "markdown", "-o", "no/x.md"],
            "cannot be written",
        ),
    ] {
        let (status, message, files) = run_in(name, arguments);
        let expected = if said == "cannot be written" { 74 } else { 2 };
        assert_eq!(status, Some(expected), "{name}: {message}");
        assert!(message.contains(said), "{name}: {message}");
        assert!(files.is_empty(), "{name}: {files:?}");
    }
}

#[test]
fn in_a_document_each_figure_has_its_caption_and_no_other() {
    let page = Path::new(env!("CARGO_TARGET_TMPDIR")).join("in-a-document.md");
    let scene = "derivations/book/falling-stick.json";
    let status = Command::new(env!("CARGO_BIN_EXE_carom"))
        .args(["solution", scene, "--figures", "-o"])
        .arg(&page)
        .status();
    assert!(status.is_ok_and(|s| s.success()));
    let text = fs::read_to_string(page).expect("a page");
    let paragraphs: Vec<&str> = text.split("\n\n").collect();
    let figures = paragraphs.iter().filter(|p| p.starts_with("!["));
    let mut count = 0;
    for figure in figures {
        // Alone in its paragraph, a picture gets a second caption from Pandoc.
        let (picture, caption) = figure.split_once("\\\n").expect("a caption below");
        assert!(picture.ends_with(".svg)"), "{picture}");
        assert!(
            caption.starts_with('*') && caption.ends_with(".*"),
            "{caption}"
        );
        count += 1;
    }
    assert_eq!(count, 3);
}

#[test]
fn the_figures_of_the_readme_are_those_that_are_drawn() {
    let readme = fs::read_to_string("README.md").expect("the README");
    for (command, name) in [
        ("draw", "book/falling-stick"),
        ("compare", "friction/rod-turns-its-slip-round"),
    ] {
        let drawn = Path::new(env!("CARGO_TARGET_TMPDIR")).join("of-the-readme.svg");
        let shipped = format!("derivations/{name}.svg");
        let status = Command::new(env!("CARGO_BIN_EXE_carom"))
            .args([command, &format!("derivations/{name}.json"), "-o"])
            .arg(&drawn)
            .stdout(std::process::Stdio::null())
            .status();
        assert!(status.is_ok_and(|s| s.success()));
        if std::env::var_os("UPDATE").is_some() {
            fs::copy(&drawn, &shipped).expect("a writable folder");
        }
        let read = |path: &Path| fs::read_to_string(path).expect("a figure");
        assert_eq!(read(&drawn), read(Path::new(&shipped)), "{name}");
        assert!(readme.contains(&format!("src=\"{shipped}\"")), "{name}");
    }
}

#[test]
fn the_name_of_the_output_tells_the_format() {
    for (file, begins) in [
        ("x.html", "<!DOCTYPE html>"),
        ("x.md", "# Ball hits the bat"),
        ("x.tex", "\\documentclass"),
        ("x.json", "{"),
        ("x.txt", "Ball hits the bat"),
    ] {
        let folder = format!("by-name-{}", file.replace('.', "-"));
        let (status, message, files) = run_in(&folder, &["-o", file]);
        assert_eq!(
            (status, files),
            (Some(0), vec![file.to_string()]),
            "{message}"
        );
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(&folder);
        let text = fs::read_to_string(path.join(file)).expect("a file");
        assert!(text.starts_with(begins), "{file}: {}", &text[..60]);
    }
    let (status, message, files) = run_in("by-name-pdf", &["-o", "x.pdf"]);
    let installed = |program| Command::new(program).arg("--version").output().is_ok();
    if installed("lualatex") || installed("tectonic") {
        assert_eq!((status, files.len()), (Some(0), 1), "{message}");
    } else {
        assert_eq!((status, files.len()), (Some(2), 0));
        assert!(message.contains("neither is installed"), "{message}");
    }
}

/// Every picture of a case, as its page and its document hold it.
fn pictures(case: &Case) -> Vec<figure::Drawing> {
    let chapters = case.worked.chapters();
    let each = chapters
        .iter()
        .flat_map(|(name, c)| figure::chapter(name, c));
    each.map(|d| d.0).collect()
}

#[test]
fn every_picture_shows_what_its_stage_does() {
    for case in cases() {
        for drawing in pictures(case) {
            let words = figure::plain(&drawing.caption);
            let empty = ["Not drawn", "have no solution"];
            let is_drawn = !empty
                .iter()
                .any(|w| drawing.svg.contains(w) || words.contains(w));
            assert!(is_drawn, "{}: {words}", case.path.display());
        }
    }
}

#[test]
fn what_swings_on_somewhere_hides_no_later_motion() {
    for name in [
        "rod-falls-and-drives-a-block-into-a-spring",
        "block-driven-into-another-drops",
    ] {
        let path = format!("tests/stories/scenes/{name}.json");
        let text = fs::read_to_string(path).expect("a scene");
        let worked = worked::out(&scene::read(&text).expect("a scene")).expect("an answer");
        for (stage, chapter) in worked.chapters() {
            for (drawing, _) in figure::chapter(&stage, &chapter) {
                assert!(!drawing.svg.contains("Not drawn"), "{name}: {stage}");
            }
        }
    }
}

#[test]
fn an_impact_that_friction_leaves_open_is_drawn_in_its_first_case() {
    let mut drawn = 0;
    for case in all_cases() {
        let scene = scene::read(&case.text).expect("a scene");
        let unsettled =
            scene.friction().is_some() && carom::verify::friction::settled(&scene).is_err();
        if scene.has_stages() || !unsettled {
            continue;
        }
        let first = worked::first_case(&scene).expect("a case");
        let more = first.domains.relations.len() > scene.domains.relations.len();
        let words = figure::draw(&first, figure::Which::All).alternative;
        assert!(
            more && !words.contains("leave part of the motion open"),
            "{}: {words}",
            case.path.display()
        );
        drawn += 1;
    }
    assert!(drawn > 2, "{drawn} scenes");
}

fn held(drawing: figure::Drawing) -> render::html::Picture {
    render::html::Picture {
        slot: solution::Slot::Before,
        tikz: drawing.tikz(),
        svg: drawing.svg,
        caption: drawing.caption,
        alternative: drawing.alternative,
    }
}

#[test]
fn every_character_of_every_format_has_a_glyph() {
    // What the embedded font holds; `fonts/` says how it was made.
    let signs = "−×·±≠≤≥≈→⇒∞√′|()[]{}+=<>,./^¯~˙¨ıȷℓ";
    let in_font = |c: char| {
        c.is_ascii_alphanumeric()
            || signs.contains(c)
            || ('α'..='ω').contains(&c)
            || ('Α'..='Ω').contains(&c)
            || "ϕϑϵ \u{2061}".contains(c)
    };
    for case in all_cases() {
        let name = case.path.display();
        let solution = case.solution(Detail::Full);
        let held: Vec<_> = pictures(case).into_iter().map(held).collect();
        let tex = render::latex_document::document(solution, &held);
        assert!(!tex.contains("[U+") && !tex.contains("\\square"), "{name}");
        let odd: Vec<char> = tex.chars().filter(|c| u32::from(*c) > 0x17f).collect();
        assert!(odd.is_empty(), "{name}: {odd:?}");
        let page = render::html::page(solution, &held);
        for formula in page.split("<math").skip(1) {
            let formula = formula.split("</math>").next().unwrap_or_default();
            let formula = formula.replace("&lt;", "<").replace("&gt;", ">");
            let formula = formula.replace("&#x2061;", "").replace("&#39;", "'");
            let mut inside = false;
            for c in formula.chars().skip_while(|c| *c != '>') {
                match c {
                    '<' => inside = true,
                    '>' => inside = false,
                    c if inside || c.is_whitespace() => {}
                    c => assert!(in_font(c), "{name}: {c:?} in {formula}"),
                }
            }
        }
    }
}

#[test]
fn every_picture_says_in_words_what_it_shows() {
    for case in cases() {
        for drawing in pictures(case) {
            let words = drawing.alternative.split_whitespace().count();
            assert!(
                words >= 5,
                "{}: {}",
                case.path.display(),
                drawing.alternative
            );
            assert!(
                drawing.svg.contains("<desc>") && drawing.tikz().contains("\\begin{tikzpicture}")
            );
        }
    }
}

/// Words of the running text, each formula in it a word, and displayed lines.
fn length(solution: &Solution) -> (usize, usize) {
    let (mut words, mut lines) = (0, 0);
    let mut count = |text: &[solution::Inline]| {
        for piece in text {
            words += match piece {
                solution::Inline::Text(text) => text
                    .split_whitespace()
                    .filter(|w| w.contains(char::is_alphanumeric))
                    .count(),
                solution::Inline::Math(_) => 1,
            };
        }
    };
    for section in &solution.sections {
        count(&section.heading);
        for part in &section.parts {
            match part {
                solution::Part::Text(text) => count(text),
                solution::Part::List(items) => items.iter().for_each(|i| count(i)),
                solution::Part::Display(all) | solution::Part::Result(all) => lines += all.len(),
                solution::Part::Matrix(_) => lines += 1,
                solution::Part::Figure(_) => {}
            }
        }
    }
    (words, lines)
}

#[test]
fn no_solution_is_much_longer_than_the_books() {
    let table = fs::read_to_string("tests/solutions/length.tsv").expect("a table");
    let mut rows = 0;
    let mut faults = Vec::new();
    for row in table.lines().filter(|l| !l.starts_with('#')) {
        let cells: Vec<&str> = row.split('\t').collect();
        let [scene, words, lines, beyond, _] = cells.as_slice() else {
            panic!("{row}");
        };
        let number = |text: &str| text.parse::<usize>().expect("a count");
        let case = cases()
            .iter()
            .find(|c| c.path.ends_with(format!("book/{scene}.json")));
        // What the scene asks beyond the sample is not compared.
        let mut asked = case.expect("shipped").scene.clone();
        let beyond: Vec<&str> = beyond.split(' ').collect();
        asked
            .questions
            .retain(|q| !beyond.contains(&q.name.as_str()));
        let found = length(&solved(&asked, Detail::Normal));
        let most = (number(words) * 3 / 2, number(lines) * 3 / 2);
        println!("{scene}: {found:?} of {most:?}");
        if found.0 > most.0 || found.1 > most.1 {
            faults.push(format!("{scene}: {found:?}, at most {most:?}"));
        }
        rows += 1;
    }
    assert_eq!(rows, 4);
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Scenes of one impact: their solutions are written by one writer.
fn single() -> impl Iterator<Item = &'static Case> {
    cases().iter().filter(|c| !c.scene.has_stages())
}

#[test]
fn no_equation_stands_twice() {
    let mut faults = Vec::new();
    for case in all_cases() {
        let solution = case.solution(Detail::Normal);
        let mut seen = Vec::new();
        // What is to be shown states its equation again, and an approximation may be that of a lower order.
        let shows = |s: &&solution::Section| !matches!(s.heading.first(), Some(solution::Inline::Text(t)) if t.starts_with("To show"));
        for section in solution.sections.iter().filter(shows) {
            // Stages and their cases have motions, and so kinetic energies, of their own.
            let case_of = |h: &solution::Inline| matches!(h, solution::Inline::Text(t) if t.starts_with("Case "));
            if case.scene.has_stages()
                && (section.depth == 0 || section.heading.first().is_some_and(case_of))
            {
                seen.clear();
            }
            for part in &section.parts {
                // So has each case of what is asked beyond them.
                if !case.is_shipped()
                    && matches!(part, solution::Part::Text(text) if words(text).starts_with("Given that"))
                {
                    seen.clear();
                }
                let (solution::Part::Display(lines) | solution::Part::Result(lines)) = part else {
                    continue;
                };
                for line in lines {
                    let text = render::math::latex(solution, &line.math);
                    if text.contains("\\approx") {
                        continue;
                    }
                    let text = text.replace("\\Rightarrow\\quad ", "");
                    if seen.contains(&text) {
                        faults.push(format!("{}: {text}", case.path.display()));
                    }
                    seen.push(text);
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn no_line_says_the_same_on_both_sides() {
    let mut faults = Vec::new();
    for case in all_cases() {
        let solution = case.solution(Detail::Normal);
        for (_, line) in solution.sections.iter().flat_map(lines) {
            let sides = line.math.split(|m| *m == solution::Math::Op("="));
            let sides: Vec<String> = sides.map(|m| render::math::latex(solution, m)).collect();
            let twice = sides.windows(2).any(|pair| pair[0] == pair[1]);
            faults.extend(twice.then(|| format!("{}: {}", case.path.display(), sides.join(" = "))));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Left side minus right side of a displayed `left = right`, at some values of all its symbols.
fn gap(line: &solution::Line) -> Option<[f64; 3]> {
    let [
        solution::Math::Expr(left),
        solution::Math::Op("="),
        solution::Math::Expr(right),
    ] = line.math.as_slice()
    else {
        return None;
    };
    let gap = left - right;
    let at = |k: usize| {
        let mut point = carom::expr::Point::<f64>::default();
        for name in gap.symbols() {
            let bytes = name
                .bytes()
                .fold(7 + k, |h, b| (31 * h + usize::from(b)) % 9973);
            point.values.insert(name, 0.3 + bytes as f64 / 9973.0);
        }
        gap.evaluate(&point)
    };
    Some([at(0)?, at(1)?, at(2)?])
}

#[test]
fn no_equation_is_told_again_rearranged() {
    let mut faults = Vec::new();
    for case in all_cases() {
        let solution = case.solution(Detail::Normal);
        for section in &solution.sections {
            let displayed = section.parts.iter().filter_map(|part| match part {
                solution::Part::Display(lines) => Some(lines),
                _ => None,
            });
            let all: Vec<_> = displayed.flatten().collect();
            for pair in all.windows(2) {
                let (Some(a), Some(b)) = (gap(pair[0]), gap(pair[1])) else {
                    continue;
                };
                let same = |sign: f64| {
                    let close = |x: f64, y: f64| (x - sign * y).abs() <= 1e-9 * x.abs().max(1e-9);
                    a.iter().zip(&b).all(|(x, y)| close(*x, *y))
                };
                if same(1.0) || same(-1.0) {
                    let text = render::math::latex(solution, &pair[1].math);
                    faults.push(format!("{}: {text}", case.path.display()));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Names that the words of a solution set as formulas, and those that its displayed lines hold.
fn formulas(math: &[solution::Math], out: &mut Vec<String>) {
    for m in math {
        match m {
            solution::Math::Expr(e) | solution::Math::Factor(e) | solution::Math::Along(e) => {
                out.extend(e.symbols().iter().map(ToString::to_string));
            }
            solution::Math::Vector(v) => {
                let all = v.iter().flat_map(carom::expr::Expr::symbols);
                out.extend(all.map(|s| s.to_string()));
            }
            solution::Math::Brackets(inner) => formulas(inner, out),
            _ => {}
        }
    }
}

#[test]
fn what_is_given_is_told_before_it_is_used() {
    let mut faults = Vec::new();
    for case in cases() {
        let solution = case.solution(Detail::Normal);
        let mut told: Vec<String> = Vec::new();
        for part in solution.sections.iter().flat_map(|s| &s.parts) {
            match part {
                solution::Part::Text(text) => {
                    for piece in text {
                        if let solution::Inline::Math(math) = piece {
                            formulas(math, &mut told);
                        }
                    }
                }
                solution::Part::Display(lines) | solution::Part::Result(lines) => {
                    for line in lines {
                        let mut used = Vec::new();
                        formulas(&line.math, &mut used);
                        let is_given =
                            |n: &String| case.scene.parameters.iter().any(|p| *p.name == **n);
                        for name in used.into_iter().filter(is_given) {
                            if !told.contains(&name) {
                                faults.push(format!("{}: {name}", case.path.display()));
                                told.push(name);
                            }
                        }
                    }
                }
                _ => {}
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn a_brief_solution_tells_what_a_stage_hands_on() {
    let mut seen = 0;
    for case in cases() {
        let solution = case.solution(Detail::Brief);
        // What is asked for stands by its name already.
        let is_asked = |name: &str| case.scene.questions.iter().any(|q| q.name == name);
        let handed = solution.scopes.iter().flat_map(|scope| scope.handed.keys());
        for name in handed.filter(|name| !is_asked(name)) {
            let mut told: Vec<String> = Vec::new();
            for part in solution.sections.iter().flat_map(|s| &s.parts) {
                match part {
                    solution::Part::Text(text) => {
                        for piece in text {
                            if let solution::Inline::Math(math) = piece {
                                formulas(math, &mut told);
                            }
                        }
                    }
                    solution::Part::Display(lines) | solution::Part::Result(lines) => {
                        for line in lines {
                            let mut used = Vec::new();
                            formulas(&line.math, &mut used);
                            let first = used.first().is_some_and(|n| **n == **name);
                            let is_used = used.iter().any(|n| **n == **name);
                            let stands = first || told.iter().any(|n| **n == **name);
                            assert!(!is_used || stands, "{}: {name}", case.path.display());
                            told.extend(used);
                            seen += usize::from(is_used);
                        }
                    }
                    _ => {}
                }
            }
        }
    }
    assert!(seen > 10, "{seen} lines");
}

#[test]
fn points_with_names_in_words_have_their_articles_and_one_check_is_told() {
    let mut faults = Vec::new();
    for case in all_cases() {
        let text = render::plain::solution(case.solution(Detail::Normal));
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        let story = case.scene.stages.iter();
        let scenes = story.map(|s| &s.scene).chain([&case.scene]);
        for scene in scenes {
            let contacts = scene.contacts.iter().map(|c| &c.name);
            let hinges = scene.hinges.iter().map(|h| &h.name);
            let blows = scene.blows.iter().map(|b| &b.name);
            let words = contacts
                .chain(hinges)
                .chain(blows)
                .filter(|name| name.len() > 2 && name.chars().all(|c| c.is_ascii_lowercase()));
            for word in words {
                for lead in ["at", "about"] {
                    for end in [' ', '.', ',', ':'] {
                        if text.contains(&format!(" {lead} {word}{end}")) {
                            faults.push(format!("{}: {lead} {word}", case.path.display()));
                        }
                    }
                }
            }
        }
        if text.matches("Check: ").count() > 1 {
            faults.push(format!("{}: checked more than once", case.path.display()));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn a_solution_keeps_to_four_hundred_words_a_stage() {
    let mut faults = Vec::new();
    for case in all_cases() {
        let solution = case.solution(Detail::Normal);
        let stages = case.scene.stages.len().max(1);
        // An impact with several outcomes is told once for each.
        let stages = stages.max(solution.scopes.len());
        let (words, lines) = length(solution);
        println!(
            "{}: {words} words, {lines} lines, {stages} stages",
            case.path.display()
        );
        if words > 400 * stages {
            faults.push(format!(
                "{}: {words} words in {stages} stages",
                case.path.display()
            ));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn no_abbreviation_is_used_before_it_is_told() {
    for case in single() {
        let solution = case.solution(Detail::Normal);
        let mut told: Vec<String> = Vec::new();
        for part in solution.sections.iter().flat_map(|s| &s.parts) {
            let (solution::Part::Display(lines) | solution::Part::Result(lines)) = part else {
                continue;
            };
            for line in lines {
                let mut used = Vec::new();
                formulas(&line.math, &mut used);
                for pair in line.math.windows(2) {
                    // A letter for a root is told by its square, an angle by its tangent, an effective mass by its inverse.
                    let letter = |e: &carom::expr::Expr| match e.node() {
                        carom::expr::Node::Power(base, _)
                            if *e == base.powi(2) || *e == base.powi(-1) =>
                        {
                            base.clone()
                        }
                        carom::expr::Node::Call(_, angle) if *e == angle.tan() => angle.clone(),
                        _ => e.clone(),
                    };
                    if let [solution::Math::Expr(e), solution::Math::Op("=")] = pair
                        && let Some(name) = letter(e).as_symbol()
                    {
                        told.push(name.to_string());
                    }
                }
                for name in used {
                    let meaning = solution.meanings.get(name.as_str());
                    assert!(
                        meaning != Some(&solution::Meaning::Defined) || told.contains(&name),
                        "{}: {name} is used before it is told",
                        case.path.display()
                    );
                }
            }
        }
    }
}

#[test]
fn every_answer_stands_under_its_name_however_much_is_told() {
    let mut faults = Vec::new();
    for (case, detail) in all_cases()
        .flat_map(|case| [Detail::Brief, Detail::Normal, Detail::Full].map(|d| (case, d)))
    {
        let solution = case.solution(detail);
        let lines = solution.sections.iter().flat_map(lines);
        let stands: Vec<carom::expr::Expr> = lines
            .flat_map(|(_, line)| line.math.iter().filter_map(symbol))
            .collect();
        // A limit and what stands for an answer nearby are told of that answer.
        let is_near = |a: &carom::answer::Answer| {
            let mut questions = case.scene.questions.iter();
            questions.any(|q| {
                q.name == a.question
                    && matches!(
                        q.ask,
                        scene::Ask::Limit { .. } | scene::Ask::Approximate { .. }
                    )
            })
        };
        // Along a coordinate a speed is all of the velocity: its components are told with it.
        let is_in_speed = |a: &carom::answer::Answer| {
            let speed = |q: &scene::Question| a.question == format!("{}_velocity", q.name);
            let mut parts = case.worked.told.answers.iter();
            case.scene.questions.iter().any(speed)
                && parts
                    .any(|b| b.question == a.question && b.formula().is_some_and(|f| f.is_zero()))
        };
        let of_value = |a: &&carom::answer::Answer| {
            a.formula().is_some() && a.range.is_empty() && !is_near(a) && !is_in_speed(a)
        };
        for answer in case.worked.told.answers.iter().filter(of_value) {
            // Within a case the name has no number.
            let numbered = answer.name.rsplit_once("_case");
            let plain = numbered.map_or(answer.name.as_str(), |(plain, _)| plain);
            let named = |name: &str| stands.contains(&carom::expr::Expr::symbol(name));
            if !named(&answer.name) && !named(plain) {
                faults.push(format!(
                    "{}, {detail:?}: {}",
                    case.path.display(),
                    answer.name
                ));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// The symbols that a sentence takes `from above`.
fn from_above(text: &[solution::Inline]) -> Vec<&carom::expr::Expr> {
    let symbols = text.iter().filter_map(|piece| match piece {
        solution::Inline::Math(math) => match math.as_slice() {
            [solution::Math::Expr(e)] => Some(e),
            _ => None,
        },
        _ => None,
    });
    match words(text).starts_with("With ") && words(text).ends_with(" from above,") {
        true => symbols.collect(),
        false => Vec::new(),
    }
}

/// The symbol that a piece of a formula is, as it is or with the opposite sign.
fn symbol(math: &solution::Math) -> Option<carom::expr::Expr> {
    match math {
        solution::Math::Expr(e) if e.as_symbol().is_some() => Some(e.clone()),
        solution::Math::Expr(e) if (-e).as_symbol().is_some() => Some(-e),
        _ => None,
    }
}

#[test]
fn what_is_taken_from_above_has_its_value_above() {
    let (mut faults, mut taken) = (Vec::new(), 0);
    for case in all_cases() {
        let mut valued: Vec<carom::expr::Expr> = Vec::new();
        for section in &case.solution(Detail::Normal).sections {
            // What an earlier stage or case gives is not above, unless its equations are referred to.
            let heads = |text: &str| matches!(section.heading.first(), Some(solution::Inline::Text(t)) if t.starts_with(text));
            let refers = section.parts.iter().any(|part| matches!(part, solution::Part::Text(text) if words(text).starts_with("The equations are those of")));
            let begins = section.depth == 0 && case.scene.has_stages() || heads("Case ");
            if begins && !refers {
                valued.clear();
            }
            for part in &section.parts {
                let lines = match part {
                    solution::Part::Text(text) => {
                        taken += from_above(text).len();
                        let missing = from_above(text).into_iter().filter(|e| !valued.contains(e));
                        faults.extend(missing.map(|e| format!("{}: {e:?}", case.path.display())));
                        let math = text.iter().filter_map(|piece| match piece {
                            solution::Inline::Math(math) if math.len() > 1 => Some(math),
                            _ => None,
                        });
                        valued.extend(math.flatten().filter_map(symbol));
                        continue;
                    }
                    solution::Part::Display(lines) | solution::Part::Result(lines) => lines,
                    _ => continue,
                };
                for line in lines {
                    // Of `v = v_x = u` both names have the value.
                    valued.extend(line.math.iter().filter_map(symbol));
                }
            }
        }
    }
    assert!(taken > 100, "{taken} values taken from above");
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn no_phrase_that_an_editor_would_strike() {
    // Nor at full length.
    const NEVER: [&str; 9] = [
        "followed in numbers",
        "the loss comes out",
        "along a line",
        "in the normal form",
        "for instance: ",
        "of rank",
        "e = e.",
        "from the first to the last",
        "x ≥ 0",
    ];
    const STRUCK: [&str; 43] = [
        "the component along",
        "it is told that",
        "what is lost is lost",
        "determine the one unknown",
        "not depend on the",
        "of the table of the",
        "of the ground of the",
        "hangs on the values",
        "handed on",
        "put into the laws",
        "with the values found",
        "at that very point",
        "just before, everything is at rest",
        "points separate as fast",
        "the units agree",
        "angles and spins count",
        "is left out",
        "what is left out begins",
        "is the gravity",
        "as the values decide",
        "nothing is lost at the contact",
        "over the vanishing time",
        "and all contacts act",
        "are, as in case",
        "that is determined of",
        "points given by",
        "the force that presses the body",
        "that work is the gain",
        "do not determine it",
        "which is not determined: it",
        "restitution with e =",
        "does not begin to turn",
        "mass at 0;",
        "one after the other they could",
        "value of q",
        "needed for no answer",
        "the impacts hold for",
        "of all that it ties together",
        "differentiated by the time",
        "given is a component",
        "before = after",
        "nothing else acts.",
        " a = 0 ",
    ];
    for case in all_cases() {
        for detail in [Detail::Brief, Detail::Normal, Detail::Full] {
            let text = render::plain::solution(case.solution(detail)).to_lowercase();
            let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
            let struck = STRUCK.iter().filter(|_| detail != Detail::Full);
            // A parameter of this name is no acceleration.
            let named =
                |phrase: &&&str| **phrase == " a = 0 " && case.scene.parameter("a").is_some();
            for phrase in struck.chain(&NEVER).filter(|phrase| !named(phrase)) {
                assert!(!text.contains(phrase), "{}: {phrase}", case.path.display());
            }
        }
    }
}

#[test]
fn a_relation_is_typeset_as_a_whole() {
    let is_relation = |c: char| "<>≤≥".contains(c);
    for case in all_cases() {
        let solution = case.solution(Detail::Normal);
        // The statement is in the words of its author.
        for part in solution.sections.iter().skip(1).flat_map(|s| &s.parts) {
            let solution::Part::Text(text) = part else {
                continue;
            };
            for piece in text {
                if let solution::Inline::Text(words) = piece {
                    let half = words.contains(is_relation);
                    assert!(!half, "{}: {words}", case.path.display());
                }
            }
        }
    }
}

/// Every line of a section, with whether it stands in a box.
fn lines(section: &solution::Section) -> impl Iterator<Item = (bool, &solution::Line)> {
    section.parts.iter().flat_map(|part| {
        let (boxed, lines) = match part {
            solution::Part::Display(lines) => (false, lines.as_slice()),
            solution::Part::Result(lines) => (true, lines.as_slice()),
            _ => (false, &[][..]),
        };
        lines.iter().map(move |line| (boxed, line))
    })
}

/// Left side, sign and right side of a line that is one relation.
fn related(line: &solution::Line) -> Option<(&carom::expr::Expr, &str, &carom::expr::Expr)> {
    use solution::Math::{Expr, Op};
    match line.math.as_slice() {
        [Expr(left), Op(sign), Expr(right)] => Some((left, sign, right)),
        [Expr(left), Op(sign), Expr(_), Op("="), Expr(right)] => Some((left, sign, right)),
        _ => None,
    }
}

/// Whether a relation holds at a point; `None` where it has no value, or lies too near its boundary.
fn holds(
    (left, sign, right): (&carom::expr::Expr, &str, &carom::expr::Expr),
    point: &carom::expr::Point<f64>,
) -> Option<bool> {
    let gap = (left - right).evaluate(point)?;
    let known = gap.is_finite() && gap.abs() > 1e-9;
    known.then_some(matches!(sign, "<" | "≤") == (gap < 0.0))
}

#[test]
fn each_line_of_an_inequality_says_what_the_range_in_its_box_says() {
    let mut compared = 0;
    for case in all_cases() {
        let domains = &case.scene.domains;
        for section in &case.solution(Detail::Normal).sections {
            let all: Vec<_> = lines(section).collect();
            let boxed = all.iter().filter(|(boxed, _)| *boxed).count();
            let Some((true, last)) = all.last().filter(|_| boxed == 1) else {
                continue;
            };
            let Some(range) = related(last).filter(|(_, sign, _)| "<≤≥>".contains(sign)) else {
                continue;
            };
            for (_, line) in &all[..all.len() - 1] {
                let Some(told) = related(line).filter(|(_, sign, _)| "<≤≥>".contains(sign))
                else {
                    continue;
                };
                let formulas = [told.0, told.2, range.0, range.2];
                for sample in domains.points(&formulas, 60) {
                    let point = sample.doubles();
                    if let (Some(a), Some(b)) = (holds(told, &point), holds(range, &point)) {
                        assert_eq!(a, b, "{:?}: {told:?}, {range:?}, {point:?}", case.path);
                        compared += 1;
                    }
                }
            }
        }
    }
    assert!(compared > 500, "{compared}");
}

#[test]
fn what_is_boxed_does_not_stand_above_the_box_as_well() {
    use solution::Math::{Expr, Op};
    for case in all_cases() {
        for section in &case.solution(Detail::Normal).sections {
            let mut values = Vec::new();
            for part in &section.parts {
                // Where a sentence leads to a law of one line, that line is the law.
                if let solution::Part::Display(lines) = part
                    && lines.len() > 1
                {
                    for line in lines {
                        let math = line.math.strip_prefix(&[Op("⇒")]).unwrap_or(&line.math);
                        if let [Expr(name), Op("="), Expr(value)] = math {
                            values.push((name.clone(), value.clone()));
                        }
                    }
                }
            }
            for (_, line) in lines(section).filter(|(boxed, _)| *boxed) {
                if let [Expr(_), Op("="), Expr(name), Op("="), Expr(value)] = line.math.as_slice() {
                    let twice = values.iter().any(|(n, v)| n == name && v == value);
                    assert!(!twice, "{:?}: {name:?} = {value:?}", case.path);
                }
            }
        }
    }
}

#[test]
fn energies_are_told_before_they_are_used() {
    let is_energy = |m: &solution::Math| matches!(m, solution::Math::Name(n) if n.letter == "E" && n.index.starts_with('K'));
    for case in all_cases() {
        let solution = case.solution(Detail::Normal);
        let mut told: Vec<solution::Math> = Vec::new();
        for section in &solution.sections {
            if section.depth == 0 {
                told.clear();
            }
            for (_, line) in lines(section) {
                if line.math.first().is_some_and(is_energy) {
                    told.push(line.math[0].clone());
                }
                for energy in line.math.iter().filter(|m| is_energy(m)) {
                    assert!(told.contains(energy), "{:?}: {energy:?}", case.path);
                }
            }
        }
    }
}

#[test]
fn like_factors_are_gathered_and_nothing_is_times_zero() {
    use carom::expr::Node;
    for case in all_cases() {
        for section in &case.solution(Detail::Normal).sections {
            for m in lines(section).flat_map(|(_, line)| &line.math) {
                let (solution::Math::Expr(e) | solution::Math::Factor(e)) = m else {
                    continue;
                };
                for part in e.parts() {
                    let Node::Product(factors) = part.node() else {
                        continue;
                    };
                    let twice = |(i, f)| factors[..i].contains(f);
                    let gathered = !factors.iter().enumerate().any(twice);
                    let zero = factors.iter().any(carom::expr::Expr::is_zero);
                    assert!(gathered && !zero, "{:?}: {e:?}", case.path);
                }
            }
        }
    }
}

#[test]
fn cases_of_one_impact_share_what_they_have_in_common() {
    for case in all_cases() {
        let mut told: Vec<Vec<Vec<solution::Math>>> = Vec::new();
        for section in &case.solution(Detail::Normal).sections {
            if section.depth == 0 {
                told.clear();
            }
            for parts in section.parts.windows(2) {
                let [solution::Part::Text(lead), solution::Part::Display(lines)] = parts else {
                    continue;
                };
                let lead = match lead.first() {
                    Some(solution::Inline::Text(lead)) => lead.as_str(),
                    _ => "",
                };
                if lead.starts_with("Balance") || lead.starts_with("Take") {
                    let lines: Vec<_> = lines.iter().map(|l| l.math.clone()).collect();
                    assert!(!told.contains(&lines), "{:?}: {lead}", case.path);
                    told.push(lines);
                }
            }
        }
    }
}

#[test]
fn results_in_numbers_name_the_values_they_rest_on() {
    let has_values = |case: &&Case| case.scene.parameters.iter().any(|p| p.value.is_some());
    for case in all_cases().filter(|case| case.is_shipped() || has_values(case)) {
        let text = render::markdown::solution(case.solution(Detail::Normal), &[]);
        let first = text.find("In numbers: ").unwrap_or(usize::MAX);
        // With $v$ = 3 m/s: …
        let named = |line: &str| {
            let is_value = line.starts_with("With $") && line.contains("$ = ");
            is_value || line.starts_with("With the values in brackets")
        };
        let mut lines = text.lines();
        let values = lines.find(|line| named(line));
        let values = values.map(|line| line.as_ptr() as usize - text.as_ptr() as usize);
        assert!(
            values.unwrap_or(usize::MAX) <= first,
            "{}",
            case.path.display()
        );
    }
}

/// The words of a piece of text without its formulas.
fn words(text: &[solution::Inline]) -> String {
    let words = text.iter().map(|piece| match piece {
        solution::Inline::Text(words) => words.as_str(),
        solution::Inline::Math(_) => "…",
    });
    words.collect()
}

#[test]
fn what_has_a_name_goes_by_it_and_is_not_told_again() {
    use solution::{Inline, Math, Part};
    for case in all_cases().filter(|c| c.scene.has_stages()) {
        let mut told: Vec<(carom::expr::Expr, carom::expr::Expr)> = Vec::new();
        for section in &case.solution(Detail::Normal).sections {
            for part in &section.parts {
                if let Part::Text(text) = part
                    && words(text).starts_with("From the stage before, ")
                {
                    for piece in text {
                        let Inline::Math(math) = piece else { continue };
                        let again = told
                            .iter()
                            .any(|(name, _)| math.first() == Some(&Math::Expr(name.clone())));
                        assert!(!again, "{:?}: {math:?} is told again", case.path);
                    }
                }
                let (Part::Display(lines) | Part::Result(lines)) = part else {
                    continue;
                };
                for line in lines {
                    let by_newton = matches!(
                        line.math.as_slice(),
                        [
                            Math::Expr(_),
                            Math::Op("="),
                            Math::Expr(_),
                            Math::Op("="),
                            Math::Expr(_)
                        ]
                    );
                    if let (true, Some(Math::Expr(made)), Part::Result(_)) =
                        (by_newton, line.math.get(2), part)
                    {
                        for e in made.parts() {
                            let named = told.iter().find(|(_, value)| value == e && e.size() >= 6);
                            assert!(named.is_none(), "{:?}: {made:?} holds {named:?}", case.path);
                        }
                    }
                }
                for line in lines {
                    if let (Part::Result(_), Some(Math::Expr(name)), Some(Math::Expr(value))) =
                        (part, line.math.first(), line.math.last())
                    {
                        told.push((name.clone(), value.clone()));
                    }
                }
            }
        }
    }
}

#[test]
fn a_body_of_parts_has_its_center_and_its_inertia_told() {
    let mut seen = 0;
    for case in all_cases() {
        let of_parts = |b: &&scene::Body| {
            matches!(b.shape, scene::Shape::Composite { .. }) && !b.inertia_given
        };
        let count = case.scene.bodies.iter().filter(of_parts).count();
        let text = render::plain::solution(case.solution(Detail::Normal));
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(
            text.matches("have their common center of mass at").count(),
            count,
            "{:?}",
            case.path
        );
        seen += count;
    }
    assert!(seen > 0);
}

#[test]
fn the_speed_at_the_end_of_a_motion_stands_with_the_motion() {
    // What contradicts itself has no motion to stand with.
    let counts = |c: &&Case| c.scene.has_stages() && (c.is_shipped() || c.worked.holds());
    for case in all_cases().filter(counts) {
        let solution = case.solution(Detail::Normal);
        let late = solution
            .sections
            .iter()
            .find(|s| words(&s.heading).starts_with("Speed of "));
        let heading = late.map(|s| words(&s.heading));
        let told = case.worked.told.stages.iter().any(|s| !s.cases.is_empty());
        assert!(heading.is_none() || told, "{:?}: {heading:?}", case.path);
    }
}

#[test]
fn every_case_that_friction_leaves_is_told() {
    let mut several = 0;
    for path in shared::files("derivations", "json") {
        let text = fs::read_to_string(&path).expect("a readable scene");
        let scene = scene::read(&text).expect("a valid scene");
        if scene.has_stages() || scene.friction().is_none() {
            continue;
        }
        let outcomes = carom::verify::friction::outcomes(&scene)
            .expect("outcomes")
            .len();
        let case = cases().iter().find(|c| c.path == path).expect("a solution");
        let solution = case.solution(Detail::Normal);
        let headings = solution.sections.iter().map(|s| words(&s.heading));
        let told = headings.filter(|h| h.starts_with("Case ")).count();
        assert_eq!(
            told,
            if outcomes > 1 { outcomes } else { 0 },
            "{}",
            path.display()
        );
        several += usize::from(outcomes > 1);
    }
    assert!(several > 0);
}

#[test]
fn what_a_teacher_would_say_is_said_and_what_an_editor_would_strike_is_not() {
    let mut faults = Vec::new();
    let mut last = (String::new(), String::new());
    let table = fs::read_to_string("tests/solutions/told.tsv").expect("a table");
    for row in table.lines().skip(1) {
        let [path, words, reason] = *row.split('\t').collect::<Vec<_>>() else {
            panic!("{row}");
        };
        if last.0 != path {
            let worked = shared::worked(Path::new(path)).as_ref();
            let worked = worked.unwrap_or_else(|why| panic!("{path}: {why}"));
            let text = render::plain::solution(&worked.solution(Detail::Normal));
            let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
            last = (path.to_string(), text);
        }
        let (sought, is_there) = match words.strip_prefix("not: ") {
            Some(words) => (words, false),
            None => (words, true),
        };
        if last.1.contains(sought) != is_there {
            faults.push(format!("{path}: {words}: {reason}\n{}", last.1));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn what_follows_from_a_line_stands_in_one_row_with_its_name() {
    let torn = all_cases().flat_map(|case| {
        let text = render::markdown::solution(case.solution(Detail::Normal), &[]);
        let rows = text
            .lines()
            .filter_map(|row| row.rsplit_once("\\Rightarrow\\quad"));
        let has_sign = |row: &str| {
            ["=", "\\l", "\\g", "\\approx"]
                .iter()
                .any(|sign| row.contains(sign))
        };
        let torn = rows.filter(|(_, behind)| !has_sign(behind));
        let name = |(row, behind): (&str, &str)| format!("{}: {row} {behind}", case.path.display());
        torn.map(name).collect::<Vec<_>>()
    });
    let torn: Vec<String> = torn.collect();
    assert!(torn.is_empty(), "{torn:#?}");
}

#[test]
fn a_solution_given_to_the_grader_has_no_wrong_line() {
    let known = fs::read_to_string("tests/solutions/graded.tsv").expect("a table");
    // The textbook's scenes; all others take minutes more.
    let is_long = std::env::var_os("CAROM_CASES").is_some();
    let folders = ["derivations/book", "derivations/problems"];
    let is_quick = |case: &&Case| folders.iter().any(|folder| case.path.starts_with(folder));
    let all: Vec<&Case> = match is_long {
        true => all_cases().collect(),
        false => cases().iter().filter(is_quick).collect(),
    };
    let is_judged = |line: &&str| {
        all.iter()
            .any(|case| line.starts_with(&*case.path.to_string_lossy()))
    };
    let known = known.lines().filter(is_judged).map(str::to_string);
    let known: BTreeSet<String> = known.collect();
    let judged = all.par_iter().flat_map_iter(|case| {
        // Where laws contradict each other nothing is graded.
        let sheet = carom::command::sheet(case.scene.clone()).ok();
        let told = sheet.map(|(sheet, _)| {
            let text = render::markdown::solution(case.solution(Detail::Normal), &[]);
            steps::check(&sheet, &text, &grade::Options::default())
        });
        let lines = told.into_iter().flat_map(|told| told.lines);
        let path = case.path.display();
        lines.map(move |line| (format!("{path}\t{}", line.text), line.status))
    });
    let judged: Vec<(String, Status)> = judged.collect();
    let count = |is: &dyn Fn(&Status) -> bool| judged.iter().filter(|(_, s)| is(s)).count();
    let holds = count(&|s| matches!(s, Status::Holds | Status::Defines));
    assert!(holds > 400, "only {holds} lines are judged");
    let wrong = judged.iter().filter(|(_, status)| *status == Status::Wrong);
    let wrong: BTreeSet<String> = wrong.map(|(line, _)| line.clone()).collect();
    let fresh: Vec<&String> = wrong.difference(&known).collect();
    let mended: Vec<&String> = known.difference(&wrong).collect();
    assert!(
        fresh.is_empty() && mended.is_empty(),
        "called wrong: {fresh:#?}\nno longer called wrong: {mended:#?}"
    );
}

/// Lone lines that give a printed name another value than it has, and that the grader lets pass.
fn misjudged_names(case: &Case) -> Vec<String> {
    let Ok((sheet, _)) = carom::command::sheet(case.scene.clone()) else {
        return Vec::new();
    };
    let derivation = &sheet.derivation;
    let given = &sheet.scene.parameters;
    let answers = derivation.answers.iter().filter_map(|answer| {
        let asked = given.iter().any(|p| *p.name == *answer.name);
        let value = answer
            .formula()
            .filter(|_| !asked && answer.range.is_empty())?;
        Some([&answer.name, &answer.latex].map(|name| (name.clone(), value.clone())))
    });
    let motion = derivation.motion_by_name();
    let motion = motion.map(|(unknown, plain, value)| {
        let names = [
            plain.to_string(),
            derivation.names.latex(unknown).to_string(),
        ];
        names.map(|name| (name, value.clone()))
    });
    let all: BTreeSet<(String, Expr)> = answers.chain(motion).flatten().collect();
    let passed = all.into_iter().filter_map(|(name, value)| {
        let other = match value.is_zero() {
            true => given.first().map_or(Expr::one(), |p| Expr::symbol(&p.name)),
            false => Expr::from(7) * &value,
        };
        let line = format!("{name} = {}", formula::write_plain(&other));
        let told = steps::check(&sheet, &line, &grade::Options::default());
        let status = &told.lines[0].status;
        let passes = matches!(status, Status::Holds | Status::Defines);
        passes.then(|| format!("{}: {line}: {status:?}", case.path.display()))
    });
    passed.collect()
}

#[test]
fn what_a_page_prints_has_its_name_with_the_grader() {
    // Those of the textbook and the one with a name of two letters; all others take minutes more.
    let is_long = std::env::var_os("CAROM_CASES").is_some();
    let folders = ["derivations/book", "derivations/more/rolling"];
    let is_quick = |case: &Case| {
        let path = case.path.to_string_lossy();
        folders.iter().any(|folder| path.starts_with(folder))
    };
    let chosen: Vec<&Case> = match is_long {
        true => all_cases().collect(),
        false => cases().iter().filter(|case| is_quick(case)).collect(),
    };
    let passed = chosen
        .par_iter()
        .flat_map_iter(|case| misjudged_names(case));
    let passed: Vec<String> = passed.collect();
    assert!(passed.is_empty(), "{passed:#?}");
}
