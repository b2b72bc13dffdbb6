//! The three kinds of picture: before, free body during the collision, after.
//!
//! In: a scene on stage, and the motion after as numbers. Out: a sheet. Which forces have no impulse is the scene's
//! statement; this module only repeats it.

use std::f64::consts::PI;

use super::label::{Label, Level, is_negative};
use super::measure;
use super::place::{Spot, Wish};
use super::sheet::{Ink, SIZE, SMALL, Sheet};
use super::stage::{DOT, Look, Moment, Stage, center_name};
use super::values::{Pair, dot, size};
use crate::expr::{Expr, Point, Vector};
use crate::numeric::system::Unknown;
use crate::numeric::{Motion, assemble, given, motion, solve_f64};
use crate::scene::{Ask, BlowImpulse, Body, ContactLaw, ImpulseAt};

/// Longest arrow in pixels.
const LONG: f64 = 62.0;
/// Shortest arrow in pixels.
const SHORT: f64 = 24.0;

/// The motion after at the values the scene is drawn at; `None` where the equations contradict each other.
pub fn outcome(stage: &Stage) -> Option<Motion<f64>> {
    let point: &Point<f64> = &stage.values.point;
    let given = given(stage.scene, point).ok()?;
    let system = assemble(&given);
    let solution = solve_f64(&system).ok()?;
    let finite = solution.values.iter().all(|v| v.is_finite());
    finite.then(|| motion(&given, &system, &solution))
}

fn arrow_length(value: f64, most: f64) -> f64 {
    if most > 0.0 {
        (LONG * value / most).max(SHORT)
    } else {
        SHORT
    }
}

fn fastest(stage: &Stage, after: Option<&Motion<f64>>) -> f64 {
    let before = stage
        .scene
        .bodies
        .iter()
        .filter_map(|b| stage.values.pair(&b.velocity))
        .map(size);
    let after = after
        .iter()
        .flat_map(|m| m.velocity.iter().map(|v| size(*v)));
    before
        .chain(after.filter(|v| v.is_finite()))
        .fold(0.0, f64::max)
}

fn all_bodies(stage: &Stage, sheet: &mut Sheet, moment: Moment, velocity: &[Pair]) -> Vec<Pair> {
    stage.fixed(sheet);
    let mut asides = Vec::new();
    for (i, pose) in stage.poses.iter().enumerate() {
        let aside = stage.aside(i, moment, velocity);
        stage.body(sheet, pose, aside);
        asides.push(aside);
    }
    stage.hinges(sheet, &|_| true);
    asides
}

/// Just before: bodies, dimensions, velocities, spins.
pub fn before(stage: &Stage, after: Option<&Motion<f64>>) -> Sheet {
    let mut sheet = Sheet::default();
    let scene = stage.scene;
    let asides = all_bodies(stage, &mut sheet, Moment::Before, &[]);
    centers(stage, &mut sheet, &stage.movable());
    let most = fastest(stage, after);
    for (i, body) in scene.bodies.iter().enumerate() {
        let (Some(v), Some(spin)) = (
            stage.values.pair(&body.velocity),
            stage.values.of(&body.spin),
        ) else {
            continue;
        };
        let start = stage.px(stage.poses[i].center);
        let start = [start[0] + asides[i][0], start[1] + asides[i][1]];
        let start = if body.is_fixed() {
            wall_point(stage, i).unwrap_or(start)
        } else {
            start
        };
        // A body that turns about a hinge is told by its spin.
        let hinged = body.velocity.iter().map(Expr::size).sum::<usize>() > 30 && spin != 0.0;
        if size(v) > 1e-9 * most && !hinged {
            let label = speed(stage, i, &body.velocity, v);
            velocity(
                &mut sheet,
                start,
                v,
                arrow_length(size(v), most),
                label,
                body.is_particle(),
            );
        }
        if spin.abs() > 1e-12 && !body.is_particle() {
            let e = if (spin < 0.0) == is_negative(&body.spin) {
                body.spin.clone()
            } else {
                -&body.spin
            };
            let e = if is_negative(&e) { -&e } else { e };
            let mut label = Label::formula(&e, scene);
            if stage.values.of(&e).is_some_and(|value| value < 0.0) {
                label = label.negated();
            }
            turning(stage, &mut sheet, i, spin, label, [0.0, 0.0]);
        }
    }
    for push in impulses(stage, &stage.movable(), after) {
        if push.is_blow {
            push.draw(stage, &mut sheet, LONG);
        }
    }
    measure::measure(stage, &mut sheet);
    names(stage, &mut sheet, &stage.movable(), true);
    masses(stage, &mut sheet, &asides);
    sheet.settle();
    axes(&mut sheet);
    sheet
}

