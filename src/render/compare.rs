//! Laws of contact laid side by side at the values of a scene, for terminals, programs and as a plane of impulses.

use std::fmt::Write;

use serde_json::{Value, json};

use super::digits;
use crate::figure::{Ink, Label};
use crate::plot::{Axis, Curve, Mark, Plot, draw};
use crate::scene::Scene;
use crate::verify::compare::{Comparison, Outcome};
use crate::verify::friction::JAMS;

/// Laws side by side for the terminal.
pub fn text(scene: &Scene, c: &Comparison) -> String {
    let mut out = String::new();
    let mut say = |line: String| {
        let _ = writeln!(out, "{}", line.trim_end());
    };
    let contact = &scene.contacts[c.contact].name;
    say(super::heading(&scene.title, &scene.source));
    let s = &c.space;
    say(format!(
        "at {contact}, along t and n: a = {}, b = {}, c = {} [1/kg]; before u_t = {}, u_n = {} [m/s]; friction {}\n",
        digits(s.a),
        digits(s.b),
        digits(s.c),
        digits(s.tangential),
        digits(s.normal),
        digits(c.mu)
    ));
    let head = [
        "law",
        "P_t [N s]",
        "P_n [N s]",
        "u_t after",
        "u_n after",
        "what happens",
        "energy",
    ];
    let mut table = vec![head.map(String::from).to_vec()];
    for row in &c.rows {
        let cells = match &row.outcome {
            Ok(o) => [
                row.law.to_string(),
                digits(o.impulse[0]),
                digits(o.impulse[1]),
                digits(o.velocity[0]),
                digits(o.velocity[1]),
                o.mode.words().to_string(),
                o.energy.energy_words(row.law),
            ],
            Err(_) => {
                let mut cells = [(); 7].map(|()| String::from("–"));
                cells[0] = row.law.to_string();
                cells[5] = String::from("no answer");
                cells[6] = String::new();
                cells
            }
        };
        table.push(cells.to_vec());
    }
    let is_number = |i| (1..5).contains(&i);
    super::columns(&table, is_number)
        .into_iter()
        .for_each(&mut say);
    say(String::from(
        "\nmotion just after, v_x and v_y of the center of mass [m/s], spin [rad/s]:",
    ));
    for row in &c.rows {
        let Ok(outcome) = &row.outcome else { continue };
        let bodies = outcome
            .bodies
            .iter()
            .map(|(i, v)| format!("{} {}", scene.bodies[*i].name, v.map(digits).join(", ")));
        say(format!(
            "  {}: {}",
            row.law,
            bodies.collect::<Vec<_>>().join("; ")
        ));
    }
    let reasons: Vec<String> = c
        .rows
        .iter()
        .filter_map(|row| Some(format!("  {}: {}", row.law, row.outcome.as_ref().err()?)))
        .collect();
    if !reasons.is_empty() {
        say(String::from("\nno answer:"));
        reasons.into_iter().for_each(&mut say);
    }
    if c.rows
        .iter()
        .filter_map(|r| r.outcome.as_ref().ok())
        .any(|o| o.energy.jams)
    {
        say(format!(
            "\n{contact} {JAMS}: slip dies at once, whatever the speed of approach"
        ));
    }
    out
}

/// Laws side by side as data, with the plane of impulses as SVG.
pub fn json(scene: &Scene, c: &Comparison) -> Value {
    let outcome = |o: &Outcome| {
        let bodies = o.bodies.iter().map(|(i, [x, y, spin])| {
            json!({"body": scene.bodies[*i].name, "velocity": [x, y], "spin": spin})
        });
        let exact = o.exact.as_ref();
        json!({
            "mode": o.mode.words(),
            "impulse": o.impulse,
            "impulse_exact": exact.map(|p| p.each_ref().map(ToString::to_string)),
            "velocity_after": o.velocity,
            "bodies": bodies.collect::<Vec<_>>(),
            "energy_before": o.energy.energy_before,
            "energy_gained": o.energy.gain,
            "jams": o.energy.jams,
            "path": o.corners,
        })
    };
    let rows = c.rows.iter().map(|row| {
        let mut value = match &row.outcome {
            Ok(o) => outcome(o),
            Err(why) => json!({"reason": why.to_string()}),
        };
        value["law"] = json!(row.law);
        if let Ok(o) = &row.outcome {
            value["energy"] = json!(o.energy.energy_words(row.law));
        }
        value
    });
    let s = &c.space;
    json!({
        "title": scene.title,
        "source": scene.source,
        "contact": scene.contacts[c.contact].name,
        "contact_space": {"a": s.a, "b": s.b, "c": s.c, "u_t": s.tangential, "u_n": s.normal},
        "mu": c.mu,
        "laws": rows.collect::<Vec<_>>(),
        "plane": draw(&plane(scene, c)).ok().map(|p| p.svg),
    })
}

