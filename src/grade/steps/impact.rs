//! The vectors of an impact by name, `\vec{v}_B^{+}`, `\vec{H}_C^{-}` or `\vec{r}_{B/C}`: their components in the scene.
//!
//! A letter says what it is of the point or body in its index: v its velocity, r its place, P the impulse there, H the
//! angular momentum about it, n the normal at it, ω the spin of the body. The mark says when; H and P are of a system of
//! bodies, first of all that move. Of how pages use these names nothing is known here.

use std::collections::{BTreeMap, BTreeSet};

use super::super::sheet::Sheet;
use super::link::Values;
use crate::derive::Names;
use crate::expr::{Expr, Symbol, Vector, cross, minus};
use crate::formula;
use crate::laws::{self, Affine, Geometry, Kinematics, Place, Unknown};
use crate::scene::{Ask, Scene};

/// Most places about which angular momenta are taken.
const MOST_PLACES: usize = 4;
/// Most bodies of which each pair is a system, too.
const MOST_PAIRED: usize = 3;

/// An impact, with what its unknowns stand for.
pub(super) struct Impact<'a> {
    pub scene: &'a Scene,
    /// Words for it.
    pub which: &'a str,
    /// What its unknowns stand for, by their names.
    pub motion: Values,
    names: Names,
    geometry: Geometry<Expr>,
    after: Kinematics<Expr>,
    /// Velocities of the centers along x and y and spins, just before and just after.
    centers: [Vec<Option<[Expr; 3]>>; 2],
}

/// All impacts of a scene, each with what comes in and the motion after it.
pub(super) fn impacts(sheet: &Sheet) -> Vec<Impact<'_>> {
    if sheet.story.is_none() {
        let motion = sheet.derivation.motion_by_name();
        let motion = motion.map(|(_, name, value)| (name, value)).collect();
        return vec![Impact::new(&sheet.scene, "the impact", motion)];
    }
    let each = sheet.impacts.iter().zip(&sheet.moments);
    let each = each.map(|(scene, (when, motion))| {
        let which = when.trim_start_matches("just after ");
        Impact::new(scene, which, motion.clone())
    });
    each.collect()
}

/// Angular momenta of all that moves about the places of a scene, just before its impacts.
pub(super) fn angular_momenta(sheet: &Sheet) -> Vec<Expr> {
    let all = impacts(sheet);
    let each = all.iter().flat_map(|impact| {
        let (points, hinges) = (&impact.scene.points, &impact.scene.hinges);
        let places = points.iter().map(|p| &p.at);
        let places = places.chain(hinges.iter().map(|h| &h.at));
        let moving = impact.moving();
        let about = |at| impact.angular_momentum(&moving, at, When::Before);
        let found = places.take(MOST_PLACES).filter_map(about);
        found.collect::<Vec<_>>()
    });
    each.flat_map(|h| [-&h, h]).collect()
}

/// Kinetic energies just before and just after the impacts of a scene, of each body and of all together.
pub(super) fn energies(sheet: &Sheet) -> Vec<Expr> {
    let all = impacts(sheet);
    let times = all
        .iter()
        .flat_map(|i| [false, true].map(|after| (i, after)));
    let each = times.flat_map(|(impact, after)| {
        let of = |b: usize| {
            let body = &impact.scene.bodies[b];
            let square = |part: usize| Some(impact.part(b, part, after)?.powi(2));
            let turns = match body.is_particle() {
                true => Expr::zero(),
                false => &body.inertia * &square(2)?,
            };
            let moves = &body.mass * &(square(0)? + square(1)?);
            Some(Expr::ratio(1, 2) * (moves + turns))
        };
        let parts: Vec<Expr> = impact.moving().into_iter().filter_map(of).collect();
        let total = Expr::sum(parts.clone());
        parts.into_iter().chain([total]).collect::<Vec<_>>()
    });
    each.filter(|e| !e.is_zero()).collect()
}

/// What names leave open.
struct Meant {
    /// The bodies of which H and P are.
    system: Vec<usize>,
    /// Which of the two bodies at a joint an impulse is counted on; by the system where it is not said.
    on: Option<usize>,
    /// The moment of a vector without a mark.
    when: When,
}

