//! Commands: each reads its input, calls the library once, and prints.
//!
//! Results go to standard output, everything else to standard error. Exit status: 0 done and everything held; 1 a check
//! failed or an answer was refuted; 2 unusable input; 3 undecided; 70 a fault of carom itself; 74 the output cannot be
//! written.

mod draw;
mod emit;
mod export;
mod files;
mod friction;
mod grade;
mod report;
#[cfg(feature = "serve")]
mod serve;
#[cfg(feature = "site")]
mod site;
mod solution;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::error::ContextKind;
use clap::{Args, CommandFactory, Parser, Subcommand};
use serde_json::json;

use carom::command::{self, Format, Numbers, Output};
use carom::render::json::versioned;
use carom::verify::friction::settled;
use carom::worked::{self, Worked};
use carom::{derive, render, scene};

/// Collisions of rigid bodies in the plane: closed forms a teacher would reach, each one proved or marked.
#[derive(Parser)]
#[command(version, max_term_width = 100)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Derive the closed forms a scene asks for, and prove them
    Derive {
        #[command(flatten)]
        input: SceneArgs,
        /// Output format
        #[arg(long, value_enum, default_value_t = Format::Text)]
        format: Format,
        /// Print the full system of equations in matrix form instead
        #[arg(long)]
        matrix: bool,
        /// Only the impact of this stage, with the motion that goes into it
        #[arg(long, value_name = "NAME")]
        stage: Option<String>,
    },
    /// Solve a scene in numbers, from its geometry alone; a scene with stages is followed from one to the next
    Solve {
        #[command(flatten)]
        input: SceneArgs,
        /// Output format
        #[arg(long, value_enum, default_value_t = Format::Text)]
        format: Format,
        /// Exact fractions instead of doubles
        #[arg(long)]
        exact: bool,
        /// The double nearest to each true value, and how it was certified; parameters count as exact (0.1 is 1/10)
        #[arg(long, conflicts_with = "exact")]
        certify: bool,
        /// Only the impact of this stage, which begins as the file says
        #[arg(long, value_name = "NAME")]
        stage: Option<String>,
    },
    /// Lay the laws of contact side by side at the values of a scene with friction
    Compare(friction::CompareArgs),
    /// Draw a scene: before, the free-body diagram during, and after the collision
    Draw(draw::DrawArgs),
    /// Write the worked solution of a scene: text, Markdown, LaTeX, HTML or JSON
    #[command(visible_alias = "explain")]
    Solution(solution::SolutionArgs),
    /// Replay every step of a solution written as JSON: its claims, not the words of its reasons
    Check(solution::CheckArgs),
    /// Judge a formula: is it equivalent, how is that known, and what is wrong with it
    Grade(grade::GradeArgs),
    /// Write the closed forms of a scene as code: arranged for accuracy, with a bound of the error
    Emit(emit::EmitArgs),
    /// Write a scene as questions of a learning platform: STACK, Moodle or Numbas
    Export(export::ExportArgs),
    /// Measure error against run time of every route a scene has, towards every extreme
    Report(report::ReportArgs),
    /// Hold what a book prints about a scene against what is derived
    Verify(grade::VerifyArgs),
    /// Tell how a formula is understood
    Read(grade::ReadArgs),
    /// Serve a folder of scenes: a workbench in the browser, and HTTP for programs
    #[cfg(feature = "serve")]
    Serve(serve::ServeArgs),
    /// Write scenes, worked solutions, figures and documents as pages that need no server
    #[cfg(feature = "site")]
    Site(site::SiteArgs),
    /// Describe a scene for pages and editors, as JSON
    #[cfg(feature = "serve")]
    #[command(hide = true)]
    Describe(serve::DescribeArgs),
    /// Tell what is wrong with a scene file, and where: for editors, with --format json
    CheckScene {
        /// Scene file, `-` for standard input
        scene: PathBuf,
        /// Output format
        #[arg(long, value_enum, default_value_t = Format::Text)]
        format: Format,
    },
    /// Print the JSON Schema of scene files
    Schema,
    /// Print what a shell needs to complete carom's commands
    Completions {
        /// The shell
        shell: clap_complete::Shell,
    },
    /// Print the manual page
    Man,
    /// List the scenes of a folder
    List {
        /// Folder to look in
        #[arg(default_value = "derivations")]
        folder: PathBuf,
    },
}

