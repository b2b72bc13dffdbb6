//! What students believe of the motions between impacts: each belief alters the stages of a scene.
//!
//! In: a scene with stages. Out: the same scene as believed; the story is told again from there.

use super::slips::{each, other_shapes, slip, sticking};
use super::{BELIEFS, Belief, Slip};
use crate::answer::Answer;
use crate::derive;
use crate::expr::{Expr, dot, minus};
use crate::formula::among;
use crate::scene::{Ask, EnergyWhen, Question, Scene, Stage, StageKind, Turn};

/// The beliefs about motions.
pub(in crate::grade) const MOTIONS: &[Belief] = &[
    Belief {
        code: "WEIGHT_FORGOTTEN",
        belief: "the weight is left out of the motion",
        hint: "which forces do work on the way?",
        slips: |s| {
            motions(s, &|stage| {
                let rubs = matches!(&stage.kind, StageKind::Slide(s) if s.friction.is_some());
                gravity(&mut stage.kind)
                    .filter(|_| !rubs)
                    .and_then(Option::take)
                    .is_some()
            })
        },
    },
    Belief {
        code: "HEIGHT_SIGN",
        belief: "the work of the weight has the wrong sign",
        hint: "does the center of mass rise or fall on the way?",
        slips: |s| motions(s, &|stage| scaled(stage, -1)),
    },
    Belief {
        code: "HEIGHT_OF_END",
        belief: "the height of the end stands for that of the center of mass",
        hint: "whose height counts for the work of the weight?",
        slips: |s| {
            motions(s, &|stage| {
                // A particle on a string has no end but itself.
                let point = turned(stage).is_some_and(|(_, inertia)| inertia.is_zero());
                matches!(stage.kind, StageKind::Turn(_)) && !point && scaled(stage, 2)
            })
        },
    },
    Belief {
        code: "FRICTION_FORGOTTEN",
        belief: "friction is left out of the motion",
        hint: "which forces do work on the way?",
        slips: |s| {
            motions(s, &|stage| match &mut stage.kind {
                StageKind::Slide(slide) => slide.friction.take().is_some(),
                _ => false,
            })
        },
    },
    Belief {
        code: "PARALLEL_AXIS_DROPPED",
        belief: "the moment of inertia about the center is used for a rotation about another point",
        hint: "is the moment of inertia you use the one about the point that stays where it is?",
        slips: |s| motions(s, &|stage| about_another(stage, -1)),
    },
    Belief {
        code: "INERTIA_ABOUT_POINT",
        belief: "the moment of inertia about the fixed point stands where the one about the center of mass belongs",
        hint: "about which point is your moment of inertia?",
        slips: |s| motions(s, &|stage| about_another(stage, 1)),
    },
    Belief {
        code: "ROTATION_ENERGY_FORGOTTEN",
        belief: "a body that rolls or unwinds is taken to slide without friction: the energy of its rotation is left out",
        hint: "which parts has the kinetic energy of a body that turns as it moves on?",
        slips: |s| motions(s, &without_rotation),
    },
    Belief {
        code: "POINT_MASS",
        belief: "the body is treated as if all its mass sat at its center",
        hint: "does the body resist being turned?",
        slips: |s| {
            motions(s, &|stage| {
                turned(stage)
                    .is_some_and(|(_, inertia)| !std::mem::replace(inertia, Expr::zero()).is_zero())
            })
        },
    },
    Belief {
        code: "INERTIA_OF_OTHER_SHAPE",
        belief: "the moment of inertia of another shape is used",
        hint: "which shape has the moment of inertia you used?",
        slips: rolls_as_another,
    },
];

/// The scene with a body that rolls taken for one of another shape.
fn rolls_as_another(s: &Scene) -> Vec<Slip> {
    let stages = s.stages.iter().enumerate();
    let rolling = stages.filter_map(|(k, stage)| match &stage.kind {
        StageKind::Slide(slide) if slide.rolling => Some((k, &stage.scene, slide.body)),
        _ => None,
    });
    let others = rolling.flat_map(|(k, scene, b)| {
        let others = other_shapes(scene, b).into_iter();
        let other = others.filter(move |(value, _)| *value != scene.bodies[b].inertia);
        other.map(move |other| (k, b, other))
    });
    each(s, others, |scene, (k, b, (value, place))| {
        let stage = &mut scene.stages[k];
        stage.scene.bodies[b].inertia = value;
        Some(format!("in {} {place}", stage.name))
    })
}

/// What is believed of impacts that shows in what comes after them.
const ON_THE_WAY: &str = "ELASTIC PLASTIC RESTITUTION_SIGN RESTITUTION_ENERGY PARALLEL_AXIS_DROPPED POINT_MASS RECOIL_IGNORED";

