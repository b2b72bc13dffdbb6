//! What a page needs to know of a scene: parameters with ranges for sliders, stages, plots, and how formulas about it are
//! understood. Where the scene cannot be read: what is wrong, and where in its text.

use serde_json::{Map, Value, json};

use crate::domain::{Domain, Limit};
use crate::expr::{Expr, Point, Symbol};
use crate::figure;
use crate::formula::{self, Content, latex_name};
use crate::grade;
use crate::render::{self, content, html, mathml, naming, symbols_of};
use crate::scene::{self, Contact, ContactLaw, Parameter, Scene, Stage, StageKind};
use crate::solution::Solution;

/// What is asked about a scene.
#[derive(Clone, Debug, Default)]
pub struct Asked {
    /// Values of parameters, name and value.
    pub set: Vec<(String, String)>,
    /// Formulas to be read.
    pub formulas: Vec<String>,
    /// Symbols in LaTeX, to be typeset.
    pub symbols: Vec<String>,
    /// The film of the scene, where it is wanted.
    pub film: Option<Filmed>,
}

/// What a film is to show beside the right motion.
#[derive(Clone, Debug, Default)]
pub struct Filmed {
    /// Name of a question, and somebody's answer to it.
    pub claim: Option<[String; 2]>,
}

/// Why a scene is not described.
#[derive(Clone, Debug)]
pub enum Wrong {
    /// It cannot be read: what is wrong, and where.
    Scene(Value),
    /// It does not take this value.
    Value(String),
}

/// Describes the scene of a text, and reads formulas about it.
pub fn describe(text: &str, asked: &Asked) -> Result<Value, Wrong> {
    let read = scene::read(text);
    let mut scene = read.map_err(|faults| Wrong::Scene(render::faults::json(&faults, text)))?;
    let set = asked.set.iter();
    let set = set.map(|(name, value)| (name.as_str(), value.as_str()));
    scene::set_all(&mut scene, set).map_err(|unfit| {
        let (name, fault) = *unfit;
        let of = name.map_or(String::new(), |name| format!("{name}: "));
        Wrong::Value(format!("{of}{}", fault.message))
    })?;
    let shown = figure::shown_at(&scene);
    let parameters = scene.parameters.iter();
    let stages = scene.stages.iter();
    let readings = asked.formulas.iter().map(|f| reading(&scene, f));
    let symbols = asked.symbols.iter();
    let outlines = figure::outlines(&scene).unwrap_or_default();
    let outlines = scene.bodies.iter().zip(outlines);
    let names = naming(&scene);
    let film = asked.film.as_ref().map(|f| film(&scene, &shown, f));
    Ok(json!({
        "title": scene.title,
        "source": scene.source,
        "statement": scene.statement,
        "statement_html": html::typeset(&scene, &names, &scene.statement),
        "parameters": parameters.map(|p| parameter(&scene, &names, p, &shown)).collect::<Vec<_>>(),
        "directions": scene.domains.unit_vectors.iter().map(|pair| pair.each_ref().map(ToString::to_string)).collect::<Vec<_>>(),
        "conditions": scene.domains.conditions(),
        "stages": stages.map(stage).collect::<Vec<_>>(),
        "has_laws": has_laws(&scene),
        "plots": scene.plots.iter().map(|p| p.name.clone()).collect::<Vec<_>>(),
        "remarks": scene.remarks,
        "readings": readings.collect::<Vec<_>>(),
        "symbols": symbols.map(|s| math(&mathml::from_latex(s))).collect::<Vec<_>>(),
        "outlines": outlines.map(|(b, lines)| json!({"body": b.name, "lines": lines})).collect::<Vec<_>>(),
        "film": film,
    }))
}

fn stage(stage: &Stage) -> Value {
    let is_impact = matches!(stage.kind, StageKind::Impact { .. });
    json!({"name": stage.name, "is_impact": is_impact, "has_laws": is_impact && has_laws(&stage.scene)})
}

/// Whether an impact has laws of contact to compare: friction, or several smooth contacts at once.
fn has_laws(scene: &Scene) -> bool {
    let smooth = |c: &Contact| matches!(c.law, ContactLaw::Frictionless { .. });
    let several = scene.contacts.len() > 1 && scene.contacts.iter().all(smooth);
    scene.friction().is_some() || several
}

/// How the bodies come to the first impact and go on after the last, with the right motion and with what somebody claims.
fn film(scene: &Scene, shown: &Point<f64>, filmed: &Filmed) -> Value {
    let value = |[name, answer]: &[String; 2]| {
        let read = formula::read(answer, &symbols_of(scene)).ok()?;
        let of = |e: &Expr| e.evaluate(shown).filter(|v| v.is_finite());
        let value = match read.content.answer() {
            Content::Vector([x, y, _]) => [of(x)?, of(y)?],
            other => [of(other.expr()?)?, 0.0],
        };
        Some((name.clone(), value))
    };
    let claim = filmed.claim.as_ref().and_then(value);
    let claim = claim.as_ref().map(|(name, value)| (name.as_str(), *value));
    let film = figure::film(scene, claim);
    let part = |moments: &[figure::Moment]| {
        let each = moments.iter();
        each.map(|(time, poses)| json!({"time": time, "poses": poses}))
            .collect::<Vec<_>>()
    };
    let end = |e: &figure::End| json!({"body": e.body.map(|b| &scene.bodies[b].name), "at": e.at, "turns": e.turns});
    let string = |s: &figure::Taut| json!({"stage": s.stage, "ends": s.ends.each_ref().map(end)});
    json!({
        "strings": film.strings.iter().map(string).collect::<Vec<_>>(),
        "bodies": scene.bodies.iter().map(|b| &b.name).collect::<Vec<_>>(),
        "before": part(&film.before),
        "after": part(&film.after),
        "claimed": part(&film.claimed),
        "standing": film.standing,
    })
}

