//! What students believe: each belief is one row that alters the scene or its equations, with the words for student and
//! teacher.
//!
//! A row gives every way in which its belief can show in a scene, so it works for scenes nobody has seen. What comes out
//! under a belief is computed by [`super::believed`]; this file holds no formula of any answer.

mod motions;
mod slips;

use crate::expr::angle::arcs_exchanged;
use crate::expr::{Expr, Symbol, Vector, minus};
use crate::numeric::Unknown;
use crate::scene::{ContactLaw, Scene, Shape};
pub(super) use motions::{MOTIONS, in_stages};
pub(super) use slips::other_shapes;
use slips::{
    about_places, all_places, at, changed, each, frictionless, inertia, lengths, movable, of,
    places, positions, restitution, rigid, spins, sticking, struck, velocities,
};

/// A belief.
#[derive(Debug)]
pub struct Belief {
    /// Stable code.
    pub code: &'static str,
    /// The belief, for the teacher.
    pub belief: &'static str,
    /// For the student: where to look, without the answer.
    pub hint: &'static str,
    /// Every way it can show in a scene.
    pub slips: fn(&Scene) -> Vec<Slip>,
}

/// One way a belief shows: a scene that is not the one given, equations that are not its laws.
#[derive(Clone, Debug)]
pub struct Slip {
    /// The scene as believed.
    pub scene: Scene,
    /// What is done to its equations.
    pub change: Option<Change>,
    /// Where it shows, in words; may be empty.
    pub place: String,
}

/// What is done to the equations of a scene.
#[derive(Clone, Debug)]
pub enum Change {
    /// Angular momentum of these bodies about a point is taken as conserved, whatever impulses act; the equation stands
    /// in place of the moment equation of the body `instead`.
    MomentsIgnored {
        /// Indices of the bodies.
        bodies: Vec<usize>,
        /// The point.
        about: Vector,
        /// Index of the body that loses its own equation.
        instead: usize,
    },
    /// A hinge or a sticking contact has no impulse along an axis; the moment equation of a body gives way.
    NoImpulse {
        /// The unknown component.
        of: Unknown,
        /// Index of the body that loses its moment equation.
        instead: usize,
    },
    /// Restitution between the centers of mass instead of the touching points.
    CentersBounce(usize),
    /// The whole velocity of the center turns round, times e.
    WholeBounce {
        /// Index of the contact.
        contact: usize,
        /// Index of the body.
        body: usize,
    },
    /// Kinetic energy conserved in place of the balances, for a motion with one freedom.
    EnergyKept,
    /// Energies counted without rotation.
    NoRotationEnergy,
    /// Energies counted without translation.
    NoTranslationEnergy,
    /// Velocities after of points taken as those of the centers.
    PointIsCenter,
}

