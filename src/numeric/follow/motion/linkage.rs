//! Bodies with one freedom, whose places the file gives by a coordinate: Newton's and Euler's equations with the principle of
//! virtual velocities, integrated in time.
//!
//! What joints and guides exert does no work on a possible motion, so that Σ r'·(F − m a) − φ' I α = 0, where r' and φ' are
//! the changes of places and angles by the coordinate. These come with the places, which are evaluated as jets.

use std::cell::Cell;
use std::collections::BTreeSet;

use super::{Moved, Movers, NUDGE, REST, ROUNDING, all_open, arrived, sampled, stopped};
use crate::expr::{Expr, Point, Symbol};

use crate::numeric::follow::mechanism::{Goal, Mobile, Run};
use crate::numeric::follow::{Course, Lost, Passed, State, Why};
use crate::numeric::given::Freedom;
use crate::numeric::jet::Jet;
use crate::scene::Linkage;

/// The linkage in numbers; the coordinate counts from 0 at the beginning to 1 at the end.
struct Moving<'a> {
    course: &'a Course<'a>,
    linkage: &'a Linkage,
    /// What the places hold besides the coordinate.
    values: Point<Jet>,
    ends: [f64; 2],
    gravity: f64,
    /// Unit of time \[s\].
    time: f64,
    looks: Cell<u32>,
}

/// Places, and their first and second changes by the coordinate.
#[derive(Default)]
struct Shape {
    places: Vec<[f64; 3]>,
    first: Vec<[f64; 3]>,
    second: Vec<[f64; 3]>,
}

impl Moving<'_> {
    fn shape(&self, s: f64) -> Option<Shape> {
        let way = self.ends[1] - self.ends[0];
        let mut point = self.values.clone();
        let coordinate = Jet([self.ends[0] + way * s, way, 0.0]);
        let name = self.linkage.coordinate.clone();
        point.values.insert(name, coordinate);
        let mut out = Shape::default();
        for (b, place) in &self.linkage.places {
            let mut jets = [Jet::constant(0.0); 3];
            let is_particle = self.course.solids[*b].freedom == Freedom::Particle;
            let known = if is_particle { 2 } else { 3 };
            for (jet, e) in jets.iter_mut().zip(place).take(known) {
                *jet = e.evaluate(&point)?;
            }
            let [places, first, second] = [0, 1, 2].map(|k| jets.map(|Jet(all)| all[k]));
            let is_finite = places.iter().all(|v| v.is_finite());
            is_finite.then(|| out.places.push(places))?;
            out.first.push(first);
            out.second.push(second);
        }
        Some(out)
    }

    fn masses(&self, i: usize) -> [f64; 3] {
        let solid = &self.course.solids[self.linkage.places[i].0];
        [solid.mass, solid.mass, solid.inertia]
    }

    /// Second derivative of the coordinate, in the unit of time.
    fn acceleration(&self, s: f64, rate: f64) -> Option<f64> {
        let shape = self.shape(s)?;
        let (mut force, mut inertia) = (0.0, 0.0);
        for (i, (first, second)) in shape.first.iter().zip(&shape.second).enumerate() {
            let masses = self.masses(i);
            force -= masses[1] * self.gravity * self.time * self.time * first[1];
            for k in 0..3 {
                force -= masses[k] * first[k] * second[k] * rate * rate;
                inertia += masses[k] * first[k] * first[k];
            }
        }
        Some(force / inertia).filter(|a| a.is_finite())
    }

    /// The state of each body: place, angle, velocity and spin.
    fn states(&self, [s, rate]: [f64; 2]) -> Option<Vec<[f64; 6]>> {
        let shape = self.shape(s)?;
        let both = shape.places.iter().zip(&shape.first);
        let all = both.map(|(p, v)| {
            let [u, v, w] = v.map(|c| c * rate / self.time);
            [p[0], p[1], p[2], u, v, w]
        });
        Some(all.collect())
    }
}

impl Moving<'_> {
    /// Accelerations of all bodies in two states.
    fn accelerations(&self, states: [[f64; 2]; 2]) -> Option<Vec<(usize, [[f64; 3]; 2])>> {
        let bodies = self.linkage.places.iter().map(|(b, _)| *b);
        let mut out: Vec<_> = bodies.map(|b| (b, [[0.0; 3]; 2])).collect();
        for (k, [s, rate]) in states.into_iter().enumerate() {
            let (shape, second) = (self.shape(s)?, self.acceleration(s, rate)?);
            for (i, (_, ends)) in out.iter_mut().enumerate() {
                let grown =
                    |c: usize| shape.second[i][c] * rate * rate + shape.first[i][c] * second;
                ends[k] = [0, 1, 2].map(|c| grown(c) / (self.time * self.time));
            }
        }
        Some(out)
    }
}

impl Mobile for Moving<'_> {
    fn accelerations_of(&self, y: &[f64]) -> Option<Vec<f64>> {
        Some(vec![self.acceleration(y[0], y[1])?])
    }

    fn looks(&self) -> &Cell<u32> {
        &self.looks
    }
}

