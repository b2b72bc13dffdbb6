//! Answers that are right for another quantity of the scene: another point, another moment, the other body.
//!
//! In: what was written. Out: what it is the answer to.

use super::super::Diagnosis;
use super::super::belief::Slip;
use super::{OPPOSITE, Trials, Written};
use crate::expr::Expr;
use crate::scene::{Ask, EnergyWhen, ImpulseAt};

/// Quantities of the scene, with their names in words.
pub(super) fn quantities(written: &Written) -> Vec<(Ask, String)> {
    let scene = written.scene;
    let mut asks: Vec<(Ask, String)> = Vec::new();
    let velocity = |body, point| Ask::Velocity {
        body,
        point,
        along: None,
    };
    let energies = |of: Option<usize>, whose: &str| {
        use EnergyWhen::{After, Before, Lost};
        let each = [(Before, "before"), (After, "after"), (Lost, "lost")];
        each.map(|(when, words)| (Ask::Energy { when, of }, format!("{whose} {words}")))
    };
    let free = scene.bodies.iter().enumerate();
    for (b, body) in free.filter(|(_, b)| !b.is_fixed()) {
        let (name, clockwise) = (&body.name, false);
        let center = format!("velocity of the center of {name}");
        asks.push((velocity(b, None), center));
        if !body.is_particle() {
            let spin = Ask::Spin { body: b, clockwise };
            asks.push((spin, format!("spin of {name}, counterclockwise")));
            asks.extend(scene.points.iter().map(|p| {
                let ask = velocity(b, Some((p.name.clone(), p.at.clone())));
                (ask, format!("velocity of {} moving with {name}", p.name))
            }));
        }
        asks.extend(energies(Some(b), &format!("energy of {name}")));
    }
    asks.extend(energies(None, "total kinetic energy"));
    let impulse = |from, on, along| Ask::Impulse { from, on, along };
    for (i, c) in scene.contacts.iter().enumerate() {
        let at = |along| impulse(ImpulseAt::Contact(i), c.bodies[1], along);
        asks.push((at(None), format!("impulse at {}", c.name)));
        if let Some(n) = &c.normal {
            asks.push((at(Some(n.clone())), format!("normal impulse at {}", c.name)));
        }
    }
    asks.extend(scene.hinges.iter().enumerate().map(|(i, h)| {
        let ask = impulse(ImpulseAt::Hinge(i), h.bodies[1], None);
        (ask, format!("impulse at {}", h.name))
    }));
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
    let plain = Slip::none(written.scene);
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
                let turned = |v: &Expr| if sign < 0 { -v } else { v.clone() };
                let values: Vec<Expr> = written.values.iter().map(turned).collect();
                if values.iter().all(Expr::is_zero) {
                    continue;
                }
                let other = written.of(&ask, component, values);
                let mirrored = trials.times(f64::from(sign));
                if mirrored.fits(&other, &plain) {
                    let axis = component.map_or("", |c| [" along x", " along y"][c]);
                    let minus = if sign < 0 { OPPOSITE } else { "" };
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