/// A moment of an impact or a motion, or any motion that bodies can have.
#[derive(Clone, Copy, PartialEq)]
enum When {
    Before,
    After,
    Whatever,
    /// At the end of a motion, without an impact.
    Moving,
}

/// The vectors of a page at a moment, of one system of bodies.
pub(super) struct Stand {
    /// Words for the moment and the system.
    pub when: String,
    /// Components by name.
    pub values: Values,
    /// Of impulses and points that two bodies share: on which of them, by letter and index.
    pub of: BTreeMap<String, usize>,
    /// What is the same before and after.
    pub still: BTreeSet<Symbol>,
}

/// A point of a scene and the bodies that are there, those that can move first.
struct Point {
    at: Vector,
    bodies: Vec<usize>,
}

impl<'a> Impact<'a> {
    pub fn new(scene: &'a Scene, which: &'a str, motion: Values) -> Impact<'a> {
        let geometry = Geometry::symbolic(scene);
        let mut impact = Impact {
            after: Kinematics::full(scene, &geometry),
            names: Names::of(scene),
            centers: Default::default(),
            scene,
            which,
            motion,
            geometry,
        };
        impact.centers = [When::Before, When::After].map(|when| {
            let parts = scene.bodies.iter().enumerate().map(|(b, body)| {
                let [x, y] = impact.velocity(b, &body.center, when)?;
                Some([x, y, impact.spin(b, when).unwrap_or(Expr::zero())])
            });
            parts.collect()
        });
        impact
    }

    /// A component of the velocity of a body's center, or its spin.
    pub fn part(&self, b: usize, part: usize, after: bool) -> Option<&Expr> {
        let center = self.centers[usize::from(after)][b].as_ref()?;
        Some(&center[part])
    }

    /// The same along a direction.
    pub fn along(&self, b: usize, axis: &Vector, after: bool) -> Option<Expr> {
        let [x, y] = [0, 1].map(|part| self.part(b, part, after));
        Some(x? * &axis[0] + y? * &axis[1])
    }

    /// The directions along which momenta are balanced: the axes, and the normal and tangent of a contact that has other ones.
    pub fn axes(&self) -> impl Iterator<Item = Vector> {
        let slanted = |n: &&Vector| n.iter().all(|part| !part.is_zero());
        let contacts = self.scene.contacts.iter();
        let normal = contacts.filter_map(|c| c.normal.as_ref()).find(slanted);
        let own = normal.map(|[x, y]| [[x.clone(), y.clone()], [-y, x.clone()]]);
        let plain = [[1, 0], [0, 1]].map(|axis| axis.map(Expr::from));
        plain.into_iter().chain(own.into_iter().flatten())
    }

    /// What a form in the unknowns comes to; nothing where one of them has no value.
    fn put_in(&self, form: &Affine<Expr>) -> Option<Expr> {
        let term = |(unknown, factor): &(Unknown, Expr)| {
            let value = self.motion.get(self.names.plain(*unknown))?.clone();
            Some(factor * &self.names.signed(*unknown, value))
        };
        let terms: Option<Vec<Expr>> = form.terms.iter().map(term).collect();
        Some(&form.constant + &Expr::sum(terms?))
    }

    /// The bodies that can move.
    pub fn moving(&self) -> Vec<usize> {
        let bodies = self.scene.bodies.iter().enumerate();
        let free = bodies.filter(|(_, body)| !body.is_fixed());
        free.map(|(b, _)| b).collect()
    }

    /// All that moves, then each body alone, then pairs where there are few.
    fn systems(&self) -> Vec<Vec<usize>> {
        let all = self.moving();
        let mut systems = vec![all.clone()];
        if all.len() > 1 {
            systems.extend(all.iter().map(|&b| vec![b]));
        }
        if all.len() == MOST_PAIRED {
            systems.extend((0..MOST_PAIRED).map(|out| [&all[..out], &all[out + 1..]].concat()));
        }
        systems
    }

    fn body(&self, index: &str) -> Option<usize> {
        let moving = self.moving();
        let mut bodies = self.scene.bodies.iter();
        match (bodies.position(|body| is_index(&body.name, index)), index) {
            (Some(b), "G") if !self.scene.bodies[b].is_fixed() => Some(b),
            (_, "G" | "") if moving.len() == 1 => Some(moving[0]),
            (found, _) => found,
        }
    }

    /// The place a label names, with the bodies there; `C,rod` is C on the rod.
    fn point(&self, index: &str) -> Option<Point> {
        if let Some((index, body)) = index.split_once(',') {
            let point = self.point(index)?;
            let body = self.body(body).filter(|b| point.bodies.contains(b))?;
            return Some(Point {
                bodies: vec![body],
                ..point
            });
        }
        let scene = self.scene;
        if let Some((_, at, bodies)) = self.joint(index) {
            let (at, mut bodies) = (at.clone(), bodies.to_vec());
            bodies.dedup();
            bodies.sort_by_key(|&b| scene.bodies[b].is_fixed());
            return Some(Point { at, bodies });
        }
        if let Some(b) = self.body(index) {
            let at = scene.bodies[b].center.clone();
            return Some(Point {
                at,
                bodies: vec![b],
            });
        }
        let mut points = scene.points.iter();
        let point = points.find(|point| is_index(&point.name, index))?;
        let mut bodies = self.moving();
        if bodies.len() > 1 {
            bodies.retain(|&b| scene.bodies[b].center == point.at);
        }
        Some(Point {
            at: point.at.clone(),
            bodies,
        })
    }

    /// The center of the body whose velocity a question of this name asks for, as `v1` does.
    fn asked_of(&self, name: &str) -> Option<Point> {
        let mut asked = self.scene.questions.iter();
        asked.find_map(|q| match q.ask {
            Ask::Velocity {
                body,
                point: None,
                along: None,
            } if is_index(&q.name, name) => Some(Point {
                at: self.scene.bodies[body].center.clone(),
                bodies: vec![body],
            }),
            _ => None,
        })
    }

    fn velocity(&self, b: usize, at: &Vector, when: When) -> Option<Vector> {
        match when {
            When::Before | When::Moving => Some(self.geometry.velocity_before(b, at)),
            When::After => {
                let [x, y] = self.after.velocity_of(&self.geometry, b, at);
                Some([self.put_in(&x)?, self.put_in(&y)?])
            }
            When::Whatever => {
                let [x, y] = minus(at, &self.scene.bodies[b].center);
                let spin = &self.spin(b, when)?;
                let of = |axis: &str| Expr::symbol(&format!("any {axis} of {b}"));
                Some([of("x") - spin * &y, of("y") + spin * &x])
            }
        }
    }

    fn spin(&self, b: usize, when: When) -> Option<Expr> {
        match when {
            When::After => self.put_in(&self.after.spin[b]),
            When::Before | When::Moving => Some(self.geometry.before(b).1.clone()),
            When::Whatever => Some(Expr::symbol(&format!("any spin of {b}"))),
        }
    }

    /// Angular momentum of a system about a point, Σ r × m v + I ω.
    fn angular_momentum(&self, system: &[usize], about: &Vector, when: When) -> Option<Expr> {
        let of = |&b: &usize| {
            let body = &self.scene.bodies[b];
            let velocity = self.velocity(b, &body.center, when)?;
            let orbital = &body.mass * &cross(&minus(&body.center, about), &velocity);
            if body.is_particle() {
                return Some(orbital);
            }
            Some(orbital + &(&body.inertia * &self.spin(b, when)?))
        };
        let all: Option<Vec<Expr>> = system.iter().map(of).collect();
        Some(Expr::sum(all?))
    }

    /// The joint of a name, where it is, and its two bodies.
    fn joint(&self, index: &str) -> Option<(Place, &Vector, [usize; 2])> {
        let contacts = self.scene.contacts.iter().enumerate();
        let contacts = contacts.map(|(k, c)| (&c.name, (Place::Contact(k), &c.at, c.bodies)));
        let hinges = self.scene.hinges.iter().enumerate();
        let hinges = hinges.map(|(k, h)| (&h.name, (Place::Hinge(k), &h.at, h.bodies)));
        let blows = self.scene.blows.iter().enumerate();
        let blows = blows.map(|(k, b)| (&b.name, (Place::Blow(k), &b.at, [b.body; 2])));
        let mut all = contacts.chain(hinges).chain(blows);
        let found = all.find(|(name, _)| is_index(name, index));
        found.map(|(_, joint)| joint)
    }

    /// Which of the two bodies at a joint an impulse is counted on: one that can move, else one of a system that the joint is not
    /// inside of.
    fn counted_on(&self, bodies: [usize; 2], meant: &Meant) -> Option<usize> {
        match meant.on {
            Some(k) => {
                let acts = bodies[0] != bodies[1] && !self.scene.bodies[bodies[k]].is_fixed();
                acts.then_some(k)
            }
            None => match bodies.map(|b| meant.system.contains(&b)) {
                [true, false] => Some(0),
                [false, true] => Some(1),
                [inside, _] => Some(1).filter(|_| inside && bodies[0] == bodies[1]),
            },
        }
    }

    fn impulse(&self, index: &str, meant: &Meant) -> Option<Vector> {
        let (place, _, bodies) = self.joint(index)?;
        let on = self.counted_on(bodies, meant)?;
        let [x, y] = laws::impulse_at(self.scene, &self.geometry, place);
        let impulse = [self.put_in(&x)?, self.put_in(&y)?];
        Some(match on {
            0 => impulse.map(|p| -p),
            _ => impulse,
        })
    }

    /// The body whose velocity at a point is meant, and the point.
    fn body_at(&self, index: &str, meant: &Meant) -> Option<(usize, Vector, bool)> {
        let asked = || self.asked_of(&format!("v{index}"));
        let point = self.point(index).or_else(asked)?;
        let free = point
            .bodies
            .iter()
            .filter(|&&b| !self.scene.bodies[b].is_fixed());
        let shared = free.count() > 1;
        let mut bodies = point.bodies.iter();
        let system = &meant.system;
        let b = bodies.find(|b| system.contains(b));
        Some((*b.or(point.bodies.first())?, point.at, shared))
    }

    /// Of what two bodies share: which of them is meant.
    fn shared(&self, name: &Symbol, meant: &Meant) -> Option<(String, usize)> {
        let (base, index, _) = formula::vector_name(name)?;
        let body = match &*base {
            "P" => {
                let (.., bodies) = self.joint(&index)?;
                let both = bodies.iter().all(|&b| !self.scene.bodies[b].is_fixed());
                let on = self.counted_on(bodies, meant)?;
                (both && bodies[0] != bodies[1]).then_some(bodies[on])
            }
            "v" => {
                let (b, _, shared) = self.body_at(&index, meant)?;
                shared.then_some(b)
            }
            _ => None,
        };
        Some((shared_key(&base, &index), body?))
    }

    /// The vector that a name stands for, of a system of bodies.
    fn vector(&self, name: &Symbol, meant: &Meant) -> Option<[Expr; 3]> {
        let system = &meant.system;
        let (base, index, mark) = formula::vector_name(name)?;
        let when = match (&*mark, meant.when) {
            (_, When::Whatever) => When::Whatever,
            ("" | "'" | "^+", When::Moving) | ("", _) => meant.when,
            ("'" | "^+", _) => When::After,
            ("^-", When::Before | When::After) => When::Before,
            _ => return None,
        };
        let flat = |[x, y]: Vector| [x, y, Expr::zero()];
        let out_of_page = |z: Expr| [Expr::zero(), Expr::zero(), z];
        match &*base {
            "v" => {
                let of = |index: &str| {
                    let (b, at, _) = self.body_at(index, meant)?;
                    self.velocity(b, &at, when)
                };
                match index.split_once('/') {
                    Some((of_one, from)) => Some(flat(minus(&of(of_one)?, &of(from)?))),
                    None => of(&index).map(flat),
                }
            }
            "omega" => self.spin(self.body(&index)?, when).map(out_of_page),
            "r" => {
                let (to, from) = index.split_once('/')?;
                let [to, from] = [self.point(to)?, self.point(from)?];
                Some(flat(minus(&to.at, &from.at)))
            }
            "H" => {
                let (about, only) = match index.split_once(',') {
                    Some((about, body)) => (about, vec![self.body(body)?]),
                    None => (&*index, system.to_vec()),
                };
                let about = self.point(about)?.at;
                self.angular_momentum(&only, &about, when).map(out_of_page)
            }
            "P" if [When::Before, When::After].contains(&when) => {
                self.impulse(&index, meant).map(flat)
            }
            "n" => {
                let mut contacts = self.scene.contacts.iter();
                let contacts: Vec<_> = contacts.by_ref().filter(|c| c.normal.is_some()).collect();
                let named = contacts.iter().find(|c| is_index(&c.name, &index));
                let only = contacts
                    .first()
                    .filter(|_| index.is_empty() && contacts.len() == 1);
                named.or(only)?.normal.clone().map(flat)
            }
            _ => None,
        }
    }

    /// The vectors of each system by what they are read as, without a mark just after and just before, and words for which they are.
    pub fn moments(&self, names: &[(Symbol, Symbol)]) -> Vec<Stand> {
        let mut all: Vec<Stand> = Vec::new();
        let whole = self.moving();
        let times = [When::After, When::Before];
        let ways = [None, Some(1), Some(0)].into_iter();
        let ways: Vec<_> = ways.flat_map(|on| times.map(|when| (on, when))).collect();
        for system in self.systems() {
            let of = match system == whole {
                true => String::new(),
                false => format!(", of {} alone", self.listed(&system)),
            };
            for &(on, when) in &ways {
                let system = system.clone();
                let meant = Meant { system, on, when };
                let values = self.components(names, &meant);
                if all.iter().any(|other| other.values == values) {
                    continue;
                }
                let shared = names
                    .iter()
                    .filter_map(|(name, _)| self.shared(name, &meant));
                let unmoved = names.iter().filter(|(name, _)| self.is_still(name, &meant));
                let word = if when == When::After {
                    "after"
                } else {
                    "before"
                };
                all.push(Stand {
                    when: format!("just {word} {}{of}", self.which),
                    of: shared.collect(),
                    still: unmoved.map(|(_, key)| key.clone()).collect(),
                    values,
                });
            }
        }
        all
    }

    fn listed(&self, bodies: &[usize]) -> String {
        let names = bodies
            .iter()
            .map(|&b| format!("`{}`", self.scene.bodies[b].name));
        formula::listed(&names.collect::<Vec<_>>())
    }

    /// The vectors of each system in whatever motion, first of all that moves.
    pub fn of_whatever_motion(&self, names: &[(Symbol, Symbol)]) -> Vec<Values> {
        let systems = self.systems().into_iter();
        systems
            .map(|system| self.of_system(system, names, When::Whatever))
            .collect()
    }

    /// The vectors of all that moves at the end of a motion, which the scene is of.
    pub fn of_a_motion(&self, names: &[(Symbol, Symbol)]) -> Values {
        self.of_system(self.moving(), names, When::Moving)
    }

    fn of_system(&self, system: Vec<usize>, names: &[(Symbol, Symbol)], when: When) -> Values {
        let meant = Meant {
            system,
            on: None,
            when,
        };
        self.components(names, &meant)
    }

    /// Whether a vector is the same before the impact as after it.
    fn is_still(&self, name: &Symbol, meant: &Meant) -> bool {
        let at = |mark: &str| {
            let plain = name.split(['^', '\'']).next().unwrap_or_default();
            self.vector(&Symbol::from(format!("{plain}{mark}")), meant)
        };
        at("^-").is_some_and(|before| at("^+") == Some(before))
    }

    /// The components of all that have a value.
    fn components(&self, names: &[(Symbol, Symbol)], meant: &Meant) -> Values {
        let known = names.iter().filter_map(|(name, key)| {
            let vector = self.vector(name, meant)?;
            Some(formula::along_axes(key).into_iter().zip(vector))
        });
        known.flatten().collect()
    }
}

/// What names without their marks are told apart by.
pub(super) fn shared_key(base: &str, index: &str) -> String {
    format!("{base} {index}")
}

/// Whether an index is this name, written without what cannot stand in one.
fn is_index(name: &str, index: &str) -> bool {
    name.chars()
        .filter(|c| *c != '_')
        .eq(index.chars().filter(|c| *c != '_'))
}
