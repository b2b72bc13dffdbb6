//! What is asked of a motion: its end, how long and how far it went, places, angular momenta, the force of a fixed point.

use crate::answer::calc::{Seen, is_zero, sign, tidy};
use crate::answer::{Answer, Check, Form, Refused};
use crate::dimension::Dimension;
use crate::domain::Domains;
use crate::expr::{Expr, Vector, cross, dot, minus};
use crate::formula::Sentence;
use crate::scene::{Ask, EnergyWhen, Question, Scene, SlideEnd, Stage, StageKind, Turn};
use crate::story::motion as stage;
use crate::story::{StageTold, State};

/// The force of the fixed point on a turning body, as asked.
pub(super) fn reaction(
    question: &Question,
    told: &StageTold,
    along: &Vector,
    at_end: bool,
) -> Result<Answer, Refused> {
    let when = if at_end { "end" } else { "beginning" };
    let words = format!("force of the fixed point at the {when} of `{}`", told.name);
    let mut out = Answer::blank(question, &question.name, words);
    out.dimension = Dimension::new(1, 1, -2);
    let StageKind::Turn(turn) = &told.placed.kind else {
        return Ok(out);
    };
    let state = if at_end { &told.after } else { &told.before };
    if let Some(why) = state.why_open(state.spin.iter().take(turn.body + 1).skip(turn.body)) {
        return Ok(out.leave_open(why));
    }
    let (way, _) = stage::sense(&told.placed, &told.before.spin[turn.body], turn)?;
    let value = bearing(&told.placed, told, turn, way, along, at_end)
        .map_err(|stop| Refused::uncalculated(&question.name, stop))?;
    if at_end {
        out.assumptions = told.assumptions.clone();
    }
    out.form = Form::value(value);
    Ok(out)
}

/// How the spin of a body grows in a rotation or a linkage.
pub(super) fn angular_acceleration(
    question: &Question,
    told: &StageTold,
    at_end: bool,
) -> Result<Answer, Refused> {
    let when = if at_end { "end" } else { "beginning" };
    let words = format!("angular acceleration at the {when} of `{}`", told.name);
    let mut out = Answer::blank(question, &question.name, words);
    out.dimension = question.ask.dimension();
    let Ask::AngularAcceleration {
        body, clockwise, ..
    } = question.ask
    else {
        return Ok(out);
    };
    let state = if at_end { &told.after } else { &told.before };
    if let Some(why) = state.why_open([&state.spin[body]]) {
        return Ok(out.leave_open(why));
    }
    let value = match (&told.placed.kind, &told.energy) {
        (StageKind::Turn(turn), _) => {
            let (way, _) = stage::sense(&told.placed, &told.before.spin[turn.body], turn)?;
            angular(&told.placed, told, turn, way, at_end)
        }
        (StageKind::Linkage(linkage), Some(energy)) => {
            let end = usize::from(at_end);
            let there = (&energy[end], &linkage.ends[end]);
            stage::angular_acceleration(&told.placed, linkage, body, there)?
        }
        _ => return Ok(out),
    };
    let value = if clockwise { -value } else { value };
    let value = tidy(&value, &told.placed.scene.domains)
        .map_err(|stop| Refused::uncalculated(&question.name, stop))?;
    valued(
        &mut out,
        &value,
        if at_end { &told.assumptions } else { &[] },
    );
    Ok(out)
}

/// Gives an answer its value, and what that takes for granted.
fn valued(answer: &mut Answer, value: &Expr, assumptions: &[Sentence]) {
    answer.form = Form::value(value.clone());
    answer.assumptions = assumptions.to_vec();
}

/// An answer that is a quantity of the whole motion, or why it has none.
fn measured(
    question: &Question,
    told: &StageTold,
    words: String,
    dimension: Dimension,
    (value, why): (&Option<Expr>, &str),
) -> Answer {
    let mut out = Answer::blank(question, &question.name, words);
    out.dimension = dimension;
    match value {
        Some(value) => valued(&mut out, value, &told.assumptions),
        None => {
            let [places, motions] = [&told.before.center, &told.before.velocity];
            let moved = told.placed.kind.moved().into_iter();
            let parts = moved.flat_map(|b| places[b].iter().chain(&motions[b]));
            let before = told.before.why_open(parts);
            out = out.leave_open(before.unwrap_or_else(|| String::from(why)));
        }
    }
    out
}

/// How long a motion lasts.
pub(super) fn time(question: &Question, told: &StageTold) -> Answer {
    let words = format!("time that `{}` takes", told.name);
    let value = (&told.time, "it has no closed form");
    measured(question, told, words, Dimension::new(0, 0, 1), value)
}

