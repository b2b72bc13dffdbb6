//! `carom draw`: the pictures of a scene as SVG or PNG.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::{Failure, print, read_scene, save};
use carom::figure::{self, Subject, Which};

/// Arguments of `carom draw`.
#[derive(Args)]
pub struct DrawArgs {
    /// Scene file, `-` for standard input
    scene: PathBuf,
    /// Which picture
    #[arg(long, value_enum, default_value_t = Picture::All)]
    which: Picture,
    /// Draw the free-body diagram of this body alone (with --which during)
    #[arg(long, value_name = "BODY")]
    body: Option<String>,
    /// Name of the impact to draw, where the scene has stages; the first one without it
    #[arg(long, value_name = "NAME")]
    stage: Option<String>,
    /// File to write, `.svg` or `.png`; without it the SVG goes to standard output
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// Give a parameter a value for the drawing, such as theta=pi/6; may be repeated
    #[arg(long = "set", value_name = "NAME=VALUE")]
    set: Vec<String>,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Picture {
    /// Bodies and velocities just before
    Before,
    /// The free-body diagram during the collision
    During,
    /// Bodies and velocities just after
    After,
    /// All three
    All,
}

/// Draws a scene.
pub fn run(args: &DrawArgs) -> Result<u8, Failure> {
    let mut scene = read_scene(&args.scene, &args.set)?;
    if let Some(stages) = &scene.story {
        let refused =
            |reason: String| Failure::Input(format!("{}: {reason}", args.scene.display()));
        let told = carom::story::tell(&scene, stages).map_err(|r| refused(r.to_string()))?;
        let stage = carom::story::impact(&scene, &told, args.stage.as_deref());
        scene = stage.ok_or_else(|| {
            let all = told.stages.iter().filter(|s| !s.cases.is_empty());
            let names: Vec<&str> = all.map(|s| s.name.as_str()).collect();
            refused(format!(
                "no impact to draw\nhint: impacts here: {}",
                names.join(", ")
            ))
        })?;
    }
    let subject = match &args.body {
        None => Subject::System,
        Some(name) => {
            let known = || {
                scene
                    .bodies
                    .iter()
                    .map(|b| b.name.as_str())
                    .collect::<Vec<_>>()
                    .join(", ")
            };
            let found = scene.bodies.iter().position(|b| b.name == *name);
            Subject::Body(found.ok_or_else(|| {
                Failure::Input(format!(
                    "{}: no body {name}\nhint: the scene has {}",
                    args.scene.display(),
                    known()
                ))
            })?)
        }
    };
    let which = match args.which {
        Picture::Before => Which::Before,
        Picture::During => Which::During(subject),
        Picture::After => Which::After,
        Picture::All => Which::All,
    };
    let Some(output) = &args.output else {
        print(&figure::draw(&scene, which).svg)?;
        return Ok(0);
    };
    let kind = output
        .extension()
        .and_then(|e| e.to_str())
        .map(str::to_ascii_lowercase);
    let bytes = match kind.as_deref() {
        Some("svg") => figure::draw(&scene, which).svg.into_bytes(),
        #[cfg(feature = "png")]
        Some("png") => figure::png(&figure::draw(&scene, which).svg)
            .map_err(|fault| Failure::Input(format!("{}: {fault}", output.display())))?,
        _ => {
            return Err(Failure::Input(format!(
                "{}: unknown picture format\nhint: name the file .svg or .png",
                output.display()
            )));
        }
    };
    save(output, &bytes)?;
    Ok(0)
}