/// A scene, and values put into it.
#[derive(Args)]
struct SceneArgs {
    /// Scene file, `-` for standard input
    scene: PathBuf,
    /// Give a parameter a value, such as v=2 or theta=acos(3/5); may be repeated
    #[arg(long = "set", value_name = "NAME=VALUE")]
    set: Vec<String>,
}

impl SceneArgs {
    fn read(&self) -> Result<scene::Scene, Failure> {
        read_scene(&self.scene, &self.set)
    }
}

/// Why a command ended without a result.
enum Failure {
    /// Unusable input: the message is complete.
    Input(String),
    /// The output could not be written: where, and why.
    Output(String),
}

/// Runs the command line and gives the exit status.
pub fn run() -> ExitCode {
    let parsed = Cli::try_parse().unwrap_or_else(|error| match without_feature(&error) {
        Some(message) => {
            complain(&message);
            std::process::exit(2)
        }
        None => error.exit(),
    });
    let outcome = match parsed.command {
        Command::Derive {
            input,
            format,
            matrix,
            stage,
        } => derive_command(&input, format, matrix, stage.as_deref()),
        Command::Solve {
            input,
            format,
            exact,
            certify,
            stage,
        } => {
            let numbers = match (exact, certify) {
                (_, true) => Numbers::Certified,
                (true, _) => Numbers::Exact,
                _ => Numbers::Doubles,
            };
            solve_command(&input, format, numbers, stage.as_deref())
        }
        Command::Compare(args) => friction::run(&args),
        Command::Draw(args) => draw::run(&args),
        Command::Emit(args) => emit::run(&args),
        Command::Export(args) => export::run(&args),
        Command::Report(args) => report::run(&args),
        Command::Solution(args) => solution::run(&args),
        Command::Check(args) => solution::check(&args),
        Command::Grade(args) => grade::run(&args),
        Command::Verify(args) => grade::verify(&args),
        Command::Read(args) => grade::read(&args),
        #[cfg(feature = "serve")]
        Command::Serve(args) => serve::run(&args),
        #[cfg(feature = "site")]
        Command::Site(args) => site::run(&args),
        #[cfg(feature = "serve")]
        Command::Describe(args) => serve::describe(&args),
        Command::CheckScene { scene, format } => check_scene(&scene, format),
        Command::Schema => print(&scene::schema()).map(|()| 0),
        Command::Completions { shell } => print(&completions(shell)).map(|()| 0),
        Command::Man => print(&manual()).map(|()| 0),
        Command::List { folder } => list(&folder),
    };
    match outcome {
        Ok(status) => ExitCode::from(status),
        Err(Failure::Input(message)) => {
            complain(&message);
            ExitCode::from(2)
        }
        Err(Failure::Output(message)) => {
            complain(&format!("the output cannot be written: {message}"));
            ExitCode::from(74)
        }
    }
}

/// What to say where a command is asked for that this build was made without.
fn without_feature(error: &clap::Error) -> Option<String> {
    let named = error.get(ContextKind::InvalidSubcommand)?.to_string();
    let feature = ["serve", "site"].into_iter().find(|f| *f == named)?;
    Some(format!(
        "`carom {feature}` is not in this build\nhint: `cargo install --path . --features {feature}` builds it in"
    ))
}

fn derive_command(
    input: &SceneArgs,
    format: Format,
    matrix: bool,
    stage: Option<&str>,
) -> Result<u8, Failure> {
    let (path, mut scene) = (&input.scene, input.read()?);
    if matrix || stage.is_some() {
        scene = impact_of(&scene, path, stage)?;
    }
    if !matrix {
        return print_output(path, command::derive(&scene, format));
    }
    let names = derive::Names::of(&scene);
    let full = derive::full_matrix(&scene, &names).map_err(|stop| refused(path, stop))?;
    print(&match format {
        Format::Text => render::text::matrix(&scene, &full),
        Format::Json => versioned(&render::json::matrix(&full)),
    })?;
    Ok(0)
}

