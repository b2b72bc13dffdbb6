//! Questions that are answered by a formula of the geometry and of velocities just after: speed, direction, what was before,
//! angular momentum and moment of inertia about a point, the instantaneous center.
//!
//! Each becomes a [`Ask::Value`]; the velocities it takes are asked for too, unless they are already.

use super::impact;
use crate::dimension::Dimension;
use crate::expr::{Expr, Vector, cross, dot, minus};
use crate::formula::with_subscript;
use crate::scene::fault::Fault;
use crate::scene::place_file::PositionFile;
use crate::scene::question_file::QuestionFile;
use crate::scene::record::Text;
use crate::scene::resolver::Resolver;
use crate::scene::stage_file::{EndName, StageFile};
use crate::scene::{Ask, Question, Scene, geometry};

/// Reads one question of a scene of one impact into the scene.
pub(super) fn resolve(
    resolver: &mut Resolver<'_>,
    scene: &mut Scene,
    name: &Text,
    q: &QuestionFile,
    kind: &str,
) -> Option<()> {
    let is_start = q.when == Some(EndName::Start);
    let latex = q.latex.as_ref().map(|t| t.text.as_str());
    let meaning = meaning(q, &[]);
    let named = |scene: &mut Scene, suffix: &str, formula: Expr, polar: Option<Vector>| {
        let (latex, meaning) = match suffix.strip_prefix('_') {
            Some(axis) => (
                latex.map(|l| with_subscript(l, axis)),
                format!("{meaning}, {axis}"),
            ),
            None => (latex.map(str::to_owned), meaning.clone()),
        };
        let name = format!("{}{suffix}", name.text);
        let ask = Ask::Value {
            formula,
            with: Vec::new(),
            meaning,
            dimension: Some(dimension(kind)),
            polar,
        };
        scene.questions.push(Question::new(&name, latex, ask));
    };
    let push = |scene: &mut Scene, suffix: &str, formula: Expr| named(scene, suffix, formula, None);
    match kind {
        "inertia" => {
            let formula = inertia(resolver, scene, name, q)?;
            push(scene, "", formula);
        }
        "angular_momentum" => {
            let b = resolver.moving(q.angular_momentum.as_ref()?)?;
            let at = about(resolver, name, q)?;
            let after = (!is_start).then(|| (velocity_after(scene, b), spin_after(scene, b)));
            let body = &scene.bodies[b];
            let before = || (body.velocity.clone(), body.spin.clone());
            let (velocity, spin) = after.unwrap_or_else(before);
            let arm = minus(&body.center, &at);
            let formula = &body.mass * &cross(&arm, &velocity) + &body.inertia * &spin;
            push(scene, "", formula);
        }
        "speed" | "direction" => {
            let v = asked_velocity(resolver, scene, q)?;
            match q.direction {
                None => push(scene, "", size(&v)),
                Some(_) => {
                    let (angle, polar) = direction(v, q.clockwise == Some(true));
                    named(scene, "", angle, Some(polar));
                }
            }
        }
        "instantaneous_center" => {
            let b = resolver.moving(q.instantaneous_center.as_ref()?)?;
            if resolver.is_particle(b) {
                let message = "a particle has no spin, and so no instantaneous center";
                return Fault::new(name.span, message).add_to(&mut resolver.faults);
            }
            let (v, spin) = (velocity_after(scene, b), spin_after(scene, b));
            let [x, y] = scene.bodies[b].center.clone();
            // v = ω k × (G − C): C lies v/ω to the left of the motion of G.
            push(scene, "_x", x - &v[1] / &spin);
            push(scene, "_y", y + &v[0] / &spin);
        }
        "spin" => {
            let b = resolver.moving(q.spin.as_ref()?)?;
            let spin = scene.bodies[b].spin.clone();
            let clockwise = q.clockwise == Some(true);
            push(scene, "", if clockwise { -spin } else { spin });
        }
        _ => {
            let of = q.velocity.as_ref()?;
            let (b, point) = impact::velocity(resolver, scene, of, q.of.as_ref())?;
            let body = &scene.bodies[b];
            let v = body.velocity_at(point.as_ref().map_or(&body.center, |(_, at)| at));
            match &q.along {
                Some(along) => {
                    let along = resolver.direction(along)?;
                    push(scene, "", dot(&v, &along));
                }
                None => {
                    let [x, y] = v;
                    push(scene, "_x", x);
                    push(scene, "_y", y);
                }
            }
        }
    }
    Some(())
}

/// The dimension of one of these.
pub(super) fn dimension(kind: &str) -> Dimension {
    match kind {
        "inertia" => Dimension::new(1, 2, 0),
        "angular_momentum" => Dimension::new(1, 2, -1),
        "instantaneous_center" => Dimension::new(0, 1, 0),
        "spin" => Dimension::new(0, 0, -1),
        "direction" => Dimension::none(),
        _ => Dimension::new(0, 1, -1),
    }
}

/// The velocity of which the size or the direction is asked.
fn asked_velocity(
    resolver: &mut Resolver<'_>,
    scene: &mut Scene,
    q: &QuestionFile,
) -> Option<Vector> {
    let of = q.speed.as_ref().or(q.direction.as_ref())?;
    let (b, point) = impact::velocity(resolver, scene, of, q.of.as_ref())?;
    let at = point.map(|(_, at)| at);
    let body = &scene.bodies[b];
    Some(match q.when {
        Some(EndName::Start) => body.velocity_at(at.as_ref().unwrap_or(&body.center)),
        _ => {
            let v = velocity_after(scene, b);
            moved(scene, b, v, at.as_ref())
        }
    })
}

