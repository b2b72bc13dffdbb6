//! Replays a worked solution: at random exact points of the domain, with every symbol at the value that the independent exact
//! solution of the scene gives it, both sides of every claim must be equal.
//!
//! Comes in: the JSON of `carom solution`. Goes out: a [`Report`] that names every step that does not hold. Nothing of the
//! deriving code is used: formulas are read and evaluated, the scene inside the file is read and solved in numbers.

mod defined;
mod impacts;
mod near;
mod replay;
mod typeset;
mod whole;

use std::collections::BTreeMap;

use serde_json::Value;

use crate::expr::{Expr, Symbol};
use crate::formula::{self, Symbols};
use crate::scene::{self, Ask, BlowImpulse, ImpulseAt, Question, Scene};
use typeset::Known;

/// Points tried; a wrong claim about rational functions is equal at a random point only by a rare chance, at three hardly ever.
const POINTS: u64 = 3;
/// Largest file, in bytes.
pub const LONGEST: usize = 16 << 20;
/// Most claims in a file.
const MOST: usize = 20_000;
/// Substeps within substeps.
const DEEPEST: usize = 16;

/// The outcome.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// Steps replayed.
    pub steps: usize,
    /// Claims that hold at every point tried.
    pub held: usize,
    /// Of these, the ones that could be compared in doubles only.
    pub in_doubles: usize,
    /// Claims with one formula on both sides, which hold whatever it is.
    pub idle: usize,
    /// Claims that do not hold.
    pub failed: Vec<Failure>,
    /// Claims without a value at any point tried, by step.
    pub open: Vec<String>,
}

/// A claim that does not hold.
#[derive(Clone, Debug)]
pub struct Failure {
    /// Id of the step.
    pub step: String,
    /// The claim as the file has it.
    pub claim: String,
    /// What was found.
    pub why: String,
}

impl Report {
    fn fail(&mut self, step: &str, claim: &str, why: String) {
        self.failed.push(Failure {
            step: step.to_string(),
            claim: claim.to_string(),
            why,
        });
    }
}

/// Why a file cannot be checked at all.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unusable(pub String);

/// What a file claims.
#[derive(Default)]
struct Claims {
    equal: Vec<Claim>,
    near: Vec<near::Near>,
}

struct Claim {
    step: String,
    /// The impact its symbols belong to, in a scene with stages.
    impact: Option<String>,
    text: String,
    left: Expr,
    right: Expr,
    defines: Option<Symbol>,
    /// What must be ≥ 0 for it.
    needs: Vec<Expr>,
}

/// Replays every step of a solution file.
pub fn check(text: &str) -> Result<Report, Unusable> {
    if text.len() > LONGEST {
        let bytes = text.len();
        return unusable(format!("{bytes} bytes; a solution has at most {LONGEST}"));
    }
    let root: Value = serde_json::from_str(text).map_err(|e| Unusable(format!("not JSON: {e}")))?;
    if root["format"] != "carom solution" {
        return unusable("no solution: `format` is not \"carom solution\"");
    }
    let Some(scene_text) = root["scene"].as_str() else {
        return unusable("the text of its scene is missing");
    };
    let mut scene =
        scene::read(scene_text).map_err(|faults| Unusable(faults.render("scene", scene_text)))?;
    let mut set = Vec::new();
    for value in root["set"].as_array().into_iter().flatten() {
        let Some((name, value)) = value.as_str().and_then(|v| v.split_once('=')) else {
            return unusable("`set` holds something other than NAME=VALUE");
        };
        set.push((name.trim(), value.trim()));
    }
    scene::set_all(&mut scene, set).map_err(|unfit| Unusable(unfit.1.message))?;
    scene::values_fit(&scene).map_err(|f| Unusable(f.message))?;
    // Outcomes of a scene's one impact are told as those of a stage.
    if let (false, Some(stage)) = (scene.has_stages(), root["impacts"][0]["stage"].as_str()) {
        scene = scene.staged(stage);
    }
    let impacts = impacts::read(&scene, &root)?;
    let mut symbols = BTreeMap::new();
    for impact in &impacts {
        let of = Known::of(&impact.scene, &impact.meanings, &root["spelled"]);
        symbols.insert(impact.name.clone(), of);
    }
    let whole = match scene.has_stages() {
        true => Some(meanings(&scene, &root["symbols"])?),
        false => None,
    };
    if let Some(meanings) = &whole {
        symbols.insert(None, Known::of(&scene, meanings, &root["spelled"]));
    }
    let mut report = Report::default();
    let mut claims = Claims::default();
    let Some(steps) = root["steps"].as_array() else {
        return unusable("`steps` is missing");
    };
    collect(steps, &symbols, None, &mut claims, &mut report, 0)?;
    let of = |name: Option<&String>| {
        let mine = claims.equal.iter().filter(|c| c.impact.as_ref() == name);
        mine.collect::<Vec<_>>()
    };
    for impact in &impacts {
        replay::replay(impact, &of(impact.name.as_ref()), &mut report);
    }
    if let Some(meanings) = &whole {
        let needs = impacts::needs(&impacts::parameters(&scene), &root["needs"])?;
        let claims = (&*of(None), &*needs);
        whole::replay(&scene, &impacts, meanings, claims, &mut report);
    }
    for near in &claims.near {
        near::replay(&scene, near, &mut report);
    }
    Ok(report)
}

fn unusable<T>(message: impl Into<String>) -> Result<T, Unusable> {
    Err(Unusable(message.into()))
}

/// What a symbol stands for: a question to the motion, and the component of its answer.
enum Meaning {
    Asked(Ask, Option<usize>),
    /// A question to the motion at the end of a stage: its index, and that of the question there.
    Staged(Question, Option<usize>),
    Defined,
}

