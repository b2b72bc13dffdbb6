//! Several contacts at once: what different laws make of the same impact.
//!
//! In: a scene in doubles whose contacts are smooth, with hinges or without. Out: a candidate for each law. Everything
//! happens in the space of the contacts: u = u⁻ + W P, with the velocities u at which contacts open, the impulses P ≥ 0
//! along the normals, and the response W to unit impulses, found by solving the equations of the scene. Rigid bodies do
//! not decide between the candidates; springs at the contacts do, and which depends on their law of force.
//!
//! Moreau (1988): 0 ≤ P ⊥ u⁺ + e u⁻ ≥ 0. Poisson in the form of Pfeiffer and Glocker (Multibody Dynamics with Unilateral
//! Contacts, 1996): compression 0 ≤ P_c ⊥ u ≥ 0, then at least e P_c more at each contact.

use nalgebra::{DMatrix, DVector};

use super::follow::integrated;
use super::given::{Freedom, Given, GivenBlow, GivenImpulse, GivenLaw};
use super::{assemble, motion, solve_f64};

/// Velocities below this share of the fastest are none.
const REST: f64 = 1e-10;
/// Shares of the energy below this are rounding.
const ROUNDING: f64 = 1e-9;
/// Most contacts: their subsets and orders are tried one by one.
const MOST: usize = 8;
/// Most contacts whose orders are all tried.
const ORDERED: usize = 3;
/// Most impacts of a sequence.
const IMPACTS: usize = 100_000;
/// Length of a piece of a motion on springs, and most pieces; one spring by itself rebounds within 4.
const PIECE: f64 = 0.25;
const PIECES: usize = 4_000;

/// A law for several contacts at once.
#[derive(Clone, Debug, PartialEq)]
pub enum Law {
    /// Every contact opens e times as fast as it closed, also where that takes a pull.
    Newton,
    /// The same at contacts that push; others open at least as fast.
    Moreau,
    /// Each contact gives e times its impulse of compression once more.
    Poisson,
    /// One contact after the other by Newton's law, in this order, again and again until none closes.
    Sequence(Vec<usize>),
    /// Equal linear springs at all contacts.
    LinearSprings,
    /// Equal springs with a force like δ^{3/2}, as between balls (Hertz, 1882).
    HertzSprings,
}

/// What a law gives.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// The laws that give it.
    pub laws: Vec<Law>,
    /// Impulse along the normal of each contact on its second body \[N s\].
    pub impulses: Vec<f64>,
    /// Velocity at which each contact opens [m/s].
    pub openings: Vec<f64>,
    /// Velocity of the center [m/s] and spin [rad/s] of each body.
    pub bodies: Vec<[f64; 3]>,
    /// Kinetic energy before and after \[J\].
    pub energy: [f64; 2],
}

impl Candidate {
    /// Whether energy comes from nowhere.
    pub fn gains_energy(&self) -> bool {
        self.energy[1] > self.energy[0] * (1.0 + ROUNDING)
    }

    /// Whether every contact pushes, none closes further, and no energy is gained.
    pub fn is_possible(&self) -> bool {
        !self.gains_energy() && self.pushes()
    }

    /// Whether every contact pushes and none closes further.
    pub fn pushes(&self) -> bool {
        let small = |all: &[f64]| REST * all.iter().fold(0.0, |a: f64, v| a.max(v.abs()));
        let holds = |all: &[f64]| all.iter().all(|v| *v >= -small(all));
        holds(&self.impulses) && holds(&self.openings)
    }
}

/// Why candidates cannot be laid side by side.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoCandidates {
    /// There are not two to eight smooth contacts, or something else acts at the same time.
    OtherLaws,
    /// The equations have no single solution without the contacts.
    Undetermined,
}

impl std::fmt::Display for NoCandidates {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            NoCandidates::OtherLaws => {
                "laws for several contacts are compared where two to eight are frictionless and nothing else acts but hinges"
            }
            NoCandidates::Undetermined => "what the contacts act on does not have a single motion",
        })
    }
}

