//! The worked solution of a scene with stages: a section for each stage, then what is asked, then what it all rests on.
//!
//! In: a scene and its story as told. Out: a [`Solution`]. An impact is written by the same code as a single collision, with
//! the motion handed on by the stage before; a motion is an energy balance, whose lines are claims like all others.

use super::asked::{self, answered, full_sentence};
use super::words::{self, name, say};
use super::{
    Before, Claim, Detail, Inline, Line, Math, Meaning, Part, Scope, Slot, Solution, Writer,
};
use crate::answer::Answer;
use crate::expr::{Expr, Node, Symbol, dot};
use crate::formula::Sentence;
use crate::scene::{Ask, FallEnd, Question, Scene, Stage, StageKind};
use crate::story::{Case, StageTold, Told};

/// Writes the solution of a story.
pub fn tell(scene: &Scene, told: &Told, detail: Detail) -> Solution {
    let mut page = Page {
        scene,
        told,
        solution: blank(scene, told, detail),
        valid: Vec::new(),
    };
    page.opening();
    for i in 0..told.stages.len() {
        page.stage(i);
    }
    page.questions();
    page.rests_on();
    page.solution
}

fn blank(scene: &Scene, told: &Told, detail: Detail) -> Solution {
    let mut names = std::collections::BTreeMap::new();
    let mut put = |name: &str, latex: &str| {
        if words::is_safe_latex(latex) {
            names.insert(Symbol::from(name), latex.to_string());
        }
    };
    for p in &scene.parameters {
        if let Some(latex) = &p.latex {
            put(&p.name, latex);
        }
    }
    for a in &told.answers {
        put(&a.name, &a.latex);
    }
    let stages = told.stages.iter().flat_map(|s| &s.assumptions);
    let given = told.answers.iter().flat_map(|a| &a.assumptions);
    let mut assumptions = told.readings.clone();
    assumptions.extend(stages.chain(given).map(ToString::to_string));
    let mut seen = std::collections::BTreeSet::new();
    assumptions.retain(|a| seen.insert(a.clone()));
    Solution {
        title: scene.title.clone(),
        source: super::source(scene),
        statement: scene.statement.clone(),
        detail,
        names,
        meanings: Default::default(),
        sections: Vec::new(),
        steps: Vec::new(),
        scopes: Vec::new(),
        assumptions,
        mode: None,
    }
}

/// A solution under way.
struct Page<'a> {
    scene: &'a Scene,
    told: &'a Told,
    solution: Solution,
    /// What the impacts are valid for, told at the end.
    valid: Vec<Inline>,
}

