//! `carom grade` and `carom read`: one answer, a batch of answers, or how a formula is understood.

mod batch;

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use serde_json::{Value, json};

use super::{Failure, Format, complain, files, print, read_scene, refused, versioned};
use carom::grade::entry;
use carom::grade::sheet::Sheet;
use carom::grade::{Form, Given, Options, Question, Strength, Verdict};
use carom::scene::Scene;
use carom::{command, grade, render};

/// Arguments of `carom grade`.
#[derive(Args)]
pub struct GradeArgs {
    /// Scene file the answer belongs to
    scene: Option<PathBuf>,
    /// Which of the scene's questions is answered
    #[arg(long)]
    quantity: Option<String>,
    /// The expected formula, where there is no scene
    #[arg(long, conflicts_with = "scene", allow_hyphen_values = true)]
    expected: Option<String>,
    /// The answer to judge
    #[arg(long, allow_hyphen_values = true, required_unless_present_any = ["batch", "steps"])]
    answer: Option<String>,
    /// A worked solution, one equation per line, `-` for standard input; needs a scene
    #[arg(
        long,
        value_name = "FILE",
        requires = "scene",
        conflicts_with = "answer"
    )]
    steps: Option<PathBuf>,
    /// Read JSON lines from standard input and write one JSON line for each
    #[arg(long, conflicts_with_all = ["scene", "expected", "answer", "quantity"])]
    batch: bool,
    /// Threads of a batch; by default one per core
    #[arg(long, requires = "batch")]
    pub(super) jobs: Option<usize>,
    /// How strong a proof of equality has to be
    #[arg(long, value_enum, default_value_t = Strength::Identity)]
    proof: Strength,
    /// How far a number may be off, such as 2% or 0.1 m
    #[arg(long)]
    tolerance: Option<String>,
    /// Demand on the form: simplified, factored, unit, digits=3, only=m,v; may be repeated
    #[arg(long)]
    form: Vec<String>,
    /// What a slash without brackets means: `usual` reads a tight product as standing below and tries the other way for an
    /// answer; `strict` refuses what brackets do not show
    #[arg(long, value_enum, default_value_t = SlashArg::Usual)]
    slash: SlashArg,
    /// Declare a symbol, such as v=real, e=0..1 or theta=0..pi/2; may be repeated
    #[arg(long = "symbol", value_name = "NAME=DOMAIN")]
    symbols: Vec<String>,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// Arguments of `carom read`.