/// Motion of a linkage.
pub(in crate::numeric::follow) fn linkage(
    course: &Course<'_>,
    before: State,
    linkage: &Linkage,
) -> Result<Passed, Lost> {
    let bodies: Vec<usize> = linkage.places.iter().map(|(b, _)| *b).collect();
    let has_weight = linkage.gravity.is_some();
    let Ok(movers) = Movers::of(course, &bodies, &before, [0.0; 2]) else {
        let time = Err(course.open(Why::Needed));
        return Ok(all_open(course, before, &bodies, has_weight, time));
    };
    let ends = linkage.ends.each_ref();
    let [from, to] = ends.map(|end| course.number(end, "coordinate"));
    let mut moving = Moving {
        course,
        linkage,
        values: jets(course, linkage),
        ends: [from?, to?],
        gravity: course.optional(linkage.gravity.as_ref(), "gravity")?,
        time: 1.0,
        looks: Cell::new(0),
    };
    let lost = || course.out_of_reach("the places of the linkage have no value on its way");
    let first = moving.shape(0.0).ok_or_else(lost)?;
    let rate = begins(course, &moving, &first, &movers.states)?;
    let mut fastest = 0.0f64;
    for k in 0..=16 {
        let there = moving.acceleration(f64::from(k) / 16.0, 0.0);
        fastest = fastest.max(there.ok_or_else(lost)?.abs());
    }
    let unit = 1.0 / (fastest.sqrt() + rate.abs());
    if !unit.is_finite() {
        return Err(course.never("it is at rest, and nothing sets it going"));
    }
    moving.time = unit;
    let rate = rate * unit;
    let begins = moving.acceleration(0.0, 0.0).ok_or_else(lost)?;
    let rests = rate.abs() <= REST;
    if rate < -REST || rests && begins < -REST {
        return Err(course.contradiction("the coordinate begins to change the other way"));
    }
    let is_balanced = rests && begins.abs() <= REST;
    let start = [
        if is_balanced { NUDGE } else { 0.0 },
        if rests { 0.0 } else { rate },
    ];
    let mut goal = Goal {
        left: &|y| y[0] - 1.0,
        rate: &|y| y[1],
        never: &mut |_, turns_back| turns_back,
    };
    let run = moving.until(&start, &mut goal);
    let run: Run =
        run.map_err(|stop| stopped(course, stop, "it comes to rest before and turns back"))?;
    let time = match is_balanced {
        true => Err(course.open(Why::Push)),
        false => Ok(run.time * moving.time),
    };
    let mut ended = moving.states([1.0, run.end[1]]).ok_or_else(lost)?;
    // A body may have turned before that, and turns on from there.
    let turned = movers.states.iter().zip(&first.places);
    let turned: Vec<f64> = turned.map(|(state, place)| state[2] - place[2]).collect();
    let turning = ended.iter_mut().zip(&turned);
    turning.for_each(|(state, by)| state[2] += by);
    let after = arrived(course, &before, &bodies, ended);
    let accelerations = moving.accelerations([[0.0, start[1]], [1.0, run.end[1]]]);
    let accelerations = accelerations.ok_or_else(lost)?;
    let moved = Moved {
        bodies,
        accelerations,
        samples: sampled(&run, moving.time, |y| {
            let mut places = moving.shape(y[0])?.places;
            let turning = places.iter_mut().zip(&turned);
            turning.for_each(|(place, by)| place[2] += by);
            Some(places)
        }),
        ..Moved::default()
    };
    Ok(course.moved([before, after], time, has_weight, moved))
}

/// What the places hold besides the coordinate, and nothing else: they are looked at thousands of times.
fn jets(course: &Course<'_>, linkage: &Linkage) -> Point<Jet> {
    let places = linkage.places.iter().flat_map(|(_, place)| place);
    let held: BTreeSet<Symbol> = places.flat_map(Expr::symbols).collect();
    let mut values = Point::default();
    for (name, value) in &course.values.values {
        if held.contains(name) {
            values.values.insert(name.clone(), Jet::constant(*value));
        }
    }
    for (name, (divisor, unit)) in &course.values.directions {
        if held.contains(name) && *name != linkage.coordinate {
            let unit = unit.map(Jet::constant);
            values.directions.insert(name.clone(), (*divisor, unit));
        }
    }
    values
}

/// The rate of the coordinate at the beginning, in 1/s; every body is where it puts it and moves as it lets it.
fn begins(
    course: &Course<'_>,
    moving: &Moving<'_>,
    first: &Shape,
    known: &[[f64; 6]],
) -> Result<f64, Lost> {
    let (mut momentum, mut inertia) = (0.0, 0.0);
    let mut size = [0.0f64; 2];
    for (i, (state, rates)) in known.iter().zip(&first.first).enumerate() {
        let masses = moving.masses(i);
        for k in 0..3 {
            momentum += masses[k] * rates[k] * state[3 + k];
            inertia += masses[k] * rates[k] * rates[k];
        }
        for k in 0..2 {
            size[0] = size[0].max(rates[k].abs());
            size[1] = size[1].max(state[3 + k].abs());
        }
    }
    if inertia <= 0.0 {
        return Err(course.contradiction("nothing moves with the coordinate"));
    }
    let rate = momentum / inertia;
    for ((i, state), rates) in known.iter().enumerate().zip(&first.first) {
        let is_particle = moving.masses(i)[2] == 0.0;
        for (is, put) in state.iter().zip(&first.places[i]).take(2) {
            if (is - put).abs() > ROUNDING * size[0].max(is.abs()) {
                return Err(course.contradiction("a body is not where the coordinate puts it"));
            }
        }
        for k in 0..if is_particle { 2 } else { 3 } {
            let off = (state[3 + k] - rates[k] * rate).abs();
            let largest = size[1].max(state[3 + k].abs());
            if off > 1e-8 * largest {
                let why = "a body does not begin to move as the linkage lets it";
                return Err(course.contradiction(why));
            }
        }
    }
    Ok(rate)
}
