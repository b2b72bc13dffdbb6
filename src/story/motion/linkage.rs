//! Bodies with one freedom: T = ½ M(q) q̇², with the velocities of all bodies per unit of q̇ from their places.

use super::{arrival, balance, half, kept, meanwhile, pushed, tidied};
use crate::algebra::Sign;
use crate::answer::calc::{Seen, above_zero, at_least_zero, is_zero, sign};
use crate::answer::solve::solve;
use crate::domain::Domain;
use crate::expr::{Expr, Point, ratio};
use crate::formula::{Sentence, sentence, unicode_name, write_plain};
use crate::scene::{Linkage, Stage};
use crate::story::{Refused, StageTold, State, integrate};

/// Where the bodies are and how fast they move where the rate of the coordinate is 1.
struct Pose {
    /// x, y and angle of each body.
    places: Vec<[Expr; 3]>,
    rates: Vec<[Expr; 3]>,
    /// Σ m v² + I ω² at that rate.
    inertia: Expr,
}

/// Motion of a linkage from one value of its coordinate to another.
pub(in crate::story) fn linkage(
    stage: &Stage,
    before: State,
    linkage: &Linkage,
) -> Result<StageTold, Refused> {
    let domains = &stage.scene.domains;
    let [begin, end] = &linkage.ends;
    let [first, last] = [pose(stage, linkage, begin)?, pose(stage, linkage, end)?];
    stands(stage, &before, linkage, &first)?;
    if is_zero(&first.inertia, domains) == Some(true) {
        let why = format!(
            "nothing that has a mass moves with `{}` as it begins",
            linkage.coordinate
        );
        let hint = "give one of the bodies a mass, or begin a little later";
        return Err(Refused::new(&stage.name, why, hint));
    }
    let (mut needs, mut assumptions) = (Vec::new(), Vec::new());
    let way = way(stage, linkage, &mut needs, &mut assumptions)?;
    let rate = rate(stage, &before, linkage, &first)?;
    sets_out(stage, linkage, &rate, way, &mut needs, &mut assumptions)?;
    let start = tidied(stage, &half(&(&first.inertia * &rate.powi(2))))?;
    hurdles(stage, linkage, (way, &start), &mut needs, &mut assumptions)?;
    let work = work(stage, linkage, &first, &last);
    let lead = linkage.places[0].0;
    let (gained, energy, reaches) = balance(stage, lead, &start, &work)?;
    if is_zero(&last.inertia, domains) != Some(false) {
        let why = "at its end nothing moves with the coordinate, or that is not decided";
        let hint = "end it a little before, or choose another coordinate";
        return Err(Refused::new(&stage.name, why, hint));
    }
    if let Some(words) = arrival(stage, lead, &energy, (reaches, &needs)) {
        assumptions.push(words);
        needs.push(energy.clone());
    }
    let speed = match gained.is_zero() && first.inertia == last.inertia {
        true => rate.clone(),
        false => {
            let size = (&(&Expr::from(2) * &energy) / &last.inertia).sqrt();
            tidied(stage, &(&Expr::from(way) * &size))?
        }
    };
    let mut after = before.clone();
    for (i, (b, _)) in linkage.places.iter().enumerate() {
        let ([x, y, angle], rates) = (last.places[i].clone(), &last.rates[i]);
        let [u, v, w] = rates.each_ref().map(|r| tidied(stage, &(r * &speed)));
        after.center[*b] = [x, y];
        after.velocity[*b] = [u?, v?];
        if !stage.scene.bodies[*b].is_particle() {
            let turned = angle - &first.places[i][2];
            after.angle[*b] = tidied(stage, &(&after.angle[*b] + turned))?;
            after.spin[*b] = w?;
        }
    }
    let acceleration = steady(stage, linkage)?;
    let time = match &acceleration {
        Some(grows) => Some(time(stage, linkage, [&rate, &speed], grows)?),
        None => None,
    };
    assumptions.extend(meanwhile::others(stage, &before, &mut after, time.as_ref()));
    let mut out = StageTold::new(stage, before, after);
    out.time = time;
    out.acceleration = acceleration;
    let why = match linkage.gravity {
        Some(_) => "joints and guides do no work, and weight has a potential",
        None => "joints and guides do no work",
    };
    out.kept = vec![kept("energy", true, why)];
    out.kinetic = Some(half(&(&last.inertia * &speed.powi(2))));
    out.inertia = Some([last.inertia.clone(), last.inertia]);
    out.energy = Some([start, energy]);
    out.work = work;
    out.needs = needs;
    out.assumptions = assumptions;
    Ok(out)
}

