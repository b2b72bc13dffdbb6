//! Motion of a body along a straight line under constant forces: on a smooth guide, on a rough surface, or rolling.
//!
//! The acceleration is constant, so that v² − v₀² = 2 a s and v − v₀ = a t. A round body on a rough surface slips by
//! v + R ω at its lowest point, counted along a line to the right; friction acts against the slip until there is none.

use super::strings::{Pulled, pulled};
use super::{arrival, half, kept, meanwhile, tidied};
use crate::algebra::Sign;
use crate::answer::calc::{Seen, at_least_zero, essential, is_zero, sign};
use crate::domain::Domains;
use crate::expr::{Expr, Vector, dot};
use crate::formula::{Sentence, sentence};
use crate::scene::{Slide, SlideEnd, Stage};
use crate::story::{Refused, StageTold, State, Step};

/// How a body moves along a line.
struct Line<'a> {
    stage: &'a Stage,
    slide: &'a Slide,
    /// Mass of the body and those that move along with it \[kg\].
    own: Expr,
    /// Mass of all that moves at its speed, with what turning pulleys add to it \[kg\].
    mass: Expr,
    /// The strings to other bodies.
    strings: Vec<Pulled<'a>>,
    /// Velocity along the line at the beginning \[m/s\].
    speed: Expr,
    /// Angular velocity at the beginning \[rad/s\].
    spin: Expr,
    /// Weights and applied force along the lines \[N\].
    pull: Expr,
    /// Friction along the line \[N\].
    friction: Expr,
    /// Friction of what moves at the other ends of strings \[N\].
    drag: Expr,
    /// Acceleration along the line \[m/s²\].
    acceleration: Expr,
    /// Angular acceleration \[rad/s²\].
    angular: Expr,
    /// Of a round body on a surface.
    round: Option<Round>,
}

/// A round body on a surface below it.
struct Round {
    /// Radius, negative where the line leads to the left: the lowest point moves along the line at v + arm × ω \[m\].
    arm: Expr,
    /// Slip of the lowest point at the beginning, along the line \[m/s\]; zero where it rolls.
    slip: Expr,
}

/// The course from the beginning to the end.
struct Course {
    time: Option<Expr>,
    distance: Expr,
    speed: Expr,
    spin: Expr,
}

