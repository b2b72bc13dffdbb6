//! The laws a scene obeys, as named linear equations in what is unknown just after the collision.
//!
//! Signs, told once: x to the right, y up, counterclockwise positive. A contact normal points out of the first body into
//! the second; the impulse of a contact or hinge is the one **on the second body**, its opposite acts on the first.
//! Positions are frozen during the collision, so the same arms stand on both sides; finite forces have no impulse.
//!
//! Balance of linear momentum of a system along d:         Σ m (v⁺ − v⁻)·d = Σ P·d
//! Balance of angular momentum of a system about O:        Σ [ I (ω⁺ − ω⁻) + r_{G/O} × m (v⁺ − v⁻) ] = Σ r_{Q/O} × P
//! with the impulses P from outside the system (17.57). Contact laws and joints add conditions on velocities after.
//!
//! Every equation is written over any [`Number`]: symbolically for the derivation, in doubles for planning it. This
//! module solves nothing and chooses nothing.

mod affine;
pub mod friction;
mod words;

pub use affine::{Affine, Linear};
pub use words::{body_list, describe, place as place_name};

use std::convert::Infallible;

use crate::expr::arithmetic::{Number, difference};
use crate::expr::{Expr, Vector};
use crate::scene::{BlowImpulse, Condition, ContactLaw, ImpulseAt, KnownQuantity, Scene};

/// One scalar that is not known before the equations are solved.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Unknown {
    /// Component (0: x, 1: y) of the velocity of a body's center of mass just after, v_G⁺ [m/s].
    Velocity(usize, usize),
    /// Angular velocity of a body just after, ω⁺ [rad/s].
    Spin(usize),
    /// Component of the impulse of a contact on its second body [N s].
    Contact(usize, usize),
    /// Size of the impulse of a frictionless contact along its normal [N s].
    Normal(usize),
    /// Component of the impulse of a hinge on its second body [N s].
    Hinge(usize, usize),
    /// Size of a blow of known direction [N s].
    Blow(usize),
}

impl Unknown {
    /// Whether it is an impulse rather than a velocity.
    pub fn is_impulse(self) -> bool {
        !matches!(self, Unknown::Velocity(..) | Unknown::Spin(_))
    }
}

/// A law applied to a body or system, at a point or along a direction.
#[derive(Clone, PartialEq, Debug)]
pub enum Law {
    /// Balance of linear momentum of the bodies along a direction.
    LinearMomentum {
        /// Indices of the bodies.
        system: Vec<usize>,
        /// Direction, a unit vector.
        along: Direction,
    },
    /// Balance of angular momentum of the bodies about a point.
    AngularMomentum {
        /// Indices of the bodies.
        system: Vec<usize>,
        /// Moment point.
        about: Place,
    },
    /// Normal relative velocity after = −e × before, at a contact.
    Restitution(usize),
    /// Equal velocities after of the touching points of a contact, component 0 or 1.
    Sticking(usize, usize),
    /// Equal velocities after of the two points joined by a hinge, component 0 or 1.
    Hinged(usize, usize),
    /// Condition 0 or 1 of a decided mode of friction at a contact.
    Condition(usize, usize),
    /// Something known of the motion after, by its index in the scene.
    Given(usize),
}

impl Law {
    /// Balance of linear momentum of some bodies.
    pub fn linear(system: &[usize], along: Direction) -> Law {
        Law::LinearMomentum {
            system: system.to_vec(),
            along,
        }
    }

    /// Balance of angular momentum of some bodies.
    pub fn angular(system: &[usize], about: Place) -> Law {
        Law::AngularMomentum {
            system: system.to_vec(),
            about,
        }
    }
}

/// A direction with a name.
#[derive(Clone, PartialEq, Debug)]
pub enum Direction {
    /// The x axis.
    X,
    /// The y axis.
    Y,
    /// A direction named in the scene or by a contact.
    Named(String, Vector),
}

