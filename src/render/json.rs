//! The answers of a scene as data, for programs. The shape is stable; fields are only ever added.

use serde_json::{Map, Value, json};

use super::latex;
use crate::answer::{Answer, Form, Matrix};
use crate::derive::{Derivation, Equation};
use crate::expr::{Expr, Symbol};
use crate::formula::{Sentence, write_plain};
use crate::laws;
use crate::scene::Scene;
use crate::story::{Case, StageTold, Told};

/// An object, or each of a list, as JSON with the version in front.
pub fn versioned(value: &Value) -> String {
    let with_version = |value: &Value| {
        let mut out = Map::from_iter([("version".to_string(), super::VERSION.into())]);
        out.extend(value.as_object().cloned().unwrap_or_default());
        Value::Object(out)
    };
    super::pretty(&match value {
        Value::Array(all) => all.iter().map(with_version).collect(),
        one => with_version(one),
    })
}

/// What was told as data: one impact with its equations, or answers with the stages beside them.
pub fn told(scene: &Scene, told: &Told) -> Value {
    if let Some(impact) = told.alone() {
        return self::impact(scene, told, impact);
    }
    let mut refusals = told.refusals();
    refusals.extend(told.ended.iter().map(ToString::to_string));
    json!({
        "title": scene.title,
        "source": scene.source,
        "admissible": refusals.is_empty(),
        "refusals": refusals,
        "answers": told.answers.iter().map(|a| answer(scene, told, a)).collect::<Vec<_>>(),
        "stages": told.stages.iter().map(|s| stage(scene, s)).collect::<Vec<_>>(),
        "readings": told.readings,
        "unused": told.unused.iter().map(|s| &**s).collect::<Vec<_>>(),
        "remarks": scene.remarks,
        "verified": told.holds(),
    })
}

fn stage(scene: &Scene, s: &StageTold) -> Value {
    let bodies: Vec<Value> = scene
        .bodies
        .iter()
        .enumerate()
        .filter(|(_, b)| !b.is_fixed())
        .map(|(i, b)| {
            let state = |s: &crate::story::State| {
                json!({
                    "center": [write_plain(&s.center[i][0]), write_plain(&s.center[i][1])],
                    "velocity": [write_plain(&s.velocity[i][0]), write_plain(&s.velocity[i][1])],
                    "spin": write_plain(&s.spin[i]),
                })
            };
            json!({"body": b.name, "before": state(&s.before), "after": state(&s.after)})
        })
        .collect();
    json!({
        "name": s.name,
        "kind": s.placed.kind.word(),
        "during": s.placed.during.as_ref().map(|during| &during.name),
        "words": plain(&s.words),
        "conserved": s.kept.iter().map(|k| json!({"what": k.what, "conserved": k.conserved, "why": k.why.to_string()})).collect::<Vec<_>>(),
        "cases": s.cases.iter().map(|c| case(scene, c)).collect::<Vec<_>>(),
        "energy": s.energy.as_ref().map(|[a, b]| json!({"before": write_plain(a), "after": write_plain(b)})),
        "bodies": bodies,
        "assumptions": plain(&s.assumptions),
        "checks": s.checks,
    })
}

/// An outcome of an impact, with the equations it took.
fn case(scene: &Scene, case: &Case) -> Value {
    let conditions = case.conditions.iter();
    let conditions = conditions.map(|(why, e)| format!("{} >= 0 ({why})", write_plain(e)));
    let mut out = object(json!({
        "active": case.active,
        "conditions": conditions.collect::<Vec<_>>(),
        "verified": case.proof.holds(),
        "admissible": super::possible::json(scene, &case.possible),
    }));
    let (asked, derivation) = case.asked(&[]);
    out.extend(equations(&asked, &derivation));
    Value::Object(out)
}

fn plain(all: &[Sentence]) -> Vec<String> {
    all.iter().map(ToString::to_string).collect()
}

/// Everything about the one impact of a scene, its derivation and its proof.
fn impact(scene: &Scene, told: &Told, impact: &Case) -> Value {
    let Case {
        derivation,
        proof,
        possible,
        ..
    } = impact;
    let answers = told.answers.iter();
    let answers = answers.map(|a| answer(scene, told, a));
    let mut out = object(json!({
        "title": scene.title,
        "source": scene.source,
        "answers": answers.collect::<Vec<_>>(),
    }));
    out.extend(equations(scene, derivation));
    out.extend(object(json!({
        "assumptions": super::assumptions(scene, derivation, proof),
        "checks": proof.scene,
        "admissible": super::possible::json(scene, possible),
        "verified": told.is_proved(),
    })));
    Value::Object(out)
}

/// The fields of an object.
fn object(value: Value) -> Map<String, Value> {
    match value {
        Value::Object(fields) => fields,
        _ => Map::new(),
    }
}

/// The equations that an impact took, and what it did not need.
fn equations(scene: &Scene, derivation: &Derivation) -> Map<String, Value> {
    let counting = &derivation.counting;
    let used: usize = derivation.blocks.iter().map(|b| b.equations.len()).sum();
    object(json!({
        "where": definitions(scene, derivation, None),
        "equations_used": used,
        "equations_full": counting.equations,
        "unknowns_full": counting.unknowns,
        "rank_full": counting.rank,
        "rank_with_system_balances": counting.rank_with_system,
        "determined": counting.determined(),
        "contradictory": counting.contradictory,
        "conflict": counting.conflict,
        "undetermined": counting.open.iter().map(|u| derivation.names.plain(*u)).collect::<Vec<_>>(),
        "closing_laws": counting.closing_laws,
        "blocks": derivation.blocks.iter().map(|b| json!({
            "asked_by": b.asked_by,
            "equations": b.equations.iter().map(|e| equation(scene, derivation, e)).collect::<Vec<_>>(),
            "unknowns": b.unknowns.iter().map(|u| derivation.names.plain(*u)).collect::<Vec<_>>(),
        })).collect::<Vec<_>>(),
        "left_out": derivation.left_out.iter().map(|l| json!({"what": l.what, "why": l.why})).collect::<Vec<_>>(),
    }))
}