/// Just after, at the values the scene is drawn at.
pub fn after(stage: &Stage, motion: &Motion<f64>) -> Sheet {
    let mut sheet = Sheet::default();
    let scene = stage.scene;
    let asides = all_bodies(stage, &mut sheet, Moment::After, &motion.velocity);
    centers(stage, &mut sheet, &stage.movable());
    let most = fastest(stage, Some(motion));
    let fastest_spin = motion.spin.iter().fold(0.0, |m: f64, s| m.max(s.abs()));
    for (i, body) in scene.bodies.iter().enumerate() {
        let known =
            motion.determines(Unknown::VelocityX(i)) && motion.determines(Unknown::VelocityY(i));
        let v = motion.velocity[i];
        let start = stage.px(stage.poses[i].center);
        let start = [start[0] + asides[i][0], start[1] + asides[i][1]];
        let told = body.is_particle() && asked_at(stage, motion, stage.poses[i].center, v);
        if known && size(v) > 1e-7 * most && !body.is_fixed() && !told {
            velocity(
                &mut sheet,
                start,
                v,
                arrow_length(size(v), most),
                velocity_name(stage, i),
                false,
            );
        }
        let spin = motion.spin[i];
        let known = motion.determines(Unknown::Spin(i));
        if known && spin.abs() > 1e-7 * fastest_spin && !body.is_particle() && !body.is_fixed() {
            turning(stage, &mut sheet, i, spin, spin_name(stage, i, spin), v);
        }
    }
    for question in &scene.questions {
        let Ask::Velocity {
            body,
            point: Some((_, at)),
            along: None,
        } = &question.ask
        else {
            continue;
        };
        let (Some(p), Some(v)) = (stage.values.pair(at), motion.velocity.get(*body)) else {
            continue;
        };
        let r = [
            p[0] - stage.poses[*body].center[0],
            p[1] - stage.poses[*body].center[1],
        ];
        let spin = motion.spin[*body];
        let v = [v[0] - spin * r[1], v[1] + spin * r[0]];
        let known = [
            Unknown::VelocityX(*body),
            Unknown::VelocityY(*body),
            Unknown::Spin(*body),
        ];
        if size(v) > 1e-7 * most && known.into_iter().all(|u| motion.determines(u)) {
            let label = vector_name(&question.name, question.latex.as_deref());
            velocity(
                &mut sheet,
                stage.px(p),
                v,
                arrow_length(size(v), most.max(size(v))),
                label,
                false,
            );
        }
    }
    names(stage, &mut sheet, &stage.movable(), true);
    sheet.settle();
    sheet
}

/// Whether a question about a point of another body already shows this velocity here.
fn asked_at(stage: &Stage, motion: &Motion<f64>, at: Pair, v: Pair) -> bool {
    stage.scene.questions.iter().any(|question| {
        let Ask::Velocity {
            body,
            point: Some((_, p)),
            along: None,
        } = &question.ask
        else {
            return false;
        };
        let Some(p) = stage.values.pair(p) else {
            return false;
        };
        let r = [
            p[0] - stage.poses[*body].center[0],
            p[1] - stage.poses[*body].center[1],
        ];
        let (u, spin) = (motion.velocity[*body], motion.spin[*body]);
        let u = [u[0] - spin * r[1], u[1] + spin * r[0]];
        size([p[0] - at[0], p[1] - at[1]]) < 1e-9
            && size([u[0] - v[0], u[1] - v[1]]) <= 1e-6 * size(v)
    })
}

