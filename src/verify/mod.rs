//! Holds what was derived against everything it can be held against: the laws it came from, an independent numeric
//! solution, and what any motion after a collision has to fulfil.
//!
//! A closed form is *proved* when, put into every equation of the full system, both sides are identical; that proof does
//! not trust the way it was found. Exact points guard against a mistake shared by laws and derivation, since `numeric`
//! writes its equations from the geometry alone; doubles tell how the formula behaves when used.

pub mod compare;
mod doubles;
pub mod friction;
mod identity;
mod inertia;
pub mod possible;
pub mod printed;
pub mod rounding;
mod row_space;
mod slip;
mod sticks;

pub use sticks::needed_friction;

use std::collections::BTreeMap;

use crate::answer::{Answer, Check, Form};
use crate::derive::Derivation;
use crate::expr::surd::Surd;
use crate::expr::{Expr, Point, Rational, Scalar, Symbol};
use crate::formula::{Sentence, write_plain};
use crate::numeric::{self, points::with_angles};
use crate::scene::{Ask, Scene};

/// Exact points at which every answer is compared. The identity is the proof; these guard the laws themselves, and
/// three in general position have caught every planted mistake.
const POINTS: u64 = 3;

/// Points tried at most where the first ones have no rational values.
const MORE_POINTS: u64 = 60;

/// What an impact rests on where bodies separate at some of the points.
pub(crate) const APPROACH: &str = "the bodies approach each other at the contact";

/// The outcome of all checks.
#[derive(Clone, Debug, Default)]
pub struct Proof {
    /// Checks of the motion as a whole.
    pub scene: Vec<Check>,
    /// Checks of each answer, in the order of the answers.
    pub answers: Vec<Vec<Check>>,
    /// Conditions of the collision itself that could not be shown from the domain, such as that the bodies approach.
    pub assumptions: Vec<Sentence>,
}

impl Proof {
    /// Whether no check failed.
    pub fn holds(&self) -> bool {
        self.checks().all(|c| c.holds != Some(false))
    }

    /// All checks.
    pub fn checks(&self) -> impl Iterator<Item = &Check> {
        self.scene.iter().chain(self.answers.iter().flatten())
    }
}

/// How far answers can be used to judge others.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Trust {
    /// Each one satisfies every equation identically, or equals the independent solution at exact points.
    Proved,
    /// Nothing contradicts these answers, and nothing proves them.
    NotProved(Vec<String>),
    /// These checks failed, in words.
    Refuted(Vec<String>),
}

/// How far the answers of a derivation can be trusted.
pub fn trust(derivation: &Derivation, proof: &Proof) -> Trust {
    let failed: Vec<String> = proof
        .checks()
        .filter(|c| c.holds == Some(false))
        .map(|c| c.words.clone())
        .collect();
    if !failed.is_empty() {
        return Trust::Refuted(failed);
    }
    let held = |checks: &[Check], kind| {
        let of_kind = |c: &Check| c.kind == kind && c.holds == Some(true);
        checks.iter().any(of_kind)
    };
    if held(&proof.scene, "identity") {
        return Trust::Proved;
    }
    let open: Vec<String> = derivation
        .answers
        .iter()
        .enumerate()
        .filter(|(_, a)| matches!(a.form, Form::Value { .. }))
        .filter(|(i, _)| {
            !proof
                .answers
                .get(*i)
                .is_some_and(|c| held(c, "exact points"))
        })
        .map(|(_, a)| a.name.clone())
        .collect();
    if open.is_empty() {
        Trust::Proved
    } else {
        Trust::NotProved(open)
    }
}

/// Checks a derivation against its scene.
pub fn prove(scene: &Scene, derivation: &Derivation) -> Proof {
    let mut proof = Proof::default();
    let mut identities = identity::Identities::new(scene, derivation);
    proof.scene.push(identities.of_motion());
    let needed = numeric::needed(scene);
    let points = (1..=POINTS).map(|seed| numeric::random_point(&needed, &scene.domains, seed));
    let points: Vec<Point<Rational>> = points.collect();
    // A sum of angles such as θ + π/6 has no direction in fractions, but a value.
    let rounded = points.iter().map(numeric::rounded);
    let rounded: Vec<Point<f64>> = rounded.map(|point| with_angles(&point)).collect();
    proof.scene.extend(inertia::check(scene, &rounded));
    let with_roots: Vec<Point<Surd>> = (points.iter())
        .map(|point| point.map(Surd::from_rational))
        .collect();
    let runs = runs(scene, &needed, points);
    let exact = match runs.is_empty() {
        false => exactly(scene, derivation, runs, &mut proof),
        true => {
            let exact = |point| run(scene, point, numeric::solve_exact);
            let runs: Vec<Run<Surd>> = with_roots.into_iter().filter_map(exact).collect();
            exactly(scene, derivation, runs, &mut proof)
        }
    };
    let in_doubles = rounded.into_iter();
    let mut in_doubles: Vec<Run<f64>> = in_doubles
        .filter_map(|point| doubles::run(scene, point))
        .collect();
    for run in &mut in_doubles {
        run.named = with_definitions(derivation, &run.point);
    }
    for (answer, exact) in derivation.answers.iter().zip(exact) {
        let mut checks = Vec::new();
        if let Form::Value { closed, short } = &answer.form {
            if short != closed && !derivation.in_steps {
                checks.push(identities.of_answer(answer, closed, short));
            }
            checks.extend(exact);
            checks.push(doubles::check(
                scene,
                derivation,
                answer,
                closed,
                &in_doubles,
            ));
        }
        proof.answers.push(checks);
    }
    proof
}

