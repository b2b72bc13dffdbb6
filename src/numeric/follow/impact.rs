//! An impact: the velocities after of all bodies and every impulse at once, and which supports and strings act.
//!
//! In: a stage's scene and the state before. Out: [`Impact`] and the state after. The rows come from the geometry
//! ([`crate::numeric::assemble`]); velocities that are open before are unknowns too, so that what does not depend on them
//! comes out all the same. Of the one-sided supports and strings every set is tried; it fits where those that act push or pull
//! and the bodies do not move against those that do not (complementarity). Sets whose impulses are not determined are left out
//! as long as others fit: whatever motion they allow, a smaller set allows it too (Carathéodory).

use nalgebra::{DMatrix, DVector};

use super::super::given::{
    Freedom, Given, GivenBody, GivenContact, GivenImpulse, GivenLaw, Joint, around,
};
use super::super::number::{cross, difference, dot};
use super::super::system::{Law, System, Unknown, assemble};
use super::least::{Found, NoSolution, solve};
use super::{BodyState, Component, Course, Lost, Open, State, Why};
use crate::scene::{OneSided, Scene};

/// Speeds and impulses below this share of those at hand are rounding.
const ROUNDING: f64 = 1e-9;
/// Sets of supports whose motions differ by less than this share give the same motion.
const SAME: f64 = 1e-7;

/// What an impact did.
#[derive(Clone, Debug, PartialEq)]
pub struct Impact {
    /// Impulses of the contacts, then of supports and strings, as questions count them.
    pub contacts: Vec<Impulse>,
    /// Impulses of the hinges.
    pub hinges: Vec<Impulse>,
    /// Impulses from outside.
    pub blows: Vec<Impulse>,
    /// Names of the supports and strings that act, for every set that fits: one set as a rule.
    pub acting: Vec<Vec<String>>,
    /// How fast bodies part, of every contact with a normal and every support and string.
    pub openings: Vec<Opening>,
    /// What cannot happen so, though the laws were solved.
    pub breaches: Vec<Breach>,
}

/// An impulse with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Impulse {
    /// Name of what transmits it.
    pub name: String,
    /// Index of the body it acts on: the second one.
    pub on: usize,
    /// Its components \[N s\].
    pub impulse: [Component; 2],
}

/// Velocity of the second body against the first along the normal; negative where they approach.
#[derive(Clone, Debug, PartialEq)]
pub struct Opening {
    /// Name of the contact, support or string.
    pub name: String,
    /// Just before [m/s].
    pub before: Component,
    /// Just after [m/s].
    pub after: Component,
}

/// A way in which a solution of the equations cannot be what happens.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Breach {
    /// The bodies part before they touch at this contact.
    Separates(String),
    /// This contact or support would have to pull, or this string to push.
    Pulls(String),
    /// The bodies go on into each other here, or a string gets longer.
    Enters(String),
}

/// Solves an impact.
pub(super) fn impact(
    course: &Course<'_>,
    one_sided: &[OneSided],
    supposed: Option<&[String]>,
    before: &State,
) -> Result<(Impact, State), Lost> {
    let table = Table::of(course, one_sided, before)?;
    table.hinges_fit(course)?;
    let mut fitting: Vec<Tried> = Vec::new();
    let mut vague: Vec<Tried> = Vec::new();
    let mut refused = None;
    for set in sets(one_sided, supposed) {
        match table.tried(course, set) {
            Err(lost @ Lost::Contradiction { .. }) => refused = Some(lost),
            Err(lost) => return Err(lost),
            Ok(tried) if supposed.is_some() => fitting.push(tried),
            Ok(tried) => match table.fits(&tried) {
                Some(true) => fitting.push(tried),
                Some(false) => {}
                None => vague.push(tried),
            },
        }
    }
    if fitting.is_empty() {
        fitting = vague;
    }
    if fitting.is_empty() {
        return Err(refused.unwrap_or_else(|| {
            course.contradiction("no set of supports and strings fits the motion it begins with")
        }));
    }
    let after = table.after(course, &fitting, before);
    let impact = table.told(course, &fitting, before, &after);
    Ok((impact, after))
}

/// Sets of those that act.
fn sets(one_sided: &[OneSided], supposed: Option<&[String]>) -> Vec<Vec<usize>> {
    let n = one_sided.len();
    let set = |acts: &dyn Fn(usize) -> bool| (0..n).filter(|i| acts(*i)).collect();
    match supposed {
        Some(names) => vec![set(&|i| names.contains(&one_sided[i].name))],
        None => (0..1usize << n)
            .map(|bits| set(&|i| bits >> i & 1 == 1))
            .collect(),
    }
}

