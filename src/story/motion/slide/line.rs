//! The forces on a body and on what strings join to it, along their lines, and the acceleration these give.

use super::super::strings::{Pulled, pulled};
use super::super::{half, kept, tidied};
use crate::answer::calc::{is_zero, sign};
use crate::domain::Domains;
use crate::expr::{Expr, dot};
use crate::scene::{Slide, Spring, Stage};
use crate::story::{Kept, Refused, State, Step};

/// The course from the beginning to the end.
pub(super) struct Course {
    pub time: Option<Expr>,
    pub distance: Expr,
    pub speed: Expr,
    pub spin: Expr,
}

/// How a body moves along a line.
pub(super) struct Line<'a> {
    pub stage: &'a Stage,
    pub slide: &'a Slide,
    /// Mass of the body and those that move along with it \[kg\].
    pub own: Expr,
    /// Mass of all that moves at its speed, with what turning pulleys add to it \[kg\].
    pub mass: Expr,
    /// The strings to other bodies.
    pub strings: Vec<Pulled<'a>>,
    /// Velocity along the line at the beginning \[m/s\].
    pub speed: Expr,
    /// Angular velocity at the beginning \[rad/s\].
    pub spin: Expr,
    /// Weights and applied force along the lines \[N\].
    pub pull: Expr,
    /// Friction along the line \[N\].
    pub friction: Expr,
    /// Friction of what moves at the other ends of strings \[N\].
    pub drag: Expr,
    /// Acceleration along the line \[m/s²\].
    pub acceleration: Expr,
    /// Angular acceleration \[rad/s²\].
    pub angular: Expr,
    /// Of a round body on a surface.
    pub round: Option<Round>,
}

/// A round body on a surface below it.
pub(super) struct Round {
    /// Radius, negative where the line leads to the left: the lowest point moves along the line at v + arm × ω \[m\].
    pub arm: Expr,
    /// Slip of the lowest point at the beginning, along the line \[m/s\]; zero where it rolls.
    pub slip: Expr,
}

/// 1, 0 or −1; `None` where that is not proved.
pub(super) fn proved(e: &Expr, domains: &Domains) -> Option<i64> {
    if is_zero(e, domains) == Some(true) {
        return Some(0);
    }
    let positive = sign(e, domains).side()?;
    Some(if positive { 1 } else { -1 })
}

/// What a spring does on the way s, k (relaxed s − s²/2) \[J\].
pub(super) fn spring_work(spring: &Spring, s: &Expr) -> Expr {
    &spring.stiffness * &(&(&spring.relaxed * s) - &half(&s.powi(2)))
}

