//! Replays the steps of a scene with stages: every impact by itself, with the motion that goes into it, and the whole in
//! doubles, stage by stage.
//!
//! In: the scene, and what the solution says goes into each impact. The scene is followed from its beginning by
//! [`mod@crate::numeric::follow`], which knows nothing of the solution. Where the solution hands on another place or motion than
//! is found there, that is a failure like any other.

use std::collections::BTreeMap;

use serde_json::Value;

use super::replay::holds;
use super::{Claim, Meaning, POINTS, Report, Unusable, meanings};
use crate::dimension::Dimension;
use crate::domain::Domain;
use crate::expr::{Expr, Point, Symbol};
use crate::formula::Symbols;
use crate::numeric;
use crate::numeric::follow::{self, BodyState, Passed, Sizes, What};
use crate::scene::{Mode, Parameter, Scene, StageKind};

/// Points looked at before a motion that does not get to its end is given up.
const TRIES: u64 = 120;
/// The first of them are of ordinary size, the others of all sizes.
const ORDINARY: u64 = 40;
/// Relative difference between what is handed on and what is found.
const CLOSE: f64 = 1e-7;

/// An impact as the solution tells it.
pub(super) struct Impact {
    /// Name that steps refer to.
    pub name: String,
    /// Index of its stage.
    stage: usize,
    /// Names of the supports and strings that act.
    active: Vec<String>,
    /// What a contact with friction does.
    pub mode: Option<String>,
    /// Its scene, with the places and the motion that go in.
    pub scene: Scene,
    /// What its symbols stand for.
    pub meanings: BTreeMap<Symbol, Meaning>,
    /// Symbols for what is handed on, with their values in parameters.
    handed: BTreeMap<Symbol, Expr>,
    /// Answers to earlier stages in its formulas, with their values in parameters.
    earlier: BTreeMap<Symbol, Expr>,
    /// What must be ≥ 0 for it, and for the motions before it.
    pub needs: Vec<Expr>,
}

/// Reads the impacts of a solution.
pub(super) fn impacts(scene: &Scene, value: &Value) -> Result<Vec<Impact>, Unusable> {
    if !scene.has_stages() {
        return Ok(Vec::new());
    }
    let all = value.as_array().into_iter().flatten();
    all.map(|v| impact(scene, v)).collect()
}

fn impact(scene: &Scene, value: &Value) -> Result<Impact, Unusable> {
    let name = value["name"].as_str().unwrap_or_default().to_string();
    let wrong = |what: &str| Unusable(format!("impact `{name}`: {what}"));
    let stage = value["stage"].as_str();
    let index = (scene.stages.iter()).position(|s| Some(s.name.as_str()) == stage);
    let index = index.ok_or_else(|| wrong("the scene has no such stage"))?;
    let stage = &scene.stages[index];
    let StageKind::Impact { one_sided, .. } = &stage.kind else {
        return Err(wrong("that stage is a motion"));
    };
    let of = format!("impact `{name}`");
    let read = |text: &Value, symbols: &Symbols| super::read(text, symbols, &of);
    let mut symbols = parameters(scene);
    let open: Vec<Symbol> = (value["open"].as_array().into_iter().flatten())
        .filter_map(|v| v.as_str().map(Symbol::from))
        .collect();
    open.iter().for_each(|symbol| symbols.declare(symbol));
    let mut handed = BTreeMap::new();
    for (symbol, v) in value["handed"].as_object().into_iter().flatten() {
        if scene.parameter(symbol).is_some() {
            return Err(wrong(&format!("{symbol} is a parameter")));
        }
        handed.insert(Symbol::from(symbol.as_str()), read(v, &symbols)?);
    }
    handed.keys().for_each(|symbol| symbols.declare(symbol));
    let mut places = BTreeMap::new();
    for (body, names) in scene.bodies.iter().zip(&stage.places) {
        let before = &value["before"][body.name.as_str()];
        let parts = [&before["center"][0], &before["center"][1], &before["angle"]];
        for (symbol, part) in names.iter().zip(parts) {
            if !body.is_fixed() {
                places.insert(symbol.clone(), read(part, &symbols)?);
            }
        }
    }
    let mut earlier = BTreeMap::new();
    for name in stage.earlier.iter().filter(|name| !open.contains(name)) {
        earlier.insert(name.clone(), read(&value["earlier"][&**name], &symbols)?);
    }
    places.extend(earlier.clone());
    let placed = stage.placed(&places);
    let mut out = placed.scene;
    out.domains = scene.domains.clone();
    for symbol in open.iter().chain(handed.keys()) {
        out.parameters.push(plain(symbol));
    }
    for symbol in &open {
        out.domains.symbols.insert(symbol.clone(), Domain::real());
    }
    for (symbol, value) in &handed {
        let side = side(scene, value);
        out.domains.symbols.insert(symbol.clone(), side);
    }
    for body in out.bodies.iter_mut().filter(|b| !b.is_fixed()) {
        let before = &value["before"][body.name.as_str()];
        let [x, y] = [0, 1].map(|k| read(&before["velocity"][k], &symbols));
        body.velocity = [x?, y?];
        body.spin = read(&before["spin"], &symbols)?;
    }
    let active = names(&value["active"]);
    let StageKind::Impact { one_sided: at, .. } = &placed.kind else {
        return Err(wrong("that stage is a motion"));
    };
    for name in &active {
        let found = one_sided.iter().position(|o| o.name == *name);
        let found = found.ok_or_else(|| wrong("no such support or string"))?;
        out.contacts.push(at[found].acting());
    }
    let meanings = meanings(&out, &value["symbols"])?;
    Ok(Impact {
        name,
        stage: index,
        active,
        mode: value["mode"].as_str().map(String::from),
        scene: out,
        meanings,
        handed,
        earlier,
        needs: needs(scene, &value["needs"])?,
    })
}