impl std::error::Error for NoCandidates {}

/// The space of the contacts.
struct Contacts {
    restitution: Vec<f64>,
    before: DVector<f64>,
    response: DMatrix<f64>,
    /// Motion of the bodies before, and what a unit impulse at each contact adds.
    motion: Vec<[f64; 3]>,
    change: Vec<Vec<[f64; 3]>>,
    inertias: Vec<[f64; 2]>,
}

/// Every candidate; equal ones once, with all their laws.
pub fn candidates(given: &Given<f64>) -> Result<Vec<Candidate>, NoCandidates> {
    let contacts = Contacts::of(given)?;
    let n = contacts.before.len();
    let mut found: Vec<(Law, DVector<f64>)> = Vec::new();
    let mut add = |law: Law, impulses: Option<DVector<f64>>| {
        found.extend(impulses.map(|p| (law, p)));
    };
    add(Law::Newton, contacts.newton());
    add(Law::Moreau, contacts.moreau());
    add(Law::Poisson, contacts.poisson());
    for order in orders(n) {
        add(Law::Sequence(order.clone()), contacts.sequence(&order));
    }
    if contacts.restitution.iter().all(|e| *e == 1.0) {
        add(Law::LinearSprings, contacts.springs(1.0));
        add(Law::HertzSprings, contacts.springs(1.5));
    }
    let mut out: Vec<Candidate> = Vec::new();
    for (law, impulses) in found {
        let candidate = contacts.candidate(law, &impulses);
        match out.iter_mut().find(|c| contacts.same(c, &candidate)) {
            Some(same) => same.laws.extend(candidate.laws),
            None => out.push(candidate),
        }
    }
    Ok(out)
}

impl Contacts {
    fn of(given: &Given<f64>) -> Result<Contacts, NoCandidates> {
        let mut normals = Vec::new();
        let mut restitution = Vec::new();
        for contact in &given.contacts {
            let (GivenLaw::Frictionless(e), Some(n)) = (&contact.law, contact.normal) else {
                return Err(NoCandidates::OtherLaws);
            };
            normals.push(n);
            restitution.push(*e);
        }
        let others = !given.blows.is_empty() || !given.known.is_empty();
        if others || !(2..=MOST).contains(&normals.len()) {
            return Err(NoCandidates::OtherLaws);
        }
        let mut free = given.clone();
        free.contacts.clear();
        let motion = solved(&free)?;
        let mut change = Vec::new();
        for (contact, n) in given.contacts.iter().zip(&normals) {
            let [a, b] = contact.joint.bodies;
            free.blows = [(a, -1.0), (b, 1.0)]
                .into_iter()
                .filter(|(body, _)| given.bodies[*body].freedom != Freedom::Fixed)
                .map(|(body, sign)| GivenBlow {
                    body,
                    at: contact.joint.at,
                    impulse: GivenImpulse::Whole(n.map(|c| sign * c)),
                })
                .collect();
            let after = solved(&free)?;
            let added = after.iter().zip(&motion);
            change.push(
                added
                    .map(|(v, w)| [0, 1, 2].map(|k| v[k] - w[k]))
                    .collect::<Vec<_>>(),
            );
        }
        let opening = |i: usize, motion: &[[f64; 3]]| {
            let contact = &given.contacts[i];
            let [a, b] = contact.joint.bodies.map(|body| {
                let [u, v, w] = motion[body];
                let [x, y] = given.bodies[body].arm(&contact.joint.at);
                [u - w * y, v + w * x]
            });
            (b[0] - a[0]) * normals[i][0] + (b[1] - a[1]) * normals[i][1]
        };
        let n = normals.len();
        Ok(Contacts {
            before: DVector::from_fn(n, |i, _| opening(i, &motion)),
            response: DMatrix::from_fn(n, n, |i, j| opening(i, &change[j])),
            restitution,
            motion,
            change,
            inertias: given.bodies.iter().map(|b| [b.mass, b.inertia]).collect(),
        })
    }