impl<'a> Line<'a> {
    /// The forces along a line, and the acceleration they give; what friction has to keep to is added to the needs.
    pub fn of(
        stage: &'a Stage,
        before: &State,
        slide: &'a Slide,
        needs: &mut Vec<Expr>,
    ) -> Result<Line<'a>, Refused> {
        let scene = &stage.scene;
        let own = slide.company().into_iter();
        let own = tidied(stage, &Expr::sum(own.map(|b| scene.bodies[b].mass.clone())))?;
        let strings = pulled(stage, before, slide)?;
        let others = strings.iter().flat_map(|s| [&s.mass, &s.turning]);
        let mass = tidied(stage, &Expr::sum(others.chain([&own]).cloned()))?;
        let drag = Expr::sum(strings.iter().map(|s| s.friction.clone()));
        let speed = tidied(stage, &dot(&before.velocity[slide.body], &slide.along))?;
        let weight = slide.gravity.as_ref().map(|g| &own * g);
        let mut pull = slide.force.clone().unwrap_or_else(Expr::zero);
        if let Some(weight) = weight.as_ref().filter(|_| !slide.level) {
            pull = &pull - &(weight * &slide.along[1]);
        }
        pull = Expr::sum(strings.iter().map(|s| s.pull.clone()).chain([pull]));
        let mut line = Line {
            stage,
            slide,
            own,
            mass,
            strings,
            drag,
            speed,
            spin: before.spin[slide.body].clone(),
            pull: tidied(stage, &pull)?,
            friction: Expr::zero(),
            acceleration: Expr::zero(),
            angular: Expr::zero(),
            round: None,
        };
        let rough = slide.rolling || slide.friction.is_some();
        let steep = rough && !slide.level;
        let right = if steep { directed(stage, slide)? } else { 1 };
        let right = Expr::from(right);
        // What presses the body on the surface: the weight across the line.
        let limit = match (&slide.friction, &weight) {
            (Some(mu), Some(weight)) if slide.level => mu * weight,
            (Some(mu), Some(weight)) => mu * &(weight * &(&right * &slide.along[0])),
            _ => Expr::zero(),
        };
        match line.radius().filter(|_| steep && slide.with.is_empty()) {
            Some(radius) => line.on_surface(radius, &right, &limit, needs)?,
            None => line.friction = -limit,
        }
        line.acceleration = tidied(stage, &(&line.net() / &line.mass))?;
        Ok(line)
    }

    /// Friction on a round body: as much as keeps it rolling, or what its slip calls for.
    fn on_surface(
        &mut self,
        radius: &Expr,
        right: &Expr,
        limit: &Expr,
        needs: &mut Vec<Expr>,
    ) -> Result<(), Refused> {
        let inertia = self.inertia();
        let arm = right * radius;
        let slip = self.tidied(&(&self.speed + &(&arm * &self.spin)))?;
        if self.slide.is_smooth() {
            self.round = Some(Round { arm, slip });
            return Ok(());
        }
        let way = proved(&slip, self.domains());
        if self.slide.rolling && way != Some(0) {
            return Err(self.refused(
                "it slips when the stage begins",
                "give `friction` with \"until\": \"rolls\" for the stage before, or a spin that fits, or suppose of the contact before that it \"sticks\"",
            ));
        }
        let Some(way) = way else {
            return Err(self.refused(
                &format!(
                    "which way its lowest point slips, {}, is not decided",
                    crate::formula::write_plain(&slip)
                ),
                "say it by `relations`",
            ));
        };
        if way == 0 {
            // It rolls on: as much friction as keeps it rolling, up to the limit.
            let (force, inertia) = self.rolling(radius);
            let a = force / inertia;
            self.friction = self.tidied(&-(&self.apparent(radius) * &a))?;
            if self.slide.friction.is_some() {
                needs.push(self.tidied(&(limit - &self.friction))?);
                needs.push(self.tidied(&(limit + &self.friction))?);
            }
        } else {
            self.friction = &Expr::from(-way) * limit;
        }
        let moment = &arm * &self.friction;
        self.angular = self.tidied(&(&moment / inertia))?;
        self.round = Some(Round { arm, slip });
        Ok(())
    }

    pub fn domains(&self) -> &'a Domains {
        &self.stage.scene.domains
    }

    pub fn name(&self) -> &'a str {
        &self.stage.scene.bodies[self.slide.body].name
    }

    pub fn refused(&self, why: &str, hint: &str) -> Refused {
        Refused::new(&self.stage.name, format!("`{}`: {why}", self.name()), hint)
    }

    fn inertia(&self) -> &'a Expr {
        &self.stage.scene.bodies[self.slide.body].inertia
    }

    /// Whether the lowest point slips, or may do so on a smooth surface.
    pub fn slips(&self) -> bool {
        let slips = |r: &Round| is_zero(&r.slip, self.domains()) != Some(true);
        self.slide.is_smooth()
            || self.slide.friction.is_some() && self.round.as_ref().is_none_or(slips)
    }

    /// Forces and accelerations, as they follow from each other.
    pub fn steps(&self) -> Vec<Step> {
        let mut out = Vec::new();
        if self.rubs() {
            let total = &self.friction + &self.drag;
            let why = "the friction along the line, its coefficient times the normal force";
            out.push(Step::new("F", &total, &total, why));
        }
        let rolls = self.round.is_some() && !self.slips();
        let why = if rolls {
            "the acceleration along the line, with the inertia of turning added to the mass"
        } else if self.strings.is_empty() {
            "the acceleration along the line"
        } else if self.strings.iter().any(|s| s.string.under.is_some()) {
            "the acceleration along the string, of which what hangs on the movable pulley has half, so that it counts with half its weight and a quarter of its mass"
        } else if self.strings.iter().all(|s| s.turning.is_zero()) {
            "the acceleration of all bodies along the string"
        } else {
            "the acceleration of all bodies along the string, which also turns the pulleys"
        };
        let [force, inertia] = self.driven();
        let force = match is_zero(&self.acceleration, self.domains()) {
            Some(true) => Expr::zero(),
            _ => force,
        };
        let sides = [&force, &inertia];
        out.push(Step::by_newton("a", sides, &self.acceleration, why));
        if let Some(round) = self.round.as_ref().filter(|_| self.slips() && self.rubs()) {
            let moment = &round.arm * &self.friction;
            let why = "the angular acceleration, by the moment of friction about the center";
            let sides = [&moment, self.inertia()];
            out.push(Step::by_newton("alpha", sides, &self.angular, why));
        }
        out
    }

    /// What turning adds to the mass of a body that rolls \[kg\].
    fn apparent(&self, radius: &Expr) -> Expr {
        self.inertia() / &radius.powi(2)
    }

    /// What gets a body that rolls faster \[N\], and its mass with what turning adds to it \[kg\].
    fn rolling(&self, radius: &Expr) -> (Expr, Expr) {
        let inertia = &self.mass + &self.apparent(radius);
        (&self.pull + &self.drag, inertia)
    }

    /// What gets it faster without a spring \[N\], and the mass that this moves, with what turning adds to it \[kg\].
    pub fn driven(&self) -> [Expr; 2] {
        let rolls = self.round.is_some() && !self.slips();
        match self.radius().filter(|_| rolls) {
            Some(radius) => self.rolling(radius).into(),
            None => [self.net(), self.mass.clone()],
        }
    }

    fn radius(&self) -> Option<&'a Expr> {
        self.stage.scene.bodies[self.slide.body].shape.radius()
    }

    /// The kinetic energy of all that moves, at a speed and spin \[J\].
    pub fn energy(&self, speed: &Expr, spin: &Expr) -> Result<Expr, Refused> {
        let mut twice = &self.mass * &speed.powi(2);
        if self.round.is_some() {
            twice = &twice + &(self.inertia() * &spin.powi(2));
        }
        self.tidied(&half(&twice))
    }

    /// All forces along the lines \[N\].
    pub fn net(&self) -> Expr {
        &(&self.pull + &self.friction) + &self.drag
    }

    /// The pulleys of all strings with their spins where the speed is 1.
    pub fn pulleys(&self) -> impl Iterator<Item = (usize, &Expr)> {
        let all = self.strings.iter().map(|s| (s.string, &s.spins));
        all.flat_map(|(s, spins)| s.over.iter().copied().chain(s.under).zip(spins))
    }

    /// Whether friction does work.
    pub fn rubs(&self) -> bool {
        self.slips() && !self.slide.is_smooth()
            || self.strings.iter().any(|s| s.string.friction.is_some())
    }

    pub fn energy_kept(&self) -> Kept {
        let (conserved, why) = match () {
            () if self.rubs() => (false, "friction does work against the slip"),
            () if self.slide.force.is_some() => (
                false,
                "the force does work, its component along the line times the distance",
            ),
            () if self.slide.spring.is_some() && self.round.is_some() => (
                true,
                match self.slide.along[1].is_zero() {
                    true => {
                        "the spring keeps what it takes, and the lowest point is at rest, so that friction there does no work"
                    }
                    false => {
                        "the spring keeps what it takes, weight has a potential, and the lowest point is at rest, so that friction there does no work"
                    }
                },
            ),
            () if self.slide.spring.is_some() && self.slide.along[1].is_zero() => {
                (true, "the spring keeps what it takes, and gives it back")
            }
            () if self.slide.spring.is_some() => (
                true,
                "the spring keeps what it takes, and weight has a potential",
            ),
            () if self.round.is_some() && !self.slide.is_smooth() => (
                true,
                "the lowest point is at rest, so that friction there does no work, and weight has a potential",
            ),
            () if !self.strings.is_empty() => (
                true,
                "the string only passes energy on from body to body, and weight has a potential",
            ),
            () if self.slide.gravity.is_none() => (true, "no force acts along the line"),
            () => (true, "the guide does no work, and weight has a potential"),
        };
        kept("energy", conserved, why)
    }

    /// Work of each force, along the way of the point where it acts.
    pub fn work(&self, course: &Course) -> Vec<(&'static str, Expr)> {
        let mut out = Vec::new();
        if let Some(g) = self.slide.gravity.as_ref().filter(|_| !self.slide.level) {
            let lost = -&(&self.slide.along[1] * &course.distance);
            let own = &(&self.own * g) * &lost;
            let others = self.strings.iter().map(|s| &s.pull * &course.distance);
            let weight = Expr::sum([own].into_iter().chain(others));
            if is_zero(&weight, self.domains()) != Some(true) {
                out.push(("weight", weight));
            }
        }
        if let Some(force) = &self.slide.force {
            out.push(("force", force * &course.distance));
        }
        if let Some(spring) = &self.slide.spring {
            out.push(("spring", spring_work(spring, &course.distance)));
        }
        if self.rubs() {
            let way = match (&self.round, &course.time) {
                // The slip changes uniformly.
                (Some(round), Some(t)) => {
                    let end = &course.speed + &(&round.arm * &course.spin);
                    half(&(&(&round.slip + &end) * t))
                }
                _ => course.distance.clone(),
            };
            let drag = &self.drag * &course.distance;
            out.push(("friction", &(&self.friction * &way) + &drag));
        }
        out
    }

    pub fn tidied(&self, e: &Expr) -> Result<Expr, Refused> {
        tidied(self.stage, e)
    }
}

/// Whether the line leads to the right, 1, or to the left, −1: the surface is below it. Refused where that is not decided.
pub(super) fn directed(stage: &Stage, slide: &Slide) -> Result<i64, Refused> {
    match proved(&slide.along[0], &stage.scene.domains) {
        Some(way @ (1 | -1)) => Ok(way),
        _ => Err(Refused::new(
            &stage.name,
            format!(
                "`{}`: whether its line leads to the right or to the left is not decided, and so is which side the surface is on",
                stage.scene.bodies[slide.body].name
            ),
            "say it by the domain of an angle, or by `relations`",
        )),
    }
}
