//! A motion in a worked solution by its energy: inertia, work, and the speeds at both ends. Every line is a claim; Newton's laws
//! are told in [`super::newton`], a flight in [`super::flight`].

use super::Page;
use crate::answer::Answer;
use crate::expr::{Expr, Node, Symbol, dot, minus};
use crate::scene::{Ask, Linkage, Slide, SlideEnd, Stage, StageKind, Turn, Until};
use crate::solution::neat::{alike, neat, tidied};
use crate::solution::words::{self, fill, name, say, set, vector};
use crate::solution::{Claim, Inline, Line, Math};
use crate::story::{StageTold, State};

/// Largest equation of motion, in nodes, that is written out.
const READABLE: usize = 90;

/// A letter of a formula, and what it stands for.
type Letter = (Math, &'static str);

impl Page<'_> {
    /// A motion: inertia, work and energy, from the beginning to the end.
    pub(super) fn motion(&mut self, stage: &Stage, told: &StageTold) {
        if !told.steps.is_empty() {
            self.steps(told);
            let is_timed = told.steps.iter().any(|s| s.letter == "t");
            return match &stage.kind {
                StageKind::Slide(slide)
                    if slide.spring.is_none() && !is_timed && !self.is_steady(told) =>
                {
                    self.at_mean_speed(told, slide)
                }
                _ => {}
            };
        }
        let Some([start, end]) = &told.energy else {
            return;
        };
        // A steady rotation needs no energy, unless that is asked for.
        let named = self
            .told
            .answers
            .iter()
            .any(|a| Self::is_end_energy(told, a));
        if let StageKind::Turn(turn) = &stage.kind
            && told.work.is_empty()
            && !named
        {
            self.at_steady_rate(told, turn);
            return self.accelerated(told);
        }
        if self.steady(told).is_some() {
            return;
        }
        let mut lines: Vec<Line> = self.inertia(stage, told).into_iter().collect();
        if let Some((inertia, impulse)) = driven(told) {
            lines.extend(self.driven(told, [&inertia, &impulse]));
            if !named {
                let speed = self.speed(stage, told);
                self.meant(speed.iter().flat_map(|(_, new)| new.clone()).collect());
                lines.extend(speed.map(|(line, _)| line));
                self.solution.display(lines);
                return self.whirled(stage, told);
            }
        }
        if self.is_of_moments(told) {
            self.solution.display(lines);
            return self.whirled(stage, told);
        }
        if let StageKind::Linkage(linkage) = &stage.kind {
            self.velocities(told, linkage);
        }
        let stopping = match &stage.kind {
            StageKind::Turn(turn) if matches!(turn.until, Until::Stops) => Some(turn),
            _ => None,
        };
        let pressing = match &stage.kind {
            StageKind::Slide(slide) if matches!(slide.until, SlideEnd::Stops) => {
                slide.spring.as_ref()
            }
            _ => None,
        };
        let to_rest = stopping.is_some() || pressing.is_some();
        self.height(stage, told);
        let speed = (!to_rest).then(|| self.speed(stage, told)).flatten();
        self.energies(
            told,
            to_rest,
            speed.iter().flat_map(|(_, new)| new.clone()).collect(),
        );
        let raw = self.energy_at(told, &told.before);
        let why = "kinetic energy at the beginning";
        lines.push(self.chain(vec![words::kinetic("", "-")], &raw, start, why));
        if let Some(spring) = pressing {
            lines.extend(self.pressed(told, spring));
            self.solution.display(lines);
            return self.whirled(stage, told);
        }
        if let Some(turn) = stopping {
            if let Some(g) = &turn.gravity {
                self.solution.display(lines);
                return self.rise(stage, told, turn, g);
            }
            if let Some(line) = self.braked(told, turn) {
                lines.push(line);
                self.solution.display(lines);
                return self.stopped(told, turn);
            }
        }
        self.worked([start, end], told, named, &mut lines);
        lines.extend(speed.map(|(line, _)| line));
        if let (Some([inertia, _]), StageKind::Linkage(linkage)) = (&told.inertia, &stage.kind) {
            let square = self.rate(linkage, "dot").powi(2);
            let energy = Expr::ratio(1, 2) * inertia * square;
            let energies = [energy.into(), words::kinetic("", "+")];
            lines.push(Line::plain(set("{} = {}", energies)));
        }
        self.solution.display(lines);
        self.whirled(stage, told);
    }

    /// A name, what it is made of, and its value, as a claim.
    fn chain(&mut self, head: Vec<Math>, raw: &Expr, value: &Expr, why: &str) -> Line {
        let mut math = head;
        math.push(Math::Op("="));
        let shown = self.by_names(&neat(self.scene, raw), value);
        if !alike(&shown, value) {
            math.extend([Math::Expr(shown), Math::Op("=")]);
        }
        math.push(Math::Expr(value.clone()));
        self.claimed(math, raw, value, why)
    }

    pub(super) fn claimed(
        &mut self,
        math: Vec<Math>,
        left: &Expr,
        right: &Expr,
        why: &str,
    ) -> Line {
        let claim = Claim::new(left.clone(), right.clone());
        let step = Some(self.solution.step(Vec::new(), vec![claim], why));
        Line { math, step }
    }

    /// The moment of inertia about the fixed point of a turn, where it was not told before.
    fn inertia(&mut self, stage: &Stage, told: &StageTold) -> Option<Line> {
        let (Some([raw, tidy]), StageKind::Turn(turn)) = (&told.inertia, &stage.kind) else {
            return None;
        };
        let raw = &match turn.with.is_empty() {
            true => raw.clone(),
            false => self.about(stage, told, turn),
        };
        let head = vec![self.inertia_letter(&turn.about_name)];
        let why = "moment of inertia about the fixed point: I + m r²";
        let line = self.chain(head, raw, tidy, why);
        self.is_new(&line.math).then_some(line)
    }

    /// The letter of the moment of inertia of all that turns about a point, where an answer of that name is not of less.
    pub(super) fn inertia_letter(&self, about: &str) -> Math {
        let own = format!("I_{about}");
        let mut answers = self.told.answers.iter().filter(|a| a.name == own);
        let is_other = |value: &Expr| {
            let mut turns = self.told.stages.iter().filter(|told| {
                matches!(&told.placed.kind, StageKind::Turn(turn) if turn.about_name == about)
            });
            turns.any(|told| told.inertia.as_ref().is_some_and(|[_, all]| all != value))
        };
        let is_taken = answers.any(|a| a.formula().is_some_and(is_other));
        name("I", if is_taken { "total" } else { about }, "", false)
    }

    /// The letter of the work of a force; of the only one without its name, unless that letter is taken.
    fn work(&self, told: &StageTold, what: &str) -> Math {
        let is_taken = self.scene.parameter("W").is_some() || self.scene.question("W").is_some();
        let alone = told.work.len() == 1 && !is_taken;
        name("W", if alone { "" } else { what }, "", false)
    }

    /// The work on the way and the kinetic energy at the end, whose value is left to an answer that is named after it.
    fn worked(
        &mut self,
        [start, end]: [&Expr; 2],
        told: &StageTold,
        named: bool,
        lines: &mut Vec<Line>,
    ) {
        let alone = told.work.len() == 1;
        let gain = end - start;
        for (what, raw) in &told.work {
            let tidy = tidied(self.scene, if alone { &gain } else { raw });
            let value = if alone || tidy.size() < raw.size() {
                &tidy
            } else {
                raw
            };
            let why = format!("work of {what}: force times the way in its direction");
            // A product that cancels is said at once.
            let is_plain = matches!(raw.node(), Node::Product(factors) if !factors.iter().any(|f| matches!(f.node(), Node::Sum(_))));
            let raw = if is_plain { value } else { raw };
            let head = vec![self.work(told, what)];
            lines.push(self.chain(head, raw, value, &why));
        }
        let after = start + &Expr::sum(told.work.iter().map(|(_, w)| w.clone()));
        let mut math = set("{} = {}", ["+", "-"].map(|mark| words::kinetic("", mark)));
        for (what, _) in &told.work {
            math.extend(set("+ {}", [self.work(told, what)]));
        }
        if !named {
            math.extend(set("= {}", [end.into()]));
        }
        let why = "work changes kinetic energy";
        lines.push(self.claimed(math, &after, end, why));
    }

    /// What the letters of a balance of energy stand for; where it comes to rest, only the first is needed.
    fn energies(&mut self, told: &StageTold, to_rest: bool, speed: Vec<Letter>) {
        let mut letters = vec![(
            words::kinetic("", "-"),
            "the kinetic energy at the beginning",
        )];
        if !to_rest {
            for (what, _) in &told.work {
                let alone = told.work.len() == 1;
                let why = match *what {
                    _ if alone => "the work done on the way",
                    "weight" => "the work of the weight",
                    "friction" => "the work of friction",
                    "spring" => "the work of the spring",
                    "moment" => "the work of the moment",
                    _ => "the work of the force",
                };
                letters.push((self.work(told, what), why));
            }
            letters.push((words::kinetic("", "+"), "the kinetic energy at the end"));
        }
        // What is asked for stands in these equations before its box.
        let mut sought: Vec<Letter> = Vec::new();
        for answer in self.answered(told) {
            let why = match self.ask(answer) {
                Some(Ask::Velocity { point: None, .. }) if !to_rest => {
                    match self.is_whole(told, answer) {
                        true => "the velocity at the end",
                        false => continue,
                    }
                }
                Some(Ask::Spin { .. }) if !to_rest => "the angular velocity at the end",
                Some(Ask::Distance) if to_rest => match answer.words.starts_with("displacement") {
                    true => "the displacement",
                    false => "the distance covered",
                },
                _ => continue,
            };
            sought.push((Expr::symbol(&answer.name).into(), why));
        }
        if let [one] = sought.as_slice() {
            letters.push(one.clone());
        }
        letters.extend(speed);
        self.meant(letters);
    }

    /// Whether the velocity that an answer gives is the whole of it, up to its sign, and no component across the motion.
    fn is_whole(&self, told: &StageTold, answer: &Answer) -> bool {
        let (Some(Ask::Velocity { body, .. }), Some(component)) =
            (self.ask(answer), answer.formula())
        else {
            return false;
        };
        let velocity = &told.after.velocity[*body];
        tidied(self.scene, &(dot(velocity, velocity) - component.powi(2))).is_zero()
    }

    /// Whether no more is asked of a motion than components of a velocity that its speed does not give at once.
    fn asks_components(&self, told: &StageTold) -> bool {
        self.answered(told).all(|answer| {
            let is_velocity = matches!(self.ask(answer), Some(Ask::Velocity { point: None, .. }));
            is_velocity && !self.is_whole(told, answer)
        })
    }

    /// The answer of a stage to a question of this kind.
    pub(super) fn to(&self, told: &StageTold, is: impl Fn(&Ask) -> bool) -> Option<&Answer> {
        self.answered(told)
            .find(|answer| self.ask(answer).is_some_and(&is))
    }

    /// What an answer is the answer to.
    pub(super) fn ask(&self, answer: &Answer) -> Option<&Ask> {
        self.scene.question(&answer.question).map(|q| &q.ask)
    }

    /// How a moment alone stops a rotation: its work takes up the kinetic energy.
    fn braked(&self, told: &StageTold, turn: &Turn) -> Option<Line> {
        let braking = -turn.torque.as_ref()?;
        let through = self.to(told, |ask| matches!(ask, Ask::Angle { .. }))?;
        let turned = told.turned.as_ref()?;
        let opposite = tidied(self.scene, &-turned);
        let is_size = [turned, &opposite].contains(&through.formula()?);
        let work = braking * Expr::symbol(&through.name);
        let math = set("{} = {}", [work.into(), words::kinetic("", "-")]);
        is_size.then_some(Line::plain(math))
    }

    /// How a moment changes a rotation in a given time, by its angular impulse.
    fn driven(&mut self, told: &StageTold, [inertia, impulse]: [&Expr; 2]) -> Vec<Line> {
        let StageKind::Turn(turn) = &told.placed.kind else {
            return Vec::new();
        };
        let about = say(&turn.about_name);
        let lead = "The moment changes the angular momentum about {} by its size times the time.";
        self.solution.text(fill(lead, [about]));
        let [before, after] = ["-", "+"].map(|mark| name("H", &turn.about_name, mark, false));
        let [raw, end] = [&told.before, &told.after].map(|s| inertia * &s.spin[turn.body]);
        let [start, end] = [&raw, &end].map(|e| tidied(self.scene, e));
        let why = "angular momentum about the fixed point at the beginning";
        let first = self.chain(vec![before.clone()], &raw, &start, why);
        let (form, size) = match impulse.is_negative() {
            true => ("{} = {} − {} = {}", -impulse),
            false => ("{} = {} + {} = {}", impulse.clone()),
        };
        let math = set(form, [after, before, size.into(), (&end).into()]);
        let why = "the angular impulse of the moment changes the angular momentum";
        vec![first, self.claimed(math, &(&raw + impulse), &end, why)]
    }

    /// When a moment alone has stopped a rotation: its angular impulse takes up the angular momentum.
    fn stopped(&mut self, told: &StageTold, turn: &Turn) {
        let time = self.to(told, |ask| matches!(ask, Ask::Time));
        let (Some(time), Some([_, inertia]), Some(torque)) = (time, &told.inertia, &turn.torque)
        else {
            return;
        };
        let spin = &told.before.spin[turn.body];
        let spin = if spin.is_negative() {
            -spin
        } else {
            spin.clone()
        };
        let momentum = tidied(self.scene, &(inertia * spin));
        let impulse = -torque * Expr::symbol(&time.name);
        let math = words::related(&impulse, "=", &momentum);
        self.solution
            .say("In the time it takes, the moment takes up the angular momentum as well:");
        self.solution.display(vec![Line::plain(math)]);
    }

    /// Whether another stage takes over where this one ends.
    pub(super) fn goes_on(&self, told: &StageTold) -> bool {
        let index = self.told.stages.iter().position(|s| std::ptr::eq(s, told));
        let mut next = self.told.stages.iter();
        next.any(|s| s.branch.map(|(parent, _)| parent) == index)
    }

    /// Whether a rotation is asked for its angular acceleration alone, which its moments give without its energy.
    pub(super) fn is_of_moments(&self, told: &StageTold) -> bool {
        let whirls = |ask: &Ask| matches!(ask, Ask::AngularAcceleration { .. });
        matches!(told.placed.kind, StageKind::Turn(_))
            && !self.goes_on(told)
            && self.asked(told, whirls)
            && !self.asked(told, |ask| !whirls(ask))
    }

    /// Where an angular acceleration, or the time of a linkage, comes from, if it is asked of this stage.
    fn whirled(&mut self, stage: &Stage, told: &StageTold) {
        let asks = |is: fn(&Ask) -> bool| self.asked(told, is);
        let whirls = asks(|ask| matches!(ask, Ask::AngularAcceleration { .. }));
        let takes = asks(|ask| matches!(ask, Ask::Time));
        match &stage.kind {
            StageKind::Turn(turn) if whirls => self.moments(told, turn),
            StageKind::Linkage(linkage) => self.of_motion(told, linkage),
            _ => {}
        }
        self.accelerated(told);
        if let StageKind::Slide(slide) = &stage.kind
            && slide.spring.is_none()
            && slide.on.is_none()
        {
            return self.at_mean_speed(told, slide);
        }
        if !takes {
            return;
        }
        match &stage.kind {
            StageKind::Linkage(_) => self.solution.say(
                "The acceleration is constant, so the time is the change of velocity divided by it.",
            ),
            StageKind::Slide(slide) => self.swung(told, slide),
            _ => {}
        }
    }

    /// The speed with which a motion ends, from its energy, where the next stage takes it over and no question asks for it.
    fn speed(&mut self, stage: &Stage, told: &StageTold) -> Option<(Line, Option<Letter>)> {
        let [_, end] = told.energy.as_ref()?;
        let asks = |is: fn(&Ask) -> bool| self.asked(told, is);
        let goes_on = self.goes_on(told);
        let (letter, inertia) = match &stage.kind {
            StageKind::Slide(slide) => {
                let spins = !told.after.spin[slide.body].is_zero();
                let needed = goes_on || asks(|_| true);
                if !self.asks_components(told) || spins || !needed || end.is_zero() {
                    return None;
                }
                // What strings tie to it moves, and turns, in a fixed ratio to it.
                let speed = dot(&told.after.velocity[slide.body], &slide.along);
                let apparent = Expr::from(2) * end / speed.powi(2);
                ("v", tidied(self.scene, &apparent))
            }
            StageKind::Fall(fall) => {
                let spins = !told.after.spin[fall.body].is_zero();
                if !self.asks_components(told) || spins || fall.bodies().len() > 1 {
                    return None;
                }
                let mass = &stage.scene.bodies[fall.body].mass;
                ("v", tidied(self.scene, mass))
            }
            StageKind::Turn(turn) => {
                let is_given = *end == told.energy.as_ref()?[0];
                let needed = goes_on || asks(|ask| matches!(ask, Ask::Velocity { .. }));
                let asked =
                    asks(|ask| matches!(ask, Ask::Spin { .. })) || self.speed_asked(told).is_some();
                if asked || is_given || !needed {
                    return None;
                }
                let body = &stage.scene.bodies[turn.body];
                match (body.is_particle() && turn.with.is_empty(), &told.inertia) {
                    (true, _) => ("v", body.mass.clone()),
                    (false, Some([_, inertia])) => ("omega", inertia.clone()),
                    (false, None) => return None,
                }
            }
            _ => return None,
        };
        let turned = driven(told).map(|_| &told.after.spin[told.placed.kind.moved()[0]]);
        let square = Expr::from(2) * end / &inertia;
        let speed = turned.map_or_else(
            || tidied(self.scene, &tidied(self.scene, &square).sqrt()),
            Expr::clone,
        );
        // A speed that is asked for stands in the box.
        let asked = self.answered(told).find(|a| a.formula() == Some(&speed));
        if let Some(answer) = asked.filter(|_| letter == "v") {
            let energy = Expr::ratio(1, 2) * &inertia * Expr::symbol(&answer.name).powi(2);
            let math = set("{} = {}", [energy.into(), words::kinetic("", "+")]);
            return Some((Line::plain(math), None));
        }
        // No name of a scene ends so.
        let symbol = Symbol::from(format!("{letter}⁺").as_str());
        let latex = format!("{}^{{+}}", crate::formula::latex_name(letter));
        self.solution.names.insert(symbol.clone(), latex);
        let symbol = Expr::symbol(&symbol);
        let (made, of) = match &stage.kind {
            StageKind::Turn(turn) if turned.is_some() => {
                let momentum = name("H", &turn.about_name, "+", false);
                (&inertia * &symbol, momentum)
            }
            _ => {
                let energy = Expr::ratio(1, 2) * &inertia * symbol.powi(2);
                (energy, words::kinetic("", "+"))
            }
        };
        let why = match letter {
            "v" => "the speed at the end",
            _ => "the angular velocity at the end",
        };
        let new = (Math::Expr(symbol.clone()), why);
        let parts = [made.into(), of, symbol.into(), speed.into()];
        let math = set("{} = {} ⇒ {} = {}", parts);
        Some((Line::plain(math), Some(new)))
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

    /// The rate of the coordinate of a linkage, as a symbol, or the rate of that.
    fn rate(&mut self, linkage: &Linkage, dots: &str) -> Expr {
        let of = &linkage.coordinate;
        let symbol = Symbol::from(format!("{of}_{dots}").as_str());
        let latex = match self.solution.names.get(of) {
            Some(latex) => latex.clone(),
            None => crate::formula::latex_name(of),
        };
        let latex = format!("\\{dots}{{{latex}}}");
        self.solution.names.insert(symbol.clone(), latex);
        Expr::symbol(&symbol)
    }

    /// The equation of motion of a linkage, where an acceleration or the time is asked of this stage.
    fn of_motion(&mut self, told: &StageTold, linkage: &Linkage) {
        let needs = |ask: &Ask| {
            matches!(
                ask,
                Ask::AngularAcceleration { .. } | Ask::PointAcceleration { .. } | Ask::Time
            )
        };
        if !self.asked(told, needs) {
            return;
        }
        let [inertia, lifted] = crate::story::by_coordinate(&told.placed, linkage);
        let inertia = tidied(self.scene, &inertia);
        let drawn = tidied(self.scene, &-lifted);
        let grows = tidied(self.scene, &inertia.derivative(&linkage.coordinate));
        let [rate, second] = ["dot", "ddot"].map(|dots| self.rate(linkage, dots));
        let left = &inertia * &second + Expr::ratio(1, 2) * &grows * rate.powi(2);
        if left.size() + drawn.size() > READABLE {
            return self.solution.say(
                "The balance of energy from the beginning to any place, differentiated with respect to time, gives the accelerations.",
            );
        }
        self.solution.say(
            "The balance of energy from the beginning to any place, differentiated with respect to time, gives there",
        );
        let mut math = words::related(&left, "=", &drawn);
        if grows.is_zero() {
            let value = tidied(self.scene, &(&drawn / &inertia));
            math.extend(set("⇒ {} = {}", [second.into(), value.into()]));
        }
        self.solution.display(vec![Line::plain(math)]);
    }

    /// How all bodies of a linkage move by the rate of its coordinate.
    fn velocities(&mut self, told: &StageTold, linkage: &Linkage) {
        let rate = self.rate(linkage, "dot");
        let scene = &told.placed.scene;
        let half = Expr::ratio(1, 2);
        let (mut lines, mut energies) = (Vec::new(), Vec::new());
        for (b, place) in &linkage.places {
            let called = words::center(self.scene, *b);
            let per = place
                .each_ref()
                .map(|e| tidied(self.scene, &e.derivative(&linkage.coordinate)));
            let squares = per.each_ref().map(|change| change.powi(2));
            let [x, y, angle] = per.map(|change| change * &rate);
            if !(x.is_zero() && y.is_zero()) {
                let square = tidied(self.scene, &(&squares[0] + &squares[1]));
                energies.push(&half * &scene.bodies[*b].mass * square);
                let math = set("{} = {}", [vector("v", &called, ""), [x, y].into()]);
                lines.push(Line::plain(math));
            }
            if !scene.bodies[*b].is_particle() && !angle.is_zero() {
                let inertia = tidied(self.scene, &scene.bodies[*b].inertia);
                energies.push(&half * inertia * &squares[2]);
                let index = if called == "G" { "" } else { &called };
                let omega = name("omega", index, "", false);
                lines.push(Line::plain(set("{} = {}", [omega, angle.into()])));
            }
        }
        let square = rate.powi(2);
        let whole = tidied(self.scene, &Expr::sum(energies.iter().cloned())) * &square;
        let by_parts = energies.len() > 1 && whole.size() <= READABLE;
        if by_parts {
            let mut math = vec![words::kinetic("", "")];
            for (i, part) in energies.into_iter().enumerate() {
                math.extend([
                    Math::Op(if i == 0 { "=" } else { "+" }),
                    (part * &square).into(),
                ]);
            }
            math.extend([Math::Op("="), whole.into()]);
            lines.push(Line::plain(math));
        }
        let coordinate = Expr::symbol(&linkage.coordinate);
        let both = [&coordinate, &rate].map(words::formula);
        let mut text = fill(
            "The position of every body follows from {}, and its velocity from the rate {}; translation and rotation together make up the kinetic energy",
            both,
        );
        if by_parts {
            let inline = Inline::Math(vec![words::kinetic("", "")]);
            text.extend([say(" "), inline]);
        }
        if linkage.ends[0] == coordinate {
            text.extend(fill(
                " (here {} is the value on the way, elsewhere the one at the beginning)",
                [words::formula(&coordinate)],
            ));
        }
        text.push(say(":"));
        self.solution.text(text);
        self.solution.display(lines);
    }

    /// Kinetic energy of what moves in a stage, from the velocities of this state, term by term; a spin or speed that has a name
    /// by now stands by its name.
    pub(super) fn energy_at(&self, told: &StageTold, state: &State) -> Expr {
        let stage = &told.placed;
        let half = Expr::ratio(1, 2);
        let square = |e: &Expr| {
            let opposite = self.named(&-e);
            let plain = opposite.as_symbol().map(|_| opposite.clone());
            plain
                .unwrap_or_else(|| self.by_names(&self.named(e), e))
                .powi(2)
        };
        // Bodies that move as one, without turning themselves, have one speed, which may stand by its name.
        let by_speed = |bodies: &[usize]| {
            let first = bodies.first()?;
            let velocity = &state.velocity[*first];
            let alike = bodies.iter().all(|b| {
                let turns = !stage.scene.bodies[*b].is_particle() && !state.spin[*b].is_zero();
                !turns && state.velocity[*b] == *velocity && pulley(stage, *b).is_none()
            });
            let mass = Expr::sum(bodies.iter().map(|b| stage.scene.bodies[*b].mass.clone()));
            let [x, y] = velocity.each_ref().map(square);
            // Of m, M and 3 M the sum is 4 M + m.
            alike.then(|| &half * tidied(self.scene, &mass) * (x + y))
        };
        if let (Some([_, inertia]), StageKind::Turn(turn)) = (&told.inertia, &stage.kind) {
            let by_spin = &half * inertia * square(&state.spin[turn.body]);
            let shorter = by_speed(&turn.bodies()).filter(|e| e.size() < by_spin.size());
            return shorter.unwrap_or(by_spin);
        }
        let moved = stage.kind.moved();
        if let Some(together) = by_speed(&moved).filter(|_| moved.len() > 1) {
            return together;
        }
        Expr::sum(moved.into_iter().map(|body| {
            let b = &stage.scene.bodies[body];
            if let Some((slide, apparent)) = pulley(stage, body) {
                let speed = dot(&state.velocity[slide.body], &slide.along);
                let speed = tidied(self.scene, &speed);
                return match speed.is_zero() || apparent.is_zero() {
                    true => Expr::zero(),
                    false => &half * tidied(self.scene, &apparent) * square(&speed),
                };
            }
            let [x, y] = &state.velocity[body];
            let spin = &state.spin[body];
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
}

/// The motion along a line in which a body is a pulley, and what it adds to the mass: its moment of inertia by the square
/// of its radius.
pub(super) fn pulley(stage: &Stage, body: usize) -> Option<(&Slide, Expr)> {
    let StageKind::Slide(slide) = &stage.kind else {
        return None;
    };
    let b = &stage.scene.bodies[body];
    let radius = b.shape.radius()?;
    slide.pulleys().find(|p| *p == body)?;
    Some((slide, &b.inertia / &radius.powi(2)))
}

/// The moment of inertia about the fixed point of a rotation that a moment drives for a given time, and the angular impulse of
/// the moment, counterclockwise.
pub(super) fn driven(told: &StageTold) -> Option<(Expr, Expr)> {
    let StageKind::Turn(turn) = &told.placed.kind else {
        return None;
    };
    let (Until::For(time), Some(torque), Some([_, inertia])) =
        (&turn.until, &turn.torque, &told.inertia)
    else {
        return None;
    };
    let [before, after] = [&told.before, &told.after].map(|s| &s.spin[turn.body]);
    let scene = &told.placed.scene;
    let gained = tidied(scene, &(inertia * &(after - before)));
    let impulse = torque * time;
    let is_clockwise = gained == tidied(scene, &-&impulse);
    Some((
        inertia.clone(),
        if is_clockwise { -impulse } else { impulse },
    ))
}
