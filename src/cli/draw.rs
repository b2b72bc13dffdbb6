//! `carom draw`: the pictures of a scene as SVG or PNG.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::solution::plots;
use super::{Failure, SceneArgs, files, of_stage, print, refused, work_out};
use carom::figure::{self, Chapter, Subject, Which};
use carom::scene::Scene;
use carom::verify::friction::settled;
use carom::worked;

/// Arguments of `carom draw`.
#[derive(Args)]
pub struct DrawArgs {
    #[command(flatten)]
    input: SceneArgs,
    /// Which picture
    #[arg(long, value_enum, default_value_t = Picture::All)]
    which: Picture,
    /// Draw the free-body diagram of this body alone (with --which during)
    #[arg(long, value_name = "BODY")]
    body: Option<String>,
    /// Name of the stage to draw, where the scene has stages; all of them without it
    #[arg(long, value_name = "NAME")]
    stage: Option<String>,
    /// Draw this plot of the scene instead
    #[arg(long, value_name = "NAME", conflicts_with_all = ["body", "stage"])]
    plot: Option<String>,
    /// File to write, `.svg` or `.png`; without it the SVG goes to standard output
    #[arg(short, long)]
    output: Option<PathBuf>,
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
    let mut scene = args.input.read()?;
    if let Some(name) = &args.plot {
        return write(args, &plotted(args, &mut scene, name)?);
    }
    let all = match scene.has_stages() {
        true => {
            let told = worked::to_draw(&scene, args.stage.as_deref());
            let told = told.map_err(|why| refused(&args.input.scene, why))?;
            told.chapters()
        }
        false => vec![(String::new(), Chapter::Impact(scene.clone()))],
    };
    // One impact by itself has the pictures of a collision.
    match of_stage(&args.input.scene, all, args.stage.as_deref())?.as_slice() {
        [(_, Chapter::Impact(impact))] => scene = impact.clone(),
        all => return write(args, &figure::chapters(&scene, all).svg),
    }
    // What comes after is drawn in the case that the values pick; without one all pictures are those of the first case.
    if matches!(args.which, Picture::After | Picture::All) {
        match settled(&scene) {
            Ok(settled) => scene = settled,
            Err(why) if matches!(args.which, Picture::After) => {
                return Err(refused(&args.input.scene, why));
            }
            Err(_) => scene = worked::first_case(&scene).unwrap_or(scene),
        }
    }
    let subject = match &args.body {
        None => Subject::System,
        Some(name) => {
            let names: Vec<&str> = scene.bodies.iter().map(|b| b.name.as_str()).collect();
            let found = names.iter().position(|known| known == name);
            Subject::Body(found.ok_or_else(|| {
                let known = names.join(", ");
                let why = format!("no body {name}\nhint: the scene has {known}");
                refused(&args.input.scene, why)
            })?)
        }
    };
    let which = match args.which {
        Picture::Before => Which::Before,
        Picture::During => Which::During(subject),
        Picture::After => Which::After,
        Picture::All => Which::All,
    };
    write(args, &figure::draw(&scene, which).svg)
}

/// One plot of the scene as SVG.
fn plotted(args: &DrawArgs, scene: &mut Scene, name: &str) -> Result<String, Failure> {
    let refused = |why: String| refused(&args.input.scene, why);
    let names: Vec<String> = scene.plots.iter().map(|p| p.name.clone()).collect();
    scene.plots.retain(|p| p.name == name);
    if scene.plots.is_empty() {
        let hint = match names.join(", ") {
            none if none.is_empty() => String::from("the scene asks for none"),
            names => format!("plots here: {names}"),
        };
        return Err(refused(format!("no plot {name}\nhint: {hint}")));
    }
    let worked = work_out(&args.input.scene, scene)?;
    let graphs = worked.graphs().map_err(|why| refused(why.to_string()))?;
    let drawn = plots(&worked.scene, &graphs)?.pop();
    drawn
        .map(|(picture, _)| picture.svg)
        .ok_or_else(|| refused(format!("no plot {name}")))
}

/// Writes a picture where it belongs.
fn write(args: &DrawArgs, svg: &str) -> Result<u8, Failure> {
    let Some(output) = &args.output else {
        print(svg)?;
        return Ok(0);
    };
    let kind = output
        .extension()
        .and_then(|e| e.to_str())
        .map(str::to_ascii_lowercase);
    let bytes = match kind.as_deref() {
        Some("svg") => svg.as_bytes().to_vec(),
        #[cfg(feature = "png")]
        Some("png") => figure::png(svg).map_err(|fault| refused(output, fault))?,
        _ => {
            let why = "unknown picture format\nhint: name the file .svg or .png";
            return Err(refused(output, why));
        }
    };
    files::save(output, &bytes, &[&args.input.scene])?;
    Ok(0)
}