/// A support or string in numbers.
struct Support {
    bodies: [usize; 2],
    at: [f64; 2],
    normal: [f64; 2],
}

/// The equations with one set of supports, solved.
struct Tried {
    set: Vec<usize>,
    system: System<f64>,
    given: Given<f64>,
    found: Found,
}

/// An impact in numbers.
struct Table<'a> {
    given: Given<f64>,
    one_sided: &'a [OneSided],
    supports: Vec<Support>,
    /// The contacts, hinges and blows that stand in `given`, by index in the stage's scene.
    kept: [Vec<usize>; 3],
    /// Supports that stand in the equations.
    kept_supports: Vec<usize>,
    /// Of each body whether anything acts on it in the impact.
    touched: Vec<bool>,
    /// Of each body whether its place is open, or that of a body it is joined to.
    unplaced: Vec<bool>,
    /// Components of velocity that are open before: body, and 0, 1 or 2 for x, y, spin.
    loose: Vec<(usize, usize)>,
    /// The size of speeds, of angular velocities times arms among them.
    speed: f64,
    /// The size of momenta.
    momentum: f64,
    /// The longest arm.
    arm: f64,
}

impl<'a> Table<'a> {
    fn of(
        course: &Course<'_>,
        one_sided: &'a [OneSided],
        before: &State,
    ) -> Result<Table<'a>, Lost> {
        let scene = course.scene;
        let links = links(scene, one_sided);
        let (touched, unplaced) = reached(course, &links, before);
        let keeps = |bodies: &[usize]| bodies.iter().all(|b| !unplaced[*b]);
        let mut part = Scene {
            bodies: scene.bodies.clone(),
            ..Scene::default()
        };
        let mut kept = [Vec::new(), Vec::new(), Vec::new()];
        for (i, c) in scene
            .contacts
            .iter()
            .enumerate()
            .filter(|(_, c)| keeps(&c.bodies))
        {
            kept[0].push(i);
            part.contacts.push(c.clone());
        }
        for (i, h) in scene
            .hinges
            .iter()
            .enumerate()
            .filter(|(_, h)| keeps(&h.bodies))
        {
            kept[1].push(i);
            part.hinges.push(h.clone());
        }
        for (i, b) in scene
            .blows
            .iter()
            .enumerate()
            .filter(|(_, b)| keeps(&[b.body]))
        {
            kept[2].push(i);
            part.blows.push(b.clone());
        }
        part.after = scene
            .after
            .iter()
            .filter(|k| keeps(&[k.body]))
            .cloned()
            .collect();
        let bodies: Vec<GivenBody<f64>> = before
            .bodies
            .iter()
            .zip(course.solids)
            .map(|(body, solid)| body.given(solid))
            .collect();
        let given = around(&part, bodies, course.values).map_err(|u| course.undefined(u))?;
        let mut supports = Vec::new();
        for o in one_sided {
            let is_placed = keeps(&o.bodies);
            let pair = |v, what: &str| match is_placed {
                true => course.pair(v, &format!("{what} of {}", o.name)),
                false => Ok([0.0; 2]),
            };
            supports.push(Support {
                bodies: o.bodies,
                at: pair(&o.at, "position")?,
                normal: pair(&o.normal, "normal")?,
            });
        }
        let kept_supports = (0..one_sided.len())
            .filter(|i| keeps(&one_sided[*i].bodies))
            .collect();
        let mut loose = Vec::new();
        for (b, body) in before.bodies.iter().enumerate() {
            let all = [&body.velocity[0], &body.velocity[1], &body.spin];
            let open = (0..3).filter(|k| all[*k].is_err() && touched[b] && !unplaced[b]);
            loose.extend(open.map(|k| (b, k)));
        }
        let mut table = Table {
            given,
            one_sided,
            supports,
            kept,
            kept_supports,
            touched,
            unplaced,
            loose,
            speed: 0.0,
            momentum: 0.0,
            arm: 0.0,
        };
        table.measure();
        Ok(table)
    }

    /// Finds the sizes that rounding is measured by.
    fn measure(&mut self) {
        let joints = self.given.hinges.iter();
        let joints = joints.chain(self.given.contacts.iter().map(|c| &c.joint));
        let places: Vec<([usize; 2], [f64; 2])> = joints
            .map(|j| (j.bodies, j.at))
            .chain(self.supports.iter().map(|s| (s.bodies, s.at)))
            .chain(self.given.blows.iter().map(|b| ([b.body; 2], b.at)))
            .collect();
        for (b, body) in self.given.bodies.iter().enumerate() {
            if !self.touched[b] || self.unplaced[b] {
                continue;
            }
            let arms = places.iter().filter(|(bodies, _)| bodies.contains(&b));
            let arm = arms.map(|(_, at)| norm(&body.arm(at))).fold(0.0, f64::max);
            let speed = norm(&body.velocity) + body.spin.abs() * arm;
            self.arm = self.arm.max(arm);
            self.speed = self.speed.max(speed);
            self.momentum = self.momentum.max(body.mass * speed);
        }
    }

    /// Bodies joined by a hinge move alike there before.
    fn hinges_fit(&self, course: &Course<'_>) -> Result<(), Lost> {
        for (hinge, i) in self.given.hinges.iter().zip(&self.kept[1]) {
            if hinge
                .bodies
                .iter()
                .any(|b| self.loose.iter().any(|l| l.0 == *b))
            {
                continue;
            }
            let [one, two] = hinge
                .bodies
                .map(|b| self.given.bodies[b].velocity_before(&hinge.at));
            if norm(&difference(&one, &two)) > ROUNDING * self.speed {
                let [first, second] = hinge.bodies.map(|b| &course.solids[b].name);
                return Err(course.contradiction(format!(
                    "`{first}` and `{second}` move differently at the hinge `{}` before",
                    course.scene.hinges[*i].name
                )));
            }
        }
        Ok(())
    }

    /// Solves the equations with these supports acting.
    fn tried(&self, course: &Course<'_>, mut set: Vec<usize>) -> Result<Tried, Lost> {
        set.retain(|i| self.kept_supports.contains(i));
        let mut given = self.given.clone();
        given.contacts.extend(set.iter().map(|i| {
            let s = &self.supports[*i];
            GivenContact {
                joint: Joint {
                    bodies: s.bodies,
                    at: s.at,
                },
                normal: Some(s.normal),
                law: GivenLaw::Frictionless(0.0),
            }
        }));
        let system = assemble(&given);
        let (m, n) = (system.laws.len(), system.unknowns.len());
        let mut matrix = DMatrix::zeros(m, n + self.loose.len());
        for row in 0..m {
            for (column, value) in system.row(row).iter().enumerate() {
                matrix[(row, column)] = *value;
            }
        }
        for (j, (body, k)) in self.loose.iter().enumerate() {
            let unit = assemble(&only(&given, *body, *k));
            for row in 0..m {
                matrix[(row, n + j)] = -unit.right[row];
            }
        }
        match solve(&matrix, &DVector::from_row_slice(&system.right)) {
            Ok(found) => Ok(Tried {
                set,
                system,
                given,
                found,
            }),
            Err(NoSolution::OutOfRange) => {
                Err(course.out_of_reach("the equations of the impact go beyond the doubles"))
            }
            Err(NoSolution::Contradiction(rows)) => {
                let laws = rows
                    .iter()
                    .map(|r| self.words(course, &set, system.laws[*r]));
                let laws: Vec<String> = laws.collect();
                Err(course.contradiction(format!(
                    "no motion after satisfies all laws; {} cannot hold with the others",
                    laws.join(" and ")
                )))
            }
        }
    }

    /// A law in words.
    fn words(&self, course: &Course<'_>, set: &[usize], law: Law) -> String {
        let body = |b: usize| &course.solids[b].name;
        let contact = |c: usize| match self.kept[0].get(c) {
            Some(i) => &course.scene.contacts[*i].name,
            None => &self.one_sided[set[c - self.kept[0].len()]].name,
        };
        match law {
            Law::MomentumX(b) | Law::MomentumY(b) => format!("momentum of `{}`", body(b)),
            Law::AngularMomentum(b) => format!("angular momentum of `{}`", body(b)),
            Law::HingeX(h) | Law::HingeY(h) => {
                format!("the hinge `{}`", course.scene.hinges[self.kept[1][h]].name)
            }
            Law::StickingX(c) | Law::StickingY(c) => format!("sticking at `{}`", contact(c)),
            Law::Restitution(c) => format!("restitution at `{}`", contact(c)),
            Law::Condition(c, _) => format!("friction at `{}`", contact(c)),
            Law::Known(k) => format!("known value {}", k + 1),
        }
    }

    /// Whether the supports in the set act and the others let go; `None` where that is not determined.
    fn fits(&self, tried: &Tried) -> Option<bool> {
        let mut sure = true;
        let largest = tried.impulses().map(f64::abs).fold(self.momentum, f64::max);
        for i in &self.kept_supports {
            if let Some(place) = tried.set.iter().position(|k| k == i) {
                let column = tried.column(Unknown::ContactNormal(self.kept[0].len() + place))?;
                if !tried.found.is_unique(column) {
                    sure = false;
                } else if tried.found.values[column] <= ROUNDING * largest {
                    // A support that touches and does nothing: the smaller set says the same.
                    return Some(false);
                }
                continue;
            }
            let (terms, constant) = tried.opening(&self.supports[*i]);
            let products = terms.iter().map(|(k, f)| f * tried.found.values[*k]);
            let size = products
                .clone()
                .map(f64::abs)
                .fold(self.speed.max(constant.abs()), f64::max);
            if !tried.found.determines(&terms) {
                sure = false;
            } else if constant + products.sum::<f64>() < -ROUNDING * size {
                return Some(false);
            }
        }
        sure.then_some(true)
    }

    /// The state after: what all sets that fit agree on.
    fn after(&self, course: &Course<'_>, fitting: &[Tried], before: &State) -> State {
        let mut after = before.clone();
        let speed = fitting
            .iter()
            .flat_map(Tried::speeds)
            .fold(self.speed, f64::max);
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
                component(Unknown::VelocityX(b), speed),
                component(Unknown::VelocityY(b), speed),
            ];
            if freedom == Freedom::Rigid {
                body.spin = component(Unknown::Spin(b), spin);
            }
        }
        let contacts = course.scene.contacts.iter();
        let sticking = contacts.filter(|c| c.law == crate::scene::ContactLaw::Sticking);
        let joined = sticking.map(|c| c.bodies);
        let joined = joined.chain(course.scene.hinges.iter().map(|h| h.bodies));
        let is_free = |b: &usize| course.solids[*b].freedom != Freedom::Fixed;
        after.joined = joined.filter(|pair| pair.iter().all(is_free)).collect();
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
    fn told(
        &self,
        course: &Course<'_>,
        fitting: &[Tried],
        before: &State,
        after: &State,
    ) -> Impact {
        let scene = course.scene;
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
                    _ => [agreed(Unknown::ContactX(k)), agreed(Unknown::ContactY(k))],
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
                Some(k) => [agreed(Unknown::HingeX(k)), agreed(Unknown::HingeY(k))],
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
            openings: Vec::new(),
            breaches: Vec::new(),
        };
        self.held_against(course, before, after, largest, &mut impact);
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

    /// How fast bodies part, and what cannot be.
    fn held_against(
        &self,
        course: &Course<'_>,
        before: &State,
        after: &State,
        largest: f64,
        impact: &mut Impact,
    ) {
        let placed = self.given.contacts.iter().zip(&self.kept[0]);
        let contacts = placed.filter_map(|(c, i)| {
            let normal = c.normal?;
            let closes = c.law != GivenLaw::None;
            Some((*i, c.joint.bodies, c.joint.at, normal, closes, true))
        });
        let others = course.scene.contacts.len();
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
            if closes && below(&opening.after, SAME * self.speed) {
                impact.breaches.push(Breach::Enters(name));
            }
            impact.openings.push(opening);
        }
    }
}

