//! From a scene and a point to the numbers that are given: masses, positions, velocities before, laws.
//!
//! Knows geometry and motion before; knows nothing of equations or of what is asked.

use std::fmt;

use crate::expr::arithmetic::{Number, difference};
use crate::expr::{Expr, Point, Symbol, Vector};
use crate::numeric::number::velocity_at;
use crate::scene::{BlowImpulse, Condition, Contact, ContactLaw, Friction, KnownQuantity, Scene};

/// A scene in numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Given<T> {
    /// The bodies, in the scene's order.
    pub bodies: Vec<GivenBody<T>>,
    /// The hinges, in the scene's order.
    pub hinges: Vec<Joint<T>>,
    /// The contacts, in the scene's order.
    pub contacts: Vec<GivenContact<T>>,
    /// The blows, in the scene's order.
    pub blows: Vec<GivenBlow<T>>,
    /// What is known of the motion after, in the scene's order.
    pub known: Vec<GivenKnown<T>>,
}

impl<T> Given<T> {
    /// Whether an impulse other than that of a hinge can act on a body.
    pub fn is_struck(&self, body: usize) -> bool {
        let touches = |c: &GivenContact<T>| c.joint.bodies.contains(&body);
        self.contacts.iter().any(touches) || self.blows.iter().any(|blow| blow.body == body)
    }
}

/// Which unknowns a body has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Freedom {
    /// None: the motion is prescribed.
    Fixed,
    /// A velocity and no spin.
    Particle,
    /// A velocity and a spin.
    Rigid,
}

/// A body in numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenBody<T> {
    /// Which unknowns it has.
    pub freedom: Freedom,
    /// Mass m \[kg\]; zero for a fixed body, where it means nothing.
    pub mass: T,
    /// Moment of inertia about the center of mass I_G [kg m²]; zero for particles and fixed bodies.
    pub inertia: T,
    /// Center of mass G \[m\].
    pub center: [T; 2],
    /// Velocity of G just before v_G⁻ [m/s].
    pub velocity: [T; 2],
    /// Angular velocity just before ω⁻ [rad/s]; zero for particles.
    pub spin: T,
}

impl<T: Number> GivenBody<T> {
    /// Position of a point relative to G \[m\]; a particle has no arms.
    pub fn arm(&self, point: &[T; 2]) -> [T; 2] {
        match self.freedom {
            Freedom::Particle => [T::zero(), T::zero()],
            _ => difference(point, &self.center),
        }
    }

    /// Velocity just before of the body's material point at `point` [m/s].
    pub fn velocity_before(&self, point: &[T; 2]) -> [T; 2] {
        velocity_at(&self.velocity, &self.spin, &self.arm(point))
    }
}

/// Two bodies and the point where they meet.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint<T> {
    /// Indices of the bodies; the impulse is the one on the second.
    pub bodies: [usize; 2],
    /// Position \[m\].
    pub at: [T; 2],
}

/// A contact in numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenContact<T> {
    /// The bodies and the point.
    pub joint: Joint<T>,
    /// Unit normal out of the first body, where the scene has one.
    pub normal: Option<[T; 2]>,
    /// What closes the equations.
    pub law: GivenLaw<T>,
}

/// A contact law in numbers.
#[derive(Clone, Debug, PartialEq)]
pub enum GivenLaw<T> {
    /// Both impulse components unknown, no equation.
    None,
    /// Both impulse components unknown, equal velocities after.
    Sticking,
    /// Impulse along the normal; coefficient of restitution e.
    Frictionless(T),
    /// Both impulse components unknown; Coulomb friction, which has no equation until its path has been followed.
    Friction(Friction<T>),
    /// Both impulse components unknown, two linear conditions.
    Conditions([Condition<T>; 2]),
}

/// A blow in numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenBlow<T> {
    /// Index of the body.
    pub body: usize,
    /// Point of application \[m\].
    pub at: [T; 2],
    /// The impulse, or its direction.
    pub impulse: GivenImpulse<T>,
}