impl Page<'_> {
    /// What is told, and how it is read.
    fn opening(&mut self) {
        self.solution.section(0, Vec::new());
        if !self.solution.statement.is_empty() {
            let statement = words::with_symbols(self.scene, &self.solution.statement);
            self.solution.text(statement);
        }
        if self.solution.detail == Detail::Brief {
            return;
        }
        if let Some(text) = words::meant(self.scene) {
            self.solution.text(text);
        }
        if !self.told.readings.is_empty() {
            self.solution
                .text(vec![say("The statement is read as follows:")]);
            self.readings();
        }
        self.solution.text(vec![say(
            "Let x point right and y up; counterclockwise is positive unless said otherwise.",
        )]);
    }

    fn readings(&mut self) {
        let each = self.told.readings.iter();
        let items = each.map(|r| {
            let mut item = words::with_symbols(self.scene, r);
            item.push(say("."));
            item
        });
        let items = items.collect();
        self.solution.push(Part::List(items));
    }

    fn stage(&mut self, i: usize) {
        let (told, stage) = (&self.told.stages[i], &self.told.stages[i].placed);
        let number = match self.told.stages.len() {
            1 => String::new(),
            _ => format!("{}. ", i + 1),
        };
        let title = words::capital(&told.name.replace('_', " "));
        self.solution
            .section(0, vec![say(format!("{number}{title}"))]);
        let brief = self.solution.detail == Detail::Brief;
        if !brief {
            self.from(i);
            match told.words.as_slice() {
                [] => {}
                [one] => self.solution.text(full_sentence(self.scene, one)),
                all => {
                    let items = all.iter().map(|w| full_sentence(self.scene, w)).collect();
                    self.solution.push(Part::List(items));
                }
            }
        }
        self.solution.push(Part::Figure(Slot::Stage(i)));
        if timed(told).is_some() {
            let flies = stage.kind.moved();
            let called = |b: &usize| match self.scene.bodies[*b].is_particle() {
                true => words::body(self.scene, *b),
                false => format!("the center of mass of {}", words::body(self.scene, *b)),
            };
            let who = flies.first().map_or_else(String::new, called);
            let weight = format!("The weight gives {who} the constant acceleration ");
            let g = gravity(told);
            self.solution
                .text(vec![say(weight), words::formula(&g), say(" downward.")]);
        } else {
            self.kept(told);
            if told.cases.is_empty() {
                self.motion(stage, told);
            }
        }
        for (k, case) in told.cases.iter().enumerate() {
            self.impact(stage, told, case, k);
        }
        self.asked_of(i);
        if brief || !told.cases.is_empty() {
            return;
        }
        if !told.assumptions.is_empty() {
            let mut text = vec![say("Assumed: ")];
            text.extend(asked::sentence(
                self.scene,
                &Sentence::join(told.assumptions.clone(), "; "),
            ));
            text.push(say("."));
            self.solution.text(text);
        }
        if let Some(words) = asked::worth_telling(&told.checks, self.solution.detail) {
            self.solution
                .text(vec![say(asked::called(self.scene, &words))]);
        }
    }

    /// What the stage keeps and what not: of a motion its energy, for an impact the balances themselves say why they hold; all
    /// of it at full length.
    fn kept(&mut self, told: &StageTold) {
        let full = self.solution.detail == Detail::Full;
        if self.solution.detail == Detail::Brief || (!full && !told.cases.is_empty()) {
            return;
        }
        let named = told.kept.iter().filter(|k| full || k.what == "energy");
        let mut items: Vec<Vec<Inline>> = named
            .map(|k| {
                let is = if k.conserved { "is" } else { "is not" };
                let lead = format!("{} {is} conserved: ", k.what);
                let text = Sentence([Sentence::words(lead).0, k.why.0.clone()].concat());
                full_sentence(self.scene, &text)
            })
            .collect();
        match items.len() {
            0 => {}
            1 => self.solution.text(items.remove(0)),
            _ => self.solution.push(Part::List(items)),
        }
    }

    /// Where a stage begins, if that is not where the one before it ends.
    fn from(&mut self, i: usize) {
        let text = match self.told.stages[i].branch {
            None if i > 0 => String::from("This begins anew, with the bodies as they are given."),
            Some((j, _)) if j + 1 != i => {
                let stage = words::stage(&self.told.stages[j].name);
                format!("This goes on from the end of {stage}.")
            }
            _ => return,
        };
        self.solution.text(vec![say(text)]);
    }

    /// An impact, written like a collision by itself.
    fn impact(&mut self, stage: &Stage, told: &StageTold, case: &Case, k: usize) {
        let several = told.cases.len() > 1;
        let id = if several {
            format!("{}/{}", told.name, k + 1)
        } else {
            told.name.clone()
        };
        if several {
            let mut heading = vec![say(format!("Case {}: ", k + 1))];
            heading.extend(asked::sentence(
                self.scene,
                &Sentence::join(
                    case.conditions.iter().map(|(_, e)| {
                        Sentence([Sentence::from(e).0, Sentence::words(" ≥ 0").0].concat())
                    }),
                    " and ",
                ),
            ));
            self.solution.section(1, heading);
        }
        let (scene, derivation) = case.asked();
        if self.solution.detail != Detail::Brief {
            self.handed(case);
        }
        let mut writer = Writer::new(&scene, &derivation, &case.proof, self.solution.detail);
        writer.nested = true;
        // The text goes on where it stands; symbols belong to the impact.
        let first = self.solution.steps.len();
        std::mem::swap(&mut writer.solution.sections, &mut self.solution.sections);
        std::mem::swap(&mut writer.solution.steps, &mut self.solution.steps);
        let mut names = self.solution.names.clone();
        names.append(&mut writer.solution.names);
        writer.solution.names = names;
        writer.friction();
        writer.blocks();
        if !derivation.definitions.is_empty() {
            writer.results();
        }
        // That everything was checked is told once, at the end.
        if self.solution.detail == Detail::Full || !case.proof.holds() {
            writer.checked();
        }
        for condition in writer.conditions() {
            let known = |s: &Symbol| self.scene.parameters.iter().any(|p| p.name == *s);
            let all_known = asked::symbols(&condition).all(|s| known(&s));
            if all_known && !self.valid.contains(&condition) {
                self.valid.push(condition);
            }
        }
        std::mem::swap(&mut writer.solution.sections, &mut self.solution.sections);
        std::mem::swap(&mut writer.solution.steps, &mut self.solution.steps);
        self.solution.names = writer.solution.names;
        for step in &mut self.solution.steps[first..] {
            step.scope = Some(id.clone());
        }
        let before = scene
            .bodies
            .iter()
            .filter(|b| !b.is_fixed())
            .map(|b| Before {
                body: b.name.clone(),
                center: b.center.clone(),
                angle: b.angle.clone(),
                velocity: b.velocity.clone(),
                spin: b.spin.clone(),
            })
            .collect();
        self.solution.scopes.push(Scope {
            name: id,
            stage: stage.name.clone(),
            active: case.active.clone(),
            mode: super::decided(&scene),
            handed: case.handed.clone(),
            open: told.before.open.keys().cloned().collect(),
            before,
            meanings: writer.solution.meanings,
        });
    }

    /// What an earlier stage hands on, where it got a symbol of its own.
    fn handed(&mut self, case: &Case) {
        if case.handed.is_empty() {
            return;
        }
        let mut text = vec![say("From the stage before, ")];
        for (i, (name, value)) in case.handed.iter().enumerate() {
            if i > 0 {
                text.push(say(" and "));
            }
            text.push(words::equation(&Expr::symbol(name), value));
        }
        text.push(say("."));
        self.solution.text(text);
    }

    /// A motion by Newton's laws: what the letters stand for, then forces, accelerations, and what they come to.
    fn steps(&mut self, told: &StageTold) {
        let taken = |step: &crate::story::Step| {
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
            let letter = name(step.letter, index, mark, false);
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
            let mut math = vec![letter, Math::Op("=")];
            if crate::formula::write_plain(&step.raw) != crate::formula::write_plain(&step.value) {
                math.extend([Math::Expr(step.raw.clone()), Math::Op("=")]);
            }
            math.push(Math::Expr(step.value.clone()));
            let claim = Claim {
                left: step.raw.clone(),
                right: step.value.clone(),
            };
            let claimed = self.solution.step(Vec::new(), vec![claim], step.why);
            lines.push(Line {
                math,
                step: Some(claimed),
            });
        }
        letters.push(say("."));
        if self.solution.detail != Detail::Brief {
            self.solution.text(letters);
        }
        self.solution.push(Part::Display(lines));
    }

    /// A motion: inertia, work and energy, from the beginning to the end.
    fn motion(&mut self, stage: &Stage, told: &StageTold) {
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
        let chain = |head: Vec<Math>, raw: &Expr, value: &Expr| {
            let mut math = head;
            math.push(Math::Op("="));
            if !alike(raw, value) {
                math.extend([Math::Expr(raw.clone()), Math::Op("=")]);
            }
            math.push(Math::Expr(value.clone()));
            math
        };
        if let (Some([raw, tidy]), StageKind::Turn(turn)) = (&told.inertia, &stage.kind) {
            let math = chain(vec![name("I", &turn.about_name, "", false)], raw, tidy);
            let step = claim(
                &mut self.solution,
                raw,
                tidy,
                "moment of inertia about the fixed point: I + m r²",
            );
            lines.push(Line { math, step });
        }
        let t = |mark| vec![name("T", "", mark, false)];
        let raw = self.start_energy(stage, told);
        let math = chain(t("-"), &raw, start);
        let step = claim(
            &mut self.solution,
            &raw,
            start,
            "kinetic energy at the beginning",
        );
        lines.push(Line { math, step });
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
        math.extend([Math::Op("="), name("T", "", "-", false)]);
        if !told.work.is_empty() {
            math.extend([Math::Op("+"), name("W", "", "", false)]);
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
    fn named(&self, e: &Expr) -> Expr {
        let minus = -e;
        let told = |a: &&Answer| {
            let known = self.solution.meanings.contains_key(a.name.as_str());
            known && a.formula().is_some_and(|f| f == e || *f == minus)
        };
        match self.told.answers.iter().find(told) {
            Some(a) if !e.symbols().is_empty() => match a.formula() == Some(e) {
                true => Expr::symbol(&a.name),
                false => -Expr::symbol(&a.name),
            },
            _ => e.clone(),
        }
    }

    /// Where a body is, or how it moves, after a flight of a known time, in the motion it began with.
    fn flown(&self, told: &StageTold, ask: &Ask, axis: Option<usize>) -> Option<Expr> {
        let time = timed(told)?;
        let (body, along, is_place) = match ask {
            Ask::Position {
                body,
                along,
                at_end: true,
            } => (*body, along, true),
            Ask::Velocity {
                body,
                point: None,
                along,
            } => (*body, along, false),
            _ => return None,
        };
        let along = match (along, axis) {
            (Some(along), _) => along.clone(),
            (None, axis) => [0, 1].map(|k| Expr::from(i64::from(axis == Some(k)))),
        };
        if !told.placed.kind.moved().contains(&body) {
            return None;
        }
        let v = told.before.velocity[body].each_ref().map(|v| self.named(v));
        let falls = &along[1] * &gravity(told);
        let gained = -(&falls * time);
        Some(match is_place {
            true => {
                let way = dot(&v, &along) * time - Expr::ratio(1, 2) * &falls * time.powi(2);
                tidied(self.scene, &dot(&told.before.center[body], &along)) + way
            }
            false => dot(&v, &along) + gained,
        })
    }

    /// Answers about the end of a stage.
    fn asked_of(&mut self, i: usize) {
        let mut lines: Vec<(usize, Line)> = Vec::new();
        let mut steps = Vec::new();
        let mut numbers = Vec::new();
        let several = self.told.stages[i].cases.len() > 1;
        for question in self.scene.questions.iter() {
            if !question.ask.is_motion() {
                continue;
            }
            let all = self.told.answers.iter();
            let mine: Vec<&Answer> = all
                .filter(|a| a.told.is_some_and(|(t, _)| t == i) && a.question == question.name)
                .collect();
            for answer in mine {
                let Some(formula) = answer.formula() else {
                    continue;
                };
                let symbol = Symbol::from(answer.name.as_str());
                let axis = match answer.name.strip_prefix(question.name.as_str()) {
                    Some("") => Some(None),
                    Some("_x") => Some(Some(0)),
                    Some("_y") => Some(Some(1)),
                    _ => None,
                };
                let is_fresh = axis.is_none();
                let meaning = match axis {
                    Some(axis) => Meaning::Answer(question.name.clone(), axis),
                    None => Meaning::Defined,
                };
                self.solution.meanings.insert(symbol.clone(), meaning);
                let ask = self.told.stages[i].placed.asked(question).clone();
                let flown = self.flown(&self.told.stages[i], &ask, axis.flatten());
                let flown = flown.filter(|raw| !alike(raw, formula));
                let sides = [Some(&Expr::symbol(&symbol)), flown.as_ref()];
                let claims = sides.into_iter().flatten().map(|left| Claim {
                    left: left.clone(),
                    right: formula.clone(),
                });
                let id = self
                    .solution
                    .step(Vec::new(), claims.collect(), &answer.words);
                if let Some(step) = self.solution.steps.last_mut() {
                    step.defines = is_fresh.then(|| symbol.clone());
                }
                let mut math = vec![Math::Expr(Expr::symbol(&symbol)), Math::Op("=")];
                if Self::is_end_energy(&self.told.stages[i], answer) {
                    math.extend([name("T", "", "+", false), Math::Op("=")]);
                }
                steps.extend(self.energy_in(&self.told.stages[i], &question.ask, &symbol, formula));
                if let Some(raw) = flown {
                    math.extend([Math::Expr(raw), Math::Op("=")]);
                }
                math.push(Math::Expr(formula.clone()));
                let outcome = answer.told.map_or(0, |(_, k)| k);
                // Within a case the name needs no number; what is in given quantities already stands in its box.
                if several && let Some(axis) = axis_of(&question.name, &answer.name) {
                    math[0] = Math::Expr(Expr::symbol(&format!("{}{axis}", question.name)));
                }
                let case = self.told.stages[i].cases.get(outcome);
                if case.is_none_or(|case| changes(case, formula)) {
                    let step = Some(id);
                    lines.push((outcome, Line { math, step }));
                }
                if let Some(value) = asked::number(self.scene, answer) {
                    numbers.push(vec![words::formula(&Expr::symbol(&symbol)), say(value)]);
                }
            }
        }
        if !lines.is_empty() && !steps.is_empty() {
            self.solution.push(Part::Display(steps));
        }
        let cases = self.told.stages[i].cases.len();
        for k in 0..cases.max(1) {
            let of_it = lines.iter().filter(|(outcome, _)| *outcome == k);
            let of_it: Vec<Line> = of_it.map(|(_, line)| line.clone()).collect();
            if of_it.is_empty() {
                continue;
            }
            match cases {
                0 => {}
                1 => self
                    .solution
                    .text(vec![say("In terms of the given quantities,")]),
                _ => self.solution.text(vec![say(format!(
                    "In terms of the given quantities, in case {},",
                    k + 1
                ))]),
            }
            self.solution.push(Part::Result(of_it));
        }
        if !numbers.is_empty() {
            self.solution.push(Part::List(numbers));
        }
    }

    /// Whether this answer is the kinetic energy at the end of a motion.
    fn is_end_energy(told: &StageTold, answer: &Answer) -> bool {
        let Some([_, end]) = &told.energy else {
            return false;
        };
        let mut asked = told.placed.scene.questions.iter();
        answer.formula() == Some(end)
            && asked.any(|q| q.name == answer.name && matches!(q.ask, Ask::Energy { .. }))
    }

    /// The kinetic energy at the end in terms of the speed or spin that is asked for, ½ I ω² = T⁺, where that gives its value.
    fn energy_in(
        &self,
        told: &StageTold,
        ask: &Ask,
        symbol: &Symbol,
        value: &Expr,
    ) -> Option<Line> {
        let [_, end] = told.energy.as_ref()?;
        let scene = &told.placed.scene;
        let inertia = match (ask, &told.inertia) {
            (Ask::Spin { .. }, Some([_, about])) => about.clone(),
            (Ask::Velocity { .. }, None) => {
                let moved = told.placed.kind.moved();
                Expr::sum(moved.into_iter().map(|b| scene.bodies[b].mass.clone()))
            }
            _ => return None,
        };
        let energy = |of: &Expr| &(&Expr::ratio(1, 2) * &inertia) * &of.powi(2);
        if told.work.is_empty() || tidied(self.scene, &energy(value)) != *end {
            return None;
        }
        let left = Math::Expr(energy(&Expr::symbol(symbol)));
        let math = vec![left, Math::Op("="), name("T", "", "+", false)];
        Some(Line { math, step: None })
    }

    /// What is asked beyond the motion.
    fn questions(&mut self) {
        for question in self.scene.questions.iter() {
            // What happens in a stage stands where the stage is told.
            if question.ask.is_motion() || matches!(question.ask, Ask::Assumed | Ask::Describe) {
                continue;
            }
            let mine = self.told.answers.iter();
            let mine: Vec<Answer> = mine
                .filter(|a| a.question == question.name)
                .cloned()
                .collect();
            answered(&mut self.solution, self.scene, &question.ask, &mine);
        }
    }

    /// What is taken for granted, data that no answer needs, and how the results were checked.
    fn rests_on(&mut self) {
        let mut items: Vec<Vec<Inline>> = Vec::new();
        for a in self.assumed() {
            items.push(full_sentence(self.scene, &a));
        }
        if !self.told.unused.is_empty() {
            let mut text = vec![say("Given, but needed for no answer: ")];
            for (i, p) in self.told.unused.iter().enumerate() {
                if i > 0 {
                    text.push(say(", "));
                }
                text.push(words::formula(&Expr::symbol(p)));
            }
            text.push(say("."));
            items.push(text);
        }
        if !self.valid.is_empty() && self.solution.detail == Detail::Normal {
            let mut text = vec![say("The impacts hold for ")];
            let count = self.valid.len();
            for (i, condition) in std::mem::take(&mut self.valid).into_iter().enumerate() {
                text.push(say(match (i, i + 1 == count) {
                    (0, _) => "",
                    (_, true) => " and ",
                    _ => ", ",
                }));
                text.push(condition);
            }
            text.push(say("."));
            items.push(text);
        }
        if !items.is_empty() {
            self.solution.section(0, vec![say("Assumptions")]);
            self.solution.push(Part::List(items));
        }
        let stages = self.told.stages.iter().flat_map(|s| &s.checks);
        let answers = self.told.answers.iter().flat_map(|a| &a.checks);
        let followed = |c: &&crate::answer::Check| c.kind == "integration";
        let mut followed = stages.chain(answers).filter(followed).peekable();
        let is_followed = followed.peek().is_some() && followed.all(|c| c.holds == Some(true));
        let words = match self.told.holds() {
            false => "A check failed: do not use these results before the fault is found.",
            true if self.solution.detail != Detail::Normal => return,
            true if is_followed => {
                "Check: followed in time numerically, from the given data alone, the scene ends with the same values."
            }
            true if self.told.stages.iter().any(|s| !s.cases.is_empty()) => {
                "Check: the results of the impacts satisfy every equation of momentum, joints and contacts, and an independent numerical solution agrees."
            }
            true => return,
        };
        self.solution.text(vec![say(words)]);
    }

    /// What is taken for granted and does not stand above: readings of the statement are told first, and what a motion assumes
    /// where the motion is told.
    fn assumed(&self) -> Vec<Sentence> {
        let all = self.told.assumed();
        if self.solution.detail == Detail::Brief {
            return all;
        }
        let motions = self.told.stages.iter().filter(|s| s.cases.is_empty());
        let said: Vec<&Sentence> = motions.flat_map(|s| &s.assumptions).collect();
        let unread = all.into_iter().skip(self.told.readings.len());
        unread.filter(|a| !said.contains(&a)).collect()
    }
}

/// What follows the name of a question in that of its answer: nothing, or an axis; numbers of outcomes are left out.
fn axis_of(question: &str, answer: &str) -> Option<&'static str> {
    let rest = answer.strip_prefix(question)?;
    Some(match rest {
        _ if rest.starts_with("_x") => "_x",
        _ if rest.starts_with("_y") => "_y",
        _ => "",
    })
}

