//! What a command works out: a scene in, text or JSON out, with no file, terminal or process. The command line prints it;
//! programs that hold carom in their own process ask it.
//!
//! A refusal is words without the name of the file; whoever has the file puts it in front.

mod lines;
mod printed;
mod read;
mod sheet;

use std::collections::BTreeMap;

use crate::derive::friction::table;
use crate::expr::effort;
use crate::render::friction::Shown;
use crate::render::{self, json::versioned};
use crate::scene::{self, Scene};
use crate::story::{self, Told};
use crate::worked::{self, Worked};
use crate::{answer, numeric, verify};

pub use lines::{Lines, refuse};
pub use printed::printed;
pub use read::read;
pub use sheet::{only_quantity, sheet};

/// How a result is written.
#[derive(Clone, Copy, PartialEq, Eq, Debug, clap::ValueEnum)]
pub enum Format {
    /// For people.
    Text,
    /// For programs.
    Json,
}

/// What a command found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Output {
    /// The result, in the format asked for.
    pub text: String,
    /// 0 done and everything held; 1 something does not hold; 3 undecided.
    pub status: u8,
}

impl Output {
    fn new(text: String, holds: bool) -> Output {
        let status = u8::from(!holds);
        Output { text, status }
    }
}

/// Which numbers are wanted.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Numbers {
    /// Doubles.
    Doubles,
    /// Fractions.
    Exact,
    /// The double nearest to each true value.
    Certified,
}

/// Reads a scene and puts values in, each as `name=value`; `name` is what its messages call the scene.
pub fn scene(name: &str, text: &str, set: &[String]) -> Result<Scene, String> {
    let mut scene = scene::read(text).map_err(|faults| faults.render(name, text))?;
    let mut values = Vec::new();
    for assignment in set {
        let Some((symbol, value)) = assignment.split_once('=') else {
            return Err(format!(
                "--set {assignment}: expected NAME=VALUE, such as v=2"
            ));
        };
        values.push((symbol.trim(), value.trim()));
    }
    scene::set_all(&mut scene, values.iter().copied()).map_err(|unfit| {
        let (about, fault) = *unfit;
        let of = |(name, _): &&(&str, &str)| about.is_none_or(|about| about == *name);
        let given = values.iter().filter(of);
        let given = given.map(|(name, value)| format!("--set {name}={value}"));
        let given: Vec<String> = given.collect();
        let why = with_hint(&fault.message, fault.hint.as_deref());
        format!("{}: {why}", given.join(" "))
    })?;
    scene::values_fit(&scene).map_err(|fault| with_hint(&fault.message, fault.hint.as_deref()))?;
    Ok(scene)
}

fn with_hint(message: &str, hint: Option<&str>) -> String {
    match hint {
        Some(hint) => format!("{message}\nhint: {hint}"),
        None => message.to_string(),
    }
}

/// Derives the closed forms a scene asks for, and proves them.
pub fn derive(scene: &Scene, format: Format) -> Result<Output, String> {
    if scene.friction().is_some() {
        return effort::of_scene(|| cases(scene, format));
    }
    let worked = worked::out(scene)?;
    let text = match format {
        Format::Text => {
            let noted = [Vec::new(), worked.strange.clone()];
            render::text::noted(&noted) + &render::text::told(scene, &worked.told)
        }
        Format::Json => {
            let mut told = render::json::told(scene, &worked.told);
            told["notes"] = serde_json::json!(worked.strange);
            versioned(&told)
        }
    };
    Ok(Output::new(text, worked.holds()))
}

/// Derives every case that a scene with friction is about.
fn cases(scene: &Scene, format: Format) -> Result<Output, String> {
    let table = table(scene).map_err(|stop| stop.to_string())?;
    let table = table.ok_or("no contact has friction")?;
    let judged = verify::friction::judge(scene, &table);
    let mut shown = Vec::new();
    for i in judged.pick.cases(&table) {
        let case = &table.cases[i];
        let told = case.ends.then(|| story::tell(&case.scene)).transpose();
        let told = told.map_err(|why| why.to_string())?;
        shown.push(Shown { case, told });
    }
    let about = answer::about(scene, table.about.iter(), &BTreeMap::new())
        .map_err(|reason| reason.to_string())?;
    let text = match format {
        Format::Text => render::friction::text(scene, &table, &judged, &shown, &about),
        Format::Json => versioned(&render::friction::json(scene, &table, &judged, &shown)),
    };
    let holds = judged.supposed_holds != Some(false)
        && shown.iter().any(|s| s.told.is_some())
        && judged.checks.iter().all(|c| c.holds != Some(false))
        && shown.iter().flat_map(|s| &s.told).all(Told::is_proved);
    Ok(Output::new(text, holds))
}

