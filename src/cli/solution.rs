//! `carom solution` and `carom check`: the worked solution of a scene in any format, and the replay of its steps.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use super::{Failure, files, pretty, print, read_scene_text};
use carom::figure::{self, Chapter, Which};
use carom::render::html::Picture;
use carom::solution::{self, Detail, Slot};
use carom::{check, derive, render, scene::Scene, story, verify};

/// Arguments of `carom solution`.
#[derive(Args)]
pub struct SolutionArgs {
    /// Scene file, `-` for standard input
    scene: PathBuf,
    /// Output format; latex is a document that compiles, latex-fragment goes into one of yours
    #[arg(long, value_enum, default_value_t = FormatArg::Text)]
    format: FormatArg,
    /// How much is shown: the key equations, what a textbook shows, or every line of algebra
    #[arg(long, value_enum, default_value_t = DetailArg::Normal)]
    detail: DetailArg,
    /// Write here instead of to standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// With -o, write the figures beside the output and link them: SVG for markdown, PNG for latex
    #[arg(long, requires = "output")]
    figures: bool,
    /// Give a parameter a value, such as v=2 or theta=acos(3/5); may be repeated
    #[arg(long = "set", value_name = "NAME=VALUE")]
    set: Vec<String>,
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
    Json,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum DetailArg {
    Brief,
    Normal,
    Full,
}

/// Writes the worked solution of a scene.
pub fn run(args: &SolutionArgs) -> Result<u8, Failure> {
    let (scene, text) = read_scene_text(&args.scene, &args.set)?;
    let detail = match args.detail {
        DetailArg::Brief => Detail::Brief,
        DetailArg::Normal => Detail::Normal,
        DetailArg::Full => Detail::Full,
    };
    let refused = |reason: String| Failure::Input(format!("{}: {reason}", args.scene.display()));
    let (solution, holds, told, plots) = if let Some(stages) = &scene.story {
        let told = story::tell(&scene, stages).map_err(|r| refused(r.to_string()))?;
        let solution = solution::tell(&scene, stages, &told, detail);
        let graphs = story::graphs(&scene, &BTreeMap::new(), &told.answers);
        let graphs = graphs.map_err(|r| refused(r.to_string()))?;
        (solution, told.holds(), Some(told), plots(&scene, &graphs)?)
    } else {
        let derivation = derive::derive(&scene).map_err(|stop| refused(stop.to_string()))?;
        let proof = verify::prove(&scene, &derivation);
        let special =
            story::special(&scene, &derivation, &proof).map_err(|r| refused(r.to_string()))?;
        let possible = verify::possible::judge(&scene, &derivation);
        let mut solution = solution::write(&scene, &derivation, &proof, &special, detail);
        if let Some(refusal) = possible.refusal() {
            solution.begin_with(&format!("{refusal}."));
        }
        let holds = proof.holds()
            && possible.holds()
            && special.iter().all(story::Answer::holds)
            && !derivation.counting.contradictory;
        let graphs = story::graphs(&scene, &story::known(&derivation), &special);
        let graphs = graphs.map_err(|r| refused(r.to_string()))?;
        (solution, holds, None, plots(&scene, &graphs)?)
    };
    let drawn = || {
        let mut all = match &told {
            Some(told) => stage_pictures(&scene, told),
            None => pictures(&scene),
        };
        all.extend(plots.iter().cloned());
        all
    };
    let kind = match (args.figures, args.format) {
        (false, _) => None,
        (true, FormatArg::Markdown) => Some("svg"),
        (true, FormatArg::Latex | FormatArg::LatexFragment) => Some("png"),
        (true, _) => {
            return Err(Failure::Input(String::from(
                "--figures: this format links no files\nhint: markdown and latex do; an HTML page holds its figures",
            )));
        }
    };
    let linked = match (kind, &args.output) {
        (Some(kind), Some(path)) => link(path, &args.scene, kind, drawn())?,
        _ => Vec::new(),
    };
    let output = match args.format {
        FormatArg::Text => render::plain::solution(&solution),
        FormatArg::Markdown => render::markdown::solution(&solution, &linked),
        FormatArg::Latex => render::latex_document::document(&solution, &linked),
        FormatArg::LatexFragment => render::latex_document::fragment(&solution, &linked),
        FormatArg::Html => {
            let pictures: Vec<Picture> = drawn().into_iter().map(|(p, _)| p).collect();
            render::html::page(&solution, &pictures)
        }
        FormatArg::Json => pretty(&render::steps::solution(&solution, &text, &args.set)),
    };
    match &args.output {
        Some(path) => files::save(path, output.as_bytes(), &[&args.scene])?,
        None => print(&output)?,
    }
    Ok(u8::from(!holds))
}

/// The plots of a scene, each with a name for its file.
pub fn plots(scene: &Scene, graphs: &[story::Graph]) -> Result<Vec<(Picture, String)>, Failure> {
    let mut out = Vec::new();
    for (i, graph) in graphs.iter().enumerate() {
        let picture = render::plots::picture(scene, graph)
            .map_err(|fault| Failure::Input(format!("plot `{}`: {fault}", graph.ask.name)))?;
        out.push((picture, format!("plot-{}", i + 1)));
    }
    Ok(out)
}

/// The pictures of a story, by stage.
fn stage_pictures(scene: &Scene, told: &story::Told) -> Vec<(Picture, String)> {
    let mut out = Vec::new();
    for (i, (name, chapter)) in chapters(scene, told).iter().enumerate() {
        for (drawing, kind) in figure::chapter(name, chapter) {
            out.push((
                picture(Slot::Stage(i), drawing),
                format!("{}-{kind}", i + 1),
            ));
        }
    }
    out
}

/// What is to be drawn of every stage.
pub fn chapters(scene: &Scene, told: &story::Told) -> Vec<(String, Chapter)> {
    let each = told.stages.iter();
    each.map(|t| {
        let chapter = match story::impact(scene, told, Some(&t.placed.name)) {
            Some(impact) => Chapter::Impact(impact),
            None => {
                let clockwise = story::is_clockwise(t);
                Chapter::Motion(t.placed.scene.clone(), t.placed.kind.clone(), clockwise)
            }
        };
        (t.name.clone(), chapter)
    })
    .collect()
}

/// The pictures of a scene, each with a name for its file.
fn pictures(scene: &Scene) -> Vec<(Picture, String)> {
    let mut out = Vec::new();
    for which in figure::kinds(scene) {
        let slot = match which {
            Which::Before | Which::All => Slot::Before,
            Which::During(_) => Slot::During,
            Which::After => Slot::After,
        };
        let picture = picture(slot, figure::draw(scene, which));
        out.push((picture, figure::file_name(which)));
    }
    out
}

fn picture(slot: Slot, drawing: figure::Drawing) -> Picture {
    Picture {
        slot,
        svg: drawing.svg,
        caption: drawing.caption,
        alternative: drawing.alternative,
    }
}

/// Writes pictures beside the output; gives them with the names by which it links them.
fn link(
    output: &Path,
    scene: &Path,
    kind: &str,
    pictures: Vec<(Picture, String)>,
) -> Result<Vec<(Picture, String)>, Failure> {
    files::writable(output, &[scene])?;
    let stem = output.file_stem().unwrap_or_default().to_string_lossy();
    let is_plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '.';
    if kind == "png" && !stem.chars().all(is_plain) {
        return Err(Failure::Input(format!(
            "{}: LaTeX cannot include figures of this name\nhint: name the output with letters, digits, - and .",
            output.display()
        )));
    }
    // Everything is drawn before anything is written.
    let mut files = Vec::new();
    for (picture, name) in pictures {
        let file = output.with_file_name(format!("{stem}-{name}.{kind}"));
        files.push((bytes(kind, &picture.svg)?, file, picture));
    }
    let mut linked = Vec::new();
    for (bytes, file, picture) in files {
        files::save(&file, &bytes, &[scene])?;
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        linked.push((picture, name.replace(' ', "%20")));
    }
    Ok(linked)
}

fn bytes(kind: &str, svg: &str) -> Result<Vec<u8>, Failure> {
    match kind {
        #[cfg(feature = "png")]
        "png" => figure::png(svg).map_err(|fault| Failure::Input(fault.to_string())),
        #[cfg(not(feature = "png"))]
        "png" => Err(Failure::Input(String::from(
            "this carom is built without PNG\nhint: build it with the feature png, or take markdown",
        ))),
        _ => Ok(svg.as_bytes().to_vec()),
    }
}

/// Replays a solution file.
pub fn check(args: &CheckArgs) -> Result<u8, Failure> {
    let name = args.file.display().to_string();
    let text = files::read(&args.file, check::LONGEST)?;
    let report = check::check(&text)
        .map_err(|check::Unusable(message)| Failure::Input(format!("{name}: {message}")))?;
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
    out.push_str(&format!(
        "{} steps, {} claims hold{doubles}, {} do not\n",
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