/// What is given of a blow.
#[derive(Clone, Debug, PartialEq)]
pub enum GivenImpulse<T> {
    /// Both components \[N s\].
    Whole([T; 2]),
    /// Unit vector along which it acts; its size is unknown.
    Along([T; 2]),
}

/// Something known after, in numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenKnown<T> {
    /// Index of the body.
    pub body: usize,
    /// Point and direction of a known velocity component; `None` for a known spin.
    pub component: Option<[[T; 2]; 2]>,
    /// Index of the body whose point there the velocity is counted from.
    pub to: Option<usize>,
    /// The value just after.
    pub value: T,
}

/// Why a scene has no numbers at a point.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Undefined {
    /// The quantity without a value, such as `mass of rod`.
    pub quantity: String,
    /// Why it has none.
    pub reason: Reason,
}

/// The reasons a quantity can lack a value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reason {
    /// These symbols have no value at the point.
    NoValueFor(Vec<Symbol>),
    /// Every symbol has a value, the formula has none in this number type: a division by zero, or √2 as a fraction.
    NotANumber,
    /// The scene does not say it.
    Missing,
}

impl fmt::Display for Undefined {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.quantity)?;
        match &self.reason {
            Reason::NoValueFor(names) => write!(f, "no value for {}", names.join(", ")),
            Reason::NotANumber => f.write_str("has no value in this number type at this point"),
            Reason::Missing => f.write_str("is not given"),
        }
    }
}

impl std::error::Error for Undefined {}

impl Undefined {
    /// What the scene does not say.
    pub fn missing(quantity: impl Into<String>) -> Undefined {
        Undefined {
            quantity: quantity.into(),
            reason: Reason::Missing,
        }
    }
}

/// Every number of the scene at a point, or the first quantity that has none.
pub fn given<T: Number>(scene: &Scene, at: &Point<T>) -> Result<Given<T>, Undefined> {
    let mut bodies = Vec::with_capacity(scene.bodies.len());
    for body in &scene.bodies {
        let name = &body.name;
        let freedom = match () {
            () if body.is_fixed() => Freedom::Fixed,
            () if body.is_particle() => Freedom::Particle,
            () => Freedom::Rigid,
        };
        let scalar = |needed: bool, e: &Expr, what: &str| match needed {
            true => value(e, at, || format!("{what} of {name}")),
            false => Ok(T::zero()),
        };
        bodies.push(GivenBody {
            freedom,
            mass: scalar(freedom != Freedom::Fixed, &body.mass, "mass")?,
            inertia: scalar(
                freedom == Freedom::Rigid,
                &body.inertia,
                "moment of inertia",
            )?,
            center: vector(&body.center, at, || format!("center of {name}"))?,
            velocity: vector(&body.velocity, at, || format!("velocity of {name}"))?,
            spin: scalar(freedom != Freedom::Particle, &body.spin, "spin")?,
        });
    }
    around(scene, bodies, at)
}

