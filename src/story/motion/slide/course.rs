//! The course of a motion with constant acceleration, from its beginning to its end.

use super::super::supposed::Supposed;
use super::super::{arrival, arrives, half, never_arrives};
use super::line::{Course, Line, proved, spring_work};
use crate::algebra::Sign;
use crate::answer::calc::{Seen, above_zero, is_zero, sign};
use crate::expr::{Expr, Function};
use crate::scene::{SlideEnd, Spring};
use crate::story::{OnSpring, Refused, Step};

impl Line<'_> {
    /// v = v₀ + a t.
    fn speed_after(&self, t: &Expr) -> Expr {
        &self.speed + &(&self.acceleration * t)
    }

    /// ω = ω₀ + α t.
    fn spin_after(&self, t: &Expr) -> Expr {
        &self.spin + &(&self.angular * t)
    }

    /// s = v₀ t + a t²/2.
    fn way(&self, t: &Expr) -> Expr {
        &(&self.speed * t) + &half(&(&self.acceleration * &t.powi(2)))
    }

    /// v² = v₀² + 2 a s.
    fn square_after(&self, s: &Expr) -> Expr {
        let square = &self.speed.powi(2) + &(&(&Expr::from(2) * &self.acceleration) * s);
        match &self.slide.spring {
            Some(spring) => {
                let [_, mass] = self.driven();
                &square + &(&(&Expr::from(2) * &spring_work(spring, s)) / &mass)
            }
            None => square,
        }
    }

    /// How the motion goes to its end.
    pub fn course(
        &self,
        steps: &mut Vec<Step>,
        supposed: &mut Supposed<'_>,
        limits: &mut Vec<Expr>,
    ) -> Result<Course, Refused> {
        let (time, distance, speed) = match &self.slide.until {
            SlideEnd::Distance(s) => {
                let (time, speed) = self.over(s, supposed)?;
                (time, s.clone(), speed)
            }
            SlideEnd::Time(t) if self.slide.spring.is_some() => {
                let [distance, speed] = self.swung(t, steps, supposed)?;
                (Some(t.clone()), distance, speed)
            }
            SlideEnd::Time(t) => {
                let speed = self.tidied(&self.speed_after(t))?;
                if self.rubs() && self.round.is_none() {
                    // Friction stops the body and does not draw it back.
                    limits.push(speed.clone());
                }
                (Some(t.clone()), self.tidied(&self.way(t))?, speed)
            }
            SlideEnd::Stops if self.slide.spring.is_some() => {
                let [time, distance] = self.to_greatest(steps, supposed)?;
                (Some(time), distance, Expr::zero())
            }
            SlideEnd::Stops => {
                let [time, distance] = self.to_rest(steps, supposed)?;
                (Some(time), distance, Expr::zero())
            }
            SlideEnd::Rolls | SlideEnd::Together => {
                let time = self.to_rolling(steps, supposed)?;
                let distance = self.tidied(&self.way(&time))?;
                let speed = self.tidied(&self.speed_after(&time))?;
                (Some(time), distance, speed)
            }
        };
        let spin = match (&self.round, &time) {
            (Some(round), _) if self.slide.spring.is_some() => {
                self.tidied(&-(&speed / &round.arm))?
            }
            (Some(_), Some(t)) => self.tidied(&self.spin_after(t))?,
            _ => self.spin.clone(),
        };
        if let Some(round) = self.round.as_ref().filter(|_| self.slips() && self.rubs())
            && !matches!(self.slide.until, SlideEnd::Rolls)
        {
            let end = &speed + &(&round.arm * &spin);
            let way = proved(&round.slip, self.domains()).unwrap_or(1);
            limits.push(self.tidied(&(&Expr::from(way) * &end))?);
        }
        Ok(Course {
            time,
            distance,
            speed,
            spin,
        })
    }

    /// Whether no force that stays the same makes it faster or slower.
    pub fn is_steady(&self) -> bool {
        is_zero(&self.acceleration, self.domains()) == Some(true)
    }

    /// Time and velocity at the end of a distance; no time where it rests all along.
    fn over(&self, s: &Expr, supposed: &mut Supposed<'_>) -> Result<(Option<Expr>, Expr), Refused> {
        let a = &self.acceleration;
        if let Some(spring) = &self.slide.spring {
            let speed = self.arrival(s, supposed)?;
            return Ok((Some(self.swinging(spring, s)?), speed));
        }
        let still = self.is_steady();
        let speed = match still {
            true => self.speed.clone(),
            false => self.arrival(s, supposed)?,
        };
        let rests = still && is_zero(&speed, self.domains()) == Some(true);
        if rests && is_zero(s, self.domains()) == Some(false) {
            return Err(self.refused("it is at rest, and nothing moves it", ""));
        }
        let time = match still {
            true => s / &speed,
            false => &(&speed - &self.speed) / a,
        };
        let time = (!rests).then(|| self.tidied(&time)).transpose()?;
        Ok((time, speed))
    }

    /// Time and distance until it stops.
    fn to_rest(
        &self,
        steps: &mut Vec<Step>,
        supposed: &mut Supposed<'_>,
    ) -> Result<[Expr; 2], Refused> {
        let slowing = -&self.acceleration;
        let slows = format!("`{}` slows down", self.name());
        supposed.positive(&slowing, slows, || match self.friction.is_zero() {
            true => self.refused("nothing slows it down", "add \"friction\": \"mu\""),
            false => self.refused(
                "friction does not slow it down against what drives it",
                "more friction would, or a motion that ends after a `distance` or a time",
            ),
        })?;
        let raw = &self.speed / &slowing;
        let time = self.tidied(&raw)?;
        let why = "the time until it stops";
        steps.push(Step::new("t", &raw, &time, why));
        let way = &self.speed.powi(2) / &(&Expr::from(2) * &slowing);
        Ok([time, self.tidied(&way)?])
    }

    /// Time and distance until a spring stops it.
    fn to_greatest(
        &self,
        steps: &mut Vec<Step>,
        supposed: &mut Supposed<'_>,
    ) -> Result<[Expr; 2], Refused> {
        let Some(spring) = &self.slide.spring else {
            return Err(self.refused("no spring stops it", ""));
        };
        let k = &spring.stiffness;
        let [force, mass] = self.sprung(spring)?;
        // m v₀²/2 + f s − k s²/2 = 0, f the force at the beginning; the other root lies behind.
        let from_rest = is_zero(&self.speed, self.domains()) == Some(true);
        if from_rest {
            let begins = format!("`{}` begins to move", self.name());
            supposed.positive(&force, begins, || {
                self.refused("it is at rest, and nothing moves it", "")
            })?;
        }
        let is_free = is_zero(&force, self.domains()) == Some(true);
        let root = &force.powi(2) + &(&(k * &mass) * &self.speed.powi(2));
        let distance = match (from_rest, is_free) {
            (true, _) => &(&Expr::from(2) * &force) / k,
            (_, true) => &self.speed * &(&mass / k).sqrt(),
            _ => &(&force + &root.sqrt()) / k,
        };
        // x = (1 − cos ωt) f/k + (v₀/ω) sin ωt with ω² = k/m is greatest where tan ωt = −v₀ √(km)/f, ωt between 0 and π.
        let phase = match (from_rest, is_free) {
            (true, _) => Expr::pi(),
            (_, true) => half(&Expr::pi()),
            _ => match sign(&force, self.domains()) {
                Seen::Proved(Sign::Negative) => {
                    let swing = &self.speed * &(k * &mass).sqrt();
                    Expr::call(Function::Atan, self.tidied(&-(&swing / &force))?)
                }
                _ => Expr::call(Function::Acos, self.tidied(&-(&force / &root.sqrt()))?),
            },
        };
        let raw = &phase * &(&mass / k).sqrt();
        let time = self.tidied(&raw)?;
        let why = "the time until it stops, of a harmonic oscillation about the place where the forces balance";
        steps.push(Step::new("t", &raw, &time, why));
        Ok([time, self.tidied(&distance)?])
    }

    /// The force at the beginning, that of a spring included \[N\], and the mass that it moves.
    fn sprung(&self, spring: &Spring) -> Result<[Expr; 2], Refused> {
        let [net, mass] = self.driven();
        let force = self.tidied(&(&net + &(&spring.stiffness * &spring.relaxed)))?;
        Ok([force, mass])
    }

    /// How the forces drive it on a spring, at the beginning and at the end of a way.
    pub fn on_spring(&self, spring: &Spring, way: &Expr) -> Result<OnSpring, Refused> {
        let [force, inertia] = self.sprung(spring)?;
        let last = &force - &(&spring.stiffness * way);
        let rate = |force: &Expr| self.tidied(&(force / &inertia));
        let rates = [rate(&force)?, rate(&last)?];
        Ok(OnSpring { inertia, rates })
    }

    /// The time on a spring over a way: m v² + k x² stays, with x from the place where the forces balance, so that x goes as
    /// the cosine of a phase that begins at acos(f/R), R² = f² + k m v₀².
    fn swinging(&self, spring: &Spring, s: &Expr) -> Result<Expr, Refused> {
        let k = &spring.stiffness;
        let [force, mass] = self.sprung(spring)?;
        let left = &force - &(k * s);
        let root = &force.powi(2) + &(&(k * &mass) * &self.speed.powi(2));
        let root = self.tidied(&root.sqrt())?;
        let phase = |e: &Expr| Ok(Expr::call(Function::Acos, self.tidied(&(e / &root))?));
        let phase = match is_zero(&self.speed, self.domains()) == Some(true) {
            true => Expr::call(Function::Acos, self.tidied(&(&left / &force))?),
            false => &phase(&left)? - &phase(&force)?,
        };
        self.tidied(&(&phase * &(&mass / k).sqrt()))
    }

    /// Distance and velocity after a time on a spring that has not stopped it yet.
    fn swung(
        &self,
        t: &Expr,
        steps: &mut Vec<Step>,
        supposed: &mut Supposed<'_>,
    ) -> Result<[Expr; 2], Refused> {
        let Some(spring) = &self.slide.spring else {
            return Err(self.refused("no spring acts on it", ""));
        };
        let [stops, _] = self.to_greatest(&mut Vec::new(), supposed)?;
        let left = self.tidied(&(&stops - t))?;
        supposed.not_negative(
            &left,
            format!("`{}` does not stop before", self.name()),
            || {
                self.refused(
                    "it stops before the stage ends",
                    "end the stage with \"until\": \"stops\", and let it come back in the next one",
                )
            },
        )?;
        // x = (1 − cos ωt) f/k + (v₀/ω) sin ωt with ω² = k/m.
        let [force, mass] = self.sprung(spring)?;
        let k = &spring.stiffness;
        let rate = self.tidied(&(k / &mass).sqrt())?;
        let phase = &rate * t;
        let (swing, place) = (&self.speed / &rate, &force / k);
        let way = &(&place * &(Expr::one() - phase.cos())) + &(&swing * &phase.sin());
        let distance = self.tidied(&way)?;
        let why = "the distance covered in a harmonic oscillation about the place where the forces balance";
        steps.push(Step::new("s", &way, &distance, why));
        let raw = &(&(&place * &rate) * &phase.sin()) + &(&self.speed * &phase.cos());
        let speed = self.tidied(&raw)?;
        let why = "the velocity along the line at the end, the rate at which that grows";
        steps.push(Step::new("v", &raw, &speed, why));
        Ok([distance, speed])
    }

    /// The time until it rolls.
    fn to_rolling(
        &self,
        steps: &mut Vec<Step>,
        supposed: &mut Supposed<'_>,
    ) -> Result<Expr, Refused> {
        let Some(round) = &self.round else {
            return Err(self.refused("it does not roll", "a disk, ring or sphere does"));
        };
        if !self.slips() {
            return Ok(Expr::zero());
        }
        let gain = &self.acceleration + &(&round.arm * &self.angular);
        let raw = -(&round.slip / &gain);
        let time = self.tidied(&raw)?;
        let rolls = format!("`{}` comes to roll", self.name());
        let never = || {
            self.refused(
                "its slip grows, so that it never rolls",
                "the surface is too steep or too smooth",
            )
        };
        let slips = matches!(
            sign(&round.slip, self.domains()),
            Seen::Proved(Sign::Positive | Sign::Negative)
        );
        // Slip that stays as it is lasts for ever.
        match slips {
            true => supposed.positive(&self.tidied(&-(&round.slip * &gain))?, rolls, never)?,
            false => supposed.not_negative(&time, rolls, never)?,
        }
        let why = "the time until its lowest point no longer slips";
        steps.push(Step::new("t", &raw, &time, why));
        Ok(time)
    }

    /// Velocity along the line after a distance.
    fn arrival(&self, s: &Expr, supposed: &mut Supposed<'_>) -> Result<Expr, Refused> {
        let square = self.tidied(&self.square_after(s))?;
        let seen = sign(&square, self.domains());
        if let Seen::Proved(Sign::Negative | Sign::NotPositive) = seen {
            let end = self.tidied(&half(&(&self.mass * &square)))?;
            return Err(never_arrives(self.stage, self.slide.body, &end));
        }
        if self.slide.spring.is_some() && seen == Seen::Proved(Sign::Zero) {
            let hint = "end the stage with \"until\": \"stops\"";
            return Err(self.refused("it comes to rest just there", hint));
        }
        let body = self.slide.body;
        // At rest a constant force of zero moves nothing; a spring may bring the body just there.
        let is_steady = self.slide.spring.is_none();
        let starts = is_steady && is_zero(&self.speed, self.domains()) == Some(true);
        supposed.words.extend(match (starts, seen) {
            (true, Seen::Proved(Sign::Positive)) => None,
            (true, _) if is_zero(s, self.domains()) == Some(false) => Some(arrives(
                self.stage,
                body,
                above_zero(&square, self.domains()),
            )),
            _ => arrival(self.stage, body, &square, (seen, &[])),
        });
        self.tidied(&square.sqrt())
    }

    /// Time, distance, velocity and spin at the end.
    pub fn told(&self, course: &Course, steps: &mut Vec<Step>) {
        let Some(t) = &course.time else { return };
        let rolls = matches!(self.slide.until, SlideEnd::Rolls) && self.slips();
        if !matches!(self.slide.until, SlideEnd::Distance(_)) {
            let raw = match &self.slide.until {
                SlideEnd::Stops => -(&self.speed.powi(2) / &(&Expr::from(2) * &self.acceleration)),
                _ => self.way(t),
            };
            // What turns back on the way covers more than it is displaced.
            let keeps_on = [&self.speed, &course.speed].map(|v| sign(v, self.domains()));
            let why = match keeps_on
                .iter()
                .all(|seen| seen.is_positive() || seen.is_not_negative())
            {
                true => "the distance covered",
                false => "the displacement",
            };
            let mut step = Step::new("s", &raw, &course.distance, why);
            if rolls {
                step.by_time = vec![Expr::zero(), self.speed.clone(), half(&self.acceleration)];
            }
            steps.push(step);
        }
        if !matches!(self.slide.until, SlideEnd::Stops) {
            let raw = match &self.slide.until {
                SlideEnd::Distance(s) => self.square_after(s).sqrt(),
                _ => self.speed_after(t),
            };
            let why = "the velocity along the line at the end";
            let mut step = Step::new("v", &raw, &course.speed, why);
            if rolls {
                step.by_time = vec![self.speed.clone(), self.acceleration.clone()];
            }
            steps.push(step);
        }
        if self.round.is_some() {
            let raw = match &self.round {
                // Rolling, the center is as fast as the rim.
                Some(round) if !self.slips() || matches!(self.slide.until, SlideEnd::Rolls) => {
                    -(&course.speed / &round.arm)
                }
                _ => self.spin_after(t),
            };
            let why = "the angular velocity at the end, counterclockwise";
            steps.push(Step::new("omega", &raw, &course.spin, why));
        }
    }
}