/// The numbers of a numeric solution.
pub fn numbers(scene: &Scene, numbers: &[super::Number]) -> Value {
    let answers: Vec<Value> = numbers
        .iter()
        .map(|n| match &n.value {
            Ok(value) => json!({
                "name": n.name,
                "value": value.approximate,
                "value_exact": value.exact.as_ref().map(ToString::to_string),
                "unit": super::unit_of(scene, &n.question),
            }),
            Err(reason) => json!({"name": n.name, "value": Value::Null, "reason": reason}),
        })
        .collect();
    json!({"title": scene.title, "source": scene.source, "answers": answers})
}

/// Numbers, with why what they tell cannot happen, and with what is strange of it; each empty where nothing is.
pub fn noted(mut numbers: Value, [refusals, strange]: &[Vec<String>; 2]) -> Value {
    numbers["not_possible"] = json!(refusals);
    numbers["notes"] = json!(strange);
    numbers
}

/// A matrix with its unknowns and right sides.
pub fn matrix(m: &Matrix) -> Value {
    json!({
        "rows": m.rows,
        "unknowns": m.unknowns,
        "entries": m.entries.iter().map(|r| r.iter().map(write_plain).collect::<Vec<_>>()).collect::<Vec<_>>(),
        "rhs": m.rhs.iter().map(write_plain).collect::<Vec<_>>(),
    })
}

/// An answer: what it is, what it rests on, and how it was checked. Those of one impact may hold definitions of its derivation.
fn answer(scene: &Scene, told: &Told, a: &Answer) -> Value {
    let impact = told.alone().filter(|_| a.told.is_some());
    let derivation = impact.map(|impact| &impact.derivation);
    // The domains, how the statement is read, and its own assumptions.
    let mut assumptions = scene.domains.conditions();
    assumptions.extend(told.readings.iter().cloned());
    assumptions.extend(a.assumptions.iter().map(ToString::to_string));
    let mut out = json!({
        "name": a.name,
        "question": a.question,
        "words": a.words,
        "formula": null,
        "latex": null,
    });
    match &a.form {
        Form::Value { closed, short } => {
            out["formula"] = json!(write_plain(short));
            out["latex"] = json!(latex(scene, short));
            if let Some(derivation) = derivation.filter(|_| short != closed) {
                out["where"] = json!(definitions(scene, derivation, Some(short)));
                out["closed"] = json!(write_plain(closed));
            }
            if a.broken(scene).is_none()
                && let Some(value) = super::answer_value(scene, derivation, closed)
            {
                out["value"] = json!(value.approximate);
                if let Some(exact) = value.exact {
                    out["value_exact"] = json!(exact.to_string());
                }
            }
        }
        Form::Equation { left, right } => {
            let equation = format!("{} = {}", write_plain(left), write_plain(right));
            out["formula"] = json!(equation);
            out["equation"] = json!(equation);
            out["latex"] = json!(format!("{} = {}", latex(scene, left), latex(scene, right)));
        }
        Form::Matrix(m) => {
            out["latex"] = json!(super::latex_matrix(scene, m));
            out["matrix"] = matrix(m);
        }
        Form::Open(names) => {
            out["undetermined"] = json!(names);
        }
        Form::Words => {}
    }
    let range = a.range.iter();
    let range =
        range.map(|(s, r, e)| format!("{} {} {}", write_plain(s), r.sign(), write_plain(e)));
    let plain = |all: &[Sentence]| all.iter().map(ToString::to_string).collect::<Vec<_>>();
    for (key, all) in [
        ("range", range.collect()),
        ("text", plain(&a.text)),
        ("discarded", plain(&a.discarded)),
    ] {
        if !all.is_empty() {
            out[key] = json!(all);
        }
    }
    out["symbol"] = json!(a.latex);
    out["dimension"] = json!(a.dimension.plain());
    out["unit"] = json!(a.unit(scene));
    out["assumptions"] = json!(assumptions);
    out["checks"] = json!(a.checks);
    out
}

fn equation(scene: &Scene, derivation: &Derivation, equation: &Equation) -> Value {
    let (left, right) = super::sides(derivation, equation);
    json!({
        "law": laws::describe(scene, &equation.law),
        "formula": format!("{} = {}", write_plain(&left), write_plain(&right)),
        "latex": format!("{} = {}", latex(scene, &left), latex(scene, &right)),
    })
}

/// The definitions, or those that an expression needs, in order.
fn definitions(scene: &Scene, derivation: &Derivation, used_by: Option<&Expr>) -> Vec<Value> {
    let wanted: Option<std::collections::BTreeSet<Symbol>> = used_by.map(|e| {
        let mut names = e.symbols();
        for definition in derivation.definitions.iter().rev() {
            if names.contains(&definition.name) {
                names.extend(definition.value.symbols());
            }
        }
        names
    });
    derivation
        .definitions
        .iter()
        .filter(|d| wanted.as_ref().is_none_or(|w| w.contains(&d.name)))
        .map(|d| {
            json!({
                "name": *d.name,
                "formula": write_plain(&d.value),
                "latex": latex(scene, &d.value),
                "meaning": d.meaning,
            })
        })
        .collect()
}