/// Motion along a line; `is_driven` where its acceleration or the pull of a string is asked.
pub(in crate::story) fn slide(
    stage: &Stage,
    before: State,
    slide: &Slide,
    is_driven: bool,
) -> Result<StageTold, Refused> {
    let mut assumptions = Vec::new();
    let mut needs = Vec::new();
    fits(stage, &before, slide)?;
    let line = Line::of(stage, &before, slide, &mut needs)?;
    not_negative(stage, slide, "speed", &line.speed, &mut assumptions)?;
    if let SlideEnd::Distance(distance) = &slide.until {
        not_negative(stage, slide, "distance", distance, &mut assumptions)?;
    }
    let mut steps = line.steps();
    let course = line.course(&mut steps, &mut assumptions, &mut needs)?;
    if !matches!(slide.until, SlideEnd::Distance(_)) || line.round.is_some() || is_driven {
        line.told(&course, &mut steps);
    } else {
        steps.clear();
    }
    let domains = &stage.scene.domains;
    for need in &needs {
        let (name, rolls) = (line.name(), !line.slips());
        match sign(need, domains) {
            Seen::Proved(s) if s.is_not_negative() => {}
            Seen::Proved(Sign::Negative) => {
                let (why, hint) = match (&line.round, rolls) {
                    (Some(_), true) => ("it slips", "the surface is too smooth for it to roll"),
                    (Some(_), false) => (
                        "it rolls before the stage ends",
                        "end the stage with \"until\": \"rolls\", and let it roll in the next one",
                    ),
                    (None, _) => (
                        "it stops before the stage ends",
                        "end the stage with \"until\": \"stops\"",
                    ),
                };
                return Err(line.refused(why, hint));
            }
            _ => assumptions.push(sentence![
                at_least_zero(need, domains),
                ", so that `",
                name,
                match (&line.round, rolls) {
                    (Some(_), true) => "` does not slip",
                    (Some(_), false) => "` slips to the end of the stage",
                    (None, _) => "` does not stop before",
                }
            ]),
        }
    }
    for (pulley, spin) in line.pulleys() {
        let body = &stage.scene.bodies[pulley];
        let gap = &before.spin[pulley] - &(spin * &line.speed);
        if !body.is_light_pulley() && is_zero(&gap, domains) == Some(false) {
            return Err(Refused::new(
                &stage.name,
                format!(
                    "the rim of `{}` does not begin to move with the string",
                    body.name
                ),
                "put an impact before it in which the string pulls, or give it a spin that fits",
            ));
        }
    }
    if let ([string], true) = (line.strings.as_slice(), is_driven) {
        steps.extend(string.steps(stage, &line.acceleration)?);
    }
    let mut tensions = Vec::new();
    for string in &line.strings {
        let pulls = string.taut(stage, &line.acceleration, &mut needs, &mut assumptions)?;
        let own = slide.company().into_iter().map(|b| (b, pulls.last()));
        // Of several strings at one body none is meant more than another.
        let own = own.filter(|_| line.strings.len() == 1);
        let others = string.string.to.iter().map(|b| (*b, pulls.first()));
        tensions.extend(
            own.chain(others)
                .filter_map(|(b, pull)| Some((b, pull?.clone()))),
        );
    }
    let mut after = before.clone();
    for (bodies, along) in lumps(slide) {
        for (b, k) in bodies.iter().flat_map(|b| [(*b, 0), (*b, 1)]) {
            after.center[b][k] = &after.center[b][k] + &(&along[k] * &course.distance);
            after.velocity[b][k] = tidied(stage, &(&course.speed * &along[k]))?;
        }
    }
    for (pulley, spin) in line.pulleys() {
        after.spin[pulley] = tidied(stage, &(spin * &course.speed))?;
        let turned = &before.angle[pulley] + &(spin * &course.distance);
        after.angle[pulley] = tidied(stage, &turned)?;
    }
    if line.round.is_some() {
        let b = slide.body;
        after.spin[b] = course.spin.clone();
        after.angle[b] = match &course.time {
            Some(t) => {
                let turned = half(&(&(&line.spin + &course.spin) * t));
                tidied(stage, &(&before.angle[b] + &turned))?
            }
            None => before.angle[b].clone(),
        };
    }
    assumptions.extend(meanwhile::others(
        stage,
        &before,
        &mut after,
        course.time.as_ref(),
    ));
    let mut out = StageTold::new(stage, before, after);
    out.kept = vec![line.energy_kept()];
    out.energy = Some([
        line.energy(&line.speed, &line.spin)?,
        line.energy(&course.speed, &course.spin)?,
    ]);
    out.work = line.work(&course);
    out.time = course.time;
    out.way = Some(course.distance);
    out.steps = steps;
    out.acceleration = Some(line.acceleration.clone());
    out.tensions = tensions;
    out.assumptions = assumptions;
    needs.push(line.speed.clone());
    if let SlideEnd::Distance(_) = &slide.until {
        needs.push(tidied(stage, &course.speed.powi(2))?);
    }
    out.needs = needs;
    Ok(out)
}

/// The bodies that move along one line each, with their directions.
fn lumps(slide: &Slide) -> Vec<(Vec<usize>, &Vector)> {
    let strung = slide.strings.iter().map(|s| (s.to.clone(), &s.along));
    let own = (slide.company(), &slide.along);
    std::iter::once(own).chain(strung).collect()
}

/// Refuses a body that does not begin to move along its line, or turns where nothing lets it.
fn fits(stage: &Stage, before: &State, slide: &Slide) -> Result<(), Refused> {
    let speed = dot(&before.velocity[slide.body], &slide.along);
    for (bodies, along) in lumps(slide) {
        fits_line(stage, before, slide, &bodies, along, &speed)?;
    }
    for p in slide.pulleys() {
        let zero = |e: &Expr| is_zero(e, &stage.scene.domains) != Some(false);
        if !before.velocity[p].iter().all(zero) {
            return Err(Refused::new(
                &stage.name,
                format!("the center of `{}` moves", stage.scene.bodies[p].name),
                "a string runs over pulleys whose centers stay",
            ));
        }
    }
    Ok(())
}