/// The free body (or system) during the collision, with impulses only.
pub fn during(
    stage: &Stage,
    system: &[usize],
    motion: Option<&Motion<f64>>,
) -> (Sheet, Vec<String>) {
    let mut sheet = Sheet::default();
    for i in system {
        let aside = stage.aside(*i, Moment::During, &[]);
        let aside = if system.len() > 1 { aside } else { [0.0, 0.0] };
        stage.body(&mut sheet, &stage.poses[*i], aside);
    }
    stage.hinges(&mut sheet, &|bodies| {
        bodies.iter().any(|b| system.contains(b))
    });
    centers(stage, &mut sheet, system);
    let pushes = impulses(stage, system, motion);
    let most = pushes.iter().map(|p| size(p.vector)).fold(0.0, f64::max);
    let mut notes = Vec::new();
    for push in &pushes {
        if size(push.vector) <= 1e-9 * most || most == 0.0 {
            notes.push(format!(
                "{} is zero at these values.",
                push.label.text().trim_start_matches('−')
            ));
            continue;
        }
        push.draw(stage, &mut sheet, arrow_length(size(push.vector), most));
    }
    if pushes.is_empty() {
        let what = if system.len() > 1 { "the system" } else { "it" };
        notes.push(format!("No impulse from outside acts on {what}."));
    }
    notes.extend(left_out(stage, system));
    names(stage, &mut sheet, system, false);
    sheet.settle();
    (sheet, notes)
}

/// Finite forces on the bodies, and why they are not drawn.
fn left_out(stage: &Stage, system: &[usize]) -> Option<String> {
    let mut names: Vec<&str> = Vec::new();
    for force in stage
        .scene
        .forces
        .iter()
        .filter(|f| system.contains(&f.body))
    {
        if !names.contains(&force.name.as_str()) {
            names.push(&force.name);
        }
    }
    (!names.is_empty()).then(|| {
        let (it, s) = if names.len() == 1 {
            ("is", "")
        } else {
            ("are", "s")
        };
        format!(
            "Left out: {}, which {it} finite and ha{} no impulse in so short a time.",
            names.join(", "),
            if s.is_empty() { "s" } else { "ve" }
        )
    })
}

/// An impulse on a body of a system.
struct Push {
    at: Pair,
    vector: Pair,
    label: Label,
    body: usize,
    presses: bool,
    is_blow: bool,
}

impl Push {
    /// Draws the arrow: up to the body where it pushes, else away from it.
    fn draw(&self, stage: &Stage, sheet: &mut Sheet, length: f64) {
        if size(self.vector) < 1e-300 {
            return;
        }
        let at = stage.px(self.at);
        let center = stage.px(stage.poses[self.body].center);
        let inward = [center[0] - at[0], center[1] - at[1]];
        let d = [
            self.vector[0] / size(self.vector),
            self.vector[1] / size(self.vector),
        ];
        let pushing = dot(d, inward) > 0.25 * size(inward) && size(inward) > 1.0;
        let free = if stage.scene.bodies[self.body].is_particle() {
            DOT + 2.0
        } else {
            2.0
        };
        let (from, to) = if pushing || (size(inward) <= 1.0 && self.presses) {
            (
                [
                    at[0] - d[0] * (length + free),
                    at[1] - d[1] * (length + free),
                ],
                [at[0] - d[0] * free, at[1] - d[1] * free],
            )
        } else {
            (at, [at[0] + d[0] * length, at[1] + d[1] * length])
        };
        sheet.arrow(from, to, Ink::Impulse, 2.2);
        sheet.wish(Wish {
            label: self.label.clone(),
            size: SIZE,
            spot: Spot::Along { from, to },
        });
    }
}

