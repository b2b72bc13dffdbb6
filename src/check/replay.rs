//! Replays claims at random exact points: every symbol at the value that the independent solution of the scene gives it.
//!
//! In: a scene, what the symbols of its solution stand for, the claims. Out: which of them hold there, exactly or else in doubles.

use std::collections::BTreeMap;

use super::defined::{Defined, Here, holds, is_of_a_case};
use super::impacts::Impact;
use super::{Claim, Meaning, POINTS, Report};
use crate::expr::{Expr, Point, Rational, Symbol};
use crate::numeric::friction::happened;
use crate::numeric::points::with_angles;
use crate::numeric::{self, Number};
use crate::scene::{Ask, Scene};

/// Seeds tried where a contact with friction must do what the solution says.
const SEEDS: u64 = 400;

/// Relative difference allowed where a claim has no exact value and doubles must do.
const ROUNDING: f64 = 1e-9;

/// Replays the claims of an impact.
pub(super) fn replay(impact: &Impact, claims: &[&Claim], report: &mut Report) {
    let (scene, meanings) = (&impact.scene, &impact.meanings);
    let (mode, needs) = (impact.mode.as_deref(), &*impact.needs);
    let mut needed = needed(numeric::needed(scene), meanings, claims);
    needs.iter().for_each(|e| needed.add(e));
    let told = |p: &Point<Rational>| holds(needs, &numeric::rounded(p));
    let random = |seed| numeric::random_point(&needed, &scene.domains, seed);
    let points: Vec<Point<Rational>> = match scene.friction() {
        None => {
            let all = (1..=SEEDS).map(random).filter(told);
            all.take(POINTS as usize).collect()
        }
        Some(_) => {
            let wide = |seed| numeric::point_of_any_size(&needed, &scene.domains, seed);
            let seeds = (1..=SEEDS).map(random).chain((1..=SEEDS).map(wide));
            // The values of the scene show a case that few points of the domain have.
            let own = numeric::exact_values(scene).ok();
            let mut instead = None;
            let fits = |p: &Point<Rational>| {
                let found = mode.and_then(|_| does(scene, p));
                let fits = found.is_some() && found.as_deref() == mode;
                if !fits && instead.is_none() {
                    instead = found;
                }
                fits
            };
            let all = own.into_iter().chain(seeds).filter(told).filter(fits);
            let all: Vec<_> = all.take(POINTS as usize).collect();
            if let (true, false, Some(found)) = (all.is_empty(), needs.is_empty(), instead) {
                let claim = format!("the contact {}", mode.unwrap_or_default());
                let why = format!("wherever that was tried under its conditions, it {found}");
                report.fail(impact.name.as_deref().unwrap_or_default(), &claim, why);
            }
            all
        }
    };
    let points = points.into_iter().map(|mut point| {
        // An angle may stand in a sum, such as θ + π/4, whose sine is no fraction.
        let mut doubles = with_angles(&numeric::rounded(&point));
        symbols_at(scene, meanings, &mut point, numeric::solve_exact);
        symbols_at(scene, meanings, &mut doubles, numeric::solve_f64);
        (point, doubles)
    });
    compare(points.collect(), (scene, meanings), claims, report);
}

/// What the contact with friction does at a point, followed in fractions, or in doubles where a root is no fraction.
fn does(scene: &Scene, at: &Point<Rational>) -> Option<String> {
    // A place that was handed on may hold a root.
    if let Ok(given) = numeric::given(scene, at)
        && let Ok(found) = numeric::settle(&given, numeric::solve_exact)
    {
        let (_, followed) = found?;
        return Some(happened(&given, &followed).words().to_string());
    }
    let given = numeric::given(scene, &numeric::rounded(at)).ok()?;
    let (_, followed) = numeric::settle(&given, numeric::solve_f64).ok()??;
    Some(happened(&given, &followed).words().to_string())
}

/// Everything that must have a value at a point; what the motion decides is found later.
pub(super) fn needed(
    mut needed: numeric::Needed,
    meanings: &BTreeMap<Symbol, Meaning>,
    claims: &[&Claim],
) -> numeric::Needed {
    for claim in claims {
        needed.add(&claim.left);
        needed.add(&claim.right);
    }
    needed.plain.retain(|name| !meanings.contains_key(name));
    needed.angles.retain(|name, _| !meanings.contains_key(name));
    needed
}

