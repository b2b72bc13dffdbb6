//! `carom solution` and `carom check`: the worked solution of a scene in any format, and the replay of its steps.

use std::path::{Path, PathBuf};
use std::process::Command;

use clap::{Args, ValueEnum};

use super::{Failure, SceneArgs, files, print, read_scene_text, refused};
use carom::figure::{self, Which};
use carom::render::html::Picture;
use carom::solution::{Detail, Slot};
use carom::worked::{self, Worked};
use carom::{answer, check, render, scene::Scene};

/// Arguments of `carom solution`.
#[derive(Args)]
pub struct SolutionArgs {
    #[command(flatten)]
    input: SceneArgs,
    /// Output format, if the name after -o does not tell it; latex is a document that compiles, latex-fragment goes into one of yours
    #[arg(long, value_enum)]
    format: Option<FormatArg>,
    /// How much is shown: the key equations, what a textbook shows, or every line of algebra
    #[arg(long, value_enum, default_value_t = Detail::Normal)]
    detail: Detail,
    /// Write here instead of to standard output; .html, .md, .tex, .pdf, .json and .txt name their formats
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// With -o and markdown, write the figures beside the output and link them; the other formats hold theirs
    #[arg(long, requires = "output")]
    figures: bool,
}

/// Arguments of `carom check`.
#[derive(Args)]
pub struct CheckArgs {
    /// Solution in JSON, as written by `carom solution --format json`; `-` for standard input
    file: PathBuf,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum FormatArg {
    Text,
    Markdown,
    Latex,
    LatexFragment,
    Html,
    Pdf,
    Json,
}

/// Writes the worked solution of a scene.
pub fn run(args: &SolutionArgs) -> Result<u8, Failure> {
    if let Some(output) = &args.output {
        files::writable(output, &[&args.input.scene])?;
    }
    let format = format(args)?;
    let (scene, text) = read_scene_text(&args.input.scene, &args.input.set)?;
    let worked = worked::in_cases(&scene).map_err(|why| refused(&args.input.scene, why))?;
    let solution = &worked.solution(args.detail);
    let drawn = drawn(&args.input.scene, &worked)?;
    let holds = worked.holds();
    let held = || drawn.iter().map(|d| d.0.clone()).collect::<Vec<_>>();
    let linked = match (args.figures, &args.output) {
        (true, Some(path)) if format == FormatArg::Markdown => {
            link(path, &args.input.scene, &drawn)?
        }
        (true, _) if !matches!(format, FormatArg::Latex | FormatArg::LatexFragment) => {
            return Err(Failure::Input(String::from(
                "--figures: this format links no files\nhint: markdown does; pages and LaTeX documents hold their figures",
            )));
        }
        _ => Vec::new(),
    };
    let output = match format {
        FormatArg::Text => render::plain::solution(solution),
        FormatArg::Markdown => render::markdown::solution(solution, &linked),
        FormatArg::Latex => render::latex_document::document(solution, &held()),
        FormatArg::LatexFragment => render::latex_document::fragment(solution, &held()),
        FormatArg::Html => render::html::page(solution, &held()),
        FormatArg::Json => {
            render::pretty(&render::steps::solution(solution, &text, &args.input.set))
        }
        FormatArg::Pdf => {
            let document = render::latex_document::document(solution, &held());
            let path = args.output.as_deref().unwrap_or(Path::new("solution.pdf"));
            files::save(path, &typeset(&document)?, &[&args.input.scene])?;
            return Ok(u8::from(!holds));
        }
    };
    match &args.output {
        Some(path) => files::save(path, output.as_bytes(), &[&args.input.scene])?,
        None => print(&output)?,
    }
    Ok(u8::from(!holds))
}

/// The pictures of a scene, stages and plots included, each with a name for its file.
fn drawn(path: &Path, worked: &Worked) -> Result<Vec<(Picture, String)>, Failure> {
    let graphs = worked.graphs().map_err(|why| refused(path, why))?;
    let mut drawn = Vec::new();
    for (i, (name, chapter)) in worked.chapters().iter().enumerate() {
        for (drawing, which) in figure::chapter(name, chapter) {
            let file = which.map_or_else(|| String::from("motion"), figure::file_name);
            drawn.push(match (which, worked.told.alone()) {
                (Some(which), Some(_)) => (picture(slot(which), drawing), file),
                _ => (
                    picture(Slot::Stage(i), drawing),
                    format!("{}-{file}", i + 1),
                ),
            });
        }
    }
    drawn.extend(plots(&worked.scene, &graphs)?);
    Ok(drawn)
}

/// The pictures of a scene, stages and plots included.
pub fn pictures(path: &Path, worked: &Worked) -> Result<Vec<Picture>, Failure> {
    let drawn = drawn(path, worked)?.into_iter();
    Ok(drawn.map(|(picture, _)| picture).collect())
}

/// The format that is asked for, or that the name of the output tells.
fn format(args: &SolutionArgs) -> Result<FormatArg, Failure> {
    let ending = args.output.as_deref().and_then(Path::extension);
    let ending = ending.map(|e| e.to_string_lossy().to_ascii_lowercase());
    let told = match ending.as_deref() {
        Some("html" | "htm") => Some(FormatArg::Html),
        Some("md" | "markdown") => Some(FormatArg::Markdown),
        Some("tex") => Some(FormatArg::Latex),
        Some("pdf") => Some(FormatArg::Pdf),
        Some("json") => Some(FormatArg::Json),
        Some("txt") => Some(FormatArg::Text),
        _ => None,
    };
    match (args.format, told, &args.output) {
        (Some(FormatArg::Pdf), _, None) => Err(Failure::Input(String::from(
            "--format pdf: a file is needed\nhint: name it with -o, such as -o solution.pdf",
        ))),
        (Some(format), ..) | (None, Some(format), _) => Ok(format),
        (None, None, None) => Ok(FormatArg::Text),
        (None, None, Some(path)) => Err(refused(
            path,
            "the name does not tell a format\nhint: end it with .html, .md, .tex, .pdf, .json or .txt, or say --format",
        )),
    }
}

/// A LaTeX document as PDF, by a typesetter that is installed here.
fn typeset(document: &str) -> Result<Vec<u8>, Failure> {
    let folder = std::env::temp_dir().join(format!("carom-{}", std::process::id()));
    let failed = |e: std::io::Error| refused(&folder, e);
    std::fs::create_dir_all(&folder).map_err(failed)?;
    let made = std::fs::write(folder.join("solution.tex"), document).map_err(failed);
    let made = made.and_then(|()| {
        let luatex = [
            "--interaction=nonstopmode",
            "--halt-on-error",
            "--no-shell-escape",
        ];
        for (program, options) in [("lualatex", &luatex[..]), ("tectonic", &["--untrusted"][..])] {
            let run = Command::new(program)
                .args(options)
                .arg("solution.tex")
                .current_dir(&folder)
                .output();
            match run {
                Err(e) if e.kind() == std::io::ErrorKind::NotFound => continue,
                Err(e) => return Err(Failure::Input(format!("{program}: {e}"))),
                Ok(run) if run.status.success() => {
                    return std::fs::read(folder.join("solution.pdf")).map_err(failed);
                }
                Ok(run) => {
                    let said = String::from_utf8_lossy(&run.stdout).into_owned();
                    let first = said.lines().find(|l| l.starts_with('!')).unwrap_or("");
                    return Err(Failure::Input(format!(
                        "{program} could not set the document {first}\nhint: write it as .tex and see what is wrong"
                    )));
                }
            }
        }
        Err(Failure::Input(String::from(
            "a PDF needs lualatex or tectonic, and neither is installed\nhint: install one of them, or write .tex, .html or .md",
        )))
    });
    let _ = std::fs::remove_dir_all(&folder);
    made
}

/// The plots of a scene, each with a name for its file.
pub fn plots(scene: &Scene, graphs: &[answer::Graph]) -> Result<Vec<(Picture, String)>, Failure> {
    let mut out = Vec::new();
    for (i, graph) in graphs.iter().enumerate() {
        let picture = render::plots::picture(scene, graph)
            .map_err(|fault| Failure::Input(format!("plot `{}`: {fault}", graph.ask.name)))?;
        out.push((picture, format!("plot-{}", i + 1)));
    }
    Ok(out)
}

/// Where a picture stands in the solution of a scene of one impact.
fn slot(which: Which) -> Slot {
    match which {
        Which::Before | Which::During(_) | Which::All => Slot::Before,
        Which::After => Slot::After,
    }
}

fn picture(slot: Slot, drawing: figure::Drawing) -> Picture {
    Picture {
        slot,
        tikz: drawing.tikz(),
        svg: drawing.svg,
        caption: drawing.caption,
        alternative: drawing.alternative,
    }
}

/// Writes pictures beside the output; gives them with the names by which it links them.
fn link(
    output: &Path,
    scene: &Path,
    pictures: &[(Picture, String)],
) -> Result<Vec<(Picture, String)>, Failure> {
    files::writable(output, &[scene])?;
    let stem = output.file_stem().unwrap_or_default().to_string_lossy();
    let mut linked = Vec::new();
    for (picture, name) in pictures {
        let file = output.with_file_name(format!("{stem}-{name}.svg"));
        files::save(&file, picture.svg.as_bytes(), &[scene])?;
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        linked.push((picture.clone(), name.replace(' ', "%20")));
    }
    Ok(linked)
}

/// Replays a solution file.
pub fn check(args: &CheckArgs) -> Result<u8, Failure> {
    let text = files::read(&args.file, check::LONGEST)?;
    let report =
        check::check(&text).map_err(|check::Unusable(message)| refused(&args.file, message))?;
    let mut out = String::new();
    for failure in &report.failed {
        out.push_str(&format!(
            "step {} does not hold: {}\n    {}\n",
            failure.step, failure.claim, failure.why
        ));
    }
    if !report.open.is_empty() {
        let mut steps = report.open.clone();
        steps.dedup();
        out.push_str(&format!(
            "not checked, no value: step {}\n",
            steps.join(", ")
        ));
    }
    let doubles = match report.in_doubles {
        0 => String::new(),
        n => format!(", {n} of them in doubles"),
    };
    let idle = match report.idle {
        0 => String::new(),
        n => format!(", {n} with one formula on both sides say nothing"),
    };
    out.push_str(&format!(
        "{} steps, {} claims hold{doubles}, {} do not{idle}\n",
        report.steps,
        report.held,
        report.failed.len()
    ));
    print(&out)?;
    Ok(match (report.failed.is_empty(), report.open.is_empty()) {
        (false, _) => 1,
        (true, false) => 3,
        (true, true) => 0,
    })
}
