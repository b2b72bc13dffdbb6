//! What a scene consists of: given quantities, points, bodies, hinges, contacts, blows, forces, and what is known just after.

use super::geometry::turned;
use super::{Condition, Decided, Friction, ImpulseAt, Scene};
use crate::dimension::{self, Dimension};
use crate::expr::{Expr, Symbol, Vector, minus};

/// A given quantity.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Name in formulas.
    pub name: Symbol,
    /// How it is typeset, such as `\ell`.
    pub latex: Option<String>,
    /// Unit as written, such as `kg m^2`.
    pub unit: String,
    /// Dimension of the unit.
    pub dimension: Dimension,
    /// Value in SI units, exact: 30 mm is 3/100, 30 deg is a sixth of `pi`.
    pub value: Option<Expr>,
    /// What it is, in words.
    pub meaning: String,
}

impl Parameter {
    /// SI value of one unit, such as 1/1000 for mm: a value divided by it is the number to write before the unit.
    pub fn scale(&self) -> Expr {
        dimension::unit(&self.unit).map_or_else(|_| Expr::one(), |unit| unit.value())
    }

    /// Whether it is a plane angle.
    pub fn is_angle(&self) -> bool {
        self.dimension.is_none() && dimension::unit(&self.unit).is_ok_and(|u| u.angle)
    }
}

/// What transmits an impulse to bodies: a contact, a hinge or a blow.
#[derive(Clone, Copy, Debug)]
pub struct Acting<'s> {
    /// Which it is.
    pub from: ImpulseAt,
    /// Its name.
    pub name: &'s String,
    /// Its place \[m\].
    pub at: &'s Vector,
    /// The bodies, by index; of a blow twice the one it acts on.
    pub bodies: [usize; 2],
}

/// A point with a name.
#[derive(Clone, Debug)]
pub struct NamedPoint {
    /// Name, such as `C`.
    pub name: String,
    /// Position \[m\].
    pub at: Vector,
}

/// A rigid body, a particle, or something that does not move because of the collision.
#[derive(Clone, Debug)]
pub struct Body {
    /// Name in the scene.
    pub name: String,
    /// What it looks like, and its inertia.
    pub shape: Shape,
    /// Mass m \[kg\]; zero for a massless link, meaningless for a fixed body.
    pub mass: Expr,
    /// Moment of inertia about the center of mass, I_G [kg m²].
    pub inertia: Expr,
    /// Whether the file gives the moment of inertia itself instead of leaving it to the shape.
    pub inertia_given: bool,
    /// Center of mass G \[m\]; for a fixed body the point its velocity refers to.
    pub center: Vector,
    /// Orientation of the body's long axis, counterclockwise from x \[rad\].
    pub angle: Expr,
    /// Velocity of G just before, v_G⁻ [m/s].
    pub velocity: Vector,
    /// Angular velocity just before, ω⁻ [rad/s], counterclockwise.
    pub spin: Expr,
}

/// Words that need a noun after them in a sentence.
const ADJECTIVES: [&str; 25] = [
    "left", "right", "upper", "lower", "top", "bottom", "mid", "middle", "front", "rear", "back",
    "inner", "outer", "near", "far", "first", "second", "third", "last", "hanging", "small",
    "large", "big", "light", "heavy",
];

/// `the upper body` of `the upper`; what needs no noun stays as it is.
pub fn with_noun(words: String, noun: &str) -> String {
    match words.rsplit(' ').next() {
        Some(last) if ADJECTIVES.contains(&last) => format!("{words} {noun}"),
        _ => words,
    }
}

impl Body {
    /// Velocity just before of its point at this place [m/s], v_G⁻ + ω⁻ × r; a particle has but one.
    pub fn velocity_at(&self, at: &Vector) -> Vector {
        if self.is_particle() || self.spin.is_zero() {
            return self.velocity.clone();
        }
        let [x, y] = turned(&self.spin, &minus(at, &self.center));
        [&self.velocity[0] + x, &self.velocity[1] + y]
    }

