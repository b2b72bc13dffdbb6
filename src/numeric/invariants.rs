//! What must hold of any motion after a collision, checked from the numbers alone.
//!
//! In: what was given and a motion, from whatever source. Out: identities with both sides, and what each contact says
//! of its admissibility. Balances are formed for systems of bodies, with only the impulses that cross the system's
//! boundary, and about points other than the centers of mass: not the rows that were solved.

use super::energy::{
    energy_after, energy_before, energy_lost, energy_of_change, relative_velocities,
    velocity_after, work,
};
use super::given::{Freedom, Given, GivenContact, GivenLaw, Joint};
use super::solution::Motion;
use crate::expr::arithmetic::{Number, cross, difference, dot};

/// What an identity states. Bodies, contacts and hinges by index.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Invariant {
    /// Momentum of a system of bodies along x (0) or y (1), after = before + impulses from outside the system.
    Momentum(Vec<usize>, usize),
    /// Angular momentum of a system about the n-th of the points tried, after = before + moments of outside impulses.
    AngularMomentum(Vec<usize>, usize),
    /// Both sides of a hinge have the same velocity after, along x (0) or y (1).
    Hinge(usize, usize),
    /// Both sides of a hinge had the same velocity before; if not, the scene itself is inconsistent.
    HingeBefore(usize, usize),
    /// Touching points of a sticking contact have the same velocity after, along x (0) or y (1).
    Sticking(usize, usize),
    /// Normal relative velocity after = −e × before.
    Restitution(usize),
    /// The impulse of a frictionless contact has no tangential component.
    NoFriction(usize),
    /// A value known after.
    Known(usize),
    /// T after − T before = Σ ½ J·(v⁻ + v⁺) over all impulses on free bodies.
    EnergyIsWork,
    /// The loss formed from impulses = T before − T after.
    EnergyLost,
    /// Carnot: loss = (1−e)/(1+e) × energy of the change of velocity; sticking counts as e = 0.
    Carnot,
    /// With e = 1 everywhere nothing is lost.
    Lossless,
}

/// Two sides that should be equal.
#[derive(Clone, Debug, PartialEq)]
pub struct Identity<T> {
    /// What it states.
    pub what: Invariant,
    /// Left side.
    pub left: T,
    /// Right side.
    pub right: T,
    /// Size of the terms the sides are made of, the ruler for rounding errors.
    pub size: f64,
}

impl<T: Number> Identity<T> {
    /// Whether the sides agree to within `tolerance` × size of their terms; 0 asks for equality.
    pub fn holds(&self, tolerance: f64) -> bool {
        let gap = self.left.minus(&self.right);
        gap.is_zero() || gap.size() <= tolerance * self.size
    }
}

/// Every identity the motion has to fulfil.
pub fn identities<T: Number>(given: &Given<T>, motion: &Motion<T>) -> Vec<Identity<T>> {
    let mut list = Vec::new();
    balances(given, motion, &mut list);
    laws(given, motion, &mut list);
    energies(given, motion, &mut list);
    list
}

/// A sum that remembers how large its terms were.
struct Sum<T>(T, f64);

impl<T: Number> Sum<T> {
    fn new() -> Sum<T> {
        Sum(T::zero(), 0.0)
    }
    fn add(&mut self, term: T) {
        self.1 += term.size();
        self.0 = self.0.plus(&term);
    }
}

fn identity<T>(what: Invariant, left: Sum<T>, right: Sum<T>) -> Identity<T> {
    Identity {
        what,
        left: left.0,
        right: right.0,
        size: left.1 + right.1,
    }
}