/// What exact solutions say of the motion, and of each answer that has a closed form.
fn exactly<T: Exact>(
    scene: &Scene,
    derivation: &Derivation,
    mut runs: Vec<Run<T>>,
    proof: &mut Proof,
) -> Vec<Option<Check>> {
    for run in &mut runs {
        run.named = with_definitions(derivation, &run.point);
    }
    invariants(&runs, proof);
    admissible(scene, derivation, &runs, proof);
    let answers = derivation.answers.iter();
    let of = |answer: &Answer| match &answer.form {
        Form::Value { closed, .. } => Some(exact_points(scene, answer, closed, &runs)),
        _ => None,
    };
    answers.map(of).collect()
}

/// The value of an expression that may use the definitions of a derivation.
pub fn evaluate<T: Scalar>(e: &Expr, derivation: &Derivation, at: &Point<T>) -> Option<T> {
    e.evaluate(&with_definitions(derivation, at))
}

/// A point with the values of what a derivation in steps defines, each found from those before it.
fn with_definitions<T: Scalar>(derivation: &Derivation, at: &Point<T>) -> Point<T> {
    let mut point = at.clone();
    let definitions = derivation.definitions.iter();
    for definition in definitions.filter(|_| derivation.in_steps) {
        if let Some(value) = definition.value.evaluate(&point) {
            point.values.insert(definition.name.clone(), value);
        }
    }
    point
}

/// An expression with the definitions of a derivation put in.
pub fn expand(e: &Expr, derivation: &Derivation) -> Expr {
    e.substitute(&meanings(derivation))
}

/// What the definitions of a derivation stand for, in parameters alone.
fn meanings(derivation: &Derivation) -> BTreeMap<Symbol, Expr> {
    let mut values: BTreeMap<Symbol, Expr> = BTreeMap::new();
    for definition in &derivation.definitions {
        let value = definition.value.substitute(&values);
        values.insert(definition.name.clone(), value);
    }
    values
}

/// The independent solution at one point.
struct Run<T> {
    /// The values of the parameters.
    point: Point<T>,
    /// The same with those of what the derivation defines: all answers are valued there.
    named: Point<T>,
    given: numeric::Given<T>,
    motion: numeric::Motion<T>,
}

/// Exact numbers that the two ways are held against each other in.
trait Exact: numeric::Number + PartialOrd + std::fmt::Display {}

impl Exact for Rational {}
impl Exact for Surd {}

/// Solutions at a few exact points. Where roots make most points irrational, the scene's own values may still do, and
/// more points are tried.
fn runs(
    scene: &Scene,
    needed: &numeric::Needed,
    points: Vec<Point<Rational>>,
) -> Vec<Run<Rational>> {
    let exact = |point| run(scene, point, numeric::solve_exact);
    let mut runs: Vec<_> = points.into_iter().filter_map(exact).collect();
    if runs.is_empty() {
        let random = |seed| numeric::random_point(needed, &scene.domains, seed);
        let own = numeric::exact_values(scene).ok();
        runs.extend(own.and_then(exact));
        let more = (POINTS + 1..=MORE_POINTS).filter_map(|seed| exact(random(seed)));
        runs.extend(more.take(POINTS as usize));
    }
    runs
}

fn run<T: numeric::Number + PartialOrd>(
    scene: &Scene,
    point: Point<T>,
    solve: impl Fn(&numeric::System<T>) -> Result<numeric::Solution<T>, numeric::Contradiction>,
) -> Option<Run<T>> {
    let numeric::Solved { given, motion, .. } = numeric::solved(scene, &point, solve).ok()?;
    Some(Run {
        named: point.clone(),
        point,
        given,
        motion,
    })
}

