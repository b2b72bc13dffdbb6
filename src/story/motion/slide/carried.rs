//! A body that slides on another, which moves on a floor: friction between the two drives one and holds the other back. A
//! belt, whose velocity is prescribed, runs on whatever slides on it.
//!
//! In: a slide with a body below. Out: the motion at its end. All accelerations are constant, so that the slip, the velocity of
//! the upper body where it touches less that of the lower one, changes uniformly as well.

use super::super::supposed::Supposed;
use super::super::{half, kept, meanwhile, tidied};
use super::begins::fits_line;
use super::line::{directed, proved};
use super::{extents, stands};
use crate::answer::calc::is_zero;
use crate::expr::{Expr, dot};
use crate::formula::write_plain;
use crate::scene::{Body, Carrier, Slide, SlideEnd, Stage};
use crate::story::{Kept, Refused, StageTold, State, Step};

/// The upper body and the lower one, each with what moves along with it; velocities and forces along the line.
struct Pair<'a> {
    stage: &'a Stage,
    slide: &'a Slide,
    below: &'a Carrier,
    masses: [Expr; 2],
    /// Velocities at the beginning \[m/s\].
    speeds: [Expr; 2],
    /// 1 where the upper body slides along the line, −1 where it slides back over the lower one.
    sense: Expr,
    /// Friction on the lower body by the upper one \[N\].
    friction: Expr,
    /// Force of the rough floor on the lower body \[N\].
    floor: Expr,
    accelerations: [Expr; 2],
    /// Of a round body above.
    round: Option<Turning<'a>>,
    supposed: Supposed<'a>,
}

/// How a round body turns on the one below.
struct Turning<'a> {
    body: &'a Body,
    /// Radius, negative where the line leads to the left: the lowest point moves along the line at v + arm × ω \[m\].
    arm: Expr,
    /// Angular velocity at the beginning \[rad/s\].
    spin: Expr,
    /// Angular acceleration \[rad/s²\].
    rate: Expr,
}

pub(super) fn carried<'a>(
    stage: &'a Stage,
    before: State,
    (slide, below): (&'a Slide, &'a Carrier),
    supposed: Supposed<'a>,
) -> Result<StageTold, Refused> {
    let mut pair = Pair::of(stage, &before, (slide, below), supposed)?;
    let [slip, rate] = pair.slip()?;
    let mut steps = pair.steps();
    let (time, way) = match pair.is_together(&slip) {
        true => (Expr::zero(), Expr::zero()),
        false => {
            pair.slips(&slip, &rate)?;
            pair.course(&slip, &rate, &mut steps)?
        }
    };
    let speeds_after = [0, 1].map(|i| &pair.speeds[i] + &(&pair.accelerations[i] * &time));
    let slid = !time.is_zero();
    if slid {
        stands(stage, &before, slide, &mut pair.supposed)?;
    }
    let mut after = before.clone();
    let mut works = Vec::new();
    let mut ends = Vec::new();
    for (i, bodies) in [slide.company(), below.company()].iter().enumerate() {
        let speed = pair.tidied(&speeds_after[i])?;
        let gone = &(&pair.speeds[i] * &time) + &half(&(&pair.accelerations[i] * &time.powi(2)));
        let gone = pair.tidied(&gone)?;
        for (b, k) in bodies.iter().flat_map(|b| [(*b, 0), (*b, 1)]) {
            after.center[b][k] = &after.center[b][k] + &(&slide.along[k] * &gone);
            after.velocity[b][k] = pair.tidied(&(&speed * &slide.along[k]))?;
        }
        ends.push(speed);
        works.push(gone);
    }
    pair.goes_on(&ends[1])?;
    pair.stays_on([&before, &after])?;
    let mut spins = [Expr::zero(), Expr::zero()];
    if let Some(round) = &pair.round {
        let spin = pair.tidied(&(&round.spin + &(&round.rate * &time)))?;
        let turned = half(&(&(&round.spin + &spin) * &time));
        let b = slide.body;
        after.angle[b] = pair.tidied(&(&before.angle[b] + &turned))?;
        after.spin[b] = spin.clone();
        spins = [round.spin.clone(), spin];
    }
    pair.told(&ends, &spins[1], &mut steps);
    if !slid {
        // No force has changed anything.
        steps.retain(|step| step.letter == "v");
        steps.iter_mut().for_each(|step| step.by_time.clear());
    }
    let energy = |speeds: &[Expr], spin: &Expr| {
        let all = pair.masses.iter().zip(speeds);
        let turns = pair.round.iter().map(|r| &r.body.inertia * &spin.powi(2));
        let twice = all.map(|(m, v)| m * &v.powi(2)).chain(turns);
        pair.tidied(&half(&Expr::sum(twice)))
    };
    let energies = [energy(&pair.speeds, &spins[0])?, energy(&ends, &spins[1])?];
    let slipped = &(&slip * &time) + &half(&(&rate * &time.powi(2)));
    let work = pair.work(&works, &slipped);
    let is_counted = pair.ahead().is_some();
    let (momentum, rubs, energy_kept) = (pair.keeps_momentum(), pair.rubs(), pair.energy_kept());
    let Pair {
        mut supposed,
        accelerations,
        ..
    } = pair;
    supposed
        .words
        .extend(meanwhile::others(stage, &before, &mut after, Some(&time)));
    let mut out = StageTold::new(stage, before, after);
    out.kept = match slid {
        true => vec![energy_kept],
        false => vec![kept("energy", true, "nothing slips")],
    };
    if slid && momentum && rubs {
        let why = "friction between the two is the only force along the line";
        out.kept.push(kept("momentum", true, why));
    }
    out.energy = Some(energies);
    out.work = work;
    out.time = Some(time);
    out.way = Some(way).filter(|_| is_counted);
    out.steps = steps;
    let [own, _] = accelerations;
    out.acceleration = Some(own);
    supposed.told(&mut out);
    Ok(out)
}