/// M = Σ m v² + I ω² at the rate 1, and V' = g Σ m y', both by the coordinate: with them M q̈ + ½ M' q̇² + V' = 0, the
/// equation of Lagrange.
pub(crate) fn by_coordinate(stage: &Stage, linkage: &Linkage) -> [Expr; 2] {
    let (mut inertia, mut lifted) = (Vec::new(), Vec::new());
    for (b, place) in &linkage.places {
        let moved = &stage.scene.bodies[*b];
        let [u, v, w] = place.each_ref().map(|e| e.derivative(&linkage.coordinate));
        inertia.push(&moved.mass * &(&u.powi(2) + &v.powi(2)));
        inertia.push(&moved.inertia * &w.powi(2));
        lifted.push(&moved.mass * &v);
    }
    let g = linkage.gravity.clone().unwrap_or_else(Expr::zero);
    [Expr::sum(inertia), g * Expr::sum(lifted)]
}

/// The acceleration of the coordinate, where it is the same all the way.
fn steady(stage: &Stage, linkage: &Linkage) -> Result<Option<Expr>, Refused> {
    let [mass, drawn] = by_coordinate(stage, linkage);
    let (mass, drawn) = (tidied(stage, &mass)?, tidied(stage, &drawn)?);
    let changes = |e: &Expr| e.symbols().contains(&linkage.coordinate);
    if changes(&mass) || changes(&drawn) {
        return Ok(None);
    }
    tidied(stage, &-(&drawn / &mass)).map(Some)
}

/// How long it takes from one rate of the coordinate to another at this acceleration.
fn time(
    stage: &Stage,
    linkage: &Linkage,
    [rate, speed]: [&Expr; 2],
    acceleration: &Expr,
) -> Result<Expr, Refused> {
    let [begin, end] = &linkage.ends;
    let time = match acceleration.is_zero() {
        true => &(end - begin) / rate,
        false => &(speed - rate) / acceleration,
    };
    tidied(stage, &time)
}

/// Accelerations of a body of a linkage along x and y, and the angular one, with this kinetic energy where the coordinate has this
/// value.
pub(in crate::story) fn accelerations(
    stage: &Stage,
    linkage: &Linkage,
    body: usize,
    (energy, value): (&Expr, &Expr),
) -> Result<[Expr; 3], Refused> {
    let q = &linkage.coordinate;
    let [inertia, drawn] = by_coordinate(stage, linkage);
    let at = |e: &Expr| tidied(stage, &linkage.at(e, value));
    let [mass, grows, drawn] = [at(&inertia)?, at(&inertia.derivative(q))?, at(&drawn)?];
    let square = tidied(stage, &(&(&Expr::from(2) * energy) / &mass))?;
    let second = -(&(&half(&(&grows * &square)) + &drawn) / &mass);
    let mut out = [0; 3].map(|_| Expr::zero());
    let place = linkage.places.iter().find(|(b, _)| *b == body);
    for (part, place) in out.iter_mut().zip(place.iter().flat_map(|p| &p.1)) {
        let slope = place.derivative(q);
        let [goes, bends] = [at(&slope)?, at(&slope.derivative(q))?];
        *part = tidied(stage, &(&(&bends * &square) + &(&goes * &second)))?;
    }
    Ok(out)
}

/// 1 where the coordinate grows, −1 where it falls; what is not proved is seen at points of the domain and taken for granted.
fn way(
    stage: &Stage,
    linkage: &Linkage,
    needs: &mut Vec<Expr>,
    assumptions: &mut Vec<Sentence>,
) -> Result<i64, Refused> {
    let [begin, end] = &linkage.ends;
    let grows = end - begin;
    if is_zero(&grows, &stage.scene.domains) == Some(true) {
        let why = format!("`{}` ends where it begins", linkage.coordinate);
        let hint = "`from` and `to` are two values; without `from` the parameter itself is where it begins";
        return Err(Refused::new(&stage.name, why, hint));
    }
    if let Some(positive) = sign(&grows, &stage.scene.domains).side() {
        return Ok(if positive { 1 } else { -1 });
    }
    let names = grows.symbols().into_iter().collect();
    let points: Vec<_> = integrate::points_of(names, &stage.scene.domains, POINTS).collect();
    let seen = |way: f64| {
        let mut all = points.iter().map(|p| grows.evaluate(p));
        all.all(|v| v.is_some_and(|v| way * v >= 0.0))
    };
    let way = match (seen(1.0), seen(-1.0)) {
        (true, false) => 1,
        (false, true) => -1,
        _ => {
            let why = format!(
                "whether `{}` grows or falls is not decided",
                linkage.coordinate
            );
            let hint = "say it by `relations`, or by the domains of both values";
            return Err(Refused::new(&stage.name, why, hint));
        }
    };
    let need = &Expr::from(way) * &grows;
    assumptions.push(Sentence::not_negative(&need));
    needs.push(need);
    Ok(way)
}

