//! A worked solution as data: the scene it belongs to, what its symbols stand for, and every step as a claim that another
//! program can replay. `carom check` reads this.

use std::collections::BTreeMap;

use serde_json::{Map, Value, json};

use super::math::latex;
use crate::expr::{Expr, Symbol};
use crate::formula::write_plain;
use crate::solution::{Claim, Math, Meaning, Scope, Solution, Step};

/// The whole solution. `scene` is the text of the scene file, `set` the values given besides.
pub fn solution(s: &Solution, scene: &str, set: &[String]) -> Value {
    let mut out = json!({
        "format": "carom solution",
        "version": super::VERSION,
        "title": s.title,
        "source": s.source,
        "scene": scene,
        "set": set,
        "symbols": symbols(&s.meanings),
        "spelled": spelled(s),
        "assumptions": s.assumptions,
        "needs": needs(&s.needs),
        "steps": s.steps.iter().map(|x| step(s, x)).collect::<Vec<_>>(),
    });
    if let Some(mode) = s.mode {
        out["mode"] = json!(mode.words());
    }
    if !s.scopes.is_empty() {
        out["impacts"] = s.scopes.iter().map(scope).collect();
    }
    out
}

/// Spellings of symbols in LaTeX, where they have one of their own.
fn spelled(s: &Solution) -> Map<String, Value> {
    let each = s.names.iter();
    each.map(|(name, latex)| (name.to_string(), json!(latex)))
        .collect()
}

fn symbols(meanings: &BTreeMap<Symbol, Meaning>) -> Map<String, Value> {
    let each = meanings.iter();
    each.map(|(name, m)| (name.to_string(), meaning(m)))
        .collect()
}

/// What must be ≥ 0.
fn needs(all: &[Expr]) -> Vec<String> {
    all.iter().map(write_plain).collect()
}

/// An impact of a scene with stages: what goes into it, so that its steps can be replayed by themselves.
fn scope(x: &Scope) -> Value {
    let before: Map<String, Value> = x
        .before
        .iter()
        .map(|b| {
            let motion = json!({
                "center": b.center.each_ref().map(write_plain),
                "angle": write_plain(&b.angle),
                "velocity": b.velocity.each_ref().map(write_plain),
                "spin": write_plain(&b.spin),
            });
            (b.body.clone(), motion)
        })
        .collect();
    let values = |all: &BTreeMap<Symbol, Expr>| -> Map<String, Value> {
        let each = all.iter();
        each.map(|(name, value)| (name.to_string(), json!(write_plain(value))))
            .collect()
    };
    let mut out = json!({
        "name": x.name,
        "stage": x.stage,
        "active": x.active,
        "handed": values(&x.handed),
        "earlier": values(&x.earlier),
        "open": x.open.iter().map(ToString::to_string).collect::<Vec<_>>(),
        "before": before,
        "needs": needs(&x.needs),
        "symbols": symbols(&x.meanings),
    });
    if let Some(mode) = x.mode {
        out["mode"] = json!(mode.words());
    }
    out
}

fn meaning(m: &Meaning) -> Value {
    const AXES: [&str; 2] = ["x", "y"];
    match m {
        Meaning::Velocity(body, axis) => json!({"velocity": body, "axis": AXES[*axis]}),
        Meaning::Spin(body, clockwise) => json!({"spin": body, "clockwise": clockwise}),
        Meaning::Impulse(at, on, axis) => {
            json!({"impulse": at, "on": on, "axis": axis.map(|a| AXES[a])})
        }
        Meaning::Answer(question, axis) => {
            json!({"answer": question, "axis": axis.map(|a| AXES[a])})
        }
        Meaning::Defined => json!({"defined": true}),
    }
}

fn step(s: &Solution, x: &Step) -> Value {
    let claims = |list: &[Claim]| list.iter().map(|c| claim(s, c)).collect::<Vec<_>>();
    let mut out = json!({
        "id": x.id,
        "before": claims(&x.before),
        "after": claims(&x.after),
        "reason": x.reason,
        "impact": x.scope,
        "assumptions": x.assumptions,
        "defines": x.defines.as_deref(),
        "near": x.near.iter().map(|n| json!({
            "left": write_plain(&n.left),
            "right": write_plain(&n.right),
            "parameter": *n.parameter,
            "to": n.to.as_ref().map_or_else(|| String::from("infinity"), write_plain),
            "order": n.order,
        })).collect::<Vec<_>>(),
        "substeps": x.substeps.iter().map(|y| step(s, y)).collect::<Vec<_>>(),
    });
    if !x.needs.is_empty() {
        out["needs"] = json!(needs(&x.needs));
    }
    out
}

fn claim(s: &Solution, c: &Claim) -> Value {
    let math = [
        Math::Expr(c.left.clone()),
        Math::Op("="),
        Math::Expr(c.right.clone()),
    ];
    json!({
        "left": write_plain(&c.left),
        "right": write_plain(&c.right),
        "latex": latex(s, &math),
    })
}
