//! `carom site`: scenes, worked solutions, figures and documents as pages to read from a folder, without a server.

use std::path::{Path, PathBuf};

use clap::Args;
use rayon::prelude::*;

use super::solution::pictures;
use super::{Failure, collect, complain, files, refused};
use carom::command;
use carom::render::{html, site};
use carom::scene;
use carom::solution::Detail;
use carom::worked;

/// Arguments of `carom site`.
#[derive(Args)]
pub struct SiteArgs {
    /// Folder with the scenes
    #[arg(default_value = "derivations")]
    folder: PathBuf,
    /// Folder to write the pages into
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
}

/// The documents of a site: file, title, page, text.
const DOCUMENTS: [(&str, &str, &str, &str); 2] = [
    (
        "GRADING.md",
        "How carom grades",
        "grading.html",
        include_str!("../../GRADING.md"),
    ),
    (
        "GUIDE.md",
        "Guide",
        "guide.html",
        include_str!("../../GUIDE.md"),
    ),
];

/// Writes the site; status 1 where a scene has no sound solution.
pub fn run(args: &SiteArgs) -> Result<u8, Failure> {
    let mut scenes = Vec::new();
    collect(&args.folder, &mut scenes).map_err(|e| refused(&args.folder, e))?;
    scenes.sort();
    if scenes.is_empty() {
        let why = "no scenes\nhint: name a folder with scene files (.json), such as derivations";
        return Err(refused(&args.folder, why));
    }
    let pages: Vec<Result<(site::Listed, bool), Failure>> =
        scenes.par_iter().map(|path| page(args, path)).collect();
    let mut listed = Vec::new();
    let mut status = 0;
    for page in pages {
        match page {
            Ok((scene, sound)) => {
                status = status.max(u8::from(!sound));
                listed.push(scene);
            }
            Err(Failure::Input(words)) => {
                complain(&words);
                status = 1;
            }
            Err(other) => return Err(other),
        }
    }
    // The documents speak of the shipped scenes, which may be those of this site.
    let shipped = listed.iter().filter_map(|scene| {
        let name = scene.page.strip_suffix(".html")?;
        Some((format!("derivations/{name}.json"), scene.page.clone()))
    });
    let documents = DOCUMENTS.iter().map(|d| (d.0.into(), d.2.into()));
    let known: Vec<(String, String)> = documents.chain(shipped).collect();
    for (_, title, page, text) in DOCUMENTS {
        let document = site::document(title, text, &known);
        save(&args.output.join(page), &document)?;
    }
    save(&args.output.join("index.html"), &site::index(&listed))?;
    Ok(status)
}

fn save(path: &Path, text: &str) -> Result<(), Failure> {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder)
            .map_err(|e| Failure::Output(format!("{}: {e}", folder.display())))?;
    }
    files::save(path, text.as_bytes(), &[])
}

/// The page of a scene beside a copy of its file, and whether its solution holds.
fn page(args: &SiteArgs, path: &Path) -> Result<(site::Listed, bool), Failure> {
    let text = files::read(path, scene::LONGEST)?;
    let scene = command::scene(&path.display().to_string(), &text, &[]).map_err(Failure::Input)?;
    let below = path.strip_prefix(&args.folder).unwrap_or(path);
    let target = args.output.join(below);
    let name = below.file_name().unwrap_or_default().to_string_lossy();
    let up = "../".repeat(below.components().count() - 1);
    let (above, file) = (site::above(&up), site::source(&name, &text));
    let worked = worked::in_cases(&scene).map_err(|why| refused(path, why))?;
    let pictures = pictures(path, &worked)?;
    let solution = worked.solution(Detail::Normal);
    let html = html::page_among(&solution, &pictures, &above, &file);
    let svg = pictures.first().map(|p| p.svg.clone()).unwrap_or_default();
    save(&target, &text)?;
    save(&target.with_extension("html"), &html)?;
    let folder = below.parent().map(|p| p.display().to_string());
    let folder = folder.filter(|f| !f.is_empty());
    let words: Vec<&str> = [scene.statement.as_str(), &name]
        .into_iter()
        .chain(scene.bodies.iter().map(|b| b.name.as_str()))
        .chain(scene.questions.iter().map(|q| q.name.as_str()))
        .collect();
    let listed = site::Listed {
        page: address(&below.with_extension("html")),
        folder: folder.unwrap_or_else(|| String::from("scenes")),
        title: scene.title.clone(),
        source: scene.source.clone(),
        words: words.join(" "),
        svg,
    };
    Ok((listed, worked.holds()))
}

/// A path as an address; what ends a path there is escaped.
fn address(path: &Path) -> String {
    let path = path.to_string_lossy().replace('\\', "/");
    [("%", "%25"), ("#", "%23"), ("?", "%3F")]
        .iter()
        .fold(path, |path, (mark, code)| path.replace(mark, code))
}
