//! What is asked of a motion: its end, how long and how far it went, places, angular momenta, the force of a fixed point.

use crate::answer::calc::{is_zero, sign, tidy};
use crate::answer::{self, Answer, Check, Form, Refused};
use crate::domain::Domains;
use crate::expr::{Expr, Vector, cross, dot, minus};
use crate::formula::Sentence;
use crate::scene::{Ask, EnergyWhen, Question, Scene, SlideEnd, StageKind};
use crate::story::motion as stage;
use crate::story::{StageTold, State};

/// One end of a stage: the motion there, what it is called, and what it takes for granted.
fn end(told: &StageTold, at_end: bool) -> (&State, &'static str, &[Sentence]) {
    match at_end {
        true => (&told.after, "end", &told.assumptions),
        false => (&told.before, "beginning", &[]),
    }
}

/// An answer of the dimension that its question asks for, without content yet.
fn blank(question: &Question, words: String) -> Answer {
    Answer {
        dimension: question.ask.dimension(),
        ..Answer::blank(question, &question.name, words)
    }
}

/// Gives an answer its value, and what that takes for granted.
fn valued(mut answer: Answer, value: Expr, assumptions: &[Sentence]) -> Answer {
    answer.form = Form::value(value);
    answer.assumptions = assumptions.to_vec();
    answer
}

/// A tidy value, or the limit that was met.
fn tidied(question: &Question, told: &StageTold, value: &Expr) -> Result<Expr, Refused> {
    tidy(value, &told.placed.scene.domains)
        .map_err(|stop| Refused::uncalculated(&question.name, stop))
}

/// The force of the fixed point on a turning body, or of the surface on what moves along it, as asked.
pub(super) fn reaction(
    question: &Question,
    told: &StageTold,
    along: &Vector,
    at_end: bool,
) -> Result<Answer, Refused> {
    let (state, when, granted) = end(told, at_end);
    let stage = &told.placed.name;
    let direction = answer::along(Some(along));
    let turn = match &told.placed.kind {
        StageKind::Turn(turn) => turn,
        StageKind::Slide(slide) => {
            let words = format!("force of the {} in `{stage}`{direction}", slide.support());
            let force = told.acceleration.as_ref().map(|rate| {
                let force = stage::support(&told.placed.scene, slide, rate);
                tidied(question, told, &dot(&force, along))
            });
            let why = "what comes before is open";
            return Ok(measured(question, told, words, force.transpose()?, why));
        }
        _ => return Ok(blank(question, String::new())),
    };
    let words = format!("force of the fixed point at the {when} of `{stage}`{direction}");
    let out = blank(question, words);
    if let Some(why) = state.why_open([&state.spin[turn.body]]) {
        return Ok(out.leave_open(why));
    }
    let (way, _) = stage::sense(&told.placed, &told.before.spin[turn.body], turn)?;
    let value = tidied(
        question,
        told,
        &stage::pivot_force(told, turn, way, along, at_end),
    )?;
    Ok(valued(out, value, granted))
}

/// The words behind a spin that is counted the other way.
fn sense(clockwise: bool) -> &'static str {
    if clockwise {
        ", clockwise positive"
    } else {
        ""
    }
}

/// How the spin of a body grows in a rotation or a linkage.
pub(super) fn angular_acceleration(
    question: &Question,
    told: &StageTold,
    at_end: bool,
) -> Result<Answer, Refused> {
    let (state, when, granted) = end(told, at_end);
    let words = format!(
        "angular acceleration at the {when} of `{}`{}",
        told.placed.name,
        sense(question.ask.is_clockwise())
    );
    let out = blank(question, words);
    let Ask::AngularAcceleration {
        body, clockwise, ..
    } = question.ask
    else {
        return Ok(out);
    };
    if let Some(why) = state.why_open([&state.spin[body]]) {
        return Ok(out.leave_open(why));
    }
    let value = match (&told.placed.kind, &told.energy) {
        (StageKind::Turn(turn), _) => {
            let (way, _) = stage::sense(&told.placed, &told.before.spin[turn.body], turn)?;
            stage::angular(told, turn, way, at_end)
        }
        (StageKind::Linkage(linkage), Some(energy)) => {
            let end = usize::from(at_end);
            let there = (&energy[end], &linkage.ends[end]);
            let [.., angular] = stage::accelerations(&told.placed, linkage, body, there)?;
            angular
        }
        _ => return Ok(out),
    };
    let value = if clockwise { -value } else { value };
    Ok(valued(out, tidied(question, told, &value)?, granted))
}