/// The numbers of the sign that a value handed on has where it is tried.
fn side(scene: &Scene, value: &Expr) -> Domain {
    let mut needed = numeric::Needed::default();
    needed.add(value);
    let at = |seed| numeric::rounded(&numeric::random_point(&needed, &scene.domains, seed));
    let seen = (1..=ORDINARY).filter_map(|seed| value.evaluate(&at(seed)));
    let seen: Vec<f64> = seen.collect();
    if seen.iter().all(|v| *v > 0.0) {
        Domain::positive()
    } else if seen.iter().all(|v| *v < 0.0) {
        Domain::negative()
    } else {
        Domain::real()
    }
}

/// Reads what a solution supposes to be ≥ 0. Steps are held against points where it is.
pub(super) fn needs(scene: &Scene, list: &Value) -> Result<Vec<Expr>, Unusable> {
    let symbols = parameters(scene);
    let all = list.as_array().into_iter().flatten();
    all.map(|v| super::read(v, &symbols, "`needs`")).collect()
}

fn parameters(scene: &Scene) -> Symbols {
    let mut symbols = Symbols::strict();
    let names = scene.parameters.iter().map(|p| &p.name);
    names.for_each(|name| symbols.declare(name));
    symbols
}

fn names(list: &Value) -> Vec<String> {
    let all = list.as_array().into_iter().flatten();
    all.filter_map(|v| v.as_str().map(String::from)).collect()
}

/// A parameter of which nothing but the name matters.
fn plain(name: &Symbol) -> Parameter {
    Parameter {
        name: name.clone(),
        latex: None,
        unit: String::new(),
        dimension: Dimension::none(),
        value: None,
        meaning: String::new(),
    }
}

