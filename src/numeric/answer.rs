//! The numbers a scene's questions ask for, taken from a motion.
//!
//! In: a question, what was given, the motion after. Out: a number or a vector. Knows no formulas but those the question
//! itself brings (points and directions).

use super::energy::{energy_after, energy_before, energy_lost, velocity_after};
use super::friction::{Followed, settle};
use super::given::{Given, GivenImpulse, GivenLaw, Undefined, given, vector};
use super::no_answer::NoAnswer;
use super::solution::{Contradiction, Motion, Solution, motion};
use super::system::{System, Unknown, assemble, motion_of};
use crate::expr::arithmetic::{Number, dot};
use crate::expr::{Point, Vector};
use crate::scene::{Ask, EnergyWhen, ImpulseAt, Scene};

/// What a question is answered with.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer<T> {
    /// One number.
    Scalar(T),
    /// Components along x and y.
    Vector([T; 2]),
}

impl<T> Answer<T> {
    /// The same in another kind of number.
    pub fn map<U>(self, number: impl Fn(T) -> U) -> Answer<U> {
        match self {
            Answer::Scalar(value) => Answer::Scalar(number(value)),
            Answer::Vector(v) => Answer::Vector(v.map(number)),
        }
    }

    /// What is appended to the name of the question, and the number.
    pub fn components(self) -> Vec<(&'static str, T)> {
        match self {
            Answer::Scalar(value) => vec![("", value)],
            Answer::Vector([x, y]) => vec![("_x", x), ("_y", y)],
        }
    }

    /// The number, or the component of a vector along x (0) or y (1).
    pub fn component(self, axis: Option<usize>) -> Option<T> {
        match self {
            Answer::Scalar(value) => Some(value),
            Answer::Vector(v) => v.into_iter().nth(axis?),
        }
    }
}

/// A scene's questions, each with its number or the reason why it has none.
pub type Answered<T> = Vec<(String, Result<Answer<T>, NoAnswer>)>;

/// One impact in numbers.
#[derive(Clone, Debug)]
pub struct Solved<T> {
    /// What the scene gives, with the impulse of a contact with friction as it was found.
    pub given: Given<T>,
    /// What that contact did, where there is one.
    pub followed: Option<Followed<T>>,
    /// The motion just after.
    pub motion: Motion<T>,
}

/// Solves the impact of a scene at a point.
pub fn solved<T: Number + PartialOrd>(
    scene: &Scene,
    at: &Point<T>,
    solve: impl Fn(&System<T>) -> Result<Solution<T>, Contradiction>,
) -> Result<Solved<T>, NoAnswer> {
    let given = given(scene, at).map_err(NoAnswer::Undefined)?;
    let (given, followed) = match settle(&given, &solve)? {
        Some((settled, followed)) => (settled, Some(followed)),
        None => (given, None),
    };
    let system = assemble(&given);
    let solution = solve(&system).map_err(|c| NoAnswer::Contradiction(c.laws(&system)))?;
    Ok(Solved {
        motion: motion(&given, &system, &solution),
        given,
        followed,
    })
}

/// Solves a scene at a point with the given solver and answers every question that asks for a number.
pub fn answers<T: Number + PartialOrd>(
    scene: &Scene,
    at: &Point<T>,
    solve: impl Fn(&System<T>) -> Result<Solution<T>, Contradiction>,
) -> Result<Answered<T>, NoAnswer> {
    let Solved { given, motion, .. } = solved(scene, at, solve)?;
    let numbers = scene
        .asked_of_impact()
        .map(|q| (q.name.clone(), answer(&q.ask, at, &given, &motion)));
    Ok(numbers
        .filter(|(_, a)| !matches!(a, Err(NoAnswer::NotANumber)))
        .collect())
}