fn meanings(scene: &Scene, symbols: &Value) -> Result<BTreeMap<Symbol, Meaning>, Unusable> {
    let mut out = BTreeMap::new();
    for (name, value) in symbols.as_object().into_iter().flatten() {
        if scene.parameter(name).is_some() {
            return unusable(format!("symbol {name} is a parameter of the scene"));
        }
        let meaning = meaning(scene, value)
            .ok_or_else(|| Unusable(format!("symbol {name} stands for nothing in the scene")))?;
        out.insert(Symbol::from(name.as_str()), meaning);
    }
    Ok(out)
}

fn meaning(scene: &Scene, value: &Value) -> Option<Meaning> {
    let body = |v: &Value| {
        let name = v.as_str()?;
        scene.bodies.iter().position(|b| b.name == name)
    };
    let axis = ["x", "y"].iter().position(|a| value["axis"] == **a);
    if value["defined"] == true {
        return Some(Meaning::Defined);
    }
    if let Some(body) = body(&value["velocity"]) {
        let ask = Ask::Velocity {
            body,
            point: None,
            along: None,
        };
        return Some(Meaning::Asked(ask, Some(axis?)));
    }
    if let Some(body) = body(&value["spin"]) {
        let clockwise = value["clockwise"] == true;
        return Some(Meaning::Asked(Ask::Spin { body, clockwise }, None));
    }
    if let Some(question) = value["answer"].as_str() {
        let found = scene.question(question)?;
        return found.ask.is_motion().then(|| match found.stage {
            Some(_) => Meaning::Staged(found.clone(), axis),
            None => Meaning::Asked(found.ask.clone(), axis),
        });
    }
    let place = value["impulse"].as_str()?;
    let on = body(&value["on"])?;
    let mut all = scene.acting();
    let from = all
        .find(|one| one.name == place && one.bodies.contains(&on))?
        .from;
    let direction = match from {
        ImpulseAt::Contact(c) => scene.contacts[c].normal.clone(),
        ImpulseAt::Hinge(_) => None,
        ImpulseAt::Blow(i) => {
            let (BlowImpulse::Given(v) | BlowImpulse::Along(v)) = &scene.blows[i].impulse;
            Some(v.clone())
        }
    };
    let along = match axis {
        Some(_) => None,
        None => Some(direction?),
    };
    Some(Meaning::Asked(Ask::Impulse { from, on, along }, axis))
}

fn collect(
    steps: &[Value],
    symbols: &BTreeMap<Option<String>, Known>,
    within: Option<&str>,
    claims: &mut Claims,
    report: &mut Report,
    depth: usize,
) -> Result<(), Unusable> {
    if depth > DEEPEST {
        return unusable(format!("substeps lie more than {DEEPEST} deep"));
    }
    for step in steps {
        report.steps += 1;
        let id = step["id"].as_str().unwrap_or("?").to_string();
        let impact = step["impact"].as_str().or(within);
        let Some(known) = symbols.get(&impact.map(String::from)) else {
            return unusable(format!("step {id} belongs to an impact that is not there"));
        };
        let of = format!("step {id}");
        let defines = step["defines"].as_str().map(Symbol::from);
        let needs = step["needs"].as_array().into_iter().flatten();
        let needs = needs.map(|need| read(need, &known.symbols, &of));
        let needs: Vec<Expr> = needs.collect::<Result<_, _>>()?;
        let is_of_a_case = defines.as_deref().is_some_and(defined::is_case);
        for list in ["before", "after"] {
            for claim in step[list].as_array().into_iter().flatten() {
                let side = |name: &str| read(&claim[name], &known.symbols, &of);
                let (left, right) = (side("left")?, side("right")?);
                let defines = match (&defines, list) {
                    (Some(name), "after") if left.as_symbol() == Some(name) => Some(name.clone()),
                    _ => None,
                };
                if let Some(why) = typeset::differs(claim, &left, &right, known) {
                    report.fail(&id, &claim["latex"].to_string(), why);
                }
                if left == right {
                    report.idle += 1;
                    continue;
                }
                claims.equal.push(Claim {
                    step: id.clone(),
                    impact: impact.map(String::from),
                    text: written(claim, "="),
                    left,
                    right,
                    // Where an answer of a case is that, what else a step says of it holds anyway.
                    needs: match is_of_a_case && defines.is_none() {
                        true => Vec::new(),
                        false => needs.clone(),
                    },
                    defines,
                });
                if claims.equal.len() > MOST {
                    return unusable(format!("more than {MOST} claims"));
                }
            }
        }
        for claim in step["near"].as_array().into_iter().flatten() {
            if claims.near.len() >= MOST {
                return unusable(format!("more than {MOST} claims"));
            }
            let defining = defines.is_some().then_some(step);
            let near = near::read(claim, defining, &known.symbols, &id)?;
            claims.near.push(near);
        }
        if let Some(inner) = step["substeps"].as_array() {
            collect(inner, symbols, impact, claims, report, depth + 1)?;
        }
    }
    Ok(())
}

/// A claim as the file has it, with a sign between its sides.
fn written(claim: &Value, sign: &str) -> String {
    let [left, right] = ["left", "right"].map(|side| claim[side].as_str().unwrap_or_default());
    format!("{left} {sign} {right}")
}

/// A formula of a step or of an impact.
fn read(text: &Value, symbols: &Symbols, of: &str) -> Result<Expr, Unusable> {
    let text = text.as_str().unwrap_or_default();
    let read = formula::read_expr(text, symbols);
    read.map_err(|fault| Unusable(format!("{of}: `{text}` cannot be read: {}", fault.message)))
}