fn impulses(stage: &Stage, system: &[usize], motion: Option<&Motion<f64>>) -> Vec<Push> {
    let scene = stage.scene;
    let mut out = Vec::new();
    let mut add = |from: ImpulseAt,
                   bodies: [Option<usize>; 2],
                   at: &Vector,
                   known: Option<Pair>,
                   along: Option<Pair>,
                   presses: bool,
                   name: &str| {
        let inside: Vec<(usize, f64)> = [(bodies[0], -1.0), (bodies[1], 1.0)]
            .into_iter()
            .filter_map(|(b, sign)| b.filter(|b| system.contains(b)).map(|b| (b, sign)))
            .collect();
        // Between two bodies of the system it cancels.
        let ([(body, sign)], Some(at)) = (inside.as_slice(), stage.values.pair(at)) else {
            return;
        };
        let is_blow = matches!(from, ImpulseAt::Blow(_));
        let given = match from {
            // A given impulse carries its own symbol.
            ImpulseAt::Blow(i) => blow_label(stage, i),
            _ => None,
        };
        let base = match given {
            Some(label) => Named {
                label,
                on: *body,
                scalar: true,
            },
            None => impulse_name(stage, from, name, along.is_some()),
        };
        match (known.filter(|p| size(*p) > 0.0), along) {
            (Some(p), _) => {
                let label = base.label(*body, *sign, along.is_some());
                out.push(Push {
                    at,
                    vector: [p[0] * sign, p[1] * sign],
                    label,
                    body: *body,
                    presses,
                    is_blow,
                });
            }
            (None, Some(n)) if known.is_none() => {
                let label = base.label(*body, *sign, true);
                out.push(Push {
                    at,
                    vector: [n[0] * sign, n[1] * sign],
                    label,
                    body: *body,
                    presses,
                    is_blow,
                });
            }
            (None, _) if known.is_some() => {
                let label = base.label(*body, *sign, along.is_some());
                out.push(Push {
                    at,
                    vector: [0.0, 0.0],
                    label,
                    body: *body,
                    presses,
                    is_blow,
                });
            }
            _ => {
                for (axis, index) in [([1.0, 0.0], "x"), ([0.0, 1.0], "y")] {
                    let mut label = base.plain();
                    match label.runs.iter_mut().find(|r| r.level == Level::Sub) {
                        Some(run) => run.text.push_str(index),
                        None => label.push(index, true, Level::Sub),
                    }
                    let label = if *sign < 0.0 { label.negated() } else { label };
                    out.push(Push {
                        at,
                        vector: axis,
                        label,
                        body: *body,
                        presses: false,
                        is_blow,
                    });
                }
            }
        }
    };
    let sure = |x: Unknown, y: Unknown, m: &Motion<f64>| m.determines(x) && m.determines(y);
    for (i, contact) in scene.contacts.iter().enumerate() {
        let bodies = contact
            .bodies
            .map(|b| Some(b).filter(|b| !scene.bodies[*b].is_fixed()));
        let frictionless = matches!(contact.law, ContactLaw::Frictionless { .. });
        let along = contact
            .normal
            .as_ref()
            .filter(|_| frictionless)
            .and_then(|n| stage.values.pair(n));
        let known = motion.and_then(|m| {
            let is_sure = match frictionless {
                true => m.determines(Unknown::ContactNormal(i)),
                false => sure(Unknown::ContactX(i), Unknown::ContactY(i), m),
            };
            is_sure.then(|| m.contact[i])
        });
        add(
            ImpulseAt::Contact(i),
            bodies,
            &contact.at,
            known,
            along,
            true,
            &contact.name,
        );
    }
    for (i, hinge) in scene.hinges.iter().enumerate() {
        let bodies = hinge
            .bodies
            .map(|b| Some(b).filter(|b| !scene.bodies[*b].is_fixed()));
        let known = motion
            .filter(|m| sure(Unknown::HingeX(i), Unknown::HingeY(i), m))
            .map(|m| m.hinge[i]);
        add(
            ImpulseAt::Hinge(i),
            bodies,
            &hinge.at,
            known,
            None,
            false,
            &hinge.name,
        );
    }
    for (i, blow) in scene.blows.iter().enumerate() {
        let (along, known) = match &blow.impulse {
            BlowImpulse::Given(v) => (None, stage.values.pair(v)),
            BlowImpulse::Along(v) => (
                stage.values.pair(v),
                motion
                    .filter(|m| m.determines(Unknown::Blow(i)))
                    .map(|m| m.blow[i]),
            ),
        };
        add(
            ImpulseAt::Blow(i),
            [None, Some(blow.body)],
            &blow.at,
            known,
            along,
            true,
            &blow.name,
        );
    }
    out
}

