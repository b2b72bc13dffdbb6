//! Scenes with friction on the command line: the table of cases for `carom derive`, laws side by side for `carom compare`.

use std::path::{Path, PathBuf};

use clap::Args;

use super::{Failure, Format, files, pretty, print, read_scene};
use carom::derive::friction::table;
use carom::render::friction::{self, Shown};
use carom::scene::Scene;
use carom::verify::compare::{NoComparison, compare};
use carom::{answer, derive, numeric, plot, render, verify};

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

/// Derives every case that a scene with friction is about.
pub fn derive_cases(path: &Path, scene: &Scene, format: Format) -> Result<u8, Failure> {
    let refused = |reason: String| Failure::Input(format!("{}: {reason}", path.display()));
    let Some(table) = table(scene).map_err(|stop| refused(stop.to_string()))? else {
        return Err(refused(String::from("no contact has friction")));
    };
    let judged = verify::friction::judge(scene, &table);
    let mut shown = Vec::new();
    for i in judged.pick.cases(&table) {
        let case = &table.cases[i];
        let derivation = derive::derive(&case.scene).map_err(|stop| refused(stop.to_string()))?;
        let proof = verify::prove(&case.scene, &derivation);
        let possible = verify::possible::judge(&case.scene, &derivation);
        let special = verify::special(&case.scene, &derivation, &proof)
            .map_err(|reason| refused(reason.to_string()))?;
        shown.push(Shown {
            case,
            derivation,
            proof,
            possible,
            special,
        });
    }
    let about = answer::about(scene, &table.about, &std::collections::BTreeMap::new())
        .map_err(|reason| refused(reason.to_string()))?;
    print(&match format {
        Format::Text => friction::text(scene, &table, &judged, &shown, &about),
        Format::Json => pretty(&friction::json(scene, &table, &judged, &shown)),
    })?;
    let holds = judged.supposed_holds != Some(false)
        && !shown.is_empty()
        && judged.checks.iter().all(|c| c.holds != Some(false))
        && shown
            .iter()
            .all(|s| s.proof.holds() && s.special.iter().all(answer::Answer::holds));
    Ok(u8::from(!holds))
}

/// The same for grading. Where several cases are left, what is the same in all of them can still be asked, and is told.
pub fn gradable(path: &Path, scene: Scene) -> Result<Scene, Failure> {
    let why = match settled(path, scene.clone()) {
        Err(Failure::Input(why)) => why,
        other => return other,
    };
    let Ok(Some(mut table)) = table(&scene) else {
        return Err(Failure::Input(why));
    };
    if table.about.is_empty() || table.cases.is_empty() {
        return Err(Failure::Input(why));
    }
    eprintln!("{why}\nwhat is the same in every case can be graded");
    let mut common = table.cases.swap_remove(0).scene;
    common.questions.clear();
    common.special = table.about;
    Ok(common)
}

/// A scene whose contact with friction is in the case that its values pick or that it supposes.
pub fn settled(path: &Path, scene: Scene) -> Result<Scene, Failure> {
    if scene.friction().is_none() {
        return Ok(scene);
    }
    let refused = |reason: String| Failure::Input(format!("{}: {reason}", path.display()));
    Ok(verify::friction::settled(&scene)
        .map_err(refused)?
        .unwrap_or(scene))
}
