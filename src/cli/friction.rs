//! Scenes with friction on the command line: the case they are in, and laws side by side for `carom compare`.

use std::path::PathBuf;

use clap::Args;

use super::{Failure, Format, files, pretty, print, read_scene};
use carom::render::friction;
use carom::scene::Scene;
use carom::verify::compare::{NoComparison, compare};
use carom::{numeric, plot, render};

/// Arguments of `carom compare`.
#[derive(Args)]
pub struct CompareArgs {
    /// Scene file, `-` for standard input
    scene: PathBuf,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Give a parameter a value, such as v=2 or theta=acos(3/5); may be repeated
    #[arg(long = "set", value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// Draw the plane of impulses into this SVG file: friction cone, path, the end by each law
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// Lays the laws of contact side by side.
pub fn run(args: &CompareArgs) -> Result<u8, Failure> {
    let scene = read_scene(&args.scene, &args.set)?;
    let refused = |reason: String| Failure::Input(format!("{}: {reason}", args.scene.display()));
    if scene.friction().is_none() && scene.contacts.len() > 1 {
        return several(&scene, args, &refused);
    }
    let found = compare(&scene).map_err(|why| refused(why.to_string()))?;
    if let Some(path) = &args.output {
        let svg = plot::curve(&friction::plane(&scene, &found));
        let svg = svg.map_err(|why| refused(why.to_string()))?;
        files::save(path, svg.as_bytes(), &[&args.scene])?;
    }
    print(&match args.format {
        Format::Text => friction::comparison(&scene, &found),
        Format::Json => pretty(&friction::comparison_json(&scene, &found)),
    })?;
    Ok(0)
}

/// Lays what laws for several contacts at once give side by side.
fn several(
    scene: &Scene,
    args: &CompareArgs,
    refused: &dyn Fn(String) -> Failure,
) -> Result<u8, Failure> {
    if args.output.is_some() {
        let reason = "the plane of impulses is that of one contact with friction";
        return Err(refused(reason.into()));
    }
    let at =
        numeric::values(scene).map_err(|why| refused(NoComparison::NoPoint(why).to_string()))?;
    let given = numeric::given(scene, &at).map_err(|why| refused(why.to_string()))?;
    let all = numeric::several::candidates(&given).map_err(|why| refused(why.to_string()))?;
    print(&match args.format {
        Format::Text => render::several::text(scene, &all),
        Format::Json => pretty(&render::several::json(scene, &all)),
    })?;
    Ok(0)
}
