//! What is asked about the end of a stage: a box with each answer by what it is made of, in the names that stand on the page.

use super::Page;
use super::motion::driven;
use crate::answer::Answer;
use crate::expr::{Expr, Symbol, dot, only};
use crate::scene::{Ask, EnergyWhen, Question, Scene, Slide, StageKind};
use crate::solution::known;
use crate::solution::neat::tidied;
use crate::solution::opening::NUMBERS;
use crate::solution::words::{self, say};
use crate::solution::{Inline, Line, Math, Meaning, Part};
use crate::story::{Case, StageTold, Step};

/// Largest ratio of two velocities, in nodes, that needs no reason.
const RATIO: usize = 8;

/// What stands at the end of a stage.
#[derive(Default)]
struct End {
    /// How the answers come about.
    steps: Vec<Line>,
    /// The answers.
    boxed: Vec<Line>,
    /// What their letters stand for, where nothing above says it.
    letters: Vec<(Math, &'static str)>,
    /// Their numbers.
    numbers: Vec<Inline>,
    /// How the point moves that was told of last.
    carried: Option<Vec<Math>>,
}

impl End {
    /// Adds the number of an answer, where the scene gives every value.
    fn number(&mut self, scene: &Scene, symbol: &Symbol, answer: &Answer) {
        let Some(value) = known::number(scene, answer) else {
            return;
        };
        let lead = if self.numbers.is_empty() {
            NUMBERS
        } else {
            ", "
        };
        let name = words::formula(&Expr::symbol(symbol));
        self.numbers.extend([say(lead), name, say(value)]);
    }
}

impl Page<'_> {
    /// Answers about the end of a stage, of an impact in one of its outcomes; `from` is the first of its sections.
    pub(super) fn asked_of(&mut self, i: usize, outcome: usize, from: usize) {
        let mut end = End::default();
        let (scene, told) = (self.scene, self.told);
        let mut asked = Vec::new();
        for question in scene.questions.iter().filter(|q| q.ask.is_motion()) {
            let mine = |a: &&Answer| a.told == Some((i, outcome)) && a.question == question.name;
            let mine = told.answers.iter().filter(mine);
            asked.extend(mine.map(|answer| (question, answer)));
        }
        // What a motion finds stands in the order in which one follows from the other.
        let here = &told.stages[i];
        asked.sort_by_key(|(_, answer)| {
            let found = |s: &Step| {
                self.answering(here, s)
                    .is_some_and(|a| a.name == answer.name)
            };
            here.steps.iter().position(found).unwrap_or(usize::MAX)
        });
        // A flight lasts until it has a velocity, and leads as far as it lasts.
        if matches!(here.placed.kind, StageKind::Fall(_)) {
            asked.sort_by_key(|(question, _)| match question.ask {
                Ask::Velocity { .. } => 0,
                Ask::Time => 1,
                _ => 2,
            });
        }
        for (question, answer) in asked {
            if !self.is_in_speed(here, answer) {
                self.answer([i, outcome, from], question, answer, &mut end);
            }
        }
        self.speed_at_end(&told.stages[i], &mut end);
        self.boxed(here, outcome, &mut end);
        if !end.numbers.is_empty() {
            end.numbers.push(say("."));
            self.solution.text(end.numbers);
        }
    }

    /// Puts the answers so far into a box, behind what they come from.
    fn boxed(&mut self, told: &StageTold, outcome: usize, end: &mut End) {
        if end.boxed.is_empty() {
            return;
        }
        let steps = std::mem::take(&mut end.steps);
        if !steps.is_empty() {
            self.solution.push(Part::Display(steps));
        }
        let case = told.cases.get(outcome);
        if case.is_some_and(|case| !case.handed.is_empty()) {
            self.solution.say("In terms of the given quantities,");
        }
        self.meant(std::mem::take(&mut end.letters));
        let boxed = std::mem::take(&mut end.boxed);
        self.solution.push(Part::Result(boxed));
    }

