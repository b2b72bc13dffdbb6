//! Motion of a body that slides on another, which moves on a floor.
//!
//! What presses the two on each other, and the lower one on the floor, are the multipliers of the constraints that keep them
//! there. Friction of that size times its coefficient acts on either body against its motion over the other, and on the lower
//! one against its motion over the floor, for as long as these last. A belt is a lower body whose velocity is held.

use super::extents::{extents, stands};
use super::rub;
use super::strings::{across, fixed};
use super::{Driven, Moved, Movers, REST, ROUNDING, Units, stopped, unsolved};
use crate::expr::arithmetic::{cross, dot};
use crate::numeric::follow::mechanism::{Constraint, Goal, Mechanism, Mobile, Run, Stop};
use crate::numeric::follow::{Course, Lost, Passed, State};
use crate::numeric::given::Freedom;
use crate::scene::{Carrier, Slide, SlideEnd};

const PLAIN: Units = Units {
    length: 1.0,
    time: 1.0,
    mass: 1.0,
};

/// The two bodies with their companies, in numbers.
struct Pair {
    movers: Movers,
    along: [f64; 2],
    gravity: f64,
    /// Coefficients of friction between the two, and of the floor.
    rough: [f64; 2],
    /// Forces along the line on the upper body and on the lower one.
    forces: [f64; 2],
    /// How many bodies move with the upper one, itself among them: the place of the lower one in the list.
    company: usize,
    /// From the center to the point of contact of a round body above \[m\].
    contact: Option<[f64; 2]>,
    /// Whether the velocity of the lower body is held.
    is_belt: bool,
    /// 1 where the upper body slides along the line over the lower one, −1 where it slides back.
    sense: f64,
    /// The same of the center, as it sets out: a round body may go one way and slip the other.
    ahead: f64,
}

impl Pair {
    fn of(
        course: &Course<'_>,
        slide: &Slide,
        below: &Carrier,
        mut movers: Movers,
    ) -> Result<Pair, Lost> {
        let rough = |mu: &Option<_>| match mu {
            Some(mu) => course.number(mu, "coefficient of friction"),
            None => Ok(0.0),
        };
        let force = |f: &Option<_>| course.optional(f.as_ref(), "force");
        let along = course.pair(&slide.along, "direction")?;
        let contact = match course.stage.scene.bodies[slide.body].shape.radius() {
            Some(radius) if slide.with.is_empty() => {
                let radius = course.number(radius, "radius")?;
                // The body below is below.
                Some([along[1], -along[0]].map(|d| d * radius * along[0].signum()))
            }
            _ => None,
        };
        let company = slide.company().len();
        let is_belt = course.solids[below.body].freedom == Freedom::Fixed;
        if is_belt {
            // Its velocity is held, whatever its mass.
            movers.inertias[company] = [movers.inertias[0][0], 1.0];
        }
        let mut out = Pair {
            movers,
            along,
            gravity: course.optional(slide.gravity.as_ref(), "gravity")?,
            rough: [rough(&slide.friction)?, rough(&below.friction)?],
            forces: [force(&slide.force)?, force(&below.force)?],
            company,
            contact,
            is_belt,
            sense: 1.0,
            ahead: 1.0,
        };
        let start = out.movers.start(&PLAIN);
        let fastest = out.speeds(&start).map(f64::abs).into_iter().sum::<f64>();
        if out.slip(&PLAIN, &start) < -ROUNDING * fastest {
            out.sense = -1.0;
        }
        let [upper, lower] = out.speeds(&start);
        out.ahead = match (out.contact, upper - lower) {
            (None, _) => out.sense,
            // Friction drives the center against the slip.
            (Some(_), apart) if apart.abs() <= ROUNDING * fastest => -out.sense,
            (Some(_), apart) => apart.signum(),
        };
        Ok(out)
    }

    /// The bodies on each other and on the floor, without friction.
    fn smooth(&self, units: &Units) -> Mechanism {
        let (movers, first) = (&self.movers, 3 * self.company);
        let [x, y] = self.along;
        let pressed = vec![(0, -y), (1, x), (first, y), (first + 1, -x)];
        let mut held = vec![
            Constraint::Sum(pressed),
            across(self.company, self.along),
            fixed(first + 2),
        ];
        if self.contact.is_none() {
            held.push(fixed(2));
        }
        if self.is_belt {
            held.push(Constraint::Sum(vec![(first, x), (first + 1, y)]));
        }
        held.extend(movers.welds(0, 0..self.company, units));
        held.extend(movers.welds(self.company, self.company..movers.bodies.len(), units));
        let mut out = movers.mechanism(units, [0.0, -self.gravity], held, |_| false);
        for (body, force) in [0, self.company].into_iter().zip(self.forces) {
            rub(&mut out, body, self.along, [0.0; 2], force / units.force());
        }
        out
    }