impl Direction {
    /// The unit vector.
    pub fn vector(&self) -> Vector {
        match self {
            Direction::X => [Expr::one(), Expr::zero()],
            Direction::Y => [Expr::zero(), Expr::one()],
            Direction::Named(_, v) => v.clone(),
        }
    }
}

/// A moment point with a name.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Place {
    /// Center of mass of a body.
    Center(usize),
    /// Point of a contact.
    Contact(usize),
    /// Axis of a hinge.
    Hinge(usize),
    /// Point where a blow acts.
    Blow(usize),
}

impl Place {
    /// Where an impulse that is asked for acts, and the body on which the laws count it.
    pub fn of(scene: &Scene, from: ImpulseAt) -> (Place, usize) {
        match from {
            ImpulseAt::Contact(c) => (Place::Contact(c), scene.contacts[c].bodies[1]),
            ImpulseAt::Hinge(h) => (Place::Hinge(h), scene.hinges[h].bodies[1]),
            ImpulseAt::Blow(b) => (Place::Blow(b), scene.blows[b].body),
        }
    }
}

/// The numbers of a scene in one number type.
#[derive(Clone, Debug)]
pub struct Geometry<T> {
    mass: Vec<T>,
    inertia: Vec<T>,
    center: Vec<[T; 2]>,
    velocity: Vec<[T; 2]>,
    spin: Vec<T>,
    contact: Vec<[T; 2]>,
    normal: Vec<Option<[T; 2]>>,
    restitution: Vec<Option<T>>,
    conditions: Vec<Option<[Condition<T>; 2]>>,
    hinge: Vec<[T; 2]>,
    blow: Vec<[T; 2]>,
    blow_impulse: Vec<[T; 2]>,
    known: Vec<Given<T>>,
}

/// A known value after: the place and direction of a velocity component, or `None` for a spin; and the value.
type Given<T> = (Option<([T; 2], [T; 2])>, T);

impl<T: Number> Geometry<T> {
    /// Every formula of the scene turned into a number by `value`; the first failure is returned.
    pub fn of<E>(
        scene: &Scene,
        mut value: impl FnMut(&Expr) -> Result<T, E>,
    ) -> Result<Geometry<T>, E> {
        let mut vector = |v: &Vector| -> Result<[T; 2], E> { Ok([value(&v[0])?, value(&v[1])?]) };
        let center = each(&scene.bodies, |b| vector(&b.center))?;
        let velocity = each(&scene.bodies, |b| vector(&b.velocity))?;
        let contact = each(&scene.contacts, |c| vector(&c.at))?;
        let normal = each(&scene.contacts, |c| match (&c.law, &c.normal) {
            (ContactLaw::Frictionless { .. }, Some(n)) => vector(n).map(Some),
            _ => Ok(None),
        })?;
        let hinge = each(&scene.hinges, |h| vector(&h.at))?;
        let blow = each(&scene.blows, |b| vector(&b.at))?;
        let blow_impulse = each(&scene.blows, |b| match &b.impulse {
            BlowImpulse::Given(p) | BlowImpulse::Along(p) => vector(p),
        })?;
        let known_at = each(&scene.after, |k| match &k.what {
            KnownQuantity::Velocity { at, along, .. } => Ok(Some((vector(at)?, vector(along)?))),
            KnownQuantity::Spin => Ok(None),
        })?;
        let mass = each(&scene.bodies, |b| value(&b.mass))?;
        let inertia = each(&scene.bodies, |b| value(&b.inertia))?;
        let spin = each(&scene.bodies, |b| value(&b.spin))?;
        let restitution = each(&scene.contacts, |c| match &c.law {
            ContactLaw::Frictionless { restitution } => value(restitution).map(Some),
            _ => Ok(None),
        })?;
        let conditions = each(&scene.contacts, |c| match c.law.conditions() {
            Some([one, two]) => Ok(Some([one.try_map(&mut value)?, two.try_map(&mut value)?])),
            None => Ok(None),
        })?;
        let known = known_at
            .into_iter()
            .zip(&scene.after)
            .map(|(at, k)| Ok((at, value(&k.value)?)))
            .collect::<Result<_, E>>()?;
        Ok(Geometry {
            mass,
            inertia,
            center,
            velocity,
            spin,
            contact,
            normal,
            restitution,
            conditions,
            hinge,
            blow,
            blow_impulse,
            known,
        })
    }