#[derive(Args)]
pub struct ReadArgs {
    /// The formula
    #[arg(allow_hyphen_values = true)]
    formula: String,
    /// Scene whose symbols are in play
    #[arg(long)]
    scene: Option<PathBuf>,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// Arguments of `carom verify`.
#[derive(Args)]
pub struct VerifyArgs {
    /// Scene files with `printed` entries
    #[arg(required = true)]
    scenes: Vec<PathBuf>,
    /// A file with a list of printed things, in the form they have in a scene, held against the one scene named
    #[arg(long, value_name = "FILE")]
    answers: Option<PathBuf>,
    /// Show only what does not hold
    #[arg(long)]
    wrong: bool,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum SlashArg {
    /// 3v/2l is 3v/(2l), 1/2mv² is half of mv²; an answer may mean the other
    Usual,
    /// Brackets have to show what stands below
    Strict,
}

/// Runs `carom grade`.
pub fn run(args: &GradeArgs) -> Result<u8, Failure> {
    let options = options(args)?;
    if args.batch {
        return batch::batch(args, options);
    }
    if let (Some(scene), Some(file)) = (&args.scene, &args.steps) {
        return steps(scene, file, args, &options);
    }
    let answer = args.answer.as_deref().unwrap_or_default();
    let mut notes = Vec::new();
    let grade = match (&args.scene, &args.expected) {
        (Some(path), _) => {
            let sheet;
            (sheet, notes) = told(path, command::sheet(read_scene(path, &[])?))?;
            let name = args.quantity.clone();
            let name = name.or_else(|| command::only_quantity(&sheet));
            let name = name.ok_or_else(|| {
                let all = sheet.quantities().join(", ");
                Failure::Input(format!("--quantity is missing: one of {all}"))
            })?;
            let entry = sheet.entry(&name).map_err(Failure::Input)?;
            sheet.judge(&entry, answer, &options)
        }
        (None, Some(expected)) => {
            let grade = grade::judge(expected, answer, &question(args)?, &options);
            if grade.note == "INVALID_EXPECTED" {
                let shown = grade.error.as_ref();
                let shown = shown.map_or(grade.proof.words.clone(), |f| f.show(expected));
                return Err(Failure::Input(format!("--expected: {shown}")));
            }
            grade
        }
        (None, None) => {
            let why = "give a scene and --quantity, or --expected";
            return Err(Failure::Input(why.into()));
        }
    };
    print(&match args.format {
        Format::Text => render::grade::text(&grade, answer),
        Format::Json => versioned(&with_notes(render::grade::json(&grade, answer), &notes)),
    })?;
    Ok(match grade.verdict {
        Verdict::Equivalent => 0,
        Verdict::Different => 1,
        Verdict::Invalid => 2,
        Verdict::Undecided => 3,
    })
}

/// The answers of the scene of a file, proved; what is to be said of them goes to standard error.
pub(super) fn open(path: &Path) -> Result<Sheet, Failure> {
    sheet(path, read_scene(path, &[])?)
}

/// The same of a scene that was read.
pub(super) fn sheet(path: &Path, scene: Scene) -> Result<Sheet, Failure> {
    Ok(told(path, command::sheet(scene))?.0)
}

/// What was found of a file, its notes told on the way.
fn told<T>(
    path: &Path,
    found: Result<(T, Vec<String>), String>,
) -> Result<(T, Vec<String>), Failure> {
    let (found, notes) = found.map_err(|why| refused(path, why))?;
    for note in &notes {
        complain(&format!("{}: {note}", path.display()));
    }
    Ok((found, notes))
}

/// What is to be said of the scene that something was held against, such as that it is not possible, beside it as data.
fn with_notes(mut data: Value, notes: &[String]) -> Value {
    if !notes.is_empty() {
        data["scene_notes"] = json!(notes);
    }
    data
}

/// Longest worked solution, in bytes.
const MAX_STEPS: usize = 1 << 18;

fn steps(scene: &Path, file: &Path, args: &GradeArgs, options: &Options) -> Result<u8, Failure> {
    let text = files::read(file, MAX_STEPS)?;
    let sheet = open(scene)?;
    let mut worked = grade::steps::check(&sheet, &text, options);
    if let Some(name) = &args.quantity {
        sheet.entry(name).map_err(Failure::Input)?;
        worked.finals.retain(|(asked, _)| {
            let axis = asked.strip_prefix(name.as_str());
            axis.is_some_and(|axis| axis.is_empty() || axis.starts_with('_'))
        });
    }
    print(&match args.format {
        Format::Text => render::grade::steps_text(&worked),
        Format::Json => versioned(&render::grade::steps_json(&worked)),
    })?;
    use grade::steps::{Line, Status};
    let wrong = |l: &Line| matches!(l.status, Status::Wrong | Status::Carried(_));
    Ok(u8::from(worked.lines.iter().any(wrong)))
}

fn options(args: &GradeArgs) -> Result<Options, Failure> {
    let mut options = Options {
        strict_slash: args.slash == SlashArg::Strict,
        strength: args.proof,
        ..Options::default()
    };
    if let Some(text) = &args.tolerance {
        let read = grade::Tolerance::read(text);
        options.tolerance = Some(read.ok_or_else(|| {
            Failure::Input(format!("--tolerance {text}: expected a share such as 2%, or an amount with its unit such as 0.1 m"))
        })?);
    }
    for text in &args.form {
        let form = Form::read(text).ok_or_else(|| {
            Failure::Input(format!(
                "--form {text}: expected simplified, factored, unit, digits=3 or only=m,v"
            ))
        })?;
        options.forms.push(form);
    }
    Ok(options)
}

fn question(args: &GradeArgs) -> Result<Question, Failure> {
    let mut question = Question::default();
    for text in &args.symbols {
        let wrong = |what: &str| Failure::Input(format!("--symbol {text}: {what}"));
        let (name, domain) = text
            .split_once('=')
            .ok_or_else(|| wrong("expected NAME=DOMAIN, such as e=0..1"))?;
        if name == "pi" {
            return Err(wrong("pi is the number π, and no symbol"));
        }
        let value = match domain.split_once("..") {
            Some((low, high)) => {
                let end = |t: &str| if t.is_empty() { Value::Null } else { json!(t) };
                json!({"min": end(low), "max": end(high)})
            }
            None => json!(domain),
        };
        let read = entry::domain(&value).map_err(|what| wrong(&what))?;
        question.domains.symbols.insert(name.into(), read);
        question.symbols.push(Given::named(name));
    }
    Ok(question)
}

/// The list of printed things in a file beside the scene.
fn printed_list(path: &Path) -> Result<Vec<carom::scene::Printed>, Failure> {
    let name = path.display().to_string();
    let text = files::read(path, carom::scene::LONGEST)?;
    carom::scene::read_printed(&text).map_err(|faults| Failure::Input(faults.render(&name, &text)))
}

/// Runs `carom verify`: 0 when everything printed holds, 1 when something does not, 3 when something is not decided.
pub fn verify(args: &VerifyArgs) -> Result<u8, Failure> {
    let mut worst = 0;
    let mut all = Vec::new();
    if args.answers.is_some() && args.scenes.len() > 1 {
        let message = "--answers belongs to one scene, and several are named";
        return Err(Failure::Input(message.into()));
    }
    for path in &args.scenes {
        let mut scene = read_scene(path, &[])?;
        if let Some(answers) = &args.answers {
            scene.printed = printed_list(answers)?;
        }
        let (mut findings, notes) = told(path, command::printed(scene.clone()))?;
        for finding in &findings {
            worst = match (finding.holds, worst) {
                (Some(false), _) => 1,
                (None, 0) => 3,
                (_, worst) => worst,
            };
        }
        let total = findings.len();
        if args.wrong {
            findings.retain(|f| f.holds != Some(true));
        }
        match args.format {
            Format::Text => print(&render::printed::text(&scene, &findings, total))?,
            Format::Json => {
                let data = render::printed::json(&scene, &findings);
                all.push(with_notes(data, &notes));
            }
        }
    }
    if args.format == Format::Json {
        print(&versioned(&match all.len() {
            1 => all.remove(0),
            _ => Value::Array(all),
        }))?;
    }
    Ok(worst)
}

/// Runs `carom read`.
pub fn read(args: &ReadArgs) -> Result<u8, Failure> {
    let sheet = args.scene.as_deref().map(open).transpose()?;
    let output = command::read(&args.formula, sheet.as_ref(), args.format);
    let output = output.map_err(Failure::Input)?;
    print(&output.text)?;
    Ok(output.status)
}
