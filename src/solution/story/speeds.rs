//! What the end of a motion leads to: the kinetic energy in terms of what is asked, and the velocities of points.

use super::Page;
use super::motion::{driven, pulley};
use crate::answer::Answer;
use crate::expr::{Expr, Symbol};
use crate::scene::{Ask, Body, Scene, StageKind};
use crate::solution::neat::{counted, tidied};
use crate::solution::words::{self, name, set, vector};
use crate::solution::{Line, Math};
use crate::story::StageTold;

impl Page<'_> {
    /// How a point of a body moves at the end of a motion: v = ω × r from the fixed point of a rotation, else with the velocity
    /// of the center of mass.
    pub(super) fn carried(&self, told: &StageTold, ask: &Ask) -> Vec<Line> {
        let Ask::Velocity { body, point, .. } = ask else {
            return Vec::new();
        };
        let scene = &told.placed.scene;
        let turns = matches!(told.placed.kind, StageKind::Turn(_));
        let center = words::center(self.scene, *body);
        let point = match point {
            Some((point, _)) => point,
            None if turns => &center,
            None => return Vec::new(),
        };
        if told.energy.is_none() || scene.bodies[*body].is_particle() {
            return Vec::new();
        }
        let from_center = match *point == center {
            true => [0; 2].map(|_| Expr::zero()),
            false => told.after.carried(self.scene, *body, point),
        };
        let (base, from, carrier) = match &told.placed.kind {
            StageKind::Turn(turn) => (turn.about_name.clone(), turn.about.clone(), None),
            _ => {
                let velocity = told.after.velocity[*body].each_ref().map(|v| self.named(v));
                (
                    center.clone(),
                    told.after.center[*body].clone(),
                    Some(velocity),
                )
            }
        };
        let arm = [0, 1].map(|k| &(&told.after.center[*body][k] + &from_center[k]) - &from[k]);
        let arm = arm.map(|e| tidied(self.scene, &e));
        let spin = self.named(&told.after.spin[*body]);
        let mut math = set("{} =", [vector("v", point, "+")]);
        if carrier.is_some() {
            math.extend(set("{} +", [vector("v", &base, "+")]));
        }
        let r = vector("r", &format!("{point}/{base}"), "");
        math.extend(set("{} × {} =", [words::spin(self.scene, *body, "+"), r]));
        if let Some(velocity) = carrier {
            math.extend(set("({}) +", [velocity.into()]));
        }
        math.extend(set("({}) × ({})", [Math::Along(spin), arm.into()]));
        vec![Line::plain(math)]
    }

    /// Whether this answer is the kinetic energy at the end of a motion.
    pub(super) fn is_end_energy(told: &StageTold, answer: &Answer) -> bool {
        let Some([_, end]) = &told.energy else {
            return false;
        };
        let mut asked = told.placed.scene.questions.iter();
        answer.formula() == Some(end)
            && asked.any(|q| q.name == answer.name && matches!(q.ask, Ask::Energy { .. }))
    }

    /// The kinetic energy at the end of a lone particle's motion in terms of its speed, ½ m v² = T⁺, where that gives its value.
    pub(super) fn energy_of_speed(
        &self,
        told: &StageTold,
        symbol: &Symbol,
        value: &Expr,
    ) -> Option<Line> {
        let moved = told.placed.kind.moved();
        let ([only], Some([_, end]), true) =
            (moved.as_slice(), &told.energy, told.steps.is_empty())
        else {
            return None;
        };
        let body = &told.placed.scene.bodies[*only];
        let energy = |of: &Expr| &(&Expr::ratio(1, 2) * &body.mass) * &of.powi(2);
        let gives = tidied(self.scene, &energy(value)) == tidied(self.scene, end);
        if !body.is_particle() || !gives || self.kinematic(told).is_some() {
            return None;
        }
        Some(is_kinetic(energy(&Expr::symbol(symbol))))
    }

    /// The kinetic energy at the end in terms of the speed or spin that is asked for, ½ I ω² = T⁺, where that gives its value.
    pub(super) fn energy_in(
        &self,
        told: &StageTold,
        ask: &Ask,
        symbol: &Symbol,
        value: &Expr,
    ) -> Option<Line> {
        let [_, end] = told.energy.as_ref()?;
        let scene = &told.placed.scene;
        // Where the motion is not told by its energy, T⁺ stands nowhere above.
        let otherwise = !told.steps.is_empty() || self.kinematic(told).is_some();
        if otherwise || matches!(told.placed.kind, StageKind::Linkage(_)) {
            return None;
        }
        if let (StageKind::Turn(turn), Some((inertia, _))) = (&told.placed.kind, driven(told)) {
            let momentum = name("H", &turn.about_name, "+", false);
            let Ask::Spin { clockwise, .. } = ask else {
                return None;
            };
            let spin = Expr::symbol(symbol);
            let made = &inertia * if *clockwise { -spin } else { spin };
            return Some(Line::plain(set("{} = {}", [made.into(), momentum])));
        }
        let inertia = match (ask, &told.inertia) {
            (Ask::Spin { .. }, Some([_, about])) => about.clone(),
            (Ask::Velocity { .. }, None) => {
                let moved = told.placed.kind.moved().into_iter();
                counted(&Expr::sum(moved.map(|b| match pulley(&told.placed, b) {
                    Some((_, apparent)) => tidied(self.scene, &apparent),
                    None => scene.bodies[b].mass.clone(),
                })))
            }
            _ => return None,
        };
        let energy = |of: &Expr| &(&Expr::ratio(1, 2) * &inertia) * &of.powi(2);
        // By Newton's laws no energy is told.
        let is_told = !told.work.is_empty() && told.steps.is_empty();
        if !is_told || tidied(self.scene, &energy(value)) != tidied(self.scene, end) {
            return None;
        }
        Some(is_kinetic(energy(&Expr::symbol(symbol))))
    }
}

/// That something is the kinetic energy at the end.
fn is_kinetic(energy: Expr) -> Line {
    let energies = [energy.into(), words::kinetic("", "+")];
    Line::plain(set("{} = {}", energies))
}

/// Of which bodies a symbol is the speed or the rate of turning with which they come into an impact; `None` where it is a part of
/// such.
pub(super) fn handed_on(scene: &Scene, name: &Symbol) -> Option<String> {
    let is_it = |e: &Expr| e.as_symbol() == Some(name) || (-e).as_symbol() == Some(name);
    let what = |body: &Body| match &body.velocity {
        _ if is_it(&body.spin) => Some("the angular speed"),
        [x, y] if is_it(x) && y.is_zero() || x.is_zero() && is_it(y) => Some("the speed"),
        [x, _] if is_it(x) => Some("the horizontal speed"),
        [_, y] if is_it(y) => Some("the vertical speed"),
        _ => None,
    };
    let of = scene.bodies.iter().find_map(what)?;
    let alike = (0..scene.bodies.len()).filter(|b| what(&scene.bodies[*b]) == Some(of));
    let alike: Vec<usize> = alike.collect();
    Some(format!("{of} of {}", words::bodies(scene, &alike)))
}