    /// Position of a moment point \[m\].
    pub fn place(&self, place: Place) -> &[T; 2] {
        match place {
            Place::Center(b) => &self.center[b],
            Place::Contact(c) => &self.contact[c],
            Place::Hinge(h) => &self.hinge[h],
            Place::Blow(b) => &self.blow[b],
        }
    }

    /// Velocity just before of the point of body `b` at `at`, v⁻ [m/s].
    pub fn velocity_before(&self, b: usize, at: &[T; 2]) -> [T; 2] {
        let r = difference(at, &self.center[b]);
        [
            self.velocity[b][0].minus(&self.spin[b].times(&r[1])),
            self.velocity[b][1].plus(&self.spin[b].times(&r[0])),
        ]
    }

    /// Mass of body `b` \[kg\].
    pub fn mass(&self, b: usize) -> &T {
        &self.mass[b]
    }

    /// Moment of inertia of body `b` about its center of mass [kg m²].
    pub fn inertia(&self, b: usize) -> &T {
        &self.inertia[b]
    }

    /// Velocity of the center of mass [m/s] and spin [rad/s] of body `b` just before.
    pub fn before(&self, b: usize) -> (&[T; 2], &T) {
        (&self.velocity[b], &self.spin[b])
    }
}

impl Geometry<Expr> {
    /// The formulas of the scene as they are.
    pub fn symbolic(scene: &Scene) -> Geometry<Expr> {
        let Ok(g) = Geometry::of(scene, |e| Ok::<_, Infallible>(e.clone()));
        g
    }
}

/// How every body moves after, as an affine function of the unknowns.
#[derive(Clone, Debug)]
pub struct Kinematics<T> {
    /// Velocity of the center of mass after, v_G⁺.
    pub velocity: Vec<[Affine<T>; 2]>,
    /// Angular velocity after, ω⁺.
    pub spin: Vec<Affine<T>>,
}

impl<T: Number> Kinematics<T> {
    /// Every body with laws has its own unknown velocity and spin; the others keep their motion.
    pub fn full(scene: &Scene, g: &Geometry<T>) -> Kinematics<T> {
        let bodies = 0..scene.bodies.len();
        Kinematics {
            velocity: bodies.clone().map(|b| own_velocity(scene, g, b)).collect(),
            spin: bodies.map(|b| own_spin(scene, g, b)).collect(),
        }
    }

    /// Velocity after of the point of body `b` at `at`, v⁺ = v_G⁺ + ω⁺ × r.
    pub fn velocity_of(&self, g: &Geometry<T>, b: usize, at: &[T; 2]) -> [Affine<T>; 2] {
        let r = difference(at, &g.center[b]);
        [
            self.velocity[b][0].minus(&self.spin[b].times(&r[1])),
            self.velocity[b][1].plus(&self.spin[b].times(&r[0])),
        ]
    }

    /// Lets body `b` move as a body joined at `at` to a point of velocity `carrier`: only its spin is left of its own.
    pub fn attach(
        &mut self,
        scene: &Scene,
        g: &Geometry<T>,
        b: usize,
        at: &[T; 2],
        carrier: [Affine<T>; 2],
    ) {
        let spin = own_spin(scene, g, b);
        let r = difference(&g.center[b], at);
        let [x, y] = carrier;
        self.velocity[b] = [x.minus(&spin.times(&r[1])), y.plus(&spin.times(&r[0]))];
        self.spin[b] = spin;
    }
}

fn own_velocity<T: Number>(scene: &Scene, g: &Geometry<T>, b: usize) -> [Affine<T>; 2] {
    [0, 1].map(|axis| {
        if !scene.has_law(b) {
            Affine::constant(g.velocity[b][axis].clone())
        } else {
            Affine::unknown(Unknown::Velocity(b, axis))
        }
    })
}

