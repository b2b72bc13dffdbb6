//! Strings over pulleys from a body on a line: constraints that keep them taut, with their tensions as multipliers.
//!
//! Between a body and the rim of a pulley a string keeps its length: the body moves towards the pulley as fast as the rim
//! leads away from it. Directions and senses come from where bodies and pulleys are.

use super::{Movers, ROUNDING, Units};
use crate::expr::arithmetic::{cross, dot};
use crate::numeric::follow::mechanism::Constraint;
use crate::numeric::follow::{Course, Lost};
use crate::scene::{Slide, Strung};

/// What moves at the other end of a string, in numbers.
pub(super) struct End {
    /// Places of its bodies in the list of what moves.
    pub bodies: Vec<usize>,
    /// Place of the movable pulley on which they hang.
    under: Option<usize>,
    /// Unit vector of their line.
    pub along: [f64; 2],
    /// Their speed along it where the body on the line has the speed 1.
    pub ratio: f64,
    /// Coefficient of friction.
    pub rough: Option<f64>,
}

/// A pulley of a string.
pub(super) struct Pulley {
    /// Its place in the list of what moves.
    pub body: usize,
    /// Its spin where the body on the line has the speed 1 [1/m].
    pub spin: f64,
    pub is_light: bool,
    /// Whether its center moves.
    rides: bool,
}

/// All strings of a motion.
#[derive(Default)]
pub(super) struct Ropes {
    pub ends: Vec<End>,
    pub pulleys: Vec<Pulley>,
    /// How far the body on the line may go until an end that nears its pulley is beside it \[m\].
    pub room: Vec<f64>,
    /// Every free part of a string: places in the list of rates with their factors, lengths in meters.
    parts: Vec<Vec<(usize, f64)>>,
}

/// Where a string leaves a pulley towards a body.
struct Leg {
    /// From the body to the pulley, along the line of the body.
    pull: [f64; 2],
    /// Speed of the rim along that for a spin of 1 \[m\].
    rim: f64,
    /// How far the body has to go until it is beside the pulley \[m\]; negative where it moves away.
    ahead: f64,
}

impl Ropes {
    pub fn of(
        course: &Course<'_>,
        slide: &Slide,
        along: [f64; 2],
        movers: &Movers,
    ) -> Result<Ropes, Lost> {
        let mut out = Ropes::default();
        for string in &slide.strings {
            out.add(course, string, along, movers)?;
        }
        Ok(out)
    }

    fn add(
        &mut self,
        course: &Course<'_>,
        string: &Strung,
        along: [f64; 2],
        movers: &Movers,
    ) -> Result<(), Lost> {
        let place = |b: &usize| movers.bodies.iter().position(|m| m == b).unwrap_or(0);
        let bodies: Vec<usize> = string.to.iter().map(place).collect();
        let over: Vec<usize> = string.over.iter().map(place).collect();
        let under = string.under.as_ref().map(place);
        let there = course.pair(&string.along, "direction")?;
        let there = there.map(|c| c / there[0].hypot(there[1]));
        let (first, last) = (over[0], over[over.len() - 1]);
        let head = leg(course, movers, movers.arm(0), along, first)?;
        let (tail, reach) = match under {
            None => (
                leg(course, movers, movers.arm(bodies[0]), there, last)?,
                0.0,
            ),
            Some(pulley) => down(course, movers, pulley, there, last, |tail| {
                first != last || (head.rim + tail.rim).abs() <= ROUNDING * head.rim.abs()
            })?,
        };
        // The rim is at rest where the string comes from its fastening, so that the center has half the speed of the string.
        let ratio = if under.is_some() { 0.5 } else { 1.0 };
        let crossed = first == last && (head.rim + tail.rim).abs() > ROUNDING * head.rim.abs();
        if crossed || (head.ahead > 0.0) == (tail.ahead > 0.0) {
            return Err(course.contradiction("a string would get longer or slack"));
        }
        self.room.push(head.ahead.max(tail.ahead / ratio));
        self.parts.push(head.row(0, first));
        if first != last {
            let row = vec![(3 * first + 2, head.rim), (3 * last + 2, tail.rim)];
            self.parts.push(row);
        }
        let mut row = tail.row(under.unwrap_or(bodies[0]), last);
        row.extend(under.map(|p| (3 * p + 2, reach)));
        self.parts.push(row);
        if let Some(p) = under {
            let [x, y] = tail.pull;
            self.parts
                .push(vec![(3 * p, x), (3 * p + 1, y), (3 * p + 2, -reach)]);
        }
        let speed = dot(&head.pull, &along);
        let spins = [speed / head.rim, -speed / tail.rim];
        let riding = under.map(|p| (p, -speed / (2.0 * reach)));
        for (pulley, spin) in over.into_iter().zip(spins).chain(riding) {
            let [mass, inertia] = movers.inertias[pulley];
            self.pulleys.push(Pulley {
                body: pulley,
                spin,
                is_light: mass == 0.0 && inertia == 0.0,
                rides: under == Some(pulley),
            });
        }
        self.ends.push(End {
            bodies,
            under,
            along: there,
            ratio,
            rough: (string.friction.as_ref())
                .map(|mu| course.number(mu, "coefficient of friction"))
                .transpose()?,
        });
        Ok(())
    }