/// Momentum and angular momentum: each free body, all of them, and all but one.
fn balances<T: Number>(given: &Given<T>, motion: &Motion<T>, list: &mut Vec<Identity<T>>) {
    let free: Vec<usize> = (0..given.bodies.len())
        .filter(|i| given.bodies[*i].freedom != Freedom::Fixed)
        .collect();
    let mut systems: Vec<Vec<usize>> = free.iter().map(|i| vec![*i]).collect();
    if free.len() > 1 {
        systems.push(free.clone());
    }
    if free.len() > 2 {
        let others = |i| free.iter().copied().filter(|j| j != i).collect();
        systems.extend(free.iter().map(others));
    }
    let mut points = vec![[T::zero(), T::zero()]];
    points.extend(given.hinges.iter().map(|h| h.at.clone()));
    points.extend(given.contacts.iter().map(|c| c.joint.at.clone()));
    let (one, two) = (T::one(), T::one().plus(&T::one()));
    points.push([two.plus(&one), two.negated()]);
    for system in &systems {
        let outside = outside_impulses(given, motion, system);
        for axis in 0..2 {
            let (mut left, mut right) = (Sum::new(), Sum::new());
            for &i in system {
                let b = &given.bodies[i];
                left.add(b.mass.times(&motion.velocity[i][axis]));
                right.add(b.mass.times(&b.velocity[axis]));
            }
            for (_, _, impulse) in &outside {
                right.add(impulse[axis].clone());
            }
            let what = Invariant::Momentum(system.clone(), axis);
            list.push(identity(what, left, right));
        }
        for (k, point) in points.iter().enumerate() {
            let (mut left, mut right) = (Sum::new(), Sum::new());
            for &i in system {
                let b = &given.bodies[i];
                let arm = difference(&b.center, point);
                left.add(b.mass.times(&cross(&arm, &motion.velocity[i])));
                right.add(b.mass.times(&cross(&arm, &b.velocity)));
                if b.freedom == Freedom::Rigid {
                    left.add(b.inertia.times(&motion.spin[i]));
                    right.add(b.inertia.times(&b.spin));
                }
            }
            for (body, at, impulse) in &outside {
                let b = &given.bodies[*body];
                let acts_at = if b.freedom == Freedom::Particle {
                    &b.center
                } else {
                    at
                };
                right.add(cross(&difference(acts_at, point), impulse));
            }
            let what = Invariant::AngularMomentum(system.clone(), k);
            list.push(identity(what, left, right));
        }
    }
}

/// Impulses that act on a body of the system from outside it: body, point, impulse.
fn outside_impulses<T: Number>(
    given: &Given<T>,
    motion: &Motion<T>,
    system: &[usize],
) -> Vec<(usize, [T; 2], [T; 2])> {
    let mut list = Vec::new();
    let hinges = given.hinges.iter().zip(&motion.hinge);
    let contacts = given.contacts.iter().map(|c| &c.joint).zip(&motion.contact);
    for (joint, impulse) in hinges.chain(contacts) {
        // What acts between two extended bodies of the system cancels; a particle takes it at its own center.
        let [one, two] = joint.bodies;
        let extended = |i: usize| given.bodies[i].freedom != Freedom::Particle;
        if system.contains(&one) && system.contains(&two) && extended(one) && extended(two) {
            continue;
        }
        if system.contains(&one) {
            let back = [impulse[0].negated(), impulse[1].negated()];
            list.push((one, joint.at.clone(), back));
        }
        if system.contains(&two) {
            list.push((two, joint.at.clone(), impulse.clone()));
        }
    }
    for (blow, impulse) in given.blows.iter().zip(&motion.blow) {
        if system.contains(&blow.body) {
            list.push((blow.body, blow.at.clone(), impulse.clone()));
        }
    }
    list
}

/// Hinge conditions, contact laws and known values.
fn laws<T: Number>(given: &Given<T>, motion: &Motion<T>, list: &mut Vec<Identity<T>>) {
    let single = |v: &T| {
        let mut sum = Sum::new();
        sum.add(v.clone());
        sum
    };
    let mut same = |what: Invariant, left: &T, right: &T| {
        list.push(identity(what, single(left), single(right)))
    };
    for (i, Joint { bodies, at }) in given.hinges.iter().enumerate() {
        let [one, two] = bodies.map(|b| velocity_after(given, motion, b, at));
        let [one_before, two_before] = bodies.map(|b| given.bodies[b].velocity_before(at));
        for axis in 0..2 {
            let before = Invariant::HingeBefore(i, axis);
            same(Invariant::Hinge(i, axis), &two[axis], &one[axis]);
            same(before, &two_before[axis], &one_before[axis]);
        }
    }
    for (i, contact) in given.contacts.iter().enumerate() {
        let Joint { bodies, at } = &contact.joint;
        let [one, two] = bodies.map(|b| velocity_after(given, motion, b, at));
        match (&contact.law, &contact.normal) {
            (GivenLaw::Sticking, _) => {
                for axis in 0..2 {
                    same(Invariant::Sticking(i, axis), &two[axis], &one[axis]);
                }
            }
            (GivenLaw::Frictionless(e), Some(n)) => {
                let [before, _] = relative_velocities(given, motion, *bodies, at);
                let target = e.times(&dot(&before, n));
                let what = Invariant::Restitution(i);
                same(what, &dot(&two, n).plus(&target), &dot(&one, n));
                let [x, y] = &motion.contact[i];
                same(Invariant::NoFriction(i), &x.times(&n[1]), &y.times(&n[0]));
            }
            _ => {}
        }
    }
    for (i, known) in given.known.iter().enumerate() {
        let actual = match &known.component {
            None => motion.spin[known.body].clone(),
            Some([point, along]) => {
                let velocity = |body| dot(along, &velocity_after(given, motion, body, point));
                let own = velocity(known.body);
                known.to.map_or(own.clone(), |to| own.minus(&velocity(to)))
            }
        };
        same(Invariant::Known(i), &actual, &known.value);
    }
}