impl<'a> Pair<'a> {
    fn of(
        stage: &'a Stage,
        before: &State,
        (slide, below): (&'a Slide, &'a Carrier),
        supposed: Supposed<'a>,
    ) -> Result<Pair<'a>, Refused> {
        let scene = &stage.scene;
        let sum = |e: Expr| tidied(stage, &e);
        let companies = [slide.company(), below.company()];
        let mut masses = Vec::new();
        let mut speeds = Vec::new();
        for bodies in &companies {
            let speed = sum(dot(&before.velocity[bodies[0]], &slide.along))?;
            fits_line(stage, before, slide, bodies, &slide.along, &speed)?;
            let all = bodies.iter().map(|b| scene.bodies[*b].mass.clone());
            masses.push(sum(Expr::sum(all))?);
            speeds.push(speed);
        }
        let [Ok(masses), Ok(speeds)] = [masses, speeds].map(<[Expr; 2]>::try_from) else {
            return Err(Refused::new(
                &stage.name,
                "two bodies slide on each other",
                "",
            ));
        };
        let zero = Expr::zero();
        let g = slide.gravity.as_ref().unwrap_or(&zero);
        // Without weight nothing presses, whichever side the surface is on.
        let right = slide.gravity.as_ref().map(|_| directed(stage, slide));
        let right = Expr::from(right.transpose()?.unwrap_or(1));
        let across = &right * &slide.along[0];
        let press = [&masses[0] * g, &(&masses[0] + &masses[1]) * g].map(|w| &w * &across);
        let pull = |i: usize, force: &Option<Expr>| {
            let weight = &(&masses[i] * g) * &slide.along[1];
            force.as_ref().unwrap_or(&zero) - &weight
        };
        let pulls = [pull(0, &slide.force), pull(1, &below.force)];
        let friction = sum(slide.friction.as_ref().unwrap_or(&zero) * &press[0])?;
        let limit = below.friction.as_ref().unwrap_or(&zero) * &press[1];
        let mut out = Pair {
            stage,
            slide,
            below,
            masses,
            speeds,
            sense: Expr::one(),
            friction: zero.clone(),
            floor: Expr::zero(),
            accelerations: [Expr::zero(), Expr::zero()],
            round: None,
            supposed,
        };
        let body = &scene.bodies[slide.body];
        if let Some(radius) = body.shape.radius().filter(|_| slide.with.is_empty()) {
            let arm = &right * radius;
            out.round = Some(Turning {
                body,
                rate: zero.clone(),
                arm,
                spin: before.spin[slide.body].clone(),
            });
        }
        if proved(&out.slip()?[0], &scene.domains) == Some(-1) {
            out.sense = Expr::from(-1);
        }
        out.friction = sum(&out.sense * &friction)?;
        if let Some(round) = &mut out.round {
            round.rate = sum(-(&(&round.arm * &out.friction) / &body.inertia))?;
        }
        let drive = sum(&out.friction + &pulls[1])?;
        if below.friction.is_some() {
            out.floor = sum(&Expr::from(-out.way(&drive, &limit)?) * &limit)?;
        }
        let forces = [&pulls[0] - &out.friction, &drive + &out.floor];
        for (i, force) in forces.iter().enumerate() {
            // Whatever the friction, a belt runs as it does.
            if i == 0 || !out.is_belt() {
                out.accelerations[i] = sum(force / &out.masses[i])?;
            }
        }
        Ok(out)
    }

    /// Whether the velocity of what is below is prescribed.
    fn is_belt(&self) -> bool {
        self.below.is_belt(&self.stage.scene)
    }

    fn name(&self, body: usize) -> &'a str {
        &self.stage.scene.bodies[body].name
    }

    fn refused(&self, body: usize, why: &str, hint: &str) -> Refused {
        let message = format!("`{}`: {why}", self.name(body));
        Refused::new(&self.stage.name, message, hint)
    }

    fn tidied(&self, e: &Expr) -> Result<Expr, Refused> {
        tidied(self.stage, e)
    }

    /// The way of the lower body on its rough floor, 1 or −1: as it moves, or as it is driven from rest.
    fn way(&mut self, drive: &Expr, limit: &Expr) -> Result<i64, Refused> {
        let domains = &self.stage.scene.domains;
        let undecided = |what: &str, e: &Expr| {
            let why = format!("which way it {what}, {}, is not decided", write_plain(e));
            self.refused(self.below.body, &why, "say it by `relations`")
        };
        let speed = &self.speeds[1];
        match proved(speed, domains) {
            None => return Err(undecided("moves over the floor", speed)),
            Some(0) => {}
            Some(way) => return Ok(way),
        }
        let way = match proved(drive, domains) {
            None => return Err(undecided("is driven", drive)),
            Some(way) => way,
        };
        let left = self.tidied(&(&(&Expr::from(way) * drive) - limit))?;
        let begins = format!("`{}` begins to move", self.name(self.below.body));
        let rests = self.refused(
            self.below.body,
            "the floor holds it, so that it stays where it is",
            "leave out `on`: the surface below a body is at rest unless it is said to move",
        );
        self.supposed.positive(&left, begins, || rests)?;
        Ok(way)
    }

    /// The upper body's velocity less that of the lower one, and how fast that changes.
    fn apart(&self) -> [Expr; 2] {
        [&self.speeds, &self.accelerations].map(|[upper, lower]| upper - lower)
    }

    /// The sense in which the center of the upper body sets out over the lower one, 1 or −1: a round body may go one way and
    /// slip the other. `None` where it is not decided.
    fn ahead(&self) -> Option<i64> {
        if self.round.is_none() {
            return proved(&self.sense, &self.stage.scene.domains);
        }
        let mut signs = self.apart().into_iter().map(|e| {
            let e = self.tidied(&e).ok()?;
            proved(&e, &self.stage.scene.domains)
        });
        match signs.next()? {
            Some(0) => signs.next()?,
            sign => sign,
        }
    }

    /// The same where they touch.
    fn slip(&self) -> Result<[Expr; 2], Refused> {
        let mut out = self.apart();
        if let Some(round) = &self.round {
            out[0] = &out[0] + &(&round.arm * &round.spin);
            out[1] = &out[1] + &(&round.arm * &round.rate);
        }
        let [slip, rate] = out;
        Ok([self.tidied(&slip)?, self.tidied(&rate)?])
    }

    /// Whether what came before has left them together already, and nothing makes one slide.
    fn is_together(&self, slip: &Expr) -> bool {
        self.stage.from.is_some()
            && matches!(self.slide.until, SlideEnd::Together)
            && self.is_undriven()
            && is_zero(slip, &self.stage.scene.domains) == Some(true)
    }

    /// The slip has the direction of the line, or begins to have it.
    fn slips(&mut self, slip: &Expr, rate: &Expr) -> Result<(), Refused> {
        let domains = &self.stage.scene.domains;
        let (upper, below) = (self.slide.body, self.name(self.below.body));
        let begins = is_zero(slip, domains) == Some(true);
        if begins && self.round.is_some() {
            let why = "it rolls on the body below already";
            let hint = "a ball on a body that moves is followed while it slips";
            return Err(self.refused(upper, why, hint));
        }
        if begins && self.is_undriven() {
            let why = "it moves with the body below already, and no force makes it slide";
            let hint = "what walks on it sets off by an impact, with a velocity `relative_to` the body below, and keeps it in a slide without friction";
            return Err(self.refused(upper, why, hint));
        }
        let slope = self.slide.force.is_none() && self.below.force.is_none();
        let (left, why, hint) = match begins {
            true if slope && !self.rubs() => (
                rate.clone(),
                format!("down a smooth slope `{below}` goes as fast as it does"),
                "a wedge that goes sideways over a floor is a `linkage` with its block: the coordinate is the way down the wedge, and the wedge stands where their common center of mass has not moved sideways",
            ),
            true => (
                rate.clone(),
                format!("friction is enough to take it along with `{below}`"),
                "where both move as one, name one of them in `with` of the other; a body that lags behind slides the other way",
            ),
            false => (
                &self.sense * slip,
                format!("it does not slide over `{below}`"),
                "",
            ),
        };
        let way = match self.sense.is_one() {
            true => "forward",
            false => "backward",
        };
        let refused = self.refused(upper, &why, hint);
        let does = format!("`{}` slides {way} on `{below}`", self.name(upper));
        self.supposed.positive(&left, does, || refused)
    }

    /// Time, and the way along the lower body.
    fn course(
        &mut self,
        slip: &Expr,
        rate: &Expr,
        steps: &mut Vec<Step>,
    ) -> Result<(Expr, Expr), Refused> {
        let domains = &self.stage.scene.domains;
        let upper = self.slide.body;
        // What follows is counted in the sense of the slip, and the way in the sense in which the center sets out.
        let forward = |e: &Expr| &self.sense * e;
        let [slip, rate] = [forward(slip), forward(rate)].map(|e| self.tidied(&e));
        let ahead = Expr::from(self.ahead().unwrap_or(1));
        let (slip, rate) = (&slip?, &rate?);
        let [apart, parts] = self.apart().map(|e| &ahead * &e);
        let far = |t: &Expr| &(&apart * t) + &half(&(&parts * &t.powi(2)));
        let rolls = matches!(self.slide.until, SlideEnd::Rolls);
        let early = match self.round {
            Some(_) => "it begins to roll before",
            None => "it comes to move together with the body below before",
        };
        let (raw, way) = match &self.slide.until {
            SlideEnd::Time(t) => {
                let end = self.tidied(&(slip + &(rate * t)))?;
                self.needs(&end, early, "slides to the end of the stage", upper)?;
                let step = Step::new("s", &far(t), &self.tidied(&far(t))?, WAY);
                let way = step.value.clone();
                steps.push(step);
                return Ok((t.clone(), way));
            }
            SlideEnd::Distance(s) => {
                let [apart, parts] = [&apart, &parts].map(|e| self.tidied(e));
                let (apart, parts) = (apart?, parts?);
                let square = &apart.powi(2) + &(&(&Expr::from(2) * &parts) * s);
                let square = self.tidied(&square)?;
                self.needs(&square, early, "slides so far", upper)?;
                let time = match is_zero(&parts, domains) {
                    Some(true) => s / &apart,
                    _ => &(&self.tidied(&square.sqrt())? - &apart) / &parts,
                };
                if self.round.is_some() {
                    let end = self.tidied(&(slip + &(rate * &time)))?;
                    self.needs(&end, early, "slides to the end of the stage", upper)?;
                }
                (time, Some(s.clone()))
            }
            _ => {
                let slows = -rate;
                let comes = match rolls {
                    true => "to roll",
                    false => "to move together with the body below",
                };
                let hint = match rolls {
                    true => "end the stage after a time `for`",
                    false => {
                        "end the stage after a `distance` along that body, or after a time `for`"
                    }
                };
                let never = self.refused(upper, &format!("it never comes {comes}"), hint);
                let comes = format!("`{}` comes {comes}", self.name(upper));
                self.supposed.positive(&slows, comes, || never)?;
                (slip / &slows, None)
            }
        };
        let time = self.tidied(&raw)?;
        let why = match &way {
            Some(_) => "the time it takes",
            None if rolls => "the time until it rolls",
            None => "the time until both move together",
        };
        steps.push(Step::new("t", &raw, &time, why));
        if let Some(way) = way {
            return Ok((time, way));
        }
        // Together, the slip has gone down to nothing.
        let (raw, by_time) = match rolls {
            true => (far(&time), vec![Expr::zero(), apart.clone(), half(&parts)]),
            false => (half(&(slip * &time)), vec![Expr::zero(), half(slip)]),
        };
        let mut step = Step::new("s", &raw, &self.tidied(&far(&time))?, WAY);
        step.by_time = by_time;
        let way = step.value.clone();
        steps.push(step);
        Ok((time, way))
    }

    /// What must not be negative for the motion to go on to its end.
    fn needs(&mut self, e: &Expr, never: &str, does: &str, body: usize) -> Result<(), Refused> {
        let refused = self.refused(body, never, "end the stage earlier");
        let does = format!("`{}` {does}", self.name(body));
        self.supposed.not_negative(e, does, || refused)
    }

    /// The center of the upper body is over the lower one at the beginning and at the end, where that is a box or a rod along
    /// the line.
    fn stays_on(&mut self, ends: [&State; 2]) -> Result<(), Refused> {
        let (upper, lower) = (self.slide.body, self.below.body);
        let Some([long, _]) = extents(self.stage, ends[0], lower, &self.slide.along)? else {
            return Ok(());
        };
        let all = [upper, lower].into_iter().flat_map(|b| &ends[0].center[b]);
        if ends[0].why_open(all).is_some() {
            return Ok(());
        }
        let below = self.name(lower);
        let words = [
            (
                format!("is on `{below}`"),
                format!("it is not on `{below}`"),
            ),
            (
                format!("stays on `{below}`"),
                format!("it slides off `{below}`"),
            ),
        ];
        for (state, (stays, off)) in ends.into_iter().zip(&words) {
            let [from, to] = [lower, upper].map(|b| dot(&state.center[b], &self.slide.along));
            for way in [1, -1] {
                let room = half(&long) - Expr::from(way) * (&to - &from);
                self.needs(&self.tidied(&room)?, off, stays, upper)?;
            }
        }
        Ok(())
    }

    /// On a rough floor the lower body may stop, and stays then; from rest it only gets faster.
    fn goes_on(&mut self, end: &Expr) -> Result<(), Refused> {
        let domains = &self.stage.scene.domains;
        let from_rest = is_zero(&self.speeds[1], domains) == Some(true);
        if from_rest || is_zero(&self.floor, domains) == Some(true) {
            return Ok(());
        }
        let against = proved(&self.floor, domains).unwrap_or(-1);
        let forward = self.tidied(&(&Expr::from(-against) * end))?;
        let never = "the floor stops it before the stage ends";
        self.needs(&forward, never, "does not stop before", self.below.body)
    }

    /// Friction, by its size, and accelerations, as they follow from each other.
    fn steps(&self) -> Vec<Step> {
        const OWN: &str = "the acceleration along the line";
        let [m, below] = &self.masses;
        let [a, b] = &self.accelerations;
        if self.keeps_momentum() && !self.rubs() {
            return vec![Step::by_newton("a", [&Expr::zero(), m], a, OWN)];
        }
        let tidy = |e: Expr| self.tidied(&e).unwrap_or(e);
        let size = tidy(&self.sense * &self.friction);
        let friction = &(&self.sense * &size);
        let own = tidy(&(m * a) + &self.friction);
        let rest = tidy(&(below * b) - &(&self.friction + &self.floor));
        let driven = &(friction + &rest) + &self.floor;
        let mut out = vec![
            Step::new("F", &size, &size, "the friction between the two"),
            Step::by_newton("a", [&(&own - friction), m], a, OWN),
        ];
        if !self.is_belt() {
            let why = "that of the body below";
            out.push(Step::by_newton("A", [&driven, below], b, why));
        }
        if let Some(round) = &self.round {
            let moment = -(&round.arm * friction);
            let why = "the angular acceleration, by the moment of friction about the center";
            out.push(Step::by_newton(
                "alpha",
                [&moment, &round.body.inertia],
                &round.rate,
                why,
            ));
        }
        out
    }

    /// The velocities and the spin at the end.
    fn told(&self, ends: &[Expr], spin: &Expr, steps: &mut Vec<Step>) {
        let is_known = matches!(self.slide.until, SlideEnd::Together) || self.is_belt();
        let of = [
            ("v", "the velocity along the line at the end"),
            ("V", "that of the body below at the end"),
        ];
        for (i, (letter, why)) in of.into_iter().enumerate() {
            if i == 1 && is_known {
                break;
            }
            let mut step = Step::new(letter, &ends[i], &ends[i], why);
            if !matches!(self.slide.until, SlideEnd::Time(_)) {
                step.by_time = vec![self.speeds[i].clone(), self.accelerations[i].clone()];
            }
            steps.push(step);
        }
        if let Some(round) = &self.round {
            let why = "the angular velocity at the end, counterclockwise";
            let mut step = Step::new("omega", spin, spin, why);
            step.by_time = vec![round.spin.clone(), round.rate.clone()];
            steps.push(step);
        }
    }

    /// Work of each force, along the way of the body on which it acts, and of friction along the slip.
    fn work(&self, gone: &[Expr], slipped: &Expr) -> Vec<(&'static str, Expr)> {
        let mut out = Vec::new();
        if let Some(g) = &self.slide.gravity {
            let lost = self.masses.iter().zip(gone);
            let lost = lost.map(|(m, s)| &(&(m * g) * &self.slide.along[1]) * s);
            out.push(("weight", -Expr::sum(lost)));
        }
        let forces = [&self.slide.force, &self.below.force].into_iter().zip(gone);
        out.push((
            "force",
            Expr::sum(forces.filter_map(|(f, s)| Some(f.as_ref()? * s))),
        ));
        out.retain(|(_, w)| !w.is_zero());
        if !self.rubs() {
            return out;
        }
        // A belt takes its energy from what drives it.
        let rubbed = match self.is_belt() {
            true => -(&self.friction * &gone[0]),
            false => &(&self.floor * &gone[1]) - &(&self.friction * slipped),
        };
        out.push(("friction", rubbed));
        out
    }

    /// Whether friction acts, between the two or on the floor.
    fn rubs(&self) -> bool {
        let domains = &self.stage.scene.domains;
        let is_none = |e: &Expr| is_zero(e, domains) == Some(true);
        !is_none(&self.friction) || !is_none(&self.floor)
    }

    fn energy_kept(&self) -> Kept {
        let (conserved, why) = match () {
            () if self.is_belt() => (false, "what drives the belt and friction do work"),
            () if self.rubs() => (false, "friction does work against the slip"),
            () if self.slide.force.is_some() || self.below.force.is_some() => (
                false,
                "the force does work, its component along the line times the distance",
            ),
            () if self.is_undriven() => (true, "no force acts along the line"),
            () => (true, "the surfaces are smooth, and weight has a potential"),
        };
        kept("energy", conserved, why)
    }

    /// Whether nothing from outside acts along the line.
    fn keeps_momentum(&self) -> bool {
        !self.is_belt()
            && self.is_undriven()
            && is_zero(&self.floor, &self.stage.scene.domains) == Some(true)
    }

    /// Whether neither weight nor another force drives one of them along the line.
    fn is_undriven(&self) -> bool {
        let forces = self.slide.force.is_some() || self.below.force.is_some();
        let domains = &self.stage.scene.domains;
        let is_level = || is_zero(&self.slide.along[1], domains) == Some(true);
        !forces && (self.slide.gravity.is_none() || is_level())
    }
}

const WAY: &str = "the distance along the body below";
