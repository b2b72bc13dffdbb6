//! Vectors as a page writes them, `\vec{v}_B^{+}`, `\vec{H}_C^{-}` or `\vec{r}_{B/C}`: their components in the scene.
//!
//! A letter says what it is of the point or body in its index: v its velocity, r its place, P the impulse there, H the
//! angular momentum about it, n the normal at it, ω the spin of the body. The mark says when. Without one it is just before
//! where the same letter stands beside it with the mark of the moment after, else just after or, with a remark, just before.
//! H and P are of a system of bodies, first of all that move.

use std::collections::{BTreeMap, BTreeSet};

use super::super::believed::Story;
use super::Desk;
use super::link::Link;
use super::names::readings;
use crate::derive::Names;
use crate::expr::{Expr, Node, Symbol, Vector, cross, minus};
use crate::formula::{self, Content, Reading, Symbols};
use crate::laws::{self, Affine, Geometry, Kinematics, Place, Unknown};
use crate::scene::{Ask, Scene};

/// Most vectors that a page may name.
const MOST_VECTORS: usize = 60;
/// Most bodies of which each pair is a system, too.
const MOST_PAIRED: usize = 3;

/// An impact, with what its unknowns stand for.
struct Impact<'a> {
    scene: &'a Scene,
    geometry: Geometry<Expr>,
    after: Kinematics<Expr>,
    names: &'a Names,
    value: &'a dyn Fn(&Symbol) -> Option<Expr>,
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

/// A moment of an impact, or any motion that bodies can have.
#[derive(Clone, Copy, PartialEq)]
enum When {
    Before,
    After,
    Whatever,
}

/// The vectors of a page at a moment, of one system of bodies.
pub(super) struct Stand {
    /// Words for the moment and the system.
    pub when: String,
    /// Components by name.
    pub values: BTreeMap<Symbol, Expr>,
    /// Of impulses and points that two bodies share: on which of them, by letter and index.
    pub of: BTreeMap<String, usize>,
    /// What is the same before and after.
    still: BTreeSet<Symbol>,
}

/// A point of a scene and the bodies that are there, those that can move first.
struct Point {
    at: Vector,
    bodies: Vec<usize>,
}