    /// Whether its motion is prescribed: ground, walls, pegs.
    pub fn is_fixed(&self) -> bool {
        matches!(self.shape, Shape::Fixed)
    }

    /// Whether its name is a letter.
    pub fn is_lettered(&self) -> bool {
        self.name.len() == 1 && self.name.chars().all(char::is_alphabetic)
    }

    /// What a sentence calls it: `the bar`, `ball 1`, `body A`.
    pub fn called(&self) -> String {
        let name = self.name.replace('_', " ");
        let name = name.trim();
        if name.to_lowercase().starts_with("the ") {
            return name.to_string();
        }
        // Two small letters, such as those of the ends of a rod, are no noun.
        let is_letters = match name.chars().count() {
            1 => true,
            2 => name.chars().all(|c| c.is_lowercase()),
            _ => false,
        };
        if is_letters || ["one", "two", "three", "four"].contains(&name) {
            return format!("body {name}");
        }
        let digits = name.chars().rev().take_while(char::is_ascii_digit).count();
        let count = name.chars().count();
        if digits > 0 && digits < count {
            let word: String = name.chars().take(count - digits).collect();
            let number: String = name.chars().skip(count - digits).collect();
            let word = word.trim();
            return match word.chars().count() {
                1 => format!("body {word}{number}"),
                _ => format!("{word} {number}"),
            };
        }
        match name.chars().next() {
            Some(first) if first.is_uppercase() => name.to_string(),
            _ => with_noun(format!("the {name}"), "body"),
        }
    }

    /// Whether it has no extension, so that neither spin nor moment equation belong to it.
    pub fn is_particle(&self) -> bool {
        matches!(self.shape, Shape::Particle)
    }

    /// Whether it is a pulley without mass: it turns as its strings do, and how it turned before plays no part.
    pub fn is_light_pulley(&self) -> bool {
        matches!(self.shape, Shape::Disk { .. }) && self.mass.is_zero()
    }
}

/// The shapes a scene can name.
#[derive(Clone, Debug)]
pub enum Shape {
    /// Ground, wall, peg; also a wall that moves at a prescribed velocity.
    Fixed,
    /// A point mass.
    Particle,
    /// A uniform thin rod of this length along the body's axis.
    Rod {
        /// Length \[m\].
        length: Expr,
    },
    /// A uniform disk.
    Disk {
        /// Radius \[m\].
        radius: Expr,
    },
    /// A thin ring.
    Ring {
        /// Radius \[m\].
        radius: Expr,
    },
    /// A uniform solid sphere.
    Sphere {
        /// Radius \[m\].
        radius: Expr,
    },
    /// A uniform rectangle.
    Rectangle {
        /// Side along the body's axis \[m\].
        width: Expr,
        /// Side across the body's axis \[m\].
        height: Expr,
    },
    /// Any other body; mass, center and inertia are all that is known.
    Other,
    /// Parts held together rigidly by massless bars.
    Composite {
        /// The parts; only shape, mass, inertia, center and angle of each mean something.
        parts: Vec<Body>,
    },
}

impl Shape {
    /// Radius of a disk, ring or sphere \[m\]; `None` for anything that is not round.
    pub fn radius(&self) -> Option<&Expr> {
        match self {
            Shape::Disk { radius } | Shape::Ring { radius } | Shape::Sphere { radius } => {
                Some(radius)
            }
            _ => None,
        }
    }
}

/// A frictionless hinge between two bodies, of which one may be fixed.
#[derive(Clone, Debug)]
pub struct Hinge {
    /// Name.
    pub name: String,
    /// Indices of the bodies; the reaction is the impulse on the second.
    pub bodies: [usize; 2],
    /// Position \[m\].
    pub at: Vector,
}