fn invariants<T: Exact>(runs: &[Run<T>], proof: &mut Proof) {
    let mut count = 0;
    let mut failed: Vec<String> = Vec::new();
    for run in runs {
        if !run.motion.loose.is_empty() {
            continue;
        }
        for identity in numeric::identities(&run.given, &run.motion) {
            count += 1;
            if !identity.holds(0.0) {
                failed.push(format!("{:?}", identity.what));
            }
        }
    }
    failed.dedup();
    if count > 0 || !failed.is_empty() {
        proof.scene.push(Check::new("invariants", match failed.as_slice() {
                [] => format!("momentum, angular momentum and energy identities hold exactly ({count} over {})", points(runs.len())),
                _ => format!("violated: {}", failed.join(", ")),
            }, Some(failed.is_empty())));
    }
}

/// push and friction as the exact points show them; the friction that sticking needs is held against its formula.
fn admissible<T: Exact>(
    scene: &Scene,
    derivation: &Derivation,
    runs: &[Run<T>],
    proof: &mut Proof,
) {
    let mut separating = 0;
    let mut most: Option<T> = None;
    let mut ratios: Vec<Option<Expr>> = Vec::new();
    let mut differs = false;
    for run in runs.iter().filter(|r| r.motion.loose.is_empty()) {
        let reports = numeric::contact_reports(&run.given, &run.motion).into_iter();
        for (c, (contact, report)) in run.given.contacts.iter().zip(reports).enumerate() {
            let Some(report) = report else { continue };
            let is_light = |b: &usize| scene.bodies[*b].is_light_pulley();
            separating +=
                usize::from(report.separates && !contact.joint.bodies.iter().any(is_light));
            let sticks = matches!(contact.law, numeric::given::GivenLaw::Sticking);
            let needed = report.required_friction;
            let Some(needed) = needed.filter(|mu| sticks && !mu.is_zero()) else {
                continue;
            };
            if ratios.is_empty() {
                let contacts = 0..scene.contacts.len();
                ratios.extend(contacts.map(|c| needed_friction(scene, derivation, c)));
            }
            let told = ratios[c].as_ref().and_then(|r| r.evaluate(&run.point));
            differs |= told.is_some_and(|told| told != needed);
            most = Some(match most {
                Some(most) if most > needed => most,
                _ => needed,
            });
        }
    }
    if separating > 0 {
        proof.assumptions.push(Sentence::words(APPROACH));
    }
    if let Some(most) = most {
        let told: Vec<String> = ratios.iter().flatten().map(write_plain).collect();
        let ratio = match told.as_slice() {
            [only] => format!("|P_t|/P_n = {only}"),
            _ => String::from("|P_t|/P_n"),
        };
        let most = most.size();
        let words = format!("sticking needs friction {ratio}, at the points tried up to {most:.3}");
        let holds = differs.then_some(false);
        proof.scene.push(Check::new("friction", words, holds));
    }
}

/// What an answer's question asks for, and of a vector the component that the answer is.
fn asked(scene: &Scene, answer: &Answer) -> Option<Ask> {
    let mut ask = scene.question_of_impact(&answer.question)?.ask.clone();
    // A component is asked for on its own: it may be determined where its vector is not.
    if let Some(axis) = answer.axis() {
        let unit = [0, 1].map(|i| if i == axis { Expr::one() } else { Expr::zero() });
        match &mut ask {
            Ask::Velocity { along, .. } | Ask::Impulse { along, .. } => *along = Some(unit),
            _ => {}
        }
    }
    Some(ask)
}

/// The value of what is asked in the independent solution.
fn numeric_value<T: numeric::Number>(ask: &Ask, run: &Run<T>) -> Option<T> {
    let found = numeric::answer(ask, &run.point, &run.given, &run.motion);
    found.ok()?.component(None)
}

fn exact_points<T: Exact>(scene: &Scene, answer: &Answer, closed: &Expr, runs: &[Run<T>]) -> Check {
    let mut equal = 0;
    let ask = asked(scene, answer);
    for run in runs {
        let Some(expected) = ask.as_ref().and_then(|ask| numeric_value(ask, run)) else {
            continue;
        };
        match closed.evaluate(&run.named) {
            Some(value) if value == expected => equal += 1,
            Some(value) => {
                return Check::new(
                    "exact points",
                    format!("closed form gives {value}, the independent solution {expected}"),
                    Some(false),
                );
            }
            None => {}
        }
    }
    match equal {
        0 => {
            let ask = ask.as_ref();
            let is_found = |run| ask.is_some_and(|ask| numeric_value(ask, run).is_some());
            let words = match runs.is_empty() || runs.iter().any(is_found) {
                true => "at none of the points tried do all values have exact numbers",
                false => "the independent exact solution does not determine it",
            };
            Check::new("exact points", words, None)
        }
        n => Check::new(
            "exact points",
            format!("equal to the independent exact solution at {}", points(n)),
            Some(true),
        ),
    }
}

/// `1 point`, `2 points`.
pub(crate) fn points(n: usize) -> String {
    format!("{n} point{}", if n == 1 { "" } else { "s" })
}