impl Tried {
    fn column(&self, unknown: Unknown) -> Option<usize> {
        self.system.column(unknown)
    }

    /// The velocity of the second body against the first along the normal: factors of unknowns, and what is prescribed.
    fn opening(&self, support: &Support) -> (Vec<(usize, f64)>, f64) {
        let (mut terms, mut constant) = (Vec::new(), 0.0);
        for (b, sign) in [(support.bodies[1], 1.0), (support.bodies[0], -1.0)] {
            let body = &self.given.bodies[b];
            let n = support.normal.map(|n| sign * n);
            if body.freedom == Freedom::Fixed {
                constant += dot(&n, &body.velocity_before(&support.at));
                continue;
            }
            let lever = cross(&body.arm(&support.at), &n);
            let all = [
                Unknown::VelocityX(b),
                Unknown::VelocityY(b),
                Unknown::Spin(b),
            ];
            for (unknown, factor) in all.into_iter().zip([n[0], n[1], lever]) {
                terms.extend(self.column(unknown).map(|c| (c, factor)));
            }
        }
        (terms, constant)
    }

    fn impulses(&self) -> impl Iterator<Item = f64> {
        self.picked(|u| {
            !matches!(
                u,
                Unknown::VelocityX(_) | Unknown::VelocityY(_) | Unknown::Spin(_)
            )
        })
    }