/// How a body on a line gets faster.
pub(super) fn acceleration(question: &Question, told: &StageTold, body: usize) -> Answer {
    let words = format!("acceleration along its way in `{}`", told.name);
    let strings = match &told.placed.kind {
        StageKind::Slide(slide) => slide.strings.as_slice(),
        _ => &[],
    };
    let its_own = strings.iter().find(|s| s.hung().any(|b| b == body));
    let rate = told.acceleration.as_ref().map(|a| match its_own {
        Some(string) => &string.ratio() * a,
        None => a.clone(),
    });
    let value = (&rate, "what comes before is open");
    measured(question, told, words, Dimension::new(0, 1, -2), value)
}

/// How a string pulls a body.
pub(super) fn tension(question: &Question, told: &StageTold, body: usize) -> Answer {
    let name = &told.placed.scene.bodies[body].name;
    let words = format!("pull of the string at `{name}` in `{}`", told.name);
    let pull = told.tensions.iter().find(|(b, _)| *b == body);
    let why = match told.tensions.is_empty() {
        true => "what comes before is open",
        false => {
            "several strings pull it; ask it of the body at the other end of the one that is meant"
        }
    };
    let value = (&pull.map(|(_, pull)| pull.clone()), why);
    measured(question, told, words, Dimension::new(1, 1, -2), value)
}

/// How far a motion along a line leads.
pub(super) fn distance(question: &Question, told: &StageTold) -> Answer {
    let words = match turns_back(told) {
        true => format!(
            "displacement in `{}`, negative where it ends behind its beginning",
            told.name
        ),
        false => format!("distance covered in `{}`", told.name),
    };
    let value = (&told.way, "where it leads is open");
    measured(question, told, words, Dimension::new(0, 1, 0), value)
}

/// Whether friction may turn a body round before it rolls.
fn turns_back(told: &StageTold) -> bool {
    let StageKind::Slide(slide) = &told.placed.kind else {
        return false;
    };
    let forward = |state: &State| {
        let speed = dot(&state.velocity[slide.body], &slide.along);
        let seen = sign(&speed, &told.placed.scene.domains);
        seen.is_positive() || matches!(seen, Seen::Proved(s) if s.is_not_negative())
    };
    matches!(slide.until, SlideEnd::Rolls) && !(forward(&told.before) && forward(&told.after))
}

/// The angle through which a body turns.
pub(super) fn angle(
    question: &Question,
    told: &StageTold,
    body: usize,
    clockwise: bool,
) -> Result<Answer, Refused> {
    let scene = &told.placed.scene;
    let sense = if clockwise {
        "clockwise"
    } else {
        "counterclockwise"
    };
    let words = format!(
        "angle through which `{}` turns in `{}`, {sense} positive",
        scene.bodies[body].name, told.name
    );
    let mut out = Answer::blank(question, &question.name, words);
    let ends = [&told.before.angle[body], &told.after.angle[body]];
    if let Some(why) = told.after.why_open(ends) {
        return Ok(out.leave_open(why));
    }
    let by = match &told.placed.kind {
        StageKind::Turn(turn) if turn.bodies().contains(&body) => match &told.turned {
            Some(by) => by.clone(),
            None => {
                let begins = told.before.why_open(&told.before.center[body]);
                let why = begins.unwrap_or_else(|| {
                    "the sign of the angle between its ends is not decided".into()
                });
                return Ok(out.leave_open(why));
            }
        },
        _ => tidy(&(ends[1] - ends[0]), &scene.domains)
            .map_err(|stop| Refused::uncalculated(&question.name, stop))?,
    };
    let value = if clockwise { -by } else { by };
    valued(&mut out, &value, &told.assumptions);
    Ok(out)
}

/// Where the center of mass of a body is at the beginning or end of a stage, along a direction.
pub(super) fn position(
    question: &Question,
    suffix: &str,
    told: &StageTold,
    body: usize,
    along: &Vector,
    at_end: bool,
) -> Result<Answer, Refused> {
    let scene = &told.placed.scene;
    let (state, when) = match at_end {
        true => (&told.after, "end"),
        false => (&told.before, "beginning"),
    };
    let words = format!(
        "position of the center of mass of `{}` at the {when} of `{}`",
        scene.bodies[body].name, told.name
    );
    let mut out = Answer::blank(question, &format!("{}{suffix}", question.name), words);
    out.dimension = Dimension::new(0, 1, 0);
    if let Some(why) = state.why_open(&state.center[body]) {
        return Ok(out.leave_open(why));
    }
    let value = tidy(&dot(&state.center[body], along), &scene.domains)
        .map_err(|stop| Refused::uncalculated(&question.name, stop))?;
    // An impact moves nothing, whatever its outcome.
    let rests_on_way = at_end && told.cases.is_empty();
    let assumptions = if rests_on_way {
        &told.assumptions
    } else {
        &Vec::new()
    };
    valued(&mut out, &value, assumptions);
    Ok(out)
}

