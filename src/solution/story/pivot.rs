//! The force of the fixed point on a turning body: its center of mass moves on a circle, and Newton's second law gives the force.

use super::Page;
use crate::answer::Answer;
use crate::expr::{Expr, Symbol, Vector, cross, dot, minus};
use crate::scene::{Ask, StageKind, Turn};
use crate::solution::known::number;
use crate::solution::neat::{alike, neat, tidied};
use crate::solution::opening::NUMBERS;
use crate::solution::words::{self, fill, name, say, set, vector};
use crate::solution::{Claim, Inline, Line, Math, Meaning, Part};
use crate::story::StageTold;

/// Largest component, in nodes, that is written out on the way.
const READABLE: usize = 60;

impl Page<'_> {
    /// The forces of the fixed point that are asked for in a stage, each under its heading.
    pub(super) fn pivot(&mut self, i: usize) {
        let told = &self.told.stages[i];
        let StageKind::Turn(turn) = &told.placed.kind else {
            return;
        };
        for question in &self.scene.questions {
            let Ask::Reaction { along, at_end } = &question.ask else {
                continue;
            };
            let mut answers = self.told.answers.iter();
            let Some(answer) = answers.find(|a| {
                a.question == question.name && a.told.is_some_and(|(stage, _)| stage == i)
            }) else {
                continue;
            };
            let when = if *at_end { "end" } else { "beginning" };
            let at = &turn.about_name;
            let stage = words::stage(&told.name);
            let along_it = Inline::Math(vec![along.clone().into()]);
            let parts = [say(at), say(when), say(stage), along_it];
            let heading = fill("Force at {} at the {} of {} along {}", parts);
            self.solution.section(1, heading);
            let raw = match &turn.torque {
                None => self.on_a_circle(told, turn, along, *at_end),
                Some(_) => None,
            };
            self.force(answer, raw);
        }
    }

    /// Tells how the center of mass is accelerated, and gives the force m a + m g along a direction.
    fn on_a_circle(
        &mut self,
        told: &StageTold,
        turn: &Turn,
        along: &Vector,
        at_end: bool,
    ) -> Option<Expr> {
        let scene = &told.placed.scene;
        let tidy = |e: &Expr| tidied(self.scene, e);
        let lump = turn.lump(scene);
        let state = if at_end { &told.after } else { &told.before };
        let places = turn.bodies();
        let center = [0, 1].map(|axis| match places.as_slice() {
            [one] => state.center[*one][axis].clone(),
            all => {
                let moments = all
                    .iter()
                    .map(|b| &scene.bodies[*b].mass * &state.center[*b][axis]);
                Expr::sum(moments) / &lump.mass
            }
        });
        let arm = minus(&center, &turn.about).map(|e| tidy(&e));
        let [_, inertia] = told.inertia.as_ref()?;
        let [start, end] = told.energy.as_ref()?;
        let energy = if at_end { end } else { start };
        let square = tidy(&(Expr::from(2) * energy / inertia));
        let zero = Expr::zero();
        let g = turn.gravity.as_ref().unwrap_or(&zero);
        let weight = [Expr::zero(), -(&lump.mass * g)];
        let moment = cross(&arm, &weight);
        let angular = tidy(&(&moment / inertia));
        let acceleration = [
            -(&angular * &arm[1]) - &square * &arm[0],
            &angular * &arm[0] - &square * &arm[1],
        ];
        let acceleration = acceleration.map(|e| tidy(&e));
        if acceleration.iter().any(|e| e.size() > READABLE) || square.size() > READABLE {
            return None;
        }
        let at = &turn.about_name;
        let who = words::bodies(self.scene, &places);
        let (g, who) = match places.as_slice() {
            [one] if scene.bodies[*one].is_particle() => (words::center(self.scene, *one), who),
            [one] => {
                let g = words::center(self.scene, *one);
                (g, format!("the center of mass of {who}"))
            }
            _ => {
                let who = format!("the common center of mass G of {who}");
                (String::from("G"), who)
            }
        };
        self.solution.say(&format!(
            "{} moves on a circle about {at}; Newton's second law for it gives the force.",
            words::capital(&who)
        ));
        let square_of = || name("omega", "", "2", false);
        let arm_name = || vector("r", &format!("{g}/{at}"), "");
        let mut lines = Vec::new();
        if !square.is_zero() {
            lines.push(set("{} = {}", [square_of(), square.clone().into()]));
        }
        let mut math = set("{} =", [vector("a", &g, "")]);
        if !angular.is_zero() {
            let raw = neat(self.scene, &(&moment / inertia));
            let alpha = name("alpha", "", "", false);
            lines.push(set(
                "{} = {} = {}",
                [alpha, raw.into(), angular.clone().into()],
            ));
            math.extend(set("{} × {}", [vector("alpha", "", ""), arm_name()]));
        }
        if !square.is_zero() {
            math.extend(set("− {} {}", [square_of(), arm_name()]));
        }
        math.extend(set("= {}", [acceleration.clone().into()]));
        lines.push(math);
        let lines = lines.into_iter().map(Line::plain);
        self.solution.display(lines.collect());
        let force = [
            &lump.mass * &acceleration[0],
            &lump.mass * &acceleration[1] - &weight[1],
        ];
        Some(neat(self.scene, &dot(&force, along)))
    }

    /// The box with the force, and what it comes from.
    fn force(&mut self, answer: &Answer, raw: Option<Expr>) {
        let Some(value) = answer.formula() else {
            return;
        };
        let symbol = Expr::symbol(&answer.name);
        let claims = [Some(symbol.clone()), raw.clone()].into_iter().flatten();
        let claims = claims.map(|left| Claim::new(left, value.clone()));
        let id = self
            .solution
            .step(Vec::new(), claims.collect(), &answer.words);
        let defined = Symbol::from(answer.name.as_str());
        self.solution
            .meanings
            .insert(defined.clone(), Meaning::Defined);
        if let Some(step) = self.solution.steps.last_mut() {
            step.defines = Some(defined);
        }
        let mut math = vec![Math::Expr(symbol.clone()), Math::Op("=")];
        if let Some(raw) = raw.filter(|raw| !alike(raw, value)) {
            math.extend([Math::Expr(raw), Math::Op("=")]);
        }
        math.push(Math::Expr(value.clone()));
        let step = Some(id);
        self.solution.push(Part::Result(vec![Line { math, step }]));
        if let Some(number) = number(self.scene, answer) {
            let parts = [say(NUMBERS), words::formula(&symbol), say(number)];
            self.solution.text(fill("{}{}{}.", parts));
        }
    }
}