/// The symbol of a given impulse, where it has a short one.
fn blow_label(stage: &Stage, i: usize) -> Option<Label> {
    match &stage.scene.blows[i].impulse {
        BlowImpulse::Given(v) => magnitude(stage, v, stage.values.pair(v)?),
        BlowImpulse::Along(_) => None,
    }
}

/// What an impulse is called, and on which body it is counted.
struct Named {
    label: Label,
    on: usize,
    scalar: bool,
}

impl Named {
    fn plain(&self) -> Label {
        let mut label = self.label.clone();
        label.runs.iter_mut().for_each(|r| r.arrow = false);
        label
    }

    fn label(&self, body: usize, sign: f64, directed: bool) -> Label {
        let opposite =
            self.on != usize::MAX && self.on != body || self.on == usize::MAX && sign < 0.0;
        // A scalar along a drawn direction is the arrow's length, whichever body it acts on.
        if self.scalar || directed && !self.label.runs.iter().any(|r| r.arrow) {
            return self.plain();
        }
        if opposite {
            self.label.clone().negated()
        } else {
            self.label.clone()
        }
    }
}

fn impulse_name(stage: &Stage, from: ImpulseAt, name: &str, directed: bool) -> Named {
    let scene = stage.scene;
    for question in &scene.questions {
        if let Ask::Impulse {
            from: asked,
            on,
            along,
        } = &question.ask
            && *asked == from
        {
            let mut label = vector_name(&question.name, question.latex.as_deref());
            if along.is_some() {
                label.runs.iter_mut().for_each(|r| r.arrow = false);
            }
            return Named {
                label,
                on: *on,
                scalar: along.is_some(),
            };
        }
    }
    let several = scene.contacts.len() + scene.hinges.len() + scene.blows.len() > 1;
    let index = if several { name } else { "" };
    let mut label = Label::vector("P", index, "");
    if directed {
        label.runs.iter_mut().for_each(|r| r.arrow = false);
    }
    Named {
        label,
        on: usize::MAX,
        scalar: directed,
    }
}

fn vector_name(name: &str, latex: Option<&str>) -> Label {
    let mut label = Label::symbol(name, latex);
    if latex.is_none()
        && let Some(run) = label
            .runs
            .first_mut()
            .filter(|r| r.text.chars().count() == 1)
    {
        run.arrow = true;
    }
    label
}

/// The index of a body's quantities: nothing for the only one, else its center's name or its own.
fn index(stage: &Stage, body: usize) -> String {
    if stage.movable().len() == 1 {
        return String::new();
    }
    match center_name(stage, body) {
        Some(label) => label.text().chars().map(plain_digit).collect(),
        None => stage.scene.bodies[body].name.clone(),
    }
}

fn plain_digit(c: char) -> char {
    match c {
        '₀'..='₉' => {
            char::from_u32(u32::from(c) - u32::from('₀') + u32::from('0')).unwrap_or(c)
        }
        _ => c,
    }
}

fn velocity_name(stage: &Stage, body: usize) -> Label {
    let asked = stage.scene.questions.iter().find(|q| match &q.ask {
        Ask::Velocity {
            body: b,
            point: None,
            along: None,
        } => *b == body,
        _ => false,
    });
    match asked {
        Some(q) => vector_name(&q.name, q.latex.as_deref()),
        None => {
            let only = stage.movable().len() == 1 && !stage.scene.bodies[body].is_particle();
            let index = if only {
                "G".to_string()
            } else {
                index(stage, body)
            };
            Label::vector("v", &index, "+")
        }
    }
}

fn spin_name(stage: &Stage, body: usize, spin: f64) -> Label {
    for question in &stage.scene.questions {
        if let Ask::Spin { body: b, clockwise } = &question.ask
            && *b == body
        {
            let label = Label::symbol(&question.name, question.latex.as_deref());
            return if (spin < 0.0) == *clockwise {
                label
            } else {
                label.negated()
            };
        }
    }
    let index = index(stage, body);
    let label = Label::latex(&if index.is_empty() {
        "\\omega^{+}".to_string()
    } else {
        format!(
            "\\omega_{{\\mathrm{{{}}}}}^{{+}}",
            index.replace(['{', '}', '\\'], "")
        )
    });
    if spin < 0.0 { label.negated() } else { label }
}

