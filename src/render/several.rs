//! Laws for several contacts at once, side by side, for terminals and programs.

use std::fmt::Write;

use serde_json::{Value, json};

use super::digits;
use crate::numeric::several::{Candidate, Law};
use crate::scene::Scene;

/// What a law is called.
fn called(scene: &Scene, law: &Law) -> String {
    let names = |order: &[usize]| {
        let names = order.iter().map(|i| scene.contacts[*i].name.as_str());
        names.collect::<Vec<_>>().join(", ")
    };
    match law {
        Law::Newton => String::from("Newton, all at once"),
        Law::Moreau => String::from("Newton, where a contact pushes (Moreau)"),
        Law::Poisson => String::from("Poisson, all at once"),
        Law::Sequence(order) => format!("one after the other: {}, …", names(order)),
        Law::LinearSprings => String::from("equal linear springs"),
        Law::HertzSprings => String::from("equal springs with force δ^(3/2) (Hertz)"),
    }
}

/// What there is to say against a candidate, or for it.
fn judged(candidate: &Candidate) -> String {
    let [before, after] = candidate.energy;
    let share = |energy: f64| digits(100.0 * energy / before);
    match () {
        () if !candidate.pushes() => String::from("not possible: a contact would have to pull"),
        () if candidate.gains_energy() => format!(
            "not possible: gains {} % of the energy",
            share(after - before)
        ),
        () if after >= before * (1.0 - 1e-9) => String::from("keeps the energy"),
        () => format!("loses {} % of the energy", share(before - after)),
    }
}

/// Whether rigid bodies leave the outcome open.
fn verdict(all: &[Candidate]) -> &'static str {
    match all.iter().filter(|c| c.is_possible()).count() {
        0 | 1 => "Every law that is possible gives the same motion.",
        _ => {
            "Rigid-body mechanics does not decide between these motions; how the bodies yield where they touch does."
        }
    }
}

/// Why no springs are among the candidates.
const NO_SPRINGS: &str = "Springs between the bodies are integrated for e = 1 at every contact only: what loses energy there would have to be chosen.";

/// The candidates for the terminal.
pub fn text(scene: &Scene, all: &[Candidate]) -> String {
    let mut out = String::new();
    let _ = writeln!(out, "{}", super::heading(&scene.title, &scene.source));
    let names = scene.contacts.iter().map(|c| c.name.as_str());
    let names = names.collect::<Vec<_>>().join(", ");
    let _ = writeln!(out, "{} contacts at once: {names}\n", scene.contacts.len());
    for candidate in all {
        for law in &candidate.laws {
            let _ = writeln!(out, "{}", called(scene, law));
        }
        let impulses = scene.contacts.iter().zip(&candidate.impulses);
        let impulses = impulses.map(|(c, p)| format!("P_{} = {} N s", c.name, digits(*p)));
        let _ = writeln!(out, "    {}", impulses.collect::<Vec<_>>().join(", "));
        for (body, [u, v, w]) in scene.bodies.iter().zip(&candidate.bodies) {
            if body.is_fixed() {
                continue;
            }
            let spin = match body.is_particle() {
                true => String::new(),
                false => format!(", spin {} rad/s", digits(*w)),
            };
            let _ = writeln!(
                out,
                "    {}: velocity ({}, {}) m/s{spin}",
                body.name,
                digits(*u),
                digits(*v)
            );
        }
        let _ = writeln!(out, "    {}\n", judged(candidate));
    }
    let _ = writeln!(out, "{}", verdict(all));
    let mut laws = all.iter().flat_map(|candidate| &candidate.laws);
    if !laws.any(|law| matches!(law, Law::LinearSprings | Law::HertzSprings)) {
        let _ = writeln!(out, "{NO_SPRINGS}");
    }
    out
}

/// The candidates as data.
pub fn json(scene: &Scene, all: &[Candidate]) -> Value {
    let each = all.iter().map(|candidate| {
        let impulses = scene.contacts.iter().zip(&candidate.impulses);
        let bodies = scene.bodies.iter().zip(&candidate.bodies);
        let bodies = bodies.filter(|(b, _)| !b.is_fixed());
        json!({
            "laws": candidate.laws.iter().map(|l| called(scene, l)).collect::<Vec<_>>(),
            "impulses": impulses.map(|(c, p)| (c.name.clone(), json!(p))).collect::<serde_json::Map<_, _>>(),
            "openings": candidate.openings,
            "bodies": bodies
                .map(|(b, [u, v, w])| json!({"body": b.name, "velocity": [u, v], "spin": w}))
                .collect::<Vec<_>>(),
            "energy_before": candidate.energy[0],
            "energy_after": candidate.energy[1],
            "possible": candidate.is_possible(),
            "energy": judged(candidate),
        })
    });
    json!({
        "title": scene.title,
        "source": scene.source,
        "candidates": each.collect::<Vec<_>>(),
        "verdict": verdict(all),
    })
}
