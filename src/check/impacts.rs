//! What a solution says of its impacts: the places and the motion that go into each, and what its symbols stand for.
//!
//! In: the scene, and the JSON of the solution. Out: the scene of each impact, of which nothing is believed yet.

use std::collections::BTreeMap;

use serde_json::Value;

use super::{Meaning, Unusable, meanings};
use crate::dimension::Dimension;
use crate::domain::Domain;
use crate::expr::{Expr, Symbol};
use crate::formula::Symbols;
use crate::numeric;
use crate::scene::{Parameter, Scene, StageKind};

/// Points at which the sign of what is handed on is seen.
const SEEN: u64 = 40;

/// An impact as the solution tells it.
pub(super) struct Impact {
    /// Name that steps refer to; none where it is the whole scene.
    pub name: Option<String>,
    /// Index of its stage.
    pub stage: usize,
    /// Names of the supports and strings that act.
    pub active: Vec<String>,
    /// What a contact with friction does.
    pub mode: Option<String>,
    /// Its scene, with the places and the motion that go in.
    pub scene: Scene,
    /// What its symbols stand for.
    pub meanings: BTreeMap<Symbol, Meaning>,
    /// Symbols for what is handed on, with their values in parameters.
    pub handed: BTreeMap<Symbol, Expr>,
    /// Answers to earlier stages in its formulas, with their values in parameters.
    pub earlier: BTreeMap<Symbol, Expr>,
    /// What must be ≥ 0 for it, and for the motions before it.
    pub needs: Vec<Expr>,
}

/// Reads the impacts of a solution; a scene without stages is one.
pub(super) fn read(scene: &Scene, root: &Value) -> Result<Vec<Impact>, Unusable> {
    if !scene.has_stages() {
        return Ok(vec![Impact {
            name: None,
            stage: 0,
            active: Vec::new(),
            mode: root["mode"].as_str().map(String::from),
            scene: scene.clone(),
            meanings: meanings(scene, &root["symbols"])?,
            handed: BTreeMap::new(),
            earlier: BTreeMap::new(),
            needs: needs(&parameters(scene), &root["needs"])?,
        }]);
    }
    let all = root["impacts"].as_array().into_iter().flatten();
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
    out.carry_points(scene, |e| vanishes(scene, e), |e| e);
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
        // A place that is another one than the file leads to is held against the scene followed.
        let [x, y] = [0, 1].map(|k| read(&before["center"][k], &symbols));
        let told = [x?, y?].map(|e| e.substitute(&earlier));
        let is_same = |(told, own): (&Expr, &Expr)| told == own || vanishes(scene, &(told - own));
        if !told.iter().zip(&body.center).all(is_same) {
            body.center = told;
        }
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
        name: Some(name),
        stage: index,
        active,
        mode: value["mode"].as_str().map(String::from),
        scene: out,
        meanings,
        handed,
        earlier,
        needs: needs(&symbols, &value["needs"])?,
    })
}

/// Whether an expression is zero where it is tried.
fn vanishes(scene: &Scene, e: &Expr) -> bool {
    let mut needed = numeric::Needed::default();
    needed.add(e);
    let at = |seed| numeric::rounded(&numeric::random_point(&needed, &scene.domains, seed));
    (1..=SEEN).all(|seed| e.evaluate(&at(seed)).is_some_and(|v| v.abs() < 1e-12))
}

/// The numbers of the sign that a value handed on has where it is tried.
fn side(scene: &Scene, value: &Expr) -> Domain {
    let mut needed = numeric::Needed::default();
    needed.add(value);
    let at = |seed| numeric::rounded(&numeric::random_point(&needed, &scene.domains, seed));
    let seen = (1..=SEEN).filter_map(|seed| value.evaluate(&at(seed)));
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
pub(super) fn needs(symbols: &Symbols, list: &Value) -> Result<Vec<Expr>, Unusable> {
    let all = list.as_array().into_iter().flatten();
    all.map(|v| super::read(v, symbols, "`needs`")).collect()
}

pub(super) fn parameters(scene: &Scene) -> Symbols {
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
