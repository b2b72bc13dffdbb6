//! What an impact did: the state after that all fitting sets agree on, the impulses, and what cannot be.

use super::super::{Component, Course, State, Why};
use super::{Breach, Impact, Impulse, Opening, ROUNDING, SAME, Table, Tried, velocity_at};
use crate::expr::arithmetic::dot;
use crate::numeric::given::{Freedom, GivenImpulse, GivenLaw};
use crate::numeric::system::Unknown;

impl Table<'_> {
    /// The state after: what all sets that fit agree on.
    pub(super) fn after(&self, course: &Course<'_>, fitting: &[Tried], before: &State) -> State {
        let mut after = before.clone();
        let speed = self.fastest(fitting);
        after.fastest = speed;
        let spin = if self.arm > 0.0 {
            speed / self.arm
        } else {
            0.0
        };
        for (b, body) in after.bodies.iter_mut().enumerate() {
            if !self.touched[b] {
                continue;
            }
            body.has_begun = true;
            let freedom = course.solids[b].freedom;
            if freedom == Freedom::Fixed {
                continue;
            }
            let component = |unknown, size| match self.unplaced[b] {
                true => Err(course.open(Why::Needed)),
                false => self.agreed(course, fitting, unknown, size),
            };
            body.velocity = [
                component(Unknown::Velocity(b, 0), speed),
                component(Unknown::Velocity(b, 1), speed),
            ];
            if freedom == Freedom::Rigid {
                body.spin = component(Unknown::Spin(b), spin);
            }
        }
        let contacts = course.stage.scene.contacts.iter();
        let sticking = contacts.filter(|c| c.law == crate::scene::ContactLaw::Sticking);
        let joints = sticking.map(|c| (c.bodies, &c.at));
        let hinges = course.stage.scene.hinges.iter();
        let joints = joints.chain(hinges.map(|h| (h.bodies, &h.at)));
        let is_free = |b: &usize| course.solids[*b].freedom != Freedom::Fixed;
        // What the impact does not touch stays joined.
        let untouched = |pair: &[usize; 2]| pair.iter().all(|b| !self.touched[*b]);
        after.joined.retain(untouched);
        // Two joints at one place are one.
        let mut joined = Vec::new();
        for (bodies, at) in joints.filter(|(bodies, _)| bodies.iter().all(is_free)) {
            let joint = (bodies, course.pair(at, "position").ok());
            if !joined.contains(&joint) {
                joined.push(joint);
            }
        }
        after
            .joined
            .extend(joined.iter().map(|(bodies, _)| *bodies));
        after
    }

    /// The value of an unknown where all sets that fit have one and the same. Values that differ by less than a share of
    /// `size` count as the same.
    fn agreed(
        &self,
        course: &Course<'_>,
        fitting: &[Tried],
        unknown: Unknown,
        size: f64,
    ) -> Component {
        let mut value: Option<f64> = None;
        for tried in fitting {
            let column = tried.column(unknown);
            // A support that does not act has no impulse.
            let found = match column {
                None => 0.0,
                Some(c) if tried.found.is_unique(c) => tried.found.values[c],
                Some(_) if self.loose.is_empty() => return Err(course.open(Why::Laws)),
                Some(_) => return Err(course.open(Why::Needed)),
            };
            let size = size.max(value.unwrap_or(0.0).abs());
            match value {
                Some(v) if (v - found).abs() > SAME * size.max(found.abs()) => {
                    return Err(course.open(Why::Supports));
                }
                _ => value = value.or(Some(found)),
            }
        }
        value.ok_or_else(|| course.open(Why::Laws))
    }

    /// Impulses, openings, and what cannot be.
    pub(super) fn told(
        &self,
        course: &Course<'_>,
        fitting: &[Tried],
        before: &State,
        after: &State,
    ) -> Impact {
        let scene = &course.stage.scene;
        let largest = fitting.iter().flat_map(Tried::impulses);
        let largest = largest.map(f64::abs).fold(self.momentum, f64::max);
        let agreed = |unknown| self.agreed(course, fitting, unknown, largest);
        let needed = || [0, 1].map(|_| Err(course.open(Why::Needed)));
        let along = |normal: &[f64; 2], p: Component| match p {
            Ok(p) => normal.map(|n| Ok(n * p)),
            // Where the normal lies along an axis the other component is known to vanish.
            Err(open) => normal.map(|n| if n == 0.0 { Ok(0.0) } else { Err(open.clone()) }),
        };
        let place = |kind: usize, i: usize| self.kept[kind].iter().position(|k| *k == i);
        let mut contacts = Vec::new();
        for (i, c) in scene.contacts.iter().enumerate() {
            let impulse = match place(0, i) {
                None => needed(),
                Some(k) => match (&self.given.contacts[k].law, &self.given.contacts[k].normal) {
                    (GivenLaw::Frictionless(_), Some(n)) => {
                        along(n, agreed(Unknown::ContactNormal(k)))
                    }
                    _ => [
                        agreed(Unknown::Contact(k, 0)),
                        agreed(Unknown::Contact(k, 1)),
                    ],
                },
            };
            contacts.push(Impulse {
                name: c.name.clone(),
                on: c.bodies[1],
                impulse,
            });
        }
        for (i, o) in self.one_sided.iter().enumerate() {
            let impulse = match self.kept_supports.contains(&i) {
                false => needed(),
                true => along(
                    &self.supports[i].normal,
                    self.pushed(course, fitting, i, largest),
                ),
            };
            contacts.push(Impulse {
                name: o.name.clone(),
                on: o.bodies[1],
                impulse,
            });
        }
        let hinges = scene.hinges.iter().enumerate().map(|(i, h)| Impulse {
            name: h.name.clone(),
            on: h.bodies[1],
            impulse: match place(1, i) {
                Some(k) => [agreed(Unknown::Hinge(k, 0)), agreed(Unknown::Hinge(k, 1))],
                None => needed(),
            },
        });
        let hinges = hinges.collect();
        let blows = scene.blows.iter().enumerate().map(|(i, b)| Impulse {
            name: b.name.clone(),
            on: b.body,
            impulse: match place(2, i).map(|k| (k, &self.given.blows[k].impulse)) {
                Some((_, GivenImpulse::Whole(p))) => p.map(Ok),
                Some((k, GivenImpulse::Along(d))) => along(d, agreed(Unknown::Blow(k))),
                None => needed(),
            },
        });
        let blows = blows.collect();
        let name = |i: &usize| self.one_sided[*i].name.clone();
        let mut impact = Impact {
            contacts,
            hinges,
            blows,
            acting: fitting
                .iter()
                .map(|t| t.set.iter().map(name).collect())
                .collect(),
            mode: fitting.first().and_then(|t| t.mode),
            openings: Vec::new(),
            breaches: Vec::new(),
        };
        let sizes = [largest, self.fastest(fitting)];
        self.held_against(course, before, after, sizes, &mut impact);
        impact
    }

    /// The size of a support's impulse, by its place in each set.
    fn pushed(
        &self,
        course: &Course<'_>,
        fitting: &[Tried],
        support: usize,
        largest: f64,
    ) -> Component {
        let mut out: Option<f64> = None;
        for tried in fitting {
            let value = match tried.set.iter().position(|k| *k == support) {
                None => 0.0,
                Some(place) => {
                    let unknown = Unknown::ContactNormal(self.kept[0].len() + place);
                    self.agreed(course, std::slice::from_ref(tried), unknown, largest)?
                }
            };
            match out {
                Some(v) if (v - value).abs() > SAME * largest => {
                    return Err(course.open(Why::Supports));
                }
                _ => out = out.or(Some(value)),
            }
        }
        out.ok_or_else(|| course.open(Why::Laws))
    }

    /// The size of speeds before and after.
    fn fastest(&self, fitting: &[Tried]) -> f64 {
        let speeds = fitting.iter().flat_map(Tried::speeds);
        speeds.fold(self.speed, f64::max)
    }

    /// How fast bodies part, and what cannot be, beside the largest impulse and speed.
    fn held_against(
        &self,
        course: &Course<'_>,
        before: &State,
        after: &State,
        [largest, fastest]: [f64; 2],
        impact: &mut Impact,
    ) {
        let placed = self.given.contacts.iter().zip(&self.kept[0]);
        let contacts = placed.filter_map(|(c, i)| {
            let normal = c.normal?;
            let closes = c.law != GivenLaw::None;
            Some((*i, c.joint.bodies, c.joint.at, normal, closes, true))
        });
        let others = course.stage.scene.contacts.len();
        let supports = self.kept_supports.iter().map(|i| {
            let s = &self.supports[*i];
            (others + i, s.bodies, s.at, s.normal, true, false)
        });
        for (i, bodies, at, normal, closes, must_meet) in contacts.chain(supports) {
            let name = impact.contacts[i].name.clone();
            let speed = |state: &State| opening(course, state, bodies, &at, &normal);
            let opening = Opening {
                name: name.clone(),
                before: speed(before),
                after: speed(after),
            };
            let above = |c: &Component, limit: f64| c.as_ref().is_ok_and(|v| *v > limit);
            let below = |c: &Component, limit: f64| c.as_ref().is_ok_and(|v| *v < -limit);
            if must_meet && above(&opening.before, ROUNDING * self.speed) {
                impact.breaches.push(Breach::Separates(name.clone()));
            }
            let [x, y] = &impact.contacts[i].impulse;
            let push = match (x, y) {
                (Ok(x), Ok(y)) => Ok(dot(&[*x, *y], &normal)),
                (Err(e), _) | (_, Err(e)) => Err(e.clone()),
            };
            if closes && below(&push, ROUNDING * largest) {
                impact.breaches.push(Breach::Pulls(name.clone()));
            }
            if closes && below(&opening.after, SAME * fastest) {
                impact.breaches.push(Breach::Enters(name));
            }
            impact.openings.push(opening);
        }
    }
}

/// Velocity of the second body against the first along a normal.
fn opening(
    course: &Course<'_>,
    state: &State,
    bodies: [usize; 2],
    at: &[f64; 2],
    normal: &[f64; 2],
) -> Component {
    let mut total = 0.0;
    for (b, sign) in [(bodies[1], 1.0), (bodies[0], -1.0)] {
        let v = velocity_at(course.solids[b].freedom, &state.bodies[b], at);
        for (v, n) in v.into_iter().zip(normal) {
            if *n != 0.0 {
                total += sign * n * v?;
            }
        }
    }
    Ok(total)
}