fn own_spin<T: Number>(scene: &Scene, g: &Geometry<T>, b: usize) -> Affine<T> {
    if !scene.has_law(b) {
        Affine::constant(g.spin[b].clone())
    } else if scene.bodies[b].is_particle() {
        // A point has no spin; its velocity is all there is to say.
        Affine::constant(T::zero())
    } else {
        Affine::unknown(Unknown::Spin(b))
    }
}

/// All unknowns of the scene: velocities and spins of the bodies that can move, then the impulses.
pub fn unknowns(scene: &Scene) -> Vec<Unknown> {
    let mut all = Vec::new();
    for (b, body) in scene.bodies.iter().enumerate() {
        if scene.has_law(b) {
            all.extend([Unknown::Velocity(b, 0), Unknown::Velocity(b, 1)]);
            if !body.is_particle() {
                all.push(Unknown::Spin(b));
            }
        }
    }
    let contacts = (0..scene.contacts.len()).map(Place::Contact);
    let hinges = (0..scene.hinges.len()).map(Place::Hinge);
    let blows = (0..scene.blows.len()).map(Place::Blow);
    let places = contacts.chain(hinges).chain(blows);
    all.extend(places.flat_map(|place| impulses_at(scene, place)));
    all
}

/// The unknown impulses at a place: along a normal, or both components.
pub fn impulses_at(scene: &Scene, place: Place) -> Vec<Unknown> {
    match place {
        Place::Contact(c) => match scene.contacts[c].law {
            ContactLaw::Frictionless { .. } => vec![Unknown::Normal(c)],
            ContactLaw::Sticking
            | ContactLaw::None
            | ContactLaw::Friction(_)
            | ContactLaw::Decided(_) => vec![Unknown::Contact(c, 0), Unknown::Contact(c, 1)],
        },
        Place::Hinge(h) => vec![Unknown::Hinge(h, 0), Unknown::Hinge(h, 1)],
        Place::Blow(i) => match scene.blows[i].impulse {
            BlowImpulse::Along(_) => vec![Unknown::Blow(i)],
            BlowImpulse::Given(_) => Vec::new(),
        },
        Place::Center(_) => Vec::new(),
    }
}

/// The full set of laws: two or three balances for every body that can move, then joints, contact laws and givens.
pub fn of(scene: &Scene) -> Vec<Law> {
    let mut laws = Vec::new();
    for (b, body) in scene.bodies.iter().enumerate() {
        if scene.has_law(b) {
            laws.extend([Direction::X, Direction::Y].map(|d| Law::linear(&[b], d)));
            if !body.is_particle() {
                laws.push(Law::angular(&[b], Place::Center(b)));
            }
        }
    }
    laws.extend((0..scene.hinges.len()).flat_map(|h| [Law::Hinged(h, 0), Law::Hinged(h, 1)]));
    for (c, contact) in scene.contacts.iter().enumerate() {
        match contact.law {
            ContactLaw::None | ContactLaw::Friction(_) => {}
            ContactLaw::Decided(_) => laws.extend([Law::Condition(c, 0), Law::Condition(c, 1)]),
            ContactLaw::Sticking => laws.extend([Law::Sticking(c, 0), Law::Sticking(c, 1)]),
            ContactLaw::Frictionless { .. } => laws.push(Law::Restitution(c)),
        }
    }
    laws.extend((0..scene.after.len()).map(Law::Given));
    laws
}

/// A law as a linear equation between formulas.
pub fn symbolic(
    scene: &Scene,
    g: &Geometry<Expr>,
    motion: &Kinematics<Expr>,
    law: &Law,
) -> Linear<Expr> {
    let plain = |v: &Vector| Ok::<_, Infallible>(v.clone());
    let Ok(linear) = equation(scene, g, motion, law, plain);
    linear
}

