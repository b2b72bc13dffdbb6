//! The laws of a story's motions in the names of its answers, for solutions that use one without writing it.
//!
//! In: a scene as it was told. Out: expressions that are zero: changes of velocity and spin by constant accelerations,
//! kinetic energy by work, rolling. What no question asks for stands as its value.

use super::{StageTold, Told};
use crate::answer::Answer;
use crate::expr::{Expr, Symbol, Vector, dot};
use crate::scene::{Ask, EnergyWhen, Question, Scene, SlideEnd, StageKind};

/// The moments between which a motion leads.
#[derive(Clone, Copy)]
enum Moment {
    Start,
    End,
}

/// A motion and what it is asked for.
struct Motion<'a> {
    scene: &'a Scene,
    told: &'a StageTold,
    /// All answers.
    answers: &'a [Answer],
    /// The motion or impact it goes on from.
    before: Option<&'a StageTold>,
}

/// The laws of all motions of a story.
pub fn lent(scene: &Scene, told: &Told) -> Vec<Expr> {
    let motions = told
        .stages
        .iter()
        .enumerate()
        .filter(|(_, t)| t.cases.is_empty());
    let laws = motions.flat_map(|(at, stage)| {
        let parent = stage.branch.map(|(parent, _)| parent).or(at.checked_sub(1));
        let motion = Motion {
            scene,
            told: stage,
            answers: &told.answers,
            before: parent.and_then(|parent| told.stages.get(parent)),
        };
        motion.laws()
    });
    laws.collect()
}

/// Accelerations along the lines of a story's motions, of bodies behind movable pulleys too, each once; none that is zero.
pub fn accelerations(told: &Told) -> Vec<Expr> {
    let mut all = Vec::new();
    for (stage, rate) in told
        .stages
        .iter()
        .filter_map(|t| Some((t, t.acceleration.as_ref()?)))
    {
        let strings = match &stage.placed.kind {
            StageKind::Slide(slide) => slide.strings.as_slice(),
            _ => &[],
        };
        let behind = strings.iter().map(|string| &string.ratio() * rate);
        for value in std::iter::once(rate.clone()).chain(behind) {
            if !value.is_zero() && !all.contains(&value) {
                all.push(value);
            }
        }
    }
    all
}