    /// One answer about the end of a stage.
    fn answer(
        &mut self,
        [i, outcome, from]: [usize; 3],
        question: &Question,
        answer: &Answer,
        end: &mut End,
    ) {
        let Some(formula) = answer.formula() else {
            return;
        };
        let told = self.told;
        let here = &told.stages[i];
        let symbol = Symbol::from(answer.name.as_str());
        let axis = answer.axis();
        let suffix = axis.map_or("", |axis| ["_x", "_y"][axis]);
        let plain = format!("{}{suffix}", question.name);
        // What belongs to a further case is no question's answer by its name.
        let meaning = match answer.name == plain {
            true => Meaning::Answer(question.name.clone(), axis),
            false => Meaning::Defined,
        };
        let ask = here.placed.asked(question).clone();
        // What it comes from goes by the names that were told before.
        let by_energy = || self.in_speeds(here, &ask);
        let by_rolling = || self.rolled(here, &ask, formula);
        let flown = self.flown(here, &ask, answer).or_else(by_energy);
        let by_ratio = || self.tied(here, &ask, answer, formula);
        let by_plank = || self.gone_along(here, &ask);
        let by_mean_rate = || self.turned_by(here, &ask, formula);
        let flown = flown
            .or_else(by_mean_rate)
            .or_else(by_rolling)
            .or_else(by_ratio)
            .or_else(by_plank);
        let found = |s: &&Step| {
            let answering = self.answering(here, s);
            answering.is_some_and(|a| a.name == answer.name)
        };
        let made = here.steps.iter().find(found).filter(|_| flown.is_none());
        let made = made.map(|step| self.made_of(here, step));
        self.solution.meanings.insert(symbol.clone(), meaning);
        let mut carried = self.carried(here, &ask);
        // The other component comes from the same line.
        carried.retain(|line| end.carried.as_ref() != Some(&line.math));
        if let Some(last) = carried.last() {
            // The motion it is carried along with is told first.
            self.boxed(here, outcome, end);
            end.carried = Some(last.math.clone());
        }
        end.steps.extend(carried);
        let claimed = flown.as_ref().map(|[_, claimed]| claimed);
        let id = (self.solution).naming(&symbol, claimed, formula, &answer.words);
        // Within a case the name needs no number.
        let several = here.cases.len() > 1;
        let name = if several { plain.as_str() } else { &symbol };
        let mut math = vec![Math::Expr(Expr::symbol(name)), Math::Op("=")];
        if Self::is_end_energy(here, answer) && here.steps.is_empty() {
            math.extend([words::kinetic("", "+"), Math::Op("=")]);
        }
        end.steps
            .extend(self.energy_in(here, &question.ask, &symbol, formula));
        if let Some([shown, _]) = flown.filter(|[shown, _]| shown != formula) {
            math.extend([Math::Expr(shown), Math::Op("=")]);
        }
        math.extend(made.into_iter().flatten());
        math.push(Math::Expr(formula.clone()));
        // What is in given quantities already stands where it was found.
        let stands = |case: &Case| !changes(case, formula) && self.stands(from, name);
        if !here.cases.get(outcome).is_some_and(stands) {
            let lost = Self::lost_to(here, &ask);
            end.letters
                .extend(lost.map(|why| (Expr::symbol(name).into(), why)));
            let step = Some(id);
            end.boxed.push(Line { math, step });
        }
        end.number(self.scene, &symbol, answer);
    }