/// All beliefs: where several give the same answer, the one that stands first is named.
pub const BELIEFS: &[Belief] = &[
    Belief {
        code: "INERTIA_ABOUT_POINT",
        belief: "the moment of inertia about the hinge or contact point stands where the one about the center of mass belongs",
        hint: "about which point is your moment of inertia, and about which point do you take moments?",
        slips: |s| inertia(s, &|s, b| about_places(s, b, 1)),
    },
    Belief {
        code: "PARALLEL_AXIS_DROPPED",
        belief: "the parallel-axis term m r² is left out: the moment of inertia about the center is used about another point",
        hint: "is the moment of inertia you use the one about the point you chose?",
        slips: |s| inertia(s, &|s, b| about_places(s, b, -1)),
    },
    Belief {
        code: "INERTIA_OF_OTHER_SHAPE",
        belief: "the moment of inertia of another shape is used",
        hint: "which shape has the moment of inertia you used?",
        slips: |s| inertia(s, &other_shapes),
    },
    Belief {
        code: "POINT_MASS",
        belief: "the body is treated as if all its mass sat at its center",
        hint: "does the body resist being turned?",
        slips: |s| inertia(s, &|_, _| vec![(Expr::zero(), String::new())]),
    },
    Belief {
        code: "ENERGY_KEPT",
        belief: "kinetic energy is taken as conserved in a plastic impact",
        hint: "is kinetic energy conserved when bodies stick?",
        slips: |s| {
            let plastic = sticking(s).next().is_some();
            Vec::from_iter(plastic.then(|| changed(s, Change::EnergyKept, "")))
        },
    },
    Belief {
        code: "ELASTIC",
        belief: "the collision is taken as elastic, e = 1",
        hint: "what does the problem say about restitution?",
        slips: |s| restitution(s, &|_| Expr::one()),
    },
    Belief {
        code: "PLASTIC",
        belief: "the collision is taken as perfectly plastic, e = 0",
        hint: "what does the problem say about restitution?",
        slips: |s| restitution(s, &|_| Expr::zero()),
    },
    Belief {
        code: "RESTITUTION_SIGN",
        belief: "the relative velocity keeps its sign: e has the wrong sign",
        hint: "do the bodies separate after the collision, by your equations?",
        slips: |s| restitution(s, &|e| -e),
    },
    Belief {
        code: "RESTITUTION_ENERGY",
        belief: "e is taken as a ratio of energies rather than of velocities",
        hint: "what does the coefficient of restitution compare?",
        slips: |s| restitution(s, &Expr::sqrt),
    },
    Belief {
        code: "RESTITUTION_AT_CENTERS",
        belief: "restitution is applied to the velocities of the centers of mass instead of the touching points",
        hint: "which points approach and separate?",
        slips: |s| {
            let bounce = |c| changed(s, Change::CentersBounce(c), at(s, c));
            struck(s).map(bounce).collect()
        },
    },
    Belief {
        code: "STICKS",
        belief: "the touching points are taken to move together after, although the contact is frictionless",
        hint: "does the contact hold the points together, also along the surface?",
        slips: |s| {
            each(s, struck(s), |scene, c| {
                scene.contacts[c].law = ContactLaw::Sticking;
                Some(at(s, c))
            })
        },
    },
    Belief {
        code: "SLIDES",
        belief: "the impulse is taken along the normal only, although the bodies stick",
        hint: "can the contact push along the surface too?",
        slips: |s| {
            let axes = [[Expr::one(), Expr::zero()], [Expr::zero(), Expr::one()]];
            let all = sticking(s).flat_map(|c| axes.clone().map(|axis| (c, axis)));
            // Particles that do not approach each other along an axis pass each other under no belief.
            let meet = |(c, [x, _]): &(usize, Vector)| {
                let [a, b] = s.contacts[*c].bodies.map(|b| &s.bodies[b]);
                let along = usize::from(x.is_zero());
                !(a.is_particle() && b.is_particle()) || a.velocity[along] != b.velocity[along]
            };
            each(s, all.filter(meet), |scene, (c, axis)| {
                let restitution = Expr::zero();
                scene.contacts[c].law = ContactLaw::Frictionless { restitution };
                scene.contacts[c].normal.get_or_insert(axis);
                Some(at(s, c))
            })
        },
    },
    Belief {
        code: "HINGE_IMPULSE_FORGOTTEN",
        belief: "the hinge is left out: its impulse is forgotten and the body moves as if free",
        hint: "what holds the body at the hinge during the collision?",
        slips: |s| {
            each(s, 0..s.hinges.len(), |scene, h| {
                Some(format!("at {}", scene.hinges.remove(h).name))
            })
        },
    },
    Belief {
        code: "MOMENTUM_WITH_HINGE",
        belief: "linear momentum is taken as conserved although a hinge or the ground gives an impulse",
        hint: "which impulses act on the system from outside?",
        slips: |s| {
            let held = |c: &usize| {
                let mut bodies = s.contacts[*c].bodies.iter();
                bodies.any(|b| s.bodies[*b].is_fixed())
            };
            let mut found = Vec::new();
            for axis in 0..2 {
                let hinges = s.hinges.iter().enumerate();
                let hinges =
                    hinges.map(|(h, on)| (Unknown::Hinge(h, axis), format!("at {}", on.name)));
                let contacts = sticking(s).filter(held);
                let contacts = contacts.map(|c| (Unknown::Contact(c, axis), at(s, c)));
                for (of, place) in hinges.chain(contacts) {
                    let change = |instead| Change::NoImpulse { of, instead };
                    found.extend(rigid(s).map(|b| changed(s, change(b), place.clone())));
                }
            }
            found
        },
    },
    Belief {
        code: "WRONG_MOMENT_POINT",
        belief: "angular momentum is taken as conserved about a point through which an impulse does not pass",
        hint: "does every impulse pass through the point about which you take moments?",
        slips: |s| {
            let mut found = Vec::new();
            let moving: Vec<usize> = movable(s).collect();
            let mut systems: Vec<Vec<usize>> = moving.iter().map(|b| vec![*b]).collect();
            systems.extend((moving.len() > 1).then_some(moving));
            for bodies in systems {
                for (about, name) in all_places(s) {
                    for instead in rigid(s).filter(|b| bodies.contains(b)) {
                        let change = Change::MomentsIgnored {
                            bodies: bodies.clone(),
                            about: about.clone(),
                            instead,
                        };
                        found.push(changed(s, change, format!("about {name}")));
                    }
                }
            }
            found
        },
    },
    Belief {
        code: "RECOIL_IGNORED",
        belief: "a body is taken as immovable: its recoil is ignored",
        hint: "do all bodies change their motion in the collision?",
        slips: |s| {
            each(s, movable(s), |scene, b| {
                scene.bodies[b].shape = Shape::Fixed;
                (movable(s).count() > 1).then(|| of(s, b))
            })
        },
    },
    Belief {
        code: "RESTITUTION_WHOLE",
        belief: "e is applied to the whole velocity, not only to the part along the normal",
        hint: "is there an impulse along the surface?",
        slips: |s| {
            let all = frictionless(s).flat_map(|c| s.contacts[c].bodies.map(|b| (c, b)));
            let free = all.filter(|(_, body)| !s.bodies[*body].is_fixed());
            // What comes along the normal has no other part.
            let along = |c: usize, v: &Vector| {
                let part = |a: &Expr, b: &Expr| (!a.is_zero() && !b.is_zero()).then(|| a * b);
                let normal = s.contacts[c].normal.as_ref();
                normal.is_some_and(|[x, y]| part(x, &v[1]) == part(y, &v[0]))
            };
            let free = free.filter(|(c, body)| !along(*c, &s.bodies[*body].velocity));
            let whole = |(contact, body)| Change::WholeBounce { contact, body };
            free.map(|(c, b)| changed(s, whole((c, b)), of(s, b)))
                .collect()
        },
    },
    Belief {
        code: "MASS_IGNORED",
        belief: "a body is taken as massless: its momentum is left out",
        hint: "which bodies carry momentum?",
        slips: |s| {
            each(s, movable(s), |scene, b| {
                scene.bodies[b].mass = Expr::zero();
                scene.bodies[b].inertia = Expr::zero();
                (movable(s).count() > 1).then(|| of(s, b))
            })
        },
    },
    Belief {
        code: "SPIN_BEFORE_IGNORED",
        belief: "the rotation before the collision is left out",
        hint: "what is the angular momentum just before?",
        slips: |s| spins(s, &|_| Expr::zero()),
    },
    Belief {
        code: "SPIN_BEFORE_SIGN",
        belief: "the rotation before the collision has the wrong sense",
        hint: "check the sense of rotation before the collision",
        slips: |s| spins(s, &|spin| -spin),
    },
    Belief {
        code: "VELOCITY_BEFORE_IGNORED",
        belief: "the velocity of a body before the collision is left out",
        hint: "which bodies move before the collision?",
        slips: |s| velocities(s, &|_| [Expr::zero(), Expr::zero()]),
    },
    Belief {
        code: "VELOCITY_BEFORE_SIGN",
        belief: "the velocity of a body before the collision points the wrong way",
        hint: "check the direction of every velocity before the collision",
        slips: |s| velocities(s, &|v| [-&v[0], -&v[1]]),
    },
    Belief {
        code: "SIN_FOR_COS",
        belief: "sine and cosine are exchanged in the geometry",
        hint: "from which line is the angle measured?",
        slips: |s| {
            // The phase √(k/m) t of a spring is no angle of a figure.
            let plain = |name: &Symbol| {
                let mut all = s.parameters.iter();
                &**name == "pi" || all.any(|p| p.name == *name && p.dimension.is_none())
            };
            let is_angle = |x: &Expr| x.symbols().iter().all(plain);
            let swapped = |e: &Expr| arcs_exchanged(e, &is_angle);
            let swap = |v: &mut Vector| *v = v.each_ref().map(swapped);
            let places = [
                "in the positions",
                "in the velocities before",
                "in the normal",
            ];
            each(s, places, |scene, place| {
                let bodies = scene.bodies.iter_mut();
                match place {
                    "in the positions" => positions(scene).for_each(swap),
                    "in the normal" => {
                        let contacts = scene.contacts.iter_mut();
                        contacts.filter_map(|c| c.normal.as_mut()).for_each(swap);
                    }
                    _ => bodies.map(|b| &mut b.velocity).for_each(swap),
                }
                Some(place.to_string())
            })
        },
    },
    Belief {
        code: "ARM_TO_END",
        belief: "the center of mass is put at the far end: l stands for l/2 in the arm",
        hint: "where is the center of mass?",
        slips: |s| {
            let bodies = movable(s).filter(|b| !s.bodies[*b].is_particle());
            let arms = bodies.flat_map(|b| places(s, b).into_iter().map(move |at| (b, at)));
            let all = arms.flat_map(|(b, at)| {
                [(Expr::from(2), "twice"), (Expr::ratio(1, 2), "half")].map(|k| (b, at.clone(), k))
            });
            each(s, all, |scene, (b, (at, name), (k, words))| {
                let arm = minus(&s.bodies[b].center, &at);
                scene.bodies[b].center = [0, 1].map(|i| &at[i] + &(&arm[i] * &k));
                let center = format!("the center {}", of(s, b));
                Some(format!("{words} the arm from {name} to {center}"))
            })
        },
    },
    Belief {
        code: "NORMAL_TURNED",
        belief: "the normal is taken along the surface",
        hint: "in which direction does a frictionless contact push?",
        slips: |s| {
            each(s, struck(s), |scene, c| {
                let [x, y] = s.contacts[c].normal.clone()?;
                scene.contacts[c].normal = Some([-y, x]);
                Some(at(s, c))
            })
        },
    },
    Belief {
        code: "ROTATION_ENERGY_FORGOTTEN",
        belief: "the energy of rotation is left out",
        hint: "which parts has the kinetic energy of a body that turns?",
        slips: |s| vec![changed(s, Change::NoRotationEnergy, "")],
    },
    Belief {
        code: "TRANSLATION_ENERGY_FORGOTTEN",
        belief: "the energy of translation is left out",
        hint: "which parts has the kinetic energy of a body that turns?",
        slips: |s| {
            // Where nothing can turn nobody forgets all energy.
            let turns = rigid(s).next().is_some();
            Vec::from_iter(turns.then(|| changed(s, Change::NoTranslationEnergy, "")))
        },
    },
    Belief {
        code: "POINT_IS_CENTER",
        belief: "the velocity of a point of the body is taken as that of its center of mass",
        hint: "do all points of a turning body move alike?",
        slips: |s| vec![changed(s, Change::PointIsCenter, "")],
    },
    Belief {
        code: "LENGTH_HALVED",
        belief: "half a length stands for the whole, or the whole for its half",
        hint: "is a length in your formula the whole or the half?",
        slips: lengths,
    },
];
