//! Tells a scene with stages: works out each stage from the end of the one before it, then answers the questions.
//!
//! In: a [`Scene`] with stages. Out: [`Told`], the stages with what each conserves and why, and the answers with how
//! each is known; or [`Refused`], the reason why the stages do not fit. Impacts are derived and proved by
//! [`crate::derive`] and [`crate::verify`]; motions follow from work and energy, and are integrated apart from that.

mod alone;
mod answer;
mod change;
mod granted;
mod grips;
mod impact;
mod integrate;
mod joined;
mod lent;
mod motion;
mod second;
mod sheet;
mod spring;
mod told;
mod words;
mod worlds;

use std::collections::BTreeMap;

pub(crate) use granted::NO_TIME;
pub use lent::{accelerations, lent};
pub(crate) use motion::by_coordinate;
pub use second::held;
pub use sheet::{
    Way, beginning, ends, impact, impacts, is_clockwise, moments, outcomes, sheet, ways,
};
pub(crate) use told::line;
pub(crate) use words::carried;

pub use told::{Balance, Case, Cluster, Kept, OnSpring, Part, StageTold, State, Step, Told};

use crate::algebra::Sign;
use crate::answer::calc::{at_least_zero, constant, is_zero, tidy};
use crate::answer::{Answer, Check, Refused, TOO_LONG};
use crate::derive::Stop;
use crate::domain::{Domain, Domains};
use crate::expr::{Expr, Point, Symbol, Vector, effort};
use crate::formula::{sentence, write_plain};
use crate::scene::{Ask, Scene, Stage, StageKind};

/// How the reason ends why a part of a motion is open that laws leave open.
const UNDETERMINED: &str = " do not determine it";

impl Refused {
    fn new(stage: &str, reason: impl Into<String>, hint: impl Into<String>) -> Refused {
        let at = match stage {
            "" => String::new(),
            name => format!("stage `{name}`"),
        };
        Refused::at(at, reason, hint)
    }

    fn stop(stage: &str, stop: impl Into<Stop>) -> Refused {
        let stop = stop.into();
        let hint = match stop {
            Stop::Limit(_) => TOO_LONG,
            _ => "",
        };
        Refused::new(stage, stop.to_string(), hint)
    }
}

/// Most ways through the cases of a scene.
const BRANCHES: usize = 32;

/// Tells a scene: its one impact, or its stages. Where an impact has several outcomes, what follows it is told for each.
pub fn tell(scene: &Scene) -> Result<Told, Refused> {
    effort::of_scene(|| told_and_answered(scene))
}

fn told_and_answered(scene: &Scene) -> Result<Told, Refused> {
    let mut told = match scene.has_stages() {
        true => {
            let course = course(scene)?;
            Told {
                ended: course.ended,
                ..answer::all(scene, course.stages)?
            }
        }
        false => alone::tell(scene)?,
    };
    for answer in &mut told.answers {
        let broken = answer.broken(scene);
        let told = |words| {
            sentence!(
                "no number at the given values, which do not keep to {}",
                words
            )
        };
        answer.text.extend(broken.map(told));
    }
    Ok(told)
}

/// The stages of a scene as [`tell`] has them, without what is asked and without a second look at them: what a picture needs.
pub fn course(scene: &Scene) -> Result<Told, Refused> {
    effort::of_scene(|| through(scene, None))
}

