//! A motion in a worked solution: by its energy, or by Newton's laws step by step. Every line is a claim; a flight is told in
//! [`super::flight`].

use super::Page;
use crate::answer::Answer;
use crate::answer::calc::is_zero;
use crate::expr::{Expr, Node, Symbol, dot, minus};
use crate::scene::{Ask, Linkage, Slide, Stage, StageKind, Turn, Until};
use crate::solution::neat::{alike, neat, tidied};
use crate::solution::words::{self, name, say};
use crate::solution::{Claim, Detail, Inline, Line, Math, Meaning, Part, Solution};
use crate::story::{StageTold, Step};

/// Smallest formula, in nodes, whose name is worth standing for it.
const WORTH_A_NAME: usize = 6;

impl Page<'_> {
    /// A motion by Newton's laws: what the letters stand for, then forces, accelerations, and what they come to.
    fn steps(&mut self, told: &StageTold) {
        let taken = |step: &Step| {
            let mut answers = self.told.answers.iter().filter(|a| a.name == step.letter);
            let mut parameters = self.scene.parameters.iter();
            parameters.any(|p| *p.name == *step.letter)
                || answers.any(|a| a.formula() != Some(&step.value))
        };
        let scene = &told.placed.scene;
        let moved = told.placed.kind.moved();
        let index = moved.first().map_or("", |b| scene.bodies[*b].name.as_str());
        let mut lines = Vec::new();
        let mut letters = vec![say("Let ")];
        for (i, step) in told.steps.iter().enumerate() {
            let mark = if matches!(step.letter, "v" | "omega") {
                "+"
            } else {
                ""
            };
            let index = if taken(step) { index } else { "" };
            // What is asked for goes by the name of its answer, and stands in the box.
            let answer = self.answering(told, step);
            let letter = match answer {
                Some(answer) => Math::Expr(Expr::symbol(&answer.name)),
                None => name(step.letter, index, mark, false),
            };
            letters.push(say(match (i, told.steps.len() - i) {
                (0, _) => "",
                (_, 1) => " and ",
                _ => ", ",
            }));
            let be = if i == 0 { " be " } else { " " };
            letters.extend([
                Inline::Math(vec![letter.clone()]),
                say(format!("{be}{}", step.why)),
            ]);
            let is_boxed = answer.is_some();
            let claim = Claim {
                left: step.raw.clone(),
                right: step.value.clone(),
            };
            let claimed = self.solution.step(Vec::new(), vec![claim], step.why);
            if is_boxed {
                continue;
            }
            let mut math = vec![letter, Math::Op("=")];
            math.extend(self.made_of(step));
            math.push(Math::Expr(step.value.clone()));
            lines.push(Line {
                math,
                step: Some(claimed),
            });
        }
        letters.push(say("."));
        if self.solution.detail != Detail::Brief {
            self.solution.text(letters);
        }
        if !lines.is_empty() {
            self.solution.push(Part::Display(lines));
        }
    }

    /// What a step comes from, with the sign that leads on to its value; nothing where it reads the same.
    pub(super) fn made_of(&self, step: &Step) -> Vec<Math> {
        let raw = self.by_names(&step.raw, &step.value);
        let raw = neat(self.scene, &raw);
        let written = crate::formula::write_plain;
        match alike(&raw, &step.value) || written(&raw) == written(&step.value) {
            true => Vec::new(),
            false => vec![Math::Expr(raw), Math::Op("=")],
        }
    }

    /// The answer that is what a step of a motion finds.
    pub(super) fn answering(&self, told: &StageTold, step: &Step) -> Option<&Answer> {
        let fits = |ask: &Ask| match step.letter {
            "t" => matches!(ask, Ask::Time),
            "s" => matches!(ask, Ask::Distance | Ask::Position { .. }),
            "v" => matches!(ask, Ask::Velocity { point: None, .. }),
            "omega" => matches!(ask, Ask::Spin { .. }),
            "a" => matches!(ask, Ask::Acceleration { .. }),
            "T" | "S" => matches!(ask, Ask::Tension { .. }),
            _ => false,
        };
        let asked = |a: &&Answer| {
            let mut questions = self.scene.questions.iter();
            questions.any(|q| q.name == a.question && fits(&q.ask))
        };
        let mut answers = self.answered(told).filter(asked);
        answers.find(|a| a.formula() == Some(&step.value))
    }

    /// The answers at the end of a stage; one that is not reached has none.
    pub(super) fn answered(&self, told: &StageTold) -> impl Iterator<Item = &Answer> {
        self.told.answers.iter().filter(move |a| {
            let stage = a.told.and_then(|(i, _)| self.told.stages.get(i));
            stage.is_some_and(|stage| std::ptr::eq(stage, told))
        })
    }

    /// A motion: inertia, work and energy, from the beginning to the end.
    pub(super) fn motion(&mut self, stage: &Stage, told: &StageTold) {
        if !told.steps.is_empty() {
            return self.steps(told);
        }
        let Some([start, end]) = &told.energy else {
            return;
        };
        let mut lines = Vec::new();
        let claim = |s: &mut Solution, left: &Expr, right: &Expr, why: &str| {
            let claim = Claim {
                left: left.clone(),
                right: right.clone(),
            };
            Some(s.step(Vec::new(), vec![claim], why))
        };
        let mut answers = self.told.answers.iter();
        let named = answers.any(|a| Self::is_end_energy(told, a));
        let scene = self.scene;
        let chain = |head: Vec<Math>, raw: &Expr, value: &Expr| {
            let mut math = head;
            math.push(Math::Op("="));
            let raw = neat(scene, raw);
            if !alike(&raw, value) {
                math.extend([Math::Expr(raw), Math::Op("=")]);
            }
            math.push(Math::Expr(value.clone()));
            math
        };
        if let (Some([raw, tidy]), StageKind::Turn(turn)) = (&told.inertia, &stage.kind) {
            let raw = &match turn.with.is_empty() {
                true => raw.clone(),
                false => self.about(stage, told, turn),
            };
            let math = chain(vec![name("I", &turn.about_name, "", false)], raw, tidy);
            let step = claim(
                &mut self.solution,
                raw,
                tidy,
                "moment of inertia about the fixed point: I + m r²",
            );
            lines.push(Line { math, step });
        }
        let t = |mark| vec![words::kinetic("", mark)];
        if let StageKind::Linkage(linkage) = &stage.kind {
            self.velocities(told, linkage);
        }
        let raw = self.start_energy(stage, told);
        let math = chain(t("-"), &raw, start);
        let step = claim(
            &mut self.solution,
            &raw,
            start,
            "kinetic energy at the beginning",
        );
        lines.push(Line { math, step });
        if let StageKind::Turn(turn) = &stage.kind
            && matches!(turn.until, Until::Stops)
            && let Some(g) = &turn.gravity
        {
            self.solution.push(Part::Display(lines));
            return self.rise(stage, told, turn, g);
        }
        let total = Expr::sum(told.work.iter().map(|(_, w)| w.clone()));
        let gain = end - start;
        for (what, raw) in &told.work {
            let value = if told.work.len() == 1 {
                &tidied(self.scene, &gain)
            } else {
                raw
            };
            let index = if told.work.len() == 1 { "" } else { what };
            let math = chain(vec![name("W", index, "", false)], raw, value);
            let step = claim(
                &mut self.solution,
                raw,
                value,
                &format!("work of {what}: force times the way in its direction"),
            );
            lines.push(Line { math, step });
        }
        let after = start + &total;
        let mut math = t("+");
        math.extend([Math::Op("="), words::kinetic("", "-")]);
        for (what, _) in &told.work {
            let index = if told.work.len() == 1 { "" } else { what };
            math.extend([Math::Op("+"), name("W", index, "", false)]);
        }
        if !named {
            math = chain(math, end, end);
        }
        let step = claim(
            &mut self.solution,
            &after,
            end,
            "work changes kinetic energy",
        );
        lines.push(Line { math, step });
        lines.extend(self.speed(stage, told));
        if let (Some([inertia, _]), StageKind::Linkage(linkage)) = (&told.inertia, &stage.kind) {
            let square = self.rate(linkage).powi(2);
            let energy = Math::Expr(Expr::ratio(1, 2) * inertia * square);
            let math = vec![energy, Math::Op("="), words::kinetic("", "+")];
            lines.push(Line { math, step: None });
        }
        self.solution.push(Part::Display(lines));
        self.whirled(stage, told);
    }

    /// Where an angular acceleration, or the time of a linkage, comes from, if it is asked of this stage.
    fn whirled(&mut self, stage: &Stage, told: &StageTold) {
        let asks = |is: fn(&Ask) -> bool| self.asked(told, is);
        let whirls = asks(|ask| matches!(ask, Ask::AngularAcceleration { .. }));
        let takes = asks(|ask| matches!(ask, Ask::Time));
        let is_linkage = matches!(stage.kind, StageKind::Linkage(_));
        if whirls {
            self.solution.say(&match &stage.kind {
                StageKind::Turn(turn) => format!(
                    "The moments about {} over the moment of inertia give the angular acceleration.",
                    turn.about_name
                ),
                _ => String::from(
                    "The balance of energy from the beginning to any place, differentiated by the time, gives the angular acceleration.",
                ),
            });
        }
        if takes && is_linkage {
            self.solution.say(
                "The acceleration is the same all the way, and the time is the change of the velocity over it.",
            );
        }
    }

    /// How high a body swings until weight has brought it to rest, and through which angle.
    fn rise(&mut self, stage: &Stage, told: &StageTold, turn: &Turn, g: &Expr) {
        let Some([start, _]) = &told.energy else {
            return;
        };
        let lump = turn.lump(&stage.scene);
        let weight = &lump.mass * g;
        let height = tidied(self.scene, &(start / &weight));
        let is_free = |letter: &&str| {
            let mut parameters = self.scene.parameters.iter();
            let mut answers = self.told.answers.iter();
            !parameters.any(|p| *p.name == **letter) && !answers.any(|a| a.name == **letter)
        };
        let letter = Symbol::from(["h", "h_G"].into_iter().find(is_free).unwrap_or("h_up"));
        let h = Expr::symbol(&letter);
        self.solution
            .meanings
            .insert(letter.clone(), Meaning::Defined);
        self.solution.text(vec![
            say("The rotation ends where weight has taken up the kinetic energy. The center of mass has then risen by "),
            words::formula(&h),
            say(":"),
        ]);
        let claim = Claim {
            left: h.clone(),
            right: height.clone(),
        };
        let step = self
            .solution
            .step(Vec::new(), vec![claim], "kinetic energy over weight");
        if let Some(step) = self.solution.steps.last_mut() {
            step.defines = Some(letter);
        }
        let balance = vec![
            Math::Expr(&weight * &h),
            Math::Op("="),
            words::kinetic("", "-"),
        ];
        let risen = vec![Math::Expr(h.clone()), Math::Op("="), Math::Expr(height)];
        let mut lines = vec![
            Line {
                math: balance,
                step: None,
            },
            Line {
                math: risen,
                step: Some(step),
            },
        ];
        let arm = minus(&lump.center, &turn.about).map(|e| tidied(self.scene, &e));
        let length = tidied(self.scene, &dot(&arm, &arm).sqrt());
        let from_below = is_zero(&(&arm[1] + &length), &self.scene.domains) == Some(true);
        let angle = self.answered(told).find(|a| {
            let mut questions = self.scene.questions.iter();
            questions.any(|q| q.name == a.question && matches!(q.ask, Ask::Angle { .. }))
        });
        if let Some(angle) = angle.filter(|_| from_below) {
            let name = Symbol::from(angle.name.as_str());
            let swung = &length * (Expr::one() - Expr::symbol(&name).cos());
            let math = vec![Math::Expr(h), Math::Op("="), Math::Expr(swung)];
            lines.push(Line { math, step: None });
            let meaning = Meaning::Answer(angle.question.clone(), None);
            self.solution.meanings.insert(name, meaning);
        }
        self.solution.push(Part::Display(lines));
    }

    /// The speed with which a fall or a rotation ends, from its energy, where the next stage takes it over and no question asks
    /// for it.
    fn speed(&mut self, stage: &Stage, told: &StageTold) -> Option<Line> {
        let [_, end] = told.energy.as_ref()?;
        let asks = |is: fn(&Ask) -> bool| self.asked(told, is);
        let (head, inertia) = match &stage.kind {
            StageKind::Fall(fall) => {
                let spins = !told.after.spin[fall.body].is_zero();
                if asks(|_| true) || spins || fall.bodies().len() > 1 {
                    return None;
                }
                let mass = stage.scene.bodies[fall.body].mass.clone();
                (name("v", "", "+", false), mass)
            }
            StageKind::Turn(turn) => {
                let index = self.told.stages.iter().position(|s| std::ptr::eq(s, told));
                let mut next = self.told.stages.iter();
                let goes_on = next.any(|s| s.branch.map(|(parent, _)| parent) == index);
                let is_given = *end == told.energy.as_ref()?[0];
                let needed = goes_on || asks(|ask| matches!(ask, Ask::Velocity { .. }));
                let asked =
                    asks(|ask| matches!(ask, Ask::Spin { .. })) || self.speed_asked(told).is_some();
                if asked || is_given || !needed {
                    return None;
                }
                let body = &stage.scene.bodies[turn.body];
                match (body.is_particle() && turn.with.is_empty(), &told.inertia) {
                    (true, _) => (name("v", "", "+", false), body.mass.clone()),
                    (false, Some([_, inertia])) => (name("omega", "", "+", false), inertia.clone()),
                    (false, None) => return None,
                }
            }
            _ => return None,
        };
        let square = Expr::from(2) * end / &inertia;
        let speed = tidied(self.scene, &tidied(self.scene, &square).sqrt());
        let math = vec![
            head,
            Math::Op("="),
            Math::Expr(neat(self.scene, &square).sqrt()),
            Math::Op("="),
            Math::Expr(speed),
        ];
        Some(Line { math, step: None })
    }

    /// The moment of inertia of bodies that turn as one, each by I + m r² about the fixed point.
    fn about(&self, stage: &Stage, told: &StageTold, turn: &Turn) -> Expr {
        Expr::sum(turn.bodies().into_iter().flat_map(|b| {
            let body = &stage.scene.bodies[b];
            let arm = minus(&told.before.center[b], &turn.about);
            let own = match body.is_particle() {
                true => Expr::zero(),
                false => tidied(self.scene, &body.inertia),
            };
            [own, tidied(self.scene, &(&body.mass * dot(&arm, &arm)))]
        }))
    }

    /// The rate of the coordinate of a linkage, as a symbol.
    fn rate(&mut self, linkage: &Linkage) -> Expr {
        let of = &linkage.coordinate;
        let symbol = Symbol::from(format!("{of}_dot").as_str());
        let latex = match self.solution.names.get(of) {
            Some(latex) => latex.clone(),
            None => crate::formula::latex_name(of),
        };
        let latex = format!("\\dot{{{latex}}}");
        self.solution.names.insert(symbol.clone(), latex);
        Expr::symbol(&symbol)
    }

    /// How all bodies of a linkage move by the rate of its coordinate.
    fn velocities(&mut self, told: &StageTold, linkage: &Linkage) {
        let rate = self.rate(linkage);
        let scene = &told.placed.scene;
        let mut lines = Vec::new();
        for (b, place) in &linkage.places {
            let called = words::center(self.scene, *b);
            let per = place.each_ref().map(|e| {
                let change = tidied(self.scene, &e.derivative(&linkage.coordinate));
                &change * &rate
            });
            let [x, y, angle] = per;
            if !(x.is_zero() && y.is_zero()) {
                let math = vec![
                    name("v", &called, "", true),
                    Math::Op("="),
                    Math::Vector([x, y]),
                ];
                lines.push(Line { math, step: None });
            }
            if !scene.bodies[*b].is_particle() && !angle.is_zero() {
                let index = if called == "G" { "" } else { &called };
                let math = vec![
                    name("omega", index, "", false),
                    Math::Op("="),
                    Math::Expr(angle),
                ];
                lines.push(Line { math, step: None });
            }
        }
        self.solution.text(vec![
            say("The places of all bodies follow from "),
            words::formula(&Expr::symbol(&linkage.coordinate)),
            say(", and their velocities from its rate; with these, translation and rotation make up the kinetic energy:"),
        ]);
        self.solution.push(Part::Display(lines));
    }

    /// Kinetic energy at the beginning of a motion from its velocities, term by term; a spin or speed that has a name by now
    /// stands by its name.
    fn start_energy(&self, stage: &Stage, told: &StageTold) -> Expr {
        let half = Expr::ratio(1, 2);
        let square = |e: &Expr| {
            let opposite = self.named(&-e);
            let plain = opposite.as_symbol().map(|_| opposite.clone());
            plain.unwrap_or_else(|| self.named(e)).powi(2)
        };
        if let (Some([_, inertia]), StageKind::Turn(turn)) = (&told.inertia, &stage.kind) {
            return &half * inertia * square(&told.before.spin[turn.body]);
        }
        let moved = stage.kind.moved();
        Expr::sum(moved.into_iter().map(|body| {
            let b = &stage.scene.bodies[body];
            if let Some((slide, apparent)) = pulley(stage, body) {
                let speed = dot(&told.before.velocity[slide.body], &slide.along);
                let speed = tidied(self.scene, &speed);
                return match speed.is_zero() || apparent.is_zero() {
                    true => Expr::zero(),
                    false => &half * tidied(self.scene, &apparent) * square(&speed),
                };
            }
            let [x, y] = &told.before.velocity[body];
            let spin = &told.before.spin[body];
            let mut energy = Expr::zero();
            if !(x.is_zero() && y.is_zero()) {
                energy = &half * &b.mass * (square(x) + square(y));
            }
            if !spin.is_zero() {
                // The parts of a composite and what they add by their places are no business of its motion.
                energy = energy + &half * tidied(self.scene, &b.inertia) * square(spin);
            }
            energy
        }))
    }

    /// A component of the motion by the name it has by now, as a told answer or its opposite; else as it is.
    pub(super) fn named(&self, e: &Expr) -> Expr {
        if e.is_constant() {
            return e.clone();
        }
        let [plus, minus] = [e, &-e].map(|e| tidied(self.scene, e));
        let known = |a: &&Answer| self.solution.meanings.contains_key(a.name.as_str());
        let mut told = self.told.answers.iter().filter(known);
        let named = told.find_map(|a| match a.formula()? {
            f if f == e || *f == plus => Some(Expr::symbol(&a.name)),
            f if *f == minus => Some(-Expr::symbol(&a.name)),
            _ => None,
        });
        named.unwrap_or_else(|| e.clone())
    }

    /// What a value is made of, with answers that stand on the page by their names, where it holds all of one.
    fn by_names(&self, e: &Expr, value: &Expr) -> Expr {
        let known = |a: &&Answer| self.solution.meanings.contains_key(a.name.as_str());
        let worth = |a: &&Answer| {
            let formula = a.formula();
            formula.is_some_and(|f| f.size() >= WORTH_A_NAME && f != value)
        };
        let told = self.told.answers.iter();
        let mut told: Vec<&Answer> = told.filter(known).filter(worth).collect();
        // The longest first: a shorter one may be a part of it.
        told.sort_by_key(|a| std::cmp::Reverse(a.formula().map(Expr::size)));
        let mut out = e.clone();
        for a in told {
            let Some(formula) = a.formula() else {
                continue;
            };
            let symbol = Expr::symbol(&a.name);
            out = replaced(&out, formula, &symbol);
            out = replaced(&out, &tidied(self.scene, &-formula), &-&symbol);
        }
        match out.as_symbol() {
            Some(_) => e.clone(),
            None => out,
        }
    }

    /// How a point of a body moves at the end of a motion: v = ω × r from the fixed point of a rotation, else with the velocity
    /// of the center of mass.
    pub(super) fn carried(&self, told: &StageTold, ask: &Ask) -> Vec<Line> {
        let Ask::Velocity {
            body,
            point: Some((point, _)),
            ..
        } = ask
        else {
            return Vec::new();
        };
        let scene = &told.placed.scene;
        if told.energy.is_none() || scene.bodies[*body].is_particle() {
            return Vec::new();
        }
        let from_center = told.after.carried(self.scene, *body, point);
        let (base, from, carrier) = match &told.placed.kind {
            StageKind::Turn(turn) => (turn.about_name.clone(), turn.about.clone(), None),
            _ => {
                let velocity = told.after.velocity[*body].each_ref().map(|v| self.named(v));
                let center = words::center(self.scene, *body);
                (center, told.after.center[*body].clone(), Some(velocity))
            }
        };
        let arm = [0, 1].map(|k| &(&told.after.center[*body][k] + &from_center[k]) - &from[k]);
        let arm = arm.map(|e| tidied(self.scene, &e));
        let spin = self.named(&told.after.spin[*body]);
        let mut math = vec![name("v", point, "+", true), Math::Op("=")];
        if carrier.is_some() {
            math.extend([name("v", &base, "+", true), Math::Op("+")]);
        }
        math.extend([
            words::spin(self.scene, *body, "+"),
            Math::Op("×"),
            name("r", &format!("{point}/{base}"), "", true),
            Math::Op("="),
        ]);
        if let Some(velocity) = carrier {
            math.extend([Math::Brackets(vec![Math::Vector(velocity)]), Math::Op("+")]);
        }
        math.extend([
            Math::Brackets(vec![Math::Along(spin)]),
            Math::Op("×"),
            Math::Brackets(vec![Math::Vector(arm)]),
        ]);
        vec![Line { math, step: None }]
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
        let left = Math::Expr(energy(&Expr::symbol(symbol)));
        let math = vec![left, Math::Op("="), words::kinetic("", "+")];
        Some(Line { math, step: None })
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
        let inertia = match (ask, &told.inertia) {
            (Ask::Spin { .. }, Some([_, about])) => about.clone(),
            (Ask::Velocity { .. }, None) => {
                let moved = told.placed.kind.moved().into_iter();
                Expr::sum(moved.map(|b| match pulley(&told.placed, b) {
                    Some((_, apparent)) => tidied(self.scene, &apparent),
                    None => scene.bodies[b].mass.clone(),
                }))
            }
            _ => return None,
        };
        let energy = |of: &Expr| &(&Expr::ratio(1, 2) * &inertia) * &of.powi(2);
        // By Newton's laws no energy is told.
        let is_told = !told.work.is_empty() && told.steps.is_empty();
        if !is_told || tidied(self.scene, &energy(value)) != tidied(self.scene, end) {
            return None;
        }
        let left = Math::Expr(energy(&Expr::symbol(symbol)));
        let math = vec![left, Math::Op("="), words::kinetic("", "+")];
        Some(Line { math, step: None })
    }
}

