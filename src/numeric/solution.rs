//! What solving a system gives: values, which of them are the only possible ones, rank; or a contradiction.

use std::fmt;

use super::given::{Given, GivenImpulse, GivenLaw};
use super::system::{Law, System, Unknown};
use crate::expr::arithmetic::{Number, stretched};

/// A solution of a consistent system.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Solution<T> {
    /// Value of each unknown; where it is not unique, one of many and not to be shown.
    pub values: Vec<T>,
    /// Whether the equations leave each unknown no other value.
    pub unique: Vec<bool>,
    /// Number of independent equations.
    pub rank: usize,
}

impl<T> Solution<T> {
    /// Of a regular system.
    pub fn determined(values: Vec<T>) -> Solution<T> {
        let n = values.len();
        Solution {
            values,
            unique: vec![true; n],
            rank: n,
        }
    }

    /// Whether every unknown is determined.
    pub fn is_determined(&self) -> bool {
        self.unique.iter().all(|u| *u)
    }
}

/// Equations that cannot hold together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Contradiction {
    /// Rows of the system of which a combination reads 0 = 1; empty where rounding hides which.
    pub rows: Vec<usize>,
}

impl fmt::Display for Contradiction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the equations contradict each other (rows {:?})",
            self.rows
        )
    }
}

impl std::error::Error for Contradiction {}

impl Contradiction {
    /// The laws that contradict each other.
    pub fn laws<T>(&self, system: &System<T>) -> Vec<Law> {
        self.rows
            .iter()
            .filter_map(|row| system.laws.get(*row).copied())
            .collect()
    }
}

/// The motion just after and every impulse, by body and joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion<T> {
    /// Velocity of each body's center of mass just after, v_G⁺ [m/s]; the prescribed one for fixed bodies.
    pub velocity: Vec<[T; 2]>,
    /// Angular velocity of each body just after, ω⁺ [rad/s], counterclockwise.
    pub spin: Vec<T>,
    /// Impulse of each hinge on its second body \[N s\].
    pub hinge: Vec<[T; 2]>,
    /// Impulse of each contact on its second body \[N s\].
    pub contact: Vec<[T; 2]>,
    /// Impulse of each blow \[N s\].
    pub blow: Vec<[T; 2]>,
    /// Unknowns the equations do not determine; the values above are then one of many and not to be shown.
    pub loose: Vec<Unknown>,
}

impl<T> Motion<T> {
    /// Whether the equations determine the component.
    pub fn determines(&self, unknown: Unknown) -> bool {
        !self.loose.contains(&unknown)
    }
}

/// Sorts the values of the unknowns by body and joint and adds what was given.
pub fn motion<T: Number>(
    given: &Given<T>,
    system: &System<T>,
    solution: &Solution<T>,
) -> Motion<T> {
    let nothing = || [T::zero(), T::zero()];
    let mut motion = Motion {
        velocity: given.bodies.iter().map(|b| b.velocity.clone()).collect(),
        spin: given.bodies.iter().map(|b| b.spin.clone()).collect(),
        hinge: given.hinges.iter().map(|_| nothing()).collect(),
        contact: given.contacts.iter().map(|_| nothing()).collect(),
        blow: given.blows.iter().map(|_| nothing()).collect(),
        loose: Vec::new(),
    };
    for (i, blow) in given.blows.iter().enumerate() {
        if let GivenImpulse::Whole(impulse) = &blow.impulse {
            motion.blow[i] = impulse.clone();
        }
    }
    for (i, unknown) in system.unknowns.iter().enumerate() {
        let value = solution.values[i].clone();
        match *unknown {
            Unknown::Velocity(b, axis) => motion.velocity[b][axis] = value,
            Unknown::Spin(b) => motion.spin[b] = value,
            Unknown::Hinge(h, axis) => motion.hinge[h][axis] = value,
            Unknown::Contact(c, axis) => motion.contact[c][axis] = value,
            Unknown::ContactNormal(c) => {
                if let (GivenLaw::Frictionless(_), Some(n)) =
                    (&given.contacts[c].law, &given.contacts[c].normal)
                {
                    motion.contact[c] = stretched(n, &value);
                }
            }
            Unknown::Blow(b) => {
                if let GivenImpulse::Along(direction) = &given.blows[b].impulse {
                    motion.blow[b] = stretched(direction, &value);
                }
            }
        }
        if !solution.unique[i] {
            motion.loose.push(*unknown);
        }
    }
    motion
}