fn fits_line(
    stage: &Stage,
    before: &State,
    slide: &Slide,
    bodies: &[usize],
    direction: &Vector,
    speed: &Expr,
) -> Result<(), Refused> {
    let domains = &stage.scene.domains;
    let across = [-&direction[1], direction[0].clone()];
    let turns = slide.rolling || slide.friction.is_some();
    for &b in bodies {
        let body = &stage.scene.bodies[b];
        let v = &before.velocity[b];
        let is_alone = b == slide.body && slide.with.is_empty();
        let may_turn = turns && is_alone && body.shape.radius().is_some();
        let leaves = is_zero(&dot(v, &across), domains) == Some(false);
        if leaves || !may_turn && is_zero(&before.spin[b], domains) == Some(false) {
            return Err(Refused::new(
                &stage.name,
                format!(
                    "`{}` does not begin to move along this line without turning",
                    body.name
                ),
                "an impact before it may stop what does not fit",
            ));
        }
        let gap = &dot(v, direction) - speed;
        if is_zero(&gap, domains) == Some(false) {
            return Err(Refused::new(
                &stage.name,
                format!(
                    "`{}` does not begin to move like `{}`",
                    body.name, stage.scene.bodies[slide.body].name
                ),
                "bodies move along together after an impact in which they stick",
            ));
        }
    }
    Ok(())
}

/// Refuses a speed or distance that is negative; one that may be is assumed not to be.
fn not_negative(
    stage: &Stage,
    slide: &Slide,
    what: &str,
    size: &Expr,
    assumptions: &mut Vec<Sentence>,
) -> Result<(), Refused> {
    match sign(size, &stage.scene.domains) {
        Seen::Proved(s) if s.is_not_negative() => {}
        Seen::Proved(_) | Seen::Negative => {
            return Err(Refused::new(
                &stage.name,
                format!(
                    "`{}` is to move along the line, and its {what} along it, {}, is negative",
                    stage.scene.bodies[slide.body].name,
                    crate::formula::write_plain(size)
                ),
                "turn the direction round",
            ));
        }
        _ => assumptions.push(at_least_zero(size, &stage.scene.domains)),
    }
    Ok(())
}

/// 1, 0 or −1; `None` where that is not proved.
fn proved(e: &Expr, domains: &Domains) -> Option<i64> {
    if is_zero(e, domains) == Some(true) {
        return Some(0);
    }
    match sign(e, domains) {
        Seen::Proved(Sign::Positive | Sign::NotNegative) => Some(1),
        Seen::Proved(Sign::Negative | Sign::NotPositive) => Some(-1),
        _ => None,
    }
}