/// The label of a velocity arrow before.
fn speed(stage: &Stage, body: usize, v: &Vector, value: Pair) -> Label {
    magnitude(stage, v, value).unwrap_or_else(|| {
        let scene = stage.scene;
        let pair = Label::words("(")
            .then(Label::formula(&v[0], scene))
            .then(Label::words(", "))
            .then(Label::formula(&v[1], scene))
            .then(Label::words(")"));
        if pair.text().chars().count() <= 14 {
            return pair;
        }
        let index = if stage.movable().len() == 1 {
            "G".to_string()
        } else {
            index(stage, body)
        };
        Label::vector("v", &index, "-")
    })
}

/// The length of a vector as a formula, where it is a short one.
fn magnitude(stage: &Stage, v: &Vector, value: Pair) -> Option<Label> {
    let scene = stage.scene;
    let signed = |e: &Expr, value: f64| {
        let positive = if is_negative(e) { -e } else { e.clone() };
        let label = Label::formula(&positive, scene);
        // What points against its symbol carries a minus sign.
        if (value < 0.0) == is_negative(e) {
            label
        } else {
            label.negated()
        }
    };
    match (v[0].is_zero(), v[1].is_zero()) {
        (true, false) => return Some(signed(&v[1], value[1])),
        (false, true) => return Some(signed(&v[0], value[0])),
        _ => {}
    }
    // A symbol s with |v| = s here and elsewhere: v was written as s along a direction.
    let names = v[0].symbols().into_iter().chain(v[1].symbols());
    let mut elsewhere = stage.values.clone();
    for (k, entry) in elsewhere.point.values.values_mut().enumerate() {
        *entry *= 1.0 + 0.1 * (k as f64 + 1.0);
    }
    for name in names {
        let s = Expr::symbol(&name);
        let fits = [stage.values, &elsewhere].into_iter().all(|values| {
            match (values.pair(v), values.of(&s)) {
                (Some(p), Some(value)) => {
                    (size(p) - value.abs()).abs() < 1e-9 * value.abs().max(1e-300)
                }
                _ => false,
            }
        });
        if fits {
            return Some(Label::formula(&s, scene));
        }
    }
    None
}

/// A velocity arrow from a body, or with its head at a particle that flies towards its target.
fn velocity(sheet: &mut Sheet, at: Pair, v: Pair, length: f64, label: Label, behind: bool) {
    let d = [v[0] / size(v), v[1] / size(v)];
    let (from, to) = if behind {
        (
            [
                at[0] - d[0] * (length + DOT + 3.0),
                at[1] - d[1] * (length + DOT + 3.0),
            ],
            [at[0] - d[0] * (DOT + 3.0), at[1] - d[1] * (DOT + 3.0)],
        )
    } else {
        (at, [at[0] + d[0] * length, at[1] + d[1] * length])
    };
    sheet.arrow(from, to, Ink::Motion, 2.0);
    sheet.wish(Wish {
        label,
        size: SIZE,
        spot: Spot::Along { from, to },
    });
}

/// A curved arrow around a body's center, clear of its velocity.
fn turning(stage: &Stage, sheet: &mut Sheet, body: usize, spin: f64, label: Label, v: Pair) {
    let center = stage.px(stage.poses[body].center);
    let radius = match &stage.poses[body].look {
        Look::Round { radius, .. } => (0.55 * stage.long(*radius)).clamp(14.0, 30.0),
        _ => 20.0,
    };
    let sign = spin.signum();
    let busy = |start: f64| {
        let steps = 12;
        (0..=steps)
            .map(|k| {
                let phi = start + sign * 1.4 * PI * 0.75 * f64::from(k) / f64::from(steps);
                let p = [
                    center[0] + radius * phi.cos(),
                    center[1] + radius * phi.sin(),
                ];
                let near = sheet
                    .walls
                    .iter()
                    .filter(|(a, b, _)| distance(p, *a, *b) < 4.0)
                    .count();
                near as f64
            })
            .sum::<f64>()
    };
    let _ = v;
    let start = (0..12)
        .map(|k| PI * f64::from(k) / 6.0)
        .min_by(|a, b| busy(*a).total_cmp(&busy(*b)))
        .unwrap_or(0.0);
    let sweep = sign * 1.05 * PI;
    sheet.turning(center, radius, start, sweep, Ink::Motion);
    let half = start + sweep / 2.0;
    let at = [
        center[0] + radius * half.cos(),
        center[1] + radius * half.sin(),
    ];
    sheet.wish(Wish {
        label,
        size: SIZE,
        spot: Spot::Point {
            at,
            toward: [half.cos(), half.sin()],
            reach: 2.0,
        },
    });
}