impl Motion<'_> {
    fn laws(&self) -> Vec<Expr> {
        let mut laws = match &self.told.placed.kind {
            // Two bodies have each a way of its own.
            StageKind::Slide(slide) if slide.on.is_some() => Vec::new(),
            StageKind::Slide(slide) if slide.spring.is_some() => {
                vec![self.change(&slide.company()) - self.work()]
            }
            StageKind::Slide(slide) => {
                let rolls = matches!(slide.until, SlideEnd::Rolls) || slide.rolling;
                self.along_a_line(slide.body, &slide.along, rolls)
            }
            StageKind::Fall(fall) => vec![self.change(&[fall.body]) - self.work()],
            StageKind::Turn(turn) => vec![self.change(&turn.bodies()) - self.work()],
            StageKind::Linkage(_) => vec![self.change(&self.all_bodies()) - self.work()],
            _ => Vec::new(),
        };
        laws.extend(self.in_step());
        let energies = self.asked(self.told).filter_map(|q| match &q.ask {
            Ask::Energy { when, of: None } => Some((Expr::symbol(&q.name), *when)),
            _ => None,
        });
        for (energy, when) in energies {
            let bodies = self.all_bodies();
            laws.push(match when {
                EnergyWhen::Before => continue,
                EnergyWhen::After => energy - self.kinetic(&bodies, Moment::End),
                EnergyWhen::Lost => energy + self.change(&bodies),
            });
        }
        laws
    }

    fn all_bodies(&self) -> Vec<usize> {
        (0..self.scene.bodies.len()).collect()
    }

    /// Where one coordinate tells where all bodies are, the speeds and spins asked for at one moment grow in step, and so do the
    /// way and the angle of a body that rolls.
    fn in_step(&self) -> Vec<Expr> {
        let (rates, ways) = match &self.told.placed.kind {
            StageKind::Turn(_) | StageKind::Linkage(_) => (true, false),
            StageKind::Slide(slide) => (false, slide.rolling),
            _ => (false, false),
        };
        let value = |q: &Question| {
            let answer = self.answers.iter().find(|a| a.name == q.name)?;
            answer.formula().filter(|value| !value.is_zero()).cloned()
        };
        let asked = self.asked(self.told).filter(|q| match q.ask {
            Ask::Velocity { along: Some(_), .. } | Ask::Spin { .. } => rates,
            Ask::Distance | Ask::Angle { .. } => ways,
            _ => false,
        });
        let asked = asked.filter_map(|q| Some((Expr::symbol(&q.name), value(q)?)));
        let asked: Vec<(Expr, Expr)> = asked.collect();
        let pairs = asked.windows(2);
        pairs
            .map(|p| &p[0].0 * &p[1].1 - &p[1].0 * &p[0].1)
            .collect()
    }

    /// v = v₀ + a t, v² = v₀² + 2 a s, 2 s = (v₀ + v) t, the same of a spin, and v = ω r of a body that rolls.
    fn along_a_line(&self, body: usize, along: &Vector, rolls: bool) -> Vec<Expr> {
        let value = |of: &Option<Expr>, ask: &dyn Fn(&Ask) -> bool| {
            let name = self.asked(self.told).find(|q| ask(&q.ask));
            name.map(|q| Expr::symbol(&q.name)).or_else(|| of.clone())
        };
        let [start, end] =
            [Moment::Start, Moment::End].map(|m| dot(&self.velocity(body, m), along));
        let [spin_before, spin] = [Moment::Start, Moment::End].map(|m| self.spin(body, m));
        let time = value(&self.told.time, &|ask| matches!(ask, Ask::Time));
        let way = value(&self.told.way, &|ask| matches!(ask, Ask::Distance));
        let is_rate = |ask: &Ask| matches!(ask, Ask::Acceleration { body: b, .. } if *b == body);
        let rate = value(&self.told.acceleration, &is_rate);
        let angular = self.told.steps.iter().find(|step| step.letter == "alpha");
        let mut laws = Vec::new();
        if let (Some(a), Some(t)) = (&rate, &time) {
            laws.push(&end - &start - a * t);
        }
        if let (Some(a), Some(s)) = (&rate, &way) {
            laws.push(end.powi(2) - start.powi(2) - Expr::from(2) * a * s);
        }
        if let (Some(t), Some(s)) = (&time, &way) {
            laws.push(Expr::from(2) * s - (&start + &end) * t);
        }
        if let (Some(step), Some(t)) = (angular, &time) {
            // The letter counts whichever way the ball is turned.
            laws.extend(
                [1, -1].map(|way| &spin - &spin_before - Expr::from(way) * &step.value * t),
            );
        }
        if rolls {
            let speed = dot(&self.told.after.velocity[body], along);
            laws.push(&end * &self.told.after.spin[body] - &spin * &speed);
        }
        laws
    }

    /// The questions about a stage.
    fn asked<'b>(&'b self, told: &'b StageTold) -> impl Iterator<Item = &'b Question> {
        let stages = &self.scene.stages;
        let index = stages.iter().position(|s| s.name == told.placed.name);
        let questions = self.scene.questions.iter();
        questions.filter(move |q| index.is_some() && q.stage == index)
    }

    /// The stage at whose end a moment is, and its values where there is none.
    fn at(&self, moment: Moment) -> (Option<&StageTold>, &super::State) {
        match moment {
            Moment::Start => (self.before, &self.told.before),
            Moment::End => (Some(self.told), &self.told.after),
        }
    }

    /// Velocity of the center of a body \[m/s\]; of bodies that move as one by the name that one of them has.
    fn velocity(&self, body: usize, moment: Moment) -> Vector {
        let (stage, state) = self.at(moment);
        let mut velocity = state.velocity[body].clone();
        let questions = || stage.into_iter().flat_map(|stage| self.asked(stage));
        let own = |q: &&Question| matches!(&q.ask, Ask::Velocity { body: of, .. } if *of == body);
        let as_one = |of: usize, axis: usize| {
            let [of, this] = [of, body].map(|b| &state.velocity[b][axis]);
            of == this && !this.is_zero()
        };
        for q in questions()
            .filter(|q| !own(q))
            .chain(questions().filter(own))
        {
            let Ask::Velocity {
                body: of,
                point: None,
                along,
            } = &q.ask
            else {
                continue;
            };
            for axis in [0, 1]
                .into_iter()
                .filter(|a| *of == body || as_one(*of, *a))
            {
                let name = Expr::symbol(&q.name);
                match along {
                    Some(d) if d[1 - axis].is_zero() && d[axis].is_one() => velocity[axis] = name,
                    Some(d) if d[1 - axis].is_zero() && (-&d[axis]).is_one() => {
                        velocity[axis] = -name
                    }
                    Some(_) => {}
                    None => {
                        let name = format!("{}_{}", q.name, ["x", "y"][axis]);
                        velocity[axis] = Expr::from(Symbol::from(name.as_str()));
                    }
                }
            }
        }
        velocity
    }

    /// Spin of a body, counterclockwise \[rad/s\].
    fn spin(&self, body: usize, moment: Moment) -> Expr {
        let (stage, state) = self.at(moment);
        let mut questions = stage.into_iter().flat_map(|stage| self.asked(stage));
        let named = questions.find_map(|q| match &q.ask {
            Ask::Spin {
                body: of,
                clockwise,
            } if *of == body => {
                let name = Expr::symbol(&q.name);
                Some(if *clockwise { -name } else { name })
            }
            _ => None,
        });
        named.unwrap_or_else(|| state.spin[body].clone())
    }

    /// Kinetic energy of some bodies \[J\]; of bodies that turn about a fixed point by the moment of inertia about it.
    fn kinetic(&self, bodies: &[usize], moment: Moment) -> Expr {
        let half = Expr::ratio(1, 2);
        if let (Some([_, inertia]), StageKind::Turn(turn)) =
            (&self.told.inertia, &self.told.placed.kind)
        {
            return half * inertia * self.spin(turn.body, moment).powi(2);
        }
        let each = bodies.iter().filter(|b| !self.scene.bodies[**b].is_fixed());
        let of = |&b: &usize| {
            let body = &self.scene.bodies[b];
            let [x, y] = self.velocity(b, moment).map(|v| v.powi(2));
            let turning = &body.inertia * &self.spin(b, moment).powi(2);
            &half * (&body.mass * &(x + y) + turning)
        };
        Expr::sum(each.map(of))
    }

    /// What kinetic energy bodies gain \[J\].
    fn change(&self, bodies: &[usize]) -> Expr {
        self.kinetic(bodies, Moment::End) - self.kinetic(bodies, Moment::Start)
    }

    /// Work done on the bodies \[J\], over a distance by its name where one asks for it.
    fn work(&self) -> Expr {
        let work = Expr::sum(self.told.work.iter().map(|(_, work)| work.clone()));
        let mut asked = self.asked(self.told);
        let named = asked.find(|q| matches!(q.ask, Ask::Distance));
        match (named, &self.told.way) {
            (Some(q), Some(way)) if !way.is_constant() => work.replace(way, &Expr::symbol(&q.name)),
            _ => work,
        }
    }
}
