//! Scenes with friction on the command line: the case they are in, and laws side by side for `carom compare`.

use std::path::PathBuf;

use clap::Args;

use super::{Failure, Format, SceneArgs, files, impacts, only, print, refused, versioned};
use carom::scene::{ContactLaw, Hypothesis, Scene};
use carom::verify::compare::{NoComparison, compare};
use carom::{numeric, plot, render};

/// Arguments of `carom compare`.
#[derive(Args)]
pub struct CompareArgs {
    #[command(flatten)]
    input: SceneArgs,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// The impact, by the name of its stage, where a scene has several
    #[arg(long, value_name = "NAME")]
    stage: Option<String>,
    /// Draw the plane of impulses into this SVG file: friction cone, path, the end by each law
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// Lays the laws of contact side by side.
pub fn run(args: &CompareArgs) -> Result<u8, Failure> {
    let scene = args.input.read()?;
    let path = &args.input.scene;
    let all = match impacts(path, &scene) {
        Ok(all) if !all.is_empty() => all,
        // Where its own law has no answer, the others may have one.
        own => match impacts(path, &by_poisson(&scene)) {
            Ok(all) if !all.is_empty() => all,
            _ => own?,
        },
    };
    let all = undecided(all);
    let scene = only(&args.input.scene, all, args.stage.as_deref())?;
    let refused = |reason: String| refused(&args.input.scene, reason);
    if scene.friction().is_none() && scene.contacts.len() > 1 {
        return several(&scene, args, &refused);
    }
    let found = compare(&scene).map_err(|why| refused(why.to_string()))?;
    if let Some(path) = &args.output {
        let plane = plot::draw(&render::compare::plane(&scene, &found));
        let plane = plane.map_err(|why| refused(why.to_string()))?;
        files::save(path, plane.svg.as_bytes(), &[&args.input.scene])?;
    }
    print(&match args.format {
        Format::Text => render::compare::text(&scene, &found),
        Format::Json => versioned(&render::compare::json(&scene, &found)),
    })?;
    Ok(0)
}

/// The scene with Poisson's hypothesis at the contacts in its stages.
fn by_poisson(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    let contacts = scene.stages.iter_mut();
    for contact in contacts.flat_map(|stage| &mut stage.scene.contacts) {
        if let ContactLaw::Friction(law) = &mut contact.law {
            law.hypothesis = Hypothesis::Poisson;
        }
    }
    scene
}

/// Impacts before anything is decided about their contacts; all outcomes of a stage begin alike.
fn undecided(mut impacts: Vec<(String, Scene)>) -> Vec<(String, Scene)> {
    for (name, impact) in &mut impacts {
        name.truncate(name.find(", case ").unwrap_or(name.len()));
        *impact = std::mem::take(impact).undecided();
    }
    impacts.dedup_by(|a, b| a.0 == b.0);
    impacts
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
        Format::Json => versioned(&render::several::json(scene, &all)),
    })?;
    Ok(0)
}
