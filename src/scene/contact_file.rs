//! What acts on bodies, as a scene file writes it: hinges, contacts with their laws, blows, what is known after, forces.

use super::fault::Span;
use super::place_file::{DirectionFile, PositionFile};
use super::record::{Formula, Pair, Text, choice, record};

record! {
    /// A frictionless hinge between two bodies.
    HingeFile {
        /// Names of the two bodies; one may be fixed. The reaction is the impulse on the second.
        bodies: Pair<Text>,
        /// Where it is.
        at: PositionFile,
    }
}

choice! {
    /// What is assumed of a collision beyond momentum balance.
    pub(super) LawName {
        /// The touching points have the same velocity after.
        Sticking = "sticking",
        /// The impulse is along the normal; the normal relative velocity after is -e times that before.
        Frictionless = "frictionless",
        /// Coulomb friction: `mu`, `restitution` and `hypothesis`. The answers depend on whether the contact slides, sticks or
        /// reverses its slip; values decide, and symbols give one answer for each case.
        Friction = "friction",
    }
}

choice! {
    /// What the coefficient of restitution e means where there is friction.
    pub(super) HypothesisName {
        /// Kinematic: the normal relative velocity after is -e times that before. Energy may grow.
        Newton = "newton",
        /// Kinetic: the normal impulse of restitution is e times that of compression.
        Poisson = "poisson",
        /// Energetic: the normal work of restitution is -e^2 times that of compression.
        Stronge = "stronge",
        /// Chatterjee and Ruina 1998: two coefficients, e and `tangential_restitution`; the impulse stays in the friction cone.
        ChatterjeeRuina = "chatterjee-ruina",
        /// Brach: normal restitution e and a ratio of tangential to normal impulse, `impulse_ratio`. Energy may grow.
        Brach = "brach",
    }
}

choice! {
    /// What a contact with friction is supposed to do; carom tells when that is so.
    pub(super) SupposedName {
        /// It slips in one direction throughout.
        Slides = "slides",
        /// It does not slip just after.
        Sticks = "sticks",
        /// Slip ends during compression, and the contact sticks.
        SticksInCompression = "sticks in compression",
        /// Slip ends during restitution, and the contact sticks.
        SticksInRestitution = "sticks in restitution",
        /// Slip ends during compression and goes on the other way.
        ReversesInCompression = "reverses in compression",
        /// Slip ends during restitution and goes on the other way.
        ReversesInRestitution = "reverses in restitution",
        /// The impulse of Chatterjee and Ruina lies inside the friction cone.
        InsideCone = "inside the cone",
        /// The impulse of Chatterjee and Ruina lies on the friction cone.
        OnCone = "on the cone",
    }
}

record! {
    /// A point where two bodies collide.
    ContactFile {
        /// Names of the two bodies; one may be fixed. The impulse is the one on the second.
        bodies: Pair<Text>,
        /// Where they touch. Missing: where the particle of the two is, or where the normal, or the line to the center of another
        /// round body, leaves what is round.
        at: Option<PositionFile>,
        /// Unit normal, out of the first body into the second. Missing between what is round and another such body or a
        /// particle: along the line of their centers.
        normal: Option<DirectionFile>,
        /// The law that closes the equations. Missing: none, and carom tells what remains undetermined.
        law: Option<LawName>,
        /// Coefficient of restitution e of a frictionless contact or of one with friction, from 0 to 1.
        restitution: Option<Formula>,
        /// Coefficient of friction, 0 or greater.
        mu: Option<Formula>,
        /// What the restitution of a contact with friction means. Missing: "poisson".
        hypothesis: Option<HypothesisName>,
        /// Tangential restitution of "chatterjee-ruina", from -1 to 1. Missing: 0, no slip where the cone allows it.
        tangential_restitution: Option<Formula>,
        /// Ratio of tangential to normal impulse of "brach"; the tangent is the normal turned clockwise by 90 degrees.
        /// Missing: the ratio that ends the slip, at most `mu` in size.
        impulse_ratio: Option<Formula>,
        /// Whether one body goes through the other here, as a bullet that comes out behind: of a contact without law, whose impulse
        /// follows from what is known `after`.
        passes: Option<bool>,
        /// What the contact does, if the answer for this one case is wanted.
        supposing: Option<SupposedName>,
    }
}

impl ContactFile {
    /// Of these bodies, with nothing said of it.
    pub(super) fn between(span: Span, bodies: Pair<Text>) -> ContactFile {
        ContactFile {
            span,
            bodies,
            at: None,
            normal: None,
            law: None,
            restitution: None,
            mu: None,
            hypothesis: None,
            tangential_restitution: None,
            impulse_ratio: None,
            passes: None,
            supposing: None,
        }
    }
}

record! {
    /// An impulse from outside: either given, or of unknown size along a direction.
    BlowFile {
        /// Name of the body it acts on.
        on: Text,
        /// Where it acts.
        at: PositionFile,
        /// Components of a given impulse.
        impulse: Option<Pair<Formula>>,
        /// Direction of an impulse of unknown size.
        along: Option<DirectionFile>,
    }
}

record! {
    /// Something known just after: a velocity component, or a spin.
    KnownFile {
        /// Name under which a matrix question takes it as a row.
        name: Option<Text>,
        /// Name of the body whose velocity is known.
        velocity: Option<Text>,
        /// Point of that body. Missing: its center of mass.
        at: Option<PositionFile>,
        /// Direction of the known component.
        along: Option<DirectionFile>,
        /// Name of another body from which the velocity is counted, as that of a shell from its gun: of the point of that body
        /// at the same place. Missing: the ground.
        relative_to: Option<Text>,
        /// Name of the body whose spin is known.
        spin: Option<Text>,
        /// The value.
        is: Formula,
    }
}

record! {
    /// A finite force.
    ForceFile {
        /// What it is, such as "weight".
        name: Text,
        /// Name of the body it acts on.
        on: Text,
    }
}
