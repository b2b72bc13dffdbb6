//! Answers that are right for another quantity of the scene: another point, another moment, the other body.
//!
//! In: what was written. Out: what it is the answer to.

use super::super::Diagnosis;
use super::super::belief::Slip;
use super::{Trials, Written};
use crate::expr::Expr;
use crate::scene::{Ask, EnergyWhen, ImpulseAt};

/// Quantities of the scene, with their names in words.
pub(super) fn quantities(written: &Written) -> Vec<(Ask, String)> {
    let scene = written.scene;
    let mut asks: Vec<(Ask, String)> = Vec::new();
    for (b, body) in scene
        .bodies
        .iter()
        .enumerate()
        .filter(|(_, b)| !b.is_fixed())
    {
        asks.push((
            Ask::Velocity {
                body: b,
                point: None,
                along: None,
            },
            format!("velocity of the center of {}", body.name),
        ));
        if !body.is_particle() {
            asks.push((
                Ask::Spin {
                    body: b,
                    clockwise: false,
                },
                format!("spin of {}, counterclockwise", body.name),
            ));
            for p in &scene.points {
                let at = Some((p.name.clone(), p.at.clone()));
                asks.push((
                    Ask::Velocity {
                        body: b,
                        point: at,
                        along: None,
                    },
                    format!("velocity of {} moving with {}", p.name, body.name),
                ));
            }
        }
        for (when, words) in [
            (EnergyWhen::Before, "before"),
            (EnergyWhen::After, "after"),
            (EnergyWhen::Lost, "lost"),
        ] {
            asks.push((
                Ask::Energy { when, of: Some(b) },
                format!("energy of {} {words}", body.name),
            ));
        }
    }
    for (when, words) in [
        (EnergyWhen::Before, "before"),
        (EnergyWhen::After, "after"),
        (EnergyWhen::Lost, "lost"),
    ] {
        asks.push((
            Ask::Energy { when, of: None },
            format!("total kinetic energy {words}"),
        ));
    }
    for (i, c) in scene.contacts.iter().enumerate() {
        asks.push((
            Ask::Impulse {
                from: ImpulseAt::Contact(i),
                on: c.bodies[1],
                along: None,
            },
            format!("impulse at {}", c.name),
        ));
        if let Some(n) = &c.normal {
            let ask = Ask::Impulse {
                from: ImpulseAt::Contact(i),
                on: c.bodies[1],
                along: Some(n.clone()),
            };
            asks.push((ask, format!("normal impulse at {}", c.name)));
        }
    }
    for (i, h) in scene.hinges.iter().enumerate() {
        asks.push((
            Ask::Impulse {
                from: ImpulseAt::Hinge(i),
                on: h.bodies[1],
                along: None,
            },
            format!("impulse at {}", h.name),
        ));
    }
    // What is asked for is no other quantity.
    let asked = format!("{:?}", written.ask);
    asks.retain(|(ask, _)| format!("{ask:?}") != asked);
    asks
}

/// Other quantities of the scene that the answer would be right for, in words.
pub(super) fn other_quantities(
    written: &Written,
    trials: &Trials,
    asks: Vec<(Ask, String)>,
) -> Vec<Diagnosis> {
    let scene = written.scene;
    let plain = Slip {
        scene: scene.clone(),
        changes: Vec::new(),
        place: String::new(),
    };
    let mut found = Vec::new();
    for (ask, words) in asks {
        let vector = matches!(
            ask,
            Ask::Velocity { along: None, .. } | Ask::Impulse { along: None, .. }
        );
        let components: Vec<Option<usize>> = match (vector, written.values.len()) {
            (true, 2) => vec![None],
            (true, _) => vec![Some(0), Some(1)],
            (false, 1) => vec![None],
            (false, _) => continue,
        };
        for component in components {
            for sign in [1, -1] {
                let values: Vec<Expr> = written
                    .values
                    .iter()
                    .map(|v| if sign < 0 { -v } else { v.clone() })
                    .collect();
                if values.iter().all(Expr::is_zero) {
                    continue;
                }
                let other = Written {
                    scene,
                    ask: &ask,
                    component,
                    values,
                    rounding: written.rounding,
                };
                let mirrored = trials.times(f64::from(sign));
                if mirrored.fits(&other, &plain) {
                    let axis = component.map_or("", |c| [" along x", " along y"][c]);
                    let minus = if sign < 0 {
                        ", with the opposite sign"
                    } else {
                        ""
                    };
                    let message = format!("this is the {words}{axis}{minus}");
                    found.push(Diagnosis::new(
                        "OTHER_QUANTITY",
                        message,
                        "this is right for another quantity: what is asked for?",
                    ));
                    break;
                }
            }
        }
        if found.len() >= 2 {
            break;
        }
    }
    found
}