    /// Refuses what does not begin to move with the strings.
    pub fn fits(
        &self,
        course: &Course<'_>,
        movers: &Movers,
        speed: f64,
        largest: f64,
    ) -> Result<(), Lost> {
        for end in &self.ends {
            let speed = speed * end.ratio;
            for i in end.hung() {
                let [.., u, v, spin] = movers.states[i];
                let off = (u - speed * end.along[0]).hypot(v - speed * end.along[1]);
                let turns = movers.inertias[i][1] > 0.0 && spin != 0.0 && end.under != Some(i);
                if off > ROUNDING * largest || turns {
                    return Err(
                        course.contradiction("an end of a string does not begin to move with it")
                    );
                }
            }
        }
        for pulley in &self.pulleys {
            let [.., u, v, spin] = movers.states[pulley.body];
            let slips = (spin / pulley.spin - speed).abs() > ROUNDING * largest;
            let leaves = u.hypot(v) > ROUNDING * largest && !pulley.rides;
            if leaves || slips && !pulley.is_light {
                return Err(course.contradiction("a pulley does not begin to move with its string"));
            }
        }
        Ok(())
    }

    /// Masses and inertias that everything adds to the inertia of the body on the line, in kg.
    pub fn mass(&self, movers: &Movers) -> f64 {
        let ends = self.ends.iter();
        let pulleys = self.pulleys.iter();
        ends.map(|e| e.mass(movers) * e.ratio * e.ratio)
            .sum::<f64>()
            + pulleys
                .map(|p| movers.inertias[p.body][1] * p.spin * p.spin)
                .sum::<f64>()
    }

    /// Weights along the lines by gravity \[kg\], and the bound of the frictions there by gravity \[kg\].
    pub fn weights(&self, movers: &Movers) -> [f64; 2] {
        let mut out = [0.0; 2];
        for end in &self.ends {
            let mass = end.mass(movers) * end.ratio;
            out[0] -= mass * end.along[1];
            out[1] += mass * end.rough.unwrap_or(0.0);
        }
        out
    }

    /// What holds the ends on their lines: across the line first, in the order of the ends.
    pub fn guides(&self) -> impl Iterator<Item = Constraint> {
        let across = self.ends.iter().map(|e| across(e.bodies[0], e.along));
        let turns = self.ends.iter().map(|e| fixed(3 * e.bodies[0] + 2));
        across.chain(turns)
    }

    /// The bodies of one end move as one, and the pulleys stay where they are.
    pub fn joints(&self, movers: &Movers, units: &Units) -> Vec<Constraint> {
        let mut out = Vec::new();
        for end in &self.ends {
            for i in &end.bodies[1..] {
                out.extend(movers.welds(end.bodies[0], *i..*i + 1, units));
            }
            // A movable pulley turns and does not leave what hangs on its axle.
            out.extend(end.under.into_iter().flat_map(|p| {
                let same =
                    |k| Constraint::Sum(vec![(3 * p + k, 1.0), (3 * end.bodies[0] + k, -1.0)]);
                [same(0), same(1)]
            }));
        }
        let staying = self.pulleys.iter().filter(|p| !p.rides);
        let centers = staying.flat_map(|p| [3 * p.body, 3 * p.body + 1]);
        out.extend(centers.map(fixed));
        out
    }

