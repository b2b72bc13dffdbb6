//! The force of the fixed point on a turning body: its center of mass moves on a circle, and Newton's second law gives the force.

use super::Page;
use crate::answer::Answer;
use crate::answer::calc::is_zero;
use crate::expr::{Expr, Node, Symbol, Vector, dot, minus};
use crate::scene::{Ask, Slide, StageKind, Turn};
use crate::solution::known::number;
use crate::solution::neat::{alike, neat, tidied};
use crate::solution::opening::NUMBERS;
use crate::solution::words::{self, fill, name, say, set, vector};
use crate::solution::{Claim, Inline, Line, Math, Meaning, Part};
use crate::story::{StageTold, carried, is_clockwise};

/// Largest component, in nodes, that is written out on the way.
const READABLE: usize = 60;

/// How fast a rotation goes at one end of it, and how it gets faster.
struct Rates {
    /// Square of the angular velocity.
    square: Expr,
    /// Angular acceleration, counterclockwise.
    angular: Expr,
    /// The moments that give it.
    moment: Expr,
    /// Which kinetic energy gives the square, `+` or `-`; none where no energy is told.
    mark: Option<&'static str>,
}

impl Page<'_> {
    /// The forces of the fixed point that are asked for in a stage, each under its heading.
    pub(super) fn pivot(&mut self, i: usize) {
        let told = &self.told.stages[i];
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
            let stage = words::stage(&told.name);
            let along_it = Inline::Math(vec![along.clone().into()]);
            let raw = match &told.placed.kind {
                StageKind::Turn(turn) => {
                    let parts = [say(&turn.about_name), say(when), say(stage), along_it];
                    let heading = fill("Force at {} at the {} of {} along {}", parts);
                    self.solution.section(1, heading);
                    match &turn.torque {
                        None => self.on_a_circle(told, turn, along, *at_end),
                        Some(_) => None,
                    }
                }
                StageKind::Slide(slide) => {
                    let parts = [say(slide.support()), say(stage), along_it];
                    self.solution
                        .section(1, fill("Force of the {} in {} along {}", parts));
                    self.on_a_line(told, slide, along);
                    None
                }
                _ => continue,
            };
            self.force(answer, raw);
        }
    }

    /// Tells where the force of a surface comes from, once: across the way it balances the weight.
    fn on_a_line(&mut self, told: &StageTold, slide: &Slide, along: &Vector) {
        let who = words::bodies(self.scene, &slide.company());
        let is_across = dot(along, &slide.along);
        let has_weight = slide.gravity.is_some() && !slide.level;
        if has_weight && is_zero(&is_across, &self.scene.domains) == Some(true) {
            let [has, its] = match slide.with.is_empty() {
                true => ["has", "its"],
                false => ["have", "their"],
            };
            let surface = slide.support();
            self.solution.say(&format!(
                "{} {has} no acceleration across {its} way: there the force of the {surface} balances the weight.",
                words::capital(&who)
            ));
            return;
        }
        let others = match (&slide.gravity, slide.level, &slide.force) {
            (Some(_), false, None) => " and the weight together give",
            (Some(_), false, Some(_)) => ", the weight and the applied force together give",
            (_, _, Some(_)) => " and the applied force together give",
            _ => " alone gives",
        };
        let its = if slide.with.is_empty() {
            "its"
        } else {
            "their"
        };
        let company = slide.company().into_iter();
        let mass = Expr::sum(company.map(|b| told.placed.scene.bodies[b].mass.clone()));
        let weight = slide.gravity.as_ref().filter(|_| !slide.level);
        let [x, y] = &slide.along;
        let push = slide.force.as_ref().map(|f| [f * x, f * y]);
        let factor = Math::Factor(tidied(self.scene, &mass));
        let mut law = set(
            "{} = {} {}",
            [vector("F", "", ""), factor, vector("a", "", "")],
        );
        if let Some(g) = weight {
            law.extend(set("+ {}", [[Expr::zero(), &mass * g].into()]));
        }
        if let Some(push) = push {
            law.extend(set("− ({})", [push.into()]));
        }
        if !self.solution.shows(&law) {
            self.solution.say(&format!(
                "The force of the {}{others} {who} {its} acceleration (Newton’s second law):",
                slide.support()
            ));
            self.solution.display(vec![Line::plain(law)]);
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
        let places = carried(told, turn);
        let moving = Expr::sum(places.iter().map(|b| scene.bodies[*b].mass.clone()));
        let center = [0, 1].map(|axis| match places.as_slice() {
            [one] => state.center[*one][axis].clone(),
            all => {
                let moments = all
                    .iter()
                    .map(|b| &scene.bodies[*b].mass * &state.center[*b][axis]);
                Expr::sum(moments) / &moving
            }
        });
        let arm = minus(&center, &turn.about).map(|e| tidy(&e));
        let zero = Expr::zero();
        let g = turn.gravity.as_ref().unwrap_or(&zero);
        let rates = self.rates(told, turn, at_end)?;
        let at = &turn.about_name;
        let who = words::bodies(self.scene, &places);
        let (center_name, who) = match places.as_slice() {
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
        let (lines, acceleration) = self.circling(&rates, at, &center_name, &arm);
        if acceleration.iter().any(|e| e.size() > READABLE) || rates.square.size() > READABLE {
            return None;
        }
        self.solution.say(&format!(
            "{} moves on a circle about {at}; Newton’s second law gives the force on it there.",
            words::capital(&who)
        ));
        self.rates_meant(&rates, at);
        let weight = [Expr::zero(), &tidy(&lump.mass) * g];
        let (force, mass) = (vector("F", at, ""), Math::Factor(tidy(&moving)));
        let mut law = set("{} = {} {}", [force, mass, vector("a", &center_name, "")]);
        if !g.is_zero() {
            law.extend(set("+ {}", [weight.clone().into()]));
        }
        let lines = lines.into_iter().chain([law]);
        let fresh = lines.filter(|line| !self.solution.shows(line));
        let fresh = fresh.map(Line::plain).collect();
        self.solution.display(fresh);
        let force = [
            &moving * &acceleration[0],
            &moving * &acceleration[1] + &weight[1],
        ];
        Some(neat(self.scene, &dot(&force, along)))
    }

    /// Where the accelerations of points come from that are asked of this stage.
    pub(super) fn accelerated(&mut self, told: &StageTold) {
        let asked = |ask: &Ask| matches!(ask, Ask::PointAcceleration { .. });
        if !self.asked(told, asked) {
            return;
        }
        let StageKind::Turn(turn) = &told.placed.kind else {
            return self.solution.say(
                "The positions, differentiated twice with respect to time, give the accelerations.",
            );
        };
        let about = &turn.about_name;
        self.solution.say(&format!(
            "Every point moves on a circle about {about}; the moments about {about} give the angular acceleration, and the energy the angular velocity."
        ));
        let ends = [false, true].map(|at_end| self.circled(told, turn, at_end));
        let both = ends.iter().all(|lines| !lines.is_empty());
        for (lines, when) in ends.into_iter().zip(["beginning", "end"]) {
            if both {
                self.solution.say(&format!("At the {when}:"));
            }
            let fresh = lines.into_iter().filter(|line| !self.solution.shows(line));
            let fresh: Vec<Line> = fresh.map(Line::plain).collect();
            if let (false, Some(rates)) = (fresh.is_empty(), self.rates(told, turn, when == "end"))
            {
                self.rates_meant(&rates, about);
            }
            self.solution.display(fresh);
        }
    }

    /// The accelerations of points that are asked at one end of a rotation.
    fn circled(&self, told: &StageTold, turn: &Turn, end: bool) -> Vec<Vec<Math>> {
        let mut lines: Vec<Vec<Math>> = Vec::new();
        let state = if end { &told.after } else { &told.before };
        let Some(rates) = self.rates(told, turn, end) else {
            return lines;
        };
        for answer in self.answered(told) {
            let Some(Ask::PointAcceleration {
                body,
                point,
                at_end,
                ..
            }) = self.ask(answer)
            else {
                continue;
            };
            if *at_end != end {
                continue;
            }
            let mut arm = minus(&state.center[*body], &turn.about);
            if let Some(point) = point {
                let further = state.carried(self.scene, *body, point);
                arm = [0, 1].map(|k| &arm[k] + &further[k]);
            }
            let center = || words::center(self.scene, *body);
            let letter = point.clone().unwrap_or_else(center);
            let (all, _) = self.circling(&rates, &turn.about_name, &letter, &arm);
            for line in all {
                if !lines.contains(&line) {
                    lines.push(line);
                }
            }
        }
        lines
    }

    /// What turns the bodies at one end of a rotation; nothing where it has no closed form.
    fn rates(&self, told: &StageTold, turn: &Turn, at_end: bool) -> Option<Rates> {
        let [_, inertia] = told.inertia.as_ref()?;
        let energy = &told.energy.as_ref()?[usize::from(at_end)];
        let moment = self.moment(told, turn, at_end);
        Some(Rates {
            square: tidied(self.scene, &(Expr::from(2) * energy / inertia)),
            angular: tidied(self.scene, &(&moment / inertia)),
            moment: neat(self.scene, &moment),
            mark: (!told.work.is_empty()).then_some(if at_end { "+" } else { "-" }),
        })
    }

    /// How a point at this arm from the fixed point is accelerated: the lines that lead there, and the components.
    fn circling(
        &self,
        rates: &Rates,
        about: &str,
        point: &str,
        arm: &Vector,
    ) -> (Vec<Vec<Math>>, Vector) {
        let Rates {
            square,
            angular,
            moment,
            mark,
        } = rates;
        let inertia = || self.inertia_letter(about);
        let acceleration = [
            -(angular * &arm[1]) - square * &arm[0],
            angular * &arm[0] - square * &arm[1],
        ];
        let acceleration = acceleration.map(|e| tidied(self.scene, &e));
        let index = |letter: &str| self.index_of(letter, rates, about);
        let square_of = || name("omega", index("omega"), "2", false);
        let arm_name = || vector("r", &format!("{point}/{about}"), "");
        let mut lines = Vec::new();
        if !square.is_zero() {
            let mut line = Vec::new();
            if let Some(mark) = mark {
                line = set(
                    "{} {} = 2 {} ⇒",
                    [inertia(), square_of(), words::kinetic("", mark)],
                );
            }
            line.extend(set("{} = {}", [square_of(), square.clone().into()]));
            lines.push(line);
        }
        let mut math = set("{} =", [vector("a", point, "")]);
        let alpha = || name("alpha", index("alpha"), "", false);
        if angular.is_zero() {
            lines.push(set("{} = {}", [alpha(), angular.clone().into()]));
        } else {
            let sides = [inertia(), alpha(), moment.clone().into()];
            let mut line = set("{} {} = {}", sides);
            line.extend(set("⇒ {} = {}", [alpha(), angular.clone().into()]));
            lines.push(line);
            math.extend(set(
                "{} × {}",
                [vector("alpha", index("alpha"), ""), arm_name()],
            ));
        }
        if !square.is_zero() {
            math.extend(set("− {} {}", [square_of(), arm_name()]));
        }
        if !(angular.is_zero() && square.is_zero()) {
            math.push(Math::Op("="));
        }
        math.push(acceleration.clone().into());
        lines.push(math);
        (lines, acceleration)
    }

    /// The index of a letter of a rotation: the fixed point, where the letter alone stands for something else.
    fn index_of<'n>(&self, letter: &str, rates: &Rates, about: &'n str) -> &'n str {
        let mut parameters = self.scene.parameters.iter();
        let is_it = |a: &Answer| {
            let square = a.formula().map(|e| tidied(self.scene, &e.powi(2)));
            letter == "omega" && square.as_ref() == Some(&rates.square)
        };
        let mut answers = self.told.answers.iter();
        let is_taken = parameters.any(|p| *p.name == *letter)
            || answers.any(|a| a.name == letter && !is_it(a));
        if is_taken { about } else { "" }
    }

    /// What the letters of a rotation stand for that no answer has as its name.
    fn rates_meant(&mut self, rates: &Rates, about: &str) {
        let turns = [
            (
                "omega",
                !rates.square.is_zero(),
                "the angular velocity there",
            ),
            ("alpha", true, "the angular acceleration"),
        ];
        let new = turns.into_iter().filter(|(_, is_shown, _)| *is_shown);
        let new = new.filter_map(|(letter, _, why)| {
            let index = self.index_of(letter, rates, about);
            let mut answers = self.told.answers.iter();
            let is_answer = index.is_empty() && answers.any(|a| a.name == letter);
            (!is_answer).then(|| (name(letter, index, "", false), why))
        });
        let new = new.collect();
        self.meant(new);
    }

    /// The moments about the fixed point at one end of a rotation, counterclockwise.
    fn moment(&self, told: &StageTold, turn: &Turn, at_end: bool) -> Expr {
        let zero = Expr::zero();
        let g = turn.gravity.as_ref().unwrap_or(&zero);
        let state = if at_end { &told.after } else { &told.before };
        let weights = turn.bodies().into_iter().map(|b| {
            let arm = &turn.about[0] - &state.center[b][0];
            &told.placed.scene.bodies[b].mass * g * tidied(self.scene, &arm)
        });
        let way = Expr::from(if is_clockwise(told) { -1 } else { 1 });
        let torque = turn.torque.iter().map(|torque| &way * torque);
        Expr::sum(weights.chain(torque))
    }

    /// The moments about the fixed point, which turn the bodies: each angular acceleration that is asked for by its own.
    pub(super) fn moments(&mut self, told: &StageTold, turn: &Turn) {
        let mut lines = Vec::new();
        for answer in self.answered(told).cloned().collect::<Vec<_>>() {
            let Some(Ask::AngularAcceleration {
                clockwise, at_end, ..
            }) = self.ask(&answer)
            else {
                continue;
            };
            let (Some([_, inertia]), Some(value)) = (&told.inertia, answer.formula()) else {
                continue;
            };
            let moment = self.moment(told, turn, *at_end);
            let moment = match (moment.node(), clockwise) {
                (Node::Sum(terms), true) => Expr::sum(terms.iter().map(|t| -t)),
                (_, true) => -moment,
                (_, false) => moment,
            };
            let claim = Claim::new(inertia * value, moment.clone());
            let why = "moment of inertia times angular acceleration = moments";
            let step = Some(self.solution.step(Vec::new(), vec![claim], why));
            let symbol = Expr::symbol(&answer.name);
            let inertia = self.inertia_letter(&turn.about_name);
            let math = set("{} {} = {}", [inertia, symbol.into(), moment.into()]);
            lines.push(Line { math, step });
        }
        self.solution.say(&format!(
            "The moments about {} over the moment of inertia give the angular acceleration:",
            turn.about_name
        ));
        self.solution.display(lines);
    }

    /// The box with the force, and what it comes from.
    fn force(&mut self, answer: &Answer, raw: Option<Expr>) {
        let Some(value) = answer.formula() else {
            return;
        };
        let symbol = Expr::symbol(&answer.name);
        let name = Symbol::from(answer.name.as_str());
        self.solution
            .meanings
            .insert(name.clone(), Meaning::Defined);
        let id = (self.solution).naming(&name, raw.as_ref(), value, &answer.words);
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