    fn after(&self, impulses: &DVector<f64>) -> DVector<f64> {
        &self.before + &self.response * impulses
    }

    /// (1 + e) u⁻, what Newton's law takes away; where bodies part already there is nothing to turn round.
    fn turned(&self) -> DVector<f64> {
        DVector::from_fn(self.before.len(), |i, _| match self.before[i] {
            parting if parting > 0.0 => parting,
            closing => (1.0 + self.restitution[i]) * closing,
        })
    }

    /// Newton's law at every contact, where none of them parts already.
    fn newton(&self) -> Option<DVector<f64>> {
        if self.before.iter().any(|u| *u > REST * self.before.amax()) {
            return None;
        }
        let lu = self.response.clone().lu();
        let found = lu.solve(&-self.turned())?;
        let gap = (&self.response * &found + self.turned()).amax();
        (found.iter().all(|p| p.is_finite()) && gap <= REST * self.before.amax()).then_some(found)
    }

    fn moreau(&self) -> Option<DVector<f64>> {
        complementary(&self.response, &self.turned())
    }

    fn poisson(&self) -> Option<DVector<f64>> {
        let pressed = complementary(&self.response, &self.before)?;
        let least = DVector::from_fn(pressed.len(), |i, _| {
            (1.0 + self.restitution[i]) * pressed[i]
        });
        let more = complementary(&self.response, &self.after(&least))?;
        Some(least + more)
    }

    fn sequence(&self, order: &[usize]) -> Option<DVector<f64>> {
        let fast = self.before.amax();
        let mut u = self.before.clone();
        let mut impulses = DVector::zeros(u.len());
        for k in 0..IMPACTS {
            let Some(&i) = order
                .iter()
                .cycle()
                .skip(k % order.len())
                .take(order.len())
                .find(|i| u[**i] < -REST * fast)
            else {
                return Some(impulses);
            };
            let p = -(1.0 + self.restitution[i]) * u[i] / self.response[(i, i)];
            impulses[i] += p;
            u += self.response.column(i) * p;
        }
        None
    }

    /// Springs with the force δ^power, in units in which speeds and responses are of ordinary size; all springs being equal,
    /// their stiffness does not matter.
    fn springs(&self, power: f64) -> Option<DVector<f64>> {
        let n = self.before.len();
        let (fast, soft) = (self.before.amax(), self.response.amax());
        let response = &self.response / soft;
        let force = |depth: f64| depth.max(0.0).powf(power);
        // Depths, opening velocities, impulses.
        let rates = |y: &[f64]| {
            let forces = DVector::from_fn(n, |i, _| force(y[i]));
            let gains = &response * &forces;
            let closing = y[n..2 * n].iter().map(|u| -u);
            Some(
                closing
                    .chain(gains.iter().copied())
                    .chain(forces.iter().copied())
                    .collect(),
            )
        };
        let mut state: Vec<f64> = vec![0.0; n];
        state.extend(self.before.iter().map(|u| u / fast));
        state.extend(std::iter::repeat_n(0.0, n));
        for _ in 0..PIECES {
            state = integrated(&rates, &state, PIECE)?;
            let is_over = (0..n).all(|i| state[i] <= 0.0 && state[n + i] >= -REST);
            if is_over {
                return Some(DVector::from_fn(n, |i, _| state[2 * n + i] * fast / soft));
            }
        }
        None
    }