/// Places, and what each moves by where the coordinate grows by one.
fn pose(stage: &Stage, linkage: &Linkage, value: &Expr) -> Result<Pose, Refused> {
    let at = |e: &Expr| tidied(stage, &linkage.at(e, value));
    let mut out = Pose {
        places: Vec::new(),
        rates: Vec::new(),
        inertia: Expr::zero(),
    };
    let mut parts = Vec::new();
    for (b, place) in &linkage.places {
        let body = &stage.scene.bodies[*b];
        let [x, y, angle] = place.each_ref().map(at);
        let rates = place
            .each_ref()
            .map(|e| at(&e.derivative(&linkage.coordinate)));
        let [u, v, w] = rates;
        let [u, v, w] = [u?, v?, w?];
        parts.push(&body.mass * &(&u.powi(2) + &v.powi(2)));
        parts.push(&body.inertia * &w.powi(2));
        out.places.push([x?, y?, angle?]);
        out.rates.push([u, v, w]);
    }
    out.inertia = tidied(stage, &Expr::sum(parts))?;
    Ok(out)
}

/// Refuses bodies that are not where the coordinate puts them.
fn stands(stage: &Stage, before: &State, linkage: &Linkage, pose: &Pose) -> Result<(), Refused> {
    for ((b, _), place) in linkage.places.iter().zip(&pose.places) {
        let body = &stage.scene.bodies[*b];
        let [x, y] = &before.center[*b];
        let all = [x, y, &before.angle[*b]].into_iter().zip(place);
        // How far what is round has turned before makes no difference.
        let is_round = body.shape.radius().is_some();
        let seen = if body.is_particle() || is_round { 2 } else { 3 };
        let mut gaps = all.take(seen).map(|(a, b)| a - b);
        if gaps.any(|gap| is_zero(&gap, &stage.scene.domains) != Some(true)) {
            let why = format!(
                "`{}` is not where `{}` = {} puts it",
                body.name,
                linkage.coordinate,
                write_plain(&linkage.ends[0])
            );
            let hint = "give `from`, the value of the coordinate at the beginning";
            return Err(Refused::new(&stage.name, why, hint));
        }
    }
    Ok(())
}

/// The rate of the coordinate at the beginning; refused where no rate gives the motion of all bodies.
fn rate(stage: &Stage, before: &State, linkage: &Linkage, pose: &Pose) -> Result<Expr, Refused> {
    let domains = &stage.scene.domains;
    let motion = |b: usize| {
        let [u, v] = &before.velocity[b];
        [u, v, &before.spin[b]]
    };
    let mut momentum = Vec::new();
    for ((b, _), [u, v, w]) in linkage.places.iter().zip(&pose.rates) {
        let body = &stage.scene.bodies[*b];
        let [x, y, spin] = motion(*b);
        momentum.push(&body.mass * &(&(u * x) + &(v * y)));
        momentum.push(&body.inertia * &(w * spin));
    }
    let momentum = tidied(stage, &Expr::sum(momentum))?;
    let rate = match momentum.is_zero() {
        true => momentum,
        false => tidied(stage, &(&momentum / &pose.inertia))?,
    };
    for ((b, _), rates) in linkage.places.iter().zip(&pose.rates) {
        let body = &stage.scene.bodies[*b];
        let seen = if body.is_particle() { 2 } else { 3 };
        let all = motion(*b).into_iter().zip(rates).take(seen);
        let mut gaps = all.map(|(is, per)| is - &(per * &rate));
        if gaps.any(|gap| is_zero(&gap, domains) == Some(false)) {
            let why = format!(
                "`{}` does not begin to move as the linkage lets it",
                body.name
            );
            let hint = "put an impact before it that joins the bodies, or begin at rest";
            return Err(Refused::new(&stage.name, why, hint));
        }
    }
    Ok(rate)
}

