//! A motion in a worked solution by Newton's laws: what the letters stand for, then forces, accelerations, and what they come to.

use super::Page;
use crate::answer::Answer;
use crate::expr::{Expr, Node, Symbol, dot};
use crate::scene::{Ask, SlideEnd, StageKind};
use crate::solution::neat::{alike, neat, tidied};
use crate::solution::words::{self, name, say};
use crate::solution::{Claim, Detail, Inline, Line, Math, Meaning};
use crate::story::{StageTold, State, Step};

/// Smallest formula, in nodes, whose name is worth standing for it.
pub(super) const WORTH_A_NAME: usize = 6;
/// The speed at the beginning of a motion along a line.
const START: &str = "v_0";

/// Why nothing speeds a motion along a line up or slows it down.
fn steady(told: &StageTold) -> &'static str {
    match &told.placed.kind {
        StageKind::Slide(s) if told.work.is_empty() && s.on.is_some() => {
            "No force acts along the line, so both velocities stay as they are."
        }
        StageKind::Slide(s) if told.work.is_empty() && s.strings.is_empty() => {
            "No force acts along the line, so the velocity stays as it is."
        }
        _ => "The forces along the line balance, so the velocity stays as it is.",
    }
}

impl Page<'_> {
    /// A motion by Newton's laws: what the letters stand for, then forces, accelerations, and what they come to.
    pub(super) fn steps(&mut self, told: &StageTold) {
        let mut lines = Vec::new();
        let mut letters: Vec<(Math, &'static str)> = Vec::new();
        let steps: Vec<&Step> = told.steps.iter().filter(|s| self.serves(told, s)).collect();
        if let Some((symbol, value)) = self.start(told) {
            let why = "the speed at the beginning";
            letters.push((Math::Expr(symbol.clone()), why));
            let claim = Claim::new(symbol.clone(), value.clone());
            let id = self.solution.step(Vec::new(), vec![claim], why);
            if let Some(step) = self.solution.steps.last_mut() {
                step.defines = Some(Symbol::from(START));
            }
            let meanings = &mut self.solution.meanings;
            meanings.insert(Symbol::from(START), Meaning::Defined);
            lines.push(Line {
                math: words::related(&symbol, "=", &value),
                step: Some(id),
            });
        }
        for step in steps {
            let mark = mark(step);
            // What is asked for goes by the name of its answer, and stands in the box.
            let answer = self.answering(told, step);
            let letter = match answer {
                Some(answer) => Math::Expr(Expr::symbol(&answer.name)),
                None => name(step.letter, self.index(told, step), mark, false),
            };
            letters.push((letter.clone(), step.why));
            let is_boxed = answer.is_some();
            let made = match &step.inertia {
                Some(inertia) => inertia * &step.value,
                None => step.value.clone(),
            };
            let claim = Claim::new(step.raw.clone(), made);
            let claimed = self.solution.step(Vec::new(), vec![claim], step.why);
            let mut math = Vec::new();
            if let Some(inertia) = step.inertia.as_ref().filter(|_| !step.raw.is_zero()) {
                let inertia = spread(&neat(self.scene, inertia));
                let force = self.by_names(&step.raw, &step.value);
                let force = self.by_letter(told, "F", 0, &force);
                let force = spread(&neat(self.scene, &force));
                math.extend([Math::Factor(inertia), letter.clone(), Math::Op("=")]);
                math.push(Math::Expr(force));
                if !is_boxed {
                    math.push(Math::Op("⇒"));
                }
            } else if let Some(law) = self.law(told, step) {
                math.extend(law);
                if !is_boxed {
                    math.extend([
                        Math::Op("⇒"),
                        letter,
                        Math::Op("="),
                        Math::Expr(step.value.clone()),
                    ]);
                }
                lines.push(Line {
                    math,
                    step: Some(claimed),
                });
                continue;
            } else if is_boxed {
                continue;
            }
            if !is_boxed {
                math.extend([letter, Math::Op("=")]);
                math.extend(self.made_of(told, step));
                // What it is made of may stand in the box that comes next.
                let boxed = |s: &&Step| {
                    let answer = self.answering(told, s);
                    answer.is_some_and(|a| is_made_of(&math, &a.name))
                };
                if told.steps.iter().any(|s| boxed(&s)) {
                    math.pop();
                } else {
                    math.push(Math::Expr(step.value.clone()));
                }
            }
            lines.push(Line {
                math,
                step: Some(claimed),
            });
        }
        if self.is_steady(told) {
            self.solution.say(steady(told));
        }
        self.meant(letters);
        self.solution.display(lines);
    }

    /// What letters stand for; what was told of an earlier motion is not told again.
    pub(super) fn meant(&mut self, letters: Vec<(Math, &'static str)>) {
        let (old, new): (Vec<_>, Vec<_>) =
            letters.into_iter().partition(|l| self.letters.contains(l));
        if self.solution.detail == Detail::Brief || new.is_empty() {
            return;
        }
        let mut text = vec![say("Let ")];
        for (i, (letter, why)) in new.iter().enumerate() {
            text.push(say(match (i, new.len() - i) {
                (0, _) => "",
                (_, 1) => " and ",
                _ => ", ",
            }));
            let be = if i == 0 { " be " } else { " " };
            text.extend([
                Inline::Math(vec![letter.clone()]),
                say(format!("{be}{why}")),
            ]);
        }
        text.push(say(match old.is_empty() {
            true => ".",
            false => "; the other letters are those above.",
        }));
        self.solution.text(text);
        self.letters.extend(new);
    }

    /// The speed with which a motion along a line begins, as a symbol of its own, where it is long, stands by no name yet, and
    /// what comes of it is told.
    fn start(&self, told: &StageTold) -> Option<(Expr, Expr)> {
        let StageKind::Slide(slide) = &told.placed.kind else {
            return None;
        };
        let along = dot(&told.before.velocity[slide.body], &slide.along);
        let value = tidied(self.scene, &along);
        let symbol = Expr::symbol(START);
        let stages = &self.told.stages;
        let mut others = stages.iter().filter(|s| !std::ptr::eq(*s, told));
        let is_other = others.any(|s| matches!(s.placed.kind, StageKind::Slide(_)));
        let is_start = |name: &str| name.replace('_', "") == "v0";
        let is_taken = self.scene.parameters.iter().any(|p| is_start(&p.name))
            || self.told.answers.iter().any(|a| is_start(&a.name));
        let serves = |s: &&Step| s.inertia.is_none() && self.serves(told, s);
        let mut steps = told.steps.iter().filter(serves);
        let is_used = steps.any(|s| replaced(&s.raw, &value, &symbol) != s.raw);
        let is_named = self.named(&value) != value;
        (value.size() > WORTH_A_NAME && is_used && !is_taken && !is_other && !is_named)
            .then_some((symbol, value))
    }

    /// Whether nothing speeds a motion along a line up or slows it down.
    pub(super) fn is_steady(&self, told: &StageTold) -> bool {
        let mut steps = told.steps.iter();
        steps.any(|s| s.letter == "a" && s.value.is_zero())
    }

    /// Whether a step is worth telling: a time or a way only where a question or another step needs it.
    pub(super) fn serves(&self, told: &StageTold, step: &Step) -> bool {
        let is_asked = self.asked(told, |ask| match ask {
            Ask::Position { .. } => true,
            Ask::Time => step.letter == "t",
            Ask::Distance => step.letter == "s",
            _ => false,
        });
        match step.letter {
            "t" => is_asked || told.steps.iter().any(|s| !s.by_time.is_empty()),
            "s" => is_asked,
            "a" | "v" | "omega" if self.is_steady(told) => self.answering(told, step).is_some(),
            "V" if self.is_steady(told) && told.steps.iter().all(|s| s.letter != "A") => {
                self.answering(told, step).is_some()
            }
            "v" | "V" => {
                let moves = |ask: &Ask| {
                    matches!(
                        ask,
                        Ask::Velocity { .. } | Ask::Spin { .. } | Ask::Energy { .. }
                    )
                };
                self.answering(told, step).is_some()
                    || self.goes_on(told)
                    || self.asked(told, moves)
            }
            // What is asked the other way round stands in the box alone.
            "omega" => {
                let spins = self.asked(told, |ask| matches!(ask, Ask::Spin { .. }));
                self.answering(told, step).is_some() || self.goes_on(told) && !spins
            }
            _ => true,
        }
    }

    /// The index of a step's letter: the body's name where the letter stands for something else.
    fn index<'t>(&self, told: &'t StageTold, step: &Step) -> &'t str {
        let mut parameters = self.scene.parameters.iter();
        let mut answers = self.told.answers.iter().filter(|a| a.name == step.letter);
        let is_taken = parameters.any(|p| *p.name == *step.letter)
            || answers.any(|a| a.formula() != Some(&step.value));
        let moved = told.placed.kind.moved();
        let body = moved.first().filter(|_| is_taken);
        body.map_or("", |b| told.placed.scene.bodies[*b].name.as_str())
    }

    /// The letter of a step as it stands in a formula.
    pub(super) fn letter_of(&self, told: &StageTold, step: &Step) -> Expr {
        let own = match self.index(told, step) {
            "" => String::from(step.letter),
            index => format!("{}_{index}", step.letter),
        };
        let own = match mark(step) {
            "" => own,
            mark => format!("{own}^{mark}"),
        };
        let answer = self.answering(told, step);
        Expr::symbol(answer.map_or(own.as_str(), |a| a.name.as_str()))
    }

    /// A formula in which a quantity of the same motion, of at least so many nodes, stands by its letter, above the line and
    /// below it.
    fn by_letter(&self, told: &StageTold, letter: &str, least: usize, e: &Expr) -> Expr {
        let mut steps = told.steps.iter();
        let Some(step) = steps.find(|s| s.letter == letter && s.value.size() >= least) else {
            return e.clone();
        };
        let symbol = self.letter_of(told, step);
        let above = replaced(e, &step.value, &symbol);
        replaced(&above, &step.value.powi(-1), &symbol.powi(-1))
    }

    /// What a step comes from beyond an equation of motion, with the sign that leads on to its value; nothing where it reads the same.
    pub(super) fn made_of(&self, told: &StageTold, step: &Step) -> Vec<Math> {
        if step.inertia.is_some() {
            // Its equation of motion stands above.
            return Vec::new();
        }
        if self.law(told, step).is_some() {
            // The equation that it solves stands above.
            return Vec::new();
        }
        let time = told.steps.iter().find(|s| s.letter == "t");
        let raw = match time.filter(|_| !step.by_time.is_empty()) {
            Some(time) => {
                let time = self.letter_of(told, time);
                let powers = step.by_time.iter().zip(0..);
                let named = |k: &Expr| match *k == step.value {
                    true => k.clone(),
                    false => self.named(k),
                };
                Expr::sum(powers.map(|(k, n)| self.by_names(&named(k), &step.value) * time.powi(n)))
            }
            None => match self.uniformly(told, step) {
                Some(raw) => raw,
                None => {
                    let raw = self.by_names(&step.raw, &step.value);
                    self.by_letter(told, "a", WORTH_A_NAME, &raw)
                }
            },
        };
        let raw = match self.start(told) {
            Some((symbol, value)) => replaced(&raw, &value, &symbol),
            None => raw,
        };
        let raw = neat(self.scene, &raw);
        let written = crate::formula::write_plain;
        match alike(&raw, &step.value) || written(&raw) == written(&step.value) {
            true => Vec::new(),
            false => vec![Math::Expr(raw), Math::Op("=")],
        }
    }

    /// The equation that a step solves: what the time makes equal, or how the pull of a string moves what hangs on it.
    fn law(&self, told: &StageTold, step: &Step) -> Option<Vec<Math>> {
        let Some(balance) = &step.balance else {
            return self.meets(told, step);
        };
        let letter = |sought: &str| {
            let mut steps = told.steps.iter();
            let step = steps.find(|s| s.letter == sought && !s.value.is_zero())?;
            Some(self.letter_of(told, step))
        };
        let inertia = spread(&neat(self.scene, &balance.inertia));
        let force = self.by_letter(told, "F", 0, &neat(self.scene, &balance.force));
        let pulls = balance.pulls.iter();
        let pulls = pulls.filter_map(|(pull, factor)| Some(factor * letter(pull)?));
        let mut terms: Vec<Expr> = [force].into_iter().chain(pulls).collect();
        terms.retain(|t| !t.is_zero());
        terms.sort_by_key(Expr::is_negative);
        let mut math = match (letter("a"), inertia.node()) {
            (None, _) => vec![Expr::zero().into()],
            (Some(a), Node::Sum(_)) => vec![Math::Factor(inertia), a.into()],
            (Some(a), _) => vec![(inertia * a).into()],
        };
        for (i, term) in terms.into_iter().enumerate() {
            math.push(Math::Op(match (i, term.is_negative()) {
                (0, _) => "=",
                (_, true) => "−",
                (_, false) => "+",
            }));
            math.push(match i > 0 && term.is_negative() {
                true => Math::Factor(-term),
                false => term.into(),
            });
        }
        Some(math)
    }

    /// What the time makes equal, v + a t = V + A t of a body and the one below it, v + a t = −r ω − r α t of one that comes to
    /// roll, with V + A t beside these where the surface moves too; nothing for other steps.
    fn meets(&self, told: &StageTold, step: &Step) -> Option<Vec<Math>> {
        let StageKind::Slide(slide) = &told.placed.kind else {
            return None;
        };
        let time = (step.letter == "t").then(|| self.letter_of(told, step))?;
        let letter = |letter: &str| {
            let mut steps = told.steps.iter().filter(|s| !s.value.is_zero());
            let rate = steps.find(|s| s.letter == letter);
            rate.map(|s| self.letter_of(told, s) * &time)
        };
        let along = |state: &State, b: usize| dot(&state.velocity[b], &slide.along);
        let tidy = |e: &Expr| self.by_names(&self.named(&tidied(self.scene, e)), &step.value);
        let body = slide.body;
        let start = match self.start(told) {
            Some((symbol, _)) => symbol,
            None => tidy(&along(&told.before, body)),
        };
        let own = start + letter("a")?;
        let below =
            |b: usize| tidy(&along(&told.before, b)) + letter("A").unwrap_or_else(Expr::zero);
        let other = match (&slide.until, &slide.on) {
            (SlideEnd::Together, Some(on)) => below(on.body),
            (SlideEnd::Rolls, on) => {
                let radius = told.placed.scene.bodies[body].shape.radius()?;
                let mut rim = along(&told.after, body) + radius * &told.after.spin[body];
                if let Some(on) = on {
                    rim = rim - along(&told.after, on.body);
                }
                let arm = match tidied(self.scene, &rim).is_zero() {
                    true => -radius,
                    false => radius.clone(),
                };
                let turns = tidy(&(&arm * &told.before.spin[body])) + arm * letter("alpha")?;
                match on {
                    Some(on) => below(on.body) + turns,
                    None => turns,
                }
            }
            _ => return None,
        };
        Some(words::related(&own, "=", &other))
    }

    /// What a step of a motion at a constant acceleration finds, by that acceleration and the velocity at the beginning.
    fn uniformly(&self, told: &StageTold, step: &Step) -> Option<Expr> {
        let StageKind::Slide(slide) = &told.placed.kind else {
            return None;
        };
        let along = |b: usize| dot(&told.before.velocity[b], &slide.along);
        let own = along(slide.body);
        // Of what slides on another body along that one.
        let own = slide
            .on
            .as_ref()
            .map_or(own.clone(), |on| own - along(on.body));
        let speed = self.named(&tidied(self.scene, &own));
        let speed = self.by_names(&speed, &step.value);
        match (self.is_steady(told), step.letter) {
            (true, "s") => {
                let time = self.named(told.time.as_ref()?);
                return Some(speed * self.by_names(&time, &step.value));
            }
            (true, "t") => return Some(told.way.as_ref()? / &speed),
            _ => {}
        }
        let find = |letter: &str| told.steps.iter().find(|s| s.letter == letter);
        if step.letter == "omega" {
            return self.by_rim(told, &step.value).map(|[shown, _]| shown);
        }
        let a = find("a").filter(|a| a.inertia.is_some() && !a.value.is_zero())?;
        let a = self.letter_of(told, a);
        let two_a = Expr::from(2) * &a;
        match (step.letter, &slide.until) {
            _ if slide.on.is_some() || slide.spring.is_some() => None,
            ("v", SlideEnd::Distance(s)) => Some((speed.powi(2) + two_a * self.named(s)).sqrt()),
            ("v", SlideEnd::Time(t)) => Some(speed + a * t),
            ("s", SlideEnd::Stops) => Some(-(speed.powi(2) / two_a)),
            ("t", SlideEnd::Stops) => Some(-(speed / a)),
            ("s", SlideEnd::Time(t)) => Some(speed * t + Expr::ratio(1, 2) * a * t.powi(2)),
            _ => None,
        }
    }

    /// The answer that is what a step of a motion finds.
    pub(super) fn answering(&self, told: &StageTold, step: &Step) -> Option<&Answer> {
        let fits = |ask: &Ask| match step.letter {
            "t" => matches!(ask, Ask::Time),
            "s" => matches!(ask, Ask::Distance | Ask::Position { .. }),
            "v" | "V" => matches!(ask, Ask::Velocity { point: None, .. }),
            "omega" => matches!(ask, Ask::Spin { .. }),
            "a" | "A" => matches!(ask, Ask::Acceleration { .. }),
            "T" | "S" => matches!(ask, Ask::Tension { .. }),
            _ => false,
        };
        let mut answers = self.answered(told);
        answers.find(|a| a.formula() == Some(&step.value) && self.ask(a).is_some_and(fits))
    }

    /// The answers at the end of a stage; one that is not reached has none.
    pub(super) fn answered(&self, told: &StageTold) -> impl Iterator<Item = &Answer> {
        self.told.answers.iter().filter(move |a| {
            let stage = a.told.and_then(|(i, _)| self.told.stages.get(i));
            stage.is_some_and(|stage| std::ptr::eq(stage, told))
        })
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
    pub(super) fn by_names(&self, e: &Expr, value: &Expr) -> Expr {
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
}

/// Whether a formula under way holds this symbol.
fn is_made_of(math: &[Math], name: &str) -> bool {
    let mut all = math.iter().skip(1);
    all.any(|m| matches!(m, Math::Expr(e) if e.mentions(name)))
}

/// The mark of a step's letter: `+` for the velocity or spin at the end.
fn mark(step: &Step) -> &'static str {
    match step.letter {
        "v" | "V" | "omega" => "+",
        _ => "",
    }
}

/// M/4 + m for (M + 4 m)/4: each force and each mass in its place.
fn spread(e: &Expr) -> Expr {
    let (number, rest) = e.split_number();
    let is_sum = |f: &&Expr| matches!(f.node(), Node::Sum(_));
    let (sums, others): (Vec<&Expr>, Vec<&Expr>) = rest.factors().iter().partition(is_sum);
    match sums.as_slice() {
        [sum] if !number.is_integer() => {
            let others = Expr::from(number) * Expr::product(others.into_iter().cloned());
            let Node::Sum(terms) = sum.node() else {
                return e.clone();
            };
            Expr::sum(terms.iter().map(|term| term * &others))
        }
        _ => e.clone(),
    }
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
                Node::Power(..) => vec![rest.clone()],
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