impl<'a> Line<'a> {
    fn of(
        stage: &'a Stage,
        before: &State,
        slide: &'a Slide,
        needs: &mut Vec<Expr>,
    ) -> Result<Line<'a>, Refused> {
        let scene = &stage.scene;
        let domains = &scene.domains;
        let own = slide.company().into_iter();
        let own = tidied(stage, &Expr::sum(own.map(|b| scene.bodies[b].mass.clone())))?;
        let strings = pulled(stage, before, slide)?;
        let others = strings.iter().flat_map(|s| [&s.mass, &s.turning]);
        let mass = tidied(stage, &Expr::sum(others.chain([&own]).cloned()))?;
        let drag = Expr::sum(strings.iter().map(|s| s.friction.clone()));
        let speed = tidied(stage, &dot(&before.velocity[slide.body], &slide.along))?;
        let weight = slide.gravity.as_ref().map(|g| &own * g);
        let mut pull = slide.force.clone().unwrap_or_else(Expr::zero);
        if let Some(weight) = &weight {
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
        let right = proved(&slide.along[0], domains).filter(|_| rough);
        if rough && !matches!(right, Some(1 | -1)) {
            return Err(line.refused(
                "whether its line leads to the right or to the left is not decided, and so is which side the surface is on",
                "say it by the domain of an angle, or by `relations`",
            ));
        }
        let right = Expr::from(right.unwrap_or(1));
        // What presses the body on the surface: the weight across the line.
        let limit = match (&slide.friction, &weight) {
            (Some(mu), Some(weight)) => mu * &(weight * &(&right * &slide.along[0])),
            _ => Expr::zero(),
        };
        let body = &scene.bodies[slide.body];
        let radius = body.shape.radius();
        match radius.filter(|_| rough && slide.with.is_empty()) {
            None => line.friction = -limit,
            Some(radius) => {
                let arm = &right * radius;
                let slip = tidied(stage, &(&line.speed + &(&arm * &line.spin)))?;
                let way = proved(&slip, domains);
                if slide.rolling && way != Some(0) {
                    return Err(line.refused(
                        "it slips when the stage begins",
                        "give `friction` with \"until\": \"rolls\" for the stage before, or a spin that fits",
                    ));
                }
                let Some(way) = way else {
                    return Err(line.refused(
                        &format!(
                            "which way its lowest point slips, {}, is not decided",
                            crate::formula::write_plain(&slip)
                        ),
                        "say it by `relations`",
                    ));
                };
                if way == 0 {
                    // It rolls on: as much friction as keeps it rolling, up to the limit.
                    let apparent = &body.inertia / &radius.powi(2);
                    let a = &(&line.pull + &line.drag) / &(&line.mass + &apparent);
                    line.friction = tidied(stage, &-(&apparent * &a))?;
                    if slide.friction.is_some() {
                        needs.push(tidied(stage, &(&limit - &line.friction))?);
                        needs.push(tidied(stage, &(&limit + &line.friction))?);
                    }
                } else {
                    line.friction = &Expr::from(-way) * &limit;
                }
                let moment = &arm * &line.friction;
                line.angular = tidied(stage, &(&moment / &body.inertia))?;
                line.round = Some(Round { arm, slip });
            }
        }
        line.acceleration = tidied(stage, &(&line.net() / &line.mass))?;
        Ok(line)
    }