/// Solves a scene in numbers, from its geometry alone; a scene with stages is followed from one to the next.
pub fn solve(scene: &Scene, numbers: Numbers, format: Format) -> Result<Output, String> {
    match (scene.has_stages(), numbers) {
        (false, _) => solve_impact(scene, numbers, format),
        (true, Numbers::Doubles) => follow(scene, format),
        (true, _) => Err(String::from(
            "a scene with stages is followed in doubles, for its motions are integrated\nhint: leave out --exact and --certify",
        )),
    }
}

fn solve_impact(scene: &Scene, numbers: Numbers, format: Format) -> Result<Output, String> {
    let found = match numbers {
        Numbers::Certified => return certified(scene, format),
        Numbers::Exact => {
            let point = numeric::exact_values(scene).map_err(|why| why.to_string())?;
            let answers = numeric::answers(scene, &point, numeric::solve_exact);
            render::exact_numbers(answers.map_err(|why| why.to_string())?)
        }
        Numbers::Doubles => {
            render::double_numbers(numeric::doubles(scene).map_err(|why| why.to_string())?)
        }
    };
    let worked = worked::to_draw(&scene.staged(worked::IMPACT), None).ok();
    let noted = [
        worked.map_or_else(Vec::new, refusals),
        verify::friction::strange(scene),
    ];
    let text = match format {
        Format::Text => render::text::noted(&noted) + &render::text::numbers(scene, &found),
        Format::Json => versioned(&render::json::noted(
            render::json::numbers(scene, &found),
            &noted,
        )),
    };
    Ok(Output::new(text, noted[0].is_empty()))
}

/// Why what the numbers tell cannot happen, as far as the stages themselves say so.
fn refusals(worked: Worked) -> Vec<String> {
    let alone = format!("{}: ", worked::IMPACT);
    let all = worked.refusals().into_iter();
    all.map(|why| why.strip_prefix(&alone).unwrap_or(&why).to_owned())
        .collect()
}

/// The double nearest to each true value.
fn certified(scene: &Scene, format: Format) -> Result<Output, String> {
    if scene.friction().is_some() {
        return Err(String::from(
            "an impact with friction is not rounded for sure\nhint: take --exact, which decides its mode in fractions",
        ));
    }
    let answers = numeric::correct(scene).map_err(|why| why.to_string())?;
    let text = match format {
        Format::Text => render::certified::text(scene, &answers),
        Format::Json => versioned(&render::certified::json(scene, &answers)),
    };
    // An answer that could not be rounded for sure is an undecided one.
    let status = if answers.is_complete() { 0 } else { 3 };
    Ok(Output { text, status })
}

/// Follows a scene with stages in numbers; a stage that is lost does not hold.
fn follow(scene: &Scene, format: Format) -> Result<Output, String> {
    let point = numeric::follow::values(scene)
        .map_err(|missing| numeric::NoPoint::Missing(missing).to_string())?;
    let followed = numeric::follow(scene, &point).map_err(|undefined| undefined.to_string())?;
    let noted = match worked::to_draw(scene, None).map(Worked::weighed) {
        Ok(worked) => {
            let strange = worked.strange.clone();
            [refusals(worked), strange]
        }
        Err(why) => {
            let why = why.lines().next().unwrap_or_default();
            [
                Vec::new(),
                vec![format!("not judged whether all of it can be: {why}")],
            ]
        }
    };
    let text = match format {
        Format::Text => {
            let numbers = render::stages::text(scene, &followed, &point);
            render::text::noted(&noted) + &numbers
        }
        Format::Json => {
            let numbers = render::stages::json(scene, &followed, &point);
            versioned(&render::json::noted(numbers, &noted))
        }
    };
    let is_possible = |passed: &numeric::follow::Passed| passed.is_possible();
    let mut stages = followed.stages.iter();
    let holds = stages.all(|s| s.as_ref().is_ok_and(is_possible));
    Ok(Output::new(text, holds && noted[0].is_empty()))
}