/// The same; what begins where the file begins begins with a state, where one is given.
fn through(scene: &Scene, from: Option<&State>) -> Result<Told, Refused> {
    let mut stages: Vec<StageTold> = Vec::new();
    let mut told_as: Vec<Vec<usize>> = Vec::new();
    let mut ended = Vec::new();
    for stage in &scene.stages {
        let mut mine = Vec::new();
        let mut refused = Vec::new();
        let ways = beginnings(stage, &stages, &told_as, from);
        let several = ways.len() > 1;
        for (branch, mut before, given) in ways {
            let mut earlier = BTreeMap::new();
            for name in &stage.earlier {
                match answer::earlier(scene, &stages, branch, name)? {
                    Ok(value) => _ = earlier.insert(name.clone(), value),
                    Err(why) => _ = before.open.insert(name.clone(), why),
                }
            }
            let lasts = takes_back(stage, &stages, branch, &mut before);
            let mut known = before.places(stage);
            known.extend(earlier.clone().into_iter().chain(lasts));
            let mut placed = stage.placed(&known);
            if !stage.earlier.is_empty() {
                let domains = placed.scene.domains.clone();
                placed
                    .kind
                    .formulas_mut(&mut |e| *e = tidy(e, &domains).unwrap_or_else(|_| e.clone()));
            }
            if stage.from.is_none() && from.is_none() && !stage.earlier.is_empty() {
                before = start(&placed.scene, &placed.start);
            }
            for open in before.open.keys() {
                placed
                    .scene
                    .domains
                    .symbols
                    .insert(open.clone(), Domain::real());
            }
            let domains = placed.scene.domains.clone();
            let is_zero = |e: &Expr| is_zero(e, &domains) == Some(true);
            let tidied = |e: Expr| tidy(&e, &domains).unwrap_or(e);
            placed.scene.carry_points(scene, is_zero, tidied);
            let domains = &mut placed.scene.domains;
            *domains = begun(stage, &stages, branch, &given, domains.clone());
            let begins = several.then(|| before.clone());
            let walls = motion::walls_are_there(&placed, &stages, branch, &before)?;
            let told = one(scene, &stages, &placed, branch, (before, &given))
                .map(|told| motion::stays_in_front(&placed, &stages, branch, told))
                .and_then(|told| motion::riders_stay(&placed, &stages, branch, told))
                .and_then(|told| impact::stays_held(&placed, &stages, branch, told))
                .map(|told| motion::meets_again(scene, &placed, &stages, branch, told))
                .map(|told| grips::pulls(&placed, &stages, branch, told));
            let mut told = match (told, begins) {
                (Ok(told), _) => told,
                (Err(why), _) if why.contradicts => {
                    ended.push(why);
                    continue;
                }
                // Of several ways one may lead nowhere, and the others on.
                (Err(why), Some(before)) if !placed.kind.moved().is_empty() => {
                    let told = motion::leads_nowhere(&placed, before, &why.reason);
                    refused.push(why);
                    told
                }
                (Err(why), _) => return Err(why),
            };
            told.checks.extend(at_values(scene, &told));
            let points = granted::points_carried(scene, &told);
            told.assumptions.extend(points.into_iter().chain(walls));
            told.earlier = earlier;
            told.branch = branch;
            told.given = given;
            if let Some((parent, case)) = branch
                && (stages[parent].cases.len() > 1 || told_as[stage.from.unwrap_or(0)].len() > 1)
            {
                told.name = format!("{} ({})", stage.name, words::leading(&stages, parent, case));
            }
            mine.push(stages.len());
            stages.push(told);
            if mine.len() > BRANCHES {
                let why = format!("more than {BRANCHES} cases lead here");
                let hint = "give values, or say with `supposing` which supports act";
                return Err(Refused::new(&stage.name, why, hint));
            }
        }
        if refused.len() == mine.len()
            && let Some(why) = refused.into_iter().next()
        {
            return Err(why);
        }
        told_as.push(mine);
    }
    Ok(Told {
        stages,
        readings: scene.readings.clone(),
        ended,
        ..Told::default()
    })
}