/// A point where two bodies collide.
#[derive(Clone, Debug)]
pub struct Contact {
    /// Name.
    pub name: String,
    /// Indices of the bodies; the impulse is the one on the second.
    pub bodies: [usize; 2],
    /// Position \[m\].
    pub at: Vector,
    /// Outward unit normal of the first body.
    pub normal: Option<Vector>,
    /// The law that closes the equations.
    pub law: ContactLaw,
    /// Whether one body goes through the other.
    pub passes: bool,
    /// Whether a taut string pulls here: it may be fastened anywhere on a body, whichever way its outline faces.
    pub is_string: bool,
}

impl Contact {
    /// Velocity just before of the point of the second body relative to that of the first [m/s].
    pub fn relative_velocity(&self, scene: &Scene) -> Vector {
        let [one, two] = self.bodies.map(|b| scene.bodies[b].velocity_at(&self.at));
        minus(&two, &one)
    }
}

/// What is assumed of a collision beyond momentum balance.
#[derive(Clone, Debug, PartialEq)]
pub enum ContactLaw {
    /// None: momentum balance alone.
    None,
    /// The touching points have the same velocity after.
    Sticking,
    /// Impulse along the normal; normal relative velocity after = −e × before.
    Frictionless {
        /// Coefficient of restitution, 0 ≤ e ≤ 1.
        restitution: Expr,
    },
    /// Coulomb friction. It closes the equations only once its mode is known; until then it counts as no law.
    Friction(Box<Friction>),
    /// Friction in one of its modes. No scene file states it.
    Decided(Box<Decided>),
}

impl ContactLaw {
    /// Whether it can gain kinetic energy, which is told beside its cases and bounds no parameter.
    pub fn may_gain(&self) -> bool {
        match self {
            ContactLaw::Friction(law) => law.hypothesis.may_gain(),
            ContactLaw::Decided(decided) => decided.law.hypothesis.may_gain(),
            _ => false,
        }
    }

    /// The conditions of a decided mode of friction.
    pub fn conditions(&self) -> Option<&[Condition; 2]> {
        match self {
            ContactLaw::Decided(decided) => Some(&decided.conditions),
            _ => None,
        }
    }
}

/// An impulse from outside the scene.
#[derive(Clone, Debug)]
pub struct Blow {
    /// Name.
    pub name: String,
    /// Index of the body it acts on.
    pub body: usize,
    /// Point of application \[m\].
    pub at: Vector,
    /// The given impulse [N s], or the direction along which an impulse of unknown size acts.
    pub impulse: BlowImpulse,
}

/// What is known of an impulse from outside.
#[derive(Clone, Debug)]
pub enum BlowImpulse {
    /// Both components [N s].
    Given(Vector),
    /// A direction (unit vector); the magnitude follows from what is known after.
    Along(Vector),
}

/// Something known of the motion just after, in place of a law.
#[derive(Clone, Debug)]
pub struct Known {
    /// Name under which a matrix question takes it as a row; may be empty.
    pub name: String,
    /// Index of the body.
    pub body: usize,
    /// The quantity.
    pub what: KnownQuantity,
    /// Its value just after.
    pub value: Expr,
}

impl Known {
    /// The body that a velocity is counted from.
    pub fn to(&self) -> Option<usize> {
        match self.what {
            KnownQuantity::Velocity { to, .. } => to,
            KnownQuantity::Spin => None,
        }
    }
}

/// What [`Known`] speaks of.
#[derive(Clone, Debug)]
pub enum KnownQuantity {
    /// Component along `along` of the velocity of the body's point at `at` [m/s].
    Velocity {
        /// Point of the body.
        at: Vector,
        /// Direction, a unit vector.
        along: Vector,
        /// Index of the body whose point at the same place the velocity is counted from; `None` for the ground.
        to: Option<usize>,
    },
    /// Angular velocity [rad/s].
    Spin,
}

/// A finite force, which has no impulse in the vanishing time of a collision.
#[derive(Clone, Debug)]
pub struct Force {
    /// Name in words, such as `weight`.
    pub name: String,
    /// Index of the body it acts on.
    pub body: usize,
}
