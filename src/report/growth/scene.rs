//! The scene of a struck chain, for any number of rods.

use serde::Serialize;

use crate::dimension::Dimension;
use crate::domain::{Domain, Limit};
use crate::expr::{Expr, Symbol, Vector, ratio};
use crate::scene::{
    Ask, Blow, BlowImpulse, Body, Hinge, NamedPoint, Parameter, Question, Scene, Shape,
};

/// Angles of the rods of a chain scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Pose {
    /// In line along x, struck across.
    Straight,
    /// Each rod at its own angle `theta1` … `thetan`, struck along y.
    AnyAngles,
}

/// The scene of n free rods (mass m, length l), each hinged to the next, at rest; an impulse J along y at the free end of the
/// first. Asked: the spin of the struck rod and, for n > 1, of the last.
pub fn chain_scene(n: usize, pose: Pose) -> Scene {
    let [m, l, j] = ["m", "l", "J"].map(Expr::symbol);
    let mut scene = Scene {
        title: format!("A chain of {n} rods, struck at its end"),
        source: "carom".into(),
        statement: format!(
            "{n} equal uniform rods, each hinged to the next, lie at rest on a smooth table. The free end of the first \
             receives an impulse J along y. Find the spins just after."
        ),
        ..Scene::default()
    };
    let mechanical = [
        ("m", "kg", Dimension::new(1, 0, 0), "mass of each rod"),
        ("l", "m", Dimension::new(0, 1, 0), "length of each rod"),
        (
            "J",
            "N s",
            Dimension::new(1, 1, -1),
            "impulse on the free end",
        ),
    ];
    let positive = Domain {
        low: Some(Limit::number(ratio(0, 1), true)),
        high: None,
    };
    for (name, unit, dimension, meaning) in mechanical {
        scene.domains.symbols.insert(name.into(), positive.clone());
        scene.parameters.push(parameter(
            name.into(),
            unit,
            dimension,
            Expr::one(),
            meaning.into(),
        ));
    }
    let mut place: Vector = [Expr::zero(), Expr::zero()];
    scene.points.push(NamedPoint {
        name: "P0".into(),
        at: place.clone(),
    });
    for i in 1..=n {
        let angle = match pose {
            Pose::Straight => Expr::zero(),
            Pose::AnyAngles => {
                let name: Symbol = format!("theta{i}").into();
                let turn = Domain {
                    low: Some(Limit::pi(ratio(-1, 1), true)),
                    high: Some(Limit::pi(ratio(1, 1), false)),
                };
                scene.domains.symbols.insert(name.clone(), turn);
                let value = Expr::pi() * Expr::ratio(if i % 2 == 0 { -1 } else { 1 }, i as i64 + 5);
                let meaning = format!("angle of rod {i} from x");
                scene.parameters.push(parameter(
                    name.clone(),
                    "rad",
                    Dimension::none(),
                    value,
                    meaning,
                ));
                Expr::symbol(&name)
            }
        };
        let half: Vector = [
            &l * &angle.cos() * Expr::ratio(1, 2),
            &l * &angle.sin() * Expr::ratio(1, 2),
        ];
        let center: Vector = [&place[0] + &half[0], &place[1] + &half[1]];
        let next: Vector = [&center[0] + &half[0], &center[1] + &half[1]];
        scene.bodies.push(Body {
            name: format!("rod{i}"),
            shape: Shape::Rod { length: l.clone() },
            mass: m.clone(),
            inertia: &m * &l.powi(2) * Expr::ratio(1, 12),
            inertia_given: false,
            center,
            angle,
            velocity: [Expr::zero(), Expr::zero()],
            spin: Expr::zero(),
        });
        if i > 1 {
            scene.hinges.push(Hinge {
                name: format!("P{}", i - 1),
                bodies: [i - 2, i - 1],
                at: place,
            });
        }
        scene.points.push(NamedPoint {
            name: format!("P{i}"),
            at: next.clone(),
        });
        place = next;
    }
    if n > 0 {
        let at = scene.points[0].at.clone();
        scene.blows.push(Blow {
            name: "J".into(),
            body: 0,
            at,
            impulse: BlowImpulse::Given([Expr::zero(), j]),
        });
        for i in if n == 1 { vec![1] } else { vec![1, n] } {
            let ask = Ask::Spin {
                body: i - 1,
                clockwise: false,
            };
            scene.questions.push(Question {
                name: format!("omega{i}"),
                latex: Some(format!("\\omega_{{{i}}}")),
                ask,
                hidden: false,
            });
        }
    }
    scene
}

fn parameter(
    name: Symbol,
    unit: &str,
    dimension: Dimension,
    value: Expr,
    meaning: String,
) -> Parameter {
    Parameter {
        name,
        latex: None,
        unit: unit.into(),
        dimension,
        value: Some(value),
        meaning,
    }
}