/// The domains on which a motion begins: the case that leads to it happens, and the motions before come to their ends. An impact
/// weighs its own conditions.
fn begun(
    stage: &Stage,
    stages: &[StageTold],
    branch: Option<(usize, usize)>,
    given: &[(String, Expr)],
    domains: Domains,
) -> Domains {
    if matches!(stage.kind, StageKind::Impact { .. }) {
        return domains;
    }
    let happens = given.iter().map(|(_, need)| need);
    let before = branch.into_iter().flat_map(|at| line(stages, at));
    let ends = before.flat_map(|(i, _)| &stages[i].needs);
    happens
        .chain(ends)
        .fold(domains, |all, need| all.given(need, false))
}

/// A motion during another takes its bodies where the other one finds them when it begins; gives how long both last, where
/// that has a closed form.
fn takes_back(
    stage: &Stage,
    stages: &[StageTold],
    branch: Option<(usize, usize)>,
    before: &mut State,
) -> Option<(Symbol, Expr)> {
    let during = stage.during.as_ref()?;
    let mut line = branch.into_iter().flat_map(|at| line(stages, at));
    let first = line.find(|(i, _)| stages[*i].placed.name == during.name);
    let first = &stages[first?.0];
    before.take_back(&stage.kind.moved(), &first.before);
    Some((during.time.clone(), first.time.clone()?))
}

/// What a motion needs and the given values do not keep to.
fn at_values(scene: &Scene, told: &StageTold) -> Option<Check> {
    let given = scene.values();
    let fails = |e: &&Expr| constant(&e.substitute(&given)) == Some(Sign::Negative);
    let needed = told.needs.iter().find(fails);
    let needed = needed.map(|broken| at_least_zero(broken, &scene.domains));
    let besides = told.besides.iter().find(fails);
    let in_words = besides.and_then(|_| told.assumptions.iter().find(|words| words.is_partial()));
    let words = match needed.as_ref().or(in_words) {
        Some(need) => {
            let need = need.written(write_plain);
            format!("it goes on as told only where {need}, and that is not so at the given values")
        }
        None => {
            let time = told.time.as_ref()?.substitute(&given);
            let is_number = time.symbols().iter().all(|s| &**s == "pi");
            let value = time.evaluate(&Point::<f64>::default());
            if !is_number || value.is_some_and(f64::is_finite) {
                return None;
            }
            String::from("at the given values it never gets to its end")
        }
    };
    Some(Check::new(second::POSSIBLE, words, Some(false)))
}

type Beginning = (Option<(usize, usize)>, State, Vec<(String, Expr)>);

/// The states a stage begins with, one for each way that leads to it.
fn beginnings(
    stage: &Stage,
    stages: &[StageTold],
    told_as: &[Vec<usize>],
    begun: Option<&State>,
) -> Vec<Beginning> {
    let Some(from) = stage.from else {
        let state = begun.cloned();
        let state = state.unwrap_or_else(|| start(&stage.scene, &stage.start));
        return vec![(None, state, Vec::new())];
    };
    let mut out = Vec::new();
    for &parent in &told_as[from] {
        let told = &stages[parent];
        if told.cases.is_empty() {
            out.push((Some((parent, 0)), told.after.clone(), told.given.clone()));
        }
        for (k, case) in told.cases.iter().enumerate() {
            let mut given = told.given.clone();
            // The only one that is supposed, or that values leave, rests on something as well.
            if told.cases.len() > 1 || is_open(&told.placed) {
                given.extend(case.conditions.iter().cloned());
            }
            out.push((Some((parent, k)), case.after.clone(), given));
        }
    }
    out
}

/// Whether an impact may come out one way or another.
fn is_open(stage: &Stage) -> bool {
    let StageKind::Impact { one_sided, .. } = &stage.kind else {
        return false;
    };
    !one_sided.is_empty() || stage.scene.friction().is_some()
}

