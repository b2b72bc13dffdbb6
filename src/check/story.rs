//! Replays the steps of a scene with stages: every impact by itself, with the motion that goes into it, and the whole in
//! doubles, stage by stage.
//!
//! In: the scene, and what the solution says goes into each impact. The motion is followed from the beginning on its own:
//! impacts by the numeric solver, motions by their energy in doubles. Where the solution hands on something else than what
//! is found here, that is a failure like any other.

use std::collections::BTreeMap;

use serde_json::Value;

use super::{Claim, Failure, Meaning, POINTS, Report, Unusable, meanings, unusable};
use crate::dimension::Dimension;
use crate::expr::{Expr, Point, Symbol};
use crate::formula::{self, Symbols};
use crate::numeric::{self, Answer};
use crate::scene::{
    Ask, Contact, ContactLaw, EnergyWhen, FallEnd, ImpulseAt, Parameter, Scene, Stage, StageKind,
    Story, Turn, Until,
};

/// Points looked at before a motion that does not get to its end is given up.
const TRIES: u64 = 60;
/// Relative difference between what is handed on and what is found.
const CLOSE: f64 = 1e-9;

/// An impact as the solution tells it.
pub(super) struct Impact {
    /// Name that steps refer to.
    pub name: String,
    /// Index of its stage.
    stage: usize,
    /// Its scene, with the motion that goes in.
    pub scene: Scene,
    /// What its symbols stand for.
    pub meanings: BTreeMap<Symbol, Meaning>,
    /// Symbols for what is handed on, with their values in parameters.
    handed: BTreeMap<Symbol, Expr>,
}

/// Reads the impacts of a solution.
pub(super) fn impacts(scene: &Scene, value: &Value) -> Result<Vec<Impact>, Unusable> {
    let Some(story) = &scene.story else {
        return Ok(Vec::new());
    };
    let all = value.as_array().into_iter().flatten();
    all.map(|v| impact(scene, story, v)).collect()
}

fn impact(scene: &Scene, story: &Story, value: &Value) -> Result<Impact, Unusable> {
    let name = value["name"].as_str().unwrap_or_default().to_string();
    let wrong = |what: &str| Unusable(format!("impact `{name}`: {what}"));
    let stage = value["stage"].as_str();
    let stage = story
        .stages
        .iter()
        .position(|s| Some(s.name.as_str()) == stage);
    let stage = stage.ok_or_else(|| wrong("the scene has no such stage"))?;
    let StageKind::Impact { one_sided, .. } = &story.stages[stage].kind else {
        return Err(wrong("that stage is a motion"));
    };
    let read = |text: &Value, symbols: &Symbols| {
        let text = text.as_str().unwrap_or_default();
        formula::read_expr(text, symbols)
            .map_err(|fault| wrong(&format!("`{text}` cannot be read: {}", fault.message)))
    };
    let mut symbols = Symbols::strict();
    for parameter in &scene.parameters {
        symbols.declare(&parameter.name);
    }
    let mut out = story.stages[stage].scene.clone();
    out.domains = scene.domains.clone();
    let mut handed = BTreeMap::new();
    for (symbol, v) in value["handed"].as_object().into_iter().flatten() {
        if scene.parameters.iter().any(|p| *p.name == **symbol) {
            return unusable(format!("impact `{name}`: {symbol} is a parameter"));
        }
        handed.insert(Symbol::from(symbol.as_str()), read(v, &symbols)?);
    }
    for symbol in handed.keys() {
        symbols.declare(symbol);
        out.parameters.push(Parameter {
            name: symbol.clone(),
            latex: None,
            unit: String::new(),
            dimension: Dimension::none(),
            value: None,
            meaning: String::new(),
        });
    }
    for body in out.bodies.iter_mut().filter(|b| !b.is_fixed()) {
        let before = &value["before"][body.name.as_str()];
        body.velocity = [
            read(&before["velocity"][0], &symbols)?,
            read(&before["velocity"][1], &symbols)?,
        ];
        body.spin = read(&before["spin"], &symbols)?;
    }
    for active in value["active"].as_array().into_iter().flatten() {
        let found = one_sided
            .iter()
            .find(|o| Some(o.name.as_str()) == active.as_str());
        let found = found.ok_or_else(|| wrong("no such support or string"))?;
        out.contacts.push(Contact {
            name: found.name.clone(),
            bodies: found.bodies,
            at: found.at.clone(),
            normal: Some(found.normal.clone()),
            law: ContactLaw::Frictionless {
                restitution: Expr::zero(),
            },
        });
    }
    let meanings = meanings(&out, &value["symbols"])?;
    Ok(Impact {
        name,
        stage,
        scene: out,
        meanings,
        handed,
    })
}