fn distance(p: Pair, a: Pair, b: Pair) -> f64 {
    let d = [b[0] - a[0], b[1] - a[1]];
    let t = (dot([p[0] - a[0], p[1] - a[1]], d) / dot(d, d).max(1e-12)).clamp(0.0, 1.0);
    size([p[0] - a[0] - t * d[0], p[1] - a[1] - t * d[1]])
}

/// Where a fixed body is drawn.
fn wall_point(stage: &Stage, body: usize) -> Option<Pair> {
    stage
        .scene
        .contacts
        .iter()
        .find(|c| c.bodies.contains(&body))
        .and_then(|c| stage.spot(&c.at))
}

/// Dots and names at centers of mass.
fn centers(stage: &Stage, sheet: &mut Sheet, bodies: &[usize]) {
    for i in bodies {
        let Some(label) = center_name(stage, *i) else {
            continue;
        };
        let at = stage.px(stage.poses[*i].center);
        sheet.dot(at, 2.4, Ink::Body);
        sheet.wish(Wish {
            label,
            size: SIZE,
            spot: Spot::Point {
                at,
                toward: [0.0, 0.0],
                reach: 3.0,
            },
        });
    }
}

/// Names of points, contacts and hinges, each place once.
fn names(stage: &Stage, sheet: &mut Sheet, bodies: &[usize], free: bool) {
    let scene = stage.scene;
    let touches = |pair: &[usize; 2]| pair.iter().any(|b| bodies.contains(b));
    let joints = scene
        .contacts
        .iter()
        .filter(|c| touches(&c.bodies))
        .map(|c| (&c.name, &c.at))
        .chain(
            scene
                .hinges
                .iter()
                .filter(|h| touches(&h.bodies))
                .map(|h| (&h.name, &h.at)),
        );
    let blown: Vec<&Vector> = scene
        .blows
        .iter()
        .filter(|b| bodies.contains(&b.body))
        .map(|b| &b.at)
        .collect();
    let points = scene
        .points
        .iter()
        .filter(|p| free || blown.contains(&&p.at))
        .map(|p| (&p.name, &p.at));
    let mut done: Vec<Pair> = bodies
        .iter()
        .filter(|i| center_name(stage, **i).is_some())
        .map(|i| stage.px(stage.poses[*i].center))
        .collect();
    for (name, at) in points.chain(joints) {
        let Some(at) = stage.spot(at) else { continue };
        if done
            .iter()
            .any(|p| size([p[0] - at[0], p[1] - at[1]]) < 2.0)
        {
            continue;
        }
        done.push(at);
        let hinge = scene.hinges.iter().any(|h| stage.spot(&h.at) == Some(at));
        if !hinge {
            sheet.dot(at, 1.9, Ink::Body);
        }
        let label = Label::symbol(name, None);
        sheet.wish(Wish {
            label,
            size: SIZE,
            spot: Spot::Point {
                at,
                toward: [0.0, 0.0],
                reach: if hinge { 5.0 } else { 3.0 },
            },
        });
    }
}