fn solve_command(
    input: &SceneArgs,
    format: Format,
    numbers: Numbers,
    stage: Option<&str>,
) -> Result<u8, Failure> {
    let (path, mut scene) = (&input.scene, input.read()?);
    if stage.is_some() || scene.has_stages() && numbers != Numbers::Doubles {
        let all = scene.stages.iter();
        let all = all.filter_map(|s| Some((s.name.clone(), s.from_the_file()?)));
        let mut all: Vec<_> = all.collect();
        if !scene.has_stages() {
            all.push((String::new(), scene));
        }
        if all.is_empty() {
            let why = "no impact here begins as the file says; what follows a motion is integrated in doubles";
            let hint = "leave out --exact, --certify and --stage";
            return Err(refused(path, format!("{why}\nhint: {hint}")));
        }
        scene = only(path, all, stage)?;
    }
    print_output(path, command::solve(&scene, numbers, format))
}

/// Why a command has no result for the scene of a file.
fn refused(path: &Path, why: impl std::fmt::Display) -> Failure {
    Failure::Input(format!("{}: {why}", path.display()))
}

/// Works the scene of a file out.
fn work_out(path: &Path, scene: &scene::Scene) -> Result<Worked, Failure> {
    worked::out(scene).map_err(|why| refused(path, why))
}

/// Prints what a command found, and gives its status.
fn print_output(path: &Path, output: Result<Output, String>) -> Result<u8, Failure> {
    let output = output.map_err(|why| refused(path, why))?;
    print(&output.text)?;
    Ok(output.status)
}

/// Tells what is wrong with a scene file: status 0 where nothing is, else 2.
fn check_scene(path: &Path, format: Format) -> Result<u8, Failure> {
    let text = match (files::read(path, scene::LONGEST), format) {
        (Ok(text), _) => text,
        (Err(Failure::Input(why)), Format::Json) => {
            let told = render::faults::of_file(&why);
            return print(&versioned(&told)).map(|()| 2);
        }
        (Err(failure), _) => return Err(failure),
    };
    match (scene::read(&text), format) {
        (Ok(_), Format::Text) => Ok(0),
        (Ok(_), Format::Json) => print(&versioned(&json!({"faults": [], "untold": 0}))).map(|()| 0),
        (Err(faults), Format::Json) => {
            print(&versioned(&render::faults::json(&faults, &text))).map(|()| 2)
        }
        (Err(faults), Format::Text) => {
            let name = path.display().to_string();
            Err(Failure::Input(faults.render(&name, &text)))
        }
    }
}

fn list(folder: &Path) -> Result<u8, Failure> {
    let mut files = Vec::new();
    collect(folder, &mut files).map_err(|e| refused(folder, e))?;
    files.sort();
    for file in files {
        let read = files::read(&file, scene::LONGEST).ok();
        let words = match read.and_then(|text| scene::read(&text).ok()) {
            Some(scene) => format!("{} · {}", scene.source, scene.title),
            None => String::from("not a valid scene; `carom derive` tells why"),
        };
        print(&format!("{}\t{words}\n", file.display()))?;
    }
    Ok(0)
}

/// The scene files below a folder, refused examples aside.
fn collect(folder: &Path, files: &mut Vec<PathBuf>) -> std::io::Result<()> {
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            if path.file_name().is_none_or(|n| n != "refused") {
                collect(&path, files)?;
            }
        } else if path.extension().is_some_and(|e| e == "json") {
            files.push(path);
        }
    }
    Ok(())
}

/// The impacts of a scene by name of their stages, each with the motion that goes into it; a scene without stages is one
/// impact without a name, with its friction as it stands.
fn impacts(path: &Path, scene: &scene::Scene) -> Result<Vec<(String, scene::Scene)>, Failure> {
    match scene.has_stages() {
        true => Ok(work_out(path, scene)?.impacts()),
        false => Ok(vec![(String::new(), scene.clone())]),
    }
}

