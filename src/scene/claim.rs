//! What a scene relies on, to be checked when everything is read.

use super::fault::Span;
use super::touch::Placed;
use crate::expr::{Expr, Symbol, Vector};

/// Something a scene relies on.
pub(super) enum Claim {
    /// A unit vector.
    Unit(Vector),
    /// A number from 0 to 1.
    Fraction(Expr),
    /// A coefficient of friction: 0 or greater.
    Friction(Expr),
    /// A number of turns is whole, where it is given.
    Whole(Symbol),
    /// The size of gravity: 0 or greater.
    Gravity(Expr),
    /// A tangential restitution: from -1 to 1.
    Tangential(Expr),
    /// A mass, length or inertia is positive.
    Size {
        size: Expr,
        what: &'static str,
        may_vanish: bool,
    },
    /// What touches a particle touches it where it is.
    AtParticle {
        offset: Vector,
        at: String,
        body: usize,
    },
    /// The bodies of this contact do not separate.
    Approach(usize),
    /// This contact, blow or hinge lies on its bodies.
    Placed(Placed),
    /// Both bodies of this hinge move alike there.
    Hinge(usize),
    /// The bodies of this contact do not strike, for another one has friction.
    Rests(usize),
}

/// A claim and the place in the file that makes it.
pub(super) struct Claimed {
    pub span: Span,
    pub claim: Claim,
}