/// Hinges, contacts, blows and what is known after, round bodies whose numbers are found.
pub(super) fn around<T: Number>(
    scene: &Scene,
    bodies: Vec<GivenBody<T>>,
    at: &Point<T>,
) -> Result<Given<T>, Undefined> {
    let known_body = |body: usize, whose: &dyn Fn() -> String| match scene.bodies.get(body) {
        Some(_) => Ok(body),
        None => Err(Undefined::missing(whose())),
    };
    let pair = |bodies: [usize; 2], whose: &dyn Fn() -> String| {
        Ok([known_body(bodies[0], whose)?, known_body(bodies[1], whose)?])
    };
    let mut hinges = Vec::with_capacity(scene.hinges.len());
    for hinge in &scene.hinges {
        hinges.push(Joint {
            bodies: pair(hinge.bodies, &|| format!("body of hinge {}", hinge.name))?,
            at: vector(&hinge.at, at, || {
                format!("position of hinge {}", hinge.name)
            })?,
        });
    }
    let mut contacts = Vec::with_capacity(scene.contacts.len());
    for contact in &scene.contacts {
        let name = &contact.name;
        let normal = match &contact.normal {
            Some(n) => Some(vector(n, at, || format!("normal of contact {name}"))?),
            None => None,
        };
        let law = contact_law(contact, at)?;
        let joint = Joint {
            bodies: pair(contact.bodies, &|| format!("body of contact {name}"))?,
            at: vector(&contact.at, at, || format!("position of contact {name}"))?,
        };
        contacts.push(GivenContact { joint, normal, law });
    }
    let mut blows = Vec::with_capacity(scene.blows.len());
    for blow in &scene.blows {
        let name = &blow.name;
        blows.push(GivenBlow {
            body: known_body(blow.body, &|| format!("body of blow {name}"))?,
            at: vector(&blow.at, at, || format!("position of blow {name}"))?,
            impulse: match &blow.impulse {
                BlowImpulse::Given(q) => {
                    GivenImpulse::Whole(vector(q, at, || format!("impulse of blow {name}"))?)
                }
                BlowImpulse::Along(d) => {
                    GivenImpulse::Along(vector(d, at, || format!("direction of blow {name}"))?)
                }
            },
        });
    }
    let mut known = Vec::with_capacity(scene.after.len());
    for (i, row) in scene.after.iter().enumerate() {
        let body = known_body(row.body, &|| format!("body of known value {}", i + 1))?;
        let name = &scene.bodies[body].name;
        let component = match &row.what {
            KnownQuantity::Spin => None,
            KnownQuantity::Velocity {
                at: point, along, ..
            } => Some([
                vector(point, at, || format!("point of a known velocity of {name}"))?,
                vector(along, at, || {
                    format!("direction of a known velocity of {name}")
                })?,
            ]),
        };
        let to = match row.to() {
            Some(to) => Some(known_body(to, &|| format!("body that {name} leaves"))?),
            None => None,
        };
        known.push(GivenKnown {
            body,
            component,
            to,
            value: value(&row.value, at, || format!("known motion of {name}"))?,
        });
    }
    Ok(Given {
        bodies,
        hinges,
        contacts,
        blows,
        known,
    })
}

/// The law of a contact in numbers.
fn contact_law<T: Number>(contact: &Contact, at: &Point<T>) -> Result<GivenLaw<T>, Undefined> {
    let name = &contact.name;
    Ok(match &contact.law {
        ContactLaw::None => GivenLaw::None,
        ContactLaw::Sticking => GivenLaw::Sticking,
        ContactLaw::Decided(decided) => {
            let read = |c: &Condition| {
                c.try_map(|e| value(e, at, || format!("condition at contact {name}")))
            };
            let [one, two] = &decided.conditions;
            GivenLaw::Conditions([read(one)?, read(two)?])
        }
        ContactLaw::Friction(law) => GivenLaw::Friction(
            law.try_map(|e| value(e, at, || format!("friction of contact {name}")))?,
        ),
        ContactLaw::Frictionless { restitution } => {
            if contact.normal.is_none() {
                return Err(Undefined::missing(format!("normal of contact {name}")));
            }
            GivenLaw::Frictionless(value(restitution, at, || {
                format!("restitution of contact {name}")
            })?)
        }
    })
}

pub(super) fn value<T: Number>(
    e: &Expr,
    at: &Point<T>,
    quantity: impl Fn() -> String,
) -> Result<T, Undefined> {
    if let Some(value) = e.evaluate(at) {
        return Ok(value);
    }
    let mut missing: Vec<Symbol> = e.symbols().into_iter().collect();
    missing.retain(|name| !at.values.contains_key(name) && !at.directions.contains_key(name));
    let reason = if missing.is_empty() {
        Reason::NotANumber
    } else {
        Reason::NoValueFor(missing)
    };
    Err(Undefined {
        quantity: quantity(),
        reason,
    })
}

pub(super) fn vector<T: Number>(
    v: &Vector,
    at: &Point<T>,
    quantity: impl Fn() -> String + Copy,
) -> Result<[T; 2], Undefined> {
    Ok([value(&v[0], at, quantity)?, value(&v[1], at, quantity)?])
}