/// Work of the weights.
fn work(stage: &Stage, linkage: &Linkage, first: &Pose, last: &Pose) -> Vec<(&'static str, Expr)> {
    let Some(g) = &linkage.gravity else {
        return Vec::new();
    };
    let all = linkage
        .places
        .iter()
        .zip(first.places.iter().zip(&last.places));
    let parts = all.map(|((b, _), ([_, from, _], [_, to, _]))| {
        &(&stage.scene.bodies[*b].mass * g) * &(from - to)
    });
    vec![("weight", Expr::sum(parts))]
}

/// Whether the linkage begins to move the way it is said to: at rest its weight has to draw it.
fn sets_out(
    stage: &Stage,
    linkage: &Linkage,
    rate: &Expr,
    way: i64,
    needs: &mut Vec<Expr>,
    assumptions: &mut Vec<Sentence>,
) -> Result<(), Refused> {
    let domains = &stage.scene.domains;
    let goes = if way > 0 { "grow" } else { "fall" };
    let way = Expr::from(way);
    let name = unicode_name(&linkage.coordinate);
    let ahead = &way * rate;
    match sign(&ahead, domains) {
        Seen::Proved(s) if s.is_not_negative() => {}
        Seen::Proved(_) => {
            let why = format!("`{}` begins to change the other way", linkage.coordinate);
            let hint = "look at the motion handed on, and at `to`";
            return Err(Refused::new(&stage.name, why, hint));
        }
        _ => {
            let condition = at_least_zero(&ahead, domains);
            assumptions.push(sentence!(
                "{}, so that {} begins to {}",
                condition,
                &name,
                goes
            ));
            needs.push(ahead.clone());
        }
    }
    let lifted = linkage
        .places
        .iter()
        .map(|(b, [_, y, _])| &stage.scene.bodies[*b].mass * &y.derivative(&linkage.coordinate));
    let drawn = -(&way * &Expr::sum(lifted));
    let rests = ahead.is_zero();
    let gravity = linkage.gravity.as_ref();
    if gravity.is_none_or(|g| is_zero(g, domains) == Some(true)) {
        return match rests {
            true => Err(Refused::new(
                &stage.name,
                "it is at rest, and nothing moves it",
                "add \"gravity\": \"g\"",
            )),
            false => Ok(()),
        };
    }
    if rests {
        let begins = tidied(stage, &linkage.at(&drawn, &linkage.ends[0]))?;
        match sign(&begins, domains) {
            Seen::Proved(Sign::Positive | Sign::NotNegative) => {}
            Seen::Proved(Sign::Zero) if is_zero(&drawn, domains) != Some(true) => {
                let lead = &stage.scene.bodies[linkage.places[0].0];
                assumptions.push(pushed(&lead.name));
            }
            Seen::Proved(_) => {
                let why = format!(
                    "at rest its weight does not make `{}` change this way",
                    linkage.coordinate
                );
                let hint = "look at `to`, or give it a velocity";
                return Err(Refused::new(&stage.name, why, hint));
            }
            _ => {
                let sets = above_zero(&begins, domains);
                assumptions.push(sentence!("{}, so that weight sets it going", sets));
                needs.push(begins);
            }
        }
    }
    Ok(())
}

/// Points of the domain at which a way is looked at, and places on it.
const POINTS: usize = 12;
const PARTS: u32 = 16;

/// What is needed to get past the places at which the weights, which have to be lifted up to there, begin to draw the linkage on:
/// energy compares the ends only.
fn hurdles(
    stage: &Stage,
    linkage: &Linkage,
    (way, start): (i64, &Expr),
    needs: &mut Vec<Expr>,
    assumptions: &mut Vec<Sentence>,
) -> Result<(), Refused> {
    let Some(gravity) = &linkage.gravity else {
        return Ok(());
    };
    let q = &linkage.coordinate;
    let mass = |b: usize| &stage.scene.bodies[b].mass;
    let all = linkage.places.iter().map(|(b, [_, y, _])| mass(*b) * y);
    let lifted = gravity * &Expr::sum(all);
    let drawn = -(&Expr::from(way) * &lifted.derivative(q));
    let [begin, end] = &linkage.ends;
    let names = [begin, end, &drawn].into_iter().flat_map(|e| e.symbols());
    let points = integrate::points_of(names.collect(), &stage.scene.domains, POINTS);
    let points: Vec<Point<f64>> = points.collect();
    let is_met = |point: &Point<f64>| has_hurdle(linkage, &drawn, point) != Some(false);
    if !points.iter().any(is_met) {
        return Ok(());
    }
    let name = unicode_name(q);
    let Some(places) = hurdles_at(stage, linkage, &drawn, &points) else {
        assumptions.push(sentence!("it does not come to rest while {} changes", name));
        return Ok(());
    };
    for (place, is_always) in places {
        let [low, high] = [begin, &place].map(|value| linkage.at(&lifted, value));
        let left = tidied(stage, &(start - &(&high - &low)))?;
        match sign(&left, &stage.scene.domains) {
            Seen::Proved(s) if s.is_not_negative() => {}
            Seen::Proved(_) if is_always => {
                let place = write_plain(&place);
                let why = format!("it does not get past `{q}` = {place}");
                let hint = "end the stage before it, or give it more energy";
                return Err(Refused::new(&stage.name, why, hint));
            }
            _ => {
                let least = at_least_zero(&left, &stage.scene.domains);
                if is_always {
                    needs.push(left);
                }
                assumptions.push(match is_always {
                    true => sentence!("{}, so that it gets past {} = {}", least, &name, &place),
                    false => sentence!(
                        "{} does not pass {}, or {}, so that it gets past it",
                        &name,
                        &place,
                        least
                    ),
                });
            }
        }
    }
    Ok(())
}

