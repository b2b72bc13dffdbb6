//! Kinetic energy before, after and lost; the loss from impulses, never as a difference of large numbers.

use super::given::{Freedom, Given, GivenLaw, Joint};
use super::solution::Motion;
use crate::expr::arithmetic::{Number, difference, dot, total};
use crate::numeric::number::velocity_at;

/// Velocity just after of a body's material point at `point` [m/s].
pub fn velocity_after<T: Number>(
    given: &Given<T>,
    motion: &Motion<T>,
    body: usize,
    point: &[T; 2],
) -> [T; 2] {
    let arm = given.bodies[body].arm(point);
    velocity_at(&motion.velocity[body], &motion.spin[body], &arm)
}

/// Velocity of the second body's point relative to the first body's, just before and just after [m/s].
pub fn relative_velocities<T: Number>(
    given: &Given<T>,
    motion: &Motion<T>,
    bodies: [usize; 2],
    at: &[T; 2],
) -> [[T; 2]; 2] {
    let [a, b] = bodies.map(|i| given.bodies[i].velocity_before(at));
    let [c, d] = bodies.map(|i| velocity_after(given, motion, i, at));
    [difference(&b, &a), difference(&d, &c)]
}

/// Kinetic energy just before of one free body, or of all \[J\]. Fixed bodies have none.
pub fn energy_before<T: Number>(given: &Given<T>, body: Option<usize>) -> T {
    chosen(given, body).fold(T::zero(), |sum, i| {
        let b = &given.bodies[i];
        sum.plus(&kinetic(given, i, &b.velocity, &b.spin))
    })
}

/// Kinetic energy just after of one free body, or of all \[J\].
pub fn energy_after<T: Number>(given: &Given<T>, motion: &Motion<T>, body: Option<usize>) -> T {
    chosen(given, body).fold(T::zero(), |sum, i| {
        sum.plus(&kinetic(given, i, &motion.velocity[i], &motion.spin[i]))
    })
}

/// Kinetic energy lost by one free body, or by all, before − after \[J\]: minus the work of the impulses,
/// each ½ J·(v⁻ + v⁺) at its point (Kelvin; Thomson & Tait).
pub fn energy_lost<T: Number>(given: &Given<T>, motion: &Motion<T>, body: Option<usize>) -> T {
    match body {
        None => lost_by_all(given, motion),
        Some(_) => work(given, motion, body).negated(),
    }
}

/// The loss of all free bodies. A hinge does no work between them, since both of its sides move alike before and after; a normal
/// impulse takes ½ (1−e) P_n (−u_n⁻).
fn lost_by_all<T: Number>(given: &Given<T>, motion: &Motion<T>) -> T {
    let mut lost = T::zero();
    let mut lose = |amount: T| lost = lost.plus(&amount);
    for (contact, impulse) in given.contacts.iter().zip(&motion.contact) {
        let Joint { bodies, at } = &contact.joint;
        let [before, after] = relative_velocities(given, motion, *bodies, at);
        let twice = match (&contact.law, &contact.normal) {
            (GivenLaw::Frictionless(e), Some(n)) => {
                let factor = T::one().minus(e);
                dot(impulse, n).times(&dot(&before, n)).times(&factor)
            }
            (GivenLaw::Sticking, _) => dot(impulse, &before),
            _ => dot(impulse, &total(&before, &after)),
        };
        lose(twice.halved().negated());
        lose(work_on_fixed(given, *bodies, at, impulse));
    }
    for (hinge, impulse) in given.hinges.iter().zip(&motion.hinge) {
        lose(work_on_fixed(given, hinge.bodies, &hinge.at, impulse));
    }
    for (i, blow) in given.blows.iter().enumerate() {
        if given.bodies[blow.body].freedom != Freedom::Fixed {
            let sum = total(
                &given.bodies[blow.body].velocity_before(&blow.at),
                &velocity_after(given, motion, blow.body, &blow.at),
            );
            lose(dot(&motion.blow[i], &sum).halved().negated());
        }
    }
    lost
}

/// The work an impulse does on a body whose motion is prescribed, so that it is not lost but handed over.
fn work_on_fixed<T: Number>(
    given: &Given<T>,
    [one, two]: [usize; 2],
    at: &[T; 2],
    impulse: &[T; 2],
) -> T {
    let on = |body: usize| match given.bodies[body].freedom {
        Freedom::Fixed => dot(impulse, &given.bodies[body].velocity_before(at)),
        _ => T::zero(),
    };
    on(two).minus(&on(one))
}

/// Work of all impulses on one free body, or on all free bodies: Σ ½ J·(v⁻ + v⁺) \[J\].
pub fn work<T: Number>(given: &Given<T>, motion: &Motion<T>, body: Option<usize>) -> T {
    let mut sum = T::zero();
    let mut on = |acted: usize, at: &[T; 2], impulse: &[T; 2], sign: bool| {
        if given.bodies[acted].freedom == Freedom::Fixed || body.is_some_and(|b| b != acted) {
            return;
        }
        let path = total(
            &given.bodies[acted].velocity_before(at),
            &velocity_after(given, motion, acted, at),
        );
        let done = dot(impulse, &path).halved();
        sum = match sign {
            true => sum.plus(&done),
            false => sum.minus(&done),
        };
    };
    let hinges = given.hinges.iter().zip(&motion.hinge);
    let contacts = given.contacts.iter().map(|c| &c.joint).zip(&motion.contact);
    for (joint, impulse) in hinges.chain(contacts) {
        on(joint.bodies[0], &joint.at, impulse, false);
        on(joint.bodies[1], &joint.at, impulse, true);
    }
    for (blow, impulse) in given.blows.iter().zip(&motion.blow) {
        on(blow.body, &blow.at, impulse, true);
    }
    sum
}

/// Energy of the change of velocity of all free bodies, ½ (v⁺−v⁻)ᵀ M (v⁺−v⁻) \[J\].
pub fn energy_of_change<T: Number>(given: &Given<T>, motion: &Motion<T>) -> T {
    chosen(given, None).fold(T::zero(), |sum, i| {
        let b = &given.bodies[i];
        let change = difference(&motion.velocity[i], &b.velocity);
        sum.plus(&kinetic(given, i, &change, &motion.spin[i].minus(&b.spin)))
    })
}

fn kinetic<T: Number>(given: &Given<T>, body: usize, velocity: &[T; 2], spin: &T) -> T {
    let b = &given.bodies[body];
    let moving = b.mass.times(&dot(velocity, velocity));
    let twice = match b.freedom {
        Freedom::Rigid => moving.plus(&b.inertia.times(&spin.times(spin))),
        _ => moving,
    };
    twice.halved()
}

fn chosen<T>(given: &Given<T>, body: Option<usize>) -> impl Iterator<Item = usize> + '_ {
    (0..given.bodies.len())
        .filter(move |i| given.bodies[*i].freedom != Freedom::Fixed && body.is_none_or(|b| b == *i))
}