impl<'a> Impact<'a> {
    fn new(
        scene: &'a Scene,
        names: &'a Names,
        value: &'a dyn Fn(&Symbol) -> Option<Expr>,
    ) -> Impact<'a> {
        let geometry = Geometry::symbolic(scene);
        let after = Kinematics::full(scene, &geometry);
        Impact {
            scene,
            geometry,
            after,
            names,
            value,
        }
    }

    /// What a form in the unknowns comes to; nothing where one of them has no value.
    fn put_in(&self, form: &Affine<Expr>) -> Option<Expr> {
        let term = |(unknown, factor): &(Unknown, Expr)| {
            let value = (self.value)(&Symbol::from(self.names.plain(*unknown)))?;
            let value = if self.names.is_reversed(*unknown) {
                -value
            } else {
                value
            };
            Some(factor * &value)
        };
        let terms: Option<Vec<Expr>> = form.terms.iter().map(term).collect();
        Some(&form.constant + &Expr::sum(terms?))
    }

    fn moving(&self) -> Vec<usize> {
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
        let contacts = scene.contacts.iter();
        let contacts = contacts.map(|c| (&c.name, &c.at, c.bodies.to_vec()));
        let hinges = scene.hinges.iter();
        let hinges = hinges.map(|h| (&h.name, &h.at, h.bodies.to_vec()));
        let blows = scene.blows.iter().map(|b| (&b.name, &b.at, vec![b.body]));
        let mut places = contacts.chain(hinges).chain(blows);
        if let Some((_, at, mut bodies)) = places.find(|(name, ..)| is_index(name, index)) {
            bodies.sort_by_key(|&b| scene.bodies[b].is_fixed());
            let at = at.clone();
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
            When::Before => Some(self.geometry.velocity_before(b, at)),
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
            When::Before => Some(self.geometry.before(b).1.clone()),
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

    /// The joint of a name, and its two bodies.
    fn joint(&self, index: &str) -> Option<(Place, [usize; 2])> {
        let scene = self.scene;
        let named = |name: &str| is_index(name, index);
        let contact = scene.contacts.iter().position(|c| named(&c.name));
        let hinge = scene.hinges.iter().position(|h| named(&h.name));
        let blow = scene.blows.iter().position(|b| named(&b.name));
        Some(match (contact, hinge, blow) {
            (Some(c), ..) => (Place::Contact(c), scene.contacts[c].bodies),
            (_, Some(h), _) => (Place::Hinge(h), scene.hinges[h].bodies),
            (_, _, Some(b)) => (Place::Blow(b), [scene.blows[b].body; 2]),
            _ => return None,
        })
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
        let (place, bodies) = self.joint(index)?;
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
                let (_, bodies) = self.joint(&index)?;
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
        let when = match &*mark {
            _ if meant.when == When::Whatever => When::Whatever,
            "" => meant.when,
            "'" | "^+" => When::After,
            "^-" => When::Before,
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
            "P" if when != When::Whatever => self.impulse(&index, meant).map(flat),
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
    fn moments(&self, names: &[(Symbol, Symbol)], impact: &str) -> Vec<Stand> {
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
                    when: format!("just {word} {impact}{of}"),
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

    /// Whether a vector is the same before the impact as after it.
    fn is_still(&self, name: &Symbol, meant: &Meant) -> bool {
        let at = |mark: &str| {
            let plain = name.split(['^', '\'']).next().unwrap_or_default();
            self.vector(&Symbol::from(format!("{plain}{mark}")), meant)
        };
        at("^-").is_some_and(|before| at("^+") == Some(before))
    }

    /// The components of all that have a value.
    fn components(&self, names: &[(Symbol, Symbol)], meant: &Meant) -> BTreeMap<Symbol, Expr> {
        let known = names.iter().filter_map(|(name, key)| {
            let vector = self.vector(name, meant)?;
            let along = |axis: &str| Symbol::from(format!("{key}_{axis}"));
            Some(["x", "y", "z"].map(along).into_iter().zip(vector))
        });
        known.flatten().collect()
    }
}

/// What names without their marks are told apart by.
fn shared_key(base: &str, index: &str) -> String {
    format!("{base} {index}")
}

/// Whether an index is this name, written without what cannot stand in one.
fn is_index(name: &str, index: &str) -> bool {
    name.chars()
        .filter(|c| *c != '_')
        .eq(index.chars().filter(|c| *c != '_'))
}

/// The vector with an arrow that a name is, or is a component of.
fn arrowed(name: &Symbol) -> Option<Symbol> {
    let axes = ["_x", "_y", "_z"];
    let stem = axes.iter().find_map(|axis| name.strip_suffix(axis));
    let whole = stem.filter(|_| formula::is_component(name));
    let whole = whole.map(Symbol::from);
    whole.or_else(|| formula::has_arrow(name).then(|| name.clone()))
}

/// Letters of vectors of which one has the mark of the moment after and none that of the moment before.
pub(super) fn marked_after(text: &str) -> BTreeSet<String> {
    let reading = text
        .contains("vec")
        .then(|| formula::read(text, &Symbols::open()));
    let Some(Ok(reading)) = reading else {
        return BTreeSet::new();
    };
    let arrows = reading.symbols().into_iter();
    let names: Vec<_> = arrows
        .filter_map(|name| formula::vector_name(arrowed(&name)?.as_ref()))
        .collect();
    let after = names
        .iter()
        .filter(|(.., mark)| ["'", "^+"].contains(&&**mark));
    let before = |base: &String| names.iter().any(|(b, _, mark)| b == base && mark == "^-");
    let after = after.map(|(base, ..)| base.clone());
    after
        .filter(|base| ["v", "omega", "H"].contains(&&**base) && !before(base))
        .collect()
}

/// Whether a vector without a mark has a letter of these.
pub(super) fn is_marked(letters: &BTreeSet<String>, name: &str) -> bool {
    let unmarked = formula::vector_name(name).filter(|(.., mark)| mark.is_empty());
    unmarked.is_some_and(|(base, ..)| letters.contains(&base))
}

/// Whether a name with an arrow stands in a product of vectors, rather than alone left of a sign of equality.
pub(super) fn in_products(text: &str) -> impl Fn(&str) -> bool {
    let signs = ["×", "\\times", "·", "\\cdot"];
    let multiplied = signs.iter().any(|sign| text.contains(sign));
    let left = text.split('=').next().filter(|_| multiplied);
    let left = left.filter(|left| !signs.iter().any(|sign| left.contains(sign)));
    let left = left.and_then(|left| formula::read(left, &Symbols::open()).ok());
    let left = left.and_then(|left| formula::vector_name(left.expr()?.as_symbol()?));
    let alone = left.map(|(base, index, _)| (base, index));
    move |name| {
        let here = || formula::vector_name(name).map(|(base, index, _)| (base, index));
        multiplied && (alone.is_none() || alone != here())
    }
}

/// Whether a form is a sum of multiples of what `is_one` says are vectors.
fn is_vector(e: &Expr, is_one: &impl Fn(&Symbol) -> bool) -> bool {
    match e.node() {
        Node::Symbol(name) => is_one(name),
        Node::Sum(_) => e.terms().iter().all(|term| is_vector(term, is_one)),
        Node::Product(factors) => {
            let (vectors, others): (Vec<&Expr>, Vec<&Expr>) =
                factors.iter().partition(|factor| is_vector(factor, is_one));
            vectors.len() == 1 && !others.iter().any(|e| e.symbols().iter().any(is_one))
        }
        _ => false,
    }
}

impl Desk<'_> {
    /// The vectors that a solution names, where the scene has a value for them: as it goes first, and at other moments and of
    /// other systems.
    pub(super) fn know_vectors(&mut self, text: &str) {
        let sheet = self.sheet;
        let asked = sheet.scene.questions.iter().map(|q| q.name.as_str());
        let asked: Vec<_> = asked
            .filter_map(|name| Some((formula::with_arrow(name)?, self.components(name)?)))
            .collect();
        for (arrow, vector) in asked {
            let axes = ["x", "y", "z"].into_iter().zip(vector);
            let along = axes.map(|(axis, value)| (Symbol::from(format!("{arrow}_{axis}")), value));
            self.parts.extend(along);
        }
        let readings = readings(&sheet.scene, text);
        let used = readings.iter().flat_map(Reading::symbols);
        let symbols = self.symbols(text);
        // Places and spins are others at other moments, though the scene has names for them.
        let read_as = |name: Symbol| {
            let reading = formula::read(&formula::latex_name(&name), &symbols).ok();
            let found = reading
                .as_ref()
                .and_then(|r| r.expr()?.as_symbol())
                .cloned();
            let (base, ..) = formula::vector_name(&name)?;
            let changes = ["r", "omega"].contains(&&*base);
            match found {
                None => Some((name.clone(), name)),
                Some(found) => (changes && formula::has_arrow(&found)).then_some((name, found)),
            }
        };
        let names: BTreeSet<Symbol> = used.filter_map(|name| arrowed(&name)).collect();
        // Beside `v'` a v without a mark is the one before, and H may be the same at both moments.
        let before = names.iter().flat_map(|name| {
            let (base, _, mark) = formula::vector_name(name).unwrap_or_default();
            let stem = name.trim_end_matches(&*mark);
            let marks: &[&str] = match (&*base, &*mark) {
                ("v" | "omega", "") => &["^-"],
                ("H", _) => &["^-", "^+"],
                _ => &[],
            };
            marks
                .iter()
                .map(move |mark| Symbol::from(format!("{stem}{mark}")))
        });
        let names: BTreeSet<Symbol> = before.chain(names.iter().cloned()).collect();
        let names: Vec<(Symbol, Symbol)> = names.into_iter().filter_map(read_as).collect();
        let no_impact = sheet.story.is_some() && sheet.impacts.is_empty();
        if names.is_empty() || names.len() > MOST_VECTORS || no_impact {
            return;
        }
        let closed = self.closed.clone();
        let name_of = |name: &Symbol| closed.contains_key(name).then(|| Expr::symbol(name));
        let first = Impact::new(&sheet.scene, &sheet.derivation.names, &name_of);
        for stand in first.moments(&names, "the impact") {
            for (name, value) in &stand.values {
                let told = self.parts.entry(name.clone());
                told.or_insert_with(|| value.clone());
            }
            for (shared, body) in &stand.of {
                self.first_of.entry(shared.clone()).or_insert(*body);
            }
            self.vectors.push(stand);
        }
        let (system, on) = (first.moving(), None);
        let when = When::Whatever;
        self.whatever = first.components(&names, &Meant { system, on, when });
        for (scene, (when, motion)) in sheet.impacts.iter().zip(&sheet.moments) {
            let value = |name: &Symbol| motion.get(name).cloned();
            let names_there = Names::of(scene);
            let impact = Impact::new(scene, &names_there, &value);
            let which = when.trim_start_matches("just after ");
            for stand in impact.moments(&names, which) {
                let all = motion.clone().into_iter().chain(stand.values);
                let values = all.collect();
                self.vectors.push(Stand { values, ..stand });
            }
        }
    }

    /// Whether a line tells velocities and places in vectors, which may be of a moment in a motion, and not just of an impact by
    /// their marks.
    pub(super) fn is_of_a_motion(&self, links: &[Link]) -> bool {
        let names = Desk::arrows(links);
        let (mut moves, mut marked, mut any) = (!names.is_empty(), true, false);
        for name in &names {
            let Some((base, _, mark)) = formula::vector_name(name) else {
                continue;
            };
            let mark = ["^-", "^+"].contains(&&*mark);
            moves &= ["v", "r", "omega"].contains(&&*base);
            // The mark of a spin that is asked for is read off it.
            marked &= mark || base == "r" || self.spins.contains_key(name);
            any |= mark;
        }
        let story = self.sheet.story.as_ref();
        story.is_some_and(Story::has_motions) && moves && !(marked && any)
    }

    /// The vectors with arrows that a line names.
    fn arrows(links: &[Link]) -> BTreeSet<Symbol> {
        let sides = links.iter().flat_map(|link| &link.sides);
        let names = sides.flat_map(Content::symbols);
        names.filter_map(|name| arrowed(&name)).collect()
    }

    /// Whether a line says more than that nothing is nothing: one of the vectors in it does not vanish at a moment, none of the
    /// velocities without a mark vanishes beside others, since a term with it could be any, or it holds of whatever motion;
    /// with `all` none that has one either.
    pub(super) fn says_enough(
        &self,
        links: &[Link],
        values: &BTreeMap<Symbol, Expr>,
        all: bool,
    ) -> bool {
        let of_moment = |name: &Symbol, bases: &[&str]| {
            let named = formula::vector_name(name);
            named
                .filter(|(base, ..)| bases.contains(&&**base))
                .map(|(.., mark)| mark)
        };
        let vanishes = |name: &Symbol| {
            let along = ["x", "y", "z"].map(|axis| Expr::symbol(&format!("{name}_{axis}")));
            self.all_zero(&along, values) == Some(true)
        };
        let names = Desk::arrows(links);
        let bases = ["v", "omega", "H", "P"];
        let moving = names
            .iter()
            .filter(|name| of_moment(name, &bases).is_some());
        let (gone, left): (Vec<&Symbol>, Vec<&Symbol>) = moving.partition(|name| vanishes(name));
        let nothing = |side: &Content| match side {
            Content::Vector(v) => v.iter().all(Expr::is_zero),
            side => side.expr().is_some_and(Expr::is_zero),
        };
        let told = links.iter().any(|link| link.sides.iter().any(nothing));
        if left.is_empty() {
            return gone.len() < 2 || told;
        }
        let unmarked = |name: &&&Symbol| {
            of_moment(name, &bases[..2]).is_some_and(|mark| mark.is_empty() || all)
        };
        !gone.iter().any(|name| unmarked(&name)) || self.is_law(links)
    }

    /// Whether a line holds of whatever motion of the bodies, as H = r × m v + I ω does.
    fn is_law(&self, links: &[Link]) -> bool {
        let marks = Desk::arrows(links).into_iter();
        let marks: BTreeSet<String> = marks
            .filter_map(|n| Some(formula::vector_name(&n)?.2))
            .collect();
        let all: Vec<Expr> = links.iter().flat_map(|l| l.differences.clone()).collect();
        let one = marks.iter().filter(|mark| !mark.is_empty()).count() < 2;
        one && self.all_zero(&all, &self.whatever) == Some(true)
    }

    /// Whether a line says how vectors of both moments are related that an impact does not change.
    pub(super) fn is_idle(&self, links: &[Link], stand: &Stand) -> bool {
        let names = Desk::arrows(links);
        let marked = |marks: &[&str]| {
            let mark = |name: &Symbol| Some(formula::vector_name(name)?.2);
            names
                .iter()
                .any(|n| mark(n).is_some_and(|m| marks.contains(&&*m)))
        };
        let mut moving = names.iter().filter(|name| {
            let base = formula::vector_name(name).map(|(base, ..)| base);
            base.is_some_and(|base| ["v", "omega", "H"].contains(&&*base))
        });
        marked(&["^-", ""]) && marked(&["^+", "'"]) && moving.all(|name| stand.still.contains(name))
    }

    /// Of the impulses and points in a line that two bodies share: which body is meant at first.
    pub(super) fn shared_in(&self, links: &[Link]) -> Vec<(String, usize)> {
        let names = Desk::arrows(links).into_iter();
        let keys = names.filter_map(|name| {
            let (base, index, _) = formula::vector_name(&name)?;
            let key = shared_key(&base, &index);
            Some((key.clone(), *self.first_of.get(&key)?))
        });
        keys.collect()
    }

    /// Whether a line has a shared impulse or velocity of another body than the page has had it.
    pub(super) fn is_counted_otherwise(&self, links: &[Link]) -> bool {
        let mut shared = self.shared_in(links).into_iter();
        shared.any(|(key, first)| self.counted.get(&key).is_some_and(|kept| *kept != first))
    }

    /// Keeps of which bodies shared vectors are in a line that holds for these alone.
    pub(super) fn count(&mut self, links: &[Link], of: &BTreeMap<String, usize>) {
        let all: Vec<Expr> = links.iter().flat_map(|l| l.differences.clone()).collect();
        for (key, first) in self.shared_in(links) {
            let meant = of.get(&key).copied().unwrap_or(first);
            let other = |stand: &&Stand| stand.of.get(&key).is_some_and(|b| *b != meant);
            let mut others = self.vectors.iter().filter(other);
            if !others.any(|stand| self.all_zero(&all, &stand.values) == Some(true)) {
                self.counted.entry(key).or_insert(meant);
            }
        }
    }

    /// The components of a sum of multiples of vectors: of those with arrows, and where these stand beside them of those that
    /// are asked for.
    pub(super) fn by_components(&self, e: &Expr, beside: bool) -> Option<[Expr; 3]> {
        let is_one = |name: &Symbol| match formula::has_arrow(name) {
            true => self.components(name).is_some(),
            false => beside && self.components(name).is_some(),
        };
        if !is_vector(e, &is_one) {
            return None;
        }
        let names = e.symbols();
        let vectors = names.iter().filter(|name| is_one(name));
        let vectors: Vec<_> = vectors
            .filter_map(|name| Some((name, self.components(name)?)))
            .collect();
        Some([0, 1, 2].map(|k| {
            let along = vectors
                .iter()
                .map(|(name, v)| ((*name).clone(), v[k].clone()));
            e.substitute(&along.collect())
        }))
    }
}