/// The acceleration of a body, or of a point of it, in a rotation or a linkage.
pub(super) fn point_acceleration(
    scene: &Scene,
    question: &Question,
    told: &StageTold,
    at_end: bool,
) -> Result<Answer, Refused> {
    let Ask::PointAcceleration {
        body, point, along, ..
    } = &question.ask
    else {
        return Ok(blank(question, String::new()));
    };
    let (state, when, granted) = end(told, at_end);
    let name = &scene.bodies[*body].name;
    let what = match point {
        Some(point) => format!("the point {point} of `{name}`"),
        None => format!("the center of mass of `{name}`"),
    };
    let words = format!(
        "acceleration of {what} at the {when} of `{}`",
        told.placed.name
    );
    let out = blank(question, words);
    let parts = state.center[*body].iter().chain(&state.velocity[*body]);
    if let Some(why) = state.why_open(parts.chain([&state.spin[*body]])) {
        return Ok(out.leave_open(why));
    }
    let arm = point
        .as_ref()
        .map(|point| state.carried(scene, *body, point));
    let arm = arm.unwrap_or_else(|| [Expr::zero(), Expr::zero()]);
    let spin = &state.spin[*body];
    // Of a rigid body: that of its center, and the part that turning adds at the arm.
    let turning = |[x, y]: &Vector, square: &Expr, angular: &Expr| {
        [
            -(&(angular * y) + &(square * x)),
            &(angular * x) - &(square * y),
        ]
    };
    let value = match (&told.placed.kind, &told.energy) {
        (StageKind::Turn(turn), _) => {
            let (way, _) = stage::sense(&told.placed, &told.before.spin[turn.body], turn)?;
            let center = minus(&state.center[*body], &turn.about);
            // A particle has no spin of its own.
            let square = match told.placed.scene.bodies[*body].is_particle() {
                true => {
                    let v = &state.velocity[*body];
                    &dot(v, v) / &dot(&center, &center)
                }
                false => spin.powi(2),
            };
            let arm = [0, 1].map(|k| &center[k] + &arm[k]);
            turning(&arm, &square, &stage::angular(told, turn, way, at_end))
        }
        (StageKind::Linkage(linkage), Some(energy)) => {
            let end = usize::from(at_end);
            let there = (&energy[end], &linkage.ends[end]);
            let [x, y, angular] = stage::accelerations(&told.placed, linkage, *body, there)?;
            let [p, q] = turning(&arm, &spin.powi(2), &angular);
            [&x + &p, &y + &q]
        }
        _ => return Ok(out),
    };
    Ok(valued(
        out,
        tidied(question, told, &dot(&value, along))?,
        granted,
    ))
}

/// An answer that is a quantity of the whole motion, or why it has none.
fn measured(
    question: &Question,
    told: &StageTold,
    words: String,
    value: Option<Expr>,
    why: &str,
) -> Answer {
    let out = blank(question, words);
    if let Some(value) = value {
        return valued(out, value, &told.assumptions);
    }
    let moved = told.placed.kind.moved();
    let why_open = |state: &State| {
        let parts = moved
            .iter()
            .flat_map(|b| [&state.center[*b], &state.velocity[*b]]);
        state.why_open(parts.flatten())
    };
    let why_open = why_open(&told.before).or_else(|| why_open(&told.after));
    out.leave_open(why_open.unwrap_or_else(|| why.into()))
}

/// How long a motion lasts.
pub(super) fn time(question: &Question, told: &StageTold) -> Answer {
    let words = format!("time that `{}` takes", told.placed.name);
    let value = told.time.clone();
    measured(
        question,
        told,
        words,
        value,
        "no closed form was found for it",
    )
}

/// How a body on a line gets faster.
pub(super) fn acceleration(
    question: &Question,
    told: &StageTold,
    body: usize,
    at_end: bool,
) -> Answer {
    let name = &told.placed.name;
    if let Some(spring) = &told.on_spring {
        let (_, when, granted) = end(told, at_end);
        let words = format!("acceleration along its way at the {when} of `{name}`");
        let rate = spring.rates[usize::from(at_end)].clone();
        return valued(blank(question, words), rate, granted);
    }
    let mut words = format!("acceleration along its way in `{name}`");
    let (strings, below) = match &told.placed.kind {
        StageKind::Slide(slide) => (slide.strings.as_slice(), slide.on.as_ref()),
        _ => (Default::default(), None),
    };
    // What slides on a body that moves, and that one, may go against the direction in which one slides along the other.
    if let (Some(_), StageKind::Slide(slide)) = (below, &told.placed.kind) {
        let along = answer::along(Some(&slide.along));
        words = format!("acceleration in `{name}`{along}");
    }
    let its_own = strings.iter().find(|s| s.hung().any(|b| b == body));
    let is_below = below.is_some_and(|on| on.company().contains(&body));
    let rate = match is_below {
        true => (told.steps.iter().find(|s| s.letter == "A")).map(|s| s.value.clone()),
        false => told.acceleration.as_ref().map(|a| match its_own {
            Some(string) => &string.ratio() * a,
            None => a.clone(),
        }),
    };
    measured(question, told, words, rate, "what comes before is open")
}

