//! A motion on a spring: how far it goes until the spring has taken up its energy, and how long that takes.

use super::Page;
use crate::expr::{Expr, Function, Symbol, dot};
use crate::scene::{Ask, Slide, Spring};
use crate::solution::neat::{neat, tidied};
use crate::solution::words::{self, fill, set};
use crate::solution::{Claim, Line, Math};
use crate::story::{StageTold, State};

/// Longest place on the way of an oscillation, in nodes, that stands in a sentence.
const LONG: usize = 40;

impl Page<'_> {
    /// How a spring stops a body: the work of all forces on the way takes up the kinetic energy.
    pub(super) fn pressed(&mut self, told: &StageTold, spring: &Spring) -> Option<Line> {
        let [start, end] = told.energy.as_ref()?;
        let way = told.way.as_ref()?;
        let asked = self.to(told, |ask| matches!(ask, Ask::Distance));
        let asked = asked.map(|a| a.name.clone());
        let symbol = Expr::symbol(asked.as_deref().unwrap_or("s"));
        if asked.is_none() {
            let latex = String::from("s");
            self.solution.names.insert(Symbol::from("s"), latex);
        }
        let others = told.work.iter().filter(|(what, _)| *what != "spring");
        let others = others.map(|(_, work)| tidied(self.scene, &(work / way)) * &symbol);
        let stored = &spring.stiffness * (Expr::ratio(1, 2) * symbol.powi(2));
        let given = &spring.stiffness * &spring.relaxed * &symbol;
        let work = Expr::sum(others) + given - stored;
        let total = Expr::sum(told.work.iter().map(|(_, w)| w.clone()));
        let claim = Claim::new(start + total, end.clone());
        let why = "the work of all forces takes up the kinetic energy";
        let step = Some(self.solution.step(Vec::new(), vec![claim], why));
        let taken = neat(self.scene, &-work);
        let mut math = set("{} = {}", [taken.into(), words::kinetic("", "-")]);
        if asked.is_none() {
            math.extend(set("⇒ {} = {}", [symbol.into(), way.into()]));
        }
        Some(Line { math, step })
    }

    /// The accelerations that are asked for at the ends of a motion on a spring, by the forces there.
    pub(super) fn at_ends_of_spring(&mut self, told: &StageTold, spring: &Spring) {
        let (Some(on), Some(way)) = (&told.on_spring, &told.way) else {
            return;
        };
        let rates = self.answered(told).filter_map(|a| match self.ask(a)? {
            Ask::Acceleration { at_end, .. } => Some((Expr::symbol(&a.name), *at_end)),
            _ => None,
        });
        let mut rates: Vec<(Expr, bool)> = rates.collect();
        // What rides on it has the same.
        rates.sort_by_key(|(_, at_end)| *at_end);
        rates.dedup_by_key(|(_, at_end)| *at_end);
        let asked = self.to(told, |ask| matches!(ask, Ask::Distance));
        let named = asked.map_or_else(|| way.clone(), |a| Expr::symbol(&a.name));
        let others = told.work.iter().filter(|(what, _)| *what != "spring");
        let others = Expr::sum(others.map(|(_, work)| tidied(self.scene, &(work / way))));
        let mut lines = Vec::new();
        for (rate, at_end) in &rates {
            let force = |way: &Expr| match at_end {
                true => &others + &spring.stiffness * (&spring.relaxed - way),
                false => &others + &spring.stiffness * &spring.relaxed,
            };
            let shown = neat(self.scene, &force(&named));
            let inertia = Math::Factor(neat(self.scene, &on.inertia));
            let math = set("{} {} = {}", [inertia, rate.into(), shown.into()]);
            let driven = &on.inertia * &on.rates[usize::from(*at_end)];
            let why = "mass times acceleration = forces along the line";
            lines.push(self.claimed(math, &force(way), &driven, why));
        }
        let Some((_, at_end)) = rates.first() else {
            return;
        };
        self.solution.say(match (rates.len(), at_end) {
            (1, true) => "The forces at the end of the way give the acceleration there:",
            (1, false) => "The forces at the beginning give the acceleration there:",
            _ => "The forces at the beginning and at the end of the way give the accelerations there:",
        });
        self.solution.display(lines);
    }

    /// The time of a motion on a spring, which is a part of a harmonic oscillation about the place where the forces balance: it goes
    /// as the sine of a phase that grows at the rate √(k/m).
    pub(super) fn swung(&mut self, told: &StageTold, slide: &Slide) {
        let (Some(spring), Some((t, time)), Some(way)) =
            (&slide.spring, self.time_asked(told), &told.way)
        else {
            return;
        };
        let tidy = |e: &Expr| tidied(self.scene, e);
        let speed = |state: &State| tidy(&dot(&state.velocity[slide.body], &slide.along));
        let [first, last] = [&told.before, &told.after].map(speed);
        let others = told.work.iter().filter(|(what, _)| *what != "spring");
        let others = others.map(|(_, work)| work / way);
        let balance = tidy(&(&spring.relaxed + Expr::sum(others) / &spring.stiffness));
        let is_quarter = balance.is_zero() && last.is_zero()
            || tidy(&(&balance - way)).is_zero() && first.is_zero();
        let Some([start, end]) = &told.energy else {
            return;
        };
        let mass = match (first.is_zero(), last.is_zero()) {
            (false, _) => tidy(&(Expr::from(2) * start / first.powi(2))),
            (_, false) => tidy(&(Expr::from(2) * end / last.powi(2))),
            // From rest to rest it is half of one.
            _ => {
                return self.solution.text(fill(
                    "The motion is half of a harmonic oscillation of period {}.",
                    [words::formula(&tidy(&(Expr::from(2) * time)))],
                ));
            }
        };
        if is_quarter {
            let period = Expr::from(2) * Expr::pi() * (&mass / &spring.stiffness).sqrt();
            let spins = |state: &State| slide.company().iter().any(|b| !state.spin[*b].is_zero());
            let text = match spins(&told.before) || spins(&told.after) {
                true => fill(
                    "The motion is a quarter of a harmonic oscillation, with the inertia of turning as that of a mass {}, of period {}.",
                    [&mass, &period].map(words::formula),
                ),
                false => fill(
                    "The motion is a quarter of a harmonic oscillation of period {}.",
                    [words::formula(&period)],
                ),
            };
            return self.solution.text(text);
        }
        let rate = tidy(&(&spring.stiffness / &mass).sqrt());
        let [from, to] = [-&balance, way - &balance].map(|e| tidy(&e));
        let size = match (first.is_zero(), last.is_zero()) {
            (true, _) => tidy(&-&from),
            (_, true) => to.clone(),
            _ => tidy(&(from.powi(2) + (&first / &rate).powi(2)).sqrt()),
        };
        let quarter = Expr::ratio(1, 2) * Expr::pi();
        let phase = |place: &Expr| match tidy(&(place / &size)) {
            end if end.is_one() => quarter.clone(),
            end if (-&end).is_one() => -&quarter,
            sine => Expr::call(Function::Asin, sine),
        };
        let phases = match from.is_zero() {
            true => phase(&to),
            false => phase(&to) - phase(&from),
        };
        if [&from, &to, &size].iter().any(|e| e.size() > LONG) {
            return self.solution.say(
                "The motion is a part of a harmonic oscillation about the place where the forces balance; its phase grows at a steady rate from place to place.",
            );
        }
        self.solution.text(fill(
            "Counted from where the forces balance, the motion goes from {} to {}, a part of a harmonic oscillation of amplitude {}: as the sine of a phase that grows at the rate {}.",
            [&from, &to, &size, &rate].map(words::formula),
        ));
        let math = set(
            "{} {} = {}",
            [rate.clone().into(), t.into(), (&phases).into()],
        );
        let why = "the phase grows at a steady rate";
        let line = self.claimed(math, &(rate * time), &phases, why);
        self.solution.display(vec![line]);
    }
}