    /// Velocities of both along the line, in the units of a state.
    fn speeds(&self, y: &[f64]) -> [f64; 2] {
        let n = y.len() / 2;
        [0, self.company].map(|i| dot(&[y[n + 3 * i], y[n + 3 * i + 1]], &self.along))
    }

    fn slip(&self, units: &Units, y: &[f64]) -> f64 {
        let [upper, lower] = self.speeds(y);
        let [x, z] = self.arm(units);
        upper - lower + dot(&[-z, x], &self.along) * y[y.len() / 2 + 2]
    }

    /// From the center of the upper body to where it touches, in the units.
    fn arm(&self, units: &Units) -> [f64; 2] {
        self.contact.unwrap_or([0.0; 2]).map(|c| c / units.length)
    }

    /// The same with friction, and the way in which the lower body moves over its floor.
    fn rough(&self, course: &Course<'_>, units: &Units) -> Result<(Mechanism, f64), Lost> {
        let mut mechanism = self.smooth(units);
        let start = self.movers.start(units);
        let broken = || unsolved(course);
        let (_, held) = mechanism.accelerations(&start).ok_or_else(broken)?;
        let rubs = self.sense * self.rough[0] * held[0].abs();
        rub(&mut mechanism, 0, self.along, self.arm(units), -rubs);
        rub(&mut mechanism, self.company, self.along, [0.0; 2], rubs);
        let (rates, held) = mechanism.accelerations(&start).ok_or_else(broken)?;
        let [upper, lower] = self.speeds(&start);
        let begins = |i: usize| dot(&[rates[3 * i], rates[3 * i + 1]], &self.along);
        let is_at_rest = lower.abs() <= ROUNDING * (upper.abs() + lower.abs());
        let way = if is_at_rest {
            begins(self.company)
        } else {
            lower
        }
        .signum();
        let limit = self.rough[1] * held[1].abs();
        rub(
            &mut mechanism,
            self.company,
            self.along,
            [0.0; 2],
            -way * limit,
        );
        let (rates, _) = mechanism.accelerations(&start).ok_or_else(broken)?;
        let goes = way
            * dot(
                &rates[3 * self.company..][..2]
                    .try_into()
                    .unwrap_or([0.0; 2]),
                &self.along,
            );
        if self.rough[1] > 0.0 && is_at_rest && goes <= 0.0 {
            return Err(course.contradiction("the floor holds the body below"));
        }
        Ok((mechanism, way))
    }

    /// The motion until the slide ends; `time` is how long it lasts where that is given.
    fn to_the_end(
        &self,
        course: &Course<'_>,
        slide: &Slide,
        mechanism: &Mechanism,
        units: &Units,
        time: f64,
    ) -> Result<Result<Run, Stop>, Lost> {
        let start = self.movers.start(units);
        let slips = |y: &[f64]| self.sense * self.slip(units, y);
        Ok(match &slide.until {
            SlideEnd::Time(_) => mechanism.lasting(&start, time / units.time),
            SlideEnd::Distance(s) => {
                let far = course.number(s, "distance")? / units.length;
                let apart = |y: &[f64]| {
                    let i = 3 * self.company;
                    self.ahead * dot(&[y[0] - y[i], y[1] - y[i + 1]], &self.along)
                };
                let from = apart(&start);
                let gains = |y: &[f64]| {
                    let [upper, lower] = self.speeds(y);
                    self.ahead * (upper - lower)
                };
                let mut goal = Goal {
                    left: &|y| apart(y) - from - far,
                    rate: &gains,
                    never: &mut |y, _| slips(y) <= 0.0,
                };
                mechanism.until(&start, &mut goal)
            }
            _ => mechanism.until_grown(&start, &|y| -slips(y)),
        })
    }
}

