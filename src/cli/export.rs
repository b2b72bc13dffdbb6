//! `carom export`: a scene as questions of a learning platform.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::grade::sheet;
use super::solution::pictures;
use super::{Failure, complain, files, print, read_scene, refused, work_out};
use carom::export::{Shown, exercise, moodle, numbas, stack};
use carom::render::html;
use carom::solution::Detail;

/// Arguments of `carom export`.
#[derive(Args)]
pub struct ExportArgs {
    /// Scene file
    scene: PathBuf,
    /// The platform
    #[arg(long, value_enum)]
    to: Platform,
    /// File to write instead of standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Platform {
    /// Questions for STACK, as Moodle XML: formulas and numbers, a branch for every belief
    Stack,
    /// Numerical questions of plain Moodle
    Moodle,
    /// An exam of Numbas
    Numbas,
}

/// Runs `carom export`.
pub fn run(args: &ExportArgs) -> Result<u8, Failure> {
    let refused = |why: String| refused(&args.scene, why);
    let scene = read_scene(&args.scene, &[])?;
    let sheet = sheet(&args.scene, scene.clone())?;
    let worked = work_out(&args.scene, &scene)?;
    if !worked.holds() {
        return Err(refused(String::from(
            "the worked solution does not hold, and nothing is asked by it\nhint: `carom derive` tells what failed",
        )));
    }
    let pictures = pictures(&args.scene, &worked)?;
    let pictures: Vec<_> = pictures.iter().map(html::Picture::standalone).collect();
    let shown = Shown {
        figure: pictures.first().map(|p| p.svg.clone()).unwrap_or_default(),
        solution: html::fragment(&worked.solution(Detail::Normal), &pictures),
    };
    let exercise = exercise(&sheet, &scene, shown, &worked.told.assumed()).map_err(refused)?;
    for left_out in &exercise.left_out {
        complain(&format!(
            "{}: no question for {left_out}",
            args.scene.display()
        ));
    }
    let text = match args.to {
        Platform::Stack => stack(&exercise),
        Platform::Moodle => moodle(&exercise).map_err(refused)?,
        Platform::Numbas => numbas(&exercise),
    };
    match &args.output {
        Some(path) => files::save(path, text.as_bytes(), &[&args.scene])?,
        None => print(&text)?,
    }
    Ok(0)
}
