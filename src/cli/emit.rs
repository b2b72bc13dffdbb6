//! `carom emit`: closed forms as source code, arranged for accuracy.

use std::path::PathBuf;

use clap::Args;

use super::{Failure, complain, files, impact_of, print, read_scene, refused, work_out};
use carom::emit::{Heading, Language, Style, file, functions};

/// Arguments of `carom emit`.
#[derive(Args)]
pub struct EmitArgs {
    /// Scene file, `-` for standard input
    scene: PathBuf,
    /// Language of the code
    #[arg(long, value_enum, default_value_t = Language::Rust)]
    lang: Language,
    /// Only this answer, such as omega or v_x; may be repeated
    #[arg(long, value_name = "NAME")]
    quantity: Vec<String>,
    /// Only the impact of this stage; missing: the answers of all stages
    #[arg(long, value_name = "NAME")]
    stage: Option<String>,
    /// What stands before the name of every function and type
    #[arg(long, value_name = "WORD", default_value = "")]
    prefix: String,
    /// Add a function that takes one struct and gives one; in C the file is a header then
    #[arg(long = "struct")]
    record: bool,
    /// Without scaling by powers of two, where arguments from 1e-30 to 1e30 need none
    #[arg(long)]
    plain: bool,
    /// File to write instead of standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// Powers of ten that arguments may have either way where nothing is scaled.
const PLAIN_REACH: i32 = 30;

/// Runs `carom emit`: exit status 0, or 1 where the closed forms did not stand their proof and nothing is written.
pub fn run(args: &EmitArgs) -> Result<u8, Failure> {
    let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
    if !args.prefix.chars().all(is_name) || args.prefix.starts_with(|c: char| c.is_ascii_digit()) {
        let why = "cannot begin a name\nhint: take letters, digits and _, such as impact_";
        return Err(Failure::Input(format!("--prefix {}: {why}", args.prefix)));
    }
    let mut scene = read_scene(&args.scene, &[])?;
    let name = args.scene.display();
    if args.stage.is_some() {
        scene = impact_of(&scene, &args.scene, args.stage.as_deref())?;
    }
    let worked = work_out(&args.scene, &scene)?;
    let holds = worked.failed().is_empty();
    for why in worked.refusals() {
        complain(&format!("{name}: {why}"));
    }
    let assumptions = worked.assumptions();
    let (scene, derivation) = worked.sheet().map_err(|why| refused(&args.scene, why))?;
    if !holds {
        complain(&format!(
            "{name}: the closed forms are not proved, so no code is written\nhint: `carom derive` tells what failed"
        ));
        return Ok(1);
    }
    let (mut found, without) = functions(&scene, &derivation);
    let all: Vec<&str> = found.iter().map(|f| f.name.as_str()).collect();
    if let Some(unknown) = args.quantity.iter().find(|q| !all.contains(&q.as_str())) {
        let why = format!("no number {unknown}\nhint: there are {}", all.join(", "));
        return Err(refused(&args.scene, why));
    }
    found.retain(|f| args.quantity.is_empty() || args.quantity.contains(&f.name));
    if found.is_empty() {
        let why = "asks for no number with a closed form\nhint: add a question for a velocity, a spin, an impulse or an energy";
        return Err(refused(&args.scene, why));
    }
    if args.quantity.is_empty() && !without.is_empty() {
        let without = without.join(", ");
        complain(&format!(
            "{name}: no function for {without}: no closed form in numbers"
        ));
    }
    if args.plain {
        let wide = found.iter_mut().filter(|f| f.reach >= PLAIN_REACH);
        wide.for_each(|f| f.units = None);
    }
    let heading = Heading {
        title: scene.title.clone(),
        source: scene.source.clone(),
        assumptions,
    };
    let style = Style {
        language: args.lang,
        prefix: args.prefix.clone(),
        record: args.record,
    };
    let text = file(&style, &heading, &found);
    match &args.output {
        Some(path) => files::save(path, text.as_bytes(), &[&args.scene])?,
        None => print(&text)?,
    }
    Ok(0)
}