/// Replays what belongs to no single impact, and holds what is handed on against the motion followed from the beginning.
pub(super) fn replay(
    scene: &Scene,
    story: &Story,
    impacts: &[Impact],
    meanings: &BTreeMap<Symbol, Meaning>,
    claims: &[&Claim],
    report: &mut Report,
) {
    let mut needed = numeric::needed(scene);
    for stage in &story.stages {
        let of = numeric::needed(&stage.scene);
        needed.plain.extend(of.plain);
        for (name, divisor) in of.angles {
            let here = needed.angles.entry(name).or_insert(1);
            *here = num_integer::lcm(*here, divisor);
        }
        formulas(stage).into_iter().for_each(|e| needed.add(e));
    }
    for parameter in &scene.parameters {
        let is_angle = needed.angles.contains_key(&parameter.name);
        if !is_angle {
            needed.add(&Expr::symbol(&parameter.name));
        }
    }
    let needed = super::needed(needed, meanings, claims);
    let mut points = Vec::new();
    let mut apart: Vec<Option<String>> = vec![None; impacts.len()];
    for seed in 1..=TRIES {
        if points.len() as u64 == POINTS {
            break;
        }
        let point = numeric::random_point(&needed, &scene.domains, seed);
        let mut doubles = numeric::rounded(&point);
        let Some(states) = follow(story, impacts, &doubles) else {
            continue;
        };
        for (impact, apart) in impacts.iter().zip(&mut apart) {
            let found = &states[impact.stage].before;
            if apart.is_none() {
                *apart = differs(impact, &doubles, found);
            }
        }
        for (name, meaning) in meanings {
            let Meaning::Staged(stage, question, axis) = meaning else {
                continue;
            };
            let value = states[*stage].answer(story, impacts, *stage, *question, *axis, &doubles);
            if let Some(value) = value {
                doubles.values.insert(name.clone(), value);
            }
        }
        points.push((point, doubles));
    }
    if points.is_empty() && !impacts.is_empty() {
        report
            .open
            .push(String::from("the motion from stage to stage"));
    }
    for (impact, apart) in impacts.iter().zip(apart) {
        match apart {
            Some(why) => report.failed.push(Failure {
                step: impact.name.clone(),
                claim: String::from("the motion that goes into the impact"),
                why,
            }),
            None => report.held += usize::from(!points.is_empty()),
        }
    }
    super::compare(points, meanings, claims, report);
}

/// The formulas of a stage beyond its bodies.
fn formulas(stage: &Stage) -> Vec<&Expr> {
    let mut out: Vec<&Expr> = Vec::new();
    for (_, v, w) in &stage.start {
        out.extend(v.iter().flatten());
        out.extend(w);
    }
    match &stage.kind {
        StageKind::Impact { one_sided, .. } => {
            out.extend(one_sided.iter().flat_map(|o| o.at.iter().chain(&o.normal)));
        }
        StageKind::Turn(t) => {
            out.extend(t.about.iter().chain(&t.gravity).chain(&t.torque));
            match &t.until {
                Until::By(e) | Until::For(e) => out.push(e),
                Until::Above | Until::Below => {}
            }
        }
        StageKind::Slide(s) => {
            out.extend(s.along.iter().chain([&s.distance]));
            out.extend(s.gravity.iter().chain(&s.force));
        }
        StageKind::Fall(f) => {
            let (FallEnd::Drop(e) | FallEnd::Range(e) | FallEnd::Time(e)) = &f.until;
            out.extend(f.gravity.iter().chain([e]));
        }
        StageKind::Wind(w) => out.extend(w.around.iter().chain([&w.to])),
    }
    out
}