/// Writes a law as a linear equation. `direction` turns the vector of a named direction into the number type.
pub fn equation<T: Number, E>(
    scene: &Scene,
    g: &Geometry<T>,
    motion: &Kinematics<T>,
    law: &Law,
    mut direction: impl FnMut(&Vector) -> Result<[T; 2], E>,
) -> Result<Linear<T>, E> {
    // Velocity just after at a point, of the second body relative to the first.
    let after = |[one, two]: [usize; 2], at: &[T; 2]| {
        let [one, two] = [one, two].map(|b| motion.velocity_of(g, b, at));
        relative(&one, &two)
    };
    let nothing = || Affine::constant(T::zero()).equals_zero();
    Ok(match law {
        Law::LinearMomentum { system, along } => {
            let d = match along {
                Direction::X => Err(0),
                Direction::Y => Err(1),
                Direction::Named(_, v) => Ok(direction(v)?),
            };
            linear(scene, g, motion, system, d).equals_zero()
        }
        Law::AngularMomentum { system, about } => {
            angular(scene, g, motion, system, g.place(*about)).equals_zero()
        }
        Law::Restitution(c) => {
            let contact = &scene.contacts[*c];
            let (Some(n), Some(e)) = (&g.normal[*c], &g.restitution[*c]) else {
                return Ok(nothing());
            };
            let at = &g.contact[*c];
            let [one, two] = contact.bodies;
            let after = after(contact.bodies, at);
            let before = difference(&g.velocity_before(two, at), &g.velocity_before(one, at));
            let approach = before[0].times(&n[0]).plus(&before[1].times(&n[1]));
            along_direction(&after, n)
                .plus(&Affine::constant(e.times(&approach)))
                .equals_zero()
        }
        Law::Sticking(c, axis) => {
            let after = after(scene.contacts[*c].bodies, &g.contact[*c]);
            after[*axis].clone().equals_zero()
        }
        Law::Hinged(h, axis) => {
            let after = after(scene.hinges[*h].bodies, &g.hinge[*h]);
            after[*axis].clone().equals_zero()
        }
        Law::Condition(c, i) => {
            let Some(both) = &g.conditions[*c] else {
                return Ok(nothing());
            };
            let condition = &both[*i];
            let after = after(scene.contacts[*c].bodies, &g.contact[*c]);
            let impulse = impulse_at(scene, g, Place::Contact(*c));
            along_direction(&impulse, &condition.impulse)
                .plus(&along_direction(&after, &condition.velocity))
                .plus(&Affine::constant(condition.right.negated()))
                .equals_zero()
        }
        Law::Given(k) => {
            let (place, value) = &g.known[*k];
            let known = &scene.after[*k];
            let quantity = match place {
                Some((at, along)) => {
                    let velocity = |body| along_direction(&motion.velocity_of(g, body, at), along);
                    let own = velocity(known.body);
                    match known.to() {
                        Some(other) => own.minus(&velocity(other)),
                        None => own,
                    }
                }
                None => motion.spin[known.body].clone(),
            };
            quantity
                .plus(&Affine::constant(value.negated()))
                .equals_zero()
        }
    })
}

/// What bodies gain of momentum less the impulses on them, along a direction or along an axis.
fn linear<T: Number>(
    scene: &Scene,
    g: &Geometry<T>,
    motion: &Kinematics<T>,
    system: &[usize],
    along: Result<[T; 2], usize>,
) -> Affine<T> {
    let component = |v: &[Affine<T>; 2]| match &along {
        Ok(d) => along_direction(v, d),
        Err(axis) => v[*axis].clone(),
    };
    let mut total = Affine::constant(T::zero());
    for &b in system {
        let (after, before, m) = (&motion.velocity[b], &g.velocity[b], &g.mass[b]);
        let mut add = |axis: usize, m: &T| {
            total.add_times(&after[axis], m);
            total.add_known(&before[axis], &m.negated());
        };
        match &along {
            Ok(d) => (0..2).for_each(|axis| add(axis, &m.times(&d[axis]))),
            Err(axis) => add(*axis, m),
        }
    }
    for (_, impulse) in external(scene, g, system) {
        total = total.minus(&component(&impulse));
    }
    total
}