/// Motion on a body that moves too.
pub(super) fn carried(
    course: &Course<'_>,
    before: State,
    (slide, below): (&Slide, &Carrier),
    movers: Movers,
) -> Result<Passed, Lost> {
    let pair = Pair::of(course, slide, below, movers)?;
    let (movers, along) = (&pair.movers, pair.along);
    if movers.inertias.iter().any(|[m, _]| *m <= 0.0) {
        return Err(course.contradiction("what slides has no mass"));
    }
    fits(course, &pair)?;
    let start = movers.start(&PLAIN);
    let fastest = pair.speeds(&start).map(f64::abs).into_iter().sum::<f64>();
    let (mechanism, way) = pair.rough(course, &PLAIN)?;
    let slip = pair.sense * pair.slip(&PLAIN, &start);
    let (rates, _) = (mechanism.accelerations(&start)).ok_or_else(|| unsolved(course))?;
    let grows = |i: usize| dot(&[rates[3 * i], rates[3 * i + 1]], &pair.along);
    let [x, y] = pair.arm(&PLAIN);
    let rate = pair.sense * (grows(0) - grows(pair.company) + dot(&[-y, x], &along) * rates[2]);
    let is_still = slip <= ROUNDING * fastest && rate <= 0.0;
    let is_driven = pair.forces != [0.0; 2] || along[1] != 0.0;
    let is_together = is_still && !is_driven && matches!(slide.until, SlideEnd::Together);
    if is_still && !is_together {
        return Err(course.contradiction("it does not slide over the body below"));
    }
    if !is_together {
        stands(course, slide, &before)?;
    }
    let time = match &slide.until {
        SlideEnd::Distance(s) => {
            let s = course.number(s, "distance")?;
            s / (slip + (rate.abs() * s).sqrt())
        }
        SlideEnd::Time(t) => course.number(t, "time")?,
        _ if is_together => 0.0,
        _ if rate >= 0.0 => return Err(course.never("it never comes to move with it")),
        _ => slip / -rate,
    };
    if !(time > 0.0 && time.is_finite() || is_together) {
        return Err(course.contradiction("the motion takes no time"));
    }
    let largest = grows(0).abs().max(grows(pair.company).abs());
    let units = match is_together {
        true => PLAIN,
        false => Units {
            length: (fastest + largest * time) * time,
            time: time / 4.0,
            mass: movers.inertias.iter().map(|i| i[0]).sum(),
        },
    };
    let (mechanism, _) = pair.rough(course, &units)?;
    let never = "it comes to move with the body below before";
    let run = match is_together {
        true => mechanism.lasting(&start, 0.0),
        false => pair.to_the_end(course, slide, &mechanism, &units, time)?,
    };
    let run = run.map_err(|stop| stopped(course, stop, never))?;
    let tiny = ROUNDING * (fastest + largest * time) / units.speed();
    if pair.sense * pair.slip(&units, &run.end) < -tiny {
        return Err(course.never(never));
    }
    if pair.rough[1] > 0.0 && way * pair.speeds(&run.end)[1] < -tiny {
        return Err(course.never(
            "the floor stops the body below first, and what it does then is another stage",
        ));
    }
    let (after, samples) = movers.ended(course, &units, &run, &before);
    for state in [&before, &after] {
        if overhangs(course, slide, below, state)? {
            return Err(course.never("it slides off the body below"));
        }
    }
    let time = Ok(run.time * units.time);
    let driven = movers.bodies.iter().enumerate().map(|(i, body)| Driven {
        body: *body,
        accelerations: [grows(if i < pair.company { 0 } else { pair.company }); 2],
        tension: None,
    });
    let moved = Moved {
        bodies: movers.bodies.clone(),
        slides_back: pair.ahead < 0.0,
        driven: driven.collect(),
        samples,
        ..Moved::default()
    };
    Ok(course.moved([before, after], time, true, moved))
}

/// Whether the center of the upper body is past an end of the lower one, a box or a rod with a side along the line.
fn overhangs(
    course: &Course<'_>,
    slide: &Slide,
    below: &Carrier,
    state: &State,
) -> Result<bool, Lost> {
    let along = course.pair(&slide.along, "direction")?;
    let [upper, lower] = [slide.body, below.body].map(|b| &state.bodies[b]);
    let ([Ok(x), Ok(y)], [Ok(u), Ok(v)], Ok(angle)) = (&upper.center, &lower.center, &lower.angle)
    else {
        return Ok(false);
    };
    let Some([long, _]) = extents(course, below.body, *angle, along)? else {
        return Ok(false);
    };
    Ok(dot(&[x - u, y - v], &along).abs() > long / 2.0 * (1.0 + ROUNDING))
}

/// Both begin to move along the line without turning, each with its company.
fn fits(course: &Course<'_>, pair: &Pair) -> Result<(), Lost> {
    let states = &pair.movers.states;
    let fastest = states.iter().map(|s| s[3].hypot(s[4]));
    let fastest = fastest.fold(0.0, f64::max);
    for (i, [.., u, v, spin]) in states.iter().enumerate() {
        let lead = states[if i < pair.company { 0 } else { pair.company }];
        let off = cross(&pair.along, &[*u, *v]).abs();
        let apart = (u - lead[3]).abs().max((v - lead[4]).abs());
        let held = i > 0 || pair.contact.is_none();
        let turns = held && pair.movers.inertias[i][1] > 0.0 && spin.abs() > REST;
        if off.max(apart) > ROUNDING * fastest || turns {
            return Err(
                course.contradiction("it does not begin to move along the line without turning")
            );
        }
    }
    Ok(())
}