    /// The tension at a moved body, of those of the parts: of the first of the bodies that move as one; `None` for none or
    /// several.
    pub fn pull(&self, i: usize, company: usize, tensions: &[f64]) -> Option<f64> {
        let end = self.ends.iter().find(|e| e.hung().any(|b| b == i));
        let first = match end {
            Some(end) => end.under.or(end.bodies.first().copied())?,
            None if i < company => 0,
            None => return None,
        };
        let at_it = |row: &Vec<(usize, f64)>| row.iter().any(|(k, _)| k / 3 == first);
        let mut mine = self
            .parts
            .iter()
            .zip(tensions)
            .filter(|(row, _)| at_it(row));
        let (_, tension) = mine.next()?;
        // Of the two parts at a movable pulley the first one leads to the body on the line.
        let is_one = mine.next().is_none() || end.is_some_and(|e| e.under.is_some());
        is_one.then_some(*tension)
    }

    /// The parts of the strings keep their lengths; their multipliers are the tensions.
    pub fn parts(&self, units: &Units) -> impl Iterator<Item = Constraint> {
        let length = units.length;
        self.parts.iter().map(move |row| {
            let scaled = |(k, factor): &(usize, f64)| match k % 3 {
                2 => (*k, factor / length),
                _ => (*k, *factor),
            };
            Constraint::Sum(row.iter().map(scaled).collect())
        })
    }
}

impl End {
    /// Places of all that moves along its line.
    pub fn hung(&self) -> impl Iterator<Item = usize> {
        self.bodies.iter().copied().chain(self.under)
    }

    fn mass(&self, movers: &Movers) -> f64 {
        self.hung().map(|i| movers.inertias[i][0]).sum()
    }
}

impl Leg {
    fn row(&self, body: usize, pulley: usize) -> Vec<(usize, f64)> {
        let [x, y] = self.pull;
        vec![
            (3 * body, x),
            (3 * body + 1, y),
            (3 * pulley + 2, -self.rim),
        ]
    }
}

/// Where a string leaves a pulley down to the rim of a movable one, with the speed of that rim along it for a spin of 1 \[m\].
fn down(
    course: &Course<'_>,
    movers: &Movers,
    under: usize,
    along: [f64; 2],
    pulley: usize,
    fits: impl Fn(&Leg) -> bool,
) -> Result<(Leg, f64), Lost> {
    let radius = radius(course, movers, under)?;
    let [x, y] = movers.arm(under);
    let sides = [radius, -radius].map(|r| [-r * along[1], r * along[0]]);
    for rim in sides {
        let tail = leg(course, movers, [x + rim[0], y + rim[1]], along, pulley);
        if let Some(tail) = tail.ok().filter(&fits) {
            let reach = cross(&rim, &tail.pull);
            return Ok((tail, reach));
        }
    }
    Err(loose(course))
}

fn loose(course: &Course<'_>) -> Lost {
    course.contradiction("a string does not touch the rim of its pulley")
}

fn radius(course: &Course<'_>, movers: &Movers, pulley: usize) -> Result<f64, Lost> {
    let shape = &course.stage.scene.bodies[movers.bodies[pulley]].shape;
    let radius = shape
        .radius()
        .ok_or_else(|| course.contradiction("a pulley has no radius"))?;
    course.number(radius, "radius")
}

fn leg(
    course: &Course<'_>,
    movers: &Movers,
    from: [f64; 2],
    along: [f64; 2],
    pulley: usize,
) -> Result<Leg, Lost> {
    let center = movers.arm(pulley);
    let arm = [from[0] - center[0], from[1] - center[1]];
    let ahead = -dot(&arm, &along);
    let pull = along.map(|c| c * ahead.signum());
    let rim = cross(&arm, &pull);
    let radius = radius(course, movers, pulley)?;
    if (rim.abs() - radius).abs() > ROUNDING * radius.max(arm[0].hypot(arm[1])) || radius <= 0.0 {
        return Err(loose(course));
    }
    Ok(Leg { pull, rim, ahead })
}

/// The center of a body does not leave the line with this direction.
pub(super) fn across(body: usize, along: [f64; 2]) -> Constraint {
    Constraint::Sum(vec![(3 * body, -along[1]), (3 * body + 1, along[0])])
}

/// A coordinate that stays.
pub(super) fn fixed(coordinate: usize) -> Constraint {
    Constraint::Sum(vec![(coordinate, 1.0)])
}