/// What one of these is, in words; where it belongs to the end of a motion, to that of its stage.
pub(super) fn meaning(q: &QuestionFile, stages: &[StageFile]) -> String {
    let of = [
        ("speed", &q.speed),
        ("direction of the velocity", &q.direction),
        ("moment of inertia", &q.inertia),
        ("instantaneous center", &q.instantaneous_center),
        ("angular momentum", &q.angular_momentum),
        ("velocity", &q.velocity),
        ("angular velocity", &q.spin),
    ];
    let mut of = of.iter();
    let Some((what, body)) = of.find_map(|(what, body)| Some((*what, body.as_ref()?))) else {
        return String::new();
    };
    let when = match (what, q.when) {
        ("moment of inertia", _) => String::new(),
        (_, Some(EndName::Start)) => String::from(" just before"),
        _ => {
            let named = |s: &&StageFile| q.at.as_ref().is_none_or(|at| at.text == s.name.text);
            match stages.iter().rfind(named) {
                Some(s) if s.impact.is_none() => format!(" at the end of `{}`", s.name.text),
                _ => String::from(" just after"),
            }
        }
    };
    let sense = match (&q.direction, q.clockwise) {
        (None, _) => "",
        (Some(_), Some(true)) => ", clockwise from x",
        (Some(_), _) => ", counterclockwise from x",
    };
    match &q.of {
        // A velocity names the point, and `of` its body.
        Some(of) => format!("{what} of {} of `{}`{when}{sense}", body.text, of.text),
        None => format!(
            "{what} of `{}`{}{when}{sense}",
            body.text,
            place(q, &body.text)
        ),
    }
}

/// The point to which a question refers, in words.
fn place(q: &QuestionFile, body: &str) -> String {
    match &q.about {
        Some(PositionFile::Name(name)) if name.text == body => " about its center of mass".into(),
        Some(PositionFile::Name(name)) => format!(" about `{}`", name.text),
        _ => String::new(),
    }
}

/// The moment of inertia of a body about a point of it (Huygens and Steiner).
pub(super) fn inertia(
    resolver: &mut Resolver<'_>,
    scene: &Scene,
    name: &Text,
    q: &QuestionFile,
) -> Option<Expr> {
    let b = resolver.moving(q.inertia.as_ref()?)?;
    let at = about(resolver, name, q)?;
    let body = scene.bodies.get(b)?;
    let arm = minus(&body.center, &at);
    Some(&body.inertia + &body.mass * &dot(&arm, &arm))
}

fn about(resolver: &mut Resolver<'_>, name: &Text, q: &QuestionFile) -> Option<Vector> {
    let Some(about) = &q.about else {
        let inertia = q.inertia.as_ref();
        let what = inertia.map_or("an angular momentum", |_| "a moment of inertia");
        let message = format!("{what} needs the point `about` which it is meant");
        return Fault::new(name.span, message).add_to(&mut resolver.faults);
    };
    resolver.position(about)
}

/// The components of a velocity that is asked for under this name.
pub(super) fn parts_of(velocity: &str) -> Vector {
    ["x", "y"].map(|axis| Expr::symbol(&format!("{velocity}_{axis}")))
}

pub(super) fn size(v: &Vector) -> Expr {
    (v[0].powi(2) + v[1].powi(2)).sqrt()
}

/// The angle of a direction from the x axis, by that of its half, and the components that make it: counted clockwise, those of
/// its mirror image in that axis.
pub(super) fn direction([x, y]: Vector, clockwise: bool) -> (Expr, Vector) {
    let v = [x, if clockwise { -y } else { y }];
    let half = (&v[1] / (size(&v) + &v[0])).atan();
    (half * Expr::from(2), v)
}

/// Velocity just after of another point, from that of the center of mass.
fn moved(scene: &mut Scene, b: usize, v: Vector, at: Option<&Vector>) -> Vector {
    let Some(at) = at else {
        return v;
    };
    let spin = spin_after(scene, b);
    let turned = geometry::turned(&spin, &minus(at, &scene.bodies[b].center));
    [0, 1].map(|i| &v[i] + &turned[i])
}

/// The names of the velocity just after, asked for if it is not.
fn velocity_after(scene: &mut Scene, b: usize) -> Vector {
    let same =
        |ask: &Ask| matches!(ask, Ask::Velocity { body, point: None, along: None } if *body == b);
    let ask = Ask::Velocity {
        body: b,
        point: None,
        along: None,
    };
    let name = named(scene, b, "v", same, ask);
    ["x", "y"].map(|axis| Expr::symbol(&format!("{name}_{axis}")))
}

/// The name of the spin just after, asked for if it is not; 0 of a particle.
fn spin_after(scene: &mut Scene, b: usize) -> Expr {
    if scene.bodies[b].is_particle() {
        return Expr::zero();
    }
    let same = |ask: &Ask| matches!(ask, Ask::Spin { body, clockwise: false } if *body == b);
    let ask = Ask::Spin {
        body: b,
        clockwise: false,
    };
    Expr::symbol(&named(scene, b, "omega", same, ask))
}

fn named(
    scene: &mut Scene,
    b: usize,
    letter: &str,
    same: impl Fn(&Ask) -> bool,
    ask: Ask,
) -> String {
    if let Some(found) = scene.questions.iter().find(|q| same(&q.ask)) {
        return found.name.clone();
    }
    let body = &scene.bodies[b].name;
    let is_word = body.chars().all(|c| c.is_ascii_alphanumeric());
    let mut name = match is_word {
        true => format!("{letter}_{body}"),
        false => format!("{letter}_{}", b + 1),
    };
    let is_taken = |name: &str| scene.parameter(name).is_some() || scene.question(name).is_some();
    while is_taken(&name) {
        name.push_str("_after");
    }
    scene.questions.push(Question::new(&name, None, ask));
    name
}