    fn speeds(&self) -> impl Iterator<Item = f64> {
        let all = self.picked(|u| matches!(u, Unknown::VelocityX(_) | Unknown::VelocityY(_)));
        all.map(f64::abs)
    }

    fn picked(&self, is_wanted: impl Fn(&Unknown) -> bool) -> impl Iterator<Item = f64> {
        let pairs = self.system.unknowns.iter().zip(&self.found.values);
        pairs.filter(move |(u, _)| is_wanted(u)).map(|(_, v)| *v)
    }
}

/// The same scene at rest and without impulses but for one component of velocity, which is 1.
fn only(given: &Given<f64>, body: usize, component: usize) -> Given<f64> {
    let mut out = given.clone();
    for (b, other) in out.bodies.iter_mut().enumerate() {
        let is = |k: usize| f64::from(u8::from(b == body && k == component));
        (other.velocity, other.spin) = ([is(0), is(1)], is(2));
    }
    for blow in &mut out.blows {
        if let GivenImpulse::Whole(p) = &mut blow.impulse {
            *p = [0.0; 2];
        }
    }
    out.known.iter_mut().for_each(|k| k.value = 0.0);
    out
}

/// Bodies that touch, in pairs; a blow or a known value touches its body alone.
fn links(scene: &Scene, one_sided: &[OneSided]) -> Vec<[usize; 2]> {
    let joints = scene.hinges.iter().map(|h| h.bodies);
    let contacts = scene.contacts.iter().map(|c| c.bodies);
    let alone = scene.blows.iter().map(|b| [b.body; 2]);
    let known = scene.after.iter().map(|k| [k.body; 2]);
    let all = joints.chain(contacts).chain(alone).chain(known);
    all.chain(one_sided.iter().map(|o| o.bodies)).collect()
}