/// Each body's mass, or its name where masses do not tell bodies apart.
fn masses(stage: &Stage, sheet: &mut Sheet, asides: &[Pair]) {
    let scene = stage.scene;
    let movable = stage.movable();
    let same = |body: &Body| {
        movable
            .iter()
            .filter(|i| scene.bodies[**i].mass == body.mass)
            .count()
            > 1
    };
    for i in &movable {
        let body = &scene.bodies[*i];
        if let (crate::scene::Shape::Composite { parts }, Look::Parts(poses)) =
            (&body.shape, &stage.poses[*i].look)
        {
            for (part, pose) in parts.iter().zip(poses) {
                mass(
                    stage,
                    sheet,
                    part,
                    pose,
                    [0.0, 0.0],
                    Label::formula(&part.mass, scene),
                );
            }
            continue;
        }
        let label = if same(body) || body.mass.size() > 4 || body.mass.is_zero() {
            Label::words(&body.name.replace('_', " "))
        } else {
            Label::formula(&body.mass, scene)
        };
        mass(stage, sheet, body, &stage.poses[*i], asides[*i], label);
    }
}

fn mass(
    stage: &Stage,
    sheet: &mut Sheet,
    _body: &Body,
    pose: &super::stage::Pose,
    aside: Pair,
    label: Label,
) {
    let at = stage.px(pose.center);
    let at = [at[0] + aside[0], at[1] + aside[1]];
    let spot = match &pose.look {
        Look::Bar(_) => match pose.ends() {
            Some([a, b]) => {
                let (a, b) = (stage.px(a), stage.px(b));
                // Beside the rod, away from its middle, where the velocity starts.
                Spot::Along {
                    from: [(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0],
                    to: b,
                }
            }
            None => return,
        },
        Look::Round { radius, .. } => Spot::Inside {
            at,
            radius: stage.long(*radius),
        },
        Look::Plate(w, h) => Spot::Inside {
            at,
            radius: stage.long(w.min(*h)),
        },
        Look::Blob(points) => {
            let least = points
                .iter()
                .map(|p| size(*p))
                .fold(f64::INFINITY, f64::min);
            Spot::Inside {
                at,
                radius: stage.long(least),
            }
        }
        _ => Spot::Point {
            at,
            toward: [0.0, 0.0],
            reach: DOT,
        },
    };
    sheet.wish(Wish {
        label,
        size: SIZE,
        spot,
    });
}

/// The axes, in the lower left corner.
fn axes(sheet: &mut Sheet) {
    let Some(room) = sheet.room() else { return };
    let blocked = |b: &super::place::Room| {
        sheet.items.iter().any(|item| match item {
            super::sheet::Item::Text { room, .. } => room.overlap(b) > 0.0,
            super::sheet::Item::Path { points, .. } => points.windows(2).any(|w| {
                (0..=10).any(|k| {
                    let t = f64::from(k) / 10.0;
                    let p = [
                        w[0][0] + (w[1][0] - w[0][0]) * t,
                        w[0][1] + (w[1][1] - w[0][1]) * t,
                    ];
                    super::place::Room::around(p, 0.5).overlap(b) > 0.0
                })
            }),
            _ => false,
        })
    };
    let cover = |p: Pair| super::place::Room {
        low: [p[0] - 6.0, p[1] - 4.0],
        high: [p[0] + 50.0, p[1] + 50.0],
    };
    // Lower left of the column where it is free, else further out.
    let left = f64::min(room.middle()[0] - 156.0, room.low[0] - 22.0);
    let places = [
        [left, room.low[1]],
        [left, room.high[1] - 40.0],
        [-left - 36.0 + 2.0 * room.middle()[0], room.low[1]],
    ];
    let at = places
        .into_iter()
        .find(|p| !blocked(&cover(*p)))
        .unwrap_or([room.low[0] - 56.0, room.low[1]]);
    let mut extra = Sheet::default();
    for (to, latex) in [([26.0, 0.0], "\\hat{i}"), ([0.0, 26.0], "\\hat{j}")] {
        let tip = [at[0] + to[0], at[1] + to[1]];
        extra.arrow(at, tip, Ink::Dimension, 1.1);
        let toward = [to[0], to[1]];
        extra.wish(Wish {
            label: Label::latex(latex),
            size: SMALL,
            spot: Spot::Point {
                at: tip,
                toward,
                reach: 1.0,
            },
        });
    }
    extra.settle();
    sheet.items.extend(extra.items);
}