fn energies<T: Number>(given: &Given<T>, motion: &Motion<T>, list: &mut Vec<Identity<T>>) {
    let before = energy_before(given, None);
    let after = energy_after(given, motion, None);
    let work = work(given, motion, None);
    let size = before.size() + after.size() + work.size();
    let gain = after.minus(&before);
    let mut claim = |what, left, right| {
        list.push(Identity {
            what,
            left,
            right,
            size,
        })
    };
    claim(Invariant::EnergyIsWork, gain.clone(), work);
    let lost = energy_lost(given, motion, None);
    claim(Invariant::EnergyLost, lost.clone(), gain.negated());
    if let Some(e) = one_restitution(given, motion) {
        // Loss as seen from the walls: what they take or give is not lost.
        let contacts = given.contacts.iter().zip(&motion.contact);
        let lost = contacts.fold(T::zero(), |sum, (contact, impulse)| {
            let Joint { bodies, at } = &contact.joint;
            let [a, b] = relative_velocities(given, motion, *bodies, at);
            sum.minus(&dot(impulse, &a).plus(&dot(impulse, &b)).halved())
        });
        let change = energy_of_change(given, motion);
        let left = lost.times(&T::one().plus(&e));
        claim(Invariant::Carnot, left, change.times(&T::one().minus(&e)));
        if T::one().minus(&e).is_zero() {
            claim(Invariant::Lossless, lost, T::zero());
        }
    }
}

/// The one coefficient of restitution of all contacts, if Carnot's theorem applies: nothing but contacts acts from
/// outside, and the hinges were consistent before.
fn one_restitution<T: Number>(given: &Given<T>, motion: &Motion<T>) -> Option<T> {
    let mut one: Option<T> = None;
    for contact in &given.contacts {
        let e = match &contact.law {
            GivenLaw::None | GivenLaw::Friction(_) | GivenLaw::Conditions(_) => return None,
            GivenLaw::Sticking => T::zero(),
            GivenLaw::Frictionless(e) => e.clone(),
        };
        if one.as_ref().is_some_and(|first| !first.minus(&e).is_zero()) {
            return None;
        }
        one = Some(e);
    }
    let quiet = given.blows.is_empty() && given.known.is_empty();
    let consistent = given.hinges.iter().all(|h| {
        let [[x, y], _] = relative_velocities(given, motion, h.bodies, &h.at);
        let own = given.bodies[h.bodies[0]].velocity_before(&h.at);
        let size = own.iter().map(Number::size).sum::<f64>();
        let vanishes = |v: &T| v.is_zero() || v.size() <= 1e-12 * size;
        vanishes(&x) && vanishes(&y)
    });
    one.filter(|_| quiet && consistent)
}

/// What a contact with a normal says of itself.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactReport<T> {
    /// Whether the touching points move apart just before: no collision here.
    pub separates: bool,
    /// Friction coefficient the answer needs, |P_t| / P_n; `None` where P_n is not positive.
    pub required_friction: Option<T>,
}

/// The report of each contact; `None` for one without a normal.
pub fn contact_reports<T: Number + PartialOrd>(
    given: &Given<T>,
    motion: &Motion<T>,
) -> Vec<Option<ContactReport<T>>> {
    let zero = T::zero();
    let contacts = given.contacts.iter().zip(&motion.contact);
    let report = |(contact, impulse): (&GivenContact<T>, &[T; 2])| {
        let n = contact.normal.as_ref()?;
        let Joint { bodies, at } = &contact.joint;
        let [before, _] = relative_velocities(given, motion, *bodies, at);
        let (normal, tangent) = (dot(impulse, n), cross(impulse, n));
        let size = if tangent < zero {
            tangent.negated()
        } else {
            tangent
        };
        let is_pushed = normal > zero;
        Some(ContactReport {
            separates: dot(&before, n) > zero,
            required_friction: is_pushed
                .then(|| normal.recip())
                .flatten()
                .map(|r| size.times(&r)),
        })
    };
    contacts.map(report).collect()
}