/// What bodies gain of angular momentum about a place less the impulses' moments on them.
fn angular<T: Number>(
    scene: &Scene,
    g: &Geometry<T>,
    motion: &Kinematics<T>,
    system: &[usize],
    o: &[T; 2],
) -> Affine<T> {
    let mut total = Affine::constant(T::zero());
    for &b in system {
        if !scene.bodies[b].is_particle() {
            total.add_times(&motion.spin[b], &g.inertia[b]);
            total.add_known(&g.spin[b], &g.inertia[b].negated());
        }
        // m r × (v⁺ − v⁻)
        let r = difference(&g.center[b], o);
        let (after, before) = (&motion.velocity[b], &g.velocity[b]);
        let arms = [g.mass[b].times(&r[1]).negated(), g.mass[b].times(&r[0])];
        for (axis, arm) in arms.iter().enumerate() {
            total.add_times(&after[axis], arm);
            total.add_known(&before[axis], &arm.negated());
        }
    }
    for (at, impulse) in external(scene, g, system) {
        let r = difference(&at, o);
        total.add_times(&impulse[1], &r[0].negated());
        total.add_times(&impulse[0], &r[1]);
    }
    total
}

/// The impulse on the second body of a contact or hinge, or of a blow, as an affine function of the unknowns.
pub fn impulse_at<T: Number>(scene: &Scene, g: &Geometry<T>, place: Place) -> [Affine<T>; 2] {
    match place {
        Place::Contact(c) => match &g.normal[c] {
            Some(n) => [0, 1].map(|axis| Affine::unknown(Unknown::Normal(c)).times(&n[axis])),
            None => [0, 1].map(|axis| Affine::unknown(Unknown::Contact(c, axis))),
        },
        Place::Hinge(h) => [0, 1].map(|axis| Affine::unknown(Unknown::Hinge(h, axis))),
        Place::Blow(i) => match &scene.blows[i].impulse {
            BlowImpulse::Given(_) => {
                [0, 1].map(|axis| Affine::constant(g.blow_impulse[i][axis].clone()))
            }
            BlowImpulse::Along(_) => {
                [0, 1].map(|axis| Affine::unknown(Unknown::Blow(i)).times(&g.blow_impulse[i][axis]))
            }
        },
        Place::Center(_) => [Affine::constant(T::zero()), Affine::constant(T::zero())],
    }
}

/// The impulses from outside on a system, each with its point of application.
fn external<T: Number>(
    scene: &Scene,
    g: &Geometry<T>,
    system: &[usize],
) -> Vec<([T; 2], [Affine<T>; 2])> {
    let mut all = Vec::new();
    for joint in scene.touching() {
        let (place, _) = Place::of(scene, joint.from);
        let inside = joint.bodies.map(|b| system.contains(&b));
        if inside[0] != inside[1] {
            let on_second = impulse_at(scene, g, place);
            let on_system = match inside[1] {
                true => on_second,
                false => on_second.map(|p| p.negated()),
            };
            all.push((g.place(place).clone(), on_system));
        }
    }
    for (i, blow) in scene.blows.iter().enumerate() {
        if system.contains(&blow.body) {
            all.push((g.blow[i].clone(), impulse_at(scene, g, Place::Blow(i))));
        }
    }
    all
}

fn relative<T: Number>(one: &[Affine<T>; 2], two: &[Affine<T>; 2]) -> [Affine<T>; 2] {
    [0, 1].map(|axis| two[axis].minus(&one[axis]))
}

fn along_direction<T: Number>(v: &[Affine<T>; 2], d: &[T; 2]) -> Affine<T> {
    v[0].times(&d[0]).plus(&v[1].times(&d[1]))
}

/// What `f` makes of each item, or the first failure.
fn each<I, T, E>(items: &[I], f: impl FnMut(&I) -> Result<T, E>) -> Result<Vec<T>, E> {
    items.iter().map(f).collect()
}