/// How a body moves: velocity of its center of mass, spin.
type Moves = ([f64; 2], f64);

/// A stage in doubles.
struct Followed {
    before: Vec<Moves>,
    after: Vec<Moves>,
    /// The solved impact.
    solved: Option<(numeric::Given<f64>, numeric::Motion<f64>)>,
}

/// The motion from stage to stage; `None` where it does not get to the end.
fn follow(story: &Story, impacts: &[Impact], at: &Point<f64>) -> Option<Vec<Followed>> {
    let mut out: Vec<Followed> = Vec::new();
    for (i, stage) in story.stages.iter().enumerate() {
        let before = match stage.from {
            Some(j) => out[j].after.clone(),
            None => start(stage, at)?,
        };
        let mut after = before.clone();
        let mut solved = None;
        match &stage.kind {
            StageKind::Impact { .. } => {
                let impact = impacts.iter().find(|x| x.stage == i)?;
                let (given, motion) = solve(&impact.scene, &before, at)?;
                for (b, moves) in after.iter_mut().enumerate() {
                    *moves = (motion.velocity[b], motion.spin[b]);
                }
                solved = Some((given, motion));
            }
            StageKind::Turn(t) => turn(stage, t, &before, &mut after, at)?,
            StageKind::Slide(s) => {
                let body = &stage.scene.bodies[s.body];
                let mut work = 0.0;
                let way = s.distance.evaluate(at)?;
                let along = [s.along[0].evaluate(at)?, s.along[1].evaluate(at)?];
                let mass = body.mass.evaluate(at)?;
                if let Some(g) = &s.gravity {
                    work -= mass * g.evaluate(at)? * along[1] * way;
                }
                if let Some(force) = &s.force {
                    work += force.evaluate(at)? * way;
                }
                let v = before[s.body].0;
                let speed = root(v[0] * v[0] + v[1] * v[1] + 2.0 * work / mass)?;
                after[s.body].0 = along.map(|x| x * speed);
            }
            StageKind::Fall(f) => {
                let [vx, vy] = before[f.body].0;
                let g = f.gravity.as_ref().map_or(Some(0.0), |g| g.evaluate(at))?;
                let vy = match &f.until {
                    FallEnd::Drop(h) => -root(vy * vy + 2.0 * g * h.evaluate(at)?)?,
                    FallEnd::Time(t) => vy - g * t.evaluate(at)?,
                    FallEnd::Range(s) => vy - g * s.evaluate(at)? / vx,
                };
                after[f.body].0 = [vx, vy];
            }
            StageKind::Wind(w) => {
                let [vx, vy] = before[w.body].0;
                after[w.body].0 = [0.0, vx.hypot(vy)];
            }
        }
        out.push(Followed {
            before,
            after,
            solved,
        });
    }
    Some(out)
}

fn root(square: f64) -> Option<f64> {
    (square >= 0.0).then(|| square.sqrt())
}

fn start(stage: &Stage, at: &Point<f64>) -> Option<Vec<Moves>> {
    let mut out = Vec::new();
    for body in &stage.scene.bodies {
        let v = [
            body.velocity[0].evaluate(at)?,
            body.velocity[1].evaluate(at)?,
        ];
        out.push((v, body.spin.evaluate(at)?));
    }
    for (b, v, w) in &stage.start {
        if let Some([x, y]) = v {
            out[*b].0 = [x.evaluate(at)?, y.evaluate(at)?];
        }
        if let Some(w) = w {
            out[*b].1 = w.evaluate(at)?;
        }
    }
    Some(out)
}