/// The motion along a line in which a body is a pulley, and what it adds to the mass: its moment of inertia by the square
/// of its radius.
fn pulley(stage: &Stage, body: usize) -> Option<(&Slide, Expr)> {
    let StageKind::Slide(slide) = &stage.kind else {
        return None;
    };
    let b = &stage.scene.bodies[body];
    let radius = b.shape.radius()?;
    slide.pulleys().find(|p| *p == body)?;
    Some((slide, &b.inertia / &radius.powi(2)))
}

/// A formula with every occurrence of another one, also as some of its factors, by a symbol.
fn replaced(e: &Expr, part: &Expr, by: &Expr) -> Expr {
    if e == part {
        return by.clone();
    }
    match e.node() {
        Node::Sum(terms) => Expr::sum(terms.iter().map(|t| replaced(t, part, by))),
        Node::Power(base, exponent) => replaced(base, part, by).power(exponent.clone()),
        Node::Product(factors) => {
            let (number, rest) = part.split_number();
            let sought = match rest.node() {
                Node::Product(sought) => sought.clone(),
                _ => Vec::new(),
            };
            let mut left = factors.clone();
            let found = !sought.is_empty()
                && sought.iter().all(|f| {
                    let at = left.iter().position(|l| l == f);
                    at.map(|at| left.remove(at)).is_some()
                });
            match found {
                true => Expr::product(
                    left.into_iter()
                        .chain([Expr::from(number.recip()), by.clone()]),
                ),
                false => Expr::product(factors.iter().map(|f| replaced(f, part, by))),
            }
        }
        _ => e.clone(),
    }
}