    fn domains(&self) -> &'a Domains {
        &self.stage.scene.domains
    }

    fn name(&self) -> &'a str {
        &self.stage.scene.bodies[self.slide.body].name
    }

    fn refused(&self, why: &str, hint: &str) -> Refused {
        Refused::new(&self.stage.name, format!("`{}`: {why}", self.name()), hint)
    }

    fn inertia(&self) -> &'a Expr {
        &self.stage.scene.bodies[self.slide.body].inertia
    }

    /// Whether the lowest point slips.
    fn slips(&self) -> bool {
        self.slide.friction.is_some()
            && self
                .round
                .as_ref()
                .is_none_or(|r| is_zero(&r.slip, self.domains()) != Some(true))
    }

    /// Forces and accelerations, as they follow from each other.
    fn steps(&self) -> Vec<Step> {
        let mut out = Vec::new();
        if self.rubs() {
            let total = &self.friction + &self.drag;
            let why = "the friction along the line, its coefficient times the force that presses the body on the surface";
            out.push(Step::new("F", &total, &total, why));
        }
        if self.round.is_some() && !self.slips() {
            let apparent = self.inertia() / &self.radius().powi(2);
            let raw = &(&self.pull + &self.drag) / &(&self.mass + &apparent);
            let why = "the acceleration, with the inertia of turning added to the mass";
            out.push(Step::new("a", &raw, &self.acceleration, why));
        } else {
            let why = match self.strings.is_empty() {
                true => "the acceleration along the line",
                false => {
                    "the acceleration along the string, the forces along it divided by all that it sets in motion"
                }
            };
            let raw = match is_zero(&self.acceleration, self.domains()) {
                Some(true) => Expr::zero(),
                _ => &self.net() / &self.mass,
            };
            out.push(Step::new("a", &raw, &self.acceleration, why));
        }
        if let Some(round) = self.round.as_ref().filter(|_| self.slips()) {
            let raw = &(&round.arm * &self.friction) / self.inertia();
            let why = "the angular acceleration, by the moment of friction about the center";
            out.push(Step::new("alpha", &raw, &self.angular, why));
        }
        out
    }

    fn radius(&self) -> Expr {
        let body = &self.stage.scene.bodies[self.slide.body];
        body.shape.radius().cloned().unwrap_or_else(Expr::zero)
    }

    /// How the motion goes to its end.
    fn course(
        &self,
        steps: &mut Vec<Step>,
        assumptions: &mut Vec<Sentence>,
        needs: &mut Vec<Expr>,
    ) -> Result<Course, Refused> {
        let a = &self.acceleration;
        let still = is_zero(a, self.domains()) == Some(true);
        let (time, distance, speed) = match &self.slide.until {
            SlideEnd::Distance(s) => {
                let speed = match still {
                    true => self.speed.clone(),
                    false => self.arrival(s, assumptions)?,
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
                (time, s.clone(), speed)
            }
            SlideEnd::Time(t) => {
                let speed = self.tidied(&(&self.speed + &(a * t)))?;
                if self.rubs() && self.round.is_none() {
                    // Friction stops the body and does not draw it back.
                    needs.push(speed.clone());
                }
                (Some(t.clone()), self.distance(t)?, speed)
            }
            SlideEnd::Stops => {
                let slowing = -a;
                match sign(&slowing, self.domains()) {
                    Seen::Proved(Sign::Positive) => {}
                    Seen::Proved(_) | Seen::Negative => {
                        return Err(
                            self.refused("nothing slows it down", "add \"friction\": \"mu\"")
                        );
                    }
                    _ => assumptions.push(sentence![
                        Sentence::positive(&essential(&slowing, self.domains())),
                        ", so that `",
                        self.name(),
                        "` slows down"
                    ]),
                }
                let raw = &self.speed / &slowing;
                let time = self.tidied(&raw)?;
                let why = "the time until it stops";
                steps.push(Step::new("t", &raw, &time, why));
                (
                    Some(time),
                    self.tidied(&(&self.speed.powi(2) / &(&Expr::from(2) * &slowing)))?,
                    Expr::zero(),
                )
            }
            SlideEnd::Rolls => {
                let Some(round) = &self.round else {
                    return Err(self.refused("it does not roll", "a disk, ring or sphere does"));
                };
                let gain = &self.acceleration + &(&round.arm * &self.angular);
                let raw = -(&round.slip / &gain);
                let time = self.tidied(&raw)?;
                match sign(&time, self.domains()) {
                    Seen::Proved(s) if s.is_not_negative() => {}
                    Seen::Proved(_) | Seen::Negative => {
                        return Err(self.refused(
                            "its slip grows, so that it never rolls",
                            "the surface is too steep or too smooth",
                        ));
                    }
                    _ => assumptions.push(sentence![
                        at_least_zero(&time, self.domains()),
                        ", so that `",
                        self.name(),
                        "` comes to roll"
                    ]),
                }
                let why = "the time until its lowest point no longer slips";
                steps.push(Step::new("t", &raw, &time, why));
                let speed = self.tidied(&(&self.speed + &(a * &time)))?;
                let distance = self.distance(&time)?;
                (Some(time), distance, speed)
            }
        };
        let spin = match (&self.round, &time) {
            (Some(_), Some(t)) => self.tidied(&(&self.spin + &(&self.angular * t)))?,
            _ => self.spin.clone(),
        };
        if let Some(round) = self.round.as_ref().filter(|_| self.slips())
            && !matches!(self.slide.until, SlideEnd::Rolls)
        {
            let end = &speed + &(&round.arm * &spin);
            let way = proved(&round.slip, self.domains()).unwrap_or(1);
            needs.push(self.tidied(&(&Expr::from(way) * &end))?);
        }
        Ok(Course {
            time,
            distance,
            speed,
            spin,
        })
    }

    /// Velocity along the line after a distance.
    fn arrival(&self, s: &Expr, assumptions: &mut Vec<Sentence>) -> Result<Expr, Refused> {
        let gain = &(&Expr::from(2) * &self.acceleration) * s;
        let square = self.tidied(&(&self.speed.powi(2) + &gain))?;
        let seen = sign(&square, self.domains());
        if let Seen::Proved(Sign::Negative | Sign::NotPositive) = seen {
            let end = self.tidied(&half(&(&self.mass * &square)))?;
            return Err(Refused::new(
                &self.stage.name,
                format!(
                    "`{}` never gets there: its kinetic energy at the end would be {}, which is negative",
                    self.name(),
                    crate::formula::write_plain(&end)
                ),
                "end the stage earlier, or give it more energy",
            ));
        }
        assumptions.extend(arrival(self.stage, self.slide.body, &square, seen));
        self.tidied(&square.sqrt())
    }

    fn distance(&self, t: &Expr) -> Result<Expr, Refused> {
        self.tidied(&(&(&self.speed * t) + &half(&(&self.acceleration * &t.powi(2)))))
    }

    /// Time, distance, velocity and spin at the end.
    fn told(&self, course: &Course, steps: &mut Vec<Step>) {
        let Some(t) = &course.time else { return };
        let at = |start: &Expr, rate: &Expr| start + &(rate * t);
        if !matches!(self.slide.until, SlideEnd::Distance(_)) {
            let raw = match &self.slide.until {
                SlideEnd::Stops => -(&self.speed.powi(2) / &(&Expr::from(2) * &self.acceleration)),
                _ => &(&self.speed * t) + &half(&(&self.acceleration * &t.powi(2))),
            };
            steps.push(Step::new(
                "s",
                &raw,
                &course.distance,
                "the distance covered",
            ));
        }
        if !matches!(self.slide.until, SlideEnd::Stops) {
            let raw = match &self.slide.until {
                SlideEnd::Distance(s) => {
                    let gain = &(&Expr::from(2) * &self.acceleration) * s;
                    (&self.speed.powi(2) + &gain).sqrt()
                }
                _ => at(&self.speed, &self.acceleration),
            };
            let why = "the velocity along the line at the end";
            steps.push(Step::new("v", &raw, &course.speed, why));
        }
        if self.round.is_some() {
            let raw = match &self.round {
                // Rolling, the center is as fast as the rim.
                Some(round) if !self.slips() || matches!(self.slide.until, SlideEnd::Rolls) => {
                    -(&course.speed / &round.arm)
                }
                _ => at(&self.spin, &self.angular),
            };
            let why = "the angular velocity at the end, counterclockwise";
            steps.push(Step::new("omega", &raw, &course.spin, why));
        }
    }

    fn energy(&self, speed: &Expr, spin: &Expr) -> Result<Expr, Refused> {
        let mut twice = &self.mass * &speed.powi(2);
        if self.round.is_some() {
            twice = &twice + &(self.inertia() * &spin.powi(2));
        }
        self.tidied(&half(&twice))
    }

    /// All forces along the lines \[N\].
    fn net(&self) -> Expr {
        &(&self.pull + &self.friction) + &self.drag
    }

    /// The pulleys of all strings with their spins where the speed is 1.
    fn pulleys(&self) -> impl Iterator<Item = (usize, &Expr)> {
        let all = self.strings.iter();
        all.flat_map(|s| s.string.over.iter().copied().zip(&s.spins))
    }

    /// Whether friction does work.
    fn rubs(&self) -> bool {
        self.slips() || self.strings.iter().any(|s| s.string.friction.is_some())
    }

    fn energy_kept(&self) -> crate::story::Kept {
        let (conserved, why) = match () {
            () if self.rubs() => (false, "friction does work against the slip"),
            () if self.slide.force.is_some() => {
                (false, "the force does work, its size times the distance")
            }
            () if self.round.is_some() => (
                true,
                "the lowest point is at rest, so that friction there does no work, and weight has a potential",
            ),
            () if !self.strings.is_empty() => (
                true,
                "the string takes from one end what it gives to the other, and weight has a potential",
            ),
            () => (true, "the guide does no work, and weight has a potential"),
        };
        kept("energy", conserved, why)
    }

    /// Work of each force, along the way of the point where it acts.
    fn work(&self, course: &Course) -> Vec<(&'static str, Expr)> {
        let mut out = Vec::new();
        if let Some(g) = &self.slide.gravity {
            let lost = -&(&self.slide.along[1] * &course.distance);
            let own = &(&self.own * g) * &lost;
            let others = self.strings.iter().map(|s| &s.pull * &course.distance);
            let weight = Expr::sum([own].into_iter().chain(others));
            if !weight.is_zero() {
                out.push(("weight", weight));
            }
        }
        if let Some(force) = &self.slide.force {
            out.push(("the applied force", force * &course.distance));
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

    fn tidied(&self, e: &Expr) -> Result<Expr, Refused> {
        tidied(self.stage, e)
    }
}