/// A rotation in doubles: the bodies that turn as one keep energy and work in balance.
fn turn(
    stage: &Stage,
    turn: &Turn,
    before: &[Moves],
    after: &mut [Moves],
    at: &Point<f64>,
) -> Option<()> {
    let value = |e: &Expr| e.evaluate(at);
    let zero = |e: &Option<Expr>| e.as_ref().map_or(Some(0.0), value);
    let (g, torque) = (zero(&turn.gravity)?, zero(&turn.torque)?);
    let about = [value(&turn.about[0])?, value(&turn.about[1])?];
    let (mut mass, mut inertia, mut moment, mut arms) = (0.0, 0.0, [0.0, 0.0], Vec::new());
    for b in turn.bodies() {
        let body = &stage.scene.bodies[b];
        let x = value(&body.center[0])? - about[0];
        let y = value(&body.center[1])? - about[1];
        let m = value(&body.mass)?;
        mass += m;
        inertia += value(&body.inertia)? + m * (x * x + y * y);
        moment = [moment[0] + m * x, moment[1] + m * y];
        arms.push((b, [x, y]));
    }
    let [x, y] = [moment[0] / mass, moment[1] / mass];
    let ([vx, vy], spin) = before[turn.body];
    let (_, [ax, ay]) = arms[0];
    let spin = if stage.scene.bodies[turn.body].is_particle() {
        (ax * vy - ay * vx) / (ax * ax + ay * ay)
    } else {
        spin
    };
    let begins = match spin {
        w if w != 0.0 => w,
        _ if torque != 0.0 => torque,
        _ => -mass * g * x,
    };
    let way = match turn.clockwise {
        Some(true) => -1.0,
        Some(false) => 1.0,
        None => 1.0f64.copysign(begins),
    };
    let far = x.hypot(y);
    let ((s, c), by) = match &turn.until {
        Until::Above => ((x / far, y / far), 0.0),
        Until::Below => ((-x / far, -y / far), 0.0),
        Until::For(_) => ((0.0, 1.0), 0.0),
        // An angle under a sine may have a direction only, and no value of its own.
        Until::By(by) => (
            (way * value(&by.sin())?, value(&by.cos())?),
            if torque == 0.0 { 0.0 } else { value(by)? },
        ),
    };
    let drop = y - (x * s + y * c);
    let spin = way * root(spin * spin + 2.0 * (mass * g * drop + torque * by) / inertia)?;
    for (b, [x, y]) in arms {
        let end = [x * c - y * s, x * s + y * c];
        after[b] = ([-spin * end[1], spin * end[0]], spin);
    }
    Some(())
}

/// An impact with the motion that goes in given in doubles.
fn solve(
    scene: &Scene,
    before: &[Moves],
    at: &Point<f64>,
) -> Option<(numeric::Given<f64>, numeric::Motion<f64>)> {
    let mut scene = scene.clone();
    let mut at = at.clone();
    for (b, (v, w)) in before.iter().enumerate() {
        let mut stand_in = |what: &str, value: f64| {
            let name = Symbol::from(format!("\u{1}{what}{b}").as_str());
            at.values.insert(name.clone(), value);
            Expr::symbol(&name)
        };
        scene.bodies[b].velocity = [stand_in("x", v[0]), stand_in("y", v[1])];
        scene.bodies[b].spin = stand_in("w", *w);
    }
    let given = numeric::given(&scene, &at).ok()?;
    let system = numeric::assemble(&given);
    let solution = numeric::solve_f64(&system).ok()?;
    let motion = numeric::motion(&given, &system, &solution);
    Some((given, motion))
}