/// Puts points, exact and in doubles, into both sides of every claim.
pub(super) fn compare(
    points: Vec<(Point<Rational>, Point<f64>)>,
    (scene, meanings): (&Scene, &BTreeMap<Symbol, Meaning>),
    claims: &[&Claim],
    report: &mut Report,
) {
    let defined = Defined::new(scene, claims);
    let mut told: Vec<Told> = claims.iter().map(|_| Told::default()).collect();
    for (mut point, doubles) in points {
        let mut doubles = with_angles(&doubles);
        let here = Here::default();
        for (claim, told) in claims.iter().zip(&mut told) {
            let is_so = holds(&claim.needs, &doubles);
            if let Some(name) = &claim.defines
                && matches!(meanings.get(name), Some(Meaning::Defined))
                && !doubles.values.contains_key(name)
            {
                if let Some(value) = claim.right.evaluate(&point) {
                    point.values.insert(name.clone(), value);
                }
                if let Some(value) = claim.right.evaluate(&doubles) {
                    doubles.values.insert(name.clone(), value);
                }
                if is_of_a_case(claim) {
                    told.held = true;
                    continue;
                }
                if is_so && let Some(Err(why)) = defined.held(name, &claim.right, (&doubles, &here))
                {
                    told.failed = told.failed.take().or(Some(why));
                }
            }
            if !is_so {
                continue;
            }
            match compared(claim, &point, &doubles) {
                Some(Ok(in_doubles)) => {
                    told.held = true;
                    told.in_doubles |= in_doubles;
                }
                Some(Err(why)) => told.failed = told.failed.take().or(Some(why)),
                None => {}
            }
        }
    }
    for (claim, told) in claims.iter().zip(told) {
        match told.failed {
            Some(why) => report.fail(&claim.step, &claim.text, why),
            None if told.held => {
                report.held += 1;
                report.in_doubles += usize::from(told.in_doubles);
            }
            None => report.open.push(claim.step.clone()),
        }
    }
}

/// What became of a claim at all points.
#[derive(Default)]
struct Told {
    held: bool,
    in_doubles: bool,
    failed: Option<String>,
}

/// Both sides of a claim at a point.
fn sides<T: Number>(claim: &Claim, point: &Point<T>) -> Option<[T; 2]> {
    Some([claim.left.evaluate(point)?, claim.right.evaluate(point)?])
}

/// Whether a claim holds at a point and, where it does, whether doubles had to do; `None` where it has no value.
fn compared(
    claim: &Claim,
    exact: &Point<Rational>,
    doubles: &Point<f64>,
) -> Option<Result<bool, String>> {
    if let Some([left, right]) = sides(claim, exact) {
        let why = format!("at an exact point the left side is {left}, the right side {right}");
        return Some(if left == right { Ok(false) } else { Err(why) });
    }
    let [left, right] = sides(claim, doubles)?;
    let scale = left.abs().max(right.abs()).max(1.0);
    let apart = (left - right).abs();
    let is_close = apart <= ROUNDING * scale || apart <= shaken(claim, doubles);
    let why = format!("in doubles the left side is {left}, the right side {right}");
    Some(if is_close { Ok(true) } else { Err(why) })
}

/// By how much the sides of a claim come apart when a value changes by its rounding: large where a root is taken of what
/// cancels.
fn shaken(claim: &Claim, point: &Point<f64>) -> f64 {
    let apart = |point: &Point<f64>| {
        let [left, right] = sides(claim, point)?;
        Some((left - right).abs())
    };
    let symbols = [&claim.left, &claim.right].map(Expr::symbols);
    let symbols = symbols.into_iter().flatten();
    let both =
        symbols.flat_map(|name| [-4.0, 4.0].map(|ulps| (name.clone(), 1.0 + ulps * f64::EPSILON)));
    let all = both.filter_map(|(name, factor)| {
        let mut near = point.clone();
        *near.values.get_mut(&name)? *= factor;
        apart(&near)
    });
    // What is apart by more than rounding stays so whatever is shaken.
    let here = apart(point).unwrap_or(0.0);
    all.map(|a| (a - here).abs()).fold(0.0, f64::max)
}

/// Gives every symbol its value in the independent solution; symbols that the laws leave open get none.
fn symbols_at<T: Number + PartialOrd>(
    scene: &Scene,
    meanings: &BTreeMap<Symbol, Meaning>,
    point: &mut Point<T>,
    solve: impl Fn(&numeric::System<T>) -> Result<numeric::Solution<T>, numeric::Contradiction>,
) {
    let Ok(numeric::Solved { given, motion, .. }) = numeric::solved(scene, point, solve) else {
        return;
    };
    for (name, meaning) in meanings {
        let Meaning::Asked(ask, axis) = meaning else {
            continue;
        };
        // One component may be determined where the other is not.
        let mut ask = ask.clone();
        if let (Ask::Impulse { along, .. }, Some(axis)) = (&mut ask, axis) {
            along.get_or_insert_with(|| [0, 1].map(|k| Expr::from(i64::from(k == *axis))));
        }
        let answer = numeric::answer(&ask, point, &given, &motion).ok();
        if let Some(value) = answer.and_then(|answer| answer.component(*axis)) {
            point.values.insert(name.clone(), value);
        }
    }
}