/// The plane of impulses: friction cone, where the contact sticks, where compression is greatest, the path, the end by each
/// law.
pub fn plane(scene: &Scene, c: &Comparison) -> Plot {
    let outcomes = || {
        c.rows
            .iter()
            .filter_map(|r| Some((r.law, r.outcome.as_ref().ok()?)))
    };
    let ends = || outcomes().map(|(_, o)| o.impulse);
    let top = ends().map(|p| p[1]).fold(0.0, f64::max) * 1.12;
    let side = ends().map(|p| p[0].abs()).fold(0.0, f64::max) * 1.5;
    let side = side.max(top * 0.35).min(top * 1.5);
    let s = &c.space;
    // The part of p·P_t + q·P_n + r = 0 inside the frame.
    let line = |i: usize, label: &str, p: f64, q: f64, r: f64| {
        let mut points: Vec<[f64; 2]> = Vec::new();
        if q != 0.0 {
            points.extend([-side, side].map(|x| [x, -(r + p * x) / q]));
        }
        if p != 0.0 {
            points.extend([0.0, top].map(|y| [-(r + q * y) / p, y]));
        }
        let slack = 1e-9 * top;
        points.retain(|[x, y]| x.abs() <= side + slack && (-slack..=top + slack).contains(y));
        points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        Curve {
            note: String::new(),
            label: Label::words(label),
            points,
            ink: Ink::Curve(i),
        }
    };
    let reach = if c.mu > 0.0 {
        top.min(side / c.mu)
    } else {
        top
    };
    let mut curves = vec![
        Curve {
            note: String::new(),
            label: Label::words("friction cone"),
            points: vec![[-c.mu * reach, reach], [0.0, 0.0], [c.mu * reach, reach]],
            ink: Ink::Curve(0),
        },
        line(1, "sticking", s.a, s.b, s.tangential),
        line(2, "compression ends", s.b, s.c, s.normal),
    ];
    let longest = outcomes()
        .filter(|(_, o)| o.corners.len() > 2)
        .max_by(|a, b| a.1.impulse[1].total_cmp(&b.1.impulse[1]));
    if let Some((_, o)) = longest {
        curves.push(Curve {
            note: String::new(),
            label: Label::words("path"),
            points: o.corners.clone(),
            ink: Ink::Curve(3),
        });
    }
    let mut marks: Vec<Mark> = Vec::new();
    for (law, o) in outcomes() {
        let near = |m: &&mut Mark| (0..2).all(|i| (m.at[i] - o.impulse[i]).abs() <= 0.01 * top);
        match marks.iter_mut().find(near) {
            Some(mark) => mark.label = Label::words(&format!("{}, {law}", mark.label.text())),
            None => marks.push(Mark {
                note: String::new(),
                at: o.impulse,
                label: Label::words(law),
                ink: Ink::Body,
            }),
        }
    }
    let contact = &scene.contacts[c.contact].name;
    Plot {
        title: format!("Impulse at {contact}"),
        x: Axis {
            label: Label::latex("P_t").then(Label::words(" (N s)")),
            range: Some([-side, side]),
            ticks: Vec::new(),
        },
        y: Axis {
            label: Label::latex("P_n").then(Label::words(" (N s)")),
            range: Some([0.0, top]),
            ticks: Vec::new(),
        },
        curves,
        marks,
    }
}