/// How a string pulls a body.
pub(super) fn tension(question: &Question, told: &StageTold, body: usize) -> Answer {
    let name = &told.placed.scene.bodies[body].name;
    let words = format!("pull of the string at `{name}` in `{}`", told.placed.name);
    let pull = told.tensions.iter().find(|(b, _)| *b == body);
    let why = match told.tensions.is_empty() {
        true => "what comes before is open",
        false => {
            "several strings pull it; ask it of the body at the other end of the one that is meant"
        }
    };
    measured(question, told, words, pull.map(|p| p.1.clone()), why)
}

/// How far a motion along a line leads.
pub(super) fn distance(question: &Question, told: &StageTold) -> Answer {
    let stage = &told.placed.name;
    let words = match turns_back(told) {
        true if is_carried(told) => format!(
            "displacement along the body below in `{stage}`, in the sense in which it sets out"
        ),
        true => format!("displacement in `{stage}`, negative where it ends behind its beginning"),
        false if is_carried(told) => format!("distance along the body below in `{stage}`"),
        false => format!("distance covered in `{stage}`"),
    };
    let value = told.way.clone();
    let why = match told.clusters.is_empty() {
        true => "where it leads is open",
        false => {
            "bodies that are stuck together turn about their common center of mass and go along curves"
        }
    };
    measured(question, told, words, value, why)
}

/// Whether a body slides on another that moves too.
fn is_carried(told: &StageTold) -> bool {
    matches!(&told.placed.kind, StageKind::Slide(slide) if slide.on.is_some())
}

/// Whether friction may turn a body round before it rolls.
fn turns_back(told: &StageTold) -> bool {
    let StageKind::Slide(slide) = &told.placed.kind else {
        return false;
    };
    let goes = |way: i64, state: &State| {
        let mut speed = dot(&state.velocity[slide.body], &slide.along);
        if let Some(below) = &slide.on {
            speed = speed - dot(&state.velocity[below.body], &slide.along);
        }
        let seen = sign(&(Expr::from(way) * speed), &told.placed.scene.domains);
        seen.is_positive() || seen.is_not_negative()
    };
    let keeps_on = |way: i64| goes(way, &told.before) && goes(way, &told.after);
    matches!(slide.until, SlideEnd::Rolls) && !(keeps_on(1) || slide.on.is_some() && keeps_on(-1))
}

/// The angle through which a body turns.
pub(super) fn angle(
    question: &Question,
    told: &StageTold,
    body: usize,
    clockwise: bool,
) -> Result<Answer, Refused> {
    let name = &told.placed.scene.bodies[body].name;
    let sense = if clockwise { "" } else { "counter" };
    let words = format!(
        "angle through which `{name}` turns in `{}`, {sense}clockwise positive",
        told.placed.name
    );
    let out = blank(question, words);
    let ends = [&told.before.angle[body], &told.after.angle[body]];
    if let Some(why) = told.after.why_open(ends) {
        return Ok(out.leave_open(why));
    }
    let by = match (&told.placed.kind, &told.turned) {
        (StageKind::Turn(turn), Some(by)) if turn.bodies().contains(&body) => by.clone(),
        (StageKind::Turn(turn), None) if turn.bodies().contains(&body) => {
            let begins = told.before.why_open(&told.before.center[body]);
            let undecided = "the sign of the angle between its ends is not decided";
            return Ok(out.leave_open(begins.unwrap_or_else(|| undecided.into())));
        }
        _ => tidied(question, told, &(ends[1] - ends[0]))?,
    };
    let value = if clockwise { -by } else { by };
    Ok(valued(out, value, &told.assumptions))
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
    let (state, when, granted) = end(told, at_end);
    let name = &told.placed.scene.bodies[body].name;
    let stage = &told.placed.name;
    let direction = answer::along(Some(along));
    let words =
        format!("position of the center of mass of `{name}` at the {when} of `{stage}`{direction}");
    let mut out = Answer::blank(question, &format!("{}{suffix}", question.name), words);
    out.dimension = question.ask.dimension();
    let there = dot(&state.center[body], along);
    if let Some(why) = state.why_open([&there]) {
        return Ok(out.leave_open(why));
    }
    let value = tidied(question, told, &there)?;
    // An impact moves nothing, whatever its outcome.
    let moves = told.cases.is_empty();
    Ok(valued(out, value, if moves { granted } else { &[] }))
}