    /// What a loss of kinetic energy in a motion is called, with what it is lost to.
    fn lost_to(told: &StageTold, ask: &Ask) -> Option<&'static str> {
        let Ask::Energy {
            when: EnergyWhen::Lost,
            of: None,
        } = ask
        else {
            return None;
        };
        let is_alone = |s: &Slide| {
            let is_flat = s.level || s.gravity.is_none() || s.along[1].is_zero();
            // A belt takes up energy, or gives it.
            let is_belt = |b: usize| told.placed.scene.bodies[b].is_fixed();
            let is_driven = (s.on.iter()).any(|on| on.force.is_some() || is_belt(on.body));
            let is_pulled = s.force.is_some() || !s.strings.is_empty();
            is_flat && !is_driven && !is_pulled && !s.rolling
        };
        Some(match &told.placed.kind {
            StageKind::Impact { .. } => return None,
            // Beside weight, a force and strings nothing is lost to these alone.
            StageKind::Slide(slide) if is_alone(slide) => match (&slide.friction, &slide.spring) {
                (Some(_), None) => "the kinetic energy lost to friction",
                (None, Some(_)) => "the kinetic energy lost to the spring",
                (Some(_), Some(_)) => "the kinetic energy lost to friction and to the spring",
                (None, None) => "the kinetic energy lost",
            },
            _ => "the kinetic energy lost",
        })
    }

    /// The energy that a motion loses, or ends with, where its energies stand nowhere above: in the speeds, and to be held against
    /// the answer.
    fn in_speeds(&self, told: &StageTold, ask: &Ask) -> Option<[Expr; 2]> {
        let Ask::Energy { when, of: None } = ask else {
            return None;
        };
        let [start, end] = told.energy.as_ref().filter(|_| !told.steps.is_empty())?;
        let [before, after] = [&told.before, &told.after].map(|s| self.energy_at(told, s));
        match when {
            EnergyWhen::Lost => Some([before - after, start - end]),
            EnergyWhen::After => Some([after, end.clone()]),
            EnergyWhen::Before => None,
        }
    }

    /// The angular velocity of what has come to roll, by its speed over its radius.
    pub(super) fn rolled(&self, told: &StageTold, ask: &Ask, value: &Expr) -> Option<[Expr; 2]> {
        let StageKind::Slide(slide) = &told.placed.kind else {
            return None;
        };
        let radius = told.placed.scene.bodies[slide.body].shape.radius()?;
        if let (Ask::Angle { .. }, Some(way)) = (ask, &told.way) {
            let distance = self.to(told, |ask| matches!(ask, Ask::Distance))?;
            let ratio = tidied(self.scene, &(value * radius / way));
            let is_rim = ratio == Expr::one() || ratio == -Expr::one();
            let by = |way: &Expr| &ratio * way / radius;
            return is_rim.then(|| [by(&Expr::symbol(&distance.name)), by(way)]);
        }
        match ask {
            Ask::Spin { .. } => self.by_rim(told, value),
            _ => None,
        }
    }

    /// The angle through which a moment turns a body in a given time: the mean of the angular velocities times that time.
    fn turned_by(&self, told: &StageTold, ask: &Ask, value: &Expr) -> Option<[Expr; 2]> {
        let (StageKind::Turn(turn), Ask::Angle { .. }, Some(_)) =
            (&told.placed.kind, ask, driven(told))
        else {
            return None;
        };
        let spins = [&told.before, &told.after].map(|s| &s.spin[turn.body]);
        let by =
            |spins: [Expr; 2]| Some(Expr::ratio(1, 2) * Expr::sum(spins) * told.time.as_ref()?);
        let [shown, whole] = [
            by(spins.map(|w| self.named(w)))?,
            by(spins.map(Expr::clone))?,
        ];
        let gap = |whole: &Expr| tidied(self.scene, &(value - whole)).is_zero();
        match (gap(&whole), gap(&-&whole)) {
            (true, _) => Some([shown, whole]),
            (_, true) => Some([-shown, -whole]),
            _ => None,
        }
    }

    /// The angular velocity of what rolls, by its speed over its radius: by letters and in full.
    pub(super) fn by_rim(&self, told: &StageTold, value: &Expr) -> Option<[Expr; 2]> {
        let body = *told.placed.kind.moved().first()?;
        let radius = told.placed.scene.bodies[body].shape.radius()?;
        let find = |letter: &str| told.steps.iter().find(|s| s.letter == letter);
        let speed = find("v").filter(|s| self.serves(told, s))?;
        let below = find("V");
        // On a body that moves too it is the speed over that one.
        let over = |of: &dyn Fn(&Step) -> Expr| match below {
            Some(below) => of(speed) - of(below),
            None => of(speed),
        };
        let [by_letter, by_value] = [
            over(&|s| self.letter_of(told, s)),
            over(&|s| s.value.clone()),
        ];
        if by_value.is_zero() {
            return None;
        }
        let way = tidied(self.scene, &(value * radius / &by_value));
        let is_rim = way == Expr::one() || way == -Expr::one();
        is_rim.then(|| [by_letter, by_value].map(|speed| &way * &speed / radius))
    }

    /// Where a body that slides on another has come to, or the one below it, x + V t + A t²/2, by letters and in full.
    fn gone_along(&self, told: &StageTold, ask: &Ask) -> Option<[Expr; 2]> {
        let (
            StageKind::Slide(slide),
            Ask::Position {
                body,
                along,
                at_end: true,
            },
        ) = (&told.placed.kind, ask)
        else {
            return None;
        };
        let (on, along) = (slide.on.as_ref()?, along.as_ref()?);
        let way = tidied(self.scene, &dot(along, &slide.along));
        let letter = match () {
            () if on.company().contains(body) => "A",
            () if slide.company().contains(body) => "a",
            () => return None,
        };
        let is_along = way.is_one() || (-&way).is_one();
        let step = |letter: &str| told.steps.iter().find(|s| s.letter == letter);
        let time = step("t")?;
        let [from, speed] = [&told.before.center[*body], &told.before.velocity[*body]]
            .map(|v| tidied(self.scene, &dot(v, along)));
        let speed = self.named(&speed);
        let after = |rate: &Expr, time: &Expr| {
            let gained = Expr::ratio(1, 2) * &way * rate * time.powi(2);
            &from + &speed * time + gained
        };
        let [by_letters, in_full] = match step(letter).filter(|s| !s.value.is_zero()) {
            Some(rate) => [self.letter_of(told, rate), rate.value.clone()],
            None => [Expr::zero(), Expr::zero()],
        };
        let t = self.letter_of(told, time);
        is_along.then(|| [after(&by_letters, &t), after(&in_full, &time.value)])
    }

    /// What strings tie to the body that moves along a line, in a fixed ratio to what stands above: half as fast, or turning
    /// with the string over a radius.
    fn tied(
        &self,
        told: &StageTold,
        ask: &Ask,
        answer: &Answer,
        value: &Expr,
    ) -> Option<[Expr; 2]> {
        let letter = match ask {
            Ask::Acceleration { .. } => "a",
            Ask::Velocity { point: None, .. } | Ask::Spin { .. } => "v",
            _ => return None,
        };
        let is_own = |s: &Step| {
            self.answering(told, s)
                .is_some_and(|a| a.name == answer.name)
        };
        let StageKind::Slide(slide) = &told.placed.kind else {
            return None;
        };
        // Without a string the velocity asked for is a component of the one along the line.
        let may_be = !slide.strings.is_empty() || matches!(ask, Ask::Velocity { .. });
        if !may_be || value.is_zero() || told.steps.iter().any(is_own) {
            return None;
        }
        let step = told
            .steps
            .iter()
            .find(|s| s.letter == letter && !s.value.is_zero() && self.serves(told, s))?;
        let others = self.answered(told).filter(|a| {
            let is_told = self.solution.meanings.contains_key(a.name.as_str());
            letter == "v"
                && is_told
                && matches!(self.ask(a), Some(Ask::Velocity { point: None, .. }))
        });
        let others = others.filter_map(|a| Some((Expr::symbol(&a.name), a.formula()?)));
        let all = others.chain([(self.letter_of(told, step), &step.value)]);
        let ratios = all.map(|(of, size)| (tidied(self.scene, &(value / size)), of, size));
        let (ratio, of, size) = ratios.min_by_key(|(ratio, ..)| ratio.size())?;
        (ratio.size() <= RATIO).then(|| [&ratio * of, &ratio * size])
    }

    /// The speed that is asked for at the end of a motion: its formula in the components of a velocity, and the answer.
    pub(super) fn speed_asked(&self, told: &StageTold) -> Option<(&'_ Expr, &'_ Answer)> {
        if !told.cases.is_empty() {
            return None;
        }
        self.scene.questions.iter().find_map(|question| {
            let Ask::Value {
                formula, meaning, ..
            } = &question.ask
            else {
                return None;
            };
            let all = self.told.answers.iter();
            let answer = only(all.filter(|a| a.question == question.name))?;
            let is_here = |s: &Symbol| self.answered(told).any(|a| *a.name == **s);
            let all_here = formula.symbols().iter().all(is_here);
            (meaning.starts_with("speed of ") && all_here).then_some((formula, answer))
        })
    }

    /// The speed that is asked for, by the components that stand above or by the energy.
    fn speed_at_end(&mut self, told: &StageTold, end: &mut End) {
        let Some((formula, answer)) = self.speed_asked(told) else {
            return;
        };
        let Some(value) = answer.formula() else {
            return;
        };
        let (formula, answer, value) = (formula.clone(), answer.clone(), value.clone());
        let symbol = Symbol::from(answer.name.as_str());
        let is_told = |s: &Symbol| self.solution.meanings.contains_key(s);
        let by_parts = formula.symbols().iter().all(is_told);
        let energy = self.energy_of_speed(told, &symbol, &value);
        self.solution
            .meanings
            .insert(symbol.clone(), Meaning::Defined);
        let made_of = Some(&formula).filter(|_| by_parts);
        let id = (self.solution).naming(&symbol, made_of, &value, &answer.words);
        end.steps.extend(energy);
        let mut math = vec![Math::Expr(Expr::symbol(&symbol)), Math::Op("=")];
        if by_parts {
            math.extend([Math::Expr(formula), Math::Op("=")]);
        }
        math.push(Math::Expr(value));
        let step = Some(id);
        end.boxed.push(Line { math, step });
        end.number(self.scene, &symbol, &answer);
    }

    /// Whether this is a component of a velocity that its speed says as well: it is zero, or all of it.
    fn is_in_speed(&self, told: &StageTold, answer: &Answer) -> bool {
        let Some((_, speed)) = self.speed_asked(told) else {
            return false;
        };
        let (Some(part), Some(value)) = (answer.formula(), speed.formula()) else {
            return false;
        };
        let opposite = tidied(self.scene, &-value);
        answer.question == format!("{}_velocity", speed.question)
            && (part.is_zero() || part == value || *part == opposite)
    }

    /// Whether a line tells of this symbol, from this section on.
    fn stands(&self, from: usize, name: &str) -> bool {
        let name = Math::Expr(Expr::symbol(name));
        let parts = self.solution.sections[from..].iter().flat_map(|s| &s.parts);
        let mut lines = parts.flat_map(|part| match part {
            Part::Display(lines) | Part::Result(lines) => lines.as_slice(),
            _ => &[],
        });
        lines.any(|line| line.math.contains(&name))
    }
}

/// Whether a result reads otherwise in given quantities than in those an earlier stage handed on to this case.
fn changes(case: &Case, formula: &Expr) -> bool {
    let (_, derivation) = case.asked(&[]);
    !case.handed.is_empty()
        && !derivation
            .answers
            .iter()
            .any(|a| a.formula() == Some(formula))
}