/// One stage, from a state and what must be ≥ 0 on the way there.
fn one(
    scene: &Scene,
    stages: &[StageTold],
    stage: &Stage,
    branch: Option<(usize, usize)>,
    (before, given): (State, &[(String, Expr)]),
) -> Result<StageTold, Refused> {
    if !stage.kind.moved().is_empty() {
        if let Some(open) = motion::open(stage, before.clone()) {
            return Ok(open);
        }
        if let Some(during) = &stage.during
            && stage.kind.mentions(&during.time)
        {
            let why = format!("how long `{}` takes has no closed form", during.name);
            return Ok(motion::leads_nowhere(stage, before, &why));
        }
        joined::all_move(scene, stage)?;
    }
    match &stage.kind {
        StageKind::Impact {
            one_sided,
            supposed,
        } => {
            joined::left_out(scene, stage)?;
            let named = named(scene, stages, stage);
            let acting = (one_sided.as_slice(), supposed.as_deref());
            impact::tell(&scene.stages, stage, before, acting, &named, given)
        }
        StageKind::Turn(turn) => {
            let string = grips::string(stage, stages, branch, turn);
            motion::turn(stage, before, turn, string.as_deref())
        }
        StageKind::Slide(slide) => {
            let mine = scene
                .questions
                .iter()
                .filter(|q| q.stage.is_some_and(|i| scene.stages[i].name == stage.name));
            let by_newton = |ask: &Ask| {
                matches!(
                    ask,
                    Ask::Acceleration { .. } | Ask::Tension { .. } | Ask::Reaction { .. }
                )
            };
            let is_driven = mine.into_iter().any(|q| by_newton(&q.ask));
            motion::slide(stage, before, slide, is_driven)
        }
        StageKind::Fall(fall) => {
            let clusters = joined::turning(scene, stage, &before)?;
            motion::fall(stage, before, fall, &clusters)
        }
        StageKind::Wind(wind) => motion::wind(stage, before, wind),
        StageKind::Linkage(linkage) => motion::linkage(stage, before, linkage),
    }
}

/// Speeds and spins at the end of a stage that have the name of a question, for the impacts after it to go on with.
fn named(scene: &Scene, stages: &[StageTold], later: &Stage) -> Vec<(Symbol, Expr)> {
    let mut out = Vec::new();
    let earlier = std::iter::successors(later.from, |j| scene.stages[*j].from);
    let earlier: Vec<usize> = earlier.collect();
    for question in &scene.questions {
        let Some(stage) = question.stage.filter(|stage| earlier.contains(stage)) else {
            continue;
        };
        let name = &scene.stages[stage].name;
        let mut all = stages.iter().filter(|s| s.placed.name == *name);
        let Some(told) = all.next().filter(|s| s.cases.len() <= 1) else {
            continue;
        };
        // Of an impact that was reached on several ways the name stands for several values.
        if !told.cases.is_empty() && all.next().is_some() {
            continue;
        }
        let value = match told.placed.asked(question) {
            Ask::Spin { body, clockwise } => {
                let w = &told.after.spin[*body];
                if *clockwise { -w } else { w.clone() }
            }
            Ask::Velocity {
                body,
                point: None,
                along: Some(along),
            } => crate::expr::dot(&told.after.velocity[*body], along),
            _ => continue,
        };
        out.push((Symbol::from(question.name.as_str()), value));
    }
    out
}

/// The motion as the file gives it.
fn start(scene: &Scene, changes: &[(usize, Option<Vector>, Option<Expr>)]) -> State {
    let mut state = State {
        open: BTreeMap::new(),
        part: vec![Part::Waits; scene.bodies.len()],
        angle: scene.bodies.iter().map(|b| b.angle.clone()).collect(),
        center: scene.bodies.iter().map(|b| b.center.clone()).collect(),
        velocity: scene.bodies.iter().map(|b| b.velocity.clone()).collect(),
        spin: scene.bodies.iter().map(|b| b.spin.clone()).collect(),
    };
    for (body, velocity, spin) in changes {
        if let Some(v) = velocity {
            state.velocity[*body] = v.clone();
        }
        if let Some(w) = spin {
            state.spin[*body] = w.clone();
        }
    }
    state
}