/// The angular momentum of a body about a point, in the motion at the beginning or end of a stage.
pub(super) fn angular_momentum(
    question: &Question,
    (told, state): (&StageTold, &State),
    (body, (about, center_of)): (usize, (&Vector, Option<usize>)),
    at_end: bool,
) -> Result<Answer, Refused> {
    let (_, when, granted) = end(told, at_end);
    let (b, stage) = (&told.placed.scene.bodies[body], &told.placed.name);
    let arm = minus(&state.center[body], about);
    let h = &(&b.mass * &cross(&arm, &state.velocity[body])) + &(&b.inertia * &state.spin[body]);
    let named = match center_of {
        Some(other) => Some(told.placed.scene.bodies[other].name.as_str()),
        None => told.placed.scene.named_at(about),
    };
    let place = match named {
        Some(name) if name == b.name => String::from("its center of mass"),
        Some(name) => format!("`{name}`"),
        None => String::from("the point given"),
    };
    let words = format!(
        "angular momentum of `{}` about {place} at the {when} of `{stage}`",
        b.name
    );
    let mut out = blank(question, words);
    if let Some(why) = state.why_open([&h]) {
        return Ok(out.leave_open(why));
    }
    let value = tidied(question, told, &h)?;
    let words = format!(
        "r × m v + I ω of the motion told in `{stage}`: the difference is identically zero"
    );
    let holds = is_zero(&(&h - &value), &told.placed.scene.domains);
    out.checks.push(Check::new("identity", words, holds));
    Ok(valued(out, value, granted))
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
    let of = |body: &usize| format!("of `{}`", scene.bodies[*body].name);
    let what = match ask {
        Ask::Spin { body, .. } => format!("angular velocity {}", of(body)),
        Ask::Velocity { point, body, .. } => {
            let point = point.as_ref();
            let of_point = point.map_or("the center of mass".into(), |(name, _)| {
                format!("the point {name}")
            });
            format!("velocity of {of_point} {}", of(body))
        }
        Ask::Energy {
            when: EnergyWhen::Lost,
            ..
        } => String::from("kinetic energy lost"),
        _ => String::from("kinetic energy"),
    };
    let when = match &question.ask {
        Ask::Energy { when, .. } if *when == EnergyWhen::Before => "at the beginning",
        Ask::Energy { when, .. } if *when == EnergyWhen::Lost => "from the beginning to the end",
        _ => "at the end",
    };
    let along = match ask {
        Ask::Velocity { along, .. } => answer::along(along.as_ref()),
        Ask::Spin { clockwise, .. } => sense(*clockwise).into(),
        _ => String::new(),
    };
    let words = format!("{what}, {when} of `{}`{along}", told.placed.name);
    let parts = match ask {
        Ask::Spin { body, clockwise } => {
            let w = &told.after.spin[*body];
            vec![("", if *clockwise { -w } else { w.clone() })]
        }
        Ask::Velocity { body, point, along } => {
            let v = match point {
                Some((name, _)) => of_point(scene, &told.after, *body, name),
                None => told.after.velocity[*body].clone(),
            };
            match along {
                Some(along) => vec![("", dot(&v, along))],
                None => ["_x", "_y"].into_iter().zip(v).collect(),
            }
        }
        Ask::Energy { when, of } => {
            let whole = told.energy.as_ref().filter(|_| is_alone(told, *of));
            let [before, after] = match whole {
                Some(energy) => energy.clone(),
                None => [&told.before, &told.after].map(|state| kinetic(scene, state, *of)),
            };
            let energy = match when {
                EnergyWhen::Before => before,
                EnergyWhen::After => after,
                EnergyWhen::Lost => before - after,
            };
            vec![("", energy)]
        }
        _ => return Err(refuse("a motion transmits no impulse; ask it of an impact")),
    };
    let dimension = ask.dimension();
    let mut out = Vec::new();
    for (suffix, value) in parts {
        let name = format!("{}{suffix}", question.name);
        let words = match suffix {
            "" => words.clone(),
            axis => format!("{words}, along {}", &axis[1..]),
        };
        let mut a = Answer::blank(question, &name, words);
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
        // Energy of the end is that of a motion that gets there, though its formula has values beyond.
        if when != "at the beginning" {
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
    let all = scene.bodies.iter().enumerate();
    let moving = all.filter(|(b, body)| !body.is_fixed() && of.is_none_or(|of| of == *b));
    Expr::sum(moving.map(|(b, body)| {
        let v = &state.velocity[b];
        let moves = &body.mass * &dot(v, v);
        // A particle that goes round a point has an angular velocity, but no energy beyond that of its velocity.
        let turns = &body.inertia * &state.spin[b].powi(2);
        &Expr::ratio(1, 2) * &(&moves + &turns)
    }))
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