/// Of each body whether the impact touches it, and whether it or a body joined to it has no place.
fn reached(course: &Course<'_>, links: &[[usize; 2]], before: &State) -> (Vec<bool>, Vec<bool>) {
    let n = course.solids.len();
    let mut touched = vec![false; n];
    links.iter().flatten().for_each(|b| touched[*b] = true);
    let is_unplaced = |b: usize| {
        let body: &BodyState = &before.bodies[b];
        let without_center = body.center.iter().any(Result::is_err);
        match course.solids[b].freedom {
            // A particle has no arms.
            Freedom::Particle => false,
            Freedom::Rigid => without_center,
            Freedom::Fixed => {
                let is_turning = body.spin != Ok(0.0);
                body.velocity.iter().any(Result::is_err) || (is_turning && without_center)
            }
        }
    };
    let mut unplaced: Vec<bool> = (0..n).map(|b| touched[b] && is_unplaced(b)).collect();
    for _ in 0..n {
        for [a, b] in links {
            let spreads = |from: usize, to: usize, all: &[bool]| {
                all[from] && course.solids[to].freedom != Freedom::Fixed
            };
            if spreads(*a, *b, &unplaced) {
                unplaced[*b] = true;
            }
            if spreads(*b, *a, &unplaced) {
                unplaced[*a] = true;
            }
        }
    }
    (touched, unplaced)
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

/// Velocity of a body's point, component by component.
pub(super) fn velocity_at(freedom: Freedom, body: &BodyState, at: &[f64; 2]) -> [Component; 2] {
    let one = |k: usize, sign: f64| -> Component {
        let v = body.velocity[k].clone()?;
        if freedom == Freedom::Particle || body.spin == Ok(0.0) {
            return Ok(v);
        }
        let arm = at[1 - k] - body.center[1 - k].clone()?;
        if arm == 0.0 {
            return Ok(v);
        }
        Ok(v + sign * body.spin.clone()? * arm)
    };
    [one(0, -1.0), one(1, 1.0)]
}

fn norm(v: &[f64; 2]) -> f64 {
    v[0].hypot(v[1])
}

/// An open component for what several bodies share.
pub(super) fn first_open<'a>(all: impl IntoIterator<Item = &'a Component>) -> Option<&'a Open> {
    all.into_iter().find_map(|c| c.as_ref().err())
}