/// Replays what belongs to no single impact, and holds what is handed on against the scene followed from its beginning.
pub(super) fn replay(
    scene: &Scene,
    impacts: &[Impact],
    meanings: &BTreeMap<Symbol, Meaning>,
    (claims, needs): (&[&Claim], &[Expr]),
    report: &mut Report,
) {
    let mut needed = numeric::needed(scene);
    let parameters = scene.parameters.iter().map(|p| p.name.clone());
    for symbol in follow::symbols(scene).into_iter().chain(parameters) {
        if !needed.angles.contains_key(&symbol) {
            needed.add(&Expr::symbol(&symbol));
        }
    }
    let needed = super::replay::needed(needed, meanings, claims);
    let mut points = Vec::new();
    let mut apart: Vec<Option<String>> = vec![None; impacts.len()];
    let mut compared = vec![false; impacts.len()];
    for seed in 1..=TRIES {
        if points.len() as u64 >= POINTS && compared.iter().all(|c| *c) {
            break;
        }
        let draw = match seed {
            ..=ORDINARY => numeric::random_point,
            _ => numeric::point_of_any_size,
        };
        let point = draw(&needed, &scene.domains, seed);
        let mut doubles = numeric::rounded(&point);
        let Ok(followed) = follow::follow(scene, &doubles) else {
            continue;
        };
        let stages = followed.stages.iter().map(|s| s.as_ref().ok());
        let Some(stages) = stages.collect::<Option<Vec<&Passed>>>() else {
            continue;
        };
        for (i, (impact, apart)) in impacts.iter().zip(&mut apart).enumerate() {
            let passed = stages[impact.stage];
            let goes_so = goes_so(impact, passed) && holds(&impact.needs, &doubles);
            let found = goes_so.then_some(passed);
            compared[i] |= found.is_some();
            if let (None, Some(found)) = (&apart, found) {
                let here = |name: &Symbol| follow::named(scene, &followed, name, &doubles);
                *apart = earlier_differs(impact, &doubles, here)
                    .or_else(|| differs(impact, &doubles, &found.before.bodies, &followed.sizes()));
            }
        }
        // Symbols of answers mean the first of several outcomes.
        let is_first = |passed: &Passed, i: usize| {
            let first = impacts.iter().find(|impact| impact.stage == i);
            first.is_none_or(|impact| goes_so(impact, passed))
        };
        let mut each = stages.iter().enumerate();
        if points.len() as u64 >= POINTS
            || !holds(needs, &doubles)
            || !each.all(|(i, passed)| is_first(passed, i))
        {
            continue;
        }
        for (name, meaning) in meanings {
            let Meaning::Staged(question, axis) = meaning else {
                continue;
            };
            let answer = follow::answer(scene, &followed, question, &doubles).ok();
            if let Some(value) = answer.and_then(|a| a.component(*axis)) {
                doubles.values.insert(name.clone(), value);
            }
        }
        points.push((point, doubles));
    }
    if points.is_empty() && !impacts.is_empty() {
        let what = String::from("the motion from stage to stage");
        report.open.push(what);
    }
    for ((impact, apart), compared) in impacts.iter().zip(apart).zip(compared) {
        match apart {
            // No point was found at which the scene goes this way.
            None if !compared => report.open.push(impact.name.clone()),
            Some(why) => {
                let claim = "where the bodies are and how they move into the impact";
                report.fail(&impact.name, claim, why);
            }
            None => report.held += 1,
        }
    }
    super::replay::compare(points, meanings, claims, report);
}

/// Whether the supports and strings that act are those of the outcome that the solution tells, and friction does the same.
fn goes_so(impact: &Impact, passed: &Passed) -> bool {
    match &passed.what {
        What::Impact(found) if found.mode.map(Mode::words) != impact.mode.as_deref() => false,
        What::Impact(found) => found.is_by(&impact.active),
        What::Motion(_) => true,
    }
}

/// Where the solution takes another value of an answer to an earlier stage than is found.
fn earlier_differs(
    impact: &Impact,
    at: &Point<f64>,
    found: impl Fn(&Symbol) -> Option<f64>,
) -> Option<String> {
    impact.earlier.iter().find_map(|(name, told)| {
        let (value, found) = (told.evaluate(at)?, found(name)?);
        let apart = (value - found).abs() > CLOSE * value.abs().max(found.abs());
        apart.then(|| format!("`{name}` is {value} in the solution, {found} when followed"))
    })
}

/// Where the solution lets bodies be elsewhere or move otherwise than is found.
fn differs(impact: &Impact, at: &Point<f64>, found: &[BodyState], sizes: &Sizes) -> Option<String> {
    let (extent, speed) = (sizes.length.max(1e-12), sizes.speed.max(1e-12));
    for (body, state) in impact.scene.bodies.iter().zip(found) {
        if body.is_fixed() {
            continue;
        }
        let [x, y] = &state.center;
        let [u, v] = &state.velocity;
        let pairs = [
            ("is at x =", &body.center[0], x, extent),
            ("is at y =", &body.center[1], y, extent),
            ("moves with v_x =", &body.velocity[0], u, speed),
            ("moves with v_y =", &body.velocity[1], v, speed),
        ];
        let spin = ("turns with", &body.spin, &state.spin, speed / extent);
        let turns = (!body.is_particle()).then_some(spin);
        for (words, told, found, scale) in pairs.into_iter().chain(turns) {
            let value = told.substitute(&impact.handed).evaluate(at);
            let (Some(value), Ok(found)) = (value, found) else {
                continue;
            };
            if (value - found).abs() > CLOSE * scale {
                let name = &body.name;
                let found = format!("{value} in the solution, {found} when followed");
                return Some(format!("`{name}` {words} {found}"));
            }
        }
    }
    None
}