/// The angular momentum of a body about a point, in the motion at the beginning or end of a stage.
pub(super) fn angular_momentum(
    scene: &Scene,
    question: &Question,
    (told, state): (&StageTold, &State),
    (body, about): (usize, &Vector),
    at_end: bool,
) -> Result<Answer, Refused> {
    let b = &scene.bodies[body];
    let arm = minus(&state.center[body], about);
    let h = &(&b.mass * &cross(&arm, &state.velocity[body])) + &(&b.inertia * &state.spin[body]);
    let when = if at_end { "end" } else { "beginning" };
    let words = format!(
        "angular momentum of `{}` at the {when} of `{}`",
        b.name, told.name
    );
    let mut out = Answer::blank(question, &question.name, words);
    out.dimension = Dimension::new(1, 2, -1);
    if let Some(why) = state.why_open([&h]) {
        return Ok(out.leave_open(why));
    }
    let value =
        tidy(&h, &scene.domains).map_err(|stop| Refused::uncalculated(&question.name, stop))?;
    out.checks.push(Check::new(
        "identity",
        format!(
            "r × m v + I ω of the motion told in `{}`: the difference is zero in the normal form",
            told.name
        ),
        is_zero(&(&h - &value), &scene.domains),
    ));
    valued(
        &mut out,
        &value,
        if at_end { &told.assumptions } else { &[] },
    );
    Ok(out)
}

/// Quantities at the end of a motion.
pub(super) fn at_end(
    scene: &Scene,
    question: &Question,
    told: &StageTold,
) -> Result<Vec<Answer>, Refused> {
    let domains = &scene.domains;
    let refuse = |reason: &str| Refused::question(&question.name, reason, "");
    let ask = told.placed.asked(question);
    let what = match ask {
        Ask::Spin { .. } => String::from("angular velocity"),
        Ask::Velocity { point: None, .. } => String::from("velocity of the center of mass"),
        Ask::Velocity {
            body,
            point: Some((point, _)),
            ..
        } => format!(
            "velocity of the point {point} of `{}`",
            scene.bodies[*body].name
        ),
        Ask::Energy {
            when: EnergyWhen::Lost,
            ..
        } => String::from("kinetic energy lost"),
        _ => String::from("kinetic energy"),
    };
    let when = match &question.ask {
        Ask::Energy { when, .. } => match when {
            EnergyWhen::Before => "at the beginning",
            EnergyWhen::After => "at the end",
            EnergyWhen::Lost => "from the beginning to the end",
        },
        _ => "at the end",
    };
    let words = format!("{what}, {when} of `{}`", told.name);
    let mut parts: Vec<(String, Expr)> = Vec::new();
    match ask {
        Ask::Spin { body, clockwise } => {
            let w = &told.after.spin[*body];
            parts.push((String::new(), if *clockwise { -w } else { w.clone() }));
        }
        Ask::Velocity { body, point, along } => {
            let v = match point {
                Some((name, _)) => of_point(scene, &told.after, *body, name),
                None => told.after.velocity[*body].clone(),
            };
            match along {
                Some(along) => parts.push((String::new(), dot(&v, along))),
                None => parts.extend([
                    ("_x".to_string(), v[0].clone()),
                    ("_y".to_string(), v[1].clone()),
                ]),
            }
        }
        Ask::Energy { when, of } => {
            let whole = told.energy.as_ref().filter(|_| is_alone(told, *of));
            let [before, after] = match whole {
                Some(energy) => energy.clone(),
                None => [&told.before, &told.after].map(|state| kinetic(scene, state, *of)),
            };
            parts.push((
                String::new(),
                match when {
                    EnergyWhen::Before => before,
                    EnergyWhen::After => after,
                    EnergyWhen::Lost => before - after,
                },
            ));
        }
        _ => return Err(refuse("a motion transmits no impulse; ask it of an impact")),
    }
    let dimension = ask.dimension();
    let mut out = Vec::new();
    for (suffix, value) in parts {
        let mut a = Answer::blank(
            question,
            &format!("{}{suffix}", question.name),
            words.clone(),
        );
        let tidied = tidy(&value, domains).map_err(|stop| refuse(&stop.to_string()))?;
        let is_energy = matches!(ask, Ask::Energy { .. });
        let value = match is_energy && value.size() < tidied.size() {
            true => value,
            false => tidied,
        };
        a.checks.extend(told.checks.iter().cloned());
        a.checks.extend(energy_check(told, domains));
        a.form = Form::value(value);
        a.dimension = dimension.clone();
        if !is_energy {
            a.assumptions = told.assumptions.clone();
        }
        out.push(a);
    }
    Ok(out)
}