fn parameter(scene: &Scene, names: &Solution, p: &Parameter, shown: &Point<f64>) -> Value {
    let scale = p.scale().evaluate(&Point::<f64>::default()).unwrap_or(1.0);
    let value = shown.values.get(&p.name).copied().unwrap_or(1.0) / scale;
    let domain = scene.domains.symbols.get(&p.name);
    let [min, max, step] = match scene.counts_turns(&p.name) {
        true => [1.0, (3.0 * value).max(10.0), 1.0],
        false => range(domain, value, scale, &p.unit),
    };
    // A number in the SI needs its unit beside it where the parameter has another.
    let si = (scale != 1.0).then(|| {
        if p.is_angle() {
            "rad".into()
        } else {
            p.dimension.spoken()
        }
    });
    let latex = p.latex.clone().unwrap_or_else(|| latex_name(&p.name));
    let domain = domain.filter(|d| **d != Domain::real());
    let domain = domain.map(|d| d.words(&p.name));
    let mut about: Vec<String> = domain.iter().map(|d| d.replace("pi", "π")).collect();
    if !p.meaning.is_empty() {
        about.insert(0, p.meaning.clone());
    }
    json!({
        "name": *p.name,
        "mathml": math(&mathml::from_latex(&latex)),
        "unit": p.unit,
        "si": si,
        "meaning": p.meaning,
        "domain": domain,
        "about_html": html::typeset(scene, names, &about.join("; ")),
        "is_given": p.value.is_some(),
        "value": value,
        "min": min,
        "max": max,
        "step": step,
    })
}

/// The range of a slider inside the domain and its step, a power of ten; both ends are multiples of the step. Where the
/// domain has no end, three times the value that is shown is far enough.
fn range(domain: Option<&Domain>, value: f64, scale: f64, unit: &str) -> [f64; 3] {
    let end = |limit: &Option<Limit>| limit.as_ref().map(|l| (l.approximate() / scale, l.open));
    let (low, high) = domain.map_or((None, None), |d| (end(&d.low), end(&d.high)));
    let size = if value == 0.0 { 1.0 } else { value.abs() };
    let reach = match unit {
        "rad" => std::f64::consts::PI,
        _ => 3.0 * size,
    };
    let free = (None, None) == (low, high);
    let (low, low_open) = low.unwrap_or_else(|| match high {
        Some((high, _)) => (high - 3.0 * (high - value).abs().max(size), false),
        None => (-reach, false),
    });
    let (high, high_open) = high.unwrap_or(match free {
        true => (reach, false),
        false => (low + 3.0 * (value - low).abs().max(size), false),
    });
    let step = 10f64.powf(((high - low).abs().max(1e-12) / 60.0).log10().floor());
    let first = (low / step - 1e-9).ceil() + f64::from(u8::from(low_open));
    let last = (high / step + 1e-9).floor();
    // An end that is excluded, or that is no fraction and so rounded, is left to the number box.
    let last = match high_open && (last * step - high).abs() < 1e-9 * step {
        true => last - 1.0,
        false => last,
    };
    let first = match low_open && first * step - step > low + 1e-9 * step {
        true => first - 1.0,
        false => first,
    };
    [first * step, last * step, step]
}

/// How a formula is understood.
fn reading(scene: &Scene, text: &str) -> Value {
    let symbols = symbols_of(scene);
    let read = match formula::read(text, &symbols) {
        Ok(read) => read,
        Err(fault) => return json!({"error": render::grade::error(&fault, text)}),
    };
    let known = |s: &Symbol| symbols.declared().iter().any(|d| d.name == *s);
    let unknown = read.symbols().into_iter().filter(|s| !known(s));
    let notes = read.notes.iter().map(|n| n.message(text));
    let names = naming(scene);
    json!({
        "plain": grade::show(&read.content),
        "mathml": math(&content::mathml(&read.content, &|e| mathml::expr(&names, e))),
        "unknown": unknown.map(|s| s.to_string()).collect::<Vec<_>>(),
        "notes": notes.collect::<Vec<_>>(),
    })
}

fn math(inner: &str) -> String {
    format!("<math>{inner}</math>")
}

/// Title and source of a scene, for lists.
pub(super) fn heading(name: &str, text: &str) -> Value {
    let mut out = Map::from_iter([("name".to_string(), json!(name))]);
    match scene::read(text) {
        Ok(scene) => {
            out.insert("title".into(), json!(scene.title));
            out.insert("source".into(), json!(scene.source));
        }
        Err(faults) => {
            let first = faults.list.first().map(|f| f.message.clone());
            out.insert("fault".into(), json!(first));
        }
    }
    Value::Object(out)
}