/// Every way in which a belief can show in a scene with stages: in its motions, and in its impacts, whose outcome goes on.
pub(in crate::grade) fn in_stages(s: &Scene) -> Vec<(&'static Belief, Slip)> {
    let mut found: Vec<(&Belief, Slip)> = Vec::new();
    for belief in MOTIONS {
        found.extend((belief.slips)(s).into_iter().map(|slip| (belief, slip)));
    }
    let impacts = s.stages.iter().enumerate();
    for (k, stage) in impacts.filter(|(_, s)| matches!(s.kind, StageKind::Impact { .. })) {
        for belief in BELIEFS.iter().filter(|b| among(ON_THE_WAY, b.code)) {
            // What changes equations and not the scene cannot be handed to the story.
            let slips = (belief.slips)(&stage.scene).into_iter();
            found.extend(slips.filter(|slip| slip.change.is_none()).map(|one| {
                let mut scene = s.clone();
                scene.stages[k].scene = one.scene;
                let place = [one.place.as_str(), "in", &stage.name].join(" ");
                (belief, slip(scene, place.trim_start().to_string()))
            }));
        }
    }
    let kept = BELIEFS.iter().find(|b| b.code == "ENERGY_KEPT");
    let kept = kept.map(|belief| energy_kept(s).into_iter().map(move |slip| (belief, slip)));
    found.extend(kept.into_iter().flatten());
    found
}

/// Kinetic energy kept in an impact that begins as the file says: the bodies come in faster, by so much that they leave with
/// all that they had.
fn energy_kept(s: &Scene) -> Vec<Slip> {
    each(s, 0..s.stages.len(), |scene, k| {
        let stage = &mut scene.stages[k];
        let mut alone = stage.from_the_file()?;
        // Impulses and losses are not those of bodies that come in faster.
        let moves = |q: &Question| matches!(q.ask, Ask::Velocity { .. } | Ask::Spin { .. });
        if sticking(&alone).next().is_none() || !alone.questions.iter().all(moves) {
            return None;
        }
        alone.questions = [EnergyWhen::Lost, EnergyWhen::After]
            .map(|when| Question::new("energy", None, Ask::Energy { when, of: None }))
            .to_vec();
        let energies = derive::derive(&alone).ok()?.answers;
        let energies: Option<Vec<&Expr>> = energies.iter().map(Answer::formula).collect();
        let [lost, after] = energies?[..] else {
            return None;
        };
        if after.is_zero() {
            return None;
        }
        let faster = (Expr::one() + lost / after).sqrt();
        let bodies = alone.bodies.iter().enumerate();
        let start = bodies.map(|(b, body)| {
            let velocity = body.velocity.each_ref().map(|v| v * &faster);
            (b, Some(velocity), Some(&body.spin * &faster))
        });
        stage.start = start.collect();
        Some(format!("in {}", stage.name))
    })
}

/// The scene with one motion changed, for each that `change` changes.
fn motions(s: &Scene, change: &dyn Fn(&mut Stage) -> bool) -> Vec<Slip> {
    each(s, 0..s.stages.len(), |scene, k| {
        change(&mut scene.stages[k]).then(|| format!("in {}", s.stages[k].name))
    })
}

/// Where a motion has its gravity.
fn gravity(kind: &mut StageKind) -> Option<&mut Option<Expr>> {
    match kind {
        StageKind::Turn(turn) => Some(&mut turn.gravity),
        StageKind::Slide(slide) => Some(&mut slide.gravity),
        StageKind::Fall(fall) => Some(&mut fall.gravity),
        StageKind::Linkage(linkage) => Some(&mut linkage.gravity),
        StageKind::Impact { .. } | StageKind::Wind(_) => None,
    }
}

/// The weight of a motion times a number; not where it presses a body on rough ground.
fn scaled(stage: &mut Stage, by: i64) -> bool {
    let rubs = matches!(&stage.kind, StageKind::Slide(slide) if slide.friction.is_some());
    let weight = gravity(&mut stage.kind).filter(|_| !rubs);
    match weight.and_then(Option::as_mut) {
        Some(g) => {
            *g = &Expr::from(by) * &*g;
            true
        }
        None => false,
    }
}

/// A body that rolls slides, and what unwinds has no inertia: all energy is that of the motion of centers.
fn without_rotation(stage: &mut Stage) -> bool {
    let moves = match &mut stage.kind {
        StageKind::Slide(slide) if slide.rolling => {
            slide.rolling = false;
            slide.friction = Some(Expr::zero());
            return true;
        }
        StageKind::Linkage(linkage) => {
            let moves = |e: &Expr| e.mentions(&linkage.coordinate);
            let rolls = |[x, y, angle]: &[Expr; 3]| moves(angle) && (moves(x) || moves(y));
            let places = linkage.places.iter().filter(|(_, at)| rolls(at));
            places.map(|(b, _)| *b).collect()
        }
        _ => Vec::new(),
    };
    let mut found = false;
    for b in moves {
        let inertia = &mut stage.scene.bodies[b].inertia;
        found |= !std::mem::replace(inertia, Expr::zero()).is_zero();
    }
    found
}

/// The rotation that a stage is, of one body, and that body's moment of inertia about its center.
fn turned(stage: &mut Stage) -> Option<(Turn, &mut Expr)> {
    let StageKind::Turn(turn) = &stage.kind else {
        return None;
    };
    let turn = turn.clone();
    let body = stage.scene.bodies.get_mut(turn.body)?;
    turn.with.is_empty().then_some((turn, &mut body.inertia))
}

/// The moment of inertia of a body that turns, with the parallel-axis term of its fixed point added or taken away.
fn about_another(stage: &mut Stage, sign: i64) -> bool {
    let Some((turn, inertia)) = turned(stage) else {
        return false;
    };
    let inertia = inertia.clone();
    let body = &mut stage.scene.bodies[turn.body];
    let r = minus(&turn.about, &body.center);
    body.inertia = inertia + Expr::from(sign) * &body.mass * dot(&r, &r);
    true
}
