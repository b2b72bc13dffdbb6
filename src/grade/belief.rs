//! What students believe: each belief is one row that alters the scene or its equations, with the words for student and
//! teacher.
//!
//! A row gives every way in which its belief can show in a scene, so it works for scenes nobody has seen. What comes out
//! under a belief is computed by [`super::believed`]; this file holds no formula of any answer.

mod motions;
mod slips;

use crate::expr::{Expr, Vector, minus};
use crate::numeric::Unknown;
use crate::scene::{ContactLaw, Scene, Shape};
pub(super) use motions::in_stages;
use slips::{
    all_places, changed, frictionless, inertia, lengths, movable, other_shapes, places,
    restitution, rigid, shifted, slip, spins, velocities,
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
    pub changes: Vec<Change>,
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
    /// A hinge has no impulse along an axis; the moment equation of a body gives way.
    NoHingeImpulse {
        /// Index of the hinge.
        hinge: usize,
        /// 0 for x, 1 for y.
        axis: usize,
        /// Index of the body that loses its moment equation.
        instead: usize,
    },
    /// A sticking contact has no impulse along an axis; the moment equation of a body gives way.
    NoContactImpulse {
        /// Index of the contact.
        contact: usize,
        /// 0 for x, 1 for y.
        axis: usize,
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

/// All beliefs.
pub const BELIEFS: &[Belief] = &[
    Belief {
        code: "INERTIA_ABOUT_POINT",
        belief: "the moment of inertia about the hinge or contact point stands where the one about the center of mass belongs",
        hint: "about which point is your moment of inertia, and about which point do you take moments?",
        slips: |s| {
            inertia(s, &|s, b| {
                places(s, b)
                    .into_iter()
                    .map(|(at, name)| (shifted(s, b, &at, Expr::one()), format!("about {name}")))
                    .collect()
            })
        },
    },
    Belief {
        code: "PARALLEL_AXIS_DROPPED",
        belief: "the parallel-axis term m r² is left out: the moment of inertia about the center is used about another point",
        hint: "is the moment of inertia you use the one about the point you chose?",
        slips: |s| {
            inertia(s, &|s, b| {
                places(s, b)
                    .into_iter()
                    .map(|(at, name)| (shifted(s, b, &at, Expr::from(-1)), format!("about {name}")))
                    .collect()
            })
        },
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
            let plastic = s.contacts.iter().any(|c| c.law == ContactLaw::Sticking);
            if plastic {
                vec![changed(s, Change::EnergyKept, "")]
            } else {
                Vec::new()
            }
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
            frictionless(s)
                .map(|c| {
                    changed(
                        s,
                        Change::CentersBounce(c),
                        &format!("at {}", s.contacts[c].name),
                    )
                })
                .collect()
        },
    },
    Belief {
        code: "RESTITUTION_WHOLE",
        belief: "e is applied to the whole velocity, not only to the part along the normal",
        hint: "is there an impulse along the surface?",
        slips: |s| {
            frictionless(s)
                .flat_map(|contact| s.contacts[contact].bodies.map(|body| (contact, body)))
                .filter(|(_, body)| !s.bodies[*body].is_fixed())
                .map(|(contact, body)| {
                    changed(
                        s,
                        Change::WholeBounce { contact, body },
                        &format!("of {}", s.bodies[body].name),
                    )
                })
                .collect()
        },
    },
    Belief {
        code: "STICKS",
        belief: "the touching points are taken to move together after, although the contact is frictionless",
        hint: "does the contact hold the points together, also along the surface?",
        slips: |s| {
            frictionless(s)
                .map(|c| {
                    let mut scene = s.clone();
                    scene.contacts[c].law = ContactLaw::Sticking;
                    slip(scene, &format!("at {}", s.contacts[c].name))
                })
                .collect()
        },
    },
    Belief {
        code: "SLIDES",
        belief: "the impulse is taken along the normal only, although the bodies stick",
        hint: "can the contact push along the surface too?",
        slips: |s| {
            let sticking =
                (0..s.contacts.len()).filter(|c| s.contacts[*c].law == ContactLaw::Sticking);
            let axes = [[Expr::one(), Expr::zero()], [Expr::zero(), Expr::one()]];
            sticking
                .flat_map(|c| axes.clone().map(|axis| (c, axis)))
                .map(|(c, axis)| {
                    let mut scene = s.clone();
                    scene.contacts[c].law = ContactLaw::Frictionless {
                        restitution: Expr::zero(),
                    };
                    scene.contacts[c].normal.get_or_insert(axis);
                    slip(scene, &format!("at {}", s.contacts[c].name))
                })
                .collect()
        },
    },
    Belief {
        code: "HINGE_IMPULSE_FORGOTTEN",
        belief: "the hinge is left out: its impulse is forgotten and the body moves as if free",
        hint: "what holds the body at the hinge during the collision?",
        slips: |s| {
            (0..s.hinges.len())
                .map(|h| {
                    let mut scene = s.clone();
                    let name = scene.hinges.remove(h).name;
                    slip(scene, &format!("at {name}"))
                })
                .collect()
        },
    },
    Belief {
        code: "MOMENTUM_WITH_HINGE",
        belief: "linear momentum is taken as conserved although a hinge or the ground gives an impulse",
        hint: "which impulses act on the system from outside?",
        slips: |s| {
            let mut found = Vec::new();
            for axis in 0..2 {
                for (hinge, h) in s.hinges.iter().enumerate() {
                    for instead in rigid(s) {
                        found.push(changed(
                            s,
                            Change::NoHingeImpulse {
                                hinge,
                                axis,
                                instead,
                            },
                            &format!("at {}", h.name),
                        ));
                    }
                }
                for (contact, c) in s
                    .contacts
                    .iter()
                    .enumerate()
                    .filter(|(_, c)| c.law == ContactLaw::Sticking)
                {
                    if c.bodies.iter().any(|b| s.bodies[*b].is_fixed()) {
                        for instead in rigid(s) {
                            found.push(changed(
                                s,
                                Change::NoContactImpulse {
                                    contact,
                                    axis,
                                    instead,
                                },
                                &format!("at {}", c.name),
                            ));
                        }
                    }
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
            let moving: Vec<usize> = (0..s.bodies.len())
                .filter(|b| !s.bodies[*b].is_fixed())
                .collect();
            let mut systems: Vec<Vec<usize>> = moving.iter().map(|b| vec![*b]).collect();
            if moving.len() > 1 {
                systems.push(moving);
            }
            for bodies in systems {
                for (about, name) in all_places(s) {
                    for instead in rigid(s).filter(|b| bodies.contains(b)) {
                        let change = Change::MomentsIgnored {
                            bodies: bodies.clone(),
                            about: about.clone(),
                            instead,
                        };
                        found.push(changed(s, change, &format!("about {name}")));
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
            movable(s)
                .filter(|_| movable(s).count() > 1)
                .map(|b| {
                    let mut scene = s.clone();
                    scene.bodies[b].shape = Shape::Fixed;
                    slip(scene, &format!("of {}", s.bodies[b].name))
                })
                .collect()
        },
    },
    Belief {
        code: "MASS_IGNORED",
        belief: "a body is taken as massless: its momentum is left out",
        hint: "which bodies carry momentum?",
        slips: |s| {
            movable(s)
                .filter(|_| movable(s).count() > 1)
                .map(|b| {
                    let mut scene = s.clone();
                    scene.bodies[b].mass = Expr::zero();
                    scene.bodies[b].inertia = Expr::zero();
                    slip(scene, &format!("of {}", s.bodies[b].name))
                })
                .collect()
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
            let swap = |v: &Vector| [super::partial::swap(&v[0]), super::partial::swap(&v[1])];
            let mut all = s.clone();
            let mut motion = s.clone();
            let mut normals = s.clone();
            for (b, body) in s.bodies.iter().enumerate() {
                all.bodies[b].center = swap(&body.center);
                motion.bodies[b].velocity = swap(&body.velocity);
            }
            for (c, contact) in s.contacts.iter().enumerate() {
                all.contacts[c].at = swap(&contact.at);
                normals.contacts[c].normal = contact.normal.as_ref().map(swap);
            }
            for (h, hinge) in s.hinges.iter().enumerate() {
                all.hinges[h].at = swap(&hinge.at);
            }
            vec![
                slip(all, "in the positions"),
                slip(motion, "in the velocities before"),
                slip(normals, "in the normal"),
            ]
        },
    },
    Belief {
        code: "LENGTH_HALVED",
        belief: "half a length stands for the whole, or the whole for its half",
        hint: "is a length in your formula the whole or the half?",
        slips: lengths,
    },
    Belief {
        code: "ARM_TO_END",
        belief: "the center of mass is put at the far end: l stands for l/2 in the arm",
        hint: "where is the center of mass?",
        slips: |s| {
            let mut found = Vec::new();
            for b in movable(s).filter(|b| !s.bodies[*b].is_particle()) {
                for (at, name) in places(s, b) {
                    for (k, words) in [(Expr::from(2), "twice"), (Expr::ratio(1, 2), "half")] {
                        let mut scene = s.clone();
                        let arm = minus(&s.bodies[b].center, &at);
                        scene.bodies[b].center =
                            [&at[0] + &(&arm[0] * &k), &at[1] + &(&arm[1] * &k)];
                        found.push(slip(
                            scene,
                            &format!(
                                "{words} the arm from {name} to the center of {}",
                                s.bodies[b].name
                            ),
                        ));
                    }
                }
            }
            found
        },
    },
    Belief {
        code: "NORMAL_TURNED",
        belief: "the normal is taken along the surface",
        hint: "in which direction does a frictionless contact push?",
        slips: |s| {
            frictionless(s)
                .filter_map(|c| {
                    let mut scene = s.clone();
                    let [x, y] = s.contacts[c].normal.clone()?;
                    scene.contacts[c].normal = Some([-y, x]);
                    Some(slip(scene, &format!("at {}", s.contacts[c].name)))
                })
                .collect()
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
        slips: |s| vec![changed(s, Change::NoTranslationEnergy, "")],
    },
    Belief {
        code: "POINT_IS_CENTER",
        belief: "the velocity of a point of the body is taken as that of its center of mass",
        hint: "do all points of a turning body move alike?",
        slips: |s| vec![changed(s, Change::PointIsCenter, "")],
    },
];