    fn candidate(&self, law: Law, impulses: &DVector<f64>) -> Candidate {
        let component = |b: usize, k: usize| {
            let added = impulses.iter().zip(&self.change).map(|(p, c)| p * c[b][k]);
            let parts = || std::iter::once(self.motion[b][k]).chain(added.clone());
            let (sum, size) = parts().fold((0.0, 0.0), |(s, z), v: f64| (s + v, z + v.abs()));
            // What is left of parts that cancel is rounding.
            if f64::abs(sum) > REST * size {
                sum
            } else {
                0.0
            }
        };
        let bodies = (0..self.motion.len()).map(|b| [0, 1, 2].map(|k| component(b, k)));
        let bodies: Vec<[f64; 3]> = bodies.collect();
        let energy = |all: &[[f64; 3]]| {
            let each = all.iter().zip(&self.inertias);
            let each = each.map(|([u, v, w], [m, i])| 0.5 * (m * (u * u + v * v) + i * w * w));
            each.sum::<f64>()
        };
        Candidate {
            laws: vec![law],
            openings: self.after(impulses).iter().copied().collect(),
            energy: [energy(&self.motion), energy(&bodies)],
            impulses: impulses.iter().copied().collect(),
            bodies,
        }
    }

    /// Whether two candidates are one motion.
    fn same(&self, a: &Candidate, b: &Candidate) -> bool {
        let size = |c: &Candidate| c.impulses.iter().fold(0.0, |s: f64, p| s.max(p.abs()));
        let close = 1e-7 * size(a).max(size(b));
        let change = a.impulses.iter().zip(&b.impulses);
        change.clone().all(|(p, q)| (p - q).abs() <= close) || {
            // Where impulses are not unique, motions may still be one.
            let fast = self.before.amax();
            let gaps = a.bodies.iter().flatten().zip(b.bodies.iter().flatten());
            gaps.into_iter().all(|(u, v)| (u - v).abs() <= 1e-7 * fast)
        }
    }
}

/// Velocity and spin of every body.
fn solved(given: &Given<f64>) -> Result<Vec<[f64; 3]>, NoCandidates> {
    let system = assemble(given);
    let solution = solve_f64(&system).map_err(|_| NoCandidates::Undetermined)?;
    let found = motion(given, &system, &solution);
    let all = found.velocity.iter().zip(&found.spin);
    let all: Vec<[f64; 3]> = all.map(|([u, v], w)| [*u, *v, *w]).collect();
    let is_sound = solution.is_determined() && all.iter().flatten().all(|v| v.is_finite());
    is_sound.then_some(all).ok_or(NoCandidates::Undetermined)
}

/// p ≥ 0 with M p + q ≥ 0 and one of the two zero at each place: the set of places that push is tried out.
fn complementary(m: &DMatrix<f64>, q: &DVector<f64>) -> Option<DVector<f64>> {
    let n = q.len();
    let small = REST * q.amax();
    for bits in 0..1usize << n {
        let pushes = |i: usize| bits >> i & 1 == 1;
        // A contact that does not push has the equation p = 0.
        let rows = DMatrix::from_fn(n, n, |i, j| match pushes(i) {
            true => m[(i, j)],
            false => f64::from(u8::from(i == j)),
        });
        let right = DVector::from_fn(n, |i, _| if pushes(i) { -q[i] } else { 0.0 });
        let Some(p) = rows.lu().solve(&right) else {
            continue;
        };
        let opens = m * &p + q;
        let pushes = p.iter().all(|v| v.is_finite() && *v >= -REST * p.amax());
        if pushes && opens.iter().all(|v| *v >= -small) {
            return Some(p);
        }
    }
    None
}

/// Orders in which contacts take turns: all of few, forwards and backwards of many.
fn orders(n: usize) -> Vec<Vec<usize>> {
    if n > ORDERED {
        return vec![(0..n).collect(), (0..n).rev().collect()];
    }
    let mut out: Vec<Vec<usize>> = vec![Vec::new()];
    for _ in 0..n {
        let longer = out.iter().flat_map(|order| {
            let left = (0..n).filter(|i| !order.contains(i));
            left.map(|i| [order.as_slice(), &[i]].concat())
        });
        out = longer.collect();
    }
    out
}
