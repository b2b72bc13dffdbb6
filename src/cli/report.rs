//! `carom report`: error against run time of every route a scene has.

use std::fs::File;
use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};

use super::{Failure, Format, complain, files, only, print, read_scene, refused, versioned};
use carom::derive::{self, Derivation};
use carom::report::{Effort, Report, Row, measure};
use carom::scene::Scene;
use carom::{numeric, render, story, verify, worked};

/// Arguments of `carom report`.
#[derive(Args)]
pub struct ReportArgs {
    /// Scene files
    #[arg(required = true)]
    scenes: Vec<PathBuf>,
    /// Few points and short timing: seconds instead of minutes
    #[arg(long)]
    quick: bool,
    /// Seed of all points; the same seed gives the same errors
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// The impact of this stage, where a scene has several
    #[arg(long, value_name = "NAME")]
    stage: Option<String>,
    /// Points per level of a family
    #[arg(long)]
    points: Option<usize>,
    /// Only this family besides usual values, such as "mass ratio"
    #[arg(long)]
    family: Option<String>,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Also write it whole to a file: .json for programs, .txt for people, else one self-contained page with the plots
    #[arg(short, long, visible_alias = "html", value_name = "FILE")]
    output: Option<PathBuf>,
    /// Also write every finished row at once, one JSON object a line
    #[arg(long, value_name = "FILE")]
    rows: Option<PathBuf>,
    /// Give a parameter a value; may be repeated
    #[arg(long = "set", value_name = "NAME=VALUE")]
    set: Vec<String>,
}

/// Runs `carom report`: exit status 0, or 130 after an interrupt with everything finished until then printed.
pub fn run(args: &ReportArgs) -> Result<u8, Failure> {
    // Paths first: an hour of measuring should not end at a folder that is not there.
    let inputs: Vec<&Path> = args.scenes.iter().map(PathBuf::as_path).collect();
    let mut rows = args
        .rows
        .as_deref()
        .map(|path| create(path, &inputs))
        .transpose()?;
    if let Some(path) = &args.output {
        files::writable(path, &inputs)?;
    }
    let mut scenes = Vec::new();
    for path in &args.scenes {
        let scene = read_scene(path, &args.set)?;
        scenes.push((path, impact(path, scene, args.stage.as_deref())?));
    }
    let stop = Arc::new(AtomicBool::new(false));
    let seen = Arc::clone(&stop);
    let handled = signal_hook::flag::register(signal_hook::consts::SIGINT, seen).is_ok();
    let effort = Effort {
        seed: args.seed,
        points: args.points.unwrap_or(if args.quick { 4 } else { 40 }),
        runs: if args.quick { 15 } else { 51 },
        repeat: if args.quick { 100 } else { 1000 },
        family: args.family.clone(),
    };
    let mut reports: Vec<Report> = Vec::new();
    for (path, (scene, derivation)) in &scenes {
        let name = path.display();
        if let Err(numeric::NoPoint::Missing(symbols)) = numeric::values(scene) {
            let symbols = symbols.join(", ");
            let how = "measured at seeded points of the domains";
            complain(&format!("{name}: no value for {symbols}; {how}"));
        }
        let bar = bar(&scene.title);
        let mut failed: Option<std::io::Error> = None;
        let mut on_row = |row: &Row, done: usize, total: usize| {
            bar.set_length(total as u64);
            bar.set_position(done as u64);
            if let Some(file) = &mut rows {
                let line = serde_json::json!({"scene": scene.title, "row": row});
                failed = writeln!(file, "{line}").and_then(|()| file.flush()).err();
            }
            failed.is_none() && !(handled && stop.load(Ordering::SeqCst))
        };
        let report = measure(scene, derivation.as_ref(), effort.clone(), &mut on_row)
            .map_err(|why| refused(path, why))?;
        bar.finish_and_clear();
        if let Some(error) = failed {
            return Err(Failure::Output(error.to_string()));
        }
        if args.format == Format::Text {
            print(&render::report::text(&report))?;
        }
        let interrupted = report.interrupted;
        reports.push(report);
        if interrupted {
            break;
        }
    }
    let interrupted = reports.iter().any(|r| r.interrupted);
    if args.format == Format::Json {
        print(&versioned(&render::report::json(&reports)))?;
    }
    if let Some(path) = &args.output {
        let whole = match path.extension().and_then(|e| e.to_str()) {
            Some("json") => versioned(&render::report::json(&reports)),
            Some("txt") => reports.iter().map(render::report::text).collect(),
            _ => render::report::html(&reports),
        };
        files::save(path, whole.as_bytes(), &inputs)?;
    }
    Ok(if interrupted { 130 } else { 0 })
}

/// The impact to measure and its closed forms. Of stages, and of a contact that values leave open what it does, it is an
/// outcome of one stage, and the speeds that an earlier stage hands on as roots are data.
fn impact(
    path: &Path,
    scene: Scene,
    stage: Option<&str>,
) -> Result<(Scene, Option<Derivation>), Failure> {
    if scene.has_stages() || scene.friction().is_some() {
        let worked = worked::in_cases(&scene).map_err(|why| refused(path, why))?;
        let all = story::outcomes(&worked.told).map(|(name, case)| (name, case.asked(&[])));
        let (scene, derivation) = only(path, all.collect(), stage)?;
        return Ok((scene, Some(derivation)));
    }
    let scene = only(path, vec![(String::new(), scene)], stage)?;
    let derivation = derive::derive(&scene).map_err(|why| why.to_string());
    let derivation = derivation.and_then(|d| match verify::prove(&scene, &d).holds() {
        true => Ok(d),
        false => Err(String::from(
            "they are refuted: `carom derive` tells what failed",
        )),
    });
    if let Err(why) = &derivation {
        let name = path.display();
        complain(&format!(
            "{name}: no closed forms ({why}); their routes are left out"
        ));
    }
    Ok((scene, derivation.ok()))
}

fn create(path: &Path, inputs: &[&Path]) -> Result<File, Failure> {
    files::writable(path, inputs)?;
    File::create(path).map_err(|e| refused(path, format!("cannot be written: {e}")))
}

fn bar(title: &str) -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(0);
    if let Ok(style) = ProgressStyle::with_template("{msg} {bar:40} {pos}/{len} {eta}") {
        bar.set_style(style);
    }
    bar.set_message(title.to_string());
    bar
}
