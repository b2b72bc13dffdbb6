//! The motion after by way of the impulses alone: as many equations as there are impulse components, one to eight.
//!
//! Each free body answers an impulse by itself, so the velocities drop out of the full system and W P = r is left, with
//! W = J M⁻¹ Jᵀ and J the rows of hinges and contacts. In: the numbers of a scene whose impulses are those of hinges,
//! sticking and frictionless contacts and given blows. Out: every unknown, in the order of [`super::assemble`]; `None`
//! for other scenes, whose full system is solved instead.

mod balls;
mod exact;

pub use balls::{Entry, enclosures};
pub use exact::nearest_doubles;

use super::given::{Given, GivenImpulse, GivenLaw};

/// Most impulse components.
const LINES: usize = 8;
/// Most bodies.
const BODIES: usize = 8;

/// Along what a component of an impulse acts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Axis {
    /// x, to the right.
    #[default]
    X,
    /// y, up.
    Y,
    /// The contact's normal.
    Normal,
}

/// A joint and the components of its impulse.
#[derive(Clone, Copy, Debug)]
enum Joint {
    /// A hinge, by index: x and y.
    Hinge(usize),
    /// A sticking contact: x and y.
    Sticking(usize),
    /// A frictionless contact: along the normal.
    Frictionless(usize),
}

impl Joint {
    fn axes(self) -> &'static [Axis] {
        match self {
            Joint::Hinge(_) | Joint::Sticking(_) => &[Axis::X, Axis::Y],
            Joint::Frictionless(_) => &[Axis::Normal],
        }
    }
}

/// Every joint, in the order of the unknowns. Contacts without a law, or with friction, are left out; see [`lines`].
fn joints<T>(given: &Given<T>) -> impl Iterator<Item = Joint> {
    let contacts = given.contacts.iter().enumerate();
    (0..given.hinges.len())
        .map(Joint::Hinge)
        .chain(contacts.filter_map(|(i, c)| match c.law {
            GivenLaw::None | GivenLaw::Friction(_) | GivenLaw::Conditions(_) => None,
            GivenLaw::Sticking => Some(Joint::Sticking(i)),
            GivenLaw::Frictionless(_) => Some(Joint::Frictionless(i)),
        }))
}

/// The number of impulse components where the scene is one of those solved here.
fn lines<T>(given: &Given<T>) -> Option<usize> {
    let whole = |impulse: &GivenImpulse<T>| matches!(impulse, GivenImpulse::Whole(_));
    let fits = given.known.is_empty()
        && given.bodies.len() <= BODIES
        && given.blows.iter().all(|b| whole(&b.impulse));
    let mut count = 2 * given.hinges.len();
    for contact in &given.contacts {
        count += match (&contact.law, &contact.normal) {
            (GivenLaw::Sticking, _) => 2,
            (GivenLaw::Frictionless(_), Some(_)) => 1,
            _ => return None,
        };
    }
    (fits && count <= LINES).then_some(count)
}