/// Whether what draws the linkage on is below zero at a place on the way and above zero farther on; `None` where it has no value.
fn has_hurdle(linkage: &Linkage, drawn: &Expr, point: &Point<f64>) -> Option<bool> {
    const NOISE: f64 = 1e-12;
    let [from, to] = linkage.ends.each_ref().map(|e| e.evaluate(point));
    let (from, to) = (from?, to?);
    let mut is_opposed = false;
    for k in 0..=PARTS {
        let value = from + (to - from) * f64::from(k) / f64::from(PARTS);
        let drawn = drawn.evaluate(&with_coordinate(linkage, point, value))?;
        if is_opposed && drawn > NOISE {
            return Some(true);
        }
        is_opposed |= drawn < -NOISE;
    }
    Some(false)
}

fn with_coordinate(linkage: &Linkage, point: &Point<f64>, value: f64) -> Point<f64> {
    let mut there = point.clone();
    there.directions.remove(&linkage.coordinate);
    there.values.insert(linkage.coordinate.clone(), value);
    there
}

/// The places at which what draws the linkage on turns from below zero to above, and whether they lie on the way at every point looked
/// at or at some; nothing where they are not found.
fn hurdles_at(
    stage: &Stage,
    linkage: &Linkage,
    drawn: &Expr,
    points: &[Point<f64>],
) -> Option<Vec<(Expr, bool)>> {
    let q = &linkage.coordinate;
    let mut domains = stage.scene.domains.clone();
    domains.relations.retain(|r| !r.excess.mentions(q));
    let drawn = tidied(stage, drawn).ok()?;
    let stands = |domain| {
        let mut domains = domains.clone();
        domains.symbols.insert(q.clone(), domain);
        let roots = solve(&drawn, q, &domains).ok()?;
        let is_known = roots.open.is_empty() && roots.inside.iter().all(|root| root.proved);
        is_known.then(|| roots.inside.into_iter().map(|root| root.value))
    };
    // Of an angle the same places come again after a turn.
    let turn = &Expr::from(2) * &Expr::pi();
    let turned = drawn.put(q, &(Expr::symbol(q) + turn.clone()));
    let places: Vec<Expr> = match is_zero(&(turned - &drawn), &domains) {
        Some(true) => {
            let values = stands(Domain::angle(ratio(-1, 1), ratio(1, 1)))?;
            let again = |value: Expr| [-1, 0, 1].map(|k| &value + &(Expr::from(k) * &turn));
            values.flat_map(again).collect()
        }
        _ => stands(Domain::real())?.collect(),
    };
    let slope = drawn.derivative(q);
    let is_one = |value: &Expr, point: &Point<f64>| {
        let [from, to] = linkage.ends.each_ref().map(|e| e.evaluate(point));
        let (from, to, at) = (from?, to?, value.evaluate(point)?);
        let slope = slope.evaluate(&with_coordinate(linkage, point, at))?;
        let is_between = (at - from) * (at - to) < 0.0;
        Some(is_between && slope * (to - from) > 0.0)
    };
    let mut out = Vec::new();
    for place in places {
        let seen = points.iter().map(|point| is_one(&place, point));
        let seen: Vec<bool> = seen.collect::<Option<_>>()?;
        if seen.contains(&true) {
            out.push((tidied(stage, &place).ok()?, !seen.contains(&false)));
        }
    }
    (!out.is_empty()).then_some(out)
}