/// The number or vector a question asks for.
pub fn answer<T: Number>(
    ask: &Ask,
    at: &Point<T>,
    given: &Given<T>,
    motion: &Motion<T>,
) -> Result<Answer<T>, NoAnswer> {
    let value = |v: &Vector| {
        vector(v, at, || "point or direction asked for".into()).map_err(NoAnswer::Undefined)
    };
    let known = |body: usize| match given.bodies.get(body) {
        Some(_) => Ok(body),
        None => Err(NoAnswer::Undefined(Undefined::missing("body asked for"))),
    };
    match ask {
        Ask::Velocity { body, point, along } => {
            let body = known(*body)?;
            let along = along.as_ref().map(&value).transpose()?;
            // A component may be determined where the other is not.
            let uses = used(along.as_ref());
            let axes = (0..2).filter(|k| uses[*k]);
            let mut needs: Vec<Unknown> = axes.map(|k| Unknown::Velocity(body, k)).collect();
            let velocity = match point {
                // An enclosure minus itself is no exact zero, so the center of mass goes without an arm.
                None => {
                    determined(motion, &needs)?;
                    motion.velocity[body].clone()
                }
                Some((_, at)) => {
                    let point = value(at)?;
                    let arm = given.bodies[body].arm(&point);
                    let swings = |k: usize| uses[k] && !arm[1 - k].is_zero();
                    if swings(0) || swings(1) {
                        needs.push(Unknown::Spin(body));
                    }
                    determined(motion, &needs)?;
                    velocity_after(given, motion, body, &point)
                }
            };
            component(velocity, along)
        }
        Ask::Spin { body, clockwise } => {
            let body = known(*body)?;
            determined(motion, &[Unknown::Spin(body)])?;
            let spin = motion.spin[body].clone();
            Ok(Answer::Scalar(match clockwise {
                true => spin.negated(),
                false => spin,
            }))
        }
        Ask::Impulse { from, on, along } => {
            let along = along.as_ref().map(&value).transpose()?;
            // Two hinges in a row share the pull along it.
            let uses = used(along.as_ref());
            let (impulse, second) = impulse(*from, uses, given, motion)?;
            let felt = match second == *on {
                true => impulse,
                false => [impulse[0].negated(), impulse[1].negated()],
            };
            component(felt, along)
        }
        Ask::Energy { when, of } => {
            if let Some(body) = of {
                known(*body)?;
            }
            if *when != EnergyWhen::Before {
                let bodies = (0..given.bodies.len()).filter(|i| of.is_none_or(|b| b == *i));
                // What has no inertia and is struck by nothing has no energy, however it moves.
                let idle = |u: &Unknown| {
                    let (b, inertia) = match u {
                        Unknown::Spin(b) => (*b, &given.bodies[*b].inertia),
                        Unknown::Velocity(b, _) => (*b, &given.bodies[*b].mass),
                        _ => return false,
                    };
                    inertia.is_zero() && !given.is_struck(b)
                };
                let needs = bodies.flat_map(motion_of).filter(|u| !idle(u));
                determined(motion, &needs.collect::<Vec<_>>())?;
            }
            Ok(Answer::Scalar(match when {
                EnergyWhen::Before => energy_before(given, *of),
                EnergyWhen::After => energy_after(given, motion, *of),
                EnergyWhen::Lost => energy_lost(given, motion, *of),
            }))
        }
        _ => Err(NoAnswer::NotANumber),
    }
}

/// An impulse on its second body, and which body that is.
fn impulse<T: Number>(
    from: ImpulseAt,
    uses: [bool; 2],
    given: &Given<T>,
    motion: &Motion<T>,
) -> Result<([T; 2], usize), NoAnswer> {
    let missing = || NoAnswer::Undefined(Undefined::missing("impulse asked for"));
    let needs = |unknown: fn(usize, usize) -> Unknown, i: usize| {
        let used = (0..2).filter(|axis| uses[*axis]);
        determined(
            motion,
            &used.map(|axis| unknown(i, axis)).collect::<Vec<_>>(),
        )
    };
    match from {
        ImpulseAt::Hinge(i) => {
            let hinge = given.hinges.get(i).ok_or_else(missing)?;
            needs(Unknown::Hinge, i)?;
            Ok((motion.hinge[i].clone(), hinge.bodies[1]))
        }
        ImpulseAt::Contact(i) => {
            let contact = given.contacts.get(i).ok_or_else(missing)?;
            match contact.law {
                GivenLaw::Frictionless(_) => determined(motion, &[Unknown::ContactNormal(i)])?,
                _ => needs(Unknown::Contact, i)?,
            }
            Ok((motion.contact[i].clone(), contact.joint.bodies[1]))
        }
        ImpulseAt::Blow(i) => {
            let blow = given.blows.get(i).ok_or_else(missing)?;
            if let GivenImpulse::Along(_) = blow.impulse {
                determined(motion, &[Unknown::Blow(i)])?;
            }
            Ok((motion.blow[i].clone(), blow.body))
        }
    }
}

fn determined<T>(motion: &Motion<T>, needs: &[Unknown]) -> Result<(), NoAnswer> {
    let open = needs.iter().copied().filter(|u| !motion.determines(*u));
    match open.collect::<Vec<_>>() {
        none if none.is_empty() => Ok(()),
        open => Err(NoAnswer::NotDetermined(open)),
    }
}

/// Which components of a vector its component along a direction is made of.
fn used<T: Number>(along: Option<&[T; 2]>) -> [bool; 2] {
    along.map_or([true; 2], |d| [!d[0].is_zero(), !d[1].is_zero()])
}

fn component<T: Number>(v: [T; 2], along: Option<[T; 2]>) -> Result<Answer<T>, NoAnswer> {
    Ok(match along {
        Some(direction) => Answer::Scalar(dot(&v, &direction)),
        None => Answer::Vector(v),
    })
}