/// Whether a result reads otherwise in given quantities than in those an earlier stage handed on to this case.
fn changes(case: &Case, formula: &Expr) -> bool {
    let (_, derivation) = case.asked();
    !case.handed.is_empty()
        && !derivation
            .answers
            .iter()
            .any(|a| a.formula() == Some(formula))
}

/// An expression as a person would write it.
fn tidied(scene: &Scene, e: &Expr) -> Expr {
    let mut field = crate::algebra::Field::new(&scene.domains);
    field.prepare([e]);
    match field.element(e) {
        Ok(x) => field.expr(&x),
        Err(_) => e.clone(),
    }
}

/// The time of a flight under gravity that ends after a given time; `None` for what is told by its energy.
fn timed(told: &StageTold) -> Option<&Expr> {
    let StageKind::Fall(fall) = &told.placed.kind else {
        return None;
    };
    let energy = |q: &Question| matches!(q.ask, Ask::Energy { .. });
    let by_time = matches!(fall.until, FallEnd::Time(_)) && fall.gravity.is_some();
    let is_asked = told.placed.scene.questions.iter().any(energy);
    told.time
        .as_ref()
        .filter(|_| by_time && fall.with.is_empty() && !is_asked)
}

/// The acceleration of gravity of a fall; zero elsewhere.
fn gravity(told: &StageTold) -> Expr {
    let StageKind::Fall(fall) = &told.placed.kind else {
        return Expr::zero();
    };
    fall.gravity.clone().unwrap_or_else(Expr::zero)
}

/// Whether two formulas are one product, whatever the order of its factors.
fn alike(a: &Expr, b: &Expr) -> bool {
    match (a.node(), b.node()) {
        (Node::Product(x), Node::Product(y)) => {
            x.len() == y.len() && x.iter().all(|f| y.contains(f))
        }
        _ => a == b,
    }
}