/// The velocity of a point that a body carries along.
fn of_point(scene: &Scene, state: &State, body: usize, name: &str) -> Vector {
    let [x, y] = &state.velocity[body];
    let [p, q] = state.carried(scene, body, name);
    let spin = &state.spin[body];
    [x - &(spin * &q), y + &(spin * &p)]
}

/// Whether the motion of a stage is all that moves of what is asked about.
fn is_alone(told: &StageTold, of: Option<usize>) -> bool {
    let moved = told.placed.kind.moved();
    let scene = &told.placed.scene;
    let rests = |b: usize| {
        let mut parts = told.before.velocity[b].iter().chain([&told.before.spin[b]]);
        parts.all(|c| is_zero(c, &scene.domains) == Some(true))
    };
    match of {
        Some(body) => moved == [body],
        None => (0..scene.bodies.len()).all(|b| moved.contains(&b) || rests(b)),
    }
}

/// Kinetic energy of a body, or of all.
fn kinetic(scene: &Scene, state: &State, of: Option<usize>) -> Expr {
    let half = Expr::ratio(1, 2);
    let moving = scene
        .bodies
        .iter()
        .enumerate()
        .filter(|(_, b)| !b.is_fixed());
    let parts = moving
        .filter(|(b, _)| of.is_none_or(|of| of == *b))
        .map(|(b, body)| {
            let v = &state.velocity[b];
            let moves = &body.mass * &dot(v, v);
            // A particle that goes round a point has an angular velocity, but no energy beyond that of its velocity.
            let turns = &body.inertia * &state.spin[b].powi(2);
            &half * &(&moves + &turns)
        });
    Expr::sum(parts)
}

/// The kinetic energy of the end, put together again from the motion at the end, where that came from a root.
fn energy_check(told: &StageTold, domains: &Domains) -> Option<Check> {
    let [_, end] = told.energy.as_ref()?;
    let again = told.kinetic.as_ref()?;
    Some(Check::new(
        "identity",
        "velocity and spin at the end give the energy at the beginning and the work",
        is_zero(&(again - end), domains),
    ))
}

/// Force of the fixed point on a turning body along a direction: m a_G less the weight.
fn bearing(
    stage: &Stage,
    told: &StageTold,
    turn: &Turn,
    way: i64,
    along: &Vector,
    at_end: bool,
) -> Result<Expr, crate::algebra::Stop> {
    let body = turn.lump(&stage.scene);
    let inertia = stage::inertia_about(stage, turn);
    let [r0, r1] = stage::arms(stage, turn, &told.before.spin[turn.body]);
    let r = if at_end { &r1 } else { &r0 };
    let square = match &told.energy {
        Some([start, end]) => &(&Expr::from(2) * if at_end { end } else { start }) / &inertia,
        None => Expr::zero(),
    };
    let weight = &body.mass * &turn.gravity.clone().unwrap_or_else(Expr::zero);
    let angular = angular(stage, told, turn, way, at_end);
    let a = [
        -(&(&angular * &r[1])) - &square * &r[0],
        &angular * &r[0] - &square * &r[1],
    ];
    let force = [&body.mass * &a[0], &body.mass * &a[1] + &weight];
    tidy(&dot(&force, along), &stage.scene.domains)
}

/// Angular acceleration of a turning body, counterclockwise: the moments about the fixed point over the moment of inertia.
fn angular(stage: &Stage, told: &StageTold, turn: &Turn, way: i64, at_end: bool) -> Expr {
    let arms = stage::arms(stage, turn, &told.before.spin[turn.body]);
    let weight = match &turn.gravity {
        Some(g) => &turn.lump(&stage.scene).mass * g,
        None => Expr::zero(),
    };
    // The moment counts in the sense of the rotation.
    let applied = Expr::from(way) * turn.torque.clone().unwrap_or_else(Expr::zero);
    let moments = &applied - &(&weight * &arms[usize::from(at_end)][0]);
    &moments / &stage::inertia_about(stage, turn)
}