/// Of what belongs to stages, what belongs to one: all of it where none is named.
fn of_stage<T>(
    path: &Path,
    mut all: Vec<(String, T)>,
    stage: Option<&str>,
) -> Result<Vec<(String, T)>, Failure> {
    let Some(stage) = stage else { return Ok(all) };
    let known: Vec<String> = all.iter().map(|(name, _)| name.clone()).collect();
    all.retain(|(name, _)| name == stage);
    if !all.is_empty() {
        return Ok(all);
    }
    Err(refused(
        path,
        match known.as_slice() {
            [none] if none.is_empty() => format!("no stage {stage}: this scene is one impact"),
            known => format!(
                "no stage {stage}\nhint: --stage with one of: {}",
                known.join("; ")
            ),
        },
    ))
}

/// The only impact there is, or the one of a stage.
fn only<T>(path: &Path, all: Vec<(String, T)>, stage: Option<&str>) -> Result<T, Failure> {
    if all.is_empty() {
        return Err(refused(path, "no stage of this scene is an impact"));
    }
    let mut all = of_stage(path, all, stage)?;
    if let [_, _, ..] = all.as_slice() {
        let names: Vec<String> = all.into_iter().map(|(name, _)| name).collect();
        let names = names.join("; ");
        let why = format!("several impacts\nhint: --stage with one of: {names}");
        return Err(refused(path, why));
    }
    Ok(all.swap_remove(0).1)
}

/// The one impact a command works on, in the case that its values pick.
fn impact_of(
    scene: &scene::Scene,
    path: &Path,
    stage: Option<&str>,
) -> Result<scene::Scene, Failure> {
    let one = only(path, impacts(path, scene)?, stage)?;
    settled(&one).map_err(|why| refused(path, why))
}

/// Reads a scene and puts in the values given on the command line.
fn read_scene(path: &Path, set: &[String]) -> Result<scene::Scene, Failure> {
    read_scene_text(path, set).map(|(scene, _)| scene)
}

/// The same, with the text of the scene.
fn read_scene_text(path: &Path, set: &[String]) -> Result<(scene::Scene, String), Failure> {
    let text = files::read(path, scene::LONGEST)?;
    let scene = command::scene(&path.display().to_string(), &text, set).map_err(Failure::Input)?;
    Ok((scene, text))
}

/// What a shell needs to complete the commands.
fn completions(shell: clap_complete::Shell) -> String {
    let mut out = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "carom", &mut out);
    String::from_utf8_lossy(&out).into_owned()
}

/// The manual page: the tool, then each command with its options.
fn manual() -> String {
    let mut all = Cli::command();
    all.build();
    let mut out = Vec::new();
    // Writing to a vector cannot fail.
    let _ = clap_mangen::Man::new(all.clone()).render(&mut out);
    for command in all.get_subcommands().filter(|c| c.get_name() != "help") {
        let man = clap_mangen::Man::new(command.clone());
        let _ = man.render_name_section(&mut out);
        let _ = man.render_synopsis_section(&mut out);
        let _ = man.render_options_section(&mut out);
    }
    String::from_utf8_lossy(&out).into_owned()
}

/// Prints to standard output. Where nobody reads on, the command still ends with the status of what it found.
fn print(text: &str) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    let text = render::terminal(text);
    let end = if text.ends_with('\n') { "" } else { "\n" };
    let written = out
        .write_all(text.as_bytes())
        .and_then(|()| out.write_all(end.as_bytes()))
        .and_then(|()| out.flush());
    match written {
        Err(e) if e.kind() != std::io::ErrorKind::BrokenPipe => Err(Failure::Output(e.to_string())),
        _ => Ok(()),
    }
}

/// Tells people what is wrong, no longer than a screen. That nobody may be there to hear it changes nothing.
fn complain(message: &str) {
    let message = render::screen(message);
    let _ = writeln!(std::io::stderr(), "{message}");
}