/// Where the solution lets another motion go into an impact than the one found.
fn differs(impact: &Impact, at: &Point<f64>, found: &[Moves]) -> Option<String> {
    for (body, (v, w)) in impact.scene.bodies.iter().zip(found) {
        let told = [&body.velocity[0], &body.velocity[1], &body.spin];
        let size = v[0].hypot(v[1]).max(w.abs());
        for (told, found) in told.into_iter().zip([v[0], v[1], *w]) {
            let Some(value) = told.substitute(&impact.handed).evaluate(at) else {
                continue;
            };
            if (value - found).abs() > CLOSE * size.max(1e-12) {
                return Some(format!(
                    "`{}` moves with {value} in the solution, with {found} when followed",
                    body.name
                ));
            }
        }
    }
    None
}

impl Followed {
    /// The answer to a question about the end of this stage.
    fn answer(
        &self,
        story: &Story,
        impacts: &[Impact],
        stage: usize,
        question: usize,
        axis: Option<usize>,
        at: &Point<f64>,
    ) -> Option<f64> {
        let scene = &story.stages[stage].scene;
        let ask = &scene.questions.get(question)?.ask;
        if let Some((given, motion)) = &self.solved {
            let ask = of_active(
                scene,
                &impacts.iter().find(|i| i.stage == stage)?.scene,
                ask,
                story,
                stage,
            );
            let Some(ask) = ask else { return Some(0.0) };
            return match (numeric::answer(&ask, at, given, motion).ok()?, axis) {
                (Answer::Scalar(value), _) => Some(value),
                (Answer::Vector(v), Some(axis)) => Some(v[axis]),
                _ => None,
            };
        }
        match ask {
            Ask::Spin { body, clockwise } => {
                let w = self.after[*body].1;
                Some(if *clockwise { -w } else { w })
            }
            Ask::Velocity { body, along, .. } => {
                let v = self.after[*body].0;
                match along {
                    Some([x, y]) => Some(v[0] * x.evaluate(at)? + v[1] * y.evaluate(at)?),
                    None => Some(v[axis?]),
                }
            }
            Ask::Energy { when, .. } => {
                let body = match &story.stages[stage].kind {
                    StageKind::Turn(t) => t.body,
                    StageKind::Slide(s) => s.body,
                    StageKind::Fall(f) => f.body,
                    StageKind::Wind(w) => w.body,
                    StageKind::Impact { .. } => return None,
                };
                let with = match &story.stages[stage].kind {
                    StageKind::Turn(t) => t.with.as_slice(),
                    _ => &[],
                };
                let of = |b: usize, (v, w): &Moves| {
                    let mass = scene.bodies[b].mass.evaluate(at)?;
                    let inertia = scene.bodies[b].inertia.evaluate(at)?;
                    Some((mass * (v[0] * v[0] + v[1] * v[1]) + inertia * w * w) / 2.0)
                };
                let energy = |all: &[Moves]| {
                    let each = std::iter::once(&body).chain(with);
                    each.map(|b| of(*b, &all[*b])).sum::<Option<f64>>()
                };
                let (before, after) = (energy(&self.before)?, energy(&self.after)?);
                Some(match when {
                    EnergyWhen::Before => before,
                    EnergyWhen::After => after,
                    EnergyWhen::Lost => before - after,
                })
            }
            _ => None,
        }
    }
}

/// A question of a stage, whose one-sided contacts count after the others, asked of the scene that has only those that act;
/// `None` for the impulse of one that does not.
fn of_active(stage: &Scene, scene: &Scene, ask: &Ask, story: &Story, i: usize) -> Option<Ask> {
    let (
        Ask::Impulse {
            from: ImpulseAt::Contact(c),
            on,
            along,
        },
        StageKind::Impact { one_sided, .. },
    ) = (ask, &story.stages[i].kind)
    else {
        return Some(ask.clone());
    };
    let Some(k) = c.checked_sub(stage.contacts.len()) else {
        return Some(ask.clone());
    };
    let name = &one_sided.get(k)?.name;
    let place = scene.contacts.iter().position(|c| c.name == *name)?;
    Some(Ask::Impulse {
        from: ImpulseAt::Contact(place),
        on: *on,
        along: along.clone(),
    })
}
