//! The time of a motion that is asked for, from its way and how fast it goes.

use super::Page;
use crate::answer::Answer;
use crate::expr::{Expr, dot};
use crate::scene::{Ask, Slide, SlideEnd, Turn, Until};
use crate::solution::neat::{alike, tidied};
use crate::solution::words::{self, set};
use crate::story::StageTold;

impl Page<'_> {
    /// The time of a motion by its name, and its value, if it is asked for.
    pub(super) fn time_asked(&self, told: &StageTold) -> Option<(Expr, Expr)> {
        let asked = self.to(told, |ask| matches!(ask, Ask::Time))?;
        Some((Expr::symbol(&asked.name), told.time.clone()?))
    }

    /// The time of a rotation at a steady rate: the angle divided by the spin, by the name of the answer that has it.
    pub(super) fn at_steady_rate(&mut self, told: &StageTold, turn: &Turn) {
        let (Some((t, time)), Some(turned)) = (self.time_asked(told), &told.turned) else {
            return;
        };
        if matches!(turn.until, Until::For(_)) {
            return;
        }
        let spin = &told.before.spin[turn.body];
        let (turned, spin) = match spin.is_negative() {
            true => (-turned, -spin),
            false => (turned.clone(), spin.clone()),
        };
        let mut spins = self
            .told
            .answers
            .iter()
            .filter(|a| a.formula() == Some(&spin));
        let known = spins.find(|a| matches!(self.ask(a), Some(Ask::Spin { .. })));
        let rate = known.map_or(spin.clone(), |a| Expr::symbol(&a.name));
        let quotient = &turned / rate;
        if alike(&quotient, &time) {
            return;
        }
        let math = set("{} = {}", [t.into(), quotient.into()]);
        let why = "the angle turned through, divided by the rate";
        let line = self.claimed(math, &time, &(turned / spin), why);
        self.solution.display(vec![line]);
    }

    /// The time of a motion along a line under constant forces: the way is the mean of the speeds at both ends, times it.
    pub(super) fn at_mean_speed(&mut self, told: &StageTold, slide: &Slide) {
        let (Some((t, time)), Some(way)) = (self.time_asked(told), &told.way) else {
            return;
        };
        if matches!(slide.until, SlideEnd::Time(_)) {
            return;
        }
        let speeds = [&told.before, &told.after];
        let speeds =
            speeds.map(|s| tidied(self.scene, &dot(&s.velocity[slide.body], &slide.along)));
        // A speed of the body that is found goes by its name.
        let is_own = |a: &&Answer| match self.ask(a) {
            Some(Ask::Velocity { body, .. }) => *body == slide.body,
            _ => false,
        };
        let named = speeds.each_ref().map(|speed| {
            let mut found = self.told.answers.iter().filter(is_own);
            let is_it = |a: &&Answer| a.told.is_some() && a.formula() == Some(speed);
            let found = found.find(|a| !speed.is_constant() && is_it(a));
            found.map_or(speed.clone(), |a| Expr::symbol(&a.name))
        });
        let half = Expr::ratio(1, 2);
        let rests = named.iter().any(Expr::is_zero);
        let during = &half * Expr::sum(named);
        // Half of one speed is seen to be that.
        let during = match rests {
            true => during,
            false => tidied(self.scene, &during),
        };
        let during = during * &t;
        let mean = tidied(self.scene, &(half * Expr::sum(speeds)));
        let math = words::related(way, "=", &during);
        let line = self.claimed(
            math,
            way,
            &(mean * time),
            "the mean of the speeds times the time",
        );
        self.solution.say(
            "The acceleration is constant, so the distance is the mean of the speeds at the beginning and the end, times the time:",
        );
        self.solution.display(vec![line]);
    }
}
